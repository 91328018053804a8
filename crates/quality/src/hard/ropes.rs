//! Ropes, nets and cloth.

use super::common::none;
use super::joints::rms_between;
use crate::lab::Lab;
use crate::report::Measure;
use crate::scenery::{disk, fixed, moving, rect, scene};
use crate::target::Target;
use tiny_physics::{JointDef, RigidBody, Shape, Vec2};
use tiny_physics_scenes::Scene;

/// A rope of links along some points; the first and the last of its bodies.
fn add_rope(scene: &mut Scene, points: &[Vec2], radius: f32, friction: f32) -> (usize, usize) {
    let first = scene.bodies.len();
    for (i, ends) in points.windows(2).enumerate() {
        let (middle, along) = ((ends[0] + ends[1]) * 0.5, ends[1] - ends[0]);
        let half = 0.5 * along.length();
        let (a, b) = (Vec2::new(-half, 0.0), Vec2::new(half, 0.0));
        let link = moving(Shape::Capsule { a, b, radius }, middle).angle(along.y.atan2(along.x));
        let link = scene.body(link);
        if i > 0 {
            let before = 0.5 * (points[i] - points[i - 1]).length();
            let hinge = JointDef::revolute().anchors(Vec2::new(before, 0.0), a);
            scene.joint(
                link - 1,
                link,
                if friction > 0.0 { hinge.motor(0.0, friction) } else { hinge },
            );
        }
    }
    (first, scene.bodies.len() - 1)
}

/// Joins a weight to an end of a link.
fn add_weight(scene: &mut Scene, link: usize, anchor: Vec2, at: Vec2, mass: f32) {
    let weight = scene.body(moving(rect(0.2, 0.2), at).mass(mass));
    let hook = Vec2::new(0.0, 0.2);
    scene.joint(link, weight, JointDef::revolute().anchors(anchor, hook));
}

/// How fast the links of a scene move from 10 to 20 s, and with friction in the hinges.
fn swing(
    lab: &mut Lab<'_>,
    build: impl Fn(f32) -> (Scene, Vec<usize>),
    name: &str,
    allowed: f64,
) -> [Measure; 2] {
    lab.expect_seconds(40.0, 1.0 / 60.0);
    let mut speed = |friction: f32| {
        let (scene, links) = build(friction);
        let mut trial = lab.build(scene);
        1000.0 * rms_between(lab, &mut trial, &links, (10.0, 20.0), |_| {})
    };
    let (free, damped) = (speed(0.0), speed(0.02));
    [
        Measure::new(
            format!("{name}, rms speed, 10 to 20 s"),
            free,
            "mm/s",
            Target::AtMost(allowed),
        ),
        Measure::new(
            format!("{name}, friction in the hinges"),
            damped,
            "mm/s",
            Target::AtMost(5.0),
        ),
    ]
}

/// A chain that lies on a table and hangs over its edge, a weight at its end: does it come to rest?
pub(super) fn over_the_edge(lab: &mut Lab<'_>) -> Vec<Measure> {
    let links = lab.pick(24, 18);
    let cases =
        lab.pick([(1.0, 61.0), (3.0, 22.0), (10.0, 28.0)], [(2.0, 61.0), (5.0, 28.0), (8.0, 28.0)]);
    let radius = lab.pick(0.05, 0.06);
    let build = |mass: f32, friction: f32| {
        let mut scene = scene("over the edge");
        let table = scene.body(fixed(rect(5.0, 1.0), Vec2::new(-5.0, -1.0)));
        let half = links / 2;
        let point = |i: usize| match i {
            i if i <= half => Vec2::new(0.25 * (i as f32 - half as f32), radius),
            i => Vec2::new(radius + 0.01, -0.25 * (i - half) as f32),
        };
        let points: Vec<Vec2> = (0..=links).map(point).collect();
        let (first, last) = add_rope(&mut scene, &points, radius, friction);
        let pin = points[0] - Vec2::new(-5.0, -1.0);
        let start = Vec2::new(-0.125, 0.0);
        scene.joint(table, first, JointDef::revolute().anchors(pin, start));
        let end = points[links];
        add_weight(&mut scene, last, Vec2::new(0.125, 0.0), end - Vec2::new(0.0, 0.2), mass);
        (scene, (first..=last).collect())
    };
    let play = |(mass, allowed): (f32, f64)| {
        swing(lab, |friction| build(mass, friction), &format!("weight of {mass} kg"), allowed)
    };
    cases.into_iter().flat_map(play).collect()
}

/// A rope over a ball that does not move, a weight at each end: does it come to rest?
pub(super) fn over_a_ball(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (links, radius) = lab.pick((20, 1.0_f32), (16, 0.8));
    let cases = lab.pick(
        [(1.0, 275.0), (10.0, 362.0), (50.0, 360.0)],
        [(3.0, 300.0), (20.0, 362.0), (35.0, 360.0)],
    );
    let thickness = 0.05;
    let build = |ratio: f32, friction: f32| {
        let mut scene = scene("over a ball");
        scene.body(fixed(disk(radius), Vec2::ZERO));
        let (around, arc) = (radius + thickness, core::f32::consts::PI * (radius + thickness));
        let length = arc + 2.8;
        let point = |i: usize| {
            let along = length * i as f32 / links as f32 - 1.4;
            let angle = core::f32::consts::PI - along.clamp(0.0, arc) / around;
            let below = along.min(0.0) + (arc - along).min(0.0);
            Vec2::new(around * angle.cos(), around * angle.sin() + below)
        };
        let points: Vec<Vec2> = (0..=links).map(point).collect();
        let (first, last) = add_rope(&mut scene, &points, thickness, friction);
        let half = 0.5 * length / links as f32;
        let mass = ratio * (4.0 * half * thickness + 0.008);
        let hang = Vec2::new(0.0, -0.2);
        add_weight(&mut scene, first, Vec2::new(-half, 0.0), points[0] + hang, mass);
        add_weight(&mut scene, last, Vec2::new(half, 0.0), points[links] + hang, mass);
        (scene, (first..=last).collect())
    };
    let play = |(ratio, allowed): (f32, f64)| {
        let name = format!("weights of {ratio} links");
        swing(lab, |friction| build(ratio, friction), &name, allowed)
    };
    cases.into_iter().flat_map(play).collect()
}

/// A net of balls, hung from its upper corners.
fn net(size: usize, pitch: f32, thread: JointDef) -> Scene {
    let mut scene = scene("net");
    let frame = scene.body(RigidBody::fixed());
    let ball = |i: usize| 1 + i;
    for i in 0..size * size {
        let place = Vec2::new((i % size) as f32, -((i / size) as f32)) * pitch;
        scene.body(moving(disk(0.2 * pitch), place));
        if i % size > 0 {
            scene.joint(ball(i - 1), ball(i), thread);
        }
        if i >= size {
            scene.joint(ball(i - size), ball(i), thread);
        }
    }
    for corner in [0, size - 1] {
        let place = Vec2::new(corner as f32 * pitch, 0.0);
        scene.joint(frame, ball(corner), JointDef::revolute().anchors(place, Vec2::ZERO));
    }
    scene
}

/// Speed of the fastest body of a scene after half a minute.
fn fastest_in_the_end(lab: &mut Lab<'_>, scene: Scene) -> f64 {
    lab.expect_seconds(30.0, scene.dt);
    let mut trial = lab.build(scene);
    lab.run(&mut trial, 29.0, |_| {});
    let mut fastest: f64 = 0.0;
    let bodies = trial.dynamic();
    lab.run(&mut trial, 1.0, |trial| fastest = fastest.max(trial.fastest(&bodies)));
    fastest
}

/// Nets of rods and of ropes that hang from two corners: do they come to rest?
pub(super) fn nets(lab: &mut Lab<'_>) -> Vec<Measure> {
    let pitch = lab.pick(0.5, 0.4);
    let nets = lab.pick([("rods", 5), ("ropes", 30)], [("rods", 7), ("ropes", 20)]);
    let mut measure = |(name, size): (&str, usize)| {
        let thread = if name == "rods" { JointDef::distance(pitch) } else { JointDef::rope(pitch) };
        let speed = fastest_in_the_end(lab, net(size, pitch, thread));
        let metric = format!("net of {size} x {size} {name}, fastest after 30 s");
        Measure::new(metric, speed, "m/s", Target::AtMost(0.01))
    };
    nets.map(&mut measure).into()
}

/// A cloth of springs that hangs from two corners.
pub(super) fn cloth(lab: &mut Lab<'_>) -> Vec<Measure> {
    let (size, hertz) = lab.pick((30, 8.0), (20, 6.0));
    let scene = net(size, 0.3, JointDef::distance(0.3).spring(hertz, 0.3));
    let speed = fastest_in_the_end(lab, scene);
    let metric = format!("{size} x {size} springs of {hertz} Hz, fastest after 30 s");
    vec![Measure::new(metric, speed, "m/s", Target::AtMost(2.5))]
}

/// Sliders and wheels made out of place, at rest: how fast does anything get?
pub(super) fn out_of_place(lab: &mut Lab<'_>) -> Vec<Measure> {
    use tiny_physics_scenes::Random;
    const COUNT: usize = 1500;
    let mut measures = Vec::new();
    for (name, seed) in [("sliders", lab.pick(21, 22)), ("wheels with motors", lab.pick(23, 24))] {
        let mut random = Random::new(seed);
        let mut scene = crate::scenery::weightless("out of place");
        for i in 0..COUNT {
            let at = Vec2::new(20.0 * (i % 40) as f32, 20.0 * (i / 40) as f32);
            let mut part = |x: f32| {
                let shape = rect(random.range(0.1, 1.0), random.range(0.1, 1.0));
                let place = at + Vec2::new(x + random.range(-1.0, 1.0), random.range(-1.0, 1.0));
                moving(shape, place).mass(10.0_f32.powf(random.range(-0.5, 1.0)))
            };
            let (a, b) = (scene.body(part(-1.5)), scene.body(part(1.5).angle(0.4)));
            let angle = random.range(0.0, 6.0);
            let direction = Vec2::new(angle.cos(), angle.sin());
            let mut anchor = || Vec2::new(random.range(-0.7, 0.7), random.range(-0.7, 0.7));
            let (anchor_a, anchor_b) = (anchor(), anchor());
            let joint = if name == "sliders" {
                JointDef::prismatic(direction).limits(-0.5, 0.5)
            } else {
                JointDef::wheel(direction).spring(4.0, 0.7).motor(random.range(-20.0, 20.0), 10.0)
            };
            scene.joint(a, b, joint.anchors(anchor_a, anchor_b));
        }
        lab.expect_seconds(2.0, scene.dt);
        let mut trial = lab.build(scene);
        let mut fastest = vec![0.0_f64; 2 * COUNT];
        lab.run(&mut trial, 2.0, |trial| {
            fastest
                .iter_mut()
                .enumerate()
                .for_each(|(body, most)| *most = most.max(trial.speed(body)));
        });
        let over = fastest.iter().filter(|&&speed| speed > 50.0).count();
        let worst = crate::lab::greatest(fastest.into_iter());
        measures.push(none(format!("{COUNT} {name}, bodies over 50 m/s"), over));
        measures.push(Measure::new(format!("{name}, fastest"), worst, "m/s", Target::AtMost(50.0)));
    }
    measures
}
