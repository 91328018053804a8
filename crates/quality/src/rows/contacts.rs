//! Friction and restitution against formulas.

use crate::lab::Lab;
use crate::report::Measure;
use crate::scenery::{disk, fixed, floored, moving, rect, scene};
use crate::target::Target;
use tiny_physics::{RigidBody, ShapeDef, Vec2};

/// The angle from which on a box slides down a ramp, found by halving: atan(friction).
pub(super) fn ramp(lab: &mut Lab<'_>) -> Vec<Measure> {
    const HALVINGS: u32 = 12;
    lab.expect_seconds(3.0 * 10.0 * f64::from(HALVINGS), 1.0 / 60.0);
    lab.pick([0.2, 0.5, 0.8], [0.3, 0.6, 0.9])
        .into_iter()
        .map(|friction| {
            let expected = f64::from(friction).atan().to_degrees();
            let (mut holds, mut slides) = (expected - 2.0, expected + 2.0);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (holds + slides);
                if slides_down(lab, friction, middle.to_radians()) {
                    slides = middle;
                } else {
                    holds = middle;
                }
            }
            let found = 0.5 * (holds + slides);
            let metric = format!("friction {friction}, critical angle {expected:.3}, error");
            Measure::new(
                metric,
                found - expected,
                "degrees",
                Target::Within { value: 0.0, tolerance: 0.02 },
            )
        })
        .collect()
}

/// Does a box on a ramp get faster from 5 s to 10 s? (One that creeps does not.)
fn slides_down(lab: &mut Lab<'_>, friction: f32, angle: f64) -> bool {
    let mut scene = scene("ramp");
    let (s, c) = (angle.sin() as f32, angle.cos() as f32);
    let ramp = fixed(rect(100.0, 1.0), Vec2::new(s, -c)).angle(angle as f32).friction(friction);
    scene.body(ramp);
    // The box's middle is half a metre above the ramp's surface.
    let slider = moving(rect(0.5, 0.5), Vec2::new(-0.5 * s, 0.5 * c));
    let slider = scene.body(slider.angle(angle as f32).friction(friction));
    let mut trial = lab.build(scene);
    lab.run(&mut trial, 5.0, |_| {});
    let early = trial.speed(slider);
    lab.run(&mut trial, 5.0, |_| {});
    trial.speed(slider) - early > 0.001
}

/// A disk that slides without turning ends up rolling at 2/3 of its speed.
pub(super) fn rolling(lab: &mut Lab<'_>) -> Vec<Measure> {
    lab.expect_seconds(10.0, 1.0 / 60.0);
    let (radius, speed) = (lab.pick(0.5, 0.3), lab.pick(10.0, 7.0));
    let mut scene = floored("rolling");
    let start = Vec2::new(-100.0, radius);
    let ball = scene.body(moving(disk(radius), start).velocity(Vec2::new(speed, 0.0)));
    let mut trial = lab.build(scene);
    lab.run(&mut trial, 10.0, |_| {});
    let kept = f64::from(trial.velocity(ball).x) / f64::from(speed);
    let target = Target::Within { value: 0.6667, tolerance: 0.0005 };
    vec![Measure::new("v/v0 of a disk that slid", kept, "", target)]
}

/// A ball dropped onto the floor: height of the first apex over the height that it fell from.
pub(super) fn bounce(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (radius, height) = (0.5, lab.pick(10.0, 4.0));
    lab.expect_seconds(4.0 * 5.0, 1.0 / 60.0);
    lab.pick([0.3, 0.5, 0.8, 1.0], [0.4, 0.6, 0.7, 0.9])
        .into_iter()
        .map(|restitution| {
            let mut scene = floored("bounce");
            scene.bodies[0] = bouncy(scene.bodies[0].clone(), restitution);
            let ball = moving(disk(radius), Vec2::new(0.0, radius + height));
            let ball = scene.body(bouncy(ball, restitution));
            let mut trial = lab.build(scene);
            let (mut apex, mut bounces): (f64, u32) = (0.0, 0);
            let mut was_rising = false;
            lab.run(&mut trial, 5.0, |trial| {
                let rising = trial.velocity(ball).y > 0.0;
                bounces += u32::from(rising && !was_rising);
                was_rising = rising;
                if bounces == 1 {
                    apex = apex.max(trial.position(ball).y - f64::from(radius));
                }
            });
            let expected = f64::from(restitution * restitution);
            Measure::new(
                format!("restitution {restitution}, apex over height"),
                apex / f64::from(height),
                "",
                Target::Within { value: expected, tolerance: 0.005 * expected },
            )
        })
        .collect()
}

fn bouncy(body: RigidBody, restitution: f32) -> RigidBody {
    body.restitution(restitution)
}

/// A crate dropped on a belt takes the belt's speed.
pub(super) fn conveyor(lab: &mut Lab<'_>) -> Vec<Measure> {
    lab.expect_seconds(8.0, 1.0 / 60.0);
    let speed: f32 = lab.pick(2.0, -5.0);
    let mut scene = scene("conveyor");
    let belt = ShapeDef::new(rect(100.0, 1.0)).tangent_speed(speed);
    scene.body(fixed(belt, Vec2::new(0.0, -1.0)));
    let load = scene.body(moving(rect(0.5, 0.5), Vec2::new(0.0, 0.6)));
    let mut trial = lab.build(scene);
    lab.run(&mut trial, 8.0, |_| {});
    let error = f64::from(trial.velocity(load).x.abs() / speed.abs() - 1.0);
    vec![Measure::new(
        format!("belt of {} m/s, error of the load's speed", speed.abs()),
        100.0 * error,
        "%",
        Target::Within { value: 0.0, tolerance: 0.1 },
    )]
}
