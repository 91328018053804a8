//! Wheel: B stays on a line of A and turns freely; suspension along the line, motor on the turning.
//!
//! Rows as in [`prismatic`](super::prismatic) without the angle: n . d = 0 is rigid, u . d is the free
//! coordinate with spring and limits. The motor is a row of its own, solved first.

use super::JointKernel;
use super::axis::{AxisDef, Coordinate, Give, drive};
use super::parts::{LEAST_COMPLEMENT, Pair, Row, Soft, Start, Stride, add, dot, perp, scale};
use super::prismatic::{describe_direction, prepare_direction};
use super::spring::Rates;
use crate::describe::{JointDef, JointKind};
use crate::dynamics::{AxisLanes, MotorLanes, Slot, TreeLink, WheelBlock};
use crate::math::{Pose, Vec2};
use crate::simd::{BLOCK, Lanes};

/// Applies impulses along and across the line, and angular.
#[inline(always)]
fn apply<L: Lanes>(pair: &mut Pair<L>, rows: [&Row<L>; 2], impulses: [L; 2], angular: L) {
    pair.apply(
        add(scale(rows[0].direction, impulses[0]), scale(rows[1].direction, impulses[1])),
        rows[0].arm_a * impulses[0] + rows[1].arm_a * impulses[1] + angular,
        rows[0].arm_b * impulses[0] + rows[1].arm_b * impulses[1] + angular,
    );
}

impl WheelBlock {
    /// Change of the motor's impulse.
    #[inline(always)]
    fn solve_motor<L: Lanes>(&mut self, stride: &Stride<L>, pair: &Pair<L>) -> L {
        let old = stride.load(&self.motor.impulse);
        let max = stride.load(&self.motor.max);
        let speed = stride.load(&self.motor.speed);
        let mass = stride.invert(pair.inv_inertia());
        let impulse = drive([speed, max, old], pair.spin(), mass);
        stride.store(impulse, &mut self.motor.impulse);
        impulse - old
    }
}

impl JointKernel for WheelBlock {
    fn axis(&self) -> Option<&AxisLanes> {
        Some(&self.axis)
    }

    fn motor(&self) -> Option<&MotorLanes> {
        Some(&self.motor)
    }

    fn tie(&self, stride: &Stride<f64>, pair: &Pair<f64>, link: &mut TreeLink) {
        let direction = pair.direction(stride, &self.direction);
        let across = pair.row_on_a(perp(direction));
        link.hold(&across, dot(pair.gap, across.direction));
        link.let_go(&pair.row_on_a(direction), dot(pair.gap, direction));
    }

    fn told(&mut self) -> Option<[&mut [f32; BLOCK]; 2]> {
        Some([&mut self.direction.now_x, &mut self.direction.now_y])
    }

    fn describe(&mut self, lane: usize, def: &JointDef, rates: &Rates) {
        let JointKind::Wheel { spring, limits, motor } = def.kind else { return };
        rates.write(def, None, &mut self.soft, lane);
        describe_direction(&mut self.direction, lane, def);
        self.motor.speed[lane] = motor.map_or(0.0, |motor| motor.speed);
        self.motor.max[lane] = motor.map_or(0.0, |motor| motor.max * rates.h);
        AxisDef { spring, target: 0.0, limits, motor: None }.write(&mut self.axis, lane, rates);
    }

    #[inline(always)]
    fn prepare<L: Lanes>(&mut self, stride: &Stride<L>, start: &Start<L>, _: &[Pose]) {
        prepare_direction(stride, &mut self.direction, start);
    }

    #[inline(always)]
    fn warm_start<L: Lanes>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let direction = pair.direction(stride, &self.direction);
        let along = pair.row_on_a(direction);
        let across = pair.row_on_a(perp(direction));
        let impulses = [self.axis.total(stride), stride.load(&self.rod.impulse)];
        apply(pair, [&along, &across], impulses, stride.load(&self.motor.impulse));
    }

    #[inline(always)]
    fn has_extras(&self) -> bool {
        self.axis.any_used()
    }

    #[inline(always)]
    fn solve<L: Lanes, const BIAS: bool>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let motor = self.solve_motor(stride, pair);
        pair.apply([stride.zero; 2], motor, motor);

        let soft = Soft::load::<BIAS>(stride, &self.soft);
        let direction = pair.direction(stride, &self.direction);
        let across = pair.row_on_a(perp(direction));
        let along = pair.row_on_a(direction);
        let old = stride.load(&self.rod.impulse);
        let mass = stride.invert(pair.inv_mass_along(&across));
        let demand = soft.hold(
            stride,
            pair.velocity_along(&across),
            dot(pair.gap, across.direction),
            stride.snap,
        );
        let mut change = -(mass * demand);
        let mut slide = stride.zero;
        if stride.extras {
            let coupling = pair.a[Slot::INV_INERTIA] * along.arm_a * across.arm_a
                + pair.b[Slot::INV_INERTIA] * along.arm_b * across.arm_b;
            let per_slide = mass * coupling;
            let free = pair.inv_mass_along(&along);
            let least = free * stride.splat(LEAST_COMPLEMENT);
            let carried = old + per_slide * self.axis.total(stride);
            change = change - soft.impulse_scale * carried;
            let coordinate = Coordinate {
                value: dot(pair.gap, direction),
                velocity: pair.velocity_along(&along) + coupling * change,
                inv_mass: (free - coupling * per_slide).max(least),
            };
            slide = self.axis.solve::<L, BIAS>(stride, &soft, Give::sliding(stride), coordinate);
            change = change - per_slide * slide;
        } else {
            change = change - soft.impulse_scale * old;
        }
        stride.store(old + change, &mut self.rod.impulse);
        apply(pair, [&along, &across], [slide, change], stride.zero);
        if !BIAS {
            stride.store2(direction, &mut self.direction.now_x, &mut self.direction.now_y);
        }
    }

    fn impulse(&self, lane: usize) -> (Vec2, f32) {
        let along = Vec2::new(self.direction.now_x[lane], self.direction.now_y[lane]);
        let force = along * self.axis.total_of(lane) + along.perp() * self.rod.impulse[lane];
        (force, self.motor.impulse[lane])
    }
}
