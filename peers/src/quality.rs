//! The quality suite in all engines: each row and engine in a process of its own, so that a crash costs one cell.

use crate::engines::{self, Config};
use crate::launch;
use clap::Args;
use peers_worker::{Answer, Played, QualityJob, Task};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use tiny_physics_quality::{
    Figure, PeerMeasure, PeerRow, Peers, Report, Row, Variant, all_rows, our_engine, resolve,
    still, table,
};

/// The configurations that play: the plain builds.
const ENGINES: [&str; 3] = ["ours", "box2d-sse2", "rapier"];
/// Longer than any row takes on a slow and busy machine.
const LIMIT: Duration = Duration::from_secs(600);

/// Options of `quality`.
#[derive(Args)]
pub struct QualityArgs {
    /// Numbers or names of rows, `hard` for the second suite, a letter for a family of it; the first suite where not said.
    #[arg(value_name = "ROW")]
    rows: Vec<String>,
    /// Play each row in its other variant: other sizes, masses, angles and speeds.
    #[arg(long)]
    variant: bool,
    /// Print one JSON object a row instead of a table.
    #[arg(long)]
    json: bool,
    /// Print the table as Markdown, as it stands in docs/quality.md.
    #[arg(long, conflicts_with = "json")]
    markdown: bool,
    /// Play the rows, all of both suites where not said, in both variants and write the other engines' figures to
    /// crates/quality/peers.json, from where `tiny-physics quality` has its columns.
    #[arg(long, conflicts_with = "variant")]
    write: bool,
}

/// Plays the rows in all engines and prints what came of them.
///
/// # Errors
/// No such row, an engine that does not build or must not be measured, a file that cannot be written.
pub fn run(args: &QualityArgs) -> Result<(), String> {
    let chosen = match resolve(&args.rows) {
        Ok(_) if args.write && args.rows.is_empty() => all_rows().collect::<Vec<_>>(),
        Ok(rows) => rows,
        Err(word) => return Err(format!("no row {word}; `tiny-physics quality` lists them")),
    };
    let engines = Engines::build()?;
    // What others cannot play has no figures to be recorded.
    let chosen: Vec<_> =
        chosen.into_iter().filter(|row| !args.write || row.alone.is_none()).collect();
    let mut record = Peers::recorded().map_err(|error| error.to_string())?;
    let variants = match (args.write, args.variant) {
        (true, _) => vec![Variant::Usual, Variant::Other],
        (false, false) => vec![Variant::Usual],
        (false, true) => vec![Variant::Other],
    };
    for variant in variants {
        let mut reports = Vec::new();
        for row in &chosen {
            reports.push(engines.play_row(row, variant, &mut record)?);
        }
        if args.json {
            print_json(&reports, &record, variant)?;
        } else {
            print_table(&reports, &record, variant, args.markdown);
        }
    }
    if args.write { write(&record) } else { Ok(()) }
}

/// The engines' programs, built.
pub struct Engines {
    configs: Vec<Config>,
}

impl Engines {
    /// Builds them: ours, Box2D, Rapier.
    ///
    /// # Errors
    /// One does not build.
    pub fn build() -> Result<Self, String> {
        let configs = engines::select(&ENGINES.map(String::from))?;
        for config in &configs {
            eprintln!("building {}", config.name);
            config.build(1)?;
        }
        Ok(Self { configs })
    }

    /// One job in all engines at once, in the order ours, Box2D, Rapier.
    pub fn play(&self, job: QualityJob) -> Vec<Result<Answer, String>> {
        self.each(&Task::Quality(job), LIMIT)
    }

    /// One task in all engines at once, in the order ours, Box2D, Rapier, each for no longer than `limit`.
    pub fn each(&self, task: &Task, limit: Duration) -> Vec<Result<Answer, String>> {
        let one = |config: &Config| launch::ask(&config.program(1), task, limit);
        std::thread::scope(|scope| {
            let runs: Vec<_> =
                self.configs.iter().map(|config| scope.spawn(|| one(config))).collect();
            let crashed = |_| Err("its thread panicked".to_owned());
            runs.into_iter().map(|run| run.join().unwrap_or_else(crashed)).collect()
        })
    }

    /// Our report of a row; the others' figures go into the record.
    fn play_row(&self, row: &Row, variant: Variant, record: &mut Peers) -> Result<Report, String> {
        let start = Instant::now();
        if row.alone.is_some() {
            return Ok(row.run(&our_engine, variant, false, &mut |_, _| {}));
        }
        let template = row.run(&still, variant, false, &mut |_, _| {});
        let job = QualityJob { row: row.id.into(), other: variant == Variant::Other, tape: None };
        let mut figures = Vec::new();
        for answer in self.play(job) {
            let (engine, column) = column(&template, answer)?;
            figures.push((engine, column));
        }
        let [(_, ours), (box2d_name, box2d), (rapier_name, rapier)] = &figures[..] else {
            return Err("not three engines".into());
        };
        eprintln!("{:2} {}: {:.1} s", row.id, row.name, start.elapsed().as_secs_f64());
        if !box2d_name.is_empty() {
            record.box2d.clone_from(box2d_name);
        }
        if !rapier_name.is_empty() {
            record.rapier.clone_from(rapier_name);
        }
        let others = box2d.iter().zip(rapier);
        let measures = template
            .measures
            .iter()
            .zip(others)
            .map(|(measure, (box2d, rapier))| PeerMeasure {
                metric: measure.metric.clone(),
                box2d: box2d.clone(),
                rapier: rapier.clone(),
            })
            .collect();
        let values: Vec<f64> = ours.iter().map(Figure::value).collect();
        record.record(variant, PeerRow { id: row.id.into(), measures });
        Ok(template.with_values(&values))
    }
}

/// What an engine made of the numbers of a report, and the engine's name, which one that crashed does not tell.
fn column(
    template: &Report,
    answer: Result<Answer, String>,
) -> Result<(String, Vec<Figure>), String> {
    let all = |figure: Figure| vec![figure; template.measures.len()];
    match answer {
        Ok(Answer::Played(Played { engine, cannot: Some(reason), .. })) => {
            Ok((engine, all(Figure::Cannot(reason))))
        }
        Ok(Answer::Played(played)) => {
            let metrics = played.measures.iter().map(|measure| &measure.metric);
            if !metrics.eq(template.measures.iter().map(|measure| &measure.metric)) {
                return Err(format!("{} measured something else", played.engine));
            }
            let value = |value: Option<f64>| value.map_or(Figure::Fell, Figure::of);
            Ok((played.engine, played.measures.iter().map(|m| value(m.value)).collect()))
        }
        Ok(Answer::Failed(reason)) => Err(reason),
        Ok(_) => Err("the worker did something else instead".into()),
        Err(how) => Ok((String::new(), all(Figure::Crashed(how)))),
    }
}

fn print_table(reports: &[Report], record: &Peers, variant: Variant, markdown: bool) {
    println!("\n{variant:?} variant: {}, {}", record.box2d, record.rapier);
    let line = |cells: &[String; table::COLUMNS]| {
        if markdown { format!("| {} |", cells.join(" | ")) } else { table::line(cells) }
    };
    println!("{}", line(&table::HEADER.map(String::from)));
    if markdown {
        println!("{}|", "|---".repeat(table::HEADER.len()));
    }
    let mut notes = Vec::new();
    for report in reports {
        let peers = record.beside(variant, report);
        for cells in table::cells(report, &peers) {
            // A bar would end a cell of Markdown.
            println!(
                "{}",
                line(&cells.map(|cell| cell.replace('|', if markdown { "\\|" } else { "|" })))
            );
        }
        for peer in peers.iter().flatten() {
            for (engine, figure) in [("Box2D", &peer.box2d), ("Rapier", &peer.rapier)] {
                if let Figure::Crashed(_) | Figure::Cannot(_) = figure {
                    notes.push(format!("row {}: {engine} {figure}", report.id));
                }
            }
        }
    }
    let count = |figure: fn(&PeerMeasure) -> &Figure| {
        let passes = |r: &&Report| table::peer_passes(r, &record.beside(variant, r), figure);
        reports.iter().filter(passes).count()
    };
    let ours = reports.iter().filter(|report| report.pass).count();
    let (box2d, rapier) = (count(|peer| &peer.box2d), count(|peer| &peer.rapier));
    let total = reports.len();
    println!("{ours} of {total} rows pass; {box2d} in Box2D, {rapier} in Rapier");
    let good = reports.iter().filter(|r| table::as_good(r, &record.beside(variant, r))).count();
    println!("{good} of {total} rows are as good as the best of the others");
    notes.dedup();
    notes.iter().for_each(|note| println!("{note}"));
}

fn print_json(reports: &[Report], record: &Peers, variant: Variant) -> Result<(), String> {
    for report in reports {
        let mut row = serde_json::to_value(report).map_err(|error| error.to_string())?;
        let peers: Vec<_> = record.beside(variant, report).into_iter().flatten().collect();
        let beside = record.beside(variant, report);
        row["as_good"] = table::as_good(report, &beside).into();
        row["peers"] = serde_json::to_value(peers).map_err(|error| error.to_string())?;
        println!("{row}");
    }
    Ok(())
}

fn write(record: &Peers) -> Result<(), String> {
    let path: PathBuf =
        [env!("CARGO_MANIFEST_DIR"), "..", "crates", "quality", "peers.json"].iter().collect();
    let text = serde_json::to_string_pretty(record).map_err(|error| error.to_string())? + "\n";
    std::fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    eprintln!("written: {}", path.display());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use peers_worker::Measured;

    fn template() -> Report {
        tiny_physics_quality::find("stack").expect("a row").run(
            &still,
            Variant::Usual,
            false,
            &mut |_, _| {},
        )
    }

    #[test]
    fn a_crash_costs_one_column() {
        let template = template();
        let (_, figures) = column(&template, Err("signal: 11".into())).expect("a column");
        assert_eq!(figures, vec![Figure::Crashed("signal: 11".into()); 4]);
        assert!(column(&template, Ok(Answer::Failed("assertions are on".into()))).is_err());
    }

    #[test]
    fn numbers_stand_beside_their_metrics() {
        let template = template();
        let values = [Some(0.5), None, Some(2.0), Some(0.0)];
        let measure = |(m, value): (&tiny_physics_quality::Measure, _)| Measured {
            metric: m.metric.clone(),
            value,
        };
        let mut played = Played {
            engine: "Test 1".into(),
            measures: template.measures.iter().zip(values).map(measure).collect(),
            cannot: None,
            tapes: Vec::new(),
        };
        let (name, figures) = column(&template, Ok(Answer::Played(played.clone()))).expect("fits");
        assert_eq!((name.as_str(), &figures[1]), ("Test 1", &Figure::Fell));
        played.measures.pop();
        assert!(column(&template, Ok(Answer::Played(played.clone()))).is_err());
        played.cannot = Some("no towers".into());
        let (_, figures) = column(&template, Ok(Answer::Played(played))).expect("a reason");
        assert_eq!(figures[3], Figure::Cannot("no towers".into()));
    }
}
