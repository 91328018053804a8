//! Contacts in the order of their bodies.
//!
//! Order within a colour changes no more than which others lie in the block of a contact that gets more rounds, and get them
//! too. But the members of a team take the same parts of all colours, one after the other: if neighbours in a colour are of
//! neighbouring bodies, each works on bodies of its own, and what moves a body is seldom far away in another core. As contacts
//! come and go that order is lost: two threads took longer than one then. So in each step the large buckets of one colour are
//! put in order again, roughly, so that few contacts have to move. With bodies that were added from left to right, say, it is
//! an order in space.

use super::blocks::{BlockHead, ConstraintBlock, LaneBlock, ManifoldBlock, SurfaceBlock, flags};
use super::bodies::Bodies;
use super::coloured::{COLOURS, IDLE, Place, colour_at};
use super::contacts::{Contact, Contacts};
use super::graph::{Bucket, Graph, contact_flags, place_at};
use crate::simd::BLOCK;

/// Buckets with fewer contacts are not shared out to much effect.
const MANY: usize = 128;
/// The first colour, the fullest, comes in a step in which nothing looks at all islands.
const OFF_BEAT: u64 = 4;
/// Parts that bodies are divided into.
const PARTS: usize = 32;

/// Lists that are filled anew; kept for their memory.
#[derive(Debug, Default)]
pub(crate) struct Tidy {
    /// Contacts that lie where those of another part belong: their own part in the upper half, their slot in the lower.
    astray: Vec<u64>,
    /// Their slots, ascending.
    slots: Vec<u32>,
}

crate::footprint::footprint!(Tidy { astray, slots });

impl Tidy {
    /// Puts the buckets of one colour in order, at all paces: of another one in each step. Comes before a narrow phase of all blocks.
    pub(crate) fn run(
        &mut self,
        step: u64,
        graph: &mut Graph,
        bodies: &Bodies,
        contacts: &mut Contacts,
    ) {
        let colour = ((step + OFF_BEAT) % COLOURS as u64) as usize;
        let part = |(a, b): (u32, u32)| {
            let [first, last] = [a.min(b), a.max(b)];
            let body = if bodies.is_dynamic(last) { last } else { first };
            body as usize * PARTS / bodies.infos.len()
        };
        for (key, bucket) in graph.buckets.entries_mut() {
            let place = place_at(key);
            if place != IDLE && colour_at(place) == colour && bucket.contacts.len() >= MANY {
                self.find(bucket, part);
                self.move_all(bucket, place, &mut contacts.records);
            }
        }
    }

    /// Finds what is astray. As much of a part is where others belong as of others is where it belongs, so the `k`th of those
    /// that are astray, sorted by part, goes to the `k`th of their slots.
    fn find(&mut self, bucket: &Bucket, part: impl Fn((u32, u32)) -> usize) {
        let Self { astray, slots } = self;
        astray.clear();
        slots.clear();
        let mut ends = [0; PARTS];
        (0..bucket.contacts.len()).for_each(|slot| ends[part(bucket.bodies(slot))] += 1);
        let mut slot = 0;
        for (here, count) in ends.into_iter().enumerate() {
            for _ in 0..count {
                let own = part(bucket.bodies(slot));
                if own != here {
                    astray.push((own as u64) << 32 | slot as u64);
                    slots.push(slot as u32);
                }
                slot += 1;
            }
        }
        astray.sort_unstable();
    }

    /// Moves what is to go to a slot there, what is to go to where that was, and so on, round by round.
    fn move_all(&mut self, bucket: &mut Bucket, place: usize, records: &mut [Contact]) {
        let Self { astray, slots } = self;
        let put = |bucket: &mut Bucket, slot: u32, lifted, records: &mut [Contact]| {
            let contact = &mut records[bucket.lay(slot, &lifted) as usize];
            contact.place = Place::Graph { colour: place as u8, slot };
        };
        for start in 0..slots.len() {
            let from = |entry: u64| entry as u32;
            if from(astray[start]) == slots[start] {
                continue;
            }
            let first = bucket.lift(slots[start], records);
            let mut hole = start;
            loop {
                let next = from(core::mem::replace(&mut astray[hole], slots[hole].into()));
                if next == slots[start] {
                    break put(bucket, slots[hole], first, records);
                }
                let lifted = bucket.lift(next, records);
                put(bucket, slots[hole], lifted, records);
                hole = slots.partition_point(|&slot| slot < next);
            }
        }
    }
}

/// What is at a slot of a bucket of contacts that touch: in the first lanes of blocks.
struct Lifted {
    contact: u32,
    manifold: ManifoldBlock,
    constraint: ConstraintBlock,
    surface: SurfaceBlock,
    head: BlockHead,
}

impl Bucket {
    /// A copy of what is at a slot of contacts that touch.
    fn lift(&self, slot: u32, records: &[Contact]) -> Lifted {
        let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
        let mut lifted = Lifted {
            contact: self.contacts[slot as usize],
            manifold: ManifoldBlock::NULL,
            constraint: ConstraintBlock::NULL,
            surface: SurfaceBlock::NULL,
            head: self.heads[block].lane(lane),
        };
        lifted.manifold.copy_lane(0, &self.manifolds[block], lane);
        lifted.constraint.copy_lane(0, &self.constraints[block], lane);
        lifted.surface.copy_lane(0, &self.surfaces[block], lane);
        // Its own: those of its block are of others, too.
        let of_record = contact_flags(&records[lifted.contact as usize]) & !flags::RESTS;
        let rests = lifted.surface.rest_1[0] > 0.0 || lifted.surface.rest_2[0] > 0.0;
        lifted.head.flags = of_record | if rests { flags::RESTS } else { 0 };
        lifted
    }

    /// Puts it down at another slot, in place of what is there. Gives its contact.
    fn lay(&mut self, slot: u32, lifted: &Lifted) -> u32 {
        let Lifted { contact, manifold, constraint, surface, head: from } = lifted;
        let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
        self.contacts[slot as usize] = *contact;
        self.manifolds[block].copy_lane(lane, manifold, 0);
        self.constraints[block].copy_lane(lane, constraint, 0);
        self.surfaces[block].copy_lane(lane, surface, 0);
        self.heads[block].copy_lane(lane, from, 0);
        *contact
    }
}
