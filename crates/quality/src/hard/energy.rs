//! Energy that must not grow, and turning at any speed.

use super::common::none;
use super::joints::Gain;
use crate::lab::{Lab, Trial, greatest};
use crate::report::Measure;
use crate::scenery::{disk, fixed, moving, rect, scene, weightless};
use crate::target::Target;
use core::f64::consts::{PI, TAU};
use tiny_physics::{BodyKind, JointKind, RigidBody, Settings, Shape, ShapeDef, Vec2, World};
use tiny_physics_scenes::{Options, Scene, SceneJoint, all, find, tags};

/// Free boxes that turn fast: by how much is the angle wrong after a second?
pub(super) fn fast_turning(lab: &mut Lab<'_>) -> Vec<Measure> {
    let speeds = lab.pick([80.0, 120.0, 180.0, 1000.0], [65.0, 140.0, 260.0, 700.0]);
    lab.expect_seconds(1.0, 1.0 / 60.0);
    let mut scene = weightless("fast turning");
    for (i, &speed) in speeds.iter().enumerate() {
        let place = Vec2::new(5.0 * i as f32, 0.0);
        scene.body(moving(rect(0.5, 0.5), place).angular_velocity(speed));
    }
    let mut trial = lab.build(scene);
    let mut errors = [0.0_f64; 4];
    lab.run(&mut trial, 1.0, |trial| {
        for (body, error) in errors.iter_mut().enumerate() {
            // Followed from step to step, so that whole turns are not lost.
            let now = trial.angle(body) - f64::from(speeds[body]) * trial.time();
            *error += (now - *error + PI).rem_euclid(TAU) - PI;
        }
    });
    let measure = |(speed, error): (&f32, f64)| {
        let metric = format!("{speed} rad/s, error of the angle after 1 s");
        Measure::new(
            metric,
            error.abs(),
            "rad",
            Target::AtMost(1e-5 * (f64::from(*speed) / 80.0).max(1.0)),
        )
    };
    speeds.iter().zip(errors).map(measure).collect()
}

/// Elastic boxes and balls in a box, under gravity, without friction: how much energy is left after two minutes?
pub(super) fn elastic_boxes(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (size, spread) = lab.pick((0.5, 2.0), (0.35, 1.6));
    lab.expect_seconds(120.0, 1.0 / 60.0);
    let mut scene = scene("elastic boxes");
    for (shape, place) in [
        (rect(10.0, 1.0), Vec2::new(0.0, -1.0)),
        (rect(1.0, 20.0), Vec2::new(-7.0, 19.0)),
        (rect(1.0, 20.0), Vec2::new(7.0, 19.0)),
    ] {
        scene.body(fixed(slippery(shape), place));
    }
    for i in 0..8 {
        let place = Vec2::new(
            spread * (i % 4) as f32 - 1.5 * spread,
            2.0 + 2.5 * (i / 4) as f32 + 0.3 * i as f32,
        );
        let shape = if i % 2 == 0 { rect(size, size) } else { disk(size) };
        scene.body(moving(slippery(shape), place).angle(0.2 * i as f32));
    }
    let mut trial = lab.build(scene);
    let start = trial.energy();
    let mut highest: f64 = 0.0;
    lab.run(&mut trial, 120.0, |trial| {
        highest = greatest([highest, trial.energy() / start].into_iter())
    });
    vec![
        Measure::new(
            "energy after 2 min over that at the start",
            trial.energy() / start,
            "",
            left(0.9, 1.0),
        ),
        Measure::new("energy on the way at most", highest, "", Target::AtMost(1.01)),
    ]
}

/// A ball between floor and ceiling, at several strengths of gravity and under a constant force: energy after a minute.
pub(super) fn bouncing_forever(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (radius, height) = lab.pick((0.3, 6.0), (0.4, 8.0));
    let cases = lab.pick(
        [
            ("gravity times 0", 0.0, 0.0),
            ("gravity times 2", 2.0, 0.0),
            ("a force upwards", 1.0, 6.0),
            ("a force sideways", 0.0, 4.0),
        ],
        [
            ("gravity times 0", 0.0, 0.0),
            ("gravity times 3", 3.0, 0.0),
            ("a force upwards", 1.0, 13.0),
            ("a force sideways", 0.0, 7.0),
        ],
    );
    lab.expect_seconds(60.0 * cases.len() as f64, 1.0 / 60.0);
    let mut measures = Vec::new();
    for (name, scale, push) in cases {
        let mut scene = scene("bouncing forever");
        for (shape, place) in [
            (rect(height, 1.0), Vec2::new(0.0, -1.0)),
            (rect(height, 1.0), Vec2::new(0.0, height + 1.0)),
            (rect(1.0, height), Vec2::new(-0.5 * height - 1.0, 0.5 * height)),
            (rect(1.0, height), Vec2::new(0.5 * height + 1.0, 0.5 * height)),
        ] {
            scene.body(fixed(slippery(shape), place));
        }
        let ball = moving(slippery(disk(radius)), Vec2::new(0.4, 0.6 * height)).mass(1.0);
        let ball = ball.gravity_scale(scale).velocity(Vec2::new(0.3, 5.0));
        let ball = scene.body(ball);
        let force =
            if name.ends_with("sideways") { Vec2::new(push, 0.0) } else { Vec2::new(0.0, push) };
        let mut trial = lab.build(scene);
        let energy = |trial: &Trial| {
            let p = trial.position(ball);
            // From the corner to which everything is pulled, so that it is positive.
            let reach = f64::from(force.x.abs() + force.y.abs()) * f64::from(height);
            trial.energy() + reach - f64::from(force.x) * p.x - f64::from(force.y) * p.y
        };
        let start = energy(&trial);
        for _ in 0..3600 {
            trial.push(ball, force);
            lab.step(&mut trial);
        }
        let target = Target::Within { value: 1.0, tolerance: 0.005 };
        let metric = format!("{name}, energy after 60 s over that at the start");
        measures.push(Measure::new(metric, energy(&trial) / start, "", target));
    }
    measures
}

/// Elastic balls in a box, no gravity: energy after ten minutes.
pub(super) fn elastic_gas(lab: &mut Lab<'_>) -> Vec<Measure> {
    let counts = lab.pick([5, 30, 100], [8, 20, 60]);
    let (radius, speed) = lab.pick((0.3, 4.0), (0.25, 6.0));
    lab.expect_seconds(600.0 * counts.len() as f64, 1.0 / 60.0);
    let mut measures = Vec::new();
    for count in counts {
        let side = 1.1 * (count as f32).sqrt() + 1.0;
        let mut scene = weightless("elastic gas");
        for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            let half = if x == 0.0 { rect(side + 2.0, 1.0) } else { rect(1.0, side + 2.0) };
            scene.body(fixed(slippery(half), Vec2::new(x, y) * (side + 1.0)));
        }
        let columns = (count as f32).sqrt().ceil() as usize;
        for i in 0..count {
            let grid = Vec2::new((i % columns) as f32 + 0.5, (i / columns) as f32 + 0.5);
            let place = (grid * (2.0 / columns as f32) - Vec2::splat(1.0)) * side;
            let angle = 2.4 * i as f32;
            let velocity = Vec2::new(angle.cos(), angle.sin()) * speed;
            scene.body(moving(slippery(disk(radius)), place).velocity(velocity));
        }
        let mut trial = lab.build(scene);
        let start = trial.kinetic_energy();
        lab.run(&mut trial, 600.0, |_| {});
        let metric = format!("{count} balls, energy after 10 min over that at the start");
        measures.push(Measure::new(metric, trial.kinetic_energy() / start, "", left(0.95, 1.0)));
    }
    measures
}

/// Built-in scenes whose energy nothing from outside adds to: in how many does it grow?
pub(super) fn energy_of_scenes(lab: &mut Lab<'_>) -> Vec<Measure> {
    let scenes: Vec<Scene> = all()
        .iter()
        .filter(|entry| entry.has_tag(tags::SHOW))
        .map(|entry| entry.build(Options::default().seed(lab.pick(0, 9))))
        .filter(is_passive)
        .collect();
    let count = scenes.len();
    let (mut grown, mut worst) = (0, 0.0_f64);
    for mut scene in scenes {
        scene.gravity *= lab.pick(1.0, 1.7);
        let seconds = f64::from(scene.steps) * f64::from(scene.dt);
        lab.expect_seconds(seconds, scene.dt);
        let mut trial = lab.build(scene);
        let mut gain = Gain::default();
        lab.run(&mut trial, seconds, |trial| gain.look(trial));
        grown += usize::from(gain.share() > 0.01);
        worst = greatest([worst, gain.share()].into_iter());
    }
    vec![
        none(format!("scenes in which energy grows by over 1 %, of {count}"), grown),
        Measure::new(
            "greatest gain, of the energy turned over",
            100.0 * worst,
            "%",
            Target::AtMost(1.0),
        ),
    ]
}

/// Does nothing but gravity and what its bodies begin with move a scene, and does nothing store energy unseen?
fn is_passive(scene: &Scene) -> bool {
    let passive = |joint: &SceneJoint| match joint.def.kind {
        JointKind::Revolute { spring, motor, .. } | JointKind::Distance { spring, motor, .. } => {
            spring.is_none() && motor.is_none()
        }
        _ => false,
    };
    let still = |body: &RigidBody| {
        let surface = |shape: &ShapeDef| shape.material.tangent_speed == 0.0 && !shape.sensor;
        body.kind != BodyKind::Kinematic && body.shapes.iter().all(surface)
    };
    scene.script.is_none() && scene.joints.iter().all(passive) && scene.bodies.iter().all(still)
}

/// A scene in other units: is its course the same?
pub(super) fn units(lab: &mut Lab<'_>) -> Vec<Measure> {
    let powers = lab.pick([128.0, 1.0 / 128.0], [32.0, 1.0 / 64.0]);
    let other = lab.pick(100.0, 30.0);
    let course = |unit: f32| -> Vec<(Vec2, bool)> {
        let settings = Settings { length_unit: unit, ..Settings::default() };
        let mut world = World::with_settings(Vec2::new(0.0, -10.0 * unit), settings);
        let mut bodies = Vec::new();
        for (shape, x, y, kind) in [
            (rect(20.0 * unit, unit), 0.0, -1.0, BodyKind::Static),
            (rect(0.5 * unit, 0.5 * unit), 0.0, 0.55, BodyKind::Dynamic),
            (rect(0.5 * unit, 0.5 * unit), 0.1, 1.65, BodyKind::Dynamic),
            (rect(0.4 * unit, 0.3 * unit), -0.1, 2.8, BodyKind::Dynamic),
            (disk(0.4 * unit), 4.0, 3.0, BodyKind::Dynamic),
            (rect(0.1 * unit, unit), -4.0, 1.2, BodyKind::Dynamic),
        ] {
            let body = RigidBody { kind, ..RigidBody::dynamic() };
            let body = body.position(Vec2::new(x * unit, y * unit)).shape(shape);
            bodies.extend(world.add_body(body));
        }
        let mut seen = Vec::new();
        for step in 0..360 {
            world.step(1.0 / 60.0);
            if step % 30 == 29 {
                let now = bodies.iter().filter_map(|&id| world.body(id));
                seen.extend(now.map(|body| (body.position() * (1.0 / unit), body.is_awake())));
            }
        }
        seen
    };
    let plain = course(1.0);
    let parted = |unit: f32| usize::from(course(unit) != plain);
    let far = course(other);
    let off = far.iter().zip(&plain).map(|(a, b)| f64::from((a.0 - b.0).length()));
    let otherwise = far.iter().zip(&plain).filter(|(a, b)| a.1 != b.1).count();
    vec![
        none(
            "powers of two whose course has other bits, of 2".into(),
            powers.map(parted).iter().sum(),
        ),
        Measure::new(
            format!("unit of {other}, greatest difference"),
            greatest(off),
            "m",
            Target::AtMost(1e-3),
        ),
        none(format!("unit of {other}, asleep at other times"), otherwise),
    ]
}

/// A large pyramid at the defaults: how far does it go sideways, how far does it sink?
pub(super) fn large_pyramid(lab: &mut Lab<'_>) -> Vec<Measure> {
    let Ok(entry) = find("large_pyramid") else { return Vec::new() };
    let options = Options::default();
    let scene = entry.build(lab.pick(options, options.size(80)));
    let seconds = 500.0 / 60.0;
    lab.expect_seconds(seconds, scene.dt);
    let mut trial = lab.build(scene);
    lab.run(&mut trial, seconds, |_| {});
    let bodies = trial.dynamic();
    let sideways = greatest(bodies.iter().map(|&body| trial.moved(body).x.abs()));
    let sag = greatest(bodies.iter().map(|&body| -trial.moved(body).y));
    vec![
        Measure::new("500 steps, sideways", sideways, "m", Target::AtMost(0.01)),
        Measure::new("500 steps, sag", sag, "m", Target::AtMost(0.05)),
    ]
}

/// A surface without friction that gives back everything.
fn slippery(shape: Shape) -> ShapeDef {
    ShapeDef::new(shape).friction(0.0).restitution(1.0)
}

/// Between two shares of what there was.
fn left(least: f64, most: f64) -> Target {
    Target::Within { value: 0.5 * (least + most), tolerance: 0.5 * (most - least) }
}
