//! Scenes of the size that games have: crates at rest, small piles of every kind, and a level.

use super::{Options, box2d_scene, crate_at, ground};
use crate::random::Random;
use crate::scene::Scene;
use crate::script::{Act, Deed, Script, Timeline, When};
use crate::shapes;
use core::f32::consts::TAU;
use tiny_physics::math::{cos, sin};
use tiny_physics::{Filter, JointDef, RigidBody, Shape, ShapeDef, TileGrid, Vec2};

/// Crates side by side in a row.
const ROW: u32 = 30;
/// Steps in which every pile here comes to rest and falls asleep.
const PILE_STEPS: u32 = 900;

/// Crates of 1 m at rest in rows of 30, kept awake; `count` is what the scene's name says.
fn crates(name: &str, count: u32, options: Options) -> Scene {
    let count = options.size_or(count, 100_000);
    let mut scene = box2d_scene(name, "Crates at rest in rows on a floor, kept awake.", 300);
    scene.settings.sleep = false;
    scene.body(ground(Vec2::new(0.0, -1.0), ROW as f32, 1.0));
    for i in 0..count {
        let (row, column) = (i / ROW, i % ROW);
        let x = 1.1 * (column as f32 - 0.5 * (ROW - 1) as f32);
        scene.body(crate_at(x, row as f32 + 0.5));
    }
    scene
}

pub(crate) fn crates_1(options: Options) -> Scene {
    crates("crates_1", 1, options)
}

pub(crate) fn crates_10(options: Options) -> Scene {
    crates("crates_10", 10, options)
}

pub(crate) fn crates_30(options: Options) -> Scene {
    crates("crates_30", 30, options)
}

pub(crate) fn crates_100(options: Options) -> Scene {
    crates("crates_100", 100, options)
}

pub(crate) fn crates_300(options: Options) -> Scene {
    crates("crates_300", 300, options)
}

pub(crate) fn crates_1000(options: Options) -> Scene {
    crates("crates_1000", 1000, options)
}

/// An empty scene whose bodies fall asleep in the end.
fn pile(name: &str, description: &str) -> Scene {
    let mut scene = box2d_scene(name, description, PILE_STEPS);
    scene.body(ground(Vec2::new(0.0, -1.0), 60.0, 1.0));
    scene
}

/// A pile in a pit: `count` bodies on a grid of a pitch, every row shifted against the one below, between two walls.
fn heap(mut scene: Scene, count: u32, pitch: f32, body: impl Fn(u32) -> RigidBody) -> Scene {
    let columns = (count as f32).sqrt().ceil() as u32;
    let half = 0.5 * (columns as f32 + 1.0) * pitch;
    let height = (columns as f32 + 2.0) * pitch;
    for side in [-1.0, 1.0] {
        scene.body(ground(Vec2::new(side * (half + 1.0), 0.5 * height), 1.0, 0.5 * height));
    }
    for i in 0..count {
        let (row, column) = (i / columns, i % columns);
        let shift = 0.1 * (((row * 7 + column * 3) % 5) as f32 - 2.0);
        let x = (column as f32 - 0.5 * (columns - 1) as f32 + shift) * pitch;
        scene.body(body(i).position(Vec2::new(x, (row as f32 + 0.6) * pitch)));
    }
    scene
}

fn with_shape(shape: Shape) -> RigidBody {
    RigidBody::dynamic().shape(shape)
}

/// A regular polygon, one side below.
fn regular(corners: u32, radius: f32) -> Shape {
    let point = |k: u32| {
        let angle = TAU * ((k as f32 + 0.5) / corners as f32 - 0.25);
        Vec2::new(radius * cos(angle), radius * sin(angle))
    };
    shapes::hull(&(0..corners).map(point).collect::<Vec<_>>(), 0.0)
}

/// Hexagons in a pyramid with a little room between them; size is its rows.
pub(crate) fn pile_hexagons(options: Options) -> Scene {
    let base = options.size_or(20, 200);
    let mut scene = pile("pile_hexagons", "A pyramid of hexagons comes down and falls asleep.");
    for i in 0..base {
        for j in i..base {
            let x = 1.05 * (j as f32 - 0.5 * (i + base - 1) as f32);
            let place = Vec2::new(x, 0.45 + 0.9 * i as f32);
            scene.body(with_shape(regular(6, 0.5)).position(place));
        }
    }
    scene
}

/// Capsules that lie and stand; size is their number.
pub(crate) fn pile_capsules(options: Options) -> Scene {
    let scene = pile("pile_capsules", "Capsules fall into a pit and asleep.");
    heap(scene, options.size_or(150, 5000), 1.1, |i| {
        let capsule =
            Shape::Capsule { a: Vec2::new(-0.3, 0.0), b: Vec2::new(0.3, 0.0), radius: 0.2 };
        with_shape(capsule).angle(0.4 * (i % 8) as f32)
    })
}

/// Triangles; size is their number.
pub(crate) fn pile_triangles(options: Options) -> Scene {
    let scene = pile("pile_triangles", "Triangles fall into a pit and asleep.");
    heap(scene, options.size_or(150, 5000), 1.1, |i| {
        with_shape(regular(3, 0.5)).angle(0.3 * (i % 7) as f32)
    })
}

/// A wall of bricks in bond, 30 to a row; size is their number.
pub(crate) fn pile_bricks(options: Options) -> Scene {
    let count = options.size_or(900, 10_000);
    let mut scene = pile("pile_bricks", "A wall of bricks settles and falls asleep.");
    for i in 0..count {
        let (row, column) = (i / ROW, i % ROW);
        let x = column as f32 + 0.5 * (row % 2) as f32 - 0.5 * ROW as f32;
        let place = Vec2::new(x, 0.25 + 0.5 * row as f32);
        scene.body(with_shape(shapes::rect(0.49, 0.25)).position(place));
    }
    scene
}

/// Circles, boxes, capsules and polygons of several sizes; size is their number.
pub(crate) fn pile_mixed(options: Options) -> Scene {
    let scene = pile("pile_mixed", "Shapes of every kind fall into a pit and asleep.");
    heap(scene, options.size_or(300, 10_000), 1.2, |i| {
        let size = 0.3 + 0.04 * (i % 6) as f32;
        let (a, b) = (Vec2::new(-size, 0.0), Vec2::new(size, 0.0));
        let shape = match i % 5 {
            0 => shapes::circle(size),
            1 => shapes::rect(size, 0.7 * size),
            2 => Shape::Capsule { a, b, radius: 0.5 * size },
            3 => regular(3, size),
            _ => regular(5, size),
        };
        let def = ShapeDef::new(shape).rolling_resistance(0.05);
        RigidBody::dynamic().shape(def).angle(0.5 * (i % 6) as f32)
    })
}

/// Planks twenty times as long as they are thick; size is their number.
pub(crate) fn pile_planks(options: Options) -> Scene {
    let scene = pile("pile_planks", "Thin planks fall into a pit and asleep.");
    heap(scene, options.size_or(100, 5000), 1.6, |i| {
        with_shape(shapes::rect(0.7, 0.035)).angle(0.2 * (i % 4) as f32)
    })
}

/// Rings of eight boxes each; size is the number of rings.
pub(crate) fn pile_rings(options: Options) -> Scene {
    let scene = pile("pile_rings", "Rings of eight boxes each fall into a pit and asleep.");
    heap(scene, options.size_or(60, 2000), 1.6, |i| {
        let ring = (0..8).fold(RigidBody::dynamic(), |ring, k| {
            let angle = TAU * k as f32 / 8.0;
            let place = Vec2::new(0.55 * cos(angle), 0.55 * sin(angle));
            let side = ShapeDef::new(shapes::rect(0.1, 0.23));
            ring.shape(side.offset(place).angle(angle))
        });
        ring.angle(0.3 * (i % 5) as f32)
    })
}

/// A tower of boxes, each an eighth larger than the one below; size is their number.
pub(crate) fn pile_by_size(options: Options) -> Scene {
    let count = options.size_or(14, 20);
    let mut scene = pile("pile_by_size", "Boxes stacked by size, the smallest below.");
    let mut bottom = 0.0;
    let halves = core::iter::successors(Some(0.25), |half| Some(1.125 * half));
    for half in halves.take(count as usize) {
        let place = Vec2::new(0.0, bottom + half);
        scene.body(with_shape(shapes::rect(half, half)).position(place));
        bottom += 2.0 * half;
    }
    scene
}

/// The level of [`game`], top row first.
const MAP: [&str; 9] = [
    "#..............................................#",
    "#..............................................#",
    "#..............................................#",
    "#.........####..............####...............#",
    "#..............................................#",
    "#....................####......................#",
    "#..........lhHL...................lh##.........#",
    "#.........######.................#####.........#",
    "################################################",
];

/// A platformer level of tiles with crates and balls, a character, two lifts, a hinged door, a rope, sensors and
/// one-way planks; size is the number of crates and balls. An engine without one-way shapes has solid planks, which
/// nothing here comes to from below.
pub(crate) fn game(options: Options) -> Scene {
    let count = options.size_or(30, 300);
    let text =
        "A level with crates, balls, lifts, a door, a rope, sensors and a hopping character.";
    let mut scene = box2d_scene("game", text, 600);
    scene.settings.sleep = false;
    let grid = TileGrid::parse(1.0, &MAP).expect("the level is drawn with known letters");
    for body in grid.bodies() {
        scene.body(body);
    }
    add_sensors_and_planks(&mut scene);
    add_door_and_rope(&mut scene);
    let mut random = Random::new(options.seed);
    for i in 0..count {
        let size = random.range(0.25, 0.45);
        let shape = if i % 3 == 2 { shapes::circle(size) } else { shapes::rect(size, size) };
        let place = Vec2::new(2.5 + 1.45 * (i % ROW) as f32, 7.0 + (i / ROW) as f32);
        let def = ShapeDef::new(shape).rolling_resistance(0.1);
        scene.body(RigidBody::dynamic().shape(def).position(place));
    }
    let hero = scene.body(hero());
    let lift = |x: f32| RigidBody::kinematic().position(Vec2::new(x, 1.3));
    let lifts = [5.0, 40.5].map(|x| scene.body(lift(x).shape(shapes::rect(1.2, 0.15))));
    scene.script = Some(Script::Timeline(Timeline { acts: plot(hero, lifts) }));
    scene
}

fn add_sensors_and_planks(scene: &mut Scene) {
    let mut sensors = RigidBody::fixed();
    for i in 0..10 {
        let place = Vec2::new(3.5 + 4.5 * i as f32, 1.5);
        sensors = sensors.shape(ShapeDef::new(shapes::rect(0.5, 0.5)).offset(place).sensor());
    }
    scene.body(sensors);
    let filter = Filter { category: PLANK, ..Filter::default() };
    let plank = ShapeDef::new(shapes::rect(1.5, 0.1)).one_way(Vec2::Y).filter(filter);
    for x in [7.5, 18.5, 26.5, 43.5] {
        scene.body(RigidBody::fixed().position(Vec2::new(x, 4.0)).shape(plank.clone()));
    }
}

/// The planks, which the rope that hangs from one of them passes: its ends would be held above and below.
const PLANK: u64 = 2;

/// A door that stands on the floor and turns about its upper end, and a rope of twelve links under the third plank.
fn add_door_and_rope(scene: &mut Scene) {
    let post = scene.body(RigidBody::fixed());
    let door = shapes::rect(0.1, 0.8);
    let door = scene.body(RigidBody::dynamic().shape(door).position(Vec2::new(19.0, 2.0)));
    let hinge = |a: Vec2, b: Vec2| JointDef::revolute().anchors(a, b);
    let hung = hinge(Vec2::new(19.0, 2.8), Vec2::new(0.0, 0.8)).limits(-1.5, 1.5);
    scene.joint(post, door, hung);
    let mut above = (post, Vec2::new(26.5, 3.9));
    for i in 0..12 {
        let place = Vec2::new(26.5, 3.9 - 0.1 - 0.2 * i as f32);
        let link = ShapeDef::new(Shape::Capsule {
            a: Vec2::new(0.0, -0.06),
            b: Vec2::new(0.0, 0.06),
            radius: 0.04,
        });
        let link = link.filter(Filter { mask: !PLANK, ..Filter::default() });
        let link = scene.body(RigidBody::dynamic().shape(link).position(place));
        scene.joint(above.0, link, hinge(above.1, Vec2::new(0.0, 0.1)));
        above = (link, Vec2::new(0.0, -0.1));
    }
}

/// An upright capsule.
fn hero() -> RigidBody {
    let (a, b) = (Vec2::new(0.0, -0.4), Vec2::new(0.0, 0.4));
    let shape = ShapeDef::new(Shape::Capsule { a, b, radius: 0.3 }).friction(0.4);
    RigidBody::dynamic().shape(shape).position(Vec2::new(23.0, 1.8)).lock_rotation()
}

/// The character hops to and fro; the lifts go up and down.
fn plot(hero: usize, lifts: [usize; 2]) -> Vec<Act> {
    let act = |step: u32, body: usize, velocity: Vec2| Act {
        when: When::At(step),
        deed: Deed::SetVelocity { body, velocity, angular_velocity: 0.0 },
    };
    let hops = (0..20).map(|i| {
        let side = if i / 5 % 2 == 0 { 1.0 } else { -1.0 };
        act(30 * i, hero, Vec2::new(3.5 * side, 4.0))
    });
    let rides = (0..8).flat_map(|i| {
        let up = if i % 2 == 0 { 2.0 } else { -2.0 };
        lifts.map(|lift| act(75 * i, lift, Vec2::new(0.0, up)))
    });
    hops.chain(rides).collect()
}
