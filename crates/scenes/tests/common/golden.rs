//! The hash of a scene's run: shared by the golden test and the program that other platforms run.

use tiny_physics::SimdLevel;
use tiny_physics_scenes::{Entry, Options, Run};

/// Runs a scene and hashes its end, with the events on the way mixed in.
pub fn hash(entry: &Entry, steps: u32, level: SimdLevel, threads: usize) -> u64 {
    let mut run = Run::start(&entry.build(Options::default())).expect(entry.name);
    run.world_mut().set_simd(level).expect("the level is there");
    run.world_mut().set_threads(threads);
    let mut hash = 0_u64;
    for _ in 0..steps {
        run.step();
        let events = run.world().events();
        let ends = events.contact_end().iter().map(|end| (end.shape_a, end.shape_b));
        let begins = events.contact_begin().iter().map(|begin| (begin.shape_a, begin.shape_b));
        for (a, b) in begins.chain(ends) {
            hash = hash.rotate_left(5) ^ ((a.index() as u64) << 32 | b.index() as u64);
        }
    }
    hash ^ run.world().state_hash()
}
