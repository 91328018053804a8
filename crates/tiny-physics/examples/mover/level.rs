//! The example level: hills of slope tiles, stairs, a one-way platform, a lift, a shuttle over a pit, a plate
//! that turns, and a crate.

use tiny_physics::{
    BodyId, CharacterMover, Error, MoverInput, RigidBody, Shape, ShapeDef, TileGrid, Vec2, World,
};

const WIDTH: usize = 64;
const HEIGHT: usize = 9;

/// The world, the hero, and what moves by itself.
pub struct Level {
    pub world: World,
    pub hero: CharacterMover,
    pub lift: BodyId,
    pub shuttle: BodyId,
    pub plate: BodyId,
    pub crate_: BodyId,
    pub time: f32,
}

/// From a time on (seconds): what the hero does until the next entry.
pub const SCRIPT: [(f32, f32, f32); 13] = [
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
    (30.5, 2.0, 0.0), // Pushes the crate to the wall.
    (37.5, -2.0, 0.0),
    (39.5, 0.0, 0.0),
];

/// Length of the script, seconds.
pub const END: f32 = 40.0;

impl Level {
    pub fn new() -> Result<Self, Error> {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        world.add_tiles(tiles()?)?;
        let mut stairs = RigidBody::fixed().position(Vec2::new(20.0, 2.0));
        for i in 1..=4 {
            let (x, height) = (0.5 * i as f32 - 0.25, 0.25 * i as f32);
            let step = ShapeDef::new(Shape::rect(0.25, 0.5 * height)?);
            stairs = stairs.shape(step.offset(Vec2::new(x, 0.5 * height)));
        }
        world.add_body(stairs)?;
        let platform = |x: f32, y: f32, half_width: f32| -> Result<RigidBody, Error> {
            let shape = Shape::rect(half_width, 0.1)?;
            Ok(RigidBody::kinematic().position(Vec2::new(x, y)).shape(shape))
        };
        let lift = world.add_body(platform(36.0, 2.1, 1.0)?)?;
        let shuttle = world.add_body(platform(41.0, 1.9, 1.0)?)?;
        let plate = world.add_body(platform(51.0, 2.05, 1.5)?)?;
        let crate_ = RigidBody::dynamic().position(Vec2::new(56.0, 2.4));
        let crate_ = world.add_body(crate_.shape(Shape::rect(0.4, 0.4)?))?;
        let hero = CharacterMover::new(Vec2::new(2.0, 3.0), 1.8, 0.3);
        Ok(Self { world, hero, lift, shuttle, plate, crate_, time: 0.0 })
    }

    /// Moves everything on by a step.
    pub fn step(&mut self, input: MoverInput, dt: f32) {
        let (time, during) =
            (self.time + 0.5 * dt, |from: f32, to: f32, t: f32| from < t && t < to);
        let pick = |first: (f32, f32), second: (f32, f32), speed: f32| {
            if during(first.0, first.1, time) {
                speed
            } else if during(second.0, second.1, time) {
                -speed
            } else {
                0.0
            }
        };
        let lift = Vec2::new(0.0, pick((11.0, 13.0), (14.0, 16.0), 1.0));
        let shuttle = Vec2::new(pick((18.0, 23.0), (60.0, 65.0), 1.0), 0.0);
        let turn = pick((25.0, 27.0), (28.0, 30.0), 0.2);
        for (body, velocity) in [(self.lift, lift), (self.shuttle, shuttle)] {
            if let Some(mut body) = self.world.body_mut(body) {
                body.set_velocity(velocity);
            }
        }
        if let Some(mut body) = self.world.body_mut(self.plate) {
            body.set_angular_velocity(turn);
        }
        self.world.step(dt);
        self.hero.update(&mut self.world, input, dt);
        self.time += dt;
    }

    /// What the script wants in the step that begins now.
    pub fn scripted_input(&self, dt: f32) -> MoverInput {
        let now = self.time + 0.5 * dt;
        let &(from, walk, jump) =
            SCRIPT.iter().rev().find(|entry| entry.0 < now).unwrap_or(&SCRIPT[0]);
        // A jump is asked for once.
        let jump = if now - from < dt { jump } else { 0.0 };
        MoverInput { walk, jump, drop: false }
    }
}

fn tiles() -> Result<TileGrid, Error> {
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
    TileGrid::parse(1.0, &rows)
}
