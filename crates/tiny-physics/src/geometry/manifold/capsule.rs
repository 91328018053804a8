//! Manifolds of a capsule against a box or another capsule: a capsule's core is a box without height.

use super::{LaneManifold, LanePair, box_box};
use crate::simd::Lanes;

/// Capsule against capsule: two points where they lie side by side, else one.
#[inline(always)]
pub(crate) fn capsule_capsule<L: Lanes>(
    token: L::Token,
    pair: &LanePair<L>,
    max_separation: L,
) -> LaneManifold<L> {
    box_box(token, pair, max_separation)
}

/// Box (A) against capsule.
#[inline(always)]
pub(crate) fn box_capsule<L: Lanes>(
    token: L::Token,
    pair: &LanePair<L>,
    max_separation: L,
) -> LaneManifold<L> {
    box_box(token, pair, max_separation)
}
