//! What acts along a joint's free coordinate: spring, motor, lower and upper limit, in this order.

use super::parts::{Soft, Stride};
use super::spring::Rates;
use crate::describe::{Limits, Motor, Spring};
use crate::dynamics::{AxisLanes, UNLIMITED};
use crate::simd::Lanes;

/// A joint's free coordinate: metres or radians.
pub(super) struct Coordinate<L> {
    pub(super) value: L,
    pub(super) velocity: L,
    /// Velocity per impulse.
    pub(super) inv_mass: L,
}

/// Spring, its rest, limits and motor of a description.
pub(super) struct AxisDef {
    pub(super) spring: Option<Spring>,
    pub(super) target: f32,
    pub(super) limits: Option<Limits>,
    pub(super) motor: Option<Motor>,
}

impl AxisDef {
    /// Writes the lanes of one joint.
    pub(super) fn write(&self, axis: &mut AxisLanes, lane: usize, rates: &Rates) {
        let used = self.spring.is_some() || self.limits.is_some() || self.motor.is_some();
        axis.used[lane] = if used { 1.0 } else { 0.0 };
        let [push, mass_scale, impulse_scale] = rates.spring(self.spring);
        axis.push[lane] = push;
        axis.mass_scale[lane] = mass_scale;
        axis.impulse_scale[lane] = impulse_scale;
        axis.target[lane] = self.target;
        axis.rest[lane] = self.target;
        axis.motor_speed[lane] = self.motor.map_or(0.0, |motor| motor.speed);
        axis.motor_max[lane] = self.motor.map_or(0.0, |motor| motor.max * rates.h);
        axis.lower[lane] = self.limits.map_or(-UNLIMITED, |limits| limits.lower);
        axis.upper[lane] = self.limits.map_or(UNLIMITED, |limits| limits.upper);
        if self.spring.is_none() {
            axis.spring[lane] = 0.0;
        }
        if self.motor.is_none() {
            axis.motor[lane] = 0.0;
        }
        if self.limits.is_none() {
            axis.lower_impulse[lane] = 0.0;
            axis.upper_impulse[lane] = 0.0;
        }
    }
}

impl AxisLanes {
    /// Some lane has a spring, motor or limit.
    #[inline(always)]
    pub(super) fn any_used(&self) -> bool {
        self.used.iter().any(|&used| used != 0.0)
    }

    /// Sum of the accumulated impulses.
    #[inline(always)]
    pub(super) fn total<L: Lanes>(&self, stride: &Stride<L>) -> L {
        stride.load(&self.spring) + stride.load(&self.motor) + stride.load(&self.lower_impulse)
            - stride.load(&self.upper_impulse)
    }

    /// Sum of the accumulated impulses of one lane.
    pub(super) fn total_of(&self, lane: usize) -> f32 {
        self.spring[lane] + self.motor[lane] + self.lower_impulse[lane] - self.upper_impulse[lane]
    }

    /// The impulse to be added along the coordinate. `soft` is that of limits.
    #[inline(always)]
    pub(super) fn solve<L: Lanes, const BIAS: bool>(
        &mut self,
        stride: &Stride<L>,
        soft: &Soft<L>,
        coordinate: Coordinate<L>,
    ) -> L {
        let Coordinate { value, mut velocity, inv_mass } = coordinate;
        let mass = stride.invert(inv_mass);
        let mut total = stride.zero;
        if BIAS {
            let spring = Soft {
                push: stride.load(&self.push),
                mass_scale: stride.load(&self.mass_scale),
                impulse_scale: stride.load(&self.impulse_scale),
            };
            let old = stride.load(&self.spring);
            let demand = spring.demand(velocity, value - stride.load(&self.rest));
            let change = -(mass * demand) - spring.impulse_scale * old;
            stride.store(old + change, &mut self.spring);
            velocity = velocity + inv_mass * change;
            total = total + change;
        }
        let change = self.solve_motor(stride, velocity, mass);
        velocity = velocity + inv_mass * change;
        total = total + change;

        let room = value - stride.load(&self.lower);
        let change =
            solve_limit::<L, BIAS>(stride, soft, &mut self.lower_impulse, room, velocity, mass);
        velocity = velocity + inv_mass * change;
        total = total + change;

        let room = stride.load(&self.upper) - value;
        let change =
            solve_limit::<L, BIAS>(stride, soft, &mut self.upper_impulse, room, -velocity, mass);
        total - change
    }

    #[inline(always)]
    fn solve_motor<L: Lanes>(&mut self, stride: &Stride<L>, velocity: L, mass: L) -> L {
        let max = stride.load(&self.motor_max);
        let old = stride.load(&self.motor);
        let missing = stride.load(&self.motor_speed) - velocity;
        let impulse = (old + mass * missing).clamp(-max, max);
        stride.store(impulse, &mut self.motor);
        impulse - old
    }
}

/// One limit: it pushes only, and stops within the substep what would run over it.
#[inline(always)]
pub(super) fn solve_limit<L: Lanes, const BIAS: bool>(
    stride: &Stride<L>,
    soft: &Soft<L>,
    accumulated: &mut [f32; crate::simd::BLOCK],
    room: L,
    velocity: L,
    mass: L,
) -> L {
    let old = stride.load(accumulated);
    let apart = room.gt(stride.zero);
    let bias =
        L::select(apart, room * stride.inv_h, if BIAS { soft.push * room } else { stride.zero });
    let impulse = if BIAS {
        let velocity = L::select(apart, velocity, soft.mass_scale * velocity);
        let decay = L::select(apart, stride.zero, soft.impulse_scale * old);
        old - mass * (velocity + bias) - decay
    } else {
        old - mass * (velocity + bias)
    };
    let impulse = impulse.max(stride.zero);
    stride.store(impulse, accumulated);
    impulse - old
}
