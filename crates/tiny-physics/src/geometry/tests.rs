//! Shapes at random and their outlines, for the tests of this layer.

use super::{Polygon, Shape};
use crate::math::{Rot, Transform, Vec2};
use proptest::prelude::*;

/// A vector with both parts within the range.
pub(crate) fn any_vec(range: f32) -> impl Strategy<Value = Vec2> {
    (-range..range, -range..range).prop_map(Vec2::from)
}

/// A frame with its origin within the range.
pub(crate) fn any_frame(range: f32) -> impl Strategy<Value = Transform> {
    (any_vec(range), -4.0_f32..4.0).prop_map(|(p, angle)| Transform::from_angle(p, angle))
}

/// A convex polygon within 1 m of the origin, half of them rounded.
pub(crate) fn any_polygon() -> impl Strategy<Value = Polygon> {
    let points = prop::collection::vec(any_vec(1.0), 3..9);
    let radius = prop_oneof![Just(0.0_f32), 0.01_f32..0.5];
    (points, radius).prop_filter_map("flat", |(points, radius)| {
        Polygon::hull(&points).and_then(|polygon| polygon.rounded(radius)).ok()
    })
}

/// Any kind of shape, about 1 m large.
pub(crate) fn any_shape() -> impl Strategy<Value = Shape> {
    prop_oneof![
        (0.05_f32..1.0).prop_map(|radius| Shape::Circle { radius }),
        (0.05_f32..1.0, 0.05_f32..1.0)
            .prop_map(|(x, y)| Shape::Aabb { half_extents: Vec2::new(x, y) }),
        (any_vec(1.0), any_vec(1.0), 0.05_f32..0.5)
            .prop_filter_map("short", |(a, b, radius)| { Shape::capsule(a, b, radius).ok() }),
        (any_vec(1.0), any_vec(1.0)).prop_filter_map("short", |(a, b)| Shape::segment(a, b).ok()),
        any_polygon().prop_map(Shape::from),
    ]
}

/// About `count` points on the surface of a shape, closely spaced (edges and corner arcs).
pub(super) fn boundary(shape: &Shape, count: usize) -> Vec<Vec2> {
    let core = shape.core();
    let per_piece = count / (2 * core.count);
    let mut points = Vec::new();
    for i in 0..core.edge_count() {
        let (start, end) = core.edge(i);
        let shift = core.normal(i) * core.radius;
        points
            .extend((0..=per_piece).map(|k| start.lerp(end, k as f32 / per_piece as f32) + shift));
    }
    for corner in core.points() {
        // Whole circles: what lies inside the shape is sorted out below.
        for k in 0..4 * per_piece {
            let angle = k as f32 * core::f32::consts::TAU / (4 * per_piece) as f32;
            points.push(*corner + Rot::from_angle(angle).x_axis() * core.radius);
        }
    }
    points.retain(|p| (*p - core.closest_point(*p)).length() >= core.radius * 0.99999 - 1e-6);
    points
}
