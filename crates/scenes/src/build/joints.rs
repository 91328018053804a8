//! Scenes about joints.

use super::{Options, ground};
use crate::scene::Scene;
use crate::shapes;
use core::f32::consts::PI;
use tiny_physics::{Filter, JointDef, JointKind, RigidBody, Rot, Shape, ShapeDef, Spring, Vec2};

/// A body of one shape of density 1.
fn body(x: f32, y: f32, shape: impl Into<ShapeDef>) -> RigidBody {
    RigidBody::dynamic().position(Vec2::new(x, y)).shape(shape)
}

/// Every kind of joint side by side; the size is of no account.
pub(crate) fn joints(_: Options) -> Scene {
    let mut scene = Scene::new("joints", "Every kind of joint, side by side.");
    scene.view = Some((Vec2::new(-16.9, -0.8), Vec2::new(16.9, 13.8)));
    scene.gravity = Vec2::new(0.0, -10.0);
    let base = scene.body(
        ground(Vec2::ZERO, 17.0, 0.5)
            .shape(ShapeDef::new(shapes::rect(17.0, 0.2)).offset(Vec2::new(0.0, 13.0))),
    );
    add_hanging(&mut scene, base);
    add_standing(&mut scene, base);
    scene
}

/// Rod, spring, spring with a range, rope, rope that breaks, pulley, mouse: from the beam.
fn add_hanging(scene: &mut Scene, base: usize) {
    let beam = 12.8;
    let ball = |x: f32, y: f32| body(x, y, shapes::circle(0.4)).can_sleep(false);
    let mut hang = |x: f32, ball: RigidBody, joint: JointDef| {
        let ball = scene.body(ball);
        scene.joint(base, ball, joint.anchors(Vec2::new(x, beam), Vec2::ZERO));
        ball
    };
    hang(-15.0, ball(-13.0, beam - 2.5), JointDef::distance(3.2));
    hang(-11.5, ball(-11.5, beam - 3.6), JointDef::distance(2.2).spring(0.8, 0.02));
    let range = JointDef::distance(2.2).spring(0.8, 0.02).limits(2.0, 2.6);
    hang(-8.5, ball(-8.5, beam - 2.0), range);
    hang(-5.5, ball(-4.0, beam - 1.0), JointDef::rope(3.4));
    let heavy = ShapeDef::new(shapes::rect(0.5, 0.5)).density(30.0);
    hang(-2.0, body(-2.0, beam - 1.0, heavy), JointDef::rope(2.0).break_at(250.0, f32::MAX));

    let (left, right) = (Vec2::new(2.0, beam), Vec2::new(5.0, beam));
    let a = scene.body(body(left.x, beam - 1.2, shapes::rect(0.45, 0.4)));
    let b = scene.body(body(right.x, beam - 4.8, shapes::rect(0.4, 0.4)));
    scene.joint(a, b, JointDef::pulley(left, right, 6.0));

    let pulled = scene.body(body(9.0, 10.0, shapes::rect(0.7, 0.25)));
    let mouse = JointDef::mouse(Vec2::new(11.0, 11.0), 200.0);
    scene.joint(base, pulled, mouse.anchors(Vec2::ZERO, Vec2::new(0.7, 0.0)));
}

/// Hinge with motor and limit, slider, soft weld, wheels, motor, filter, gear: on the ground.
fn add_standing(scene: &mut Scene, base: usize) {
    let end = Vec2::new(-1.2, 0.0);
    let bar = || ShapeDef::new(shapes::rect(1.2, 0.12));
    let barrier = scene.body(body(-14.4, 1.5, bar()));
    let hinge = JointDef::revolute().motor(0.7, 60.0).limits(0.0, 1.2);
    scene.joint(base, barrier, hinge.anchors(Vec2::new(-15.6, 1.5), end));

    let piston = scene.body(body(-10.5, 1.2, shapes::rect(1.0, 0.2)).can_sleep(false));
    let slider = JointDef::prismatic(Vec2::Y).spring(0.5, 0.0).limits(-0.3, 3.0);
    scene.joint(base, piston, slider.anchors(Vec2::new(-10.5, 2.5), Vec2::ZERO));
    scene.body(body(-10.5, 1.9, shapes::circle(0.4)));

    let board = scene.body(body(-6.3, 3.0, bar()));
    let weld = JointDef::weld().spring(2.0, 0.1).anchors(Vec2::new(-7.5, 3.0), end);
    scene.joint(base, board, weld);
    scene.body(body(-5.4, 4.2, shapes::circle(0.4)));

    let cart = scene.body(body(0.5, 1.9, shapes::rect(1.1, 0.25)));
    for x in [-0.8, 0.8] {
        let wheel = scene.body(body(0.5 + x, 1.2, shapes::circle(0.4)));
        let axle = JointDef::wheel(Vec2::Y).spring(3.0, 0.5).limits(-0.2, 0.2).motor(-1.0, 4.0);
        scene.joint(cart, wheel, axle.anchors(Vec2::new(x, -0.7), Vec2::ZERO));
    }

    let drone = scene.body(body(4.0, 1.0, shapes::rect(0.8, 0.15)));
    let mut drive = JointDef::drive();
    if let JointKind::Motor {
        linear_spring, max_spring_force, angular_velocity, max_torque, ..
    } = &mut drive.kind
    {
        *linear_spring = Some(Spring { hertz: 1.0, damping_ratio: 0.7 });
        *max_spring_force = 50.0;
        (*angular_velocity, *max_torque) = (2.0, 10.0);
    }
    scene.joint(base, drone, drive.anchors(Vec2::new(4.0, 4.0), Vec2::ZERO));

    let through = scene.body(body(8.0, 1.2, shapes::rect(0.7, 0.7)));
    let other = scene.body(body(8.6, 3.5, shapes::rect(0.5, 0.5)));
    scene.joint(through, other, JointDef::filter());

    let axle = |x: f32| JointDef::revolute().anchors(Vec2::new(x, 3.0), Vec2::ZERO);
    let large = scene.body(spoked(12.0, 3.0, 1.2));
    let small = scene.body(spoked(13.8, 3.0, 0.6));
    scene.joint(base, large, axle(12.0).motor(1.0, 100.0));
    scene.joint(base, small, axle(13.8));
    scene.joint(large, small, JointDef::gear(0.5));
}

/// A wheel with four spokes; wheels pass through each other.
fn spoked(x: f32, y: f32, radius: f32) -> RigidBody {
    let filter = Filter { group: -1, ..Filter::default() };
    let part = |shape: Shape| ShapeDef::new(shape).filter(filter);
    let spokes = [0.0, 0.25 * PI, 0.5 * PI, 0.75 * PI];
    let wheel = body(x, y, part(shapes::circle(0.8 * radius)));
    spokes.into_iter().fold(wheel, |wheel, angle| {
        wheel.shape(part(shapes::rect(radius, 0.07 * radius.sqrt())).angle(angle))
    })
}

/// A motor turns a train of wheels, the last of which moves a rack; the size is the number of wheels.
pub(crate) fn clockwork(options: Options) -> Scene {
    let count = options.size_or(5, 40).max(2);
    let text = "A motor turns a train of wheels; the last one lifts a stack on a rack.";
    let mut scene = Scene::new("clockwork", text);
    scene.view = Some((Vec2::new(-11.9, -5.4), Vec2::new(8.0, 5.8)));
    scene.gravity = Vec2::new(0.0, -10.0);
    let ceiling = ShapeDef::new(shapes::rect(12.0, 0.2)).offset(Vec2::new(0.0, 11.5));
    let base = scene.body(ground(Vec2::new(0.0, -5.0), 12.0, 0.5).shape(ceiling));
    let anchor = |x: f32, y: f32| Vec2::new(x, y + 5.0);
    let mut x = -10.0;
    let mut last: Option<(usize, f32)> = None;
    for i in 0..count {
        let radius = if i % 2 == 0 { 1.5 } else { 0.8 };
        x += last.map_or(0.0, |(_, before)| before + radius);
        let wheel = scene.body(spoked(x, 0.0, radius).can_sleep(false));
        let axle = JointDef::revolute().anchors(anchor(x, 0.0), Vec2::ZERO);
        let axle = if i == 0 { axle.motor(0.6, 2000.0) } else { axle };
        scene.joint(base, wheel, axle);
        if let Some((before, other)) = last {
            scene.joint(before, wheel, JointDef::gear(radius / other));
        }
        last = Some((wheel, radius));
    }
    let Some((wheel, radius)) = last else { return scene };
    // The rack runs up and down beside the last wheel, as far as the wheel's rim does.
    let x = x + radius;
    let filter = Filter { group: -1, ..Filter::default() };
    let rack = ShapeDef::new(shapes::rect(0.15, 2.0)).filter(filter).offset(Vec2::new(0.15, 0.0));
    let tray = ShapeDef::new(shapes::rect(1.2, 0.15)).offset(Vec2::new(1.2, 2.0));
    let rack = scene.body(body(x, -2.3, rack).shape(tray));
    let rail = JointDef::prismatic(Vec2::Y).limits(-0.1, 3.5).anchors(anchor(x, -2.3), Vec2::ZERO);
    scene.joint(base, rack, rail);
    let (slide_a, slide_b) = (None, Some(Vec2::Y));
    let gear = JointKind::Gear { ratio: -1.0 / radius, slide_a, slide_b };
    scene.joint(wheel, rack, JointDef::new(gear));
    for i in 0..3 {
        scene.body(body(x + 1.3, 0.25 + i as f32 * 0.8, shapes::rect(0.4, 0.4)));
    }
    scene
}

/// Planks with joints that break under load; the size is the number of planks.
pub(crate) fn breaking_bridge(options: Options) -> Scene {
    let planks = options.size_or(20, 500).max(2);
    let mut scene =
        Scene::new("breaking_bridge", "A bridge whose joints break where crates hit too hard.");
    scene.view = Some((Vec2::new(-13.0, -7.9), Vec2::new(13.0, 5.5)));
    scene.gravity = Vec2::new(0.0, -10.0);
    // The planks hang in an arc, each a chord of it: stretched straight, they would bear nothing.
    let (turn, end) = (0.8 / planks as f32, Rot::from_angle(0.4));
    let chord = Rot::from_angle(0.5 * turn);
    let radius = 0.5 / chord.s;
    let half = radius * end.s;
    let bank = |side: f32| {
        ShapeDef::new(shapes::rect(4.0, 4.0)).offset(Vec2::new(side * (half + 4.0), -3.9))
    };
    let floor = ShapeDef::new(shapes::rect(half, 0.5)).offset(Vec2::new(0.0, -7.4));
    let banks = scene.body(RigidBody::fixed().shape(bank(-1.0)).shape(bank(1.0)).shape(floor));
    let mut last = (banks, Vec2::new(-half, 0.0));
    for i in 0..=planks {
        let (next, anchor) = if i < planks {
            let plank = ShapeDef::new(shapes::rect(0.48, 0.1)).density(2.0);
            let angle = (i as f32 + 0.5) * turn - 0.4;
            let middle = Rot::from_angle(angle);
            let (out, low) = (chord.c * middle.s, chord.c * middle.c - end.c);
            let plank = body(radius * out, -radius * low, plank).angle(angle).damping(0.0, 0.5);
            (scene.body(plank), Vec2::new(-0.5, 0.0))
        } else {
            (banks, Vec2::new(half, 0.0))
        };
        // A taut chain pulls at all of its joints alike: of equal ones all would break at once.
        let strength = if i % 4 == 2 { 6000.0 } else { 60_000.0 };
        let joint = JointDef::revolute().anchors(last.1, anchor).break_at(strength, f32::MAX);
        scene.joint(last.0, next, joint);
        last = (next, Vec2::new(0.5, 0.0));
    }
    for i in 0..planks / 2 {
        let x = 2.0 * ((i * 3) % (planks / 2)) as f32 + 1.0 - 0.5 * planks as f32;
        let load = if i % 2 == 0 { shapes::rect(0.45, 0.45) } else { shapes::circle(0.45) };
        scene.body(body(x, 1.0 + 2.0 * i as f32, ShapeDef::new(load).density(4.0)));
    }
    scene
}
