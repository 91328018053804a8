//! What the engine promises, from the vector to the heap that comes to rest: one test a promise.

mod common;

use common::*;
use tiny_physics::{Aabb, BodyKind, FixedStep, RigidBody, ShapeDef, Vec2, World};

// Vectors, boxes, shapes, bodies.

#[test]
fn vectors_add_scale_and_multiply() {
    let (a, b) = (Vec2::new(3.0, 4.0), Vec2::new(-1.0, 2.0));
    assert_eq!(a + b, Vec2::new(2.0, 6.0));
    assert_eq!(a - b, Vec2::new(4.0, 2.0));
    assert_eq!(a * 2.0, Vec2::new(6.0, 8.0));
    let mut c = a;
    c += b;
    assert_eq!(c, a + b);
    assert_eq!((a.dot(b), a.cross(b)), (5.0, 10.0));
    assert_eq!((a.length(), a.length_sq()), (5.0, 25.0));
}

#[test]
fn a_vector_too_short_to_have_a_direction_normalises_to_zero() {
    for short in [Vec2::ZERO, Vec2::new(1.0e-30, 0.0), Vec2::new(0.0, -1.0e-12)] {
        assert_eq!(short.normalized(), Vec2::ZERO);
    }
    assert_eq!(Vec2::new(0.0, -7.0).normalized(), Vec2::new(0.0, -1.0));
}

#[test]
fn boxes_know_whether_they_overlap() {
    let unit = Aabb::new(Vec2::ZERO, Vec2::new(1.0, 1.0));
    assert!(unit.overlaps(&Aabb::new(Vec2::new(0.5, 0.5), Vec2::new(2.0, 2.0))));
    assert!(!unit.overlaps(&Aabb::new(Vec2::new(1.5, 0.0), Vec2::new(2.0, 1.0))));
    assert!(!unit.overlaps(&Aabb::new(Vec2::new(0.0, -2.0), Vec2::new(1.0, -0.5))));
}

#[test]
fn a_body_with_an_upright_box_never_turns() {
    let mut world = world_with_floor();
    let id = drop_at(&mut world, upright(0.5, 0.5), 0.0, 2.0);
    drop_at(&mut world, circle(0.5), 0.4, 5.0);
    for _ in 0..300 {
        if let Some(mut body) = world.body_mut(id) {
            body.apply_torque(100.0);
        }
        world.step(DT);
        let body = world.body(id).unwrap();
        assert_eq!((body.angle(), body.angular_velocity()), (0.0, 0.0));
    }
}

#[test]
fn a_new_body_has_the_mass_it_was_given_and_bounces_by_half() {
    let body = RigidBody::new(circle(0.5), Vec2::new(1.0, 2.0), 3.0);
    assert_eq!(body.shapes[0].material.restitution, 0.5);
    let mut world = world();
    let id = world.add_body(body).unwrap();
    let body = world.body(id).unwrap();
    assert_eq!((body.mass(), body.position()), (3.0, Vec2::new(1.0, 2.0)));
    assert_eq!((body.kind(), body.velocity()), (BodyKind::Dynamic, Vec2::ZERO));
    assert!((body.inertia() - 0.5 * 3.0 * 0.25).abs() < 1.0e-4, "{}", body.inertia());
}

#[test]
fn a_body_of_mass_zero_is_pushed_by_nothing_and_pushes_everything() {
    let mut world = world();
    let wall = world.add_body(RigidBody::new(upright(1.0, 1.0), Vec2::ZERO, 0.0)).unwrap();
    let ball =
        RigidBody::new(circle(0.5), Vec2::new(0.0, 4.0), 1.0e6).velocity(Vec2::new(0.0, -9.0));
    let ball = world.add_body(ball).unwrap();
    world.body_mut(wall).unwrap().apply_impulse_to_center(Vec2::new(100.0, 100.0));
    steps(&mut world, 300);
    let wall = world.body(wall).unwrap();
    assert_eq!((wall.kind(), wall.mass()), (BodyKind::Static, 0.0));
    assert_eq!((wall.position(), wall.velocity()), (Vec2::ZERO, Vec2::ZERO));
    let height = position(&world, ball).y;
    assert!((height - 1.5).abs() < 0.02, "the ball lies at {height}");
}

// Finding pairs.

#[test]
fn every_touching_pair_is_a_contact_once() {
    let mut world = World::new(Vec2::ZERO);
    world.settings.sleep = false;
    for i in 0..6 {
        for j in 0..6 {
            // Neighbours overlap by a centimetre, diagonal ones are far apart.
            drop_at(&mut world, circle(0.5), 0.99 * i as f32, 0.99 * j as f32);
        }
    }
    world.step(1.0e-3);
    let mut pairs: Vec<_> = world
        .contacts()
        .map(|c| if c.body_a < c.body_b { (c.body_a, c.body_b) } else { (c.body_b, c.body_a) })
        .collect();
    pairs.sort_unstable();
    let count = pairs.len();
    pairs.dedup();
    assert_eq!((pairs.len(), count), (2 * 6 * 5, 2 * 6 * 5));
}

// Colliding.

#[test]
fn coincident_circles_part_upwards_without_a_nan() {
    let mut world = World::new(Vec2::ZERO);
    let (a, b) =
        (drop_at(&mut world, circle(0.5), 1.0, 1.0), drop_at(&mut world, circle(0.5), 1.0, 1.0));
    world.step(DT);
    let contact = world.contacts().next().expect("a contact");
    assert_eq!(contact.normal.abs(), Vec2::Y);
    steps(&mut world, 300);
    let apart = position(&world, a).distance(position(&world, b));
    assert!((0.98..2.0).contains(&apart), "they are {apart} apart");
    world.validate().unwrap();
}

#[test]
fn a_circle_whose_centre_is_in_a_box_is_pushed_out_of_the_nearest_face() {
    let mut world = World::new(Vec2::ZERO);
    world.add_body(RigidBody::new(upright(2.0, 2.0), Vec2::ZERO, 0.0)).unwrap();
    let inside = drop_at(&mut world, circle(0.3), 1.8, 0.4);
    steps(&mut world, 120);
    let place = position(&world, inside);
    assert!(place.x > 2.28 && (place.y - 0.4).abs() < 0.01, "{place:?}");
}

#[test]
fn boxes_that_overlap_as_much_in_x_as_in_y_part_along_x() {
    for (x, y) in [(0.9, 0.9), (-0.9, 0.9), (0.9, -0.9), (-0.9, -0.9)] {
        let mut world = World::new(Vec2::ZERO);
        drop_at(&mut world, upright(0.5, 0.5), 0.0, 0.0);
        drop_at(&mut world, upright(0.5, 0.5), x, y);
        world.step(DT);
        let contact = world.contacts().next().expect("a contact");
        assert_eq!(contact.normal.abs(), Vec2::X, "at ({x}, {y})");
    }
}

#[test]
fn a_contact_prints_its_normal_depth_and_points() {
    let mut world = world_with_floor();
    drop_at(&mut world, circle(0.5), 0.0, 0.49);
    world.step(DT);
    let contact = world.contacts().next().expect("a contact");
    let text = format!("{contact:?}");
    for part in ["normal", "separation", "position"] {
        assert!(text.contains(part), "{text}");
    }
    let point = contact.points()[0];
    assert!((point.separation + 0.01).abs() < 1.0e-3, "{point:?}");
    assert!(point.position.to_vec2().length() < 0.01, "{point:?}");
}

// Moving.

#[test]
fn velocity_goes_first_and_position_follows_with_the_new_velocity() {
    let mut world = world();
    world.settings.substeps = 1;
    let ball = drop_at(&mut world, circle(0.5), 0.0, 0.0);
    world.step(0.5);
    assert_eq!(velocity(&world, ball), Vec2::new(0.0, -4.9));
    assert_eq!(position(&world, ball), Vec2::new(0.0, -2.45));
}

#[test]
fn free_fall_follows_the_formula_at_any_step() {
    for rate in [15_u32, 30, 60, 120, 240] {
        let mut world = world();
        let ball = drop_at(&mut world, circle(0.1), 0.0, 0.0);
        let dt = 1.0 / rate as f32;
        (0..2 * rate).for_each(|_| world.step(dt));
        let (speed, height) = (velocity(&world, ball).y, position(&world, ball).y);
        assert!((speed + 19.6).abs() < 1.0e-3, "{rate} Hz: speed {speed}");
        // Semi-implicit Euler is ahead of the parabola by g t h / 2, and by nothing else.
        let h = dt / world.settings.substeps as f32;
        let expected = -0.5 * 9.8 * 2.0 * (2.0 + h);
        assert!((height - expected).abs() < 2.0e-3, "{rate} Hz: {height}, not {expected}");
    }
}

#[test]
fn bodies_turn_about_their_centre_of_mass() {
    let mut world = World::new(Vec2::ZERO);
    let club = RigidBody::dynamic()
        .shape(ShapeDef::new(circle(0.5)).offset(Vec2::new(2.0, 0.0)))
        .shape(ShapeDef::new(circle(0.5)).offset(Vec2::new(0.0, 0.0)))
        .angular_velocity(2.0);
    let club = world.add_body(club).unwrap();
    for _ in 0..100 {
        world.step(DT);
        let body = world.body(club).unwrap();
        assert!((body.center().to_vec2() - Vec2::X).length() < 1.0e-5);
        assert!((body.position().distance(Vec2::X) - 1.0).abs() < 1.0e-4);
    }
}

#[test]
fn the_frame_rate_decides_how_many_steps_are_made_and_nothing_else() {
    let mut hashes = Vec::new();
    for frames_per_second in [20_u32, 50, 60, 144] {
        let (mut world, mut clock) = (pyramid(4), FixedStep::new(DT));
        while world.step_count() < 120 {
            let count = clock.advance(1.0 / frames_per_second as f32);
            for _ in 0..count.min(120 - world.step_count() as u32) {
                world.step(clock.dt());
            }
            assert!((0.0..=1.0).contains(&clock.alpha()));
        }
        hashes.push(world.state_hash());
    }
    assert!(hashes.iter().all(|&hash| hash == hashes[0]), "{hashes:x?}");
}

#[test]
fn a_frame_that_took_too_long_makes_a_bounded_number_of_steps() {
    let mut clock = FixedStep::new(DT).max_steps(4);
    assert_eq!(clock.advance(3600.0), 4);
    assert_eq!(clock.advance(0.0), 0);
}

#[test]
fn damping_does_not_depend_on_the_frame_rate() {
    // Speed falls by 1/(1 + c h) a substep: towards exp(-c t) as h shrinks.
    let expected = 10.0 * (-1.5_f32).exp();
    for rate in [30, 60, 120, 240] {
        let mut world = World::new(Vec2::ZERO);
        let body = RigidBody::dynamic()
            .shape(circle(0.5))
            .velocity(Vec2::new(10.0, 0.0))
            .angular_velocity(10.0)
            .damping(1.5, 1.5);
        let body = world.add_body(body).unwrap();
        (0..rate).for_each(|_| world.step(1.0 / rate as f32));
        let body = world.body(body).unwrap();
        let (speed, turn_rate) = (body.velocity().x, body.angular_velocity());
        assert!((speed / expected - 1.0).abs() < 0.01, "{rate} Hz: {speed}, not {expected}");
        assert!((turn_rate / expected - 1.0).abs() < 0.01, "{rate} Hz: {turn_rate}");
    }
}

// Solving.

/// Speeds of two balls after a head-on hit along x.
fn after_hit(masses: [f32; 2], speeds: [f32; 2], restitutions: [f32; 2]) -> [f32; 2] {
    let mut world = World::new(Vec2::ZERO);
    let ids: Vec<_> = (0..2)
        .map(|i| {
            let place = Vec2::new(1.1 * i as f32, 0.0);
            let ball = RigidBody::new(circle(0.5), place, masses[i])
                .velocity(Vec2::new(speeds[i], 0.0))
                .restitution(restitutions[i]);
            world.add_body(ball).unwrap()
        })
        .collect();
    steps(&mut world, 30);
    [velocity(&world, ids[0]).x, velocity(&world, ids[1]).x]
}

#[test]
fn two_balls_bounce_by_the_smaller_restitution() {
    for (a, b) in [(1.0, 0.5), (0.5, 1.0), (0.5, 0.5), (0.0, 1.0), (1.0, 1.0)] {
        let e = if a < b { a } else { b };
        let [v1, v2] = after_hit([1.0, 1.0], [4.0, -4.0], [a, b]);
        let parting = v2 - v1;
        assert!(
            (parting - 8.0 * e).abs() < 0.05,
            "restitutions {a} and {b}: they part at {parting}"
        );
    }
}

#[test]
fn momentum_survives_a_hit_between_unequal_masses() {
    for (m1, m2) in [(1.0, 1.0), (1.0, 10.0), (100.0, 1.0)] {
        let [v1, v2] = after_hit([m1, m2], [6.0, 0.0], [0.5, 0.5]);
        let (before, after) = (m1 * 6.0, m1 * v1 + m2 * v2);
        assert!(
            (after / before - 1.0).abs() < 1.0e-4,
            "masses {m1}, {m2}: {before} became {after}"
        );
        assert!((v2 - v1 - 3.0).abs() < 0.05, "masses {m1}, {m2}: they part at {}", v2 - v1);
    }
}

#[test]
fn bodies_that_part_already_get_no_impulse() {
    let mut world = World::new(Vec2::ZERO);
    let left = RigidBody::new(circle(0.5), Vec2::new(0.0, 0.0), 1.0).velocity(Vec2::new(-2.0, 0.0));
    let right = RigidBody::new(circle(0.5), Vec2::new(1.0, 0.0), 1.0).velocity(Vec2::new(2.0, 0.0));
    let (left, right) = (world.add_body(left).unwrap(), world.add_body(right).unwrap());
    steps(&mut world, 10);
    assert_eq!(velocity(&world, left), Vec2::new(-2.0, 0.0));
    assert_eq!(velocity(&world, right), Vec2::new(2.0, 0.0));
}

#[test]
fn one_substep_with_ten_iterations_holds_a_stack_too() {
    let mut world = world_with_floor();
    (world.settings.substeps, world.settings.iterations) = (1, 10);
    let boxes: Vec<_> =
        (0..5).map(|i| drop_at(&mut world, rect(0.5, 0.5), 0.0, 0.5 + i as f32)).collect();
    steps(&mut world, 300);
    for (i, &id) in boxes.iter().enumerate() {
        // Contacts are softer in longer substeps: up to 5 cm of overlap in each of them here.
        let (place, height) = (position(&world, id), 0.5 + i as f32);
        let stands = place.x.abs() < 0.01 && (height - place.y).abs() < 0.05 * (i + 1) as f32;
        assert!(stands, "box {i} of the stack is at {place:?}");
    }
}

#[test]
fn a_deep_overlap_is_pushed_out_smoothly() {
    let mut world = World::new(Vec2::ZERO);
    let a = drop_at(&mut world, rect(0.5, 0.5), 0.0, 0.0);
    let b = drop_at(&mut world, rect(0.5, 0.5), 0.1, 0.0);
    let limit = 2.0 * world.settings.push_speed;
    for _ in 0..300 {
        world.step(DT);
        for id in [a, b] {
            let speed = velocity(&world, id).length();
            assert!(speed <= limit, "pushed out at {speed} m/s");
        }
    }
    let apart = (position(&world, b) - position(&world, a)).x.abs();
    assert!(apart > 0.98, "they still overlap: centres {apart} m apart");
}

/// How far a box slides down a ramp in two seconds, metres along the ramp.
fn slide(angle: f32, friction: f32) -> f32 {
    let mut world = world();
    world.settings.sleep = false;
    let ramp = RigidBody::fixed().angle(angle).shape(rect(100.0, 1.0)).friction(friction);
    world.add_body(ramp).unwrap();
    let (s, c) = (tiny_physics::math::sin(angle), tiny_physics::math::cos(angle));
    let place = Vec2::new(-s, c) * 1.5;
    let block = RigidBody::dynamic()
        .position(place)
        .angle(angle)
        .shape(rect(0.5, 0.5))
        .friction(friction)
        .restitution(0.0);
    let block = world.add_body(block).unwrap();
    steps(&mut world, 120);
    -(position(&world, block) - place).dot(Vec2::new(c, s))
}

#[test]
fn a_box_on_a_ramp_sticks_where_friction_holds_it() {
    for (angle, friction) in [(0.1, 0.2), (0.3, 0.4), (0.5, 0.7)] {
        let way = slide(angle, friction);
        assert!(way.abs() < 0.002, "slope {angle}, friction {friction}: it slid {way} m");
    }
}

#[test]
fn a_box_on_a_ramp_slides_as_the_formula_says_where_friction_does_not_hold_it() {
    for (angle, friction) in [(0.3_f32, 0.0_f32), (0.3, 0.1), (0.5, 0.3), (0.6, 0.5)] {
        let way = slide(angle, friction);
        // s = a t^2 / 2 with a = g (sin - mu cos).
        let expected = 0.5 * 9.8 * (angle.sin() - friction * angle.cos()) * 4.0;
        assert!(
            (way / expected - 1.0).abs() < 0.02,
            "slope {angle}, friction {friction}: {way} m instead of {expected} m"
        );
    }
}

#[test]
fn friction_brings_a_sliding_box_to_rest_where_the_formula_says() {
    let mut world = world_with_floor();
    let block = RigidBody::dynamic()
        .position(Vec2::new(0.0, 0.5))
        .velocity(Vec2::new(5.0, 0.0))
        .shape(rect(0.5, 0.5))
        .friction(0.6);
    let block = world.add_body(block).unwrap();
    steps(&mut world, 180);
    // v^2 / (2 mu g), with the square root of 0.6 * 0.6.
    let expected = 25.0 / (2.0 * 0.6 * 9.8);
    let way = position(&world, block).x;
    assert!((way / expected - 1.0).abs() < 0.03, "{way} m instead of {expected} m");
    assert!(velocity(&world, block).length() < 1.0e-3);
}

// Borrowing.

#[test]
fn two_bodies_can_be_read_at_once_and_changed_in_turn() {
    let mut world = World::new(Vec2::ZERO);
    let (a, b) =
        (drop_at(&mut world, circle(0.5), 0.0, 0.0), drop_at(&mut world, circle(0.5), 3.0, 0.0));
    let towards = {
        let (a, b) = (world.body(a).unwrap(), world.body(b).unwrap());
        (b.position() - a.position()).normalized()
    };
    for (id, impulse) in [(a, towards), (b, -towards)] {
        world.body_mut(id).unwrap().apply_impulse_to_center(impulse);
    }
    assert_eq!(velocity(&world, a), -velocity(&world, b));
}

// Lightness.

#[test]
fn the_engine_needs_next_to_nothing() {
    let manifest = include_str!("../Cargo.toml");
    let dependencies: Vec<&str> = manifest
        .lines()
        .skip_while(|line| line.trim() != "[dependencies]")
        .skip(1)
        .take_while(|line| !line.starts_with('['))
        .filter(|line| line.contains('=') && !line.contains("optional = true"))
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert_eq!(
        dependencies,
        ["fearless_simd"],
        "each dependency needs a reason; see ARCHITECTURE.md"
    );
}
