//! Machines that would go past a character within a step.

use super::{CharacterMover, Frame};
use crate::geometry::{LINEAR_SLOP, Sweep, ToiState, impact_within};
use crate::{Body, Pose, Rot, Transform, Vec2, World};

/// So deep in it are they when they take it along: one-way platforms are still solid for it then. Metres; multiplied by
/// the length unit.
const DEPTH: f32 = 0.1 * LINEAR_SLOP;

impl CharacterMover {
    /// Goes along with the kinematic bodies that have met it in the last step, from when they did, as far as they go its way.
    /// What it stands on it has gone along with already.
    pub(super) fn give_way(&mut self, world: &World, frame: Frame) {
        let known = [self.body, self.ground.map(|ground| ground.body)];
        for body in world.machines().filter(|body| !known.contains(&Some(body.id()))) {
            if let Some(way) = self.swept_by(world, frame, body) {
                self.slide(world, frame, way, Some(body.id()));
            }
        }
    }

    /// How far a machine takes it from where it met it.
    fn swept_by(&self, world: &World, frame: Frame, body: Body<'_>) -> Option<Vec2> {
        let here = Pose::new(self.position, Rot::IDENTITY);
        let capsule = self.capsule(frame.up, 0.0);
        if !body.went_through(&capsule.world_aabb(here).grown(self.skin)) {
            return None;
        }
        let (start, end) = (body.interpolated_pose(0.0), body.pose());
        let center = body.local_center();
        let [from, to] = [start, end].map(|pose| pose.relative_to(here));
        let (motion, turn) = (to.apply(center) - from.apply(center), end.q.angle_from(start.q));
        // What does not turn and goes no further is in it still, and is got out of, if it is solid from everywhere.
        let slow = turn == 0.0 && motion.length() < self.radius;
        let sweep = Sweep::new(from, center, motion, turn);
        let rest = Sweep::fixed(Transform::IDENTITY);
        let shapes = body.shapes().filter_map(|shape| world.shape(shape));
        let solid = shapes.filter(|shape| {
            let meets = !shape.is_sensor() && self.filter.collides(&shape.filter());
            let place = || start.compose(shape.pose().relative_to(end));
            let one_way = shape.one_way().is_some() || shape.link().is_some();
            meets && (one_way || !slow) && self.is_solid(frame, shape, place(), -motion)
        });
        let slop = DEPTH * world.settings.length_unit;
        let meetings = solid.filter_map(|shape| {
            let moving = sweep.child(shape.pose().relative_to(end));
            impact_within(&capsule, &rest, shape.shape(), &moving, (0.0, 1.0), slop)
                .filter(|toi| matches!(toi.state, ToiState::Hit | ToiState::Touching))
        });
        let first = meetings.min_by(|a, b| a.fraction.total_cmp(&b.fraction))?;
        let local = sweep.at(first.fraction).unapply(first.point);
        let carry = first.normal.dot(sweep.at(1.0).apply(local) - first.point);
        (carry < 0.0).then(|| first.normal * carry)
    }
}
