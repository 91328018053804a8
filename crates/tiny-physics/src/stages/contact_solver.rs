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
    /// Approach below this does not bounce, metres a second.
    pub(crate) restitution_threshold: f32,
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
    Restitution,
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
                    Pass::Restitution => restitution::<L, POINTS>(&stride, block, surface, flags),
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
    soft: [L; 3],
    static_soft: [L; 3],
    threshold: L,
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
            soft: soft(parameters.soft),
            static_soft: soft(parameters.static_soft),
            threshold: splat(-parameters.restitution_threshold),
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
    for k in 0..POINTS {
        let impulse = solve_normal::<L, true>(stride, &mut pair, &mut block.points[k], soft);
        if flags & (flags::RESTITUTION | flags::HIT) != 0 {
            let peak = if k == 0 { &mut surface.peak_1 } else { &mut surface.peak_2 };
            stride.store(stride.load(peak).max(impulse), peak);
        }
    }
    pair.store(stride, block);
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
        let bias = L::select(apart, s * constants.inv_h, (bias_rate * s).max(constants.push));
        let velocity = L::select(apart, velocity, mass_scale * velocity);
        let decay = L::select(apart, constants.zero, impulse_scale * old);
        old - mass * (velocity + bias) - decay
    } else {
        let bias = L::select(apart, s * constants.inv_h, constants.zero);
        old - mass * (velocity + bias)
    };
    let impulse = impulse.max(constants.zero);
    stride.store(impulse, &mut point.normal_impulse);
    pair.push(impulse - old, arm_a, arm_b);
    impulse
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
    for point in &mut block.points[..POINTS] {
        solve_normal::<L, false>(stride, &mut pair, point, soft);
    }
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

/// After the substeps: points that hit fast enough leave with restitution times their approach.
#[inline(always)]
fn restitution<L: Lanes, const POINTS: usize>(
    stride: &Stride<'_, L>,
    block: &mut ConstraintBlock,
    surface: &mut SurfaceBlock,
    flags: u8,
) {
    if flags & flags::RESTITUTION == 0 {
        return;
    }
    let constants = stride.constants;
    let mut pair = Pair::load(stride, block);
    let bounce = stride.load(&surface.restitution);
    for k in 0..POINTS {
        let (approach, peak) = if k == 0 {
            (stride.load(&surface.approach_1), &mut surface.peak_1)
        } else {
            (stride.load(&surface.approach_2), &mut surface.peak_2)
        };
        let point = &mut block.points[k];
        let hit = L::and(
            L::and(approach.lt(constants.threshold), constants.zero.lt(stride.load(peak))),
            constants.zero.lt(bounce),
        );
        let (arm_a, arm_b) = (stride.load(&point.normal_arm_a), stride.load(&point.normal_arm_b));
        let old = stride.load(&point.normal_impulse);
        let velocity = pair.normal_velocity(arm_a, arm_b);
        let target = old - stride.load(&point.normal_mass) * (velocity + bounce * approach);
        let impulse = L::select(hit, target.max(constants.zero), old);
        stride.store(impulse, &mut point.normal_impulse);
        stride.store(stride.load(peak).max(impulse), peak);
        pair.push(impulse - old, arm_a, arm_b);
    }
    pair.store(stride, block);
}
