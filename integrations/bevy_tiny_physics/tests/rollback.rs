//! The world is a value: saved, restored, and the same future again.

mod common;
use bevy_app::App;
use bevy_ecs::entity::{EntityHashMap, MapEntities};
use bevy_ecs::prelude::*;
use bevy_tiny_physics::prelude::*;
use bevy_transform::prelude::Transform;
use common::*;

fn game() -> (App, Vec<Entity>, Entity) {
    let mut app = app();
    ground(&mut app);
    let balls: Vec<Entity> =
        (0..10).map(|at| ball(&mut app, 0.1 * at as f32, 1.0 + 1.2 * at as f32)).collect();
    app.world_mut().spawn(Joint::new(balls[0], balls[1], JointDef::rope(3.0)));
    app.world_mut().entity_mut(balls[3]).insert(Velocity::default());
    let hero = (Character::new(1.8, 0.3), Transform::from_xyz(-4.0, 2.0, 0.0));
    let hero = app.world_mut().spawn(hero).id();
    (app, balls, hero)
}

fn play(app: &mut App, hero: Entity, count: usize) {
    for step in 0..count {
        let mut input = app.world_mut().get_mut::<CharacterInput>(hero).unwrap();
        (input.walk, input.jump) = (3.0, if step % 20 == 0 { 5.0 } else { 0.0 });
        steps(app, 1);
    }
}

#[test]
fn a_frame_is_a_copy_and_its_future_is_the_same() {
    let (mut app, balls, hero) = game();
    play(&mut app, hero, 30);
    let frame = physics(&app).clone();
    let at_frame: Vec<_> = balls.iter().map(|ball| place(&app, *ball)).collect();
    play(&mut app, hero, 60);
    let (future, hero_at) = (physics(&app).world.state_hash(), place(&app, hero));
    let places: Vec<_> =
        balls.iter().map(|ball| *app.world().get::<Transform>(*ball).unwrap()).collect();

    // What the present has that the past had not, and other nonsense.
    let late = ball(&mut app, 20.0, 5.0);
    app.world_mut().get_mut::<Transform>(balls[2]).unwrap().translation.x = 77.0;
    app.world_mut().get_mut::<Velocity>(balls[3]).unwrap().linear.x = 88.0;
    steps(&mut app, 3);
    app.world_mut().despawn(late);
    app.world_mut().get_mut::<Transform>(balls[4]).unwrap().translation.x = 99.0;

    app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
    play(&mut app, hero, 1);
    assert!(
        (place(&app, balls[4]) - at_frame[4]).length() < 0.2,
        "places of the present are dropped"
    );
    // The rest of the same inputs.
    for step in 1..60 {
        let mut input = app.world_mut().get_mut::<CharacterInput>(hero).unwrap();
        (input.walk, input.jump) = (3.0, if step % 20 == 0 { 5.0 } else { 0.0 });
        steps(&mut app, 1);
    }
    assert_eq!(physics(&app).world.state_hash(), future);
    assert_eq!(place(&app, hero), hero_at);
    let again: Vec<_> =
        balls.iter().map(|ball| *app.world().get::<Transform>(*ball).unwrap()).collect();
    assert_eq!(again, places);
}

#[test]
fn entities_that_came_and_went_since_are_reconciled() {
    let (mut app, balls, hero) = game();
    play(&mut app, hero, 10);
    let frame = physics(&app).clone();
    app.world_mut().despawn(balls[5]);
    let late = ball(&mut app, 20.0, 5.0);
    play(&mut app, hero, 10);
    *app.world_mut().resource_mut::<PhysicsWorld>() = frame;
    play(&mut app, hero, 1);
    assert!(physics(&app).body(balls[5]).is_none(), "its entity is gone");
    assert!(physics(&app).body(late).is_some(), "its entity is here");
    assert_eq!(physics(&app).world.body_count(), 12);
    assert_eq!(physics(&app).world.validate(), Ok(()));
}

#[test]
fn a_copy_goes_to_other_entities() {
    let (mut app, balls, hero) = game();
    play(&mut app, hero, 40);
    let mut frame = physics(&app).clone();
    let twin = app
        .world_mut()
        .spawn((RigidBody::Dynamic, Collider::circle(0.5), Transform::default()))
        .id();
    app.world_mut().despawn(balls[6]);
    let before = frame.body(balls[6]).unwrap().position();
    let mut mapper = EntityHashMap::from_iter([(balls[6], twin)]);
    for entity in app.world_mut().query::<Entity>().iter(app.world()).collect::<Vec<_>>() {
        mapper.entry(entity).or_insert(entity);
    }
    mapper.insert(balls[6], twin);
    frame.map_entities(&mut mapper);
    assert_eq!(frame.body(twin).unwrap().position(), before);
    let hash = frame.world.state_hash();
    *app.world_mut().resource_mut::<PhysicsWorld>() = frame;
    assert_eq!(physics(&app).world.state_hash(), hash);
    steps(&mut app, 1);
    assert!((place(&app, twin) - bevy_math::Vec2::new(before.x, before.y)).length() < 0.2);
}

/// A weight on a weld that breaks within a second.
fn lamp(app: &mut App) -> (Entity, Entity) {
    let hook = (RigidBody::Static, Transform::from_xyz(0.0, 9.0, 0.0));
    let hook = app.world_mut().spawn(hook).id();
    let lamp = ball(app, 0.0, 8.0);
    let joint = Joint::new(
        hook,
        lamp,
        JointDef {
            break_at: Some(tiny_physics::Break { force: 20.0, torque: f32::MAX }),
            ..JointDef::rope(1.5)
        },
    );
    (lamp, app.world_mut().spawn(joint).id())
}

#[test]
fn a_joint_that_broke_since_is_there_again() {
    let mut app = app();
    let (lamp, joint) = lamp(&mut app);
    steps(&mut app, 5);
    let frame = physics(&app).clone();
    steps(&mut app, 60);
    assert!(app.world().get::<Joint>(joint).is_none(), "it broke");
    let (future, at) = (physics(&app).world.state_hash(), place(&app, lamp));

    for _ in 0..2 {
        app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
        steps(&mut app, 1);
        assert!(app.world().get::<Joint>(joint).is_some());
        assert!(physics(&app).joint(joint).is_some());
        steps(&mut app, 59);
        assert!(app.world().get::<Joint>(joint).is_none(), "it breaks again");
        assert_eq!((physics(&app).world.state_hash(), place(&app, lamp)), (future, at));
    }

    // One that the game takes off is not put on again.
    app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
    steps(&mut app, 1);
    app.world_mut().entity_mut(joint).remove::<Joint>();
    steps(&mut app, 1);
    app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
    steps(&mut app, 1);
    assert!(app.world().get::<Joint>(joint).is_none());
    assert_eq!(physics(&app).world.joint_count(), 0);
}

#[test]
fn what_components_say_since_is_told_to_a_copy() {
    let (mut app, balls, hero) = game();
    let below = (Collider::circle(0.2), Transform::from_xyz(0.3, 0.4, 0.0), ChildOf(balls[1]));
    let below = app.world_mut().spawn(below).id();
    let rope = Joint::new(balls[7], balls[8], JointDef::rope(3.0));
    let rope = app.world_mut().spawn(rope).id();
    play(&mut app, hero, 30);
    let frame = physics(&app).clone();
    let mut world = app.world_mut();
    world.entity_mut(balls[0]).insert((GravityScale(0.5), Enabled(false)));
    *world.get_mut::<RigidBody>(balls[2]).unwrap() = RigidBody::Kinematic;
    *world.get_mut::<Collider>(balls[3]).unwrap() = Collider::circle(0.25);
    world.entity_mut(below).insert(Friction(0.125));
    world.get_mut::<Joint>(rope).unwrap().def = JointDef::rope(2.0);
    play(&mut app, hero, 3);
    world = app.world_mut();
    world.resource_mut::<PhysicsWorld>().clone_from(&frame);
    play(&mut app, hero, 1);
    let physics = physics(&app);
    let body = physics.body(balls[0]).unwrap();
    assert_eq!((body.gravity_scale(), body.is_enabled()), (0.5, false));
    assert_eq!(physics.body(balls[2]).unwrap().kind(), tiny_physics::BodyKind::Kinematic);
    let shape = |entity| physics.world.shape(physics.shape_ids(entity).next().unwrap()).unwrap();
    assert_eq!(*shape(balls[3]).shape(), tiny_physics::Shape::circle(0.25).unwrap());
    assert_eq!(shape(below).material().friction, 0.125);
    assert_eq!(*physics.joint(rope).unwrap().def(), JointDef::rope(2.0));
}

/// A copy whose components say what they said is not touched: what turned meanwhile, with colliders below it, and what was set by hand.
#[test]
fn what_components_said_before_is_not_told_again() {
    let mut app = app();
    let top = (RigidBody::Dynamic, Velocity { angular: 3.0, ..Velocity::linear(1.7, 2.3) });
    let top = app.world_mut().spawn((top, Transform::from_xyz(0.3, 5.1, 0.0))).id();
    for at in 0..5 {
        let at = Transform::from_xyz(0.37 * at as f32, 0.21, 0.0)
            .with_rotation(bevy_math::Quat::from_rotation_z(0.3 * at as f32));
        app.world_mut().spawn((Collider::rect(0.2, 0.1), at, ChildOf(top)));
    }
    let turned =
        Transform::from_xyz(0.1, -3.0, 0.0).with_rotation(bevy_math::Quat::from_rotation_z(0.1234));
    app.world_mut().spawn((Collider::rect(9.0, 0.3), turned));
    steps(&mut app, 17);
    app.world_mut().resource_mut::<PhysicsWorld>().body_mut(top).unwrap().set_gravity_scale(0.7);
    steps(&mut app, 1);
    let frame = physics(&app).clone();
    steps(&mut app, 40);
    let future = physics(&app).world.state_hash();
    app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
    steps(&mut app, 40);
    assert_eq!(physics(&app).world.state_hash(), future);
}

/// Cells are what the component says by now; what was set by hand before the copy was made stays.
#[test]
fn cells_of_a_copy_are_what_its_tile_map_says() {
    let mut app = app();
    let grid = tiny_physics::TileGrid::parse(1.0, &["########", "########"]).unwrap();
    let map = app.world_mut().spawn(TileMap(grid.clone())).id();
    let digger = ball(&mut app, 2.5, 3.0);
    steps(&mut app, 5);
    let id = physics(&app).world.tile_grid_ids().next().unwrap();
    let cell = |app: &App, x| physics(app).world.tiles(id).unwrap().get(x, 1);
    let mut physics_mut = app.world_mut().resource_mut::<PhysicsWorld>();
    physics_mut.world.set_tile(id, 7, 1, 0).unwrap();
    steps(&mut app, 5);
    let frame = physics(&app).clone();
    app.world_mut().get_mut::<TileMap>(map).unwrap().0.set(2, 1, 0).unwrap();
    steps(&mut app, 60);
    let (future, at) = (physics(&app).world.state_hash(), place(&app, digger));
    assert_eq!([2, 3, 7].map(|x| cell(&app, x)), [0, 1, 0], "an edit sets what it changes");

    app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
    steps(&mut app, 1);
    assert_eq!([2, 3, 7].map(|x| cell(&app, x)), [0, 1, 0], "what the component says by now");
    steps(&mut app, 59);
    assert_eq!((physics(&app).world.state_hash(), place(&app, digger)), (future, at));

    // Once more, with a component that has gone back as well.
    *app.world_mut().get_mut::<TileMap>(map).unwrap() = TileMap(grid);
    app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
    steps(&mut app, 1);
    assert_eq!([2, 3, 7].map(|x| cell(&app, x)), [1, 1, 0]);
    app.world_mut().get_mut::<TileMap>(map).unwrap().0.width = 4;
    app.world_mut().get_mut::<TileMap>(map).unwrap().0.cells.truncate(8);
    app.world_mut().resource_mut::<PhysicsWorld>().clone_from(&frame);
    steps(&mut app, 1);
    let world = &physics(&app).world;
    let ids: Vec<_> = world.tile_grid_ids().collect();
    assert_eq!((ids.len(), world.tiles(ids[0]).unwrap().width), (1, 4));
}
