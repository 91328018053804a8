//! What the tests of joints stand on: a world of bodies and joints alone, and how swings are measured.

use super::*;

/// Gravity, metres a second squared.
pub(super) const G: f32 = 10.0;

/// A world of bodies and joints alone.
pub(super) struct Rig {
    pub(super) bodies: Bodies,
    pub(super) joints: Joints,
    pub(super) graph: JointGraph,
    pub(super) gravity: Vec2,
    pub(super) dt: f32,
    pub(super) substeps: u32,
    pub(super) iterations: u32,
    pub(super) level: SimdLevel,
}

impl Rig {
    pub(super) fn new() -> Self {
        Self {
            bodies: Bodies::default(),
            joints: Joints::default(),
            graph: JointGraph::default(),
            gravity: Vec2::new(0.0, -G),
            dt: 1.0 / 60.0,
            substeps: 4,
            iterations: 1,
            level: SimdLevel::detect(),
        }
    }

    /// A dynamic body; its centre of mass is its origin.
    pub(super) fn body(&mut self, x: f64, y: f64, mass: f32, inertia: f32) -> u32 {
        let info =
            BodyInfo { kind: BodyKind::Dynamic, awake: true, mass, inertia, ..BodyInfo::default() };
        let index = self.bodies.insert(info, Pose::new(DVec2::new(x, y), Rot::IDENTITY));
        self.bodies.update_inverse_masses(index);
        self.bodies.push_awake(index);
        index
    }

    /// A box of 1 m and 1 kg.
    pub(super) fn cube(&mut self, x: f64, y: f64) -> u32 {
        self.body(x, y, 1.0, 1.0 / 6.0)
    }

    pub(super) fn joint(&mut self, a: u32, b: u32, def: JointDef) -> u32 {
        def.validate().expect("a good joint");
        let index = self.joints.insert(&mut self.bodies, JointRecord::new(a, b, def));
        self.graph.insert(&mut self.bodies, &mut self.joints, index);
        index
    }

    pub(super) fn inv_h(&self) -> f32 {
        self.substeps as f32 / self.dt
    }

    pub(super) fn pass(&mut self, pass: Pass) {
        let substep = Substep::new(1.0 / self.inv_h(), 1.0, false);
        let rows = SharedRows::new(&mut self.bodies.rows);
        let places: Vec<usize> = self.graph.colours.keys().collect();
        for (place, colour) in places.into_iter().zip(self.graph.colours.list_mut()) {
            colour.for_each_run(&Team::alone(), |blocks, count| {
                if crate::dynamics::is_overflow(place) {
                    run_one_by_one(self.level, pass, substep, rows, blocks);
                } else {
                    run(self.level, pass, substep, rows, blocks, count);
                }
            });
        }
    }

    pub(super) fn step(&mut self) {
        let h = self.dt / self.substeps as f32;
        let team = Team::alone();
        let listed = self.bodies.awake.clone();
        integrate::prepare(&team, &listed, &mut self.bodies, self.gravity, h);
        describe(&mut self.graph, &self.joints, &self.bodies.infos, h);
        for colour in self.graph.colours.list_mut() {
            colour.for_each_run(&team, |blocks, count| {
                prepare(self.level, &self.bodies.poses, Substep::new(h, 1.0, false), blocks, count);
            });
        }
        for _ in 0..self.substeps {
            integrate::velocities(&team, self.level, &listed, &mut self.bodies, true);
            self.pass(Pass::WarmStart);
            for _ in 0..self.iterations {
                self.pass(Pass::Solve);
            }
            integrate::positions(&team, self.level, &listed, &mut self.bodies, h, 400.0);
            self.pass(Pass::Relax);
        }
        self.pass(Pass::Finish);
        for i in 0..self.bodies.rows.len() {
            let (row, pose) = (&mut self.bodies.rows[i], &mut self.bodies.poses[i]);
            let motion = Vec2::new(row[Slot::DX], row[Slot::DY]);
            *pose = Pose::new(pose.p + motion, pose.q.integrate(row[Slot::DA]));
            row[Slot::DX..=Slot::DA].fill(0.0);
        }
    }

    pub(super) fn run(&mut self, seconds: f32) {
        for _ in 0..(seconds / self.dt).round() as u32 {
            self.step();
        }
    }

    pub(super) fn position(&self, body: u32) -> DVec2 {
        self.bodies.poses[body as usize].p
    }

    pub(super) fn angle(&self, body: u32) -> f32 {
        self.bodies.poses[body as usize].q.angle()
    }

    pub(super) fn load(&self, joint: u32) -> JointLoad {
        load(&self.graph, &self.joints, joint, self.inv_h())
    }

    pub(super) fn update(&mut self, joint: u32, def: JointDef) {
        self.graph.update(&mut self.bodies, &mut self.joints, joint, &def);
    }

    /// Times and values at which a function of the rig is greatest or least, to second order.
    pub(super) fn extremes(
        &mut self,
        seconds: f32,
        value: impl Fn(&Self) -> f64,
    ) -> Vec<(f64, f64)> {
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
pub(super) fn period_and_decrement(extremes: &[(f64, f64)], middle: f64) -> (f64, f64) {
    let (first, last) = (extremes[0], extremes[extremes.len() - 1]);
    let halves = (extremes.len() - 1) as f64;
    let decrement = ((first.1 - middle).abs() / (last.1 - middle).abs()).ln();
    ((last.0 - first.0) / halves * 2.0, decrement / halves * 2.0)
}

pub(super) fn assert_near(what: &str, value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{what}: {value}, expected {expected} +- {tolerance}"
    );
}
