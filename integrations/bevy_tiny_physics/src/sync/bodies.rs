//! Bodies: new ones, and what components say of those that are there.

use super::problems::Problems;
use super::scene::{Moved, Scene, WithDisabled};
use crate::components::*;
use crate::frame::{Frame, Parts};
use crate::order;
use crate::world::{BodyRecord, PhysicsWorld, Role, Said, ShapesRecord, Written};
use bevy_ecs::prelude::*;
use bevy_transform::prelude::Transform;
use tiny_physics::{Error, ShapeDef};

/// A body that is new, with the colliders that its shapes come from.
struct New {
    entity: Entity,
    key: (u64, tiny_physics::RigidBody),
    colliders: Vec<(Entity, Vec<ShapeDef>)>,
}

/// Adds bodies for entities that have become some, or were refused and have changed since, with all their shapes, in an order that depends on nothing but what they are.
pub(crate) fn add(
    mut physics: ResMut<PhysicsWorld>,
    scene: Scene,
    changed: Query<Entity, (Changed<RigidBody>, WithDisabled)>,
    mended: Query<(), Mended>,
    moved: Moved,
    all: Query<Entity, (With<RigidBody>, WithDisabled)>,
    mut problems: Problems,
) {
    let physics = &mut *physics;
    let mended = |entity| mended.contains(entity) || moved.contains(entity);
    let again = physics.maps.refused.asked_again(Role::Body, |entity| all.contains(entity), mended);
    let again = again.into_iter().filter(|entity| !changed.contains(*entity));
    let asked: Vec<Entity> =
        if physics.fresh { all.iter().collect() } else { changed.iter().chain(again).collect() };
    let mut new = Vec::new();
    for entity in asked {
        match physics.maps.bodies.get_mut(&entity).map(|record| &mut record.role) {
            Some(Role::Character) => problems.refuse(physics, entity, Role::Body, BOTH),
            Some(role) => {
                *role = Role::Body;
                scene.colliders_below(entity, &mut physics.notes.colliders);
            }
            None => new.extend(describe(&scene, entity)),
        }
    }
    new.sort_by(|a, b| order::of_bodies(&a.key, &b.key));
    for body in new {
        add_one(physics, &scene, body, &mut problems);
    }
}

const BOTH: Error = Error::Unsupported { reason: "an entity is a body or a character, not both" };

/// A body with the colliders below it, in the order of what they are. What is wrong with one is told when it is read for itself.
fn describe(scene: &Scene, entity: Entity) -> Option<New> {
    let mut body = scene.body(entity)?;
    let mut below = Vec::new();
    scene.colliders_below(entity, &mut below);
    let mut colliders = Vec::new();
    for collider in below {
        let shapes = scene.shapes(collider, Some(entity));
        colliders.extend(shapes.ok().map(|shapes| (collider, shapes)));
    }
    colliders.sort_by_cached_key(|(_, shapes)| order::text(shapes));
    body.shapes = colliders.iter().flat_map(|(_, shapes)| shapes.iter().cloned()).collect();
    Some(New { entity, key: (scene.order(entity), body), colliders })
}

fn add_one(physics: &mut PhysicsWorld, scene: &Scene, new: New, problems: &mut Problems) {
    let New { entity, key: (_, mut body), colliders } = new;
    for (collider, _) in &colliders {
        physics.leave(*collider);
    }
    let said = Said::of(&body);
    let shapes = core::mem::take(&mut body.shapes);
    let whole = tiny_physics::RigidBody { shapes, ..body.clone() };
    // Where one shape is bad the others are added one by one, when colliders are read.
    let id = match physics.world.add_body(whole) {
        Ok(id) => {
            let mut ids = physics
                .world
                .body(id)
                .into_iter()
                .flat_map(|body| body.shapes())
                .collect::<Vec<_>>()
                .into_iter();
            for (collider, shapes) in colliders {
                let shapes = ids.by_ref().zip(shapes).collect();
                physics.enter_shapes(collider, ShapesRecord { body: id, shapes });
            }
            id
        }
        Err(_) => {
            let id = match physics.world.add_body(body) {
                Ok(id) => id,
                Err(error) => return problems.refuse(physics, entity, Role::Body, error),
            };
            physics.notes.colliders.extend(colliders.iter().map(|(collider, _)| *collider));
            id
        }
    };
    let written = scene.transform(entity).map(Written::of);
    let (role, said) = (Role::Body, Some(said));
    physics.enter_body(entity, BodyRecord { id, role, written, told: None, said });
}

/// Bodies of which some component changed.
type BodyChange = Or<(
    Changed<RigidBody>,
    Changed<GravityScale>,
    Changed<Damping>,
    Changed<LockedAxes>,
    Changed<Mass>,
    Changed<Enabled>,
    Changed<CanSleep>,
)>;

/// Bodies that may be what was refused before.
type Mended = (Or<(BodyChange, Changed<Velocity>)>, WithDisabled);

/// Tells bodies what their components say, where that is something else. In a copy that has just come in: than it was when that was made.
pub(crate) fn read(
    mut physics: ResMut<PhysicsWorld>,
    scene: Scene,
    changed: Query<Entity, (BodyChange, WithDisabled)>,
    all: Query<Entity, (With<RigidBody>, WithDisabled)>,
    moved: Query<(Entity, &Transform), (Changed<Transform>, WithDisabled)>,
    velocities: Query<(Entity, Ref<Velocity>), (Changed<Velocity>, WithDisabled)>,
    mut problems: Problems,
) {
    let physics = &mut *physics;
    let mut told = core::mem::take(&mut physics.notes.bodies);
    told.extend(&changed);
    if physics.fresh {
        told.extend(all.iter().filter(|entity| says_else(physics, &scene, *entity)));
    }
    for entity in told {
        let result = tell(physics, &scene, entity);
        problems.check(entity, "body", result);
    }
    for (entity, transform) in &moved {
        let result = teleport(physics, &scene, entity, transform);
        problems.check(entity, "transform", result);
    }
    for (entity, velocity) in &velocities {
        let result = drive(physics, entity, &velocity);
        problems.check(entity, "velocity", result);
    }
}

/// Do components say something else than the body was told?
fn says_else(physics: &PhysicsWorld, scene: &Scene, entity: Entity) -> bool {
    let told = physics.maps.bodies.get(&entity).and_then(|record| record.said);
    told != scene.body(entity).map(|body| Said::of(&body))
}

fn tell(physics: &mut PhysicsWorld, scene: &Scene, entity: Entity) -> Result<(), Error> {
    let Some(said) = scene.body(entity) else { return Ok(()) };
    if let Some(record) = physics.maps.bodies.get_mut(&entity) {
        record.said = Some(Said::of(&said));
    }
    let Some(mut body) = physics.own_body_mut(entity) else { return Ok(()) };
    let is = body.as_ref().describe();
    if said.kind != is.kind {
        body.set_kind(said.kind);
    }
    if said.gravity_scale != is.gravity_scale {
        finite("gravity_scale", said.gravity_scale)?;
        body.set_gravity_scale(said.gravity_scale);
    }
    if (said.linear_damping, said.angular_damping) != (is.linear_damping, is.angular_damping) {
        finite("damping", said.linear_damping + said.angular_damping)?;
        body.set_damping(said.linear_damping, said.angular_damping);
    }
    if said.locks != is.locks {
        body.set_locks(said.locks);
    }
    if said.enabled != is.enabled {
        body.set_enabled(said.enabled);
    }
    if said.can_sleep != is.can_sleep {
        body.set_can_sleep(said.can_sleep);
    }
    if said.mass != is.mass { body.set_mass(said.mass) } else { Ok(()) }
}

/// Puts a body where its transform is, if somebody else than us moved that. What stands as we left it, place or turn, may be that of a
/// frame between two steps: there the body keeps its own.
fn teleport(
    physics: &mut PhysicsWorld,
    scene: &Scene,
    entity: Entity,
    transform: &Transform,
) -> Result<(), Error> {
    let Some(record) = physics.maps.bodies.get_mut(&entity) else { return Ok(()) };
    let (id, role, now) = (record.id, record.role, Written::of(transform));
    let before = record.written.replace(now);
    if before == Some(now) {
        return Ok(());
    }
    if !before.is_some_and(|before| before.is_scaled_like(&now)) {
        scene.colliders_below(entity, &mut physics.notes.colliders);
    }
    let moved = before.map_or(Parts::ALL, |before| before.moved(&now, role));
    if moved == Parts::NONE {
        return Ok(());
    }
    let Some(frame) = scene.frame(entity) else { return Ok(()) };
    check_frame(&frame)?;
    if role == Role::Character {
        let Some(mover) = physics.maps.characters.get_mut(&entity) else { return Ok(()) };
        mover.position = frame.p.into();
        mover.lead_body(&mut physics.world);
    } else if let Some(mut body) = physics.world.body_mut(id) {
        let pose = moved.of(frame.pose(), body.pose());
        body.set_pose(pose);
    }
    Ok(())
}

/// Sets a body's velocity, if somebody else than us said one. What pushed the body since stays where nobody did.
fn drive(
    physics: &mut PhysicsWorld,
    entity: Entity,
    velocity: &Ref<Velocity>,
) -> Result<(), Error> {
    let Some(record) = physics.maps.bodies.get_mut(&entity) else { return Ok(()) };
    if record.told.replace(**velocity) == Some(**velocity) && !velocity.is_added() {
        return Ok(());
    }
    let Some(mut body) = physics.own_body_mut(entity) else { return Ok(()) };
    let linear = engine(velocity.linear);
    finite("velocity", linear.x + linear.y)?;
    finite("angular velocity", velocity.angular)?;
    if body.velocity() != linear {
        body.set_velocity(linear);
    }
    if body.angular_velocity() != velocity.angular {
        body.set_angular_velocity(velocity.angular);
    }
    Ok(())
}

pub(crate) fn finite(name: &'static str, value: f32) -> Result<(), Error> {
    if value.is_finite() { Ok(()) } else { Err(Error::NotFinite { name, value: value.into() }) }
}

pub(crate) fn check_frame(frame: &Frame) -> Result<(), Error> {
    let sum = frame.p.x + frame.p.y + frame.q.c + frame.q.s;
    if frame.is_finite() {
        Ok(())
    } else {
        Err(Error::NotFinite { name: "transform", value: sum.into() })
    }
}
