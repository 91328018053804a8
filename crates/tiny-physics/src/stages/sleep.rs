//! Sleep: islands at rest leave the simulation until something disturbs them.
//!
//! Islands are not kept up to date from step to step. Every few steps in which some body has rested long enough, a
//! union-find over the touching contacts and joints of awake bodies finds the islands anew, and those
//! in which every body has rested fall asleep together. A sleeping island is a ring of bodies; waking
//! one wakes the ring.

use crate::describe::BodyKind;
use crate::dynamics::{Bodies, Contacts, Graph, JointGraph, Joints, NULL, OVERFLOW, Place};
use crate::math::Vec2;

/// Steps between two looks for islands at rest: one look costs about as much as a solver pass.
pub(crate) const INTERVAL: u64 = 8;

/// Finds islands at rest and appends their bodies to `islands`, each island ended by [`NULL`].
pub(crate) fn find_resting(
    bodies: &Bodies,
    graph: &Graph,
    joints: &Joints,
    time_to_sleep: f32,
    islands: &mut Vec<u32>,
) {
    islands.clear();
    if !bodies.awake.iter().any(|&i| bodies.infos[i as usize].sleep_time >= time_to_sleep) {
        return;
    }
    let mut sets = Sets::new(bodies, time_to_sleep);
    sets.join_contacts(bodies, graph);
    sets.join_joints(bodies, joints);
    sets.collect_resting(bodies, islands);
}

/// Union-find over awake bodies.
struct Sets {
    parent: Vec<u32>,
    /// Must the set of this root stay awake?
    restless: Vec<bool>,
    time_to_sleep: f32,
}

impl Sets {
    fn new(bodies: &Bodies, time_to_sleep: f32) -> Self {
        let count = bodies.infos.len();
        let parent = (0..count as u32).collect();
        Self { parent, restless: vec![false; count], time_to_sleep }
    }

    fn find(&mut self, mut i: u32) -> u32 {
        while self.parent[i as usize] != i {
            let above = self.parent[self.parent[i as usize] as usize];
            self.parent[i as usize] = above;
            i = above;
        }
        i
    }

    /// Joins two bodies' islands. Bodies that are not dynamic join nothing, but a moving one keeps
    /// the other awake.
    fn join(&mut self, bodies: &Bodies, a: u32, b: u32) {
        match (bodies.is_dynamic(a), bodies.is_dynamic(b)) {
            (true, true) => {
                let (a, b) = (self.find(a), self.find(b));
                // The smaller index becomes the root: the result depends on the sets alone.
                let (root, child) = if a < b { (a, b) } else { (b, a) };
                self.parent[child as usize] = root;
            }
            (true, false) => self.restless[a as usize] |= !rests(bodies, b, self.time_to_sleep),
            (false, true) => self.restless[b as usize] |= !rests(bodies, a, self.time_to_sleep),
            (false, false) => {}
        }
    }

    fn join_contacts(&mut self, bodies: &Bodies, graph: &Graph) {
        for buckets in &graph.buckets[..=OVERFLOW] {
            for bucket in buckets {
                for slot in 0..bucket.contacts.len() {
                    let (a, b) = bucket.bodies(slot);
                    self.join(bodies, a, b);
                }
            }
        }
    }

    fn join_joints(&mut self, bodies: &Bodies, joints: &Joints) {
        for (a, b) in joints.pairs() {
            self.join(bodies, a, b);
        }
    }

    fn collect_resting(&mut self, bodies: &Bodies, islands: &mut Vec<u32>) {
        for &body in &bodies.awake {
            let rested = bodies.infos[body as usize].sleep_time >= self.time_to_sleep;
            if !rested || self.restless[body as usize] {
                let root = self.find(body);
                self.restless[root as usize] = true;
            }
        }
        let mut resting: Vec<(u32, u32)> =
            bodies.awake.iter().map(|&body| (self.find(body), body)).collect();
        resting.retain(|&(root, _)| !self.restless[root as usize]);
        resting.sort_unstable();
        for (i, &(root, body)) in resting.iter().enumerate() {
            islands.push(body);
            if resting.get(i + 1).is_none_or(|&(next, _)| next != root) {
                islands.push(NULL);
            }
        }
    }
}

/// May what lies on a body that is not dynamic sleep? Not on a kinematic one that moves or stays awake.
fn rests(bodies: &Bodies, index: u32, time_to_sleep: f32) -> bool {
    let info = &bodies.infos[index as usize];
    let still = bodies.velocity(index) == Vec2::ZERO && bodies.angular_velocity(index) == 0.0;
    info.kind == BodyKind::Static || still && (!info.awake || info.sleep_time >= time_to_sleep)
}

/// The awake dynamic bodies that hang together with one by touching contacts and joints, ascending, then
/// [`NULL`]; a kinematic body is alone. Empty if the island touches a kinematic body that is awake: that
/// would go on pushing what sleeps.
pub(crate) fn island_of(
    index: u32,
    bodies: &Bodies,
    contacts: &Contacts,
    joints: &Joints,
) -> Vec<u32> {
    let is_awake = |i: u32| bodies.infos[i as usize].awake;
    let mut seen = vec![false; bodies.infos.len()];
    let mut island = vec![index];
    seen[index as usize] = true;
    let mut next = 0;
    while next < island.len() && bodies.is_dynamic(index) {
        let info = &bodies.infos[island[next] as usize];
        let touching = contacts
            .of_body(info.first_contact)
            .map(|(contact, _)| &contacts.records[contact as usize])
            .filter(|contact| contact.touching)
            .flat_map(|contact| [contact.body_a, contact.body_b]);
        let joined = joints
            .of_body(info.first_joint)
            .map(|(joint, _)| &joints.records[joint as usize])
            .flat_map(|joint| [joint.body_a, joint.body_b]);
        for other in touching.chain(joined) {
            if !bodies.is_dynamic(other) && is_awake(other) {
                return Vec::new();
            }
            if is_awake(other) && !core::mem::replace(&mut seen[other as usize], true) {
                island.push(other);
            }
        }
        next += 1;
    }
    island.sort_unstable();
    island.push(NULL);
    island
}

/// Puts islands (each ended by [`NULL`]) to sleep: takes their bodies and what hangs on them out of the
/// simulation.
pub(crate) fn put_to_sleep(
    islands: &[u32],
    bodies: &mut Bodies,
    contacts: &mut Contacts,
    graph: &mut Graph,
    joints: &mut Joints,
    joint_graph: &mut JointGraph,
) {
    for island in islands.split(|&body| body == NULL).filter(|island| !island.is_empty()) {
        put_island_to_sleep(island, bodies, contacts, graph, joints, joint_graph);
    }
    let Bodies { awake, infos, .. } = bodies;
    awake.retain(|&i| infos[i as usize].awake);
}

fn put_island_to_sleep(
    island: &[u32],
    bodies: &mut Bodies,
    contacts: &mut Contacts,
    graph: &mut Graph,
    joints: &mut Joints,
    joint_graph: &mut JointGraph,
) {
    for (i, &body) in island.iter().enumerate() {
        bodies.set_velocity(body, Vec2::ZERO);
        bodies.set_angular_velocity(body, 0.0);
        bodies.previous[body as usize] = bodies.poses[body as usize];
        let info = &mut bodies.infos[body as usize];
        info.awake = false;
        info.island_next = island[(i + 1) % island.len()];
    }
    for &body in island {
        let mut edge = bodies.infos[body as usize].first_contact;
        while edge != NULL {
            let contact = &contacts.records[edge as usize / 2];
            let awake = super::pairs::is_awake(bodies, contact);
            let next = contact.links[edge as usize % 2].1;
            if !awake {
                graph.remove(bodies, contacts, edge / 2);
            }
            edge = next;
        }
        for index in joints_of(bodies, joints, body) {
            let record = &joints.records[index as usize];
            if !bodies.infos[record.body_a as usize].awake
                && !bodies.infos[record.body_b as usize].awake
            {
                joint_graph.remove(bodies, joints, index);
            }
        }
    }
}

/// Wakes a body and its island, and gives the bodies that woke, ascending. Islands that a joint links to it wake
/// with it: they fell asleep before the joint was made. Nothing happens if it is awake or cannot move.
pub(crate) fn wake(
    index: u32,
    bodies: &mut Bodies,
    contacts: &mut Contacts,
    graph: &mut Graph,
    joints: &mut Joints,
    joint_graph: &mut JointGraph,
) -> Vec<u32> {
    let mut island = Vec::new();
    let mut sleepers = vec![index];
    while let Some(sleeper) = sleepers.pop() {
        let first = island.len();
        wake_ring(sleeper, bodies, &mut island);
        for &body in &island[first..] {
            let linked = joints.of_body(bodies.infos[body as usize].first_joint);
            let linked = linked.map(|(joint, _)| &joints.records[joint as usize]);
            let pulling = linked.filter(|joint| joint.class().is_some());
            let ends = pulling.flat_map(|joint| [joint.body_a, joint.body_b]);
            sleepers.extend(ends.filter(|&end| bodies.is_dynamic(end)));
        }
    }
    island.sort_unstable();
    for &body in &island {
        bodies.push_awake(body);
        let mut edge = bodies.infos[body as usize].first_contact;
        while edge != NULL {
            if contacts.records[edge as usize / 2].place == Place::Asleep {
                graph.insert(bodies, contacts, edge / 2);
            }
            edge = contacts.records[edge as usize / 2].links[edge as usize % 2].1;
        }
        for index in joints_of(bodies, joints, body) {
            joint_graph.insert(bodies, joints, index);
        }
    }
    island
}

/// Wakes the ring of a body that sleeps and can move, and appends its bodies.
fn wake_ring(index: u32, bodies: &mut Bodies, island: &mut Vec<u32>) {
    let info = &bodies.infos[index as usize];
    if info.awake || !info.alive || !info.enabled || info.kind == BodyKind::Static {
        return;
    }
    let mut body = index;
    loop {
        island.push(body);
        let info = &mut bodies.infos[body as usize];
        info.awake = true;
        info.sleep_time = 0.0;
        body = core::mem::replace(&mut info.island_next, NULL);
        if body == index || body == NULL {
            break;
        }
    }
}

/// Joints of a body, ascending.
fn joints_of(bodies: &Bodies, joints: &Joints, body: u32) -> Vec<u32> {
    let first = bodies.infos[body as usize].first_joint;
    let mut indices: Vec<u32> = joints.of_body(first).map(|(index, _)| index).collect();
    indices.sort_unstable();
    indices
}
