//! Shapes and everything that can be computed about them without knowing bodies.
//!
//! Above [`math`](crate::math), below the dynamics: mass properties, bounding boxes, ray casts,
//! distance, time of impact and contact manifolds of pairs of shapes.

pub(crate) mod manifold;
mod polygon;
mod shape;
mod temporary;

pub use polygon::Polygon;
pub use shape::Shape;
pub use temporary::MassProperties;
