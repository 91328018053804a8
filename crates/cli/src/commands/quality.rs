//! `quality`: scenes whose right answer is known, and what the engine makes of them.

use crate::args::QualityArgs;
use crate::failure::{Failure, Outcome};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, Write, stderr, stdout};
use std::time::{Duration, Instant};
use tiny_physics_quality::{Measure, Report, Row, Variant, find, our_engine, rows};

/// Plays the rows and prints the table.
///
/// # Errors
/// No such row, or standard output's.
pub fn run(args: &QualityArgs) -> Outcome {
    let chosen = choose(&args.rows)?;
    let variant = if args.variant { Variant::Other } else { Variant::Usual };
    let mut out = stdout().lock();
    let mut reports = Vec::new();
    if !args.json {
        print_line(&mut out, &HEADER)?;
    }
    for row in chosen {
        let report = play(row, variant, args.awake);
        if !args.json {
            print_report(&mut out, &report)?;
        }
        reports.push(report);
    }
    if args.json {
        serde_json::to_writer_pretty(&mut out, &reports)?;
        writeln!(out)?;
    } else {
        let passed = reports.iter().filter(|report| report.pass).count();
        writeln!(out, "\n{passed} of {} rows pass.", reports.len())?;
    }
    Ok(())
}

/// The rows asked for, in their order; all if none is named.
fn choose(names: &[String]) -> Outcome<Vec<&'static Row>> {
    if names.is_empty() {
        return Ok(rows().iter().collect());
    }
    let unknown = |name: &String| {
        let known: Vec<_> = rows().iter().map(|row| row.name).collect();
        Failure::new(format!("there is no row '{name}'")).hint(format!(
            "rows go by number, 1 to {}, or by name: {}",
            known.len(),
            known.join(", ")
        ))
    };
    names.iter().map(|name| find(name).ok_or_else(|| unknown(name))).collect()
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

/// Widths of the columns, negative for those that are flush left.
const WIDTHS: [i32; 9] = [2, -15, -56, 11, -8, -20, -5, 7, 7];
const HEADER: [&str; 9] =
    ["id", "name", "metric", "value", "unit", "target", "pass", "Box2D*", "Rapier*"];

fn print_report(out: &mut impl Write, report: &Report) -> Outcome {
    let id = report.id.to_string();
    for (i, measure) in report.measures.iter().enumerate() {
        let (id, name) = if i == 0 { (id.as_str(), report.name) } else { ("", "") };
        let (value, target) = (value_text(measure), measure.target.to_string());
        let cells = [
            id,
            name,
            &measure.metric,
            &value,
            measure.unit,
            &target,
            if measure.pass { "yes" } else { "NO" },
            measure.box2d_reference,
            measure.rapier_reference,
        ];
        print_line(out, &cells)?;
    }
    Ok(())
}

fn print_line(out: &mut impl Write, cells: &[&str; 9]) -> Outcome {
    let mut line = String::new();
    for (cell, width) in cells.iter().zip(WIDTHS) {
        let columns = width.unsigned_abs() as usize;
        line +=
            &if width < 0 { format!("{cell:<columns$}  ") } else { format!("{cell:>columns$}  ") };
    }
    writeln!(out, "{}", line.trim_end())?;
    Ok(())
}

/// Five digits that matter; a word for scenes that fell apart.
fn value_text(measure: &Measure) -> String {
    let value = measure.value;
    match value.abs() {
        size if !size.is_finite() => "fell apart".into(),
        0.0 => "0".into(),
        size if size >= 10_000.0 => format!("{value:.0}"),
        size if size >= 1.0 => format!("{value:.3}"),
        size if size >= 0.000_1 => format!("{value:.5}"),
        _ => format!("{value:.1e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_go_by_number_and_name() {
        let chosen = choose(&["7".into(), "card house".into()]).unwrap();
        assert_eq!(chosen.iter().map(|row| row.id).collect::<Vec<_>>(), [7, 1]);
        assert_eq!(choose(&[]).unwrap().len(), rows().len());
        let failure = choose(&["piramid".into()]).unwrap_err().to_string();
        assert!(failure.contains("'piramid'") && failure.contains("pyramid"), "{failure}");
    }
}
