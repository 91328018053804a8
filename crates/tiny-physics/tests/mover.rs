//! The character mover: the example level at three step rates, and what it must do by numbers.

#[path = "../examples/mover/level.rs"]
mod level;

use level::{END, Level};
use tiny_physics::{
    CharacterMover, DVec2, MoverInput, RigidBody, Shape, ShapeDef, TileGrid, Vec2, World,
};

const FLOOR: f64 = 0.91; // Half the height and the skin.

/// Places at whole seconds, and the last one.
fn run(hertz: u32) -> Vec<DVec2> {
    let mut level = Level::new().unwrap();
    let dt = 1.0 / hertz as f32;
    let mut places = Vec::new();
    for step in 0..(END as u32 * hertz) {
        level.time = step as f32 * dt;
        let input = level.scripted_input(dt);
        level.step(input, dt);
        if (step + 1) % hertz == 0 {
            places.push(level.hero.position);
        }
    }
    level.world.validate().unwrap();
    let crate_ = level.world.body(level.crate_).unwrap().position();
    assert!((crate_.x - 62.6).abs() < 0.02, "the crate is at the wall: {crate_:?}");
    places
}

#[test]
fn the_run_ends_at_the_same_place_at_every_rate() {
    let runs = [30, 60, 120].map(run);
    for (second, place) in runs[1].iter().enumerate() {
        println!("{:2} s  {:?} {:?} {:?}", second + 1, runs[0][second], place, runs[2][second]);
    }
    let at = |seconds: usize| runs[1][seconds - 1];
    assert!((at(7).x - 28.0).abs() < 0.01, "over hills and stairs: {:?}", at(7));
    assert!((at(8).y - 5.0 - FLOOR).abs() < 0.01, "on the one-way platform: {:?}", at(8));
    assert!((at(13).y - 4.2 - FLOOR).abs() < 0.02, "up on the lift: {:?}", at(13));
    assert!((at(23).x - 46.0).abs() < 0.02, "over the pit: {:?}", at(23));
    assert!((at(40).x - 57.89).abs() < 0.02, "back from the wall: {:?}", at(40));
    for run in [&runs[0], &runs[2]] {
        let apart = (*run.last().unwrap()).relative_to(*runs[1].last().unwrap()).length();
        assert!(apart < 0.01, "the ends are {apart} m apart");
    }
}

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

#[test]
fn pushing_is_bounded_by_force() {
    let dt = 1.0 / 60.0;
    let push = |mass: f32| {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let floor = Shape::rect(40.0, 0.5).unwrap();
        world.add_body(RigidBody::fixed().position(Vec2::new(0.0, -0.5)).shape(floor)).unwrap();
        let shape = ShapeDef::new(Shape::rect(0.5, 0.5).unwrap()).friction(0.5);
        let body = RigidBody::dynamic().position(Vec2::new(2.0, 0.5)).shape(shape).mass(mass);
        let body = world.add_body(body.lock_rotation()).unwrap();
        let mut mover = CharacterMover::new(Vec2::new(0.0, 1.0), 1.8, 0.3);
        for _ in 0..180 {
            world.step(dt);
            let input = MoverInput { walk: 2.0, ..MoverInput::default() };
            mover.update(&mut world, input, dt);
        }
        world.body(body).unwrap().position().x - 2.0
    };
    let (light, heavy) = (push(20.0), push(400.0));
    assert!(light > 1.5, "a light crate moves: {light}");
    assert!(heavy.abs() < 0.02, "a heavy one does not: {heavy}");
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
}
