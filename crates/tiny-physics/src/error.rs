//! The one error type of the engine.

use core::fmt;

/// What was wrong with an input. Nothing has changed when one is returned.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A number is NaN or infinite.
    NotFinite {
        /// The field or argument.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number is finite but outside what makes sense.
    OutOfRange {
        /// The field or argument.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words: "above 0", "0 to 1".
        allowed: &'static str,
    },
    /// Points do not make a convex polygon, chain or outline.
    BadPoints {
        /// What is wrong with them.
        reason: &'static str,
        /// Index of the point where it shows.
        index: usize,
    },
    /// The handle's body, shape or joint has been removed, or belongs to another world.
    StaleHandle {
        /// The handle as it prints.
        handle: String,
    },
    /// Bytes are no saved frame or recording, or one of another version, or a damaged one.
    BadFrame {
        /// What is wrong.
        reason: &'static str,
    },
    /// A recording was played again and came out otherwise.
    Differs {
        /// The first step, counted from 1, after which the state is another.
        step: usize,
    },
    /// The combination is not possible; the text says why.
    Unsupported {
        /// What and why.
        reason: &'static str,
    },
}

impl Error {
    /// `Ok` where the value is finite.
    pub(crate) fn check_finite(name: &'static str, value: impl Into<f64>) -> Result<(), Self> {
        let value = value.into();
        if value.is_finite() { Ok(()) } else { Err(Self::NotFinite { name, value }) }
    }

    /// `Ok` where both parts are finite.
    pub(crate) fn check_finite_vec(name: &'static str, v: crate::math::Vec2) -> Result<(), Self> {
        Self::check_finite(name, v.x)?;
        Self::check_finite(name, v.y)
    }

    /// `Ok` where both coordinates are finite.
    pub(crate) fn check_finite_point(
        name: &'static str,
        point: crate::math::DVec2,
    ) -> Result<(), Self> {
        Self::check_finite(name, point.x)?;
        Self::check_finite(name, point.y)
    }

    /// `Ok` where the value is finite and what `allowed` says of it holds.
    pub(crate) fn check(
        name: &'static str,
        value: impl Into<f64>,
        holds: bool,
        allowed: &'static str,
    ) -> Result<(), Self> {
        let value = value.into();
        Self::check_finite(name, value)?;
        if holds { Ok(()) } else { Err(Self::OutOfRange { name, value, allowed }) }
    }

    /// `Ok` where the value is finite and above zero.
    pub(crate) fn check_positive(name: &'static str, value: f32) -> Result<(), Self> {
        Self::check(name, value, value > 0.0, "above 0")
    }

    /// `Ok` where the value is finite and not below zero.
    pub(crate) fn check_not_negative(name: &'static str, value: f32) -> Result<(), Self> {
        Self::check(name, value, value >= 0.0, "0 or above")
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { name, value } => write!(f, "{name} is {value}, not a finite number"),
            Self::OutOfRange { name, value, allowed } => {
                write!(f, "{name} is {value}; allowed is {allowed}")
            }
            Self::BadPoints { reason, index } => write!(f, "{reason} (at point {index})"),
            Self::StaleHandle { handle } => {
                write!(f, "{handle} has been removed or was never here")
            }
            Self::BadFrame { reason } => write!(f, "not a frame that can be read: {reason}"),
            Self::Differs { step } => {
                write!(f, "the playback differs from what was recorded, first after step {step}")
            }
            Self::Unsupported { reason } => f.write_str(reason),
        }
    }
}

impl std::error::Error for Error {}
