//! Prismatic: B slides along a direction of A and does not turn against it.
//!
//! ```text
//! d = xB + rB - xA - rA,   u the direction, n across it
//! C = (n . d, aB - aA),    J v = (n . (vB - vA) + (rB x n) wB - ((d + rA) x n) wA, wB - wA)
//! coordinate u . d,        J v = u . (vB - vA) + (rB x u) wB - ((d + rA) x u) wA
//! ```
//!
//! The coordinate's inverse mass is Schur's complement of the two rigid rows, as in
//! [`revolute`](super::revolute).

use super::JointKernel;
use super::axis::{AxisDef, Coordinate, Give};
use super::parts::{
    LEAST_COMPLEMENT, Pair, Row, Soft, Start, Stride, Symmetric, add, dot, perp, rotate, scale, sub,
};
use super::revolute::describe_angle;
use super::spring::Rates;
use crate::describe::{JointDef, JointKind};
use crate::dynamics::{AxisLanes, DirectionLanes, PrismaticBlock, Slot, TreeLink};
use crate::math::{Pose, Rot, Vec2};
use crate::simd::{BLOCK, Lanes};

/// Writes a description's direction.
pub(super) fn describe_direction(lanes: &mut DirectionLanes, lane: usize, def: &JointDef) {
    let direction = Rot::from_angle(def.angle_a);
    lanes.local_x[lane] = direction.c;
    lanes.local_y[lane] = direction.s;
}

/// Turns the direction into the world's axes.
#[inline(always)]
pub(super) fn prepare_direction<L: Lanes>(
    stride: &Stride<L>,
    lanes: &mut DirectionLanes,
    start: &Start<L>,
) {
    let local = stride.load2(&lanes.local_x, &lanes.local_y);
    stride.store2(rotate(start.turn_a, local), &mut lanes.x, &mut lanes.y);
}

/// The Jacobians as they are now.
struct Rows<L> {
    along: Row<L>,
    across: Row<L>,
}

impl<L: Lanes> Rows<L> {
    #[inline(always)]
    fn new(pair: &Pair<L>, direction: [L; 2]) -> Self {
        Self { along: pair.row_on_a(direction), across: pair.row_on_a(perp(direction)) }
    }

    /// Applies impulses along, across, and angular.
    #[inline(always)]
    fn apply(&self, pair: &mut Pair<L>, along: L, [across, angular]: [L; 2]) {
        pair.apply(
            add(scale(self.along.direction, along), scale(self.across.direction, across)),
            self.along.arm_a * along + self.across.arm_a * across + angular,
            self.along.arm_b * along + self.across.arm_b * across + angular,
        );
    }

    /// Inverse of the response of (across, angle) to impulses there.
    #[inline(always)]
    fn rigid_mass(&self, stride: &Stride<L>, pair: &Pair<L>) -> Symmetric<L> {
        let (ia, ib) = (pair.a[Slot::INV_INERTIA], pair.b[Slot::INV_INERTIA]);
        let angular = pair.inv_inertia();
        // Bodies that cannot turn keep their angle by themselves.
        let angular = L::select(angular.gt(stride.zero), angular, stride.one);
        let both = ia * self.across.arm_a + ib * self.across.arm_b;
        Symmetric::invert(stride, pair.inv_mass_along(&self.across), both, angular)
    }

    /// Response of (across, angle) to an impulse along.
    #[inline(always)]
    fn coupling(&self, pair: &Pair<L>) -> [L; 2] {
        let a = pair.a[Slot::INV_INERTIA] * self.along.arm_a;
        let b = pair.b[Slot::INV_INERTIA] * self.along.arm_b;
        [a * self.across.arm_a + b * self.across.arm_b, a + b]
    }
}

impl JointKernel for PrismaticBlock {
    fn axis(&self) -> Option<&AxisLanes> {
        Some(&self.axis)
    }

    fn tie(&self, stride: &Stride<f64>, pair: &Pair<f64>, link: &mut TreeLink) {
        let Rows { along, across } = Rows::new(pair, pair.direction(stride, &self.direction));
        link.hold(&across, dot(pair.gap, across.direction));
        link.hold(&Row::ANGLE, pair.angle(stride, &self.angle));
        link.let_go(&along, dot(pair.gap, along.direction));
    }

    fn told(&mut self) -> Option<[&mut [f32; BLOCK]; 2]> {
        Some([&mut self.direction.now_x, &mut self.direction.now_y])
    }

    fn describe(&mut self, lane: usize, def: &JointDef, rates: &Rates) {
        let JointKind::Prismatic { spring, target, limits, motor } = def.kind else { return };
        rates.write(def, None, &mut self.soft, lane);
        describe_angle(&mut self.angle, lane, def);
        describe_direction(&mut self.direction, lane, def);
        AxisDef { spring, target, limits, motor }.write(&mut self.axis, lane, rates);
    }

    #[inline(always)]
    fn prepare<L: Lanes>(&mut self, stride: &Stride<L>, start: &Start<L>, _: &[Pose]) {
        let angle = start.angle(stride, stride.load2(&self.angle.turn_c, &self.angle.turn_s));
        stride.store(angle, &mut self.angle.start);
        prepare_direction(stride, &mut self.direction, start);
    }

    #[inline(always)]
    fn warm_start<L: Lanes>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let direction = pair.direction(stride, &self.direction);
        let jacobians = Rows::new(pair, direction);
        let rigid = stride.load2(&self.rigid.impulse_x, &self.rigid.impulse_y);
        jacobians.apply(pair, self.axis.total(stride), rigid);
    }

    #[inline(always)]
    fn has_extras(&self) -> bool {
        self.axis.any_used()
    }

    #[inline(always)]
    fn solve<L: Lanes, const BIAS: bool>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let soft = Soft::load::<BIAS>(stride, &self.soft);
        let direction = pair.direction(stride, &self.direction);
        let jacobians = Rows::new(pair, direction);
        let old = stride.load2(&self.rigid.impulse_x, &self.rigid.impulse_y);
        let inverse = jacobians.rigid_mass(stride, pair);
        let velocity = [pair.velocity_along(&jacobians.across), pair.spin()];
        let angle = pair.angle(stride, &self.angle);
        let demand = [
            soft.hold(stride, velocity[0], dot(pair.gap, jacobians.across.direction), stride.snap),
            soft.hold(stride, velocity[1], angle, stride.snap_turn),
        ];
        let mut change = scale(inverse.apply(demand), -stride.one);
        let mut along = stride.zero;
        if stride.extras {
            let coupling = jacobians.coupling(pair);
            let per_along = inverse.apply(coupling);
            let free = pair.inv_mass_along(&jacobians.along);
            let least = free * stride.splat(LEAST_COMPLEMENT);
            let carried = add(old, scale(per_along, self.axis.total(stride)));
            let alone = sub(change, scale(carried, soft.impulse_scale));
            let coordinate = Coordinate {
                value: dot(pair.gap, direction),
                velocity: pair.velocity_along(&jacobians.along) + dot(coupling, alone),
                inv_mass: (free - dot(coupling, per_along)).max(least),
            };
            along = self.axis.solve::<L, BIAS>(stride, &soft, Give::sliding(stride), coordinate);
            change = sub(alone, scale(per_along, along));
        } else {
            change = sub(change, scale(old, soft.impulse_scale));
        }
        let impulse = add(old, change);
        stride.store2(impulse, &mut self.rigid.impulse_x, &mut self.rigid.impulse_y);
        jacobians.apply(pair, along, change);
        if !BIAS {
            stride.store2(direction, &mut self.direction.now_x, &mut self.direction.now_y);
        }
    }

    fn impulse(&self, lane: usize) -> (Vec2, f32) {
        let along = Vec2::new(self.direction.now_x[lane], self.direction.now_y[lane]);
        let force = along * self.axis.total_of(lane) + along.perp() * self.rigid.impulse_x[lane];
        (force, self.rigid.impulse_y[lane])
    }
}
