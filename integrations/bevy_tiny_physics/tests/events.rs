//! Messages carry entities, valid though they have been despawned since; queries answer with entities.

mod common;
use bevy_ecs::prelude::*;
use bevy_ecs::system::RunSystemOnce;
use bevy_math::Vec2;
use bevy_tiny_physics::prelude::*;
use bevy_transform::prelude::Transform;
use common::*;

#[test]
fn collisions_and_hits_name_collider_and_body() {
    let mut app = app();
    let ground = ground(&mut app);
    let body = app.world_mut().spawn((RigidBody::Dynamic, Transform::from_xyz(0.0, 3.0, 0.0))).id();
    let foot = app
        .world_mut()
        .spawn((Collider::circle(0.5), CollisionEvents, HitEvents, ChildOf(body)))
        .id();
    steps(&mut app, 90);
    let started = messages::<CollisionStarted>(&app);
    let event = started.first().expect("a collision");
    let (colliders, bodies) = ([event.collider_a, event.collider_b], [event.body_a, event.body_b]);
    assert!(colliders.contains(&foot) && colliders.contains(&ground));
    assert!(bodies.contains(&body) && bodies.contains(&ground));
    assert_eq!(event.other(ground), Some(body));
    let hit = messages::<Hit>(&app)[0];
    let mass = physics(&app).body(body).unwrap().mass();
    assert!((hit.impulse - mass * hit.speed).abs() < 0.2 * hit.impulse, "{} Ns", hit.impulse);
    assert!(hit.point.y.abs() < 0.2);
    assert!([(hit.body_a, hit.mass_a), (hit.body_b, hit.mass_b)].contains(&(body, mass)));
    assert!([(hit.body_a, hit.mass_a), (hit.body_b, hit.mass_b)].contains(&(ground, 0.0)));
    app.world_mut().despawn(body);
    steps(&mut app, 1);
    let ended = messages::<CollisionEnded>(&app);
    assert_eq!(
        ended.last().and_then(|event| event.other(ground)),
        Some(body),
        "named though it is gone"
    );
}

#[test]
fn sensors_see_who_comes_and_goes() {
    let mut app = app();
    let gate = app.world_mut().spawn((Collider::rect(2.0, 0.5), Sensor)).id();
    let ball = ball(&mut app, 0.0, 3.0);
    steps(&mut app, 120);
    let (entered, left) = (messages::<SensorEntered>(&app), messages::<SensorLeft>(&app));
    assert_eq!((entered.len(), left.len()), (1, 1));
    assert_eq!((entered[0].sensor, entered[0].visitor_body), (gate, ball));
}

#[test]
fn joints_hold_wait_change_and_break() {
    let mut app = app();
    let hook = app.world_mut().spawn((RigidBody::Static, Transform::from_xyz(0.0, 5.0, 0.0))).id();
    let lamp = app.world_mut().spawn(Transform::from_xyz(0.0, 3.0, 0.0)).id();
    let rope = app.world_mut().spawn(Joint::new(hook, lamp, JointDef::rope(2.0))).id();
    steps(&mut app, 1);
    assert!(physics(&app).joint(rope).is_none());
    assert_eq!(messages::<PhysicsProblem>(&app).len(), 1, "it says once what it waits for");
    app.world_mut().entity_mut(lamp).insert((RigidBody::Dynamic, Collider::circle(0.2)));
    steps(&mut app, 120);
    assert!((place(&app, lamp).y - 3.0).abs() < 0.01);
    assert_eq!(messages::<PhysicsProblem>(&app).len(), 1);
    app.world_mut().get_mut::<Joint>(rope).unwrap().def = JointDef::rope(3.0).break_at(1e6, 1e6);
    steps(&mut app, 240);
    assert!((place(&app, lamp).y - 2.0).abs() < 0.01);
    app.world_mut().get_mut::<Joint>(rope).unwrap().def = JointDef::rope(3.0).break_at(0.01, 0.01);
    steps(&mut app, 2);
    let broke = messages::<JointBroke>(&app);
    assert_eq!((broke[0].joint, broke[0].body_a, broke[0].body_b), (rope, hook, lamp));
    assert!(app.world().get::<Joint>(rope).is_none());
    assert_eq!(physics(&app).world.joint_count(), 0);
}

#[test]
fn a_joint_comes_back_with_its_body() {
    let mut app = app();
    let (a, b) = (ball(&mut app, 0.0, 0.0), ball(&mut app, 2.0, 0.0));
    let rod = app.world_mut().spawn(Joint::new(a, b, JointDef::distance(2.0))).id();
    steps(&mut app, 1);
    app.world_mut().entity_mut(a).remove::<RigidBody>();
    steps(&mut app, 1);
    assert!(physics(&app).joint(rod).is_some(), "the lone collider is a body, too");
    app.world_mut().entity_mut(a).remove::<Collider>();
    steps(&mut app, 1);
    assert!(physics(&app).joint(rod).is_none());
    app.world_mut().entity_mut(a).insert(RigidBody::Dynamic);
    steps(&mut app, 1);
    assert!(physics(&app).joint(rod).is_some());
    app.world_mut().entity_mut(rod).remove::<Joint>();
    steps(&mut app, 1);
    assert_eq!(physics(&app).world.joint_count(), 0);
}

#[test]
fn queries_are_a_system_parameter() {
    let mut app = app();
    let ground = ground(&mut app);
    let ball = ball(&mut app, 0.0, 0.5);
    steps(&mut app, 1);
    app.world_mut()
        .run_system_once(move |physics: PhysicsQuery| {
            let down =
                |filter| physics.ray_cast(Vec2::new(0.0, 5.0), Vec2::new(0.0, -9.0), &filter);
            let hit = down(EntityFilter::default()).unwrap();
            assert_eq!((hit.collider, hit.body), (ball, ball));
            assert_eq!(down(EntityFilter::without(ball)).unwrap().body, ground);
            let all = physics.ray_cast_all(
                Vec2::new(0.0, 5.0),
                Vec2::new(0.0, -9.0),
                &EntityFilter::default(),
            );
            assert_eq!(all.iter().map(|hit| hit.body).collect::<Vec<_>>(), [ball, ground]);
            let foot = Shape::circle(0.5).unwrap();
            let hit = physics.cast_shape(
                &foot,
                (Vec2::new(4.0, 3.0), 0.0),
                Vec2::new(0.0, -5.0),
                &EntityFilter::default(),
            );
            assert!((hit.unwrap().fraction - 0.5).abs() < 1e-3);
            assert_eq!(
                physics.overlap_shape(&foot, Vec2::new(0.9, 0.6), 0.0, &EntityFilter::default()),
                [ball]
            );
            assert_eq!(physics.at_point(Vec2::new(0.0, -0.5), &EntityFilter::default()), [ground]);
            assert_eq!(
                physics.closest(Vec2::new(3.0, 0.5), 1.0, &EntityFilter::default()).unwrap().0,
                ground
            );
        })
        .unwrap();
}

#[test]
fn tiles_are_ground_and_single_cells_can_go() {
    let mut app = app();
    let grid = TileGrid::parse(1.0, &["    ", "####"]).unwrap();
    let map = app.world_mut().spawn(TileMap(grid)).id();
    let ball =
        app.world_mut().spawn((RigidBody::Dynamic, Collider::circle(0.4), CollisionEvents)).id();
    app.world_mut().entity_mut(ball).insert(Transform::from_xyz(1.5, 2.0, 0.0));
    steps(&mut app, 90);
    assert!((place(&app, ball).y - 1.4).abs() < 0.02);
    assert_eq!(messages::<CollisionStarted>(&app)[0].other(ball), Some(map));
    app.world_mut().get_mut::<TileMap>(map).unwrap().0.set(1, 0, 0).unwrap();
    steps(&mut app, 60);
    assert!(place(&app, ball).y < 0.0);
    app.world_mut().despawn(map);
    steps(&mut app, 1);
    assert_eq!(physics(&app).world.body_count(), 1);
}

#[test]
fn messages_name_tile_maps_that_were_edited_or_despawned() {
    let mut app = app();
    let grid = TileGrid::parse(1.0, &["    ", "####"]).unwrap();
    let map = app.world_mut().spawn(TileMap(grid)).id();
    for x in [1.5, 3.5] {
        let ball = ball(&mut app, x, 1.6);
        app.world_mut().entity_mut(ball).insert(CollisionEvents);
    }
    steps(&mut app, 90);
    let mut known = 0;
    let mut named = |app: &bevy_app::App| {
        let ended = messages::<CollisionEnded>(app);
        assert!(ended.len() > known, "something ended");
        known = ended.len();
        for event in ended {
            assert!([event.collider_a, event.collider_b].contains(&map), "{event:?}");
            assert!([event.body_a, event.body_b].contains(&map), "{event:?}");
        }
    };
    app.world_mut().get_mut::<TileMap>(map).unwrap().0.set(1, 0, 0).unwrap();
    steps(&mut app, 1);
    named(&app);
    steps(&mut app, 60);
    app.world_mut().despawn(map);
    steps(&mut app, 1);
    named(&app);
}

#[test]
fn messages_name_a_character_that_was_despawned() {
    let mut app = app();
    let gate = app.world_mut().spawn((Collider::rect(2.0, 2.0), Sensor)).id();
    let hero = app.world_mut().spawn(Character::new(1.8, 0.3)).id();
    steps(&mut app, 3);
    app.world_mut().despawn(hero);
    steps(&mut app, 1);
    let left = messages::<SensorLeft>(&app);
    assert!(!left.is_empty());
    for event in left {
        let colliders = [event.sensor, event.visitor];
        assert!(colliders.contains(&hero) && colliders.contains(&gate), "{event:?}");
        assert_eq!([event.sensor_body, event.visitor_body], colliders);
    }
}
