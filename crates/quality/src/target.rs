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

    /// How far a value is from the ideal, and how far it may be, both in the value's unit; infinite where there is no number.
    fn error(self, measured: f64) -> (f64, f64) {
        let (error, allowed) = match self {
            Self::AtMost(limit) => (measured.max(0.0), limit),
            Self::AtLeast { limit, ideal } if ideal.is_infinite() => (limit - measured, 0.0),
            Self::AtLeast { limit, ideal } => ((ideal - measured).max(0.0), ideal - limit),
            Self::Within { value, tolerance } => ((measured - value).abs(), tolerance),
        };
        (if measured.is_finite() { error } else { f64::INFINITY }, allowed)
    }

    /// Is `ours` no further from the ideal than `theirs`, but for a tenth of what the target allows?
    pub fn as_good(self, ours: f64, theirs: f64) -> bool {
        let ((ours, allowed), (theirs, _)) = (self.error(ours), self.error(theirs));
        ours <= theirs.max(0.0) + 0.1 * allowed
    }

    /// The target of the hard suite's other variant: twice as much is allowed.
    pub(crate) fn doubled(self) -> Self {
        match self {
            Self::AtMost(limit) => Self::AtMost(2.0 * limit),
            Self::AtLeast { limit, ideal } if ideal.is_infinite() => {
                Self::AtLeast { limit: 0.5 * limit, ideal }
            }
            Self::AtLeast { limit, ideal } => Self::AtLeast { limit: 2.0 * limit - ideal, ideal },
            Self::Within { value, tolerance } => Self::Within { value, tolerance: 2.0 * tolerance },
        }
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
    fn engines_are_held_against_each_other() {
        let at_most = Target::AtMost(1.0);
        assert!(at_most.as_good(0.5, 0.45) && !at_most.as_good(0.7, 0.45));
        assert!(at_most.as_good(f64::NAN, f64::INFINITY) && !at_most.as_good(f64::NAN, 9.0));
        assert!(!Target::AtMost(0.0).as_good(1.0, 0.0) && Target::AtMost(0.0).as_good(3.0, 4.0));
        let stands = Target::AtLeast { limit: 600.0, ideal: f64::INFINITY };
        assert!(stands.as_good(600.0, 900.0) && !stands.as_good(60.0, 90.0));
        assert!(Target::Within { value: 1.0, tolerance: 0.5 }.as_good(0.96, 1.0));
    }

    #[test]
    fn twice_the_target_is_half_as_strict() {
        let within = Target::Within { value: 9.5, tolerance: 0.5 };
        let kept = Target::AtLeast { limit: 0.9, ideal: 1.0 };
        let stands = Target::AtLeast { limit: 600.0, ideal: f64::INFINITY };
        for (target, value) in
            [(within, 10.2), (kept, 0.86), (stands, 400.0), (Target::AtMost(3.0), 5.0)]
        {
            let (usual, other) = (target.use_of(value), target.doubled().use_of(value));
            assert!((usual / other - 2.0).abs() < 1e-9, "{target}: {usual} and {other}");
        }
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
