//! Findings of the doctor come as messages, with entities.
#![cfg(feature = "doctor")]

mod common;
use bevy_app::prelude::*;
use bevy_ecs::schedule::ScheduleLabel;
use bevy_tiny_physics::prelude::*;
use bevy_transform::prelude::Transform;
use common::*;

#[test]
fn says_who_was_put_into_the_ground() {
    let mut app = app();
    app.add_plugins(PhysicsDoctorPlugin);
    ground(&mut app);
    let crate_ = (RigidBody::Dynamic, Collider::rect(0.5, 0.5), Transform::from_xyz(0.0, 0.1, 0.0));
    let crate_ = app.world_mut().spawn(crate_).id();
    steps(&mut app, 64);
    let told = messages::<PhysicsFinding>(&app);
    assert!(told.iter().any(|finding| finding.entities.contains(&crate_)), "{told:?}");
    let codes: Vec<_> = told.iter().map(|told| told.finding.code).collect();
    assert!(
        codes.contains(&bevy_tiny_physics::tiny_physics_doctor::Code::OverlapAtStart),
        "{codes:?}"
    );
    let once = told.len();
    steps(&mut app, 64);
    assert_eq!(messages::<PhysicsFinding>(&app).len(), once, "each is told once");
}

/// Where a game steps that goes back in time.
#[derive(ScheduleLabel, Clone, PartialEq, Eq, Hash, Debug)]
struct Game;

#[test]
fn watches_where_the_world_steps() {
    for first in [true, false] {
        let mut app = App::new();
        if first {
            app.add_plugins(PhysicsDoctorPlugin);
        }
        app.add_plugins(PhysicsPlugin::default().in_schedule(Game, 1.0 / 60.0));
        if !first {
            app.add_plugins(PhysicsDoctorPlugin);
        }
        ground(&mut app);
        ball(&mut app, 0.0, 0.1);
        (0..64).for_each(|_| app.world_mut().run_schedule(Game));
        assert!(!messages::<PhysicsFinding>(&app).is_empty(), "whichever is added first");
    }
}
