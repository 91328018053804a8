//! Continuous collision: fast bodies stop where they would have gone through something.
//!
//! A body that moved further than a part of its own thickness is swept from where it started the step
//! to where the solver put it. It is set back to the first impact with a static or kinematic shape; a
//! bullet also to that with a dynamic one. Its velocity stays: the contact solver deals with it in the
//! next step, when there is a contact. The time that is lost is at most a step.

use super::finalize::{FastBody, update_boxes};
use super::one_way;
use super::pairs::PairRule;
use super::surfaces::{self, Ground, Seams};
use crate::broad_phase::{BroadPhase, ProxyKind};
use crate::dynamics::{Bodies, Joints, ShapeRecord, Shapes};
use crate::geometry::{Shape, Sweep, ToiState, distance, time_of_impact};
use crate::math::{Aabb, Pose, Rot, Transform, Vec2};
use crate::threads::Team;
use core::ops::ControlFlow;

/// What decides about pairs besides filters.
#[derive(Clone, Copy)]
pub(crate) struct Rules<'a> {
    /// The user's word on a pair of shapes, if there is any.
    pub(crate) custom: Option<&'a dyn PairRule>,
    /// See [`Settings::length_unit`](crate::Settings).
    pub(crate) length_unit: f32,
}

/// Fast bodies that one member of the team sweeps at a time.
const CHUNK: usize = 16;

/// Sweeps the fast bodies, bullets last and one by one: they see where all others have ended.
pub(crate) fn run(
    team: &Team,
    fast: &mut [FastBody],
    bodies: &mut Bodies,
    shapes: &mut Shapes,
    joints: &Joints,
    broad_phase: &mut BroadPhase,
    rules: Rules<'_>,
) {
    let is_bullet = |bodies: &Bodies, fast: &FastBody| bodies.infos[fast.body as usize].bullet;
    let scene = Scene { bodies, shapes, joints, broad_phase, rules };
    team.for_each_chunk_mut(fast, CHUNK, |_, fast| {
        for fast in fast.iter_mut().filter(|fast| !is_bullet(scene.bodies, fast)) {
            fast.fraction = Impact { fast, bullets: &[], index: 0, scene }.first_fraction();
        }
    });
    for fast in &*fast {
        if !is_bullet(bodies, fast) {
            place(fast, bodies, shapes, broad_phase);
        }
    }
    for index in 0..fast.len() {
        if is_bullet(bodies, &fast[index]) {
            let scene = Scene { bodies, shapes, joints, broad_phase, rules };
            let impact = Impact { fast: &fast[index], bullets: fast, index, scene };
            fast[index].fraction = impact.first_fraction();
            place(&fast[index], bodies, shapes, broad_phase);
        }
    }
}

/// Sets a body back to its first impact, if it has one, and updates its boxes.
fn place(fast: &FastBody, bodies: &mut Bodies, shapes: &mut Shapes, broad_phase: &mut BroadPhase) {
    let fraction = fast.fraction;
    if fraction < 1.0 {
        let position = fast.start.p + fast.motion * fraction;
        let rotation = fast.start.q.integrate(fast.turn * fraction);
        bodies.poses[fast.body as usize] = Pose::new(position, rotation);
    }
    update_boxes(bodies, shapes, broad_phase, fast.body, fast.motion * fraction);
}

/// A disk about the middle of a shape, half as thick as it. What a shape touches already at the start of
/// the step is the contact solver's affair, which holds a corner and lets the rest turn about it; but
/// the middle must not pass.
struct Inner {
    disk: Shape,
    sweep: Sweep,
}

impl Inner {
    fn new(record: &ShapeRecord, body: &Sweep) -> Self {
        let disk = Shape::Circle { radius: 0.5 * record.shape.inner_radius() };
        let middle = record.central.apply(record.shape.mass_properties(1.0).center);
        Self { disk, sweep: body.child(Transform::new(middle, Rot::IDENTITY)) }
    }

    fn first_fraction(&self, other: &Shape, fixed: &Sweep, first: f32) -> f32 {
        if self.misses(other, fixed) {
            return first;
        }
        let toi = time_of_impact(&self.disk, &self.sweep, other, fixed, first);
        match toi.state {
            ToiState::Hit | ToiState::Limit => toi.fraction,
            // Deep inside already: out again is the only way on.
            ToiState::Touching if toi.normal.dot(self.sweep.translation()) > 0.0 => 0.0,
            ToiState::Separated | ToiState::Touching => first,
        }
    }

    /// Do the disk's way and that of the other's reach lie apart? What slides along something says so at once.
    fn misses(&self, other: &Shape, motion: &Sweep) -> bool {
        let way = |shape: &Shape, motion: &Sweep| {
            let at = |fraction| shape.aabb(motion.at(fraction));
            at(0.0).union(&at(1.0))
        };
        motion.angle == 0.0 && !way(&self.disk, &self.sweep).overlaps(&way(other, motion))
    }
}

/// Where the search for impacts looks.
#[derive(Clone, Copy)]
struct Scene<'a> {
    bodies: &'a Bodies,
    shapes: &'a Shapes,
    joints: &'a Joints,
    broad_phase: &'a BroadPhase,
    rules: Rules<'a>,
}

/// The search for the first impact of a body.
struct Impact<'a> {
    fast: &'a FastBody,
    /// For a bullet, all fast bodies by body, of which it is the one at `index`.
    bullets: &'a [FastBody],
    index: usize,
    scene: Scene<'a>,
}

impl Impact<'_> {
    /// The part of the step for which the body touches nothing new, 0 to 1.
    fn first_fraction(&self) -> f32 {
        let fast = self.fast;
        let info = &self.scene.bodies.infos[fast.body as usize];
        // All geometry is relative to where the centre of mass was: 32 bits are enough.
        let frame = Transform::new(Vec2::ZERO, fast.start.q);
        let sweep = Sweep::new(frame, Vec2::ZERO, fast.motion, fast.turn);
        let path = self.path_box(info.max_extent);
        let mut first = 1.0;
        for shape in self.scene.shapes.of_body(info.first_shape) {
            let record = &self.scene.shapes.records[shape as usize];
            if record.sensor {
                continue;
            }
            let moving = sweep.child(record.central);
            for kind in [ProxyKind::Static, ProxyKind::Kinematic, ProxyKind::Dynamic] {
                if kind == ProxyKind::Dynamic && !info.bullet {
                    continue;
                }
                self.scene.broad_phase.tree(kind).query(&path, record.filter.reach().1, |proxy| {
                    if let Some(other) =
                        self.scene.broad_phase.user(crate::broad_phase::ProxyId(proxy))
                    {
                        first = self.impact((shape, record), (&sweep, &moving), other, first);
                    }
                    ControlFlow::Continue(())
                });
            }
        }
        first
    }

    /// The box of everything that the body can have reached.
    fn path_box(&self, extent: f32) -> Aabb {
        let (start, end) = (self.fast.start.p, self.fast.start.p + self.fast.motion);
        let at = |p| Aabb::rounded_out(p - Vec2::splat(extent), p + Vec2::splat(extent));
        at(start).union(&at(end))
    }

    /// The first impact so far, taking one more shape into account. The motions are those of the body and of
    /// its shape.
    fn impact(
        &self,
        (shape, record): (u32, &ShapeRecord),
        (body, moving): (&Sweep, &Sweep),
        index: u32,
        first: f32,
    ) -> f32 {
        let other = &self.scene.shapes.records[index as usize];
        let forbids =
            |rule: &dyn PairRule| !rule.allows(self.scene.bodies, self.scene.shapes, shape, index);
        if !self.may_collide(record, other) || self.scene.rules.custom.is_some_and(forbids) {
            return first;
        }
        let pose = self.scene.bodies.poses[other.body as usize];
        let at = self.place(pose).compose(other.central);
        let center = self.fast.start.q.rotate(record.central.p);
        if surfaces::lets_pass(other, at, pose.q, center, self.fast.motion) {
            return first;
        }
        // One-way platforms stop only what comes from their solid side.
        let solid_along = |way: Vec2| {
            one_way::is_solid_side(other, -way, pose.q)
                && one_way::is_solid_side(record, way, self.fast.start.q)
        };
        let meet = |motion: &Sweep, first: f32| {
            let toi = time_of_impact(&record.shape, moving, &other.shape, motion, first);
            let there = motion.at(toi.fraction);
            match toi.state {
                ToiState::Hit | ToiState::Limit
                    if solid_along(toi.normal)
                        && !self.is_ghost(
                            record,
                            index,
                            moving.at(toi.fraction).relative_to(there),
                        ) =>
                {
                    toi.fraction
                }
                // What it touches it may be passing through from behind.
                ToiState::Hit | ToiState::Limit | ToiState::Touching
                    if solid_along(self.fast.motion.normalized()) =>
                {
                    Inner::new(record, body).first_fraction(&other.shape, motion, first)
                }
                ToiState::Hit | ToiState::Limit | ToiState::Separated | ToiState::Touching => first,
            }
        };
        match self.bullet(other.body) {
            // Its turn is still to come: it is met on its way.
            Some(index) if index > self.index => meet(&self.motion(index, other), first),
            // It has had its turn: if the two meet at all, it is met where it ended.
            Some(index) if meet(&self.motion(index, other), 1.0) == 1.0 => first,
            _ => meet(&Sweep::fixed(at), first),
        }
    }

    /// Does a shape at this place (in the other's frame) only hit a seam between static shapes?
    fn is_ghost(&self, record: &ShapeRecord, other: u32, place: Transform) -> bool {
        if self.scene.shapes.guards[other as usize] == 0 {
            return false;
        }
        let Scene { broad_phase, rules, .. } = self.scene;
        let length_unit = rules.length_unit;
        let (shapes, guards) = (&self.scene.shapes.records, &self.scene.shapes.guards);
        let ground =
            Ground { shapes, guards, poses: &self.scene.bodies.poses, broad_phase, length_unit };
        let hit = &shapes[other as usize];
        let gap = distance(&hit.shape, &record.shape, place);
        let point = hit.box_frame.unapply(gap.point_a);
        let normal = hit.box_frame.q.unrotate(gap.normal);
        Seams::new(ground, other, record).is_ghost([Some(point), None], normal)
    }

    /// A pose relative to where the body started.
    fn place(&self, pose: Pose) -> Transform {
        Transform::new(pose.p.relative_to(self.fast.start.p), pose.q)
    }

    /// Where in the list of fast bodies another one is, if it is a bullet among them.
    fn bullet(&self, body: u32) -> Option<usize> {
        let index = self.bullets.binary_search_by_key(&body, |fast| fast.body).ok()?;
        let both = [self.fast.body, body].map(|body| self.scene.bodies.infos[body as usize].bullet);
        (both == [true, true]).then_some(index)
    }

    /// The motion of a shape of a fast body, as far as it is allowed by now.
    fn motion(&self, index: usize, shape: &ShapeRecord) -> Sweep {
        let fast = &self.bullets[index];
        let (motion, turn) = (fast.motion * fast.fraction, fast.turn * fast.fraction);
        Sweep::new(self.place(fast.start), Vec2::ZERO, motion, turn).child(shape.central)
    }

    fn may_collide(&self, record: &ShapeRecord, other: &ShapeRecord) -> bool {
        other.body != record.body
            && !other.sensor
            && record.filter.collides(&other.filter)
            && self.scene.joints.may_collide(self.scene.bodies, record.body, other.body)
    }
}
