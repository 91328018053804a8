//! The world in letters.

use crate::simulation::Simulation;
use tiny_physics::{DVec2, DebugDrawOptions};
use tiny_physics_draw::TextView;

/// Draws the scene into the view: the box from `min` to `max`.
pub fn draw(view: &mut TextView, simulation: &Simulation, (min, max): (DVec2, DVec2)) {
    view.begin(min, max);
    let options = DebugDrawOptions {
        origin: view.center(),
        joints: false,
        contacts: false,
        normals: false,
        ..DebugDrawOptions::default()
    };
    simulation.world().debug_draw(view, &options);
}
