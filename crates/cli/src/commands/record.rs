//! `record`, `replay` and `diff`: runs as files.

use crate::args::{DiffArgs, RecordArgs, ReplayArgs};
use crate::failure::{Failure, Outcome};
use crate::source;
use std::fs;
use std::io::{Write, stdout};
use std::path::Path;
use tiny_physics::Error;
use tiny_physics::record::{Player, Recording};
use tiny_physics_scenes::{CommandHost, Player as ScenePlayer};

/// Runs a scene and writes what was done.
///
/// # Errors
/// There is no such scene, something in it is refused, or the file cannot be written.
pub fn record(args: &RecordArgs) -> Outcome {
    let scene = source::open(&args.scene, args.seed)?;
    // Before all is played.
    if let Some(folder) = args.output.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::metadata(folder).map_err(|error| Failure::cannot_write(&args.output, &error))?;
    }
    let host = CommandHost::recording(scene.gravity, scene.settings);
    let mut player = ScenePlayer::new(&scene, host);
    let steps = args.steps.unwrap_or(scene.steps);
    while player.steps_done() < steps && player.host().error().is_none() {
        player.step();
    }
    let host = player.into_host();
    if let Some(error) = host.error() {
        return Err(error.clone().into());
    }
    let bytes = host.recorder().recording().to_bytes();
    fs::write(&args.output, &bytes).map_err(|error| Failure::cannot_write(&args.output, &error))?;
    let hash = host.world().state_hash();
    writeln!(stdout(), "{steps} steps, {} bytes, state hash {hash:016x}", bytes.len())?;
    Ok(())
}

/// Plays a recording and compares every step.
///
/// # Errors
/// The file is no recording, or a step has other bits.
pub fn replay(args: &ReplayArgs) -> Outcome {
    let recording = load(&args.file)?;
    let mut player = Player::new(&recording)?;
    let played = player.seek(args.to.unwrap_or(recording.len()));
    played.map_err(|error| match error {
        Error::Differs { .. } => error.into(),
        _ => Failure::new(format!("{error} (at step {})", player.at() + 1)),
    })?;
    let hash = player.world().state_hash();
    writeln!(stdout(), "{} steps with the same bits, state hash {hash:016x}", player.at())?;
    Ok(())
}

/// Compares two recordings.
///
/// # Errors
/// A file is no recording, or they differ.
pub fn diff(args: &DiffArgs) -> Outcome {
    let (a, b) = (load(&args.a)?, load(&args.b)?);
    match a.first_difference(&b) {
        None => writeln!(stdout(), "alike in all {} steps", a.len())?,
        Some(0) => return Err(Failure::new("the first frames differ")),
        Some(step) if step > a.len() || step > b.len() => {
            return Err(Failure::new(format!("alike until one ends, before step {step}")));
        }
        Some(step) => {
            let hash = |recording: &Recording| recording.hash(step).unwrap_or_default();
            let (a, b) = (hash(&a), hash(&b));
            return Err(Failure::new(format!(
                "they differ from step {step}: {a:016x} and {b:016x}"
            )));
        }
    }
    Ok(())
}

fn load(path: &Path) -> Outcome<Recording> {
    let in_file =
        |error: &dyn std::fmt::Display| Failure::new(format!("{}: {error}", path.display()));
    let bytes = fs::read(path).map_err(|error| in_file(&error))?;
    Recording::from_bytes(&bytes).map_err(|error| in_file(&error))
}
