//! Broad phase: from boxes and ids to the pairs whose boxes overlap. It knows nothing of shapes or
//! bodies.
//!
//! [`BroadPhase`] is what the world uses: proxies with fat boxes in one [`DynamicTree`] per kind of
//! body. [`SpatialHash`](crate::SpatialHash) is the simple alternative for boxes that are collected anew every step.
//!
//! # What was measured
//!
//! Nanoseconds per moved box and step, moving plus finding partners, on one core with SSE2,
//! medians, all in one process in turns (`cargo bench --bench broad_phase`; the first four rows are
//! of an earlier run, slower by a tenth, in which the grid took 245, 203, 185, 376). *Tumbler* and
//! *spinner* stir 2,000 and 6,000 boxes, two thirds of which leave their fat boxes every step;
//! *falling*: 10,000; *smash*: 600 of 9,600.
//!
//! | structure | tumbler | spinner | falling | smash |
//! |---|---|---|---|---|
//! | binary tree, reinsertion with rotations | 1107 | 1110 | 1263 | 1232 |
//! | binary tree, rebuilt after as many moves as boxes | 1164 | 1152 | 1372 | 1301 |
//! | eight-ary tree, reinsertion | 619 | 518 | 514 | 653 |
//! | eight-ary tree, stretched in place, rebuilt after 4 moves a box | 279 | 253 | 264 | 350 |
//! | the same, rebuilt when the nodes grew by a quarter | 273 | 269 | 208 | 254 |
//! | the same, moved boxes of a node ask together: **[`BroadPhase`]** | 155 | 145 | 146 | 189 |
//! | uniform grid, counting sort every step | 223 | 177 | 162 | 292 |
//! | [`SpatialHash`](crate::SpatialHash) filled every step | 443 | 348 | 334 | 739 |
//!
//! The grid has no filters and needs boxes of one size; it pays for every box when one moves. With
//! 300,000 falling circles of which a third move, it is ahead (261 against 476): there the tree
//! waits for memory. Where nothing moves, the trees do nothing at all. AVX2 gained less than a
//! tenth over SSE2.
//!
//! Since then two nodes that both have moved boxes meet once, a leaf is looked at for those boxes of a node alone that
//! overlap it, and which pairs are new is seen side by side: in spinner a third of the instructions per moved box.

mod cast;
mod node_boxes;
mod proxies;
mod stack;
mod tree;

pub use cast::{BoxCast, Nearest, Search};
pub use proxies::{BroadPhase, ProxyDef, ProxyId, ProxyKind};
pub use tree::DynamicTree;

use crate::math::{Aabb, Vec2};

/// "No node", "no proxy".
const NONE: u32 = u32::MAX;

/// Coordinates beyond this many metres are treated as this many.
pub const LIMIT: f32 = 1.0e18;

/// The box with every coordinate between minus and plus [`LIMIT`]; [`Aabb::EMPTY`] for a box with
/// NaN or with `min > max`. Boxes that overlap still do so afterwards.
#[inline]
pub fn clamped(aabb: Aabb) -> Aabb {
    if !(aabb.min.x <= aabb.max.x && aabb.min.y <= aabb.max.y) {
        return Aabb::EMPTY;
    }
    let (low, high) = (Vec2::splat(-LIMIT), Vec2::splat(LIMIT));
    Aabb::new(aabb.min.max(low).min(high), aabb.max.max(low).min(high))
}

/// Sorts pairs and drops repeated ones: the last step after ranges were queried by several threads.
pub fn sort_pairs(pairs: &mut Vec<(u32, u32)>) {
    pairs.sort_unstable_by_key(|&(a, b)| u64::from(a) << 32 | u64::from(b));
    pairs.dedup();
}

#[cfg(test)]
pub(crate) mod tests;
