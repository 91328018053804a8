//! Threads: a pool that works through the stages of a step, and slices that its members share.
//!
//! This is the only module with `unsafe`; each block states why it is sound.
//!
//! - [`Pool`] keeps threads between steps. [`Pool::scope`] opens a *section*, one step of one world,
//!   and gives the step a [`Team`]. The step's own thread is a member of the team.
//! - A [`Team`] runs *stages*: loops over chunks of an index range. A stage ends when all its chunks are
//!   done, so every stage sees all that the stages before it wrote.
//! - [`SharedSlice`] is for stages that reach elements by index, such as the bodies of a constraint.
//!
//! Which thread runs a chunk is left to chance, so nothing may depend on it: chunks are cut by length
//! alone, and what they give back is kept in chunk order. Results are then the same for any number of
//! threads, and with feature `parallel` off, and on wasm, where everything runs on the calling thread.
//!
//! # How a stage is shared out
//!
//! Each member has a seat with a range of chunks, the same share of every stage of equal length, so that
//! its cache keeps what it worked on in the stage before. A member takes chunks from the front of its own
//! seat, then from the back of others. The caller waits for the chunks, never for the members: a worker
//! that the operating system has put aside between chunks delays nobody.
//!
//! Workers without work spin, then yield, then park; so they are hot within a step and asleep between
//! frames. The first stage of a section with more than one chunk wakes them.
//!
//! A [`Habit`] tries now and then whether work that comes again in every step takes less time alone, and keeps to that.
//!
//! # What it costs
//!
//! Two virtual Zen 5 cores, both also used by others, so ranges; rayon 1.x beside it in one process:
//!
//! | nanoseconds | 1 thread | 2 threads | 4 threads on 2 cores | rayon, 2 threads |
//! |---|---|---|---|---|
//! | section without a stage | 1 | 6 | 6 | |
//! | empty stage, a chunk each | 1 | 25-150 | 40-135 | 105-120 (`scope`) |
//! | empty stage, 64 chunks | 34 | 400-1,150 | 400-1,350 | 1,400-1,650 (`par_iter`) |
//! | stage in which all members meet | 31 | 140-300 (1,400 in one run) | a time slice | 610-700 (`scope`) |
//! | first stage after 16 ms of rest | 280 | 9,500-13,000 | 17,000-24,000 | 44,000-139,000 |
//!
//! A rested section's first stage costs its caller one wake-up of the operating system, which takes
//! long on virtual cores. Waking all workers from the caller instead cost 36,000-52,000 with 4 threads.
//! How soon a woken worker gets a core of its own is the system's choice; on that machine two threads
//! often shared a core for the first 0.3 ms, in which the caller does the work alone. Rayon was rejected
//! for its cost a stage, twice to four times as much where all take part, and for its size.
#![allow(unsafe_code)]

#[cfg(not(all(feature = "parallel", target_has_atomic = "64", not(target_family = "wasm"))))]
#[path = "crew_of_none.rs"]
mod crew;
#[cfg(all(feature = "parallel", target_has_atomic = "64", not(target_family = "wasm")))]
mod crew;
mod habit;
mod pool;
#[cfg(tiny_physics_race)]
mod race;
mod shared;
#[cfg(test)]
mod tests;

pub(crate) use habit::Habit;
pub(crate) use pool::{Pool, Team};
pub(crate) use shared::{RowsAt, SharedRows, SharedSlice};
