//! Bytes to write to and to read from.

use super::bad;
use super::hash::Hash;
use crate::error::Error;

const TRUNCATED: Error = bad("it ends too early");

/// Bytes that wait for the hash, until there are enough to be worth a walk.
const BUFFER: usize = 8192;

/// Takes what is saved: bytes of a frame, or of the state hash, which differ in what is [`Sink::apart`].
pub(crate) struct Sink {
    /// Zeros from `used` on.
    buffer: Vec<u8>,
    used: usize,
    hash: Option<Hash>,
}

impl Sink {
    /// Of a frame.
    pub(crate) fn new() -> Self {
        Self { buffer: Vec::new(), used: 0, hash: None }
    }

    /// Of a hash.
    pub(crate) fn hashing() -> Self {
        Self { buffer: vec![0; BUFFER], used: 0, hash: Some(Hash::new()) }
    }

    /// Takes the bytes of a number.
    #[inline]
    pub(crate) fn put<const N: usize>(&mut self, bytes: [u8; N]) {
        if self.used + N > self.buffer.len() {
            self.make_room();
        }
        self.buffer[self.used..self.used + N].copy_from_slice(&bytes);
        self.used += N;
    }

    /// Takes a number that belongs to the record but not to the state: generations of handles.
    #[inline]
    pub(crate) fn apart(&mut self, value: u32) {
        self.put(if self.hash.is_some() { 0 } else { value }.to_le_bytes());
    }

    /// For a few more numbers.
    #[cold]
    fn make_room(&mut self) {
        match &mut self.hash {
            None => self.buffer.resize((2 * self.buffer.len()).max(BUFFER), 0),
            Some(hash) => {
                let left = hash.take(&self.buffer[..self.used]);
                self.buffer.copy_within(left..self.used, 0);
                self.used -= left;
            }
        }
    }

    /// What was saved, if this is no hash.
    pub(crate) fn bytes(mut self) -> Vec<u8> {
        self.buffer.truncate(self.used);
        self.buffer.shrink_to_fit();
        self.buffer
    }

    /// The hash of what was saved.
    pub(crate) fn finish(self) -> u64 {
        self.hash.unwrap_or(Hash::new()).finish(&self.buffer[..self.used])
    }
}

/// Reads what was saved.
pub(crate) struct Reader<'a>(pub(crate) &'a [u8]);

impl Reader<'_> {
    #[inline]
    pub(super) fn take<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        let (head, rest) = self.0.split_first_chunk().ok_or(TRUNCATED)?;
        self.0 = rest;
        Ok(*head)
    }

    /// An error unless everything has been read.
    pub(crate) fn finish(&self) -> Result<(), Error> {
        if self.0.is_empty() { Ok(()) } else { Err(bad("bytes are left over")) }
    }
}
