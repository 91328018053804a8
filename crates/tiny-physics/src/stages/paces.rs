//! Paces: which islands the solver divides a step more finely for.
//!
//! A soft contact under the force F sinks by `F / (m w^2)`, with its effective mass m and the angular
//! frequency w of its spring, which is bounded by the substep rate. So an island whose contacts would sink
//! visibly gets more substeps, and the sink falls with their square. What a contact carries is known from
//! the last step, and foreseen from the weights of what lies above.
//!
//! Only islands of bounded size are refined, and only up to a budget, so that a step never costs many times
//! what it did before. An island keeps its pace until its strain has fallen to half of what called for it, or until
//! it has settled: then it goes back step by step, and its contacts get [rests](super::rests).

use super::islands::{Islands, Stores};
use super::passivity::may_drive;
use super::rests::{Compliance, Sink, is_calm};
use super::rocking;
use crate::describe::{BodyKind, JointKind};
use crate::dynamics::{
    Bodies, Bucket, Contacts, Graph, JOINTED, JointClass, JointGraph, JointRecord, NULL, PLAIN,
    Place, PointLanes, REFINEMENT, ROUNDS, STRUCK, WATCHED, next_edge, pace_at,
};
use crate::math::Vec2;
use crate::simd::BLOCK;
use crate::work;

/// Steps between two looks at all islands.
const INTERVAL: u64 = 8;
/// So many new contacts, if they are a good part of all, are looked at at once: somebody has put in a pile.
const MANY_NEWS: usize = 16;
/// Sink at the plain pace from which an island gets each pace, metres a length unit; from [`LARGE`] bodies on the second.
/// Twice the substeps hold towers of 20 and arches; what leans on many others, as in pyramids, spreads where it sinks.
const VISIBLE: [[f32; JOINTED]; 2] = [[0.0, 0.0008, 0.008, 0.02], [0.0, 0.0008, 0.0024, 0.02]];
/// Greatest sink at a pace that rests may stand for, length units.
const MOST_AT_REST: f32 = 0.008;
/// Bodies from which on an island is large.
const LARGE: usize = 128;
/// Bodies thinner than this tip and pass where others only sink a little: for them the same part of their thickness
/// counts as visible. Length units.
const THIN: f32 = 0.05;
/// No body counts as thinner than this part of that.
const THINNEST: f32 = 0.02;
/// A body bears another whose middle is higher by this part of the lesser half thickness: what is beside it does not.
const LOWER: f32 = 0.025;
/// Speed between two bodies below which their contact carries what it will go on carrying, length units a
/// second.
const SETTLED: f32 = 0.05;
/// Speed between two touching bodies above which their island is stirred: it does not become finer.
const LIVELY: f32 = 0.5;
/// Nor does it for so many seconds after, unless it would sink far: what has tumbled into place has sunk where nobody could see
/// it, by 4 to 10 mm in piles of 100 to 300, and sleeps before that. What sinks after it was built is seen, all of it.
const STIRRED_TIME: f32 = 2.0;
/// Joined bodies of which one is hit so fast that it would go by its half thickness in a plain substep are solved more finely for
/// so many seconds: what hits a limb or a plank is stopped by it and by all that hangs on it in turns.
const STRUCK_TIME: f32 = 0.25;
/// An island hangs if joints hold up more than this part of what pulls at its bodies. Only what does not becomes finer for
/// what its contacts bear: slack bridges under loads of 10, 30 and 100 planks would swing on at .15, .43 and .81 m/s in place of
/// .07, 0 and .06. What a gripper squeezes with counts as pull, and what it lifts is less. Nor does one in which a joint is
/// out of place or pulls more than all that: more stiffly, what it crushes would shoot out.
const HANGS: f32 = 0.4;
/// From so far on a joint is out of place, length units.
const OUT_OF_PLACE: f32 = 0.05;
/// A contact carries no more than this many times what pulls at all bodies of its island: wedges and levers do. What it pushes
/// with beyond that holds something in that is squeezed; more stiffly, that would shoot out. Of 100 triples of U-shaped bodies put
/// into each other 28 went off faster than 8 m/s, with this one.
const MOST_CARRIED: f32 = 2.0;
/// What bears something so many times its mass counts as half as heavy, see [`squeezed`](super::ahead).
const LADEN: f32 = 250.0;
/// What has its least extent beyond this part of its greatest one is round: it rolls, as its own inertia says.
const ROUND: f32 = 0.9;
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
    pub(crate) compliance: Compliance,
    /// Length of a plain substep, seconds.
    pub(crate) h: f32,
    /// Bodies that a refined island may have.
    pub(crate) most_bodies: usize,
    pub(crate) step: u64,
}

impl Rules {
    /// How far two bodies would sink into each other at the plain pace under a force, newtons; what is thin more gravely.
    fn sink(&self, bodies: &Bodies, [a, b]: [u32; 2], force: f32) -> f32 {
        let inverse_mass = bodies.inverse_masses(a).0 + bodies.inverse_masses(b).0;
        force * (inverse_mass * self.compliance.moving * self.h) * self.severity(bodies, [a, b])
    }

    /// Factor on a sink of two bodies into each other: more for thin ones, see [`THIN`].
    fn severity(&self, bodies: &Bodies, pair: [u32; 2]) -> f32 {
        let thickness = 2.0 * bodies.thinner_half(pair);
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
    /// Inverse mass of the heaviest of that.
    heaviests: Vec<f32>,
    /// Which of the laden ones stand on static ground, through others of them.
    stands: Vec<bool>,
    below: Vec<u32>,
    changed: Vec<(u32, u8)>,
    /// With their paces, and what they carry.
    moved_contacts: Vec<(u32, usize, [Sink; 2])>,
    moved_joints: Vec<(u32, usize)>,
}

crate::footprint::footprint!(Memory {
    islands,
    found,
    order,
    loads,
    heaviests,
    stands,
    below,
    changed,
    moved_contacts,
    moved_joints
});

/// Notes a hit of two bodies that begin to touch: their islands are stirred, or even struck. Is that a reason to look at paces at once?
/// `h` is the length of a plain substep.
pub(crate) fn stir(bodies: &mut Bodies, pair: [u32; 2], length_unit: f32, h: f32) -> bool {
    let [a, b] = pair.map(|body| bodies.velocity(body));
    let speed = (b - a).length();
    let stirred = pair.iter().any(|&body| bodies.infos[body as usize].stirred > 0.0);
    let mut urgent = !stirred && is_uneven(bodies, pair);
    for body in pair.into_iter().filter(|_| speed > LIVELY * length_unit) {
        let info = &mut bodies.infos[body as usize];
        let struck = info.first_joint != NULL && speed * h > info.min_extent;
        let time = if struck { STIRRED_TIME + STRUCK_TIME } else { STIRRED_TIME };
        if info.kind == BodyKind::Dynamic {
            info.stirred = info.stirred.max(time);
            urgent |= struck && usize::from(info.pace) == JOINTED;
        }
    }
    urgent
}

/// Does a body count as half as heavy as what lies on it, as their inverse masses say?
fn is_laden(light: f32, heavy: f32) -> bool {
    light > LADEN * heavy && heavy > 0.0
}

/// May one of two bodies be laden with the other?
fn is_uneven(bodies: &Bodies, pair: [u32; 2]) -> bool {
    let [a, b] = pair.map(|body| bodies.inverse_masses(body).0);
    is_laden(a.max(b), a.min(b))
}

/// Lists the awake bodies that are integrated at a pace: what is not dynamic is at the plain one and, where it may touch
/// something or is joined to it, at every one.
pub(crate) fn list_bodies(bodies: &Bodies, pace: usize, listed: &mut Vec<u32>) {
    let concerns = |&&i: &&u32| {
        let info = &bodies.infos[i as usize];
        let joins_in = pace == PLAIN || info.first_contact != NULL || info.first_joint != NULL;
        if info.kind == BodyKind::Dynamic { usize::from(info.pace) == pace } else { joins_in }
    };
    listed.clear();
    listed.extend(bodies.awake.iter().filter(concerns).inspect(|_| work::note()));
}

/// Gives every island its pace, where that is due.
pub(crate) fn assign(mut stores: Stores<'_>, rules: Rules, memory: &mut Memory) {
    if !is_due(&stores, rules) {
        return;
    }
    memory.islands.find_all(stores.bodies, stores.graph, stores.joints);
    survey(&stores, rules, memory);
    let Memory { islands, found, changed, .. } = memory;
    let mut budget = BUDGET.saturating_mul(rules.most_bodies);
    changed.clear();
    // All before any is told: what has just woken is listed last, and may be a root.
    for &body in stores.bodies.awake.iter().filter(|&&body| islands.root(body) == body) {
        found[body as usize].grant(rules, &mut budget);
    }
    for i in 0..stores.bodies.awake.len() {
        let body = stores.bodies.awake[i];
        let root = islands.root(body) as usize;
        let info = &mut stores.bodies.infos[body as usize];
        if found[root].lively {
            info.stirred = info.stirred.max(STIRRED_TIME);
        }
        if info.kind == BodyKind::Dynamic && info.pace != found[root].pace {
            changed.push((body, found[root].pace));
        }
    }
    list_laden(&mut stores, rules, memory);
    change(&mut stores, rules, memory);
    stores.graph.mixed = false;
    stores.graph.news = 0;
    stores.joint_graph.mixed = false;
}

fn is_due(stores: &Stores<'_>, rules: Rules) -> bool {
    let Stores { bodies, graph, joint_graph, .. } = stores;
    let news = graph.news as usize;
    let many = news >= MANY_NEWS && news > graph.touching_count() / 4;
    let is_any_restless = || bodies.awake.iter().any(|&body| rocking::is_restless(bodies, body));
    let kept = || bodies.any_refined() || !bodies.laden.is_empty();
    graph.mixed
        || joint_graph.mixed
        || many
        || rules.step.is_multiple_of(INTERVAL)
            && (news > 0 || kept() || is_any_restless() || is_any_strained(bodies, graph, rules))
}

/// Would a point between two moving bodies of the plain pace sink visibly?
fn is_any_strained(bodies: &Bodies, graph: &Graph, rules: Rules) -> bool {
    let (least, compliance) = (VISIBLE[0][1] * rules.length_unit, rules.compliance.moving);
    let plain = graph.touching_buckets().take_while(|&(place, _)| pace_at(place) == PLAIN);
    let mut blocks = plain.flat_map(|(_, bucket)| bucket.constraints.iter().zip(&bucket.surfaces));
    blocks.any(|(block, surface)| {
        let strained = |lane: usize| {
            let [first, second] = &block.points;
            let over = |impulse, mass, rest| compliance * impulse > (least + rest) * mass;
            over(first.normal_impulse[lane], first.normal_mass[lane], surface.rest_1[lane])
                | over(second.normal_impulse[lane], second.normal_mass[lane], surface.rest_2[lane])
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
    /// Weights of its bodies and what else pulls at them, what joints drive with too, newtons.
    weight: f32,
    /// Weights that no contact bears in the end, nor a hinge or weld to something fixed.
    hung: f32,
    /// Greatest force that a joint holds with, newtons; without bound where one is out of place.
    tie: f32,
    /// Greatest pace of its bodies so far; after [`Island::grant`] the pace of all.
    pace: u8,
    /// Greatest sink that its contacts would have at the plain pace, metres.
    sink: f32,
    /// The same but for what rests.
    strain: f32,
    /// Do two of its bodies that touch pass each other so fast that loads say nothing?
    lively: bool,
    /// Did they lately?
    stirred: bool,
    /// Was a joined body of it hit hard just now?
    struck: bool,
    /// Bodies with joints, and joints between two of them that do no work.
    joined: usize,
    joints: usize,
    /// Does a joint hold one of them to what is none of it?
    hangs: bool,
    /// Does anything in it touch something?
    touches: bool,
    /// Do two of its bodies hold each other in?
    tangled: bool,
    /// Does a body of it turn to and fro without a rest?
    restless: bool,
    /// Does a body of it touch one that is so much lighter that this may be laden?
    uneven: bool,
}

impl Island {
    /// May it rest at a pace? Not where loads are so great that contacts would be springs.
    fn bears(&self, pace: usize, rules: Rules) -> bool {
        let refinement = REFINEMENT[pace] as f32;
        self.sink <= MOST_AT_REST * rules.length_unit * refinement * refinement
    }

    /// The pace to which an island that settles may go back: one step at a time.
    fn slowest(&self, rules: Rules) -> Option<usize> {
        let now = usize::from(self.pace);
        let slowest = if now > PLAIN && self.bears(now - 1, rules) { now - 1 } else { now };
        (now < JOINTED && slowest != PLAIN).then_some(slowest)
    }

    /// Chooses the pace: the finest that the strain calls for and the bounds allow.
    fn grant(&mut self, rules: Rules, budget: &mut usize) {
        let visible = VISIBLE[usize::from(self.bodies >= LARGE)];
        let wanted = (1..JOINTED).rev().find(|&pace| {
            // Those of joined bodies come after the refined ones.
            let keeps = (pace..JOINTED).contains(&usize::from(self.pace));
            let least = if keeps { 0.5 } else { 1.0 } * visible[pace] * rules.length_unit;
            let waits = self.lively
                || self.stirred && self.strain < visible[JOINTED - 1] * rules.length_unit;
            self.strain > least && (keeps || !waits)
        });
        if self.joined > 0 && self.touches {
            let keeps = usize::from(self.pace) == STRUCK && !self.bears(JOINTED, rules);
            let hung = self.hangs && self.hung > HANGS * self.weight;
            let finer =
                self.struck || !hung && self.tie <= self.weight && (wanted.is_some() || keeps);
            for pace in if finer { [STRUCK, JOINTED] } else { [JOINTED; 2] } {
                let cost = self.bodies * ((REFINEMENT[pace] * ROUNDS[pace]) as usize - 1);
                if self.bodies <= rules.most_bodies && cost <= *budget {
                    *budget -= cost;
                    self.pace = pace as u8;
                    return;
                }
            }
        }
        if self.restless && !self.stirred && self.bodies <= rules.most_bodies.min(*budget) {
            *budget -= self.bodies;
            self.pace = JOINTED as u8;
            return;
        }
        let most = |pace| if pace == JOINTED - 1 { MOST_AT_FINEST } else { usize::MAX };
        let cost = |pace: usize| self.bodies * (REFINEMENT[pace] as usize - 1);
        let allowed = (1..=wanted.max(self.slowest(rules)).unwrap_or(PLAIN)).rev().find(|&pace| {
            self.bodies <= most(pace).min(rules.most_bodies) && cost(pace) <= *budget
        });
        // As many joints as bodies close a loop, and no pass solves those at once.
        let looped = self.touches && self.joints > 0 && self.joints >= self.joined;
        let coarse = if looped { WATCHED } else { PLAIN };
        let pace = allowed.map_or(coarse, |pace| if self.tangled { WATCHED } else { pace });
        *budget -= cost(pace);
        self.pace = pace as u8;
    }
}

/// Counts and strains of all islands.
fn survey(stores: &Stores<'_>, rules: Rules, memory: &mut Memory) {
    let Stores { bodies, graph, joints, joint_graph, .. } = stores;
    let Memory { islands, found, .. } = memory;
    found.resize(bodies.infos.len(), Island::default());
    bodies.awake.iter().for_each(|&body| found[body as usize] = Island::default());
    for &body in bodies.awake.iter().filter(|&&body| bodies.is_dynamic(body)) {
        let island = &mut found[islands.root(body) as usize];
        island.bodies += 1;
        let info = &bodies.infos[body as usize];
        island.weight += (rules.gravity * (info.gravity_scale * info.mass) + info.force).length();
        island.pace = island.pace.max(info.pace);
        island.stirred |= info.stirred > 0.0;
        island.struck |= info.stirred > STIRRED_TIME;
        island.joined += usize::from(joints.act_on(info.first_joint));
        island.restless |= rocking::is_restless(bodies, body);
    }
    for record in joints.tying() {
        let solved = [record.body_a, record.body_b].map(|body| bodies.is_solved(body));
        let body = if solved[0] { record.body_a } else { record.body_b };
        if !solved.contains(&true) {
            continue;
        }
        let island = &mut found[islands.root(body) as usize];
        island.hangs |= solved.contains(&false);
        island.joints += usize::from(solved == [true; 2] && !may_drive(&record.def));
        let [drives, holds] = forces(joint_graph, record, rules);
        island.weight += drives;
        let out = record.off(bodies) > OUT_OF_PLACE * rules.length_unit;
        island.tie = if out { f32::INFINITY } else { island.tie.max(holds) };
    }
    for (place, bucket) in graph.touching_buckets() {
        let pace = pace_at(place);
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
            island.tangled |= is_tangled(bodies, bucket, slot);
            island.uneven |= is_uneven(bodies, [a, b]);
            if speed < SETTLED * rules.length_unit {
                let severity = rules.severity(bodies, [a, b]);
                let most = rules.sink(bodies, [a, b], MOST_CARRIED * island.weight);
                let [first, second] = Sink::of(bucket, slot, pace, rules.compliance, bodies);
                island.sink = island.sink.max(most.min(severity * first.full.max(second.full)));
                // What has settled at a finer pace rests when it leaves it.
                if REFINEMENT[pace] == 1 || !(is_calm(bodies, a) && is_calm(bodies, b)) {
                    let open = severity * first.open(pace).max(second.open(pace));
                    island.strain = island.strain.max(most.min(open));
                }
            }
        }
    }
    foresee(stores, rules, memory);
}

/// What a joint drives and what it holds with, newtons. By its impulses alone: their directions are in no frame.
fn forces(graph: &JointGraph, record: &JointRecord, rules: Rules) -> [f32; 2] {
    let rate = REFINEMENT[graph.pace_of(record)] as f32 / rules.h;
    let [a, b, c, d, e, f] = graph.impulses(record);
    let parts = match record.class() {
        Some(JointClass::Distance) => [Vec2::new(b + c, 0.0), Vec2::new(a + d - e, 0.0)],
        Some(JointClass::Slider) => [Vec2::new(c + d, 0.0), Vec2::new(a, e - f)],
        Some(JointClass::Drive) => [Vec2::new(a + d, b + e), Vec2::ZERO],
        Some(JointClass::Gear) | None => [Vec2::ZERO; 2],
        Some(_) if may_drive(&record.def) => [Vec2::new(a, b), Vec2::ZERO],
        Some(_) => [Vec2::ZERO, Vec2::new(a, b)],
    };
    parts.map(|impulse| impulse.length() * rate)
}

/// Do the two bodies of a contact overlap by more than the thinner half thickness? They may be held in by each other then, as U-shapes
/// are with contacts on both sides of a web. What these push with is no load, and stiffer ones shoot the bodies out: of 400
/// crowds of up to nine such bodies 46 went off at more than 8 m/s, two at the plain pace.
fn is_tangled(bodies: &Bodies, bucket: &Bucket, slot: usize) -> bool {
    let (block, lane) = (&bucket.constraints[slot / BLOCK], slot % BLOCK);
    let least = -bodies.thinner_half(bucket.bodies(slot).into());
    let is_in = |p: &PointLanes| p.normal_mass[lane] > 0.0 && p.separation[lane] < least;
    block.points.iter().any(is_in)
}

/// Lets weights run down through small islands and notes how far contacts would sink under them.
///
/// From the highest body to the lowest, each hands its weight and what lies on it in equal parts to what it
/// touches below and to bodies that nothing moves. So a pile that has just been put in, whose contacts carry
/// nothing yet, is judged by what they are going to carry.
fn foresee(stores: &Stores<'_>, rules: Rules, memory: &mut Memory) {
    let Stores { bodies, contacts, joints, .. } = stores;
    let Memory { islands, found, order, loads, heaviests, below, .. } = memory;
    let up = -rules.gravity.normalized();
    let height = |body: u32| {
        let p = bodies.poses[body as usize].p;
        p.x * f64::from(up.x) + p.y * f64::from(up.y)
    };
    order.clear();
    for &body in bodies.awake.iter().filter(|&&body| bodies.is_dynamic(body)) {
        let island = &found[islands.root(body) as usize];
        // A lively one stays at the plain pace whatever lies on what.
        let matters = !island.lively || island.uneven || usize::from(island.pace) != PLAIN;
        if matters && (2..=rules.most_bodies).contains(&island.bodies) {
            order.push((height(body), body));
        }
    }
    order.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    loads.resize(bodies.infos.len(), 0.0);
    bodies.awake.iter().for_each(|&body| loads[body as usize] = 0.0);
    heaviests.resize(bodies.infos.len(), 0.0);
    bodies.awake.iter().for_each(|&body| heaviests[body as usize] = f32::INFINITY);
    for &(top, body) in order.iter() {
        let info = &bodies.infos[body as usize];
        below.clear();
        below.extend(contacts.of_body(info.first_contact).filter_map(|(index, _)| {
            let contact = &contacts.records[index as usize];
            let other = contact.other(body);
            let step = || LOWER * bodies.thinner_half([body, other]);
            let lower = || !bodies.is_dynamic(other) || top - height(other) > f64::from(step());
            (contact.touching && lower()).then_some(other)
        }));
        let weight = info.mass * info.gravity_scale.abs() * rules.gravity.length();
        let load = weight + loads[body as usize];
        let is_pin = |(index, _)| {
            let record = &joints.records[index as usize];
            let pins =
                matches!(record.def.kind, JointKind::Revolute { .. } | JointKind::Weld { .. });
            let stays = !bodies.is_solved(record.other(body));
            pins && stays && record.def.enabled && !may_drive(&record.def)
        };
        if below.is_empty() && !joints.of_body(info.first_joint).any(is_pin) {
            found[islands.root(body) as usize].hung += load;
        }
        let share = load / below.len().max(1) as f32;
        let heaviest = heaviests[body as usize].min(bodies.inverse_masses(body).0);
        for &other in below.iter().filter(|&&other| bodies.is_solved(other)) {
            loads[other as usize] += share;
            heaviests[other as usize] = heaviests[other as usize].min(heaviest);
            if is_calm(bodies, body) && is_calm(bodies, other) {
                continue;
            }
            let island = &mut found[islands.root(body) as usize];
            island.strain = island.strain.max(rules.sink(bodies, [body, other], share));
        }
    }
}

/// Lists the light bodies that heavy ones lie on, on static ground.
fn list_laden(stores: &mut Stores<'_>, rules: Rules, memory: &mut Memory) {
    let Stores { bodies, contacts, .. } = stores;
    let Memory { order, loads, heaviests, stands, .. } = memory;
    let before = core::mem::take(&mut bodies.laden);
    stands.clear();
    stands.resize(bodies.infos.len(), false);
    for &(_, body) in order.iter().rev() {
        let by = heaviests[body as usize].max(rules.gravity.length() / loads[body as usize]);
        if !is_laden(bodies.inverse_masses(body).0, by) {
            continue;
        }
        let info = &bodies.infos[body as usize];
        let bears = |(index, _): (u32, u32)| {
            let contact = &contacts.records[index as usize];
            let other = contact.other(body) as usize;
            let is_firm = stands[other] || bodies.infos[other].kind == BodyKind::Static;
            contact.touching && is_firm
        };
        stands[body as usize] = info.min_extent < ROUND * info.max_extent
            && info.first_joint == NULL
            && contacts.of_body(info.first_contact).any(bears);
        let is_known = || before.binary_search_by_key(&body, |&(laden, _)| laden).is_ok();
        let begins = || is_still(bodies, contacts, body, SETTLED * rules.length_unit);
        if stands[body as usize] && (is_known() || begins()) {
            bodies.laden.push((body, by));
        }
    }
    bodies.laden.sort_unstable_by_key(|&(body, _)| body);
}

/// Are a body and all near it slower than this, turning included?
pub(crate) fn is_still(bodies: &Bodies, contacts: &Contacts, body: u32, most: f32) -> bool {
    let is_slow = |body: u32| {
        let turn = bodies.angular_velocity(body) * bodies.infos[body as usize].max_extent;
        bodies.velocity(body).length() + turn.abs() < most
    };
    let mut near = contacts.of_body(bodies.infos[body as usize].first_contact);
    is_slow(body) && near.all(|(index, _)| is_slow(contacts.records[index as usize].other(body)))
}

/// Moves bodies to other paces, and what hangs on them.
fn change(stores: &mut Stores<'_>, rules: Rules, memory: &mut Memory) {
    let Stores { bodies, contacts, graph, joints, joint_graph } = stores;
    let Memory { changed, moved_contacts, moved_joints, .. } = memory;
    moved_contacts.clear();
    moved_joints.clear();
    for &(body, _) in changed.iter() {
        let mut edge = bodies.infos[body as usize].first_contact;
        while edge != NULL {
            let contact = &contacts.records[edge as usize / 2];
            if let (true, Place::Graph { colour, slot }) = (contact.touching, contact.place) {
                let pace = pace_at(colour.into());
                let bucket = graph.bucket_mut(colour.into(), contact.class);
                let sinks = Sink::of(bucket, slot as usize, pace, rules.compliance, bodies);
                graph.remove(bodies, contacts, edge / 2);
                moved_contacts.push((edge / 2, pace, sinks));
            }
            edge = next_edge(&contacts.records, edge);
        }
        let mut edge = bodies.infos[body as usize].first_joint;
        while edge != NULL {
            let joint = &joints.records[edge as usize / 2];
            if let Place::Graph { .. } = joint.place {
                let pace = joint_graph.pace_of(joint);
                joint_graph.lift(bodies, joints, edge / 2);
                moved_joints.push((edge / 2, pace));
            }
            edge = next_edge(&joints.records, edge);
        }
    }
    for &(body, pace) in changed.iter() {
        bodies.set_pace(body, pace);
    }
    moved_contacts.sort_unstable_by_key(|&(index, ..)| index);
    for &(index, old, sinks) in moved_contacts.iter() {
        let contact = &mut contacts.records[index as usize];
        let new = bodies.common_pace(contact.body_a, contact.body_b);
        contact.scale_saved(rescale(old, new));
        for (point, sink) in contact.saved.iter_mut().zip(sinks) {
            point.rest = sink.rest_at(new);
        }
        graph.insert(bodies, contacts, index);
    }
    moved_joints.sort_unstable();
    for &(index, old) in moved_joints.iter() {
        let record = &mut joints.records[index as usize];
        let scale = rescale(old, bodies.common_pace(record.body_a, record.body_b));
        record.scale_saved(scale);
        joint_graph.put_back(bodies, joints, index);
    }
}

/// Impulses go with the length of a substep.
fn rescale(old: usize, new: usize) -> f32 {
    REFINEMENT[old] as f32 / REFINEMENT[new] as f32
}
