//! A subject in which nothing moves: it tells what a row measures without playing it.

use crate::subject::Subject;
use tiny_physics::{DVec2, JointDef, RigidBody, Vec2};
use tiny_physics_scenes::{Host, Scene};

/// A world in which nothing moves, whatever the scene.
///
/// A row played on it takes no time worth speaking of, and its report has the same metrics, units and targets as on
/// any engine.
pub fn still(_: &Scene) -> Box<dyn Subject> {
    Box::new(Still { bodies: Vec::new() })
}

struct Still {
    bodies: Vec<RigidBody>,
}

impl Subject for Still {
    fn angle(&self, body: usize) -> f64 {
        self.bodies[body].angle.into()
    }

    fn angular_velocity(&self, body: usize) -> f32 {
        self.bodies[body].angular_velocity
    }
}

impl Host for Still {
    fn add_body(&mut self, body: &RigidBody) -> usize {
        self.bodies.push(body.clone());
        self.bodies.len() - 1
    }

    fn remove_body(&mut self, _: usize) {}

    fn add_joint(&mut self, _: usize, _: usize, _: &JointDef) -> usize {
        0
    }

    fn remove_joint(&mut self, _: usize) {}

    fn position(&self, body: usize) -> DVec2 {
        self.bodies[body].position
    }

    fn velocity(&self, body: usize) -> Vec2 {
        self.bodies[body].velocity
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        self.bodies[body].velocity = velocity;
    }

    fn is_awake(&self, _: usize) -> bool {
        true
    }

    fn wake(&mut self, _: usize) {}

    fn step(&mut self, _: f32) {}
}
