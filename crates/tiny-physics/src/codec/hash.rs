//! One number for many bytes: it finds accidents, not attacks.

use super::{Data, Sink, Space};

/// Bytes that all lanes take at once.
const CHUNK: usize = 64;

/// Bytes that wait until there are enough to be worth a walk.
const BUFFER: usize = 4096;

/// Takes one word more. The shift brings high bits down to where the product spreads them.
#[inline(always)]
fn mix(hash: u64, word: u64) -> u64 {
    let mixed = hash ^ word;
    (mixed ^ mixed >> 32).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29)
}

/// Words in eight independent lanes, so that no word waits for the one before.
#[derive(Clone, Copy)]
struct Lanes([u64; 8]);

impl Lanes {
    const START: Self = Self([1, 2, 3, 4, 5, 6, 7, 8]);

    /// Takes whole chunks and returns the bytes that are left over.
    fn take<'a>(&mut self, bytes: &'a [u8]) -> &'a [u8] {
        let chunks = bytes.chunks_exact(CHUNK);
        let rest = chunks.remainder();
        let mut lanes = self.0;
        for chunk in chunks {
            for (lane, word) in lanes.iter_mut().zip(chunk.chunks_exact(8)) {
                *lane = mix(*lane, word.try_into().map_or(0, u64::from_le_bytes));
            }
        }
        self.0 = lanes;
        rest
    }

    /// The hash, once all is taken but less than a chunk; `length` is that of the whole.
    fn finish(mut self, last: &[u8], length: u64) -> u64 {
        let mut chunk = [0; CHUNK];
        chunk[..last.len()].copy_from_slice(last);
        self.take(&chunk);
        let hash = self.0.into_iter().fold(length, mix);
        mix(hash, 0)
    }
}

/// The hash of these bytes.
pub(crate) fn hash_bytes(bytes: &[u8]) -> u64 {
    let mut lanes = Lanes::START;
    let last = lanes.take(bytes);
    lanes.finish(last, bytes.len() as u64)
}

/// Hashes what is saved to it, but for what is [`Sink::apart`]: for that there are zeros.
pub(crate) struct Hasher {
    lanes: Lanes,
    buffer: [u8; BUFFER],
    used: usize,
    /// Bytes that the lanes have taken.
    taken: u64,
}

impl Hasher {
    pub(crate) fn new() -> Self {
        Self { lanes: Lanes::START, buffer: [0; BUFFER], used: 0, taken: 0 }
    }

    /// Hashes a record: for one of constant size quicker than saving it.
    #[inline(always)]
    pub(crate) fn record<T: Data>(&mut self, record: &T) {
        self.items(core::slice::from_ref(record));
    }

    pub(crate) fn finish(mut self) -> u64 {
        self.flush();
        self.lanes.finish(&self.buffer[..self.used], self.taken + self.used as u64)
    }

    /// Leaves less than a chunk in the buffer, and zeros after it.
    #[inline(never)]
    fn flush(&mut self) {
        let left = self.lanes.take(&self.buffer[..self.used]).len();
        let start = self.used - left;
        self.taken += start as u64;
        self.buffer.copy_within(start..self.used, 0);
        self.buffer[left..self.used].fill(0);
        self.used = left;
    }

    /// So many zeros of the buffer, to be written over. No more than it has when it is flushed.
    #[inline(always)]
    fn space(&mut self, count: usize) -> &mut [u8] {
        if self.used + count > BUFFER {
            self.flush();
        }
        let start = self.used;
        self.used += count;
        &mut self.buffer[start..self.used]
    }
}

impl Sink for Hasher {
    fn u8(&mut self, value: u8) {
        self.space(1)[0] = value;
    }
    fn u32(&mut self, value: u32) {
        self.space(4).copy_from_slice(&value.to_le_bytes());
    }
    fn u64(&mut self, value: u64) {
        self.space(8).copy_from_slice(&value.to_le_bytes());
    }
    fn apart(&mut self, _: u32) {
        self.u32(0);
    }
    fn pad(&mut self, count: usize) {
        (0..count).for_each(|_| self.u8(0));
    }
    #[inline(always)]
    fn items<T: Data>(&mut self, items: &[T]) {
        match T::SIZE {
            Some(size) if 0 < size && size <= BUFFER - CHUNK => {
                for group in items.chunks((BUFFER - CHUNK) / size) {
                    Space::<false>(self.space(size * group.len())).items(group);
                }
            }
            _ => items.iter().for_each(|item| item.save(self)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codec::{Reader, Writer, data};
    use crate::error::Error;

    #[derive(Clone, Copy)]
    struct Record {
        number: u64,
        flag: Option<u16>,
        generation: u32,
    }
    data!(Record { number, flag } apart { generation });

    /// A record whose size is not known beforehand.
    struct Loose(Record);
    impl Data for Loose {
        fn save(&self, sink: &mut impl Sink) {
            self.0.save(sink);
        }
        fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
            Data::load(reader).map(Self)
        }
    }

    fn records(count: u64, generation: u32) -> Vec<Record> {
        let flag = |i: u64| i.is_multiple_of(3).then_some(i as u16);
        (0..count).map(|i| Record { number: i << 33, flag: flag(i), generation }).collect()
    }

    fn hash(save: impl FnOnce(&mut Hasher)) -> u64 {
        let mut hasher = Hasher::new();
        save(&mut hasher);
        hasher.finish()
    }

    /// Whether in one list, one by one or field by field: it is the hash of the bytes, with zeros for what is apart.
    #[test]
    fn is_the_hash_of_the_bytes() {
        for count in [0, 1, 2, 3, 200, 211, 5000] {
            let (list, plain) = (records(count, 7), records(count, 0));
            let mut writer = Writer::default();
            writer.items(&plain);
            let expected = hash_bytes(&writer.0);
            assert_eq!(hash(|hasher| hasher.items(&list)), expected, "{count}");
            assert_eq!(hash(|hasher| list.iter().for_each(|r| hasher.record(r))), expected);
            assert_eq!(hash(|hasher| list.iter().for_each(|r| r.save(hasher))), expected);
            let loose: Vec<_> = list.into_iter().map(Loose).collect();
            assert_eq!(hash(|hasher| hasher.items(&loose)), expected);
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
