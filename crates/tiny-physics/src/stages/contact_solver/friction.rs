//! Friction and rolling resistance.

use super::pair::{Pair, Stride};
use crate::dynamics::{ConstraintBlock, PointLanes, Slot, SurfaceBlock};
use crate::simd::{BLOCK, Lanes};

/// Tangent impulse of one point, within the friction cone. `belt` is the speed of the surface, if any moves.
#[inline(always)]
pub(super) fn solve_friction<L: Lanes>(
    stride: &Stride<'_, L>,
    pair: &mut Pair<L>,
    point: &mut PointLanes,
    friction: L,
    belt: Option<&[f32; BLOCK]>,
) {
    let (arm_a, arm_b) = (stride.load(&point.tangent_arm_a), stride.load(&point.tangent_arm_b));
    let old = stride.load(&point.tangent_impulse);
    let mut velocity = pair.tangent_velocity(arm_a, arm_b);
    if let Some(belt) = belt {
        velocity = velocity + stride.load(belt);
    }
    let limit = friction * stride.load(&point.load);
    let impulse = (old - stride.load(&point.tangent_mass) * velocity).clamp(-limit, limit);
    stride.store(impulse, &mut point.tangent_impulse);
    pair.rub(impulse - old, arm_a, arm_b);
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
