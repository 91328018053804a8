//! Bodies: components go in, places and velocities come out, what is removed goes.

mod common;
use bevy_ecs::prelude::*;
use bevy_math::{Quat, Vec2};
use bevy_tiny_physics::prelude::*;
use bevy_transform::prelude::Transform;
use common::*;

#[test]
fn falls_as_galileo_says_and_comes_to_rest() {
    let mut app = app();
    ground(&mut app);
    let ball = ball(&mut app, 3.0, 10.0);
    app.world_mut().entity_mut(ball).insert(Velocity::default());
    steps(&mut app, 30);
    let fallen = 10.0 - place(&app, ball).y;
    assert!((fallen - 1.25).abs() < 0.05, "{fallen} m in half a second");
    assert!((app.world().get::<Velocity>(ball).unwrap().linear.y + 5.0).abs() < 0.1);
    steps(&mut app, 300);
    assert!((place(&app, ball) - Vec2::new(3.0, 0.5)).length() < 0.01);
    assert_eq!(*app.world().get::<Velocity>(ball).unwrap(), Velocity::default());
}

#[test]
fn components_are_heard_when_they_change_and_when_they_go() {
    let mut app = app();
    let ball = ball(&mut app, 0.0, 0.0);
    app.world_mut().entity_mut(ball).insert((
        GravityScale(0.0),
        Velocity::linear(1.0, 0.0),
        LockedAxes::ROTATION,
    ));
    steps(&mut app, 60);
    assert!((place(&app, ball) - Vec2::new(1.0, 0.0)).length() < 1e-3);
    assert!(physics(&app).body(ball).unwrap().locks().rotation);
    app.world_mut().entity_mut(ball).remove::<(GravityScale, LockedAxes)>();
    app.world_mut().entity_mut(ball).insert(Mass(7.0));
    steps(&mut app, 1);
    let body = physics(&app).body(ball).unwrap();
    assert_eq!((body.gravity_scale(), body.mass(), body.locks().rotation), (1.0, 7.0, false));
    app.world_mut().get_mut::<Velocity>(ball).unwrap().linear = Vec2::new(0.0, 5.0);
    steps(&mut app, 1);
    assert!(physics(&app).body(ball).unwrap().velocity().y > 4.5);
    *app.world_mut().get_mut::<RigidBody>(ball).unwrap() = RigidBody::Static;
    steps(&mut app, 1);
    let before = place(&app, ball);
    steps(&mut app, 10);
    assert_eq!(place(&app, ball), before);
}

#[test]
fn a_transform_teleports_and_keeps_its_depth() {
    let mut app = app();
    let ball = ball(&mut app, 0.0, 0.0);
    steps(&mut app, 5);
    let mut transform = app.world_mut().get_mut::<Transform>(ball).unwrap();
    *transform = Transform::from_xyz(7.0, 8.0, 3.0).with_rotation(Quat::from_rotation_z(1.0));
    steps(&mut app, 1);
    let transform = *app.world().get::<Transform>(ball).unwrap();
    assert!((transform.translation.truncate() - Vec2::new(7.0, 8.0)).length() < 0.1);
    assert_eq!(transform.translation.z, 3.0);
    assert!((physics(&app).body(ball).unwrap().angle() - 1.0).abs() < 1e-5);
    assert!(physics(&app).body(ball).unwrap().velocity().y < -0.9, "it keeps its speed");
}

#[test]
fn what_goes_takes_its_body_along() {
    let mut app = app();
    ground(&mut app);
    let (a, b, c) = (ball(&mut app, 0.0, 0.5), ball(&mut app, 2.0, 0.5), ball(&mut app, 4.0, 0.5));
    steps(&mut app, 2);
    assert_eq!(physics(&app).world.body_count(), 4);
    app.world_mut().despawn(a);
    app.world_mut().entity_mut(b).remove::<(RigidBody, Collider)>();
    app.world_mut().entity_mut(c).remove::<Collider>();
    steps(&mut app, 1);
    let physics = physics(&app);
    assert_eq!((physics.world.body_count(), physics.world.shape_count()), (2, 1));
    assert!(physics.body(a).is_none() && physics.body(b).is_none() && physics.body(c).is_some());
    assert_eq!(physics.world.validate(), Ok(()));
}

#[test]
fn a_collider_without_a_body_stands_still_until_it_gets_one() {
    let mut app = app();
    let block =
        app.world_mut().spawn((Collider::rect(1.0, 1.0), Transform::from_xyz(0.0, 5.0, 0.0))).id();
    steps(&mut app, 10);
    assert_eq!(place(&app, block), Vec2::new(0.0, 5.0));
    app.world_mut().entity_mut(block).insert(RigidBody::Dynamic);
    steps(&mut app, 10);
    assert!(place(&app, block).y < 4.95);
    assert_eq!(physics(&app).world.body_count(), 1);
    app.world_mut().entity_mut(block).remove::<RigidBody>();
    steps(&mut app, 2);
    let before = place(&app, block);
    steps(&mut app, 10);
    assert_eq!(place(&app, block), before);
    assert_eq!((physics(&app).world.body_count(), physics(&app).world.shape_count()), (1, 1));
}

#[test]
fn pushes_push() {
    let mut app = app();
    let ball = ball(&mut app, 0.0, 0.0);
    let push = ExternalImpulse { impulse: Vec2::new(6.0, 0.0), angular: 0.0 };
    app.world_mut().entity_mut(ball).insert((Mass(2.0), GravityScale(0.0), push));
    steps(&mut app, 1);
    assert_eq!(physics(&app).body(ball).unwrap().velocity().x, 3.0);
    assert_eq!(*app.world().get::<ExternalImpulse>(ball).unwrap(), ExternalImpulse::default());
    app.world_mut()
        .entity_mut(ball)
        .insert(ExternalForce { force: Vec2::new(-6.0, 0.0), torque: 0.0 });
    steps(&mut app, 60);
    assert!(physics(&app).body(ball).unwrap().velocity().x.abs() < 1e-3);
}

#[test]
fn a_lift_takes_along_what_stands_on_it() {
    let mut app = app();
    let lift = (
        RigidBody::Kinematic,
        Collider::rect(2.0, 0.25),
        Transform::default(),
        KinematicTarget::default(),
    );
    let lift = app.world_mut().spawn(lift).id();
    let load = ball(&mut app, 0.0, 0.75);
    for step in 1..=120 {
        let position = Vec2::new(0.0, step as f32 / 60.0);
        app.world_mut().entity_mut(lift).insert(KinematicTarget { position, angle: 0.0 });
        steps(&mut app, 1);
    }
    assert!((place(&app, lift).y - 2.0).abs() < 1e-3);
    assert!((place(&app, load).y - 2.75).abs() < 0.02);
}

#[test]
fn a_scaled_entity_has_scaled_shapes() {
    let mut app = app();
    let at = Transform::from_xyz(0.0, 0.0, 0.0).with_scale(bevy_math::Vec3::new(3.0, 2.0, 1.0));
    let block = app
        .world_mut()
        .spawn((RigidBody::Dynamic, Collider::rect(0.5, 0.5), Density(1.0), at))
        .id();
    steps(&mut app, 1);
    assert!((physics(&app).body(block).unwrap().mass() - 6.0).abs() < 1e-3);
    app.world_mut().get_mut::<Transform>(block).unwrap().scale.y = 1.0;
    steps(&mut app, 2);
    assert!((physics(&app).body(block).unwrap().mass() - 3.0).abs() < 1e-3);
}

#[test]
fn pushes_through_the_world_are_kept_where_velocity_is_told() {
    let mut app = app();
    let ball = ball(&mut app, 0.0, 0.0);
    app.world_mut().entity_mut(ball).insert((Velocity::default(), Mass(2.0)));
    steps(&mut app, 5);
    let mut physics = app.world_mut().resource_mut::<PhysicsWorld>();
    physics.body_mut(ball).unwrap().apply_impulse_to_center(tiny_physics::Vec2::new(6.0, 0.0));
    steps(&mut app, 1);
    assert_eq!(app.world().get::<Velocity>(ball).unwrap().linear.x, 3.0);
    let frame = common::physics(&app).clone();
    app.world_mut().get_mut::<Velocity>(ball).unwrap().linear = Vec2::ZERO;
    steps(&mut app, 1);
    assert_eq!(common::physics(&app).body(ball).unwrap().velocity().x, 0.0, "what is said counts");
    let mut physics = app.world_mut().resource_mut::<PhysicsWorld>();
    physics.clone_from(&frame);
    physics.body_mut(ball).unwrap().apply_impulse_to_center(tiny_physics::Vec2::new(6.0, 0.0));
    steps(&mut app, 1);
    assert_eq!(app.world().get::<Velocity>(ball).unwrap().linear.x, 6.0, "in a copy, too");
    let told = *app.world().get::<Velocity>(ball).unwrap();
    app.world_mut().entity_mut(ball).remove::<Velocity>();
    steps(&mut app, 1);
    app.world_mut().entity_mut(ball).insert(told);
    steps(&mut app, 1);
    let fall = app.world().get::<Velocity>(ball).unwrap().linear.y - told.linear.y;
    assert!((fall + 10.0 / 60.0).abs() < 1e-4, "what comes again is heard");
}

#[test]
fn a_target_that_is_no_place_leaves_the_body_where_it_is() {
    let mut app = app();
    let at = Transform::from_xyz(3.0, 4.0, 0.0).with_rotation(Quat::from_rotation_z(0.5));
    let nowhere = KinematicTarget { position: Vec2::new(f32::NAN, 0.0), angle: 0.0 };
    let lift = (RigidBody::Kinematic, Collider::rect(2.0, 0.25), at, nowhere);
    let lift = app.world_mut().spawn(lift).id();
    steps(&mut app, 3);
    assert!((place(&app, lift) - Vec2::new(3.0, 4.0)).length() < 1e-4, "{}", place(&app, lift));
    assert!((physics(&app).body(lift).unwrap().angle() - 0.5).abs() < 1e-4);
    let target = app.world().get::<KinematicTarget>(lift).unwrap();
    assert!((target.position - Vec2::new(3.0, 4.0)).length() < 1e-4, "{target:?}");
    assert!((target.angle - 0.5).abs() < 1e-4, "{target:?}");
    assert_eq!(messages::<PhysicsProblem>(&app).len(), 1);
}

#[test]
fn what_is_placed_through_the_world_is_shown_there_though_it_rests() {
    for kind in [RigidBody::Static, RigidBody::Kinematic, RigidBody::Dynamic] {
        let mut app = app();
        let body = app.world_mut().spawn((kind, GravityScale(0.0))).id();
        let part = app.world_mut().spawn((Collider::circle(0.5), ChildOf(body))).id();
        steps(&mut app, 2);
        for (at, by) in [(7.0, body), (8.0, part)] {
            let mut physics = app.world_mut().resource_mut::<PhysicsWorld>();
            physics.body_mut(by).unwrap().set_position((at, 1.0));
            steps(&mut app, 1);
            assert_eq!(place(&app, body), Vec2::new(at as f32, 1.0), "{kind:?}");
        }
        app.world_mut().get_mut::<Transform>(body).unwrap().translation.x = 2.0;
        steps(&mut app, 1);
        assert_eq!(
            physics(&app).body(body).unwrap().position().x,
            2.0,
            "transforms still teleport"
        );
    }
}
