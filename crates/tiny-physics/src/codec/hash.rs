//! One number for many bytes: it finds accidents, not attacks.

/// Bytes that all lanes take at once.
const CHUNK: usize = 64;

/// Takes one word more. The shift brings high bits down to where the product spreads them.
#[inline(always)]
fn mix(hash: u64, word: u64) -> u64 {
    let mixed = hash ^ word;
    (mixed ^ mixed >> 32).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29)
}

/// A hash at work: words in eight independent lanes, so that no word waits for the one before.
pub(super) struct Hash {
    lanes: [u64; 8],
    /// Bytes that the lanes have taken.
    taken: u64,
}

impl Hash {
    pub(super) const fn new() -> Self {
        Self { lanes: [1, 2, 3, 4, 5, 6, 7, 8], taken: 0 }
    }

    /// Takes whole chunks, and says how many bytes those were.
    pub(super) fn take(&mut self, bytes: &[u8]) -> usize {
        let mut lanes = self.lanes;
        for chunk in bytes.chunks_exact(CHUNK) {
            for (lane, word) in lanes.iter_mut().zip(chunk.chunks_exact(8)) {
                *lane = mix(*lane, word.try_into().map_or(0, u64::from_le_bytes));
            }
        }
        self.lanes = lanes;
        let taken = bytes.len() / CHUNK * CHUNK;
        self.taken += taken as u64;
        taken
    }

    /// The hash, with these last bytes.
    pub(super) fn finish(mut self, bytes: &[u8]) -> u64 {
        let last = &bytes[self.take(bytes)..];
        let length = self.taken + last.len() as u64;
        let mut chunk = [0; CHUNK];
        chunk[..last.len()].copy_from_slice(last);
        self.take(&chunk);
        mix(self.lanes.into_iter().fold(length, mix), 0)
    }
}

/// The hash of these bytes.
pub(crate) fn hash_bytes(bytes: &[u8]) -> u64 {
    Hash::new().finish(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codec::{Data, Sink, record};

    record! {
        #[derive(Clone, Copy)]
        struct Record {
            number: u64,
            flag: Option<u16>,
            generation: u32 as apart,
        }
    }

    fn records(count: u64, generation: u32) -> Vec<Record> {
        let flag = |i: u64| i.is_multiple_of(3).then_some(i as u16);
        (0..count).map(|i| Record { number: i << 33, flag: flag(i), generation }).collect()
    }

    /// However many there are, it is the hash of the bytes, with zeros for what is apart.
    #[test]
    fn is_the_hash_of_the_bytes() {
        for count in [0, 1, 2, 3, 200, 211, 5000] {
            let (mut bytes, mut hash) = (Sink::new(), Sink::hashing());
            records(count, 0).save(&mut bytes);
            records(count, 7).save(&mut hash);
            assert_eq!(hash.finish(), hash_bytes(&bytes.bytes()), "{count}");
        }
    }

    /// Every byte counts, wherever it lies, and so does the number of zeros at the end.
    #[test]
    fn every_bit_counts() {
        let mut bytes = vec![0_u8; 300];
        let mut seen: Vec<u64> = (0..300).map(|length| hash_bytes(&bytes[..length])).collect();
        for bit in 0..bytes.len() * 8 {
            bytes[bit / 8] ^= 1 << (bit % 8);
            seen.push(hash_bytes(&bytes));
            bytes[bit / 8] ^= 1 << (bit % 8);
        }
        let count = seen.len();
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), count);
    }
}
