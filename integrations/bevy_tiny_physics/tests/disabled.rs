//! Entities that Bevy's `Disabled` is on take no part, and come back as they were.

mod common;
use bevy_app::App;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::*;
use bevy_math::Vec2;
use bevy_tiny_physics::prelude::*;
use bevy_transform::prelude::Transform;
use common::*;
use tiny_physics::{QueryFilter, TileGrid};

fn disable(app: &mut App, entity: Entity) {
    app.world_mut().entity_mut(entity).insert(Disabled);
}

fn enable(app: &mut App, entity: Entity) {
    app.world_mut().entity_mut(entity).remove::<Disabled>();
}

/// A dumbbell that turns as it flies: a disk on the body, one below it.
fn dumbbell(app: &mut App) -> (Entity, Entity) {
    let motion = Velocity { linear: Vec2::new(1.3, 0.4), angular: 2.1 };
    let body = (RigidBody::Dynamic, Collider::circle(0.5), GravityScale(0.0), motion);
    let body = app.world_mut().spawn((body, Transform::from_xyz(0.0, 20.0, 0.0))).id();
    let part = (Collider::circle(0.3), Transform::from_xyz(1.0, 0.2, 0.0), ChildOf(body));
    (body, app.world_mut().spawn(part).id())
}

/// Is something there?
fn is_met(app: &App, x: f64, y: f64) -> bool {
    !physics(app).world.overlap_point((x, y), &QueryFilter::new()).is_empty()
}

#[test]
fn nothing_touches_a_disabled_body_until_it_is_enabled() {
    let mut app = app();
    let floor = ground(&mut app);
    let low = ball(&mut app, 0.0, 1.0);
    steps(&mut app, 60);
    disable(&mut app, floor);
    steps(&mut app, 60);
    assert!(place(&app, low).y < -1.0, "the floor is no more: {}", place(&app, low));
    enable(&mut app, floor);
    let high = ball(&mut app, 3.0, 1.0);
    steps(&mut app, 120);
    assert!((place(&app, high).y - 0.5).abs() < 0.01, "it holds again: {}", place(&app, high));
    assert_eq!(physics(&app).world.validate(), Ok(()));
}

#[test]
fn a_disabled_body_keeps_place_velocity_and_shapes() {
    for whole in [false, true] {
        let mut app = app();
        let (body, part) = dumbbell(&mut app);
        steps(&mut app, 7);
        let frame = |app: &App| {
            let is = physics(app).body(body).unwrap();
            let shapes: Vec<_> = is.shapes().collect();
            let transform = *app.world().get::<Transform>(body).unwrap();
            let velocity = *app.world().get::<Velocity>(body).unwrap();
            (is.pose(), is.velocity(), is.angular_velocity(), shapes, transform, velocity)
        };
        let before = frame(&app);
        let next = {
            let mut twin = physics(&app).world.clone();
            twin.step(1.0 / 60.0);
            twin.body(physics(&app).body_id(body).unwrap()).unwrap().pose()
        };
        match whole {
            true => app.world_mut().entity_mut(body).insert_recursive::<Children>(Disabled),
            false => app.world_mut().entity_mut(body).insert(Disabled),
        };
        steps(&mut app, 20);
        assert!(!physics(&app).body(body).unwrap().is_enabled());
        assert_eq!(frame(&app), before, "{whole}");
        match whole {
            true => app.world_mut().entity_mut(body).remove_recursive::<Children, Disabled>(),
            false => app.world_mut().entity_mut(body).remove::<Disabled>(),
        };
        steps(&mut app, 1);
        let after = frame(&app);
        assert_eq!((after.0, after.1, after.2), (next, before.1, before.2), "{whole}");
        assert_eq!(after.3, before.3);
        assert_eq!(physics(&app).shape_ids(part).count(), 1);
    }
}

#[test]
fn a_disabled_collider_is_no_part_of_its_body() {
    let mut app = app();
    let (body, part) = dumbbell(&mut app);
    steps(&mut app, 1);
    let mass = |app: &App| physics(app).body(body).unwrap().mass();
    let (both, shapes) =
        (mass(&app), |app: &App, part| physics(app).shape_ids(part).collect::<Vec<_>>());
    disable(&mut app, part);
    steps(&mut app, 1);
    assert!(shapes(&app, part).is_empty() && mass(&app) < 0.8 * both);
    // Whichever of the two comes back first.
    disable(&mut app, body);
    steps(&mut app, 1);
    enable(&mut app, body);
    steps(&mut app, 1);
    assert!(shapes(&app, part).is_empty() && physics(&app).body(body).unwrap().is_enabled());
    enable(&mut app, part);
    steps(&mut app, 1);
    assert!((mass(&app) - both).abs() < 1e-4 && shapes(&app, part).len() == 1);
    disable(&mut app, body);
    disable(&mut app, part);
    steps(&mut app, 1);
    enable(&mut app, body);
    steps(&mut app, 1);
    assert!(shapes(&app, part).is_empty(), "the collider is disabled still");
    enable(&mut app, part);
    steps(&mut app, 1);
    assert_eq!((shapes(&app, part).len(), physics(&app).world.body_count()), (1, 1));
    assert_eq!(physics(&app).world.validate(), Ok(()));
}

#[test]
fn lone_colliders_and_tile_maps_are_disabled_too() {
    let mut app = app();
    let block = (Collider::rect(1.0, 1.0), Transform::from_xyz(0.0, 0.0, 0.0));
    let block = app.world_mut().spawn(block).id();
    let grid = TileGrid::parse(1.0, &["####"]).unwrap();
    let grid = TileGrid { position: tiny_physics::DVec2::new(4.0, 0.0), ..grid };
    let tiles = app.world_mut().spawn(TileMap(grid)).id();
    for entity in [block, tiles] {
        let x = if entity == block { 0.5 } else { 5.5 };
        steps(&mut app, 1);
        assert!(is_met(&app, x, 0.5));
        disable(&mut app, entity);
        steps(&mut app, 1);
        assert!(!is_met(&app, x, 0.5));
        let frame = physics(&app).clone();
        app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
        steps(&mut app, 1);
        assert!(!is_met(&app, x, 0.5), "nor in a copy");
        enable(&mut app, entity);
        steps(&mut app, 1);
        assert!(is_met(&app, x, 0.5));
        app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
        steps(&mut app, 1);
        assert!(is_met(&app, x, 0.5), "what is enabled by now is so in a copy");
    }
    for entity in [block, tiles] {
        disable(&mut app, entity);
        app.world_mut().despawn(entity);
    }
    steps(&mut app, 1);
    assert_eq!(physics(&app).world.body_count(), 0);
}

#[test]
fn what_is_spawned_disabled_is_there_once_enabled() {
    let mut app = app();
    let body = (RigidBody::Dynamic, Collider::circle(0.5), Transform::from_xyz(0.0, 9.0, 0.0));
    let body = app.world_mut().spawn((body, Disabled)).id();
    let hero = (Character::new(1.8, 0.3), Transform::from_xyz(-4.0, 5.0, 0.0));
    let hero = app.world_mut().spawn((hero, Disabled)).id();
    let block = app.world_mut().spawn((Collider::rect(1.0, 1.0), Disabled)).id();
    steps(&mut app, 20);
    assert!(!is_met(&app, 0.0, 0.0) && !is_met(&app, 0.0, 9.0));
    assert_eq!((place(&app, body), place(&app, hero)), (Vec2::new(0.0, 9.0), Vec2::new(-4.0, 5.0)));
    for entity in [body, hero, block] {
        enable(&mut app, entity);
    }
    steps(&mut app, 20);
    assert!(is_met(&app, 0.0, 0.0));
    assert!(place(&app, body).y < 8.9 && place(&app, hero).y < 4.9);
}

#[test]
fn what_goes_while_it_is_disabled_is_gone() {
    let mut app = app();
    let (body, part) = dumbbell(&mut app);
    let other = ball(&mut app, 5.0, 5.0);
    steps(&mut app, 2);
    app.world_mut().entity_mut(body).insert_recursive::<Children>(Disabled);
    disable(&mut app, other);
    steps(&mut app, 2);
    app.world_mut().entity_mut(other).remove::<RigidBody>();
    steps(&mut app, 1);
    assert!(!is_met(&app, 5.0, 5.0), "a lone collider is disabled as well");
    app.world_mut().despawn(part);
    steps(&mut app, 1);
    assert_eq!(physics(&app).body(body).unwrap().shapes().count(), 1);
    app.world_mut().despawn(body);
    app.world_mut().despawn(other);
    steps(&mut app, 1);
    assert_eq!((physics(&app).world.body_count(), physics(&app).world.shape_count()), (0, 0));
    // Disabled and despawned between the same two steps.
    let short = ball(&mut app, 0.0, 0.0);
    steps(&mut app, 1);
    disable(&mut app, short);
    app.world_mut().despawn(short);
    steps(&mut app, 1);
    assert_eq!(physics(&app).world.body_count(), 0);
}

#[test]
fn what_is_said_while_disabled_is_heard() {
    let mut app = app();
    let (body, part) = dumbbell(&mut app);
    steps(&mut app, 2);
    app.world_mut().entity_mut(body).insert_recursive::<Children>(Disabled);
    steps(&mut app, 2);
    let mut world = app.world_mut();
    world.get_mut::<Transform>(body).unwrap().translation = bevy_math::Vec3::new(7.0, 8.0, 0.0);
    *world.get_mut::<Velocity>(body).unwrap() = Velocity::linear(0.0, 3.0);
    world.entity_mut(body).insert(LockedAxes::ROTATION).remove::<GravityScale>();
    *world.get_mut::<Collider>(part).unwrap() = Collider::circle(0.125);
    steps(&mut app, 2);
    world = app.world_mut();
    world.entity_mut(body).remove_recursive::<Children, Disabled>();
    steps(&mut app, 1);
    let is = physics(&app).body(body).unwrap();
    assert!((place(&app, body) - Vec2::new(7.0, 8.0)).length() < 0.1, "{}", place(&app, body));
    assert!((is.velocity().y - (3.0 - 10.0 / 60.0)).abs() < 1e-3, "{:?}", is.velocity());
    assert_eq!((is.gravity_scale(), is.locks().rotation), (1.0, true));
    let shape = physics(&app).shape_ids(part).next().unwrap();
    let shape = physics(&app).world.shape(shape).unwrap();
    assert_eq!(*shape.shape(), tiny_physics::Shape::circle(0.125).unwrap());
}

#[test]
fn joints_wait_for_disabled_bodies_and_are_disabled_themselves() {
    let mut app = app();
    let hook = app.world_mut().spawn((RigidBody::Static, Transform::from_xyz(0.0, 9.0, 0.0))).id();
    let lamp = ball(&mut app, 0.0, 8.0);
    let rod = Joint::new(hook, lamp, JointDef::revolute().anchor_at((0.0, 9.0)));
    let rod = app.world_mut().spawn(rod).id();
    steps(&mut app, 60);
    let id = physics(&app).joint_id(rod);
    let held = |app: &App| (place(app, lamp) - Vec2::new(0.0, 8.0)).length() < 0.05;
    assert!(held(&app) && id.is_some());
    for entity in [hook, lamp] {
        disable(&mut app, entity);
        steps(&mut app, 3);
        enable(&mut app, entity);
        steps(&mut app, 60);
        assert!(held(&app), "{}", place(&app, lamp));
    }
    disable(&mut app, rod);
    steps(&mut app, 20);
    assert!(place(&app, lamp).y < 7.7, "it falls: {}", place(&app, lamp));
    let frame = physics(&app).clone();
    app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
    steps(&mut app, 10);
    assert!(place(&app, lamp).y < 7.2, "and goes on in a copy: {}", place(&app, lamp));
    enable(&mut app, rod);
    steps(&mut app, 120);
    let length = (place(&app, lamp) - Vec2::new(0.0, 9.0)).length();
    assert!((length - 1.0).abs() < 0.05, "joined where it was: {length}");
    assert_eq!(physics(&app).joint_id(rod), id);
    disable(&mut app, rod);
    app.world_mut().despawn(rod);
    steps(&mut app, 1);
    assert_eq!(physics(&app).world.joint_count(), 0);
}

/// A joint that was disabled when a copy was made and broke since is on its entity again as the game wrote it.
#[test]
fn a_disabled_joint_comes_back_from_a_copy_as_it_was_said() {
    let mut app = app();
    let hook = app.world_mut().spawn((RigidBody::Static, Transform::from_xyz(0.0, 9.0, 0.0))).id();
    let lamp = ball(&mut app, 0.0, 8.0);
    let rope = Joint::new(hook, lamp, JointDef::rope(1.5).break_at(5.0, f32::MAX));
    let joint = app.world_mut().spawn((rope.clone(), Disabled)).id();
    steps(&mut app, 2);
    let frame = physics(&app).clone();
    enable(&mut app, joint);
    steps(&mut app, 90);
    assert!(app.world().get::<Joint>(joint).is_none(), "it broke");
    app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
    steps(&mut app, 1);
    assert_eq!(*app.world().get::<Joint>(joint).unwrap(), rope);
}

#[test]
fn a_disabled_character_stands_still_and_is_not_seen() {
    let mut app = app();
    ground(&mut app);
    let hero = (Character::new(1.8, 0.3), Transform::from_xyz(0.0, 0.9, 0.0));
    let hero = app.world_mut().spawn(hero).id();
    app.world_mut().get_mut::<CharacterInput>(hero).unwrap().walk = 3.0;
    steps(&mut app, 30);
    disable(&mut app, hero);
    steps(&mut app, 1);
    let at = place(&app, hero);
    let seen = |app: &App| {
        let filter = QueryFilter { sensors: true, ..QueryFilter::new() };
        let at = (f64::from(at.x), f64::from(at.y));
        physics(app).world.overlap_point(at, &filter).len()
    };
    assert_eq!(seen(&app), 0);
    steps(&mut app, 30);
    assert_eq!(place(&app, hero), at);
    let frame = physics(&app).clone();
    enable(&mut app, hero);
    steps(&mut app, 1);
    assert_eq!(seen(&app), 1);
    steps(&mut app, 29);
    assert!(place(&app, hero).x > at.x + 1.0, "{}", place(&app, hero));
    disable(&mut app, hero);
    app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
    steps(&mut app, 1);
    assert_eq!((place(&app, hero), seen(&app)), (at, 0));
}

#[test]
fn going_back_keeps_what_is_disabled() {
    let mut app = app();
    ground(&mut app);
    let balls: Vec<Entity> =
        (0..6).map(|at| ball(&mut app, 0.1 * at as f32, 1.0 + 1.2 * at as f32)).collect();
    let (body, part) = dumbbell(&mut app);
    app.world_mut().spawn(Joint::new(balls[0], balls[1], JointDef::rope(3.0)));
    steps(&mut app, 20);
    disable(&mut app, balls[0]);
    app.world_mut().entity_mut(body).insert_recursive::<Children>(Disabled);
    steps(&mut app, 5);
    let (frame, at) = (physics(&app).clone(), place(&app, balls[0]));
    steps(&mut app, 30);
    let future = physics(&app).world.state_hash();
    app.world_mut().get_mut::<Transform>(balls[0]).unwrap().translation.x = 50.0;
    app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
    steps(&mut app, 30);
    assert_eq!(physics(&app).world.state_hash(), future, "the same to the last bit");
    assert_eq!(place(&app, balls[0]), at, "places of the present are dropped");
    enable(&mut app, balls[0]);
    app.world_mut().entity_mut(body).remove_recursive::<Children, Disabled>();
    app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
    steps(&mut app, 1);
    assert!(physics(&app).body(balls[0]).unwrap().is_enabled(), "what is enabled by now holds");
    assert!(physics(&app).body(body).unwrap().is_enabled());
    assert_eq!(physics(&app).shape_ids(part).count(), 1);
    assert_eq!(physics(&app).world.validate(), Ok(()));
}

/// A disabled group above a body does not move that elsewhere.
#[test]
fn places_go_through_disabled_parents() {
    let mut app = app();
    let level = app.world_mut().spawn(Transform::from_xyz(10.0, 0.0, 0.0)).id();
    let wall = (RigidBody::Static, Collider::rect(1.0, 1.0), Transform::from_xyz(4.0, 0.0, 0.0));
    let wall = app.world_mut().spawn((wall, ChildOf(level))).id();
    disable(&mut app, level);
    steps(&mut app, 1);
    assert_eq!(physics(&app).body(wall).unwrap().position().x, 14.0);
    app.world_mut().get_mut::<Transform>(wall).unwrap().translation.x = 5.0;
    steps(&mut app, 1);
    assert_eq!(physics(&app).body(wall).unwrap().position().x, 15.0);
}
