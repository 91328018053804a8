//! Contacts of what turns fast go along with it, substep by substep.
//!
//! A contact keeps its normal and lever arms for a step, as if all went straight on. What slides by `u` over something
//! that turns by `w` is so off by `u w`, a corner with an arm `r` by `r w^2 / 2`. Where that is more than may be pushed out
//! again in the step, things sink in and pass. So those contacts are found anew before each substep, for where their bodies
//! will be in the middle of it: what is off then is of third order. What lies on a drum goes along its arc the same way.

use super::ahead::{HEAVIER, Predictions};
use super::anew::{self, Course, Scope};
use super::islands::Stores;
use crate::dynamics::{Bodies, Bucket, Contact, Contacts, Graph, Joints, Place, Shapes};
use crate::footprint::footprint;
use crate::geometry::Shape;
use crate::math::Vec2;
use crate::simd::BLOCK;
use crate::threads::Team;

/// What is off by less than this part of the thinner half thickness is left as it is.
const HARMLESS: f32 = 0.1;
/// A normal that turns further than by this cosine is of another face: what is deep in something goes on out by the old one. Without,
/// 13 of 60 crowds that meet go deeper than a fifth of a body, in place of 5.
const TURNED: f32 = 0.7;

/// A contact that is found anew, by bucket in the graph's list and slot in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Arc {
    at: (usize, usize),
    /// It is foreseen or bounces: until it pushes in a substep it stays as it is.
    waits: bool,
}

/// The contacts of what turns fast.
#[derive(Debug, Default)]
pub(crate) struct Arcs {
    list: Vec<Arc>,
    /// By chunks of the bodies that are awake.
    found: Vec<Vec<Arc>>,
}

footprint!(Arcs { list } each { found });

/// Bodies that one member of the team looks at in search of what turns fast.
const CHUNK: usize = 256;

impl Arcs {
    /// Lists the contacts that a step of `dt` seconds would take off by more than `most` metres.
    pub(crate) fn list(
        &mut self,
        team: &Team,
        stores: &Stores<'_>,
        shapes: &Shapes,
        predictions: &Predictions,
        (dt, most): (f32, f32),
    ) {
        let Stores { bodies, contacts, graph, joints, .. } = stores;
        let (bodies, contacts, graph, joints) = (&**bodies, &**contacts, &**graph, &**joints);
        let search = Search { bodies, contacts, graph, joints, shapes, predictions, dt, most };
        let found = team.map_chunks(bodies.awake.len(), CHUNK, &mut self.found, |range, found| {
            found.clear();
            bodies.awake[range].iter().for_each(|&body| search.list_of(body, found));
        });
        self.list.clear();
        self.list.extend(found.iter().flatten());
        self.list.sort_unstable();
        self.list.dedup();
    }

    /// Is a contact found anew?
    pub(crate) fn holds(&self, at: (usize, usize)) -> bool {
        self.list.binary_search_by_key(&at, |arc| arc.at).is_ok()
    }

    /// Finds those of a pace anew before a substep of `h` seconds, half of it ahead; the `first` has what the narrow phase found.
    pub(crate) fn renew(
        &mut self,
        (bodies, graph): (&mut Bodies, &mut Graph),
        scope: Scope<'_>,
        (pace, h): (usize, f32),
        first: bool,
    ) {
        if first {
            return;
        }
        let range = graph.range_of_pace(pace);
        for arc in self.list.iter_mut().filter(|arc| range.contains(&arc.at.0)) {
            arc.renew(bodies, &mut graph.buckets.list_mut()[arc.at.0], scope, h);
        }
    }
}

/// What contacts of what turns fast are found by.
struct Search<'a> {
    bodies: &'a Bodies,
    contacts: &'a Contacts,
    graph: &'a Graph,
    joints: &'a Joints,
    shapes: &'a Shapes,
    predictions: &'a Predictions,
    dt: f32,
    most: f32,
}

impl Search<'_> {
    /// Lists those of a body, if it turns fast.
    #[inline]
    fn list_of(&self, body: u32, found: &mut Vec<Arc>) {
        let Self { bodies, contacts, graph, joints, shapes, predictions, dt, most } = *self;
        let turn = predictions.turn(bodies, dt, body);
        let info = &bodies.infos[body as usize];
        let rim = turn.abs() * info.max_extent;
        if rim <= most || rim <= HARMLESS * info.min_extent || is_joined(bodies, joints, body) {
            return;
        }
        let way = |body: u32| predictions.motion(bodies, dt, body);
        for (index, side) in contacts.of_body(info.first_contact) {
            let contact = &contacts.records[index as usize];
            if !contact.touching {
                continue;
            }
            let (own, other) = sides(contact, side);
            let is_left = || has_rules(contact, shapes, own) || is_joined(bodies, joints, other);
            let slide = (way(other) - way(body)).length();
            let is_disk = matches!(shapes.records[own as usize].shape, Shape::Circle { .. });
            let half = bodies.thinner_half([body, other]);
            let off = turn.abs() * (slide + 0.5 * rim);
            if is_disk || off <= most || off <= HARMLESS * half || is_left() {
                continue;
            }
            let waits = predictions.of(index).is_some() || contact.restitution > 0.0;
            found.extend(graph.solved_at(contact).map(|at| Arc { at, waits }));
        }
    }
}

/// Joints with what moves freely move a body otherwise than its velocity says: it is left out. With them 7 of 216 pits of ragdolls never
/// sleep in place of 2, and in 600 random worlds 21 bodies pass in place of 19. What hangs on something fixed or heavy, such as a
/// flipper, goes as it turns.
fn is_joined(bodies: &Bodies, joints: &Joints, body: u32) -> bool {
    let to_free = |(joint, _): (u32, u32)| {
        let record = &joints.records[joint as usize];
        let [own, other] = [body, record.other(body)].map(|body| bodies.inverse_masses(body).0);
        record.place != Place::Asleep && HEAVIER * other > own
    };
    bodies.is_dynamic(body) && joints.of_body(bodies.infos[body as usize].first_joint).any(to_free)
}

/// Is one of the shapes one-way, a link of a chain, or, but for the one that turns, beside others? Surfaces have rules
/// of their own.
fn has_rules(contact: &Contact, shapes: &Shapes, turns: u32) -> bool {
    [contact.shape_a, contact.shape_b].into_iter().any(|shape| {
        let is_guarded = shape != turns && shapes.guards[shape as usize] != 0;
        is_guarded || anew::has_rules(shapes, shape)
    })
}

/// The shape of a contact on one side, and the body on the other.
fn sides(contact: &Contact, side: u32) -> (u32, u32) {
    if side == 0 { (contact.shape_a, contact.body_b) } else { (contact.shape_b, contact.body_a) }
}

impl Arc {
    fn renew(&mut self, bodies: &mut Bodies, bucket: &mut Bucket, scope: Scope<'_>, h: f32) {
        let (block, lane) = (self.at.1 / BLOCK, self.at.1 % BLOCK);
        let (constraint, known) = (&mut bucket.constraints[block], &mut bucket.manifolds[block]);
        self.waits &= constraint.points.iter().all(|point| point.normal_impulse[lane] == 0.0);
        let both = [known.body_a[lane], known.body_b[lane]];
        // Trees take contacts out of their lanes, and hooks switch them off.
        let is_off = constraint.points.iter().all(|point| point.normal_mass[lane] <= 0.0);
        if self.waits || is_off || [constraint.body_a[lane], constraint.body_b[lane]] != both {
            return;
        }
        let course = Course::new(bodies, both, 0.5 * h, h);
        let shapes = [known.shape_a[lane], known.shape_b[lane]];
        let (frame, found) = course.collide(bodies, scope, shapes);
        let normal = Vec2::new(constraint.normal_x[lane], constraint.normal_y[lane]);
        if found.count > 0 && frame.q.rotate(found.normal).dot(normal) > TURNED {
            course.write(bodies, (constraint, known, lane), frame, &found);
        }
    }
}
