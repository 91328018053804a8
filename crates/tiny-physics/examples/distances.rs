//! The distance joint as a rod, a spring, a range and a rope: four weights hang from one beam.
//! `cargo run -p tiny-physics --example distances`

use tiny_physics::{Error, JointDef, RigidBody, Shape, Vec2, World};

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let beam = world.add_body(RigidBody::fixed())?;
    let joints = [
        ("rod", JointDef::distance(2.0)),
        // A spring by frequency and damping ratio; the mass that hangs on it does not matter.
        ("spring", JointDef::distance(2.0).spring(1.0, 0.2)),
        ("spring with limits", JointDef::distance(2.0).spring(1.0, 0.2).limits(1.5, 2.1)),
        ("rope", JointDef::rope(3.0)),
    ];
    // What sleeps has no loads to read, so they stay awake.
    let mut weights = Vec::new();
    for (i, (name, def)) in joints.into_iter().enumerate() {
        let hook = Vec2::new(3.0 * i as f32, 0.0);
        let weight = RigidBody::dynamic().position(hook - 2.0 * Vec2::Y).shape(Shape::circle(0.3)?);
        let weight = world.add_body(weight.mass(5.0).can_sleep(false))?;
        let joint = world.add_joint(beam, weight, def.anchors(hook, Vec2::ZERO))?;
        weights.push((name, weight, joint));
    }
    for _ in 0..1200 {
        world.step(1.0 / 60.0);
    }
    // A spring gives by g / (2 pi f)^2 = 0.253 m under its weight.
    let lengths = [2.0, 2.253, 2.1, 3.0];
    for ((name, weight, joint), expected) in weights.into_iter().zip(lengths) {
        let length = -world.body(weight).unwrap().position().y;
        let force = world.joint(joint).unwrap().force();
        println!("{name:18} {length:.3} m, pulls with {:.1} N", force.y);
        assert!((length - expected).abs() < 0.005, "{name}: {length}, not {expected}");
        assert!((force.y - 50.0).abs() < 0.5, "{name} holds 5 kg: {force:?}");
    }
    Ok(())
}
