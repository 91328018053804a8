//! Where rows are played: it makes worlds of scenes, steps them and counts the steps.

use crate::subject::Subject;
use tiny_physics::{DVec2, Pose, Rot, Vec2, collide};
use tiny_physics_scenes::Scene;

/// Makes the empty world of an engine for a scene.
pub type MakeSubject<'a> = &'a dyn Fn(&Scene) -> Box<dyn Subject>;

/// Which form of a row is played.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Variant {
    /// The one that the row's numbers are known for.
    Usual,
    /// One of another size, mass, angle or speed.
    Other,
}

/// What a row is played with.
pub struct Lab<'a> {
    make: MakeSubject<'a>,
    variant: Variant,
    awake: bool,
    progress: &'a mut dyn FnMut(u64, u64),
    done: u64,
    total: u64,
}

impl<'a> Lab<'a> {
    /// A lab for one row. `progress` is told of steps done and steps expected.
    pub fn new(
        make: MakeSubject<'a>,
        (variant, awake): (Variant, bool),
        progress: &'a mut dyn FnMut(u64, u64),
    ) -> Self {
        Self { make, variant, awake, progress, done: 0, total: 0 }
    }

    /// Lets the bodies of a scene fall asleep where the engine thinks fit, unless all has to stay awake.
    pub fn may_sleep(&self, scene: &mut Scene) {
        scene.bodies.iter_mut().for_each(|body| body.can_sleep = !self.awake);
    }

    /// The first value for the usual variant, the second for the other.
    pub fn pick<T>(&self, usual: T, other: T) -> T {
        match self.variant {
            Variant::Usual => usual,
            Variant::Other => other,
        }
    }

    /// Says how many steps are to come, for the progress bar.
    pub fn expect_seconds(&mut self, seconds: f64, dt: f32) {
        self.total += (seconds / f64::from(dt)).round() as u64;
    }

    /// A world of a scene.
    pub fn build(&mut self, scene: Scene) -> Trial {
        let mut host = (self.make)(&scene);
        let bodies: Vec<usize> = scene.bodies.iter().map(|body| host.add_body(body)).collect();
        for joint in &scene.joints {
            host.add_joint(bodies[joint.a], bodies[joint.b], &joint.def);
        }
        Trial { host, bodies, scene, steps: 0 }
    }

    /// Steps a trial once.
    pub fn step(&mut self, trial: &mut Trial) {
        trial.host.step(trial.scene.dt);
        trial.steps += 1;
        self.done += 1;
        if self.done.is_multiple_of(16) {
            (self.progress)(self.done, self.total.max(self.done));
        }
    }

    /// Steps a trial for some seconds and looks at it after each step.
    pub fn run(&mut self, trial: &mut Trial, seconds: f64, mut look: impl FnMut(&Trial)) {
        for _ in 0..steps_in(seconds, trial.scene.dt) {
            self.step(trial);
            look(trial);
        }
    }
}

/// Steps in some seconds.
fn steps_in(seconds: f64, dt: f32) -> u64 {
    (seconds / f64::from(dt)).round() as u64
}

/// A scene on an engine. Bodies go by their place in the scene.
pub struct Trial {
    host: Box<dyn Subject>,
    bodies: Vec<usize>,
    scene: Scene,
    steps: u64,
}

impl Trial {
    /// The scene that it started from.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Seconds since the start.
    pub fn time(&self) -> f64 {
        self.steps as f64 * f64::from(self.scene.dt)
    }

    /// Position of a body's frame, metres.
    pub fn position(&self, body: usize) -> DVec2 {
        self.host.position(self.bodies[body])
    }

    /// How far a body is from where it started, metres.
    pub fn moved(&self, body: usize) -> DVec2 {
        let (now, start) = (self.position(body), self.scene.bodies[body].position);
        DVec2::new(now.x - start.x, now.y - start.y)
    }

    /// Velocity of a body's centre of mass, metres a second.
    pub fn velocity(&self, body: usize) -> Vec2 {
        self.host.velocity(self.bodies[body])
    }

    /// Sets that velocity.
    pub fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        self.host.set_velocity(self.bodies[body], velocity);
    }

    /// Speed of a body, metres a second; infinite where it is no number.
    pub fn speed(&self, body: usize) -> f64 {
        let v = self.velocity(body);
        let speed = f64::from(v.x).hypot(f64::from(v.y));
        if speed.is_nan() { f64::INFINITY } else { speed }
    }

    /// Angle of a body's frame, radians in [-pi, pi].
    pub fn angle(&self, body: usize) -> f64 {
        self.host.angle(self.bodies[body])
    }

    /// Radians a second.
    pub fn angular_velocity(&self, body: usize) -> f64 {
        f64::from(self.host.angular_velocity(self.bodies[body]))
    }

    /// A point of a body's frame in the world, metres.
    pub fn point(&self, body: usize, local: Vec2) -> DVec2 {
        let (p, angle) = (self.position(body), self.angle(body));
        let (x, y) = (f64::from(local.x), f64::from(local.y));
        let (s, c) = angle.sin_cos();
        DVec2::new(p.x + c * x - s * y, p.y + s * x + c * y)
    }

    /// Distance of a joint's anchors, metres.
    pub fn gap(&self, joint: usize) -> f64 {
        let joint = &self.scene.joints[joint];
        let a = self.point(joint.a, joint.def.anchor_a);
        let b = self.point(joint.b, joint.def.anchor_b);
        (a.x - b.x).hypot(a.y - b.y)
    }

    /// Greatest distance of any joint's anchors, metres.
    pub fn widest_gap(&self) -> f64 {
        greatest((0..self.scene.joints.len()).map(|joint| self.gap(joint)))
    }

    /// Deepest overlap of two bodies that follow each other in the scene, metres: enough for towers.
    pub fn deepest_overlap_of_neighbours(&self) -> f64 {
        greatest((1..self.bodies.len()).map(|b| self.overlap(b - 1, b)))
    }

    /// How deep the first shapes of two bodies overlap, metres; 0 where they do not.
    pub fn overlap(&self, a: usize, b: usize) -> f64 {
        let pose = |body: usize| {
            let (s, c) = self.angle(body).sin_cos();
            Pose::new(self.position(body), Rot { c: c as f32, s: s as f32 })
        };
        let shape = |body: usize| &self.scene.bodies[body].shapes[0].shape;
        let manifold = collide(shape(a), shape(b), pose(b).relative_to(pose(a)), 0.0);
        manifold.deepest().map_or(0.0, |point| -f64::from(point.separation))
    }
}

/// The greatest of some numbers, 0 for none; infinite where one is no number.
pub fn greatest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |a: f64, b| if b.is_nan() { f64::INFINITY } else { a.max(b) })
}
