//! Costs that must grow no faster than what is paid for.

use crate::lab::Lab;
use crate::report::Measure;
use crate::scenery::rect;
use crate::target::Target;
use std::time::Instant;
use tiny_physics::{RigidBody, ShapeDef, Vec2, World};

/// Seconds that something takes, the least of several times.
fn least(mut what: impl FnMut()) -> f64 {
    const TIMES: usize = 3;
    let once = |_| {
        let start = Instant::now();
        what();
        start.elapsed().as_secs_f64()
    };
    (0..TIMES).map(once).fold(f64::INFINITY, f64::min)
}

/// How many times as long a piece of work takes by item when there are `more` items in place of `few`.
fn growth(few: usize, more: usize, mut work: impl FnMut(usize)) -> f64 {
    let mut by_item = |count: usize| least(|| work(count)) / count as f64;
    let (few, more) = (by_item(few), by_item(more));
    more / few
}

/// Shapes added to one body, one by one.
pub(super) fn many_shapes(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (few, more) = lab.pick((250, 2000), (200, 1500));
    let add = |count: usize| {
        let mut world = World::new(Vec2::ZERO);
        let Ok(level) = world.add_body(RigidBody::fixed()) else { return };
        for i in 0..count {
            let place = Vec2::new((i % 100) as f32, (i / 100) as f32);
            // A box here is valid, so it is added.
            let _ = world.add_shape(level, ShapeDef::new(rect(0.5, 0.5)).offset(place));
        }
    };
    let metric = format!("time a shape, {more} shapes against {few}");
    vec![Measure::new(metric, growth(few, more, add), "times", Target::AtMost(2.0))]
}
