//! Axis-aligned boxes around shapes.

use super::Shape;
use crate::math::{Aabb, DVec2, Pose, Rot, Transform, Vec2};

impl Shape {
    /// Box around the shape seen from the parent frame, rounded to nearest.
    pub fn aabb(&self, frame: Transform) -> Aabb {
        let (core, radius) = self.turned_core_box(frame.q);
        let reach = Vec2::splat(radius);
        Aabb::new(frame.p + core.min - reach, frame.p + core.max + reach)
    }

    /// Box around the shape in the world, rounded outwards from 64 bits.
    pub fn world_aabb(&self, pose: Pose) -> Aabb {
        let (core, radius) = self.turned_core_box(pose.q);
        let reach = f64::from(radius);
        let reach = DVec2::new(reach, reach);
        Aabb::rounded_out(pose.p + core.min - reach, pose.p + core.max + reach)
    }

    /// Box around the turned core, relative to the frame's origin, and the radius to add.
    #[inline]
    fn turned_core_box(&self, q: Rot) -> (Aabb, f32) {
        match self {
            Self::Circle { radius } => (Aabb::new(Vec2::ZERO, Vec2::ZERO), *radius),
            Self::Aabb { half_extents } => {
                let (c, s) = (q.c.abs(), q.s.abs());
                let half = Vec2::new(
                    c * half_extents.x + s * half_extents.y,
                    s * half_extents.x + c * half_extents.y,
                );
                (Aabb::new(-half, half), 0.0)
            }
            Self::Capsule { a, b, radius } => (turned_box(&[*a, *b], q), *radius),
            Self::Segment { a, b } => (turned_box(&[*a, *b], q), 0.0),
            Self::Polygon(polygon) => (turned_box(polygon.vertices(), q), polygon.radius()),
        }
    }
}

#[inline]
fn turned_box(points: &[Vec2], q: Rot) -> Aabb {
    let mut bounds = Aabb::EMPTY;
    for point in points {
        let turned = q.rotate(*point);
        bounds = Aabb::new(bounds.min.min(turned), bounds.max.max(turned));
    }
    bounds
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_fit_tightly() {
        let at = |x, y, angle| Transform::from_angle(Vec2::new(x, y), angle);
        let circle = Shape::circle(0.5).unwrap().aabb(at(1.0, 2.0, 0.3));
        assert_eq!(circle, Aabb::from_center(Vec2::new(1.0, 2.0), Vec2::splat(0.5)));
        let capsule = Shape::capsule(-Vec2::X, Vec2::X, 0.25).unwrap();
        assert_eq!(capsule.aabb(at(0.0, 0.0, 0.0)).half_extents(), Vec2::new(1.25, 0.25));
        let quarter = at(0.0, 0.0, core::f32::consts::FRAC_PI_2);
        for shape in [Shape::rect(1.0, 2.0).unwrap(), Shape::aabb_box(Vec2::new(1.0, 2.0)).unwrap()]
        {
            let half = shape.aabb(quarter).half_extents();
            assert!((half - Vec2::new(2.0, 1.0)).length() < 1e-6);
        }
    }

    #[test]
    fn world_boxes_lose_nothing_far_away() {
        let circle = Shape::circle(0.3).unwrap();
        for k in 0..100 {
            let p = DVec2::new(1.0e6 + f64::from(k) * 0.013, -3.0e5 - f64::from(k) * 0.77);
            let bounds = circle.world_aabb(Pose::new(p, Rot::IDENTITY));
            assert!(f64::from(bounds.min.x) <= p.x - 0.3 && f64::from(bounds.min.y) <= p.y - 0.3);
            assert!(f64::from(bounds.max.x) >= p.x + 0.3 && f64::from(bounds.max.y) >= p.y + 0.3);
        }
    }
}
