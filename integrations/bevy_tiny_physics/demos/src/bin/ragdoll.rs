//! A ragdoll on stairs, dragged by the mouse.

use bevy::prelude::*;
use bevy_tiny_physics::prelude::*;
use demos::{Brush, Cursor, Demo, Ink};

fn main() {
    let demo =
        Demo { title: "Ragdoll: drag it by the mouse", height: 7.6, center: Vec2::new(-1.6, 3.1) };
    App::new()
        .add_plugins(demo)
        .add_systems(Startup, (stairs, ragdolls))
        .add_systems(PreUpdate, lead_cursor)
        .add_systems(Update, (drag, draw_pull))
        .run();
}

fn stairs(mut brush: Brush) {
    let mut block = |x: f32, y: f32, w: f32, h: f32| {
        let collider = Collider::rect(w, h);
        let entity = (
            RigidBody::Static,
            collider.clone(),
            Transform::from_xyz(x, y, -1.0),
            Visibility::default(),
        );
        let entity = brush.commands.spawn(entity).id();
        brush.paint(entity, &collider, Ink("4a5270"));
    };
    block(0.0, -0.5, 12.0, 0.5);
    for step in 0..5 {
        let height = 0.35 * (5 - step) as f32;
        block(-7.4 + 0.9 * step as f32, height, 0.45, height);
    }
}

/// One part of a ragdoll: name, ends of its capsule, radius, what it hangs on, where, and how far it bends.
struct Part {
    ends: [(f32, f32); 2],
    radius: f32,
    on: Option<usize>,
    at: (f32, f32),
    bend: (f32, f32),
}

const fn part(
    ends: [(f32, f32); 2],
    radius: f32,
    on: usize,
    at: (f32, f32),
    bend: (f32, f32),
) -> Part {
    Part { ends, radius, on: Some(on), at, bend }
}

/// Feet at y = 0, about 1.8 m high.
const PARTS: [Part; 10] = [
    Part {
        ends: [(0.0, 0.95), (0.0, 1.3)],
        radius: 0.17,
        on: None,
        at: (0.0, 0.0),
        bend: (0.0, 0.0),
    },
    part([(0.0, 1.62), (0.0, 1.66)], 0.16, 0, (0.0, 1.46), (-0.5, 0.5)),
    part([(-0.22, 1.32), (-0.42, 1.12)], 0.08, 0, (-0.18, 1.36), (-1.8, 1.8)),
    part([(-0.46, 1.08), (-0.66, 0.88)], 0.07, 2, (-0.44, 1.1), (-0.1, 2.0)),
    part([(0.22, 1.32), (0.42, 1.12)], 0.08, 0, (0.18, 1.36), (-1.8, 1.8)),
    part([(0.46, 1.08), (0.66, 0.88)], 0.07, 4, (0.44, 1.1), (-2.0, 0.1)),
    part([(-0.1, 0.85), (-0.14, 0.52)], 0.11, 0, (-0.09, 0.88), (-1.0, 1.2)),
    part([(-0.14, 0.46), (-0.16, 0.1)], 0.09, 6, (-0.14, 0.49), (-1.6, 0.05)),
    part([(0.1, 0.85), (0.14, 0.52)], 0.11, 0, (0.09, 0.88), (-1.2, 1.0)),
    part([(0.14, 0.46), (0.16, 0.1)], 0.09, 8, (0.14, 0.49), (-0.05, 1.6)),
];

fn ragdolls(mut brush: Brush) {
    for (doll, (x, y)) in [(-7.2, 3.9), (0.5, 0.3), (4.0, 2.0)].into_iter().enumerate() {
        ragdoll(&mut brush, Vec2::new(x, y), doll);
    }
}

fn ragdoll(brush: &mut Brush, place: Vec2, doll: usize) {
    let mut bodies: Vec<Entity> = Vec::new();
    for (number, part) in PARTS.iter().enumerate() {
        let [a, b] = part.ends.map(|(x, y)| Vec2::new(x, y));
        let (middle, half) = ((a + b) / 2.0, (b - a) / 2.0);
        let collider = Collider::capsule(-half, half, part.radius);
        let at = Transform::from_translation(
            (place + middle).extend(doll as f32 + 0.05 * number as f32),
        );
        let look = (at, Visibility::default());
        let body = (
            RigidBody::Dynamic,
            collider.clone(),
            Friction(0.7),
            Damping { linear: 0.0, angular: 1.0 },
            look,
        );
        let body = brush.commands.spawn(body).id();
        brush.paint(
            body,
            &collider,
            if number == 1 {
                Ink("f4c9a0")
            } else {
                Ink::nth(3 * doll + [0, 0, 4, 4, 4, 4, 5, 5, 5, 5][number])
            },
        );
        if let Some(on) = part.on {
            let at = place + Vec2::new(part.at.0, part.at.1);
            let hinge = JointDef::revolute().anchor_at((f64::from(at.x), f64::from(at.y)));
            brush.commands.spawn(Joint::new(
                bodies[on],
                body,
                hinge.limits(part.bend.0, part.bend.1),
            ));
        }
        bodies.push(body);
    }
}

/// The joint by which the mouse pulls.
#[derive(Component)]
struct Pull;

fn drag(
    cursor: Res<Cursor>,
    bodies: Query<&RigidBody>,
    pulls: Query<Entity, With<Pull>>,
    mut physics: ResMut<PhysicsWorld>,
    mut commands: Commands,
) {
    let target = (f64::from(cursor.at.x), f64::from(cursor.at.y));
    if cursor.pressed {
        let near = physics.world.closest_point(target, 0.3, &tiny_physics::QueryFilter::new());
        let caught = near.and_then(|near| Some((near.point, physics.body_entity(near.body)?)));
        let Some((point, body)) =
            caught.filter(|(_, body)| bodies.get(*body) == Ok(&RigidBody::Dynamic))
        else {
            return;
        };
        let anchor = physics.body(body).map(|body| body.pose().unapply(point)).unwrap_or_default();
        let hand = commands.spawn((RigidBody::Static, Transform::default())).id();
        let pull = JointDef::mouse(target, 800.0).anchors((0.0, 0.0), anchor);
        commands.entity(hand).insert((Pull, Joint::new(hand, body, pull)));
    }
    for pull in &pulls {
        if !cursor.held {
            commands.entity(pull).despawn();
        } else if let Some(id) = physics.joint_id(pull)
            && let Some(mut joint) = physics.world.joint_mut(id)
        {
            let _ = joint.set_target_point(target);
        }
    }
}

fn draw_pull(
    pulls: Query<Entity, With<Pull>>,
    physics: Res<PhysicsWorld>,
    cursor: Res<Cursor>,
    mut gizmos: Gizmos,
) {
    for joint in pulls.iter().filter_map(|pull| physics.joint(pull)) {
        let end = joint.anchors().1;
        gizmos.line_2d(cursor.at, Vec2::new(end.x as f32, end.y as f32), Color::WHITE);
        gizmos.circle_2d(cursor.at, 0.12, Color::WHITE);
    }
}

/// Where a picture is taken, the cursor takes the second ragdoll by its head and lifts it.
fn lead_cursor(mut cursor: ResMut<Cursor>, time: Res<Time>) {
    if !std::env::args().any(|argument| argument == "--picture") {
        return;
    }
    let seconds = time.elapsed_secs();
    cursor.led = true;
    cursor.pressed = !cursor.held && seconds > 0.15;
    cursor.held |= seconds > 0.15;
    let lift = ((seconds - 0.3) / 1.0).clamp(0.0, 1.0);
    cursor.at = Vec2::new(0.5, 1.94) + lift * Vec2::new(0.2 + 1.2 * (3.0 * seconds).sin(), 2.6);
}

use bevy_tiny_physics::tiny_physics;
