//! Plays scenes on the engine's own world.

use crate::host::{Host, Player};
use crate::scene::Scene;
use crate::script::{Deed, Pull, lead_progress};
use tiny_physics::{
    Aabb, Body, BodyId, BodyMut, CharacterMover, DVec2, Error, Explosion, ForceZone, JointDef,
    JointId, MoverInput, Pose, QueryFilter, RigidBody, Rot, Settings, Shape, ShapeId, Transform,
    Vec2, Water, Wind, World, ZoneForce,
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

    fn body(&self, body: usize) -> Option<Body<'_>> {
        self.body_id(body).and_then(|id| self.world.body(id))
    }

    fn body_mut(&mut self, body: usize) -> Option<BodyMut<'_>> {
        self.body_id(body).and_then(|id| self.world.body_mut(id))
    }

    /// Does what is done to a place; `None` for what is done to a body.
    fn act_on_place(&mut self, deed: &Deed, dt: f32) -> Option<()> {
        let all = QueryFilter::new();
        match *deed {
            Deed::Explode { center, radius, falloff, impulse_per_metre } => {
                let center = center.into();
                let blast = Explosion { center, radius, falloff, impulse_per_metre };
                self.world.explode(&blast, &all);
            }
            Deed::Water { surface, between, density, flow } => {
                let area = between.map(|(left, right)| Aabb {
                    min: Vec2::new(left, f32::MIN),
                    max: Vec2::new(right, f32::MAX),
                });
                let surface = DVec2::new(0.0, surface.into());
                let water = Water { surface, density, flow, area, ..Water::default() };
                self.world.apply_water(&water, &all, dt);
            }
            Deed::Zone { shape, position, force } => {
                let pose = Pose::new(position.into(), Rot::IDENTITY);
                let force = match force {
                    Pull::Along(acceleration) => ZoneForce::Acceleration(acceleration),
                    Pull::Inwards(acceleration) => {
                        ZoneForce::Attraction { center: position.into(), acceleration }
                    }
                    Pull::Slow(linear, angular) => ZoneForce::Damping { linear, angular },
                };
                self.world.apply_zone(&ForceZone { shape, pose, force, wakes: true }, &all, dt);
            }
            _ => return None,
        }
        Some(())
    }

    /// Does what is done to a body; nothing where it has been removed.
    fn act_on_body(&mut self, deed: &Deed, time: f32, dt: f32) -> Result<(), Error> {
        match *deed {
            Deed::SetVelocity { body, velocity, angular_velocity } => {
                let Some(mut body) = self.body_mut(body) else { return Ok(()) };
                body.set_velocity(velocity);
                body.set_angular_velocity(angular_velocity);
            }
            Deed::SetKind { body, kind } => {
                let Some(mut body) = self.body_mut(body) else { return Ok(()) };
                body.set_kind(kind);
            }
            Deed::SetShape { body, shape } => {
                let first = self.shapes_of(body).first().copied();
                let Some(mut first) = first.and_then(|id| self.world.shape_mut(id)) else {
                    return Ok(());
                };
                first.set_shape(shape)?;
            }
            Deed::SetMaterial { body, material } => {
                for id in self.shapes_of(body) {
                    let shape = self.world.shape_mut(id);
                    shape.map_or(Ok(()), |mut shape| shape.set_material(material))?;
                }
            }
            Deed::Lead { body, from, to, turn, period } => {
                let done = lead_progress(time + dt, period);
                let target = Transform::from_angle(from + (to - from) * done, turn * done);
                let Some(mut body) = self.body_mut(body) else { return Ok(()) };
                body.set_target(target, dt);
            }
            Deed::Wind { body, velocity } => {
                let Some(mut body) = self.body_mut(body) else { return Ok(()) };
                body.apply_wind(&Wind { velocity, ..Wind::default() }, dt);
            }
            _ => {}
        }
        Ok(())
    }

    /// The shapes of a body in the order in which it was described.
    fn shapes_of(&self, body: usize) -> Vec<ShapeId> {
        let body = self.body(body);
        let mut shapes: Vec<ShapeId> = body.map_or(Vec::new(), |body| body.shapes().collect());
        shapes.sort_unstable_by_key(|id| id.index());
        shapes
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
        self.body(body).map_or(DVec2::ZERO, |body| body.position_f64())
    }

    fn velocity(&self, body: usize) -> Vec2 {
        self.body(body).map_or(Vec2::ZERO, |body| body.velocity())
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        if let Some(mut body) = self.body_mut(body) {
            body.set_velocity(velocity);
        }
    }

    fn set_angular_velocity(&mut self, body: usize, radians_per_second: f32) {
        if let Some(mut body) = self.body_mut(body)
            && body.as_ref().angular_velocity() != radians_per_second
        {
            body.set_angular_velocity(radians_per_second);
        }
    }

    fn move_character(&mut self, mover: &mut CharacterMover, input: MoverInput, dt: f32) {
        mover.update(&mut self.world, input, dt);
    }

    fn is_awake(&self, body: usize) -> bool {
        self.body(body).is_some_and(|body| body.is_awake())
    }

    fn wake(&mut self, body: usize) {
        if let Some(mut body) = self.body_mut(body) {
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

    fn act(&mut self, deed: &Deed, time: f32, dt: f32) {
        let result = match self.act_on_place(deed, dt) {
            Some(()) => Ok(()),
            None => self.act_on_body(deed, time, dt),
        };
        self.keep(result);
    }

    fn is_entered(&mut self, body: usize) -> bool {
        let Some(body) = self.body(body) else {
            return false;
        };
        body.shapes().any(|shape| self.world.sensor_overlaps(shape).next().is_some())
    }
}
