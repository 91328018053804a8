//! Many small worlds at once, in all engines.

use crate::{engines, launch};
use clap::Args;
use peers_worker::{Answer, Task, WorldsJob};
use std::time::Duration;

const ENGINES: [&str; 3] = ["ours", "box2d-avx2", "rapier-simd8"];
const LIMIT: Duration = Duration::from_secs(600);

/// Options of `worlds`.
#[derive(Args)]
pub struct WorldsArgs {
    /// The scene that each world holds.
    #[arg(long, default_value = "crates_10")]
    scene: String,
    /// How many worlds, comma-separated; Box2D holds 128 at most.
    #[arg(long, value_delimiter = ',', default_value = "1,100,10000")]
    counts: Vec<usize>,
    /// Steps of each world.
    #[arg(long, default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Runs of each; the least counts.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    repeat: u16,
}

/// Steps so many worlds in turn in each engine, and prints what a step of one takes.
///
/// # Errors
/// An engine that does not build or crashes.
pub fn run(args: &WorldsArgs) -> Result<(), String> {
    let configs = engines::select(&ENGINES.map(String::from))?;
    for config in &configs {
        eprintln!("building {}", config.name);
        config.build(1)?;
    }
    println!(
        "| worlds of {} | engine | microseconds a step | steps a second and core |",
        args.scene
    );
    println!("|---:|---|---:|---:|");
    for &count in &args.counts {
        let rounds = if count < 100 { args.rounds * 100 } else { args.rounds };
        let task = Task::Worlds(WorldsJob { scene: args.scene.clone(), count, rounds });
        let mut least = vec![Ok(f64::INFINITY); configs.len()];
        for _ in 0..args.repeat {
            for (config, least) in configs.iter().zip(&mut least) {
                match (launch::ask(&config.program(1), &task, LIMIT)?, &mut *least) {
                    (Answer::Worlds(worlds), Ok(us)) => *us = us.min(worlds.step_us),
                    (Answer::Failed(reason), _) => *least = Err(reason),
                    _ => return Err(format!("{} did something else instead", config.name)),
                }
            }
        }
        for (config, least) in configs.iter().zip(least) {
            match least {
                Ok(us) => println!("| {count} | {} | {us:.2} | {:.0} |", config.name, 1e6 / us),
                Err(reason) => println!("| {count} | {} | - | {reason} |", config.name),
            }
        }
    }
    Ok(())
}
