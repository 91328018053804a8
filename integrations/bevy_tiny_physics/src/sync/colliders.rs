//! Colliders: shapes of bodies, and their surfaces.

use super::problems::Problems;
use super::scene::{Moved, Scene, WithDisabled};
use crate::components::*;
use crate::order;
use crate::world::{BodyRecord, PhysicsWorld, Role, ShapesRecord, Written};
use bevy_ecs::prelude::*;
use bevy_transform::prelude::Transform;
use tiny_physics::{BodyId, Error, ShapeDef, ShapeId};

/// Colliders of which some component changed.
type ColliderChange = Or<(
    Changed<Collider>,
    Changed<Friction>,
    Changed<Restitution>,
    Changed<Density>,
    Changed<SurfaceSpeed>,
    Changed<CollisionFilter>,
    Changed<OneWay>,
    Changed<Sensor>,
    Changed<CollisionEvents>,
    Changed<HitEvents>,
)>;

/// Entities that moved against their parent, or got another one, or moved with all that lies below them.
type Shifted = (
    Without<RigidBody>,
    Or<(With<ChildOf>, With<Children>)>,
    Or<(Changed<Transform>, Changed<ChildOf>)>,
    WithDisabled,
);

/// Makes the world's shapes what colliders say.
pub(crate) fn read(
    mut physics: ResMut<PhysicsWorld>,
    scene: Scene,
    changed: Query<Entity, (With<Collider>, ColliderChange, WithDisabled)>,
    shifted: Query<Entity, Shifted>,
    all: Query<Entity, (With<Collider>, WithDisabled)>,
    moved: Moved,
    mut problems: Problems,
) {
    let physics = &mut *physics;
    let mut asked: Vec<Entity> = changed.iter().collect();
    for entity in shifted.iter().chain(core::mem::take(&mut physics.notes.colliders)) {
        scene.colliders_below(entity, &mut asked);
    }
    if physics.fresh {
        asked.extend(&all);
    }
    asked.extend(physics.maps.refused.asked_again(
        Role::Lone,
        |entity| scene.is_collider(entity) && scene.owner(entity).is_none(),
        |entity| moved.contains(entity),
    ));
    asked.sort_unstable();
    asked.dedup();
    let mut known = Vec::new();
    let mut lone = Vec::new();
    for entity in asked {
        let owner = scene.owner(entity);
        if owner.is_some_and(|owner| is_left(physics, &scene, entity, owner)) {
            continue;
        }
        let body = owner.or(physics.lone(entity).map(|_| entity));
        match (scene.shapes(entity, owner), body) {
            (Ok(shapes), Some(owner)) => {
                known.push((physics.own_body(owner), owner, entity, shapes));
            }
            (Ok(shapes), None) => lone.extend(lone_body(&scene, entity, shapes)),
            (Err(error), Some(_)) => problems.report(entity, "collider", error),
            (Err(error), None) => problems.refuse(physics, entity, Role::Lone, error),
        }
    }
    known.sort_by_cached_key(|(body, _, _, shapes)| (*body, order::text(shapes)));
    for (body, owner, entity, shapes) in known {
        let Some(body) = body else { continue };
        let result = change(physics, &scene, entity, (owner, body), &shapes);
        problems.check(entity, "collider", result);
    }
    lone.sort_by(|a, b| order::of_bodies(&a.1, &b.1));
    for (entity, (_, body)) in lone {
        if let Err(error) = add_lone(physics, &scene, entity, body) {
            problems.refuse(physics, entity, Role::Lone, error);
        }
    }
}

/// Is a collider left as it is, since its body takes no part either? It is read when one of the two is enabled.
fn is_left(physics: &PhysicsWorld, scene: &Scene, entity: Entity, owner: Entity) -> bool {
    let record = physics.maps.shapes.get(&entity);
    let is_there = record.is_some_and(|record| Some(record.body) == physics.own_body(owner));
    is_there && owner != entity && scene.is_disabled(entity) && scene.is_disabled(owner)
}

/// A static body for a collider that belongs to none.
fn lone_body(
    scene: &Scene,
    entity: Entity,
    shapes: Vec<ShapeDef>,
) -> Option<(Entity, (u64, tiny_physics::RigidBody))> {
    let frame = scene.frame(entity)?;
    let enabled = !scene.is_disabled(entity);
    let body = tiny_physics::RigidBody { shapes, enabled, ..tiny_physics::RigidBody::fixed() };
    Some((entity, (scene.order(entity), body.position(frame.p).angle(frame.q.angle()))))
}

fn add_lone(
    physics: &mut PhysicsWorld,
    scene: &Scene,
    entity: Entity,
    body: tiny_physics::RigidBody,
) -> Result<(), Error> {
    body.validate()?;
    physics.remove_shapes(entity);
    let shapes = body.shapes.clone();
    let id = physics.world.add_body(body)?;
    let ids: Vec<ShapeId> =
        physics.world.body(id).into_iter().flat_map(|body| body.shapes()).collect();
    let written = scene.transform(entity).map(Written::of);
    let role = Role::Lone;
    physics.enter_body(entity, BodyRecord { id, role, written, told: None, said: None });
    physics.enter_shapes(
        entity,
        ShapesRecord { body: id, shapes: ids.into_iter().zip(shapes).collect() },
    );
    place_lone(physics, scene, entity);
    Ok(())
}

/// Changes the shapes of a collider to what it says now: one by one where they are as many as before, else all anew.
fn change(
    physics: &mut PhysicsWorld,
    scene: &Scene,
    entity: Entity,
    (owner, body): (Entity, BodyId),
    shapes: &[ShapeDef],
) -> Result<(), Error> {
    shapes.iter().try_for_each(ShapeDef::validate)?;
    if owner != entity && physics.lone(entity).is_some() {
        physics.remove_body(entity);
    }
    if owner == entity && physics.lone(entity).is_some() {
        place_lone(physics, scene, entity);
    }
    let alike =
        |record: &ShapesRecord| {
            record.body == body
                && record.shapes.len() == shapes.len()
                && record.shapes.iter().zip(shapes).all(|((_, is), said)| {
                    is.link == said.link && is.sees_sensors == said.sees_sensors
                })
        };
    if !physics.maps.shapes.get(&entity).is_some_and(alike) {
        physics.remove_shapes(entity);
        return physics.add_shapes(entity, body, shapes);
    }
    let PhysicsWorld { world, maps, .. } = physics;
    let Some(record) = maps.shapes.get_mut(&entity) else { return Ok(()) };
    record.shapes.iter_mut().zip(shapes).try_for_each(|((id, is), said)| {
        change_shape(world, *id, is, said)?;
        is.clone_from(said);
        Ok(())
    })
}

/// A lone collider takes part unless it is disabled, and goes with what it is below.
fn place_lone(physics: &mut PhysicsWorld, scene: &Scene, entity: Entity) {
    let Some(id) = physics.lone(entity) else { return };
    let Some(mut body) = physics.world.body_mut(id) else { return };
    body.set_enabled(!scene.is_disabled(entity));
    let frame = scene.frame(entity).filter(|_| scene.is_below(entity));
    if let Some(frame) = frame.filter(|frame| body.pose() != frame.pose()) {
        body.set_pose(frame.pose());
    }
}

fn change_shape(
    world: &mut tiny_physics::World,
    id: ShapeId,
    is: &ShapeDef,
    said: &ShapeDef,
) -> Result<(), Error> {
    let Some(mut shape) = world.shape_mut(id) else { return Ok(()) };
    if is.shape != said.shape {
        shape.set_shape(said.shape)?;
    }
    if (is.offset, is.angle) != (said.offset, said.angle) {
        shape.set_local(said.offset, said.angle)?;
    }
    if is.material != said.material {
        shape.set_material(said.material)?;
    }
    if is.filter != said.filter {
        shape.set_filter(said.filter);
    }
    if is.sensor != said.sensor {
        shape.set_sensor(said.sensor);
    }
    if is.one_way != said.one_way {
        shape.set_one_way(said.one_way)?;
    }
    if (is.contact_events, is.hit_events) != (said.contact_events, said.hit_events) {
        shape.set_events(said.contact_events, said.hit_events);
    }
    if is.user_data != said.user_data {
        shape.set_user_data(said.user_data);
    }
    Ok(())
}
