//! Characters.

use super::{DT, circle, ground, square, steps};
use tiny_physics::prelude::*;

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

/// A ladder that he caught in his fall, or a ground that he was put on, takes all of the fall.
#[test]
fn a_hero_who_is_moved_by_hand_falls_no_more() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let mut hero = hero(&mut world, (0.0, 20.0));
    go(&mut world, &mut hero, MoverInput::default(), 60);
    assert!(hero.velocity.y < -9.0);
    hero.move_by(&world, (0.0, 0.05));
    assert_eq!((hero.velocity, hero.ground().is_none()), (Vec2::ZERO, true));
    // He lets go of the ladder: his fall begins anew.
    let height = hero.position.y;
    go(&mut world, &mut hero, MoverInput::default(), 12);
    assert!((height - hero.position.y - 0.2).abs() < 0.02, "fell {}", height - hero.position.y);
    // What he was thrown with sideways does not go on where he was taken off it, either.
    hero.launch((5.0, 0.0));
    go(&mut world, &mut hero, MoverInput::default(), 2);
    hero.move_by(&world, (0.0, -30.0));
    assert!(hero.ground().is_some() && hero.velocity == Vec2::ZERO);
    let x = hero.position.x;
    go(&mut world, &mut hero, MoverInput { jump: 3.0, ..MoverInput::default() }, 10);
    assert!(hero.ground().is_none() && hero.position.x == x);
}

/// Whatever else is put on the body that he leads keeps its form.
#[test]
fn a_hero_takes_no_other_sensor_of_his_body_for_his_own() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let mut hero = hero(&mut world, (0.0, 0.91));
    let body = hero.body.unwrap();
    let reach = Shape::circle(3.0).unwrap();
    let view = world.add_shape(body, ShapeDef::new(reach).sensor()).unwrap();
    let own = world.body(body).unwrap().shapes().find(|id| *id != view).unwrap();
    assert!(hero.resize(&world, 1.0, 0.3));
    go(&mut world, &mut hero, MoverInput::default(), 5);
    assert_eq!(*world.shape(view).unwrap().shape(), reach);
    let Shape::Capsule { a, b, .. } = *world.shape(own).unwrap().shape() else { panic!() };
    assert!((b.y - a.y - 0.4).abs() < 1e-5, "his own ducks");
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

#[test]
fn a_hero_who_is_taken_elsewhere_does_not_jump_from_the_air() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let mut hero = CharacterMover::new((0.0, 0.95), 1.8, 0.3);
    let stand = |world: &mut World, hero: &mut CharacterMover, jump: f32| {
        world.step(DT);
        hero.update(world, MoverInput { jump, ..MoverInput::default() }, DT);
    };
    (0..60).for_each(|_| stand(&mut world, &mut hero, 0.0));
    assert!(hero.ground().is_some());
    hero.position.y += 10.0;
    stand(&mut world, &mut hero, 5.0);
    assert!(hero.velocity.y <= 0.0 && hero.position.y < 11.0, "{hero:?}");
    hero.gravity_scale = f32::NAN;
    stand(&mut world, &mut hero, 0.0);
    hero.gravity_scale = 1.0;
    (0..200).for_each(|_| stand(&mut world, &mut hero, 0.0));
    assert!(hero.ground().is_some() && hero.position.is_finite());
}

/// Animation and sound go by how fast a hero goes, not by how fast he would like to.
#[test]
fn a_hero_before_a_wall_stands_still() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let wall = RigidBody::fixed().position((3.0, 1.0)).shape(square(1.0));
    world.add_body(wall).unwrap();
    for (start, way, stops) in [(0.0, 3.0, 1.69), (6.0, -3.0, 4.31)] {
        let mut hero = hero(&mut world, (start, 0.91));
        let (mut before, mut met) = (hero.position.x, false);
        for step in 0..90 {
            go(&mut world, &mut hero, walk(way), 1);
            let went = (hero.position.x - before) as f32 / DT;
            before = hero.position.x;
            let told = hero.velocity.x;
            assert!((told - went).abs() < 0.01, "step {step}: {told} m/s told, {went} gone");
            met |= told == way;
        }
        assert!(met && hero.velocity.x.abs() < 0.01, "{:?}", hero.velocity);
        assert!((hero.position.x - stops).abs() < 0.02, "{}", hero.position.x);
        world.remove_body(hero.body.unwrap()).unwrap();
    }
}

/// Through the platform that he stands on he falls onto the next, however near that is, and from one that goes down or along with it.
#[test]
fn a_hero_drops_through_one_platform() {
    let drop = MoverInput { drop: true, ..MoverInput::default() };
    let mut world = World::new((0.0, -10.0));
    let rows = ["......", ".----.", "......", ".----.", "......", "######"];
    world.add_tiles(TileGrid::parse(1.0, &rows).unwrap()).unwrap();
    let mut one = hero(&mut world, (3.0, 5.91));
    for foot in [5.0, 3.0, 1.0] {
        go(&mut world, &mut one, walk(0.0), 120);
        let height = one.position.y - 0.91;
        assert!((height - foot).abs() < 0.02 && one.ground().is_some(), "{height}, not {foot}");
        go(&mut world, &mut one, drop, 1);
    }

    for velocity in [(0.0, -1.0), (3.0, 0.0), (0.0, 2.0)] {
        let mut world = World::new((0.0, -10.0));
        let lift = ShapeDef::new(Shape::rect(4.0, 0.05).unwrap()).one_way((0.0, 1.0));
        let lift = RigidBody::kinematic().shape(lift).velocity(velocity);
        let lift = world.add_body(lift).unwrap();
        let mut hero = hero(&mut world, (0.0, 0.97));
        go(&mut world, &mut hero, walk(0.0), 30);
        assert!(hero.ground().is_some());
        let start = hero.position.x;
        go(&mut world, &mut hero, drop, 1);
        go(&mut world, &mut hero, walk(0.0), 59);
        let below = world.body(lift).unwrap().position().y as f64 - hero.position.y;
        assert!(below > 1.0, "{velocity:?}: {below}");
        let along = (hero.position.x - start) as f32;
        assert!((along - velocity.0).abs() < 0.1, "{velocity:?}: he keeps its speed, {along}");
    }
}

/// A belt carries him as it carries crates, and off its end he keeps its speed.
#[test]
fn a_hero_rides_on_a_belt() {
    let mut world = World::new((0.0, -10.0));
    let belt = ShapeDef::new(Shape::rect(5.0, 0.5).unwrap()).tangent_speed(2.0);
    world.add_body(RigidBody::fixed().position((0.0, -0.5)).shape(belt)).unwrap();
    let mut hero = hero(&mut world, (-3.0, 0.91));
    go(&mut world, &mut hero, walk(0.0), 120);
    assert!((hero.position.x - 1.0).abs() < 0.1, "{}", hero.position.x);
    go(&mut world, &mut hero, walk(-2.0), 60);
    assert!((hero.position.x - 1.0).abs() < 0.15, "against it he stays: {}", hero.position.x);
    go(&mut world, &mut hero, MoverInput { jump: 4.0, ..walk(0.0) }, 1);
    let start = hero.position.x;
    go(&mut world, &mut hero, walk(0.0), 30);
    assert!((hero.position.x - start - 1.0).abs() < 0.1, "{}", hero.position.x - start);
}

/// What nothing holds up falls as fast with him as without.
#[test]
fn a_hero_does_not_press_down_what_falls() {
    let mut world = World::new((0.0, -10.0));
    let block =
        world.add_body(RigidBody::fixed().position((0.0, 20.0)).shape(square(0.5))).unwrap();
    let load = Shape::rect(0.5, 0.25).unwrap();
    let load = RigidBody::dynamic().position((0.0, 20.75)).shape(load).mass(10.0);
    let load = world.add_body(load).unwrap();
    let mut one = hero(&mut world, (0.0, 21.91));
    go(&mut world, &mut one, walk(0.0), 60);
    world.remove_body(block).unwrap();
    go(&mut world, &mut one, walk(0.0), 30);
    let fell = 20.75 - world.body(load).unwrap().position().y;
    assert!((1.2..2.2).contains(&fell), "{fell} m in half a second");

    // And what is pulled away under him leaves him behind.
    let mut world = World::new((0.0, -10.0));
    let lift = world.add_body(RigidBody::kinematic().shape(square(0.5))).unwrap();
    let mut hero = hero(&mut world, (0.0, 1.41));
    go(&mut world, &mut hero, walk(0.0), 10);
    world.body_mut(lift).unwrap().set_velocity((0.0, -30.0));
    go(&mut world, &mut hero, walk(0.0), 30);
    let fell = 1.41 - hero.position.y;
    assert!((1.1..1.5).contains(&fell), "{fell} m in half a second");
}

/// The velocity is his whole velocity in the air, to be read and to be set.
#[test]
fn a_hero_flies_as_he_is_told() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let mut hero = hero(&mut world, (0.0, 0.91));
    go(&mut world, &mut hero, walk(0.0), 5);
    hero.launch((8.0, 5.0));
    go(&mut world, &mut hero, walk(0.0), 20);
    assert!((hero.velocity.x - 8.0).abs() < 0.01);
    (hero.position, hero.velocity) = (DVec2::new(0.0, 10.0), Vec2::ZERO);
    go(&mut world, &mut hero, walk(0.0), 30);
    assert!(hero.position.x.abs() < 0.01, "he falls straight: {}", hero.position.x);
    let start = hero.position.x;
    for _ in 0..12 {
        hero.velocity.y = 2.0;
        go(&mut world, &mut hero, walk(3.0), 1);
    }
    let went = hero.position.x - start;
    assert!((went - 0.6).abs() < 0.02, "up again and again he walks no faster: {went}");
    go(&mut world, &mut hero, walk(0.0), 1);
    hero.position.x = 0.0;
    hero.velocity = Vec2::new(-6.0, 3.0);
    go(&mut world, &mut hero, walk(0.0), 30);
    assert!((hero.position.x + 3.0).abs() < 0.05, "{}", hero.position.x);
}

/// Between two slopes that are too steep to stand on he stands, and gets out.
#[test]
fn a_hero_gets_out_of_a_notch() {
    for steep in [1.05_f32, 1.2] {
        let mut world = World::new((0.0, -10.0));
        for side in [-1.0, 1.0] {
            let slope = Shape::rect(0.2, 3.0).unwrap();
            let place = Vec2::new(side * 1.5, 2.0);
            let turn = side * (steep - 0.5 * core::f32::consts::PI);
            world.add_body(RigidBody::fixed().position(place).angle(turn).shape(slope)).unwrap();
        }
        let mut hero = hero(&mut world, (0.3, 5.0));
        go(&mut world, &mut hero, walk(0.0), 180);
        let rests = hero.position.y;
        assert!(hero.ground().is_some(), "{steep}: at {rests}");
        go(&mut world, &mut hero, MoverInput { jump: 6.0, ..walk(0.0) }, 1);
        go(&mut world, &mut hero, walk(0.0), 30);
        assert!(hero.position.y > rests + 1.0, "{steep}: {} from {rests}", hero.position.y);
    }
}

/// What he meets in the air feels how fast he comes; a cart that he stands in does not drive itself.
#[test]
fn a_hero_pushes_with_his_own_speed_and_against_what_he_stands_on() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let crate_ = RigidBody::dynamic().position((2.0, 0.5)).shape(square(0.5)).mass(5.0);
    let crate_ = world.add_body(crate_).unwrap();
    let mut one = hero(&mut world, (0.0, 0.91));
    go(&mut world, &mut one, walk(0.0), 5);
    one.launch((10.0, 2.0));
    go(&mut world, &mut one, walk(0.0), 30);
    assert!(world.body(crate_).unwrap().position().x > 2.1);

    let mut world = World::new((0.0, -10.0));
    let ice = ShapeDef::new(Shape::rect(50.0, 1.0).unwrap()).friction(0.0);
    world.add_body(RigidBody::fixed().position((0.0, -1.0)).shape(ice)).unwrap();
    let floor = ShapeDef::new(Shape::rect(2.0, 0.1).unwrap()).friction(0.0).density(100.0);
    let wall = Polygon::turned_rect(0.1, 1.2, Vec2::new(2.0, 1.1), Rot::IDENTITY).unwrap();
    let cart = RigidBody::dynamic().position((0.0, 0.1)).shape(floor).shape(wall);
    let cart = world.add_body(cart).unwrap();
    let mut hero = hero(&mut world, (0.0, 1.11));
    go(&mut world, &mut hero, walk(3.0), 240);
    let speed = world.body(cart).unwrap().velocity().x;
    assert!(speed.abs() < 0.05, "{speed} m/s");
}

/// Off a ledge he goes on as fast as he walked, and says so.
#[test]
fn a_hero_says_how_fast_he_goes_over_a_ledge() {
    let mut world = World::new((0.0, -10.0));
    world.add_body(RigidBody::fixed().shape(square(2.0))).unwrap();
    let mut hero = hero(&mut world, (0.0, 2.91));
    for step in 0..90 {
        go(&mut world, &mut hero, walk(3.0), 1);
        assert!((hero.velocity.x - 3.0).abs() < 0.01, "step {step}: {:?}", hero.velocity);
    }
    assert!(hero.ground().is_none());
}

/// Belts carry him on platforms that move, on slopes, and where the world is upside down or lies on its side.
#[test]
fn a_hero_rides_on_belts_anywhere() {
    for (turn, slope, moves) in
        [(0.0, 0.0, 1.5), (3.0, 0.0, 0.0), (1.2, 0.3, 0.0), (-1.9, -0.4, -0.7)]
    {
        let rot = Rot::from_angle(turn);
        let mut world = World::new(rot.rotate(Vec2::new(0.0, -10.0)));
        let belt = ShapeDef::new(Shape::rect(9.0, 0.5).unwrap()).tangent_speed(1.0);
        let belt = RigidBody::kinematic().angle(turn + slope).shape(belt);
        world.add_body(belt.velocity(rot.rotate(Vec2::new(moves, 0.0)))).unwrap();
        let start = rot.rotate(Vec2::new(0.0, 1.6));
        let mut hero = CharacterMover::new(start, 1.8, 0.3);
        go(&mut world, &mut hero, walk(0.0), 30);
        assert!(hero.ground().is_some(), "{turn}, {slope}");
        let before = hero.position;
        go(&mut world, &mut hero, walk(0.0), 60);
        let went = rot.unrotate(hero.position.relative_to(before));
        let (along, up) = (slope.cos() + moves, slope.sin());
        assert!((went - Vec2::new(along, up)).length() < 0.05, "{turn}, {slope}: {went:?}");
    }
}

/// A steep slope before a wall is a notch as well.
#[test]
fn a_hero_gets_out_from_between_a_slope_and_a_wall() {
    for side in [-1.0, 1.0] {
        let mut world = World::new((0.0, -10.0));
        let wall = Shape::rect(0.2, 5.0).unwrap();
        world.add_body(RigidBody::fixed().position((side * 0.8, 3.0)).shape(wall)).unwrap();
        let slope = RigidBody::fixed().position((-side * 0.6, 1.5)).angle(side as f32 * 0.35);
        world.add_body(slope.shape(Shape::rect(0.2, 4.0).unwrap())).unwrap();
        let mut hero = hero(&mut world, (-side * 0.2, 6.0));
        go(&mut world, &mut hero, walk(0.0), 240);
        let rests = hero.position.y;
        assert!(hero.ground().is_some() && rests > 0.0, "{side}: at {rests}");
        go(&mut world, &mut hero, MoverInput { jump: 6.0, ..walk(0.0) }, 1);
        go(&mut world, &mut hero, walk(0.0), 25);
        assert!(hero.position.y > rests + 1.0, "{side}: {} from {rests}", hero.position.y);
    }
}

/// A lift that wraps round, a vehicle that is put back: as a crate does, he stays and falls.
#[test]
fn a_hero_stays_where_his_platform_is_taken_away() {
    for (x, y) in [(50.0, 0.0), (0.0, 30.0), (-7.0, -5.0)] {
        let mut world = World::new((0.0, -10.0));
        let lift = RigidBody::kinematic().shape(Shape::rect(2.0, 0.5).unwrap());
        let lift = world.add_body(lift.velocity((0.0, 1.0))).unwrap();
        let mut hero = hero(&mut world, (0.0, 1.42));
        go(&mut world, &mut hero, walk(0.0), 60);
        assert!(hero.ground().is_some(), "he stands on the lift");
        let before = hero.position;
        world.body_mut(lift).unwrap().set_position((x, y));
        go(&mut world, &mut hero, walk(0.0), 1);
        let way = hero.position.relative_to(before).length();
        assert!(way < 0.05 && hero.ground().is_none(), "taken along by {way} m to {x}, {y}");
        go(&mut world, &mut hero, walk(0.0), 20);
        assert!(hero.velocity.y < -1.0, "he does not fall");
    }
    // What is as fast takes him along.
    let mut world = World::new((0.0, -10.0));
    let lift = RigidBody::kinematic().shape(Shape::rect(2.0, 0.5).unwrap());
    let lift = world.add_body(lift).unwrap();
    let mut hero = hero(&mut world, (0.0, 1.42));
    go(&mut world, &mut hero, walk(0.0), 10);
    world.body_mut(lift).unwrap().set_velocity((150.0, 0.0));
    go(&mut world, &mut hero, walk(0.0), 30);
    let ahead = world.body(lift).unwrap().position().x - hero.position.x as f32;
    assert!(ahead.abs() < 1.0, "left behind by {ahead} m");
}

/// A chain is solid from outside alone: under it he stands as he walks.
#[test]
fn a_hero_gets_up_under_the_back_of_a_chain() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let house = world.add_body(RigidBody::fixed()).unwrap();
    let roof = ChainDef::open(&[(9.0, 1.4), (-9.0, 1.4)].map(Vec2::from));
    world.add_chain(house, &roof).unwrap();
    let mut hero = hero(&mut world, (0.0, 0.92));
    go(&mut world, &mut hero, walk(2.0), 30);
    assert!(hero.position.x > 0.5 && hero.fits(&world));
    assert!(hero.resize(&world, 1.0, 0.3) && hero.resize(&world, 1.8, 0.3));
    // Seen from outside it is in the way.
    let back = ChainDef::open(&[(-9.0, 1.4), (9.0, 1.4)].map(Vec2::from));
    world.add_chain(house, &back).unwrap();
    assert!(!hero.fits(&world) && hero.resize(&world, 1.0, 0.3));
    assert!(!hero.resize(&world, 1.8, 0.3));
}

/// Where it is so low that his middle would be above it, too.
#[test]
fn a_hero_does_not_get_up_through_a_low_chain() {
    let mut world = World::new((0.0, -10.0));
    ground(&mut world);
    let house = world.add_body(RigidBody::fixed()).unwrap();
    let mut hero = CharacterMover::new((0.0, 0.36), 0.7, 0.3);
    let ceiling = ChainDef::open(&[(-9.0, 0.85), (9.0, 0.85)].map(Vec2::from));
    world.add_chain(house, &ceiling).unwrap();
    assert!(hero.fits(&world), "the ducked hero is under it");
    assert!(!hero.resize(&world, 1.8, 0.3) && !hero.resize(&world, 1.0, 0.3));
    assert!(hero.resize(&world, 0.8, 0.3));
}

/// What falls on a hero beside a wall came to rest in it, asleep, for ever: walls kept the hero from getting out, and nothing was done
/// to the crate.
#[test]
fn what_falls_on_a_hero_by_a_wall_does_not_stay_in_it() {
    for (mass, gap) in [(1.0, 0.01), (5.0, 0.05), (20.0, 0.1), (1.0, 0.2)] {
        let mut world = World::new((0.0, -10.0));
        ground(&mut world);
        let wall =
            RigidBody::fixed().position((0.7 + gap, 5.0)).shape(Shape::rect(0.5, 5.0).unwrap());
        world.add_body(wall).unwrap();
        let mut hero = CharacterMover::new((0.0, 0.41), 0.8, 0.2);
        let crate_ = RigidBody::dynamic().position((-0.4, 1.6)).shape(square(0.4)).mass(mass);
        let crate_ = world.add_body(crate_).unwrap();
        go(&mut world, &mut hero, walk(0.0), 300);
        let apart = hero.position.x - world.body(crate_).unwrap().position_f64().x;
        assert!(apart > 0.59, "{mass} kg, {gap} m from the wall: {apart} m apart");
    }
}
