//! What a scene is played on: any engine that can do this little.

use crate::scene::Scene;
use crate::script::{Deed, Running};
use tiny_physics::{CharacterMover, DVec2, JointDef, MoverInput, RigidBody, Vec2};

/// An engine's world, seen by a scene and its script.
///
/// Bodies and joints go by a number of the host's choice, which stays the same until the body or joint
/// is removed. A removed body takes its joints with it. Queries have default answers ("nothing there"), deeds
/// are left undone, and characters stay where they are: a host that lacks them plays every scene all the same.
pub trait Host {
    /// Adds a body; its number.
    fn add_body(&mut self, body: &RigidBody) -> usize;
    /// Removes a body, its shapes and its joints.
    fn remove_body(&mut self, body: usize);
    /// Adds a joint between two bodies; its number.
    fn add_joint(&mut self, a: usize, b: usize, def: &JointDef) -> usize;
    /// Removes a joint.
    fn remove_joint(&mut self, joint: usize);
    /// Position of a body's frame, metres in the world.
    fn position(&self, body: usize) -> DVec2;
    /// Velocity of a body's centre of mass, metres a second.
    fn velocity(&self, body: usize) -> Vec2;
    /// Sets that velocity and wakes the body.
    fn set_velocity(&mut self, body: usize, velocity: Vec2);
    /// Sets its angular velocity, radians a second.
    fn set_angular_velocity(&mut self, _body: usize, _radians_per_second: f32) {}
    /// Pushes its centre of mass during the next step, newtons, and wakes it.
    fn apply_force(&mut self, _body: usize, _newtons: Vec2) {}
    /// Is the body awake?
    fn is_awake(&self, body: usize) -> bool;
    /// Wakes a body and its island.
    fn wake(&mut self, body: usize);
    /// Steps the world by `dt` seconds.
    fn step(&mut self, dt: f32);

    /// Moves a character on by `dt` seconds, after a step.
    fn move_character(&mut self, _mover: &mut CharacterMover, _input: MoverInput, _dt: f32) {}

    /// Fraction of `translation`, 0 to 1, at which a ray first meets a shape with a category in `mask`.
    fn ray_cast(&mut self, _origin: Vec2, _translation: Vec2, _mask: u64) -> Option<f32> {
        None
    }

    /// The same for a moving circle.
    fn circle_cast(
        &mut self,
        _center: Vec2,
        _radius: f32,
        _translation: Vec2,
        _mask: u64,
    ) -> Option<f32> {
        None
    }

    /// How many shapes with a category in `mask` have a box that overlaps this one.
    fn count_overlaps(&mut self, _lower: Vec2, _upper: Vec2, _mask: u64) -> usize {
        0
    }

    /// Does what a timeline asks for before the next step, which begins at `time` and is `dt` long, seconds. As it is
    /// given here, it sets velocities and leaves every other deed undone.
    fn act(&mut self, deed: &Deed, _time: f32, _dt: f32) {
        if let Deed::SetVelocity { body, velocity, angular_velocity } = *deed {
            self.set_velocity(body, velocity);
            self.set_angular_velocity(body, angular_velocity);
        }
    }

    /// Does a sensor of this body see anything?
    fn is_entered(&mut self, _body: usize) -> bool {
        false
    }
}

/// A scene that runs on a host.
///
/// ```
/// # use tiny_physics::{DVec2, JointDef, RigidBody, Vec2};
/// # use tiny_physics_scenes::{Host, Options, Player, find};
/// # #[derive(Default)] struct MyEngine { bodies: usize }
/// # impl Host for MyEngine {
/// #     fn add_body(&mut self, _: &RigidBody) -> usize { self.bodies += 1; self.bodies - 1 }
/// #     fn remove_body(&mut self, _: usize) {}
/// #     fn add_joint(&mut self, _: usize, _: usize, _: &JointDef) -> usize { 0 }
/// #     fn remove_joint(&mut self, _: usize) {}
/// #     fn position(&self, _: usize) -> DVec2 { DVec2::ZERO }
/// #     fn velocity(&self, _: usize) -> Vec2 { Vec2::ZERO }
/// #     fn set_velocity(&mut self, _: usize, _: Vec2) {}
/// #     fn is_awake(&self, _: usize) -> bool { true }
/// #     fn wake(&mut self, _: usize) {}
/// #     fn step(&mut self, _: f32) {}
/// # }
/// let scene = find("domino").unwrap().build(Options::default());
/// let mut player = Player::new(&scene, MyEngine::default());
/// while !player.is_done() {
///     player.step();
/// }
/// ```
#[derive(Clone, Debug)]
pub struct Player<H> {
    host: H,
    bodies: Vec<usize>,
    joints: Vec<usize>,
    running: Option<Running>,
    steps_done: u32,
    steps: u32,
    dt: f32,
}

impl<H: Host> Player<H> {
    /// Adds everything in the scene to the host, bodies first. The host must be empty and have the scene's
    /// gravity and settings.
    ///
    /// A scene that [`Scene::check`] refuses is the host's trouble; joints and scripts that point at bodies
    /// that are not there are left out.
    pub fn new(scene: &Scene, mut host: H) -> Self {
        let bodies: Vec<usize> = scene.bodies.iter().map(|b| host.add_body(b)).collect();
        let ends = |i: usize| bodies.get(i).copied();
        let mut joints = Vec::with_capacity(scene.joints.len());
        for joint in &scene.joints {
            if let (Some(a), Some(b)) = (ends(joint.a), ends(joint.b)) {
                joints.push(host.add_joint(a, b, &joint.def));
            }
        }
        let running = scene.script.as_ref().map(|script| script.start(&bodies, scene.dt));
        Self { host, bodies, joints, running, steps_done: 0, steps: scene.steps, dt: scene.dt }
    }

    /// Lets the script act, then steps the host.
    pub fn step(&mut self) {
        self.before_step();
        self.host.step(self.dt);
    }

    /// Lets only the script act and counts the step: for a caller that steps the host by itself, once
    /// after each call.
    pub fn before_step(&mut self) {
        if let Some(running) = &mut self.running {
            running.before_step(&mut self.host, self.steps_done);
        }
        self.steps_done = self.steps_done.saturating_add(1);
    }
}

impl<H> Player<H> {
    /// Has the scene run for all its steps? It can go on.
    pub fn is_done(&self) -> bool {
        self.steps_done >= self.steps
    }

    /// Steps made so far.
    pub fn steps_done(&self) -> u32 {
        self.steps_done
    }

    /// Length of a step, seconds.
    pub fn dt(&self) -> f32 {
        self.dt
    }

    /// The host's number of each body of the scene, in the scene's order.
    pub fn bodies(&self) -> &[usize] {
        &self.bodies
    }

    /// The host's number of each joint of the scene.
    pub fn joints(&self) -> &[usize] {
        &self.joints
    }

    /// The host.
    pub fn host(&self) -> &H {
        &self.host
    }

    /// The host, to act on.
    pub fn host_mut(&mut self) -> &mut H {
        &mut self.host
    }

    /// The host, for good.
    pub fn into_host(self) -> H {
        self.host
    }

    /// Goes on playing on what is made of the host.
    pub(crate) fn map<G>(self, change: impl FnOnce(H) -> G) -> Player<G> {
        let Self { host, bodies, joints, running, steps_done, steps, dt } = self;
        Player { host: change(host), bodies, joints, running, steps_done, steps, dt }
    }
}
