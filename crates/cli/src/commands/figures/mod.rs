//! `bench --figures`: what scenes alone do not show. What should cost next to nothing, and does it? What does a
//! body take of memory, what do adding and removing take, and why does a body cost more among more?

mod bandwidth;
mod changes;
mod memory;
mod rest;
mod stages;

use super::timing::levels;
use crate::args::{BenchArgs, Figure, WorldArgs};
use crate::failure::{Failure, Outcome};
use serde::Serialize;
use std::io::{Write, stdout};
use tiny_physics::SimdLevel;
use tiny_physics_scenes::{Options, Scene, find};

/// Measures and prints the figures asked for.
///
/// # Errors
/// A world that does not fall asleep, a scene that the engine refuses, or standard output's.
pub fn run(args: &BenchArgs) -> Outcome {
    let mut out = stdout().lock();
    let asked = |figure: Figure| args.figures.iter().any(|&it| it == figure || it == Figure::All);
    if asked(Figure::Rest) {
        rest::run(args, &mut out)?;
    }
    if asked(Figure::Memory) {
        memory::run(args, &mut out)?;
    }
    if asked(Figure::Changes) {
        changes::run(args, &mut out)?;
    }
    if asked(Figure::Stages) {
        stages::run(args, &mut out)?;
    }
    if asked(Figure::Bandwidth) {
        bandwidth::run(args, &mut out)?;
    }
    Ok(())
}

/// How the worlds of a figure run that has no use for several levels: on the last level asked for.
fn how(args: &BenchArgs) -> WorldArgs {
    at_level(levels(args).last().copied(), args)
}

fn at_level(simd: Option<SimdLevel>, args: &BenchArgs) -> WorldArgs {
    WorldArgs { seed: 1, threads: args.threads, simd }
}

/// A built-in scene of some size; 0 is its own.
fn built_in(name: &str, size: u32) -> Outcome<Scene> {
    let entry = find(name).map_err(|error| Failure::new(error.to_string()))?;
    let size = (size > 0).then_some(size);
    Ok(entry.build(Options { size, ..Options::default() }))
}

/// Circles in a pile.
fn circles(count: u32) -> Outcome<Scene> {
    built_in("circles_1m", count)
}

/// Prints a row of a figure: an object, or its text.
fn print(out: &mut impl Write, args: &BenchArgs, row: &impl Serialize, text: &str) -> Outcome {
    if args.json {
        writeln!(out, "{}", serde_json::to_string(row)?)?;
    } else {
        writeln!(out, "{text}")?;
    }
    out.flush()?;
    Ok(())
}

/// Prints the head of a table, but not between rows of JSON.
fn print_head(out: &mut impl Write, args: &BenchArgs, text: &str) -> Outcome {
    if !args.json {
        writeln!(out, "\n{text}")?;
    }
    Ok(())
}
