//! What hooks see, and what is left of what they say.

mod common;

use common::{rect, steps, velocity, world, world_with_floor};
use std::sync::{Arc, Mutex};
use tiny_physics::{RigidBody, Vec2, World};

/// Rules of a hook end with it: a frame that was written under one goes on without. Before, a crate on a belt that the hook had made ran
/// on at 2 m/s for as long as it touched the floor.
#[test]
fn the_rules_of_a_hook_do_not_stay_in_a_frame() {
    let mut world = world_with_floor();
    let crate_ = RigidBody::dynamic().position((0.0, 0.5)).shape(rect(0.5, 0.5));
    let crate_ = world.add_body(crate_).expect("a crate");
    world.set_pre_solve(|_, _, rules| rules.tangent_speed = 2.0);
    steps(&mut world, 60);
    let frame = world.to_bytes();
    let mut loaded = World::from_bytes(&frame).expect("a frame");
    let mut restored = self::world();
    restored.restore_bytes(&frame).expect("a frame");
    for other in [&mut loaded, &mut restored] {
        steps(other, 120);
        assert!(velocity(other, crate_).x.abs() < 0.01, "{:?}", velocity(other, crate_));
    }
    // With the hook it goes on as the world did.
    let mut again = World::from_bytes(&frame).expect("a frame");
    again.set_pre_solve(|_, _, rules| rules.tangent_speed = 2.0);
    world.set_pre_solve(|_, _, rules| rules.tangent_speed = 2.0);
    for _ in 0..30 {
        steps(&mut world, 1);
        steps(&mut again, 1);
        assert_eq!(world.state_hash(), again.state_hash());
    }
}

/// Light crates under a heavy one count as heavier in a step, and weigh as much as before; hooks see what was set. Before, one saw a
/// gravity scale of .002 in place of 1.
#[test]
fn hooks_see_the_gravity_scale_that_was_set() {
    let mut world = world_with_floor();
    for i in 0..3 {
        let light = RigidBody::dynamic().position(Vec2::new(0.0, 0.2 + 0.4 * i as f32)).mass(0.1);
        world.add_body(light.shape(rect(0.2, 0.2))).expect("a light crate");
    }
    let heavy = RigidBody::dynamic().position((0.0, 2.5)).velocity((0.0, -8.0)).mass(100.0);
    world.add_body(heavy.shape(rect(0.5, 0.5))).expect("a heavy crate");
    let seen = Arc::new(Mutex::new(Vec::new()));
    let told = seen.clone();
    world.set_pre_solve(move |world, contact, _| {
        let scales = [contact.body_a, contact.body_b].map(|body| world.body(body).expect("a body"));
        let scales = scales.map(|body| body.gravity_scale());
        told.lock().expect("no panic").extend(scales);
    });
    steps(&mut world, 240);
    let seen = seen.lock().expect("no panic");
    assert!(seen.len() > 100 && seen.iter().all(|scale| *scale == 1.0));
}
