//! Healthy worlds: the doctor finds nothing worse than a note.

use tiny_physics_doctor::{Doctor, Report};
use tiny_physics_scenes::{Options, Run, find, resolve};

/// Show scenes in which the doctor finds something worse than a note, and rightly so, but for `sorting`, whose parcels are
/// meant to fall through floors that their masks exclude.
const ILL: &[&str] =
    &["bridge", "joints", "bullet_wall", "breaking_bridge", "bowl", "changing", "blast", "sorting"];

fn examine(name: &str) -> Report {
    let scene = find(name).unwrap().build(Options::default());
    let steps = scene.steps.min(600);
    let mut run = Run::start(&scene).unwrap();
    let mut doctor = Doctor::new();
    for _ in 0..steps {
        run.step();
        doctor.watch(run.world());
    }
    doctor.report()
}

#[test]
fn show_scenes_are_healthy() {
    let mut ill = Vec::new();
    for name in resolve("show").unwrap() {
        let report = examine(name);
        if !report.is_healthy() {
            println!("{name}: {report}\n");
            ill.push(name);
        }
    }
    ill.retain(|name| !ILL.contains(name));
    assert!(ill.is_empty(), "{ill:?}");
}

#[test]
fn memory_and_findings_stay_bounded() {
    let scene = find("bowl").unwrap().build(Options::default());
    let mut run = Run::start(&scene).unwrap();
    let mut doctor = Doctor::new();
    for _ in 0..2000 {
        run.step();
        doctor.watch(run.world());
    }
    assert!(doctor.report().findings.len() < 60);
}
