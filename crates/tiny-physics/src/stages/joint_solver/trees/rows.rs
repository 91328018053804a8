//! The rows of a tree's joints, and what follows from the bodies' places.
//!
//! Each kind writes its own, from its lanes and by the formulas of its kernel in 64 bits:
//! [`JointKernel::tie`](super::super::JointKernel::tie).

use super::factor::{dot3, invert};
use crate::dynamics::{
    Impulses, JointClass, JointColour, JointTree, Joints, Slot, TreeAxis, TreeLink, TreeNode,
    TreeRow, give_along, inverses, is_jointed, with_bucket,
};
use crate::simd::{BLOCK, Simd, Three, add_times, times};
use crate::stages::joint_solver::JointKernel;
use crate::stages::joint_solver::parts::{LEAST_COMPLEMENT, Pair, Row, Sides, Stride, Substep};
use crate::threads::SharedRows;

/// An angular impulse, on A and on B.
const ABOUT: [Three; 2] = [[0.0, 0.0, -1.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
/// Compliance of a rigid row, as a fraction of the inverse mass of its two bodies alone: it bears loops that cannot
/// close, such as a plank pinned at two points too far apart. Of a chain of 30 links it makes most of the stretch
/// under 1000 times a link's weight: 0.13 % at 1e-4, 0.039 % at 3e-5; at 1e-6 rounding made it 0.5 %.
const COMPLIANCE: f64 = 3.0e-5;
/// What a row gives that nothing answers, such as one against turning between what cannot turn: it has no share in its link.
const UNANSWERED: f64 = 1.0e30;
/// Overrun from which on the limit of a joint by itself gives way to what stands in its way and cannot move, radians or length units.
const BENT: f64 = 0.03;
/// It counts as no less than this part of what an impulse across the arm would give: what is locked along an axis gives by
/// its turning alone, and about a short arm that would be held as firmly as about a long one.
const LOCKED: f64 = 0.01;
/// And nothing about an arm whose square is no more than this, length units: that is rounding.
const ROUNDING: f64 = 1.0e-10;
/// Impulses have grown much where they ask for so many times the moment of inertia.
const TAUTER: f64 = 1.1;

impl Row<f64> {
    /// That of the angle.
    pub(in super::super) const ANGLE: Self =
        Self { direction: [0.0; 2], arm_a: 1.0, arm_b: 1.0, reach: [0.0; 2] };

    fn of_tree(&self) -> TreeRow {
        let [x, y] = self.direction;
        let on = [[-x, -y, -self.arm_a, 0.0], [x, y, self.arm_b, 0.0]];
        TreeRow { on, reach: self.reach, ..TreeRow::default() }
    }
}

impl TreeLink {
    /// Adds a row, which is held, with its position error.
    pub(in super::super) fn hold(&mut self, row: &Row<f64>, error: f64) {
        self.add(TreeRow { error, ..row.of_tree() });
    }

    /// Holds the anchors together.
    pub(in super::super) fn hold_point(&mut self, pair: &Pair<f64>) {
        let Pair { anchor_a: [ax, ay], anchor_b: [bx, by], gap, .. } = *pair;
        let row = |direction, arm_a, arm_b, reach| Row { direction, arm_a, arm_b, reach };
        self.hold(&row([1.0, 0.0], -ay, -by, [ax, bx]), gap[0]);
        self.hold(&row([0.0, 1.0], ax, bx, [ay, by]), gap[1]);
    }

    /// Holds a row of which each body has a direction of its own.
    pub(in super::super) fn mesh(&mut self, mesh: &Sides<f64>, error: f64) {
        let on = |side: usize| {
            [mesh.directions[side][0], mesh.directions[side][1], mesh.arms[side], 0.0]
        };
        self.add(TreeRow { on: [on(0), on(1)], error, ..TreeRow::default() });
    }

    /// Leaves a coordinate free.
    pub(in super::super) fn let_go(&mut self, row: &Row<f64>, value: f64) {
        (self.coordinate, self.value) = (row.of_tree(), value);
    }

    fn add(&mut self, row: TreeRow) {
        self.set_row(self.rigid, &row);
        self.rigid += 1;
    }

    /// A row on A and on B.
    #[inline(always)]
    pub(super) fn row(&self, i: usize) -> [Three; 2] {
        [self.jacobians[0].rows[i], self.jacobians[1].rows[i]]
    }
}

/// Begins a step.
pub(super) fn prepare(tree: &mut JointTree, joints: &Joints) {
    let JointTree { links, axes, begun, fresh, factored, .. } = tree;
    axes.clear();
    (*begun, *fresh, *factored) = (false, false, false);
    for link in links {
        let lanes = joints.records[link.joint as usize].lanes();
        debug_assert!(lanes.is_some(), "a joint of a tree has no lanes");
        link.slot = lanes.map_or(link.slot, |(.., slot)| slot);
        (link.limit, link.driven) = (0.0, false);
    }
}

/// Takes over the impulses and what acts along the free coordinate of a link, once its rows are there.
fn begin<B: JointKernel>(
    block: &B,
    stride: &Stride<f64>,
    (index, link): (usize, &mut TreeLink),
    axes: &mut Vec<TreeAxis>,
) {
    let mut saved = Impulses::default();
    block.save(stride.at, &mut saved);
    link.impulses = [0.0; 4];
    for (impulse, saved) in link.impulses[..link.rigid].iter_mut().zip(saved) {
        *impulse = f64::from(saved);
    }
    let motor = block.motor(stride.at).map(|motor| motor.map(f64::from));
    if let Some(lanes) = block.axis()
        && (motor.is_some() || lanes.used[stride.at] != 0.0)
    {
        let mut axis = lanes.load(stride);
        axis.limits = [axis.limits[0] - axis.limits[1], 0.0];
        link.turns = motor.is_some();
        if let Some(motor) = motor {
            [axis.motor_speed, axis.motor_max, axis.motor] = motor;
        }
        link.driven =
            axis.limits[0] == 0.0 && axis.motor != 0.0 && axis.motor.abs() < axis.motor_max;
        link.limit = f64::from(u8::from(link.driven));
        axes.push(TreeAxis { link: index as u32, axis, ..TreeAxis::default() });
    }
}

/// Gives the impulses, and the directions in which they act, back to the lanes.
pub(super) fn finish(tree: &JointTree, lanes: &mut JointColour) {
    let mut axes = tree.axes.iter().peekable();
    for (index, link) in tree.links.iter().enumerate() {
        let (at, lane) = (link.slot as usize / BLOCK, link.slot as usize % BLOCK);
        let axis = axes.next_if(|axis| axis.link as usize == index);
        with_bucket!(&mut *lanes, link.class, bucket => {
            give_back(link, axis, &mut bucket.blocks[at], lane);
        });
    }
}

fn give_back<B: JointKernel>(link: &TreeLink, axis: Option<&TreeAxis>, block: &mut B, lane: usize) {
    let mut saved = Impulses::default();
    block.save(lane, &mut saved);
    for (saved, impulse) in saved.iter_mut().zip(&link.impulses[..link.rigid]) {
        *saved = *impulse as f32;
    }
    if let Some(TreeAxis { axis, .. }) = axis {
        let [limit, _] = axis.limits;
        let motor = if link.turns { 0.0 } else { axis.motor };
        let impulses = [axis.spring, motor, limit.max(0.0), (-limit).max(0.0)];
        saved[B::IMPULSES - 4..B::IMPULSES]
            .copy_from_slice(&impulses.map(|impulse| impulse as f32));
        if link.turns {
            saved[link.rigid] = axis.motor as f32;
        }
    }
    block.restore(lane, &saved);
    if let Some([x, y]) = block.told() {
        [x[lane], y[lane]] = [0, 1].map(|k: usize| link.coordinate.on[1][k] as f32);
    }
}

/// Gathers the velocities of a tree's bodies.
#[inline(always)]
pub(super) fn load(tree: &mut JointTree, rows: SharedRows<'_>) {
    for node in &mut tree.nodes {
        let row = rows.read(node.body);
        node.v = [row[Slot::VX], row[Slot::VY], row[Slot::W], 0.0].map(f64::from);
    }
}

/// Scatters the velocities of the bodies that something moves.
#[inline(always)]
pub(super) fn store(tree: &JointTree, rows: SharedRows<'_>) {
    for node in &tree.nodes[..tree.dynamic] {
        rows.update(node.body, |row| {
            for k in (0..3).filter(|&k| node.inv[k] > 0.0) {
                row[k] = node.v[k] as f32;
            }
        });
    }
}

/// Works the rows out for where the bodies are now.
#[inline(always)]
pub(super) fn refresh<S: Simd>(
    simd: S,
    tree: &mut JointTree,
    lanes: &JointColour,
    rows: SharedRows<'_>,
    substep: Substep,
) {
    let JointTree {
        nodes,
        dynamic,
        links,
        axes,
        pace,
        begun,
        fresh,
        factored,
        torn,
        alone,
        blocked,
        ..
    } = tree;
    let may_yield = *blocked && *alone && links.len() == 1 && *dynamic == 1;
    for node in nodes.iter_mut() {
        let [x, y, turn] = inverses::<f32>((), &rows.read(node.body));
        if !*begun {
            node.own_inv_inertia = f64::from(turn);
        }
        let before = node.inv[2];
        node.taut = if before < node.taut { before } else { node.taut };
        node.inv = [f64::from(x), f64::from(y), node.own_inv_inertia, 0.0];
    }
    for (index, link) in links.iter_mut().enumerate() {
        let stride = Stride::new((), link.slot as usize % BLOCK, substep);
        let yields;
        with_bucket!(lanes, link.class, bucket => {
            let block = &bucket.blocks[link.slot as usize / BLOCK];
            link.rigid = 0;
            block.tie(&stride, &Pair::load(&stride, rows, &block.frame), link);
            // What slides would run away along its line.
            let slides = link.class == JointClass::Slider;
            yields = if slides { 0.0 } else { f64::from(block.frame.yields[stride.at]) };
            if !*begun {
                begin(block, &stride, (index, link), axes);
            }
        });
        link.coordinate.compliance = if link.class == JointClass::Distance { yields } else { 0.0 };
        let (a, b) = (&nodes[link.a as usize], &nodes[link.b as usize]);
        let rounding = ROUNDING * f64::from(substep.unit * substep.unit) * (a.inv[2] + b.inv[2]);
        for i in 0..link.rigid {
            let along = [0, 1].map(|side: usize| link.reach[side][i] * link.reach[side][i]);
            let least = LOCKED * (a.inv[2] * along[0] + b.inv[2] * along[1]);
            let give = give(&link.row(i), a, b).max(least);
            let give = if give > rounding { give } else { UNANSWERED };
            link.compliance[i] = COMPLIANCE.max(yields) * give;
        }
    }
    sum_stiffness(nodes, links, axes);
    *torn = heed(nodes, substep.h.into(), open(links));
    if !*begun {
        nodes.iter_mut().for_each(|node| node.taut = node.inv[2]);
    }
    for axis in axes {
        let link = &mut links[axis.link as usize];
        tie(simd, link, axis, &nodes[link.a as usize], &nodes[link.b as usize]);
        let unit = if link.class == JointClass::Revolute { 1.0 } else { f64::from(substep.unit) };
        axis.soft = may_yield && axis.is_limit_only() && axis.overrun(link.value) > BENT * unit;
    }
    (*begun, *fresh, *factored) = (true, true, false);
    if is_jointed(*pace) {
        // Not to anchors, which trees share.
        nodes[..*dynamic].iter().for_each(|node| give_inertia(rows, node.body, node.inv[2]));
    }
}

/// Gives the bodies their own moments of inertia back.
pub(super) fn restore(tree: &JointTree, rows: SharedRows<'_>) {
    if tree.begun {
        let nodes = &tree.nodes[..tree.dynamic];
        nodes.iter().for_each(|node| give_inertia(rows, node.body, node.own_inv_inertia));
    }
}

fn give_inertia(rows: SharedRows<'_>, body: u32, inverse: f64) {
    rows.update(body, |row| {
        if inverses::<f32>((), row)[2] > 0.0 {
            row[Slot::INV_INERTIA] = (inverse as f32).copysign(row[Slot::INV_INERTIA]);
        }
    });
}

/// What has become stiffer against turning than it was keeps its angular momentum: turning on as fast, it would have as much more energy
/// as inertia, and joints would hand that on.
pub(super) fn slow(node: &mut TreeNode, inverse: f64) {
    if inverse < node.taut {
        node.v[2] *= inverse / node.taut;
        node.taut = inverse;
    }
}

/// Makes bodies as stiff against turning as the impulses of the substep say, where those have grown much since the substep before:
/// what is drawn taut may not turn on as if it were slack.
pub(super) fn tighten(tree: &mut JointTree, h: f64) {
    let JointTree { nodes, links, axes, factored, .. } = tree;
    sum_stiffness(nodes, links, axes);
    for node in nodes {
        let asked = stiff(node.own_inv_inertia, h * node.g[2]);
        if asked * TAUTER < node.taut {
            slow(node, asked);
            (node.inv[2], *factored) = (asked, false);
        } else if asked > node.taut {
            node.taut = asked;
        }
    }
}

/// The other half of backward Euler: what is stiff against turning keeps its angular momentum with the greater
/// inertia, and so turns more slowly.
#[inline(always)]
pub(super) fn damp(tree: &mut JointTree) {
    for node in &mut tree.nodes {
        if node.inv[2] < node.own_inv_inertia {
            node.v[2] *= node.inv[2] / node.own_inv_inertia;
        }
    }
}

/// Rubs in the joints of what is stiff against turning, where substeps are longer or shorter than before: inertias that go with
/// their length pump energy into what swings within the tree.
pub(super) fn brake(tree: &mut JointTree) {
    let JointTree { nodes, links, .. } = tree;
    for &TreeLink { a, b, .. } in &*links {
        let [own, other] = [&nodes[a as usize], &nodes[b as usize]];
        let (ia, ib) = (own.inv[2], other.inv[2]);
        let firm = |node: &TreeNode| 1.0 - node.inv[2] / node.own_inv_inertia;
        if ia > 0.0 && ib > 0.0 {
            let share = firm(own).max(firm(other));
            let impulse = share * (other.v[2] - own.v[2]) / (ia + ib);
            nodes[a as usize].v[2] += ia * impulse;
            nodes[b as usize].v[2] -= ib * impulse;
        }
    }
}

/// Sums up (in `g`) what the joint's force adds to the stiffness of its bodies against turning.
///
/// Rods turn their force too, which makes beads on them stiff against moving. Counting it into their masses made
/// things worse: masses that change with the tension pump energy into what moves.
fn stiffen(link: &TreeLink, nodes: &mut [TreeNode], rows: usize, impulse: impl Fn(usize) -> f64) {
    for i in 0..rows {
        nodes[link.a as usize].g[2] -= link.reach[0][i] * impulse(i);
        nodes[link.b as usize].g[2] += link.reach[1][i] * impulse(i);
    }
}

/// The same of all joints.
fn sum_stiffness(nodes: &mut [TreeNode], links: &[TreeLink], axes: &[TreeAxis]) {
    nodes.iter_mut().for_each(|node| node.g = [0.0; 4]);
    links.iter().for_each(|link| stiffen(link, nodes, link.rigid, |i| link.impulses[i]));
    let ropes = axes.iter().filter(|it| links[it.link as usize].class == JointClass::Distance);
    ropes.for_each(|it| stiffen(&links[it.link as usize], nodes, 1, |_| it.axis.total()));
}

/// How far joints are open at most.
fn open(links: &[TreeLink]) -> f64 {
    let mut open = 0.0;
    for TreeLink { error, jacobians, .. } in links {
        for (error, [x, y, ..]) in error.iter().zip(&jacobians[1].rows) {
            // Angles have no length.
            let is_length = *x != 0.0 || *y != 0.0;
            open = if is_length && error.abs() > open { error.abs() } else { open };
        }
    }
    open
}

/// An inverse moment of inertia that is no less than that.
fn stiff(inverse: f64, least: f64) -> f64 {
    if inverse * least > 1.0 { 1.0 / least } else { inverse }
}

/// Gives nodes moments of inertia that are as stiff as `g` says, and no less than their masses have on arms as long as joints are open.
/// Is any of them torn so?
fn heed(nodes: &mut [TreeNode], h: f64, open: f64) -> bool {
    let mut torn = false;
    for node in nodes {
        let (least, inv) = (h * node.g[2], node.inv[0].max(node.inv[1]));
        node.inv[2] = stiff(node.inv[2], least);
        if node.inv[2] * open * open > inv && inv > 0.0 {
            node.inv[2] = inv / (open * open);
            torn = true;
        }
    }
    torn
}

/// Makes bodies as stiff against turning as the errors would pull at them were none made good: along a line that is stretched an error
/// falls with the square of a turn, and by its slope alone the turn would be too wide.
pub(super) fn stiffen_errors(JointTree { nodes, links, factored, .. }: &mut JointTree, h: f64) {
    for node in nodes.iter_mut() {
        (node.g, node.inv[3]) = ([0.0; 4], node.inv[2]);
    }
    links
        .iter()
        .for_each(|link| stiffen(link, nodes, link.rigid, |i| link.rhs[i] / link.compliance[i]));
    heed(nodes, h, 0.0);
    *factored = false;
}

/// Works out how the two bodies of a link answer an impulse along its free coordinate, as its rigid rows tie them.
#[inline(always)]
fn tie<S: Simd>(simd: S, link: &mut TreeLink, axis: &mut TreeAxis, a: &TreeNode, b: &TreeNode) {
    let own = link.coordinate.on;
    let free = give(&own, a, b);
    link.coordinate.compliance = COMPLIANCE.max(link.coordinate.compliance) * free;
    let (mut coupling, mut mass) = ([0.0; 4], [[0.0; 4]; 3]);
    for i in 0..link.rigid {
        coupling[i] = response(&link.row(i), &own, a, b);
        for (j, mass) in mass[i].iter_mut().enumerate().take(link.rigid).skip(i) {
            *mass = response(&link.row(i), &link.row(j), a, b);
        }
        mass[i][i] = give(&link.row(i), a, b);
    }
    let per = times(simd, &invert(&mass, link.rigid), &coupling);
    let (tied, least) = (free - dot3(&coupling, &per), f64::from(LEAST_COMPLEMENT) * free);
    axis.tied = if tied > least { tied } else { least };
    axis.given = per.map(|x| -x);
    axis.on = own;
    for i in 0..link.rigid {
        for (sum, on) in axis.on.iter_mut().zip(&link.row(i)) {
            add_times(simd, sum, on, axis.given[i]);
        }
    }
    // A motor bears nothing where nothing can move.
    let driven = if free < UNANSWERED { axis.tied } else { 0.0 };
    (link.drive, axis.driven) = (link.coordinate, driven);
    if link.turns {
        axis.driven = a.inv[2] + b.inv[2];
        link.drive = TreeRow { on: ABOUT, compliance: COMPLIANCE * axis.driven, ..link.drive };
    }
}

/// Inverse mass of the two bodies against an impulse on one row, by the second.
fn response(first: &[Three; 2], second: &[Three; 2], a: &TreeNode, b: &TreeNode) -> f64 {
    let of = |side: usize, node: &TreeNode| {
        let (first, second) = (&first[side], &second[side]);
        let ([x, y, turn, _], along) = (node.inv, [first[0] * second[0], first[1] * second[1]]);
        let linear = if x == y { x * (along[0] + along[1]) } else { x * along[0] + y * along[1] };
        linear + turn * first[2] * second[2]
    };
    of(0, a) + of(1, b)
}

/// The same by itself, as [`give_along`] has it; what makes it let go where nothing answers.
fn give(row: &[Three; 2], a: &TreeNode, b: &TreeNode) -> f64 {
    let of = |[u, v, turn, _]: Three, TreeNode { inv: [x, y, inertia, _], .. }: &TreeNode| {
        give_along((), [u, v], [*x, *y]) + inertia * turn * turn
    };
    let give = of(row[0], a) + of(row[1], b);
    if give > 0.0 { give } else { UNANSWERED }
}

/// Applies an impulse along a row to both bodies of a link.
#[inline(always)]
pub(super) fn push<S: Simd>(
    simd: S,
    nodes: &mut [TreeNode],
    ends: [u32; 2],
    on: &[Three; 2],
    impulse: f64,
) {
    for (end, row) in ends.into_iter().zip(on) {
        let node = &mut nodes[end as usize];
        let row = core::array::from_fn(|k| node.inv[k] * row[k]);
        add_times(simd, &mut node.v, &row, impulse);
    }
}
