//! What a character does to bodies: pushes before it, weight under it.

use super::{CharacterMover, Frame, MoverGround, Obstacle, along};
use crate::codec::described;
use crate::{BodyId, BodyKind, DVec2, World};

/// A push that is not bounded is at most this strong, newtons.
const MAX_PUSH: f32 = 1.0e12;
/// What gains so much of what gravity gives is held by nothing.
const FALLS: f32 = 0.9;
/// It weighs at most so many times as much as what is under it.
const MOST_LOAD: f32 = 10.0;

described! {
    /// What a character pushed in an update, and what came of it.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub(super) struct Push {
        body: BodyId,
        /// Speed of its centre that was expected after the next step, metres a second.
        expected: f32,
        /// Force that holds it back: friction, or what it pushes in turn; newtons.
        resistance: f32,
    }
}

impl CharacterMover {
    /// Pushes what it would walk into in the next update, so that its way is free then: the body moves
    /// during the step in between, as far as the character is going to come.
    pub(super) fn push_ahead(&mut self, world: &mut World, frame: Frame, speed: f32) {
        let Some(ground) = self.ground else { return };
        let Frame { up, right, dt, .. } = frame;
        let motion = along(self.floor(ground.normal, up), right, speed * dt);
        let Some(hit) = self.cast(world, frame, motion, None) else { return };
        let dynamic = world.body(hit.body).is_some_and(|body| body.kind() == BodyKind::Dynamic);
        if !dynamic || self.is_walkable(hit.normal, up) {
            return;
        }
        let left = 1.0 - hit.fraction;
        let start = self.position;
        self.position += motion * hit.fraction;
        let climbs = self.step_up(world, frame, speed * dt * left);
        self.position = start;
        if !climbs {
            self.push(world, frame, &hit, motion.dot(-hit.normal) * left / dt, left);
        }
    }

    /// Pushes a dynamic body so that it has a speed (away from the character) in the next step, with bounded
    /// force, for a part of the step.
    ///
    /// What held it back in the last step is a steady force. What its speed lacks would take the character's
    /// whole force for a time: the faster that goes, the more of it is an impulse at once, so that the body
    /// comes as far as under that force.
    pub(super) fn push(
        &mut self,
        world: &mut World,
        frame: Frame,
        hit: &Obstacle,
        speed: f32,
        part: f32,
    ) {
        let Frame { dt, pushed, .. } = frame;
        let id = hit.body;
        let stands_on = self.ground.map(|ground| (ground.body, ground.hold));
        if stands_on.is_some_and(|(ground, _)| ground == id) {
            // What it pushes away with its hands it holds with its feet.
            return;
        }
        let Some(mut body) = world.body_mut(id) else { return };
        let (view, way) = (body.as_ref(), -hit.normal);
        let point = self.hand(frame, hit, view.center());
        let (mass, now) = (view.mass(), view.velocity().dot(way));
        if view.kind() != BodyKind::Dynamic || speed <= 0.0 || mass <= 0.0 {
            return;
        }
        let lacking = mass * (speed - view.velocity_at(point).dot(way));
        let held_back = |push: Push| push.resistance + mass * (push.expected - now) / dt;
        let (force, held) = (self.push_force.min(MAX_PUSH), pushed.filter(|push| push.body == id));
        let resistance = held.map_or(0.0, held_back).max(0.0).min(force);
        let (wanted, most) = (lacking + resistance * dt, force * part * dt);
        let total = wanted.min(most);
        if total <= 0.0 {
            return;
        }
        let quick = lacking > 0.0 && wanted < most;
        let impulse =
            if quick { lacking * ((most - wanted) / (most - resistance * dt)) } else { 0.0 };
        body.apply_impulse(way * impulse, point);
        body.apply_force(way * ((total - impulse) / dt), point);
        if let Some((ground, foot)) = stands_on
            && let Some(mut ground) = world.body_mut(ground)
        {
            ground.apply_impulse(way * -impulse, foot);
            ground.apply_force(way * ((impulse - total) / dt), foot);
        }
        let expected = now + (total - resistance * dt) / mass;
        self.pushed = Some(Push { body: id, expected, resistance });
    }

    /// Where it pushes: where its side lies against an obstacle, as near to a centre of mass as that reaches.
    fn hand(&self, frame: Frame, hit: &Obstacle, center: DVec2) -> DVec2 {
        let half = frame.up * (0.5 * self.height - self.radius);
        let ends = [half, -half].map(|end| (self.position + end).relative_to(hit.point));
        let heights = ends.map(|end| end.dot(hit.normal));
        if (heights[0] - heights[1]).abs() > self.skin {
            return hit.point;
        }
        let along = hit.normal.perp();
        let (a, b) = (ends[0].dot(along), ends[1].dot(along));
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        let wanted = center.relative_to(hit.point).dot(along);
        let above = if wanted > low { wanted } else { low };
        hit.point + along * above.min(high)
    }

    /// Weighs on a dynamic body that it stands on.
    pub(super) fn weigh(&self, world: &mut World, frame: Frame, before: Option<MoverGround>) {
        let Some(ground) = self.ground else { return };
        // Nothing holds up what falls as fast as it would.
        let falls = before.filter(|before| before.body == ground.body).is_some_and(|before| {
            (ground.velocity - before.velocity).dot(frame.gravity)
                > FALLS * frame.gravity.length_sq() * frame.dt
        });
        let weight = frame.gravity * self.load(world, ground.body);
        if let Some(mut body) = world.body_mut(ground.body)
            && body.as_ref().kind() == BodyKind::Dynamic
            && !falls
        {
            body.apply_force(weight, ground.hold);
        }
    }

    /// The mass with which it weighs on a body. The body feels no inertia of it, so that is bounded by its own mass, or that of
    /// what touches it.
    fn load(&self, world: &World, body: BodyId) -> f32 {
        let Some(body) = world.body(body) else { return 0.0 };
        // Not by their forces: a frame has none of those until the next step.
        let pairs = body.contacts().map(|found| [found.body_a, found.body_b]);
        let masses = pairs.flatten().filter_map(|id| Some(world.body(id)?.mass()));
        let heaviest = masses.fold(body.mass(), |most, mass| if mass > most { mass } else { most });
        self.mass.min(MOST_LOAD * heaviest)
    }
}
