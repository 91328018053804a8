//! Tests of what the world offers: events, changes, hooks, platforms, forces.

mod anything;
mod bounces;
mod changes;
mod compounds;
mod costs;
mod events;
mod forces;
mod frames;
mod handles;
mod hooks;
mod one_way;
mod paces;
mod rocking;
mod threads;
mod trees;
mod units;
mod waking;

use super::*;
use crate::describe::{BodyKind, RigidBody, ShapeDef};
use crate::geometry::Shape;
use crate::math::{DVec2, Transform};

const DT: f32 = 1.0 / 60.0;

fn world() -> World {
    World::new(Vec2::new(0.0, -10.0))
}

fn rect(half_width: f32, half_height: f32) -> ShapeDef {
    ShapeDef::new(Shape::rect(half_width, half_height).unwrap())
}

fn circle(radius: f32) -> ShapeDef {
    ShapeDef::new(Shape::circle(radius).unwrap())
}

/// Ground whose top is at y = 0.
fn add_ground(world: &mut World) -> BodyId {
    let ground = RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(rect(50.0, 1.0).events());
    world.add_body(ground).unwrap()
}

fn add(world: &mut World, x: f32, y: f32, shape: ShapeDef) -> BodyId {
    world.add_body(RigidBody::dynamic().position(Vec2::new(x, y)).shape(shape)).unwrap()
}

fn shape_of(world: &World, body: BodyId) -> ShapeId {
    world.body(body).unwrap().shapes().next().unwrap()
}

fn at(x: f32, y: f32) -> Transform {
    Transform::from_angle(Vec2::new(x, y), 0.0)
}

fn y(world: &World, body: BodyId) -> f32 {
    world.body(body).unwrap().position().y
}

fn run(world: &mut World, steps: usize) {
    for _ in 0..steps {
        world.step(DT);
        world.validate().unwrap();
    }
}
