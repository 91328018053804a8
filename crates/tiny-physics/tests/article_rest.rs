//! The promises of the article about piles, fast things, joints and sleep, one test each.

mod common;

use common::*;
use tiny_physics::{BodyKind, JointDef, RigidBody, Shape, Vec2, World};

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
