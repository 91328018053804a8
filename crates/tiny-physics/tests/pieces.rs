//! Level floors of pieces of any outline: nothing catches on what lies below the seams.

mod common;

use common::Random;
use tiny_physics::{Polygon, RigidBody, Rot, Settings, Shape, ShapeDef, Vec2, World};

/// A piece whose top goes from x to x + length.
fn piece(random: &mut Random, kind: usize, x: f32, length: f32, unit: f32) -> Shape {
    let deep = -random.range(0.1, 2.0) * unit;
    let at = |part: f32, y: f32| Vec2::new(x + part * length, y);
    let below: &[f32] = match kind {
        0 => &[0.5],
        1 => &[random.range(0.05, 0.95)],
        2 => &[random.range(0.0, 0.5), random.range(0.5, 1.0)],
        3 if random.range(0.0, 1.0) < 0.5 => &[0.0],
        3 => &[1.0],
        _ if random.range(0.0, 1.0) < 0.5 => &[0.5],
        _ => &[0.0, 1.0],
    };
    let top = [0.0, 1.0].map(|part| at(part, 0.0));
    let corners: Vec<_> = below.iter().map(|&part| at(part, deep)).chain(top).collect();
    Shape::hull(&corners).expect("a piece")
}

fn mover(kind: usize, size: f32) -> Shape {
    let [half, flat] = [0.5, 0.125].map(|part| part * size);
    let shape = match kind {
        0 | 1 => Shape::rect(half, half),
        2 => {
            Shape::hull(&[(-half, -half), (half, -half), (0.0, half)].map(|(x, y)| Vec2::new(x, y)))
        }
        3 => Shape::rect(4.0 * half, half),
        4 => Polygon::rect(half - flat, half - flat)
            .map(|polygon| polygon.rounded(flat).unwrap().into()),
        _ => Shape::circle(half),
    };
    shape.expect("a mover")
}

/// Where the underside of the piece ahead is steep, boxes met that though it is below the floor: 100 of these 400 were thrown or stopped.
#[test]
fn what_slides_over_pieces_of_any_outline_keeps_its_speed() {
    let mut random = Random::new(31);
    let mut bad = Vec::new();
    for member in 0..400 {
        let unit = [1.0, 0.05, 1.0, 20.0][member % 4];
        let speed = random.range(2.0, 20.0) * unit;
        let angle = if member % 3 == 0 { random.range(-3.0, 3.0) } else { 0.0 };
        let turn = Rot::from_angle(angle);
        let substeps = [4, 1, 2, 8][member / 4 % 4];
        let settings = Settings { substeps, length_unit: unit, ..Settings::default() };
        let gravity = turn.rotate(Vec2::new(0.0, -random.range(1.6, 40.0) * unit));
        let mut world = World::with_settings(gravity, settings);
        let floor = || match member / 5 % 4 {
            0 | 1 => RigidBody::fixed().angle(angle),
            2 => RigidBody::kinematic().angle(angle),
            _ => RigidBody::dynamic().mass(1.0e9).gravity_scale(0.0).angle(angle),
        };
        let (mut x, mut body, kind) = (-6.0 * unit, floor(), member / 16 % 5);
        while x < 30.0 * unit {
            let length = random.range(0.3, 4.0) * unit;
            let shape = ShapeDef::new(piece(&mut random, kind, x, length, unit)).friction(0.0);
            if member / 5 % 4 == 0 {
                world.add_body(floor().shape(shape)).expect("ground");
            } else {
                body = body.shape(shape);
            }
            x += length;
        }
        world.add_body(body).expect("ground");
        let size = random.range(0.1, 1.0) * unit;
        let shape = ShapeDef::new(mover(member / 80 % 6, size)).friction(0.0);
        let body = RigidBody::dynamic().shape(shape).angle(angle);
        let body = body.position(turn.rotate(Vec2::new(-2.0 * unit, 0.5 * size)));
        let body = world.add_body(body.velocity(turn.rotate(Vec2::new(speed, 0.0)))).unwrap();
        let rate = [60.0, 60.0, 120.0, 30.0, 240.0][member % 5];
        for _ in 0..(25.0 * unit / speed * rate) as u32 {
            world.step(1.0 / rate);
        }
        let body = world.body(body).expect("a body");
        let velocity = turn.unrotate(body.velocity()) * (1.0 / speed);
        if (velocity - Vec2::X).length() > 0.02 || body.angular_velocity().abs() > 0.1 {
            bad.push((member, kind, velocity, body.angular_velocity()));
        }
    }
    assert!(bad.is_empty(), "{} of 400: {bad:?}", bad.len());
}

/// Into the nooks below the seams nothing goes further than the undersides of both pieces.
#[test]
fn what_comes_from_below_meets_the_undersides() {
    let mut random = Random::new(32);
    for member in 0..200 {
        let unit = [1.0, 0.05, 20.0][member % 3];
        let settings = Settings { length_unit: unit, ..Settings::default() };
        let mut world = World::with_settings(Vec2::ZERO, settings);
        let mut body = RigidBody::fixed();
        for k in [-1.0, 0.0] {
            let shape = piece(&mut random, member % 5, 2.0 * k * unit, 2.0 * unit, unit);
            body = body.shape(ShapeDef::new(shape).friction(0.0));
        }
        world.add_body(body).expect("ground");
        let (size, speed) = (random.range(0.02, 0.4) * unit, random.range(0.5, 20.0) * unit);
        let (x, from) = (random.range(-1.0, 1.0) * unit, Vec2::new(0.0, -4.0 * unit));
        let place = from + Vec2::new(x, 0.0);
        let body = RigidBody::dynamic().shape(mover(member / 5 % 6, size)).position(place);
        let body = body.velocity((Vec2::ZERO - place).normalized() * speed);
        let body = world.add_body(body).expect("a body");
        for _ in 0..(6.0 * unit / speed * 60.0) as u32 {
            world.step(1.0 / 60.0);
            let Vec2 { x, y } = world.body(body).expect("a body").position();
            // It may have been led off the outer side of a piece.
            let is_beyond = x.abs() > 2.0 * unit - size;
            assert!(y < 0.0 || is_beyond, "{member}: {x}, {y}, {size} wide, {speed} m/s");
        }
    }
}

/// A track of round pieces end to end: level first, then it bends up by so much at each joint.
fn round_track(
    (kind, member): (usize, usize),
    (bend, length, radius): (f32, f32, f32),
    turn: Rot,
) -> Vec<RigidBody> {
    let mut bodies = vec![RigidBody::fixed()];
    let (mut at, mut angle) = (Vec2::new(-2.0 * length, 0.0), 0.0);
    for k in 0..40 {
        let along = Rot::from_angle(angle).rotate(Vec2::X);
        let (end, down) = (at + along * length, along.perp() * -0.5 * length);
        // The middles of their ends are the same, or those of their tops.
        let deep = if kind == 3 { along.perp() * -radius } else { Vec2::ZERO };
        let corners = [at + deep, end + deep, end + down, at + down];
        let [a, b, c, d] = corners.map(|point| turn.rotate(point));
        let mut shapes = match kind {
            0 | 1 | 3 => vec![Shape::capsule(a, b, radius).unwrap()],
            _ => vec![Polygon::hull(&[a, b, c, d]).unwrap().rounded(radius).unwrap().into()],
        };
        let offset = if kind == 1 {
            shapes.push(Shape::circle(radius).unwrap());
            b
        } else {
            Vec2::ZERO
        };
        if member % 2 == 0 {
            bodies.push(RigidBody::fixed());
        }
        for (i, shape) in shapes.into_iter().enumerate() {
            let place = if i == 1 { offset } else { Vec2::ZERO };
            let last = bodies.pop().expect("a body");
            bodies.push(last.shape(ShapeDef::new(shape).offset(place).friction(0.0)));
        }
        at = end;
        angle += if k > 3 { bend } else { 0.0 };
        if angle > 1.2 {
            break;
        }
    }
    bodies
}

/// In bowls of capsules end to end, with balls in their joints or not, and of round blocks: no joint takes more than a hit on the next piece does.
#[test]
fn what_slides_in_bowls_of_round_pieces_keeps_its_energy() {
    let mut random = Random::new(33);
    let mut bad = Vec::new();
    for member in 0..300 {
        let unit = [1.0, 0.05, 1.0, 20.0][member % 4];
        let angle = if member % 3 == 0 { random.range(-3.0, 3.0) } else { 0.0 };
        let turn = Rot::from_angle(angle);
        let (bend, length) = (random.range(0.01, 0.1), random.range(0.3, 1.5) * unit);
        let radius = random.range(0.02, 0.3) * unit;
        let (speed, gravity) = (random.range(2.0, 15.0) * unit, random.range(1.6, 20.0) * unit);
        let (kind, rate) = (member / 3 % 4, [60.0, 60.0, 120.0, 30.0, 240.0][member % 5]);
        let substeps = [4, 4, 2, 8][member / 2 % 4];
        let settings = Settings { substeps, length_unit: unit, ..Settings::default() };
        let mut world = World::with_settings(turn.rotate(Vec2::new(0.0, -gravity)), settings);
        for body in round_track((kind, member / 9), (bend, length, radius), turn) {
            world.add_body(body).expect("ground");
        }
        let size = random.range(0.1, 0.5) * unit;
        let top = if kind == 3 { 0.0 } else { radius };
        let shape = ShapeDef::new(mover([0, 2, 4, 5, 5][member / 60], size)).friction(0.0);
        let body = RigidBody::dynamic().shape(shape).angle(angle);
        let body = body.position(turn.rotate(Vec2::new(-length, top + 0.5 * size)));
        let body = world.add_body(body.velocity(turn.rotate(Vec2::new(speed, 0.0)))).unwrap();
        let start = common::energy(&world);
        let (mut time, mut highest) = (0.0, 0.0_f32);
        let mut kept = 1.0;
        // Up to where it turns back, or comes to the end.
        while time * speed < 40.0 * length {
            world.step(1.0 / rate);
            time += 1.0 / rate;
            let body = world.body(body).expect("a body");
            let velocity = turn.unrotate(body.velocity());
            let slope = velocity.y.atan2(velocity.x);
            highest = highest.max(slope);
            if velocity.x < 0.1 * speed || slope > 1.1 {
                break;
            }
            let base = f64::from(body.mass()) * f64::from(speed) * f64::from(speed) * 0.5;
            kept = 1.0 + (common::energy(&world) - start) / base;
        }
        let joints = f64::from((highest / bend).ceil());
        let least = 1.0 - joints * f64::from(bend * bend) - 0.05;
        if !(least..1.02).contains(&kept) {
            bad.push((member, kind, kept as f32, least as f32));
        }
    }
    assert!(bad.is_empty(), "{} of 300: {bad:?}", bad.len());
}
