//! Vectors, rotations, transforms, boxes, and trigonometry that gives the same bits on every platform.
//!
//! The lowest layer: it knows nothing of shapes or bodies. Everything here is built from `+ - * /`,
//! `sqrt` and comparisons, which IEEE 754 fixes to the last bit.

mod aabb;
mod convert;
mod dvec2;
mod rot;
mod sort;
mod transform;
mod trig;
mod vec2;
mod vector;

pub use aabb::Aabb;
pub use dvec2::DVec2;
pub use rot::Rot;
pub(crate) use sort::sort_by_number;
pub use transform::{Pose, Transform};
pub use trig::{atan2, cos, sin, sin_cos};
pub use vec2::Vec2;
