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
            // What sleeps has no contacts to tell of.
            if world.awake_body_count() < bodies.len() {
                assert!(step > 60, "{step}: asleep already");
                break;
            }
            // Nor is what was withheld anybody's impulse.
            if world.stats().withheld_energy > 0.0 {
                continue;
            }
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

fn circle(radius: f32) -> Shape {
    Shape::circle(radius).unwrap()
}

/// A doll whose centre of mass is low rights itself; one with the centre of its shape does not.
#[test]
fn centre_and_inertia_are_what_they_are_set_to() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let doll = |x: f64| {
        let body = RigidBody::dynamic().position((x, 0.5)).angle(1.2).shape(circle(0.5)).mass(2.0);
        body.damping(0.0, 1.0).can_sleep(false)
    };
    let low = world.add_body(doll(0.0).center((0.0, -0.3))).unwrap();
    let plain = world.add_body(doll(5.0)).unwrap();
    let inertia = |world: &World, id| world.body(id).unwrap().inertia();
    // Of a disk, and about a point 0.3 m off.
    assert!((inertia(&world, plain) - 0.5 * 2.0 * 0.25).abs() < 1e-5);
    assert!((inertia(&world, low) - (0.25 + 2.0 * 0.09)).abs() < 1e-5);
    steps(&mut world, 900);
    assert!(world.body(low).unwrap().angle().abs() < 0.05);
    assert!((world.body(plain).unwrap().angle() - 1.2).abs() < 0.05);

    let place = world.body(plain).unwrap().position();
    let mut body = world.body_mut(plain).unwrap();
    body.set_inertia(Some(9.0)).unwrap();
    body.set_center(Some(Vec2::new(0.1, 0.0))).unwrap();
    assert!(body.set_inertia(Some(0.0)).is_err() && body.set_inertia(Some(f32::NAN)).is_err());
    assert!(body.set_center(Some(Vec2::new(f32::NAN, 0.0))).is_err());
    assert_eq!((body.inertia(), body.local_center()), (9.0, Vec2::new(0.1, 0.0)));
    assert!((body.position() - place).length() < 1e-6);
    body.set_mass(Some(4.0)).unwrap();
    assert_eq!(body.inertia(), 9.0, "as it was set");
    body.set_center(None).unwrap();
    body.set_inertia(None).unwrap();
    assert!((body.inertia() - 0.5).abs() < 1e-5);
    assert!(world.add_body(doll(9.0).inertia(-1.0)).is_err());
    assert!(world.add_body(doll(9.0).center((f32::INFINITY, 0.0))).is_err());
    world.validate().unwrap();
}

#[test]
fn materials_bring_their_own_rule_of_mixing() {
    let mut world = World::new((0.0, -10.0));
    let trampoline = ShapeDef::new(square(1.0)).restitution(0.9).mix(None, Some(Mix::Max));
    world.add_body(RigidBody::fixed().shape(trampoline)).unwrap();
    world.add_body(RigidBody::fixed().position((5.0, 0.0)).shape(square(1.0))).unwrap();
    let ball = |x: f64| RigidBody::dynamic().position((x, 3.0)).shape(circle(0.3));
    let (bounces, rests) = (ball(0.0), ball(5.0));
    let [bounces, rests] = [bounces, rests].map(|ball| world.add_body(ball).unwrap());
    let mut highest = [0.0_f32; 2];
    for step in 0..120 {
        world.step(DT);
        if step > 45 {
            for (highest, ball) in highest.iter_mut().zip([bounces, rests]) {
                *highest = highest.max(world.body(ball).unwrap().position().y);
            }
        }
    }
    assert!(highest[0] > 2.3 && highest[1] < 1.35, "{highest:?}");
}

/// Friction, restitution and density alone; a filter that switches a shape off and on.
#[test]
fn shapes_are_changed_one_thing_at_a_time() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let body = RigidBody::dynamic().position((0.0, 0.5)).velocity((4.0, 0.0)).shape(square(0.5));
    let body = world.add_body(body.friction(0.0)).unwrap();
    let shape = world.body(body).unwrap().shapes().next().unwrap();
    steps(&mut world, 30);
    assert!((world.body(body).unwrap().velocity().x - 4.0).abs() < 1e-3);
    let mut change = world.shape_mut(shape).unwrap();
    change.set_friction(1.0).unwrap();
    change.set_restitution(0.3).unwrap();
    change.set_density(3.0).unwrap();
    assert!(change.set_friction(-1.0).is_err() && change.set_density(f32::NAN).is_err());
    let material = change.material();
    assert_eq!((material.friction, material.restitution, material.density), (1.0, 0.3, 3.0));
    assert_eq!(world.body(body).unwrap().mass(), 3.0);
    steps(&mut world, 60);
    assert!(world.body(body).unwrap().velocity().x.abs() < 0.5, "rubs now");

    let filter = world.shape(shape).unwrap().filter();
    world.shape_mut(shape).unwrap().set_filter(Filter::NONE);
    steps(&mut world, 20);
    assert!(world.body(body).unwrap().position().y < 0.3, "it falls through the ground");
    assert!(
        world
            .overlap_point(world.body(body).unwrap().center(), &QueryFilter::new())
            .iter()
            .all(|found| *found != shape)
    );
    world.body_mut(body).unwrap().set_position((0.0, 2.0));
    world.shape_mut(shape).unwrap().set_filter(filter);
    steps(&mut world, 120);
    assert!((world.body(body).unwrap().position().y - 0.5).abs() < 0.01, "and stands on it again");
}

/// Whatever a body has, its copy has.
#[test]
fn bodies_are_described_as_they_are() {
    let mut world = World::new((0.0, -10.0));
    let shape =
        ShapeDef::new(Shape::regular(5, 0.5).unwrap()).offset((0.3, 0.1)).angle(0.5).events();
    let shape =
        shape.friction(0.2).density(3.0).one_way((0.0, 1.0)).user_data(4).mix(Some(Mix::Min), None);
    let sensor = ShapeDef::new(circle(1.0)).density(0.0).sensor_of_sensors();
    let body = RigidBody::dynamic()
        .position((3.0, 9.0))
        .angle(0.7)
        .velocity((1.0, 2.0))
        .shape(shape)
        .shape(sensor);
    let body = body
        .angular_velocity(3.0)
        .damping(0.1, 0.2)
        .gravity_scale(0.5)
        .bullet()
        .mass(7.0)
        .inertia(2.0)
        .center((0.1, 0.0));
    let body = RigidBody { locks: Locks { x: true, y: false, rotation: false }, ..body }
        .user_data(11)
        .can_sleep(false);
    let first = world.add_body(body.clone()).unwrap();
    let told = world.body(first).unwrap().describe();
    assert!((told.angle - body.angle).abs() < 1e-6);
    assert!((told.shapes[0].angle - body.shapes[0].angle).abs() < 1e-6);
    let exact = |mut told: RigidBody| {
        told.angle = body.angle;
        told.position = body.position;
        told.shapes[0].angle = body.shapes[0].angle;
        told
    };
    assert!((told.position - body.position).length() < 1e-6);
    assert_eq!(exact(told), body);
    let chain = RigidBody::fixed().chain(&ChainDef::heights(1.0, &[0.0, 1.0, 0.5])).unwrap();
    let ground = world.add_body(chain.clone()).unwrap();
    assert_eq!(world.body(ground).unwrap().describe(), chain);
    steps(&mut world, 10);
    let copy = world.body(first).unwrap().describe();
    let mut apart = World::new((0.0, -10.0));
    let copy = apart.add_body(copy).unwrap();
    assert!(
        (apart.body(copy).unwrap().center() - world.body(first).unwrap().center()).length() < 1e-5
    );
}

#[test]
fn ground_of_heights_and_half_spaces_holds() {
    let mut world = World::new((0.0, -10.0));
    let hills: Vec<f32> = (0..41).map(|i| (0.5 * i as f32).sin()).collect();
    let field = ChainDef::heights(1.0, &hills);
    world.add_body(RigidBody::fixed().position((-20.0, 0.0)).chain(&field).unwrap()).unwrap();
    let floor = ChainDef::half_space((0.0, -5.0), (0.0, 1.0));
    world.add_body(RigidBody::fixed().chain(&floor).unwrap()).unwrap();
    let at = |x: f64| RigidBody::dynamic().position((x, 4.0)).shape(circle(0.3));
    let on_hill = world.add_body(at(0.0).damping(0.5, 0.5)).unwrap();
    let beside = world.add_body(at(400.0)).unwrap();
    steps(&mut world, 600);
    let hill = world.body(on_hill).unwrap().position();
    let height = (0.5 * (hill.x + 20.0)).sin();
    assert!(hill.y > height && hill.y < height + 0.6, "{hill:?} over {height}");
    assert!((world.body(beside).unwrap().position().y + 4.7).abs() < 0.01);
    let tilted = ChainDef::half_space((0.0, 0.0), (1.0, 1.0)).shapes().unwrap();
    let Shape::Segment { a, b } = tilted[0].shape else { panic!("a segment") };
    assert!((b - a).cross(Vec2::new(1.0, 1.0)) < 0.0, "outside is to the right of the way");
}

#[test]
fn solid_rays_hit_what_they_begin_in() {
    let mut world = World::new((0.0, 0.0));
    let room = world.add_body(RigidBody::fixed().shape(square(2.0))).unwrap();
    let post = world.add_body(RigidBody::fixed().position((5.0, 0.0)).shape(circle(0.5))).unwrap();
    let (from, way) = (Vec2::ZERO, Vec2::new(9.0, 0.0));
    let plain = world.ray_cast(from, way, &QueryFilter::new()).unwrap();
    assert_eq!(plain.body, post);
    let solid = QueryFilter::new().solid();
    let hit = world.ray_cast(from, way, &solid).unwrap();
    assert_eq!((hit.body, hit.fraction, hit.normal), (room, 0.0, -Vec2::X));
    assert_eq!(world.ray_cast_all(from, way, &solid).len(), 2);
    let outside = Vec2::new(-5.0, 0.0);
    assert_eq!(
        world.ray_cast(outside, way, &solid),
        world.ray_cast(outside, way, &QueryFilter::new())
    );
}

/// Everything that a moved shape touches is found, and what it touches first is the first of them.
#[test]
fn casts_find_all_and_turn() {
    let mut world = World::new((0.0, 0.0));
    for i in 0..6 {
        let place = (2.0 + 1.5 * f64::from(i), 0.2 * f64::from(i % 3));
        world.add_body(RigidBody::fixed().position(place).shape(circle(0.3))).unwrap();
    }
    let (foot, start, way) = (square(0.25), Transform::IDENTITY, Vec2::new(7.0, 0.0));
    let filter = QueryFilter::new();
    let all = world.cast_shape_all(&foot, start, way, &filter);
    assert_eq!(all.len(), 4, "{all:?}");
    assert!(all.is_sorted_by_key(|hit| hit.fraction));
    assert_eq!(world.cast_shape(&foot, start, way, &filter), Some(all[0]));
    // Without a turn it is the cast; with one that is next to nothing, nearly.
    assert_eq!(world.cast_shape_turning(&foot, start, way, 0.0, &filter), Some(all[0]));
    let nearly = world.cast_shape_turning(&foot, start, way, 1e-6, &filter).unwrap();
    assert!((nearly.fraction - all[0].fraction).abs() < 1e-4 && nearly.shape == all[0].shape);
    assert!((nearly.normal - all[0].normal).length() < 1e-2);
    // A bar that turns comes to the post as late as the angle says: oracle by small steps.
    let bar = Shape::rect(1.9, 0.05).unwrap();
    let turn = -1.5;
    let start = Transform::from_angle(Vec2::new(0.5, 0.0), 1.2);
    let hit = world.cast_shape_turning(&bar, start, (0.4, 0.0), turn, &filter).unwrap();
    let touches = |fraction: f32| {
        let at = Transform::from_angle(Vec2::new(0.5 + 0.4 * fraction, 0.0), 1.2 + turn * fraction);
        !world.overlap_shape(&bar, at, &filter).is_empty()
    };
    let first = (0..=10_000).map(|i| i as f32 * 1e-4).find(|&fraction| touches(fraction)).unwrap();
    assert!((hit.fraction - first).abs() < 1e-3, "{} against {first}", hit.fraction);
    let hostile = [f32::NAN, f32::INFINITY];
    for n in hostile {
        assert_eq!(world.cast_shape_turning(&bar, start, (0.0, 0.0), n, &filter), None);
        assert!(world.cast_shape_all(&bar, start, (n, 0.0), &filter).is_empty());
    }
}

#[test]
fn distances_between_shapes_and_bodies_of_overlaps() {
    use core::ops::ControlFlow;
    let mut world = World::new((0.0, 0.0));
    let a = world.add_body(RigidBody::fixed().position((1e6, 0.0)).shape(circle(1.0))).unwrap();
    let two = RigidBody::dynamic().position((1e6 + 4.0, 0.0)).shape(square(0.5));
    let b = world.add_body(two.shape(ShapeDef::new(square(0.5)).offset((0.5, 0.0)))).unwrap();
    let shape = |world: &World, id| world.body(id).unwrap().shapes().next().unwrap();
    let gap = world.shape_distance(shape(&world, a), shape(&world, b)).unwrap();
    assert!((gap.separation - 2.5).abs() < 1e-5 && (gap.normal - Vec2::X).length() < 1e-6);
    assert!((gap.point_a - DVec2::new(1e6 + 1.0, 0.0)).length() < 1e-5);
    assert!((gap.point_b.x - (1e6 + 3.5)).abs() < 1e-5);
    let back = world.shape_distance(shape(&world, b), shape(&world, a)).unwrap();
    assert!((back.normal + gap.normal).length() < 1e-6);

    let area = square(9.0);
    let at = Pose::new(DVec2::new(1e6, 0.0), Rot::IDENTITY);
    assert_eq!(world.overlap_shape(&area, at, &QueryFilter::new()).len(), 3);
    assert_eq!(world.overlap_bodies(&area, at, &QueryFilter::new()), [a, b]);
    let mut seen = 0;
    world.visit_overlaps(&area, at, &QueryFilter::new(), |shape| {
        seen += 1;
        if shape.body() == b { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!((1..3).contains(&seen), "it breaks off at the first of b");
    let stale = shape(&world, a);
    world.remove_body(a).unwrap();
    assert_eq!(world.shape_distance(stale, shape(&world, b)), None);
}

/// Sensors see sensors where they ask for it, also at a speed at which they are never seen inside.
#[test]
fn sensors_see_sensors_when_asked() {
    for speed in [3.0, 400.0] {
        let mut world = World::new((0.0, 0.0));
        let zone = |def: ShapeDef, x: f64| RigidBody::fixed().position((x, 0.0)).shape(def);
        let hurt = world.add_body(zone(ShapeDef::new(square(0.2)).sensor(), 2.0)).unwrap();
        let asks = ShapeDef::new(square(0.2)).sensor_of_sensors();
        let asks = world.add_body(zone(asks, 4.0)).unwrap();
        let blade = ShapeDef::new(circle(0.2)).density(0.0).sensor_of_sensors();
        let hilt = ShapeDef::new(circle(0.1)).filter(Filter::NONE);
        let sword = RigidBody::dynamic().velocity((speed, 0.0)).shape(blade).shape(hilt);
        let sword = world.add_body(sword).unwrap();
        let (mut begun, mut ended) = (Vec::new(), 0);
        for _ in 0..(360.0 / speed) as usize + 5 {
            world.step(DT);
            begun.extend(
                world.events().sensor_begin().iter().map(|e| (e.sensor_body, e.visitor_body)),
            );
            ended += world.events().sensor_end().len();
        }
        begun.sort_unstable();
        let mut expected = [(sword, hurt), (sword, asks), (asks, sword)];
        expected.sort_unstable();
        assert_eq!(begun, expected, "at {speed} m/s");
        assert_eq!(ended, 3);
    }
}

#[test]
fn drawing_stands_between_steps() {
    struct Circles(Vec<Vec2>);
    impl DebugDraw for Circles {
        fn polygon(&mut self, _: &Transform, _: &[Vec2], _: f32, _: Color) {}
        fn circle(&mut self, pose: &Transform, _: f32, _: Color) {
            self.0.push(pose.p);
        }
        fn capsule(&mut self, _: Vec2, _: Vec2, _: f32, _: Color) {}
        fn segment(&mut self, _: Vec2, _: Vec2, _: Color) {}
        fn point(&mut self, _: Vec2, _: f32, _: Color) {}
        fn text(&mut self, _: Vec2, _: &str, _: Color) {}
    }
    let mut world = World::new((0.0, 0.0));
    world.add_body(RigidBody::dynamic().velocity((6.0, 0.0)).shape(circle(0.5))).unwrap();
    world.step(DT);
    for (alpha, x) in [(0.0, 0.0), (0.5, 0.05), (1.0, 0.1)] {
        let mut drawn = Circles(Vec::new());
        world.debug_draw(&mut drawn, &DebugDrawOptions { alpha, ..DebugDrawOptions::default() });
        assert!((drawn.0[0].x - x).abs() < 1e-5, "{alpha}: {:?}", drawn.0);
    }
}

/// A polygon of more than eight corners is split, whole and with the same mass.
#[test]
fn polygons_of_many_corners_are_split() {
    let ring: Vec<Vec2> =
        (0..24).map(|i| Vec2::new((i as f32 * 0.2618).cos(), (i as f32 * 0.2618).sin())).collect();
    let material = ShapeDef::new(square(1.0));
    let wheel = RigidBody::dynamic().outline(&ring, &material).unwrap();
    assert!(wheel.shapes.len() < 6);
    let mut world = World::new((0.0, 0.0));
    let wheel = world.add_body(wheel).unwrap();
    let area = 12.0 * (0.2618_f32).sin();
    assert!((world.body(wheel).unwrap().mass() - area).abs() < 1e-3);
}

fn walk(walk: f32) -> MoverInput {
    MoverInput { walk, ..MoverInput::default() }
}

fn hero(world: &mut World, place: (f64, f64)) -> CharacterMover {
    let mut hero = CharacterMover::new(place, 1.8, 0.3);
    hero.body = Some(world.add_body(hero.describe_body()).unwrap());
    hero
}

fn go(world: &mut World, hero: &mut CharacterMover, input: MoverInput, count: usize) {
    for _ in 0..count {
        world.step(DT);
        hero.update(world, input, DT);
    }
}

/// The recipe of the guide: coins to pick up, a door that opens, a zone that hurts. Each is a plain sensor.
#[test]
fn a_hero_picks_up_opens_doors_and_is_hurt() {
    const COIN: u64 = 1;
    const DOOR: u64 = 2;
    const FIRE: u64 = 3;
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let zone = |x: f64, half: f32, what: u64| {
        let shape = ShapeDef::new(Shape::rect(half, 0.5).unwrap()).sensor();
        RigidBody::fixed().position((x, 0.5)).shape(shape).user_data(what)
    };
    for x in [2.0, 3.0, 4.0] {
        world.add_body(zone(x, 0.1, COIN)).unwrap();
    }
    world.add_body(zone(7.0, 1.0, DOOR)).unwrap();
    let door = RigidBody::kinematic().position((8.5, 1.5)).shape(Shape::rect(0.2, 1.5).unwrap());
    let door = world.add_body(door).unwrap();
    world.add_body(zone(12.0, 1.0, FIRE)).unwrap();
    let mut hero = hero(&mut world, (0.0, 0.91));
    let (mut coins, mut in_fire, mut health) = (0, 0, 100.0);
    let mut events = world.events().clone();
    for _ in 0..480 {
        world.step(DT);
        events.clone_from(world.events());
        for met in events.sensor_begin().iter().filter(|met| Some(met.sensor_body) == hero.body) {
            match met.visitor_data.body {
                COIN => {
                    coins += 1;
                    world.remove_body(met.visitor_body).unwrap();
                }
                DOOR => world.body_mut(door).unwrap().set_velocity((0.0, 6.0)),
                FIRE => in_fire += 1,
                _ => {}
            }
        }
        for left in events.sensor_end().iter().filter(|left| Some(left.sensor_body) == hero.body) {
            match left.visitor_data.body {
                DOOR => world.body_mut(door).unwrap().set_velocity((0.0, 0.0)),
                FIRE => in_fire -= 1,
                _ => {}
            }
        }
        health -= 20.0 * DT * in_fire as f32;
        hero.update(&mut world, walk(3.0), DT);
    }
    assert!(hero.position.x > 15.0, "the door has let him through: {:?}", hero.position);
    assert_eq!((coins, in_fire), (3, 0));
    // 2 m of fire and his own width, at 3 m/s and 20 points a second.
    let burnt = 100.0 - health;
    assert!((burnt - 20.0 * 2.6 / 3.0).abs() < 1.0, "{burnt}");
    assert_eq!(world.body(hero.body.unwrap()).unwrap().position_f64(), hero.position);
    world.validate().unwrap();
}

/// A solid body of his own does not get in his way.
#[test]
fn a_hero_does_not_fight_his_own_body() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let mut alone = CharacterMover::new((0.0, 0.91), 1.8, 0.3);
    let mut with_body = CharacterMover::new((0.0, 0.91), 1.8, 0.3);
    let solid = Shape::capsule((0.0, -0.6), (0.0, 0.6), 0.3).unwrap();
    let body = RigidBody::kinematic().position((0.0, 0.91)).shape(solid);
    let ball = RigidBody::dynamic().position((30.0, 0.4)).velocity((-4.0, 0.0)).shape(circle(0.3));
    let ball = world.add_body(ball).unwrap();
    with_body.body = Some(world.add_body(body).unwrap());
    let mut apart = World::new((0.0, -10.0));
    ground(&mut apart);
    for step in 0..200 {
        let input = MoverInput { jump: if step % 50 == 20 { 4.0 } else { 0.0 }, ..walk(2.0) };
        go(&mut world, &mut with_body, input, 1);
        go(&mut apart, &mut alone, input, 1);
        assert_eq!(alone.position, with_body.position);
    }
    steps(&mut world, 300);
    assert!(
        world.body(ball).unwrap().position().x > with_body.position.x as f32,
        "it is stopped by him"
    );
}

#[test]
fn a_hero_is_launched_along_with_what_he_wants() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let wall = Shape::rect(0.5, 9.0).unwrap();
    let wall = world.add_body(RigidBody::fixed().position((5.0, 9.0)).shape(wall)).unwrap();
    let mut hero = hero(&mut world, (0.0, 0.91));
    go(&mut world, &mut hero, MoverInput::default(), 5);
    // Knockback: off the ground and back to it, as far as the parabola goes.
    hero.launch((-4.0, 5.0));
    go(&mut world, &mut hero, MoverInput::default(), 10);
    assert!(hero.ground().is_none());
    go(&mut world, &mut hero, MoverInput::default(), 60);
    assert!(hero.ground().is_some() && (hero.position.x + 4.0).abs() < 0.05, "{:?}", hero.position);
    // Wall jump: run against the wall in the air, push off from what was hit.
    go(&mut world, &mut hero, walk(6.0), 80);
    go(&mut world, &mut hero, MoverInput { jump: 6.0, ..walk(6.0) }, 1);
    go(&mut world, &mut hero, walk(6.0), 15);
    let hit = *hero.hits().iter().find(|hit| hit.body == wall).expect("he runs against the wall");
    assert!((hit.normal + Vec2::X).length() < 1e-3 && (hit.point.x - 4.5).abs() < 1e-3);
    let height = hero.position.y;
    hero.launch(hit.normal * 3.0 + Vec2::Y * 5.0);
    go(&mut world, &mut hero, MoverInput::default(), 20);
    assert!(hero.position.y > height + 0.8 && hero.position.x < 3.4, "{:?}", hero.position);
    // Sideways speed ends where it meets a wall.
    hero.position = DVec2::new(3.5, 5.0);
    hero.launch((5.0, 0.0));
    go(&mut world, &mut hero, MoverInput::default(), 20);
    let beside = hero.position.x;
    go(&mut world, &mut hero, walk(-1.0), 6);
    assert!((beside - hero.position.x - 0.1).abs() < 0.01, "he is free of it");
}

/// Ladders and dashes by moves of his own.
#[test]
fn a_hero_moves_by_rules_of_his_own() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let block = world.add_body(RigidBody::fixed().position((3.0, 1.0)).shape(square(1.0))).unwrap();
    let mut hero = hero(&mut world, (0.0, 0.91));
    go(&mut world, &mut hero, MoverInput::default(), 5);
    for _ in 0..60 {
        world.step(DT);
        let made = hero.move_by(&world, (0.0, 3.0 * DT));
        assert!((made - Vec2::new(0.0, 0.05)).length() < 1e-6);
        hero.lead_body(&mut world);
    }
    assert!((hero.position.y - 3.91).abs() < 0.01 && hero.ground().is_none());
    assert_eq!(world.body(hero.body.unwrap()).unwrap().position_f64(), hero.position);
    assert!((hero.interpolated_position(0.5).y - (hero.position.y - 0.025)).abs() < 1e-6);
    // Down to the ground, which stops him and carries him.
    let made = hero.move_by(&world, (0.0, -9.0));
    assert!((made.y + 3.0).abs() < 0.01 && hero.ground().is_some());
    // A dash runs against the block and along it.
    let made = hero.move_by(&world, (9.0, 0.1));
    assert!((made.x - 1.7).abs() < 0.02, "{made:?}");
    assert!(hero.hits().iter().any(|hit| hit.body == block));
    assert_eq!(hero.move_by(&world, (f32::NAN, 0.0)), Vec2::ZERO);
}

#[test]
fn a_hero_ducks_and_gets_up_where_there_is_room() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let ceiling = Shape::rect(2.0, 0.5).unwrap();
    world.add_body(RigidBody::fixed().position((4.0, 1.7)).shape(ceiling)).unwrap();
    let mut hero = hero(&mut world, (0.0, 0.91));
    go(&mut world, &mut hero, walk(3.0), 60);
    assert!(hero.position.x < 2.0, "too tall");
    assert!(hero.resize(&world, 1.0, 0.3));
    assert!((hero.position.y - 0.51).abs() < 1e-3, "the foot stays");
    go(&mut world, &mut hero, walk(3.0), 40);
    assert!(hero.position.x > 3.0 && !hero.resize(&world, 1.8, 0.3), "no room to get up");
    let form = world.body(hero.body.unwrap()).unwrap().shapes().next().unwrap();
    let Shape::Capsule { a, b, .. } = *world.shape(form).unwrap().shape() else { panic!() };
    assert!(((b - a).length() - 0.4).abs() < 1e-5, "his body ducks, too");
    go(&mut world, &mut hero, walk(3.0), 60);
    assert!(hero.resize(&world, 1.8, 0.3) && hero.fits(&world));
    for bad in [f32::NAN, f32::INFINITY, -1.0] {
        assert!(!hero.resize(&world, 1.8, bad));
    }
    assert!(!hero.resize(&world, f32::NAN, 0.3));
}

/// A gap 2 % wider than himself, from above, from below and along.
#[test]
fn a_hero_passes_gaps_a_fiftieth_wider_than_himself() {
    for off in [-0.004, 0.0, 0.004] {
        let mut world = World::new((0.0, -10.0));
        ground(&mut world);
        for side in [-1.0, 1.0] {
            let wall = Shape::rect(1.0, 3.0).unwrap();
            let place = (side * (1.0 + 0.306), 5.0);
            world.add_body(RigidBody::fixed().position(place).shape(wall)).unwrap();
        }
        let mut hero = hero(&mut world, (off, 9.5));
        go(&mut world, &mut hero, MoverInput::default(), 150);
        assert!((hero.position.y - 0.91).abs() < 0.01, "down, {off}: {:?}", hero.position);
        hero.position.x = off;
        go(&mut world, &mut hero, MoverInput { jump: 14.0, ..walk(0.0) }, 1);
        go(&mut world, &mut hero, MoverInput::default(), 70);
        assert!(hero.position.y > 8.0, "up, {off}: {:?}", hero.position);
    }
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let lid = Shape::rect(3.0, 1.0).unwrap();
    world.add_body(RigidBody::fixed().position((5.0, 1.0 + 1.8 * 1.02)).shape(lid)).unwrap();
    let mut hero = hero(&mut world, (0.0, 0.91));
    go(&mut world, &mut hero, walk(3.0), 240);
    assert!(hero.position.x > 11.5, "along: {:?}", hero.position);
}

#[test]
fn a_ledge_goes_as_one_or_not_at_all() {
    let mut world = World::new((0.0, -10.0));
    let floor = world.add_body(RigidBody::fixed()).unwrap();
    let ledge = world.add_chain(floor, &ChainDef::heights(1.0, &[1.0; 9])).unwrap();
    let load = RigidBody::dynamic()
        .position((4.0, 1.3))
        .shape(square(0.3))
        .shape(ShapeDef::new(square(0.3)).offset((0.6, 0.0)));
    let load = world.add_body(load).unwrap();
    steps(&mut world, 300);
    assert!(!world.body(load).unwrap().is_awake());
    let (half, mass) =
        (world.body(load).unwrap().shapes().next().unwrap(), world.body(load).unwrap().mass());
    let ice = |friction| Material { friction, ..Material::default() };
    let frictions = |world: &World| -> Vec<f32> {
        ledge.iter().filter_map(|id| Some(world.shape(*id)?.material().friction)).collect()
    };
    ledge.set_material(&mut world, ice(0.1)).unwrap();
    assert!(ledge.set_material(&mut world, ice(f32::NAN)).is_err());
    assert_eq!(frictions(&world), [0.1; 8]);
    assert!(world.body(load).unwrap().is_awake(), "the ground has changed");
    world.remove_shape(ledge[0]).unwrap();
    assert!(ledge.set_material(&mut world, ice(0.2)).is_err());
    assert_eq!(frictions(&world), [0.1; 7], "one is gone");
    assert!(ledge.clone().remove(&mut world).is_err(), "one is gone");
    assert_eq!(world.shape_count(), 9);
    // Shapes of two bodies, one of them named twice.
    let gone = [&ledge[1..], &[half, half]].concat();
    world.remove_shapes(&gone).unwrap();
    assert_eq!((world.shape_count(), world.body(load).unwrap().mass()), (1, 0.5 * mass));
    world.validate().unwrap();
    steps(&mut world, 60);
    assert!(world.body(load).unwrap().position().y < -1.0, "it woke and fell");
    world.remove_shapes(&[]).unwrap();
}
