//! What changes from outside wakes those whom it concerns, and no others.

use super::*;
use crate::describe::{JointDef, JointKind, Material, Spring, Tile, TileForm, TileGrid};

/// A crate that sleeps on the ground at x.
fn sleeper(world: &mut World, x: f32) -> BodyId {
    let body = add(world, x, 0.5, rect(0.5, 0.5));
    run(world, 120);
    assert!(!is_awake(world, body), "no sleeper to start with");
    body
}

fn is_awake(world: &World, body: BodyId) -> bool {
    world.body(body).unwrap().is_awake()
}

fn fixed(x: f32, y: f32, shape: ShapeDef) -> RigidBody {
    RigidBody::fixed().position(Vec2::new(x, y)).shape(shape)
}

#[test]
fn another_gravity_wakes_all() {
    let mut world = world();
    add_ground(&mut world);
    let body = sleeper(&mut world, 0.0);
    world.gravity = Vec2::new(0.0, 10.0);
    run(&mut world, 30);
    assert!(y(&world, body) > 1.0, "it fell upwards");
    // A copy knows which gravity it slept under.
    world.gravity = Vec2::new(0.0, -10.0);
    run(&mut world, 300);
    assert!(!is_awake(&world, body));
    let mut copy = World::from_bytes(&world.to_bytes()).unwrap();
    copy.gravity = Vec2::new(1.0, -10.0);
    let other = copy.state_hash();
    copy.step(DT);
    assert!(is_awake(&copy, body));
    world.gravity = Vec2::new(1.0, -10.0);
    assert_eq!(world.state_hash(), other);
}

/// Once it is switched off, and not again.
#[test]
fn a_world_without_sleep_wakes_all() {
    let mut world = world();
    add_ground(&mut world);
    let body = sleeper(&mut world, 0.0);
    world.settings.sleep = false;
    let mut copy = World::from_bytes(&world.to_bytes()).unwrap();
    for world in [&mut world, &mut copy] {
        world.step(DT);
        assert!(is_awake(world, body));
        world.body_mut(body).unwrap().sleep();
        world.step(DT);
        assert!(!is_awake(world, body), "put to sleep by hand");
    }
    assert_eq!(world.state_hash(), copy.state_hash());
}

#[test]
fn bodies_that_start_asleep_stay_so() {
    let mut world = world();
    let body = RigidBody::dynamic().position(Vec2::new(0.0, 5.0)).shape(rect(0.5, 0.5)).asleep();
    let body = world.add_body(body).unwrap();
    run(&mut world, 10);
    assert!(!is_awake(&world, body) && y(&world, body) == 5.0);
}

#[test]
fn a_new_hook_wakes_all() {
    let mut world = world();
    add_ground(&mut world);
    let body = sleeper(&mut world, 0.0);
    world.set_pre_solve(|_, _, rules| rules.enabled = false);
    run(&mut world, 60);
    assert!(y(&world, body) < 0.0, "nothing holds it any more");
    world.clear_pre_solve();
    let other = sleeper(&mut world, 5.0);
    world.clear_pair_filter();
    assert!(is_awake(&world, other));
}

#[test]
fn what_is_moved_wakes_what_stands_on_it_and_hangs_from_it() {
    let mut world = world();
    add_ground(&mut world);
    let shelf = world.add_body(fixed(10.0, 2.0, rect(1.0, 0.1))).unwrap();
    let book = add(&mut world, 10.0, 2.6, rect(0.5, 0.5));
    let hook = world.add_body(fixed(0.0, 6.0, rect(0.1, 0.1))).unwrap();
    let lamp = add(&mut world, 0.0, 4.0, circle(0.2));
    let rope = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(0.0, 2.0));
    world.add_joint(hook, lamp, rope).unwrap();
    let far = sleeper(&mut world, -10.0);
    assert!(!is_awake(&world, book) && !is_awake(&world, lamp));
    world.body_mut(shelf).unwrap().set_position(Vec2::new(20.0, 2.0));
    world.body_mut(hook).unwrap().set_position(Vec2::new(0.0, 7.0));
    run(&mut world, 60);
    assert!(y(&world, book) < 1.5, "the book has fallen: {}", y(&world, book));
    assert!(y(&world, lamp) > 4.5, "the lamp has followed: {}", y(&world, lamp));
    assert!(!is_awake(&world, far));
}

/// Boxes, tiles, shapes and moved bodies put into sleepers, in random places, wake them, and they come out.
#[test]
fn ground_put_into_a_sleeper_wakes_it() {
    for (case, offset) in (0..12).map(|case| (case, 0.11 * (case % 5) as f32 - 0.22)) {
        let mut world = world();
        add_ground(&mut world);
        let elsewhere = world.add_body(fixed(20.0, 5.0, rect(0.3, 0.3))).unwrap();
        let body = sleeper(&mut world, 0.0);
        let beside = sleeper(&mut world, 3.0);
        let place = Vec2::new(offset, 0.2);
        match case % 4 {
            0 => _ = world.add_body(fixed(place.x, place.y, rect(0.3, 0.3))).unwrap(),
            1 => world.body_mut(elsewhere).unwrap().set_position(place),
            2 => {
                let local = place - Vec2::new(20.0, 5.0);
                _ = world.add_shape(elsewhere, rect(0.3, 0.3).offset(local)).unwrap();
            }
            _ => {
                let mut grid = TileGrid::new(0.5, 2, 1, vec![Tile::new(TileForm::Full)]);
                grid.set(0, 0, 1).unwrap();
                grid.set(1, 0, 1).unwrap();
                _ = world.add_tiles(grid.position(place - Vec2::new(0.5, 0.2))).unwrap();
            }
        }
        world.step(DT);
        assert!(is_awake(&world, body), "case {case}: slept on");
        assert!(!is_awake(&world, beside), "case {case}: woke one that it does not concern");
        run(&mut world, 300);
        assert!(world.max_penetration() < 0.02, "case {case}: {}", world.max_penetration());
    }
}

/// What is put beside a sleeper, or under it, does not wake it.
#[test]
fn ground_beside_a_sleeper_lets_it_sleep() {
    let mut world = world();
    add_ground(&mut world);
    let body = sleeper(&mut world, 0.0);
    world.add_body(fixed(1.01, 0.5, rect(0.5, 0.5))).unwrap();
    world.add_body(fixed(0.0, -1.5, rect(3.0, 1.4))).unwrap();
    run(&mut world, 3);
    assert!(!is_awake(&world, body));
}

/// Belts of any speed carry what lies on them, sleep when they stand, and wake it when they run again; what they only
/// rub at, as a wall holds it, sleeps.
#[test]
fn no_belt_is_too_slow_to_carry() {
    for (case, speed) in [0.001, -0.01, 0.03, -0.049, 0.5].into_iter().enumerate() {
        let mut world = world();
        let body = if case % 2 == 0 { RigidBody::fixed() } else { RigidBody::kinematic() };
        let body = body.position(Vec2::new(0.0, -1.0)).shape(rect(50.0, 1.0).tangent_speed(speed));
        let belt = world.add_body(body).unwrap();
        let load = add(&mut world, 0.0, 0.5, rect(0.5, 0.5));
        add(&mut world, 0.0, 1.3, rect(0.4, 0.3));
        let went = |world: &mut World, steps| {
            let x = |world: &World| world.body(load).unwrap().position().x;
            let before = x(world);
            run(world, steps);
            (x(world) - before) / (steps as f32 * DT)
        };
        run(&mut world, 60);
        let ran = went(&mut world, 180);
        assert!((ran / speed - 1.0).abs() < 0.05, "{ran} on a belt of {speed}");
        let shape = shape_of(&world, belt);
        let material = world.shape(shape).unwrap().material();
        let still = Material { tangent_speed: 0.0, ..material };
        world.shape_mut(shape).unwrap().set_material(still).unwrap();
        run(&mut world, 120);
        assert!(!is_awake(&world, load), "awake on a belt that stands");
        world.shape_mut(shape).unwrap().set_material(material).unwrap();
        let ran = went(&mut world, 120);
        assert!((ran / speed - 1.0).abs() < 0.1, "{ran} on a belt of {speed} again");
        let end = world.body(load).unwrap().position().x + 0.52_f32.copysign(speed);
        world.add_body(fixed(end + 1.0_f32.copysign(speed), 1.0, rect(1.0, 3.0))).unwrap();
        run(&mut world, 2400);
        assert!(!is_awake(&world, load), "awake before a wall, on a belt of {speed}");
    }
}

/// What accelerates as slowly as it likes, by gravity, its own scale of it, forces or torques, is not put to sleep.
#[test]
fn slow_to_start_is_not_at_rest() {
    for acceleration in [0.006, 0.01, 0.04, 0.09] {
        for case in 0..5 {
            let mut world = World::new(Vec2::new(0.0, if case == 0 { -acceleration } else { 0.0 }));
            let shape = rect(0.5, 0.3).friction(0.0);
            let mut body = RigidBody::dynamic().shape(shape.clone());
            if case == 1 {
                world.gravity = Vec2::new(0.0, -10.0);
                body = body.gravity_scale(acceleration / -10.0);
            }
            if case == 2 {
                // On a slope without friction.
                world.gravity = Vec2::new(-acceleration, -acceleration);
                let slope = RigidBody::fixed().position(Vec2::new(0.0, -1.3));
                world.add_body(slope.shape(rect(50.0, 1.0).friction(0.0))).unwrap();
            }
            let body = world.add_body(body).unwrap();
            for _ in 0..600 {
                let mut body = world.body_mut(body).unwrap();
                let (mass, inertia) = (body.as_ref().mass(), body.as_ref().inertia());
                match case {
                    3 => body.apply_force_to_center(Vec2::new(acceleration * mass, 0.0)),
                    4 => body.apply_torque(acceleration * inertia),
                    _ => {}
                }
                world.step(DT);
            }
            let body = world.body(body).unwrap();
            let got = body.velocity().length() + body.angular_velocity().abs();
            let ratio = got / (10.0 * acceleration);
            assert!((ratio - 1.0).abs() < 0.02, "case {case}, {acceleration}: {ratio}");
        }
    }
}

/// Steps that change their length leave stacks where they are, awake or woken, and joints that bear their load whole.
#[test]
fn steps_of_another_length_shake_nothing() {
    for (before, after, woken) in [(60.0, 240.0, false), (240.0, 60.0, false), (60.0, 240.0, true)]
    {
        let mut world = world();
        add_ground(&mut world);
        let mut stack: Vec<_> =
            (0..6).map(|i| add(&mut world, 0.0, 0.4 + 0.8 * i as f32, rect(0.5, 0.4))).collect();
        let hook = world.add_body(fixed(9.0, 9.0, rect(0.1, 0.1))).unwrap();
        let mut above = hook;
        for i in 1..4 {
            let link = add(&mut world, 9.0, 9.0 - i as f32, circle(0.1));
            world.add_joint(above, link, JointDef::rope(1.0)).unwrap();
            stack.push(link);
            above = link;
        }
        for &body in &stack {
            world.body_mut(body).unwrap().set_can_sleep(woken);
        }
        (0..240).for_each(|_| world.step(1.0 / before));
        assert_eq!(world.awake_body_count() == 0, woken);
        stack.iter().for_each(|&body| world.body_mut(body).unwrap().set_can_sleep(false));
        for step in 0..120 {
            world.step(1.0 / after);
            for &body in &stack {
                let speed = world.body(body).unwrap().velocity().length();
                assert!(speed < 0.03, "{before} to {after}, step {step}: {speed}");
            }
        }
    }
}

/// A conveyor that carries something on one half, and something that rests on the other.
#[test]
fn what_lies_beside_a_belt_sleeps_with_what_it_lies_on() {
    let mut world = world();
    let belt = RigidBody::kinematic().shape(rect(20.0, 0.5).tangent_speed(0.2));
    let belt = world.add_body(belt.shape(rect(20.0, 0.5).offset((41.0, 0.0)))).unwrap();
    let carried = add(&mut world, -10.0, 1.0, rect(0.5, 0.5));
    add(&mut world, 40.0, 1.0, rect(0.5, 0.5));
    let lamp = add(&mut world, 30.0, -3.0, circle(0.3));
    world.add_joint(belt, lamp, JointDef::distance(3.0)).unwrap();
    for _ in 0..300 {
        world.step(DT);
        world.validate().unwrap();
    }
    assert!((world.body(carried).unwrap().velocity().x.abs() - 0.2).abs() < 0.01);
}

/// What is put down asleep lies on something all the same.
#[test]
fn what_was_added_asleep_falls_when_its_support_goes() {
    let takes: [fn(&mut World, BodyId); 4] = [
        |world, id| world.remove_body(id).unwrap(),
        |world, id| world.body_mut(id).unwrap().set_enabled(false),
        |world, id| world.body_mut(id).unwrap().set_position(Vec2::new(20.0, 0.0)),
        |world, id| {
            let shape = shape_of(world, id);
            world.remove_shape(shape).unwrap();
        },
    ];
    for (i, take) in takes.into_iter().enumerate() {
        let mut world = world();
        let shelf = world.add_body(fixed(0.0, -0.5, rect(3.0, 0.5))).unwrap();
        let crates = [0.5, 1.5].map(|y| {
            let body = RigidBody::dynamic().position(Vec2::new(0.0, y)).shape(rect(0.5, 0.5));
            world.add_body(body.asleep()).unwrap()
        });
        run(&mut world, 10);
        assert!(crates.iter().all(|&body| !is_awake(&world, body)));
        let mut other = world.clone();
        take(&mut world, shelf);
        run(&mut world, 60);
        assert!(y(&world, crates[0]) < -2.0 && y(&world, crates[1]) < -1.0, "{i}: shelf");
        take(&mut other, crates[0]);
        run(&mut other, 60);
        assert!(y(&other, crates[1]) < 1.0, "{i}: crate below");
    }
}

/// However slowly a motor moves something, that does not rest; where it can go no further, it may.
#[test]
fn no_motor_is_too_slow_to_go_on() {
    let drive = JointKind::Motor {
        velocity: Vec2::new(0.0, 0.03),
        angular_velocity: 0.0,
        max_force: 1.0e4,
        max_torque: 1.0e4,
        linear_spring: None,
        max_spring_force: 0.0,
        angular_spring: None,
        max_spring_torque: 0.0,
    };
    let motors = [
        (JointDef::prismatic(Vec2::Y).motor(0.03, 1.0e4), 0.3, 0.0),
        (JointDef::new(drive), 0.3, 0.0),
        (JointDef::revolute().motor(0.02, 1.0e4), 0.0, 0.2),
        (JointDef::prismatic(Vec2::Y).motor(0.001, 1.0e4), 0.01, 0.0),
    ];
    for (i, (motor, way, turn)) in motors.into_iter().enumerate() {
        let mut world = world();
        let base = world.add_body(RigidBody::fixed()).unwrap();
        let lift = add(&mut world, 0.0, 0.0, rect(0.5, 0.05));
        world.add_joint(base, lift, motor).unwrap();
        run(&mut world, 600);
        let body = world.body(lift).unwrap();
        assert!(
            (body.position().y - way).abs() < 0.05 * way + 1.0e-4,
            "{i}: {:?}",
            body.position()
        );
        assert!((body.angle() - turn).abs() < 0.05 * turn + 1.0e-4, "{i}: {}", body.angle());
    }
    // And however slowly it gets going.
    let mut weak = JointDef::drive();
    if let JointKind::Motor { velocity, max_force, .. } = &mut weak.kind {
        (*velocity, *max_force) = (Vec2::Y, 10_050.0);
    }
    for motor in [JointDef::prismatic(Vec2::Y).motor(1.0, 10_050.0), weak] {
        let mut heavy = self::world();
        let base = heavy.add_body(RigidBody::fixed()).unwrap();
        let load = RigidBody::dynamic().shape(rect(0.5, 0.5)).mass(1000.0);
        let load = heavy.add_body(load).unwrap();
        heavy.add_joint(base, load, motor).unwrap();
        run(&mut heavy, 600);
        let speed = heavy.body(load).unwrap().velocity().y;
        assert!((speed - 0.5).abs() < 0.02, "{:?}: {speed} m/s", motor.kind);
    }

    let mut world = world();
    let base = world.add_body(RigidBody::fixed()).unwrap();
    let lift = add(&mut world, 0.0, 0.0, rect(0.5, 0.05));
    let motor = JointDef::prismatic(Vec2::Y).motor(0.03, 100.0).limits(0.0, 0.1);
    world.add_joint(base, lift, motor).unwrap();
    run(&mut world, 600);
    assert!(!is_awake(&world, lift) && (y(&world, lift) - 0.1).abs() < 0.01);
}

#[test]
fn a_platform_that_is_led_comes_to_rest_at_any_angle() {
    for i in 0..400 {
        let angle = core::f32::consts::PI * (2.0 * (i as f32 * 0.618_034).fract() - 1.0);
        let start = if i % 2 == 0 { angle } else { 0.37 * i as f32 };
        let mut world = World::new(Vec2::ZERO);
        let lift = RigidBody::kinematic().angle(start).shape(rect(3.0, 0.2));
        let lift = world.add_body(lift).unwrap();
        for _ in 0..60 {
            let target = Transform::from_angle(Vec2::new(1.0, 2.0), angle);
            world.body_mut(lift).unwrap().set_target(target, DT);
            world.step(DT);
        }
        assert!(
            !is_awake(&world, lift),
            "{angle}: {}",
            world.body(lift).unwrap().angular_velocity()
        );
    }
}

/// What moves near sleepers wakes what it meets, and what it carried as it set off.
#[test]
fn a_platform_that_goes_by_wakes_nobody() {
    let mut world = world();
    add_ground(&mut world);
    let beside = sleeper(&mut world, 0.0);
    let lift = RigidBody::kinematic().position(Vec2::new(1.05, -0.5)).shape(rect(0.5, 0.5));
    let lift = world.add_body(lift.velocity(Vec2::new(0.0, 0.5))).unwrap();
    let woken = (0..240).filter(|_| {
        let mut lift = world.body_mut(lift).unwrap();
        lift.set_velocity(Vec2::new(0.0, 0.5));
        lift.set_angular_velocity(0.0);
        world.step(DT);
        is_awake(&world, beside)
    });
    assert!(woken.count() < 60);
    // Told again that it stands still it sleeps on with what lies on it.
    let mut world = self::world();
    let lift = RigidBody::kinematic().position(Vec2::new(0.0, -0.5)).shape(rect(3.0, 0.5));
    let lift = world.add_body(lift).unwrap();
    let rider = add(&mut world, 0.0, 0.5, rect(0.5, 0.5));
    let mut awake = 0;
    for _ in 0..600 {
        let mut body = world.body_mut(lift).unwrap();
        body.set_velocity(Vec2::ZERO);
        body.set_angular_velocity(0.0);
        world.step(DT);
        awake += u32::from(is_awake(&world, rider));
    }
    assert!(awake < 120, "{awake}");
}

#[test]
fn joints_that_do_nothing_put_nobody_to_sleep() {
    for joint in [JointDef { enabled: false, ..JointDef::rope(3.0) }, JointDef::filter()] {
        let mut world = world();
        add_ground(&mut world);
        let crate_ = add(&mut world, 0.0, 0.5, rect(0.5, 0.5));
        let player = add(&mut world, 0.0, 9.0, circle(0.5));
        world.add_joint(player, crate_, joint).unwrap();
        run(&mut world, 10);
        world.body_mut(crate_).unwrap().sleep();
        assert!(!is_awake(&world, crate_) && is_awake(&world, player));
    }
}

#[test]
fn joints_that_do_nothing_wake_nobody() {
    for joint in [JointDef { enabled: false, ..JointDef::rope(30.0) }, JointDef::filter()] {
        let mut world = world();
        add_ground(&mut world);
        let body = sleeper(&mut world, 0.0);
        let sign = world.add_body(fixed(20.0, 5.0, circle(0.5))).unwrap();
        world.add_joint(sign, body, joint).unwrap();
        world.body_mut(sign).unwrap().set_position(Vec2::new(21.0, 5.0));
        assert!(!is_awake(&world, body), "moved: {joint:?}");
        world.body_mut(sign).unwrap().set_kind(BodyKind::Kinematic);
        assert!(!is_awake(&world, body), "of another kind: {joint:?}");
        world.body_mut(sign).unwrap().set_enabled(false);
        world.body_mut(sign).unwrap().set_enabled(true);
        assert!(!is_awake(&world, body), "taken out: {joint:?}");
        run(&mut world, 5);
        assert!(!is_awake(&world, body));
    }
}

/// It moves or it stands, but is no belt.
#[test]
fn a_platform_added_asleep_with_a_velocity_moves() {
    let mut world = world();
    let lift = RigidBody::kinematic().shape(rect(3.0, 0.5)).velocity(Vec2::new(2.0, 0.0)).asleep();
    let lift = world.add_body(lift).unwrap();
    run(&mut world, 60);
    assert!((world.body(lift).unwrap().position().x - 2.0).abs() < 0.01);
}

/// A flywheel without shapes, free, on a hinge, or led, turns on; one that a brake stops sleeps. All of them fell asleep at full
/// speed within a second: the turning of what has no shapes counted for nothing.
#[test]
fn what_has_no_shapes_turns_on() {
    for case in 0..24 {
        let mut world = World::new(Vec2::ZERO);
        let (spin, inertia) = (0.3 * 1.2_f32.powi(case), 0.02 * 1.3_f32.powi(case));
        let wheel = match case % 4 {
            0 => RigidBody::kinematic(),
            _ => RigidBody::dynamic().mass(2.0).inertia(inertia),
        };
        let wheel = world.add_body(wheel.angular_velocity(spin)).unwrap();
        let base = world.add_body(RigidBody::fixed()).unwrap();
        if case % 4 > 1 {
            world.add_joint(base, wheel, JointDef::revolute()).unwrap();
        }
        run(&mut world, 120);
        let left = world.body(wheel).unwrap().angular_velocity();
        let seen = 0.05 / (inertia / 2.0).sqrt();
        assert!(
            (left - spin).abs() < 1.0e-3 * spin || spin < seen,
            "case {case}: {left} of {spin}"
        );
        if case % 4 > 1 {
            world.add_joint(base, wheel, JointDef::friction(0.0, 20.0 * spin * inertia)).unwrap();
            run(&mut world, 120);
            assert!(!is_awake(&world, wheel), "case {case}: awake");
        }
    }
}

/// Springs of every kind, however slow, sleep no sooner than at their rest; those that push against something do sleep. A door of 0.3 hertz and
/// damping ratio 4, let go at 1 radian, fell asleep at 0.18 for good, and what springs of 0.1 hertz set going within a second.
#[test]
fn no_spring_is_too_slow_to_go_on() {
    for case in 0..70 {
        let kind = case % 7;
        let part = |k: f32| (k * (case + 1) as f32).fract();
        let (hertz, zeta) = (0.08 + 0.5 * part(0.618_034), 5.0 * part(0.414_214));
        let spring = Some(Spring { hertz, damping_ratio: zeta });
        let drive = JointKind::Motor {
            velocity: Vec2::ZERO,
            angular_velocity: 0.0,
            max_force: 0.0,
            max_torque: 0.0,
            linear_spring: spring,
            max_spring_force: 1.0e3,
            angular_spring: spring,
            max_spring_torque: 1.0e3,
        };
        let mouse = JointKind::Mouse {
            target: DVec2::ZERO,
            spring: Spring { hertz, damping_ratio: zeta },
            max_force: 1.0e3,
        };
        let (joint, place, angle) = match kind {
            0 => (JointDef::revolute().anchors(Vec2::ZERO, -Vec2::X), Vec2::ZERO, 1.0),
            1 => (JointDef::prismatic(Vec2::Y), Vec2::new(0.0, 0.6), 0.0),
            2 => (JointDef::distance(1.0).anchors(-Vec2::Y, Vec2::ZERO), Vec2::new(0.0, 0.6), 0.0),
            3 => (JointDef::weld(), Vec2::new(0.3, 0.6), 0.5),
            4 => (JointDef::wheel(Vec2::Y), Vec2::new(0.0, 0.6), 0.0),
            5 => (JointDef::new(drive), Vec2::new(0.3, 0.6), 0.5),
            _ => (JointDef::new(mouse), Vec2::new(0.3, 0.6), 0.0),
        };
        let mut world = World::new(Vec2::ZERO);
        let base = world.add_body(RigidBody::fixed()).unwrap();
        let body = RigidBody::dynamic().angle(angle).shape(rect(1.0, 0.05));
        let hung = if kind == 0 { Vec2::new(angle.cos(), angle.sin()) } else { place };
        let body = world.add_body(body.position(hung)).unwrap();
        world.add_joint(base, body, joint.spring(hertz, zeta)).unwrap();
        run(&mut world, 1500);
        let rest = if kind == 0 { Vec2::X } else { Vec2::ZERO };
        let body = world.body(body).unwrap();
        let off = (body.position() - rest).length() + body.angle().abs();
        let rate = core::f32::consts::TAU * hertz;
        let least = 0.02 + 0.005 / (rate * rate);
        assert!(body.is_awake() || off < least, "{case}: {hertz} Hz, {zeta}: {off} off");
        // That of a slow one is exp(-rate t / (2 zeta)).
        let done = if zeta > 0.3 { rate * 25.0 / (2.0 * zeta).max(1.0 / zeta) } else { 0.0 };
        assert!(!body.is_awake() || done < 7.0, "{case}: {hertz} Hz, {zeta}: awake, {off} off");
    }
}

/// A spring that is blocked, borne or balanced lets its bodies sleep.
#[test]
fn springs_that_are_held_sleep() {
    for case in 0..40 {
        let part = |k: f32| (k * (case + 1) as f32).fract();
        let (hertz, zeta) = (0.3 + 2.0 * part(0.618_034), 0.3 + 3.0 * part(0.414_214));
        let mut world = world();
        let ground = RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(rect(50.0, 1.0));
        let ground = world.add_body(ground).unwrap();
        let bodies = match case % 4 {
            // A door pressed on a peg, a slider that bears its body, a crate that friction holds back, a cart on two wheels.
            0 => {
                let door = add(&mut world, 0.0, 3.0, rect(1.0, 0.05));
                world.add_body(fixed(0.7, 3.3, circle(0.1))).unwrap();
                let hinge = JointDef::revolute().anchors((-1.0, 4.0), -Vec2::X).angles(1.5, 0.0);
                world.body_mut(door).unwrap().set_gravity_scale(0.0);
                world.add_joint(ground, door, hinge.spring(hertz, zeta)).unwrap();
                vec![door]
            }
            1 => {
                let lift = add(&mut world, 0.0, 30.0, rect(0.5, 0.2));
                let slider = JointDef::prismatic(Vec2::Y).anchors((0.0, 31.0), Vec2::ZERO);
                world.add_joint(ground, lift, slider.spring(hertz.max(0.8), zeta)).unwrap();
                vec![lift]
            }
            2 => {
                let crate_ = add(&mut world, 0.0, 0.5, rect(0.5, 0.5));
                let spring = JointDef::distance(1.0).anchors((1.2, 1.5), Vec2::ZERO);
                let spring = spring.spring(0.3, zeta).collide_connected();
                world.add_joint(ground, crate_, spring).unwrap();
                vec![crate_]
            }
            _ => {
                let cart = add(&mut world, 0.0, 1.0, rect(1.0, 0.2));
                let mut all = vec![cart];
                for x in [-0.8, 0.8] {
                    let wheel = add(&mut world, x, 0.3, circle(0.3));
                    let axle = JointDef::wheel(Vec2::Y).anchors((x, -0.7), Vec2::ZERO);
                    let axle = axle.spring(1.0 + hertz, zeta).limits(-0.3, 0.3);
                    world.add_joint(cart, wheel, axle.motor(0.0, 5.0)).unwrap();
                    all.push(wheel);
                }
                all
            }
        };
        run(&mut world, 1500);
        let awake = bodies.iter().filter(|&&body| is_awake(&world, body)).count();
        assert!(awake == 0, "{case}: {hertz} Hz, {zeta}: {awake} awake");
    }
}

/// Where all sleeps and nothing was changed a step does nothing, and what is changed between steps is told and felt all the same.
#[test]
fn a_world_at_rest_sees_what_is_changed() {
    let mut world = world();
    add_ground(&mut world);
    let coin = RigidBody::fixed().position(Vec2::new(0.0, 0.5)).shape(circle(0.3).sensor());
    let coin = world.add_body(coin).unwrap();
    let sensor = shape_of(&world, coin);
    let [crate_, other] = [0.0, 5.0].map(|x| add(&mut world, x, 0.5, rect(0.5, 0.5)));
    run(&mut world, 200);
    assert_eq!(world.awake_body_count(), 0);
    assert_eq!(world.sensor_overlaps(sensor).count(), 1);
    let hash = world.state_hash();
    world.step(DT);
    assert_eq!(world.sensor_overlaps(sensor).count(), 1);
    assert!(world.events().sensor_begin().is_empty() && world.moved_bodies().is_empty());
    let stats = world.stats();
    assert_eq!((stats.dt, stats.candidate_pairs, stats.moved_shapes), (DT, 0, 0));
    assert_ne!(world.state_hash(), hash, "steps are counted");
    // What goes is told of by the next step, what comes is seen in it, and what a support leaves falls.
    world.remove_body(crate_).unwrap();
    let ball = RigidBody::fixed().position(Vec2::new(0.2, 0.5)).shape(circle(0.1));
    world.add_body(ball).unwrap();
    world.step(DT);
    assert_eq!(world.events().sensor_end().len(), 1);
    world.body_mut(other).unwrap().set_position(Vec2::new(5.0, 3.0));
    run(&mut world, 30);
    assert!(y(&world, other) < 2.0 && world.body(other).unwrap().is_awake());
}
