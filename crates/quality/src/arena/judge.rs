//! Plays a world in an engine and measures what any engine can be measured by.

use super::topology::Sides;
use crate::lab::{Lab, MakeSubject, Trial, Variant, greatest};
use serde::{Deserialize, Serialize};
use tiny_physics::{BodyKind, JointKind, Shape, ShapeDef};
use tiny_physics_scenes::{Deed, Scene, Script, When};

/// What came of a world in an engine. Numbers that a world says nothing about are `None`.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Findings {
    /// Bodies whose numbers were none at some time.
    pub not_finite: usize,
    /// Pairs of bodies of which one went into the middle of the other, or through it.
    pub passed: usize,
    /// Deepest overlap on the way, metres.
    pub deepest: f64,
    /// Deepest overlap in the end, metres.
    pub resting_overlap: f64,
    /// Energy gained over that turned over, where nothing from outside adds any.
    pub gain: Option<f64>,
    /// Speed of the fastest body in the last half second, m/s, where everything should come to rest; what rolls only so far
    /// as it slides or hops, and not what hangs: nothing damps a pendulum.
    pub restless: Option<f64>,
    /// Seconds until everything sleeps, where it should, but for what hangs, and for disks: nothing stops one that rolls.
    pub asleep: Option<f64>,
    /// Widest gap of a joint after the first second, metres.
    pub gap: Option<f64>,
    /// Farthest that a joint was beyond its limits after the first second, metres or radians.
    pub overrun: Option<f64>,
    /// CPU time of all steps, milliseconds.
    pub cost: f64,
}

/// One number of the findings beside what another engine has to be ahead by to count.
pub struct Claim {
    /// What was measured.
    pub name: &'static str,
    /// The number.
    pub value: f64,
    /// By so much it may be worse than the best, whatever that is.
    pub slack: f64,
}

impl Findings {
    /// Everything that two engines can be compared by but the cost.
    pub fn claims(&self) -> Vec<Claim> {
        let some =
            |name, value: Option<f64>, slack| value.map(|value| Claim { name, value, slack });
        [
            some("not finite", Some(self.not_finite as f64), 0.0),
            some("passed", Some(self.passed as f64), 0.0),
            some("deepest overlap", Some(self.deepest), 0.02),
            some("resting overlap", Some(self.resting_overlap), 0.01),
            some("energy gained", self.gain, 0.01),
            some("restless", self.restless, 0.05),
            some("asleep", self.asleep, 1.0),
            some("joint gap", self.gap, 0.01),
            some("beyond limits", self.overrun, 0.02),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// What no world should show, whatever others do.
    pub fn broken(&self) -> Option<&'static str> {
        let gained = self.gain.is_some_and(|gain| !(gain <= 0.01));
        match () {
            () if self.not_finite > 0 => Some("not finite"),
            () if self.passed > 0 => Some("passed"),
            () if gained => Some("energy gained"),
            () => None,
        }
    }

    /// In what is it worse than the best of others, by more than a tenth? The worst first.
    pub fn worse_than(&self, others: &[Self]) -> Vec<(&'static str, f64, f64)> {
        let mut worse = Vec::new();
        for claim in self.claims() {
            let theirs =
                others.iter().flat_map(Self::claims).filter(|other| other.name == claim.name);
            let best = theirs.map(|other| other.value).fold(f64::INFINITY, f64::min);
            if !(claim.value <= 1.1 * best + claim.slack) {
                worse.push((claim.name, claim.value, best));
            }
        }
        worse
    }
}

/// Plays a world. `time` tells the CPU time that this process has used, seconds.
pub fn play(scene: &Scene, make: MakeSubject<'_>, time: &dyn Fn() -> f64) -> Findings {
    let mut nothing = |_, _| {};
    let mut lab = Lab::new(make, (Variant::Usual, false), &mut nothing);
    let mut trial = lab.build(scene.clone());
    let mut judge = Judge::new(scene, &trial);
    for step in 0..scene.steps {
        act(scene, &mut trial, step);
        judge.sides.grow(&trial);
        let start = time();
        lab.step(&mut trial);
        judge.found.cost += 1000.0 * (time() - start);
        judge.look(&trial, step);
    }
    judge.finish(&trial)
}

/// Radius of a body that is a disk.
fn disk(trial: &Trial, body: usize) -> Option<f64> {
    match trial.scene().bodies[body].shapes[..] {
        [ShapeDef { shape: Shape::Circle { radius }, .. }] => Some(radius.into()),
        _ => None,
    }
}

/// Speed of a body, that of a disk only so far as it does not roll, m/s.
fn stir(trial: &Trial, body: usize) -> f64 {
    let rolled = disk(trial, body).map(|radius| radius * trial.angular_velocity(body).abs());
    (trial.speed(body) - rolled.unwrap_or(0.0)).max(0.0)
}

/// Bodies that joints join, one after the other, to something fixed, the first of them a joint that lets them swing.
fn hung(scene: &Scene) -> Vec<bool> {
    let mut hung = vec![false; scene.bodies.len()];
    let moves = |body: usize| scene.bodies[body].kind == BodyKind::Dynamic;
    loop {
        let before = hung.clone();
        for joint in &scene.joints {
            let swings = !matches!(joint.def.kind, JointKind::Weld { .. });
            for (on, body) in [(joint.a, joint.b), (joint.b, joint.a)] {
                hung[body] |= moves(body) && (hung[on] || swings && !moves(on));
            }
        }
        if hung == before {
            return hung;
        }
    }
}

/// Does what a timeline asks for before a step.
fn act(scene: &Scene, trial: &mut Trial, step: u32) {
    let Some(Script::Timeline(line)) = &scene.script else { return };
    for act in line.acts.iter().filter(|act| act.when == When::At(step)) {
        match &act.deed {
            Deed::SetVelocity { body, velocity, angular_velocity } => {
                trial.set_velocity(*body, *velocity);
                trial.set_angular_velocity(*body, *angular_velocity);
            }
            Deed::Remove { body } => trial.remove_body(*body),
            Deed::Add { new } => drop(trial.add_body((**new).clone())),
            _ => {}
        }
    }
}

struct Judge {
    found: Findings,
    sides: Sides,
    gain: Option<crate::hard::Gain>,
    rests: bool,
    hung: Vec<bool>,
    steps: u32,
    not_finite: Vec<bool>,
    started_inside: f64,
}

impl Judge {
    fn new(scene: &Scene, trial: &Trial) -> Self {
        let motor = |kind: &JointKind| match kind {
            JointKind::Revolute { motor, .. }
            | JointKind::Distance { motor, .. }
            | JointKind::Prismatic { motor, .. }
            | JointKind::Wheel { motor, .. } => motor.is_some(),
            _ => false,
        };
        let spring = |kind: &JointKind| match kind {
            JointKind::Revolute { spring, .. }
            | JointKind::Distance { spring, .. }
            | JointKind::Prismatic { spring, .. }
            | JointKind::Wheel { spring, .. } => spring.is_some(),
            _ => false,
        };
        let driven = scene.joints.iter().any(|joint| motor(&joint.def.kind));
        let sprung = scene.joints.iter().any(|joint| spring(&joint.def.kind));
        let led = scene.bodies.iter().any(|body| body.kind == BodyKind::Kinematic);
        // Ragdolls' motors only brake, and their springs are soft: they rest.
        let brakes = scene.joints.iter().all(|joint| match joint.def.kind {
            JointKind::Revolute { motor: Some(motor), .. } => motor.speed == 0.0,
            ref kind => !motor(kind),
        });
        let apart = (0..scene.joints.len()).all(|joint| trial.joint_error(joint) < 1e-3);
        let passive = !driven && !sprung && !led && scene.script.is_none() && apart;
        let rests = brakes && !led && scene.gravity.y < 0.0 && scene.script.is_none();
        Self {
            found: Findings::default(),
            sides: Sides::new(trial),
            gain: passive.then(crate::hard::Gain::default),
            rests,
            hung: hung(scene),
            steps: scene.steps,
            not_finite: vec![false; trial.len()],
            started_inside: trial.deepest_overlap(),
        }
    }

    /// What should come to rest.
    fn settling<'a>(&'a self, trial: &'a Trial) -> impl Iterator<Item = usize> + 'a {
        let hangs = |body: usize| self.hung.get(body).is_some_and(|&hangs| hangs);
        trial.dynamic().into_iter().filter(move |&body| !hangs(body))
    }

    /// Does everything sleep that should, but for what rolls?
    fn sleeps(&self, trial: &Trial) -> bool {
        let mut others = self.settling(trial).filter(|&body| disk(trial, body).is_none());
        !others.any(|body| trial.is_awake(body))
    }

    fn look(&mut self, trial: &Trial, step: u32) {
        self.not_finite.resize(trial.len(), false);
        for (body, seen) in self.not_finite.iter_mut().enumerate() {
            let p = trial.position(body);
            *seen |= trial.is_there(body)
                && !(p.x.is_finite() && p.y.is_finite() && trial.speed(body).is_finite());
        }
        if self.not_finite.contains(&true) {
            return;
        }
        self.found.passed = self.sides.look(trial);
        if step.is_multiple_of(2) && self.started_inside < 0.05 {
            self.found.deepest = self.found.deepest.max(trial.deepest_overlap());
        }
        if let Some(gain) = &mut self.gain {
            gain.look(trial);
        }
        if step > 60 && !trial.scene().joints.is_empty() {
            let joints = 0..trial.scene().joints.len();
            let widest = greatest(joints.clone().map(|joint| trial.joint_error(joint)));
            let beyond = greatest(joints.map(|joint| trial.beyond_limits(joint)));
            self.found.gap = Some(self.found.gap.unwrap_or(0.0).max(widest));
            self.found.overrun = Some(self.found.overrun.unwrap_or(0.0).max(beyond));
        }
        if self.rests && self.found.asleep.is_none() && self.sleeps(trial) {
            self.found.asleep = Some(trial.time());
        }
        if self.rests && step + 30 > self.steps {
            let fastest = greatest(self.settling(trial).map(|body| stir(trial, body)));
            self.found.restless = Some(self.found.restless.unwrap_or(0.0).max(fastest));
        }
    }

    fn finish(mut self, trial: &Trial) -> Findings {
        self.found.not_finite = self.not_finite.iter().filter(|&&bad| bad).count();
        if self.found.not_finite > 0 {
            return self.found;
        }
        self.found.resting_overlap = trial.deepest_overlap();
        self.found.gain = self.gain.map(|gain| gain.share());
        if self.rests && self.found.asleep.is_none() {
            self.found.asleep = Some(2.0 * trial.time());
        }
        self.found
    }
}
