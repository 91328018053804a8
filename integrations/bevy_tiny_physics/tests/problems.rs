//! Bad input is told with the entity, and nothing panics.

mod common;
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
