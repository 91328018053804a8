//! A body that is held and pulled, by a mouse or a finger.

use tiny_physics::record::{BodyCommand, Command};
use tiny_physics::{BodyId, BodyKind, DVec2, QueryFilter, Shape, Vec2, World};

/// A held point reaches the pointer at this rate, 1/s.
const RATE: f32 = 12.0;
/// A body's speed is changed by no more than this in a second, metres a second squared; times the length unit.
const LIMIT: f32 = 600.0;

/// A dynamic body that is held at a point and follows a pointer.
///
/// ```
/// use tiny_physics::{RigidBody, Shape, Vec2, World};
/// use tiny_physics_scenes::Grip;
/// # fn main() -> Result<(), tiny_physics::Error> {
/// let mut world = World::new(Vec2::new(0.0, -9.8));
/// let ball = world.add_body(RigidBody::dynamic().shape(Shape::circle(0.5)?))?;
/// let mut grip = Grip::take(&world, Vec2::ZERO.into()).unwrap();
/// grip.target = Vec2::new(3.0, 2.0).into();
/// for _ in 0..120 {
///     grip.pull(&world, 1.0 / 60.0).unwrap().apply(&mut world)?;
///     world.step(1.0 / 60.0);
/// }
/// let position = world.body(ball).unwrap().position();
/// assert!((position - Vec2::new(3.0, 2.0)).length() < 0.05);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// What is held.
    pub body: BodyId,
    /// Where, in the body's frame, metres.
    pub local: Vec2,
    /// Where that point is to go: world, metres.
    pub target: DVec2,
}

impl Grip {
    /// Takes the dynamic body at a point of the world, the one drawn last where there are several.
    pub fn take(world: &World, point: DVec2) -> Option<Self> {
        let shapes = world.overlap_point(point, &QueryFilter::new());
        let bodies = shapes.into_iter().filter_map(|id| world.body(world.shape(id)?.body()));
        let body =
            bodies.filter(|body| body.kind() == BodyKind::Dynamic).max_by_key(|body| body.id())?;
        Some(Self { body: body.id(), local: body.pose().unapply(point), target: point })
    }

    /// Where the held point is: world, metres. `None` where the body has been removed.
    pub fn point(&self, world: &World) -> Option<DVec2> {
        Some(world.body(self.body)?.pose().apply(self.local))
    }

    /// What brings the held point towards the target in the next step of `dt` seconds.
    pub fn pull(&self, world: &World, dt: f32) -> Option<Command> {
        let body = world.body(self.body)?;
        let point = self.point(world)?;
        let arm = point.relative_to(body.center());
        let wanted = self.target.relative_to(point) * RATE;
        let change = wanted - body.velocity_at(point) - world.gravity * dt;
        let most = LIMIT * world.settings.length_unit * dt;
        let change = if change.length() > most { change.normalized() * most } else { change };
        // What the point weighs against an impulse: less than the body where it can turn.
        let (mass, inertia) = (body.mass(), body.inertia());
        // It has its inertia even where nothing turns it.
        let upright = |id| world.shape(id).is_some_and(|s| matches!(s.shape(), Shape::Aabb { .. }));
        let turns = inertia > 0.0 && !body.locks().rotation && !body.shapes().any(upright);
        let turning = if turns { arm.length_sq() * mass / inertia } else { 0.0 };
        let impulse = change * (mass / (1.0 + turning));
        Some(Command::Body(self.body, BodyCommand::ApplyImpulse(impulse, point)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tiny_physics::{Locks, RigidBody};

    /// How fast a corner of a body is after a pull that asks for 1.2 m/s.
    fn pulled(body: RigidBody) -> f32 {
        let mut world = World::new(Vec2::ZERO);
        let body = world.add_body(body).unwrap();
        let corner = DVec2::new(0.9, 0.2);
        let mut grip = Grip::take(&world, corner).unwrap();
        grip.target = DVec2::new(0.9, 0.3);
        grip.pull(&world, 1.0 / 60.0).unwrap().apply(&mut world).unwrap();
        world.body(body).unwrap().velocity_at(corner).y
    }

    #[test]
    fn what_cannot_turn_is_pulled_as_strongly() {
        let plank = RigidBody::dynamic().shape(Shape::rect(1.0, 0.25).unwrap());
        let locked = plank.clone().locks(Locks { rotation: true, ..Locks::default() });
        let half_extents = Vec2::new(1.0, 0.25);
        let upright = RigidBody::dynamic().shape(Shape::Aabb { half_extents });
        let speeds = [plank, locked, upright].map(pulled);
        assert!(speeds.iter().all(|speed| (speed - 1.2).abs() < 0.1), "{speeds:?}");
    }
}
