//! Islands that nothing acts on from outside keep their angular momentum.
//!
//! A contact keeps its arms for a step, and its bodies go on by some `e` against each other: what pushes and rubs with the impulse
//! `P` turns them by `P x e` more than it should. What an island has got by that in a step it gives back, all of it turning as one
//! piece about its centre: so no two of its points part or come together by it.

use super::islands::{Islands, Stores, touching};
use crate::describe::{JointDef, JointKind};
use crate::dynamics::{Bodies, BodyInfo, JointRecord, Joints, Slot};
use crate::math::Vec2;

/// No island gets more back than goes with this part of its energy: speeds that were cut are no matter of arms. What it has got it gives.
const MOST: f64 = 0.01;

/// What is known of an island, at the index of its root; places as seen from where the root was when the step began.
#[derive(Clone, Copy, Debug, Default)]
struct Whole {
    bodies: u32,
    /// Does something act on it from outside?
    held: bool,
    mass: f64,
    /// Sums of masses times velocities and places.
    momentum: [f64; 2],
    moment: [f64; 2],
    /// Angular momentum, moment of inertia, twice the energy.
    turning: f64,
    inertia: f64,
    energy: f64,
    /// Angular momentum when the step began.
    before: f64,
}

impl Whole {
    /// Adds a body at a place.
    fn add(&mut self, bodies: &Bodies, body: u32, [px, py]: [f64; 2]) {
        let row = bodies.rows[body as usize].map(f64::from);
        let (mass, inertia) = (1.0 / row[Slot::INV_MASS], 1.0 / row[Slot::INV_INERTIA]);
        let [x, y, turn] = [row[Slot::VX], row[Slot::VY], row[Slot::W]];
        self.bodies += 1;
        self.mass += mass;
        self.momentum = [self.momentum[0] + mass * x, self.momentum[1] + mass * y];
        self.moment = [self.moment[0] + mass * px, self.moment[1] + mass * py];
        self.turning += mass * (px * y - py * x) + inertia * turn;
        self.inertia += mass * (px * px + py * py) + inertia;
        self.energy += mass * (x * x + y * y) + inertia * turn * turn;
    }

    /// How much faster all of it is to turn, and about what.
    fn correction(&self) -> Option<(f32, [f64; 2])> {
        let Self { mass, momentum, moment, .. } = *self;
        let square = |[x, y]: [f64; 2]| x * x + y * y;
        let inertia = self.inertia - square(moment) / mass;
        let energy = self.energy - square(momentum) / mass;
        let rate = (self.before - self.turning) / inertia;
        let spin = self.turning - (moment[0] * momentum[1] - moment[1] * momentum[0]) / mass;
        let gives = rate * (2.0 * spin + rate * inertia) < 0.0;
        let is_slight = rate * rate * inertia <= MOST * energy;
        let is_known = !self.held && self.bodies > 1 && (gives || is_slight);
        is_known.then_some((rate as f32, moment.map(|sum| sum / mass)))
    }
}

/// Where a body is, seen from where another was when the step began.
fn place(bodies: &Bodies, body: u32, root: u32) -> [f64; 2] {
    let row = bodies.rows[body as usize].map(f64::from);
    let [own, origin] = [body, root].map(|body| bodies.poses[body as usize].p);
    [own.x - origin.x + row[Slot::DX], own.y - origin.y + row[Slot::DY]]
}

/// Lists that a step fills anew.
#[derive(Debug, Default)]
pub(crate) struct FreeIslands {
    islands: Islands,
    found: Vec<Whole>,
    /// Does nothing pull at all there is, and does anything touch?
    weightless: bool,
}

crate::footprint::footprint!(FreeIslands { islands, found } none { weightless });

impl FreeIslands {
    /// Looks for them before the substeps.
    pub(crate) fn begin(&mut self, stores: &Stores<'_>, gravity: Vec2) {
        let Stores { bodies, graph, joints, .. } = stores;
        self.weightless = gravity == Vec2::ZERO && graph.touching_count() > 0;
        if !self.weightless {
            return;
        }
        let Self { islands, found, .. } = self;
        islands.find_all(bodies, graph, joints);
        found.resize(bodies.infos.len(), Whole::default());
        bodies.awake.iter().for_each(|&body| found[body as usize] = Whole::default());
        let listed = bodies.awake.iter().filter(|&&body| bodies.is_dynamic(body));
        for &body in listed {
            let root = islands.root(body);
            let whole = &mut found[root as usize];
            whole.held |= !is_left_alone(bodies, joints, body);
            whole.add(bodies, body, place(bodies, body, root));
        }
        for (a, b) in touching(graph) {
            match [a, b].map(|body| bodies.is_solved(body)) {
                [true, false] => found[islands.root(a) as usize].held = true,
                [false, true] => found[islands.root(b) as usize].held = true,
                _ => {}
            }
        }
        for &body in &bodies.awake {
            let Whole { held, turning, .. } = found[body as usize];
            found[body as usize] = Whole { held, before: turning, ..Whole::default() };
        }
    }

    /// Gives back after the substeps what they have changed.
    pub(crate) fn end(&mut self, bodies: &mut Bodies) {
        if !self.weightless {
            return;
        }
        let Self { islands, found, .. } = self;
        for &body in bodies.awake.iter().filter(|&&body| bodies.is_dynamic(body)) {
            let root = islands.root(body);
            found[root as usize].add(bodies, body, place(bodies, body, root));
        }
        for k in 0..bodies.awake.len() {
            let body = bodies.awake[k];
            let root = islands.root(body);
            let correction = found[root as usize].correction();
            let (Some((rate, [x, y])), true) = (correction, bodies.is_dynamic(body)) else {
                continue;
            };
            let [px, py] = place(bodies, body, root);
            let row = &mut bodies.rows[body as usize];
            row[Slot::VX] -= rate * (py - y) as f32;
            row[Slot::VY] += rate * (px - x) as f32;
            row[Slot::W] += rate;
        }
    }
}

/// Does nothing act on a body from outside, and may it go and turn as it is pushed?
fn is_left_alone(bodies: &Bodies, joints: &Joints, body: u32) -> bool {
    let info = &bodies.infos[body as usize];
    let BodyInfo { locks, force, torque, linear_damping, angular_damping, .. } = *info;
    let pulled = force != Vec2::ZERO || torque != 0.0;
    let damped = linear_damping != 0.0 || angular_damping != 0.0;
    let locked = locks.x || locks.y || locks.rotation || info.never_turns;
    let keeps = |(joint, _): (u32, u32)| {
        let JointRecord { ref def, body_a, body_b, .. } = joints.records[joint as usize];
        [body_a, body_b].into_iter().all(|body| bodies.is_dynamic(body)) && pushes_in_one_point(def)
    };
    !pulled && !damped && !locked && joints.of_body(info.first_joint).all(keeps)
}

/// Does a joint act on both of its bodies along one line?
fn pushes_in_one_point(def: &JointDef) -> bool {
    use JointKind::{Distance, Prismatic, Revolute, Weld, Wheel};
    matches!(
        def.kind,
        Distance { .. } | Prismatic { .. } | Revolute { .. } | Weld { .. } | Wheel { .. }
    )
}
