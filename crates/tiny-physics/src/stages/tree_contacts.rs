//! Contacts of trees of joints: what touches one body of a tree feels all of it.
//!
//! Contacts and trees in turns agree slowly where something heavy lies on a light plank of a bridge: a contact that
//! sees the plank alone is content with a small impulse, and the next solve of the tree pulls the plank back against
//! the load. Here the impulse of a contact goes through the tree at once. With the masses M, Jacobians J and compliance
//! S of the tree, its answer to impulses is
//!
//! ```text
//! P = M^-1 - M^-1 J^T (J M^-1 J^T + S)^-1 J M^-1
//! ```
//!
//! of which the columns of the bodies that are touched come out of the elimination, three solves of the tree each. A
//! contact with Jacobian c has the effective mass `1 / (c P c^T)`, the part of what is no tree's added, and its impulse
//! dl changes velocities by `P c^T dl`: Gauss-Seidel on the true masses, which leaves the joints as they are.
//!
//! Trees of several joints with motors that run keep their contacts in lanes: a leg that they hold stiff would feel as if it hung loose. So
//! does one joint whose motor turns its body so fast that contacts are found anew on the way ([`super::arcs`]), which only lanes can be: of
//! 300 flippers that are set going at 8 to 60 rad/s 25 went through a ball. Brakes, motors without speed, may be overcome, and springs
//! are soft beside contacts: what rests on the stops of its springs hangs on to these.
//!
//! These contacts are taken out of their lanes for the length of the substeps, and put back with their impulses.

use super::arcs::Arcs;
use super::contact_solver::{Constants, Parameters, Pass, normal_impulse};
use super::islands::Stores;
use super::joint_solver::trees;
use super::passivity::may_drive;
use crate::describe::{JointDef, Motor};
use crate::dynamics::{Bucket, JointTree, Joints, NULL, Slot, flags, give_along, inverses};
use crate::simd::{BLOCK, FourKernel, Lanes, Row, Simd, SimdLevel, dispatch_fours};

/// Numbers that the answers of a tree may have: touched bodies times bodies. Others stay with the lanes.
const MOST_ANSWERS: usize = 1024;
/// Numbers of a column that are worked on together.
const CHUNK: usize = 8;
/// A contact counts as no heavier than so many times its two bodies alone. Along a taut rope a tree hardly gives way; with the
/// true mass there, old impulses on arms that have turned hurl it about. In 231 random worlds with joints the deepest overlaps
/// add up to 6.0 m with 5, 6.2 with 2.5, joints' gaps to 3.8, 3.9, and 5.2 with 50 (trees with motors among them, which are
/// left to the lanes since). In trees with brakes it is the two bodies alone, since the elimination knows nothing of them:
/// 24 links over an edge with rubbing hinges and 1 kg swing on at 13 mm/s with 2.5, at 0.5 with 1. In lanes 5 to 30 kg went on jumping at
/// 10 to 160 mm/s, and of 205 random worlds with brakes in their hinges bodies that pass were 72 in place of 23, gaps 2.7 m in place of 1.7.
const HEAVIEST: f32 = 2.5;
/// The same in trees with springs, whose islands may gain energy (see [`super::passivity`]): of 120 cars of 10 to 300 times their wheels' mass,
/// many with their brakes on, at rest on the stops of their springs 18 shake with 2.5, none with 5.
const SPRUNG: f32 = 5.0;
/// A contact between a body on one joint and what cannot move counts as so many times its mass at most, however near to the hinge it is.
const UNBOUNDED: f32 = 1e6;

/// The mass of a tree that hangs on nothing; of one body on one joint, which gives way about the longer arm, as much as may be. Chains that a
/// hand drags against a wall are hurled about by more than a few times their links.
fn bears(tree: &JointTree) -> f32 {
    let (bodies, anchors) = tree.nodes.split_at(tree.dynamic);
    let mass = bodies.iter().map(|node| 1.0 / node.inv[0].max(node.inv[1])).sum::<f64>() as f32;
    match (bodies.len(), anchors.is_empty()) {
        (1, _) => UNBOUNDED * mass,
        (_, true) => mass,
        _ => 0.0,
    }
}

/// Along x, along y, and about the middle.
type Planar = [f32; 3];

/// An angular impulse, on A and on B.
const ABOUT: [Planar; 2] = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];

/// The answers of a tree to impulses on its touched bodies.
#[derive(Debug, Default)]
struct Answers {
    tree: u32,
    bodies: Vec<u32>,
    /// Nodes that something touches.
    touched: Vec<u32>,
    /// For each of them a column per impulse along x, y and about the middle: changes of velocity body by body.
    columns: Vec<f32>,
    /// Where the velocities of the bodies are, which are as long as a column.
    span: Span,
    /// The limits that held then.
    limits: Vec<i8>,
    /// Contacts with what cannot move may count as that, kilograms: as all of a tree, where joints that are out of place pull at it.
    bears: f32,
}

/// Where numbers begin, and how many.
type Span = (u32, u32);

/// Which answers are of a body's tree, and its place among the touched nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct OfTree {
    answers: u32,
    /// Where its velocity is among those of the tree.
    at: u32,
    touched: u32,
    /// Velocities of the tree.
    span: Span,
    /// It has brakes, springs; see [`HEAVIEST`].
    braked: bool,
    sprung: bool,
}

/// A contact of a tree, by bucket in the graph's list and slot in it, and which of its bodies is the tree's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Found {
    at: (usize, usize),
    side: usize,
    of_tree: OfTree,
}

/// One of the two bodies of a contact.
#[derive(Clone, Copy, Debug)]
struct Side {
    body: u32,
    of_tree: Option<OfTree>,
    /// Later substeps warm start it here.
    jointed: bool,
    /// Nothing moves it.
    fixed: bool,
    /// Inverse masses in this pass, where it is by itself.
    inverse: Planar,
}

/// Along which a contact pushes.
#[derive(Clone, Copy, Debug, Default)]
struct Line {
    /// On A and on B.
    on: [Planar; 2],
    /// Effective mass of the two bodies alone, and with all that hangs on them.
    alone: f32,
    mass: f32,
    /// Where the answers of their trees to an impulse of one on A, and on B, begin.
    answers: [u32; 2],
}

#[derive(Clone, Copy, Debug, Default)]
struct Point {
    there: bool,
    /// At the start of the step, and now.
    separation: f32,
    now: f32,
    /// See [`super::rests`]: for the two bodies alone.
    rest: f32,
    normal: Line,
    tangent: Line,
    impulse: f32,
    rub: f32,
    load: f32,
    total: f32,
}

/// A contact with a body of a tree.
#[derive(Clone, Copy, Debug)]
struct Touch {
    at: (usize, usize),
    sides: [Side; 2],
    friction: f32,
    belt: f32,
    rolling: f32,
    about: Line,
    rolling_impulse: f32,
    hit: bool,
    points: [Point; 2],
}

/// The contacts of trees of a pace. Found anew each step; kept for its memory.
#[derive(Debug, Default)]
pub(crate) struct TreeContacts {
    answers: Vec<Answers>,
    used: usize,
    found: Vec<Found>,
    touches: Vec<Touch>,
    /// Velocities of the bodies of the trees during a pass.
    velocities: Vec<f32>,
    /// What an impulse of one along each line adds to them.
    responses: Vec<f32>,
    /// The bodies have moved since the separations were worked out.
    moved: bool,
}

crate::footprint::footprint!(Answers { bodies, touched, columns, limits } none { tree, span, bears });
crate::footprint::footprint!(
    TreeContacts { found, touches, velocities, responses } each { answers } none { used, moved }
);

impl TreeContacts {
    /// Takes the contacts of trees out of the lanes of a pace.
    pub(crate) fn take(&mut self, pace: usize, stores: &mut Stores<'_>, arcs: &Arcs) {
        self.touches.clear();
        self.found.clear();
        self.velocities.clear();
        self.used = 0;
        for index in 0..stores.joint_graph.forest.trees.len() {
            let tree = &stores.joint_graph.forest.trees[index];
            let here = tree.pace == pace && !tree.links.is_empty();
            if !here || !stores.bodies.infos[tree.nodes[0].body as usize].awake {
                continue;
            }
            let runs = |motor: Motor| motor.max > 0.0 && motor.speed != 0.0;
            let runs = |def: &JointDef| def.kind.motor().is_some_and(runs);
            let drives = kinds(tree, stores.joints).any(runs);
            let left = drives && tree.links.len() > 1;
            let arcs = drives.then_some(arcs);
            let all_through_it = !left && self.find(index as u32, tree, stores, arcs);
            let tree = &mut stores.joint_graph.forest.trees[index];
            tree.note_undisturbed(all_through_it);
            tree.blocked = false;
        }
        self.found.sort_unstable();
        let Stores { bodies, graph, joint_graph, .. } = stores;
        for sides_of_trees in self.found.chunk_by(|a, b| a.at == b.at) {
            let at = sides_of_trees[0].at;
            let bucket = &mut graph.buckets.list_mut()[at.0];
            let both = bucket.bodies(at.1);
            let mut sides = [both.0, both.1].map(|body| {
                let jointed = bodies.infos[body as usize].first_joint != NULL;
                let fixed = bodies.inverse_masses(body).0 == 0.0;
                Side { body, of_tree: None, jointed, fixed, inverse: [0.0; 3] }
            });
            let is_blocked = sides.iter().any(|side| side.fixed);
            for found in sides_of_trees {
                let tree = self.answers[found.of_tree.answers as usize].tree as usize;
                joint_graph.forest.trees[tree].blocked |= is_blocked;
                sides[found.side] = Side { of_tree: Some(found.of_tree), ..sides[found.side] };
            }
            self.touches.push(Touch::take(bucket, at, sides));
        }
    }

    /// Finds what touches a tree. One with too many contacts is left out, or with any of these arcs: is this one in?
    fn find(
        &mut self,
        index: u32,
        tree: &JointTree,
        stores: &Stores<'_>,
        arcs: Option<&Arcs>,
    ) -> bool {
        let (first, tree_answers) = (self.found.len(), self.used as u32);
        if self.used == self.answers.len() {
            self.answers.push(Answers::default());
        }
        let answers = &mut self.answers[self.used];
        answers.begin(index, tree, self.velocities.len());
        let runs = |def: &JointDef| def.kind.motor().is_some_and(|motor| motor.max > 0.0);
        let braked = kinds(tree, stores.joints).any(runs);
        let sprung = kinds(tree, stores.joints).any(may_drive);
        for (node, &body) in answers.bodies.iter().enumerate() {
            let touched = answers.touched.len() as u32;
            let (at, span) = (3 * node as u32, answers.span);
            let of_tree = OfTree { answers: tree_answers, at, touched, span, braked, sprung };
            let before = self.found.len();
            let first_contact = stores.bodies.infos[body as usize].first_contact;
            for (contact, side) in stores.contacts.of_body(first_contact) {
                let contact = &stores.contacts.records[contact as usize];
                let at = stores.graph.solved_at(contact);
                self.found.extend(at.map(|at| Found { at, side: side as usize, of_tree }));
            }
            if self.found.len() > before {
                answers.touched.push(node as u32);
            }
        }
        let turns = |found: &Found| arcs.is_some_and(|arcs| arcs.holds(found.at));
        let fits = answers.touched.len() * answers.bodies.len() <= MOST_ANSWERS
            && !self.found[first..].iter().any(turns);
        if !fits {
            self.found.truncate(first);
        }
        if self.found.len() > first {
            self.used += 1;
            self.velocities.resize(self.velocities.len() + answers.span.1 as usize, 0.0);
        }
        fits
    }

    /// Puts the contacts back into their lanes.
    pub(crate) fn give_back(&self, stores: &mut Stores<'_>) {
        for touch in &self.touches {
            touch.give_back(&mut stores.graph.buckets.list_mut()[touch.at.0]);
        }
    }

    /// Brings the answers of all trees up to date with the limits that hold.
    fn update(&mut self, level: SimdLevel, rows: &[Row], forest: &mut [JointTree]) {
        let mut any = false;
        for answers in &mut self.answers[..self.used] {
            let tree = &mut forest[answers.tree as usize];
            let limits =
                || tree.links.iter().map(|link| link.limit as i8 * (1 + i8::from(link.driven)));
            let same = || tree.axes.is_empty() || answers.limits.iter().copied().eq(limits());
            if !answers.limits.is_empty() && same() {
                continue;
            }
            answers.bears = if tree.snaps { bears(tree) } else { 0.0 };
            answers.limits.clear();
            answers.limits.extend(limits());
            // Not zeroed: what nobody writes fills chunks up, and nobody reads it.
            answers.columns.resize(3 * answers.touched.len() * answers.span.1 as usize, 0.0);
            trees::answer(level, tree, &answers.touched, &mut answers.columns);
            any = true;
        }
        if any {
            let Self { answers, touches, responses, .. } = self;
            responses.clear();
            touches.iter_mut().for_each(|touch| touch.weigh(answers, responses, rows));
        }
    }

    /// Runs a pass.
    pub(crate) fn run(
        &mut self,
        level: SimdLevel,
        pass: Pass,
        parameters: &Parameters,
        rows: &mut [Row],
        forest: &mut [JointTree],
    ) {
        if self.touches.is_empty() {
            return;
        }
        if pass == Pass::Solve {
            self.update(level, rows, forest);
        }
        let constants = Constants::new((), parameters);
        let Self { answers, touches, used, velocities, responses, moved, .. } = self;
        if let Pass::WarmStart | Pass::WarmStartJointed = pass {
            let first = (pass == Pass::WarmStart).then_some(&constants);
            touches.iter_mut().for_each(|touch| touch.warm_start(rows, first));
            return;
        }
        if core::mem::replace(moved, pass == Pass::Solve) && pass != Pass::Solve {
            touches.iter_mut().for_each(|touch| touch.part(rows));
        }
        let answers = &answers[..*used];
        answers.iter().for_each(|answers| answers.load(velocities, rows));
        let mut all = Velocities { of_trees: velocities, responses, rows };
        dispatch_fours(level, RunPass(pass, &constants, touches, &mut all));
        answers.iter().for_each(|answers| answers.store(velocities, rows));
    }
}

/// A pass over all contacts.
struct RunPass<'a, 'b>(Pass, &'a Constants<f32>, &'a mut [Touch], &'a mut Velocities<'b>);

impl FourKernel for RunPass<'_, '_> {
    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let Self(pass, constants, touches, velocities) = self;
        for touch in touches {
            for side in touch.sides.iter_mut().filter(|side| side.of_tree.is_none()) {
                side.inverse = inverses::<f32>((), &velocities.rows[side.body as usize]);
            }
            if pass == Pass::Solve {
                touch.solve::<true>(constants, velocities);
                continue;
            }
            touch.rub(velocities);
            touch.solve::<false>(constants, velocities);
            for point in &mut touch.points {
                point.load = point.impulse;
                if touch.hit && pass == Pass::RelaxLast {
                    point.total += point.impulse;
                }
            }
        }
    }
}

impl Touch {
    /// Takes a contact out of its lane: the kernels find bodies there that nothing moves, and blocks with nothing else are left out.
    fn take(bucket: &mut Bucket, at: (usize, usize), sides: [Side; 2]) -> Self {
        let (block, lane) = (at.1 / BLOCK, at.1 % BLOCK);
        let flags = bucket.heads[block].flags;
        let (constraint, surface) = (&mut bucket.constraints[block], &bucket.surfaces[block]);
        (constraint.body_a[lane], constraint.body_b[lane]) = (0, 0);
        if constraint.body_a == constraint.body_b {
            bucket.heads[block].flags |= flags::TAKEN;
        }
        let mut points = [Point::default(); 2];
        let (x, y) = (constraint.normal_x[lane], constraint.normal_y[lane]);
        let asked = |flag: u8, value: f32| if flags & flag != 0 { value } else { 0.0 };
        let rests = [surface.rest_1[lane], surface.rest_2[lane]];
        for ((point, lanes), rest) in points.iter_mut().zip(&constraint.points).zip(rests) {
            let arms = [lanes.normal_arm_a[lane], lanes.normal_arm_b[lane]];
            let tangent_arms = [lanes.tangent_arm_a[lane], lanes.tangent_arm_b[lane]];
            *point = Point {
                there: lanes.normal_mass[lane] > 0.0,
                separation: lanes.separation[lane],
                rest: asked(flags::RESTS, rest),
                normal: Line::new([x, y], arms, lanes.normal_mass[lane]),
                tangent: Line::new([y, -x], tangent_arms, lanes.tangent_mass[lane]),
                impulse: lanes.normal_impulse[lane],
                rub: lanes.tangent_impulse[lane],
                load: lanes.load[lane],
                ..Point::default()
            };
        }
        Self {
            at,
            sides,
            friction: constraint.friction[lane],
            belt: asked(flags::TANGENT_SPEED, surface.tangent_speed[lane]),
            rolling: asked(flags::ROLLING, surface.rolling_resistance[lane]),
            about: Line { on: ABOUT, ..Line::default() },
            rolling_impulse: asked(flags::ROLLING, surface.rolling_impulse[lane]),
            hit: flags & flags::SUMMED != 0,
            points,
        }
    }

    fn give_back(&self, bucket: &mut Bucket) {
        let (block, lane) = (self.at.1 / BLOCK, self.at.1 % BLOCK);
        let (constraint, surface) = (&mut bucket.constraints[block], &mut bucket.surfaces[block]);
        constraint.body_a[lane] = self.sides[0].body;
        constraint.body_b[lane] = self.sides[1].body;
        for (point, lanes) in self.points.iter().zip(&mut constraint.points) {
            lanes.normal_impulse[lane] = point.impulse;
            lanes.tangent_impulse[lane] = point.rub;
            lanes.load[lane] = point.load;
        }
        surface.rolling_impulse[lane] = self.rolling_impulse;
        [surface.total_1[lane], surface.total_2[lane]] = self.points.map(|point| point.total);
        [surface.rest_1[lane], surface.rest_2[lane]] = self.points.map(|point| point.rest);
        bucket.heads[block].flags &= !flags::TAKEN;
    }

    /// Works out the answers to impulses, and the effective masses.
    fn weigh(&mut self, answers: &[Answers], responses: &mut Vec<f32>, rows: &[Row]) {
        let sides = self.sides;
        let any = |is: fn(OfTree) -> bool| sides.iter().any(|side| side.of_tree.is_some_and(is));
        let heaviest = if any(|at| at.braked) { 1.0 } else { HEAVIEST };
        let heaviest = if any(|at| at.sprung) { SPRUNG } else { heaviest };
        let bears = |side: &Side| side.of_tree.map(|at| answers[at.answers as usize].bears);
        let is_held = sides.iter().any(|side| side.fixed);
        let bears = sides.iter().filter_map(bears).filter(|_| is_held).fold(0.0, f32::max);
        let points = self.points.iter_mut().filter(|point| point.there);
        for line in points.flat_map(|point| [&mut point.normal, &mut point.tangent]) {
            let give = line.respond(&sides, answers, responses, rows);
            let most = bears.max(heaviest * line.alone);
            line.mass = if give * most > 1.0 { 1.0 / give } else { most };
        }
        if self.rolling > 0.0 {
            self.about.respond(&sides, answers, responses, rows);
        }
    }

    /// Applies the impulses of the substep before to the two bodies alone: the tree is solved next.
    fn warm_start(&mut self, rows: &mut [Row], first: Option<&Constants<f32>>) {
        let sides = self.sides.iter().enumerate();
        for (k, side) in sides.filter(|(_, side)| first.is_some() || side.jointed) {
            let row = &mut rows[side.body as usize];
            let inverse = inverses::<f32>((), row);
            for point in &self.points {
                push_body(row, inverse, point.normal.on[k], point.impulse);
                push_body(row, inverse, point.tangent.on[k], point.rub);
            }
            push_body(row, inverse, ABOUT[k], self.rolling_impulse);
        }
        if let Some(constants) = first {
            self.part(rows);
            let [rate, _, scale] = self.softness(constants);
            for point in self.points.iter_mut().filter(|point| point.there) {
                point.load = point.impulse;
                point.rest = point.rest.min(scale / rate * (point.impulse / point.normal.alone));
            }
        }
    }

    /// Works out how far apart the points are now.
    fn part(&mut self, rows: &[Row]) {
        let [a, b] = self.sides.map(|side| planar(&rows[side.body as usize][Slot::DX..]));
        for point in &mut self.points {
            let on = point.normal.on;
            point.now = point.separation + (dot(on[0], a) + dot(on[1], b));
        }
    }

    #[inline(always)]
    fn softness(&self, constants: &Constants<f32>) -> [f32; 3] {
        let fixed = self.sides[0].fixed || self.sides[1].fixed;
        if fixed { constants.static_soft } else { constants.soft }
    }

    /// Normal impulses; see the kernels of [`super::contact_solver`].
    #[inline(always)]
    fn solve<const BIAS: bool>(
        &mut self,
        constants: &Constants<f32>,
        velocities: &mut Velocities<'_>,
    ) {
        let soft = self.softness(constants);
        let Self { sides, points, .. } = self;
        for point in points {
            if !point.there {
                continue;
            }
            let (line, old) = (&point.normal, point.impulse);
            // What is heavier sinks less.
            let full = (point.rest - point.separation) * (line.alone / line.mass);
            let rest = if point.rest > 0.0 { (full + point.separation).max(0.0) } else { 0.0 };
            let at = [point.now, velocities.along(sides, line), rest];
            point.impulse = normal_impulse::<f32, BIAS>(constants, soft, at, line.mass, old);
            velocities.push(sides, line, point.impulse - old);
        }
    }

    /// Friction and rolling resistance.
    #[inline(always)]
    fn rub(&mut self, velocities: &mut Velocities<'_>) {
        let all = self.points[0].load + self.points[1].load;
        // From the same velocity, each by its part of the load.
        let speeds = self.points.each_ref().map(|p| velocities.along(&self.sides, &p.tangent));
        for (point, speed) in self.points.iter_mut().zip(speeds).filter(|(point, _)| point.there) {
            let (line, old) = (&point.tangent, point.rub);
            let part = if all > 0.0 { point.load / all } else { 0.0 };
            let change = line.mass * (part * (speed + self.belt));
            let limit = self.friction * point.load;
            point.rub = Lanes::clamp(old - change, -limit, limit);
            velocities.push(&self.sides, line, point.rub - old);
        }
        if self.rolling > 0.0 {
            let limit = self.rolling * (self.points[0].load + self.points[1].load);
            let rows = self.sides.each_ref().map(|side| &velocities.rows[side.body as usize]);
            let give = rows[0][Slot::INV_INERTIA].abs() + rows[1][Slot::INV_INERTIA].abs();
            let (old, mass) = (self.rolling_impulse, if give > 0.0 { 1.0 / give } else { 0.0 });
            let wanted = old - mass * velocities.along(&self.sides, &self.about);
            self.rolling_impulse = Lanes::clamp(wanted, -limit, limit);
            velocities.push(&self.sides, &self.about, self.rolling_impulse - old);
        }
    }
}

/// The velocities of all bodies during a pass: those of trees with their answers.
struct Velocities<'a> {
    of_trees: &'a mut [f32],
    responses: &'a [f32],
    rows: &'a mut [Row],
}

impl Velocities<'_> {
    #[inline(always)]
    fn of(&self, side: &Side) -> Planar {
        match side.of_tree {
            Some(of) => planar(&self.of_trees[(of.span.0 + of.at) as usize..]),
            None => planar(&self.rows[side.body as usize]),
        }
    }

    /// Along a line.
    #[inline(always)]
    fn along(&self, [a, b]: &[Side; 2], Line { on, .. }: &Line) -> f32 {
        dot(on[0], self.of(a)) + dot(on[1], self.of(b))
    }

    /// Applies an impulse to both bodies, and to the trees that they are of.
    #[inline(always)]
    fn push(&mut self, sides: &[Side; 2], line: &Line, impulse: f32) {
        if impulse == 0.0 {
            return;
        }
        for (k, side) in sides.iter().enumerate() {
            let Some(OfTree { span: (first, count), .. }) = side.of_tree else {
                let row = &mut self.rows[side.body as usize];
                push_body(row, side.inverse, line.on[k], impulse);
                continue;
            };
            let velocities = &mut self.of_trees[first as usize..][..count as usize];
            let response = &self.responses[line.answers[k] as usize..][..count as usize];
            let chunks = velocities.as_chunks_mut::<CHUNK>().0.iter_mut();
            for (velocities, response) in chunks.zip(response.as_chunks::<CHUNK>().0) {
                // Of a copy, so that the compiler sees that nothing overlaps and takes all at once.
                let mut changed = *velocities;
                for k in 0..CHUNK {
                    changed[k] += response[k] * impulse;
                }
                *velocities = changed;
            }
        }
    }
}

/// The joints of a tree.
fn kinds<'a>(tree: &'a JointTree, joints: &'a Joints) -> impl Iterator<Item = &'a JointDef> {
    tree.links.iter().map(|link| &joints.records[link.joint as usize].def)
}

/// The first three numbers.
#[inline(always)]
fn planar(numbers: &[f32]) -> Planar {
    [numbers[0], numbers[1], numbers[2]]
}

impl Line {
    /// In a direction, at arms that are its cross products with the anchors on A and on B.
    fn new([x, y]: [f32; 2], arms: [f32; 2], mass: f32) -> Self {
        let on = [[-x, -y, -arms[0]], [x, y, arms[1]]];
        Self { on, alone: mass, mass, ..Self::default() }
    }

    /// Works out how the trees answer an impulse of one; gives the velocity along it.
    fn respond(
        &mut self,
        sides: &[Side; 2],
        answers: &[Answers],
        responses: &mut Vec<f32>,
        rows: &[Row],
    ) -> f32 {
        let mut give = 0.0;
        for (k, side) in sides.iter().enumerate() {
            let (first, [x, y, turn]) = (responses.len(), self.on[k]);
            self.answers[k] = first as u32;
            let Some(of) = side.of_tree else {
                let [mass_x, mass_y, inertia] = inverses::<f32>((), &rows[side.body as usize]);
                give += give_along((), [x, y], [mass_x, mass_y]) + inertia * turn * turn;
                continue;
            };
            let count = of.span.1 as usize;
            let columns = &answers[of.answers as usize].columns[3 * of.touched as usize * count..];
            let column = |i: usize| columns[i * count..(i + 1) * count].as_chunks::<CHUNK>().0;
            for ((a, b), c) in column(0).iter().zip(column(1)).zip(column(2)) {
                let changes: [_; CHUNK] =
                    core::array::from_fn(|k| a[k] * x + b[k] * y + c[k] * turn);
                responses.extend_from_slice(&changes);
            }
            let change = |of: OfTree| planar(&responses[first + of.at as usize..]);
            give += dot(self.on[k], change(of));
            let other = sides[0].of_tree.filter(|other| k == 1 && other.answers == of.answers);
            give += other.map_or(0.0, |other| 2.0 * dot(self.on[0], change(other)));
        }
        give
    }
}

#[inline(always)]
fn dot(a: Planar, b: Planar) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn push_body(row: &mut Row, inverse: Planar, on: Planar, impulse: f32) {
    for (k, inverse) in inverse.into_iter().enumerate() {
        row[k] += inverse * (on[k] * impulse);
    }
}

impl Answers {
    /// Begins anew for a tree that nothing touches yet, with velocities from a place on.
    fn begin(&mut self, index: u32, tree: &JointTree, first: usize) {
        self.tree = index;
        self.touched.clear();
        self.limits.clear();
        self.bodies.clear();
        self.bodies.extend(tree.nodes[..tree.dynamic].iter().map(|node| node.body));
        self.span = (first as u32, (3 * tree.dynamic).next_multiple_of(CHUNK) as u32);
    }

    /// Gathers the velocities of the bodies.
    fn load(&self, velocities: &mut [f32], rows: &[Row]) {
        let own = velocities[self.span.0 as usize..].as_chunks_mut().0;
        for (velocity, &body) in own.iter_mut().zip(&self.bodies) {
            *velocity = planar(&rows[body as usize]);
        }
    }

    fn store(&self, velocities: &[f32], rows: &mut [Row]) {
        let own = velocities[self.span.0 as usize..].as_chunks::<3>().0;
        for (velocity, &body) in own.iter().zip(&self.bodies) {
            rows[body as usize][Slot::VX..Slot::VX + 3].copy_from_slice(velocity);
        }
    }
}
