//! The scenes of the promise: nothing tunnels, nothing jitters, it stays light.

use super::Options;
use crate::random::Random;
use crate::scene::Scene;
use crate::shapes;
use tiny_physics::{RigidBody, Shape, Vec2};

/// Friction of everything in a pile.
const PILE_FRICTION: f32 = 0.3;

/// Bodies of the demo that share one band of the sky, 10 m high; more bodies fall from higher bands.
const DEMO_BAND: u32 = 20;

/// Twenty circles and boxes that fall on a floor with a step, at places that the seed decides; size is
/// their number. A wall at each end keeps what rolls and bounces on the floor.
pub(crate) fn seed_demo(options: Options) -> Scene {
    let count = options.size_or(20, 100_000);
    let mut scene =
        Scene::new("seed_demo", "Circles and boxes fall, bounce and come to rest in heaps.");
    scene.view = Some((Vec2::new(-19.9, -11.0), Vec2::new(19.9, 8.0)));
    scene.body(RigidBody::new(aabb(20.0, 1.0), Vec2::new(0.0, -10.0), 0.0));
    scene.body(RigidBody::new(aabb(2.0, 0.5), Vec2::new(4.0, -8.5), 0.0));
    for x in [-19.5, 19.5] {
        scene.body(RigidBody::new(aabb(0.5, 5.0), Vec2::new(x, -4.0), 0.0));
    }
    let mut random = Random::new(options.seed);
    let mut places = Vec::new();
    for i in 0..count {
        let (shape, radius) = demo_shape(&mut random);
        let bottom = 5.0 + 10.0 * (i / DEMO_BAND) as f32;
        let place = free_place(&mut random, bottom, radius, &mut places);
        let mut body = RigidBody::new(shape, place, 1.0);
        body.shapes[0].material.rolling_resistance = 0.2;
        scene.body(body);
    }
    scene
}

/// A circle or a box, and the radius of the circle around it.
fn demo_shape(random: &mut Random) -> (Shape, f32) {
    if random.coin() {
        let radius = random.range(0.2, 0.8);
        return (shapes::circle(radius), radius);
    }
    let half_width = random.range(0.3, 0.7);
    let half_extents = Vec2::new(half_width, random.range(0.3, 0.7));
    (aabb(half_extents.x, half_extents.y), half_extents.length())
}

/// Draws places in the band above `bottom` until one is clear of the bodies in this band and the one
/// below. Twenty bodies fill at most a third of a band, so that a few draws do; their number is bounded
/// all the same.
fn free_place(
    random: &mut Random,
    bottom: f32,
    radius: f32,
    places: &mut Vec<(Vec2, f32)>,
) -> Vec2 {
    let near = places.len().saturating_sub(2 * DEMO_BAND as usize);
    let mut place = Vec2::ZERO;
    for _ in 0..1000 {
        let x = random.range(-8.0, 8.0);
        place = Vec2::new(x, random.range(bottom, bottom + 10.0));
        if places[near..].iter().all(|(other, r)| place.distance(*other) > radius + r) {
            break;
        }
    }
    places.push((place, radius));
    place
}

/// Circles and never-turning boxes by turns, 1000 of them.
pub(crate) fn seed_pile_1000(options: Options) -> Scene {
    pile("seed_pile_1000", options.size_or(1000, MOST), 600, by_turns(aabb(0.4, 0.4)))
}

/// The same, 5000.
pub(crate) fn seed_pile_5000(options: Options) -> Scene {
    pile("seed_pile_5000", options.size_or(5000, MOST), 600, by_turns(aabb(0.4, 0.4)))
}

/// The same, 20,000.
pub(crate) fn seed_pile_20000(options: Options) -> Scene {
    pile("seed_pile_20000", options.size_or(20_000, MOST), 600, by_turns(aabb(0.4, 0.4)))
}

/// Circles and boxes that turn.
pub(crate) fn seed_pile_turning_5000(options: Options) -> Scene {
    let shape = by_turns(shapes::rect(0.4, 0.4));
    pile("seed_pile_turning_5000", options.size_or(5000, MOST), 600, shape)
}

/// Circles alone, 10,000.
pub(crate) fn circles_10k(options: Options) -> Scene {
    pile("circles_10k", options.size_or(10_000, MOST), 120, |_| shapes::circle(0.4))
}

/// Circles alone, 100,000.
pub(crate) fn circles_100k(options: Options) -> Scene {
    pile("circles_100k", options.size_or(100_000, MOST), 120, |_| shapes::circle(0.4))
}

/// Circles alone, 1,000,000.
pub(crate) fn circles_1m(options: Options) -> Scene {
    pile("circles_1m", options.size_or(1_000_000, MOST), 120, |_| shapes::circle(0.4))
}

const MOST: u32 = 4_000_000;

fn aabb(half_width: f32, half_height: f32) -> Shape {
    Shape::Aabb { half_extents: Vec2::new(half_width, half_height) }
}

fn by_turns(second: Shape) -> impl Fn(u32) -> Shape {
    move |i| if i.is_multiple_of(2) { shapes::circle(0.4) } else { second }
}

/// `count` bodies of mass 1 on a grid of pitch 1 between two walls, every row shifted a little against
/// the one below.
fn pile(name: &str, count: u32, steps: u32, shape: impl Fn(u32) -> Shape) -> Scene {
    let mut scene = Scene::new(name, format!("{count} bodies fall into a pile between two walls."));
    scene.steps = steps;
    scene.settings.sleep = false;
    let root = (count as f32).sqrt();
    let (width, height) = (1.2 * root, 4.0 * root);
    add_container(&mut scene, width, height);
    let columns = ((width - 0.2) as u32).max(1);
    let left = -0.5 * (columns - 1) as f32;
    for i in 0..count {
        let (row, column) = (i / columns, i % columns);
        let shift = 0.1 * (((row * 7 + column * 3) % 5) as f32 - 2.0);
        let place = Vec2::new(left + column as f32 + shift, 0.5 + row as f32);
        scene.body(RigidBody::new(shape(i), place, 1.0).friction(PILE_FRICTION));
    }
    scene
}

/// A floor with its top at y = 0 and two walls, 2 m thick.
fn add_container(scene: &mut Scene, width: f32, height: f32) {
    let side = 0.5 * width + 1.0;
    let boxes = [
        (Vec2::new(0.0, -1.0), aabb(0.5 * width + 2.0, 1.0)),
        (Vec2::new(-side, 0.5 * height), aabb(1.0, 0.5 * height)),
        (Vec2::new(side, 0.5 * height), aabb(1.0, 0.5 * height)),
    ];
    for (center, shape) in boxes {
        scene.body(RigidBody::new(shape, center, 0.0).friction(PILE_FRICTION));
    }
}
