//! `list`: the built-in scenes.

use crate::args::ListArgs;
use crate::failure::Outcome;
use std::io::{Write, stdout};
use tiny_physics_scenes::all;

/// Prints name and description of every built-in scene.
///
/// # Errors
/// Standard output's.
pub fn run(args: &ListArgs) -> Outcome {
    let mut out = stdout().lock();
    if args.json {
        let scenes: Vec<_> = all()
            .iter()
            .map(
                |entry| serde_json::json!({ "name": entry.name, "description": entry.description }),
            )
            .collect();
        serde_json::to_writer_pretty(&mut out, &scenes)?;
        writeln!(out)?;
        return Ok(());
    }
    let width = all().iter().map(|entry| entry.name.len()).max().unwrap_or(0);
    for entry in all() {
        writeln!(out, "{:width$}  {}", entry.name, entry.description)?;
    }
    writeln!(out, "\nRun one with 'tiny-physics run NAME', see it with 'tiny-physics view NAME'.")?;
    Ok(())
}
