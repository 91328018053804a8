//! A scene that is being played: its bodies and joints in a host, its script before each step.

use crate::host::Host;
use crate::scene::Scene;
use crate::script::Running;

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
