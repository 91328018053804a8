//! The world as one resource, with the tables that lead from entities to handles and back.

mod refused;
mod tables;

use crate::components::Velocity;
use crate::frame::Parts;
use bevy_ecs::entity::{EntityHashMap, EntityHashSet, EntityMapper, MapEntities};
use bevy_ecs::prelude::*;
use bevy_math::{Quat, Vec2};
use bevy_transform::prelude::Transform;
use refused::Refused;
use std::collections::BTreeSet;
use std::sync::Arc;
use tiny_physics::{
    Body, BodyId, BodyKind, BodyMut, CharacterMover, JointDef, JointId, JointRef, Locks, ShapeDef,
    ShapeId, TileGrid, TileGridId,
};

/// All of physics: bodies, joints, characters, and which entity is which. A plain value, so that a frame to go back to is a copy:
///
/// ```
/// use bevy_tiny_physics::prelude::*;
/// fn rewind(mut physics: bevy_ecs::prelude::ResMut<PhysicsWorld>, saved: &PhysicsWorld) {
///     physics.clone_from(saved); // or *physics = saved.clone()
/// }
/// ```
///
/// A copy that takes the place of the resource writes place and velocity of every body to its entity at the next step; what entities
/// say in the meantime of places and velocities is dropped. Whatever else the components of bodies, colliders, joints and tile maps say by now holds, and
/// a joint that broke since is on its entity again. Bodies whose entities are gone go; entities that the copy does not know are added as
/// new ones. Where a rollback despawns and spawns again, [`MapEntities`] takes the copy to the new entities.
#[derive(Resource, Debug)]
pub struct PhysicsWorld {
    /// The engine's world. Whatever is done to it is seen; bodies that are added here have no entity. Place what has one by
    /// [`PhysicsWorld::body_mut`]: only that writes the place to the entity though the body does not move in the next step.
    pub world: tiny_physics::World,
    pub(crate) maps: Maps,
    /// What hooks noted since the last step.
    pub(crate) notes: Notes,
    /// Is this a copy that has not been stepped?
    pub(crate) fresh: bool,
    /// Did the last step take place?
    pub(crate) stepped: bool,
}

impl Clone for PhysicsWorld {
    fn clone(&self) -> Self {
        Self {
            world: self.world.clone(),
            maps: self.maps.clone(),
            notes: self.notes.clone(),
            fresh: true,
            stepped: false,
        }
    }

    fn clone_from(&mut self, source: &Self) {
        self.world.clone_from(&source.world);
        self.maps.clone_from(&source.maps);
        self.notes.clone_from(&source.notes);
        (self.fresh, self.stepped) = (true, false);
    }
}

/// Components that were taken off entities, and bodies that were changed by hand.
#[derive(Clone, Debug, Default)]
pub(crate) struct Notes {
    /// What makes a body, joint, tile map or character.
    pub gone: Vec<Entity>,
    /// What a body is told by.
    pub bodies: Vec<Entity>,
    /// What a collider is told by, and parents.
    pub colliders: Vec<Entity>,
    /// What Bevy's `Disabled` came on or went off.
    pub switched: Vec<Entity>,
    /// Bodies of which the place is to be written, even if they do not move: they may have been placed by hand, or taken off a parent.
    pub placed: BTreeSet<BodyId>,
}

impl Notes {
    /// Notes that an entity takes part no longer, or again.
    pub fn switch(&mut self, entity: Entity) {
        for list in [&mut self.bodies, &mut self.colliders, &mut self.switched] {
            list.push(entity);
        }
    }

    /// All that something was taken off.
    pub fn taken_off(&self) -> impl Iterator<Item = Entity> + '_ {
        self.gone.iter().chain(&self.bodies).chain(&self.colliders).copied()
    }
}

/// A body, and what was last written to its entity.
#[derive(Clone, Debug)]
pub(crate) struct BodyRecord {
    pub id: BodyId,
    pub role: Role,
    /// What stands in the entity's transform by our doing, or has been read there.
    pub written: Option<Written>,
    /// What stands in the entity's velocity, likewise.
    pub told: Option<Velocity>,
    /// What its other components said last.
    pub said: Option<Said>,
}

/// What components say of a body, but for place and velocity.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Said {
    kind: BodyKind,
    damping: [f32; 2],
    gravity_scale: f32,
    locks: Locks,
    mass: Option<f32>,
    enabled: bool,
    can_sleep: bool,
}

impl Said {
    pub fn of(body: &tiny_physics::RigidBody) -> Self {
        Self {
            kind: body.kind,
            damping: [body.linear_damping, body.angular_damping],
            gravity_scale: body.gravity_scale,
            locks: body.locks,
            mass: body.mass,
            enabled: body.enabled,
            can_sleep: body.can_sleep,
        }
    }
}

/// What counts of a transform.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Written {
    position: Vec2,
    rotation: Quat,
    scale: Vec2,
}

impl Written {
    pub fn of(transform: &Transform) -> Self {
        Self {
            position: transform.translation.truncate(),
            rotation: transform.rotation,
            scale: transform.scale.truncate(),
        }
    }

    pub fn is_scaled_like(&self, other: &Self) -> bool {
        self.scale == other.scale
    }

    /// What somebody has moved since. How characters are turned is not physics' business.
    pub fn moved(&self, now: &Self, role: Role) -> Parts {
        Parts {
            place: self.position != now.position,
            turn: role != Role::Character && self.rotation != now.rotation,
        }
    }

    /// With these parts of what stands there now. The others, and the scale, stay as they were read: who changed those has yet to be heard.
    pub fn with(self, parts: Parts, now: &Self) -> Self {
        Self {
            position: if parts.place { now.position } else { self.position },
            rotation: if parts.turn { now.rotation } else { self.rotation },
            scale: self.scale,
        }
    }
}

/// What made an entity a body.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Role {
    /// A [`RigidBody`](crate::RigidBody).
    Body,
    /// A collider that has none.
    Lone,
    /// A character.
    Character,
}

impl Role {
    /// As problems call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Body => "body",
            Self::Lone => "collider",
            Self::Character => "character",
        }
    }
}

/// The shapes of a collider, in its body's frame.
#[derive(Clone, Debug)]
pub(crate) struct ShapesRecord {
    pub body: BodyId,
    pub shapes: Vec<(ShapeId, ShapeDef)>,
}

/// A joint, as it was asked for.
#[derive(Clone, Debug)]
pub(crate) struct JointRecord {
    pub id: JointId,
    pub bodies: (Entity, Entity),
    pub def: JointDef,
    /// Was its entity disabled then?
    pub is_disabled: bool,
}

/// A tile map, as it was asked for.
#[derive(Clone, Debug)]
pub(crate) struct TilesRecord {
    pub id: TileGridId,
    /// What the component said last; copies share it.
    pub said: Arc<TileGrid>,
}

/// From entities to handles and back.
#[derive(Clone, Debug, Default)]
pub(crate) struct Maps {
    pub bodies: EntityHashMap<BodyRecord>,
    pub shapes: EntityHashMap<ShapesRecord>,
    pub joints: EntityHashMap<JointRecord>,
    /// Joints that wait for their bodies.
    pub waiting: EntityHashSet,
    pub refused: Refused,
    pub tiles: EntityHashMap<TilesRecord>,
    pub characters: EntityHashMap<CharacterMover>,
    pub body_entities: Handles,
    pub shape_entities: Handles,
    pub joint_entities: Handles,
}

/// Entities by handle. Those of removed handles are known until the events of the next step have been told.
#[derive(Clone, Debug, Default)]
pub(crate) struct Handles {
    rows: Vec<(u64, Entity)>,
    removed: Vec<(u64, Entity)>,
}

impl Handles {
    /// `bits` are those of a handle: its index below, its generation above.
    pub fn set(&mut self, bits: u64, entity: Entity) {
        let index = bits as u32 as usize;
        if index >= self.rows.len() {
            self.rows.resize(index + 1, (u64::MAX, Entity::PLACEHOLDER));
        }
        self.removed
            .extend(Some(self.rows[index]).filter(|row| row.0 != u64::MAX && row.0 != bits));
        self.rows[index] = (bits, entity);
    }

    pub fn get(&self, bits: u64) -> Option<Entity> {
        let row = self.rows.get(bits as u32 as usize).filter(|row| row.0 == bits);
        row.or_else(|| self.removed.iter().find(|row| row.0 == bits)).map(|row| row.1)
    }

    pub fn remove(&mut self, bits: u64) {
        if let Some(row) = self.rows.get_mut(bits as u32 as usize).filter(|row| row.0 == bits) {
            self.removed.push(*row);
            row.0 = u64::MAX;
        }
    }

    /// Knows what is removed now though it was never entered.
    pub fn note_removed(&mut self, bits: u64, entity: Entity) {
        self.removed.push((bits, entity));
    }

    pub fn forget_removed(&mut self) {
        self.removed.clear();
    }

    fn map_entities<M: EntityMapper>(&mut self, mapper: &mut M) {
        for row in self.rows.iter_mut().chain(&mut self.removed).filter(|row| row.0 != u64::MAX) {
            row.1 = mapper.get_mapped(row.1);
        }
    }
}

impl PhysicsWorld {
    /// Of an empty world.
    pub fn new(world: tiny_physics::World) -> Self {
        Self { world, maps: Maps::default(), notes: Notes::default(), fresh: false, stepped: false }
    }

    /// Handle of an entity's body; `None` until the first step after it was spawned. A collider below a body has that body.
    pub fn body_id(&self, entity: Entity) -> Option<BodyId> {
        let own = self.maps.bodies.get(&entity).map(|record| record.id);
        own.or_else(|| self.maps.shapes.get(&entity).map(|record| record.body))
    }

    /// The body of an entity, to read.
    pub fn body(&self, entity: Entity) -> Option<Body<'_>> {
        self.world.body(self.body_id(entity)?)
    }

    /// The body of an entity, to change: impulses at points, sleep, and all that has no component.
    pub fn body_mut(&mut self, entity: Entity) -> Option<BodyMut<'_>> {
        let body = self.world.body_mut(self.body_id(entity)?)?;
        self.notes.placed.insert(body.id());
        Some(body)
    }

    /// Handle of an entity's joint; `None` while it waits for its bodies.
    pub fn joint_id(&self, entity: Entity) -> Option<JointId> {
        self.maps.joints.get(&entity).map(|record| record.id)
    }

    /// The joint of an entity, to read: angle, speed, force, load of its motor.
    pub fn joint(&self, entity: Entity) -> Option<JointRef<'_>> {
        self.world.joint(self.joint_id(entity)?)
    }

    /// The mover of a character: what stopped it, and where its ground is.
    pub fn character(&self, entity: Entity) -> Option<&CharacterMover> {
        self.maps.characters.get(&entity)
    }

    /// The mover of a character, to launch or to place; to move it along what is in its way see
    /// [`PhysicsWorld::character_in_world`]. It lies in the world, so that it goes back with it.
    pub fn character_mut(&mut self, entity: Entity) -> Option<&mut CharacterMover> {
        self.maps.characters.get_mut(&entity)
    }

    /// The mover of a character, and the world that it moves through: for [`CharacterMover::move_by`], `resize` and `fits`. It walks or falls on
    /// from there in the next step; what it weighs then is its [`Character`](crate::Character)'s `gravity_scale`.
    ///
    /// ```
    /// use bevy_ecs::prelude::*;
    /// use bevy_tiny_physics::prelude::*;
    /// fn dash(mut physics: ResMut<PhysicsWorld>, heroes: Query<Entity, With<Character>>) {
    ///     for hero in &heroes {
    ///         if let Some((mover, world)) = physics.character_in_world(hero) {
    ///             mover.move_by(world, (2.0, 0.0));
    ///         }
    ///     }
    /// }
    /// ```
    pub fn character_in_world(
        &mut self,
        entity: Entity,
    ) -> Option<(&mut CharacterMover, &mut tiny_physics::World)> {
        let mover = self.maps.characters.get_mut(&entity)?;
        Some((mover, &mut self.world))
    }

    /// Handles of an entity's shapes.
    pub fn shape_ids(&self, entity: Entity) -> impl Iterator<Item = ShapeId> + '_ {
        self.maps
            .shapes
            .get(&entity)
            .into_iter()
            .flat_map(|record| record.shapes.iter().map(|(id, _)| *id))
    }

    /// The entity of a body: that of a tile map, too. `None` for bodies that no entity made.
    pub fn body_entity(&self, body: BodyId) -> Option<Entity> {
        self.maps.body_entities.get(body.to_bits()).or_else(|| self.tiles_entity(body))
    }

    /// The entity of a shape: the collider, the character or the tile map.
    pub fn collider_entity(&self, shape: ShapeId) -> Option<Entity> {
        let own = self.maps.shape_entities.get(shape.to_bits());
        own.or_else(|| self.body_entity(self.world.shape(shape)?.body()))
    }

    /// The entity of a joint.
    pub fn joint_entity(&self, joint: JointId) -> Option<Entity> {
        self.maps.joint_entities.get(joint.to_bits())
    }

    fn tiles_entity(&self, body: BodyId) -> Option<Entity> {
        let grid = self.world.tiles_of(body)?;
        self.maps.tiles.iter().find(|(_, record)| record.id == grid).map(|(entity, _)| *entity)
    }
}

/// Takes the tables to other entities: for rollback that despawns and spawns again.
impl MapEntities for PhysicsWorld {
    fn map_entities<M: EntityMapper>(&mut self, mapper: &mut M) {
        fn keys<V, M: EntityMapper>(map: &mut EntityHashMap<V>, mapper: &mut M) {
            let old = core::mem::take(map);
            map.extend(old.into_iter().map(|(entity, value)| (mapper.get_mapped(entity), value)));
        }
        let maps = &mut self.maps;
        keys(&mut maps.bodies, mapper);
        keys(&mut maps.shapes, mapper);
        keys(&mut maps.joints, mapper);
        keys(&mut maps.tiles, mapper);
        keys(&mut maps.characters, mapper);
        for joint in maps.joints.values_mut() {
            joint.bodies = (mapper.get_mapped(joint.bodies.0), mapper.get_mapped(joint.bodies.1));
        }
        let waiting = core::mem::take(&mut maps.waiting);
        maps.waiting.extend(waiting.into_iter().map(|entity| mapper.get_mapped(entity)));
        for handles in [&mut maps.body_entities, &mut maps.shape_entities, &mut maps.joint_entities]
        {
            handles.map_entities(mapper);
        }
        maps.refused.map_entities(mapper);
        let Notes { gone, bodies, colliders, switched, placed: _ } = &mut self.notes;
        for entity in [gone, bodies, colliders, switched].into_iter().flatten() {
            *entity = mapper.get_mapped(*entity);
        }
    }
}
