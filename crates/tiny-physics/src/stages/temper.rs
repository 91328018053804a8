//! Tempering warm starts: old impulses meet arms that have turned since, and can add energy then.
//!
//! Of what a warm start does to the velocities of an island, `dv`, only that part is kept that takes the most
//! kinetic energy away: `s = -(v . M dv) / (dv . M dv)`, between nothing and all of it. At rest that is all of it; no
//! warm start adds energy. Velocities are those against a body that moves the island and is itself not moved, if
//! there is one, so that what lies on a lift is tempered as on the ground.

use super::islands::Stores;
use crate::dynamics::{DisjointSets, Slot};
use crate::simd::{BLOCK, Row};

/// What is known of an island, at the index of its root.
#[derive(Clone, Copy, Debug, Default)]
struct Island {
    /// Has it a tree of joints? Heaps without come out worse.
    tempered: bool,
    /// Velocity that it is seen from.
    frame: [f32; 2],
    /// `dv . M dv` and `v . M dv`.
    sums: [f64; 2],
    share: f32,
}

/// The islands of a pace. Found anew each step; kept for its memory.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    sets: DisjointSets,
    islands: Vec<Island>,
}

crate::footprint::footprint!(Memory { sets, islands });

impl Memory {
    /// Finds the islands of a pace.
    pub(crate) fn find(&mut self, pace: usize, stores: &Stores<'_>) {
        let Stores { bodies, graph, joints, joint_graph, .. } = stores;
        let Self { sets, islands } = self;
        sets.reset(bodies.infos.len());
        islands.clear();
        islands.resize(bodies.infos.len(), Island::default());
        let pairs = || {
            let touching = graph
                .of_pace(pace)
                .iter()
                .flat_map(|bucket| (0..bucket.contacts.len()).map(|slot| bucket.bodies(slot)));
            let joined = joint_graph.of_pace(pace).iter().flat_map(|colour| colour.joints());
            let joined = joined.map(|joint| {
                let record = &joints.records[joint as usize];
                (record.body_a, record.body_b)
            });
            touching.chain(joined)
        };
        for (a, b) in pairs().filter(|&(a, b)| bodies.is_dynamic(a) && bodies.is_dynamic(b)) {
            sets.join(a, b);
        }
        for tree in joint_graph.forest.trees.iter().filter(|tree| tree.pace == pace) {
            if let Some(node) = tree.nodes.first() {
                islands[sets.root(node.body) as usize].tempered = true;
            }
        }
        for (a, b) in pairs() {
            let (mover, body) = if bodies.is_dynamic(a) { (b, a) } else { (a, b) };
            let row = &bodies.rows[mover as usize];
            if !bodies.is_dynamic(mover) && (row[Slot::VX] != 0.0 || row[Slot::VY] != 0.0) {
                islands[sets.root(body) as usize].frame = [row[Slot::VX], row[Slot::VY]];
            }
        }
    }

    /// Tempers what warm starting did to the bodies listed since their `starts`, and the impulses with it.
    pub(crate) fn run(&mut self, pace: usize, listed: &[u32], stores: &mut Stores<'_>) {
        let bodies = &mut *stores.bodies;
        for &body in listed.iter().filter(|&&body| bodies.is_dynamic(body)) {
            let island = &mut self.islands[self.sets.root(body) as usize];
            let (row, start) = (&bodies.rows[body as usize], &bodies.starts[body as usize]);
            let [spent, gained] = sums(row, start, island.frame);
            island.sums[0] += spent;
            island.sums[1] += gained;
        }
        let mut all = true;
        for island in &mut self.islands {
            let [spent, gained] = core::mem::take(&mut island.sums);
            let useful = if gained < 0.0 { -gained } else { 0.0 };
            let cut = island.tempered && useful < spent;
            island.share = if cut { (useful / spent) as f32 } else { 1.0 };
            all &= island.share == 1.0;
        }
        if all {
            return;
        }
        for &body in listed {
            if !bodies.is_dynamic(body) {
                continue;
            }
            let share = self.islands[self.sets.root(body) as usize].share;
            let start = bodies.starts[body as usize];
            let row = &mut bodies.rows[body as usize];
            for k in 0..3 {
                row[k] = start[k] + share * (row[k] - start[k]);
            }
        }
        self.scale_impulses(pace, stores);
    }

    fn scale_impulses(&mut self, pace: usize, stores: &mut Stores<'_>) {
        let Stores { bodies, graph, joint_graph, .. } = stores;
        let Self { sets, islands } = self;
        let sets = core::cell::RefCell::new(sets);
        let share = |a: u32, b: u32| {
            let body = if bodies.is_dynamic(a) { a } else { b };
            islands[sets.borrow_mut().root(body) as usize].share
        };
        for bucket in graph.of_pace_mut(pace) {
            for slot in 0..bucket.contacts.len() {
                let (a, b) = bucket.bodies(slot);
                let factor = share(a, b);
                for point in &mut bucket.constraints[slot / BLOCK].points {
                    point.normal_impulse[slot % BLOCK] *= factor;
                    point.tangent_impulse[slot % BLOCK] *= factor;
                }
            }
        }
        for colour in joint_graph.of_pace_mut(pace) {
            colour.scale_impulses(share);
        }
        for tree in joint_graph.forest.trees.iter_mut().filter(|tree| tree.pace == pace) {
            if let Some(node) = tree.nodes.first() {
                tree.scale_impulses(share(node.body, node.body));
            }
        }
    }
}

/// `dv . M dv` and `v . M dv` of a body, seen from a frame.
fn sums(row: &Row, start: &[f32; 4], frame: [f32; 2]) -> [f64; 2] {
    let mass = |inverse: f32| if inverse > 0.0 { 1.0 / f64::from(inverse) } else { 0.0 };
    let linear = mass(row[Slot::INV_MASS]);
    let masses = [linear, linear, mass(row[Slot::INV_INERTIA])];
    let frame = [frame[0], frame[1], 0.0];
    let mut sums = [0.0; 2];
    for k in 0..3 {
        let change = f64::from(row[k] - start[k]);
        sums[0] += masses[k] * change * change;
        sums[1] += masses[k] * change * f64::from(start[k] - frame[k]);
    }
    sums
}
