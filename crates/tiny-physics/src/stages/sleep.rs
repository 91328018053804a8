//! Sleep: islands at rest leave the simulation until something disturbs them.
//!
//! Islands are not kept up to date from step to step. Every few steps in which some body has rested long enough, a
//! union-find over the touching contacts and joints of awake bodies finds the islands anew, and those
//! in which every body has rested fall asleep together. A sleeping island is a ring of bodies; waking
//! one wakes the ring.

use super::ahead;
use super::islands::{self, Islands, Stores};
use crate::describe::BodyKind;
use crate::dynamics::{
    Bodies, Bucket, Contacts, DisjointSets, Graph, Joints, NULL, Place, flags, next_edge,
};
use crate::math::Vec2;
use crate::simd::BLOCK;
use std::collections::BTreeSet;

/// Steps between two looks for islands at rest: one look costs about as much as a solver pass.
pub(crate) const INTERVAL: u64 = 8;

/// Taking a body out of the list of those awake costs about as much as going past this many that stay.
const MANY_AWAKE: usize = 16;

/// What slides at this part of its sleep speed, and by this cosine along the forces on it, does not rest.
const CREEPS: f32 = 0.02;

/// A surface slides where its friction is at least this part of the greatest.
const SLIDES: f32 = 0.99;

/// What the look for islands at rest fills anew; kept for its memory.
#[derive(Debug, Default)]
pub(crate) struct Sets {
    islands: Islands,
    /// Must the island of this root stay awake?
    restless: Vec<bool>,
    stuck: Stuck,
    /// Root and body of those that may sleep.
    resting: Vec<(u32, u32)>,
}

crate::footprint::footprint!(Sets { islands, restless, stuck, resting });

/// What sticks together by contacts that do not slide and by joints.
#[derive(Debug, Default)]
struct Stuck {
    sets: DisjointSets,
    /// Does a contact of this body slide?
    slides: Vec<bool>,
    /// Is this body, or that of this root, held by what is not dynamic?
    held: Vec<bool>,
}

crate::footprint::footprint!(Stuck { sets, slides, held });

/// Finds islands at rest and lists their bodies in `found`, each island ended by [`NULL`]: those in which every
/// body has rested and none is moved or carried by what it lies on, or by a joint. `lengths` are those of a plain substep, seconds,
/// and of the world's unit.
pub(crate) fn find_resting(
    bodies: &Bodies,
    graph: &Graph,
    joints: &Joints,
    time_to_sleep: f32,
    lengths: (f32, f32),
    sets: &mut Sets,
    found: &mut Vec<u32>,
) {
    found.clear();
    if !bodies.awake.iter().any(|&i| bodies.infos[i as usize].sleep_time >= time_to_sleep) {
        return;
    }
    let Sets { islands: sets, restless, stuck, resting } = sets;
    sets.find_all(bodies, graph, joints);
    restless.resize(bodies.infos.len(), false);
    bodies.awake.iter().for_each(|&body| restless[body as usize] = false);
    for (a, b) in islands::touching(graph).chain(joints.pairs()) {
        match (bodies.is_dynamic(a), bodies.is_dynamic(b)) {
            (true, false) => restless[a as usize] |= !rests(bodies, b, time_to_sleep),
            (false, true) => restless[b as usize] |= !rests(bodies, a, time_to_sleep),
            _ => {}
        }
    }
    for (_, bucket) in graph.touching_buckets() {
        for (a, b) in carried(bucket) {
            for body in [a, b] {
                restless[body as usize] |= bodies.is_dynamic(body);
            }
        }
    }
    find_held(bodies, graph, joints, lengths.1, stuck);
    let driven = joints.driven.iter().map(|&index| &joints.records[index as usize]);
    let rested = |i: u32| bodies.infos[i as usize].sleep_time >= time_to_sleep;
    let may_rest = |body: u32| rested(body) || !bodies.is_dynamic(body);
    let driven = driven.filter(|record| {
        record.place != Place::Asleep && may_rest(record.body_a) && may_rest(record.body_b)
    });
    for record in driven.filter(|record| ahead::moves((bodies, joints), record, lengths)) {
        for body in [record.body_a, record.body_b] {
            restless[body as usize] |= bodies.is_dynamic(body);
        }
    }
    for &body in &bodies.awake {
        let root = sets.root(body) as usize;
        let slips = stuck.slides[body as usize] && creeps(bodies, body, lengths.1);
        let goes_on = slips && !stuck.held[stuck.sets.root(body) as usize];
        if !rested(body) || restless[body as usize] || goes_on {
            restless[root] = true;
        }
    }
    resting.clear();
    resting.extend(bodies.awake.iter().map(|&body| (sets.root(body), body)));
    resting.retain(|&(root, _)| !restless[root as usize]);
    resting.sort_unstable();
    for (i, &(root, body)) in resting.iter().enumerate() {
        found.push(body);
        if resting.get(i + 1).is_none_or(|&(next, _)| next != root) {
            found.push(NULL);
        }
    }
}

/// Finds what sticks together, and what of it is held by what is not dynamic: all else slides, and goes on if it creeps.
fn find_held(bodies: &Bodies, graph: &Graph, joints: &Joints, unit: f32, stuck: &mut Stuck) {
    let Stuck { sets, slides, held } = stuck;
    sets.reset(bodies.infos.len(), bodies.awake.iter().copied());
    for list in [&mut *slides, &mut *held] {
        list.resize(bodies.infos.len(), false);
        bodies.awake.iter().for_each(|&body| list[body as usize] = false);
    }
    let touching = graph.touching_buckets().flat_map(|(_, bucket)| {
        (0..bucket.contacts.len()).map(move |slot| {
            let ((a, b), lane) = (bucket.bodies(slot), slot % BLOCK);
            // What does not rub at all says nothing between two that both move.
            let both = bodies.is_solved(a) && bodies.is_solved(b);
            let rubs = !both || bucket.constraints[slot / BLOCK].friction[lane] > 0.0;
            ((a, b), rubs && slides_at(bucket, slot))
        })
    });
    for ((a, b), sliding) in touching.chain(joints.pairs().map(|pair| (pair, false))) {
        let [first, second] = [a, b].map(|body| bodies.is_solved(body));
        // What touches something that is not dynamic and does not creep lies there.
        if sliding && (first && second || creeps(bodies, if first { a } else { b }, unit)) {
            (slides[a as usize], slides[b as usize]) = (true, true);
        } else if first && second {
            sets.join(a, b);
        } else {
            (held[a as usize], held[b as usize]) = (true, true);
        }
    }
    for &body in &bodies.awake {
        let root = sets.root(body) as usize;
        held[root] |= held[body as usize];
    }
}

/// Does a body go slowly where the forces on it pull it?
fn creeps(bodies: &Bodies, body: u32, unit: f32) -> bool {
    let ([x, y, ..], v) = (bodies.motions[body as usize].gain, bodies.velocity(body));
    let (pull, least) = (Vec2::new(x, y), bodies.infos[body as usize].sleep_speed * unit);
    v.length() > CREEPS * least && v.dot(pull) > CREEPS * v.length() * pull.length()
}

/// Do the surfaces of a contact rub as much as they can?
fn slides_at(bucket: &Bucket, slot: usize) -> bool {
    let (constraint, lane) = (&bucket.constraints[slot / BLOCK], slot % BLOCK);
    constraint.points.iter().all(|point| {
        point.tangent_impulse[lane].abs() >= SLIDES * constraint.friction[lane] * point.load[lane]
    })
}

/// The bodies of contacts whose surfaces run, and do not slide: however slowly a belt carries something, that does not rest.
/// What it slides under is held by something else.
fn carried(bucket: &Bucket) -> impl Iterator<Item = (u32, u32)> + '_ {
    let runs = |slot: &usize| {
        let belt = bucket.surfaces[slot / BLOCK].tangent_speed[slot % BLOCK];
        belt != 0.0 && !slides_at(bucket, *slot)
    };
    let belts = |slot: &usize| bucket.heads[slot / BLOCK].flags & flags::TANGENT_SPEED != 0;
    (0..bucket.contacts.len()).filter(belts).filter(runs).map(|slot| bucket.bodies(slot))
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
    let mut seen = BTreeSet::from([index]);
    let mut island = vec![index];
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
            .filter(|joint| joint.place != Place::Asleep)
            .flat_map(|joint| [joint.body_a, joint.body_b]);
        for other in touching.chain(joined) {
            if !bodies.is_dynamic(other) && is_awake(other) {
                return Vec::new();
            }
            if is_awake(other) && seen.insert(other) {
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
/// simulation. The impulses that are kept are multiplied with `scale`. `hinges` is memory.
pub(crate) fn put_to_sleep(
    islands: &[u32],
    mut stores: Stores<'_>,
    scale: f32,
    hinges: &mut Vec<u32>,
) {
    for island in islands.split(|&body| body == NULL).filter(|island| !island.is_empty()) {
        put_island_to_sleep(island, &mut stores, scale, hinges);
    }
    // One by one where that is less than all: an island that the user puts to sleep.
    if islands.len() < stores.bodies.awake.len() / MANY_AWAKE {
        islands.iter().filter(|&&body| body != NULL).for_each(|&i| stores.bodies.remove_awake(i));
    } else {
        stores.bodies.retain_awake();
    }
}

fn put_island_to_sleep(island: &[u32], stores: &mut Stores<'_>, scale: f32, hinges: &mut Vec<u32>) {
    let Stores { bodies, contacts, graph, joints, joint_graph } = stores;
    for (i, &body) in island.iter().enumerate() {
        bodies.set_velocity(body, Vec2::ZERO);
        bodies.set_angular_velocity(body, 0.0);
        bodies.previous[body as usize] = bodies.poses[body as usize];
        bodies.swings[body as usize] = 0;
        let info = &mut bodies.infos[body as usize];
        info.awake = false;
        (info.force, info.torque) = (Vec2::ZERO, 0.0);
        info.island_next = island[(i + 1) % island.len()];
    }
    for &body in island {
        let mut edge = bodies.infos[body as usize].first_contact;
        while edge != NULL {
            let contact = &contacts.records[edge as usize / 2];
            if contact.place != Place::Asleep && !super::pairs::is_awake(bodies, contact) {
                graph.remove(bodies, contacts, edge / 2);
                contacts.records[edge as usize / 2].scale_saved(scale);
            }
            edge = next_edge(&contacts.records, edge);
        }
        list_joints(bodies, joints, body, hinges);
        for &index in hinges.iter() {
            let record = &joints.records[index as usize];
            if record.place != Place::Asleep
                && !bodies.infos[record.body_a as usize].awake
                && !bodies.infos[record.body_b as usize].awake
            {
                joint_graph.remove(bodies, joints, index);
                joints.records[index as usize].scale_saved(scale);
            }
        }
    }
}

/// Wakes a body and its island, and lists the bodies that woke, ascending. Islands that a joint links to it wake
/// with it: they fell asleep before the joint was made. Nothing happens and the list is empty if it is awake or
/// cannot move. Impulses that were kept are multiplied with `scale`. `hinges` is memory.
pub(crate) fn wake(
    index: u32,
    stores: Stores<'_>,
    scale: f32,
    island: &mut Vec<u32>,
    hinges: &mut Vec<u32>,
) {
    let Stores { bodies, contacts, graph, joints, joint_graph } = stores;
    island.clear();
    wake_ring(index, bodies, island);
    let mut next = 0;
    while let Some(&body) = island.get(next) {
        next += 1;
        for (joint, _) in joints.of_body(bodies.infos[body as usize].first_joint) {
            let record = &joints.records[joint as usize];
            let other = record.other(body);
            if record.class().is_some() && bodies.is_dynamic(other) {
                wake_ring(other, bodies, island);
            }
        }
    }
    island.sort_unstable();
    for &body in island.iter() {
        bodies.push_awake(body);
        let mut edge = bodies.infos[body as usize].first_contact;
        while edge != NULL {
            if contacts.records[edge as usize / 2].place == Place::Asleep {
                contacts.records[edge as usize / 2].scale_saved(scale);
                graph.insert(bodies, contacts, edge / 2);
            }
            edge = next_edge(&contacts.records, edge);
        }
        list_joints(bodies, joints, body, hinges);
        for &index in hinges.iter() {
            joint_graph.insert_scaled(bodies, joints, index, scale);
        }
    }
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
        // Those are of the step in which it was last awake.
        (bodies.motions[body as usize], bodies.starts[body as usize]) = Default::default();
        body = core::mem::replace(&mut info.island_next, NULL);
        if body == index || body == NULL {
            break;
        }
    }
}

/// Lists the joints of a body, ascending.
fn list_joints(bodies: &Bodies, joints: &Joints, body: u32, list: &mut Vec<u32>) {
    let first = bodies.infos[body as usize].first_joint;
    list.clear();
    list.extend(joints.of_body(first).map(|(index, _)| index));
    list.sort_unstable();
}
