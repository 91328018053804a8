//! Ground that changes under things, and things that have to notice.

use super::common::{PHASES, machine, none};
use crate::lab::Lab;
use crate::report::Measure;
use crate::scenery::{crate_at, fixed, rect, scene};
use crate::target::Target;
use tiny_physics::{
    BodyId, CharacterMover, Error, JointDef, MoverInput, Pose, RigidBody, Rot, Shape, ShapeDef,
    TileGrid, Vec2, World, collide,
};
use tiny_physics_scenes::{Options, Random, find};

const COUNT: usize = 100;

/// Crates on ground of their own, static boxes put over them: crates in the ground, and in a box.
///
/// Boxes beside a crate's middle can push it out sideways; those over it can only pin it, or push it into the ground.
fn cover(lab: &mut Lab<'_>, asleep: bool, beside: bool) -> (usize, usize) {
    let (seed, half) = lab.pick((1, 0.5), (2, 0.4));
    lab.expect_seconds(5.0, 1.0 / 60.0);
    let mut scene = scene("tile over a crate");
    for i in 0..COUNT {
        scene.body(fixed(rect(5.0, 5.0), Vec2::new(12.0 * i as f32, -5.0)));
    }
    for i in 0..COUNT {
        scene.body(crate_at(12.0 * i as f32, 0.5, 1.0).can_sleep(asleep));
    }
    let mut trial = lab.build(scene);
    lab.run(&mut trial, if asleep { 2.0 } else { 1.0 }, |_| {});
    let mut random = Random::new(seed);
    for i in 0..COUNT {
        let side = if random.coin() { 1.0 } else { -1.0 };
        let off = side
            * if beside { random.range(0.5, 0.9) } else { random.range(0.0, 0.8) }
            * (half + 0.5);
        let over = Vec2::new(off, half + if beside { 0.0 } else { random.range(-0.1, 0.5) });
        trial.add_body(fixed(rect(half, half), Vec2::new(12.0 * i as f32, 0.0) + over));
    }
    lab.run(&mut trial, 3.0, |_| {});
    let sunk = (COUNT..2 * COUNT).filter(|&body| !(trial.position(body).y > 0.3)).count();
    let inside =
        (COUNT..2 * COUNT).filter(|&body| trial.overlap(body, body + COUNT) > 0.05).count();
    (sunk, inside)
}

/// A static box is put over a crate that rests on thick ground, awake: does the crate end in the ground, or in the box?
pub(super) fn tile_over_a_crate(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (sunk, _) = cover(lab, false, false);
    let (sunk_beside, inside) = cover(lab, false, true);
    vec![
        none(format!("box above, in the ground, of {COUNT}"), sunk),
        none(format!("box beside, in the ground, of {COUNT}"), sunk_beside),
        none(format!("box beside, still in it, of {COUNT}"), inside),
    ]
}

/// The same over a crate that sleeps: does it wake and come out?
pub(super) fn tile_over_a_sleeper(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (sunk, inside) = cover(lab, true, true);
    vec![
        none(format!("sleepers in the ground, of {COUNT}"), sunk),
        none(format!("sleepers still in the box, of {COUNT}"), inside),
    ]
}

/// What has to wake a crate that sleeps on a floor, and a lamp that hangs from a ceiling.
const WAKERS: [&str; 9] = [
    "gravity changed",
    "pre-solve hook set",
    "pair filter set",
    "floor moved",
    "ceiling moved",
    "floor removed",
    "static box added inside",
    "tile added inside",
    "sleeper's joint removed",
];

/// Changes around sleepers: how many do not wake them?
pub(super) fn waking(lab: &mut Lab<'_>) -> Vec<Measure> {
    let half = lab.pick(0.5, 0.3);
    let asleep: Vec<&str> = WAKERS.into_iter().filter(|what| !wakes(what, half)).collect();
    vec![none(format!("changes that wake nobody, of {}", WAKERS.len()), asleep.len())]
}

/// Does a change wake the sleeper that it is about?
fn wakes(what: &str, half: f32) -> bool {
    sleeper_after(what, half).is_ok_and(|awake| awake)
}

fn sleeper_after(what: &str, half: f32) -> Result<bool, Error> {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let floor = world.add_body(fixed(rect(5.0, 1.0), Vec2::new(0.0, -1.0)))?;
    let ceiling = world.add_body(fixed(rect(1.0, 0.1), Vec2::new(20.0, 5.0)))?;
    let body =
        |x: f32, y: f32| RigidBody::dynamic().position(Vec2::new(x, y)).shape(rect(half, half));
    let crate_ = world.add_body(body(0.0, half))?;
    let lamp = world.add_body(body(20.0, 5.0 - 2.0 * half - 0.1))?;
    let hook = JointDef::revolute().anchors(Vec2::new(0.0, -0.1), Vec2::new(0.0, 2.0 * half));
    let joint = world.add_joint(ceiling, lamp, hook)?;
    (0..300).for_each(|_| world.step(1.0 / 60.0));
    let sleeper =
        if ["ceiling moved", "sleeper's joint removed"].contains(&what) { lamp } else { crate_ };
    if world.body(sleeper).is_none_or(|body| body.is_awake()) {
        return Ok(false);
    }
    match what {
        "gravity changed" => world.gravity = Vec2::new(3.0, -10.0),
        "pre-solve hook set" => world.set_pre_solve(|_, _, rules| rules.enabled = false),
        "pair filter set" => world.set_pair_filter(|_| false),
        "floor moved" => move_down(&mut world, floor),
        "ceiling moved" => move_down(&mut world, ceiling),
        "floor removed" => drop(world.remove_body(floor)),
        "static box added inside" => {
            world.add_body(fixed(rect(half, half), Vec2::new(0.3 * half, half)))?;
        }
        "tile added inside" => {
            let mut grid = TileGrid::parse(1.0, &["#"])?;
            grid = grid.position(Vec2::new(-0.3, 0.1));
            world.add_tiles(grid)?;
        }
        _ => drop(world.remove_joint(joint)),
    }
    let awake = |world: &World| world.body(sleeper).is_some_and(|body| body.is_awake());
    Ok((0..5).any(|_| {
        world.step(1.0 / 60.0);
        awake(&world)
    }))
}

fn move_down(world: &mut World, body: BodyId) {
    let place = world.body(body).map_or(Vec2::ZERO, |body| body.position());
    if let Some(mut body) = world.body_mut(body) {
        body.set_position(place - Vec2::new(0.0, 0.5));
    }
}

/// The built-in house of cards: how long does it stand?
pub(super) fn built_in_card_house(lab: &mut Lab<'_>) -> Vec<Measure> {
    const SECONDS: f64 = 600.0;
    let Ok(entry) = find("card_house") else { return Vec::new() };
    let options = Options::default();
    let scene = entry.build(lab.pick(options, options.size(4)));
    lab.expect_seconds(SECONDS, scene.dt);
    let mut trial = lab.build(scene);
    let cards = trial.dynamic();
    let mut stands = SECONDS;
    while trial.time() < SECONDS {
        lab.step(&mut trial);
        let moved = |&card: &usize| {
            let by = trial.moved(card);
            !(by.x.hypot(by.y) < 0.1)
        };
        if cards.iter().any(moved) {
            stands = trial.time();
            break;
        }
    }
    let target = Target::AtLeast { limit: SECONDS - 0.1, ideal: f64::INFINITY };
    vec![Measure::new("time until a card has moved by 10 cm", stands, "s", target)]
}

/// A character in a tight shaft, hit by a paddle, pushing a stack, and dropping from a plank.
pub(super) fn mover(lab: &mut Lab<'_>) -> Vec<Measure> {
    let radius = lab.pick(0.4, 0.3);
    let speed = lab.pick(40.0, 25.0);
    let fell = |result: Result<f64, Error>| result.unwrap_or(f64::INFINITY);
    vec![
        none(
            "does not fall through a shaft 2 % wider than it".into(),
            usize::from(!(fell(shaft(radius)) < -2.0)),
        ),
        none(
            format!("passed by a paddle at {speed} m/s, of {PHASES}"),
            paddled(radius, speed).unwrap_or(PHASES),
        ),
        Measure::new(
            "pushes 4 crates at a wall, inside of them",
            1000.0 * fell(pushes(radius)),
            "mm",
            Target::AtMost(10.0),
        ),
        none("does not drop from a plank".into(), usize::from(!(fell(drops(radius)) < 1.0))),
    ]
}

/// A character of 1.8 m and its world under gravity.
fn character(radius: f32, place: Vec2) -> (World, CharacterMover) {
    (World::new(Vec2::new(0.0, -10.0)), CharacterMover::new(place, 1.8, radius))
}

/// Moves it on for some steps.
fn walk(world: &mut World, mover: &mut CharacterMover, input: MoverInput, steps: u32) {
    for _ in 0..steps {
        world.step(1.0 / 60.0);
        mover.update(world, input, 1.0 / 60.0);
    }
}

/// Height after two seconds in a shaft from y = 0 down.
fn shaft(radius: f32) -> Result<f64, Error> {
    let (mut world, mut mover) = character(radius, Vec2::new(0.0, 1.5));
    for side in [-1.0, 1.0] {
        let place = Vec2::new(side * (1.02 * radius + 2.0), -20.0);
        world.add_body(fixed(rect(2.0, 20.0), place))?;
    }
    walk(&mut world, &mut mover, MoverInput::default(), 120);
    Ok(mover.position.y)
}

/// Past how many characters does a fast kinematic paddle come?
fn paddled(radius: f32, speed: f32) -> Result<usize, Error> {
    let mut passed = 0;
    for phase in 0..PHASES {
        let (mut world, mut mover) = character(radius, Vec2::new(0.0, 0.91));
        world.add_body(fixed(rect(100.0, 1.0), Vec2::new(0.0, -1.0)))?;
        let from = -3.0 - speed / 60.0 * phase as f32 / PHASES as f32;
        let paddle = machine(rect(0.1, 0.8), Vec2::new(from, 0.85)).velocity(Vec2::new(speed, 0.0));
        let paddle = world.add_body(paddle)?;
        walk(&mut world, &mut mover, MoverInput::default(), 30);
        passed +=
            usize::from(world.body(paddle).is_none_or(|p| p.position_f64().x > mover.position.x));
    }
    Ok(passed)
}

/// How deep it gets into a stack of four crates before a wall, metres.
fn pushes(radius: f32) -> Result<f64, Error> {
    let (mut world, mut mover) = character(radius, Vec2::new(-2.0, 0.91));
    world.add_body(fixed(rect(20.0, 1.0), Vec2::new(0.0, -1.0)))?;
    world.add_body(fixed(rect(1.0, 5.0), Vec2::new(2.0, 5.0)))?;
    let mut crates = Vec::new();
    for i in 0..4 {
        let place = Vec2::new(0.3, 0.5 + i as f32);
        crates.push(world.add_body(RigidBody::dynamic().position(place).shape(rect(0.5, 0.5)))?);
    }
    let mut deepest: f64 = 0.0;
    for _ in 0..300 {
        walk(&mut world, &mut mover, MoverInput { walk: 6.0, ..MoverInput::default() }, 1);
        let half = 0.5 * mover.height - mover.radius;
        let (a, b) = (Vec2::new(0.0, -half), Vec2::new(0.0, half));
        let shape = Shape::Capsule { a, b, radius: mover.radius };
        let pose = Pose::new(mover.position, Rot::IDENTITY);
        for body in crates.iter().filter_map(|&id| world.body(id)) {
            let own = Pose::new(body.position_f64(), body.rotation());
            let manifold = collide(&shape, &rect(0.5, 0.5), own.relative_to(pose), 0.0);
            let depth = manifold.deepest().map_or(0.0, |point| -f64::from(point.separation));
            deepest = deepest.max(depth);
        }
    }
    Ok(deepest)
}

/// Height after asking to drop for one step, on a plank at y = 2.
fn drops(radius: f32) -> Result<f64, Error> {
    let (mut world, mut mover) = character(radius, Vec2::new(0.0, 3.1));
    world.add_body(fixed(rect(20.0, 1.0), Vec2::new(0.0, -1.0)))?;
    let plank = ShapeDef::new(rect(3.0, 0.1)).one_way(Vec2::Y);
    world.add_body(RigidBody::fixed().position(Vec2::new(0.0, 1.9)).shape(plank))?;
    walk(&mut world, &mut mover, MoverInput::default(), 60);
    walk(&mut world, &mut mover, MoverInput { drop: true, ..MoverInput::default() }, 1);
    walk(&mut world, &mut mover, MoverInput::default(), 90);
    Ok(mover.position.y)
}
