//! What steps cost on a machine that others use too: `step_cost [repeats] [steps] SCENE...`.
//!
//! Every run of a scene does the same work, so of each step the least over all runs counts. Prints the mean of a step,
//! the 99th percentile and the worst of a whole run, and until when bodies were awake; and what a frame costs.

use std::hint::black_box;
use std::time::Instant;
use tiny_physics_scenes::{Options, Run, Scene, find, resolve};

fn main() {
    let (mut repeats, mut steps, mut names) = (None, None, Vec::new());
    for argument in std::env::args().skip(1) {
        match argument.parse::<u32>() {
            Ok(number) if repeats.is_none() => repeats = Some(number),
            Ok(number) => steps = Some(number),
            Err(_) => names.extend(resolve(&argument).expect("a scene or a tag")),
        }
    }
    println!(
        "{:22}{:>10}{:>10}{:>10}{:>10}{:>9}{:>10}{:>9}",
        "scene", "total ms", "mean us", "p99 us", "worst us", "awake", "clone us", "bytes"
    );
    for name in names {
        let mut scene = find(name).expect("a scene").build(Options::default());
        scene.steps = steps.unwrap_or(scene.steps);
        print_scene(&scene, repeats.unwrap_or(5));
    }
}

fn print_scene(scene: &Scene, repeats: u32) {
    let mut least = vec![f64::INFINITY; scene.steps as usize];
    let (mut awake_until, mut frame) = (0, (0.0, 0));
    for _ in 0..repeats {
        let mut run = Run::start(scene).expect("a scene that the world takes");
        awake_until = 0;
        for (i, least) in least.iter_mut().enumerate() {
            let start = Instant::now();
            run.step();
            *least = least.min(start.elapsed().as_secs_f64() * 1.0e6);
            if run.world().awake_body_count() > 0 {
                awake_until = i + 1;
            }
        }
        frame = frame_cost(&run);
    }
    let total: f64 = least.iter().sum();
    let mut sorted = least.clone();
    sorted.sort_by(f64::total_cmp);
    let p99 = sorted[(sorted.len() * 99).div_ceil(100) - 1];
    println!(
        "{:22}{:10.3}{:10.2}{:10.2}{:10.2}{:9}{:10.2}{:9}",
        scene.name,
        total * 1.0e-3,
        total / least.len() as f64,
        p99,
        sorted[sorted.len() - 1],
        awake_until,
        frame.0,
        frame.1,
    );
}

/// Microseconds of a `clone_from`, and bytes of a frame.
fn frame_cost(run: &Run) -> (f64, usize) {
    let mut copy = run.world().clone();
    let mut time = || {
        let start = Instant::now();
        copy.clone_from(black_box(run.world()));
        start.elapsed().as_secs_f64() * 1.0e6
    };
    ((0..100).map(|_| time()).fold(f64::INFINITY, f64::min), run.world().to_bytes().len())
}
