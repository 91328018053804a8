//! The shapes.

use super::Polygon;
use super::limits::{MIN_EXTENT, check_point, check_size};
use crate::error::Error;
use crate::math::Vec2;

/// A shape in its own frame.
///
/// The variants are public so that shapes can be written down as data; what cannot be built is found by
/// [`Shape::validate`], which the world calls. The constructors call it at once.
///
/// ```
/// use tiny_physics::Shape;
/// let wheel = Shape::circle(0.4)?;
/// let plank = Shape::rect(2.0, 0.1)?;
/// assert!(Shape::circle(f32::NAN).is_err());
/// assert!(plank.mass_properties(1.0).mass > wheel.mass_properties(1.0).mass);
/// # Ok::<(), tiny_physics::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "super::data::ShapeData", into = "super::data::ShapeData")
)]
pub enum Shape {
    /// A disk around the origin.
    Circle {
        /// Metres, above 0.
        radius: f32,
    },
    /// A box around the origin that never turns: a body that carries one has its rotation locked.
    Aabb {
        /// Half width and half height, metres, above 0.
        half_extents: Vec2,
    },
    /// All points within `radius` of the segment from `a` to `b`.
    Capsule {
        /// One end of the core, metres.
        a: Vec2,
        /// The other end.
        b: Vec2,
        /// Metres, above 0.
        radius: f32,
    },
    /// A line segment without thickness; for static bodies. It has no mass.
    Segment {
        /// One end, metres.
        a: Vec2,
        /// The other end.
        b: Vec2,
    },
    /// A convex polygon.
    Polygon(Polygon),
}

impl Shape {
    /// A disk around the origin.
    ///
    /// # Errors
    /// A radius that is not finite or outside [`MIN_EXTENT`] to [`MAX_EXTENT`](super::MAX_EXTENT).
    pub fn circle(radius: f32) -> Result<Self, Error> {
        Self::Circle { radius }.validated()
    }

    /// A box around the origin that may turn: a polygon of four vertices.
    ///
    /// # Errors
    /// A half extent that is not finite or outside [`MIN_EXTENT`] to [`MAX_EXTENT`](super::MAX_EXTENT).
    pub fn rect(half_width: f32, half_height: f32) -> Result<Self, Error> {
        Polygon::rect(half_width, half_height).map(Self::Polygon)
    }

    /// A box around the origin that never turns.
    ///
    /// # Errors
    /// A half extent that is not finite or outside [`MIN_EXTENT`] to [`MAX_EXTENT`](super::MAX_EXTENT).
    pub fn aabb_box(half_extents: impl Into<Vec2>) -> Result<Self, Error> {
        Self::Aabb { half_extents: half_extents.into() }.validated()
    }

    /// All points within `radius` of the segment from `a` to `b`.
    ///
    /// # Errors
    /// A number that is not finite or out of range; ends closer than [`MIN_EXTENT`].
    pub fn capsule(a: impl Into<Vec2>, b: impl Into<Vec2>, radius: f32) -> Result<Self, Error> {
        Self::Capsule { a: a.into(), b: b.into(), radius }.validated()
    }

    /// A line segment without thickness.
    ///
    /// # Errors
    /// A number that is not finite or out of range; ends closer than [`MIN_EXTENT`].
    pub fn segment(a: impl Into<Vec2>, b: impl Into<Vec2>) -> Result<Self, Error> {
        Self::Segment { a: a.into(), b: b.into() }.validated()
    }

    /// The convex hull of some points: see [`Polygon::hull`].
    ///
    /// # Errors
    /// Those of [`Polygon::hull`].
    pub fn hull(points: &[Vec2]) -> Result<Self, Error> {
        Polygon::hull(points).map(Self::Polygon)
    }

    /// A regular polygon around the origin: see [`Polygon::regular`].
    ///
    /// # Errors
    /// Those of [`Polygon::regular`].
    pub fn regular(count: usize, radius: f32) -> Result<Self, Error> {
        Polygon::regular(count, radius).map(Self::Polygon)
    }

    /// Can this shape be simulated? Polygons always can: their constructors have checked them.
    ///
    /// # Errors
    /// Names the first number that is not finite or out of range, or a core without length.
    pub fn validate(&self) -> Result<(), Error> {
        match self {
            Self::Circle { radius } => check_size("radius", *radius),
            Self::Aabb { half_extents } => {
                check_size("half width", half_extents.x)?;
                check_size("half height", half_extents.y)
            }
            Self::Capsule { a, b, radius } => {
                check_size("radius", *radius)?;
                check_core("capsule is shorter than 1e-5 m: use a circle", *a, *b)
            }
            Self::Segment { a, b } => check_core("segment is shorter than 1e-5 m", *a, *b),
            Self::Polygon(_) => Ok(()),
        }
    }

    fn validated(self) -> Result<Self, Error> {
        self.validate().map(|()| self)
    }
}

impl From<Polygon> for Shape {
    fn from(polygon: Polygon) -> Self {
        Self::Polygon(polygon)
    }
}

fn check_core(reason: &'static str, a: Vec2, b: Vec2) -> Result<(), Error> {
    check_point("end a", a)?;
    check_point("end b", b)?;
    if a.distance(b) < MIN_EXTENT { Err(Error::BadPoints { reason, index: 1 }) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constructors_take_what_makes_sense() {
        let (a, b) = (Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.5));
        assert!(Shape::circle(0.5).is_ok());
        assert!(Shape::rect(1.0, 2.0).is_ok());
        assert!(Shape::aabb_box(Vec2::new(1.0, 2.0)).is_ok());
        assert!(Shape::capsule(a, b, 0.1).is_ok());
        assert!(Shape::segment(a, b).is_ok());
        assert!(Shape::regular(6, 1.0).is_ok());
        assert!(Shape::hull(&[a, b, Vec2::new(0.0, 3.0)]).is_ok());
    }

    #[test]
    fn bad_numbers_are_named() {
        let p = Vec2::new(1.0, 1.0);
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -1.0, 1e-30, 1e30] {
            assert!(Shape::circle(bad).is_err(), "{bad}");
            assert!(Shape::rect(1.0, bad).is_err(), "{bad}");
            assert!(Shape::aabb_box(Vec2::new(bad, 1.0)).is_err(), "{bad}");
            assert!(Shape::capsule(Vec2::ZERO, p, bad).is_err(), "{bad}");
            assert!(Shape::regular(5, bad).is_err(), "{bad}");
        }
        for bad in [f32::NAN, f32::INFINITY, 1e30] {
            assert!(Shape::segment(Vec2::new(bad, 0.0), p).is_err(), "{bad}");
            assert!(Shape::capsule(p, Vec2::new(0.0, bad), 1.0).is_err(), "{bad}");
        }
        assert!(Shape::segment(p, p).is_err());
        assert!(Shape::capsule(p, p, 1.0).is_err());
        assert_eq!(
            Shape::circle(-1.0).unwrap_err().to_string(),
            "radius is -1; allowed is 1e-5 to 1e6"
        );
    }
}
