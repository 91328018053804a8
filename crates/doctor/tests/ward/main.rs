//! A ward of sick worlds, each with its cause known: the doctor has to name it.
//!
//! `cargo test -p tiny-physics-doctor --test ward -- --nocapture` prints who was told what.

mod patients;
mod strangers;

use tiny_physics::{BodyId, RigidBody, Settings, Shape, Vec2, World};
use tiny_physics_doctor::{Code, Doctor, Report};

/// A sick world: its cause is known.
pub(crate) struct Patient {
    name: &'static str,
    code: Code,
    steps: u64,
    case: Case,
}

type Act = Box<dyn FnMut(&mut World, u64) -> f32>;

/// A world and what is done to it.
pub(crate) struct Case {
    world: World,
    /// Done before a step: the step's number, from 0. Gives the step's length.
    act: Act,
}

const DT: f32 = 1.0 / 60.0;

/// A world that nothing is done to.
fn left_alone(world: World) -> Case {
    Case { world, act: Box::new(|_, _| DT) }
}

/// A world to which something is done before each step.
fn with(world: World, mut act: impl FnMut(&mut World, u64) + 'static) -> Case {
    Case {
        world,
        act: Box::new(move |world, step| {
            act(world, step);
            DT
        }),
    }
}

/// An empty world with gravity 10 m/s^2.
fn earth() -> World {
    World::new(Vec2::new(0.0, -10.0))
}

fn earth_with(settings: Settings) -> World {
    World::with_settings(Vec2::new(0.0, -10.0), settings)
}

/// Ground whose top is at 0.
fn ground(world: &mut World) -> BodyId {
    let floor = Shape::rect(50.0, 0.5).unwrap();
    world.add_body(RigidBody::fixed().position(Vec2::new(0.0, -0.5)).shape(floor)).unwrap()
}

fn add(world: &mut World, body: RigidBody) -> BodyId {
    world.add_body(body).unwrap()
}

/// A dynamic body of one shape.
fn thing(shape: Shape, x: f32, y: f32) -> RigidBody {
    RigidBody::dynamic().position(Vec2::new(x, y)).shape(shape)
}

fn crate_at(x: f32, y: f32) -> RigidBody {
    thing(Shape::rect(0.5, 0.5).unwrap(), x, y)
}

fn examine(patient: &mut Patient) -> Report {
    let mut doctor = Doctor::new();
    let Case { world, act } = &mut patient.case;
    for step in 0..patient.steps {
        let dt = act(world, step);
        world.step(dt);
        doctor.watch(world);
    }
    doctor.report()
}

/// How many patients were told their cause, and how many as the first thing, of how many.
fn examine_all(mut patients: Vec<Patient>) -> [usize; 3] {
    let (mut named, mut first) = (0, 0);
    for patient in &mut patients {
        let report = examine(patient);
        let told: Vec<_> = report.findings.iter().map(|finding| finding.code.name()).collect();
        let code = patient.code.name();
        let (is_first, is_named) = (told.first() == Some(&code), told.contains(&code));
        let mark = match (is_first, is_named) {
            (true, _) => "first",
            (false, true) => "named",
            _ => "MISSED",
        };
        println!("{mark:<6} {code:<16} {:<42} told {}", patient.name, told.join(", "));
        match report.findings.first() {
            Some(finding) if is_first => println!("       {finding}"),
            _ => println!("{report}\n"),
        }
        named += usize::from(is_named);
        first += usize::from(is_first);
    }
    let count = patients.len();
    println!("{named} of {count} named, {first} first");
    [named, first, count]
}

fn assert_most([named, first, count]: [usize; 3]) {
    assert!(named * 100 >= count * 95, "{named} of {count} named");
    assert!(first * 100 >= count * 85, "{first} of {count} first");
}

#[test]
fn the_doctor_names_the_cause() {
    assert_most(examine_all(patients::all()));
}

/// These it has not been written for.
#[test]
fn strangers_are_told_too() {
    let patients = strangers::all();
    assert!(patients.len() >= 40);
    assert_most(examine_all(patients));
}

#[test]
fn every_code_has_patients() {
    let patients: Vec<_> = patients::all().into_iter().chain(strangers::all()).collect();
    for &code in Code::ALL {
        let count = patients.iter().filter(|patient| patient.code == code).count();
        assert!(count >= 2, "{count} suffer from {code}");
    }
}
