//! `quality`: scenes whose right answer is known, and what the engine makes of them.

use crate::args::QualityArgs;
use crate::failure::{Failure, Outcome};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;
use std::io::{IsTerminal, Write, stderr, stdout};
use std::time::{Duration, Instant};
use tiny_physics_quality::{
    PEERS_COMMAND, PeerMeasure, Peers, Report, Row, Variant, all_rows, our_engine, resolve, table,
};

/// Plays the rows and prints the table.
///
/// # Errors
/// No such row, or standard output's.
pub fn run(args: &QualityArgs) -> Outcome {
    let chosen = choose(&args.rows)?;
    let variant = if args.variant { Variant::Other } else { Variant::Usual };
    let peers = Peers::recorded()?;
    let mut out = stdout().lock();
    let mut reports = Vec::new();
    if !args.json {
        writeln!(out, "{}", table::line(&table::HEADER))?;
    }
    for row in chosen {
        let report = play(row, variant, args.awake);
        if !args.json {
            for cells in table::cells(&report, &peers.beside(variant, &report)) {
                writeln!(out, "{}", table::line(&cells))?;
            }
        }
        reports.push(report);
    }
    if args.json {
        let rows: Vec<_> = reports.iter().map(|r| JsonRow::new(r, &peers, variant)).collect();
        serde_json::to_writer_pretty(&mut out, &rows)?;
        writeln!(out)?;
        return Ok(());
    }
    print_summary(&mut out, &reports, &peers, variant)
}

/// How many rows each engine passes, and where the others' figures come from.
fn print_summary(
    out: &mut impl Write,
    reports: &[Report],
    peers: &Peers,
    variant: Variant,
) -> Outcome {
    let passed = reports.iter().filter(|report| report.pass).count();
    let count = |figure| {
        let passes =
            |report: &&Report| table::peer_passes(report, &peers.beside(variant, report), figure);
        reports.iter().filter(passes).count()
    };
    let (box2d, rapier) = (count(|peer| &peer.box2d), count(|peer| &peer.rapier));
    let total = reports.len();
    let beside = |report: &&Report| table::as_good(report, &peers.beside(variant, report));
    let good = reports.iter().filter(beside).count();
    writeln!(out, "\n{passed} of {total} rows pass; {box2d} in Box2D, {rapier} in Rapier.")?;
    writeln!(out, "{good} of {total} rows are as good as the best of the others.")?;
    writeln!(
        out,
        "Columns Box2D and Rapier: measured before on the same scenes, each engine at its own defaults\n\
         ({}, {}). To measure them anew: {PEERS_COMMAND}",
        peers.box2d, peers.rapier
    )?;
    Ok(())
}

/// A row as JSON: the report, and what the other engines made of each of its numbers.
#[derive(Serialize)]
struct JsonRow<'a> {
    #[serde(flatten)]
    report: &'a Report,
    /// Is each number as good as the best of the others'?
    as_good: bool,
    peers: Vec<&'a PeerMeasure>,
}

impl<'a> JsonRow<'a> {
    fn new(report: &'a Report, peers: &'a Peers, variant: Variant) -> Self {
        let beside = peers.beside(variant, report);
        let as_good = table::as_good(report, &beside);
        Self { report, as_good, peers: beside.into_iter().flatten().collect() }
    }
}

/// The rows asked for, in their order; the first suite if none is named.
fn choose(names: &[String]) -> Outcome<Vec<&'static Row>> {
    let unknown = |name: &str| {
        let known: Vec<_> = all_rows().map(|row| row.name).collect();
        Failure::new(format!("there is no row '{name}'")).hint(format!(
            "rows go by number, 1 to 26 and M1 to C11, by family (M, J, E, G, F, C), or by name: {}",
            known.join(", ")
        ))
    };
    resolve(names).map_err(unknown)
}

/// Plays a row; a bar shows on a terminal when that takes longer than a moment.
fn play(row: &Row, variant: Variant, awake: bool) -> Report {
    const PATIENCE: Duration = Duration::from_millis(500);
    let bar = ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::hidden());
    if let Ok(style) = ProgressStyle::with_template("{msg} {bar:40} {percent} %, {eta} left") {
        bar.set_style(style);
    }
    bar.set_message(row.name);
    let (start, allowed) = (Instant::now(), stderr().is_terminal());
    let report = row.run(&our_engine, variant, awake, &mut |done, total| {
        if !allowed || start.elapsed() < PATIENCE {
            return;
        }
        if bar.is_hidden() {
            bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        bar.set_length(total);
        bar.set_position(done);
    });
    bar.finish_and_clear();
    report
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_go_by_number_and_name() {
        let chosen = choose(&["7".into(), "card house".into()]).unwrap();
        assert_eq!(chosen.iter().map(|row| row.id).collect::<Vec<_>>(), ["7", "1"]);
        assert_eq!(choose(&[]).unwrap().len(), 26);
        let failure = choose(&["piramid".into()]).unwrap_err().to_string();
        assert!(failure.contains("'piramid'") && failure.contains("pyramid"), "{failure}");
    }
}
