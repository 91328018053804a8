//! Which contacts bounce in a round, and how fast their points are to leave.

use crate::dynamics::{Bucket, ConstraintBlock, Graph, Motion, Run, Schedule, Slot, flags};
use crate::geometry::manifold::PairClass;
use crate::simd::{BLOCK, LaneKernel, Lanes, SimdLevel, dispatch_narrow};
use crate::stages::contact_solver::Parameters;
use crate::stages::contact_solver::pair::{Constants, Pair, Stride};
use crate::threads::{SharedRows, Team};

/// Blocks that one member of the team searches at a time.
const CHUNK: usize = 32;

/// A contact that bounces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub(super) place: usize,
    pub(super) class: PairClass,
    pub(super) slot: u32,
    /// Speeds at which its points are to leave; 0 for one that does not hit.
    pub(super) targets: [f32; 2],
}

/// What bounces in a round.
#[derive(Clone, Copy)]
pub(super) struct Search<'a> {
    pub(super) graph: &'a Graph,
    pub(super) rows: SharedRows<'a>,
    pub(super) parameters: &'a Parameters,
    pub(super) motions: &'a [Motion],
    /// The bodies whose contacts are looked at; those of all where not said.
    pub(super) near: Option<&'a [bool]>,
    /// What would leave no faster than this over its restitution does not bounce, metres a second, unless it comes
    /// faster than the threshold.
    pub(super) leave: f32,
}

/// What falls back within this time is as good as at rest, seconds: what forces press together bounces from the speed
/// on that they would give it in this time, or from the threshold on if that is less. So balls on a table without
/// gravity, and those that touch a wall aslant, keep what speed they have, and what lies on the ground lies.
const SHORT: f32 = 0.13;

/// So much of the speed at which something leaves is lost, so that rounding heats nothing: without it a gas of elastic
/// balls gains 2e-5 of its energy in ten minutes.
const LOST: f32 = 2.4e-7;

impl Search<'_> {
    /// Lists what bounces, in the order of the runs.
    pub(super) fn run<'h>(
        self,
        team: &Team,
        level: SimdLevel,
        schedule: &Schedule,
        hits: &'h mut Vec<Vec<Hit>>,
    ) -> &'h [Vec<Hit>] {
        let (runs, chunk) = schedule.runs(CHUNK);
        team.map_chunks(runs.len(), chunk, hits, |range, hits| {
            hits.clear();
            dispatch_narrow(level, Look { search: self, runs: &runs[range], hits });
        })
    }

    /// What forces add to the velocities of the bodies of a stride in a substep: nothing to those that cannot move.
    #[inline(always)]
    fn gain<L: Lanes>(
        &self,
        stride: &Stride<'_, L>,
        bodies: &[u32; BLOCK],
        rows: &[L; 8],
    ) -> [L; 3] {
        let mut gains = [[0.0; BLOCK]; 3];
        for lane in 0..L::WIDTH {
            let motion = &self.motions[bodies[stride.at + lane] as usize];
            for (k, gains) in gains.iter_mut().enumerate() {
                gains[lane] = motion.gain[k];
            }
        }
        let zero = stride.constants.zero;
        let moves = zero.lt(rows[Slot::INV_MASS].abs() + rows[Slot::INV_INERTIA]);
        let mut moving = [zero; 3];
        for (moving, gains) in moving.iter_mut().zip(&gains) {
            *moving = L::select(moves, L::load(stride.token, gains), zero);
        }
        moving
    }

    /// Lanes whose points approach faster than the threshold, or, where nothing was pressed before, at all.
    fn approaching_lanes(&self, bucket: &Bucket, block: usize) -> u16 {
        let (surface, constraint) = (&bucket.surfaces[block], &bucket.constraints[block]);
        let approaches = [&surface.approach_1, &surface.approach_2];
        (0..BLOCK).fold(0, |lanes, lane| {
            let comes = |k: usize| {
                let fresh = constraint.points[k].normal_impulse[lane] == 0.0;
                let least = if fresh { self.leave } else { self.parameters.restitution_threshold };
                approaches[k][lane] < -least
            };
            lanes | u16::from(comes(0) | comes(1)) << lane
        })
    }

    /// The lanes of a block that may bounce, as bits.
    fn candidates(&self, bucket: &Bucket, block: usize) -> u16 {
        if bucket.heads[block].flags & flags::RESTITUTION == 0 {
            return 0;
        }
        match self.near {
            Some(marks) => near_lanes(&bucket.constraints[block], marks),
            None => self.approaching_lanes(bucket, block),
        }
    }
}

/// Lanes with a marked body.
fn near_lanes(block: &ConstraintBlock, marks: &[bool]) -> u16 {
    (0..BLOCK).fold(0, |lanes, lane| {
        let [a, b] = [block.body_a[lane], block.body_b[lane]].map(|body| marks[body as usize]);
        lanes | u16::from(a | b) << lane
    })
}

struct Look<'a> {
    search: Search<'a>,
    runs: &'a [Run],
    hits: &'a mut Vec<Hit>,
}

impl LaneKernel for Look<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, token: L::Token) {
        let Self { search, runs, hits } = self;
        let Search { graph, rows, parameters, .. } = search;
        let constants = Constants::<L>::new(token, parameters);
        for run in runs {
            let bucket = &graph.buckets.list()[run.bucket];
            for block in run.blocks.clone() {
                let mut lanes = search.candidates(bucket, block);
                if lanes == 0 {
                    continue;
                }
                let mut targets = [[0.0; BLOCK]; 2];
                for at in (0..BLOCK).step_by(L::WIDTH) {
                    if u32::from(lanes) >> at & ((1 << L::WIDTH) - 1) == 0 {
                        continue;
                    }
                    let stride = Stride { token, rows, at, constants: &constants };
                    let targets = &mut targets[..run.class.max_points()];
                    aim(&search, &stride, bucket, block, targets);
                }
                while lanes != 0 {
                    let lane = lanes.trailing_zeros() as usize;
                    lanes &= lanes - 1;
                    let targets = [targets[0][lane], targets[1][lane]];
                    if targets != [0.0; 2] {
                        let slot = (block * BLOCK + lane) as u32;
                        hits.push(Hit { place: run.place, class: run.class, slot, targets });
                    }
                }
            }
        }
    }
}

/// How fast the points are to leave that hit in this step; 0 for those that do not.
///
/// With approach v, separation s, closing acceleration c (by all forces on the two bodies; negative where they part)
/// and restitution e, the surfaces meet at speed `sqrt(v^2 + 2 c s)`. The bounce takes place here, at separation s,
/// so the speed that has to be set is `sqrt(e^2 (v^2 + 2 c s) - 2 c s)`. Velocities of the semi-implicit scheme are
/// half a substep late: `c h / 2` is missing from the approach and needed on top of the speed.
#[inline(always)]
fn aim<L: Lanes>(
    search: &Search<'_>,
    stride: &Stride<'_, L>,
    bucket: &Bucket,
    block: usize,
    targets: &mut [[f32; BLOCK]],
) {
    let constraint = &bucket.constraints[block];
    let Parameters { inv_h, dt, .. } = *search.parameters;
    let splat = |value| L::splat(stride.token, value);
    let zero = stride.constants.zero;
    let pair = Pair::load(stride, constraint);
    let restitution = stride.load(&bucket.surfaces[block].restitution);
    let gain_a = search.gain(stride, &constraint.body_a, &pair.a);
    let gain_b = search.gain(stride, &constraint.body_b, &pair.b);
    let threshold = splat(search.parameters.restitution_threshold);
    let first = search.near.is_none();
    let along = pair.normal[0] * (gain_a[0] - gain_b[0]) + pair.normal[1] * (gain_a[1] - gain_b[1]);
    for (point, targets) in constraint.points.iter().zip(targets) {
        let arms = [stride.load(&point.normal_arm_a), stride.load(&point.normal_arm_b)];
        let velocity = pair.normal_velocity(arms[0], arms[1]);
        let s = stride.load(&point.separation);
        // What the forces add to the approach in a substep.
        let closing = along + (arms[0] * gain_a[2] - arms[1] * gain_b[2]);
        let fresh = stride.load(&point.normal_impulse).eq(zero);
        let pressed = (closing.max(zero) * splat(SHORT * inv_h)).min(threshold);
        let least = if first { L::select(fresh, pressed, threshold) } else { zero };
        let leaves = (restitution * restitution * velocity).lt(splat(-search.leave));
        let mut fast = L::and(velocity.lt(zero - least), leaves);
        if first {
            fast = L::or(fast, velocity.lt(zero - threshold));
        }
        // As the substeps add it up: n (n + 1) / 2 times.
        let fallen = closing.max(zero) * splat(0.5 * dt * (dt * inv_h + 1.0));
        let arrives = (s + velocity * splat(dt)).lt(fallen);
        let hits = L::and(L::and(fast, arrives), zero.lt(stride.load(&point.normal_mass)));
        let late = splat(0.5) * closing;
        let fall = splat(2.0 * inv_h) * closing * s;
        let approach = late - velocity;
        let meet = approach * approach + fall;
        let speed = (restitution * restitution * meet - fall).max(zero).sqrt() + late;
        let speed = speed * splat(1.0 - LOST);
        stride.store(L::select(L::and(hits, zero.lt(meet)), speed, zero), targets);
    }
}
