//! What the glue of several engines wants to know about shapes.

use tiny_physics::Vec2;

/// Half extents, if the polygon is a box around the origin along the axes: engines have a way of their own to make those.
pub fn centered_box(vertices: &[Vec2]) -> Option<Vec2> {
    let half = vertices.first()?.abs();
    let is_box = vertices.len() == 4 && vertices.iter().all(|v| v.abs() == half);
    is_box.then_some(half)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_are_recognised() {
        let v = |x, y| Vec2::new(x, y);
        let square = [v(-1.0, -2.0), v(1.0, -2.0), v(1.0, 2.0), v(-1.0, 2.0)];
        assert_eq!(centered_box(&square), Some(v(1.0, 2.0)));
        assert_eq!(centered_box(&[v(0.0, -1.0), v(2.0, -1.0), v(2.0, 1.0), v(0.0, 1.0)]), None);
        assert_eq!(centered_box(&square[..3]), None);
    }
}
