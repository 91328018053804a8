//! Weld: anchors and angles coincide, each rigidly or by a spring.
//!
//! ```text
//! C = (xB + rB - xA - rA, aB - aA),   J v = (vB + wB x rB - vA - wA x rA, wB - wA)
//! ```
//!
//! The three rows are solved as one block where the point is rigid, as in
//! [`revolute`](super::revolute).

use super::JointKernel;
use super::axis::complement;
use super::parts::{Pair, Row, Soft, Start, Stride, add, describe_angle, dot, scale, sub};
use super::spring::Rates;
use crate::describe::{JointDef, JointKind};
use crate::dynamics::{SoftLanes, TreeLink, WeldBlock};
use crate::math::{Pose, Vec2};
use crate::simd::Lanes;

impl JointKernel for WeldBlock {
    fn tie(&self, stride: &Stride<f64>, pair: &Pair<f64>, link: &mut TreeLink) {
        link.hold_point(pair);
        link.hold(&Row::ANGLE, pair.angle(stride, &self.angle));
    }

    fn describe(&mut self, lane: usize, def: &JointDef, rates: &Rates) {
        let JointKind::Weld { linear, angular } = def.kind else { return };
        rates.write(def, linear, &mut self.linear, lane);
        rates.write(def, angular, &mut self.angular, lane);
        describe_angle(&mut self.angle, lane, def);
    }

    #[inline(always)]
    fn prepare<L: Lanes>(&mut self, stride: &Stride<L>, start: &Start<L>, _: &[Pose]) {
        start.prepare_angle(stride, &mut self.angle);
    }

    #[inline(always)]
    fn off<L: Lanes>(&self, _: &Stride<L>, gap: [L; 2]) -> [L; 2] {
        gap
    }

    #[inline(always)]
    fn warm_start<L: Lanes>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        pair.meet(stride);
        let impulse = stride.load2(&self.point.impulse_x, &self.point.impulse_y);
        pair.apply_at_anchors(impulse, stride.load(&self.twist.impulse));
    }

    #[inline(always)]
    fn solve<L: Lanes, const BIAS: bool>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        pair.meet(stride);
        let linear = Soft::<L, BIAS>::load(stride, &self.linear);
        let angular = Soft::<L, BIAS>::load(stride, &self.angular);
        let is_rigid = |soft: &SoftLanes| stride.load(&soft.rigid).min(stride.one);
        let [rigid_point, rigid] = [is_rigid(&self.linear), is_rigid(&self.angular)];
        // A springy point of bodies that do not turn against each other: what it gives comes after what holds the angle.
        let upright = rigid * (stride.one - rigid_point);
        let inverse = pair.point_mass_where(stride, upright);
        let coupling = pair.twist();
        let per_point = scale(coupling, upright * stride.invert(pair.inv_inertia()));

        let old_twist = stride.load(&self.twist.impulse);
        let angle = pair.angle(stride, &self.angle);
        let angular = angular.in_part(angular.part(stride, angle, stride.snap_turn));
        let demand_turn = angular.demand(pair.spin(), angle);

        let old = stride.load2(&self.point.impulse_x, &self.point.impulse_y);
        let linear = linear.hold2(stride, pair.gap, stride.load(&self.frame.yields));
        let demand = linear.demand2(pair.anchor_velocity_in::<BIAS>(stride), pair.gap);
        // A rigid angle decays with what the point does to it.
        let acting = pair.inv_inertia() * old_twist + dot(coupling, old);
        let turn = demand_turn + angular.impulse_scale * acting;
        let demand = sub(demand, scale(per_point, linear.mass_scale * turn));
        let alone = scale(inverse.apply(demand), -stride.one);
        // Only a rigid point carries the angle along.
        let per_angular = scale(inverse.apply(coupling), rigid_point);
        let inv_mass = complement(stride, pair.inv_inertia(), coupling, per_angular);

        // A rigid angle takes away all of the spin that the point's correction makes, a spring its part.
        let part = rigid + (stride.one - rigid) * angular.mass_scale;
        let demand = demand_turn + part * dot(coupling, alone);
        let twist = -(stride.invert(inv_mass) * demand) - angular.impulse_scale * old_twist;
        let decay = linear.impulse_scale - angular.impulse_scale;
        let twist = twist + decay * dot(per_point, old);
        let carried = add(old, scale(per_angular, old_twist));
        let change =
            sub(sub(alone, scale(carried, linear.impulse_scale)), scale(per_angular, twist));

        let impulse = add(old, change);
        stride.store2(impulse, &mut self.point.impulse_x, &mut self.point.impulse_y);
        stride.store(old_twist + twist, &mut self.twist.impulse);
        pair.apply_at_anchors(change, twist);
    }

    fn impulse(&self, lane: usize) -> (Vec2, f32) {
        let point = Vec2::new(self.point.impulse_x[lane], self.point.impulse_y[lane]);
        (point, self.twist.impulse[lane])
    }
}
