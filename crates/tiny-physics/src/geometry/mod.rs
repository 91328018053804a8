//! Shapes and everything that can be computed about them without knowing bodies.
//!
//! Above [`math`](crate::math), below the dynamics: mass properties, bounding boxes, ray casts,
//! distance, time of impact and contact manifolds of pairs of shapes.

pub(crate) mod manifold;
mod polygon;
mod shape;

pub use manifold::{Contact, Manifold, ManifoldPoint, collide, contact};
pub use polygon::Polygon;
pub use shape::Shape;
