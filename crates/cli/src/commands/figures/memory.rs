//! How much memory bodies and contacts take.

use super::{built_in, circles, print, print_head};
use crate::args::BenchArgs;
use crate::commands::soak::memory_kb;
use crate::failure::Outcome;
use serde::Serialize;
use std::io::Write;
use tiny_physics::{Memory, MemoryUse, Polygon, Shape};
use tiny_physics_scenes::{Run, Scene};

/// Steps until contacts are there.
const STEPS: u32 = 120;
/// Most rows of the pyramid.
const ROWS: u32 = 100;
/// Most pentagons.
const PENTAGONS: u32 = 10_000;

/// What a world holds after some steps.
#[derive(Serialize)]
struct Row {
    figure: &'static str,
    scene: String,
    bodies: usize,
    /// Those that touch.
    contacts: usize,
    /// Bytes a body: it, its shape, its boxes and its part of the tree.
    body: Bytes,
    /// Bytes a contact that touches: its record, its lanes, and pairs that do not touch yet.
    contact: Bytes,
    /// Bytes of the whole world.
    total: Bytes,
    /// What the whole process holds in memory, bytes, with what worlds before left to the allocator; Linux only.
    resident: Option<u64>,
    parts: Parts,
}

/// Memory in use, and memory with the room that lists have to grow.
#[derive(Serialize, Clone, Copy)]
struct Bytes {
    used: usize,
    held: usize,
}

/// Bytes by what they are for.
#[derive(Serialize)]
struct Parts {
    bodies: Bytes,
    shapes: Bytes,
    broad_phase: Bytes,
    contacts: Bytes,
    graph: Bytes,
    /// Those of the graph that every pass of the solver goes through.
    constraints: Bytes,
    joints: Bytes,
    other: Bytes,
    scratch: Bytes,
}

/// Measures and prints a row for a pyramid, for a pile of pentagons, and for each size.
pub fn run(args: &BenchArgs, out: &mut impl Write) -> Outcome {
    let what = format!(
        "memory after {} steps; bytes used and held (lists have room to grow), and what the process has in memory",
        steps(args)
    );
    let names = ["bodies", "contacts", "per body", "held", "per contact", "held"];
    let names = names.map(|name| format!("{name:>12}")).concat();
    let sums = ["total MB", "held MB", "process"].map(|name| format!("{name:>10}")).concat();
    print_head(out, args, &format!("{what}\n{:15}{names}{sums}", "scene"))?;
    let largest = args.bodies.iter().copied().max().unwrap_or(1);
    let rows = f64::from(2 * largest).sqrt() as u32;
    row(args, out, || built_in("large_pyramid", rows.clamp(1, ROWS)))?;
    row(args, out, || pentagons(largest.min(PENTAGONS)))?;
    for &count in &args.bodies {
        row(args, out, || Ok(Scene { name: "circles".into(), ..circles(count)? }))?;
    }
    Ok(())
}

fn steps(args: &BenchArgs) -> u32 {
    args.steps.unwrap_or(STEPS)
}

/// The pile of circles with pentagons in their places.
fn pentagons(count: u32) -> Outcome<Scene> {
    let pentagon = Shape::Polygon(Polygon::regular(5, 0.4)?);
    let mut scene = Scene { name: "pentagons".into(), ..circles(count)? };
    let shapes = scene.bodies.iter_mut().flat_map(|body| &mut body.shapes);
    shapes
        .filter(|def| matches!(def.shape, Shape::Circle { .. }))
        .for_each(|def| def.shape = pentagon);
    Ok(scene)
}

fn row(args: &BenchArgs, out: &mut impl Write, scene: impl FnOnce() -> Outcome<Scene>) -> Outcome {
    let row = measure(args, scene)?;
    let Row { scene, bodies, contacts, body, contact, total, .. } = &row;
    let each = [*bodies, *contacts, body.used, body.held, contact.used, contact.held];
    let each = each.map(|bytes| format!("{bytes:>12}")).concat();
    let megabytes = |bytes: usize| format!("{:>10.1}", bytes as f64 * 1.0e-6);
    let resident = row.resident.map_or(format!("{:>10}", "-"), |bytes| megabytes(bytes as usize));
    let sums = [megabytes(total.used), megabytes(total.held), resident].concat();
    print(out, args, &row, &format!("{scene:15}{each}{sums}"))
}

fn measure(args: &BenchArgs, build: impl FnOnce() -> Outcome<Scene>) -> Outcome<Row> {
    let scene = build()?;
    let mut run = Run::start(&scene)?;
    run.world_mut().set_threads(usize::from(args.threads));
    let name = scene.name.clone();
    // What the process holds is to be the world's alone.
    drop(scene);
    (0..steps(args)).for_each(|_| run.step());
    let world = run.world();
    let (body_count, contact_count) = (world.body_count(), world.contact_count());
    let memory = world.memory();
    let Memory { bodies, shapes, broad_phase, contacts, graph, .. } = memory;
    let Memory { constraints, joints, other, scratch, .. } = memory;
    Ok(Row {
        figure: "memory",
        scene: name,
        bodies: body_count,
        contacts: contact_count,
        body: share([bodies, shapes, broad_phase], body_count),
        contact: share([contacts, graph], contact_count),
        total: share([memory.total()], 1),
        resident: memory_kb().map(|kb| kb * 1024),
        parts: Parts {
            bodies: share([bodies], 1),
            shapes: share([shapes], 1),
            broad_phase: share([broad_phase], 1),
            contacts: share([contacts], 1),
            graph: share([graph], 1),
            constraints: share([constraints], 1),
            joints: share([joints], 1),
            other: share([other], 1),
            scratch: share([scratch], 1),
        },
    })
}

/// The part of one of so many.
fn share<const N: usize>(parts: [MemoryUse; N], count: usize) -> Bytes {
    let MemoryUse { used, held } = parts.into_iter().sum();
    Bytes { used: used / count.max(1), held: held / count.max(1) }
}
