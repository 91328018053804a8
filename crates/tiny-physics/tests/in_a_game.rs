//! What games ask of the interface, one test a wish.

use tiny_physics::prelude::*;
use tiny_physics::*;

const DT: f32 = 1.0 / 60.0;

fn steps(world: &mut World, count: usize) {
    (0..count).for_each(|_| world.step(DT));
}

fn square(size: f32) -> Shape {
    Shape::rect(size, size).unwrap()
}

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

fn ground(world: &mut World) -> BodyId {
    let floor = ShapeDef::new(Shape::rect(50.0, 1.0).unwrap()).user_data(1);
    world.add_body(RigidBody::fixed().position((0.0, -1.0)).shape(floor).user_data(10)).unwrap()
}

/// What a body gains is what its contacts say, bounces and all: also in islands that are solved more finely, in those
/// with joints, and with more iterations.
#[test]
fn total_impulses_are_what_bodies_gain() {
    for (restitution, iterations, hinge) in [(0.0, 1, false), (0.7, 1, false), (0.3, 4, true)] {
        let settings = Settings { iterations, ..Settings::default() };
        let mut world = World::with_settings((0.0, -10.0), settings);
        ground(&mut world);
        let shape = ShapeDef::new(square(0.5)).restitution(restitution).events();
        let at = |x: f64, y: f64| RigidBody::dynamic().position((x, y)).shape(shape.clone());
        let mut bodies = vec![world.add_body(at(0.0, 2.0).mass(4.0)).unwrap()];
        bodies.push(world.add_body(at(0.1, 5.0).angle(0.2).mass(90.0)).unwrap());
        if hinge {
            bodies.push(world.add_body(at(1.2, 3.0).mass(1.0)).unwrap());
            let def = JointDef::revolute().anchor_at((0.6, 2.5));
            world.add_joint(bodies[0], bodies[2], def).unwrap();
        }
        let momentum = |world: &World| -> f32 {
            let of = |id: &BodyId| {
                let body = world.body(*id).unwrap();
                body.mass() * body.velocity().y
            };
            bodies.iter().map(of).sum()
        };
        let mass: f32 = bodies.iter().map(|id| world.body(*id).unwrap().mass()).sum();
        for step in 0..90 {
            let before = momentum(&world);
            world.step(DT);
            let gained = momentum(&world) - before + mass * 10.0 * DT;
            let push = |contact: ContactView| {
                let up = |body| world.body(body).unwrap().mass() > 0.0;
                // Between two that move, what one gains the other loses.
                match (up(contact.body_a), up(contact.body_b)) {
                    (false, true) => contact.normal.y * contact.total_impulse(),
                    (true, false) => -contact.normal.y * contact.total_impulse(),
                    _ => 0.0,
                }
            };
            let pushed: f32 = world.contacts().map(push).sum();
            let scale = 1.0 + pushed.abs();
            assert!((pushed - gained).abs() < 0.02 * scale, "{step}: {pushed}, not {gained}");
        }
    }
}

#[test]
fn a_pea_and_a_boulder_hit_with_their_own_force() {
    let mut world = World::new((0.0, -10.0));
    let floor = ground(&mut world);
    let mut drop = |x: f64, mass: f32| {
        let shape = ShapeDef::new(Shape::circle(0.2).unwrap()).events().user_data(7);
        let body = RigidBody::dynamic().position((x, 3.0)).mass(mass).shape(shape);
        world.add_body(body.user_data(mass as u64)).unwrap()
    };
    let (pea, boulder) = (drop(-2.0, 1.0), drop(2.0, 500.0));
    let mut hits = Vec::new();
    for _ in 0..90 {
        world.step(DT);
        hits.extend_from_slice(world.events().hits());
    }
    assert_eq!(hits.len(), 2, "{hits:?}");
    for (body, mass) in [(pea, 1.0), (boulder, 500.0)] {
        let hit = hits.iter().find(|hit| hit.body_b == body || hit.body_a == body).unwrap();
        // In the step of the hit gravity is caught as well.
        let expected = mass * (hit.speed + 10.0 * DT);
        assert!((hit.impulse - expected).abs() < 0.03 * expected, "{hit:?}");
        assert!([hit.body_a, hit.body_b].contains(&floor));
        assert_eq!(hit.mass_a + hit.mass_b, mass, "the floor has none");
        let data = if hit.body_a == body { hit.user_data_a } else { hit.user_data_b };
        assert_eq!(data, UserData { shape: 7, body: mass as u64 });
    }
}

/// Whoever ends a contact or leaves a sensor by being removed is named all the same.
#[test]
fn events_name_what_has_been_removed() {
    let mut world = World::new((0.0, -10.0));
    let floor = ground(&mut world);
    let zone = ShapeDef::new(Shape::rect(3.0, 3.0).unwrap()).sensor().user_data(5);
    let zone = world.add_body(RigidBody::fixed().shape(zone).user_data(50)).unwrap();
    let coin = ShapeDef::new(Shape::circle(0.3).unwrap()).events().user_data(2);
    let coin = RigidBody::dynamic().position((0.0, 0.3)).shape(coin).user_data(20);
    let coins = [0.0, 1.0].map(|x| world.add_body(coin.clone().position((x, 0.3))).unwrap());
    steps(&mut world, 2);
    assert_eq!(
        world.sensor_overlaps(world.body(zone).unwrap().shapes().next().unwrap()).count(),
        2
    );
    // While going through what happened, on a copy.
    let mut events = world.events().clone();
    steps(&mut world, 1);
    events.clone_from(world.events());
    assert_eq!(events, *world.events());
    world.remove_body(coins[0]).unwrap();
    // Its place is taken at once.
    let other =
        world.add_body(RigidBody::fixed().position((0.0, 90.0)).shape(square(0.1))).unwrap();
    assert_eq!(other.index(), coins[0].index());
    let frame = World::from_bytes(&world.to_bytes()).unwrap();
    for mut world in [world, frame] {
        world.step(DT);
        let end = world.events().contact_end()[0];
        assert!([end.body_a, end.body_b].contains(&coins[0]));
        let (coin, ground) = if end.body_a == coins[0] {
            (end.user_data_a, (end.body_b, end.user_data_b))
        } else {
            (end.user_data_b, (end.body_a, end.user_data_a))
        };
        assert_eq!(coin, UserData { shape: 2, body: 20 });
        assert_eq!(ground, (floor, UserData { shape: 1, body: 10 }));
        let left = world.events().sensor_end();
        assert_eq!(left.len(), 1);
        assert_eq!((left[0].sensor_body, left[0].visitor_body), (zone, coins[0]));
        assert_eq!(left[0].sensor_data, UserData { shape: 5, body: 50 });
        assert_eq!(left[0].visitor_data, UserData { shape: 2, body: 20 });

        world.remove_body(zone).unwrap();
        world.step(DT);
        let left = world.events().sensor_end();
        assert_eq!(left.len(), 1, "one coin was left in it");
        assert_eq!((left[0].sensor_body, left[0].visitor_body), (zone, coins[1]));
        world.validate().unwrap();
    }
}
