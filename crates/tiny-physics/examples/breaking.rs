//! A tray on two chains, loaded until one breaks: thresholds, the event, and the load before it.
//! `cargo run -p tiny-physics --example breaking`

use tiny_physics::{Error, JointDef, RigidBody, Shape, Vec2, World};

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let hook = world.add_body(RigidBody::fixed())?;
    // What sleeps has no loads to read.
    let tray = RigidBody::dynamic().shape(Shape::rect(1.0, 0.1)?).mass(2.0).can_sleep(false);
    let tray = world.add_body(tray)?;
    let chain = |x: f32| {
        let (top, bottom) = (Vec2::new(x, 5.0), Vec2::new(x, 0.0));
        JointDef::rope(5.0).anchors(top, bottom).break_at(100.0, f32::MAX)
    };
    let left = world.add_joint(hook, tray, chain(-1.0))?;
    world.add_joint(hook, tray, chain(1.0).user_data(7))?;

    // A brick of 2 kg a second, onto the right half.
    let mut broke_after = None;
    for second in 1..=12 {
        let brick = RigidBody::dynamic().position(Vec2::new(0.6, 0.2 * second as f32));
        world.add_body(brick.shape(Shape::rect(0.3, 0.1)?).mass(2.0))?;
        for _ in 0..60 {
            world.step(1.0 / 60.0);
            for broken in world.events().joint_breaks() {
                println!("chain {} gave way at {:.0} N", broken.user_data, broken.force.length());
                broke_after.get_or_insert((second, broken.user_data));
                assert!(broken.force.length() > 100.0);
                assert!(world.joint(broken.joint).is_none(), "its handle is stale");
            }
        }
        match world.joint(left) {
            Some(joint) if broke_after.is_none() => {
                println!("{second} bricks: {:.0} N on the left chain", joint.force().length());
            }
            _ => break,
        }
    }
    // Half of 20 N and 4/5 of each brick: more than 100 N at rest with six, and with five when the fifth lands.
    let (bricks, chain) = broke_after.expect("the tray does not hold twelve bricks");
    assert_eq!(chain, 7, "the right one bears more");
    assert!((5..=6).contains(&bricks), "{bricks}");
    Ok(())
}
