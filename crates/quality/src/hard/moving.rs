//! Machines that are moved, and what they carry, hit and hold.

use super::common::{DT, PHASES, ghost, machine, none, passed};
use crate::lab::{Lab, Trial, greatest};
use crate::report::Measure;
use crate::scenery::{disk, moving, rect, scene, weightless};
use crate::target::Target;
use core::f32::consts::{PI, TAU};
use tiny_physics::{RigidBody, ShapeDef, Vec2};
use tiny_physics_scenes::Scene;

/// Lifts that reach their speed in a second: which lose what stands on them?
pub(super) fn lift(lab: &mut Lab<'_>) -> Vec<Measure> {
    const SPEEDS: [f32; 10] = [2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 80.0, 100.0];
    let (half_width, half_height) = lab.pick((2.0, 0.1), (1.5, 0.15));
    let radii = lab.pick([0.1, 0.25], [0.15, 0.4]);
    let side = lab.pick(0.5, 0.35);
    let mut scene = scene("lift");
    for i in 0..3 * SPEEDS.len() {
        let at = Vec2::new(12.0 * i as f32, 0.0);
        scene.body(machine(rect(half_width, half_height), at));
        let (shape, half) = match i % 3 {
            2 => (rect(side, side), side),
            ball => (disk(radii[ball]), radii[ball]),
        };
        scene.body(moving(shape, at + Vec2::new(0.0, half_height + half)));
    }
    lab.expect_seconds(2.0, scene.dt);
    let mut trial = lab.build(scene);
    for step in 0..120 {
        let progress = (step as f32 / 60.0).min(1.0);
        for (i, speed) in SPEEDS.iter().flat_map(|speed| [speed; 3]).enumerate() {
            trial.set_velocity(2 * i, Vec2::new(0.0, speed * progress));
        }
        lab.step(&mut trial);
    }
    let lost = |load: usize| {
        let lost = |i: &usize| {
            let (lift, load) = (trial.position(2 * i), trial.position(2 * i + 1));
            let held = load.y > lift.y && (load.x - lift.x).abs() < f64::from(half_width) + 0.5;
            !held
        };
        (0..3 * SPEEDS.len()).filter(|i| i % 3 == load).filter(lost).count()
    };
    let names =
        [format!("ball of {} m", radii[0]), format!("ball of {} m", radii[1]), "box".into()];
    let loads = names.into_iter().enumerate();
    loads.map(|(i, name)| none(format!("{name}, lost of 10, 2 to 100 m/s"), lost(i))).collect()
}

/// Walls that come upon resting balls: how many balls do they pass?
pub(super) fn wall_meets_ball(lab: &mut Lab<'_>) -> Vec<Measure> {
    let cases = lab.pick(
        [
            (0.1, 0.1, 10.0),
            (0.1, 0.1, 40.0),
            (0.1, 0.1, 150.0),
            (0.4, 0.25, 20.0),
            (0.4, 0.25, 80.0),
        ],
        [
            (0.06, 0.15, 15.0),
            (0.06, 0.15, 60.0),
            (0.06, 0.15, 120.0),
            (0.3, 0.2, 30.0),
            (0.3, 0.2, 110.0),
        ],
    );
    let mut measures = Vec::new();
    for (thickness, radius, speed) in cases {
        let mut scene = weightless("wall meets ball");
        let from = |gap: f32| -gap - 0.5 * thickness - radius;
        for i in 0..PHASES {
            let y = 10.0 * i as f32;
            let gap = 1.0 + speed * DT as f32 * i as f32 / PHASES as f32;
            let wall = machine(rect(0.5 * thickness, 1.0), Vec2::new(from(gap), y));
            scene.body(wall.velocity(Vec2::new(speed, 0.0)));
            scene.body(moving(disk(radius), Vec2::new(0.0, y)));
        }
        let passed = passed(lab, scene, 0.5);
        let metric =
            format!("wall of {thickness} m, ball of {radius} m, {speed} m/s, passed of 40");
        measures.push(none(metric, passed));
    }
    measures
}

/// Bars that turn about their end and come upon resting balls: how many balls do they pass?
pub(super) fn flipper(lab: &mut Lab<'_>) -> Vec<Measure> {
    const SPEEDS: [f32; 4] = [5.0, 10.0, 20.0, 40.0];
    let (length, half_thickness) = lab.pick((2.0, 0.08), (1.6, 0.06));
    let mut measures = Vec::new();
    for radius in lab.pick([0.1, 0.2], [0.12, 0.16]) {
        for speed in SPEEDS {
            let passed = flipped(lab, (length, half_thickness), radius, speed);
            let metric = format!("bar at {speed} rad/s, ball of {radius} m, passed of {PHASES}");
            measures.push(none(metric, passed));
        }
    }
    measures
}

/// How many of the balls a bar passes that turns at a speed.
fn flipped(
    lab: &mut Lab<'_>,
    (length, half_thickness): (f32, f32),
    radius: f32,
    speed: f32,
) -> usize {
    let turn = speed * DT as f32;
    let mut scene = weightless("flipper");
    for i in 0..PHASES {
        let at = Vec2::new(0.0, 10.0 * i as f32);
        let half = 0.5 * length;
        // What balances the bar collides with nothing: so the centre of mass is the pivot.
        let bar = ShapeDef::new(rect(half, half_thickness));
        let balance = ghost(rect(half, half_thickness)).offset(Vec2::new(-half, 0.0));
        let body = RigidBody::kinematic().can_sleep(false).position(at);
        let body = body.shape(bar.offset(Vec2::new(half, 0.0))).shape(balance);
        scene.body(body.angular_velocity(speed));
        let angle = 0.4 + turn * i as f32 / PHASES as f32;
        let place = Vec2::new(angle.cos(), angle.sin()) * (0.55 * length);
        scene.body(moving(disk(radius), at + place));
    }
    let mut trial = lab.build(scene);
    let steps = ((0.4 + turn + 0.5) / turn).ceil();
    lab.run(&mut trial, DT * f64::from(steps), |_| {});
    (0..PHASES).filter(|i| is_behind(&trial, 2 * i, 2 * i + 1, f64::from(length))).count()
}

/// Is a ball behind the bar that turned towards it, before its end?
fn is_behind(trial: &Trial, bar: usize, ball: usize, length: f64) -> bool {
    let (pivot, ball) = (trial.position(bar), trial.position(ball));
    let (dx, dy) = (ball.x - pivot.x, ball.y - pivot.y);
    let (s, c) = trial.angle(bar).sin_cos();
    let (along, across) = (c * dx + s * dy, c * dy - s * dx);
    !(across > 0.0) && (0.0..length).contains(&along)
}

/// Six crates in a closed wagon: how many get out?
pub(super) fn wagon(lab: &mut Lab<'_>) -> Vec<Measure> {
    let slowly = lab.pick([20.0, 40.0, 70.0, 100.0], [30.0, 50.0, 60.0, 90.0]);
    let at_once = lab.pick([10.0, 30.0, 60.0, 100.0], [20.0, 40.0, 50.0, 80.0]);
    let half = lab.pick(0.5, 0.4);
    let mut count = |speeds: [f32; 4], acceleration: f32| {
        let mut scene = scene("wagon");
        for i in 0..4 {
            add_wagon(&mut scene, 20.0 * i as f32, half);
        }
        let seconds = 2.0 + f64::from(speeds[3] / acceleration);
        lab.expect_seconds(seconds, scene.dt);
        let mut trial = lab.build(scene);
        lab.run(&mut trial, 0.5, |_| {});
        for step in 0..(60.0 * seconds) as u32 {
            for (i, speed) in speeds.iter().enumerate() {
                let now = speed.min(acceleration * step as f32 / 60.0 + 1e-3);
                trial.set_velocity(7 * i, Vec2::new(now, 0.0));
            }
            lab.step(&mut trial);
        }
        let out = |&body: &usize| {
            let (wagon, load) = (trial.position(body / 7 * 7), trial.position(body));
            let inside = (load.x - wagon.x).abs() < 3.0 && (load.y - wagon.y).abs() < 1.5;
            body % 7 != 0 && !inside
        };
        (0..trial.len()).filter(out).count()
    };
    vec![
        none("reached at 10 m/s2, 20 to 100 m/s, out of 24".into(), count(slowly, 10.0)),
        none("at once, 10 to 100 m/s, out of 24".into(), count(at_once, 1e9)),
    ]
}

/// A wagon, 6 m by 3 m inside, and six crates in it.
fn add_wagon(scene: &mut Scene, y: f32, half: f32) {
    let mut wagon = RigidBody::kinematic().can_sleep(false).position(Vec2::new(0.0, y));
    for side in [-1.0, 1.0] {
        wagon = wagon
            .shape(ShapeDef::new(rect(3.2, 0.1)).offset(Vec2::new(0.0, 1.6 * side)))
            .shape(ShapeDef::new(rect(0.1, 1.7)).offset(Vec2::new(3.1 * side, 0.0)));
    }
    scene.body(wagon);
    for i in 0..6 {
        let x = 1.3 * ((i % 3) as f32 - 1.0);
        let place = Vec2::new(x, y - 1.5 + half * (1 + 2 * (i / 3)) as f32);
        scene.body(moving(rect(half, half), place));
    }
}

/// A drum with paddles that stirs balls: how many get out in ten seconds?
pub(super) fn drum(lab: &mut Lab<'_>) -> Vec<Measure> {
    const SIDES: usize = 20;
    let (radius, ball) = lab.pick((4.0_f32, 0.2), (3.0, 0.15));
    let mut measures = Vec::new();
    for speed in lab.pick([6.0, 12.0, 20.0], [8.0, 15.0, 18.0]) {
        let mut scene = scene("drum");
        let mut drum = RigidBody::kinematic().can_sleep(false).angular_velocity(speed);
        let half_side = radius * (PI / SIDES as f32).tan() + 0.05;
        for i in 0..SIDES {
            let angle = TAU * i as f32 / SIDES as f32;
            let out = Vec2::new(angle.cos(), angle.sin());
            let side = ShapeDef::new(rect(0.1, half_side)).offset(out * radius).angle(angle);
            drum = drum.shape(side);
            if i % 5 == 0 {
                let paddle = rect(0.2 * radius, 0.1);
                drum = drum.shape(ShapeDef::new(paddle).offset(out * (0.8 * radius)).angle(angle));
            }
        }
        scene.body(drum);
        for i in 0..30 {
            let place = Vec2::new((i % 6) as f32 - 2.5, (i / 6) as f32 - 2.0) * (2.1 * ball);
            scene.body(moving(disk(ball), place));
        }
        lab.expect_seconds(10.0, scene.dt);
        let mut trial = lab.build(scene);
        lab.run(&mut trial, 10.0, |_| {});
        let out = |&body: &usize| {
            let p = trial.position(body);
            !(p.x.hypot(p.y) < f64::from(radius) + 0.3)
        };
        let metric = format!("drum at {speed} rad/s, out of 30 balls");
        measures.push(none(metric, (1..=30).filter(out).count()));
    }
    measures
}

/// A pile on a plate that rises fast, all of it from the start: how many fall off?
pub(super) fn rising_pile(lab: &mut Lab<'_>) -> Vec<Measure> {
    let speeds = lab.pick([30.0, 100.0, 150.0], [45.0, 80.0, 120.0]);
    let measure = |speed: f32| {
        let mut scene = scene("rising pile");
        add_pile(&mut scene, 0.5, Vec2::new(0.0, speed));
        lab.expect_seconds(3.0, scene.dt);
        let mut trial = lab.build(scene);
        lab.run(&mut trial, 3.0, |_| {});
        none(format!("plate at {speed} m/s, lost of 20"), lost(&trial))
    };
    speeds.map(measure).into()
}

/// A plate as the first body and twenty crates over it, all at one velocity.
fn add_pile(scene: &mut Scene, half: f32, velocity: Vec2) {
    scene.body(machine(rect(6.0, 0.5), Vec2::new(0.0, -0.5)).velocity(velocity));
    for i in 0..20 {
        let (column, row) = (i % 4, i / 4);
        let x = 2.2 * half * (column as f32 - 1.5) + 0.1 * half * (row % 2) as f32;
        let place = Vec2::new(x, half * (1.1 + 2.1 * row as f32));
        scene.body(moving(rect(half, half), place).velocity(velocity));
    }
}

/// Bodies of a pile that are below its plate, or nowhere.
fn lost(trial: &Trial) -> usize {
    let plate = trial.position(0).y;
    (1..trial.len()).filter(|&body| !(trial.position(body).y > plate)).count()
}

/// A pile that drops on a plate, at rest and with all of it in motion: how much does that differ after two seconds?
pub(super) fn galilean(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (half, speed) = lab.pick((0.5, 100.0), (0.4, 60.0));
    let mut play = |gravity: f32, relative: Vec2, velocity: Vec2| {
        let mut scene = Scene { gravity: Vec2::new(0.0, gravity), ..scene("galilean") };
        add_pile(&mut scene, half, velocity);
        scene.bodies[1..].iter_mut().for_each(|body| body.velocity += relative);
        lab.expect_seconds(2.0, scene.dt);
        let mut trial = lab.build(scene);
        lab.run(&mut trial, 2.0, |_| {});
        trial
    };
    let mut measures = Vec::new();
    let (down, sideways, upwards) =
        (Vec2::new(0.0, -2.0), Vec2::new(speed, 0.0), Vec2::new(0.0, speed));
    for (name, gravity, velocity) in
        [("sideways", -10.0, sideways), ("upwards, no gravity", 0.0, upwards)]
    {
        let (rest, moved) = (play(gravity, down, Vec2::ZERO), play(gravity, down, velocity));
        let gap = |body: usize| {
            let from_plate = |trial: &Trial| {
                let (p, plate) = (trial.position(body), trial.position(0));
                [p.x - plate.x, p.y - plate.y]
            };
            let (a, b) = (from_plate(&rest), from_plate(&moved));
            (a[0] - b[0]).hypot(a[1] - b[1])
        };
        let metric = format!("{name} at {speed} m/s, difference from rest");
        measures.push(Measure::new(metric, greatest((1..=20).map(gap)), "m", Target::AtMost(0.1)));
        measures.push(none(format!("{name} at {speed} m/s, lost of 20"), lost(&moved)));
    }
    measures
}
