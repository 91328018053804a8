//! What is saved and loaded goes on as if nothing had been.

use super::common::none;
use crate::lab::Lab;
use crate::report::Measure;
use crate::scenery::{disk, rect};
use tiny_physics::{
    BodyId, BodyKind, BodyMut, Error, JointDef, JointId, RigidBody, SimdLevel, Vec2, World,
};
use tiny_physics_scenes::{Options, Random, Run, find};

/// Worlds with every kind of joint, saved and loaded on the way: which are refused or go on otherwise?
pub(super) fn with_joints(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (apart, steps) = lab.pick((1.0, 30), (0.6, 47));
    let kinds = joints(apart);
    let count = kinds.len();
    let wrong = kinds.into_iter().filter(|def| !survives(*def, apart, steps)).count();
    vec![none(format!("kinds of joints that do not survive a frame, of {count}"), wrong)]
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

/// Worlds that blow up, at several SIMD levels: how many end with other bits?
pub(super) fn blown_up(lab: &mut Lab<'_>) -> Vec<Measure> {
    let seeds = lab.pick(0..6, 6..12);
    let differ = seeds.filter(|&seed| {
        let plain = blow_up(seed, SimdLevel::Scalar);
        plain.is_err() || blow_up(seed, SimdLevel::detect()) != plain
    });
    vec![none("worlds that differ between SIMD levels, of 6".into(), differ.count())]
}

/// Hash of a world of bodies with absurd masses, speeds and joints after some steps.
fn blow_up(seed: u64, level: SimdLevel) -> Result<u64, Error> {
    let mut random = Random::new(seed);
    let mut world = World::new(Vec2::new(0.0, -10.0));
    world.set_simd(level)?;
    world.add_body(RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(rect(20.0, 1.0)))?;
    let mut bodies = Vec::new();
    for i in 0..40 {
        let place = Vec2::new(random.range(-5.0, 5.0), random.range(0.0, 6.0));
        let shape = if i % 2 == 0 { rect(0.5, 0.3) } else { disk(0.4) };
        let body = RigidBody::dynamic().position(place).shape(shape);
        let body = body.mass(10.0_f32.powf(random.range(-8.9, 11.9)));
        let velocity = Vec2::new(random.range(-1e18, 1e18), random.range(-1e18, 1e18));
        let id = world.add_body(if i % 5 == 0 { body.velocity(velocity) } else { body })?;
        if let (Some(&other), 0) = (bodies.last(), i % 3) {
            let anchor = Vec2::new(random.range(-9.0, 9.0), 0.0);
            world.add_joint(
                other,
                id,
                JointDef::revolute().anchors(anchor, Vec2::ZERO).motor(1e9, 1e30),
            )?;
        }
        bodies.push(id);
    }
    for step in 0..120 {
        world.step(1.0 / 60.0);
        if let Some(mut body) = world.body_mut(bodies[step % 40]) {
            body.apply_force_to_center(Vec2::new(3e38, 3e38));
            body.apply_torque(3e38);
        }
    }
    Ok(world.state_hash())
}

/// Worlds that were changed and changed back: two of one hash must go on alike.
pub(super) fn hashes_tell_all(lab: &mut Lab<'_>) -> Vec<Measure> {
    let steps = lab.pick([1, 7, 40, 90], [2, 11, 55, 120]);
    let (mut parted, mut count) = (0, 0);
    for steps in steps {
        for change in 0..6 {
            count += 1;
            parted += usize::from(parts(steps, change).unwrap_or(true));
        }
    }
    vec![none(format!("pairs of one hash that part, of {count}"), parted)]
}

/// Do two worlds part, one of which was changed and changed back, though they have one hash?
fn parts(steps: u32, change: u32) -> Result<bool, Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let floor = RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(rect(20.0, 1.0));
    world.add_body(floor)?;
    let mut bodies = Vec::new();
    for i in 0..12 {
        let place = Vec2::new(0.7 * (i % 4) as f32, 0.5 + 1.05 * (i / 4) as f32);
        bodies.push(world.add_body(RigidBody::dynamic().position(place).shape(rect(0.4, 0.5)))?);
    }
    (0..steps).for_each(|_| world.step(1.0 / 60.0));
    let mut other = world.clone();
    let last = bodies[11];
    match change {
        0 => {
            let made = other
                .add_body(RigidBody::fixed().position(Vec2::new(0.4, 0.6)).shape(disk(0.3)))?;
            other.remove_body(made)?;
        }
        1 => {
            let joint = other.add_joint(bodies[0], bodies[5], JointDef::filter())?;
            other.remove_joint(joint)?;
        }
        2 => with(&mut other, last, |body| {
            body.set_gravity_scale(3.0);
            body.set_gravity_scale(1.0);
        }),
        3 => with(&mut other, last, |body| {
            body.set_enabled(false);
            body.set_enabled(true);
        }),
        4 => with(&mut other, last, |body| {
            body.set_kind(BodyKind::Static);
            body.set_kind(BodyKind::Dynamic);
        }),
        _ => with(&mut other, last, |body| body.wake()),
    }
    if world.state_hash() != other.state_hash() {
        return Ok(false);
    }
    (0..60).for_each(|_| {
        world.step(1.0 / 60.0);
        other.step(1.0 / 60.0);
    });
    let place = |world: &World, id| world.body(id).map(|body| body.position_f64());
    Ok(bodies.iter().any(|&id| place(&world, id) != place(&other, id)))
}

fn with(world: &mut World, body: BodyId, change: impl FnOnce(&mut BodyMut<'_>)) {
    if let Some(mut body) = world.body_mut(body) {
        change(&mut body);
    }
}

/// Whole runs of built-in scenes at the plainest and the best SIMD level: how many end with other bits?
pub(super) fn whole_runs(lab: &mut Lab<'_>) -> Vec<Measure> {
    let names = lab.pick(
        ["ragdoll", "car", "bowl", "wrecking_ball", "clockwork", "rain"],
        ["seed_demo", "breaking_bridge", "blast", "platforms", "galton_board", "joints"],
    );
    let differ = |name: &&str| {
        let Ok(entry) = find(name) else { return true };
        let scene = entry.build(Options::default());
        let hashes = [SimdLevel::Scalar, SimdLevel::detect()].map(|level| {
            let mut run = Run::start(&scene).ok()?;
            run.world_mut().set_simd(level).ok()?;
            while !run.is_done() {
                run.step();
            }
            Some(run.world().state_hash())
        });
        hashes[0].is_none() || hashes[0] != hashes[1]
    };
    let count = names.iter().filter(|name| differ(name)).count();
    vec![none(format!("scenes that differ between SIMD levels, of {}", names.len()), count)]
}

/// A floor, two bodies on a joint, and a third that lies below.
fn world_of(def: JointDef, apart: f32) -> Result<World, Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    world.add_body(RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(rect(20.0, 1.0)))?;
    world.add_body(RigidBody::dynamic().position(Vec2::new(0.2, 0.5)).shape(rect(0.5, 0.5)))?;
    let a = world.add_body(RigidBody::dynamic().position(Vec2::new(0.0, 2.0)).shape(disk(0.3)))?;
    let b = RigidBody::dynamic().position(Vec2::new(apart, 2.0)).shape(rect(0.2, 0.3));
    let b = world.add_body(b)?;
    let _: JointId = world.add_joint(a, b, def)?;
    Ok(world)
}
