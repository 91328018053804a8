//! What comes of a command.

use crate::{BodyId, CharacterMover, JointId, ShapeId, TileGridId};

/// What a command made.
#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
#[allow(clippy::large_enum_variant, reason = "one a command, and none is kept in a list")]
#[non_exhaustive]
pub enum Made {
    /// Nothing new.
    Nothing,
    /// A body.
    Body(BodyId),
    /// A shape.
    Shape(ShapeId),
    /// The shapes of a chain or an outline, in order.
    Shapes(Vec<ShapeId>),
    /// A joint.
    Joint(JointId),
    /// A tile map.
    TileGrid(TileGridId),
    /// The character as it is after its movement.
    Character(CharacterMover),
}
