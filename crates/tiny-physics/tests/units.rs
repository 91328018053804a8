//! Random worlds take the same course in every unit of length: in units that are powers of two bit for bit.

mod common;

use common::Random;
use tiny_physics::{BodyId, JointDef, Polygon, RigidBody, Settings, Shape, ShapeDef, Vec2, World};

/// Poses of all bodies in units, velocities in units a second.
type Frame = Vec<[f64; 7]>;

/// A random world whose lengths are times `unit`, and whose densities are `density`.
struct Builder {
    random: Random,
    unit: f32,
    density: f32,
    world: World,
    bodies: Vec<BodyId>,
}

impl Builder {
    fn at(&self, x: f32, y: f32) -> Vec2 {
        Vec2::new(x * self.unit, y * self.unit)
    }

    /// A number that has few bits, so that times a power of two loses none of them.
    fn range(&mut self, low: f32, high: f32) -> f32 {
        (self.random.range(low, high) * 1024.0).round() / 1024.0
    }

    fn shape(&mut self) -> ShapeDef {
        let (w, h) = (self.range(0.06, 0.6), self.range(0.06, 0.6));
        let (width, height) = (w * self.unit, h * self.unit);
        let shape = match self.random.below(5) {
            0 => Shape::circle(width).unwrap(),
            1 => Shape::Capsule {
                a: Vec2::new(-width, 0.0),
                b: Vec2::new(width, 0.0),
                radius: 0.5 * height,
            },
            2 => {
                let corners = [self.at(-w, -h), self.at(w, -h), self.at(0.25 * w, h)];
                Polygon::hull(&corners).unwrap().into()
            }
            _ => Shape::rect(width, height).unwrap(),
        };
        let restitution = [0.0, 0.0, 0.25, 0.75][self.random.below(4) as usize];
        let rolling = [0.0, 0.0, 0.125][self.random.below(3) as usize];
        let shape = ShapeDef::new(shape).density(self.density);
        shape.restitution(restitution).rolling_resistance(rolling)
    }

    fn thing(&mut self, x: f32, y: f32) -> BodyId {
        let (angle, spin) = (self.range(0.0, 6.0), self.range(-20.0, 20.0));
        let (vx, vy) = (self.range(-15.0, 15.0), self.range(-15.0, 15.0));
        let place = self.at(x, y);
        let velocity = self.at(vx, vy);
        let shape = self.shape();
        let mut body = RigidBody::dynamic().position(place).angle(angle).shape(shape);
        if self.random.below(4) == 0 {
            let offset = self.at(0.25, 0.125);
            body = body.shape(self.shape().offset(offset));
        }
        let id = self.world.add_body(body.velocity(velocity).angular_velocity(spin)).unwrap();
        self.bodies.push(id);
        id
    }

    /// A box of tiles or of slabs.
    fn ground(&mut self) {
        if self.random.below(2) == 0 {
            for i in 0..24 {
                let tile = Shape::rect(0.5 * self.unit, 0.5 * self.unit).unwrap();
                let place = self.at(-11.5 + i as f32, -0.5);
                self.world.add_body(RigidBody::fixed().position(place).shape(tile)).unwrap();
            }
        } else {
            let slab = Shape::rect(12.0 * self.unit, 0.5 * self.unit).unwrap();
            let place = self.at(0.0, -0.5);
            self.world.add_body(RigidBody::fixed().position(place).shape(slab)).unwrap();
        }
        for x in [-12.25, 12.25] {
            let wall = Shape::rect(0.25 * self.unit, 8.0 * self.unit).unwrap();
            let place = self.at(x, 7.0);
            self.world.add_body(RigidBody::fixed().position(place).shape(wall)).unwrap();
        }
    }

    fn machine(&mut self) {
        let spin = self.range(-12.0, 12.0);
        let bar = Shape::rect(2.0 * self.unit, 0.125 * self.unit).unwrap();
        let place = self.at(-6.0, 3.0);
        let machine = RigidBody::kinematic().position(place).shape(bar).angular_velocity(spin);
        self.world.add_body(machine).unwrap();
    }

    fn chain(&mut self, x: f32) {
        let (unit, links) = (self.unit, 2 + self.random.below(6) as usize);
        let (force, torque) = (self.density * unit.powi(3), self.density * unit.powi(4));
        let kind = self.random.below(9);
        let mut above: Option<BodyId> = None;
        for i in 0..links {
            let y = 4.0 + self.random.below(4) as f32;
            let link = self.thing(x + 0.75 * i as f32, y);
            if let Some(above) = above {
                let def = match kind {
                    0 => JointDef::revolute(),
                    1 => JointDef::revolute().limits(-0.5, 0.75),
                    2 => JointDef::distance(0.75 * unit).spring(3.0, 0.25),
                    3 => JointDef::weld(),
                    4 => JointDef::prismatic(Vec2::Y).limits(-0.5 * unit, 0.25 * unit),
                    5 => JointDef::wheel(Vec2::Y).spring(4.0, 0.5),
                    6 => JointDef::rope(0.75 * unit),
                    7 => JointDef::friction(2.0 * force, 0.5 * torque),
                    _ => JointDef::revolute().motor(4.0, 2.0 * torque),
                };
                let anchors = (self.at(0.375, 0.0), self.at(-0.375, 0.0));
                self.world.add_joint(above, link, def.anchors(anchors.0, anchors.1)).unwrap();
            }
            above = Some(link);
        }
    }

    fn frame(&self) -> Frame {
        let unit = f64::from(self.unit);
        let of = |&id: &BodyId| {
            let body = self.world.body(id).unwrap();
            let (pose, v) = (body.pose(), body.velocity());
            let (x, y) = (f64::from(v.x) / unit, f64::from(v.y) / unit);
            let w = f64::from(body.angular_velocity());
            let (c, s) = (f64::from(pose.q.c), f64::from(pose.q.s));
            [pose.p.x / unit, pose.p.y / unit, c, s, x, y, w]
        };
        self.bodies.iter().map(of).collect()
    }
}

/// The frames of a random world.
fn course(seed: u64, [unit, density]: [f32; 2], steps: usize) -> Vec<Frame> {
    let settings = Settings { length_unit: unit, ..Settings::default() };
    let world = World::with_settings(Vec2::new(0.0, -10.0 * unit), settings);
    let mut builder =
        Builder { random: Random::new(seed), unit, density, world, bodies: Vec::new() };
    builder.ground();
    if builder.random.below(2) == 0 {
        builder.machine();
    }
    for i in 0..8 + builder.random.below(16) {
        builder.thing(-9.0 + 1.5 * (i % 12) as f32, 1.5 + 2.0 * (i / 12) as f32);
    }
    for i in 0..builder.random.below(3) {
        builder.chain(-8.0 + 8.0 * i as f32);
    }
    let run = |_| {
        builder.world.step(common::DT);
        builder.frame()
    };
    (0..steps).map(run).collect()
}

/// Is a velocity nearly nothing? It has fewer bits in one unit than in another, or none, and so has the separation of what touches
/// by it: whether that is above 0 may differ.
fn nearly_nothing(frame: &Frame) -> bool {
    frame.iter().flat_map(|body| &body[4..]).any(|speed| *speed != 0.0 && speed.abs() < 1e-30)
}

/// How the courses of random worlds differ in other units of length, or of mass.
fn parted(seeds: core::ops::Range<u64>, units: [[f32; 2]; 2]) -> Vec<String> {
    let (mut parted, mut excused) = (Vec::new(), 0);
    for seed in seeds {
        let first = course(seed, [1.0, 1.0], 180);
        for unit in units {
            let other = course(seed, unit, 180);
            // What is nearly nothing has fewer bits in one unit than in another.
            let some = |value: f64| if value.abs() < 1e-20 { 0.0 } else { value };
            let differs = |a: &Frame, b: &Frame| {
                (0..a.len()).find(|&i| (0..7).any(|k| some(a[i][k]) != some(b[i][k])))
            };
            let mut steps = first.iter().zip(&other);
            let Some(step) = steps.position(|(a, b)| differs(a, b).is_some()) else { continue };
            let (a, b) = (&first[step], &other[step]);
            let before = step.saturating_sub(1);
            if nearly_nothing(&first[before]) || nearly_nothing(&other[before]) {
                excused += 1;
                continue;
            }
            let body = differs(a, b).unwrap();
            parted.push(format!(
                "seed {seed}, units {unit:?}, step {step}, body {body}: {:?} and {:?}",
                a[body], b[body]
            ));
        }
    }
    assert!(excused <= 2, "{excused} worlds differ where something is nearly nothing");
    parted
}

#[test]
fn random_worlds_keep_all_bits_in_units_of_length_that_are_powers_of_two() {
    let parted = parted(0..100, [[1.0 / 128.0, 1.0], [64.0, 1.0]]);
    assert!(parted.is_empty(), "{} part:\n{}", parted.len(), parted.join("\n"));
}

#[test]
fn random_worlds_keep_all_bits_in_units_of_mass_that_are_powers_of_two() {
    let parted = parted(0..100, [[1.0, 1.0 / 1024.0], [1.0, 4096.0]]);
    assert!(parted.is_empty(), "{} part:\n{}", parted.len(), parted.join("\n"));
}
