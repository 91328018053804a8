//! The sizes and places that shapes may have.

use crate::error::Error;
use crate::math::Vec2;

/// No radius, half extent or length of a core may be below this, metres.
pub const MIN_EXTENT: f32 = 1.0e-5;
/// No coordinate, radius or half extent of a shape may be above this, metres: its square and the
/// fourth power stay far inside 32 bits.
pub const MAX_EXTENT: f32 = 1.0e6;

/// `Ok` where a radius or half extent is in range.
pub(super) fn check_size(name: &'static str, value: f32) -> Result<(), Error> {
    Error::check(name, value, (MIN_EXTENT..=MAX_EXTENT).contains(&value), "1e-5 to 1e6")
}

/// `Ok` where both coordinates of a point are in range.
pub(crate) fn check_point(name: &'static str, point: Vec2) -> Result<(), Error> {
    let check = |value: f32| Error::check(name, value, value.abs() <= MAX_EXTENT, "-1e6 to 1e6");
    check(point.x)?;
    check(point.y)
}
