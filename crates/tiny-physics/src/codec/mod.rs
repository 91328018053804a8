//! Plain data to bytes and back: the saved frame, and what the state hash is of.
//!
//! Numbers are little-endian, fields follow each other in the order of their declaration, lists begin with their
//! length. Reading never trusts a length: memory grows with what was really there. That the numbers make sense
//! together is for the reader of the whole to check.
//!
//! There is one [`Sink`], so that every type is written by one piece of code: with a sink of some kind as a parameter,
//! frames and hashes were a fifth of the engine's machine code.

mod bytes;
mod described;
mod hash;
mod math;
#[cfg(feature = "serde")]
pub(crate) mod packed;
mod store;

pub(crate) use bytes::{Reader, Sink};
pub(crate) use described::{described, described_enum, kept_as_described, setters};
pub(crate) use hash::hash_bytes;
pub(crate) use store::{Generations, clone_by_field, data, data_enum, field, holds, record, store};

use crate::error::Error;
use crate::footprint::MemoryUse;

/// The error of bytes that are no frame.
pub(crate) const fn bad(reason: &'static str) -> Error {
    Error::BadFrame { reason }
}

/// Can be written and read.
pub(crate) trait Data: Sized {
    /// Does it hold memory besides its own size?
    const HEAP: bool = false;

    fn save(&self, sink: &mut Sink);
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error>;
    /// Memory that it holds besides its own size.
    fn memory(&self) -> MemoryUse {
        MemoryUse::default()
    }
}

/// Implements [`Data`] for a number.
macro_rules! number {
    ($($type:ident),*) => {
        $(impl Data for $type {
            #[inline]
            fn save(&self, sink: &mut Sink) {
                sink.put(self.to_le_bytes());
            }
            #[inline]
            fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
                reader.take().map(Self::from_le_bytes)
            }
        })*
    };
}

number!(u8, u32, u64, f64);

/// Which NaN comes of a sum depends on the instruction set, and means nothing: all are saved as one.
impl Data for f32 {
    #[inline]
    fn save(&self, sink: &mut Sink) {
        sink.put(if self.is_nan() { Self::NAN } else { *self }.to_le_bytes());
    }
    #[inline]
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        reader.take().map(Self::from_le_bytes)
    }
}

/// Implements [`Data`] through another type.
macro_rules! data_as {
    ($($type:ty => $through:ty, $to:expr, $from:expr;)*) => {
        $(impl Data for $type {
            #[inline]
            fn save(&self, sink: &mut Sink) {
                let through: $through = $to(*self);
                through.save(sink);
            }
            #[inline]
            fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
                <$through>::load(reader).and_then($from)
            }
        })*
    };
}

data_as! {
    u16 => u32, u32::from, |v| u16::try_from(v).map_err(|_| bad("a number is too large"));
    i32 => u32, |v: i32| v as u32, |v| Ok(v as i32);
    usize => u64, |v: usize| v as u64, |v| usize::try_from(v).map_err(|_| bad("a number is too large"));
    bool => u8, u8::from, |v| if v < 2 { Ok(v == 1) } else { Err(bad("a flag is neither 0 nor 1")) };
}

impl<T: Data> Data for Option<T> {
    const HEAP: bool = T::HEAP;

    #[inline]
    fn save(&self, sink: &mut Sink) {
        self.is_some().save(sink);
        self.iter().for_each(|value| value.save(sink));
    }
    #[inline]
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        bool::load(reader)?.then(|| T::load(reader)).transpose()
    }
    fn memory(&self) -> MemoryUse {
        self.iter().map(T::memory).sum()
    }
}

impl<T: Data> Data for Vec<T> {
    const HEAP: bool = true;

    fn save(&self, sink: &mut Sink) {
        (self.len() as u32).save(sink);
        self.iter().for_each(|item| item.save(sink));
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let count = u32::load(reader)? as usize;
        // A wrong length must not ask for more memory than the bytes that are there could fill.
        let likely = reader.0.len() / size_of::<T>().max(1) + 1;
        let mut list = Self::with_capacity(if count < likely { count } else { likely });
        for _ in 0..count {
            list.push(T::load(reader)?);
        }
        Ok(list)
    }
    fn memory(&self) -> MemoryUse {
        let mut sum = crate::footprint::Footprint::footprint(self);
        if T::HEAP {
            self.iter().for_each(|item| sum += item.memory());
        }
        sum
    }
}

impl<T: Data + Copy, const N: usize> Data for [T; N] {
    #[inline]
    fn save(&self, sink: &mut Sink) {
        self.iter().for_each(|item| item.save(sink));
    }
    #[inline]
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        // The first is something to write over.
        let mut items = [T::load(&mut Reader(reader.0))?; N];
        for item in &mut items {
            *item = T::load(reader)?;
        }
        Ok(items)
    }
}

impl<A: Data, B: Data> Data for (A, B) {
    const HEAP: bool = A::HEAP || B::HEAP;

    #[inline]
    fn save(&self, sink: &mut Sink) {
        self.0.save(sink);
        self.1.save(sink);
    }
    #[inline]
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Ok((A::load(reader)?, B::load(reader)?))
    }
    fn memory(&self) -> MemoryUse {
        [self.0.memory(), self.1.memory()].into_iter().sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bytes of a value.
    fn bytes(value: &impl Data) -> Vec<u8> {
        let mut sink = Sink::new();
        value.save(&mut sink);
        sink.bytes()
    }

    #[test]
    fn lengths_that_lie_do_not_allocate() {
        let bytes = [255; 8];
        assert_eq!(Vec::<[u64; 16]>::load(&mut Reader(&bytes)), Err(bad("it ends too early")));
        assert_eq!(Vec::<[u8; 16]>::load(&mut Reader(&bytes)), Err(bad("it ends too early")));
        assert_eq!(Vec::<Vec<u8>>::load(&mut Reader(&bytes)), Err(bad("it ends too early")));
        assert_eq!(Option::<u32>::load(&mut Reader(&[2])).ok(), None);
    }

    /// An enum whose variants need a different number of bytes.
    #[derive(Debug, PartialEq, Clone, Copy)]
    enum Odd {
        None,
        One { a: u32 },
        Two { a: u64, b: bool },
    }
    data_enum!(Odd { 0 => None, 1 => One { a }, 2 => Two { a, b } });

    record! {
        #[derive(Debug, PartialEq, Clone, Copy)]
        struct Fixed {
            number: f32,
            odd: Odd,
            maybe: Option<u64>,
            lanes: [(u16, i32); 3],
            generation: u32 as apart,
        }
    }

    store! {
        #[derive(Debug, PartialEq)]
        struct Loose {
            list: Vec<u8>,
            maybe: Option<Vec<u32>>,
            lengths: Vec<usize> as derived,
        }
        load with Loose::measure
    }

    impl Loose {
        fn new(list: &[u8], maybe: Option<Vec<u32>>) -> Self {
            Self { list: list.to_vec(), maybe, lengths: vec![list.len()] }
        }

        fn measure(&mut self) -> Result<(), Error> {
            self.lengths.push(self.list.len());
            if self.lengths[0] < 9 { Ok(()) } else { Err(bad("it is too long")) }
        }
    }

    fn fixed(i: u32) -> Fixed {
        let odd = [Odd::None, Odd::One { a: i }, Odd::Two { a: u64::from(i) << 40, b: true }];
        let maybe = i.is_multiple_of(2).then_some(u64::from(i) * 3);
        let lanes = [(i as u16, -1), (7, i as i32), (u16::MAX, i32::MIN)];
        Fixed { number: -0.5 * i as f32, odd: odd[i as usize % 3], maybe, lanes, generation: !i }
    }

    #[test]
    fn what_is_written_is_read() {
        let list: Vec<Fixed> = (0..200).map(fixed).collect();
        let loose = vec![Loose::new(&[1, 2], Some(vec![3])), Loose::new(&[], None)];
        let numbers = (vec![(1_u32, -0.0_f32)], (Some(7_u16), [true, false]));
        let value = (list, (loose, numbers));
        let bytes = bytes(&value);
        let mut reader = Reader(&bytes);
        assert_eq!(Data::load(&mut reader), Ok(value));
        assert_eq!(reader.finish(), Ok(()));
    }

    #[test]
    fn what_follows_from_the_rest_is_not_written_but_checked() {
        assert_eq!(bytes(&Loose::new(&[5; 8], None)).len(), 4 + 8 + 1);
        let long = bytes(&Loose::new(&[5; 9], None));
        assert_eq!(Loose::load(&mut Reader(&long)), Err(bad("it is too long")));
    }

    #[test]
    fn memory_of_lists_in_lists_is_counted() {
        let loose = vec![Loose::new(&[1, 2], Some(vec![3])), Loose::new(&[], None)];
        assert_eq!(loose.memory().used, 2 * size_of::<Loose>() + 2 + 4 + 2 * size_of::<usize>());
        let list: Vec<Fixed> = (0..9).map(fixed).collect();
        assert_eq!(list.memory().used, 9 * size_of::<Fixed>());
    }

    #[test]
    fn what_is_cut_off_or_wrong_is_refused() {
        let list: Vec<Fixed> = (0..9).map(fixed).collect();
        let loose = vec![Loose::new(&[1, 2], Some(vec![3])), Loose::new(&[], None)];
        let whole = bytes(&(list, loose));
        for length in 0..whole.len() {
            let cut = <(Vec<Fixed>, Vec<Loose>)>::load(&mut Reader(&whole[..length]));
            assert_eq!(cut, Err(bad("it ends too early")), "{length}");
        }
        let mut wrong = whole;
        wrong[4 + 4] = 3;
        let error = Vec::<Fixed>::load(&mut Reader(&wrong)).unwrap_err();
        assert_eq!(error, bad("a kind is unknown"));
    }

    #[test]
    fn copies_into_old_memory_are_equal() {
        let source = Loose::new(&[1, 2, 3], Some(vec![4]));
        let mut copy = Loose::new(&[9; 8], None);
        let memory = copy.list.as_ptr();
        copy.clone_from(&source);
        assert_eq!(copy, source);
        assert_eq!((copy.list.as_ptr(), source.clone()), (memory, source));
    }
}
