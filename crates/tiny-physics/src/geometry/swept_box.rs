//! Rounded boxes on their ways: do they certainly pass each other by?

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

    /// Does one of their axes show that two boxes never come within `least` metres? Along one direction the least gap bends
    /// downwards in time, so the start and the end tell.
    pub(crate) fn stays_away(&self, other: &Self, least: f32) -> bool {
        let between = other.center + other.arm - self.center - self.arm;
        let least = least + self.radius + other.radius;
        [self.axes, other.axes].as_flattened().iter().any(|&axis| {
            let axis = if axis.dot(between) < 0.0 { -axis } else { axis };
            let start = axis.dot(between) - self.half_along(axis) - other.half_along(axis);
            start > least && -other.front(-axis) - self.front(axis) > least
        })
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
