//! What records.

use super::recording::Step;
use super::{Command, Made, Recording};
use crate::{Error, World};

/// Records what is done to a world.
///
/// The world is only to read: what it needs besides commands (hooks, threads, a SIMD level) it gets before.
#[derive(Clone, Debug)]
pub struct Recorder {
    world: World,
    recording: Recording,
    commands: Vec<Command>,
}

impl Recorder {
    /// Starts a recording with the world as it is.
    pub fn new(world: World) -> Self {
        let recording = Recording { first: world.to_bytes(), steps: Vec::new() };
        Self { world, recording, commands: Vec::new() }
    }

    /// The world, to read.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Does something to the world and notes it. What is refused is not noted.
    ///
    /// # Errors
    /// As [`Command::apply`].
    pub fn apply(&mut self, command: Command) -> Result<Made, Error> {
        let made = command.apply(&mut self.world)?;
        self.commands.push(command);
        Ok(made)
    }

    /// Moves the world on and notes it.
    pub fn step(&mut self, dt: f32) {
        self.world.step(dt);
        // No longer than needed, as it stays.
        let commands = self.commands.drain(..).collect();
        self.recording.steps.push(Step { commands, dt, hash: self.world.state_hash() });
    }

    /// What has been recorded so far. Commands since the last step are not in it yet.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// Ends the recording. Commands since the last step have been done to the world, but are not recorded.
    pub fn finish(self) -> (World, Recording) {
        (self.world, self.recording)
    }
}
