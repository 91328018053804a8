//! Rows of results, their ratios, and how they are printed.

use crate::engines::Config;
use crate::honesty;
use peers_worker::{Report, Summary, percentile};
use serde::Serialize;

/// One engine on one scene: medians over the repeats.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Scene.
    pub scene: String,
    /// Engine and version.
    pub engine: String,
    /// Configuration.
    pub config: String,
    /// Threads allowed.
    pub threads: usize,
    /// Mean CPU time of a step, all threads together, milliseconds.
    pub cpu_ms: f64,
    /// Mean wall time of a step, milliseconds.
    pub wall_ms: f64,
    /// 99th percentile of a step, milliseconds: CPU time with one thread, wall time with several.
    pub p99_ms: f64,
    /// The step that took most, on the same clock, milliseconds: the least of the repeats, because what else the
    /// machine does only adds to it.
    pub worst_ms: f64,
    /// This row's time over the reference's, which is ours where we ran: CPU time with one thread,
    /// wall time with several. Above 1: the reference is faster.
    pub ratio: f64,
    /// The same of the 99th percentiles.
    pub p99_ratio: f64,
    /// The same of the worst steps.
    pub worst_ratio: f64,
    /// Name of the engine that ratios refer to.
    pub reference: String,
    /// Least and greatest of the repeats' mean CPU times, milliseconds.
    pub cpu_range_ms: [f64; 2],
    /// Timed steps of a run.
    pub steps: u32,
    /// Runs.
    pub repeat: usize,
    /// Time to build the world, milliseconds.
    pub build_ms: f64,
    /// Peak memory of the process, mebibytes.
    pub peak_mib: f64,
    /// Compiler flags and lanes.
    pub build: String,
    /// The world after the last step.
    #[serde(flatten)]
    pub end: Summary,
    /// Where that differs from the reference's by more than the bounds.
    pub differs: Vec<String>,
    /// Name of the configuration.
    #[serde(skip)]
    name: &'static str,
}

impl Row {
    fn new(scene: &str, threads: usize, config: &Config, reports: &[Report]) -> Self {
        let median = |part: fn(&Report) -> f64| {
            percentile(&reports.iter().map(part).collect::<Vec<_>>(), 0.5)
        };
        let least =
            |part: fn(&Report) -> f64| reports.iter().map(part).fold(f64::INFINITY, f64::min);
        let mut cpu: Vec<f64> = reports.iter().map(|report| report.cpu_ms).collect();
        cpu.sort_by(f64::total_cmp);
        let first = &reports[0];
        Self {
            scene: scene.to_owned(),
            engine: first.engine.clone(),
            config: config.config.to_owned(),
            threads,
            cpu_ms: median(|report| report.cpu_ms),
            wall_ms: median(|report| report.wall_ms),
            p99_ms: if threads > 1 {
                median(|report| report.wall_p99_ms)
            } else {
                median(|report| report.cpu_p99_ms)
            },
            worst_ms: least(if threads > 1 {
                |report: &Report| report.wall_worst_ms
            } else {
                |report: &Report| report.cpu_worst_ms
            }),
            ratio: 1.0,
            p99_ratio: 1.0,
            worst_ratio: 1.0,
            reference: String::new(),
            cpu_range_ms: [cpu[0], cpu[cpu.len() - 1]],
            steps: first.steps,
            repeat: reports.len(),
            build_ms: median(|report| report.build_ms),
            peak_mib: median(|report| report.peak_mib),
            build: first.build.clone(),
            end: first.end,
            differs: Vec::new(),
            name: config.name,
        }
    }

    /// What is compared.
    fn time_ms(&self) -> f64 {
        if self.threads > 1 { self.wall_ms } else { self.cpu_ms }
    }
}

/// The rows of a scene, with ratios to the first of them and differences from it.
pub fn rows<'a>(
    scene: &str,
    threads: usize,
    runs: impl Iterator<Item = (&'a Config, Vec<Report>)>,
) -> Vec<Row> {
    let mut rows: Vec<Row> =
        runs.map(|(config, reports)| Row::new(scene, threads, config, &reports)).collect();
    let Some(reference) = rows.first().cloned() else { return rows };
    for row in &mut rows {
        row.ratio = row.time_ms() / reference.time_ms();
        row.p99_ratio = row.p99_ms / reference.p99_ms;
        row.worst_ratio = row.worst_ms / reference.worst_ms;
        row.reference = reference.name.to_owned();
        row.differs = honesty::differences(&row.end, &reference.end);
    }
    rows
}

/// A geometric mean, and the least with its scene.
fn mean_and_least(rows: &[&Row], ratio: fn(&Row) -> f64) -> String {
    let Some(least) = rows.iter().min_by(|a, b| ratio(a).total_cmp(&ratio(b))) else {
        return String::new();
    };
    let logs: f64 = rows.iter().map(|row| ratio(row).ln()).sum();
    let mean = (logs / rows.len() as f64).exp();
    format!("{mean:8.2}{:7.2} {:24}", ratio(least), format!("({})", least.scene))
}

/// Prints rows as JSON, an object a line.
pub fn print_json(rows: &[Row]) {
    for row in rows {
        match serde_json::to_string(row) {
            Ok(line) => println!("{line}"),
            Err(error) => eprintln!("a row cannot be written: {error}"),
        }
    }
}

/// Prints a scene's rows as a table, with notes on what differs.
pub fn print_scene(rows: &[Row], threads: u16) {
    let Some(first) = rows.first() else { return };
    let plural = if threads == 1 { "" } else { "s" };
    println!(
        "\n{}: {} timed steps, median of {}, {threads} thread{plural}, ratio to {}",
        first.scene, first.steps, first.repeat, first.reference,
    );
    println!(
        "{:14}{:>9}{:>9}{:>8}{:>9}{:>7}{:>9}{:>7}  |{:>8}{:>8}{:>9}{:>8}{:>10}{:>12}{:>9}{:>8}",
        "engine",
        "cpu ms",
        "wall ms",
        "ratio",
        "p99 ms",
        "ratio",
        "worst ms",
        "ratio",
        "bodies",
        "joints",
        "contacts",
        "awake",
        "height m",
        "energy J",
        "deepest",
        "MiB",
    );
    for row in rows {
        let end = &row.end;
        println!(
            "{:14}{:9.4}{:9.4}{:8.2}{:9.3}{:7.2}{:9.3}{:7.2}  |{:8}{:8}{:9}{:8}{:10.3}{:>12.3e}{:9.4}{:8.0}{}",
            row.name,
            row.cpu_ms,
            row.wall_ms,
            row.ratio,
            row.p99_ms,
            row.p99_ratio,
            row.worst_ms,
            row.worst_ratio,
            end.bodies,
            end.joints,
            end.contacts,
            end.awake,
            end.height,
            end.energy,
            end.overlap,
            row.peak_mib,
            if row.differs.is_empty() { "" } else { "  *" },
        );
    }
    for row in rows.iter().filter(|row| !row.differs.is_empty()) {
        println!("  * {} differs from {}: {}", row.name, row.reference, row.differs.join(", "));
    }
}

/// Prints a line a scene: of each engine the time of a mean step, and the ratios of mean, 99th percentile and worst step.
pub fn print_markdown(configs: &[Config], rows: &[Row]) {
    let heads: Vec<String> = configs.iter().map(|config| format!("{} ms", config.name)).collect();
    println!("| scene | {} |\n|{}", heads.join(" | "), "---|".repeat(configs.len() + 1));
    for rows in rows.chunk_by(|a, b| a.scene == b.scene) {
        let cell = |config: &Config| {
            let row = rows.iter().find(|row| row.name == config.name);
            row.map_or("-".to_owned(), |row| {
                let ratios = [row.ratio, row.p99_ratio, row.worst_ratio];
                let [mean, p99, worst] = ratios.map(|ratio| format!("{ratio:.2}"));
                format!("{:.4} ({mean}, {p99}, {worst})", row.time_ms())
            })
        };
        let cells: Vec<String> = configs.iter().map(cell).collect();
        println!("| {} | {} |", rows[0].scene, cells.join(" | "));
    }
}

/// Prints, for each engine, the geometric means of its ratios over all scenes, and the least ones.
pub fn print_means(configs: &[Config], rows: &[Row]) {
    println!(
        "\ngeometric means of the ratios, and the least: mean step, 99th percentile, worst step"
    );
    for config in configs {
        let own: Vec<&Row> = rows.iter().filter(|row| row.name == config.name).collect();
        let parts = [
            mean_and_least(&own, |row| row.ratio),
            mean_and_least(&own, |row| row.p99_ratio),
            mean_and_least(&own, |row| row.worst_ratio),
        ];
        if !own.is_empty() {
            println!("{:14}{}  {} scenes", config.name, parts.join(""), own.len());
        }
    }
    println!("{}", honesty::bounds());
}
