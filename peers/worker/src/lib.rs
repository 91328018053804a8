//! What the engines' worker programs share.
//!
//! A worker is one engine in one configuration. It reads one [`Job`] as a line of JSON, builds the
//! scene through the engine's public interface, times its steps, and answers with one [`Report`] as
//! a line of JSON. Every job runs in a process of its own, so that no engine inherits another's heap,
//! threads or caches.

mod clock;
mod engine;
mod protocol;
mod run;

pub use clock::{mean, percentile};
pub use engine::{BodyState, Engine, Summary};
pub use protocol::{Answer, Job, Report};
pub use run::serve;
pub use tiny_physics_scenes::{Host, resolve};
