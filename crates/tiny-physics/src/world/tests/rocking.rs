//! What rocks on something round: it swings no further than it did, and comes to rest.

use super::*;
use crate::describe::ChainDef;

/// A plank in its balance on a fixed ball but for some radians, which it has rolled.
fn plank_on_a_ball(world: &mut World, half_length: f32, angle: f32) -> BodyId {
    let (radius, half) = (0.5, 0.05);
    world.add_body(RigidBody::fixed().shape(circle(radius))).unwrap();
    let (sin, cos) = angle.sin_cos();
    let (out, along) = (Vec2::new(-sin, cos), Vec2::new(cos, sin));
    let place = out * (radius + half) + along * (radius * angle);
    let plank = RigidBody::dynamic().position(place).angle(angle);
    world.add_body(plank.shape(rect(half_length, half).friction(1.0))).unwrap()
}

#[test]
fn a_plank_on_a_ball_swings_no_further() {
    let mut world = world();
    let plank = plank_on_a_ball(&mut world, 0.3, 0.1);
    let mut furthest = 0.0_f32;
    for _ in 0..75 {
        world.step(DT);
        furthest = furthest.max(world.body(plank).unwrap().angle().abs());
    }
    assert!(furthest < 0.105, "{furthest} rad");
}

#[test]
fn what_rocks_comes_to_rest_and_what_rolls_goes_on() {
    let mut world = world();
    let plank = plank_on_a_ball(&mut world, 1.0, 0.2);
    let ground = RigidBody::fixed().position(Vec2::new(0.0, -11.0)).shape(rect(50.0, 1.0));
    world.add_body(ground).unwrap();
    let ball = RigidBody::dynamic().position(Vec2::new(0.0, -9.5)).velocity(Vec2::new(0.2, 0.0));
    let ball = world.add_body(ball.angular_velocity(-0.4).shape(circle(0.5))).unwrap();
    run(&mut world, 900);
    let plank = world.body(plank).unwrap();
    assert!(!plank.is_awake() && plank.angle().abs() < 0.01, "{} rad", plank.angle());
    assert!((world.body(ball).unwrap().velocity().x - 0.2).abs() < 0.001);
}

#[test]
fn what_tips_slowly_falls() {
    let mut world = world();
    add_ground(&mut world);
    let post = RigidBody::dynamic().position(Vec2::new(0.1, 1.005)).angle(-0.12);
    let post = world.add_body(post.shape(rect(0.1, 1.0))).unwrap();
    run(&mut world, 300);
    assert!(y(&world, post) < 0.15, "it hangs in the air at {} m", y(&world, post));
}

/// A ball that is let go beside the middle of a bowl swings as long as nothing brakes it.
#[test]
fn a_ball_in_a_bowl_swings_on() {
    let mut world = world();
    let ground = world.add_body(RigidBody::fixed()).unwrap();
    let points: Vec<Vec2> = (-60..=60)
        .map(|k| {
            let (sin, cos) = (-0.01 * k as f32).sin_cos();
            Vec2::new(4.2 * sin, 4.2 - 4.2 * cos)
        })
        .collect();
    world.add_chain(ground, &ChainDef::open(&points).friction(1.0)).unwrap();
    let place = Vec2::new(4.0 * 0.06_f32.sin(), 4.2 - 4.0 * 0.06_f32.cos());
    let ball = RigidBody::dynamic().position(place).shape(circle(0.2).friction(1.0));
    let ball = world.add_body(ball.can_sleep(false)).unwrap();
    let mut furthest = 0.0_f32;
    for step in 0..1500 {
        world.step(DT);
        let x = world.body(ball).unwrap().position().x;
        furthest = if step < 1100 { 0.0 } else { furthest.max(x.abs()) };
    }
    assert!((furthest - place.x).abs() < 0.15 * place.x, "{furthest} of {}", place.x);
}
