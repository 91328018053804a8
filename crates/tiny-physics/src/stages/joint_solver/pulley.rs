//! Pulley: a rope from A over two fixed points to B.
//!
//! ```text
//! room = length - |dA| - ratio |dB| >= 0,   u = d / |d|
//! J v = -uA . (vA + wA x rA) - ratio uB . (vB + wB x rB)
//! ```

use super::JointKernel;
use super::axis::{Give, solve_limit};
use super::distance::length_and_direction;
use super::parts::{Pair, Soft, Start, Stride, add, cross, dot, scale};
use super::spring::Rates;
use crate::describe::{JointDef, JointKind};
use crate::dynamics::{PulleyBlock, Slot};
use crate::math::{DVec2, Pose, Vec2};
use crate::simd::Lanes;
use crate::threads::SharedRows;

/// The rope as it is now: room, and what a unit of tension does to A and B.
struct Rope<L> {
    room: L,
    pull_a: [L; 2],
    pull_b: [L; 2],
    direction_b: [L; 2],
    arm_a: L,
    arm_b: L,
}

/// Length and direction from a fixed point to an anchor.
#[inline(always)]
fn from_ground<L: Lanes>(
    stride: &Stride<L>,
    body: &[L; 8],
    arm: [L; 2],
    anchor: [L; 2],
) -> (L, [L; 2]) {
    length_and_direction(stride, add(add(arm, [body[Slot::DX], body[Slot::DY]]), anchor))
}

impl PulleyBlock {
    #[inline(always)]
    fn rope<L: Lanes>(&self, stride: &Stride<L>, pair: &Pair<L>) -> Rope<L> {
        let rope = &self.rope;
        let (length_a, ua) =
            from_ground(stride, &pair.a, stride.load2(&rope.arm_a_x, &rope.arm_a_y), pair.anchor_a);
        let (length_b, ub) =
            from_ground(stride, &pair.b, stride.load2(&rope.arm_b_x, &rope.arm_b_y), pair.anchor_b);
        let ratio = stride.load(&rope.ratio);
        let (pull_a, pull_b) = (scale(ua, -stride.one), scale(ub, -ratio));
        Rope {
            room: stride.load(&rope.length) - length_a - ratio * length_b,
            pull_a,
            pull_b,
            direction_b: ub,
            arm_a: cross(pair.anchor_a, pull_a),
            arm_b: cross(pair.anchor_b, pull_b),
        }
    }
}

impl<L: Lanes> Rope<L> {
    #[inline(always)]
    fn velocity(&self, pair: &Pair<L>) -> L {
        let (a, b) = (&pair.a, &pair.b);
        dot(self.pull_a, [a[Slot::VX], a[Slot::VY]])
            + dot(self.pull_b, [b[Slot::VX], b[Slot::VY]])
            + self.arm_a * a[Slot::W]
            + self.arm_b * b[Slot::W]
    }

    #[inline(always)]
    fn inv_mass(&self, pair: &Pair<L>) -> L {
        let (a, b) = (&pair.a, &pair.b);
        a[Slot::INV_MASS] * dot(self.pull_a, self.pull_a)
            + b[Slot::INV_MASS] * dot(self.pull_b, self.pull_b)
            + a[Slot::INV_INERTIA] * self.arm_a * self.arm_a
            + b[Slot::INV_INERTIA] * self.arm_b * self.arm_b
    }

    #[inline(always)]
    fn apply(&self, pair: &mut Pair<L>, tension: L) {
        apply_each(pair, [self.pull_a, self.pull_b], [self.arm_a, self.arm_b], tension);
    }
}

/// Applies an impulse times directions and lever arms that each body has for itself.
#[inline(always)]
pub(super) fn apply_each<L: Lanes>(
    pair: &mut Pair<L>,
    directions: [[L; 2]; 2],
    arms: [L; 2],
    impulse: L,
) {
    apply_to(&mut pair.a, directions[0], arms[0], impulse);
    apply_to(&mut pair.b, directions[1], arms[1], impulse);
}

#[inline(always)]
fn apply_to<L: Lanes>(body: &mut [L; 8], direction: [L; 2], arm: L, impulse: L) {
    let linear = body[Slot::INV_MASS] * impulse;
    body[Slot::VX] = body[Slot::VX] + direction[0] * linear;
    body[Slot::VY] = body[Slot::VY] + direction[1] * linear;
    body[Slot::W] = body[Slot::W] + body[Slot::INV_INERTIA] * (arm * impulse);
}

impl JointKernel for PulleyBlock {
    fn describe(&mut self, lane: usize, def: &JointDef, rates: &Rates) {
        let JointKind::Pulley { ground_a, ground_b, length, ratio } = def.kind else { return };
        rates.write(def, None, &mut self.soft, lane);
        let rope = &mut self.rope;
        (rope.ground_a_x[lane], rope.ground_a_y[lane]) = (ground_a.x, ground_a.y);
        (rope.ground_b_x[lane], rope.ground_b_y[lane]) = (ground_b.x, ground_b.y);
        rope.ratio[lane] = ratio;
        rope.length[lane] = length;
    }

    #[inline(always)]
    fn prepare<L: Lanes>(&mut self, stride: &Stride<L>, _: &Start<L>, poses: &[Pose]) {
        let (frame, rope) = (&self.frame, &mut self.rope);
        for i in stride.at..stride.at + L::WIDTH {
            let ground_a = DVec2::new(rope.ground_a_x[i], rope.ground_a_y[i]);
            let ground_b = DVec2::new(rope.ground_b_x[i], rope.ground_b_y[i]);
            let a = poses[frame.body_a[i] as usize].p.relative_to(ground_a);
            let b = poses[frame.body_b[i] as usize].p.relative_to(ground_b);
            (rope.arm_a_x[i], rope.arm_a_y[i]) = (a.x, a.y);
            (rope.arm_b_x[i], rope.arm_b_y[i]) = (b.x, b.y);
        }
    }

    #[inline(always)]
    fn warm_start<L: Lanes>(&mut self, stride: &Stride<L>, rows: SharedRows<'_>) {
        let mut pair = Pair::load(stride, rows, &self.frame);
        let rope = self.rope(stride, &pair);
        rope.apply(&mut pair, stride.load(&self.rod.impulse));
        pair.store(stride, rows, &self.frame);
    }

    #[inline(always)]
    fn solve<L: Lanes, const BIAS: bool>(
        &mut self,
        stride: &Stride<L>,
        rows: SharedRows<'_>,
        _: bool,
    ) {
        let mut pair = Pair::load(stride, rows, &self.frame);
        let soft = Soft::load::<BIAS>(stride, &self.soft);
        let rope = self.rope(stride, &pair);
        let inv_mass = rope.inv_mass(&pair);
        let mass = stride.invert(inv_mass);
        let velocity = rope.velocity(&pair);
        let tension = &mut self.rod.impulse;
        let change = solve_limit::<L, BIAS>(
            stride,
            &soft,
            Give::rope(stride),
            tension,
            rope.room,
            [velocity, mass, inv_mass],
        );
        rope.apply(&mut pair, change);
        pair.store(stride, rows, &self.frame);
        if !BIAS {
            stride.store2(rope.direction_b, &mut self.rope.now_x, &mut self.rope.now_y);
        }
    }

    fn impulse(&self, lane: usize) -> (Vec2, f32) {
        let direction = Vec2::new(self.rope.now_x[lane], self.rope.now_y[lane]);
        (direction * (-self.rod.impulse[lane] * self.rope.ratio[lane]), 0.0)
    }
}
