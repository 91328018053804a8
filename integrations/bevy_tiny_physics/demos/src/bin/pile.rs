//! A pile: things rain into a trough, a click blows them up.

use bevy::prelude::*;
use bevy_tiny_physics::prelude::*;
use bevy_tiny_physics::tiny_physics::{DVec2, Explosion, QueryFilter};
use demos::{Brush, Cursor, Demo, Ink};

fn main() {
    let demo = Demo {
        title: "Pile: click blows up, Space rains",
        height: 16.0,
        center: Vec2::new(0.0, 6.0),
    };
    App::new()
        .add_plugins(demo)
        .insert_resource(Rain { left: 260, fallen: 0 })
        .add_systems(Startup, trough)
        .add_systems(Update, (more, blow_up))
        .add_systems(FixedUpdate, rain.before(PhysicsSystems::Read))
        .run();
}

/// What is still to fall.
#[derive(Resource)]
struct Rain {
    left: u32,
    fallen: u32,
}

fn trough(mut brush: Brush) {
    for (x, y, w, h, turn) in
        [(0.0, -0.7, 14.0, 0.5, 0.0), (-10.2, 3.0, 5.0, 0.3, -0.9), (10.2, 3.0, 5.0, 0.3, 0.9)]
    {
        let collider = Collider::rect(w, h);
        let at = Transform::from_xyz(x, y, 0.0).with_rotation(Quat::from_rotation_z(turn));
        let wall = brush
            .commands
            .spawn((RigidBody::Static, collider.clone(), at, Visibility::default()))
            .id();
        brush.paint(wall, &collider, Ink("4a5270"));
    }
}

fn rain(mut brush: Brush, mut rain: ResMut<Rain>, physics: Res<PhysicsWorld>) {
    if rain.left == 0 || !physics.world.step_count().is_multiple_of(3) {
        return;
    }
    rain.left -= 1;
    rain.fallen += 1;
    let n = rain.fallen as usize;
    let collider = match n % 5 {
        0 => Collider::circle(0.42),
        1 => Collider::rect(0.42, 0.42),
        2 => Collider::regular(3 + n / 5 % 4, 0.5),
        3 => Collider::capsule(Vec2::new(-0.35, 0.0), Vec2::new(0.35, 0.0), 0.26),
        _ => Collider::rounded_rect(0.4, 0.2, 0.12),
    };
    let x = ((n * 37) % 60) as f32 * 0.2 - 6.0;
    let at =
        Transform::from_xyz(x, 16.0, n as f32 * 0.1).with_rotation(Quat::from_rotation_z(n as f32));
    let body = brush
        .commands
        .spawn((RigidBody::Dynamic, collider.clone(), Friction(0.5), at, Visibility::default()))
        .id();
    brush.paint(body, &collider, Ink::nth(n * 3));
}

fn more(keys: Res<ButtonInput<KeyCode>>, mut rain: ResMut<Rain>) {
    if keys.just_pressed(KeyCode::Space) {
        rain.left += 100;
    }
}

fn blow_up(cursor: Res<Cursor>, mut physics: ResMut<PhysicsWorld>) {
    if cursor.pressed {
        let center = DVec2::new(cursor.at.x.into(), cursor.at.y.into());
        let explosion = Explosion { center, radius: 1.0, falloff: 3.0, impulse_per_metre: 10.0 };
        physics.world.explode(&explosion, &QueryFilter::new());
    }
}
