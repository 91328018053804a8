//! Friction and rolling resistance.

use super::pair::{Pair, Stride};
use crate::dynamics::{ConstraintBlock, PointLanes, Slot, SurfaceBlock};
use crate::simd::{BLOCK, Lanes};

/// Tangent impulses of all points, within their friction cones. `belt` is the speed of the surface, if any moves.
///
/// Two points are rubbed from the same velocity, each by its part of the load: one after the other the first would take what it
/// can, and a scene would not go as its mirror image, whose points come in the other order.
///
/// `slips` are, for a hit, the speeds along the tangent with which its points came, times restitution e. Newton's rule that normal speeds
/// go from u to -e u makes energy with friction where the normal impulse turns the slip round (Kane's paradox). It makes none where
/// impulses P and speeds u before and v after are such that `P . (e u + v) <= 0`: with v = u + K P the work
/// `P . (u + v) / 2` is then at most `-(1 - e) / (1 + e) P . K P / 2`. So along the tangent, too: friction
/// may push on the way that a point came as far as its slip is turned to -e times what it was.
#[inline(always)]
pub(super) fn solve_friction<L: Lanes, const POINTS: usize>(
    stride: &Stride<'_, L>,
    pair: &mut Pair<L>,
    points: &mut [PointLanes; 2],
    friction: L,
    belt: Option<&[f32; BLOCK]>,
    slips: Option<&[[f32; BLOCK]; 2]>,
) {
    let one = L::splat(stride.token, 1.0);
    let mut parts = [one; 2];
    if POINTS == 2 {
        let loads = [stride.load(&points[0].load), stride.load(&points[1].load)];
        let all = loads[0] + loads[1];
        parts[0] = loads[0] / L::select(all.gt(stride.constants.zero), all, one);
        parts[1] = one - parts[0];
    }
    let was = *pair;
    for (k, (point, part)) in points.iter_mut().zip(parts).take(POINTS).enumerate() {
        let (arm_a, arm_b) = (stride.load(&point.tangent_arm_a), stride.load(&point.tangent_arm_b));
        let old = stride.load(&point.tangent_impulse);
        let mut velocity = was.tangent_velocity(arm_a, arm_b);
        if let Some(belt) = belt {
            velocity = velocity + stride.load(belt);
        }
        let limit = friction * stride.load(&point.load);
        let mass = stride.load(&point.tangent_mass);
        let mut impulse = old - mass * (part * velocity);
        if let Some(slips) = slips {
            let zero = stride.constants.zero;
            let turned = mass * (part * stride.load(&slips[k]));
            impulse = impulse - turned.clamp(impulse.min(zero), impulse.max(zero));
        }
        let impulse = impulse.clamp(-limit, limit);
        stride.store(impulse, &mut point.tangent_impulse);
        pair.rub(impulse - old, arm_a, arm_b);
    }
}

/// Angular impulse against rolling, limited by resistance * normal impulse.
#[inline(always)]
pub(super) fn solve_rolling<L: Lanes, const POINTS: usize>(
    stride: &Stride<'_, L>,
    pair: &mut Pair<L>,
    block: &ConstraintBlock,
    surface: &mut SurfaceBlock,
) {
    let zero = stride.constants.zero;
    let mut normal = zero;
    for point in &block.points[..POINTS] {
        normal = normal + stride.load(&point.load);
    }
    let inverse = pair.a[Slot::INV_INERTIA] + pair.b[Slot::INV_INERTIA];
    let one = L::splat(stride.token, 1.0);
    let mass = L::select(inverse.gt(zero), one / inverse, zero);
    let old = stride.load(&surface.rolling_impulse);
    let limit = stride.load(&surface.rolling_resistance) * normal;
    let spin = pair.b[Slot::W] - pair.a[Slot::W];
    let impulse = (old - mass * spin).clamp(-limit, limit);
    stride.store(impulse, &mut surface.rolling_impulse);
    roll(pair, impulse - old);
}

#[inline(always)]
pub(super) fn roll<L: Lanes>(pair: &mut Pair<L>, impulse: L) {
    pair.a[Slot::W] = pair.a[Slot::W] - pair.a[Slot::INV_INERTIA] * impulse;
    pair.b[Slot::W] = pair.b[Slot::W] + pair.b[Slot::INV_INERTIA] * impulse;
}
