//! The same world makes the same bits: on every SIMD level, from a clone, and from a saved frame.

mod common;

use common::*;
use tiny_physics::{JointDef, RigidBody, SimdLevel, Vec2, World};

/// A scene by its name.
type Scene = (&'static str, fn() -> World);

const SCENES: [Scene; 7] = [
    ("pyramid", || pyramid(12)),
    ("mixed pile, seed 1", || mixed_pile(120, 1)),
    ("mixed pile, seed 2", || mixed_pile(120, 2)),
    ("mixed pile, seed 3", || mixed_pile(61, 3)),
    ("circles without gravity", circles_without_gravity),
    ("crowd around one body", crowd),
    ("chains of hinges in a pile", chains),
];

/// Balls that bounce off each other for ever.
fn circles_without_gravity() -> World {
    let mut random = Random::new(7);
    let mut world = World::new(Vec2::ZERO);
    for i in 0..100 {
        let place = Vec2::new((i % 10) as f32, (i / 10) as f32);
        let speed = Vec2::new(random.range(-5.0, 5.0), random.range(-5.0, 5.0));
        let ball = RigidBody::new(circle(0.45), place, 1.0).velocity(speed).restitution(1.0);
        world.add_body(ball).unwrap();
    }
    world
}

/// More contacts on one body than there are colours: the rest is solved one by one.
fn crowd() -> World {
    let mut world = world_with_floor();
    drop_at(&mut world, rect(20.0, 0.5), 0.0, 0.5);
    for i in 0..60 {
        drop_at(&mut world, circle(0.25), 0.6 * i as f32 - 18.0, 1.25);
    }
    world
}

/// Chains that fall on a pile, long enough to be solved as trees.
fn chains() -> World {
    let mut world = mixed_pile(30, 9);
    for chain in 0..6 {
        let (mut last, x) = (None, chain as f32 - 3.0);
        for i in 0..12 {
            let link = drop_at(&mut world, capsule(0.2, 0.1), x, 8.0 + 0.4 * i as f32);
            if let Some(last) = last {
                let (end, start) = (Vec2::new(0.2, 0.0), Vec2::new(-0.2, 0.0));
                let hinge = JointDef::revolute().anchors(end, start).spring(2.0, 0.5);
                world.add_joint(last, link, hinge).unwrap();
            }
            last = Some(link);
        }
    }
    world
}

/// Hashes of every tenth frame.
fn hashes(world: &mut World, count: usize) -> Vec<u64> {
    let mut hashes = Vec::new();
    for step in 1..=count {
        world.step(DT);
        if step % 10 == 0 {
            hashes.push(world.state_hash());
        }
    }
    hashes
}

/// The first frame in which two runs differ.
fn divergence(a: &[u64], b: &[u64]) -> Option<usize> {
    a.iter().zip(b).position(|(a, b)| a != b).map(|i| 10 * (i + 1))
}

#[test]
fn every_simd_level_gives_the_same_bits() {
    for (name, scene) in SCENES {
        let mut reference = scene();
        reference.set_simd(SimdLevel::Scalar).unwrap();
        let expected = hashes(&mut reference, 300);
        for level in SimdLevel::available() {
            let mut world = scene();
            world.set_simd(level).unwrap();
            let differs = divergence(&expected, &hashes(&mut world, 300));
            assert_eq!(differs, None, "{name}: {level} differs from scalar by this frame");
        }
    }
}

#[test]
fn every_number_of_threads_gives_the_same_bits() {
    for (name, scene) in SCENES {
        let expected = hashes(&mut scene(), 200);
        for threads in [2, 3, 5] {
            let mut world = scene();
            world.set_threads(threads);
            let differs = divergence(&expected, &hashes(&mut world, 200));
            assert_eq!(differs, None, "{name}: {threads} threads differ from one by this frame");
        }
    }
}

#[test]
fn the_level_may_change_while_running() {
    let (mut steady, mut changing) = (mixed_pile(80, 5), mixed_pile(80, 5));
    let levels: Vec<_> = SimdLevel::available().collect();
    for step in 0..200 {
        changing.set_simd(levels[step % levels.len()]).unwrap();
        changing.step(DT);
        steady.step(DT);
        assert_eq!(steady.state_hash(), changing.state_hash(), "step {step}");
    }
}

#[test]
fn a_level_that_the_machine_lacks_is_refused() {
    let mut world = world();
    for level in SimdLevel::ALL {
        assert_eq!(world.set_simd(level).is_ok(), level.is_available(), "{level}");
    }
}

#[test]
fn a_clone_goes_on_as_the_original_does() {
    for (name, scene) in SCENES {
        for start in [0, 1, 37, 150] {
            let mut original = scene();
            steps(&mut original, start);
            let mut clone = original.clone();
            assert_eq!(original.state_hash(), clone.state_hash());
            let (a, b) = (hashes(&mut original, 100), hashes(&mut clone, 100));
            assert_eq!(divergence(&a, &b), None, "{name}, cloned at {start}");
        }
    }
}

#[test]
fn a_saved_frame_can_be_run_again() {
    for (name, scene) in SCENES {
        let mut world = scene();
        steps(&mut world, 60);
        let saved = world.clone();
        let first = hashes(&mut world, 120);
        world.clone_from(&saved);
        assert_eq!(divergence(&first, &hashes(&mut world, 120)), None, "{name}");
    }
}

/// Removes and adds bodies in a way that the seed decides, and lets the world run.
fn churn(world: &mut World, random: &mut Random, rounds: usize) {
    for _ in 0..rounds {
        let ids: Vec<_> = world.body_ids().skip(1).collect();
        let victim = ids[random.below(ids.len() as u64) as usize];
        world.remove_body(victim).unwrap();
        for _ in 0..random.below(3) {
            let (x, y) = (random.range(-4.0, 4.0), random.range(1.0, 9.0));
            drop_at(world, rect(random.range(0.1, 0.5), 0.3), x, y);
        }
        steps(world, random.below(5) as usize);
    }
}

#[test]
fn bodies_that_come_and_go_leave_clones_and_levels_alike() {
    for seed in 0..4 {
        let mut world = mixed_pile(40, seed);
        churn(&mut world, &mut Random::new(seed), 40);
        let mut runs = vec![world.clone()];
        for level in SimdLevel::available() {
            let mut run = world.clone();
            run.set_simd(level).unwrap();
            runs.push(run);
        }
        let hashes: Vec<_> = runs
            .iter_mut()
            .map(|run| {
                churn(run, &mut Random::new(seed + 100), 40);
                run.validate().unwrap();
                run.state_hash()
            })
            .collect();
        assert!(hashes.iter().all(|&hash| hash == hashes[0]), "seed {seed}: {hashes:x?}");
    }
}

#[test]
fn going_back_to_before_the_first_contact_leaves_nothing_behind() {
    for (name, scene) in SCENES {
        let start = scene();
        let mut world = start.clone();
        let expected = hashes(&mut world, 60);
        world.clone_from(&start);
        assert_eq!(divergence(&expected, &hashes(&mut world, 60)), None, "{name}");
    }
}

#[test]
fn what_the_next_step_depends_on_is_in_the_hash() {
    let start = {
        let mut world = pyramid(3);
        steps(&mut world, 5);
        world
    };
    let id = start.body_ids().nth(2).unwrap();
    type Change = fn(&mut World, tiny_physics::BodyId);
    let changes: [(&str, Change); 14] = [
        ("gravity", |world, _| world.gravity.x = 1.0),
        ("substeps", |world, _| world.settings.substeps = 5),
        ("contact stiffness", |world, _| world.settings.contact_hertz = 20.0),
        ("sleep", |world, _| world.settings.sleep = false),
        ("a shape", |world, id| drop(world.add_shape(id, circle(0.7)))),
        ("a body", |world, _| drop(world.add_body(RigidBody::dynamic()))),
        ("position", |world, id| world.body_mut(id).unwrap().set_position(Vec2::new(9.0, 9.0))),
        ("angle", |world, id| world.body_mut(id).unwrap().set_angle(0.5)),
        ("velocity", |world, id| world.body_mut(id).unwrap().set_velocity(Vec2::X)),
        ("turning", |world, id| world.body_mut(id).unwrap().set_angular_velocity(1.0)),
        ("force", |world, id| world.body_mut(id).unwrap().apply_force_to_center(Vec2::X)),
        ("gravity scale", |world, id| world.body_mut(id).unwrap().set_gravity_scale(0.5)),
        ("damping", |world, id| world.body_mut(id).unwrap().set_damping(0.5, 0.0)),
        ("bullet", |world, id| world.body_mut(id).unwrap().set_bullet(true)),
    ];
    for (name, change) in changes {
        let mut world = start.clone();
        change(&mut world, id);
        assert_ne!(world.state_hash(), start.state_hash(), "{name} is not in the hash");
    }
}

#[test]
fn a_level_a_hundred_kilometres_away_behaves_as_one_at_the_origin() {
    let run = |origin: f64| {
        let mut world = world();
        let at = |x: f64, y: f64| tiny_physics::DVec2::new(origin + x, origin + y);
        let floor = RigidBody::fixed().position(at(0.0, -1.0)).shape(rect(100.0, 1.0));
        world.add_body(floor).unwrap();
        let body = RigidBody::dynamic().position(at(0.25, 3.0)).angle(0.4).shape(rect(0.5, 0.25));
        let body = world.add_body(body).unwrap();
        steps(&mut world, 240);
        let body = world.body(body).unwrap();
        (body.position_f64().relative_to(at(0.0, 0.0)), body.angle())
    };
    // 2^17 m, so that adding it rounds nothing away that matters.
    let ((near, near_angle), (far, far_angle)) = (run(0.0), run(131_072.0));
    assert!(near.distance(far) < 1.0e-4, "{near:?} became {far:?}");
    assert!((near_angle - far_angle).abs() < 1.0e-4, "{near_angle} became {far_angle}");
}
