//! Sensors: which shapes overlap them, after everything has moved.
//!
//! A sensor sees the shapes of other bodies that are no sensors (others too, where it says so) and whose filters let them collide with
//! it, dynamic and kinematic, awake and asleep; static ones too unless it is itself on a static body:
//! neither of them moves. A fast body that went through a sensor within the step is seen in that step.
//!
//! A pair of which neither side is awake or was changed from outside overlaps if it did before; only the
//! others are measured. The result does not depend on that, and not on threads: a sensor's list is sorted.

use super::finalize::{FastBody, SAFE_FRACTION};
use crate::broad_phase::{BroadPhase, ProxyKind};
use crate::describe::BodyKind;
use crate::dynamics::{Bodies, NULL, Overlap, Sensors, ShapeRecord, Shapes};
use crate::geometry::{LINEAR_SLOP, Sweep, ToiState, distance, impact_within};
use crate::math::{Aabb, Pose, Vec2};
use crate::threads::Team;
use crate::work;
use core::ops::ControlFlow;

/// Shapes that come so near to each other on their ways overlap, in slops of contacts; round ones so deep.
const GRAZE: f32 = 0.1;

/// Sensors that one member of the team looks after at a time.
const CHUNK: usize = 8;
/// So many sensors are looked at one by one, where a fast body might have gone through one.
const FEW: usize = 16;

/// What sensors look at.
#[derive(Clone, Copy)]
pub(crate) struct Scene<'a> {
    pub(crate) bodies: &'a Bodies,
    pub(crate) shapes: &'a Shapes,
    pub(crate) broad_phase: &'a BroadPhase,
    pub(crate) sensors: &'a Sensors,
    pub(crate) length_unit: f32,
    /// Are fast bodies swept?
    pub(crate) continuous: bool,
}

/// Finds all overlaps after the step, ascending. `fast` are the bodies that were swept, ascending in each list; `found` and `turning`
/// are memory.
pub(crate) fn find_overlaps(
    team: &Team,
    scene: Scene<'_>,
    fast: [&[FastBody]; 2],
    (found, turning): (&mut Vec<Vec<Overlap>>, &mut Vec<FastBody>),
    overlaps: &mut Vec<Overlap>,
) {
    overlaps.clear();
    let sensors = &scene.sensors.shapes;
    let chunks = team.map_chunks(sensors.len(), CHUNK, found, |range, found| {
        found.clear();
        sensors[range].iter().for_each(|&sensor| scene.look(sensor, found));
    });
    chunks.iter().for_each(|found| overlaps.extend_from_slice(found));
    if !sensors.is_empty() {
        let mut boxes = [Aabb::EMPTY; FEW];
        let mut bounds = Aabb::EMPTY;
        for (fat, &sensor) in boxes.iter_mut().zip(sensors) {
            *fat = scene.broad_phase.fat_aabb(scene.shapes.proxy(sensor)).unwrap_or(Aabb::EMPTY);
            bounds = bounds.union(fat);
        }
        let far = |body: &&FastBody| sensors.len() <= FEW && scene.goes_past(body, &bounds);
        scene.list_turning(fast, turning);
        let fast = fast.into_iter().flatten().chain(&*turning);
        let near = fast.clone().filter(|body| !far(body));
        near.for_each(|body| scene.look_along(body, &boxes, overlaps));
        scene.look_across(fast, overlaps);
    }
    // Sweeps add to what is sorted already, if there are any.
    overlaps.sort_unstable();
    overlaps.dedup();
}

/// Calls `begin` and `end` for what is only in the new or only in the old list; both ascend.
pub(crate) fn compare(
    old: &[Overlap],
    new: &[Overlap],
    mut begin: impl FnMut(&Overlap),
    mut end: impl FnMut(&Overlap),
) {
    let (mut i, mut k) = (0, 0);
    while i < old.len() || k < new.len() {
        match (old.get(i), new.get(k)) {
            (Some(a), Some(b)) if a == b => (i, k) = (i + 1, k + 1),
            (Some(a), b) if b.is_none_or(|b| a < b) => {
                end(a);
                i += 1;
            }
            (_, Some(b)) => {
                begin(b);
                k += 1;
            }
            (_, None) => return,
        }
    }
}

impl Scene<'_> {
    /// Appends what a sensor overlaps, ascending.
    fn look(&self, sensor: u32, found: &mut Vec<Overlap>) {
        let record = &self.shapes.records[sensor as usize];
        let start = found.len();
        let Some(fat) = self.broad_phase.fat_aabb(self.shapes.proxy(sensor)) else { return };
        let place = self.place(record);
        let awake = self.is_restless(sensor, record);
        // The fat box holds the tight one; what is only in the fat box fails the tests of tight boxes and distance.
        let mut look_at = |visitor: u32| {
            let other = &self.shapes.records[visitor as usize];
            if self.may_see(record, other) {
                let overlap = self.overlap(sensor, visitor);
                let overlaps = if awake || self.is_restless(visitor, other) {
                    let gap = || self.place(other).relative_to(place);
                    self.shapes.are_near(sensor, visitor, 0.0)
                        && distance(&record.shape, &other.shape, gap()).separation <= 0.0
                } else {
                    self.sensors.saw(&overlap)
                };
                if overlaps {
                    found.push(overlap);
                }
            }
        };
        for kind in [ProxyKind::Static, ProxyKind::Kinematic, ProxyKind::Dynamic] {
            if kind != ProxyKind::Static || self.kind(record) != BodyKind::Static {
                self.broad_phase.each_of(kind, &fat, self.tree_mask(record), &mut look_at);
            }
        }
        found[start..].sort_unstable();
    }

    /// May its overlaps differ from those of the last step?
    fn is_restless(&self, shape: u32, record: &ShapeRecord) -> bool {
        self.bodies.infos[record.body as usize].awake || self.sensors.has_changed(shape)
    }

    fn place(&self, record: &ShapeRecord) -> Pose {
        self.bodies.poses[record.body as usize].compose(record.central)
    }

    fn overlap(&self, sensor: u32, visitor: u32) -> Overlap {
        let generation = |shape: u32| self.shapes.records[shape as usize].generation;
        Overlap {
            sensor,
            sensor_generation: generation(sensor),
            visitor,
            visitor_generation: generation(visitor),
        }
    }

    fn tree_mask(&self, record: &ShapeRecord) -> u64 {
        record.filter.reach().1
    }

    fn may_see(&self, sensor: &ShapeRecord, other: &ShapeRecord) -> bool {
        let is_static = |record| self.kind(record) == BodyKind::Static;
        sensor.sensor
            && (!other.sensor || sensor.sees_sensors)
            && other.body != sensor.body
            && sensor.filter.collides(&other.filter)
            && !(is_static(sensor) && is_static(other))
    }

    fn kind(&self, record: &ShapeRecord) -> BodyKind {
        self.bodies.infos[record.body as usize].kind
    }

    /// Lists the bodies that are not fast but for how far their turning took their sensors.
    fn list_turning(&self, fast: [&[FastBody]; 2], turning: &mut Vec<FastBody>) {
        turning.clear();
        let mut last = NULL;
        for &sensor in &self.sensors.shapes {
            let body = self.shapes.records[sensor as usize].body;
            let info = &self.bodies.infos[body as usize];
            let is_known = core::mem::replace(&mut last, body) == body;
            if is_known || !info.awake || !self.continuous {
                continue;
            }
            let step = FastBody::of_step(self.bodies, body);
            let (extent, least) = (self.extent(body), info.min_extent);
            let turned = (step.turn.abs() * extent).min(extent - least);
            let sweeps = step.motion.length() + turned > SAFE_FRACTION * least;
            let is_in = |list: &[FastBody]| list.binary_search_by_key(&body, |it| it.body).is_ok();
            if sweeps && !fast.into_iter().any(is_in) {
                turning.push(step);
            }
        }
    }

    /// How far the shapes of a body reach, sensors too.
    fn extent(&self, body: u32) -> f32 {
        let shapes = self.shapes.of_body(self.bodies.infos[body as usize].first_shape);
        shapes.fold(0.0, |most, shape| most.max(self.shapes.reach(shape)))
    }

    /// Is a fast body's way outside the box around all sensors, and none of them its own?
    fn goes_past(&self, fast: &FastBody, bounds: &Aabb) -> bool {
        let own = |&sensor: &u32| self.shapes.records[sensor as usize].body == fast.body;
        fast.misses(&self.bodies.infos[fast.body as usize], bounds)
            && !self.sensors.shapes.iter().any(own)
    }

    /// Appends the overlaps that a fast body had on its way: of its shapes with sensors, of its sensors with
    /// shapes. `boxes` are the fat ones of the first sensors.
    fn look_along(&self, fast: &FastBody, boxes: &[Aabb; FEW], overlaps: &mut Vec<Overlap>) {
        let info = &self.bodies.infos[fast.body as usize];
        let sweep = fast.seen_from(fast.start);
        let path = self.path(fast);
        for shape in self.shapes.of_body(info.first_shape) {
            let record = &self.shapes.records[shape as usize];
            let moving = sweep.child(record.central);
            let mut meet = |other: u32| self.meet(fast, (shape, &moving), other, overlaps);
            if !record.sensor && self.sensors.shapes.len() <= FEW {
                // These are looked at themselves, not all that is near.
                let sensors = self.sensors.shapes.iter().zip(boxes);
                let near = sensors.filter(|(_, fat)| fat.overlaps(&path));
                near.for_each(|(&sensor, _)| meet(sensor));
                continue;
            }
            self.broad_phase.query(&path, self.tree_mask(record), |other| {
                meet(other);
                ControlFlow::Continue(())
            });
        }
    }

    /// Appends the overlaps that sensors of fast bodies had with other fast bodies on their ways: the boxes of these hold where
    /// they go next by now.
    fn look_across<'a>(
        &self,
        fast: impl Iterator<Item = &'a FastBody> + Clone,
        overlaps: &mut Vec<Overlap>,
    ) {
        let shapes = |body: &FastBody| {
            self.shapes.of_body(self.bodies.infos[body.body as usize].first_shape)
        };
        let sees =
            |body: &FastBody| shapes(body).any(|shape| self.shapes.records[shape as usize].sensor);
        if !fast.clone().any(sees) {
            return;
        }
        let mut ways: Vec<_> = fast.map(|body| (self.path(body), body, sees(body))).collect();
        ways.sort_by(|a, b| a.0.min.x.total_cmp(&b.0.min.x));
        for (i, (path, a, sees_a)) in ways.iter().enumerate() {
            let near = ways[i + 1..].iter().take_while(|(other, ..)| other.min.x <= path.max.x);
            let near = near.filter(|(other, _, sees)| (*sees_a || *sees) && path.overlaps(other));
            let theirs: Vec<u32> = near.flat_map(|(_, b, _)| shapes(b)).collect();
            let sweep = a.seen_from(a.start);
            for shape in shapes(a) {
                let moving = sweep.child(self.shapes.records[shape as usize].central);
                theirs.iter().for_each(|&other| self.meet(a, (shape, &moving), other, overlaps));
            }
        }
    }

    /// Appends the overlaps that a swept shape and another had on the way, whichever is the sensor.
    fn meet(&self, fast: &FastBody, swept: (u32, &Sweep), other: u32, overlaps: &mut Vec<Overlap>) {
        work::note();
        for pair in [(swept.0, other), (other, swept.0)] {
            overlaps.extend(self.on_the_way(fast, swept, other, pair));
        }
    }

    /// A box around all that a fast body went through.
    fn path(&self, fast: &FastBody) -> Aabb {
        let extent = Vec2::splat(self.extent(fast.body));
        let at = |pose: Pose| Aabb::rounded_out(pose.p - extent, pose.p + extent);
        at(fast.start).union(&at(fast.end))
    }

    /// The overlap of a swept shape with another, if the first of the pair is a sensor that sees the second and they
    /// met on the way. What they had before the step and lost is none, nor is it one to be still near what was left before.
    fn on_the_way(
        &self,
        fast: &FastBody,
        (shape, moving): (u32, &Sweep),
        other: u32,
        (sensor, visitor): (u32, u32),
    ) -> Option<Overlap> {
        let record = |i: u32| &self.shapes.records[i as usize];
        if !self.may_see(record(sensor), record(visitor)) {
            return None;
        }
        let overlap = self.overlap(sensor, visitor);
        let (shape, other) = (record(shape), record(other));
        let step = FastBody::of_step(self.bodies, other.body);
        let motion = step.seen_from(fast.start).child(other.central);
        let slop = GRAZE * LINEAR_SLOP * self.length_unit;
        let toi = impact_within(&shape.shape, moving, &other.shape, &motion, (0.0, 1.0), slop)?;
        let closes = || toi.normal.dot(moving.translation() - motion.translation()) > 0.0;
        let gap = || motion.at(0.0).relative_to(moving.at(0.0));
        let overlapped = || distance(&shape.shape, &other.shape, gap()).separation <= 0.0;
        let began = || !self.sensors.saw(&overlap) && (closes() || overlapped());
        (toi.state != ToiState::Touching || began()).then_some(overlap)
    }
}
