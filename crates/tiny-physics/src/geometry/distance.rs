//! Distance of two shapes.
//!
//! The algorithm of Gilbert, Johnson and Keerthi (1988) in the form of van den Bergen ("Collision Detection
//! in Interactive 3D Environments", 2003) and Ericson (2005, section 9.5): the closest point of the
//! difference of the two cores to the origin, by a simplex of up to three support points. Cores that
//! overlap are told apart by the separating axes of their edges, so there is always a normal and a signed
//! separation.

use super::{Core, Shape};
use crate::math::{Transform, Vec2};

/// Limit of the search. Three million random pairs of all shapes (3 to 8 vertices) needed 6 rounds at most.
const MAX_ITERATIONS: u32 = 24;
/// Relative rounding of a difference of core points.
const ROUNDING: f32 = 4.0e-7;

/// How far two shapes are apart, and where. Everything in the frame of shape A, metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Distance {
    /// Gap between the surfaces; 0 where they touch or overlap.
    pub distance: f32,
    /// The same with sign: negative is the depth of the overlap, the shortest way out.
    pub separation: f32,
    /// Unit vector from A to B along which they are closest.
    pub normal: Vec2,
    /// Closest point on the surface of A (the deepest inside B where they overlap).
    pub point_a: Vec2,
    /// Closest point on the surface of B (the deepest inside A where they overlap).
    pub point_b: Vec2,
    /// Do the cores themselves overlap, not just the radii around them?
    pub deep: bool,
    /// Did the search end by itself? `false`: by its limit, and the figures are an upper bound.
    pub converged: bool,
}

/// Distance of two shapes; `b_in_a` is the frame of B seen in the frame of A.
///
/// ```
/// use tiny_physics::{Rot, Shape, Transform, Vec2, geometry::distance};
/// let ball = Shape::circle(1.0)?;
/// let wall = Shape::rect(0.5, 4.0)?;
/// let gap = distance(&ball, &wall, Transform::new(Vec2::new(3.5, 1.0), Rot::IDENTITY));
/// assert_eq!((gap.distance, gap.normal), (2.0, Vec2::X));
/// # Ok::<(), tiny_physics::Error>(())
/// ```
pub fn distance(a: &Shape, b: &Shape, b_in_a: Transform) -> Distance {
    core_distance(&a.core(), &b.core().transformed(b_in_a))
}

/// Distance of two cores in one frame.
pub(crate) fn core_distance(a: &Core, b: &Core) -> Distance {
    distance_from(a, b, &mut Closest::default())
}

/// The points of two cores, one or two of each, that were closest when they were looked at last.
#[derive(Default)]
pub(crate) struct Closest {
    pairs: [(usize, usize); 2],
    is_edge: bool,
}

/// The same, beginning with what was closest a moment ago.
pub(crate) fn distance_from(a: &Core, b: &Core, closest: &mut Closest) -> Distance {
    let mut simplex = Simplex::new(a, b, closest);
    let mut converged = false;
    for _ in 0..MAX_ITERATIONS {
        let nearest = simplex.reduce();
        let Nearest::Apart { direction, length } = nearest else {
            return overlap(a, b);
        };
        if length <= simplex.slack {
            return overlap(a, b);
        }
        let next = simplex.support(a, b, -direction);
        let gain = length - next.gap.dot(direction);
        if gain <= simplex.slack || simplex.holds(next) {
            converged = true;
            break;
        }
        simplex.push(next);
    }
    let [p, q, _] = simplex.vertices;
    *closest = Closest { pairs: [(p.a, p.b), (q.a, q.b)], is_edge: simplex.count == 2 };
    simplex.finish(a, b, converged)
}

/// A point of the difference B - A.
#[derive(Clone, Copy)]
struct Vertex {
    a: usize,
    b: usize,
    /// From the point of A to the point of B.
    gap: Vec2,
}

enum Nearest {
    /// Unit direction from A to B and the distance.
    Apart {
        direction: Vec2,
        length: f32,
    },
    Overlap,
}

/// Up to three points of the difference; after `reduce` one or two, the feature closest to the origin.
struct Simplex {
    vertices: [Vertex; 3],
    count: usize,
    /// Place of the closest point between the first two vertices, 0 to 1.
    fraction: f32,
    /// What rounding makes of a zero distance here.
    slack: f32,
    direction: Vec2,
    length: f32,
}

impl Simplex {
    fn new(a: &Core, b: &Core, closest: &Closest) -> Self {
        let vertex = |(i, j): (usize, usize)| Vertex { a: i, b: j, gap: b.points[j] - a.points[i] };
        let [first, second] = closest.pairs.map(vertex);
        let mut simplex = Self {
            vertices: [first; 3],
            count: 1,
            fraction: 0.0,
            slack: ROUNDING * first.gap.length(),
            direction: Vec2::ZERO,
            length: 0.0,
        };
        if closest.is_edge {
            simplex.push(second);
        }
        simplex
    }

    fn support(&self, a: &Core, b: &Core, direction: Vec2) -> Vertex {
        let (i, j) = (a.support(-direction), b.support(direction));
        Vertex { a: i, b: j, gap: b.points[j] - a.points[i] }
    }

    fn holds(&self, vertex: Vertex) -> bool {
        self.vertices[..self.count].iter().any(|v| v.a == vertex.a && v.b == vertex.b)
    }

    fn push(&mut self, vertex: Vertex) {
        self.vertices[self.count] = vertex;
        self.count += 1;
        let slack = ROUNDING * vertex.gap.length();
        if slack > self.slack {
            self.slack = slack;
        }
    }

    /// Keeps the feature closest to the origin.
    fn reduce(&mut self) -> Nearest {
        let [p, q, newest] = self.vertices;
        match self.count {
            1 => self.keep_point(p),
            2 => self.keep_edge(p, q),
            _ if self.origin_inside() => return Nearest::Overlap,
            // The newest point has brought the simplex closer, so it is part of the closest feature.
            _ if edge_distance_sq(p, newest) <= edge_distance_sq(q, newest) => {
                self.keep_edge(p, newest);
            }
            _ => self.keep_edge(q, newest),
        }
        Nearest::Apart { direction: self.direction, length: self.length }
    }

    fn keep_point(&mut self, p: Vertex) {
        (self.vertices[0], self.count, self.fraction) = (p, 1, 0.0);
        (self.direction, self.length) = p.gap.direction_and_length();
    }

    fn keep_edge(&mut self, p: Vertex, q: Vertex) {
        let fraction = super::point::segment_fraction(p.gap, q.gap, Vec2::ZERO);
        if fraction <= 0.0 {
            return self.keep_point(p);
        }
        if fraction >= 1.0 {
            return self.keep_point(q);
        }
        (self.vertices[0], self.vertices[1], self.count) = (p, q, 2);
        self.fraction = fraction;
        // The normal of the edge is precise however close the origin is.
        let normal = super::edges::edge_normal(p.gap, q.gap);
        let height = normal.dot(p.gap);
        (self.direction, self.length) =
            if height < 0.0 { (-normal, -height) } else { (normal, height) };
    }

    /// Is the origin inside the triangle or within rounding of it?
    fn origin_inside(&self) -> bool {
        let [p, q, r] = self.vertices.map(|v| v.gap);
        let sign = if (q - p).cross(r - p) < 0.0 { -1.0 } else { 1.0 };
        let tolerance = |edge: Vec2| -self.slack * edge.length();
        sign * p.cross(q) >= tolerance(q - p)
            && sign * q.cross(r) >= tolerance(r - q)
            && sign * r.cross(p) >= tolerance(p - r)
    }

    fn finish(&self, a: &Core, b: &Core, converged: bool) -> Distance {
        let [p, q, _] = self.vertices;
        let point = if self.count == 2 {
            a.points[p.a].lerp(a.points[q.a], self.fraction)
        } else {
            a.points[p.a]
        };
        let gap = CoreGap { point, normal: self.direction, length: self.length };
        Distance { converged, ..gap.with_radii(a, b) }
    }
}

fn edge_distance_sq(p: Vertex, q: Vertex) -> f32 {
    let fraction = super::point::segment_fraction(p.gap, q.gap, Vec2::ZERO);
    p.gap.lerp(q.gap, fraction).length_sq()
}

/// The closest place of two cores: a point on A's core and the signed way from there to B's.
struct CoreGap {
    point: Vec2,
    normal: Vec2,
    length: f32,
}

impl CoreGap {
    fn with_radii(&self, a: &Core, b: &Core) -> Distance {
        let separation = self.length - a.radius - b.radius;
        Distance {
            distance: if separation > 0.0 { separation } else { 0.0 },
            separation,
            normal: self.normal,
            point_a: self.point + self.normal * a.radius,
            point_b: self.point + self.normal * (self.length - b.radius),
            deep: self.length <= 0.0,
            converged: true,
        }
    }
}

/// Cores that touch or overlap: the edge normal with the shortest way out. The difference of two convex
/// polygons has no other normals than theirs, so this is exact. Equal depths take the first edge, A's
/// before B's; two points in one place take the y axis.
fn overlap(a: &Core, b: &Core) -> Distance {
    let mut best: Option<CoreGap> = None;
    for i in 0..a.edge_count() {
        let normal = a.normal(i);
        let deepest = b.points[b.support(-normal)];
        let length = normal.dot(deepest - a.points[i]);
        if best.as_ref().is_none_or(|best| length > best.length) {
            best = Some(CoreGap { point: deepest - normal * length, normal, length });
        }
    }
    for i in 0..b.edge_count() {
        let normal = -b.normal(i);
        let deepest = a.points[a.support(normal)];
        let length = normal.dot(b.points[i] - deepest);
        if best.as_ref().is_none_or(|best| length > best.length) {
            best = Some(CoreGap { point: deepest, normal, length });
        }
    }
    let point = a.points[0];
    best.unwrap_or(CoreGap { point, normal: Vec2::Y, length: 0.0 }).with_radii(a, b)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{any_frame, any_shape};
    use super::*;
    use crate::math::Rot;
    use proptest::prelude::*;

    fn at(x: f32, y: f32) -> Transform {
        Transform::new(Vec2::new(x, y), Rot::IDENTITY)
    }

    #[test]
    fn known_distances() {
        let rect = Shape::rect(1.0, 1.0).unwrap();
        let circle = Shape::circle(0.5).unwrap();
        let gap = distance(&rect, &circle, at(3.0, 0.5));
        assert_eq!((gap.distance, gap.normal), (1.5, Vec2::X));
        assert_eq!((gap.point_a, gap.point_b), (Vec2::new(1.0, 0.5), Vec2::new(2.5, 0.5)));
        let corner = distance(&rect, &rect, at(5.0, 6.0));
        assert!((corner.distance - 5.0).abs() < 1e-6);
        assert!((corner.normal - Vec2::new(0.6, 0.8)).length() < 1e-6);
        let capsule = Shape::capsule(-Vec2::X, Vec2::X, 0.25).unwrap();
        let parallel = distance(&capsule, &capsule, at(0.5, 2.0));
        assert_eq!((parallel.distance, parallel.normal), (1.5, Vec2::Y));
    }

    #[test]
    fn overlaps_have_depth_and_normal() {
        let rect = Shape::rect(1.0, 1.0).unwrap();
        let deep = distance(&rect, &rect, at(1.5, 0.2));
        assert!(deep.deep && deep.distance == 0.0);
        assert!((deep.separation + 0.5).abs() < 1e-6);
        assert_eq!(deep.normal, Vec2::X);
        let circle = Shape::circle(0.5).unwrap();
        let shallow = distance(&rect, &circle, at(0.0, -1.25));
        assert!(!shallow.deep);
        assert!((shallow.separation + 0.25).abs() < 1e-6);
        assert_eq!(shallow.normal, -Vec2::Y);
        let same = distance(&circle, &circle, at(0.0, 0.0));
        assert_eq!((same.normal, same.separation), (Vec2::Y, -1.0));
        let cross = Shape::segment(-Vec2::X, Vec2::X).unwrap();
        let quarter = Transform::new(Vec2::ZERO, Rot { c: 0.0, s: 1.0 });
        assert_eq!(distance(&cross, &cross, quarter).separation, -1.0);
        assert_eq!(distance(&cross, &cross, at(0.5, 0.0)).separation, 0.0);
    }

    #[test]
    fn touching_shapes_have_the_right_normal() {
        let rect = Shape::rect(1.0, 1.0).unwrap();
        for k in -20..=20 {
            let gap = k as f32 * 1e-7;
            let found = distance(&rect, &rect, at(0.3, 2.0 + gap));
            assert_eq!(found.normal, Vec2::Y, "{gap}");
            assert!((found.separation - gap).abs() < 1e-6);
        }
    }

    /// Every vertex of one against every edge of the other; 0 where the edges' axes do not separate them.
    fn brute_force(a: &Core, b: &Core) -> f32 {
        if overlap(a, b).separation + a.radius + b.radius <= 0.0 && a.count + b.count > 2 {
            return 0.0;
        }
        let one_way = |a: &Core, b: &Core| {
            let gaps = a.points().iter().map(|p| p.distance(b.closest_point(*p)));
            gaps.fold(f32::INFINITY, f32::min)
        };
        let (there, back) = (one_way(a, b), one_way(b, a));
        if there < back { there } else { back }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn distance_agrees_with_brute_force(
            a in any_shape(),
            b in any_shape(),
            frame in any_frame(3.0),
        ) {
            let (core_a, core_b) = (a.core(), b.core().transformed(frame));
            let found = distance(&a, &b, frame);
            let expected = brute_force(&core_a, &core_b) - core_a.radius - core_b.radius;
            let expected = if expected > 0.0 { expected } else { 0.0 };
            prop_assert!(found.converged);
            prop_assert!((found.distance - expected).abs() < 2e-6, "{found:?} {expected}");
            prop_assert!((found.normal.length() - 1.0).abs() < 1e-5);
            let gap = found.point_b - found.point_a;
            prop_assert!((gap - found.normal * found.separation).length() < 2e-5, "{found:?}");
            prop_assert!(a.closest_point(found.point_a).distance(found.point_a) < 2e-5);
            let local = frame.unapply(found.point_b);
            prop_assert!(b.closest_point(local).distance(local) < 2e-5);
        }

        #[test]
        fn moving_out_by_the_depth_separates(
            a in any_shape(),
            b in any_shape(),
            frame in any_frame(1.0),
        ) {
            let found = distance(&a, &b, frame);
            if found.separation >= 0.0 {
                return Ok(());
            }
            let out = Transform::new(frame.p - found.normal * found.separation, frame.q);
            let after = distance(&a, &b, out);
            prop_assert!(after.separation.abs() < 1e-5, "{found:?} {after:?}");
        }

        #[test]
        fn swapping_the_shapes_turns_the_normal(
            a in any_shape(),
            b in any_shape(),
            frame in any_frame(3.0),
        ) {
            let there = distance(&a, &b, frame);
            let back = distance(&b, &a, frame.inverse());
            prop_assert!((there.separation - back.separation).abs() < 1e-5);
            if there.separation > 1e-2 {
                let turned = frame.q.rotate(back.normal) + there.normal;
                prop_assert!(turned.length() < 1e-3, "{there:?} {back:?}");
            }
        }
    }
}
