//! Rests: how much less a contact point sinks than its load accounts for.
//!
//! A soft contact sinks by what it carries, so islands in which that would show are solved more finely
//! ([`paces`](super::paces)). Once they have settled, their points are given a rest: the sink that the load would have
//! at the plain pace, less the one that it has. From then on the spring pushes as at that depth, and the island goes
//! back to the plain pace as it stands. A rest is never more than the load accounts for, so it goes with the load.

use crate::dynamics::{Bodies, BodyInfo, Bucket, Graph, PointLanes, REFINEMENT, flags, pace_at};
use crate::simd::BLOCK;

/// Speed of bodies that have settled at most, length units a second. What sways goes on swaying at softer springs, twice
/// as fast for half the substeps, and at the plain pace hardly anything damps it: let go at 0.02, a pyramid of 40 rows
/// drifted by 2 mm.
const CALM_SPEED: f32 = 0.005;
/// Seconds that a body must have been slower than that: what sways is slow at its turning points.
const CALM_TIME: f32 = 0.1;

/// Sink at the plain pace under an impulse a plain substep by effective mass, seconds: between moving bodies, and on
/// one that nothing moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Compliance {
    pub(crate) moving: f32,
    pub(crate) fixed: f32,
}

/// What a point carries, as the sink at the plain pace, metres.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sink {
    /// That the load accounts for.
    pub(crate) full: f32,
    /// What it sinks less than that.
    rest: f32,
    /// Separation of the point.
    separation: f32,
}

impl Sink {
    /// Those of a contact's points, solved at a pace.
    pub(crate) fn of(
        bucket: &Bucket,
        slot: usize,
        pace: usize,
        compliance: Compliance,
        bodies: &Bodies,
    ) -> [Self; 2] {
        let (block, lane) = (slot / BLOCK, slot % BLOCK);
        let (a, b) = bucket.bodies(slot);
        let moving = bodies.is_solved(a) && bodies.is_solved(b);
        let compliance = if moving { compliance.moving } else { compliance.fixed };
        let surface = &bucket.surfaces[block];
        let sink = |point: &PointLanes, rest: f32| {
            let (mass, separation) = (point.normal_mass[lane], point.separation[lane]);
            if mass <= 0.0 {
                // Not there, or not known yet: other lanes' leavings, which depend on how many a kernel takes at a time.
                return Self::default();
            }
            let load = point.normal_impulse[lane] / mass;
            Self { full: compliance * load * REFINEMENT[pace] as f32, rest, separation }
        };
        let points = &bucket.constraints[block].points;
        [sink(&points[0], surface.rest_1[lane]), sink(&points[1], surface.rest_2[lane])]
    }

    /// What its rest at a pace does not stand for.
    pub(crate) fn open(self, pace: usize) -> f32 {
        let refinement = REFINEMENT[pace] as f32;
        self.full - self.rest * (refinement * refinement)
    }

    /// The rest with which the point stays where it is at a pace.
    pub(crate) fn rest_at(self, pace: usize) -> f32 {
        let refinement = REFINEMENT[pace] as f32;
        (self.full / (refinement * refinement) + self.separation).max(0.0)
    }
}

/// Lets contacts of bodies that have settled stay where they are under another compliance.
pub(crate) fn stay(graph: &mut Graph, bodies: &Bodies, compliance: Compliance) {
    for (place, bucket) in graph.touching_buckets_mut() {
        for slot in 0..bucket.contacts.len() {
            let (a, b) = bucket.bodies(slot);
            if is_calm(bodies, a) && is_calm(bodies, b) {
                let pace = pace_at(place);
                let sinks = Sink::of(bucket, slot, pace, compliance, bodies);
                let (block, lane) = (slot / BLOCK, slot % BLOCK);
                let surface = &mut bucket.surfaces[block];
                let rests = [&mut surface.rest_1[lane], &mut surface.rest_2[lane]];
                // What has just woken is not known yet, and keeps its rest.
                for (rest, sink) in rests.into_iter().zip(sinks).filter(|(_, sink)| sink.full > 0.0)
                {
                    *rest = sink.rest_at(pace);
                }
                bucket.heads[block].flags |= flags::RESTS;
            }
        }
    }
}

/// Has a body settled, if anything can move it?
pub(crate) fn is_calm(bodies: &Bodies, body: u32) -> bool {
    !bodies.is_dynamic(body) || bodies.infos[body as usize].calm == u8::MAX
}

/// What a step of this length adds to how nearly a body has settled.
pub(crate) fn calm_of(dt: f32) -> u8 {
    (dt * (255.0 / CALM_TIME)).ceil() as u8
}

/// How nearly a body has settled after a step, from before, its speed in it, length units a second, and what the step adds.
pub(crate) fn calmer(calm: u8, speed: f32, share: u8) -> u8 {
    if speed < CALM_SPEED { calm.saturating_add(share) } else { 0 }
}

/// Radius at which turning counts as speed: that of its shapes, else of gyration; any for what the user moves.
#[inline]
pub(super) fn turning_extent(info: &BodyInfo, length_unit: f32) -> f32 {
    match info.max_extent {
        0.0 if info.mass > 0.0 => (info.inertia / info.mass).sqrt(),
        0.0 => length_unit,
        extent => extent,
    }
}
