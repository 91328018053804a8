//! The world: the one facade over everything below.

mod bodies;
mod body_changes;
mod build;
mod bytes;
mod check;
mod contacts;
mod debug_draw;
mod events;
mod forces;
mod frame;
mod freeze;
mod hash;
mod hooks;
mod ids;
mod joints;
mod memory;
mod mover;
#[cfg(feature = "serde")]
pub(crate) mod packed;
mod queries;
mod sensors;
mod shape_changes;
mod shapes;
mod stats;
#[cfg(test)]
mod tests;
mod tiles;
mod validate;

pub use bodies::{Body, BodyMut};
pub use contacts::{ContactPoint, ContactView};
pub use events::{ContactBegin, ContactEnd, Events, Hit, JointBreak, SensorBegin, SensorEnd};
pub use forces::{Explosion, ForceZone, Water, Wind, ZoneForce};
pub use hooks::{ContactRules, ShapePair};
pub use ids::{BodyId, JointId, ShapeId, TileGridId};
pub use joints::JointRef;
pub use memory::{Memory, MemoryUse};
pub use mover::{CharacterMover, MoverGround, MoverInput};
pub use queries::{ClosestPoint, QueryFilter, RayCast, RayCastHit, ShapeCastHit};
pub use shape_changes::ShapeMut;
pub use shapes::ShapeRef;
pub use stats::{Stage, Stats};

use crate::broad_phase::BroadPhase;
use crate::describe::Settings;
use crate::dynamics::{
    Bodies, Contacts, Graph, IDLE, JointGraph, JointLoad, Joints, Overlap, PACES, PLAIN,
    REFINEMENT, Schedule, Sensors, Shapes, Transfers, Waiting, places_of,
};
use crate::error::Error;
use crate::math::Vec2;
use crate::simd::SimdLevel;
use crate::stages::boxes::Moved;
use crate::stages::contact_solver::{self, BounceMemory, Parameters, Pass, Softness};
use crate::stages::finalize::{FastBody, Findings};
use crate::stages::islands::Stores;
use crate::stages::touching::Changes;
use crate::stages::{
    continuous, finalize, integrate, joint_solver, narrow_phase, paces, pairs, sleep, surfaces,
    touching,
};
use crate::threads::{Pool, SharedRows, Team};
use stats::Stopwatch;
use std::sync::OnceLock;

/// Metres; multiplied by [`Settings::length_unit`]. Points this far apart are contacts already.
const SPECULATIVE_DISTANCE: f32 = 0.02;
/// Metres; multiplied by [`Settings::length_unit`]. Room around a shape in its fat box.
const FAT_MARGIN: f32 = 0.1;
/// Contacts against static bodies are this much stiffer.
const STATIC_STIFFNESS: f32 = 2.0;
/// Contact stiffness is at most this fraction of the substep rate. Sinking goes with the inverse square:
/// 0.125, as elsewhere, lets a tower of 20 crates sink by 0.135 m, 0.22 by 0.044 m. From 0.25 on a pyramid
/// of 40 rows no longer comes to rest.
const CONTACT_RATE_FRACTION: f32 = 0.22;

/// Metres a second; multiplied by [`Settings::length_unit`]. Overlaps that close in faster are solved without
/// softness, which would let a part of the speed pass.
const FAST_APPROACH: f32 = 10.0;
/// What is deeper in than its load accounts for is pushed out at this rate, 1 / second.
const PUSH_RATE: f32 = 20.0;

/// A world of bodies.
///
/// ```
/// use tiny_physics::{RigidBody, Shape, Vec2, World};
/// # fn main() -> Result<(), tiny_physics::Error> {
/// let mut world = World::new(Vec2::new(0.0, -9.8));
/// let ground = Shape::Aabb { half_extents: Vec2::new(20.0, 1.0) };
/// world.add_body(RigidBody::new(ground, Vec2::new(0.0, -1.0), 0.0))?;
/// let ball = world.add_body(RigidBody::new(Shape::Circle { radius: 0.5 }, Vec2::new(0.0, 4.0), 1.0))?;
/// for _ in 0..300 {
///     world.step(1.0 / 60.0);
/// }
/// assert!((world.body(ball).unwrap().position().y - 0.5).abs() < 0.01);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct World {
    /// Acceleration of every dynamic body, metres a second squared.
    pub gravity: Vec2,
    /// Substeps, iterations, thresholds.
    pub settings: Settings,
    bodies: Bodies,
    shapes: Shapes,
    contacts: Contacts,
    waiting: Waiting,
    graph: Graph,
    joints: Joints,
    joint_graph: JointGraph,
    broad_phase: BroadPhase,
    tiles: tiles::TileGrids,
    sensors: Sensors,
    hooks: hooks::Hooks,
    events: Events,
    /// Which bodies the last step moved, once somebody has asked.
    moved: OnceLock<Vec<BodyId>>,
    step_count: u64,
    /// 1 / substep length of the last step, at the plain pace.
    inv_h: f32,
    level: SimdLevel,
    pool: Pool,
    stats: Stats,
    scratch: Scratch,
}

/// Lists that a step fills anew; kept only for their memory.
#[derive(Debug, Default)]
struct Scratch {
    search: pairs::Search,
    created: Vec<u32>,
    transfers: Transfers,
    changes: Changes,
    found_changes: Vec<Changes>,
    findings: Vec<Findings>,
    fast: Vec<FastBody>,
    moved: Vec<Moved>,
    islands: Vec<u32>,
    sets: sleep::Sets,
    paces: paces::Memory,
    woken: Vec<u32>,
    hinges: Vec<u32>,
    listed: Vec<u32>,
    schedule: Schedule,
    bounces: BounceMemory,
    overlaps: Vec<Overlap>,
    found_overlaps: Vec<Vec<Overlap>>,
    touching: Vec<hooks::At>,
    answers: Vec<Vec<ContactRules>>,
    broken_joints: Vec<(u32, JointLoad)>,
}

/// Numbers of one step.
#[derive(Clone, Copy, Debug)]
struct StepLengths {
    dt: f32,
    h: f32,
    substeps: u32,
    iterations: u32,
}

impl StepLengths {
    /// The same for a pace.
    fn refined(self, pace: usize) -> Self {
        let refinement = REFINEMENT[pace];
        Self { h: self.h / refinement as f32, substeps: self.substeps * refinement, ..self }
    }
}

impl World {
    /// An empty world with default settings.
    pub fn new(gravity: Vec2) -> Self {
        Self::with_settings(gravity, Settings::default())
    }

    /// An empty world with settings of your own.
    pub fn with_settings(gravity: Vec2, settings: Settings) -> Self {
        Self {
            gravity,
            settings,
            bodies: Bodies::new(),
            shapes: Shapes::default(),
            contacts: Contacts::default(),
            waiting: Waiting::default(),
            graph: Graph::new(),
            joints: Joints::default(),
            joint_graph: JointGraph::new(),
            broad_phase: BroadPhase::new(),
            tiles: tiles::TileGrids::default(),
            sensors: Sensors::default(),
            hooks: hooks::Hooks::default(),
            events: Events::default(),
            moved: OnceLock::new(),
            step_count: 0,
            inv_h: 0.0,
            level: SimdLevel::detect(),
            pool: Pool::default(),
            stats: Stats::default(),
            scratch: Scratch::default(),
        }
    }

    /// Moves the world on by `dt` seconds. Does nothing where `dt` is not a positive finite number;
    /// [`World::try_step`] says so.
    pub fn step(&mut self, dt: f32) {
        if self.try_step(dt).is_err() {
            self.stats.refused_steps += 1;
        }
    }

    /// Moves the world on by `dt` seconds.
    ///
    /// # Errors
    /// `dt` or gravity is not finite, `dt` not above 0, or a setting out of range. The world has not changed
    /// then.
    pub fn try_step(&mut self, dt: f32) -> Result<(), Error> {
        let lengths = self.step_lengths(dt)?;
        let pool = self.pool.clone();
        pool.scope(|team| self.run_stages(team, lengths));
        self.step_count += 1;
        Ok(())
    }

    /// The step: one line a stage.
    fn run_stages(&mut self, team: &Team, lengths: StepLengths) {
        let mut watch = Stopwatch::start();
        self.events.clear();
        self.moved.take();
        self.bodies.sort_awake();
        self.refresh_surfaces();

        self.update_pairs(team);
        watch.lap(&mut self.stats, Stage::Pairs);
        self.update_manifolds(team);
        watch.lap(&mut self.stats, Stage::NarrowPhase);
        self.update_touching(team, lengths);
        self.call_pre_solve(team);
        watch.lap(&mut self.stats, Stage::Touching);
        self.solve(team, lengths);
        watch.lap(&mut self.stats, Stage::Solve);
        self.finalize(team, lengths);
        watch.lap(&mut self.stats, Stage::Finalize);
        self.sweep_fast_bodies(team);
        watch.lap(&mut self.stats, Stage::Continuous);
        self.update_sensors(team);
        self.put_resting_islands_to_sleep();
        self.events.flush_pending();
        watch.lap(&mut self.stats, Stage::Sleep);
    }

    /// Checks the step's numbers and divides them up.
    fn step_lengths(&self, dt: f32) -> Result<StepLengths, Error> {
        Error::check_positive("dt", dt)?;
        self.settings.validate()?;
        Error::check_finite_vec("gravity", self.gravity)?;
        let substeps = self.settings.substeps.clamp(1, 1000);
        let iterations = self.settings.iterations.clamp(1, 1000);
        Ok(StepLengths { dt, h: dt / substeps as f32, substeps, iterations })
    }

    /// Drops contacts of shapes that left their fat boxes and their partners; gives those that came near one.
    fn update_pairs(&mut self, team: &Team) {
        self.stats.moved_shapes = self.broad_phase.moved().len();
        let reach = self.contact_reach();
        let Self { broad_phase, shapes, bodies, contacts, graph, joints, hooks, scratch, .. } =
            self;
        let custom = hooks.pair_filter();
        let partners = pairs::Partners { shapes, bodies, contacts, joints, custom, reach };
        scratch.search.run(team, broad_phase, &partners, graph, &mut self.waiting);

        let search = core::mem::take(&mut self.scratch.search);
        self.stats.candidate_pairs = search.pairs.len();
        self.destroy_contacts(team, &search.parted);
        self.events.flush_pending();
        let Self { settings, shapes, bodies, contacts, graph, scratch, .. } = self;
        pairs::create_contacts(
            &search.pairs,
            settings,
            shapes,
            bodies,
            contacts,
            &mut scratch.created,
        );
        scratch.transfers.insert(team, graph, bodies, contacts, scratch.created.iter().copied());
        self.scratch.search = search;
    }

    /// How far apart points may be and be a contact, metres.
    fn contact_reach(&self) -> f32 {
        SPECULATIVE_DISTANCE * self.settings.length_unit
    }

    /// Finds which faces of static shapes are covered by others, where static shapes have changed.
    fn refresh_surfaces(&mut self) {
        let Self { shapes, bodies, broad_phase, settings, .. } = self;
        surfaces::refresh(shapes, bodies, broad_phase, settings.length_unit);
    }

    /// What the narrow phase reads, and the graph that it writes.
    fn narrow_phase(&mut self) -> (narrow_phase::Context<'_>, &mut Graph) {
        let context = narrow_phase::Context {
            level: self.level,
            body_rows: &self.bodies.rows,
            poses: &self.bodies.poses,
            shape_rows: &self.shapes.rows,
            shapes: &self.shapes.records,
            infos: (self.joint_graph.count() > 0).then_some(&self.bodies.infos),
            speculative_distance: self.contact_reach(),
            surroundings: surfaces::Surroundings {
                guards: &self.shapes.guards,
                broad_phase: &self.broad_phase,
                length_unit: self.settings.length_unit,
            },
        };
        (context, &mut self.graph)
    }

    /// Computes the manifolds and constraints of all contacts in the graph.
    fn update_manifolds(&mut self, team: &Team) {
        let mut schedule = core::mem::take(&mut self.scratch.schedule);
        schedule.fill(&self.graph, 0..=IDLE, narrow_phase::CHUNK);
        let (context, graph) = self.narrow_phase();
        narrow_phase::run(team, context, graph, &schedule);
        graph.clear_fresh();
        self.scratch.schedule = schedule;
    }

    /// The same for the blocks that have got other contacts since.
    fn update_fresh_manifolds(&mut self, team: &Team) {
        let mut schedule = core::mem::take(&mut self.scratch.schedule);
        self.graph.sort_fresh();
        schedule.fill_with(self.graph.fresh(), narrow_phase::CHUNK);
        let (context, graph) = self.narrow_phase();
        narrow_phase::run(team, context, graph, &schedule);
        graph.clear_fresh();
        self.scratch.schedule = schedule;
    }

    /// Moves contacts that began or ended to where they belong; wakes what was touched. The schedule is still
    /// that of the narrow phase.
    fn update_touching(&mut self, team: &Team, lengths: StepLengths) {
        let mut changes = core::mem::take(&mut self.scratch.changes);
        let Scratch { schedule, found_changes, .. } = &mut self.scratch;
        touching::find_changes(team, &self.graph, schedule, found_changes, &mut changes);
        changes.began.retain(|&index| self.may_begin(index, lengths.dt));
        self.transfer(team, &changes);
        self.assign_paces(lengths);
        self.stats.contacts_begun = changes.began.len();
        self.stats.contacts_ended = changes.ended.len();
        self.scratch.changes = changes;
        self.update_fresh_manifolds(team);
    }

    /// Chooses which islands are solved more finely than others.
    fn assign_paces(&mut self, lengths: StepLengths) {
        let omega = core::f32::consts::TAU * self.contact_hertz(lengths.h);
        let rules = paces::Rules {
            gravity: self.gravity,
            length_unit: self.settings.length_unit,
            omega_squared: omega * omega,
            inv_h: 1.0 / lengths.h,
            most_bodies: self.settings.refine_up_to as usize,
            step: self.step_count,
        };
        let Self { bodies, contacts, graph, joints, joint_graph, scratch, .. } = self;
        let stores = Stores { bodies, contacts, graph, joints, joint_graph };
        paces::assign(stores, rules, &mut scratch.paces);
    }

    /// Solves the islands pace by pace, the plain one last.
    fn solve(&mut self, team: &Team, lengths: StepLengths) {
        self.inv_h = 1.0 / lengths.h;
        if self.bodies.awake.is_empty() {
            return;
        }
        let Self { joint_graph, joints, bodies, .. } = self;
        joint_graph.grow_forest(bodies, joints);
        joint_solver::describe(joint_graph, joints, &bodies.infos, lengths.h);
        if self.bodies.any_refined() {
            let mut listed = core::mem::take(&mut self.scratch.listed);
            for pace in (0..PACES).rev() {
                paces::list_bodies(&self.bodies, pace, &mut listed);
                self.solve_pace(team, pace, &listed, lengths.refined(pace));
            }
            self.scratch.listed = listed;
        } else {
            // All that is awake, lent for as long as that takes.
            let listed = core::mem::take(&mut self.bodies.awake);
            self.solve_pace(team, PLAIN, &listed, lengths);
            self.bodies.awake = listed;
        }
        self.collect_hits();
        self.break_joints();
    }

    /// Integrates velocities and positions, and solves contacts and joints, substep by substep.
    fn solve_pace(&mut self, team: &Team, pace: usize, listed: &[u32], lengths: StepLengths) {
        let parameters = self.contact_parameters(lengths);
        self.scratch.schedule.fill(&self.graph, places_of(pace), contact_solver::CHUNK);
        self.prepare_joints(team, pace, lengths.h);
        integrate::prepare(team, listed, &mut self.bodies, self.gravity, lengths.h);
        let max_speed = self.settings.max_speed * self.settings.length_unit;
        self.bounce(team, &parameters);
        let joints = |world: &mut Self, pass| world.solve_joints(team, pace, pass, lengths.h);
        for substep in 0..lengths.substeps {
            let first = substep == 0;
            integrate::velocities(team, listed, &mut self.bodies, first);
            joints(self, joint_solver::Pass::WarmStart);
            let warm_start = if first { Pass::WarmStart } else { Pass::WarmStartJointed };
            self.solve_contacts(team, warm_start, &parameters);
            for _ in 0..lengths.iterations {
                joints(self, joint_solver::Pass::Solve);
                self.solve_contacts(team, Pass::Solve, &parameters);
            }
            integrate::positions(team, listed, &mut self.bodies, lengths.h, max_speed);
            joints(self, joint_solver::Pass::Relax);
            self.solve_contacts(team, Pass::Relax, &parameters);
            self.note_broken_joints(pace);
        }
        joints(self, joint_solver::Pass::Finish);
    }

    /// Reflects what hits something bouncy.
    fn bounce(&mut self, team: &Team, parameters: &Parameters) {
        let Self { level, bodies, graph, scratch, .. } = self;
        let Scratch { schedule, bounces, .. } = scratch;
        contact_solver::run_bounces(team, *level, parameters, bodies, graph, schedule, bounces);
    }

    /// Stiffness of contacts for a substep length.
    fn contact_hertz(&self, h: f32) -> f32 {
        self.settings.contact_hertz.min(CONTACT_RATE_FRACTION / h)
    }

    fn contact_parameters(&self, lengths: StepLengths) -> Parameters {
        let settings = &self.settings;
        let inv_h = 1.0 / lengths.h;
        let hertz = self.contact_hertz(lengths.h);
        let damping = settings.contact_damping_ratio;
        Parameters {
            inv_h,
            soft: Softness::new(hertz, damping, lengths.h),
            static_soft: Softness::new(STATIC_STIFFNESS * hertz, damping, lengths.h),
            push_speed: settings.push_speed * settings.length_unit,
            push_rate: PUSH_RATE,
            fast_approach: FAST_APPROACH * settings.length_unit,
            gravity: self.gravity,
            h: lengths.h,
            dt: lengths.dt,
            restitution_threshold: settings.restitution_threshold * settings.length_unit,
        }
    }

    /// Runs one pass over all contacts: the overflow one by one, then colour by colour.
    fn solve_contacts(&mut self, team: &Team, pass: Pass, parameters: &Parameters) {
        if pass == Pass::WarmStartJointed && self.joint_graph.count() == 0 {
            return;
        }
        let Self { bodies, graph, scratch, level, .. } = self;
        let rows = SharedRows::new(&mut bodies.rows);
        contact_solver::run(team, *level, pass, parameters, rows, graph, &scratch.schedule);
    }

    /// Brings the joints' lanes in line with the poses.
    fn prepare_joints(&mut self, team: &Team, pace: usize, h: f32) {
        let Self { joint_graph, joints, bodies, level, .. } = self;
        let (poses, level) = (&bodies.poses, *level);
        let (colours, overflow) = joint_graph.of_pace(pace);
        for colour in colours.iter_mut().chain([overflow]) {
            colour.for_each_run(team, |blocks| joint_solver::prepare(level, poses, h, blocks));
        }
        let (lanes, trees) = joint_graph.trees_of_pace(pace);
        lanes.for_each_run(team, |blocks| joint_solver::prepare(level, poses, h, blocks));
        joint_solver::trees::prepare(team, pace, lanes, trees, joints);
    }

    /// Runs one pass over all joints: the overflow one by one, then colour by colour, then tree by tree.
    fn solve_joints(&mut self, team: &Team, pace: usize, pass: joint_solver::Pass, h: f32) {
        if self.joint_graph.count() == 0 {
            return;
        }
        let rows = SharedRows::new(&mut self.bodies.rows);
        let (level, inv_h) = (self.level, 1.0 / h);
        let (colours, overflow) = self.joint_graph.of_pace(pace);
        overflow.for_each_run(&Team::alone(), |blocks| {
            joint_solver::run_in_order(pass, inv_h, rows, blocks);
        });
        for colour in colours {
            colour.for_each_run(team, |blocks| joint_solver::run(level, pass, inv_h, rows, blocks));
        }
        let (lanes, trees) = self.joint_graph.trees_of_pace(pace);
        joint_solver::trees::run(team, pace, pass, inv_h, rows, trees);
        // Loads are read from the lanes: after the step, and in each substep where joints can break.
        let breakable = !self.joints.breakable.is_empty();
        if pass == joint_solver::Pass::Finish || breakable && pass == joint_solver::Pass::Relax {
            joint_solver::trees::finish(pace, trees, lanes);
        }
    }

    /// Takes the motion over into poses and boxes.
    fn finalize(&mut self, team: &Team, lengths: StepLengths) {
        let options = finalize::Options { dt: lengths.dt, continuous: self.settings.continuous };
        let Self { bodies, shapes, broad_phase, scratch, .. } = self;
        let count =
            finalize::run(team, bodies, shapes, broad_phase, options, &mut scratch.findings);
        let findings = &scratch.findings[..count];
        scratch.fast.clear();
        scratch.fast.extend(findings.iter().flat_map(|chunk| &chunk.fast));
        let broken: Vec<u32> = findings.iter().flat_map(|chunk| &chunk.broken).copied().collect();
        self.stats.fast_bodies = self.scratch.fast.len();
        self.stats.frozen_bodies = broken.len();
        broken.into_iter().for_each(|index| self.freeze(index));
    }

    /// Stops fast bodies where they would have gone through something.
    fn sweep_fast_bodies(&mut self, team: &Team) {
        let Self { bodies, shapes, broad_phase, joints, hooks, scratch, settings, .. } = self;
        let rules = continuous::Rules {
            joints,
            custom: hooks.pair_filter(),
            length_unit: settings.length_unit,
        };
        let Scratch { fast, moved, .. } = scratch;
        continuous::run(team, fast, bodies, shapes, broad_phase, rules, moved);
    }

    /// Looks for islands at rest now and then, and lets them sleep.
    fn put_resting_islands_to_sleep(&mut self) {
        if !self.settings.sleep || !self.step_count.is_multiple_of(sleep::INTERVAL) {
            return;
        }
        let mut islands = core::mem::take(&mut self.scratch.islands);
        sleep::find_resting(
            &self.bodies,
            &self.graph,
            &self.joints,
            self.settings.time_to_sleep,
            &mut self.scratch.sets,
            &mut islands,
        );
        self.put_to_sleep(&islands);
        self.scratch.islands = islands;
    }

    /// Steps made so far.
    pub fn step_count(&self) -> u64 {
        self.step_count
    }

    /// Threads that a step may use, the calling one included.
    pub fn threads(&self) -> usize {
        self.pool.thread_count()
    }

    /// Lets steps use this many threads, the calling one included; 0 counts as 1, and without the feature
    /// `parallel` there is never more than 1. Results do not depend on it.
    pub fn set_threads(&mut self, threads: usize) {
        if threads != self.threads() {
            self.pool = Pool::new(threads);
        }
    }

    /// The instruction set that the world runs on.
    pub fn simd(&self) -> SimdLevel {
        self.level
    }

    /// Chooses an instruction set. Results do not depend on it.
    ///
    /// # Errors
    /// This machine cannot run the level.
    pub fn set_simd(&mut self, level: SimdLevel) -> Result<(), Error> {
        if !level.is_available() {
            return Err(Error::Unsupported { reason: "this machine lacks that SIMD level" });
        }
        self.level = level;
        Ok(())
    }

    /// Times and counts of the last step.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// What happened in the last step.
    pub fn events(&self) -> &Events {
        &self.events
    }

    /// Bodies in the world.
    pub fn body_count(&self) -> usize {
        self.bodies.count()
    }

    /// Dynamic and kinematic bodies that are awake.
    pub fn awake_body_count(&self) -> usize {
        self.bodies.awake.len()
    }

    /// Shapes in the world.
    pub fn shape_count(&self) -> usize {
        self.shapes.count()
    }
}
