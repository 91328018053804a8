//! *Fuse*, a small game: its rules, without a window. `main.rs` shows it.

pub mod barrel;
pub mod game;
pub mod level;
pub mod moving;
pub mod pieces;
pub mod sounds;
