//! Slips: two bodies that move freely have got into each other though there was a contact.
//!
//! Contacts keep their normals for a step, and what corners, spins and crowds make of a fast body in it nobody can
//! foresee in full. What goes in by half its half thickness may come out on the other side. Such two end the step where
//! they were so deep, with the velocities that they have; the contact of the next step sees them on the sides that they
//! came from.

use super::finalize::{FastBody, SAFE_FRACTION};
use crate::describe::BodyKind;
use crate::dynamics::{Bodies, Contact, Contacts, Joints, ShapeRecord, Shapes};
use crate::geometry::manifold::{RoundedBox, ShapeClass};
use crate::geometry::{LINEAR_SLOP, MIN_EXTENT, Shape, Sweep, Toi, ToiState, impact_within};
use crate::math::{Rot, Transform, Vec2};
use crate::threads::Team;

/// So thick is the core of a shape as a part of it; it is as long as its middle line.
const CORE: f32 = 0.5;
/// What turns by less in a step than this keeps the normals of its contacts, radians.
const TURNED: f32 = 0.5;
/// Bodies that one member of the team looks at at a time.
const CHUNK: usize = 16;
/// What was set back may be in the way of others: they are looked at again, so often at most.
const ROUNDS: usize = 2;
/// What is near more others than this is held by them: hundreds of things that press at speed would be set back for ever.
const CROWD: usize = 4;

/// A body that slipped into another, when, as a part of its way, and that other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slip {
    body: u32,
    other: u32,
    fraction: f32,
}

/// By chunks of the fast bodies.
pub(crate) type Found = Vec<Vec<Slip>>;

/// What slips are looked for in.
#[derive(Clone, Copy)]
pub(crate) struct Scene<'a> {
    pub(crate) bodies: &'a Bodies,
    pub(crate) shapes: &'a Shapes,
    pub(crate) contacts: &'a Contacts,
    pub(crate) joints: &'a Joints,
    /// Shapes, each with a body that the user wants no contact of it with; sorted.
    pub(crate) off: &'a [[u32; 2]],
    /// See [`Settings::length_unit`](crate::Settings).
    pub(crate) length_unit: f32,
}

/// Sets fast bodies (ascending) back to where they slipped into others, and these with them.
pub(crate) fn set_back(team: &Team, fast: &mut Vec<FastBody>, scene: Scene<'_>, found: &mut Found) {
    for _ in 0..ROUNDS {
        let all = &**fast;
        let chunks = team.map_chunks(fast.len(), CHUNK, found, |range, found| {
            found.clear();
            found.extend(all[range].iter().filter_map(|fast| Search { all, scene }.first(fast)));
        });
        let mut any = false;
        for &Slip { body, other, fraction } in chunks.iter().flatten() {
            any = true;
            // What is joined would tear its joints by what others go on.
            let Scene { bodies, joints, .. } = scene;
            let is_free = !joints.act_on(bodies.infos[other as usize].first_joint);
            let both = [Some(body), (is_free && bodies.is_solved(other)).then_some(other)];
            for body in both.into_iter().flatten() {
                let (at, _) = FastBody::place_in(fast, scene.bodies, body);
                let way = &mut fast[at];
                way.set_back(fraction * way.fraction);
            }
        }
        if !any {
            return;
        }
    }
}

/// The search for the first slip of a body.
struct Search<'a> {
    /// The fast bodies, ascending.
    all: &'a [FastBody],
    scene: Scene<'a>,
}

impl Search<'_> {
    /// The part of its way at which a body first slipped into another that moves freely.
    fn first(&self, fast: &FastBody) -> Option<Slip> {
        let Scene { bodies, contacts, off, .. } = self.scene;
        let others = || contacts.of_body(bodies.infos[fast.body as usize].first_contact);
        if others().count() > CROWD {
            return None;
        }
        let mut first = Slip { body: fast.body, other: fast.body, fraction: 1.0 };
        for (index, side) in others() {
            let contact = &contacts.records[index as usize];
            let [shape, other] =
                [[contact.shape_a, contact.body_b], [contact.shape_b, contact.body_a]]
                    [side as usize];
            let kind = bodies.infos[other as usize].kind;
            if kind == BodyKind::Kinematic && self.is_swept(fast, other) {
                return None;
            }
            if bodies.is_dynamic(other) && off.binary_search(&[shape, other]).is_err() {
                let other = self.course(other);
                if self.may_slip(fast, &other) {
                    let ways = if side == 0 { [fast, &other] } else { [&other, fast] };
                    match self.slip(contact, ways, first.fraction) {
                        None => {}
                        // What was in before is being pushed out; it may have been put there.
                        Some(toi) if toi.state == ToiState::Touching => return None,
                        Some(toi) => {
                            first = Slip { other: other.body, fraction: toi.fraction, ..first };
                        }
                    }
                }
            }
        }
        (first.fraction < 1.0).then_some(first)
    }

    /// How a body went, so far as it is known by now.
    fn course(&self, body: u32) -> FastBody {
        match self.all.binary_search_by_key(&body, |fast| fast.body) {
            Ok(at) => self.all[at],
            Err(_) => FastBody::of_step(self.scene.bodies, body),
        }
    }

    /// Has something so fast come along with a body that it would go through it, were that set back?
    fn is_swept(&self, fast: &FastBody, other: u32) -> bool {
        let rest = FastBody { motion: Vec2::ZERO, turn: 0.0, ..*fast };
        self.may_slip(&rest, &self.course(other))
    }

    /// Did a body move far enough, seen from another, to have jumped into it?
    fn may_slip(&self, fast: &FastBody, other: &FastBody) -> bool {
        let Scene { bodies, .. } = self.scene;
        if fast.turn.abs() + other.turn.abs() < TURNED {
            return false;
        }
        let reach = |body: &FastBody| bodies.infos[body.body as usize].turned_reach(body.turn);
        let way = (fast.motion - other.motion).length() + reach(fast) + reach(other);
        way > SAFE_FRACTION * bodies.thinner_half([fast.body, other.body])
    }

    /// When the core of the thinner shape of a contact comes into the other, up to a part of the step. The same whichever of both is
    /// the fast one.
    fn slip(&self, contact: &Contact, ways: [&FastBody; 2], most: f32) -> Option<Toi> {
        let Scene { shapes, length_unit, .. } = self.scene;
        let records = [contact.shape_a, contact.shape_b].map(|i| &shapes.records[i as usize]);
        if records.iter().any(|record| record.one_way.is_some() || record.link.is_some()) {
            return None;
        }
        let [a, b] = ways.map(|way| way.seen_from(ways[0].start));
        let halves = records.map(|record| record.shape.inner_radius());
        // What has no inside is never half in.
        if halves[0] == 0.0 || halves[1] == 0.0 {
            return None;
        }
        let thin = usize::from(halves[1] < halves[0]);
        let ((record, own), (other, their)) = match thin {
            0 => ((records[0], &a), (records[1], &b)),
            _ => ((records[1], &b), (records[0], &a)),
        };
        let their = their.child(other.central);
        let radius = CORE * halves[thin];
        let (core, own) = core_of(record, radius, own);
        let slop = (LINEAR_SLOP * length_unit).min(radius);
        impact_within(&core, &own, &other.shape, &their, (0.0, most), slop)
    }
}

/// The core of a shape, and how it moves with its body.
fn core_of(record: &ShapeRecord, radius: f32, body: &Sweep) -> (Shape, Sweep) {
    let disk = |middle: Vec2| {
        let frame = Transform::new(middle, Rot::IDENTITY);
        (Shape::Circle { radius }, body.child(record.central.compose(frame)))
    };
    if record.class == ShapeClass::General {
        return disk(record.shape.mass_properties(1.0).center);
    }
    let RoundedBox { frame, half_extents, .. } = RoundedBox::of(&record.shape);
    let reach = half_extents.x - half_extents.y;
    if reach.abs() < MIN_EXTENT {
        return disk(frame.p);
    }
    let end = if reach > 0.0 { Vec2::new(reach, 0.0) } else { Vec2::new(0.0, reach) };
    (Shape::Capsule { a: -end, b: end, radius }, body.child(record.central.compose(frame)))
}
