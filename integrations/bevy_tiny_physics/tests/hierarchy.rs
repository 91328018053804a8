//! Colliders below bodies, and bodies below other things.

mod common;
use bevy_ecs::prelude::*;
use bevy_math::{Quat, Vec2};
use bevy_tiny_physics::prelude::*;
use bevy_transform::prelude::Transform;
use common::*;

/// A dumbbell: two disks below a body, one of them two levels down.
fn dumbbell(app: &mut bevy_app::App) -> (Entity, Entity, Entity) {
    let body = app
        .world_mut()
        .spawn((RigidBody::Dynamic, GravityScale(0.0), Transform::from_xyz(5.0, 0.0, 0.0)))
        .id();
    let left =
        (Collider::circle(0.5), Density(1.0), Transform::from_xyz(-1.0, 0.0, 0.0), ChildOf(body));
    let left = app.world_mut().spawn(left).id();
    let arm = app.world_mut().spawn((Transform::from_xyz(0.5, 0.0, 0.0), ChildOf(body))).id();
    let right =
        (Collider::circle(0.5), Density(1.0), Transform::from_xyz(0.5, 0.0, 0.0), ChildOf(arm));
    (body, left, app.world_mut().spawn(right).id())
}

#[test]
fn colliders_below_a_body_are_its_shapes() {
    let mut app = app();
    let (body, left, right) = dumbbell(&mut app);
    steps(&mut app, 1);
    let physics = physics(&app);
    assert_eq!((physics.world.body_count(), physics.world.shape_count()), (1, 2));
    let mass = physics.body(body).unwrap().mass();
    assert!((mass - 2.0 * 0.25 * core::f32::consts::PI).abs() < 1e-3, "{mass} kg");
    assert_eq!(physics.body_id(left), physics.body_id(body));
    let hit =
        physics.world.ray_cast((6.0, 3.0), (0.0, -5.0), &tiny_physics::QueryFilter::new()).unwrap();
    assert_eq!(physics.collider_entity(hit.shape), Some(right));
    assert!((hit.point.y - 0.5).abs() < 1e-4);
}

#[test]
fn moved_reparented_and_removed_colliders_are_followed() {
    let mut app = app();
    let (body, left, right) = dumbbell(&mut app);
    steps(&mut app, 1);
    app.world_mut().get_mut::<Transform>(left).unwrap().translation.x = -3.0;
    steps(&mut app, 1);
    assert!(
        (physics(&app).body(body).unwrap().local_center().x + 1.0).abs() < 1e-4,
        "the middle of -3 and 1"
    );
    app.world_mut().entity_mut(right).remove::<ChildOf>();
    steps(&mut app, 1);
    assert_eq!(physics(&app).world.body_count(), 2, "a static body of its own");
    assert!((physics(&app).body(body).unwrap().local_center().x + 3.0).abs() < 1e-4);
    app.world_mut().entity_mut(right).insert(ChildOf(body));
    steps(&mut app, 1);
    assert_eq!((physics(&app).world.body_count(), physics(&app).world.shape_count()), (1, 2));
    app.world_mut().despawn(body);
    steps(&mut app, 1);
    assert_eq!((physics(&app).world.body_count(), physics(&app).world.shape_count()), (0, 0));
}

#[test]
fn a_body_that_goes_leaves_its_colliders_static() {
    let mut app = app();
    let (body, _, _) = dumbbell(&mut app);
    steps(&mut app, 1);
    app.world_mut().entity_mut(body).remove::<RigidBody>();
    steps(&mut app, 1);
    assert_eq!((physics(&app).world.body_count(), physics(&app).world.shape_count()), (2, 2));
    app.world_mut().entity_mut(body).insert(RigidBody::Dynamic);
    steps(&mut app, 1);
    assert_eq!((physics(&app).world.body_count(), physics(&app).world.shape_count()), (1, 2));
    assert_eq!(physics(&app).world.validate(), Ok(()));
}

#[test]
fn bodies_below_other_things_keep_their_place_in_the_world() {
    let mut app = app();
    let turned = Transform::from_xyz(10.0, 0.0, 0.0)
        .with_rotation(Quat::from_rotation_z(core::f32::consts::FRAC_PI_2));
    let level = app.world_mut().spawn(turned).id();
    let body = (
        RigidBody::Dynamic,
        Collider::circle(0.5),
        Transform::from_xyz(4.0, 0.0, 0.0),
        ChildOf(level),
    );
    let body = app.world_mut().spawn(body).id();
    steps(&mut app, 1);
    let place = physics(&app).body(body).unwrap().position();
    assert!((place.x - 10.0).abs() < 1e-4 && (place.y - 4.0).abs() < 0.01);
    steps(&mut app, 29);
    let local = common::place(&app, body);
    let world = physics(&app).body(body).unwrap().position();
    assert!(
        world.y < 2.9 && (local - Vec2::new(world.y, 10.0 - world.x)).length() < 1e-4,
        "{local} {world:?}"
    );
}

#[test]
fn a_body_below_a_body_moves_by_itself() {
    let mut app = app();
    let car = app
        .world_mut()
        .spawn((RigidBody::Kinematic, Velocity::linear(2.0, 0.0), Transform::default()))
        .id();
    let wheel = (
        RigidBody::Dynamic,
        Collider::circle(0.5),
        GravityScale(0.0),
        Transform::from_xyz(1.0, 0.0, 0.0),
    );
    let wheel = app.world_mut().spawn((wheel, ChildOf(car))).id();
    steps(&mut app, 60);
    assert!((place(&app, car).x - 2.0).abs() < 1e-4);
    assert!((place(&app, wheel).x + 1.0).abs() < 1e-3, "it stays at 1 in the world");
    assert!((physics(&app).body(wheel).unwrap().position().x - 1.0).abs() < 1e-3);
}

#[test]
fn lone_colliders_follow_what_they_are_below() {
    let mut app = app();
    let level = app.world_mut().spawn(Transform::default()).id();
    let wall = (Collider::rect(1.0, 1.0), Transform::from_xyz(3.0, 0.0, 0.0), ChildOf(level));
    let wall = app.world_mut().spawn(wall).id();
    steps(&mut app, 2);
    app.world_mut().get_mut::<Transform>(level).unwrap().translation.y = 7.0;
    steps(&mut app, 1);
    let at = physics(&app).body(wall).unwrap().position();
    assert_eq!((at.x, at.y), (3.0, 7.0));
}
