//! How much memory a world holds, and what for.

use super::state::State;
use super::{Scratch, World};
use crate::codec::Data;
pub use crate::footprint::MemoryUse;
use crate::footprint::{Footprint, footprint};

footprint!(Scratch {
    search,
    created,
    transfers,
    tidy,
    changes,
    ways,
    predictions,
    fast,
    carriers,
    turning,
    moved,
    islands,
    sets,
    paces,
    woken,
    hinges,
    schedule,
    solver,
    sway,
    overlaps,
    touching,
    switched_off,
    loads
} each { found_changes, findings, found_overlaps, answers } none { solving });

/// Memory that a world holds on the heap, by what it is for. What is left out: closures given as hooks, threads and
/// what they share, and what the allocator adds to each block.
///
/// Lists keep their memory when records go, for those that come: a world holds what its fullest step needed. A clone
/// holds no more than it uses.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Memory {
    /// Bodies: what the solver needs of them, poses, properties.
    pub bodies: MemoryUse,
    /// Shapes, with their boxes.
    pub shapes: MemoryUse,
    /// The trees of boxes, and which boxes moved.
    pub broad_phase: MemoryUse,
    /// Contact records, the table of pairs that have one, and pairs that are close.
    pub contacts: MemoryUse,
    /// What narrow phase and solver keep of contacts of bodies that are awake.
    pub graph: MemoryUse,
    /// The part of `graph` that every pass of the solver goes through.
    pub constraints: MemoryUse,
    /// Joints, and all that the solver keeps of them.
    pub joints: MemoryUse,
    /// Sensors, tile maps, the events of the last step, and the list of moved bodies.
    pub other: MemoryUse,
    /// Lists that a step fills anew.
    pub scratch: MemoryUse,
}

impl Memory {
    /// All together.
    pub fn total(&self) -> MemoryUse {
        // Constraints are a part of the graph.
        let Self { bodies, shapes, broad_phase, contacts, graph, joints, other, scratch, .. } =
            *self;
        [bodies, shapes, broad_phase, contacts, graph, joints, other, scratch].into_iter().sum()
    }
}

impl World {
    /// Counts the memory that the world holds. It looks at every list, of which there are a few hundred, but
    /// at no body.
    ///
    /// ```
    /// use tiny_physics::{RigidBody, Shape, Vec2, World};
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new(Vec2::new(0.0, -9.8));
    /// let empty = world.memory().total();
    /// for i in 0..100 {
    ///     world.add_body(RigidBody::new(Shape::circle(0.4)?, Vec2::new(i as f32, 0.0), 1.0))?;
    /// }
    /// let memory = world.memory();
    /// assert!(memory.total().held > empty.held);
    /// assert!(memory.bodies.used >= 100 * 128 && memory.bodies.used <= memory.bodies.held);
    /// # Ok(())
    /// # }
    /// ```
    pub fn memory(&self) -> Memory {
        let State { bodies, shapes, contacts, waiting, graph, joints, joint_graph, .. } =
            &self.state;
        let State {
            broad_phase,
            tiles,
            sensors,
            events,
            step_count: _,
            inv_h: _,
            inv_h_asleep: _,
            coarse_h: _,
            ..
        } = &self.state;
        let moved: MemoryUse = self.moved.get().into_iter().map(Footprint::footprint).sum();
        let other = [sensors.memory(), tiles.memory(), events.memory(), self.last.memory(), moved];
        Memory {
            bodies: bodies.memory(),
            shapes: shapes.memory(),
            broad_phase: broad_phase.memory(),
            contacts: [contacts.memory(), waiting.memory()].into_iter().sum(),
            graph: graph.memory(),
            constraints: graph.constraints_footprint(),
            joints: [joints.memory(), joint_graph.memory()].into_iter().sum(),
            other: other.into_iter().sum(),
            scratch: self.scratch.footprint(),
        }
    }
}
