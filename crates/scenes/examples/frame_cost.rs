//! What frames cost: `cargo run --release -p tiny-physics-scenes --example frame_cost`.

use std::hint::black_box;
use std::time::Instant;
use tiny_physics::{RigidBody, Shape, ShapeDef, Vec2, World};

/// Side by side in columns: 10,000 boxes that all touch.
fn pile() -> World {
    let mut world = World::new(Vec2::new(0.0, -9.8));
    let ground = RigidBody::fixed().shape(Shape::rect(200.0, 1.0).expect("a box"));
    world.add_body(ground.position(Vec2::new(0.0, -1.0))).expect("ground");
    for i in 0..10_000 {
        let place = Vec2::new((i % 200) as f32 - 100.0, 0.5 + (i / 200) as f32);
        let shape = ShapeDef::new(Shape::rect(0.5, 0.5).expect("a box"));
        world.add_body(RigidBody::dynamic().position(place).shape(shape)).expect("a crate");
    }
    (0..20).for_each(|_| world.step(1.0 / 60.0));
    world
}

/// The fastest of many runs, milliseconds.
fn time(mut work: impl FnMut()) -> f64 {
    let run = |work: &mut dyn FnMut()| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64() * 1.0e3
    };
    (0..40).map(|_| run(&mut work)).fold(f64::INFINITY, f64::min)
}

fn main() {
    let world = pile();
    let bytes = world.to_bytes();
    let (mut frame, mut copy) = (world.clone(), bytes.clone());
    println!("{} bodies, {} contacts", world.body_count(), world.contact_count());
    println!("bytes a body: {:.0}", bytes.len() as f64 / world.body_count() as f64);
    println!(
        "memory copy of as many bytes: {:.2} ms",
        time(|| copy.copy_from_slice(black_box(&bytes)))
    );
    println!("clone_from: {:.2} ms", time(|| frame.clone_from(black_box(&world))));
    println!("clone: {:.2} ms", time(|| drop(black_box(world.clone()))));
    println!("to_bytes: {:.2} ms", time(|| drop(black_box(world.to_bytes()))));
    println!("from_bytes: {:.2} ms", time(|| drop(black_box(World::from_bytes(&bytes)))));
    println!("restore_bytes: {:.2} ms", time(|| _ = black_box(frame.restore_bytes(&bytes))));
    println!("state_hash: {:.2} ms", time(|| _ = black_box(world.state_hash())));
}
