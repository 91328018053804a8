//! Any bytes as a saved world (without its hash, see `cfg(fuzzing)`): refused, or a world that can be used.
#![no_main]

use libfuzzer_sys::fuzz_target;
use tiny_physics::World;

fuzz_target!(|bytes: &[u8]| {
    let Ok(mut world) = World::from_bytes(bytes) else { return };
    world.settings.substeps = world.settings.substeps.min(4);
    world.settings.iterations = world.settings.iterations.min(4);
    (0..2).for_each(|_| world.step(1.0 / 60.0));
    let bodies: Vec<_> = world.body_ids().collect();
    bodies.into_iter().for_each(|id| world.remove_body(id).expect("a live body"));
    world.step(1.0 / 60.0);
});
