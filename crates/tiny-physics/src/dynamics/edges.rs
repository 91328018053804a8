//! Lists of what hangs on a body, kept in the records themselves.
//!
//! A record between two bodies, a contact or a joint, is in the list of each. *Edge* `2 * index + side` is its
//! place in one of them: side 0 is that of body A. A body knows the first edge of each of its lists, the newest;
//! the record knows the edges before and behind.

use super::bodies::{Bodies, BodyInfo, NULL};
use crate::work;

/// A record between two bodies.
pub(crate) trait Edges {
    /// Bodies A and B.
    fn bodies(&self) -> [u32; 2];
    /// Neighbours in the lists of A and B: (previous, next) edges.
    fn links(&self) -> &[(u32, u32); 2];
    /// The same, to change.
    fn links_mut(&mut self) -> &mut [(u32, u32); 2];
    /// The first edge of a body's list of such records.
    fn first(info: &mut BodyInfo) -> &mut u32;
}

/// The edge behind another, or [`NULL`].
#[inline]
pub(crate) fn next_edge<R: Edges>(records: &[R], edge: u32) -> u32 {
    records[edge as usize / 2].links()[edge as usize % 2].1
}

/// The records of a list as (index, side), from its first edge on: the newest first.
#[inline]
pub(super) fn walk<R: Edges>(records: &[R], first: u32) -> impl Iterator<Item = (u32, u32)> + '_ {
    let edge = |edge: u32| (edge != NULL).then_some(edge);
    core::iter::successors(edge(first), move |&at| edge(next_edge(records, at)))
        .inspect(|_| work::note())
        .map(|edge| (edge / 2, edge % 2))
}

/// Puts a record at the head of both bodies' lists.
pub(super) fn link<R: Edges>(records: &mut [R], bodies: &mut Bodies, index: u32) {
    for (side, body) in records[index as usize].bodies().into_iter().enumerate() {
        let edge = index * 2 + side as u32;
        let head = core::mem::replace(R::first(&mut bodies.infos[body as usize]), edge);
        if head != NULL {
            links_of(records, head).0 = edge;
        }
        *links_of(records, edge) = (NULL, head);
    }
}

/// Takes a record out of both bodies' lists.
pub(super) fn unlink<R: Edges>(records: &mut [R], bodies: &mut Bodies, index: u32) {
    for (side, body) in records[index as usize].bodies().into_iter().enumerate() {
        let (previous, next) = records[index as usize].links()[side];
        if previous == NULL {
            *R::first(&mut bodies.infos[body as usize]) = next;
        } else {
            links_of(records, previous).1 = next;
        }
        if next != NULL {
            links_of(records, next).0 = previous;
        }
    }
}

fn links_of<R: Edges>(records: &mut [R], edge: u32) -> &mut (u32, u32) {
    &mut records[edge as usize / 2].links_mut()[edge as usize % 2]
}

/// Implements [`Edges`] for a record with the fields `body_a`, `body_b` and `links`; `first` is the field of
/// [`BodyInfo`] that holds the first edge.
macro_rules! edges {
    ($record:ident, $first:ident) => {
        impl $record {
            /// The body at the other end.
            #[inline]
            pub(crate) fn other(&self, body: u32) -> u32 {
                if self.body_a == body { self.body_b } else { self.body_a }
            }
        }

        impl crate::dynamics::edges::Edges for $record {
            fn bodies(&self) -> [u32; 2] {
                [self.body_a, self.body_b]
            }

            fn links(&self) -> &[(u32, u32); 2] {
                &self.links
            }

            fn links_mut(&mut self) -> &mut [(u32, u32); 2] {
                &mut self.links
            }

            fn first(info: &mut crate::dynamics::BodyInfo) -> &mut u32 {
                &mut info.$first
            }
        }
    };
}

pub(super) use edges;
