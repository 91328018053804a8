//! What is taken off entities, or despawned, leaves the world.

use super::joints::{self, BrokenHere};
use super::scene::WithDisabled;
use crate::components::*;
use crate::world::{JointRecord, PhysicsWorld, Role};
use bevy_app::prelude::*;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::*;

/// Components are watched by observers: those of fixed schedules must not miss what happens in frames without a step.
pub(crate) fn watch(app: &mut App) {
    app.add_observer(joints::mended)
        .add_observer(gone::<RigidBody>)
        .add_observer(gone::<Collider>)
        .add_observer(gone::<Joint>)
        .add_observer(gone::<Character>)
        .add_observer(gone::<TileMap>)
        .add_observer(of_body::<GravityScale>)
        .add_observer(of_body::<Damping>)
        .add_observer(of_body::<LockedAxes>)
        .add_observer(of_body::<Mass>)
        .add_observer(of_body::<Enabled>)
        .add_observer(of_body::<CanSleep>)
        .add_observer(of_body::<Velocity>)
        .add_observer(of_collider::<Friction>)
        .add_observer(of_collider::<Restitution>)
        .add_observer(of_collider::<Density>)
        .add_observer(of_collider::<SurfaceSpeed>)
        .add_observer(of_collider::<CollisionFilter>)
        .add_observer(of_collider::<Sensor>)
        .add_observer(of_collider::<OneWay>)
        .add_observer(of_collider::<CollisionEvents>)
        .add_observer(of_collider::<HitEvents>)
        .add_observer(of_collider::<ChildOf>)
        .add_observer(taken_off)
        .add_observer(disabled)
        .add_observer(enabled);
}

fn gone<C: Component>(removed: On<Remove, C>, mut physics: ResMut<PhysicsWorld>) {
    physics.notes.gone.push(removed.entity);
}

fn of_body<C: Component>(removed: On<Remove, C>, mut physics: ResMut<PhysicsWorld>) {
    physics.notes.bodies.push(removed.entity);
}

fn of_collider<C: Component>(removed: On<Remove, C>, mut physics: ResMut<PhysicsWorld>) {
    physics.notes.colliders.push(removed.entity);
}

fn disabled(added: On<Add, Disabled>, mut physics: ResMut<PhysicsWorld>) {
    physics.notes.switch(added.entity);
}

fn enabled(removed: On<Remove, Disabled>, mut physics: ResMut<PhysicsWorld>) {
    physics.notes.switch(removed.entity);
}

/// A body that has lost its parent stays where it is, and so its transform says something else.
fn taken_off(removed: On<Remove, ChildOf>, mut physics: ResMut<PhysicsWorld>) {
    let record = physics.maps.bodies.get(&removed.entity);
    let body = record.filter(|record| record.role == Role::Body).map(|record| record.id);
    physics.notes.placed.extend(body);
}

/// Has a joint, or one broke there.
type HadJoint = (Or<(With<Joint>, With<BrokenHere>)>, WithDisabled);

/// Removes what nothing asks for any more. In a copy that has just come in everybody is looked at, and has again what broke since.
pub(crate) fn remove_gone(
    mut physics: ResMut<PhysicsWorld>,
    bodies: Query<(), (With<RigidBody>, WithDisabled)>,
    colliders: Query<(), (With<Collider>, WithDisabled)>,
    characters: Query<(), (With<Character>, WithDisabled)>,
    joints: Query<Has<Joint>, HadJoint>,
    tiles: Query<(), (With<TileMap>, WithDisabled)>,
    mut commands: Commands,
) {
    let physics = &mut *physics;
    for entity in physics.notes.taken_off() {
        physics.maps.refused.ask_again(entity);
    }
    let mut entities = core::mem::take(&mut physics.notes.gone);
    if physics.fresh {
        entities.extend(physics.maps.entities());
    }
    // The world's free lists remember the order of removals.
    entities.sort_by_key(|entity| physics.place(*entity));
    entities.dedup();
    for entity in entities {
        let role = physics.maps.bodies.get(&entity).map(|record| record.role);
        let stays = match role {
            Some(Role::Body) => bodies.contains(entity),
            Some(Role::Lone) => colliders.contains(entity),
            Some(Role::Character) => characters.contains(entity),
            None => true,
        };
        if !stays {
            physics.remove_body(entity);
        }
        if !colliders.contains(entity) {
            physics.remove_shapes(entity);
        }
        match (joints.get(entity), physics.maps.joints.get(&entity)) {
            (Ok(true), _) => {}
            (Ok(false), Some(JointRecord { bodies: (a, b), def, .. })) => {
                commands.entity(entity).insert(Joint::new(*a, *b, *def));
            }
            _ => physics.remove_joint(entity),
        }
        if !tiles.contains(entity) {
            physics.remove_tiles(entity);
        }
    }
}
