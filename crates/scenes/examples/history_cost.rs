//! What going back costs: `cargo run --release -p tiny-physics-scenes --example history_cost [STEPS]`. A run of that many steps
//! (ten minutes where not said) is kept in 64 MB; then steps from all over it are gone to, and their state is compared.
//! Times are those of the processor, so that other programs hardly count; of the wall where there is no such clock.

use std::error::Error;
use std::time::Instant;
use tiny_physics_scenes::{Options, Tape, find};

const BUDGET: usize = 64_000_000;
const SEEKS: usize = 40;

/// Seconds of the processor that this thread has had.
fn now(start: Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = text.split(' ').next().and_then(|word| word.parse::<f64>().ok());
    nanoseconds.map_or(start.elapsed().as_secs_f64(), |nanoseconds| nanoseconds * 1e-9)
}

fn main() -> Result<(), Box<dyn Error>> {
    let begin = Instant::now();
    let steps: usize = std::env::args().nth(1).unwrap_or("36000".into()).parse()?;
    println!("scene            bodies  delta/moving  kept MB  step ms  seek ms: median  most");
    for (name, size) in [("tumbler", 22), ("seed_pile_1000", 500), ("ragdoll", 0), ("character", 0)]
    {
        let mut scene = find(name)?.build(match size {
            0 => Options::default(),
            size => Options::default().size(size),
        });
        scene.settings.sleep = false;
        let mut tape = Tape::of_scene(&scene, BUDGET)?;
        let start = now(begin);
        let mut delta = 0.0;
        for step in 1..=steps {
            let before = (step % 1000 == 300).then(|| tape.world().to_bytes());
            tape.step();
            if let Some(before) = before {
                let moving = tape.world().awake_body_count() as f64;
                delta = tape.world().delta_from(&before).len() as f64 / moving;
            }
        }
        let each = (now(begin) - start) * 1e3 / steps as f64;
        let mut seeks = Vec::new();
        for i in 0..SEEKS {
            let step = (i * 7919 + 31) * 104_729 % (steps + 1);
            let start = now(begin);
            tape.go_to(step)?;
            seeks.push((now(begin) - start) * 1e3);
            let hash = tape.world().state_hash();
            assert!(step == 0 || tape.history().recording().hash(step) == Some(hash), "other bits");
        }
        seeks.sort_by(f64::total_cmp);
        println!(
            "{name:<16} {:>6} {delta:>13.0} {:>8.1} {each:>8.3} {:>16.1} {:>5.1}",
            scene.bodies.len(),
            tape.history().bytes() as f64 / 1e6,
            seeks[SEEKS / 2],
            seeks[SEEKS - 1],
        );
    }
    Ok(())
}
