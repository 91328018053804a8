//! The state hash of built-in scenes after some steps, a line each: `state_hashes 300 [name...]`. All but the largest
//! where no name is given. Other builds are compared with it.

use std::error::Error;
use tiny_physics_scenes::{Options, Run, all, find};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let steps: u32 = arguments.next().unwrap_or("300".into()).parse()?;
    let mut names: Vec<String> = arguments.collect();
    if names.is_empty() {
        let names_of_all = all().iter().map(|entry| entry.name.to_owned());
        names = names_of_all.filter(|name| name != "circles_1m").collect();
    }
    for name in names {
        let mut run = Run::start(&find(&name)?.build(Options::default()))?;
        (0..steps).for_each(|_| run.step());
        println!("{name} {:016x}", run.world().state_hash());
    }
    Ok(())
}
