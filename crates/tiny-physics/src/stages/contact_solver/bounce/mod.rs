//! Bouncing, before the substeps: what hits something bouncy leaves at the speed that its restitution says.
//!
//! A step has rounds. In the first, what approaches faster than the threshold bounces, and what nothing presses together
//! from lower speeds on. What it pushes may hit
//! the next body in turn, so each later round looks at the contacts of the bodies that bounced in the round
//! before, and at those alone. Points that bounce in the same round are solved together, in a few iterations.
//!
//! Few contacts bounce at a time, so they are copied out of the graph into blocks of their own, colour by
//! colour, and those are full.

mod search;

use super::friction::solve_friction;
use super::normals::Normal;
use super::pair::{Constants, Pair, Stride};
use super::{CHUNK, Parameters};
use crate::dynamics::{
    Bodies, ConstraintBlock, Graph, LaneBlock, PointLanes, Schedule, flags, is_overflow,
};
use crate::footprint::footprint;
use crate::geometry::manifold::PairClass;
use crate::simd::{BLOCK, LaneKernel, Lanes, SimdLevel, dispatch_narrow};
use crate::threads::{SharedRows, SharedSlice, Team};
use search::{Hit, Search};

/// Rounds in a step: an impulse runs through this many bodies at once.
const ROUNDS: usize = 8;
/// Iterations in each of them, for points that hit at the same time. Stopping where nothing changes by more than
/// 1 mm/s was tried: among thousands of bodies that hit each other it never came before the last.
const ITERATIONS: usize = 8;
/// See [`Normal::solve_both`]: much less than where points have to carry, as two that are near to each other gain what they
/// have not come to in the last iteration.
const LEAST_DETERMINANT: f32 = 1e-4;
/// Fewer hits than this are no reason to wake threads for copying them.
const MANY: usize = 128;
/// What would leave more slowly than this part of the threshold is not handed on; of what is hardly bouncy more, in
/// inverse proportion to its restitution: there little is left to hand on, and it would cost as much.
const HANDED_ON: f32 = 0.1;

/// What a copied block has besides its constraints.
#[derive(Clone, Copy, Debug)]
struct Aims {
    /// Speeds at which the points are to leave; 0 for one that does not hit. See [`search`].
    targets: [[f32; BLOCK]; 2],
    tangent_speed: [f32; BLOCK],
}

impl Aims {
    const NULL: Self = Self { targets: [[0.0; BLOCK]; 2], tangent_speed: [0.0; BLOCK] };

    /// A lane as the first of others that are empty.
    fn lane(&self, lane: usize) -> Self {
        let mut one = Self::NULL;
        one.targets[0][0] = self.targets[0][lane];
        one.targets[1][0] = self.targets[1][lane];
        one.tangent_speed[0] = self.tangent_speed[lane];
        one
    }
}

/// The contacts of one place of the graph that bounce.
#[derive(Debug, Default)]
struct Batch {
    place: usize,
    /// Their constraints; the impulses are those of the bounce.
    blocks: Vec<ConstraintBlock>,
    aims: Vec<Aims>,
    /// Where each lane is in the graph: class and slot.
    sources: Vec<(PairClass, u32)>,
    /// Speeds at which its points are to leave.
    targets: Vec<[f32; 2]>,
}

/// Lists that [`run`] fills anew; kept for their memory.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    batches: Vec<Batch>,
    hits: Vec<Vec<Hit>>,
    /// Has a body bounced in the round before?
    marks: Vec<bool>,
    marked: Vec<u32>,
    /// Bodies that wait for what they hit first: they are looked at in the second round.
    pub(crate) waiting: Vec<u32>,
}

footprint!(Batch { blocks, aims, sources, targets } none { place });
footprint!(Memory { marks, marked, waiting } each { batches, hits });

/// Reflects what hits something bouncy, round by round.
pub(crate) fn run(
    team: &Team,
    level: SimdLevel,
    parameters: &Parameters,
    bodies: &mut Bodies,
    graph: &mut Graph,
    schedule: &Schedule,
    memory: &mut Memory,
) {
    let Memory { batches, hits, marks, marked, waiting } = memory;
    marks.resize(bodies.infos.len(), false);
    for round in 0..ROUNDS {
        let rows = SharedRows::new(&mut bodies.rows);
        let near = (round > 0).then_some(&marks[..]);
        let (motions, leave) = (&bodies.motions, HANDED_ON * parameters.restitution_threshold);
        let search = Search { graph, rows, parameters, motions, near, leave };
        let hits = search.run(team, level, schedule, hits);
        let count = copy_out(team, graph, hits, batches);
        marked.drain(..).for_each(|body| marks[body as usize] = false);
        if count == 0 && (round > 0 || waiting.is_empty()) {
            return;
        }
        let batches = &mut batches[..count];
        for _ in 0..ITERATIONS {
            for batch in &mut *batches {
                batch.run(team, level, parameters, rows);
            }
        }
        for batch in &*batches {
            batch.add_totals(graph);
            batch.mark(bodies, marks, marked);
        }
        if round == 0 {
            waiting.iter().for_each(|&body| mark(body, bodies, marks, marked));
        }
    }
    marked.drain(..).for_each(|body| marks[body as usize] = false);
}

/// Marks a body that can move.
fn mark(body: u32, bodies: &Bodies, marks: &mut [bool], marked: &mut Vec<u32>) {
    if bodies.is_dynamic(body) && !marks[body as usize] {
        marks[body as usize] = true;
        marked.push(body);
    }
}

/// Copies out what bounces, place by place. Gives the number of batches.
fn copy_out(team: &Team, graph: &Graph, hits: &[Vec<Hit>], batches: &mut Vec<Batch>) -> usize {
    let mut count = 0;
    for hit in hits.iter().flatten() {
        if count == 0 || batches[count - 1].place != hit.place {
            if batches.len() == count {
                batches.push(Batch::default());
            }
            batches[count].start(hit.place);
            count += 1;
        }
        batches[count - 1].sources.push((hit.class, hit.slot));
        batches[count - 1].targets.push(hit.targets);
    }
    let hit_count = hits.iter().map(Vec::len).sum::<usize>();
    let chunk = if hit_count < MANY { usize::MAX } else { 1 };
    team.for_each_chunk_mut(&mut batches[..count], chunk, |_, batches| {
        batches.iter_mut().for_each(|batch| batch.fill(graph));
    });
    count
}

impl Batch {
    fn start(&mut self, place: usize) {
        self.place = place;
        self.blocks.clear();
        self.aims.clear();
        self.sources.clear();
        self.targets.clear();
    }

    /// Copies the contacts out of the graph, with the speeds at which their points are to leave.
    fn fill(&mut self, graph: &Graph) {
        let Self { place, blocks, aims, sources, targets } = self;
        for (index, (&(class, slot), targets)) in sources.iter().zip(targets).enumerate() {
            let (from, at) = (slot as usize / BLOCK, slot as usize % BLOCK);
            let lane = index % BLOCK;
            if lane == 0 {
                blocks.push(ConstraintBlock::NULL);
                aims.push(Aims::NULL);
            }
            let (Some(block), Some(aims)) = (blocks.last_mut(), aims.last_mut()) else { return };
            let bucket = graph.bucket(*place, class);
            block.copy_lane(lane, &bucket.constraints[from], at);
            for point in &mut block.points {
                point.normal_impulse[lane] = 0.0;
                point.tangent_impulse[lane] = 0.0;
            }
            aims.tangent_speed[lane] = bucket.surfaces[from].tangent_speed[at];
            for (lanes, target) in aims.targets.iter_mut().zip(targets) {
                lanes[lane] = *target;
            }
        }
    }

    /// Adds the impulses to those that events of hits tell.
    fn add_totals(&self, graph: &mut Graph) {
        for (index, &(class, slot)) in self.sources.iter().enumerate() {
            let bucket = graph.bucket_mut(self.place, class);
            let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
            if bucket.heads[block].flags & flags::HIT == 0 {
                continue;
            }
            let surface = &mut bucket.surfaces[block];
            let totals = [&mut surface.total_1, &mut surface.total_2];
            for (total, point) in totals.into_iter().zip(&self.blocks[index / BLOCK].points) {
                total[lane] += point.normal_impulse[index % BLOCK];
            }
        }
    }

    /// Marks the bodies that have bounced and can move.
    fn mark(&self, bodies: &Bodies, marks: &mut [bool], marked: &mut Vec<u32>) {
        for index in 0..self.sources.len() {
            let block = &self.blocks[index / BLOCK];
            mark(block.body_a[index % BLOCK], bodies, marks, marked);
            mark(block.body_b[index % BLOCK], bodies, marks, marked);
        }
    }

    /// Lets all points leave, in lanes, or one by one in the overflow.
    fn run(
        &mut self,
        team: &Team,
        level: SimdLevel,
        parameters: &Parameters,
        rows: SharedRows<'_>,
    ) {
        let alone = is_overflow(self.place);
        let chunk = if alone { usize::MAX } else { CHUNK };
        let Self { blocks, aims, sources, .. } = self;
        let blocks = SharedSlice::new(blocks);
        team.for_each_chunk(aims.len(), chunk, |range| {
            let count = sources.len().min(range.end * BLOCK) - range.start * BLOCK;
            let (blocks, aims) = (blocks.range(range.clone()), &aims[range]);
            let leave = Leave { parameters, rows, blocks, aims, count };
            if alone { leave.one_by_one(level) } else { leave.at_once(level) }
        });
    }
}

/// Contacts that leave.
struct Leave<'a> {
    parameters: &'a Parameters,
    rows: SharedRows<'a>,
    blocks: &'a mut [ConstraintBlock],
    aims: &'a [Aims],
    /// Lanes in use.
    count: usize,
}

impl Leave<'_> {
    fn at_once(self, level: SimdLevel) {
        dispatch_narrow(level.for_count(self.count), self);
    }

    /// Each by itself, in the first lane of an empty block.
    fn one_by_one(self, level: SimdLevel) {
        let Self { parameters, rows, blocks, aims, count } = self;
        let mut one = ConstraintBlock::NULL;
        for (block, lane) in (0..count).map(|index| (index / BLOCK, index % BLOCK)) {
            one.copy_lane(0, &blocks[block], lane);
            let alone = core::slice::from_mut(&mut one);
            let aims = &[aims[block].lane(lane)];
            Leave { parameters, rows, blocks: alone, aims, count: 1 }.at_once(level);
            blocks[block].copy_lane(lane, &one, 0);
        }
    }
}

impl LaneKernel for Leave<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, token: L::Token) {
        let Self { parameters, rows, blocks, aims, count } = self;
        let constants = Constants::<L>::new(token, parameters);
        for (index, (block, aims)) in blocks.iter_mut().zip(aims).enumerate() {
            for at in (0..BLOCK.min(count - index * BLOCK)).step_by(L::WIDTH) {
                leave(&Stride { token, rows, at, constants: &constants }, block, aims);
            }
        }
    }
}

/// A point that is to leave at a speed. What does not hit keeps its nothing, and so is not rubbed.
#[inline(always)]
fn leaving<L: Lanes>(
    stride: &Stride<'_, L>,
    pair: &Pair<L>,
    point: &PointLanes,
    targets: &[f32; BLOCK],
) -> Normal<L> {
    let (zero, target) = (stride.constants.zero, stride.load(targets));
    let (arm_a, arm_b) = (stride.load(&point.normal_arm_a), stride.load(&point.normal_arm_b));
    let (old, diagonal) = (stride.load(&point.normal_impulse), pair.response(arm_a, arm_b));
    let mass = L::select(zero.lt(target), stride.load(&point.normal_mass), zero);
    let demand = pair.normal_velocity(arm_a, arm_b) - target - diagonal * old;
    Normal { arm_a, arm_b, old, diagonal, mass, demand }
}

/// Lets points leave at the speeds that the [`search`] found, rubbed by what that takes.
#[inline(always)]
fn leave<L: Lanes>(stride: &Stride<'_, L>, block: &mut ConstraintBlock, aims: &Aims) {
    let mut pair = Pair::load(stride, block);
    let friction = stride.load(&block.friction);
    let first = leaving(stride, &pair, &block.points[0], &aims.targets[0]);
    let normals = [first, leaving(stride, &pair, &block.points[1], &aims.targets[1])];
    let impulses = Normal::solve_both(&normals, stride, &mut pair, block, LEAST_DETERMINANT);
    for (point, impulse) in block.points.iter_mut().zip(impulses) {
        stride.store(impulse, &mut point.load);
        solve_friction(stride, &mut pair, point, friction, Some(&aims.tangent_speed));
    }
    pair.store(stride, block);
}
