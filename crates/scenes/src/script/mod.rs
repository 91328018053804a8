//! What happens to a scene from outside while it runs: plain data in the scene file, played on any
//! [`Host`].

mod character;
mod deed;
mod queries;
mod rain;
mod terrain;
mod timeline;
mod wake;
mod walkers;

pub use character::{Character, Key, Leg, Ride};
pub use deed::{Deed, Pull, lead_progress};
pub use queries::Queries;
pub use rain::Rain;
pub use terrain::Terrain;
pub use timeline::{Act, Timeline, When};
pub use wake::WakeSleepers;
pub use walkers::Walkers;

use crate::check::Check;
use crate::host::Host;
use serde::{Deserialize, Serialize};

/// What a scene does before each step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum Script {
    /// Ragdolls rain down and are taken away again.
    Rain(Rain),
    /// Islands that fell asleep are woken.
    WakeSleepers(WakeSleepers),
    /// Bodies walk to and fro.
    Walkers(Walkers),
    /// Ground is removed on the left and added on the right.
    Terrain(Terrain),
    /// A paddle moves and many questions are asked of the world.
    Queries(Queries),
    /// Things are done at their times.
    Timeline(Timeline),
    /// A character walks through the scene.
    Character(Character),
}

impl Script {
    /// Are its parameters sensible in a scene of so many bodies?
    pub(crate) fn check(&self, bodies: usize) -> Check {
        match self {
            Self::Rain(rain) => rain.check().map_err(|e| e.under("rain")),
            Self::WakeSleepers(wake) => wake.check(bodies).map_err(|e| e.under("wake_sleepers")),
            Self::Walkers(walkers) => walkers.check(bodies).map_err(|e| e.under("walkers")),
            Self::Terrain(terrain) => terrain.check(bodies).map_err(|e| e.under("terrain")),
            Self::Queries(queries) => queries.check(bodies).map_err(|e| e.under("queries")),
            Self::Timeline(line) => line.check(bodies).map_err(|e| e.under("timeline")),
            Self::Character(character) => character.check(bodies).map_err(|e| e.under("character")),
        }
    }

    /// Begins to play it; `bodies` are the host's numbers of the scene's bodies, `dt` is the scene's step.
    pub(crate) fn start(&self, bodies: &[usize], dt: f32) -> Running {
        match self {
            Self::Rain(rain) => Running::Rain(rain.start()),
            Self::WakeSleepers(wake) => Running::Wake(wake.start(bodies)),
            Self::Walkers(walkers) => Running::Walkers(walkers.start(bodies)),
            Self::Terrain(terrain) => Running::Terrain(terrain.start(bodies)),
            Self::Queries(queries) => Running::Queries(queries.start(bodies)),
            Self::Timeline(timeline) => Running::Timeline(timeline.start(bodies, dt)),
            Self::Character(character) => Running::Character(Box::new(character.start(bodies, dt))),
        }
    }
}

/// A script that is being played, with what it has to remember.
#[derive(Clone, Debug)]
pub(crate) enum Running {
    Rain(rain::Raining),
    Wake(wake::Waking),
    Walkers(walkers::Walking),
    Terrain(terrain::Streaming),
    Queries(queries::Asking),
    Timeline(timeline::Happening),
    Character(Box<character::Walking>),
}

impl Running {
    /// Acts on the world before step number `step`, counted from 0.
    pub(crate) fn before_step(&mut self, host: &mut dyn Host, step: u32) {
        match self {
            Self::Rain(rain) => rain.before_step(host, step),
            Self::Wake(wake) => wake.before_step(host),
            Self::Walkers(walkers) => walkers.before_step(host, step),
            Self::Terrain(terrain) => terrain.before_step(host, step),
            Self::Queries(queries) => queries.before_step(host),
            Self::Timeline(timeline) => timeline.before_step(host, step),
            Self::Character(character) => character.before_step(host, step),
        }
    }
}
