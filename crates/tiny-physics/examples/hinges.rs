//! Joints that leave one direction free: a hinge with motor and limit, a slider, a soft weld, and a wheel.
//! `cargo run -p tiny-physics --example hinges`

use tiny_physics::{Error, JointDef, RigidBody, Shape, Vec2, World};

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let base = world.add_body(RigidBody::fixed())?;
    let arm = |x: f32| -> Result<RigidBody, Error> {
        Ok(RigidBody::dynamic().position(Vec2::new(x, 0.0)).shape(Shape::rect(1.0, 0.1)?).mass(2.0))
    };
    let left_end = Vec2::new(-1.0, 0.0);

    // A barrier: a motor strong enough lifts the arm (20 N m are needed) until the limit stops it at 80 degrees.
    let barrier = world.add_body(arm(0.0)?)?;
    let up = 80_f32.to_radians();
    let hinge = JointDef::revolute().motor(1.0, 60.0).limits(0.0, up).anchors(left_end, left_end);
    world.add_joint(base, barrier, hinge)?;

    // A lift on a rail: the direction is given in the frame of the first body.
    let lift = world.add_body(arm(10.0)?)?;
    let rail = JointDef::prismatic(Vec2::Y).motor(0.5, 100.0).limits(0.0, 2.0);
    world.add_joint(base, lift, rail.anchors(Vec2::new(10.0, 0.0), Vec2::ZERO))?;

    // A diving board: a weld whose angle is a spring.
    let board = world.add_body(arm(20.0)?)?;
    let weld = JointDef::weld().spring(2.0, 0.3).anchors(Vec2::new(19.0, 0.0), left_end);
    world.add_joint(base, board, weld)?;

    // A unicycle: the wheel is driven, its suspension gives way.
    let road = RigidBody::fixed().position(Vec2::new(0.0, -12.0)).shape(Shape::rect(60.0, 1.0)?);
    world.add_body(road)?;
    let seat = RigidBody::dynamic().position(Vec2::new(0.0, -10.0)).shape(Shape::rect(0.2, 0.1)?);
    let seat = world.add_body(seat.lock_rotation())?;
    let wheel = RigidBody::dynamic().position(Vec2::new(0.0, -10.5)).shape(Shape::circle(0.4)?);
    let wheel = world.add_body(wheel.friction(1.0))?;
    let axle = JointDef::wheel(Vec2::Y).spring(4.0, 0.7).limits(-0.2, 0.2).motor(-5.0, 20.0);
    world.add_joint(seat, wheel, axle.anchors(Vec2::new(0.0, -0.5), Vec2::ZERO))?;

    for _ in 0..300 {
        world.step(1.0 / 60.0);
    }
    let angle = |body| world.body(body).unwrap().angle();
    let place = |body| world.body(body).unwrap().position();
    println!("barrier {:.1} degrees up", angle(barrier).to_degrees());
    println!("lift {:.3} m up", place(lift).y);
    println!("board bends by {:.1} degrees", -angle(board).to_degrees());
    println!(
        "unicycle came {:.2} m far at {:.2} m/s",
        place(seat).x,
        world.body(seat).unwrap().velocity().x
    );
    assert!((angle(barrier) - up).abs() < 0.02);
    assert!((place(lift).y - 2.0).abs() < 0.01);
    assert!((-0.2..-0.02).contains(&angle(board)));
    assert!((world.body(seat).unwrap().velocity().x - 2.0).abs() < 0.05, "5 rad/s on 0.4 m");
    Ok(())
}
