//! What an agent is to do in a world.

use crate::error::BatchError;
use crate::random::Random;
use serde::Serialize;
use serde::de::DeserializeOwned;
use tiny_physics::{DVec2, World};

/// The form of a task.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spec {
    /// Numbers of an observation.
    pub observation: usize,
    /// Numbers of an action.
    pub action: usize,
    /// `Some`: an action is one whole number from 0 to below this. `None`: numbers from -1 to 1.
    pub choices: Option<u32>,
    /// Steps after which an episode is cut off.
    pub time_limit: u32,
    /// Length of a step, seconds.
    pub dt: f32,
}

/// What came of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Points.
    pub reward: f32,
    /// Has the episode come to its end?
    pub terminated: bool,
}

/// The part of a world that a picture should show: world, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Lower left.
    pub min: DVec2,
    /// Upper right.
    pub max: DVec2,
}

/// A task: what a world starts from, what actions do in it, what is seen of it and what it is worth.
///
/// The task itself is shared by all worlds of a batch and never changes; what differs from world to world is its
/// [`World`] and its [`Task::Episode`].
pub trait Task: Send + Sync {
    /// What an episode has to remember besides its world.
    type Episode: Clone + core::fmt::Debug + Send + Sync + Serialize + DeserializeOwned;

    /// What it is called, with its options: what another task has saved is refused.
    fn title(&self) -> String;

    /// Its form.
    fn spec(&self) -> Spec;

    /// The name of each number of an observation, in order.
    fn names(&self) -> Vec<String>;

    /// A world that [`Task::reset`] can start from.
    fn template(&self) -> &World;

    /// Starts an episode in any world of this task.
    ///
    /// # Errors
    /// The engine's, where the task's own numbers are bad.
    fn reset(&self, world: &mut World, random: &mut Random) -> Result<Self::Episode, BatchError>;

    /// Does an action and moves the world on.
    ///
    /// # Errors
    /// The engine's, where the task's own numbers are bad.
    fn step(
        &self,
        world: &mut World,
        episode: &mut Self::Episode,
        random: &mut Random,
        action: &[f32],
    ) -> Result<Outcome, BatchError>;

    /// Writes the observation.
    fn observe(&self, world: &World, episode: &Self::Episode, out: &mut [f32]);

    /// What to show.
    fn view(&self, world: &World, episode: &Self::Episode) -> View;
}
