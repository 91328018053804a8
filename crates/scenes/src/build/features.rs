//! Scenes that show one ability of the engine each.

use super::{Options, course, crate_at, ground};
use crate::scene::Scene;
use crate::script::{Act, Character, Deed, Key, Leg, Pull, Ride, Script, Timeline, When};
use crate::shapes;
use core::f32::consts::TAU;
use tiny_physics::math::{cos, sin};
use tiny_physics::{
    BodyKind, ChainDef, DVec2, Filter, Material, RigidBody, Shape, ShapeDef, TileGrid, Vec2,
};

const GRAVITY: Vec2 = Vec2::new(0.0, -10.0);

fn scene(name: &str, description: &str) -> Scene {
    Scene { gravity: GRAVITY, ..Scene::new(name, description) }
}

fn body(x: f32, y: f32, shape: impl Into<ShapeDef>) -> RigidBody {
    RigidBody::dynamic().position(Vec2::new(x, y)).shape(shape)
}

fn act(when: When, deed: Deed) -> Act {
    Act { when, deed }
}

fn timeline(acts: Vec<Act>) -> Option<Script> {
    Some(Script::Timeline(Timeline { acts }))
}

/// Shapes of every kind fall into a bowl that is a closed chain; the size is their number.
pub(crate) fn bowl(options: Options) -> Scene {
    let count = options.size_or(70, 5000);
    let mut scene = scene("bowl", "Shapes of every kind fall into a bowl drawn as a chain.");
    // Anticlockwise as seen from outside: the right of the way is free, so the bowl is drawn from right to left.
    let rim: Vec<Vec2> = (0..=48)
        .map(|i| {
            let angle = TAU * (0.02 - 0.54 * i as f32 / 48.0);
            Vec2::new(9.0 * cos(angle), 7.0 * sin(angle))
        })
        .collect();
    let bowl = ChainDef::open(&rim).friction(0.4);
    scene.body(RigidBody::fixed().chain(&bowl).expect("the points of the bowl are apart"));
    for i in 0..count {
        let place = Vec2::new(1.4 * ((i * 5) % 9) as f32 - 5.6, 1.5 + 1.2 * (i / 9) as f32);
        scene.body(mixed(i).position(place).angle(i as f32));
    }
    scene
}

/// One of eight kinds of shapes, some of several parts.
fn mixed(i: u32) -> RigidBody {
    let size = 0.3 + 0.05 * (i % 4) as f32;
    let point = |x: f32, y: f32| Vec2::new(x, y) * size;
    let body = RigidBody::dynamic();
    match i % 8 {
        0 => body.shape(shapes::circle(size)),
        1 => body.shape(shapes::rect(1.2 * size, 0.7 * size)),
        2 => body.shape(Shape::Capsule {
            a: point(-1.0, 0.0),
            b: point(1.0, 0.0),
            radius: 0.6 * size,
        }),
        3 => body.shape(shapes::hull(&[point(-1.0, -0.6), point(1.0, -0.6), point(0.0, 1.1)], 0.0)),
        4 => body.shape(shapes::rounded_rect(0.7 * size, 0.7 * size, 0.4 * size)),
        5 => {
            let corners: Vec<Vec2> = (0..6)
                .map(|k| point(cos(TAU * k as f32 / 6.0), sin(TAU * k as f32 / 6.0)))
                .collect();
            body.shape(shapes::hull(&corners, 0.0))
        }
        // A cross and a dumb-bell.
        6 => body
            .shape(shapes::rect(1.3 * size, 0.35 * size))
            .shape(shapes::rect(0.35 * size, 1.3 * size)),
        _ => body
            .shape(shapes::rect(1.3 * size, 0.15 * size))
            .shape(ShapeDef::new(shapes::circle(0.6 * size)).offset(point(-1.3, 0.0)))
            .shape(ShapeDef::new(shapes::circle(0.6 * size)).offset(point(1.3, 0.0))),
    }
}

/// A ball grows, ice comes over a slope, shelves come loose; the size is of no account.
pub(crate) fn changing(_: Options) -> Scene {
    let text = "A ball grows, a slope freezes over, and one shelf after the other comes loose.";
    let mut scene = scene("changing", text);
    scene.view = Some((Vec2::new(-15.9, -1.0), Vec2::new(15.9, 9.0)));
    scene.body(ground(Vec2::new(0.0, -1.0), 16.0, 1.0));
    let mut acts = Vec::new();

    let balloon = scene.body(body(-11.0, 0.3, shapes::circle(0.3)));
    for i in 0..12 {
        scene.body(crate_at(-12.1 + 1.1 * (i % 3) as f32, 1.1 + (i / 3) as f32));
    }
    for k in 0..90 {
        let shape = shapes::circle(0.3 + 0.02 * k as f32);
        acts.push(act(When::At(60 + 4 * k), Deed::SetShape { body: balloon, shape }));
    }

    let slope = ShapeDef::new(shapes::rect(4.0, 0.2)).friction(0.9);
    let slope = RigidBody::fixed().position(Vec2::new(-1.5, 2.2)).angle(-0.4).shape(slope);
    let slope = scene.body(slope);
    for i in 0..4 {
        let along = -3.2 + 1.2 * i as f32;
        let place = Vec2::new(
            -1.5 + along * cos(0.4) + 0.6 * sin(0.4),
            2.2 - along * sin(0.4) + 0.6 * cos(0.4),
        );
        let crate_ = ShapeDef::new(shapes::rect(0.4, 0.4)).friction(0.9);
        scene.body(RigidBody::dynamic().position(place).angle(-0.4).shape(crate_));
    }
    let ice = Material { friction: 0.0, ..Material::default() };
    acts.push(act(When::At(150), Deed::SetMaterial { body: slope, material: ice }));

    for i in 0..4_u32 {
        let y = 1.5 + 1.6 * i as f32;
        let shelf = RigidBody::fixed().position(Vec2::new(11.0, y)).shape(shapes::rect(1.8, 0.15));
        let shelf = scene.body(shelf);
        for k in 0..4 {
            scene.body(body(9.8 + 0.8 * k as f32, y + 0.45, shapes::circle(0.3)));
        }
        let loose = Deed::SetKind { body: shelf, kind: BodyKind::Dynamic };
        acts.push(act(When::At(420 - 60 * i), loose));
    }
    scene.script = timeline(acts);
    scene
}

/// Lifts and swings that are led, and planks that are solid from above only; the size is the number of balls
/// thrown up.
pub(crate) fn platforms(options: Options) -> Scene {
    let balls = options.size_or(12, 500);
    let text = "Led platforms carry crates; balls fly up through one-way planks and stay on top.";
    let mut scene = scene("platforms", text);
    scene.view = Some((Vec2::new(-15.9, -1.0), Vec2::new(15.9, 13.0)));
    scene.body(ground(Vec2::new(0.0, -1.0), 16.0, 1.0));
    let ways = [
        (Vec2::new(-13.0, 1.0), Vec2::new(-13.0, 7.0), 0.0, 8.0),
        (Vec2::new(-9.0, 2.0), Vec2::new(-4.0, 2.0), 0.0, 6.0),
        (Vec2::new(-7.0, 5.5), Vec2::new(-6.0, 6.5), 0.4, 5.0),
    ];
    let mut acts = Vec::new();
    for (from, to, turn, period) in ways {
        let platform = RigidBody::kinematic().position(from).shape(shapes::rect(1.5, 0.15));
        let body = scene.body(platform);
        acts.push(act(When::Always, Deed::Lead { body, from, to, turn, period }));
        for i in 0..3 {
            let place = from + Vec2::new(0.9 * i as f32 - 0.9, 0.5);
            scene.body(RigidBody::dynamic().position(place).shape(shapes::rect(0.35, 0.35)));
        }
    }
    for i in 0..4 {
        let plank = ShapeDef::new(shapes::rect(4.5, 0.1)).one_way(Vec2::Y);
        let place = Vec2::new(8.0, 1.8 + 1.8 * i as f32);
        scene.body(RigidBody::fixed().position(place).shape(plank));
    }
    for i in 0..balls {
        let row = (i / 12) as f32;
        let place = Vec2::new(4.2 + 0.7 * (i % 12) as f32 + 0.02 * row, 0.4 + 0.65 * row);
        let velocity = Vec2::new(0.0, 7.0 + 1.5 * ((i * 5) % 6) as f32);
        scene.body(
            RigidBody::dynamic().position(place).velocity(velocity).shape(shapes::circle(0.3)),
        );
    }
    scene.script = timeline(acts);
    scene
}

/// Things of several densities in a basin, a boat with a sail, and rain of crates; the size is the number of
/// crates.
pub(crate) fn harbour(options: Options) -> Scene {
    let crates = options.size_or(14, 1000);
    let text = "Light things float, heavy ones sink, and wind drives a boat through them.";
    let mut scene = scene("harbour", text);
    scene.view = Some((Vec2::new(-15.7, -6.0), Vec2::new(15.7, 8.0)));
    scene.steps = 900;
    let wall = |x: f32| ShapeDef::new(shapes::rect(0.5, 4.5)).offset(Vec2::new(x, -1.5));
    let floor = ShapeDef::new(shapes::rect(16.0, 0.5)).offset(Vec2::new(0.0, -5.5));
    scene.body(RigidBody::fixed().shape(floor).shape(wall(-15.5)).shape(wall(15.5)));

    // The world does not know the water between its steps; a sensor shows it.
    let water = ShapeDef::new(shapes::rect(15.0, 2.5)).sensor().offset(Vec2::new(0.0, -2.5));
    scene.body(RigidBody::fixed().shape(water));
    let hull = [(-1.6, 0.4), (-1.1, -0.5), (1.1, -0.5), (1.8, 0.4)].map(|(x, y)| Vec2::new(x, y));
    let part = |shape: Shape, density: f32| ShapeDef::new(shape).density(density);
    let mast = part(shapes::rect(0.06, 1.2), 100.0).offset(Vec2::new(0.0, 1.6));
    let sail = [(0.1, 0.9), (1.3, 0.9), (0.1, 2.7)].map(|(x, y)| Vec2::new(x, y));
    let keel = part(shapes::rect(0.5, 0.15), 3000.0).offset(Vec2::new(0.0, -0.6));
    let boat = RigidBody::dynamic()
        .position(Vec2::new(-12.0, 0.2))
        .shape(part(shapes::hull(&hull, 0.0), 300.0))
        .shape(mast)
        .shape(part(shapes::hull(&sail, 0.0), 20.0))
        .shape(keel);
    let boat = scene.body(boat);
    for i in 0..crates {
        let density = [100.0, 400.0, 700.0, 950.0, 1500.0][i as usize % 5];
        let shape = if i % 3 == 0 { shapes::circle(0.45) } else { shapes::rect(0.5, 0.4) };
        let x = 1.7 * (i % 14) as f32 - 9.0;
        scene.body(body(x, 2.0 + 1.1 * (i % 4) as f32 + (i / 14) as f32, part(shape, density)));
    }
    let water = Deed::Water { surface: 0.0, between: None, density: 1000.0, flow: Vec2::ZERO };
    let wind = Deed::Wind { body: boat, velocity: Vec2::new(25.0, 0.0) };
    scene.script = timeline(vec![act(When::Always, water), act(When::During(120, 900), wind)]);
    scene
}

/// Three explosions in a town of crates; the size is the number of houses.
pub(crate) fn blast(options: Options) -> Scene {
    let houses = options.size_or(5, 100);
    let mut scene = scene("blast", "Three explosions in a town of crates and planks.");
    scene.view = Some((Vec2::new(-16.0, -1.0), Vec2::new(16.0, 14.0)));
    let half = 3.0 * houses as f32;
    scene.body(ground(Vec2::new(0.0, -1.0), half + 12.0, 1.0));
    for house in 0..houses {
        let x = 6.0 * house as f32 - half + 3.0;
        for floor in 0..3 + house % 3 {
            let y = 1.4 * floor as f32;
            for side in [-0.9, 0.0, 0.9] {
                scene.body(body(x + side, y + 0.6, shapes::rect(0.12, 0.6)));
            }
            scene.body(body(x, y + 1.3, shapes::rect(1.4, 0.1)));
        }
    }
    let blast = |at: u32, x: f32, strength: f32| {
        let center = Vec2::new(x, 0.3);
        act(
            When::At(at),
            Deed::Explode { center, radius: 1.0, falloff: 5.0, impulse_per_metre: strength },
        )
    };
    scene.script = timeline(vec![blast(90, -6.0, 6.0), blast(180, 7.5, 4.0), blast(300, 0.0, 9.0)]);
    scene
}

/// Stones circle two bodies that attract them, one of which has air; the size is their number.
pub(crate) fn orbits(options: Options) -> Scene {
    let count = options.size_or(80, 5000);
    let text =
        "Stones circle two planets, whose pull is a zone; those that come into the air fall.";
    let mut scene = Scene { gravity: Vec2::ZERO, ..scene("orbits", text) };
    let planets = [(Vec2::new(-9.0, 0.0), 1.5, 6.0), (Vec2::new(9.0, 1.0), 1.0, 4.0)];
    let mut acts = Vec::new();
    for (position, radius, acceleration) in planets {
        scene.body(RigidBody::fixed().position(position).shape(shapes::circle(radius)));
        let shape = shapes::circle(8.5);
        show_zone(&mut scene, shape, position);
        let force = Pull::Inwards(acceleration);
        acts.push(act(When::Always, Deed::Zone { shape, position, force }));
    }
    let air = Pull::Slow(0.4, 0.4);
    let ((position, _, _), shape) = (planets[1], shapes::circle(3.5));
    show_zone(&mut scene, shape, position);
    acts.push(act(When::Always, Deed::Zone { shape, position, force: air }));
    for i in 0..count {
        let (center, radius, acceleration) = planets[i as usize % 2];
        let distance = radius + 1.5 + 0.055 * (i % 80) as f32;
        let angle = 2.4 * (i / 2) as f32;
        let out = Vec2::new(cos(angle), sin(angle));
        let stone = if i % 3 == 0 { shapes::circle(0.15) } else { shapes::rect(0.18, 0.12) };
        let stone = RigidBody::dynamic().position(center + out * distance).shape(stone);
        scene.body(stone.velocity(out.perp() * (acceleration * distance).sqrt()));
    }
    scene.script = timeline(acts);
    scene
}

/// A sensor where a zone is: the world does not know zones between its steps.
fn show_zone(scene: &mut Scene, shape: Shape, position: Vec2) {
    scene.body(RigidBody::fixed().position(position).shape(ShapeDef::new(shape).sensor()));
}

/// Parcels in a shaft of the sorting plant.
const SHAFT: u32 = 6;

/// A belt carries parcels of three categories to gates that let those of other kinds through; the size is the number of
/// parcels.
pub(crate) fn sorting(options: Options) -> Scene {
    let count = options.size_or(30, 2000);
    let text = "A belt carries parcels; each gate holds one kind and lets the others fall.";
    let mut scene = scene("sorting", text);
    scene.view = Some((Vec2::new(-9.0, -1.0), Vec2::new(17.2, 15.8)));
    scene.steps = 1500;
    let kinds: [u64; 3] = [1 << 1, 1 << 2, 1 << 3];
    let shaft = |i: u32| -2.0 - i as f32;
    scene.body(sorting_plant(kinds, shaft(count.div_ceil(SHAFT)) + 0.5));
    let corners: Vec<Vec2> = (0..8)
        .map(|k| TAU * (k as f32 + 0.5) / 8.0)
        .map(|angle| Vec2::new(cos(angle), sin(angle)) * 0.33)
        .collect();
    let mut acts = Vec::new();
    for i in 0..count {
        let kind = i as usize % 3;
        let shape = match kind {
            0 => shapes::rect(0.3, 0.3),
            1 => Shape::Capsule { a: Vec2::new(-0.15, 0.0), b: Vec2::new(0.15, 0.0), radius: 0.25 },
            _ => shapes::hull(&corners, 0.0),
        };
        let filter = Filter { category: kinds[kind], ..Filter::default() };
        let parcel = ShapeDef::new(shape).filter(filter).friction(0.3).rolling_resistance(0.2);
        let height = 1.2 + 0.75 * (i % SHAFT) as f32;
        let place = Vec2::new(shaft(i / SHAFT), 10.05 + height);
        let body = scene.body(RigidBody::fixed().position(place).shape(parcel));
        // Let go so that every half second one is down: they lie apart on the belt.
        let time = 1.0 + 0.5 * i as f32 - (2.0 * height / 10.0).sqrt();
        let go = Deed::SetKind { body, kind: BodyKind::Dynamic };
        acts.push(act(When::At((60.0 * time).round() as u32), go));
    }
    scene.script = timeline(acts);
    scene
}

/// Shafts from `left` on over a belt, three belts that hold one kind each, and a box for each kind.
fn sorting_plant(kinds: [u64; 3], left: f32) -> RigidBody {
    let mut plant = RigidBody::fixed();
    let mut put = |x: f32, y: f32, shape: ShapeDef| {
        plant.shapes.push(shape.offset(Vec2::new(x, y)));
    };
    let belt = |half: f32, speed: f32| {
        ShapeDef::new(shapes::rounded_rect(half, 0.1, 0.15)).tangent_speed(speed).friction(3.0)
    };
    let mut wall = -1.5;
    while wall > left - 0.5 {
        put(wall, 13.3, ShapeDef::new(shapes::rect(0.05, 2.4)).friction(0.0));
        wall -= 1.0;
    }
    let (start, end) = (left - 0.5, 1.0);
    put(0.5 * (start + end), 9.5, belt(0.5 * (end - start), 3.0));
    // The faster a belt, the further away the box that its parcels fly into.
    for (i, (kind, speed)) in kinds.into_iter().zip([6.3, 5.3, 2.5]).enumerate() {
        let holds = Filter { category: 1, mask: kind, group: 0 };
        put(5.0, 7.0 - 2.3 * i as f32, belt(4.0, speed).filter(holds));
    }
    for i in 0..3 {
        put(9.6 + 2.4 * i as f32, 0.8, ShapeDef::new(shapes::rect(0.1, 1.3)));
    }
    put(16.8, 3.5, ShapeDef::new(shapes::rect(0.1, 4.0)));
    put(13.2, -0.5, ShapeDef::new(shapes::rect(3.8, 0.2)));
    put(5.0, -0.5, ShapeDef::new(shapes::rect(4.5, 0.2)));
    plant
}

/// A ball opens a door by rolling through a sensor; the size is the number of crates behind the door.
pub(crate) fn sensor_door(options: Options) -> Scene {
    let crates = options.size_or(10, 500);
    let text = "A ball rolls through a sensor, a door opens, and what was behind it comes down.";
    let mut scene = scene("sensor_door", text);
    scene.view = Some((Vec2::new(-15.9, -1.0), Vec2::new(15.9, 9.5)));
    scene.body(ground(Vec2::new(0.0, -1.0), 16.0, 1.0));
    let slope = |x: f32, y: f32, angle: f32, half: f32| {
        RigidBody::fixed().position(Vec2::new(x, y)).angle(angle).shape(shapes::rect(half, 0.15))
    };
    scene.body(slope(-10.0, 3.5, -0.25, 5.0));
    scene.body(slope(8.0, 4.0, 0.3, 6.0).friction(0.05));
    scene.body(body(-14.0, 5.5, shapes::circle(0.5)));
    let eye = ShapeDef::new(shapes::rect(0.3, 1.5)).sensor();
    let eye = scene.body(RigidBody::fixed().position(Vec2::new(-2.5, 1.5)).shape(eye));
    let door = RigidBody::kinematic().position(Vec2::new(2.6, 4.2)).shape(shapes::rect(0.15, 1.6));
    let door = scene.body(door);
    // A second sensor over the door says when it is open.
    let top = ShapeDef::new(shapes::rect(0.5, 0.2)).sensor();
    let top = scene.body(RigidBody::fixed().position(Vec2::new(2.6, 9.0)).shape(top));
    for i in 0..crates {
        let x = 3.6 + 0.95 * (i % 5) as f32;
        let shape = if i % 2 == 0 { shapes::circle(0.4) } else { shapes::rect(0.4, 0.4) };
        scene.body(body(x, 4.4 + 0.3 * (i % 5) as f32 + 1.1 * (i / 5) as f32, shape));
    }
    let turn = |velocity: Vec2| Deed::SetVelocity { body: door, velocity, angular_velocity: 0.0 };
    scene.script = timeline(vec![
        act(When::Entered(eye), turn(Vec2::new(0.0, 2.0))),
        act(When::Entered(top), turn(Vec2::ZERO)),
    ]);
    scene
}

/// The map of the hero's way, top row first.
const WAY: [&str; 9] = [
    "#............................#",
    "#............................#",
    "#............................#",
    "#............................#",
    "#........................lh###",
    "#........---............/#####",
    "#......................#######",
    "#...lh##HL....lh##.....#######",
    "##################.....#######",
];

/// A character walks over slopes and steps, jumps onto a one-way platform, and rides a shuttle over a pit; the
/// size is the number of crates in its way.
pub(crate) fn hero(options: Options) -> Scene {
    let crates = options.size_or(2, 20);
    let text =
        "A character walks slopes and steps, jumps on a platform, rides a shuttle, pushes crates.";
    let mut scene = scene("hero", text);
    scene.steps = 900;
    let map = TileGrid::parse(1.0, &WAY).expect("the map is drawn with known letters");
    for block in map.bodies() {
        scene.body(block);
    }
    let shuttle = RigidBody::kinematic().position(Vec2::new(19.2, 1.85));
    let shuttle = scene.body(shuttle.shape(shapes::rect(1.2, 0.15)));
    for i in 0..crates {
        let load = ShapeDef::new(shapes::rect(0.4, 0.4)).density(0.5);
        scene.body(body(27.9, 5.4 + 0.8 * i as f32, load));
    }
    let (position, height, radius) = (DVec2::new(2.0, 2.0), 1.8, 0.35);
    let body = scene.body(course::marker(position, height, radius));
    let key = |from: f32, walk: f32, jump: f32| Key { from, walk, jump, drop: false };
    let keys = vec![
        key(0.5, 4.0, 0.0),
        key(2.5, 0.0, 8.0),
        key(4.0, 4.0, 0.0),
        // On the shuttle while it stands on the left, off it on the right.
        key(6.3, 0.0, 0.0),
        key(9.0, 4.0, 0.0),
    ];
    let over = Vec2::new(1.04, 0.4);
    let leg = |from: f32, velocity: Vec2| Leg { from, to: from + 2.5, velocity, ..Leg::default() };
    let legs = vec![leg(0.5, over), leg(3.5, Vec2::ZERO - over)];
    let rides = vec![Ride { body: shuttle, period: 6.0, legs }];
    scene.script =
        Some(Script::Character(Character { position, height, radius, body, keys, rides }));
    scene
}
