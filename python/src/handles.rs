//! The classes of a world and of what is in it: what each holds. What they do is in files of their own.

use pyo3::prelude::*;
use tiny_physics as engine;

/// A world of bodies. Metres, kilograms, seconds, radians anticlockwise; y points up.
///
/// gravity: (x, y), metres a second squared.
/// settings: a dictionary of what differs from the defaults: {"substeps": 8}.
///
/// Raises ValueError where a number makes no sense.
#[pyclass(module = "tiny_physics")]
pub struct World {
    pub inner: engine::World,
}

/// Declares the handle of something in a world.
macro_rules! handle {
    ($(#[$doc:meta])* $name:ident, $id:ty) => {
        $(#[$doc])*
        #[pyclass(module = "tiny_physics", frozen, eq, hash)]
        pub struct $name {
            pub world: Py<World>,
            pub id: $id,
        }

        impl PartialEq for $name {
            fn eq(&self, other: &Self) -> bool {
                self.id == other.id && self.world.is(&other.world)
            }
        }

        impl std::hash::Hash for $name {
            fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
                self.id.hash(state);
            }
        }
    };
}

handle! {
    /// A body of a world: a handle. It is equal to every other handle of the same body.
    /// Setting or applying a number that is not finite or too large raises ValueError, and changes nothing.
    Body, engine::BodyId
}

handle! {
    /// A joint of a world: a handle.
    Joint, engine::JointId
}

handle! {
    /// A shape of a world: a handle.
    Shape, engine::ShapeId
}

handle! {
    /// A tile map of a world: a handle. `tiles[x, y]` is a cell.
    Tiles, engine::TileGridId
}
