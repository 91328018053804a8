//! What happened in a world, for plots: where its bodies were, again and again.

use crate::Engine;
use crate::protocol::{Outline, Tape};
use std::cell::RefCell;
use std::f32::consts::TAU;
use std::rc::Rc;
use tiny_physics::{DVec2, JointDef, RigidBody, Shape, ShapeDef, Transform, Vec2};
use tiny_physics_quality::Subject;
use tiny_physics_scenes::{Host, Scene};

/// An engine whose bodies are looked at every few steps.
pub struct Recorder<E> {
    engine: E,
    every: u32,
    steps: u32,
    tape: Tape,
    /// Where the tape goes in the end.
    tapes: Rc<RefCell<Vec<Tape>>>,
}

impl<E: Engine> Recorder<E> {
    /// Records an engine's empty world of `scene` at its start and after each `every` steps.
    pub fn new(engine: E, scene: &Scene, every: u32, tapes: Rc<RefCell<Vec<Tape>>>) -> Self {
        let every = every.max(1);
        let seconds = f64::from(scene.dt) * f64::from(every);
        let tape = Tape { seconds, ..Tape::default() };
        Self { engine, every, steps: 0, tape, tapes }
    }

    fn look(&mut self) {
        let pose = |body: usize| {
            let place = self.engine.position(body);
            let pose = [place.x, place.y, self.engine.angle(body)].map(|number| number as f32);
            pose.iter().all(|number| number.is_finite()).then_some(pose)
        };
        let frame = (0..self.tape.bodies.len()).map(pose).collect();
        self.tape.frames.push(frame);
    }
}

impl<E> Drop for Recorder<E> {
    fn drop(&mut self) {
        self.tapes.borrow_mut().push(std::mem::take(&mut self.tape));
    }
}

impl<E: Engine> Subject for Recorder<E> {
    fn angle(&self, body: usize) -> f64 {
        self.engine.angle(body)
    }

    fn angular_velocity(&self, body: usize) -> f32 {
        self.engine.angular_velocity(body)
    }
}

impl<E: Engine> Host for Recorder<E> {
    fn add_body(&mut self, body: &RigidBody) -> usize {
        self.tape.bodies.push(body.shapes.iter().map(outline).collect());
        self.engine.add_body(body)
    }

    fn remove_body(&mut self, body: usize) {
        self.engine.remove_body(body);
    }

    fn add_joint(&mut self, a: usize, b: usize, def: &JointDef) -> usize {
        self.engine.add_joint(a, b, def)
    }

    fn remove_joint(&mut self, joint: usize) {
        self.engine.remove_joint(joint);
    }

    fn position(&self, body: usize) -> DVec2 {
        self.engine.position(body)
    }

    fn velocity(&self, body: usize) -> Vec2 {
        self.engine.velocity(body)
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        self.engine.set_velocity(body, velocity);
    }

    fn set_angular_velocity(&mut self, body: usize, radians_per_second: f32) {
        self.engine.set_angular_velocity(body, radians_per_second);
    }

    fn apply_force(&mut self, body: usize, newtons: Vec2) {
        self.engine.apply_force(body, newtons);
    }

    fn is_awake(&self, body: usize) -> bool {
        self.engine.is_awake(body)
    }

    fn wake(&mut self, body: usize) {
        self.engine.wake(body);
    }

    fn step(&mut self, dt: f32) {
        if self.steps == 0 {
            self.look();
        }
        self.engine.step(dt);
        self.steps += 1;
        if self.steps.is_multiple_of(self.every) {
            self.look();
        }
    }
}

/// The outline of a shape in its body's frame.
fn outline(def: &ShapeDef) -> Outline {
    const CORNERS: u32 = 24;
    let frame = Transform::from_angle(def.offset, def.angle);
    let at = |point: Vec2| {
        let point = frame.apply(point);
        [point.x, point.y]
    };
    let around = |center: Vec2, radius: f32, from: f32, turn: f32| {
        (0..=CORNERS).map(move |i| {
            let angle = from + turn * i as f32 / CORNERS as f32;
            at(center + Vec2::new(angle.cos(), angle.sin()) * radius)
        })
    };
    match &def.shape {
        Shape::Circle { radius } => around(Vec2::ZERO, *radius, 0.0, TAU).collect(),
        Shape::Aabb { half_extents: h } => [(-h.x, -h.y), (h.x, -h.y), (h.x, h.y), (-h.x, h.y)]
            .map(|(x, y)| at(Vec2::new(x, y)))
            .into(),
        Shape::Capsule { a, b, radius } => {
            let way = *b - *a;
            let side = way.y.atan2(way.x) + 0.25 * TAU;
            let half = 0.5 * TAU;
            around(*a, *radius, side, half).chain(around(*b, *radius, side + half, half)).collect()
        }
        Shape::Segment { a, b } => vec![at(*a), at(*b)],
        Shape::Polygon(polygon) => polygon.vertices().iter().map(|&vertex| at(vertex)).collect(),
    }
}
