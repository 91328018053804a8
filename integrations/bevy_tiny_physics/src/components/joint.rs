//! Joints.

use bevy_ecs::entity::{EntityMapper, MapEntities};
use bevy_ecs::prelude::*;
use tiny_physics::JointDef;

/// Joins two bodies. It may sit on an entity of its own or on one of the bodies; it waits until both are there, and goes when it breaks
/// (see [`JointBroke`](crate::JointBroke)).
///
/// ```
/// use bevy_ecs::prelude::*;
/// use bevy_tiny_physics::prelude::*;
/// fn hang(mut commands: Commands, hook: Entity, lamp: Entity) {
///     commands.spawn(Joint::new(hook, lamp, JointDef::rope(2.0)));
/// }
/// ```
#[derive(Component, Clone, PartialEq, Debug)]
#[component(map_entities)]
pub struct Joint {
    /// Body A.
    pub a: Entity,
    /// Body B.
    pub b: Entity,
    /// What it does. Anchors are in the frames of the bodies, or points of the world (`anchor_at`, `anchors_at`) where the bodies are when
    /// they are joined; those stay on the bodies as they move, whatever else is changed. Other points join them anew.
    pub def: JointDef,
}

impl Joint {
    /// A joint of two bodies.
    pub fn new(a: Entity, b: Entity, def: JointDef) -> Self {
        Self { a, b, def }
    }
}

impl MapEntities for Joint {
    fn map_entities<M: EntityMapper>(&mut self, mapper: &mut M) {
        self.a = mapper.get_mapped(self.a);
        self.b = mapper.get_mapped(self.b);
    }
}
