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
//! Springs act joint by joint before the tree is solved. Limits, also those of ropes, join it one by one as they are found to hold, and leave it where
//! they would pull; so do motors, and leave it where they would push with more than they have.

mod factor;
mod loops;
mod rows;
#[cfg(test)]
mod tests;

use super::parts::{SNAP, SNAP_SHARE, Stride, Substep, slow_turn};
use super::{JointKernel, Pass};
use crate::dynamics::{
    Axis, JointClass, JointColour, JointTree, Joints, Motion, TreeAxis, TreeLink, TreeNode,
    TreeRow, is_jointed, with_bucket,
};
use crate::simd::{
    BLOCK, FourKernel, Simd, SimdLevel, Three, add_times, dispatch_fours, take_product,
};
use crate::threads::{SharedRows, Team};

/// Part of a position error that a substep takes away. What is missing at 0.25 is energy: a double pendulum keeps 0.91
/// of its in a minute, at 1 0.99.
const PUSH: f64 = 1.0;
/// The same where the tree touches something: contacts do not know of it. Of 42 ropes of 10 to 32 links dropped on
/// a floor 2 never came to rest, at 0.5 it was 5, at 1 6.
const TOUCHED_PUSH: f64 = 0.25;
/// Most solves in a pass to find the limits and motors that hold; what is not found stands still. After four instead, arms with motors
/// at their limits lag at 60 hertz: of 120 a tenth was over .33 radians from where they are at 960 after a second and a half, with eight .13.
const MOST_SOLVES: usize = 8;
/// Overrun of a limit that is pushed back softly, length units or radians; what is beyond goes within a substep.
/// At 0.003, which limbs in lanes have, chains at their limits run over them by 0.024 radians; the test allows 0.01.
const SOFT_OVERRUN: f64 = 0.005;
/// Velocity at a limit that does not matter, length units or radians a second.
const LEAST_OVERRUN: f64 = 1.0e-5;
/// Trees that one member of the team works on at a time.
const CHUNK: usize = 4;

/// Begins a step of a pace's trees, once their lanes are prepared.
pub(crate) fn prepare(
    team: &Team,
    pace: usize,
    trees: &mut [JointTree],
    joints: &Joints,
    motions: &[Motion],
) {
    team.for_each_chunk_mut(trees, CHUNK, |_, trees| {
        of_pace(trees, pace).for_each(|tree| {
            rows::prepare(tree, joints);
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

/// Runs a pass over the trees of a pace, whose joints have these lanes.
pub(crate) fn run(
    team: &Team,
    level: SimdLevel,
    pace: usize,
    pass: Pass,
    substep: Substep,
    bodies: SharedRows<'_>,
    (lanes, trees): (&mut JointColour, &mut [JointTree]),
) {
    if pass == Pass::Finish {
        if is_jointed(pace) {
            of_pace(trees, pace).for_each(|tree| rows::restore(tree, bodies));
        }
        lanes.for_each_run(team, |blocks, count| {
            super::run(level, pass, substep, bodies, blocks, count);
        });
        return;
    }
    let lanes = &*lanes;
    team.for_each_chunk_mut(trees, CHUNK, |_, trees| {
        dispatch_fours(level, RunPass(pass, substep, bodies, lanes, trees, pace));
    });
}

/// A pass over some trees.
struct RunPass<'a>(Pass, Substep, SharedRows<'a>, &'a JointColour, &'a mut [JointTree], usize);

impl FourKernel for RunPass<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self(pass, substep, bodies, lanes, trees, pace) = self;
        for tree in of_pace(trees, pace) {
            run_tree(simd, pass, substep, bodies, lanes, tree);
        }
    }
}

/// How all bodies of a tree answer impulses on some of its nodes: for each of these three columns of equal length, per impulse along x,
/// y and about, with the changes of velocity body by body.
pub(crate) fn answer(level: SimdLevel, tree: &mut JointTree, touched: &[u32], columns: &mut [f32]) {
    dispatch_fours(level, Answer(tree, touched, columns));
}

struct Answer<'a>(&'a mut JointTree, &'a [u32], &'a mut [f32]);

impl FourKernel for Answer<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self(tree, touched, columns) = self;
        loops::factor(simd, tree);
        let length = columns.len() / (3 * touched.len());
        for (columns, &node) in columns.chunks_exact_mut(3 * length).zip(touched) {
            loops::answer(simd, tree, node);
            for (k, column) in columns.chunks_exact_mut(length).enumerate() {
                for (column, node) in column.chunks_exact_mut(3).zip(&tree.nodes[..tree.dynamic]) {
                    (0..3).for_each(|i| column[i] = node.answers[k][i] as f32);
                }
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
    lanes: &JointColour,
    tree: &mut JointTree,
) {
    let again = match pass {
        Pass::Solve => tree.moved,
        // Before the first solve of a substep it is of bounces, which leave no joint as it is.
        Pass::Relax => !tree.moved && tree.solved,
        _ => false,
    };
    if again && tree.is_undisturbed() {
        return;
    }
    // At a jointed pace all that is stiff is damped.
    let brakes = substep.leaps && !tree.begun && !is_jointed(tree.pace);
    let rates = Rates::new(substep, tree.pace, pass == Pass::Solve);
    let moved = pass == Pass::Relax && tree.moved;
    // What motors turn keeps its speed, and what strains itself would lose it.
    let slows = moved && swings_freely(tree) && !is_strained(tree);
    rows::load(tree, bodies);
    if moved || !tree.fresh {
        rows::refresh(simd, tree, lanes, bodies, substep);
    }
    if slows {
        tree.nodes.iter_mut().for_each(|node| rows::slow(node, node.inv[2]));
    }
    tree.moved = pass == Pass::Solve;
    tree.solved = pass == Pass::Solve || tree.solved && pass == Pass::Relax;
    match pass {
        Pass::WarmStart => {
            if is_jointed(tree.pace) || tree.torn {
                rows::damp(tree);
            }
            if brakes {
                rows::brake(tree);
            }
            if swings_freely(tree) {
                kick(simd, tree, -1.0);
            }
            if is_strained(tree) {
                bend(simd, tree, &rates.stride);
            }
            warm_start(simd, tree);
        }
        _ => {
            if moved && swings_freely(tree) {
                kick(simd, tree, 1.0);
            }
            drive(simd, tree, &rates);
            solve(simd, tree, &rates);
            if tree.axes.iter().any(|axis| axis.soft) {
                give_way(simd, tree, lanes, substep, rates.bias);
            }
            if slows {
                rows::tighten(tree, rates.stride.h);
            }
        }
    }
    rows::store(tree, bodies);
}

/// May forces act half before and half after a substep? What motors, springs and joints that are no tree's hold would move by the
/// difference in each.
#[inline(always)]
fn swings_freely(tree: &JointTree) -> bool {
    let idle = |TreeAxis { axis, .. }: &TreeAxis| axis.motor_max == 0.0 && axis.push == 0.0;
    tree.alone && !is_jointed(tree.pace) && tree.axes.iter().all(idle)
}

/// Has it a motor, or one that has yet to let go of what it has pushed with?
fn has_motor(TreeAxis { axis, .. }: &TreeAxis) -> bool {
    axis.motor_max != 0.0 || axis.motor != 0.0
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
    for link in &*links {
        for i in 0..link.rigid {
            rows::push(simd, nodes, [link.a, link.b], &link.row(i), link.impulses[i]);
        }
    }
    for TreeAxis { link, axis, .. } in axes {
        let TreeLink { a, b, turns, ref coordinate, ref drive, .. } = links[*link as usize];
        let turn = if turns { axis.motor } else { 0.0 };
        rows::push(simd, nodes, [a, b], &coordinate.on, axis.total() - turn);
        rows::push(simd, nodes, [a, b], &drive.on, turn);
    }
}

/// Springs, and motors where a limit holds, joint by joint.
#[inline(always)]
fn drive<S: Simd>(simd: S, tree: &mut JointTree, rates: &Rates) {
    let JointTree { nodes, links, axes, .. } = tree;
    for axis in axes {
        let link = &mut links[axis.link as usize];
        let (mut velocity, masses) = (
            speed_along(&link.coordinate, link, nodes),
            [rates.stride.invert(axis.tied), axis.tied],
        );
        let mut change = 0.0;
        if axis.axis.spring != 0.0 || axis.axis.push != 0.0 {
            let (own, value) = (&mut axis.axis, link.value);
            change += if rates.bias {
                own.pull::<true>(value, &mut velocity, masses)
            } else {
                own.pull::<false>(value, &mut velocity, masses)
            };
        }
        let limited = link.limit != 0.0 && !link.driven && has_motor(axis);
        if limited && !link.turns {
            change += axis.axis.drive(&mut velocity, masses);
        }
        if change != 0.0 {
            push_along(simd, link, axis, nodes, change);
        }
        if limited && link.turns {
            let needed = needed(link, axis, nodes, rates);
            bound(simd, link, axis, nodes, needed);
        }
    }
}

/// Limits that give way, as softly as those in lanes, once what is rigid holds.
#[inline(always)]
fn give_way<S: Simd>(
    simd: S,
    tree: &mut JointTree,
    lanes: &JointColour,
    substep: Substep,
    bias: bool,
) {
    let JointTree { nodes, links, axes, .. } = tree;
    for axis in axes.iter_mut().filter(|axis| axis.soft) {
        let link = &mut links[axis.link as usize];
        let stride = Stride::new((), link.slot as usize % BLOCK, substep);
        let velocity = speed_along(&link.coordinate, link, nodes);
        let (motion, value) = ([velocity, stride.invert(axis.tied), axis.tied], link.value);
        let own = &mut axis.axis;
        own.limits = [own.limits[0].max(0.0), -own.limits[0].min(0.0)];
        let change = with_bucket!(lanes, link.class, bucket => {
            let block = &bucket.blocks[link.slot as usize / BLOCK];
            if bias {
                let give = block.give::<true>(&stride);
                give.map(|give| own.stop(&stride, give.blocked(&stride), value, motion))
            } else {
                let give = block.give::<false>(&stride);
                give.map(|give| own.stop(&stride, give.blocked(&stride), value, motion))
            }
        });
        own.limits = [own.limits[0] - own.limits[1], 0.0];
        push_along(simd, link, axis, nodes, change.unwrap_or(0.0));
    }
}

/// An impulse along the free coordinate, with what the joint's rigid rows give with it.
#[inline(always)]
fn push_along<S: Simd>(
    simd: S,
    link: &mut TreeLink,
    axis: &TreeAxis,
    nodes: &mut [TreeNode],
    change: f64,
) {
    rows::push(simd, nodes, [link.a, link.b], &axis.on, change);
    for (impulse, given) in link.impulses[..link.rigid].iter_mut().zip(axis.given) {
        *impulse += given * change;
    }
}

/// Solves the rigid rows together with the limits and motors that hold.
///
/// Which do is not known before: those that pushed before, and those that would be overrun, begin. A limit that
/// would have to pull goes, one that is overrun comes, a motor that would need more than it has pushes with that; and the tree is
/// solved again. Where that goes round in circles, what would change stands still in the end, which takes energy and makes none.
#[inline(always)]
fn solve<S: Simd>(simd: S, tree: &mut JointTree, rates: &Rates) {
    begin_limits(simd, tree, rates);
    let share = if rates.bias { snap_share(simd, tree, rates) } else { 0.0 };
    if rates.bias {
        tree.snaps = share < 1.0 || tree.axes.iter().any(|axis| axis.soft);
    }
    let rates = &Rates { push: share * rates.push, ..*rates };
    if rates.bias && !is_strained(tree) {
        bend(simd, tree, &rates.stride);
    }
    let mut solves = 0;
    loop {
        loops::factor(simd, tree);
        demand(simd, tree, rates);
        loops::solve(simd, tree, None);
        apply(simd, tree);
        solves += 1;
        if !change_limits(simd, tree, rates, solves >= MOST_SOLVES) {
            break;
        }
    }
    if solves > MOST_SOLVES {
        settle(tree);
    }
}

/// What was held still has not pushed more than it can, nor with limits that it is not at: friction is what did.
fn settle(tree: &mut JointTree) {
    let JointTree { links, axes, .. } = tree;
    for TreeAxis { link, axis, .. } in axes {
        if links[*link as usize].stuck {
            axis.motor = axis.motor.clamp(-axis.motor_max, axis.motor_max);
            axis.limits[0] = 0.0;
        }
    }
}

/// What a tree does to position errors in a substep.
#[derive(Clone, Copy)]
struct Rates {
    stride: Stride<f64>,
    /// Part that is taken away.
    push: f64,
    /// Are they made good in this pass at all? Told at run time: both ways together would not fit into the cache for code.
    bias: bool,
}

impl Rates {
    fn new(substep: Substep, pace: usize, bias: bool) -> Self {
        let push = if is_jointed(pace) { TOUCHED_PUSH } else { PUSH };
        Self { stride: Stride::new((), 0, substep), push, bias }
    }

    /// Velocity that the error of a rigid row asks for.
    fn rigid_bias(&self, error: f64) -> f64 {
        self.push * error * self.stride.inv_h
    }
}

/// The part of all position errors that is taken away: they may add up along a tree, and to make them good at once would
/// hurl it about. What they alone would do tells.
#[inline(always)]
fn snap_share<S: Simd>(simd: S, tree: &mut JointTree, rates: &Rates) -> f64 {
    let Stride { snap: most, snap_turn: most_turn, .. } = rates.stride;
    let (mut sum, mut largest) = (0.0, 0.0);
    for link in &mut tree.links {
        link.rhs = link.error.map(|error| -rates.rigid_bias(error));
        let rows = link.error.iter().zip(&link.rhs).zip(&link.jacobians[1].rows);
        for ((error, wanted), [x, y, ..]) in rows {
            // Angles have no unit of length.
            let unit = if *x == 0.0 && *y == 0.0 { 1.0 } else { most / most_turn };
            sum += wanted.abs() / unit;
            largest = if error.abs() > largest * unit { error.abs() / unit } else { largest };
        }
    }
    let grown = 1.0 + f64::from(SNAP_SHARE / SNAP) * largest;
    let (most, most_turn) = (most * grown, most_turn * grown);
    if sum < most_turn && !tree.tight {
        return 1.0;
    }
    if tree.tight {
        rows::stiffen_errors(tree, rates.stride.h);
        for axis in &tree.axes {
            let link = &mut tree.links[axis.link as usize];
            if link.driven {
                link.rhs[link.rigid] = 0.0;
            } else if link.limit != 0.0 {
                link.rhs[link.rigid] = overrun(link, axis, 0.0, link.limit, rates);
            }
        }
    }
    loops::factor(simd, tree);
    loops::solve(simd, tree, None);
    if tree.tight {
        share_errors(tree, rates);
    }
    let mut over = 1.0;
    for node in &tree.nodes[..tree.dynamic] {
        let [x, y, turn, _] = node.dv;
        let (way, turn) = ((x * x + y * y).sqrt() / most, turn.abs() / most_turn);
        let most = if way > turn { way } else { turn };
        over = if most > over { most } else { over };
    }
    1.0 / over
}

/// Leaves of the errors what the tree can make good, and takes back what made bodies stiff for that. What rows that contradict each
/// other want of their bodies remains in the compliance, and impulses for it would add up.
fn share_errors(tree: &mut JointTree, rates: &Rates) {
    tree.nodes.iter_mut().for_each(|node| node.inv[2] = core::mem::take(&mut node.inv[3]));
    tree.factored = false;
    for link in &mut tree.links {
        for i in 0..link.rigid {
            link.error[i] += link.compliance[i] * link.change[i] / rates.rigid_bias(1.0);
        }
        if link.limit != 0.0 {
            link.error[link.rigid] = link.compliance[link.rigid] * link.change[link.rigid];
        }
        link.change = [0.0; 4];
    }
}

/// How far it is to the lower (1) or upper (-1) limit; below 0 beyond it.
fn room(link: &TreeLink, axis: &TreeAxis, side: f64) -> f64 {
    side * (link.value - axis.axis.ends[usize::from(side < 0.0)])
}

/// What is missing in the velocity at the lower (1) or upper (-1) limit; above 0 where it would be overrun.
///
/// Within the substep a limit may be reached, but not passed. An overrun goes as it does in lanes, softly while it is
/// small, and no faster than what the limit has taken.
#[inline(always)]
fn overrun(link: &TreeLink, axis: &TreeAxis, velocity: f64, side: f64, rates: &Rates) -> f64 {
    let Stride { inv_h, snap, snap_turn, unit, .. } = rates.stride;
    let (velocity, room) = (side * velocity, room(link, axis, side));
    if room > 0.0 {
        return -(velocity + room * inv_h);
    }
    let turns = link.class == JointClass::Revolute;
    let (snap, unit) = if turns { (snap_turn, 1.0) } else { (snap, unit) };
    // The impulse is another's where it is below 0: at most one limit pushes.
    let least = velocity.min(0.0) - snap + f64::from(SNAP_SHARE) * room * inv_h;
    let (soft, firm) = (TOUCHED_PUSH * room, room + unit * SOFT_OVERRUN);
    let push = if firm < soft { firm } else { soft } * inv_h;
    let push = if push < least { least } else { push };
    -(velocity + if rates.bias { push } else { 0.0 })
}

/// Velocity along a row of a link.
fn speed_along(row: &TreeRow, link: &TreeLink, nodes: &[TreeNode]) -> f64 {
    let [on_a, on_b] = &row.on;
    factor::dot3(on_b, &nodes[link.b as usize].v) + factor::dot3(on_a, &nodes[link.a as usize].v)
}

/// Mean velocity of the free coordinate over the coming substep: a rope's ends run on circles.
fn free_speed(link: &TreeLink, nodes: &[TreeNode], rates: &Rates) -> f64 {
    let bent = rates.bias && link.class == JointClass::Distance;
    speed_along(&link.coordinate, link, nodes) - if bent { link.curve[0] } else { 0.0 }
}

/// Takes back what limits have given.
#[inline(always)]
fn release<S: Simd>(simd: S, link: &TreeLink, axis: &mut TreeAxis, nodes: &mut [TreeNode]) {
    let impulse = core::mem::take(&mut axis.axis.limits[0]);
    rows::push(simd, nodes, [link.a, link.b], &link.coordinate.on, -impulse);
}

/// The impulse that a motor would need if nothing but its own bodies answered: what else hangs on them asks for more.
fn needed(link: &TreeLink, axis: &TreeAxis, nodes: &[TreeNode], rates: &Rates) -> f64 {
    let mass = rates.stride.invert(axis.driven);
    let Axis { motor, motor_speed, .. } = axis.axis;
    if mass > 0.0 {
        motor + mass * (motor_speed - speed_along(&link.drive, link, nodes))
    } else {
        0.0
    }
}

/// Gives a motor this impulse, or as much of it as it has. Is it less?
#[inline(always)]
fn bound<S: Simd>(
    simd: S,
    link: &mut TreeLink,
    axis: &mut TreeAxis,
    nodes: &mut [TreeNode],
    impulse: f64,
) -> bool {
    let most = axis.axis.motor_max;
    let bounded = impulse.clamp(-most, most);
    let change = bounded - core::mem::replace(&mut axis.axis.motor, bounded);
    if change != 0.0 && link.turns {
        rows::push(simd, nodes, [link.a, link.b], &link.drive.on, change);
    } else if change != 0.0 {
        push_along(simd, link, axis, nodes, change);
    }
    bounded != impulse
}

/// Begins with the limits that pushed or would be overrun, and the motors that have not given all they have.
#[inline(always)]
fn begin_limits<S: Simd>(simd: S, tree: &mut JointTree, rates: &Rates) {
    let JointTree { nodes, links, axes, factored, .. } = tree;
    for axis in axes {
        let link = &mut links[axis.link as usize];
        let velocity = speed_along(&link.coordinate, link, nodes);
        let wants = |side: f64| {
            side * axis.axis.limits[0] > 0.0 || overrun(link, axis, velocity, side, rates) > 0.0
        };
        let holds = |&side: &f64| !axis.soft && wants(side);
        let side = [1.0, -1.0].into_iter().find(holds).unwrap_or(0.0);
        if side * axis.axis.limits[0] < 0.0 {
            release(simd, link, axis, nodes);
        }
        let mut driven = false;
        if side == 0.0 && has_motor(axis) {
            let (needed, most) = (needed(link, axis, nodes, rates), axis.axis.motor_max);
            driven = axis.driven > 0.0 && most > 0.0 && needed.abs() <= most;
            if !driven {
                bound(simd, link, axis, nodes, needed);
            }
        }
        let holds = if driven { 1.0 } else { side };
        *factored &= (holds, driven) == (link.limit, link.driven);
        (link.limit, link.driven, link.stuck) = (holds, driven, false);
    }
}

/// Lets go of limits that pull and of motors that would give too much, takes hold of limits that are overrun and of motors that have
/// given too much; or, if it `sticks`, holds still what it would change. Has anything changed?
#[inline(always)]
fn change_limits<S: Simd>(simd: S, tree: &mut JointTree, rates: &Rates, sticks: bool) -> bool {
    let JointTree { nodes, links, axes, factored, .. } = tree;
    let mut changed = false;
    for axis in axes.iter_mut().filter(|axis| !axis.soft) {
        let link = &mut links[axis.link as usize];
        let Some((limit, driven)) = better(link, axis, nodes, rates) else { continue };
        changed = true;
        if sticks {
            link.stuck = true;
            if link.limit == 0.0 {
                (link.limit, link.driven) = (limit, driven);
            }
            continue;
        }
        if link.driven {
            bound(simd, link, axis, nodes, axis.axis.motor);
        } else if link.limit != 0.0 {
            release(simd, link, axis, nodes);
        }
        (link.limit, link.driven) = (limit, driven);
    }
    *factored &= !changed;
    changed
}

/// What should hold in place of what does, if anything should: a limit, or the motor.
fn better(
    link: &TreeLink,
    axis: &TreeAxis,
    nodes: &[TreeNode],
    rates: &Rates,
) -> Option<(f64, bool)> {
    let Axis { motor, motor_max, motor_speed, limits, .. } = axis.axis;
    if link.stuck {
        return None;
    }
    if link.limit != 0.0 && !link.driven {
        return (link.limit * limits[0] < 0.0).then_some((0.0, false));
    }
    let velocity = free_speed(link, nodes, rates);
    let unit = if link.class == JointClass::Revolute { 1.0 } else { rates.stride.unit };
    let least = LEAST_OVERRUN * unit;
    let overrun = |&side: &f64| overrun(link, axis, velocity, side, rates) > least;
    if let Some(side) = [-1.0, 1.0].into_iter().find(overrun) {
        return Some((side, false));
    }
    if link.driven {
        return (motor.abs() > motor_max).then_some((0.0, false));
    }
    // It has pushed as hard as it can, and that was too much.
    let beyond = (speed_along(&link.drive, link, nodes) - motor_speed) * motor.signum();
    let given = motor_max > 0.0 && motor.abs() >= motor_max && beyond > least;
    (given && needed(link, axis, nodes, rates).abs() < motor_max).then_some((1.0, true))
}

/// Right sides: minus what the velocities and position errors are short of.
#[inline(always)]
fn demand<S: Simd>(simd: S, tree: &mut JointTree, rates: &Rates) {
    let JointTree { nodes, links, axes, .. } = tree;
    for link in &mut *links {
        link.rhs = short_of(simd, link, nodes, rates);
    }
    for axis in axes {
        let link = &mut links[axis.link as usize];
        if link.limit != 0.0 {
            let row = if link.driven { &link.drive } else { &link.coordinate };
            if link.stuck && (link.driven || room(link, axis, link.limit) > 0.0) {
                link.rhs[link.rigid] = -link.limit * speed_along(row, link, nodes);
                continue;
            }
            let (mut wanted, impulse) = if link.driven {
                (axis.axis.motor_speed - speed_along(&link.drive, link, nodes), axis.axis.motor)
            } else {
                let velocity = free_speed(link, nodes, rates);
                (overrun(link, axis, velocity, link.limit, rates), link.limit * axis.axis.limits[0])
            };
            if rates.bias {
                // A limit gives a little; a motor that did would creep on.
                let gives = if link.driven { 0.0 } else { link.compliance[link.rigid] };
                wanted -= gives * impulse + link.error[link.rigid];
            }
            link.rhs[link.rigid] = wanted;
        }
    }
}

/// Of the rows of a link.
#[inline(always)]
fn short_of<S: Simd>(simd: S, link: &TreeLink, nodes: &[TreeNode], rates: &Rates) -> Three {
    let (a, b) = (&nodes[link.a as usize], &nodes[link.b as usize]);
    let mut rhs = [0.0; 4];
    if rates.bias {
        rhs = link.curve;
        let rows = link.error.iter().zip(&link.compliance).zip(&link.impulses);
        for (rhs, ((error, compliance), impulse)) in rhs.iter_mut().zip(rows) {
            *rhs -= rates.rigid_bias(1.0) * error + compliance * impulse;
        }
    }
    take_product(simd, &mut rhs, &link.jacobians[1].columns, &b.v);
    take_product(simd, &mut rhs, &link.jacobians[0].columns, &a.v);
    rhs
}

/// Do its joints strain each other? The impulses of the substep before have not turned with its bodies, and would turn them by so much more
/// than they do that strains grew from substep to substep: there it counts how bodies turn before them, else before what is solved, as
/// what is taken back between two solves leaves velocities that nothing has.
fn is_strained(tree: &JointTree) -> bool {
    tree.uncut() < tree.links.len()
}

/// Looks how the bodies turn.
#[inline(always)]
fn bend<S: Simd>(simd: S, tree: &mut JointTree, stride: &Stride<f64>) {
    let JointTree { nodes, links, .. } = tree;
    for link in links {
        let (a, b) = (&nodes[link.a as usize], &nodes[link.b as usize]);
        link.curve = curve(simd, link, a, b, stride);
    }
}

/// What the circles of anchors and rods take from the mean velocities over a substep, to second order:
/// `h w^2 r / 2` for an anchor, `-h vt^2 / (2 d)` for a rod.
#[inline(always)]
fn curve<S: Simd>(
    simd: S,
    link: &TreeLink,
    a: &TreeNode,
    b: &TreeNode,
    stride: &Stride<f64>,
) -> Three {
    let mut sums = [0.0; 4];
    if matches!(link.class, JointClass::Slider | JointClass::Gear) {
        return sums;
    }
    let inward = |w: f64| 0.5 * w * slow_turn(stride, w);
    add_times(simd, &mut sums, &link.reach[1], inward(b.v[2]));
    add_times(simd, &mut sums, &link.reach[0], -inward(a.v[2]));
    if link.class == JointClass::Distance && link.value > 0.0 {
        let [x, y, ..] = link.coordinate.on[1];
        let across = x * (b.v[1] - a.v[1]) - y * (b.v[0] - a.v[0])
            + (link.reach[1][0] * b.v[2] - link.reach[0][0] * a.v[2]);
        sums[0] -= 0.5 * across * slow_turn(stride, across / link.value);
    }
    sums
}

/// Adds the solution to velocities and impulses.
#[inline(always)]
fn apply<S: Simd>(simd: S, tree: &mut JointTree) {
    let JointTree { nodes, dynamic, links, axes, .. } = tree;
    for node in &mut nodes[..*dynamic] {
        add_times(simd, &mut node.v, &node.dv, 1.0);
    }
    for axis in axes {
        let link = &mut links[axis.link as usize];
        if link.limit != 0.0 {
            let change = core::mem::take(&mut link.change[link.rigid]);
            let of = if link.driven { &mut axis.axis.motor } else { &mut axis.axis.limits[0] };
            *of += link.limit * change;
        }
    }
    for link in links {
        add_times(simd, &mut link.impulses, &link.change, 1.0);
        link.change = [0.0; 4];
    }
}
