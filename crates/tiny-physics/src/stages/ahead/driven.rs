//! What motors set going in a step: it may meet what it would not have met as it moved before.
//!
//! A flipper lies still and is told to turn at 20 radians a second: it does so from the first substep on. By its velocity at
//! the start of the step it would hit nothing, and passed a third of the balls that lay in its way.

use super::courses::Courses;
use crate::describe::{JointKind, Limits, Motor};
use crate::dynamics::{Bodies, JointRecord, NULL};
use crate::math::{Rot, Vec2};

/// One of the two bodies of a joint.
struct End {
    body: u32,
    /// From its centre of mass to its anchor, world.
    arm: Vec2,
    inv_mass: f32,
    inv_inertia: f32,
}

impl End {
    fn new(bodies: &Bodies, body: u32, anchor: Vec2) -> Self {
        let (inv_mass, inv_inertia) = bodies.inverse_masses(body);
        Self { body, arm: bodies.arm(body, anchor), inv_mass, inv_inertia }
    }

    /// The inverse of its inertia about its anchor.
    fn inverse_about_anchor(&self) -> f32 {
        let Self { arm, inv_mass, inv_inertia, .. } = *self;
        if inv_mass == 0.0 {
            return inv_inertia;
        }
        inv_inertia * inv_mass / (inv_mass + inv_inertia * arm.dot(arm))
    }
}

/// Notes where the bodies of a hinge or slider will go as its motor drives them, if that is far from where they would go as they
/// move now. They count as free but for the joint.
pub(super) fn foresee(bodies: &Bodies, record: &JointRecord, dt: f32, courses: &mut Courses) {
    let def = &record.def;
    let Some(motor) = def.kind.motor() else { return };
    let ends = [
        End::new(bodies, record.body_a, def.anchor_a),
        End::new(bodies, record.body_b, def.anchor_b),
    ];
    let [a, b] = [0, 1].map(|k| courses.of(bodies, dt, ends[k].body));
    let turned =
        |end: &End, by: f32| bodies.poses[end.body as usize].q.compose(Rot::from_angle(by));
    match def.kind {
        JointKind::Revolute { limits, .. } => {
            // The angle nearest to the middle of the limits is meant.
            let middle = limits.map_or(0.0, |limits| 0.5 * (limits.lower + limits.upper));
            let from = turned(&ends[0], def.angle_a).compose(Rot::from_angle(middle));
            let at = middle + turned(&ends[1], def.angle_b).angle_from(from);
            let gives = [0, 1].map(|k| ends[k].inverse_about_anchor());
            let impulse = impulse(motor, limits, [at, b.spin - a.spin], gives, dt);
            for (end, spin) in ends.iter().zip([-impulse * gives[0], impulse * gives[1]]) {
                keep(bodies, end.body, (-end.arm.perp() * spin, spin), dt, courses);
            }
        }
        JointKind::Prismatic { limits, .. } => {
            let line = turned(&ends[0], def.angle_a).x_axis();
            let [from, to] = [0, 1].map(|k| bodies.poses[ends[k].body as usize].p);
            let between = to.relative_to(from);
            let at = line.dot(between + ends[1].arm - ends[0].arm);
            let gives = [ends[0].inv_mass, ends[1].inv_mass];
            // The line turns with A, and B with it.
            let speed = line.dot(b.velocity - a.velocity) + a.spin * line.perp().dot(between);
            let impulse = impulse(motor, limits, [at, speed], gives, dt);
            for (end, change) in ends.iter().zip([-impulse * gives[0], impulse * gives[1]]) {
                keep(bodies, end.body, (line * change, 0.0), dt, courses);
            }
        }
        _ => {}
    }
}

/// What a motor gives in a step, in which it goes no further than the joint's limits.
fn impulse(
    motor: Motor,
    limits: Option<Limits>,
    [at, speed]: [f32; 2],
    gives: [f32; 2],
    dt: f32,
) -> f32 {
    let mut wanted = motor.speed;
    if let Some(Limits { lower, upper }) = limits {
        wanted = wanted.min((upper - at).max(0.0) / dt).max((lower - at).min(0.0) / dt);
    }
    let give = gives[0] + gives[1];
    let most = motor.max * dt;
    if give > 0.0 { ((wanted - speed) / give).max(-most).min(most) } else { 0.0 }
}

/// Keeps the course of a body whose velocities will have changed by so much.
fn keep(bodies: &Bodies, body: u32, (velocity, spin): (Vec2, f32), dt: f32, courses: &mut Courses) {
    let info = &bodies.infos[body as usize];
    let astray = velocity.length() * dt + info.turned_reach(spin * dt);
    let meets = info.first_shape != NULL && bodies.is_solved(body);
    // Also false for what is not finite.
    if meets && astray > super::HARMLESS * info.min_extent && astray < f32::MAX {
        let mut course = courses.of(bodies, dt, body);
        course.velocity += velocity;
        course.spin += spin;
        course.motion += velocity * dt;
        course.turn += spin * dt;
        course.astray += astray;
        courses.keep(&course);
    }
}
