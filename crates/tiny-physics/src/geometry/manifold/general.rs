//! Manifolds with a general polygon, in lanes: the method of the box kernel over lists of corners.
//!
//! A shape that is no general polygon takes part as its rounded box, so a segment has end faces of no
//! width and a circle's centre has four faces of no width; with these, the best axis is always within 45
//! degrees of the direction between two nearest corners.

use super::box_box::Scale;
use super::lane::ABSENT;
use super::{LaneManifold, LanePair, ShapeClass};
use crate::geometry::{MAX_VERTICES, Polygon, Shape};
use crate::math::Vec2;
use crate::simd::{Lanes, Row, RowSource, RowsOf};

/// An edge this steep against the normal (sine of the angle between them) counts as its lowest end alone.
const MIN_SINE: f32 = 0.1;

/// Where the corners of a shape are, for [`LaneOutline`].
#[derive(Clone, Copy)]
pub(crate) struct Outline<'a> {
    polygon: &'a Polygon,
    /// The middle of the box, and what differences from it are multiplied with.
    center: Vec2,
    scale: Vec2,
}

impl<'a> Outline<'a> {
    pub(crate) const UNIT_BOX: Self =
        Self { polygon: &Polygon::UNIT_BOX, center: Vec2::ZERO, scale: Vec2::new(1.0, 1.0) };

    /// That of a shape of a class, of whose box these are the middle and the half extents. Anything but a general
    /// polygon is a box of half extents 1, stretched.
    #[inline]
    pub(crate) fn of(shape: &'a Shape, class: ShapeClass, center: Vec2, half: Vec2) -> Self {
        match shape {
            Shape::Polygon(polygon) if class == ShapeClass::General => {
                Self { polygon, center, ..Self::UNIT_BOX }
            }
            _ => Self { scale: half, ..Self::UNIT_BOX },
        }
    }
}

/// Four corners of each outline, from a first one on, or the normals of their faces.
#[derive(Clone, Copy)]
struct Four<'a, const NORMALS: bool> {
    outlines: &'a [Outline<'a>],
    first: usize,
}

impl<const NORMALS: bool> RowSource for Four<'_, NORMALS> {
    /// Those of the first outlines, whatever the indices.
    #[inline(always)]
    fn at<const N: usize>(self, _: &[u32]) -> impl RowsOf {
        self
    }
}

impl<const NORMALS: bool> RowsOf for Four<'_, NORMALS> {
    #[inline(always)]
    fn row(&self, i: usize) -> Row {
        let Outline { polygon, center, scale } = self.outlines[i];
        let (corners, normals) = polygon.padded();
        let vectors = if NORMALS { normals } else { corners };
        let mut row = [0.0; 8];
        for (i, &Vec2 { x, y }) in vectors[self.first..][..4].iter().enumerate() {
            row[2 * i] = if NORMALS { x } else { (x - center.x) * scale.x };
            row[2 * i + 1] = if NORMALS { y } else { (y - center.y) * scale.y };
        }
        row
    }
}

/// Convex polygons of up to eight corners, one a lane, in the frame of the box of A.
#[derive(Clone, Copy)]
struct LaneOutline<L> {
    /// With the first once more at the end.
    corners: [[L; 2]; MAX_VERTICES + 1],
    /// Normal `i` belongs to the edge from corner `i` to the next, which may have no length.
    normals: [[L; 2]; MAX_VERTICES],
    /// Of the lane that has most. Places that a lane does not need repeat its first ones.
    count: usize,
}

/// A face of each outline: its number, normal and ends, anticlockwise.
#[derive(Clone, Copy)]
struct Face<L> {
    number: L,
    normal: [L; 2],
    start: [L; 2],
    end: [L; 2],
}

impl<L: Lanes> Face<L> {
    #[inline(always)]
    fn select(mask: L::Mask, yes: &Self, no: &Self) -> Self {
        Self {
            number: L::select(mask, yes.number, no.number),
            normal: either(mask, yes.normal, no.normal),
            start: either(mask, yes.start, no.start),
            end: either(mask, yes.end, no.end),
        }
    }
}

impl<L: Lanes> LaneOutline<L> {
    /// The first outlines of a list, seen from the parent of the frame that they are in.
    #[inline(always)]
    fn gather(token: L::Token, outlines: &[Outline<'_>], frame: Frame<L>) -> Self {
        let outlines = &outlines[..L::WIDTH];
        let mut count = 0;
        for outline in outlines {
            count = count.max(outline.polygon.vertices().len());
        }
        let ([a, b, c, d], [e, f, g, h]) = four(token, outlines, 0, frame);
        let corners = [a, b, c, d, a, b, c, d, a];
        let mut outline = Self { corners, normals: [e, f, g, h, e, f, g, h], count };
        if count > 4 {
            let (corners, normals) = four(token, outlines, 4, frame);
            outline.corners[4..8].copy_from_slice(&corners);
            outline.normals[4..].copy_from_slice(&normals);
        }
        outline
    }

    #[inline(always)]
    fn count(&self) -> usize {
        if self.count < MAX_VERTICES { self.count } else { MAX_VERTICES }
    }

    #[inline(always)]
    fn face(&self, face: usize, number: L) -> Face<L> {
        Face {
            number,
            normal: self.normals[face],
            start: self.corners[face],
            end: self.corners[face + 1],
        }
    }

    /// The face that separates this outline from `other` most, and by how much. A later face replaces an earlier one
    /// only if it does so by the bias more.
    #[inline(always)]
    fn best_face(&self, token: L::Token, other: &Self, bias: L) -> (Face<L>, L) {
        let (mut number, one) = (L::splat(token, 0.0), L::splat(token, 1.0));
        let (mut best, mut most) = (self.face(0, number), self.separation(0, other));
        for i in 1..self.count() {
            number = number + one;
            let separation = self.separation(i, other);
            let better = separation.gt(most + bias);
            best = Face::select(better, &self.face(i, number), &best);
            most = L::select(better, separation, most);
        }
        (best, most)
    }

    /// How far a face separates this outline from `other`.
    #[inline(always)]
    fn separation(&self, face: usize, other: &Self) -> L {
        let normal = self.normals[face];
        let mut lowest = dot(normal, other.corners[0]);
        for i in 1..other.count() {
            lowest = dot(normal, other.corners[i]).min(lowest);
        }
        lowest - dot(normal, self.corners[face])
    }

    /// The face most opposed to a direction; the first of equal ones. Lanes where `flipped` is set take `self`, the
    /// others `other`.
    #[inline(always)]
    fn facing(
        &self,
        token: L::Token,
        other: &Self,
        flipped: L::Mask,
        direction: [L; 2],
    ) -> Face<L> {
        let (mut number, one) = (L::splat(token, 0.0), L::splat(token, 1.0));
        let mut least = Face::select(flipped, &self.face(0, number), &other.face(0, number));
        let mut slope = dot(direction, least.normal);
        let (own, others) = (self.count(), other.count());
        for i in 1..if own > others { own } else { others } {
            number = number + one;
            let face = Face::select(flipped, &self.face(i, number), &other.face(i, number));
            let steeper = dot(direction, face.normal);
            let better = steeper.lt(slope);
            least = Face::select(better, &face, &least);
            slope = L::select(better, steeper, slope);
        }
        least
    }
}

/// Where an outline is: place and rotation; `None` where it is already.
type Frame<L> = Option<[[L; 2]; 2]>;

/// Four corners and four normals, from a first one on.
#[inline(always)]
fn four<L: Lanes>(
    token: L::Token,
    outlines: &[Outline<'_>],
    first: usize,
    frame: Frame<L>,
) -> ([[L; 2]; 4], [[L; 2]; 4]) {
    let mut corners = in_twos(L::gather(token, Four::<false> { outlines, first }, &[]));
    let mut normals = in_twos(L::gather(token, Four::<true> { outlines, first }, &[]));
    if let Some([place, [c, s]]) = frame {
        for [x, y] in &mut corners {
            (*x, *y) = ((c * *x - s * *y) + place[0], (s * *x + c * *y) + place[1]);
        }
        for [x, y] in &mut normals {
            (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
        }
    }
    (corners, normals)
}

#[inline(always)]
fn in_twos<L: Lanes>([a, b, c, d, e, f, g, h]: [L; 8]) -> [[L; 2]; 4] {
    [[a, b], [c, d], [e, f], [g, h]]
}

#[inline(always)]
fn either<L: Lanes>(mask: L::Mask, yes: [L; 2], no: [L; 2]) -> [L; 2] {
    [L::select(mask, yes[0], no[0]), L::select(mask, yes[1], no[1])]
}

#[inline(always)]
fn dot<L: Lanes>(a: [L; 2], b: [L; 2]) -> L {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
fn sub<L: Lanes>(a: [L; 2], b: [L; 2]) -> [L; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// Pairs of shapes with a general polygon.
#[inline(always)]
pub(crate) fn general<L: Lanes>(
    token: L::Token,
    pair: &LanePair<L>,
    [a, b]: [&[Outline<'_>]; 2],
    max_separation: L,
) -> LaneManifold<L> {
    let scale = Scale::of(token, pair);
    let a = &LaneOutline::gather(token, a, None);
    let b = &LaneOutline::gather(token, b, Some([pair.p, pair.q]));
    let (face_a, separation_a) = a.best_face(token, b, scale.bias);
    let (face_b, separation_b) = b.best_face(token, a, scale.bias);
    let flipped = separation_b.gt(separation_a + scale.bias);
    let reference = Face::select(flipped, &face_b, &face_a);
    let other = a.facing(token, b, flipped, reference.normal);
    let out = nearest_direction(token, &reference, &other, scale.noise);
    let normal = either(flipped, [-out[0], -out[1]], out);
    let face_a = Face::select(flipped, &other, &reference);
    let face_b = Face::select(flipped, &reference, &other);
    overlap(token, pair, [&face_a, &face_b], normal, (max_separation, &scale))
}

/// The normal of `face`, unless the cores are apart and the lowest end of the other's edge lies
/// beside it; then the direction from the face's end to the nearest point of that edge.
#[inline(always)]
fn nearest_direction<L: Lanes>(
    token: L::Token,
    face: &Face<L>,
    other: &Face<L>,
    noise: L,
) -> [L; 2] {
    let (zero, one) = (L::splat(token, 0.0), L::splat(token, 1.0));
    let tangent = [-face.normal[1], face.normal[0]];
    let edge = sub(other.end, other.start);
    // The lower end, along the tangent, and the end of the face on its side.
    let falls = dot(face.normal, edge).lt(zero);
    let lowest = dot(tangent, either(falls, other.end, other.start));
    let after = lowest.gt(dot(tangent, face.end));
    let beside = L::or(after, lowest.lt(dot(tangent, face.start)));
    let corner = either(after, face.end, face.start);

    let length_sq = dot(edge, edge);
    let along = dot(edge, sub(corner, other.start));
    let part = along.clamp(zero, length_sq) / L::select(length_sq.gt(zero), length_sq, one);
    let line = sub([other.start[0] + edge[0] * part, other.start[1] + edge[1] * part], corner);
    let length = dot(line, line).sqrt();
    let usable = L::and(length.gt(noise), length.lt(L::splat(token, f32::INFINITY)));
    let usable = L::and(L::and(beside, dot(face.normal, line).gt(zero)), usable);
    let inv_length = one / L::select(usable, length, one);
    either(usable, [line[0] * inv_length, line[1] * inv_length], face.normal)
}

/// Both edges seen along the normal: the ends of the overlap of their shadows are the points.
#[inline(always)]
fn overlap<L: Lanes>(
    token: L::Token,
    pair: &LanePair<L>,
    [a, b]: [&Face<L>; 2],
    normal: [L; 2],
    (max_separation, scale): (L, &Scale<L>),
) -> LaneManifold<L> {
    let half = L::splat(token, 0.5);
    let across = [-normal[1], normal[0]];
    // Anticlockwise along A's face is up across the normal; along B's it is down.
    let below = Profile::of(token, [a.start, a.end], normal, across, L::splat(token, 1.0));
    let above = Profile::of(token, [b.end, b.start], normal, across, L::splat(token, -1.0));
    let (low, high) = (below.low.max(above.low), below.high.min(above.high));
    let (middle, crossed) = (half * (low + high), high.lt(low));
    let ends = [L::select(crossed, middle, low), L::select(crossed, middle, high)];
    let wide = scale.is_wide(token, ends[0], ends[1]);
    let lift = pair.a[2] - pair.b[2];
    let mut points = [[L::splat(token, 0.0); 2]; 2];
    let mut separation = [L::splat(token, ABSENT); 2];
    for (i, at) in ends.into_iter().enumerate() {
        let (below, above) = (below.height(at), above.height(at));
        let gap = (above - below) - scale.radius;
        let height = half * ((above + below) + lift);
        let near = gap.le(max_separation);
        let there = if i == 0 { near } else { L::and(near, wide) };
        let point = [normal[0] * height + across[0] * at, normal[1] * height + across[1] * at];
        points[i] = either(there, point, points[i]);
        separation[i] = L::select(there, gap, separation[i]);
    }
    let faces = L::splat(token, MAX_VERTICES as f32) * a.number + b.number;
    let first = L::splat(token, 2.0) * faces;
    LaneManifold { normal, points, separation, id: [first, first + L::splat(token, 1.0)] }
}

/// The height of an edge along the normal, over the line across it.
struct Profile<L> {
    low: L,
    high: L,
    start: L,
    slope: L,
}

impl<L: Lanes> Profile<L> {
    /// Of an edge whose second end is the one further across. Of one that is too steep, or without length, its end
    /// that is furthest out counts alone; `out` is 1 or -1, along the normal.
    #[inline(always)]
    fn of(
        token: L::Token,
        [start, end]: [[L; 2]; 2],
        normal: [L; 2],
        across: [L; 2],
        out: L,
    ) -> Self {
        let (zero, one) = (L::splat(token, 0.0), L::splat(token, 1.0));
        let edge = sub(end, start);
        let (width, rise) = (dot(across, edge), dot(normal, edge));
        let flat = width.gt(L::splat(token, MIN_SINE) * dot(edge, edge).sqrt());
        let second = L::and((rise * out).gt(zero), L::not(flat));
        let (low, height) = (dot(across, start), dot(normal, start));
        let low = low + L::select(second, width, zero);
        Self {
            low,
            high: low + L::select(flat, width, zero),
            start: height + L::select(second, rise, zero),
            slope: L::select(flat, rise, zero) / L::select(flat, width, one),
        }
    }

    #[inline(always)]
    fn height(&self, at: L) -> L {
        self.start + (at - self.low) * self.slope
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Random, oracle};
    use super::super::{Manifold, collide};
    use super::*;
    use crate::math::{Rot, Transform, sin_cos};

    /// A random convex polygon: corners on an ellipse anywhere, some of them close together.
    fn random_polygon(random: &mut Random) -> Shape {
        let count = 3 + (random.next() * 5.99) as usize;
        let (x, y) = (random.range(0.2, 1.5), random.range(0.2, 1.5));
        let middle = random.vec(2.0);
        let mut corner = |i: usize| {
            let angle = (i as f32 + random.range(0.0, 0.9)) / count as f32;
            let (s, c) = sin_cos(angle * core::f32::consts::TAU);
            middle + Vec2::new(x * c, y * s)
        };
        let corners: Vec<Vec2> = (0..count).map(&mut corner).collect();
        let radius = if random.next() < 0.5 { 0.0 } else { random.range(0.01, 0.5) };
        Polygon::hull(&corners).unwrap().rounded(radius).unwrap().into()
    }

    #[test]
    fn polygons_agree_with_the_oracle() {
        let mut random = Random(4242);
        for _ in 0..20_000 {
            let a = random_polygon(&mut random);
            let b_in_a = Transform::new(random.vec(3.0), random.rot());
            let half = random.range(0.1, 1.0) * Vec2::X;
            let b = match (random.next() * 10.0) as u32 {
                0 => Shape::Circle { radius: 0.2 },
                1 => Shape::Capsule { a: -half, b: half, radius: 0.2 },
                2 => Shape::rect(half.x, 0.3).unwrap(),
                _ => random_polygon(&mut random),
            };
            for (a, b, b_in_a) in [(&a, &b, b_in_a), (&b, &a, b_in_a.inverse())] {
                let manifold = collide(a, b, b_in_a, 100.0);
                let expected = oracle(a, b, b_in_a);
                let found = f64::from(manifold.deepest().unwrap().separation);
                assert!((found - expected).abs() < 3.0e-3, "{found} is not {expected}");
                assert!((manifold.normal.length() - 1.0).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn a_triangle_standing_on_a_box_has_two_points() {
        let corners = [Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0), Vec2::new(0.0, 1.0)];
        let triangle = Polygon::convex(&corners).unwrap().into();
        let frame = Transform::new(Vec2::new(0.25, 1.0), Rot::IDENTITY);
        let floor = Shape::rect(10.0, 1.0).unwrap();
        let manifold = collide(&floor, &triangle, frame, 0.02);
        assert_eq!(manifold.normal, Vec2::Y);
        let mut across: Vec<f32> = manifold.points().iter().map(|point| point.point.x).collect();
        across.sort_by(f32::total_cmp);
        assert_eq!(across, [-0.25, 0.75]);
        assert!(manifold.points().iter().all(|point| (point.point.y - 1.0).abs() < 1e-6));
    }

    #[test]
    fn input_that_is_not_finite_gives_no_points() {
        let shape = Polygon::regular(5, 1.0).unwrap().into();
        for bad in [f32::NAN, f32::INFINITY] {
            let frame = Transform::new(Vec2::new(bad, 0.0), Rot::IDENTITY);
            assert_eq!(collide(&shape, &shape, frame, 1.0), Manifold::EMPTY);
        }
    }
}
