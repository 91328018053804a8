//! A car on hills, over a bridge of planks.

use bevy::prelude::*;
use bevy_tiny_physics::prelude::*;
use demos::{Brush, Camera, Demo, Ink};

fn main() {
    let demo = Demo { title: "Car: left and right", height: 9.0, center: Vec2::new(4.0, 1.2) };
    App::new()
        .add_plugins(demo)
        .add_systems(Startup, (hills, bridge, car))
        .add_systems(FixedUpdate, drive.before(PhysicsSystems::Read))
        .add_systems(Update, follow)
        .run();
}

/// The body of the car.
#[derive(Component)]
struct Car;

/// A joint that drives a wheel.
#[derive(Component)]
struct Drive;

/// The bridge spans these places.
const GAP: (f32, f32) = (22.0, 34.0);

fn height(x: f32) -> f32 {
    let hills = 0.6 * (0.45 * x).sin() + 0.35 * (0.9 * x + 1.0).sin();
    let near_bridge = ((x - GAP.0).abs().min((x - GAP.1).abs()) / 4.0).min(1.0);
    if x > GAP.0 && x < GAP.1 { -4.0 } else { hills * near_bridge }
}

fn hills(mut brush: Brush) {
    const SPACING: f32 = 0.5;
    let heights: Vec<f32> = (0..=240).map(|i| height(i as f32 * SPACING - 20.0)).collect();
    let collider = Collider::chain(&ChainDef::heights(SPACING, &heights).friction(0.9));
    brush.commands.spawn((RigidBody::Static, collider, Transform::from_xyz(-20.0, 0.0, 0.0)));
    for (i, pair) in heights.windows(2).enumerate() {
        let corners = [(0.0, -9.0), (SPACING, -9.0), (SPACING, pair[1]), (0.0, pair[0])]
            .map(|(x, y)| Vec2::new(x, y));
        let at = Transform::from_xyz(i as f32 * SPACING - 20.0, 0.0, -1.0);
        brush.polygon(at, &corners, Ink("46583f"));
        let turf =
            [(0.0, pair[0] - 0.25), (SPACING, pair[1] - 0.25), (SPACING, pair[1]), (0.0, pair[0])];
        brush.polygon(
            at.with_translation(at.translation + Vec3::Z * 0.1),
            &turf.map(|(x, y)| Vec2::new(x, y)),
            Ink("7fa06e"),
        );
    }
}

fn bridge(mut brush: Brush) {
    const PLANKS: usize = 12;
    let length = (GAP.1 - GAP.0) / PLANKS as f32;
    let banks = [GAP.0, GAP.1]
        .map(|x| brush.commands.spawn((RigidBody::Static, Transform::from_xyz(x, 0.0, 0.0))).id());
    let collider = Collider::rect(0.48 * length, 0.1);
    let mut last = banks[0];
    for plank in 0..PLANKS {
        let at = Transform::from_xyz(GAP.0 + (plank as f32 + 0.5) * length, -0.1, 0.0);
        let body = (
            RigidBody::Dynamic,
            collider.clone(),
            Density(30.0),
            Friction(0.9),
            at,
            Visibility::default(),
        );
        let body = brush.commands.spawn(body).id();
        brush.paint(body, &collider, Ink("b5793f"));
        hinge(&mut brush, last, body, GAP.0 + plank as f32 * length);
        last = body;
    }
    hinge(&mut brush, last, banks[1], GAP.1);
}

fn hinge(brush: &mut Brush, a: Entity, b: Entity, x: f32) {
    brush.commands.spawn(Joint::new(a, b, JointDef::revolute().anchor_at((f64::from(x), -0.1))));
}

fn car(mut brush: Brush) {
    let hull = [
        (-1.5, -0.2),
        (1.5, -0.2),
        (1.55, 0.15),
        (0.9, 0.25),
        (0.35, 0.8),
        (-0.8, 0.8),
        (-1.45, 0.25),
    ];
    let collider = Collider::hull(&hull.map(|(x, y)| Vec2::new(x, y)));
    let at = Transform::from_xyz(0.0, 2.2, 1.0);
    let car = brush
        .commands
        .spawn((
            Car,
            RigidBody::Dynamic,
            collider.clone(),
            Density(60.0),
            at,
            Visibility::default(),
        ))
        .id();
    brush.paint(car, &collider, Ink("e76f51"));
    let pane =
        [(-0.55, 0.3), (0.45, 0.3), (0.2, 0.66), (-0.55, 0.66)].map(|(x, y)| Vec2::new(x, y));
    let pane = brush.polygon(Transform::from_xyz(0.0, 0.0, 0.3), &pane, Ink("cfe3ee"));
    brush.commands.entity(pane).insert(ChildOf(car));
    let tyre = Collider::circle(0.45);
    for x in [-1.0, 1.0] {
        let at = Transform::from_xyz(x, 1.7, 2.0);
        let wheel = (
            RigidBody::Dynamic,
            tyre.clone(),
            Density(30.0),
            Friction(1.5),
            at,
            Visibility::default(),
        );
        let wheel = brush.commands.spawn(wheel).id();
        brush.paint(wheel, &tyre, Ink("8d93a8"));
        let axle = JointDef::wheel((0.0, 1.0))
            .anchors((x, -0.5), (0.0, 0.0))
            .spring(4.0, 0.7)
            .limits(-0.25, 0.25);
        brush.commands.spawn((Drive, Joint::new(car, wheel, axle.motor(0.0, 300.0))));
    }
}

/// Top speed of the wheels, radians a second.
const SPEED: f32 = 22.0;

fn drive(
    keys: Res<ButtonInput<KeyCode>>,
    drives: Query<Entity, With<Drive>>,
    mut physics: ResMut<PhysicsWorld>,
) {
    let mut gas =
        f32::from(keys.pressed(KeyCode::ArrowRight)) - f32::from(keys.pressed(KeyCode::ArrowLeft));
    if std::env::args().any(|argument| argument == "--picture") {
        gas = 0.6;
    }
    for joint in drives.iter().filter_map(|entity| physics.joint_id(entity)).collect::<Vec<_>>() {
        let Some(mut joint) = physics.world.joint_mut(joint) else { continue };
        if joint.as_ref().def().kind.motor().is_some_and(|motor| motor.speed != -SPEED * gas) {
            let _ = joint.set_motor_speed(-SPEED * gas);
        }
    }
}

fn follow(
    cars: Query<&Transform, (With<Car>, Without<Camera>)>,
    mut cameras: Query<&mut Transform, With<Camera>>,
) {
    let (Ok(car), Ok(mut camera)) = (cars.single(), cameras.single_mut()) else { return };
    camera.translation.x = car.translation.x + 3.0;
}
