//! What everything that is timed needs.

use super::run::Times;
use crate::args::BenchArgs;
use std::time::Instant;
use tiny_physics::SimdLevel;

/// The levels asked for; all that there are if none is named.
pub(super) fn levels(args: &BenchArgs) -> Vec<SimdLevel> {
    if args.simd.is_empty() { SimdLevel::available().collect() } else { args.simd.clone() }
}

/// Milliseconds since then.
pub(super) fn milliseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1000.0
}

/// The middle value; the lower of two.
pub(super) fn median(values: Vec<f64>) -> f64 {
    Times::of(values).median
}
