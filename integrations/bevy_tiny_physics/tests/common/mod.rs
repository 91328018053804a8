//! An app without a window, stepped by hand.
#![allow(dead_code)]

use bevy_app::prelude::*;
use bevy_ecs::prelude::*;
use bevy_math::Vec2;
use bevy_tiny_physics::prelude::*;
use bevy_transform::prelude::Transform;

pub fn app() -> App {
    let mut app = App::new();
    app.add_plugins(PhysicsPlugin::default().gravity(Vec2::new(0.0, -10.0)).dt(1.0 / 60.0));
    app
}

pub fn steps(app: &mut App, count: usize) {
    for _ in 0..count {
        app.world_mut().run_schedule(FixedUpdate);
    }
}

pub fn ground(app: &mut App) -> Entity {
    let ground =
        (RigidBody::Static, Collider::rect(50.0, 1.0), Transform::from_xyz(0.0, -1.0, 0.0));
    app.world_mut().spawn(ground).id()
}

pub fn ball(app: &mut App, x: f32, y: f32) -> Entity {
    app.world_mut()
        .spawn((RigidBody::Dynamic, Collider::circle(0.5), Transform::from_xyz(x, y, 0.0)))
        .id()
}

pub fn place(app: &App, entity: Entity) -> Vec2 {
    app.world().get::<Transform>(entity).unwrap().translation.truncate()
}

pub fn physics(app: &App) -> &PhysicsWorld {
    app.world().resource::<PhysicsWorld>()
}

/// All messages of a kind that have been sent.
pub fn messages<M: Message + Clone>(app: &App) -> Vec<M> {
    let messages = app.world().resource::<Messages<M>>();
    messages.get_cursor().read(messages).cloned().collect()
}
