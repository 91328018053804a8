//! Two shapes on their ways: whether they come near, when, and the contact that they have then.

use super::courses::{Course, Leg};
use super::hits::Prediction;
use crate::dynamics::{Bodies, ShapeRecord, Shapes};
use crate::geometry::manifold::{self, Manifold};
use crate::geometry::{LINEAR_SLOP, Sweep, SweptBox, hit_at, pass_by};
use crate::math::{Rot, Transform, Vec2};
use crate::simd::Row;
use crate::stages::narrow_context::{Context, Ground};
use crate::stages::one_way;
use crate::stages::surfaces::Seams;

/// What rounding makes of places, as a part of how large and far away things are.
const ROUNDING: f32 = 1.0e-6;

/// Two shapes on their ways, in a frame that goes with the centre of mass of A.
pub(super) struct Meeting<'a> {
    pub(super) shapes: [&'a ShapeRecord; 2],
    pub(super) rows: [&'a Row; 2],
    /// Of the bodies at the start.
    pub(super) turned: [Rot; 2],
    /// From the centre of mass of A to that of B at the start.
    pub(super) between: Vec2,
    /// How they go on.
    pub(super) legs: [Leg; 2],
    /// How far they reach from the centres of mass of their bodies, metres.
    pub(super) extents: [f32; 2],
    /// The same of their bodies: less for a polygon, in whose box there is room.
    pub(super) disks: [f32; 2],
}

/// Do two shapes go past each other in the step as their bodies move now, though the points of their contact come together along
/// this normal?
pub(crate) fn go_by(context: &Context<'_>, both: [u32; 2], normal: Vec2) -> bool {
    let Ground { bodies, shapes, length_unit, .. } = context.ground;
    let body = |shape: u32| shapes.records[shape as usize].body;
    let courses = both.map(|shape| Course::of(bodies, context.dt, body(shape)));
    let meeting = Meeting::of((bodies, shapes), both, courses, context.dt);
    let ([a, b], [way_a, way_b]) = (meeting.shapes, meeting.sweeps());
    !meeting.shapes.iter().any(|shape| shape.one_way.is_some())
        && !meeting.ends_on_face(context.ground, both, 0, normal)
        && !meeting.ends_on_face(context.ground, both, 1, -normal)
        && pass_by([&a.shape, &b.shape], [&way_a, &way_b], (0.0, 1.0), LINEAR_SLOP * length_unit)
}

impl<'a> Meeting<'a> {
    /// That of two shapes whose bodies take these courses in a step of `dt` seconds.
    pub(super) fn of(
        (bodies, shapes): (&'a Bodies, &'a Shapes),
        both: [u32; 2],
        courses: [Course; 2],
        dt: f32,
    ) -> Self {
        let [pose_a, pose_b] = courses.map(|course| bodies.poses[course.body as usize]);
        Self {
            shapes: both.map(|shape| &shapes.records[shape as usize]),
            rows: both.map(|shape| &shapes.rows[shape as usize]),
            between: pose_b.p.relative_to(pose_a.p),
            turned: [pose_a.q, pose_b.q],
            legs: courses.map(|course| course.leg(dt)),
            extents: both.map(|shape| shapes.reach(shape)),
            disks: courses.map(|course| bodies.infos[course.body as usize].max_extent),
        }
    }

    pub(super) fn bodies(&self) -> [u32; 2] {
        self.shapes.map(|shape| shape.body)
    }

    /// Is one of the shapes one-way, and lets the other pass?
    pub(super) fn is_let_pass(&self) -> bool {
        let (turned, way) = (self.turned_way(), self.way());
        let lets =
            |k: usize, way: Vec2| one_way::lets_pass(self.shapes[k], self.turned[k], way, turned);
        lets(0, way) || lets(1, -way)
    }

    /// In the frame of shape A.
    pub(super) fn manifold(&self, [frame_a, frame_b]: &[Transform; 2], reach: f32) -> Manifold {
        let [a, b] = self.shapes;
        manifold::collide(&a.shape, &b.shape, frame_b.relative_to(*frame_a), reach)
    }

    /// How B goes on as A sees it.
    fn way(&self) -> Vec2 {
        self.legs[1].motion - self.legs[0].motion
    }

    /// Where the last legs would have begun.
    fn begin(&self) -> Vec2 {
        self.between + self.legs[1].offset - self.legs[0].offset
    }

    fn rotation(&self, k: usize) -> Rot {
        match self.legs[k].offset_turn {
            0.0 => self.turned[k],
            turn => self.turned[k].compose(Rot::from_angle(turn)),
        }
    }

    /// Since when both are on their last legs, as a part of the step.
    pub(super) fn since(&self) -> f32 {
        self.legs[0].since.max(self.legs[1].since)
    }

    /// The ways of the shapes.
    pub(super) fn sweeps(&self) -> [Sweep; 2] {
        let sweep = |k: usize, place: Vec2, way: Vec2| {
            let frame = Transform::new(place, self.rotation(k));
            Sweep::new(frame, Vec2::ZERO, way, self.legs[k].turn).child(self.shapes[k].central)
        };
        [sweep(0, Vec2::ZERO, Vec2::ZERO), sweep(1, self.begin(), self.way())]
    }

    /// Is this the normal of a face of one shape (`k`), past whose ends the other's nearest corner cannot come, or only where others
    /// go on from there?
    fn ends_on_face(&self, ground: Ground<'_>, both: [u32; 2], k: usize, out: Vec2) -> bool {
        let frames = self.frames();
        let (frame, place) = (frames[k], frames[1 - k]);
        let [core, corners] = [k, 1 - k].map(|k| self.shapes[k].shape.core());
        let normal = frame.q.unrotate(out);
        manifold::face_of(&core, normal).is_some_and(|face| {
            let corner = corners.points[corners.support(place.q.unrotate(-out))];
            let (along, (start, end)) = (normal.perp(), core.edge(face));
            let at = along.dot(frame.unapply(place.apply(corner)) - start);
            let way = frame.q.rotate(along).dot(self.way()) * if k == 0 { 1.0 } else { -1.0 };
            // The corner of what is round does not go on as that turns.
            let turned = self.turned_way_of([0, 1].map(|k| self.extents[k] - self.rows[k][6]));
            let (least, most) = (at + way.min(0.0) - turned, at + way.max(0.0) + turned);
            let length = along.dot(end - start);
            let goes_on = |from: Vec2, beyond: f32| {
                Seams::of(ground, both[k], both[1 - k], place.relative_to(frame))
                    .goes_on_level(from, along * beyond)
            };
            (least > 0.0 || goes_on(start, least)) && (most < length || goes_on(end, most - length))
        })
    }

    /// Where the shapes are as the step starts.
    pub(super) fn frames(&self) -> [Transform; 2] {
        let frame = |k: usize, place: Vec2| {
            Transform::new(place, self.turned[k]).compose(self.shapes[k].central)
        };
        [frame(0, Vec2::ZERO), frame(1, self.between)]
    }

    /// A part of the step for which the disks or the boxes around the shapes show that these stay apart; 1 for all of it.
    pub(super) fn apart_until(&self, slop: f32) -> f32 {
        let [a, b] = self.rows;
        let (begin, way) = (self.begin(), self.way());
        let size = begin.x.abs() + begin.y.abs() + self.longest_way();
        let least =
            hit_at(a[6] + b[6], slop) + ROUNDING * (self.extents[0] + self.extents[1] + size);
        let [disks, extents] = [self.disks, self.extents].map(|[a, b]| a + b);
        // Larger ones would have shown that the shapes do not come near.
        if disks < extents && self.disks_apart_until(disks + least) >= 1.0 {
            return 1.0;
        }
        let swept = |k: usize, way| SweptBox::new(self.rows[k], self.rotation(k), way);
        let still = swept(0, (Vec2::ZERO, Vec2::ZERO, self.legs[0].turn));
        let moving = swept(1, (begin, way, self.legs[1].turn));
        let boxes = still.apart_until(&moving, least);
        if boxes >= 1.0 {
            return boxes;
        }
        let disks = self.disks_apart_until(extents + least);
        if disks > boxes { disks } else { boxes }
    }

    /// The part of the step until when the centres of mass are further from each other than `least`; 1 if they always are.
    fn disks_apart_until(&self, least: f32) -> f32 {
        let (begin, way) = (self.begin(), self.way());
        let length = begin.length();
        let gap = (length - least) * (length + least);
        let coming = -begin.dot(way);
        let square = coming * coming - way.length_sq() * gap;
        if gap <= 0.0 {
            0.0
        } else if coming <= 0.0 || square <= 0.0 || gap >= coming + square.sqrt() {
            1.0
        } else {
            gap / (coming + square.sqrt())
        }
    }

    /// How far a point can come nearer in the step, metres.
    pub(super) fn longest_way(&self) -> f32 {
        self.way().length() + self.turned_way()
    }

    /// How far turning takes a point at most, metres.
    fn turned_way(&self) -> f32 {
        self.turned_way_of(self.extents)
    }

    fn turned_way_of(&self, reach: [f32; 2]) -> f32 {
        self.legs[0].turn.abs() * reach[0] + self.legs[1].turn.abs() * reach[1]
    }

    /// Do the disks around the shapes meet on their ways?
    pub(super) fn comes_near(&self) -> bool {
        self.disks_apart_until(self.extents[0] + self.extents[1]) < 1.0
    }

    /// The contact of the time of impact, its points as far apart as they still have to come; at 0, of the start of the step.
    pub(super) fn predict(
        &self,
        manifold: &Manifold,
        frame: &Transform,
        fraction: f32,
    ) -> Prediction {
        let gone = |leg: &Leg| {
            if fraction > 0.0 {
                (leg.offset + leg.motion * fraction, leg.offset_turn + leg.turn * fraction)
            } else {
                (Vec2::ZERO, 0.0)
            }
        };
        let [(way_a, turn_a), (way_b, turn_b)] = [gone(&self.legs[0]), gone(&self.legs[1])];
        let normal = frame.q.rotate(manifold.normal);
        let between = self.between + way_b - way_a;
        let mut prediction = Prediction {
            normal,
            between,
            way: way_a,
            points: [Vec2::ZERO; 2],
            separation: [f32::MAX; 2],
            id: [0.0; 2],
            fraction,
            pushed: [0.0; 2],
            parting: [0.0; 2],
        };
        for (k, point) in manifold.points().iter().enumerate() {
            let arm = frame.apply(point.point);
            let turned = (arm - between).cross(normal) * turn_b - arm.cross(normal) * turn_a;
            let opened = normal.dot(way_b - way_a) + turned;
            let coming = if opened < 0.0 { -opened } else { 0.0 };
            prediction.points[k] = arm;
            prediction.separation[k] = point.separation + coming;
            prediction.id[k] = f32::from(point.id);
        }
        prediction
    }
}
