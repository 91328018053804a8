//! One file a command.

mod bench;
mod demo;
mod doctor;
mod figures;
mod list;
mod play;
mod player;
mod quality;
mod record;
mod render;
mod run;
mod soak;
mod timing;
mod view;

use crate::args::{Cli, Command};
use crate::failure::Outcome;

/// Does what the command line says.
///
/// # Errors
/// The command's, in words for the user.
pub fn run(cli: Cli) -> Outcome {
    match cli.command {
        None => demo::run(&cli.demo),
        Some(Command::Demo(args)) => demo::run(&args),
        Some(Command::List(args)) => list::run(&args),
        Some(Command::Run(args)) => run::run(&args),
        Some(Command::Bench(args)) => bench::run(&args),
        Some(Command::Quality(args)) => quality::run(&args),
        Some(Command::Render(args)) => render::run(&args),
        Some(Command::View(args)) => view::run(&args),
        Some(Command::Play(args)) => play::run(&args),
        Some(Command::Record(args)) => record::record(&args),
        Some(Command::Replay(args)) => record::replay(&args),
        Some(Command::Diff(args)) => record::diff(&args),
        Some(Command::Doctor(args)) => doctor::run(&args),
        Some(Command::Soak(args)) => soak::run(&args),
    }
}
