//! Questions to Box2D's world.

use crate::shapes::vec2;
use boxdd_sys::ffi::*;
use core::ffi::c_void;
use tiny_physics::Vec2;

const ORIGIN: b2Pos = b2Vec2 { x: 0.0, y: 0.0 };

fn filter(mask: u64) -> b2QueryFilter {
    b2QueryFilter { categoryBits: u64::MAX, maskBits: mask }
}

/// Fraction of `translation` at which a ray meets the first shape.
pub fn ray_cast(world: b2WorldId, origin: Vec2, translation: Vec2, mask: u64) -> Option<f32> {
    // SAFETY: the world is live, all else are plain values.
    let hit =
        unsafe { b2World_CastRayClosest(world, vec2(origin), vec2(translation), filter(mask)) };
    hit.hit.then_some(hit.fraction)
}

/// The same for a moving circle.
pub fn circle_cast(
    world: b2WorldId,
    center: Vec2,
    radius: f32,
    translation: Vec2,
    mask: u64,
) -> Option<f32> {
    unsafe extern "C" fn keep_closest(
        _: b2ShapeId,
        _: b2Pos,
        _: b2Vec2,
        fraction: f32,
        context: *mut c_void,
    ) -> f32 {
        // SAFETY: the context is `closest` below, which no one else touches during the call.
        unsafe { *context.cast::<Option<f32>>() = Some(fraction) };
        fraction
    }
    let mut closest: Option<f32> = None;
    let context = (&raw mut closest).cast();
    let (center, translation) = (vec2(center), vec2(translation));
    // SAFETY: the world is live; `center`, `proxy` and the context outlive the calls.
    unsafe {
        let proxy = b2MakeProxy(&center, 1, radius);
        let keep = Some(keep_closest as unsafe extern "C" fn(_, _, _, _, _) -> _);
        b2World_CastShape(world, ORIGIN, &proxy, translation, filter(mask), keep, context);
    }
    closest
}

/// How many shapes have a box that overlaps this one.
pub fn count_overlaps(world: b2WorldId, lower: Vec2, upper: Vec2, mask: u64) -> usize {
    unsafe extern "C" fn count(_: b2ShapeId, context: *mut c_void) -> bool {
        // SAFETY: the context is `found` below, which no one else touches during the call.
        unsafe { *context.cast::<usize>() += 1 };
        true
    }
    let mut found = 0_usize;
    let aabb = b2AABB { lowerBound: vec2(lower), upperBound: vec2(upper) };
    let context = (&raw mut found).cast();
    // SAFETY: the world is live; the context outlives the call.
    unsafe { b2World_OverlapAABB(world, ORIGIN, aabb, filter(mask), Some(count), context) };
    found
}
