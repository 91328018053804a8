//! Revolute: the anchors coincide; spring, motor and limits on the angle.
//!
//! ```text
//! C = xB + rB - xA - rA,     J v = vB + wB x rB - vA - wA x rA     (two rows, rigid)
//! angle = aB - aA,           J v = wB - wA                         (free coordinate)
//! ```

use super::JointKernel;
use super::axis::{AxisDef, Coordinate, Give, Held};
use super::parts::{Pair, Row, Soft, Start, Stride, add, describe_angle, wrap};
use super::spring::Rates;
use crate::describe::{JointDef, JointKind, Limits};
use crate::dynamics::{AxisLanes, RevoluteBlock, TreeLink, UNLIMITED};
use crate::math::{Pose, Rot, Vec2};
use crate::simd::Lanes;

/// Limits shifted by whole turns so that their middle is in [-pi, pi].
fn near_zero(limits: Limits) -> Limits {
    const TAU: f32 = core::f32::consts::TAU;
    let shift = (0.5 * (limits.lower + limits.upper) / TAU).round() * TAU;
    Limits { lower: limits.lower - shift, upper: limits.upper - shift }
}

impl JointKernel for RevoluteBlock {
    #[inline(always)]
    fn axis(&self) -> Option<&AxisLanes> {
        Some(&self.axis)
    }

    fn tie(&self, stride: &Stride<f64>, pair: &Pair<f64>, link: &mut TreeLink) {
        link.hold_point(pair);
        link.let_go(&Row::ANGLE, pair.angle(stride, &self.angle));
    }

    fn give<const BIAS: bool>(&self, stride: &Stride<f64>) -> Option<Give<f64, BIAS>> {
        Some(Give::turning(stride, Soft::load(stride, &self.soft)))
    }

    fn describe(&mut self, lane: usize, def: &JointDef, rates: &Rates) {
        let JointKind::Revolute { spring, target_angle, limits, motor } = def.kind else { return };
        rates.write(def, None, &mut self.soft, lane);
        describe_angle(&mut self.angle, lane, def);
        let target = Rot::from_angle(target_angle).angle();
        let limits = limits.map(near_zero);
        AxisDef { spring, target, limits, motor }.write(&mut self.axis, lane, rates);
    }

    /// The angle is the one nearest to the middle of the limits, and so is the spring's rest; without limits that is the one
    /// nearest to the angle.
    #[inline(always)]
    fn prepare<L: Lanes>(&mut self, stride: &Stride<L>, start: &Start<L>, _: &[Pose]) {
        if !self.axis.any_used() {
            return;
        }
        let angle = start.angle(stride, stride.load2(&self.angle.turn_c, &self.angle.turn_s));
        let (lower, upper) = (stride.load(&self.axis.lower), stride.load(&self.axis.upper));
        let middle = (lower + upper) * stride.splat(0.5);
        let value = middle + wrap(stride, angle - middle);
        stride.store(value, &mut self.angle.start);
        let target = stride.load(&self.axis.target);
        let turn = L::select(lower.gt(stride.splat(-UNLIMITED)), middle, value);
        stride.store(turn - wrap(stride, turn - target), &mut self.axis.rest);
    }

    #[inline(always)]
    fn off<L: Lanes>(&self, _: &Stride<L>, gap: [L; 2]) -> [L; 2] {
        gap
    }

    #[inline(always)]
    fn warm_start<L: Lanes>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        pair.meet(stride);
        let impulse = stride.load2(&self.point.impulse_x, &self.point.impulse_y);
        pair.apply_at_anchors(impulse, self.axis.total(stride));
    }

    #[inline(always)]
    fn solve<L: Lanes, const BIAS: bool>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        pair.meet(stride);
        let soft = Soft::<L, BIAS>::load(stride, &self.soft);
        let old = stride.load2(&self.point.impulse_x, &self.point.impulse_y);
        let held = soft.hold2(stride, pair.gap, stride.load(&self.frame.yields));
        let rows = Held {
            inverse: pair.point_mass(stride),
            demand: held.demand2(pair.anchor_velocity_in::<BIAS>(stride), pair.gap),
            soft: held,
            old,
            coupling: pair.twist(),
        };
        let coordinate = Coordinate {
            value: pair.angle(stride, &self.angle),
            velocity: pair.spin(),
            inv_mass: pair.inv_inertia(),
        };
        let give = Give::turning(stride, soft);
        let (change, angular) = rows.solve(stride, &mut self.axis, coordinate, give);
        let impulse = add(old, change);
        stride.store2(impulse, &mut self.point.impulse_x, &mut self.point.impulse_y);
        pair.apply_at_anchors(change, angular);
    }

    fn impulse(&self, lane: usize) -> (Vec2, f32) {
        let point = Vec2::new(self.point.impulse_x[lane], self.point.impulse_y[lane]);
        (point, self.axis.total_of(lane))
    }
}
