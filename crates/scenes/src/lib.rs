//! Scenes for tiny-physics: the benchmark scenes that engines are compared on, small scenes that show the
//! engine off, the scene file, and what plays a scene on an engine.
//!
//! A [`Scene`] is plain data: bodies, joints, settings, and a [`Script`] for what happens from outside
//! while it runs. [`find`] builds one by name, [`Scene::load`] reads one from a file, [`Player`] plays it
//! on any [`Host`].
//!
//! ```
//! use tiny_physics_scenes::{Options, Scene, find};
//! let scene = find("bridge")?.build(Options::default());
//! let text = scene.to_json()?;
//! assert_eq!(Scene::from_json(&text)?, scene);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod bits;
mod build;
mod catalogue;
mod check;
mod churn;
mod error;
mod fault;
mod file;
mod golden;
mod grip;
mod host;
mod human;
mod json;
mod player;
mod random;
mod read;
mod scene;
mod script;
mod shapes;
mod tape;
mod version;
mod world_host;

pub use build::Options;
pub use catalogue::{Entry, UnknownScene, all, find, resolve, tags};
pub use churn::{Churn, ChurnCounts};
pub use error::{Problem, SceneError};
pub use golden::{Golden, golden, run_hash};
pub use grip::Grip;
pub use host::Host;
pub use human::Human;
pub use player::Player;
pub use random::Random;
pub use read::read;
pub use scene::{Counts, Scene, SceneJoint};
pub use script::{
    Act, Character, Deed, Key, Leg, Pull, Queries, Rain, Ride, Script, Terrain, Timeline,
    WakeSleepers, Walkers, When, lead_progress,
};
pub use tape::Tape;
pub use version::VERSION;
pub use world_host::{CommandHost, Commanded, PausedScript, Run, WorldHost};
