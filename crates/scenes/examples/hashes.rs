//! Prints the golden hashes of all scenes as this platform computes them: `scripts/platforms.sh` compares.

#[path = "../tests/common/golden.rs"]
mod common;

use tiny_physics::SimdLevel;
use tiny_physics_scenes::find;

fn main() {
    for line in include_str!("../tests/golden.txt").lines() {
        let mut words = line.split_whitespace();
        if let (Some(name), Some(Ok(steps))) = (words.next(), words.next().map(str::parse)) {
            let entry = find(name).expect("golden.txt names scenes");
            println!("{name} {steps} {:016x}", common::hash(entry, steps, SimdLevel::detect(), 1));
        }
    }
}
