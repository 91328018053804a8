//! The pool and the team: how stages use threads.

use super::crew::{Crew, Section};
use super::shared::SharedBlocks;
use core::fmt;
use core::marker::PhantomData;
use core::ops::Range;
use std::sync::Arc;

/// Threads that outlive the steps they work in. Clones share them; they end with the last clone.
///
/// A pool serves one section at a time. While it is taken, by another clone's step or by the very
/// step that asks, a section runs on its caller alone, with the same results.
#[derive(Clone, Default)]
pub(crate) struct Pool {
    crew: Option<Arc<Crew>>,
}

/// The members that work on a section: its caller, and the pool's workers if it got them.
pub(crate) struct Team<'a> {
    section: Option<Section<'a>>,
    member_count: usize,
    /// Not `Sync`, on any platform: no stage can start a stage.
    not_sync: PhantomData<*const ()>,
}

impl Pool {
    /// A pool of the calling thread and `thread_count - 1` workers: fewer where the system grants fewer,
    /// none with feature `parallel` off or on wasm. Zero counts as one, and 64 is the most.
    pub(crate) fn new(thread_count: usize) -> Self {
        Self { crew: Crew::hire(thread_count).map(Arc::new) }
    }

    /// Number of threads that a section can use, its caller with them.
    pub(crate) fn thread_count(&self) -> usize {
        self.crew.as_ref().map_or(1, |crew| crew.member_count())
    }

    /// Runs a section: `f` on this thread, with a team for its stages.
    pub(crate) fn scope<R>(&self, f: impl FnOnce(&Team<'_>) -> R) -> R {
        f(&Team::of(self.crew.as_deref()))
    }
}

impl fmt::Debug for Pool {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Pool").field("thread_count", &self.thread_count()).finish()
    }
}

impl<'a> Team<'a> {
    /// The team of the caller alone.
    pub(crate) fn alone() -> Team<'static> {
        Team { section: None, member_count: 1, not_sync: PhantomData }
    }

    fn of(crew: Option<&'a Crew>) -> Self {
        match crew.and_then(|crew| Some((crew.open()?, crew.member_count()))) {
            Some((section, member_count)) => {
                Self { section: Some(section), member_count, not_sync: PhantomData }
            }
            None => Team::alone(),
        }
    }

    /// Number of threads at work. Results must not depend on it.
    pub(crate) fn member_count(&self) -> usize {
        self.member_count
    }

    /// A stage: `f(range)` for the index ranges of `chunk_len` (the last perhaps shorter) that make up
    /// `0..len`, each once, in any order and on any thread.
    ///
    /// `chunk_len` of zero counts as one, here and in all stages. A panic in a chunk is passed on.
    #[inline]
    pub(crate) fn for_each_chunk(
        &self,
        len: usize,
        chunk_len: usize,
        f: impl Fn(Range<usize>) + Sync,
    ) {
        let chunk_len = chunk_len.max(1);
        self.run(len.div_ceil(chunk_len), |index| f(chunk_range(index, chunk_len, len)));
    }

    /// A stage over blocks of `chunk_len` elements: `f(chunk_index, block)`.
    #[inline]
    pub(crate) fn for_each_chunk_mut<T: Send>(
        &self,
        slice: &mut [T],
        chunk_len: usize,
        f: impl Fn(usize, &mut [T]) + Sync,
    ) {
        let blocks = SharedBlocks::new(slice, chunk_len);
        self.run(blocks.count(), |index| {
            // SAFETY: `run` gives each index once.
            f(index, unsafe { blocks.take(index) });
        });
    }

    /// A stage whose chunks each have an output: `f(range, output)`. Gives the outputs in chunk order.
    ///
    /// Outputs keep what they held, so that their memory is used again: `f` clears them. `outputs` grows
    /// to the number of chunks and never shrinks.
    #[inline]
    pub(crate) fn map_chunks<'o, Out: Default + Send>(
        &self,
        len: usize,
        chunk_len: usize,
        outputs: &'o mut Vec<Out>,
        f: impl Fn(Range<usize>, &mut Out) + Sync,
    ) -> &'o mut [Out] {
        let chunk_len = chunk_len.max(1);
        let count = len.div_ceil(chunk_len);
        if outputs.len() < count {
            outputs.resize_with(count, Out::default);
        }
        let outputs = &mut outputs[..count];
        self.for_each_chunk_mut(outputs, 1, |index, output| {
            f(chunk_range(index, chunk_len, len), &mut output[0]);
        });
        outputs
    }

    /// Runs `chunk` once for each index below `count`.
    ///
    /// `SAFETY` arguments rest on "once", so this and [`Section::run`] are part of them.
    #[inline]
    fn run(&self, count: usize, chunk: impl Fn(usize) + Sync) {
        match (&self.section, u32::try_from(count)) {
            (Some(section), Ok(chunk_count)) if chunk_count > 1 => {
                section.run(chunk_count, &chunk);
            }
            _ => (0..count).for_each(chunk),
        }
    }
}

/// The indices of a chunk.
#[inline]
fn chunk_range(index: usize, chunk_len: usize, len: usize) -> Range<usize> {
    let first = index * chunk_len;
    first..len.min(first + chunk_len)
}
