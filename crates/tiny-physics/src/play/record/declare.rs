//! Commands, declared once: what they are made of, the number that stands for each in a version of recordings, and what
//! they do.

use super::Made;
use crate::Error;
use crate::codec::{Data, Reader, Sink};

/// Commands are rare: what a part is made of is compiled once, not into every command.
#[inline(never)]
pub(super) fn keep(part: &impl Data, sink: &mut Sink) {
    part.save(sink);
}

#[inline(never)]
pub(super) fn part<T: Data>(reader: &mut Reader<'_>) -> Result<T, Error> {
    T::load(reader)
}

/// What carrying out a command comes to.
pub(super) trait Outcome {
    fn made(self) -> Result<Made, Error>;
}

impl Outcome for () {
    fn made(self) -> Result<Made, Error> {
        Ok(Made::Nothing)
    }
}

impl Outcome for Result<(), Error> {
    fn made(self) -> Result<Made, Error> {
        self.map(|()| Made::Nothing)
    }
}

impl Outcome for Result<Made, Error> {
    fn made(self) -> Result<Made, Error> {
        self
    }
}

/// Declares an enum of commands to something that is named after `for`. Behind each stand its number in the bytes and
/// what it does; there its parts are references.
macro_rules! commands {
    (
        for $object:ident: $object_type:ty;

        $(#[$meta:meta])*
        pub enum $name:ident {
            $($(#[$variant_meta:meta])* $variant:ident $(($($part:ident: $part_type:ty),*))?
                = $tag:literal: $does:expr),* $(,)?
        }
    ) => {
        $(#[$meta])*
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
        pub enum $name {
            $($(#[$variant_meta])* $variant $(($($part_type),*))?,)*
        }

        impl $name {
            pub(super) fn carry_out(&self, $object: &mut $object_type) -> Result<Made, Error> {
                match self {
                    $(Self::$variant $(($($part),*))? => Outcome::made($does),)*
                }
            }
        }

        impl Data for $name {
            fn save(&self, sink: &mut Sink) {
                match self {
                    $(Self::$variant $(($($part),*))? => {
                        sink.put([$tag]);
                        $($(keep($part, sink);)*)?
                    })*
                }
            }
            fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
                Ok(match u8::load(reader)? {
                    $($tag => {
                        $($(let $part = part(reader)?;)*)?
                        Self::$variant $(($($part),*))?
                    })*
                    _ => return Err(bad("a command is unknown")),
                })
            }
        }
    };
}

pub(super) use commands;
