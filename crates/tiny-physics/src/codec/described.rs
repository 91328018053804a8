//! Declarations of what users describe: a type with its form in files, its bytes and its defaults, so that a new field or
//! kind is one line.

/// Declares a public struct: its form in files (feature `serde`), its bytes ([`Data`](crate::codec::Data)), its defaults.
///
/// Where every field has a value behind `=` the struct gets `Default`, and a file may leave out any of them. Else a file may
/// leave out those that are `= default`, which means that of their type; `with fn` then names a constructor, which takes the
/// fields that it lists and leaves the others at their defaults.
macro_rules! described {
    (
        $(#[$meta:meta])*
        pub struct $name:ident {
            $($(#[$field_meta:meta])* $field_vis:vis $field:ident: $type:ty = $default:expr),* $(,)?
        }
    ) => {
        $(#[$meta])*
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
        pub struct $name {
            $($(#[$field_meta])* $field_vis $field: $type,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default),* }
            }
        }

        $crate::codec::data!($name { $($field),* });
    };
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident {
            $($(#[$field_meta:meta])* $field_vis:vis $field:ident: $type:ty $(= $optional:ident)?),* $(,)?
        }
    ) => {
        $(#[$meta])*
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
        $vis struct $name {
            $($(#[$field_meta])* $(#[cfg_attr(feature = "serde", serde($optional))])? $field_vis $field: $type,)*
        }

        $crate::codec::data!($name { $($field),* });
    };
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident {
            $($(#[$field_meta:meta])* $field_vis:vis $field:ident: $type:ty $(= $optional:ident)?),* $(,)?
        }
        with fn $make:ident($($given:ident: $given_type:ty),*);
    ) => {
        $crate::codec::described! {
            $(#[$meta])*
            $vis struct $name {
                $($(#[$field_meta])* $field_vis $field: $type $(= $optional)?),*
            }
        }

        impl $name {
            fn $make($($given: $given_type),*) -> Self {
                Self { $($field: $crate::codec::described!(value $field $($optional)?)),* }
            }
        }
    };
    (value $field:ident) => {
        $field
    };
    (value $field:ident default) => {
        Default::default()
    };
}

/// Declares a public enum in the same way; the number behind each variant stands for it in the bytes.
macro_rules! described_enum {
    (
        $(#[$meta:meta])*
        pub enum $name:ident {
            $($(#[$variant_meta:meta])* $variant:ident
                $(($($part:ident: $part_type:ty),*))?
                $({ $($(#[$field_meta:meta])* $field:ident: $type:ty $(= $optional:ident)?),* $(,)? })?
                = $tag:literal),* $(,)?
        }
    ) => {
        $(#[$meta])*
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
        pub enum $name {
            $($(#[$variant_meta])* $variant
                $(($($part_type),*))?
                $({ $($(#[$field_meta])* $(#[cfg_attr(feature = "serde", serde($optional))])? $field: $type),* })?,)*
        }

        $crate::codec::data_enum!($name {
            $($tag => $variant $(($($part),*))? $({ $($field),* })?),*
        });
    };
}

/// Declares the fields that a record keeps just as they were described: what both call alike is copied, both ways.
macro_rules! kept_as_described {
    ($record:ident of $described:ident { $($field:ident),* $(,)? }) => {
        impl $record {
            /// Takes over what is kept as it was described.
            pub(crate) fn take_over(self, described: &$described) -> Self {
                Self { $($field: described.$field,)* ..self }
            }

            /// Tells it again.
            pub(crate) fn tell(&self, described: $described) -> $described {
                $described { $($field: self.$field,)* ..described }
            }
        }
    };
}

/// Declares functions that build upon a description: each takes it, sets fields, and gives it back.
macro_rules! setters {
    ($type:ident $(<$life:lifetime>)? {
        $($(#[doc = $doc:literal])+ $name:ident($($given:ident: $given_type:ty),*):
            $($($field:ident).+ = $value:expr),+;)+
    }) => {
        impl $(<$life>)? $type $(<$life>)? {
            $($(#[doc = $doc])+
            pub fn $name(mut self, $($given: $given_type),*) -> Self {
                $(self.$($field).+ = $value;)+
                self
            })+
        }
    };
}

pub(crate) use {described, described_enum, kept_as_described, setters};
