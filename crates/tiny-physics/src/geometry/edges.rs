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

/// The first of so many indices for which `key` is least, and the key; 0 and infinity where there is none.
#[inline]
pub(crate) fn least_by(count: usize, key: impl Fn(usize) -> f32) -> (usize, f32) {
    let mut least = (0, f32::INFINITY);
    for i in 0..count {
        let key = key(i);
        if key < least.1 {
            least = (i, key);
        }
    }
    least
}
