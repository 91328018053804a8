//! The engine's world as a host for scenes.

use tiny_physics::{BodyId, DVec2, Error, JointDef, JointId, RigidBody, Vec2, World};
use tiny_physics_scenes::Host;

/// A world and the handles behind the numbers that a scene uses.
pub struct Engine {
    /// The world.
    pub world: World,
    bodies: Vec<Option<BodyId>>,
    joints: Vec<Option<JointId>>,
    refused: Option<Error>,
}

impl Engine {
    /// A host around an empty world.
    pub fn new(world: World) -> Self {
        Self { world, bodies: Vec::new(), joints: Vec::new(), refused: None }
    }

    /// Has the world taken everything so far?
    ///
    /// # Errors
    /// The first body or joint that it refused, in its words.
    pub fn check(&self) -> Result<(), Error> {
        self.refused.clone().map_or(Ok(()), Err)
    }

    fn id(&self, body: usize) -> Option<BodyId> {
        self.bodies.get(body).copied().flatten()
    }

    /// Keeps the first error; the number then stands for nothing.
    fn accept<T>(&mut self, result: Result<T, Error>) -> Option<T> {
        result.map_err(|error| self.refused.get_or_insert(error)).ok()
    }
}

impl Host for Engine {
    fn add_body(&mut self, body: &RigidBody) -> usize {
        let added = self.world.add_body(body.clone());
        let id = self.accept(added);
        self.bodies.push(id);
        self.bodies.len() - 1
    }

    fn remove_body(&mut self, body: usize) {
        if let Some(id) = self.bodies.get_mut(body).and_then(Option::take) {
            let removed = self.world.remove_body(id);
            self.accept(removed);
        }
    }

    fn add_joint(&mut self, a: usize, b: usize, def: &JointDef) -> usize {
        let id = match (self.id(a), self.id(b)) {
            (Some(a), Some(b)) => {
                let added = self.world.add_joint(a, b, *def);
                self.accept(added)
            }
            _ => None,
        };
        self.joints.push(id);
        self.joints.len() - 1
    }

    fn remove_joint(&mut self, joint: usize) {
        if let Some(id) = self.joints.get_mut(joint).and_then(Option::take) {
            // Gone already where one of its bodies has been removed.
            let _ = self.world.remove_joint(id);
        }
    }

    fn position(&self, body: usize) -> DVec2 {
        let body = self.id(body).and_then(|id| self.world.body(id));
        body.map_or(DVec2::ZERO, |body| body.position_f64())
    }

    fn velocity(&self, body: usize) -> Vec2 {
        let body = self.id(body).and_then(|id| self.world.body(id));
        body.map_or(Vec2::ZERO, |body| body.velocity())
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        if let Some(mut body) = self.id(body).and_then(|id| self.world.body_mut(id)) {
            body.set_velocity(velocity);
        }
    }

    fn is_awake(&self, body: usize) -> bool {
        self.id(body).and_then(|id| self.world.body(id)).is_some_and(|body| body.is_awake())
    }

    fn wake(&mut self, body: usize) {
        if let Some(mut body) = self.id(body).and_then(|id| self.world.body_mut(id)) {
            body.wake();
        }
    }

    fn step(&mut self, dt: f32) {
        self.world.step(dt);
    }
}
