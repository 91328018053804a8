//! What can be done to a world, as data.

use super::{BodyCommand, ShapeCommand};
use crate::{
    BodyId, ChainDef, CharacterMover, Error, Explosion, Filter, ForceZone, JointDef, JointId,
    MoverInput, QueryFilter, RigidBody, Settings, ShapeDef, ShapeId, TileGrid, TileGridId, Vec2,
    Water, World,
};

/// Something that is done to a world between two steps. Most are named after the function that they stand for.
#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
#[non_exhaustive]
pub enum Command {
    /// [`World::add_body`].
    AddBody(RigidBody),
    /// [`World::remove_body`].
    RemoveBody(BodyId),
    /// A function of [`BodyMut`](crate::BodyMut).
    Body(BodyId, BodyCommand),
    /// [`World::add_shape`].
    AddShape(BodyId, ShapeDef),
    /// [`World::add_chain`].
    AddChain(BodyId, ChainDef),
    /// [`World::add_outline`]: the outline, and the shape to copy, whose own geometry must be valid too.
    AddOutline(BodyId, Vec<Vec2>, ShapeDef),
    /// [`World::remove_shape`].
    RemoveShape(ShapeId),
    /// A function of [`ShapeMut`](crate::ShapeMut).
    Shape(ShapeId, ShapeCommand),
    /// [`World::add_joint`].
    AddJoint(BodyId, BodyId, JointDef),
    /// [`World::set_joint`].
    SetJoint(JointId, JointDef),
    /// [`World::remove_joint`].
    RemoveJoint(JointId),
    /// [`World::add_tiles`].
    AddTiles(TileGrid),
    /// [`World::set_tile`]: column, row, value.
    SetTile(TileGridId, u32, u32, u16),
    /// [`World::remove_tiles`].
    RemoveTiles(TileGridId),
    /// [`World::explode`].
    Explode(Explosion, FilterData),
    /// [`World::apply_water`], with the length of the next step.
    ApplyWater(Water, FilterData, f32),
    /// [`World::apply_zone`], with the length of the next step. A zone without a valid shape is refused.
    ApplyZone(ForceZone, FilterData, f32),
    /// [`CharacterMover::update`]: the character before it, what it is asked to do, and seconds. What it does to
    /// the world happens; [`Made::Character`] is the character after it.
    MoveCharacter(CharacterMover, MoverInput, f32),
    /// [`World::gravity`].
    SetGravity(Vec2),
    /// [`World::settings`].
    SetSettings(Settings),
    /// [`World::restore_bytes`], or `clone_from` with the world that gave the bytes: goes back to a frame.
    RestoreBytes(Vec<u8>),
}

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

/// A [`QueryFilter`] without a predicate, which is code and cannot be recorded.
///
/// ```
/// use tiny_physics::QueryFilter;
/// use tiny_physics::record::FilterData;
/// let crates = FilterData::try_from(&QueryFilter::new().mask(1 << 3))?;
/// assert!(FilterData::try_from(&QueryFilter::new().predicate(&|_| true)).is_err());
/// # let _ = crates;
/// # Ok::<(), tiny_physics::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct FilterData {
    /// As [`QueryFilter::filter`].
    pub filter: Filter,
    /// As [`QueryFilter::exclude_body`].
    pub exclude_body: Option<BodyId>,
    /// As [`QueryFilter::sensors`].
    pub sensors: bool,
}

impl FilterData {
    fn to_filter(self) -> QueryFilter<'static> {
        let Self { filter, exclude_body, sensors } = self;
        QueryFilter { filter, exclude_body, sensors, ..QueryFilter::new() }
    }
}

impl Default for FilterData {
    /// Sees everything but sensors, as [`QueryFilter::new`].
    fn default() -> Self {
        let QueryFilter { filter, exclude_body, sensors, .. } = QueryFilter::new();
        Self { filter, exclude_body, sensors }
    }
}

impl TryFrom<&QueryFilter<'_>> for FilterData {
    type Error = Error;

    fn try_from(query: &QueryFilter<'_>) -> Result<Self, Error> {
        if query.predicate.is_some() {
            let reason = "the predicate of a filter is code and cannot be recorded";
            return Err(Error::Unsupported { reason });
        }
        let QueryFilter { filter, exclude_body, sensors, .. } = *query;
        Ok(Self { filter, exclude_body, sensors })
    }
}

impl Command {
    /// Does it to a world.
    ///
    /// # Errors
    /// Those of the function that the command stands for; a stale handle where that would do nothing. The world
    /// has not changed then.
    pub fn apply(&self, world: &mut World) -> Result<Made, Error> {
        Ok(match self {
            Self::AddBody(body) => Made::Body(world.add_body(body.clone())?),
            Self::AddShape(body, shape) => Made::Shape(world.add_shape(*body, shape.clone())?),
            Self::AddChain(body, chain) => Made::Shapes(world.add_chain(*body, chain)?.into()),
            Self::AddOutline(body, outline, like) => {
                // What was accepted must be readable again.
                like.shape.validate()?;
                Made::Shapes(world.add_outline(*body, outline, like)?)
            }
            Self::AddJoint(a, b, def) => Made::Joint(world.add_joint(*a, *b, *def)?),
            Self::AddTiles(grid) => Made::TileGrid(world.add_tiles(grid.clone())?),
            Self::MoveCharacter(character, input, dt) => {
                let mut character = character.clone();
                character.update(world, *input, *dt);
                Made::Character(character)
            }
            changes => {
                changes.change(world)?;
                Made::Nothing
            }
        })
    }

    /// What makes nothing new.
    fn change(&self, world: &mut World) -> Result<(), Error> {
        match self {
            Self::RemoveBody(body) => world.remove_body(*body)?,
            Self::RemoveShape(shape) => world.remove_shape(*shape)?,
            Self::RemoveJoint(joint) => world.remove_joint(*joint)?,
            Self::RemoveTiles(grid) => world.remove_tiles(*grid)?,
            Self::Body(id, command) => {
                command.apply(&mut world.body_mut(*id).ok_or_else(|| Error::from(*id))?)?;
            }
            Self::Shape(id, command) => {
                command.apply(&mut world.shape_mut(*id).ok_or_else(|| Error::from(*id))?)?;
            }
            Self::SetJoint(joint, def) => world.set_joint(*joint, *def)?,
            Self::SetTile(grid, x, y, value) => world.set_tile(*grid, *x, *y, *value)?,
            Self::Explode(explosion, filter) => world.explode(explosion, &filter.to_filter()),
            Self::ApplyWater(water, filter, dt) => {
                world.apply_water(water, &filter.to_filter(), *dt);
            }
            Self::ApplyZone(zone, filter, dt) => {
                zone.shape.validate()?;
                world.apply_zone(zone, &filter.to_filter(), *dt);
            }
            Self::SetGravity(gravity) => world.gravity = *gravity,
            Self::SetSettings(settings) => world.settings = *settings,
            Self::RestoreBytes(bytes) => world.restore_bytes(bytes)?,
            Self::AddBody(_)
            | Self::AddShape(..)
            | Self::AddChain(..)
            | Self::AddOutline(..)
            | Self::AddJoint(..)
            | Self::AddTiles(_)
            | Self::MoveCharacter(..) => {}
        }
        Ok(())
    }
}
