//! What plays.

use super::Recording;
use crate::{Error, World};

/// Plays a recording.
#[derive(Clone, Debug)]
pub struct Player<'a> {
    recording: &'a Recording,
    world: World,
    at: usize,
}

impl<'a> Player<'a> {
    /// Begins at the first frame.
    ///
    /// # Errors
    /// The first frame cannot be read.
    pub fn new(recording: &'a Recording) -> Result<Self, Error> {
        Ok(Self { recording, world: World::from_bytes(&recording.first)?, at: 0 })
    }

    /// The same in a world that has the hooks which the recorded one had, or threads and a SIMD level of your choice.
    /// Nothing else of it is kept.
    ///
    /// # Errors
    /// The first frame cannot be read.
    pub fn in_world(recording: &'a Recording, world: World) -> Result<Self, Error> {
        let mut player = Self { recording, world, at: 0 };
        player.begin_anew().map(|()| player)
    }

    /// Goes to the first frame in a new world, not in place: handles have to come out as they did.
    fn begin_anew(&mut self) -> Result<(), Error> {
        let mut world = World::from_bytes(&self.recording.first)?;
        world.take_equipment(&mut self.world);
        (self.world, self.at) = (world, 0);
        Ok(())
    }

    /// The world as of the current step.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Steps played.
    pub fn at(&self) -> usize {
        self.at
    }

    /// Plays one step; false at the end.
    ///
    /// # Errors
    /// [`Error::Differs`] when the state is not the one that was recorded; or a command is refused that was not.
    pub fn step(&mut self) -> Result<bool, Error> {
        let Some(step) = self.recording.steps.get(self.at) else { return Ok(false) };
        self.at += 1;
        step.play(&mut self.world, true)?.then_some(true).ok_or(Error::Differs { step: self.at })
    }

    /// Goes to the state after that many steps, at most to the end. Going back starts from the first frame.
    ///
    /// # Errors
    /// As [`Player::step`].
    pub fn seek(&mut self, step: usize) -> Result<(), Error> {
        if step < self.at {
            self.begin_anew()?;
        }
        while self.at < step && self.step()? {}
        Ok(())
    }
}
