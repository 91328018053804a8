//! Pieces that the scenes of the suite are made of.
//!
//! Unless a row says otherwise: gravity 10, steps of 1/60 s, the engine's default settings, boxes of 1 m,
//! density 1, friction 0.6, no restitution. Only towers and pyramids may sleep, as engines do by default.

use tiny_physics::{Polygon, RigidBody, Shape, ShapeDef, Vec2};
use tiny_physics_scenes::Scene;

/// Metres a second squared.
pub(crate) const GRAVITY: f64 = 10.0;

/// An empty scene with gravity.
pub(crate) fn scene(name: &str) -> Scene {
    Scene { gravity: Vec2::new(0.0, -GRAVITY as f32), ..Scene::new(name, "") }
}

/// An empty scene without gravity.
pub(crate) fn weightless(name: &str) -> Scene {
    Scene { gravity: Vec2::ZERO, ..scene(name) }
}

/// An empty scene with a floor as body 0: its surface is y = 0.
pub(crate) fn floored(name: &str) -> Scene {
    let mut scene = scene(name);
    scene.body(fixed(rect(200.0, 1.0), Vec2::new(0.0, -1.0)));
    scene
}

/// A box by its half extents.
pub(crate) fn rect(half_width: f32, half_height: f32) -> Shape {
    Polygon::rect(half_width, half_height).expect("boxes here have a positive size").into()
}

/// A disk.
pub(crate) fn disk(radius: f32) -> Shape {
    Shape::Circle { radius }
}

/// A static body.
pub(crate) fn fixed(shape: impl Into<ShapeDef>, position: Vec2) -> RigidBody {
    RigidBody::fixed().position(position).shape(shape)
}

/// A dynamic body that never sleeps.
pub(crate) fn moving(shape: impl Into<ShapeDef>, position: Vec2) -> RigidBody {
    RigidBody::dynamic().can_sleep(false).position(position).shape(shape)
}

/// A crate: 1 m, density as given.
pub(crate) fn crate_at(x: f32, y: f32, density: f32) -> RigidBody {
    moving(ShapeDef::new(rect(0.5, 0.5)).density(density), Vec2::new(x, y))
}

/// A tower of crates on the floor, the lowest first.
pub(crate) fn add_tower(scene: &mut Scene, count: u32) {
    for i in 0..count {
        scene.body(crate_at(0.0, 0.5 + i as f32, 1.0));
    }
}

/// A pyramid of crates around x = `middle` on y = 0, the lowest row first.
pub(crate) fn add_pyramid(scene: &mut Scene, base: u32, middle: f64) {
    for i in 0..base {
        for j in i..base {
            let x = 0.5 * f64::from(i) + f64::from(j - i) - 0.5 * f64::from(base - 1);
            let mut body = crate_at(0.0, i as f32 + 0.5, 1.0);
            body.position.x = middle + x;
            scene.body(body);
        }
    }
}
