//! Paces: which islands the solver divides a step more finely for.
//!
//! A soft contact under the force F sinks by `F / (m w^2)`, with its effective mass m and the angular
//! frequency w of its spring, which is bounded by the substep rate. So an island whose contacts would sink
//! visibly gets more substeps, and the sink falls with their square. What a contact carries is known from
//! the last step, and foreseen from the weights of what lies above.
//!
//! Only islands of bounded size are refined, and only up to a budget, so that a step never costs many times
//! what it did before. An island keeps its pace until its strain has fallen to half of what called for it.

use super::islands::{Islands, Stores};
use super::passivity::may_drive;
use crate::describe::BodyKind;
use crate::dynamics::{
    Bodies, Bucket, Graph, JOINTED, JointTree, NULL, PLAIN, Place, PointLanes, REFINEMENT, ROUNDS,
    TreeNode, WATCHED, next_edge, pace_at,
};
use crate::math::Vec2;
use crate::simd::BLOCK;

/// Steps between two looks at all islands.
const INTERVAL: u64 = 8;
/// So many new contacts, if they are a good part of all, are looked at at once: somebody has put in a pile.
const MANY_NEWS: usize = 16;
/// Sink at the plain pace from which an island gets each pace, metres a length unit; from [`LARGE`] bodies on the second.
/// Twice the substeps hold towers of 20 and arches; what leans on many others, as in pyramids, spreads where it sinks.
const VISIBLE: [[f32; JOINTED]; 2] = [[0.0, 0.0008, 0.008, 0.02], [0.0, 0.0008, 0.0024, 0.02]];
/// Bodies from which on an island is large.
const LARGE: usize = 128;
/// Bodies thinner than this tip and pass where others only sink a little: for them the same part of their thickness
/// counts as visible. Length units.
const THIN: f32 = 0.05;
/// No body counts as thinner than this part of that.
const THINNEST: f32 = 0.02;
/// Speed between two bodies below which their contact carries what it will go on carrying, length units a
/// second.
const SETTLED: f32 = 0.05;
/// Speed between two touching bodies above which their island does not become finer.
const LIVELY: f32 = 0.5;
/// Bodies that an island of the finest pace may have.
const MOST_AT_FINEST: usize = 128;
/// What all refined islands may cost together: bodies times additional refinement, for each body that one of
/// them may have.
const BUDGET: usize = 4;

/// How strain is told.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rules {
    pub(crate) gravity: Vec2,
    pub(crate) length_unit: f32,
    /// Square of the angular frequency of contacts at the plain pace.
    pub(crate) omega_squared: f32,
    /// 1 / plain substep length.
    pub(crate) inv_h: f32,
    /// Bodies that a refined island may have.
    pub(crate) most_bodies: usize,
    pub(crate) step: u64,
}

impl Rules {
    /// Factor on a sink of two bodies into each other: more for thin ones, see [`THIN`].
    fn severity(&self, bodies: &Bodies, pair: [u32; 2]) -> f32 {
        let half = pair.map(|body| bodies.infos[body as usize].min_extent);
        let thickness = 2.0 * if half[0] < half[1] { half[0] } else { half[1] };
        let thin = THIN * self.length_unit;
        if thickness < thin { thin / thickness.max(THINNEST * thin) } else { 1.0 }
    }
}

/// Lists that [`assign`] fills anew; kept for their memory.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    islands: Islands,
    found: Vec<Island>,
    /// Height and body, from the highest down.
    order: Vec<(f64, u32)>,
    /// What lies on each body, newtons.
    loads: Vec<f32>,
    below: Vec<u32>,
    changed: Vec<(u32, u8)>,
    moved_contacts: Vec<(u32, usize)>,
    moved_joints: Vec<(u32, usize)>,
}

crate::footprint::footprint!(Memory {
    islands,
    found,
    order,
    loads,
    below,
    changed,
    moved_contacts,
    moved_joints
});

/// Lists the awake bodies that are integrated at a pace: what is not dynamic is at every one.
pub(crate) fn list_bodies(bodies: &Bodies, pace: usize, listed: &mut Vec<u32>) {
    let concerns = |&&i: &&u32| {
        let info = &bodies.infos[i as usize];
        info.kind != BodyKind::Dynamic || usize::from(info.pace) == pace
    };
    listed.clear();
    listed.extend(bodies.awake.iter().filter(concerns));
}

/// Gives every island its pace, where that is due.
pub(crate) fn assign(mut stores: Stores<'_>, rules: Rules, memory: &mut Memory) {
    // Trees count: a world that was loaded has none yet.
    stores.joint_graph.grow_forest(stores.bodies, stores.joints);
    if !is_due(&stores, rules) {
        return;
    }
    memory.islands.find_all(stores.bodies, stores.graph, stores.joints);
    survey(&stores, rules, memory);
    let Memory { islands, found, changed, .. } = memory;
    let mut budget = BUDGET * rules.most_bodies;
    changed.clear();
    for &body in &stores.bodies.awake {
        let root = islands.root(body) as usize;
        if root == body as usize {
            found[root].grant(rules, &mut budget);
        }
        let info = &stores.bodies.infos[body as usize];
        if stores.bodies.is_dynamic(body) && info.pace != found[root].pace {
            changed.push((body, found[root].pace));
        }
    }
    change(&mut stores, memory);
    stores.graph.mixed = false;
    stores.graph.news = 0;
    stores.joint_graph.mixed = false;
}

fn is_due(stores: &Stores<'_>, rules: Rules) -> bool {
    let Stores { bodies, graph, joint_graph, .. } = stores;
    let news = graph.news as usize;
    let many = news >= MANY_NEWS && news > graph.touching_count() / 4;
    let look = rules.step.is_multiple_of(INTERVAL);
    graph.mixed
        || joint_graph.mixed
        || many
        || look
            && (joint_graph.forest.count() > 0
                || news > 0
                || bodies.any_refined()
                || is_any_strained(bodies, graph, rules))
}

/// Would a point between two moving bodies of the plain pace sink visibly?
fn is_any_strained(bodies: &Bodies, graph: &Graph, rules: Rules) -> bool {
    let least = VISIBLE[0][1] * rules.length_unit * rules.omega_squared / rules.inv_h;
    let plain = graph.touching_buckets().take_while(|&(place, _)| pace_at(place) == PLAIN);
    let mut blocks = plain.flat_map(|(_, bucket)| &bucket.constraints);
    blocks.any(|block| {
        let strained = |lane: usize| {
            let over =
                |point: &PointLanes| point.normal_impulse[lane] > least * point.normal_mass[lane];
            over(&block.points[0]) | over(&block.points[1])
        };
        let any = (0..BLOCK).fold(false, |any, lane| any | strained(lane));
        let moves = |lane: usize| {
            bodies.is_dynamic(block.body_a[lane]) && bodies.is_dynamic(block.body_b[lane])
        };
        any && (0..BLOCK).any(|lane| strained(lane) && moves(lane))
    })
}

/// What is known of an island, at the index of its root.
#[derive(Clone, Copy, Debug, Default)]
struct Island {
    bodies: usize,
    /// Greatest pace of its bodies so far; after [`Island::grant`] the pace of all.
    pace: u8,
    /// Greatest sink that its contacts would have at the plain pace, metres.
    strain: f32,
    /// Do two of its bodies that touch pass each other so fast that loads say nothing?
    lively: bool,
    /// Bodies with joints, and joints between two of them that do no work.
    joined: usize,
    joints: usize,
    /// Does anything in it touch something?
    touches: bool,
    /// Does a tree of joints touch something?
    touched: bool,
}

impl Island {
    /// Chooses the pace: the finest that the strain calls for and the bounds allow.
    fn grant(&mut self, rules: Rules, budget: &mut usize) {
        let visible = VISIBLE[usize::from(self.bodies >= LARGE)];
        let wanted = (1..JOINTED).rev().find(|&pace| {
            let keeps = pace <= usize::from(self.pace);
            let least = if keeps { 0.5 } else { 1.0 } * visible[pace] * rules.length_unit;
            self.strain > least && (keeps || !self.lively)
        });
        if self.touched || self.joined > 0 && wanted.is_some() {
            let cost = self.bodies * (ROUNDS[JOINTED] as usize - 1);
            if self.bodies <= rules.most_bodies && cost <= *budget {
                *budget -= cost;
                self.pace = JOINTED as u8;
                return;
            }
        }
        let finest = rules.most_bodies.min(MOST_AT_FINEST);
        let most = |pace| if pace == JOINTED - 1 { finest } else { rules.most_bodies };
        let cost = |pace: usize| self.bodies * (REFINEMENT[pace] as usize - 1);
        let allowed = (1..=wanted.unwrap_or(PLAIN))
            .rev()
            .find(|&pace| self.bodies <= most(pace) && cost(pace) <= *budget);
        // As many joints as bodies close a loop, and no pass solves those at once.
        let looped = self.touches && self.joints > 0 && self.joints >= self.joined;
        let pace = allowed.unwrap_or(if looped { WATCHED } else { PLAIN });
        *budget -= cost(pace);
        self.pace = pace as u8;
    }
}

/// Counts and strains of all islands.
fn survey(stores: &Stores<'_>, rules: Rules, memory: &mut Memory) {
    let Stores { bodies, contacts, graph, joints, joint_graph } = stores;
    let Memory { islands, found, .. } = memory;
    found.resize(bodies.infos.len(), Island::default());
    bodies.awake.iter().for_each(|&body| found[body as usize] = Island::default());
    for &body in bodies.awake.iter().filter(|&&body| bodies.is_dynamic(body)) {
        let island = &mut found[islands.root(body) as usize];
        island.bodies += 1;
        let info = &bodies.infos[body as usize];
        island.pace = island.pace.max(info.pace);
        island.joined += usize::from(info.first_joint != NULL);
    }
    for record in joints.tying().filter(|record| !may_drive(&record.def)) {
        if bodies.is_solved(record.body_a) && bodies.is_solved(record.body_b) {
            found[islands.root(record.body_a) as usize].joints += 1;
        }
    }
    let is_awake = |tree: &JointTree| bodies.infos[tree.nodes[0].body as usize].awake;
    let trees = joint_graph.forest.trees.iter().filter(|tree| !tree.links.is_empty());
    for tree in trees.filter(|tree| is_awake(tree)) {
        let touches = |node: &TreeNode| {
            let mut of_body = contacts.of_body(bodies.infos[node.body as usize].first_contact);
            of_body.any(|(index, _)| contacts.records[index as usize].touching)
        };
        if tree.nodes[..tree.dynamic].iter().any(touches) {
            found[islands.root(tree.nodes[0].body) as usize].touched = true;
        }
    }
    for (place, bucket) in graph.touching_buckets() {
        let refinement = REFINEMENT[pace_at(place)] as f32;
        let scale = refinement * rules.inv_h / rules.omega_squared;
        for slot in 0..bucket.contacts.len() {
            let (a, b) = bucket.bodies(slot);
            let body = if bodies.is_solved(a) { a } else { b };
            if !bodies.is_solved(body) {
                continue;
            }
            let island = &mut found[islands.root(body) as usize];
            island.touches = true;
            if !(bodies.is_solved(a) && bodies.is_solved(b)) || island.bodies > rules.most_bodies {
                continue;
            }
            let speed = (bodies.velocity(b) - bodies.velocity(a)).length();
            island.lively |= speed > LIVELY * rules.length_unit;
            if speed < SETTLED * rules.length_unit {
                let sink = scale * greatest_load(bucket, slot) * rules.severity(bodies, [a, b]);
                island.strain = island.strain.max(sink);
            }
        }
    }
    foresee(stores, rules, memory);
}

/// Greatest impulse of a contact's points over their effective masses, metres a second.
fn greatest_load(bucket: &Bucket, slot: usize) -> f32 {
    let (block, lane) = (slot / BLOCK, slot % BLOCK);
    let load = |k: usize| {
        let point = &bucket.constraints[block].points[k];
        let mass = point.normal_mass[lane];
        if mass > 0.0 { point.normal_impulse[lane] / mass } else { 0.0 }
    };
    load(0).max(load(1))
}

/// Lets weights run down through small islands and notes how far contacts would sink under them.
///
/// From the highest body to the lowest, each hands its weight and what lies on it in equal parts to what it
/// touches below and to bodies that nothing moves. So a pile that has just been put in, whose contacts carry
/// nothing yet, is judged by what they are going to carry.
fn foresee(stores: &Stores<'_>, rules: Rules, memory: &mut Memory) {
    let Stores { bodies, contacts, .. } = stores;
    let Memory { islands, found, order, loads, below, .. } = memory;
    let height = |body: u32| {
        let p = bodies.poses[body as usize].p;
        -(p.x * f64::from(rules.gravity.x) + p.y * f64::from(rules.gravity.y))
    };
    order.clear();
    for &body in bodies.awake.iter().filter(|&&body| bodies.is_dynamic(body)) {
        let island = &found[islands.root(body) as usize];
        // A lively one stays at the plain pace whatever lies on what.
        let matters = !island.lively || usize::from(island.pace) != PLAIN;
        if matters && (2..=rules.most_bodies).contains(&island.bodies) {
            order.push((height(body), body));
        }
    }
    order.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    loads.resize(bodies.infos.len(), 0.0);
    bodies.awake.iter().for_each(|&body| loads[body as usize] = 0.0);
    for &(top, body) in order.iter() {
        let info = &bodies.infos[body as usize];
        below.clear();
        below.extend(contacts.of_body(info.first_contact).filter_map(|(index, side)| {
            let contact = &contacts.records[index as usize];
            let other = if side == 0 { contact.body_b } else { contact.body_a };
            let lower = !bodies.is_dynamic(other) || height(other) < top;
            (contact.touching && lower).then_some(other)
        }));
        let weight = info.mass * info.gravity_scale.abs() * rules.gravity.length();
        let share = (weight + loads[body as usize]) / below.len().max(1) as f32;
        let inverse_mass = bodies.inverse_masses(body).0;
        for &other in below.iter().filter(|&&other| bodies.is_solved(other)) {
            loads[other as usize] += share;
            let compliance = (inverse_mass + bodies.inverse_masses(other).0) / rules.omega_squared;
            let island = &mut found[islands.root(body) as usize];
            let sink = share * compliance * rules.severity(bodies, [body, other]);
            island.strain = island.strain.max(sink);
        }
    }
}

/// Moves bodies to other paces, and what hangs on them.
fn change(stores: &mut Stores<'_>, memory: &mut Memory) {
    let Stores { bodies, contacts, graph, joints, joint_graph } = stores;
    let Memory { changed, moved_contacts, moved_joints, .. } = memory;
    moved_contacts.clear();
    moved_joints.clear();
    for &(body, _) in changed.iter() {
        let mut edge = bodies.infos[body as usize].first_contact;
        while edge != NULL {
            let contact = &contacts.records[edge as usize / 2];
            if let (true, Place::Graph { colour, .. }) = (contact.touching, contact.place) {
                graph.remove(bodies, contacts, edge / 2);
                moved_contacts.push((edge / 2, pace_at(colour.into())));
            }
            edge = next_edge(&contacts.records, edge);
        }
        let mut edge = bodies.infos[body as usize].first_joint;
        while edge != NULL {
            let joint = &joints.records[edge as usize / 2];
            if let Place::Graph { .. } = joint.place {
                let pace = joint_graph.pace_of(joint);
                joint_graph.remove(bodies, joints, edge / 2);
                moved_joints.push((edge / 2, pace));
            }
            edge = next_edge(&joints.records, edge);
        }
    }
    for &(body, pace) in changed.iter() {
        bodies.set_pace(body, pace);
    }
    moved_contacts.sort_unstable();
    for &(index, old) in moved_contacts.iter() {
        let contact = &mut contacts.records[index as usize];
        let scale = rescale(old, bodies.common_pace(contact.body_a, contact.body_b));
        for point in &mut contact.saved {
            point.normal_impulse *= scale;
            point.tangent_impulse *= scale;
        }
        graph.insert(bodies, contacts, index);
    }
    moved_joints.sort_unstable();
    for &(index, old) in moved_joints.iter() {
        let record = &mut joints.records[index as usize];
        let scale = rescale(old, bodies.common_pace(record.body_a, record.body_b));
        record.scale_saved(scale);
        joint_graph.insert(bodies, joints, index);
    }
}

/// Impulses go with the length of a substep.
fn rescale(old: usize, new: usize) -> f32 {
    REFINEMENT[old] as f32 / REFINEMENT[new] as f32
}
