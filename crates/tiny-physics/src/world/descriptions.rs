//! Are the numbers of a description acceptable?

use crate::describe::{RigidBody, ShapeDef};
use crate::error::Error;
use crate::geometry::{Shape, check_point};
use crate::math::Vec2;

/// Coordinates beyond this are refused: 64-bit positions would lose millimetres.
pub(super) const MAX_COORDINATE: f64 = 1.0e12;
/// Masses and densities outside of this are refused: products with them would leave 32 bits.
const MASSES: core::ops::RangeInclusive<f32> = 1.0e-9..=1.0e12;

impl RigidBody {
    /// Checks what [`World::add_body`](crate::World::add_body) checks.
    ///
    /// # Errors
    /// [`Error::NotFinite`] and [`Error::OutOfRange`] name the first field that makes no sense.
    pub fn validate(&self) -> Result<(), Error> {
        check_body(self)
    }
}

impl ShapeDef {
    /// Checks what [`World::add_shape`](crate::World::add_shape) checks.
    ///
    /// # Errors
    /// As [`RigidBody::validate`] has them.
    pub fn validate(&self) -> Result<(), Error> {
        check_shape(self)
    }
}

pub(super) fn check_body(body: &RigidBody) -> Result<(), Error> {
    for (name, value) in [("position.x", body.position.x), ("position.y", body.position.y)] {
        let is_near = value.abs() <= MAX_COORDINATE;
        Error::check(name, value, is_near, "within 1e12 of the origin")?;
    }
    Error::check_finite("angle", body.angle)?;
    Error::check_finite_vec("velocity", body.velocity)?;
    Error::check_finite("angular_velocity", body.angular_velocity)?;
    Error::check_not_negative("linear_damping", body.linear_damping)?;
    Error::check_not_negative("angular_damping", body.angular_damping)?;
    Error::check_finite("gravity_scale", body.gravity_scale)?;
    Error::check_not_negative("sleep_speed", body.sleep_speed)?;
    check_given("mass", body.mass)?;
    check_center(body.center)?;
    check_given("inertia", body.inertia)?;
    body.shapes.iter().try_for_each(check_shape)
}

pub(super) fn check_center(center: Option<Vec2>) -> Result<(), Error> {
    center.map_or(Ok(()), |center| check_point("center", center))
}

/// Is a mass or moment of inertia acceptable, where one is given?
pub(super) fn check_given(name: &'static str, given: Option<f32>) -> Result<(), Error> {
    given.map_or(Ok(()), |value| {
        Error::check_positive(name, value)?;
        check_range(name, value)
    })
}

pub(super) fn check_shape(shape: &ShapeDef) -> Result<(), Error> {
    shape.shape.validate()?;
    check_point("offset", shape.offset)?;
    Error::check_finite("angle", shape.angle)?;
    Error::check_not_negative("density", shape.material.density)?;
    if shape.material.density != 0.0 {
        check_range("density", shape.material.density)?;
    }
    Error::check_not_negative("friction", shape.material.friction)?;
    Error::check_not_negative("restitution", shape.material.restitution)?;
    Error::check_not_negative("rolling_resistance", shape.material.rolling_resistance)?;
    Error::check_finite("tangent_speed", shape.material.tangent_speed)?;
    if let Some(link) = shape.link {
        if !matches!(shape.shape, Shape::Segment { .. }) {
            return Err(Error::Unsupported { reason: "only segments are links of a chain" });
        }
        for end in [link.previous, link.next].into_iter().flatten() {
            Error::check_finite_vec("link", end)?;
        }
    }
    shape.one_way.map_or(Ok(()), |direction| Error::check_finite_vec("one_way", direction))
}

fn check_range(name: &'static str, value: f32) -> Result<(), Error> {
    Error::check(name, value, MASSES.contains(&value), "1e-9 to 1e12")
}
