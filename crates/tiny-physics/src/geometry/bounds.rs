//! Axis-aligned boxes and circles around and inside shapes.

use super::Shape;
use super::edges::least_by;
use crate::math::{Aabb, DVec2, Pose, Rot, Transform, Vec2};

impl Shape {
    /// Box around the shape seen from the parent frame, rounded to nearest.
    pub fn aabb(&self, frame: Transform) -> Aabb {
        let core = self.core();
        let (turned, reach) = (turned_box(core.points(), frame.q), Vec2::splat(core.radius));
        Aabb::new(frame.p + turned.min - reach, frame.p + turned.max + reach)
    }

    /// Box around the shape in the world, rounded outwards from 64 bits.
    pub fn world_aabb(&self, pose: Pose) -> Aabb {
        let core = self.core();
        let (turned, radius) = (turned_box(core.points(), pose.q), f64::from(core.radius));
        let reach = DVec2::new(radius, radius);
        Aabb::rounded_out(pose.p + turned.min - reach, pose.p + turned.max + reach)
    }

    /// Radius of the circle around the frame's origin that holds the shape, metres.
    pub fn bounding_radius(&self) -> f32 {
        let core = self.core();
        core.reach(Vec2::ZERO) + core.radius
    }

    /// Radius of the disk around the centre of mass that fits inside, metres: half of the shape's thickness,
    /// more or less. A body that moves less in a step cannot pass a wall by its centre. 0 for a segment.
    pub fn inner_radius(&self) -> f32 {
        let core = self.core();
        if core.count < 3 {
            return core.radius;
        }
        let center = self.mass_properties(1.0).center;
        let depth = |i: usize| core.normal(i).dot(core.points[i] - center);
        least_by(core.edge_count(), depth).1 + core.radius
    }
}

/// Box around turned points.
#[inline]
pub(crate) fn turned_box(points: &[Vec2], q: Rot) -> Aabb {
    // Four largest values are one instruction; two of them with two smallest are ten.
    let mut most = [f32::NEG_INFINITY; 4];
    for point in points {
        let Vec2 { x, y } = q.rotate(*point);
        let values = [-x, -y, x, y];
        most = core::array::from_fn(|k| if most[k] > values[k] { most[k] } else { values[k] });
    }
    Aabb::new(Vec2::new(-most[0], -most[1]), Vec2::new(most[2], most[3]))
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
    fn circles_inside_and_around() {
        let close = |a: f32, b: f32| (a - b).abs() < 1e-6;
        let capsule = Shape::capsule(Vec2::ZERO, Vec2::X * 2.0, 0.25).unwrap();
        assert!(close(capsule.bounding_radius(), 2.25) && close(capsule.inner_radius(), 0.25));
        let rect = Shape::rect(3.0, 4.0).unwrap();
        assert!(close(rect.bounding_radius(), 5.0) && close(rect.inner_radius(), 3.0));
        let circle = Shape::circle(0.5).unwrap();
        assert!(close(circle.bounding_radius(), 0.5) && close(circle.inner_radius(), 0.5));
        let segment = Shape::segment(Vec2::ZERO, Vec2::X).unwrap();
        assert!(close(segment.bounding_radius(), 1.0) && close(segment.inner_radius(), 0.0));
        let triangle = Shape::regular(3, 1.0).unwrap();
        assert!(close(triangle.inner_radius(), 0.5));
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
