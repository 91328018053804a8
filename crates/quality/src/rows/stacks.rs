//! Things on top of each other.

use crate::lab::{Lab, Trial, greatest};
use crate::report::Measure;
use crate::scenery::{add_tower, crate_at, floored, moving, rect};
use crate::target::Target;
use tiny_physics::{ShapeDef, Vec2};
use tiny_physics_scenes::Scene;

/// A house of cards: how long until a card has moved by 10 cm?
///
/// Box2D's sample: cards of 0.4 m x 2 mm, friction 0.7, leaning by 25 degrees; flat cards overlap where
/// they meet.
pub(super) fn card_house(lab: &mut Lab<'_>) -> Vec<Measure> {
    const LONGEST: f64 = 600.5;
    let levels = lab.pick(5, 4);
    let scene = cards(levels);
    let cards = scene.bodies.len();
    lab.expect_seconds(LONGEST, scene.dt);
    let mut trial = lab.build(scene);
    let has_moved = |trial: &Trial| {
        greatest((1..cards).map(|card| {
            let moved = trial.moved(card);
            moved.x.hypot(moved.y)
        })) > 0.1
    };
    while trial.time() < LONGEST && !has_moved(&trial) {
        lab.step(&mut trial);
    }
    let target = Target::AtLeast { limit: 600.0, ideal: f64::INFINITY };
    let metric = format!("{levels} levels: time until a card has moved by 10 cm");
    vec![Measure::new(metric, trial.time(), "s", target)]
}

fn cards(levels: u32) -> Scene {
    const HALF_LENGTH: f32 = 0.2;
    const PITCH: f32 = 0.175;
    let mut scene = floored("card house");
    let mut card = |x: f32, y: f32, degrees: f32| {
        let shape = ShapeDef::new(rect(0.001, HALF_LENGTH)).friction(0.7);
        scene.body(moving(shape, Vec2::new(x, y)).angle(degrees.to_radians()));
    };
    let mut y = HALF_LENGTH - 0.02;
    for level in 0..levels {
        for tent in 0..levels - level {
            let x = PITCH * (level + 2 * tent) as f32;
            if tent + 1 < levels - level {
                card(x + 0.25, y + HALF_LENGTH - 0.015, 90.0);
            }
            card(x, y, -25.0);
            card(x + PITCH, y, 25.0);
        }
        y += 2.0 * HALF_LENGTH - 0.03;
    }
    scene
}

/// A heavy crate on a light one: deepest overlap over 10 s.
pub(super) fn heavy_on_light(lab: &mut Lab<'_>) -> Vec<Measure> {
    lab.expect_seconds(20.0, 1.0 / 60.0);
    [lab.pick(100.0, 50.0), lab.pick(1000.0, 500.0)]
        .into_iter()
        .zip([5.0, 20.0])
        .map(|(ratio, limit)| {
            let mut scene = floored("heavy on light");
            scene.body(crate_at(0.0, 0.5, 1.0));
            let heavy = scene.body(crate_at(0.0, 1.5, ratio));
            let mut trial = lab.build(scene);
            let overlap = deepest_of_tower(lab, &mut trial, heavy, 10.0);
            let metric = format!("{ratio}:1, deepest overlap");
            Measure::new(metric, 1000.0 * overlap, "mm", Target::AtMost(limit))
        })
        .collect()
}

/// Light crates under a heavy one: deepest overlap over 60 s.
pub(super) fn heavy_tower(lab: &mut Lab<'_>) -> Vec<Measure> {
    lab.expect_seconds(60.0, 1.0 / 60.0);
    let (light, ratio) = (lab.pick(4, 3), lab.pick(1000.0, 700.0));
    let mut scene = floored("heavy tower");
    add_tower(&mut scene, light);
    let heavy = scene.body(crate_at(0.0, light as f32 + 0.5, ratio));
    let mut trial = lab.build(scene);
    let overlap = deepest_of_tower(lab, &mut trial, heavy, 60.0);
    let metric = format!("{light} crates under one of {ratio}:1, 60 s, deepest overlap");
    vec![Measure::new(metric, 1000.0 * overlap, "mm", Target::AtMost(25.0))]
}

/// Deepest overlap in a tower over some seconds; infinite if it falls.
fn deepest_of_tower(lab: &mut Lab<'_>, trial: &mut Trial, top: usize, seconds: f64) -> f64 {
    let mut deepest: f64 = 0.0;
    lab.run(trial, seconds, |trial| {
        deepest = deepest.max(trial.deepest_overlap_of_neighbours());
    });
    if stands(trial, top) { deepest } else { f64::INFINITY }
}

/// Is a body within half a metre of where it started?
fn stands(trial: &Trial, body: usize) -> bool {
    let moved = trial.moved(body);
    moved.x.hypot(moved.y) < 0.5
}

/// Towers of crates: how far the top sinks, and how far any crate goes sideways, in 60 s.
pub(super) fn stack(lab: &mut Lab<'_>) -> Vec<Measure> {
    const SECONDS: f64 = 60.0;
    lab.expect_seconds(2.0 * SECONDS, 1.0 / 60.0);
    let sizes = [lab.pick(20, 15), lab.pick(100, 80)];
    let limits = [0.03, 0.8];
    let mut measures = Vec::new();
    for (count, limit) in sizes.into_iter().zip(limits) {
        let mut scene = floored("stack");
        add_tower(&mut scene, count);
        lab.may_sleep(&mut scene);
        let top = count as usize;
        let mut trial = lab.build(scene);
        let mut sideways: f64 = 0.0;
        lab.run(&mut trial, SECONDS, |trial| {
            sideways = sideways.max(greatest((1..=top).map(|body| trial.moved(body).x.abs())));
        });
        let sag = -trial.moved(top).y;
        // A tower that fell over has not sunk.
        let sag = if sideways < 0.5 { sag } else { f64::INFINITY };
        let metric = format!("{count} crates, 60 s, sag");
        measures.push(Measure::new(metric, sag, "m", Target::AtMost(limit)));
        let metric = format!("{count} crates, 60 s, sideways");
        let target = Target::AtMost(0.1);
        measures.push(Measure::new(metric, 1000.0 * sideways, "mm", target));
    }
    measures
}
