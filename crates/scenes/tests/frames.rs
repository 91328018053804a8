//! Frames: save at any step, go on, go back, go on again: the same bits every step.

use tiny_physics::{JointDef, RigidBody, Shape, Vec2, World};
use tiny_physics_scenes::{Options, Run, find};

const SCENES: [&str; 9] = [
    "bridge",
    "ragdoll",
    "card_house",
    "galton_board",
    "wrecking_ball",
    "car",
    "domino",
    "stack",
    "bullet_wall",
];

fn world_at(scene: &str, step: u32) -> World {
    let scene = find(scene).unwrap().build(Options::default());
    assert!(scene.script.is_none());
    let mut run = Run::start(&scene).unwrap();
    (0..step).for_each(|_| run.step());
    run.into_host().into_world()
}

fn hashes(world: &mut World, steps: u32) -> Vec<u64> {
    let mut hashes = vec![world.state_hash()];
    for _ in 0..steps {
        world.step(1.0 / 60.0);
        hashes.push(world.state_hash());
    }
    hashes
}

#[test]
fn going_back_repeats_every_bit() {
    for scene in SCENES {
        for step in [0, 1, 37, 150] {
            let mut world = world_at(scene, step);
            let (frame, bytes) = (world.clone(), world.to_bytes());
            let expected = hashes(&mut world, 40);
            world.clone_from(&frame);
            assert_eq!(hashes(&mut world, 40), expected, "{scene} from step {step}");
            world.restore_bytes(&bytes).unwrap();
            assert_eq!(hashes(&mut world, 40), expected, "{scene} from bytes of step {step}");
            let mut other = World::from_bytes(&bytes).unwrap();
            assert_eq!(hashes(&mut other, 40), expected, "{scene} elsewhere");
            world.validate().unwrap();
            other.validate().unwrap();
        }
    }
}

#[test]
fn going_back_while_islands_fall_asleep_and_wake() {
    let mut world = world_at("stack", 0);
    let mut asleep = 0;
    for _ in 0..60 {
        let frame = world.clone();
        let expected = hashes(&mut world, 8);
        world.clone_from(&frame);
        assert_eq!(hashes(&mut world, 8), expected);
        asleep += u32::from(world.awake_body_count() == 0);
    }
    assert!(asleep > 0, "nothing fell asleep");
    let frame = world.clone();
    let drop = |world: &mut World| {
        let ball = RigidBody::new(Shape::Circle { radius: 0.5 }, Vec2::new(0.1, 14.0), 5.0);
        world.add_body(ball).unwrap();
        hashes(world, 120)
    };
    let expected = drop(&mut world);
    world.clone_from(&frame);
    assert_eq!(drop(&mut world), expected);
}

#[test]
fn handles_of_the_frame_live_and_later_ones_are_refused() {
    let mut world = world_at("bridge", 20);
    let ball = || RigidBody::new(Shape::Circle { radius: 0.5 }, Vec2::new(0.0, 9.0), 1.0);
    let (old, doomed) = (world.add_body(ball()).unwrap(), world.add_body(ball()).unwrap());
    let frame = world.clone();
    let bytes = world.to_bytes();

    world.remove_body(doomed).unwrap();
    let later = world.add_body(ball()).unwrap();
    let joint = world.add_joint(old, later, JointDef::revolute()).unwrap();
    let shape = world.add_shape(old, Shape::Circle { radius: 0.2 }).unwrap();
    for back in [0, 1] {
        if back == 0 {
            world.clone_from(&frame);
        } else {
            world.restore_bytes(&bytes).unwrap();
        }
        assert!(world.body(old).is_some() && world.body(doomed).is_some());
        assert!(world.body(later).is_none());
        let (newer, other) = (world.add_body(ball()).unwrap(), world.add_body(ball()).unwrap());
        let again = world.add_joint(old, newer, JointDef::revolute()).unwrap();
        let new_shape = world.add_shape(old, Shape::Circle { radius: 0.2 }).unwrap();
        assert!(world.body(later).is_none() && ![newer, other].contains(&later));
        assert!(world.joint(joint).is_none() && again != joint);
        assert!(world.shape(shape).is_none() && new_shape != shape);
        assert!(world.remove_body(later).is_err());
    }
}

/// Rolled-back worlds and worlds that never went back hash the same.
#[test]
fn hashes_do_not_count_detours() {
    let (mut straight, mut detour) = (world_at("card_house", 10), world_at("card_house", 10));
    let frame = detour.clone();
    let ball = || RigidBody::new(Shape::Circle { radius: 0.3 }, Vec2::new(-8.0, 3.0), 2.0);
    detour.add_body(ball()).unwrap();
    detour.step(1.0 / 60.0);
    detour.clone_from(&frame);
    straight.add_body(ball()).unwrap();
    detour.add_body(ball()).unwrap();
    assert_eq!(hashes(&mut straight, 60), hashes(&mut detour, 60));
}
