//! Joints that cannot hold what they are to hold.

use super::*;

pub(super) fn all() -> Vec<Patient> {
    vec![
        patient("door with hinges at the wrong places", Code::JointFight, 300, two_hinges()),
        patient("climber with hands too far apart", Code::JointFight, 300, climber()),
        patient("two engines on one axle", Code::JointFight, 300, two_engines()),
        patient("rubber bridge", Code::JointStretch, 300, rubber_bridge()),
        patient("trailer caught behind a bollard", Code::JointStretch, 240, trailer()),
        patient("flagpole welded with a spring", Code::JointStretch, 240, flagpole()),
        patient("drawbridge with limits of the wrong sign", Code::LimitOverrun, 300, drawbridge()),
        patient("drawer rammed past its stop", Code::LimitOverrun, 240, drawer()),
        patient("gate opener that never stops", Code::MotorAtLimit, 400, gate()),
        patient("excavator's boom at its end", Code::MotorAtLimit, 400, boom()),
    ]
}

/// A door of one metre, hung at both ends to a frame that is 1.3 m wide.
fn two_hinges() -> Case {
    let mut world = from_above();
    court(&mut world, 10.0, 8.0);
    pucks(&mut world, 10);
    let frame = add(&mut world, RigidBody::fixed().position(Vec2::new(0.0, 4.0)));
    let door = add(&mut world, plank(0.5, 0.08, 0.0, 4.0));
    for side in [-1.0, 1.0] {
        let (at, end) = (Vec2::new(side * 0.65, 0.0), Vec2::new(side * 0.5, 0.0));
        world.add_joint(frame, door, JointDef::revolute().anchors(at, end)).unwrap();
    }
    left_alone(world)
}

/// Each hand is pinned to a rung, the rungs are 3 m apart, the arms 0.7 m each.
fn climber() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -12.0, 0.0);
    let wall = block(&mut world, 0.0, 6.0, 3.0, 0.1);
    let trunk = add(&mut world, plank(0.25, 0.45, 0.0, 4.6).mass(40.0));
    for side in [-1.0, 1.0] {
        let arm = add(&mut world, plank(0.35, 0.08, side * 0.6, 4.95).mass(4.0));
        let shoulder = JointDef::revolute()
            .anchors(Vec2::new(side * 0.25, 0.35), Vec2::new(-side * 0.35, 0.0));
        world.add_joint(trunk, arm, shoulder).unwrap();
        let grip =
            JointDef::revolute().anchors(Vec2::new(side * 1.5, -0.9), Vec2::new(side * 0.35, 0.0));
        world.add_joint(wall, arm, grip).unwrap();
    }
    left_alone(world)
}

/// A windmill that the game drives at 2 rad/s, and the wind script at -1 rad/s, each with all its might.
fn two_engines() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -12.0, 0.0);
    let tower = block(&mut world, 4.0, 2.5, 0.4, 2.5);
    let cross = RigidBody::dynamic()
        .position(Vec2::new(4.0, 5.0))
        .shape(Shape::rect(2.0, 0.1).unwrap())
        .shape(Shape::rect(0.1, 2.0).unwrap());
    let sails = add(&mut world, cross);
    for speed in [2.0, -1.0] {
        let axle = JointDef::revolute().anchors(Vec2::new(0.0, 2.5), Vec2::ZERO);
        world.add_joint(tower, sails, axle.motor(speed, 1.0e5)).unwrap();
    }
    left_alone(world)
}

/// The author wanted it to sway and made its pins soft: 1 Hz.
fn rubber_bridge() -> Case {
    let mut world = earth();
    block(&mut world, 0.0, -3.0, 30.0, 0.5);
    let mut last = block(&mut world, -7.0, 3.0, 1.0, 0.5);
    let right = block(&mut world, 7.0, 3.0, 1.0, 0.5);
    village(&mut world, -20.0, -2.5);
    let mut hook = Vec2::new(1.0, 0.4);
    for i in 0..12 {
        let board = add(&mut world, plank(0.48, 0.1, -5.5 + i as f32, 3.4));
        let pin = JointDef::revolute().anchors(hook, Vec2::new(-0.5, 0.0)).softness(1.0, 0.7);
        world.add_joint(last, board, pin).unwrap();
        (last, hook) = (board, Vec2::new(0.5, 0.0));
    }
    let pin = JointDef::revolute().anchors(hook, Vec2::new(-1.0, 0.4)).softness(1.0, 0.7);
    world.add_joint(last, right, pin).unwrap();
    add(&mut world, plank(0.6, 0.4, 0.0, 4.0));
    left_alone(world)
}

/// The truck is kinematic and drives on; its trailer cannot.
fn trailer() -> Case {
    let mut world = from_above();
    court(&mut world, 25.0, 8.0);
    pucks(&mut world, 14);
    block(&mut world, 4.0, 4.6, 0.3, 0.5);
    block(&mut world, 4.0, 3.4, 0.3, 0.5);
    let truck = RigidBody::kinematic().position(Vec2::new(3.0, 4.0));
    let truck = truck.shape(Shape::rect(0.8, 0.05).unwrap()).velocity(Vec2::new(1.5, 0.0));
    let truck = add(&mut world, truck);
    let load = add(&mut world, plank(1.0, 0.5, 0.9, 4.0).mass(20.0).damping(1.0, 1.0));
    let hitch = JointDef::revolute().anchors(Vec2::new(-1.0, 0.0), Vec2::new(1.1, 0.0));
    world.add_joint(truck, load, hitch).unwrap();
    left_alone(world)
}

/// The author wanted it to bend, and made a spring of its foot: a cross arm that sags with all it carries.
fn flagpole() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, 12.0, 0.0);
    let tower = block(&mut world, 0.0, 4.0, 0.5, 4.0);
    let arm = add(&mut world, plank(1.5, 0.1, 2.0, 7.0).mass(30.0));
    let foot = JointDef::weld().anchors(Vec2::new(0.5, 3.0), Vec2::new(-1.5, 0.0)).spring(0.7, 0.6);
    world.add_joint(tower, arm, foot).unwrap();
    let lamp = add(&mut world, ball(0.25, 3.3, 5.6).mass(8.0));
    let rope = JointDef::rope(1.4).anchors(Vec2::new(1.3, 0.0), Vec2::ZERO);
    world.add_joint(arm, lamp, rope).unwrap();
    left_alone(world)
}

/// It lies on the bank at angle 0; its range is meant upwards and was written downwards.
fn drawbridge() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -14.0, 0.0);
    let gate = block(&mut world, 0.0, 2.0, 0.5, 2.0);
    block(&mut world, 4.0, 0.5, 2.0, 0.5);
    let deck = add(&mut world, plank(2.5, 0.1, 3.0, 1.11).mass(200.0));
    let hinge = JointDef::revolute()
        .anchors(Vec2::new(0.5, -0.89), Vec2::new(-2.5, 0.0))
        .limits(-1.3, -0.2);
    world.add_joint(gate, deck, hinge).unwrap();
    left_alone(world)
}

/// A kinematic ram pushes a drawer 0.8 m beyond its stop.
fn drawer() -> Case {
    let mut world = from_above();
    court(&mut world, 12.0, 8.0);
    pucks(&mut world, 10);
    let chest = block(&mut world, 0.0, 5.0, 0.5, 0.5);
    let drawer = add(&mut world, plank(0.4, 0.4, 1.0, 5.0).mass(5.0));
    let rails =
        JointDef::prismatic(Vec2::X).anchors(Vec2::new(1.0, 0.0), Vec2::ZERO).limits(0.0, 1.0);
    world.add_joint(chest, drawer, rails).unwrap();
    let ram = RigidBody::kinematic().position(Vec2::new(-4.41, 5.0));
    let ram = add(&mut world, ram.shape(Shape::rect(5.0, 0.3).unwrap()));
    with(world, move |world, step| {
        let speed = if step < 135 { 0.8 } else { 0.0 };
        world.body_mut(ram).unwrap().set_velocity(Vec2::new(speed, 0.0));
    })
}

/// A sliding gate reaches its end after two seconds; the motor goes on.
fn gate() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -12.0, 0.0);
    let post = block(&mut world, 2.0, 1.5, 0.2, 1.5);
    let gate = add(&mut world, plank(1.2, 1.2, 4.0, 1.3).mass(120.0));
    let rail = JointDef::prismatic(Vec2::X)
        .anchors(Vec2::new(2.0, -0.2), Vec2::ZERO)
        .limits(0.0, 2.4)
        .motor(1.2, 5000.0);
    world.add_joint(post, gate, rail).unwrap();
    left_alone(world)
}

fn boom() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -12.0, 0.0);
    let cab = block(&mut world, 2.0, 1.0, 1.0, 1.0);
    let boom = add(&mut world, plank(1.5, 0.15, 4.5, 1.5).mass(300.0));
    let pivot = JointDef::revolute()
        .anchors(Vec2::new(1.0, 0.5), Vec2::new(-1.5, 0.0))
        .limits(-0.4, 1.1)
        .motor(0.8, 4.0e4);
    world.add_joint(cab, boom, pivot).unwrap();
    let bucket = add(&mut world, plank(0.3, 0.3, 6.0, 1.2).mass(60.0));
    let pin = JointDef::revolute().anchors(Vec2::new(1.5, 0.0), Vec2::new(0.0, 0.3));
    world.add_joint(boom, bucket, pin).unwrap();
    left_alone(world)
}
