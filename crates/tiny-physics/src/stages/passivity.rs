//! Passivity: what only holds and brakes does no work, so the constraints of an island may not add energy.
//!
//! In a substep forces add g to the velocities u, and constraints make v of that. Their work is
//! `W = sum of (v - u - g) . M (v + u) / 2` over the island. Above 0 it is an error: rows that have not converged, old
//! impulses on arms that have turned since. What W has been below 0 in the substeps before may be given back; beyond it
//! the velocities shrink to the greatest share s with
//!
//! ```text
//! W(s) = a s^2 + b s + c <= given back,    v(s) = r + s (v - r)
//! ```
//!
//! where r is the motion of what the island leans on or, if it is free, its own as a rigid body, which keeps both
//! momenta. Rows with `J v = 0` or `J v >= 0` stay so, and impulses stay what they are: loads are held.
//!
//! Up to what gravity gives in one substep to what rests, W is noise, and braked by [`GENTLE`] at most: nets that are
//! stopped wholly whenever W is above 0 freeze where they hang, because corrections of places keep it there. So at most
//! noise of three substeps' fall, 0.13 m/s, is left. Scaling the change of velocities, not the velocities, was tried: chains
//! swing on, and 22 crates of 800 fell through bridges instead of 10; cutting warm starts so lost 13.
//!
//! Islands that something may work on are left alone: motors that run, springs, belts, machines that turn.

use super::islands::Stores;
use crate::describe::{JointDef, JointKind};
use crate::dynamics::{Bodies, DisjointSets, JOINTED, NULL, Slot, inverses};
use crate::math::DVec2;
use crate::simd::BLOCK;

/// Least share where W is noise.
const GENTLE: f64 = 0.95;

/// What is known of an island.
#[derive(Clone, Copy, Debug, Default)]
struct Island {
    /// Something may work on it.
    driven: bool,
    /// Velocity of the bodies it leans on, which nothing moves.
    ground: Option<[f32; 2]>,
    /// Where it is, roughly.
    origin: DVec2,
    whole: Whole,
    /// a, b and c of the work.
    work: [f64; 3],
    /// Energy that forces give to what rests, joules.
    noise: f64,
    /// Work that its constraints have taken in this step.
    taken: f64,
    share: f64,
}

/// A motion as one rigid body.
#[derive(Clone, Copy, Debug, Default)]
struct Whole {
    /// Along x and y.
    mass: [f64; 2],
    inertia: f64,
    /// From the origin.
    center: [f64; 2],
    velocity: [f64; 2],
    spin: f64,
}

impl Whole {
    /// Its velocity where a body is.
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let arm = [x - self.center[0], y - self.center[1]];
        [self.velocity[0] - self.spin * arm[1], self.velocity[1] + self.spin * arm[0], self.spin]
    }
}

/// A body in a substep: masses; velocities at the end, at the start, and what forces added; its place.
struct State {
    masses: [f64; 3],
    v: [f64; 3],
    u: [f64; 3],
    g: [f64; 3],
    place: [f64; 2],
}

impl State {
    fn new(bodies: &Bodies, body: u32, origin: DVec2) -> Self {
        let (row, start) = (&bodies.rows[body as usize], &bodies.starts[body as usize]);
        let (info, pose) = (&bodies.infos[body as usize], &bodies.poses[body as usize]);
        let own = |inverse: f32, mass: f32| if inverse > 0.0 { f64::from(mass) } else { 0.0 };
        let [x, y, turn] = inverses::<f32>((), row);
        let g = core::array::from_fn(|k| f64::from(bodies.motions[body as usize].gain[k]));
        Self {
            masses: [own(x, info.mass), own(y, info.mass), own(turn, info.inertia)],
            v: core::array::from_fn(|k| f64::from(row[k])),
            u: core::array::from_fn(|k| f64::from(start[k]) - g[k]),
            g,
            place: [
                pose.p.x - origin.x + f64::from(row[Slot::DX]),
                pose.p.y - origin.y + f64::from(row[Slot::DY]),
            ],
        }
    }
}

/// The islands of a pace. Found anew each step; kept for its memory.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    sets: DisjointSets,
    /// Of each root its island, or NULL.
    numbers: Vec<u32>,
    islands: Vec<Island>,
    /// Bodies of islands that are watched, and which.
    members: Vec<(u32, u32)>,
    /// Those of islands that lean on nothing.
    free: Vec<(u32, u32)>,
    /// Energy that constraints would have added in this step, joules.
    pub(crate) withheld: f64,
}

crate::footprint::footprint!(Memory { sets, numbers, islands, members, free } none { withheld });

impl Memory {
    /// Finds the islands of a pace whose bodies are listed; none where nothing is joined.
    pub(crate) fn find(&mut self, pace: usize, listed: &[u32], stores: &Stores<'_>) {
        let Stores { bodies, graph, joints, joint_graph, .. } = stores;
        let Self { sets, numbers, islands, members, free, .. } = self;
        islands.clear();
        members.clear();
        free.clear();
        if pace < JOINTED {
            return;
        }
        let touching = || {
            graph.of_pace(pace).iter().flat_map(|bucket| {
                (0..bucket.contacts.len()).map(move |slot| {
                    let belt = bucket.surfaces[slot / BLOCK].tangent_speed[slot % BLOCK] != 0.0;
                    (bucket.bodies(slot), belt)
                })
            })
        };
        let records = || {
            let all = joint_graph.of_pace(pace).iter().flat_map(|colour| colour.joints());
            all.map(|joint| &joints.records[joint as usize])
        };
        let joined =
            || records().map(|record| ((record.body_a, record.body_b), may_drive(&record.def)));
        // A contact that has just begun may join what is of two paces until the next step.
        let is_here =
            |body| bodies.is_solved(body) && usize::from(bodies.infos[body as usize].pace) == pace;
        sets.reset(bodies.infos.len(), listed.iter().copied());
        touching().chain(joined()).for_each(|((a, b), _)| {
            if is_here(a) && is_here(b) {
                sets.join(a, b);
            }
        });
        numbers.resize(bodies.infos.len(), NULL);
        listed.iter().for_each(|&body| numbers[body as usize] = NULL);
        for &body in listed.iter().filter(|&&body| bodies.is_dynamic(body)) {
            let number = &mut numbers[sets.root(body) as usize];
            if *number == NULL {
                *number = islands.len() as u32;
                let origin = bodies.poses[body as usize].p;
                islands.push(Island { origin, ..Island::default() });
            }
            members.push((body, *number));
            if bodies.inverse_masses(body) == (0.0, 0.0) {
                islands[*number as usize].lean_on([0.0, 0.0]);
            }
        }
        touching().chain(joined()).for_each(|((a, b), drives)| {
            let (mover, body) = if is_here(a) { (b, a) } else { (a, b) };
            if !is_here(body) {
                return;
            }
            let island = &mut islands[numbers[sets.root(body) as usize] as usize];
            island.driven |= drives;
            if !bodies.is_dynamic(mover) {
                let row = &bodies.rows[mover as usize];
                island.driven |= row[Slot::W] != 0.0;
                island.lean_on([row[Slot::VX], row[Slot::VY]]);
            }
        });
        for record in records() {
            for body in [record.body_a, record.body_b].into_iter().filter(|&body| is_here(body)) {
                let island = &mut islands[numbers[sets.root(body) as usize] as usize];
                match record.def.kind {
                    // Hangs from the world.
                    JointKind::Pulley { .. } => island.lean_on([0.0, 0.0]),
                    // Turns against it: what leans on nothing else has no motion of its own as a whole.
                    JointKind::Gear { .. } => island.driven |= island.ground.is_none(),
                    _ => {}
                }
            }
        }
        members.retain(|&(_, island)| !islands[island as usize].driven);
        let is_free = |&&(_, island): &&(u32, u32)| islands[island as usize].ground.is_none();
        free.extend(members.iter().filter(is_free));
    }

    /// Lets the velocities of islands whose constraints did work in this substep give way.
    pub(crate) fn run(&mut self, bodies: &mut Bodies) {
        let Self { islands, members, free, withheld, .. } = self;
        find_whole(bodies, islands, free);
        for &(body, island) in &*members {
            let island = &mut islands[island as usize];
            let State { masses, v, u, g, place } = State::new(bodies, body, island.origin);
            let whole = island.whole.at(place);
            for k in 0..3 {
                let frame = if k < 2 { island.whole.velocity[k] } else { 0.0 };
                let (own, rest, u) = (v[k] - whole[k], whole[k] - frame, u[k] - frame);
                let half = 0.5 * masses[k];
                island.work[0] += half * own * own;
                island.work[1] += half * own * (2.0 * rest - g[k]);
                island.work[2] += half * (rest * (rest - g[k]) - u * (u + g[k]));
                island.noise += half * g[k] * g[k];
            }
        }
        *withheld += islands.iter_mut().map(Island::give_way).sum::<f64>();
        let all = members.iter().map(|&(body, island)| (body, &islands[island as usize]));
        for (body, island) in all.filter(|(_, island)| island.share < 1.0) {
            let State { masses, v, place, .. } = State::new(bodies, body, island.origin);
            let whole = island.whole.at(place);
            for k in (0..3).filter(|&k| masses[k] > 0.0) {
                let less = (1.0 - island.share) * (v[k] - whole[k]);
                bodies.rows[body as usize][k] = (v[k] - less) as f32;
                // What the difference of the two says, the impulses of the substep, is carried on.
                bodies.starts[body as usize][k] -= less as f32;
            }
        }
    }
}

impl Island {
    /// Notes what moves with this velocity under it.
    fn lean_on(&mut self, ground: [f32; 2]) {
        self.driven |= self.ground.is_some_and(|other| other != ground);
        self.ground = Some(ground);
    }

    /// Chooses its share. Gives the energy that this withholds.
    fn give_way(&mut self) -> f64 {
        let [a, b, c] = core::mem::take(&mut self.work);
        let noise = core::mem::take(&mut self.noise);
        let credit = self.taken;
        let work = a + b + c;
        let least = if work - credit > noise { 0.0 } else { GENTLE };
        self.share = 1.0;
        if work > credit && a > 0.0 {
            // The greater root.
            let square = b * b - 4.0 * a * (c - credit);
            let root = if square > 0.0 { square.sqrt() } else { 0.0 };
            self.share = ((root - b) / (2.0 * a)).clamp(least, 1.0);
        }
        let kept = (a * self.share + b) * self.share + c;
        self.taken = if kept < credit { credit - kept } else { 0.0 };
        work - kept
    }
}

/// Motions of all islands as a whole. `free` are the bodies of those that lean on nothing.
fn find_whole(bodies: &Bodies, islands: &mut [Island], free: &[(u32, u32)]) {
    for island in &mut *islands {
        let velocity = island.ground.unwrap_or_default().map(f64::from);
        island.whole = Whole { velocity, ..Whole::default() };
    }
    for &(body, island) in free {
        let Island { whole, origin, .. } = &mut islands[island as usize];
        let State { masses, v, place, .. } = State::new(bodies, body, *origin);
        for k in 0..2 {
            whole.mass[k] += masses[k];
            whole.center[k] += masses[k] * place[k];
            whole.velocity[k] += masses[k] * v[k];
        }
    }
    for Island { whole, .. } in islands.iter_mut() {
        for k in (0..2).filter(|&k| whole.mass[k] > 0.0) {
            whole.center[k] /= whole.mass[k];
            whole.velocity[k] /= whole.mass[k];
        }
    }
    for &(body, island) in free {
        let Island { whole, origin, .. } = &mut islands[island as usize];
        let State { masses: [x, y, inertia], v, place, .. } = State::new(bodies, body, *origin);
        let arm = [place[0] - whole.center[0], place[1] - whole.center[1]];
        let own = [v[0] - whole.velocity[0], v[1] - whole.velocity[1]];
        let mass = if x > y { x } else { y };
        whole.inertia += mass * (arm[0] * arm[0] + arm[1] * arm[1]) + inertia;
        // Angular momentum, until it is divided.
        whole.spin += mass * (arm[0] * own[1] - arm[1] * own[0]) + inertia * v[2];
    }
    for Island { whole, .. } in islands.iter_mut().filter(|island| island.whole.inertia > 0.0) {
        whole.spin /= whole.inertia;
    }
}

/// May a joint do work, or give back what it has stored?
pub(crate) fn may_drive(def: &JointDef) -> bool {
    let pulls = matches!(def.kind, JointKind::Motor { .. } | JointKind::Mouse { .. });
    def.softness.is_some() || pulls || def.kind.drives()
}
