//! Convex polygons.

use super::edges::{box_corners, edge_normal};
use super::hull;
use super::limits::{MAX_EXTENT, check_point, check_size};
use crate::error::Error;
use crate::math::{Rot, Transform, Vec2, sin_cos};

/// Greatest number of vertices of a convex polygon.
pub const MAX_VERTICES: usize = 8;

/// A convex polygon of 3 to 8 vertices, anticlockwise, with an optional corner radius that rounds
/// it outwards.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "super::data::PolygonData", into = "super::data::PolygonData")
)]
pub struct Polygon {
    /// Places beyond the last repeat the first, so that all may be worked on at once. So with the normals.
    vertices: [Vec2; MAX_VERTICES],
    normals: [Vec2; MAX_VERTICES],
    count: u8,
    radius: f32,
}

impl Polygon {
    /// The square with corners at 1 and -1.
    pub(crate) const UNIT_BOX: Self = {
        const A: Vec2 = Vec2::new(-1.0, -1.0);
        const B: Vec2 = Vec2::new(1.0, -1.0);
        const C: Vec2 = Vec2::new(1.0, 1.0);
        const D: Vec2 = Vec2::new(-1.0, 1.0);
        const DOWN: Vec2 = Vec2::new(0.0, -1.0);
        const LEFT: Vec2 = Vec2::new(-1.0, 0.0);
        let normals = [DOWN, Vec2::X, Vec2::Y, LEFT, DOWN, DOWN, DOWN, DOWN];
        Self { vertices: [A, B, C, D, A, A, A, A], normals, count: 4, radius: 0.0 }
    };

    /// A box by its half width and half height, centred.
    ///
    /// # Errors
    /// A half extent that is not finite or out of range.
    pub fn rect(half_width: f32, half_height: f32) -> Result<Self, Error> {
        Self::turned_rect(half_width, half_height, Vec2::ZERO, Rot::IDENTITY)
    }

    /// A box with a centre and rotation of its own. The rotation is brought to unit length.
    ///
    /// # Errors
    /// A half extent that is not finite or out of range, a centre or rotation that is not finite, a box
    /// so far out that its sides vanish in rounding.
    pub fn turned_rect(
        half_width: f32,
        half_height: f32,
        center: Vec2,
        rotation: Rot,
    ) -> Result<Self, Error> {
        check_size("half width", half_width)?;
        check_size("half height", half_height)?;
        check_point("center", center)?;
        Error::check_finite_vec("rotation", rotation.x_axis())?;
        let frame = Transform::new(center, rotation.normalized());
        let corners = box_corners(Vec2::new(half_width, half_height));
        Self::convex(&corners.map(|corner| frame.apply(corner)))
    }

    /// The convex hull of any number of points in any order.
    ///
    /// Points closer together than a tolerance are welded and points on an edge within it are left out:
    /// 0.1 mm, or 4e-6 of the largest coordinate where that is more. The first vertex is the leftmost, the
    /// lowest of several.
    ///
    /// # Errors
    /// A coordinate that is not finite or beyond 1e6; points that are all on one line or in one place;
    /// more than [`MAX_VERTICES`] corners.
    pub fn hull(points: &[Vec2]) -> Result<Self, Error> {
        for point in points {
            check_point("hull point", *point)?;
        }
        let corners = hull::convex_hull(points)?;
        if corners.len() > MAX_VERTICES {
            let reason = "the convex hull has more than 8 corners";
            return Err(Error::BadPoints { reason, index: MAX_VERTICES });
        }
        Self::from_loop(&corners)
    }

    /// A polygon with exactly these vertices in this order, which must be convex and anticlockwise. Where
    /// the points are raw, use [`Polygon::hull`].
    ///
    /// # Errors
    /// A coordinate that is not finite or beyond 1e6; fewer than 3 or more than 8 points; a corner that is
    /// straight, turns inwards or repeats a point.
    pub fn convex(vertices: &[Vec2]) -> Result<Self, Error> {
        for vertex in vertices {
            check_point("vertex", *vertex)?;
        }
        Self::from_loop(vertices)
    }

    /// A regular polygon around the origin with its lowest edge level.
    ///
    /// # Errors
    /// A count outside 3 to 8, a radius (from the centre to the corners) that is not finite or out of range.
    pub fn regular(count: usize, radius: f32) -> Result<Self, Error> {
        check_size("radius", radius)?;
        let is_right = (3..=MAX_VERTICES).contains(&count);
        Error::check("vertex count", count as f64, is_right, "3 to 8")?;
        let mut vertices = [Vec2::ZERO; MAX_VERTICES];
        let step = core::f32::consts::TAU / count as f32;
        for (i, vertex) in vertices[..count].iter_mut().enumerate() {
            let (s, c) = sin_cos((i as f32 - 0.5) * step - core::f32::consts::FRAC_PI_2);
            *vertex = Vec2::new(c, s) * radius;
        }
        Self::from_loop(&vertices[..count])
    }

    /// The same polygon grown by a corner radius: all points within it of the polygon. 0 takes it away.
    ///
    /// # Errors
    /// A radius that is not finite, below 0 or above [`MAX_EXTENT`].
    pub fn rounded(mut self, radius: f32) -> Result<Self, Error> {
        Error::check("corner radius", radius, (0.0..=MAX_EXTENT).contains(&radius), "0 to 1e6")?;
        self.radius = radius;
        Ok(self)
    }

    /// The polygon seen from the parent frame.
    ///
    /// # Errors
    /// A frame that is not finite or moves a vertex beyond 1e6.
    pub fn transformed(&self, frame: Transform) -> Result<Self, Error> {
        let mut vertices = self.vertices;
        for vertex in &mut vertices[..usize::from(self.count)] {
            *vertex = frame.apply(*vertex);
        }
        Self::convex(&vertices[..usize::from(self.count)])?.rounded(self.radius)
    }

    /// Vertices and normals with places for all; those beyond the last repeat the first.
    #[inline]
    pub(crate) fn padded(&self) -> (&[Vec2; MAX_VERTICES], &[Vec2; MAX_VERTICES]) {
        (&self.vertices, &self.normals)
    }

    /// The vertices, anticlockwise, metres in the shape's frame.
    #[inline]
    pub fn vertices(&self) -> &[Vec2] {
        &self.vertices[..usize::from(self.count)]
    }

    /// Outward unit normals; normal `i` belongs to the edge from vertex `i` to the next.
    #[inline]
    pub fn normals(&self) -> &[Vec2] {
        &self.normals[..usize::from(self.count)]
    }

    /// Corner radius, metres.
    #[inline]
    pub fn radius(&self) -> f32 {
        self.radius
    }

    /// Is it a rectangle? Then its half width and half height without the corner radius, and the frame of
    /// the box in the shape's frame: origin in the middle, x axis along the outward normal of edge 1.
    ///
    /// Opposite corners may be off by 1e-5 of the diagonal. Exact for [`Polygon::rect`].
    pub fn as_rect(&self) -> Option<(Vec2, Transform)> {
        if self.count != 4 {
            return None;
        }
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| self.vertices[i]);
        let (diagonal, other) = (c - a, d - b);
        let tolerance = 1.0e-5 * diagonal.length();
        // A quadrangle is a rectangle where its diagonals halve each other and are of one length.
        let center_gap = (a + c - b - d).length();
        let length_gap = (diagonal.length() - other.length()).abs();
        if center_gap > tolerance || length_gap > tolerance {
            return None;
        }
        let half_extents = Vec2::new((b - a).length(), (c - b).length()) * 0.5;
        let axis = self.normals[1];
        let center = ((a + c) + (b + d)) * 0.25;
        Some((half_extents, Transform::new(center, Rot { c: axis.x, s: axis.y })))
    }

    /// Builds the polygon from finite vertices and checks that it is convex.
    fn from_loop(points: &[Vec2]) -> Result<Self, Error> {
        check_loop(points)?;
        let count = points.len();
        let at = |i: usize| if i < count { i } else { 0 };
        let normal = |i: usize| edge_normal(points[i], points[at(i + 1)]);
        let polygon = Self {
            vertices: core::array::from_fn(|i| points[at(i)]),
            normals: core::array::from_fn(|i| normal(at(i))),
            count: count as u8,
            radius: 0.0,
        };
        Ok(polygon)
    }
}

/// `Ok` where the loop turns left at every corner and goes round once.
fn check_loop(points: &[Vec2]) -> Result<(), Error> {
    let count = points.len();
    if !(3..=MAX_VERTICES).contains(&count) {
        return Err(Error::BadPoints { reason: "a polygon has 3 to 8 vertices", index: count });
    }
    for i in 0..count {
        let (start, end) = (points[i], points[(i + 1) % count]);
        if start == end {
            return Err(Error::BadPoints { reason: "a vertex is repeated", index: i });
        }
        // Every other vertex lies on the left: this also turns away loops that go round twice.
        for k in 2..count {
            if hull::turn(start, end, points[(i + k) % count]) <= 0.0 {
                let reason = "vertices are not convex and anticlockwise";
                return Err(Error::BadPoints { reason, index: (i + k) % count });
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_are_known_as_such() {
        let rect = Polygon::rect(0.3, 0.7).unwrap();
        assert_eq!(rect.as_rect(), Some((Vec2::new(0.3, 0.7), Transform::IDENTITY)));
        assert_eq!(rect.normals(), [-Vec2::Y, Vec2::X, Vec2::Y, -Vec2::X]);
        let frame = Transform::from_angle(Vec2::new(3.0, -1.0), 2.1);
        let turned = Polygon::turned_rect(0.3, 0.7, frame.p, frame.q).unwrap();
        let (half, found) = turned.as_rect().unwrap();
        assert!((half - Vec2::new(0.3, 0.7)).length() < 1e-6);
        assert!((found.p - frame.p).length() < 1e-6);
        assert!(found.q.angle_from(frame.q).abs() < 1e-6);
        let hull = Polygon::hull(rect.vertices()).unwrap();
        assert_eq!(hull, rect);
    }

    #[test]
    fn other_quadrangles_are_no_rectangles() {
        let points = |list: [(f32, f32); 4]| list.map(Vec2::from);
        let rhombus = points([(-1.0, 0.0), (0.0, -0.5), (1.0, 0.0), (0.0, 0.5)]);
        let kite = points([(-1.0, 0.0), (0.0, -1.0), (1.0, 0.0), (0.0, 1.1)]);
        let trapezoid = points([(-1.0, -1.0), (1.0, -1.0), (0.5, 1.0), (-0.5, 1.0)]);
        for shape in [rhombus, kite, trapezoid] {
            assert_eq!(Polygon::hull(&shape).unwrap().as_rect(), None);
        }
        assert_eq!(Polygon::regular(5, 1.0).unwrap().as_rect(), None);
        assert!(Polygon::regular(4, 1.0).unwrap().as_rect().is_some());
    }

    #[test]
    fn convex_keeps_the_order_and_turns_away_the_rest() {
        let loop_ = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(Vec2::from);
        assert_eq!(Polygon::convex(&loop_).unwrap().vertices(), loop_);
        let mut clockwise = loop_;
        clockwise.reverse();
        assert!(Polygon::convex(&clockwise).is_err());
        assert!(Polygon::convex(&loop_[..2]).is_err());
        let twice: Vec<_> = (0..5)
            .map(|i| {
                let (s, c) = sin_cos(i as f32 * 2.0 * core::f32::consts::TAU / 5.0);
                Vec2::new(c, s)
            })
            .collect();
        assert!(Polygon::convex(&twice).is_err());
        assert!(Polygon::convex(&[Vec2::ZERO, Vec2::X, Vec2::X * 2.0]).is_err());
        assert!(Polygon::convex(&[Vec2::ZERO, Vec2::X, Vec2::new(f32::NAN, 0.0)]).is_err());
    }

    #[test]
    fn regular_polygons_stand_level() {
        for count in 3..=8 {
            let polygon = Polygon::regular(count, 2.0).unwrap();
            assert_eq!(polygon.vertices().len(), count);
            assert!((polygon.normals()[0] + Vec2::Y).length() < 1e-6);
            assert!(polygon.centroid().length() < 1e-6);
            assert!(polygon.vertices().iter().all(|v| (v.length() - 2.0).abs() < 1e-6));
        }
        for count in [0, 1, 2, 9] {
            assert!(Polygon::regular(count, 1.0).is_err());
        }
    }

    #[test]
    fn rounding_and_moving() {
        let polygon = Polygon::rect(1.0, 1.0).unwrap();
        assert_eq!(polygon.rounded(0.25).unwrap().radius(), 0.25);
        assert!(polygon.rounded(-0.1).is_err());
        assert!(polygon.rounded(f32::NAN).is_err());
        let frame = Transform::from_angle(Vec2::new(1.0, 2.0), 0.5);
        let moved = polygon.rounded(0.25).unwrap().transformed(frame).unwrap();
        assert!((moved.centroid() - frame.p).length() < 1e-6);
        assert_eq!(moved.radius(), 0.25);
        assert!(polygon.transformed(Transform::new(Vec2::splat(1e9), Rot::IDENTITY)).is_err());
        assert!(Polygon::turned_rect(1e-4, 1e-4, Vec2::splat(9e5), Rot::IDENTITY).is_err());
    }
}
