//! Things where they should not be: through walls, in each other, gone.

use super::*;
use std::cell::Cell;

pub(super) fn all() -> Vec<Patient> {
    let mut patients = overlaps();
    patients.extend(teleports());
    patients.extend(filters());
    patients.extend(passes());
    patients.extend(gone());
    patients.extend(squeezed());
    patients
}

fn overlaps() -> Vec<Patient> {
    vec![
        patient("wave of enemies at one point", Code::OverlapAtStart, 300, enemy_wave()),
        patient("house with posts in its floor", Code::OverlapAtStart, 200, sunken_house()),
        patient("loot drops inside its chest", Code::OverlapAtStart, 240, loot()),
    ]
}

/// Five orcs every second, all at the gate.
fn enemy_wave() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, 10.0, 0.0);
    with(world, |world, step| {
        if step % 60 == 30 && step < 200 {
            for _ in 0..5 {
                let orc = Shape::capsule(Vec2::new(0.0, -0.5), Vec2::new(0.0, 0.5), 0.4).unwrap();
                add(world, thing(orc, -10.0, 1.0).lock_rotation());
            }
        }
    })
}

/// Halves taken for wholes: posts of 2 m stand 0.5 m deep in the ground, and the roof in the posts.
fn sunken_house() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -14.0, 0.0);
    for x in [-2.0, 2.0] {
        add(&mut world, plank(0.2, 1.0, x, 0.5));
    }
    add(&mut world, plank(2.6, 0.25, 0.0, 1.5));
    left_alone(world)
}

fn loot() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -10.0, 0.0);
    let chest = add(&mut world, plank(0.6, 0.4, 3.0, 0.4).mass(40.0));
    with(world, move |world, step| {
        if step == 90 {
            let place = world.body(chest).unwrap().position();
            for _ in 0..8 {
                add(world, ball(0.1, place.x, place.y));
            }
        }
    })
}

fn teleports() -> Vec<Patient> {
    vec![
        patient("lift led by its position", Code::Teleport, 300, lift_by_position()),
        patient("ship wraps round into a rock", Code::Teleport, 300, wrap_round()),
        patient("dash that sets a place in a wall", Code::Teleport, 240, dash()),
        patient("network corrections through crates", Code::Teleport, 300, corrections()),
    ]
}

/// A platform that rises by `set_position`, with passengers.
fn lift_by_position() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -12.0, 0.0);
    let deck = Shape::rect(2.0, 0.15).unwrap();
    let lift = RigidBody::kinematic().position(Vec2::new(4.0, 0.15)).shape(deck);
    let lift = add(&mut world, lift);
    add(&mut world, crate_at(3.4, 0.8));
    add(&mut world, crate_at(4.8, 0.8));
    with(world, move |world, step| {
        let height = 0.15 + (step as f32 * 0.1).min(6.0);
        world.body_mut(lift).unwrap().set_position(Vec2::new(4.0, height));
    })
}

fn wrap_round() -> Case {
    let mut world = from_above();
    for i in 0..6 {
        let rock = thing(Shape::regular(6, 1.2).unwrap(), -19.3 + 8.0 * i as f32, 2.0 * i as f32);
        add(&mut world, rock);
    }
    let ship = add(&mut world, plank(0.7, 0.35, 10.0, 0.0).velocity(Vec2::new(9.0, 0.0)));
    with(world, move |world, _| {
        let mut ship = world.body_mut(ship).unwrap();
        let place = ship.as_ref().position();
        if place.x > 20.0 {
            ship.set_position(Vec2::new(-20.0, place.y));
        }
    })
}

fn dash() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -14.0, 0.0);
    block(&mut world, 6.0, 2.0, 0.6, 2.0);
    let hero = Shape::capsule(Vec2::new(0.0, -0.4), Vec2::new(0.0, 0.4), 0.35).unwrap();
    let hero = add(&mut world, thing(hero, 0.0, 0.75).lock_rotation());
    with(world, move |world, step| {
        if step == 60 || step == 120 {
            let mut hero = world.body_mut(hero).unwrap();
            let place = hero.as_ref().position();
            hero.set_position(place + Vec2::new(3.0, 0.0));
        }
    })
}

/// Another player's car is put where the server says, four times a second.
fn corrections() -> Case {
    let mut world = from_above();
    court(&mut world, 15.0, 9.0);
    for i in 0..15 {
        let x = -6.0 + 3.0 * (i % 5) as f32;
        add(&mut world, crate_at(x, (i / 5) as f32 * 1.2 - 1.2).damping(3.0, 3.0));
    }
    let car = add(&mut world, plank(1.0, 0.5, -12.0, 0.0).velocity(Vec2::new(8.0, 0.0)).mass(4.0));
    with(world, move |world, step| {
        if step % 15 == 14 {
            let at = -12.0 + 8.0 * step as f32 * DT;
            let mut car = world.body_mut(car).unwrap();
            car.set_position(Vec2::new(at, 0.0));
            car.set_velocity(Vec2::new(8.0, 0.0));
        }
    })
}

fn filters() -> Vec<Patient> {
    vec![
        patient("hero's mask without platforms", Code::Filter, 240, forgotten_bit()),
        patient("categories counted, not shifted", Code::Filter, 240, counted_categories()),
        patient("category from an enum that begins at 0", Code::Filter, 240, category_zero()),
        patient("boulder in the party's group", Code::Filter, 300, one_group()),
    ]
}

const GROUND: u64 = 1;
const HERO: u64 = 1 << 1;
const PLATFORM: u64 = 1 << 3;

fn filtered(shape: Shape, category: u64, mask: u64) -> ShapeDef {
    ShapeDef::new(shape).filter(Filter { category, mask, ..Filter::default() })
}

/// Falls through the platform that it jumps to, stands on the ground below.
fn forgotten_bit() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -12.0, 0.0);
    let board = filtered(Shape::rect(2.5, 0.2).unwrap(), PLATFORM, u64::MAX);
    for i in 0..3 {
        let place = Vec2::new(3.0 * i as f32, 2.0 + 1.5 * i as f32);
        add(&mut world, RigidBody::fixed().position(place).shape(board.clone()));
    }
    add(&mut world, crate_at(6.0, 5.8));
    let hero = filtered(Shape::rect(0.3, 0.7).unwrap(), HERO, GROUND | HERO);
    let hero = RigidBody::dynamic().position(Vec2::new(0.0, 3.5)).shape(hero).lock_rotation();
    let hero = add(&mut world, hero);
    with(world, move |world, step| {
        if step == 90 {
            world.body_mut(hero).unwrap().set_velocity(Vec2::new(1.0, 9.0));
        }
    })
}

/// Ground 1, hero 2, enemy 3, crate 4: the crate's mask is to be ground and enemies, "1 | 3", and the hero's
/// "1 | 4".
fn counted_categories() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -14.0, 0.0);
    for i in 0..3 {
        let shape = filtered(Shape::rect(0.5, 0.5).unwrap(), 4, 1 | 3);
        add(&mut world, RigidBody::dynamic().position(Vec2::new(4.0, 0.5 + i as f32)).shape(shape));
    }
    let hero = filtered(Shape::rect(0.4, 0.8).unwrap(), 2, 1 | 4);
    let hero = RigidBody::dynamic().position(Vec2::new(0.0, 0.8)).shape(hero).lock_rotation();
    let hero = add(&mut world, hero);
    with(world, move |world, _| {
        let mut hero = world.body_mut(hero).unwrap();
        hero.set_velocity(Vec2::new(2.0, 0.0));
    })
}

/// `category: Kind::Coin as u64` where `Coin` is 0.
fn category_zero() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -8.0, 0.0);
    for i in 0..8 {
        let coin = filtered(Shape::circle(0.2).unwrap(), 0, u64::MAX);
        let place = Vec2::new(3.0 + 0.6 * i as f32, 2.0);
        add(&mut world, RigidBody::dynamic().position(place).shape(coin));
    }
    left_alone(world)
}

/// Friends have group -1 so that they walk through each other; so has, by copying, the boulder that is to hit them.
fn one_group() -> Case {
    let mut world = earth();
    ground(&mut world);
    let party = Filter { group: -1, ..Filter::default() };
    for i in 0..3 {
        let friend = ShapeDef::new(Shape::rect(0.3, 0.8).unwrap()).filter(party);
        let place = Vec2::new(3.0 + 1.5 * i as f32, 0.8);
        add(&mut world, RigidBody::dynamic().position(place).shape(friend).lock_rotation());
    }
    village(&mut world, 16.0, 0.0);
    let boulder = ShapeDef::new(Shape::circle(0.8).unwrap()).filter(party);
    let boulder = RigidBody::dynamic().position(Vec2::new(-6.0, 0.8)).shape(boulder);
    add(&mut world, boulder.velocity(Vec2::new(5.0, 0.0)));
    left_alone(world)
}

fn passes() -> Vec<Patient> {
    vec![
        patient("slug through a row of shields", Code::Tunnelling, 120, slug()),
        patient("hail through a shed's roof", Code::Tunnelling, 200, hail()),
        patient("bat swung through the ball", Code::Tunnelling, 200, bat()),
        patient("pebbles that hit boards by luck", Code::NearMiss, 180, pebbles()),
        patient("puck against a thin goalie", Code::NearMiss, 240, goalie()),
        patient("ship whose thrust nothing stops", Code::SpeedLimit, 400, thrust()),
        patient("railgun of 3 km/s", Code::SpeedLimit, 60, railgun()),
    ]
}

/// Shields lie loose, seen from above; the slug is no bullet.
fn slug() -> Case {
    let mut world = from_above();
    court(&mut world, 30.0, 8.0);
    pucks(&mut world, 10);
    for i in 0..5 {
        add(&mut world, plank(0.05, 1.0, 2.3 + 4.0 * i as f32, 3.0).damping(1.0, 1.0));
    }
    add(&mut world, ball(0.08, -25.0, 3.0).velocity(Vec2::new(190.0, 0.0)));
    left_alone(world)
}

/// Continuous collision was switched off for speed.
fn hail() -> Case {
    let settings = Settings { continuous: false, ..Settings::default() };
    let mut world = earth_with(settings);
    block(&mut world, 0.0, -3.0, 50.0, 3.0);
    village(&mut world, -14.0, 0.0);
    block(&mut world, 0.0, 4.0, 4.0, 0.04);
    for x in [-3.9, 3.9] {
        block(&mut world, x, 1.98, 0.1, 1.98);
    }
    for i in 0..12 {
        let place = Vec2::new(-3.0 + 0.5 * i as f32, 25.0 + 1.37 * i as f32);
        add(&mut world, ball(0.06, place.x, place.y).velocity(Vec2::new(0.0, -55.0)));
    }
    left_alone(world)
}

/// A kinematic bat that moves 1.5 m a step across the ball.
fn bat() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, 10.0, 0.0);
    let stand = block(&mut world, 0.0, 0.4, 0.1, 0.4);
    let ball = add(&mut world, ball(0.12, 0.0, 0.92));
    let bat = RigidBody::kinematic().position(Vec2::new(-6.5, 1.0));
    let bat = add(&mut world, bat.shape(Shape::rect(0.05, 0.5).unwrap()));
    let _ = (stand, ball);
    with(world, move |world, step| {
        let speed = if (60..66).contains(&step) { 90.0 } else { 0.0 };
        world.body_mut(bat).unwrap().set_velocity(Vec2::new(speed, 0.0));
    })
}

/// 0.83 m a step, boards of 0.4 m.
fn pebbles() -> Case {
    let mut world = from_above();
    court(&mut world, 16.0, 9.0);
    pucks(&mut world, 7);
    for i in 0..4 {
        let y = 1.0 + 1.8 * i as f32;
        add(&mut world, plank(0.2, 0.7, 6.0, y).damping(2.0, 2.0).mass(8.0));
        let start = 6.0 - 0.1 - 8.0 * 50.0 * DT - 0.05 * i as f32;
        add(&mut world, ball(0.1, start, y).velocity(Vec2::new(50.0, 0.0)).damping(0.0, 1.0));
    }
    left_alone(world)
}

fn goalie() -> Case {
    let mut world = from_above();
    court(&mut world, 15.0, 7.0);
    let goalie = add(&mut world, plank(0.15, 0.6, 12.0, 0.0).mass(80.0).damping(1.0, 1.0));
    pucks(&mut world, 7);
    let puck = add(&mut world, ball(0.04, 0.55, 0.0).mass(0.16).restitution(0.3));
    let _ = goalie;
    with(world, move |world, step| {
        if step == 30 {
            world.body_mut(puck).unwrap().set_velocity(Vec2::new(38.0, 0.0));
        }
    })
}

fn thrust() -> Case {
    let mut world = from_above();
    for i in 0..5 {
        add(&mut world, thing(Shape::regular(5, 1.5).unwrap(), -20.0, 8.0 * i as f32));
    }
    let ship = add(&mut world, plank(1.0, 0.5, 0.0, -9.0));
    with(world, move |world, _| {
        let mut ship = world.body_mut(ship).unwrap();
        let mass = ship.as_ref().mass();
        ship.apply_force_to_center(Vec2::new(90.0 * mass, 0.0));
    })
}

fn railgun() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -12.0, 0.0);
    let shell = ball(0.1, -30.0, 8.0).bullet();
    add(&mut world, shell.velocity(Vec2::new(3000.0, 0.0)));
    left_alone(world)
}

fn gone() -> Vec<Patient> {
    vec![
        patient("barrels roll off the level's edge", Code::FellOut, 700, off_the_edge()),
        patient("level unloaded under its crates", Code::FellOut, 600, unloaded()),
        patient("asteroid belt with gravity to the left", Code::FellOut, 700, sideways()),
    ]
}

fn off_the_edge() -> Case {
    let mut world = earth();
    block(&mut world, 0.0, -0.5, 12.0, 0.5);
    village(&mut world, -8.0, 0.0);
    for i in 0..3 {
        add(&mut world, ball(0.5, 2.0 + 1.5 * i as f32, 0.5).velocity(Vec2::new(5.0, 0.0)));
    }
    left_alone(world)
}

/// The next room's floor goes with the room, its crates stay.
fn unloaded() -> Case {
    let mut world = earth();
    block(&mut world, -10.0, -0.5, 10.0, 0.5);
    village(&mut world, -10.0, 0.0);
    let room = block(&mut world, 10.0, -0.5, 10.0, 0.5);
    for i in 0..5 {
        add(&mut world, crate_at(6.0 + 1.5 * i as f32, 0.5));
    }
    with(world, move |world, step| {
        if step == 100 {
            world.remove_body(room).unwrap();
        }
    })
}

/// Gravity points to the left wall, which has a door in it.
fn sideways() -> Case {
    let mut world = World::new(Vec2::new(-8.0, 0.0));
    block(&mut world, -10.5, 6.0, 0.5, 4.0);
    block(&mut world, -10.5, -6.0, 0.5, 4.0);
    for i in 0..7 {
        add(&mut world, crate_at(-4.0, -7.5 + 2.5 * i as f32));
    }
    left_alone(world)
}

fn squeezed() -> Vec<Patient> {
    vec![
        patient("ghost hour ends inside a wall", Code::Stuck, 300, ghost()),
        patient("hero stands up in the duct", Code::Stuck, 300, stands_up()),
        patient("disabled guard comes back where a safe is", Code::Stuck, 300, comes_back()),
        patient("trash compactor that does not stop", Code::DeepOverlap, 300, compactor()),
        patient("lift presses a crate to the ceiling", Code::DeepOverlap, 300, lift_to_ceiling()),
        patient("press of ten meganewtons", Code::DeepOverlap, 300, press()),
    ]
}

/// A power-up clears the hero's mask; it runs out in the middle of a wall that is thicker than the hero.
fn ghost() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -14.0, 0.0);
    block(&mut world, 6.0, 3.0, 2.0, 3.0);
    let hero = add(&mut world, plank(0.3, 0.7, 0.0, 0.7).lock_rotation().gravity_scale(0.0));
    let left = Cell::new(120);
    with(world, move |world, step| {
        let shape = world.body(hero).unwrap().shapes().next().unwrap();
        let mask = if step < left.get() { 0 } else { u64::MAX };
        let filter = Filter { mask, ..Filter::default() };
        if step == 0 || step == left.get() {
            world.shape_mut(shape).unwrap().set_filter(filter);
        }
        let speed = if step < left.get() { 3.0 } else { 0.0 };
        if step <= left.get() {
            world.body_mut(hero).unwrap().set_velocity(Vec2::new(speed, 0.0));
        }
    })
}

/// Crouched it is 0.9 m tall, the duct is 1 m; the key is let go inside.
fn stands_up() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -14.0, 0.0);
    block(&mut world, 6.0, 3.0, 4.0, 2.0);
    let low = Shape::rect(0.4, 0.45).unwrap();
    let hero = add(&mut world, thing(low, 0.0, 0.45).lock_rotation());
    with(world, move |world, step| {
        if step < 120 {
            world.body_mut(hero).unwrap().set_velocity(Vec2::new(3.0, 0.0));
        }
        if step == 120 {
            let shape = world.body(hero).unwrap().shapes().next().unwrap();
            world.shape_mut(shape).unwrap().set_shape(Shape::rect(0.4, 0.9).unwrap()).unwrap();
        }
    })
}

/// A guard is switched off while far away; meanwhile a safe was put in the alcove where it stood.
fn comes_back() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -14.0, 0.0);
    // The alcove is as wide as the guard.
    block(&mut world, 2.4, 2.0, 0.5, 2.0);
    block(&mut world, 4.6, 2.0, 0.5, 2.0);
    block(&mut world, 3.5, 3.0, 0.6, 0.3);
    let guard = add(&mut world, plank(0.5, 1.3, 3.5, 1.3).lock_rotation().mass(80.0));
    with(world, move |world, step| {
        if step == 30 {
            world.body_mut(guard).unwrap().set_enabled(false);
            block(world, 3.5, 1.0, 0.55, 1.0);
        }
        if step == 60 {
            world.body_mut(guard).unwrap().set_enabled(true);
        }
    })
}

fn compactor() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -16.0, 0.0);
    for i in 0..4 {
        add(&mut world, crate_at(-0.6 + 1.1 * (i % 2) as f32, 0.5 + (i / 2) as f32));
    }
    let jaw = |world: &mut World, x: f32| {
        let jaw = RigidBody::kinematic().position(Vec2::new(x, 2.0));
        add(world, jaw.shape(Shape::rect(0.5, 1.99).unwrap()))
    };
    let jaws = [(jaw(&mut world, -4.0), 1.0), (jaw(&mut world, 4.0), -1.0)];
    with(world, move |world, step| {
        for (jaw, way) in jaws {
            let speed = if step < 170 { 1.2 * way } else { 0.0 };
            world.body_mut(jaw).unwrap().set_velocity(Vec2::new(speed, 0.0));
        }
    })
}

fn lift_to_ceiling() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -14.0, 0.0);
    block(&mut world, 3.0, 6.5, 2.5, 0.5);
    let deck = Shape::rect(1.2, 0.15).unwrap();
    let lift = RigidBody::kinematic().position(Vec2::new(3.0, 0.15)).shape(deck);
    let lift = add(&mut world, lift);
    add(&mut world, crate_at(3.0, 0.8));
    with(world, move |world, step| {
        // Its upper end was set for riders of half a metre.
        let height = 0.15 + (step as f32 * 0.03).min(5.2);
        let target = tiny_physics::Transform::from_angle(Vec2::new(3.0, height), 0.0);
        world.body_mut(lift).unwrap().set_target(target, DT);
    })
}

fn press() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -14.0, 0.0);
    let frame = block(&mut world, 3.0, 6.0, 2.0, 0.3);
    let head = add(&mut world, plank(1.0, 0.4, 3.0, 4.0).mass(50.0));
    let slide = JointDef::prismatic(-Vec2::Y).motor(1.0, 1.0e7);
    world.add_joint(frame, head, slide).unwrap();
    add(&mut world, crate_at(3.0, 0.5));
    left_alone(world)
}
