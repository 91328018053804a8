//! The character mover: what it must do by numbers. The tests of the scenes have its level.

use tiny_physics::{
    BodyId, ChainDef, CharacterMover, JointDef, MoverInput, RigidBody, Shape, ShapeDef, TileGrid,
    Vec2, World,
};

const FLOOR: f64 = 0.91; // Half the height and the skin.

fn settle(world: &mut World, mover: &mut CharacterMover, steps: u32, dt: f32) {
    for _ in 0..steps {
        world.step(dt);
        mover.update(world, MoverInput::default(), dt);
    }
}

#[test]
fn it_stands_still_on_slopes_and_moves_exactly_with_platforms() {
    let dt = 1.0 / 60.0;
    let mut world = World::new(Vec2::new(0.0, -10.0));
    world.add_tiles(TileGrid::parse(1.0, &["....", ".lh.", "####"]).unwrap()).unwrap();
    let mut mover = CharacterMover::new(Vec2::new(2.0, 3.0), 1.8, 0.3);
    settle(&mut world, &mut mover, 120, dt);
    let before = mover.position;
    settle(&mut world, &mut mover, 600, dt);
    assert!(mover.ground().is_some());
    assert!(mover.position.relative_to(before).length() < 1.0e-4);

    for (velocity, turn) in
        [(Vec2::new(0.7, 1.3), 0.0), (Vec2::new(-2.0, -1.0), 0.0), (Vec2::ZERO, 0.3)]
    {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let shape = Shape::rect(3.0, 0.2).unwrap();
        let platform = world.add_body(RigidBody::kinematic().shape(shape)).unwrap();
        let mut mover = CharacterMover::new(Vec2::new(0.5, 2.0), 1.8, 0.3);
        settle(&mut world, &mut mover, 60, dt);
        let mut body = world.body_mut(platform).unwrap();
        body.set_velocity(velocity);
        body.set_angular_velocity(turn);
        let foot = |world: &World, mover: &CharacterMover| {
            let pose = world.body(platform).unwrap().pose();
            pose.unapply(mover.ground().unwrap().point)
        };
        settle(&mut world, &mut mover, 2, dt);
        let mut last = foot(&world, &mover);
        for _ in 0..120 {
            settle(&mut world, &mut mover, 1, dt);
            let now = foot(&world, &mover);
            let slip = now - last;
            last = now;
            // A round foot rolls on a plate that turns: radius * 0.3 rad/s / 60.
            let most = if turn == 0.0 { 1.0e-4 } else { 0.002 };
            assert!(slip.length() < most, "{velocity:?} {turn}: {slip:?}");
        }
    }
}

#[test]
fn steep_slopes_and_high_steps_stop_it() {
    let dt = 1.0 / 60.0;
    let walk = MoverInput { walk: 3.0, ..MoverInput::default() };
    for (height, climbs) in [(0.3, true), (0.5, false)] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let floor = Shape::rect(20.0, 0.5).unwrap();
        world.add_body(RigidBody::fixed().position(Vec2::new(0.0, -0.5)).shape(floor)).unwrap();
        let step = Shape::rect(4.0, 0.5 * height).unwrap();
        let step = ShapeDef::new(step).offset(Vec2::new(6.0, 0.5 * height));
        world.add_body(RigidBody::fixed().shape(step)).unwrap();
        let mut mover = CharacterMover::new(Vec2::new(0.0, 1.0), 1.8, 0.3);
        for _ in 0..120 {
            world.step(dt);
            mover.update(&mut world, walk, dt);
        }
        assert_eq!(mover.position.x > 5.0, climbs, "{height}: {:?}", mover.position);
        let lift = if climbs { f64::from(height) } else { 0.0 };
        assert!((mover.position.y - FLOOR - lift).abs() < 0.002, "{:?}", mover.position);
    }
    for (max_slope, climbs) in [(0.9, true), (0.7, false)] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let rows = ["......../#", "......./##", "....../###", "##########"];
        world.add_tiles(TileGrid::parse(1.0, &rows).unwrap()).unwrap();
        let mut mover = CharacterMover::new(Vec2::new(2.0, 2.0), 1.8, 0.3);
        mover.max_slope = max_slope;
        for _ in 0..120 {
            world.step(dt);
            mover.update(&mut world, walk, dt);
        }
        assert_eq!(mover.position.y > 2.5, climbs, "{max_slope}: {:?}", mover.position);
    }
}

/// Where the character and a crate that stood at 2 m are after pushing for 2 s.
fn push(mass: f32, hertz: u32) -> (f64, f64) {
    let dt = 1.0 / hertz as f32;
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let floor = RigidBody::fixed().position(Vec2::new(0.0, -0.5));
    world.add_body(floor.shape(Shape::rect(40.0, 0.5).unwrap()).friction(0.5)).unwrap();
    let shape = ShapeDef::new(Shape::rect(0.5, 0.5).unwrap()).friction(0.5);
    let body = RigidBody::dynamic().position(Vec2::new(2.0, 0.5)).shape(shape).mass(mass);
    let body = world.add_body(body.lock_rotation()).unwrap();
    let mut mover = CharacterMover::new(Vec2::new(0.0, 1.0), 1.8, 0.3);
    for _ in 0..3 * hertz {
        world.step(dt);
        let input = MoverInput { walk: 2.0, ..MoverInput::default() };
        mover.update(&mut world, input, dt);
    }
    (mover.position.x, world.body(body).unwrap().position_f64().x)
}

#[test]
fn pushing_is_bounded_by_force() {
    let (light, heavy) = (push(20.0, 60).1, push(400.0, 60).1);
    assert!(light > 6.6, "a light crate moves: {light}");
    assert!((heavy - 2.0).abs() < 0.02, "a heavy one does not: {heavy}");
}

#[test]
fn pushing_does_not_depend_on_the_step() {
    // Where 500 N of push and half the weight of friction bring a crate to 2 m/s, it falls back by v^2 / 2a.
    for mass in [20.0, 70.0] {
        let [slow, usual, fast] = [30, 60, 120].map(|hertz| push(mass, hertz));
        let places = format!("{mass} kg: {slow:?} {usual:?} {fast:?}");
        for other in [slow, fast] {
            let (hero, body) = ((usual.0 - other.0).abs(), (usual.1 - other.1).abs());
            assert!(hero < 0.01 && body < 0.01, "{places}");
        }
        let acceleration = (500.0 - 0.5 * f64::from(mass) * 10.0) / f64::from(mass);
        let expected = 6.0 - 4.0 / (2.0 * acceleration);
        assert!((usual.0 - expected).abs() < 0.02, "{places}, expected {expected}");
    }
}

/// Walls that come at 5 to 123 m/s from both sides, and bars that turn: from 25 m/s on walls went past it.
#[test]
fn no_machine_goes_past_it() {
    let dt = 1.0 / 60.0;
    for i in 0..60 {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let floor = RigidBody::fixed().position(Vec2::new(0.0, -1.0));
        world.add_body(floor.shape(Shape::rect(500.0, 1.0).unwrap())).unwrap();
        let mut mover = CharacterMover::new(Vec2::new(0.0, FLOOR as f32), 1.8, 0.3);
        let side = if i % 2 == 0 { 1.0 } else { -1.0 };
        let speed = 5.0 + 2.0 * i as f32;
        let start = Vec2::new(-side * (2.0 + speed * dt * (i % 7) as f32 / 7.0), 1.0);
        let wall = RigidBody::kinematic().position(start).velocity(Vec2::new(side * speed, 0.0));
        let half = Vec2::new(0.05 + 0.01 * (i % 5) as f32, 0.9 - 0.1 * (i % 4) as f32);
        let wall = world.add_body(wall.shape(Shape::rect(half.x, half.y).unwrap())).unwrap();
        for step in 0..60 {
            settle(&mut world, &mut mover, 1, dt);
            let x = world.body(wall).unwrap().position_f64().x;
            let ahead = (mover.position.x - x) * f64::from(side);
            assert!(ahead > 0.3, "wall at {speed} m/s, step {step}: {ahead} m before it");
        }
    }
    for i in 0..30 {
        let mut world = World::new(Vec2::ZERO);
        let mut mover = CharacterMover::new(Vec2::new(3.0, 0.0), 1.0, 0.3);
        let bar =
            RigidBody::kinematic().angle(-0.5 - 0.03 * i as f32).angular_velocity(5.0 + i as f32);
        let bar = world.add_body(bar.shape(Shape::rect(6.0, 0.05).unwrap())).unwrap();
        for step in 0..20 {
            settle(&mut world, &mut mover, 1, dt);
            let place = world.body(bar).unwrap().pose().unapply(mover.position);
            let away = place.x.abs() > 5.0;
            assert!(away || place.y > 0.0, "bar at {} rad/s, step {step}: {place:?}", 5 + i);
            if away {
                break;
            }
        }
    }
}

#[test]
fn bad_numbers_change_nothing() {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let mut mover = CharacterMover::new(Vec2::new(0.0, 1.0), 1.8, 0.3);
    let before = mover.clone();
    let input = MoverInput { walk: f32::NAN, ..MoverInput::default() };
    mover.update(&mut world, input, 1.0 / 60.0);
    mover.update(&mut world, MoverInput::default(), 0.0);
    mover.update(&mut world, MoverInput::default(), f32::INFINITY);
    assert_eq!(mover, before);
    // Its own numbers, whoever moves it: it goes through no wall.
    let wall =
        RigidBody::fixed().position(Vec2::new(2.0, 1.0)).shape(Shape::rect(0.5, 5.0).unwrap());
    world.add_body(wall).unwrap();
    world.step(1.0 / 60.0);
    let spoil: [fn(&mut CharacterMover); 4] = [
        |mover| mover.radius = f32::NAN,
        |mover| mover.skin = f32::NAN,
        |mover| mover.height = f32::INFINITY,
        |mover| mover.max_slope = f32::NAN,
    ];
    for (i, spoil) in spoil.into_iter().enumerate() {
        let mut mover = before.clone();
        spoil(&mut mover);
        assert_eq!(mover.move_by(&world, (4.0, 0.0)), Vec2::ZERO, "{i}");
        mover.update(&mut world, MoverInput { walk: 5.0, ..MoverInput::default() }, 1.0);
        assert_eq!(mover.position, before.position, "{i}");
    }
    let mut mover = before.clone();
    for height in [-1.0, 0.0, 0.2, 0.59] {
        assert!(!mover.resize(&world, height, 0.3), "a capsule of radius 0.3 and height {height}");
    }
    assert!(mover.resize(&world, 0.6, 0.3));
}

/// Walks to the right, and says how far it came.
fn walked(world: &mut World, speed: f32, steps: u32, dt: f32) -> f64 {
    let mut mover = CharacterMover::new(Vec2::new(0.0, 0.91), 1.8, 0.2);
    for _ in 0..steps {
        world.step(dt);
        mover.update(world, MoverInput { walk: speed, ..MoverInput::default() }, dt);
    }
    mover.position.x
}

#[test]
fn however_slow_it_climbs_steps() {
    for speed in [0.1, 0.3, 0.5, 1.0] {
        for hertz in [30.0, 60.0, 144.0] {
            let mut world = World::new(Vec2::new(0.0, -10.0));
            let step = Shape::rect(4.0, 0.65).unwrap();
            let step = ShapeDef::new(step).offset(Vec2::new(5.0, -0.35));
            let floor = ShapeDef::new(Shape::rect(2.0, 0.5).unwrap()).offset(Vec2::new(0.0, -0.5));
            world.add_body(RigidBody::fixed().shape(floor).shape(step)).unwrap();
            let x = walked(&mut world, speed, (2.0 / speed * hertz) as u32, 1.0 / hertz);
            assert!(x > 1.9 && x < 2.1, "{speed} {hertz}: {x}");
        }
    }
}

#[test]
fn corners_of_chains_do_not_hold_it() {
    // Nearly level ground, with many corners that turn it by no more than a fifteenth of a degree.
    let ground = |k: i32| Vec2::new(30.0 - 0.037 * k as f32, 0.0004 * ((k * k) % 7) as f32 / 7.0);
    let points: Vec<Vec2> = (0..900).map(ground).collect();
    for speed in [0.7, 2.3, 7.9] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        world.add_body(RigidBody::fixed().chain(&ChainDef::open(&points)).unwrap()).unwrap();
        let x = walked(&mut world, speed, (28.0 / speed * 120.0) as u32, 1.0 / 120.0);
        assert!(x > 27.9, "{speed}: {x}");
    }
}

#[test]
fn one_way_lifts_pick_it_up() {
    for k in 0..40 {
        let (k, dt) = (k as f32, if k % 2 == 0 { 1.0 / 60.0 } else { 1.0 / 30.0 });
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let plank = ShapeDef::new(Shape::rect(3.0, 0.03).unwrap()).one_way(Vec2::Y);
        let lift = world.add_body(RigidBody::kinematic().shape(plank)).unwrap();
        let speed = if k < 20.0 { 0.2 * k } else { 1.0 - 0.2 * k };
        world.body_mut(lift).unwrap().set_velocity(Vec2::new(0.3, speed));
        let mut mover = CharacterMover::new(Vec2::new(0.0, 1.5 + 0.013 * k), 1.8, 0.3);
        settle(&mut world, &mut mover, 120, dt);
        let above = mover.position.y - world.body(lift).unwrap().position_f64().y;
        assert!((above - 0.94).abs() < 0.001, "{speed}: {above}");
    }
}

#[test]
fn no_machine_pushes_it_through_a_wall() {
    let dt = 1.0 / 60.0;
    for k in 1..40 {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let floor = ShapeDef::new(Shape::rect(20.0, 0.5).unwrap()).offset(Vec2::new(0.0, -0.5));
        let wall = ShapeDef::new(Shape::rect(0.05, 5.0).unwrap()).offset(Vec2::new(2.0, 5.0));
        world.add_body(RigidBody::fixed().shape(floor).shape(wall)).unwrap();
        let machine = RigidBody::kinematic().position(Vec2::new(-0.5, 2.0));
        let machine = machine.velocity(Vec2::new(0.25 * k as f32, 0.0));
        world.add_body(machine.shape(Shape::rect(0.5, 1.9).unwrap())).unwrap();
        let mut mover = CharacterMover::new(Vec2::new(1.0, 0.91), 1.8, 0.3);
        for _ in 0..120 {
            settle(&mut world, &mut mover, 1, dt);
            assert!(mover.position.x < 1.95, "{k}: {}", mover.position.x);
        }
    }
}

/// Without a bound the push is what it takes.
#[test]
fn an_unbounded_push_moves_what_it_meets() {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let ground =
        RigidBody::fixed().position(Vec2::new(0.0, -1.0)).shape(Shape::rect(50.0, 1.0).unwrap());
    world.add_body(ground).unwrap();
    let crate_ =
        RigidBody::dynamic().position(Vec2::new(2.0, 0.5)).shape(Shape::rect(0.5, 0.5).unwrap());
    let crate_ = world.add_body(crate_.mass(1.0)).unwrap();
    let mut hero = CharacterMover::new(Vec2::new(0.0, 0.95), 1.8, 0.3);
    hero.push_force = f32::INFINITY;
    for _ in 0..120 {
        world.step(1.0 / 60.0);
        hero.update(&mut world, MoverInput { walk: 3.0, ..MoverInput::default() }, 1.0 / 60.0);
    }
    assert!(
        world.body(crate_).unwrap().position().x > 4.0,
        "{:?}",
        world.body(crate_).unwrap().position()
    );
    assert_eq!(world.stats().refused_numbers, 0);
}

/// A wall is no floor, however steep a slope may be.
#[test]
fn a_slope_of_any_angle_leaves_walls_walls() {
    for slope in [1.5, core::f32::consts::FRAC_PI_2, 3.0, -1.0] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let boxes = [(0.0, -1.0, 50.0, 1.0), (3.0, 5.0, 1.0, 5.0)];
        for (x, y, hx, hy) in boxes {
            let body =
                RigidBody::fixed().position(Vec2::new(x, y)).shape(Shape::rect(hx, hy).unwrap());
            world.add_body(body).unwrap();
        }
        let mut hero = CharacterMover::new(Vec2::new(0.0, 0.95), 1.8, 0.3);
        hero.max_slope = slope;
        for step in 0..240 {
            world.step(1.0 / 60.0);
            let jump = if step == 100 { 5.0 } else { 0.0 };
            hero.update(
                &mut world,
                MoverInput { walk: 3.0, jump, ..MoverInput::default() },
                1.0 / 60.0,
            );
            assert!(hero.position.is_finite(), "{slope}");
        }
        assert!(hero.position.y < 1.2 && hero.position.x < 2.0, "{slope}: {:?}", hero.position);
    }
}

fn slope(world: &mut World, corners: &[(f32, f32)]) {
    let hull: Vec<_> = corners.iter().map(|&(x, y)| Vec2::new(x, y)).collect();
    world.add_body(RigidBody::fixed().shape(Shape::hull(&hull).unwrap())).unwrap();
}

/// Jumped against and walked into, a slope that is too steep is a wall: it carried up who did, by 11 m/s at 80 degrees.
#[test]
fn steep_slopes_are_not_climbed_from_the_air() {
    let dt = 1.0 / 60.0;
    for (run, rise) in [(2.0, 5.1), (0.9, 5.1), (3.5, 5.1), (0.3, 5.1), (-2.0, 5.1), (-0.6, 3.0)] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let floor = RigidBody::fixed().position(Vec2::new(0.0, -0.5));
        world.add_body(floor.shape(Shape::rect(20.0, 0.5).unwrap())).unwrap();
        let foot = 2.0_f32.copysign(run);
        slope(&mut world, &[(foot, 0.0), (foot + run, rise), (foot + run, 0.0)]);
        let mut mover = CharacterMover::new(Vec2::new(0.0, 0.91), 1.8, 0.3);
        for i in 0..240 {
            world.step(dt);
            let jump = if i % 60 == 20 { 5.0 } else { 0.0 };
            let walk = 3.0_f32.copysign(run);
            mover.update(&mut world, MoverInput { walk, jump, ..MoverInput::default() }, dt);
            assert!(mover.position.y < 0.91 + 1.3, "{run}: {} in step {i}", mover.position);
        }
    }
}

/// It slides down by its weight, at any rate of frames alike: it crept, the slower the more frames there were.
#[test]
fn steep_slopes_are_slid_down() {
    for hertz in [30, 60, 120] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        slope(&mut world, &[(0.0, 0.0), (8.0, 20.4), (8.0, 0.0)]);
        let mut mover = CharacterMover::new(Vec2::new(6.0, 17.0), 1.8, 0.3);
        settle(&mut world, &mut mover, hertz / 2, 1.0 / hertz as f32);
        let before = mover.position;
        settle(&mut world, &mut mover, hertz / 2, 1.0 / hertz as f32);
        let way = mover.position.relative_to(before);
        assert!((way.x / way.y - 8.0 / 20.4).abs() < 0.01, "{hertz}: {way:?}");
        // 9.3 m/s^2 along it, from when it met it.
        assert!((2.0..4.0).contains(&way.length()), "{hertz}: {way:?}");
    }
}

/// What is drawn follows updates, not what the game has set since.
#[test]
fn teleports_and_other_sizes_are_not_drawn_as_motion() {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    world.add_body(RigidBody::fixed().shape(Shape::rect(200.0, 0.5).unwrap())).unwrap();
    let mut mover = CharacterMover::new(Vec2::new(0.0, 1.5), 1.8, 0.3);
    settle(&mut world, &mut mover, 60, 1.0 / 60.0);
    assert!(mover.resize(&world, 1.0, 0.3));
    let drawn = mover.interpolated_position(0.0);
    assert!((drawn.y - mover.position.y).abs() < 0.01, "{drawn} and {}", mover.position);
    mover.position.x = 100.0;
    assert_eq!(mover.interpolated_position(0.5), mover.position);
    settle(&mut world, &mut mover, 1, 1.0 / 60.0);
    assert!((mover.interpolated_position(0.5).x - 100.0).abs() < 1.0e-3);
}

/// A direction is a direction, however long.
#[test]
fn one_way_platforms_hold_it_whatever_the_length_of_their_direction() {
    for length in [0.25, 1.0, 10.0] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let plank = ShapeDef::new(Shape::rect(3.0, 0.1).unwrap()).one_way(Vec2::Y * length);
        world.add_body(RigidBody::fixed().shape(plank)).unwrap();
        let mut mover = CharacterMover::new(Vec2::new(0.0, 1.5), 1.8, 0.3);
        settle(&mut world, &mut mover, 60, 1.0 / 60.0);
        assert!((mover.position.y - 1.01).abs() < 0.01, "{length}: {}", mover.position);
    }
}

/// Who comes through a chain from behind comes out of it by himself: nothing throws him up.
#[test]
fn chains_let_it_through_from_behind() {
    for dt in [1.0 / 30.0, 1.0 / 60.0, 1.0 / 144.0] {
        for k in 0..20 {
            let speed = 6.0 + 0.23 * k as f32;
            let mut world = World::new(Vec2::new(0.0, -10.0));
            let floor = RigidBody::fixed().position(Vec2::new(0.0, -1.0));
            world.add_body(floor.shape(Shape::rect(20.0, 1.0).unwrap())).unwrap();
            let chain = ChainDef::open(&[Vec2::new(5.0, 2.0), Vec2::new(-5.0, 2.0)]);
            world.add_body(RigidBody::fixed().chain(&chain).unwrap()).unwrap();
            let mut mover = CharacterMover::new(Vec2::new(0.0, 0.91), 1.8, 0.3);
            settle(&mut world, &mut mover, 5, dt);
            for step in 0..(3.0 / dt) as u32 {
                let before = mover.position.y;
                world.step(dt);
                let jump = if step == 0 { speed } else { 0.0 };
                mover.update(&mut world, MoverInput { jump, ..MoverInput::default() }, dt);
                // Out of the last bit he is helped.
                let most = f64::from((speed * dt).max(0.09)) + 1.0e-3;
                let rise = mover.position.y - before;
                assert!(rise < most, "{dt} {speed}: rises by {rise} in step {step}");
            }
            let top = 0.05 * speed * speed + 0.01;
            if (top - 2.0).abs() > 0.1 {
                let stands = if top > 2.0 { 2.0 + FLOOR } else { FLOOR };
                assert!(
                    (mover.position.y - stands).abs() < 0.01,
                    "{dt} {speed}: {}",
                    mover.position
                );
            }
        }
    }
}

/// What stands on a chain, or is put a little into it, is held by it.
#[test]
fn chains_hold_it_from_before() {
    for depth in [-0.05, 0.0, 0.004, 0.02, 0.07] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let chain = ChainDef::open(&[Vec2::new(5.0, 2.0), Vec2::new(-5.0, 2.0)]);
        world.add_body(RigidBody::fixed().chain(&chain).unwrap()).unwrap();
        let mut mover = CharacterMover::new(Vec2::new(0.0, 2.9 - depth), 1.8, 0.3);
        settle(&mut world, &mut mover, 30, 1.0 / 60.0);
        assert!((mover.position.y - 2.91).abs() < 0.01, "{depth}: {}", mover.position);
    }
}

/// A lift that drops away leaves it behind, or does not, at any step length.
#[test]
fn lifts_drop_away_at_any_step_length() {
    for (speed, falls) in [(10.0_f32, true), (8.0, true), (4.0, false), (1.0, false)] {
        let fell = [30.0, 60.0, 240.0, 600.0].map(|hertz: f32| {
            let mut world = World::new(Vec2::new(0.0, -10.0));
            let lift = RigidBody::kinematic().shape(Shape::rect(2.0, 0.5).unwrap());
            let lift = world.add_body(lift).unwrap();
            let mut mover = CharacterMover::new(Vec2::new(0.0, 1.41), 1.8, 0.3);
            settle(&mut world, &mut mover, 10, 1.0 / hertz);
            world.body_mut(lift).unwrap().set_velocity(Vec2::new(0.0, -speed));
            settle(&mut world, &mut mover, (0.1 * hertz) as u32, 1.0 / hertz);
            1.41 - mover.position.y
        });
        let expected = if falls { 0.05 } else { 0.1 * f64::from(speed) };
        for fell in fell {
            assert!((fell - expected).abs() < 0.03, "{speed} m/s: {fell} in place of {expected}");
        }
    }
}

/// What is moved by hand for long keeps no endless list of what stopped it.
#[test]
fn it_remembers_no_more_than_it_can() {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    world.add_body(RigidBody::fixed().shape(Shape::rect(20.0, 0.5).unwrap())).unwrap();
    let mut mover = CharacterMover::new(Vec2::new(0.0, 1.5), 1.8, 0.3);
    for _ in 0..5000 {
        mover.move_by(&world, (0.001, -0.1));
    }
    assert!(mover.ground().is_some() && (1..100).contains(&mover.hits().len()));
}

/// A floor and a one-way ramp on it, which begins at x = 2; `sunk` so far that its upper side begins at the floor.
fn ramp(angle: f32, thick: f32, sunk: bool) -> World {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let floor = RigidBody::fixed().position(Vec2::new(0.0, -1.0));
    world.add_body(floor.shape(Shape::rect(20.0, 1.0).unwrap())).unwrap();
    let (along, up) = (Vec2::new(angle.cos(), angle.sin()), Vec2::new(-angle.sin(), angle.cos()));
    let middle =
        Vec2::new(2.0, 0.0) + along * 2.0 + up * if sunk { -0.5 * thick } else { 0.5 * thick };
    let form = if thick == 0.0 {
        Shape::segment(Vec2::X * -2.0, Vec2::X * 2.0).unwrap()
    } else {
        Shape::rect(2.0, 0.5 * thick).unwrap()
    };
    let form = ShapeDef::new(form).one_way(Vec2::Y);
    world.add_body(RigidBody::fixed().position(middle).angle(angle).shape(form)).unwrap();
    world
}

/// One-way ramps carry it up from their low ends and down again, however thick and steep they are and however fast it
/// comes.
#[test]
fn one_way_ramps_are_walked_up_and_down() {
    let forms = [0.0, 0.1, 0.3].map(|thick| [(thick, false), (thick, true)]).concat();
    let ways = [1.0, 3.0, 6.0].map(|speed| [30.0, 60.0, 144.0].map(|hertz| (speed, hertz)));
    for (degrees, (thick, sunk)) in
        [20.0_f32, 32.0, 45.0].iter().flat_map(|degrees| forms.iter().map(move |f| (degrees, f)))
    {
        for &(speed, hertz) in ways.iter().flatten() {
            let mut world = ramp(degrees.to_radians(), *thick, *sunk);
            let mut mover = CharacterMover::new(Vec2::new(0.0, 0.91), 1.8, 0.3);
            for (walk, end) in [(speed, 4.0), (-speed, 0.0)] {
                let name = format!("{degrees} degrees, {thick} m, {sunk}, {walk} m/s, {hertz} Hz");
                let mut left = (9.0 / speed * hertz) as u32;
                while (end - mover.position.x) * f64::from(walk) > 0.0 {
                    world.step(1.0 / hertz);
                    let input = MoverInput { walk, ..MoverInput::default() };
                    mover.update(&mut world, input, 1.0 / hertz);
                    let rise = (mover.position.x - 2.0) * f64::from(degrees.to_radians().tan());
                    assert!(mover.position.y >= 0.9 + rise.max(0.0), "{name}: {}", mover.position);
                    left = left.checked_sub(1).unwrap_or_else(|| panic!("{name}: held"));
                }
            }
        }
    }
}

/// Piles of default crates and bridges of default planks, some hundredth of its mass, bear it: it threw them, at up to
/// 50 m/s, and itself.
#[test]
fn light_things_bear_it() {
    for hertz in [60.0, 120.0] {
        for (half, count) in [0.25, 0.5].iter().flat_map(|h| [1, 2, 3, 5, 8].map(|n| (*h, n))) {
            let mut world = World::new(Vec2::new(0.0, -10.0));
            let floor = RigidBody::fixed().position(Vec2::new(0.0, -1.0));
            world.add_body(floor.shape(Shape::rect(50.0, 1.0).unwrap())).unwrap();
            let mut all = Vec::new();
            for i in 0..count {
                let place = Vec2::new(0.0, half * (1 + 2 * i) as f32);
                let crate_ = RigidBody::dynamic().position(place);
                all.push(world.add_body(crate_.shape(Shape::rect(half, half).unwrap())).unwrap());
            }
            let top = 2.0 * half * count as f32;
            let mut mover = CharacterMover::new(Vec2::new(0.0, top + 0.95), 1.8, 0.3);
            for _ in 0..(4.0 * hertz) as u32 {
                settle(&mut world, &mut mover, 1, 1.0 / hertz);
                let fastest = all.iter().map(|id| world.body(*id).unwrap().velocity().length());
                let fastest = fastest.fold(0.0, f32::max);
                assert!(fastest < 0.6, "{count} of {half} m, {hertz} Hz: {fastest} m/s");
            }
            let above = mover.position.y - f64::from(top);
            assert!((above - FLOOR).abs() < 0.02, "{count} of {half} m: {above}");
        }
        for density in [1.0, 5.0, 30.0] {
            let (mut world, planks) = bridge(density);
            let mut mover = CharacterMover::new(Vec2::new(-4.5, 1.2), 1.8, 0.3);
            settle(&mut world, &mut mover, hertz as u32, 1.0 / hertz);
            let mut left = (6.0 * hertz) as u32;
            while mover.position.x < 5.0 {
                world.step(1.0 / hertz);
                let input = MoverInput { walk: 2.0, ..MoverInput::default() };
                mover.update(&mut world, input, 1.0 / hertz);
                let fastest = planks.iter().map(|id| world.body(*id).unwrap().velocity().length());
                let fastest = fastest.fold(0.0, f32::max);
                let stands = mover.ground().is_some();
                assert!(fastest < 2.0 && stands, "{density} kg/m2: {fastest} m/s, {stands}");
                left = left.checked_sub(1).unwrap_or_else(|| panic!("{density}: held"));
            }
        }
    }
}

/// Eight planks hinged to each other and to blocks that are fixed.
fn bridge(density: f32) -> (World, Vec<BodyId>) {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let block = |x: f32| {
        RigidBody::fixed().position(Vec2::new(x, 0.0)).shape(Shape::rect(1.0, 0.2).unwrap())
    };
    let mut last = world.add_body(block(-4.0)).unwrap();
    let (mut at, mut planks) = (Vec2::new(1.0, 0.2), Vec::new());
    for i in 0..8 {
        let plank = ShapeDef::new(Shape::rect(0.38, 0.1).unwrap()).density(density);
        let place = Vec2::new(-2.6 + 0.8 * i as f32, 0.1);
        let plank = world.add_body(RigidBody::dynamic().position(place).shape(plank)).unwrap();
        let hinge = JointDef::revolute().anchors(at, Vec2::new(-0.4, 0.1));
        world.add_joint(last, plank, hinge).unwrap();
        (last, at) = (plank, Vec2::new(0.4, 0.1));
        planks.push(plank);
    }
    let end = world.add_body(block(4.4)).unwrap();
    world.add_joint(last, end, JointDef::revolute().anchors(at, Vec2::new(-1.0, 0.2))).unwrap();
    (world, planks)
}

/// On a light plank it still outweighs what lies on the other end.
#[test]
fn it_lifts_what_lies_on_a_light_seesaw() {
    let dt = 1.0 / 60.0;
    for density in [1.0, 10.0, 100.0] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let floor = RigidBody::fixed().position(Vec2::new(0.0, -1.0));
        world.add_body(floor.shape(Shape::rect(50.0, 1.0).unwrap())).unwrap();
        let post = world.add_body(RigidBody::fixed()).unwrap();
        let plank = ShapeDef::new(Shape::rect(2.0, 0.1).unwrap()).density(density);
        let plank = RigidBody::dynamic().position(Vec2::new(0.0, 0.6)).shape(plank);
        let plank = world.add_body(plank).unwrap();
        let hinge = JointDef::revolute().anchor_at((0.0, 0.6));
        world.add_joint(post, plank, hinge).unwrap();
        let load = RigidBody::dynamic().position(Vec2::new(1.5, 1.0)).mass(20.0);
        let load = world.add_body(load.shape(Shape::rect(0.25, 0.25).unwrap())).unwrap();
        for _ in 0..120 {
            world.step(dt);
        }
        let low = world.body(load).unwrap().position_f64().y;
        let mut mover = CharacterMover::new(Vec2::new(-1.5, 2.1), 1.8, 0.3);
        settle(&mut world, &mut mover, 90, dt);
        let high = world.body(load).unwrap().position_f64().y;
        assert!(high > low + 0.1, "{density} kg/m2: from {low} to {high}");
    }
}

/// It rode off on single balls and on heaps of them, up to 215 m/s: their turning carried it along, and its weight turned
/// them.
#[test]
fn balls_do_not_run_away_with_it() {
    let dt = 1.0 / 60.0;
    let heaps = [(0.2, 1), (0.2, 12), (0.3, 6), (0.1, 30)];
    for (radius, count) in heaps {
        for density in [1.0, 10.0, 100.0, 1000.0] {
            let mut world = World::new(Vec2::new(0.0, -10.0));
            for (x, y, a, b) in [(0.0, -1.0, 100.0, 1.0), (8.0, 2.0, 0.5, 2.0)] {
                let body = RigidBody::fixed().position(Vec2::new(x, y));
                world.add_body(body.shape(Shape::rect(a, b).unwrap())).unwrap();
            }
            let mut all = Vec::new();
            for i in 0..count {
                let (column, row) = ((i / 3) as f32, (i % 3) as f32);
                let place = Vec2::new(2.0 + 2.1 * radius * column, radius * (1.0 + 2.0 * row));
                let ball = ShapeDef::new(Shape::circle(radius).unwrap()).density(density);
                let ball = RigidBody::dynamic().position(place).shape(ball);
                all.push(world.add_body(ball).unwrap());
            }
            let mut mover = CharacterMover::new(Vec2::new(0.0, 0.91), 1.8, 0.3);
            for step in 0..360 {
                world.step(dt);
                let before = mover.position;
                mover.update(&mut world, MoverInput { walk: 3.0, ..MoverInput::default() }, dt);
                let speed = mover.position.relative_to(before).length() / dt;
                let fastest = all.iter().map(|id| world.body(*id).unwrap().velocity().length());
                let fastest = fastest.fold(0.0, f32::max);
                let name = format!("{count} of {radius} m, {density} kg/m2, step {step}");
                assert!(speed < 9.0 && fastest < 13.0, "{name}: {speed} and {fastest} m/s");
                assert!(mover.position.x > -1.0, "{name}: {}", mover.position);
            }
        }
    }
    // Put on top of one it stays there.
    for (radius, density) in [(0.2, 10.0), (0.5, 1.0), (1.0, 1.0), (2.0, 10.0)] {
        for off in 0..9 {
            let mut world = World::new(Vec2::new(0.0, -10.0));
            let floor = RigidBody::fixed().position(Vec2::new(0.0, -1.0));
            world.add_body(floor.shape(Shape::rect(2000.0, 1.0).unwrap())).unwrap();
            let ball = ShapeDef::new(Shape::circle(radius).unwrap()).density(density);
            let ball = RigidBody::dynamic().position(Vec2::new(0.0, radius)).shape(ball);
            let ball = world.add_body(ball).unwrap();
            let place = Vec2::new(-0.1 * radius * off as f32, 2.0 * radius + 0.95);
            let mut mover = CharacterMover::new(place, 1.8, 0.3);
            for _ in 0..360 {
                settle(&mut world, &mut mover, 1, dt);
                let speed = world.body(ball).unwrap().velocity().length();
                assert!(speed < 0.5, "{radius} m, {off}: {speed} m/s");
            }
        }
    }
}

/// Who goes more than a step's depth in an update stood before stairs for ever.
#[test]
fn stairs_are_climbed_at_any_speed() {
    for (rise, tread) in [(0.17, 0.29), (0.2, 0.3), (0.25, 0.3), (0.3, 0.4), (0.33, 0.5)] {
        for hertz in [20.0, 30.0, 60.0, 120.0] {
            for speed in [1.0, 3.0, 5.0, 8.0, 10.0, 15.0, 20.0] {
                let mut world = World::new(Vec2::new(0.0, -10.0));
                let floor = RigidBody::fixed().position(Vec2::new(0.0, -1.0));
                world.add_body(floor.shape(Shape::rect(60.0, 1.0).unwrap())).unwrap();
                for i in 0..10 {
                    let (high, left) = (rise * (i + 1) as f32, 1.0 + tread * i as f32);
                    let step = Shape::rect(0.5 * (30.0 - left), 0.5 * high).unwrap();
                    let place = Vec2::new(0.5 * (left + 30.0), 0.5 * high);
                    world.add_body(RigidBody::fixed().position(place).shape(step)).unwrap();
                }
                let mut mover = CharacterMover::new(Vec2::new(-1.07, 0.92), 1.8, 0.3);
                let goal = f64::from(2.0 + 10.0 * tread);
                let mut left = (2.0 * (goal as f32 + 2.0) / speed * hertz + hertz) as u32;
                while mover.position.x < goal {
                    world.step(1.0 / hertz);
                    let input = MoverInput { walk: speed, ..MoverInput::default() };
                    mover.update(&mut world, input, 1.0 / hertz);
                    let name = format!("steps of {rise} m, {speed} m/s, {hertz} Hz");
                    left = left
                        .checked_sub(1)
                        .unwrap_or_else(|| panic!("{name}: held at {}", mover.position));
                }
            }
        }
    }
}
