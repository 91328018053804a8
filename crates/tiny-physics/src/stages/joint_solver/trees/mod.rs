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
use super::axis::Coordinate;
use super::parts::{SNAP, Stride, Substep};
use crate::dynamics::{
    AxisLanes, JOINTED, JointClass, JointColour, JointTree, Joints, Motion, TreeLink, TreeNode,
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
                node.half_gain = core::array::from_fn(|k| 0.5 * f64::from(gain[k]));
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
        of_pace(trees, pace).for_each(|tree| run_tree(pass, substep, bodies, tree));
    });
}

/// The trees of a pace; those without links are none.
fn of_pace(trees: &mut [JointTree], pace: usize) -> impl Iterator<Item = &mut JointTree> {
    trees.iter_mut().filter(move |tree| tree.pace == pace && !tree.links.is_empty())
}

fn run_tree(pass: Pass, substep: Substep, bodies: SharedRows<'_>, tree: &mut JointTree) {
    let rates = Rates::new(substep, tree.pace);
    let h = rates.h;
    let moved = pass == Pass::Relax && tree.moved;
    if moved || !tree.fresh {
        rows::refresh(tree, bodies, h);
    }
    rows::load(tree, bodies);
    tree.moved = pass == Pass::Solve;
    match pass {
        Pass::WarmStart => {
            if tree.pace == JOINTED {
                rows::damp(tree);
            } else {
                kick(tree, -1.0);
            }
            warm_start(tree);
        }
        Pass::Solve => {
            drive::<true>(tree, substep);
            solve::<true>(tree, &rates);
        }
        _ => {
            if moved && tree.pace != JOINTED {
                kick(tree, 1.0);
            }
            drive::<false>(tree, substep);
            solve::<false>(tree, &rates);
        }
    }
    rows::store(tree, bodies);
}

/// Adds or takes away half of what forces add in a substep: they act half before it and half after it, which
/// makes the swing of a free tree exact to second order.
fn kick(tree: &mut JointTree, sign: f64) {
    for node in &mut tree.nodes {
        for k in 0..3 {
            node.v[k] += sign * node.half_gain[k];
        }
    }
}

/// Applies the impulses of the substep before.
fn warm_start(tree: &mut JointTree) {
    let JointTree { nodes, links, axes, .. } = tree;
    for link in links {
        let ends = [link.a, link.b];
        for (row, impulse) in link.rows[..link.rigid].iter().zip(link.impulses) {
            rows::push(nodes, ends, row, impulse);
        }
        if let Some(axis) = axes.get(link.axis as usize) {
            rows::push(nodes, ends, &link.coordinate, f64::from(axis.total_of(0)));
        }
        if link.class == JointClass::Wheel {
            turn(nodes, ends, f64::from(link.motor[2]));
        }
    }
}

/// Applies an angular impulse on B, the opposite on A.
fn turn(nodes: &mut [TreeNode], [a, b]: [u32; 2], impulse: f64) {
    let (ia, ib) = (nodes[a as usize].inv_inertia, nodes[b as usize].inv_inertia);
    nodes[a as usize].v[2] -= ia * impulse;
    nodes[b as usize].v[2] += ib * impulse;
}

/// Springs and motors, joint by joint.
fn drive<const BIAS: bool>(tree: &mut JointTree, substep: Substep) {
    let JointTree { nodes, links, axes, .. } = tree;
    let stride = Stride::<f32>::new((), 0, substep);
    for link in links {
        if link.class == JointClass::Wheel && (link.motor[1] > 0.0 || link.motor[2] != 0.0) {
            drive_wheel(link, nodes);
        }
        if let Some(axis) = axes.get_mut(link.axis as usize)
            && (axis.mass_scale[0] != 0.0 || axis.motor_max[0] != 0.0)
        {
            drive_axis::<BIAS>(&stride, link, axis, nodes);
        }
    }
}

fn drive_wheel(link: &mut TreeLink, nodes: &mut [TreeNode]) {
    let (a, b) = (&nodes[link.a as usize], &nodes[link.b as usize]);
    let (inv, spin) = (a.inv_inertia + b.inv_inertia, b.v[2] - a.v[2]);
    let [speed, max, old] = link.motor;
    let wanted = if inv > 0.0 { (f64::from(speed) - spin) / inv } else { 0.0 };
    let impulse = (old + wanted as f32).max(-max).min(max);
    link.motor[2] = impulse;
    turn(nodes, [link.a, link.b], f64::from(impulse - old));
}

/// Along the free coordinate, with the mass of the two bodies as the joint's rigid rows tie them.
fn drive_axis<const BIAS: bool>(
    stride: &Stride<f32>,
    link: &mut TreeLink,
    axis: &mut AxisLanes,
    nodes: &mut [TreeNode],
) {
    let (a, b) = (&nodes[link.a as usize], &nodes[link.b as usize]);
    let own = &link.coordinate;
    let free = rows::response(own, own, a, b);
    let mut coupling = [0.0; 3];
    let mut mass = [0.0; 6];
    for i in 0..link.rigid {
        coupling[i] = rows::response(&link.rows[i], own, a, b);
        for j in i..link.rigid {
            mass[factor::PLACE[i][j]] = rows::response(&link.rows[i], &link.rows[j], a, b);
        }
    }
    let per = factor::times(&factor::invert(&mass, link.rigid), coupling);
    let tied = free - factor::dot3(coupling, per);
    let least = f64::from(super::parts::LEAST_COMPLEMENT) * free;
    let mut coordinate = Coordinate {
        value: link.value as f32,
        velocity: rows::velocity(own, a, b) as f32,
        inv_mass: if tied > least { tied } else { least } as f32,
    };
    let change = f64::from(axis.drive::<f32, BIAS>(stride, &mut coordinate));
    let ends = [link.a, link.b];
    rows::push(nodes, ends, own, change);
    for (i, per) in per.iter().enumerate().take(link.rigid) {
        link.impulses[i] -= per * change;
        rows::push(nodes, ends, &link.rows[i], -per * change);
    }
}

/// Solves the rigid rows together with the limits that hold.
///
/// Which do is not known before: those that pushed before, and those that would be overrun, begin. A limit that
/// would have to pull goes, one that is overrun comes, and the tree is solved again.
fn solve<const BIAS: bool>(tree: &mut JointTree, rates: &Rates) {
    begin_limits::<BIAS>(tree, rates);
    let share = if BIAS { snap_share(tree, rates) } else { 0.0 };
    for _ in 0..MOST_SOLVES {
        factor::refactor(tree);
        demand::<BIAS>(tree, rates, share);
        factor::solve(tree);
        apply(tree);
        if !change_limits::<BIAS>(tree, rates) {
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
fn snap_share(tree: &mut JointTree, rates: &Rates) -> f64 {
    let mut sum = 0.0;
    for link in &mut tree.links {
        link.rhs = [0.0; 3];
        for (rhs, row) in link.rhs.iter_mut().zip(&link.rows[..link.rigid]) {
            *rhs = -rates.rigid_bias(row.error);
            sum += rhs.abs();
        }
    }
    let [most, most_turn] = rates.snap;
    if sum < most {
        return 1.0;
    }
    factor::refactor(tree);
    factor::solve(tree);
    let mut over = 1.0;
    for node in &tree.nodes[..tree.dynamic] {
        let [x, y, turn] = node.dv;
        let (way, turn) = ((x * x + y * y).sqrt() / most, turn.abs() / most_turn);
        let most = if way > turn { way } else { turn };
        over = if most > over { most } else { over };
    }
    1.0 / over
}

/// What is missing in the velocity at the lower (1) or upper (-1) limit; above 0 where it would be overrun.
fn overrun<const BIAS: bool>(
    link: &TreeLink,
    axis: &AxisLanes,
    nodes: &[TreeNode],
    side: f64,
    rates: &Rates,
) -> f64 {
    let end = f64::from(if side > 0.0 { axis.lower[0] } else { axis.upper[0] });
    let (a, b) = (&nodes[link.a as usize], &nodes[link.b as usize]);
    let velocity = rows::velocity(&link.coordinate, a, b);
    let velocity = side * velocity;
    let impulse = if side > 0.0 { axis.lower_impulse[0] } else { axis.upper_impulse[0] };
    let stopped = rows::response(&link.coordinate, &link.coordinate, a, b) * f64::from(impulse);
    let taken = if velocity < 0.0 { stopped - velocity } else { stopped };
    -(velocity + rates.limit_bias::<BIAS>(link.class, side * (link.value - end), taken))
}

/// The accumulated impulse of a limit.
fn limit_impulse(axis: &mut AxisLanes, side: f64) -> &mut f32 {
    if side > 0.0 { &mut axis.lower_impulse[0] } else { &mut axis.upper_impulse[0] }
}

/// Takes back what a limit has given.
fn release(link: &TreeLink, axis: &mut AxisLanes, nodes: &mut [TreeNode], side: f64) {
    let impulse = core::mem::take(limit_impulse(axis, side));
    rows::push(nodes, [link.a, link.b], &link.coordinate, -side * f64::from(impulse));
}

/// Begins with the limits that pushed or would be overrun.
fn begin_limits<const BIAS: bool>(tree: &mut JointTree, rates: &Rates) {
    let JointTree { nodes, links, axes, factored, .. } = tree;
    for link in links {
        let Some(axis) = axes.get_mut(link.axis as usize) else { continue };
        let wants = |axis: &mut AxisLanes, side: f64| {
            *limit_impulse(axis, side) > 0.0
                || overrun::<BIAS>(link, axis, nodes, side, rates) > 0.0
        };
        let side = if wants(axis, 1.0) {
            1.0
        } else if wants(axis, -1.0) {
            -1.0
        } else {
            0.0
        };
        if side > 0.0 && axis.upper_impulse[0] != 0.0 {
            release(link, axis, nodes, -1.0);
        }
        if side != link.limit {
            link.limit = side;
            *factored = false;
        }
    }
}

/// Lets go of limits that pull, takes hold of those that are overrun. Has anything changed?
fn change_limits<const BIAS: bool>(tree: &mut JointTree, rates: &Rates) -> bool {
    let JointTree { nodes, links, axes, factored, .. } = tree;
    let mut changed = false;
    for link in links {
        let Some(axis) = axes.get_mut(link.axis as usize) else { continue };
        if link.limit != 0.0 {
            if *limit_impulse(axis, link.limit) < 0.0 {
                release(link, axis, nodes, link.limit);
                link.limit = 0.0;
                changed = true;
            }
            continue;
        }
        for side in [1.0, -1.0] {
            if overrun::<BIAS>(link, axis, nodes, side, rates) > LEAST_OVERRUN {
                link.limit = side;
                changed = true;
            }
        }
    }
    *factored &= !changed;
    changed
}

/// Right sides: minus what the velocities and position errors are short of.
fn demand<const BIAS: bool>(tree: &mut JointTree, rates: &Rates, share: f64) {
    let JointTree { nodes, links, axes, .. } = tree;
    for link in links {
        let (a, b) = (&nodes[link.a as usize], &nodes[link.b as usize]);
        let curve = if BIAS { curve(link, a, b, rates.h) } else { [0.0; 3] };
        for (i, curve) in curve.iter().enumerate().take(link.rigid) {
            let row = &link.rows[i];
            link.rhs[i] = -rows::velocity(row, a, b);
            if BIAS {
                let give = row.compliance * link.impulses[i];
                link.rhs[i] -= curve + share * rates.rigid_bias(row.error) + give;
            }
        }
        if let Some(axis) = axes.get_mut(link.axis as usize)
            && link.limit != 0.0
        {
            let mut wanted = overrun::<BIAS>(link, axis, nodes, link.limit, rates);
            if BIAS {
                let impulse = f64::from(*limit_impulse(axis, link.limit));
                wanted -= link.coordinate.compliance * impulse;
            }
            link.rhs[link.rigid] = wanted;
        }
    }
}

/// What the circles of anchors and rods add to the mean velocities over a substep, to second order:
/// `-h w^2 r / 2` for an anchor, `h vt^2 / (2 d)` for a rod.
fn curve(link: &TreeLink, a: &TreeNode, b: &TreeNode, h: f64) -> [f64; 3] {
    let mut sums = [0.0; 3];
    if matches!(link.class, JointClass::Prismatic | JointClass::Wheel | JointClass::Gear) {
        return sums;
    }
    let inward = |w: f64| -0.5 * w * slow_turn(h * w);
    let (inward_a, inward_b) = (inward(a.v[2]), inward(b.v[2]));
    for (sum, row) in sums.iter_mut().zip(&link.rows[..link.rigid]) {
        *sum = inward_b * row.reach_b - inward_a * row.reach_a;
    }
    if link.class == JointClass::Distance && link.value > 0.0 {
        let row = &link.rows[0];
        let [x, y, _] = row.on[1];
        let across = x * (b.v[1] - a.v[1]) - y * (b.v[0] - a.v[0])
            + (row.reach_b * b.v[2] - row.reach_a * a.v[2]);
        sums[0] += 0.5 * across * slow_turn(h * across / link.value);
    }
    sums
}

/// A turn in a substep, which fades out towards [`FASTEST_SWING`].
fn slow_turn(turn: f64) -> f64 {
    let fade = 1.0 - turn * turn / (FASTEST_SWING * FASTEST_SWING);
    if fade > 0.0 { turn * fade } else { 0.0 }
}

/// Adds the solution to velocities and impulses.
fn apply(tree: &mut JointTree) {
    let JointTree { nodes, dynamic, links, axes, .. } = tree;
    for node in &mut nodes[..*dynamic] {
        for k in 0..3 {
            node.v[k] += node.dv[k];
        }
    }
    for link in links {
        for i in 0..link.rigid {
            link.impulses[i] += link.change[i];
        }
        if let Some(axis) = axes.get_mut(link.axis as usize)
            && link.limit != 0.0
        {
            *limit_impulse(axis, link.limit) += link.change[link.rigid] as f32;
        }
    }
}
