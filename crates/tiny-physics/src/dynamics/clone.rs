//! Copies into memory that is there already.

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

/// Implements `Clone` as [`clone_by_field!`] and [`Data`](crate::codec::Data) as [`data!`](crate::codec::data) with one
/// list of the fields.
macro_rules! cloned_data {
    ($type:ident { $($field:ident),* $(,)? }) => {
        $crate::dynamics::clone_by_field!($type { $($field),* });
        $crate::codec::data!($type { $($field),* });
    };
}

/// Number of records ever put into a store, by this world or by any world that it was copied from: the
/// source of generations. Going back to an earlier state does not turn it back, so that a handle made
/// in the time that was undone never means something else. It is no part of the state: it is not
/// hashed and does not make two worlds differ.
#[derive(Debug, Default)]
pub(crate) struct Serial(u32);

impl Serial {
    /// The generation of a new record.
    pub(crate) fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(1);
        self.0
    }
}

impl crate::codec::Data for Serial {
    const SIZE: Option<usize> = Some(4);

    fn save(&self, sink: &mut impl crate::codec::Sink) {
        sink.apart(self.0);
    }
    fn load(reader: &mut crate::codec::Reader<'_>) -> Result<Self, crate::error::Error> {
        Ok(Self(crate::codec::Data::load(reader)?))
    }
}

impl Clone for Serial {
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

/// Gives a store a way to count on from where another of the same kind stands, for going back in place.
macro_rules! keep_serial {
    ($type:ident) => {
        impl $type {
            /// Generations go on from those of this store or the other, whichever has counted further.
            pub(crate) fn keep_serial(&mut self, other: &Self) {
                self.serial.clone_from(&other.serial);
            }
        }
    };
}

impl PartialEq for Serial {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

pub(crate) use {clone_by_field, cloned_data, keep_serial};
