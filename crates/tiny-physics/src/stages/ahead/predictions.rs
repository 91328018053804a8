//! Contacts of the moments of impact; see the [stage](super).

use super::again::{Again, Around, Struck};
use super::courses::{Course, Courses, Impact};
use super::driven::{self, Held};
use super::hits::{Hit, Prediction, goes_in};
use super::meeting::Meeting;
use super::squeezed::{self, Pressed, Squeezed};
use crate::broad_phase::BroadPhase;
use crate::dynamics::{
    Bodies, Bucket, ConstraintBlock, Contact, Contacts, Graph, Joints, Place, Shapes,
};
use crate::footprint::footprint;
use crate::geometry::manifold::Manifold;
use crate::geometry::{LINEAR_SLOP, ToiState, impact_within, pass_by};
use crate::math::{Transform, Vec2};
use crate::stages::ahead::{Found, SLIGHT, Ways};
use crate::stages::boxes;
use crate::stages::effective_mass::draw_near;
use crate::stages::narrow_context::Context;
use crate::stages::one_way;
use crate::stages::surfaces::{self, LanePoints};
use crate::threads::Team;

/// Through how many bodies a hit may be handed on in a step.
const ROUNDS: usize = 6;
/// Contacts that one member of the team looks at at a time.
const CHUNK: usize = 32;
/// Points whose separations differ by less than this are hit together, metres; multiplied by the length unit.
const NEAR: f32 = 0.02;
/// So many bodies that were taken off their ways may be looked at again in a step, and one in [`SHARE`] of all: those
/// first that were taken the furthest. The others have to wait for the next step.
const BUDGET: usize = 256;
const SHARE: usize = 32;
/// A hit is hard if its bodies would go so far into each other in the step: a part of the thinner one's half thickness.
const HARD: f32 = 0.2;
/// Cosine of the angle by which the normal of what is near turns at most until it is hit: 11 degrees.
const AS_NOW: f32 = 0.98;
/// What hits before it leave so much of its speed bounces as if they were not.
const UNSLOWED: f32 = 0.75;

/// The predictions of a step.
#[derive(Debug, Default)]
pub(crate) struct Predictions {
    /// Contacts that close in fast: the narrow phase names them.
    pub(crate) candidates: Vec<u32>,
    /// Contacts with a prediction, in the order of `list`.
    pub(crate) contacts: Vec<u32>,
    /// Those of them that did not touch before.
    pub(crate) fresh: Vec<u32>,
    /// Contacts whose points are near each other, and whose shapes pass: the solver is to leave them alone.
    pub(crate) missed: Vec<u32>,
    /// Those of hard hits, some more than once, though not in a row: they are solved more often.
    pub(crate) hard: Vec<u32>,
    /// Those whose bodies hit others first, and are slowed.
    behind: Vec<u32>,
    /// Bodies of these that something bouncy slows.
    pub(crate) waiting: Vec<u32>,
    list: Vec<Prediction>,
    /// By contact: place in `list`, plus 1.
    places: Vec<u32>,
    courses: Courses,
    /// What the last round took off its way.
    pub(crate) struck: Vec<Struck>,
    pub(crate) squeezed: Squeezed,
    rounds: usize,
    /// Bodies that may still be looked at again in this step.
    budget: usize,
    found: Vec<Seen>,
    /// Hits of a round, the earliest first: time and contact, and place.
    order: Vec<(u64, u32)>,
    /// Contacts that wait for the next round: one of their bodies was hit before them, and goes elsewhere now.
    deferred: Vec<u32>,
    again: Again,
    reached: Found,
}

footprint!(Predictions {
    candidates,
    contacts,
    fresh,
    missed,
    hard,
    behind,
    waiting,
    list,
    places,
    courses,
    struck,
    squeezed,
    order,
    deferred,
    again,
    reached
} each { found } none { rounds, budget });

/// What one member of the team has found.
#[derive(Debug, Default)]
struct Seen {
    hits: Vec<Hit>,
    missed: Vec<u32>,
}

footprint!(Seen { hits, missed });

/// What predictions are made from.
#[derive(Clone, Copy)]
pub(crate) struct Scene<'a> {
    pub(crate) bodies: &'a Bodies,
    pub(crate) shapes: &'a Shapes,
    pub(crate) contacts: &'a Contacts,
    pub(crate) graph: &'a Graph,
    /// For contacts at seams.
    pub(crate) narrow_phase: Context<'a>,
    /// Length of the step, seconds, and how many substeps it has.
    pub(crate) dt: f32,
    pub(crate) substeps: f32,
}

impl Scene<'_> {
    fn is_joined(&self, body: u32) -> bool {
        let joints = self.narrow_phase.ground.joints;
        joints.act_on(self.bodies.infos[body as usize].first_joint)
    }
}

impl Predictions {
    /// Forgets those of the step before.
    pub(crate) fn clear(&mut self) {
        self.candidates.clear();
        self.contacts.drain(..).for_each(|contact| self.places[contact as usize] = 0);
        self.list.clear();
        self.fresh.clear();
        self.missed.clear();
        self.hard.clear();
        self.behind.clear();
        self.waiting.clear();
        self.squeezed.clear();
        (self.rounds, self.budget) = (0, 0);
        self.courses.clear();
        self.again.clear();
    }

    /// That of a contact.
    #[inline]
    pub(crate) fn of(&self, contact: u32) -> Option<&Prediction> {
        let place = *self.places.get(contact as usize)?;
        self.list.get(place.wrapping_sub(1) as usize)
    }

    /// Bodies that were hit, as far as is known.
    pub(crate) fn bodies(&self) -> impl Iterator<Item = u32> + '_ {
        self.courses.list.iter().map(|course| course.body)
    }

    /// What a body turns in the step, as far as hits are known, radians.
    #[inline]
    pub(crate) fn turn(&self, bodies: &Bodies, dt: f32, body: u32) -> f32 {
        self.courses.of(bodies, dt, body).turn
    }

    /// How far it goes, metres.
    #[inline]
    pub(crate) fn motion(&self, bodies: &Bodies, dt: f32, body: u32) -> Vec2 {
        self.courses.of(bodies, dt, body).motion
    }

    /// Has what hits something else first bounce after that at the earliest.
    pub(crate) fn hold_back(&self, contacts: &Contacts, graph: &mut Graph) {
        self.behind.iter().for_each(|&index| graph.hold_back(&contacts.records[index as usize]));
    }

    /// Has those that were held back bounce after all where what hit first is switched off: shapes, and the bodies that they do not touch.
    pub(crate) fn let_go(
        &mut self,
        off: &[[u32; 2]],
        (bodies, contacts): (&Bodies, &Contacts),
        graph: &mut Graph,
    ) {
        for index in core::mem::take(&mut self.behind) {
            let contact = &contacts.records[index as usize];
            let is_off =
                |body| bodies.is_dynamic(body) && off.iter().any(|&[_, other]| other == body);
            if !is_off(contact.body_a) && !is_off(contact.body_b) {
                continue;
            }
            let parting = graph.let_go(contact, &bodies.rows);
            if let (Some(known), Some(parting)) = (self.known_mut(index), parting) {
                known.parting = parting;
            }
        }
    }

    /// Are there none?
    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Finds what forces and joints take off its way in a step of `dt` seconds; `held` says what a joint that presses on something
    /// did. Says whether there is any: [`Predictions::look_again`] adds its contacts to the candidates.
    pub(crate) fn foresee(
        &mut self,
        (bodies, joints, ways): (&Bodies, &Joints, &Ways),
        (dt, reach): (f32, f32),
        held: impl Fn(u32, bool) -> Option<Held>,
    ) -> bool {
        self.courses.resize(bodies.rows.len());
        for &body in &ways.forced {
            driven::by_force(bodies, body, dt, &mut self.courses);
        }
        for &index in &joints.driven {
            let record = &joints.records[index as usize];
            if record.place != Place::Asleep {
                let held = |turns| held(index, turns);
                driven::by_joint((bodies, joints), record, held, dt, &mut self.courses);
            }
        }
        if self.courses.list.is_empty() {
            return false;
        }
        let named = core::mem::take(&mut self.candidates);
        self.budget = BUDGET + bodies.awake.len() / SHARE;
        self.list_struck(bodies, SLIGHT * reach);
        self.candidates = named;
        !self.struck.is_empty()
    }

    /// Looks at the candidates. Says whether hits take bodies so far off their ways that there is a next round:
    /// [`Predictions::look_again`] lists its candidates.
    pub(crate) fn round(&mut self, team: &Team, scene: Scene<'_>) -> bool {
        if self.candidates.is_empty() {
            return false;
        }
        if self.rounds == 0 {
            self.budget = BUDGET + scene.bodies.awake.len() / SHARE;
        }
        self.places.resize(scene.contacts.records.len(), 0);
        self.courses.resize(scene.bodies.rows.len());
        let mut found = core::mem::take(&mut self.found);
        let look = Look { scene, known: self };
        let chunks = team.map_chunks(self.candidates.len(), CHUNK, &mut found, |range, found| {
            found.hits.clear();
            found.missed.clear();
            self.candidates[range].iter().for_each(|&contact| look.add(contact, found));
        });
        let mut order = core::mem::take(&mut self.order);
        list_by_time(chunks, &mut order);
        order.iter().for_each(|&(_, place)| {
            self.take(scene, &chunks[place as usize / CHUNK].hits[place as usize % CHUNK]);
        });
        chunks.iter().for_each(|found| self.missed.extend_from_slice(&found.missed));
        (self.found, self.order) = (found, order);
        self.rounds += 1;
        self.list_struck(scene.bodies, SLIGHT * scene.narrow_phase.speculative_distance);
        self.candidates.append(&mut self.deferred);
        self.retake_missed(scene.contacts);
        self.rounds < ROUNDS && !(self.struck.is_empty() && self.candidates.is_empty())
    }

    /// Looks once more at what is missed no longer: one of its bodies was struck since.
    fn retake_missed(&mut self, contacts: &Contacts) {
        let Self { missed, courses, candidates, .. } = self;
        missed.retain(|&index| {
            let contact = &contacts.records[index as usize];
            let misses = !courses.have_struck(contact);
            candidates.extend((!misses).then_some(index));
            misses
        });
    }

    /// Lets the boxes of bodies that hits took off their ways reach as far as they go now.
    pub(crate) fn reach(
        &mut self,
        (bodies, dt): (&Bodies, f32),
        shapes: &mut Shapes,
        broad_phase: &mut BroadPhase,
        ways: &mut Ways,
    ) {
        let mut found = core::mem::take(&mut self.reached);
        found.clear();
        boxes::share(shapes, broad_phase, |boxes| {
            for struck in &self.struck {
                let first_shape = bodies.infos[struck.body as usize].first_shape;
                let way = self.courses.far(bodies, dt, struck.body).way(bodies);
                boxes.reach((first_shape, true), &way, &mut found.moved, &mut found.fast);
            }
        });
        ways.take_over(&found, shapes, broad_phase);
        self.reached = found;
    }

    /// Makes candidates of the contacts of bodies that hits took off their ways, and lists the pairs that need a contact now,
    /// sorted.
    pub(crate) fn look_again(
        &mut self,
        team: &Team,
        around: Around<'_>,
        pairs: &mut Vec<(u32, u32)>,
    ) {
        let Self { again, candidates, struck, reached, courses, .. } = self;
        again.run(team, around, (struck, &reached.moved, courses), candidates, pairs);
    }

    /// Keeps what a hit predicts and hands on its impulse.
    fn take(&mut self, scene: Scene<'_>, hit: &Hit) {
        let contact = &scene.contacts.records[hit.contact as usize];
        let bodies = [contact.body_a, contact.body_b];
        let courses = bodies.map(|body| self.courses.of(scene.bodies, scene.dt, body));
        if self.waits(scene, hit, &courses) {
            self.deferred.push(hit.contact);
            return;
        }
        let mut fraction = hit.when(&courses, scene.dt);
        if contact.restitution > 0.0 {
            // What bounces is reflected at the start of the substep.
            fraction = (fraction * scene.substeps).floor() / scene.substeps;
        }
        let courses = hit.at_moment(&courses, scene.narrow_phase.ground.length_unit, scene.dt);
        let mut impact = Impact::new(scene.bodies, courses, (fraction, scene.dt));
        if let Some(prediction) = hit.prediction.filter(|_| self.of(hit.contact).is_none()) {
            let parting = hit.unslowed(&courses);
            self.contacts.push(hit.contact);
            self.list.push(Prediction { parting, ..prediction });
            self.places[hit.contact as usize] = self.list.len() as u32;
            if contact.restitution > 0.0 {
                self.note_slowed(scene, hit, &impact.courses, parting);
            }
        }
        let astray = [impact.courses[0].astray, impact.courses[1].astray];
        self.note_squeezed(scene, hit, &mut impact.courses);
        // Joints take a body elsewhere than a hit alone would, and what bounces may do so a substep sooner.
        let is_plain = contact.restitution == 0.0;
        let sure = bodies.map(|body| is_plain && !scene.is_joined(body));
        impact.courses.iter_mut().zip(sure).for_each(|(it, sure)| it.sure &= sure);
        let thinner = scene.bodies.thinner_half(bodies);
        let mut pushed = self.put_forward(hit, fraction, scene.dt, &mut impact);
        for (arms, pushed) in hit.arms.into_iter().zip(&mut pushed) {
            let (speed, mass) = impact.approach(hit.normal, arms.normal);
            if speed * scene.dt < -HARD * thinner && self.hard.last() != Some(&hit.contact) {
                self.hard.push(hit.contact);
            }
            if speed < 0.0 {
                impact.courses.iter_mut().for_each(|it| it.stopped |= contact.restitution == 0.0);
                let impulse = -(1.0 + contact.restitution) * speed * mass;
                *pushed += impulse;
                impact.push(impulse, hit.normal, arms.normal);
                let tangent = -hit.normal.perp();
                let (slip, mass) = impact.approach(tangent, arms.tangent);
                let limit = contact.friction * impulse;
                impact.push((-slip * mass).max(-limit).min(limit), tangent, arms.tangent);
            }
        }
        if let Some(known) = self.known_mut(hit.contact) {
            known.pushed = pushed;
        }
        for (course, astray) in impact.courses.iter().zip(astray) {
            if course.astray > astray {
                self.courses.keep(course);
            }
        }
    }

    /// Does a hit of what cannot move wait for the next round? Its other body was turned off its way before, by something else that cannot
    /// move, and may pass.
    fn waits(&self, scene: Scene<'_>, hit: &Hit, courses: &[Course; 2]) -> bool {
        let least = SLIGHT * scene.narrow_phase.speculative_distance;
        let turned = |course: &Course| {
            let is_in_time = 0.0 < course.since && course.since < hit.fraction;
            is_in_time && course.sure && course.is_far(scene.bodies, least)
        };
        let [a, b] = courses;
        let is_fixed = |course: &Course| scene.bodies.inverses(course.body) == [0.0; 3];
        let there_is_time = self.rounds + 1 < ROUNDS && self.budget > 0;
        hit.prediction.is_some()
            && there_is_time
            && (turned(a) && is_fixed(b) || turned(b) && is_fixed(a))
    }

    /// Notes a hit of what bounces whose bodies others have slowed before.
    fn note_slowed(&mut self, scene: Scene<'_>, hit: &Hit, courses: &[Course; 2], now: [f32; 2]) {
        let first =
            hit.parting(&[0, 1].map(|k| Course::of(scene.bodies, scene.dt, courses[k].body)));
        let [first, now] = [first, now].map(|of| of[0].min(of[1]));
        if first < 0.0 && now > UNSLOWED * first {
            self.behind.push(hit.contact);
            if !courses.iter().any(|course| course.stopped) {
                self.waiting.extend(courses.iter().map(|course| course.body));
            }
        }
    }

    /// A known hit that comes sooner than was thought: what it has pushed so far moves bodies for longer. Says what that is.
    fn put_forward(&mut self, hit: &Hit, fraction: f32, dt: f32, impact: &mut Impact) -> [f32; 2] {
        let Some(known) = self.known_mut(hit.contact) else { return [0.0; 2] };
        let sooner = known.fraction - fraction;
        if sooner > 0.0 {
            known.fraction = fraction;
            for (arms, impulse) in hit.arms.iter().zip(known.pushed) {
                impact.shift(impulse, hit.normal, arms.normal, sooner * dt);
            }
        }
        known.pushed
    }

    /// Forgets hits on what sleeps that others have kept from it: no shot wakes what lies behind the wall that stops it.
    pub(crate) fn leave_asleep(&mut self, bodies: &Bodies, contacts: &Contacts, least: f32) {
        let Self { contacts: predicted, list, places, .. } = self;
        predicted.retain(|&index| {
            let contact = &contacts.records[index as usize];
            let place = &mut places[index as usize];
            let both = [contact.body_a, contact.body_b];
            let give: f32 = both.iter().map(|&body| bodies.inverse_masses(body).0).sum();
            let pushed: f32 = list[*place as usize - 1].pushed.iter().sum();
            let sleeps =
                |&body: &u32| bodies.is_dynamic(body) && !bodies.infos[body as usize].awake;
            let left = !contact.touching && both.iter().any(sleeps) && pushed * give <= least;
            *place = if left { 0 } else { *place };
            !left
        });
    }

    fn known_mut(&mut self, contact: u32) -> Option<&mut Prediction> {
        self.list.get_mut(self.places[contact as usize].wrapping_sub(1) as usize)
    }

    /// Notes a light body that a heavy one hits, or that is in it already; it hits others as the heavy one would.
    fn note_squeezed(&mut self, scene: Scene<'_>, hit: &Hit, courses: &mut [Course; 2]) {
        let [a, b] = [0, 1].map(|k| courses[k].inverse_mass);
        let restitution = scene.contacts.records[hit.contact as usize].restitution;
        if !squeezed::is_uneven([a, b], restitution) {
            return;
        }
        // Another hit may have stopped the heavy one already, on its way beyond the light one.
        let first = [0, 1].map(|k| Course::of(scene.bodies, scene.dt, courses[k].body));
        let approaches = [&*courses, &first].map(|of| hit.parting(of));
        let coming = approaches.into_iter().flatten().fold(0.0, f32::min);
        let (light, context) = (usize::from(b > a), scene.narrow_phase);
        let pressed = Pressed {
            body: courses[light].body,
            by: a.min(b),
            velocity: scene.bodies.velocity(courses[1 - light].body),
            direction: if light == 1 { hit.normal } else { -hit.normal },
            coming: coming < -squeezed::COMING * context.ground.length_unit,
        };
        if coming * scene.dt < -SLIGHT * context.speculative_distance {
            self.squeezed.hit.push(pressed.body);
        }
        courses[light].inverse_mass = pressed.by;
        self.squeezed.pressed.push(pressed);
    }

    /// Has what is squeezed count as heavier in this step, see [`Squeezed`]; says how many bodies that are.
    pub(crate) fn weigh_squeezed(
        &mut self,
        bodies: &mut Bodies,
        contacts: &Contacts,
        graph: &mut Graph,
        scale: (f32, Vec2),
    ) -> usize {
        let mut squeezed = core::mem::take(&mut self.squeezed);
        let predicted = |contact| self.of(contact).map(|known| known.normal);
        squeezed.weigh(bodies, contacts, graph, scale, &predicted);
        self.squeezed = squeezed;
        self.squeezed.weighed.len()
    }

    /// Lists the bodies that hits have taken off their ways by `least` metres and more since they were last looked at.
    fn list_struck(&mut self, bodies: &Bodies, least: f32) {
        self.candidates.clear();
        self.struck.clear();
        if self.rounds == ROUNDS || self.budget == 0 {
            return;
        }
        for course in &mut self.courses.list {
            if course.is_far(bodies, least) {
                let half = bodies.infos[course.body as usize].min_extent;
                self.struck.push(Struck { body: course.body, astray: course.astray / half });
                course.astray = 0.0;
            }
        }
        let furthest_first =
            |a: &Struck, b: &Struck| b.astray.total_cmp(&a.astray).then(a.body.cmp(&b.body));
        self.struck.sort_unstable_by(furthest_first);
        self.struck.truncate(self.budget);
        self.budget -= self.struck.len();
    }
}

/// What becomes of two shapes that close in.
enum Coming {
    Hit(Hit),
    Misses,
    Unknown,
}

/// The search for a hit.
struct Look<'a> {
    scene: Scene<'a>,
    known: &'a Predictions,
}

impl Look<'_> {
    /// Looks at a contact.
    fn add(&self, index: u32, seen: &mut Seen) {
        let contact = &self.scene.contacts.records[index as usize];
        if let Some(known) = self.known.of(index) {
            seen.hits.push(known.hit(index, self.near()));
            return;
        }
        let Some((bucket, block, lane)) = self.scene.graph.lane_of(contact) else { return };
        if !bucket.touches(block, lane) {
            // What was to go by before others struck it may be near already.
            match self.coming(index) {
                Coming::Hit(hit) => seen.hits.push(hit),
                _ if self.both_move(contact) => {}
                Coming::Unknown => seen.hits.extend(self.now(index)),
                Coming::Misses if self.known.courses.have_struck(contact) => {}
                Coming::Misses => seen.missed.push(index),
            }
            return;
        }
        let passes = || {
            let constraint = bucket.constraints.get(block);
            self.is_free(contact) && constraint.is_none_or(|it| self.may_pass(contact, it, lane))
        };
        let touching = || self.touching(index, (bucket, block, lane));
        match if passes() { self.coming(index) } else { Coming::Unknown } {
            Coming::Misses => seen.missed.push(index),
            Coming::Unknown => seen.hits.extend(touching()),
            // Where it is hit as its points say, these are kept.
            Coming::Hit(hit) => seen.hits.push(
                touching().filter(|known| known.normal.dot(hit.normal) > AS_NOW).unwrap_or(hit),
            ),
        }
    }

    /// A hit of what touches already.
    fn touching(&self, index: u32, (bucket, block, lane): (&Bucket, usize, usize)) -> Option<Hit> {
        let contact = &self.scene.contacts.records[index as usize];
        if let Some(constraint) = bucket.constraints.get(block) {
            let prediction = self.other_point(contact, constraint, lane);
            return Some(Hit { prediction, ..Hit::touching(index, constraint, lane) });
        }
        self.now(index)
    }

    /// The hit of a contact that has no points, as its shapes lie when the step starts.
    fn now(&self, index: u32) -> Option<Hit> {
        let contact = &self.scene.contacts.records[index as usize];
        let meeting = self.meeting(contact, self.far(contact));
        // Whether what is one-way lets it begin is judged later.
        let is_one_way = meeting.shapes.iter().any(|shape| shape.one_way.is_some());
        if !meeting.comes_near() || meeting.is_let_pass() || is_one_way {
            return None;
        }
        let frames = meeting.frames();
        let manifold = meeting.manifold(&frames, self.reach());
        (manifold.count > 0)
            .then(|| meeting.predict(&manifold, &frames[0], 0.0).hit(index, self.near()))
    }

    /// Does a contact that pushes nothing yet come so near in the step that it would?
    fn may_pass(&self, contact: &Contact, constraint: &ConstraintBlock, lane: usize) -> bool {
        let [a, b] = [contact.body_a, contact.body_b]
            .map(|body| Course::of(self.scene.bodies, self.scene.dt, body));
        constraint.points.iter().all(|point| point.normal_impulse[lane] == 0.0)
            && goes_in(constraint, lane, [&a, &b]) > 0.0
    }

    /// Do the bodies of a contact go as they move now, as far as is known? And has neither shape a side to be passed from?
    fn is_free(&self, contact: &Contact) -> bool {
        let goes = |body: u32| !self.known.courses.is_struck(body) && !self.scene.is_joined(body);
        let is_plain = |shape: u32| self.scene.shapes.records[shape as usize].one_way.is_none();
        goes(contact.body_a)
            && goes(contact.body_b)
            && is_plain(contact.shape_a)
            && is_plain(contact.shape_b)
    }

    /// Looks for the time of impact; where one body's new way is sure and the other's is not, also as far off its way as that is known
    /// to go.
    fn coming(&self, index: u32) -> Coming {
        let contact = &self.scene.contacts.records[index as usize];
        let coming = self.impact(contact, index, self.far(contact));
        if !matches!(coming, Coming::Misses) {
            return coming;
        }
        let Scene { bodies, dt, .. } = self.scene;
        let courses = [contact.body_a, contact.body_b];
        let courses = courses.map(|body| self.known.courses.of(bodies, dt, body));
        let turned = courses.iter().any(|course| course.sure && course.since > 0.0);
        if turned && courses.iter().any(|course| !course.sure) {
            return self.impact(contact, index, courses);
        }
        Coming::Misses
    }

    fn both_move(&self, contact: &Contact) -> bool {
        let bodies = self.scene.bodies;
        bodies.is_dynamic(contact.body_a) && bodies.is_dynamic(contact.body_b)
    }

    fn far(&self, contact: &Contact) -> [Course; 2] {
        let Scene { bodies, dt, .. } = self.scene;
        [contact.body_a, contact.body_b].map(|body| self.known.courses.far(bodies, dt, body))
    }

    fn impact(&self, contact: &Contact, index: u32, courses: [Course; 2]) -> Coming {
        let meeting = self.meeting(contact, courses);
        if !meeting.comes_near() {
            return Coming::Misses;
        }
        if meeting.is_let_pass() {
            return Coming::Unknown;
        }
        let [a, b] = meeting.shapes;
        let slop = LINEAR_SLOP * self.length_unit();
        let apart = meeting.apart_until(slop);
        if apart >= 1.0 {
            return Coming::Misses;
        }
        let sweeps = meeting.sweeps();
        let from = apart.max(meeting.since());
        let toi = impact_within(&a.shape, &sweeps[0], &b.shape, &sweeps[1], (from, 1.0), slop);
        let Some(toi) = toi else { return Coming::Misses };
        // Closely only where it is known how they go, and what it is that does not give way.
        let (pair, ways) = ([&a.shape, &b.shape], [&sweeps[0], &sweeps[1]]);
        let is_known = courses.iter().all(|it| it.sure) && !self.both_move(contact);
        if is_known && pass_by(pair, ways, (toi.fraction, 1.0), slop) {
            return Coming::Misses;
        }
        let is_solid = one_way::are_solid_along(meeting.shapes, meeting.turned, toi.normal);
        if toi.state == ToiState::Touching || !is_solid {
            return Coming::Unknown;
        }
        let frames = sweeps.map(|sweep| sweep.at(toi.fraction));
        let Some(manifold) = self.correct(contact, &meeting, &frames) else {
            return Coming::Unknown;
        };
        let prediction = meeting.predict(&manifold, &frames[0], toi.fraction);
        Coming::Hit(Hit { prediction: Some(prediction), ..prediction.hit(index, self.near()) })
    }

    /// A contact that touches at one point, with the other: hits may turn a body so that this comes down in the step.
    fn other_point(
        &self,
        contact: &Contact,
        constraint: &ConstraintBlock,
        lane: usize,
    ) -> Option<Prediction> {
        if contact.class.max_points() < 2 {
            return None;
        }
        let both = constraint.points.iter().all(|point| point.normal_mass[lane] > 0.0);
        if both || !self.known.courses.have_struck(contact) {
            return None;
        }
        let meeting = self.meeting(contact, self.far(contact));
        // The narrow phase has found no other within its reach.
        if meeting.longest_way() <= self.reach() {
            return None;
        }
        let frames = meeting.frames();
        let manifold = self.correct(contact, &meeting, &frames)?;
        (manifold.count == 2).then(|| meeting.predict(&manifold, &frames[0], 0.0))
    }

    fn reach(&self) -> f32 {
        self.scene.narrow_phase.speculative_distance
    }

    fn length_unit(&self) -> f32 {
        self.scene.narrow_phase.ground.length_unit
    }

    fn near(&self) -> f32 {
        NEAR * self.length_unit()
    }

    fn meeting(&self, contact: &Contact, courses: [Course; 2]) -> Meeting<'_> {
        let Scene { bodies, shapes, dt, .. } = self.scene;
        Meeting::of((bodies, shapes), [contact.shape_a, contact.shape_b], courses, dt)
    }

    /// The manifold where the shapes are then, without what only seams make; nothing where that is all.
    fn correct(
        &self,
        contact: &Contact,
        meeting: &Meeting<'_>,
        frames: &[Transform; 2],
    ) -> Option<Manifold> {
        let reach = self.reach() + meeting.longest_way();
        let mut manifold = meeting.manifold(frames, reach);
        let (shape_a, shape_b) = (contact.shape_a, contact.shape_b);
        let (context, guards) = (&self.scene.narrow_phase, &self.scene.shapes.guards);
        if guards[shape_a as usize] | guards[shape_b as usize] != 0 && manifold.count > 0 {
            let [a, b] = meeting.shapes;
            let [frame_a, frame_b] = frames;
            let (box_a, box_b) = (frame_a.compose(a.box_frame), frame_b.compose(b.box_frame));
            let b_in_a = box_b.relative_to(box_a);
            let mut points = LanePoints::of(&manifold, a.box_frame);
            surfaces::correct(context, surfaces::Pair { shape_a, shape_b, b_in_a }, &mut points);
            manifold = points.manifold(a.box_frame, reach);
        }
        draw_near(&mut manifold, self.scene.bodies, meeting.bodies(), self.reach());
        (manifold.count > 0).then_some(manifold)
    }
}

/// Lists hits by time, then by contact: what comes first is handed on first.
fn list_by_time(found: &[Seen], order: &mut Vec<(u64, u32)>) {
    order.clear();
    for (chunk, Seen { hits, .. }) in found.iter().enumerate() {
        // The bits of what is not negative are in its order.
        let key = |hit: &Hit| u64::from(hit.fraction.to_bits()) << 32 | u64::from(hit.contact);
        let place = |k: usize| (chunk * CHUNK + k) as u32;
        order.extend(hits.iter().enumerate().map(|(k, hit)| (key(hit), place(k))));
    }
    order.sort_unstable_by_key(|&(key, _)| key);
}
