//! The demo comes to rest, whatever its seed.

use tiny_physics::geometry::collide;
use tiny_physics::{Body, BodyKind, World};
use tiny_physics_scenes::{Options, Run, find};

const SEEDS: u64 = 200;
const STEPS: usize = 900;
/// Top of the ground, metres.
const FLOOR: f32 = -9.0;
const DEEPEST: f32 = 0.01;

/// How deep two bodies of one shape each overlap, metres; 0 where they do not.
fn overlap(world: &World, a: &Body<'_>, b: &Body<'_>) -> f32 {
    let shape = |body: &Body<'_>| *world.shape(body.shapes().next().unwrap()).unwrap().shape();
    let manifold = collide(&shape(a), &shape(b), b.pose().relative_to(a.pose()), 0.0);
    manifold.points().iter().fold(0.0, |deepest, p| (-p.separation).max(deepest))
}

/// What is wrong at the end of a run; measured between the shapes, because the world's own figure leaves
/// out what sleeps.
fn faults(world: &World) -> Vec<String> {
    let bodies: Vec<_> = world.body_ids().map(|id| world.body(id).unwrap()).collect();
    let mut faults = Vec::new();
    for (i, a) in bodies.iter().enumerate().filter(|(_, b)| b.kind() == BodyKind::Dynamic) {
        if a.is_awake() {
            faults.push(format!("body {i} is awake, speed {}", a.velocity().length()));
        }
        if !(a.position().y > FLOOR && a.position().x.abs() < 19.0) {
            faults.push(format!("body {i} left the floor: {:?}", a.position()));
        }
        for (j, b) in bodies.iter().enumerate() {
            let counted = b.kind() != BodyKind::Dynamic || j > i;
            let depth = if counted { overlap(world, a, b) } else { 0.0 };
            if depth > DEEPEST {
                faults.push(format!("bodies {i} and {j} overlap by {depth} m"));
            }
        }
    }
    faults
}

#[test]
fn the_demo_comes_to_rest_for_every_seed() {
    let entry = find("seed_demo").unwrap();
    let mut wrong = Vec::new();
    for seed in 0..SEEDS {
        let mut run = Run::start(&entry.build(Options::default().seed(seed))).unwrap();
        for _ in 0..STEPS {
            run.step();
        }
        wrong.extend(faults(run.world()).iter().map(|fault| format!("seed {seed}: {fault}")));
    }
    assert!(wrong.is_empty(), "{} faults\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn the_demo_starts_without_overlap() {
    let entry = find("seed_demo").unwrap();
    for (seeds, size) in [(SEEDS, 20), (2, 300)] {
        for seed in 0..seeds {
            let options = Options::default().seed(seed).size(size);
            let run = Run::start(&entry.build(options)).unwrap();
            let world = run.world();
            let bodies: Vec<_> = world.body_ids().map(|id| world.body(id).unwrap()).collect();
            for (i, a) in bodies.iter().enumerate().skip(4) {
                for b in &bodies[..i] {
                    assert_eq!(overlap(world, a, b), 0.0, "seed {seed}, body {i}");
                }
            }
        }
    }
}

/// Houses of cards, two millimetres thick and up to eight storeys high, stand until they sleep: then they stand for ever.
#[test]
fn houses_of_cards_stand() {
    for storeys in [2, 4, 5, 7, 8] {
        let scene = find("card_house").unwrap().build(Options::default().size(storeys));
        let mut run = Run::start(&scene).unwrap();
        let ids: Vec<_> = run.world().body_ids().collect();
        let place = |run: &Run, id| run.world().body(id).unwrap().position();
        let start: Vec<_> = ids.iter().map(|&id| place(&run, id)).collect();
        (0..1200).for_each(|_| run.step());
        for (&id, &start) in ids.iter().zip(&start) {
            let moved = (place(&run, id) - start).length();
            assert!(moved < 0.01, "{storeys} storeys: a card moved by {moved} m");
        }
        assert_eq!(run.world().awake_body_count(), 0, "{storeys} storeys still move");
    }
}
