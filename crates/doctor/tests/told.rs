//! What is told, how often and how gravely.

use tiny_physics::{BodyId, JointDef, RigidBody, Shape, Vec2, World};
use tiny_physics_doctor::{Code, Doctor, Report, Severity};

const DT: f32 = 1.0 / 60.0;

/// A body by itself without gravity.
fn alone() -> (World, BodyId) {
    let mut world = World::new(Vec2::ZERO);
    let ball = RigidBody::dynamic().shape(Shape::circle(0.5).unwrap());
    let ball = world.add_body(ball).unwrap();
    (world, ball)
}

fn run(world: &mut World, steps: usize, dt: impl Fn(usize) -> f32) -> Report {
    let mut doctor = Doctor::new();
    for step in 0..steps {
        world.step(dt(step));
        doctor.watch(world);
    }
    doctor.report()
}

fn severity(report: &Report, code: Code) -> Option<Severity> {
    report.findings.iter().filter(|found| found.code == code).map(|found| found.severity).max()
}

/// A wheel on a base with two motors: of the first and the second end, of both.
fn two_motors(speeds: [f32; 2], swapped: bool, second: bool) -> Report {
    let mut world = World::new(Vec2::ZERO);
    let base = world.add_body(RigidBody::fixed()).unwrap();
    let wheel = RigidBody::dynamic().can_sleep(false).shape(Shape::circle(0.5).unwrap());
    let wheel = world.add_body(wheel).unwrap();
    let motor = |speed| JointDef::revolute().anchor_at((0.0, 0.0)).motor(speed, 50.0);
    world.add_joint(base, wheel, motor(speeds[0])).unwrap();
    let (a, b) = if swapped { (wheel, base) } else { (base, wheel) };
    world.add_joint(a, b, JointDef { enabled: second, ..motor(speeds[1]) }).unwrap();
    run(&mut world, 240, |_| DT)
}

#[test]
fn motors_are_rivals_where_both_work_and_want_different_things() {
    let fights = |speeds, swapped, second| {
        severity(&two_motors(speeds, swapped, second), Code::JointFight).is_some()
    };
    assert!(fights([2.0, -1.0], false, true));
    assert!(fights([2.0, 1.0], true, true));
    assert!(!fights([2.0, 2.0], false, true));
    assert!(!fights([2.0, -2.0], true, true), "ends swapped: they agree");
    assert!(!fights([2.0, -1.0], false, false), "the second is turned off");
}

#[test]
fn one_long_step_at_the_start_is_a_hitch() {
    let first = |step| if step == 0 { 0.1 } else { DT };
    let told = severity(&run(&mut alone().0, 60, first), Code::StepTooLong);
    assert_eq!(told, Some(Severity::Note));
    let told = severity(&run(&mut alone().0, 60, |_| 0.1), Code::StepTooLong);
    assert_eq!(told, Some(Severity::Warning));
}

#[test]
fn steps_of_many_lengths_are_told_within_64() {
    let uneven = |step| if step % 2 == 0 { DT } else { 0.5 * DT };
    assert!(severity(&run(&mut alone().0, 64, uneven), Code::VariableStep).is_some());
}

#[test]
fn what_was_refused_before_going_back_is_not_told_again() {
    let (mut world, ball) = alone();
    let mut doctor = Doctor::new();
    let mut watch = |world: &mut World| {
        world.step(DT);
        doctor.watch(world);
        let report = doctor.report();
        report
            .findings
            .iter()
            .filter(|f| f.code == Code::RefusedInput)
            .map(|f| f.count)
            .sum::<u64>()
    };
    watch(&mut world);
    let saved = world.clone();
    world.body_mut(ball).unwrap().set_velocity(Vec2::new(f32::NAN, 0.0));
    (0..10).for_each(|_| assert_eq!(watch(&mut world), 1));
    world.clone_from(&saved);
    assert_eq!(watch(&mut world), 1);
}

#[test]
fn all_that_is_alike_is_counted() {
    let mut world = World::new(Vec2::ZERO);
    for i in 0..40 {
        let at = Vec2::new(3.0 * i as f32, 0.0);
        let hub = world.add_body(RigidBody::fixed().position(at)).unwrap();
        let wheel = RigidBody::dynamic().position(at).can_sleep(false);
        let wheel = wheel.shape(Shape::circle(0.5).unwrap());
        let wheel = world.add_body(wheel).unwrap();
        for speed in [2.0, -1.0] {
            let hinge = JointDef::revolute().anchor_at(at).motor(speed, 50.0);
            world.add_joint(hub, wheel, hinge).unwrap();
        }
    }
    let report = run(&mut world, 400, |_| DT);
    let fights = report.findings.iter().filter(|found| found.code == Code::JointFight);
    let told: u64 = fights.map(|found| 1 + found.others).sum();
    assert_eq!(told, 80);
}

#[test]
fn findings_about_the_world_do_not_hide_each_other() {
    let mut world = World::new(Vec2::ZERO);
    world.settings.substeps = 60;
    for i in 0..2100 {
        let place = Vec2::new(3.0 * i as f32, 0.0);
        let body = if i < 60 { RigidBody::dynamic() } else { RigidBody::fixed() };
        world.add_body(body.position(place).shape(Shape::circle(0.5).unwrap())).unwrap();
    }
    let report = run(&mut world, 5, |_| DT);
    let slow: Vec<_> = report.findings.iter().filter(|f| f.code == Code::Slow).collect();
    let told = |word| slow.iter().any(|found| found.what.contains(word));
    assert!(told("static bodies") && told("times a step"), "{report}");
    assert!(slow.iter().all(|found| found.others == 0), "{report}");
}

#[test]
fn refused_numbers_and_stale_handles_are_both_told() {
    let (mut world, ball) = alone();
    let gone = world.add_body(RigidBody::dynamic()).unwrap();
    world.remove_body(gone).unwrap();
    world.body_mut(ball).unwrap().set_velocity(Vec2::new(f32::NAN, 0.0));
    let _ = world.remove_body(gone);
    let _ = world.body_mut(gone);
    assert!(world.stats().stale_handles > 0, "the test is of two findings");
    let report = run(&mut world, 2, |_| DT);
    let told: Vec<_> = report.findings.iter().map(|f| (f.code, f.severity)).collect();
    let both = [Severity::Error, Severity::Note].map(|severity| (Code::RefusedInput, severity));
    assert_eq!(told, both, "{report}");
}
