//! Joints that carry what only touches them.

use super::common::{none, pit, seconds_until_asleep};
use crate::lab::{Lab, Trial, greatest};
use crate::report::Measure;
use crate::scenery::{moving, rect, scene};
use crate::target::Target;
use tiny_physics::{JointDef, RigidBody, Vec2};
use tiny_physics_scenes::{Human, Scene};

/// A bridge of planks between two posts, which are the first body of its scene; the planks follow.
struct Bridge {
    planks: usize,
    length: f32,
    height: f32,
    /// Distance of the posts over the length of all planks.
    span: f32,
}

impl Bridge {
    fn plank_mass(&self) -> f32 {
        self.length * self.height
    }

    /// A scene with it around x = 0, its ends at y = 0.
    fn scene(&self, name: &str) -> Scene {
        let mut scene = scene(name);
        let posts = scene.body(RigidBody::fixed());
        let (turn, half) = (self.turn(), 0.5 * self.length);
        let end = half * self.span * self.planks as f32;
        let mut place = Vec2::new(-end, 0.0);
        let (mut before, mut anchor) = (posts, place);
        for i in 0..self.planks {
            let angle = turn * self.share(i);
            let along = Vec2::new(angle.cos(), angle.sin());
            let shape = rect(half, 0.5 * self.height);
            let plank = scene.body(moving(shape, place + along * half).angle(angle));
            let hinge = JointDef::revolute().anchors(anchor, Vec2::new(-half, 0.0));
            scene.joint(before, plank, hinge);
            (before, anchor) = (plank, Vec2::new(half, 0.0));
            place += along * self.length;
        }
        scene.joint(before, posts, JointDef::revolute().anchors(anchor, Vec2::new(end, 0.0)));
        scene
    }

    /// Where a plank is from the first, -1, to the last, 1.
    fn share(&self, plank: usize) -> f32 {
        (2 * plank + 1) as f32 / self.planks as f32 - 1.0
    }

    /// Angle of the last plank: they hang in an arc that reaches from post to post.
    fn turn(&self) -> f32 {
        let (mut low, mut high) = (0.0, 1.5_f32);
        for _ in 0..40 {
            let turn = 0.5 * (low + high);
            let reach: f32 = (0..self.planks).map(|i| (turn * self.share(i)).cos()).sum();
            if reach > self.span * self.planks as f32 { low = turn } else { high = turn }
        }
        if self.span < 1.0 { low } else { 0.0 }
    }

    /// Height of the middle's upper side.
    fn middle(&self) -> f32 {
        let below: f32 = (0..self.planks / 2).map(|i| (self.turn() * self.share(i)).sin()).sum();
        below * self.length + 0.5 * self.height
    }
}

/// A crate falls on a straight bridge: does the bridge come to rest, and carry it?
pub(super) fn loaded_bridge(lab: &mut Lab<'_>) -> Vec<Measure> {
    let bridge = lab.pick(
        Bridge { planks: 40, length: 0.5, height: 0.12, span: 1.0 },
        Bridge { planks: 30, length: 0.6, height: 0.15, span: 1.0 },
    );
    let loads = lab.pick([1.0, 3.0, 10.0, 30.0, 100.0], [2.0, 5.0, 20.0, 50.0, 80.0]);
    let half = lab.pick(0.4, 0.5);
    load_bridge(lab, &bridge, half, &loads.map(|load| (load, 0.05)), true)
}

/// The same on a bridge with slack, which swings for long: 256 substeps move as fast as the targets say.
pub(super) fn slack_bridge(lab: &mut Lab<'_>) -> Vec<Measure> {
    let bridge = lab.pick(
        Bridge { planks: 40, length: 0.5, height: 0.12, span: 0.95 },
        Bridge { planks: 30, length: 0.6, height: 0.15, span: 0.93 },
    );
    let loads = lab.pick(
        [(1.0, 2.2), (3.0, 0.8), (10.0, 0.8), (30.0, 0.7), (100.0, 1.1)],
        [(2.0, 2.2), (5.0, 0.8), (20.0, 0.8), (50.0, 0.7), (80.0, 1.1)],
    );
    let half = lab.pick(0.4, 0.5);
    load_bridge(lab, &bridge, half, &loads, false)
}

/// Drops a crate of so many planks' mass on a bridge, for each load; beside the load stands the speed that is allowed.
fn load_bridge(
    lab: &mut Lab<'_>,
    bridge: &Bridge,
    half: f32,
    loads: &[(f32, f64)],
    rests: bool,
) -> Vec<Measure> {
    lab.expect_seconds(30.0 * loads.len() as f64, 1.0 / 60.0);
    let mut measures = Vec::new();
    let (mut fallen, mut restless, mut gain) = (0, 0, 0.0_f64);
    for &(ratio, allowed) in loads {
        let mut scene = bridge.scene("loaded bridge");
        let above = Vec2::new(0.0, bridge.middle() + 0.1 + half);
        let load = scene.body(moving(rect(half, half), above).mass(ratio * bridge.plank_mass()));
        lab.may_sleep(&mut scene);
        let mut trial = lab.build(scene);
        let planks: Vec<usize> = (1..=bridge.planks).collect();
        let mut energy = Gain::default();
        let speed = rms_between(lab, &mut trial, &planks, (10.0, 20.0), |trial| energy.look(trial));
        lab.run(&mut trial, 10.0, |trial| energy.look(trial));
        gain = greatest([gain, energy.share()].into_iter());
        fallen += usize::from(is_below(&trial, load, &planks));
        restless += usize::from(!trial.sleeps());
        let metric = format!("load of {ratio} planks, rms speed, 10 to 20 s");
        measures.push(Measure::new(metric, speed, "m/s", Target::AtMost(allowed)));
    }
    measures.push(none("loads that fell through".into(), fallen));
    let metric = "energy gained, of that turned over";
    measures.push(Measure::new(metric, 100.0 * gain, "%", Target::AtMost(1.0)));
    if rests {
        measures.push(none("not asleep after 30 s".into(), restless));
    }
    measures
}

/// Crates heaped on a bridge with slack: how many fall through?
pub(super) fn crates_on_a_bridge(lab: &mut Lab<'_>) -> Vec<Measure> {
    let bridge = lab.pick(
        Bridge { planks: 40, length: 0.5, height: 0.12, span: 0.95 },
        Bridge { planks: 30, length: 0.6, height: 0.15, span: 0.93 },
    );
    let mut measures = Vec::new();
    for mass in lab.pick([1.0, 5.0], [2.0, 3.0]) {
        let mut scene = bridge.scene("crates on a bridge");
        let first = scene.bodies.len();
        for i in 0..20 {
            let place = Vec2::new(0.6 * ((i % 10) as f32 - 4.5), 0.5 + 0.6 * (i / 10) as f32);
            scene.body(moving(rect(0.2, 0.2), place).mass(mass));
        }
        lab.expect_seconds(20.0, scene.dt);
        let mut trial = lab.build(scene);
        lab.run(&mut trial, 20.0, |_| {});
        let planks: Vec<usize> = (1..=bridge.planks).collect();
        let fallen = (first..first + 20).filter(|&load| is_below(&trial, load, &planks)).count();
        measures.push(none(format!("crates of {mass} kg, fell through of 20"), fallen));
    }
    measures
}

/// By how much the energy of a world has risen above that at the start. (Above the lowest since would be stricter, but
/// what is soft in a solver stores energy and gives it back.)
#[derive(Default)]
pub(crate) struct Gain {
    /// At the start, lowest and highest so far, joules.
    seen: Option<[f64; 3]>,
    /// What lifts everything by a tenth of a metre, or moves it at a centimetre a second where nothing falls, joules.
    lift: f64,
}

impl Gain {
    pub(crate) fn look(&mut self, trial: &Trial) {
        let energy = trial.least_energy();
        let energy = if energy.is_nan() { f64::INFINITY } else { energy };
        if self.seen.is_none() {
            let mass: f64 = trial.dynamic().into_iter().map(|body| trial.mass(body)).sum();
            let gravity = f64::from(trial.scene().gravity.length());
            self.lift = mass * (0.1 * gravity + 0.5 * 0.01_f64.powi(2));
        }
        let [start, low, high] = self.seen.unwrap_or([energy; 3]);
        self.seen = Some([start, low.min(energy), high.max(energy)]);
    }

    /// The rise over all that was turned over, or over [`Gain::lift`] where that is more;
    /// infinite where there was no number.
    pub(crate) fn share(&self) -> f64 {
        let [start, low, high] = self.seen.unwrap_or_default();
        let share = if high > start { (high - start) / (high - low).max(self.lift) } else { 0.0 };
        if share.is_nan() { f64::INFINITY } else { share }
    }
}

/// Root mean square speed of some bodies over a time, which is run through from the start, seconds.
pub(super) fn rms_between(
    lab: &mut Lab<'_>,
    trial: &mut Trial,
    bodies: &[usize],
    (from, to): (f64, f64),
    mut look: impl FnMut(&Trial),
) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    lab.run(trial, to, |trial| {
        look(trial);
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
