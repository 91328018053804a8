//! Manifolds of a circle, which is always B (or both): one point, by the closest point of A's core.

use super::lane::sign;
use super::{LaneManifold, LanePair};
use crate::simd::Lanes;

/// A shorter line between two centres has no direction, metres.
const MIN_LENGTH: f32 = 1.0e-9;

/// Circle against circle. Coincident centres give the normal (0, 1).
#[inline(always)]
pub(crate) fn circle_circle<L: Lanes>(
    token: L::Token,
    pair: &LanePair<L>,
    max_separation: L,
) -> LaneManifold<L> {
    let zero = L::splat(token, 0.0);
    let up = [zero, L::splat(token, 1.0)];
    let point = [zero; 2];
    near_point(token, pair, Nearest { point, normal: up, distance: zero }, max_separation)
}

/// Capsule (A, along x) against circle. A centre on the core gives A's y axis.
#[inline(always)]
pub(crate) fn capsule_circle<L: Lanes>(
    token: L::Token,
    pair: &LanePair<L>,
    max_separation: L,
) -> LaneManifold<L> {
    let zero = L::splat(token, 0.0);
    let up = [zero, L::splat(token, 1.0)];
    let point = [pair.p[0].clamp(-pair.a[0], pair.a[0]), zero];
    near_point(token, pair, Nearest { point, normal: up, distance: zero }, max_separation)
}

/// Box (A) against circle. A centre inside the core is pushed out along the axis of least overlap, a
/// tie along x.
#[inline(always)]
pub(crate) fn box_circle<L: Lanes>(
    token: L::Token,
    pair: &LanePair<L>,
    max_separation: L,
) -> LaneManifold<L> {
    let zero = L::splat(token, 0.0);
    let ([x, y], [hx, hy, _]) = (pair.p, pair.a);
    let (inside_x, inside_y) = (x.abs() - hx, y.abs() - hy);
    let vertical = inside_y.gt(inside_x);
    let (sign_x, sign_y) = (sign(token, x), sign(token, y));
    let normal = [L::select(vertical, zero, sign_x), L::select(vertical, sign_y, zero)];

    let inside = L::and(inside_x.le(zero), inside_y.le(zero));
    let point = [
        L::select(L::and(inside, L::not(vertical)), sign_x * hx, x.clamp(-hx, hx)),
        L::select(L::and(inside, vertical), sign_y * hy, y.clamp(-hy, hy)),
    ];
    let distance = L::select(inside, inside_x.max(inside_y), zero);
    near_point(token, pair, Nearest { point, normal, distance }, max_separation)
}

/// The point of A's core nearest to the circle's centre.
struct Nearest<L> {
    point: [L; 2],
    /// The normal where the centre is on the core or inside it.
    normal: [L; 2],
    /// The signed distance there: 0 on the core, negative inside.
    distance: L,
}

/// One point on the line from the core's nearest point to the centre of B.
#[inline(always)]
fn near_point<L: Lanes>(
    token: L::Token,
    pair: &LanePair<L>,
    nearest: Nearest<L>,
    max_separation: L,
) -> LaneManifold<L> {
    let (zero, one, half) = (L::splat(token, 0.0), L::splat(token, 1.0), L::splat(token, 0.5));
    let (radius_a, radius_b) = (pair.a[2], pair.b[2]);
    let [x, y] = [pair.p[0] - nearest.point[0], pair.p[1] - nearest.point[1]];
    let length = (x * x + y * y).sqrt();
    let apart = L::and(
        L::and(zero.le(nearest.distance), length.gt(L::splat(token, MIN_LENGTH))),
        length.lt(L::splat(token, f32::INFINITY)),
    );
    let inv_length = one / L::select(apart, length, one);
    let normal = [
        L::select(apart, x * inv_length, nearest.normal[0]),
        L::select(apart, y * inv_length, nearest.normal[1]),
    ];
    let distance = L::select(apart, length, nearest.distance);

    let separation = distance - (radius_a + radius_b);
    // From the core: A's surface is at radius_a, B's at distance - radius_b.
    let middle = half * (distance + (radius_a - radius_b));
    let point = [nearest.point[0] + normal[0] * middle, nearest.point[1] + normal[1] * middle];
    LaneManifold::single(token, normal, point, separation, max_separation)
}
