//! A game for two over rollback netcode: [`tiny_physics`] under the crate [`ggrs`].
//!
//! It shows what a rollback game needs of a physics engine, and tests that the engine has it: a world that can be
//! saved each frame and put back in place ([`Clone::clone_from`]), handles that stay valid, and the same bits
//! when frames are played again with other inputs.
//!
//! - [`Game`]: the world, two players who run, jump and throw balls, and what of it has to be saved.
//! - [`sync_test`]: every frame goes back 8 frames and plays them again; checksums have to agree.
//! - [`duel`]: two peers over UDP on this machine, with a [`RoughSocket`] that delays, loses and
//!   reorders packets.

mod duel;
mod game;
mod network;
mod sync_test;

pub use duel::{Duel, Peer, Report, duel};
pub use game::{Frame, Game, Input, input_of};
pub use network::{Network, RoughSocket, Traffic};
pub use sync_test::{SyncTest, sync_test};

/// How the sessions of this game are made up.
#[derive(Debug)]
pub struct Config;

impl ggrs::Config for Config {
    type Input = Input;
    type InputPredictor = ggrs::PredictRepeatLast;
    type State = Frame;
    type Address = std::net::SocketAddr;
}

/// Players of the game.
pub const PLAYERS: usize = 2;
/// Frames that a peer plays ahead of what it has heard of the other, at most.
pub const PREDICTION: usize = 8;
