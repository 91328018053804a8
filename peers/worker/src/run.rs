//! A timed run.
//!
//! The protocol is that of Box2D's own benchmark program: the world and the scene are built outside
//! the clock, one step is made unclocked, then every further step is timed, what the scene does
//! before it (spawning, removing) included.

use crate::clock::{Stopwatch, mean, peak_mib, percentile};
use crate::{Answer, Engine, Job, Report, Setup, Task, Tuning, frames, quality, worlds};
use std::time::Instant;
use tiny_physics_scenes::{Options, Player, find};

/// Reads one task from standard input, does it in the engine `E`, and prints the answer.
pub fn serve<E: Engine + 'static>() {
    let answer = read_task().and_then(|task| match task {
        Task::Time(job) => run::<E>(&job).map(Answer::Done),
        Task::Quality(job) => quality::play::<E>(&job).map(Answer::Played),
        Task::Frames => frames::measure::<E>().map(Answer::Frames),
        Task::Worlds(job) => worlds::measure::<E>(&job).map(Answer::Worlds),
        Task::Arena(scene) => quality::fight::<E>(&scene).map(Answer::Arena),
    });
    match serde_json::to_string(&answer.unwrap_or_else(Answer::Failed)) {
        Ok(line) => println!("{line}"),
        Err(error) => eprintln!("cannot write the answer: {error}"),
    }
}

fn read_task() -> Result<Task, String> {
    let mut line = String::new();
    std::io::stdin()
        .read_line(&mut line)
        .map_err(|error| format!("cannot read the task: {error}"))?;
    serde_json::from_str(&line).map_err(|error| format!("cannot understand the task: {error}"))
}

fn run<E: Engine>(job: &Job) -> Result<Report, String> {
    let entry = find(&job.scene).map_err(|error| error.to_string())?;
    let scene = entry.build(Options::default());
    let start = Instant::now();
    let engine = E::create(&Setup {
        gravity: scene.gravity,
        settings: &scene.settings,
        tuning: Tuning::Scene,
        threads: job.threads,
        setting: &job.setting,
    })?;
    let mut player = Player::new(&scene, engine);
    let build_ms = start.elapsed().as_secs_f64() * 1e3;

    player.step();
    let steps = job.steps.unwrap_or(scene.steps).saturating_sub(1).max(1);
    let (mut cpu_ms, mut wall_ms) = (Vec::new(), Vec::new());
    let own = Stopwatch::own_ms();
    for _ in 0..steps {
        let watch = Stopwatch::start();
        player.step();
        let (cpu, wall) = watch.elapsed_ms();
        cpu_ms.push((cpu - own.0).max(0.0));
        wall_ms.push((wall - own.1).max(0.0));
    }
    let engine = player.host();
    Ok(Report {
        engine: E::name(),
        build: engine.build(),
        steps,
        cpu_ms: mean(&cpu_ms),
        wall_ms: mean(&wall_ms),
        cpu_p99_ms: percentile(&cpu_ms, 0.99),
        wall_p99_ms: percentile(&wall_ms, 0.99),
        cpu_worst_ms: percentile(&cpu_ms, 1.0),
        wall_worst_ms: percentile(&wall_ms, 1.0),
        build_ms,
        peak_mib: peak_mib(),
        end: engine.summary(),
    })
}
