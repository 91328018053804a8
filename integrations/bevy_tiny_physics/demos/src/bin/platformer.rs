//! A platformer: ground of tiles, a lift, coins that are sensors, crates to push.

use bevy::prelude::*;
use bevy_tiny_physics::prelude::*;
use demos::{Brush, Camera, Demo, Ink};

/// `o` coin, `x` crate, `=` lift; the rest is that of [`TileGrid::parse`].
const LEVEL: [&str; 14] = [
    "#............................................#",
    "#............................................#",
    "#.........................o.o.o..............#",
    "#........................#######.............#",
    "#.............o..............................#",
    "#...........-----......=..............o......#",
    "#...................................#####....#",
    "#......o.............................#########",
    "#.....---......./####\\.......................#",
    "#............../######\\..........x...........#",
    "#..o...o.x.x../########\\...lh...xx..o..HL....#",
    "##############################################",
    "##############################################",
    "##############################################",
];

fn main() {
    let demo = Demo {
        title: "Platformer: arrows, Space jumps, down drops",
        height: 13.0,
        center: Vec2::new(11.0, 7.0),
    };
    App::new()
        .add_plugins(demo)
        .add_systems(Startup, (ground, things))
        .add_systems(Update, (steer, follow))
        .add_systems(FixedUpdate, run_lifts.before(PhysicsSystems::Read))
        .add_systems(FixedUpdate, pick_up.after(PhysicsSystems::Write))
        .run();
}

/// Something to collect.
#[derive(Component)]
struct Coin;

/// A lift that goes up and down from where it is.
#[derive(Component)]
struct Lift(Vec2);

fn ground(mut brush: Brush) {
    let grid = TileGrid::parse(1.0, &LEVEL).unwrap_or_else(|error| panic!("the level: {error}"));
    for (y, x) in (0..grid.height).flat_map(|y| (0..grid.width).map(move |x| (y, x))) {
        let letter = LEVEL[(grid.height - 1 - y) as usize].as_bytes()[x as usize] as char;
        let corners: &[(f32, f32)] = match letter {
            '#' => &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)],
            '/' => &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)],
            '\\' => &[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)],
            'l' => &[(0.0, 0.0), (1.0, 0.0), (1.0, 0.5)],
            'h' => &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 0.5)],
            'H' => &[(0.0, 0.0), (1.0, 0.0), (1.0, 0.5), (0.0, 1.0)],
            'L' => &[(0.0, 0.0), (1.0, 0.0), (0.0, 0.5)],
            '-' => &[(0.0, 0.8), (1.0, 0.8), (1.0, 1.0), (0.0, 1.0)],
            _ => continue,
        };
        let corners: Vec<Vec2> = corners.iter().map(|(x, y)| Vec2::new(*x, *y)).collect();
        let open = y + 1 < grid.height && grid.get(x, y + 1) == 0;
        let ink = if open { "6a8f5f" } else { "46583f" };
        brush.polygon(
            Transform::from_xyz(x as f32, y as f32, -1.0),
            &corners,
            Ink(if letter == '-' { "c9a36a" } else { ink }),
        );
    }
    brush.commands.spawn(TileMap(grid));
}

fn things(mut brush: Brush) {
    for (row, line) in LEVEL.iter().rev().enumerate() {
        for (column, letter) in line.chars().enumerate() {
            let at = Transform::from_xyz(column as f32 + 0.5, row as f32 + 0.5, 0.0);
            match letter {
                'o' => {
                    let collider = Collider::regular(8, 0.28);
                    let coin = brush
                        .commands
                        .spawn((Coin, collider.clone(), Sensor, at, Visibility::default()))
                        .id();
                    brush.paint(coin, &collider, Ink("f2c14e"));
                }
                'x' => {
                    let collider = Collider::rect(0.48, 0.48);
                    let crate_ = (
                        RigidBody::Dynamic,
                        collider.clone(),
                        Density(20.0),
                        at,
                        Visibility::default(),
                    );
                    let crate_ = brush.commands.spawn(crate_).id();
                    brush.paint(crate_, &collider, Ink("b5793f"));
                }
                '=' => {
                    let collider = Collider::rect(1.4, 0.15);
                    let home = at.translation.truncate();
                    let lift = (
                        Lift(home),
                        RigidBody::Kinematic,
                        collider.clone(),
                        KinematicTarget { position: home, angle: 0.0 },
                    );
                    let lift = brush.commands.spawn((lift, at, Visibility::default())).id();
                    brush.paint(lift, &collider, Ink("5b8fb9"));
                }
                _ => {}
            }
        }
    }
    let body = Collider::capsule(Vec2::new(0.0, -0.35), Vec2::new(0.0, 0.35), 0.35);
    let hero = brush
        .commands
        .spawn((
            Character::new(1.4, 0.35),
            Transform::from_xyz(2.5, 4.0, 1.0),
            Visibility::default(),
        ))
        .id();
    brush.paint(hero, &body, Ink("e76f51"));
    let eye = brush.polygon(
        Transform::from_xyz(0.12, 0.3, 0.5),
        &[Vec2::ZERO, Vec2::new(0.12, 0.0), Vec2::new(0.12, 0.16), Vec2::new(0.0, 0.16)],
        Ink("ffffff"),
    );
    brush.commands.entity(eye).insert(ChildOf(hero));
}

fn run_lifts(physics: Res<PhysicsWorld>, mut lifts: Query<(&Lift, &mut KinematicTarget)>) {
    let seconds = (physics.world.step_count() + 1) as f32 / 60.0;
    for (lift, mut target) in &mut lifts {
        target.position = lift.0 + Vec2::new(0.0, 2.0 - 3.0 * (seconds * 0.8).cos());
    }
}

fn steer(keys: Res<ButtonInput<KeyCode>>, mut heroes: Query<&mut CharacterInput>, time: Res<Time>) {
    let taking_picture = std::env::args().any(|argument| argument == "--picture");
    for mut input in &mut heroes {
        let left_right = f32::from(keys.pressed(KeyCode::ArrowRight))
            - f32::from(keys.pressed(KeyCode::ArrowLeft));
        input.walk = 5.0 * left_right;
        if taking_picture {
            input.walk = 4.0;
        }
        if keys.just_pressed(KeyCode::Space) || (taking_picture && time.elapsed_secs() % 1.0 < 0.1)
        {
            input.jump = 8.5;
        }
        input.drop |= keys.just_pressed(KeyCode::ArrowDown);
    }
}

fn pick_up(
    mut entered: MessageReader<SensorEntered>,
    heroes: Query<Entity, With<Character>>,
    coins: Query<Entity, With<Coin>>,
    mut commands: Commands,
    mut window: Single<&mut Window>,
    mut found: Local<u32>,
) {
    for event in entered.read() {
        if heroes.contains(event.sensor_body) && coins.contains(event.visitor) {
            *found += 1;
            window.title = format!("Coins: {}", *found);
            commands.entity(event.visitor).despawn();
        }
    }
}

fn follow(
    heroes: Query<&Transform, (With<Character>, Without<Camera>)>,
    mut cameras: Query<&mut Transform, With<Camera>>,
) {
    let (Ok(hero), Ok(mut camera)) = (heroes.single(), cameras.single_mut()) else { return };
    camera.translation.x = hero.translation.x.clamp(10.4, 35.0);
}
