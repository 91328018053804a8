//! What the demos share: a window, a camera, a brush, and pictures of a run for the documentation.

mod brush;
mod picture;
mod stage;

pub use brush::{Brush, Ink, PALETTE};
pub use stage::{Camera, Cursor, Demo};

/// The example of the README is built.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
