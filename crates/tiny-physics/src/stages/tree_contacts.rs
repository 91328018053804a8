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
//! Trees with springs, or motors that run, keep their contacts in lanes: the elimination knows nothing of these, and a leg that
//! they hold stiff would feel as if it hung loose. Brakes, motors without speed, may be overcome.
//!
//! These contacts are taken out of their lanes for the length of the substeps, and put back with their impulses.

use super::contact_solver::{Constants, Parameters, Pass, normal_impulse};
use super::islands::Stores;
use super::joint_solver::trees;
use super::passivity::may_drive;
use crate::describe::JointDef;
use crate::dynamics::{Bodies, Bucket, JointTree, Joints, NULL, Slot, flags, give_along, inverses};
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
    /// Velocities of the bodies during a pass, as long as a column.
    velocities: Vec<f32>,
    /// The limits that held then.
    limits: Vec<i8>,
}

/// Which answers are of a body's tree, and its place among the nodes and the touched ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct OfTree {
    answers: u32,
    node: u32,
    touched: u32,
    /// It has brakes; see [`HEAVIEST`].
    braked: bool,
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
}

#[derive(Clone, Copy, Debug, Default)]
struct Point {
    there: bool,
    separation: f32,
    /// Cross products of anchors with normal and tangent, on A and on B.
    arms: [f32; 2],
    tangent_arms: [f32; 2],
    /// Of the two bodies alone, and with all that hangs on them.
    alone: [f32; 2],
    mass: f32,
    tangent_mass: f32,
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
    normal: [f32; 2],
    friction: f32,
    belt: f32,
    rolling: f32,
    rolling_impulse: f32,
    hit: bool,
    /// Nothing moves one of the bodies.
    fixed: bool,
    points: [Point; 2],
}

/// The contacts of trees of a pace. Found anew each step; kept for its memory.
#[derive(Debug, Default)]
pub(crate) struct TreeContacts {
    answers: Vec<Answers>,
    used: usize,
    found: Vec<Found>,
    touches: Vec<Touch>,
}

crate::footprint::footprint!(Answers { bodies, touched, columns, velocities, limits } none { tree });
crate::footprint::footprint!(TreeContacts { found, touches } each { answers } none { used });

impl TreeContacts {
    /// Takes the contacts of trees out of the lanes of a pace.
    pub(crate) fn take(&mut self, pace: usize, stores: &mut Stores<'_>) {
        self.touches.clear();
        self.found.clear();
        self.used = 0;
        for index in 0..stores.joint_graph.forest.trees.len() {
            let tree = &stores.joint_graph.forest.trees[index];
            let here = tree.pace == pace && !tree.links.is_empty();
            if !here || !stores.bodies.infos[tree.nodes[0].body as usize].awake {
                continue;
            }
            let drives = kinds(tree, stores.joints).any(may_drive);
            let all_through_it = !drives && self.find(index as u32, tree, stores);
            stores.joint_graph.forest.trees[index].note_undisturbed(all_through_it);
        }
        self.found.sort_unstable();
        let Stores { bodies, graph, .. } = stores;
        for sides_of_trees in self.found.chunk_by(|a, b| a.at == b.at) {
            let at = sides_of_trees[0].at;
            let bucket = &mut graph.buckets.list_mut()[at.0];
            let both = bucket.bodies(at.1);
            let mut sides = [both.0, both.1].map(|body| Side::alone(bodies, body));
            for found in sides_of_trees {
                sides[found.side] = Side { of_tree: Some(found.of_tree), ..sides[found.side] };
            }
            self.touches.push(Touch::take(bucket, at, sides));
        }
    }

    /// Finds what touches a tree. One with too many contacts is left out: is this one in?
    fn find(&mut self, index: u32, tree: &JointTree, stores: &Stores<'_>) -> bool {
        let (first, tree_answers) = (self.found.len(), self.used as u32);
        if self.used == self.answers.len() {
            self.answers.push(Answers::default());
        }
        let answers = &mut self.answers[self.used];
        answers.begin(index, tree);
        let braked = kinds(tree, stores.joints)
            .any(|def| def.kind.motor().is_some_and(|motor| motor.max > 0.0));
        for (node, &body) in answers.bodies.iter().enumerate() {
            let touched = answers.touched.len() as u32;
            let of_tree = OfTree { answers: tree_answers, node: node as u32, touched, braked };
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
        let fits = answers.touched.len() * answers.bodies.len() <= MOST_ANSWERS;
        if !fits {
            self.found.truncate(first);
        }
        self.used += usize::from(self.found.len() > first);
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
            let limits = || tree.links.iter().map(|link| link.limit as i8);
            let known = !answers.limits.is_empty() && answers.limits.iter().copied().eq(limits());
            if answers.touched.is_empty() || known {
                continue;
            }
            answers.limits.clear();
            answers.limits.extend(limits());
            answers.columns.clear();
            answers.columns.resize(3 * answers.touched.len() * answers.velocities.len(), 0.0);
            trees::answer(level, tree, &answers.touched, &mut answers.columns);
            any = true;
        }
        if any {
            let Self { answers, touches, .. } = self;
            touches.iter_mut().for_each(|touch| touch.weigh(answers, rows));
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
        let Self { answers, touches, used, .. } = self;
        if let Pass::WarmStart | Pass::WarmStartJointed = pass {
            let first = pass == Pass::WarmStart;
            touches.iter_mut().for_each(|touch| touch.warm_start(rows, first));
            return;
        }
        let (answers, constants) = (&mut answers[..*used], Constants::new((), parameters));
        answers.iter_mut().for_each(|answers| answers.load(rows));
        let mut velocities = Velocities { answers, rows };
        dispatch_fours(level, RunPass(pass, &constants, touches, &mut velocities));
        velocities.answers.iter().for_each(|answers| answers.store(velocities.rows));
    }
}

/// A pass over all contacts.
struct RunPass<'a, 'b>(Pass, &'a Constants<f32>, &'a mut [Touch], &'a mut Velocities<'b>);

impl FourKernel for RunPass<'_, '_> {
    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let Self(pass, constants, touches, velocities) = self;
        for touch in touches {
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
        let used = BLOCK.min(bucket.contacts.len() - block * BLOCK);
        if constraint.body_a[..used] == constraint.body_b[..used] {
            bucket.heads[block].flags |= flags::TAKEN;
        }
        let mut points = [Point::default(); 2];
        for (point, lanes) in points.iter_mut().zip(&constraint.points) {
            *point = Point {
                there: lanes.normal_mass[lane] > 0.0,
                separation: lanes.separation[lane],
                arms: [lanes.normal_arm_a[lane], lanes.normal_arm_b[lane]],
                tangent_arms: [lanes.tangent_arm_a[lane], lanes.tangent_arm_b[lane]],
                alone: [lanes.normal_mass[lane], lanes.tangent_mass[lane]],
                mass: lanes.normal_mass[lane],
                tangent_mass: lanes.tangent_mass[lane],
                impulse: lanes.normal_impulse[lane],
                rub: lanes.tangent_impulse[lane],
                load: lanes.load[lane],
                total: 0.0,
            };
        }
        let asked = |flag: u8, value: f32| if flags & flag != 0 { value } else { 0.0 };
        Self {
            at,
            sides,
            normal: [constraint.normal_x[lane], constraint.normal_y[lane]],
            friction: constraint.friction[lane],
            belt: asked(flags::TANGENT_SPEED, surface.tangent_speed[lane]),
            rolling: asked(flags::ROLLING, surface.rolling_resistance[lane]),
            rolling_impulse: asked(flags::ROLLING, surface.rolling_impulse[lane]),
            hit: flags & flags::SUMMED != 0,
            fixed: sides[0].fixed || sides[1].fixed,
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
        (surface.total_1[lane], surface.total_2[lane]) =
            (self.points[0].total, self.points[1].total);
        bucket.heads[block].flags &= !flags::TAKEN;
    }

    /// Directions of impulses along the normal, the tangent or about: on A and on B.
    #[inline(always)]
    fn along(direction: [f32; 2], arms: [f32; 2]) -> [Planar; 2] {
        let [x, y] = direction;
        [[-x, -y, -arms[0]], [x, y, arms[1]]]
    }

    fn tangent(&self) -> [f32; 2] {
        [self.normal[1], -self.normal[0]]
    }

    /// Works out the effective masses.
    fn weigh(&mut self, answers: &[Answers], rows: &[Row]) {
        let (normal, tangent) = (self.normal, self.tangent());
        let sides = self.sides;
        let braked = sides.iter().any(|side| side.of_tree.is_some_and(|at| at.braked));
        let heaviest = if braked { 1.0 } else { HEAVIEST };
        let mass = |on: [Planar; 2], alone: f32| {
            let (give, most) = (give(&sides, on, answers, rows), heaviest * alone);
            if give * most > 1.0 { 1.0 / give } else { most }
        };
        for point in self.points.iter_mut().filter(|point| point.there) {
            point.mass = mass(Self::along(normal, point.arms), point.alone[0]);
            point.tangent_mass = mass(Self::along(tangent, point.tangent_arms), point.alone[1]);
        }
    }

    /// Applies the impulses of the substep before to the two bodies alone: the tree is solved next.
    fn warm_start(&mut self, rows: &mut [Row], first: bool) {
        let (normal, tangent) = (self.normal, self.tangent());
        for (k, side) in self.sides.iter().enumerate().filter(|(_, side)| first || side.jointed) {
            let row = &mut rows[side.body as usize];
            for point in &self.points {
                push_body(row, Self::along(normal, point.arms)[k], point.impulse);
                push_body(row, Self::along(tangent, point.tangent_arms)[k], point.rub);
            }
            push_body(row, ABOUT[k], self.rolling_impulse);
        }
        if first {
            self.points.iter_mut().for_each(|point| point.load = point.impulse);
        }
    }

    /// Normal impulses; see the kernels of [`super::contact_solver`].
    #[inline(always)]
    fn solve<const BIAS: bool>(
        &mut self,
        constants: &Constants<f32>,
        velocities: &mut Velocities<'_>,
    ) {
        let Self { sides, normal, points, fixed, .. } = self;
        let soft = if *fixed { constants.static_soft } else { constants.soft };
        for point in points {
            if !point.there {
                continue;
            }
            let on = Self::along(*normal, point.arms);
            let s = point.separation + velocities.ways(sides, on);
            let (velocity, old) = (velocities.along(sides, on), point.impulse);
            point.impulse =
                normal_impulse::<f32, BIAS>(constants, soft, [s, velocity, 0.0], point.mass, old);
            velocities.push(sides, on, point.impulse - old);
        }
    }

    /// Friction and rolling resistance.
    #[inline(always)]
    fn rub(&mut self, velocities: &mut Velocities<'_>) {
        let tangent = self.tangent();
        for point in &mut self.points {
            if !point.there {
                continue;
            }
            let on = Self::along(tangent, point.tangent_arms);
            let velocity = velocities.along(&self.sides, on) + self.belt;
            let limit = self.friction * point.load;
            let old = point.rub;
            point.rub = Lanes::clamp(old - point.tangent_mass * velocity, -limit, limit);
            velocities.push(&self.sides, on, point.rub - old);
        }
        if self.rolling > 0.0 {
            let limit = self.rolling * (self.points[0].load + self.points[1].load);
            let inverse =
                |k: usize| velocities.rows[self.sides[k].body as usize][Slot::INV_INERTIA].abs();
            let (give, old) = (inverse(0) + inverse(1), self.rolling_impulse);
            let mass = if give > 0.0 { 1.0 / give } else { 0.0 };
            let wanted = old - mass * velocities.along(&self.sides, ABOUT);
            self.rolling_impulse = Lanes::clamp(wanted, -limit, limit);
            velocities.push(&self.sides, ABOUT, self.rolling_impulse - old);
        }
    }
}

/// The velocities of all bodies during a pass: those of trees with their answers.
struct Velocities<'a> {
    answers: &'a mut [Answers],
    rows: &'a mut [Row],
}

impl Velocities<'_> {
    #[inline(always)]
    fn of(&self, side: &Side) -> Planar {
        match side.of_tree {
            Some(at) => {
                self.answers[at.answers as usize].velocities.as_chunks().0[at.node as usize]
            }
            None => planar(&self.rows[side.body as usize], Slot::VX),
        }
    }

    /// Along a direction on both bodies.
    #[inline(always)]
    fn along(&self, [a, b]: &[Side; 2], on: [Planar; 2]) -> f32 {
        dot(on[0], self.of(a)) + dot(on[1], self.of(b))
    }

    /// The ways since the start of the step, along a direction on both bodies.
    #[inline(always)]
    fn ways(&self, [a, b]: &[Side; 2], on: [Planar; 2]) -> f32 {
        let way = |side: &Side| planar(&self.rows[side.body as usize], Slot::DX);
        dot(on[0], way(a)) + dot(on[1], way(b))
    }

    /// Applies an impulse to both bodies, and to the trees that they are of.
    #[inline(always)]
    fn push(&mut self, [a, b]: &[Side; 2], on: [Planar; 2], impulse: f32) {
        if impulse == 0.0 {
            return;
        }
        for (side, on) in [(a, on[0]), (b, on[1])] {
            match side.of_tree {
                None => push_body(&mut self.rows[side.body as usize], on, impulse),
                Some(at) => self.answers[at.answers as usize].push(at.touched, on, impulse),
            }
        }
    }
}

/// The joints of a tree.
fn kinds<'a>(tree: &'a JointTree, joints: &'a Joints) -> impl Iterator<Item = &'a JointDef> {
    tree.links.iter().map(|link| &joints.records[link.joint as usize].def)
}

/// Three numbers of a row.
#[inline(always)]
fn planar(row: &Row, first: usize) -> Planar {
    [row[first], row[first + 1], row[first + 2]]
}

/// Velocity along a direction per impulse along it.
fn give(sides: &[Side; 2], on: [Planar; 2], answers: &[Answers], rows: &[Row]) -> f32 {
    let own = [0, 1].map(|k: usize| match sides[k].of_tree {
        None => {
            let row = &rows[sides[k].body as usize];
            let [x, y, turn] = on[k];
            let [mass_x, mass_y, inv_inertia] = inverses::<f32>((), row);
            give_along([x, y], [mass_x, mass_y]) + inv_inertia * turn * turn
        }
        Some(at) => dot(on[k], answers[at.answers as usize].change(at.touched, at.node, on[k])),
    });
    let both = match [sides[0].of_tree, sides[1].of_tree] {
        [Some(a), Some(b)] if a.answers == b.answers => {
            let answers = &answers[a.answers as usize];
            2.0 * dot(on[0], answers.change(b.touched, a.node, on[1]))
        }
        _ => 0.0,
    };
    own[0] + own[1] + both
}

#[inline(always)]
fn dot(a: Planar, b: Planar) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn push_body(row: &mut Row, on: Planar, impulse: f32) {
    for (k, inverse) in inverses::<f32>((), row).into_iter().enumerate() {
        row[k] += inverse * (on[k] * impulse);
    }
}

impl Side {
    /// A body by itself.
    fn alone(bodies: &Bodies, body: u32) -> Self {
        let jointed = bodies.infos[body as usize].first_joint != NULL;
        let fixed = bodies.inverse_masses(body).0 == 0.0;
        Self { body, of_tree: None, jointed, fixed }
    }
}

impl Answers {
    /// Begins anew for a tree that nothing touches yet.
    fn begin(&mut self, index: u32, tree: &JointTree) {
        self.tree = index;
        self.touched.clear();
        self.limits.clear();
        self.bodies.clear();
        self.bodies.extend(tree.nodes[..tree.dynamic].iter().map(|node| node.body));
        self.velocities.clear();
        self.velocities.resize((3 * tree.dynamic).next_multiple_of(CHUNK), 0.0);
    }

    /// Gathers the velocities of the bodies.
    fn load(&mut self, rows: &[Row]) {
        for (velocity, &body) in self.velocities.as_chunks_mut().0.iter_mut().zip(&self.bodies) {
            *velocity = planar(&rows[body as usize], Slot::VX);
        }
    }

    fn store(&self, rows: &mut [Row]) {
        for (velocity, &body) in self.velocities.as_chunks::<3>().0.iter().zip(&self.bodies) {
            rows[body as usize][Slot::VX..Slot::VX + 3].copy_from_slice(velocity);
        }
    }

    /// Change of a node's velocity where an impulse acts on a touched one.
    fn change(&self, touched: u32, node: u32, [x, y, turn]: Planar) -> Planar {
        let length = self.velocities.len();
        let at = 3 * (touched as usize * length + node as usize);
        core::array::from_fn(|k| {
            let column = |i: usize| self.columns[at + i * length + k];
            column(0) * x + column(1) * y + column(2) * turn
        })
    }

    /// Changes the velocities where an impulse acts on a touched node.
    #[inline(always)]
    fn push(&mut self, touched: u32, [x, y, turn]: Planar, impulse: f32) {
        let force = [x * impulse, y * impulse, turn * impulse];
        let length = self.velocities.len();
        let columns = &self.columns[3 * touched as usize * length..];
        let along = |i: usize| columns[i * length..(i + 1) * length].as_chunks::<CHUNK>().0;
        let columns = along(0).iter().zip(along(1)).zip(along(2));
        let velocities = self.velocities.as_chunks_mut::<CHUNK>().0;
        for (velocities, ((x, y), turn)) in velocities.iter_mut().zip(columns) {
            // Of a copy, so that the compiler sees that nothing overlaps and takes all at once.
            let mut changed = *velocities;
            for k in 0..CHUNK {
                changed[k] += x[k] * force[0] + y[k] * force[1] + turn[k] * force[2];
            }
            *velocities = changed;
        }
    }
}
