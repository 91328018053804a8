//! tiny-physics.
pub mod broad_phase;
mod codec;
mod debug_draw;
mod describe;
mod dynamics;
mod error;
mod fixed_step;
pub mod geometry;
pub mod math;
mod simd;
mod stages;
mod threads;
mod world;

pub use debug_draw::{
    Color, DEPTH_SCALE, DebugDraw, DebugDrawOptions, Layer, Palette, depth_color, draw_bounds,
    draw_shape,
};
pub use describe::*;
pub use error::Error;
pub use fixed_step::FixedStep;
pub use geometry::{Contact, Manifold, ManifoldPoint, collide, contact};
pub use geometry::{Polygon, Shape};
pub use math::{Aabb, DVec2, Pose, Rot, Transform, Vec2};
pub use simd::SimdLevel;
pub use world::*;
