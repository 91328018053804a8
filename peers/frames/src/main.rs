//! What it costs to save and restore a world of 10,000 boxes that touch, beside a plain copy of as many bytes, in
//! tiny-physics and in Rapier: `cargo run --release --manifest-path peers/Cargo.toml -p peer-frames`.
//!
//! Rounds are interleaved, and the fastest of each counts.

mod ours;
mod rapier;

use std::hint::black_box;
use std::time::Instant;

/// Boxes of 1 m in columns.
const COLUMNS: usize = 200;
const ROWS: usize = 50;
const BODIES: usize = COLUMNS * ROWS;
/// Steps before anything is measured.
const STEPS: usize = 20;
const ROUNDS: usize = 40;

/// Centres of the boxes, row by row.
fn places() -> impl Iterator<Item = (f32, f32)> {
    (0..BODIES).map(|i| ((i % COLUMNS) as f32 - 0.5 * COLUMNS as f32, 0.5 + (i / COLUMNS) as f32))
}

/// An engine's ways of saving, one after the other.
trait Saver {
    /// How many bytes a saved frame has.
    fn frame_bytes(&self) -> usize;
    /// Ways, by name.
    fn ways(&self) -> Vec<&'static str>;
    /// Does one of them.
    fn run(&mut self, way: usize);
}

/// Copies so many bytes there and back: the least that saving and restoring can cost.
struct Copy {
    from: Vec<u8>,
    to: Vec<u8>,
}

impl Saver for Copy {
    fn frame_bytes(&self) -> usize {
        self.from.len()
    }

    fn ways(&self) -> Vec<&'static str> {
        vec!["copy there and back"]
    }

    fn run(&mut self, _: usize) {
        self.to.copy_from_slice(black_box(&self.from));
        self.from.copy_from_slice(black_box(&self.to));
    }
}

fn main() {
    let (ours, rapier) = (ours::Ours::new(), rapier::Rapier::new());
    println!("{BODIES} boxes; contacts: {} ours, {} Rapier", ours.contacts(), rapier.contacts());
    let copy = |bytes: usize| Copy { from: vec![1; bytes], to: vec![2; bytes] };
    let (a, b) = (copy(ours.frame_bytes()), copy(rapier.frame_bytes()));
    let mut savers: [(&str, Box<dyn Saver>); 4] = [
        ("memory, our size", Box::new(a)),
        ("tiny-physics", Box::new(ours)),
        ("memory, Rapier's size", Box::new(b)),
        ("Rapier", Box::new(rapier)),
    ];
    let mut best: Vec<Vec<f64>> =
        savers.iter().map(|(_, saver)| vec![f64::INFINITY; saver.ways().len()]).collect();
    for _ in 0..ROUNDS {
        for ((_, saver), best) in savers.iter_mut().zip(&mut best) {
            for (way, best) in best.iter_mut().enumerate() {
                let start = Instant::now();
                saver.run(way);
                *best = best.min(start.elapsed().as_secs_f64() * 1.0e3);
            }
        }
    }
    println!("{:22} {:28} {:>12} {:>9}", "who", "what", "bytes a body", "ms");
    for ((name, saver), best) in savers.iter().zip(&best) {
        let bytes = saver.frame_bytes() as f64 / BODIES as f64;
        for (way, ms) in saver.ways().iter().zip(best) {
            println!("{name:22} {way:28} {bytes:12.0} {ms:9.3}");
        }
    }
}
