//! Shapes with known sizes, for builders.

use tiny_physics::{Polygon, Shape, Vec2};

/// A box by its half extents.
pub(crate) fn rect(half_width: f32, half_height: f32) -> Shape {
    Polygon::rect(half_width, half_height).expect("scenes use boxes of a positive size").into()
}

/// A box by the half extents of its core, rounded outwards.
pub(crate) fn rounded_rect(half_width: f32, half_height: f32, radius: f32) -> Shape {
    Polygon::rect(half_width, half_height)
        .and_then(|polygon| polygon.rounded(radius))
        .expect("scenes use boxes of a positive size")
        .into()
}

/// A convex polygon, rounded outwards.
pub(crate) fn hull(points: &[Vec2], radius: f32) -> Shape {
    Polygon::hull(points)
        .and_then(|polygon| polygon.rounded(radius))
        .expect("scenes use points that make a convex polygon")
        .into()
}

/// A disk.
pub(crate) fn circle(radius: f32) -> Shape {
    Shape::Circle { radius }
}
