//! The threads that a batch shares its worlds out to.

use crate::error::BatchError;
use rayon::prelude::*;
use std::sync::Arc;

/// Worlds that a thread takes at a time, at least.
const CHUNK: usize = 4;

/// Threads of a batch; one alone runs in the caller.
#[derive(Clone, Debug, Default)]
pub(crate) struct Threads(Option<Arc<rayon::ThreadPool>>);

impl Threads {
    /// That many threads; 0 is one a core.
    pub(crate) fn new(count: usize) -> Result<Self, BatchError> {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        let count = if count == 0 { cores() } else { count };
        if count == 1 {
            return Ok(Self(None));
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
        Ok(Self(Some(Arc::new(pool.map_err(|error| BatchError::Threads(error.to_string()))?))))
    }

    /// How many.
    pub(crate) fn count(&self) -> usize {
        self.0.as_ref().map_or(1, |pool| pool.current_num_threads())
    }

    /// Works on every item, a world or what has one. Of errors the first in order is given, on any number of threads.
    pub(crate) fn each<T: Send>(
        &self,
        items: &mut [T],
        work: impl Fn(usize, &mut T) -> Result<(), BatchError> + Send + Sync,
    ) -> Result<(), BatchError> {
        let work = |(i, item)| work(i, item).map_err(|error| error.in_world(i));
        let Some(pool) = &self.0 else {
            return items.iter_mut().enumerate().map(work).fold(Ok(()), Result::and);
        };
        let items = items.par_iter_mut().with_min_len(CHUNK).enumerate();
        pool.install(|| items.map(work).reduce(|| Ok(()), Result::and))
    }

    /// The same, each with its own `stride` numbers of `out`.
    pub(crate) fn each_with<T: Send, N: Send>(
        &self,
        items: &mut [T],
        (out, stride): (&mut [N], usize),
        work: impl Fn(usize, &mut T, &mut [N]) -> Result<(), BatchError> + Send + Sync,
    ) -> Result<(), BatchError> {
        if stride == 0 {
            return self.each(items, |i, item| work(i, item, &mut []));
        }
        let mut pairs: Vec<_> = items.iter_mut().zip(out.chunks_mut(stride)).collect();
        self.each(&mut pairs, |i, (item, out)| work(i, item, out))
    }
}
