//! Bodies and shapes: describing, changing, drawing them.

use super::{DT, circle, ground, square, steps};
use tiny_physics::prelude::*;
use tiny_physics::*;

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

/// Joints outside of what is to be drawn leave nothing.
#[test]
fn anchors_that_nobody_sees_are_not_drawn() {
    struct Points(usize);
    impl DebugDraw for Points {
        fn polygon(&mut self, _: &Transform, _: &[Vec2], _: f32, _: Color) {}
        fn circle(&mut self, _: &Transform, _: f32, _: Color) {}
        fn capsule(&mut self, _: Vec2, _: Vec2, _: f32, _: Color) {}
        fn segment(&mut self, _: Vec2, _: Vec2, _: Color) {}
        fn point(&mut self, _: Vec2, _: f32, _: Color) {
            self.0 += 1;
        }
        fn text(&mut self, _: Vec2, _: &str, _: Color) {}
    }
    let mut world = World::new((0.0, 0.0));
    let hub = world.add_body(RigidBody::fixed()).unwrap();
    let door = world.add_body(RigidBody::dynamic().shape(square(1.0))).unwrap();
    world.add_joint(hub, door, JointDef::revolute().anchor_at((0.0, 0.0))).unwrap();
    let points = |at: f32| {
        let mut points = Points(0);
        let clip = Some(Aabb::from_center(Vec2::new(at, 0.0), Vec2::splat(1.0)));
        let joints = DebugDrawOptions {
            joints: true,
            contacts: false,
            mass: false,
            clip,
            ..Default::default()
        };
        world.debug_draw(&mut points, &joints);
        points.0
    };
    assert_eq!((points(0.0), points(100.0)), (1, 0));
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

/// A sail on an arm is blown no faster than the wind.
#[test]
fn no_wind_is_too_strong_for_what_is_lopsided() {
    let mut world = World::new((0.0, 0.0));
    let hub = ShapeDef::new(Shape::circle(0.2).unwrap()).density(50.0);
    let sail = ShapeDef::new(Shape::rect(0.05, 0.5).unwrap()).density(0.1).offset((0.0, 2.0));
    let body = world.add_body(RigidBody::dynamic().shape(hub).shape(sail)).unwrap();
    let wind = Wind { velocity: Vec2::new(20.0, 0.0), ..Wind::default() };
    for _ in 0..60 {
        world.body_mut(body).unwrap().apply_wind(&wind, DT);
        world.step(DT);
        let spin = world.body(body).unwrap().angular_velocity();
        assert!(spin.abs() < 10.0, "{spin}");
    }
}

/// Kinematic bodies that hang on each other in a chain wake all, however many.
#[test]
fn long_chains_of_platforms_wake() {
    let mut world = World::new((0.0, 0.0));
    let add = |world: &mut World| world.add_body(RigidBody::kinematic().asleep()).unwrap();
    let all: Vec<_> = (0..50_000).map(|_| add(&mut world)).collect();
    for pair in all.windows(2) {
        world.add_joint(pair[0], pair[1], JointDef::rope(1.0)).unwrap();
    }
    world.body_mut(all[0]).unwrap().wake();
    assert!(all.iter().all(|&body| world.body(body).unwrap().is_awake()));
}

/// Places beyond what positions have room for are refused: two shapes far off on both sides had a centre between them that was none.
#[test]
fn shapes_far_off_their_body_are_refused() {
    let mut world = World::new((0.0, 0.0));
    let ball = || ShapeDef::new(Shape::circle(0.5).unwrap());
    let far = RigidBody::dynamic().shape(ball().offset((3e38, 0.0)));
    assert!(world.add_body(far).is_err());
    let body = world.add_body(RigidBody::dynamic().shape(ball())).unwrap();
    let shape = world.body(body).unwrap().shapes().next().unwrap();
    assert!(world.shape_mut(shape).unwrap().set_local((-3e38, 0.0), 0.0).is_err());
    assert!(Polygon::turned_rect(9e5, 9e5, Vec2::ZERO, Rot::from_angle(0.8)).is_err());
    let seen = |world: &World| world.shapes_seen(&QueryFilter::new()).count();
    assert_eq!(seen(&world), 1);
    world.body_mut(body).unwrap().set_enabled(false);
    assert_eq!(seen(&world), 0);
}

/// What flew through a gate in one step and is put to sleep behind it is no longer in it.
#[test]
fn what_sleeps_behind_a_gate_has_left_it() {
    let mut world = World::new((0.0, 0.0));
    let gate = ShapeDef::new(Shape::rect(0.01, 1.0).unwrap()).sensor();
    world.add_body(RigidBody::fixed().shape(gate)).unwrap();
    let ball = RigidBody::dynamic().position((-0.15, 0.0)).velocity((18.0, 0.0));
    let ball = world.add_body(ball.shape(Shape::circle(0.05).unwrap())).unwrap();
    world.step(DT);
    assert_eq!(world.events().sensor_begin().len(), 1);
    world.body_mut(ball).unwrap().sleep();
    let mut ends = 0;
    for _ in 0..3 {
        world.step(DT);
        ends += world.events().sensor_end().len();
    }
    assert_eq!(ends, 1);
}

/// What lies under a heavy load is pushed as what it is: it took the load's momentum along, a hundred times what was given.
#[test]
fn impulses_under_a_load_are_no_more_than_impulses() {
    for (mass, impulse) in [20.0, 100.0, 500.0].into_iter().flat_map(|mass: f32| {
        [Vec2::new(1.0, 0.0), Vec2::new(-3.0, 0.0), Vec2::new(0.0, 20.0)].map(|i| (mass, i))
    }) {
        let mut world = World::new((0.0, -9.8));
        world.settings.sleep = false;
        let square = |friction: f32| ShapeDef::new(square(0.5)).friction(friction);
        let floor = ShapeDef::new(Shape::rect(50.0, 0.5).unwrap()).friction(0.0);
        world.add_body(RigidBody::fixed().position((0.0, -0.5)).shape(floor)).unwrap();
        let put = |mass: f32, y: f64| {
            RigidBody::dynamic().shape(square(0.2)).mass(mass).position((0.0, y))
        };
        let light = world.add_body(put(1.0, 0.5)).unwrap();
        let heavy = world.add_body(put(mass, 2.0)).unwrap();
        steps(&mut world, 90);
        let start = world.body(heavy).unwrap().position().y;
        world.body_mut(light).unwrap().apply_impulse_to_center(impulse);
        let mut rise = 0.0_f32;
        for _ in 0..60 {
            world.step(DT);
            rise = rise.max(world.body(heavy).unwrap().position().y - start);
        }
        let of = |body: BodyId| {
            let body = world.body(body).unwrap();
            body.velocity().x * body.mass()
        };
        let momentum = of(light) + of(heavy);
        assert!(momentum.abs() < impulse.x.abs() + 0.5, "{mass}, {impulse}: {momentum}");
        // As high as what the load can have got of it takes it.
        let speed = impulse.y / mass;
        assert!(rise < speed * speed / 19.6 + 0.002, "{mass}, {impulse}: {rise}");
    }
}

/// What is pushed a little in every step gets going, however slow it is at first.
#[test]
fn impulses_in_every_step_add_up() {
    let mut world = World::new((0.0, 0.0));
    let ball = RigidBody::dynamic().shape(Shape::circle(0.5).unwrap()).mass(1.0);
    let ball = world.add_body(ball).unwrap();
    for _ in 0..600 {
        world.body_mut(ball).unwrap().apply_impulse_to_center((0.05 * DT, 0.0));
        world.step(DT);
    }
    let speed = world.body(ball).unwrap().velocity().x;
    assert!((speed - 0.5).abs() < 0.01, "{speed}");
}

/// What a platform takes to and fro rolls on it as on the ground: it was braked until it went along.
#[test]
fn balls_roll_on_platforms_that_go_to_and_fro() {
    let mut world = World::new((0.0, -10.0));
    let platform = RigidBody::kinematic().shape(Shape::rect(4.0, 0.1).unwrap());
    let platform = world.add_body(platform).unwrap();
    let shape = ShapeDef::new(Shape::circle(0.3).unwrap()).friction(0.6);
    let ball = world.add_body(RigidBody::dynamic().shape(shape).position((0.0, 0.4))).unwrap();
    let mut peak = 0.0_f32;
    for i in 0..1200 {
        let speed = 0.4 * (std::f32::consts::PI * i as f32 * DT / 2.0).sin();
        world.body_mut(platform).unwrap().set_velocity((speed, 0.0));
        world.step(DT);
        if i > 720 {
            peak = peak.max(world.body(ball).unwrap().velocity().x.abs());
        }
    }
    assert!((peak - 0.133).abs() < 0.02, "{peak}");
}

/// What is damped and driven comes to force over damping, at any rate.
#[test]
fn terminal_speed_is_force_over_damping_at_any_rate() {
    for (rate, substeps) in [(30, 1), (60, 1), (60, 4), (240, 8)] {
        let mut world = World::new((0.0, -10.0));
        world.settings.substeps = substeps;
        let ball = RigidBody::dynamic().damping(5.0, 2.0).shape(circle(0.5)).mass(3.0);
        let ball = world.add_body(ball).unwrap();
        let inertia = world.body(ball).unwrap().inertia();
        for _ in 0..6 * rate {
            world.body_mut(ball).unwrap().apply_torque(3.0 * inertia);
            world.step(1.0 / rate as f32);
        }
        let body = world.body(ball).unwrap();
        assert!(
            (body.velocity().y + 2.0).abs() < 0.01,
            "{rate}, {substeps}: {:?}",
            body.velocity()
        );
        let spin = body.angular_velocity();
        assert!((spin - 1.5).abs() < 0.01, "{rate}, {substeps}: {spin}");
    }
}
