//! The constraint graph: contacts in colours, so that no two of a colour share a moving body.
//!
//! Within a colour the order of work cannot matter, so lanes and threads do not change results. A
//! contact keeps its colour while it touches; colours are given first-fit in the order of contact
//! ids, so they depend on the history of the world alone. Contacts between two dynamic bodies take
//! the lowest free colour, contacts with a body that nothing moves take the highest: those are solved
//! last and so hold best. What finds no colour goes to the overflow, solved one by one with the
//! one-lane instance of the same kernel. Contacts that do not touch wait in a colour of their own
//! (`IDLE`) that the narrow phase visits and the solver does not.
//!
//! Inside a colour, contacts lie in buckets by pair class, so a block is of one kind.

use super::blocks::{
    BlockHead, ConstraintBlock, LaneBlock, ManifoldBlock, SurfaceBlock, flags, move_lane,
};
use super::bodies::Bodies;
use super::clone::clone_by_field;
use super::contacts::{Contact, Contacts, Place, SavedPoint};
use super::pace::PACES;
use crate::codec::{Data, Reader, Sink};
use crate::error::Error;
use crate::footprint::{Footprint, MemoryUse, each, footprint};
use crate::geometry::manifold::PairClass;
use crate::simd::BLOCK;
use crate::threads::SharedSlice;

/// Number of colours.
pub(crate) const COLOURS: usize = 24;
/// Places of one pace: its colours and, last, its overflow.
const PER_PACE: usize = COLOURS + 1;
/// Place of the contacts that do not touch, after those of all paces.
pub(crate) const IDLE: usize = PER_PACE * PACES;

/// The colour at a place below [`IDLE`], or [`COLOURS`] for an overflow.
pub(crate) fn colour_at(place: usize) -> usize {
    place % PER_PACE
}

/// Is a place an overflow, whose contacts may have bodies in common?
pub(crate) fn is_overflow(place: usize) -> bool {
    place != IDLE && colour_at(place) == COLOURS
}

/// The places of a pace in the order in which they are solved: the overflow, then the colours.
pub(crate) fn places_of(pace: usize) -> impl Iterator<Item = usize> {
    core::iter::once(COLOURS).chain(0..COLOURS).map(move |colour| pace * PER_PACE + colour)
}

/// The pace of a place below [`IDLE`].
pub(crate) fn pace_at(place: usize) -> usize {
    place / PER_PACE
}

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

impl Bucket {
    /// The two bodies of a slot.
    #[inline]
    pub(crate) fn bodies(&self, slot: usize) -> (u32, u32) {
        let block = &self.manifolds[slot / BLOCK];
        (block.body_a[slot % BLOCK], block.body_b[slot % BLOCK])
    }

    /// Makes room for a contact and gives its slot.
    fn reserve(&mut self, index: u32, constrained: bool) -> u32 {
        let slot = self.contacts.len();
        self.contacts.push(index);
        if slot.is_multiple_of(BLOCK) {
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
        manifold.friction[lane] = contact.friction;
        manifold.id_1[lane] = contact.saved[0].id;
        manifold.id_2[lane] = contact.saved[1].id;
        self.heads[block].touching |= u16::from(contact.touching) << lane;
        if !self.constraints.is_empty() {
            self.fill_constraint(block, lane, contact);
        }
    }

    fn fill_constraint(&mut self, block: usize, lane: usize, contact: &Contact) {
        let constraint = &mut self.constraints[block];
        constraint.body_a[lane] = contact.body_a;
        constraint.body_b[lane] = contact.body_b;
        for (point, saved) in constraint.points.iter_mut().zip(contact.saved) {
            point.normal_impulse[lane] = saved.normal_impulse;
            point.tangent_impulse[lane] = saved.tangent_impulse;
        }
        let surface = &mut self.surfaces[block];
        surface.restitution[lane] = contact.restitution;
        surface.rolling_resistance[lane] = contact.rolling_resistance;
        surface.tangent_speed[lane] = contact.tangent_speed;
        surface.rolling_impulse[lane] = 0.0;
        self.heads[block].flags |= contact_flags(contact);
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
        let touching = last_head.touching >> last_lane & 1;
        let head = &mut self.heads[block];
        head.touching = head.touching & !(1 << lane) | touching << lane;
        head.flags |= last_head.flags;
        self.heads[last_block].touching &= !(1 << last_lane);
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

    /// The impulses of all slots, in order; nothing for contacts that do not touch.
    pub(crate) fn saved_points(&self) -> impl Iterator<Item = [SavedPoint; 2]> + '_ {
        let count = if self.constraints.is_empty() { 0 } else { self.contacts.len() };
        (0..count as u32).map(|slot| self.saved(slot))
    }

    /// The impulses of a slot, to be kept while the contact is elsewhere.
    fn saved(&self, slot: u32) -> [SavedPoint; 2] {
        let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
        let Some(constraint) = self.constraints.get(block) else {
            return [SavedPoint::NONE; 2];
        };
        let manifold = &self.manifolds[block];
        let point = |k: usize, id: f32| SavedPoint {
            id,
            normal_impulse: constraint.points[k].normal_impulse[lane],
            tangent_impulse: constraint.points[k].tangent_impulse[lane],
        };
        [point(0, manifold.id_1[lane]), point(1, manifold.id_2[lane])]
    }
}

fn contact_flags(contact: &Contact) -> u8 {
    let flag = |set: bool, flag: u8| if set { flag } else { 0 };
    flag(contact.restitution > 0.0, flags::RESTITUTION)
        | flag(contact.rolling_resistance > 0.0, flags::ROLLING)
        | flag(contact.tangent_speed != 0.0, flags::TANGENT_SPEED)
        | flag(contact.hit_events, flags::HIT)
}

/// Where a block is: colour, class, index.
pub(crate) type BlockAddress = (u8, u8, u32);

/// All colours, the overflow and the idle contacts.
#[derive(Debug, PartialEq)]
pub(crate) struct Graph {
    /// `buckets[colour][class]`.
    pub(crate) buckets: Vec<[Bucket; PairClass::COUNT]>,
    touching: usize,
    /// Blocks that got a touching contact since the last narrow phase.
    fresh: Vec<BlockAddress>,
    /// A contact has come in that joins bodies of different paces.
    pub(crate) mixed: bool,
    /// Contacts between dynamic bodies that have come in since the paces were last assigned.
    pub(crate) news: u32,
}

clone_by_field!(Graph { buckets, touching, fresh, mixed, news });

impl Footprint for Graph {
    fn footprint(&self) -> MemoryUse {
        let Self { buckets, touching: _, fresh, mixed: _, news: _ } = self;
        [buckets.footprint(), each(buckets.iter().flatten()), fresh.footprint()].into_iter().sum()
    }
}

impl Data for Graph {
    fn save(&self, sink: &mut impl Sink) {
        // Fresh blocks are those of the step at work.
        let Self { buckets, touching: _, fresh: _, mixed, news } = self;
        buckets.iter().flatten().for_each(|bucket| bucket.save(sink));
        mixed.save(sink);
        news.save(sink);
    }

    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let mut graph = Self::new();
        for bucket in graph.buckets.iter_mut().flatten() {
            *bucket = Data::load(reader)?;
        }
        graph.mixed = Data::load(reader)?;
        graph.news = Data::load(reader)?;
        let coloured = graph.buckets[..IDLE].iter().flatten();
        graph.touching = coloured.map(|bucket| bucket.contacts.len()).sum();
        Ok(graph)
    }
}

impl Graph {
    pub(crate) fn new() -> Self {
        Self {
            buckets: (0..=IDLE).map(|_| Default::default()).collect(),
            touching: 0,
            fresh: Vec::new(),
            mixed: false,
            news: 0,
        }
    }

    /// Contacts in the graph, touching or not.
    pub(crate) fn len(&self) -> usize {
        self.touching + self.buckets[IDLE].iter().map(|bucket| bucket.contacts.len()).sum::<usize>()
    }

    /// Memory of the constraints alone: what every pass of the solver goes through.
    pub(crate) fn constraints_footprint(&self) -> MemoryUse {
        each(self.buckets.iter().flatten().map(|bucket| &bucket.constraints))
    }

    /// Contacts that touch and are awake.
    pub(crate) fn touching_count(&self) -> usize {
        self.touching
    }

    /// Puts a contact into the graph: into a colour if it touches, else among the idle ones.
    pub(crate) fn insert(&mut self, bodies: &mut Bodies, contacts: &mut Contacts, index: u32) {
        let contact = &mut contacts.records[index as usize];
        let (place, slot) = self.admit(bodies, contact, index);
        self.buckets[place][contact.class as usize].fill(slot, contact);
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
            self.mixed |= bodies.are_mixed(a, b);
            let both_move = bodies.is_dynamic(a) && bodies.is_dynamic(b);
            self.news = self.news.saturating_add(u32::from(both_move));
            bodies.common_pace(a, b) * PER_PACE + take_colour(bodies, a, b)
        } else {
            IDLE
        };
        let slot = self.buckets[place][contact.class as usize].reserve(index, place != IDLE);
        contact.place = Place::Graph { colour: place as u8, slot };
        if place != IDLE {
            self.fresh.push((place as u8, contact.class as u8, slot / BLOCK as u32));
        }
        (place, slot)
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
        fresh.retain(|&(colour, class, block)| {
            (block as usize) < buckets[colour as usize][class as usize].manifolds.len()
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
            let bucket = &mut self.buckets[place][contact.class as usize];
            bucket.take_out(place, slot, SharedSlice::new(&mut contacts.records));
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
            give_colour_back(bodies, contact.body_a, contact.body_b, colour_at(place));
        }
        Some((place, slot))
    }
}

/// Finds a colour that neither moving body uses and marks it used.
fn take_colour(bodies: &mut Bodies, a: u32, b: u32) -> usize {
    const ALL: u32 = (1 << COLOURS) - 1;
    let (dynamic_a, dynamic_b) = (bodies.is_dynamic(a), bodies.is_dynamic(b));
    let used = |dynamic: bool, i: u32| {
        if dynamic { bodies.infos[i as usize].contact_colours } else { 0 }
    };
    let free = !(used(dynamic_a, a) | used(dynamic_b, b)) & ALL;
    if free == 0 {
        return COLOURS;
    }
    let colour = if dynamic_a && dynamic_b {
        free.trailing_zeros()
    } else {
        u32::BITS - 1 - free.leading_zeros()
    };
    if let Some((a, b)) = bodies.pair_mut(a, b) {
        a.contact_colours |= u32::from(dynamic_a) << colour;
        b.contact_colours |= u32::from(dynamic_b) << colour;
    }
    colour as usize
}

fn give_colour_back(bodies: &mut Bodies, a: u32, b: u32, colour: usize) {
    if colour == COLOURS {
        return;
    }
    for i in [a, b] {
        if bodies.is_dynamic(i) {
            bodies.infos[i as usize].contact_colours &= !(1 << colour);
        }
    }
}
