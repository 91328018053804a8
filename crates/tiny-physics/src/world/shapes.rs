//! Shapes as the user sees them.

use super::World;
use super::ids::ShapeId;
use crate::describe::{ChainLink, ShapeDef};
use crate::dynamics::ShapeRecord;
use crate::geometry::Shape;
use crate::math::{Aabb, Transform, Vec2};

/// A shape of the world, to read.
#[derive(Clone, Copy)]
pub struct ShapeRef<'a> {
    pub(super) world: &'a World,
    pub(super) record: &'a ShapeRecord,
    pub(super) index: u32,
}

impl<'a> ShapeRef<'a> {
    pub(super) fn new(world: &'a World, index: u32) -> Self {
        Self { world, record: &world.state.shapes.records[index as usize], index }
    }

    /// Geometry in the shape's frame.
    pub fn shape(&self) -> &'a Shape {
        &self.record.shape
    }

    /// The shape's frame in the body's frame.
    pub fn local(&self) -> Transform {
        self.record.local
    }

    /// Direction, in the body's frame, out of the solid side of a one-way platform.
    pub fn one_way(&self) -> Option<Vec2> {
        self.record.one_way
    }

    /// Its neighbours in a chain. A segment with a link is solid from one side only.
    pub fn link(&self) -> Option<ChainLink> {
        self.record.link
    }

    /// The shape as it is now, as a description.
    pub fn describe(&self) -> ShapeDef {
        let Transform { p: offset, q } = self.record.local;
        let def = ShapeDef::new(self.record.shape);
        self.record.tell(ShapeDef { offset, angle: q.angle(), ..def })
    }

    /// The box that the broad phase knows it by: world, metres, with a margin. `None` while its body is
    /// disabled.
    pub fn fat_aabb(&self) -> Option<Aabb> {
        self.world.state.broad_phase.fat_aabb(self.world.state.shapes.proxy(self.index))
    }
}

impl World {
    /// A shape; `None` if it has been removed.
    pub fn shape(&self, id: ShapeId) -> Option<ShapeRef<'_>> {
        let index = self.shape_index(id).ok()?;
        Some(ShapeRef::new(self, index))
    }

    /// Handles of all shapes, in index order.
    pub fn shape_ids(&self) -> impl Iterator<Item = ShapeId> + '_ {
        self.state.shapes.indices().map(|index| self.shape_id(index))
    }
}
