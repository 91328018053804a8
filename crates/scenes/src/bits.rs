//! The same bits over whole runs: a scene played in several ways that must not matter, compared as it goes.

use crate::{Entry, Options, Run};
use core::fmt;
use tiny_physics::{Error, SimdLevel};

/// A way of playing a scene that must not change its bits.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Way {
    /// One SIMD level and number of threads for the whole run.
    Steady(SimdLevel, usize),
    /// Another level and another number of threads every few steps.
    Changing,
}

/// Steps that [`Way::Changing`] stays with a level and a number of threads: no multiple of anything in the engine.
const STAY: u32 = 7;

impl Way {
    /// The ways that this machine has: every level on one thread, the best one on two and three, and changing ones.
    /// The first is the one to compare with.
    pub fn all() -> Vec<Self> {
        let best = SimdLevel::detect();
        let others = SimdLevel::available().filter(|&level| level != best);
        let mut ways: Vec<_> =
            core::iter::once(best).chain(others).map(|level| Self::Steady(level, 1)).collect();
        ways.extend([Self::Steady(best, 2), Self::Steady(best, 3), Self::Changing]);
        ways
    }

    /// Level and number of threads at a step.
    fn at(self, step: u32) -> (SimdLevel, usize) {
        match self {
            Self::Steady(level, threads) => (level, threads),
            Self::Changing => {
                let levels: Vec<_> = SimdLevel::available().collect();
                let turn = (step / STAY) as usize;
                // Three numbers of threads against any number of levels: every pair comes by.
                (levels[turn % levels.len()], 1 + turn / levels.len() % 3)
            }
        }
    }
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Steady(level, threads) => write!(f, "{level}, {threads} threads"),
            Self::Changing => f.write_str("levels and threads in turn"),
        }
    }
}

/// Hashes of a scene's run every `interval` steps and at its end, with the step of each.
///
/// # Errors
/// The world refuses the scene, or this machine lacks the SIMD level.
pub fn hashes(
    entry: &Entry,
    steps: u32,
    interval: u32,
    way: Way,
) -> Result<Vec<(u32, u64)>, Error> {
    let mut run = Run::start(&entry.build(Options::default()))?;
    let mut hashes = Vec::new();
    for step in 0..steps {
        let (level, threads) = way.at(step);
        run.world_mut().set_simd(level)?;
        run.world_mut().set_threads(threads);
        run.step();
        if (step + 1) % interval.max(1) == 0 || step + 1 == steps {
            hashes.push((step + 1, run.world().state_hash()));
        }
    }
    Ok(hashes)
}

/// The first step by which two runs differ.
pub fn parted(a: &[(u32, u64)], b: &[(u32, u64)]) -> Option<u32> {
    a.iter().zip(b).find(|(a, b)| a != b).map(|(a, _)| a.0)
}
