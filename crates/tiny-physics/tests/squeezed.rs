//! Nothing goes deep into anything where that is hard to keep: under a corner that a turn brings down, between the heavy and
//! the ground, on a light plank of a bridge. Families with random members; what failed before is said at each.

mod common;

use common::{DT, Random, circle, drop_at, energy, rect, world, world_with_floor};
use tiny_physics::{JointDef, Polygon, RigidBody, Shape, ShapeDef, Vec2, World};

/// The deepest overlap over some steps, metres.
fn deepest(world: &mut World, count: usize) -> f32 {
    let look = |_| {
        world.step(DT);
        world.max_penetration()
    };
    (0..count).map(look).fold(0.0, f32::max)
}

/// A plank falls, spinning, on one that spins the other way: the corner that is not yet down comes faster than the one that is.
/// Half a thickness is as deep as nothing goes; before there were other corners, 22 of 60 went deeper, 2.0 times it at most.
#[test]
fn the_other_corner_of_what_spins_stays_out() {
    let mut random = Random::new(5);
    let mut worst = Vec::new();
    for _ in 0..60 {
        let mut world = world_with_floor();
        let (half, thick) = (random.range(0.3, 0.6), random.range(0.06, 0.12));
        drop_at(&mut world, rect(half, thick), 0.0, thick);
        let spin = random.range(8.0, 25.0);
        for (k, sign) in [(0, 1.0), (1, -1.0)] {
            let y = 4.0 * thick + 0.4 + 0.5 * k as f32;
            let body = RigidBody::dynamic().position(Vec2::new(random.range(-0.1, 0.1), y));
            let body = body.velocity(Vec2::new(0.0, -4.0 - 4.0 * k as f32));
            let body = body.angular_velocity(sign * spin).shape(rect(half, thick));
            world.add_body(body).expect("a sound body");
        }
        worst.push(deepest(&mut world, 60) / thick);
    }
    let deep = worst.iter().filter(|&&depth| depth > 1.0).count();
    assert!(deep == 0, "{deep} of 60: {worst:.2?}");
}

/// A ball of ten to forty times its weight falls on a can. Before hard hits were solved more often, 13 of 40 pressed it deeper than its half height.
#[test]
fn what_is_squeezed_is_not_passed_through() {
    let mut random = Random::new(6);
    let mut worst = Vec::new();
    for _ in 0..40 {
        let mut world = world_with_floor();
        let half = random.range(0.07, 0.15);
        let can = RigidBody::dynamic().position(Vec2::new(0.0, half)).shape(rect(2.0 * half, half));
        world.add_body(can.mass(1.0)).expect("a can");
        let ball = RigidBody::dynamic().position(Vec2::new(random.range(-0.1, 0.1), 1.0));
        let ball = ball.velocity(Vec2::new(0.0, -random.range(5.0, 12.0))).shape(circle(0.15));
        world.add_body(ball.mass(random.range(10.0, 40.0))).expect("a ball");
        worst.push(deepest(&mut world, 60) / half);
    }
    let deep = worst.iter().filter(|&&depth| depth > 1.0).count();
    assert!(deep == 0, "{deep} of 40: {worst:.2?}");
}

/// What weighs a hundred to a thousand times as much falls on a can, a marble, a wedge, or two cans one on the other.
#[test]
fn what_is_squeezed_by_far_more_is_not_passed_through() {
    let mut random = Random::new(8);
    let mut worst = Vec::new();
    for i in 0..80 {
        let mut world = world_with_floor();
        let half = random.range(0.07, 0.15);
        let wedge =
            [(-half, -half), (half, -half), (0.3 * half, half)].map(|(x, y)| Vec2::new(x, y));
        let shape = match i % 4 {
            0 | 3 => rect(1.5 * half, half),
            1 => circle(half),
            _ => Shape::Polygon(Polygon::hull(&wedge).expect("a wedge")),
        };
        for k in 0..if i % 4 == 3 { 2 } else { 1 } {
            let at = Vec2::new(0.0, (1 + 2 * k) as f32 * half);
            let light = RigidBody::dynamic().position(at).shape(shape).mass(0.1);
            world.add_body(light).expect("what is squeezed");
        }
        let load = if random.range(0.0, 1.0) < 0.5 { circle(0.3) } else { rect(0.3, 0.3) };
        let place = Vec2::new(random.range(-0.1, 0.1), 1.3);
        let load = RigidBody::dynamic().position(place).shape(load);
        let load = load.velocity(Vec2::new(0.0, -random.range(3.0, 15.0)));
        world.add_body(load.mass(random.range(10.0, 100.0))).expect("a load");
        worst.push(deepest(&mut world, 60) / half);
    }
    let deep = worst.iter().filter(|&&depth| depth > 1.0).count();
    assert!(deep == 0, "{deep} of 80: {worst:.2?}");
}

/// A chip lies on one to three crates as heavy as what falls on it. Where rows were followed through light bodies alone, 20 of 60
/// were gone through.
#[test]
fn what_is_squeezed_between_equals_is_not_passed_through() {
    let mut random = Random::new(21);
    let mut worst = Vec::new();
    for i in 0..60 {
        let mut world = world_with_floor();
        let (half, size) = (random.range(0.05, 0.1), random.range(0.25, 0.4));
        let count = 1 + i % 3;
        let crate_at = |y: f32| RigidBody::dynamic().position(Vec2::new(0.0, y));
        for k in 0..count {
            let crate_ = crate_at((1 + 2 * k) as f32 * size).shape(rect(size, size));
            world.add_body(crate_.mass(random.range(0.5, 2.0))).expect("a crate");
        }
        let top = 2.0 * size * count as f32;
        let chip = if i % 2 == 0 { rect(2.0 * half, half) } else { circle(half) };
        let chip = RigidBody::dynamic().position(Vec2::new(0.0, top + half)).shape(chip);
        world.add_body(chip.mass(random.range(0.005, 0.05))).expect("a chip");
        let place = Vec2::new(random.range(-0.1, 0.1), top + 1.2);
        let load = RigidBody::dynamic().position(place).angle(random.range(-0.5, 0.5));
        let load = load.velocity(Vec2::new(0.0, -random.range(2.0, 12.0))).shape(rect(size, size));
        world.add_body(load.mass(random.range(0.5, 2.0))).expect("a load");
        worst.push(deepest(&mut world, 60) / half);
    }
    let deep = worst.iter().filter(|&&depth| depth > 1.0).count();
    assert!(deep == 0, "{deep} of 60: {worst:.2?}");
}

/// A heavy body falls on a row of three to fourteen cans, one on the other. Where rows were followed for four bodies, 32 of
/// 40 were gone through.
#[test]
fn what_is_squeezed_in_a_row_is_not_passed_through() {
    let mut random = Random::new(14);
    let mut worst = Vec::new();
    for _ in 0..40 {
        let mut world = world_with_floor();
        let half = random.range(0.07, 0.15);
        let count = 3 + random.range(0.0, 12.0) as usize;
        for k in 0..count {
            let at = Vec2::new(0.0, (1 + 2 * k) as f32 * half);
            let light = RigidBody::dynamic().position(at).shape(rect(1.5 * half, half)).mass(0.1);
            world.add_body(light).expect("what is squeezed");
        }
        let place = Vec2::new(random.range(-0.1, 0.1), 2.0 * half * count as f32 + 1.0);
        let load = RigidBody::dynamic().position(place).shape(rect(0.3, 0.3));
        let load = load.velocity(Vec2::new(0.0, -random.range(3.0, 15.0)));
        world.add_body(load.mass(random.range(10.0, 100.0))).expect("a load");
        worst.push(deepest(&mut world, 60) / half);
    }
    let deep = worst.iter().filter(|&&depth| depth > 1.0).count();
    assert!(deep == 0, "{deep} of 40: {worst:.2?}");
}

/// A press with a motor, or a plate at many times gravity, presses one to four light bodies with 30 to 600 times their weight. While what
/// is squeezed had its own mass again in the next step, 25 of 120 were pressed deeper than their half height.
#[test]
fn what_is_pressed_on_is_not_passed_through() {
    let mut random = Random::new(22);
    let mut worst = Vec::new();
    for i in 0..120 {
        let mut world = world_with_floor();
        let (half, mass) = (random.range(0.05, 0.3), random.range(0.05, 1.0));
        let count = 1 + (random.range(0.0, 4.0) as usize);
        let shape = if i % 3 == 0 { circle(half) } else { rect(1.5 * half, half) };
        for k in 0..count {
            let (row, at) = (i % 3 == 1, k as f32);
            let at = if row { (0.0, (1.0 + 2.0 * at) * half) } else { (3.2 * half * at, half) };
            let light = RigidBody::dynamic().position(Vec2::new(at.0, at.1)).shape(shape);
            world.add_body(light.mass(mass)).expect("what is pressed");
        }
        let force = mass * 9.8 * 10_f32.powf(random.range(1.5, 2.8));
        let heavy = mass * 10_f32.powf(random.range(0.7, 2.5));
        let top = if i % 3 == 1 { 2.0 * half * count as f32 } else { 2.0 * half };
        let at = Vec2::new(0.0, top + 0.1 + random.range(0.0, 1.0));
        let plate = RigidBody::dynamic().position(at).shape(rect(1.0, 0.1)).mass(heavy);
        if i % 2 == 0 {
            world.add_body(plate.gravity_scale(force / (9.8 * heavy))).expect("a plate");
        } else {
            let plate = world.add_body(plate).expect("a plate");
            let frame = world.add_body(RigidBody::fixed()).expect("a frame");
            let slider = JointDef::prismatic(Vec2::new(0.0, -1.0)).anchor_at(at);
            let slider = slider.motor(random.range(0.2, 3.0), force);
            world.add_joint(frame, plate, slider).expect("a motor");
        }
        worst.push(deepest(&mut world, 200) / half);
    }
    let deep = worst.iter().filter(|&&depth| depth > 1.0).count();
    assert!(deep == 0, "{deep} of 120: {worst:.2?}");
}

/// Balls that roll fast come under something heavy that falls. What counts as heavy and is fast hands on more than it has: such a
/// ball threw a boulder aside, 4 of 100 gained energy; where all bounced, they kept their own mass, and 3 of 100 were gone through.
#[test]
fn what_rolls_fast_is_squeezed_and_hands_on_no_more_than_it_has() {
    let mut random = Random::new(23);
    let (mut worst, mut gained) = (Vec::new(), Vec::new());
    for i in 0..100 {
        let mut world = world_with_floor();
        let (half, speed) = (random.range(0.07, 0.15), random.range(3.0, 12.0));
        let restitution = if i % 2 == 0 { 0.0 } else { random.range(0.3, 1.0) };
        for k in 0..1 + random.range(0.0, 4.0) as usize {
            let ball = RigidBody::dynamic().position(Vec2::new(2.2 * half * k as f32 - 2.0, half));
            let ball = ball.velocity(Vec2::new(speed, 0.0)).angular_velocity(-speed / half);
            let ball = ball.shape(ShapeDef::new(circle(half)).restitution(restitution)).mass(0.1);
            world.add_body(ball).expect("a ball");
        }
        let (time, down) = (2.0 / speed, random.range(0.0, 8.0));
        let fall = down * time + 4.9 * time * time;
        let (shape, low) =
            if random.range(0.0, 1.0) < 0.5 { (circle(0.5), 0.5) } else { (rect(0.6, 0.3), 0.3) };
        let place = Vec2::new(random.range(-0.3, 0.3), low + 2.0 * half + fall);
        let boulder = RigidBody::dynamic().position(place).velocity(Vec2::new(0.0, -down));
        let boulder = boulder.shape(ShapeDef::new(shape).restitution(restitution));
        world.add_body(boulder.mass(random.range(5.0, 80.0))).expect("a boulder");
        let before = energy(&world);
        let (mut deep, mut most) = (0.0_f32, 0.0_f64);
        for _ in 0..120 {
            deep = deep.max(deepest(&mut world, 1));
            most = most.max(energy(&world) / before);
        }
        worst.push(deep / half);
        gained.push(most);
    }
    assert!(worst.iter().all(|&depth| depth < 1.0), "{worst:.2?}");
    assert!(gained.iter().all(|&energy| energy < 1.01), "{gained:.2?}");
}

/// A crate of a hundred times its weight falls on a light one: they come to rest, and the ground bears what they weigh.
#[test]
fn what_is_squeezed_weighs_what_it_weighs() {
    let mut world = world_with_floor();
    world.settings.sleep = false;
    let light = drop_at(&mut world, rect(0.5, 0.5), 0.0, 0.5);
    let load = RigidBody::dynamic().position(Vec2::new(0.0, 2.0)).shape(rect(0.5, 0.5));
    let mass = world.body(light).expect("a crate").mass();
    world.add_body(load.mass(100.0 * mass)).expect("a load");
    (0..300).for_each(|_| world.step(DT));
    assert_eq!(world.stats().squeezed_bodies, 1);
    let floor = world.body_ids().next().expect("the floor");
    let floor = world.body(floor).expect("the floor");
    let bears: f32 = floor.contacts().map(|contact| contact.force().y.abs()).sum();
    let weight = 101.0 * mass * 9.8;
    assert!((bears / weight - 1.0).abs() < 0.01, "{bears} of {weight}");
}

/// Stones of up to a hundred times the weight of others are tipped into a bin: all weigh what they did in every step, and come to rest.
/// One whose mass had counted as two in a step kept the weight of the second, and flew off.
#[test]
fn what_was_squeezed_falls_again_as_it_did() {
    for seed in 0..4 {
        let (mut random, mut world) = (Random::new(40 + seed), world_with_floor());
        for side in [-2.5, 2.5] {
            let wall = RigidBody::fixed().position(Vec2::new(side, 5.0)).shape(rect(0.5, 5.0));
            world.add_body(wall).expect("a wall");
        }
        for i in 0..80 {
            let size = random.range(0.08, 0.25);
            let shape = if i % 2 == 0 { circle(size) } else { rect(size, 0.6 * size) };
            let at = Vec2::new(-1.5 + 0.6 * (i % 6) as f32, 0.5 + 0.6 * (i / 6) as f32);
            let stone = ShapeDef::new(shape).density(100.0_f32.powf(random.range(-0.5, 0.5)));
            world.add_body(RigidBody::dynamic().position(at).shape(stone)).expect("a stone");
        }
        let mut weighed = 0;
        for _ in 0..1200 {
            world.step(DT);
            weighed += world.stats().squeezed_bodies;
            assert!(world.bodies().all(|body| body.gravity_scale() == 1.0), "heap {seed}");
        }
        assert!(weighed > 0 && !world.bodies().any(|body| body.is_awake()), "heap {seed}");
    }
}

/// So fast that it would reach the ground in the same step: that hit is not the one that counts.
#[test]
fn what_is_squeezed_by_what_would_reach_the_ground_is_not_passed_through() {
    let mut random = Random::new(12);
    let mut worst = Vec::new();
    for _ in 0..40 {
        let mut world = world_with_floor();
        let half = random.range(0.04, 0.08);
        for k in 0..3 {
            let at = Vec2::new(2.5 * half * (k as f32 - 1.0), half);
            let light = RigidBody::dynamic().position(at).shape(circle(half)).mass(0.05);
            world.add_body(light).expect("what is squeezed");
        }
        let ball = RigidBody::dynamic().position(Vec2::new(random.range(-0.1, 0.1), 1.2));
        let ball = ball.velocity(Vec2::new(0.0, -random.range(15.0, 25.0))).shape(circle(0.25));
        world.add_body(ball.mass(random.range(3.0, 15.0))).expect("a ball");
        worst.push(deepest(&mut world, 20) / half);
    }
    let deep = worst.iter().filter(|&&depth| depth > 1.0).count();
    assert!(deep == 0, "{deep} of 40: {worst:.2?}");
}

/// A wheel of fifty to four hundred times its weight rolls over a chip.
#[test]
fn what_is_rolled_over_is_not_passed_through() {
    let mut random = Random::new(9);
    let mut worst = Vec::new();
    for i in 0..40 {
        let mut world = world_with_floor();
        let half = random.range(0.04, 0.08);
        let chip = if i % 2 == 0 { rect(1.5 * half, half) } else { circle(half) };
        let chip = RigidBody::dynamic().position(Vec2::new(0.0, half)).shape(chip);
        world.add_body(chip.mass(0.1)).expect("a chip");
        let radius = random.range(0.3, 0.6);
        let speed = random.range(1.0, 4.0);
        let wheel = RigidBody::dynamic().position(Vec2::new(-1.5 * radius - 0.2, radius));
        let wheel = wheel.velocity(Vec2::new(speed, 0.0)).angular_velocity(-speed / radius);
        let wheel =
            wheel.shape(ShapeDef::new(circle(radius)).friction(1.0)).mass(random.range(5.0, 40.0));
        world.add_body(wheel).expect("a wheel");
        worst.push(deepest(&mut world, 120) / half);
    }
    let deep = worst.iter().filter(|&&depth| depth > 1.0).count();
    assert!(deep == 0, "{deep} of 40: {worst:.2?}");
}

/// Loads of up to sixty times a plank's weight fall on a bridge. Before contacts felt the tree of its hinges, 5 of 40 went
/// through planks, 2.9 of their half thickness deep.
#[test]
fn planks_of_a_bridge_keep_their_loads_out() {
    let mut random = Random::new(7);
    let mut worst = Vec::new();
    for _ in 0..40 {
        let mut world = world_with_floor();
        let (count, half, thick) = (8 + (random.range(0.0, 10.0) as usize), 0.25, 0.06);
        let posts = world.add_body(RigidBody::fixed()).expect("posts");
        let end = half * count as f32;
        let (near, far) = (Vec2::new(-half, 0.0), Vec2::new(half, 0.0));
        let (mut before, mut anchor) = (posts, Vec2::new(-end, 2.0));
        for i in 0..count {
            let at = Vec2::new(half * (1 + 2 * i) as f32 - end, 2.0);
            let plank = RigidBody::dynamic().position(at).shape(rect(half, thick)).mass(0.06);
            let plank = world.add_body(plank).expect("a plank");
            let hinge = JointDef::revolute().anchors(anchor, near);
            world.add_joint(before, plank, hinge).expect("a hinge");
            (before, anchor) = (plank, far);
        }
        let last = JointDef::revolute().anchors(anchor, Vec2::new(end, 2.0));
        world.add_joint(before, posts, last).expect("a hinge");
        for i in 0..2 {
            let at = Vec2::new(random.range(-0.5, 0.5) * end, 2.6 + 0.9 * i as f32);
            let size = random.range(0.15, 0.35);
            let load = RigidBody::dynamic().position(at).shape(rect(size, size));
            world.add_body(load.mass(0.06 * random.range(5.0, 60.0))).expect("a load");
        }
        worst.push(deepest(&mut world, 240) / thick);
    }
    let deep = worst.iter().filter(|&&depth| depth > 1.0).count();
    assert!(deep == 0, "{deep} of 40: {worst:.2?}");
}

/// How many of 200 showers of boxes and balls that bounce go deeper than 3 cm into anything, on a ground of some restitution.
fn deep_showers(ground: f32) -> usize {
    let mut random = Random::new(15);
    let mut deep = 0;
    for _ in 0..500 {
        let mut world = world();
        let floor = ShapeDef::new(rect(100.0, 1.0)).restitution(ground);
        let floor = RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(floor);
        world.add_body(floor).expect("a floor");
        for k in 0..12 {
            let (half, high) = (random.range(0.35, 0.6), random.range(0.35, 0.6));
            let round = random.range(0.0, 1.0) < 0.4;
            let shape = ShapeDef::new(if round { circle(half) } else { rect(half, high) });
            let place = Vec2::new(random.range(-5.0, 5.0), 4.0 + 1.25 * k as f32);
            let body = RigidBody::dynamic().position(place).shape(shape.restitution(0.5));
            world.add_body(body).expect("what falls");
        }
        deep += usize::from(deepest(&mut world, 180) > 0.03);
    }
    deep
}

/// At up to 20 m/s what is hit hits others within the step. It was 47 while hits were handed on as they were listed, and no
/// further than one alone throws; now it is 13, still too many.
#[test]
fn what_is_hit_and_hits_within_a_step_stays_out() {
    let deep = deep_showers(0.5);
    assert!(deep <= 40, "{deep} of 500");
}

/// What lies on a corner and is hit comes down on the other within the step: 81 before that was foreseen, now 19.
#[test]
fn what_is_hit_on_one_corner_does_not_sink_with_the_other() {
    let deep = deep_showers(0.0);
    assert!(deep <= 62, "{deep} of 500");
}

/// Bodies of one shape in five rows and columns that fly at as many of their kind.
fn crowds(random: &mut Random, half: f32) -> World {
    let mut world = World::new(Vec2::ZERO);
    let speed = random.range(10.0, 60.0);
    let (pitch, shift) = (half * random.range(2.02, 2.5), random.range(0.0, 0.5));
    let restitution = if random.range(0.0, 1.0) < 0.3 { 0.5 } else { 0.0 };
    let shape = match random.range(0.0, 4.0) as u32 {
        0 | 1 => rect(half, half),
        2 => rect(half, 0.4 * half),
        _ => circle(half),
    };
    for (side, i) in [-1.0, 1.0].into_iter().flat_map(|side| (0..25).map(move |i| (side, i))) {
        let (column, row) = ((i % 5) as f32, (i / 5) as f32);
        let x = side * (1.5 + column + random.range(0.0, 0.05));
        let y = row + shift * side + random.range(0.0, 0.05);
        let body = RigidBody::dynamic().position(Vec2::new(x, y) * pitch);
        let body = body.velocity(Vec2::new(-side * speed, 0.0)).restitution(restitution);
        world.add_body(body.shape(shape)).expect("one of a crowd");
    }
    world
}

/// In a crowd each hit throws bodies into others. Before hard hits were solved more often and hits of a step put each other
/// forward, 24 of 60 went deeper than a fifth of a body;
/// now it is 5, still too many.
#[test]
fn crowds_that_meet_stay_out_of_each_other() {
    let mut random = Random::new(16);
    let shares: Vec<_> = (0..60)
        .map(|_| {
            let half = random.range(0.2, 0.7);
            deepest(&mut crowds(&mut random, half), 60) / (2.0 * half)
        })
        .collect();
    let deep = shares.iter().filter(|&&share| share > 0.2).count();
    assert!(deep <= 8, "{deep} of 60: {shares:.2?}");
}

/// Crowds of two to nine U-shapes and Hs of densities up to 25 to 1, put into each other. What holds each other in pushes as hard as
/// it is deep, which is no load: where they were solved more finely for it, 46 of 400 such crowds had something go off at over 8 m/s,
/// now 8.
#[test]
fn what_holds_each_other_in_does_not_go_off() {
    let mut random = Random::new(31);
    let mut fastest = Vec::new();
    for _ in 0..400 {
        let mut world = world_with_floor();
        for x in [-2.0, 2.0] {
            let wall = RigidBody::fixed().position(Vec2::new(x, 20.0)).shape(rect(1.0, 20.0));
            world.add_body(wall).expect("a wall");
        }
        let thick = random.range(0.06, 0.12);
        for k in 0..2 + random.below(8) {
            let place = Vec2::new(random.range(-0.3, 0.3), 1.0 + 0.3 * k as f32);
            let mut body = RigidBody::dynamic().position(place).angle(random.range(-3.0, 3.0));
            let (size, density) =
                (random.range(0.2, 0.5), 0.2 * 25_f32.powf(random.range(0.0, 1.0)));
            let (web, flange) = (rect(thick, size), rect(size, thick));
            let parts = match random.below(2) {
                0 => [(flange, 0.0, -size), (web, -size, 0.0), (web, size, 0.0)],
                _ => [(flange, 0.0, -size), (web, 0.0, 0.0), (flange, 0.0, size)],
            };
            for (shape, x, y) in parts {
                body = body.shape(ShapeDef::new(shape).offset(Vec2::new(x, y)).density(density));
            }
            world.add_body(body).expect("a compound");
        }
        let mut most = 0.0_f32;
        for step in 0..1200 {
            world.step(DT);
            let speeds = world.bodies().map(|body| body.velocity().length());
            // By then all have fallen.
            most = if step < 120 { 0.0 } else { speeds.fold(most, f32::max) };
        }
        fastest.push(most);
    }
    let fast = fastest.iter().filter(|&&speed| speed > 8.0).count();
    assert!(fast <= 12, "{fast} of 400: {fastest:.1?}");
}

/// What lies on something light keeps its momentum: a load of 20 to 500 times a board's mass falls onto it, on ice, and a slab goes
/// on logs that roll. It lost a third of its speed to what it lay on.
#[test]
fn loads_keep_their_momentum_on_light_things() {
    for heavy in [20.0, 100.0, 500.0] {
        let mut world = world();
        let ice = RigidBody::fixed().position(Vec2::new(0.0, -1.0));
        world.add_body(ice.shape(ShapeDef::new(rect(200.0, 1.0)).friction(0.0))).expect("ice");
        let board = RigidBody::dynamic().position(Vec2::new(0.0, 0.1)).mass(1.0);
        let board = board.shape(ShapeDef::new(rect(2.0, 0.1)).friction(0.6));
        world.add_body(board).expect("a board");
        let load = RigidBody::dynamic().position(Vec2::new(-0.5, 0.9)).mass(heavy);
        let load = load.shape(ShapeDef::new(rect(0.3, 0.3)).friction(0.6));
        let load = world.add_body(load.velocity(Vec2::new(3.0, 0.0))).expect("a load");
        (0..120).for_each(|_| world.step(DT));
        let speed = world.body(load).expect("it is there").velocity().x;
        let real = 3.0 * heavy / (heavy + 1.0);
        assert!((0.94 * real..1.001 * real).contains(&speed), "ice, {heavy}: {speed} of {real}");
    }
    for (heavy, least) in [(20.0, 2.05), (100.0, 2.4), (500.0, 2.4)] {
        let mut world = world_with_floor();
        for k in 0..9 {
            let place = Vec2::new(-2.0 + 0.7 * k as f32, 0.2);
            let log = RigidBody::dynamic().position(place).mass(1.0);
            world.add_body(log.shape(circle(0.2))).expect("a log");
        }
        let slab = RigidBody::dynamic().position(Vec2::new(-0.6, 0.52)).mass(heavy);
        let slab = slab.shape(rect(1.2, 0.1)).velocity(Vec2::new(3.0, 0.0));
        let slab = world.add_body(slab).expect("a slab");
        let first = energy(&world);
        for _ in 0..60 {
            world.step(DT);
            let now = energy(&world);
            assert!(now < first, "logs, {heavy}: {first} to {now} J");
        }
        let speed = world.body(slab).expect("it is there").velocity().x;
        assert!(speed > least, "logs, {heavy}: {speed}");
    }
}
