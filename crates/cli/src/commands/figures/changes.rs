//! What it costs to add many bodies one by one, and to remove them.

use super::{circles, how, print, print_head};
use crate::args::BenchArgs;
use crate::commands::timing::median;
use crate::failure::Outcome;
use serde::Serialize;
use std::io::Write;
use std::time::Instant;
use tiny_physics::{BodyId, BodyKind, RigidBody, Vec2, World};
use tiny_physics_scenes::Scene;

/// Seconds a step.
const DT: f32 = 1.0 / 60.0;
/// How far what was there before is from what is added, in roots of the number of bodies; a container is 1.2 wide.
const FAR: f32 = 3.0;
/// Steps of what was there before.
const SETTLE: u32 = 2;

/// So many bodies added to a world, every second one of them removed again; nanoseconds a body that is added,
/// removed or there.
#[derive(Serialize)]
struct Row {
    figure: &'static str,
    /// Bodies in the world before.
    before: usize,
    /// Bodies added.
    added: usize,
    /// A call of `add_body`.
    add_ns: f64,
    /// The first step after: it finds all pairs. By bodies in the world, as are all steps.
    first_step_ns: f64,
    /// The one after that, for comparison.
    second_step_ns: f64,
    /// A call of `remove_body`.
    remove_ns: f64,
    /// The first step after half of what was added has gone.
    next_step_ns: f64,
    /// A call of `add_body` when all that was added has gone, so that no new memory is needed.
    again_ns: f64,
}

/// Times of one run, in the order of the row.
type Times = [f64; 6];

/// Measures and prints a row for each size: into an empty container, and beside one that has as many already.
pub fn run(args: &BenchArgs, out: &mut impl Write) -> Outcome {
    let what = "circles added one by one, every second one removed, then the rest, and all added again; nanoseconds \
                by body";
    let names =
        ["before", "added", "add", "first step", "second", "remove", "next step", "add again"];
    let names = names.map(|name| format!("{name:>12}")).concat();
    print_head(out, args, &format!("{what}\n{names}"))?;
    for crowded in [false, true] {
        for &count in &args.bodies {
            let row = measure(args, count, crowded)?;
            let (before, added) = (row.before, row.added);
            let Row {
                add_ns,
                first_step_ns,
                second_step_ns,
                remove_ns,
                next_step_ns,
                again_ns,
                ..
            } = row;
            let times = [add_ns, first_step_ns, second_step_ns, remove_ns, next_step_ns, again_ns];
            let times = times.map(|time| format!("{time:>12.0}")).concat();
            print(out, args, &row, &format!("{before:>12}{added:>12}{times}"))?;
        }
    }
    Ok(())
}

/// The medians of some runs.
fn measure(args: &BenchArgs, count: u32, crowded: bool) -> Outcome<Row> {
    let scene = circles(count)?;
    let runs = (0..args.repeat).map(|_| run_once(args, &scene, crowded));
    let runs: Vec<Times> = runs.collect::<Outcome<_>>()?;
    let middle = |which: usize| median(runs.iter().map(|times| times[which]).collect());
    Ok(Row {
        figure: "changes",
        before: if crowded { count as usize } else { 0 },
        added: count as usize,
        add_ns: middle(0),
        first_step_ns: middle(1),
        second_step_ns: middle(2),
        remove_ns: middle(3),
        next_step_ns: middle(4),
        again_ns: middle(5),
    })
}

/// Fills a container, far from one that is full already or alone, empties it, and fills it again.
fn run_once(args: &BenchArgs, scene: &Scene, crowded: bool) -> Outcome<Times> {
    let (mut world, bodies) = (start(args, scene, crowded)?, scene.bodies.as_slice());
    let mut ids = Vec::with_capacity(bodies.len());
    let step = |world: &mut World| timed(world.body_count(), || world.step(DT)).0;
    let add_ns = add(&mut world, bodies, &mut ids)?;
    let (first, second) = (step(&mut world), step(&mut world));
    let half = || ids.iter().step_by(2);
    let (remove_ns, done) =
        timed(half().len(), || half().try_for_each(|&id| world.remove_body(id)));
    done?;
    let next = step(&mut world);
    ids.iter().skip(1).step_by(2).try_for_each(|&id| world.remove_body(id))?;
    ids.clear();
    let again_ns = add(&mut world, bodies, &mut ids)?;
    Ok([add_ns, first, second, remove_ns, next, again_ns])
}

/// The world in which bodies come and go: the container, and far from it another one that may be full.
fn start(args: &BenchArgs, scene: &Scene, crowded: bool) -> Outcome<World> {
    let mut world = World::with_settings(scene.gravity, scene.settings);
    world.set_threads(usize::from(args.threads));
    if let Some(level) = how(args).simd {
        world.set_simd(level)?;
    }
    let is_ground = |body: &&RigidBody| body.kind == BodyKind::Static;
    for body in scene.bodies.iter().filter(is_ground) {
        world.add_body(body.clone())?;
    }
    let elsewhere = Vec2::new(FAR * (scene.bodies.len() as f32).sqrt(), 0.0);
    for body in scene.bodies.iter().filter(|body| crowded || is_ground(body)) {
        world.add_body(body.clone().position(body.position + elsewhere))?;
    }
    (0..SETTLE).for_each(|_| world.step(DT));
    Ok(world)
}

/// Adds all bodies of a scene that can move one by one; nanoseconds each.
fn add(world: &mut World, bodies: &[RigidBody], ids: &mut Vec<BodyId>) -> Outcome<f64> {
    let movers = || bodies.iter().filter(|body| body.kind != BodyKind::Static);
    let (ns, done) = timed(movers().count(), || {
        movers().try_for_each(|body| world.add_body(body.clone()).map(|id| ids.push(id)))
    });
    done?;
    Ok(ns)
}

/// Nanoseconds that some work took, by so many bodies.
fn timed<R>(bodies: usize, work: impl FnOnce() -> R) -> (f64, R) {
    let start = Instant::now();
    let result = work();
    (start.elapsed().as_secs_f64() * 1.0e9 / bodies.max(1) as f64, result)
}
