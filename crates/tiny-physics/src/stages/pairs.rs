//! From pairs of the broad phase to contact records, and back when boxes part.
//!
//! Shapes whose fat boxes overlap wait ([`Waiting`]) until they are near enough to touch; only then do they get
//! a contact. Where everything moves fast, most pairs never do: in spinner, 15,300 pairs a step came to
//! overlap with their fat boxes while 1,200 contacts began.

use crate::broad_phase::{BroadPhase, ProxyId};
use crate::describe::{Mix, Settings};
use crate::dynamics::{
    Bodies, Bucket, Contact, Contacts, Graph, Joints, NULL, Place, SavedPoint, Schedule,
    ShapeRecord, Shapes, Waiting,
};
use crate::footprint::footprint;
use crate::geometry::manifold::{PairClass, ShapeClass};
use crate::math::{Vec2, sort_by_number};
use crate::simd::BLOCK;
use crate::threads::{SharedSlice, Team};
use core::ops::Range;
use core::sync::atomic::{AtomicBool, Ordering};

/// Groups of moved shapes whose partners one member of the team looks for at a time.
const CHUNK: usize = 8;
/// Waiting pairs that one member of the team looks at at a time.
const WAITING_CHUNK: usize = 1024;
/// Moved shapes that one member of the team looks at at a time.
const MOVED_CHUNK: usize = 1024;
/// Blocks of contacts that one member of the team looks through at a time.
const SCANNED: usize = 32;

/// The search for pairs of a step, with the lists that it fills anew.
#[derive(Debug, Default)]
pub(crate) struct Search {
    /// Contacts whose fat boxes have parted, ascending.
    pub(crate) parted: Vec<u32>,
    /// Pairs that need a contact now, sorted.
    pub(crate) pairs: Vec<(u32, u32)>,
    spare_pairs: Vec<(u32, u32)>,
    /// By shape: has it left its fat box, see [`motion`]?
    moved: Vec<u8>,
    /// The bodies of those shapes, ascending.
    moved_bodies: Vec<u32>,
    /// Did one of those that sleeps?
    sleeper_moved: bool,
    spare: Vec<u32>,
    found: Vec<Found>,
    schedule: Schedule,
    found_parted: Vec<Vec<u32>>,
}

/// What a shape has done since pairs were last looked for, as bits.
mod motion {
    pub(super) const NONE: u8 = 0;
    /// It left its fat box: some of its pairs may have parted, others are new.
    pub(super) const MOVED: u8 = 1;
    /// All its pairs are found anew.
    pub(super) const ANEW: u8 = 3;
}

/// Pairs that a member of the team looked at.
#[derive(Debug, Default)]
struct Found {
    near: Vec<(u32, u32)>,
    waiting: Vec<(u32, u32)>,
}

footprint!(Found { near, waiting });
footprint!(Search { parted, pairs, spare_pairs, moved, moved_bodies, spare, schedule } each { found, found_parted } none { sleeper_moved });

/// What becomes of a pair whose fat boxes overlap.
enum Fate {
    /// It needs a contact.
    Near,
    /// It is looked at again in the next step.
    Waits,
    /// It is none, or has its contact already.
    None,
}

impl Search {
    /// Finds the contacts to drop and the pairs that need one. Only shapes that left their fat boxes are asked
    /// for their partners; those that are not near yet wait.
    pub(crate) fn run(
        &mut self,
        team: &Team,
        broad_phase: &mut BroadPhase,
        partners: &Partners<'_>,
        graph: &Graph,
        waiting: &mut Waiting,
    ) {
        self.note_moved(team, broad_phase, partners);
        self.find_parted(team, broad_phase, partners, graph);
        self.find_near(team, broad_phase, partners, waiting);
        self.forget_moved(team, broad_phase);
    }

    fn note_moved(&mut self, team: &Team, broad_phase: &BroadPhase, partners: &Partners<'_>) {
        let Partners { shapes, bodies, .. } = partners;
        self.moved.resize(shapes.records.len(), motion::NONE);
        let moved = SharedSlice::new(&mut self.moved);
        let sleeper_moved = AtomicBool::new(false);
        for_each_moved(team, broad_phase, |shape, proxy| {
            let anew = broad_phase.asks_anew(proxy);
            moved.write(shape, if anew { motion::ANEW } else { motion::MOVED });
            let body = shapes.records[shape as usize].body;
            if !bodies.infos[body as usize].awake {
                sleeper_moved.store(true, Ordering::Relaxed);
            }
        });
        self.sleeper_moved = sleeper_moved.into_inner();
    }

    fn forget_moved(&mut self, team: &Team, broad_phase: &mut BroadPhase) {
        let moved = SharedSlice::new(&mut self.moved);
        for_each_moved(team, broad_phase, |shape, _| moved.write(shape, motion::NONE));
        broad_phase.forget_moved(team);
    }

    /// Sorts waiting pairs and the partners of moved shapes into those that need a contact and those that wait.
    fn find_near(
        &mut self,
        team: &Team,
        broad_phase: &mut BroadPhase,
        partners: &Partners<'_>,
        waiting: &mut Waiting,
    ) {
        let careful = core::mem::take(&mut waiting.stale) | self.sleeper_moved;
        let (moved, old) = (&self.moved, &waiting.pairs);
        let chunks = team.map_chunks(old.len(), WAITING_CHUNK, &mut self.found, |range, found| {
            found.clear();
            for &(a, b) in &old[range] {
                let motion = moved[a as usize] | moved[b as usize];
                let over = motion != motion::NONE
                    && (motion == motion::ANEW || !partners.shapes.may_touch(a, b));
                if !over && partners.sort(a, b, careful, &mut found.waiting) {
                    found.near.push((a, b));
                }
            }
        });
        self.pairs.clear();
        waiting.pairs.clear();
        chunks.iter().for_each(|found| found.append_to(&mut self.pairs, waiting));

        let group_count = broad_phase.prepare_pairs();
        let boxes = &*broad_phase;
        let chunks = team.map_chunks(group_count, CHUNK, &mut self.found, |range, found| {
            found.clear();
            let Found { near, waiting } = found;
            boxes.query_groups(range, |a, b| partners.sort(a, b, careful, waiting), near);
        });
        chunks.iter().for_each(|found| found.append_to(&mut self.pairs, waiting));
        sort_by_number(&mut self.pairs, &mut self.spare_pairs, |&(a, b)| {
            u64::from(a) << 32 | u64::from(b)
        });
        self.pairs.dedup();
    }

    /// Lists the contacts of moved shapes whose fat boxes no longer overlap, ascending.
    ///
    /// Few moved shapes go through the contact lists of their bodies; where much moves, running down the
    /// blocks of the graph is quicker (spinner, 6,000 bodies: 13 ms a step by lists, 0.2 ms by blocks). Both
    /// find the same.
    fn find_parted(
        &mut self,
        team: &Team,
        broad_phase: &BroadPhase,
        partners: &Partners<'_>,
        graph: &Graph,
    ) {
        let Partners { shapes, bodies, contacts, .. } = partners;
        self.parted.clear();
        let much = broad_phase.moved().len() * 64 > graph.len();
        self.moved_bodies.clear();
        // Those that sleep have no contacts in the graph.
        let bodies_moved = moved_shapes(broad_phase).map(|i| shapes.records[i as usize].body);
        self.moved_bodies
            .extend(bodies_moved.filter(|&body| !much || !bodies.infos[body as usize].awake));
        self.moved_bodies.sort_unstable();
        self.moved_bodies.dedup();
        for &body in &self.moved_bodies {
            let body = &bodies.infos[body as usize];
            for (index, _) in contacts.of_body(body.first_contact) {
                let contact = &contacts.records[index as usize];
                let (a, b) = (contact.shape_a, contact.shape_b);
                let motion = self.moved[a as usize] | self.moved[b as usize];
                if motion != motion::NONE && !shapes.may_touch(a, b) {
                    self.parted.push(index);
                }
            }
        }
        if much {
            self.find_parted_in_graph(team, shapes, graph);
        }
        sort_by_number(&mut self.parted, &mut self.spare, |&contact| contact.into());
        self.parted.dedup();
    }

    fn find_parted_in_graph(&mut self, team: &Team, shapes: &Shapes, graph: &Graph) {
        let Self { moved, parted, schedule, found_parted, .. } = self;
        let (known, list) = ((&**moved, shapes), graph.buckets.list());
        if team.member_count() == 1 {
            let all =
                |bucket: &Bucket| add_parted(known, bucket, 0..bucket.manifolds.len(), parted);
            return list.iter().for_each(all);
        }
        schedule.fill(graph, SCANNED);
        let (runs, chunk) = schedule.runs(SCANNED);
        let chunks = team.map_chunks(runs.len(), chunk, found_parted, |range, parted| {
            parted.clear();
            for run in &runs[range] {
                add_parted(known, &list[run.bucket], run.blocks.clone(), parted);
            }
        });
        chunks.iter().for_each(|found| parted.extend_from_slice(found));
    }
}

/// Adds those contacts of some blocks of which a shape has moved, and whose fat boxes no longer overlap.
fn add_parted(
    (moved, shapes): (&[u8], &Shapes),
    bucket: &Bucket,
    blocks: Range<usize>,
    parted: &mut Vec<u32>,
) {
    let contacts = bucket.contacts[blocks.start * BLOCK..].chunks(BLOCK);
    for (contacts, block) in contacts.zip(&bucket.manifolds[blocks]) {
        // Which of them have moved is noise to the branch predictor where much moves.
        let lanes = (0..contacts.len()).fold(0_u16, |lanes, lane| {
            let (a, b) = (block.shape_a[lane], block.shape_b[lane]);
            let motion = moved[a as usize] | moved[b as usize];
            let parted = (motion != motion::NONE) & !shapes.may_touch(a, b);
            lanes | u16::from(parted) << lane
        });
        if lanes != 0 {
            let parted_lanes =
                contacts.iter().enumerate().filter(|(lane, _)| lanes >> lane & 1 != 0);
            parted.extend(parted_lanes.map(|(_, &index)| index));
        }
    }
}

/// Shapes that left their fat boxes.
fn moved_shapes(broad_phase: &BroadPhase) -> impl Iterator<Item = u32> + '_ {
    broad_phase.moved().iter().filter_map(|&proxy| broad_phase.user(proxy))
}

/// Calls `work` with each shape that left its fat box, and its leaf.
fn for_each_moved(team: &Team, broad_phase: &BroadPhase, work: impl Fn(u32, ProxyId) + Sync) {
    let moved = broad_phase.moved();
    team.for_each_chunk(moved.len(), MOVED_CHUNK, |range| {
        for &proxy in &moved[range] {
            if let Some(shape) = broad_phase.user(proxy) {
                work(shape, proxy);
            }
        }
    });
}

impl Found {
    fn clear(&mut self) {
        self.near.clear();
        self.waiting.clear();
    }

    fn append_to(&self, near: &mut Vec<(u32, u32)>, waiting: &mut Waiting) {
        near.extend_from_slice(&self.near);
        waiting.pairs.extend_from_slice(&self.waiting);
    }
}

/// What the user has to say about pairs of shapes, beyond filters.
pub(crate) trait PairRule: Sync {
    /// May the two shapes collide?
    fn allows(&self, bodies: &Bodies, shapes: &Shapes, a: u32, b: u32) -> bool;
}

/// Do filters, joints and the user let two shapes collide, whatever else they are?
pub(crate) fn may_collide(
    (bodies, shapes, joints): (&Bodies, &Shapes, &Joints),
    custom: Option<&dyn PairRule>,
    [a, b]: [u32; 2],
) -> bool {
    let [one, other] = [a, b].map(|shape| &shapes.records[shape as usize]);
    one.filter.collides(&other.filter)
        && joints.may_collide(bodies, one.body, other.body)
        && custom.is_none_or(|rule| rule.allows(bodies, shapes, a, b))
}

/// What decides whether two shapes may meet.
#[derive(Clone, Copy)]
pub(crate) struct Partners<'a> {
    pub(crate) shapes: &'a Shapes,
    pub(crate) bodies: &'a Bodies,
    pub(crate) contacts: &'a Contacts,
    pub(crate) joints: &'a Joints,
    /// The user's word on a pair of shapes, if there is any.
    pub(crate) custom: Option<&'a dyn PairRule>,
    /// Boxes that are closer than this need a contact, metres.
    pub(crate) reach: f32,
    /// How far shapes will go in the step; see [`Ways`](super::ahead::Ways).
    pub(crate) ways: &'a [Vec2],
}

impl Partners<'_> {
    /// Does the pair need a contact? Puts it among the waiting ones if it may need one later. Only a careful look
    /// sees which shapes are gone or sleep.
    #[inline]
    fn sort(&self, a: u32, b: u32, careful: bool, waiting: &mut Vec<(u32, u32)>) -> bool {
        let near = self.come_near(a, b);
        let fate = if near || careful { self.look(a, b, near) } else { Fate::Waits };
        if matches!(fate, Fate::Waits) {
            waiting.push((a, b));
        }
        matches!(fate, Fate::Near)
    }

    /// Will the boxes of two shapes be near each other in the step, and the disks around them too?
    #[inline]
    pub(crate) fn come_near(&self, a: u32, b: u32) -> bool {
        let [way_a, way_b] =
            [a, b].map(|shape| self.ways.get(shape as usize).copied().unwrap_or_default());
        let way = way_b - way_a;
        if way == Vec2::ZERO {
            return self.shapes.are_near(a, b, self.reach);
        }
        let [a, b] = [a, b].map(|shape| &self.shapes.tight[shape as usize]);
        // Gaps from A to B and from B to A, and what the way takes of them: four at once.
        let (least, behind) = (b.min - a.max, a.min - b.max);
        let (on, back) = (way.min(Vec2::ZERO), (-way).min(Vec2::ZERO));
        let gaps = [least.x + on.x, least.y + on.y, behind.x + back.x, behind.y + back.y];
        if gaps.iter().fold(false, |far, &gap| far | (gap > self.reach)) {
            return false;
        }
        // Seen from A, the middle of B goes along a line.
        let most = -behind;
        let room = (most - least).length() * 0.5 + self.reach;
        let aside = (least + most).cross(way) * 0.5;
        aside * aside <= room * room * way.length_sq()
    }

    fn look(&self, a: u32, b: u32, near: bool) -> Fate {
        let records = [a, b].map(|i| &self.shapes.records[i as usize]);
        if records.iter().any(|record| record.proxy == NULL) {
            return Fate::None;
        }
        // Nothing would look at a pair that sleeps: it gets its contact while it can.
        if !near && records.iter().any(|record| self.bodies.infos[record.body as usize].awake) {
            return Fate::Waits;
        }
        if self.may_meet(a, b) { Fate::Near } else { Fate::None }
    }

    /// Do filters, bodies and joints let the two shapes collide, and have they no contact yet?
    pub(crate) fn may_meet(&self, a: u32, b: u32) -> bool {
        let (shape_a, shape_b) =
            (&self.shapes.records[a as usize], &self.shapes.records[b as usize]);
        shape_a.body != shape_b.body
            && !shape_a.sensor
            && !shape_b.sensor
            && self.contacts.pairs.get(a, b).is_none()
            && may_collide((self.bodies, self.shapes, self.joints), self.custom, [a, b])
    }
}

/// Creates the contacts of new pairs of shapes. `created` gets those that are awake.
pub(crate) fn create_contacts(
    pairs: &[(u32, u32)],
    settings: &Settings,
    shapes: &Shapes,
    bodies: &mut Bodies,
    contacts: &mut Contacts,
    created: &mut Vec<u32>,
) {
    created.clear();
    for &(a, b) in pairs {
        let contact = new_contact(a, b, settings, shapes);
        let awake = is_awake(bodies, &contact);
        let index = contacts.insert(bodies, contact);
        if awake {
            created.push(index);
        }
    }
}

/// Is one of the two bodies awake and able to move?
pub(crate) fn is_awake(bodies: &Bodies, contact: &Contact) -> bool {
    bodies.infos[contact.body_a as usize].awake || bodies.infos[contact.body_b as usize].awake
}

fn new_contact(a: u32, b: u32, settings: &Settings, shapes: &Shapes) -> Contact {
    let class = |i: u32| shapes.records[i as usize].class;
    let (a, b) = if class(a) < class(b) { (b, a) } else { (a, b) };
    let (shape_a, shape_b) = (&shapes.records[a as usize], &shapes.records[b as usize]);
    let mut contact = Contact {
        alive: true,
        touching: false,
        events: false,
        hit_events: false,
        class: PairClass::of(shape_a.class, shape_b.class),
        place: Place::Asleep,
        shape_a: a,
        shape_b: b,
        body_a: shape_a.body,
        body_b: shape_b.body,
        friction: 0.0,
        restitution: 0.0,
        rolling_resistance: 0.0,
        tangent_speed: 0.0,
        saved: [SavedPoint::NONE; 2],
        links: [(NULL, NULL); 2],
    };
    mix_materials(&mut contact, settings, shapes);
    contact
}

/// Sets what a contact has of the materials of its two shapes, and which events it sends. A contact that
/// touches keeps sending begin and end events or not, so that these stay paired.
pub(crate) fn mix_materials(contact: &mut Contact, settings: &Settings, shapes: &Shapes) {
    let (a, b) = (contact.shape_a, contact.shape_b);
    let (shape_a, shape_b) = (&shapes.records[a as usize], &shapes.records[b as usize]);
    let (material_a, material_b) = (&shape_a.material, &shape_b.material);
    // A general polygon rolls like the disk around it, about its own centre of mass, on what is not round itself: there it is ground.
    let radius = |i: u32| shapes.rows[i as usize][6];
    let is_round = |i: u32| {
        let class = shapes.records[i as usize].class;
        matches!(class, ShapeClass::Circle | ShapeClass::Capsule) && radius(i) > 0.0
    };
    let rolling = |i: u32, other: u32| match shapes.records[i as usize] {
        ShapeRecord { material, .. } if material.rolling_resistance == 0.0 => 0.0,
        ShapeRecord { class: ShapeClass::General, shape, material, .. } if !is_round(other) => {
            let core = shape.core();
            let center = shape.mass_properties(1.0).center;
            material.rolling_resistance * (core.reach(center) + core.radius)
        }
        ShapeRecord { material, .. } => material.rolling_resistance * radius(i),
    };
    if !contact.touching {
        contact.events = shape_a.contact_events || shape_b.contact_events;
    }
    contact.hit_events = shape_a.hit_events || shape_b.hit_events;
    let (a_mix, b_mix) = (material_a.friction_mix, material_b.friction_mix);
    let mix = Mix::of(a_mix, b_mix, settings.friction_mix);
    contact.friction = mix.apply(material_a.friction, material_b.friction);
    let (a_mix, b_mix) = (material_a.restitution_mix, material_b.restitution_mix);
    let mix = Mix::of(a_mix, b_mix, settings.restitution_mix);
    contact.restitution = mix.apply(material_a.restitution, material_b.restitution);
    contact.rolling_resistance = rolling(a, b).max(rolling(b, a)).clamp(0.0, f32::MAX);
    // The solver's tangent points along the surface of A; a belt goes the other way round B.
    let speed = material_a.tangent_speed + material_b.tangent_speed;
    contact.tangent_speed = -speed.clamp(f32::MIN, f32::MAX);
}
