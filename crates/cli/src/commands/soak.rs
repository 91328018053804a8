//! `soak`: a very long run in which everything comes and goes.

use crate::args::SoakArgs;
use crate::failure::{Failure, Outcome};
use std::fs;
use std::io::{Write, stdout};
use std::time::Instant;
use tiny_physics_scenes::Churn;

/// Lines of the table.
const LINES: u64 = 20;

/// Runs it and prints a line now and then.
///
/// # Errors
/// The world's data are unsound, or it refuses what it should take.
pub fn run(args: &SoakArgs) -> Outcome {
    let mut churn = Churn::new(args.world.seed)?;
    churn.world_mut().set_threads(usize::from(args.world.threads));
    if let Some(level) = args.world.simd {
        churn.world_mut().set_simd(level)?;
    }
    let mut out = stdout().lock();
    writeln!(
        out,
        "{:>9} {:>6} {:>6} {:>6} {:>8} {:>6} {:>9} {:>11} {:>10}",
        "step", "bodies", "shapes", "joints", "contacts", "awake", "us/step", "memory, kB", "came"
    )?;
    let (mut clock, mut counted, mut checks) = (Clock::start(), 0, 0);
    for step in 1..=args.steps {
        churn.step().map_err(|error| {
            let sound =
                churn.world().validate().err().unwrap_or_else(|| "its data are sound".into());
            Failure::new(format!("step {step}: {error}")).hint(format!("the world: {sound}"))
        })?;
        if step.is_multiple_of(args.check) {
            let sound = churn.world().validate();
            sound.map_err(|reason| Failure::new(format!("unsound after step {step}: {reason}")))?;
            checks += 1;
        }
        if step * LINES / args.steps != (step - 1) * LINES / args.steps {
            let each = clock.lap() / (step - counted) as f64;
            counted = step;
            print_line(&mut out, &churn, step, each)?;
        }
    }
    let made = churn.counts();
    writeln!(
        out,
        "{} bodies, {} shapes and {} joints came, {} frames were passed through",
        made.bodies, made.shapes, made.joints, made.frames
    )?;
    writeln!(out, "{checks} checks found all data sound")?;
    writeln!(out, "hash {:016x}", churn.world().state_hash())?;
    Ok(())
}

fn print_line(out: &mut impl Write, churn: &Churn, step: u64, seconds: f64) -> Outcome {
    let (world, made) = (churn.world(), churn.counts());
    let memory = memory_kb().map_or("?".into(), |kb| kb.to_string());
    writeln!(
        out,
        "{step:>9} {:>6} {:>6} {:>6} {:>8} {:>6} {:>9.2} {memory:>11} {:>10}",
        world.body_count(),
        world.shape_count(),
        world.joint_count(),
        world.contact_count(),
        world.awake_body_count(),
        seconds * 1.0e6,
        made.bodies + made.shapes + made.joints
    )?;
    out.flush()?;
    Ok(())
}

/// Time that this thread has worked, or simply time where the system does not say.
struct Clock {
    start: Instant,
    last: f64,
}

impl Clock {
    fn start() -> Self {
        let mut clock = Self { start: Instant::now(), last: 0.0 };
        clock.last = clock.now();
        clock
    }

    fn now(&self) -> f64 {
        worked().unwrap_or_else(|| self.start.elapsed().as_secs_f64())
    }

    /// Seconds since the last lap.
    fn lap(&mut self) -> f64 {
        let now = self.now();
        now - std::mem::replace(&mut self.last, now)
    }
}

/// CPU seconds of this thread; Linux only.
fn worked() -> Option<f64> {
    let text = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(1.0e-9 * nanoseconds)
}

/// Memory that the process holds, in units of 1024 bytes; Linux only.
pub(super) fn memory_kb() -> Option<u64> {
    let text = fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.split_whitespace().next()?.parse().ok()
}
