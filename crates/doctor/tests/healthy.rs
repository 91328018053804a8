//! Healthy worlds: the doctor finds nothing worse than a note.
//!
//! `cargo test -p tiny-physics-doctor --test healthy -- --nocapture` prints what it finds all the same. The long runs are
//! ignored by default: `cargo test --release -p tiny-physics-doctor --test healthy -- --ignored --nocapture`.

use tiny_physics::{JointDef, JointKind, QueryFilter, RigidBody, Shape, World, contact};
use tiny_physics_doctor::{Code, Doctor, Finding, Report, Severity};
use tiny_physics_quality::{arena, our_engine};
use tiny_physics_scenes::{Options, Run, Scene, find, resolve};

/// What the doctor finds in scenes beyond notes, and why that is so: all but the last are true.
const TRUE: &[(&str, Code, &str)] = &[
    ("bowl", Code::OverlapAtStart, "four pairs are created up to 14 cm in each other"),
    ("tile_map", Code::OverlapAtStart, "16 pairs are created up to 53 cm in each other"),
    ("tiles", Code::OverlapAtStart, "50 pairs are created up to 78 cm in each other"),
    ("spinner", Code::OverlapAtStart, "40,000 pairs are created up to 1.1 m in each other"),
    ("spinner", Code::Tunnelling, "what is created so leaves through others"),
    ("spinner", Code::DeepOverlap, "the same"),
    ("pile_capsules", Code::OverlapAtStart, "38 pairs are created up to 9 cm in each other"),
    ("pile_mixed", Code::OverlapAtStart, "20 pairs are created up to 11 cm in each other"),
    ("pile_rings", Code::OverlapAtStart, "110 pairs are created up to 7 cm in each other"),
    ("joints", Code::LimitOverrun, "a slider begins 1 m outside its limits"),
    ("changing", Code::Stuck, "a ball grows into what lies about it"),
    ("changing", Code::DeepOverlap, "the same"),
    (
        "game",
        Code::JointStretch,
        "the rope is thrown onto the one-way plank that it hangs from, and pins are up to 26 cm apart there",
    ),
    ("game", Code::JointFight, "the same"),
    ("bullet_wall", Code::Stuck, "a turning bullet stays in the wall at a speed of 160 m/s"),
    (
        "blast",
        Code::Tunnelling,
        "a plank goes through a crate as both are blown away, and neither is a bullet",
    ),
    (
        "pile_planks",
        Code::Tunnelling,
        "planks of 7 cm meet at 35 cm a step, and neither is a bullet",
    ),
    ("galton_board", Code::Jitter, "balls that land on a column shake it for a moment"),
    ("sorting", Code::Filter, "parcels are meant to fall through gates: a false alarm"),
];

/// Is something worse than a note in the list?
fn is_true(name: &str, finding: &Finding) -> bool {
    finding.severity == Severity::Note
        || TRUE.iter().any(|&(scene, code, _)| scene == name && code == finding.code)
}

/// What the doctor says of a scene in so many steps at most, and the world after the last one.
fn examine(scene: &Scene, steps: u32) -> (Report, Run) {
    let mut run = Run::start(scene).unwrap();
    let mut doctor = Doctor::new();
    for _ in 0..steps.min(scene.steps) {
        run.step();
        doctor.watch(run.world());
    }
    (doctor.report(), run)
}

/// Those of some scenes in which the doctor finds what is not in the list.
fn ill_among(names: &[&'static str], steps: u32) -> Vec<&'static str> {
    let mut ill = Vec::new();
    for &name in names {
        let (report, _) = examine(&find(name).unwrap().build(Options::default()), steps);
        if !report.is_healthy() {
            println!("{name}: {report}\n");
        }
        if !report.findings.iter().all(|finding| is_true(name, finding)) {
            ill.push(name);
        }
    }
    ill
}

#[test]
fn show_scenes_are_healthy() {
    assert_eq!(ill_among(&resolve("show").unwrap(), u32::MAX), [""; 0]);
}

#[test]
fn game_is_healthy() {
    assert_eq!(ill_among(&["game", "tile_map"], 600), [""; 0]);
}

/// The first two seconds of each, but for the one that is the same in other sizes.
#[test]
#[ignore = "minutes in a debug build"]
fn benchmark_scenes_are_healthy() {
    let mut names = resolve("benchmark").unwrap();
    names.retain(|name| !["circles_10k"].contains(name));
    assert_eq!(ill_among(&names, 120), [""; 0]);
}

/// Does the arena's own judge, who knows nothing of the doctor, see what the doctor warns of? Such worlds are not healthy: joints
/// that are added out of place, shots into crates, motors as strong as a ship's.
fn is_confirmed(code: Code, scene: &Scene, judged: &arena::Findings) -> bool {
    match code {
        Code::JointStretch | Code::JointFight => {
            judged.gap.is_some_and(|gap| gap > 0.01) || starts_apart(scene)
        }
        Code::LimitOverrun => judged.overrun.is_some_and(|over| over > 0.03) || starts_apart(scene),
        Code::OverlapAtStart => starts_inside(scene),
        Code::DeepOverlap | Code::Stuck | Code::Sinking => judged.deepest > 0.04,
        Code::Tunnelling => judged.passed > 0,
        _ => false,
    }
}

/// Is a joint added whose anchors are not together?
fn starts_apart(scene: &Scene) -> bool {
    let run = Run::start(scene).unwrap();
    run.world().joints().any(|joint| {
        let (a, b) = joint.anchors();
        matches!(joint.def().kind, JointKind::Revolute { .. } | JointKind::Weld { .. })
            && a.relative_to(b).length() > 0.01
    })
}

/// Is a moving body put into something that it collides with, before any step?
fn starts_inside(scene: &Scene) -> bool {
    let run = Run::start(scene).unwrap();
    let world = run.world();
    world.shapes().filter(|own| !own.is_sensor()).any(|own| {
        let filter = QueryFilter { filter: own.filter(), ..QueryFilter::new() };
        let found = world.overlap_shape(own.shape(), own.pose(), &filter.exclude(own.body()));
        found.into_iter().filter_map(|id| world.shape(id)).any(|other| {
            let depth = contact(own.shape(), &own.pose(), other.shape(), &other.pose());
            depth.is_some_and(|contact| contact.depth > 0.04)
        })
    })
}

/// So many arena worlds that come to rest, from a seed on: those in which the doctor warns of what nobody else sees.
fn false_alarms(seed: u64, count: usize) -> Vec<u64> {
    let (mut wrong, mut confirmed, mut rested, mut seed) = (Vec::new(), 0, 0, seed);
    while rested < count {
        let scene = arena::draw(seed);
        let (report, run) = examine(&scene, scene.steps);
        if run.world().awake_body_count() == 0 {
            rested += 1;
            if !report.is_healthy() {
                let judged = arena::play(&scene, &our_engine, &|| 0.0);
                let mut worse = report.findings.iter().filter(|f| f.severity > Severity::Note);
                if worse.all(|finding| is_confirmed(finding.code, &scene, &judged)) {
                    confirmed += 1;
                } else {
                    println!("arena {seed} ({}): {report}\n{judged:?}\n", scene.description);
                    wrong.push(seed);
                }
            }
        }
        seed += 1;
    }
    println!("{count} arena worlds at rest: {confirmed} ill, {} false alarms", wrong.len());
    wrong
}

#[test]
fn arena_worlds_at_rest_are_healthy() {
    assert_eq!(false_alarms(0, 20), [0; 0]);
}

#[test]
#[ignore = "minutes in a debug build"]
fn two_hundred_arena_worlds_at_rest_are_healthy() {
    assert_eq!(false_alarms(0, 200), [0; 0]);
}

/// Bodies and joints come and go, things are always wrong: what the doctor holds stays what it was.
fn memory_after(steps: u32) -> [usize; 2] {
    let mut world = World::new((0.0, -10.0));
    let floor = Shape::rect(20.0, 0.5).unwrap();
    let floor = world.add_body(RigidBody::fixed().shape(floor)).unwrap();
    let mut doctor = Doctor::new();
    let mut memory = [0; 2];
    let mut bodies = std::collections::VecDeque::new();
    for step in 0..steps {
        // Created in each other and out of joint.
        let place = (f64::from(step % 7) - 3.0, 0.8 + 0.1 * f64::from(step % 5));
        let crate_ = RigidBody::dynamic().position(place).shape(Shape::rect(0.3, 0.3).unwrap());
        let new = world.add_body(crate_).unwrap();
        world.add_joint(floor, new, JointDef::revolute().anchors((0.0, 2.0), (0.5, 0.0))).unwrap();
        bodies.push_back(new);
        if bodies.len() > 20 {
            world.remove_body(bodies.pop_front().unwrap()).unwrap();
        }
        world.step(1.0 / 60.0);
        doctor.watch(&world);
        memory[usize::from(step >= steps / 10)] =
            memory[usize::from(step >= steps / 10)].max(doctor.memory());
    }
    assert!(doctor.report().findings.len() < 60);
    memory
}

#[test]
fn a_world_that_goes_back_is_watched_on() {
    let scene = find("bowl").unwrap().build(Options::default());
    let mut run = Run::start(&scene).unwrap();
    let mut doctor = Doctor::new();
    let frame = run.world().to_bytes();
    for _ in 0..3 {
        for _ in 0..40 {
            run.step();
            doctor.watch(run.world());
        }
        run.world_mut().restore_bytes(&frame).unwrap();
    }
    let report = doctor.report();
    assert_eq!(report.steps, 120);
    assert_eq!(report.findings[0].code, Code::OverlapAtStart);
    assert!(doctor.latest(60).is_some());
}

#[test]
fn memory_stays_bounded() {
    let [early, late] = memory_after(3_000);
    assert!(late <= early + early / 10 && late < 200_000, "{early} bytes, then {late}");
}

#[test]
#[ignore = "minutes in a debug build"]
fn memory_stays_bounded_over_100_000_steps() {
    let [early, late] = memory_after(100_000);
    println!("{early} bytes at most in the first 10,000 steps, {late} in the others");
    assert!(late <= early + early / 10 && late < 200_000, "{early} bytes, then {late}");
}
