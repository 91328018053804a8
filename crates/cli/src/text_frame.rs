//! The world in letters.

use crate::simulation::{Framing, Simulation};
use tiny_physics::DebugDrawOptions;
use tiny_physics_draw::TextView;

/// Draws the scene into the view: what the framing says.
pub fn draw(view: &mut TextView, simulation: &Simulation, framing: &Framing) {
    view.begin(framing.min, framing.max);
    let options = DebugDrawOptions {
        origin: view.center(),
        joints: false,
        contacts: false,
        normals: false,
        ..DebugDrawOptions::default()
    };
    simulation.world().debug_draw(view, &options);
}
