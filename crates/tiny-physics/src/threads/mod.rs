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
#![allow(unsafe_code)]

#[cfg(not(all(feature = "parallel", target_has_atomic = "64", not(target_family = "wasm"))))]
#[path = "crew_of_none.rs"]
mod crew;
#[cfg(all(feature = "parallel", target_has_atomic = "64", not(target_family = "wasm")))]
mod crew;
mod pool;
#[cfg(debug_assertions)]
mod race;
mod shared;
#[cfg(test)]
mod tests;

pub(crate) use pool::{Pool, Team};
pub(crate) use shared::{SharedRows, SharedSlice};
