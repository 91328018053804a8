//! Telling what could not be done.

use crate::PhysicsProblem;
use crate::world::{PhysicsWorld, Role};
use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;
use tiny_physics::Error;

/// Sends and logs problems.
#[derive(SystemParam)]
pub(crate) struct Problems<'w> {
    writer: MessageWriter<'w, PhysicsProblem>,
}

impl Problems<'_> {
    pub fn report(&mut self, entity: impl Into<Option<Entity>>, what: &'static str, error: Error) {
        let entity = entity.into();
        match entity {
            Some(entity) => log::error!("physics: {what} of entity {entity}: {error}"),
            None => log::error!("physics: {what}: {error}"),
        }
        self.writer.write(PhysicsProblem { entity, what, error });
    }

    /// Notes that an entity cannot be what it asks to be. It is tried again when it changes, and told again when it is refused for another
    /// reason.
    pub fn refuse(&mut self, physics: &mut PhysicsWorld, entity: Entity, role: Role, error: Error) {
        if physics.maps.refused.note(role, entity, error.to_string()) {
            self.report(entity, role.name(), error);
        }
    }

    /// Passes on what went well, and tells the rest.
    pub fn check<T>(
        &mut self,
        entity: Entity,
        what: &'static str,
        result: Result<T, Error>,
    ) -> Option<T> {
        result.map_err(|error| self.report(entity, what, error)).ok()
    }
}
