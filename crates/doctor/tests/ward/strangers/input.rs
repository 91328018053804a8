//! Wrong numbers: not finite, not in metres, not in kilograms, not in seconds.

use super::*;

pub(super) fn all() -> Vec<Patient> {
    let mut patients = numbers();
    patients.extend(sizes());
    patients.extend(masses());
    patients.extend(times());
    patients
}

fn numbers() -> Vec<Patient> {
    vec![
        patient("homing rocket that normalises zero", Code::RefusedInput, 240, homing_rocket()),
        patient("cursor outside the window", Code::RefusedInput, 300, cursor_outside()),
        patient("paused game steps by 0", Code::RefusedInput, 300, paused()),
        patient("magnet without a smallest distance", Code::RefusedInput, 240, magnet()),
    ]
}

/// It flies at its target; there the direction is 0/0.
fn homing_rocket() -> Case {
    let mut world = from_above();
    court(&mut world, 12.0, 8.0);
    pucks(&mut world, 12);
    let rocket = add(&mut world, ball(0.2, -8.0, 4.0).lock_rotation());
    with(world, move |world, _| {
        let target = Vec2::new(-2.0, 4.0);
        let away = target - world.body(rocket).unwrap().position();
        let near = away.length() < 0.2;
        let way = if near { Vec2::ZERO } else { away };
        let velocity = way * (6.0 / way.length());
        world.body_mut(rocket).unwrap().set_velocity(velocity);
    })
}

/// A crate is dragged by its position; the cursor's ray misses the plane from time to time.
fn cursor_outside() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -8.0, 0.0);
    let dragged = add(&mut world, crate_at(3.0, 4.0).gravity_scale(0.0));
    with(world, move |world, step| {
        let slope = if (100..160).contains(&step) { 0.0 } else { 1.0 };
        let place = Vec2::new(3.0 + 0.005 * step as f32 / slope, 4.0);
        world.body_mut(dragged).unwrap().set_position(place);
    })
}

fn paused() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -3.0, 0.0);
    add(&mut world, ball(0.5, 5.0, 6.0));
    paced(world, |step| if (60..200).contains(&step) { 0.0 } else { DT })
}

/// Pull with one over the distance squared, on all crates, the magnet's own included.
fn magnet() -> Case {
    let mut world = earth();
    ground(&mut world);
    let scrap: Vec<_> =
        (0..10).map(|i| add(&mut world, crate_at(-10.0 + 2.0 * i as f32, 0.5))).collect();
    let magnet = scrap[5];
    with(world, move |world, _| {
        let center = world.body(magnet).unwrap().position();
        for &id in &scrap {
            let mut body = world.body_mut(id).unwrap();
            let away = center - body.as_ref().position();
            let pull = away * (2.0 / (away.length_sq() * away.length()));
            body.apply_force_to_center(pull);
        }
    })
}

fn sizes() -> Vec<Patient> {
    vec![
        patient("platformer in pixels", Code::Size, 240, pixels()),
        patient("clockwork in real millimetres", Code::Size, 300, clockwork()),
        patient("asteroids of kilometres", Code::Size, 300, asteroids()),
    ]
}

/// Tiles of 32 pixels, a hero of 28 by 60, y up, gravity as a player feels it.
fn pixels() -> Case {
    let mut world = World::new(Vec2::new(0.0, -980.0));
    for i in 0..20 {
        block(&mut world, 16.0 + 32.0 * i as f32, 16.0, 16.0, 16.0);
    }
    for i in 0..4 {
        add(&mut world, plank(15.0, 15.0, 300.0, 47.0 + 30.0 * i as f32));
    }
    let hero = add(&mut world, plank(14.0, 30.0, 60.0, 62.0).lock_rotation());
    with(world, move |world, _| {
        let mut hero = world.body_mut(hero).unwrap();
        let fall = hero.as_ref().velocity().y;
        hero.set_velocity(Vec2::new(60.0, fall));
    })
}

/// Watch parts of a few millimetres, drawn large.
fn clockwork() -> Case {
    let mut world = earth();
    block(&mut world, 0.0, -0.002, 0.05, 0.002);
    for i in 0..6 {
        add(&mut world, plank(0.002, 0.001, 0.0, 0.001 + 0.002 * i as f32));
        add(&mut world, ball(0.0015, 0.01 + 0.004 * i as f32, 0.004));
    }
    left_alone(world)
}

fn asteroids() -> Case {
    let mut world = from_above();
    for i in 0..9 {
        let place = Vec2::new((i % 3) as f32 * 9000.0, (i / 3) as f32 * 9000.0);
        let rock = thing(Shape::regular(7, 2500.0 + 100.0 * i as f32).unwrap(), place.x, place.y);
        add(&mut world, rock.velocity(Vec2::new(100.0 - 20.0 * i as f32, 15.0)));
    }
    left_alone(world)
}

fn masses() -> Vec<Patient> {
    vec![
        patient("elephant on fruit boxes", Code::MassRatio, 400, elephant()),
        patient("tank on a plank bridge", Code::MassRatio, 400, tank_on_bridge()),
        patient("one crate in grams a square metre", Code::Density, 240, grams()),
        patient("confetti among crates", Code::Density, 300, confetti()),
    ]
}

fn elephant() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -12.0, 0.0);
    for x in [-1.0, 1.0] {
        for i in 0..3 {
            add(&mut world, plank(0.3, 0.25, x, 0.25 + 0.5 * i as f32).mass(2.0));
        }
    }
    add(&mut world, plank(1.6, 1.0, 0.0, 2.5).mass(5000.0));
    left_alone(world)
}

fn tank_on_bridge() -> Case {
    let mut world = earth();
    let mut last = block(&mut world, -9.0, 3.0, 1.5, 1.0);
    let right = block(&mut world, 9.0, 3.0, 1.5, 1.0);
    block(&mut world, 0.0, -1.0, 30.0, 1.0);
    let mut hook = Vec2::new(1.5, 0.9);
    for i in 0..15 {
        let board = add(&mut world, plank(0.5, 0.1, -7.0 + i as f32, 3.9).mass(5.0));
        let pin = JointDef::revolute().anchors(hook, Vec2::new(-0.5, 0.0));
        world.add_joint(last, board, pin).unwrap();
        (last, hook) = (board, Vec2::new(0.5, 0.0));
    }
    let pin = JointDef::revolute().anchors(hook, Vec2::new(-1.5, 0.9));
    world.add_joint(last, right, pin).unwrap();
    add(&mut world, plank(1.2, 0.6, 0.0, 4.7).mass(20_000.0));
    left_alone(world)
}

/// A level in kilograms; one prefab came in with grams.
fn grams() -> Case {
    let mut world = earth();
    ground(&mut world);
    for i in 0..8 {
        add(&mut world, crate_at(-9.0 + 2.5 * i as f32, 0.5));
    }
    let heavy = ShapeDef::new(Shape::rect(0.5, 0.5).unwrap()).density(400_000.0);
    add(&mut world, RigidBody::dynamic().position(Vec2::new(15.0, 0.5)).shape(heavy));
    left_alone(world)
}

fn confetti() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -6.0, 0.0);
    for i in 0..20 {
        let paper = ShapeDef::new(Shape::rect(0.12, 0.06).unwrap()).density(1.0e-5);
        let place = Vec2::new(4.0 + 0.35 * i as f32, 2.0 + 0.1 * (i % 5) as f32);
        add(&mut world, RigidBody::dynamic().position(place).shape(paper).damping(2.0, 1.0));
    }
    left_alone(world)
}

fn times() -> Vec<Patient> {
    vec![
        patient("server ticks ten times a second", Code::StepTooLong, 100, server_ticks()),
        patient("milliseconds for seconds", Code::StepTooLong, 60, milliseconds()),
        patient("step is the frame's time", Code::VariableStep, 400, frame_times()),
        patient("hitches while levels load", Code::VariableStep, 400, hitches()),
    ]
}

fn server_ticks() -> Case {
    let mut world = from_above();
    court(&mut world, 20.0, 12.0);
    for i in 0..10 {
        let car = plank(0.9, 0.45, -15.0 + 3.0 * i as f32, -8.0 + 1.6 * i as f32).restitution(0.5);
        let speed = if i % 2 == 0 { 22.0 } else { -18.0 };
        add(&mut world, car.velocity(Vec2::new(speed, 3.0)));
    }
    paced(world, |_| 0.1)
}

fn milliseconds() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -3.0, 0.0);
    add(&mut world, ball(0.5, 4.0, 6.0));
    paced(world, |_| 16.6)
}

/// A screen of 144 Hz with a browser behind it.
fn frame_times() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -3.0, 0.0);
    for i in 0..12 {
        add(&mut world, ball(0.3, 4.0 + 0.2 * i as f32, 1.0 + 0.8 * i as f32));
    }
    paced(world, |step| {
        let noise = (step.wrapping_mul(2_654_435_761) >> 8) % 1000;
        0.0069 + 0.012 * noise as f32 / 1000.0
    })
}

fn hitches() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, 3.0, 0.0);
    add(&mut world, ball(0.5, -3.0, 9.0).restitution(0.6));
    paced(
        world,
        |step| if step % 37 == 11 { 0.05 } else { 1.0 / 60.0 + 0.0005 * (step % 4) as f32 },
    )
}
