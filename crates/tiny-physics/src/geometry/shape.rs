//! The shapes.

use super::Polygon;
use crate::math::Vec2;

/// A shape in its own frame.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Shape {
    /// A disk around the origin.
    Circle {
        /// Metres, above 0.
        radius: f32,
    },
    /// A box around the origin that never turns: a body that carries one has its rotation locked.
    Aabb {
        /// Half width and half height, metres, above 0.
        half_extents: Vec2,
    },
    /// All points within `radius` of the segment from `a` to `b`.
    Capsule {
        /// One end of the core, metres.
        a: Vec2,
        /// The other end.
        b: Vec2,
        /// Metres, above 0.
        radius: f32,
    },
    /// A line segment without thickness; for static bodies. It has no mass.
    Segment {
        /// One end, metres.
        a: Vec2,
        /// The other end.
        b: Vec2,
    },
    /// A convex polygon.
    Polygon(Polygon),
}

impl From<Polygon> for Shape {
    fn from(polygon: Polygon) -> Self {
        Self::Polygon(polygon)
    }
}
