//! Recordings: the first frame of a run and every command since, so that the run can be played again, bit for
//! bit, on any platform.
//!
//! Send what changes the world through a [`Recorder`] as [`Command`]s. A [`Recording`] also keeps the state hash
//! of every step, so that a playback that differs, by another version of the engine or by a change that went past
//! the recorder, is found at the first step and not believed.
//!
//! ```
//! use tiny_physics::record::{BodyCommand, Command, Made, Player, Recorder, Recording};
//! use tiny_physics::{RigidBody, Shape, Vec2, World};
//! # fn main() -> Result<(), tiny_physics::Error> {
//! let mut recorder = Recorder::new(World::new(Vec2::new(0.0, -9.8)));
//! let ball = RigidBody::new(Shape::circle(0.5)?, Vec2::ZERO, 1.0);
//! let Made::Body(ball) = recorder.apply(Command::AddBody(ball))? else { unreachable!() };
//! recorder.apply(Command::Body(ball, BodyCommand::SetVelocity(Vec2::X)))?;
//! (0..60).for_each(|_| recorder.step(1.0 / 60.0));
//! let bytes = recorder.recording().to_bytes();
//!
//! let recording = Recording::from_bytes(&bytes)?;
//! let mut player = Player::new(&recording)?;
//! player.seek(60)?;
//! assert_eq!(player.world().state_hash(), recorder.world().state_hash());
//! # Ok(())
//! # }
//! ```
//!
//! A [`History`] is a recording that one can go back in, and on from there.
//!
//! # What has a command
//!
//! Every function that changes the state of a world, and its two public fields: a test reads the sources and fails
//! where one is missing. Going back to a frame is [`Command::RestoreBytes`]. A character is a value beside the world:
//! [`Command::MoveCharacter`] holds it whole, moves it, and gives it back.
//!
//! Code has none. Pair filters and pre-solve hooks must be set before the recording begins, and on the world of
//! [`Player::in_world`]; a predicate of a query filter is refused by [`FilterData`]. Threads and the SIMD level
//! change no results.

mod change;
mod command;
mod declare;
mod delta;
mod history;
mod made;
mod player;
mod recorder;
mod recording;
#[cfg(test)]
mod tests;

pub use change::{BodyCommand, ShapeCommand};
pub use command::{Command, FilterData};
pub use history::History;
pub use made::Made;
pub use player::Player;
pub use recorder::Recorder;
pub use recording::Recording;
