//! `run`: a scene as fast as it goes, what came of it, and what the doctor says of it.

use crate::args::RunArgs;
use crate::failure::Outcome;
use crate::simulation::Simulation;
use crate::source;
use indicatif::{ProgressBar, ProgressStyle};
use serde::{Serialize, Serializer};
use std::io::{IsTerminal, Write, stderr, stdout};
use std::time::{Duration, Instant};
use tiny_physics::Stage;
use tiny_physics_doctor::{Doctor, Finding};

/// The report, with the names of its JSON form.
#[derive(Serialize, Debug)]
struct Report {
    scene: String,
    steps: u32,
    bodies: usize,
    shapes: usize,
    joints: usize,
    contacts: usize,
    awake_bodies: usize,
    threads: usize,
    simd: &'static str,
    ms_per_step: Times,
    #[serde(serialize_with = "as_map")]
    stage_ms: Vec<(&'static str, f64)>,
    max_penetration_m: f32,
    kinetic_energy_j: f64,
    hash: String,
    findings: Vec<Finding>,
}

/// Milliseconds a step over a run.
#[derive(Serialize, Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Times {
    pub(super) mean: f64,
    pub(super) median: f64,
    pub(super) p99: f64,
    pub(super) max: f64,
}

/// Runs the scene and prints the report.
///
/// # Errors
/// No such scene, or the engine refuses it.
pub fn run(args: &RunArgs) -> Outcome {
    let scene = source::open(&args.scene, args.world.seed)?;
    let steps = args.steps.unwrap_or(scene.steps);
    let mut simulation = Simulation::new(scene, &args.world)?;
    let report = measure(&mut simulation, steps);
    let mut out = stdout().lock();
    if args.json {
        serde_json::to_writer_pretty(&mut out, &report)?;
        writeln!(out)?;
    } else {
        print_table(&mut out, &report)?;
    }
    Ok(())
}

fn measure(simulation: &mut Simulation, steps: u32) -> Report {
    let progress = Progress::new(steps);
    let mut step_ms = Vec::with_capacity(steps as usize);
    let mut stages = [0.0; Stage::ALL.len()];
    let mut doctor = Doctor::new();
    for step in 0..steps {
        let start = Instant::now();
        simulation.step();
        step_ms.push(start.elapsed().as_secs_f64() * 1000.0);
        doctor.watch(simulation.world());
        let stats = simulation.world().stats();
        for (sum, stage) in stages.iter_mut().zip(Stage::ALL) {
            *sum += stats.seconds(stage) * 1000.0;
        }
        progress.at(step);
    }
    progress.finish();
    let mean = |(sum, stage): (f64, Stage)| (stage.name(), sum / f64::from(steps.max(1)));
    report(
        simulation,
        steps,
        Times::of(step_ms),
        stages.into_iter().zip(Stage::ALL).map(mean).collect(),
        doctor.report().findings,
    )
}

fn report(
    simulation: &Simulation,
    steps: u32,
    ms_per_step: Times,
    stage_ms: Vec<(&'static str, f64)>,
    findings: Vec<Finding>,
) -> Report {
    let world = simulation.world();
    Report {
        scene: simulation.scene().name.clone(),
        steps,
        bodies: world.body_count(),
        shapes: world.shape_count(),
        joints: world.joint_count(),
        contacts: world.contact_count(),
        awake_bodies: world.awake_body_count(),
        threads: world.threads(),
        simd: world.simd().name(),
        ms_per_step,
        stage_ms,
        // Adding nothing turns -0 into 0.
        max_penetration_m: world.max_penetration() + 0.0,
        kinetic_energy_j: world.kinetic_energy(),
        hash: format!("{:016x}", world.state_hash()),
        findings,
    }
}

impl Times {
    pub(super) fn of(mut milliseconds: Vec<f64>) -> Self {
        milliseconds.sort_by(f64::total_cmp);
        let count = milliseconds.len();
        // The smallest value that at least this part of all values does not exceed.
        let at = |part: f64| {
            let rank = (part * count as f64).ceil() as usize;
            milliseconds.get(rank.max(1) - 1).copied().unwrap_or(0.0)
        };
        let mean = milliseconds.iter().sum::<f64>() / count.max(1) as f64;
        Self { mean, median: at(0.5), p99: at(0.99), max: at(1.0) }
    }
}

fn as_map<S: Serializer>(pairs: &[(&'static str, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().copied())
}

fn print_table(out: &mut impl Write, report: &Report) -> Outcome {
    let Times { mean, median, p99, max } = report.ms_per_step;
    writeln!(out, "scene        {}", report.scene)?;
    writeln!(out, "steps        {}", report.steps)?;
    writeln!(out, "bodies       {} ({} awake)", report.bodies, report.awake_bodies)?;
    writeln!(out, "shapes       {}", report.shapes)?;
    writeln!(out, "joints       {}", report.joints)?;
    writeln!(out, "contacts     {}", report.contacts)?;
    writeln!(out, "threads      {}, SIMD {}", report.threads, report.simd)?;
    writeln!(out, "ms per step  mean {mean:.4}, median {median:.4}, p99 {p99:.4}, max {max:.4}")?;
    for (name, ms) in &report.stage_ms {
        let share = if mean > 0.0 { 100.0 * ms / mean } else { 0.0 };
        writeln!(out, "  {name:<12} {ms:>9.4}  {share:>5.1} %")?;
    }
    writeln!(out, "penetration  {:.3} mm at most", report.max_penetration_m * 1000.0)?;
    writeln!(out, "energy       {:.6} J kinetic", report.kinetic_energy_j)?;
    for finding in &report.findings {
        writeln!(out, "doctor       {}", finding.line())?;
    }
    writeln!(out, "hash         {}", report.hash)?;
    Ok(())
}

/// A progress bar that appears on a terminal when a run takes longer than a moment.
pub(super) struct Progress {
    bar: ProgressBar,
    start: Instant,
    allowed: bool,
}

impl Progress {
    const PATIENCE: Duration = Duration::from_millis(700);

    pub(super) fn new(steps: u32) -> Self {
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len} steps, {eta} left");
        let bar = ProgressBar::new(u64::from(steps));
        bar.set_draw_target(indicatif::ProgressDrawTarget::hidden());
        if let Ok(style) = style {
            bar.set_style(style);
        }
        Self { bar, start: Instant::now(), allowed: stderr().is_terminal() }
    }

    /// A step has been made.
    pub(super) fn at(&self, step: u32) {
        if !self.allowed || self.start.elapsed() < Self::PATIENCE {
            return;
        }
        if self.bar.is_hidden() {
            self.bar.set_draw_target(indicatif::ProgressDrawTarget::stderr());
        }
        self.bar.set_position(u64::from(step) + 1);
    }

    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_a_run() {
        let times = Times::of((1..=100).rev().map(f64::from).collect());
        assert_eq!(times, Times { mean: 50.5, median: 50.0, p99: 99.0, max: 100.0 });
        assert_eq!(Times::of(vec![3.0]), Times { mean: 3.0, median: 3.0, p99: 3.0, max: 3.0 });
        assert_eq!(Times::of(Vec::new()), Times::default());
    }
}
