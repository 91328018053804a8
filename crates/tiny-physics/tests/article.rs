//! What the engine promises, from the vector to the heap that comes to rest: one test a promise.

mod common;

use common::*;
use tiny_physics::{Aabb, BodyKind, FixedStep, JointDef, RigidBody, Shape, ShapeDef, Vec2, World};

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

// No jitter.

#[test]
fn a_settled_stack_of_ten_boxes_moves_less_than_a_millimetre_in_ten_seconds() {
    // Without sleep a stack that starts exactly straight takes a while to stop swaying.
    for (sleep, settling_time) in [(true, 120), (false, 900)] {
        let mut world = world_with_floor();
        world.settings.sleep = sleep;
        let boxes: Vec<_> =
            (0..10).map(|i| drop_at(&mut world, rect(0.5, 0.5), 0.0, 0.5 + i as f32)).collect();
        steps(&mut world, settling_time);
        let before: Vec<_> = boxes.iter().map(|&id| position(&world, id)).collect();
        for _ in 0..600 {
            world.step(DT);
            for (&id, &start) in boxes.iter().zip(&before) {
                let way = position(&world, id).distance(start);
                assert!(way < 1.0e-3, "{id} moved {way} m by step {}", world.step_count());
            }
        }
    }
}

#[test]
fn normals_of_resting_contacts_do_not_flip() {
    let shapes: [fn() -> Shape; 4] =
        [|| rect(0.5, 0.5), || upright(0.5, 0.5), || circle(0.5), || capsule(0.4, 0.3)];
    for shape in shapes {
        let mut world = world_with_floor();
        world.settings.sleep = false;
        let lower = drop_at(&mut world, shape(), 0.0, 0.5);
        let height = if matches!(shape(), Shape::Circle { .. }) { 0.5 } else { 1.5 };
        // Circles lie side by side, the others on each other.
        drop_at(&mut world, shape(), 1.0 - (height - 0.5), height);
        steps(&mut world, 120);
        let before: Vec<_> = world.contacts().map(|c| (c.shape_a, c.shape_b, c.normal)).collect();
        assert!(!before.is_empty());
        for frame in 0..600 {
            world.step(DT);
            for contact in world.contacts() {
                let Some(&(.., normal)) =
                    before.iter().find(|c| (c.0, c.1) == (contact.shape_a, contact.shape_b))
                else {
                    continue;
                };
                let cosine = contact.normal.dot(normal);
                assert!(cosine > 0.999, "{:?}: frame {frame}, {lower}: {contact:?}", shape());
            }
        }
    }
}

#[test]
fn a_body_at_rest_stays_at_rest() {
    let mut world = world_with_floor();
    world.settings.sleep = false;
    let id = drop_at(&mut world, rect(0.5, 0.5), 0.0, 0.5);
    steps(&mut world, 60);
    let before = position(&world, id);
    steps(&mut world, 3600);
    let way = position(&world, id).distance(before);
    assert!(way < 1.0e-4, "it crept {way} m in a minute");
}

// No tunnelling.

#[test]
fn a_fast_small_circle_never_passes_a_thin_wall() {
    let mut random = Random::new(1);
    let mut passed = Vec::new();
    for shot in 0..1000 {
        let mut world = World::new(Vec2::ZERO);
        let wall = if shot % 2 == 0 { upright(0.05, 20.0) } else { rect(0.05, 20.0) };
        world.add_body(RigidBody::fixed().shape(wall)).unwrap();
        let slope = random.range(-0.6, 0.6);
        let direction = Vec2::new(1.0, slope).normalized();
        let start = Vec2::new(-random.range(0.2, 6.0), random.range(-2.0, 2.0));
        let ball = RigidBody::new(circle(0.1), start, 1.0)
            .velocity(direction * 300.0)
            .restitution(random.range(0.0, 1.0));
        let ball = world.add_body(ball).unwrap();
        for _ in 0..10 {
            world.step(DT);
            if position(&world, ball).x > 0.0 {
                passed.push((shot, start, slope));
                break;
            }
        }
    }
    assert!(passed.is_empty(), "{} of 1000 passed, first {:?}", passed.len(), passed[0]);
}

#[test]
fn fast_shapes_that_turn_never_pass_a_floor() {
    let shapes =
        [rect(0.5, 0.5), rect(0.6, 0.1), capsule(0.5, 0.1), upright(0.3, 0.3), circle(0.2)];
    let mut random = Random::new(3);
    let mut passed = Vec::new();
    for shot in 0..500 {
        let mut world = world_with_floor();
        let speed = Vec2::new(random.range(-50.0, 50.0), -random.range(50.0, 400.0));
        let body = RigidBody::dynamic()
            .position(Vec2::new(0.0, random.range(0.8, 8.0)))
            .angle(random.range(-3.0, 3.0))
            .velocity(speed)
            .angular_velocity(random.range(-180.0, 180.0))
            .shape(shapes[shot % shapes.len()]);
        let body = world.add_body(body).unwrap();
        let went_through = (0..60).any(|_| {
            world.step(DT);
            position(&world, body).y < -0.5
        });
        if went_through {
            passed.push(shot);
        }
    }
    assert!(passed.is_empty(), "{} of 500 passed: {passed:?}", passed.len());
}

// Joints.

#[test]
fn a_pendulum_keeps_its_length_and_its_period() {
    let mut world = world();
    let hook = world.add_body(RigidBody::fixed()).unwrap();
    let bob = drop_at(&mut world, circle(0.1), 0.2, -2.0);
    let length = Vec2::new(0.2, -2.0).length();
    world.add_joint(hook, bob, JointDef::distance(length)).unwrap();
    let (mut crossings, mut before) = (Vec::new(), 0.2);
    for step in 1..=1200 {
        world.step(DT);
        let place = position(&world, bob);
        assert!((place.length() - length).abs() < 0.002, "step {step}: {}", place.length());
        if before > 0.0 && place.x <= 0.0 {
            crossings.push(step as f32 * DT);
        }
        before = place.x;
    }
    let period = (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f32;
    // 2 pi sqrt(l / g) for small swings.
    let expected = 2.0 * std::f32::consts::PI * (length / 9.8_f32).sqrt();
    assert!((period / expected - 1.0).abs() < 0.01, "{period} s instead of {expected} s");
}

#[test]
fn a_hinge_holds_its_anchors_together() {
    let mut world = world();
    let mut last = world.add_body(RigidBody::fixed()).unwrap();
    let mut joints = Vec::new();
    for i in 0..8 {
        let link = drop_at(&mut world, rect(0.5, 0.1), 0.5 + i as f32, 0.0);
        let anchor = if i == 0 { Vec2::ZERO } else { Vec2::new(0.5, 0.0) };
        let hinge = JointDef::revolute().anchors(anchor, Vec2::new(-0.5, 0.0));
        joints.push(world.add_joint(last, link, hinge).unwrap());
        last = link;
    }
    for step in 0..600 {
        world.step(DT);
        for &id in &joints {
            let (a, b) = world.joint(id).unwrap().anchors();
            let gap = a.relative_to(b).length();
            assert!(gap < 0.03, "step {step}, {id}: {gap} m apart");
        }
    }
}

// Coming to rest.

#[test]
fn twenty_circles_and_boxes_come_to_rest_on_the_floor() {
    for seed in 0..20 {
        let mut random = Random::new(seed);
        let mut world = world();
        let ground = RigidBody::new(upright(20.0, 1.0), Vec2::new(0.0, -10.0), 0.0);
        world.add_body(ground).unwrap();
        let step = RigidBody::new(upright(2.0, 0.5), Vec2::new(4.0, -8.5), 0.0);
        world.add_body(step).unwrap();
        for x in [-19.5, 19.5] {
            // Kerbs: some balls are flung off a floor without.
            let wall = RigidBody::new(upright(0.5, 5.0), Vec2::new(x, -4.0), 0.0);
            world.add_body(wall).unwrap();
        }
        for i in 0..20 {
            let place = Vec2::new(random.range(-8.0, 8.0), random.range(5.0, 15.0));
            let shape = if i % 2 == 0 {
                circle(random.range(0.2, 0.8))
            } else {
                upright(random.range(0.3, 0.7), random.range(0.3, 0.7))
            };
            let mut body = RigidBody::new(shape, place, 1.0);
            body.shapes[0].material.rolling_resistance = 0.2;
            world.add_body(body).unwrap();
        }
        steps(&mut world, 900);
        assert_eq!(world.awake_body_count(), 0, "seed {seed}: not everything sleeps");
        assert!(world.max_penetration() < 0.01, "seed {seed}: {} m", world.max_penetration());
        for id in world.body_ids().collect::<Vec<_>>() {
            let body = world.body(id).unwrap();
            let low = body.kind() == BodyKind::Dynamic && body.position().y < -9.0 + 0.19;
            assert!(!low, "seed {seed}: {id} lies at {:?}", body.position());
        }
        world.validate().unwrap();
    }
}

#[test]
fn what_sleeps_wakes_when_touched_pushed_moved_or_robbed_of_its_floor() {
    let scene = || {
        let mut world = world();
        let floor = add_floor(&mut world);
        let lower = drop_at(&mut world, rect(0.5, 0.5), 0.0, 0.5);
        let upper = drop_at(&mut world, rect(0.5, 0.5), 0.0, 1.5);
        steps(&mut world, 300);
        assert_eq!(world.awake_body_count(), 0);
        (world, floor, lower, upper)
    };
    let (mut world, .., upper) = scene();
    world.body_mut(upper).unwrap().apply_impulse_to_center(Vec2::new(0.1, 0.0));
    assert_eq!(world.awake_body_count(), 2, "an impulse wakes the island");

    let (mut world, _, lower, upper) = scene();
    world.body_mut(lower).unwrap().set_position(Vec2::new(5.0, 0.5));
    steps(&mut world, 60);
    assert!(position(&world, upper).y < 0.6, "what stood on it has fallen");

    let (mut world, _, lower, upper) = scene();
    world.remove_body(lower).unwrap();
    steps(&mut world, 60);
    assert!(position(&world, upper).y < 0.6, "what stood on it has fallen");

    let (mut world, floor, lower, _) = scene();
    world.remove_body(floor).unwrap();
    steps(&mut world, 60);
    assert!(position(&world, lower).y < -3.0, "without a floor it falls");

    let (mut world, _, lower, _) = scene();
    drop_at(&mut world, circle(0.3), 0.0, 4.0);
    steps(&mut world, 45);
    assert!(world.body(lower).unwrap().is_awake(), "a touch wakes the island");
}

#[test]
fn a_lift_that_starts_carries_what_sleeps_on_it() {
    let mut world = world();
    let lift = world.add_body(RigidBody::kinematic().shape(rect(2.0, 0.5))).unwrap();
    let lower = drop_at(&mut world, rect(0.5, 0.5), 0.0, 1.0);
    let upper = drop_at(&mut world, rect(0.5, 0.5), 0.0, 2.0);
    steps(&mut world, 300);
    assert_eq!(world.awake_body_count(), 0);
    world.body_mut(lift).unwrap().set_velocity(Vec2::new(0.0, 1.0));
    steps(&mut world, 60);
    for (id, height) in [(lower, 2.0), (upper, 3.0)] {
        let y = position(&world, id).y;
        assert!((y - height).abs() < 0.02, "{id} is at {y}, not at {height}");
    }
    world.body_mut(lift).unwrap().set_velocity(Vec2::ZERO);
    steps(&mut world, 300);
    assert_eq!(world.awake_body_count(), 0, "a lift that stands lets them sleep again");
}

#[test]
fn a_body_put_to_sleep_takes_its_island_along() {
    let mut world = world_with_floor();
    let stack = [0.5, 1.5, 2.5].map(|y| drop_at(&mut world, rect(0.5, 0.5), 0.0, y));
    let far = drop_at(&mut world, rect(0.5, 0.5), 5.0, 0.5);
    let hung = drop_at(&mut world, circle(0.2), 8.0, 0.2);
    world.add_joint(stack[0], hung, JointDef::distance(8.0)).unwrap();
    steps(&mut world, 10);
    world.body_mut(stack[1]).unwrap().sleep();
    for id in [stack[0], stack[1], stack[2], hung] {
        assert!(!world.body(id).unwrap().is_awake(), "{id}");
    }
    assert!(world.body(far).unwrap().is_awake());
    let before = stack.map(|id| position(&world, id));
    steps(&mut world, 20);
    world.validate().unwrap();
    assert_eq!(stack.map(|id| position(&world, id)), before);
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
