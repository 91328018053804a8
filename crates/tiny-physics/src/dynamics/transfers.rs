//! Many contacts at once into the graph and out of it.
//!
//! Where each goes is decided one after the other, because colours depend on each other; copying them is left to
//! the team, a bucket to a chunk.

use super::bodies::Bodies;
use super::coloured::Place;
use super::contacts::{Contact, Contacts};
use super::graph::{Bucket, Graph, key, place_at};
use crate::math::sort_by_number;
use crate::threads::{SharedSlice, Team};
use core::ops::Range;

/// Fewer contacts than this are no reason to wake threads.
const MANY: usize = 128;

/// Lists that transfers fill anew; kept for their memory.
#[derive(Debug, Default)]
pub(crate) struct Transfers {
    /// Bucket in the upper half, slot in the lower.
    moves: Vec<u64>,
    spare: Vec<u64>,
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
                self.moves.push(to_move(place, contact, slot));
            }
        }
        if self.moves.is_empty() {
            return;
        }
        self.group();
        let records = &contacts.records;
        self.for_each_bucket(team, graph, |bucket, _, moves| {
            for slot in moves.iter().map(|&to_move| slot(to_move)) {
                bucket.fill(slot, &records[bucket.contacts[slot as usize] as usize]);
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
                self.moves.push(to_move(place, contact, slot));
            }
        }
        if self.moves.is_empty() {
            return;
        }
        self.group();
        let records = SharedSlice::new(&mut contacts.records);
        self.for_each_bucket(team, graph, |bucket, place, moves| {
            // From the last on: what moves into a hole is then none of those that are still to go.
            for &to_move in moves.iter().rev() {
                bucket.take_out(place, slot(to_move), records);
            }
        });
        for group in &self.groups {
            graph.buckets.close(bucket(self.moves[group.start]));
        }
    }

    /// Sorts the moves by bucket and slot.
    fn group(&mut self) {
        sort_by_number(&mut self.moves, &mut self.spare, |&to_move| to_move);
        self.groups.clear();
        let mut first = 0;
        for group in self.moves.chunk_by(|&a, &b| bucket(a) == bucket(b)) {
            self.groups.push(first..first + group.len());
            first += group.len();
        }
    }

    /// Calls `work` with each bucket that has moves, its place, and those.
    fn for_each_bucket(
        &self,
        team: &Team,
        graph: &mut Graph,
        work: impl Fn(&mut Bucket, usize, &[u64]) + Sync,
    ) {
        let Self { moves, groups, .. } = self;
        let chunk = if moves.len() < MANY { usize::MAX } else { 1 };
        let buckets = graph.buckets.share();
        team.for_each_chunk(groups.len(), chunk, |range| {
            for moves in groups[range].iter().map(|group| &moves[group.clone()]) {
                let key = bucket(moves[0]);
                buckets.update(key, |bucket| work(bucket, place_at(key), moves));
            }
        });
    }
}

fn to_move(place: usize, contact: &Contact, slot: u32) -> u64 {
    (key(place, contact.class) as u64) << 32 | u64::from(slot)
}

fn bucket(to_move: u64) -> usize {
    (to_move >> 32) as usize
}

fn slot(to_move: u64) -> u32 {
    to_move as u32
}
