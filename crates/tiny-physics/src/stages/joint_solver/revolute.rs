//! Revolute: the anchors coincide; spring, motor and limits on the angle.
//!
//! ```text
//! C = xB + rB - xA - rA,     J v = vB + wB x rB - vA - wA x rA     (two rows, rigid)
//! angle = aB - aA,           J v = wB - wA                         (free coordinate)
//! ```
//!
//! With K the point's response and k that of the angular velocity to an impulse at the anchors, the
//! angle's inverse mass given the point is `iA + iB - k . K^-1 k` (Schur's complement). An angular
//! impulse j goes with the impulse `-K^-1 k j` at the anchors, which keeps their velocities. The decay
//! of the soft point is that of all impulses which act on it, `K p + k j`: with `K p` alone a cantilever
//! of 3 m sagged by 3.9 mm instead of 0.07 mm.

use super::JointKernel;
use super::axis::{AxisDef, Coordinate, Give};
use super::parts::{
    LEAST_COMPLEMENT, Pair, Row, Soft, Start, Stride, Symmetric, add, dot, scale, sub, wrap,
};
use super::spring::Rates;
use crate::describe::{JointDef, JointKind, Limits};
use crate::dynamics::{AngleLanes, AxisLanes, RevoluteBlock, TreeLink};
use crate::math::{Pose, Rot, Vec2};
use crate::simd::Lanes;

/// Writes what a description adds to the angle.
pub(super) fn describe_angle(angle: &mut AngleLanes, lane: usize, def: &JointDef) {
    let turn = Rot::from_angle(def.angle_b).relative_to(Rot::from_angle(def.angle_a));
    angle.turn_c[lane] = turn.c;
    angle.turn_s[lane] = turn.s;
}

/// How the point answers to what happens to the angle.
pub(super) struct Tie<L> {
    /// Response of the angular velocity to an impulse at the anchors.
    pub(super) twist: [L; 2],
    /// Impulse at the anchors that an angular impulse takes from the point, `K^-1 k`.
    pub(super) per_angular: [L; 2],
    /// Inverse mass of the angle given the point.
    pub(super) inv_mass: L,
}

impl<L: Lanes> Tie<L> {
    /// `coupled` is 1 where the point is rigid and so carries the angle along, else 0.
    #[inline(always)]
    pub(super) fn new(
        stride: &Stride<L>,
        pair: &Pair<L>,
        inverse: &Symmetric<L>,
        coupled: L,
    ) -> Self {
        let twist = pair.twist();
        let per_angular = scale(inverse.apply(twist), coupled);
        let inv_inertia = pair.inv_inertia();
        let least = inv_inertia * stride.splat(LEAST_COMPLEMENT);
        let inv_mass = (inv_inertia - dot(twist, per_angular)).max(least);
        Self { twist, per_angular, inv_mass }
    }
}

/// Limits shifted by whole turns so that their middle is in [-pi, pi].
fn near_zero(limits: Limits) -> Limits {
    const TAU: f32 = core::f32::consts::TAU;
    let shift = (0.5 * (limits.lower + limits.upper) / TAU).round() * TAU;
    Limits { lower: limits.lower - shift, upper: limits.upper - shift }
}

impl JointKernel for RevoluteBlock {
    fn axis(&self) -> Option<&AxisLanes> {
        Some(&self.axis)
    }

    fn tie(&self, stride: &Stride<f64>, pair: &Pair<f64>, link: &mut TreeLink) {
        link.hold_point(pair);
        link.let_go(&Row::ANGLE, pair.angle(stride, &self.angle));
    }

    fn describe(&mut self, lane: usize, def: &JointDef, rates: &Rates) {
        let JointKind::Revolute { spring, target_angle, limits, motor } = def.kind else { return };
        rates.write(def, None, &mut self.soft, lane);
        describe_angle(&mut self.angle, lane, def);
        let target = Rot::from_angle(target_angle).angle();
        let limits = limits.map(near_zero);
        AxisDef { spring, target, limits, motor }.write(&mut self.axis, lane, rates);
    }

    /// The angle is the one nearest to the middle of the limits, the spring's rest the one nearest to
    /// the angle.
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
        stride.store(value - wrap(stride, angle - target), &mut self.axis.rest);
    }

    #[inline(always)]
    fn warm_start<L: Lanes>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let impulse = stride.load2(&self.point.impulse_x, &self.point.impulse_y);
        pair.apply_at_anchors(impulse, self.axis.total(stride));
    }

    #[inline(always)]
    fn has_extras(&self) -> bool {
        self.axis.any_used()
    }

    #[inline(always)]
    fn solve<L: Lanes, const BIAS: bool>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let soft = Soft::load::<BIAS>(stride, &self.soft);
        let old = stride.load2(&self.point.impulse_x, &self.point.impulse_y);
        let inverse = pair.point_mass(stride);
        let demand = soft.hold2(stride, pair.anchor_velocity_in::<BIAS>(stride), pair.gap);
        let mut change = scale(inverse.apply(demand), -stride.one);
        let mut angular = stride.zero;
        if stride.extras {
            let tie = Tie::new(stride, pair, &inverse, stride.one);
            let carried = add(old, scale(tie.per_angular, self.axis.total(stride)));
            let alone = sub(change, scale(carried, soft.impulse_scale));
            let coordinate = Coordinate {
                value: pair.angle(stride, &self.angle),
                velocity: pair.spin() + dot(tie.twist, alone),
                inv_mass: tie.inv_mass,
            };
            angular = self.axis.solve::<L, BIAS>(stride, &soft, Give::turning(stride), coordinate);
            change = sub(alone, scale(tie.per_angular, angular));
        } else {
            change = sub(change, scale(old, soft.impulse_scale));
        }
        let impulse = add(old, change);
        stride.store2(impulse, &mut self.point.impulse_x, &mut self.point.impulse_y);
        pair.apply_at_anchors(change, angular);
    }

    fn impulse(&self, lane: usize) -> (Vec2, f32) {
        let point = Vec2::new(self.point.impulse_x[lane], self.point.impulse_y[lane]);
        (point, self.axis.total_of(lane))
    }
}
