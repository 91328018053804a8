//! Entering things into the tables of a world, and taking them out, with what belongs to them.

use super::{BodyRecord, JointRecord, Maps, PhysicsWorld, Role, ShapesRecord, TilesRecord};
use bevy_ecs::prelude::*;
use tiny_physics::{BodyId, BodyMut, Error, ShapeDef};

impl Maps {
    /// All that are in any table.
    pub fn entities(&self) -> Vec<Entity> {
        let bodies = self.bodies.keys().chain(self.shapes.keys()).chain(self.joints.keys());
        bodies
            .chain(self.tiles.keys())
            .chain(self.characters.keys())
            .chain(&self.waiting)
            .copied()
            .collect()
    }
}

impl PhysicsWorld {
    /// Something to order entities by that does not depend on their numbers.
    pub(crate) fn place(&self, entity: Entity) -> (u64, u64, u64) {
        let place = |bits: Option<u64>| bits.unwrap_or(u64::MAX);
        (
            place(self.maps.bodies.get(&entity).map(|record| record.id.to_bits())),
            place(self.shape_ids(entity).next().map(|id| id.to_bits())),
            place(self.joint_id(entity).map(|id| id.to_bits())),
        )
    }

    /// The body that an entity is, not that which it is part of.
    pub(crate) fn own_body(&self, entity: Entity) -> Option<BodyId> {
        self.maps.bodies.get(&entity).map(|record| record.id)
    }

    pub(crate) fn own_body_mut(&mut self, entity: Entity) -> Option<BodyMut<'_>> {
        self.world.body_mut(self.own_body(entity)?)
    }

    /// The body of a collider that stands alone.
    pub(crate) fn lone(&self, entity: Entity) -> Option<BodyId> {
        self.maps
            .bodies
            .get(&entity)
            .filter(|record| record.role == Role::Lone)
            .map(|record| record.id)
    }

    pub(crate) fn enter_body(&mut self, entity: Entity, record: BodyRecord) {
        self.maps.refused.forget(record.role, entity);
        self.maps.body_entities.set(record.id.to_bits(), entity);
        self.maps.bodies.insert(entity, record);
    }

    pub(crate) fn enter_shapes(&mut self, entity: Entity, record: ShapesRecord) {
        for (id, _) in &record.shapes {
            self.maps.shape_entities.set(id.to_bits(), entity);
        }
        self.maps.shapes.insert(entity, record);
    }

    pub(crate) fn enter_joint(&mut self, entity: Entity, record: JointRecord) {
        self.maps.joint_entities.set(record.id.to_bits(), entity);
        self.maps.joints.insert(entity, record);
    }

    /// Adds all shapes of a collider to a body, or none.
    pub(crate) fn add_shapes(
        &mut self,
        entity: Entity,
        body: BodyId,
        shapes: &[ShapeDef],
    ) -> Result<(), Error> {
        let mut record = ShapesRecord { body, shapes: Vec::with_capacity(shapes.len()) };
        for shape in shapes {
            match self.world.add_shape(body, shape.clone()) {
                Ok(id) => record.shapes.push((id, shape.clone())),
                Err(error) => {
                    for (id, _) in record.shapes {
                        let _ = self.world.remove_shape(id);
                    }
                    return Err(error);
                }
            }
        }
        self.enter_shapes(entity, record);
        Ok(())
    }

    /// Takes a collider's shapes out.
    pub(crate) fn remove_shapes(&mut self, entity: Entity) {
        let Some(record) = self.maps.shapes.remove(&entity) else { return };
        let mut there = Vec::with_capacity(record.shapes.len());
        for (id, _) in record.shapes {
            self.maps.shape_entities.remove(id.to_bits());
            // Gone already where its body went.
            if self.world.shape(id).is_some() {
                there.push(id);
            }
        }
        let _ = self.world.remove_shapes(&there);
    }

    /// Takes a collider off the body that it was part of, or from the world where it stood alone.
    pub(crate) fn leave(&mut self, entity: Entity) {
        self.remove_shapes(entity);
        if self.lone(entity).is_some() {
            self.remove_body(entity);
        }
    }

    /// Takes an entity's body out. Its colliders look for another, its joints wait for one.
    pub(crate) fn remove_body(&mut self, entity: Entity) {
        let Some(record) = self.maps.bodies.remove(&entity) else { return };
        self.maps.characters.remove(&entity);
        let Some(body) = self.world.body(record.id) else { return };
        let joints: Vec<_> =
            body.joints().filter_map(|id| self.maps.joint_entities.get(id.to_bits())).collect();
        let mut colliders: Vec<_> =
            body.shapes().filter_map(|id| self.maps.shape_entities.get(id.to_bits())).collect();
        colliders.dedup();
        for joint in joints {
            self.remove_joint(joint);
            self.maps.waiting.insert(joint);
        }
        self.maps.body_entities.remove(record.id.to_bits());
        // All shapes at once: one by one, the mass of the others is found anew for each.
        let _ = self.world.remove_body(record.id);
        for collider in colliders {
            self.remove_shapes(collider);
            self.notes.colliders.push(collider);
        }
    }

    pub(crate) fn remove_joint(&mut self, entity: Entity) {
        self.maps.waiting.remove(&entity);
        let Some(record) = self.maps.joints.remove(&entity) else { return };
        self.maps.joint_entities.remove(record.id.to_bits());
        // Gone already where a body went or it broke.
        let _ = self.world.remove_joint(record.id);
    }

    pub(crate) fn remove_tiles(&mut self, entity: Entity) {
        let Some(TilesRecord { id, .. }) = self.maps.tiles.remove(&entity) else { return };
        for body in self.world.body_ids().filter(|body| self.world.tiles_of(*body) == Some(id)) {
            self.maps.body_entities.note_removed(body.to_bits(), entity);
        }
        let _ = self.world.remove_tiles(id);
    }
}
