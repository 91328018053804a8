//! The one error type of the crate.

use core::fmt;
use tiny_physics::Error;

/// What was wrong. Nothing has changed when an argument is refused; of what is wrong in a world by itself the others know nothing.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum BatchError {
    /// An array has another length than the batch needs.
    Length {
        /// The argument.
        name: &'static str,
        /// What is needed.
        expected: usize,
        /// What came.
        got: usize,
    },
    /// A number of an array is not finite or out of range.
    Value {
        /// The argument.
        name: &'static str,
        /// Where in it.
        index: usize,
        /// The number.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// There is no such world in the batch.
    World {
        /// The index asked for.
        index: usize,
        /// Worlds in the batch.
        count: usize,
    },
    /// Bytes are no saved batch of this kind.
    BadSave {
        /// What is wrong.
        reason: String,
    },
    /// The machine gives no threads.
    Threads(String),
    /// The engine's.
    Engine(Error),
    /// The engine's, about one world of the batch: the first of those where something was wrong.
    InWorld {
        /// Which.
        index: usize,
        /// What was wrong.
        error: Error,
    },
}

impl BatchError {
    /// The same, where it is the engine's, of a world of the batch.
    pub(crate) fn in_world(self, index: usize) -> Self {
        match self {
            Self::Engine(error) => Self::InWorld { index, error },
            other => other,
        }
    }

    /// `Ok` where an array has the length that is needed.
    pub(crate) fn check_length(
        name: &'static str,
        expected: usize,
        got: usize,
    ) -> Result<(), Self> {
        if expected == got { Ok(()) } else { Err(Self::Length { name, expected, got }) }
    }

    /// `Ok` where all numbers are finite.
    pub(crate) fn check_finite(name: &'static str, values: &[f32]) -> Result<(), Self> {
        match values.iter().position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(index) => {
                let value = f64::from(values[index]);
                Err(Self::Value { name, index, value, allowed: "a finite number" })
            }
        }
    }
}

impl fmt::Display for BatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { name, expected, got } => {
                write!(f, "{name} has {got} numbers; this batch needs {expected}")
            }
            Self::Value { name, index, value, allowed } => {
                write!(f, "{name}[{index}] is {value}; allowed is {allowed}")
            }
            Self::World { index, count } => write!(f, "there is no world {index} among {count}"),
            Self::BadSave { reason } => write!(f, "not a saved batch that can be read: {reason}"),
            Self::Threads(reason) => write!(f, "no threads: {reason}"),
            Self::Engine(error) => error.fmt(f),
            Self::InWorld { index, error } => write!(f, "world {index}: {error}"),
        }
    }
}

impl std::error::Error for BatchError {}

impl From<Error> for BatchError {
    fn from(error: Error) -> Self {
        Self::Engine(error)
    }
}
