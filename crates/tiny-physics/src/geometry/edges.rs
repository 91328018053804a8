//! Edges and corners of what goes round anticlockwise.

use crate::math::Vec2;

/// Unit normal to the right of the edge; exact for edges along an axis. Zero for an edge without length.
#[inline]
pub(super) fn edge_normal(start: Vec2, end: Vec2) -> Vec2 {
    let edge = end - start;
    let length = edge.length();
    // 0 - x, not -x: no negative zero.
    if length > 0.0 { Vec2::new(edge.y, 0.0 - edge.x) / length } else { Vec2::ZERO }
}

/// The four corners of a box around the origin, anticlockwise from the lower left.
#[inline]
pub(super) fn box_corners(half: Vec2) -> [Vec2; 4] {
    [-half, Vec2::new(half.x, -half.y), half, Vec2::new(-half.x, half.y)]
}
