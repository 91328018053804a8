//! `cargo run --release`: a pile of boxes falls into a trough, in each plugin. Prints the CPU time of a whole `App::update` with one
//! fixed step, milliseconds: components in, step, components out. One thread each.

use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use std::time::Duration;

/// Steps before the clock runs, steps of a measurement.
const STEPS: (usize, usize) = (60, 240);
/// Half the side of a box, metres.
const HALF: f32 = 0.25;

fn main() {
    for count in [1000, 5000] {
        for round in 0..3 {
            let times = [
                time(tiny(), count, spawn_tiny),
                time(rapier(), count, spawn_rapier),
                time(avian(), count, spawn_avian),
            ];
            println!(
                "{count} bodies, round {round}: tiny-physics {:.2} ms, bevy_rapier2d {:.2} ms, Avian {:.2} ms",
                times[0], times[1], times[2]
            );
        }
    }
}

fn app() -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, TransformPlugin))
        .insert_resource(Time::<Fixed>::from_hz(60.0))
        .insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_nanos(16_666_667)));
    app
}

/// What is spawned: place, half extents, and whether it moves.
type Spawn = fn(&mut World, Vec2, Vec2, bool);

fn time(mut app: App, count: usize, spawn: Spawn) -> f64 {
    let columns = (count as f32).sqrt() as usize;
    let width = columns as f32 * HALF * 2.2;
    let world = app.world_mut();
    spawn(world, Vec2::new(0.0, -1.0), Vec2::new(width, 1.0), false);
    for side in [-1.0, 1.0] {
        spawn(world, Vec2::new(side * (width / 2.0 + 1.5), 50.0), Vec2::new(1.0, 50.0), false);
    }
    for i in 0..count {
        let (x, y) = ((i % columns) as f32, (i / columns) as f32);
        let shift = if i / columns % 2 == 0 { 0.0 } else { 0.1 };
        let at = Vec2::new((x + shift) * HALF * 2.2 - width / 2.0, 0.5 + y * HALF * 2.4);
        spawn(world, at, Vec2::splat(HALF), true);
    }
    app.finish();
    app.cleanup();
    (0..STEPS.0).for_each(|_| app.update());
    let start = cpu_seconds();
    (0..STEPS.1).for_each(|_| app.update());
    1000.0 * (cpu_seconds() - start) / STEPS.1 as f64
}

/// Time that this thread was on a processor (Linux).
fn cpu_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|word| word.parse::<f64>().ok()).unwrap_or_default() * 1e-9
}

fn tiny() -> App {
    let mut app = app();
    app.add_plugins(bevy_tiny_physics::PhysicsPlugin::default());
    app
}

fn spawn_tiny(world: &mut World, at: Vec2, half: Vec2, moves: bool) {
    use bevy_tiny_physics::prelude::{Collider, RigidBody};
    let kind = if moves { RigidBody::Dynamic } else { RigidBody::Static };
    world.spawn((
        kind,
        Collider::rect(half.x, half.y),
        Transform::from_translation(at.extend(0.0)),
    ));
}

fn rapier() -> App {
    use bevy_rapier2d::prelude::{NoUserData, RapierPhysicsPlugin, TimestepMode};
    let mut app = app();
    app.add_plugins(RapierPhysicsPlugin::<NoUserData>::pixels_per_meter(1.0).in_fixed_schedule());
    app.insert_resource(TimestepMode::Fixed { dt: 1.0 / 60.0, substeps: 1 });
    app
}

fn spawn_rapier(world: &mut World, at: Vec2, half: Vec2, moves: bool) {
    use bevy_rapier2d::prelude::{Collider, RigidBody};
    let kind = if moves { RigidBody::Dynamic } else { RigidBody::Fixed };
    world.spawn((
        kind,
        Collider::cuboid(half.x, half.y),
        Transform::from_translation(at.extend(0.0)),
    ));
}

fn avian() -> App {
    let mut app = app();
    app.add_plugins(avian2d::PhysicsPlugins::default());
    app
}

fn spawn_avian(world: &mut World, at: Vec2, half: Vec2, moves: bool) {
    use avian2d::prelude::{Collider, RigidBody};
    let kind = if moves { RigidBody::Dynamic } else { RigidBody::Static };
    world.spawn((
        kind,
        Collider::rectangle(2.0 * half.x, 2.0 * half.y),
        Transform::from_translation(at.extend(0.0)),
    ));
}
