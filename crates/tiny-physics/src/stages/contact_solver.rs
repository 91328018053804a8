//! The contact solver: soft-step sequential impulses over blocks of one colour.
//!
//! A contact point resists approach along its normal with a soft constraint: at separation s <= 0
//! it behaves as a damped spring of given hertz and damping ratio, implicitly integrated (softness
//! after Catto, "Soft Constraints", 2011, and "Solver2D", 2024); at s > 0 it only keeps the gap from
//! closing within the substep (speculative). With normal velocity vn, effective mass m and
//! accumulated impulse p:
//!
//! ```text
//! dp = -m * (mass_scale * (vn + bias)) - impulse_scale * p,   p' = max(p + dp, 0)
//! ```
//!
//! Friction acts in the relax pass only, with |tangent impulse| <= friction * normal impulse. The
//! separation follows the motion since the start of the step to first order: lever arms stay those
//! of the start, so that a point is twenty floats and a pass is a straight line.
//!
//! Within a colour, order does not matter; colours go in order. The same functions serve as lanes
//! and, one lane wide, for the overflow.

use crate::dynamics::{BlockHead, Bucket, ConstraintBlock, PointLanes, Slot, SurfaceBlock, flags};
use crate::math::Vec2;
use crate::simd::{BLOCK, LaneKernel, Lanes, SimdLevel, dispatch};
use crate::threads::{SharedRows, SharedSlice, Team};

/// Coefficients of a soft constraint for one substep length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Softness {
    pub(crate) bias_rate: f32,
    pub(crate) mass_scale: f32,
    pub(crate) impulse_scale: f32,
}

impl Softness {
    /// No spring at all: the constraint is solved exactly.
    pub(crate) const RIGID: Self = Self { bias_rate: 0.0, mass_scale: 1.0, impulse_scale: 0.0 };

    /// With omega = 2 pi hertz: a1 = 2 zeta + h omega, a2 = h omega a1, a3 = 1 / (1 + a2).
    pub(crate) fn new(hertz: f32, damping_ratio: f32, h: f32) -> Self {
        if hertz <= 0.0 {
            return Self::RIGID;
        }
        let omega = 2.0 * core::f32::consts::PI * hertz;
        let a1 = 2.0 * damping_ratio + h * omega;
        let a2 = h * omega * a1;
        let a3 = 1.0 / (1.0 + a2);
        Self { bias_rate: omega / a1, mass_scale: a2 * a3, impulse_scale: a3 }
    }
}

/// What all contacts of a step have in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parameters {
    /// 1 / substep length.
    pub(crate) inv_h: f32,
    /// Between moving bodies.
    pub(crate) soft: Softness,
    /// Against bodies that nothing moves.
    pub(crate) static_soft: Softness,
    /// Greatest push-out speed, metres a second.
    pub(crate) push_speed: f32,
    /// Rate at which overlap beyond what the load accounts for is pushed out, 1 / second.
    pub(crate) push_rate: f32,
    /// Overlaps that close in faster than this are solved without softness, metres a second.
    pub(crate) fast_approach: f32,
    /// Approach below this does not bounce, metres a second.
    pub(crate) restitution_threshold: f32,
    /// Metres a second squared.
    pub(crate) gravity: Vec2,
    /// Lengths of substep and step, seconds.
    pub(crate) h: f32,
    pub(crate) dt: f32,
}

/// One of the passes of a substep (or, for restitution, of the step).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pass {
    /// In the first substep: impulses of the step before.
    WarmStart,
    /// In later substeps: impulses of the substep before, on bodies with joints alone; see
    /// [`integrate::velocities`](super::integrate::velocities).
    WarmStartJointed,
    Solve,
    Relax,
    AimBounce,
    Bounce,
}

/// Blocks that one member of the team solves at a time.
const CHUNK: usize = 8;

/// Runs a pass over a bucket of one colour, in lanes. `points` is 1 for the classes that never have a
/// second point.
pub(crate) fn run(
    team: &Team,
    level: SimdLevel,
    pass: Pass,
    parameters: &Parameters,
    rows: SharedRows<'_>,
    bucket: &mut Bucket,
    points: usize,
) {
    let block_count = bucket.constraints.len();
    let constraints = SharedSlice::new(&mut bucket.constraints);
    let surfaces = SharedSlice::new(&mut bucket.surfaces);
    let heads = &bucket.heads;
    team.for_each_chunk(block_count, CHUNK, |range| {
        let blocks = Blocks {
            constraints: constraints.range(range.clone()),
            surfaces: surfaces.range(range.clone()),
            heads: &heads[range],
        };
        run_blocks(level, RunPass { pass, parameters, rows, blocks }, points);
    });
}

/// Runs a pass over a bucket of the overflow: the one-lane instance, contact after contact.
pub(crate) fn run_in_order(
    pass: Pass,
    parameters: &Parameters,
    rows: SharedRows<'_>,
    bucket: &mut Bucket,
    points: usize,
) {
    let blocks = Blocks {
        constraints: &mut bucket.constraints,
        surfaces: &mut bucket.surfaces,
        heads: &bucket.heads,
    };
    run_blocks(SimdLevel::Scalar, RunPass { pass, parameters, rows, blocks }, points);
}

fn run_blocks(level: SimdLevel, work: RunPass<'_>, points: usize) {
    if points == 1 {
        dispatch(level, Points::<1, _>(work));
    } else {
        dispatch(level, Points::<2, _>(work));
    }
}

/// A run of blocks of one colour and class.
struct Blocks<'a> {
    constraints: &'a mut [ConstraintBlock],
    surfaces: &'a mut [SurfaceBlock],
    heads: &'a [BlockHead],
}

struct RunPass<'a> {
    pass: Pass,
    parameters: &'a Parameters,
    rows: SharedRows<'a>,
    blocks: Blocks<'a>,
}

struct Points<const POINTS: usize, W>(W);

impl<const POINTS: usize> LaneKernel for Points<POINTS, RunPass<'_>> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, token: L::Token) {
        let RunPass { pass, parameters, rows, blocks } = self.0;
        let constants = Constants::<L>::new(token, parameters);
        for (index, block) in blocks.constraints.iter_mut().enumerate() {
            let head = blocks.heads[index];
            let flags = head.flags;
            if pass == Pass::WarmStartJointed && head.jointed_a | head.jointed_b == 0 {
                continue;
            }
            let surface = &mut blocks.surfaces[index];
            for at in (0..BLOCK).step_by(L::WIDTH) {
                let stride = Stride { token, rows, at, constants: &constants };
                match pass {
                    Pass::WarmStart => {
                        warm_start::<L, POINTS>(&stride, block, surface, flags, ALL_BODIES);
                    }
                    Pass::WarmStartJointed => {
                        let jointed =
                            (u32::from(head.jointed_a) >> at, u32::from(head.jointed_b) >> at);
                        warm_start::<L, POINTS>(&stride, block, surface, flags, jointed);
                    }
                    Pass::Solve => solve::<L, POINTS>(&stride, block, surface, flags),
                    Pass::Relax => relax::<L, POINTS>(&stride, block, surface, flags),
                    Pass::AimBounce => aim_bounce::<L, POINTS>(&stride, block, surface, flags),
                    Pass::Bounce => bounce::<L, POINTS>(&stride, block, surface, flags),
                }
            }
        }
    }
}

/// The parameters in lanes.
struct Constants<L> {
    zero: L,
    inv_h: L,
    push: L,
    push_rate: L,
    fast: L,
    soft: [L; 3],
    static_soft: [L; 3],
    threshold: L,
    gravity: [L; 2],
    half_h: L,
    dt: L,
}

impl<L: Lanes> Constants<L> {
    #[inline(always)]
    fn new(token: L::Token, parameters: &Parameters) -> Self {
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
            threshold: splat(-parameters.restitution_threshold),
            gravity: [splat(parameters.gravity.x), splat(parameters.gravity.y)],
            half_h: splat(0.5 * parameters.h),
            dt: splat(parameters.dt),
        }
    }
}

/// Where in a block a kernel works, and on what rows.
struct Stride<'a, L: Lanes> {
    token: L::Token,
    rows: SharedRows<'a>,
    at: usize,
    constants: &'a Constants<L>,
}

impl<L: Lanes> Stride<'_, L> {
    #[inline(always)]
    fn load(&self, lanes: &[f32; BLOCK]) -> L {
        L::load(self.token, &lanes[self.at..])
    }

    #[inline(always)]
    fn store(&self, value: L, lanes: &mut [f32; BLOCK]) {
        value.store(&mut lanes[self.at..]);
    }
}

/// The two bodies of each lane's contact, and its normal.
struct Pair<L: Lanes> {
    a: [L; 8],
    b: [L; 8],
    normal: [L; 2],
}

impl<L: Lanes> Pair<L> {
    #[inline(always)]
    fn load(stride: &Stride<'_, L>, block: &ConstraintBlock) -> Self {
        Self {
            a: L::gather(stride.token, stride.rows, &block.body_a[stride.at..]),
            b: L::gather(stride.token, stride.rows, &block.body_b[stride.at..]),
            normal: [stride.load(&block.normal_x), stride.load(&block.normal_y)],
        }
    }

    /// Writes the velocities back, except to bodies that nothing moves.
    #[inline(always)]
    fn store(self, stride: &Stride<'_, L>, block: &ConstraintBlock) {
        self.store_only(stride, block, ALL_BODIES);
    }

    /// The same for the lanes in `only`.
    #[inline(always)]
    fn store_only(self, stride: &Stride<'_, L>, block: &ConstraintBlock, only: (u32, u32)) {
        let zero = stride.constants.zero;
        let mask = |body: &[L; 8]| L::bits(zero.lt(body[Slot::INV_MASS] + body[Slot::INV_INERTIA]));
        let (write_a, write_b) = (mask(&self.a) & only.0, mask(&self.b) & only.1);
        let half = |body: [L; 8]| [body[0], body[1], body[2], body[3]];
        L::scatter(half(self.a), stride.rows, &block.body_a[stride.at..], write_a);
        L::scatter(half(self.b), stride.rows, &block.body_b[stride.at..], write_b);
    }

    /// Relative velocity of a point along the normal.
    #[inline(always)]
    fn normal_velocity(&self, arm_a: L, arm_b: L) -> L {
        let (a, b) = (&self.a, &self.b);
        self.normal[0] * (b[Slot::VX] - a[Slot::VX])
            + self.normal[1] * (b[Slot::VY] - a[Slot::VY])
            + (arm_b * b[Slot::W] - arm_a * a[Slot::W])
    }

    /// Relative velocity of a point along the tangent: the normal turned clockwise.
    #[inline(always)]
    fn tangent_velocity(&self, arm_a: L, arm_b: L) -> L {
        let (a, b) = (&self.a, &self.b);
        self.normal[1] * (b[Slot::VX] - a[Slot::VX]) - self.normal[0] * (b[Slot::VY] - a[Slot::VY])
            + (arm_b * b[Slot::W] - arm_a * a[Slot::W])
    }

    /// Separation now: that of the step's start plus the motion since.
    #[inline(always)]
    fn separation(&self, start: L, arm_a: L, arm_b: L) -> L {
        let (a, b) = (&self.a, &self.b);
        start
            + (self.normal[0] * (b[Slot::DX] - a[Slot::DX])
                + self.normal[1] * (b[Slot::DY] - a[Slot::DY]))
            + (arm_b * b[Slot::DA] - arm_a * a[Slot::DA])
    }

    /// Applies an impulse along the normal.
    #[inline(always)]
    fn push(&mut self, impulse: L, arm_a: L, arm_b: L) {
        self.apply([self.normal[0] * impulse, self.normal[1] * impulse], impulse, arm_a, arm_b);
    }

    /// Applies an impulse along the tangent.
    #[inline(always)]
    fn rub(&mut self, impulse: L, arm_a: L, arm_b: L) {
        self.apply([self.normal[1] * impulse, -(self.normal[0] * impulse)], impulse, arm_a, arm_b);
    }

    #[inline(always)]
    fn apply(&mut self, linear: [L; 2], impulse: L, arm_a: L, arm_b: L) {
        let (a, b) = (&mut self.a, &mut self.b);
        a[Slot::VX] = a[Slot::VX] - a[Slot::INV_MASS] * linear[0];
        a[Slot::VY] = a[Slot::VY] - a[Slot::INV_MASS] * linear[1];
        a[Slot::W] = a[Slot::W] - a[Slot::INV_INERTIA] * (arm_a * impulse);
        b[Slot::VX] = b[Slot::VX] + b[Slot::INV_MASS] * linear[0];
        b[Slot::VY] = b[Slot::VY] + b[Slot::INV_MASS] * linear[1];
        b[Slot::W] = b[Slot::W] + b[Slot::INV_INERTIA] * (arm_b * impulse);
    }

    /// Softness of each lane: that against static bodies where one of the two has no mass.
    #[inline(always)]
    fn softness(&self, constants: &Constants<L>) -> [L; 3] {
        let fixed = L::or(
            self.a[Slot::INV_MASS].eq(constants.zero),
            self.b[Slot::INV_MASS].eq(constants.zero),
        );
        let choose = |k: usize| L::select(fixed, constants.static_soft[k], constants.soft[k]);
        [choose(0), choose(1), choose(2)]
    }
}

/// Lanes whose bodies A and B are written: all that can move.
const ALL_BODIES: (u32, u32) = (u32::MAX, u32::MAX);

/// Applies the impulses of the substep before to the bodies of the lanes in `only`.
#[inline(always)]
fn warm_start<L: Lanes, const POINTS: usize>(
    stride: &Stride<'_, L>,
    block: &mut ConstraintBlock,
    surface: &mut SurfaceBlock,
    flags: u8,
    only: (u32, u32),
) {
    let mut pair = Pair::load(stride, block);
    for point in &block.points[..POINTS] {
        let normal_arms = [stride.load(&point.normal_arm_a), stride.load(&point.normal_arm_b)];
        let tangent_arms = [stride.load(&point.tangent_arm_a), stride.load(&point.tangent_arm_b)];
        pair.push(stride.load(&point.normal_impulse), normal_arms[0], normal_arms[1]);
        pair.rub(stride.load(&point.tangent_impulse), tangent_arms[0], tangent_arms[1]);
    }
    if flags & flags::ROLLING != 0 {
        let impulse = stride.load(&surface.rolling_impulse);
        roll(&mut pair, impulse);
    }
    pair.store_only(stride, block, only);
}

/// Normal impulses with bias.
#[inline(always)]
fn solve<L: Lanes, const POINTS: usize>(
    stride: &Stride<'_, L>,
    block: &mut ConstraintBlock,
    surface: &mut SurfaceBlock,
    flags: u8,
) {
    let mut pair = Pair::load(stride, block);
    let soft = pair.softness(stride.constants);
    let impulses = solve_normals::<L, POINTS, true>(stride, &mut pair, block, soft);
    if flags & (flags::RESTITUTION | flags::HIT) != 0 {
        let peaks = [&mut surface.peak_1, &mut surface.peak_2];
        for (peak, impulse) in peaks.into_iter().zip(impulses).take(POINTS) {
            stride.store(stride.load(peak).max(impulse), peak);
        }
    }
    pair.store(stride, block);
}

/// Normal impulses of all points; gives the accumulated ones.
#[inline(always)]
fn solve_normals<L: Lanes, const POINTS: usize, const BIAS: bool>(
    stride: &Stride<'_, L>,
    pair: &mut Pair<L>,
    block: &mut ConstraintBlock,
    soft: [L; 3],
) -> [L; 2] {
    if POINTS == 2 {
        solve_both::<L, BIAS>(stride, pair, block, soft)
    } else {
        let impulse = solve_normal::<L, BIAS>(stride, pair, &mut block.points[0], soft);
        [impulse, stride.constants.zero]
    }
}

/// Normal impulse of one point; gives the accumulated impulse.
#[inline(always)]
fn solve_normal<L: Lanes, const BIAS: bool>(
    stride: &Stride<'_, L>,
    pair: &mut Pair<L>,
    point: &mut PointLanes,
    [bias_rate, mass_scale, impulse_scale]: [L; 3],
) -> L {
    let constants = stride.constants;
    let (arm_a, arm_b) = (stride.load(&point.normal_arm_a), stride.load(&point.normal_arm_b));
    let mass = stride.load(&point.normal_mass);
    let old = stride.load(&point.normal_impulse);
    let s = pair.separation(stride.load(&point.separation), arm_a, arm_b);
    let apart = s.gt(constants.zero);
    let velocity = pair.normal_velocity(arm_a, arm_b);
    let impulse = if BIAS {
        let rigid = L::or(apart, velocity.lt(constants.fast));
        let velocity = L::select(rigid, velocity, mass_scale * velocity);
        let decay = impulse_scale * old;
        // What carries the load is not bounded.
        let bound = (constants.push_rate * s).max(constants.push);
        let push = (mass * (bias_rate * s)).max(mass * bound - decay);
        let (push, decay) = (
            L::select(apart, mass * (s * constants.inv_h), push),
            L::select(apart, constants.zero, decay),
        );
        old - mass * velocity - push - decay
    } else {
        let bias = L::select(apart, s * constants.inv_h, constants.zero);
        old - mass * (velocity + bias)
    };
    let impulse = impulse.max(constants.zero);
    stride.store(impulse, &mut point.normal_impulse);
    pair.push(impulse - old, arm_a, arm_b);
    impulse
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
) -> [L; 2] {
    let zero = stride.constants.zero;
    let one = L::splat(stride.token, 1.0);
    let inv_scale = if BIAS { one / mass_scale } else { one };
    let soft = [push_rate, mass_scale, inv_scale];
    let k12 = {
        let [first, second] = &block.points;
        let inv_mass = pair.a[Slot::INV_MASS] + pair.b[Slot::INV_MASS];
        let turn_a = stride.load(&first.normal_arm_a) * stride.load(&second.normal_arm_a);
        let turn_b = stride.load(&first.normal_arm_b) * stride.load(&second.normal_arm_b);
        inv_mass + pair.a[Slot::INV_INERTIA] * turn_a + pair.b[Slot::INV_INERTIA] * turn_b
    };
    let first = Normal::load::<BIAS>(stride, pair, &block.points[0], soft);
    let second = Normal::load::<BIAS>(stride, pair, &block.points[1], soft);
    let q = [first.demand - k12 * second.old, second.demand - k12 * first.old];

    let product = first.diagonal * second.diagonal;
    let determinant = product - k12 * k12;
    let least = L::splat(stride.token, LEAST_DETERMINANT) * product;
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
    let alone = [L::select(first_holds, alone[0], zero), L::select(first_holds, zero, alone[1])];
    let turn_1 = (-(first.mass * (q[0] + k12 * second.old))).max(zero);
    let turn_2 = (-(second.mass * (q[1] + k12 * turn_1))).max(zero);

    let choose =
        |k: usize, in_turn: L| L::select(sound, L::select(both_push, both[k], alone[k]), in_turn);
    let impulses = [choose(0, turn_1), choose(1, turn_2)];
    for (point, (normal, impulse)) in
        block.points.iter_mut().zip([first, second].into_iter().zip(impulses))
    {
        stride.store(impulse, &mut point.normal_impulse);
        pair.push(impulse - normal.old, normal.arm_a, normal.arm_b);
    }
    impulses
}

/// Determinants below this part of the diagonal's product count as singular: card houses, whose points
/// are 2 mm apart, fall at 0.001.
const LEAST_DETERMINANT: f32 = 0.01;

/// One of two points as [`solve_both`] needs it.
struct Normal<L> {
    arm_a: L,
    arm_b: L,
    old: L,
    /// Diagonal of A, and its inverse; zero where there is no point.
    diagonal: L,
    mass: L,
    /// v + bias / mass_scale - K p_old, without the other point's part.
    demand: L,
}

impl<L: Lanes> Normal<L> {
    #[inline(always)]
    fn load<const BIAS: bool>(
        stride: &Stride<'_, L>,
        pair: &Pair<L>,
        point: &PointLanes,
        [push_rate, mass_scale, inv_scale]: [L; 3],
    ) -> Self {
        let constants = stride.constants;
        let (arm_a, arm_b) = (stride.load(&point.normal_arm_a), stride.load(&point.normal_arm_b));
        let (a, b) = (&pair.a, &pair.b);
        let k = a[Slot::INV_MASS]
            + b[Slot::INV_MASS]
            + a[Slot::INV_INERTIA] * arm_a * arm_a
            + b[Slot::INV_INERTIA] * arm_b * arm_b;
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
                mass,
                demand: velocity + bias - k * old,
            };
        }
        let rigid = L::or(apart, velocity.lt(constants.fast));
        // What carries the load is not bounded.
        let carry = k * inv_scale - k;
        let bound = (constants.push_rate * s).max(constants.push);
        let push = (push_rate * s * inv_scale).max(bound - carry * old);
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

/// Friction, rolling resistance, and normal impulses without bias.
#[inline(always)]
fn relax<L: Lanes, const POINTS: usize>(
    stride: &Stride<'_, L>,
    block: &mut ConstraintBlock,
    surface: &mut SurfaceBlock,
    flags: u8,
) {
    let mut pair = Pair::load(stride, block);
    let friction = stride.load(&block.friction);
    for point in &mut block.points[..POINTS] {
        solve_friction(stride, &mut pair, point, friction, surface, flags);
    }
    if flags & flags::ROLLING != 0 {
        solve_rolling::<L, POINTS>(stride, &mut pair, block, surface);
    }
    let soft = stride.constants.soft;
    solve_normals::<L, POINTS, false>(stride, &mut pair, block, soft);
    pair.store(stride, block);
}

/// Tangent impulse of one point, within the friction cone.
#[inline(always)]
fn solve_friction<L: Lanes>(
    stride: &Stride<'_, L>,
    pair: &mut Pair<L>,
    point: &mut PointLanes,
    friction: L,
    surface: &SurfaceBlock,
    flags: u8,
) {
    let (arm_a, arm_b) = (stride.load(&point.tangent_arm_a), stride.load(&point.tangent_arm_b));
    let old = stride.load(&point.tangent_impulse);
    let mut velocity = pair.tangent_velocity(arm_a, arm_b);
    if flags & flags::TANGENT_SPEED != 0 {
        velocity = velocity + stride.load(&surface.tangent_speed);
    }
    let limit = friction * stride.load(&point.normal_impulse);
    let impulse = (old - stride.load(&point.tangent_mass) * velocity).clamp(-limit, limit);
    stride.store(impulse, &mut point.tangent_impulse);
    pair.rub(impulse - old, arm_a, arm_b);
}

/// Angular impulse against rolling, limited by resistance * normal impulse.
#[inline(always)]
fn solve_rolling<L: Lanes, const POINTS: usize>(
    stride: &Stride<'_, L>,
    pair: &mut Pair<L>,
    block: &ConstraintBlock,
    surface: &mut SurfaceBlock,
) {
    let zero = stride.constants.zero;
    let mut normal = zero;
    for point in &block.points[..POINTS] {
        normal = normal + stride.load(&point.normal_impulse);
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
fn roll<L: Lanes>(pair: &mut Pair<L>, impulse: L) {
    pair.a[Slot::W] = pair.a[Slot::W] - pair.a[Slot::INV_INERTIA] * impulse;
    pair.b[Slot::W] = pair.b[Slot::W] + pair.b[Slot::INV_INERTIA] * impulse;
}

/// Before the substeps: finds the points that will hit in this step, and the speed at which they are to
/// leave.
///
/// With approach v, separation s, closing acceleration c and restitution e, the surfaces meet at speed
/// `sqrt(v^2 + 2 c s)`. The bounce takes place here, at separation s, so the speed that has to be set is
/// `sqrt(e^2 (v^2 + 2 c s) - 2 c s)`. Velocities of the semi-implicit scheme are half a substep late:
/// `c h / 2` is missing from the approach and needed on top of the speed.
#[inline(always)]
fn aim_bounce<L: Lanes, const POINTS: usize>(
    stride: &Stride<'_, L>,
    block: &ConstraintBlock,
    surface: &mut SurfaceBlock,
    flags: u8,
) {
    if flags & flags::RESTITUTION == 0 {
        return;
    }
    let constants = stride.constants;
    let zero = constants.zero;
    let pair = Pair::load(stride, block);
    let bounce = stride.load(&surface.restitution);
    let pull = pair.normal[0] * constants.gravity[0] + pair.normal[1] * constants.gravity[1];
    // What falls onto something fixed; what falls together does not close in.
    let (fixed_a, fixed_b) = (pair.a[Slot::INV_MASS].le(zero), pair.b[Slot::INV_MASS].le(zero));
    let closing = L::select(fixed_b, pull, zero) - L::select(fixed_a, pull, zero);
    let closing = closing.max(zero);
    let late = closing * constants.half_h;
    for k in 0..POINTS {
        let point = &block.points[k];
        let (arm_a, arm_b) = (stride.load(&point.normal_arm_a), stride.load(&point.normal_arm_b));
        let s = stride.load(&point.separation);
        let velocity = pair.normal_velocity(arm_a, arm_b);
        let fall = (closing + closing) * s;
        let hit = L::and(
            L::and(velocity.lt(constants.threshold), (s + velocity * constants.dt).lt(zero)),
            L::and(zero.lt(bounce), zero.lt(stride.load(&point.normal_mass))),
        );
        let approach = late - velocity;
        let meet = (approach * approach + fall).max(zero);
        let leave = (bounce * bounce * meet - fall).max(zero).sqrt() + late;
        let (target, push) = if k == 0 {
            (&mut surface.bounce_1, &mut surface.bounce_impulse_1)
        } else {
            (&mut surface.bounce_2, &mut surface.bounce_impulse_2)
        };
        stride.store(L::select(hit, leave, zero), target);
        stride.store(zero, push);
    }
}

/// Lets the points found by [`aim_bounce`] leave at their speeds.
#[inline(always)]
fn bounce<L: Lanes, const POINTS: usize>(
    stride: &Stride<'_, L>,
    block: &mut ConstraintBlock,
    surface: &mut SurfaceBlock,
    flags: u8,
) {
    if flags & flags::RESTITUTION == 0 {
        return;
    }
    let zero = stride.constants.zero;
    let mut pair = Pair::load(stride, block);
    for k in 0..POINTS {
        let (target, push, peak) = if k == 0 {
            (&surface.bounce_1, &mut surface.bounce_impulse_1, &mut surface.peak_1)
        } else {
            (&surface.bounce_2, &mut surface.bounce_impulse_2, &mut surface.peak_2)
        };
        let point = &mut block.points[k];
        let (arm_a, arm_b) = (stride.load(&point.normal_arm_a), stride.load(&point.normal_arm_b));
        let target = stride.load(target);
        let old = stride.load(push);
        let missing = target - pair.normal_velocity(arm_a, arm_b);
        let impulse = (old + stride.load(&point.normal_mass) * missing).max(zero);
        let impulse = L::select(zero.lt(target), impulse, old);
        stride.store(impulse, push);
        stride.store(stride.load(peak).max(impulse), peak);
        pair.push(impulse - old, arm_a, arm_b);
    }
    pair.store(stride, block);
}

/// Has [`Pass::AimBounce`] found a point of the bucket that hits?
pub(crate) fn any_bounce(bucket: &Bucket) -> bool {
    let aims = |surface: &SurfaceBlock| {
        surface.bounce_1.iter().chain(&surface.bounce_2).any(|&target| target > 0.0)
    };
    let blocks = bucket.heads.iter().zip(&bucket.surfaces);
    blocks.into_iter().any(|(head, surface)| head.flags & flags::RESTITUTION != 0 && aims(surface))
}
