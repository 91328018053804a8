//! Narrow phase: from pairs of shapes to contact constraints, in lanes.
//!
//! For each block of contacts of one class: gather poses and shapes, compute the manifolds in the
//! frame of shape A, carry impulses over by feature id, and write the constraints that the solver
//! iterates on. Running it twice on one block gives the same block, so blocks that got new contacts
//! after the pass are simply run again.

use super::ahead::{HARMLESS, HEAVIER, Predictions, SLIGHT};
use super::effective_mass::{Inverses, nearness, straight};
use super::middle::Lead;
use super::narrow_context::Context;
use super::passing::leave_out;
use super::surfaces::{self, LanePoints};
use crate::dynamics::{BlockHead, Blocks, Graph, ManifoldBlock, NULL, Schedule, Slot, flags};
use crate::geometry::manifold::{self, LaneManifold, LanePair, Outline, PairClass};
use crate::math::{Pose, Rot, Transform, Vec2};
use crate::simd::{BLOCK, LaneKernel, Lanes, Row, RowSource, RowsOf, dispatch};
use crate::threads::Team;
use core::marker::PhantomData;

/// Blocks that one member of the team updates at a time.
pub(crate) const CHUNK: usize = 4;

/// Updates the blocks of a schedule. Contacts with a prediction become what that says; lanes that close in fast are
/// noted in the heads of their blocks, if the context asks for them.
pub(crate) fn run(
    team: &Team,
    context: Context<'_>,
    graph: &mut Graph,
    schedule: &Schedule,
    predictions: &Predictions,
) {
    graph.for_each_chunk(team, schedule, |runs, mut source| {
        for run in runs {
            let Some(blocks) = source.blocks(run) else { continue };
            match run.class {
                PairClass::BoxBox => update::<BoxBox>(context, predictions, blocks),
                PairClass::BoxCircle => update::<BoxCircle>(context, predictions, blocks),
                PairClass::CapsuleCircle => update::<CapsuleCircle>(context, predictions, blocks),
                PairClass::CircleCircle => update::<CircleCircle>(context, predictions, blocks),
                PairClass::General => update::<General>(context, predictions, blocks),
            }
        }
    });
}

fn update<K: PairKernel>(context: Context<'_>, predictions: &Predictions, blocks: Blocks<'_>) {
    let level = context.level.for_count(blocks.contacts.len());
    dispatch(level, Update::<K> { context, predictions, blocks, kernel: PhantomData });
}

/// A manifold kernel for a class of pairs.
trait PairKernel {
    /// Greatest number of points.
    const POINTS: usize;
    /// Manifolds of the first of some pairs of shapes, in the frames of the boxes of A.
    fn collide<L: Lanes>(
        token: L::Token,
        context: &Context<'_>,
        shapes: [&[u32]; 2],
        pair: &LanePair<L>,
        reach: L,
    ) -> LaneManifold<L>;
}

macro_rules! lane_pair_kernel {
    ($($class:ident = $function:ident),*) => {$(
        struct $class;

        impl PairKernel for $class {
            const POINTS: usize = PairClass::$class.max_points();
            #[inline(always)]
            fn collide<L: Lanes>(
                token: L::Token,
                _: &Context<'_>,
                _: [&[u32]; 2],
                pair: &LanePair<L>,
                reach: L,
            ) -> LaneManifold<L> {
                manifold::$function(token, pair, reach)
            }
        }
    )*};
}

lane_pair_kernel!(
    BoxBox = box_box,
    BoxCircle = box_circle,
    CapsuleCircle = capsule_circle,
    CircleCircle = circle_circle
);

/// Pairs with a general polygon, whose corners are not in the rows of the shapes.
struct General;

impl PairKernel for General {
    const POINTS: usize = PairClass::General.max_points();

    #[inline(always)]
    fn collide<L: Lanes>(
        token: L::Token,
        context: &Context<'_>,
        [a, b]: [&[u32]; 2],
        pair: &LanePair<L>,
        reach: L,
    ) -> LaneManifold<L> {
        let (a, b) = (outlines(context, &a[..L::WIDTH]), outlines(context, &b[..L::WIDTH]));
        manifold::general(token, pair, [&a, &b], reach)
    }
}

/// The outlines of some shapes.
#[inline(always)]
fn outlines<'a>(context: &Context<'a>, shapes: &[u32]) -> [Outline<'a>; BLOCK] {
    let mut outlines = [Outline::UNIT_BOX; BLOCK];
    for (outline, &shape) in outlines.iter_mut().zip(shapes) {
        let record = &context.ground.shapes.records[shape as usize];
        let row = &context.shape_rows[shape as usize];
        let half = Vec2::new(row[4], row[5]);
        *outline = Outline::of(&record.shape, record.class, record.box_frame.p, half);
    }
    outlines
}

/// Contacts of much lighter bodies count as closing in if they are deeper than this part of the reach of contacts, see
/// [`squeezed`](super::ahead).
const SUNK: f32 = 0.25;

/// Blocks of one class on their way through the kernel.
struct Update<'a, K> {
    context: Context<'a>,
    predictions: &'a Predictions,
    blocks: Blocks<'a>,
    kernel: PhantomData<K>,
}

impl<K: PairKernel> LaneKernel for Update<'_, K> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, token: L::Token) {
        let Self { context, predictions, mut blocks, .. } = self;
        let constrained = !blocks.constraints.is_empty();
        for index in 0..blocks.manifolds.len() {
            let contacts = &blocks.contacts[index * BLOCK..];
            let contacts = &contacts[..contacts.len().min(BLOCK)];
            let lanes = contacts.len();
            let (mut touching, mut closing) = (0, 0);
            let mut at = 0;
            if context.naming {
                blocks.heads[index].flags &= !flags::WATCHED;
            }
            while at < lanes {
                let mut load = L::splat(token, 0.0);
                if constrained {
                    for point in &blocks.constraints[index].points {
                        load = load + L::load(token, &point.load[at..]);
                    }
                }
                let manifolds = &blocks.manifolds[index];
                let mut geometry =
                    Geometry::<L>::compute::<K>(token, &context, manifolds, at, load);
                if constrained && !predictions.is_empty() {
                    geometry.foresee(token, predictions, &contacts[at..]);
                }
                let coming = geometry.coming::<K>(token, context.dt);
                if constrained {
                    let blocks = &mut blocks;
                    let pressed =
                        write_constraint::<L, K>(token, &context, &geometry, blocks, index, at);
                    closing |= pressed << at;
                }
                let mut bits = geometry.touching;
                if coming != 0 {
                    let mut normals = [[0.0; BLOCK]; 2];
                    geometry.manifold.normal[0].store(&mut normals[0][at..]);
                    geometry.manifold.normal[1].store(&mut normals[1][at..]);
                    let of = (index, at, coming);
                    let passing = leave_out(&context, predictions, &mut blocks, of, &normals);
                    bits &= !passing;
                    closing |= passing << at;
                }
                closing |= geometry.closing << at;
                touching |= bits << at;
                at += L::WIDTH;
            }
            let valid = if lanes == BLOCK { u16::MAX } else { (1 << lanes) - 1 };
            blocks.heads[index].touching = touching as u16 & valid;
            blocks.heads[index].closing = if context.naming { closing as u16 & valid } else { 0 };
            if constrained {
                note_joints(&context, &blocks.manifolds[index], &mut blocks.heads[index], lanes);
            }
        }
    }
}

/// Notes which lanes have bodies with joints.
#[inline(always)]
fn note_joints(context: &Context<'_>, block: &ManifoldBlock, head: &mut BlockHead, lanes: usize) {
    (head.jointed_a, head.jointed_b) = (0, 0);
    let Some(infos) = context.infos else { return };
    for lane in 0..lanes {
        let jointed = |body: u32| u16::from(infos[body as usize].first_joint != NULL);
        head.jointed_a |= jointed(block.body_a[lane]) << lane;
        head.jointed_b |= jointed(block.body_b[lane]) << lane;
    }
}

/// Manifolds of a stride, turned into the world's axes.
struct Geometry<L: Lanes> {
    /// Points relative to the centre of mass of A.
    manifold: LaneManifold<L>,
    /// Points up to this far apart count, metres.
    most: L,
    valid: [L::Mask; 2],
    /// From the centre of mass of A to that of B.
    between: [L; 2],
    /// Rows of A and B.
    bodies: [[L; 8]; 2],
    /// Lanes with a point, as bits.
    touching: u32,
    /// Lanes that may meet in this step, or hit each other hard, as bits.
    closing: u32,
}

impl<L: Lanes> Geometry<L> {
    #[inline(always)]
    fn compute<K: PairKernel>(
        token: L::Token,
        context: &Context<'_>,
        block: &ManifoldBlock,
        at: usize,
        load: L,
    ) -> Self {
        let (between, turn_a, turn_b) =
            gather_poses::<L>(token, &context.ground.bodies.poses, block, at);
        let shape_a = L::gather(token, context.shape_rows, &block.shape_a[at..]);
        let shape_b = L::gather(token, context.shape_rows, &block.shape_b[at..]);
        let body_a = L::gather(token, context.body_rows, &block.body_a[at..]);
        let body_b = L::gather(token, context.body_rows, &block.body_b[at..]);
        let bodies = [&body_a, &body_b];
        let lead = Lead::of(token, context, bodies, [&shape_a, &shape_b], load);
        let between = [between[0] + lead.linear[0], between[1] + lead.linear[1]];
        let (turn_a, turn_b) = (lead.turned(token, turn_a, 0), lead.turned(token, turn_b, 1));
        // Frames of the shapes in the world's axes: rotation, and place relative to the body.
        let frame_a = rotate(turn_a, [shape_a[2], shape_a[3]]);
        let frame_b = rotate(turn_b, [shape_b[2], shape_b[3]]);
        let place_a = rotate(turn_a, [shape_a[0], shape_a[1]]);
        let place_b = rotate(turn_b, [shape_b[0], shape_b[1]]);
        let offset = [between[0] + place_b[0] - place_a[0], between[1] + place_b[1] - place_a[1]];
        let pair = LanePair {
            p: unrotate(frame_a, offset),
            q: unrotate(frame_a, frame_b),
            a: [shape_a[4], shape_a[5], shape_a[6]],
            b: [shape_b[4], shape_b[5], shape_b[6]],
        };
        let limit = L::splat(token, context.speculative_distance);
        let rows = [&shape_a, &shape_b];
        let ahead = (context.fast && Ahead::matters(token, context, bodies, rows))
            .then(|| Ahead::of(token, context.dt, bodies, &pair, [place_a, place_b]));
        let reach = ahead.as_ref().map_or(limit, |ahead| ahead.way.max(limit));
        let shapes = [&block.shape_a[at..], &block.shape_b[at..]];
        let mut m = K::collide::<L>(token, context, shapes, &pair, reach);
        let share = [nearness(token, bodies), -limit, reach];
        let mut world = in_world(&m, frame_a, place_a, share);
        lead.take_back(&mut world, between, K::POINTS);
        let gap = world.separation[0].min(world.separation[1]);
        let guarded = L::splat(token, 1.5);
        let guarded = L::bits(L::or(shape_a[7].gt(guarded), shape_b[7].gt(guarded)));
        if guarded != 0 {
            correct_lanes::<L>(token, context, block, at, guarded, &pair, &mut m);
            world = in_world(&m, frame_a, place_a, share);
            lead.take_back(&mut world, between, K::POINTS);
        }
        // The other point of what touches may come down within the step.
        let near = L::or(world.separation[0].le(limit), world.separation[1].le(limit));
        let most = L::select(near, reach, limit);
        let valid = [world.separation[0].le(most), world.separation[1].le(most)];
        let touching =
            if K::POINTS == 2 { L::bits(L::or(valid[0], valid[1])) } else { L::bits(valid[0]) };
        let bodies = [body_a, body_b];
        let mut geometry =
            Self { manifold: world, most, valid, between, bodies, touching, closing: 0 };
        if let Some(ahead) = ahead {
            geometry.closing = ahead.closing::<K>(token, rows, &geometry, gap, limit);
        }
        geometry
    }

    /// Lanes whose points are apart and would come together in the step, as bits; only of what may meet something that no impulse
    /// moves: between two that move a near miss is lost in what they do next, and to look at each would take a tenth of a pile's step.
    #[inline(always)]
    fn coming<K: PairKernel>(&self, token: L::Token, dt: f32) -> u32 {
        let ([a, b], zero) = (&self.bodies, L::splat(token, 0.0));
        let fixed = a[Slot::INV_MASS].abs().min(b[Slot::INV_MASS].abs()).eq(zero);
        let gap = self.manifold.separation;
        let apart = self.touching & L::bits(L::and(gap[0].min(gap[1]).gt(zero), fixed));
        if apart == 0 {
            return 0;
        }
        let (normal, dt) = (self.manifold.normal, L::splat(token, dt));
        let mut least = gap[0] + dt * Arms::compute(self, normal, 0).approach(self, normal);
        if K::POINTS == 2 {
            least = least.min(gap[1] + dt * Arms::compute(self, normal, 1).approach(self, normal));
        }
        apart & L::bits(least.lt(zero))
    }

    /// Puts predicted contacts in the place of what the lanes have now.
    #[inline(always)]
    fn foresee(&mut self, token: L::Token, predictions: &Predictions, contacts: &[u32]) {
        let mut predicted = contacts.iter().take(L::WIDTH).map(|&contact| predictions.of(contact));
        if predicted.all(|ahead| ahead.is_none()) {
            return;
        }
        let mut lanes = [[0.0; BLOCK]; 13];
        self.manifold.store(&mut lanes);
        self.between[0].store(&mut lanes[10]);
        self.between[1].store(&mut lanes[11]);
        self.most.store(&mut lanes[12]);
        for (i, &contact) in contacts.iter().enumerate().take(L::WIDTH) {
            let Some(ahead) = predictions.of(contact) else { continue };
            let [p, q] = ahead.points;
            let (n, d, s, id) = (ahead.normal, ahead.between, ahead.separation, ahead.id);
            let values = [n.x, n.y, p.x, p.y, q.x, q.y, s[0], s[1], id[0], id[1], d.x, d.y];
            for (lane, value) in lanes.iter_mut().zip(values) {
                lane[i] = value;
            }
            // Whatever is there counts; what is not is the largest number.
            lanes[12][i] = 0.5 * f32::MAX;
        }
        self.manifold = LaneManifold::load(token, &lanes);
        self.between = [L::load(token, &lanes[10]), L::load(token, &lanes[11])];
        self.most = L::load(token, &lanes[12]);
        let separation = self.manifold.separation;
        self.valid = [separation[0].le(self.most), separation[1].le(self.most)];
        self.touching = L::bits(L::or(self.valid[0], self.valid[1]));
    }
}

/// Half of the least thickness of shapes with these rows; with guards, of the boxes around them.
#[inline(always)]
fn thickness<L: Lanes>(token: L::Token, row: &[L; 8]) -> L {
    (row[4].min(row[5]) + row[6]) * row[7].min(L::splat(token, 1.0))
}

/// How far the bodies of a stride move against each other in the step, metres.
struct Ahead<L: Lanes> {
    linear: [L; 2],
    /// What A and B turn, radians.
    turns: [L; 2],
    /// What turning adds at most.
    turn: L,
    /// From the centres of mass to the furthest points of the shapes, together.
    extent: L,
    /// All of it at most.
    way: L,
}

impl<L: Lanes> Ahead<L> {
    /// May some lane go so far that it closes in? Where none does, the way is shorter than the reach of contacts, too.
    #[inline(always)]
    fn matters(
        token: L::Token,
        context: &Context<'_>,
        [a, b]: [&[L; 8]; 2],
        [shape_a, shape_b]: [&[L; 8]; 2],
    ) -> bool {
        let extent =
            |shape: &[L; 8]| shape[0].abs() + shape[1].abs() + shape[4] + shape[5] + shape[6];
        let linear = (b[0] - a[0]).abs() + (b[1] - a[1]).abs();
        let turned = a[2].abs() * extent(shape_a) + b[2].abs() * extent(shape_b);
        let way = (linear + turned) * L::splat(token, context.dt);
        let slight = L::splat(token, SLIGHT * context.speculative_distance);
        let thin = (thickness(token, shape_a) + thickness(token, shape_b)) * L::splat(token, 0.5);
        // Less by more than rounding makes.
        L::bits(way.le(slight.min(thin) * L::splat(token, 0.99))) != L::bits(slight.eq(slight))
    }

    #[inline(always)]
    fn of(
        token: L::Token,
        dt: f32,
        [a, b]: [&[L; 8]; 2],
        pair: &LanePair<L>,
        places: [[L; 2]; 2],
    ) -> Self {
        let dt = L::splat(token, dt);
        let length = |x: L, y: L| (x * x + y * y).sqrt();
        // What is round turns without coming nearer.
        let arm =
            |half: [L; 3], place: [L; 2]| length(half[0], half[1]) + length(place[0], place[1]);
        let arms = [arm(pair.a, places[0]), arm(pair.b, places[1])];
        let turns = [a[2] * dt, b[2] * dt];
        let turn = turns[0].abs() * arms[0] + turns[1].abs() * arms[1];
        let extent = arms[0] + pair.a[2] + arms[1] + pair.b[2];
        let linear = [(b[0] - a[0]) * dt, (b[1] - a[1]) * dt];
        let way = length(linear[0], linear[1]) + turn;
        Self { linear, turns, turn, extent, way }
    }

    /// Lanes that would go further into each other than is harmless, as bits. `gap` is what is between the shapes.
    #[inline(always)]
    fn closing<K: PairKernel>(
        &self,
        token: L::Token,
        [shape_a, shape_b]: [&[L; 8]; 2],
        now: &Geometry<L>,
        gap: L,
        limit: L,
    ) -> u32 {
        let (a, b) = (thickness(token, shape_a), thickness(token, shape_b));
        let slight = (limit * L::splat(token, SLIGHT)).min((a + b) * L::splat(token, 0.5));
        let least = slight.max(L::splat(token, HARMLESS) * a.min(b));
        let along =
            now.manifold.normal[0] * self.linear[0] + now.manifold.normal[1] * self.linear[1];
        // No turn takes the disks around them closer.
        let apart =
            now.manifold.normal[0] * now.between[0] + now.manifold.normal[1] * now.between[1];
        let coming = self.turn.min(self.extent - apart + gap) - along;
        let zero = L::splat(token, 0.0);
        let coming = L::bits((coming - gap.max(zero)).gt(least));
        let first = self.pressing(now, 0, zero);
        let second = if K::POINTS == 2 { self.pressing(now, 1, zero) } else { zero };
        let pressing = L::bits(first.max(second).gt(least));
        now.touching & pressing | !now.touching & coming
    }

    /// How far the shapes come together at a point where they touch.
    #[inline(always)]
    fn pressing(&self, now: &Geometry<L>, k: usize, zero: L) -> L {
        let ([x, y], [dx, dy]) = (now.manifold.points[k], now.between);
        let cross = |x: L, y: L| x * now.manifold.normal[1] - y * now.manifold.normal[0];
        let turned = self.turns[1] * cross(x - dx, y - dy) - self.turns[0] * cross(x, y);
        let along =
            now.manifold.normal[0] * self.linear[0] + now.manifold.normal[1] * self.linear[1];
        L::select(now.valid[k], zero - (turned + along), zero)
    }
}

/// A manifold in the world's axes, from the centre of mass of A: out of a frame at a place. Its points, in the middle between the
/// surfaces, are taken by a share of the way to them towards A.
#[inline(always)]
fn in_world<L: Lanes>(
    m: &LaneManifold<L>,
    frame: [L; 2],
    place: [L; 2],
    [share, least, most]: [L; 3],
) -> LaneManifold<L> {
    let normal = rotate(frame, m.normal);
    let mut points = m.points;
    for (point, &separation) in points.iter_mut().zip(&m.separation) {
        let (turned, way) = (rotate(frame, *point), share * separation.clamp(least, most));
        for k in 0..2 {
            point[k] = turned[k] + place[k] - normal[k] * way;
        }
    }
    LaneManifold { normal, points, ..*m }
}

/// Looks again at the contacts with guarded shapes.
#[inline(always)]
fn correct_lanes<L: Lanes>(
    token: L::Token,
    context: &Context<'_>,
    block: &ManifoldBlock,
    at: usize,
    guarded: u32,
    pair: &LanePair<L>,
    m: &mut LaneManifold<L>,
) {
    let mut lanes = [[0.0; BLOCK]; 14];
    m.store(&mut lanes);
    for k in 0..2 {
        pair.p[k].store(&mut lanes[10 + k]);
        pair.q[k].store(&mut lanes[12 + k]);
    }
    surfaces_of_lanes(context, block, at, guarded, &mut lanes);
    *m = LaneManifold::load(token, &lanes);
}

/// The scalar part of [`correct_lanes`]: ten rows of a manifold, then the frame of B in A's.
fn surfaces_of_lanes(
    context: &Context<'_>,
    block: &ManifoldBlock,
    at: usize,
    mut guarded: u32,
    lanes: &mut [[f32; BLOCK]; 14],
) {
    while guarded != 0 {
        let i = guarded.trailing_zeros() as usize;
        guarded &= guarded - 1;
        let mut points = LanePoints { values: core::array::from_fn(|k| lanes[k][i]) };
        let (shape_a, shape_b) = (block.shape_a[at + i], block.shape_b[at + i]);
        if block.body_a[at + i] == block.body_b[at + i] {
            continue; // An empty lane.
        }
        let p = Vec2::new(lanes[10][i], lanes[11][i]);
        let b_in_a = Transform::new(p, Rot { c: lanes[12][i], s: lanes[13][i] });
        let pair = surfaces::Pair { shape_a, shape_b, b_in_a };
        surfaces::correct(context, pair, &mut points);
        for (lane, value) in lanes.iter_mut().zip(points.values) {
            lane[i] = value;
        }
    }
}

/// Vector between the centres of mass, and rotations of A and B.
#[inline(always)]
fn gather_poses<L: Lanes>(
    token: L::Token,
    poses: &[Pose],
    block: &ManifoldBlock,
    at: usize,
) -> ([L; 2], [L; 2], [L; 2]) {
    let bodies = [&block.body_a[at..], &block.body_b[at..]];
    let [x, y, ac, as_, bc, bs, ..] = L::gather(token, PosePairs { poses, bodies }, &[]);
    ([x, y], [ac, as_], [bc, bs])
}

/// The poses of the first pairs of bodies.
#[derive(Clone, Copy)]
struct PosePairs<'a> {
    poses: &'a [Pose],
    bodies: [&'a [u32]; 2],
}

impl RowSource for PosePairs<'_> {
    #[inline(always)]
    fn at<const N: usize>(self, _: &[u32]) -> impl RowsOf {
        self
    }
}

impl RowsOf for PosePairs<'_> {
    #[inline(always)]
    fn row(&self, i: usize) -> Row {
        let [a, b] =
            [&self.poses[self.bodies[0][i] as usize], &self.poses[self.bodies[1][i] as usize]];
        let between = b.p.relative_to(a.p);
        [between.x, between.y, a.q.c, a.q.s, b.q.c, b.q.s, 0.0, 0.0]
    }
}

/// A vector turned, or a rotation after another.
#[inline(always)]
fn rotate<L: Lanes>(q: [L; 2], v: [L; 2]) -> [L; 2] {
    [q[0] * v[0] - q[1] * v[1], q[1] * v[0] + q[0] * v[1]]
}

#[inline(always)]
fn unrotate<L: Lanes>(q: [L; 2], v: [L; 2]) -> [L; 2] {
    [q[0] * v[0] + q[1] * v[1], q[0] * v[1] - q[1] * v[0]]
}

/// Writes the constraints of a stride. Gives the lanes in which a much lighter body lies deep, as bits.
#[inline(always)]
fn write_constraint<L: Lanes, K: PairKernel>(
    token: L::Token,
    context: &Context<'_>,
    geometry: &Geometry<L>,
    blocks: &mut Blocks<'_>,
    index: usize,
    at: usize,
) -> u32 {
    let manifold = &mut blocks.manifolds[index];
    let constraint = &mut blocks.constraints[index];
    let [body_a, body_b] = geometry.bodies;
    let mut normal = geometry.manifold.normal;
    let inverses = Inverses::new(token, normal, [body_a, body_b]);
    if inverses.pinned {
        normal = straight(token, normal, inverses.along);
    }
    normal[0].store(&mut constraint.normal_x[at..]);
    normal[1].store(&mut constraint.normal_y[at..]);
    L::load(token, &manifold.friction[at..]).store(&mut constraint.friction[at..]);

    let old_id = [L::load(token, &manifold.id_1[at..]), L::load(token, &manifold.id_2[at..])];
    let zero = L::splat(token, 0.0);
    let mut old = [[zero; 2]; 2];
    for (old, point) in old.iter_mut().zip(&constraint.points) {
        old[0] = L::load(token, &point.normal_impulse[at..]);
        old[1] = L::load(token, &point.tangent_impulse[at..]);
    }
    let surface = &mut blocks.surfaces[index];
    let old_rest = [L::load(token, &surface.rest_1[at..]), L::load(token, &surface.rest_2[at..])];
    let mut rests = [zero; 2];
    let mut approach = [zero; 2];
    for (k, approach) in approach.iter_mut().enumerate().take(K::POINTS) {
        let valid = geometry.valid[k];
        let same = [geometry.manifold.id[k].eq(old_id[0]), geometry.manifold.id[k].eq(old_id[1])];
        let carry = |kind: usize| {
            let carried = L::select(same[0], old[0][kind], L::select(same[1], old[1][kind], zero));
            L::select(valid, carried, zero)
        };
        let (normal_impulse, tangent_impulse) = (carry(0), carry(1));
        let mut arms = Arms::compute(geometry, normal, k);
        let (normal_mass, tangent_mass) =
            inverses.masses(token, [&mut arms.normal, &mut arms.tangent]);
        *approach = arms.approach(geometry, normal);

        if blocks.heads[index].flags & flags::RESTS != 0 {
            rests[k] = L::select(same[0], old_rest[0], L::select(same[1], old_rest[1], zero));
        }
        let point = &mut constraint.points[k];
        geometry.manifold.separation[k].store(&mut point.separation[at..]);
        arms.normal[0].store(&mut point.normal_arm_a[at..]);
        arms.normal[1].store(&mut point.normal_arm_b[at..]);
        arms.tangent[0].store(&mut point.tangent_arm_a[at..]);
        arms.tangent[1].store(&mut point.tangent_arm_b[at..]);
        L::select(valid, normal_mass, zero).store(&mut point.normal_mass[at..]);
        L::select(valid, tangent_mass, zero).store(&mut point.tangent_mass[at..]);
        normal_impulse.store(&mut point.normal_impulse[at..]);
        tangent_impulse.store(&mut point.tangent_impulse[at..]);
    }
    let none = L::splat(token, -1.0);
    L::select(geometry.valid[0], geometry.manifold.id[0], none).store(&mut manifold.id_1[at..]);
    if K::POINTS == 2 {
        L::select(geometry.valid[1], geometry.manifold.id[1], none).store(&mut manifold.id_2[at..]);
    }
    if blocks.heads[index].flags & flags::RESTS != 0 {
        rests[0].store(&mut surface.rest_1[at..]);
        rests[1].store(&mut surface.rest_2[at..]);
    }
    if blocks.heads[index].flags & (flags::RESTITUTION | flags::SUMMED) != 0 {
        approach[0].store(&mut surface.approach_1[at..]);
        approach[1].store(&mut surface.approach_2[at..]);
        zero.store(&mut surface.total_1[at..]);
        zero.store(&mut surface.total_2[at..]);
    }
    let [a, b] = [body_a[3].abs(), body_b[3].abs()];
    let deepest = geometry.manifold.separation[0].min(geometry.manifold.separation[1]);
    let deep = L::splat(token, -SUNK * context.speculative_distance);
    let uneven = a.max(b).gt(L::splat(token, HEAVIER) * a.min(b));
    L::bits(L::and(deepest.lt(deep), L::and(uneven, a.min(b).gt(zero))))
}

/// Lever arms of a point: cross products of its anchors with normal and tangent, for A and B.
///
/// The tangent is the normal turned clockwise, so r x t = -(r . n).
struct Arms<L> {
    normal: [L; 2],
    tangent: [L; 2],
}

impl<L: Lanes> Arms<L> {
    #[inline(always)]
    fn compute(geometry: &Geometry<L>, [nx, ny]: [L; 2], k: usize) -> Self {
        let a = geometry.manifold.points[k];
        let b = [a[0] - geometry.between[0], a[1] - geometry.between[1]];
        Self {
            normal: [a[0] * ny - a[1] * nx, b[0] * ny - b[1] * nx],
            tangent: [-(a[0] * nx + a[1] * ny), -(b[0] * nx + b[1] * ny)],
        }
    }

    /// How fast the point of A and that of B part along the normal.
    #[inline(always)]
    fn approach(&self, geometry: &Geometry<L>, [nx, ny]: [L; 2]) -> L {
        let [a, b] = &geometry.bodies;
        nx * (b[0] - a[0]) + ny * (b[1] - a[1]) + self.normal[1] * b[2] - self.normal[0] * a[2]
    }
}
