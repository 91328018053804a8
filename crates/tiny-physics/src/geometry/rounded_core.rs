//! The one form behind all shapes: a few points and a radius around their hull.

use super::edges::{box_corners, edge_normal};
use super::polygon::MAX_VERTICES;
use super::{Polygon, Shape};
use crate::math::{Transform, Vec2};

/// A shape as the points within `radius` of the convex hull of up to eight points.
///
/// A circle has one point, a capsule or segment two, a box four, a polygon its vertices. Three and more
/// go round anticlockwise. Ray casts, distance, time of impact and mass work on this form alone.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Core {
    /// The points; those from `count` on are zero.
    pub points: [Vec2; MAX_VERTICES],
    /// How many points there are, 1 to 8.
    pub count: usize,
    /// Distance of the surface from the hull of the points, metres, 0 or above.
    pub radius: f32,
}

impl Core {
    pub(crate) fn new(points: &[Vec2], radius: f32) -> Self {
        debug_assert!((1..=MAX_VERTICES).contains(&points.len()));
        let mut core = Self { points: [Vec2::ZERO; MAX_VERTICES], count: points.len(), radius };
        core.points[..points.len()].copy_from_slice(points);
        core
    }

    /// The points in use.
    #[inline]
    pub fn points(&self) -> &[Vec2] {
        &self.points[..self.count]
    }

    /// The same core seen from the parent frame.
    #[inline]
    pub fn transformed(&self, frame: Transform) -> Self {
        let mut moved = *self;
        for point in &mut moved.points[..self.count] {
            *point = frame.apply(*point);
        }
        moved
    }

    /// Index of the point farthest along `direction`; the first of equals.
    #[inline]
    pub fn support(&self, direction: Vec2) -> usize {
        let mut best = 0;
        let mut best_value = self.points[0].dot(direction);
        for (i, point) in self.points().iter().enumerate().skip(1) {
            let value = point.dot(direction);
            if value > best_value {
                (best, best_value) = (i, value);
            }
        }
        best
    }

    /// Number of edges: none for a circle; two, there and back, for a capsule or segment.
    #[inline]
    pub fn edge_count(&self) -> usize {
        if self.count < 2 { 0 } else { self.count }
    }

    /// Edge `i` from its start to its end; the outside is on its right.
    #[inline]
    pub fn edge(&self, i: usize) -> (Vec2, Vec2) {
        let next = if i + 1 < self.count { i + 1 } else { 0 };
        (self.points[i], self.points[next])
    }

    /// Outward unit normal of edge `i`.
    #[inline]
    pub fn normal(&self, i: usize) -> Vec2 {
        let (start, end) = self.edge(i);
        edge_normal(start, end)
    }

    /// Greatest distance of a core point from `center`, metres; the radius is not in it.
    #[inline]
    pub fn reach(&self, center: Vec2) -> f32 {
        let mut reach_sq = 0.0;
        for point in self.points() {
            let distance_sq = (*point - center).length_sq();
            if distance_sq > reach_sq {
                reach_sq = distance_sq;
            }
        }
        reach_sq.sqrt()
    }
}

impl From<&Polygon> for Core {
    fn from(polygon: &Polygon) -> Self {
        Self::new(polygon.vertices(), polygon.radius())
    }
}

impl Shape {
    /// This shape as points and radius, in its own frame.
    #[inline]
    pub fn core(&self) -> Core {
        match self {
            Self::Circle { radius } => Core::new(&[Vec2::ZERO], *radius),
            Self::Aabb { half_extents } => Core::new(&box_corners(*half_extents), 0.0),
            Self::Capsule { a, b, radius } => Core::new(&[*a, *b], *radius),
            Self::Segment { a, b } => Core::new(&[*a, *b], 0.0),
            Self::Polygon(polygon) => Core::from(polygon),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shape_has_its_core() {
        let (a, b) = (Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.0));
        assert_eq!(Shape::circle(2.0).unwrap().core(), Core::new(&[Vec2::ZERO], 2.0));
        assert_eq!(Shape::capsule(a, b, 0.5).unwrap().core(), Core::new(&[a, b], 0.5));
        assert_eq!(Shape::segment(a, b).unwrap().core(), Core::new(&[a, b], 0.0));
        let half = Vec2::new(1.0, 2.0);
        let aabb = Shape::aabb_box(half).unwrap().core();
        assert_eq!(aabb, Shape::rect(1.0, 2.0).unwrap().core());
        assert_eq!(aabb.points()[0], -half);
        assert_eq!(aabb.reach(Vec2::ZERO), half.length());
    }

    #[test]
    fn edges_look_outwards() {
        let core = Shape::rect(1.0, 2.0).unwrap().core();
        let normals: Vec<_> = (0..4).map(|i| core.normal(i)).collect();
        assert_eq!(normals, [-Vec2::Y, Vec2::X, Vec2::Y, -Vec2::X]);
        let capsule = Shape::capsule(Vec2::ZERO, Vec2::X, 0.1).unwrap().core();
        assert_eq!((capsule.normal(0), capsule.normal(1)), (-Vec2::Y, Vec2::Y));
        assert_eq!(Shape::circle(1.0).unwrap().core().edge_count(), 0);
        assert_eq!(core.support(Vec2::new(1.0, 1.0)), 2);
    }
}
