//! Joints.

use super::problems::Problems;
use super::scene::WithDisabled;
use crate::components::Joint;
use crate::messages::JointBroke;
use crate::order;
use crate::world::{JointRecord, PhysicsWorld};
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::*;
use tiny_physics::{BodyId, Error, JointDef};

/// Adds joints that are new or whose bodies have come, and changes others to what they say.
pub(crate) fn read(
    mut physics: ResMut<PhysicsWorld>,
    changed: Query<Entity, (Changed<Joint>, WithDisabled)>,
    all: Query<(Entity, &Joint, Has<Disabled>)>,
    mut problems: Problems,
) {
    let physics = &mut *physics;
    let waiting = core::mem::take(&mut physics.maps.waiting);
    let switched = core::mem::take(&mut physics.notes.switched);
    let told = waiting.iter().copied().chain(switched).chain(&changed);
    let mut asked: Vec<_> = told.filter_map(|entity| all.get(entity).ok()).collect();
    if physics.fresh {
        asked.extend(&all);
    }
    asked.sort_unstable_by_key(|(entity, ..)| *entity);
    asked.dedup_by_key(|(entity, ..)| *entity);
    let mut new = Vec::new();
    for (entity, joint, is_disabled) in asked {
        let bodies = physics.body_id(joint.a).zip(physics.body_id(joint.b));
        let record =
            physics.maps.joints.get(&entity).map(|record| record.bodies == (joint.a, joint.b));
        match (bodies, record) {
            (Some(_), Some(true)) => {
                let result = change(physics, entity, joint, is_disabled);
                problems.check(entity, "joint", result);
            }
            (Some(bodies), _) => new.push((bodies, entity, joint, is_disabled)),
            (None, _) => {
                physics.remove_joint(entity);
                if !waiting.contains(&entity) {
                    problems.report(entity, "joint", missing(physics, joint));
                }
                physics.maps.waiting.insert(entity);
            }
        }
    }
    new.sort_by_cached_key(|(bodies, _, joint, is_disabled)| {
        (*bodies, order::text(&joint.def), *is_disabled)
    });
    for (bodies, entity, joint, is_disabled) in new {
        let result = add(physics, entity, bodies, joint, is_disabled);
        problems.check(entity, "joint", result);
    }
}

fn missing(physics: &PhysicsWorld, joint: &Joint) -> Error {
    let entity = if physics.body_id(joint.a).is_none() { joint.a } else { joint.b };
    Error::StaleHandle { handle: format!("the joint waits: the body of entity {entity}") }
}

fn add(
    physics: &mut PhysicsWorld,
    entity: Entity,
    (a, b): (BodyId, BodyId),
    joint: &Joint,
    is_disabled: bool,
) -> Result<(), Error> {
    let id = physics.world.add_joint(a, b, switched(joint.def, is_disabled))?;
    physics.remove_joint(entity);
    let (bodies, def) = ((joint.a, joint.b), joint.def);
    physics.enter_joint(entity, JointRecord { id, bodies, def, is_disabled });
    Ok(())
}

/// What a joint is that its entity may switch off.
fn switched(said: JointDef, is_disabled: bool) -> JointDef {
    JointDef { enabled: said.enabled && !is_disabled, ..said }
}

fn change(
    physics: &mut PhysicsWorld,
    entity: Entity,
    joint: &Joint,
    is_disabled: bool,
) -> Result<(), Error> {
    let PhysicsWorld { world, maps, .. } = physics;
    match maps.joints.get_mut(&entity) {
        Some(record) if (record.def, record.is_disabled) != (joint.def, is_disabled) => {
            let now = world.joint(record.id).map(|now| *now.def());
            let def = kept_anchors(&joint.def, &record.def, now);
            world.set_joint(record.id, switched(def, is_disabled))?;
            (record.def, record.is_disabled) = (joint.def, is_disabled);
            Ok(())
        }
        _ => Ok(()),
    }
}

/// A new description with the anchors and angles that the joint has, where it names the same points of the world as before: those
/// are where the bodies were joined, not where they are by now.
fn kept_anchors(said: &JointDef, before: &JointDef, now: Option<JointDef>) -> JointDef {
    match now {
        Some(now) if said.anchors_at.is_some() && said.anchors_at == before.anchors_at => {
            JointDef {
                anchors_at: None,
                anchor_a: now.anchor_a,
                anchor_b: now.anchor_b,
                angle_a: now.angle_a + (said.angle_a - before.angle_a),
                angle_b: now.angle_b + (said.angle_b - before.angle_b),
                ..*said
            }
        }
        _ => *said,
    }
}

/// Is on an entity whose joint broke, until it gets another: a copy from before that has it again.
#[derive(Component)]
pub(crate) struct BrokenHere;

/// A joint that broke is no longer on its entity.
pub(crate) fn take_off_broken(
    mut physics: ResMut<PhysicsWorld>,
    mut broken: MessageReader<JointBroke>,
    joints: Query<(), (With<Joint>, WithDisabled)>,
    mut commands: Commands,
) {
    for joint in broken.read() {
        physics.remove_joint(joint.joint);
        if joints.contains(joint.joint) {
            commands.entity(joint.joint).try_remove::<Joint>().try_insert(BrokenHere);
        }
    }
}

/// What has a joint anew has none that broke.
pub(crate) fn mended(joined: On<Insert, Joint>, mut commands: Commands) {
    commands.entity(joined.entity).try_remove::<BrokenHere>();
}
