//! Bouncing, before the substep in which something bouncy is hit: what hits it leaves at the speed that its restitution says.
//!
//! A substep has rounds. In the first, what came faster than the threshold when the step began bounces, and what nothing
//! presses together from lower speeds on. What it pushes may hit the next body in turn, so each later round looks at the
//! contacts of the bodies that bounced in the round before, and at those alone; those of them that will hit in later
//! substeps are looked at in these. What hits a body later than something else waits for the next round. Points that bounce in the
//! same round are solved together, in a few iterations.
//!
//! Few contacts bounce at a time, so they are copied out of the graph into blocks of their own, colour by
//! colour, and those are full.

mod moment;
mod order;
mod search;

use super::friction::solve_friction;
use super::normals::Normal;
use super::pair::{Constants, Pair, Stride};
use super::{CHUNK, Parameters};
use crate::dynamics::{
    Bodies, ConstraintBlock, Contacts, Graph, LaneBlock, NULL, PointLanes, flags, is_overflow,
};
use crate::footprint::footprint;
use crate::math::Vec2;
use crate::simd::{BLOCK, LaneKernel, Lanes, SimdLevel, dispatch_narrow};
use crate::stages::anew::Scope;
use crate::stages::islands::Stores;
use crate::threads::{SharedRows, SharedSlice, Team};
use order::Order;
use search::{At, Hit, Search, leaves};

/// Rounds in a substep: an impulse runs through this many bodies at once.
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

/// What is less bouncy than this is left where it was found: it loses so much anyway that nobody misses the rest, and in a drum of
/// things of restitution .1 bringing them up took 4 % of the step.
pub(crate) const SPRINGY: f32 = 0.25;

/// What a copied block has besides its constraints.
#[derive(Clone, Copy, Debug)]
struct Aims {
    /// Speeds at which the points are to leave; 0 for one that does not hit. See [`search`].
    targets: [[f32; BLOCK]; 2],
    /// See [`solve_friction`].
    slips: [[f32; BLOCK]; 2],
    tangent_speed: [f32; BLOCK],
}

impl Aims {
    const NULL: Self = {
        let none = [[0.0; BLOCK]; 2];
        Self { targets: none, slips: none, tangent_speed: [0.0; BLOCK] }
    };
}

/// Contacts that bounce and have no bodies in common: those of a colour, or one of an overflow.
#[derive(Debug, Default)]
struct Batch {
    /// Their constraints; the impulses are those of the bounce.
    blocks: Vec<ConstraintBlock>,
    aims: Vec<Aims>,
    /// What each lane is of.
    hits: Vec<Hit>,
}

/// Lists that [`Bounces::run`] fills anew; kept for their memory.
#[derive(Debug, Default)]
pub(crate) struct Bounces {
    /// Contacts that come to bounce in the step, and those that are looked at in a round.
    approaching: Vec<At>,
    list: Vec<At>,
    /// The greatest restitution.
    bounciest: f32,
    found: Vec<Vec<Hit>>,
    hits: Vec<Hit>,
    order: Order,
    batches: Vec<Batch>,
    /// Bodies that bounce in this round, some more than once, and how far their velocities were from `starts`; then how
    /// these change, at one place.
    changes: Vec<(u32, [f32; 3])>,
    /// Bodies that wait for what they hit first: they are looked at in the second round.
    pub(crate) waiting: Vec<u32>,
    /// What bounced off bodies with joints.
    joined: Vec<Hit>,
    /// Impulses of bounces that events of hits tell.
    told: Vec<(At, [f32; 2])>,
}

footprint!(Batch { blocks, aims, hits });
footprint!(Bounces { approaching, list, hits, order, changes, waiting, joined, told } each { found, batches } none { bounciest });

impl Bounces {
    /// Begins with the contacts of a pace.
    pub(crate) fn begin(&mut self, graph: &Graph, pace: usize, parameters: &Parameters) {
        self.bounciest = search::list_approaching(graph, pace, parameters, &mut self.approaching);
    }

    /// Reflects what hits something bouncy in the next substep, round by round.
    pub(crate) fn run(
        &mut self,
        (team, level): (&Team, SimdLevel),
        parameters: &Parameters,
        stores: &mut Stores<'_>,
        (pace, scope): (usize, Scope<'_>),
    ) {
        self.joined.clear();
        if self.approaching.is_empty() && self.waiting.is_empty() {
            return;
        }
        self.changes.clear();
        self.order.begin();
        self.list.clone_from(&self.approaching);
        for round in 0..ROUNDS {
            let Stores { bodies, graph, .. } = stores;
            let rows = SharedRows::new(&mut bodies.rows);
            let (motions, first) = (&bodies.motions, round == 0);
            let search = Search { graph, rows, parameters, motions, first };
            let found = (&mut self.hits, &mut self.approaching);
            search.run(team, &self.list, &mut self.found, found);
            self.order.take_up(search, &mut self.hits);
            self.bring_up(stores, scope, parameters);
            if self.hits.is_empty() && (!first || self.waiting.is_empty()) {
                return;
            }
            if round + 1 < ROUNDS {
                self.order.put_off(stores, &mut self.hits, 1.0 / parameters.inv_h);
            }
            let count = self.leave((team, level), parameters, stores, &[], |_| {});
            let Stores { bodies, contacts, graph, .. } = stores;
            self.order.note(bodies, graph, &self.hits);
            let is_joined = |body: u32| bodies.infos[body as usize].first_joint != NULL;
            let done = self.batches[..count].iter().flat_map(Batch::done);
            self.joined.extend(done.filter(|hit| {
                let (a, b) = graph.bucket(hit.at.place, hit.at.class).bodies(hit.at.slot);
                is_joined(a) || is_joined(b)
            }));
            if first {
                let waiting = self.waiting.iter().filter(|&&body| bodies.is_dynamic(body));
                self.changes.extend(waiting.map(|&body| (body, [f32::INFINITY; 3])));
            }
            self.list_near((bodies, contacts, graph), pace, parameters.restitution_threshold);
        }
    }

    /// Brings what is springy up to where its bodies are when it hits; what does not hit there is left to later substeps.
    fn bring_up(&mut self, stores: &mut Stores<'_>, scope: Scope<'_>, parameters: &Parameters) {
        let Stores { bodies, graph, .. } = stores;
        let (hits, approaching) = (&mut self.hits, &mut self.approaching);
        hits.retain_mut(|hit| {
            let Hit { at, first, .. } = *hit;
            if at.restitution(graph) < SPRINGY {
                return true;
            }
            let bucket = graph.bucket_mut(at.place, at.class);
            let since = |both| self.order.since(both).unwrap_or(-parameters.dt);
            let end = 1.0 / parameters.inv_h;
            let due = moment::bring_up(bodies, bucket, scope, at.slot, (since, end));
            let (rows, motions) = (SharedRows::new(&mut bodies.rows), &bodies.motions);
            let aimed = Search { graph, rows, parameters, motions, first }.aim(at);
            let still = aimed.filter(|aimed| aimed.targets != [0.0; 2]);
            if still.is_none() && !first {
                approaching.push(at);
            }
            still.inspect(|&still| *hit = Hit { due, ..still }).is_some()
        });
    }

    /// Lets what bounced off joined bodies bounce off all that hangs on them: each time that joints have taken their part of what that
    /// was, what is left to its speed is made up for.
    pub(crate) fn hand_on(
        &mut self,
        (team, level): (&Team, SimdLevel),
        parameters: &Parameters,
        stores: &mut Stores<'_>,
        listed: &[u32],
        joints: impl Fn(&mut Stores<'_>),
    ) {
        self.hits.clone_from(&self.joined);
        self.hits.sort_by_key(|hit| hit.at.key());
        self.hits.dedup_by(|later, hit| {
            let same = later.at.key() == hit.at.key();
            if same {
                hit.add(later);
            }
            same
        });
        let rows = SharedRows::new(&mut stores.bodies.rows);
        self.hits.retain_mut(|hit| hit.keep(stores.graph, rows));
        if !self.hits.is_empty() {
            self.changes.clear();
            self.leave((team, level), parameters, stores, listed, joints);
        }
    }

    /// Adds the impulses of the bounces to those that events of hits tell.
    pub(crate) fn end(&mut self, graph: &mut Graph) {
        for (At { place, class, slot }, [first, second]) in self.told.drain(..) {
            let surface = &mut graph.bucket_mut(place, class).surfaces[slot / BLOCK];
            surface.total_1[slot % BLOCK] += first;
            surface.total_2[slot % BLOCK] += second;
        }
    }

    /// Lists the contacts of changed bodies that are bouncy enough for the change to be handed on.
    fn list_near(
        &mut self,
        (bodies, contacts, graph): (&Bodies, &Contacts, &Graph),
        pace: usize,
        threshold: f32,
    ) {
        self.list.clear();
        let changed = self.changes.drain(..).filter(|&(_, change)| change != [0.0; 3]);
        for (body, [x, y, turn]) in changed {
            let info = &bodies.infos[body as usize];
            // What comes faster than the threshold without it is known.
            let most = Vec2::new(x, y).length() + turn.abs() * info.max_extent + threshold;
            if leaves(self.bounciest, -most, threshold) {
                let all = contacts.of_body(info.first_contact);
                let here = |(index, _)| At::of(&contacts.records[index as usize], pace);
                let bouncy = |at: &At| leaves(at.restitution(graph), -most, threshold);
                self.list.extend(all.filter_map(here).filter(bouncy));
            }
        }
    }

    /// Lets what hits leave, notes how that changes its bodies, and gives the number of batches. `joints` is run before each iteration; they move those of the
    /// bodies `listed` that have any.
    fn leave(
        &mut self,
        (team, level): (&Team, SimdLevel),
        parameters: &Parameters,
        stores: &mut Stores<'_>,
        listed: &[u32],
        joints: impl Fn(&mut Stores<'_>),
    ) -> usize {
        let Self { hits, batches, changes, told, .. } = self;
        let Stores { bodies, graph, .. } = stores;
        let count = copy_out(team, graph, hits, batches);
        let batches = &mut batches[..count];
        let is_joined = |body: &u32| bodies.infos[*body as usize].first_joint != NULL;
        let joined = listed.iter().copied().filter(is_joined);
        let all = batches.iter().flat_map(Batch::bodies).chain(joined);
        changes.extend(all.filter(|&body| bodies.is_dynamic(body)).map(|body| {
            let (row, start) = (&bodies.rows[body as usize], &bodies.starts[body as usize]);
            (body, [0, 1, 2].map(|k| row[k] - start[k]))
        }));
        for _ in 0..ITERATIONS {
            joints(stores);
            let rows = SharedRows::new(&mut stores.bodies.rows);
            batches.iter_mut().for_each(|batch| batch.run(team, level, parameters, rows));
        }
        let Stores { bodies, graph, .. } = stores;
        batches.iter().for_each(|batch| {
            batch.tell(graph, told);
            batch.set_out(bodies);
        });
        for (body, change) in changes {
            let at = *body as usize;
            let (row, start) = (&bodies.rows[at], &mut bodies.starts[at]);
            for k in 0..3 {
                // It is no impulse of the substep before, which would be carried on.
                let moved = row[k] - change[k];
                (change[k], start[k]) = (moved - start[k], moved);
            }
        }
        count
    }
}

/// Copies out what bounces, colour by colour. Gives the number of batches.
fn copy_out(team: &Team, graph: &Graph, hits: &[Hit], batches: &mut Vec<Batch>) -> usize {
    let mut count = 0;
    let together = |a: &Hit, b: &Hit| a.at.place == b.at.place && !is_overflow(a.at.place);
    for hits in hits.chunk_by(together) {
        if batches.len() == count {
            batches.push(Batch::default());
        }
        batches[count].start(hits);
        count += 1;
    }
    let chunk = if hits.len() < MANY { usize::MAX } else { 1 };
    team.for_each_chunk_mut(&mut batches[..count], chunk, |_, batches| {
        batches.iter_mut().for_each(|batch| batch.fill(graph));
    });
    count
}

impl Batch {
    fn start(&mut self, hits: &[Hit]) {
        self.blocks.clear();
        self.aims.clear();
        self.hits.clear();
        self.hits.extend_from_slice(hits);
    }

    /// Copies the contacts out of the graph, with the speeds at which their points are to leave.
    fn fill(&mut self, graph: &Graph) {
        let Self { blocks, aims, hits, .. } = self;
        for (index, Hit { at: source, targets, slips, given, .. }) in hits.iter().enumerate() {
            let (from, at) = (source.slot / BLOCK, source.slot % BLOCK);
            let lane = index % BLOCK;
            if lane == 0 {
                blocks.push(ConstraintBlock::NULL);
                aims.push(Aims::NULL);
            }
            let (Some(block), Some(aims)) = (blocks.last_mut(), aims.last_mut()) else { return };
            let bucket = graph.bucket(source.place, source.class);
            block.copy_lane(lane, &bucket.constraints[from], at);
            (block.body_a[lane], block.body_b[lane]) = bucket.bodies(source.slot);
            for (point, given) in block.points.iter_mut().zip(given) {
                [point.normal_impulse[lane], point.tangent_impulse[lane]] = *given;
            }
            aims.tangent_speed[lane] = bucket.surfaces[from].tangent_speed[at];
            for k in 0..2 {
                (aims.targets[k][lane], aims.slips[k][lane]) = (targets[k], slips[k]);
            }
        }
    }

    /// Lists the impulses that events of hits tell.
    fn tell(&self, graph: &Graph, told: &mut Vec<(At, [f32; 2])>) {
        for (before, Hit { at, given, .. }) in self.hits.iter().zip(self.done()) {
            let head = graph.bucket(at.place, at.class).heads[at.slot / BLOCK];
            if head.flags & flags::SUMMED != 0 {
                told.push((at, [0, 1].map(|k| given[k][0] - before.given[k][0])));
            }
        }
    }

    /// Has its bodies set out from where they meet.
    fn set_out(&self, bodies: &mut Bodies) {
        for (index, hit) in self.hits.iter().enumerate().filter(|(_, hit)| hit.due != 0.0) {
            moment::set_out(bodies, &self.blocks[index / BLOCK], index % BLOCK, hit.due);
        }
    }

    /// Its hits with all that they were given.
    fn done(&self) -> impl Iterator<Item = Hit> {
        self.hits.iter().enumerate().map(|(index, hit)| {
            let (points, lane) = (&self.blocks[index / BLOCK].points, index % BLOCK);
            let given = points.each_ref();
            Hit { given: given.map(|p| [p.normal_impulse[lane], p.tangent_impulse[lane]]), ..*hit }
        })
    }

    fn bodies(&self) -> impl Iterator<Item = u32> {
        (0..self.hits.len()).flat_map(|index| {
            let (block, lane) = (&self.blocks[index / BLOCK], index % BLOCK);
            [block.body_a[lane], block.body_b[lane]]
        })
    }

    /// Lets all points leave.
    fn run(
        &mut self,
        team: &Team,
        level: SimdLevel,
        parameters: &Parameters,
        rows: SharedRows<'_>,
    ) {
        let Self { blocks, aims, hits, .. } = self;
        let blocks = SharedSlice::new(blocks);
        team.for_each_chunk(aims.len(), CHUNK, |range| {
            let count = hits.len().min(range.end * BLOCK) - range.start * BLOCK;
            let (blocks, aims) = (blocks.range(range.clone()), &aims[range]);
            let leave = Leave { parameters, rows, blocks, aims, count };
            dispatch_narrow(level.for_count(count), leave);
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
    }
    let (belt, slips) = (Some(&aims.tangent_speed), Some(&aims.slips));
    solve_friction::<L, 2>(stride, &mut pair, &mut block.points, friction, belt, slips);
    pair.store(stride, block);
}
