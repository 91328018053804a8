//! Every joint against its formula.

use super::*;
use crate::describe::BodyKind;
use crate::dynamics::{Bodies, BodyInfo, JointRecord, Slot};
use crate::math::{DVec2, Rot};
use crate::stages::integrate;
use crate::threads::Team;
use core::f64::consts::TAU;

const G: f32 = 10.0;

/// A world of bodies and joints alone.
struct Rig {
    bodies: Bodies,
    joints: Joints,
    graph: JointGraph,
    gravity: Vec2,
    dt: f32,
    substeps: u32,
    iterations: u32,
    level: SimdLevel,
}

impl Rig {
    fn new() -> Self {
        Self {
            bodies: Bodies::new(),
            joints: Joints::default(),
            graph: JointGraph::new(),
            gravity: Vec2::new(0.0, -G),
            dt: 1.0 / 60.0,
            substeps: 4,
            iterations: 1,
            level: SimdLevel::detect(),
        }
    }

    /// A dynamic body; its centre of mass is its origin.
    fn body(&mut self, x: f64, y: f64, mass: f32, inertia: f32) -> u32 {
        let info =
            BodyInfo { kind: BodyKind::Dynamic, awake: true, mass, inertia, ..BodyInfo::default() };
        let index = self.bodies.insert(info, Pose::new(DVec2::new(x, y), Rot::IDENTITY));
        self.bodies.update_inverse_masses(index);
        self.bodies.push_awake(index);
        index
    }

    /// A box of 1 m and 1 kg.
    fn cube(&mut self, x: f64, y: f64) -> u32 {
        self.body(x, y, 1.0, 1.0 / 6.0)
    }

    fn joint(&mut self, a: u32, b: u32, def: JointDef) -> u32 {
        def.validate().expect("a good joint");
        let index = self.joints.insert(&mut self.bodies, JointRecord::new(a, b, def));
        self.graph.insert(&mut self.bodies, &mut self.joints, index);
        index
    }

    fn inv_h(&self) -> f32 {
        self.substeps as f32 / self.dt
    }

    fn pass(&mut self, pass: Pass) {
        let inv_h = self.inv_h();
        let rows = SharedRows::new(&mut self.bodies.rows);
        for (i, colour) in self.graph.colours.iter_mut().enumerate() {
            for blocks in colour.runs(2) {
                if i == crate::dynamics::JOINT_OVERFLOW {
                    run_in_order(pass, inv_h, rows, blocks);
                } else {
                    run(self.level, pass, inv_h, rows, blocks);
                }
            }
        }
    }

    fn step(&mut self) {
        let h = self.dt / self.substeps as f32;
        integrate::prepare(&Team::alone(), &mut self.bodies, self.gravity, h);
        describe(&mut self.graph, &self.joints, &self.bodies.infos, h);
        for colour in &mut self.graph.colours {
            for blocks in colour.runs(2) {
                prepare(self.level, &self.bodies.poses, h, blocks);
            }
        }
        for _ in 0..self.substeps {
            integrate::velocities(&Team::alone(), &mut self.bodies, true);
            self.pass(Pass::WarmStart);
            for _ in 0..self.iterations {
                self.pass(Pass::Solve);
            }
            integrate::positions(&Team::alone(), &mut self.bodies, h, 400.0);
            for _ in 0..self.iterations {
                self.pass(Pass::Relax);
            }
        }
        self.pass(Pass::Finish);
        for i in 0..self.bodies.rows.len() {
            let (row, pose) = (&mut self.bodies.rows[i], &mut self.bodies.poses[i]);
            let motion = Vec2::new(row[Slot::DX], row[Slot::DY]);
            *pose = Pose::new(pose.p + motion, pose.q.integrate(row[Slot::DA]));
            row[Slot::DX..=Slot::DA].fill(0.0);
        }
    }

    fn run(&mut self, seconds: f32) {
        for _ in 0..(seconds / self.dt).round() as u32 {
            self.step();
        }
    }

    fn position(&self, body: u32) -> DVec2 {
        self.bodies.poses[body as usize].p
    }

    fn angle(&self, body: u32) -> f32 {
        self.bodies.poses[body as usize].q.angle()
    }

    fn load(&self, joint: u32) -> JointLoad {
        load(&self.graph, &self.joints, joint, self.inv_h())
    }

    fn update(&mut self, joint: u32, def: JointDef) {
        self.graph.update(&mut self.bodies, &mut self.joints, joint, &def);
    }

    /// Times and values at which a function of the rig is greatest or least, to second order.
    fn extremes(&mut self, seconds: f32, value: impl Fn(&Self) -> f64) -> Vec<(f64, f64)> {
        let mut found = Vec::new();
        let dt = f64::from(self.dt);
        let mut last = [value(self), f64::NAN, f64::NAN];
        for step in 1..=(seconds / self.dt) as u32 {
            self.step();
            last = [value(self), last[0], last[1]];
            let (rise, fall) = (last[1] - last[2], last[0] - last[1]);
            if rise * fall < 0.0 {
                let shift = 0.5 * (rise + fall) / (rise - fall);
                let time = (f64::from(step) - 1.0 + shift) * dt;
                found.push((time, last[1] + 0.25 * shift * (rise + fall)));
            }
        }
        found
    }
}

/// Mean period and mean logarithmic decrement of a swing about a value.
fn period_and_decrement(extremes: &[(f64, f64)], middle: f64) -> (f64, f64) {
    let (first, last) = (extremes[0], extremes[extremes.len() - 1]);
    let halves = (extremes.len() - 1) as f64;
    let decrement = ((first.1 - middle).abs() / (last.1 - middle).abs()).ln();
    ((last.0 - first.0) / halves * 2.0, decrement / halves * 2.0)
}

fn assert_near(what: &str, value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{what}: {value}, expected {expected} +- {tolerance}"
    );
}

/// Quality rows 15 and 16: a pendulum released at 90 degrees, on a hinge or a rod.
fn pendulum(def: JointDef, inertia: f32, substeps: u32) -> (f64, f64) {
    let mut rig = Rig::new();
    rig.substeps = substeps;
    let bob = rig.body(1.0, 0.0, 1.0, inertia);
    rig.joint(0, bob, def);
    let extremes = rig.extremes(60.0, |rig| {
        let p = rig.position(bob);
        p.x.atan2(-p.y)
    });
    let (period, _) = period_and_decrement(&extremes, 0.0);
    let last = extremes[extremes.len() - 1].1;
    (period, 1.0 - (1.0 - last.abs().cos()))
}

#[test]
fn pendulums_keep_their_period_and_height() {
    let omega = (f64::from(G) / (1.0 + 1.0 / 6.0)).sqrt();
    let rod_omega = f64::from(G).sqrt();
    for substeps in [2, 4, 8] {
        let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-1.0, 0.0));
        let (period, lost) = pendulum(hinge, 1.0 / 6.0, substeps);
        println!(
            "hinge {substeps}: {:+.5} %, lost {lost:.5}",
            (period * omega / 7.416_298_7 - 1.0) * 100.0
        );
        let (period, lost) = pendulum(JointDef::distance(1.0), 1.0 / 6.0, substeps);
        println!(
            "rod {substeps}: {:+.5} %, lost {lost:.5}",
            (period * rod_omega / 7.416_298_7 - 1.0) * 100.0
        );
    }
}

#[test]
fn springs_swing_at_their_frequency_and_decay() {
    for (hertz, zeta) in [(1.0, 0.0), (1.0, 0.1), (2.0, 0.3), (5.0, 0.2), (0.5, 0.7)] {
        for substeps in [1, 4, 8] {
            let spring = |def: JointDef| def.spring(hertz, zeta);
            let angle = |rig: &Rig| f64::from(rig.angle(1));
            let x = |rig: &Rig| rig.position(1).x;
            let axis = Vec2::new(1.0, 0.0);
            let cases: [(&str, JointDef, bool); 5] = [
                ("distance", JointDef::distance(2.0), false),
                ("prismatic", JointDef::prismatic(axis), false),
                ("wheel", JointDef::wheel(axis), false),
                ("weld", JointDef::weld(), false),
                ("revolute", JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-1.0, 0.0)), true),
            ];
            for (name, def, angular) in cases {
                let mut rig = Rig::new();
                rig.gravity = Vec2::ZERO;
                rig.substeps = substeps;
                let at = if name == "distance" {
                    2.0
                } else if angular {
                    1.0
                } else {
                    0.0
                };
                let body = rig.cube(at, 0.0);
                rig.joint(0, body, spring(def));
                if angular {
                    rig.bodies.rows[1][Slot::W] = 0.4;
                    rig.bodies.rows[1][Slot::VY] = 0.4;
                } else {
                    rig.bodies.rows[1][Slot::VX] = 1.0;
                }
                let seconds = (4.2 / hertz).min(if zeta > 0.6 { 1.5 / hertz } else { 100.0 });
                let extremes =
                    if angular { rig.extremes(seconds, angle) } else { rig.extremes(seconds, x) };
                let middle = if name == "distance" { 2.0 } else { 0.0 };
                let (period, decrement) = period_and_decrement(&extremes, middle);
                let root = f64::from(1.0 - zeta * zeta).sqrt();
                let expected = 1.0 / (f64::from(hertz) * root);
                let expected_decrement = TAU * f64::from(zeta) / root;
                println!(
                    "{name} {hertz} {zeta} {substeps}: period {:+.4} %, decrement {decrement:.5} {expected_decrement:.5}",
                    (period / expected - 1.0) * 100.0
                );
            }
        }
    }
}

#[test]
fn chain() {
    for ratio in [1.0, 100.0, 1000.0] {
        for (substeps, iterations) in [(4, 1), (8, 1), (4, 4)] {
            let mut rig = Rig::new();
            rig.substeps = substeps;
            rig.iterations = iterations;
            let mut last = 0;
            for i in 0..30 {
                let link = rig.body(f64::from(i) + 0.5, 0.0, 1.0, 1.0 / 12.0);
                let a = if last == 0 { Vec2::ZERO } else { Vec2::new(0.5, 0.0) };
                rig.joint(last, link, JointDef::revolute().anchors(a, Vec2::new(-0.5, 0.0)));
                last = link;
            }
            let ball = rig.body(31.0, 0.0, ratio, 0.5 * ratio);
            rig.joint(
                last,
                ball,
                JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::new(-1.0, 0.0)),
            );
            let mut worst = 0.0_f64;
            for _ in 0..600 {
                rig.step();
                let p = rig.position(ball);
                worst = worst.max(p.x.hypot(p.y) / 31.0 - 1.0);
            }
            println!("chain {ratio} {substeps}x{iterations}: {:.3} %", worst * 100.0);
        }
    }
}
