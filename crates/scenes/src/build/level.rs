//! A platformer level of tiles with movers that walk in it.

use super::Options;
use crate::random::Random;
use crate::scene::Scene;
use crate::script::{Script, Walkers};
use crate::shapes;
use tiny_physics::{ChainDef, RigidBody, Shape, ShapeDef, TileGrid, Vec2};

const COLUMNS: u32 = 400;
const ROWS: u32 = 60;
/// Part of the cells that are full in every fourth row.
const FILLED: f32 = 0.3;
const WALK_SPEED: f32 = 6.0;
/// Half extents of a walking box; as wide as a walking circle.
const WALKER: Vec2 = Vec2::new(0.4, 0.8);

/// 400 by 60 cells with a floor two rows thick, a wall at either end and platforms of 3 to 12 cells in
/// every fourth row, each cell a static body of its own; size is the number of movers.
pub(crate) fn tiles(options: Options) -> Scene {
    let movers = options.size_or(500, 100_000);
    let mut random = Random::new(options.seed);
    let mut scene = Scene::new("tiles", "Boxes and circles walk in a level of 400 by 60 tiles.");
    scene.gravity = Vec2::new(0.0, -30.0);
    let level = Level::new(&mut random);
    for row in 0..ROWS {
        for column in (0..COLUMNS).filter(|c| level.is_full(*c, row)) {
            let center = Vec2::new(column as f32 + 0.5, row as f32 + 0.5);
            let tile = Shape::Aabb { half_extents: Vec2::splat(0.5) };
            scene.body(RigidBody::fixed().position(center).shape(tile));
        }
    }
    let first = scene.bodies.len();
    for i in 0..movers {
        scene.body(mover(i, &mut random));
    }
    let walkers = Walkers { first, count: movers as usize, speed: WALK_SPEED };
    scene.script = Some(Script::Walkers(walkers));
    scene
}

/// Balls and crates on hills, stairs and platforms of a tile map, beside a chain; size is their number.
pub(crate) fn tile_map(options: Options) -> Scene {
    let count = options.size_or(60, 2000);
    let mut random = Random::new(options.seed);
    let mut scene =
        Scene::new("tile_map", "Balls and crates roll over tiles and slide on a chain.");
    scene.gravity = Vec2::new(0.0, -10.0);
    let grid = TileGrid::parse(1.0, &MAP).expect("the map is drawn with known letters");
    grid.bodies().into_iter().for_each(|body| {
        scene.body(body);
    });
    let width = grid.width as f32;
    let hills = (0..=40).rev().map(|i| {
        let x = i as f32 * 0.5;
        Vec2::new(width + x, 3.0 + 2.0 * tiny_physics::math::sin(x * 0.8) - 0.1 * x)
    });
    let hills = ChainDef::open(&hills.collect::<Vec<_>>()).friction(0.1);
    let hills = RigidBody::fixed().chain(&hills).expect("the points of the hills are apart");
    scene.body(hills);
    for i in 0..count {
        let place = Vec2::new(random.range(2.0, width + 16.0), random.range(9.0, 14.0));
        let shape = match i % 3 {
            0 => shapes::circle(random.range(0.2, 0.45)),
            1 => shapes::rect(random.range(0.2, 0.45), random.range(0.2, 0.45)),
            _ => Shape::Capsule { a: Vec2::new(-0.2, 0.0), b: Vec2::new(0.2, 0.0), radius: 0.2 },
        };
        let velocity = Vec2::new(random.range(-4.0, 4.0), 0.0);
        let shape = ShapeDef::new(shape).friction(0.2);
        scene.body(RigidBody::dynamic().position(place).velocity(velocity).shape(shape));
    }
    scene
}

/// The map, top row first: see [`TileGrid::parse`].
const MAP: [&str; 9] = [
    "#.......................................",
    "#.......................................",
    "#..........----..............lhHL.......",
    "#\\..........................####.......",
    "##\\................/\\..................",
    "###HL...........lh##\\........_____.....",
    "#####HL......lh######\\.............../#",
    "#######HL__lh##########HL..__....lh#####",
    "########################################",
];

/// Movers start in the free rows over the floors, spread over the level.
fn mover(i: u32, random: &mut Random) -> RigidBody {
    let row = 2.0 + 4.0 * random.below(ROWS / 4) as f32;
    let x = random.range(1.5, COLUMNS as f32 - 1.5);
    let shape = if i.is_multiple_of(2) {
        Shape::Aabb { half_extents: WALKER }
    } else {
        shapes::circle(0.4)
    };
    RigidBody::dynamic().position(Vec2::new(x, row + 0.9)).shape(shape).friction(0.2)
}

/// Which cells are full.
struct Level {
    full: Vec<bool>,
}

impl Level {
    fn new(random: &mut Random) -> Self {
        let mut level = Self { full: vec![false; (COLUMNS * ROWS) as usize] };
        for row in 0..ROWS {
            level.fill(0, 1, row);
            level.fill(COLUMNS - 1, 1, row);
        }
        level.fill(0, COLUMNS, 0);
        level.fill(0, COLUMNS, 1);
        for row in (5..ROWS).step_by(4) {
            level.fill_platforms(row, random);
        }
        level
    }

    /// Runs at random places until the part of the row is full; a run may touch or cover another.
    fn fill_platforms(&mut self, row: u32, random: &mut Random) {
        let wanted = (FILLED * COLUMNS as f32) as usize;
        while self.count(row) < wanted {
            let length = 3 + random.below(10);
            let start = random.below(COLUMNS - length);
            self.fill(start, length, row);
        }
    }

    fn count(&self, row: u32) -> usize {
        (0..COLUMNS).filter(|c| self.is_full(*c, row)).count()
    }

    fn fill(&mut self, start: u32, length: u32, row: u32) {
        let from = (row * COLUMNS + start) as usize;
        self.full[from..from + length as usize].fill(true);
    }

    fn is_full(&self, column: u32, row: u32) -> bool {
        self.full[(row * COLUMNS + column) as usize]
    }
}
