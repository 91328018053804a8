//! What slides slowly off something that stays does not fall asleep on its way.

mod common;

use common::{Random, rect};
use tiny_physics::{ChainDef, Locks, RigidBody, ShapeDef, Vec2, World};

const GRAVITY: f32 = 9.8;

/// From `least` to `most`, each factor as likely as any other.
fn any_scale(random: &mut Random, least: f32, most: f32) -> f32 {
    least * (random.range(0.0, (most / least).ln())).exp()
}

fn any_rate(random: &mut Random, world: &mut World) -> f32 {
    world.settings.substeps = 1 << random.below(4);
    [1.0 / 30.0, 1.0 / 60.0, 1.0 / 120.0, 1.0 / 240.0][random.below(4) as usize]
}

/// Does a slab that slides down planks on a slope fall asleep on its way?
fn sleeps_on_its_way(random: &mut Random) -> bool {
    let unit = [0.05, 1.0, 20.0][random.below(3) as usize];
    let mut world = World::new(Vec2::new(0.0, -any_scale(random, 1.6, 40.0) * unit));
    world.settings.length_unit = unit;
    let dt = any_rate(random, &mut world);
    let slope = random.range(0.05, 0.4);
    let (sin, cos) = slope.sin_cos();
    let place = |height: f32| Vec2::new(-sin, cos) * (height * unit);
    let ground = ShapeDef::new(rect(60.0 * unit, unit)).friction(1.0);
    let ground = RigidBody::fixed().position(place(-1.0)).angle(slope).shape(ground);
    world.add_body(ground).expect("a slope");
    let mut add = |x: f32, y: f32, height: f32, friction: f32, mass: f32| {
        let shape = ShapeDef::new(rect(x * unit, y * unit)).friction(friction);
        let mut body = RigidBody::dynamic().position(place(height + y)).angle(slope).shape(shape);
        body.mass = Some(mass);
        world.add_body(body).expect("a body")
    };
    let planks = 1 + random.below(3) as usize;
    for k in 0..planks {
        add(3.0, 0.2, 0.4 * k as f32, 1.0, any_scale(random, 1.0, 10.0));
    }
    // Surfaces rub by the geometric mean.
    let rubs = slope.tan() * random.range(0.95, 0.99);
    let mass = any_scale(random, 0.1, 100.0);
    let slab = add(0.3, 0.08, 0.4 * planks as f32, rubs * rubs, mass);
    let mut way = Vec::new();
    while way.len() < (20.0 / dt) as usize {
        world.step(dt);
        way.push(common::position(&world, slab));
        let body = world.body(slab).expect("the slab");
        if (way[way.len() - 1] - way[0]).length() > 2.6 * unit {
            return false;
        }
        if !body.is_awake() {
            let before = way[way.len().saturating_sub(1 + (0.5 / dt) as usize)];
            return (way[way.len() - 1] - before).length() > 1e-3 * unit;
        }
    }
    false
}

/// What slides slowly off something that stays goes on. Of such slabs 83 of 200 fell asleep, while an island counted as held if any of it
/// was.
#[test]
fn what_slides_off_what_stays_does_not_fall_asleep() {
    let mut random = Random::new(4);
    let asleep = (0..200).filter(|_| sleeps_on_its_way(&mut random)).count();
    assert!(asleep == 0, "{asleep} of 200 fell asleep");
}

/// A disk slides on level ground of pieces that are as long as some part of its way in a step. Gives, as a part of what the law says, how
/// far it goes without turning, or how fast it is once it rolls.
fn slides_on_pieces(random: &mut Random, turns: bool) -> f32 {
    let unit = [0.05, 1.0, 20.0][random.below(3) as usize];
    let mut world = World::new(Vec2::new(0.0, -GRAVITY * unit));
    world.settings.length_unit = unit;
    let dt = any_rate(random, &mut world);
    let (rubs, speed) = (random.range(0.2, 0.8), random.range(3.0, 10.0));
    let piece = any_scale(random, 0.5, 20.0) * speed * dt;
    let way = speed * speed / (2.0 * rubs * GRAVITY);
    let count = ((1.5 * way + 4.0) / piece) as usize;
    let corner = |k: usize| (piece * k as f32 - 2.0) * unit;
    let ground = world.add_body(RigidBody::fixed()).expect("the ground");
    if random.below(2) == 0 {
        let points: Vec<Vec2> = (0..count).rev().map(|k| Vec2::new(corner(k), 0.0)).collect();
        world.add_chain(ground, &ChainDef::open(&points).friction(rubs)).expect("a chain");
    } else {
        for k in 0..count {
            let place = Vec2::new(corner(k) + 0.5 * piece * unit, -0.2 * unit);
            let shape = ShapeDef::new(rect(0.5 * piece * unit, 0.2 * unit)).friction(rubs);
            world.add_body(RigidBody::fixed().position(place).shape(shape)).expect("a piece");
        }
    }
    let r = random.range(0.1, 0.5) * unit;
    let shape = ShapeDef::new(common::circle(r)).friction(rubs);
    let disk = RigidBody::dynamic().position(Vec2::Y * r).shape(shape);
    let disk = world.add_body(disk).expect("a disk");
    let mut body = world.body_mut(disk).expect("it is there");
    body.set_locks(Locks { rotation: !turns, ..Locks::default() });
    (0..(0.3 / dt) as usize).for_each(|_| world.step(dt));
    let start = common::position(&world, disk).x;
    world.body_mut(disk).expect("it is there").set_velocity(Vec2::X * (speed * unit));
    let time = if turns { 1.2 * speed / (3.0 * rubs * GRAVITY) } else { 6.0 };
    for _ in 0..(time / dt) as usize + 1 {
        world.step(dt);
    }
    if turns {
        common::velocity(&world, disk).x / (speed * unit * 2.0 / 3.0)
    } else {
        (common::position(&world, disk).x - start) / (way * unit)
    }
}

/// Friction goes on over seams. Where it began anew on each piece such disks went up to ten times as far, and half of them by a tenth;
/// with one substep nothing braked what came onto a new piece in each step.
#[test]
fn what_slides_over_seams_is_braked_as_on_one_piece() {
    let mut random = Random::new(4);
    for turns in [false, true] {
        let mut parts: Vec<f32> = (0..60).map(|_| slides_on_pieces(&mut random, turns)).collect();
        parts.sort_by(f32::total_cmp);
        let bad = parts.iter().filter(|&&part| (part - 1.0).abs() > 0.05).count();
        assert!(bad <= 3 && parts[0] > 0.9 && parts[59] < 1.1, "{turns}: {bad}, {parts:.3?}");
    }
}
