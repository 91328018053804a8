//! Shapes as the user sees them.

use super::World;
use super::ids::{BodyId, ShapeId};
use crate::describe::{ChainLink, Filter, Material, ShapeDef};
use crate::dynamics::ShapeRecord;
use crate::geometry::Shape;
use crate::math::{Aabb, Pose, Transform, Vec2};

/// A shape of the world, to read.
#[derive(Clone, Copy)]
pub struct ShapeRef<'a> {
    world: &'a World,
    record: &'a ShapeRecord,
    index: u32,
}

impl<'a> ShapeRef<'a> {
    pub(super) fn new(world: &'a World, index: u32) -> Self {
        Self { world, record: &world.state.shapes.records[index as usize], index }
    }

    /// Its handle.
    pub fn id(&self) -> ShapeId {
        self.world.shape_id(self.index)
    }

    /// The body it hangs on.
    pub fn body(&self) -> BodyId {
        self.world.body_id(self.record.body)
    }

    /// Geometry in the shape's frame.
    pub fn shape(&self) -> &'a Shape {
        &self.record.shape
    }

    /// The shape's frame in the body's frame.
    pub fn local(&self) -> Transform {
        self.record.local
    }

    /// Surface and stuff.
    pub fn material(&self) -> Material {
        self.record.material
    }

    /// What it collides with.
    pub fn filter(&self) -> Filter {
        self.record.filter
    }

    /// Is it a sensor?
    pub fn is_sensor(&self) -> bool {
        self.record.sensor
    }

    /// Direction, in the body's frame, out of the solid side of a one-way platform.
    pub fn one_way(&self) -> Option<Vec2> {
        self.record.one_way
    }

    /// Its neighbours in a chain. A segment with a link is solid from one side only.
    pub fn link(&self) -> Option<ChainLink> {
        self.record.link
    }

    /// Its frame in the world.
    pub fn pose(&self) -> Pose {
        self.world.state.bodies.poses[self.record.body as usize].compose(self.record.central)
    }

    /// The shape as it is now, as a description.
    pub fn describe(&self) -> ShapeDef {
        let Transform { p: offset, q } = self.record.local;
        let def = ShapeDef::new(self.record.shape);
        self.record.tell(ShapeDef { offset, angle: q.angle(), ..def })
    }

    /// The user's number.
    pub fn user_data(&self) -> u64 {
        self.record.user_data
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
