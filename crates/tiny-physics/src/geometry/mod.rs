//! Shapes and everything that can be computed about them without knowing bodies.
//!
//! Above [`math`](crate::math), below the dynamics: mass properties, bounding boxes, ray casts,
//! distance, time of impact and contact manifolds of pairs of shapes. Shapes stay in frames of their
//! own or of one another, so 32 bits hold every coordinate.

mod bounds;
mod cast;
#[cfg(feature = "serde")]
mod data;
mod distance;
mod edges;
mod hull;
mod limits;
pub(crate) mod manifold;
mod mass;
mod part;
mod point;
mod polygon;
mod ray;
mod rounded_core;
mod saved;
mod shape;
mod sweep;
mod swept_box;
mod toi;

#[cfg(test)]
pub(crate) mod tests;

pub(crate) use bounds::turned_box;
pub use cast::{CastHit, shape_cast};
pub use distance::{Distance, distance};
pub(crate) use edges::least_by;
pub(crate) use limits::check_point;
pub use limits::{MAX_EXTENT, MIN_EXTENT};
pub use manifold::{Contact, Manifold, ManifoldPoint, collide, contact};
pub use mass::MassProperties;
pub use part::AreaPart;
pub(crate) use point::segment_fraction;
pub use polygon::{MAX_VERTICES, Polygon};
pub use ray::{Ray, RayHit};
pub use rounded_core::Core;
pub use shape::Shape;
pub use sweep::Sweep;
pub(crate) use swept_box::SweptBox;
pub use toi::{LINEAR_SLOP, Toi, ToiState, time_of_impact, time_of_impact_to, toi_target};
pub(crate) use toi::{hit_at, impact_within, pass_by, touch_within};
