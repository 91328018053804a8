//! What can be done to a world, as data.

use super::declare::{Outcome, commands, keep, part};
use super::{BodyCommand, Made, ShapeCommand};
use crate::codec::{Data, Reader, Sink, bad, described};
use crate::{
    BodyId, ChainDef, CharacterMover, Error, Explosion, Filter, ForceZone, JointDef, JointId,
    MoverInput, QueryFilter, RigidBody, Settings, ShapeDef, ShapeId, TileGrid, TileGridId, Vec2,
    Water, World,
};

commands! {
    for world: World;

    /// Something that is done to a world between two steps. Most are named after the function that they stand for.
    #[derive(Clone, PartialEq, Debug)]
    #[non_exhaustive]
    pub enum Command {
        /// [`World::add_body`].
        AddBody(body: RigidBody) = 0: world.add_body(body.clone()).map(Made::Body),
        /// [`World::remove_body`].
        RemoveBody(body: BodyId) = 1: world.remove_body(*body),
        /// A function of [`BodyMut`](crate::BodyMut).
        Body(body: BodyId, command: BodyCommand) = 2: {
            let body = world.body_mut(*body).ok_or_else(|| Error::from(*body));
            command.carry_out(&mut body?)
        },
        /// [`World::add_shape`].
        AddShape(body: BodyId, shape: ShapeDef) = 3:
            world.add_shape(*body, shape.clone()).map(Made::Shape),
        /// [`World::add_chain`].
        AddChain(body: BodyId, chain: ChainDef) = 4:
            world.add_chain(*body, chain).map(|chain| Made::Shapes(chain.into())),
        /// [`World::add_outline`]: the outline, and the shape to copy, whose own geometry must be valid too.
        AddOutline(body: BodyId, outline: Vec<Vec2>, like: ShapeDef) = 5: {
            // What was accepted must be readable again.
            like.shape.validate()?;
            world.add_outline(*body, outline, like).map(Made::Shapes)
        },
        /// [`World::remove_shape`].
        RemoveShape(shape: ShapeId) = 6: world.remove_shape(*shape),
        /// A function of [`ShapeMut`](crate::ShapeMut).
        Shape(shape: ShapeId, command: ShapeCommand) = 7: {
            let shape = world.shape_mut(*shape).ok_or_else(|| Error::from(*shape));
            command.carry_out(&mut shape?)
        },
        /// [`World::add_joint`].
        AddJoint(a: BodyId, b: BodyId, def: JointDef) = 8:
            world.add_joint(*a, *b, *def).map(Made::Joint),
        /// [`World::set_joint`].
        SetJoint(joint: JointId, def: JointDef) = 9: world.set_joint(*joint, *def),
        /// [`World::remove_joint`].
        RemoveJoint(joint: JointId) = 10: world.remove_joint(*joint),
        /// [`World::add_tiles`].
        AddTiles(grid: TileGrid) = 11: world.add_tiles(grid.clone()).map(Made::TileGrid),
        /// [`World::set_tile`]: column, row, value.
        SetTile(grid: TileGridId, x: u32, y: u32, value: u16) = 12:
            world.set_tile(*grid, *x, *y, *value),
        /// [`World::remove_tiles`].
        RemoveTiles(grid: TileGridId) = 13: world.remove_tiles(*grid),
        /// [`World::explode`].
        Explode(explosion: Explosion, filter: FilterData) = 14:
            world.explode(explosion, &filter.to_filter()),
        /// [`World::apply_water`], with the length of the next step.
        ApplyWater(water: Water, filter: FilterData, dt: f32) = 15:
            world.apply_water(water, &filter.to_filter(), *dt),
        /// [`World::apply_zone`], with the length of the next step. A zone without a valid shape is refused.
        ApplyZone(zone: ForceZone, filter: FilterData, dt: f32) = 16: {
            zone.shape.validate()?;
            world.apply_zone(zone, &filter.to_filter(), *dt);
        },
        /// [`CharacterMover::update`]: the character before it, what it is asked to do, and seconds. What it does to
        /// the world happens; [`Made::Character`] is the character after it.
        MoveCharacter(character: CharacterMover, input: MoverInput, dt: f32) = 17: {
            let mut character = character.clone();
            character.update(world, *input, *dt);
            Ok(Made::Character(character))
        },
        /// [`World::gravity`].
        SetGravity(gravity: Vec2) = 18: {
            Error::check_finite_vec("gravity", *gravity)?;
            world.gravity = *gravity;
        },
        /// [`World::settings`].
        SetSettings(settings: Settings) = 19: {
            settings.validate()?;
            world.settings = *settings;
        },
        /// [`World::restore_bytes`], or `clone_from` with the world that gave the bytes: goes back to a frame.
        RestoreBytes(bytes: Vec<u8>) = 20: world.restore_bytes(bytes),
    }
}

described! {
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
    pub struct FilterData {
        /// As [`QueryFilter::filter`].
        pub filter: Filter = QueryFilter::new().filter,
        /// As [`QueryFilter::exclude_body`].
        pub exclude_body: Option<BodyId> = None,
        /// As [`QueryFilter::sensors`].
        pub sensors: bool = false,
    }
}

impl FilterData {
    fn to_filter(self) -> QueryFilter<'static> {
        let Self { filter, exclude_body, sensors } = self;
        QueryFilter { filter, exclude_body, sensors, ..QueryFilter::new() }
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
        self.carry_out(world)
    }
}
