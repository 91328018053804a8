//! `--picture FILE SECONDS [--debug]`: runs the demo for so long, as fast as it goes, and writes what is seen then.

use bevy::prelude::*;
use bevy::render::view::screenshot::{Screenshot, save_to_disk};
use bevy::time::TimeUpdateStrategy;
use bevy_tiny_physics::prelude::PhysicsDebug;
use std::time::Duration;

/// The picture that is asked for.
#[derive(Resource)]
struct Wanted {
    file: String,
    frames: u32,
}

/// Time of a frame on the way to a picture, seconds.
const FRAME: f32 = 0.1;

pub fn install(app: &mut App) {
    let arguments: Vec<String> = std::env::args().collect();
    let Some(at) = arguments.iter().position(|argument| argument == "--picture") else { return };
    let (Some(file), Some(Ok(seconds))) =
        (arguments.get(at + 1), arguments.get(at + 2).map(|s| s.parse::<f32>()))
    else {
        eprintln!("usage: --picture FILE SECONDS [--debug]");
        std::process::exit(2);
    };
    app.insert_resource(Wanted { file: file.clone(), frames: (seconds / FRAME) as u32 })
        .insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs_f32(FRAME)))
        .insert_resource(PhysicsDebug {
            enabled: arguments.iter().any(|argument| argument == "--debug"),
            ..default()
        })
        .add_systems(Last, take);
}

/// Frames between the picture and the end, in which it is written.
const AFTERWARDS: u32 = 12;

fn take(
    wanted: Res<Wanted>,
    mut frame: Local<u32>,
    mut commands: Commands,
    mut exit: MessageWriter<AppExit>,
) {
    *frame += 1;
    if *frame == wanted.frames.max(3) {
        commands.spawn(Screenshot::primary_window()).observe(save_to_disk(wanted.file.clone()));
    }
    if *frame == wanted.frames.max(3) + AFTERWARDS {
        exit.write(AppExit::Success);
    }
}
