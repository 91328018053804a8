//! Distance: the length between the anchors.
//!
//! ```text
//! u = d / |d|,   J v = u . (vB + wB x rB - vA - wA x rA),   C = |d| - length
//! ```
//!
//! A rod holds C = 0; otherwise spring, motor and limits act along the length.

use super::JointKernel;
use super::axis::{AxisDef, Coordinate, Give};
use super::parts::{Pair, Row, Soft, Stride, cross, dot, scale, slow_turn};
use super::spring::Rates;
use crate::describe::{JointDef, JointKind};
use crate::dynamics::{AxisLanes, DistanceBlock, TreeLink, UNLIMITED};
use crate::math::Vec2;
use crate::simd::{BLOCK, Lanes};

/// Length and unit vector; (1, 0) for the zero vector.
#[inline(always)]
pub(super) fn length_and_direction<L: Lanes>(stride: &Stride<L>, v: [L; 2]) -> (L, [L; 2]) {
    let length = dot(v, v).sqrt();
    let some = length.gt(stride.splat(1.0e-9));
    let inv = stride.one / L::select(some, length, stride.one);
    let unit = scale(v, inv);
    let x = L::select(some, unit[0], stride.one);
    (length, [x, L::select(some, unit[1], stride.zero)])
}

/// Length and Jacobian of it.
#[inline(always)]
fn length_row<L: Lanes>(stride: &Stride<L>, pair: &Pair<L>) -> (L, Row<L>) {
    let (length, direction) = length_and_direction(stride, pair.gap);
    (length, pair.row(pair.anchor_a, direction))
}

/// What circles add to the mean rate of the length over a substep, to second order: those of the
/// anchors, and that of the whole rod, `h vt^2 / (2 |d|)` with vt across it. See
/// [`Pair::anchor_velocity_in`]. The length itself a substep ahead would not do: it grows again beyond
/// zero, and a very short rope pulled harder and harder.
#[inline(always)]
fn outward<L: Lanes>(stride: &Stride<L>, pair: &Pair<L>, length: L, direction: [L; 2]) -> L {
    let across = cross(direction, pair.anchor_velocity());
    let turn_rate = across * stride.invert(length);
    let rod = stride.splat(0.5) * across * slow_turn(stride, turn_rate);
    rod + dot(direction, pair.inward(stride))
}

impl JointKernel for DistanceBlock {
    #[inline(always)]
    fn axis(&self) -> Option<&AxisLanes> {
        Some(&self.axis)
    }

    fn tie(&self, stride: &Stride<f64>, pair: &Pair<f64>, link: &mut TreeLink) {
        let (length, row) = length_row(stride, pair);
        let [rod, length_of_rod] = stride.load2(&self.soft.rigid, &self.length.length);
        link.hold(&row, rod * (length - length_of_rod));
        // Of ropes nothing is held but limits and motor, in the same row.
        link.rigid = rod as usize;
        link.let_go(&row, length);
    }

    fn told(&mut self) -> Option<[&mut [f32; BLOCK]; 2]> {
        Some([&mut self.length.now_x, &mut self.length.now_y])
    }

    fn describe(&mut self, lane: usize, def: &JointDef, rates: &Rates) {
        let JointKind::Distance { length, spring, limits, motor } = def.kind else { return };
        let rod = spring.is_none() && limits.is_none() && motor.is_none();
        rates.write(def, None, &mut self.soft, lane);
        self.soft.rigid[lane] = if rod { 1.0 } else { 0.0 };
        if !rod {
            self.rod.impulse[lane] = 0.0;
        }
        self.length.length[lane] = length;
        AxisDef { spring, target: length, limits, motor }.write(&mut self.axis, lane, rates);
        if limits.is_some_and(|limits| limits.lower <= 0.0) {
            // Nothing is nearer than that: a limit would brake what passes by.
            (self.axis.lower[lane], self.axis.lower_impulse[lane]) = (-UNLIMITED, 0.0);
        }
    }

    #[inline(always)]
    fn off<L: Lanes>(&self, stride: &Stride<L>, gap: [L; 2]) -> [L; 2] {
        let (length, direction) = length_and_direction(stride, gap);
        let rod = length - stride.load(&self.length.length);
        let limits = stride.load2(&self.axis.lower, &self.axis.upper);
        let rope = length - length.clamp(limits[0], limits[1]);
        let rigid = stride.load(&self.soft.rigid).gt(stride.zero);
        scale(direction, L::select(rigid, rod, rope))
    }

    #[inline(always)]
    fn warm_start<L: Lanes>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let (_, row) = length_row(stride, pair);
        pair.apply_along(&row, stride.load(&self.rod.impulse) + self.axis.total(stride));
    }

    #[inline(always)]
    fn solve<L: Lanes, const BIAS: bool>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let (value, row) = length_row(stride, pair);
        let soft = Soft::<L, BIAS>::load(stride, &self.soft);
        let rigid = stride.load(&self.soft.rigid);
        let inv_mass = pair.inv_mass_along(&row);
        let mut velocity = pair.velocity_along(&row);
        if BIAS {
            velocity = velocity + outward(stride, pair, value, row.direction);
        }
        let yields = stride.load(&self.frame.yields);
        let mut change = stride.zero;
        if stride.extras {
            let coordinate = Coordinate { value, velocity, inv_mass };
            let give = Give::rope(stride, soft, yields);
            change = self.axis.solve(stride, give, coordinate);
            velocity = velocity + inv_mass * change;
        }
        let old = stride.load(&self.rod.impulse);
        let error = value - stride.load(&self.length.length);
        let soft = soft.in_part(soft.part(stride, error, stride.snap)).yielding(yields);
        let demand = soft.demand(velocity, error);
        let rod = -(stride.invert(inv_mass) * rigid * demand) - soft.impulse_scale * old;
        stride.store(old + rod, &mut self.rod.impulse);
        pair.apply_along(&row, change + rod);
        if !BIAS {
            stride.store2(row.direction, &mut self.length.now_x, &mut self.length.now_y);
        }
    }

    fn impulse(&self, lane: usize) -> (Vec2, f32) {
        let direction = Vec2::new(self.length.now_x[lane], self.length.now_y[lane]);
        (direction * (self.rod.impulse[lane] + self.axis.total_of(lane)), 0.0)
    }
}
