//! What differs between two frames, as bytes.
//!
//! Frames are nothing but bytes here. The new one is predicted by the old one at a distance that stays the same for long:
//! lists grow and shrink, and what comes after them moves as a whole. Where the prediction fails, blocks of the new frame
//! are looked up in the old one to find the distance anew (the idea of C. Percival, *Naive Differences of Executable
//! Code*, 2003). Words are stored as their exclusive or with the prediction: numbers that change a little keep their
//! upper bytes, which cost half a bit each.

use crate::codec::bad;
use crate::{Error, World};

/// Bytes of a word.
const WORD: usize = 4;
/// Bytes of a block that is looked up.
const BLOCK: usize = 16;
/// Words by which two distances are compared.
const AHEAD: usize = 16;
/// So many words as predicted end a run of words that are not.
const SAME: usize = 4;
/// A frame may be this many times as large as the old one and the difference together, and this much more.
const LARGER: usize = 16;
const MORE: usize = 1 << 24;

impl World {
    /// What makes this world of an earlier frame, [`World::to_bytes`], that both sides of a connection have: 80 to
    /// 250 bytes a moving body, measured, where a frame has a thousand. [`World::restore_delta`] is the way back.
    ///
    /// ```
    /// use tiny_physics::{RigidBody, Shape, Vec2, World};
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new(Vec2::new(0.0, -9.8));
    /// world.add_body(RigidBody::dynamic().shape(Shape::circle(0.5)?))?;
    /// let frame = world.to_bytes();
    /// world.step(1.0 / 60.0);
    /// let delta = world.delta_from(&frame);
    ///
    /// let mut other = World::new(Vec2::ZERO);
    /// other.restore_delta(&frame, &delta)?;
    /// assert_eq!(other.state_hash(), world.state_hash());
    /// # Ok(())
    /// # }
    /// ```
    pub fn delta_from(&self, frame: &[u8]) -> Vec<u8> {
        encode(frame, &self.to_bytes())
    }

    /// Goes to the world of [`World::delta_from`] in place, as [`World::restore_bytes`] does.
    ///
    /// # Errors
    /// The frame is not the one that the difference was made from, or one of both is damaged; this world has not changed
    /// then.
    pub fn restore_delta(&mut self, frame: &[u8], delta: &[u8]) -> Result<(), Error> {
        self.restore_bytes(&decode(frame, delta)?)
    }
}

/// What makes `new` of `old`: runs of a change of distance, a count of words as predicted, and words that are not.
pub(super) fn encode(old: &[u8], new: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    write_number(&mut out, new.len() as u64);
    let index = Index::of(old);
    let (mut at, mut shift, mut before) = (0, 0, 0);
    while at < new.len() {
        let start = at;
        while at < new.len() && word(new, at) == predicted(old, at, shift) {
            at += WORD;
        }
        let moved = if at < new.len() { index.shift_near(old, new, at, shift) } else { None };
        let from = at;
        if moved.is_none() {
            at = end_of_change(old, new, at, shift);
        }
        // Small numbers of either sign as small numbers.
        write_number(&mut out, ((shift - before) << 1 ^ (shift - before) >> 63) as u64);
        write_number(&mut out, ((from - start) / WORD) as u64);
        let end = if at < new.len() { at } else { new.len() };
        write_words(&mut out, old, &new[..end], from, shift);
        before = shift;
        shift = moved.unwrap_or(shift);
    }
    out
}

/// Makes the new frame of the old one and what [`encode`] gave.
pub(super) fn decode(old: &[u8], mut delta: &[u8]) -> Result<Vec<u8>, Error> {
    let length = read_number(&mut delta)?;
    // A wrong length must not ask for much memory.
    if length > (MORE + LARGER * (old.len() + delta.len())) as u64 {
        return Err(DAMAGED);
    }
    let length = length as usize;
    let mut new = Vec::with_capacity(length + WORD);
    let mut shift = 0_i64;
    while new.len() < length {
        let by = read_number(&mut delta)?;
        shift = shift.wrapping_add((by >> 1) as i64 ^ -((by & 1) as i64));
        let same = read_number(&mut delta)?;
        let count = read_number(&mut delta)?;
        let room = ((length - new.len()).div_ceil(WORD)) as u64;
        if same > room || count > room - same {
            return Err(DAMAGED);
        }
        for _ in 0..same {
            let value = predicted(old, new.len(), shift);
            new.extend_from_slice(&value.to_le_bytes());
        }
        read_words(&mut delta, old, &mut new, count as usize, shift)?;
    }
    new.truncate(length);
    if delta.is_empty() { Ok(new) } else { Err(DAMAGED) }
}

/// Where the words that are not as predicted end.
fn end_of_change(old: &[u8], new: &[u8], mut at: usize, shift: i64) -> usize {
    let (start, mut same) = (at, 0);
    while at < new.len() && same < SAME && at - start < 16 * WORD {
        same = if word(new, at) == predicted(old, at, shift) { same + 1 } else { 0 };
        at += WORD;
    }
    at - same * WORD
}

/// A count, for each word which of its bytes are there, and these bytes.
fn write_words(out: &mut Vec<u8>, old: &[u8], new: &[u8], from: usize, shift: i64) {
    let change = |at: usize| word(new, at) ^ predicted(old, at, shift);
    let places = || (from..new.len()).step_by(WORD);
    write_number(out, places().count() as u64);
    // Bit k: byte k is not zero.
    let mask =
        |word: u32| (0..WORD).fold(0, |mask, k| mask | u8::from(word >> (8 * k) & 255 != 0) << k);
    let mut masks = places().map(|at| mask(change(at)));
    while let Some(low) = masks.next() {
        out.push(low | masks.next().unwrap_or(0) << 4);
    }
    for at in places() {
        out.extend(change(at).to_le_bytes().into_iter().filter(|byte| *byte != 0));
    }
}

fn read_words(
    delta: &mut &[u8],
    old: &[u8],
    new: &mut Vec<u8>,
    count: usize,
    shift: i64,
) -> Result<(), Error> {
    let (masks, rest) = delta.split_at_checked(count.div_ceil(2)).ok_or(ENDS)?;
    let mut rest = rest.iter();
    for i in 0..count {
        let mask = masks[i / 2] >> (4 * (i % 2)) & 15;
        let mut bytes = predicted(old, new.len(), shift).to_le_bytes();
        for (k, byte) in bytes.iter_mut().enumerate() {
            if mask >> k & 1 == 1 {
                *byte ^= rest.next().ok_or(ENDS)?;
            }
        }
        new.extend_from_slice(&bytes);
    }
    *delta = rest.as_slice();
    Ok(())
}

/// The word at a place; zeros past the end.
fn word(bytes: &[u8], at: usize) -> u32 {
    let rest = bytes.get(at..).unwrap_or_default();
    let short = || rest.iter().rev().fold(0, |word, byte| word << 8 | u32::from(*byte));
    rest.first_chunk().map_or_else(short, |word| u32::from_le_bytes(*word))
}

/// The word of the old frame that is expected at a place of the new one.
fn predicted(old: &[u8], at: usize, shift: i64) -> u32 {
    usize::try_from((at as i64).wrapping_add(shift)).map_or(0, |from| word(old, from))
}

/// Where blocks lie in a frame: those that occur once.
struct Index {
    places: Vec<u32>,
    bits: u32,
}

impl Index {
    const FREE: u32 = u32::MAX;
    const SEVERAL: u32 = u32::MAX - 1;

    fn of(frame: &[u8]) -> Self {
        let bits = (frame.len() / BLOCK * 2).next_power_of_two().trailing_zeros().clamp(4, 24);
        let mut index = Self { places: vec![Self::FREE; 1 << bits], bits };
        for (i, block) in frame.chunks_exact(BLOCK).enumerate() {
            let slot = index.slot(block);
            let place = &mut index.places[slot];
            *place = if *place == Self::FREE { (i * BLOCK) as u32 } else { Self::SEVERAL };
        }
        index
    }

    fn slot(&self, block: &[u8]) -> usize {
        let half = |at: usize| u64::from(word(block, at)) << 32 | u64::from(word(block, at + 4));
        let mixed = (half(0) ^ half(8).rotate_left(23)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        (mixed >> (64 - self.bits)) as usize
    }

    /// A distance that predicts what begins at a place better than the one of before.
    fn shift_near(&self, old: &[u8], new: &[u8], at: usize, shift: i64) -> Option<i64> {
        let likely = alike(old, new, at, shift);
        for from in at..at + BLOCK {
            let block = new.get(from..from + BLOCK)?;
            let place = self.places[self.slot(block)];
            if place >= Self::SEVERAL || old[place as usize..][..BLOCK] != *block {
                continue;
            }
            let found = i64::from(place) - from as i64;
            if found != shift && alike(old, new, at, found) > likely + 2 {
                return Some(found);
            }
        }
        None
    }
}

/// How many of the next words are as predicted.
fn alike(old: &[u8], new: &[u8], at: usize, shift: i64) -> usize {
    let places = (at..new.len()).step_by(WORD).take(AHEAD);
    places.filter(|&at| word(new, at) == predicted(old, at, shift)).count()
}

const ENDS: Error = bad("a difference ends too early");
const DAMAGED: Error = bad("a difference is damaged");

/// Seven bits a byte, the lowest first.
fn write_number(out: &mut Vec<u8>, mut value: u64) {
    while value >= 128 {
        out.push(value as u8 | 128);
        value >>= 7;
    }
    out.push(value as u8);
}

fn read_number(bytes: &mut &[u8]) -> Result<u64, Error> {
    let mut value = 0;
    for shift in (0..64).step_by(7) {
        let (&byte, rest) = bytes.split_first().ok_or(ENDS)?;
        *bytes = rest;
        value |= u64::from(byte & 127) << shift;
        if byte < 128 {
            return Ok(value);
        }
    }
    Err(DAMAGED)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bytes that look like chance, from a number.
    fn noise(seed: u32, count: usize) -> Vec<u8> {
        let mut state = seed.wrapping_mul(2) | 1;
        let next = move |_| {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            (state >> 24) as u8
        };
        (0..count).map(next).collect()
    }

    fn round_trip(old: &[u8], new: &[u8]) -> usize {
        let delta = encode(old, new);
        assert_eq!(decode(old, &delta).as_deref(), Ok(new));
        delta.len()
    }

    #[test]
    fn what_is_alike_costs_next_to_nothing() {
        let old = noise(1, 10_000);
        assert!(round_trip(&old, &old) < 8);
        let mut new = old.clone();
        new.splice(5000..5000, noise(2, 37));
        new.drain(8000..8011);
        let size = round_trip(&old, &new);
        // What is new is given up on in runs of 64 bytes.
        assert!(size < 37 + 4 * 64, "{size} bytes for 37 new ones");
        let zeros = round_trip(&[], &vec![0; 100_000]);
        assert!(zeros < 16, "{zeros} bytes for zeros");
    }

    #[test]
    fn anything_comes_back() {
        for (seed, (old, new)) in [(0, 0), (0, 1), (1, 0), (3, 5), (17, 16), (999, 1003), (64, 64)]
            .into_iter()
            .enumerate()
        {
            let (old, mut new) = (noise(seed as u32, old), noise(seed as u32 + 50, new));
            round_trip(&old, &new);
            let shared = old.len().min(new.len()) / 2;
            new[..shared].copy_from_slice(&old[..shared]);
            round_trip(&old, &new);
        }
    }

    #[test]
    fn damaged_differences_are_refused_or_give_other_bytes() {
        let old = noise(1, 400);
        let mut new = old.clone();
        new.splice(100..120, noise(3, 64));
        let delta = encode(&old, &new);
        for length in 0..delta.len() {
            assert!(decode(&old, &delta[..length]).is_err(), "cut at {length}");
        }
        for at in 0..delta.len() {
            for bit in 0..8 {
                let mut other = delta.clone();
                other[at] ^= 1 << bit;
                // Whatever comes out: no panic, and no more memory than the parts allow.
                let _ = decode(&old, &other);
            }
        }
    }
}
