//! Characters: movers that lie in the world, so that they go back with it.

use super::problems::Problems;
use super::scene::{Moved, Scene, WithDisabled};
use super::step::Clock;
use super::write::{Places, Which};
use crate::components::*;
use crate::order;
use crate::world::{BodyRecord, PhysicsWorld, Role, Written};
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::*;
use bevy_math::Vec2;
use tiny_physics::{BodyId, CharacterMover, Error, MoverInput};

/// Adds movers for new characters, and for those that were refused and have changed since, and makes those that are there what they ought to be.
pub(crate) fn add(
    mut physics: ResMut<PhysicsWorld>,
    scene: Scene,
    changed: Query<(Entity, &Character), (Changed<Character>, WithDisabled)>,
    all: Query<(Entity, &Character), WithDisabled>,
    moved: Moved,
    mut problems: Problems,
) {
    let physics = &mut *physics;
    let again = physics.maps.refused.asked_again(
        Role::Character,
        |entity| all.contains(entity),
        |entity| moved.contains(entity),
    );
    let switched = physics.notes.switched.iter().copied();
    let switched = switched.filter(|entity| physics.maps.characters.contains_key(entity));
    let again = again.into_iter().chain(switched).filter(|entity| !changed.contains(*entity));
    let again = again.filter_map(|entity| all.get(entity).ok());
    let asked: Vec<_> =
        if physics.fresh { all.iter().collect() } else { changed.iter().chain(again).collect() };
    let mut new = Vec::new();
    for (entity, character) in asked {
        if physics.maps.characters.contains_key(&entity) {
            switch(physics, entity, !scene.is_disabled(entity));
            let result = change(physics, entity, character);
            problems.check(entity, "character", result);
        } else if scene.is_body(entity) || scene.is_collider(entity) {
            problems.refuse(physics, entity, Role::Character, BOTH);
        } else if let Some(frame) = scene.frame(entity) {
            let mut mover = CharacterMover::new(frame.p, character.height, character.radius);
            character.apply(&mut mover);
            let enabled = !scene.is_disabled(entity);
            let body = tiny_physics::RigidBody { enabled, ..mover.describe_body() };
            new.push((entity, (scene.order(entity), body), mover));
        }
    }
    new.sort_by(|a, b| {
        order::of_bodies(&a.1, &b.1).then_with(|| order::text(&a.2).cmp(&order::text(&b.2)))
    });
    for (entity, (_, body), mut mover) in new {
        let id = match physics.world.add_body(body) {
            Ok(id) => id,
            Err(error) => {
                problems.refuse(physics, entity, Role::Character, error);
                continue;
            }
        };
        mover.body = Some(id);
        let written = scene.transform(entity).map(Written::of);
        physics.maps.characters.insert(entity, mover);
        let role = Role::Character;
        physics.enter_body(entity, BodyRecord { id, role, written, told: None, said: None });
    }
}

const BOTH: Error = Error::Unsupported {
    reason: "a character has a form of its own; put colliders and bodies on other entities",
};

/// What a character is seen by is there while the character takes part.
fn switch(physics: &mut PhysicsWorld, entity: Entity, enabled: bool) {
    if let Some(mut body) = physics.own_body_mut(entity) {
        body.set_enabled(enabled);
    }
}

fn change(physics: &mut PhysicsWorld, entity: Entity, said: &Character) -> Result<(), Error> {
    let PhysicsWorld { world, maps, .. } = physics;
    let Some(mover) = maps.characters.get_mut(&entity) else { return Ok(()) };
    said.apply(mover);
    let same = (mover.height, mover.radius) == (said.height, said.radius);
    if same || mover.resize(world, said.height, said.radius) {
        mover.lead_body(world);
        return Ok(());
    }
    Err(Error::Unsupported {
        reason: "there is no room for a character of that size, or it is no size",
    })
}

/// Characters in the order of their bodies, which does not depend on entities.
fn in_order(physics: &PhysicsWorld) -> Vec<(BodyId, Entity)> {
    let mut order: Vec<_> = physics
        .maps
        .characters
        .iter()
        .filter_map(|(entity, mover)| mover.body.map(|body| (body, *entity)))
        .collect();
    order.sort_unstable();
    order
}

/// Moves every character on by a step, but for those that are disabled.
pub(crate) fn walk(
    mut physics: ResMut<PhysicsWorld>,
    clock: Clock,
    mut inputs: Query<&mut CharacterInput>,
    disabled: Query<(), With<Disabled>>,
) {
    if !physics.stepped {
        return;
    }
    let physics = &mut *physics;
    for (_, entity) in in_order(physics).into_iter().filter(|(_, who)| !disabled.contains(*who)) {
        let Some(mover) = physics.maps.characters.get_mut(&entity) else { continue };
        let mut asked = MoverInput::default();
        if let Ok(mut input) = inputs.get_mut(entity) {
            asked = MoverInput { walk: input.walk, jump: input.jump, drop: input.drop };
            if input.jump != 0.0 || input.drop {
                (input.jump, input.drop) = (0.0, false);
            }
        }
        mover.update(&mut physics.world, asked, clock.seconds());
    }
}

/// Writes places and states of characters to their entities.
pub(crate) fn tell(
    mut physics: ResMut<PhysicsWorld>,
    mut states: Query<&mut CharacterState, WithDisabled>,
    mut places: Places,
) {
    let physics = &mut *physics;
    places.write_characters(physics, Which::All, |mover| mover.position);
    for (entity, mover) in &physics.maps.characters {
        let Ok(mut state) = states.get_mut(*entity) else { continue };
        let ground = mover.ground();
        state.set_if_neq(CharacterState {
            grounded: ground.is_some(),
            ground: ground.and_then(|ground| physics.collider_entity(ground.shape)),
            normal: ground.map_or(Vec2::ZERO, |ground| Vec2::new(ground.normal.x, ground.normal.y)),
            velocity: Vec2::new(mover.velocity.x, mover.velocity.y),
        });
    }
}
