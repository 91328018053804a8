//! Plain data to bytes and back: the saved frame, and what the state hash walks over.
//!
//! Numbers are little-endian, fields follow each other in the order of their declaration here, lists begin
//! with their length. Reading never trusts a length: memory grows with what was really there. That the numbers
//! make sense together is for the reader of the whole to check.

mod math;

use crate::error::Error;

/// Takes numbers: bytes in a file, or a hash.
pub(crate) trait Sink {
    fn u8(&mut self, value: u8);
    fn u32(&mut self, value: u32);
    fn u64(&mut self, value: u64);
    /// A number that belongs to the record but not to the state: generations of handles.
    fn apart(&mut self, value: u32);
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
}

/// Reads what a [`Writer`] wrote.
pub(crate) struct Reader<'a>(pub(crate) &'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        let (head, rest) = self.0.split_first_chunk().ok_or(TRUNCATED)?;
        self.0 = rest;
        Ok(*head)
    }

    /// An error unless everything has been read.
    pub(crate) fn finish(&self) -> Result<(), Error> {
        if self.0.is_empty() { Ok(()) } else { Err(bad("bytes are left over")) }
    }
}

const TRUNCATED: Error = bad("it ends too early");

/// The error of bytes that are no frame.
pub(crate) const fn bad(reason: &'static str) -> Error {
    Error::BadFrame { reason }
}

/// Can be written and read.
pub(crate) trait Data: Sized {
    fn save(&self, sink: &mut impl Sink);
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error>;
}

impl Data for u8 {
    fn save(&self, sink: &mut impl Sink) {
        sink.u8(*self);
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Ok(u8::from_le_bytes(reader.take()?))
    }
}

impl Data for u32 {
    fn save(&self, sink: &mut impl Sink) {
        sink.u32(*self);
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Ok(u32::from_le_bytes(reader.take()?))
    }
}

impl Data for u64 {
    fn save(&self, sink: &mut impl Sink) {
        sink.u64(*self);
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Ok(u64::from_le_bytes(reader.take()?))
    }
}

/// Implements [`Data`] through another type.
macro_rules! data_as {
    ($($type:ty => $through:ty, $to:expr, $from:expr;)*) => {
        $(impl Data for $type {
            fn save(&self, sink: &mut impl Sink) {
                let through: $through = $to(*self);
                through.save(sink);
            }
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
    fn save(&self, sink: &mut impl Sink) {
        self.is_some().save(sink);
        if let Some(value) = self {
            value.save(sink);
        }
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        if bool::load(reader)? { T::load(reader).map(Some) } else { Ok(None) }
    }
}

impl<T: Data> Data for Vec<T> {
    fn save(&self, sink: &mut impl Sink) {
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
}

impl<T: Data + Copy, const N: usize> Data for [T; N] {
    fn save(&self, sink: &mut impl Sink) {
        self.iter().for_each(|item| item.save(sink));
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let mut items = [T::load(reader)?; N];
        for item in &mut items[1..] {
            *item = T::load(reader)?;
        }
        Ok(items)
    }
}

impl<A: Data, B: Data> Data for (A, B) {
    fn save(&self, sink: &mut impl Sink) {
        self.0.save(sink);
        self.1.save(sink);
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Ok((A::load(reader)?, B::load(reader)?))
    }
}

/// Implements [`Data`] for a struct: the fields in order, then after `apart` those that no hash covers. A field
/// that is not named does not compile.
macro_rules! data {
    ($type:ident $(<$generic:ident>)? { $($field:ident),* $(,)? } $(apart { $($apart:ident),* })?) => {
        impl $(<$generic: $crate::codec::Data>)? $crate::codec::Data for $type $(<$generic>)? {
            #[inline]
            fn save(&self, sink: &mut impl $crate::codec::Sink) {
                let Self { $($field,)* $($($apart,)*)? } = self;
                $($crate::codec::Data::save($field, sink);)*
                $($(sink.apart(*$apart);)*)?
            }
            #[inline]
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
            #[inline]
            fn save(&self, sink: &mut impl $crate::codec::Sink) {
                match self {
                    $(Self::$variant $({ $($field),* })? => {
                        sink.u8($tag);
                        $($($crate::codec::Data::save($field, sink);)*)?
                    })*
                }
            }
            #[inline]
            fn load(
                reader: &mut $crate::codec::Reader<'_>,
            ) -> Result<Self, $crate::error::Error> {
                Ok(match <u8 as $crate::codec::Data>::load(reader)? {
                    $($tag => {
                        $($(let $field = $crate::codec::Data::load(reader)?;)*)?
                        Self::$variant $({ $($field),* })?
                    })*
                    _ => return Err($crate::codec::bad("a kind is unknown")),
                })
            }
        }
    };
}

pub(crate) use {data, data_enum};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_that_lie_do_not_allocate() {
        let bytes = [255; 8];
        assert_eq!(Vec::<[u64; 16]>::load(&mut Reader(&bytes)), Err(TRUNCATED));
        assert_eq!(Option::<u32>::load(&mut Reader(&[2])).ok(), None);
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
