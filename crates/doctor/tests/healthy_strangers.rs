//! Small worlds of games in which nothing is wrong, by an author who did not know the doctor's rules.
//!
//! `cargo test -p tiny-physics-doctor --test healthy_strangers -- --nocapture` prints all that the doctor finds there
//! beyond notes: every such finding is one too many.

use tiny_physics::{BodyId, Explosion};
use tiny_physics::{
    ChainDef, CharacterMover, Filter, FixedStep, JointDef, MoverInput, QueryFilter, RigidBody,
    Settings, Shape, ShapeDef, TileGrid, Transform, Vec2, Water, World, math,
};
use tiny_physics_doctor::{Doctor, Severity};

const DT: f32 = 1.0 / 60.0;

type Act = Box<dyn FnMut(&mut World, u64)>;

/// A healthy world and what its game does before each step.
struct Healthy {
    name: &'static str,
    steps: u64,
    world: World,
    act: Act,
}

fn left_alone(name: &'static str, steps: u64, world: World) -> Healthy {
    with(name, steps, world, |_, _| {})
}

fn with(
    name: &'static str,
    steps: u64,
    world: World,
    act: impl FnMut(&mut World, u64) + 'static,
) -> Healthy {
    Healthy { name, steps, world, act: Box::new(act) }
}

fn healthy() -> Vec<Healthy> {
    vec![
        pyramid(),
        bowling(),
        bouncing_balls(),
        dominoes(),
        car(),
        bridge(),
        lift(),
        sorting(),
        saloon_door(),
        walker(),
        tile_level(),
        hills(),
        billiards(),
        pixels(),
        conveyor(),
        fast_belt(),
        sliding_door(),
        one_way_lift(),
        fountain(),
        explosion(),
        rafts(),
        ragdoll(),
        wrecking_ball(),
        sailing_asteroids(),
        bullets(),
        one_way_platforms(),
        pendulum_clock(),
        pooled_enemies(),
        respawn(),
        crane(),
        friends_pass(),
        shop_sign(),
    ]
}

fn earth() -> World {
    World::new(Vec2::new(0.0, -10.0))
}

fn block(world: &mut World, x: f32, y: f32, half_width: f32, half_height: f32) -> BodyId {
    let shape = Shape::rect(half_width, half_height).unwrap();
    world.add_body(RigidBody::fixed().position(Vec2::new(x, y)).shape(shape)).unwrap()
}

fn ground(world: &mut World) -> BodyId {
    block(world, 0.0, -0.5, 60.0, 0.5)
}

fn plank(half_width: f32, half_height: f32, x: f32, y: f32) -> RigidBody {
    let shape = Shape::rect(half_width, half_height).unwrap();
    RigidBody::dynamic().position(Vec2::new(x, y)).shape(shape)
}

fn ball(radius: f32, x: f32, y: f32) -> RigidBody {
    RigidBody::dynamic().position(Vec2::new(x, y)).shape(Shape::circle(radius).unwrap())
}

fn add(world: &mut World, body: RigidBody) -> BodyId {
    world.add_body(body).unwrap()
}

/// Walls around a table seen from above.
fn table(world: &mut World, half_width: f32, half_height: f32, restitution: f32) {
    for side in [-1.0, 1.0] {
        let ends = Shape::rect(0.2, half_height + 0.4).unwrap();
        let sides = Shape::rect(half_width, 0.2).unwrap();
        let place = Vec2::new(side * (half_width + 0.2), 0.0);
        add(world, RigidBody::fixed().position(place).shape(ends).restitution(restitution));
        let place = Vec2::new(0.0, side * (half_height + 0.2));
        add(world, RigidBody::fixed().position(place).shape(sides).restitution(restitution));
    }
}

fn pyramid() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    for row in 0..12 {
        for i in 0..12 - row {
            let x = -6.0 + 1.05 * i as f32 + 0.525 * row as f32;
            add(&mut world, plank(0.5, 0.5, x, 0.5 + row as f32));
        }
    }
    left_alone("pyramid at rest", 400, world)
}

fn bowling() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    for i in 0..6 {
        add(&mut world, plank(0.06, 0.19, 15.0 + 0.3 * i as f32, 0.19).mass(1.5));
    }
    let bowl = ball(0.11, -5.0, 0.11).mass(6.0);
    add(&mut world, bowl.velocity(Vec2::new(8.0, 0.0)).angular_velocity(-70.0));
    left_alone("bowling ball through pins", 400, world)
}

fn bouncing_balls() -> Healthy {
    let mut world = earth();
    let floor = Shape::rect(20.0, 0.5).unwrap();
    let floor = RigidBody::fixed().position(Vec2::new(0.0, -0.5)).shape(floor);
    add(&mut world, floor.restitution(1.0));
    for i in 0..6 {
        let restitution = 0.3 + 0.12 * i as f32;
        add(&mut world, ball(0.3, -6.0 + 2.0 * i as f32, 4.0).restitution(restitution));
    }
    left_alone("balls bounce, each by its material", 500, world)
}

fn dominoes() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    for i in 0..25 {
        add(&mut world, plank(0.08, 0.5, 0.5 * i as f32, 0.5));
    }
    add(&mut world, ball(0.2, -1.5, 0.9).velocity(Vec2::new(4.0, 0.0)));
    left_alone("row of dominoes", 500, world)
}

fn car() -> Healthy {
    let mut world = earth();
    let points: Vec<_> = (0..60)
        .map(|i| {
            let x = 100.0 - 2.0 * i as f32;
            Vec2::new(x, 0.6 * math::sin(x * 0.25))
        })
        .collect();
    let hills = add(&mut world, RigidBody::fixed());
    world.add_chain(hills, &ChainDef::open(&points).friction(0.9)).unwrap();
    let chassis = add(&mut world, plank(1.2, 0.25, 0.0, 2.0).mass(800.0));
    for x in [-0.85, 0.85] {
        let wheel = add(&mut world, ball(0.4, x, 1.6).mass(30.0).friction(0.95));
        let strut = JointDef::wheel(Vec2::Y)
            .anchors(Vec2::new(x, -0.4), Vec2::ZERO)
            .spring(4.0, 0.7)
            .limits(-0.25, 0.25)
            .motor(-15.0, 900.0);
        world.add_joint(chassis, wheel, strut).unwrap();
    }
    left_alone("car drives over hills", 500, world)
}

fn bridge() -> Healthy {
    let mut world = earth();
    block(&mut world, 0.0, -4.0, 30.0, 0.5);
    let mut last = block(&mut world, -8.0, 3.0, 1.5, 0.5);
    let right = block(&mut world, 8.0, 3.0, 1.5, 0.5);
    let mut hook = Vec2::new(1.5, 0.4);
    for i in 0..13 {
        let board = add(&mut world, plank(0.48, 0.1, -6.0 + i as f32, 3.4).mass(20.0));
        let pin = JointDef::revolute().anchors(hook, Vec2::new(-0.5, 0.0));
        world.add_joint(last, board, pin).unwrap();
        (last, hook) = (board, Vec2::new(0.5, 0.0));
    }
    let pin = JointDef::revolute().anchors(hook, Vec2::new(-1.5, 0.4));
    world.add_joint(last, right, pin).unwrap();
    for i in 0..3 {
        add(&mut world, plank(0.4, 0.4, -2.0 + 2.0 * i as f32, 4.5).mass(40.0));
    }
    left_alone("bridge with three loads", 600, world)
}

fn lift() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    let deck = Shape::rect(2.0, 0.15).unwrap();
    let lift = RigidBody::kinematic().position(Vec2::new(0.0, 0.16)).shape(deck);
    let lift = add(&mut world, lift);
    add(&mut world, plank(0.5, 0.5, -0.8, 0.82));
    add(&mut world, ball(0.4, 0.8, 0.72).damping(0.0, 2.0));
    with("lift with two passengers", 600, world, move |world, step| {
        let height = 0.16 + 3.0 * (1.0 - math::cos(step as f32 * DT));
        let target = Transform::from_angle(Vec2::new(0.0, height), 0.0);
        world.body_mut(lift).unwrap().set_target(target, DT);
    })
}

/// Parcels of two kinds run over a sensor, which puts the blue ones on another lane by their filter.
fn sorting() -> Healthy {
    let mut world = earth();
    let belt = ShapeDef::new(Shape::rect(10.0, 0.2).unwrap()).tangent_speed(2.0);
    add(&mut world, RigidBody::fixed().position(Vec2::new(0.0, 2.0)).shape(belt));
    block(&mut world, 12.0, -1.0, 14.0, 0.5);
    block(&mut world, 25.0, 1.0, 0.5, 2.5);
    let eye = ShapeDef::new(Shape::rect(0.2, 1.0).unwrap()).sensor();
    add(&mut world, RigidBody::fixed().position(Vec2::new(3.0, 3.0)).shape(eye));
    let mut seen = 0;
    with("parcels on a belt past a sensor", 600, world, move |world, step| {
        if step % 60 == 0 && step < 420 {
            add(world, plank(0.3, 0.3, -9.0, 2.6).user_data(step / 60));
        }
        seen += world.events().sensor_begin().len();
        assert!(seen <= 7);
    })
}

fn saloon_door() -> Healthy {
    let mut world = World::new(Vec2::ZERO);
    table(&mut world, 10.0, 6.0, 0.2);
    let post = add(&mut world, RigidBody::fixed().position(Vec2::new(0.0, 0.0)));
    let door = add(&mut world, plank(0.6, 0.06, 0.6, 0.0).mass(15.0).damping(0.0, 0.3));
    let hinge = JointDef::revolute()
        .anchors(Vec2::ZERO, Vec2::new(-0.6, 0.0))
        .spring(0.8, 0.3)
        .limits(-1.9, 1.9);
    world.add_joint(post, door, hinge).unwrap();
    let guest = add(&mut world, ball(0.3, 0.8, -4.0).mass(70.0).damping(0.0, 3.0));
    with("saloon door swings behind a guest", 400, world, move |world, step| {
        let speed = if step < 240 { 1.5 } else { 0.0 };
        if step <= 240 {
            world.body_mut(guest).unwrap().set_velocity(Vec2::new(0.0, speed));
        }
    })
}

fn level(world: &mut World) {
    let rows = [
        "......................",
        "..............########",
        ".........../##........",
        "......lh####..........",
        "######################",
    ];
    world.add_tiles(TileGrid::parse(1.0, &rows).unwrap()).unwrap();
}

fn walker() -> Healthy {
    let mut world = earth();
    level(&mut world);
    for i in 0..2 {
        add(&mut world, plank(0.3, 0.3, 3.5 + 0.8 * i as f32, 1.3).mass(10.0));
    }
    let mut hero = CharacterMover::new(Vec2::new(1.5, 2.0), 1.6, 0.3);
    with("character walks, jumps, pushes", 500, world, move |world, step| {
        let jump = if step % 120 == 100 { 5.0 } else { 0.0 };
        let walk = if step < 300 { 2.0 } else { -2.0 };
        hero.update(world, MoverInput { walk, jump, ..MoverInput::default() }, DT);
    })
}

/// A hero that is a body with locked rotation; its game sets the horizontal speed alone.
fn tile_level() -> Healthy {
    let mut world = earth();
    level(&mut world);
    for x in [0.0, 22.0] {
        block(&mut world, x, 5.0, 0.2, 5.0);
    }
    let hero = Shape::capsule(Vec2::new(0.0, -0.4), Vec2::new(0.0, 0.4), 0.3).unwrap();
    let hero = RigidBody::dynamic().position(Vec2::new(2.0, 1.8)).shape(hero);
    let hero = add(&mut world, hero.lock_rotation().friction(0.0));
    with("hero body runs to and fro in tiles", 500, world, move |world, step| {
        let way = if (step / 150) % 2 == 0 { 2.5 } else { -2.5 };
        let mut hero = world.body_mut(hero).unwrap();
        let fall = hero.as_ref().velocity().y;
        hero.set_velocity(Vec2::new(way, fall));
    })
}

fn hills() -> Healthy {
    let mut world = earth();
    let points: Vec<_> = (0..40)
        .map(|i| {
            let x = 20.0 - i as f32;
            Vec2::new(x, 0.03 * x * x + 0.3 * math::sin(x))
        })
        .collect();
    let valley = add(&mut world, RigidBody::fixed());
    world.add_chain(valley, &ChainDef::open(&points)).unwrap();
    for i in 0..12 {
        let rock = Shape::regular(5 + i % 3, 0.4 + 0.03 * i as f32).unwrap();
        let place = Vec2::new(-9.0 + 1.5 * i as f32, 6.0);
        add(&mut world, RigidBody::dynamic().position(place).shape(rock));
    }
    left_alone("rocks roll into a valley", 600, world)
}

/// In metres, as they are: balls of 57 mm.
fn billiards() -> Healthy {
    let mut world = World::new(Vec2::ZERO);
    table(&mut world, 1.27, 0.635, 0.8);
    let felt = |body: RigidBody| body.damping(0.4, 0.4).restitution(0.95).mass(0.17);
    for row in 0..5 {
        for i in 0..=row {
            let x = 0.6 + 0.052 * row as f32;
            let y = 0.0575 * (i as f32 - 0.5 * row as f32);
            add(&mut world, felt(ball(0.0285, x, y)));
        }
    }
    add(&mut world, felt(ball(0.0285, -0.7, 0.01)).velocity(Vec2::new(3.0, 0.0)));
    left_alone("billiards break in metres", 500, world)
}

fn pixels() -> Healthy {
    let settings = Settings { length_unit: 50.0, ..Settings::default() };
    let mut world = World::with_settings(Vec2::new(0.0, 500.0), settings);
    // y points down.
    block(&mut world, 400.0, 620.0, 500.0, 20.0);
    for row in 0..5 {
        for i in 0..4 {
            add(&mut world, plank(25.0, 25.0, 300.0 + 52.0 * i as f32, 575.0 - 50.0 * row as f32));
        }
    }
    add(&mut world, ball(20.0, 100.0, 580.0).velocity(Vec2::new(300.0, 0.0)));
    left_alone("crates in pixels with length_unit", 400, world)
}

fn conveyor() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    let belt = ShapeDef::new(Shape::rect(4.0, 0.2).unwrap()).tangent_speed(1.5);
    add(&mut world, RigidBody::fixed().position(Vec2::new(0.0, 1.0)).shape(belt));
    for i in 0..4 {
        add(&mut world, plank(0.3, 0.3, -3.5 + i as f32, 1.5));
    }
    left_alone("belt drops crates to the floor", 500, world)
}

fn fast_belt() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    let belt = ShapeDef::new(Shape::rect(30.0, 0.2).unwrap()).tangent_speed(6.0);
    add(&mut world, RigidBody::fixed().position(Vec2::new(0.0, 1.0)).shape(belt));
    add(&mut world, plank(0.3, 0.3, 0.0, 1.5));
    left_alone("a crate is put on a belt that runs at 6 m/s", 200, world)
}

/// A kinematic door that the game moves by its place, into the frame of the wall.
fn sliding_door() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    block(&mut world, 3.0, 1.5, 1.0, 1.5);
    let shape = Shape::rect(0.4, 1.0).unwrap();
    let door = RigidBody::kinematic().position(Vec2::new(0.0, 1.1)).shape(shape);
    let door = add(&mut world, door);
    with(
        "a door is put a bit further in each step, into the wall",
        60,
        world,
        move |world, step| {
            let place = Vec2::new(0.05 * step as f32, 1.1);
            world.body_mut(door).unwrap().set_position(place);
        },
    )
}

/// What is put up through a one-way plank goes through nothing that it collides with.
fn one_way_lift() -> Healthy {
    let mut world = World::new(Vec2::ZERO);
    let plank = ShapeDef::new(Shape::rect(3.0, 0.05).unwrap()).one_way(Vec2::Y);
    add(&mut world, RigidBody::fixed().position(Vec2::new(0.0, 1.0)).shape(plank));
    let hero = add(&mut world, ball(0.3, 0.0, 0.0));
    with("a hero is lifted through a plank by its place", 40, world, move |world, step| {
        let place = Vec2::new(0.0, 0.1 * step as f32);
        world.body_mut(hero).unwrap().set_position(place);
    })
}

/// A ball pool that fills from a spout; what is too much is taken out by handle.
fn fountain() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    for x in [-4.0, 4.0] {
        block(&mut world, x, 2.0, 0.3, 2.0);
    }
    let mut balls = std::collections::VecDeque::new();
    with("fountain of balls, oldest removed", 600, world, move |world, step| {
        if step % 6 == 0 {
            let side = (step / 6 % 5) as f32 - 2.0;
            let drop = ball(0.2, 0.5 * side, 6.0).velocity(Vec2::new(0.3 * side, 0.0));
            balls.push_back(add(world, drop));
        }
        if balls.len() > 60 {
            world.remove_body(balls.pop_front().unwrap()).unwrap();
        }
    })
}

fn explosion() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    for x in [-20.0, 20.0] {
        block(&mut world, x, 10.0, 0.5, 10.0);
    }
    for i in 0..12 {
        add(&mut world, plank(0.4, 0.4, -2.0 + (i % 4) as f32, 0.4 + 0.8 * (i / 4) as f32));
    }
    with("bomb among crates", 500, world, |world, step| {
        if step == 60 {
            let center = Vec2::new(-2.6, 0.3).into();
            let bomb = Explosion { center, radius: 4.0, falloff: 2.0, impulse_per_metre: 6.0 };
            world.explode(&bomb, &QueryFilter::new());
        }
    })
}

fn rafts() -> Healthy {
    let mut world = earth();
    for x in [-12.0, 12.0] {
        block(&mut world, x, 0.0, 0.5, 3.0);
    }
    block(&mut world, 0.0, -3.5, 12.5, 0.5);
    for i in 0..4 {
        let raft = ShapeDef::new(Shape::rect(1.5, 0.25).unwrap()).density(500.0);
        let place = Vec2::new(-7.5 + 5.0 * i as f32, 0.3);
        add(&mut world, RigidBody::dynamic().position(place).shape(raft));
    }
    let crate_ = ShapeDef::new(Shape::rect(0.3, 0.3).unwrap()).density(200.0);
    add(&mut world, RigidBody::dynamic().position(Vec2::new(-7.5, 0.9)).shape(crate_));
    with("rafts on a pond", 600, world, |world, _| {
        world.apply_water(&Water::default(), &QueryFilter::new(), DT);
    })
}

fn ragdoll() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    for i in 0..3 {
        doll(&mut world, 4.0 * i as f32, 3.0 + i as f32);
    }
    left_alone("three ragdolls fall", 500, world)
}

/// Trunk, head, two arms and two legs with limits.
fn doll(world: &mut World, x: f32, y: f32) {
    let trunk = add(world, plank(0.2, 0.35, x, y).mass(35.0));
    let head = add(world, ball(0.14, x, y + 0.5).mass(5.0));
    let neck =
        JointDef::revolute().anchors(Vec2::new(0.0, 0.36), Vec2::new(0.0, -0.14)).limits(-0.6, 0.6);
    world.add_joint(trunk, head, neck).unwrap();
    for side in [-1.0, 1.0] {
        for (half, at, mass) in [(0.28, 0.3, 4.0), (0.38, -0.36, 9.0)] {
            let limb = plank(0.07, half, x + 0.15 * side, y + at - half).mass(mass);
            let limb = add(world, limb);
            let joint = JointDef::revolute()
                .anchors(Vec2::new(0.15 * side, at), Vec2::new(0.0, half))
                .limits(-1.2, 1.2);
            world.add_joint(trunk, limb, joint).unwrap();
        }
    }
}

fn wrecking_ball() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    let mut last = block(&mut world, 0.0, 12.0, 1.0, 0.3);
    let mut hook = Vec2::new(0.0, -0.3);
    for i in 0..12 {
        let link = add(&mut world, plank(0.08, 0.25, 0.0, 11.45 - 0.5 * i as f32).mass(10.0));
        let pin = JointDef::revolute().anchors(hook, Vec2::new(0.0, 0.25));
        world.add_joint(last, link, pin).unwrap();
        (last, hook) = (link, Vec2::new(0.0, -0.25));
    }
    let weight = add(&mut world, ball(0.8, 0.0, 4.9).mass(100.0).velocity(Vec2::new(4.0, 0.0)));
    let pin = JointDef::revolute().anchors(hook, Vec2::new(0.0, 0.8));
    world.add_joint(last, weight, pin).unwrap();
    for i in 0..5 {
        add(&mut world, plank(0.4, 0.4, 3.0, 0.4 + 0.8 * i as f32).mass(20.0));
    }
    left_alone("wrecking ball against a wall", 500, world)
}

/// No gravity, walls of nothing: they wrap round to places that are free.
fn sailing_asteroids() -> Healthy {
    let mut world = World::new(Vec2::ZERO);
    for i in 0..5 {
        let rock = Shape::regular(7, 1.0).unwrap();
        let place = Vec2::new(-16.0, -8.0 + 4.0 * i as f32);
        let rock = RigidBody::dynamic().position(place).shape(rock);
        add(&mut world, rock.velocity(Vec2::new(4.0, 0.0)).angular_velocity(0.5));
    }
    with("asteroids wrap round to free space", 600, world, |world, _| {
        for id in world.body_ids().collect::<Vec<_>>() {
            let mut rock = world.body_mut(id).unwrap();
            let place = rock.as_ref().position();
            if place.x > 20.0 {
                rock.set_position(Vec2::new(-20.0, place.y));
            }
        }
    })
}

fn bullets() -> Healthy {
    let mut world = World::new(Vec2::ZERO);
    table(&mut world, 20.0, 8.0, 0.0);
    for i in 0..6 {
        add(&mut world, plank(0.1, 0.8, 10.0, -5.0 + 2.0 * i as f32).mass(4.0).damping(2.0, 2.0));
    }
    with("bullets marked as such hit boards", 240, world, |world, step| {
        if step % 20 == 0 && step < 120 {
            let shot = ball(0.05, -15.0, -5.0 + 2.0 * (step / 20) as f32).mass(0.05).bullet();
            add(world, shot.velocity(Vec2::new(150.0, 0.0)).damping(0.5, 0.5));
        }
    })
}

fn one_way_platforms() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    for i in 0..3 {
        let board = ShapeDef::new(Shape::rect(2.0, 0.1).unwrap()).one_way(Vec2::Y);
        let place = Vec2::new(0.0, 1.8 + 1.8 * i as f32);
        add(&mut world, RigidBody::fixed().position(place).shape(board));
    }
    let hero = add(&mut world, plank(0.3, 0.5, 0.0, 0.5).lock_rotation());
    with("hero jumps up one-way platforms", 500, world, move |world, step| {
        if step % 120 == 40 && step < 360 {
            world.body_mut(hero).unwrap().set_velocity(Vec2::new(0.0, 8.0));
        }
    })
}

fn pendulum_clock() -> Healthy {
    let mut world = earth();
    let wall = add(&mut world, RigidBody::fixed().position(Vec2::new(0.0, 5.0)));
    let rod = RigidBody::dynamic()
        .position(Vec2::new(0.0, 4.0))
        .shape(Shape::rect(0.03, 1.0).unwrap())
        .shape(ShapeDef::new(Shape::circle(0.25).unwrap()).offset(Vec2::new(0.0, -1.0)));
    let rod = add(&mut world, rod.angular_velocity(1.2));
    let pin = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(0.0, 1.0));
    world.add_joint(wall, rod, pin).unwrap();
    left_alone("pendulum swings for ever", 900, world)
}

/// Enemies are kept disabled in one heap until their wave comes.
fn pooled_enemies() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    let mut pool: Vec<_> = (0..8)
        .map(|i| {
            let enemy = plank(0.3, 0.7, 50.0, -20.0).lock_rotation().user_data(i);
            let id = add(&mut world, enemy);
            world.body_mut(id).unwrap().set_enabled(false);
            id
        })
        .collect();
    with("enemies from a pool, disabled till needed", 500, world, move |world, step| {
        if step % 50 == 10
            && let Some(id) = pool.pop()
        {
            let mut enemy = world.body_mut(id).unwrap();
            enemy.set_position(Vec2::new(-8.0 + 2.0 * (step / 50) as f32, 0.75));
            enemy.set_enabled(true);
        }
    })
}

/// A ball that falls into the pit is put back at its start, at rest.
fn respawn() -> Healthy {
    let mut world = earth();
    block(&mut world, -5.0, -0.5, 5.0, 0.5);
    let hero = add(&mut world, ball(0.4, -6.0, 0.4).velocity(Vec2::new(3.0, 0.0)));
    with("player respawns after a fall", 700, world, move |world, _| {
        let mut hero = world.body_mut(hero).unwrap();
        if hero.as_ref().position().y < -8.0 {
            hero.set_position(Vec2::new(-6.0, 0.5));
            hero.set_velocity(Vec2::new(3.0, 0.0));
            hero.set_angular_velocity(0.0);
        }
    })
}

/// A winch lowers a load by shortening its rope step by step; frames are uneven, steps are not.
fn crane() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    let jib = block(&mut world, 0.0, 10.0, 3.0, 0.3);
    let load = add(&mut world, plank(0.6, 0.4, 2.0, 2.0).mass(300.0));
    let rope =
        |length: f32| JointDef::rope(length).anchors(Vec2::new(2.0, -0.3), Vec2::new(0.0, 0.4));
    let winch = world.add_joint(jib, load, rope(7.4)).unwrap();
    let mut clock = FixedStep::new(DT);
    let mut length = 7.4_f32;
    with("crane hoists a load", 500, world, move |world, step| {
        let _ = clock.advance(0.012 + 0.009 * (step % 2) as f32);
        if step < 300 {
            length -= 0.015;
            world.set_joint(winch, rope(length)).unwrap();
        }
    })
}

fn friends_pass() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    let friends = Filter { group: -3, ..Filter::default() };
    let mut ids = Vec::new();
    for side in [-1.0, 1.0] {
        let shape = ShapeDef::new(Shape::rect(0.3, 0.7).unwrap()).filter(friends).friction(0.0);
        let friend = RigidBody::dynamic().position(Vec2::new(4.0 * side, 0.7)).shape(shape);
        ids.push((add(&mut world, friend.lock_rotation()), -side));
    }
    with("friends walk through each other by group", 400, world, move |world, step| {
        for &(id, way) in &ids {
            let way = if step < 240 { 2.0 * way } else { 0.0 };
            if step <= 240 {
                world.body_mut(id).unwrap().set_velocity(Vec2::new(way, 0.0));
            }
        }
    })
}

/// The sign hangs in front of its post: they overlap, and are joined so as not to collide.
fn shop_sign() -> Healthy {
    let mut world = earth();
    ground(&mut world);
    let post = block(&mut world, 0.0, 1.5, 0.1, 1.5);
    let sign = add(&mut world, plank(0.5, 0.3, 0.0, 2.2).angular_velocity(0.5));
    let hook = JointDef::revolute().anchors(Vec2::new(0.0, 1.2), Vec2::new(0.0, 0.5));
    world.add_joint(post, sign, hook).unwrap();
    left_alone("shop sign in front of its post", 300, world)
}

/// By the engine alone: nothing is broken, deep in another or gone at the end.
fn check(case: &Healthy) {
    let (name, world) = (case.name, &case.world);
    world.validate().unwrap();
    let deepest = world.max_penetration() / world.settings.length_unit;
    assert!(deepest < 0.03, "{name}: {deepest} m of overlap");
    let speed = world.bodies().map(|body| body.velocity().length()).fold(0.0, f32::max);
    assert!(speed < 25.0 * world.settings.length_unit, "{name}: {speed} m/s");
    let lowest = world.bodies().map(|body| body.position().y).fold(f32::MAX, f32::min);
    assert!(lowest > -21.0, "{name}: something is at {lowest} m");
}

#[test]
fn healthy_strangers() {
    let (mut count, mut ill) = (0, 0);
    for mut case in healthy() {
        let mut doctor = Doctor::new();
        for step in 0..case.steps {
            (case.act)(&mut case.world, step);
            case.world.step(DT);
            doctor.watch(&case.world);
        }
        check(&case);
        let report = doctor.report();
        let findings: Vec<_> =
            report.findings.iter().filter(|finding| finding.severity > Severity::Note).collect();
        count += 1;
        ill += usize::from(!findings.is_empty());
        let told: Vec<_> = findings.iter().map(|finding| finding.code.name()).collect();
        let mark = if told.is_empty() { "well" } else { "ILL?" };
        println!("{mark:<6} {:<42} {}", case.name, told.join(", "));
        for finding in findings {
            println!("       {finding}");
        }
    }
    println!("{ill} of {count} healthy worlds are told to be ill");
    assert!(count >= 25);
    assert_eq!(ill, 0, "false alarms");
}
