//! Bevy's fixed clock: transforms between steps, exact places for the game's own systems.

mod common;
use bevy_app::prelude::*;
use bevy_ecs::prelude::*;
use bevy_math::{Quat, Vec2};
use bevy_time::{Fixed, Time, TimePlugin, TimeUpdateStrategy};
use bevy_tiny_physics::prelude::*;
use bevy_transform::prelude::Transform;
use common::{messages, physics, place};
use std::time::Duration;

/// Where fixed systems saw the ball.
#[derive(Resource, Default)]
struct Seen(Vec<f32>);

fn app(frame: f64) -> (App, Entity) {
    let mut app = App::new();
    app.add_plugins((TimePlugin, PhysicsPlugin::default().gravity(Vec2::ZERO)))
        .insert_resource(Time::<Fixed>::from_hz(50.0))
        .insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs_f64(frame)))
        .init_resource::<Seen>();
    let look = |balls: Query<&Transform, With<Velocity>>, mut seen: ResMut<Seen>| {
        seen.0.extend(balls.iter().map(|at| at.translation.x));
    };
    app.add_systems(FixedUpdate, look.before(PhysicsSystems::Read));
    let ball = app
        .world_mut()
        .spawn((RigidBody::Dynamic, Collider::circle(0.5), Velocity::linear(5.0, 0.0)))
        .id();
    (app, ball)
}

/// It is shown on its way in even parts, and steps see it where it is.
#[track_caller]
fn moves_evenly(app: &App, places: &[f32]) {
    for pair in places.windows(2).skip(10) {
        assert!((pair[1] - pair[0] - 0.035).abs() < 1e-3, "{} m in a frame", pair[1] - pair[0]);
    }
    let seen = &app.world().resource::<Seen>().0;
    for (step, x) in seen.iter().enumerate() {
        assert!((x - 0.1 * step as f32).abs() < 1e-4, "step {step} saw it at {x}");
    }
}

#[test]
fn bodies_are_drawn_between_steps_and_move_evenly() {
    // Frames of 7 ms, steps of 20 ms.
    let (mut app, ball) = app(0.007);
    let places: Vec<f32> = (0..100)
        .map(|_| {
            app.update();
            place(&app, ball).x
        })
        .collect();
    moves_evenly(&app, &places);
    assert!(messages::<PhysicsProblem>(&app).is_empty());
}

#[test]
fn a_teleport_between_frames_is_not_overwritten() {
    let (mut app, ball) = app(0.007);
    (0..20).for_each(|_| app.update());
    app.world_mut().get_mut::<Transform>(ball).unwrap().translation.x = 50.0;
    (0..6).for_each(|_| app.update());
    let x = physics(&app).body(ball).unwrap().position().x;
    assert!((50.0..51.0).contains(&x), "{x}");
}

#[test]
fn a_character_teleports_between_frames_however_it_is_turned() {
    let (mut app, _) = app(0.007);
    let hero =
        app.world_mut().spawn((Character::new(1.8, 0.3), Transform::from_xyz(0.0, 9.0, 0.0))).id();
    (0..20).for_each(|_| app.update());
    let mut transform = app.world_mut().get_mut::<Transform>(hero).unwrap();
    transform.translation.x = -9.0;
    (0..6).for_each(|_| app.update());
    assert_eq!(
        (place(&app, hero).x, physics(&app).character(hero).unwrap().position.x),
        (-9.0, -9.0)
    );
    app.world_mut().get_mut::<CharacterInput>(hero).unwrap().walk = 4.0;
    let walk = |app: &mut App, mirror: bool| {
        for frame in 0..40 {
            app.update();
            let mut transform = app.world_mut().get_mut::<Transform>(hero).unwrap();
            if mirror {
                transform.rotate_z(0.1);
                transform.scale.x = if frame % 2 == 0 { -1.0 } else { 1.0 };
            }
        }
        physics(app).character(hero).unwrap().position.x
    };
    let (start, half) = (walk(&mut app, false), walk(&mut app, true));
    let end = walk(&mut app, false);
    assert!((end - half - (half - start)).abs() < 1e-3, "{start} {half} {end}");
}

#[test]
fn mirroring_a_body_between_frames_does_not_throw_it_back() {
    let (mut app, ball) = app(0.007);
    let places: Vec<f32> = (0..100)
        .map(|_| {
            app.update();
            let mut transform = app.world_mut().get_mut::<Transform>(ball).unwrap();
            transform.scale.x *= -1.0;
            transform.translation.x
        })
        .collect();
    moves_evenly(&app, &places);
}

#[test]
fn scaling_between_frames_scales_shapes() {
    let (mut app, ball) = app(0.007);
    app.world_mut().entity_mut(ball).insert(Density(1.0));
    (0..20).for_each(|_| app.update());
    app.world_mut().get_mut::<Transform>(ball).unwrap().scale = bevy_math::Vec3::splat(2.0);
    (0..6).for_each(|_| app.update());
    let mass = physics(&app).body(ball).unwrap().mass();
    assert!((mass - core::f32::consts::PI).abs() < 1e-3, "{mass} kg");
}

#[test]
fn a_body_below_something_teleports_between_frames() {
    let (mut app, ball) = app(0.007);
    let level = app.world_mut().spawn(Transform::from_xyz(10.0, 0.0, 0.0)).id();
    app.world_mut().entity_mut(ball).insert(ChildOf(level));
    (0..20).for_each(|_| app.update());
    app.world_mut().get_mut::<Transform>(ball).unwrap().translation.x = 50.0;
    (0..6).for_each(|_| app.update());
    let x = physics(&app).body(ball).unwrap().position().x;
    assert!((60.0..61.0).contains(&x), "{x}");
    assert!((place(&app, ball).x - x + 10.0).abs() < 0.2);
}

/// Turns a body in every frame, as one that looks at the mouse does.
fn turn_between_frames(below: Option<Transform>) {
    let (mut app, ball) = app(0.007);
    app.world_mut().entity_mut(ball).insert(LockedAxes::ROTATION);
    if let Some(level) = below {
        let level = app.world_mut().spawn(level).id();
        app.world_mut().entity_mut(ball).insert(ChildOf(level));
    }
    let places: Vec<f32> = (0..100)
        .map(|frame| {
            app.update();
            let mut transform = app.world_mut().get_mut::<Transform>(ball).unwrap();
            transform.rotation = Quat::from_rotation_z(0.01 * frame as f32);
            transform.translation.x
        })
        .collect();
    moves_evenly(&app, &places);
    let angle = physics(&app).body(ball).unwrap().angle();
    assert!((0.95..1.0).contains(&angle), "{angle}");
}

#[test]
fn turning_a_body_between_frames_does_not_throw_it_back() {
    turn_between_frames(None);
    turn_between_frames(Some(Transform::from_xyz(10.0, 3.0, 0.0)));
}

#[test]
fn shifting_a_body_between_frames_does_not_turn_it_back() {
    let (mut app, ball) = app(0.007);
    *app.world_mut().get_mut::<Velocity>(ball).unwrap() =
        Velocity { linear: Vec2::ZERO, angular: 1.0 };
    for frame in 0..100 {
        app.update();
        app.world_mut().get_mut::<Transform>(ball).unwrap().translation.y = 0.01 * frame as f32;
    }
    let body = physics(&app).body(ball).unwrap();
    let turned = 0.02 * physics(&app).world.step_count() as f32;
    assert!((body.angle() - turned).abs() < 1e-3, "{} of {turned} radians", body.angle());
    assert!(body.position().y > 0.9);
}
