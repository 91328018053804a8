//! Plays scenes on the engine's own world.

use crate::host::{Host, Player};
use crate::scene::Scene;
use tiny_physics::{
    Aabb, BodyId, CharacterMover, DVec2, Error, JointDef, JointId, MoverInput, QueryFilter,
    RigidBody, Rot, Settings, Shape, Transform, Vec2, World,
};

/// A scene that runs in a [`World`].
///
/// ```
/// use tiny_physics_scenes::{Options, Run, find};
/// let scene = find("stack")?.build(Options::default());
/// let mut run = Run::start(&scene)?;
/// run.step();
/// assert_eq!(run.world().body_count(), scene.bodies.len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type Run = Player<WorldHost>;

impl Run {
    /// Makes a world of a scene.
    ///
    /// # Errors
    /// A body or joint that the world refuses.
    pub fn start(scene: &Scene) -> Result<Self, Error> {
        let run = Self::new(scene, WorldHost::new(scene.gravity, scene.settings));
        match run.host().error() {
            Some(error) => Err(error.clone()),
            None => Ok(run),
        }
    }

    /// The world.
    pub fn world(&self) -> &World {
        self.host().world()
    }

    /// The world, to act on.
    pub fn world_mut(&mut self) -> &mut World {
        self.host_mut().world_mut()
    }
}

/// A world with numbers for its bodies and joints, in the order in which they were added.
#[derive(Clone)]
pub struct WorldHost {
    world: World,
    bodies: Vec<Option<BodyId>>,
    joints: Vec<Option<JointId>>,
    error: Option<Error>,
}

impl WorldHost {
    /// An empty world.
    pub fn new(gravity: Vec2, settings: Settings) -> Self {
        let world = World::with_settings(gravity, settings);
        Self { world, bodies: Vec::new(), joints: Vec::new(), error: None }
    }

    /// The world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The world, to act on.
    pub fn world_mut(&mut self) -> &mut World {
        &mut self.world
    }

    /// The world, for good.
    pub fn into_world(self) -> World {
        self.world
    }

    /// The world's handle of a body.
    pub fn body_id(&self, body: usize) -> Option<BodyId> {
        self.bodies.get(body).copied().flatten()
    }

    /// The world's handle of a joint.
    pub fn joint_id(&self, joint: usize) -> Option<JointId> {
        self.joints.get(joint).copied().flatten()
    }

    /// The first thing that the world refused.
    pub fn error(&self) -> Option<&Error> {
        self.error.as_ref()
    }

    /// Keeps the first error.
    fn keep<T>(&mut self, result: Result<T, Error>) -> Option<T> {
        result.map_err(|error| self.error.get_or_insert(error)).ok()
    }
}

impl Host for WorldHost {
    fn add_body(&mut self, body: &RigidBody) -> usize {
        let added = self.world.add_body(body.clone());
        let id = self.keep(added);
        self.bodies.push(id);
        self.bodies.len() - 1
    }

    fn remove_body(&mut self, body: usize) {
        if let Some(id) = self.body_id(body) {
            let removed = self.world.remove_body(id);
            self.keep(removed);
            self.bodies[body] = None;
        }
    }

    fn add_joint(&mut self, a: usize, b: usize, def: &JointDef) -> usize {
        let joint = match (self.body_id(a), self.body_id(b)) {
            (Some(a), Some(b)) => {
                let added = self.world.add_joint(a, b, *def);
                self.keep(added)
            }
            _ => None,
        };
        self.joints.push(joint);
        self.joints.len() - 1
    }

    fn remove_joint(&mut self, joint: usize) {
        if let Some(id) = self.joint_id(joint) {
            let removed = self.world.remove_joint(id);
            self.keep(removed);
            self.joints[joint] = None;
        }
    }

    fn position(&self, body: usize) -> DVec2 {
        let body = self.body_id(body).and_then(|id| self.world.body(id));
        body.map_or(DVec2::ZERO, |body| body.position_f64())
    }

    fn velocity(&self, body: usize) -> Vec2 {
        let body = self.body_id(body).and_then(|id| self.world.body(id));
        body.map_or(Vec2::ZERO, |body| body.velocity())
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        if let Some(mut body) = self.body_id(body).and_then(|id| self.world.body_mut(id)) {
            body.set_velocity(velocity);
        }
    }

    fn set_angular_velocity(&mut self, body: usize, radians_per_second: f32) {
        if let Some(mut body) = self.body_id(body).and_then(|id| self.world.body_mut(id))
            && body.as_ref().angular_velocity() != radians_per_second
        {
            body.set_angular_velocity(radians_per_second);
        }
    }

    fn move_character(&mut self, mover: &mut CharacterMover, input: MoverInput, dt: f32) {
        mover.update(&mut self.world, input, dt);
    }

    fn is_awake(&self, body: usize) -> bool {
        let body = self.body_id(body).and_then(|id| self.world.body(id));
        body.is_some_and(|body| body.is_awake())
    }

    fn wake(&mut self, body: usize) {
        if let Some(mut body) = self.body_id(body).and_then(|id| self.world.body_mut(id)) {
            body.wake();
        }
    }

    fn step(&mut self, dt: f32) {
        self.world.step(dt);
    }

    fn ray_cast(&mut self, origin: Vec2, translation: Vec2, mask: u64) -> Option<f32> {
        let filter = QueryFilter::default().mask(mask);
        self.world.ray_cast(origin, translation, &filter).map(|hit| hit.fraction)
    }

    fn circle_cast(
        &mut self,
        center: Vec2,
        radius: f32,
        translation: Vec2,
        mask: u64,
    ) -> Option<f32> {
        let (shape, filter) = (Shape::Circle { radius }, QueryFilter::default().mask(mask));
        let pose = Transform::new(center, Rot::IDENTITY);
        self.world.cast_shape(&shape, pose, translation, &filter).map(|hit| hit.fraction)
    }

    fn count_overlaps(&mut self, lower: Vec2, upper: Vec2, mask: u64) -> usize {
        let filter = QueryFilter::default().mask(mask);
        self.world.overlap_aabb(Aabb { min: lower, max: upper }, &filter).len()
    }
}
