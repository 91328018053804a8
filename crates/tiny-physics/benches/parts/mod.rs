//! What the micro-benchmarks and the instruction counts measure: boxes, pairs of shapes, small worlds.
#![allow(dead_code, reason = "each benchmark uses its own part")]

use tiny_physics::{
    Aabb, BodyId, JointDef, Polygon, RigidBody, Rot, Shape, SimdLevel, Transform, Vec2, World,
};

/// The usual step, seconds.
pub const DT: f32 = 1.0 / 60.0;
/// Metres around a box in its fat box.
pub const MARGIN: f32 = 0.1;

/// Random numbers from a seed (xorshift; Marsaglia 2003).
pub struct Random(pub u64);

impl Random {
    /// From 0, below 1.
    pub fn unit(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }

    /// From `low`, below `high`.
    pub fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }
}

/// Boxes as dense as a pile: about five overlap each.
pub fn boxes(count: usize) -> Vec<Aabb> {
    let mut random = Random(88_172_645_463_325_252);
    let side = (count as f32).sqrt() * 0.8;
    let mut place = || {
        let center = Vec2::new(random.range(0.0, side), random.range(0.0, side));
        Aabb::from_center(center, Vec2::new(random.range(0.3, 0.5), random.range(0.3, 0.5)))
    };
    (0..count).map(|_| place()).collect()
}

/// The kinds of pairs that have kernels of their own.
pub const KINDS: [&str; 7] = [
    "box_box",
    "box_capsule",
    "box_circle",
    "capsule_capsule",
    "capsule_circle",
    "circle_circle",
    "polygon_polygon",
];

/// The two shapes of a kind.
pub fn shapes(kind: &str) -> (Shape, Shape) {
    let corners = [(-0.5, -0.4), (0.4, -0.5), (0.6, 0.1), (0.1, 0.5), (-0.4, 0.4)];
    let shape = |name: &str| match name {
        "box" => Shape::Polygon(Polygon::rect(0.5, 0.4).expect("a box")),
        "capsule" => {
            Shape::Capsule { a: Vec2::new(-0.3, 0.0), b: Vec2::new(0.3, 0.0), radius: 0.2 }
        }
        "circle" => Shape::Circle { radius: 0.4 },
        _ => Shape::Polygon(Polygon::hull(&corners.map(|(x, y)| Vec2::new(x, y))).expect("a hull")),
    };
    let (a, b) = kind.split_once('_').expect("two names");
    (shape(a), shape(b))
}

/// Frames of B in A in which the two shapes touch or nearly do.
pub fn places(count: usize) -> Vec<Transform> {
    let mut random = Random(7);
    let mut place = || {
        let (distance, turn) = (random.range(0.5, 1.0), random.range(-3.0, 3.0));
        let way = Rot::from_angle(random.range(-3.0, 3.0));
        Transform::new(Vec2::new(way.c, way.s) * distance, Rot::from_angle(turn))
    };
    (0..count).map(|_| place()).collect()
}

/// A world with a floor, whose bodies never sleep.
fn floor(level: SimdLevel) -> World {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    world.set_simd(level).expect("a level of this machine");
    world.settings.sleep = false;
    let ground = Shape::Aabb { half_extents: Vec2::new(200.0, 1.0) };
    world.add_body(RigidBody::new(ground, Vec2::new(0.0, -1.0), 0.0)).expect("a floor");
    world
}

fn drop_at(world: &mut World, shape: Shape, x: f32, y: f32) -> BodyId {
    let body = RigidBody::dynamic().position(Vec2::new(x, y)).shape(shape);
    world.add_body(body).expect("a sound body")
}

fn settle(world: &mut World, steps: usize) {
    (0..steps).for_each(|_| world.step(DT));
}

/// A pyramid of so many rows, at rest.
pub fn pyramid(rows: usize, level: SimdLevel) -> World {
    let mut world = floor(level);
    let (stone, _) = shapes("box_box");
    for row in 0..rows {
        for column in 0..rows - row {
            let x = column as f32 + 0.5 * row as f32 - 0.5 * rows as f32;
            drop_at(&mut world, stone, x, 0.4 + 0.8 * row as f32);
        }
    }
    settle(&mut world, 30);
    world
}

/// Every kind of shape in a heap between walls, at rest.
pub fn heap(count: usize, level: SimdLevel) -> World {
    let mut world = floor(level);
    let width = (count as f32).sqrt() * 0.6;
    let wall = Shape::Aabb { half_extents: Vec2::new(1.0, 4.0 * width) };
    for x in [-width - 1.0, width + 1.0] {
        world.add_body(RigidBody::new(wall, Vec2::new(x, 4.0 * width), 0.0)).expect("a wall");
    }
    let (mut random, mut y) = (Random(3), 0.5);
    let mut x = 1.0 - width;
    for i in 0..count {
        let (shape, _) =
            shapes(["box_box", "capsule_circle", "circle_circle", "polygon_polygon"][i % 4]);
        drop_at(&mut world, shape, x + random.range(-0.1, 0.1), y);
        x += 1.2;
        if x > width - 1.0 {
            (x, y) = (1.0 - width, y + 1.1);
        }
    }
    settle(&mut world, 120);
    world
}

/// A net of hinges that hangs from its upper row; nothing touches.
pub fn net(side: usize, level: SimdLevel) -> World {
    let mut world = floor(level);
    let mut knots: Vec<BodyId> = Vec::new();
    for i in 0..side * side {
        let (row, column) = (i / side, i % side);
        let fixed = row == 0 && column % 8 == 0;
        let body = if fixed { RigidBody::fixed() } else { RigidBody::dynamic() };
        let place = Vec2::new(column as f32, 100.0 - row as f32);
        let knot = body.position(place).shape(Shape::Circle { radius: 0.3 });
        let knot = world.add_body(knot).expect("a knot");
        let mut tie = |other: BodyId, end: Vec2| {
            let hinge = JointDef::revolute().anchors(end, -end);
            world.add_joint(other, knot, hinge).expect("a hinge");
        };
        if row > 0 {
            tie(knots[i - side], Vec2::new(0.0, -0.5));
        }
        if column > 0 {
            tie(knots[i - 1], Vec2::new(0.5, 0.0));
        }
        knots.push(knot);
    }
    settle(&mut world, 10);
    world
}
