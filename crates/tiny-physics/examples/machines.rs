//! Joints that couple and drive: gear, pulley, motor, mouse, filter. `cargo run -p tiny-physics --example machines`

use tiny_physics::{Error, JointDef, JointKind, RigidBody, Shape, Vec2, World};

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let base = world.add_body(RigidBody::fixed())?;

    // Two wheels on axles, the large one driven; the small one turns twice as fast, the other way.
    let mut wheel = |x: f32, radius: f32, axle: JointDef| {
        let disk = RigidBody::dynamic().position(Vec2::new(x, 0.0)).shape(Shape::circle(radius)?);
        let disk = world.add_body(disk)?;
        world.add_joint(base, disk, axle.anchors(Vec2::new(x, 0.0), Vec2::ZERO))?;
        Ok::<_, Error>(disk)
    };
    let large = wheel(0.0, 1.0, JointDef::revolute().motor(2.0, 500.0))?;
    let small = wheel(1.6, 0.5, JointDef::revolute())?;
    world.add_joint(large, small, JointDef::gear(0.5))?;

    // A rope over two hooks: 3 kg pull 2 kg up.
    let weight = |x: f32, mass: f32| -> Result<RigidBody, Error> {
        Ok(RigidBody::dynamic().position(Vec2::new(x, -5.0)).shape(Shape::circle(0.2)?).mass(mass))
    };
    let (heavy, light) = (world.add_body(weight(10.0, 3.0)?)?, world.add_body(weight(12.0, 2.0)?)?);
    world.add_joint(
        heavy,
        light,
        JointDef::pulley(Vec2::new(10.0, 0.0), Vec2::new(12.0, 0.0), 10.0),
    )?;

    // A drone that a motor joint carries to where the base's anchor is, with a bounded force.
    let drone = world.add_body(
        RigidBody::dynamic().position(Vec2::new(20.0, 0.0)).shape(Shape::rect(0.5, 0.1)?).mass(1.0),
    )?;
    let mut drive = JointDef::drive().anchors(Vec2::new(22.0, 3.0), Vec2::ZERO);
    if let JointKind::Motor { linear_spring, max_spring_force, .. } = &mut drive.kind {
        *linear_spring = Some(tiny_physics::Spring { hertz: 1.0, damping_ratio: 1.0 });
        *max_spring_force = 100.0;
    }
    world.add_joint(base, drone, drive)?;

    // Drag a ball through a wall: the mouse pulls, and a filter joint lets the two pass.
    let wall = world.add_body(
        RigidBody::fixed().position(Vec2::new(31.0, 0.0)).shape(Shape::rect(0.2, 3.0)?),
    )?;
    let ball = RigidBody::dynamic()
        .position(Vec2::new(30.0, 0.0))
        .shape(Shape::circle(0.3)?)
        .gravity_scale(0.0);
    let ball = world.add_body(ball)?;
    world.add_joint(wall, ball, JointDef::filter())?;
    let mouse = world.add_joint(base, ball, JointDef::mouse(Vec2::new(30.0, 0.0), 50.0))?;

    for step in 0..60 {
        let target = Vec2::new(30.0 + 2.0 * step as f32 / 59.0, 0.0);
        world.set_joint(mouse, JointDef::mouse(target, 50.0))?;
        world.step(1.0 / 60.0);
    }
    let (turning, sinks) =
        (world.body(small).unwrap().angular_velocity(), world.body(heavy).unwrap().velocity().y);
    for _ in 0..240 {
        world.step(1.0 / 60.0);
    }
    println!("small wheel {turning:.3} rad/s, heavy weight {sinks:.3} m/s");
    assert!((turning + 4.0).abs() < 0.01, "A turns -ratio times as far as B");
    assert!((sinks + 2.0).abs() < 0.01, "(3 - 2) / (3 + 2) g after a second");
    let (drone, ball) =
        (world.body(drone).unwrap().position(), world.body(ball).unwrap().position());
    println!("drone at ({:.2}, {:.2}), ball at x = {:.2}", drone.x, drone.y, ball.x);
    assert!((ball.x - 32.0).abs() < 0.01);
    assert!((drone.x - 22.0).abs() < 0.01, "a spring of 1 Hz gives by 0.253 m under gravity");
    assert!((drone.y - 2.747).abs() < 0.01);
    Ok(())
}
