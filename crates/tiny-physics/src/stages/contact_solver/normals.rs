//! Normal impulses: one point, or both of a manifold at once.

use super::pair::{Constants, Pair, Stride};
use crate::dynamics::{ConstraintBlock, PointLanes, Slot};
use crate::simd::Lanes;

/// Normal impulses of all points; gives the accumulated ones.
#[inline(always)]
pub(super) fn solve_normals<L: Lanes, const POINTS: usize, const BIAS: bool>(
    stride: &Stride<'_, L>,
    pair: &mut Pair<L>,
    block: &mut ConstraintBlock,
    soft: [L; 3],
    rests: [L; 2],
) -> [L; 2] {
    if POINTS == 2 {
        solve_both::<L, BIAS>(stride, pair, block, soft, rests)
    } else {
        let impulse = solve_normal::<L, BIAS>(stride, pair, &mut block.points[0], soft, rests[0]);
        [impulse, stride.constants.zero]
    }
}

/// Normal impulse of one point; gives the accumulated impulse.
#[inline(always)]
fn solve_normal<L: Lanes, const BIAS: bool>(
    stride: &Stride<'_, L>,
    pair: &mut Pair<L>,
    point: &mut PointLanes,
    soft: [L; 3],
    rest: L,
) -> L {
    let (arm_a, arm_b) = (stride.load(&point.normal_arm_a), stride.load(&point.normal_arm_b));
    let mass = stride.load(&point.normal_mass);
    let old = stride.load(&point.normal_impulse);
    let s = pair.separation(stride.load(&point.separation), arm_a, arm_b);
    let velocity = pair.normal_velocity(arm_a, arm_b);
    let impulse = normal_impulse::<L, BIAS>(stride.constants, soft, [s, velocity, rest], mass, old);
    stride.store(impulse, &mut point.normal_impulse);
    pair.push(impulse - old, arm_a, arm_b);
    impulse
}

/// The accumulated impulse of a point by itself, from its separation and relative velocity, effective mass and impulse so far.
#[inline(always)]
pub(in crate::stages) fn normal_impulse<L: Lanes, const BIAS: bool>(
    constants: &Constants<L>,
    [bias_rate, mass_scale, impulse_scale]: [L; 3],
    [s, velocity, rest]: [L; 3],
    mass: L,
    old: L,
) -> L {
    let apart = s.gt(constants.zero);
    let impulse = if BIAS {
        let rigid = L::or(apart, velocity.lt(constants.fast));
        let velocity = L::select(rigid, velocity, mass_scale * velocity);
        let decay = impulse_scale * old;
        // What carries the load is not bounded.
        let bound = (constants.push_rate * s).max(constants.push);
        let push = (mass * (bias_rate * (s - rest))).max(mass * bound - decay);
        let (push, decay) = (
            L::select(apart, mass * (s * constants.inv_h), push),
            L::select(apart, constants.zero, decay),
        );
        old - mass * velocity - push - decay
    } else {
        let bias = L::select(apart, s * constants.inv_h, constants.zero);
        old - relaxed(constants, apart, mass, old) * (velocity + bias)
    };
    impulse.max(constants.zero)
}

/// Effective mass of a point in the relax pass. What is apart and has not pushed is left to the next substep: it may be
/// the first of the next step, in which the point bounces from the speed that it has now.
#[inline(always)]
fn relaxed<L: Lanes>(constants: &Constants<L>, apart: L::Mask, mass: L, old: L) -> L {
    L::select(L::and(apart, old.eq(constants.zero)), constants.zero, mass)
}

/// Normal impulses of both points at once: a stack stands as straight as it was built.
///
/// With K the points' response, G = K11, K22 * impulse_scale / mass_scale on the diagonal (the softness;
/// nothing where a point is apart) and A = K + G, the new impulses p solve the linear complementarity
/// problem `p >= 0, A p + q >= 0, p (A p + q) = 0` with `q = v + bias / mass_scale - K p_old`. Both push,
/// or one, or none. Points so close to each other that A is nearly singular (determinant below
/// [`LEAST_DETERMINANT`] of the diagonal's product), and single points, go one after the other.
#[inline(always)]
fn solve_both<L: Lanes, const BIAS: bool>(
    stride: &Stride<'_, L>,
    pair: &mut Pair<L>,
    block: &mut ConstraintBlock,
    [push_rate, mass_scale, _]: [L; 3],
    rests: [L; 2],
) -> [L; 2] {
    let one = L::splat(stride.token, 1.0);
    let inv_scale = if BIAS { one / mass_scale } else { one };
    let soft = [push_rate, mass_scale, inv_scale];
    // No closures: they are built without the lanes' instructions.
    let first = Normal::load::<BIAS>(stride, pair, &block.points[0], soft, rests[0]);
    let normals = [first, Normal::load::<BIAS>(stride, pair, &block.points[1], soft, rests[1])];
    Normal::solve_both(&normals, stride, pair, block, LEAST_DETERMINANT)
}

/// Determinants below this part of the diagonal's product count as singular: card houses, whose points
/// are 2 mm apart, fall at 0.001.
const LEAST_DETERMINANT: f32 = 0.01;

/// One of two points as [`solve_both`] needs it.
pub(super) struct Normal<L> {
    pub(super) arm_a: L,
    pub(super) arm_b: L,
    pub(super) old: L,
    /// Diagonal of A, and its inverse; zero where there is no point.
    pub(super) diagonal: L,
    pub(super) mass: L,
    /// v + bias / mass_scale - K p_old, without the other point's part.
    pub(super) demand: L,
}

impl<L: Lanes> Normal<L> {
    /// Solves the complementarity problem of both points of a manifold and applies the impulses; gives these. Points whose
    /// determinant is below that part of the diagonal's product go one after the other.
    #[inline(always)]
    pub(super) fn solve_both(
        [first, second]: &[Self; 2],
        stride: &Stride<'_, L>,
        pair: &mut Pair<L>,
        block: &mut ConstraintBlock,
        least_determinant: f32,
    ) -> [L; 2] {
        let zero = stride.constants.zero;
        let one = L::splat(stride.token, 1.0);
        let k12 = {
            let [mass_a, mass_b] = pair.inverse_masses();
            let inv_mass = mass_a + mass_b;
            let (turn_a, turn_b) = (first.arm_a * second.arm_a, first.arm_b * second.arm_b);
            inv_mass + pair.a[Slot::INV_INERTIA] * turn_a + pair.b[Slot::INV_INERTIA] * turn_b
        };
        let q = [first.demand - k12 * second.old, second.demand - k12 * first.old];
        let product = first.diagonal * second.diagonal;
        let determinant = product - k12 * k12;
        let least = L::splat(stride.token, least_determinant) * product;
        let exist = L::and(first.mass.gt(zero), second.mass.gt(zero));
        let sound = L::and(exist, determinant.gt(least));
        let inverse = one / L::select(sound, determinant, one);
        let both = [
            (k12 * q[1] - second.diagonal * q[0]) * inverse,
            (k12 * q[0] - first.diagonal * q[1]) * inverse,
        ];
        let both_push = L::and(zero.le(both[0]), zero.le(both[1]));
        let alone = [(-(first.mass * q[0])).max(zero), (-(second.mass * q[1])).max(zero)];
        let first_holds = zero.le(q[1] + k12 * alone[0]);
        let alone =
            [L::select(first_holds, alone[0], zero), L::select(first_holds, zero, alone[1])];
        let turn_1 = (-(first.mass * (q[0] + k12 * second.old))).max(zero);
        let turn_2 = (-(second.mass * (q[1] + k12 * turn_1))).max(zero);

        let choose = |k: usize, in_turn: L| {
            L::select(sound, L::select(both_push, both[k], alone[k]), in_turn)
        };
        let impulses = [choose(0, turn_1), choose(1, turn_2)];
        for (k, normal) in [first, second].into_iter().enumerate() {
            stride.store(impulses[k], &mut block.points[k].normal_impulse);
            pair.push(impulses[k] - normal.old, normal.arm_a, normal.arm_b);
        }
        impulses
    }

    #[inline(always)]
    fn load<const BIAS: bool>(
        stride: &Stride<'_, L>,
        pair: &Pair<L>,
        point: &PointLanes,
        [push_rate, mass_scale, inv_scale]: [L; 3],
        rest: L,
    ) -> Self {
        let constants = stride.constants;
        let (arm_a, arm_b) = (stride.load(&point.normal_arm_a), stride.load(&point.normal_arm_b));
        let k = pair.response(arm_a, arm_b);
        let (mass, old) = (stride.load(&point.normal_mass), stride.load(&point.normal_impulse));
        let s = pair.separation(stride.load(&point.separation), arm_a, arm_b);
        let velocity = pair.normal_velocity(arm_a, arm_b);
        let apart = s.gt(constants.zero);
        let gap = s * constants.inv_h;
        if !BIAS {
            let bias = L::select(apart, gap, constants.zero);
            return Self {
                arm_a,
                arm_b,
                old,
                diagonal: k,
                mass: relaxed(constants, apart, mass, old),
                demand: velocity + bias - k * old,
            };
        }
        let rigid = L::or(apart, velocity.lt(constants.fast));
        // What carries the load is not bounded.
        let carry = k * inv_scale - k;
        let bound = (constants.push_rate * s).max(constants.push);
        let push = (push_rate * (s - rest) * inv_scale).max(bound - carry * old);
        Self {
            arm_a,
            arm_b,
            old,
            diagonal: L::select(rigid, k, k * inv_scale),
            mass: L::select(rigid, mass, mass * mass_scale),
            demand: velocity + L::select(apart, gap, push) - k * old,
        }
    }
}
