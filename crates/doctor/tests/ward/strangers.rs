//! Sick worlds as they come in from games: a level with its mistake somewhere in it, and much that is healthy around.
//!
//! They were written without knowledge of the doctor's rules, from the engine's documentation alone. Each names
//! what its author did wrong, not what it looks like in the end.

mod input;
mod joints;
mod places;
mod rest;

use super::*;
use tiny_physics::{Filter, JointDef, ShapeDef, Vec2};

pub(super) fn all() -> Vec<Patient> {
    [input::all(), places::all(), joints::all(), rest::all()].into_iter().flatten().collect()
}

fn patient(name: &'static str, code: Code, steps: u64, case: Case) -> Patient {
    Patient { name, code, steps, case }
}

/// A world that runs at steps of its own.
fn paced(world: World, mut dt: impl FnMut(u64) -> f32 + 'static) -> Case {
    Case { world, act: Box::new(move |_, step| dt(step)) }
}

/// A world seen from above.
fn from_above() -> World {
    World::new(Vec2::ZERO)
}

/// A static box by its centre and half its sides.
fn block(world: &mut World, x: f32, y: f32, half_width: f32, half_height: f32) -> BodyId {
    let shape = Shape::rect(half_width, half_height).unwrap();
    add(world, RigidBody::fixed().position(Vec2::new(x, y)).shape(shape))
}

fn ball(radius: f32, x: f32, y: f32) -> RigidBody {
    thing(Shape::circle(radius).unwrap(), x, y)
}

fn plank(half_width: f32, half_height: f32, x: f32, y: f32) -> RigidBody {
    thing(Shape::rect(half_width, half_height).unwrap(), x, y)
}

/// What stands about in a level on ground of height `y`: three crates on each other, a ball, a shop sign.
fn village(world: &mut World, x: f32, y: f32) {
    for i in 0..3 {
        add(world, crate_at(x, y + 0.5 + i as f32));
    }
    add(world, ball(0.4, x + 2.0, y + 0.4));
    let post = block(world, x + 5.0, y + 1.5, 0.1, 1.5);
    let sign = add(world, plank(0.5, 0.3, x + 5.0, y + 2.2));
    let hook = JointDef::revolute().anchors(Vec2::new(0.0, 1.2), Vec2::new(0.0, 0.5));
    world.add_joint(post, sign, hook).unwrap();
}

/// Walls of a court seen from above, centred at the origin.
fn court(world: &mut World, half_width: f32, half_height: f32) {
    for side in [-1.0, 1.0] {
        block(world, side * (half_width + 0.5), 0.0, 0.5, half_height + 1.0);
        block(world, 0.0, side * (half_height + 0.5), half_width + 1.0, 0.5);
    }
}

/// Pucks that lie about in a court, and slow down.
fn pucks(world: &mut World, count: u32) {
    for i in 0..count {
        let place = Vec2::new(-6.0 + 2.0 * (i % 7) as f32, -5.5 + 0.9 * (i / 7) as f32);
        let puck = ball(0.3, place.x, place.y).damping(0.8, 0.8);
        add(world, puck.velocity(Vec2::new(0.3, 0.0)));
    }
}
