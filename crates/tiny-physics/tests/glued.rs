//! Lumps of joined bodies that overlap, so that their inner contacts and their joints contradict each other: nothing starts to turn by
//! itself, and what turns keeps on.

mod common;

use common::{Random, position, rect, steps};
use tiny_physics::{BodyId, JointDef, RigidBody, Settings, Vec2, World};

/// How the bodies are joined.
#[derive(Clone, Copy, Debug)]
enum Glue {
    Weld,
    SoftWeld,
    HingeWithLimits,
    HingeWithSpring,
    Slider,
}

const ALL: [Glue; 5] =
    [Glue::Weld, Glue::SoftWeld, Glue::HingeWithLimits, Glue::HingeWithSpring, Glue::Slider];

impl Glue {
    fn def(self) -> JointDef {
        match self {
            Self::Weld => JointDef::weld(),
            Self::SoftWeld => JointDef::weld().spring(6.0, 1.0),
            Self::HingeWithLimits => JointDef::revolute().limits(0.0, 0.0),
            Self::HingeWithSpring => JointDef::revolute().spring(6.0, 1.0),
            Self::Slider => JointDef::prismatic(Vec2::X).limits(0.0, 0.0),
        }
    }
}

/// Three crates, two of them joined to the third and so far into each other.
fn lump(random: &mut Random, glue: Glue, overlap: f32, unit: f32) -> (World, Vec<BodyId>) {
    let settings = Settings { length_unit: unit, ..Settings::default() };
    let mut world = World::with_settings(Vec2::ZERO, settings);
    let aside = random.range(-0.3, 0.3);
    let places = [
        Vec2::ZERO,
        Vec2::new(1.0, aside),
        Vec2::new(random.range(1.0, 1.3), aside + 1.0 - overlap),
    ];
    let crates = places.map(|place| {
        let crate_ = RigidBody::dynamic().shape(rect(0.5 * unit, 0.5 * unit));
        world.add_body(crate_.position(place * unit)).expect("a crate")
    });
    for k in [1, 2] {
        let at = Vec2::new(0.5, 0.5 * places[k].y) * unit;
        world.add_joint(crates[0], crates[k], glue.def().anchor_at(at)).expect("a joint");
    }
    (world, crates.to_vec())
}

/// Angular momentum about the origin, and the sum of the sizes of what makes it up.
fn turning(world: &World) -> [f64; 2] {
    world.bodies().fold([0.0; 2], |[sum, size], body| {
        let (mass, turn) = (f64::from(body.mass()), f64::from(body.angular_velocity()));
        let (place, v) = (body.center(), body.velocity());
        let orbit = mass * (place.x * f64::from(v.y) - place.y * f64::from(v.x));
        let spin = f64::from(body.inertia()) * turn;
        [sum + orbit + spin, size + orbit.abs() + spin.abs()]
    })
}

#[test]
fn what_rests_goes_on_resting() {
    let mut bad = Vec::new();
    for glue in ALL {
        for (k, overlap) in [0.01, 0.03, 0.1, 0.3].into_iter().cycle().take(12).enumerate() {
            let mut random = Random::new(k as u64);
            let unit = [1.0, 0.05, 20.0][k % 3];
            let (mut world, crates) = lump(&mut random, glue, overlap, unit);
            steps(&mut world, 600);
            let turn = world.body(crates[0]).expect("a crate").angular_velocity().abs();
            let awake = world.body(crates[0]).expect("a crate").is_awake();
            if turn > 0.01 || awake {
                bad.push(format!("{glue:?} {overlap} {unit}: {turn} rad/s, awake {awake}"));
            }
        }
    }
    assert!(bad.is_empty(), "{} of {}: {bad:#?}", bad.len(), 12 * ALL.len());
}

#[test]
fn what_turns_keeps_its_angular_momentum() {
    for glue in ALL {
        for (k, overlap) in [0.01, 0.03].into_iter().cycle().take(12).enumerate() {
            let mut random = Random::new(k as u64);
            let (mut world, crates) = lump(&mut random, glue, overlap, 1.0);
            let middle = Vec2::new(0.7, 0.3);
            for &id in &crates {
                let from = position(&world, id);
                let mut body = world.body_mut(id).expect("a crate");
                let place = from - middle;
                body.set_velocity(place.perp() * 2.0);
                body.set_angular_velocity(2.0);
            }
            let [before, size] = turning(&world);
            steps(&mut world, 300);
            let [after, _] = turning(&world);
            let error = (after - before).abs() / size;
            assert!(error < 1e-4, "{glue:?} {overlap}: {before} {after}");
        }
    }
}
