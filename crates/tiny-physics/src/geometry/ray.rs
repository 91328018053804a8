//! Ray casts, exact for every shape, corner radii included.
//!
//! A sharp polygon clips the ray against its edges (Cyrus and Beck 1978; Ericson 2005, section 5.3.8). A
//! rounded core is the union of its hull, a strip outside every edge and a disk at every point: a ray from
//! outside enters it where it first meets a shifted edge or a disk.

use super::edges::edge_normal;
use super::{Core, Shape};
use crate::math::Vec2;

/// What a hit may be off by, as a part of the numbers that it is calculated from.
const ROUNDING: f32 = 4.0 * f32::EPSILON;
/// Rays are cut off so far out, metres: products with longer ones would not be finite.
const FARTHEST: f32 = 1.0e12;

/// A ray of finite length.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ray {
    /// Where it starts, metres in the frame of the shape.
    pub origin: Vec2,
    /// From its start to its end, metres.
    pub translation: Vec2,
}

/// Where a ray (or a disk moving along it) meets a shape from outside.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RayHit {
    /// Part of the translation until the hit, 0 to 1.
    pub fraction: f32,
    /// Outward unit normal of the surface there, in the frame of the ray.
    pub normal: Vec2,
}

impl Ray {
    /// A ray by its start and the vector to its end.
    #[inline]
    pub const fn new(origin: Vec2, translation: Vec2) -> Self {
        Self { origin, translation }
    }

    /// The point at a fraction of the way.
    #[inline]
    pub fn at(&self, fraction: f32) -> Vec2 {
        self.origin + self.translation * fraction
    }

    fn can_hit(&self) -> bool {
        self.origin.is_finite() && self.translation.is_finite() && self.translation != Vec2::ZERO
    }
}

impl Shape {
    /// Where the ray enters the shape; ray and shape in the shape's frame.
    ///
    /// `None` where it misses, starts inside or on the surface, has no length or is not finite. A segment is
    /// hit from both sides, but not by a ray along it.
    pub fn ray_cast(&self, ray: &Ray) -> Option<RayHit> {
        self.core().ray_cast(ray)
    }

    /// Where a disk of the given radius, its centre moving along the ray, first touches the shape. As
    /// [`Shape::ray_cast`] otherwise: `None` where it overlaps at the start. A negative radius counts as 0.
    pub fn circle_cast(&self, ray: &Ray, radius: f32) -> Option<RayHit> {
        let mut core = self.core();
        if radius > 0.0 {
            core.radius += radius;
        }
        core.ray_cast(ray)
    }
}

impl Core {
    /// See [`Shape::ray_cast`].
    pub(crate) fn ray_cast(&self, ray: &Ray) -> Option<RayHit> {
        let way = ray.translation.abs();
        let length = if way.x < way.y { way.y } else { way.x };
        if !ray.can_hit() || self.contains(ray.origin) {
            None
        } else if length > FARTHEST {
            let part = FARTHEST / length;
            let hit = self.ray_cast(&Ray::new(ray.origin, ray.translation * part))?;
            Some(RayHit { fraction: hit.fraction * part, ..hit })
        } else if self.radius > 0.0 {
            self.cast_rounded(ray)
        } else if self.count >= 3 {
            self.clip(ray)
        } else {
            self.cross_segment(ray)
        }
    }

    fn clip(&self, ray: &Ray) -> Option<RayHit> {
        let (mut enter, mut leave) = (0.0, 1.0);
        let mut face = None;
        for i in 0..self.count {
            let (start, end) = self.edge(i);
            let outward = -(end - start).perp();
            let height = outward.dot(start - ray.origin);
            let speed = outward.dot(ray.translation);
            if speed == 0.0 {
                if height < 0.0 {
                    return None;
                }
            } else if speed < 0.0 {
                if height < enter * speed {
                    (enter, face) = (height / speed, Some(i));
                }
            } else if height < leave * speed {
                leave = height / speed;
            }
            if leave < enter {
                return None;
            }
        }
        face.map(|i| RayHit { fraction: enter, normal: self.normal(i) })
    }

    fn cross_segment(&self, ray: &Ray) -> Option<RayHit> {
        let (start, end) = self.edge(0);
        let hit = cross_edge(ray, start, end, edge_normal(start, end));
        hit.or_else(|| cross_edge(ray, end, start, edge_normal(end, start)))
    }

    fn cast_rounded(&self, ray: &Ray) -> Option<RayHit> {
        let mut first: Option<RayHit> = None;
        let mut offer = |hit: Option<RayHit>| {
            let Some(hit) = hit else { return };
            if first.is_none_or(|first| hit.fraction < first.fraction) {
                first = Some(hit);
            }
        };
        for i in 0..self.count {
            offer(enter_disk(ray, self.points[i], self.radius));
        }
        for i in 0..self.edge_count() {
            let (start, end) = self.edge(i);
            let normal = edge_normal(start, end);
            let shift = normal * self.radius;
            offer(cross_edge(ray, start + shift, end + shift, normal));
        }
        first
    }
}

/// Where the ray crosses the edge against its normal.
fn cross_edge(ray: &Ray, start: Vec2, end: Vec2, normal: Vec2) -> Option<RayHit> {
    let speed = normal.dot(ray.translation);
    let height = normal.dot(start - ray.origin);
    if speed >= 0.0 || height > 0.0 || height < speed {
        return None;
    }
    let fraction = height / speed;
    let (at, way) = (ray.at(fraction), end - start);
    let along = (at - start).dot(way);
    // Two edges that meet round where a ray hits their corner each for itself: none may slip through between.
    let size = |v: Vec2| v.x.abs() + v.y.abs();
    let slack = ROUNDING * (size(ray.origin) + size(at) + size(start)) * way.length();
    let on_edge = along >= -slack && along <= way.length_sq() + slack;
    on_edge.then_some(RayHit { fraction, normal })
}

/// Where the ray enters the disk: the smaller root of |origin + t translation - center| = radius, in 64
/// bits, because the discriminant cancels for long rays.
fn enter_disk(ray: &Ray, center: Vec2, radius: f32) -> Option<RayHit> {
    let [cx, cy, r] = [center.x, center.y, radius].map(f64::from);
    let [dx, dy] = [ray.translation.x, ray.translation.y].map(f64::from);
    let [mx, my] = [f64::from(ray.origin.x) - cx, f64::from(ray.origin.y) - cy];
    let (a, b, c) = (dx * dx + dy * dy, mx * dx + my * dy, mx * mx + my * my - r * r);
    let discriminant = b * b - a * c;
    if a <= 0.0 || b >= 0.0 || c < 0.0 || discriminant < 0.0 {
        return None;
    }
    // c / (...) instead of (-b - root) / a: no cancellation for a start close to the surface.
    let fraction = c / (discriminant.sqrt() - b);
    if fraction > 1.0 {
        return None;
    }
    let normal = Vec2::new((mx + dx * fraction) as f32, (my + dy * fraction) as f32).normalized();
    Some(RayHit { fraction: fraction as f32, normal })
}

#[cfg(test)]
mod tests {
    use super::super::point::segment_fraction;
    use super::super::tests::{any_shape, any_vec, boundary};
    use super::super::{Polygon, Shape};
    use super::*;
    use proptest::prelude::*;

    /// Distance of the ray's closest approach to a point.
    fn closest_approach(ray: &Ray, point: Vec2) -> f32 {
        ray.at(segment_fraction(ray.origin, ray.at(1.0), point)).distance(point)
    }

    fn ray(x: f32, y: f32, dx: f32, dy: f32) -> Ray {
        Ray::new(Vec2::new(x, y), Vec2::new(dx, dy))
    }

    #[test]
    fn known_hits() {
        let hit = |fraction, normal| Some(RayHit { fraction, normal });
        let rect = Shape::rect(1.0, 0.5).unwrap();
        assert_eq!(rect.ray_cast(&ray(-3.0, 0.2, 4.0, 0.0)), hit(0.5, -Vec2::X));
        let circle = Shape::circle(1.0).unwrap();
        assert_eq!(circle.ray_cast(&ray(0.0, 3.0, 0.0, -4.0)), hit(0.5, Vec2::Y));
        let rounded = Shape::from(Polygon::rect(0.75, 0.25).unwrap().rounded(0.25).unwrap());
        assert_eq!(rounded.ray_cast(&ray(-3.0, 0.2, 4.0, 0.0)), hit(0.5, -Vec2::X));
        let capsule = Shape::capsule(-Vec2::X, Vec2::X, 0.5).unwrap();
        assert_eq!(capsule.ray_cast(&ray(0.3, 2.5, 0.0, -4.0)), hit(0.5, Vec2::Y));
        assert_eq!(capsule.ray_cast(&ray(3.5, 0.0, -4.0, 0.0)), hit(0.5, Vec2::X));
        let segment = Shape::segment(-Vec2::X, Vec2::X).unwrap();
        assert_eq!(segment.ray_cast(&ray(0.3, 2.0, 0.0, -4.0)), hit(0.5, Vec2::Y));
        assert_eq!(segment.ray_cast(&ray(0.3, -2.0, 0.0, 4.0)), hit(0.5, -Vec2::Y));
        assert_eq!(segment.circle_cast(&ray(0.3, 3.0, 0.0, -4.0), 1.0), hit(0.5, Vec2::Y));
    }

    #[test]
    fn no_hits() {
        let rect = Shape::rect(1.0, 0.5).unwrap();
        let segment = Shape::segment(-Vec2::X, Vec2::X).unwrap();
        for shape in [rect, Shape::circle(0.9).unwrap(), segment] {
            for miss in [
                ray(0.0, 0.0, 5.0, 0.0),
                ray(0.0, 3.0, 0.0, -1.0),
                ray(0.0, 3.0, 0.0, 9.0),
                ray(2.0, 2.0, 0.0, 0.0),
                ray(f32::NAN, 2.0, 0.0, -5.0),
                ray(0.0, 2.0, 0.0, f32::NEG_INFINITY),
            ] {
                assert_eq!(shape.ray_cast(&miss), None, "{shape:?} {miss:?}");
            }
        }
        assert_eq!(segment.ray_cast(&ray(-3.0, 0.0, 6.0, 0.0)), None);
        assert_eq!(rect.circle_cast(&ray(0.0, 1.0, 0.0, -1.0), 0.75), None);
    }

    #[test]
    fn rays_at_corners_do_not_slip_through() {
        for k in 0..1000 {
            let polygon = Polygon::regular(3 + k % 6, 0.5 + k as f32 * 1e-3).unwrap();
            let target = polygon.vertices()[0] * 0.99999;
            let start = Vec2::new(-3.0 + k as f32 * 0.005, -5.0);
            for radius in [0.0, 0.05] {
                let shape = Shape::from(polygon.rounded(radius).unwrap());
                assert!(shape.ray_cast(&Ray::new(start, (target - start) * 2.0)).is_some());
            }
        }
    }

    proptest! {
        #[test]
        fn hits_lie_on_the_surface_and_nothing_is_before_them(
            shape in any_shape(),
            origin in any_vec(3.0),
            translation in any_vec(6.0),
        ) {
            if translation.length() < 0.1 || shape.contains(origin) {
                return Ok(());
            }
            let ray = Ray::new(origin, translation);
            let hit = shape.ray_cast(&ray);
            let end = hit.map_or(1.0, |hit| hit.fraction);
            for k in 0..1000 {
                let fraction = end * k as f32 / 1000.0 - 2e-5;
                prop_assert!(fraction < 0.0 || !shape.contains(ray.at(fraction)));
            }
            if let Some(hit) = hit {
                let point = ray.at(hit.fraction);
                let nearest = boundary(&shape, 4000)
                    .into_iter()
                    .map(|p| p.distance(point))
                    .fold(f32::INFINITY, f32::min);
                prop_assert!(nearest < 0.01, "{nearest}");
                prop_assert!((hit.normal.length() - 1.0).abs() < 1e-5);
                prop_assert!(hit.normal.dot(translation) <= 0.0);
                let outside = shape.closest_point(point + hit.normal * 0.1);
                prop_assert!(outside.distance(point) < 1e-3);
            }
        }

        #[test]
        fn circle_casts_are_ray_casts_at_a_distance(
            shape in any_shape(),
            origin in any_vec(4.0),
            translation in any_vec(6.0),
            radius in 0.01_f32..1.0,
        ) {
            let ray = Ray::new(origin, translation);
            match shape.circle_cast(&ray, radius) {
                Some(hit) => {
                    let center = ray.at(hit.fraction);
                    let gap = shape.closest_point(center).distance(center);
                    prop_assert!((gap - radius).abs() < 1e-4, "{gap} {radius}");
                }
                None => {
                    let start_gap = shape.closest_point(origin).distance(origin);
                    let sampled = boundary(&shape, 400)
                        .into_iter()
                        .map(|p| closest_approach(&ray, p))
                        .fold(f32::INFINITY, f32::min);
                    prop_assert!(start_gap <= radius || sampled > radius - 1e-4);
                }
            }
        }
    }
}
