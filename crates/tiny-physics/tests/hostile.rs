//! Hostile input: every public function meets NaN, infinite, zero, negative and enormous numbers and
//! stale handles; it gives an error or does nothing, and the world goes on.

mod common;

use common::*;
use tiny_physics::{
    BodyId, DVec2, Error, FixedStep, JointDef, Pose, RigidBody, Rot, ShapeDef, ShapeId, Vec2, World,
};

const NOT_FINITE: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

/// Finite, but far outside what a scene has.
const ENORMOUS: [f32; 4] = [f32::MAX, -f32::MAX, 1.0e30, -1.0e30];

/// A floor, a crate that lies on it, and a ball in the air.
fn scene() -> (World, BodyId, BodyId) {
    let mut world = world_with_floor();
    let crate_ = drop_at(&mut world, rect(0.5, 0.5), 0.0, 0.5);
    let ball = drop_at(&mut world, circle(0.3), 0.2, 3.0);
    steps(&mut world, 10);
    (world, crate_, ball)
}

/// The world goes on: its data are sound, and a new body falls on the floor as ever.
fn goes_on(mut world: World, what: &str) {
    for step in 0..10 {
        world.step(DT);
        world.validate().unwrap_or_else(|error| panic!("{what}, step {step}: {error}"));
    }
    // What was flung about must not hit the new one by chance.
    for id in world.body_ids().skip(1).collect::<Vec<_>>() {
        world.remove_body(id).unwrap();
    }
    let fresh = drop_at(&mut world, rect(0.5, 0.5), 50.0, 0.7);
    steps(&mut world, 60);
    let height = position(&world, fresh).y;
    assert!((height - 0.5).abs() < 0.02, "{what}: a new box comes to lie at {height}");
    world.validate().unwrap_or_else(|error| panic!("{what}: {error}"));
}

#[test]
fn a_description_with_a_bad_number_is_refused_with_its_name() {
    let sound = || RigidBody::dynamic().shape(circle(0.5));
    let with_shape = |change: &dyn Fn(&mut ShapeDef)| {
        let mut body = sound();
        change(&mut body.shapes[0]);
        body
    };
    for bad in NOT_FINITE {
        let bodies = [
            ("position.x", sound().position(Vec2::new(bad, 0.0))),
            ("position.y", sound().position(Vec2::new(0.0, bad))),
            ("angle", sound().angle(bad)),
            ("velocity", sound().velocity(Vec2::new(bad, 0.0))),
            ("velocity", sound().velocity(Vec2::new(0.0, bad))),
            ("angular_velocity", sound().angular_velocity(bad)),
            ("linear_damping", sound().damping(bad, 0.0)),
            ("angular_damping", sound().damping(0.0, bad)),
            ("gravity_scale", sound().gravity_scale(bad)),
            ("sleep_speed", RigidBody { sleep_speed: bad, ..sound() }),
            ("mass", sound().mass(bad)),
            ("offset", with_shape(&|shape| shape.offset.x = bad)),
            ("angle", with_shape(&|shape| shape.angle = bad)),
            ("density", with_shape(&|shape| shape.material.density = bad)),
            ("friction", with_shape(&|shape| shape.material.friction = bad)),
            ("restitution", with_shape(&|shape| shape.material.restitution = bad)),
            ("rolling_resistance", with_shape(&|shape| shape.material.rolling_resistance = bad)),
            ("tangent_speed", with_shape(&|shape| shape.material.tangent_speed = bad)),
            ("one_way", with_shape(&|shape| shape.one_way = Some(Vec2::new(0.0, bad)))),
        ];
        for (field, body) in bodies {
            let mut world = world();
            let error = world.add_body(body).expect_err(field);
            let named = matches!(&error, Error::NotFinite { name, .. } if *name == field);
            assert!(named, "{field} = {bad}: {error:?}");
            assert_eq!((world.body_count(), world.shape_count()), (0, 0));
        }
    }
}

#[test]
fn a_description_out_of_range_is_refused_with_its_name() {
    let sound = || RigidBody::dynamic().shape(circle(0.5));
    let bodies = [
        ("position.x", sound().position(DVec2::new(1.0e300, 0.0))),
        ("linear_damping", sound().damping(-1.0, 0.0)),
        ("angular_damping", sound().damping(0.0, -1.0)),
        ("sleep_speed", RigidBody { sleep_speed: -0.1, ..sound() }),
        ("mass", sound().mass(0.0)),
        ("mass", sound().mass(-1.0)),
        ("mass", RigidBody::new(circle(0.5), Vec2::ZERO, -1.0)),
        ("density", RigidBody::dynamic().shape(ShapeDef::new(circle(0.5)).density(-1.0))),
        ("friction", sound().friction(-0.1)),
        ("restitution", sound().restitution(-0.1)),
    ];
    for (field, body) in bodies {
        let error = world().add_body(body).expect_err(field);
        let named = matches!(&error, Error::OutOfRange { name, .. } if *name == field);
        assert!(named, "{field}: {error:?}");
    }
    assert!(RigidBody::new(circle(0.5), Vec2::ZERO, f32::NAN).mass.is_some_and(f32::is_nan));
}

#[test]
fn degenerate_shapes_are_refused() {
    let shapes = [
        ("circle without radius", circle(0.0)),
        ("circle of negative radius", circle(-1.0)),
        ("circle of radius NaN", circle(f32::NAN)),
        ("circle of infinite radius", circle(f32::INFINITY)),
        ("box without width", upright(0.0, 1.0)),
        ("box of negative height", upright(1.0, -1.0)),
        ("box of width NaN", upright(f32::NAN, 1.0)),
        ("capsule without radius", capsule(1.0, 0.0)),
        ("capsule of radius NaN", capsule(1.0, f32::NAN)),
        ("capsule of infinite length", capsule(f32::INFINITY, 1.0)),
    ];
    for (name, shape) in shapes {
        let (mut world, crate_, _) = scene();
        assert!(world.add_body(RigidBody::dynamic().shape(shape)).is_err(), "{name}, new body");
        assert!(
            world.add_body(RigidBody::new(shape, Vec2::ZERO, 1.0)).is_err(),
            "{name}, with mass"
        );
        assert!(world.add_shape(crate_, shape).is_err(), "{name}, more shape");
        goes_on(world, name);
    }
    for (width, height) in [(0.0, 1.0), (1.0, 0.0), (-1.0, 1.0), (f32::NAN, 1.0)] {
        assert!(tiny_physics::Polygon::rect(width, height).is_err());
    }
}

#[test]
fn steps_that_are_no_steps_change_nothing() {
    let (mut world, ..) = scene();
    let before = world.state_hash();
    for dt in [0.0, -0.0, -1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        world.step(dt);
        assert!(world.try_step(dt).is_err());
        assert_eq!(world.state_hash(), before, "dt = {dt}");
    }
    assert_eq!(world.stats().refused_steps, 6);
    goes_on(world, "refused steps");
}

#[test]
fn gravity_that_is_not_finite_refuses_the_step() {
    for bad in NOT_FINITE {
        let (mut world, ..) = scene();
        let gravity = world.gravity;
        world.gravity.x = bad;
        assert!(world.try_step(DT).is_err());
        world.gravity = gravity;
        goes_on(world, "gravity");
    }
}

#[test]
fn tiny_and_huge_steps_and_gravities_leave_the_world_sound() {
    for dt in [f32::MIN_POSITIVE, 1.0e-30, 1.0e-10, 10.0, 1.0e6, 1.0e30, f32::MAX] {
        let (mut world, ..) = scene();
        for _ in 0..3 {
            let _ = world.try_step(dt);
            world.validate().unwrap_or_else(|error| panic!("dt {dt}: {error}"));
        }
    }
    for gravity in ENORMOUS {
        let (mut world, ..) = scene();
        let usual = world.gravity;
        world.gravity.y = gravity;
        let _ = world.try_step(DT);
        world.validate().unwrap_or_else(|error| panic!("gravity {gravity}: {error}"));
        world.gravity = usual;
        goes_on(world, "enormous gravity");
    }
}

#[test]
fn hostile_settings_leave_the_world_sound() {
    type Change = fn(&mut World, f32);
    let changes: [(&str, Change); 9] = [
        ("length_unit", |world, value| world.settings.length_unit = value),
        ("contact_hertz", |world, value| world.settings.contact_hertz = value),
        ("contact_damping_ratio", |world, value| world.settings.contact_damping_ratio = value),
        ("push_speed", |world, value| world.settings.push_speed = value),
        ("restitution_threshold", |world, value| world.settings.restitution_threshold = value),
        ("hit_event_threshold", |world, value| world.settings.hit_event_threshold = value),
        ("max_speed", |world, value| world.settings.max_speed = value),
        ("time_to_sleep", |world, value| world.settings.time_to_sleep = value),
        ("substeps and iterations", |world, value| {
            (world.settings.substeps, world.settings.iterations) =
                (value as u32 % 100, value as u32 % 10);
        }),
    ];
    for (name, change) in changes {
        for value in [0.0, -1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, 1.0e-30] {
            let (mut world, ..) = scene();
            let usual = world.settings;
            change(&mut world, value);
            for _ in 0..2 {
                let _ = world.try_step(DT);
                world.validate().unwrap_or_else(|error| panic!("{name} = {value}: {error}"));
            }
            world.settings = usual;
            goes_on(world, &format!("{name} = {value}"));
        }
    }
}

type Act = fn(&mut World, BodyId, f32);

/// Everything that a body can be told, with a number.
const ACTS: [(&str, Act); 15] = [
    ("set_position", |w, id, n| w.body_mut(id).unwrap().set_position(Vec2::new(n, 1.0))),
    ("set_position, 64 bits", |w, id, n| {
        w.body_mut(id).unwrap().set_position(DVec2::new(1.0, f64::from(n) * 1.0e10));
    }),
    ("set_angle", |w, id, n| w.body_mut(id).unwrap().set_angle(n)),
    ("set_pose, rotation", |w, id, n| {
        let pose = Pose::new(DVec2::new(0.0, 4.0), Rot { c: n, s: 0.0 });
        w.body_mut(id).unwrap().set_pose(pose);
    }),
    ("set_velocity", |w, id, n| w.body_mut(id).unwrap().set_velocity(Vec2::new(1.0, n))),
    ("set_angular_velocity", |w, id, n| w.body_mut(id).unwrap().set_angular_velocity(n)),
    ("apply_force", |w, id, n| w.body_mut(id).unwrap().apply_force(Vec2::new(n, n), Vec2::ZERO)),
    ("apply_force at", |w, id, n| {
        w.body_mut(id).unwrap().apply_force(Vec2::Y, Vec2::new(n, 0.0));
    }),
    ("apply_force_to_center", |w, id, n| {
        w.body_mut(id).unwrap().apply_force_to_center(Vec2::new(n, 0.0));
    }),
    ("apply_torque", |w, id, n| w.body_mut(id).unwrap().apply_torque(n)),
    ("apply_impulse", |w, id, n| w.body_mut(id).unwrap().apply_impulse(Vec2::new(n, n), Vec2::X)),
    ("apply_impulse_to_center", |w, id, n| {
        w.body_mut(id).unwrap().apply_impulse_to_center(Vec2::new(0.0, n));
    }),
    ("apply_angular_impulse", |w, id, n| w.body_mut(id).unwrap().apply_angular_impulse(n)),
    ("set_gravity_scale", |w, id, n| w.body_mut(id).unwrap().set_gravity_scale(n)),
    ("set_damping", |w, id, n| w.body_mut(id).unwrap().set_damping(n, n)),
];

#[test]
fn telling_a_body_a_number_that_is_not_finite_does_nothing() {
    for (name, act) in ACTS {
        for bad in NOT_FINITE {
            let (mut world, crate_, _) = scene();
            let before = world.state_hash();
            act(&mut world, crate_, bad);
            assert_eq!(world.state_hash(), before, "{name}({bad})");
            goes_on(world, name);
        }
    }
}

#[test]
fn telling_a_body_an_enormous_number_leaves_the_world_sound() {
    for (name, act) in ACTS {
        for bad in ENORMOUS {
            let (mut world, crate_, ball) = scene();
            for id in [crate_, ball] {
                // Twice: what is added up must not get out of bounds either.
                act(&mut world, id, bad);
                act(&mut world, id, bad);
                world.validate().unwrap_or_else(|error| panic!("{name}({bad}): {error}"));
            }
            goes_on(world, &format!("{name}({bad})"));
        }
    }
}

#[test]
fn telling_a_static_body_to_move_does_nothing_but_a_teleport() {
    for (name, act) in ACTS {
        let (mut world, ..) = scene();
        let floor = world.body_ids().next().unwrap();
        act(&mut world, floor, 3.0);
        let body = world.body(floor).unwrap();
        assert_eq!((body.velocity(), body.angular_velocity()), (Vec2::ZERO, 0.0), "{name}");
        assert!(!body.is_awake(), "{name} wakes a static body");
        steps(&mut world, 10);
        world.validate().unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

#[test]
fn enormous_and_minute_bodies_leave_the_world_sound() {
    let numbers = [1.0e-30, 1.0e-10, 1.0e10, 1.0e18, 1.0e30, f32::MAX, f32::MIN_POSITIVE];
    for n in numbers {
        let bodies = [
            ("mass", RigidBody::dynamic().shape(circle(0.5)).mass(n)),
            ("density", RigidBody::dynamic().shape(ShapeDef::new(rect(0.5, 0.5)).density(n))),
            ("radius", RigidBody::dynamic().shape(circle(n))),
            ("half extent", RigidBody::dynamic().shape(upright(n, 0.5))),
            (
                "offset",
                RigidBody::dynamic().shape(ShapeDef::new(circle(0.5)).offset(Vec2::splat(n))),
            ),
            ("velocity", RigidBody::dynamic().shape(circle(0.5)).velocity(Vec2::splat(n))),
            ("turning", RigidBody::dynamic().shape(rect(0.5, 0.1)).angular_velocity(n)),
            ("angle", RigidBody::dynamic().shape(rect(0.5, 0.1)).angle(n)),
            ("gravity scale", RigidBody::dynamic().shape(circle(0.5)).gravity_scale(n)),
            ("damping", RigidBody::dynamic().shape(circle(0.5)).damping(n, n)),
            ("friction", RigidBody::dynamic().shape(rect(0.5, 0.5)).friction(n)),
            ("restitution", RigidBody::dynamic().shape(rect(0.5, 0.5)).restitution(n)),
            (
                "sleep speed",
                RigidBody { sleep_speed: n, ..RigidBody::dynamic().shape(circle(0.5)) },
            ),
        ];
        for (name, body) in bodies {
            let (mut world, crate_, _) = scene();
            if let Ok(id) = world.add_body(body.position(Vec2::new(0.0, 1.5))) {
                for step in 0..20 {
                    world.step(DT);
                    let sound = world.validate();
                    sound.unwrap_or_else(|error| panic!("{name} {n:e}, step {step}: {error}"));
                }
                world.remove_body(id).unwrap();
                assert!(position(&world, crate_).is_finite());
            }
            goes_on(world, &format!("{name} {n:e}"));
        }
    }
}

#[test]
fn stale_handles_are_refused_and_never_mean_another() {
    let (mut world, crate_, ball) = scene();
    let shape: ShapeId = world.body(crate_).unwrap().shapes().next().unwrap();
    world.remove_body(crate_).unwrap();
    let reused = drop_at(&mut world, circle(0.5), 0.0, 1.0);
    assert_eq!(reused.index(), crate_.index());
    assert_ne!(reused, crate_);
    assert!(world.body(crate_).is_none() && world.body_mut(crate_).is_none());
    assert!(world.shape(shape).is_none());
    for error in [
        world.remove_body(crate_).unwrap_err(),
        world.remove_shape(shape).unwrap_err(),
        world.add_shape(crate_, circle(0.1)).unwrap_err(),
    ] {
        assert!(matches!(error, Error::StaleHandle { .. }), "{error:?}");
    }
    assert!(world.body(ball).is_some() && world.body(reused).is_some());
    goes_on(world, "stale handles");
}

#[test]
fn handles_of_a_bigger_world_are_refused_by_a_smaller_one() {
    let mut big = world_with_floor();
    let ids: Vec<_> = (0..50).map(|i| drop_at(&mut big, circle(0.1), i as f32, 1.0)).collect();
    let mut small = world();
    let last = *ids.last().unwrap();
    assert!(small.body(last).is_none());
    assert!(small.remove_body(last).is_err());
}

#[test]
fn bodies_without_shapes_move_and_can_be_removed() {
    let (mut world, ..) = scene();
    let point = world.add_body(RigidBody::dynamic().position(Vec2::new(30.0, 9.0))).unwrap();
    steps(&mut world, 30);
    assert!(position(&world, point).y < 8.9);
    let (fixed, driven) = (RigidBody::fixed(), RigidBody::kinematic());
    let ids = [point, world.add_body(fixed).unwrap(), world.add_body(driven).unwrap()];
    steps(&mut world, 30);
    for id in ids {
        world.remove_body(id).unwrap();
    }
    goes_on(world, "bodies without shapes");
}

#[test]
fn the_last_shape_of_a_body_can_be_removed_and_another_added() {
    let (mut world, crate_, _) = scene();
    let shape = world.body(crate_).unwrap().shapes().next().unwrap();
    world.remove_shape(shape).unwrap();
    world.validate().unwrap();
    steps(&mut world, 3);
    world.add_shape(crate_, rect(0.4, 0.4)).unwrap();
    goes_on(world, "shapes come and go");
}

#[test]
fn a_hundred_bodies_in_one_place_leave_the_world_sound() {
    for shape in [circle(0.5), rect(0.5, 0.5), upright(0.5, 0.5), capsule(0.5, 0.2)] {
        let mut world = world_with_floor();
        for _ in 0..100 {
            drop_at(&mut world, shape, 0.0, 3.0);
        }
        for _ in 0..60 {
            world.step(DT);
        }
        world.validate().unwrap_or_else(|error| panic!("{shape:?}: {error}"));
    }
}

#[test]
fn a_clock_takes_no_harm_from_hostile_times() {
    for dt in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(FixedStep::new(dt).dt(), 1.0 / 60.0);
    }
    let mut clock = FixedStep::new(DT).max_steps(0);
    for elapsed in [f32::NAN, f32::INFINITY, f32::MAX, -1.0, 0.0, DT] {
        assert!(clock.advance(elapsed) <= 1);
        assert!((0.0..=1.0).contains(&clock.alpha()));
    }
}

/// One wild step, long or short, is forgotten: what comes after it rests as always.
#[test]
fn one_wild_step_is_forgotten() {
    for dt in [1.0e6, f32::MIN_POSITIVE] {
        let mut world = World::new((0.0, -10.0));
        assert_eq!(world.try_step(dt).is_ok(), dt > 1.0);
        world.add_body(RigidBody::fixed().position((0.0, -1.0)).shape(rect(50.0, 1.0))).unwrap();
        let crates = [0.5, 1.5, 2.5].map(|y| drop_at(&mut world, rect(0.5, 0.5), 0.0, y));
        steps(&mut world, 600);
        assert!(world.bodies().all(|body| !body.is_awake()));
        world.body_mut(crates[0]).unwrap().wake();
        steps(&mut world, 60);
        let top = position(&world, crates[2]);
        assert!((top.y - 2.5).abs() < 0.02 && top.x.abs() < 0.01, "{dt}: {top:?}");
    }
}

/// Nothing at all asked of a joint's softness is none, and no number that is none.
#[test]
fn the_softest_joint_freezes_nothing() {
    let mut world = World::new(Vec2::ZERO);
    let [a, b] = [0.0, 3.0].map(|x| drop_at(&mut world, circle(0.5), x, 0.0));
    world.add_joint(a, b, JointDef::weld().softness(1.0e-44, 0.0)).unwrap();
    world.step(DT);
    assert_eq!(world.stats().frozen_bodies, 0);
}

/// A ratio beyond what floats can be squared at is refused.
#[test]
fn enormous_ratios_are_refused() {
    let pulley = JointDef::pulley(DVec2::ZERO, DVec2::new(1.0, 0.0), 5.0);
    for ratio in [f32::MAX, 1.1e9, 0.9e-9, 1.0e-44] {
        for def in [JointDef::gear(ratio), JointDef::gear(-ratio), pulley.ratio(ratio)] {
            assert!(matches!(def.validate(), Err(Error::OutOfRange { name: "ratio", .. })));
        }
    }
    for ratio in [1.0e9, 1.0e-9] {
        assert_eq!(JointDef::gear(-ratio).validate(), Ok(()));
        assert_eq!(pulley.ratio(ratio).validate(), Ok(()));
    }
}
