//! What the kernels of contacts work on: the parameters in lanes, and the two bodies of each lane.

use super::{Parameters, Softness};
use crate::dynamics::{ConstraintBlock, Slot, inverse_mass_along, locked};
use crate::simd::{BLOCK, Lanes};
use crate::threads::SharedRows;

/// The parameters in lanes.
pub(in crate::stages) struct Constants<L> {
    pub(in crate::stages) zero: L,
    pub(in crate::stages) inv_h: L,
    pub(in crate::stages) push: L,
    pub(in crate::stages) push_rate: L,
    pub(in crate::stages) fast: L,
    pub(in crate::stages) soft: [L; 3],
    pub(in crate::stages) static_soft: [L; 3],
}

impl<L: Lanes> Constants<L> {
    #[inline(always)]
    pub(in crate::stages) fn new(token: L::Token, parameters: &Parameters) -> Self {
        let splat = |value| L::splat(token, value);
        let soft = |s: Softness| {
            [splat(s.bias_rate * s.mass_scale), splat(s.mass_scale), splat(s.impulse_scale)]
        };
        Self {
            zero: splat(0.0),
            inv_h: splat(parameters.inv_h),
            push: splat(-parameters.push_speed),
            push_rate: splat(parameters.push_rate),
            fast: splat(-parameters.fast_approach),
            soft: soft(parameters.soft),
            static_soft: soft(parameters.static_soft),
        }
    }
}

/// Where in a block a kernel works, and on what rows.
pub(super) struct Stride<'a, L: Lanes> {
    pub(super) token: L::Token,
    pub(super) rows: SharedRows<'a>,
    pub(super) at: usize,
    pub(super) constants: &'a Constants<L>,
}

impl<L: Lanes> Stride<'_, L> {
    #[inline(always)]
    pub(super) fn load(&self, lanes: &[f32; BLOCK]) -> L {
        L::load(self.token, &lanes[self.at..])
    }

    #[inline(always)]
    pub(super) fn store(&self, value: L, lanes: &mut [f32; BLOCK]) {
        value.store(&mut lanes[self.at..]);
    }
}

/// The two bodies of each lane's contact, and its normal.
#[derive(Clone, Copy)]
pub(super) struct Pair<L: Lanes> {
    pub(super) token: L::Token,
    pub(super) a: [L; 8],
    pub(super) b: [L; 8],
    pub(super) normal: [L; 2],
    /// Inverse masses of A and B along x and y, where some are locked along one of them.
    pub(super) locked: Option<[[L; 2]; 2]>,
}

impl<L: Lanes> Pair<L> {
    #[inline(always)]
    pub(super) fn load(stride: &Stride<'_, L>, block: &ConstraintBlock) -> Self {
        let mut a = L::gather(stride.token, stride.rows, &block.body_a[stride.at..]);
        let mut b = L::gather(stride.token, stride.rows, &block.body_b[stride.at..]);
        let normal = [stride.load(&block.normal_x), stride.load(&block.normal_y)];
        let locked = locked(stride.token, [&mut a, &mut b]);
        Self { token: stride.token, a, b, normal, locked }
    }

    /// Writes the velocities back, except to bodies that nothing moves.
    #[inline(always)]
    pub(super) fn store(self, stride: &Stride<'_, L>, block: &ConstraintBlock) {
        self.store_only(stride, block, ALL_BODIES);
    }

    /// The same for the lanes in `only`; for A, the ground as a rule, not at all where none of it moves.
    #[inline(always)]
    pub(super) fn store_only(
        self,
        stride: &Stride<'_, L>,
        block: &ConstraintBlock,
        only: (u32, u32),
    ) {
        let zero = stride.constants.zero;
        let mask =
            |body: &[L; 8]| L::bits(zero.lt(body[Slot::INV_MASS].abs() + body[Slot::INV_INERTIA]));
        let (write_a, write_b) = (mask(&self.a) & only.0, mask(&self.b) & only.1);
        let half = |body: [L; 8]| [body[0], body[1], body[2], body[3]];
        if write_a != 0 {
            L::scatter(half(self.a), stride.rows, &block.body_a[stride.at..], write_a);
        }
        L::scatter(half(self.b), stride.rows, &block.body_b[stride.at..], write_b);
    }

    /// Relative velocity of a point along the normal.
    #[inline(always)]
    pub(super) fn normal_velocity(&self, arm_a: L, arm_b: L) -> L {
        let (a, b) = (&self.a, &self.b);
        self.normal[0] * (b[Slot::VX] - a[Slot::VX])
            + self.normal[1] * (b[Slot::VY] - a[Slot::VY])
            + (arm_b * b[Slot::W] - arm_a * a[Slot::W])
    }

    /// Relative velocity of a point along the tangent: the normal turned clockwise.
    #[inline(always)]
    pub(super) fn tangent_velocity(&self, arm_a: L, arm_b: L) -> L {
        let (a, b) = (&self.a, &self.b);
        self.normal[1] * (b[Slot::VX] - a[Slot::VX]) - self.normal[0] * (b[Slot::VY] - a[Slot::VY])
            + (arm_b * b[Slot::W] - arm_a * a[Slot::W])
    }

    /// Separation now: that of the step's start plus the motion since.
    #[inline(always)]
    pub(super) fn separation(&self, start: L, arm_a: L, arm_b: L) -> L {
        let (a, b) = (&self.a, &self.b);
        start
            + (self.normal[0] * (b[Slot::DX] - a[Slot::DX])
                + self.normal[1] * (b[Slot::DY] - a[Slot::DY]))
            + (arm_b * b[Slot::DA] - arm_a * a[Slot::DA])
    }

    /// Velocity along the normal per impulse along it.
    #[inline(always)]
    pub(super) fn response(&self, arm_a: L, arm_b: L) -> L {
        let [mass_a, mass_b] = self.inverse_masses();
        mass_a
            + mass_b
            + self.a[Slot::INV_INERTIA] * arm_a * arm_a
            + self.b[Slot::INV_INERTIA] * arm_b * arm_b
    }

    /// Inverse masses of A and B along the normal.
    #[inline(always)]
    pub(super) fn inverse_masses(&self) -> [L; 2] {
        let Self { token, normal, .. } = *self;
        match self.locked {
            None => [self.a[Slot::INV_MASS], self.b[Slot::INV_MASS]],
            Some([a, b]) => {
                [inverse_mass_along(token, normal, a), inverse_mass_along(token, normal, b)]
            }
        }
    }

    /// Applies an impulse along the normal.
    #[inline(always)]
    pub(super) fn push(&mut self, impulse: L, arm_a: L, arm_b: L) {
        self.apply([self.normal[0] * impulse, self.normal[1] * impulse], impulse, arm_a, arm_b);
    }

    /// Applies an impulse along the tangent.
    #[inline(always)]
    pub(super) fn rub(&mut self, impulse: L, arm_a: L, arm_b: L) {
        self.apply([self.normal[1] * impulse, -(self.normal[0] * impulse)], impulse, arm_a, arm_b);
    }

    #[inline(always)]
    pub(super) fn apply(&mut self, linear: [L; 2], impulse: L, arm_a: L, arm_b: L) {
        let (a, b) = (&mut self.a, &mut self.b);
        a[Slot::W] = a[Slot::W] - a[Slot::INV_INERTIA] * (arm_a * impulse);
        b[Slot::W] = b[Slot::W] + b[Slot::INV_INERTIA] * (arm_b * impulse);
        let Some([free_a, free_b]) = &self.locked else {
            for k in [Slot::VX, Slot::VY] {
                a[k] = a[k] - a[Slot::INV_MASS] * linear[k];
                b[k] = b[k] + b[Slot::INV_MASS] * linear[k];
            }
            return;
        };
        for k in [Slot::VX, Slot::VY] {
            a[k] = a[k] - free_a[k] * linear[k];
            b[k] = b[k] + free_b[k] * linear[k];
        }
    }

    /// Softness of each lane: that against static bodies where one of the two has no mass.
    #[inline(always)]
    pub(super) fn softness(&self, constants: &Constants<L>) -> [L; 3] {
        let [mass_a, mass_b] = self.inverse_masses();
        let fixed = L::or(mass_a.eq(constants.zero), mass_b.eq(constants.zero));
        let choose = |k: usize| L::select(fixed, constants.static_soft[k], constants.soft[k]);
        [choose(0), choose(1), choose(2)]
    }
}

/// Lanes whose bodies A and B are written: all that can move.
pub(super) const ALL_BODIES: (u32, u32) = (u32::MAX, u32::MAX);
