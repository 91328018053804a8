//! Work to count instructions of, for `scripts/instructions.sh`: no clock is read here.
//!
//! With the name of a kernel it prepares the work, does it once inside [`measured`], which callgrind collects, and
//! prints the number of items worked on, what an item is, and the kernel whose count has to be taken off first,
//! if any. Without a name it lists the kernels.

mod parts;

use parts::{DT, KINDS, MARGIN};
use std::hint::black_box;
use std::ops::ControlFlow;
use std::process::ExitCode;
use tiny_physics::broad_phase::{BroadPhase, DynamicTree, ProxyDef, ProxyId, ProxyKind};
use tiny_physics::{QueryFilter, SimdLevel, SpatialHash, Vec2, World, collide};

/// Boxes of the broad phase.
const BOXES: usize = 2000;
/// Steps of a world.
const STEPS: usize = 5;
/// Passes that the solver is given on top, in a step of four substeps.
const MORE_ITERATIONS: u32 = 8;
const MORE_PASSES: usize = 32;

/// What was worked on.
struct Items {
    count: usize,
    name: &'static str,
    minus: Option<String>,
}

impl Items {
    fn new(count: usize, name: &'static str) -> Self {
        Self { count, name, minus: None }
    }
}

fn main() -> ExitCode {
    // Cargo adds options of its own.
    let Some(name) = std::env::args().skip(1).find(|argument| !argument.starts_with('-')) else {
        names().iter().for_each(|name| println!("{name}"));
        return ExitCode::SUCCESS;
    };
    match run(&name) {
        Ok(Items { count, name, minus }) => {
            println!("{count} {name} {}", minus.unwrap_or_default());
            ExitCode::SUCCESS
        }
        Err(what) => {
            eprintln!("{what}");
            ExitCode::FAILURE
        }
    }
}

fn names() -> Vec<String> {
    let mut names: Vec<String> =
        ["hash_insert", "hash_pairs", "tree_query", "tree_pairs"].map(String::from).into();
    names.extend(KINDS.map(|kind| format!("collide_{kind}")));
    names.push("ray_cast".into());
    for level in ["sse2", "avx2"] {
        let worlds = ["step_pyramid", "step_heap", "step_net", "solve_pyramid", "solve_net"];
        names.extend(worlds.map(|world| format!("{world}.{level}")));
    }
    names
}

/// All that is counted.
#[inline(never)]
fn measured(work: &mut dyn FnMut() -> usize) -> usize {
    // Not a jump, which would leave this function.
    black_box(work())
}

fn run(name: &str) -> Result<Items, String> {
    if let Some(kind) = name.strip_prefix("collide_").filter(|kind| KINDS.contains(kind)) {
        return Ok(manifolds(kind));
    }
    if let Some((work, level)) = name.split_once('.') {
        let level: SimdLevel = level.parse()?;
        if !level.is_available() {
            return Err(format!("this machine cannot run {level}"));
        }
        return steps(work, level).ok_or_else(|| format!("no kernel {name}"));
    }
    match name {
        "hash_insert" => Ok(hash_insert()),
        "hash_pairs" => Ok(hash_pairs()),
        "tree_query" => Ok(tree_query()),
        "tree_pairs" => Ok(tree_pairs()),
        "ray_cast" => Ok(ray_cast()),
        _ => Err(format!("no kernel {name}")),
    }
}

fn hash() -> SpatialHash {
    let boxes = parts::boxes(BOXES);
    let cell_size = SpatialHash::suggested_cell_size(boxes.iter().copied());
    let mut hash = SpatialHash::new(cell_size).expect("a positive size");
    (0..).zip(&boxes).for_each(|(id, aabb)| hash.insert(id, *aabb));
    hash
}

fn hash_insert() -> Items {
    let (boxes, mut hash) = (parts::boxes(BOXES), hash());
    measured(&mut || {
        hash.clear();
        (0..).zip(&boxes).for_each(|(id, aabb)| hash.insert(id, *aabb));
        hash.len()
    });
    Items::new(BOXES, "box")
}

fn hash_pairs() -> Items {
    let (hash, mut pairs) = (hash(), Vec::with_capacity(10 * BOXES));
    measured(&mut || {
        hash.pairs(&mut pairs);
        pairs.len()
    });
    Items::new(BOXES, "box")
}

fn tree_query() -> Items {
    let boxes = parts::boxes(BOXES);
    let mut tree = DynamicTree::new();
    (0..).zip(&boxes).for_each(|(id, aabb)| tree.insert(id, *aabb, 1));
    tree.rebuild();
    measured(&mut || {
        let mut found = 0;
        for aabb in &boxes {
            tree.query(aabb, 1, |_| {
                found += 1;
                ControlFlow::Continue(())
            });
        }
        found
    });
    Items::new(BOXES, "query")
}

fn tree_pairs() -> Items {
    let mut broad_phase = BroadPhase::new();
    for (user, aabb) in (0..).zip(parts::boxes(BOXES)) {
        let def = ProxyDef { kind: ProxyKind::Dynamic, category: 1, mask: 1, user, margin: MARGIN };
        broad_phase.create_proxy(def, aabb);
    }
    let mut pairs = Vec::new();
    broad_phase.update_pairs(&mut pairs);
    (0..BOXES as u32).for_each(|id| broad_phase.buffer(ProxyId(id)));
    pairs.clear();
    measured(&mut || {
        broad_phase.update_pairs(&mut pairs);
        pairs.len()
    });
    Items::new(BOXES, "box")
}

fn manifolds(kind: &str) -> Items {
    let ((a, b), places) = (parts::shapes(kind), parts::places(256));
    measured(&mut || {
        let one = |place| usize::from(collide(black_box(&a), black_box(&b), place, 0.02).count);
        places.iter().copied().map(one).sum()
    });
    Items::new(places.len(), "pair")
}

fn ray_cast() -> Items {
    let world = parts::heap(200, SimdLevel::Scalar);
    let (rays, filter) = (256, QueryFilter::default());
    measured(&mut || {
        let origin = |i: usize| Vec2::new(-8.0 + 16.0 * i as f32 / rays as f32, 12.0);
        let way = Vec2::new(0.5, -12.0);
        (0..rays).filter(|&i| world.ray_cast(origin(i), way, &filter).is_some()).count()
    });
    Items::new(rays, "ray")
}

/// Whole steps, or a solver's passes: steps with more of them, less steps without.
fn steps(work: &str, level: SimdLevel) -> Option<Items> {
    let (mut world, per_contact) = match work {
        "step_pyramid" | "solve_pyramid" => (parts::pyramid(20, level), true),
        "step_heap" => (parts::heap(300, level), true),
        "step_net" | "solve_net" => (parts::net(24, level), false),
        _ => return None,
    };
    let solve = work.starts_with("solve_");
    world.settings.iterations += if solve { MORE_ITERATIONS } else { 0 };
    let contacts = measured(&mut || step_on(&mut world));
    let joints = world.joint_count() * STEPS;
    let (count, name) = match (per_contact, solve) {
        (true, false) => (contacts, "contact.step"),
        (true, true) => (contacts * MORE_PASSES, "contact.pass"),
        (false, false) => (joints, "joint.step"),
        (false, true) => (joints * MORE_PASSES, "joint.pass"),
    };
    let minus = work.strip_prefix("solve_").map(|world| format!("step_{world}.{level}"));
    Some(Items { count, name, minus })
}

/// Makes steps, and adds their contacts up.
fn step_on(world: &mut World) -> usize {
    let mut contacts = 0;
    for _ in 0..STEPS {
        world.step(DT);
        contacts += world.contact_count();
    }
    contacts
}
