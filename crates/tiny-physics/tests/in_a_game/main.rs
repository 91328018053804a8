//! What games ask of the interface, one test a wish.

mod bodies;
mod contacts;
mod heroes;
mod joints;
mod queries;
mod sleepers;

use tiny_physics::prelude::*;

const DT: f32 = 1.0 / 60.0;

fn steps(world: &mut World, count: usize) {
    (0..count).for_each(|_| world.step(DT));
}

fn square(size: f32) -> Shape {
    Shape::rect(size, size).unwrap()
}

fn ground(world: &mut World) -> BodyId {
    let floor = ShapeDef::new(Shape::rect(50.0, 1.0).unwrap()).user_data(1);
    world.add_body(RigidBody::fixed().position((0.0, -1.0)).shape(floor).user_data(10)).unwrap()
}

fn circle(radius: f32) -> Shape {
    Shape::circle(radius).unwrap()
}
