//! What several things are made with.

use tiny_physics::prelude::*;

/// Length of a step, seconds.
pub const DT: f32 = 1.0 / 60.0;

/// Category of what a door stops: all that moves. Walls are not among it.
pub const MOVING: u64 = 2;

/// Something to push, which is heard when it falls.
pub fn solid(place: DVec2, shape: Shape, density: f32) -> RigidBody {
    let mut def = ShapeDef::new(shape).density(density).friction(0.5);
    (def.hit_events, def.filter.category) = (true, MOVING);
    RigidBody::dynamic().position(place).shape(def)
}
