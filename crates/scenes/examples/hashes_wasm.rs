//! The golden hashes for WebAssembly, which has no output of its own: `scripts/hashes.mjs` asks for the lines
//! one by one.
#![allow(unsafe_code, reason = "an exported name counts as unsafe")]

#[path = "../tests/common/golden.rs"]
mod common;

use tiny_physics::SimdLevel;
use tiny_physics_scenes::find;

/// The hash of the scene in a line of the table; 0 past its end.
#[unsafe(no_mangle)]
pub extern "C" fn golden_hash(line: u32) -> u64 {
    let line = include_str!("../tests/golden.txt").lines().nth(line as usize);
    let mut words = line.unwrap_or_default().split_whitespace();
    let (Some(name), Some(Ok(steps))) = (words.next(), words.next().map(str::parse)) else {
        return 0;
    };
    let entry = find(name).expect("golden.txt names scenes");
    common::hash(entry, steps, SimdLevel::detect(), 1)
}
