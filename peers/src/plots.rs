//! The pictures of `docs/quality.md`: rows of the quality suite in all engines, drawn from what happened.

use crate::chart::{self, Axis, Chart, Series, Window};
use crate::quality::Engines;
use clap::Args;
use peers_worker::{Answer, QualityJob, Tape};
use std::path::{Path, PathBuf};
use tiny_physics_quality::{Figure, PeerMeasure, Peers, Row, Variant, hard_rows, our_engine, rows};

/// Options of `plots`.
#[derive(Args)]
pub struct PlotsArgs {
    /// The folder to write to.
    #[arg(long, value_name = "FOLDER", default_value = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/images"))]
    out: PathBuf,
}

/// What an engine did in a row: a tape for each world.
struct Run {
    tapes: Vec<Tape>,
}

/// Draws all pictures.
///
/// # Errors
/// An engine that does not build, a file that cannot be written.
pub fn run(args: &PlotsArgs) -> Result<(), String> {
    let engines = Engines::build()?;
    let out = |name: &str| args.out.join(name);
    stack(&engines, &out("quality-stack.svg"))?;
    heavy(&engines, &out("quality-heavy.svg"))?;
    tower(&engines, &out("quality-tower.svg"))?;
    billiards(&engines, &out("quality-billiards.svg"))?;
    chain(&engines, &out("quality-chain.svg"))?;
    pyramid(&engines, &out("quality-pyramid.svg"))?;
    tiles(&engines, &out("quality-tiles.svg"))?;
    bridge(&engines, &out("quality-hard-bridge.svg"))?;
    drum(&engines, &out("quality-hard-drum.svg"))?;
    ragdolls(&engines, &out("quality-hard-ragdolls.svg"))?;
    overview(&out("quality-overview.svg"), rows())?;
    overview(&out("quality-hard-overview.svg"), hard_rows())
}

/// A bridge of planks under a load of 30 planks' mass, after 15 seconds.
fn bridge(engines: &Engines, path: &Path) -> Result<(), String> {
    let runs = record(engines, ("J1", false), 60)?;
    let views: Vec<_> = runs.iter().map(|run| run.tapes.get(3).map(|tape| (tape, 15))).collect();
    let window = Window { x: (-11.0, 11.0), y: (-12.0, 4.0), circle: None };
    let title =
        "A crate of 30 planks' mass on a straight bridge, 15 s after it was dropped from 10 cm";
    chart::worlds(path, title, &window, &views)
}

/// Balls in a drum with paddles, after five seconds.
fn drum(engines: &Engines, path: &Path) -> Result<(), String> {
    let runs = record(engines, ("M5", false), 30)?;
    let views: Vec<_> = runs.iter().map(|run| run.tapes.first().map(|tape| (tape, 10))).collect();
    let window = Window { x: (-6.0, 6.0), y: (-6.0, 6.0), circle: None };
    let title = "Thirty balls in a drum that turns at 6 rad/s, after 5 s";
    chart::worlds(path, title, &window, &views)
}

/// Forty ragdolls in a pit, after ten seconds.
fn ragdolls(engines: &Engines, path: &Path) -> Result<(), String> {
    let runs = record(engines, ("J6", false), 60)?;
    let last = |tape: &Tape| 10.min(tape.frames.len().saturating_sub(1));
    let views: Vec<_> =
        runs.iter().map(|run| run.tapes.get(3).map(|tape| (tape, last(tape)))).collect();
    let window = Window { x: (-4.0, 4.0), y: (-0.6, 6.4), circle: None };
    chart::worlds(path, "Forty ragdolls in a pit, after 10 s or when asleep", &window, &views)
}

/// Rows that all engines can play: ours as measured now, the others' as recorded.
fn overview(path: &Path, rows: &[Row]) -> Result<(), String> {
    let peers = Peers::recorded().map_err(|error| error.to_string())?;
    let mut dots = Vec::new();
    for row in rows.iter().filter(|row| row.alone.is_none()) {
        eprintln!("playing row {}", row.id);
        let report = row.run(&our_engine, Variant::Usual, false, &mut |_, _| {});
        let beside = peers.beside(Variant::Usual, &report);
        let worst = |figure: fn(&PeerMeasure) -> &Figure| {
            let mut worst: f64 = 0.0;
            for (measure, peer) in report.measures.iter().zip(&beside) {
                match figure((*peer)?) {
                    Figure::Cannot(_) => return None,
                    figure => worst = worst.max(measure.target.use_of(figure.value())),
                }
            }
            Some(worst)
        };
        dots.push(chart::Dots {
            name: format!("{} {}", row.id, row.name),
            used: [
                Some(report.use_of_target()),
                worst(|peer| &peer.box2d),
                worst(|peer| &peer.rapier),
            ],
        });
    }
    chart::overview(path, &dots)
}

/// A row in all engines, recorded every so many steps, in the order of [`chart::ENGINES`].
fn record(engines: &Engines, (row, other): (&str, bool), every: u32) -> Result<Vec<Run>, String> {
    eprintln!("recording row {row}");
    let job = QualityJob { row: row.into(), other, tape: Some(every) };
    let tapes = |answer| match answer {
        Ok(Answer::Played(played)) => Ok(Run { tapes: played.tapes }),
        Ok(Answer::Failed(reason)) => Err(reason),
        Ok(_) => Err("the worker did something else instead".into()),
        // A crash leaves no tape: its lines are missing.
        Err(how) => {
            eprintln!("row {row}: a worker crashed: {how}");
            Ok(Run { tapes: Vec::new() })
        }
    };
    engines.play(job).into_iter().map(tapes).collect()
}

/// One line an engine: a number of each frame of a world, beside its time in seconds.
fn lines(runs: &[Run], world: usize, number: impl Fn(&Tape, usize) -> Option<f64>) -> Vec<Series> {
    let line = |run: &Run| {
        let Some(tape) = run.tapes.get(world) else { return Vec::new() };
        let time = |frame: usize| frame as f64 * tape.seconds;
        let points = (0..tape.frames.len()).filter_map(|f| Some((time(f), number(tape, f)?)));
        points.collect()
    };
    runs.iter().map(line).collect()
}

/// Where a body is in a frame.
fn place(tape: &Tape, frame: usize, body: usize) -> Option<[f64; 2]> {
    let [x, y, _] = (*tape.frames.get(frame)?.get(body)?)?;
    Some([x.into(), y.into()])
}

/// The greatest of a number over all bodies but the first, which is the floor.
fn greatest(tape: &Tape, number: impl Fn(usize) -> Option<f64>) -> Option<f64> {
    (1..tape.bodies.len()).filter_map(number).reduce(f64::max)
}

/// Towers of 100 crates: how far the top sinks, and how far the worst crate goes sideways.
fn stack(engines: &Engines, path: &Path) -> Result<(), String> {
    let runs = record(engines, ("6", false), 12)?;
    let sag = lines(&runs, 1, |tape, frame| {
        let top = tape.bodies.len() - 1;
        Some(place(tape, 0, top)?[1] - place(tape, frame, top)?[1])
    });
    let sideways = lines(&runs, 1, |tape, frame| {
        let moved = |b| Some((place(tape, frame, b)?[0] - place(tape, 0, b)?[0]).abs() * 1000.0);
        greatest(tape, moved)
    });
    let time = Axis::linear("seconds", 0.0, 60.0);
    chart::charts(
        path,
        "A tower of 100 crates of 1 m",
        &[
            Chart {
                title: "how far the top has sunk (m)",
                x: time,
                y: Axis::log("", 0.01, 10.0),
                series: &sag,
            },
            Chart {
                title: "how far the worst crate is off to the side (mm)",
                x: time,
                y: Axis::log("", 0.001, 10_000.0),
                series: &sideways,
            },
        ],
    )
}

/// A crate on a lighter one: how deep anything overlaps, until it falls.
fn heavy(engines: &Engines, path: &Path) -> Result<(), String> {
    let runs = record(engines, ("2", false), 6)?;
    let overlap = |world| {
        lines(&runs, world, |tape, frame| {
            let ([_, light], [x, heavy]) = (place(tape, frame, 1)?, place(tape, frame, 2)?);
            let stands = x.abs() < 0.5 && heavy > 1.0;
            // Crates of 1 m on y = 0, upright as long as they stand.
            stands.then(|| 1000.0 * (0.5 - light).max(1.0 - (heavy - light)))
        })
    };
    let (hundred, thousand) = (overlap(0), overlap(1));
    let (time, y) = (Axis::linear("seconds", 0.0, 10.0), Axis::log("", 0.1, 1000.0));
    let chart = |title, series| Chart { title, x: time, y, series };
    chart::charts(
        path,
        "A heavy crate on a light one: how deep they overlap, until it falls",
        &[chart("100 times as heavy (mm)", &hundred), chart("1000 times as heavy (mm)", &thousand)],
    )
}

/// Light crates under a heavy one after ten seconds.
fn tower(engines: &Engines, path: &Path) -> Result<(), String> {
    let runs = record(engines, ("3", false), 30)?;
    let views: Vec<_> = runs.iter().map(|run| run.tapes.first().map(|tape| (tape, 20))).collect();
    let window = Window { x: (-3.2, 3.2), y: (-0.6, 5.6), circle: None };
    let title = "Four crates under one of 1000 times their weight, after 10 s";
    chart::worlds(path, title, &window, &views)
}

/// The chain of 30 links with a ball of 1000 times a link's weight, when the ball is farthest away.
fn chain(engines: &Engines, path: &Path) -> Result<(), String> {
    let runs = record(engines, ("4", false), 2)?;
    let farthest = |tape: &Tape| {
        let far = |frame: usize| {
            let [x, y] = place(tape, frame, tape.bodies.len() - 1).unwrap_or_default();
            x.hypot(y)
        };
        (0..tape.frames.len()).max_by(|&a, &b| far(a).total_cmp(&far(b))).unwrap_or_default()
    };
    let views: Vec<_> =
        runs.iter().map(|run| run.tapes.get(1).map(|tape| (tape, farthest(tape)))).collect();
    let circle = Some((30.0, "as far as 30 links reach"));
    let window = Window { x: (-33.0, 33.0), y: (-56.0, 4.0), circle };
    let title = "A ball of 1000 times a link's weight on 30 links, when longest";
    chart::worlds(path, title, &window, &views)
}

/// A pyramid of 40 rows: how far the worst crate is off to the side.
fn pyramid(engines: &Engines, path: &Path) -> Result<(), String> {
    let runs = record(engines, ("7", false), 3)?;
    let sideways = lines(&runs, 0, |tape, frame| {
        let moved = |b| Some((place(tape, frame, b)?[0] - place(tape, 0, b)?[0]).abs() * 1000.0);
        if frame <= 120 { greatest(tape, moved) } else { None }
    });
    chart::charts(
        path,
        "A pyramid with 40 crates in its lowest row: the first six seconds",
        &[Chart {
            title: "how far the worst crate is off to the side (mm)",
            x: Axis::linear("seconds", 0.0, 6.0),
            y: Axis::linear("", 0.0, 60.0),
            series: &sideways,
        }],
    )
}

/// A ball hits fifteen head on: half a second later.
fn billiards(engines: &Engines, path: &Path) -> Result<(), String> {
    let runs = record(engines, ("20", false), 1)?;
    let last = |tape: &Tape| tape.frames.len().saturating_sub(1);
    let views: Vec<_> =
        runs.iter().map(|run| run.tapes.first().map(|tape| (tape, last(tape)))).collect();
    let window = Window { x: (-5.0, 8.0), y: (-4.2, 4.2), circle: None };
    let title = "A ball (grey) has hit fifteen head on, from the left: half a second later";
    chart::worlds(path, title, &window, &views)
}

/// A box without friction over tiles: its speed.
fn tiles(engines: &Engines, path: &Path) -> Result<(), String> {
    let runs = record(engines, ("23", true), 6)?;
    let speed = |world| {
        lines(&runs, world, |tape, frame| {
            let (slider, before) = (tape.bodies.len() - 1, frame.checked_sub(1)?);
            Some((place(tape, frame, slider)?[0] - place(tape, before, slider)?[0]) / tape.seconds)
        })
    };
    let (separate, one) = (speed(0), speed(1));
    let (time, y) = (Axis::linear("seconds", 0.0, 5.0), Axis::linear("", 0.0, 22.0));
    chart::charts(
        path,
        "A box without friction slides at 20 m/s over a floor of tiles",
        &[
            Chart {
                title: "tiles on bodies of their own: speed (m/s)",
                x: time,
                y,
                series: &separate,
            },
            Chart { title: "tiles on one body: speed (m/s)", x: time, y, series: &one },
        ],
    )
}
