//! Points and shapes: is one inside, and which point of the shape is closest (Ericson, "Real-Time Collision
//! Detection", 2005, section 5.1).

use super::{Core, Shape};
use crate::math::Vec2;

impl Shape {
    /// Is the point inside or on the surface? `point` in the shape's frame, metres.
    pub fn contains(&self, point: Vec2) -> bool {
        self.core().contains(point)
    }

    /// The point of the shape closest to `point`, which is `point` itself where that is inside. Both in the
    /// shape's frame, metres.
    pub fn closest_point(&self, point: Vec2) -> Vec2 {
        let core = self.core();
        let on_core = core.closest_point(point);
        let (direction, distance) = (point - on_core).direction_and_length();
        if distance <= core.radius { point } else { on_core + direction * core.radius }
    }
}

impl Core {
    /// Is the point within the radius of the core, surface included?
    pub(crate) fn contains(&self, point: Vec2) -> bool {
        (point - self.closest_point(point)).length_sq() <= self.radius * self.radius
    }

    /// The closest point of the hull of the core points, without the radius.
    pub(crate) fn closest_point(&self, point: Vec2) -> Vec2 {
        if self.count >= 3 && self.hull_contains(point) {
            return point;
        }
        let mut closest = self.points[0];
        let mut closest_sq = (point - closest).length_sq();
        for i in 0..self.edge_count() {
            let (start, end) = self.edge(i);
            let candidate = start + (end - start) * segment_fraction(start, end, point);
            let distance_sq = (point - candidate).length_sq();
            if distance_sq < closest_sq {
                (closest, closest_sq) = (candidate, distance_sq);
            }
        }
        closest
    }

    fn hull_contains(&self, point: Vec2) -> bool {
        (0..self.count).all(|i| {
            let (start, end) = self.edge(i);
            (end - start).cross(point - start) >= 0.0
        })
    }
}

/// How far along the segment, 0 to 1, its closest point to `point` is.
#[inline]
pub(crate) fn segment_fraction(start: Vec2, end: Vec2, point: Vec2) -> f32 {
    let edge = end - start;
    let (along, length_sq) = ((point - start).dot(edge), edge.length_sq());
    if along <= 0.0 {
        0.0
    } else if along >= length_sq {
        1.0
    } else {
        along / length_sq
    }
}

#[cfg(test)]
mod tests {
    use super::super::Polygon;
    use super::super::tests::{any_shape, boundary};
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn inside_outside_and_on_the_edge() {
        let rect = Shape::rect(1.0, 0.5).unwrap();
        assert!(rect.contains(Vec2::ZERO) && rect.contains(Vec2::new(1.0, 0.5)));
        assert!(!rect.contains(Vec2::new(1.001, 0.0)));
        assert_eq!(rect.closest_point(Vec2::new(3.0, 0.25)), Vec2::new(1.0, 0.25));
        assert_eq!(rect.closest_point(Vec2::new(0.2, 0.1)), Vec2::new(0.2, 0.1));
        let rounded = Shape::from(Polygon::rect(1.0, 0.5).unwrap().rounded(0.5).unwrap());
        assert!(!rounded.contains(Vec2::new(1.49, 0.99)));
        assert!(rounded.contains(Vec2::new(1.5, 0.5)));
        assert_eq!(rounded.closest_point(Vec2::new(3.0, 0.0)), Vec2::new(1.5, 0.0));
        let circle = Shape::circle(1.0).unwrap();
        assert_eq!(circle.closest_point(Vec2::ZERO), Vec2::ZERO);
        let segment = Shape::segment(Vec2::ZERO, Vec2::X).unwrap();
        assert!(segment.contains(Vec2::new(0.5, 0.0)) && !segment.contains(Vec2::new(0.5, 1e-6)));
    }

    proptest! {
        #[test]
        fn closest_points_beat_sampled_ones(
            shape in any_shape(),
            x in -4.0_f32..4.0,
            y in -4.0_f32..4.0,
        ) {
            let point = Vec2::new(x, y);
            let closest = shape.closest_point(point);
            let distance = closest.distance(point);
            if shape.contains(point) {
                prop_assert_eq!(closest, point);
            } else {
                let sampled = boundary(&shape, 400)
                    .into_iter()
                    .map(|p| p.distance(point))
                    .fold(f32::INFINITY, f32::min);
                prop_assert!(distance <= sampled + 1e-5, "{distance} {sampled}");
                prop_assert!(distance >= sampled - 0.05, "{distance} {sampled}");
            }
        }
    }
}
