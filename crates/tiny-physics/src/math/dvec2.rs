//! The 64-bit vector: where things are in a big world.

use super::Vec2;
use core::fmt;
use core::ops::{Add, AddAssign, Mul, Neg, Sub};

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

impl DVec2 {
    /// (0, 0).
    pub const ZERO: Self = Self::new(0.0, 0.0);

    /// A point of the two parts.
    #[inline]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

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

    /// Both parts equal.
    #[inline]
    pub const fn splat(value: f64) -> Self {
        Self::new(value, value)
    }

    /// Scalar product.
    #[inline]
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// z part of the cross product: positive where `other` is to the left.
    #[inline]
    pub fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// Turned left by a right angle.
    #[inline]
    pub fn perp(self) -> Self {
        Self::new(-self.y, self.x)
    }

    /// Square of the length.
    #[inline]
    pub fn length_sq(self) -> f64 {
        self.dot(self)
    }

    /// Length.
    #[inline]
    pub fn length(self) -> f64 {
        self.length_sq().sqrt()
    }

    /// Distance to another point.
    #[inline]
    pub fn distance(self, other: Self) -> f64 {
        (self - other).length()
    }

    /// The point that is `t` of the way to another: 0 here, 1 there.
    #[inline]
    pub fn lerp(self, other: Self, t: f64) -> Self {
        self + (other - self) * t
    }

    /// Neither part is NaN or infinite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl fmt::Debug for DVec2 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({:?}, {:?})", self.x, self.y)
    }
}

impl fmt::Display for DVec2 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}, {})", self.x, self.y)
    }
}

impl Add for DVec2 {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y)
    }
}

impl Add<Vec2> for DVec2 {
    type Output = Self;
    #[inline]
    fn add(self, other: Vec2) -> Self {
        self + Self::from(other)
    }
}

impl AddAssign<Vec2> for DVec2 {
    #[inline]
    fn add_assign(&mut self, other: Vec2) {
        *self = *self + other;
    }
}

impl Sub for DVec2 {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y)
    }
}

impl Sub<Vec2> for DVec2 {
    type Output = Self;
    #[inline]
    fn sub(self, other: Vec2) -> Self {
        self - Self::from(other)
    }
}

impl Neg for DVec2 {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}

impl Mul<f64> for DVec2 {
    type Output = Self;
    #[inline]
    fn mul(self, scale: f64) -> Self {
        Self::new(self.x * scale, self.y * scale)
    }
}

impl From<Vec2> for DVec2 {
    #[inline]
    fn from(v: Vec2) -> Self {
        Self::new(f64::from(v.x), f64::from(v.y))
    }
}

impl From<[f64; 2]> for DVec2 {
    fn from([x, y]: [f64; 2]) -> Self {
        Self::new(x, y)
    }
}

impl From<DVec2> for [f64; 2] {
    fn from(v: DVec2) -> Self {
        [v.x, v.y]
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
