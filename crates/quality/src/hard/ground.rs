//! Ground that changes under things, and things that have to notice.

use crate::lab::Lab;
use crate::report::Measure;
use crate::scenery::{crate_at, fixed, rect, scene};
use crate::target::Target;
use tiny_physics::Vec2;
use tiny_physics_scenes::Random;

/// A static box is put over a crate that rests on thick ground, awake: does the crate end in the ground or under it?
pub(super) fn tile_over_a_crate(lab: &mut Lab<'_>) -> Vec<Measure> {
    const COUNT: usize = 100;
    let (seed, half) = lab.pick((1, 0.5), (2, 0.4));
    lab.expect_seconds(4.0, 1.0 / 60.0);
    let mut scene = scene("tile over a crate");
    for i in 0..COUNT {
        scene.body(fixed(rect(5.0, 1.0), Vec2::new(10.0 * i as f32, -1.0)));
    }
    for i in 0..COUNT {
        scene.body(crate_at(10.0 * i as f32, 0.5, 1.0));
    }
    let mut trial = lab.build(scene);
    lab.run(&mut trial, 1.0, |_| {});
    let mut random = Random::new(seed);
    for i in 0..COUNT {
        let over = Vec2::new(random.range(-0.9, 0.9), random.range(0.3, 1.2));
        trial.add_body(fixed(rect(half, half), Vec2::new(10.0 * i as f32, 0.0) + over));
    }
    lab.run(&mut trial, 3.0, |_| {});
    let sunk = (COUNT..2 * COUNT).filter(|&body| !(trial.position(body).y > 0.3)).count();
    vec![Measure::new("crates in the ground, of 100", sunk as f64, "", Target::AtMost(0.0))]
}
