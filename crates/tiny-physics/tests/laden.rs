//! Light things under heavy ones: they rest, and what moves them meets their own mass.

mod common;

use common::*;
use tiny_physics::{BodyId, RigidBody, Shape, ShapeDef, Vec2, World};

fn world(size: f32) -> World {
    let mut world = World::new(Vec2::new(0.0, -10.0 * size));
    world.settings.length_unit = size;
    let floor = Shape::rect(50.0 * size, size).unwrap();
    let floor = RigidBody::fixed().shape(floor).position(Vec2::new(0.0, -size));
    world.add_body(floor).unwrap();
    world
}

fn place(world: &World, body: BodyId, size: f32) -> [f32; 2] {
    let p = world.body(body).unwrap().position();
    [p.x / size, p.y / size]
}

/// Four to twelve crates under 550 to 1,000 times their mass bounced for ever or were thrown about in 17 of 24.
#[test]
fn crates_under_heavy_loads_come_to_rest() {
    let mut random = Random::new(21);
    for case in 0..24 {
        let size = [1.0, 0.05, 20.0][case % 3];
        let mut world = world(size);
        let (mut crates, mut top) = (Vec::new(), 0.0);
        let count = 4 + random.below(9) as usize;
        for level in 0..=count {
            let half = 0.5 * size * random.range(0.9, 1.1);
            let mass = if level == count { random.range(550.0, 1000.0) } else { 1.0 };
            let at = Vec2::new(random.range(-0.04, 0.04) * size, top + half);
            let square = ShapeDef::new(Shape::rect(half, half).unwrap());
            let body = RigidBody::dynamic().shape(square).mass(mass).position(at);
            crates.push((world.add_body(body).unwrap(), at * (1.0 / size)));
            top += 2.0 * half;
        }
        // Every second one under steps that vary: held against what its own mass would sink, it swayed for ever.
        let vary = if case % 2 == 0 { 1.0 } else { 1.25 };
        (0..180).for_each(|_| world.step(DT * random.range(1.0 / vary, vary)));
        assert_eq!(world.awake_body_count(), 0, "case {case}");
        for (body, at) in crates {
            let [x, y] = place(&world, body, size);
            assert!((x - at.x).abs() < 0.01 && (y - at.y).abs() < 0.005, "case {case}: {x} {y}");
        }
    }
}

/// A slab of a hundred times the mass of the three rollers below it goes off as these let it.
#[test]
fn a_slab_on_rollers_gets_going_as_light_rollers_let_it() {
    for size in [1.0, 20.0] {
        let mut world = world(size);
        for x in [-1.0, 0.0, 1.0] {
            let disk = ShapeDef::new(Shape::circle(0.25 * size).unwrap()).friction(0.9);
            let at = Vec2::new(x * size, 0.25 * size);
            world.add_body(RigidBody::dynamic().shape(disk).mass(1.0).position(at)).unwrap();
        }
        let slab = ShapeDef::new(Shape::rect(2.0 * size, 0.1 * size).unwrap()).friction(0.9);
        let at = Vec2::new(0.0, 0.6 * size);
        let slab = RigidBody::dynamic().shape(slab).mass(100.0).position(at);
        let slab = world.add_body(slab).unwrap();
        steps(&mut world, 20);
        for _ in 0..60 {
            world.body_mut(slab).unwrap().apply_force_to_center(Vec2::new(100.0 * size, 0.0));
            world.step(DT);
        }
        let speed = world.body(slab).unwrap().velocity().x / size;
        assert!((0.8..1.02).contains(&speed), "unit {size}: {speed} m/s in a second");
    }
}

/// A hammer of 20 kg meets a block of 1 kg under half a ton, not a quarter of that ton.
#[test]
fn a_block_under_a_heavy_load_is_as_light_to_who_strikes_it() {
    let mut world = world(1.0);
    let block = ShapeDef::new(Shape::rect(0.5, 0.25).unwrap()).friction(0.1);
    for y in [0.25, 0.75] {
        let at = Vec2::new(0.0, y);
        world.add_body(RigidBody::dynamic().shape(block.clone()).mass(1.0).position(at)).unwrap();
    }
    let load = Shape::rect(0.5, 0.5).unwrap();
    let at = Vec2::new(0.0, 1.5);
    world.add_body(RigidBody::dynamic().shape(load).mass(500.0).position(at)).unwrap();
    steps(&mut world, 60);
    let hammer = Shape::rect(0.2, 0.1).unwrap();
    let hammer = RigidBody::dynamic().shape(hammer).mass(20.0).position(Vec2::new(-0.75, 0.25));
    let hammer = world.add_body(hammer).unwrap();
    world.body_mut(hammer).unwrap().set_velocity(Vec2::new(10.0, 0.0));
    steps(&mut world, 3);
    let speed = world.body(hammer).unwrap().velocity().x;
    assert!(speed > 5.0, "{speed} m/s");
}

/// What a heavy ball that rocks on it leaves goes off no faster than that moves.
#[test]
fn nothing_is_shot_out_from_under_what_rocks_on_it() {
    let mut random = Random::new(5);
    for case in 0..40 {
        let mut world = world(1.0);
        let crate_below = Shape::rect(0.4, 0.4).unwrap();
        let at = Vec2::new(0.0, 0.4);
        let light = RigidBody::dynamic().shape(crate_below).mass(1.0).position(at);
        let light = world.add_body(light).unwrap();
        let ball = Shape::circle(0.8).unwrap();
        let at = Vec2::new(random.range(-0.8, 0.8), 1.7 + random.range(0.0, 2.0));
        let mass = random.range(60.0, 500.0);
        world.add_body(RigidBody::dynamic().shape(ball).mass(mass).position(at)).unwrap();
        for _ in 0..180 {
            world.step(DT);
            let speed = world.body(light).unwrap().velocity().length();
            assert!(speed < 5.0, "case {case}: {speed} m/s");
        }
    }
}
