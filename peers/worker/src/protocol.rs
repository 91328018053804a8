//! What the runner and the workers say to each other.

use crate::Summary;
use serde::{Deserialize, Serialize};

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
    /// Wall time of building the world, milliseconds.
    pub build_ms: f64,
    /// Greatest resident memory of the process, mebibytes; 0 where the system does not tell.
    pub peak_mib: f64,
    /// The world after the last step.
    pub end: Summary,
}

/// A worker's line of output.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// The run was made.
    Done(Report),
    /// The engine cannot run this scene; the reason.
    Failed(String),
}
