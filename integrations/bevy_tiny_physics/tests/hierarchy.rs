//! Colliders below bodies, and bodies below other things.

mod common;
use bevy_ecs::prelude::*;
use bevy_math::{Quat, Vec2, Vec3};
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

/// Where a ray straight down meets something.
fn height(app: &bevy_app::App, x: f32) -> f32 {
    let filter = tiny_physics::QueryFilter::new();
    physics(app).world.ray_cast((f64::from(x), 5.0), (0.0, -10.0), &filter).unwrap().point.y as f32
}

#[test]
fn below_what_is_mirrored_colliders_turn_the_other_way() {
    let mut app = app();
    let mirror = Transform::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    let turned = Transform::from_rotation(Quat::from_rotation_z(0.5));
    let body = app.world_mut().spawn((RigidBody::Static, mirror)).id();
    let plank = app.world_mut().spawn((Collider::rect(1.0, 0.1), turned, ChildOf(body))).id();
    steps(&mut app, 1);
    let tilted = |x: f32| (0.1 / 0.5_f32.cos()) - x * 0.5_f32.tan();
    assert!((height(&app, 0.5) - tilted(0.5)).abs() < 1e-4, "{}", height(&app, 0.5));
    // Likewise where it stands alone, and where the shape itself is turned.
    app.world_mut().entity_mut(body).remove::<RigidBody>();
    steps(&mut app, 1);
    assert!((height(&app, 0.5) - tilted(0.5)).abs() < 1e-4, "{}", height(&app, 0.5));
    app.world_mut().despawn(plank);
    let shape =
        tiny_physics::ShapeDef { angle: 0.5, ..Collider::rect(1.0, 0.1).shapes()[0].clone() };
    let plank = (RigidBody::Static, Collider::from(shape), OneWay(Vec2::new(1.0, 0.5)), mirror);
    let plank = app.world_mut().spawn(plank).id();
    steps(&mut app, 1);
    assert!((height(&app, 0.5) - tilted(0.5)).abs() < 1e-4, "{}", height(&app, 0.5));
    let id = physics(&app).shape_ids(plank).next().unwrap();
    let way = physics(&app).world.shape(id).unwrap().one_way().unwrap();
    assert!(way.x < -0.4 && way.y > 0.2, "{way:?}");
}

#[test]
fn bodies_below_what_is_mirrored_keep_their_place_in_the_world() {
    let mut app = app();
    let mirror = Transform::from_xyz(2.0, 0.0, 0.0).with_scale(Vec3::new(-1.0, 1.0, 1.0));
    let level = app.world_mut().spawn(mirror).id();
    let turned = Transform::from_xyz(3.0, 0.0, 0.0).with_rotation(Quat::from_rotation_z(0.5));
    let body = (RigidBody::Kinematic, Velocity { linear: Vec2::X, angular: 1.0 }, turned);
    let body = app.world_mut().spawn((body, ChildOf(level))).id();
    steps(&mut app, 1);
    let is = physics(&app).body(body).unwrap();
    assert!((is.position().x + 1.0 - 1.0 / 60.0).abs() < 1e-4, "{:?}", is.position());
    assert!((is.angle() + 0.5 - 1.0 / 60.0).abs() < 1e-4, "{}", is.angle());
    steps(&mut app, 29);
    let shown = app.world().get::<Transform>(body).unwrap();
    assert!((shown.translation.x - 2.5).abs() < 1e-3, "{}", shown.translation);
    assert!(shown.rotation.angle_between(Quat::IDENTITY) < 1e-3, "{}", shown.rotation);
}

#[test]
fn a_body_taken_off_its_parent_is_shown_where_it_is_though_it_rests() {
    let mut app = app();
    let turned = Transform::from_xyz(10.0, 0.0, 0.0)
        .with_rotation(Quat::from_rotation_z(core::f32::consts::FRAC_PI_2));
    let level = app.world_mut().spawn(turned).id();
    let wall = (RigidBody::Static, Collider::rect(1.0, 1.0), Transform::from_xyz(4.0, 0.0, 0.0));
    let wall = app.world_mut().spawn((wall, ChildOf(level))).id();
    steps(&mut app, 2);
    app.world_mut().entity_mut(wall).remove::<ChildOf>();
    steps(&mut app, 1);
    let at = physics(&app).body(wall).unwrap().position();
    assert!((at.x - 10.0).abs() < 1e-4 && (at.y - 4.0).abs() < 1e-4, "{at:?}");
    let shown = app.world().get::<Transform>(wall).unwrap();
    assert!((shown.translation.truncate() - Vec2::new(10.0, 4.0)).length() < 1e-4, "{shown:?}");
    assert!(shown.rotation.angle_between(turned.rotation) < 1e-3, "{shown:?}");
}
