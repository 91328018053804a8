//! Joints: where they are, how fast, what they bear, and changing them.

use super::{DT, square, steps};
use tiny_physics::prelude::*;
use tiny_physics::*;

/// A weightless world with a wall and a body beside it.
fn joined(def: JointDef, position: (f64, f64)) -> (World, JointId, BodyId) {
    let mut world = World::new((0.0, 0.0));
    let wall = world.add_body(RigidBody::fixed().position((1.0, 2.0)).angle(0.3)).unwrap();
    let body = RigidBody::dynamic().position(position).angle(-0.4).shape(square(0.5)).mass(2.0);
    let body = world.add_body(body).unwrap();
    let joint = world.add_joint(wall, body, def).unwrap();
    (world, joint, body)
}

#[test]
fn anchors_in_the_world_hold_bodies_as_they_are() {
    for def in [JointDef::weld(), JointDef::revolute(), JointDef::prismatic((0.6, 0.8))] {
        let (mut world, joint, body) = joined(def.anchor_at((4.0, 3.0)), (3.0, 3.0));
        let before = world.body(body).unwrap().pose();
        let (a, b) = world.joint(joint).unwrap().anchors();
        assert!((a - DVec2::new(4.0, 3.0)).length() < 1e-6 && (b - a).length() < 1e-6);
        assert!(world.joint(joint).unwrap().angle().abs() < 1e-6);
        assert_eq!(world.joint(joint).unwrap().def().anchors_at, None);
        steps(&mut world, 60);
        let after = world.body(body).unwrap().pose();
        assert!((after.p - before.p).length() < 1e-4, "{def:?}");
        assert!(after.q.angle_from(before.q).abs() < 1e-4, "{def:?}");
    }
    let rod = JointDef::distance(2.0).anchors_at((1.0, 3.0), (3.0, 3.0));
    let (world, joint, _) = joined(rod, (3.0, 3.5));
    assert!((world.joint(joint).unwrap().translation() - 2.0).abs() < 1e-5);
    let (mut world, joint, body) = joined(JointDef::weld(), (1.0, 2.0));
    let wall = world.joint(joint).unwrap().bodies().0;
    let far = JointDef::weld().anchor_at((1e9, 0.0));
    assert!(world.add_joint(wall, body, far).is_err(), "beyond where points of shapes can lie");
    let nan = JointDef::weld().anchor_at((f64::NAN, 0.0));
    assert!(world.set_joint(joint, nan).is_err());
}

#[test]
fn a_slider_tells_where_it_is_and_how_fast() {
    let def = JointDef::prismatic((0.6, 0.8)).anchor_at((3.0, 3.0)).motor(1.5, 1000.0);
    let (mut world, joint, body) = joined(def, (3.0, 3.0));
    steps(&mut world, 60);
    let slider = world.joint(joint).unwrap();
    assert!((slider.translation() - 1.5).abs() < 0.03, "{}", slider.translation());
    assert!((slider.speed() - 1.5).abs() < 1e-3 && slider.angular_speed().abs() < 1e-3);
    let moved = world.body(body).unwrap().position() - Vec2::new(3.0, 3.0);
    assert!((moved - Vec2::new(0.6, 0.8) * slider.translation()).length() < 1e-3);
    assert!(slider.motor_load().abs() < 0.1, "nothing is in its way");
}

/// The speed is the growth of the translation, also where the line turns with its body.
#[test]
fn speeds_are_what_places_gain() {
    let x = Vec2::X;
    let kinds = [
        JointDef::distance(1.0).limits(0.1, 9.0),
        JointDef::prismatic(x),
        JointDef::wheel(x),
        JointDef::mouse((0.0, 6.0), 1.0),
        JointDef::friction(0.1, 0.1),
    ];
    for def in kinds {
        let mut world = World::new((0.0, 0.0));
        let arm = world.add_body(RigidBody::dynamic().shape(square(1.0)).angular_velocity(0.7));
        let other = RigidBody::dynamic().position((2.0, 0.5)).shape(square(0.3));
        let other = world.add_body(other.velocity((0.8, 0.2))).unwrap();
        let joint = world.add_joint(arm.unwrap(), other, def.anchors(x, (0.0, 0.2))).unwrap();
        let dt = DT / 16.0;
        (0..500).for_each(|_| world.step(dt));
        let at = |world: &World| {
            let joint = world.joint(joint).unwrap();
            (joint.translation(), joint.speed(), joint.angle(), joint.angular_speed())
        };
        let (before, v1, angle, w1) = at(&world);
        world.step(dt);
        let (after, v2, turned, w2) = at(&world);
        let (v, w) = ((after - before) / dt, (turned - angle) / dt);
        assert!((v - 0.5 * (v1 + v2)).abs() < 0.02, "{def:?}: {v} but {v1} to {v2}");
        assert!((w - 0.5 * (w1 + w2)).abs() < 0.02, "{def:?}: {w} but {w1} to {w2}");
    }
}

/// A motor that holds a weight up bears it.
#[test]
fn motors_tell_their_load() {
    let mut world = World::new((0.0, -10.0));
    let wall = world.add_body(RigidBody::fixed()).unwrap();
    let mut hang = |def: JointDef, x: f64| {
        let body =
            RigidBody::dynamic().position((x, 0.0)).shape(square(0.2)).mass(3.0).can_sleep(false);
        let body = world.add_body(body).unwrap();
        world.add_joint(wall, body, def).unwrap()
    };
    let lift = hang(JointDef::prismatic(Vec2::Y).anchor_at((5.0, 0.0)).motor(0.0, 1e4), 5.0);
    let arm = hang(JointDef::revolute().anchor_at((-2.0, 0.0)).motor(0.0, 1e4), -1.5);
    let winch = JointDef::distance(1.0).limits(0.1, 9.0).motor(0.0, 1e4);
    let winch = hang(winch.anchors_at((9.0, 4.0), (9.0, 0.0)), 9.0);
    let torque = 3.0 * 10.0 * 0.5;
    steps(&mut world, 60);
    for (joint, expected) in [(lift, 30.0), (arm, torque), (winch, -30.0)] {
        let load = world.joint(joint).unwrap().motor_load();
        assert!((load - expected).abs() < 0.02 * expected.abs(), "{load}, not {expected}");
    }
    assert_eq!(
        world.joint_mut(lift).unwrap().motor_load(),
        world.joint(lift).unwrap().motor_load()
    );
}

#[test]
fn joints_are_changed_one_thing_at_a_time() {
    let def = JointDef::revolute().anchor_at((3.0, 3.0));
    let (mut world, joint, body) = joined(def, (3.0, 3.0));
    let change = |world: &mut World, change: &dyn Fn(&mut JointMut<'_>) -> Result<(), Error>| {
        change(&mut world.joint_mut(joint).unwrap())
    };
    let angle = |world: &World| world.joint(joint).unwrap().angle();
    assert!(change(&mut world, &|joint| joint.set_motor_speed(1.0)).is_err(), "no motor yet");
    change(&mut world, &|joint| joint.set_motor(Some(Motor { speed: 2.0, max: 50.0 }))).unwrap();
    steps(&mut world, 30);
    assert!((angle(&world) - 1.0).abs() < 0.05, "{}", angle(&world));
    change(&mut world, &|joint| joint.set_limits(Some(Limits { lower: 0.0, upper: 1.2 }))).unwrap();
    steps(&mut world, 60);
    assert!((angle(&world) - 1.2).abs() < 0.01);
    change(&mut world, &|joint| joint.set_motor_speed(-2.0)).unwrap();
    steps(&mut world, 60);
    assert!(angle(&world).abs() < 0.01);
    change(&mut world, &|joint| {
        joint.set_motor(None)?;
        joint.set_target(0.7)?;
        joint.set_spring(Some(Spring { hertz: 3.0, damping_ratio: 1.0 }))
    })
    .unwrap();
    steps(&mut world, 120);
    assert!((angle(&world) - 0.7).abs() < 0.01);

    // What is the same already wakes nothing; what is wrong changes nothing.
    world.body_mut(body).unwrap().sleep();
    change(&mut world, &|joint| joint.set_target(0.7)).unwrap();
    assert!(!world.body(body).unwrap().is_awake());
    let before = *world.joint(joint).unwrap().def();
    assert!(change(&mut world, &|joint| joint.set_target(f32::NAN)).is_err());
    assert!(change(&mut world, &|joint| joint.set_target_point((0.0, 0.0))).is_err());
    assert!(change(&mut world, &|joint| joint.set_max_force(1.0)).is_err(), "no motor any more");
    assert_eq!(*world.joint(joint).unwrap().def(), before);

    change(&mut world, &|joint| joint.set_def(JointDef::mouse((5.0, 3.0), 100.0))).unwrap();
    change(&mut world, &|joint| joint.set_target_point((6.0, 4.0))).unwrap();
    steps(&mut world, 240);
    assert!(world.joint(joint).unwrap().translation() < 0.02);
    change(&mut world, &|joint| joint.set_max_force(0.0)).unwrap();
    change(&mut world, &|joint| joint.set_target_point((9.0, 4.0))).unwrap();
    steps(&mut world, 60);
    assert!(world.joint(joint).unwrap().translation() > 2.9);
}

/// A joint that is not enabled does nothing: the bodies fall, and may collide.
#[test]
fn joints_are_switched_off_and_on() {
    let mut world = World::new((0.0, -10.0));
    let ground = world.add_body(RigidBody::fixed().shape(Shape::rect(5.0, 1.0).unwrap())).unwrap();
    let ball = RigidBody::dynamic().position((0.0, 4.0)).shape(Shape::circle(0.5).unwrap());
    let ball = world.add_body(ball).unwrap();
    let hang = world.add_joint(ground, ball, JointDef::weld().anchor_at((0.0, 4.0))).unwrap();
    let height = |world: &World| world.body(ball).unwrap().position().y;
    steps(&mut world, 60);
    assert!((height(&world) - 4.0).abs() < 0.01);
    world.joint_mut(hang).unwrap().set_enabled(false);
    assert!(!world.joint(hang).unwrap().is_enabled());
    let frame = World::from_bytes(&world.to_bytes()).unwrap();
    for mut world in [world, frame] {
        steps(&mut world, 120);
        assert!((height(&world) - 1.5).abs() < 0.01, "it lies on the ground: {}", height(&world));
        assert_eq!(world.joint(hang).unwrap().force(), Vec2::ZERO);
        world.joint_mut(hang).unwrap().set_enabled(true);
        assert_eq!(world.body(ball).unwrap().contacts().count(), 0);
        steps(&mut world, 300);
        assert!((height(&world) - 4.0).abs() < 0.05, "and is pulled up: {}", height(&world));
        world.validate().unwrap();
    }
}

/// A joint that only keeps bodies apart changes nothing of how they lie.
#[test]
fn a_filter_joint_leaves_weights_as_they_are() {
    let mut world = World::new((0.0, -10.0));
    world.settings.sleep = false;
    world.add_body(RigidBody::fixed().position((0.0, -1.0)).shape(square(1.0))).unwrap();
    let body = |x: f64| RigidBody::dynamic().position((x, 0.5)).shape(square(0.5)).mass(2.0);
    let lies = world.add_body(body(0.0)).unwrap();
    let other = world.add_body(body(20.0)).unwrap();
    world.add_joint(lies, other, JointDef::filter()).unwrap();
    steps(&mut world, 120);
    let contact = world.body(lies).unwrap().contacts().next().unwrap();
    assert!((contact.force().length() - 20.0).abs() < 0.2, "{}", contact.force());
}

/// Nothing is nearer than 0: what a rope holds passes by its anchor unbraked.
#[test]
fn a_rope_does_not_brake_what_passes_its_anchor() {
    for start in [-3.0, -3.01, -3.02, -3.03] {
        let mut world = World::new((0.0, 0.0));
        let hook = world.add_body(RigidBody::fixed()).unwrap();
        let ball = RigidBody::dynamic().position((start, 1.0e-3)).velocity((10.0, 0.0));
        let ball = world.add_body(ball.shape(square(0.1))).unwrap();
        world.add_joint(hook, ball, JointDef::rope(5.0)).unwrap();
        steps(&mut world, 30);
        let velocity = world.body(ball).unwrap().velocity();
        assert!((velocity.x - 10.0).abs() < 1.0e-3, "from {start}: {velocity}");
    }
}

/// What is locked in all ways is a wall for what hits it.
#[test]
fn what_is_locked_reflects_as_a_wall_does() {
    let mut world = World::new((0.0, 0.0));
    let locks = Locks { x: true, y: true, rotation: true };
    let bouncy = || ShapeDef::new(square(0.5)).restitution(1.0).friction(0.0);
    let block = RigidBody::dynamic().position((3.0, 0.0)).locks(locks).shape(bouncy());
    let block = world.add_body(block).unwrap();
    let ball = RigidBody::dynamic().velocity((5.0, 0.0)).shape(bouncy());
    let ball = world.add_body(ball).unwrap();
    steps(&mut world, 60);
    assert!((world.body(ball).unwrap().velocity().x + 5.0).abs() < 0.02);
    assert_eq!(world.body(block).unwrap().velocity(), Vec2::ZERO);
}

/// Sliders hold what cannot turn along their direction alone: a torque that does nothing was told, grew, and could break them.
#[test]
fn sliders_of_what_cannot_turn_have_no_torque() {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    world.settings.sleep = false;
    let post = world.add_body(RigidBody::fixed()).unwrap();
    let crate_ = Shape::rect(0.5, 0.5).unwrap();
    let body = RigidBody::dynamic().shape(crate_).lock_rotation().angle(0.2);
    let body = world.add_body(body).unwrap();
    let def = JointDef::prismatic(Vec2::X).break_at(1000.0, 1.0);
    let joint = world.add_joint(post, body, def).unwrap();
    for _ in 0..120 {
        world.step(1.0 / 60.0);
        let joint = world.joint(joint).expect("nothing breaks it");
        assert!(joint.torque().abs() < 1e-9, "{}", joint.torque());
        assert!((joint.force().y - 10.0).abs() < 0.1, "{}", joint.force());
    }
}

/// A plank that rocks on a ball comes to rest, whatever joints it has that do nothing.
#[test]
fn joints_that_do_nothing_do_not_count() {
    for idle in [JointDef::filter(), JointDef { enabled: false, ..JointDef::weld() }] {
        let rest = |joined: bool| {
            let mut world = World::new((0.0, -10.0));
            let ground = super::ground(&mut world);
            let ball = RigidBody::dynamic().position((0.0, 0.5)).shape(super::circle(0.5));
            let ball = world.add_body(ball.lock_rotation()).unwrap();
            let plank = RigidBody::dynamic().position((0.0, 1.1)).angle(0.1);
            let plank = plank.shape(Shape::rect(1.0, 0.1).unwrap());
            let plank = world.add_body(plank).unwrap();
            if joined {
                let far = world.add_body(RigidBody::fixed().position((30.0, 0.0))).unwrap();
                world.add_joint(far, plank, idle).unwrap();
                world.add_joint(far, ball, idle).unwrap();
            }
            let _ = ground;
            let mut slept = 0;
            while world.body(plank).unwrap().is_awake() && slept < 3600 {
                world.step(DT);
                slept += 1;
            }
            slept
        };
        let (alone, joined) = (rest(false), rest(true));
        assert!(alone < 3600, "does not rest at all");
        assert_eq!(alone, joined, "{:?}", idle.kind);
    }
}

/// What hangs on the end stop of a slider or a hinge sags as its joint's softness says: by g / w^2. With sleep it would stop on its way:
/// soft is where things are, not how fast.
#[test]
fn limits_are_as_soft_as_their_joint() {
    for hertz in [1.0_f32, 2.0, 4.0] {
        let mut world = World::new((0.0, -10.0));
        world.settings.sleep = false;
        let hook = world.add_body(RigidBody::fixed()).unwrap();
        let load = RigidBody::dynamic().shape(square(0.25)).mass(1.0);
        let load = world.add_body(load).unwrap();
        let slider = JointDef::prismatic((0.0, 1.0)).limits(0.0, 1.0).softness(hertz, 1.0);
        world.add_joint(hook, load, slider).unwrap();
        // An arm of 1 m on a pin that locks at level.
        let arm = RigidBody::dynamic().position((6.0, 0.0)).shape(square(0.1)).mass(1.0);
        let arm = world.add_body(arm).unwrap();
        let pin = JointDef::revolute().anchor_at((5.0, 0.0)).limits(0.0, 1.0);
        world.add_joint(hook, arm, pin.softness(hertz, 1.0)).unwrap();
        steps(&mut world, 2400);
        let expected = 10.0 / (std::f32::consts::TAU * hertz).powi(2);
        let sag = -world.body(load).unwrap().position().y;
        assert!((sag / expected - 1.0).abs() < 0.05, "{hertz} Hz: {sag} m for {expected}");
        let angle = -world.body(arm).unwrap().angle();
        assert!(angle > 0.5 * expected.min(1.0), "{hertz} Hz: {angle} rad for some {expected}");
    }
}
