//! The golden hashes for WebAssembly, which has no output of its own: `scripts/hashes.mjs` asks for the lines
//! one by one: those of the scenes, then those of the quality rows.
#![allow(unsafe_code, reason = "an exported name counts as unsafe")]

use tiny_physics::SimdLevel;
use tiny_physics_quality as quality;
use tiny_physics_scenes as scenes;

/// The hash of the scene or row in a line of the tables; 0 past their end and where there is no such scene.
#[unsafe(no_mangle)]
pub extern "C" fn golden_hash(line: u32) -> u64 {
    let (line, best) = (line as usize, SimdLevel::detect());
    let table = scenes::golden();
    let Some(golden) = table.get(line) else {
        let row = quality::rows().get(line - table.len());
        return row.map_or(0, |row| quality::row_hash(row, best, 1).hash);
    };
    let hash = |entry| scenes::run_hash(entry, golden.steps, best, 1).ok();
    scenes::find(&golden.name).ok().and_then(hash).unwrap_or(0)
}
