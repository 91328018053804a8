//! The entities as physics sees them: who is a body, whose collider is whose, and where.

use crate::components::*;
use crate::frame::{Frame, frame_through, scaled};
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::*;
use bevy_ecs::query::{Allow, QueryData};
use bevy_ecs::system::SystemParam;
use bevy_transform::prelude::Transform;
use tiny_physics::{BodyKind, Error, Locks, ShapeDef};

/// Queries leave out what is disabled if they do not say this. Physics has to know it: it is there, but takes no part.
pub(crate) type WithDisabled = Allow<Disabled>;

/// What a body is told by.
#[derive(QueryData)]
pub(crate) struct BodyParts {
    pub kind: &'static RigidBody,
    velocity: Option<&'static Velocity>,
    damping: Option<&'static Damping>,
    gravity_scale: Option<&'static GravityScale>,
    locks: Option<&'static LockedAxes>,
    mass: Option<&'static Mass>,
    enabled: Option<&'static Enabled>,
    disabled: Has<Disabled>,
    can_sleep: Option<&'static CanSleep>,
    order: Option<&'static BodyOrder>,
}

/// What a collider is told by.
#[derive(QueryData)]
pub(crate) struct ColliderParts {
    collider: &'static Collider,
    friction: Option<&'static Friction>,
    restitution: Option<&'static Restitution>,
    density: Option<&'static Density>,
    speed: Option<&'static SurfaceSpeed>,
    filter: Option<&'static CollisionFilter>,
    one_way: Option<&'static OneWay>,
    sensor: Has<Sensor>,
    contact_events: Has<CollisionEvents>,
    hit_events: Has<HitEvents>,
}

#[derive(SystemParam)]
pub(crate) struct Scene<'w, 's> {
    transforms: Query<'w, 's, &'static Transform, WithDisabled>,
    parents: Query<'w, 's, &'static ChildOf, WithDisabled>,
    children: Query<'w, 's, &'static Children, WithDisabled>,
    bodies: Query<'w, 's, BodyParts>,
    colliders: Query<'w, 's, ColliderParts, WithDisabled>,
    orders: Query<'w, 's, &'static BodyOrder, WithDisabled>,
    disabled: Query<'w, 's, (), With<Disabled>>,
}

/// Entities that stand somewhere else, or below something else.
type Shift = (Or<(Changed<Transform>, Changed<ChildOf>)>, WithDisabled);

/// Places that changed since a system looked last.
#[derive(SystemParam)]
pub(crate) struct Moved<'w, 's> {
    moved: Query<'w, 's, (), Shift>,
    parents: Query<'w, 's, &'static ChildOf, WithDisabled>,
}

impl Moved<'_, '_> {
    /// May an entity be somewhere else, by itself or with what is above it?
    pub fn contains(&self, entity: Entity) -> bool {
        core::iter::once(entity)
            .chain(self.parents.iter_ancestors(entity))
            .any(|entity| self.moved.contains(entity))
    }
}

impl Scene<'_, '_> {
    pub fn is_body(&self, entity: Entity) -> bool {
        self.bodies.contains(entity)
    }

    pub fn is_disabled(&self, entity: Entity) -> bool {
        self.disabled.contains(entity)
    }

    pub fn is_collider(&self, entity: Entity) -> bool {
        self.colliders.contains(entity)
    }

    pub fn transform(&self, entity: Entity) -> Option<&Transform> {
        self.transforms.get(entity).ok()
    }

    /// Place in the world.
    pub fn frame(&self, entity: Entity) -> Option<Frame> {
        self.frame_through(entity, self.parents.iter_ancestors(entity))
    }

    fn frame_through(&self, entity: Entity, above: impl Iterator<Item = Entity>) -> Option<Frame> {
        frame_through(entity, above, |entity| self.transforms.get(entity).ok())
    }

    /// Place in a body at or above an entity, scaled as the body is: the same to the last bit wherever that is.
    fn frame_in(&self, body: Entity, entity: Entity) -> Option<Frame> {
        let outer = Frame { scale: self.frame(body)?.scale, ..Frame::IDENTITY };
        if entity == body {
            return Some(outer);
        }
        let above = self.parents.iter_ancestors(entity).take_while(|above| *above != body);
        Some(outer.compose(&self.frame_through(entity, above)?))
    }

    /// Is something above it?
    pub fn is_below(&self, entity: Entity) -> bool {
        self.parents.contains(entity)
    }

    /// The nearest body at or above an entity.
    pub fn owner(&self, entity: Entity) -> Option<Entity> {
        core::iter::once(entity)
            .chain(self.parents.iter_ancestors(entity))
            .find(|entity| self.is_body(*entity))
    }

    pub fn order(&self, entity: Entity) -> u64 {
        self.orders.get(entity).map_or(0, |order| order.0)
    }

    /// Colliders at or below an entity, but for those of bodies below it.
    pub fn colliders_below(&self, entity: Entity, found: &mut Vec<Entity>) {
        if self.is_collider(entity) {
            found.push(entity);
        }
        for child in self.children.get(entity).into_iter().flatten() {
            if !self.is_body(*child) {
                self.colliders_below(*child, found);
            }
        }
    }

    /// A body without shapes, at its place.
    pub fn body(&self, entity: Entity) -> Option<tiny_physics::RigidBody> {
        let (parts, frame) = (self.bodies.get(entity).ok()?, self.frame(entity)?);
        let velocity = parts.velocity.copied().unwrap_or_default();
        let damping = parts.damping.copied().unwrap_or_default();
        Some(tiny_physics::RigidBody {
            kind: kind(*parts.kind),
            position: frame.p.into(),
            angle: frame.q.angle(),
            velocity: engine(velocity.linear),
            angular_velocity: velocity.angular,
            linear_damping: damping.linear,
            angular_damping: damping.angular,
            gravity_scale: parts.gravity_scale.map_or(1.0, |scale| scale.0),
            locks: parts.locks.map_or(Locks::default(), locks),
            mass: parts.mass.map(|mass| mass.0),
            enabled: !parts.disabled && parts.enabled.is_none_or(|enabled| enabled.0),
            can_sleep: parts.can_sleep.is_none_or(|can_sleep| can_sleep.0),
            ..tiny_physics::RigidBody::default()
        })
    }

    /// The shapes of a collider in the frame of its body, scaled as the entity is; without an owner in the collider's own. None of one that is
    /// disabled alone, of a body that takes part.
    pub fn shapes(&self, collider: Entity, owner: Option<Entity>) -> Result<Vec<ShapeDef>, Error> {
        if owner.is_some_and(|owner| self.is_disabled(collider) && !self.is_disabled(owner)) {
            return Ok(Vec::new());
        }
        let local = self.frame_in(owner.unwrap_or(collider), collider);
        let (Ok(parts), Some(local)) = (self.colliders.get(collider), local) else {
            return Ok(Vec::new());
        };
        if let Some(error) = parts.collider.error() {
            return Err(error.clone());
        }
        parts.collider.shapes().iter().map(|shape| parts.shape(shape, &local)).collect()
    }
}

impl ColliderPartsItem<'_, '_> {
    fn shape(&self, shape: &ShapeDef, local: &Frame) -> Result<ShapeDef, Error> {
        let mut def = shape.clone();
        def.shape = scaled(&def.shape, local.scale)?;
        let offset =
            tiny_physics::Vec2::new(def.offset.x * local.scale.x, def.offset.y * local.scale.y);
        def.offset = local.p + local.q.rotate(offset);
        def.angle = local.q.angle() + if local.is_mirrored() { -def.angle } else { def.angle };
        let sign = local.scale.signum();
        def.one_way = self
            .one_way
            .map(|way| engine(way.0))
            .or(def.one_way)
            .map(|way| local.q.rotate(tiny_physics::Vec2::new(way.x * sign.x, way.y * sign.y)));
        if local.scale != bevy_math::Vec2::ONE && def.link.is_some() {
            return Err(Error::Unsupported { reason: "a chain does not scale; scale its points" });
        }
        let material = &mut def.material;
        material.friction = self.friction.map_or(material.friction, |friction| friction.0);
        material.restitution =
            self.restitution.map_or(material.restitution, |restitution| restitution.0);
        material.density = self.density.map_or(material.density, |density| density.0);
        material.tangent_speed = self.speed.map_or(material.tangent_speed, |speed| speed.0);
        def.filter = self.filter.map_or(def.filter, |filter| filter.0);
        def.sensor |= self.sensor;
        def.contact_events |= self.contact_events;
        def.hit_events |= self.hit_events;
        Ok(def)
    }
}

pub(crate) fn kind(kind: RigidBody) -> BodyKind {
    match kind {
        RigidBody::Dynamic => BodyKind::Dynamic,
        RigidBody::Static => BodyKind::Static,
        RigidBody::Kinematic => BodyKind::Kinematic,
    }
}

pub(crate) fn locks(axes: &LockedAxes) -> Locks {
    Locks { x: axes.x, y: axes.y, rotation: axes.rotation }
}
