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

    /// Works on every item.
    pub(crate) fn each<T: Send, E: Send>(
        &self,
        items: &mut [T],
        work: impl Fn(usize, &mut T) -> Result<(), E> + Send + Sync,
    ) -> Result<(), E> {
        let Some(pool) = &self.0 else {
            return items.iter_mut().enumerate().try_for_each(|(i, item)| work(i, item));
        };
        let items = items.par_iter_mut().with_min_len(CHUNK).enumerate();
        pool.install(|| items.try_for_each(|(i, item)| work(i, item)))
    }

    /// Works on every item, each with its own `stride` numbers of `out`.
    pub(crate) fn each_with<T: Send, N: Send, E: Send>(
        &self,
        items: &mut [T],
        (out, stride): (&mut [N], usize),
        work: impl Fn(usize, &mut T, &mut [N]) -> Result<(), E> + Send + Sync,
    ) -> Result<(), E> {
        if stride == 0 {
            return self.each(items, |i, item| work(i, item, &mut []));
        }
        let Some(pool) = &self.0 else {
            let mut pairs = items.iter_mut().zip(out.chunks_mut(stride)).enumerate();
            return pairs.try_for_each(|(i, (item, out))| work(i, item, out));
        };
        let pairs = items.par_iter_mut().with_min_len(CHUNK).zip(out.par_chunks_mut(stride));
        pool.install(|| pairs.enumerate().try_for_each(|(i, (item, out))| work(i, item, out)))
    }
}
