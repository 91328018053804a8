//! Declarations: a struct with all that follows from its fields, so that a new field is one line.

use super::{Data, Reader, Sink};
use crate::error::Error;

/// Implements `Clone` field by field, with a `clone_from` that keeps the memory of every field: the
/// derived one drops it. A new field has to be named here, or this does not compile.
macro_rules! clone_by_field {
    ($type:ident $(<$generic:ident: $bound:path>)? { $($field:ident),* $(,)? }) => {
        impl $(<$generic: $bound>)? Clone for $type $(<$generic>)? {
            fn clone(&self) -> Self {
                let Self { $($field),* } = self;
                Self { $($field: $field.clone()),* }
            }

            fn clone_from(&mut self, source: &Self) {
                let Self { $($field),* } = self;
                $($field.clone_from(&source.$field);)*
            }
        }
    };
}

/// What is done with a field, by its mode: plain ones are saved; those `as apart` are saved but no part of the state
/// hash; those `as derived` follow from the others, so they are copied, but not saved.
macro_rules! field {
    (save $field:ident $sink:ident) => {
        $crate::codec::Data::save($field, $sink)
    };
    (save $field:ident $sink:ident apart) => {
        $sink.apart(*$field)
    };
    (save $field:ident $sink:ident derived) => {
        let _ = $field;
    };
    (load $reader:ident) => {
        $crate::codec::Data::load($reader)?
    };
    (load $reader:ident apart) => {
        <u32 as $crate::codec::Data>::load($reader)?
    };
    (load $reader:ident derived) => {
        Default::default()
    };
    (memory $field:ident) => {
        $crate::codec::Data::memory($field)
    };
    (memory $field:ident apart) => {{
        let _ = $field;
        $crate::footprint::MemoryUse::default()
    }};
    (memory $field:ident derived) => {
        $crate::footprint::Footprint::footprint($field)
    };
}

/// Declares a store: a struct with [`Clone`] (as [`clone_by_field!`] does) and [`Data`] (bytes, hash, memory). Fields may
/// have a mode, see [`field!`]. `load with` names a function that finds out what is derived, or refuses what was read.
macro_rules! store {
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident {
            $($(#[$field_meta:meta])* $field_vis:vis $field:ident: $type:ty $(as $mode:ident)?),* $(,)?
        }
        $(load with $settle:path)?
    ) => {
        $(#[$meta])*
        $vis struct $name {
            $($(#[$field_meta])* $field_vis $field: $type,)*
        }

        $crate::codec::clone_by_field!($name { $($field),* });

        impl $crate::codec::Data for $name {
            const HEAP: bool = true;

            fn save(&self, sink: &mut $crate::codec::Sink) {
                let Self { $($field),* } = self;
                $($crate::codec::field!(save $field sink $($mode)?);)*
            }
            fn load(reader: &mut $crate::codec::Reader<'_>) -> Result<Self, $crate::error::Error> {
                #[allow(unused_mut, reason = "where nothing is derived")]
                let mut loaded = Self { $($field: $crate::codec::field!(load reader $($mode)?),)* };
                $($settle(&mut loaded)?;)?
                Ok(loaded)
            }
            fn memory(&self) -> $crate::footprint::MemoryUse {
                let Self { $($field),* } = self;
                [$($crate::codec::field!(memory $field $($mode)?)),*].into_iter().sum()
            }
        }
    };
}

/// Declares a record: a struct with [`Data`], whose fields may be `as apart` (see [`field!`]). With values behind
/// them it has `Default`.
macro_rules! record {
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident {
            $($(#[$field_meta:meta])* $field_vis:vis $field:ident: $type:ty $(as $mode:ident)?),* $(,)?
        }
    ) => {
        $(#[$meta])*
        $vis struct $name {
            $($(#[$field_meta])* $field_vis $field: $type,)*
        }

        impl $crate::codec::Data for $name {
            fn save(&self, sink: &mut $crate::codec::Sink) {
                let Self { $($field),* } = self;
                $($crate::codec::field!(save $field sink $($mode)?);)*
            }
            fn load(reader: &mut $crate::codec::Reader<'_>) -> Result<Self, $crate::error::Error> {
                Ok(Self { $($field: $crate::codec::field!(load reader $($mode)?),)* })
            }
        }
    };
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident {
            $($(#[$field_meta:meta])* $field_vis:vis $field:ident: $type:ty $(as $mode:ident)? = $default:expr),* $(,)?
        }
    ) => {
        $crate::codec::record! {
            $(#[$meta])*
            $vis struct $name {
                $($(#[$field_meta])* $field_vis $field: $type $(as $mode)?),*
            }
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default),* }
            }
        }
    };
}

/// Implements [`Data`] for a struct that is declared elsewhere: the fields in order, then after `apart` those that no
/// hash covers. A field that is not named does not compile.
macro_rules! data {
    ($type:ident { $($field:ident),* $(,)? } $(apart { $($apart:ident),* })?) => {
        impl $crate::codec::Data for $type {
            const HEAP: bool = false $(|| $crate::codec::holds(|this: &Self| &this.$field))*;

            fn save(&self, sink: &mut $crate::codec::Sink) {
                let Self { $($field,)* $($($apart,)*)? } = self;
                $($crate::codec::Data::save($field, sink);)*
                $($(sink.apart(*$apart);)*)?
            }
            fn load(
                reader: &mut $crate::codec::Reader<'_>,
            ) -> Result<Self, $crate::error::Error> {
                $(let $field = $crate::codec::Data::load(reader)?;)*
                $($(let $apart = <u32 as $crate::codec::Data>::load(reader)?;)*)?
                Ok(Self { $($field,)* $($($apart,)*)? })
            }
            fn memory(&self) -> $crate::footprint::MemoryUse {
                [$($crate::codec::Data::memory(&self.$field)),*].into_iter().sum()
            }
        }
    };
}

/// Implements [`Data`] for an enum: a number for each variant, then its fields. `load with` names a function that refuses
/// what was read, or lets it pass.
macro_rules! data_enum {
    (
        $type:ident {
            $($tag:literal => $variant:ident $(($($part:ident),*))? $({ $($field:ident),* $(,)? })?),* $(,)?
        }
        $(load with $check:path)?
    ) => {
        impl $crate::codec::Data for $type {
            fn save(&self, sink: &mut $crate::codec::Sink) {
                match self {
                    $(Self::$variant $(($($part),*))? $({ $($field),* })? => {
                        sink.put([$tag]);
                        $($($crate::codec::Data::save($part, sink);)*)?
                        $($($crate::codec::Data::save($field, sink);)*)?
                    })*
                }
            }
            fn load(
                reader: &mut $crate::codec::Reader<'_>,
            ) -> Result<Self, $crate::error::Error> {
                let loaded = match <u8 as $crate::codec::Data>::load(reader)? {
                    $($tag => {
                        $($(let $part = $crate::codec::Data::load(reader)?;)*)?
                        $($(let $field = $crate::codec::Data::load(reader)?;)*)?
                        Self::$variant $(($($part),*))? $({ $($field),* })?
                    })*
                    _ => return Err($crate::codec::bad("a kind is unknown")),
                };
                $($check(&loaded)?;)?
                Ok(loaded)
            }
        }
    };
}

/// Does a field, named by a function to it, hold memory?
pub(crate) const fn holds<S, T: Data>(_: fn(&S) -> &T) -> bool {
    T::HEAP
}

/// Number of records ever put into a store, by this world or by any world that it was copied from: the
/// source of generations. Going back to an earlier state does not turn it back, so that a handle made
/// in the time that was undone never means something else. It is no part of the state: it is not
/// hashed and does not make two worlds differ.
#[derive(Debug, Default)]
pub(crate) struct Generations(u32);

impl Generations {
    /// The generation of a new record.
    pub(crate) fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(1);
        self.0
    }
}

impl Data for Generations {
    fn save(&self, sink: &mut Sink) {
        sink.apart(self.0);
    }
    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        Data::load(reader).map(Self)
    }
}

impl Clone for Generations {
    fn clone(&self) -> Self {
        Self(self.0)
    }

    /// Never lower than before.
    fn clone_from(&mut self, source: &Self) {
        if source.0 > self.0 {
            self.0 = source.0;
        }
    }
}

impl PartialEq for Generations {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

pub(crate) use {clone_by_field, data, data_enum, field, record, store};
