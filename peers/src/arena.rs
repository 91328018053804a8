//! Random worlds in all engines: where is ours worse than the best of the others? Chance makes any engine worse in some, so how often
//! each of the others is worse than the best of its others is counted, too, by the same rule but for the cost.

use crate::quality::Engines;
use clap::Args;
use peers_worker::{Answer, Task};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use tiny_physics_quality::arena::{self, Findings};
use tiny_physics_quality::our_engine;
use tiny_physics_scenes::Scene;

/// Longer than any world takes on a slow and busy machine.
const LIMIT: Duration = Duration::from_secs(120);
/// Worlds that are tried for making one smaller.
const TRIES: u32 = 60;
/// Our cost counts as worse from this multiple of the best other's on, and some milliseconds more.
const DEAR: f64 = 2.0;
const DEAR_BY: f64 = 5.0;
/// A world in which ours is dear is played so many times more, and the least cost of each engine counts: times of a busy
/// machine are noisy.
const AGAIN: usize = 2;

/// Options of `arena`.
#[derive(Args)]
pub struct ArenaArgs {
    /// Seeds of the worlds, as A..B; B is not played.
    #[arg(long, value_name = "A..B", default_value = "0..100", value_parser = seeds)]
    seeds: std::ops::Range<u64>,
    /// Stop after so many minutes, whatever seeds are left.
    #[arg(long, value_name = "N")]
    minutes: Option<f64>,
    /// Play in this engine alone, without building the others: only what no world should show is found.
    #[arg(long)]
    ours: bool,
    /// Hash each world at two SIMD levels and on three threads, too.
    #[arg(long)]
    bits: bool,
    /// Leave worlds as large as they were drawn.
    #[arg(long)]
    whole: bool,
    /// Print one JSON object a world that is worse, and one for the sum, instead of lines.
    #[arg(long)]
    json: bool,
    /// The folder that the worlds are written to, as scene files.
    #[arg(long, value_name = "FOLDER", default_value = "arena")]
    out: PathBuf,
}

fn seeds(text: &str) -> Result<std::ops::Range<u64>, String> {
    let (first, end) = text.split_once("..").ok_or("seeds are given as A..B")?;
    let number = |text: &str| text.parse::<u64>().map_err(|error| format!("{text}: {error}"));
    Ok(number(first)?..number(end)?)
}

/// A world in which ours is worse.
#[derive(Serialize)]
struct Loss {
    seed: u64,
    /// What it was drawn from.
    parts: String,
    /// In what, our number, and the best of the others; the first is what the smaller world was kept for.
    worse: Vec<(String, f64, f64)>,
    /// Bodies and steps of the smaller world.
    bodies: usize,
    steps: u32,
    file: PathBuf,
}

/// What came of all worlds.
#[derive(Default, Serialize)]
struct Sum {
    played: usize,
    left_out: usize,
    /// Worlds in which ours is worse, cost counted, and in which each of the others is, cost not counted.
    worse: usize,
    box2d_is_worse: usize,
    rapier_is_worse: usize,
}

/// What came of a world.
#[derive(Default)]
struct Verdict {
    /// In what is ours worse?
    worse: Vec<(String, f64, f64)>,
    /// Is each of the others worse than the best of its others in anything but cost?
    others: [bool; 2],
}

/// Where worlds are played.
struct Arena {
    engines: Option<Engines>,
    bits: bool,
}

impl Arena {
    /// In what is ours worse in a world? `None` where it could not be played by all.
    fn judge(&self, scene: &Scene) -> Option<Verdict> {
        let Some(engines) = &self.engines else {
            return Some(Verdict { worse: self.alone(scene), ..Verdict::default() });
        };
        let found = play(engines, scene);
        let beside = |own: usize| -> Option<Vec<_>> {
            let others = (0..found.len()).filter(|&other| other != own);
            let others: Vec<Findings> = others.filter_map(|other| found[other].clone()).collect();
            if others.is_empty() {
                return None;
            }
            let crashed = || vec![("crashed or took too long", 1.0, 0.0)];
            Some(found[own].as_ref().map_or_else(crashed, |own| own.worse_than(&others)))
        };
        let mut worse: Vec<_> = self.differ(scene);
        worse.extend(beside(0)?.into_iter().map(|(name, a, b)| (name.to_owned(), a, b)));
        let mut costs = cost(&found);
        for _ in 0..AGAIN {
            if is_dear(costs) {
                let again = play(engines, scene);
                let [ours, best] = cost(&again);
                costs = [costs[0].min(ours), costs[1].min(best)];
            }
        }
        if is_dear(costs) {
            worse.push(("cost".into(), costs[0], costs[1]));
        }
        let others = [1, 2].map(|other| beside(other).is_some_and(|worse| !worse.is_empty()));
        Some(Verdict { worse, others })
    }

    /// What no world should show, in this engine alone.
    fn alone(&self, scene: &Scene) -> Vec<(String, f64, f64)> {
        let found = arena::play(scene, &our_engine, &|| 0.0);
        let mut worse = self.differ(scene);
        let value = |name: &str| {
            found.claims().iter().find(|claim| claim.name == name).map_or(f64::NAN, |c| c.value)
        };
        worse.extend(found.broken().map(|name| (name.to_owned(), value(name), 0.0)));
        worse
    }

    /// Do levels and threads differ?
    fn differ(&self, scene: &Scene) -> Vec<(String, f64, f64)> {
        if !self.bits {
            return Vec::new();
        }
        match arena::bits(scene) {
            Ok([scalar, best, threads]) if scalar == best && best == threads => Vec::new(),
            Ok(_) => vec![("other bits".into(), 1.0, 0.0)],
            Err(why) => vec![(format!("unsound: {why}"), 1.0, 0.0)],
        }
    }
}

/// What each engine makes of a world, ours first; `None` for one that could not play it.
fn play(engines: &Engines, scene: &Scene) -> Vec<Option<Findings>> {
    let answers = engines.each(&Task::Arena(Box::new(scene.clone())), LIMIT);
    let found = answers.into_iter().map(|answer| match answer {
        Ok(Answer::Arena(found)) => found,
        _ => None,
    });
    found.collect()
}

/// CPU time of ours and of the best other, milliseconds.
fn cost(found: &[Option<Findings>]) -> [f64; 2] {
    let least = |found: &[Option<Findings>]| {
        found.iter().flatten().map(|found| found.cost).fold(f64::INFINITY, f64::min)
    };
    [least(&found[..1]), least(&found[1..])]
}

fn is_dear([ours, best]: [f64; 2]) -> bool {
    ours > DEAR * best + DEAR_BY
}

/// Plays the worlds and prints those in which ours is worse, the smallest first.
///
/// # Errors
/// An engine that does not build, a folder that cannot be made.
pub fn run(args: &ArenaArgs) -> Result<(), String> {
    let engines = if args.ours { None } else { Some(Engines::build()?) };
    let arena = Arena { engines, bits: args.bits };
    std::fs::create_dir_all(&args.out)
        .map_err(|error| format!("{}: {error}", args.out.display()))?;
    let (start, mut sum, mut losses) = (Instant::now(), Sum::default(), Vec::new());
    for seed in args.seeds.clone() {
        if args.minutes.is_some_and(|minutes| start.elapsed().as_secs_f64() > 60.0 * minutes) {
            break;
        }
        let scene = arena::draw(seed);
        match arena.judge(&scene) {
            None => sum.left_out += 1,
            Some(Verdict { worse, others }) => {
                sum.played += 1;
                sum.box2d_is_worse += usize::from(others[0]);
                sum.rapier_is_worse += usize::from(others[1]);
                if !worse.is_empty() {
                    sum.worse += 1;
                    let loss = keep(&arena, args, seed, &scene, worse)?;
                    if !args.json {
                        eprintln!("{seed}: {}", loss.worse[0].0);
                    }
                    losses.push(loss);
                }
            }
        }
    }
    losses.sort_by_key(|loss| (loss.bodies, loss.steps));
    print(&losses, &sum, args.json)
}

/// Makes a world smaller as long as ours is worse in the same, and saves it.
fn keep(
    arena: &Arena,
    args: &ArenaArgs,
    seed: u64,
    scene: &Scene,
    worse: Vec<(String, f64, f64)>,
) -> Result<Loss, String> {
    let name = worse[0].0.clone();
    let mut shows = |smaller: &Scene| {
        let found = arena.judge(smaller);
        found.is_some_and(|found| found.worse.iter().any(|(what, ..)| *what == name))
    };
    let tries = if args.whole { 0 } else { TRIES };
    let mut least = if tries > 0 { arena::shrink(scene, tries, &mut shows) } else { scene.clone() };
    let family: String = name.chars().take_while(|c| c.is_alphabetic() || *c == ' ').collect();
    let file = args.out.join(format!("{}-{seed}.json", family.trim().replace(' ', "-")));
    least.description = format!("Seed {seed}: {name}. {}", scene.description);
    save(&least, &file)?;
    let (bodies, steps) = (least.bodies.len(), least.steps);
    Ok(Loss { seed, parts: scene.description.clone(), worse, bodies, steps, file })
}

fn save(scene: &Scene, file: &Path) -> Result<(), String> {
    scene.save(file).map_err(|error| error.to_string())
}

fn print(losses: &[Loss], sum: &Sum, json: bool) -> Result<(), String> {
    if json {
        for loss in losses {
            println!("{}", serde_json::to_string(loss).map_err(|error| error.to_string())?);
        }
        println!("{}", serde_json::to_string(sum).map_err(|error| error.to_string())?);
        return Ok(());
    }
    for loss in losses {
        let numbers =
            |(name, ours, best): &(String, f64, f64)| format!("{name} {ours:.4} (best {best:.4})");
        let worse: Vec<String> = loss.worse.iter().map(numbers).collect();
        println!(
            "seed {}, {} bodies, {} steps: {}",
            loss.seed,
            loss.bodies,
            loss.steps,
            worse.join("; ")
        );
        println!("    {}: {}", loss.file.display(), loss.parts);
    }
    let Sum { played, left_out, worse, box2d_is_worse, rapier_is_worse } = sum;
    println!(
        "{played} worlds played, {left_out} left out, ours is worse in {worse} (cost counted), Box2D in {box2d_is_worse}, Rapier in {rapier_is_worse}"
    );
    Ok(())
}
