//! Manifolds with a general polygon: the method of the box kernel over lists of vertices.
//!
//! Scalar, with branches. A shape that is no general polygon takes part as its rounded box, so a
//! segment has end faces of no width and a circle's centre has four faces of no width; with these,
//! the best axis is always within 45 degrees of the direction between two nearest corners.

use super::{Manifold, ManifoldPoint, RoundedBox};
use crate::geometry::{MAX_VERTICES, Shape, least_by};
use crate::math::{Transform, Vec2};

/// An axis of B replaces one of A, and a later one an earlier, only if it separates by this fraction of
/// the smaller shape more.
const AXIS_BIAS: f32 = 5.0e-4;

/// Below this fraction of both shapes' size, the direction between two corners is rounding noise.
const NOISE: f32 = 4.0e-5;

/// Two points nearer to each other than this fraction of both shapes' size are one.
const MIN_WIDTH: f32 = 4.0e-6;

/// An edge this steep against the normal (sine of the angle between them) counts as its lowest end alone.
const MIN_SINE: f32 = 0.1;

const MAX_POINTS: usize = MAX_VERTICES;

/// The convex hull of up to eight points, widened by a radius.
#[derive(Clone, Copy)]
struct Outline {
    points: Row,
    /// Normal `i` belongs to the edge from point `i` to the next, which may have no length.
    normals: Row,
    count: usize,
    radius: f32,
    /// About half its width plus half its height.
    size: f32,
}

/// Vectors side by side, so that one instruction works on several.
#[derive(Clone, Copy)]
struct Row {
    x: [f32; MAX_POINTS],
    y: [f32; MAX_POINTS],
}

impl Row {
    fn new(vectors: &[Vec2; MAX_POINTS], map: impl Fn(Vec2) -> Vec2) -> Self {
        let mut row = Self { x: [0.0; MAX_POINTS], y: [0.0; MAX_POINTS] };
        for (i, &vector) in vectors.iter().enumerate() {
            Vec2 { x: row.x[i], y: row.y[i] } = map(vector);
        }
        row
    }

    fn at(&self, i: usize) -> Vec2 {
        Vec2::new(self.x[i], self.y[i])
    }
}

/// Collides any two shapes by the general method; meant for those with a general polygon.
pub(crate) fn collide_general(
    a: &Shape,
    b: &Shape,
    b_in_a: Transform,
    max_separation: f32,
) -> Manifold {
    collide_outlines(&Outline::of(a, Transform::IDENTITY), &Outline::of(b, b_in_a), max_separation)
}

fn collide_outlines(a: &Outline, b: &Outline, max_separation: f32) -> Manifold {
    let bias = AXIS_BIAS * if a.size < b.size { a.size } else { b.size };
    let noise = NOISE * (a.size + b.size);

    // No point is nearer than the shapes are along any axis.
    let too_far = max_separation + (a.radius + b.radius);
    let (face_a, separation_a) = a.best_face(b, bias);
    if separation_a > too_far {
        return Manifold::EMPTY;
    }
    let (face_b, separation_b) = b.best_face(a, bias);
    if separation_b > too_far {
        return Manifold::EMPTY;
    }
    let flipped = separation_b > separation_a + bias;
    let (reference, other, face) = if flipped { (b, a, face_b) } else { (a, b, face_a) };

    let other_face = other.facing(reference.normals.at(face));
    let normal = reference.nearest_direction(face, other, other_face, noise);
    let (normal, face_a, face_b) =
        if flipped { (-normal, other_face, face) } else { (normal, face, other_face) };
    overlap(
        a,
        face_a,
        b,
        face_b,
        normal,
        Limits { max_separation, width: MIN_WIDTH * (a.size + b.size) },
    )
}

impl Outline {
    fn of(shape: &Shape, frame: Transform) -> Self {
        match shape {
            Shape::Polygon(polygon) => {
                let (points, normals) = polygon.padded();
                Self::new(points, normals, polygon.vertices().len(), polygon.radius(), frame)
            }
            Shape::Circle { .. }
            | Shape::Aabb { .. }
            | Shape::Capsule { .. }
            | Shape::Segment { .. } => {
                Self::of_box(&RoundedBox::of(shape).unwrap_or_default(), frame)
            }
        }
    }

    fn of_box(rounded: &RoundedBox, frame: Transform) -> Self {
        let Vec2 { x, y } = rounded.half_extents;
        let corners = [Vec2::new(x, -y), Vec2::new(x, y), Vec2::new(-x, y), Vec2::new(-x, -y)];
        let normals = [Vec2::X, Vec2::Y, -Vec2::X, -Vec2::Y];
        let frame = frame.compose(rounded.frame);
        Self::new(&pad(&corners), &pad(&normals), corners.len(), rounded.radius, frame)
    }

    /// Points and normals beyond the first `count` repeat the first.
    #[inline]
    fn new(
        points: &[Vec2; MAX_POINTS],
        normals: &[Vec2; MAX_POINTS],
        count: usize,
        radius: f32,
        frame: Transform,
    ) -> Self {
        let (mut low, mut high) = (points[0], points[0]);
        for &point in points {
            (low, high) = (low.min(point), high.max(point));
        }
        Self {
            points: Row::new(points, |point| frame.apply(point)),
            normals: Row::new(normals, |normal| frame.q.rotate(normal)),
            count,
            radius,
            size: radius + 0.5 * ((high.x - low.x) + (high.y - low.y)),
        }
    }

    /// The face that separates this outline from `other` most, and by how much.
    fn best_face(&self, other: &Self, bias: f32) -> (usize, f32) {
        let separations = self.separations(other);
        let mut best = (0, f32::NEG_INFINITY);
        for (face, &separation) in separations[..self.count].iter().enumerate() {
            if separation > best.1 + bias {
                best = (face, separation);
            }
        }
        best
    }

    /// How far each face separates this outline from `other`: a loop over all faces at once.
    #[inline]
    fn separations(&self, other: &Self) -> [f32; MAX_POINTS] {
        let Row { x, y } = &self.normals;
        let mut lowest = [f32::INFINITY; MAX_POINTS];
        for point in (0..other.count).map(|i| other.points.at(i)) {
            for (face, lowest) in lowest.iter_mut().enumerate() {
                let height = x[face] * point.x + y[face] * point.y;
                *lowest = if height < *lowest { height } else { *lowest };
            }
        }
        for (face, lowest) in lowest.iter_mut().enumerate() {
            *lowest -= x[face] * self.points.x[face] + y[face] * self.points.y[face];
        }
        lowest
    }

    /// The face most opposed to a direction; the first of equal ones.
    fn facing(&self, direction: Vec2) -> usize {
        least_by(self.count, |face| direction.dot(self.normals.at(face))).0
    }

    /// Both ends of a face, anticlockwise.
    fn edge(&self, face: usize) -> [Vec2; 2] {
        let next = if face + 1 < self.count { face + 1 } else { 0 };
        [self.points.at(face), self.points.at(next)]
    }

    /// The normal of `face`, unless the cores are apart and the lowest end of the other's edge lies
    /// beside it; then the direction from the face's end to the nearest point of that edge.
    fn nearest_direction(&self, face: usize, other: &Self, other_face: usize, noise: f32) -> Vec2 {
        let normal = self.normals.at(face);
        let tangent = normal.perp();
        let [start, end] = self.edge(face);
        let edge = other.edge(other_face);
        let lowest = if normal.dot(edge[1]) < normal.dot(edge[0]) { edge[1] } else { edge[0] };
        let corner = if tangent.dot(lowest - end) > 0.0 {
            end
        } else if tangent.dot(lowest - start) < 0.0 {
            start
        } else {
            return normal;
        };
        let line = nearest_on_segment(edge, corner) - corner;
        let (direction, length) = line.direction_and_length();
        let usable = normal.dot(line) > 0.0 && length > noise && length < f32::INFINITY;
        if usable { direction } else { normal }
    }
}

/// Fills up with the first.
fn pad(vectors: &[Vec2]) -> [Vec2; MAX_POINTS] {
    core::array::from_fn(|i| if i < vectors.len() { vectors[i] } else { vectors[0] })
}

fn nearest_on_segment([a, b]: [Vec2; 2], point: Vec2) -> Vec2 {
    let edge = b - a;
    let (along, length_sq) = (edge.dot(point - a), edge.length_sq());
    if along >= length_sq && length_sq > 0.0 {
        b
    } else if along > 0.0 {
        a + edge * (along / length_sq)
    } else {
        a
    }
}

struct Limits {
    max_separation: f32,
    /// Narrower than this is one point.
    width: f32,
}

/// Both edges seen along the normal: the ends of the overlap of their shadows are the points.
fn overlap(
    a: &Outline,
    face_a: usize,
    b: &Outline,
    face_b: usize,
    normal: Vec2,
    limits: Limits,
) -> Manifold {
    let across = normal.perp();
    // Anticlockwise along A's face is up across the normal; along B's it is down.
    let lower = Profile::of(a.edge(face_a), normal, across);
    let [end, start] = b.edge(face_b);
    let upper = Profile::of([-end, -start], normal, across).mirrored();

    let mut low = if lower.low > upper.low { lower.low } else { upper.low };
    let mut high = if lower.high < upper.high { lower.high } else { upper.high };
    if high < low {
        low = 0.5 * (low + high);
        high = low;
    }
    let ends = if high - low > limits.width { [Some(low), Some(high)] } else { [Some(low), None] };
    let mut manifold = Manifold::EMPTY;
    for (i, at) in ends.into_iter().enumerate() {
        let Some(at) = at else { continue };
        let (below, above) = (lower.height(at), upper.height(at));
        let separation = (above - below) - (a.radius + b.radius);
        if separation <= limits.max_separation {
            let height = 0.5 * ((above + below) + (a.radius - b.radius));
            let id = (face_a * 2 * MAX_POINTS + face_b * 2 + i) as u16;
            manifold.normal = normal;
            manifold.push(ManifoldPoint { point: normal * height + across * at, separation, id });
        }
    }
    manifold
}

/// The height of an edge along the normal, over the line across it.
struct Profile {
    low: f32,
    high: f32,
    start: f32,
    slope: f32,
}

impl Profile {
    /// Of an edge whose second end is the one further across.
    fn of([start, end]: [Vec2; 2], normal: Vec2, across: Vec2) -> Self {
        let edge = end - start;
        let (width, rise) = (across.dot(edge), normal.dot(edge));
        let (low, height) = (across.dot(start), normal.dot(start));
        if width > MIN_SINE * edge.length() {
            return Self { low, high: low + width, start: height, slope: rise / width };
        }
        // Too steep, or without length: its highest end alone.
        let (low, height) = if rise > 0.0 { (low + width, height + rise) } else { (low, height) };
        Self { low, high: low, start: height, slope: 0.0 }
    }

    /// The profile of the edge turned about the origin by half a turn.
    fn mirrored(self) -> Self {
        let start = -(self.start + (self.high - self.low) * self.slope);
        Self { low: -self.high, high: -self.low, start, slope: self.slope }
    }

    fn height(&self, at: f32) -> f32 {
        self.start + (at - self.low) * self.slope
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Random, oracle_of_points};
    use super::*;
    use crate::math::{Rot, sin_cos};

    /// Corners of a random convex polygon: points on an ellipse, some of them close together.
    fn random_outline(random: &mut Random, frame: Transform) -> Outline {
        let count = 3 + (random.next() * 5.99) as usize;
        let (x, y) = (random.range(0.2, 1.5), random.range(0.2, 1.5));
        let mut angles: Vec<f32> = (0..count)
            .map(|i| (i as f32 + random.range(0.0, 0.9)) * core::f32::consts::TAU / count as f32)
            .collect();
        angles.dedup();
        let points: Vec<Vec2> = angles
            .iter()
            .map(|&angle| {
                let (s, c) = sin_cos(angle);
                Vec2::new(x * c, y * s)
            })
            .collect();
        let normals: Vec<Vec2> = (0..count)
            .map(|i| -(points[(i + 1) % count] - points[i]).perp().normalized())
            .collect();
        let radius = if random.next() < 0.5 { 0.0 } else { random.range(0.01, 0.5) };
        Outline::new(&pad(&points), &pad(&normals), points.len(), radius, frame)
    }

    fn oracle(a: &Outline, b: &Outline) -> f64 {
        let points = |outline: &Outline| {
            let points = (0..outline.count).map(|i| outline.points.at(i));
            points.map(|p| [p.x.into(), p.y.into()]).collect::<Vec<_>>()
        };
        oracle_of_points(&points(a), &points(b)) - f64::from(a.radius) - f64::from(b.radius)
    }

    #[test]
    fn polygons_agree_with_the_oracle() {
        let mut random = Random(4242);
        for _ in 0..20_000 {
            let a = random_outline(&mut random, Transform::IDENTITY);
            let frame = Transform::new(random.vec(3.0), random.rot());
            let b = if random.next() < 0.7 {
                random_outline(&mut random, frame)
            } else {
                let half = random.range(0.0, 1.0);
                let half_extents = Vec2::new(if half < 0.3 { 0.0 } else { half }, 0.0);
                let rounded = RoundedBox { half_extents, radius: 0.2, ..RoundedBox::default() };
                Outline::of_box(&rounded, frame)
            };
            for (a, b) in [(&a, &b), (&b, &a)] {
                let manifold = collide_outlines(a, b, 100.0);
                let expected = oracle(a, b);
                let found = f64::from(manifold.deepest().unwrap().separation);
                assert!((found - expected).abs() < 3.0e-3, "{found} is not {expected}");
                assert!((manifold.normal.length() - 1.0).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn a_triangle_standing_on_a_box_has_two_points() {
        let corners = [Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0), Vec2::new(0.0, 1.0)];
        let side = Vec2::new(2.0, 1.0).normalized();
        let normals = [-Vec2::Y, side, Vec2::new(-side.x, side.y)];
        let frame = Transform::new(Vec2::new(0.25, 1.0), Rot::IDENTITY);
        let triangle = Outline::new(&pad(&corners), &pad(&normals), 3, 0.0, frame);
        let half_extents = Vec2::new(10.0, 1.0);
        let floor = RoundedBox { half_extents, ..RoundedBox::default() };
        let floor = Outline::of_box(&floor, Transform::IDENTITY);
        let manifold = collide_outlines(&floor, &triangle, 0.02);
        assert_eq!(manifold.normal, Vec2::Y);
        let points: Vec<Vec2> = manifold.points().iter().map(|point| point.point).collect();
        assert_eq!(points, [Vec2::new(0.75, 1.0), Vec2::new(-0.25, 1.0)]);
    }

    #[test]
    fn input_that_is_not_finite_gives_no_points() {
        let shape = Shape::Circle { radius: 1.0 };
        for bad in [f32::NAN, f32::INFINITY] {
            let frame = Transform::new(Vec2::new(bad, 0.0), Rot::IDENTITY);
            assert_eq!(collide_general(&shape, &shape, frame, 1.0), Manifold::EMPTY);
        }
    }
}
