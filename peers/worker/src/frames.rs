//! What it costs to keep a world and to go back to it.

use crate::{Engine, Setup, Tuning};
use serde::{Deserialize, Serialize};
use std::hint::black_box;
use std::time::Instant;
use tiny_physics::{Polygon, RigidBody, ShapeDef, Vec2};
use tiny_physics_scenes::Scene;

/// Columns of the pile.
const COLUMNS: u32 = 200;
/// Crates on each other.
const ROWS: u32 = 50;

/// What an engine's frames cost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frames {
    /// Engine and version as the worker knows them.
    pub engine: String,
    /// Bodies in the world.
    pub bodies: usize,
    /// Touching contacts in it.
    pub contacts: usize,
    /// Bytes of a saved world.
    pub bytes: usize,
    /// Copying as many bytes, milliseconds: what cannot be beaten.
    pub copy_ms: f64,
    /// Copying the world into another that has the memory already, milliseconds; `None` where there is no such thing.
    pub clone_ms: Option<f64>,
    /// Writing the bytes, milliseconds.
    pub save_ms: f64,
    /// Going back to them in place, milliseconds.
    pub restore_ms: f64,
    /// Does a world that went back do the same as before, to the last bit of every position?
    pub repeats: bool,
}

/// Measures frames of a world of 10,000 crates that touch each other.
///
/// # Errors
/// An engine that cannot save its world, or that must not be measured.
pub fn measure<E: Engine>() -> Result<Frames, String> {
    let scene = pile();
    let mut world = E::create(&Setup {
        gravity: scene.gravity,
        settings: &scene.settings,
        tuning: Tuning::Own,
        threads: 1,
        setting: "",
    })?;
    let bodies: Vec<usize> = scene.bodies.iter().map(|body| world.add_body(body)).collect();
    let go_on = |world: &mut E| {
        (0..20).for_each(|_| world.step(scene.dt));
        bodies.iter().map(|&body| world.position(body)).collect::<Vec<_>>()
    };
    go_on(&mut world);
    let nothing = || "this engine or build cannot save its world".to_owned();
    let bytes = world.save().ok_or_else(nothing)?;
    let before = go_on(&mut world);
    world.restore(&bytes)?;
    let repeats = go_on(&mut world) == before;
    world.restore(&bytes)?;
    let mut copy = bytes.clone();
    let summary = world.summary();
    Ok(Frames {
        engine: E::name(),
        bodies: summary.bodies,
        contacts: summary.contacts,
        bytes: bytes.len(),
        copy_ms: best_ms(|| copy.copy_from_slice(black_box(&bytes))),
        clone_ms: world.clone_ms(),
        save_ms: best_ms(|| drop(black_box(world.save()))),
        restore_ms: best_ms(|| _ = black_box(world.restore(&bytes))),
        repeats,
    })
}

/// The fastest of many runs, milliseconds.
pub fn best_ms(mut work: impl FnMut()) -> f64 {
    let mut run = || {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64() * 1.0e3
    };
    (0..40).map(|_| run()).fold(f64::INFINITY, f64::min)
}

/// Crates side by side in columns.
fn pile() -> Scene {
    let mut scene = Scene::new("frames", "");
    let rect = |w, h| ShapeDef::new(Polygon::rect(w, h).expect("boxes here have a positive size"));
    let floor = RigidBody::fixed().shape(rect(200.0, 1.0));
    scene.body(floor.position(Vec2::new(0.0, -1.0)));
    for i in 0..COLUMNS * ROWS {
        let (column, row) = (i % COLUMNS, i / COLUMNS);
        let place = Vec2::new(column as f32 - 0.5 * COLUMNS as f32, 0.5 + row as f32);
        scene.body(RigidBody::dynamic().position(place).shape(rect(0.5, 0.5)));
    }
    scene
}
