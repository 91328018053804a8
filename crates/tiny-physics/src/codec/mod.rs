//! Plain data to bytes and back: the saved frame, and what the state hash walks over.
//!
//! Numbers are little-endian, fields follow each other in the order of their declaration here, lists begin
//! with their length. Reading never trusts a length: memory grows with what was really there. That the numbers
//! make sense together is for the reader of the whole to check.
//!
//! Most records take the same number of bytes whatever they hold ([`Data::SIZE`]); zeros stand for what an option or
//! a variant lacks. Lists of them are cut into pieces of that constant length before anything is read, so the
//! compiler knows that every number is there, and arrays of numbers become plain copies.

mod bytes;
mod hash;
mod math;
mod size;

use bytes::Space;
pub(crate) use bytes::{Counter, Reader, Writer};
pub(crate) use hash::{Hasher, hash_bytes};
pub(crate) use size::{largest, of_field, rest, sum};

use crate::error::Error;

/// Takes numbers: bytes in a file, or a hash.
pub(crate) trait Sink: Sized {
    fn u8(&mut self, value: u8);
    fn u32(&mut self, value: u32);
    fn u64(&mut self, value: u64);
    /// A number that belongs to the record but not to the state: generations of handles.
    fn apart(&mut self, value: u32);
    /// So many bytes that stand for nothing.
    fn pad(&mut self, count: usize);
    /// One item after the other.
    fn items<T: Data>(&mut self, items: &[T]) {
        items.iter().for_each(|item| item.save(self));
    }
}

/// The error of bytes that are no frame.
pub(crate) const fn bad(reason: &'static str) -> Error {
    Error::BadFrame { reason }
}

/// Can be written and read.
pub(crate) trait Data: Sized {
    /// Bytes that it takes, if that is always the same number.
    const SIZE: Option<usize> = None;

    fn save(&self, sink: &mut impl Sink);
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error>;
}

/// Implements [`Data`] for a number.
macro_rules! number {
    ($($type:ident),*) => {
        $(impl Data for $type {
            const SIZE: Option<usize> = Some(size_of::<Self>());

            #[inline(always)]
            fn save(&self, sink: &mut impl Sink) {
                sink.$type(*self);
            }
            #[inline(always)]
            fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
                Ok(Self::from_le_bytes(reader.take()?))
            }
        })*
    };
}

number!(u8, u32, u64);

/// Implements [`Data`] through another type.
macro_rules! data_as {
    ($($type:ty => $through:ty, $to:expr, $from:expr;)*) => {
        $(impl Data for $type {
            const SIZE: Option<usize> = <$through>::SIZE;

            #[inline(always)]
            fn save(&self, sink: &mut impl Sink) {
                let through: $through = $to(*self);
                through.save(sink);
            }
            #[inline(always)]
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
    f32 => u32, f32::to_bits, |v| Ok(f32::from_bits(v));
    f64 => u64, f64::to_bits, |v| Ok(f64::from_bits(v));
    bool => u8, u8::from, |v| if v < 2 { Ok(v == 1) } else { Err(bad("a flag is neither 0 nor 1")) };
}

impl<T: Data> Data for Option<T> {
    const SIZE: Option<usize> = sum(&[Some(1), T::SIZE]);

    #[inline(always)]
    fn save(&self, sink: &mut impl Sink) {
        self.is_some().save(sink);
        match self {
            Some(value) => value.save(sink),
            None => sink.pad(T::SIZE.unwrap_or(0)),
        }
    }
    #[inline(always)]
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        if bool::load(reader)? {
            return T::load(reader).map(Some);
        }
        reader.pad(T::SIZE.unwrap_or(0))?;
        Ok(None)
    }
}

impl<T: Data> Data for Vec<T> {
    fn save(&self, sink: &mut impl Sink) {
        (self.len() as u32).save(sink);
        sink.items(self);
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let count = u32::load(reader)? as usize;
        // A wrong length must not ask for more memory than the bytes that are there could fill.
        let likely = reader.left() / T::SIZE.unwrap_or(size_of::<T>()).max(1) + 1;
        let mut list = Self::with_capacity(if count < likely { count } else { likely });
        reader.items(count, |item| list.push(item))?;
        Ok(list)
    }
}

impl<T: Data + Copy, const N: usize> Data for [T; N] {
    const SIZE: Option<usize> = match T::SIZE {
        Some(size) => Some(N * size),
        None => None,
    };

    #[inline(always)]
    fn save(&self, sink: &mut impl Sink) {
        sink.items(self);
    }
    #[inline(always)]
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        // Something to write over.
        let first = T::load(&mut Reader(reader.0))?;
        let mut items = [first; N];
        let mut places = items.iter_mut();
        reader.items(N, |item| {
            if let Some(place) = places.next() {
                *place = item;
            }
        })?;
        Ok(items)
    }
}

impl<A: Data, B: Data> Data for (A, B) {
    const SIZE: Option<usize> = sum(&[A::SIZE, B::SIZE]);

    #[inline(always)]
    fn save(&self, sink: &mut impl Sink) {
        self.0.save(sink);
        self.1.save(sink);
    }
    #[inline(always)]
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Ok((A::load(reader)?, B::load(reader)?))
    }
}

/// Implements [`Data`] for a struct: the fields in order, then after `apart` those that no hash covers. A field
/// that is not named does not compile.
macro_rules! data {
    ($type:ident $(<$generic:ident>)? { $($field:ident),* $(,)? } $(apart { $($apart:ident),* })?) => {
        impl $(<$generic: $crate::codec::Data>)? $crate::codec::Data for $type $(<$generic>)? {
            const SIZE: Option<usize> = $crate::codec::sum(&[
                $($crate::codec::of_field(|this: &Self| Some(&this.$field)),)*
                $($($crate::codec::of_field(|this: &Self| Some(&this.$apart)),)*)?
            ]);

            #[inline(always)]
            fn save(&self, sink: &mut impl $crate::codec::Sink) {
                let Self { $($field,)* $($($apart,)*)? } = self;
                $($crate::codec::Data::save($field, sink);)*
                $($(sink.apart(*$apart);)*)?
            }
            #[inline(always)]
            fn load(
                reader: &mut $crate::codec::Reader<'_>,
            ) -> Result<Self, $crate::error::Error> {
                $(let $field = $crate::codec::Data::load(reader)?;)*
                $($(let $apart = <u32 as $crate::codec::Data>::load(reader)?;)*)?
                Ok(Self { $($field,)* $($($apart,)*)? })
            }
        }
    };
}

/// Implements [`Data`] for an enum: a number for each variant, then its fields.
macro_rules! data_enum {
    ($type:ident { $($tag:literal => $variant:ident $({ $($field:ident),* $(,)? })?),* $(,)? }) => {
        impl $crate::codec::Data for $type {
            const SIZE: Option<usize> = $crate::codec::largest(&[
                $($crate::codec::data_enum!(@size $variant $($($field)*)?)),*
            ]);

            #[inline(always)]
            fn save(&self, sink: &mut impl $crate::codec::Sink) {
                match self {
                    $(Self::$variant $({ $($field),* })? => {
                        sink.u8($tag);
                        $($($crate::codec::Data::save($field, sink);)*)?
                        let own = $crate::codec::data_enum!(@size $variant $($($field)*)?);
                        sink.pad($crate::codec::rest(Self::SIZE, own));
                    })*
                }
            }
            #[inline(always)]
            fn load(
                reader: &mut $crate::codec::Reader<'_>,
            ) -> Result<Self, $crate::error::Error> {
                Ok(match <u8 as $crate::codec::Data>::load(reader)? {
                    $($tag => {
                        $($(let $field = $crate::codec::Data::load(reader)?;)*)?
                        let own = $crate::codec::data_enum!(@size $variant $($($field)*)?);
                        reader.pad($crate::codec::rest(Self::SIZE, own))?;
                        Self::$variant $({ $($field),* })?
                    })*
                    _ => return Err($crate::codec::bad("a kind is unknown")),
                })
            }
        }
    };
    // Bytes of a variant with its number.
    (@size $variant:ident $($field:ident)*) => {
        $crate::codec::sum(&[
            Some(1),
            $($crate::codec::of_field(|this: &Self| match this {
                Self::$variant { $field, .. } => Some($field),
                #[allow(unreachable_patterns, reason = "an enum of one variant")]
                _ => None,
            }),)*
        ])
    };
}

pub(crate) use {data, data_enum};

#[cfg(test)]
mod tests {
    use super::*;

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

    #[derive(Debug, PartialEq, Clone, Copy)]
    struct Fixed {
        number: f32,
        odd: Odd,
        maybe: Option<u64>,
        lanes: [(u16, i32); 3],
        generation: u32,
    }
    data!(Fixed { number, odd, maybe, lanes } apart { generation });

    #[derive(Debug, PartialEq)]
    struct Loose {
        list: Vec<u8>,
        maybe: Option<Vec<u32>>,
    }
    data!(Loose { list, maybe });

    fn fixed(i: u32) -> Fixed {
        let odd = [Odd::None, Odd::One { a: i }, Odd::Two { a: u64::from(i) << 40, b: true }];
        let maybe = i.is_multiple_of(2).then_some(u64::from(i) * 3);
        let lanes = [(i as u16, -1), (7, i as i32), (u16::MAX, i32::MIN)];
        Fixed { number: -0.5 * i as f32, odd: odd[i as usize % 3], maybe, lanes, generation: !i }
    }

    #[test]
    fn sizes_are_those_of_the_largest_variant() {
        assert_eq!(Odd::SIZE, Some(1 + 8 + 1));
        assert_eq!(Fixed::SIZE, Some(4 + 10 + 9 + 3 * 8 + 4));
        assert_eq!([Loose::SIZE, Vec::<u8>::SIZE, <(u8, Loose)>::SIZE], [None; 3]);
    }

    /// Lists go in pieces of constant size; that must give what one by one gives, and be counted right.
    #[test]
    fn lists_are_their_items_one_after_the_other() {
        for count in [0, 1, 2, 79, 80, 81, 500] {
            let list: Vec<Fixed> = (0..count).map(fixed).collect();
            let (mut whole, mut each) = (Writer::default(), Writer::default());
            list.save(&mut whole);
            count.save(&mut each);
            list.iter().for_each(|item| item.save(&mut each));
            assert_eq!(whole.0, each.0);
            assert_eq!(Some(whole.0.len() - 4), Fixed::SIZE.map(|size| size * list.len()));
            let mut counter = Counter::default();
            list.save(&mut counter);
            assert_eq!(counter.0, whole.0.len());
            let mut reader = Reader(&whole.0);
            assert_eq!(Data::load(&mut reader), Ok(list));
            assert_eq!(reader.finish(), Ok(()));
        }
    }

    #[test]
    fn what_is_cut_off_or_wrong_in_a_list_is_refused() {
        let list: Vec<Fixed> = (0..9).map(fixed).collect();
        let loose = vec![
            Loose { list: vec![1, 2], maybe: Some(vec![3]) },
            Loose { list: vec![], maybe: None },
        ];
        let mut writer = Writer::default();
        (list, loose).save(&mut writer);
        let whole = writer.0;
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
    fn numbers_come_back() {
        let value = (vec![(1_u32, -0.0_f32)], (Some(7_u16), [true, false]));
        let mut writer = Writer::default();
        value.save(&mut writer);
        let mut reader = Reader(&writer.0);
        assert_eq!(Data::load(&mut reader), Ok(value));
        assert_eq!(reader.finish(), Ok(()));
    }
}
