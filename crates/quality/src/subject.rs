//! What the suite measures on: a host of scenes that also tells how its bodies are turned.

use tiny_physics_scenes::{Host, Scene, WorldHost};

/// An engine's world, seen by the suite.
pub trait Subject: Host {
    /// Angle of a body's frame, radians; whole turns do not matter.
    fn angle(&self, body: usize) -> f64;
    /// Radians a second, anticlockwise.
    fn angular_velocity(&self, body: usize) -> f32;
}

impl Subject for WorldHost {
    fn angle(&self, body: usize) -> f64 {
        let body = self.body_id(body).and_then(|id| self.world().body(id));
        body.map_or(0.0, |body| {
            let q = body.rotation();
            f64::from(q.s).atan2(f64::from(q.c))
        })
    }

    fn angular_velocity(&self, body: usize) -> f32 {
        let body = self.body_id(body).and_then(|id| self.world().body(id));
        body.map_or(0.0, |body| body.angular_velocity())
    }
}

/// An empty world of this engine for a scene.
pub fn our_engine(scene: &Scene) -> Box<dyn Subject> {
    Box::new(WorldHost::new(scene.gravity, scene.settings))
}
