use super::*;
use crate::describe::{Filter, JointDef, Locks, Material};
use crate::dynamics::Slot;
use crate::math::Rot;

#[test]
fn a_body_changes_its_kind_while_others_lean_on_it() {
    let mut world = world();
    add_ground(&mut world);
    let shelf =
        world.add_body(RigidBody::fixed().position(Vec2::new(0.0, 3.0)).shape(rect(1.0, 0.2)));
    let shelf = shelf.unwrap();
    let load = add(&mut world, 0.0, 3.7, rect(0.5, 0.5));
    run(&mut world, 120);
    assert!((y(&world, load) - 3.7).abs() < 0.02);
    world.body_mut(shelf).unwrap().set_kind(BodyKind::Dynamic);
    world.validate().unwrap();
    assert!(world.body(shelf).unwrap().mass() > 0.0 && world.body(shelf).unwrap().is_awake());
    run(&mut world, 240);
    assert!((y(&world, shelf) - 0.2).abs() < 0.03 && (y(&world, load) - 0.9).abs() < 0.05);
    world.body_mut(shelf).unwrap().set_kind(BodyKind::Kinematic);
    world.body_mut(shelf).unwrap().set_velocity(Vec2::new(0.0, 1.0));
    run(&mut world, 60);
    assert!((y(&world, shelf) - 1.2).abs() < 0.03 && (y(&world, load) - 1.9).abs() < 0.06);
    world.body_mut(shelf).unwrap().set_kind(BodyKind::Static);
    assert_eq!(world.body(shelf).unwrap().velocity(), Vec2::ZERO);
    run(&mut world, 60);
    assert!((y(&world, shelf) - 1.2).abs() < 0.03 && (y(&world, load) - 1.9).abs() < 0.06);
}

#[test]
fn a_disabled_body_takes_no_part() {
    let mut world = world();
    let ground = add_ground(&mut world);
    let ball = add(&mut world, 0.0, 0.5, circle(0.5).events());
    let other = add(&mut world, 0.0, 1.5, circle(0.5));
    let joint = world.add_joint(ball, other, JointDef::distance(1.0)).unwrap();
    run(&mut world, 60);
    world.body_mut(ball).unwrap().set_enabled(false);
    let place = y(&world, ball);
    assert!(world.overlap_point(Vec2::new(0.0, 0.5), &QueryFilter::new()).is_empty());
    world.step(DT);
    assert_eq!(world.events().contact_end().len(), 1);
    run(&mut world, 120);
    assert_eq!(y(&world, ball), place);
    // The other one fell through it, and the joint did not hold it.
    assert!((y(&world, other) - 0.5).abs() < 0.05);
    world.body_mut(other).unwrap().set_position(Vec2::new(0.0, 1.5));
    world.body_mut(ball).unwrap().set_enabled(true);
    run(&mut world, 60);
    assert!(y(&world, other) > 1.3);
    assert!(world.joint(joint).is_some() && world.body(ground).is_some());
}

#[test]
fn locks_hold_and_let_go() {
    let mut world = world();
    let ball = add(&mut world, 0.0, 5.0, circle(0.5));
    world.body_mut(ball).unwrap().set_locks(Locks { y: true, ..Locks::default() });
    run(&mut world, 30);
    assert_eq!(y(&world, ball), 5.0);
    world.body_mut(ball).unwrap().set_locks(Locks::default());
    run(&mut world, 30);
    assert!(y(&world, ball) < 4.0);
}

#[test]
fn mass_can_be_given_and_taken_back() {
    let mut world = world();
    let ball = add(&mut world, 0.0, 5.0, circle(0.5));
    let (mass, inertia) = (world.body(ball).unwrap().mass(), world.body(ball).unwrap().inertia());
    world.body_mut(ball).unwrap().set_mass(Some(10.0)).unwrap();
    assert_eq!(world.body(ball).unwrap().mass(), 10.0);
    assert!((world.body(ball).unwrap().inertia() / inertia - 10.0 / mass).abs() < 1e-4);
    assert!(world.body_mut(ball).unwrap().set_mass(Some(0.0)).is_err());
    world.body_mut(ball).unwrap().set_mass(None).unwrap();
    assert_eq!(world.body(ball).unwrap().mass(), mass);
}

#[test]
fn a_platform_follows_its_target_and_carries() {
    let mut world = world();
    let lift = world.add_body(RigidBody::kinematic().shape(rect(2.0, 0.2))).unwrap();
    let load = add(&mut world, 0.5, 0.7, rect(0.5, 0.5));
    run(&mut world, 30);
    for step in 1..=240 {
        let t = step as f32 / 60.0;
        world.body_mut(lift).unwrap().set_target(at(t, 0.5 * t), DT);
        world.step(DT);
        let p = world.body(lift).unwrap().position();
        assert!((p - Vec2::new(t, 0.5 * t)).length() < 1e-3);
        if step > 60 {
            let gap = y(&world, load) - p.y;
            assert!((gap - 0.7).abs() < 0.02, "{step} {gap}");
        }
    }
}

#[test]
fn a_shape_grows_and_pushes() {
    let mut world = world();
    add_ground(&mut world);
    let ball = add(&mut world, 0.0, 0.5, circle(0.5));
    run(&mut world, 120);
    let shape = shape_of(&world, ball);
    world.shape_mut(shape).unwrap().set_shape(Shape::rect(1.0, 1.0).unwrap()).unwrap();
    world.validate().unwrap();
    run(&mut world, 180);
    assert!((y(&world, ball) - 1.0).abs() < 0.03);
    assert_eq!(world.body(ball).unwrap().mass(), 4.0);
    assert!(world.shape_mut(shape).unwrap().set_shape(Shape::Circle { radius: -1.0 }).is_err());
}

#[test]
fn a_material_changes_under_a_resting_body() {
    let mut world = world();
    world.gravity = Vec2::new(4.0, -10.0);
    let ground = add_ground(&mut world);
    let box_ = add(&mut world, 0.0, 0.5, rect(0.5, 0.5));
    run(&mut world, 120);
    let x = world.body(box_).unwrap().position().x;
    assert!(x < 0.1, "{x}");
    let shape = shape_of(&world, ground);
    let ice = Material { friction: 0.0, ..Material::default() };
    world.shape_mut(shape).unwrap().set_material(ice).unwrap();
    run(&mut world, 60);
    assert!(world.body(box_).unwrap().velocity().x > 3.0);
    let bad = Material { friction: f32::NAN, ..ice };
    assert!(world.shape_mut(shape).unwrap().set_material(bad).is_err());
}

#[test]
fn a_filter_opens_and_closes_the_floor() {
    let mut world = world();
    let ground = add_ground(&mut world);
    let ball = add(&mut world, 0.0, 0.5, circle(0.5));
    run(&mut world, 200);
    assert!(!world.body(ball).unwrap().is_awake());
    let shape = shape_of(&world, ground);
    world.shape_mut(shape).unwrap().set_filter(Filter { mask: 0, ..Filter::default() });
    world.step(DT);
    assert_eq!(world.events().contact_end().len(), 1);
    run(&mut world, 20);
    assert!(y(&world, ball) < 0.3);
    world.body_mut(ball).unwrap().set_position(Vec2::new(0.0, 2.0));
    world.shape_mut(shape).unwrap().set_filter(Filter::default());
    run(&mut world, 120);
    assert!((y(&world, ball) - 0.5).abs() < 0.02);
}

#[test]
fn what_the_program_does_to_bodies_is_counted() {
    let mut world = world();
    let (a, b) = (add(&mut world, 0.0, 0.5, circle(0.5)), add(&mut world, 2.0, 0.5, circle(0.5)));
    let rod = world.add_joint(a, b, JointDef::distance(2.0)).unwrap();
    world.body_mut(a).unwrap().set_velocity(Vec2::X);
    world.set_joint(rod, JointDef::distance(1.0)).unwrap();
    assert_eq!((world.stats().pushes, world.stats().stale_handles), (2, 0));
    let shape = shape_of(&world, a);
    world.remove_body(a).unwrap();
    assert!(world.body_mut(a).is_none() && world.shape_mut(shape).is_none());
    assert!(world.joint_mut(rod).is_none() && world.body(a).is_none());
    assert_eq!((world.stats().pushes, world.stats().stale_handles), (2, 3));
}

#[test]
fn a_positive_group_overrides_masks() {
    let mut world = world();
    let filter = Filter { category: 1, mask: 0, group: 3 };
    let ground = RigidBody::fixed().shape(rect(5.0, 1.0).filter(filter));
    world.add_body(ground).unwrap();
    let ball = add(&mut world, 0.0, 2.0, circle(0.5).filter(filter));
    run(&mut world, 120);
    assert!((y(&world, ball) - 1.5).abs() < 0.02);
}

#[test]
fn a_solid_shape_becomes_a_sensor_and_back() {
    let mut world = world();
    let ground = add_ground(&mut world);
    let ball = add(&mut world, 0.0, 0.5, circle(0.5));
    run(&mut world, 30);
    let shape = shape_of(&world, ground);
    world.shape_mut(shape).unwrap().set_sensor(true);
    world.step(DT);
    assert_eq!(world.events().contact_end().len(), 1);
    assert_eq!(world.events().sensor_begin().len(), 1);
    run(&mut world, 10);
    assert!(y(&world, ball) < 0.45);
    world.shape_mut(shape).unwrap().set_sensor(false);
    world.step(DT);
    assert_eq!(world.events().sensor_end().len(), 1);
    run(&mut world, 120);
    assert!((y(&world, ball) - 0.5).abs() < 0.02);
}

#[test]
fn settings_without_sense_are_refused() {
    let mut world = world();
    world.settings.substeps = 0;
    assert!(world.try_step(DT).is_err());
    world.settings = Settings { length_unit: f32::NAN, ..Settings::default() };
    assert!(world.try_step(DT).is_err());
    world.step(DT);
    assert_eq!((world.step_count(), world.stats().refused_steps), (0, 1));
    world.settings = Settings::default();
    assert!(world.try_step(DT).is_ok());
}

#[test]
fn a_sleep_setting_keeps_a_body_awake() {
    let mut world = world();
    add_ground(&mut world);
    let ball = add(&mut world, 0.0, 0.5, circle(0.5));
    world.body_mut(ball).unwrap().set_can_sleep(false);
    run(&mut world, 200);
    assert!(world.body(ball).unwrap().is_awake());
    world.body_mut(ball).unwrap().set_can_sleep(true);
    run(&mut world, 60);
    assert!(!world.body(ball).unwrap().is_awake());
    world.body_mut(ball).unwrap().set_can_sleep(false);
    assert!(world.body(ball).unwrap().is_awake());
}

/// A body that hangs asleep: any change to its joint wakes it, and acts.
#[test]
fn a_joint_that_changes_wakes_what_it_holds() {
    let changes: [fn(JointDef) -> JointDef; 5] = [
        |def| def.motor(1.0, 100.0),
        |def| def.limits(-0.1, 0.1),
        |def| def.spring(2.0, 0.5),
        |def| def.anchors(Vec2::ZERO, Vec2::new(0.0, 1.5)),
        |def| def.break_at(1.0, 1.0),
    ];
    let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(0.0, 1.0));
    for (i, change) in changes.into_iter().enumerate() {
        let mut world = world();
        let hook = world.add_body(RigidBody::fixed()).unwrap();
        let a = add(&mut world, 0.0, -1.0, circle(0.2));
        let b = add(&mut world, 0.0, -2.0, circle(0.2));
        world.add_joint(hook, a, hinge).unwrap();
        let joint = world.add_joint(a, b, hinge).unwrap();
        run(&mut world, 120);
        assert_eq!(world.awake_body_count(), 0, "change {i}");
        world.set_joint(joint, change(hinge)).unwrap();
        assert_eq!(world.awake_body_count(), 2, "change {i}");
        run(&mut world, 1);
        let mut woke = world.events().woke().to_vec();
        woke.sort_unstable();
        assert_eq!(woke, [a, b], "change {i}");
        assert_eq!(world.joint(joint).is_none(), i == 4, "change {i}");
    }
}

#[test]
fn forces_and_velocities_act_at_their_points() {
    let mut world = World::new(Vec2::ZERO);
    let body = add(&mut world, 1.0, 2.0, rect(0.5, 0.5).density(2.0));
    let inertia = 2.0 / 6.0;
    let mut view = world.body_mut(body).unwrap();
    view.apply_impulse(Vec2::new(0.0, 3.0), Vec2::new(1.5, 2.0));
    let view = world.body(body).unwrap();
    let spin = 0.5 * 3.0 / inertia;
    assert!((view.velocity() - Vec2::new(0.0, 1.5)).length() < 1e-6);
    assert!((view.angular_velocity() - spin).abs() < 1e-4);
    let at_corner = view.velocity_at(Vec2::new(1.5, 2.5));
    assert!((at_corner - Vec2::new(-0.5 * spin, 1.5 + 0.5 * spin)).length() < 1e-4);
    // A force over a step is an impulse; it is gone after it.
    let mut other = World::new(Vec2::ZERO);
    let body = add(&mut other, 1.0, 2.0, rect(0.5, 0.5).density(2.0));
    let mut view = other.body_mut(body).unwrap();
    view.apply_force(Vec2::new(0.0, 3.0 / DT), Vec2::new(1.5, 2.0));
    run(&mut other, 1);
    let after = other.body(body).unwrap();
    assert!((after.velocity() - Vec2::new(0.0, 1.5)).length() < 1e-4);
    assert!((after.angular_velocity() - spin).abs() < 1e-3, "{}", after.angular_velocity());
    let before = after.velocity();
    run(&mut other, 1);
    assert!((other.body(body).unwrap().velocity() - before).length() < 1e-6);
}

/// Found by an endurance run: two sleepers that were joined in their sleep, and one of them woken, left the other
/// in the joint's hands without ever moving it, until its speed overflowed.
#[test]
fn sleepers_that_a_joint_links_wake_together() {
    let mut world = world();
    add_ground(&mut world);
    let [a, b, c] = [0.0, 3.0, 6.0].map(|x| add(&mut world, x, 0.5, rect(0.5, 0.5)));
    (0..120).for_each(|_| world.step(DT));
    let awake = |world: &World, id| world.body(id).unwrap().is_awake();
    assert!(![a, b, c].iter().any(|&id| awake(&world, id)), "three islands of one asleep");
    world.add_joint(a, b, JointDef::prismatic(Vec2::X).limits(-1.0, 1.0)).unwrap();
    world.add_joint(b, c, JointDef::distance(1.0).spring(2.0, 0.3)).unwrap();
    world.validate().unwrap();
    world.body_mut(a).unwrap().set_velocity(Vec2::new(0.0, 2.0));
    assert!([a, b, c].iter().all(|&id| awake(&world, id)));
    for _ in 0..600 {
        world.step(DT);
        world.validate().unwrap();
    }
    let fastest = [a, b, c].map(|id| world.body(id).unwrap().velocity().length());
    assert!(fastest.iter().all(|&speed| speed < 1.0), "{fastest:?}");
    let apart = world.body(c).unwrap().position().x - world.body(b).unwrap().position().x;
    assert!(apart < 2.5, "the spring drew them together: {apart}");
}

/// The centre of mass goes far off, and with it the precision of where the other shapes are.
#[test]
fn a_huge_shape_more_leaves_boxes_where_the_others_are() {
    let mut world = world();
    let body = add(&mut world, 3.0, 2.0, circle(0.37).offset(Vec2::new(0.3, 0.1)));
    run(&mut world, 3);
    for length in [1.0e3, 1.0e4, 6.0e4, 1.0e5] {
        let long = Shape::capsule(Vec2::ZERO, Vec2::new(length, 0.3 * length), 0.2).unwrap();
        let shape = world.add_shape(body, long).unwrap();
        world.validate().unwrap();
        world.remove_shape(shape).unwrap();
        world.validate().unwrap();
    }
}

/// However fast a body turns, it turns by its angular velocity times the time, and frames between two steps too.
#[test]
fn free_turning_is_exact_at_any_speed() {
    for spin in [1.0, 14.0, 80.0, -120.0, 180.0, 400.0, -1000.0_f32] {
        let mut world = World::new(Vec2::ZERO);
        let body = RigidBody::dynamic().shape(rect(0.5, 0.1)).angular_velocity(spin);
        let body = world.add_body(body).unwrap();
        let expected = |time: f64| {
            let (s, c) = (f64::from(spin) * time).sin_cos();
            crate::math::Rot { c: c as f32, s: s as f32 }
        };
        let off = |rotation: crate::math::Rot, time: f64| rotation.angle_from(expected(time)).abs();
        for step in 0..60 {
            world.step(DT);
            let view = world.body(body).unwrap();
            assert_eq!(view.angular_velocity(), spin);
            let time = f64::from(DT) * f64::from(step);
            let between = off(view.interpolated_pose(0.3).q, time + 0.3 * f64::from(DT));
            assert!(between < 1.0e-4, "{spin} between frames, step {step}: {between}");
        }
        let error = off(world.body(body).unwrap().rotation(), 60.0 * f64::from(DT));
        // What 32 bits make of an angle as large.
        assert!(error < 1.0e-5 + 1.0e-7 * spin.abs(), "{spin}: {error}");
    }
}

/// A kinematic body arrives where it is sent, by any turn.
#[test]
fn targets_are_reached_by_any_turn() {
    for angle in [0.1, 1.0, 2.0, -3.0, 3.1_f32] {
        let mut world = world();
        let arm = world.add_body(RigidBody::kinematic().shape(rect(1.0, 0.1))).unwrap();
        let target = Transform::from_angle(Vec2::new(0.3, 0.4), angle);
        world.body_mut(arm).unwrap().set_target(target, DT);
        world.step(DT);
        let pose = world.body(arm).unwrap().pose();
        assert!(pose.q.angle_from(target.q).abs() < 1.0e-6, "{angle}: {:?}", pose.q.angle());
        assert!((pose.to_transform().p - target.p).length() < 1.0e-6);
    }
}

#[test]
fn forces_on_what_takes_no_part_do_not_add_up() {
    let mut world = World::new(Vec2::ZERO);
    let ship = add(&mut world, 0.0, 0.0, rect(0.5, 0.5).density(1.0));
    let push = |world: &mut World| {
        world.body_mut(ship).unwrap().apply_force_to_center((6.0, 0.0));
        world.body_mut(ship).unwrap().apply_torque(1.0);
    };
    world.body_mut(ship).unwrap().set_enabled(false);
    for _ in 0..100 {
        push(&mut world);
        world.step(DT);
    }
    world.body_mut(ship).unwrap().set_enabled(true);
    world.step(DT);
    assert_eq!(world.body(ship).unwrap().velocity(), Vec2::ZERO);
    push(&mut world);
    world.body_mut(ship).unwrap().sleep();
    world.body_mut(ship).unwrap().wake();
    world.step(DT);
    assert_eq!(world.body(ship).unwrap().velocity(), Vec2::ZERO);
    assert_eq!(world.body(ship).unwrap().angular_velocity(), 0.0);
}

/// A dumbbell that turns about its middle flies apart: each end goes on as it went.
#[test]
fn what_is_left_of_a_turning_body_goes_on_as_it_went() {
    let mut world = World::new(Vec2::ZERO);
    let body = RigidBody::dynamic().angle(0.3).velocity(Vec2::new(1.0, 2.0)).angular_velocity(10.0);
    let body = body.shape(circle(0.25).offset((-0.5, 0.0))).shape(circle(0.25).offset((0.5, 0.0)));
    let body = world.add_body(body).unwrap();
    let turned = Rot::from_angle(0.3);
    let before = world.body(body).unwrap().velocity_at(turned.rotate(Vec2::new(-0.5, 0.0)));
    let is_right = |shape: &ShapeId| world.shape(*shape).unwrap().local().p.x > 0.0;
    let right = world.shape_ids().find(is_right).unwrap();
    world.remove_shapes(&[right]).unwrap();
    let left = world.body(body).unwrap();
    assert!((left.velocity() - before).length() < 1.0e-5, "{} {before}", left.velocity());
    assert!((left.velocity() - Vec2::new(1.0, 2.0)).length() > 4.9);
}

#[test]
fn a_wall_that_begins_to_collide_lets_out_what_sleeps_in_it() {
    let mut world = world();
    add_ground(&mut world);
    let inside = add(&mut world, 0.0, 0.5, rect(0.5, 0.5));
    let wall = RigidBody::fixed().position(Vec2::new(0.7, 2.0));
    let wall = world.add_body(wall.shape(rect(0.5, 2.0).filter(Filter::NONE))).unwrap();
    run(&mut world, 120);
    assert!(!world.body(inside).unwrap().is_awake());
    let shape = shape_of(&world, wall);
    world.shape_mut(shape).unwrap().set_filter(Filter::default());
    run(&mut world, 300);
    assert!(world.body(inside).unwrap().position().x < -0.28);
}

/// A new mass or shape moves nothing, so the last step has still moved the body.
#[test]
fn what_changes_its_mass_or_shape_has_moved_all_the_same() {
    let changes: [fn(&mut World, BodyId); 4] = [
        |world, body| world.body_mut(body).unwrap().set_mass(Some(2.0)).unwrap(),
        |world, body| world.body_mut(body).unwrap().set_center(Some(Vec2::new(0.2, 0.1))).unwrap(),
        |world, body| {
            let shape = shape_of(world, body);
            world.shape_mut(shape).unwrap().set_shape(Shape::circle(0.3).unwrap()).unwrap();
        },
        |world, body| {
            world.add_shape(body, circle(0.2).offset(Vec2::new(1.0, 0.0))).unwrap();
        },
    ];
    for (i, change) in changes.into_iter().enumerate() {
        let mut world = World::new(Vec2::ZERO);
        let body = add(&mut world, 0.0, 0.0, rect(0.5, 0.5));
        world.body_mut(body).unwrap().set_velocity(Vec2::new(6.0, 3.0));
        world.body_mut(body).unwrap().set_angular_velocity(2.0);
        run(&mut world, 3);
        let before = world.body(body).unwrap().interpolated_pose(0.5);
        change(&mut world, body);
        assert_eq!(world.moved_bodies(), [body], "{i}");
        let now = world.body(body).unwrap().interpolated_pose(0.5);
        let off = (now.p.x - before.p.x).hypot(now.p.y - before.p.y);
        assert!(off < 0.005, "{i}: {off}");
    }
}

#[test]
fn what_is_switched_off_is_drawn_where_it_is() {
    let mut world = World::new(Vec2::ZERO);
    let body = add(&mut world, 0.0, 0.0, circle(0.5));
    world.body_mut(body).unwrap().set_velocity(Vec2::new(6.0, 0.0));
    run(&mut world, 3);
    world.body_mut(body).unwrap().set_enabled(false);
    let body = world.body(body).unwrap();
    assert_eq!(body.interpolated_pose(0.25).p, body.interpolated_pose(1.0).p);
}

/// Materials are numbers of a contact, not what it is made of.
#[test]
fn contacts_stay_as_they_are_when_a_material_changes() {
    let mut world = world();
    let ground = add_ground(&mut world);
    let body = add(&mut world, 0.0, 0.5, rect(0.5, 0.5));
    world.body_mut(body).unwrap().set_can_sleep(false);
    run(&mut world, 60);
    let before = world.body(body).unwrap().contacts().next().unwrap();
    let shape = shape_of(&world, ground);
    world.shape_mut(shape).unwrap().set_friction(0.9).unwrap();
    let after = world.body(body).unwrap().contacts().next().unwrap();
    assert_eq!(format!("{before:?}"), format!("{after:?}"));
    world.step(DT);
    let contact = world.body(body).unwrap().contacts().next().unwrap();
    assert!(contact.force().length() > 1.0);
    // And they go by the new one: with no friction it slides as on ice.
    for id in [shape, shape_of(&world, body)] {
        world.shape_mut(id).unwrap().set_friction(0.0).unwrap();
    }
    world.body_mut(body).unwrap().set_velocity(Vec2::new(2.0, 0.0));
    run(&mut world, 60);
    assert!((world.body(body).unwrap().velocity().x - 2.0).abs() < 0.01);
}

/// What has just woken has no contacts until a step has found them.
#[test]
fn no_contact_is_shown_without_its_normal() {
    let mut world = world();
    add_ground(&mut world);
    let body = add(&mut world, 0.0, 0.5, rect(0.5, 0.5));
    run(&mut world, 120);
    assert!(!world.body(body).unwrap().is_awake());
    world.body_mut(body).unwrap().wake();
    let bad =
        |world: &World| world.contacts().filter(|contact| contact.normal.length() < 0.9).count();
    assert_eq!(bad(&world), 0);
    assert_eq!(world.body(body).unwrap().contacts().filter(|c| c.normal == Vec2::ZERO).count(), 0);
    world.step(DT);
    assert_eq!((world.contacts().count(), bad(&world)), (1, 0));
}

/// The material of one shape of a body concerns what touches that.
#[test]
fn one_tile_of_a_level_wakes_what_lies_on_it() {
    let mut world = world();
    let ground = world.add_body(RigidBody::fixed()).unwrap();
    let [left, _] = [-50.0, 50.0]
        .map(|x| world.add_shape(ground, rect(2.0, 0.5).offset(Vec2::new(x, 0.0))).unwrap());
    let [a, b] = [-50.0, 50.0].map(|x| add(&mut world, x, 1.0, rect(0.5, 0.5)));
    run(&mut world, 200);
    assert_eq!(world.awake_body_count(), 0);
    world.shape_mut(left).unwrap().set_friction(0.1).unwrap();
    assert!(world.body(a).unwrap().is_awake() && !world.body(b).unwrap().is_awake());
}

/// A target that is refused is refused as a whole.
#[test]
fn targets_are_taken_whole() {
    let mut world = world();
    let lift = world.add_body(RigidBody::kinematic().shape(rect(0.5, 0.5))).unwrap();
    let target = crate::Transform::from_angle(Vec2::new(1.0e6, 0.0), 0.1);
    world.body_mut(lift).unwrap().set_target(target, 1.0e-10);
    let lift = world.body(lift).unwrap();
    assert_eq!((lift.velocity(), lift.angular_velocity()), (Vec2::ZERO, 0.0));
}

/// What blows up is stopped, and what it lies on keeps nothing of it.
#[test]
fn ground_keeps_nothing_that_is_not_finite() {
    for kind in [BodyKind::Static, BodyKind::Kinematic] {
        let mut world = world();
        let ground = RigidBody { kind, ..RigidBody::fixed() };
        let ground = world.add_body(ground.shape(rect(5.0, 0.5))).unwrap();
        let ball = add(&mut world, 0.0, 1.0, circle(0.5));
        run(&mut world, 20);
        let rows = &mut world.state.bodies.rows;
        rows[ball.index()][Slot::VX] = f32::INFINITY;
        rows[ground.index()][Slot::W] = f32::NAN;
        run(&mut world, 2);
        world.validate().unwrap();
        assert_eq!(world.body(ground).unwrap().angular_velocity(), 0.0, "{kind:?}");
        run(&mut world, 60);
        assert!((y(&world, ball) - 1.0).abs() < 0.02, "{kind:?}");
    }
}

/// A game may set its motors in every step: what they are already wakes nothing.
#[test]
fn a_joint_that_is_given_what_it_has_goes_on_sleeping() {
    let mut world = world();
    let wall = world.add_body(RigidBody::fixed()).unwrap();
    let arm = add(&mut world, 0.5, 0.0, rect(0.5, 0.1));
    let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-0.5, 0.0)).motor(0.0, 100.3);
    let joint = world.add_joint(wall, arm, hinge).unwrap();
    run(&mut world, 120);
    assert!(!world.body(arm).unwrap().is_awake());
    let def = *world.joint(joint).unwrap().def();
    world.set_joint(joint, def).unwrap();
    assert!(!world.body(arm).unwrap().is_awake());
    world.set_joint(joint, hinge.motor(0.1, 100.3)).unwrap();
    assert!(world.body(arm).unwrap().is_awake());
}
