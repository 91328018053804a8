//! Frames: small ones between shapes, big ones in the world.

use super::{DVec2, Rot, Vec2};

/// A rotation followed by a shift: takes points of a local frame to its parent frame.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
#[repr(C)]
pub struct Transform {
    /// Origin of the local frame, metres in the parent frame.
    pub p: Vec2,
    /// Rotation of the local frame.
    pub q: Rot,
}

impl Transform {
    /// No shift and no rotation.
    pub const IDENTITY: Self = Self { p: Vec2::ZERO, q: Rot::IDENTITY };

    /// A frame at `p`, turned by `q`.
    #[inline]
    pub const fn new(p: Vec2, q: Rot) -> Self {
        Self { p, q }
    }

    /// A frame at `p`, turned by an angle in radians.
    #[inline]
    pub fn from_angle(p: Vec2, radians: f32) -> Self {
        Self::new(p, Rot::from_angle(radians))
    }

    /// A local point in the parent frame.
    #[inline]
    pub fn apply(self, local: Vec2) -> Vec2 {
        self.q.rotate(local) + self.p
    }

    /// A parent point in the local frame.
    #[inline]
    pub fn unapply(self, point: Vec2) -> Vec2 {
        self.q.unrotate(point - self.p)
    }

    /// `self` after `first`: from `first`'s local frame to `self`'s parent frame.
    #[inline]
    pub fn compose(self, first: Self) -> Self {
        Self::new(self.apply(first.p), self.q.compose(first.q))
    }

    /// This frame as seen from `reference` (both in one parent frame).
    #[inline]
    pub fn relative_to(self, reference: Self) -> Self {
        Self::new(reference.unapply(self.p), self.q.relative_to(reference.q))
    }

    /// The way back: parent to local.
    #[inline]
    pub fn inverse(self) -> Self {
        Self::IDENTITY.relative_to(self)
    }

    /// All parts are finite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.p.is_finite() && self.q.is_finite()
    }
}

/// A frame in the world: 64-bit position, 32-bit rotation.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[repr(C)]
pub struct Pose {
    /// Origin, metres in the world.
    pub p: DVec2,
    /// Rotation.
    pub q: Rot,
}

impl Pose {
    /// A pose at `p`, turned by `q`.
    #[inline]
    pub const fn new(p: DVec2, q: Rot) -> Self {
        Self { p, q }
    }

    /// A local point in the world.
    #[inline]
    pub fn apply(self, local: Vec2) -> DVec2 {
        self.p + self.q.rotate(local)
    }

    /// A world point in the local frame.
    #[inline]
    pub fn unapply(self, point: DVec2) -> Vec2 {
        self.q.unrotate(point.relative_to(self.p))
    }

    /// This pose as seen from `reference`: the difference is small, so 32 bits hold it.
    #[inline]
    pub fn relative_to(self, reference: Self) -> Transform {
        Transform::new(reference.unapply(self.p), self.q.relative_to(reference.q))
    }

    /// A local frame in the world.
    #[inline]
    pub fn compose(self, local: Transform) -> Self {
        Self::new(self.apply(local.p), self.q.compose(local.q))
    }

    /// Rounded to 32 bits.
    #[inline]
    pub fn to_transform(self) -> Transform {
        Transform::new(self.p.to_vec2(), self.q)
    }

    /// All parts are finite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.p.is_finite() && self.q.is_finite()
    }
}

impl From<Transform> for Pose {
    fn from(transform: Transform) -> Self {
        Self::new(transform.p.into(), transform.q)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relative_frames_compose_back() {
        let a = Transform::from_angle(Vec2::new(1.0, 2.0), 0.7);
        let b = Transform::from_angle(Vec2::new(-3.0, 0.5), -1.9);
        let relative = b.relative_to(a);
        let back = a.compose(relative);
        assert!((back.p - b.p).length() < 1e-6);
        assert!(back.q.angle_from(b.q).abs() < 1e-6);
        let point = Vec2::new(0.3, -0.4);
        assert!((a.unapply(a.apply(point)) - point).length() < 1e-6);
        assert!((a.inverse().apply(a.apply(point)) - point).length() < 1e-6);
    }

    #[test]
    fn poses_far_away_keep_their_differences() {
        let far = DVec2::new(1.0e5, 1.0e5);
        let a = Pose::new(far, Rot::from_angle(0.3));
        let b = Pose::new(far + Vec2::new(0.5, 0.001), Rot::IDENTITY);
        let near_a = Pose::new(DVec2::ZERO, Rot::from_angle(0.3));
        let near_b = Pose::new(Vec2::new(0.5, 0.001).into(), Rot::IDENTITY);
        assert!((b.relative_to(a).p - near_b.relative_to(near_a).p).length() < 1e-7);
    }
}
