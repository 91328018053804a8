//! Joints.

use super::problems::Problems;
use crate::components::Joint;
use crate::messages::JointBroke;
use crate::order;
use crate::world::{JointRecord, PhysicsWorld};
use bevy_ecs::prelude::*;
use tiny_physics::{BodyId, Error, JointDef};

/// Adds joints that are new or whose bodies have come, and changes others to what they say.
pub(crate) fn read(
    mut physics: ResMut<PhysicsWorld>,
    changed: Query<(Entity, &Joint), Changed<Joint>>,
    all: Query<(Entity, &Joint)>,
    mut problems: Problems,
) {
    let physics = &mut *physics;
    let waiting = core::mem::take(&mut physics.maps.waiting);
    let mut asked: Vec<_> = waiting.iter().filter_map(|entity| all.get(*entity).ok()).collect();
    asked.extend(&changed);
    if physics.fresh {
        asked.extend(&all);
    }
    asked.sort_unstable_by_key(|(entity, _)| *entity);
    asked.dedup_by_key(|(entity, _)| *entity);
    let mut new = Vec::new();
    for (entity, joint) in asked {
        let bodies = physics.body_id(joint.a).zip(physics.body_id(joint.b));
        let record =
            physics.maps.joints.get(&entity).map(|record| record.bodies == (joint.a, joint.b));
        match (bodies, record) {
            (Some(_), Some(true)) => {
                let result = change(physics, entity, joint);
                problems.check(entity, "joint", result);
            }
            (Some(bodies), _) => new.push((bodies, entity, joint)),
            (None, _) => {
                physics.remove_joint(entity);
                if !waiting.contains(&entity) {
                    problems.report(entity, "joint", missing(physics, joint));
                }
                physics.maps.waiting.insert(entity);
            }
        }
    }
    new.sort_by_cached_key(|(bodies, _, joint)| (*bodies, order::text(&joint.def)));
    for (bodies, entity, joint) in new {
        let result = add(physics, entity, bodies, joint);
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
) -> Result<(), Error> {
    let id = physics.world.add_joint(a, b, joint.def)?;
    physics.remove_joint(entity);
    physics.enter_joint(entity, JointRecord { id, bodies: (joint.a, joint.b), def: joint.def });
    Ok(())
}

fn change(physics: &mut PhysicsWorld, entity: Entity, joint: &Joint) -> Result<(), Error> {
    let PhysicsWorld { world, maps, .. } = physics;
    match maps.joints.get_mut(&entity) {
        Some(record) if record.def != joint.def => {
            let now = world.joint(record.id).map(|now| *now.def());
            world.set_joint(record.id, kept_anchors(&joint.def, &record.def, now))?;
            record.def = joint.def;
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
    joints: Query<(), With<Joint>>,
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
