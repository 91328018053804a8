//! Which contacts began and which ended: the serial part after the narrow phase.

use crate::dynamics::{Graph, IDLE};
use crate::simd::BLOCK;

/// Contacts whose state changed in the narrow phase, each list ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Changes {
    pub(crate) began: Vec<u32>,
    pub(crate) ended: Vec<u32>,
}

/// Compares what the narrow phase found with where the contacts are.
pub(crate) fn find_changes(graph: &Graph, changes: &mut Changes) {
    changes.began.clear();
    changes.ended.clear();
    for (colour, buckets) in graph.buckets.iter().enumerate() {
        for bucket in buckets {
            for (block, head) in bucket.heads.iter().enumerate() {
                let touching = head.touching;
                let first = block * BLOCK;
                let lanes = (bucket.contacts.len() - first).min(BLOCK);
                let all = if lanes == BLOCK { u16::MAX } else { (1 << lanes) - 1 };
                let (changed, list) = if colour == IDLE {
                    (touching, &mut changes.began)
                } else {
                    (!touching & all, &mut changes.ended)
                };
                push_lanes(changed, &bucket.contacts[first..first + lanes], list);
            }
        }
    }
    changes.began.sort_unstable();
    changes.ended.sort_unstable();
}

fn push_lanes(mut bits: u16, contacts: &[u32], list: &mut Vec<u32>) {
    while bits != 0 {
        list.push(contacts[bits.trailing_zeros() as usize]);
        bits &= bits - 1;
    }
}
