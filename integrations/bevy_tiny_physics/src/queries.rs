//! Questions to the world, with entities in the answers.

use crate::PhysicsWorld;
use crate::components::engine;
use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;
use bevy_math::Vec2;
use tiny_physics::{BodyId, Filter, Pose, QueryFilter, Shape, ShapeId};

/// What a query met.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct EntityHit {
    /// Entity of the collider; of the tile map where it is one.
    pub collider: Entity,
    /// Entity of its body.
    pub body: Entity,
    /// Where: world, metres.
    pub point: Vec2,
    /// Unit normal out of what was met.
    pub normal: Vec2,
    /// Part of the way, 0 to 1.
    pub fraction: f32,
}

/// What a query sees; by default everything but sensors.
#[derive(Clone, Copy, Debug, Default)]
pub struct EntityFilter {
    /// What the query is and sees; `None` sees all.
    pub filter: Option<Filter>,
    /// An entity whose body is not seen: usually that of who looks.
    pub exclude: Option<Entity>,
    /// Are sensors seen?
    pub sensors: bool,
    /// Does a ray hit what it begins in?
    pub solid: bool,
}

impl EntityFilter {
    /// Sees everything but sensors and the body of an entity.
    pub fn without(entity: Entity) -> Self {
        Self { exclude: Some(entity), ..Self::default() }
    }

    /// Sees only shapes whose category has one of these bits.
    pub fn mask(mut self, mask: u64) -> Self {
        let all = QueryFilter::new().filter;
        self.filter = Some(Filter { mask, ..self.filter.unwrap_or(all) });
        self
    }
}

/// Asks the world as of the last step. A system parameter; several systems may ask at once.
///
/// ```
/// use bevy_ecs::prelude::*;
/// use bevy_math::Vec2;
/// use bevy_tiny_physics::prelude::*;
/// use bevy_transform::prelude::Transform;
/// fn look(who: Query<(Entity, &Transform), With<Character>>, physics: PhysicsQuery) {
///     for (entity, transform) in &who {
///         let eye = transform.translation.truncate();
///         if let Some(hit) = physics.ray_cast(eye, Vec2::X * 20.0, &EntityFilter::without(entity)) {
///             println!("sees {:?} at {:?}", hit.body, hit.point);
///         }
///     }
/// }
/// ```
#[derive(SystemParam)]
pub struct PhysicsQuery<'w> {
    physics: Res<'w, PhysicsWorld>,
}

impl PhysicsQuery<'_> {
    /// The first thing that a ray enters on its way from `origin` along `translation` (metres).
    pub fn ray_cast(
        &self,
        origin: Vec2,
        translation: Vec2,
        filter: &EntityFilter,
    ) -> Option<EntityHit> {
        let hit =
            self.physics.world.ray_cast(engine(origin), engine(translation), &self.seen(filter))?;
        Some(self.hit(hit.shape, hit.body, hit.point, hit.normal, hit.fraction))
    }

    /// All that a ray enters, nearest first.
    pub fn ray_cast_all(
        &self,
        origin: Vec2,
        translation: Vec2,
        filter: &EntityFilter,
    ) -> Vec<EntityHit> {
        let hits = self.physics.world.ray_cast_all(
            engine(origin),
            engine(translation),
            &self.seen(filter),
        );
        hits.iter()
            .map(|hit| self.hit(hit.shape, hit.body, hit.point, hit.normal, hit.fraction))
            .collect()
    }

    /// The first thing that a shape meets when it is moved from a place (and angle) along `translation`.
    pub fn cast_shape(
        &self,
        shape: &Shape,
        (position, angle): (Vec2, f32),
        translation: Vec2,
        filter: &EntityFilter,
    ) -> Option<EntityHit> {
        let pose = pose(position, angle);
        let hit =
            self.physics.world.cast_shape(shape, pose, engine(translation), &self.seen(filter))?;
        Some(self.hit(hit.shape, hit.body, hit.point, hit.normal, hit.fraction))
    }

    /// Colliders that overlap a shape.
    pub fn overlap_shape(
        &self,
        shape: &Shape,
        position: Vec2,
        angle: f32,
        filter: &EntityFilter,
    ) -> Vec<Entity> {
        self.colliders(self.physics.world.overlap_shape(
            shape,
            pose(position, angle),
            &self.seen(filter),
        ))
    }

    /// Colliders that hold a point.
    pub fn at_point(&self, point: Vec2, filter: &EntityFilter) -> Vec<Entity> {
        self.colliders(self.physics.world.overlap_point(engine(point), &self.seen(filter)))
    }

    /// The closest collider within `max_distance` metres: entity, point on it, distance.
    pub fn closest(
        &self,
        point: Vec2,
        max_distance: f32,
        filter: &EntityFilter,
    ) -> Option<(Entity, Vec2, f32)> {
        let found =
            self.physics.world.closest_point(engine(point), max_distance, &self.seen(filter))?;
        let collider = self.physics.collider_entity(found.shape).unwrap_or(Entity::PLACEHOLDER);
        Some((collider, Vec2::new(found.point.x as f32, found.point.y as f32), found.distance))
    }

    /// The whole world, for all other questions.
    pub fn world(&self) -> &PhysicsWorld {
        &self.physics
    }

    fn seen(&self, filter: &EntityFilter) -> QueryFilter<'static> {
        QueryFilter {
            filter: filter.filter.unwrap_or(QueryFilter::new().filter),
            exclude_body: filter.exclude.and_then(|entity| self.physics.body_id(entity)),
            sensors: filter.sensors,
            solid: filter.solid,
            predicate: None,
        }
    }

    fn hit(
        &self,
        shape: ShapeId,
        body: BodyId,
        point: tiny_physics::DVec2,
        normal: tiny_physics::Vec2,
        fraction: f32,
    ) -> EntityHit {
        EntityHit {
            collider: self.physics.collider_entity(shape).unwrap_or(Entity::PLACEHOLDER),
            body: self.physics.body_entity(body).unwrap_or(Entity::PLACEHOLDER),
            point: Vec2::new(point.x as f32, point.y as f32),
            normal: Vec2::new(normal.x, normal.y),
            fraction,
        }
    }

    /// Each once, in the order of the world.
    fn colliders(&self, shapes: Vec<ShapeId>) -> Vec<Entity> {
        let mut found: Vec<Entity> = Vec::new();
        for entity in shapes.into_iter().filter_map(|shape| self.physics.collider_entity(shape)) {
            if !found.contains(&entity) {
                found.push(entity);
            }
        }
        found
    }
}

fn pose(position: Vec2, angle: f32) -> Pose {
    tiny_physics::Transform::from_angle(engine(position), angle).into()
}
