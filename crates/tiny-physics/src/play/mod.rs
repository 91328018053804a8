//! What stands on the world's public API alone: a character, forces, drawing, recording, outlines, a clock.
//!
//! The top layer: nothing below knows it, and it knows nothing of the inside. Whoever wants another character or
//! another wind can copy a file from here into a program of their own; a test reads the sources and fails where that is no
//! longer so. Only what is written to files also uses the engine's own codec.

mod debug_draw;
mod fixed_step;
mod forces;
mod mover;
mod outlines;
pub mod record;
mod spatial_hash;

pub use debug_draw::{
    Color, DEPTH_SCALE, DebugDraw, DebugDrawOptions, Layer, Palette, depth_color, draw_bounds,
    draw_shape,
};
pub use fixed_step::FixedStep;
pub use forces::{Explosion, ForceZone, Water, Wind, ZoneForce};
pub use mover::{CharacterMover, MoverGround, MoverHit, MoverInput};
pub use spatial_hash::SpatialHash;
