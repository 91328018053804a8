//! Saving and restoring: a copy in memory to roll back to, bytes for a file, and a hash to compare by.
//! `cargo run -p tiny-physics --example frames`

use tiny_physics::{Error, RigidBody, Shape, Vec2, World};

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    world.add_body(RigidBody::fixed().shape(Shape::rect(20.0, 0.5)?))?;
    for i in 0..50 {
        let place = Vec2::new((i % 7) as f32 - 3.0, 2.0 + i as f32 * 0.7);
        let shape = if i % 2 == 0 { Shape::circle(0.4)? } else { Shape::rect(0.4, 0.3)? };
        world.add_body(RigidBody::dynamic().position(place).shape(shape))?;
    }
    for _ in 0..60 {
        world.step(1.0 / 60.0);
    }

    // A world is a value: a clone is a frame.
    let frame = world.clone();
    let bytes = world.to_bytes();
    let future = |world: &mut World| {
        for _ in 0..120 {
            world.step(1.0 / 60.0);
        }
        world.state_hash()
    };
    let first = future(&mut world);

    // Rollback: the same world goes back in place, without allocating, and runs into the same future.
    world.clone_from(&frame);
    assert_eq!(future(&mut world), first);

    // From a file, on another machine, with other threads: the same bits.
    let mut loaded = World::from_bytes(&bytes)?;
    loaded.set_threads(4);
    assert_eq!(future(&mut loaded), first);
    println!("{} bytes for {} bodies; future {first:016x}", bytes.len(), world.body_count());

    // One byte wrong: refused, not half read.
    let mut damaged = bytes;
    let middle = damaged.len() / 2;
    damaged[middle] ^= 1;
    println!("damaged: {}", World::from_bytes(&damaged).unwrap_err());
    Ok(())
}
