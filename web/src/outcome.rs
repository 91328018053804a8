//! What comes of a call.

use core::fmt::Display;

/// Done, or why not, in words.
pub(crate) type Outcome<T = ()> = Result<T, String>;

/// An error in words.
pub(crate) fn words(error: impl Display) -> String {
    error.to_string()
}
