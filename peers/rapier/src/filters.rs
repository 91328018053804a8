//! Collision filters translated to Rapier's.
//!
//! Rapier has 32 bits of membership and no groups that override them; descriptions have 64 bits and
//! signed groups. So each distinct filter of a scene becomes one class with one bit: an exact
//! translation as long as a scene has at most 32 distinct filters, without a callback in the way.

use rapier2d::prelude::{Group, InteractionGroups, InteractionTestMode};
use tiny_physics::Filter;

/// The distinct filters met so far; a filter's place is its bit.
#[derive(Default)]
pub struct Filters {
    classes: Vec<Filter>,
}

impl Filters {
    /// Rapier's groups for a filter; `None` for the 33rd distinct one.
    pub fn groups(&mut self, filter: Filter) -> Option<InteractionGroups> {
        let known = self.classes.iter().position(|&class| class == filter);
        let class = known.unwrap_or_else(|| {
            self.classes.push(filter);
            self.classes.len() - 1
        });
        let membership = 1_u32.checked_shl(class as u32)?;
        // A class that is not known yet is let in: it will name this one, if it must, when it comes,
        // and both sides have to agree.
        let mut mask = u32::MAX;
        for (bit, other) in self.classes.iter().enumerate() {
            if !filter.collides(other) {
                mask &= !(1 << bit);
            }
        }
        let (membership, mask) = (Group::from(membership), Group::from(mask));
        Some(InteractionGroups::new(membership, mask, InteractionTestMode::And))
    }

    /// Rapier's groups for a query of all shapes with a category in `mask`.
    pub fn query(&self, mask: u64) -> InteractionGroups {
        let mut bits = 0_u32;
        for (bit, class) in self.classes.iter().enumerate().take(32) {
            bits |= u32::from(class.category & mask != 0) << bit;
        }
        InteractionGroups::new(Group::ALL, Group::from(bits), InteractionTestMode::And)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_rule_for_every_pair() {
        let mut filters = vec![Filter::default()];
        for group in -4..=2 {
            filters.push(Filter { category: 2, mask: 3, group });
            filters.push(Filter { category: 2, mask: 1, group });
            filters.push(Filter { category: 1 << 40, mask: u64::MAX ^ 1, group });
        }
        let mut classes = Filters::default();
        let groups: Vec<_> = filters.iter().map(|&filter| classes.groups(filter)).collect();
        for (a, groups_a) in filters.iter().zip(&groups) {
            for (b, groups_b) in filters.iter().zip(&groups) {
                let (groups_a, groups_b) = (groups_a.expect("few"), groups_b.expect("few"));
                assert_eq!(groups_a.test(groups_b), a.collides(b), "{a:?} {b:?}");
            }
        }
    }
}
