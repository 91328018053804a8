//! Energy that must not grow, and turning at any speed.

use crate::lab::{Lab, greatest};
use crate::report::Measure;
use crate::scenery::{disk, fixed, moving, rect, scene, weightless};
use crate::target::Target;
use core::f64::consts::{PI, TAU};
use tiny_physics::{ShapeDef, Vec2};

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
    let slippery = |shape| ShapeDef::new(shape).friction(0.0).restitution(1.0);
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

/// Between two shares of what there was.
fn left(least: f64, most: f64) -> Target {
    Target::Within { value: 0.5 * (least + most), tolerance: 0.5 * (most - least) }
}
