//! Broad phase: from boxes and ids to the pairs whose boxes overlap. It knows nothing of shapes or bodies.
//!
//! [`BroadPhase`] is what the world uses: proxies with fat boxes in one [`DynamicTree`] per kind of
//! body. [`SpatialHash`] is the simple alternative for boxes that are collected anew every step.

mod cast;
mod proxies;
mod stack;
mod tree;

pub use cast::BoxCast;
pub use proxies::{BroadPhase, ProxyDef, ProxyId, ProxyKind, sort_pairs};
pub use tree::DynamicTree;

use crate::math::{Aabb, Vec2};

/// "No node", "no proxy".
const NONE: u32 = u32::MAX;

/// Coordinates beyond this many metres are treated as this many.
pub const LIMIT: f32 = 1.0e18;

/// The box with every coordinate between minus and plus [`LIMIT`]; [`Aabb::EMPTY`] for a box with NaN
/// or with `min > max`. Boxes that overlap still do so afterwards.
#[inline]
fn clamped(aabb: Aabb) -> Aabb {
    if !(aabb.min.x <= aabb.max.x && aabb.min.y <= aabb.max.y) {
        return Aabb::EMPTY;
    }
    let (low, high) = (Vec2::splat(-LIMIT), Vec2::splat(LIMIT));
    Aabb::new(aabb.min.max(low).min(high), aabb.max.max(low).min(high))
}

#[cfg(test)]
mod tests;
