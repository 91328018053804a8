//! Forces, impulses and the places that kinematic bodies are to go to.

use super::bodies::finite;
use super::problems::Problems;
use super::step::Clock;
use crate::components::*;
use crate::world::PhysicsWorld;
use bevy_ecs::prelude::*;
use bevy_math::Vec2;
use tiny_physics::{Error, Transform};

/// Pushes bodies as their components say. What is not a number is set to 0, a target to where the body is, and told.
pub(crate) fn apply(
    mut physics: ResMut<PhysicsWorld>,
    clock: Clock,
    mut forces: Query<(Entity, &mut ExternalForce)>,
    mut impulses: Query<(Entity, &mut ExternalImpulse)>,
    mut targets: Query<(Entity, &mut KinematicTarget)>,
    mut problems: Problems,
) {
    let physics = &mut *physics;
    for (entity, mut push) in
        forces.iter_mut().filter(|(_, push)| **push != ExternalForce::default())
    {
        if problems.check(entity, "force", force(physics, entity, &push)).is_none() {
            *push = ExternalForce::default();
        }
    }
    for (entity, mut push) in
        impulses.iter_mut().filter(|(_, push)| **push != ExternalImpulse::default())
    {
        problems.check(entity, "impulse", impulse(physics, entity, &push));
        *push = ExternalImpulse::default();
    }
    for (entity, mut target) in &mut targets {
        let result = lead(physics, entity, &target, clock.seconds());
        if problems.check(entity, "target", result).is_none() {
            *target = here(physics, entity);
        }
    }
}

fn force(physics: &mut PhysicsWorld, entity: Entity, push: &ExternalForce) -> Result<(), Error> {
    finite("force", push.force.x + push.force.y)?;
    finite("torque", push.torque)?;
    if let Some(mut body) = physics.own_body_mut(entity) {
        body.apply_force_to_center(engine(push.force));
        body.apply_torque(push.torque);
    }
    Ok(())
}

fn impulse(
    physics: &mut PhysicsWorld,
    entity: Entity,
    push: &ExternalImpulse,
) -> Result<(), Error> {
    finite("impulse", push.impulse.x + push.impulse.y)?;
    finite("angular impulse", push.angular)?;
    if let Some(mut body) = physics.own_body_mut(entity) {
        body.apply_impulse_to_center(engine(push.impulse));
        body.apply_angular_impulse(push.angular);
    }
    Ok(())
}

fn lead(
    physics: &mut PhysicsWorld,
    entity: Entity,
    target: &KinematicTarget,
    dt: f32,
) -> Result<(), Error> {
    let Some(mut body) = physics.own_body_mut(entity) else { return Ok(()) };
    finite("target", target.position.x + target.position.y + target.angle)?;
    body.set_target(Transform::from_angle(engine(target.position), target.angle), dt);
    Ok(())
}

/// A target that leaves a body where it is.
fn here(physics: &PhysicsWorld, entity: Entity) -> KinematicTarget {
    let body = physics.own_body(entity).and_then(|id| physics.world.body(id));
    body.map_or(KinematicTarget::default(), |body| {
        let position = Vec2::new(body.position().x, body.position().y);
        KinematicTarget { position, angle: body.angle() }
    })
}
