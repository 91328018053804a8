//! What trees of boxes are searched for: what a box moved along a straight line meets (a ray is the cast of a point), and
//! what is nearest.

use crate::math::{Aabb, DVec2, Vec2};

/// A search in trees of boxes that becomes narrower with what it finds: for [`DynamicTree::cast`](super::DynamicTree::cast).
pub trait Search {
    /// The box around all that it looks for up to a limit.
    fn bounds(&self, limit: f32) -> Aabb;
    /// When a box is looked at, smaller ones first; `None` where for certain nothing in it is within the limit.
    fn order(&self, target: &Aabb, limit: f32) -> Option<f32>;
}

/// Looks for what is nearest to a point: world, metres. Limits are distances from it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Nearest(pub DVec2);

impl Search for Nearest {
    fn bounds(&self, limit: f32) -> Aabb {
        let side = DVec2::new(f64::from(limit), f64::from(limit));
        Aabb::rounded_out(self.0 - side, self.0 + side)
    }

    fn order(&self, target: &Aabb, limit: f32) -> Option<f32> {
        let before = DVec2::from(target.min).relative_to(self.0);
        let behind = self.0.relative_to(target.max.into());
        let distance = before.max(behind).max(Vec2::ZERO).length();
        (distance <= limit * (1.0 + 4.0 * f32::EPSILON)).then_some(distance)
    }
}

/// A box swept along a segment. World frame, metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BoxCast {
    /// Centre at the start.
    pub origin: Vec2,
    /// The whole motion; fraction 1 is its end.
    pub translation: Vec2,
    /// Half of width and height; zero for a ray.
    pub half_extents: Vec2,
}

impl BoxCast {
    /// The cast of a point.
    #[inline]
    pub fn ray(origin: Vec2, translation: Vec2) -> Self {
        Self { origin, translation, half_extents: Vec2::ZERO }
    }

    /// Does the infinite line of the cast miss the box for certain? The axis is the normal of the
    /// motion; the slack covers rounding, so that far from the origin nothing is missed.
    #[inline]
    fn line_misses(&self, target: &Aabb) -> bool {
        let center = target.center();
        let reach = target.half_extents() + self.half_extents;
        let (d, r) = (self.translation.abs(), center - self.origin);
        let size = center.abs() + self.origin.abs() + reach;
        let slack = 4.0 * f32::EPSILON * (d.x * size.y + d.y * size.x);
        self.translation.cross(r).abs() > d.x * reach.y + d.y * reach.x + slack
    }
}

impl Search for BoxCast {
    /// The box around the motion up to `fraction`.
    #[inline]
    fn bounds(&self, fraction: f32) -> Aabb {
        let end = self.origin + self.translation * fraction;
        Aabb::new(
            self.origin.min(end) - self.half_extents,
            self.origin.max(end) + self.half_extents,
        )
    }

    #[inline]
    fn order(&self, target: &Aabb, _: f32) -> Option<f32> {
        (!self.line_misses(target)).then(|| target.center().dot(self.translation))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn diagonal_line_misses_the_corner_box() {
        let cast = BoxCast::ray(Vec2::ZERO, Vec2::new(10.0, 10.0));
        let corner = Aabb::from_center(Vec2::new(8.0, 2.0), Vec2::splat(1.0));
        let middle = Aabb::from_center(Vec2::new(5.0, 5.5), Vec2::splat(1.0));
        assert!(cast.bounds(1.0).overlaps(&corner) && cast.line_misses(&corner));
        assert!(!cast.line_misses(&middle));
        let wide = BoxCast { half_extents: Vec2::splat(3.0), ..cast };
        assert!(!wide.line_misses(&corner));
    }
}
