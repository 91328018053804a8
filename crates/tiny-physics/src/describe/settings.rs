//! Numbers that govern a whole world.

use crate::codec::{described, described_enum};
use crate::error::Error;

described_enum! {
    /// How two materials make one coefficient.
    #[derive(Clone, Copy, PartialEq, PartialOrd, Ord, Eq, Debug, Default)]
    pub enum Mix {
        /// Square root of the product: one zero makes zero.
        #[default]
        GeometricMean = 0,
        /// Half of the sum.
        Average = 1,
        /// The smaller.
        Min = 2,
        /// The larger.
        Max = 3,
        /// The product.
        Multiply = 4,
    }
}

impl Mix {
    /// The rule of a pair of which each may have its own, and else the world's.
    pub(crate) fn of(a: Option<Self>, b: Option<Self>, world: Self) -> Self {
        a.max(b).unwrap_or(world)
    }

    /// The coefficient of a pair.
    #[inline]
    pub fn apply(self, a: f32, b: f32) -> f32 {
        // Infinite coefficients times no load are no number.
        self.of_numbers(a, b).clamp(f32::MIN, f32::MAX)
    }

    #[inline]
    fn of_numbers(self, a: f32, b: f32) -> f32 {
        match self {
            Self::GeometricMean => (a * b).sqrt(),
            Self::Average => 0.5 * (a + b),
            Self::Min => {
                if a < b {
                    a
                } else {
                    b
                }
            }
            Self::Max => {
                if a > b {
                    a
                } else {
                    b
                }
            }
            Self::Multiply => a * b,
        }
    }
}

described! {
    /// Settings of a world. The defaults are good; lengths and speeds assume that 1 unit is about the
    /// size of a typical moving body (0.1 to 10 units).
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct Settings {
        /// Solver substeps in a step; at least 1. More make stacks stiffer and joints tighter.
        pub substeps: u32 = 4,
        /// Solver iterations in a substep; at least 1. One substep with 10 iterations is the classic
        /// scheme, four substeps with one iteration (the default) give more for the same time.
        pub iterations: u32 = 1,
        /// Islands (bodies that touch or are joined) of up to this many bodies get more substeps where their contacts
        /// would sink visibly otherwise: tall stacks, heavy bodies on light ones. 0 turns it off.
        pub refine_up_to: u32 = 1000,
        /// Units a metre-scaled constant is multiplied by: set 100 where a crate is 100 units (pixels) wide.
        pub length_unit: f32 = 1.0,
        /// Greatest contact stiffness between bodies that move, hertz; at most 0.22 of the substep rate is used. Twice that
        /// against what nothing moves.
        pub contact_hertz: f32 = 240.0,
        /// Contact damping ratio, no unit.
        pub contact_damping_ratio: f32 = 3.0,
        /// Greatest speed at which overlap is pushed out, metres a second; multiplied by [`Settings::length_unit`], as the next three
        /// are. What a contact needs to carry its load is not bounded.
        pub push_speed: f32 = 0.4,
        /// Approach speed below which nothing bounces that lay on the other already, or that forces would soon bring back,
        /// metres a second. What just touches and has nothing to press it on, as a ball on a table without gravity or one
        /// that touches a wall aslant, bounces from a tenth of it on, if it leaves at a twentieth of it.
        pub restitution_threshold: f32 = 1.0,
        /// Approach speed above which a hit event is sent, metres a second.
        pub hit_event_threshold: f32 = 1.0,
        /// Greatest speed of a body, metres a second.
        pub max_speed: f32 = 400.0,
        /// Do islands at rest fall asleep? Where this is switched off, what sleeps wakes with the next step; what is put to sleep
        /// by hand after that, or added asleep, sleeps all the same.
        pub sleep: bool = true,
        /// Time at rest before an island sleeps, seconds.
        pub time_to_sleep: f32 = 0.5,
        /// Is what is fast looked out for: swept against what stands and what is led, met in time by what moves?
        pub continuous: bool = true,
        /// Friction of a pair from the frictions of its shapes, for contacts that begin from now on.
        pub friction_mix: Mix = Mix::GeometricMean,
        /// Restitution of a pair from the restitutions of its shapes, for contacts that begin from now on.
        pub restitution_mix: Mix = Mix::Min,
    }
}

impl Settings {
    /// Can a world run on these settings? Every step checks it.
    ///
    /// # Errors
    /// Names the first number that is not finite or out of range.
    pub fn validate(&self) -> Result<(), Error> {
        for (name, value) in [("substeps", self.substeps), ("iterations", self.iterations)] {
            Error::check(name, value, (1..=1000).contains(&value), "1 to 1000")?;
        }
        Error::check_positive("length_unit", self.length_unit)?;
        Error::check_positive("contact_hertz", self.contact_hertz)?;
        Error::check_not_negative("contact_damping_ratio", self.contact_damping_ratio)?;
        Error::check_not_negative("push_speed", self.push_speed)?;
        Error::check_not_negative("restitution_threshold", self.restitution_threshold)?;
        Error::check_not_negative("hit_event_threshold", self.hit_event_threshold)?;
        Error::check_positive("max_speed", self.max_speed)?;
        Error::check_not_negative("time_to_sleep", self.time_to_sleep)
    }
}
