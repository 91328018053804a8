//! What watching costs beside a step: `cost [STEPS] SCENE...`.
//!
//! Steps and looks take turns in one run, so that a noisy machine slows both. Prints milliseconds a step of each, the part
//! in per cent, and the bytes that the doctor holds. On a very noisy machine count instructions instead:
//!
//! ```sh
//! valgrind --tool=callgrind --callgrind-out-file=target/cost.out target/release/examples/cost 200 game
//! callgrind_annotate --inclusive=yes target/cost.out | grep 'cost::\(make_step\|watch\)'
//! ```

use std::time::{Duration, Instant};
use tiny_physics_doctor::Doctor;
use tiny_physics_scenes::{Options, Run, find, resolve};

fn main() {
    let (mut steps, mut names) = (None, Vec::new());
    for argument in std::env::args().skip(1) {
        match argument.parse::<u32>() {
            Ok(number) => steps = Some(number),
            Err(_) => names.extend(resolve(&argument).expect("a scene or a tag")),
        }
    }
    println!("{:22}{:>10}{:>10}{:>8}{:>10}", "scene", "step ms", "watch ms", "%", "bytes");
    for name in names {
        print_cost(name, steps);
    }
}

fn print_cost(name: &str, steps: Option<u32>) {
    let scene = find(name).expect("a scene").build(Options::default());
    let steps = steps.unwrap_or(scene.steps);
    let mut run = Run::start(&scene).expect("a scene that the world takes");
    let mut doctor = Doctor::new();
    let (mut stepping, mut watching) = (Duration::ZERO, Duration::ZERO);
    for _ in 0..steps {
        let start = Instant::now();
        make_step(&mut run);
        let middle = Instant::now();
        watch(&mut doctor, &run);
        stepping += middle - start;
        watching += middle.elapsed();
    }
    let each = |time: Duration| 1000.0 * time.as_secs_f64() / f64::from(steps);
    let part = 100.0 * watching.as_secs_f64() / stepping.as_secs_f64();
    let bytes = doctor.memory();
    println!("{name:22}{:>10.4}{:>10.4}{part:>8.2}{bytes:>10}", each(stepping), each(watching));
}

#[inline(never)]
fn make_step(run: &mut Run) {
    run.step();
}

#[inline(never)]
fn watch(doctor: &mut Doctor, run: &Run) {
    doctor.watch(run.world());
}
