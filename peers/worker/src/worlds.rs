//! Many small worlds at once, stepped in turn: what who trains agents does.

use crate::clock::Stopwatch;
use crate::{Engine, Setup, Tuning};
use serde::{Deserialize, Serialize};
use tiny_physics_scenes::{Options, Player, find};

/// Rounds off the clock, in which memory is asked for.
const WARM: u32 = 5;

/// Worlds to be stepped.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldsJob {
    /// Name of the scene that each of them holds.
    pub scene: String,
    /// How many worlds.
    pub count: usize,
    /// Steps of each.
    pub rounds: u32,
}

/// What their steps took.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Worlds {
    /// Engine and version as the worker knows them.
    pub engine: String,
    /// Bodies in all worlds together.
    pub bodies: usize,
    /// CPU time of a step of one world, microseconds.
    pub step_us: f64,
}

/// Steps all worlds once a round, one after the other, on one thread.
///
/// # Errors
/// An unknown scene, or more worlds than the engine can hold.
pub fn measure<E: Engine>(job: &WorldsJob) -> Result<Worlds, String> {
    let scene = find(&job.scene).map_err(|error| error.to_string())?.build(Options::default());
    let setup = Setup {
        gravity: scene.gravity,
        settings: &scene.settings,
        tuning: Tuning::Scene,
        threads: 1,
        setting: "",
    };
    let worlds = (0..job.count).map(|_| Ok(Player::new(&scene, E::create(&setup)?)));
    let mut worlds = worlds.collect::<Result<Vec<_>, String>>()?;
    let mut round = || worlds.iter_mut().for_each(|world| world.step());
    (0..WARM).for_each(|_| round());
    let watch = Stopwatch::start();
    (0..job.rounds).for_each(|_| round());
    let steps = job.count as f64 * f64::from(job.rounds);
    let step_us = watch.elapsed_ms().0 * 1e3 / steps;
    let bodies = worlds.iter_mut().map(|world| world.host().summary().bodies).sum();
    Ok(Worlds { engine: E::name(), bodies, step_us })
}
