//! Hits, and the contacts that are foreseen for them.

use super::courses::Course;
use crate::dynamics::ConstraintBlock;
use crate::math::Vec2;

/// What hits a body within so little of its way does so at once, metres; multiplied by the length unit. Times of impact are known to
/// half of it.
const AT_ONCE: f32 = 0.001;

/// A contact as it will be at the time of impact, seen from the start of the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Prediction {
    /// From A to B, world.
    pub(crate) normal: Vec2,
    /// From the centre of mass of A to that of B.
    pub(crate) between: Vec2,
    /// How far that of A has come by then, metres.
    pub(crate) way: Vec2,
    /// Relative to the centre of mass of A.
    pub(crate) points: [Vec2; 2],
    /// Metres at the start of the step; the largest number for a point that is not there.
    pub(crate) separation: [f32; 2],
    pub(crate) id: [f32; 2],
    /// When, as a part of the step.
    pub(super) fraction: f32,
    /// What it has pushed so far, as hits are handed on, N s.
    pub(super) pushed: [f32; 2],
    /// How fast its points part after the hits before it, m/s.
    pub(crate) parting: [f32; 2],
}

/// A hit: where, and how soon.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub(super) contact: u32,
    pub(super) prediction: Option<Prediction>,
    pub(super) fraction: f32,
    /// Between the points at the start of the step, metres; 0 where they touch.
    pub(super) apart: f32,
    pub(super) normal: Vec2,
    /// Of each point; the same twice where there is one.
    pub(super) arms: [Arms; 2],
}

/// Cross products of a point with the normal and with the tangent (the normal turned clockwise), on A and on B.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arms {
    pub(super) normal: [f32; 2],
    pub(super) tangent: [f32; 2],
}

impl Hit {
    /// That of a contact that touches already.
    pub(super) fn touching(contact: u32, constraint: &ConstraintBlock, lane: usize) -> Self {
        let normal = Vec2::new(constraint.normal_x[lane], constraint.normal_y[lane]);
        let there = |k: usize| constraint.points[k].normal_mass[lane] > 0.0;
        let arm = |k: usize| {
            let point = &constraint.points[if there(k) { k } else { 1 - k }];
            Arms {
                normal: [point.normal_arm_a[lane], point.normal_arm_b[lane]],
                tangent: [point.tangent_arm_a[lane], point.tangent_arm_b[lane]],
            }
        };
        Self {
            contact,
            prediction: None,
            fraction: 0.0,
            apart: 0.0,
            normal,
            arms: [arm(0), arm(1)],
        }
    }

    /// When it comes, as these bodies move since they were hit last: a part of the step.
    pub(super) fn when(&self, courses: &[Course; 2], dt: f32) -> f32 {
        let (closing, [a, b]) = (-self.parting(courses)[0], courses);
        if self.apart == 0.0 || closing <= 0.0 {
            return self.fraction;
        }
        let arms = self.arms[0].normal;
        let turning = b.turn * arms[1] - a.turn * arms[0];
        let at_end = self.apart + self.normal.dot(b.motion - a.motion) + turning;
        (1.0 + at_end / (closing * dt)).max(0.0).min(self.fraction)
    }

    /// These bodies at its moment.
    pub(super) fn at_moment(&self, courses: &[Course; 2], unit: f32, dt: f32) -> [Course; 2] {
        let closing = -self.parting(&courses.map(Course::before)).into_iter().fold(0.0, f32::min);
        let near = if closing > 0.0 { AT_ONCE * unit / (closing * dt) } else { 0.0 };
        courses.map(|course| course.at(self.fraction, near))
    }

    /// How fast its points part, if others of its moment have not slowed these bodies.
    pub(super) fn unslowed(&self, courses: &[Course; 2]) -> [f32; 2] {
        let [now, before] = [*courses, courses.map(Course::before)].map(|of| self.parting(&of));
        [0, 1].map(|k| now[k].min(before[k]))
    }

    /// How fast its points part, as these bodies move.
    pub(super) fn parting(&self, [a, b]: &[Course; 2]) -> [f32; 2] {
        self.arms.map(|arms| {
            b.speed_at(arms.normal[1], self.normal) - a.speed_at(arms.normal[0], self.normal)
        })
    }
}

/// How far bodies will go into each other at the deepest point of a contact, as they move, metres.
pub(super) fn goes_in(constraint: &ConstraintBlock, lane: usize, [a, b]: [&Course; 2]) -> f32 {
    let normal = Vec2::new(constraint.normal_x[lane], constraint.normal_y[lane]);
    let along = normal.dot(a.motion - b.motion);
    let there = constraint.points.iter().filter(|point| point.normal_mass[lane] > 0.0);
    let depths = there.map(|point| {
        let turning = a.turn * point.normal_arm_a[lane] - b.turn * point.normal_arm_b[lane];
        along + turning - point.separation[lane].max(0.0)
    });
    depths.fold(f32::MIN, f32::max)
}

impl Prediction {
    /// `near` is how far points may be apart that are hit together, metres.
    pub(super) fn hit(&self, contact: u32, near: f32) -> Hit {
        let Self { fraction, normal, between, .. } = *self;
        let apart = self.separation[0].min(self.separation[1]).max(0.0);
        // One that still has to come when the other is there is not hit.
        let is_hit = |k: usize| self.separation[k] <= self.separation[1 - k] + near;
        let arm = |k: usize| {
            let point = self.points[if is_hit(k) { k } else { 1 - k }];
            let on = |axis: Vec2| [point.cross(axis), (point - between).cross(axis)];
            Arms { normal: on(normal), tangent: on(-normal.perp()) }
        };
        Hit { contact, prediction: None, fraction, apart, normal, arms: [arm(0), arm(1)] }
    }
}
