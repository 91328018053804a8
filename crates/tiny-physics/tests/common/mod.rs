//! What the tests of the whole engine share: small scenes, and random numbers with a seed.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod sources;

use tiny_physics::{BodyId, Polygon, RigidBody, Shape, ShapeDef, Vec2, World};

/// The usual step, seconds.
pub const DT: f32 = 1.0 / 60.0;

/// A world with the article's gravity.
pub fn world() -> World {
    World::new(Vec2::new(0.0, -9.8))
}

/// A world with gravity, and a wide floor whose surface is at height 0.
pub fn world_with_floor() -> World {
    let mut world = world();
    add_floor(&mut world);
    world
}

/// Adds a wide static box whose surface is at height 0.
pub fn add_floor(world: &mut World) -> BodyId {
    let floor = RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(rect(100.0, 1.0));
    world.add_body(floor).expect("a floor")
}

/// A disk.
pub fn circle(radius: f32) -> Shape {
    Shape::Circle { radius }
}

/// A box that turns.
pub fn rect(half_width: f32, half_height: f32) -> Shape {
    Shape::Polygon(Polygon::rect(half_width, half_height).expect("positive half extents"))
}

/// A box that never turns.
pub fn upright(half_width: f32, half_height: f32) -> Shape {
    Shape::Aabb { half_extents: Vec2::new(half_width, half_height) }
}

/// A capsule around the origin, lying along x.
pub fn capsule(half_length: f32, radius: f32) -> Shape {
    Shape::Capsule { a: Vec2::new(-half_length, 0.0), b: Vec2::new(half_length, 0.0), radius }
}

/// Adds a dynamic body with one shape of the default material.
pub fn drop_at(world: &mut World, shape: impl Into<ShapeDef>, x: f32, y: f32) -> BodyId {
    let body = RigidBody::dynamic().position(Vec2::new(x, y)).shape(shape);
    world.add_body(body).expect("a sound body")
}

/// Makes a number of usual steps.
pub fn steps(world: &mut World, count: usize) {
    for _ in 0..count {
        world.step(DT);
    }
}

/// Where a body is.
pub fn position(world: &World, id: BodyId) -> Vec2 {
    world.body(id).expect("a body that is still there").position()
}

/// How fast a body is.
pub fn velocity(world: &World, id: BodyId) -> Vec2 {
    world.body(id).expect("a body that is still there").velocity()
}

/// Energy of motion and height, joules.
pub fn energy(world: &World) -> f64 {
    let of = |body: tiny_physics::Body<'_>| {
        let (v, w) = (body.velocity(), f64::from(body.angular_velocity()));
        let speed_sq = f64::from(v.x).powi(2) + f64::from(v.y).powi(2);
        let (mass, inertia) = (f64::from(body.mass()), f64::from(body.inertia()));
        let (gravity, at) = (world.gravity, body.position_f64());
        let fallen = f64::from(gravity.x) * at.x + f64::from(gravity.y) * at.y;
        0.5 * (mass * speed_sq + inertia * w * w) - mass * fallen
    };
    world.bodies().map(of).sum()
}

/// Boxes of 1 m in a pyramid on a floor.
pub fn pyramid(rows: usize) -> World {
    let mut world = world_with_floor();
    for row in 0..rows {
        for column in 0..rows - row {
            let x = column as f32 + 0.5 * row as f32 - 0.5 * rows as f32;
            drop_at(&mut world, rect(0.5, 0.5), x, 0.5 + row as f32);
        }
    }
    world
}

/// Every kind of shape that has a mass, falling into a pit.
pub fn mixed_pile(count: usize, seed: u64) -> World {
    let mut random = Random::new(seed);
    let mut world = world_with_floor();
    for x in [-6.0, 6.0] {
        let wall = RigidBody::fixed().position(Vec2::new(x, 5.0)).shape(upright(0.5, 6.0));
        world.add_body(wall).expect("a wall");
    }
    for i in 0..count {
        let (a, b) = (random.range(0.15, 0.5), random.range(0.15, 0.5));
        let shape = match random.below(4) {
            0 => circle(a),
            1 => rect(a, b),
            2 => capsule(a, b),
            _ => upright(a, b),
        };
        let bounce = random.range(0.0, 0.8);
        let material = ShapeDef::new(shape).friction(random.range(0.0, 1.0)).restitution(bounce);
        let place = Vec2::new(random.range(-5.0, 5.0), 1.0 + 0.2 * i as f32);
        let body = RigidBody::dynamic()
            .position(place)
            .angle(random.range(-3.0, 3.0))
            .velocity(Vec2::new(random.range(-3.0, 3.0), random.range(-3.0, 3.0)))
            .shape(material);
        world.add_body(body).expect("a sound body");
    }
    world
}

/// Random numbers from a seed, the same on every machine (SplitMix64; Steele, Lea, Flood 2014).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ z >> 31
    }

    /// A whole number from 0, below `end`.
    pub fn below(&mut self, end: u64) -> u64 {
        self.word() % end
    }

    /// A number from `low`, below `high`.
    pub fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * ((self.word() >> 40) as f32 / 16_777_216.0)
    }
}
