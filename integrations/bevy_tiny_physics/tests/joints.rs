//! Joints stay where they were made.

mod common;
use bevy_math::{Quat, Vec2};
use bevy_tiny_physics::prelude::*;
use bevy_transform::prelude::Transform;
use common::*;

/// Anchors that are points of the world are where the bodies were joined, also when a motor is set after these have moved.
#[test]
fn a_motor_that_is_set_moves_no_anchors() {
    let mut app = app();
    ground(&mut app);
    let turned = Transform::from_xyz(0.0, 5.0, 0.0).with_rotation(Quat::from_rotation_z(0.3));
    let cart = app.world_mut().spawn((RigidBody::Dynamic, Collider::rect(1.0, 0.2), turned)).id();
    let arm = (RigidBody::Dynamic, Collider::rect(1.0, 0.1), Transform::from_xyz(1.0, 5.0, 0.0));
    let arm = app.world_mut().spawn(arm).id();
    let hinge = JointDef::revolute().anchor_at((0.5, 5.0)).motor(1.0, 100.0);
    let hinge = app.world_mut().spawn(Joint::new(cart, arm, hinge)).id();
    steps(&mut app, 30);
    assert!(place(&app, cart).y < 4.5, "both have fallen");
    let made = |app: &bevy_app::App| *physics(app).joint(hinge).unwrap().def();
    let (before, angle) = (made(&app), physics(&app).joint(hinge).unwrap().angle());
    let change = |app: &mut bevy_app::App, change: &dyn Fn(JointDef) -> JointDef| {
        let mut joint = app.world_mut().get_mut::<Joint>(hinge).unwrap();
        joint.def = change(joint.def);
    };
    change(&mut app, &|def| def.motor(-1.0, 100.0));
    steps(&mut app, 1);
    assert_eq!(made(&app), before.motor(-1.0, 100.0));
    assert!((physics(&app).joint(hinge).unwrap().angle() - angle).abs() < 0.05);
    // Angles are changed by what they are changed by; other points are other anchors.
    change(&mut app, &|def| def.angles(0.0, def.angle_b + 0.1));
    steps(&mut app, 1);
    assert_eq!(made(&app).angle_b, before.angle_b + 0.1);
    let now = place(&app, cart);
    change(&mut app, &|def| def.anchor_at((f64::from(now.x), f64::from(now.y))));
    steps(&mut app, 1);
    let offset = made(&app).anchor_a;
    assert!(Vec2::new(offset.x, offset.y).length() < 0.05, "{offset:?}");
}
