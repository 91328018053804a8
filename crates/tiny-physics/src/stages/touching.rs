//! Which contacts began and which ended: between the narrow phase and the solver.

use crate::dynamics::{Graph, IDLE, Run, Schedule};
use crate::math::sort_by_number;
use crate::simd::BLOCK;
use crate::threads::Team;

/// Blocks that one member of the team looks at at a time.
const CHUNK: usize = 128;

/// Contacts whose state changed in the narrow phase, each list ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Changes {
    pub(crate) began: Vec<u32>,
    pub(crate) ended: Vec<u32>,
    /// Memory for sorting them.
    spare: Vec<u32>,
}

crate::footprint::footprint!(Changes { began, ended, spare });

/// Compares what the narrow phase found with where the contacts are. The schedule has all blocks of the graph.
pub(crate) fn find_changes(
    team: &Team,
    graph: &Graph,
    schedule: &Schedule,
    found: &mut Vec<Changes>,
    changes: &mut Changes,
) {
    changes.clear();
    let (runs, chunk) = schedule.runs(CHUNK);
    for found in team.map_chunks(runs.len(), chunk, found, |range, found| {
        found.clear();
        runs[range].iter().for_each(|run| found.look(graph, run));
    }) {
        changes.began.extend_from_slice(&found.began);
        changes.ended.extend_from_slice(&found.ended);
    }
    let Changes { began, ended, spare } = changes;
    sort_by_number(began, spare, |&contact| contact.into());
    sort_by_number(ended, spare, |&contact| contact.into());
}

impl Changes {
    pub(crate) fn clear(&mut self) {
        self.began.clear();
        self.ended.clear();
    }

    fn look(&mut self, graph: &Graph, run: &Run) {
        let bucket = &graph.buckets.list()[run.bucket];
        for block in run.blocks.clone() {
            let touching = bucket.heads[block].touching;
            let first = block * BLOCK;
            let lanes = (bucket.contacts.len() - first).min(BLOCK);
            let all = if lanes == BLOCK { u16::MAX } else { (1 << lanes) - 1 };
            let (changed, list) = if run.place == IDLE {
                (touching, &mut self.began)
            } else {
                (!touching & all, &mut self.ended)
            };
            push_lanes(changed, &bucket.contacts[first..first + lanes], list);
        }
    }
}

fn push_lanes(mut bits: u16, contacts: &[u32], list: &mut Vec<u32>) {
    while bits != 0 {
        list.push(contacts[bits.trailing_zeros() as usize]);
        bits &= bits - 1;
    }
}
