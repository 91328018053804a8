//! Trees of joints, solved directly: every rigid row and every limit that holds at once, in linear time.
//!
//! See [`factor`] for the equations. Two things make chains under loads a thousand times their weight hold:
//!
//! - *One solve for all.* Gauss-Seidel passes an impulse on from joint to joint; a solve of the whole tree has
//!   no ratio of masses to fear.
//! - *Geometric stiffness.* A link that turns under tension f is pulled back by r x f, and faster than a
//!   substep can follow where the link is light. Its moment of inertia counts as at least `h sum r . p`, with
//!   impulses p at arms r (S. Andrews, M. Teichmann, P. Kry, "Geometric Stiffness for Real-time Constrained
//!   Multibody Dynamics", 2017): no link swings faster than the substeps come.
//!
//! Springs and motors act joint by joint before the tree is solved; limits join it one by one as they are found
//! to hold, and leave it where they would pull.

mod factor;
mod rows;
#[cfg(test)]
mod tests;

use super::Pass;
use super::parts::{SNAP, SNAP_SHARE, Substep};
use crate::dynamics::{
    JOINTED, JointClass, JointColour, JointTree, Joints, Motion, TreeAxis, TreeLink, TreeNode,
};
use crate::simd::{
    DoubleKernel, Simd, SimdLevel, Three, add_times, dispatch_doubles, take_product,
};
use crate::threads::{SharedRows, Team};

/// Part of a position error that a substep takes away. What is missing at 0.25 is energy: a double pendulum keeps 0.91
/// of its in a minute, at 1 0.99.
const PUSH: f64 = 1.0;
/// The same where the tree touches something: contacts do not know of it. Of 42 ropes of 10 to 32 links dropped on
/// a floor 2 never came to rest, at 0.5 it was 5, at 1 6.
const TOUCHED_PUSH: f64 = 0.25;
/// Most solves in a pass to find the limits that hold.
const MOST_SOLVES: usize = 4;
/// Velocity at a limit that does not matter, metres or radians a second.
const LEAST_OVERRUN: f64 = 1.0e-5;
/// Trees that one member of the team works on at a time.
const CHUNK: usize = 4;
/// Turn in a substep up to which the circles of anchors are followed, radians.
const FASTEST_SWING: f64 = 0.2;

/// Takes over what the lanes of a pace's trees hold, once their own preparation is done.
pub(crate) fn prepare(
    team: &Team,
    pace: usize,
    lanes: &JointColour,
    trees: &mut [JointTree],
    joints: &Joints,
    motions: &[Motion],
) {
    team.for_each_chunk_mut(trees, CHUNK, |_, trees| {
        of_pace(trees, pace).for_each(|tree| {
            rows::prepare(tree, lanes, joints);
            for node in &mut tree.nodes[..tree.dynamic] {
                let Motion { gain, .. } = &motions[node.body as usize];
                node.half_gain = [gain[0], gain[1], gain[2], 0.0].map(|x| 0.5 * f64::from(x));
            }
        });
    });
}

/// Gives the impulses to the lanes, where loads are read and frames keep them.
pub(crate) fn finish(pace: usize, trees: &mut [JointTree], lanes: &mut JointColour) {
    of_pace(trees, pace).for_each(|tree| rows::finish(tree, lanes));
}

/// Runs a pass over the trees of a pace.
pub(crate) fn run(
    team: &Team,
    level: SimdLevel,
    pace: usize,
    pass: Pass,
    substep: Substep,
    bodies: SharedRows<'_>,
    trees: &mut [JointTree],
) {
    if pass == Pass::Finish {
        if pace == JOINTED {
            of_pace(trees, pace).for_each(|tree| rows::restore(tree, bodies));
        }
        return;
    }
    team.for_each_chunk_mut(trees, CHUNK, |_, trees| {
        dispatch_doubles(level, RunPass(pass, substep, bodies, trees, pace));
    });
}

/// A pass over some trees.
struct RunPass<'a>(Pass, Substep, SharedRows<'a>, &'a mut [JointTree], usize);

impl DoubleKernel for RunPass<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self(pass, substep, bodies, trees, pace) = self;
        for tree in of_pace(trees, pace) {
            run_tree(simd, pass, substep, bodies, tree);
        }
    }
}

/// How all bodies of a tree answer impulses on some of its nodes: for each of these, for each body, the changes of velocity per
/// impulse along x, y and about.
pub(crate) fn answer(
    level: SimdLevel,
    tree: &mut JointTree,
    touched: &[u32],
    columns: &mut Vec<[[f32; 3]; 3]>,
) {
    dispatch_doubles(level, Answer(tree, touched, columns));
}

struct Answer<'a>(&'a mut JointTree, &'a [u32], &'a mut Vec<[[f32; 3]; 3]>);

impl DoubleKernel for Answer<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self(tree, touched, columns) = self;
        factor::factor(simd, tree);
        for &node in touched {
            let first = columns.len();
            columns.resize(first + tree.dynamic, [[0.0; 3]; 3]);
            for k in 0..3 {
                factor::answer(simd, tree, node, k);
                let all = columns[first..].iter_mut().zip(&tree.nodes);
                all.for_each(|(columns, node)| {
                    columns[k] = [0, 1, 2].map(|k: usize| node.dv[k] as f32)
                });
            }
        }
    }
}

/// The trees of a pace; those without links are none.
fn of_pace(trees: &mut [JointTree], pace: usize) -> impl Iterator<Item = &mut JointTree> {
    trees.iter_mut().filter(move |tree| tree.pace == pace && !tree.links.is_empty())
}

#[inline(always)]
fn run_tree<S: Simd>(
    simd: S,
    pass: Pass,
    substep: Substep,
    bodies: SharedRows<'_>,
    tree: &mut JointTree,
) {
    let rates = Rates::new(substep, tree.pace);
    let h = rates.h;
    let moved = pass == Pass::Relax && tree.moved;
    if moved || !tree.fresh {
        rows::refresh(simd, tree, bodies, h);
    }
    rows::load(tree, bodies);
    tree.moved = pass == Pass::Solve;
    match pass {
        Pass::WarmStart => {
            if tree.pace == JOINTED {
                rows::damp(tree);
            } else {
                kick(simd, tree, -1.0);
            }
            warm_start(simd, tree);
        }
        Pass::Solve => {
            drive::<_, true>(simd, tree);
            solve::<_, true>(simd, tree, &rates);
        }
        _ => {
            if moved && tree.pace != JOINTED {
                kick(simd, tree, 1.0);
            }
            drive::<_, false>(simd, tree);
            solve::<_, false>(simd, tree, &rates);
        }
    }
    rows::store(tree, bodies);
}

/// Adds or takes away half of what forces add in a substep: they act half before it and half after it, which
/// makes the swing of a free tree exact to second order.
#[inline(always)]
fn kick<S: Simd>(simd: S, tree: &mut JointTree, sign: f64) {
    for node in &mut tree.nodes {
        add_times(simd, &mut node.v, &node.half_gain, sign);
    }
}

/// Applies the impulses of the substep before.
#[inline(always)]
fn warm_start<S: Simd>(simd: S, tree: &mut JointTree) {
    let JointTree { nodes, links, axes, .. } = tree;
    for link in links {
        let ends = [link.a, link.b];
        for i in 0..link.rigid {
            let row = [link.jacobians[0].rows[i], link.jacobians[1].rows[i]];
            rows::push(simd, nodes, ends, &row, link.impulses[i]);
        }
        if let Some(axis) = axes.get(link.axis as usize) {
            let total = axis.spring + axis.motor + axis.limit[0] - axis.limit[1];
            rows::push(simd, nodes, ends, &link.coordinate.on, total);
        }
        if link.class == JointClass::Wheel {
            turn(nodes, ends, f64::from(link.motor[2]));
        }
    }
}

/// Applies an angular impulse on B, the opposite on A.
fn turn(nodes: &mut [TreeNode], [a, b]: [u32; 2], impulse: f64) {
    let (ia, ib) = (nodes[a as usize].inv[2], nodes[b as usize].inv[2]);
    nodes[a as usize].v[2] -= ia * impulse;
    nodes[b as usize].v[2] += ib * impulse;
}

/// Springs and motors, joint by joint.
#[inline(always)]
fn drive<S: Simd, const BIAS: bool>(simd: S, tree: &mut JointTree) {
    let JointTree { nodes, links, axes, .. } = tree;
    for link in links {
        if link.class == JointClass::Wheel && (link.motor[1] > 0.0 || link.motor[2] != 0.0) {
            drive_wheel(link, nodes);
        }
        if let Some(axis) = axes.get_mut(link.axis as usize)
            && (BIAS && axis.soft[1] != 0.0 || axis.motor_max != 0.0)
        {
            drive_axis::<S, BIAS>(simd, link, axis, nodes);
        }
    }
}

fn drive_wheel(link: &mut TreeLink, nodes: &mut [TreeNode]) {
    let (a, b) = (&nodes[link.a as usize], &nodes[link.b as usize]);
    let (inv, spin) = (a.inv[2] + b.inv[2], b.v[2] - a.v[2]);
    let [speed, max, old] = link.motor;
    let wanted = if inv > 0.0 { (f64::from(speed) - spin) / inv } else { 0.0 };
    let impulse = (old + wanted as f32).max(-max).min(max);
    link.motor[2] = impulse;
    turn(nodes, [link.a, link.b], f64::from(impulse - old));
}

/// Along the free coordinate, with the mass of the two bodies as the joint's rigid rows tie them: as
/// [`AxisLanes::solve`](crate::dynamics::AxisLanes) does.
#[inline(always)]
fn drive_axis<S: Simd, const BIAS: bool>(
    simd: S,
    link: &mut TreeLink,
    axis: &mut TreeAxis,
    nodes: &mut [TreeNode],
) {
    let (a, b) = (&nodes[link.a as usize], &nodes[link.b as usize]);
    let mut velocity = rows::velocity(&link.coordinate.on, a, b);
    let mass = if axis.tied > 0.0 { 1.0 / axis.tied } else { 0.0 };
    let mut change = 0.0;
    if BIAS {
        let [push, share, decay] = axis.soft;
        let demand = share * velocity + push * (link.value - axis.rest);
        change = -mass * demand - decay * axis.spring;
        axis.spring += change;
        velocity += axis.tied * change;
    }
    let held = axis.limit[0] - axis.limit[1];
    let wanted = axis.motor + mass * (axis.motor_speed - (velocity - axis.tied * held));
    let motor = clamp(wanted, axis.motor_max);
    change += motor - axis.motor;
    axis.motor = motor;
    rows::push(simd, nodes, [link.a, link.b], &axis.on, change);
    for (impulse, given) in link.impulses[..link.rigid].iter_mut().zip(axis.given) {
        *impulse += given * change;
    }
}

/// At most `most` either way.
fn clamp(value: f64, most: f64) -> f64 {
    let value = if value > -most { value } else { -most };
    if value < most { value } else { most }
}

/// Solves the rigid rows together with the limits that hold.
///
/// Which do is not known before: those that pushed before, and those that would be overrun, begin. A limit that
/// would have to pull goes, one that is overrun comes, and the tree is solved again.
#[inline(always)]
fn solve<S: Simd, const BIAS: bool>(simd: S, tree: &mut JointTree, rates: &Rates) {
    begin_limits::<S, BIAS>(simd, tree, rates);
    let share = if BIAS { snap_share(simd, tree, rates) } else { 0.0 };
    for _ in 0..MOST_SOLVES {
        factor::factor(simd, tree);
        demand::<S, BIAS>(simd, tree, rates, share);
        factor::solve(simd, tree);
        apply(simd, tree);
        if !change_limits::<S, BIAS>(simd, tree, rates) {
            break;
        }
    }
}

/// What a tree does to position errors in a substep.
struct Rates {
    h: f64,
    /// Part that is taken away.
    push: f64,
    /// Position errors move no body faster than this: metres and radians a second.
    snap: [f64; 2],
}

impl Rates {
    fn new(Substep { inv_h, unit, .. }: Substep, pace: usize) -> Self {
        let snap = [f64::from(SNAP * unit * inv_h), f64::from(SNAP * inv_h)];
        let push = if pace == JOINTED { TOUCHED_PUSH } else { PUSH };
        Self { h: 1.0 / f64::from(inv_h), push, snap }
    }

    /// Velocity that a limit asks for: within the substep it may be reached, but not passed. An overrun goes as it
    /// does in lanes, softly while it is small, and no faster than what the limit has taken.
    #[inline(always)]
    fn limit_bias<const BIAS: bool>(&self, class: JointClass, room: f64, taken: f64) -> f64 {
        if room > 0.0 {
            return room / self.h;
        }
        let snap = self.snap[usize::from(class == JointClass::Revolute)];
        let (soft, firm) = (TOUCHED_PUSH * room, room + f64::from(super::axis::SOFT_OVERRUN));
        let push = if firm < soft { firm } else { soft } / self.h;
        let least = -(snap + taken);
        match BIAS {
            false => 0.0,
            true if push < least => least,
            true => push,
        }
    }

    /// Velocity that the error of a rigid row asks for.
    fn rigid_bias(&self, error: f64) -> f64 {
        self.push * error / self.h
    }
}

/// The part of all position errors that is taken away: they may add up along a tree, and to make them good at once would
/// hurl it about. What they alone would do tells.
#[inline(always)]
fn snap_share<S: Simd>(simd: S, tree: &mut JointTree, rates: &Rates) -> f64 {
    let [most, most_turn] = rates.snap;
    let (mut sum, mut largest) = (0.0, 0.0);
    for link in &mut tree.links {
        link.rhs = link.error.map(|error| -rates.rigid_bias(error));
        sum += link.rhs[0].abs() + link.rhs[1].abs() + link.rhs[2].abs();
        for (error, [x, y, ..]) in link.error.iter().zip(&link.jacobians[1].rows) {
            // Angles have no unit of length.
            let unit = if *x == 0.0 && *y == 0.0 { 1.0 } else { most / most_turn };
            largest = if error.abs() > largest * unit { error.abs() / unit } else { largest };
        }
    }
    let grown = 1.0 + f64::from(SNAP_SHARE / SNAP) * largest;
    let (most, most_turn) = (most * grown, most_turn * grown);
    if sum < most {
        return 1.0;
    }
    factor::factor(simd, tree);
    factor::solve(simd, tree);
    let mut over = 1.0;
    for node in &tree.nodes[..tree.dynamic] {
        let [x, y, turn, _] = node.dv;
        let (way, turn) = ((x * x + y * y).sqrt() / most, turn.abs() / most_turn);
        let most = if way > turn { way } else { turn };
        over = if most > over { most } else { over };
    }
    1.0 / over
}

/// What is missing in the velocity at the lower (1) or upper (-1) limit; above 0 where it would be overrun.
#[inline(always)]
fn overrun<const BIAS: bool>(
    link: &TreeLink,
    axis: &TreeAxis,
    velocity: f64,
    side: f64,
    rates: &Rates,
) -> f64 {
    let Some(ends) = axis.limits else { return -f64::MAX };
    let at = usize::from(side < 0.0);
    let (velocity, stopped) = (side * velocity, axis.free * axis.limit[at]);
    let room = side * (link.value - ends[at]);
    let taken = if velocity < 0.0 { stopped - velocity } else { stopped };
    -(velocity + rates.limit_bias::<BIAS>(link.class, room, taken))
}

/// Velocity along the free coordinate of a link.
fn velocity(link: &TreeLink, nodes: &[TreeNode]) -> f64 {
    rows::velocity(&link.coordinate.on, &nodes[link.a as usize], &nodes[link.b as usize])
}

/// The accumulated impulse of a limit.
fn limit_impulse(axis: &mut TreeAxis, side: f64) -> &mut f64 {
    &mut axis.limit[usize::from(side < 0.0)]
}

/// Takes back what a limit has given.
#[inline(always)]
fn release<S: Simd>(
    simd: S,
    link: &TreeLink,
    axis: &mut TreeAxis,
    nodes: &mut [TreeNode],
    side: f64,
) {
    let impulse = core::mem::take(limit_impulse(axis, side));
    rows::push(simd, nodes, [link.a, link.b], &link.coordinate.on, -side * impulse);
}

/// Begins with the limits that pushed or would be overrun.
#[inline(always)]
fn begin_limits<S: Simd, const BIAS: bool>(simd: S, tree: &mut JointTree, rates: &Rates) {
    let JointTree { nodes, links, axes, factored, .. } = tree;
    for link in links {
        let axis = axes.get_mut(link.axis as usize).filter(|axis| axis.limits.is_some());
        let Some(axis) = axis else { continue };
        let velocity = velocity(link, nodes);
        let wants = |impulse: f64, side: f64| {
            impulse > 0.0 || overrun::<BIAS>(link, axis, velocity, side, rates) > 0.0
        };
        let side = if wants(axis.limit[0], 1.0) {
            1.0
        } else if wants(axis.limit[1], -1.0) {
            -1.0
        } else {
            0.0
        };
        if side > 0.0 && axis.limit[1] != 0.0 {
            release(simd, link, axis, nodes, -1.0);
        }
        if side != link.limit {
            link.limit = side;
            *factored = false;
        }
    }
}

/// Lets go of limits that pull, takes hold of those that are overrun. Has anything changed?
#[inline(always)]
fn change_limits<S: Simd, const BIAS: bool>(simd: S, tree: &mut JointTree, rates: &Rates) -> bool {
    let JointTree { nodes, links, axes, factored, .. } = tree;
    let mut changed = false;
    for link in links {
        let axis = axes.get_mut(link.axis as usize).filter(|axis| axis.limits.is_some());
        let Some(axis) = axis else { continue };
        if link.limit != 0.0 {
            if *limit_impulse(axis, link.limit) < 0.0 {
                release(simd, link, axis, nodes, link.limit);
                link.limit = 0.0;
                changed = true;
            }
            continue;
        }
        let velocity = velocity(link, nodes);
        for side in [1.0, -1.0] {
            if overrun::<BIAS>(link, axis, velocity, side, rates) > LEAST_OVERRUN {
                link.limit = side;
                changed = true;
            }
        }
    }
    *factored &= !changed;
    changed
}

/// Right sides: minus what the velocities and position errors are short of.
#[inline(always)]
fn demand<S: Simd, const BIAS: bool>(simd: S, tree: &mut JointTree, rates: &Rates, share: f64) {
    let JointTree { nodes, links, axes, .. } = tree;
    for link in links {
        let (a, b) = (&nodes[link.a as usize], &nodes[link.b as usize]);
        let mut rhs = [0.0; 4];
        if BIAS {
            rhs = curve(simd, link, a, b, rates.h);
            let rows = link.error.iter().zip(&link.compliance).zip(&link.impulses);
            for (rhs, ((error, compliance), impulse)) in rhs.iter_mut().zip(rows) {
                *rhs -= share * rates.rigid_bias(1.0) * error + compliance * impulse;
            }
        }
        take_product(simd, &mut rhs, &link.jacobians[1].columns, &b.v);
        take_product(simd, &mut rhs, &link.jacobians[0].columns, &a.v);
        if let Some(axis) = axes.get_mut(link.axis as usize)
            && link.limit != 0.0
        {
            let velocity = rows::velocity(&link.coordinate.on, a, b);
            let mut wanted = overrun::<BIAS>(link, axis, velocity, link.limit, rates);
            if BIAS {
                wanted -= link.coordinate.compliance * *limit_impulse(axis, link.limit);
            }
            rhs[link.rigid] = wanted;
        }
        link.rhs = rhs;
    }
}

/// What the circles of anchors and rods take from the mean velocities over a substep, to second order:
/// `h w^2 r / 2` for an anchor, `-h vt^2 / (2 d)` for a rod.
#[inline(always)]
fn curve<S: Simd>(simd: S, link: &TreeLink, a: &TreeNode, b: &TreeNode, h: f64) -> Three {
    let mut sums = [0.0; 4];
    if matches!(link.class, JointClass::Prismatic | JointClass::Wheel | JointClass::Gear) {
        return sums;
    }
    let inward = |w: f64| 0.5 * w * slow_turn(h * w);
    add_times(simd, &mut sums, &link.reach[1], inward(b.v[2]));
    add_times(simd, &mut sums, &link.reach[0], -inward(a.v[2]));
    if link.class == JointClass::Distance && link.value > 0.0 {
        let [x, y, ..] = link.jacobians[1].rows[0];
        let across = x * (b.v[1] - a.v[1]) - y * (b.v[0] - a.v[0])
            + (link.reach[1][0] * b.v[2] - link.reach[0][0] * a.v[2]);
        sums[0] -= 0.5 * across * slow_turn(h * across / link.value);
    }
    sums
}

/// A turn in a substep, which fades out towards [`FASTEST_SWING`].
fn slow_turn(turn: f64) -> f64 {
    let fade = 1.0 - turn * turn / (FASTEST_SWING * FASTEST_SWING);
    if fade > 0.0 { turn * fade } else { 0.0 }
}

/// Adds the solution to velocities and impulses.
#[inline(always)]
fn apply<S: Simd>(simd: S, tree: &mut JointTree) {
    let JointTree { nodes, dynamic, links, axes, .. } = tree;
    for node in &mut nodes[..*dynamic] {
        add_times(simd, &mut node.v, &node.dv, 1.0);
    }
    for link in links {
        if let Some(axis) = axes.get_mut(link.axis as usize)
            && link.limit != 0.0
        {
            *limit_impulse(axis, link.limit) += core::mem::take(&mut link.change[link.rigid]);
        }
        add_times(simd, &mut link.impulses, &link.change, 1.0);
    }
}
