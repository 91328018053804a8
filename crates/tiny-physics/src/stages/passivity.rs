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
use crate::simd::{BLOCK, Row};

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
    /// Does a lock hold a member along x, along y? The world pushes there.
    locked: [bool; 2],
    /// a, b and c of the work.
    work: [f64; 3],
    /// Energy that forces give to what rests in a substep, joules.
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
    /// Its velocity where a member is.
    fn at(&self, member: &Member, row: &Row) -> [f64; 3] {
        if self.spin == 0.0 {
            return [self.velocity[0], self.velocity[1], 0.0];
        }
        let [x, y] = member.place(row);
        let arm = [x - self.center[0], y - self.center[1]];
        [self.velocity[0] - self.spin * arm[1], self.velocity[1] + self.spin * arm[0], self.spin]
    }
}

/// A body of an island that is watched, and what stays the same for a step.
#[derive(Clone, Copy, Debug, Default)]
struct Member {
    body: u32,
    island: u32,
    masses: [f64; 3],
    /// What forces add to its velocity in a substep.
    g: [f64; 3],
    /// Its place at the start of the step, from the island's origin.
    place: [f64; 2],
}

impl Member {
    /// Works out what stays the same, unless something works on its island: is it watched?
    fn begin(&mut self, bodies: &Bodies, islands: &mut [Island]) -> bool {
        let (at, island) = (self.body as usize, &mut islands[self.island as usize]);
        if !island.driven {
            let own = |inverse, mass| if inverse > 0.0 { mass } else { 0.0 };
            let (info, p) = (&bodies.infos[at], bodies.poses[at].p);
            let [x, y, turn] = inverses::<f32>((), &bodies.rows[at]);
            let masses = [own(x, info.mass), own(y, info.mass), own(turn, info.inertia)];
            (self.masses, self.g) = (three(&masses), three(&bodies.motions[at].gain));
            (0..3).for_each(|k| island.noise += 0.5 * self.masses[k] * self.g[k] * self.g[k]);
            self.place = [p.x - island.origin.x, p.y - island.origin.y];
        }
        !island.driven
    }

    /// Where it is now.
    fn place(&self, row: &Row) -> [f64; 2] {
        [self.place[0] + f64::from(row[Slot::DX]), self.place[1] + f64::from(row[Slot::DY])]
    }
}

/// The first three numbers.
fn three(row: &[f32]) -> [f64; 3] {
    [f64::from(row[0]), f64::from(row[1]), f64::from(row[2])]
}

/// The islands of a pace. Found anew each step; kept for its memory.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    sets: DisjointSets,
    /// Of each root its island, or NULL.
    numbers: Vec<u32>,
    islands: Vec<Island>,
    members: Vec<Member>,
    /// Those of islands that lean on nothing.
    free: Vec<Member>,
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
            members.push(Member { body, island: *number, ..Member::default() });
            let (island, inverses) = (&mut islands[*number as usize], bodies.inverses(body));
            (0..2).for_each(|k| island.locked[k] |= inverses[k] == 0.0);
            if bodies.inverse_masses(body) == (0.0, 0.0) {
                island.lean_on([0.0, 0.0]);
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
        members.retain_mut(|member| member.begin(bodies, islands));
        let is_free = |member: &&Member| islands[member.island as usize].ground.is_none();
        free.extend(members.iter().filter(is_free));
    }

    /// Lets the velocities of islands whose constraints did work in this substep give way.
    pub(crate) fn run(&mut self, bodies: &mut Bodies) {
        let Self { islands, members, free, withheld, .. } = self;
        if members.is_empty() {
            return;
        }
        find_whole(bodies, islands, free);
        for member in &*members {
            let Member { body, island, masses, g, .. } = member;
            let island = &mut islands[*island as usize];
            let (row, start) = (&bodies.rows[*body as usize], &bodies.starts[*body as usize]);
            let (v, start, whole) = (three(row), three(start), island.whole.at(member, row));
            for k in 0..3 {
                let frame = if k < 2 { island.whole.velocity[k] } else { 0.0 };
                let u = start[k] - g[k] - frame;
                let (own, rest) = (v[k] - whole[k], whole[k] - frame);
                let half = 0.5 * masses[k];
                island.work[0] += half * own * own;
                island.work[1] += half * own * (2.0 * rest - g[k]);
                island.work[2] += half * (rest * (rest - g[k]) - u * (u + g[k]));
            }
        }
        *withheld += islands.iter_mut().map(Island::give_way).sum::<f64>();
        let all = members.iter().map(|member| (member, &islands[member.island as usize]));
        for (member, island) in all.filter(|(_, island)| island.share < 1.0) {
            let body = member.body as usize;
            let (row, start) = (&mut bodies.rows[body], &mut bodies.starts[body]);
            let (v, whole) = (three(row), island.whole.at(member, row));
            for k in (0..3).filter(|&k| member.masses[k] > 0.0) {
                let less = (1.0 - island.share) * (v[k] - whole[k]);
                row[k] = (v[k] - less) as f32;
                // What the difference of the two says, the impulses of the substep, is carried on.
                start[k] -= less as f32;
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
        let credit = self.taken;
        let work = a + b + c;
        let least = if work - credit > self.noise { 0.0 } else { GENTLE };
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
fn find_whole(bodies: &Bodies, islands: &mut [Island], free: &[Member]) {
    for island in &mut *islands {
        let velocity = island.ground.unwrap_or_default().map(f64::from);
        island.whole = Whole { velocity, ..Whole::default() };
    }
    for member in free {
        let whole = &mut islands[member.island as usize].whole;
        let row = &bodies.rows[member.body as usize];
        let (masses, v, place) = (member.masses, three(row), member.place(row));
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
    for member in free {
        let whole = &mut islands[member.island as usize].whole;
        let row = &bodies.rows[member.body as usize];
        let ([x, y, inertia], v, place) = (member.masses, three(row), member.place(row));
        let arm = [place[0] - whole.center[0], place[1] - whole.center[1]];
        let own = [v[0] - whole.velocity[0], v[1] - whole.velocity[1]];
        let mass = if x > y { x } else { y };
        whole.inertia += mass * (arm[0] * arm[0] + arm[1] * arm[1]) + inertia;
        // Angular momentum, until it is divided.
        whole.spin += mass * (arm[0] * own[1] - arm[1] * own[0]) + inertia * v[2];
    }
    for Island { whole, locked, .. } in islands.iter_mut().filter(|it| it.whole.inertia > 0.0) {
        whole.spin = if *locked == [false; 2] { whole.spin / whole.inertia } else { 0.0 };
        (0..2).filter(|&k| locked[k]).for_each(|k| whole.velocity[k] = 0.0);
    }
}

/// May a joint do work, or give back what it has stored?
pub(crate) fn may_drive(def: &JointDef) -> bool {
    let pulls = matches!(def.kind, JointKind::Motor { .. } | JointKind::Mouse { .. });
    def.softness.is_some() || pulls || def.kind.drives()
}
