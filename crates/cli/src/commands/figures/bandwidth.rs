//! What the machine's memory gives: how fast plain code reads and writes one after the other, and lines anywhere.

use super::{print, print_head};
use crate::args::BenchArgs;
use crate::commands::timing::median;
use crate::failure::Outcome;
use serde::Serialize;
use std::hint::black_box;
use std::io::Write;
use std::time::Instant;

/// Bytes that a measurement goes through at least.
const LEAST: usize = 256 << 20;

/// Eight numbers on a cache line of their own.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Line([u64; 8]);

const LINE: usize = size_of::<Line>();

/// What memory of one size gives, on one thread, with plain code for any processor.
#[derive(Serialize)]
struct Row {
    figure: &'static str,
    /// Size of the memory that is gone through, 2^20 bytes.
    mebibytes: u32,
    /// Reading all of it in order, 10^9 bytes a second.
    read_gb: f64,
    /// Reading and writing all of it in order; both count.
    update_gb: f64,
    /// Reading lines of 64 bytes anywhere in it, none of which depends on another, nanoseconds each.
    gather_ns: f64,
    /// The same in 10^9 bytes a second.
    gather_gb: f64,
}

/// Measures and prints a row for each size.
pub fn run(args: &BenchArgs, out: &mut impl Write) -> Outcome {
    let what = "memory on one thread: GB/s in order, read, and read and written; 64-byte lines anywhere, ns and GB/s";
    let names = ["MiB", "read", "update", "gather ns", "gather"];
    let names = names.map(|name| format!("{name:>12}")).concat();
    print_head(out, args, &format!("{what}\n{names}"))?;
    for &mebibytes in &args.mebibytes {
        let row = measure(mebibytes, args.repeat);
        let Row { read_gb, update_gb, gather_ns, gather_gb, .. } = row;
        let text = format!(
            "{mebibytes:>12}{read_gb:>12.1}{update_gb:>12.1}{gather_ns:>12.2}{gather_gb:>12.1}"
        );
        print(out, args, &row, &text)?;
    }
    Ok(())
}

/// Medians of some runs.
fn measure(mebibytes: u32, repeat: u16) -> Row {
    let count = (mebibytes as usize) << 20;
    let mut lines = vec![Line([1; 8]); count / LINE];
    let passes = LEAST.div_ceil(count);
    let mut runs: [Vec<f64>; 3] = Default::default();
    for _ in 0..repeat {
        runs[0].push(seconds(passes, || _ = black_box(read(black_box(&lines)))));
        runs[1].push(seconds(passes, || update(black_box(&mut lines))));
        runs[2].push(seconds(passes, || _ = black_box(gather(black_box(&lines)))));
    }
    let [read, update, gather] = runs.map(median);
    let gb = count as f64 * 1.0e-9;
    Row {
        figure: "bandwidth",
        mebibytes,
        read_gb: gb / read,
        update_gb: 2.0 * gb / update,
        gather_ns: gather * 1.0e9 / (count / LINE) as f64,
        gather_gb: gb / gather,
    }
}

/// Seconds of one of so many passes.
fn seconds(passes: usize, mut pass: impl FnMut()) -> f64 {
    let start = Instant::now();
    (0..passes).for_each(|_| pass());
    start.elapsed().as_secs_f64() / passes as f64
}

fn add(mut sum: [u64; 8], line: &Line) -> [u64; 8] {
    sum.iter_mut().zip(line.0).for_each(|(sum, number)| *sum = sum.wrapping_add(number));
    sum
}

fn read(lines: &[Line]) -> [u64; 8] {
    lines.iter().fold([0; 8], add)
}

fn update(lines: &mut [Line]) {
    lines.iter_mut().for_each(|line| line.0 = add(line.0, &Line([1; 8])));
}

/// Reads as many lines as there are, each at a place that chance decides.
fn gather(lines: &[Line]) -> [u64; 8] {
    let (mut state, mut sum) = (1_u64, [0; 8]);
    for _ in 0..lines.len() {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let place = ((state >> 32) * lines.len() as u64) >> 32;
        sum = add(sum, &lines[place as usize]);
    }
    sum
}
