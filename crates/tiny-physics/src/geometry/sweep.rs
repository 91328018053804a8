//! The motion of a body over a step.

use crate::math::{Rot, Transform, Vec2};

/// The motion of a frame over a step: its centre of mass goes straight, it turns evenly about it.
///
/// Both sweeps of a pair are relative to one local origin near them, so 32 bits hold the differences.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Sweep {
    /// Centre of mass in the moving frame, metres.
    pub local_center: Vec2,
    /// Centre of mass at fraction 0, metres.
    pub start: Vec2,
    /// Centre of mass at fraction 1, metres.
    pub end: Vec2,
    /// Rotation at fraction 0.
    pub rotation: Rot,
    /// Turn from fraction 0 to 1, radians; may be more than a full turn.
    pub angle: f32,
}

impl Sweep {
    /// A frame that stands still.
    pub fn fixed(frame: Transform) -> Self {
        Self::new(frame, Vec2::ZERO, Vec2::ZERO, 0.0)
    }

    /// From the frame at the start, its centre of mass (in the frame), and motion and turn over the step.
    pub fn new(frame: Transform, local_center: Vec2, translation: Vec2, angle: f32) -> Self {
        let start = frame.apply(local_center);
        Self { local_center, start, end: start + translation, rotation: frame.q, angle }
    }

    /// The motion of a frame that is fixed to this one: a shape on a body.
    pub fn child(&self, local: Transform) -> Self {
        Self {
            local_center: local.unapply(self.local_center),
            rotation: self.rotation.compose(local.q),
            ..*self
        }
    }

    /// Motion of the centre of mass, metres.
    #[inline]
    pub fn translation(&self) -> Vec2 {
        self.end - self.start
    }

    /// The frame at a fraction of the step.
    pub fn at(&self, fraction: f32) -> Transform {
        let q = if self.angle == 0.0 || fraction == 0.0 {
            self.rotation
        } else {
            Rot::turn(self.angle * fraction).compose(self.rotation)
        };
        let center = self.start + self.translation() * fraction;
        Transform::new(center - q.rotate(self.local_center), q)
    }

    /// Neither part is NaN or infinite.
    pub fn is_finite(&self) -> bool {
        self.local_center.is_finite()
            && self.start.is_finite()
            && self.end.is_finite()
            && self.rotation.is_finite()
            && self.angle.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sweep_starts_and_ends_where_it_should() {
        let frame = Transform::from_angle(Vec2::new(1.0, 2.0), 0.5);
        let sweep = Sweep::new(frame, Vec2::new(0.3, -0.1), Vec2::new(2.0, -1.0), 1.5);
        let (first, last) = (sweep.at(0.0), sweep.at(1.0));
        assert!((first.p - frame.p).length() < 1e-6);
        assert!((last.q.angle() - 2.0).abs() < 1e-6);
        let center = last.apply(sweep.local_center);
        assert!((center - sweep.end).length() < 1e-6);
        assert_eq!(Sweep::fixed(frame).at(0.7), frame);
    }

    #[test]
    fn children_move_with_their_parent() {
        let frame = Transform::from_angle(Vec2::new(1.0, 2.0), 0.5);
        let local = Transform::from_angle(Vec2::new(-0.4, 0.2), -0.9);
        let sweep = Sweep::new(frame, Vec2::new(0.3, -0.1), Vec2::new(2.0, -1.0), 1.5);
        for k in 0..=10 {
            let fraction = k as f32 / 10.0;
            let expected = sweep.at(fraction).compose(local);
            let found = sweep.child(local).at(fraction);
            assert!((found.p - expected.p).length() < 1e-6);
            assert!(found.q.angle_from(expected.q).abs() < 1e-6);
        }
    }
}
