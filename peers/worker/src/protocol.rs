//! What the runner and the workers say to each other.

use crate::{Frames, Summary, Worlds, WorldsJob};
use serde::{Deserialize, Serialize};
use tiny_physics_quality::arena::Findings;
use tiny_physics_scenes::Scene;

/// What a worker is asked to do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// Time a scene.
    Time(Job),
    /// Play a row of the quality suite.
    Quality(QualityJob),
    /// Measure what frames cost.
    Frames,
    /// Step many worlds in turn.
    Worlds(WorldsJob),
    /// Play a world of the arena.
    Arena(Box<Scene>),
}

/// One run to be made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Job {
    /// Name of the scene.
    pub scene: String,
    /// Threads that the engine may use.
    pub threads: usize,
    /// Steps to run, the untimed first one included; `None` takes the scene's own number.
    pub steps: Option<u32>,
    /// What the engine is to be set to at run time, for example a SIMD level; empty for its default.
    pub setting: String,
}

/// What one run took and where it ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Engine and version as the worker knows them.
    pub engine: String,
    /// How the engine was compiled, in words.
    pub build: String,
    /// Timed steps.
    pub steps: u32,
    /// Mean CPU time of the process over the timed steps, all threads together, milliseconds a step.
    pub cpu_ms: f64,
    /// Mean wall time of the timed steps, milliseconds a step.
    pub wall_ms: f64,
    /// 99th percentile of a step's CPU time, milliseconds.
    pub cpu_p99_ms: f64,
    /// 99th percentile of a step's wall time, milliseconds.
    pub wall_p99_ms: f64,
    /// CPU time of the step that took most, milliseconds.
    pub cpu_worst_ms: f64,
    /// Wall time of the step that took most, milliseconds.
    pub wall_worst_ms: f64,
    /// Wall time of building the world, milliseconds.
    pub build_ms: f64,
    /// Greatest resident memory of the process, mebibytes; 0 where the system does not tell.
    pub peak_mib: f64,
    /// The world after the last step.
    pub end: Summary,
}

/// A row of the quality suite to be played.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct QualityJob {
    /// The row.
    pub row: String,
    /// Play it in its other variant?
    pub other: bool,
    /// Record where bodies are at the start and after each so many steps.
    pub tape: Option<u32>,
}

/// What came of a row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Played {
    /// Engine and version as the worker knows them.
    pub engine: String,
    /// The row's numbers, in order.
    pub measures: Vec<Measured>,
    /// Why the engine cannot express a scene of the row; then the numbers mean nothing.
    pub cannot: Option<String>,
    /// A tape for each world of the row, in the order in which they ended, if tapes were asked for.
    pub tapes: Vec<Tape>,
}

/// One number of a row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// What was measured.
    pub metric: String,
    /// The number; `None` where the scene fell apart.
    pub value: Option<f64>,
}

/// The corners of a shape in its body's frame, metres; round ones have many.
pub type Outline = Vec<[f32; 2]>;

/// Where the bodies of a world were, again and again.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tape {
    /// Time from one frame to the next, seconds.
    pub seconds: f64,
    /// Each body's shapes.
    pub bodies: Vec<Vec<Outline>>,
    /// At the start and from then on: for each body x and y in metres and the angle in radians; `None` where one of
    /// them is no number.
    pub frames: Vec<Vec<Option<[f32; 3]>>>,
}

/// A worker's line of output.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// The run was made.
    Done(Report),
    /// The row was played.
    Played(Played),
    /// Frames were measured.
    Frames(Frames),
    /// Worlds were stepped.
    Worlds(Worlds),
    /// The world was played; nothing where the engine cannot express it.
    Arena(Option<Findings>),
    /// The engine cannot do this; the reason.
    Failed(String),
}
