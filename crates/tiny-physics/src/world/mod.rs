//! The world: the one facade over everything below.

mod bodies;
mod body_changes;
mod build;
mod bytes;
mod chains;
mod check;
mod contacts;
mod descriptions;
mod events;
mod frame;
mod freeze;
mod hooks;
mod ids;
mod joint_mut;
mod joints;
mod last;
mod memory;
mod queries;
mod reading;
mod sensors;
mod shape_changes;
mod shapes;
mod state;
mod stats;
#[cfg(test)]
mod tests;
mod tiles;
mod validate;
mod waking;

pub use bodies::{Body, BodyMut, BodyPair};
pub use chains::Chain;
pub use contacts::{ContactPoint, ContactView};
pub use events::{
    ContactBegin, ContactEnd, Events, Hit, JointBreak, SensorBegin, SensorEnd, UserData,
};
pub use hooks::{ContactRules, ShapePair};
pub use ids::{BodyId, JointId, ShapeId, TileGridId};
pub use joint_mut::JointMut;
pub use joints::JointRef;
pub use memory::{Memory, MemoryUse};
pub use queries::{ClosestPoint, QueryFilter, RayCast, RayCastHit, ShapeCastHit, ShapeDistance};
pub use shape_changes::ShapeMut;
pub use shapes::ShapeRef;
pub use stats::{Stage, Stats};

use crate::describe::Settings;
use crate::dynamics::{Overlap, Schedule, Tidy, Transfers};
use crate::error::Error;
use crate::math::Vec2;
use crate::simd::SimdLevel;
use crate::stages::boxes::Moved;
use crate::stages::finalize::{FastBody, Findings};
use crate::stages::narrow_context::{Context, Ground};
use crate::stages::solve::{Lengths, Solver};
use crate::stages::touching::Changes;
use crate::stages::{
    ahead, anew, boxes, continuous, finalize, heirs, narrow_phase, paces, pairs, rocking, sleep,
    solve, sway, touched, touching,
};
use crate::threads::{Habit, Pool, Team};
use state::State;
use stats::Stopwatch;
use std::sync::OnceLock;

/// Metres; multiplied by [`Settings::length_unit`]. Points this far apart are contacts already.
const SPECULATIVE_DISTANCE: f32 = 0.02;
/// Metres; multiplied by [`Settings::length_unit`]. Room around a shape in its fat box.
const FAT_MARGIN: f32 = 0.1;
/// What sleeps is not woken by a foreseen hit that changes speeds by less, length units a second.
const FELT: f32 = 0.01;
/// Bodies awake and contacts between them from which a step is shared among threads: a thousand crates gain nothing yet, fewer
/// lose. Tests share every step, so that small worlds try the threads, too.
const LEAST_SHARED: usize = if cfg!(debug_assertions) { 1 } else { 2048 };

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
    /// Acceleration of every dynamic body, metres a second squared. Where it changes, all bodies wake.
    pub gravity: Vec2,
    /// Substeps, iterations, thresholds.
    pub settings: Settings,
    state: State,
    last: last::LastStep,
    hooks: hooks::Hooks,
    /// Which bodies the last step moved, and the kinematic ones of them, once somebody has asked.
    moved: OnceLock<[Vec<BodyId>; 2]>,
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
    tidy: Tidy,
    changes: Changes,
    found_changes: Vec<Changes>,
    findings: Vec<Findings>,
    ways: ahead::Ways,
    predictions: ahead::Predictions,
    fast: Vec<FastBody>,
    carriers: Vec<FastBody>,
    moved: Vec<Moved>,
    islands: Vec<u32>,
    sets: sleep::Sets,
    paces: paces::Memory,
    woken: Vec<u32>,
    hinges: Vec<u32>,
    schedule: Schedule,
    solver: Solver,
    /// Is the solver's work shared out?
    solving: Habit,
    sway: sway::Memory,
    overlaps: Vec<Overlap>,
    found_overlaps: Vec<Vec<Overlap>>,
    /// Bodies whose sensors are swept though they are not fast.
    turning: Vec<FastBody>,
    touching: Vec<hooks::At>,
    answers: Vec<Vec<ContactRules>>,
    switched_off: Vec<[u32; 2]>,
    loads: Vec<heirs::Load>,
}

impl World {
    /// An empty world with default settings.
    pub fn new(gravity: impl Into<Vec2>) -> Self {
        Self::with_settings(gravity, Settings::default())
    }

    /// An empty world with settings of your own.
    pub fn with_settings(gravity: impl Into<Vec2>, settings: Settings) -> Self {
        let gravity = gravity.into();
        Self {
            gravity,
            settings,
            state: State::default(),
            last: last::LastStep::default(),
            hooks: hooks::Hooks::default(),
            moved: OnceLock::new(),
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
        self.stats.dt = dt;
        let work = self.state.bodies.awake.len() + self.state.graph.touching_count();
        let pool = if work < LEAST_SHARED { Pool::default() } else { self.pool.clone() };
        pool.scope(|team| self.run_stages(team, lengths));
        self.state.step_count += 1;
        Ok(())
    }

    /// The step: one line a stage.
    fn run_stages(&mut self, team: &Team, lengths: Lengths) {
        let mut watch = Stopwatch::start(&self.stats);
        self.state.events.clear();
        self.begin_last(lengths.substeps);
        self.forget_loaded_rules();
        self.state.bodies.sort_awake();
        self.wake_disturbed();
        let lengths = self.follow_lengths(lengths);
        self.refresh_surfaces();
        if self.rests(lengths) {
            return;
        }

        self.reach_ahead(team, lengths);
        self.update_pairs(team);
        watch.lap(&mut self.stats, Stage::Pairs);
        self.update_manifolds(team, lengths);
        self.predict(team, lengths);
        watch.lap(&mut self.stats, Stage::NarrowPhase);
        self.update_touching(team, lengths);
        self.stay_at_rest(lengths);
        self.call_pre_solve(team);
        watch.lap(&mut self.stats, Stage::Touching);
        self.solve(team, lengths);
        self.settle_predictions(team);
        self.calm_sway(lengths);
        watch.lap(&mut self.stats, Stage::Solve);
        self.finalize(team, lengths);
        watch.lap(&mut self.stats, Stage::Finalize);
        self.sweep_fast_bodies(team, lengths);
        watch.lap(&mut self.stats, Stage::Continuous);
        self.update_sensors(team);
        self.put_resting_islands_to_sleep();
        self.state.events.flush_pending();
        // A hook may have asked in the middle of the step.
        self.moved.take();
        watch.lap(&mut self.stats, Stage::Sleep);
    }

    /// Checks the step's numbers and divides them up.
    fn step_lengths(&self, dt: f32) -> Result<Lengths, Error> {
        Error::check_positive("dt", dt)?;
        self.settings.validate()?;
        Error::check_finite_vec("gravity", self.gravity)?;
        let lengths = Lengths::new(dt, &self.settings);
        Error::check("dt", dt, (1.0 / lengths.h).is_finite(), "long enough to be divided")?;
        Ok(lengths)
    }

    /// Lets the boxes of fast bodies reach as far as they will go.
    fn reach_ahead(&mut self, team: &Team, lengths: Lengths) {
        if !self.settings.continuous {
            return self.scratch.ways.of_shapes.clear();
        }
        let limits = (lengths.dt, self.contact_reach());
        let State { bodies, shapes, broad_phase, .. } = &mut self.state;
        ahead::reach(team, bodies, shapes, broad_phase, limits, &mut self.scratch.ways);
    }

    /// Drops contacts of shapes that left their fat boxes and their partners; gives those that came near one.
    fn update_pairs(&mut self, team: &Team) {
        self.stats.moved_shapes = self.state.broad_phase.moved().len();
        let reach = self.contact_reach();
        let State { broad_phase, shapes, bodies, contacts, graph, joints, waiting, .. } =
            &mut self.state;
        let custom = self.hooks.pair_filter();
        let ways = &self.scratch.ways.of_shapes;
        let partners = pairs::Partners { shapes, bodies, contacts, joints, custom, reach, ways };
        self.scratch.search.run(team, broad_phase, &partners, graph, waiting);

        self.stats.candidate_pairs = self.scratch.search.pairs.len();
        let parted = core::mem::take(&mut self.scratch.search.parted);
        self.destroy_contacts(team, &parted);
        self.state.events.flush_pending();
        let State { shapes, bodies, contacts, graph, .. } = &mut self.state;
        let Scratch { search, created, transfers, .. } = &mut self.scratch;
        search.parted = parted;
        pairs::create_contacts(&search.pairs, &self.settings, shapes, bodies, contacts, created);
        transfers.insert(team, graph, bodies, contacts, created.iter().copied());
    }

    /// How far apart points may be and be a contact, metres.
    pub(super) fn contact_reach(&self) -> f32 {
        SPECULATIVE_DISTANCE * self.settings.length_unit
    }

    /// Finds which faces of static shapes are covered by others, where static shapes have changed.
    fn refresh_surfaces(&mut self) {
        let State { shapes, bodies, broad_phase, .. } = &mut self.state;
        touched::refresh(shapes, bodies, broad_phase, self.settings.length_unit);
    }

    /// Computes the manifolds and constraints of all contacts in the graph.
    fn update_manifolds(&mut self, team: &Team, lengths: Lengths) {
        self.scratch.predictions.clear();
        let State { bodies, contacts, graph, step_count, .. } = &mut self.state;
        self.scratch.tidy.run(*step_count, graph, bodies, contacts);
        self.scratch.schedule.fill(&self.state.graph, narrow_phase::CHUNK);
        self.run_narrow_phase(team, lengths, true);
        self.state.graph.take_closing(&mut self.scratch.predictions.candidates);
    }

    /// The same for the blocks that have got other contacts since, or predicted ones.
    fn update_fresh_manifolds(&mut self, team: &Team, lengths: Lengths) {
        self.state.graph.sort_fresh();
        let graph = &self.state.graph;
        self.scratch.schedule.fill_with(graph, graph.fresh(), narrow_phase::CHUNK);
        self.run_narrow_phase(team, lengths, false);
    }

    fn run_narrow_phase(&mut self, team: &Team, lengths: Lengths, naming: bool) {
        let anything_fast = !self.scratch.ways.of_shapes.is_empty();
        let step = (lengths.dt, anything_fast, naming);
        let (level, reach) = (self.level, self.contact_reach());
        let (custom, length_unit) = (self.hooks.pair_filter(), self.settings.length_unit);
        let State { bodies, shapes, broad_phase, joints, graph, .. } = &mut self.state;
        let ground = Ground { bodies, shapes, broad_phase, joints, custom, length_unit };
        let context = Context::new(ground, (level, reach), step);
        let Scratch { schedule, predictions, .. } = &self.scratch;
        narrow_phase::run(team, context, graph, schedule, predictions);
        graph.clear_fresh();
    }

    /// Predicts contacts that will be made in the step.
    fn predict(&mut self, team: &Team, lengths: Lengths) {
        let mut changed = self.foresee(lengths);
        if changed {
            self.look_again(team, lengths);
            let candidates = &mut self.scratch.predictions.candidates;
            candidates.sort_unstable();
            candidates.dedup();
        }
        while self.predict_round(team, lengths) {
            changed |= self.wake_struck(team, lengths) | self.look_again(team, lengths);
        }
        if changed {
            self.scratch.schedule.fill(&self.state.graph, narrow_phase::CHUNK);
        }
        let Self { state: State { bodies, contacts, graph, .. }, scratch, .. } = self;
        for &index in &scratch.predictions.missed {
            let contact = &contacts.records[index as usize];
            if graph.touches(contact) {
                graph.mark_touching(contact, false);
            }
        }
        scratch.predictions.leave_asleep(bodies, contacts, FELT * self.settings.length_unit);
        let ahead::Predictions { contacts: predicted, fresh, .. } = &mut scratch.predictions;
        for &index in &*predicted {
            let contact = &contacts.records[index as usize];
            graph.mark_touching(contact, true);
            if !contact.touching {
                fresh.push(index);
            }
        }
        self.stats.predicted_contacts = predicted.len();
        self.stats.squeezed_bodies = 0;
    }

    /// Looks for the impacts of candidates. Do they take bodies so far off their ways that there is to be another round?
    fn predict_round(&mut self, team: &Team, lengths: Lengths) -> bool {
        let (level, reach) = (self.level, self.contact_reach());
        let (custom, length_unit) = (self.hooks.pair_filter(), self.settings.length_unit);
        let step = (lengths.dt, false, false);
        let State { bodies, shapes, contacts, broad_phase, joints, graph, .. } = &mut self.state;
        let ground = Ground { bodies, shapes, broad_phase, joints, custom, length_unit };
        let narrow_phase = Context::new(ground, (level, reach), step);
        let (dt, substeps) = (lengths.dt, lengths.substeps as f32);
        let scene = ahead::Scene { bodies, shapes, contacts, graph, narrow_phase, dt, substeps };
        self.scratch.predictions.round(team, scene)
    }

    /// Wakes what is struck, with all that it may hit in turn. Was anything asleep?
    fn wake_struck(&mut self, team: &Team, lengths: Lengths) -> bool {
        let awake = self.state.bodies.awake.len();
        for place in 0..self.scratch.predictions.struck.len() {
            self.wake_index(self.scratch.predictions.struck[place].body);
        }
        let woken = self.state.bodies.awake.len() > awake;
        if woken {
            self.update_fresh_manifolds(team, lengths);
        }
        woken
    }

    /// Looks for what they may meet on their new ways. Are there contacts that were not there before?
    fn look_again(&mut self, team: &Team, lengths: Lengths) -> bool {
        let reach = self.contact_reach();
        let State { bodies, shapes, contacts, joints, broad_phase, graph, waiting, .. } =
            &mut self.state;
        let Scratch { predictions, search, ways, .. } = &mut self.scratch;
        predictions.reach((bodies, lengths.dt), shapes, broad_phase, ways);
        let (custom, ways) = (self.hooks.pair_filter(), &ways.of_shapes);
        let partners = pairs::Partners { shapes, bodies, contacts, joints, custom, reach, ways };
        let waiting = &waiting.pairs;
        let around = ahead::Around { broad_phase, graph, waiting, partners, dt: lengths.dt };
        predictions.look_again(team, around, &mut search.pairs);
        self.add_candidates(team)
    }

    /// Predicted contacts that pushed have begun; those that did not have never been.
    fn settle_predictions(&mut self, team: &Team) {
        let State { bodies, contacts, graph, .. } = &mut self.state;
        let (squeezed, length_unit) =
            (&mut self.scratch.predictions.squeezed, self.settings.length_unit);
        squeezed.release(bodies, contacts, graph, length_unit);
        let predicted = core::mem::take(&mut self.scratch.predictions.fresh);
        let mut changes = core::mem::take(&mut self.scratch.changes);
        changes.clear();
        for &index in &predicted {
            let contact = &mut self.state.contacts.records[index as usize];
            if self.state.graph.has_pushed(contact) {
                self.report_begin(index);
            } else if contact.touching {
                contact.events = false;
                changes.ended.push(index);
            }
        }
        changes.ended.sort_unstable();
        self.transfer(team, &changes);
        self.scratch.changes = changes;
        self.scratch.predictions.fresh = predicted;
        // What sleeps on goes nowhere.
        let State { bodies, shapes, broad_phase, .. } = &mut self.state;
        for body in self.scratch.predictions.bodies() {
            if !bodies.infos[body as usize].awake {
                boxes::update(bodies, shapes, broad_phase, body);
            }
        }
    }

    /// Creates contacts for the pairs of the search, after the narrow phase. Are there any?
    fn add_candidates(&mut self, team: &Team) -> bool {
        let State { bodies, shapes, contacts, graph, .. } = &mut self.state;
        let Scratch { predictions, search, created, transfers, .. } = &mut self.scratch;
        if search.pairs.is_empty() {
            return false;
        }
        pairs::create_contacts(&search.pairs, &self.settings, shapes, bodies, contacts, created);
        transfers.insert(team, graph, bodies, contacts, created.iter().copied());
        for &contact in &*created {
            graph.mark_touching(&contacts.records[contact as usize], false);
        }
        predictions.candidates.extend_from_slice(created);
        true
    }

    /// Moves contacts that began or ended to where they belong; wakes what was touched. The schedule is still
    /// that of the narrow phase.
    fn update_touching(&mut self, team: &Team, lengths: Lengths) {
        let mut changes = core::mem::take(&mut self.scratch.changes);
        let Scratch { schedule, found_changes, .. } = &mut self.scratch;
        touching::find_changes(team, &self.state.graph, schedule, found_changes, &mut changes);
        let predictions = &self.scratch.predictions;
        let is_foreseen = |index| predictions.of(index).is_some();
        changes.began.retain(|&index| is_foreseen(index) || self.may_begin(index));
        let scope = anew::Scope { shapes: &self.state.shapes, reach: self.contact_reach() };
        let State { bodies, contacts, graph, .. } = &self.state;
        let (stores, step) = ((bodies, contacts, graph), (scope, lengths.dt));
        heirs::list(&changes.ended, stores, step, &mut self.scratch.loads);
        self.transfer(team, &changes);
        self.assign_paces(lengths);
        self.stats.contacts_begun = changes.began.len();
        self.stats.contacts_ended = changes.ended.len();
        self.scratch.changes = changes;
        for &contact in &self.scratch.predictions.fresh {
            self.state.graph.watch(&self.state.contacts.records[contact as usize]);
        }
        self.update_fresh_manifolds(team, lengths);
        let State { bodies, contacts, graph, .. } = &mut self.state;
        heirs::hand_on(&self.scratch.loads, (bodies, contacts), graph);
        self.scratch.predictions.hold_back(contacts, graph);
        let predictions = &self.scratch.predictions;
        let bodies = &self.state.bodies;
        let kept = !(bodies.pressed.is_empty() && bodies.laden.is_empty());
        if kept || !predictions.squeezed.pressed.is_empty() {
            let State { bodies, contacts, graph, .. } = &mut self.state;
            let predictions = &mut self.scratch.predictions;
            let scale = (self.settings.length_unit, -self.gravity.normalized());
            self.stats.squeezed_bodies = predictions.weigh_squeezed(bodies, contacts, graph, scale);
        }
    }

    /// What the solver is told.
    pub(super) fn solver_rules(&self, lengths: Lengths) -> solve::Rules {
        let Self { settings, gravity, level, .. } = *self;
        solve::Rules { settings, gravity, level, lengths }
    }

    /// Chooses which islands are solved more finely than others.
    fn assign_paces(&mut self, lengths: Lengths) {
        let rules = self.solver_rules(lengths).of_paces(self.state.step_count);
        paces::assign(self.state.solved(), rules, &mut self.scratch.paces);
    }

    /// Solves all that is awake; hits and joints that broke become events.
    fn solve(&mut self, team: &Team, lengths: Lengths) {
        let rules = self.solver_rules(lengths);
        let reach = self.contact_reach();
        let Scratch { solver, solving, predictions, .. } = &mut self.scratch;
        predictions.squeezed.lighten(&mut self.state.bodies);
        let (shapes, mut stores) = self.state.shapes_and_solved();
        let amount = stores.graph.touching_count();
        solving.run(team, amount, |team| {
            solver.run(team, &mut stores, rules, predictions, anew::Scope { shapes, reach });
        });
        self.stats.withheld_energy = self.scratch.solver.passivity.withheld;
        self.collect_hits();
        self.break_joints();
    }

    /// Now and then takes away what swings on something firm.
    fn calm_sway(&mut self, lengths: Lengths) {
        let State { bodies, contacts, graph, joints, step_count, .. } = &mut self.state;
        let scale = (lengths.dt, self.settings.length_unit);
        if sway::is_due(*step_count) {
            sway::calm(bodies, graph, scale, &mut self.scratch.sway);
        }
        if rocking::is_due(*step_count) {
            rocking::resist(bodies, (contacts, joints), graph, scale);
        }
    }

    /// Takes the motion over into poses and boxes.
    fn finalize(&mut self, team: &Team, lengths: Lengths) {
        let Settings { continuous, length_unit, .. } = self.settings;
        let options = finalize::Options::new(lengths, continuous, length_unit);
        let State { bodies, shapes, broad_phase, .. } = &mut self.state;
        let scratch = &mut self.scratch;
        let count =
            finalize::run(team, bodies, shapes, broad_phase, options, &mut scratch.findings);
        let findings = &scratch.findings[..count];
        scratch.fast.clear();
        scratch.fast.extend(findings.iter().flat_map(|chunk| &chunk.fast));
        scratch.carriers.clear();
        scratch.carriers.extend(findings.iter().flat_map(|chunk| &chunk.carriers));
        self.stats.fast_bodies = scratch.fast.len();
        self.stats.frozen_bodies = findings.iter().map(|chunk| chunk.broken.len()).sum();
        if self.stats.frozen_bodies > 0 {
            let broken = findings.iter().flat_map(|chunk| &chunk.broken).copied();
            let broken = broken.collect::<Vec<u32>>();
            self.state.bodies.stop_ground_that_is_not_finite();
            broken.into_iter().for_each(|index| self.freeze(index));
        }
    }

    /// Stops fast bodies where they would have gone through something.
    fn sweep_fast_bodies(&mut self, team: &Team, lengths: Lengths) {
        let State { bodies, shapes, broad_phase, joints, .. } = &mut self.state;
        let Scratch { fast, carriers, moved, switched_off, .. } = &mut self.scratch;
        let rules = continuous::Rules {
            joints,
            custom: self.hooks.pair_filter(),
            off: switched_off,
            length_unit: self.settings.length_unit,
            dt: lengths.dt,
        };
        continuous::run(team, (fast, carriers), bodies, shapes, broad_phase, rules, moved);
    }

    /// Looks for islands at rest now and then, and lets them sleep.
    fn put_resting_islands_to_sleep(&mut self) {
        if !self.settings.sleep || !self.is_sleep_due() {
            return;
        }
        let mut islands = core::mem::take(&mut self.scratch.islands);
        sleep::find_resting(
            &self.state.bodies,
            &self.state.graph,
            &self.state.joints,
            self.settings.time_to_sleep.max(f32::MIN_POSITIVE),
            (1.0 / self.state.inv_h, self.settings.length_unit),
            &mut self.scratch.sets,
            &mut islands,
        );
        self.put_to_sleep(&islands);
        self.scratch.islands = islands;
    }

    /// Every eighth step, and as soon as all that is awake has rested long enough.
    fn is_sleep_due(&self) -> bool {
        let State { bodies, step_count, .. } = &self.state;
        let least = self.settings.time_to_sleep.max(f32::MIN_POSITIVE);
        let mut rested = bodies.awake.iter().map(|&body| bodies.infos[body as usize].sleep_time);
        let mut just_now = false;
        step_count.is_multiple_of(sleep::INTERVAL)
            || rested.all(|time| {
                just_now |= time < least + self.stats.dt;
                time >= least
            }) && just_now
    }

    /// Steps made so far.
    pub fn step_count(&self) -> u64 {
        self.state.step_count
    }

    /// Threads that a step may use, the calling one included.
    pub fn threads(&self) -> usize {
        self.pool.thread_count()
    }

    /// Lets steps use this many threads, the calling one included; 0 counts as 1, and without the feature
    /// `parallel` there is never more than 1. Results do not depend on it. A step of less than a third of a
    /// millisecond or so runs on its caller alone, as others would not be awake in time, and so does the solver where the clock
    /// says that this takes less time.
    pub fn set_threads(&mut self, threads: usize) {
        if threads != self.threads() {
            self.pool = Pool::new(threads);
            self.scratch.solving = Habit::default();
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

    /// Says whether steps time their stages. They do not at first: reading a clock costs more than a small world's
    /// stage.
    pub fn time_stages(&mut self, on: bool) {
        self.stats = Stats { timed: on, seconds: Default::default(), ..self.stats };
    }

    /// Counts of the last step, and times where [`World::time_stages`] asks for them.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// Counts a call that changes nothing because a number was refused in it.
    pub(crate) fn refuse(&mut self) {
        self.stats.refused_numbers += 1;
    }

    /// What happened in the last step.
    pub fn events(&self) -> &Events {
        &self.state.events
    }

    /// Bodies in the world.
    pub fn body_count(&self) -> usize {
        self.state.bodies.count()
    }

    /// Dynamic and kinematic bodies that are awake.
    pub fn awake_body_count(&self) -> usize {
        self.state.bodies.awake.len()
    }

    /// Shapes in the world.
    pub fn shape_count(&self) -> usize {
        self.state.shapes.count()
    }
}
