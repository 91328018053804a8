//! Joints that carry what only touches them.

use crate::lab::{Lab, Trial, greatest};
use crate::report::Measure;
use crate::scenery::{fixed, moving, rect, scene};
use crate::target::Target;
use tiny_physics::{JointDef, RigidBody, ShapeDef, Vec2};
use tiny_physics_scenes::{Human, Scene};

/// A bridge of planks that hangs straight between two posts, which are the first body; the planks follow.
struct Bridge {
    planks: usize,
    length: f32,
    height: f32,
}

impl Bridge {
    const DENSITY: f32 = 10.0;

    fn plank_mass(&self) -> f32 {
        self.length * self.height * Self::DENSITY
    }

    /// Adds it around x = 0 at y = 0.
    fn add_to(&self, scene: &mut Scene) {
        let ground = scene.body(RigidBody::fixed());
        let end = 0.5 * self.length * self.planks as f32;
        let half = 0.5 * self.length;
        for i in 0..self.planks {
            let shape = ShapeDef::new(rect(half, 0.5 * self.height)).density(Self::DENSITY);
            let x = -end + self.length * (i as f32 + 0.5);
            let plank = scene.body(moving(shape, Vec2::new(x, 0.0)));
            let (before, anchor) = match i {
                0 => (ground, Vec2::new(-end, 0.0)),
                _ => (plank - 1, Vec2::new(half, 0.0)),
            };
            scene.joint(before, plank, JointDef::revolute().anchors(anchor, Vec2::new(-half, 0.0)));
        }
        let ends = JointDef::revolute().anchors(Vec2::new(half, 0.0), Vec2::new(end, 0.0));
        scene.joint(self.planks, ground, ends);
    }
}

/// A crate falls on a straight bridge: does the bridge come to rest, and carry it?
pub(super) fn loaded_bridge(lab: &mut Lab<'_>) -> Vec<Measure> {
    let ratios = lab.pick([1.0, 3.0, 10.0, 30.0, 100.0], [2.0, 5.0, 20.0, 50.0, 80.0]);
    let bridge = lab.pick(
        Bridge { planks: 40, length: 0.5, height: 0.12 },
        Bridge { planks: 30, length: 0.6, height: 0.15 },
    );
    let half = lab.pick(0.4, 0.5);
    lab.expect_seconds(30.0 * ratios.len() as f64, 1.0 / 60.0);
    let mut measures = Vec::new();
    let (mut fallen, mut restless) = (0, 0);
    for ratio in ratios {
        let mut scene = scene("loaded bridge");
        bridge.add_to(&mut scene);
        let above = Vec2::new(0.0, 0.5 * bridge.height + 0.1 + half);
        let load = scene.body(moving(rect(half, half), above).mass(ratio * bridge.plank_mass()));
        lab.may_sleep(&mut scene);
        let mut trial = lab.build(scene);
        let planks: Vec<usize> = (1..=bridge.planks).collect();
        let speed = rms_between(lab, &mut trial, &planks, (10.0, 20.0));
        lab.run(&mut trial, 10.0, |_| {});
        fallen += usize::from(is_below(&trial, load, &planks));
        restless += usize::from(!trial.sleeps());
        let metric = format!("load of {ratio} planks, rms speed, 10 to 20 s");
        measures.push(Measure::new(metric, speed, "m/s", Target::AtMost(0.05)));
    }
    measures.push(Measure::new("loads that fell through", fallen as f64, "", Target::AtMost(0.0)));
    let metric = "not asleep after 30 s";
    measures.push(Measure::new(metric, restless as f64, "", Target::AtMost(0.0)));
    measures
}

/// Root mean square speed of some bodies over a time, which is run through from the start, seconds.
fn rms_between(
    lab: &mut Lab<'_>,
    trial: &mut Trial,
    bodies: &[usize],
    (from, to): (f64, f64),
) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    lab.run(trial, to, |trial| {
        if trial.time() > from {
            (sum, count) = (sum + trial.rms_speed(bodies).powi(2), count + 1.0);
        }
    });
    (sum / count).sqrt()
}

/// Is a load below all of some bodies, or nowhere?
fn is_below(trial: &Trial, load: usize, bodies: &[usize]) -> bool {
    let deepest = -greatest(bodies.iter().map(|&body| -trial.position(body).y));
    !(trial.position(load).y > deepest - 0.5)
}

/// Ragdolls fall into a pit: when do they all sleep?
pub(super) fn ragdoll_pit(lab: &mut Lab<'_>) -> Vec<Measure> {
    const PATIENCE: f64 = 30.0;
    let cases = lab.pick(
        [(5, 6.0), (10, 6.0), (20, 6.0), (40, 6.0)],
        [(7, 10.0), (15, 10.0), (25, 10.0), (35, 10.0)],
    );
    let width = lab.pick(6.0, 7.0);
    lab.expect_seconds(PATIENCE * cases.len() as f64, 1.0 / 60.0);
    let mut measures = Vec::new();
    for (count, seconds) in cases {
        let mut scene = pit(width);
        for i in 0..count {
            let (column, row) = (i % 5, i / 5);
            let x = 0.18 * width * (column as f32 - 2.0) + 0.1 * (row % 2) as f32;
            let position = Vec2::new(x, 0.5 + 2.2 * row as f32);
            Human { position, group: -(i + 1) }.add_to(&mut scene);
        }
        lab.may_sleep(&mut scene);
        let mut trial = lab.build(scene);
        let asleep = seconds_until_asleep(lab, &mut trial, PATIENCE);
        let metric = format!("{count} ragdolls, until all sleep");
        measures.push(Measure::new(metric, asleep, "s", Target::AtMost(seconds)));
    }
    measures
}

/// A floor at y = 0 between two walls.
fn pit(width: f32) -> Scene {
    let mut scene = scene("pit");
    scene.body(fixed(rect(width, 1.0), Vec2::new(0.0, -1.0)));
    for side in [-1.0, 1.0] {
        scene.body(fixed(rect(0.5, 30.0), Vec2::new(side * (0.5 * width + 0.5), 28.0)));
    }
    scene
}

/// Seconds until everything sleeps; twice the patience where it does not.
fn seconds_until_asleep(lab: &mut Lab<'_>, trial: &mut Trial, patience: f64) -> f64 {
    while trial.time() < patience {
        lab.step(trial);
        if trial.sleeps() {
            return trial.time();
        }
    }
    2.0 * patience
}
