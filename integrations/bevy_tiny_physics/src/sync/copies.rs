//! A copy of the world that has come in, as rollback does it: components follow it.

use super::write::{Places, Which};
use crate::components::Velocity;
use crate::world::PhysicsWorld;
use bevy_ecs::prelude::*;
use bevy_math::Vec2;

/// Writes every body's place and velocity to its entity.
pub(crate) fn take_over(
    mut physics: ResMut<PhysicsWorld>,
    mut places: Places,
    mut velocities: Query<&mut Velocity>,
) {
    if !physics.fresh {
        return;
    }
    let physics = &mut *physics;
    let bodies = physics.world.body_ids().collect::<Vec<_>>();
    places.write(physics, bodies.iter().copied(), Which::All, |body| body.pose());
    places.write_characters(physics, Which::All, |mover| mover.position);
    for body in bodies.iter().filter_map(|id| physics.world.body(*id)) {
        let Some(entity) = physics.maps.body_entities.get(body.id().to_bits()) else { continue };
        if let Ok(mut velocity) = velocities.get_mut(entity) {
            let linear = Vec2::new(body.velocity().x, body.velocity().y);
            velocity.set_if_neq(Velocity { linear, angular: body.angular_velocity() });
        }
    }
}
