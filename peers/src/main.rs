//! Runs the benchmark scenes in several engines, side by side, and compares.
//!
//! Each engine and configuration is a program of its own (their features exclude each other), built
//! here with its own flags into its own folder. Runs are interleaved, A B C A B C, so that what
//! disturbs the machine disturbs all. See `README.md` for what is equal and what is not.

mod arena;
mod chart;
mod engines;
mod frames;
mod honesty;
mod launch;
mod plots;
mod quality;
mod svg;
mod table;
mod worlds;

use clap::{Parser, Subcommand};
use engines::Config;
use peers_worker::{Job, Report};
use table::Row;

/// Runs the benchmark scenes in tiny-physics, Box2D v3 and Rapier, interleaved.
///
/// Prints, for each scene and engine, the median over the repeats of the mean CPU and wall time of a
/// step, the 99th percentile and the worst step, and the ratios of its times to those of tiny-physics; beside them the
/// figures that show whether all simulated the same.
#[derive(Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
struct Args {
    #[command(subcommand)]
    command: Option<Command>,
    /// Scenes to run, by name or by tag (benchmark, box2d, scale, huge, show); `benchmark` if none is given.
    #[arg(value_name = "SCENE")]
    scenes: Vec<String>,
    /// Engines to run, comma-separated, of: ours, ours-scalar, ours-sse2, ours-avx2, ours-avx512,
    /// box2d-sse2, box2d-avx2, rapier, rapier-v3, rapier-simd8.
    #[arg(long, value_delimiter = ',', value_name = "ENGINE")]
    engines: Vec<String>,
    /// Threads that each engine may use.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=64))]
    threads: u16,
    /// Runs of each engine and scene; the median counts.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    repeat: u16,
    /// Steps of a run instead of the scene's own number, the untimed first one included.
    #[arg(long, value_parser = clap::value_parser!(u32).range(2..))]
    steps: Option<u32>,
    /// Print one JSON object a row instead of tables.
    #[arg(long)]
    json: bool,
    /// Print one table in Markdown, as in the README, in place of one a scene.
    #[arg(long, conflicts_with = "json")]
    markdown: bool,
}

#[derive(Subcommand)]
enum Command {
    /// Play the quality suite in tiny-physics, Box2D and Rapier, each at its own defaults, and print the table.
    Quality(quality::QualityArgs),
    /// Play random worlds in all engines and keep those in which tiny-physics is worse than the best other.
    Arena(arena::ArenaArgs),
    /// Draw the pictures of docs/quality.md: rows of the quality suite, ours beside the others.
    Plots(plots::PlotsArgs),
    /// Measure what it costs to keep a world of 10,000 touching bodies and to go back to it.
    Frames(frames::FramesArgs),
    /// Step many small worlds in turn, as those do who train agents.
    Worlds(worlds::WorldsArgs),
}

fn main() -> std::process::ExitCode {
    let args = Args::parse();
    let done = match &args.command {
        None => compare(&args),
        Some(Command::Quality(args)) => quality::run(args),
        Some(Command::Arena(args)) => arena::run(args),
        Some(Command::Plots(args)) => plots::run(args),
        Some(Command::Frames(args)) => frames::run(args),
        Some(Command::Worlds(args)) => worlds::run(args),
    };
    match done {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            std::process::ExitCode::FAILURE
        }
    }
}

fn compare(args: &Args) -> Result<(), String> {
    let scenes = scenes(&args.scenes)?;
    let configs = engines::select(&args.engines)?;
    for config in &configs {
        eprintln!("building {}", config.name);
        config.build(usize::from(args.threads))?;
    }
    let mut all = Vec::new();
    for scene in &scenes {
        let rows = run_scene(args, scene, &configs);
        if args.json {
            table::print_json(&rows);
        } else if !args.markdown {
            table::print_scene(&rows, args.threads);
        }
        all.extend(rows);
    }
    if args.markdown {
        table::print_markdown(&configs, &all);
    }
    if !args.json && scenes.len() > 1 {
        table::print_means(&configs, &all);
    }
    Ok(())
}

/// The scenes that the words of the command line stand for.
fn scenes(words: &[String]) -> Result<Vec<&'static str>, String> {
    if words.is_empty() {
        return peers_worker::resolve("benchmark").map_err(|error| error.to_string());
    }
    let mut names = Vec::new();
    for word in words {
        names.extend(peers_worker::resolve(word).map_err(|error| error.to_string())?);
    }
    Ok(names)
}

/// All engines on one scene, interleaved; engines that cannot run it are left out, with a word.
fn run_scene(args: &Args, scene: &str, configs: &[Config]) -> Vec<Row> {
    let job = |setting: &str| Job {
        scene: scene.to_owned(),
        threads: usize::from(args.threads),
        steps: args.steps,
        setting: setting.to_owned(),
    };
    let mut reports: Vec<Vec<Report>> = vec![Vec::new(); configs.len()];
    let mut failed = vec![false; configs.len()];
    for round in 1..=args.repeat {
        for (i, config) in configs.iter().enumerate() {
            if failed[i] {
                continue;
            }
            eprintln!("{scene}, {round} of {}: {}", args.repeat, config.name);
            match launch::time(&config.program(usize::from(args.threads)), &job(config.setting)) {
                Ok(report) => reports[i].push(report),
                Err(message) => {
                    eprintln!("{scene}: {} is left out: {message}", config.name);
                    failed[i] = true;
                }
            }
        }
    }
    let runs = configs.iter().zip(reports).filter(|(_, reports)| !reports.is_empty());
    table::rows(scene, usize::from(args.threads), runs)
}
