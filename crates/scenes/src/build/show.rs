//! Small scenes that show what the engine can do; they are shipped as scene files too.

use super::{Options, add_pyramid, crate_at, ground};
use crate::human::Human;
use crate::scene::Scene;
use crate::shapes;
use core::f32::consts::{FRAC_PI_2, PI};
use tiny_physics::math::{cos, sin};
use tiny_physics::{Filter, JointDef, RigidBody, Shape, ShapeDef, Vec2};

fn floor(scene: &mut Scene) -> usize {
    scene.body(ground(Vec2::new(0.0, -1.0), 40.0, 1.0))
}

/// Crates on top of each other; size is their number.
pub(crate) fn stack(options: Options) -> Scene {
    let count = options.size_or(20, 1000);
    let mut scene = Scene::new("stack", "A tower of crates that stands still.");
    floor(&mut scene);
    for i in 0..count {
        scene.body(crate_at(0.0, 0.5 + i as f32));
    }
    scene
}

/// A pyramid of crates; size is its rows.
pub(crate) fn pyramid(options: Options) -> Scene {
    let base = options.size_or(15, 200);
    let mut scene = Scene::new("pyramid", "A small pyramid of crates that stands still.");
    scene.body(ground(Vec2::new(0.0, -1.0), 40.0 + base as f32, 1.0));
    add_pyramid(&mut scene, base, -0.5 * base as f32, 0.0, |body| body);
    scene
}

/// Balls on rods that touch each other; the first is let go from the side. Size is their number.
pub(crate) fn newton_cradle(options: Options) -> Scene {
    const RADIUS: f32 = 0.5;
    const ROD: f32 = 4.0;
    let count = options.size_or(5, 50);
    let mut scene =
        Scene::new("newton_cradle", "Five steel balls hand a knock through to the last.");
    scene.view = Some((Vec2::new(-6.8, 1.2), Vec2::new(6.8, 6.4)));
    let bar = scene.body(RigidBody::fixed());
    for i in 0..count {
        let hook = Vec2::new(2.0 * RADIUS * (i as f32 - 0.5 * (count - 1) as f32), 6.0);
        let hanging = if i == 0 { Vec2::new(-ROD, 0.0) } else { Vec2::new(0.0, -ROD) };
        let ball =
            ShapeDef::new(shapes::circle(RADIUS)).friction(0.0).restitution(1.0).density(8.0);
        let ball =
            scene.body(RigidBody::dynamic().position(hook + hanging).can_sleep(false).shape(ball));
        scene.joint(bar, ball, JointDef::distance(ROD).anchors(hook, Vec2::ZERO));
    }
    scene
}

/// A row of dominoes and a ball that rolls into it; size is the number of dominoes.
pub(crate) fn domino(options: Options) -> Scene {
    let count = options.size_or(30, 1000);
    let mut scene = Scene::new("domino", "A ball tips the first domino; the rest follow.");
    scene.view = Some((Vec2::new(-6.0, -1.0), Vec2::new(30.5, 4.0)));
    let half_length = 0.5 * count as f32;
    scene.body(ground(Vec2::new(half_length, -1.0), half_length + 12.0, 1.0));
    for i in 0..count {
        let place = Vec2::new(i as f32, 1.0);
        scene
            .body(RigidBody::dynamic().position(place).shape(shapes::rect(0.1, 1.0)).friction(0.5));
    }
    // It hits above the middle of the domino: below, it would knock the foot away.
    let start = Vec2::new(-4.0, 1.2);
    let ball = RigidBody::dynamic().position(start).velocity(Vec2::new(2.5, 0.0));
    scene.body(ball.shape(shapes::circle(1.2)));
    scene
}

/// Leaning cards with flat cards between the levels; size is the number of levels.
pub(crate) fn card_house(options: Options) -> Scene {
    const LEAN: f32 = 25.0 * PI / 180.0;
    let levels = options.size_or(5, 8);
    let mut scene = Scene::new("card_house", "A house of cards, held by friction alone.");
    floor(&mut scene);
    let (half_length, half_thickness) = (0.2, 0.001);
    let card = |x: f32, y: f32, angle: f32| {
        let shape = ShapeDef::new(shapes::rect(half_length, half_thickness)).friction(0.7);
        RigidBody::dynamic().position(Vec2::new(x, y)).angle(angle).shape(shape)
    };
    // Half of the width and of the height of a card that leans.
    let half_width = half_length * sin(LEAN) + half_thickness * cos(LEAN);
    let half_height = half_length * cos(LEAN) + half_thickness * sin(LEAN);
    // Flat cards meet, end to end, over the tip of each tent.
    let pitch = 2.0 * half_length + 0.0005;
    let mut bottom = 0.0;
    for level in 0..levels {
        let tents = levels - level;
        let left = -0.5 * pitch * (tents - 1) as f32;
        for tent in 0..tents {
            let middle = left + pitch * tent as f32;
            scene.body(card(middle - half_width, bottom + half_height, FRAC_PI_2 - LEAN));
            scene.body(card(middle + half_width, bottom + half_height, FRAC_PI_2 + LEAN));
        }
        let top = bottom + 2.0 * half_height;
        for gap in 0..tents - 1 {
            let middle = left + pitch * (gap as f32 + 0.5);
            scene.body(card(middle, top + half_thickness, 0.0));
        }
        bottom = top + 2.0 * half_thickness;
    }
    scene
}

/// Planks joined by hinges between two banks, with crates on them; size is the number of planks.
pub(crate) fn bridge(options: Options) -> Scene {
    let planks = options.size_or(30, 1000);
    let mut scene = Scene::new("bridge", "A bridge of hinged planks carries crates and balls.");
    scene.view = Some((Vec2::new(-16.5, -3.0), Vec2::new(16.5, 8.0)));
    let half = 0.5 * planks as f32;
    let banks = RigidBody::fixed()
        .shape(ShapeDef::new(shapes::rect(5.0, 10.0)).offset(Vec2::new(-half - 5.0, -9.875)))
        .shape(ShapeDef::new(shapes::rect(5.0, 10.0)).offset(Vec2::new(half + 5.0, -9.875)));
    let banks = scene.body(banks);
    let mut last = banks;
    for i in 0..planks {
        let place = Vec2::new(i as f32 + 0.5 - half, 0.0);
        let shape = ShapeDef::new(shapes::rect(0.5, 0.125)).density(2.0);
        let plank = scene.body(RigidBody::dynamic().position(place).damping(0.0, 0.1).shape(shape));
        let anchor = if i == 0 { Vec2::new(-half, 0.0) } else { Vec2::new(0.5, 0.0) };
        scene.joint(last, plank, JointDef::revolute().anchors(anchor, Vec2::new(-0.5, 0.0)));
        last = plank;
    }
    scene.joint(
        last,
        banks,
        JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::new(half, 0.0)),
    );
    for i in 0..planks.min(90) / 3 {
        let x = 3.0 * i as f32 + 1.5 - 0.5 * planks.min(90) as f32;
        let shape = if i % 2 == 0 { shapes::rect(0.4, 0.4) } else { shapes::circle(0.4) };
        scene.body(RigidBody::dynamic().position(Vec2::new(x, 2.0 + 0.5 * i as f32)).shape(shape));
    }
    scene
}

/// Ragdolls that fall down stairs; size is their number.
pub(crate) fn ragdoll(options: Options) -> Scene {
    let count = options.size_or(6, 500);
    let mut scene = Scene::new("ragdoll", "Ragdolls tumble down a flight of stairs.");
    scene.view = Some((Vec2::new(-12.0, -0.4), Vec2::new(0.5, 5.8)));
    let mut stairs = RigidBody::fixed()
        .shape(ShapeDef::new(shapes::rect(40.0, 1.0)).offset(Vec2::new(0.0, -1.0)));
    for step in 0..8 {
        let (height, left) = (0.5 * (8 - step) as f32, -10.0 + 1.2 * step as f32);
        let place = Vec2::new(left, 0.5 * height);
        stairs = stairs.shape(ShapeDef::new(shapes::rect(0.6, 0.5 * height)).offset(place));
    }
    scene.body(stairs);
    for i in 0..count {
        let position = Vec2::new(-10.0 + 0.9 * (i % 6) as f32, 5.0 + 2.5 * i as f32);
        let group = -i32::try_from(i).unwrap_or(0) - 1;
        let first = Human { position, group }.add_to(&mut scene);
        for body in &mut scene.bodies[first..] {
            body.velocity = Vec2::new(2.0, 0.0);
        }
    }
    scene
}

/// A bullet at 400 m/s against a thin wall of planks and a solid one behind; size is the planks' number.
pub(crate) fn bullet_wall(options: Options) -> Scene {
    let planks = options.size_or(8, 100);
    let mut scene = Scene::new("bullet_wall", "A bullet at 400 m/s; the wall behind is 2 cm thin.");
    scene.view = Some((Vec2::new(-3.0, -0.6), Vec2::new(15.0, 9.4)));
    floor(&mut scene);
    scene.body(ground(Vec2::new(12.0, 5.0), 0.01, 5.0));
    for i in 0..planks {
        let place = Vec2::new(4.0, 0.5 + i as f32);
        scene.body(RigidBody::dynamic().position(place).shape(shapes::rect(0.05, 0.5)));
    }
    let shot = ShapeDef::new(shapes::circle(0.1)).density(20.0).restitution(0.3);
    for i in 0..5 {
        let start = Vec2::new(-20.0 - 8.0 * i as f32, 1.5 + i as f32);
        let bullet =
            RigidBody::dynamic().position(start).velocity(Vec2::new(400.0, 0.0)).gravity_scale(0.0);
        scene.body(bullet.bullet().shape(shot.clone()));
    }
    scene
}

/// A heavy ball on a chain of light links knocks a stack down; size is the number of links.
pub(crate) fn wrecking_ball(options: Options) -> Scene {
    let links = options.size_or(20, 200);
    let mut scene =
        Scene::new("wrecking_ball", "A heavy ball on a light chain knocks a pyramid down.");
    let ground_body = floor(&mut scene);
    let hook = Vec2::new(0.0, 1.5 + 0.5 * links as f32);
    // Anchors are in the frame of the ground, whose origin is at (0, -1).
    let (mut last, mut anchor) = (ground_body, hook - Vec2::new(0.0, -1.0));
    // The ball is wider than a link is long: chain and ball must not collide.
    let filter = Filter { group: -1, ..Filter::default() };
    for i in 0..links {
        let place = hook + Vec2::new(-0.5 * i as f32 - 0.25, 0.0);
        let shape =
            Shape::Capsule { a: Vec2::new(-0.2, 0.0), b: Vec2::new(0.2, 0.0), radius: 0.05 };
        let link = ShapeDef::new(shape).filter(filter);
        let link = scene.body(RigidBody::dynamic().position(place).shape(link));
        scene.joint(last, link, JointDef::revolute().anchors(anchor, Vec2::new(0.25, 0.0)));
        (last, anchor) = (link, Vec2::new(-0.25, 0.0));
    }
    let end = hook + Vec2::new(-0.5 * links as f32, 0.0);
    let ball = ShapeDef::new(shapes::circle(1.0)).density(10.0).filter(filter);
    let ball = scene.body(RigidBody::dynamic().position(end).shape(ball));
    scene.joint(last, ball, JointDef::revolute().anchors(anchor, Vec2::ZERO));
    add_pyramid(&mut scene, 8, 1.5, 0.0, |body| body);
    scene
}

/// An arch of wedges without mortar; size is the number of stones.
pub(crate) fn arch(options: Options) -> Scene {
    let stones = options.size_or(15, 99).max(3);
    let mut scene = Scene::new("arch", "An arch of stones stands without mortar.");
    floor(&mut scene);
    let (inner, outer) = (4.0, 5.2);
    for i in 0..stones {
        let angle = |k: u32| PI * k as f32 / stones as f32;
        let (from, to, middle) = (angle(i), angle(i + 1), 0.5 * (angle(i) + angle(i + 1)));
        let around = |radius: f32, a: f32| Vec2::new(radius * cos(a), radius * sin(a));
        let center = around(0.5 * (inner + outer), middle);
        let corners =
            [around(inner, from), around(outer, from), around(outer, to), around(inner, to)];
        let shape = ShapeDef::new(shapes::hull(&corners.map(|c| c - center), 0.0)).friction(0.8);
        scene.body(RigidBody::dynamic().position(center).shape(shape));
    }
    scene
}

/// Balls fall through a field of pegs into bins; size is the number of balls.
pub(crate) fn galton_board(options: Options) -> Scene {
    let count = options.size_or(300, 10_000);
    let mut scene =
        Scene::new("galton_board", "Balls fall through pegs and heap up as a bell curve.");
    scene.view = Some((Vec2::new(-12.4, -0.6), Vec2::new(12.4, 31.0)));
    scene.steps = 1200;
    let mut board = RigidBody::fixed().shape(shapes::rect(12.0, 0.5));
    for row in 0..12 {
        for column in 0..24 {
            let x = column as f32 - 11.5 + if row % 2 == 0 { 0.0 } else { 0.5 };
            let peg =
                ShapeDef::new(shapes::circle(0.1)).offset(Vec2::new(x, 8.0 + 0.9 * row as f32));
            board = board.shape(peg);
        }
    }
    for bin in 0..=24 {
        let place = Vec2::new(bin as f32 - 12.0, 3.5);
        board = board.shape(ShapeDef::new(shapes::rect(0.05, 3.0)).offset(place));
    }
    for side in [-1.0, 1.0] {
        let (a, b) = (Vec2::new(side * 1.0, 20.0), Vec2::new(side * 12.0, 30.0));
        board = board.shape(Shape::Segment { a, b });
        let (a, b) = (Vec2::new(side * 12.0, 0.0), Vec2::new(side * 12.0, 20.0));
        board = board.shape(Shape::Segment { a, b });
    }
    scene.body(board.friction(0.1));
    for i in 0..count {
        let place = Vec2::new(0.45 * ((i % 10) as f32 - 4.5), 26.0 + 0.5 * (i / 10) as f32);
        let ball = ShapeDef::new(shapes::circle(0.2)).friction(0.1).restitution(0.4);
        scene.body(RigidBody::dynamic().position(place).shape(ball));
    }
    scene
}

/// A car whose wheels are driven by motors, over hills; size is the number of hills.
pub(crate) fn car(options: Options) -> Scene {
    let hills = options.size_or(8, 100);
    let mut scene = Scene::new("car", "A car drives over hills.");
    let mut road = RigidBody::fixed();
    let height = |x: f32| if x < 10.0 { 0.0 } else { 0.8 - 0.8 * cos((x - 10.0) * PI / 8.0) };
    let point = |i: u32| Vec2::new(i as f32 - 20.0, height(i as f32 - 20.0));
    for i in 0..30 + 16 * hills {
        road = road.shape(Shape::Segment { a: point(i), b: point(i + 1) });
    }
    scene.body(road.friction(0.9));
    let corners = [(-1.5, -0.4), (1.5, -0.4), (1.5, 0.0), (0.6, 0.6), (-0.9, 0.6), (-1.5, 0.1)];
    let chassis = shapes::hull(&corners.map(|(x, y)| Vec2::new(x, y)), 0.0);
    let start = Vec2::new(-10.0, 1.0);
    let chassis = scene.body(RigidBody::dynamic().position(start).can_sleep(false).shape(chassis));
    for x in [-1.0, 1.0] {
        let axle = Vec2::new(x, -0.5);
        let tyre = ShapeDef::new(shapes::circle(0.45)).friction(1.2);
        let wheel = scene.body(RigidBody::dynamic().position(start + axle).shape(tyre));
        scene.joint(
            chassis,
            wheel,
            JointDef::revolute().anchors(axle, Vec2::ZERO).motor(-12.0, 15.0),
        );
    }
    scene
}

/// Crates of different friction on a slope; size is their number.
pub(crate) fn friction_ramp(options: Options) -> Scene {
    const SLOPE: f32 = 25.0 * PI / 180.0;
    let count = options.size_or(5, 20);
    let mut scene =
        Scene::new("friction_ramp", "Crates of rising friction on a slope: some slide, some stay.");
    scene.view = Some((Vec2::new(-9.0, -1.0), Vec2::new(20.0, 10.5)));
    floor(&mut scene);
    let up = Vec2::new(cos(SLOPE), sin(SLOPE));
    let half_length = 1.5 * count as f32 + 2.0;
    let middle = Vec2::new(up.x, up.y) * half_length;
    let ramp = ShapeDef::new(shapes::rect(half_length, 0.25)).friction(1.0);
    scene.body(RigidBody::fixed().position(middle).angle(SLOPE).shape(ramp));
    for i in 0..count {
        let place = middle + up * (3.0 * (i as f32 - 0.5 * (count - 1) as f32)) + up.perp() * 0.75;
        let mu = 0.1 + 0.15 * i as f32;
        let shape = ShapeDef::new(shapes::rect(0.5, 0.5)).friction(mu * mu);
        scene.body(RigidBody::dynamic().position(place).angle(SLOPE).shape(shape));
    }
    scene
}
