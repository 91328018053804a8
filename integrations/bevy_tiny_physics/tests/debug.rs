//! Outlines lie on what is shown.
#![cfg(feature = "gizmos")]

use bevy_app::prelude::*;
use bevy_gizmos::gizmos::GizmoStorage;
use bevy_gizmos::prelude::*;
use bevy_time::{Fixed, Time, TimePlugin, TimeUpdateStrategy};
use bevy_tiny_physics::prelude::*;
use std::time::Duration;

/// Where between steps outlines are drawn after three frames of 7 ms, with steps of 20 ms.
fn alpha(plugin: PhysicsPlugin) -> f32 {
    let mut store = GizmoConfigStore::default();
    store.insert(GizmoConfig::default(), DefaultGizmoConfigGroup);
    let mut app = App::new();
    app.add_plugins((TimePlugin, plugin, PhysicsDebugPlugin))
        .insert_resource(Time::<Fixed>::from_hz(50.0))
        .insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(7)))
        .insert_resource(store)
        .init_resource::<GizmoStorage<DefaultGizmoConfigGroup, ()>>();
    (0..4).for_each(|_| app.update());
    app.world().resource::<PhysicsDebug>().options.alpha
}

#[test]
fn outlines_are_drawn_between_steps_only_where_bodies_are_shown_there() {
    let between = alpha(PhysicsPlugin::default());
    assert!((between - 0.05).abs() < 1e-4, "{between}");
    assert_eq!(alpha(PhysicsPlugin::default().without_interpolation()), 1.0);
    assert_eq!(alpha(PhysicsPlugin::default().in_schedule(Update, 0.02)), 1.0);
}
