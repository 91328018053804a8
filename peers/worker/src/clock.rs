//! Clocks and the statistics of what they show.

use rustix::time::{ClockId, clock_gettime};
use std::time::Instant;

/// Readings of which the median is what a reading costs.
const READINGS: usize = 1001;

/// CPU and wall time spent since a start.
pub struct Stopwatch {
    cpu_s: f64,
    wall: Instant,
}

impl Stopwatch {
    /// Starts now.
    pub fn start() -> Self {
        Self { cpu_s: process_cpu_s(), wall: Instant::now() }
    }

    /// Milliseconds since the start: CPU time of the whole process, wall time.
    pub fn elapsed_ms(&self) -> (f64, f64) {
        let wall_ms = self.wall.elapsed().as_secs_f64() * 1e3;
        ((process_cpu_s() - self.cpu_s) * 1e3, wall_ms)
    }

    /// What it shows where nothing is done, milliseconds: CPU and wall time of its own reading, half a microsecond and less. A
    /// step of a small world takes no more than a few times as long.
    pub fn own_ms() -> (f64, f64) {
        let (cpu, wall): (Vec<f64>, Vec<f64>) =
            (0..READINGS).map(|_| Self::start().elapsed_ms()).unzip();
        (percentile(&cpu, 0.5), percentile(&wall, 0.5))
    }
}

/// CPU time of this process, all threads, seconds.
pub(crate) fn process_cpu_s() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

/// Greatest resident memory of this process so far, mebibytes; 0 where the system does not tell.
pub fn peak_mib() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap_or_default();
    let kib: f64 = line.trim().trim_end_matches(" kB").parse().unwrap_or_default();
    kib / 1024.0
}

/// The mean; 0 of nothing.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// The value that a part of all values (0.5: the median) is not above; 0 of nothing. Between two
/// values of an even number the median is the lower.
pub fn percentile(values: &[f64], part: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let rank = (part * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.saturating_sub(1)).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles() {
        let values: Vec<f64> = (1..=100).rev().map(f64::from).collect();
        assert_eq!(percentile(&values, 0.5), 50.0);
        assert_eq!(percentile(&values, 0.99), 99.0);
        assert_eq!(percentile(&values, 1.0), 100.0);
        assert_eq!(percentile(&[7.0], 0.99), 7.0);
        assert_eq!(percentile(&[], 0.5), 0.0);
        assert_eq!(mean(&values), 50.5);
    }

    #[test]
    fn reading_costs_little() {
        let (cpu_ms, wall_ms) = Stopwatch::own_ms();
        assert!((0.0..0.1).contains(&cpu_ms) && (0.0..0.1).contains(&wall_ms));
    }

    #[test]
    fn cpu_time_passes() {
        let watch = Stopwatch::start();
        let mut x = 1.0_f64;
        while watch.elapsed_ms().0 < 2.0 {
            x = (x + 1.0).sqrt();
        }
        assert!(x > 1.0 && watch.elapsed_ms().1 >= 1.0);
    }
}
