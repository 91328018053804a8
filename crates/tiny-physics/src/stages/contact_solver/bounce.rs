//! Bouncing, before the substeps: what hits something bouncy leaves at the speed that its restitution says.
//!
//! A step has rounds. In the first, what approaches faster than the threshold bounces. What it pushes may hit
//! the next body in turn, so each later round looks at the contacts of the bodies that bounced in the round
//! before, and at those alone. Points that bounce in the same round are solved together, in a few iterations.
//!
//! Few contacts bounce at a time, so they are copied out of the graph into blocks of their own, colour by
//! colour, and those are full.

use super::Parameters;
use super::pair::{ALL_BODIES, Constants, Pair, Stride};
use crate::dynamics::{
    Bodies, Bucket, COLOURS, Graph, PointLanes, Slot, colour_at, flags, lane_block,
};
use crate::geometry::manifold::PairClass;
use crate::math::Vec2;
use crate::simd::{BLOCK, LaneKernel, Lanes, Row, SimdLevel, dispatch};
use crate::threads::{SharedRows, SharedSlice, Team};

/// Rounds in a step: an impulse runs through this many bodies at once.
const ROUNDS: usize = 8;
/// Iterations in each of them, for points that hit at the same time.
const ITERATIONS: usize = 8;
/// What would leave more slowly than this part of the threshold is not handed on.
const HANDED_ON: f32 = 0.1;
/// Blocks that one member of the team solves at a time.
const CHUNK: usize = 8;

lane_block! {
    /// Contacts of one colour that may bounce.
    struct BounceBlock {
        body_a: u32 = 0,
        body_b: u32 = 0,
        normal_x: f32 = 0.0,
        normal_y: f32 = 0.0,
        restitution: f32 = 0.0,
        friction: f32 = 0.0,
        tangent_speed: f32 = 0.0,
    }
}

lane_block! {
    /// One of their points; see [`PointLanes`].
    struct BouncePoint {
        separation: f32 = 0.0,
        normal_arm_a: f32 = 0.0,
        normal_arm_b: f32 = 0.0,
        tangent_arm_a: f32 = 0.0,
        tangent_arm_b: f32 = 0.0,
        normal_mass: f32 = 0.0,
        tangent_mass: f32 = 0.0,
        /// Speed at which it is to leave; 0 if it does not hit. See [`aim`].
        target: f32 = 0.0,
        /// What makes it leave, newton seconds.
        normal_impulse: f32 = 0.0,
        /// What rubs it meanwhile.
        tangent_impulse: f32 = 0.0,
    }
}

/// The contacts of one place of the graph that may bounce.
#[derive(Debug, Default)]
struct Batch {
    place: usize,
    blocks: Vec<BounceBlock>,
    points: Vec<[BouncePoint; 2]>,
    /// Where each lane is in the graph.
    sources: Vec<(PairClass, u32)>,
}

/// Lists that [`run`] fills anew; kept for their memory.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    batches: Vec<Batch>,
    /// Has a body bounced in the round before?
    marks: Vec<bool>,
    marked: Vec<u32>,
}

/// Reflects what hits something bouncy, round by round.
pub(crate) fn run(
    team: &Team,
    level: SimdLevel,
    parameters: &Parameters,
    bodies: &mut Bodies,
    graph: &mut Graph,
    occupied: &[(usize, PairClass)],
    memory: &mut Memory,
) {
    let Memory { batches, marks, marked } = memory;
    let mut parameters = *parameters;
    let least_bounce = HANDED_ON * parameters.restitution_threshold;
    marks.resize(bodies.infos.len(), false);
    for round in 0..ROUNDS {
        let near = (round > 0).then_some(&**marks);
        let count = collect(graph, occupied, near, &bodies.rows, &parameters, batches);
        marked.drain(..).for_each(|body| marks[body as usize] = false);
        if count == 0 {
            return;
        }
        let batches = &mut batches[..count];
        let rows = SharedRows::new(&mut bodies.rows);
        for _ in 0..ITERATIONS {
            for batch in &mut *batches {
                batch.run(team, level, &parameters, rows);
            }
        }
        for batch in &*batches {
            batch.note_peaks(graph);
            batch.mark(bodies, marks, marked);
        }
        parameters.restitution_threshold = 0.0;
        parameters.least_bounce = least_bounce;
    }
    marked.drain(..).for_each(|body| marks[body as usize] = false);
}

/// Copies out what bounces, of all that approaches fast or of what is near a marked body. Gives the number
/// of batches.
fn collect(
    graph: &Graph,
    occupied: &[(usize, PairClass)],
    near: Option<&[bool]>,
    rows: &[Row],
    parameters: &Parameters,
    batches: &mut Vec<Batch>,
) -> usize {
    let mut count = 0;
    for &(place, class) in occupied {
        let bucket = &graph.buckets[place][class as usize];
        for (block, head) in bucket.heads.iter().enumerate() {
            if head.flags & flags::RESTITUTION == 0 {
                continue;
            }
            let mut lanes = match near {
                Some(marks) => near_lanes(bucket, block, marks),
                None => approaching_lanes(bucket, block, parameters.restitution_threshold),
            };
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                let Some(targets) = aim(bucket, (block, lane), rows, parameters) else { continue };
                if count == 0 || batches[count - 1].place != place {
                    if batches.len() == count {
                        batches.push(Batch::default());
                    }
                    batches[count].start(place);
                    count += 1;
                }
                batches[count - 1].push(bucket, class, (block, lane), targets);
            }
        }
    }
    count
}

/// Lanes whose points approach faster than the threshold.
fn approaching_lanes(bucket: &Bucket, block: usize, threshold: f32) -> u16 {
    let surface = &bucket.surfaces[block];
    (0..BLOCK).fold(0, |lanes, lane| {
        let [first, second] = [surface.approach_1[lane], surface.approach_2[lane]];
        lanes | u16::from((first < -threshold) | (second < -threshold)) << lane
    })
}

/// Lanes with a marked body.
fn near_lanes(bucket: &Bucket, block: usize, marks: &[bool]) -> u16 {
    let block = &bucket.constraints[block];
    (0..BLOCK).fold(0, |lanes, lane| {
        let [a, b] = [block.body_a[lane], block.body_b[lane]].map(|body| marks[body as usize]);
        lanes | u16::from(a | b) << lane
    })
}

impl Batch {
    fn start(&mut self, place: usize) {
        self.place = place;
        self.blocks.clear();
        self.points.clear();
        self.sources.clear();
    }

    /// Copies a contact out of the graph, with the speeds at which its points are to leave.
    fn push(
        &mut self,
        bucket: &Bucket,
        class: PairClass,
        (from, at): (usize, usize),
        targets: [f32; 2],
    ) {
        let lane = self.sources.len() % BLOCK;
        if lane == 0 {
            self.blocks.push(BounceBlock::NULL);
            self.points.push([BouncePoint::NULL; 2]);
        }
        self.sources.push((class, (from * BLOCK + at) as u32));
        let (constraint, surface) = (&bucket.constraints[from], &bucket.surfaces[from]);
        if let (Some(block), Some(points)) = (self.blocks.last_mut(), self.points.last_mut()) {
            block.body_a[lane] = constraint.body_a[at];
            block.body_b[lane] = constraint.body_b[at];
            block.normal_x[lane] = constraint.normal_x[at];
            block.normal_y[lane] = constraint.normal_y[at];
            block.restitution[lane] = surface.restitution[at];
            block.friction[lane] = constraint.friction[at];
            block.tangent_speed[lane] = surface.tangent_speed[at];
            for ((to, from), target) in points.iter_mut().zip(&constraint.points).zip(targets) {
                to.copy_from(lane, from, at);
                to.target[lane] = target;
            }
        }
    }

    /// Notes impulses for the events of hits.
    fn note_peaks(&self, graph: &mut Graph) {
        for (index, &(class, slot)) in self.sources.iter().enumerate() {
            let bucket = &mut graph.buckets[self.place][class as usize];
            let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
            if bucket.heads[block].flags & flags::HIT == 0 {
                continue;
            }
            let surface = &mut bucket.surfaces[block];
            let impulses =
                self.points[index / BLOCK].each_ref().map(|p| p.normal_impulse[index % BLOCK]);
            for (peak, impulse) in
                [&mut surface.peak_1, &mut surface.peak_2].into_iter().zip(impulses)
            {
                if impulse > peak[lane] {
                    peak[lane] = impulse;
                }
            }
        }
    }

    /// Marks the bodies that have bounced and can move.
    fn mark(&self, bodies: &Bodies, marks: &mut [bool], marked: &mut Vec<u32>) {
        for index in 0..self.sources.len() {
            let block = &self.blocks[index / BLOCK];
            for body in [block.body_a[index % BLOCK], block.body_b[index % BLOCK]] {
                if bodies.is_dynamic(body) && !marks[body as usize] {
                    marks[body as usize] = true;
                    marked.push(body);
                }
            }
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
        let in_order = colour_at(self.place) == COLOURS;
        let (level, chunk) =
            if in_order { (SimdLevel::Scalar, usize::MAX) } else { (level, CHUNK) };
        let blocks = &self.blocks;
        let points = SharedSlice::new(&mut self.points);
        team.for_each_chunk(blocks.len(), chunk, |range| {
            let (blocks, points) = (&blocks[range.clone()], points.range(range));
            dispatch(level, Leave { parameters, rows, blocks, points });
        });
    }
}

impl BouncePoint {
    fn copy_from(&mut self, lane: usize, from: &PointLanes, at: usize) {
        self.separation[lane] = from.separation[at];
        self.normal_arm_a[lane] = from.normal_arm_a[at];
        self.normal_arm_b[lane] = from.normal_arm_b[at];
        self.tangent_arm_a[lane] = from.tangent_arm_a[at];
        self.tangent_arm_b[lane] = from.tangent_arm_b[at];
        self.normal_mass[lane] = from.normal_mass[at];
        self.tangent_mass[lane] = from.tangent_mass[at];
    }
}

/// How fast the points of a contact are to leave, if one of them hits in this step; 0 for one that does not.
///
/// With approach v, separation s, closing acceleration c and restitution e, the surfaces meet at speed
/// `sqrt(v^2 + 2 c s)`. The bounce takes place here, at separation s, so the speed that has to be set is
/// `sqrt(e^2 (v^2 + 2 c s) - 2 c s)`. Velocities of the semi-implicit scheme are half a substep late:
/// `c h / 2` is missing from the approach and needed on top of the speed.
fn aim(
    bucket: &Bucket,
    (block, lane): (usize, usize),
    rows: &[Row],
    parameters: &Parameters,
) -> Option<[f32; 2]> {
    let constraint = &bucket.constraints[block];
    let restitution = bucket.surfaces[block].restitution[lane];
    let a = &rows[constraint.body_a[lane] as usize];
    let b = &rows[constraint.body_b[lane] as usize];
    let normal = Vec2::new(constraint.normal_x[lane], constraint.normal_y[lane]);
    let along = normal.dot(Vec2::new(b[Slot::VX] - a[Slot::VX], b[Slot::VY] - a[Slot::VY]));
    // What falls onto something fixed; what falls together does not close in.
    let pull = normal.dot(parameters.gravity);
    let pulled = |row: &Row, pull: f32| if row[Slot::INV_MASS] > 0.0 { 0.0 } else { pull };
    let closing = positive(pulled(b, pull) - pulled(a, pull));
    let late = closing * (0.5 * parameters.h);
    let targets = constraint.points.each_ref().map(|point| {
        let (arm_a, arm_b) = (point.normal_arm_a[lane], point.normal_arm_b[lane]);
        let velocity = along + (arm_b * b[Slot::W] - arm_a * a[Slot::W]);
        let s = point.separation[lane];
        let fast = velocity < -parameters.restitution_threshold
            && restitution * velocity < -parameters.least_bounce;
        if !fast || s + velocity * parameters.dt >= 0.0 || point.normal_mass[lane] <= 0.0 {
            return 0.0;
        }
        let fall = 2.0 * closing * s;
        let approach = late - velocity;
        let meet = positive(approach * approach + fall);
        positive(restitution * restitution * meet - fall).sqrt() + late
    });
    (targets != [0.0; 2]).then_some(targets)
}

fn positive(value: f32) -> f32 {
    if value > 0.0 { value } else { 0.0 }
}

struct Leave<'a> {
    parameters: &'a Parameters,
    rows: SharedRows<'a>,
    blocks: &'a [BounceBlock],
    points: &'a mut [[BouncePoint; 2]],
}

impl LaneKernel for Leave<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, token: L::Token) {
        let Self { parameters, rows, blocks, points } = self;
        let constants = Constants::<L>::new(token, parameters);
        for (block, points) in blocks.iter().zip(points) {
            for at in (0..BLOCK).step_by(L::WIDTH) {
                leave(&Stride { token, rows, at, constants: &constants }, block, points);
            }
        }
    }
}

impl BounceBlock {
    #[inline(always)]
    fn pair<L: Lanes>(&self, stride: &Stride<'_, L>) -> Pair<L> {
        Pair::gather(stride, [&self.body_a, &self.body_b], [&self.normal_x, &self.normal_y])
    }
}

/// Lets points leave at the speeds that [`aim`] found, rubbed by what that takes.
#[inline(always)]
fn leave<L: Lanes>(stride: &Stride<'_, L>, block: &BounceBlock, points: &mut [BouncePoint; 2]) {
    let zero = stride.constants.zero;
    let mut pair = block.pair(stride);
    let friction = stride.load(&block.friction);
    let surface_speed = stride.load(&block.tangent_speed);
    for point in points {
        let (arm_a, arm_b) = (stride.load(&point.normal_arm_a), stride.load(&point.normal_arm_b));
        let target = stride.load(&point.target);
        let hits = zero.lt(target);
        let old = stride.load(&point.normal_impulse);
        let missing = target - pair.normal_velocity(arm_a, arm_b);
        let impulse = (old + stride.load(&point.normal_mass) * missing).max(zero);
        let impulse = L::select(hits, impulse, old);
        stride.store(impulse, &mut point.normal_impulse);
        pair.push(impulse - old, arm_a, arm_b);

        let (arm_a, arm_b) = (stride.load(&point.tangent_arm_a), stride.load(&point.tangent_arm_b));
        let old = stride.load(&point.tangent_impulse);
        let slip = pair.tangent_velocity(arm_a, arm_b) + surface_speed;
        let limit = friction * impulse;
        let rubbed = (old - stride.load(&point.tangent_mass) * slip).clamp(-limit, limit);
        let rubbed = L::select(hits, rubbed, old);
        stride.store(rubbed, &mut point.tangent_impulse);
        pair.rub(rubbed - old, arm_a, arm_b);
    }
    pair.scatter(stride, [&block.body_a, &block.body_b], ALL_BODIES);
}
