//! Golden hashes: what a scene's run must come to on every platform, SIMD level and number of threads.

use crate::{Entry, Options, Run};
use tiny_physics::{Error, Events, SimdLevel};

/// One line of a table of golden hashes.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Golden {
    /// Name of the scene, without spaces.
    pub name: String,
    /// Steps of the run.
    pub steps: u32,
    /// What it came to.
    pub hash: u64,
}

impl Golden {
    /// The lines of a table, `name steps hash` each; others are left out.
    pub fn read(table: &str) -> Vec<Self> {
        let line = |line: &str| {
            let mut words = line.split_whitespace();
            let (name, steps, hash) = (words.next()?, words.next()?, words.next()?);
            let hash = u64::from_str_radix(hash, 16).ok()?;
            Some(Self { name: name.to_owned(), steps: steps.parse().ok()?, hash })
        };
        table.lines().filter_map(line).collect()
    }
}

impl core::fmt::Display for Golden {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{} {} {:016x}", self.name, self.steps, self.hash)
    }
}

/// The golden hashes of the built-in scenes.
pub fn golden() -> Vec<Golden> {
    Golden::read(include_str!("../tests/golden.txt"))
}

/// Runs a scene and hashes its end, with the events on the way mixed in.
///
/// # Errors
/// The world refuses the scene, or this machine lacks the SIMD level.
pub fn run_hash(entry: &Entry, steps: u32, level: SimdLevel, threads: usize) -> Result<u64, Error> {
    let mut run = Run::start(&entry.build(Options::default()))?;
    run.world_mut().set_simd(level)?;
    run.world_mut().set_threads(threads);
    let mut hash = 0;
    for _ in 0..steps {
        run.step();
        hash = mix_events(hash, run.world().events());
    }
    Ok(hash ^ run.world().state_hash())
}

/// Contacts that began and ended, in their order.
fn mix_events(hash: u64, events: &Events) -> u64 {
    let ends = events.contact_end().iter().map(|end| (end.shape_a, end.shape_b));
    let begins = events.contact_begin().iter().map(|begin| (begin.shape_a, begin.shape_b));
    begins.chain(ends).fold(hash, |hash, (a, b)| {
        hash.rotate_left(5) ^ ((a.index() as u64) << 32 | b.index() as u64)
    })
}
