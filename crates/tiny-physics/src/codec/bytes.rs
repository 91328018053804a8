//! Bytes to write to and to read from.

use super::{Data, Sink, bad};
use crate::error::Error;

const TRUNCATED: Error = bad("it ends too early");

/// Bytes that items of constant size are written to at a time, about: they stay in the nearest cache.
const GROUP: usize = 4096;

/// Counts the bytes of what is saved.
#[derive(Default)]
pub(crate) struct Counter(pub(crate) usize);

impl Sink for Counter {
    fn u8(&mut self, _: u8) {
        self.0 += 1;
    }
    fn u32(&mut self, _: u32) {
        self.0 += 4;
    }
    fn u64(&mut self, _: u64) {
        self.0 += 8;
    }
    fn apart(&mut self, _: u32) {
        self.0 += 4;
    }
    fn pad(&mut self, count: usize) {
        self.0 += count;
    }
    fn items<T: Data>(&mut self, items: &[T]) {
        match T::SIZE {
            Some(size) => self.0 += size * items.len(),
            None => items.iter().for_each(|item| item.save(self)),
        }
    }
}

/// Bytes of a frame.
#[derive(Default)]
pub(crate) struct Writer(pub(crate) Vec<u8>);

impl Sink for Writer {
    fn u8(&mut self, value: u8) {
        self.0.push(value);
    }
    fn u32(&mut self, value: u32) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }
    fn u64(&mut self, value: u64) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }
    fn apart(&mut self, value: u32) {
        self.u32(value);
    }
    fn pad(&mut self, count: usize) {
        self.0.resize(self.0.len() + count, 0);
    }
    fn items<T: Data>(&mut self, items: &[T]) {
        let Some(size) = T::SIZE else { return items.iter().for_each(|item| item.save(self)) };
        for group in items.chunks(GROUP / size + 1) {
            let start = self.0.len();
            self.0.resize(start + size * group.len(), 0);
            Space::<true>(&mut self.0[start..]).items(group);
        }
    }
}

/// Zeros to be written over. It is as long as what is written to it. What is [`Sink::apart`] stays zero unless `WHOLE`.
pub(super) struct Space<'a, const WHOLE: bool>(pub(super) &'a mut [u8]);

impl<'a, const WHOLE: bool> Space<'a, WHOLE> {
    #[inline(always)]
    fn take(&mut self, count: usize) -> &'a mut [u8] {
        let (head, rest) = core::mem::take(&mut self.0).split_at_mut(count);
        self.0 = rest;
        head
    }

    #[inline(always)]
    fn put<const N: usize>(&mut self, bytes: [u8; N]) {
        self.take(N).copy_from_slice(&bytes);
    }
}

impl<const WHOLE: bool> Sink for Space<'_, WHOLE> {
    #[inline(always)]
    fn u8(&mut self, value: u8) {
        self.put([value]);
    }
    #[inline(always)]
    fn u32(&mut self, value: u32) {
        self.put(value.to_le_bytes());
    }
    #[inline(always)]
    fn u64(&mut self, value: u64) {
        self.put(value.to_le_bytes());
    }
    #[inline(always)]
    fn apart(&mut self, value: u32) {
        self.u32(if WHOLE { value } else { 0 });
    }
    #[inline(always)]
    fn pad(&mut self, count: usize) {
        self.take(count);
    }
    #[inline(always)]
    fn items<T: Data>(&mut self, items: &[T]) {
        let size = T::SIZE.unwrap_or(0);
        let places = self.take(size * items.len()).chunks_exact_mut(size);
        for (item, place) in items.iter().zip(places) {
            let mut place = Space::<WHOLE>(place);
            item.save(&mut place);
            debug_assert!(place.0.is_empty(), "an item is smaller than its size");
        }
    }
}

/// Reads what a [`Writer`] wrote.
pub(crate) struct Reader<'a>(pub(crate) &'a [u8]);

impl Reader<'_> {
    #[inline(always)]
    pub(super) fn take<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        let (head, rest) = self.0.split_first_chunk().ok_or(TRUNCATED)?;
        self.0 = rest;
        Ok(*head)
    }

    /// Passes over bytes that stand for nothing.
    #[inline(always)]
    pub(crate) fn pad(&mut self, count: usize) -> Result<(), Error> {
        self.0 = self.0.get(count..).ok_or(TRUNCATED)?;
        Ok(())
    }

    /// Reads so many items one after the other.
    #[inline(always)]
    pub(super) fn items<T: Data>(
        &mut self,
        count: usize,
        mut put: impl FnMut(T),
    ) -> Result<(), Error> {
        let Some(size) = T::SIZE else {
            return (0..count).try_for_each(|_| T::load(self).map(&mut put));
        };
        let length = count.checked_mul(size).ok_or(TRUNCATED)?;
        let (items, rest) = self.0.split_at_checked(length).ok_or(TRUNCATED)?;
        self.0 = rest;
        items.chunks_exact(size).try_for_each(|item| T::load(&mut Reader(item)).map(&mut put))
    }

    /// Bytes that are left.
    pub(super) fn left(&self) -> usize {
        self.0.len()
    }

    /// An error unless everything has been read.
    pub(crate) fn finish(&self) -> Result<(), Error> {
        if self.0.is_empty() { Ok(()) } else { Err(bad("bytes are left over")) }
    }
}
