//! Chains, pendulums, springs and limits.

use crate::lab::{Lab, Trial, greatest};
use crate::report::Measure;
use crate::scenery::{GRAVITY, disk, moving, rect, scene, weightless};
use crate::target::Target;
use core::f64::consts::{FRAC_PI_2, TAU};
use tiny_physics::{Filter, JointDef, JointKind, RigidBody, Shape, ShapeDef, Vec2};
use tiny_physics_scenes::{Options, Scene, find};

/// A shape that collides with nothing.
fn ghost(shape: Shape) -> ShapeDef {
    ShapeDef::new(shape).filter(Filter { group: -1, ..Filter::default() })
}

/// A chain with a ball at its end, let go from the horizontal: greatest stretch in 10 s.
///
/// Capsules of 1 m, joined by hinges; the ball, of 1 m, hangs by its middle. Its mass is that of a link
/// times the ratio. Stretch is the sum of all gaps in the chain over its length.
pub(super) fn ball_and_chain(lab: &mut Lab<'_>) -> Vec<Measure> {
    const SECONDS: f64 = 10.0;
    lab.expect_seconds(2.0 * SECONDS, 1.0 / 60.0);
    let links = lab.pick(30, 20);
    [lab.pick(100.0, 60.0), lab.pick(1000.0, 700.0)]
        .into_iter()
        .map(|ratio| {
            let mut trial = lab.build(chain(links, ratio));
            let mut widest: f64 = 0.0;
            lab.run(&mut trial, SECONDS, |trial| widest = widest.max(stretch(trial)));
            let metric = format!("{links} links, ball {ratio}:1, stretch");
            Measure::new(metric, 100.0 * widest, "%", Target::AtMost(0.1))
        })
        .collect()
}

fn chain(links: u32, ratio: f32) -> Scene {
    const RADIUS: f32 = 0.125;
    let mut scene = scene("ball and chain");
    let mut last = scene.body(RigidBody::fixed());
    let mut anchor = Vec2::ZERO;
    let (a, b) = (Vec2::new(RADIUS - 0.5, 0.0), Vec2::new(0.5 - RADIUS, 0.0));
    let capsule = Shape::Capsule { a, b, radius: RADIUS };
    let link_mass = capsule.mass_properties(1.0).mass;
    for i in 0..links {
        let link = scene.body(moving(ghost(capsule), Vec2::new(i as f32 + 0.5, 0.0)));
        let hinge = JointDef::revolute().anchors(anchor, Vec2::new(-0.5, 0.0));
        scene.joint(last, link, hinge);
        (last, anchor) = (link, Vec2::new(0.5, 0.0));
    }
    let ball = moving(ghost(disk(0.5)), Vec2::new(links as f32, 0.0)).mass(ratio * link_mass);
    let ball = scene.body(ball);
    scene.joint(last, ball, JointDef::revolute().anchors(anchor, Vec2::ZERO));
    scene
}

/// Sum of all gaps over the length of the chain.
fn stretch(trial: &Trial) -> f64 {
    let joints = trial.scene().joints.len();
    let gaps: f64 = (0..joints).map(|joint| trial.gap(joint)).sum();
    let stretch = gaps / (joints - 1) as f64;
    if stretch.is_nan() { f64::INFINITY } else { stretch }
}

/// A bridge of planks with some slack: widest gap in 20 s, and its sag against the catenary.
///
/// Planks of 1 m x 0.25 m over nine tenths of their length, laid out as they should hang.
pub(super) fn bridge(lab: &mut Lab<'_>) -> Vec<Measure> {
    lab.expect_seconds(20.0, 1.0 / 60.0);
    let planks = lab.pick(100, 80);
    let catenary = Catenary::new(planks, lab.pick(0.9, 0.95) * planks as f64);
    let mut scene = scene("bridge");
    let banks = scene.body(RigidBody::fixed());
    let (mut last, mut anchor) = (banks, Vec2::ZERO);
    for plank in 0..planks {
        let (angle, x, y) = catenary.plank(plank);
        let body = moving(ghost(rect(0.5, 0.125)), Vec2::ZERO).angle(angle as f32);
        let body = scene.body(body.position(tiny_physics::DVec2::new(x, y)));
        scene.joint(last, body, JointDef::revolute().anchors(anchor, Vec2::new(-0.5, 0.0)));
        (last, anchor) = (body, Vec2::new(0.5, 0.0));
    }
    let end = Vec2::new(catenary.span as f32, 0.0);
    scene.joint(last, banks, JointDef::revolute().anchors(anchor, end));
    let mut trial = lab.build(scene);
    let mut widest: f64 = 0.0;
    lab.run(&mut trial, 20.0, |trial| widest = widest.max(trial.widest_gap()));
    let middle = 1 + planks / 2;
    let hangs = -trial.point(middle, Vec2::new(-0.5, 0.0)).y;
    let error = 100.0 * (hangs / catenary.sag() - 1.0);
    vec![
        Measure::new(
            format!("{planks} planks, widest gap"),
            1000.0 * widest,
            "mm",
            Target::AtMost(2.0),
        ),
        Measure::new(
            format!("{planks} planks, sag against the catenary, error"),
            error,
            "%",
            Target::Within { value: 0.0, tolerance: 1.0 },
        ),
    ]
}

/// How a chain of rigid planks hangs: the tangent of a plank's angle grows by the same amount from
/// plank to plank.
struct Catenary {
    planks: usize,
    slope: f64,
    span: f64,
}

impl Catenary {
    fn new(planks: usize, span: f64) -> Self {
        let (mut flat, mut steep) = (0.0, 10.0);
        for _ in 0..200 {
            let slope = 0.5 * (flat + steep);
            let found = Self { planks, slope, span };
            let width: f64 = (0..planks).map(|i| found.angle(i).cos()).sum();
            if width > span {
                flat = slope;
            } else {
                steep = slope;
            }
        }
        Self { planks, slope: 0.5 * (flat + steep), span }
    }

    fn angle(&self, plank: usize) -> f64 {
        (self.slope * (plank as f64 - 0.5 * (self.planks as f64 - 1.0))).atan()
    }

    /// Angle and middle of a plank.
    fn plank(&self, plank: usize) -> (f64, f64, f64) {
        let start = |f: fn(f64) -> f64| (0..plank).map(|i| f(self.angle(i))).sum::<f64>();
        let angle = self.angle(plank);
        (angle, start(f64::cos) + 0.5 * angle.cos(), start(f64::sin) + 0.5 * angle.sin())
    }

    /// Depth of the joint in the middle.
    fn sag(&self) -> f64 {
        -(0..self.planks / 2).map(|i| self.angle(i).sin()).sum::<f64>()
    }
}

/// A ball on a hinge, and what its motion should be.
struct Pendulum {
    trial: Trial,
    ball: usize,
    length: f64,
    omega: f64,
}

/// Let go from 90 degrees: a ball of radius 0.1 m, `length` from the hinge.
fn pendulum(lab: &mut Lab<'_>, length: f32) -> Pendulum {
    const RADIUS: f32 = 0.1;
    let mut scene = scene("pendulum");
    let hook = scene.body(RigidBody::fixed());
    let ball = scene.body(moving(ghost(disk(RADIUS)), Vec2::new(length, 0.0)));
    let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-length, 0.0));
    scene.joint(hook, ball, hinge);
    let (length, radius) = (f64::from(length), f64::from(RADIUS));
    let omega = (GRAVITY * length / (length * length + 0.5 * radius * radius)).sqrt();
    Pendulum { trial: lab.build(scene), ball, length, omega }
}

/// Period of a pendulum let go from 90 degrees, over ten swings: 7.4163 / omega0.
pub(super) fn pendulum_period(lab: &mut Lab<'_>) -> Vec<Measure> {
    const FACTOR: f64 = 7.416_298_709_205_487;
    const SWINGS: f64 = 10.0;
    let length = lab.pick(1.0, 2.5);
    let Pendulum { mut trial, ball, omega, .. } = pendulum(lab, length);
    let period = FACTOR / omega;
    let seconds = (SWINGS + 1.0) * period;
    lab.expect_seconds(seconds, trial.scene().dt);
    // Times at which it passes below the hinge.
    let mut passed = Vec::new();
    let mut before = f64::from(length);
    let dt = f64::from(trial.scene().dt);
    lab.run(&mut trial, seconds, |trial| {
        let x = trial.position(ball).x;
        if (x > 0.0) != (before > 0.0) {
            passed.push(trial.time() - dt * x / (x - before));
        }
        before = x;
    });
    let last = 2 * SWINGS as usize;
    let measured = passed.get(last).map_or(f64::INFINITY, |end| (end - passed[0]) / SWINGS);
    vec![Measure::new(
        "error of the period",
        100.0 * (measured / period - 1.0),
        "%",
        Target::Within { value: 0.0, tolerance: 0.01 },
    )]
}

/// How much lower a pendulum swings after 60 s.
pub(super) fn pendulum_apex(lab: &mut Lab<'_>) -> Vec<Measure> {
    let Pendulum { mut trial, ball, length, omega } = pendulum(lab, lab.pick(1.0, 2.5));
    lab.expect_seconds(66.0, trial.scene().dt);
    lab.run(&mut trial, 60.0, |_| {});
    let mut apex = -length;
    let swing = 7.5 / omega;
    lab.run(&mut trial, swing, |trial| apex = apex.max(trial.position(ball).y));
    vec![Measure::new(
        "60 s, apex lost",
        -apex / length,
        "m of 1 m",
        Target::Within { value: 0.0, tolerance: 0.005 },
    )]
}

/// A crate on a damped spring: frequency and logarithmic decrement against the formulas.
pub(super) fn spring(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (hertz, zeta): (f32, f32) = lab.pick((1.0, 0.1), (2.0, 0.05));
    let mut scene = weightless("spring");
    let hook = scene.body(RigidBody::fixed());
    let load = scene.body(moving(ghost(rect(0.5, 0.5)), Vec2::new(4.0, 0.0)));
    scene.joint(hook, load, JointDef::distance(3.0).spring(hertz, zeta));
    let seconds = 4.0 / f64::from(hertz);
    lab.expect_seconds(seconds, scene.dt);
    let dt = f64::from(scene.dt);
    let mut trial = lab.build(scene);
    // Extrema through parabolas over three samples: time and distance from the spring's rest.
    let mut extrema: Vec<(f64, f64)> = Vec::new();
    let mut samples = vec![1.0];
    lab.run(&mut trial, seconds, |trial| {
        samples.push(trial.position(load).x - 3.0);
        if let [.., a, b, c] = samples[..]
            && (b - a) * (c - b) < 0.0
        {
            let offset = 0.5 * (a - c) / (a - 2.0 * b + c);
            extrema.push((trial.time() + dt * (offset - 1.0), b - 0.25 * (a - c) * offset));
        }
    });
    let zeta = f64::from(zeta);
    let root = (1.0 - zeta * zeta).sqrt();
    let expected = (TAU * f64::from(hertz) * root, TAU * zeta / root);
    let (omega, decrement) = match extrema[..] {
        [first, .., last] => {
            let swings = 0.5 * (extrema.len() - 1) as f64;
            (TAU * swings / (last.0 - first.0), (first.1 / last.1).abs().ln() / swings)
        }
        _ => (f64::NAN, f64::NAN),
    };
    let target = Target::Within { value: 0.0, tolerance: 1.0 };
    vec![
        Measure::new(
            format!("{hertz} Hz, damping {zeta:.2}, frequency, error"),
            100.0 * (omega / expected.0 - 1.0),
            "%",
            target,
        ),
        Measure::new(
            format!("{hertz} Hz, damping {zeta:.2}, decrement, error"),
            100.0 * (decrement / expected.1 - 1.0),
            "%",
            target,
        ),
    ]
}

/// A ball at 50 m/s hits a door and a ragdoll: how far joints get beyond their limits.
pub(super) fn limits(lab: &mut Lab<'_>) -> Vec<Measure> {
    const SECONDS: f64 = 3.0;
    let speed = lab.pick(50.0, 35.0);
    lab.expect_seconds(2.0 * SECONDS, 1.0 / 60.0);
    [("door", door(speed)), ("ragdoll", ragdoll(speed))]
        .into_iter()
        .map(|(name, scene)| {
            let mut trial = lab.build(scene);
            let mut worst: f64 = 0.0;
            lab.run(&mut trial, SECONDS, |trial| worst = worst.max(violation(trial)));
            let metric = format!("{name}, ball at {speed} m/s, beyond the limits");
            Measure::new(metric, worst.to_degrees(), "degrees", Target::AtMost(2.0))
        })
        .collect()
}

/// A door seen from above, free for 90 degrees to either side; the ball weighs as much as the door.
fn door(speed: f32) -> Scene {
    let mut scene = weightless("door");
    let frame = scene.body(RigidBody::fixed());
    let door = scene.body(moving(rect(1.0, 0.05), Vec2::new(1.0, 0.0)));
    let limit = FRAC_PI_2 as f32;
    let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-1.0, 0.0));
    scene.joint(frame, door, hinge.limits(-limit, limit));
    let ball = moving(disk(0.2), Vec2::new(1.6, -3.0)).mass(0.2);
    scene.body(ball.velocity(Vec2::new(0.0, speed)).bullet());
    scene
}

/// A ragdoll in the air, hit on the chest by a ball as heavy as a bone.
fn ragdoll(speed: f32) -> Scene {
    let mut scene = weightless("ragdoll");
    let Ok(entry) = find("ragdoll") else { return scene };
    let source = entry.build(Options::default().size(1));
    let height = source.bodies[1].position;
    for body in &source.bodies {
        let mut body = body.clone().can_sleep(false);
        body.velocity = Vec2::ZERO;
        if body.kind != tiny_physics::BodyKind::Dynamic {
            // The stairs, out of the way.
            body.position = tiny_physics::DVec2::new(0.0, -1000.0);
        }
        scene.body(body);
    }
    for joint in &source.joints {
        scene.joint(joint.a, joint.b, joint.def);
    }
    let start = Vec2::new(height.x as f32 - 3.0, height.y as f32 + 0.35);
    let ball = moving(disk(0.1), start).mass(0.05);
    scene.body(ball.velocity(Vec2::new(speed, 0.0)).bullet());
    scene
}

/// How far the worst joint is beyond its limits, radians.
fn violation(trial: &Trial) -> f64 {
    greatest(trial.scene().joints.iter().map(|joint| {
        let JointKind::Revolute { limits: Some(limits), .. } = joint.def.kind else { return 0.0 };
        let turn = f64::from(joint.def.angle_b) - f64::from(joint.def.angle_a);
        let angle = trial.angle(joint.b) - trial.angle(joint.a) + turn;
        let (lower, upper) = (f64::from(limits.lower), f64::from(limits.upper));
        let middle = 0.5 * (lower + upper);
        let angle = middle + (angle - middle + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
        (angle - upper).max(lower - angle).max(0.0)
    }))
}
