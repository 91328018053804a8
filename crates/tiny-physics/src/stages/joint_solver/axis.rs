//! What acts along a joint's free coordinate: spring, motor, lower and upper limit, in this order.

use super::parts::{LEAST_COMPLEMENT, Soft, Stride, Symmetric, add, dot, scale, sub};
use super::spring::Rates;
use crate::describe::{Limits, Motor, Spring};
use crate::dynamics::{Axis, AxisLanes, UNLIMITED};
use crate::simd::Lanes;

/// A joint's free coordinate: metres or radians.
pub(super) struct Coordinate<L> {
    pub(super) value: L,
    pub(super) velocity: L,
    /// Velocity per impulse.
    pub(super) inv_mass: L,
}

/// Two rows that a joint holds.
pub(super) struct Held<L, const BIAS: bool> {
    /// Inverse of their response to impulses there.
    pub(super) inverse: Symmetric<L>,
    /// Velocities that they take away.
    pub(super) demand: [L; 2],
    /// How impulses decay.
    pub(super) soft: Soft<L, BIAS>,
    /// Accumulated impulses.
    pub(super) old: [L; 2],
    /// How they answer an impulse along the free coordinate.
    pub(super) coupling: [L; 2],
}

impl<L: Lanes, const BIAS: bool> Held<L, BIAS> {
    /// Changes of the impulses, together with that of what acts along the free coordinate.
    ///
    /// With K the rows' response and k their coupling, the coordinate's inverse mass given the rows is `m - k . K^-1 k`
    /// (Schur's complement). An impulse j along it goes with the impulse `-K^-1 k j` in the rows, which keeps their
    /// velocities. The decay of the soft rows is that of all impulses which act on them, `K p + k j`: with `K p` alone
    /// a cantilever of 3 m sagged by 3.9 mm instead of 0.07 mm.
    #[inline(always)]
    pub(super) fn solve(
        &self,
        stride: &Stride<L>,
        axis: &mut AxisLanes,
        coordinate: Coordinate<L>,
        give: Give<L, BIAS>,
    ) -> ([L; 2], L) {
        let alone = scale(self.inverse.apply(self.demand), -stride.one);
        if !stride.extras {
            return (self.soft.less(alone, self.old), stride.zero);
        }
        let per = self.inverse.apply(self.coupling);
        let alone = self.soft.less(alone, add(self.old, scale(per, axis.total(stride))));
        let velocity = coordinate.velocity + dot(self.coupling, alone);
        let inv_mass = complement(stride, coordinate.inv_mass, self.coupling, per);
        let coordinate = Coordinate { velocity, inv_mass, ..coordinate };
        let along = axis.solve(stride, give, coordinate);
        (sub(alone, scale(per, along)), along)
    }
}

/// Schur's complement of an inverse mass: what is left of it where rows with such a coupling take so much per impulse.
#[inline(always)]
pub(super) fn complement<L: Lanes>(
    stride: &Stride<L>,
    inv_mass: L,
    coupling: [L; 2],
    per: [L; 2],
) -> L {
    (inv_mass - dot(coupling, per)).max(inv_mass * stride.splat(LEAST_COMPLEMENT))
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
        let [push, mass_scale, impulse_scale, ease] = rates.spring(self.spring);
        axis.push[lane] = push;
        axis.mass_scale[lane] = mass_scale;
        axis.impulse_scale[lane] = impulse_scale;
        axis.ease[lane] = ease;
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
        // All of them, in lanes.
        self.used.iter().fold(false, |any, &used| any | (used != 0.0))
    }

    #[inline(always)]
    pub(super) fn load<L: Lanes>(&self, stride: &Stride<L>) -> Axis<L> {
        Axis {
            push: stride.load(&self.push),
            mass_scale: stride.load(&self.mass_scale),
            impulse_scale: stride.load(&self.impulse_scale),
            ease: stride.load(&self.ease),
            rest: stride.load(&self.rest),
            motor_speed: stride.load(&self.motor_speed),
            motor_max: stride.load(&self.motor_max),
            ends: stride.load2(&self.lower, &self.upper),
            spring: stride.load(&self.spring),
            motor: stride.load(&self.motor),
            limits: stride.load2(&self.lower_impulse, &self.upper_impulse),
        }
    }

    /// Sum of the accumulated impulses.
    #[inline(always)]
    pub(super) fn total<L: Lanes>(&self, stride: &Stride<L>) -> L {
        self.load(stride).total()
    }

    /// Sum of the accumulated impulses of one lane.
    pub(super) fn total_of(&self, lane: usize) -> f32 {
        self.spring[lane] + self.motor[lane] + self.lower_impulse[lane] - self.upper_impulse[lane]
    }

    /// The impulse to be added along the coordinate. Limits push back as `give` says.
    #[inline(always)]
    pub(super) fn solve<L: Lanes, const BIAS: bool>(
        &mut self,
        stride: &Stride<L>,
        give: Give<L, BIAS>,
        coordinate: Coordinate<L>,
    ) -> L {
        let Coordinate { value, mut velocity, inv_mass } = coordinate;
        let mass = stride.invert(inv_mass);
        let mut axis = self.load(stride);
        let spring = axis.pull::<BIAS>(value, &mut velocity, [mass, inv_mass]);
        let total = spring + axis.drive(&mut velocity, [mass, inv_mass]);
        stride.store(axis.spring, &mut self.spring);
        stride.store(axis.motor, &mut self.motor);
        let change = axis.stop(stride, give, value, [velocity, mass, inv_mass]);
        stride.store2(axis.limits, &mut self.lower_impulse, &mut self.upper_impulse);
        total + change
    }
}

impl<L: Lanes> Axis<L> {
    /// Sum of the accumulated impulses.
    #[inline(always)]
    pub(super) fn total(&self) -> L {
        self.spring + self.motor + self.limits[0] - self.limits[1]
    }

    /// What the spring changes in its impulse and in the velocity. With the mass and its inverse.
    #[inline(always)]
    pub(super) fn pull<const BIAS: bool>(
        &mut self,
        value: L,
        velocity: &mut L,
        [mass, inv_mass]: [L; 2],
    ) -> L {
        let change = if BIAS {
            let demand = self.mass_scale * *velocity + self.push * (value - self.rest);
            -(mass * demand) - self.impulse_scale * self.spring
        } else {
            -(mass * (self.ease * *velocity))
        };
        self.spring = self.spring + change;
        *velocity = *velocity + inv_mass * change;
        change
    }

    /// The same of the limits; with the coordinate's velocity, mass and inverse mass.
    #[inline(always)]
    pub(super) fn stop<const BIAS: bool>(
        &mut self,
        stride: &Stride<L>,
        give: Give<L, BIAS>,
        value: L,
        [velocity, mass, inv_mass]: [L; 3],
    ) -> L {
        let ([old_lower, old_upper], [lower, upper]) = (self.limits, self.ends);
        let motion = [velocity, mass, inv_mass];
        let at_lower = give.solve(stride, old_lower, value - lower, motion);
        let change = at_lower - old_lower;
        let motion = [-(velocity + inv_mass * change), mass, inv_mass];
        let at_upper = give.solve(stride, old_upper, upper - value, motion);
        self.limits = [at_lower, at_upper];
        change - (at_upper - old_upper)
    }

    /// The same of the motor.
    ///
    /// It sees the velocity that would be without the limits: against one that holds it gives no more than it
    /// needs to be held, and the two do not wind each other up.
    #[inline(always)]
    pub(super) fn drive(&mut self, velocity: &mut L, [mass, inv_mass]: [L; 2]) -> L {
        let held = self.limits[0] - self.limits[1];
        let motor = [self.motor_speed, self.motor_max, self.motor];
        let motor = drive(motor, *velocity - inv_mass * held, mass);
        let change = motor - self.motor;
        self.motor = motor;
        *velocity = *velocity + inv_mass * change;
        change
    }
}

/// The impulse of a motor, from its speed, its greatest impulse and that so far: none where nothing moves.
#[inline(always)]
pub(super) fn drive<L: Lanes>([speed, max, old]: [L; 3], velocity: L, mass: L) -> L {
    let old = L::select(mass.gt(-mass), old, mass);
    (old + mass * (speed - velocity)).clamp(-max, max)
}

/// Overrun of a limit, radians or metres, that is pushed back softly; what is beyond goes within a substep. Soft
/// limits alone let a ragdoll that is hit at 50 m/s bend its joints 9.5 degrees too far; with firm ones alone
/// ragdolls that lay on each other never came to rest.
const SOFT_OVERRUN: f32 = 0.003;
/// Overrun over which what is soft becomes firm, radians or length units. At once, no load between the two has a balance: limbs that lie on
/// each other chatter, and 7 of 216 pits of ragdolls sleep after more than 6 seconds, up to 17. This way it is 1 of them.
const SPREAD: f32 = 0.02;

/// Factor on a firm push, of which neighbours take a part back: 1 leaves that ragdoll 2.3 degrees beyond, 1.5 1.8.
const FIRMNESS: f32 = 1.5;
/// How many times the usual way a limit of an angle may turn back in a substep: what is hit hard needs it, what lies in a
/// heap of 40 or more would rest sooner without.
const TURN_BACK: f32 = 40.0;
/// Overrun of an angle at which that is over, radians: no hit bends so far. What was moved or made out of its limits comes in slowly enough
/// for what is in its way to be seen.
const BENT: f32 = 0.2;

/// How limits give way.
#[derive(Clone, Copy)]
pub(super) struct Give<L, const BIAS: bool> {
    /// As softly as their joint, or their part of it.
    soft: Soft<L, BIAS>,
    /// Speed at which an overrun is taken back, besides that with which it comes and what the limit stops already: a
    /// ragdoll that is hit needs more than one that lies in a heap.
    snap: L,
    /// So much faster close to the limit, and how that fades over an overrun.
    haste: L,
    fade: L,
    /// 1, or 0 where it bears nothing, and so gives way.
    bears: L,
    /// Overrun beyond which it is pushed back more firmly than softly, and that over which it becomes quite firm.
    overrun: L,
    spread: L,
    /// The part of its impulse that it lets go of at least.
    yields: L,
}

impl<L: Lanes, const BIAS: bool> Give<L, BIAS> {
    /// Limits of angles.
    #[inline(always)]
    pub(super) fn turning(stride: &Stride<L>, soft: Soft<L, BIAS>) -> Self {
        Self {
            snap: stride.snap_turn,
            haste: stride.snap_turn * stride.splat(TURN_BACK - 1.0),
            fade: stride.splat(1.0 / BENT),
            bears: stride.one,
            overrun: soft.overrun(stride, stride.splat(SOFT_OVERRUN)),
            spread: stride.splat(SPREAD),
            yields: stride.zero,
            soft,
        }
    }

    /// Limits of places.
    #[inline(always)]
    pub(super) fn sliding(stride: &Stride<L>, soft: Soft<L, BIAS>, yields: L) -> Self {
        let turning = Self::turning(stride, soft);
        let (overrun, spread) = (stride.unit * turning.overrun, stride.unit * turning.spread);
        let fade = turning.fade / stride.unit;
        Self { snap: stride.snap, haste: stride.zero, fade, overrun, spread, yields, ..turning }
    }

    /// The same where something stands in its way. If a door that begins beyond its limits behind a peg bears half of what it has borne, it
    /// goes a millimetre deeper; if all, through.
    #[inline(always)]
    pub(super) fn blocked(self, stride: &Stride<L>) -> Self {
        Self { haste: stride.zero, bears: stride.zero, ..self }
    }

    /// Ropes, never firm: a net of 900 whips itself to 26 m/s with firm ones. In time they have to follow a net that
    /// swings: with a snap of once the usual its fastest knot has 0.3 m/s after half a minute, with four times 0.08.
    #[inline(always)]
    pub(super) fn rope(stride: &Stride<L>, soft: Soft<L, BIAS>, yields: L) -> Self {
        let snap = stride.snap * stride.splat(4.0);
        let [haste, fade] = [stride.zero; 2];
        let (overrun, [spread, bears]) = (stride.splat(f32::MAX), [stride.one; 2]);
        Self { snap, haste, fade, bears, overrun, spread, yields, soft }
    }

    /// The impulse of one limit: it pushes only, and stops within the substep what would run over it.
    #[inline(always)]
    pub(super) fn solve(
        &self,
        stride: &Stride<L>,
        old: L,
        room: L,
        [velocity, mass, inv_mass]: [L; 3],
    ) -> L {
        let soft = &self.soft;
        let apart = room.gt(stride.zero);
        let impulse = if BIAS {
            let (soft_push, firm_push) = (soft.push * room, (room + self.overrun) * stride.inv_h);
            let near = (stride.one + room * self.fade).clamp(stride.zero, stride.one);
            let snap = self.snap + self.haste * near;
            let borne = self.bears * L::select(self.yields.gt(stride.zero), stride.zero, old);
            let least = velocity.min(stride.zero) - inv_mass * borne - snap;
            let push = firm_push.min(soft_push).max(least);
            // Only a soft push takes part of the velocity, and of what was pushed before.
            let firm = (soft_push - firm_push) / (self.spread * stride.inv_h);
            let firm = self.bears * firm.clamp(stride.zero, stride.one);
            let share = soft.mass_scale + firm * (stride.one - soft.mass_scale);
            let yields = self.yields.max(stride.one - self.bears);
            let decay = soft.impulse_scale.max(yields) * old;
            let mass = mass * (stride.one + firm * stride.splat(FIRMNESS - 1.0));
            let bias = L::select(apart, room * stride.inv_h, push);
            let velocity = L::select(apart, velocity, share * velocity);
            old - mass * (velocity + bias) - L::select(apart, stride.zero, decay)
        } else {
            let bias = L::select(apart, room * stride.inv_h, stride.zero);
            old - mass * (velocity + bias)
        };
        impulse.max(stride.zero)
    }
}
