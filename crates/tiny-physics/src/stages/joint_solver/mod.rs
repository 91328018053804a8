//! The joint solver: soft-step sequential impulses over blocks of joints of one colour and class.
//!
//! Each step [`describe`] writes what follows from new or changed descriptions, [`prepare`] what
//! follows from the poses. Each substep runs the passes: warm start, solve, relax. [`Pass::Finish`]
//! ends the step, before positions are taken over; then [`load`] reads the joints back. [`Broken`] looks at every substep.
//!
//! What a joint holds rigid is a soft constraint of high frequency (see
//! [`Softness`](super::contact_solver::Softness)) in the solve pass and exact in the relax pass. With
//! Jacobian J, effective mass M = (J m^-1 J^T)^-1, position error C and accumulated impulse p:
//!
//! ```text
//! dp = -M (mass_scale * J v + push * C) - impulse_scale * p
//! ```
//!
//! Springs act by the same formula with the coefficients of [`spring::coefficients`], which leave a part of the damping
//! to the relax pass. Where a joint has a free coordinate (the angle of a hinge, the place of a
//! slider), spring, motor and limits along it and the rigid part are solved as one block by Schur's
//! complement: the coordinate's effective mass is that of the bodies as the rigid part ties them, so
//! that a single joint is solved exactly in one iteration and a spring swings at its frequency.
//!
//! Joints of long or uneven trees are not solved so but all at once, see [`trees`]; their lanes keep what
//! lasts from step to step.
//!
//! Unlike those of contacts, the anchors and axes of joints turn with the bodies in every substep:
//! pendulums keep their period.

mod axis;
mod crowd;
mod distance;
mod drive;
mod gear;
mod parts;
mod pulley;
mod revolute;
mod slider;
mod spring;
pub(crate) mod torn;
pub(crate) mod trees;
mod weld;

#[cfg(test)]
mod tests;

use crate::describe::{BodyKind, Break, JointDef};
use crate::dynamics::{
    AxisLanes, BodyInfo, FrameLanes, JointBlocks, JointBucket, JointClass, JointColour, JointGraph,
    JointLanes, JointLoad, JointRecord, Joints, PACES, Place, REFINEMENT, ROUNDS, TREES, TreeLink,
    colour_at, joint_classes, pace_at, with_bucket,
};
use crate::math::{Pose, Vec2};
use crate::simd::{BLOCK, LaneKernel, Lanes, SimdLevel, dispatch_baseline, dispatch_narrow};
use crate::threads::SharedRows;
use axis::Give;
use crowd::crowd;
pub(crate) use parts::Substep;
use parts::{Pair, Start, Stride};
use spring::Rates;

/// One of the passes of a substep, or the last of the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pass {
    WarmStart,
    Solve,
    Relax,
    /// Once, after the last substep.
    Finish,
}

/// What the solver does with a class of joints.
trait JointKernel: JointLanes {
    /// What acts along the free coordinate. Its impulses are the last.
    #[inline(always)]
    fn axis(&self) -> Option<&AxisLanes> {
        None
    }
    /// The motor of a lane that has one of its own: speed, greatest impulse, impulse, which comes after those of the rows.
    fn motor(&self, _lane: usize) -> Option<[f32; 3]> {
        None
    }
    /// Writes the rows of a joint that a tree holds, whose impulses are the first, and the free coordinate.
    fn tie(&self, _stride: &Stride<f64>, _pair: &Pair<f64>, _link: &mut TreeLink) {}
    /// How its limits give way, where they may do so in a tree.
    fn give<const BIAS: bool>(&self, _stride: &Stride<f64>) -> Option<Give<f64, BIAS>> {
        None
    }
    /// The direction along which their load is told, if that follows from no impulse.
    fn told(&mut self) -> Option<[&mut [f32; BLOCK]; 2]> {
        None
    }
    /// Writes what follows from a joint's description. The anchors are there already.
    fn describe(&mut self, lane: usize, def: &JointDef, rates: &Rates);
    /// Writes what follows from the poses. The anchors are there already.
    fn prepare<L: Lanes>(&mut self, _stride: &Stride<L>, _start: &Start<L>, _poses: &[Pose]) {}
    /// From where the joint would have anchor B to where it is, of what yields where it is torn; see [`torn`].
    #[inline(always)]
    fn off<L: Lanes>(&self, stride: &Stride<L>, _gap: [L; 2]) -> [L; 2] {
        [stride.zero; 2]
    }
    /// Applies the impulses of the substep before.
    fn warm_start<L: Lanes>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>);
    /// Corrects the velocities, with bias or (relax) without.
    fn solve<L: Lanes, const BIAS: bool>(&mut self, stride: &Stride<L>, pair: &mut Pair<L>);
    /// Takes the motion of the step over.
    fn finish<L: Lanes>(&mut self, _stride: &Stride<L>, _rows: SharedRows<'_>) {}
    /// Impulse and angular impulse on B in the last substep.
    fn impulse(&self, lane: usize) -> (Vec2, f32);
}

/// Does something with typed blocks.
macro_rules! with_blocks {
    (($blocks:expr, $typed:ident => $body:expr) $($bucket:ident $class:ident $block:ident),*) => {
        match $blocks {
            $(JointBlocks::$class($typed) => $body),*
        }
    };
    ($blocks:expr, $typed:ident => $body:expr) => {
        joint_classes!(with_blocks!($blocks, $typed => $body))
    };
}

/// Brings the lanes in line with the descriptions of the joints: nothing to do in most steps. `h` is
/// the plain substep length, seconds.
pub(crate) fn describe(graph: &mut JointGraph, joints: &Joints, infos: &[BodyInfo], h: f32) {
    let all = graph.described_h != h;
    if !all && !graph.any_stale {
        return;
    }
    let rates: [_; PACES] = core::array::from_fn(|pace| {
        let h = h / REFINEMENT[pace] as f32;
        [Rates::new(h, ROUNDS[pace]), Rates::anchored(h, ROUNDS[pace])]
    });
    for (place, colour) in graph.colours.entries_mut() {
        let rates = &rates[pace_at(place)];
        let in_lanes = colour_at(place) != TREES;
        macro_rules! describe_all {
            (() $($bucket:ident $class:ident $block:ident),*) => {
                $(describe_bucket(&mut colour.$bucket, joints, infos, rates, all, in_lanes);)*
            };
        }
        joint_classes!(describe_all!());
    }
    graph.described_h = h;
    graph.any_stale = false;
}

fn describe_bucket<B: JointKernel>(
    bucket: &mut JointBucket<B>,
    joints: &Joints,
    infos: &[BodyInfo],
    rates: &[Rates; 2],
    all: bool,
    in_lanes: bool,
) {
    let JointBucket { joints: indices, blocks, stale } = bucket;
    for ((block, indices), stale) in blocks.iter_mut().zip(indices.chunks(BLOCK)).zip(stale) {
        if !core::mem::take(stale) && !all {
            continue;
        }
        for (lane, &index) in indices.iter().enumerate() {
            let record = &joints.records[index as usize];
            let def = &record.def;
            let frame = block.frame();
            let a = def.anchor_a - infos[record.body_a as usize].local_center;
            let b = def.anchor_b - infos[record.body_b as usize].local_center;
            (frame.local_a_x[lane], frame.local_a_y[lane]) = (a.x, a.y);
            (frame.local_b_x[lane], frame.local_b_y[lane]) = (b.x, b.y);
            let rates = &rates[usize::from(is_anchored(joints, infos, index))];
            // Trees are solved all at once.
            rates.crowd.set(if in_lanes { crowd(joints, infos, index, rates.h) } else { 1.0 });
            block.describe(lane, def, rates);
        }
    }
}

/// Does a joint hold its body to what does not move, and no other one does? Several get into each other's way, and very stiff ones
/// fling the body about: of 300 boxes on two rods that fit 88 went off, most where these are nearly parallel.
fn is_anchored(joints: &Joints, infos: &[BodyInfo], index: u32) -> bool {
    let moves = |body: u32| infos[body as usize].kind == BodyKind::Dynamic;
    let JointRecord { body_a: a, body_b: b, .. } = joints.records[index as usize];
    if moves(a) == moves(b) {
        return false;
    }
    let body = if moves(a) { a } else { b };
    let all = joints.of_body(infos[body as usize].first_joint);
    let all = all.map(|(joint, _)| &joints.records[joint as usize]);
    all.filter(|it| it.place != Place::Asleep && !moves(it.other(body))).count() == 1
}

/// Writes what follows from the poses (of the centres of mass) at the start of the step. The blocks have so many joints.
pub(crate) fn prepare(
    level: SimdLevel,
    poses: &[Pose],
    substep: Substep,
    blocks: JointBlocks<'_>,
    count: usize,
) {
    with_blocks!(blocks, blocks => dispatch_baseline(level, Prepare { poses, substep, blocks, count }));
}

struct Prepare<'a, B> {
    poses: &'a [Pose],
    substep: Substep,
    blocks: &'a mut [B],
    count: usize,
}

impl<B: JointKernel> LaneKernel for Prepare<'_, B> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, token: L::Token) {
        let Self { poses, substep, blocks, count } = self;
        for (index, block) in blocks.iter_mut().enumerate() {
            for at in (0..BLOCK.min(count - index * BLOCK)).step_by(L::WIDTH) {
                let stride = Stride::<L>::new(token, at, substep);
                let start = Start::prepare(&stride, block.frame(), poses);
                block.prepare(&stride, &start, poses);
                torn::prepare(&stride, block);
            }
        }
    }
}

/// Runs a pass over blocks of one colour, in lanes. The blocks have so many joints.
pub(crate) fn run(
    level: SimdLevel,
    pass: Pass,
    substep: Substep,
    rows: SharedRows<'_>,
    blocks: JointBlocks<'_>,
    count: usize,
) {
    with_blocks!(blocks, blocks => {
        run_pass(level, RunPass { pass, substep, rows, blocks, count });
    });
}

/// Runs a pass over joints that have bodies in common: each by itself, in the first lane of an empty block.
pub(crate) fn run_one_by_one(
    level: SimdLevel,
    pass: Pass,
    substep: Substep,
    rows: SharedRows<'_>,
    blocks: JointBlocks<'_>,
) {
    with_blocks!(blocks, blocks => one_by_one(level, pass, substep, rows, blocks));
}

fn one_by_one<B: JointKernel>(
    level: SimdLevel,
    pass: Pass,
    substep: Substep,
    rows: SharedRows<'_>,
    blocks: &mut [B],
) {
    let mut one = B::NULL;
    for block in blocks {
        for lane in 0..BLOCK {
            one.copy_lane(0, block, lane);
            let FrameLanes { body_a, body_b, .. } = one.frame();
            if body_a[0] == body_b[0] {
                continue; // An empty lane.
            }
            let blocks = core::slice::from_mut(&mut one);
            run_pass(level, RunPass { pass, substep, rows, blocks, count: 1 });
            block.copy_lane(lane, &one, 0);
        }
    }
}

/// Not inlined, so that both of its users share the kernels' machine code: there is much of it.
#[inline(never)]
fn run_pass<B: JointKernel>(level: SimdLevel, pass: RunPass<'_, B>) {
    dispatch_narrow(level.for_count(pass.count), pass);
}

struct RunPass<'a, B> {
    pass: Pass,
    substep: Substep,
    rows: SharedRows<'a>,
    blocks: &'a mut [B],
    /// Joints in the blocks.
    count: usize,
}

impl<B: JointKernel> LaneKernel for RunPass<'_, B> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, token: L::Token) {
        let Self { pass, substep, rows, blocks, count } = self;
        for (index, block) in blocks.iter_mut().enumerate() {
            let extras = match block.axis() {
                Some(axis) => axis.any_used(),
                None => false,
            };
            for at in (0..BLOCK.min(count - index * BLOCK)).step_by(L::WIDTH) {
                let stride = Stride::<L> { extras, ..Stride::new(token, at, substep) };
                if pass == Pass::Finish {
                    block.finish(&stride, rows);
                    continue;
                }
                let mut pair = Pair::load(&stride, rows, block.frame());
                match pass {
                    Pass::WarmStart => block.warm_start(&stride, &mut pair),
                    Pass::Solve => block.solve::<L, true>(&stride, &mut pair),
                    Pass::Relax | Pass::Finish => block.solve::<L, false>(&stride, &mut pair),
                }
                pair.store(&stride, rows, block.frame());
            }
        }
    }
}

/// What a joint does to its body B as of the last substep; nothing while it sleeps. `inv_h` is 1 / plain
/// substep length.
pub(crate) fn load(graph: &JointGraph, joints: &Joints, index: u32, inv_h: f32) -> JointLoad {
    let record = &joints.records[index as usize];
    let inv_h = inv_h * REFINEMENT[graph.pace_of(record)] as f32;
    let Some((place, class, slot)) = record.lanes() else { return JointLoad::default() };
    load_of(&graph.colours[place], class, slot, inv_h)
}

#[inline]
fn load_of(colour: &JointColour, class: JointClass, slot: u32, inv_h: f32) -> JointLoad {
    let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
    let (force, torque) = with_bucket!(colour, class, bucket => bucket.blocks[block].impulse(lane));
    JointLoad { force: force * inv_h, torque: torque * inv_h }
}

/// A joint that can break, where its lanes are, and what it bears.
#[derive(Clone, Copy, Debug)]
struct Breakable {
    index: u32,
    colour: u32,
    class: JointClass,
    slot: u32,
    most: Break,
    /// Greatest force and greatest torque of the substeps, maybe of two.
    greatest: JointLoad,
    breaks: bool,
}

/// The joints that can break, and those that do.
#[derive(Debug, Default)]
pub(crate) struct Broken {
    /// Those of the pace at hand that can, ascending.
    listed: Vec<Breakable>,
    /// Those that bore more than they can in the last step, ascending, and how much.
    pub(crate) found: Vec<(u32, JointLoad)>,
}

crate::footprint::footprint!(Broken { listed, found });

impl Broken {
    /// Lists the joints of a pace.
    pub(crate) fn list(&mut self, graph: &JointGraph, joints: &Joints, pace: usize) {
        self.listed.clear();
        self.listed.extend(joints.breakable.iter().filter_map(|&index| {
            let record = &joints.records[index as usize];
            let most = record.def.break_at?;
            let (place, class, slot) = record.lanes().filter(|at| pace_at(at.0) == pace)?;
            let colour = graph.colours.position(place) as u32;
            let greatest = JointLoad::default();
            Some(Breakable { index, colour, class, slot, most, greatest, breaks: false })
        }));
    }

    /// Notes what the joints bear in this substep; in the `last` one, which of them bore more than they can. `inv_h` is
    /// 1 / substep length.
    pub(crate) fn note(&mut self, graph: &JointGraph, inv_h: f32, last: bool) {
        for Breakable { colour, class, slot, most, greatest, breaks, .. } in &mut self.listed {
            let load = load_of(&graph.colours.list()[*colour as usize], *class, *slot, inv_h);
            *breaks |= !(load.force.length() <= most.force && load.torque.abs() <= most.torque);
            if load.force.length_sq() > greatest.force.length_sq() {
                greatest.force = load.force;
            }
            if load.torque.abs() > greatest.torque.abs() {
                greatest.torque = load.torque;
            }
        }
        let broken = self.listed.iter().filter(|joint| last && joint.breaks);
        self.found.extend(broken.map(|joint| (joint.index, joint.greatest)));
        // Of several paces.
        self.found.sort_unstable_by_key(|&(index, _)| index);
    }
}
