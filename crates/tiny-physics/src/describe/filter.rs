//! Which shapes collide with which.

use crate::codec::described;

described! {
    /// Decides which pairs of shapes collide.
    ///
    /// Two shapes with the same `group` other than 0 always collide if it is positive and never if it is
    /// negative. Otherwise they collide when each one's `mask` has a bit of the other's `category`.
    #[derive(Clone, Copy, PartialEq, Eq, Debug)]
    pub struct Filter {
        /// What this shape is, as bits.
        pub category: u64 = 1,
        /// What it collides with, as bits.
        pub mask: u64 = u64::MAX,
        /// Overrides category and mask between members of one group; 0 is no group.
        pub group: i32 = 0,
    }
}

impl Filter {
    /// Collides with nothing and is seen by nothing, for a shape that is to be switched off for a while: give it this
    /// one, and later its own again. Its mass stays.
    pub const NONE: Self = Self { category: 0, mask: 0, group: 0 };

    /// Do shapes with these filters collide?
    #[inline]
    pub fn collides(&self, other: &Self) -> bool {
        if self.group == other.group && self.group != 0 {
            return self.group > 0;
        }
        self.mask & other.category != 0 && other.mask & self.category != 0
    }

    /// Category and mask by which the broad phase may pass over pairs: all bits where a positive group
    /// overrides them.
    pub(crate) fn reach(&self) -> (u64, u64) {
        if self.group > 0 { (u64::MAX, u64::MAX) } else { (self.category, self.mask) }
    }
}
