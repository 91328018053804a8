//! The builders make what they should, the same every time, and every scene survives its file.

use tiny_physics::{BodyKind, Mix, Settings, Shape};
use tiny_physics_scenes::{Counts, Options, Run, Scene, Script, all, find, tags};

fn build(name: &str) -> Scene {
    find(name).unwrap().build(Options::default())
}

/// A smaller variant of the scenes that are too large for a test.
fn options(name: &str) -> Options {
    match name {
        "circles_1m" | "circles_100k" => Options::default().size(2000),
        "tile_world" => Options::default().size(520),
        "queries" => Options::default().size(260),
        "many_pyramids" => Options::default().size(5),
        "seed_pile_20000" | "circles_10k" => Options::default().size(2000),
        "sleep" | "joint_grid" => Options::default().size(20),
        _ => Options::default(),
    }
}

#[test]
fn benchmark_scenes_have_the_published_counts() {
    let rows = [
        // name, steps, sleep, bodies, shapes, joints, dynamic
        ("joint_grid", 500, false, 10_000, 10_000, 19_800, 9993),
        ("large_pyramid", 500, false, 5051, 5051, 0, 5050),
        ("many_pyramids", 200, false, 22_001, 22_020, 0, 22_000),
        ("rain", 1000, true, 1, 2505, 0, 0),
        ("smash", 300, true, 9601, 9601, 0, 9601),
        ("spinner", 500, true, 6078, 6437, 1, 6077),
        ("tumbler", 750, true, 2027, 2029, 1, 2026),
        ("sleep", 500, true, 18_301, 18_301, 0, 18_300),
    ];
    for (name, steps, sleep, bodies, shapes, joints, dynamic) in rows {
        let scene = build(name);
        assert_eq!(scene.counts(), Counts { bodies, dynamic, shapes, joints }, "{name}");
        assert_eq!((scene.steps, scene.settings.sleep), (steps, sleep), "{name}");
        assert_eq!(scene.gravity.y, if name == "smash" { 0.0 } else { -10.0 }, "{name}");
        assert_eq!(scene.settings.restitution_mix, Mix::Max, "{name}");
        assert_eq!(
            scene.settings,
            Settings { sleep, restitution_mix: Mix::Max, ..Settings::default() }
        );
    }
}

#[test]
fn own_scenes_have_their_counts() {
    for (name, count) in
        [("seed_pile_1000", 1000), ("seed_pile_5000", 5000), ("seed_pile_20000", 20_000)]
    {
        let scene = build(name);
        assert_eq!(scene.counts().dynamic, count, "{name}");
        assert_eq!(scene.counts().bodies, count + 3, "{name}");
        let boxes =
            scene.bodies[3..].iter().filter(|b| matches!(b.shapes[0].shape, Shape::Aabb { .. }));
        assert_eq!(boxes.count(), count / 2, "{name}");
    }
    for (name, count) in [("circles_10k", 10_000), ("circles_100k", 100_000)] {
        assert_eq!(build(name).counts().dynamic, count, "{name}");
    }
    let demo = build("seed_demo");
    assert_eq!(demo.counts(), Counts { bodies: 24, dynamic: 20, shapes: 24, joints: 0 });
    assert_eq!(build("tiles").counts().dynamic, 500);
    assert_eq!(build("ragdoll").counts().joints, 60);
}

#[test]
fn heavy_scenes_have_their_counts() {
    let queries = build("queries").counts();
    assert_eq!(queries.dynamic, 2000);
    let field = queries.bodies - 2000 - 2;
    assert!((24_300..24_900).contains(&field), "about 24.6k boxes, here {field}");
    let world = build("tile_world").counts();
    assert_eq!((world.bodies, world.dynamic), (2400 + 2000, 2000));
    assert_eq!(world.shapes, 288_000 + 2000, "12 tiles a column on average");
}

/// In the container nothing starts in a wall or in another body, except where neighbours touch.
#[test]
fn piles_start_without_overlap() {
    let scene = build("seed_pile_1000");
    let wall = &scene.bodies[2];
    let inner = wall.position.x - 1.0;
    assert!(scene.bodies[3..].iter().all(|b| b.position.x.abs() + 0.4 <= inner + 1e-5));
    for (i, a) in scene.bodies[3..].iter().enumerate() {
        for b in &scene.bodies[4 + i..] {
            let apart =
                (a.position.x - b.position.x).abs().max((a.position.y - b.position.y).abs());
            assert!(apart > 0.5, "bodies lie {apart} apart");
        }
    }
}

#[test]
fn the_demo_keeps_its_ranges() {
    for seed in 0..20 {
        let scene = find("seed_demo").unwrap().build(Options::default().seed(seed));
        for body in scene.bodies.iter().filter(|b| b.kind == BodyKind::Dynamic) {
            assert!(
                (-8.0..=8.0).contains(&body.position.x) && (5.0..=15.0).contains(&body.position.y)
            );
            assert_eq!((body.mass, body.shapes[0].material.restitution), (Some(1.0), 0.5));
            match body.shapes[0].shape {
                Shape::Circle { radius } => assert!((0.2..=0.8).contains(&radius)),
                Shape::Aabb { half_extents: h } => {
                    assert!((0.3..=0.7).contains(&h.x) && (0.3..=0.7).contains(&h.y));
                }
                other => panic!("{other:?} is neither circle nor box"),
            }
        }
    }
}

#[test]
fn a_seed_makes_one_scene_and_another_seed_another() {
    for entry in all().iter().filter(|e| e.has_tag(tags::SEEDED)) {
        let build = |seed| entry.build(Options::default().seed(seed));
        assert_eq!(build(7), build(7), "{}", entry.name);
        assert_ne!(build(7), build(8), "{}", entry.name);
    }
}

#[test]
fn every_scene_agrees_with_its_entry_and_survives_its_file() {
    for entry in all() {
        let scene = entry.build(options(entry.name));
        assert_eq!((scene.name.as_str(), scene.steps), (entry.name, entry.steps));
        assert!(!scene.description.is_empty() && !entry.description.is_empty());
        scene.check().unwrap_or_else(|e| panic!("{}: {e}", entry.name));
        let text = scene.to_json().unwrap();
        let again = Scene::from_json(&text).unwrap_or_else(|e| panic!("{}: {e}", entry.name));
        assert!(again == scene, "{} is another scene after its file", entry.name);
        assert!(again.to_json().unwrap() == text, "{}: the text is stable", entry.name);
    }
}

#[test]
fn sizes_are_cut_to_what_can_be_built() {
    for entry in all() {
        let scene = entry.build(Options::default().size(1));
        scene.check().unwrap_or_else(|e| panic!("{}: {e}", entry.name));
        let scene = entry.build(Options::default().size(0));
        scene.check().unwrap_or_else(|e| panic!("{}: {e}", entry.name));
    }
}

#[test]
fn names_are_unique() {
    let mut names: Vec<&str> = all().iter().map(|e| e.name).collect();
    names.sort_unstable();
    assert!(names.windows(2).all(|w| w[0] != w[1]));
}

#[test]
fn scripts_are_where_they_belong() {
    assert!(matches!(build("rain").script, Some(Script::Rain(_))));
    assert!(matches!(build("tiles").script, Some(Script::Walkers(_))));
    let Some(Script::WakeSleepers(wake)) = build("sleep").script else { panic!("no script") };
    assert_eq!(wake.bodies[..3], [1, 1831, 3661], "the first box of each pyramid");
}

/// What is timed until it sleeps has to fall asleep within the run; small worlds are cheap enough to see that.
#[test]
fn piles_fall_asleep_within_their_run() {
    for entry in all().iter().filter(|e| e.name.starts_with("pile_")) {
        let mut run = Run::start(&entry.build(Options::default())).expect(entry.name);
        (0..entry.steps).for_each(|_| run.step());
        assert_eq!(run.world().awake_body_count(), 0, "{} is still awake", entry.name);
    }
}

#[test]
fn small_scenes_have_their_counts() {
    for (name, dynamic) in [("crates_1", 1), ("crates_1000", 1000), ("pile_hexagons", 210)] {
        assert_eq!(build(name).counts().dynamic, dynamic, "{name}");
    }
    let game = build("game").counts();
    assert_eq!((game.dynamic, game.joints), (30 + 1 + 1 + 12, 13));
}
