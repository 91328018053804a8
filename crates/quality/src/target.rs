//! What a measured value has to be.

use core::fmt;

/// What a measured value has to be.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Target {
    /// Not above this.
    AtMost(f64),
    /// Not below `limit`; `ideal` is the value of a perfect engine.
    AtLeast {
        /// The least that passes.
        limit: f64,
        /// What a perfect engine gets.
        ideal: f64,
    },
    /// At most `tolerance` from `value`.
    Within {
        /// The true value.
        value: f64,
        /// The greatest difference that passes.
        tolerance: f64,
    },
}

impl Target {
    /// How much of what is allowed a value uses up: up to 1 passes. Values that are no numbers use up
    /// infinitely much.
    pub fn use_of(self, measured: f64) -> f64 {
        let used = match self {
            Self::AtMost(0.0) => {
                if measured <= 0.0 {
                    0.0
                } else {
                    f64::INFINITY
                }
            }
            Self::AtMost(limit) => measured / limit,
            Self::AtLeast { limit, ideal } if ideal.is_infinite() => limit / measured,
            Self::AtLeast { limit, ideal } => (ideal - measured) / (ideal - limit),
            Self::Within { value, tolerance } => (measured - value).abs() / tolerance,
        };
        if used.is_nan() { f64::INFINITY } else { used.max(0.0) }
    }

    /// What a perfect engine gets, where that is a number.
    pub fn reference(self) -> Option<f64> {
        let ideal = match self {
            Self::AtMost(_) => 0.0,
            Self::AtLeast { ideal, .. } => ideal,
            Self::Within { value, .. } => value,
        };
        ideal.is_finite().then_some(ideal)
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AtMost(limit) if *limit == 0.0 => write!(f, "0"),
            Self::AtMost(limit) => write!(f, "<= {}", plain(*limit)),
            Self::AtLeast { limit, .. } => write!(f, ">= {}", plain(*limit)),
            Self::Within { value, tolerance } => {
                write!(f, "{} +- {}", plain(*value), plain(*tolerance))
            }
        }
    }
}

/// A number of a target in six decimals at most: many were worked out from those of single precision.
pub(crate) fn plain(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_allowed_is_used_up_in_proportion() {
        assert_eq!(Target::AtMost(2.0).use_of(1.0), 0.5);
        assert_eq!(Target::AtMost(0.0).use_of(0.0), 0.0);
        assert_eq!(Target::AtMost(0.0).use_of(1e-9), f64::INFINITY);
        assert_eq!(Target::AtLeast { limit: 3.0, ideal: 4.0 }.use_of(3.5), 0.5);
        assert_eq!(Target::AtLeast { limit: 600.0, ideal: f64::INFINITY }.use_of(300.0), 2.0);
        assert_eq!(Target::Within { value: 1.0, tolerance: 0.5 }.use_of(0.5), 1.0);
        assert_eq!(Target::AtMost(1.0).use_of(f64::NAN), f64::INFINITY);
    }

    #[test]
    fn numbers_are_printed_as_written() {
        let target = Target::Within { value: f64::from(0.3_f32 * 0.3), tolerance: 0.000_45 };
        assert_eq!(target.to_string(), "0.09 +- 0.00045");
        assert_eq!(Target::AtMost(1e-5).to_string(), "<= 0.00001");
    }

    #[test]
    fn a_perfect_engine_passes() {
        let within = Target::Within { value: 9.5, tolerance: 0.5 };
        for target in [Target::AtMost(2.0), Target::AtLeast { limit: 3.0, ideal: 4.0 }, within] {
            let reference = target.reference().expect("a number");
            assert_eq!(target.use_of(reference), 0.0, "{target}");
        }
        assert_eq!(Target::AtLeast { limit: 1.0, ideal: f64::INFINITY }.reference(), None);
    }
}
