//! Stacks with joints in them, and what joints press: neither sinks more than it would without.

mod common;

use common::*;
use tiny_physics::{BodyId, JointDef, JointKind, RigidBody, Shape, ShapeDef, Vec2, World};

/// A world of such a length unit, its floor, a tower of crates of about that size and 1 kg on it, and how high that is.
fn stack(count: usize, size: f32, random: &mut Random) -> (World, BodyId, Vec<BodyId>, f32) {
    let mut world = World::new(Vec2::new(0.0, -10.0 * size));
    world.settings.length_unit = size;
    let floor = Shape::rect(20.0 * size, size).unwrap();
    let floor = RigidBody::fixed().shape(floor).position(Vec2::new(0.0, -size));
    let floor = world.add_body(floor).unwrap();
    let (mut crates, mut top) = (Vec::new(), 0.0);
    for _ in 0..count {
        let half = 0.5 * size * random.range(0.9, 1.1);
        let shape = ShapeDef::new(Shape::rect(half, half).unwrap());
        let body = RigidBody::dynamic().shape(shape).mass(1.0).position(Vec2::new(0.0, top + half));
        crates.push(world.add_body(body).unwrap());
        top += 2.0 * half;
    }
    (world, floor, crates, top)
}

fn height(world: &World, body: BodyId) -> f32 {
    world.body(body).unwrap().position().y
}

/// A sliding line up and down at a height of a body that is put in at x = 0.
fn rail(y: f32) -> JointDef {
    JointDef::prismatic(Vec2::Y).anchor_at(Vec2::new(0.0, y)).direction(Vec2::Y).collide_connected()
}

/// Slack ropes and free rails bear nothing. Towers of 30 crates sank by 131 mm with one, by 6 without.
#[test]
fn joints_that_bear_nothing_leave_a_tower_fine() {
    let mut random = Random::new(11);
    for case in 0..8 {
        let (count, seed) = (15 + random.below(20) as usize, random.word());
        let size = [1.0, 50.0][case % 2];
        let held = 1 + random.below(count as u64 - 1) as usize;
        let slack = JointDef::rope(1.0e4 * size).collide_connected();
        let sinks = |kind: usize| {
            let (mut world, floor, crates, top) = stack(count, size, &mut Random::new(seed));
            let y = height(&world, crates[held]);
            match kind {
                1 => drop(world.add_joint(floor, crates[held], slack)),
                2 => drop(world.add_joint(floor, crates[held], rail(y))),
                3 => drop(world.add_joint(crates[held], crates[0], slack)),
                _ => {}
            }
            let start = height(&world, crates[count - 1]);
            steps(&mut world, 100);
            assert!(top > 0.0 && world.validate().is_ok());
            (start - height(&world, crates[count - 1])) / size
        };
        let without = sinks(0);
        for kind in 1..4 {
            let with = sinks(kind);
            assert!(with < 1.2 * without + 0.001, "case {case}, kind {kind}: {with} {without}");
        }
    }
}

/// A press on three crates: three forces of motors and one by hand on a rail, against the same force by hand. Under 1 kN the
/// crates sank by 50 mm in place of 2.4.
#[test]
fn a_press_sinks_in_no_more_than_a_force() {
    let mut random = Random::new(12);
    for case in 0..6 {
        let (force, seed) = (300.0 * 33.0_f32.powf(random.range(0.0, 1.0)), random.word());
        let size = [1.0, 50.0][case % 2];
        let force = force * size;
        let sinks = |kind: usize| {
            let (mut world, floor, crates, top) = stack(3, size, &mut Random::new(seed));
            let y = top + 0.5 * size;
            let square = Shape::rect(0.5 * size, 0.5 * size).unwrap();
            let press = RigidBody::dynamic().shape(square).mass(1.0).position(Vec2::new(0.0, y));
            let press = world.add_body(press).unwrap();
            let drive = JointKind::Motor {
                velocity: Vec2::new(0.0, -size),
                max_force: force,
                angular_velocity: 0.0,
                max_torque: force * size,
                linear_spring: None,
                max_spring_force: 0.0,
                angular_spring: None,
                max_spring_torque: 0.0,
            };
            let joint = [
                None,
                Some(rail(y)),
                Some(rail(y).motor(-size, force)),
                Some(JointDef::new(drive).collide_connected()),
                Some(JointDef::mouse(Vec2::new(0.0, -1.0e3 * size), force)),
            ][kind];
            if let Some(joint) = joint {
                world.add_joint(floor, press, joint).unwrap();
            }
            let start = height(&world, crates[2]);
            for _ in 0..300 {
                if kind < 2 {
                    let mut press = world.body_mut(press).unwrap();
                    press.apply_force_to_center(Vec2::new(0.0, -force));
                }
                world.step(DT);
            }
            (start - height(&world, crates[2])) / size
        };
        let by_hand = sinks(0);
        for kind in 1..5 {
            let sunk = sinks(kind);
            assert!(sunk < 2.0 * by_hand + 0.001, "case {case}, {kind}: {sunk} {by_hand}");
        }
    }
}

/// Stacks on a shelf that is welded or hinged to something fixed sank by up to 34 mm, on a fixed one by 3.
#[test]
fn what_is_pinned_to_something_fixed_bears_as_that_does() {
    let mut random = Random::new(13);
    for case in 0..8 {
        let (count, seed) = (5 + random.below(12) as usize, random.word());
        let size = [1.0, 50.0][case % 2];
        let sinks = |kind: usize| {
            let (mut world, floor, crates, _) = stack(count, size, &mut Random::new(seed));
            let board = ShapeDef::new(Shape::rect(1.5 * size, 0.1 * size).unwrap());
            let board = if kind == 0 { RigidBody::fixed() } else { RigidBody::dynamic().mass(3.0) }
                .shape(board)
                .position(Vec2::new(0.0, 3.0 * size));
            let board = world.add_body(board).unwrap();
            for &body in &crates {
                let place = world.body(body).unwrap().position() + Vec2::new(0.0, 3.1 * size);
                world.body_mut(body).unwrap().set_position(place);
            }
            let pin = |x: f32| JointDef::revolute().anchor_at(Vec2::new(x * size, 3.0 * size));
            let weld = JointDef::weld().anchor_at(Vec2::new(-1.5 * size, 3.0 * size));
            let pins = match kind {
                0 => vec![],
                1 => vec![weld],
                _ => vec![pin(-1.4), pin(1.4)],
            };
            for joint in pins {
                world.add_joint(floor, board, joint).unwrap();
            }
            let start = height(&world, crates[count - 1]);
            steps(&mut world, 100);
            (start - height(&world, crates[count - 1])) / size
        };
        let fixed = sinks(0);
        for kind in 1..3 {
            let sunk = sinks(kind);
            assert!(sunk < 2.0 * fixed + 0.003, "case {case}, {kind}: {sunk} {fixed}");
        }
    }
}

/// Sliders that were made one to three metres beyond their limits, above crates, with and without a motor. Solved as finely as others
/// six of 160 shot these out, at up to 230 m/s.
#[test]
fn what_is_out_of_place_crushes_and_does_not_throw() {
    for seed in 0..80 {
        let mut random = Random::new(seed * 7919 + 13);
        let size = [1.0, 50.0][seed as usize % 2];
        let (mut world, floor, crates, top) = stack(3, size, &mut random);
        let y = top + 0.5 * size;
        let square = Shape::rect(0.5 * size, 0.5 * size).unwrap();
        let press = RigidBody::dynamic().shape(square).mass(1.0).position(Vec2::new(0.0, y));
        let press = world.add_body(press).unwrap();
        let (near, far) = (random.range(0.5, 2.0) * size, random.range(2.0, 3.0) * size);
        let joint = rail(y).limits(-far, -near);
        let motor = joint.motor(0.5 * size, random.range(1.0, 200.0) * size);
        let joint = if random.below(2) == 0 { joint } else { motor };
        world.add_joint(floor, press, joint).unwrap();
        let mut most = 0.0_f32;
        for _ in 0..480 {
            world.step(DT);
            let aside = |&body: &BodyId| world.body(body).unwrap().position().x.abs() / size;
            most = crates.iter().map(aside).fold(most, f32::max);
        }
        assert!(most < 1.2, "seed {seed}: {most} m aside");
    }
}
