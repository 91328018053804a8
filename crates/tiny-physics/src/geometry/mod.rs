//! Shapes and everything that can be computed about them without knowing bodies.
//!
//! Above [`math`](crate::math), below the dynamics: mass properties, bounding boxes, ray casts,
//! distance, time of impact and contact manifolds of pairs of shapes. Shapes stay in frames of their
//! own or of one another, so 32 bits hold every coordinate.

mod bounds;
mod hull;
mod mass;
mod polygon;
mod rounded_core;
mod shape;

pub use mass::MassProperties;
pub use polygon::{MAX_VERTICES, Polygon};
pub use rounded_core::Core;
pub use shape::{MAX_EXTENT, MIN_EXTENT, Shape};
