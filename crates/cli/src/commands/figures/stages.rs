//! Which stages cost more by body in larger worlds, and how much of their data goes through memory.

use super::{circles, how, print, print_head};
use crate::args::BenchArgs;
use crate::commands::timing::median;
use crate::failure::Outcome;
use crate::simulation::Simulation;
use serde::Serialize;
use std::collections::BTreeMap;
use std::io::Write;
use tiny_physics::Stage;

/// Steps of a run, the first one not timed.
const STEPS: u32 = 40;

/// Time and data of a step by body, in a pile of circles.
#[derive(Serialize)]
struct Row {
    figure: &'static str,
    bodies: usize,
    /// Contacts that touch, by body, after the last step.
    contacts_per_body: f64,
    /// Megabytes that the world uses.
    megabytes: f64,
    /// Nanoseconds of each stage by body.
    stage_ns: BTreeMap<&'static str, f64>,
    total_ns: f64,
    traffic: Traffic,
}

/// Bytes by body that the three stages with most of the work read and write in a step, counted from what they go
/// through: an estimate, with every byte counted as often as it is asked for, whether it comes from a cache or not.
///
/// The solver makes one pass over all contacts to warm start, and in each substep one a solver iteration and one
/// to relax. A contact of circles has one point; of its lanes, four bytes each, a pass reads
///
/// - warm start: 2 bodies, 2 of the normal, 4 lever arms, 2 impulses: 40 bytes;
/// - solve: 2 bodies, 2 of the normal, separation, 2 lever arms, mass, impulse, which is written back: 40 bytes;
/// - relax: the same, and friction with 2 lever arms, mass, impulse and load, of which two are written: 72 bytes;
///
/// and each pass gathers and scatters the rows of both bodies, 32 bytes each: 128 bytes. Integrating goes through a
/// body's row, its start (16 bytes) and its motion (32): 176 bytes to prepare, with what it reads of the body's
/// properties, and 128 for the velocity and 96 for the position in each substep.
///
/// The narrow phase reads and writes of each contact 36 bytes of its manifold and about 80 of its constraint, and
/// gathers pose (24), row and shape (32 each) of both bodies: 292 bytes. Finalising goes through a body's row,
/// poses, boxes, and a cache line each of its properties and its shape: 360 bytes.
#[derive(Serialize, Clone, Copy)]
struct Traffic {
    /// Bytes by body that lie one after the other.
    solve_in_order: f64,
    /// Bytes by body that are gathered from and scattered to bodies' rows.
    solve_gathered: f64,
    narrow_phase: f64,
    finalize: f64,
}

impl Traffic {
    fn new(contacts_per_body: f64, substeps: u32, iterations: u32) -> Self {
        let (substeps, iterations) = (f64::from(substeps), f64::from(iterations));
        let passes = 1.0 + substeps * (iterations + 1.0);
        let lanes = 40.0 + substeps * (iterations * 40.0 + 72.0);
        Self {
            solve_in_order: contacts_per_body * lanes + 176.0 + substeps * (128.0 + 96.0),
            solve_gathered: contacts_per_body * passes * 128.0,
            narrow_phase: contacts_per_body * 292.0,
            finalize: 360.0,
        }
    }
}

/// Measures and prints a row for each size.
pub fn run(args: &BenchArgs, out: &mut impl Write) -> Outcome {
    let steps = args.steps.unwrap_or(STEPS).max(2);
    let what = format!(
        "a pile of circles, {} steps: contacts by body, megabytes in use, nanoseconds by body and stage, and about \
         how many bytes by body go through the solver, in order and gathered",
        steps - 1
    );
    let stages = Stage::ALL.map(|stage| format!("{:>13}", stage.name())).concat();
    let names = format!("{:>10}{:>9}{:>8}{stages}{:>9}", "bodies", "contacts", "MB", "total");
    let sizes = ["in order", "gathered"].map(|name| format!("{name:>10}")).concat();
    print_head(out, args, &format!("{what}\n{names}{sizes}"))?;
    for &count in &args.bodies {
        let row = measure(args, count, steps)?;
        let stages =
            Stage::ALL.map(|stage| format!("{:>13.1}", row.stage_ns[stage.name()])).concat();
        let Row { bodies, contacts_per_body, megabytes, total_ns, traffic, .. } = &row;
        let sizes = [traffic.solve_in_order, traffic.solve_gathered];
        let sizes = sizes.map(|bytes| format!("{bytes:>10.0}")).concat();
        let text = format!(
            "{bodies:>10}{contacts_per_body:>9.2}{megabytes:>8.1}{stages}{total_ns:>9.1}{sizes}"
        );
        print(out, args, &row, &text)?;
    }
    Ok(())
}

/// Medians of some runs.
fn measure(args: &BenchArgs, count: u32, steps: u32) -> Outcome<Row> {
    let scene = circles(count)?;
    let mut runs = Vec::new();
    let mut end = None;
    for _ in 0..args.repeat {
        let mut simulation = Simulation::new(scene.clone(), &how(args))?;
        simulation.step();
        let mut seconds = [0.0; Stage::ALL.len()];
        for _ in 1..steps {
            simulation.step();
            let stats = simulation.world().stats();
            seconds
                .iter_mut()
                .zip(Stage::ALL)
                .for_each(|(sum, stage)| *sum += stats.seconds(stage));
        }
        let status = simulation.status();
        let each = f64::from(steps - 1) * status.moving as f64;
        runs.push(seconds.map(|seconds| seconds * 1.0e9 / each));
        end = Some((status, simulation.world().memory().total().used));
    }
    let (bodies, contacts, used) = end.map_or((0, 0, 0), |(s, used)| (s.moving, s.contacts, used));
    let contacts_per_body = contacts as f64 / bodies.max(1) as f64;
    let stages = (0..).zip(Stage::ALL);
    let middle = |i: usize| median(runs.iter().map(|run| run[i]).collect());
    let settings = scene.settings;
    Ok(Row {
        figure: "stages",
        bodies,
        contacts_per_body,
        megabytes: used as f64 * 1.0e-6,
        stage_ns: stages.map(|(i, stage)| (stage.name(), middle(i))).collect(),
        total_ns: median(runs.iter().map(|run| run.iter().sum()).collect()),
        traffic: Traffic::new(contacts_per_body, settings.substeps, settings.iterations),
    })
}
