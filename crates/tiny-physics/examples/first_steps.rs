//! A world, a floor, a ball: steps of a fixed length under frames of uneven length, and poses between steps to
//! draw. `cargo run -p tiny-physics --example first_steps`

use tiny_physics::{Error, FixedStep, RigidBody, Shape, Vec2, World};

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let floor = RigidBody::fixed().position(Vec2::new(0.0, -0.5)).shape(Shape::rect(20.0, 0.5)?);
    world.add_body(floor)?;
    let ball = RigidBody::dynamic().position(Vec2::new(0.0, 4.0)).shape(Shape::circle(0.5)?);
    let ball = world.add_body(ball)?;

    // A game's frames: 144 a second, with a hitch of a third of a second in the middle.
    let mut clock = FixedStep::new(1.0 / 60.0);
    let mut last = f64::MAX;
    for frame in 0..432 {
        let elapsed = if frame == 72 { 1.0 / 3.0 } else { 1.0 / 144.0 };
        for _ in 0..clock.advance(elapsed) {
            world.step(clock.dt());
        }
        // What is drawn lies between the last two steps, so it moves in every frame, not in every other one.
        let drawn = world.body(ball).unwrap().interpolated_pose(clock.alpha()).p.y;
        assert!(drawn <= last + 0.01, "it falls smoothly: {drawn} after {last}");
        last = drawn;
        if frame % 48 == 0 {
            println!("frame {frame:3}, step {:3}: height {drawn:.3} m", world.step_count());
        }
    }

    let ball = world.body(ball).unwrap();
    assert!((ball.position().y - 0.5).abs() < 0.01, "it lies on the floor");
    assert!(!ball.is_awake(), "and has fallen asleep");
    Ok(())
}
