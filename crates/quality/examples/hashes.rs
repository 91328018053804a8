//! Prints the golden hashes of all scenes and quality rows as this platform computes them, for each SIMD level that
//! it has and each number of threads: `hashes [--quick] [THREADS...]`. `scripts/platforms.sh` compares.
//!
//! A line is `level threads name steps hash`. With `--quick` only the best level runs.

use std::io::{Write, stdout};
use tiny_physics::SimdLevel;
use tiny_physics_quality as quality;
use tiny_physics_scenes as scenes;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let quick = arguments.iter().any(|argument| argument == "--quick");
    let mut threads: Vec<usize> = arguments.iter().filter_map(|word| word.parse().ok()).collect();
    if threads.is_empty() {
        threads.push(1);
    }
    let best = SimdLevel::detect();
    for level in SimdLevel::available().filter(|&level| !quick || level == best) {
        for &threads in &threads {
            print(level, threads)?;
        }
    }
    Ok(())
}

fn print(level: SimdLevel, threads: usize) -> Result<(), Box<dyn std::error::Error>> {
    let mut out = stdout().lock();
    for mut line in scenes::golden() {
        line.hash = scenes::run_hash(scenes::find(&line.name)?, line.steps, level, threads)?;
        writeln!(out, "{level} {threads} {line}")?;
    }
    for row in quality::rows() {
        writeln!(out, "{level} {threads} {}", quality::row_hash(row, level, threads))?;
    }
    Ok(())
}
