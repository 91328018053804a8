//! A level for a character: hills of slope tiles, stairs, a one-way platform, a lift, a shuttle over a pit,
//! a plate that turns, and a crate to push.

use super::Options;
use crate::scene::Scene;
use crate::script::{Character, Key, Leg, Ride, Script};
use crate::shapes;
use tiny_physics::{DVec2, Filter, RigidBody, Shape, ShapeDef, TileGrid, Vec2};

const WIDTH: usize = 64;
const HEIGHT: usize = 9;
const CHARACTER_HEIGHT: f32 = 1.8;
const CHARACTER_RADIUS: f32 = 0.3;

/// A character walks through the level by a script.
pub(crate) fn character(_: Options) -> Scene {
    let mut scene = Scene::new(
        "character",
        "A character walks over hills, stairs and platforms and pushes a crate.",
    );
    scene.gravity = Vec2::new(0.0, -10.0);
    scene.steps = 2250;
    for body in tiles().bodies() {
        scene.body(body);
    }
    scene.body(stairs());
    let mut platform = |x: f32, y: f32, half_width: f32| {
        let shape = shapes::rect(half_width, 0.1);
        scene.body(RigidBody::kinematic().position(Vec2::new(x, y)).shape(shape))
    };
    let (lift, shuttle) = (platform(36.0, 2.1, 1.0), platform(41.0, 1.9, 1.0));
    let plate = platform(51.0, 2.05, 1.5);
    let crate_ = shapes::rect(0.4, 0.4);
    scene.body(RigidBody::dynamic().position(Vec2::new(56.0, 2.4)).shape(crate_));
    let position = DVec2::new(2.0, 3.0);
    let body = scene.body(marker(position, CHARACTER_HEIGHT, CHARACTER_RADIUS));
    let script = Character {
        position,
        height: CHARACTER_HEIGHT,
        radius: CHARACTER_RADIUS,
        body,
        keys: keys(),
        rides: rides(lift, shuttle, plate),
    };
    scene.script = Some(Script::Character(script));
    scene
}

/// Four steps of 0.25 m up to the upper floor.
fn stairs() -> RigidBody {
    (1..=4).fold(RigidBody::fixed().position(Vec2::new(20.0, 2.0)), |stairs, i| {
        let (x, height) = (0.5 * i as f32 - 0.25, 0.25 * i as f32);
        let step = ShapeDef::new(shapes::rect(0.25, 0.5 * height));
        stairs.shape(step.offset(Vec2::new(x, 0.5 * height)))
    })
}

/// The body that shows the character: it collides with nothing.
pub(super) fn marker(position: DVec2, height: f32, radius: f32) -> RigidBody {
    let half = 0.5 * height - radius;
    let (a, b) = (Vec2::new(0.0, -half), Vec2::new(0.0, half));
    let shape = Shape::Capsule { a, b, radius };
    let filter = Filter { mask: 0, ..Filter::default() };
    RigidBody::kinematic().position(position).shape(ShapeDef::new(shape).filter(filter))
}

fn keys() -> Vec<Key> {
    [
        (0.0, 0.0, 0.0),
        (0.5, 4.0, 0.0),  // Over the hills and up the stairs.
        (7.0, 0.0, 8.0),  // Onto the one-way platform.
        (8.5, 4.0, 0.0),  // Down again and to the lift.
        (10.5, 0.0, 0.0), // Up and down.
        (16.5, 5.0, 0.0), // To the shuttle.
        (17.5, 0.0, 0.0),
        (19.0, 0.0, 6.0), // A jump on the way.
        (23.5, 5.0, 0.0), // To the plate.
        (24.5, 0.0, 0.0),
        (30.5, 2.0, 0.0), // Pushes the crate along.
        (34.5, -2.0, 0.0),
        (36.5, 0.0, 0.0),
    ]
    .map(|(from, walk, jump)| Key { from, walk, jump, drop: false })
    .to_vec()
}

fn rides(lift: usize, shuttle: usize, plate: usize) -> Vec<Ride> {
    let there_and_back = |body, period, [a, b, c, d]: [f32; 4], velocity, angular_velocity| {
        let out = Leg { from: a, to: b, velocity, angular_velocity };
        let back = Leg {
            from: c,
            to: d,
            velocity: Vec2::ZERO - velocity,
            angular_velocity: 0.0 - angular_velocity,
        };
        Ride { body, period, legs: vec![out, back] }
    };
    vec![
        there_and_back(lift, 10.0, [1.0, 3.0, 4.0, 6.0], Vec2::Y, 0.0),
        there_and_back(shuttle, 17.0, [1.0, 6.0, 7.0, 12.0], Vec2::X, 0.0),
        there_and_back(plate, 8.0, [1.0, 3.0, 4.0, 6.0], Vec2::ZERO, 0.2),
    ]
}

fn tiles() -> TileGrid {
    let mut rows = vec![vec!['.'; WIDTH]; HEIGHT];
    let mut put = |x: usize, y: usize, text: &str| {
        for (i, letter) in text.chars().enumerate() {
            rows[HEIGHT - 1 - y][x + i] = letter;
        }
    };
    put(0, 0, &"#".repeat(WIDTH));
    put(0, 1, &"#".repeat(40));
    put(47, 1, &"#".repeat(WIDTH - 47));
    for y in 2..HEIGHT {
        put(0, y, "#");
        put(WIDTH - 1, y, "#");
    }
    put(8, 2, "lh#####HL");
    put(12, 3, "/#\\");
    put(22, 2, "##");
    put(27, 4, "---");
    let rows: Vec<String> = rows.into_iter().map(|row| row.into_iter().collect()).collect();
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    TileGrid::parse(1.0, &rows).expect("the level is drawn with known letters")
}
