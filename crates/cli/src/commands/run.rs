//! `run`: a scene as fast as it goes, what came of it, and what the doctor says of it.

use crate::args::RunArgs;
use crate::failure::Outcome;
use crate::progress::Progress;
use crate::simulation::Simulation;
use crate::source;
use serde::{Serialize, Serializer};
use std::io::{Write, stdout};
use std::time::Instant;
use tiny_physics::{BodyKind, Stage, World};
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
    worst_penetration_m: f32,
    max_penetration_m: f32,
    ended: Ended,
    fastest_m_s: f32,
    kinetic_energy_j: f64,
    hash: String,
    findings: Vec<Finding>,
}

/// How a run ended.
#[derive(Serialize, Clone, Copy, PartialEq, Eq, Debug)]
#[serde(rename_all = "snake_case")]
enum Ended {
    /// Nothing moves.
    AtRest,
    /// Something moves.
    Moving,
    /// Bodies were frozen because their numbers stopped being finite, or are at the speed limit.
    BlownUp,
}

impl Ended {
    /// Slower than this (length units a second) is at rest, asleep or not.
    const SLOW: f32 = 0.02;

    fn of(world: &World, frozen: bool) -> Self {
        let (fastest, unit) = (fastest(world), world.settings.length_unit);
        if frozen || fastest >= 0.98 * world.settings.max_speed * unit {
            Self::BlownUp
        } else if fastest < Self::SLOW * unit {
            Self::AtRest
        } else {
            Self::Moving
        }
    }
}

/// Speed of the fastest point of a body, about, metres a second.
fn fastest(world: &World) -> f32 {
    let moving = world.bodies().filter(|body| body.kind() != BodyKind::Static && body.is_awake());
    let speed = moving.map(|body| {
        let shapes = body.shapes().filter_map(|id| world.shape(id));
        let reach = shapes.map(|shape| shape.shape().bounding_radius()).fold(0.0, f32::max);
        body.velocity().length() + body.angular_velocity().abs() * reach
    });
    speed.fold(0.0, f32::max)
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
    simulation.all_done()?;
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
    let (mut worst, mut frozen) = (0.0_f32, false);
    for step in 0..steps {
        let start = Instant::now();
        simulation.step();
        step_ms.push(start.elapsed().as_secs_f64() * 1000.0);
        doctor.watch(simulation.world());
        let stats = simulation.world().stats();
        worst = worst.max(simulation.world().max_penetration());
        frozen |= stats.frozen_bodies > 0;
        for (sum, stage) in stages.iter_mut().zip(Stage::ALL) {
            *sum += stats.seconds(stage) * 1000.0;
        }
        progress.at(step);
    }
    progress.finish();
    let mean = |(sum, stage): (f64, Stage)| (stage.name(), sum / f64::from(steps.max(1)));
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
        ms_per_step: Times::of(step_ms),
        stage_ms: stages.into_iter().zip(Stage::ALL).map(mean).collect(),
        worst_penetration_m: worst,
        max_penetration_m: simulation.overlap(),
        ended: Ended::of(world, frozen),
        fastest_m_s: fastest(world),
        kinetic_energy_j: world.kinetic_energy(),
        hash: format!("{:016x}", world.state_hash()),
        findings: doctor.report().findings,
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
    let [worst, last] =
        [report.worst_penetration_m, report.max_penetration_m].map(|depth| depth * 1000.0);
    writeln!(out, "penetration  {worst:.3} mm at worst, {last:.3} mm at the end")?;
    let ended = match report.ended {
        Ended::AtRest if report.awake_bodies == 0 => "at rest, asleep".to_owned(),
        Ended::AtRest => "at rest".to_owned(),
        Ended::Moving => format!("moving, at most {:.2} m/s", report.fastest_m_s),
        Ended::BlownUp => "blown up".to_owned(),
    };
    writeln!(out, "ended        {ended}")?;
    writeln!(out, "energy       {:.6} J kinetic", report.kinetic_energy_j)?;
    for finding in &report.findings {
        writeln!(out, "doctor       {}", finding.line())?;
    }
    writeln!(out, "hash         {}", report.hash)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use tiny_physics::RigidBody;

    #[test]
    fn runs_end_at_rest_moving_or_blown_up() {
        let ball = RigidBody::dynamic().shape(tiny_physics::Shape::Circle { radius: 0.5 });
        let ended = |velocity: f32, spin: f32, frozen| {
            let mut world = World::new(tiny_physics::Vec2::ZERO);
            let ball = ball.clone().velocity((velocity, 0.0)).angular_velocity(spin);
            world.add_body(ball).unwrap();
            Ended::of(&world, frozen)
        };
        assert_eq!(ended(0.001, 0.0, false), Ended::AtRest);
        assert_eq!(ended(1.0, 0.0, false), Ended::Moving);
        assert_eq!(ended(0.0, 1.0, false), Ended::Moving);
        assert_eq!(ended(1.0e6, 0.0, false), Ended::BlownUp);
        assert_eq!(ended(0.0, 0.0, true), Ended::BlownUp);
    }

    #[test]
    fn times_of_a_run() {
        let times = Times::of((1..=100).rev().map(f64::from).collect());
        assert_eq!(times, Times { mean: 50.5, median: 50.0, p99: 99.0, max: 100.0 });
        assert_eq!(Times::of(vec![3.0]), Times { mean: 3.0, median: 3.0, p99: 3.0, max: 3.0 });
        assert_eq!(Times::of(Vec::new()), Times::default());
    }
}
