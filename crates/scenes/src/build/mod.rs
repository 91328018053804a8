//! Builders of the scenes, one file a family.

pub(crate) mod benchmark;
pub(crate) mod course;
pub(crate) mod fair;
pub(crate) mod features;
pub(crate) mod joints;
pub(crate) mod level;
pub(crate) mod seed;
pub(crate) mod show;
pub(crate) mod small;

use crate::scene::Scene;
use crate::shapes;
use tiny_physics::{Mix, RigidBody, Settings, Vec2};

/// What a builder can be told; each scene says in its description what it makes of it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Options {
    /// Seed of the scenes that have chance in them.
    pub seed: u64,
    /// Main size of the scene: rows of a pyramid, bodies of a pile, length of a bridge. `None` is the size
    /// that belongs to the scene's name. It is cut to what the scene can be built with.
    pub size: Option<u32>,
}

impl Default for Options {
    /// Seed 1 and each scene's own size.
    fn default() -> Self {
        Self { seed: 1, size: None }
    }
}

impl Options {
    /// These options with a seed.
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// These options with a size.
    pub fn size(mut self, size: u32) -> Self {
        self.size = Some(size);
        self
    }

    fn size_or(self, usual: u32, most: u32) -> u32 {
        self.size.unwrap_or(usual).clamp(1, most)
    }
}

/// A scene as in Box2D's benchmark: gravity 10, the greater restitution counts.
fn box2d_scene(name: &str, description: &str, steps: u32) -> Scene {
    let settings = Settings { restitution_mix: Mix::Max, ..Settings::default() };
    Scene { gravity: Vec2::new(0.0, -10.0), settings, steps, ..Scene::new(name, description) }
}

/// A static box by its centre and half extents.
fn ground(center: Vec2, half_width: f32, half_height: f32) -> RigidBody {
    RigidBody::fixed().position(center).shape(shapes::rect(half_width, half_height))
}

/// A dynamic square of 1 m.
fn crate_at(x: f32, y: f32) -> RigidBody {
    RigidBody::dynamic().position(Vec2::new(x, y)).shape(shapes::rect(0.5, 0.5))
}

/// Crates in a pyramid of `base` rows, their corners touching, from `left` on the height `bottom`.
fn add_pyramid(
    scene: &mut Scene,
    base: u32,
    left: f32,
    bottom: f32,
    kind: impl Fn(RigidBody) -> RigidBody,
) {
    for i in 0..base {
        for j in i..base {
            let x = 0.5 * (i as f32 + 1.0) + (j - i) as f32 + left;
            scene.body(kind(crate_at(x, i as f32 + 0.5 + bottom)));
        }
    }
}
