//! Contacts in the order of their bodies.
//!
//! Order within a colour changes no result. But the members of a team take the same parts of all colours, one after the
//! other: if neighbours in a colour are of neighbouring bodies, each works on bodies of its own, and what moves a body is
//! seldom far away in another core. As contacts come and go that order is lost: two threads took longer than one then.
//! So in each step the large buckets of one colour are sorted. With bodies that were added from left to right, say, it is an
//! order in space; with others it still keeps contacts of a body together.

use super::bodies::Bodies;
use super::coloured::{COLOURS, IDLE, Place, colour_at};
use super::contacts::Contacts;
use super::graph::{Bucket, Graph, place_at};
use crate::math::sort_by_number;

/// Buckets with fewer contacts are not shared out to much effect.
const MANY: usize = 128;

/// Lists that sorting fills anew; kept for their memory.
#[derive(Debug, Default)]
pub(crate) struct Tidy {
    /// Body in the upper half, slot in the lower.
    order: Vec<u64>,
    spare: Vec<u64>,
}

crate::footprint::footprint!(Tidy { order, spare });

impl Tidy {
    /// Sorts the buckets of one colour at all paces: of another one in each step. No block is fresh meanwhile.
    pub(crate) fn run(
        &mut self,
        step: u64,
        graph: &mut Graph,
        bodies: &Bodies,
        contacts: &mut Contacts,
    ) {
        let colour = (step % COLOURS as u64) as usize;
        for (key, bucket) in graph.buckets.entries_mut() {
            let place = place_at(key);
            if place != IDLE && colour_at(place) == colour && bucket.contacts.len() >= MANY {
                self.sort(bucket, place, bodies, contacts);
            }
        }
    }

    fn sort(
        &mut self,
        bucket: &mut Bucket,
        place: usize,
        bodies: &Bodies,
        contacts: &mut Contacts,
    ) {
        let Self { order, spare } = self;
        order.clear();
        order.extend((0..bucket.contacts.len()).map(|slot| {
            let (a, b) = bucket.bodies(slot);
            let body = if bodies.is_dynamic(a) { a } else { b };
            u64::from(body) << 32 | slot as u64
        }));
        if order.is_sorted() {
            return;
        }
        sort_by_number(order, spare, |&entry| entry);
        for start in 0..order.len() {
            move_round(bucket, order, start);
        }
        for (slot, &index) in (0..).zip(&bucket.contacts) {
            contacts.records[index as usize].place = Place::Graph { colour: place as u8, slot };
        }
        bucket.renew_flags(&contacts.records);
    }
}

/// Moves what is to go to a slot there, what is to go to where that was, and so on, until all of them are where they belong.
fn move_round(bucket: &mut Bucket, order: &mut [u64], start: usize) {
    let from = |entry: u64| entry as u32 as usize;
    if from(order[start]) == start {
        return;
    }
    let first = bucket.lift(start);
    let mut hole = start;
    loop {
        let next = from(core::mem::replace(&mut order[hole], hole as u64));
        if next == start {
            return bucket.lay(hole, &first);
        }
        bucket.lay(hole, &bucket.lift(next));
        hole = next;
    }
}
