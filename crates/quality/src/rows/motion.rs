//! Knocks that are handed on, free motion, and what motion must keep.

use crate::lab::{Lab, Trial, greatest};
use crate::report::Measure;
use crate::scenery::{GRAVITY, disk, floored, moving, rect, scene, weightless};
use crate::target::Target;
use core::f64::consts::TAU;
use tiny_physics::{JointDef, RigidBody, ShapeDef, Vec2};

/// Dominoes of 0.2 m x 2 m, 1 m apart: all fall, and the wave runs as fast with steps an eighth as long.
pub(super) fn dominoes(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (count, pitch) = (lab.pick(100, 80), lab.pick(1.0, 0.8));
    let usual = 1.0 / 60.0;
    lab.expect_seconds(60.0, usual);
    lab.expect_seconds(60.0, usual / 8.0);
    let [coarse, fine] = [usual, usual / 8.0].map(|dt| wave(lab, count, pitch, dt));
    let standing = coarse.standing.max(fine.standing);
    let change = 100.0 * (coarse.seconds / fine.seconds - 1.0).abs();
    vec![
        Measure::new(
            format!("{count} dominoes, still standing"),
            standing,
            "",
            Target::AtMost(0.0),
        ),
        Measure::new(
            format!("{count} dominoes, change of the wave's speed from dt to dt/8"),
            change,
            "%",
            Target::AtMost(2.0),
        ),
    ]
}

struct Wave {
    /// From when the 20th from either end begins to fall until the other does.
    seconds: f64,
    standing: f64,
}

fn wave(lab: &mut Lab<'_>, count: usize, pitch: f32, dt: f32) -> Wave {
    const MARGIN: usize = 20;
    const TIPPED: f64 = 0.1;
    let mut scene = floored("dominoes");
    scene.dt = dt;
    for i in 0..count {
        let domino = moving(rect(0.1, 1.0), Vec2::new(pitch * (i as f32 - 50.0), 1.0));
        // The first tips about its foot.
        let push = if i == 0 { 1.5 } else { 0.0 };
        scene.body(domino.angular_velocity(-push).velocity(Vec2::new(push, 0.0)));
    }
    let (first, last) = (MARGIN, count + 1 - MARGIN);
    let mut trial = lab.build(scene);
    let mut passed = [f64::NAN; 2];
    let mut before = [0.0; 2];
    lab.run(&mut trial, 60.0, |trial| {
        for (k, body) in [first, last].into_iter().enumerate() {
            let angle = trial.angle(body).abs();
            if passed[k].is_nan() && angle >= TIPPED {
                let part = (TIPPED - before[k]) / (angle - before[k]);
                passed[k] = trial.time() - f64::from(dt) * (1.0 - part);
            }
            before[k] = angle;
        }
    });
    let standing = (1..=count).filter(|&body| trial.angle(body).abs() < 0.5).count();
    Wave { seconds: passed[1] - passed[0], standing: standing as f64 }
}

/// Newton's cradle: the first ball comes in at 4 m/s; how fast does the last leave?
pub(super) fn cradle(lab: &mut Lab<'_>) -> Vec<Measure> {
    const RADIUS: f32 = 0.5;
    let rod: f32 = 4.0;
    let (count, speed): (i32, f64) = lab.pick((5, 4.0), (4, 3.0));
    let mut scene = scene("cradle");
    let bar = scene.body(RigidBody::fixed());
    // The height that gives the speed: v^2 = 2 g rod (1 - cos).
    let cos = 1.0 - speed * speed / (2.0 * GRAVITY * f64::from(rod));
    let sin = -(1.0 - cos * cos).sqrt();
    let mut balls = Vec::new();
    for i in 0..count {
        let hook = Vec2::new(2.0 * RADIUS * i as f32, 0.0);
        let (s, c) = if i == 0 { (sin as f32, cos as f32) } else { (0.0, 1.0) };
        let ball = ShapeDef::new(disk(RADIUS)).friction(0.0).restitution(1.0);
        let ball = scene.body(moving(ball, hook + Vec2::new(rod * s, -rod * c)));
        scene.joint(bar, ball, JointDef::distance(rod).anchors(hook, Vec2::ZERO));
        balls.push(ball);
    }
    let last = balls[balls.len() - 1];
    // Half a swing: the last ball does not come back.
    let seconds = 0.5 * TAU * (f64::from(rod) / GRAVITY).sqrt();
    lab.expect_seconds(seconds, scene.dt);
    let mut trial = lab.build(scene);
    let mut fastest: f64 = 0.0;
    lab.run(&mut trial, seconds, |trial| fastest = fastest.max(trial.speed(last)));
    let target = Target::AtLeast { limit: 0.975 * speed, ideal: speed };
    let metric = format!("{count} balls, {speed} m/s, speed of the last");
    vec![Measure::new(metric, fastest, "m/s", target)]
}

/// A body that spins freely keeps its rate for 600 s.
pub(super) fn free_spin(lab: &mut Lab<'_>) -> Vec<Measure> {
    lab.expect_seconds(600.0, 1.0 / 60.0);
    let rate: f32 = lab.pick(10.0, -3.0);
    let mut scene = weightless("free spin");
    let top = scene.body(moving(rect(0.5, 0.25), Vec2::ZERO).angular_velocity(rate));
    let mut trial = lab.build(scene);
    lab.run(&mut trial, 600.0, |_| {});
    let change = (trial.angular_velocity(top) / f64::from(rate) - 1.0).abs();
    vec![Measure::new("600 s, |w/w0 - 1|", change, "", Target::AtMost(0.0))]
}

/// A cloud of boxes and disks falls together without gravity: momentum and angular momentum stay.
///
/// Errors are relative to the sum of the bodies' own momenta. Restitution 0.5, friction 0.6.
pub(crate) fn momentum(lab: &mut Lab<'_>) -> Vec<Measure> {
    lab.expect_seconds(10.0, 1.0 / 60.0);
    let side: i32 = lab.pick(16, 12);
    let mut scene = weightless("momentum");
    for i in 0..side * side {
        let (column, row) = ((i % side - side / 2) as f32, (i / side - side / 2) as f32);
        let place = Vec2::new(2.0 * column + 0.3, 2.0 * row - 0.2);
        // Inwards, and around: the cloud has both momenta.
        let velocity = place * -0.5 + Vec2::new(-place.y, place.x) * 0.2 + Vec2::new(0.5, 0.25);
        let shape = if (column + row) as i32 % 2 == 0 { rect(0.5, 0.4) } else { disk(0.45) };
        let body = moving(ShapeDef::new(shape).restitution(0.5), place).velocity(velocity);
        scene.body(body.angular_velocity(0.1 * (i % 7) as f32));
    }
    let bodies = scene.bodies.len();
    let mut trial = lab.build(scene);
    let before = Momentum::of(&trial);
    let mut knocks = vec![trial.velocity(0); bodies];
    let mut collisions = 0.0;
    lab.run(&mut trial, 10.0, |trial| {
        for (body, last) in knocks.iter_mut().enumerate() {
            let now = trial.velocity(body);
            // A collision changes two velocities.
            collisions += if (now - *last).length() > 1e-3 { 0.5 } else { 0.0 };
            *last = now;
        }
    });
    let after = Momentum::of(&trial);
    let linear = (after.x - before.x).hypot(after.y - before.y) / before.linear_sum;
    let angular = (after.angular - before.angular).abs() / before.angular_sum;
    vec![
        Measure::new(
            "collisions",
            collisions,
            "",
            Target::AtLeast { limit: 1000.0, ideal: f64::INFINITY },
        ),
        Measure::new("linear momentum, relative error", linear, "", Target::AtMost(1e-5)),
        Measure::new("angular momentum, relative error", angular, "", Target::AtMost(1e-5)),
    ]
}

/// Momenta of all bodies, and the sums of their sizes.
struct Momentum {
    x: f64,
    y: f64,
    angular: f64,
    linear_sum: f64,
    angular_sum: f64,
}

impl Momentum {
    fn of(trial: &Trial) -> Self {
        let mut sum = Self { x: 0.0, y: 0.0, angular: 0.0, linear_sum: 0.0, angular_sum: 0.0 };
        for (body, def) in trial.scene().bodies.iter().enumerate() {
            let shape = &def.shapes[0];
            let mass = shape.shape.mass_properties(shape.material.density);
            let (m, i) = (f64::from(mass.mass), f64::from(mass.inertia));
            let (p, v) = (trial.position(body), trial.velocity(body));
            let (x, y) = (m * f64::from(v.x), m * f64::from(v.y));
            let angular = p.x * y - p.y * x + i * trial.angular_velocity(body);
            sum.x += x;
            sum.y += y;
            sum.angular += angular;
            sum.linear_sum += x.hypot(y);
            sum.angular_sum += angular.abs();
        }
        sum
    }
}

/// A ball hits a rack of fifteen head on: for half a second, above and below mirror each other.
///
/// Balls of 1 m, touching; restitution 0.9, no friction.
pub(super) fn billiard_break(lab: &mut Lab<'_>) -> Vec<Measure> {
    const RADIUS: f32 = 0.5;
    let (rows, speed) = lab.pick((5, 10.0), (4, 7.0));
    let mut scene = weightless("billiard break");
    let ball = |x: f32, y: f32| {
        let shape = ShapeDef::new(disk(RADIUS)).friction(0.0).restitution(0.9);
        moving(shape, Vec2::new(x, y))
    };
    scene.body(ball(-4.0, 0.0).velocity(Vec2::new(speed, 0.0)));
    let mut mirrors = Vec::new();
    for row in 0..rows {
        let first = scene.bodies.len();
        for k in 0..=row {
            let y = k as f32 - 0.5 * row as f32;
            scene.body(ball(3.0_f32.sqrt() * 0.5 * row as f32, y));
        }
        mirrors.extend((0..=row as usize).map(|k| (first + k, first + row as usize - k)));
    }
    let hit = 3.0 / f64::from(speed);
    lab.expect_seconds(hit + 0.5, scene.dt);
    let mut trial = lab.build(scene);
    lab.run(&mut trial, hit + 0.5, |_| {});
    let error = greatest(mirrors.iter().map(|&(a, b)| {
        let (a, b) = (trial.position(a), trial.position(b));
        (a.x - b.x).hypot(a.y + b.y)
    }));
    let metric = format!("{rows} rows, 0.5 s after the hit, mirror error");
    vec![Measure::new(metric, 1000.0 * error, "mm", Target::AtMost(1.0))]
}
