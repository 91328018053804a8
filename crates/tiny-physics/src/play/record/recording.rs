//! The recorded run: a value, and bytes.

use super::Command;
use crate::codec::{Data, Reader, Sink, bad, data};
use crate::{Error, World};

/// The first bytes of a recording; its version follows.
const MAGIC: [u8; 3] = *b"tpr";
/// Goes up whenever the bytes of a recording change their meaning. Version 1 had fewer commands, version 2 padded
/// options.
const VERSION: u8 = b'5';

/// One step of a recording.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Step {
    /// What was done before it.
    pub(super) commands: Vec<Command>,
    pub(super) dt: f32,
    /// State hash after it.
    pub(super) hash: u64,
}

data!(Step { commands, dt, hash });

impl Step {
    /// Does it to a world; false where that is looked at and does not end as it was recorded.
    pub(super) fn play(&self, world: &mut World, looked_at: bool) -> Result<bool, Error> {
        for command in &self.commands {
            command.apply(world)?;
        }
        // A step that is refused changes nothing, so it finds nothing anew of what frames leave out.
        let made = world.try_step(self.dt).is_ok();
        Ok(!(looked_at && made) || world.state_hash() == self.hash)
    }

    /// About how much memory it takes: what its commands point to is as long as their bytes.
    pub(super) fn rough_bytes(&self) -> usize {
        let mut sink = Sink::new();
        self.commands.save(&mut sink);
        size_of::<Self>() + size_of_val(&*self.commands) + sink.bytes().len()
    }
}

/// A run: its first frame and what was done in each step.
///
/// With the feature `serde` it can be part of other files, as one string of bytes: those of
/// [`Recording::to_bytes`], in base64 where the format is text.
#[derive(Clone, PartialEq, Debug)]
pub struct Recording {
    pub(super) first: Vec<u8>,
    pub(super) steps: Vec<Step>,
}

impl Recording {
    /// Steps in it.
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Is there no step?
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// The state hash after a step, counted from 1.
    pub fn hash(&self, step: usize) -> Option<u64> {
        self.steps.get(step.checked_sub(1)?).map(|step| step.hash)
    }

    /// The length of a step, counted from 1, seconds.
    pub fn dt(&self, step: usize) -> Option<f32> {
        self.steps.get(step.checked_sub(1)?).map(|step| step.dt)
    }

    /// What was done before a step, counted from 1, in order.
    pub fn commands(&self, step: usize) -> &[Command] {
        step.checked_sub(1).and_then(|at| self.steps.get(at)).map_or(&[], |step| &step.commands)
    }

    /// As bytes for a file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut sink = Sink::new();
        sink.put(MAGIC);
        sink.put([VERSION]);
        self.first.save(&mut sink);
        self.steps.save(&mut sink);
        sink.bytes()
    }

    /// The recording of [`Recording::to_bytes`].
    ///
    /// # Errors
    /// The bytes are no recording, or a damaged one, or it or its first frame is of another version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        let mut reader = Reader(bytes);
        if <[u8; 3]>::load(&mut reader)? != MAGIC {
            return Err(bad("it does not begin like a recording"));
        }
        if u8::load(&mut reader)? != VERSION {
            return Err(bad("the recording was written by another version of the engine"));
        }
        let recording = Self { first: Data::load(&mut reader)?, steps: Data::load(&mut reader)? };
        reader.finish()?;
        World::from_bytes(&recording.first).map(|_| recording)
    }

    /// The first step, counted from 1, after which two recordings differ in state; the first that only one has;
    /// `None` where they are alike. 0 is the first frame.
    pub fn first_difference(&self, other: &Self) -> Option<usize> {
        if self.first != other.first {
            return Some(0);
        }
        let steps = self.steps.iter().zip(&other.steps);
        let unlike = steps.map(|(a, b)| a.hash != b.hash).position(|unlike| unlike);
        let shorter = self.len().min(other.len());
        unlike.or((self.len() != other.len()).then_some(shorter)).map(|index| index + 1)
    }
}

#[cfg(feature = "serde")]
mod files {
    use super::Recording;
    use crate::codec::packed;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    impl Serialize for Recording {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            packed::serialize(&self.to_bytes(), serializer)
        }
    }

    impl<'de> Deserialize<'de> for Recording {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            packed::deserialize(deserializer, "a recording", Self::from_bytes)
        }
    }
}
