//! Where rows are played: it makes worlds of scenes, steps them and counts the steps.

use crate::subject::Subject;
use core::f64::consts::{PI, TAU};
use tiny_physics::geometry::MassProperties;
use tiny_physics::{
    BodyKind, DVec2, JointDef, JointKind, Pose, RigidBody, Rot, ShapeDef, Transform, Vec2, collide,
};
use tiny_physics_scenes::{Scene, SceneJoint};

/// Substeps of all engines at their defaults.
const SUBSTEPS: f64 = 4.0;

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
        let masses = scene.bodies.iter().map(mass_of).collect();
        let gone = vec![false; bodies.len()];
        Trial { host, bodies, masses, gone, scene, steps: 0 }
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
    masses: Vec<MassProperties>,
    gone: Vec<bool>,
    scene: Scene,
    steps: u64,
}

/// Mass, centre and moment of inertia of a dynamic body; nothing of others, which no force moves.
/// Are two shapes solid for each other?
fn are_solid(a: &ShapeDef, b: &ShapeDef) -> bool {
    !a.sensor && !b.sensor && a.filter.collides(&b.filter)
}

fn mass_of(body: &RigidBody) -> MassProperties {
    if body.kind != BodyKind::Dynamic {
        return MassProperties::default();
    }
    let part = |def: &ShapeDef| {
        let frame = Transform::from_angle(def.offset, def.angle);
        def.shape.mass_properties(def.material.density).transformed(frame)
    };
    let all = MassProperties::combined(&body.shapes.iter().map(part).collect::<Vec<_>>());
    body.mass.map_or(all, |mass| all.with_mass(mass))
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

    /// Sets the angular velocity, radians a second.
    pub fn set_angular_velocity(&mut self, body: usize, radians_per_second: f32) {
        self.host.set_angular_velocity(self.bodies[body], radians_per_second);
    }

    /// Pushes a body's centre of mass during the next step, newtons.
    pub fn push(&mut self, body: usize, force: Vec2) {
        self.host.apply_force(self.bodies[body], force);
    }

    /// Adds a body on the way; its place in the scene.
    pub fn add_body(&mut self, body: RigidBody) -> usize {
        self.bodies.push(self.host.add_body(&body));
        self.masses.push(mass_of(&body));
        self.gone.push(false);
        self.scene.body(body)
    }

    /// Removes a body on the way, and its joints; the places of others stay.
    pub fn remove_body(&mut self, body: usize) {
        if self.is_there(body) {
            self.host.remove_body(self.bodies[body]);
            self.gone[body] = true;
        }
    }

    /// Is the body still there?
    pub fn is_there(&self, body: usize) -> bool {
        !self.gone[body]
    }

    /// Adds a joint on the way; its place in the scene.
    pub fn add_joint(&mut self, a: usize, b: usize, def: JointDef) -> usize {
        self.host.add_joint(self.bodies[a], self.bodies[b], &def);
        self.scene.joint(a, b, def)
    }

    /// Bodies, all kinds together: they go by 0 up to this.
    #[allow(clippy::len_without_is_empty, reason = "a scene is never empty")]
    pub fn len(&self) -> usize {
        self.bodies.len()
    }

    /// Has it no bodies?
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Dynamic bodies that are there, by their places in the scene.
    pub fn dynamic(&self) -> Vec<usize> {
        let is_dynamic = |&body: &usize| {
            self.is_there(body) && self.scene.bodies[body].kind == BodyKind::Dynamic
        };
        (0..self.len()).filter(is_dynamic).collect()
    }

    /// Is the body awake?
    pub fn is_awake(&self, body: usize) -> bool {
        self.host.is_awake(self.bodies[body])
    }

    /// Does every dynamic body sleep?
    pub fn sleeps(&self) -> bool {
        !self.dynamic().into_iter().any(|body| self.is_awake(body))
    }

    /// Kilograms; 0 for what no force moves.
    pub fn mass(&self, body: usize) -> f64 {
        self.masses[body].mass.into()
    }

    /// Energy of motion, turning included, joules.
    pub fn kinetic_energy(&self) -> f64 {
        let of = |body: usize| {
            let (speed, spin) = (self.speed(body), self.angular_velocity(body));
            let inertia = f64::from(self.masses[body].inertia);
            0.5 * (self.mass(body) * speed * speed + inertia * spin * spin)
        };
        self.dynamic().into_iter().map(of).sum()
    }

    /// Energy of height in the scene's gravity, each body's share of it included, joules; of where bodies were that many
    /// seconds ago.
    fn height_energy(&self, ago: f64) -> f64 {
        let g = self.scene.gravity;
        let of = |body: usize| {
            let center = self.point(body, self.masses[body].center);
            let place = center - DVec2::from(self.velocity(body)) * ago;
            let scale = f64::from(self.scene.bodies[body].gravity_scale);
            -self.mass(body) * scale * (f64::from(g.x) * place.x + f64::from(g.y) * place.y)
        };
        self.dynamic().into_iter().map(of).sum()
    }

    /// Energy of motion and height, joules.
    ///
    /// In all these engines a substep changes velocities first and moves bodies by the new ones, so that positions are half a
    /// substep ahead: that is set back, else a pendulum seems to gain and lose with the direction in which it swings.
    pub fn energy(&self) -> f64 {
        let ahead = 0.5 * f64::from(self.scene.dt) / SUBSTEPS;
        self.kinetic_energy() + self.height_energy(ahead)
    }

    /// The same, or without setting back if that is less: what is divided more finely is less far ahead.
    pub fn least_energy(&self) -> f64 {
        self.energy().min(self.kinetic_energy() + self.height_energy(0.0))
    }

    /// Root mean square of the speeds of some bodies, metres a second.
    pub fn rms_speed(&self, bodies: &[usize]) -> f64 {
        let sum: f64 = bodies.iter().map(|&body| self.speed(body).powi(2)).sum();
        (sum / bodies.len().max(1) as f64).sqrt()
    }

    /// Speed of the fastest of some bodies, metres a second.
    pub fn fastest(&self, bodies: &[usize]) -> f64 {
        greatest(bodies.iter().map(|&body| self.speed(body)))
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

    /// How deep any shapes of two bodies overlap, metres; 0 where they do not.
    pub fn overlap(&self, a: usize, b: usize) -> f64 {
        let pose = |body: usize, def: &ShapeDef| {
            let (s, c) = (self.angle(body) + f64::from(def.angle)).sin_cos();
            Pose::new(self.point(body, def.offset), Rot { c: c as f32, s: s as f32 })
        };
        let depth = |def_a: &ShapeDef, def_b: &ShapeDef| {
            let between = pose(b, def_b).relative_to(pose(a, def_a));
            let manifold = collide(&def_a.shape, &def_b.shape, between, 0.0);
            manifold.deepest().map_or(0.0, |point| -f64::from(point.separation))
        };
        greatest(self.solid_pairs(a, b).map(|(a, b)| depth(a, b)))
    }

    /// The shapes of two bodies that are solid for each other.
    pub(crate) fn solid_pairs(
        &self,
        a: usize,
        b: usize,
    ) -> impl Iterator<Item = (&ShapeDef, &ShapeDef)> {
        let (shapes_a, shapes_b) = (&self.scene.bodies[a].shapes, &self.scene.bodies[b].shapes);
        let pairs = shapes_a.iter().flat_map(|a| shapes_b.iter().map(move |b| (a, b)));
        pairs.filter(|(a, b)| are_solid(a, b))
    }

    /// Do their kinds, filters and joints let two bodies collide?
    pub fn collides(&self, a: usize, b: usize) -> bool {
        let joined = |joint: &SceneJoint| {
            [(a, b), (b, a)].contains(&(joint.a, joint.b)) && !joint.def.collide_connected
        };
        let (body_a, body_b) = (&self.scene.bodies[a], &self.scene.bodies[b]);
        let moves = [body_a, body_b].iter().any(|body| body.kind == BodyKind::Dynamic);
        moves && self.solid_pairs(a, b).next().is_some() && !self.scene.joints.iter().any(joined)
    }

    /// How deep any two bodies overlap that collide, metres.
    pub fn deepest_overlap(&self) -> f64 {
        let near = |&(a, b): &(usize, usize)| {
            let (p, q) = (self.position(a), self.position(b));
            let there = self.is_there(a) && self.is_there(b);
            there && (p.x - q.x).hypot(p.y - q.y) < self.reach(a) + self.reach(b)
        };
        let pairs = (0..self.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
        let touching = pairs.filter(near).filter(|&(a, b)| self.collides(a, b));
        greatest(touching.map(|(a, b)| self.overlap(a, b)))
    }

    /// How far what a joint holds rigid is off, metres: its anchors, or B's from A's line, or the length of a rod or rope.
    pub fn joint_error(&self, joint: usize) -> f64 {
        let SceneJoint { a, b, def } = &self.scene.joints[joint];
        if !self.is_there(*a) || !self.is_there(*b) {
            return 0.0;
        }
        let gap = self.gap(joint);
        match def.kind {
            JointKind::Revolute { .. } | JointKind::Weld { linear: None, .. } => gap,
            JointKind::Prismatic { .. } | JointKind::Wheel { .. } => self.off_axis(joint).1.abs(),
            JointKind::Distance { length, spring: None, limits: None, motor: None } => {
                (gap - f64::from(length)).abs()
            }
            JointKind::Distance { limits: Some(limits), .. } => {
                (gap - f64::from(limits.upper)).max(0.0)
            }
            _ => 0.0,
        }
    }

    /// How far a hinge or slider is beyond its limits, radians or metres.
    pub fn beyond_limits(&self, joint: usize) -> f64 {
        let SceneJoint { a, b, def } = &self.scene.joints[joint];
        let (value, limits) = match def.kind {
            JointKind::Revolute { limits: Some(limits), .. } => {
                let angle = self.angle(*b) + f64::from(def.angle_b)
                    - self.angle(*a)
                    - f64::from(def.angle_a);
                ((angle + PI).rem_euclid(TAU) - PI, limits)
            }
            JointKind::Prismatic { limits: Some(limits), .. }
            | JointKind::Wheel { limits: Some(limits), .. } => (self.off_axis(joint).0, limits),
            _ => return 0.0,
        };
        if !self.is_there(*a) || !self.is_there(*b) {
            return 0.0;
        }
        (f64::from(limits.lower) - value).max(value - f64::from(limits.upper)).max(0.0)
    }

    /// Where B's anchor is along A's axis and across it, metres.
    fn off_axis(&self, joint: usize) -> (f64, f64) {
        let SceneJoint { a, b, def } = &self.scene.joints[joint];
        let (from, to) = (self.point(*a, def.anchor_a), self.point(*b, def.anchor_b));
        let (s, c) = (self.angle(*a) + f64::from(def.angle_a)).sin_cos();
        let (x, y) = (to.x - from.x, to.y - from.y);
        (c * x + s * y, c * y - s * x)
    }

    /// How far from its position a body's shapes reach at most, metres.
    pub fn reach(&self, body: usize) -> f64 {
        let of = |def: &ShapeDef| {
            let bounds = def.shape.aabb(Transform::from_angle(def.offset, def.angle));
            f64::from(bounds.min.abs().max(bounds.max.abs()).length())
        };
        greatest(self.scene.bodies[body].shapes.iter().map(of))
    }
}

/// The greatest of some numbers, 0 for none; infinite where one is no number.
pub fn greatest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |a: f64, b| if b.is_nan() { f64::INFINITY } else { a.max(b) })
}
