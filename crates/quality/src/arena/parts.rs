//! The parts that worlds are drawn from: each a few lines around a place on the ground.

use super::shapes::{rect, shape};
use tiny_physics::{JointDef, RigidBody, Shape, ShapeDef, Vec2};
use tiny_physics_scenes::{Act, Deed, Human, Random, Scene, Script, Timeline, When};

type Part = fn(&mut Random, &mut Scene, Vec2);

/// Every part, with its name.
const PARTS: [(&str, Part); 16] = [
    ("pile", pile),
    ("compounds", compounds),
    ("tower", tower),
    ("pyramid", pyramid),
    ("heavy on light", heavy_on_light),
    ("rope with a weight", rope),
    ("loaded bridge", bridge),
    ("ragdolls", ragdolls),
    ("car", car),
    ("swinging arm", arm),
    ("sliders", sliders),
    ("welded frame", frame),
    ("out of place", out_of_place),
    ("turning paddle", paddle),
    ("lift", lift),
    ("shots", shots),
];

/// Adds a part around a place; its name.
pub(super) fn add(random: &mut Random, scene: &mut Scene, place: Vec2) -> String {
    let (name, part) = PARTS[random.below(PARTS.len() as u32) as usize];
    part(random, scene, place);
    name.into()
}

fn dynamic(shape: impl Into<ShapeDef>, position: Vec2) -> RigidBody {
    RigidBody::dynamic().position(position).shape(shape)
}

/// The same damped, so that what hangs on joints comes to rest in any engine.
fn hung(shape: impl Into<ShapeDef>, position: Vec2) -> RigidBody {
    dynamic(shape, position).damping(0.3, 0.3)
}

fn pile(random: &mut Random, scene: &mut Scene, at: Vec2) {
    let (count, size) = (4 + random.below(20), random.range(0.25, 0.6));
    for i in 0..count {
        let grid = Vec2::new((i % 4) as f32 - 1.5, (i / 4) as f32 + 0.6) * (2.3 * size);
        let body = dynamic(shape(random, size), at + grid);
        scene.body(body.angle(random.range(-0.5, 0.5)));
    }
}

fn compounds(random: &mut Random, scene: &mut Scene, at: Vec2) {
    for i in 0..2 + random.below(6) {
        let (long, thick) = (random.range(0.4, 0.9), random.range(0.08, 0.2));
        let place = at + Vec2::new(random.range(-2.0, 2.0), 1.2 + 2.2 * i as f32);
        let body = RigidBody::dynamic().position(place).angle(random.range(-3.0, 3.0));
        let foot = ShapeDef::new(rect(thick, long)).offset(Vec2::new(long, 0.0));
        let body = body.shape(rect(long, thick)).shape(foot);
        scene.body(if random.coin() {
            body.shape(ShapeDef::new(rect(thick, long)).offset(Vec2::new(-long, 0.0)))
        } else {
            body
        });
    }
}

fn tower(random: &mut Random, scene: &mut Scene, at: Vec2) {
    let half = random.range(0.2, 0.5);
    for i in 0..3 + random.below(12) {
        scene.body(dynamic(rect(half, half), at + Vec2::new(0.0, half * (1 + 2 * i) as f32)));
    }
}

fn pyramid(random: &mut Random, scene: &mut Scene, at: Vec2) {
    let (base, half) = (3 + random.below(5), random.range(0.2, 0.4));
    for row in 0..base {
        for i in row..base {
            let x = half * (2.0 * i as f32 - (base + row) as f32 + 1.0);
            let y = half * (1 + 2 * row) as f32;
            scene.body(dynamic(rect(half, half), at + Vec2::new(x, y)));
        }
    }
}

fn heavy_on_light(random: &mut Random, scene: &mut Scene, at: Vec2) {
    let (count, ratio) = (1 + random.below(3), 10.0_f32.powf(random.range(0.5, 3.0)));
    for i in 0..=count {
        let density = if i == count { ratio } else { 1.0 };
        let body = ShapeDef::new(rect(0.4, 0.4)).density(density);
        scene.body(dynamic(body, at + Vec2::new(0.0, 0.4 + 0.81 * i as f32)));
    }
}

/// A rope of links from a post, let go from the side or hanging, a weight at its end.
fn rope(random: &mut Random, scene: &mut Scene, at: Vec2) {
    let (links, half) = (3 + random.below(14), random.range(0.1, 0.25));
    let level = random.coin();
    let along = if level { Vec2::X } else { -Vec2::Y };
    let top = at + Vec2::new(if level { -2.0 } else { 0.0 }, 3.0 + 2.0 * half * links as f32);
    let mut before = scene.body(RigidBody::fixed().position(top));
    let mut anchor = Vec2::ZERO;
    let (near, far) = (Vec2::new(-half, 0.0), Vec2::new(half, 0.0));
    for i in 0..links {
        let place = top + along * (half * (1 + 2 * i) as f32);
        let link = Shape::Capsule { a: near, b: far, radius: 0.25 * half };
        let angle = if level { 0.0 } else { -core::f32::consts::FRAC_PI_2 };
        let link = scene.body(hung(link, place).angle(angle));
        scene.joint(before, link, JointDef::revolute().anchors(anchor, near));
        (before, anchor) = (link, far);
    }
    let size = random.range(0.2, 0.6);
    let end = top + along * (2.0 * half * links as f32);
    let weight = hung(ShapeDef::new(rect(size, size)), end - Vec2::new(0.0, size));
    let link_mass = half * half * 1.2;
    let weight = scene.body(weight.mass(link_mass * 10.0_f32.powf(random.range(0.0, 2.5))));
    scene.joint(before, weight, JointDef::revolute().anchors(anchor, Vec2::new(0.0, size)));
}

fn bridge(random: &mut Random, scene: &mut Scene, at: Vec2) {
    let (planks, half) = (6 + random.below(14), 0.25);
    let y = 2.0;
    let end = half * planks as f32;
    let posts = scene.body(RigidBody::fixed().position(at));
    let (near, far) = (Vec2::new(-half, 0.0), Vec2::new(half, 0.0));
    let (mut before, mut anchor) = (posts, Vec2::new(-end, y));
    for i in 0..planks {
        let place = at + Vec2::new(half * (1 + 2 * i) as f32 - end, y);
        let plank = scene.body(hung(rect(half, 0.06), place));
        scene.joint(before, plank, JointDef::revolute().anchors(anchor, near));
        (before, anchor) = (plank, far);
    }
    scene.joint(before, posts, JointDef::revolute().anchors(anchor, Vec2::new(end, y)));
    let ratio = 10.0_f32.powf(random.range(0.0, 1.8));
    for i in 0..1 + random.below(5) {
        let place = at + Vec2::new(random.range(-0.5, 0.5) * end, y + 0.6 + 0.9 * i as f32);
        let load = shape(random, 0.4);
        scene.body(dynamic(load, place).mass(0.06 * ratio));
    }
}

fn ragdolls(random: &mut Random, scene: &mut Scene, at: Vec2) {
    for i in 0..1 + random.below(5) {
        let position = at + Vec2::new(random.range(-2.0, 2.0), 0.3 + 2.1 * i as f32);
        let group = -(scene.bodies.len() as i32) - 1;
        Human { position, group }.add_to(scene);
    }
}

fn car(random: &mut Random, scene: &mut Scene, at: Vec2) {
    let at = at + Vec2::new(0.0, 0.1);
    let chassis = scene.body(dynamic(rect(1.2, 0.25), at + Vec2::new(0.0, 0.9)));
    let (hertz, speed) = (random.range(2.0, 8.0), random.range(-15.0, 15.0));
    for side in [-0.8, 0.8] {
        let tyre = ShapeDef::new(Shape::Circle { radius: 0.35 }).friction(0.9);
        let wheel = scene.body(dynamic(tyre, at + Vec2::new(side, 0.35)));
        let joint = JointDef::wheel(Vec2::Y).spring(hertz, 0.7).limits(-0.25, 0.25);
        let joint = joint.anchors(Vec2::new(side, -0.55), Vec2::ZERO);
        scene.joint(chassis, wheel, joint.motor(speed, random.range(0.0, 40.0)));
    }
}

/// Bars on hinges with limits and motors: the strength is drawn up to the silly.
fn arm(random: &mut Random, scene: &mut Scene, at: Vec2) {
    let post = scene.body(RigidBody::fixed().position(at));
    let (mut before, mut anchor) = (post, Vec2::new(0.0, 3.0));
    for i in 0..1 + random.below(3) {
        let half = random.range(0.3, 0.8);
        let start = at + Vec2::new(if i == 0 { 0.0 } else { 1.6 * i as f32 }, 3.0);
        let bar = scene.body(hung(rect(half, 0.08), start + Vec2::new(half, 0.0)));
        let limit = random.range(0.2, 2.0);
        let joint = JointDef::revolute().limits(-limit, limit);
        let joint = match random.below(3) {
            0 => joint,
            1 => joint.spring(random.range(0.5, 10.0), random.range(0.1, 1.0)),
            _ => joint.motor(random.range(-8.0, 8.0), 10.0_f32.powf(random.range(0.0, 6.0))),
        };
        scene.joint(before, bar, joint.anchors(anchor, Vec2::new(-half, 0.0)));
        (before, anchor) = (bar, Vec2::new(half, 0.0));
    }
}

fn sliders(random: &mut Random, scene: &mut Scene, at: Vec2) {
    for i in 0..1 + random.below(4) {
        let foot = at + Vec2::new(1.3 * i as f32 - 2.0, 1.5);
        let post = scene.body(RigidBody::fixed().position(foot));
        let box_ = scene.body(hung(rect(0.4, 0.3), foot));
        let direction = if random.coin() { Vec2::Y } else { Vec2::new(0.6, 0.8) };
        let joint = JointDef::prismatic(direction).limits(-0.8, random.range(0.1, 2.0));
        let joint = match random.below(3) {
            0 => joint,
            1 => joint.spring(random.range(0.5, 8.0), random.range(0.1, 1.0)),
            _ => joint.motor(random.range(-3.0, 3.0), 10.0_f32.powf(random.range(0.0, 4.0))),
        };
        scene.joint(post, box_, joint);
        let load = shape(random, 0.3);
        scene.body(dynamic(load, foot + Vec2::new(0.0, 1.0)));
    }
}

/// Bars welded into a row, dropped, with rods across.
fn frame(random: &mut Random, scene: &mut Scene, at: Vec2) {
    let half = 0.4;
    let count = 2 + random.below(5);
    let mut last = None;
    for i in 0..count {
        let place = at + Vec2::new(half * (1 + 2 * i) as f32 - half * count as f32, 2.0);
        let bar = scene.body(hung(rect(half, 0.1), place));
        if let Some(before) = last {
            let weld = JointDef::weld().anchors(Vec2::new(half, 0.0), Vec2::new(-half, 0.0));
            scene.joint(before, bar, weld);
        }
        last = Some(bar);
    }
    let ball = scene.body(hung(Shape::Circle { radius: 0.3 }, at + Vec2::new(0.0, 3.4)));
    if let Some(end) = last {
        let across =
            (scene.bodies[ball].position.to_vec2() - scene.bodies[end].position.to_vec2()).length();
        scene.joint(ball, end, JointDef::distance(across));
    }
}

/// Joints whose anchors are far from each other at the start.
fn out_of_place(random: &mut Random, scene: &mut Scene, at: Vec2) {
    for i in 0..1 + random.below(4) {
        let place = at + Vec2::new(2.0 * i as f32 - 3.0, 1.5);
        let a = scene.body(hung(rect(0.3, 0.3), place));
        let other = place + Vec2::new(random.range(0.7, 1.2), random.range(-0.5, 0.5));
        let b =
            scene.body(hung(rect(0.3, 0.2), other).mass(10.0_f32.powf(random.range(-1.0, 1.5))));
        let mut off = || Vec2::new(random.range(-0.8, 0.8), random.range(-0.8, 0.8));
        let (anchor_a, anchor_b) = (off(), off());
        let joint = match i % 4 {
            0 => JointDef::revolute(),
            1 => JointDef::prismatic(Vec2::X).limits(-0.3, 0.3),
            2 => JointDef::weld(),
            _ => JointDef::distance(0.3),
        };
        scene.joint(a, b, joint.anchors(anchor_a, anchor_b));
    }
}

fn machine(shape: Shape, position: Vec2) -> RigidBody {
    RigidBody::kinematic().position(position).shape(shape)
}

fn act(scene: &mut Scene, step: u32, body: usize, velocity: Vec2) {
    let deed = Deed::SetVelocity { body, velocity, angular_velocity: 0.0 };
    let act = Act { when: When::At(step), deed };
    match &mut scene.script {
        Some(Script::Timeline(line)) => line.acts.push(act),
        other => *other = Some(Script::Timeline(Timeline { acts: vec![act] })),
    }
}

/// A kinematic bar that turns among things.
fn paddle(random: &mut Random, scene: &mut Scene, at: Vec2) {
    let long = random.range(0.6, 1.6);
    let bar = machine(rect(long, random.range(0.06, 0.2)), at + Vec2::new(0.0, 2.0));
    scene.body(bar.angular_velocity(random.range(-20.0, 20.0)));
    for i in 0..2 + random.below(6) {
        let place = at + Vec2::new(random.range(-1.5, 1.5), 4.2 + 0.9 * i as f32);
        let thing = shape(random, 0.35);
        scene.body(dynamic(thing, place));
    }
}

/// A plate that goes up fast, stands, and comes down, with a load.
fn lift(random: &mut Random, scene: &mut Scene, at: Vec2) {
    let plate = scene.body(machine(rect(1.6, 0.1), at + Vec2::new(0.0, 0.2)));
    let speed = random.range(1.0, 25.0);
    let travel = (5.0 * 60.0 / speed) as u32;
    act(scene, 60, plate, Vec2::new(0.0, speed));
    act(scene, 60 + travel, plate, Vec2::ZERO);
    act(scene, 180 + travel, plate, Vec2::new(0.0, -0.5 * speed));
    act(scene, 180 + 3 * travel, plate, Vec2::ZERO);
    for i in 0..1 + random.below(5) {
        let place = at + Vec2::new(random.range(-0.8, 0.8), 0.9 + 0.9 * i as f32);
        let load = shape(random, 0.4);
        scene.body(dynamic(load, place));
    }
}

/// Small things that are shot at what else there is.
fn shots(random: &mut Random, scene: &mut Scene, at: Vec2) {
    for i in 0..1 + random.below(6) {
        let place = at + Vec2::new(random.range(-1.0, 1.0), 2.0 + i as f32);
        let shot = dynamic(shape(random, 0.25), place).bullet();
        let (side, speed) = (if random.coin() { 1.0 } else { -1.0 }, random.range(15.0, 150.0));
        scene.body(shot.velocity(Vec2::new(side * speed, random.range(-10.0, 10.0))));
    }
    for i in 0..random.below(4) {
        let place = at + Vec2::new(0.0, 0.4 + 0.81 * i as f32);
        scene.body(dynamic(rect(0.4, 0.4), place));
    }
}
