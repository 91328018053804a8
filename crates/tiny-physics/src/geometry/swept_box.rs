//! Rounded boxes on their ways: for how long do they certainly stay apart?

use crate::math::{Rot, Vec2};
use crate::simd::Row;

/// A rounded box that goes straight and turns evenly about a centre of mass, seen in axes that do not turn.
pub(crate) struct SweptBox {
    /// Of mass, at the start, and how far that goes, metres.
    center: Vec2,
    way: Vec2,
    /// Radians.
    turn: f32,
    /// From the centre of mass to the middle of the box.
    arm: Vec2,
    /// From the middle to the sides.
    sides: [Vec2; 2],
    /// Along the sides.
    axes: [Vec2; 2],
    radius: f32,
    /// What the bend of its arc adds to the straight way of a point at most.
    bend: f32,
}

impl SweptBox {
    /// From the row of a shape: place, rotation, half extents and radius, seen from a centre of mass turned by `q`.
    pub(crate) fn new(row: &Row, q: Rot, (center, way, turn): (Vec2, Vec2, f32)) -> Self {
        let (arm, half) = (q.rotate(Vec2::new(row[0], row[1])), Vec2::new(row[4], row[5]));
        let x = q.rotate(Vec2::new(row[2], row[3]));
        let axes = [x, x.perp()];
        let bend = 0.5 * turn * turn * (arm.length() + half.length());
        let sides = [axes[0] * half.x, axes[1] * half.y];
        Self { center, way, turn, arm, sides, axes, radius: row[6], bend }
    }

    /// A part of the step for which one of their axes shows that two boxes do not come within `least` metres; 1 for all of it.
    /// Along one direction the least gap bends downwards in time, so it stays above what the start and the end tell.
    pub(crate) fn apart_until(&self, other: &Self, least: f32) -> f32 {
        let between = other.center + other.arm - self.center - self.arm;
        let least = least + self.radius + other.radius;
        let mut until = 0.0;
        for &axis in [self.axes, other.axes].as_flattened() {
            let axis = if axis.dot(between) < 0.0 { -axis } else { axis };
            let start = axis.dot(between) - self.half_along(axis) - other.half_along(axis) - least;
            if start > 0.0 {
                let end = -other.front(-axis) - self.front(axis) - least;
                if end > 0.0 {
                    return 1.0;
                }
                let fraction = start / (start - end);
                until = if fraction > until { fraction } else { until };
            }
        }
        until
    }

    fn half_along(&self, axis: Vec2) -> f32 {
        axis.dot(self.sides[0]).abs() + axis.dot(self.sides[1]).abs()
    }

    /// How far it is along an axis at the end, at most.
    fn front(&self, axis: Vec2) -> f32 {
        let turned = axis - axis.perp() * self.turn;
        axis.dot(self.center + self.way)
            + turned.dot(self.arm)
            + self.half_along(turned)
            + self.bend
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::any_vec;
    use super::super::{LINEAR_SLOP, Shape, Sweep, time_of_impact_to};
    use super::*;
    use crate::math::Transform;
    use proptest::prelude::*;

    fn plank(place: Vec2, way: Vec2, turn: f32) -> SweptBox {
        let row = [0.0, 0.0, 1.0, 0.0, 1.0, 0.1, 0.0, 1.0];
        SweptBox::new(&row, Rot::IDENTITY, (place, way, turn))
    }

    #[test]
    fn what_passes_by_is_told_by_an_axis() {
        let still = plank(Vec2::ZERO, Vec2::ZERO, 0.0);
        let apart = |dx: f32, dy: f32, turn: f32| {
            still.apart_until(&plank(Vec2::new(0.0, 0.4), Vec2::new(dx, dy), turn), 0.0)
        };
        assert_eq!(
            [apart(30.0, 0.0, 0.0), apart(0.0, -0.19, 0.0), apart(0.0, 0.0, 0.15)],
            [1.0; 3]
        );
        assert!((apart(0.0, -0.4, 0.0) - 0.5).abs() < 1.0e-6);
        assert!(apart(0.0, 0.0, 0.25) < 1.0 && apart(f32::NAN, 9.0, 0.0) < 1.0);
    }

    proptest! {
        #[test]
        fn no_impact_comes_sooner(
            half in any_vec(1.0), place in any_vec(3.0), way in any_vec(4.0), turns in any_vec(2.0),
        ) {
            let half = half.abs() + Vec2::new(0.05, 0.05);
            let shape = Shape::rect(half.x, half.y).unwrap();
            let row = [0.0, 0.0, 1.0, 0.0, half.x, half.y, 0.0, 1.0];
            let swept = |place, way, turn| SweptBox::new(&row, Rot::IDENTITY, (place, way, turn));
            let sweep = |place, way, turn| {
                Sweep::new(Transform::new(place, Rot::IDENTITY), Vec2::ZERO, way, turn)
            };
            let (a, b) = (sweep(Vec2::ZERO, Vec2::ZERO, turns.x), sweep(place, way, turns.y));
            let toi = time_of_impact_to(&shape, &a, &shape, &b, 1.0, LINEAR_SLOP);
            let still = swept(Vec2::ZERO, Vec2::ZERO, turns.x);
            // The search takes what is nearer than the target and a tenth of the slop for a hit.
            let until = still.apart_until(&swept(place, way, turns.y), 1.2 * LINEAR_SLOP);
            prop_assert!(until <= toi.fraction + 1.0e-3, "{until} {toi:?}");
        }
    }
}
