//! The manifold of two rounded boxes: the one kernel that all box and capsule pairs use.

use super::lane::{ABSENT, sign};
use super::{LaneManifold, LanePair};
use crate::simd::Lanes;

/// An axis replaces an earlier one (A before B, x before y) only if it separates by this fraction of
/// the smaller box more: ties, and all that rounding makes of them, keep their axis.
const AXIS_BIAS: f32 = 5.0e-4;

/// Below this fraction of both boxes' size, the direction between two corners is rounding noise.
const NOISE: f32 = 4.0e-5;

/// Two points nearer to each other than this fraction of the smaller box and of where they are along the face are one.
const MIN_WIDTH: f32 = 4.0e-6;

/// Box against box, both with a radius; A and B may be flat (capsules) or points (circles).
#[inline(always)]
pub(crate) fn box_box<L: Lanes>(
    token: L::Token,
    pair: &LanePair<L>,
    max_separation: L,
) -> LaneManifold<L> {
    let scale = Scale::of(token, pair);
    let view = View::along_best_axis(token, pair, scale.bias);
    let edge = Edge::facing(token, &view);
    let normal = nearest_direction(token, &view, &edge, scale.noise);
    let overlap = Overlap::of(token, &view, &edge, normal);
    view.manifold(token, pair, &overlap, max_separation, &scale)
}

/// Lengths that depend on the size of the boxes, metres.
#[derive(Clone, Copy)]
pub(super) struct Scale<L> {
    /// What an axis must be better by.
    pub(super) bias: L,
    /// Shorter than this has no direction.
    pub(super) noise: L,
    /// The smaller box's size.
    pub(super) smaller: L,
    /// Both radii.
    pub(super) radius: L,
}

impl<L: Lanes> Scale<L> {
    #[inline(always)]
    pub(super) fn of(token: L::Token, pair: &LanePair<L>) -> Self {
        let size_a = pair.a[0] + pair.a[1] + pair.a[2];
        let size_b = pair.b[0] + pair.b[1] + pair.b[2];
        Self {
            bias: L::splat(token, AXIS_BIAS) * size_a.min(size_b),
            smaller: size_a.min(size_b),
            noise: L::splat(token, NOISE) * (size_a + size_b),
            radius: pair.a[2] + pair.b[2],
        }
    }

    /// Is there more between the ends of an overlap than rounding? Both are ends of the smaller box, wherever that lies.
    #[inline(always)]
    pub(super) fn is_wide(&self, token: L::Token, low: L, high: L) -> L::Mask {
        let size = low.abs() + high.abs() + self.smaller;
        (high - low).gt(L::splat(token, MIN_WIDTH) * size)
    }
}

/// The pair seen along the axis of greatest separation: one box is the *reference*, whose face the axis
/// belongs to, and coordinates are `(n, t)`: `n` outwards from that face, `t` a quarter turn
/// anticlockwise from it, the reference's centre at the origin. A point's two coordinates always come in
/// this order.
struct View<L: Lanes> {
    /// The reference is B.
    flipped: L::Mask,
    /// The axis is the reference's y axis.
    vertical: L::Mask,
    /// The face is on the positive side (1) or the negative (-1).
    side: L,
    /// Half extents of the reference along n and t.
    half: [L; 2],
    /// Centre of the other box.
    center: [L; 2],
    /// Its rotation from (n, t) to its own axes.
    rotation: [L; 2],
    /// Its half extents along its own axes.
    other: [L; 2],
}

impl<L: Lanes> View<L> {
    /// Separating axes: on an axis of A the cores' separation is `|p| - h_a - |R| h_b`, on one of B
    /// `|R^T p| - h_b - |R^T| h_a`.
    #[inline(always)]
    fn along_best_axis(token: L::Token, pair: &LanePair<L>, bias: L) -> Self {
        let ([px, py], [c, s]) = (pair.p, pair.q);
        let ([ax, ay, _], [bx, by, _]) = (pair.a, pair.b);
        let (abs_c, abs_s) = (c.abs(), s.abs());
        // A's centre in B's frame, with the sign turned.
        let (dx, dy) = (c * px + s * py, c * py - s * px);

        let sep_ax = px.abs() - (ax + abs_c * bx + abs_s * by);
        let sep_ay = py.abs() - (ay + abs_s * bx + abs_c * by);
        let sep_bx = dx.abs() - (bx + abs_c * ax + abs_s * ay);
        let sep_by = dy.abs() - (by + abs_s * ax + abs_c * ay);

        let vertical_a = sep_ay.gt(sep_ax + bias);
        let vertical_b = sep_by.gt(sep_bx + bias);
        let sep_a = L::select(vertical_a, sep_ay, sep_ax);
        let sep_b = L::select(vertical_b, sep_by, sep_bx);
        let flipped = sep_b.gt(sep_a + bias);
        let vertical = L::or(L::and(flipped, vertical_b), L::and(L::not(flipped), vertical_a));

        let center = [L::select(flipped, -dx, px), L::select(flipped, -dy, py)];
        let sine = L::select(flipped, -s, s);
        let reference = [L::select(flipped, bx, ax), L::select(flipped, by, ay)];
        let other = [L::select(flipped, ax, bx), L::select(flipped, ay, by)];
        let along = L::select(vertical, center[1], center[0]);
        let side = sign(token, along);
        Self {
            flipped,
            vertical,
            side,
            half: [
                L::select(vertical, reference[1], reference[0]),
                L::select(vertical, reference[0], reference[1]),
            ],
            center: [along.abs(), side * L::select(vertical, -center[0], center[1])],
            rotation: [side * L::select(vertical, sine, c), side * L::select(vertical, -c, sine)],
            other,
        }
    }

    /// Number of the reference's face: 0 for +x, 1 for -x, 2 for +y, 3 for -y.
    #[inline(always)]
    fn face(&self, token: L::Token) -> L {
        let (zero, one) = (L::splat(token, 0.0), L::splat(token, 1.0));
        let negative = L::select(self.side.lt(zero), one, zero);
        L::select(self.vertical, L::splat(token, 2.0) + negative, negative)
    }

    /// A direction of the view in the frame of A's box.
    #[inline(always)]
    fn direction_in_a(&self, pair: &LanePair<L>, [n, t]: [L; 2]) -> [L; 2] {
        let (n, t) = (self.side * n, self.side * t);
        let (x, y) = (L::select(self.vertical, -t, n), L::select(self.vertical, n, t));
        let [c, s] = pair.q;
        [L::select(self.flipped, c * x - s * y, x), L::select(self.flipped, s * x + c * y, y)]
    }

    /// Both ends of the overlap as points in the frame of A, in A's order.
    #[inline(always)]
    fn manifold(
        &self,
        token: L::Token,
        pair: &LanePair<L>,
        overlap: &Overlap<L>,
        max_separation: L,
        scale: &Scale<L>,
    ) -> LaneManifold<L> {
        let [kn, kt] = overlap.normal;
        let (zero, half) = (L::splat(token, 0.0), L::splat(token, 0.5));
        let radius_reference = L::select(self.flipped, pair.b[2], pair.a[2]);
        let radius_other = L::select(self.flipped, pair.a[2], pair.b[2]);
        // Height of the reference's surface plus that of the other's, beyond their cores.
        let lift = radius_reference - radius_other;
        // Seen from the other side, the low end is the high one.
        let ends = [
            L::select(self.flipped, overlap.high, overlap.low),
            L::select(self.flipped, overlap.low, overlap.high),
        ];
        let wide = scale.is_wide(token, overlap.low, overlap.high);

        let direction = self.direction_in_a(pair, overlap.normal);
        let normal = [
            L::select(self.flipped, -direction[0], direction[0]),
            L::select(self.flipped, -direction[1], direction[1]),
        ];
        let mut points = [[zero, zero]; 2];
        let mut separation = [L::splat(token, ABSENT); 2];
        for i in 0..2 {
            let u = ends[i];
            let below = overlap.reference.height(u);
            let above = overlap.other.height(u);
            let gap = (above - below) - scale.radius;
            let height = half * ((above + below) + lift);
            let at = [height * kn - u * kt, height * kt + u * kn];
            let [x, y] = self.direction_in_a(pair, at);
            let x = L::select(self.flipped, x + pair.p[0], x);
            let y = L::select(self.flipped, y + pair.p[1], y);
            let near = gap.le(max_separation);
            let there = if i == 0 { near } else { L::and(near, wide) };
            points[i] = [L::select(there, x, zero), L::select(there, y, zero)];
            separation[i] = L::select(there, gap, separation[i]);
        }
        let first = self.first_id(token, overlap);
        LaneManifold { normal, points, separation, id: [first, first + L::splat(token, 1.0)] }
    }

    /// Face of A times 8 plus face of B times 2; the end of the overlap is added to it.
    #[inline(always)]
    fn first_id(&self, token: L::Token, overlap: &Overlap<L>) -> L {
        let reference = self.face(token);
        let face_a = L::select(self.flipped, overlap.face, reference);
        let face_b = L::select(self.flipped, reference, overlap.face);
        L::splat(token, 8.0) * face_a + L::splat(token, 2.0) * face_b
    }
}

/// The edge of the other box that faces the reference.
struct Edge<L> {
    /// Its middle.
    center: [L; 2],
    /// Unit, with `t` rising: at least cos 45 degrees.
    tangent: [L; 2],
    /// Half its length.
    half: L,
    /// Number of its face.
    face: L,
}

impl<L: Lanes> Edge<L> {
    /// The face whose normal is most opposed to `n`; that normal is `(-t-part, n-part)` of the tangent.
    #[inline(always)]
    fn facing(token: L::Token, view: &View<L>) -> Self {
        let (zero, one) = (L::splat(token, 0.0), L::splat(token, 1.0));
        let [c, s] = view.rotation;
        let upright = s.abs().le(c.abs());
        let (sign_c, sign_s) = (sign(token, c), sign(token, s));
        // Normal of the face: -sign(c) times the x axis (c, s), or sign(s) times the y axis (-s, c).
        let normal =
            [-L::select(upright, c.abs(), s.abs()), L::select(upright, -(sign_c * s), sign_s * c)];
        let outwards = L::select(upright, view.other[0], view.other[1]);
        let negative_x = L::select(c.lt(zero), zero, one);
        let negative_y = L::select(s.lt(zero), L::splat(token, 3.0), L::splat(token, 2.0));
        Self {
            center: [view.center[0] + normal[0] * outwards, view.center[1] + normal[1] * outwards],
            tangent: [normal[1], -normal[0]],
            half: L::select(upright, view.other[1], view.other[0]),
            face: L::select(upright, negative_x, negative_y),
        }
    }
}

/// The normal in the view: `n`, unless the cores are apart and the edge's lowest point lies beside the
/// reference face; then the direction from the face's end to the nearest point of the edge.
#[inline(always)]
fn nearest_direction<L: Lanes>(
    token: L::Token,
    view: &View<L>,
    edge: &Edge<L>,
    noise: L,
) -> [L; 2] {
    let (zero, one) = (L::splat(token, 0.0), L::splat(token, 1.0));
    let [tangent_n, tangent_t] = edge.tangent;
    // The lowest end, and the end of the reference face on its side.
    let to_lowest = L::select(tangent_n.lt(zero), edge.half, -edge.half);
    let lowest_t = edge.center[1] + tangent_t * to_lowest;
    let corner_n = view.half[0];
    let corner_t = lowest_t.clamp(-view.half[1], view.half[1]);
    // Nearest to that corner on the edge.
    let (from_n, from_t) = (corner_n - edge.center[0], corner_t - edge.center[1]);
    let along = (from_n * tangent_n + from_t * tangent_t).clamp(-edge.half, edge.half);
    let (dn, dt) = (along * tangent_n - from_n, along * tangent_t - from_t);

    let length = (dn * dn + dt * dt).sqrt();
    let beside = view.half[1].lt(lowest_t.abs());
    let usable = L::and(length.gt(noise), length.lt(L::splat(token, f32::INFINITY)));
    let corner = L::and(L::and(beside, dn.gt(zero)), usable);
    let inv_length = one / L::select(corner, length, one);
    [L::select(corner, dn * inv_length, one), L::select(corner, dt * inv_length, zero)]
}

/// An edge over the line across the normal: its height along the normal.
#[derive(Clone, Copy)]
struct Profile<L> {
    /// Where its middle is, across and along the normal.
    middle: L,
    height: L,
    slope: L,
    /// Half its width across the normal.
    half: L,
}

impl<L: Lanes> Profile<L> {
    /// The reference face: at height `half[0]`, flat, `half[1]` to both sides of the middle. The normal
    /// is within 45 degrees of `n`.
    #[inline(always)]
    fn of_reference(half: [L; 2], [kn, kt]: [L; 2]) -> Self {
        Self { middle: -(half[0] * kt), height: half[0] * kn, slope: kt / kn, half: half[1] * kn }
    }

    /// The edge that faces it. The angle between its tangent and the normal is at least 22 degrees.
    #[inline(always)]
    fn of_edge(edge: &Edge<L>, [kn, kt]: [L; 2]) -> Self {
        let across = edge.tangent[1] * kn - edge.tangent[0] * kt;
        let along = edge.tangent[0] * kn + edge.tangent[1] * kt;
        Self {
            middle: edge.center[1] * kn - edge.center[0] * kt,
            height: edge.center[0] * kn + edge.center[1] * kt,
            slope: along / across,
            half: edge.half * across,
        }
    }

    #[inline(always)]
    fn height(&self, at: L) -> L {
        self.height + (at - self.middle) * self.slope
    }
}

/// Where the shadows of both edges across the normal overlap.
struct Overlap<L> {
    normal: [L; 2],
    reference: Profile<L>,
    other: Profile<L>,
    low: L,
    high: L,
    /// Number of the other edge's face.
    face: L,
}

impl<L: Lanes> Overlap<L> {
    /// Shadows that only just miss each other count as one point in the middle of the gap.
    #[inline(always)]
    fn of(token: L::Token, view: &View<L>, edge: &Edge<L>, normal: [L; 2]) -> Self {
        let half = L::splat(token, 0.5);
        let reference = Profile::of_reference(view.half, normal);
        let other = Profile::of_edge(edge, normal);
        let low = (reference.middle - reference.half).max(other.middle - other.half);
        let high = (reference.middle + reference.half).min(other.middle + other.half);
        let middle = half * (low + high);
        let crossed = high.lt(low);
        Self {
            normal,
            reference,
            other,
            low: L::select(crossed, middle, low),
            high: L::select(crossed, middle, high),
            face: edge.face,
        }
    }
}
