//! Joints of what falls and hits. Families with random members; what failed before is said at each.

mod common;

use common::{DT, Random, rect, world_with_floor};
use tiny_physics::{JointDef, JointId, JointKind, RigidBody, Vec2, World};

/// How far the parts of a joint are from where it holds them, metres: across a slider, else between the anchors.
fn gap(world: &World, joint: JointId) -> f32 {
    let joint = world.joint(joint).unwrap();
    let (a, b) = joint.anchors();
    let apart = b.relative_to(a);
    match joint.def().kind {
        JointKind::Prismatic { .. } => {
            let turn = world.body(joint.bodies().0).unwrap().angle();
            (apart.y * turn.cos() - apart.x * turn.sin()).abs()
        }
        _ => apart.length(),
    }
}

/// Two bars end to end, of which the second has so many times the mass of the first, above a floor, with a velocity of up to 15
/// m/s: a weld, a hinge or a slider between them.
fn pair(random: &mut Random, joint: u64, ratio: f32) -> (World, JointId) {
    let mut world = world_with_floor();
    let velocity = Vec2::new(random.range(-15.0, 15.0), random.range(-15.0, 0.0));
    let (half_a, half_b) = (random.range(0.2, 0.5), random.range(0.2, 0.5));
    let turn = random.range(-3.0, 3.0);
    let along = Vec2::new(turn.cos(), turn.sin());
    let mut bar = |half: f32, way: f32, mass: f32| {
        let place = Vec2::new(0.0, 2.0) + along * way;
        let bar = RigidBody::dynamic().position(place).angle(turn).velocity(velocity);
        world.add_body(bar.shape(rect(half, 0.2)).mass(mass)).unwrap()
    };
    let (a, b) = (bar(half_a, 0.0, 1.0), bar(half_b, half_a + half_b, ratio));
    let def = match joint % 3 {
        0 => JointDef::weld(),
        1 => JointDef::revolute(),
        _ => JointDef::prismatic(Vec2::X).limits(0.0, 0.1),
    };
    let def = def.anchors(Vec2::new(half_a, 0.0), Vec2::new(-half_b, 0.0));
    let joint = world.add_joint(a, b, def).unwrap();
    (world, joint)
}

/// The widest gaps of a hundred pairs in four seconds, added up.
fn gaps(least: f32, most: f32) -> f32 {
    let of = |seed| {
        let mut random = Random::new(seed);
        let ratio = least * (most / least).powf(random.range(0.0, 1.0));
        let (mut world, joint) = pair(&mut random, seed, ratio);
        let after = |_| {
            world.step(DT);
            gap(&world, joint)
        };
        (0..240).map(after).fold(0.0, f32::max)
    };
    (0..100).map(of).sum()
}

/// Where one of two joined bodies was stopped at its first impact, the other went on: 2.3 m.
#[test]
fn what_is_joined_is_stopped_together() {
    let sum = gaps(1.0, 1.0);
    assert!(sum < 1.6, "{sum} m");
}

/// Contacts of the lighter one knew nothing of the other: 6.2 m.
#[test]
fn light_bodies_feel_what_is_joined_to_them() {
    let sum = gaps(5.0, 100.0);
    assert!(sum < 0.6, "{sum} m");
}

/// Two sliders of light bodies on a heavy one, all made far beyond their limits, fall on a floor. Each time that contacts
/// were solved in a substep what a limit had pushed counted as a blow to be given back: they came in at 100 m/s.
#[test]
fn what_is_beyond_its_limits_comes_back_gently() {
    for seed in 0..60 {
        let mut random = Random::new(seed);
        let mut world = world_with_floor();
        let y = random.range(1.0, 3.0);
        let heavy = RigidBody::dynamic().position(Vec2::new(0.0, y)).shape(rect(0.3, 0.2));
        let heavy = heavy.angle(random.range(-0.5, 0.5)).mass(random.range(4.0, 20.0));
        let heavy = world.add_body(heavy).unwrap();
        let sliders = [-1.0, 1.0].map(|side| {
            let place = Vec2::new(side * random.range(1.2, 1.8), y + random.range(-0.5, 0.5));
            let light = RigidBody::dynamic().position(place).shape(rect(0.3, 0.3)).mass(0.36);
            let light = world.add_body(light).unwrap();
            let mut off = || Vec2::new(random.range(-0.6, 0.6), random.range(-0.6, 0.6));
            let def = JointDef::prismatic(Vec2::X).limits(-0.3, 0.3).anchors(off(), off());
            world.add_joint(light, heavy, def).unwrap()
        });
        let now = |world: &World| sliders.map(|joint| world.joint(joint).unwrap().translation());
        for step in 0..90 {
            let before = now(&world);
            world.step(DT);
            for (now, before) in now(&world).into_iter().zip(before) {
                let speed = (now - before).abs() / DT;
                assert!(speed < 16.0, "seed {seed}, step {step}: {speed} m/s");
            }
        }
        let beyond = now(&world).map(|place| place.abs() - 0.3);
        assert!(beyond[0].max(beyond[1]) < 0.01, "seed {seed}: {beyond:?} m beyond");
    }
}

/// Rows of five to eight planks, welded or hinged with narrow limits, thrown at a floor. A plank that its contact had stopped was set
/// back to its first impact all the same, and the others went on: 2.3 m.
#[test]
fn planks_of_a_row_stay_together_where_one_lands() {
    let widest = |seed| {
        let mut random = Random::new(seed);
        let mut world = world_with_floor();
        let count = 5 + seed % 4;
        let (velocity, turn) = (Vec2::new(random.range(-5.0, 5.0), -8.0), random.range(-0.6, 0.6));
        let along = Vec2::new(turn.cos(), turn.sin());
        let planks: Vec<_> = (0..count)
            .map(|k| {
                let place = Vec2::new(0.0, 3.0) + along * (0.8 * k as f32);
                let plank = RigidBody::dynamic().position(place).angle(turn).velocity(velocity);
                world.add_body(plank.shape(rect(0.4, 0.1))).unwrap()
            })
            .collect();
        let mut joints = Vec::new();
        for pair in planks.windows(2) {
            let weld = JointDef::weld();
            let hinge = JointDef::revolute().limits(-0.1, 0.1);
            let def = if seed % 2 == 0 { weld } else { hinge };
            let def = def.anchors(Vec2::new(0.4, 0.0), Vec2::new(-0.4, 0.0));
            joints.push(world.add_joint(pair[0], pair[1], def).unwrap());
        }
        let after = |_| {
            world.step(DT);
            joints.iter().map(|&joint| gap(&world, joint)).fold(0.0, f32::max)
        };
        (0..180).map(after).fold(0.0, f32::max)
    };
    let sum: f32 = (0..60).map(widest).sum();
    assert!(sum < 1.7, "{sum} m");
}

/// Sleepers welded together, of whom one is shot at a wall: what woke in the step was set back twice, and not as one.
#[test]
fn what_wakes_in_a_hit_is_stopped_together() {
    let mut random = Random::new(11);
    for seed in 0..300 {
        let mut world = World::new(Vec2::ZERO);
        let body = |x: f32, y: f32, half: f32| {
            RigidBody::dynamic().position(Vec2::new(x, y)).shape(rect(half, half))
        };
        let lower = world.add_body(body(0.0, -0.1, 0.1)).unwrap();
        let aside: Vec<_> = (0..3)
            .map(|i| body(-30.0, 3.0 * i as f32 - 30.0, 0.2).velocity(Vec2::new(90.0, 0.0)))
            .map(|body| world.add_body(body).unwrap())
            .collect();
        let upper = world.add_body(body(0.0, 0.1, 0.1)).unwrap();
        let joint = world.add_joint(lower, upper, JointDef::weld()).unwrap();
        let wall = Vec2::new(random.range(0.3, 2.0), if seed % 2 == 0 { 1.1 } else { -1.1 });
        world.add_body(RigidBody::fixed().position(wall).shape(rect(0.05, 1.0))).unwrap();
        world.body_mut(lower).unwrap().sleep();
        let shot = body(-random.range(0.5, 1.5), random.range(-0.2, 0.2), 0.2);
        world.add_body(shot.velocity(Vec2::new(random.range(60.0, 200.0), 0.0))).unwrap();
        for _ in 0..3 {
            world.step(DT);
            world.validate().unwrap();
        }
        let open = gap(&world, joint);
        assert!(open < 0.1, "world {seed}: {open} m apart");
        assert!(aside.iter().all(|&body| world.body(body).unwrap().velocity().x == 90.0));
    }
}
