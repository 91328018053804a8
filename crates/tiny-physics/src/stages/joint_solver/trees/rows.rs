//! The rows of a tree's joints: what they take from the joints' lanes, and what follows from the bodies' places.
//!
//! Equations are those of the lane kernels; see [`revolute`](super::super::revolute) and its neighbours.

use super::factor::{dot3, invert};
use crate::dynamics::{
    AngleLanes, AxisLanes, DirectionLanes, FrameLanes, JOINTED, JointClass, JointColour,
    JointPlace, JointTree, Joints, NULL, Slot, TreeAxis, TreeLink, TreeNode, TreeRow, UNLIMITED,
    joint_classes, with_bucket,
};
use crate::math::Rot;
use crate::simd::{BLOCK, Simd, Three, add_times, times};
use crate::stages::joint_solver::parts::LEAST_COMPLEMENT;
use crate::threads::SharedRows;

/// Compliance of a rigid row, as a fraction of the inverse mass of its two bodies alone: it bears loops that cannot
/// close, such as a plank pinned at two points too far apart. Of a chain of 30 links it makes most of the stretch
/// under 1000 times a link's weight: 0.13 % at 1e-4, 0.039 % at 3e-5; at 1e-6 rounding made it 0.5 %.
const COMPLIANCE: f64 = 3.0e-5;

/// Takes over what the lanes hold: places at the start of the step, impulses.
pub(super) fn prepare(tree: &mut JointTree, lanes: &JointColour, joints: &Joints) {
    let JointTree { links, axes, begun, fresh, factored, .. } = tree;
    axes.clear();
    (*begun, *fresh, *factored) = (false, false, false);
    for link in links {
        let JointPlace::Graph { slot, .. } = joints.records[link.joint as usize].place else {
            debug_assert!(false, "a joint of a tree has no lanes");
            continue;
        };
        link.slot = slot;
        link.axis = NULL;
        link.limit = 0.0;
        read(link, axes, lanes);
    }
}

fn read(link: &mut TreeLink, axes: &mut Vec<TreeAxis>, lanes: &JointColour) {
    let (at, lane) = (link.slot as usize / BLOCK, link.slot as usize % BLOCK);
    let saved = with_bucket!(ref lanes, link.class, bucket => {
        read_frame(link, &bucket.blocks[at].frame, lane);
        bucket.saved(link.slot)
    });
    link.rigid = match link.class {
        JointClass::Distance | JointClass::Wheel | JointClass::Gear => 1,
        JointClass::Weld => 3,
        _ => 2,
    };
    link.impulses = [0.0; 4];
    for (impulse, saved) in link.impulses[..link.rigid].iter_mut().zip(saved) {
        *impulse = f64::from(saved);
    }
    match link.class {
        JointClass::Distance => {
            link.length = f64::from(lanes.distance.blocks[at].length.length[lane]);
        }
        JointClass::Prismatic => {
            let block = &lanes.prismatic.blocks[at];
            read_angle(link, &block.angle, lane);
            read_direction(link, &block.direction, lane);
            read_axis(link, axes, &block.axis, lane);
        }
        JointClass::Weld => read_angle(link, &lanes.weld.blocks[at].angle, lane),
        JointClass::Wheel => {
            let block = &lanes.wheel.blocks[at];
            read_direction(link, &block.direction, lane);
            read_axis(link, axes, &block.axis, lane);
            let motor = &block.motor;
            link.motor = [motor.speed[lane], motor.max[lane], motor.impulse[lane]];
        }
        JointClass::Gear => {
            let gear = &lanes.gear.blocks[at].gear;
            let a = [gear.slide_a_x[lane], gear.slide_a_y[lane], gear.spin_a[lane]];
            let b = [gear.slide_b_x[lane], gear.slide_b_y[lane], gear.spin_b[lane]];
            link.mesh = [a.map(f64::from), b.map(f64::from)];
            link.angle = f64::from(gear.error[lane]);
        }
        _ => {
            let block = &lanes.revolute.blocks[at];
            read_angle(link, &block.angle, lane);
            read_axis(link, axes, &block.axis, lane);
        }
    }
}

fn read_frame(link: &mut TreeLink, frame: &FrameLanes, lane: usize) {
    let pair = |x: &[f32; BLOCK], y: &[f32; BLOCK]| [f64::from(x[lane]), f64::from(y[lane])];
    link.anchor_a = pair(&frame.a_x, &frame.a_y);
    link.anchor_b = pair(&frame.b_x, &frame.b_y);
    link.between = pair(&frame.between_x, &frame.between_y);
}

fn read_angle(link: &mut TreeLink, angle: &AngleLanes, lane: usize) {
    link.angle = f64::from(angle.start[lane]);
}

fn read_direction(link: &mut TreeLink, direction: &DirectionLanes, lane: usize) {
    link.direction = [f64::from(direction.x[lane]), f64::from(direction.y[lane])];
}

fn read_axis(link: &mut TreeLink, axes: &mut Vec<TreeAxis>, axis: &AxisLanes, lane: usize) {
    if axis.used[lane] == 0.0 {
        return;
    }
    let of = |lanes: &[f32; BLOCK]| f64::from(lanes[lane]);
    let limited = axis.lower[lane] > -UNLIMITED || axis.upper[lane] < UNLIMITED;
    link.axis = axes.len() as u32;
    axes.push(TreeAxis {
        soft: [of(&axis.push), of(&axis.mass_scale), of(&axis.impulse_scale)],
        rest: of(&axis.rest),
        motor_speed: of(&axis.motor_speed),
        motor_max: of(&axis.motor_max),
        limits: limited.then(|| [of(&axis.lower), of(&axis.upper)]),
        spring: of(&axis.spring),
        motor: of(&axis.motor),
        limit: [of(&axis.lower_impulse), of(&axis.upper_impulse)],
        ..TreeAxis::default()
    });
}

/// Gives the impulses, and the directions in which they act, back to the lanes.
pub(super) fn finish(tree: &JointTree, lanes: &mut JointColour) {
    for link in &tree.links {
        let mut saved = with_bucket!(ref lanes, link.class, bucket => bucket.saved(link.slot));
        for (saved, impulse) in saved.iter_mut().zip(&link.impulses[..link.rigid]) {
            *saved = *impulse as f32;
        }
        let mut rest = link.rigid;
        match link.class {
            JointClass::Wheel => {
                saved[rest] = link.motor[2];
                rest += 1;
            }
            JointClass::Gear => saved[rest] = link.error[0] as f32,
            _ => {}
        }
        if let Some(axis) = tree.axes.get(link.axis as usize) {
            let impulses = [axis.spring, axis.motor, axis.limit[0], axis.limit[1]];
            saved[rest..rest + 4].copy_from_slice(&impulses.map(|impulse| impulse as f32));
        }
        with_bucket!(mut lanes, link.class, bucket => bucket.restore(link.slot, &saved));
        write_direction(link, lanes);
    }
}

/// The direction that a joint's load is told along.
fn write_direction(link: &TreeLink, lanes: &mut JointColour) {
    let (at, lane) = (link.slot as usize / BLOCK, link.slot as usize % BLOCK);
    let [x, y] = [0, 1].map(|k: usize| link.jacobians[1].rows[0][k] as f32);
    let direction = match link.class {
        JointClass::Distance => {
            let length = &mut lanes.distance.blocks[at].length;
            (length.now_x[lane], length.now_y[lane]) = (x, y);
            return;
        }
        JointClass::Prismatic => &mut lanes.prismatic.blocks[at].direction,
        JointClass::Wheel => &mut lanes.wheel.blocks[at].direction,
        _ => return,
    };
    // Their first row is that across.
    (direction.now_x[lane], direction.now_y[lane]) = (y, -x);
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
            if row[Slot::INV_MASS] > 0.0 {
                row[Slot::VX] = node.v[0] as f32;
                row[Slot::VY] = node.v[1] as f32;
            }
            if row[Slot::INV_INERTIA] > 0.0 {
                row[Slot::W] = node.v[2] as f32;
            }
        });
    }
}

/// Works the rows out for where the bodies are now. `h` is the substep length.
#[inline(always)]
pub(super) fn refresh<S: Simd>(simd: S, tree: &mut JointTree, rows: SharedRows<'_>, h: f64) {
    let JointTree { nodes, links, axes, pace, begun, fresh, factored, .. } = tree;
    for node in nodes.iter_mut() {
        let row = rows.read(node.body);
        if !*begun {
            node.own_inv_inertia = f64::from(row[Slot::INV_INERTIA]);
        }
        node.d = [Slot::DX, Slot::DY, Slot::DA].map(|slot| f64::from(row[slot]));
        let turn = Rot::IDENTITY.integrate(row[Slot::DA]);
        node.turn = [f64::from(turn.c), f64::from(turn.s)];
        let inv_mass = f64::from(row[Slot::INV_MASS]);
        node.inv = [inv_mass, inv_mass, node.own_inv_inertia, 0.0];
        node.g = [0.0; 4];
    }
    for link in links.iter_mut() {
        write_rows(link, nodes);
        stiffen(link, nodes);
    }
    for node in nodes.iter_mut() {
        let least = h * node.g[2];
        if node.inv[2] * least > 1.0 {
            node.inv[2] = 1.0 / least;
        }
    }
    for link in links.iter_mut() {
        if let Some(axis) = axes.get_mut(link.axis as usize) {
            tie(simd, link, axis, &nodes[link.a as usize], &nodes[link.b as usize]);
        }
    }
    (*begun, *fresh, *factored) = (true, true, false);
    if *pace == JOINTED {
        nodes.iter().for_each(|node| give_inertia(rows, node.body, node.inv[2]));
    }
}

/// Gives the bodies their own moments of inertia back.
pub(super) fn restore(tree: &JointTree, rows: SharedRows<'_>) {
    if tree.begun {
        tree.nodes.iter().for_each(|node| give_inertia(rows, node.body, node.own_inv_inertia));
    }
}

fn give_inertia(rows: SharedRows<'_>, body: u32, inverse: f64) {
    rows.update(body, |row| {
        if row[Slot::INV_INERTIA] > 0.0 {
            row[Slot::INV_INERTIA] = inverse as f32;
        }
    });
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

/// Sums up (in `g`) what the joint's force adds to the stiffness of its bodies against turning.
///
/// Rods turn their force too, which makes beads on them stiff against moving. Counting it into their masses made
/// things worse: masses that change with the tension pump energy into what moves.
fn stiffen(link: &TreeLink, nodes: &mut [TreeNode]) {
    for (i, impulse) in link.impulses[..link.rigid].iter().enumerate() {
        nodes[link.a as usize].g[2] -= link.reach[0][i] * impulse;
        nodes[link.b as usize].g[2] += link.reach[1][i] * impulse;
    }
}

fn rotate(turn: [f64; 2], v: [f64; 2]) -> [f64; 2] {
    [turn[0] * v[0] - turn[1] * v[1], turn[1] * v[0] + turn[0] * v[1]]
}

fn add(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The row of a direction with lever arms from both centres of mass.
fn linear(dir: [f64; 2], from_a: [f64; 2], from_b: [f64; 2], error: f64) -> TreeRow {
    TreeRow {
        on: [
            [-dir[0], -dir[1], -cross(from_a, dir), 0.0],
            [dir[0], dir[1], cross(from_b, dir), 0.0],
        ],
        reach: [dot(from_a, dir), dot(from_b, dir)],
        error,
        compliance: 0.0,
    }
}

/// The row of the angle.
fn angular(error: f64) -> TreeRow {
    TreeRow { on: [[0.0, 0.0, -1.0, 0.0], [0.0, 0.0, 1.0, 0.0]], error, ..TreeRow::default() }
}

fn write_rows(link: &mut TreeLink, nodes: &[TreeNode]) {
    let (a, b) = (&nodes[link.a as usize], &nodes[link.b as usize]);
    let (ra, rb) = (rotate(a.turn, link.anchor_a), rotate(b.turn, link.anchor_b));
    let moved = [b.d[0] - a.d[0] - ra[0], b.d[1] - a.d[1] - ra[1]];
    let gap = add(add(link.between, moved), rb);
    let angle = link.angle + (b.d[2] - a.d[2]);
    let mut rows = [TreeRow::default(); 3];
    match link.class {
        JointClass::Distance => {
            let length = dot(gap, gap).sqrt();
            let dir = if length > 1.0e-9 { [gap[0] / length, gap[1] / length] } else { [1.0, 0.0] };
            rows[0] = linear(dir, ra, rb, length - link.length);
            link.value = length;
        }
        JointClass::Prismatic | JointClass::Wheel => {
            let along = rotate(a.turn, link.direction);
            let across = [-along[1], along[0]];
            let from_a = add(gap, ra);
            rows[0] = linear(across, from_a, rb, dot(gap, across));
            rows[1] = angular(angle);
            link.coordinate = linear(along, from_a, rb, 0.0);
            link.value = dot(gap, along);
        }
        JointClass::Gear => {
            let mut error = link.angle;
            let bodies = [(a, ra, link.anchor_a), (b, rb, link.anchor_b)];
            for (side, (node, arm, start)) in bodies.into_iter().enumerate() {
                let [x, y, spin] = link.mesh[side];
                let moved = [node.d[0] + arm[0] - start[0], node.d[1] + arm[1] - start[1]];
                error += dot([x, y], moved) + spin * node.d[2];
                rows[0].on[side] = [x, y, cross(arm, [x, y]) + spin, 0.0];
            }
            rows[0].error = error;
        }
        _ => {
            rows[0] = linear([1.0, 0.0], ra, rb, gap[0]);
            rows[1] = linear([0.0, 1.0], ra, rb, gap[1]);
            rows[2] = angular(angle);
            link.coordinate = angular(0.0);
            link.value = angle;
        }
    }
    for (i, row) in rows[..link.rigid].iter_mut().enumerate() {
        row.compliance = COMPLIANCE * response(&row.on, &row.on, a, b);
        link.set_row(i, row);
    }
}

/// Works out how the two bodies of a link answer an impulse along its free coordinate, as its rigid rows tie them.
#[inline(always)]
fn tie<S: Simd>(simd: S, link: &mut TreeLink, axis: &mut TreeAxis, a: &TreeNode, b: &TreeNode) {
    let own = link.coordinate.on;
    axis.free = response(&own, &own, a, b);
    link.coordinate.compliance = COMPLIANCE * axis.free;
    let row = |i: usize| [link.jacobians[0].rows[i], link.jacobians[1].rows[i]];
    let (mut coupling, mut mass) = ([0.0; 4], [[0.0; 4]; 3]);
    for i in 0..link.rigid {
        coupling[i] = response(&row(i), &own, a, b);
        for (j, mass) in mass[i].iter_mut().enumerate().take(link.rigid).skip(i) {
            *mass = response(&row(i), &row(j), a, b);
        }
    }
    let per = times(simd, &invert(&mass, link.rigid), &coupling);
    let (tied, least) =
        (axis.free - dot3(&coupling, &per), f64::from(LEAST_COMPLEMENT) * axis.free);
    axis.tied = if tied > least { tied } else { least };
    axis.given = per.map(|x| -x);
    axis.on = own;
    for i in 0..link.rigid {
        axis.on
            .iter_mut()
            .zip(&row(i))
            .for_each(|(sum, on)| add_times(simd, sum, on, axis.given[i]));
    }
}

/// Inverse mass of the two bodies against an impulse on one row, by the second.
fn response(first: &[Three; 2], second: &[Three; 2], a: &TreeNode, b: &TreeNode) -> f64 {
    let of = |side: usize, node: &TreeNode| {
        let (first, second) = (&first[side], &second[side]);
        node.inv[0] * (first[0] * second[0] + first[1] * second[1])
            + node.inv[2] * first[2] * second[2]
    };
    of(0, a) + of(1, b)
}

/// Velocity along a row.
#[inline(always)]
pub(super) fn velocity(on: &[Three; 2], a: &TreeNode, b: &TreeNode) -> f64 {
    dot3(&on[1], &b.v) + dot3(&on[0], &a.v)
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
