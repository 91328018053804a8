//! What forces, motors and springs set going in a step: it may meet what it would not have met as it moved before.
//!
//! A flipper lies still and is told to turn at 20 radians a second, or the plunger beside it is let go: they do so from the first
//! substep on. By their velocities at the start of the step they would hit nothing, and a third of the flippers and more than
//! half of the plungers passed the ball that lay in their way.

use super::courses::{Course, Courses};
use crate::describe::{JointDef, JointKind, Limits, Motor, Spring};
use crate::dynamics::{Bodies, JointRecord, Joints, NULL, REFINEMENT, inverse_mass_along};
use crate::math::{Rot, Vec2};

/// A motor pushes as hard as it can from this part of its greatest force on.
const SATURATED: f32 = 0.99;
/// What presses on something gives way to a spring that gets so much stronger within a step.
const STRONGER: f32 = 2.0;
/// Joints of a body that are looked through for one that holds it.
const HINGES: usize = 8;
/// A motor that gets so much of its speed goes on, as does one that gains some, and a spring of whose pull so much goes into motion and
/// damping: the rest is held.
const GOES: f32 = 0.5;
const YIELDS: f32 = 0.25;
/// A spring is at its rest so near to it, metres (times the length unit) or radians, and where it pulls no more than this, by the second
/// squared: what would take 20 seconds to get to the usual sleep speed.
const NEAR: f32 = 0.005;
const FAINT: f32 = 0.0025;

/// What a joint that presses one of its bodies on something did in the last step, newtons or newton metres: its spring and
/// its motor. Of a joint that drags a body somewhere, all its force is its spring's.
#[derive(Clone, Copy)]
pub(crate) struct Held {
    pub(crate) spring: f32,
    pub(crate) motor: f32,
}

/// One of the two bodies of a joint.
struct End<'a> {
    bodies: &'a Bodies,
    course: Course,
    /// From its centre of mass to its anchor, world.
    arm: Vec2,
    /// Along x and y.
    inv_masses: [f32; 2],
    /// Where locks do not matter.
    inv_mass: f32,
    inv_inertia: f32,
}

impl<'a> End<'a> {
    fn new(bodies: &'a Bodies, course: Course, anchor: Vec2) -> Self {
        let [x, y, inv_inertia] = bodies.inverses(course.body);
        let (inv_masses, inv_mass) = ([x, y], bodies.inverse_masses(course.body).0);
        let arm = bodies.arm(course.body, anchor);
        Self { bodies, course, arm, inv_masses, inv_mass, inv_inertia }
    }

    fn frame(&self, by: f32) -> Rot {
        self.bodies.poses[self.course.body as usize].q.compose(Rot::from_angle(by))
    }

    /// Velocity of its anchor.
    fn velocity(&self) -> Vec2 {
        self.course.velocity + self.arm.perp() * self.course.spin
    }

    /// What an impulse changes of its velocity.
    fn moved(&self, impulse: Vec2) -> Vec2 {
        let [x, y] = self.inv_masses;
        Vec2::new(impulse.x * x, impulse.y * y)
    }

    /// What an impulse at its anchor changes of its velocities.
    fn pushed(&self, impulse: Vec2) -> (Vec2, f32) {
        (self.moved(impulse), self.inv_inertia * self.arm.cross(impulse))
    }

    /// What an angular impulse changes while the end of an arm stays.
    fn turned_about(&self, arm: Vec2, impulse: f32) -> (Vec2, f32) {
        let Self { inv_mass, inv_inertia, .. } = *self;
        if inv_mass == 0.0 {
            return (Vec2::ZERO, inv_inertia * impulse);
        }
        let spin = inv_inertia * inv_mass / (inv_mass + inv_inertia * arm.dot(arm)) * impulse;
        (-arm.perp() * spin, spin)
    }

    /// The arm to what a joint's torque turns it about: the anchor there, or one by which another joint holds it, or its centre.
    fn pivot(&self, joints: &Joints, def: &JointDef, side: usize) -> Vec2 {
        if self.inv_mass == 0.0 || holds(def, side) {
            return self.arm;
        }
        let body = self.course.body;
        let others = joints.of_body(self.bodies.infos[body as usize].first_joint).take(HINGES);
        let mut others = others.map(|(index, side)| (&joints.records[index as usize].def, side));
        let hinge = others.find(|&(def, side)| def.enabled && holds(def, side as usize));
        hinge.map_or(Vec2::ZERO, |(def, side)| {
            self.bodies.arm(body, [def.anchor_a, def.anchor_b][side as usize])
        })
    }
}

/// Does a joint hold one of its bodies at its anchor?
fn holds(def: &JointDef, side: usize) -> bool {
    match def.kind {
        JointKind::Revolute { .. } | JointKind::Weld { linear: None, .. } => true,
        JointKind::Wheel { .. } => side == 1,
        _ => false,
    }
}

/// A coordinate of two bodies that something drives, metres or radians.
struct Coordinate {
    /// As limits count it, and away from where the spring rests.
    at: f32,
    away: f32,
    speed: f32,
    /// What an impulse of 1 along it changes of the bodies' velocities, and of its own speed.
    changes: [(Vec2, f32); 2],
    give: f32,
    /// Is it an angle?
    turns: bool,
}

impl Coordinate {
    /// The angle of a joint, that nearest to the middle of its limits.
    fn angle(
        (joints, def): (&Joints, &JointDef),
        ends: &[End<'_>; 2],
        rest: f32,
        limits: Option<Limits>,
    ) -> Self {
        let (from, to) = (ends[0].frame(def.angle_a), ends[1].frame(def.angle_b));
        let rest = Rot::from_angle(rest);
        let (at, away) = match limits {
            Some(Limits { lower, upper }) => {
                let middle = 0.5 * (lower + upper);
                let turned = Rot::from_angle(middle);
                let from_middle = to.angle_from(from.compose(turned));
                (middle + from_middle, from_middle - rest.angle_from(turned))
            }
            None => (0.0, to.angle_from(from.compose(rest))),
        };
        let turned = |k: usize, by| ends[k].turned_about(ends[k].pivot(joints, def, k), by);
        let changes = [turned(0, -1.0), turned(1, 1.0)];
        let speed = ends[1].course.spin - ends[0].course.spin;
        Self { at, away, speed, changes, give: changes[1].1 - changes[0].1, turns: true }
    }

    /// That of a slider. Its line turns with A, and B with it.
    fn slide(ends: &[End<'_>; 2], angle_a: f32, rest: f32) -> Self {
        let [a, b] = ends;
        let line = a.frame(angle_a).x_axis();
        let (gap, velocity) = (gap(ends), b.course.velocity - a.course.velocity);
        let between = gap + a.arm - b.arm;
        let at = line.dot(gap);
        let speed = line.dot(velocity) + a.course.spin * line.perp().dot(between);
        let changes = [(a.moved(-line), 0.0), (b.moved(line), 0.0)];
        let of = |end: &End<'_>| inverse_mass_along((), [line.x, line.y], end.inv_masses);
        let give = of(a) + of(b);
        Self { at, away: at - rest, speed, changes, give, turns: false }
    }

    /// That of two anchors along a line of the world, on which they are as far from each other as it is long.
    fn along(ends: &[End<'_>; 2], line: Vec2, rest: f32) -> Self {
        let (line, at) = line.direction_and_length();
        let changes = [ends[0].pushed(-line), ends[1].pushed(line)];
        let speed = line.dot(ends[1].velocity() - ends[0].velocity());
        let gives = [0, 1].map(|k| {
            let (velocity, spin) = changes[k];
            line.dot(velocity + ends[k].arm.perp() * spin)
        });
        Self { at, away: at - rest, speed, changes, give: gives[1] - gives[0], turns: false }
    }

    /// What an impulse along it changes of one of its bodies.
    fn change(&self, end: &End<'_>, k: usize, impulse: f32) -> Change {
        let (velocity, spin) = self.changes[k];
        Change { body: end.course.body, velocity: velocity * impulse, spin: spin * impulse }
    }
}

/// From anchor A to anchor B.
fn gap([a, b]: &[End<'_>; 2]) -> Vec2 {
    let [from, to] = [a, b].map(|end| end.bodies.poses[end.course.body as usize].p);
    to.relative_to(from) + b.arm - a.arm
}

/// What drives a coordinate.
#[derive(Clone, Copy)]
struct Effort {
    spring: Option<Spring>,
    /// Greatest force of the spring.
    strongest: f32,
    motor: Option<Motor>,
    limits: Option<Limits>,
}

impl Effort {
    /// Of a joint's free coordinate.
    fn new(spring: Option<Spring>, motor: Option<Motor>, limits: Option<Limits>) -> Self {
        Self { spring, strongest: f32::MAX, motor, limits }
    }

    /// Of a spring of bounded force.
    fn pull(spring: Option<Spring>, strongest: f32) -> Self {
        Self { spring, strongest, motor: None, limits: None }
    }

    /// What it gives in a step, in which the coordinate goes no further than its limits.
    fn impulse(&self, of: &Coordinate, held: Option<Held>, dt: f32) -> f32 {
        if of.give <= 0.0 {
            return 0.0;
        }
        let spring = self.spring.map_or(0.0, |spring| self.sprung(spring, of, held, dt));
        let mut speed = of.speed + spring * of.give;
        if let Some(Motor { speed: wanted, max }) = self.motor {
            let stalled = held.is_some_and(|held| held.motor * wanted.signum() > SATURATED * max);
            if !stalled {
                let most = max * dt * of.give;
                speed += (wanted - speed).max(-most).min(most);
            }
        }
        if let Some(Limits { lower, upper }) = self.limits {
            speed = speed.min((upper - of.at).max(0.0) / dt).max((lower - of.at).min(0.0) / dt);
        }
        (speed - of.speed) / of.give
    }

    /// What a spring gives, as a mean over the step: what takes the coordinate where it will be, as long as it goes there. Nothing where it
    /// pressed on something before as hard as now.
    fn sprung(&self, spring: Spring, of: &Coordinate, held: Option<Held>, dt: f32) -> f32 {
        let rate = core::f32::consts::TAU * spring.hertz;
        let force = (-of.away * rate * rate / of.give).max(-self.strongest).min(self.strongest);
        if held.is_some_and(|held| STRONGER * held.spring * force.signum() > force.abs()) {
            return 0.0;
        }
        // Of a quarter of a swing, at most: 1 - cos x, and damped by about as much as it is slower.
        let x = (rate * dt).min(core::f32::consts::FRAC_PI_2);
        let part = x * x * (0.5 - x * x / 24.0) / (1.0 + spring.damping_ratio * x);
        let most = self.strongest * dt;
        (-of.away * part / (dt * of.give)).max(-most).min(most)
    }
}

/// The bodies of a joint, going as they are said to.
fn ends<'a>(
    bodies: &'a Bodies,
    record: &JointRecord,
    course: impl Fn(u32) -> Course,
) -> [End<'a>; 2] {
    let JointDef { kind, anchor_a, anchor_b, .. } = record.def;
    // A mouse joint does nothing to its A.
    let body_a = if matches!(kind, JointKind::Mouse { .. }) { 0 } else { record.body_a };
    [(body_a, anchor_a), (record.body_b, anchor_b)]
        .map(|(body, anchor)| End::new(bodies, course(body), anchor))
}

/// What drives the bodies of a joint, along which coordinates.
fn efforts(
    joints: &Joints,
    def: &JointDef,
    ends: &[End<'_>; 2],
) -> [Option<(Coordinate, Effort)>; 3] {
    let angle = |rest, limits| Coordinate::angle((joints, def), ends, rest, limits);
    match def.kind {
        JointKind::Revolute { spring, target_angle, limits, motor } => {
            let effort = Effort::new(spring, motor, limits);
            [Some((angle(target_angle, limits), effort)), None, None]
        }
        JointKind::Prismatic { spring, target, limits, motor } => {
            let slide = Coordinate::slide(ends, def.angle_a, target);
            [Some((slide, Effort::new(spring, motor, limits))), None, None]
        }
        JointKind::Wheel { spring, limits, motor } => {
            let slide = Coordinate::slide(ends, def.angle_a, 0.0);
            let turning = Effort::new(None, motor, None);
            [
                // Its middle runs about the axle, so that by itself the line tells nothing of it.
                Some((slide, Effort::new(spring, None, limits.filter(|_| spring.is_some())))),
                Some((angle(0.0, None), turning)),
                None,
            ]
        }
        JointKind::Distance { length, spring, limits, motor } => {
            let apart = Coordinate::along(ends, gap(ends), length);
            [Some((apart, Effort::new(spring, motor, limits))), None, None]
        }
        JointKind::Weld { linear, angular } => {
            let place = Coordinate::along(ends, gap(ends), 0.0);
            [
                Some((place, Effort::pull(linear, f32::MAX))),
                Some((angle(0.0, None), Effort::pull(angular, f32::MAX))),
                None,
            ]
        }
        JointKind::Motor {
            velocity,
            max_force,
            linear_spring,
            max_spring_force,
            angular_spring,
            max_spring_torque,
            ..
        } => {
            let missing = velocity - (ends[1].velocity() - ends[0].velocity());
            let motor = Motor { speed: missing.length(), max: max_force };
            let missing = Coordinate { speed: 0.0, ..Coordinate::along(ends, missing, 0.0) };
            let place = Coordinate::along(ends, gap(ends), 0.0);
            let twist = Effort::pull(angular_spring, max_spring_torque);
            [
                Some((missing, Effort::new(None, Some(motor), None))),
                Some((place, Effort::pull(linear_spring, max_spring_force))),
                Some((angle(0.0, None), Effort { motor: def.kind.motor(), ..twist })),
            ]
        }
        JointKind::Mouse { target, spring, max_force } => {
            let from = ends[1].bodies.poses[ends[1].course.body as usize].p;
            let gap = from.relative_to(target) + ends[1].arm;
            let place = Coordinate::along(ends, gap, 0.0);
            [Some((place, Effort::pull(Some(spring), max_force))), None, None]
        }
        _ => [None, None, None],
    }
}

/// Notes where the bodies of a joint will go as it drives them, if that is far from where they would go as they
/// move now. They count as free but for the joint, and for what they turn about. `held`: what it did in the last step, in turning or
/// not, if it presses on something.
pub(super) fn by_joint(
    (bodies, joints): (&Bodies, &Joints),
    record: &JointRecord,
    held: impl Fn(bool) -> Option<Held>,
    dt: f32,
    courses: &mut Courses,
) {
    let ends = ends(bodies, record, |body| courses.of(bodies, dt, body));
    for (coordinate, effort) in efforts(joints, &record.def, &ends).into_iter().flatten() {
        let impulse = |held| effort.impulse(&coordinate, held, dt);
        let change = |k: usize, impulse| coordinate.change(&ends[k], k, impulse);
        let is_far = |impulse| [0, 1].into_iter().any(|k| change(k, impulse).is_far(bodies, dt));
        if is_far(impulse(None)) {
            let impulse = impulse(held(coordinate.turns));
            [0, 1].into_iter().for_each(|k| change(k, impulse).keep(bodies, dt, courses));
        }
    }
}

/// Does a joint move its bodies? However slowly it does, they do not rest. What a spring pulls goes into motion and damping, but for what
/// is held: then it moves nothing. `h` is the plain substep length, seconds.
pub(crate) fn moves(
    (bodies, joints): (&Bodies, &Joints),
    record: &JointRecord,
    (h, length_unit): (f32, f32),
) -> bool {
    let pace = bodies.common_pace(record.body_a, record.body_b);
    let inv_h = REFINEMENT[pace] as f32 / h;
    let now = ends(bodies, record, |body| Course::of(bodies, 0.0, body));
    let gains = ends(bodies, record, |body| Course::gained(bodies, inv_h, body));
    let goes = |Motor { speed, max }: Motor, now: f32, gain: f32, unit: f32| {
        let [now, gain] = [now, gain].map(|along| along * speed.signum());
        max > 0.0 && speed != 0.0 && (now >= GOES * speed.abs() || gain > FAINT * unit)
    };
    let pulls = |spring: Spring, strongest: f32, now: &Coordinate, gain: f32| {
        let (rate, unit) =
            (core::f32::consts::TAU * spring.hertz, if now.turns { 1.0 } else { length_unit });
        let pull = (rate * rate * now.away.abs()).min(strongest * now.give);
        let moved = gain + 2.0 * spring.damping_ratio * rate * now.speed;
        now.away.abs() > NEAR * unit
            && pull > FAINT * unit
            && -moved * now.away.signum() > YIELDS * pull
    };
    if let JointKind::Motor { velocity, max_force, .. } = record.def.kind {
        let motor = Motor { speed: velocity.length(), max: max_force };
        let [now, gain] =
            [&now, &gains].map(|ends| (ends[1].velocity() - ends[0].velocity()).length());
        if goes(motor, now, gain, length_unit) {
            return true;
        }
    }
    let along = |ends| efforts(joints, &record.def, ends).into_iter().flatten();
    along(&now).zip(along(&gains)).any(|((now, effort), (gain, _))| {
        let Effort { spring, strongest, motor, .. } = effort;
        let unit = if now.turns { 1.0 } else { length_unit };
        motor.is_some_and(|motor| goes(motor, now.speed, gain.speed, unit))
            || spring.is_some_and(|spring| pulls(spring, strongest, &now, gain.speed))
    })
}

/// The same for what a force does to a body.
pub(super) fn by_force(bodies: &Bodies, body: u32, dt: f32, courses: &mut Courses) {
    Change::by_force(bodies, body, dt).keep(bodies, dt, courses);
}

/// What something changes of a body's velocities, as a mean over the step.
pub(super) struct Change {
    body: u32,
    velocity: Vec2,
    spin: f32,
}

impl Change {
    /// By the forces that the program asked for.
    pub(super) fn by_force(bodies: &Bodies, body: u32, dt: f32) -> Self {
        let info = &bodies.infos[body as usize];
        let [x, y, turn] = bodies.inverses(body);
        let velocity = Vec2::new(info.force.x * (x * dt), info.force.y * (y * dt));
        Self { body, velocity, spin: info.torque * turn * dt }
    }

    fn way(&self, bodies: &Bodies, dt: f32) -> f32 {
        self.velocity.length() * dt + bodies.infos[self.body as usize].turned_reach(self.spin * dt)
    }

    /// Does it take a body that may meet something far off its way?
    pub(super) fn is_far(&self, bodies: &Bodies, dt: f32) -> bool {
        let info = &bodies.infos[self.body as usize];
        let (way, meets) = (self.way(bodies, dt), info.first_shape != NULL);
        // Also false for what is not finite.
        meets
            && way > super::HARMLESS * info.min_extent
            && way < f32::MAX
            && bodies.is_solved(self.body)
    }

    /// Keeps the course of the body with it, if it is far.
    fn keep(&self, bodies: &Bodies, dt: f32, courses: &mut Courses) {
        if self.is_far(bodies, dt) {
            let mut course = courses.of(bodies, dt, self.body);
            course.velocity += self.velocity;
            course.spin += self.spin;
            course.motion += self.velocity * dt;
            course.turn += self.spin * dt;
            course.astray += self.way(bodies, dt);
            course.sure = false;
            courses.keep(&course);
        }
    }
}
