//! Characters walk, are seen by sensors, and stand on what they tell.

mod common;
use bevy_tiny_physics::prelude::*;
use bevy_transform::prelude::Transform;
use common::*;

#[test]
fn walks_jumps_picks_up_and_tells_its_ground() {
    let mut app = app();
    let ground = ground(&mut app);
    let coin = app
        .world_mut()
        .spawn((Collider::circle(0.2), Sensor, Transform::from_xyz(3.0, 1.0, 0.0)))
        .id();
    let hero =
        app.world_mut().spawn((Character::new(1.8, 0.3), Transform::from_xyz(0.0, 1.0, 0.0))).id();
    steps(&mut app, 10);
    let state = *app.world().get::<CharacterState>(hero).unwrap();
    assert_eq!((state.grounded, state.ground), (true, Some(ground)));
    app.world_mut().get_mut::<CharacterInput>(hero).unwrap().walk = 4.0;
    steps(&mut app, 60);
    assert!((place(&app, hero).x - 4.0).abs() < 0.1);
    let found = messages::<SensorEntered>(&app);
    assert!(
        found.iter().any(|event| event.sensor_body == hero && event.visitor == coin),
        "{found:?}"
    );
    app.world_mut().get_mut::<CharacterInput>(hero).unwrap().jump = 6.0;
    steps(&mut app, 5);
    assert_eq!(app.world().get::<CharacterInput>(hero).unwrap().jump, 0.0, "used up");
    assert!(!app.world().get::<CharacterState>(hero).unwrap().grounded);
    app.world_mut().get_mut::<Transform>(hero).unwrap().translation.x = -9.0;
    steps(&mut app, 1);
    assert!(place(&app, hero).x < -8.0, "teleported");
    app.world_mut().despawn(hero);
    steps(&mut app, 1);
    assert_eq!(physics(&app).world.body_count(), 2);
}

#[test]
fn is_moved_by_hand_along_what_is_in_its_way() {
    let mut app = app();
    ground(&mut app);
    app.world_mut().spawn((Collider::rect(0.5, 2.0), Transform::from_xyz(4.0, 2.0, 0.0)));
    let hero =
        app.world_mut().spawn((Character::new(1.8, 0.3), Transform::from_xyz(0.0, 9.0, 0.0))).id();
    steps(&mut app, 30);
    assert!(app.world().get::<CharacterState>(hero).unwrap().velocity.y < -4.0);
    let mut physics = app.world_mut().resource_mut::<PhysicsWorld>();
    let (mover, world) = physics.character_in_world(hero).unwrap();
    let down = mover.move_by(world, (0.0, -20.0));
    let along = mover.move_by(world, (9.0, 0.0));
    assert!(down.y < -5.0 && (along.x - 3.2).abs() < 0.05, "{down:?} {along:?}");
    steps(&mut app, 1);
    assert!((place(&app, hero) - bevy_math::Vec2::new(3.2, 0.9)).length() < 0.05);
    let state = *app.world().get::<CharacterState>(hero).unwrap();
    assert!(state.grounded && state.velocity.y == 0.0);
}

#[test]
fn ducks_only_where_there_is_room_to_get_up() {
    let mut app = app();
    ground(&mut app);
    app.world_mut().spawn((Collider::rect(5.0, 0.5), Transform::from_xyz(0.0, 1.7, 0.0)));
    let hero =
        app.world_mut().spawn((Character::new(1.0, 0.3), Transform::from_xyz(0.0, 0.6, 0.0))).id();
    steps(&mut app, 10);
    app.world_mut().get_mut::<Character>(hero).unwrap().height = 1.8;
    steps(&mut app, 1);
    assert_eq!(messages::<PhysicsProblem>(&app)[0].what, "character");
    assert_eq!(physics(&app).character(hero).unwrap().height, 1.0);
}
