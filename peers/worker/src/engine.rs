//! What an engine must offer to run a scene.

use serde::{Deserialize, Serialize};
use tiny_physics::{Settings, Vec2};
use tiny_physics_quality::Subject;
use tiny_physics_scenes::Scene;

/// What a world is made with.
#[derive(Clone, Copy, Debug)]
pub struct Setup<'a> {
    /// Metres a second squared.
    pub gravity: Vec2,
    /// The scene's settings.
    pub settings: &'a Settings,
    /// How much of the settings counts.
    pub tuning: Tuning,
    /// Threads that the engine may use.
    pub threads: usize,
    /// What [`Job::setting`](crate::Job::setting) says.
    pub setting: &'a str,
}

/// How much of a scene's settings counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tuning {
    /// All of it but the stiffness of contacts, as far as an engine has the like: for timing, so that engines do the
    /// same work. Ours would not hold in their solvers: piles sank to half.
    Scene,
    /// Only how friction and restitution mix: for quality, where each engine shows what it makes of a scene at its own
    /// defaults.
    Own,
}

/// An engine that scenes can be built in and stepped.
pub trait Engine: Subject + Sized {
    /// An empty world.
    ///
    /// # Errors
    /// A setting that the engine does not know or that the machine lacks, a build that must not be
    /// measured.
    fn create(setup: &Setup<'_>) -> Result<Self, String>;

    /// What of a scene the engine cannot express, in words.
    fn lacks(_scene: &Scene) -> Option<String> {
        None
    }

    /// The whole world as bytes; `None` where the engine or this build has no such thing.
    fn save(&self) -> Option<Vec<u8>> {
        None
    }

    /// Goes back to saved bytes.
    ///
    /// # Errors
    /// The engine cannot, or refuses the bytes.
    fn restore(&mut self, _bytes: &[u8]) -> Result<(), String> {
        Err("this engine or build cannot restore a world".into())
    }

    /// Time to copy the world into another that has the memory already, milliseconds.
    fn clone_ms(&self) -> Option<f64> {
        None
    }

    /// The world now.
    fn summary(&self) -> Summary;

    /// Engine and version.
    fn name() -> String;

    /// How it was compiled, in words.
    fn build(&self) -> String;
}

/// Figures of a world that show whether two engines simulated the same thing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Bodies of all kinds.
    pub bodies: usize,
    /// Joints.
    pub joints: usize,
    /// Pairs of shapes with at least one contact point.
    pub contacts: usize,
    /// Depth of the deepest of their points, metres; 0 where nothing overlaps. An engine that keeps a
    /// contact as it was, because its bodies hardly moved, tells the depth of then.
    pub overlap: f64,
    /// Dynamic bodies that are awake.
    pub awake: usize,
    /// Mean height of the centres of mass of the dynamic bodies, metres.
    pub height: f64,
    /// Kinetic energy of the dynamic bodies, joules, turning included.
    pub energy: f64,
}

impl Summary {
    /// Adds up the dynamic bodies of a world; what is known of contacts and joints stays 0.
    pub fn of_bodies(bodies: impl Iterator<Item = BodyState>) -> Self {
        let mut sum = Self::default();
        let mut dynamic_count = 0_usize;
        for body in bodies {
            sum.bodies += 1;
            if !body.dynamic {
                continue;
            }
            dynamic_count += 1;
            sum.awake += usize::from(body.awake);
            sum.height += body.height;
            sum.energy += 0.5 * (body.mass * body.speed_sq + body.inertia * body.spin * body.spin);
        }
        sum.height /= dynamic_count.max(1) as f64;
        sum
    }
}

/// What [`Summary::of_bodies`] wants to know about a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyState {
    /// Is it moved by forces?
    pub dynamic: bool,
    /// Is it awake?
    pub awake: bool,
    /// Height of the centre of mass, metres.
    pub height: f64,
    /// Kilograms.
    pub mass: f64,
    /// About the centre of mass, kilograms square metre.
    pub inertia: f64,
    /// Square of the speed of the centre of mass, m2/s2.
    pub speed_sq: f64,
    /// Radians a second.
    pub spin: f64,
}
