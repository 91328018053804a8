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

#[test]
fn the_doctor_names_the_cause() {
    let mut patients = patients::all();
    assert!(patients.len() >= 26);
    let (mut named, mut first) = (0, 0);
    let count = patients.len();
    for patient in &mut patients {
        let report = examine(patient);
        let told: Vec<_> = report.findings.iter().map(|f| f.code.name()).collect();
        let (is_named, is_first) = (
            report.find(patient.code).is_some(),
            report.findings.first().is_some_and(|f| f.code == patient.code),
        );
        let mark = if is_first {
            "first"
        } else if is_named {
            "named"
        } else {
            "MISSED"
        };
        println!(
            "{mark:<6} {:<16} {:<40} told {}",
            patient.code.name(),
            patient.name,
            told.join(", ")
        );
        if !is_first {
            println!("{report}\n");
        }
        named += usize::from(is_named);
        first += usize::from(is_first);
    }
    println!("{named} of {count} named, {first} first");
    assert!(named * 100 >= count * 95, "{named} of {count} named");
    assert!(first * 100 >= count * 85, "{first} of {count} first");
}

#[test]
fn every_code_has_patients() {
    let patients = patients::all();
    for &code in Code::ALL {
        assert!(patients.iter().any(|patient| patient.code == code), "nobody suffers from {code}");
    }
}

/// The doctor knows the textbook's patients; these it has not been written for.
#[test]
fn strangers_are_told_too() {
    let mut patients = strangers::all();
    let count = patients.len();
    let mut named = 0;
    for patient in &mut patients {
        let report = examine(patient);
        let told: Vec<_> = report.findings.iter().map(|finding| finding.code.name()).collect();
        let is_named = report.find(patient.code).is_some();
        named += usize::from(is_named);
        let mark = match told.first() {
            Some(&first) if first == patient.code.name() => "first",
            _ if is_named => "named",
            _ => "MISSED",
        };
        let code = patient.code.name();
        println!("{mark:<6} {:<42} {code:<16} told {}", patient.name, told.join(", "));
    }
    println!("{named} of {count} strangers named");
    assert!(named >= 56, "{named} of {count} strangers named");
}
