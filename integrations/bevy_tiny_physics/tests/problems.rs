//! Bad input is told with the entity, and nothing panics.

mod common;
use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_math::{Vec2, Vec3};
use bevy_tiny_physics::prelude::*;
use bevy_transform::prelude::Transform;
use common::*;

/// Spawns something bad, steps, and gives what was told.
fn told(bundle: impl Bundle) -> Vec<(Option<Entity>, &'static str, String)> {
    let mut app = app();
    let entity = app.world_mut().spawn(bundle).id();
    steps(&mut app, 3);
    let told: Vec<_> = messages::<PhysicsProblem>(&app);
    assert!(
        !told.is_empty() && told.iter().all(|problem| problem.entity == Some(entity)),
        "{told:?}"
    );
    assert_eq!(physics(&app).world.validate(), Ok(()));
    told.into_iter()
        .map(|problem| (problem.entity, problem.what, problem.error.to_string()))
        .collect()
}

fn told_once(what: &str, contains: &str, bundle: impl Bundle) {
    let told = told(bundle);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].1 == what && told[0].2.contains(contains), "{told:?}");
}

#[test]
fn bad_shapes_places_and_numbers() {
    told_once("collider", "radius", (RigidBody::Dynamic, Collider::circle(-1.0)));
    told_once("collider", "", (RigidBody::Dynamic, Collider::hull(&[Vec2::ZERO, Vec2::X])));
    told_once(
        "collider",
        "friction",
        (RigidBody::Dynamic, Collider::circle(1.0), Friction(f32::NAN)),
    );
    told_once(
        "collider",
        "differently",
        (Collider::circle(1.0), Transform::from_scale(Vec3::new(1.0, 2.0, 1.0))),
    );
    told_once("body", "mass", (RigidBody::Dynamic, Collider::circle(1.0), Mass(-3.0)));
    told_once("body", "position", (RigidBody::Dynamic, Transform::from_xyz(f32::NAN, 0.0, 0.0)));
    told_once(
        "joint",
        "waits",
        Joint::new(Entity::PLACEHOLDER, Entity::PLACEHOLDER, JointDef::weld()),
    );
    told_once("character", "form of its own", (Character::new(1.8, 0.3), Collider::circle(1.0)));
    told_once("tile map", "", TileMap(TileGrid::new(-1.0, 1, 1, Vec::new())));
}

#[test]
fn bad_numbers_while_running() {
    let mut app = app();
    let ball = ball(&mut app, 0.0, 0.0);
    steps(&mut app, 2);
    let nan = Vec2::splat(f32::NAN);
    app.world_mut().entity_mut(ball).insert((
        ExternalForce { force: nan, torque: 0.0 },
        ExternalImpulse { impulse: nan, angular: 0.0 },
        KinematicTarget { position: nan, angle: 0.0 },
        Velocity { linear: nan, angular: 0.0 },
        GravityScale(f32::INFINITY),
    ));
    app.world_mut().get_mut::<Transform>(ball).unwrap().translation.x = f32::NAN;
    steps(&mut app, 3);
    let mut told: Vec<_> =
        messages::<PhysicsProblem>(&app).iter().map(|problem| problem.what).collect();
    told.sort_unstable();
    assert_eq!(told, ["body", "force", "impulse", "target", "transform", "velocity"]);
    assert!(physics(&app).body(ball).unwrap().position().is_finite());
    assert!(
        app.world().get::<Velocity>(ball).unwrap().linear.is_finite(),
        "written over by what holds"
    );
    app.world_mut().resource_mut::<PhysicsWorld>().world.gravity.x = f32::NAN;
    steps(&mut app, 1);
    let last = messages::<PhysicsProblem>(&app).pop().unwrap();
    assert_eq!((last.entity, last.what), (None, "step"));
}

#[test]
fn one_bad_shape_spares_the_others_and_mending_it_heals() {
    let mut app = app();
    let body = app.world_mut().spawn(RigidBody::Dynamic).id();
    let good = app.world_mut().spawn((Collider::circle(0.5), ChildOf(body))).id();
    let bad = app.world_mut().spawn((Collider::circle(0.5), Density(-1.0), ChildOf(body))).id();
    steps(&mut app, 2);
    let told = messages::<PhysicsProblem>(&app);
    assert_eq!(told.iter().map(|problem| problem.entity).collect::<Vec<_>>(), [Some(bad)]);
    assert_eq!(physics(&app).world.shape_count(), 1);
    assert_eq!(physics(&app).shape_ids(good).count(), 1);
    app.world_mut().get_mut::<Density>(bad).unwrap().0 = 1.0;
    steps(&mut app, 1);
    assert_eq!(physics(&app).world.shape_count(), 2);
}

/// Spawns something bad, mends it, and wants the body that was refused.
#[track_caller]
fn heals(bad: impl Bundle, mend: impl FnOnce(&mut EntityWorldMut)) {
    let mut app = app();
    let entity = app.world_mut().spawn(bad).id();
    steps(&mut app, 3);
    assert!(physics(&app).body(entity).is_none());
    mend(&mut app.world_mut().entity_mut(entity));
    steps(&mut app, 2);
    assert!(physics(&app).body(entity).is_some(), "it is tried again");
    assert_eq!(messages::<PhysicsProblem>(&app).len(), 1, "there was one problem");
    assert_eq!(physics(&app).world.validate(), Ok(()));
}

#[test]
fn a_body_that_was_refused_comes_when_it_is_mended() {
    let ball = (RigidBody::Dynamic, Collider::circle(1.0));
    let nan = Velocity::linear(f32::NAN, 0.0);
    heals((ball.clone(), Mass(-3.0)), |body| {
        body.insert(Mass(3.0));
    });
    heals((ball.clone(), Mass(-3.0)), |body| {
        body.remove::<Mass>();
    });
    heals((ball.clone(), GravityScale(f32::NAN)), |body| {
        body.insert(GravityScale(0.0));
    });
    heals((ball.clone(), nan), |body| {
        body.insert(Velocity::default());
    });
    heals((ball.clone(), nan), |body| {
        body.remove::<Velocity>();
    });
}

#[test]
fn what_was_refused_at_its_place_comes_when_that_is_mended() {
    let nowhere = Transform::from_xyz(f32::NAN, 0.0, 0.0);
    let flat = Transform::from_scale(Vec3::new(1.0, 2.0, 1.0));
    let ball = (RigidBody::Dynamic, Collider::circle(1.0));
    heals((ball, nowhere), |body| {
        body.insert(Transform::default());
    });
    heals((Character::new(1.8, 0.3), nowhere), |hero| {
        hero.insert(Transform::default());
    });
    heals((Collider::circle(1.0), nowhere), |ground| {
        ground.insert(Transform::default());
    });
    heals((Collider::circle(1.0), flat), |ground| {
        ground.insert(Transform::default());
    });
}

#[test]
fn what_was_refused_below_a_bad_place_comes_when_that_is_mended() {
    let mut app = app();
    let level = app.world_mut().spawn(Transform::from_xyz(f32::NAN, 0.0, 0.0)).id();
    let body = app.world_mut().spawn((RigidBody::Static, ChildOf(level))).id();
    let ground = app.world_mut().spawn((Collider::circle(1.0), ChildOf(level))).id();
    steps(&mut app, 3);
    assert_eq!(messages::<PhysicsProblem>(&app).len(), 2, "each is told once");
    app.world_mut().get_mut::<Transform>(level).unwrap().translation.x = 1.0;
    steps(&mut app, 1);
    assert_eq!(physics(&app).body(body).unwrap().position().x, 1.0);
    assert_eq!(physics(&app).body(ground).unwrap().position().x, 1.0);
}

#[test]
fn who_is_body_and_character_becomes_one_when_the_other_goes() {
    let mut app = app();
    let hero = app.world_mut().spawn((Character::new(1.8, 0.3), Collider::circle(1.0))).id();
    steps(&mut app, 2);
    app.world_mut().entity_mut(hero).remove::<Collider>();
    steps(&mut app, 1);
    assert!(physics(&app).character(hero).is_some());
    app.world_mut().entity_mut(hero).insert(RigidBody::Dynamic);
    steps(&mut app, 2);
    app.world_mut().entity_mut(hero).remove::<Character>();
    steps(&mut app, 1);
    assert!(physics(&app).character(hero).is_none() && physics(&app).body(hero).is_some());
    app.world_mut().entity_mut(hero).insert(Character::new(1.8, 0.3));
    steps(&mut app, 9);
    app.world_mut().entity_mut(hero).remove::<RigidBody>();
    steps(&mut app, 1);
    assert!(physics(&app).character(hero).is_some());
    assert_eq!(messages::<PhysicsProblem>(&app).len(), 3, "each is told once");
    assert_eq!(physics(&app).world.body_count(), 1);
}

#[test]
fn what_stays_bad_is_told_when_it_is_bad_in_another_way() {
    let mut app = app();
    let ball = app.world_mut().spawn((RigidBody::Dynamic, Mass(-3.0))).id();
    steps(&mut app, 2);
    app.world_mut().entity_mut(ball).insert(Mass(-3.0));
    steps(&mut app, 2);
    assert_eq!(messages::<PhysicsProblem>(&app).len(), 1);
    app.world_mut().entity_mut(ball).insert(Mass(-4.0));
    steps(&mut app, 2);
    assert_eq!(messages::<PhysicsProblem>(&app).len(), 2);
    let frame = physics(&app).clone();
    app.world_mut().entity_mut(ball).insert(Mass(4.0));
    *app.world_mut().resource_mut::<PhysicsWorld>() = frame;
    steps(&mut app, 1);
    assert!(physics(&app).body(ball).is_some(), "in a copy, too");
    app.world_mut().despawn(ball);
    steps(&mut app, 1);
    assert_eq!(physics(&app).world.body_count(), 0);
}

/// Edits something, steps, and wants one problem and the world as it was.
#[track_caller]
fn is_left<T: Component<Mutability = bevy_ecs::component::Mutable>>(
    app: &mut App,
    entity: Entity,
    edit: impl FnOnce(&mut T),
) {
    let parts = |app: &App| {
        let world = &physics(app).world;
        let of_bodies: Vec<_> = world.bodies().map(|body| body.describe()).collect();
        let of_joints: Vec<_> = world.joints().map(|joint| (joint.id(), *joint.def())).collect();
        let shapes: Vec<_> = world.shape_ids().collect();
        (of_bodies, of_joints, shapes)
    };
    let (before, told) = (parts(app), messages::<PhysicsProblem>(app).len());
    edit(&mut app.world_mut().get_mut::<T>(entity).unwrap());
    steps(app, 1);
    assert_eq!(messages::<PhysicsProblem>(app).len(), told + 1);
    assert_eq!(parts(app), before);
    assert_eq!(physics(app).world.validate(), Ok(()));
}

#[test]
fn bad_edits_leave_all_as_it_was() {
    let mut app = app();
    app.world_mut().resource_mut::<PhysicsWorld>().world.gravity = tiny_physics::Vec2::ZERO;
    let grid = TileGrid::parse(1.0, &["#..#", "####"]).unwrap();
    let tiles = app.world_mut().spawn(TileMap(grid)).id();
    let (a, b) = (ball(&mut app, 0.0, 5.0), ball(&mut app, 3.0, 5.0));
    let two = || Collider::circle(0.5).and(Collider::rect(0.3, 0.3));
    let body = (RigidBody::Dynamic, two(), Friction(0.5), Transform::from_xyz(9.0, 5.0, 0.0));
    let body = app.world_mut().spawn(body).id();
    let joint = app.world_mut().spawn(Joint::new(a, b, JointDef::rope(9.0))).id();
    steps(&mut app, 2);

    is_left::<TileMap>(&mut app, tiles, |map| map.0.cells.truncate(3));
    is_left::<TileMap>(&mut app, tiles, |map| map.0.cells = vec![0, 0, 0, 0, 99, 99, 99, 99]);
    is_left::<TileMap>(&mut app, tiles, |map| map.0.width = 0);
    is_left::<TileMap>(&mut app, tiles, |map| map.0.cell_size = f32::NAN);
    is_left::<Joint>(&mut app, joint, |joint| joint.a = b);
    is_left::<Joint>(&mut app, joint, |joint| *joint = Joint::new(b, a, JointDef::rope(-1.0)));
    // As many shapes as before, and others.
    app.world_mut().entity_mut(body).insert(Collider::circle(0.7));
    is_left::<Friction>(&mut app, body, |friction| friction.0 = f32::NAN);
    app.world_mut().entity_mut(body).insert((two(), Friction(0.5)));
    steps(&mut app, 1);
    app.world_mut().entity_mut(body).insert(two().at(0.5, 0.0));
    is_left::<Friction>(&mut app, body, |friction| friction.0 = -1.0);
}
