//! The `tiny-physics` program: watch, run, time and draw 2D physics scenes.

mod args;
mod commands;
mod failure;
mod picture;
mod preview;
mod progress;
mod simulation;
mod source;
mod text_frame;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    match commands::run(args::Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever reads our output has seen enough: `tiny-physics list | head -3`.
        Err(failure) if failure.is_broken_pipe() => ExitCode::SUCCESS,
        Err(failure) => {
            if failure.has_words() {
                eprintln!("{failure}");
            }
            ExitCode::FAILURE
        }
    }
}
