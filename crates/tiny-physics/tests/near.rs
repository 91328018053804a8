//! Near misses: what passes a corner without touching it is left alone.

mod common;

use common::{DT, Random, rect, velocity};
use tiny_physics::{JointDef, RigidBody, Shape, ShapeDef, Vec2, World};

fn smooth(shape: Shape) -> ShapeDef {
    ShapeDef::new(shape).friction(0.0)
}

fn block(world: &mut World, x: f32, y: f32, half: Vec2) {
    let block = RigidBody::fixed().position(Vec2::new(x, y)).shape(smooth(rect(half.x, half.y)));
    world.add_body(block).unwrap();
}

#[test]
fn what_passes_a_corner_is_left_alone() {
    for seed in 0..600 {
        let mut random = Random::new(seed);
        let mut world = World::new(Vec2::ZERO);
        let (speed, clear) = (50.0_f32.powf(random.range(0.0, 1.0)), random.range(0.001, 0.015));
        block(&mut world, 1.5 + clear, 0.0, Vec2::new(1.0, 0.5));
        let corners = [(-0.5, -0.2), (0.0, -0.5), (0.5, 0.0), (0.0, 0.5)].map(Vec2::from);
        let shape = match seed % 3 {
            0 => rect(0.5, 0.5),
            1 => Shape::circle(0.5).unwrap(),
            _ => Shape::hull(&corners).unwrap(),
        };
        let start = Vec2::new(0.0, 1.3 + random.range(0.0, 1.0) * speed * DT);
        let way = Vec2::new(0.0, -speed);
        let body = RigidBody::dynamic().position(start).shape(smooth(shape)).velocity(way);
        let body = world.add_body(body).unwrap();
        (0..(3.0 / speed / DT) as u32 + 4).for_each(|_| world.step(DT));
        let turned = (velocity(&world, body) - way).length() / speed;
        assert!(turned < 0.01, "{seed}: {turned} at {speed} m/s, {clear} m apart");
    }
}

/// A lift that ledges of its shaft stopped, and a crate under beams that did.
#[test]
fn what_is_guided_past_corners_keeps_its_speed() {
    for seed in 0..40 {
        let mut random = Random::new(seed);
        let (speed, clear) = (random.range(0.5, 5.0), random.range(0.002, 0.015));
        let mut world = World::new(if seed % 2 == 0 { Vec2::ZERO } else { Vec2::Y * -10.0 });
        let cab = RigidBody::dynamic().shape(smooth(rect(0.5, 0.5)));
        let cab = world.add_body(cab).unwrap();
        let along = if seed % 2 == 0 { Vec2::Y } else { Vec2::X };
        let ground = world.add_body(RigidBody::fixed()).unwrap();
        if seed % 2 == 0 {
            world.add_joint(ground, cab, JointDef::prismatic(along)).unwrap();
        } else {
            block(&mut world, 0.0, -1.0, Vec2::new(50.0, 0.5));
        }
        for i in 0..10 {
            let (on, off) = (1.3 + 0.77 * i as f32, 1.0 + clear);
            let (x, y) = if seed % 2 == 0 { (off, on) } else { (on, off) };
            let half = if seed % 2 == 0 { Vec2::new(0.5, 0.1) } else { Vec2::new(0.1, 0.5) };
            block(&mut world, x, y, half);
        }
        world.body_mut(cab).unwrap().set_velocity(along * speed);
        (0..(10.0 / speed / DT) as u32).for_each(|_| world.step(DT));
        let kept = velocity(&world, cab).dot(along) / speed;
        assert!((kept - 1.0).abs() < 0.01, "{seed}: {kept} of {speed} m/s, {clear} m apart");
    }
}

/// A ball lost a third of its speed over fifteen slits.
#[test]
fn a_ball_rolls_over_slits() {
    for (speed, slit) in [1.0, 2.0, 3.0, 5.0, 10.0].iter().flat_map(|v| [(*v, 0.0025), (*v, 0.004)])
    {
        let mut world = World::new(Vec2::Y * -10.0);
        block(&mut world, -5.0, -0.25, Vec2::new(5.0, 0.25));
        (0..15).for_each(|i| {
            let x = slit + 0.25 + (0.5 + slit) * i as f32;
            block(&mut world, x, -0.25, Vec2::new(0.25, 0.25));
        });
        let start = Vec2::new(-1.0, 0.5);
        let ball = RigidBody::dynamic().position(start).shape(smooth(Shape::circle(0.5).unwrap()));
        let ball = world.add_body(ball.velocity(Vec2::X * speed)).unwrap();
        let mut highest = 0.0_f32;
        while world.body(ball).unwrap().position().x < 7.4 {
            world.step(DT);
            highest = highest.max(world.body(ball).unwrap().position().y);
        }
        let kept = velocity(&world, ball).x / speed;
        assert!((kept - 1.0).abs() < 0.005 && highest < 0.502, "{slit} {speed}: {kept} {highest}");
    }
}
