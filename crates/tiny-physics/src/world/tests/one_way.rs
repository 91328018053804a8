use super::*;
use crate::describe::Locks;

fn add_platform(world: &mut World, kind: BodyKind, height: f32, half_height: f32) -> BodyId {
    let shape = rect(3.0, half_height).one_way(Vec2::Y).events();
    let body = RigidBody { kind, ..RigidBody::default() };
    world.add_body(body.position(Vec2::new(0.0, height)).shape(shape)).unwrap()
}

fn shapes() -> [ShapeDef; 4] {
    let capsule = Shape::capsule(Vec2::new(0.0, -0.3), Vec2::new(0.0, 0.3), 0.3).unwrap();
    let hexagon = Shape::regular(6, 0.5).unwrap();
    [rect(0.4, 0.4), circle(0.4), ShapeDef::new(capsule), ShapeDef::new(hexagon)]
}

#[test]
fn things_land_on_top_at_any_speed() {
    for half_height in [0.02, 0.1, 0.5] {
        for shape in shapes() {
            for speed in [0.0, 5.0, 20.0, 80.0, 300.0] {
                let mut world = world();
                add_platform(&mut world, BodyKind::Static, 0.0, half_height);
                let body = RigidBody::dynamic().position(Vec2::new(0.1, 2.0)).lock_rotation();
                let body = body.shape(shape.clone()).velocity(Vec2::new(0.0, -speed));
                let body = world.add_body(body).unwrap();
                run(&mut world, 120);
                let height = y(&world, body);
                assert!(height > half_height + 0.3, "{half_height} {speed} {shape:?}: {height}");
                assert!(world.body(body).unwrap().velocity().length() < 0.05);
            }
        }
    }
}

#[test]
fn things_rise_through_without_being_touched() {
    for half_height in [0.02, 0.1, 0.5] {
        for shape in shapes() {
            for speed in [11.0, 30.0, 100.0] {
                let mut world = world();
                let mut free = world.clone();
                add_platform(&mut world, BodyKind::Static, 0.0, half_height);
                let body = RigidBody::dynamic().position(Vec2::new(0.3, -2.0)).lock_rotation();
                let body = body.shape(shape.clone()).velocity(Vec2::new(0.0, speed));
                let body_free = free.add_body(body.clone()).unwrap();
                let body = world.add_body(body).unwrap();
                for _ in 0..600 {
                    world.step(DT);
                    free.step(DT);
                    let falls = world.body(body).unwrap().velocity().y < 0.0;
                    if falls {
                        break;
                    }
                    assert_eq!(y(&world, body), y(&free, body_free));
                    assert!(world.events().contact_begin().is_empty());
                }
                // And then it lands.
                run(&mut world, 1500);
                assert!(y(&world, body) > half_height, "{half_height} {speed} {shape:?}");
            }
        }
    }
}

#[test]
fn a_jump_that_ends_inside_falls_back() {
    for shape in shapes() {
        let mut world = world();
        add_platform(&mut world, BodyKind::Static, 0.0, 0.5);
        let body = RigidBody::dynamic().position(Vec2::new(0.3, -2.0)).lock_rotation();
        // Up by 2 m: the middle of the body is in the middle of the platform.
        let body = body.shape(shape).velocity(Vec2::new(0.0, (2.0_f32 * 10.0 * 2.0).sqrt()));
        let body = world.add_body(body).unwrap();
        run(&mut world, 120);
        assert!(y(&world, body) < -3.0);
        assert_eq!(world.contact_count(), 0);
    }
}

#[test]
fn things_pass_from_the_side() {
    let mut world = World::new(Vec2::ZERO);
    add_platform(&mut world, BodyKind::Static, 0.0, 0.3);
    let body = RigidBody::dynamic().position(Vec2::new(-5.0, 0.1)).shape(rect(0.3, 0.3));
    let body = world.add_body(body.velocity(Vec2::new(4.0, 0.0))).unwrap();
    run(&mut world, 180);
    assert!((world.body(body).unwrap().velocity() - Vec2::new(4.0, 0.0)).length() < 1e-6);
}

#[test]
fn a_lift_carries_up_and_down_without_jitter() {
    for shape in shapes() {
        let mut world = world();
        let lift = add_platform(&mut world, BodyKind::Kinematic, 0.0, 0.1);
        let body = RigidBody::dynamic().position(Vec2::new(0.0, 0.9)).lock_rotation().shape(shape);
        let body = world.add_body(body).unwrap();
        run(&mut world, 60);
        let gap = y(&world, body) - y(&world, lift);
        let mut ends = 0;
        for step in 0..480 {
            // Up and down by 1 m with at most 3 m/s^2.
            let t = step as f32 * DT;
            let speed = 1.7 * crate::math::sin(1.7 * t);
            world.body_mut(lift).unwrap().set_velocity(Vec2::new(0.5, speed));
            world.step(DT);
            ends += world.events().contact_end().len();
            let now = y(&world, body) - y(&world, lift);
            assert!((now - gap).abs() < 0.01, "{step}: {now} {gap}");
        }
        assert_eq!(ends, 0);
    }
}

#[test]
fn a_platform_that_comes_up_from_below_picks_things_up() {
    let mut world = world();
    let lift = add_platform(&mut world, BodyKind::Kinematic, -3.0, 0.1);
    let body =
        world.add_body(RigidBody::dynamic().gravity_scale(0.0).shape(rect(0.4, 0.4))).unwrap();
    world.body_mut(lift).unwrap().set_velocity(Vec2::new(0.0, 6.0));
    run(&mut world, 60);
    assert!(y(&world, body) > y(&world, lift) + 0.45);
}

#[test]
fn a_platform_that_comes_down_from_above_passes() {
    let mut world = World::new(Vec2::ZERO);
    let lift = add_platform(&mut world, BodyKind::Kinematic, 3.0, 0.1);
    let body = world.add_body(RigidBody::dynamic().shape(rect(0.4, 0.4))).unwrap();
    world.body_mut(lift).unwrap().set_velocity(Vec2::new(0.0, -6.0));
    run(&mut world, 90);
    assert_eq!(world.body(body).unwrap().position(), Vec2::ZERO);
}

#[test]
fn a_turned_platform_is_solid_on_its_own_side() {
    let mut world = World::new(Vec2::new(10.0, 0.0));
    let wall = RigidBody::fixed().angle(core::f32::consts::FRAC_PI_2);
    world.add_body(wall.shape(rect(3.0, 0.1).one_way(Vec2::Y))).unwrap();
    // The solid side is the left one.
    let stopped =
        world.add_body(RigidBody::dynamic().position(Vec2::new(-2.0, 0.0)).shape(circle(0.3)));
    run(&mut world, 120);
    assert!((world.body(stopped.unwrap()).unwrap().position().x + 0.4).abs() < 0.02);
    world.gravity = Vec2::new(-10.0, 0.0);
    let passes =
        world.add_body(RigidBody::dynamic().position(Vec2::new(2.0, 1.0)).shape(circle(0.3)));
    run(&mut world, 90);
    assert!(world.body(passes.unwrap()).unwrap().position().x < -2.0);
}

#[test]
fn a_platform_can_be_opened_to_let_go() {
    let mut world = world();
    let platform = add_platform(&mut world, BodyKind::Static, 0.0, 0.1);
    let body = add(&mut world, 0.0, 0.5, rect(0.4, 0.4));
    run(&mut world, 30);
    let shape = shape_of(&world, platform);
    // Turning the solid side away drops what stands on it; turning it back while it is inside keeps it out.
    world.shape_mut(shape).unwrap().set_one_way(Some(-Vec2::Y)).unwrap();
    run(&mut world, 12);
    world.shape_mut(shape).unwrap().set_one_way(Some(Vec2::Y)).unwrap();
    run(&mut world, 60);
    assert!(y(&world, body) < -2.0);
}

#[test]
fn it_holds_what_came_from_above_whatever_has_become_of_step_and_speed() {
    for k in 0..40 {
        for shape in shapes() {
            for calmed in [false, true] {
                let mut world = world();
                add_platform(&mut world, BodyKind::Static, 0.0, 0.05);
                let body = RigidBody::dynamic().position(Vec2::new(0.0, 1.0 + 0.02 * k as f32));
                let body = world.add_body(body.lock_rotation().shape(shape.clone())).unwrap();
                for step in 0..160 {
                    let short = !calmed && step % 2 == 0;
                    world.step(if short { 0.25 * DT } else { DT });
                    let velocity = world.body(body).unwrap().velocity();
                    if calmed && y(&world, body) < 0.6 {
                        world.body_mut(body).unwrap().set_velocity(velocity * 0.2);
                    }
                }
                assert!(y(&world, body) > 0.3, "{k} {calmed} {shape:?}: {}", y(&world, body));
            }
        }
    }
}

/// The rule goes by the direction, not by faces: what is round has none.
#[test]
fn things_land_on_what_is_round() {
    let capsule = Shape::capsule(Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.0), 0.5).unwrap();
    let places = [(circle(0.5), 0.0), (ShapeDef::new(capsule), 0.0), (ShapeDef::new(capsule), 1.1)];
    for (platform, x) in places {
        for shape in shapes() {
            for speed in [0.0, 5.0, 30.0] {
                let mut world = world();
                let platform = platform.clone().one_way(Vec2::Y);
                world.add_body(RigidBody::fixed().shape(platform)).unwrap();
                let body = RigidBody::dynamic().position(Vec2::new(x, 2.0)).lock_rotation();
                let body = body
                    .locks(Locks { x: true, rotation: true, ..Locks::default() })
                    .shape(shape.clone())
                    .velocity(Vec2::new(0.0, -speed));
                let body = world.add_body(body).unwrap();
                run(&mut world, 120);
                let height = y(&world, body);
                assert!(height > 0.7, "{x} {speed} {shape:?}: {height}");
                // And from below it comes through.
                let mut world = world.clone();
                world.body_mut(body).unwrap().set_position(Vec2::new(x, -2.0));
                world.body_mut(body).unwrap().set_velocity(Vec2::new(0.0, 12.0));
                run(&mut world, 24);
                assert!(y(&world, body) > 0.7, "{x} {speed} {shape:?}: {}", y(&world, body));
            }
        }
    }
}

/// New masses say nothing of where it came from.
#[test]
fn what_is_given_a_mass_each_step_lands_too() {
    for i in 0..20 {
        let mut world = world();
        add_platform(&mut world, BodyKind::Static, 0.0, 0.1);
        let body = RigidBody::dynamic().position(Vec2::new(0.0, 0.6 + 0.01 * i as f32));
        let body = body.lock_rotation().shape(rect(0.4, 0.4)).velocity(Vec2::new(0.0, -5.0));
        let body = world.add_body(body).unwrap();
        for _ in 0..60 {
            world.body_mut(body).unwrap().set_mass(Some(1.0)).unwrap();
            world.step(DT);
        }
        assert!(y(&world, body) > 0.45, "{i}: {}", y(&world, body));
    }
}
