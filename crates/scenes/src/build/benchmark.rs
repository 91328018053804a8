//! The scenes that Box2D publishes its own benchmark on, with the same numbers, so that every engine can
//! be measured on the same world.

use super::{Options, add_pyramid, box2d_scene, crate_at, ground};
use crate::random::Lcg;
use crate::scene::Scene;
use crate::script::{Queries, Rain, Script, Terrain, WakeSleepers};
use crate::shapes;
use tiny_physics::{ChainDef, Filter, JointDef, RigidBody, Rot, Shape, ShapeDef, Vec2};

/// A net of circles, held by a few of them, that collide with nothing.
pub(crate) fn joint_grid(options: Options) -> Scene {
    let size = options.size_or(100, 1000);
    let mut scene = box2d_scene("joint_grid", "A net of hinges hangs from a few fixed knots.", 500);
    scene.settings.sleep = false;
    let held = size.saturating_sub(6) / 2..=(size + 6) / 2;
    for k in 0..size {
        for i in 0..size {
            let fixed = i == 0 && held.contains(&k);
            let body = scene.body(knot(k, i, fixed));
            if i > 0 {
                scene.joint(body - 1, body, hinge(Vec2::new(0.0, -0.5), Vec2::new(0.0, 0.5)));
            }
            if k > 0 {
                scene.joint(
                    body - size as usize,
                    body,
                    hinge(Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0)),
                );
            }
        }
    }
    scene
}

fn knot(k: u32, i: u32, fixed: bool) -> RigidBody {
    let filter = Filter { category: 2, mask: 0xFFFF_FFFD, group: 0 };
    let body = if fixed { RigidBody::fixed() } else { RigidBody::dynamic() };
    body.position(Vec2::new(k as f32, -(i as f32)))
        .shape(ShapeDef::new(shapes::circle(0.4)).filter(filter))
}

fn hinge(anchor_a: Vec2, anchor_b: Vec2) -> JointDef {
    JointDef::revolute().anchors(anchor_a, anchor_b)
}

/// One pyramid of 100 rows.
pub(crate) fn large_pyramid(options: Options) -> Scene {
    let base = options.size_or(100, 1000);
    let mut scene = box2d_scene("large_pyramid", "A pyramid of crates, 100 rows high.", 500);
    scene.settings.sleep = false;
    scene.body(ground(Vec2::new(0.0, -1.0), base.max(100) as f32, 1.0));
    add_pyramid(&mut scene, base, -0.5 * base as f32, 0.0, |body| body);
    scene
}

/// 400 pyramids of 10 rows on 20 floors.
pub(crate) fn many_pyramids(options: Options) -> Scene {
    let rows = options.size_or(20, 100);
    let mut scene = box2d_scene("many_pyramids", "20 floors with 20 small pyramids each.", 200);
    scene.settings.sleep = false;
    let half = 5.5 * rows as f32;
    let mut floors = RigidBody::fixed();
    for row in 0..rows {
        let y = 11.0 * row as f32;
        floors = floors.shape(Shape::Segment { a: Vec2::new(-half, y), b: Vec2::new(half, y) });
    }
    scene.body(floors);
    for row in 0..rows {
        for column in 0..rows {
            let left = -half + 11.0 * column as f32 + 0.5;
            add_pyramid(&mut scene, 10, left, 11.0 * row as f32, |body| body);
        }
    }
    scene
}

/// Ragdolls that rain on five beds of tiles; size is the number of columns.
pub(crate) fn rain(options: Options) -> Scene {
    let columns = options.size_or(40, 1000);
    let mut scene =
        box2d_scene("rain", "A thousand ragdolls rain on five floors and are recycled.", 1000);
    let mut floors = RigidBody::fixed();
    let script = Rain { columns, ..Rain::default() };
    for row in 0..script.rows {
        for k in 0..=500 {
            let place = Vec2::new(-125.0 + 0.5 * k as f32, script.row_height * row as f32);
            floors = floors.shape(ShapeDef::new(shapes::rect(0.25, 0.25)).offset(place));
        }
    }
    scene.body(floors);
    scene.script = Some(Script::Rain(script));
    scene
}

/// A heavy box flies into a sleeping wall of 120 by 80 boxes; size is the number of columns.
pub(crate) fn smash(options: Options) -> Scene {
    let columns = options.size_or(120, 1000);
    let mut scene =
        box2d_scene("smash", "A heavy box flies into a wall of sleeping boxes; no gravity.", 300);
    scene.gravity = Vec2::ZERO;
    let hammer = ShapeDef::new(shapes::rect(4.0, 4.0)).density(8.0);
    let start = Vec2::new(-20.0, 0.0);
    scene.body(RigidBody::dynamic().position(start).velocity(Vec2::new(40.0, 0.0)).shape(hammer));
    for i in 0..columns {
        for j in 0..80 {
            let place = Vec2::new(0.4 * i as f32 + 30.0, 0.4 * (j as f32 - 40.0));
            scene.body(RigidBody::dynamic().position(place).shape(shapes::rect(0.2, 0.2)).asleep());
        }
    }
    scene
}

/// A rotor stirs 6076 small bodies in a round drum; size is the number of bodies.
pub(crate) fn spinner(options: Options) -> Scene {
    let count = options.size_or(6076, 100_000);
    let mut scene =
        box2d_scene("spinner", "A long rotor stirs thousands of small bodies in a ring.", 500);
    let ring = scene.body(ring());
    let blade = ShapeDef::new(shapes::rounded_rect(0.4, 20.0, 0.2)).friction(0.0);
    let hub = Vec2::new(0.0, 12.0);
    let rotor = scene.body(RigidBody::dynamic().position(hub).shape(blade).can_sleep(false));
    scene.joint(ring, rotor, hinge(hub, Vec2::ZERO).motor(5.0, f32::MAX));
    let mut place = Vec2::new(-23.0, 2.0);
    for i in 0..count {
        scene.body(stirred(i, place));
        place.x += 0.5;
        if place.x >= 23.0 {
            place = Vec2::new(-23.0, place.y + 0.5);
        }
    }
    scene
}

/// 360 segments around (0, 32), clockwise. The turn is a little more than a degree, so the ring overlaps
/// itself by five degrees, as in the original; one closed chain, solid from inside.
fn ring() -> RigidBody {
    let turn = Rot { c: 0.999_842_35, s: -0.017_757_336 };
    let mut point = Vec2::new(40.0, 0.0);
    let mut points = Vec::with_capacity(360);
    for _ in 0..360 {
        points.push(point + Vec2::new(0.0, 32.0));
        point = turn.rotate(point);
    }
    let chain = ChainDef::closed(&points).friction(0.1);
    RigidBody::fixed().chain(&chain).expect("the points of the ring are apart")
}

fn stirred(i: u32, place: Vec2) -> RigidBody {
    let shape = match i % 3 {
        0 => Shape::Capsule { a: Vec2::new(-0.25, 0.0), b: Vec2::new(0.25, 0.0), radius: 0.25 },
        1 => shapes::circle(0.35),
        _ => shapes::rect(0.35, 0.35),
    };
    let def = ShapeDef::new(shape).friction(0.1).restitution(0.1).density(0.25);
    RigidBody::dynamic().position(place).shape(def)
}

/// 45 by 45 small boxes in a drum that a motor turns; size is the number of boxes a side.
pub(crate) fn tumbler(options: Options) -> Scene {
    let side = options.size_or(45, 1000);
    let mut scene =
        box2d_scene("tumbler", "A square drum turns and tumbles two thousand boxes.", 750);
    let frame = scene.body(RigidBody::fixed());
    let hub = Vec2::new(0.0, 10.0);
    let mut drum = RigidBody::dynamic().position(hub);
    let walls = [
        (10.0, 0.0, 0.5, 10.0),
        (-10.0, 0.0, 0.5, 10.0),
        (0.0, 10.0, 10.0, 0.5),
        (0.0, -10.0, 10.0, 0.5),
    ];
    for (x, y, hx, hy) in walls {
        drum =
            drum.shape(ShapeDef::new(shapes::rect(hx, hy)).offset(Vec2::new(x, y)).density(50.0));
    }
    let drum = scene.body(drum);
    let speed = 25.0 * core::f32::consts::PI / 180.0;
    scene.joint(frame, drum, hinge(hub, Vec2::ZERO).motor(speed, 1.0e8));
    for i in 0..side {
        for j in 0..side {
            let place = Vec2::new(-9.0 + 0.4 * j as f32, 1.0 + 0.4 * i as f32);
            scene.body(RigidBody::dynamic().position(place).shape(shapes::rect(0.125, 0.125)));
        }
    }
    scene
}

/// Ten pyramids that fall asleep and are woken; size is the rows of each.
pub(crate) fn sleep(options: Options) -> Scene {
    let base = options.size_or(60, 60);
    let mut scene = box2d_scene("sleep", "Ten pyramids fall asleep and are woken one by one.", 500);
    scene.body(ground(Vec2::new(0.0, -1.0), 348.0, 1.0));
    let mut corners = Vec::new();
    for p in 0..10 {
        corners.push(scene.bodies.len());
        let left = -288.0 + 64.0 * p as f32 - 0.5 * base as f32;
        add_pyramid(&mut scene, base, left, 0.0, |mut body| {
            body.sleep_speed = 1.0;
            body
        });
    }
    scene.script = Some(Script::WakeSleepers(WakeSleepers { bodies: corners }));
    scene
}

/// Thousands of static boxes, a small pile with a paddle, and many queries a step; size is the cells a
/// side.
pub(crate) fn queries(options: Options) -> Scene {
    let cells = options.size_or(500, 2000);
    let mut scene = box2d_scene(
        "queries",
        "Thousands of rays, casts and overlaps through a field of boxes.",
        100,
    );
    let mut random = Lcg(1234);
    for i in 0..cells {
        for j in 0..cells {
            if let Some(body) = field_box(&mut random, i as f32, j as f32) {
                scene.body(body);
            }
        }
    }
    let paddle = add_paddled_pile(&mut scene);
    let size = cells as f32;
    let script = Queries {
        paddle,
        left: 195.0,
        right: 230.0,
        speed: 5.0,
        count: 1000,
        seed: random.0,
        size,
    };
    scene.script = Some(Script::Queries(script));
    scene
}

/// One cell of the field: the numbers are drawn whether or not there is a box.
fn field_box(random: &mut Lcg, column: f32, row: f32) -> Option<RigidBody> {
    let fill = random.range(0.0, 1.0);
    let ratio = random.range(1.0, 5.0);
    let half = random.range(0.05, 0.25);
    let upright = random.range(0.0, 1.0) > 0.5;
    let category = 1 << random.range(0.0, 2.999) as u32;
    let center = Vec2::new(column + 0.5, row + 0.5);
    let clear = (190.0..=250.0).contains(&center.x) && (140.0..=210.0).contains(&center.y);
    if fill > 0.1 || clear {
        return None;
    }
    let (hx, hy) = if upright { (half, ratio * half) } else { (ratio * half, half) };
    let filter = Filter { category, ..Filter::default() };
    Some(
        RigidBody::fixed()
            .position(center)
            .shape(ShapeDef::new(shapes::rect(hx, hy)).filter(filter)),
    )
}

/// A pile in the clear part of the field; the index of its paddle.
fn add_paddled_pile(scene: &mut Scene) -> usize {
    let (a, b) = (Vec2::new(190.0, 150.0), Vec2::new(250.0, 150.0));
    let mut floor = RigidBody::fixed().shape(Shape::Segment { a, b });
    for i in 0..8 {
        let place = Vec2::new(200.0 + 4.0 * i as f32, 152.0);
        floor = floor.shape(ShapeDef::new(shapes::rect(2.0, 2.0)).offset(place).sensor());
    }
    scene.body(floor);
    for row in 0..50 {
        for column in 0..40 {
            let place = Vec2::new(200.0 + 0.55 * column as f32, 151.0 + 0.55 * row as f32);
            scene.body(RigidBody::dynamic().position(place).shape(shapes::rect(0.25, 0.25)));
        }
    }
    let start = Vec2::new(195.0, 151.2);
    let paddle = RigidBody::kinematic().position(start).velocity(Vec2::new(5.0, 0.0));
    scene.body(paddle.shape(shapes::rect(1.0, 1.0)))
}

/// A long ground of tile columns that moves on under small stacks; size is the number of pieces.
pub(crate) fn tile_world(options: Options) -> Scene {
    let bodies = options.size_or(2400, 10_000);
    let terrain = Terrain { bodies, ..Terrain::default() };
    let mut scene =
        box2d_scene("tile_world", "Ground is loaded on the right and unloaded on the left.", 500);
    for piece in 0..bodies {
        scene.body(terrain.piece(piece));
    }
    let cycles = bodies / 4;
    for cycle in (120..cycles).step_by(12) {
        let left = (0.5 + cycle as f32) * 40.0 + terrain.left as f32 - 3.0;
        for i in 0..10 {
            for j in 0..5 {
                let mut body = crate_at(left + 0.6 * i as f32, 10.0 + 0.5 * j as f32);
                body.shapes[0].shape = shapes::rect(0.3, 0.2);
                scene.body(body);
            }
        }
    }
    scene.script = Some(Script::Terrain(terrain));
    scene
}
