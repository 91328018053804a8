//! `demo`: a scene in letters, in the terminal or printed.

use super::player;
use crate::args::DemoArgs;
use crate::failure::Outcome;
use crate::simulation::Simulation;
use crate::text_frame;
use std::io::{IsTerminal, Write, stdin, stdout};
use tiny_physics_draw::TextView;

/// Size of printed frames, letters.
const COLUMNS: usize = 80;
const ROWS: usize = 24;
/// Printed frames: these steps, and the last.
const FRAMES: [u64; 4] = [0, 45, 90, 150];
/// An overlap that is seen, metres.
const DEEP: f32 = 0.01;
/// Steps at most; it ends earlier when everything sleeps.
const MOST_STEPS: u64 = 1800;

/// Plays the scene: with keys in a terminal, else by itself.
///
/// # Errors
/// No such scene, or the terminal's.
pub fn run(args: &DemoArgs) -> Outcome {
    let terminal = stdin().is_terminal() && stdout().is_terminal();
    if terminal && !args.plain {
        return player::run(args);
    }
    let simulation = player::open(args, args.seed)?;
    print_frames(&mut stdout().lock(), simulation, args)
}

fn print_frames(out: &mut impl Write, mut simulation: Simulation, args: &DemoArgs) -> Outcome {
    let framing = simulation.framing();
    let mut view = TextView::new(COLUMNS, ROWS);
    let (mut deepest, mut deep) = (0.0_f32, 0);
    let mut print = |simulation: &Simulation| -> Outcome {
        text_frame::draw(&mut view, simulation, &framing);
        writeln!(out, "--- {}", simulation.status())?;
        for line in view.to_lines() {
            writeln!(out, "{line}")?;
        }
        Ok(writeln!(out)?)
    };
    loop {
        let status = simulation.status();
        let at_rest = status.awake == 0 && status.moving > 0;
        let last = at_rest || status.frame >= MOST_STEPS;
        if last || FRAMES.contains(&status.frame) {
            print(&simulation)?;
        }
        if last {
            break;
        }
        simulation.step();
        let depth = simulation.world().max_penetration();
        deepest = deepest.max(depth);
        deep += u64::from(depth > DEEP);
    }
    let status = simulation.status();
    let seconds = status.frame as f32 * simulation.dt();
    let rest = if status.awake == 0 {
        format!("all {} bodies came to rest and sleep", status.moving)
    } else {
        format!("{} of {} bodies are still awake", status.awake, status.moving)
    };
    writeln!(
        out,
        "{} seed {}: {rest} after {} frames ({seconds:.1} s).",
        args.scene, args.seed, status.frame
    )?;
    writeln!(
        out,
        "Overlaps: {:.1} mm now; on the way over {:.0} mm in {deep} frames, where they hit hardest {:.1} mm. State {:016x}.",
        simulation.overlap() * 1000.0,
        DEEP * 1000.0,
        deepest * 1000.0,
        simulation.world().state_hash()
    )?;
    writeln!(
        out,
        "In a terminal it plays frame by frame; 'tiny-physics help' shows what else there is."
    )?;
    Ok(())
}
