//! Machines that are moved, and what they carry, hit and hold.

use crate::lab::Lab;
use crate::report::Measure;
use crate::scenery::{disk, moving, rect, scene, weightless};
use crate::target::Target;
use tiny_physics::{RigidBody, Shape, Vec2};
use tiny_physics_scenes::Scene;

const DT: f64 = 1.0 / 60.0;
/// Meetings of one kind, each at another part of a step's way.
const PHASES: usize = 40;

/// A count that has to be 0.
fn none(metric: String, count: usize) -> Measure {
    Measure::new(metric, count as f64, "", Target::AtMost(0.0))
}

/// A kinematic body.
fn machine(shape: Shape, position: Vec2) -> RigidBody {
    RigidBody::kinematic().can_sleep(false).position(position).shape(shape)
}

/// Lifts that reach their speed in a second: which lose what stands on them?
pub(super) fn lift(lab: &mut Lab<'_>) -> Vec<Measure> {
    const SPEEDS: [f32; 10] = [2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 80.0, 100.0];
    let (half_width, half_height) = lab.pick((2.0, 0.1), (1.5, 0.15));
    let radii = lab.pick([0.1, 0.25], [0.15, 0.4]);
    let side = lab.pick(0.5, 0.35);
    let mut scene = scene("lift");
    for i in 0..3 * SPEEDS.len() {
        let at = Vec2::new(12.0 * i as f32, 0.0);
        scene.body(machine(rect(half_width, half_height), at));
        let (shape, half) = match i % 3 {
            2 => (rect(side, side), side),
            ball => (disk(radii[ball]), radii[ball]),
        };
        scene.body(moving(shape, at + Vec2::new(0.0, half_height + half)));
    }
    lab.expect_seconds(2.0, scene.dt);
    let mut trial = lab.build(scene);
    for step in 0..120 {
        let progress = (step as f32 / 60.0).min(1.0);
        for (i, speed) in SPEEDS.iter().flat_map(|speed| [speed; 3]).enumerate() {
            trial.set_velocity(2 * i, Vec2::new(0.0, speed * progress));
        }
        lab.step(&mut trial);
    }
    let lost = |load: usize| {
        let lost = |i: &usize| {
            let (lift, load) = (trial.position(2 * i), trial.position(2 * i + 1));
            let held = load.y > lift.y && (load.x - lift.x).abs() < f64::from(half_width) + 0.5;
            !held
        };
        (0..3 * SPEEDS.len()).filter(|i| i % 3 == load).filter(lost).count()
    };
    let names =
        [format!("ball of {} m", radii[0]), format!("ball of {} m", radii[1]), "box".into()];
    let loads = names.into_iter().enumerate();
    loads.map(|(i, name)| none(format!("{name}, lost of 10, 2 to 100 m/s"), lost(i))).collect()
}

/// Walls that come upon resting balls: how many balls do they pass?
pub(super) fn wall_meets_ball(lab: &mut Lab<'_>) -> Vec<Measure> {
    let cases = lab.pick(
        [
            (0.1, 0.1, 10.0),
            (0.1, 0.1, 40.0),
            (0.1, 0.1, 150.0),
            (0.4, 0.25, 20.0),
            (0.4, 0.25, 80.0),
        ],
        [
            (0.06, 0.15, 15.0),
            (0.06, 0.15, 60.0),
            (0.06, 0.15, 120.0),
            (0.3, 0.2, 30.0),
            (0.3, 0.2, 110.0),
        ],
    );
    let mut measures = Vec::new();
    for (thickness, radius, speed) in cases {
        let mut scene = weightless("wall meets ball");
        let from = |gap: f32| -gap - 0.5 * thickness - radius;
        for i in 0..PHASES {
            let y = 10.0 * i as f32;
            let gap = 1.0 + speed * DT as f32 * i as f32 / PHASES as f32;
            let wall = machine(rect(0.5 * thickness, 1.0), Vec2::new(from(gap), y));
            scene.body(wall.velocity(Vec2::new(speed, 0.0)));
            scene.body(moving(disk(radius), Vec2::new(0.0, y)));
        }
        let passed = passed(lab, scene, 0.5);
        let metric =
            format!("wall of {thickness} m, ball of {radius} m, {speed} m/s, passed of 40");
        measures.push(none(metric, passed));
    }
    measures
}

/// Pairs of bodies, the first to the left of the second: in how many are they the other way round after some seconds?
fn passed(lab: &mut Lab<'_>, scene: Scene, seconds: f64) -> usize {
    lab.expect_seconds(seconds, scene.dt);
    let mut trial = lab.build(scene);
    lab.run(&mut trial, seconds, |_| {});
    let is_past = |pair: &usize| !(trial.position(2 * pair).x < trial.position(2 * pair + 1).x);
    (0..trial.len() / 2).filter(is_past).count()
}

/// Bodies that fly at each other: how many pass?
pub(super) fn head_on(lab: &mut Lab<'_>) -> Vec<Measure> {
    let balls = |speed| (format!("balls at {speed} m/s"), disk(0.25), speed);
    let boxes = |speed| (format!("boxes at {speed} m/s"), rect(0.5, 0.5), speed);
    let planks = |speed| (format!("planks at {speed} m/s"), rect(0.1, 1.0), speed);
    let cases = lab.pick(
        [balls(30.0), balls(150.0), boxes(50.0), boxes(150.0), planks(10.0), planks(150.0)],
        [balls(45.0), balls(120.0), boxes(70.0), boxes(130.0), planks(20.0), planks(100.0)],
    );
    let mut measures = Vec::new();
    for (name, shape, speed) in cases {
        let mut scene = weightless("head on");
        for i in 0..PHASES {
            let y = 10.0 * i as f32;
            let apart = 2.0 + 2.0 * speed * DT as f32 * i as f32 / PHASES as f32;
            for side in [-1.0, 1.0] {
                let body = moving(shape.clone(), Vec2::new(0.5 * apart * side, y));
                scene.body(body.velocity(Vec2::new(-speed * side, 0.0)));
            }
        }
        measures.push(none(format!("{name}, passed of 40"), passed(lab, scene, 0.5)));
    }
    measures
}
