//! Whole steps on several threads, small enough for Miri, which looks for data races and for accesses that the
//! `unsafe` of the pool and its slices must not make.

use super::*;

/// Balls in a lattice that touch all around: enough for more than one chunk in most stages.
fn lattice(threads: usize) -> World {
    let mut world = world();
    world.settings.substeps = 1;
    world.set_threads(threads);
    add_ground(&mut world);
    for i in 0..400_u16 {
        let (column, row) = (f32::from(i % 40), f32::from(i / 40));
        add(&mut world, column - 20.0, 0.5 + 0.99 * row, circle(0.5));
    }
    world
}

#[test]
fn a_step_on_three_threads_has_no_race_and_the_same_bits() {
    let hash = |threads, steps| {
        let mut world = lattice(threads);
        (0..steps).for_each(|_| world.step(DT));
        assert!(world.contact_count() > 600, "{}", world.contact_count());
        world.state_hash()
    };
    if cfg!(miri) {
        // One step goes through all stages, and takes minutes there.
        hash(3, 1);
    } else {
        assert_eq!(hash(3, 2), hash(1, 2));
    }
}
