//! A copy of the world that has come in, as rollback does it: components follow it.

use super::scene::WithDisabled;
use super::write::{self, Places, Which};
use crate::components::Velocity;
use crate::world::PhysicsWorld;
use bevy_ecs::prelude::*;

/// Writes every body's place and velocity to its entity.
pub(crate) fn take_over(
    mut physics: ResMut<PhysicsWorld>,
    mut places: Places,
    velocities: Query<(Entity, &mut Velocity), WithDisabled>,
) {
    if !physics.fresh {
        return;
    }
    let bodies = physics.world.body_ids().collect::<Vec<_>>();
    places.write(&mut physics, bodies.into_iter(), Which::All, |body| body.pose());
    places.write_characters(&mut physics, Which::All, |mover| mover.position);
    write::velocities(physics, velocities);
}
