//! What should cost next to nothing, and does it? A world asleep, and a level that nothing touches.

use super::{at_level, built_in, print};
use crate::args::BenchArgs;
use crate::commands::timing::{levels, median, milliseconds};
use crate::failure::{Failure, Outcome};
use crate::simulation::Simulation;
use serde::Serialize;
use std::io::Write;
use std::time::Instant;
use tiny_physics::{BodyKind, SimdLevel, Vec2};
use tiny_physics_scenes::Scene;

/// Most steps until a world must be asleep.
const UNTIL_ASLEEP: u32 = 1200;
/// Steps of a sleeping world that are timed together: one alone is shorter than the clock is exact.
const BATCH: u32 = 100;
/// Boxes that are to stand out of reach.
const FAR_BOXES: usize = 24_000;
/// Metres upwards from one copy of the level to the next: more than its height, and nothing falls up.
const FAR: f32 = 100.0;

/// A world in which everything has fallen asleep.
#[derive(Serialize)]
struct Asleep {
    figure: &'static str,
    simd: &'static str,
    /// Bodies that could move.
    bodies: usize,
    /// Microseconds a step: median of batches.
    us: f64,
    /// The slowest batch.
    us_max: f64,
}

/// What a level costs by being there.
#[derive(Serialize)]
struct Level {
    figure: &'static str,
    simd: &'static str,
    movers: usize,
    /// Static boxes within reach of the movers.
    boxes: usize,
    /// Static boxes that nothing comes near, in the second world alone.
    far_boxes: usize,
    /// Median step of the level as it is, milliseconds.
    ms: f64,
    /// Median step with the far boxes.
    ms_with_far: f64,
    /// How much longer that is, per cent.
    far_percent: f64,
}

/// Measures and prints both figures for each level.
pub fn run(args: &BenchArgs, out: &mut impl Write) -> Outcome {
    for level in levels(args) {
        let row = asleep(level, args)?;
        let Asleep { simd, bodies, us, us_max, .. } = row;
        let text = format!(
            "{simd}: a step of {bodies} bodies asleep takes {us:.2} us ({us_max:.2} at most)"
        );
        print(out, args, &row, &text)?;
        let row = tiles(level, args)?;
        let Level { movers, boxes, far_boxes, ms, ms_with_far, far_percent, .. } = row;
        let text = format!(
            "{simd}: a step of {movers} movers in a level of {boxes} boxes takes {ms:.4} ms; with {far_boxes} \
             boxes more that nothing touches {ms_with_far:.4} ms ({far_percent:+.1} %)"
        );
        print(out, args, &row, &text)?;
    }
    Ok(())
}

/// The small pyramids, when all have fallen asleep.
fn asleep(level: SimdLevel, args: &BenchArgs) -> Outcome<Asleep> {
    let mut scene = built_in("many_pyramids", 0)?;
    scene.settings.sleep = true;
    let mut simulation = Simulation::new(scene, &at_level(Some(level), args))?;
    for _ in 0..UNTIL_ASLEEP {
        if simulation.world().awake_body_count() == 0 {
            break;
        }
        simulation.step();
    }
    match simulation.world().awake_body_count() {
        0 => {}
        awake => {
            let what = format!("{awake} bodies are still awake after {UNTIL_ASLEEP} steps");
            return Err(Failure::new(what));
        }
    }
    let batches = (args.steps.unwrap_or(5000) / BATCH).max(1);
    let mut batch_us = Vec::new();
    for _ in 0..batches {
        let start = Instant::now();
        (0..BATCH).for_each(|_| simulation.step());
        batch_us.push(milliseconds(start) * 1000.0 / f64::from(BATCH));
    }
    Ok(Asleep {
        figure: "asleep",
        simd: level.name(),
        bodies: simulation.status().moving,
        us_max: batch_us.iter().copied().fold(0.0, f64::max),
        us: median(batch_us),
    })
}

/// The level with its movers, alone and with many boxes out of reach, step by step in turns.
fn tiles(level: SimdLevel, args: &BenchArgs) -> Outcome<Level> {
    let near = built_in("tiles", 0)?;
    let (far, far_boxes) = with_far_copies(&near);
    let how = at_level(Some(level), args);
    let mut worlds = [Simulation::new(near, &how)?, Simulation::new(far, &how)?];
    let mut step_ms = [Vec::new(), Vec::new()];
    for _ in 0..args.steps.unwrap_or(600) {
        for (world, step_ms) in worlds.iter_mut().zip(&mut step_ms) {
            let start = Instant::now();
            world.step();
            step_ms.push(milliseconds(start));
        }
    }
    let [ms, ms_with_far] = step_ms.map(median);
    let [near, _] = &worlds;
    let movers = near.status().moving;
    Ok(Level {
        figure: "level",
        simd: level.name(),
        movers,
        boxes: near.world().shape_count() - movers,
        far_boxes,
        ms,
        ms_with_far,
        far_percent: (ms_with_far / ms - 1.0) * 100.0,
    })
}

/// A scene with copies of its static bodies high above it, and how many shapes these have.
fn with_far_copies(scene: &Scene) -> (Scene, usize) {
    let level = scene.bodies.iter().filter(|body| body.kind == BodyKind::Static);
    let boxes: usize = level.clone().map(|body| body.shapes.len()).sum();
    let copies = FAR_BOXES.div_ceil(boxes.max(1));
    let mut far = scene.clone();
    for copy in 1..=copies {
        let up = Vec2::new(0.0, FAR * copy as f32);
        far.bodies.extend(level.clone().map(|body| {
            let position = body.position + up;
            body.clone().position(position)
        }));
    }
    (far, copies * boxes)
}
