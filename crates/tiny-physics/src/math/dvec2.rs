//! The 64-bit vector: where things are in a big world.

use super::Vec2;
use super::vector::vector;
use core::ops::{Add, Sub};

/// A point in the world, in `f64`.
///
/// Positions are kept in 64 bits so that a level 100 km from the origin behaves as one at it.
/// Differences of two points are small and go on in [`Vec2`].
#[derive(Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "[f64; 2]", into = "[f64; 2]"))]
#[repr(C)]
pub struct DVec2 {
    /// Horizontal part.
    pub x: f64,
    /// Vertical part, upwards.
    pub y: f64,
}

vector!(DVec2, f64);

impl DVec2 {
    /// Rounded to the nearest 32-bit vector.
    #[inline]
    pub fn to_vec2(self) -> Vec2 {
        Vec2::new(self.x as f32, self.y as f32)
    }

    /// `self - origin` as a 32-bit vector: exact to 32 bits however far both are from (0, 0).
    #[inline]
    pub fn relative_to(self, origin: Self) -> Vec2 {
        (self - origin).to_vec2()
    }

    /// The point that is `t` of the way to another: 0 here, 1 there.
    #[inline]
    pub fn lerp(self, other: Self, t: f64) -> Self {
        self + (other - self) * t
    }
}

impl Add<Vec2> for DVec2 {
    type Output = Self;
    #[inline]
    fn add(self, other: Vec2) -> Self {
        self + Self::from(other)
    }
}

impl Sub<Vec2> for DVec2 {
    type Output = Self;
    #[inline]
    fn sub(self, other: Vec2) -> Self {
        self - Self::from(other)
    }
}

impl From<Vec2> for DVec2 {
    #[inline]
    fn from(v: Vec2) -> Self {
        Self::new(f64::from(v.x), f64::from(v.y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_far_away_are_exact() {
        let far = DVec2::new(1.0e7, -1.0e7);
        let near = far + Vec2::new(0.001, 0.25);
        let difference = near.relative_to(far);
        assert!((difference.x - 0.001).abs() < 1e-8);
        assert_eq!(difference.y, 0.25);
    }
}
