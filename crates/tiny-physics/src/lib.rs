//! tiny-physics.
mod describe;
mod error;
pub mod geometry;
pub mod math;
mod simd;
mod threads;

pub use describe::*;
pub use error::Error;
pub use geometry::{Contact, Manifold, ManifoldPoint, collide, contact};
pub use geometry::{Polygon, Shape};
pub use math::{Aabb, DVec2, Pose, Rot, Transform, Vec2};
pub use simd::SimdLevel;
