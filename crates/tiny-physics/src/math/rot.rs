//! Rotations as a cosine and sine.

use super::{Vec2, atan2, sin_cos};

/// A rotation, kept as cosine and sine so that turning a vector needs no trigonometry.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[repr(C)]
pub struct Rot {
    /// Cosine of the angle.
    pub c: f32,
    /// Sine of the angle.
    pub s: f32,
}

impl Default for Rot {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Rot {
    /// No rotation.
    pub const IDENTITY: Self = Self { c: 1.0, s: 0.0 };

    /// Up to this angle in radians the series of the half-angle form is exact to 32 bits.
    pub(crate) const SMALL_TURN: f32 = 0.25;

    /// Rotation by an angle in radians, anticlockwise.
    #[inline]
    pub fn from_angle(radians: f32) -> Self {
        let (s, c) = sin_cos(radians);
        Self { c, s }
    }

    /// The angle in radians, in [-pi, pi].
    #[inline]
    pub fn angle(self) -> f32 {
        atan2(self.s, self.c)
    }

    /// Turns a vector by this rotation.
    #[inline]
    pub fn rotate(self, v: Vec2) -> Vec2 {
        Vec2::new(self.c * v.x - self.s * v.y, self.s * v.x + self.c * v.y)
    }

    /// Turns a vector back.
    #[inline]
    pub fn unrotate(self, v: Vec2) -> Vec2 {
        Vec2::new(self.c * v.x + self.s * v.y, self.c * v.y - self.s * v.x)
    }

    /// The rotation the other way round.
    #[inline]
    pub fn inverse(self) -> Self {
        Self { c: self.c, s: -self.s }
    }

    /// `self` after `first`.
    #[inline]
    pub fn compose(self, first: Self) -> Self {
        Self { c: self.c * first.c - self.s * first.s, s: self.s * first.c + self.c * first.s }
    }

    /// This rotation as seen from `reference`: `reference.compose(result) == self`.
    #[inline]
    pub fn relative_to(self, reference: Self) -> Self {
        reference.inverse().compose(self)
    }

    /// Angle from `reference` to this rotation in radians, in [-pi, pi].
    #[inline]
    pub fn angle_from(self, reference: Self) -> f32 {
        self.relative_to(reference).angle()
    }

    /// Turned on by an angle in radians, and kept at unit length: one Newton step takes out the rounding that
    /// thousands of steps would gather. What does not turn stays as it is.
    #[inline]
    pub fn integrate(self, delta: f32) -> Self {
        if delta == 0.0 {
            return self;
        }
        let turned = Self::turn(delta).compose(self);
        let scale = 1.5 - 0.5 * (turned.c * turned.c + turned.s * turned.s);
        Self { c: turned.c * scale, s: turned.s * scale }
    }

    /// The rotation by an angle in radians. Small ones take the half-angle form `((1 - t^2), 2t) / (1 + t^2)` with
    /// `t = tan(angle / 2)` by its series, which needs no table of quadrants.
    #[inline(always)]
    pub(crate) fn turn(delta: f32) -> Self {
        if delta.abs() > Self::SMALL_TURN {
            return Self::from_angle(delta);
        }
        let half = 0.5 * delta;
        let half_sq = half * half;
        let t = half + half * half_sq * (1.0 / 3.0 + half_sq * (2.0 / 15.0));
        let t_sq = t * t;
        let inv = 1.0 / (1.0 + t_sq);
        Self { c: (1.0 - t_sq) * inv, s: 2.0 * t * inv }
    }

    /// Scaled to unit length; the identity where both parts are zero.
    #[inline]
    pub fn normalized(self) -> Self {
        let (direction, _) = Vec2::new(self.c, self.s).direction_and_length();
        if direction == Vec2::ZERO {
            Self::IDENTITY
        } else {
            Self { c: direction.x, s: direction.y }
        }
    }

    /// Part of the way to `other` (0 here, 1 there), by the normalised chord: for interpolating frames.
    #[inline]
    pub fn nlerp(self, other: Self, t: f32) -> Self {
        Self { c: self.c * (1.0 - t) + other.c * t, s: self.s * (1.0 - t) + other.s * t }
            .normalized()
    }

    /// The turned x axis.
    #[inline]
    pub fn x_axis(self) -> Vec2 {
        Vec2::new(self.c, self.s)
    }

    /// The turned y axis.
    #[inline]
    pub fn y_axis(self) -> Vec2 {
        Vec2::new(-self.s, self.c)
    }

    /// Neither part is NaN or infinite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.c.is_finite() && self.s.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_trips() {
        for i in -31..=31 {
            let angle = i as f32 * 0.1;
            let rot = Rot::from_angle(angle);
            assert!((rot.angle() - angle).abs() < 1e-6, "{angle}");
            let v = Vec2::new(2.0, -3.0);
            assert!((rot.unrotate(rot.rotate(v)) - v).length() < 1e-6);
            assert!((rot.relative_to(rot).angle()).abs() < 1e-7);
        }
    }

    #[test]
    fn integration_follows_the_angle_and_keeps_unit_length() {
        let mut rot = Rot::IDENTITY;
        let delta = 0.02_f32;
        for _ in 0..10_000 {
            rot = rot.integrate(delta);
        }
        let expected = Rot::from_angle((200.0_f64 % core::f64::consts::TAU) as f32);
        assert!(rot.angle_from(expected).abs() < 1e-3, "{}", rot.angle_from(expected));
        assert!((rot.c * rot.c + rot.s * rot.s - 1.0).abs() < 1e-6);
    }

    #[test]
    fn integration_is_exact_for_any_angle() {
        for i in -4000..=4000 {
            let delta = i as f32 * 0.01;
            let turned = Rot::from_angle(0.4).integrate(delta);
            let expected = (0.4_f32 as f64 + f64::from(delta)).sin_cos();
            let error = (f64::from(turned.s) - expected.0).hypot(f64::from(turned.c) - expected.1);
            assert!(error < 3e-7, "{delta}: {error}");
        }
    }
}
