//! Slider: B slides along a direction of A; a prismatic joint does not turn against it, a wheel does, with a motor.
//!
//! ```text
//! d = xB + rB - xA - rA,   u the direction, n across it
//! C = (n . d, aB - aA),    J v = (n . (vB - vA) + (rB x n) wB - ((d + rA) x n) wA, wB - wA)
//! coordinate u . d,        J v = u . (vB - vA) + (rB x u) wB - ((d + rA) x u) wA
//! ```
//!
//! The coordinate's inverse mass is Schur's complement of the rows that are held. The angle of a wheel is not: in its
//! row acts the motor, solved first.

use super::JointKernel;
use super::axis::{AxisDef, Coordinate, Give, Held, drive};
use super::parts::{
    Pair, Row, Soft, Start, Stride, Symmetric, add, describe_angle, dot, perp, rotate, scale, sub,
};
use super::spring::Rates;
use crate::describe::{JointDef, JointKind};
use crate::dynamics::{AxisLanes, SliderBlock, Slot, TreeLink, UNLIMITED};
use crate::math::{Pose, Rot, Vec2};
use crate::simd::{BLOCK, Lanes};

/// So far beside its line what slides is torn, length units.
const ASTRAY: f32 = 0.5;

/// The Jacobians as they are now.
struct Rows<L> {
    along: Row<L>,
    across: Row<L>,
}

impl<L: Lanes> Rows<L> {
    /// On no longer arms than [`ASTRAY`] beside the line and beyond the limits where something keeps the bodies there: on longer ones
    /// they come to spin at any speed. Others need their own, which keep momentum.
    #[inline(always)]
    fn new(stride: &Stride<L>, pair: &Pair<L>, block: &SliderBlock) -> Self {
        let direction = pair.direction(stride, &block.direction);
        let across = perp(direction);
        let held = stride.load(&block.frame.yields).gt(stride.zero);
        let most = L::select(held, stride.unit * stride.splat(ASTRAY), stride.splat(UNLIMITED));
        let [lower, upper] = stride.load2(&block.axis.lower, &block.axis.upper);
        let [along, beside] = [dot(pair.gap, direction), dot(pair.gap, across)];
        let beyond = along - along.clamp(lower - most, upper + most);
        let astray = beside - beside.clamp(-most, most);
        let torn = add(scale(direction, beyond), scale(across, astray));
        let arm = sub(add(pair.gap, pair.anchor_a), torn);
        Self { along: pair.row(arm, direction), across: pair.row(arm, across) }
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

    /// Inverse of the response of (across, angle) to impulses there; of (across) alone where the angle is not held.
    #[inline(always)]
    fn rigid_mass(&self, stride: &Stride<L>, pair: &Pair<L>, held: L) -> Symmetric<L> {
        let (ia, ib) = (pair.a[Slot::INV_INERTIA], pair.b[Slot::INV_INERTIA]);
        let angular = pair.inv_inertia();
        let angular = L::select(angular.gt(stride.zero), angular, stride.one);
        let both = held * (ia * self.across.arm_a + ib * self.across.arm_b);
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

impl SliderBlock {
    /// What lies far beside its line by itself starts anew in each substep: its bodies turn on arms as long as that, and old impulses on arms
    /// that have turned since make them spin ever faster.
    #[inline(always)]
    fn forget_torn<L: Lanes>(&mut self, stride: &Stride<L>, error: L) {
        let far = stride.unit * stride.splat(ASTRAY);
        let held = stride.load(&self.frame.yields).gt(stride.zero);
        let torn = L::select(held, stride.zero, error.abs()).gt(far);
        if L::bits(torn) == 0 {
            return;
        }
        let (rigid, AxisLanes { spring, motor, lower_impulse, upper_impulse, .. }) =
            (&mut self.rigid, &mut self.axis);
        let [x, y] = [&mut rigid.impulse_x, &mut rigid.impulse_y];
        for lanes in [x, y, spring, motor, lower_impulse, upper_impulse] {
            stride.store(L::select(torn, stride.zero, stride.load(lanes)), lanes);
        }
    }

    /// Change of the impulses of wheels' motors.
    #[inline(always)]
    fn solve_motor<L: Lanes>(&mut self, stride: &Stride<L>, pair: &Pair<L>, wheel: L) -> L {
        let old = stride.load(&self.rigid.impulse_y);
        let [speed, max] = stride.load2(&self.wheel.speed, &self.wheel.max);
        let impulse = drive([speed, max, old], pair.spin(), stride.invert(pair.inv_inertia()));
        let change = wheel * (impulse - old);
        stride.store(old + change, &mut self.rigid.impulse_y);
        change
    }
}

impl JointKernel for SliderBlock {
    #[inline(always)]
    fn axis(&self) -> Option<&AxisLanes> {
        Some(&self.axis)
    }

    fn motor(&self, lane: usize) -> Option<[f32; 3]> {
        let wheel = &self.wheel;
        let motor = [wheel.speed[lane], wheel.max[lane], self.rigid.impulse_y[lane]];
        (wheel.turns[lane] != 0.0).then_some(motor)
    }

    fn tie(&self, stride: &Stride<f64>, pair: &Pair<f64>, link: &mut TreeLink) {
        let Rows { along, across } = Rows::new(stride, pair, self);
        link.hold(&across, dot(pair.gap, across.direction));
        if self.wheel.turns[stride.at] == 0.0 {
            link.hold(&Row::ANGLE, pair.angle(stride, &self.angle));
        }
        link.let_go(&along, dot(pair.gap, along.direction));
    }

    fn told(&mut self) -> Option<[&mut [f32; BLOCK]; 2]> {
        Some([&mut self.direction.now_x, &mut self.direction.now_y])
    }

    fn describe(&mut self, lane: usize, def: &JointDef, rates: &Rates) {
        let (axis, wheel) = match def.kind {
            JointKind::Prismatic { spring, target, limits, motor } => {
                (AxisDef { spring, target, limits, motor }, None)
            }
            JointKind::Wheel { spring, limits, motor } => {
                (AxisDef { spring, target: 0.0, limits, motor: None }, Some(motor))
            }
            _ => return,
        };
        axis.write(&mut self.axis, lane, rates);
        let motor = wheel.flatten();
        self.wheel.turns[lane] = if wheel.is_some() { 1.0 } else { 0.0 };
        self.wheel.speed[lane] = motor.map_or(0.0, |motor| motor.speed);
        self.wheel.max[lane] = motor.map_or(0.0, |motor| motor.max * rates.h);
        rates.write(def, None, &mut self.soft, lane);
        describe_angle(&mut self.angle, lane, def);
        let direction = Rot::from_angle(def.angle_a);
        (self.direction.local_x[lane], self.direction.local_y[lane]) = (direction.c, direction.s);
    }

    fn give<const BIAS: bool>(&self, stride: &Stride<f64>) -> Option<Give<f64, BIAS>> {
        Some(Give::sliding(stride, Soft::load(stride, &self.soft), stride.zero))
    }

    #[inline(always)]
    fn prepare<L: Lanes>(&mut self, stride: &Stride<L>, start: &Start<L>, _: &[Pose]) {
        start.prepare_angle(stride, &mut self.angle);
        let lanes = &mut self.direction;
        let local = stride.load2(&lanes.local_x, &lanes.local_y);
        stride.store2(rotate(start.turn_a, local), &mut lanes.x, &mut lanes.y);
    }

    #[inline(always)]
    fn off<L: Lanes>(&self, stride: &Stride<L>, gap: [L; 2]) -> [L; 2] {
        let direction = stride.load2(&self.direction.x, &self.direction.y);
        let along = dot(gap, direction);
        let within = along.clamp(stride.load(&self.axis.lower), stride.load(&self.axis.upper));
        sub(gap, scale(direction, within))
    }

    #[inline(always)]
    fn warm_start<L: Lanes>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let jacobians = Rows::new(stride, pair, self);
        self.forget_torn(stride, dot(pair.gap, jacobians.across.direction));
        let rigid = stride.load2(&self.rigid.impulse_x, &self.rigid.impulse_y);
        jacobians.apply(pair, self.axis.total(stride), rigid);
    }

    #[inline(always)]
    fn solve<L: Lanes, const BIAS: bool>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let wheel = stride.load(&self.wheel.turns);
        if L::bits(wheel.gt(stride.zero)) != 0 {
            let motor = self.solve_motor(stride, pair, wheel);
            pair.apply([stride.zero; 2], motor, motor);
        }
        // Bodies that cannot turn keep their angle by themselves.
        let turns = L::select(pair.inv_inertia().gt(stride.zero), stride.one, stride.zero);
        let held = turns * (stride.one - wheel);
        let soft = Soft::<L, BIAS>::load(stride, &self.soft);
        let jacobians = Rows::new(stride, pair, self);
        let direction = jacobians.along.direction;
        let [across, angular] = stride.load2(&self.rigid.impulse_x, &self.rigid.impulse_y);
        let angular = turns * angular;
        let error = dot(pair.gap, jacobians.across.direction);
        let angle = pair.angle(stride, &self.angle);
        let [on_axis, on_angle] = jacobians.coupling(pair);
        let yields = stride.load(&self.frame.yields);
        let turned = soft.part(stride, held * angle, stride.snap_turn);
        let beside = soft.part(stride, error, stride.snap);
        let rigid = soft.in_part(beside.min(turned)).yielding(yields);
        let rows = Held {
            inverse: jacobians.rigid_mass(stride, pair, held),
            demand: [
                rigid.demand(pair.velocity_along(&jacobians.across), error),
                held * rigid.demand(pair.spin(), angle),
            ],
            soft: rigid,
            old: [across, held * angular],
            coupling: [on_axis, held * on_angle],
        };
        let coordinate = Coordinate {
            value: dot(pair.gap, direction),
            velocity: pair.velocity_along(&jacobians.along),
            inv_mass: pair.inv_mass_along(&jacobians.along),
        };
        let give = Give::sliding(stride, soft, yields);
        let (change, along) = rows.solve(stride, &mut self.axis, coordinate, give);
        let impulse = add([across, angular], change);
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
