//! What it costs to keep a world and to go back to it, in all engines.

use crate::{engines, launch};
use clap::Args;
use peers_worker::{Answer, Frames, Task};
use std::time::Duration;

const ENGINES: [&str; 3] = ["ours", "box2d-sse2", "rapier-frames"];
const LIMIT: Duration = Duration::from_secs(600);

/// Options of `frames`.
#[derive(Args)]
pub struct FramesArgs {
    /// Print one JSON object an engine instead of a table.
    #[arg(long)]
    json: bool,
}

/// Measures frames in all engines, one after the other, and prints what they cost.
///
/// # Errors
/// An engine that does not build, crashes or cannot save its world.
pub fn run(args: &FramesArgs) -> Result<(), String> {
    let configs = engines::select(&ENGINES.map(String::from))?;
    for config in &configs {
        eprintln!("building {}", config.name);
        config.build(1)?;
    }
    let mut all = Vec::new();
    for config in &configs {
        match launch::ask(&config.program(1), &Task::Frames, LIMIT)? {
            Answer::Frames(frames) => all.push(frames),
            Answer::Failed(reason) => return Err(format!("{}: {reason}", config.name)),
            _ => return Err(format!("{} did something else instead", config.name)),
        }
    }
    if args.json {
        for frames in &all {
            println!("{}", serde_json::to_string(frames).map_err(|error| error.to_string())?);
        }
    } else {
        print_table(&all);
    }
    Ok(())
}

fn print_table(all: &[Frames]) {
    println!(
        "{:26}{:>8}{:>10}{:>12}{:>14}{:>10}{:>9}{:>11}  repeats",
        "engine", "bodies", "contacts", "bytes/body", "memcpy of it", "clone", "save", "restore",
    );
    for frames in all {
        let clone = frames.clone_ms.map_or_else(|| "-".into(), |ms| format!("{ms:.2} ms"));
        println!(
            "{:26}{:8}{:10}{:12.0}{:11.2} ms{clone:>10}{:6.2} ms{:8.2} ms  {}",
            frames.engine,
            frames.bodies,
            frames.contacts,
            frames.bytes as f64 / frames.bodies.max(1) as f64,
            frames.copy_ms,
            frames.save_ms,
            frames.restore_ms,
            if frames.repeats { "yes" } else { "no" },
        );
    }
}
