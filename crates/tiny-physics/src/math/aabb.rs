//! Axis-aligned bounding boxes.

use super::{DVec2, Vec2};

/// An axis-aligned bounding box: `min` and `max` corners, metres.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[repr(C)]
pub struct Aabb {
    /// Lower left corner.
    pub min: Vec2,
    /// Upper right corner.
    pub max: Vec2,
}

impl Aabb {
    /// Holds nothing: the neutral element of [`Aabb::union`].
    pub const EMPTY: Self =
        Self { min: Vec2::splat(f32::INFINITY), max: Vec2::splat(f32::NEG_INFINITY) };

    /// A box from its corners.
    #[inline]
    pub const fn new(min: Vec2, max: Vec2) -> Self {
        Self { min, max }
    }

    /// A box around a centre.
    #[inline]
    pub fn from_center(center: Vec2, half_extents: Vec2) -> Self {
        Self::new(center - half_extents, center + half_extents)
    }

    /// The smallest 32-bit box that holds the 64-bit one: rounded outwards, so nothing is lost far
    /// from the origin.
    #[inline]
    pub fn rounded_out(min: DVec2, max: DVec2) -> Self {
        Self::new(
            Vec2::new(round_down(min.x), round_down(min.y)),
            Vec2::new(round_up(max.x), round_up(max.y)),
        )
    }

    /// Do the two boxes share a point? Touching edges count.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        // Which of the four fails is noise to the branch predictor.
        (self.min.x <= other.max.x)
            & (other.min.x <= self.max.x)
            & (self.min.y <= other.max.y)
            & (other.min.y <= self.max.y)
    }

    /// Is `other` inside this box, edges included?
    #[inline]
    pub fn contains(&self, other: &Self) -> bool {
        self.min.x <= other.min.x
            && self.min.y <= other.min.y
            && other.max.x <= self.max.x
            && other.max.y <= self.max.y
    }

    /// Is the point inside, edges included?
    #[inline]
    pub fn contains_point(&self, point: Vec2) -> bool {
        self.contains(&Self::new(point, point))
    }

    /// The smallest box that holds both.
    #[inline]
    pub fn union(&self, other: &Self) -> Self {
        Self::new(self.min.min(other.min), self.max.max(other.max))
    }

    /// Grown by `margin` metres on every side.
    #[inline]
    pub fn grown(&self, margin: f32) -> Self {
        Self::new(self.min - Vec2::splat(margin), self.max + Vec2::splat(margin))
    }

    /// The box of all that it goes through on a way, metres.
    #[inline]
    pub(crate) fn swept(&self, way: Vec2) -> Self {
        Self::new(self.min + way.min(Vec2::ZERO), self.max + way.max(Vec2::ZERO))
    }

    /// Centre of the box.
    #[inline]
    pub fn center(&self) -> Vec2 {
        (self.min + self.max) * 0.5
    }

    /// Half of width and height.
    #[inline]
    pub fn half_extents(&self) -> Vec2 {
        (self.max - self.min) * 0.5
    }

    /// Width plus height doubled: the cost measure of bounding volume trees.
    #[inline]
    pub fn perimeter(&self) -> f32 {
        let size = self.max - self.min;
        2.0 * (size.x + size.y)
    }

    /// All corners finite and `min <= max`.
    #[inline]
    pub fn is_valid(&self) -> bool {
        self.min.is_finite()
            && self.max.is_finite()
            && self.min.x <= self.max.x
            && self.min.y <= self.max.y
    }
}

#[inline]
fn round_down(value: f64) -> f32 {
    let rounded = value as f32;
    if f64::from(rounded) > value { rounded.next_down() } else { rounded }
}

#[inline]
fn round_up(value: f64) -> f32 {
    let rounded = value as f32;
    if f64::from(rounded) < value { rounded.next_up() } else { rounded }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlap_and_containment() {
        let a = Aabb::new(Vec2::ZERO, Vec2::new(2.0, 2.0));
        let touching = Aabb::new(Vec2::new(2.0, 0.0), Vec2::new(3.0, 1.0));
        let apart = Aabb::new(Vec2::new(2.1, 0.0), Vec2::new(3.0, 1.0));
        assert!(a.overlaps(&touching) && touching.overlaps(&a));
        assert!(!a.overlaps(&apart));
        assert!(a.contains(&Aabb::from_center(Vec2::new(1.0, 1.0), Vec2::new(1.0, 0.5))));
        assert!(!a.contains(&touching));
        assert_eq!(Aabb::EMPTY.union(&a), a);
        assert_eq!(a.perimeter(), 8.0);
        assert_eq!(a.grown(1.0).half_extents(), Vec2::new(2.0, 2.0));
    }

    #[test]
    fn rounding_out_never_loses_a_point() {
        for k in 0..1000 {
            let min = DVec2::new(1.0e7 + f64::from(k) * 0.1, -1.0e5 - f64::from(k) * 0.37);
            let max = min + Vec2::new(0.3, 0.3);
            let rounded = Aabb::rounded_out(min, max);
            assert!(f64::from(rounded.min.x) <= min.x && f64::from(rounded.min.y) <= min.y);
            assert!(f64::from(rounded.max.x) >= max.x && f64::from(rounded.max.y) >= max.y);
        }
    }
}
