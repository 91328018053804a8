//! The same bits over whole runs of every built-in scene but the million, at every SIMD level, on 1, 2 and 3
//! threads, and with levels and threads changed on the way: `cargo run --release -p tiny-physics-scenes --example
//! bits [scene or tag ...] [--steps N] [--every N]`. Fails where a run differs, and says by which step.

use std::process::ExitCode;
use tiny_physics_scenes::bits::{Way, hashes, parted};
use tiny_physics_scenes::{Entry, UnknownScene, all, find, resolve};

/// What the command line asks for.
struct Arguments {
    names: Vec<String>,
    steps: Option<u32>,
    every: u32,
}

impl Arguments {
    fn read() -> Self {
        let mut arguments = Self { names: Vec::new(), steps: None, every: 20 };
        let mut words = std::env::args().skip(1);
        while let Some(word) = words.next() {
            let number = |text: Option<String>| text.and_then(|text| text.parse().ok());
            match word.as_str() {
                "--steps" => arguments.steps = number(words.next()),
                "--every" => arguments.every = number(words.next()).unwrap_or(1),
                _ => arguments.names.push(word),
            }
        }
        arguments
    }

    /// The scenes that are asked for: all but one where none is named.
    fn scenes(&self) -> Result<Vec<&'static Entry>, UnknownScene> {
        if self.names.is_empty() {
            return Ok(all().iter().filter(|entry| entry.name != "circles_1m").collect());
        }
        let names = self.names.iter().map(|word| resolve(word)).collect::<Result<Vec<_>, _>>()?;
        names.into_iter().flatten().map(find).collect()
    }
}

/// Plays a scene in every way. Gives how many differ from the first.
fn compare(entry: &Entry, arguments: &Arguments) -> Result<usize, tiny_physics::Error> {
    let steps = arguments.steps.unwrap_or(entry.steps);
    let ways = Way::all();
    let expected = hashes(entry, steps, arguments.every, ways[0])?;
    let mut wrong = 0;
    for &way in &ways[1..] {
        if let Some(step) = parted(&expected, &hashes(entry, steps, arguments.every, way)?) {
            println!("{}: {way} differs from {} by step {step}", entry.name, ways[0]);
            wrong += 1;
        }
    }
    let last = expected.last().map_or(0, |last| last.1);
    println!("{} {steps} {last:016x}: {wrong} of {} ways differ", entry.name, ways.len() - 1);
    Ok(wrong)
}

fn main() -> ExitCode {
    let arguments = Arguments::read();
    let scenes = match arguments.scenes() {
        Ok(scenes) => scenes,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    let mut wrong = 0;
    for entry in scenes {
        wrong += compare(entry, &arguments).unwrap_or_else(|error| {
            println!("{}: {error}", entry.name);
            1
        });
    }
    if wrong == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
