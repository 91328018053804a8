//! Convex polygons.

use crate::error::Error;
use crate::math::{Rot, Vec2};

/// Greatest number of vertices of a convex polygon.
pub const MAX_VERTICES: usize = 8;

/// A convex polygon of 3 to 8 vertices, anticlockwise, with an optional corner radius that rounds
/// it outwards.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Polygon {
    vertices: [Vec2; MAX_VERTICES],
    normals: [Vec2; MAX_VERTICES],
    count: u8,
    radius: f32,
}

impl Polygon {
    /// A box by its half width and half height, centred.
    ///
    /// # Errors
    /// A half extent that is not finite or not above 0.
    pub fn rect(half_width: f32, half_height: f32) -> Result<Self, Error> {
        Self::turned_rect(half_width, half_height, Vec2::ZERO, Rot::IDENTITY)
    }

    /// A box with a centre and rotation of its own.
    ///
    /// # Errors
    /// A half extent that is not finite or not above 0, a centre that is not finite.
    pub fn turned_rect(
        half_width: f32,
        half_height: f32,
        center: Vec2,
        rotation: Rot,
    ) -> Result<Self, Error> {
        Error::check_positive("half width", half_width)?;
        Error::check_positive("half height", half_height)?;
        Error::check_finite_vec("center", center)?;
        let corners = [
            Vec2::new(-half_width, -half_height),
            Vec2::new(half_width, -half_height),
            Vec2::new(half_width, half_height),
            Vec2::new(-half_width, half_height),
        ];
        let axes = [-Vec2::Y, Vec2::X, Vec2::Y, -Vec2::X];
        let mut polygon = Self {
            vertices: [Vec2::ZERO; MAX_VERTICES],
            normals: [Vec2::ZERO; MAX_VERTICES],
            count: 4,
            radius: 0.0,
        };
        for i in 0..4 {
            polygon.vertices[i] = rotation.rotate(corners[i]) + center;
            polygon.normals[i] = rotation.rotate(axes[i]);
        }
        Ok(polygon)
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
}
