//! The pool under load: many stages, more threads than cores, panics, clones.

use super::{Pool, SharedSlice, Team};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Numbers of threads to try: one, some, more than there are cores.
const THREAD_COUNTS: [usize; 5] = [0, 1, 2, 3, 9];

/// Miri walks through every operation, so it gets short tests.
const MIRI: bool = cfg!(miri);

/// Many stages that each depend on the one before, over slices and shared slices.
fn mix(team: &Team<'_>, len: usize, stage_count: u32) -> Vec<u64> {
    let mut now: Vec<u64> = (0..len as u64).collect();
    let mut next = now.clone();
    for stage in 0..stage_count {
        let chunk_len = 1 + stage as usize % 7;
        {
            let (now, next) = (&now, SharedSlice::new(&mut next));
            team.for_each_chunk(len, chunk_len, |range| {
                for i in range {
                    let other = now[(i * 7 + stage as usize) % len];
                    next.write(i as u32, now[i].wrapping_mul(6_364_136_223_846_793_005) ^ other);
                }
            });
        }
        let next = &next;
        team.for_each_chunk_mut(&mut now, chunk_len, |index, now| {
            for (a, b) in now.iter_mut().zip(&next[index * chunk_len..]) {
                *a = b.wrapping_add(index as u64);
            }
        });
    }
    now
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let (len, stage_count, repeats) = match MIRI {
        true => (23, 3, 1),
        false if cfg!(tiny_physics_race) => (131, 300, 3),
        false => (131, 3000, 3),
    };
    let expected = mix(&Team::alone(), len, stage_count);
    for thread_count in THREAD_COUNTS {
        let pool = Pool::new(thread_count);
        for _ in 0..repeats {
            assert_eq!(pool.scope(|team| mix(team, len, stage_count)), expected);
        }
    }
}

#[test]
fn every_index_is_visited_once_in_ranges_of_the_chunk_length() {
    for thread_count in THREAD_COUNTS {
        let pool = Pool::new(thread_count);
        let many = if MIRI { 70 } else { 1000 };
        for (len, chunk_len) in [(0, 4), (1, 4), (4, 4), (5, 4), (many, 1), (many, 0), (many, 33)] {
            let visits: Vec<_> = (0..len).map(|_| AtomicUsize::new(0)).collect();
            pool.scope(|team| {
                team.for_each_chunk(len, chunk_len, |range| {
                    assert_eq!(range.start % chunk_len.max(1), 0);
                    assert!(range.len() == chunk_len.max(1) || range.end == len);
                    visits[range].iter().for_each(|v| {
                        v.fetch_add(1, Ordering::Relaxed);
                    });
                });
            });
            assert!(visits.iter().all(|v| v.load(Ordering::Relaxed) == 1));
        }
    }
}

#[test]
fn blocks_come_with_their_index() {
    for thread_count in THREAD_COUNTS {
        let mut a = vec![0; 23];
        let mut b = a.clone();
        Pool::new(thread_count).scope(|team| {
            team.for_each_chunk_mut(&mut a, 5, |index, block| block.fill(index));
            let shared = SharedSlice::new(&mut b);
            team.for_each_chunk(23, 4, |range| shared.range(range.clone()).fill(range.start / 4));
        });
        assert!((0..23).all(|i| a[i] == i / 5 && b[i] == i / 4));
    }
}

#[test]
fn outputs_come_in_chunk_order_and_keep_their_memory() {
    let pool = Pool::new(3);
    let mut outputs: Vec<Vec<usize>> = Vec::new();
    pool.scope(|team| {
        for len in [100, 9, 57] {
            let parts = team.map_chunks(len, 8, &mut outputs, |range, output| {
                output.clear();
                output.extend(range.filter(|i| i % 3 == 0));
            });
            let expected: Vec<_> = (0..len).step_by(3).collect();
            assert_eq!(parts.concat(), expected);
        }
    });
    assert_eq!(outputs.len(), 13);
}

#[test]
fn a_section_within_a_section_runs_on_its_caller() {
    let pool = Pool::new(2);
    let sum = AtomicUsize::new(0);
    pool.scope(|team| {
        team.for_each_chunk(8, 1, |outer| {
            pool.scope(|inner| {
                assert_eq!(inner.member_count(), 1);
                inner.for_each_chunk(10, 3, |range| {
                    sum.fetch_add(range.sum::<usize>() + outer.start, Ordering::Relaxed);
                });
            });
        });
    });
    assert_eq!(sum.into_inner(), 8 * 45 + 28 * 4);
}

#[test]
fn the_panic_of_the_lowest_chunk_reaches_the_caller_and_the_pool_lives_on() {
    for thread_count in THREAD_COUNTS {
        let pool = Pool::new(thread_count);
        for _ in 0..if MIRI { 1 } else { 20 } {
            let section = AssertUnwindSafe(|| {
                pool.scope(|team| {
                    team.for_each_chunk(40, 1, |range| {
                        assert!(range.start < 7, "chunk {}", range.start);
                    });
                });
            });
            let panic = catch_unwind(section).expect_err("chunks panic");
            assert_eq!(panic.downcast_ref::<String>().map(String::as_str), Some("chunk 7"));
        }
        let mut values = vec![0; 100];
        let member_count = pool.scope(|team| {
            team.for_each_chunk_mut(&mut values, 3, |_, block| block.fill(1));
            team.member_count()
        });
        assert_eq!(member_count, pool.thread_count());
        assert_eq!(values, [1; 100]);
    }
}

#[test]
fn a_panic_between_stages_frees_the_pool() {
    let pool = Pool::new(2);
    let section = AssertUnwindSafe(|| pool.scope(|_| panic!("between stages")));
    assert!(catch_unwind(section).is_err());
    assert_eq!(pool.scope(|team| team.member_count()), pool.thread_count());
}

#[test]
fn clones_on_several_threads_work_at_once() {
    let (rounds, stage_count) = if MIRI { (2, 8) } else { (10, 100) };
    let pool = Pool::new(2);
    let expected = mix(&Team::alone(), 64, stage_count);
    std::thread::scope(|scope| {
        for _ in 0..4 {
            let pool = pool.clone();
            let expected = &expected;
            scope.spawn(move || {
                for _ in 0..rounds {
                    assert_eq!(&pool.scope(|team| mix(team, 64, stage_count)), expected);
                }
            });
        }
    });
}

#[test]
fn pools_come_and_go_while_their_workers_start() {
    for thread_count in 0..if MIRI { 12 } else { 60 } {
        let pool = Pool::new(thread_count % 6);
        if thread_count % 2 == 0 {
            assert_eq!(pool.scope(|team| mix(team, 5, 3)), mix(&Team::alone(), 5, 3));
        }
    }
}

#[test]
fn a_pool_can_be_shared_and_sent() {
    fn check<T: Clone + Send + Sync + Default + std::fmt::Debug>() {}
    check::<Pool>();
    assert_eq!(format!("{:?}", Pool::default()), "Pool { thread_count: 1 }");
}

#[cfg(all(tiny_physics_race, feature = "parallel", not(target_family = "wasm")))]
#[test]
#[should_panic = "two chunks of one stage touch element 5"]
fn chunks_that_write_the_same_element_are_found() {
    let mut values = [0; 10];
    let shared = SharedSlice::new(&mut values);
    Pool::new(2).scope(|team| {
        team.for_each_chunk(4, 1, |range| {
            // Chunks 1 and 3 meet.
            shared.write([0, 5, 6, 5][range.start], 1);
        });
    });
}
