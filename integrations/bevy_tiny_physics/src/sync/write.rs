//! Components follow the world: transforms and velocities.

use super::scene::WithDisabled;
use crate::components::{RigidBody, Velocity};
use crate::frame::{Frame, Parts, frame_through};
use crate::world::{BodyRecord, PhysicsWorld, Role, Written};
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;
use bevy_math::Vec2;
use bevy_time::{Fixed, Time};
use bevy_transform::prelude::Transform;
use tiny_physics::{Body, BodyId, CharacterMover, DVec2, Pose};

/// Whose places are written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Which {
    All,
    /// But for what somebody else has moved since: place, turn or both.
    Untouched,
}

/// Writes places to transforms, through parents.
#[derive(SystemParam)]
pub(crate) struct Places<'w, 's> {
    transforms: Query<'w, 's, &'static mut Transform, WithDisabled>,
    parents: Query<'w, 's, &'static ChildOf, WithDisabled>,
    nested: Query<'w, 's, Entity, (With<RigidBody>, With<ChildOf>, WithDisabled)>,
    disabled: Query<'w, 's, (), With<Disabled>>,
}

impl Places<'_, '_> {
    /// Writes where bodies are. What lies below others follows when these have their places.
    pub fn write(
        &mut self,
        physics: &mut PhysicsWorld,
        bodies: impl Iterator<Item = BodyId>,
        which: Which,
        pose: impl Fn(Body<'_>) -> Pose,
    ) {
        let PhysicsWorld { world, maps, .. } = physics;
        for id in bodies {
            let Some(entity) = maps.body_entities.get(id.to_bits()) else { continue };
            let Some(record) = maps.bodies.get_mut(&entity).filter(|record| record.id == id) else {
                continue;
            };
            let asked = record.role != Role::Character && !self.parents.contains(entity);
            if let Some(body) = world.body(id).filter(|_| asked) {
                self.place(which, entity, record, Frame::of_pose(pose(body)));
            }
        }
        let mut nested: Vec<Entity> = self.nested.iter().collect();
        nested.sort_by_cached_key(|entity| self.parents.iter_ancestors(*entity).count());
        for entity in nested {
            let Some(record) = maps.bodies.get_mut(&entity) else { continue };
            if let Some(body) = world.body(record.id) {
                self.place(which, entity, record, Frame::of_pose(pose(body)));
            }
        }
    }

    /// Writes where characters are; how they are turned is theirs.
    pub fn write_characters(
        &mut self,
        physics: &mut PhysicsWorld,
        which: Which,
        position: impl Fn(&CharacterMover) -> DVec2,
    ) {
        let maps = &mut physics.maps;
        for (entity, mover) in &maps.characters {
            let Some(record) = maps.bodies.get_mut(entity) else { continue };
            // One that is disabled has not moved in the last step.
            let is_disabled = self.disabled.contains(*entity);
            let p = if is_disabled { mover.position } else { position(mover) };
            let frame = Frame { p: p.to_vec2(), ..Frame::IDENTITY };
            self.place(which, *entity, record, frame);
        }
    }

    fn place(&mut self, which: Which, entity: Entity, record: &mut BodyRecord, frame: Frame) {
        let parts = self.ours(which, entity, record);
        if parts == Parts::NONE {
            return;
        }
        let local = match self.parents.get(entity) {
            Err(_) => frame,
            Ok(above) => {
                let outer = frame_through(
                    above.parent(),
                    self.parents.iter_ancestors(above.parent()),
                    |entity| self.transforms.get(entity).ok(),
                );
                outer.map_or(frame, |outer| outer.relative(&frame))
            }
        };
        let Ok(mut transform) = self.transforms.get_mut(entity) else { return };
        let mut wanted = *transform;
        local.write(&mut wanted, parts);
        if *transform != wanted {
            *transform = wanted;
        }
        let (now, before) = (Written::of(&wanted), record.written);
        record.written = Some(before.map_or(now, |before| before.with(parts, &now)));
    }

    /// What of a transform is to be written. If only ours is, it stands as we left it.
    fn ours(&self, which: Which, entity: Entity, record: &BodyRecord) -> Parts {
        let turns = record.role != Role::Character;
        if which == Which::All {
            return Parts { place: true, turn: turns };
        }
        let here = self.transforms.get(entity).map(Written::of);
        record.written.zip(here.ok()).map_or(Parts::NONE, |(written, here)| {
            let moved = written.moved(&here, record.role);
            Parts { place: !moved.place, turn: turns && !moved.turn }
        })
    }
}

/// Writes what the step moved, and what was placed since the one before.
pub(crate) fn transforms(mut physics: ResMut<PhysicsWorld>, mut places: Places) {
    let placed = core::mem::take(&mut physics.notes.placed);
    let moved = physics.world.moved_bodies().to_vec();
    places.write(&mut physics, moved.into_iter().chain(placed), Which::All, |body| body.pose());
}

/// Writes velocities.
pub(crate) fn velocities(
    mut physics: ResMut<PhysicsWorld>,
    mut velocities: Query<(Entity, &mut Velocity), WithDisabled>,
) {
    let PhysicsWorld { world, maps, .. } = &mut *physics;
    for (entity, mut velocity) in &mut velocities {
        let Some(record) = maps.bodies.get_mut(&entity) else { continue };
        let Some(body) = world.body(record.id) else { continue };
        let linear = Vec2::new(body.velocity().x, body.velocity().y);
        let now = Velocity { linear, angular: body.angular_velocity() };
        record.told = Some(now);
        velocity.set_if_neq(now);
    }
}

/// Is in the app where bodies are shown between steps.
#[derive(Resource, Default)]
pub(crate) struct Interpolated;

/// Shows bodies between the last two steps, where the clock stands.
pub(crate) fn interpolate(
    mut physics: ResMut<PhysicsWorld>,
    clock: Option<Res<Time<Fixed>>>,
    mut places: Places,
) {
    let alpha = clock.map_or(1.0, |clock| clock.overstep_fraction());
    write_untouched(&mut physics, &mut places, alpha);
}

/// Puts bodies where they are before a step, so that the game's own systems see them there.
pub(crate) fn exact_places(mut physics: ResMut<PhysicsWorld>, mut places: Places) {
    write_untouched(&mut physics, &mut places, 1.0);
}

/// Writes what moved in the last step, but for what somebody else has moved since.
fn write_untouched(physics: &mut PhysicsWorld, places: &mut Places, alpha: f32) {
    if physics.fresh {
        return;
    }
    let moved = physics.world.moved_bodies().to_vec();
    places
        .write(physics, moved.into_iter(), Which::Untouched, |body| body.interpolated_pose(alpha));
    places.write_characters(physics, Which::Untouched, |mover| mover.interpolated_position(alpha));
}
