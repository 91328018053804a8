//! The constraint graph: contacts in colours, so that no two of a colour share a moving body.
//!
//! See [`coloured`](super::coloured). Contacts that do not touch wait in a place of their own ([`IDLE`]) that the narrow
//! phase visits and the solver does not. Inside a place, contacts lie in buckets by pair class, so a block is of one
//! kind.

use super::blocks::{
    BlockHead, ConstraintBlock, LaneBlock, ManifoldBlock, PointLanes, SurfaceBlock, flags,
    load_lanes, move_lane, save_lanes,
};
use super::bodies::{Bodies, NULL};
use super::body_rows::Slot;
use super::coloured::{Bucketful, Coloured, IDLE, Place, give_colour_back, place_of, take_colour};
use super::contacts::{Contact, Contacts, SavedPoint};
use crate::codec::{Data, Reader, Sink, clone_by_field, store};
use crate::error::Error;
use crate::footprint::{Footprint, MemoryUse, each, footprint};
use crate::geometry::manifold::PairClass;
use crate::math::Vec2;
use crate::simd::{BLOCK, Row};
use crate::threads::SharedSlice;
use core::ops::Range;

/// Contacts of one colour and class.
#[derive(Debug, PartialEq, Default)]
pub(crate) struct Bucket {
    /// Contact index of each slot.
    pub(crate) contacts: Vec<u32>,
    pub(crate) manifolds: Vec<ManifoldBlock>,
    /// As long as `manifolds`, but empty in the idle colour.
    pub(crate) constraints: Vec<ConstraintBlock>,
    pub(crate) surfaces: Vec<SurfaceBlock>,
    pub(crate) heads: Vec<BlockHead>,
}

clone_by_field!(Bucket { contacts, manifolds, constraints, surfaces, heads });
footprint!(Bucket { contacts, manifolds, constraints, surfaces, heads });

impl Bucketful for Bucket {
    fn is_empty(&self) -> bool {
        self.contacts.is_empty()
    }
}

impl Bucket {
    /// The two bodies of a slot.
    #[inline]
    pub(crate) fn bodies(&self, slot: usize) -> (u32, u32) {
        let block = &self.manifolds[slot / BLOCK];
        (block.body_a[slot % BLOCK], block.body_b[slot % BLOCK])
    }

    /// Does the contact of a lane touch?
    pub(crate) fn touches(&self, block: usize, lane: usize) -> bool {
        self.heads[block].touching >> lane & 1 != 0
    }

    /// Makes room for a contact and gives its slot.
    fn reserve(&mut self, index: u32, constrained: bool) -> u32 {
        let slot = self.contacts.len();
        self.contacts.push(index);
        if slot.is_multiple_of(BLOCK) {
            if slot == 0 {
                // Most buckets of small worlds have one block: lists that begin with four would hold three in vain.
                self.manifolds.reserve_exact(1);
                self.surfaces.reserve_exact(usize::from(constrained));
                self.heads.reserve_exact(1);
            }
            self.manifolds.push(ManifoldBlock::NULL);
            self.heads.push(BlockHead::default());
            if constrained {
                self.constraints.push(ConstraintBlock::NULL);
                self.surfaces.push(SurfaceBlock::NULL);
            }
        }
        slot as u32
    }

    /// Writes a contact into its slot.
    pub(super) fn fill(&mut self, slot: u32, contact: &Contact) {
        let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
        let manifold = &mut self.manifolds[block];
        manifold.body_a[lane] = contact.body_a;
        manifold.body_b[lane] = contact.body_b;
        manifold.shape_a[lane] = contact.shape_a;
        manifold.shape_b[lane] = contact.shape_b;
        manifold.id_1[lane] = contact.saved[0].id;
        manifold.id_2[lane] = contact.saved[1].id;
        self.heads[block].touching |= u16::from(contact.touching) << lane;
        if !self.constraints.is_empty() {
            self.fill_constraint(block, lane, contact);
        }
        self.write_materials(slot, contact);
    }

    /// Writes what a contact has of the materials of its shapes into its slot.
    fn write_materials(&mut self, slot: u32, contact: &Contact) {
        let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
        self.manifolds[block].friction[lane] = contact.friction;
        if let Some(surface) = self.surfaces.get_mut(block) {
            surface.restitution[lane] = contact.restitution;
            surface.rolling_resistance[lane] = contact.rolling_resistance;
            surface.tangent_speed[lane] = contact.tangent_speed;
            self.heads[block].flags |= contact_flags(contact);
        }
    }

    fn fill_constraint(&mut self, block: usize, lane: usize, contact: &Contact) {
        let constraint = &mut self.constraints[block];
        constraint.copy_lane(lane, &ConstraintBlock::NULL, 0);
        constraint.body_a[lane] = contact.body_a;
        constraint.body_b[lane] = contact.body_b;
        for (point, saved) in constraint.points.iter_mut().zip(contact.saved) {
            let push = saved.normal_impulse;
            (point.normal_impulse[lane], point.load[lane]) = (push, push);
            point.tangent_impulse[lane] = saved.tangent_impulse;
        }
        let surface = &mut self.surfaces[block];
        surface.copy_lane(lane, &SurfaceBlock::NULL, 0);
        surface.rest_1[lane] = contact.saved[0].rest;
        surface.rest_2[lane] = contact.saved[1].rest;
        surface.rolling_impulse[lane] = 0.0;
    }

    /// Takes a slot out; the last one moves into it. Gives the contact that moved, if one did.
    fn swap_remove(&mut self, slot: u32) -> Option<u32> {
        let last = self.contacts.len() - 1;
        let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
        let (last_block, last_lane) = (last / BLOCK, last % BLOCK);
        self.contacts.swap_remove(slot as usize);
        let (to, from) = ((block, lane), (last_block, last_lane));
        move_lane(&mut self.manifolds, to, from);
        if !self.constraints.is_empty() {
            move_lane(&mut self.constraints, to, from);
            move_lane(&mut self.surfaces, to, from);
        }
        let last_head = self.heads[last_block];
        self.heads[block].copy_lane(lane, &last_head, last_lane);
        let last_head = &mut self.heads[last_block];
        for bits in [&mut last_head.touching, &mut last_head.jointed_a, &mut last_head.jointed_b] {
            *bits &= !(1 << last_lane);
        }
        if last_lane == 0 {
            self.manifolds.pop();
            self.constraints.pop();
            self.surfaces.pop();
            self.heads.pop();
        }
        self.contacts.get(slot as usize).copied()
    }

    /// Takes the contact at a slot out, which keeps its impulses in its record.
    pub(super) fn take_out(&mut self, place: usize, slot: u32, records: SharedSlice<'_, Contact>) {
        records.update(self.contacts[slot as usize], |contact| {
            contact.saved = self.saved(slot);
            contact.place = Place::Asleep;
        });
        if let Some(moved) = self.swap_remove(slot) {
            let place = Place::Graph { colour: place as u8, slot };
            records.update(moved, |contact| contact.place = place);
        }
    }

    /// The impulses of a slot, to be kept while the contact is elsewhere.
    fn saved(&self, slot: u32) -> [SavedPoint; 2] {
        let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
        let Some(constraint) = self.constraints.get(block) else {
            return [SavedPoint::NONE; 2];
        };
        let (manifold, surface) = (&self.manifolds[block], &self.surfaces[block]);
        let point = |k: usize, id: f32, rest: f32| SavedPoint {
            id,
            normal_impulse: constraint.points[k].normal_impulse[lane],
            tangent_impulse: constraint.points[k].tangent_impulse[lane],
            rest,
        };
        [
            point(0, manifold.id_1[lane], surface.rest_1[lane]),
            point(1, manifold.id_2[lane], surface.rest_2[lane]),
        ]
    }
}

pub(super) fn contact_flags(contact: &Contact) -> u8 {
    let flag = |set: bool, flag: u8| if set { flag } else { 0 };
    flag(contact.restitution > 0.0, flags::RESTITUTION)
        | flag(contact.rolling_resistance > 0.0, flags::ROLLING)
        | flag(contact.tangent_speed != 0.0, flags::TANGENT_SPEED)
        | flag(contact.hit_events, flags::HIT)
        | flag(contact.saved.iter().any(|point| point.rest > 0.0), flags::RESTS)
}

/// Blocks of one bucket that are worked on together.
pub(crate) struct Blocks<'a> {
    /// Contacts in these blocks; the last block may be part full.
    pub(crate) contacts: &'a [u32],
    pub(crate) manifolds: &'a mut [ManifoldBlock],
    pub(crate) heads: &'a mut [BlockHead],
    /// Empty for contacts that do not touch.
    pub(crate) constraints: &'a mut [ConstraintBlock],
    pub(crate) surfaces: &'a mut [SurfaceBlock],
}

impl Bucket {
    /// Writes and gives the speeds along the normal at the points of a lane, which the narrow phase does only for blocks that bounce or
    /// whose impulses are summed up.
    pub(crate) fn note_approach(
        &mut self,
        rows: &[Row],
        (block, lane): (usize, usize),
    ) -> [f32; 2] {
        let (constraint, surface) = (&self.constraints[block], &mut self.surfaces[block]);
        let [a, b] = [constraint.body_a, constraint.body_b].map(|body| &rows[body[lane] as usize]);
        let along = constraint.normal_x[lane] * (b[Slot::VX] - a[Slot::VX])
            + constraint.normal_y[lane] * (b[Slot::VY] - a[Slot::VY]);
        let approach = [0, 1].map(|k| {
            let point = &constraint.points[k];
            along + point.normal_arm_b[lane] * b[Slot::W] - point.normal_arm_a[lane] * a[Slot::W]
        });
        (surface.approach_1[lane], surface.approach_2[lane]) = (approach[0], approach[1]);
        (surface.total_1[lane], surface.total_2[lane]) = (0.0, 0.0);
        approach
    }

    /// Some of its blocks.
    #[inline(always)]
    pub(super) fn blocks(&mut self, range: Range<usize>) -> Blocks<'_> {
        let Self { contacts, manifolds, heads, constraints, surfaces } = self;
        let end = contacts.len().min(range.end * BLOCK);
        let solved = if constraints.is_empty() { 0..0 } else { range.clone() };
        Blocks {
            contacts: &contacts[range.start * BLOCK..end],
            manifolds: &mut manifolds[range.clone()],
            heads: &mut heads[range],
            constraints: &mut constraints[solved.clone()],
            surfaces: &mut surfaces[solved],
        }
    }
}

/// A bucket, shared between members of the team.
#[derive(Clone, Copy)]
pub(crate) struct Shared<'a> {
    contacts: &'a [u32],
    manifolds: SharedSlice<'a, ManifoldBlock>,
    heads: SharedSlice<'a, BlockHead>,
    constraints: SharedSlice<'a, ConstraintBlock>,
    surfaces: SharedSlice<'a, SurfaceBlock>,
}

impl<'a> Shared<'a> {
    #[inline]
    pub(super) fn new(bucket: &'a mut Bucket) -> Self {
        Self {
            contacts: &bucket.contacts,
            manifolds: SharedSlice::new(&mut bucket.manifolds),
            heads: SharedSlice::new(&mut bucket.heads),
            constraints: SharedSlice::new(&mut bucket.constraints),
            surfaces: SharedSlice::new(&mut bucket.surfaces),
        }
    }

    #[inline]
    pub(super) fn blocks(self, range: Range<usize>) -> Blocks<'a> {
        let end = self.contacts.len().min(range.end * BLOCK);
        Blocks {
            contacts: &self.contacts[range.start * BLOCK..end],
            manifolds: self.manifolds.range(range.clone()),
            heads: self.heads.range(range.clone()),
            constraints: self.constraints.range(range.clone()),
            surfaces: self.surfaces.range(range),
        }
    }
}

/// Where a block is: place, class, index.
pub(crate) type BlockAddress = (u8, u8, u32);

/// The key of a bucket.
pub(super) fn key(place: usize, class: PairClass) -> usize {
    place * PairClass::COUNT + class as usize
}

/// The approach of a contact that bounces only after others of its bodies.
pub(crate) const HELD: f32 = f32::MAX;

/// The place of a key.
pub(super) fn place_at(key: usize) -> usize {
    key / PairClass::COUNT
}

store! {
    /// All contacts of bodies that are awake.
    #[derive(Debug, PartialEq, Default)]
    pub(crate) struct Graph {
        /// By place and class: see [`key`].
        pub(crate) buckets: Coloured<Bucket>,
        touching: usize as derived,
        /// Blocks that got a touching contact since the last narrow phase: those of the step at work.
        fresh: Vec<BlockAddress> as derived,
        /// A contact has come in that joins bodies of different paces.
        pub(crate) mixed: bool,
        /// Contacts between dynamic bodies that have come in since the paces were last assigned.
        pub(crate) news: u32,
    }
    load with Graph::count_touching
}

impl Data for Bucket {
    const HEAP: bool = true;

    fn save(&self, sink: &mut Sink) {
        let Self { contacts, manifolds, constraints, surfaces, heads } = self;
        contacts.save(sink);
        save_lanes(manifolds, contacts.len(), sink);
        save_lanes(constraints, contacts.len(), sink);
        save_lanes(surfaces, contacts.len(), sink);
        heads.save(sink);
    }

    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Ok(Self {
            contacts: Data::load(reader)?,
            manifolds: load_lanes(reader)?,
            constraints: load_lanes(reader)?,
            surfaces: load_lanes(reader)?,
            heads: Data::load(reader)?,
        })
    }

    fn memory(&self) -> MemoryUse {
        self.footprint()
    }
}

impl Graph {
    fn count_touching(&mut self) -> Result<(), Error> {
        self.touching = self.touching_buckets().map(|(_, bucket)| bucket.contacts.len()).sum();
        Ok(())
    }

    /// All buckets, each with its place and class.
    pub(crate) fn all(&self) -> impl Iterator<Item = (usize, PairClass, &Bucket)> {
        let keys = self.buckets.keys().map(|key| (place_at(key), key % PairClass::COUNT));
        keys.zip(self.buckets.list())
            .map(|((place, class), bucket)| (place, PairClass::ALL[class], bucket))
    }

    /// The buckets of contacts that touch, each with its place.
    pub(crate) fn touching_buckets(&self) -> impl Iterator<Item = (usize, &Bucket)> {
        self.all().map(|(place, _, bucket)| (place, bucket)).take_while(|&(place, _)| place != IDLE)
    }

    /// The same, to change.
    pub(crate) fn touching_buckets_mut(&mut self) -> impl Iterator<Item = (usize, &mut Bucket)> {
        let all = self.buckets.entries_mut().map(|(key, bucket)| (place_at(key), bucket));
        all.take_while(|&(place, _)| place != IDLE)
    }

    /// The buckets of contacts that touch at a pace.
    pub(crate) fn of_pace(&self, pace: usize) -> &[Bucket] {
        &self.buckets.list()[self.range_of_pace(pace)]
    }

    /// Where in the list those are.
    pub(crate) fn range_of_pace(&self, pace: usize) -> Range<usize> {
        let [start, end] = [pace, pace + 1].map(|pace| key(place_of(pace, 0), PairClass::ALL[0]));
        self.buckets.range(start..end)
    }

    /// The bucket of a place and class, if that has contacts.
    pub(crate) fn find(&self, place: usize, class: PairClass) -> Option<&Bucket> {
        self.buckets.get(key(place, class))
    }

    /// The bucket of a place and class that has contacts.
    pub(crate) fn bucket(&self, place: usize, class: PairClass) -> &Bucket {
        &self.buckets[key(place, class)]
    }

    /// The same, to change.
    pub(crate) fn bucket_mut(&mut self, place: usize, class: PairClass) -> &mut Bucket {
        &mut self.buckets[key(place, class)]
    }

    /// Contacts in the graph, touching or not.
    pub(crate) fn len(&self) -> usize {
        self.buckets.list().iter().map(|bucket| bucket.contacts.len()).sum()
    }

    /// Forgets what the next narrow phase finds anew for every contact, whatever comes before it.
    pub(crate) fn forget_geometry(&mut self) {
        for block in self.buckets.list_mut().iter_mut().flat_map(|bucket| &mut bucket.constraints) {
            (block.normal_x, block.normal_y) = Default::default();
            for point in &mut block.points {
                let PointLanes { normal_impulse, tangent_impulse, load, .. } = *point;
                *point = PointLanes { normal_impulse, tangent_impulse, load, ..PointLanes::NULL };
            }
        }
    }

    /// Memory of the constraints alone: what every pass of the solver goes through.
    pub(crate) fn constraints_footprint(&self) -> MemoryUse {
        each(self.buckets.list().iter().map(|bucket| &bucket.constraints))
    }

    /// Contacts that touch and are awake.
    pub(crate) fn touching_count(&self) -> usize {
        self.touching
    }

    /// Puts a contact into the graph: into a colour if it touches, else among the idle ones.
    pub(crate) fn insert(&mut self, bodies: &mut Bodies, contacts: &mut Contacts, index: u32) {
        let contact = &mut contacts.records[index as usize];
        let (place, slot) = self.admit(bodies, contact, index);
        self.buckets[key(place, contact.class)].fill(slot, contact);
    }

    /// Chooses where a contact goes and makes room for it there.
    pub(super) fn admit(
        &mut self,
        bodies: &mut Bodies,
        contact: &mut Contact,
        index: u32,
    ) -> (usize, u32) {
        debug_assert_eq!(contact.place, Place::Asleep);
        let place = if contact.touching {
            self.touching += 1;
            let (a, b) = (contact.body_a, contact.body_b);
            self.mixed |=
                bodies.are_mixed(a, b) || [a, b].into_iter().any(|i| bodies.hangs_loose(i));
            let both_move = bodies.is_dynamic(a) && bodies.is_dynamic(b);
            let joined = [a, b].into_iter().any(|i| bodies.infos[i as usize].first_joint != NULL);
            self.news = self.news.saturating_add(u32::from(both_move | joined));
            let colour = take_colour(bodies, [a, b], |info| &mut info.contact_colours);
            place_of(bodies.common_pace(a, b), colour)
        } else {
            IDLE
        };
        let bucket = self.buckets.open(key(place, contact.class));
        let slot = bucket.reserve(index, place != IDLE);
        contact.place = Place::Graph { colour: place as u8, slot };
        if place != IDLE {
            self.fresh.push((place as u8, contact.class as u8, slot / BLOCK as u32));
        }
        (place, slot)
    }

    /// Brings what a contact's lane has of the materials of its shapes up to date.
    pub(crate) fn write_materials(&mut self, contact: &Contact) {
        if let Place::Graph { colour, slot } = contact.place {
            self.bucket_mut(colour.into(), contact.class).write_materials(slot, contact);
        }
    }

    /// What the narrow phase, or [`Self::mark_touching`], said last.
    pub(crate) fn touches(&self, contact: &Contact) -> bool {
        self.lane_of(contact).is_some_and(|(bucket, block, lane)| bucket.touches(block, lane))
    }

    /// Bucket, block and lane of a contact.
    pub(crate) fn lane_of(&self, contact: &Contact) -> Option<(&Bucket, usize, usize)> {
        let Place::Graph { colour, slot } = contact.place else { return None };
        let bucket = self.bucket(colour.into(), contact.class);
        Some((bucket, slot as usize / BLOCK, slot as usize % BLOCK))
    }

    /// Says that a contact touches or not, whatever the narrow phase said: its block is fresh.
    pub(crate) fn mark_touching(&mut self, contact: &Contact, touches: bool) {
        let Place::Graph { colour, slot } = contact.place else { return };
        let (block, lane) = (slot / BLOCK as u32, slot as usize % BLOCK);
        let bucket = self.bucket_mut(colour.into(), contact.class);
        let touching = &mut bucket.heads[block as usize].touching;
        *touching = *touching & !(1 << lane) | u16::from(touches) << lane;
        if colour as usize != IDLE {
            self.fresh.push((colour, contact.class as u8, block));
        }
    }

    /// The block and lane in which a contact is solved.
    pub(crate) fn solved(&self, contact: &Contact) -> Option<(&ConstraintBlock, usize)> {
        let (bucket, slot) = self.solved_at(contact)?;
        Some((&self.buckets.list()[bucket].constraints[slot / BLOCK], slot % BLOCK))
    }

    /// The same, to change.
    pub(crate) fn solved_mut(
        &mut self,
        contact: &Contact,
    ) -> Option<(&mut ConstraintBlock, usize)> {
        let (bucket, slot) = self.solved_at(contact)?;
        Some((&mut self.buckets.list_mut()[bucket].constraints[slot / BLOCK], slot % BLOCK))
    }

    /// The greatest impulse that a point of a contact carries.
    pub(crate) fn impulse(&self, contact: &Contact) -> f32 {
        self.solved(contact).map_or(0.0, |(constraint, lane)| {
            constraint.points.iter().map(|point| point.normal_impulse[lane]).fold(0.0, f32::max)
        })
    }

    /// From A to B, of a contact that touched in the last narrow phase and before it.
    pub(crate) fn normal(&self, contact: &Contact) -> Option<Vec2> {
        let (constraint, lane) = self.solved(contact)?;
        Some(Vec2::new(constraint.normal_x[lane], constraint.normal_y[lane]))
    }

    /// Lists the contacts that the narrow phase found to close in fast, in no order, and takes their marks away.
    pub(crate) fn take_closing(&mut self, candidates: &mut Vec<u32>) {
        for bucket in self.buckets.list_mut() {
            for (block, head) in bucket.heads.iter_mut().enumerate() {
                let mut lanes = core::mem::take(&mut head.closing);
                while lanes != 0 {
                    candidates
                        .push(bucket.contacts[block * BLOCK + lanes.trailing_zeros() as usize]);
                    lanes &= lanes - 1;
                }
            }
        }
    }

    /// Multiplies all impulses.
    pub(crate) fn scale(&mut self, factor: f32) {
        for bucket in self.buckets.list_mut() {
            let surfaces = bucket.surfaces.iter_mut().map(|block| &mut block.rolling_impulse);
            let points = bucket.constraints.iter_mut().flat_map(|block| &mut block.points);
            let points = points.flat_map(|point| {
                [&mut point.normal_impulse, &mut point.tangent_impulse, &mut point.load]
            });
            points.chain(surfaces).flatten().for_each(|impulse| *impulse *= factor);
        }
    }

    /// Has the impulses of a contact summed up in this step.
    pub(crate) fn watch(&mut self, contact: &Contact) {
        if let Some((bucket, slot)) = self.solved_at(contact) {
            self.buckets.list_mut()[bucket].heads[slot / BLOCK].flags |= flags::WATCHED;
        }
    }

    /// Has a contact that is watched bounce only after others of its bodies.
    pub(crate) fn hold_back(&mut self, contact: &Contact) {
        if let Some((bucket, slot)) = self.solved_at(contact) {
            let surface = &mut self.buckets.list_mut()[bucket].surfaces[slot / BLOCK];
            (surface.approach_1[slot % BLOCK], surface.approach_2[slot % BLOCK]) = (HELD, HELD);
        }
    }

    /// Has it bounce as its bodies move, after all; gives the speeds at its points.
    pub(crate) fn let_go(&mut self, contact: &Contact, rows: &[Row]) -> Option<[f32; 2]> {
        let (bucket, slot) = self.solved_at(contact)?;
        let at = (slot / BLOCK, slot % BLOCK);
        Some(self.buckets.list_mut()[bucket].note_approach(rows, at))
    }

    /// Did a contact that was watched push in this step?
    pub(crate) fn has_pushed(&self, contact: &Contact) -> bool {
        self.solved_at(contact).is_some_and(|(bucket, slot)| {
            let surface = &self.buckets.list()[bucket].surfaces[slot / BLOCK];
            let lane = slot % BLOCK;
            surface.total_1[lane] > 0.0 || surface.total_2[lane] > 0.0
        })
    }

    /// Where a contact is that the solver visits: bucket in the list, and slot.
    pub(crate) fn solved_at(&self, contact: &Contact) -> Option<(usize, usize)> {
        match contact.place {
            Place::Graph { colour, slot } if colour as usize != IDLE => {
                Some((self.buckets.position(key(colour.into(), contact.class)), slot as usize))
            }
            _ => None,
        }
    }

    /// Forgets which blocks are fresh: the narrow phase has visited them, or is about to visit all.
    pub(crate) fn clear_fresh(&mut self) {
        self.fresh.clear();
    }

    /// Sorts the blocks whose constraints are not written yet, and drops those that are no longer there.
    pub(crate) fn sort_fresh(&mut self) {
        let Self { buckets, fresh, .. } = self;
        fresh.sort_unstable();
        fresh.dedup();
        fresh.retain(|&(place, class, block)| {
            let bucket = buckets.get(usize::from(place) * PairClass::COUNT + usize::from(class));
            bucket.is_some_and(|bucket| (block as usize) < bucket.manifolds.len())
        });
    }

    /// The blocks whose constraints are not written yet.
    pub(crate) fn fresh(&self) -> &[BlockAddress] {
        &self.fresh
    }

    /// Takes a contact out of the graph, if it is there, and saves its impulses in the record.
    pub(crate) fn remove(&mut self, bodies: &mut Bodies, contacts: &mut Contacts, index: u32) {
        let contact = &contacts.records[index as usize];
        if let Some((place, slot)) = self.dismiss(bodies, contact) {
            let class = contact.class;
            let key = key(place, class);
            self.buckets[key].take_out(place, slot, SharedSlice::new(&mut contacts.records));
            self.buckets.close(key);
        }
    }

    /// Gives back the colour of a contact that is about to leave. Says where it is, if it is in the graph.
    pub(super) fn dismiss(
        &mut self,
        bodies: &mut Bodies,
        contact: &Contact,
    ) -> Option<(usize, u32)> {
        let Place::Graph { colour, slot } = contact.place else { return None };
        let place = usize::from(colour);
        if place != IDLE {
            self.touching -= 1;
            let ends = [contact.body_a, contact.body_b];
            give_colour_back(bodies, ends, place, |info| &mut info.contact_colours);
            // What moves into the hole may come from a fresh block.
            if !self.fresh.is_empty() {
                self.fresh.push((place as u8, contact.class as u8, slot / BLOCK as u32));
            }
        }
        Some((place, slot))
    }
}
