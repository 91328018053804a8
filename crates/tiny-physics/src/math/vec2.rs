//! The 32-bit vector.

use super::vector::vector;
use core::ops::{Div, Index, Mul, MulAssign, SubAssign};

/// A vector or point in the plane, in `f32`.
///
/// ```
/// use tiny_physics::Vec2;
/// let v = Vec2::new(3.0, 4.0);
/// assert_eq!(v.length(), 5.0);
/// assert_eq!(Vec2::ZERO.normalized(), Vec2::ZERO);
/// ```
#[derive(Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "[f32; 2]", into = "[f32; 2]"))]
#[repr(C)]
pub struct Vec2 {
    /// Horizontal part.
    pub x: f32,
    /// Vertical part, upwards.
    pub y: f32,
}

vector!(Vec2, f32);

impl Vec2 {
    /// (1, 0).
    pub const X: Self = Self::new(1.0, 0.0);
    /// (0, 1).
    pub const Y: Self = Self::new(0.0, 1.0);
    /// A vector shorter than this has no direction: [`Vec2::normalized`] makes it zero.
    pub const EPSILON: f32 = 1.0e-9;

    /// The same direction with length one; zero where the vector is shorter than [`Vec2::EPSILON`].
    #[inline]
    pub fn normalized(self) -> Self {
        self.direction_and_length().0
    }

    /// Unit direction and length; the direction is zero where the length is below [`Vec2::EPSILON`].
    #[inline]
    pub fn direction_and_length(self) -> (Self, f32) {
        let length = self.length();
        if length < Self::EPSILON { (Self::ZERO, length) } else { (self * (1.0 / length), length) }
    }

    /// Part by part, the smaller.
    #[inline]
    pub fn min(self, other: Self) -> Self {
        Self::new(
            if self.x < other.x { self.x } else { other.x },
            if self.y < other.y { self.y } else { other.y },
        )
    }

    /// Part by part, the larger.
    #[inline]
    pub fn max(self, other: Self) -> Self {
        Self::new(
            if self.x > other.x { self.x } else { other.x },
            if self.y > other.y { self.y } else { other.y },
        )
    }

    /// Part by part, without sign.
    #[inline]
    pub fn abs(self) -> Self {
        Self::new(self.x.abs(), self.y.abs())
    }

    /// The point a fraction `t` of the way to `other`.
    #[inline]
    pub fn lerp(self, other: Self, t: f32) -> Self {
        self * (1.0 - t) + other * t
    }
}

impl Mul<Vec2> for f32 {
    type Output = Vec2;
    #[inline]
    fn mul(self, vector: Vec2) -> Vec2 {
        vector * self
    }
}

impl Div<f32> for Vec2 {
    type Output = Self;
    #[inline]
    fn div(self, divisor: f32) -> Self {
        Self::new(self.x / divisor, self.y / divisor)
    }
}

impl SubAssign for Vec2 {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign<f32> for Vec2 {
    #[inline]
    fn mul_assign(&mut self, scale: f32) {
        *self = *self * scale;
    }
}

impl Index<usize> for Vec2 {
    type Output = f32;
    #[inline]
    fn index(&self, axis: usize) -> &f32 {
        if axis == 0 { &self.x } else { &self.y }
    }
}

impl From<(f32, f32)> for Vec2 {
    fn from((x, y): (f32, f32)) -> Self {
        Self::new(x, y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operators() {
        let (a, b) = (Vec2::new(1.0, 2.0), Vec2::new(3.0, -4.0));
        assert_eq!(a + b, Vec2::new(4.0, -2.0));
        assert_eq!(a - b, Vec2::new(-2.0, 6.0));
        assert_eq!(a * 2.0, Vec2::new(2.0, 4.0));
        let mut c = a;
        c += b;
        assert_eq!(c, a + b);
        assert_eq!(a.dot(b), -5.0);
        assert_eq!(a.cross(b), -10.0);
        assert_eq!(b.length_sq(), 25.0);
        assert_eq!(a.perp().dot(a), 0.0);
    }

    #[test]
    fn normalising_a_short_vector_gives_zero() {
        assert_eq!(Vec2::ZERO.normalized(), Vec2::ZERO);
        assert_eq!(Vec2::new(1e-12, -1e-12).normalized(), Vec2::ZERO);
        assert_eq!(Vec2::new(1e-30, 0.0).normalized(), Vec2::ZERO);
        assert!((Vec2::new(1e-3, 1e-3).normalized().length() - 1.0).abs() < 1e-6);
    }
}
