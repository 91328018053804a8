//! Shapes in files (feature `serde`).
//!
//! Written as `{"circle": {"radius": 0.4}}`, `{"aabb": {"half_extents": [1, 2]}}`,
//! `{"capsule": {"a": [0, 0], "b": [1, 0], "radius": 0.1}}`, `{"segment": {"a": [0, 0], "b": [1, 0]}}` and
//! `{"polygon": {"vertices": [[0, 0], [1, 0], [0, 1]], "radius": 0.1}}`, which give the same bits when read.
//! Besides, `rect` (half extents, optional center, angle and radius) and `regular` (count, size, optional
//! radius) are read, and vertices in any order, which become their hull. What is read is checked.

use super::limits::check_size;
use super::{Polygon, Shape};
use crate::error::Error;
use crate::math::{Rot, Vec2};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

/// What stands in the file.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Shape", rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum ShapeData {
    Circle {
        #[serde(deserialize_with = "read_radius")]
        radius: f32,
    },
    Aabb {
        #[serde(deserialize_with = "read_half_extents")]
        half_extents: Vec2,
    },
    Capsule {
        a: Vec2,
        b: Vec2,
        #[serde(deserialize_with = "read_radius")]
        radius: f32,
    },
    Segment {
        a: Vec2,
        b: Vec2,
    },
    Polygon(PolygonData),
    #[serde(skip_serializing)]
    Rect(RectData),
    #[serde(skip_serializing)]
    Regular(RegularData),
}

/// A polygon in a file.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Polygon", deny_unknown_fields)]
pub(super) struct PolygonData {
    vertices: Vec<Vec2>,
    #[serde(default, skip_serializing_if = "is_zero")]
    radius: f32,
}

/// A rectangle in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RectData {
    #[serde(deserialize_with = "read_half_extents")]
    half_extents: Vec2,
    #[serde(default)]
    center: Vec2,
    #[serde(default)]
    angle: f32,
    #[serde(default)]
    radius: f32,
}

/// A regular polygon in a file; `size` from the centre to the corners.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RegularData {
    count: usize,
    size: f32,
    #[serde(default)]
    radius: f32,
}

/// Checks a number while its field is read, so that the reader can tell the field.
fn read_radius<'de, D: Deserializer<'de>>(reader: D) -> Result<f32, D::Error> {
    let radius = f32::deserialize(reader)?;
    check_size("radius", radius).map_err(D::Error::custom)?;
    Ok(radius)
}

/// The same for half extents.
fn read_half_extents<'de, D: Deserializer<'de>>(reader: D) -> Result<Vec2, D::Error> {
    let half_extents = Vec2::deserialize(reader)?;
    check_size("half width", half_extents.x).map_err(D::Error::custom)?;
    check_size("half height", half_extents.y).map_err(D::Error::custom)?;
    Ok(half_extents)
}

fn is_zero(value: &f32) -> bool {
    *value == 0.0
}

impl From<Shape> for ShapeData {
    fn from(shape: Shape) -> Self {
        match shape {
            Shape::Circle { radius } => Self::Circle { radius },
            Shape::Aabb { half_extents } => Self::Aabb { half_extents },
            Shape::Capsule { a, b, radius } => Self::Capsule { a, b, radius },
            Shape::Segment { a, b } => Self::Segment { a, b },
            Shape::Polygon(polygon) => Self::Polygon(polygon.into()),
        }
    }
}

impl TryFrom<ShapeData> for Shape {
    type Error = Error;

    fn try_from(data: ShapeData) -> Result<Self, Error> {
        let shape = match data {
            ShapeData::Circle { radius } => Self::Circle { radius },
            ShapeData::Aabb { half_extents } => Self::Aabb { half_extents },
            ShapeData::Capsule { a, b, radius } => Self::Capsule { a, b, radius },
            ShapeData::Segment { a, b } => Self::Segment { a, b },
            ShapeData::Polygon(data) => Self::Polygon(data.try_into()?),
            ShapeData::Rect(data) => Self::Polygon(data.try_into()?),
            ShapeData::Regular(data) => {
                Self::Polygon(Polygon::regular(data.count, data.size)?.rounded(data.radius)?)
            }
        };
        shape.validate().map(|()| shape)
    }
}

impl From<Polygon> for PolygonData {
    fn from(polygon: Polygon) -> Self {
        Self { vertices: polygon.vertices().to_vec(), radius: polygon.radius() }
    }
}

impl TryFrom<PolygonData> for Polygon {
    type Error = Error;

    fn try_from(data: PolygonData) -> Result<Self, Error> {
        // Vertices that are in order stay exactly as they are, so that a saved world goes on the same.
        let polygon = Self::convex(&data.vertices).or_else(|_| Self::hull(&data.vertices))?;
        polygon.rounded(data.radius)
    }
}

impl TryFrom<RectData> for Polygon {
    type Error = Error;

    fn try_from(data: RectData) -> Result<Self, Error> {
        Error::check_finite("angle", data.angle)?;
        let rotation = Rot::from_angle(data.angle);
        Self::turned_rect(data.half_extents.x, data.half_extents.y, data.center, rotation)?
            .rounded(data.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::any_shape;
    use super::*;
    use proptest::prelude::*;

    fn read(text: &str) -> Result<Shape, String> {
        serde_json::from_str(text).map_err(|error| error.to_string())
    }

    #[test]
    fn the_written_form_is_plain() {
        let text = |shape: Shape| serde_json::to_string(&shape).unwrap();
        assert_eq!(text(Shape::circle(0.5).unwrap()), r#"{"circle":{"radius":0.5}}"#);
        assert_eq!(
            text(Shape::segment(Vec2::ZERO, Vec2::X).unwrap()),
            r#"{"segment":{"a":[0.0,0.0],"b":[1.0,0.0]}}"#
        );
        let triangle = [Vec2::ZERO, Vec2::X, Vec2::Y];
        let rounded = Polygon::convex(&triangle).unwrap().rounded(0.25).unwrap();
        assert_eq!(
            text(rounded.into()),
            r#"{"polygon":{"vertices":[[0.0,0.0],[1.0,0.0],[0.0,1.0]],"radius":0.25}}"#
        );
    }

    #[test]
    fn shorter_forms_are_read() {
        let rect = read(r#"{"rect": {"half_extents": [1, 2]}}"#).unwrap();
        assert_eq!(rect, Shape::rect(1.0, 2.0).unwrap());
        let regular = read(r#"{"regular": {"count": 5, "size": 2, "radius": 0.1}}"#).unwrap();
        let expected = Polygon::regular(5, 2.0).unwrap().rounded(0.1).unwrap();
        assert_eq!(regular, expected.into());
        let mixed = read(r#"{"polygon": {"vertices": [[0,0],[1,1],[1,0],[0,1],[0.5,0.5]]}}"#);
        assert!(matches!(mixed, Ok(Shape::Polygon(p)) if p.as_rect().is_some()));
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, reason) in [
            (r#"{"circle":{"radius":-1}}"#, "radius is -1; allowed is 1e-5 to 1e6"),
            (r#"{"circle":{"radius":1,"size":2}}"#, "unknown field `size`"),
            (r#"{"circle":{}}"#, "missing field `radius`"),
            (r#"{"blob":{"radius":1}}"#, "unknown variant `blob`"),
            (r#"{"polygon":{"vertices":[[0,0],[1,1],[2,2]]}}"#, "not on one line"),
            (r#"{"polygon":{"vertices":[[0,0],[1,0],[0,1]],"radius":-1}}"#, "corner radius is -1"),
            (r#"{"rect":{"half_extents":[1,0]}}"#, "half height is 0"),
            (r#"{"segment":{"a":[1,1],"b":[1,1]}}"#, "segment is shorter"),
            (r#"{"circle":{"radius":1e30}}"#, "radius is 1000000015"),
        ] {
            let error = read(text).unwrap_err();
            assert!(error.contains(reason), "{text}: {error}");
        }
    }

    proptest! {
        #[test]
        fn what_is_written_reads_back_the_same(shape in any_shape()) {
            let text = serde_json::to_string(&shape).unwrap();
            prop_assert_eq!(read(&text).unwrap(), shape);
        }
    }
}
