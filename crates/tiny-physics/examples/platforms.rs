//! A lift that is led to targets, cargo that rides it, and a one-way platform to jump through.
//! `cargo run -p tiny-physics --example platforms`

use tiny_physics::{
    BodyKind, Error, RigidBody, Rot, Shape, ShapeDef, Transform, Vec2, World, math,
};

const DT: f32 = 1.0 / 60.0;

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let lift = world.add_body(RigidBody::kinematic().shape(Shape::rect(2.0, 0.2)?))?;
    let cargo = RigidBody::dynamic().position(Vec2::new(0.5, 0.7)).shape(Shape::rect(0.5, 0.5)?);
    let cargo = world.add_body(cargo)?;

    // Say where it has to be at the end of each step; the engine finds the velocity, and what stands on it rides.
    for step in 1..=300 {
        let phase = step as f32 * DT;
        let place = Vec2::new(2.0 - 2.0 * math::cos(phase), 1.0 - math::cos(phase));
        let target = Transform::new(place, Rot::from_angle(0.1 * math::sin(2.0 * phase)));
        world.body_mut(lift).unwrap().set_target(target, DT);
        world.step(DT);
        assert!((world.body(lift).unwrap().position() - place).length() < 1e-4);
    }
    let offset = world.body(cargo).unwrap().position() - world.body(lift).unwrap().position();
    println!("the cargo has moved by {:.1} mm on the lift", 1000.0 * (offset.x - 0.5).abs());
    assert!((offset.x - 0.5).abs() < 0.1 && offset.y > 0.6);

    // A platform that is solid from above only: `one_way` points out of its solid side.
    let plank = ShapeDef::new(Shape::rect(3.0, 0.1)?).one_way(Vec2::Y);
    world.add_body(RigidBody::fixed().position(Vec2::new(10.0, 2.0)).shape(plank))?;
    let ball = RigidBody::dynamic().position(Vec2::new(10.0, 0.0)).velocity(Vec2::new(0.0, 9.0));
    let ball = world.add_body(ball.shape(Shape::circle(0.3)?))?;
    let mut highest: f32 = 0.0;
    for _ in 0..180 {
        world.step(DT);
        highest = highest.max(world.body(ball).unwrap().position().y);
    }
    let height = world.body(ball).unwrap().position().y;
    println!("the ball rose to {highest:.2} m and landed at {height:.2} m");
    assert!(highest > 3.5 && (height - 2.4).abs() < 0.01);
    assert_eq!(world.body(lift).unwrap().kind(), BodyKind::Kinematic);
    Ok(())
}
