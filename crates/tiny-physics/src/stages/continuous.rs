//! Continuous collision: fast bodies stop where they would have gone through something.
//!
//! A body that moved further than a part of its own thickness is swept from where it started the step
//! to where the solver put it. It is set back to the first impact with a static or kinematic shape; a
//! bullet also to that with a dynamic one. Its velocity stays: the contact solver deals with it in the
//! next step, when there is a contact. The time that is lost is at most a step.

use super::boxes::{self, Moved};
use super::finalize::FastBody;
use super::one_way;
use super::pairs::PairRule;
use super::surfaces::{self, Ground, Seams};
use crate::broad_phase::{BroadPhase, ProxyKind};
use crate::dynamics::{Bodies, Joints, ShapeRecord, Shapes};
use crate::geometry::manifold::ShapeClass;
use crate::geometry::{LINEAR_SLOP, Shape, Sweep, ToiState, distance, time_of_impact};
use crate::math::{Aabb, Pose, Rot, Transform, Vec2};
use crate::simd::Row;
use crate::threads::{SharedSlice, Team};
use core::ops::ControlFlow;

/// What decides about pairs besides filters.
#[derive(Clone, Copy)]
pub(crate) struct Rules<'a> {
    /// Joined bodies do not collide.
    pub(crate) joints: &'a Joints,
    /// The user's word on a pair of shapes, if there is any.
    pub(crate) custom: Option<&'a dyn PairRule>,
    /// See [`Settings::length_unit`](crate::Settings).
    pub(crate) length_unit: f32,
}

/// Fast bodies that one member of the team sweeps at a time.
const CHUNK: usize = 16;
/// Impacts are looked for up to a slop off the surface, give or take what rounding does, metres.
const SLACK: f32 = 2.0 * LINEAR_SLOP;

/// Sweeps the fast bodies, bullets last and one by one: they see where all others have ended. `moved` is
/// memory.
pub(crate) fn run(
    team: &Team,
    fast: &mut [FastBody],
    bodies: &mut Bodies,
    shapes: &mut Shapes,
    broad_phase: &mut BroadPhase,
    rules: Rules<'_>,
    moved: &mut Vec<Moved>,
) {
    let scene = Scene { bodies, shapes, broad_phase, rules };
    team.for_each_chunk_mut(fast, CHUNK, |_, fast| {
        for fast in fast.iter_mut().filter(|fast| !scene.is_bullet(fast)) {
            fast.fraction = Impact { fast, bullets: &[], index: 0, scene }.first_fraction();
        }
    });
    place_all_but_bullets(team, fast, bodies, shapes, broad_phase, moved);
    for index in 0..fast.len() {
        let scene = Scene { bodies, shapes, broad_phase, rules };
        if scene.is_bullet(&fast[index]) {
            let impact = Impact { fast: &fast[index], bullets: fast, index, scene };
            fast[index].fraction = impact.first_fraction();
            let FastBody { body, motion, fraction, .. } = fast[index];
            bodies.poses[body as usize] = end(&fast[index], bodies.poses[body as usize]);
            if moved.is_empty() {
                moved.push(Moved::new());
            }
            boxes::update(bodies, shapes, broad_phase, body, motion * fraction, &mut moved[0]);
        }
    }
}

/// Sets bodies back to their first impacts, where they have one, and updates their boxes.
fn place_all_but_bullets(
    team: &Team,
    fast: &[FastBody],
    bodies: &mut Bodies,
    shapes: &mut Shapes,
    broad_phase: &mut BroadPhase,
    moved: &mut Vec<Moved>,
) {
    let (infos, poses) = (&bodies.infos, SharedSlice::new(&mut bodies.poses));
    let chunks = boxes::share(shapes, broad_phase, |boxes| {
        team.map_chunks(fast.len(), CHUNK, moved, |range, moved| {
            moved.clear();
            for fast in &fast[range] {
                let info = &infos[fast.body as usize];
                if !info.bullet {
                    let pose = end(fast, poses.read(fast.body));
                    poses.write(fast.body, pose);
                    boxes.follow(info.first_shape, pose, fast.motion * fast.fraction, moved);
                }
            }
        })
    });
    chunks.iter().for_each(|moved| boxes::take_over(shapes, broad_phase, moved));
}

/// Where a fast body ends: at its first impact, or at the pose that it has.
fn end(fast: &FastBody, pose: Pose) -> Pose {
    if fast.fraction < 1.0 {
        let position = fast.start.p + fast.motion * fast.fraction;
        Pose::new(position, fast.start.q.integrate(fast.turn * fast.fraction))
    } else {
        pose
    }
}

/// A disk about the middle of a shape, half as thick as it. What a shape touches already at the start of
/// the step is the contact solver's affair, which holds a corner and lets the rest turn about it; but
/// the middle must not pass.
struct Inner {
    disk: Shape,
    sweep: Sweep,
    /// How far the disk reaches from the centre of mass, metres.
    reach: f32,
}

impl Inner {
    fn new(record: &ShapeRecord, body: &Sweep) -> Self {
        let radius = 0.5 * record.shape.inner_radius();
        let middle = record.central.apply(match record.class {
            ShapeClass::General => record.shape.mass_properties(1.0).center,
            _ => record.box_frame.p,
        });
        let sweep = body.child(Transform::new(middle, Rot::IDENTITY));
        Self { disk: Shape::Circle { radius }, sweep, reach: middle.length() + radius }
    }

    fn first_fraction(&self, other: &Shape, fixed: &Sweep, first: f32) -> f32 {
        let toi = time_of_impact(&self.disk, &self.sweep, other, fixed, first);
        match toi.state {
            ToiState::Hit | ToiState::Limit => toi.fraction,
            // Deep inside already: out again is the only way on.
            ToiState::Touching if toi.normal.dot(self.sweep.translation()) > 0.0 => 0.0,
            ToiState::Separated | ToiState::Touching => first,
        }
    }
}

/// Where the search for impacts looks.
#[derive(Clone, Copy)]
struct Scene<'a> {
    bodies: &'a Bodies,
    shapes: &'a Shapes,
    broad_phase: &'a BroadPhase,
    rules: Rules<'a>,
}

impl Scene<'_> {
    fn is_bullet(&self, fast: &FastBody) -> bool {
        self.bodies.infos[fast.body as usize].bullet
    }
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
        let (start, motion, extent) = (self.fast.start.p, self.fast.motion, Vec2::splat(extent));
        let least = start + motion.min(Vec2::ZERO) - extent;
        Aabb::rounded_out(least, start + motion.max(Vec2::ZERO) + extent)
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
        let extent = self.scene.bodies.infos[self.fast.body as usize].max_extent;
        let meet = |motion: &Sweep, first: f32| {
            let clear = |reach| {
                let frame = motion.at(0.0).compose(other.box_frame);
                let way = self.fast.motion - motion.translation();
                motion.angle == 0.0
                    && stays_clear(reach, way, &self.scene.shapes.rows[index as usize], frame)
            };
            if clear(extent + SLACK) {
                return first;
            }
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
                    let inner = Inner::new(record, body);
                    let passes = clear(inner.reach);
                    if passes { first } else { inner.first_fraction(&other.shape, motion, first) }
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
            && self.scene.rules.joints.may_collide(self.scene.bodies, record.body, other.body)
    }
}

/// Does all that is within `reach` metres of the origin stay clear of a rounded box in this frame, when the origin
/// goes by `motion`? Of the box's row only its sizes count. What slides along something or passes it by needs no
/// search then.
fn stays_clear(reach: f32, motion: Vec2, row: &Row, frame: Transform) -> bool {
    let (from, to) = (frame.unapply(Vec2::ZERO), frame.unapply(motion));
    let (half, reach) = (Vec2::new(row[4], row[5]), reach + row[6]);
    let rounding = 1.0e-6 * (reach + half.x + half.y + motion.x.abs() + motion.y.abs());
    let limit = half + Vec2::splat(reach + rounding);
    !Aabb::new(from.min(to), from.max(to)).overlaps(&Aabb::new(-limit, limit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::manifold::RoundedBox;
    use crate::geometry::testing::{any_frame, any_shape, any_vec};
    use proptest::prelude::*;

    /// A shape's row, of which its sizes are filled in, and the frame of its box.
    fn row_of(shape: &Shape) -> (Row, Transform) {
        let (extents, frame) = RoundedBox::of(shape).map_or_else(
            || {
                let core = shape.core();
                ([0.0, 0.0, core.reach(Vec2::ZERO) + core.radius], Transform::IDENTITY)
            },
            |rounded| (rounded.extents(), rounded.frame),
        );
        let [x, y, radius] = extents;
        ([0.0, 0.0, 0.0, 0.0, x, y, radius, 0.0], frame)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]
        #[test]
        fn no_impact_is_left_out(
            shape in any_shape(),
            other in any_shape(),
            place in any_frame(6.0),
            motion in any_vec(8.0),
            turn in -4.0_f32..4.0,
        ) {
            let core = shape.core();
            let reach = core.reach(Vec2::ZERO) + core.radius;
            let (row, frame) = row_of(&other);
            let clear = stays_clear(reach + SLACK, motion, &row, place.compose(frame));
            let sweep = Sweep::new(Transform::IDENTITY, Vec2::ZERO, motion, turn);
            let toi = time_of_impact(&shape, &sweep, &other, &Sweep::fixed(place), 1.0);
            prop_assert!(!clear || toi.state == ToiState::Separated, "{toi:?}");
        }

        /// What is clear by more than a little is told to be: around circles at any rate.
        #[test]
        fn what_passes_by_is_told(place in any_frame(6.0), motion in any_vec(8.0), radius in 0.1_f32..1.0) {
            let (circle, _) = row_of(&Shape::Circle { radius });
            // Off the line of motion on either side, and behind.
            let side = motion.perp().normalized();
            for offset in [side, -side, -motion.normalized()] {
                let at = Transform::new(offset * (2.0 * radius + 1.0), place.q);
                let frame = Transform::new(at.p, Rot { c: motion.normalized().x, s: motion.normalized().y });
                let clear = stays_clear(radius, motion, &circle, frame);
                prop_assert!(clear || motion.length() < 1.0e-3);
                prop_assert!(!stays_clear(radius, motion, &circle, Transform::new(motion * 0.5, place.q)));
            }
        }
    }
}
