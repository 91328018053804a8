//! Pulley: a rope from A over two fixed points to B.
//!
//! ```text
//! room = length - |dA| - ratio |dB| >= 0,   u = d / |d|
//! J v = -uA . (vA + wA x rA) - ratio uB . (vB + wB x rB)
//! ```

use super::JointKernel;
use super::axis::Give;
use super::distance::length_and_direction;
use super::parts::{Pair, Sides, Soft, Start, Stride, add, cross, scale};
use super::spring::Rates;
use crate::describe::{JointDef, JointKind};
use crate::dynamics::{PulleyBlock, Slot};
use crate::math::{DVec2, Pose, Vec2};
use crate::simd::Lanes;

/// The rope as it is now.
struct Rope<L> {
    room: L,
    /// What a unit of tension does to A and B.
    pull: Sides<L>,
    direction_b: [L; 2],
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
        let arms = [cross(pair.anchor_a, pull_a), cross(pair.anchor_b, pull_b)];
        Rope {
            room: stride.load(&rope.length) - length_a - ratio * length_b,
            pull: Sides { directions: [pull_a, pull_b], arms },
            direction_b: ub,
        }
    }
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
    fn warm_start<L: Lanes>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let rope = self.rope(stride, pair);
        rope.pull.apply(pair, stride.load(&self.rod.impulse));
    }

    #[inline(always)]
    fn solve<L: Lanes, const BIAS: bool>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>) {
        let soft = Soft::<L, BIAS>::load(stride, &self.soft);
        let rope = self.rope(stride, pair);
        let inv_mass = rope.pull.inv_mass(pair);
        let mass = stride.invert(inv_mass);
        let velocity = rope.pull.velocity(pair);
        let old = stride.load(&self.rod.impulse);
        let motion = [velocity, mass, inv_mass];
        let tension = Give::rope(stride, soft, stride.zero).solve(stride, old, rope.room, motion);
        stride.store(tension, &mut self.rod.impulse);
        rope.pull.apply(pair, tension - old);
        if !BIAS {
            stride.store2(rope.direction_b, &mut self.rope.now_x, &mut self.rope.now_y);
        }
    }

    fn impulse(&self, lane: usize) -> (Vec2, f32) {
        let direction = Vec2::new(self.rope.now_x[lane], self.rope.now_y[lane]);
        (direction * (-self.rod.impulse[lane] * self.rope.ratio[lane]), 0.0)
    }
}
