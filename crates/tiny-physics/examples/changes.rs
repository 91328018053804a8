//! Changing bodies and shapes while they are in use: kind, mass, enabled, geometry, material, more shapes.
//! `cargo run -p tiny-physics --example changes`

use tiny_physics::{BodyKind, Error, Material, RigidBody, Shape, ShapeDef, Vec2, World};

fn run(world: &mut World, steps: u32) {
    for _ in 0..steps {
        world.step(1.0 / 60.0);
    }
}

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let ramp = RigidBody::fixed().angle(-0.3).shape(Shape::rect(20.0, 0.5)?);
    let ramp = world.add_body(ramp)?;
    let crate_ = RigidBody::dynamic()
        .position(Vec2::new(-10.0, 4.2))
        .angle(-0.3)
        .shape(Shape::rect(0.5, 0.5)?);
    let crate_ = world.add_body(crate_)?;
    run(&mut world, 120);
    assert!(!world.body(crate_).unwrap().is_awake(), "friction holds it: tan(0.3) < 0.6");

    // Ice: the contact goes on with the new friction, and the crate wakes by itself.
    let slope = world.body(ramp).unwrap().shapes().next().unwrap();
    world
        .shape_mut(slope)
        .unwrap()
        .set_material(Material { friction: 0.0, ..Material::default() })?;
    run(&mut world, 60);
    let speed = world.body(crate_).unwrap().velocity().length();
    println!("on ice, a second later: {speed:.2} m/s");
    assert!((speed - 10.0 * 0.3_f32.sin()).abs() < 0.05, "g sin(0.3)");

    // A shape that grows takes mass and inertia along.
    let shape = world.body(crate_).unwrap().shapes().next().unwrap();
    world.shape_mut(shape).unwrap().set_shape(Shape::circle(1.0)?)?;
    assert!((world.body(crate_).unwrap().mass() - core::f32::consts::PI).abs() < 1e-4);
    let flag = ShapeDef::new(Shape::rect(0.1, 0.5)?).offset(Vec2::new(0.0, 1.5)).density(0.0);
    world.add_shape(crate_, flag)?;

    // Frozen in place, then let go again.
    world.body_mut(crate_).unwrap().set_kind(BodyKind::Static);
    let held = world.body(crate_).unwrap().position();
    run(&mut world, 60);
    assert_eq!(world.body(crate_).unwrap().position(), held);
    world.body_mut(crate_).unwrap().set_kind(BodyKind::Dynamic);
    world.body_mut(crate_).unwrap().set_mass(Some(50.0))?;
    run(&mut world, 60);
    assert!(world.body(crate_).unwrap().position().x > held.x + 0.5);

    // Out of the world without losing it: nothing touches or sees what is not enabled.
    world.body_mut(ramp).unwrap().set_enabled(false);
    run(&mut world, 60);
    let falling = world.body(crate_).unwrap().velocity().y;
    println!("the ramp is gone: {falling:.1} m/s");
    assert!(falling < -9.0);
    Ok(())
}
