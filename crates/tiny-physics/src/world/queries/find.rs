//! The searches behind the queries: the broad phase offers shapes, the filter and the geometry decide.

use super::{ClosestPoint, QueryFilter, RayCastHit, ShapeCastHit, ShapeDistance};
use crate::broad_phase::{BoxCast, LIMIT, Nearest, clamped};
use crate::dynamics::ShapeRecord;
use crate::geometry::{Ray, RayHit, Shape, Sweep, distance, shape_cast, touch_within};
use crate::math::{Aabb, DVec2, Pose, Transform, Vec2};
use crate::work;
use crate::world::World;
use core::ops::ControlFlow;

/// Shapes this close to each other touch in a shape cast, metres.
const TOUCH: f32 = 2.0e-4;

/// A query under way.
pub(super) struct Finder<'a> {
    pub(super) world: &'a World,
    pub(super) filter: &'a QueryFilter<'a>,
}

/// A shape that is moved and turned about the origin of its frame.
#[derive(Clone, Copy)]
pub(super) struct Way<'a> {
    pub(super) shape: &'a Shape,
    pub(super) pose: Pose,
    pub(super) translation: Vec2,
    /// Radians.
    pub(super) turn: f32,
}

/// The best of several hits: the smallest key, then the smallest index.
struct Best<T> {
    key: f32,
    shape: u32,
    hit: Option<T>,
}

impl<T> Best<T> {
    fn new() -> Self {
        Self { key: f32::INFINITY, shape: u32::MAX, hit: None }
    }

    fn offer(&mut self, key: f32, shape: u32, hit: T) {
        if key < self.key || (key == self.key && shape < self.shape) {
            *self = Self { key, shape, hit: Some(hit) };
        }
    }
}

impl Finder<'_> {
    /// Does the filter let the query see a shape?
    pub(super) fn sees(&self, index: u32) -> bool {
        let Self { world, filter } = self;
        let record = &world.state.shapes.records[index as usize];
        (filter.sensors || !record.sensor)
            && filter.filter.collides(&record.filter)
            && filter.exclude_body.is_none_or(|body| body != world.body_id(record.body))
            && filter.predicate.is_none_or(|predicate| predicate(world.shape_id(index)))
    }

    /// A shape and its frame in the world.
    fn place(&self, index: u32) -> (&ShapeRecord, Pose) {
        let record = &self.world.state.shapes.records[index as usize];
        (record, self.world.state.bodies.poses[record.body as usize].compose(record.central))
    }

    /// Where a ray enters a shape, normal in the world.
    fn ray_hit(&self, index: u32, origin: DVec2, translation: Vec2) -> Option<RayHit> {
        let (record, pose) = self.place(index);
        let ray = Ray::new(pose.unapply(origin), pose.q.unrotate(translation));
        if self.filter.solid && record.shape.contains(ray.origin) {
            let normal = (-translation).direction_and_length().0;
            return Some(RayHit { fraction: 0.0, normal });
        }
        let hit = record.shape.ray_cast(&ray)?;
        Some(RayHit { normal: pose.q.rotate(hit.normal), ..hit })
    }

    fn report_ray(&self, index: u32, hit: RayHit, origin: DVec2, translation: Vec2) -> RayCastHit {
        RayCastHit {
            shape: self.world.shape_id(index),
            body: self.world.body_id(self.world.state.shapes.records[index as usize].body),
            point: origin + translation * hit.fraction,
            normal: hit.normal,
            fraction: hit.fraction,
        }
    }

    /// Offers every seen shape near a ray together with its hit, until the visitor returns 0.
    fn walk_ray(
        &self,
        origin: DVec2,
        translation: Vec2,
        mut visit: impl FnMut(u32, RayHit, f32) -> f32,
    ) {
        if !origin.is_finite() || !translation.is_finite() {
            return;
        }
        let cast = box_cast(origin, translation, Vec2::ZERO);
        self.world.state.broad_phase.cast(&cast, 1.0, self.filter.tree_mask(), |index, limit| {
            let hit =
                if self.sees(index) { self.ray_hit(index, origin, translation) } else { None };
            hit.map_or(limit, |hit| visit(index, hit, limit))
        });
    }

    pub(super) fn first_on_ray(&self, origin: DVec2, translation: Vec2) -> Option<RayCastHit> {
        let mut best = Best::new();
        self.walk_ray(origin, translation, |index, hit, limit| {
            best.offer(hit.fraction, index, hit);
            narrower(limit, hit.fraction)
        });
        let shape = best.shape;
        best.hit.map(|hit| self.report_ray(shape, hit, origin, translation))
    }

    pub(super) fn visit_ray(
        &self,
        origin: DVec2,
        translation: Vec2,
        mut visit: impl FnMut(RayCastHit) -> ControlFlow<()>,
    ) {
        self.walk_ray(origin, translation, |index, hit, limit| {
            let flow = visit(self.report_ray(index, hit, origin, translation));
            if flow.is_break() { 0.0 } else { limit }
        });
    }

    pub(super) fn any_on_ray(&self, origin: DVec2, translation: Vec2) -> bool {
        let mut found = false;
        self.walk_ray(origin, translation, |_, _, _| {
            found = true;
            0.0
        });
        found
    }

    pub(super) fn all_on_ray(&self, origin: DVec2, translation: Vec2) -> Vec<RayCastHit> {
        let mut hits = Vec::new();
        self.walk_ray(origin, translation, |index, hit, limit| {
            hits.push(self.report_ray(index, hit, origin, translation));
            limit
        });
        hits.sort_unstable_by(|a, b| a.fraction.total_cmp(&b.fraction).then(a.shape.cmp(&b.shape)));
        hits
    }

    pub(super) fn first_on_way(&self, way: Way<'_>) -> Option<ShapeCastHit> {
        let mut best = Best::new();
        self.walk_way(way, |index, hit, limit| {
            best.offer(hit.fraction, index, hit);
            narrower(limit, hit.fraction)
        });
        best.hit
    }

    pub(super) fn all_on_way(&self, way: Way<'_>) -> Vec<ShapeCastHit> {
        let mut hits = Vec::new();
        self.walk_way(way, |_, hit, limit| {
            hits.push(hit);
            limit
        });
        hits.sort_unstable_by(|a, b| a.fraction.total_cmp(&b.fraction).then(a.shape.cmp(&b.shape)));
        hits
    }

    /// Offers every seen shape that a moved shape touches, with the hit; the visitor gives how far to look on.
    fn walk_way(&self, way: Way<'_>, mut visit: impl FnMut(u32, ShapeCastHit, f32) -> f32) {
        let Way { shape, pose, translation, turn } = way;
        let finite = pose.is_finite() && translation.is_finite() && turn.is_finite();
        if !finite || shape.validate().is_err() {
            return;
        }
        let bounds = if turn == 0.0 {
            shape.world_aabb(pose)
        } else {
            let core = shape.core();
            let reach = Vec2::splat(core.reach(Vec2::ZERO) + core.radius);
            Aabb::from_center(pose.p.to_vec2(), reach)
        };
        let reach = bounds.half_extents() + Vec2::splat(TOUCH);
        let cast = box_cast(bounds.center().into(), translation, reach);
        self.world.state.broad_phase.cast(&cast, 1.0, self.filter.tree_mask(), |index, limit| {
            let hit = if self.sees(index) { self.way_hit(index, way) } else { None };
            hit.map_or(limit, |hit| visit(index, hit, limit))
        });
    }

    fn way_hit(&self, index: u32, way: Way<'_>) -> Option<ShapeCastHit> {
        let Way { shape, pose, translation, turn } = way;
        let (record, place) = self.place(index);
        let (point, normal, fraction) = if turn == 0.0 {
            let start = pose.relative_to(place);
            let hit = shape_cast(&record.shape, shape, start, place.q.unrotate(translation))?;
            (place.apply(hit.point), place.q.rotate(hit.normal), hit.fraction)
        } else {
            // Both seen from where the moved shape begins.
            let seen = Transform::new(place.p.relative_to(pose.p), place.q);
            let still = Sweep::fixed(seen);
            let frame = Transform::new(Vec2::ZERO, pose.q);
            let moved = Sweep::new(frame, Vec2::ZERO, translation, turn);
            let toi = touch_within(&record.shape, &still, shape, &moved, 0.5 * TOUCH)?;
            let there = moved.at(toi.fraction).relative_to(seen);
            let point = distance(&record.shape, shape, there).point_a;
            (place.apply(point), toi.normal, toi.fraction)
        };
        let (shape, body) = (self.world.shape_id(index), self.world.body_id(record.body));
        Some(ShapeCastHit { shape, body, point, normal, fraction })
    }

    /// The seen shapes that pass a test and whose fat boxes overlap a box, in index order.
    fn collect(&self, bounds: &Aabb, passes: impl Fn(&ShapeRecord, Pose) -> bool) -> Vec<u32> {
        let mut found = Vec::new();
        self.walk_box(bounds, passes, |index| {
            found.push(index);
            ControlFlow::Continue(())
        });
        found.sort_unstable();
        found
    }

    /// The same, one by one, in no order.
    fn walk_box(
        &self,
        bounds: &Aabb,
        passes: impl Fn(&ShapeRecord, Pose) -> bool,
        mut visit: impl FnMut(u32) -> ControlFlow<()>,
    ) {
        self.world.state.broad_phase.query(bounds, self.filter.tree_mask(), |index| {
            let (record, place) = self.place(index);
            if !self.sees(index) {
                return ControlFlow::Continue(());
            }
            work::note();
            if passes(record, place) { visit(index) } else { ControlFlow::Continue(()) }
        });
    }

    pub(super) fn visit_overlapping(
        &self,
        shape: &Shape,
        pose: Pose,
        visit: impl FnMut(u32) -> ControlFlow<()>,
    ) {
        if pose.is_finite() && shape.validate().is_ok() {
            let overlaps = |record: &ShapeRecord, place: Pose| {
                distance(&record.shape, shape, pose.relative_to(place)).separation <= 0.0
            };
            self.walk_box(&shape.world_aabb(pose), overlaps, visit);
        }
    }

    fn ids(&self, found: Vec<u32>) -> Vec<super::ShapeId> {
        found.into_iter().map(|index| self.world.shape_id(index)).collect()
    }

    pub(super) fn overlapping(&self, shape: &Shape, pose: Pose) -> Vec<super::ShapeId> {
        let mut found = Vec::new();
        self.visit_overlapping(shape, pose, |index| {
            found.push(index);
            ControlFlow::Continue(())
        });
        found.sort_unstable();
        self.ids(found)
    }

    pub(super) fn near(&self, aabb: Aabb) -> Vec<super::ShapeId> {
        self.ids(self.collect(&aabb, |_, _| true))
    }

    pub(super) fn overlapping_box(&self, aabb: Aabb) -> Vec<super::ShapeId> {
        if !aabb.is_valid() {
            return Vec::new();
        }
        let aabb = clamped(aabb);
        let center = (DVec2::from(aabb.min) + DVec2::from(aabb.max)) * 0.5;
        let half_extents = aabb.half_extents();
        // Not validated: a box without width or height is a fine question.
        let (shape, pose) = (Shape::Aabb { half_extents }, Pose::new(center, Default::default()));
        let found = self.collect(&aabb, |record, place| {
            distance(&record.shape, &shape, pose.relative_to(place)).separation <= 0.0
        });
        self.ids(found)
    }

    pub(super) fn holding(&self, point: DVec2) -> Vec<super::ShapeId> {
        if !point.is_finite() {
            return Vec::new();
        }
        let found = self.collect(&Aabb::rounded_out(point, point), |record, place| {
            record.shape.contains(place.unapply(point))
        });
        self.ids(found)
    }

    pub(super) fn between(&self, a: u32, b: u32) -> ShapeDistance {
        let ((a, place_a), (b, place_b)) = (self.place(a), self.place(b));
        let gap = distance(&a.shape, &b.shape, place_b.relative_to(place_a));
        ShapeDistance {
            separation: gap.separation,
            normal: place_a.q.rotate(gap.normal),
            point_a: place_a.apply(gap.point_a),
            point_b: place_a.apply(gap.point_b),
        }
    }

    pub(super) fn closest(&self, point: DVec2, max_distance: f32) -> Option<ClosestPoint> {
        if !point.is_finite() || max_distance.is_nan() || max_distance < 0.0 {
            return None;
        }
        let most = if max_distance < LIMIT { max_distance } else { LIMIT };
        let (limit, mask) = (narrower(LIMIT, most), self.filter.tree_mask());
        let mut best = Best::new();
        self.world.state.broad_phase.cast(&Nearest(point), limit, mask, |index, limit| {
            if !self.sees(index) {
                return limit;
            }
            work::note();
            let (record, place) = self.place(index);
            let local = place.unapply(point);
            let closest = record.shape.closest_point(local);
            let distance = closest.distance(local);
            let hit = ClosestPoint {
                shape: self.world.shape_id(index),
                body: self.world.body_id(record.body),
                point: if distance == 0.0 { point } else { place.apply(closest) },
                distance,
            };
            best.offer(distance, index, hit);
            narrower(limit, distance)
        });
        best.hit.filter(|hit| hit.distance <= most)
    }
}

/// The cast of a box for the broad phase, a little larger than asked: the origin is rounded to 32 bits
/// there, and so is every place on the way.
fn box_cast(origin: DVec2, translation: Vec2, half_extents: Vec2) -> BoxCast {
    let center = origin.to_vec2();
    let slack = 2.0 * f32::EPSILON;
    let grown = |extent: f32, at: f32, way: f32| {
        extent + slack * (at.abs() + way.abs() + extent) + f32::MIN_POSITIVE
    };
    let half_extents = Vec2::new(
        grown(half_extents.x, center.x, translation.x),
        grown(half_extents.y, center.y, translation.y),
    );
    BoxCast { origin: center, translation, half_extents }
}

/// The limit of a cast after a hit. A hit at the start must not end the search: another shape may be hit
/// there too, with a smaller index.
fn narrower(limit: f32, fraction: f32) -> f32 {
    let fraction = if fraction > f32::MIN_POSITIVE { fraction } else { f32::MIN_POSITIVE };
    if fraction < limit { fraction } else { limit }
}
