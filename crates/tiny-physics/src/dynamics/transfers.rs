//! Many contacts at once into the graph and out of it.
//!
//! Where each goes is decided one after the other, because colours depend on each other; copying them is left to
//! the team, a bucket to a chunk.

use super::bodies::Bodies;
use super::coloured::Place;
use super::contacts::Contacts;
use super::graph::{Bucket, Graph, key, place_at};
use crate::math::sort_by_number;
use crate::threads::{SharedSlice, Team};
use core::ops::Range;

/// Fewer contacts than this are no reason to wake threads.
const MANY: usize = 128;

/// Lists that transfers fill anew; kept for their memory.
#[derive(Debug, Default)]
pub(crate) struct Transfers {
    /// Bucket, slot, contact.
    moves: Vec<(u32, u32, u32)>,
    spare: Vec<(u32, u32, u32)>,
    /// The moves of each bucket.
    groups: Vec<Range<usize>>,
}

crate::footprint::footprint!(Transfers { moves, spare, groups });

impl Transfers {
    /// Puts contacts into the graph, in this order: each into a colour if it touches, else among the idle ones.
    /// Those that are in it already stay where they are.
    pub(crate) fn insert(
        &mut self,
        team: &Team,
        graph: &mut Graph,
        bodies: &mut Bodies,
        contacts: &mut Contacts,
        indices: impl Iterator<Item = u32>,
    ) {
        self.moves.clear();
        for index in indices {
            let contact = &mut contacts.records[index as usize];
            if contact.place == Place::Asleep {
                let (place, slot) = graph.admit(bodies, contact, index);
                self.moves.push((key(place, contact.class) as u32, slot, index));
            }
        }
        self.group();
        let records = &contacts.records;
        self.for_each_bucket(team, graph, |bucket, _, moves| {
            for &(_, slot, index) in moves {
                bucket.fill(slot, &records[index as usize]);
            }
        });
    }

    /// Takes contacts out of the graph, those that are in it; their records keep their impulses.
    pub(crate) fn remove(
        &mut self,
        team: &Team,
        graph: &mut Graph,
        bodies: &mut Bodies,
        contacts: &mut Contacts,
        indices: impl Iterator<Item = u32>,
    ) {
        self.moves.clear();
        for index in indices {
            let contact = &contacts.records[index as usize];
            if let Some((place, slot)) = graph.dismiss(bodies, contact) {
                self.moves.push((key(place, contact.class) as u32, slot, index));
            }
        }
        self.group();
        let records = SharedSlice::new(&mut contacts.records);
        self.for_each_bucket(team, graph, |bucket, place, moves| {
            // From the last on: what moves into a hole is then none of those that are still to go.
            for &(_, slot, _) in moves.iter().rev() {
                bucket.take_out(place, slot, records);
            }
        });
        for group in &self.groups {
            graph.buckets.close(self.moves[group.start].0 as usize);
        }
    }

    /// Sorts the moves by bucket and slot.
    fn group(&mut self) {
        sort_by_number(&mut self.moves, &mut self.spare, |&(bucket, slot, _)| {
            u64::from(bucket) << 32 | u64::from(slot)
        });
        self.groups.clear();
        let mut first = 0;
        for group in self.moves.chunk_by(|a, b| a.0 == b.0) {
            self.groups.push(first..first + group.len());
            first += group.len();
        }
    }

    /// Calls `work` with each bucket that has moves, its place, and those.
    fn for_each_bucket(
        &self,
        team: &Team,
        graph: &mut Graph,
        work: impl Fn(&mut Bucket, usize, &[(u32, u32, u32)]) + Sync,
    ) {
        let Self { moves, groups, .. } = self;
        let chunk = if moves.len() < MANY { usize::MAX } else { 1 };
        let buckets = graph.buckets.share();
        team.for_each_chunk(groups.len(), chunk, |range| {
            for moves in groups[range].iter().map(|group| &moves[group.clone()]) {
                let key = moves[0].0 as usize;
                buckets.update(key, |bucket| work(bucket, place_at(key), moves));
            }
        });
    }
}
