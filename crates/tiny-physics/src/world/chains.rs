//! Chains of a world by one handle.

use super::World;
use super::ids::{BodyId, ShapeId};
use crate::describe::{ChainDef, Material};
use crate::error::Error;
use core::ops::Deref;

/// A chain of a world, as [`World::add_chain`] gives it: a list of the handles of its segments, in order.
///
/// ```
/// use tiny_physics::prelude::*;
/// # fn main() -> Result<(), tiny_physics::Error> {
/// let mut world = World::new((0.0, -10.0));
/// let ground = world.add_body(RigidBody::fixed())?;
/// let road = world.add_chain(ground, &ChainDef::heights(1.0, &[0.0, 0.2, 0.1, 0.3]))?;
/// road.set_material(&mut world, Material { friction: 0.9, ..Material::default() })?;
/// // The second segment is ice.
/// world.shape_mut(road[1]).unwrap().set_friction(0.0)?;
/// road.remove(&mut world)?;
/// assert_eq!(world.shape_count(), 0);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Chain(Vec<ShapeId>);

impl Deref for Chain {
    type Target = [ShapeId];

    fn deref(&self) -> &[ShapeId] {
        &self.0
    }
}

impl From<Chain> for Vec<ShapeId> {
    fn from(chain: Chain) -> Self {
        chain.0
    }
}

impl Chain {
    /// Changes surface and stuff of all segments; one alone goes by [`World::shape_mut`].
    ///
    /// # Errors
    /// A segment has been removed, or a number is out of range. Nothing has changed then.
    pub fn set_material(&self, world: &mut World, material: Material) -> Result<(), Error> {
        self.0.iter().try_for_each(|id| world.shape_index(*id).map(|_| ()))?;
        let changed =
            self.0.iter().filter_map(|id| Some(world.shape_mut(*id)?.set_material(material)));
        changed.collect()
    }

    /// Removes the chain: see [`World::remove_shapes`].
    ///
    /// # Errors
    /// A segment has been removed. Nothing has been removed then.
    pub fn remove(self, world: &mut World) -> Result<(), Error> {
        world.remove_shapes(&self.0)
    }
}

impl World {
    /// Adds the segments of a chain to a body.
    ///
    /// # Errors
    /// The handle is stale, or the points make no chain. Nothing has been added then.
    pub fn add_chain(&mut self, body: BodyId, chain: &ChainDef) -> Result<Chain, Error> {
        self.add_shapes(body, &chain.shapes()?).map(Chain)
    }
}
