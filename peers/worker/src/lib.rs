//! What the engines' worker programs share.
//!
//! A worker is one engine in one configuration. It reads one [`Task`] as a line of JSON and answers with a line of
//! JSON: it times a scene ([`Job`], [`Report`]) or plays a row of the quality suite ([`QualityJob`], [`Played`]), or measures [`Frames`] and [`Worlds`],
//! through the engine's public interface. Every task runs in a process of its own, so that no engine inherits
//! another's heap, threads or caches, and a crash costs one run.

mod clock;
mod engine;
mod frames;
mod ours;
mod protocol;
mod quality;
mod run;
mod shapes;
mod tape;
mod worlds;

pub use clock::{mean, percentile};
pub use engine::{BodyState, Engine, Setup, Summary, Tuning};
pub use frames::{Frames, best_ms};
pub use protocol::{Answer, Job, Measured, Outline, Played, QualityJob, Report, Tape, Task};
pub use run::serve;
pub use shapes::centered_box;
pub use tiny_physics_quality::Subject;
pub use tiny_physics_scenes::{Host, Scene, resolve};
pub use worlds::{Worlds, WorldsJob};
