//! Records a built-in scene and prints the state hash of its end: `record_scene NAME STEPS FILE`.

use std::error::Error;
use tiny_physics_scenes::{Options, Tape, find};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [name, steps, file] = &arguments[..] else {
        return Err("record_scene NAME STEPS FILE".into());
    };
    let mut tape = Tape::of_scene(&find(name)?.build(Options::default()), 0)?;
    (0..steps.parse()?).for_each(|_: u32| tape.step());
    std::fs::write(file, tape.history().recording().to_bytes())?;
    println!("{:016x}", tape.world().state_hash());
    Ok(())
}
