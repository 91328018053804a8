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
//! The bias pushes out at `bias_rate * s`, but no faster than `push_speed` or `push_rate * |s|`, beyond what
//! the accumulated impulse accounts for: a load sinks as its spring says, and what was put in deep comes out
//! slowly. What closes in faster than `fast_approach` is solved without softness, which would let a part of
//! that speed pass.
//!
//! Friction acts in the relax pass only, with |tangent impulse| <= friction * load, the normal impulse that
//! the last relax pass ended with. That of the solve pass has the push against overlap in it, many times the
//! load where things hit: rubbing with that, a wave of dominoes was up to 1.6 times slower, by the substep. The
//! separation follows the motion since the start of the step to first order: lever arms stay those
//! of the start, so that a point is twenty floats and a pass is a straight line.
//!
//! The files: `normals` has normal impulses, `friction` friction and rolling, `bounce` what bodies with
//! restitution do before a substep, `pair` the two bodies of a lane that all of them work on.
//!
//! Within a colour, order does not matter; colours go in order. The same functions serve the overflow, with one
//! contact in a block at a time.

mod bounce;
mod friction;
mod normals;
mod pair;

pub(crate) use bounce::{Bounces, SPRINGY};

use crate::dynamics::{
    BlockHead, Blocks, ConstraintBlock, Graph, LaneBlock, PointLanes, Run, Schedule, Source,
    SurfaceBlock, flags,
};
use crate::simd::{BLOCK, LaneKernel, Lanes, SimdLevel, dispatch};
use crate::threads::{SharedRows, Team};
use core::ops::Range;
use friction::{roll, solve_friction, solve_rolling};
pub(super) use normals::normal_impulse;
use normals::solve_normals;
pub(super) use pair::Constants;
use pair::{ALL_BODIES, Pair, Stride};

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
        // Of next to nothing, without damping.
        let bias_rate = if a1 > 0.0 { omega / a1 } else { 1.0 / h };
        Self { bias_rate, mass_scale: a2 * a3, impulse_scale: a3 }
    }
}

/// What all contacts of a step have in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parameters {
    /// 1 / substep length.
    pub(crate) inv_h: f32,
    /// Length of the step, seconds.
    pub(crate) dt: f32,
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
    /// What approaches more slowly does not bounce, metres a second.
    pub(crate) restitution_threshold: f32,
}

/// One of the passes of a substep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pass {
    /// In the first substep: impulses of the step before.
    WarmStart,
    /// In later substeps: impulses of the substep before, on bodies with joints alone; see
    /// [`integrate::velocities`](super::integrate::velocities).
    WarmStartJointed,
    Solve,
    Relax,
    /// The last of a substep.
    RelaxLast,
}

/// Blocks that one member of the team solves at a time.
pub(crate) const CHUNK: usize = 8;

/// Runs a pass over the places of a schedule in their order: colours in lanes, an overflow, whose contacts have
/// bodies in common, contact after contact.
pub(crate) fn run(
    team: &Team,
    level: SimdLevel,
    pass: Pass,
    parameters: &Parameters,
    rows: SharedRows<'_>,
    graph: &mut Graph,
    schedule: &Schedule,
) {
    let work = Work { pass, parameters, rows };
    graph.for_each_chunk(team, schedule, |runs, mut source| {
        for runs in runs.chunk_by(|a, b| a.is_in_order() == b.is_in_order()) {
            if runs[0].is_in_order() {
                runs.iter().for_each(|run| work.one_by_one(level, run, &mut source));
            } else {
                dispatch(level, RunPass { work, runs, source: &mut source });
            }
        }
    });
}

/// What is to be done.
#[derive(Clone, Copy)]
struct Work<'a> {
    pass: Pass,
    parameters: &'a Parameters,
    rows: SharedRows<'a>,
}

impl Work<'_> {
    /// For contacts that have bodies in common: each by itself, in the first lane of an empty block.
    fn one_by_one(self, level: SimdLevel, run: &Run, source: &mut Source<'_>) {
        let Some(Blocks { contacts, constraints, surfaces, heads, .. }) = source.blocks(run) else {
            return;
        };
        let (mut constraint, mut surface) = (ConstraintBlock::NULL, SurfaceBlock::NULL);
        for (block, lane) in (0..contacts.len()).map(|slot| (slot / BLOCK, slot % BLOCK)) {
            constraint.copy_lane(0, &constraints[block], lane);
            surface.copy_lane(0, &surfaces[block], lane);
            let source = &mut Source::Alone(Blocks {
                contacts: &contacts[..1],
                manifolds: &mut [],
                heads: &mut [heads[block].lane(lane)],
                constraints: core::slice::from_mut(&mut constraint),
                surfaces: core::slice::from_mut(&mut surface),
            });
            let runs = core::slice::from_ref(run);
            dispatch(level.for_count(1), RunPass { work: self, runs, source });
            constraints[block].copy_lane(lane, &constraint, 0);
            surfaces[block].copy_lane(lane, &surface, 0);
        }
    }

    /// Runs the pass over the lanes of a block from one on: in as few strides as there are lanes for.
    #[inline(always)]
    fn block<L: Lanes, const POINTS: usize>(
        self,
        token: L::Token,
        (block, surface): (&mut ConstraintBlock, &mut SurfaceBlock),
        head: BlockHead,
        lanes: Range<usize>,
        constants: &Constants<L>,
    ) {
        let taken = head.flags & flags::TAKEN != 0;
        let mut at = if taken { lanes.end } else { lanes.start };
        while at < lanes.end {
            if const { L::Half::WIDTH < L::WIDTH } && lanes.end - at <= L::Half::WIDTH {
                let (token, lanes) = (L::half(token), at..lanes.end);
                let constants = &Constants::new(token, self.parameters);
                let block = (block, surface);
                return self.block::<L::Half, POINTS>(token, block, head, lanes, constants);
            }
            let stride = Stride { token, rows: self.rows, at, constants };
            let flags = head.flags;
            match self.pass {
                Pass::WarmStart => {
                    warm_start::<L, POINTS, true>(&stride, block, surface, flags, ALL_BODIES);
                }
                Pass::WarmStartJointed => {
                    let jointed = (head.jointed_a >> at, head.jointed_b >> at);
                    let jointed = (jointed.0.into(), jointed.1.into());
                    warm_start::<L, POINTS, false>(&stride, block, surface, flags, jointed);
                }
                Pass::Solve => solve::<L, POINTS>(&stride, block, surface, flags),
                Pass::Relax | Pass::RelaxLast => {
                    let unsummed = if self.pass == Pass::Relax { flags::SUMMED } else { 0 };
                    relax::<L, POINTS>(&stride, block, surface, flags & !unsummed);
                }
            }
            at += L::WIDTH;
        }
    }
}

/// A pass over the runs of colours, in their order.
struct RunPass<'a, 'b> {
    work: Work<'a>,
    runs: &'a [Run],
    source: &'a mut Source<'b>,
}

impl LaneKernel for RunPass<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, token: L::Token) {
        let Self { work, runs, source } = self;
        let constants = &Constants::<L>::new(token, work.parameters);
        for run in runs {
            let Some(blocks) = source.blocks(run) else { continue };
            let mut left = blocks.contacts.len();
            let solved = blocks.constraints.iter_mut().zip(blocks.surfaces);
            for ((block, surface), &mut head) in solved.zip(blocks.heads) {
                let lanes = 0..left.min(BLOCK);
                left -= lanes.end;
                match run.class.max_points() {
                    1 => work.block::<L, 1>(token, (block, surface), head, lanes, constants),
                    _ => work.block::<L, 2>(token, (block, surface), head, lanes, constants),
                }
            }
        }
    }
}

/// Applies the impulses of the substep before to the bodies of the lanes in `only`.
#[inline(always)]
fn warm_start<L: Lanes, const POINTS: usize, const FIRST: bool>(
    stride: &Stride<'_, L>,
    block: &mut ConstraintBlock,
    surface: &mut SurfaceBlock,
    flags: u8,
    only: (u32, u32),
) {
    let mut pair = Pair::load(stride, block);
    for point in &mut block.points[..POINTS] {
        if FIRST {
            stride.store(stride.load(&point.normal_impulse), &mut point.load);
        }
        let normal_arms = [stride.load(&point.normal_arm_a), stride.load(&point.normal_arm_b)];
        let tangent_arms = [stride.load(&point.tangent_arm_a), stride.load(&point.tangent_arm_b)];
        pair.push(stride.load(&point.normal_impulse), normal_arms[0], normal_arms[1]);
        pair.rub(stride.load(&point.tangent_impulse), tangent_arms[0], tangent_arms[1]);
    }
    if flags & flags::ROLLING != 0 {
        roll(&mut pair, stride.load(&surface.rolling_impulse));
    }
    if FIRST && flags & flags::RESTS != 0 {
        let [bias_rate, _, impulse_scale] = pair.softness(stride.constants);
        let compliance = impulse_scale / bias_rate;
        bound_rest(stride, compliance, &block.points[0], &mut surface.rest_1);
        bound_rest(stride, compliance, &block.points[1], &mut surface.rest_2);
    }
    pair.store_only(stride, block, only);
}

/// Bounds the rest of a point to the sink that its load accounts for.
#[inline(always)]
fn bound_rest<L: Lanes>(
    stride: &Stride<'_, L>,
    compliance: L,
    point: &PointLanes,
    rest: &mut [f32; BLOCK],
) {
    let (mass, impulse) = (stride.load(&point.normal_mass), stride.load(&point.normal_impulse));
    let exists = mass.gt(stride.constants.zero);
    let load = impulse / L::select(exists, mass, L::splat(stride.token, 1.0));
    let sink = L::select(exists, compliance * load, stride.constants.zero);
    stride.store(stride.load(rest).min(sink), rest);
}

/// Normal impulses with bias.
#[inline(always)]
fn solve<L: Lanes, const POINTS: usize>(
    stride: &Stride<'_, L>,
    block: &mut ConstraintBlock,
    surface: &SurfaceBlock,
    flags: u8,
) {
    let mut pair = Pair::load(stride, block);
    let soft = pair.softness(stride.constants);
    let mut rests = [stride.constants.zero; 2];
    if flags & flags::RESTS != 0 {
        rests = [stride.load(&surface.rest_1), stride.load(&surface.rest_2)];
    }
    solve_normals::<L, POINTS, true>(stride, &mut pair, block, soft, rests);
    pair.store(stride, block);
}

/// Friction, rolling resistance, and normal impulses without bias. Sums these up where `flags` ask for hits.
#[inline(always)]
fn relax<L: Lanes, const POINTS: usize>(
    stride: &Stride<'_, L>,
    block: &mut ConstraintBlock,
    surface: &mut SurfaceBlock,
    flags: u8,
) {
    let mut pair = Pair::load(stride, block);
    let friction = stride.load(&block.friction);
    let belt = if flags & flags::TANGENT_SPEED != 0 { Some(&surface.tangent_speed) } else { None };
    solve_friction::<L, POINTS>(stride, &mut pair, &mut block.points, friction, belt, None);
    if flags & flags::ROLLING != 0 {
        solve_rolling::<L, POINTS>(stride, &mut pair, block, surface);
    }
    let soft = stride.constants.soft;
    let rests = [stride.constants.zero; 2];
    let loads = solve_normals::<L, POINTS, false>(stride, &mut pair, block, soft, rests);
    for (point, load) in block.points.iter_mut().zip(loads).take(POINTS) {
        stride.store(load, &mut point.load);
    }
    if flags & flags::SUMMED != 0 {
        let totals = [&mut surface.total_1, &mut surface.total_2];
        for (total, load) in totals.into_iter().zip(loads).take(POINTS) {
            stride.store(stride.load(total) + load, total);
        }
    }
    pair.store(stride, block);
}
