//! What is saved and loaded goes on as if nothing had been.

use crate::lab::Lab;
use crate::report::Measure;
use crate::scenery::{disk, rect};
use crate::target::Target;
use tiny_physics::{JointDef, JointId, RigidBody, Vec2, World};

/// Worlds with every kind of joint, saved and loaded on the way: which are refused or go on otherwise?
pub(super) fn with_joints(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (apart, steps) = lab.pick((1.0, 30), (0.6, 47));
    let kinds = joints(apart);
    let count = kinds.len();
    let wrong = kinds.into_iter().filter(|def| !survives(*def, apart, steps)).count();
    vec![Measure::new(
        format!("kinds of joints that do not survive a frame, of {count}"),
        wrong as f64,
        "",
        Target::AtMost(0.0),
    )]
}

/// One of every kind, and with springs, limits and motors.
fn joints(apart: f32) -> Vec<JointDef> {
    let up = Vec2::new(0.0, 1.0);
    vec![
        JointDef::distance(apart),
        JointDef::rope(apart),
        JointDef::distance(apart).spring(3.0, 0.2),
        JointDef::revolute(),
        JointDef::revolute().limits(-0.3, 0.3).motor(2.0, 5.0),
        JointDef::revolute().spring(2.0, 0.5),
        JointDef::prismatic(up),
        JointDef::prismatic(up).limits(-0.2, 0.2).motor(1.0, 20.0),
        JointDef::weld(),
        JointDef::weld().spring(4.0, 0.3),
        JointDef::wheel(up).spring(4.0, 0.7).motor(10.0, 3.0),
        JointDef::friction(5.0, 1.0),
        JointDef::mouse(Vec2::new(2.0, 3.0), 500.0),
        JointDef::filter(),
        JointDef::pulley(Vec2::new(0.0, 5.0), Vec2::new(apart, 5.0), 9.0),
        JointDef::gear(0.5),
    ]
}

/// Does a world with such joints, saved and loaded, come to the same state as one that was not?
fn survives(def: JointDef, apart: f32, steps: u32) -> bool {
    let Ok(mut world) = world_of(def, apart) else { return false };
    (0..steps).for_each(|_| world.step(1.0 / 60.0));
    let Ok(mut loaded) = World::from_bytes(&world.to_bytes()) else { return false };
    let same = (0..steps).all(|_| {
        world.step(1.0 / 60.0);
        loaded.step(1.0 / 60.0);
        world.state_hash() == loaded.state_hash()
    });
    same && loaded.to_bytes() == world.to_bytes()
}

/// A floor, two bodies on a joint, and a third that lies below.
fn world_of(def: JointDef, apart: f32) -> Result<World, tiny_physics::Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    world.add_body(RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(rect(20.0, 1.0)))?;
    world.add_body(RigidBody::dynamic().position(Vec2::new(0.2, 0.5)).shape(rect(0.5, 0.5)))?;
    let a = world.add_body(RigidBody::dynamic().position(Vec2::new(0.0, 2.0)).shape(disk(0.3)))?;
    let b = RigidBody::dynamic().position(Vec2::new(apart, 2.0)).shape(rect(0.2, 0.3));
    let b = world.add_body(b)?;
    let _: JointId = world.add_joint(a, b, def)?;
    Ok(world)
}
