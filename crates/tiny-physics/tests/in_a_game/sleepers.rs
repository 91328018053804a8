//! What is called in every frame neither wakes what it does not change nor lets sleep what it acts on.

use super::{DT, circle, ground, square, steps};
use tiny_physics::{Locks, Polygon, prelude::*};

/// A crate that lies on the ground, and how often it fell asleep in ten seconds of a call in each step.
fn naps(call: impl Fn(&mut BodyMut<'_>)) -> usize {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let body = RigidBody::dynamic().position((0.0, 0.5)).shape(square(0.5));
    let body = world.add_body(body).unwrap();
    let mut naps = 0;
    for _ in 0..600 {
        call(&mut world.body_mut(body).unwrap());
        world.step(DT);
        naps += world.events().fell_asleep().len();
    }
    naps
}

#[test]
fn what_a_call_leaves_as_it_is_sleeps_on() {
    assert_eq!(naps(|body| body.apply_force_to_center((0.0, 0.0))), 1);
    assert_eq!(naps(|body| body.apply_torque(0.0)), 1);
    assert_eq!(naps(|body| body.set_velocity(body.as_ref().velocity())), 1);
    assert_eq!(naps(|body| body.set_angular_velocity(body.as_ref().angular_velocity())), 1);
    assert_eq!(naps(|body| body.set_pose(body.as_ref().pose())), 1);
    assert_eq!(naps(|body| body.apply_impulse_to_center((0.0, 0.0))), 1);
    assert_eq!(naps(|body| body.apply_impulse((0.0, 0.0), (0.0, 1.0))), 1);
    assert_eq!(naps(|body| body.apply_angular_impulse(0.0)), 1);
}

/// Of an impulse that its locks take up nothing is left.
#[test]
fn what_cannot_give_way_to_an_impulse_sleeps_on() {
    let locked = |body: &mut BodyMut<'_>| {
        body.set_locks(Locks { rotation: true, ..Locks::default() });
        body.apply_angular_impulse(3.0);
    };
    assert_eq!(naps(locked), 1);
}

#[test]
fn what_is_pushed_by_nothing_finite_is_refused() {
    let mut world = World::new((0.0, -10.0));
    let (_, body) = sleeper(&mut world);
    world.body_mut(body).unwrap().apply_impulse_to_center((f32::NAN, 0.0));
    assert_eq!(world.stats().refused_numbers, 1);
    assert!(!world.body(body).unwrap().is_awake());
}

#[test]
fn events_that_are_asked_for_already_wake_nobody() {
    let mut world = World::new((0.0, -10.0));
    let (ground, body) = sleeper(&mut world);
    let ground = world.body(ground).unwrap().shapes().next().unwrap();
    world.shape_mut(ground).unwrap().set_events(true, true);
    steps(&mut world, 120);
    assert!(!world.body(body).unwrap().is_awake());
    world.shape_mut(ground).unwrap().set_events(true, true);
    assert!(!world.body(body).unwrap().is_awake());
    world.shape_mut(ground).unwrap().set_events(true, false);
    assert!(world.body(body).unwrap().is_awake());
}

/// Whatever its angle, and wherever its centre of mass.
#[test]
fn a_platform_that_is_turned_to_where_it_is_wakes_nobody() {
    for degree in 0..90 {
        let mut world = World::new((0.0, -10.0));
        let angle = (degree as f32).to_radians();
        let form = [(-0.5, -0.6), (1.2, -0.5), (0.9, 0.7)].map(Vec2::from);
        let form = Shape::from(Polygon::convex(&form).unwrap());
        let platform = RigidBody::kinematic().position((3.3, 1.7)).shape(form);
        let platform = world.add_body(platform).unwrap();
        world.body_mut(platform).unwrap().set_angle(angle);
        let load = RigidBody::dynamic().position((3.3, 9.9)).shape(square(0.5)).gravity_scale(0.0);
        let load = world.add_body(load).unwrap();
        world.add_joint(platform, load, JointDef::rope(20.0)).unwrap();
        for step in 0..120 {
            let mut platform = world.body_mut(platform).unwrap();
            platform.set_angle(angle);
            platform.set_position((3.3, 1.7));
            world.step(DT);
            let sleeps = !world.body(load).unwrap().is_awake();
            assert!(step < 100 || sleeps, "{degree} degrees, step {step}");
        }
    }
}

#[test]
fn what_is_pushed_in_each_step_stays_awake() {
    assert_eq!(naps(|body| body.apply_force_to_center((0.5, 0.0))), 0);
    assert_eq!(naps(|body| body.apply_torque(0.1)), 0);
}

/// An editor or a component system writes the places of all things in each frame.
#[test]
fn a_platform_that_is_put_where_it_is_wakes_nobody() {
    for kind in [BodyKind::Static, BodyKind::Kinematic] {
        let mut world = World::new((0.0, -10.0));
        let place = DVec2::new(3.3, 1.7);
        let platform = RigidBody { kind, ..RigidBody::fixed() };
        let platform = world.add_body(platform.position(place).shape(square(1.0))).unwrap();
        let load = RigidBody::dynamic().position((3.3, 3.2)).shape(square(0.5));
        let load = world.add_body(load).unwrap();
        for step in 0..300 {
            world.body_mut(platform).unwrap().set_position(place);
            world.step(DT);
            assert!(step < 100 || !world.body(load).unwrap().is_awake(), "{kind:?}, step {step}");
        }
        world.body_mut(platform).unwrap().set_position(place + Vec2::new(0.0, 0.1));
        assert!(world.body(load).unwrap().is_awake());
    }
}

/// No time at rest is asked for, but some rest is.
#[test]
fn what_flies_does_not_sleep_however_soon_it_may() {
    let mut world = World::new((0.0, -10.0));
    world.settings.time_to_sleep = 0.0;
    ground(&mut world);
    let ball = RigidBody::dynamic().position((0.0, 5.0)).shape(circle(0.5));
    let ball = world.add_body(ball).unwrap();
    steps(&mut world, 30);
    assert!(world.body(ball).unwrap().position().y < 4.0);
    steps(&mut world, 300);
    let ball = world.body(ball).unwrap();
    assert!((ball.position().y - 0.5).abs() < 0.01 && !ball.is_awake());
}

/// A crate that sleeps on the ground.
fn sleeper(world: &mut World) -> (BodyId, BodyId) {
    let ground = ground(world);
    let body = RigidBody::dynamic().position((0.0, 0.5)).shape(square(0.5));
    let body = world.add_body(body).unwrap();
    steps(world, 120);
    assert!(!world.body(body).unwrap().is_awake(), "no sleeper to start with");
    (ground, body)
}

#[test]
fn a_joint_that_pulls_wakes_what_it_pulls() {
    let hoist = JointDef::distance(4.0).anchors_at((0.0, 4.5), (0.0, 0.5));
    let joints = [JointDef::mouse((0.0, 3.0), 1e4), hoist.limits(0.5, 5.0).motor(-1.0, 1e5)];
    for joint in joints {
        let mut world = World::new((0.0, -10.0));
        let (ground, body) = sleeper(&mut world);
        world.add_joint(ground, body, joint).unwrap();
        steps(&mut world, 120);
        let height = world.body(body).unwrap().position().y;
        assert!(height > 2.0, "{:?}: {height}", joint.kind);
    }
    let mut world = World::new((0.0, -10.0));
    let (ground, body) = sleeper(&mut world);
    world
        .add_joint(ground, body, JointDef::revolute().anchor_at((0.0, 0.5)).collide_connected())
        .unwrap();
    assert!(!world.body(body).unwrap().is_awake(), "a hinge changes nothing");
}

/// What hangs on a hook that is switched off and on is pulled up, whatever the hook is.
#[test]
fn a_hook_that_is_switched_on_again_pulls() {
    for kind in [BodyKind::Static, BodyKind::Kinematic] {
        let mut world = World::new((0.0, -10.0));
        ground(&mut world);
        let hook = RigidBody { kind, ..RigidBody::fixed() };
        let hook = world.add_body(hook.position((0.0, 4.0))).unwrap();
        let ball = RigidBody::dynamic().position((0.0, 4.0)).shape(circle(0.5));
        let ball = world.add_body(ball).unwrap();
        world.add_joint(hook, ball, JointDef::weld().anchor_at((0.0, 4.0))).unwrap();
        world.body_mut(hook).unwrap().set_enabled(false);
        steps(&mut world, 240);
        assert!(!world.body(ball).unwrap().is_awake(), "it fell asleep on the ground");
        world.body_mut(hook).unwrap().set_enabled(true);
        steps(&mut world, 300);
        let height = world.body(ball).unwrap().position().y;
        assert!((height - 4.0).abs() < 0.05, "{kind:?}: {height}");
    }
}

/// A ball that the player rolls to and fro does not rock, be it pushed or the world tilted.
#[test]
fn what_is_steered_to_and_fro_is_not_slowed() {
    for tilts in [false, true] {
        let mut world = World::new((0.0, -10.0));
        ground(&mut world);
        let ball = RigidBody::dynamic().position((0.0, 0.3)).shape(circle(0.3)).mass(1.0);
        let ball = world.add_body(ball).unwrap();
        let steer = |world: &mut World, push: f32| {
            if tilts {
                world.gravity = Vec2::new(push, -10.0);
            } else {
                world.body_mut(ball).unwrap().apply_force_to_center((push, 0.0));
            }
            world.step(DT);
            world.body(ball).unwrap().velocity().x
        };
        for swing in 0..10 {
            let push = if swing % 2 == 0 { 0.8 } else { -0.8 };
            (0..if swing == 0 { 20 } else { 40 }).for_each(|_| _ = steer(&mut world, push));
        }
        let before = world.body(ball).unwrap().velocity().x;
        let after = (0..30).fold(before, |_, _| steer(&mut world, 0.3));
        // A disk of m and m r^2 / 2 that rolls takes two thirds of the push.
        let gained = (after - before) / (0.3 * 0.5 * 2.0 / 3.0);
        assert!((gained - 1.0).abs() < 0.05, "tilts {tilts}: {gained}");
    }
}

/// A crate that sleeps at a place, and a ball that a wall at 0 stops.
fn behind_a_wall(crate_at: f64, shot: RigidBody) -> (World, BodyId, BodyId) {
    let mut world = World::new((0.0, 0.0));
    world.add_body(RigidBody::fixed().shape(Shape::rect(0.1, 5.0).unwrap())).unwrap();
    let sleeper = RigidBody::dynamic().position((crate_at, 0.0)).shape(square(0.3)).asleep();
    let sleeper = world.add_body(sleeper).unwrap();
    let shot = world.add_body(shot.shape(circle(0.1))).unwrap();
    (world, sleeper, shot)
}

/// What lies on the straight way of a shot, behind the wall that stops it, sleeps on.
#[test]
fn a_shot_that_a_wall_stops_wakes_nobody_behind_it() {
    for phase in 0..20 {
        let start = -0.3 - 0.1 * f64::from(phase);
        for at in [0.5, 1.0, 1.7] {
            let shot = RigidBody::dynamic().position((start, 0.0)).velocity((120.0, 0.0));
            let (mut world, sleeper, shot) = behind_a_wall(at, shot);
            steps(&mut world, 5);
            assert!(world.body(shot).unwrap().position().x < 0.0);
            assert!(!world.body(sleeper).unwrap().is_awake(), "{start} {at}");
        }
    }
}

/// What is taken away wakes what leaned on it, not what lies within what is kept of its way, nor what is only near.
#[test]
fn what_is_removed_wakes_nobody_that_it_did_not_touch() {
    for at in [0.45, 1.0, 3.0] {
        let shot = RigidBody::dynamic().position((-8.5, 0.0)).velocity((120.0, 0.0));
        let (mut world, sleeper, shot) = behind_a_wall(at, shot);
        steps(&mut world, 120);
        assert!(!world.body(shot).unwrap().is_awake() && !world.body(sleeper).unwrap().is_awake());
        world.remove_body(shot).unwrap();
        steps(&mut world, 1);
        assert!(!world.body(sleeper).unwrap().is_awake(), "{at}");
    }
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let mut add = |x: f64, y: f64| {
        world.add_body(RigidBody::dynamic().position((x, y)).shape(square(0.3))).unwrap()
    };
    let [pebble, near, on_top] = [add(0.0, 0.3), add(0.75, 0.3), add(0.0, 0.9)];
    steps(&mut world, 120);
    assert!([pebble, near, on_top].iter().all(|&id| !world.body(id).unwrap().is_awake()));
    world.body_mut(pebble).unwrap().set_enabled(false);
    steps(&mut world, 1);
    assert!(!world.body(near).unwrap().is_awake() && world.body(on_top).unwrap().is_awake());
}

/// A ball on a joint to a hook at the origin, let go at rest.
fn hung(joint: JointDef, position: Vec2, damping: f32) -> (World, BodyId) {
    let mut world = World::new((0.0, -10.0));
    let hook = world.add_body(RigidBody::fixed()).unwrap();
    let ball = RigidBody { linear_damping: damping, ..RigidBody::dynamic() };
    let ball = world.add_body(ball.position(position).shape(circle(0.3)).mass(1.0)).unwrap();
    world.add_joint(hook, ball, joint).unwrap();
    (world, ball)
}

/// A long pendulum is slow for half a second at its turning points, and so is a soft spring.
#[test]
fn what_swings_slowly_does_not_freeze_where_it_turns() {
    for (length, angle) in [(5.0, 0.012), (20.0, 0.02), (50.0, 0.006), (60.0, 0.02)] {
        let at = Vec2::new(length * angle, -length);
        let hinge = JointDef::revolute().anchors((0.0, 0.0), -at);
        for joint in [JointDef::rope(length), JointDef::distance(length), hinge] {
            let (mut world, ball) = hung(joint, at, 0.0);
            steps(&mut world, 1800);
            assert!(world.body(ball).unwrap().is_awake(), "{length} m: {:?}", joint.kind);
            let (mut world, ball) = hung(joint, at, 0.3);
            (0..7200).for_each(|_| {
                if world.body(ball).unwrap().is_awake() {
                    world.step(DT)
                }
            });
            let ball = world.body(ball).unwrap();
            assert!(!ball.is_awake(), "{length} m, damped: {:?}", joint.kind);
            // With a speed of 0.05 m/s at the bottom, or an acceleration of a quarter of that a second.
            let aside = (0.05 * (length / 10.0).sqrt()).max(0.00125 * length);
            assert!(ball.position().x.abs() < 1.05 * aside, "{length} m: {}", ball.position().x);
        }
    }
    for (hertz, off) in [(0.2_f32, 0.1), (0.3, 0.05), (0.5, 0.03)] {
        let sag = 10.0 / (std::f32::consts::TAU * hertz).powi(2);
        let spring = JointDef::prismatic((0.0, 1.0)).spring(hertz, 0.0);
        let (mut world, ball) = hung(spring, Vec2::new(0.0, off - sag), 0.0);
        steps(&mut world, 1800);
        assert!(world.body(ball).unwrap().is_awake(), "{hertz} Hz");
    }
}

/// With short substeps, what lies on a seesaw at its stop trembled by micrometres a second, in the last of a step always the same way,
/// and counted as gaining speed for ever.
#[test]
fn what_trembles_on_a_seesaw_at_its_stop_sleeps() {
    let mut awake = 0;
    for case in 0..24_u8 {
        let mut world = World::new((0.0, -9.8));
        world.settings.substeps = 8;
        let at = |x: f32, y: f32| Vec2::new(3.0 * x, 3.0 * y);
        let floor = Polygon::rect(120.0, 3.0).unwrap();
        let floor = RigidBody::fixed().shape(floor).position((0.0, -3.0));
        let floor = world.add_body(floor).unwrap();
        let plank = Polygon::rect(9.0, 0.3).unwrap();
        let plank = RigidBody::dynamic().shape(plank).position(at(0.0, 0.8));
        let plank = world.add_body(plank).unwrap();
        let hinge = JointDef::revolute().anchors((0.0, 5.4), (0.0, 0.0)).limits(-0.25, 0.25);
        world.add_joint(floor, plank, hinge).unwrap();
        let along = f32::from(case) / 24.0;
        let other = if case % 2 == 0 { 0.4 } else { 0.25 };
        for (x, half, density) in [(-2.3 + 0.2 * along, 0.4, 1.0), (0.3 + 0.6 * along, other, 2.0)]
        {
            let shape = ShapeDef::new(square(3.0 * half)).density(density);
            let body = RigidBody::dynamic().shape(shape);
            world.add_body(body.position(at(x, 1.2 + half))).unwrap();
        }
        (0..1200).for_each(|_| world.step(1.0 / 120.0));
        awake += usize::from(world.awake_body_count() > 0);
    }
    assert_eq!(awake, 0);
}

/// A seesaw and a pulley that a few percent set going.
#[test]
fn what_is_a_little_out_of_balance_tips() {
    for more in [1.01, 1.03] {
        let mut world = World::new((0.0, -10.0));
        let hook = world.add_body(RigidBody::fixed()).unwrap();
        let mut add = |x: f32, shape: Shape, mass: f32| {
            world
                .add_body(RigidBody::dynamic().position(Vec2::new(x, 0.0)).shape(shape).mass(mass))
                .unwrap()
        };
        let board = add(0.0, Shape::rect(2.0, 0.05).unwrap(), 1.0);
        let (left, right) = (add(-2.0, circle(0.1), 10.0), add(2.0, circle(0.1), 10.0 * more));
        let (up, down) = (add(7.0, circle(0.1), 10.0), add(9.0, circle(0.1), 10.0 * more));
        let pins = [(hook, board, 0.0), (board, left, -2.0), (board, right, 2.0)];
        for (a, b, x) in pins {
            let pin = if x == 0.0 { JointDef::revolute() } else { JointDef::weld() };
            world.add_joint(a, b, pin.anchor_at((x, 0.0))).unwrap();
        }
        let pulley = JointDef::pulley((7.0, 5.0), (9.0, 5.0), 10.0);
        world.add_joint(up, down, pulley).unwrap();
        steps(&mut world, 240);
        let fallen = [board, down].map(|body| world.body(body).unwrap());
        assert!(fallen[0].angle() < -0.05, "seesaw, {more}: {}", fallen[0].angle());
        assert!(fallen[1].position().y < -0.2, "pulley, {more}: {}", fallen[1].position().y);
    }
}
