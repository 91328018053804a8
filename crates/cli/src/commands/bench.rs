//! `bench`: scenes timed stage by stage, on every SIMD level, levels taking turns.

use super::figures;
use super::run::Times;
use super::timing::{levels, median, milliseconds};
use crate::args::{BenchArgs, WorldArgs};
use crate::failure::{Failure, Outcome};
use crate::progress::Progress;
use crate::simulation::Simulation;
use crate::source;
use serde::Serialize;
use std::io::{Write, stdout};
use std::time::Instant;
use tiny_physics::{SimdLevel, Stage};
use tiny_physics_scenes::{Scene, tags};

/// A scene on a level: medians over the repeats.
#[derive(Serialize, Clone, Debug)]
struct Row {
    scene: String,
    simd: &'static str,
    threads: usize,
    /// Timed steps of a run.
    steps: u32,
    repeat: usize,
    /// Mean wall time of a step, milliseconds; what the scene does from outside is in it.
    ms: f64,
    /// Mean CPU time of a step, all threads together, milliseconds; none where there is no such clock.
    cpu_ms: Option<f64>,
    /// Least and greatest of the repeats' mean wall times.
    ms_range: [f64; 2],
    median_ms: f64,
    p99_ms: f64,
    /// Mean time of a step by all bodies that can move, nanoseconds: CPU time with one thread, wall time with
    /// several.
    ns_per_body: f64,
    stage_ms: Stages,
    /// What is left of the step: the scene's script and the clocks.
    other_ms: f64,
    build_ms: f64,
    /// After the last step.
    #[serde(flatten)]
    end: End,
}

/// Milliseconds of each stage.
type Stages = std::collections::BTreeMap<&'static str, f64>;

/// A world after its last step.
#[derive(Serialize, Clone, PartialEq, Eq, Debug)]
struct End {
    bodies: usize,
    moving: usize,
    awake: usize,
    contacts: usize,
    joints: usize,
    hash: String,
}

/// One run.
struct Run {
    steps: Times,
    cpu_ms: Option<f64>,
    stage_ms: [f64; Stage::ALL.len()],
    build_ms: f64,
    end: End,
}

/// Runs the scenes and prints a table or rows.
///
/// # Errors
/// A scene that is not known, that the engine refuses, or that levels give different results of.
pub fn run(args: &BenchArgs) -> Outcome {
    if !args.figures.is_empty() {
        return figures::run(args);
    }
    let all = [tags::BENCHMARK.to_owned()];
    let words = if args.scenes.is_empty() { &all[..] } else { &args.scenes[..] };
    let mut out = stdout().lock();
    for name in source::names(words)? {
        let rows = bench_scene(&name, args)?;
        if args.json {
            print_json(&mut out, &rows)?;
        } else {
            print_table(&mut out, &rows)?;
        }
        out.flush()?;
    }
    Ok(())
}

/// A scene on all levels, interleaved.
fn bench_scene(name: &str, args: &BenchArgs) -> Outcome<Vec<Row>> {
    let scene = source::open(name, 1)?;
    let steps = args.steps.unwrap_or(scene.steps).max(2) - 1;
    let levels = levels(args);
    let mut runs: Vec<Vec<Run>> = levels.iter().map(|_| Vec::new()).collect();
    let total = steps * u32::from(args.repeat) * levels.len() as u32;
    let progress = Progress::new(total);
    let mut done = 0;
    for _ in 0..args.repeat {
        for (level, runs) in levels.iter().zip(&mut runs) {
            runs.push(run_once(&scene, *level, args.threads, steps, || {
                progress.at(done);
                done += 1;
            })?);
        }
    }
    progress.finish();
    same_end(name, runs.iter().flatten())?;
    let rows = levels.iter().zip(&runs);
    Ok(rows.map(|(level, runs)| Row::new(&scene, *level, args, steps, runs)).collect())
}

/// Builds the world, makes a step, and times the others.
fn run_once(
    scene: &Scene,
    level: SimdLevel,
    threads: u16,
    steps: u32,
    mut stepped: impl FnMut(),
) -> Outcome<Run> {
    let start = Instant::now();
    let how = WorldArgs { seed: 1, threads, simd: Some(level) };
    let mut simulation = Simulation::new(scene.clone(), &how)?;
    let build_ms = milliseconds(start);
    simulation.step();
    let cpu_start = cpu_milliseconds();
    let mut step_ms = Vec::with_capacity(steps as usize);
    let mut stage_ms = [0.0; Stage::ALL.len()];
    for _ in 0..steps {
        let start = Instant::now();
        simulation.step();
        step_ms.push(milliseconds(start));
        let stats = simulation.world().stats();
        for (sum, stage) in stage_ms.iter_mut().zip(Stage::ALL) {
            *sum += stats.seconds(stage) * 1000.0 / f64::from(steps);
        }
        stepped();
    }
    let cpu_ms = cpu_milliseconds().zip(cpu_start).map(|(end, start)| end - start);
    let cpu_ms = cpu_ms.map(|total| total / f64::from(steps));
    let end = End::of(&simulation);
    Ok(Run { steps: Times::of(step_ms), cpu_ms, stage_ms, build_ms, end })
}

/// CPU time of this program so far, all threads together.
fn cpu_milliseconds() -> Option<f64> {
    #[cfg(unix)]
    {
        use rustix::time::{ClockId, clock_gettime};
        let time = clock_gettime(ClockId::ProcessCPUTime);
        Some(time.tv_sec as f64 * 1.0e3 + time.tv_nsec as f64 * 1.0e-6)
    }
    #[cfg(not(unix))]
    None
}

/// All levels must end in the same state, bit for bit.
fn same_end<'a>(scene: &str, mut runs: impl Iterator<Item = &'a Run>) -> Outcome {
    let Some(first) = runs.next() else { return Ok(()) };
    match runs.find(|run| run.end != first.end) {
        None => Ok(()),
        Some(other) => Err(Failure::new(format!(
            "{scene}: runs end differently, with hash {} and {}",
            first.end.hash, other.end.hash
        ))),
    }
}

impl End {
    fn of(simulation: &Simulation) -> Self {
        let (world, status) = (simulation.world(), simulation.status());
        Self {
            bodies: world.body_count(),
            moving: status.moving,
            awake: status.awake,
            contacts: status.contacts,
            joints: world.joint_count(),
            hash: format!("{:016x}", world.state_hash()),
        }
    }
}

impl Row {
    fn new(scene: &Scene, level: SimdLevel, args: &BenchArgs, steps: u32, runs: &[Run]) -> Self {
        let middle = |part: &dyn Fn(&Run) -> f64| median(runs.iter().map(part).collect());
        let ms = middle(&|run| run.steps.mean);
        let means = || runs.iter().map(|run| run.steps.mean);
        let cpu_ms: Option<Vec<f64>> = runs.iter().map(|run| run.cpu_ms).collect();
        let cpu_ms = cpu_ms.map(median);
        let cost_ms = cpu_ms.filter(|_| args.threads == 1).unwrap_or(ms);
        let end = runs[0].end.clone();
        let stages = (0..).zip(Stage::ALL);
        let stage_ms: Stages =
            stages.map(|(i, stage)| (stage.name(), middle(&|run| run.stage_ms[i]))).collect();
        Self {
            scene: scene.name.clone(),
            simd: level.name(),
            threads: usize::from(args.threads),
            steps,
            repeat: runs.len(),
            ms,
            cpu_ms,
            ms_range: [means().fold(f64::MAX, f64::min), means().fold(0.0, f64::max)],
            median_ms: middle(&|run| run.steps.median),
            p99_ms: middle(&|run| run.steps.p99),
            ns_per_body: cost_ms * 1.0e6 / end.moving.max(1) as f64,
            other_ms: middle(&|run| run.steps.mean - run.stage_ms.iter().sum::<f64>()),
            stage_ms,
            build_ms: middle(&|run| run.build_ms),
            end,
        }
    }
}

fn print_json(out: &mut impl Write, rows: &[Row]) -> Outcome {
    for row in rows {
        serde_json::to_writer(&mut *out, row)?;
        writeln!(out)?;
    }
    Ok(())
}

fn print_table(out: &mut impl Write, rows: &[Row]) -> Outcome {
    let Some(first) = rows.first() else { return Ok(()) };
    let End { moving, contacts, joints, awake, hash, .. } = &first.end;
    writeln!(
        out,
        "\n{}: {} timed steps, median of {}, threads: {}; at the end {moving} moving bodies ({awake} awake), \
         {contacts} contacts, {joints} joints, hash {hash}",
        first.scene, first.steps, first.repeat, first.threads
    )?;
    write!(out, "{:8}{:>9}{:>9}", "simd", "ms", "cpu ms")?;
    write!(out, "{:>9}{:>9}{:>9}  |", "median", "p99", "ns/body")?;
    Stage::ALL.iter().try_for_each(|stage| write!(out, "{:>13}", stage.name()))?;
    writeln!(out, "{:>9}", "other")?;
    for row in rows {
        let Row { simd, ms, median_ms, p99_ms, ns_per_body, other_ms, .. } = row;
        let cpu_ms = row.cpu_ms.map_or("-".into(), |ms| format!("{ms:.4}"));
        write!(out, "{simd:8}{ms:9.4}{cpu_ms:>9}")?;
        write!(out, "{median_ms:9.4}{p99_ms:9.4}{ns_per_body:9.1}  |")?;
        let stages = Stage::ALL.iter().filter_map(|stage| row.stage_ms.get(stage.name()));
        for ms in stages {
            write!(out, "{ms:13.4}")?;
        }
        writeln!(out, "{other_ms:9.4}")?;
    }
    Ok(())
}
