//! The substeps: forces become velocities, contacts and joints correct them, velocities become motion.
//!
//! Pace by pace, the plain one last, [`Solver::run`] goes through the substeps of all that is awake: integrate
//! velocities, warm start, solve with bias, integrate positions, relax without bias.

use super::ahead::Predictions;
use super::anew::Scope;
use super::arcs::Arcs;
use super::contact_solver::{self, Bounces, Parameters, Pass, Softness};
use super::free::FreeIslands;
use super::islands::Stores;
use super::joint_solver::Substep;
use super::rests::Compliance;
use super::{integrate, joint_solver, paces, passivity, tree_contacts};
use crate::describe::Settings;
use crate::dynamics::{
    Chosen, JointBlocks, JointPlaces, PACES, PLAIN, REFINEMENT, ROUNDS, Schedule,
};
use crate::footprint::footprint;
use crate::math::Vec2;
use crate::simd::SimdLevel;
use crate::threads::{SharedRows, Team};

/// Contacts against static bodies are this much stiffer.
const STATIC_STIFFNESS: f32 = 2.0;
/// Contact stiffness is at most this fraction of the substep rate. Sinking goes with the inverse square:
/// 0.125, as elsewhere, lets a tower of 20 crates sink by 0.135 m, 0.22 by 0.044 m. From 0.25 on a pyramid
/// of 40 rows no longer comes to rest.
const CONTACT_RATE_FRACTION: f32 = 0.22;
/// Contacts are as soft as the coarsest step of late lets them be, and forget it at this rate, 1 / second: where softness went with
/// each step, stacks would sink in coarse ones and be pushed out in fine ones.
const FORGETS: f32 = 0.5;
/// No substep counts as coarser than this for those that follow, seconds: one wild step would leave contacts soft for minutes.
const MOST_COARSE: f32 = 0.1;
/// Metres a second; multiplied by [`Settings::length_unit`]. Overlaps that close in faster are solved without
/// softness, which would let a part of the speed pass.
const FAST_APPROACH: f32 = 10.0;
/// What is deeper in than its load accounts for is pushed out at this rate, 1 / second.
const PUSH_RATE: f32 = 20.0;
/// Times more that the contacts of squeezed bodies are solved in a pass, rigidly: softness goes by the lighter mass of a
/// pair, and what is heavier would sink in. Of 30 pairs of light boxes in a row under a heavy one 22 went deeper than half
/// their height with soft ones, 7 with rigid ones, 4 with 16 of them; but 16 hurt joints in random worlds.
const SQUEEZED_ROUNDS: usize = 4;

/// Times more that the contacts of hard hits are solved in a pass, in which a push would get through few bodies of a crowd.
/// Of 200 crowds that meet at 10 to 60 m/s 72 had overlaps of a fifth of a body with none, 7 with three.
const HIT_ROUNDS: usize = 3;

/// How a step is divided.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lengths {
    /// Of the step, seconds.
    pub(crate) dt: f32,
    /// Of a substep, seconds.
    pub(crate) h: f32,
    pub(crate) substeps: u32,
    pub(crate) iterations: u32,
    /// Iterations without bias.
    pub(crate) relaxations: u32,
    /// Substeps are longer or shorter than in the step before.
    pub(crate) leaps: bool,
    /// Contacts are as soft as substeps this many times as long make them, at least 1.
    pub(crate) softer: f32,
}

impl Lengths {
    /// `dt` as the settings divide it, at the plain pace.
    pub(crate) fn new(dt: f32, settings: &Settings) -> Self {
        let substeps = settings.substeps.clamp(1, 1000);
        let iterations = settings.iterations.clamp(1, 1000);
        let h = dt / substeps as f32;
        Self { dt, h, substeps, iterations, relaxations: 1, leaps: false, softer: 1.0 }
    }

    /// The same, after steps that left a coarse substep behind; gives what is to be left to the next one.
    pub(crate) fn after(self, coarse: f32) -> (Self, f32) {
        let coarse = coarse.min(MOST_COARSE.max(self.h));
        let kept = self.h + (coarse - self.h) / (1.0 + FORGETS * self.dt);
        let coarse = if kept > 1.001 * self.h { kept } else { self.h };
        (Self { softer: coarse / self.h, ..self }, coarse)
    }

    /// The same at a pace.
    fn refined(self, pace: usize) -> Self {
        let refinement = REFINEMENT[pace];
        Self {
            h: self.h / refinement as f32,
            substeps: self.substeps * refinement,
            iterations: self.iterations * ROUNDS[pace],
            relaxations: ROUNDS[pace],
            ..self
        }
    }
}

/// What the solver is told.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rules {
    pub(crate) settings: Settings,
    pub(crate) gravity: Vec2,
    pub(crate) level: SimdLevel,
    pub(crate) lengths: Lengths,
}

impl Rules {
    /// How paces are chosen in this step, the `step`th.
    pub(crate) fn of_paces(&self, step: u64) -> paces::Rules {
        paces::Rules {
            gravity: self.gravity,
            length_unit: self.settings.length_unit,
            compliance: self.compliance(),
            h: self.lengths.h,
            most_bodies: self.settings.refine_up_to as usize,
            step,
        }
    }

    /// How far contacts sink.
    pub(crate) fn compliance(&self) -> Compliance {
        let omega = core::f32::consts::TAU * self.contact_hertz();
        let moving = 1.0 / (self.lengths.h * omega * omega);
        Compliance { moving, fixed: moving / (STATIC_STIFFNESS * STATIC_STIFFNESS) }
    }

    /// Stiffness of contacts.
    fn contact_hertz(&self) -> f32 {
        let Lengths { h, softer, .. } = self.lengths;
        self.settings.contact_hertz.min(CONTACT_RATE_FRACTION / (h * softer))
    }

    fn contact_parameters(&self) -> Parameters {
        let Self { settings, lengths: Lengths { dt, h, .. }, .. } = *self;
        let hertz = self.contact_hertz();
        let damping = settings.contact_damping_ratio;
        Parameters {
            inv_h: 1.0 / h,
            dt,
            soft: Softness::new(hertz, damping, h),
            static_soft: Softness::new(STATIC_STIFFNESS * hertz, damping, h),
            push_speed: settings.push_speed * settings.length_unit,
            push_rate: PUSH_RATE,
            fast_approach: FAST_APPROACH * settings.length_unit,
            restitution_threshold: settings.restitution_threshold * settings.length_unit,
        }
    }
}

/// Memory of the solver: lists that a step fills anew.
#[derive(Debug, Default)]
pub(crate) struct Solver {
    schedule: Schedule,
    /// Contacts of squeezed bodies, of hard hits, and of bodies with joints.
    squeezed: Chosen,
    hit: Chosen,
    jointed: Chosen,
    torn: Vec<joint_solver::torn::Found>,
    arcs: Arcs,
    tree_contacts: tree_contacts::TreeContacts,
    bounces: Bounces,
    pub(crate) passivity: passivity::Memory,
    free: FreeIslands,
    listed: Vec<u32>,
    pub(crate) broken: joint_solver::Broken,
}

footprint!(Solver {
    schedule,
    squeezed,
    hit,
    jointed,
    torn,
    arcs,
    tree_contacts,
    bounces,
    passivity,
    free,
    listed,
    broken
});

impl Solver {
    /// Solves the islands pace by pace, the plain one last. Predictions say what is hit hard, and what is squeezed.
    pub(crate) fn run(
        &mut self,
        team: &Team,
        stores: &mut Stores<'_>,
        rules: Rules,
        predictions: &Predictions,
        scope: Scope<'_>,
    ) {
        self.broken.found.clear();
        self.passivity.withheld = 0.0;
        if stores.bodies.awake.is_empty() {
            return;
        }
        let squeezed = predictions.squeezed.hit.iter().flat_map(|&body| {
            let first = stores.bodies.infos[body as usize].first_contact;
            stores.contacts.of_body(first).map(|(contact, _)| contact)
        });
        self.squeezed.list(stores.graph, stores.contacts, squeezed);
        self.hit.list(stores.graph, stores.contacts, predictions.hard.iter().copied());
        self.bounces.waiting.clone_from(&predictions.waiting);
        self.jointed.list_blocks(stores.graph, |head| head.jointed_a | head.jointed_b != 0);
        self.free.begin(stores, rules.gravity);
        let dt = rules.lengths.dt;
        let most = rules.settings.push_speed * rules.settings.length_unit * dt;
        self.arcs.list(team, stores, scope.shapes, predictions, (dt, most));
        stores.joint_graph.grow_forest(stores.bodies, stores.joints);
        let h = rules.lengths.h;
        joint_solver::describe(stores.joint_graph, stores.joints, &stores.bodies.infos, h);
        let present = stores.bodies.paces();
        if present & !(1 << PLAIN) != 0 {
            let mut listed = core::mem::take(&mut self.listed);
            for pace in (0..PACES).rev().filter(|&pace| pace == PLAIN || present >> pace & 1 != 0) {
                paces::list_bodies(stores.bodies, pace, &mut listed);
                if listed.is_empty() {
                    continue;
                }
                let lengths = rules.lengths.refined(pace);
                self.solve_pace(team, stores, Rules { lengths, ..rules }, pace, &listed, scope);
            }
            self.listed = listed;
        } else {
            // All that is awake, lent for as long as that takes.
            let listed = core::mem::take(&mut stores.bodies.awake);
            self.solve_pace(team, stores, rules, PLAIN, &listed, scope);
            stores.bodies.awake = listed;
        }
        self.free.end(stores.bodies);
        self.broken.found.sort_unstable_by_key(|&(index, _)| index);
    }

    /// The substeps of a pace, of these bodies.
    fn solve_pace(
        &mut self,
        team: &Team,
        stores: &mut Stores<'_>,
        rules: Rules,
        pace: usize,
        listed: &[u32],
        scope: Scope<'_>,
    ) {
        let Self { schedule, squeezed, hit, tree_contacts, bounces, passivity, broken, .. } = self;
        let (jointed, torn) = (&mut self.jointed, &mut self.torn);
        let Rules { settings, gravity, level, lengths: lengths @ Lengths { h, .. } } = rules;
        let joint_substep = Substep::new(h, settings.length_unit, lengths.leaps);
        let parameters = rules.contact_parameters();
        let rounds = |chosen: &mut Chosen, rounds| {
            if chosen.take(stores.graph, pace, 8 * contact_solver::CHUNK) { rounds } else { 0 }
        };
        let squeezed_rounds = rounds(squeezed, SQUEEZED_ROUNDS);
        let hit_rounds = rounds(hit, HIT_ROUNDS);
        let any_jointed = rounds(jointed, 1) > 0;
        integrate::prepare(team, listed, stores.bodies, gravity, h);
        let places = stores.joint_graph.places_of(pace);
        prepare_joints(team, stores, level, pace, &places, joint_substep);
        joint_solver::torn::find(stores, pace, &places, joint_substep, torn);
        passivity.find(pace, listed, stores);
        bounces.begin(stores.graph, pace, &parameters);
        let max_speed = settings.max_speed * settings.length_unit;
        broken.list(stores.joint_graph, stores.joints, pace);

        let joints = |stores: &mut Stores<'_>, pass| {
            run_joints(team, stores, level, pace, &places, pass, joint_substep)
        };
        tree_contacts.take(pace, stores, &self.arcs);
        schedule.fill_pace(stores.graph, pace, contact_solver::CHUNK);
        let in_lanes = |stores: &mut Stores<'_>, pass, schedule: &Schedule| {
            let rows = SharedRows::new(&mut stores.bodies.rows);
            contact_solver::run(team, level, pass, &parameters, rows, stores.graph, schedule);
        };
        let again = |stores: &mut Stores<'_>, pass, chosen: &Chosen, rounds| {
            (0..rounds).for_each(|_| in_lanes(stores, pass, &chosen.schedule));
        };
        let mut contacts = |stores: &mut Stores<'_>, pass| {
            let trees = &mut stores.joint_graph.forest.trees;
            tree_contacts.run(level, pass, &parameters, &mut stores.bodies.rows, trees);
            let of_joints = pass == Pass::WarmStartJointed;
            in_lanes(stores, pass, if of_joints { &jointed.schedule } else { schedule });
        };
        for substep in 0..lengths.substeps {
            let first = substep == 0;
            self.arcs.renew((stores.bodies, stores.graph), scope, (pace, h), first);
            bounces.run((team, level), &parameters, stores, (pace, scope));
            integrate::velocities(team, level, listed, stores.bodies, first);
            joints(stores, joint_solver::Pass::WarmStart);
            if first {
                contacts(stores, Pass::WarmStart);
            } else if any_jointed {
                contacts(stores, Pass::WarmStartJointed);
            }
            let relaxed = |stores: &mut Stores<'_>| joints(stores, joint_solver::Pass::Relax);
            bounces.hand_on((team, level), &parameters, stores, listed, relaxed);
            for _ in 0..lengths.iterations {
                joints(stores, joint_solver::Pass::Solve);
                contacts(stores, Pass::Solve);
                again(stores, Pass::Solve, hit, hit_rounds);
                again(stores, Pass::Relax, squeezed, squeezed_rounds);
            }
            integrate::positions(team, level, listed, stores.bodies, h, max_speed);
            for round in 1..=lengths.relaxations {
                let last = round == lengths.relaxations;
                joints(stores, joint_solver::Pass::Relax);
                again(stores, Pass::Relax, squeezed, squeezed_rounds);
                contacts(stores, if last { Pass::RelaxLast } else { Pass::Relax });
            }
            passivity.run(stores.bodies);
            broken.note(stores.joint_graph, 1.0 / h, substep + 1 == lengths.substeps);
        }
        joints(stores, joint_solver::Pass::Finish);
        tree_contacts.give_back(stores);
        bounces.end(stores.graph);
        integrate::bound(team, listed, stores.bodies, h, max_speed);
    }
}

/// Brings the joints' lanes in line with the poses.
fn prepare_joints(
    team: &Team,
    stores: &mut Stores<'_>,
    level: SimdLevel,
    pace: usize,
    places: &JointPlaces,
    substep: Substep,
) {
    let Stores { joint_graph, joints, bodies, .. } = stores;
    let poses = &bodies.poses;
    let prepare = |blocks: JointBlocks<'_>, count| {
        joint_solver::prepare(level, poses, substep, blocks, count);
    };
    let (overflow, colours) = joint_graph.in_lanes(places);
    overflow.iter_mut().chain(colours).for_each(|lanes| lanes.for_each_run(team, prepare));
    if let Some((lanes, trees)) = joint_graph.in_trees(places) {
        lanes.for_each_run(team, prepare);
        joint_solver::trees::prepare(team, pace, trees, joints, &bodies.motions);
    }
}

/// Runs one pass over all joints: the overflow one by one, then colour by colour, then tree by tree.
fn run_joints(
    team: &Team,
    stores: &mut Stores<'_>,
    level: SimdLevel,
    pace: usize,
    places: &JointPlaces,
    pass: joint_solver::Pass,
    substep: Substep,
) {
    let Stores { joint_graph, joints, bodies, .. } = stores;
    if places.is_empty() {
        return;
    }
    let rows = SharedRows::new(&mut bodies.rows);
    let (overflow, colours) = joint_graph.in_lanes(places);
    for lanes in overflow {
        lanes.for_each_run(&Team::alone(), |blocks, _| {
            joint_solver::run_one_by_one(level, pass, substep, rows, blocks);
        });
    }
    for lanes in colours {
        lanes.for_each_run(team, |blocks, count| {
            joint_solver::run(level, pass, substep, rows, blocks, count);
        });
    }
    let Some((lanes, trees)) = joint_graph.in_trees(places) else { return };
    joint_solver::trees::run(team, level, pace, pass, substep, rows, (lanes, trees));
    // Loads are read from the lanes: after the step, and in each substep where joints can break.
    let breakable = !joints.breakable.is_empty();
    if pass == joint_solver::Pass::Finish || breakable && pass == joint_solver::Pass::Relax {
        joint_solver::trees::finish(pace, trees, lanes);
    }
}
