//! Surfaces made of several shapes: contacts that only the seams between the shapes make are corrected.
//!
//! Two boxes side by side make one floor, but each box knows only itself: something that slides over them
//! catches on the side of the next one, which is inside the floor. So static shapes are *guarded* where
//! others touch them (tile beside tile, across bodies too), and so are shapes of one body that moves, segments
//! of a chain and one-way platforms. After the kernels, a contact with a guarded shape is looked at again:
//!
//! - a normal out of a face is a ghost if another static shape covers the face there;
//! - a normal from a corner is a ghost if another static shape goes on in its direction: it is then not
//!   in the normal cone of both shapes together;
//! - a ghost is replaced by the contact with the highest face that is not covered, or by none.
//!
//! Which faces and corners are touched by others is found when static shapes come, go or are moved
//! (`stages/touched.rs`), so the usual contact (on a free face) costs a look at a few bits. Worlds without static neighbours pay one
//! comparison a stride of lanes.

use super::narrow_context::{Context, Ground};
use super::one_way;
use super::pairs::may_collide;
use crate::broad_phase::{ProxyId, ProxyKind};
use crate::describe::ChainLink;
use crate::dynamics::{ShapeRecord, Slot, guard};
use crate::geometry::manifold::{
    Manifold, collide_face, face_of, nearest_vertex, point_gap, support_height,
};
use crate::geometry::{Core, Shape};
use crate::math::{Aabb, DVec2, Pose, Transform, Vec2};
use core::cell::OnceCell;

/// Shapes this close to each other make one surface, metres; multiplied by the length unit.
pub(super) const TOLERANCE: f32 = 0.002;
/// A face counts as covered at a point if it is so there and this far to both sides, metres; multiplied likewise.
const REACH: f32 = 0.02;
/// Lines count as so thick where they go on from a face: more than [`REACH`], metres; multiplied likewise.
const THICK: f32 = 0.05;
/// A corner's normal is free if the neighbours rise by no more than this above it, metres.
const CONE_TOLERANCE: f32 = 5.0e-4;
/// A corner of a chain has a normal if the next segment rises by no more than this sine above it.
const LINK_TOLERANCE: f32 = 1.0e-3;

/// A manifold of one lane as it is looked at: [`Manifold`] with ids as the kernels have them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LanePoints {
    /// Normal x, y; points x, y, x, y; separations; ids, as floats.
    pub(crate) values: [f32; 10],
}

impl LanePoints {
    const NONE: Self =
        Self { values: [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, f32::MAX, f32::MAX, 0.0, 0.0] };

    fn normal(&self) -> Vec2 {
        Vec2::new(self.values[0], self.values[1])
    }

    fn point(&self, k: usize) -> Vec2 {
        Vec2::new(self.values[2 + 2 * k], self.values[3 + 2 * k])
    }

    /// Either point may be missing.
    fn is_empty(&self) -> bool {
        self.values[6] > f32::MAX * 0.5 && self.values[7] > f32::MAX * 0.5
    }

    fn is_valid(&self, k: usize, limit: f32) -> bool {
        self.values[6 + k] <= limit
    }

    /// A manifold in the frame of a shape, of which this is the frame of the rounded box.
    pub(crate) fn of(manifold: &Manifold, frame: Transform) -> Self {
        Self::from_manifold(manifold, frame.inverse(), 1.0)
    }

    /// The way back.
    pub(crate) fn manifold(&self, frame: Transform, limit: f32) -> Manifold {
        let mut manifold = Manifold::EMPTY;
        manifold.normal = frame.q.rotate(self.normal());
        for k in 0..2 {
            if self.is_valid(k, limit) {
                let point = &mut manifold.points[usize::from(manifold.count)];
                point.point = frame.apply(self.point(k));
                point.separation = self.values[6 + k];
                point.id = self.values[8 + k] as u16;
                manifold.count += 1;
            }
        }
        manifold
    }

    fn from_manifold(manifold: &Manifold, frame: Transform, sign: f32) -> Self {
        let mut lane = Self::NONE;
        let normal = frame.q.rotate(manifold.normal) * sign;
        (lane.values[0], lane.values[1]) = (normal.x, normal.y);
        for (k, point) in manifold.points().iter().enumerate() {
            let place = frame.apply(point.point);
            (lane.values[2 + 2 * k], lane.values[3 + 2 * k]) = (place.x, place.y);
            lane.values[6 + k] = point.separation;
            lane.values[8 + k] = f32::from(point.id);
        }
        lane
    }
}

/// The pair of a lane.
#[derive(Clone, Copy)]
pub(crate) struct Pair {
    pub(crate) shape_a: u32,
    pub(crate) shape_b: u32,
    /// Frame of B's rounded box in that of A's.
    pub(crate) b_in_a: Transform,
}

/// Corrects the manifold of a pair of which one shape at least is guarded.
pub(crate) fn correct(context: &Context<'_>, pair: Pair, lane: &mut LanePoints) {
    let guards = &context.ground.shapes.guards;
    let frames = [Transform::IDENTITY, pair.b_in_a];
    let shapes = [pair.shape_a, pair.shape_b];
    for side in [0, 1] {
        if guards[shapes[side] as usize] == 0 || lane.is_empty() {
            continue;
        }
        let out = if side == 0 { lane.normal() } else { -pair.b_in_a.q.unrotate(lane.normal()) };
        if guards[shapes[side] as usize] & guard::free(out) != 0 {
            continue;
        }
        let view = View::new(context, shapes[side], shapes[1 - side], frames, side);
        match view.judge(lane) {
            Verdict::Keep => {}
            Verdict::Drop => *lane = LanePoints::NONE,
            Verdict::Replace(manifold) => {
                let sign = if side == 0 { 1.0 } else { -1.0 };
                *lane = LanePoints::from_manifold(&manifold, frames[side], sign);
            }
        }
    }
}

enum Verdict {
    Keep,
    Drop,
    Replace(Manifold),
}

/// A guarded shape among its neighbours, as another shape meets it. Everything is in the frame of the
/// guarded shape's rounded box.
pub(crate) struct Seams<'a> {
    ground: Ground<'a>,
    own: u32,
    record: &'a ShapeRecord,
    other: u32,
    place: Transform,
    other_core: OnceCell<Core>,
    guard: u32,
    core: Core,
}

impl<'a> Seams<'a> {
    /// The same from the place of the other shape in the frame of its own.
    pub(crate) fn of(ground: Ground<'a>, own: u32, other: u32, place: Transform) -> Self {
        let [own_frame, frame] =
            [own, other].map(|shape| ground.shapes.records[shape as usize].box_frame);
        Self::new(ground, own, other, place.compose(frame).relative_to(own_frame))
    }

    /// `place` is that of the other shape's rounded box in the frame of its own.
    pub(crate) fn new(ground: Ground<'a>, own: u32, other: u32, place: Transform) -> Self {
        let record = &ground.shapes.records[own as usize];
        let guard = ground.shapes.guards[own as usize];
        let (core, other_core) = (boxed_core(record), OnceCell::new());
        Self { ground, own, record, other, place, other_core, guard, core }
    }

    /// That of the other shape: most looks need none, where no neighbour is near.
    fn other_core(&self) -> &Core {
        let shape = || boxed_core(&self.ground.shapes.records[self.other as usize]);
        self.other_core.get_or_init(|| shape().transformed(self.place))
    }

    /// Does the surface made by all static shapes lack this normal at these points of contact?
    pub(crate) fn is_ghost(&self, points: [Option<Vec2>; 2], normal: Vec2) -> bool {
        if let Some(link) = self.record.link {
            return !self.link_has(link, normal);
        }
        if let Some(face) = face_of(&self.core, normal) {
            return self.is_within(face, points);
        }
        let is_ghost = |point: Vec2| {
            let vertex = nearest_vertex(&self.core, point);
            self.guard & guard::corner(vertex) != 0
                && self.goes_on(self.core.points[vertex], normal)
        };
        // The end of a board that comes down tilted has a true corner beside the one within the board.
        let count = if self.kind() == Some(ProxyKind::Dynamic) { 2 } else { 1 };
        let mut looked_at = points.into_iter().flatten().take(count).peekable();
        looked_at.peek().is_some() && looked_at.all(is_ghost)
    }

    /// Has a segment of a chain this normal: that of its face, or one of a corner that sticks out?
    fn link_has(&self, link: ChainLink, normal: Vec2) -> bool {
        if face_of(&self.core, normal) == Some(0) {
            return true;
        }
        let (corner, peak) = self.link_corner(link, normal);
        // The next segment may be gone.
        let free = peak.is_some() || !self.goes_on(corner, normal);
        free && normal.dot(self.core.normal(0)) > 0.0
    }

    /// The corner that a normal is of, and where it sticks out the direction out of the next segment, of any length.
    fn link_corner(&self, link: ChainLink, normal: Vec2) -> (Vec2, Option<Vec2>) {
        let (a, b) = (self.core.points[0], self.core.points[1]);
        let at_start = normal.dot(b - a) < 0.0;
        let (corner, end) = if at_start { (a, link.previous) } else { (b, link.next) };
        let way = end.map(|end| self.record.box_frame.unapply(end) - corner);
        let peak = way.filter(|way| normal.dot(*way) <= LINK_TOLERANCE * way.length());
        (corner, peak.map(|way| if at_start { way.perp() } else { -way.perp() }))
    }

    /// Is a face where it is touched no part of the surface, or not of the side of it that the other shape is on?
    fn is_within(&self, face: usize, points: [Option<Vec2>; 2]) -> bool {
        self.guard & guard::face(face) != 0 && self.is_covered(face, points)
            || self.guard & guard::nook(face) != 0 && self.is_hidden(face, points)
    }

    /// Is a face of a nook hidden from the other shape's middle behind what makes the nook with it, at all points of contact? What slides
    /// over a seam has its middle before the undersides of both pieces, perhaps, but is not between these.
    fn is_hidden(&self, face: usize, points: [Option<Vec2>; 2]) -> bool {
        let tolerance = TOLERANCE * self.ground.length_unit;
        let ((start, end), normal) = (self.core.edge(face), self.core.normal(face));
        let viewer = middle(self.other_core());
        let mut hidden = points.map(|point| point.is_none());
        for (corner, sense) in [(start, 1.0), (end, -1.0)] {
            self.each_neighbour(&[corner], |neighbour| {
                let gaps = [corner, viewer].map(|point| point_gap(neighbour, point));
                if gaps[0] > tolerance || gaps[1] <= 0.0 {
                    return;
                }
                for (point, hidden) in points.iter().zip(&mut hidden) {
                    let is_between =
                        |from: Vec2, what: Vec2| sense * (what - from).cross(viewer - from) < 0.0;
                    *hidden |= neighbour.points().iter().any(|&what| {
                        normal.dot(what - corner) > tolerance
                            && is_between(corner, what)
                            && point.is_some_and(|point| is_between(point, what))
                    });
                }
            });
        }
        points != [None; 2] && hidden == [true; 2]
    }

    /// Do other static shapes cover a face around all points of contact with it?
    fn is_covered(&self, face: usize, points: [Option<Vec2>; 2]) -> bool {
        let unit = self.ground.length_unit;
        let (start, end) = self.core.edge(face);
        let along = self.core.normal(face).perp();
        let length = along.dot(end - start);
        let probe = |at: f32| start + along * at.max(0.0).min(length);
        let places = points.into_iter().flatten().map(|point| along.dot(point - start));
        // As a rule nothing is there.
        if !places.clone().next().is_some_and(|at| self.covers(&[probe(at)])) {
            return false;
        }
        let over = along.dot(middle(self.other_core()) - start);
        let mut probes = [Vec2::ZERO; 6];
        let mut count = 0;
        for at in places {
            let (mut low, mut high) = (at - REACH * unit, at + REACH * unit);
            // Over an end of the face near by the other shape meets what covers that from its side, however thin it is.
            if high >= length && over > length {
                low = at;
            } else if low <= 0.0 && over < 0.0 {
                high = at;
            }
            // In a slot both sides may be within walls.
            probes[count..count + 3].copy_from_slice(&[low, at, high].map(probe));
            count += 3;
        }
        self.covers(&probes[..count])
    }

    /// Do others cover all of up to six places of a face?
    fn covers(&self, probes: &[Vec2]) -> bool {
        let mut covered = [false; 6];
        self.each_neighbour(probes, |neighbour| {
            // What the other shape is in itself makes no surface for it.
            let within = point_gap(neighbour, middle(self.other_core())) <= 0.0;
            let tolerance = TOLERANCE * self.ground.length_unit;
            for (probe, covered) in probes.iter().zip(&mut covered) {
                *covered |= !within && point_gap(neighbour, *probe) <= tolerance;
            }
        });
        covered[..probes.len()].iter().all(|covered| *covered)
    }

    /// Do others go on from the end of a face, as high as that or higher? Looked at is no further beyond it than need be.
    pub(crate) fn goes_on_level(&self, end: Vec2, beyond: Vec2) -> bool {
        if self.guard == 0 {
            return false;
        }
        let (unit, frame) = (self.ground.length_unit, self.record.box_frame);
        let most = REACH * unit / beyond.length();
        let further = end + beyond * if most < 1.0 { most } else { 1.0 };
        let probes = [end, further].map(|point| frame.unapply(point));
        let mut covered = [false; 2];
        self.each_neighbour(&probes, |neighbour| {
            for (probe, covered) in probes.iter().zip(&mut covered) {
                *covered |= point_gap(neighbour, *probe) <= TOLERANCE * unit;
            }
        });
        covered == [true; 2]
    }

    /// Does another static shape go on from a corner in the direction of the normal? From one that is round, if the place that it is touched
    /// at lies on or below a face of the other, so that this bears what comes there.
    fn goes_on(&self, corner: Vec2, normal: Vec2) -> bool {
        let (unit, radius) = (self.ground.length_unit, self.core.radius);
        let place = corner + normal * radius;
        let mut ghost = false;
        self.each_neighbour(&[place], |neighbour| {
            let is_below = |face: usize| {
                let ((start, end), out) = (neighbour.edge(face), neighbour.normal(face));
                let at = out.perp().dot(place - start);
                out.dot(normal) > 0.0 && at >= 0.0 && at <= out.perp().dot(end - start)
            };
            ghost |= point_gap(neighbour, place) <= TOLERANCE * unit
                && support_height(neighbour, normal) - normal.dot(place) > CONE_TOLERANCE * unit
                && (radius == 0.0 || (0..neighbour.edge_count()).any(is_below));
        });
        ghost
    }

    /// Does what makes one surface with this shape at a point lie over a face, by a real width?
    fn lies_over(&self, (start, end): (Vec2, Vec2), point: Vec2) -> bool {
        let along = (end - start).normalized();
        let mut over = false;
        self.each_neighbour(&[point], |neighbour| {
            let behind = along.dot(end).min(support_height(neighbour, along));
            let before = along.dot(start).max(-support_height(neighbour, -along));
            // What only passes through the plane of the face is beside it, or goes on below what is met.
            let is_before = along.perp().dot(middle(neighbour) - start) <= 0.0;
            over |= is_before && behind - before > REACH * self.ground.length_unit;
        });
        over
    }

    /// Does the other shape pass a one-way neighbour, as it is not on the solid side of that? Among one-way shapes all make one surface.
    fn is_passed_from_below(&self, neighbour: &ShapeRecord, core: &Core, place: Transform) -> bool {
        let Some(way) = way_of(neighbour).filter(|_| self.record.one_way.is_none()) else {
            return false;
        };
        let way = place.q.rotate(way);
        let lowest = -support_height(self.other_core(), -way);
        lowest < support_height(core, way) - REACH * self.ground.length_unit
    }

    /// How the other shape moves against this one at a point, metres a second.
    fn motion(&self, point: Vec2) -> Vec2 {
        let Ground { bodies, shapes, .. } = self.ground;
        let pose = self.own_pose();
        let place = pose.apply(point);
        let velocity = |shape: &ShapeRecord| {
            let row = &bodies.rows[shape.body as usize];
            let arm = place.relative_to(bodies.poses[shape.body as usize].p);
            Vec2::new(row[Slot::VX], row[Slot::VY]) + arm.perp() * row[Slot::W]
        };
        pose.q.unrotate(velocity(&shapes.records[self.other as usize]) - velocity(self.record))
    }

    fn kind(&self) -> Option<ProxyKind> {
        self.ground.broad_phase.kind(ProxyId(self.record.proxy))
    }

    fn own_pose(&self) -> Pose {
        boxed_pose(&self.ground.bodies.poses, self.record)
    }

    /// Visits the cores of the shapes near some points that make one surface with this one, in this frame
    /// and no fixed order, as the other shape meets them.
    fn each_neighbour(&self, points: &[Vec2], mut visit: impl FnMut(&Core)) {
        let Ground { bodies, shapes, broad_phase, joints, custom, length_unit } = self.ground;
        let pose = self.own_pose();
        let bounds = world_box(pose, points, TOLERANCE * length_unit);
        let Some(kind) = self.kind() else { return };
        broad_phase.each_of(kind, &bounds, u64::MAX, |index| {
            let neighbour = &shapes.records[index as usize];
            if index != self.own
                && is_ground(neighbour, self.record, kind)
                && neighbour.body != shapes.records[self.other as usize].body
                && may_collide((bodies, shapes, joints), custom, [index, self.other])
            {
                let place = boxed_pose(&bodies.poses, neighbour).relative_to(pose);
                let core = boxed_core(neighbour).transformed(place);
                // Only what is a line is asked.
                let before = || middle(self.other_core()) - core.points[0];
                let is_before = core.count != 2 || core.normal(0).dot(before()) >= 0.0;
                if self.is_passed_from_below(neighbour, &core, place) {
                    return;
                }
                if let Some(core) = solid(core, neighbour.link, is_before, length_unit) {
                    visit(&core);
                }
            }
        });
    }
}

/// A contact seen from the guarded shape.
struct View<'a> {
    context: &'a Context<'a>,
    seams: Seams<'a>,
    /// Frame of the guarded shape's rounded box: everything else is in it.
    frame: Transform,
    /// 1 where the guarded shape is A: the kernels' normal points out of it.
    sign: f32,
}

impl<'a> View<'a> {
    fn new(
        context: &'a Context<'a>,
        own: u32,
        other: u32,
        frames: [Transform; 2],
        side: usize,
    ) -> Self {
        let other_in_own = frames[1 - side].relative_to(frames[side]);
        Self {
            context,
            seams: Seams::new(context.ground, own, other, other_in_own),
            frame: frames[side],
            sign: if side == 0 { 1.0 } else { -1.0 },
        }
    }

    fn judge(&self, lane: &LanePoints) -> Verdict {
        let normal = self.frame.q.unrotate(lane.normal()) * self.sign;
        if let Some(link) = self.seams.record.link {
            return self.judge_link(normal, link);
        }
        if self.seams.guard & guard::ONE_WAY != 0 {
            let solid = match face_of(&self.seams.core, normal) {
                Some(face) => self.is_solid(face),
                None => self.is_against_way(normal) && self.is_no_end(lane, normal),
            };
            if !solid {
                return self.best_face();
            }
        }
        let is_ghost = self.is_ghost(lane, normal) && !self.is_before_a_face(lane, normal);
        if is_ghost { self.best_face() } else { Verdict::Keep }
    }

    /// A segment of a chain: its face, or the cone of normals at a corner that sticks out.
    fn judge_link(&self, normal: Vec2, link: ChainLink) -> Verdict {
        let face = self.seams.core.normal(0);
        let a = self.seams.core.points[0];
        let Self { seams, context, .. } = self;
        let is_behind = face.dot(middle(seams.other_core()) - a) < 0.0;
        // What leans on the end has its middle behind, perhaps.
        let is_open = link.previous.is_none() || link.next.is_none();
        // At a sharp peak each of its segments has the normals that the other turns its back on.
        let (corner, peak) = seams.link_corner(link, normal);
        let peak = peak.filter(|_| face_of(&seams.core, normal).is_none());
        let before = middle(seams.other_core()) - corner;
        let is_next = peak.is_some_and(|out| normal.dot(out) <= 0.0 && out.dot(before) > 0.0);
        let is_met = !is_behind || is_next || is_open && self.meets_a_corner(normal);
        if is_met && seams.link_has(link, normal) {
            return Verdict::Keep;
        }
        if is_behind || peak.is_some_and(|out| normal.dot(out) > 0.0) {
            return Verdict::Drop;
        }
        let limit = context.speculative_distance;
        let manifold = collide_face(&seams.core, 0, [0.0; 2], seams.other_core(), limit);
        if manifold.count > 0 { Verdict::Replace(manifold) } else { self.ahead() }
    }

    /// The contact with a face in its plane, beyond its end, where the other shape comes within the step from a
    /// neighbour that stands higher than the plane. In a bowl it would sink into the next face else, and be lifted out of it for nothing.
    fn ahead(&self) -> Verdict {
        let Self { seams, context, .. } = self;
        let (core, other) = (&seams.core, seams.other_core());
        for face in (0..core.edge_count()).filter(|&face| self.is_solid(face)) {
            let (edge, normal) = (core.edge(face), core.normal(face));
            let [start, end] = [edge.0, edge.1].map(|end| end + normal * core.radius);
            let (along, low) = (normal.perp(), other.points[other.support(-normal)]);
            let at = along.dot(low - start);
            let beyond = [-at, at - along.dot(end - start)].map(|beyond| beyond.max(0.0));
            let over = beyond[0] + beyond[1];
            let (height, foot) = (normal.dot(low - start) - other.radius, start + along * at);
            let comes = normal.dot(seams.motion(low)) * context.dt;
            let is_behind = normal.dot(middle(other) - start) <= 0.0;
            if over == 0.0 || is_behind || height + comes >= 0.0 {
                continue;
            }
            let deep = LINK_TOLERANCE * (over + REACH * seams.ground.length_unit);
            let mut is_covered = false;
            seams.each_neighbour(&[foot], |core| is_covered |= point_gap(core, foot) < -deep);
            let limit = context.speculative_distance;
            let manifold =
                collide_face(core, face, beyond.map(|beyond| 1.001 * beyond), other, limit);
            if is_covered && manifold.count > 0 {
                return Verdict::Replace(manifold);
            }
        }
        Verdict::Drop
    }

    /// Is it a corner within the surface of a body that moves freely, before a face of the other over which that surface goes on?
    /// Then the face is met as what it is: by a face of this part the normal would be tilted.
    fn is_before_a_face(&self, lane: &LanePoints, normal: Vec2) -> bool {
        let seams = &self.seams;
        let Some(face) = face_of(seams.other_core(), -normal) else { return false };
        let corner = seams.core.points[self.corner_of(lane)];
        seams.kind() == Some(ProxyKind::Dynamic)
            && face_of(&seams.core, normal).is_none()
            && seams.lies_over(seams.other_core().edge(face), corner)
    }

    /// The corner at which the contact is.
    fn corner_of(&self, lane: &LanePoints) -> usize {
        let k = usize::from(!lane.is_valid(0, self.context.speculative_distance));
        nearest_vertex(&self.seams.core, self.frame.unapply(lane.point(k)))
    }

    /// Does the solid side of a one-way shape go on beyond this corner, on the shape itself or on another? To a face of the other shape
    /// ends are corners, too.
    fn is_no_end(&self, lane: &LanePoints, normal: Vec2) -> bool {
        let Seams { core, guard, .. } = &self.seams;
        let (corner, last) = (self.corner_of(lane), core.count - 1);
        core.radius > 0.0
            || self.meets_a_corner(normal)
            || guard & guard::corner(corner) != 0
            || self.is_solid(corner) && self.is_solid(if corner > 0 { corner - 1 } else { last })
    }

    /// Is a corner met by a face of the other shape?
    fn meets_a_corner(&self, normal: Vec2) -> bool {
        let seams = &self.seams;
        face_of(&seams.core, normal).is_none() && face_of(seams.other_core(), -normal).is_some()
    }

    fn is_ghost(&self, lane: &LanePoints, normal: Vec2) -> bool {
        let limit = self.context.speculative_distance;
        let points =
            [0, 1].map(|k| lane.is_valid(k, limit).then(|| self.frame.unapply(lane.point(k))));
        self.seams.is_ghost(points, normal)
    }

    /// The contact with the highest solid face that is not covered and has the other shape's middle in
    /// front of it.
    fn best_face(&self) -> Verdict {
        let middle = middle(self.seams.other_core());
        let mut tried = 0_u32;
        loop {
            let mut best: Option<(usize, f32, Manifold)> = None;
            for face in 0..self.seams.core.edge_count() {
                if tried & 1 << face != 0 || !self.is_solid(face) {
                    continue;
                }
                // Out through the far side is no way out.
                let start = self.seams.core.points[face];
                if self.seams.core.normal(face).dot(middle - start) <= 0.0 {
                    continue;
                }
                let manifold = self.collide(face);
                let Some(deepest) = manifold.deepest() else { continue };
                let height = deepest.separation;
                if best.is_none_or(|(_, highest, _)| height > highest) {
                    best = Some((face, height, manifold));
                }
            }
            let Some((face, _, manifold)) = best else { return self.ahead() };
            let points = [0, 1].map(|k| manifold.points().get(k).map(|p| p.point));
            if !self.seams.is_within(face, points) {
                return Verdict::Replace(manifold);
            }
            tried |= 1 << face;
        }
    }

    /// The contact with a face. Where others touch its ends it goes on a little: a ball whose middle is over the gap between two
    /// tiles would find neither.
    fn collide(&self, face: usize) -> Manifold {
        let Self { seams, context, .. } = self;
        let beyond = [face, (face + 1) % seams.core.points().len()].map(|corner| {
            let goes_on = seams.guard & guard::corner(corner) != 0;
            if goes_on { TOLERANCE * seams.ground.length_unit } else { 0.0 }
        });
        let limit = context.speculative_distance;
        collide_face(&seams.core, face, beyond, seams.other_core(), limit)
    }

    /// May something stand on this face?
    fn is_solid(&self, face: usize) -> bool {
        self.is_against_way(self.seams.core.normal(face))
    }

    /// May something stand on what has this normal?
    fn is_against_way(&self, normal: Vec2) -> bool {
        way_of(self.seams.record).is_none_or(|way| normal.dot(way) > one_way::LEAST_COSINE)
    }
}

/// The direction of a one-way platform, in the frame of its rounded box.
fn way_of(record: &ShapeRecord) -> Option<Vec2> {
    let frame = record.central.compose(record.box_frame);
    record.one_way.map(|way| frame.q.unrotate(way).normalized())
}

/// Can a shape cover another, `own`, of the same kind of body? What moves makes a surface only with the
/// rest of its body.
pub(super) fn is_ground(record: &ShapeRecord, own: &ShapeRecord, kind: ProxyKind) -> bool {
    !record.sensor && (kind == ProxyKind::Static || record.body == own.body)
}

/// What goes on behind a core: a line, from before or behind its first face, is one side of something thick. The segment of a chain is
/// so from before alone; nothing is there from behind.
pub(super) fn solid(
    core: Core,
    link: Option<ChainLink>,
    is_before: bool,
    length_unit: f32,
) -> Option<Core> {
    if core.count != 2 || core.radius > 0.0 {
        return Some(core);
    }
    let ([a, b], inwards) =
        ([core.points[0], core.points[1]], core.normal(0) * (-THICK * length_unit));
    if is_before {
        Some(Core::new(&[a, b, b + inwards, a + inwards], 0.0))
    } else if link.is_none() {
        Some(Core::new(&[b, a, a - inwards, b - inwards], 0.0))
    } else {
        None
    }
}

/// The core in the frame of the shape's rounded box.
pub(super) fn boxed_core(record: &ShapeRecord) -> Core {
    record.shape.core().transformed(record.box_frame.inverse())
}

/// The frame of a shape's rounded box in the world.
pub(super) fn boxed_pose(poses: &[Pose], record: &ShapeRecord) -> Pose {
    poses[record.body as usize].compose(record.central.compose(record.box_frame))
}

pub(crate) fn middle(core: &Core) -> Vec2 {
    let sum = core.points().iter().fold(Vec2::ZERO, |sum, point| sum + *point);
    sum / core.count as f32
}

pub(super) fn world_box(pose: Pose, points: &[Vec2], margin: f32) -> Aabb {
    let mut bounds = Aabb::EMPTY;
    for point in points {
        let place: DVec2 = pose.apply(*point);
        bounds = bounds.union(&Aabb::rounded_out(place, place));
    }
    bounds.grown(margin)
}

/// May something that moves by `motion` (metres, world) from behind or inside pass this shape? For the
/// continuous stage: `middle` is that of the moving shape and `place` the other's frame, in one frame. Turning takes a point by
/// `turned` more at most.
pub(crate) fn lets_pass(
    record: &ShapeRecord,
    place: Transform,
    body_rotation: crate::math::Rot,
    middle: impl FnOnce() -> Vec2,
    (motion, turned): (Vec2, f32),
) -> bool {
    if let (Some(_), Shape::Segment { a, b }) = (record.link, record.shape) {
        let way = b - a;
        let outside = Vec2::new(way.y, 0.0 - way.x);
        return outside.dot(place.unapply(middle()) - a) < 0.0;
    }
    one_way::lets_pass(record, body_rotation, motion, turned)
}
