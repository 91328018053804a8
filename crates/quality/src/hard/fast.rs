//! Bodies that meet fast, none of them a bullet.

use super::common::{DT, PHASES, none, passed};
use crate::lab::{Lab, Trial, greatest};
use crate::report::Measure;
use crate::scenery::{disk, fixed, moving, rect, scene, weightless};
use crate::target::Target;
use core::f64::consts::{PI, TAU};
use tiny_physics::{DVec2, JointDef, RigidBody, Shape, ShapeDef, Vec2, World};
use tiny_physics_scenes::{Options, Random, Scene, find};

/// A heavy plate and a light ball: how many pass?
pub(super) fn plate_and_ball(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (half_thickness, radius, mass) = lab.pick((0.05, 0.1, 1000.0), (0.03, 0.15, 500.0));
    let cases = lab
        .pick([(0.0, 10.0), (0.0, 20.0), (100.0, 10.0)], [(0.0, 15.0), (5.0, 30.0), (80.0, 8.0)]);
    let mut measures = Vec::new();
    for (ball, plate) in cases {
        let mut scene = weightless("plate and ball");
        for i in 0..PHASES {
            let y = 10.0 * i as f32;
            let gap = 1.0 + (plate + ball) * DT as f32 * i as f32 / PHASES as f32;
            let body = moving(rect(half_thickness, 1.0), Vec2::new(-gap, y)).mass(mass);
            scene.body(body.velocity(Vec2::new(plate, 0.0)));
            scene.body(moving(disk(radius), Vec2::new(0.0, y)).velocity(Vec2::new(-ball, 0.0)));
        }
        let passed = passed(lab, scene, 0.4);
        let metric = format!("ball at {ball}, plate at {plate} m/s, passed of {PHASES}");
        measures.push(none(metric, passed));
    }
    measures
}

/// Bodies that fly at each other: how many pass?
pub(super) fn head_on(lab: &mut Lab<'_>) -> Vec<Measure> {
    let balls = |speed| (format!("balls at {speed} m/s"), disk(0.25), speed);
    let boxes = |speed| (format!("boxes at {speed} m/s"), rect(0.5, 0.5), speed);
    let planks = |speed| (format!("planks at {speed} m/s"), rect(0.1, 1.0), speed);
    let cases = lab.pick(
        [balls(30.0), balls(150.0), boxes(50.0), boxes(150.0), planks(10.0), planks(150.0)],
        [balls(45.0), balls(120.0), boxes(70.0), boxes(130.0), planks(20.0), planks(100.0)],
    );
    let mut measures = Vec::new();
    for (name, shape, speed) in cases {
        let mut scene = weightless("head on");
        for i in 0..PHASES {
            let y = 10.0 * i as f32;
            let apart = 2.0 + 2.0 * speed * DT as f32 * i as f32 / PHASES as f32;
            for side in [-1.0, 1.0] {
                let body = moving(shape, Vec2::new(0.5 * apart * side, y));
                scene.body(body.velocity(Vec2::new(-speed * side, 0.0)));
            }
        }
        measures.push(none(format!("{name}, passed of 40"), passed(lab, scene, 0.5)));
    }
    measures
}

/// Balls thrown at free rods that turn: how many pass through?
pub(super) fn turning_rod(lab: &mut Lab<'_>) -> Vec<Measure> {
    const COUNT: usize = 120;
    let (half_length, radius) = lab.pick((3.0_f32, 0.15), (2.5, 0.12));
    let (spin, speed) = lab.pick((10.0, 5.0), (14.0, 8.0));
    let mut random = Random::new(lab.pick(5, 6));
    let mut scene = weightless("turning rod");
    for i in 0..COUNT {
        let at = Vec2::new(30.0 * (i % 10) as f32, 30.0 * (i / 10) as f32);
        let rod = moving(rect(half_length, 0.05), at).angle(random.range(0.0, 3.0));
        scene.body(rod.angular_velocity(spin));
        let off = random.range(-0.9, 0.9) * half_length;
        let ball = moving(disk(radius), at + Vec2::new(off, -4.0 - random.range(0.0, 1.0)));
        scene.body(ball.velocity(Vec2::new(0.0, speed)));
    }
    lab.expect_seconds(2.0, scene.dt);
    let mut trial = lab.build(scene);
    let reach = 0.95 * f64::from(half_length);
    let side = |trial: &Trial, i: usize| {
        let (rod, ball) = (trial.position(2 * i), trial.position(2 * i + 1));
        let (dx, dy) = (ball.x - rod.x, ball.y - rod.y);
        let (s, c) = trial.angle(2 * i).sin_cos();
        (c * dx + s * dy, c * dy - s * dx)
    };
    let mut last: Vec<(f64, f64)> = (0..COUNT).map(|i| side(&trial, i)).collect();
    let mut through = [false; COUNT];
    lab.run(&mut trial, 2.0, |trial| {
        for i in 0..COUNT {
            let now = side(trial, i);
            // Without a way round an end within the step: the rod turns by 10 degrees.
            let near = now.0.abs() < reach && last[i].0.abs() < reach && now.1.abs() < 1.0;
            through[i] |= near && now.1 * last[i].1 < 0.0;
            last[i] = now;
        }
    });
    let count = through.iter().filter(|&&through| through).count();
    vec![none(format!("{spin} rad/s, {speed} m/s, passed of {COUNT}"), count)]
}

/// Hinged bars that swing against a thin peg: how many pass?
pub(super) fn bar_and_peg(lab: &mut Lab<'_>) -> Vec<Measure> {
    const COUNT: usize = 200;
    let (length, peg) = lab.pick((2.0_f32, 0.03), (1.5, 0.04));
    let mut measures = Vec::new();
    for speed in lab.pick([60.0, 180.0], [40.0, 120.0]) {
        let mut scene = weightless("bar and peg");
        scene.body(RigidBody::fixed());
        let angle = |i: usize| 0.4 + 2.0 * i as f32 / COUNT as f32;
        for i in 0..COUNT {
            let at = Vec2::new(8.0 * (i % 20) as f32, 8.0 * (i / 20) as f32);
            let half = 0.5 * length;
            let bar = moving(rect(half, 0.05), at + Vec2::new(half, 0.0));
            let bar = bar.velocity(Vec2::new(0.0, speed * half)).angular_velocity(speed);
            let bar = scene.body(bar);
            scene.joint(0, bar, JointDef::revolute().anchors(at, Vec2::new(-half, 0.0)));
            let place = Vec2::new(angle(i).cos(), angle(i).sin()) * (0.8 * length);
            scene.body(fixed(disk(peg), at + place));
        }
        let mut trial = lab.build(scene);
        let turn = f64::from(speed) * DT;
        let mut through = 0;
        for step in 1..=(2.5 / turn).ceil() as u32 + 1 {
            lab.step(&mut trial);
            // Looked at after the step in which a bar reaches its peg: later it may come round again.
            let meets = |&i: &usize| (f64::from(angle(i)) / turn).ceil() as u32 == step;
            // The hinge may give when a bar is stopped: who has the peg before it still has not passed.
            let past = |&i: &usize| {
                let (bar, peg) = (1 + 2 * i, 2 + 2 * i);
                let beyond = trial.angle(bar) - f64::from(angle(i));
                let (from, to) = (trial.position(bar), trial.position(peg));
                let (sin, cos) = trial.angle(bar).sin_cos();
                let (x, y) = (to.x - from.x, to.y - from.y);
                let held = x * cos + y * sin < 0.5 * f64::from(length) && y * cos > x * sin;
                (beyond + PI).rem_euclid(TAU) - PI > 0.0 && !held
            };
            through += (0..COUNT).filter(meets).filter(past).count();
        }
        measures.push(none(format!("bar at {speed} rad/s, passed of {COUNT}"), through));
    }
    measures
}

/// Fast kinematic sensors pass over resting bodies: how many are not told of them?
pub(super) fn fast_sensor(lab: &mut Lab<'_>) -> Vec<Measure> {
    const COUNT: usize = 200;
    let (half, radius) = lab.pick((0.2, 0.15), (0.1, 0.3));
    let mut world = World::new(Vec2::ZERO);
    let mut random = Random::new(lab.pick(7, 8));
    for i in 0..COUNT {
        let y = 5.0 * i as f32;
        let speed = random.range(20.0, 200.0);
        let from = Vec2::new(-random.range(2.0, 4.0) - speed * DT as f32, y);
        let eye = RigidBody::kinematic().can_sleep(false).position(from);
        let eye =
            eye.velocity(Vec2::new(speed, 0.0)).shape(ShapeDef::new(rect(half, 1.0)).sensor());
        let ball = RigidBody::dynamic().position(Vec2::new(0.0, y)).shape(disk(radius));
        if world.add_body(eye).is_err() || world.add_body(ball).is_err() {
            return vec![none("sensors that were refused".into(), COUNT)];
        }
    }
    let (mut begun, mut ended) = (0, 0);
    for _ in 0..60 {
        world.step(DT as f32);
        begun += world.events().sensor_begin().len();
        ended += world.events().sensor_end().len();
    }
    vec![
        none(format!("20 to 200 m/s, not told of {COUNT}"), COUNT.saturating_sub(begun)),
        none(format!("20 to 200 m/s, ends not told of {COUNT}"), COUNT.saturating_sub(ended)),
    ]
}

/// Things thrown at walls: how many end stuck in one, or behind it?
pub(super) fn debris(lab: &mut Lab<'_>) -> Vec<Measure> {
    const COUNT: usize = 180;
    let capsule = |length: f32, radius: f32| Shape::Capsule {
        a: Vec2::new(radius - 0.5 * length, 0.0),
        b: Vec2::new(0.5 * length - radius, 0.0),
        radius,
    };
    let things = lab.pick(
        [
            ("planks 1 x .1", rect(0.5, 0.05)),
            ("bricks .6 x .2", rect(0.3, 0.1)),
            ("beams 2 x .2", rect(1.0, 0.1)),
            ("capsules 1.1 x .1", capsule(1.1, 0.05)),
            ("boxes", rect(0.5, 0.5)),
        ],
        [
            ("planks 1.4 x .08", rect(0.7, 0.04)),
            ("bricks .4 x .25", rect(0.2, 0.125)),
            ("beams 3 x .15", rect(1.5, 0.075)),
            ("capsules .7 x .08", capsule(0.7, 0.04)),
            ("boxes .6", rect(0.3, 0.3)),
        ],
    );
    let seed = lab.pick(11, 12);
    let (mut measures, mut behind) = (Vec::new(), 0);
    for (name, shape) in things {
        let mut random = Random::new(seed);
        let mut scene = scene("debris");
        for i in 0..COUNT {
            let x = 40.0 * i as f32;
            let half = 0.01 * 50.0_f32.powf(random.range(0.0, 1.0));
            scene.body(fixed(rect(half, 60.0), Vec2::new(x + half, -30.0)));
            let speed = Vec2::new(random.range(10.0, 100.0), random.range(-5.0, 5.0));
            let thing = moving(shape, Vec2::new(x - random.range(4.0, 7.0), 0.0));
            let thing = thing.angle(random.range(0.0, 3.0)).velocity(speed);
            scene.body(thing.angular_velocity(random.range(2.0, 20.0)));
        }
        lab.expect_seconds(3.0, scene.dt);
        let mut trial = lab.build(scene);
        lab.run(&mut trial, 2.5, |_| {});
        let mut last: Vec<DVec2> = (0..COUNT).map(|i| trial.position(2 * i + 1)).collect();
        let mut ways = vec![0.0_f64; COUNT];
        lab.run(&mut trial, 0.5, |trial| {
            for (i, (way, last)) in ways.iter_mut().zip(&mut last).enumerate() {
                let now = trial.position(2 * i + 1);
                *way += (now.x - last.x).hypot(now.y - last.y);
                *last = now;
            }
        });
        // Whatever flies, falls or slides comes half a metre at least.
        let stuck = |i: &usize| !(ways[*i] > 0.05);
        let is_behind = |i: &usize| !(trial.position(2 * i + 1).x < trial.position(2 * i).x);
        behind += (0..COUNT).filter(is_behind).count();
        let stuck = (0..COUNT).filter(stuck).count();
        measures.push(none(format!("{name}, stuck in a wall, of {COUNT}"), stuck));
    }
    measures.push(none(format!("behind a wall, of {}", 5 * COUNT), behind));
    measures
}

/// Two crowds of boxes fly into each other: how deep do two overlap, in shares of a box?
pub(super) fn crowds(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (speeds, half) = lab.pick(([8.0, 20.0, 40.0], 0.5), ([12.0, 18.0, 30.0], 0.4));
    let mut measures = Vec::new();
    for speed in speeds {
        let mut scene = weightless("crowds");
        for side in [-1.0, 1.0] {
            for i in 0..25 {
                let place = Vec2::new(1.5 + (i % 5) as f32, (i / 5) as f32 + 0.15 * side);
                let place = Vec2::new(side * place.x, place.y) * (2.2 * half);
                let body = moving(rect(half, half), place);
                scene.body(body.velocity(Vec2::new(-side * speed, 0.0)));
            }
        }
        lab.expect_seconds(1.0, scene.dt);
        let mut trial = lab.build(scene);
        let mut deepest: f64 = 0.0;
        lab.run(&mut trial, 1.0, |trial| {
            deepest = greatest([deepest, trial.deepest_overlap()].into_iter());
        });
        let metric = format!("+-{speed} m/s, deepest overlap over the size of a box");
        let share = deepest / f64::from(2.0 * half);
        measures.push(Measure::new(metric, share, "", Target::AtMost(0.1)));
    }
    measures
}

/// The article's scene with many seeds: how deep do two bodies overlap on the way?
pub(super) fn seeds_of_the_demo(lab: &mut Lab<'_>) -> Vec<Measure> {
    const SEEDS: u64 = 200;
    let first = lab.pick(0, 1000);
    let mut deepest: f64 = 0.0;
    let Ok(entry) = find("seed_demo") else { return Vec::new() };
    lab.expect_seconds(5.0 * SEEDS as f64, DT as f32);
    for seed in first..first + SEEDS {
        let scene: Scene = entry.build(Options::default().seed(seed));
        let mut trial = lab.build(scene);
        lab.run(&mut trial, 5.0, |trial| {
            deepest = greatest([deepest, trial.deepest_overlap()].into_iter());
        });
    }
    let metric = format!("{SEEDS} seeds, deepest overlap on the way");
    vec![Measure::new(metric, deepest, "m", Target::AtMost(0.03))]
}
