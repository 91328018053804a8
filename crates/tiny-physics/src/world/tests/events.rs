use super::*;
use crate::describe::{JointDef, JointKind, Spring};
use crate::math::Rot;

#[test]
fn a_hit_tells_the_speed_of_the_fall() {
    let mut world = world();
    add_ground(&mut world);
    let ball = add(&mut world, 0.0, 5.5, circle(0.5).events());
    let mut hits = Vec::new();
    for _ in 0..90 {
        world.step(DT);
        hits.extend_from_slice(world.events().hits());
    }
    // v^2 = 2 g h with h = 5 m.
    assert_eq!(hits.len(), 1, "{hits:?}");
    let hit = hits[0];
    assert!((hit.speed - 10.0).abs() < 0.4, "{hit:?}");
    assert!(hit.normal.y.abs() > 0.999 && hit.position.y.abs() < 0.2);
    let ball = shape_of(&world, ball);
    assert!(hit.shape_a == ball || hit.shape_b == ball);
}

#[test]
fn slow_touches_are_no_hits() {
    let mut world = world();
    add_ground(&mut world);
    add(&mut world, 0.0, 0.51, circle(0.5).events());
    for _ in 0..60 {
        world.step(DT);
        assert!(world.events().hits().is_empty());
    }
}

#[test]
fn sensors_see_bodies_of_every_kind() {
    let mut world = World::new(Vec2::ZERO);
    let sensor = |kind| RigidBody { kind, ..RigidBody::default() }.shape(rect(1.0, 1.0).sensor());
    let visitor = |kind| RigidBody { kind, ..RigidBody::default() }.shape(circle(0.3));
    let kinds = [BodyKind::Static, BodyKind::Kinematic, BodyKind::Dynamic];
    for of in kinds {
        let of_id = world.add_body(sensor(of)).unwrap();
        let of_shape = shape_of(&world, of_id);
        for kind in kinds {
            let id = world.add_body(visitor(kind)).unwrap();
            let shape = shape_of(&world, id);
            world.body_mut(id).unwrap().sleep();
            run(&mut world, 2);
            let sees = of != BodyKind::Static || kind != BodyKind::Static;
            let seen: Vec<ShapeId> = world.sensor_overlaps(of_shape).collect();
            assert_eq!(seen, if sees { vec![shape] } else { vec![] }, "{of:?} {kind:?}");
            world.remove_body(id).unwrap();
            world.step(DT);
            assert_eq!(world.events().sensor_end().len(), usize::from(sees));
            assert_eq!(world.sensor_overlaps(of_shape).count(), 0);
        }
        world.remove_body(of_id).unwrap();
    }
}

#[test]
fn sensors_keep_what_sleeps_in_them_and_let_it_go() {
    let mut world = world();
    add_ground(&mut world);
    let gate = world.add_body(RigidBody::fixed().shape(rect(2.0, 2.0).sensor())).unwrap();
    let gate = shape_of(&world, gate);
    let ball = add(&mut world, 0.0, 0.5, circle(0.5));
    let mut begun = 0;
    for _ in 0..200 {
        world.step(DT);
        begun += world.events().sensor_begin().len();
        assert!(world.events().sensor_end().is_empty());
    }
    assert!(!world.body(ball).unwrap().is_awake());
    assert_eq!(begun, 1);
    assert_eq!(world.sensor_overlaps(gate).count(), 1);
    world.body_mut(ball).unwrap().set_position(Vec2::new(9.0, 0.5));
    world.step(DT);
    assert_eq!(world.events().sensor_end().len(), 1);
    assert_eq!(world.sensor_overlaps(gate).count(), 0);
}

#[test]
fn a_static_body_that_is_placed_in_a_sleeping_sensor_is_seen() {
    let mut world = world();
    add_ground(&mut world);
    let walker = RigidBody::dynamic()
        .position(Vec2::new(0.0, 0.5))
        .shape(circle(0.5))
        .shape(circle(2.0).density(0.0).sensor());
    let walker = world.add_body(walker).unwrap();
    let wall = world.add_body(RigidBody::fixed().position(Vec2::new(9.0, 2.0)).shape(circle(0.2)));
    let wall = wall.unwrap();
    run(&mut world, 200);
    assert!(!world.body(walker).unwrap().is_awake());
    world.body_mut(wall).unwrap().set_position(Vec2::new(0.0, 2.0));
    world.step(DT);
    assert_eq!(world.events().sensor_begin()[0].visitor, shape_of(&world, wall));
    world.body_mut(wall).unwrap().set_position(Vec2::new(9.0, 2.0));
    world.step(DT);
    assert_eq!(world.events().sensor_end()[0].visitor, shape_of(&world, wall));
}

#[test]
fn a_bullet_that_goes_through_a_thin_sensor_is_seen() {
    for threads in [1, 2] {
        let mut world = World::new(Vec2::ZERO);
        world.set_threads(threads);
        let gate = world.add_body(RigidBody::fixed().shape(rect(0.05, 1.0).sensor())).unwrap();
        let bullet = RigidBody::dynamic().position(Vec2::new(-5.0, 0.0)).shape(circle(0.1));
        let bullet = world.add_body(bullet.velocity(Vec2::new(180.0, 0.0))).unwrap();
        let (mut begin, mut end) = (0, 0);
        for _ in 0..10 {
            world.step(DT);
            begin += world.events().sensor_begin().len();
            end += world.events().sensor_end().len();
        }
        assert_eq!((begin, end), (1, 1));
        assert!(world.body(bullet).unwrap().position().x > 5.0);
        let _ = gate;
    }
}

#[test]
fn a_wall_before_the_sensor_hides_it_from_a_bullet() {
    let mut world = World::new(Vec2::ZERO);
    world.add_body(RigidBody::fixed().shape(rect(0.05, 1.0).sensor())).unwrap();
    let wall = RigidBody::fixed().position(Vec2::new(-1.0, 0.0)).shape(rect(0.05, 1.0));
    world.add_body(wall).unwrap();
    let bullet = RigidBody::dynamic().position(Vec2::new(-3.0, 0.0)).shape(circle(0.1));
    world.add_body(bullet.velocity(Vec2::new(300.0, 0.0))).unwrap();
    for _ in 0..20 {
        world.step(DT);
        assert!(world.events().sensor_begin().is_empty());
    }
}

#[test]
fn bodies_tell_when_they_move_fall_asleep_and_wake() {
    let mut world = world();
    let ground = add_ground(&mut world);
    let ball = add(&mut world, 0.0, 0.6, circle(0.5));
    let mut asleep = Vec::new();
    world.step(DT);
    assert_eq!(world.moved_bodies(), [ball]);
    for _ in 0..200 {
        world.step(DT);
        asleep.extend_from_slice(world.events().fell_asleep());
    }
    assert_eq!(asleep, [ball]);
    assert!(world.moved_bodies().is_empty());
    world.body_mut(ball).unwrap().apply_impulse_to_center(Vec2::new(0.0, 1.0));
    assert!(world.events().woke().is_empty());
    world.step(DT);
    assert_eq!(world.events().woke(), [ball]);
    assert_eq!(world.moved_bodies(), [ball]);
    let _ = ground;
}

#[test]
fn interpolated_poses_lie_between_the_steps() {
    let mut world = World::new(Vec2::ZERO);
    let stick = RigidBody::dynamic().velocity(Vec2::new(6.0, 0.0)).angular_velocity(3.0);
    let stick = stick.shape(rect(1.0, 0.1).offset(Vec2::new(0.5, 0.0)));
    let stick = world.add_body(stick).unwrap();
    let before = world.body(stick).unwrap().pose();
    world.step(DT);
    let body = world.body(stick).unwrap();
    let middle = body.interpolated_pose(0.5);
    let close = |a: Pose, b: Pose| {
        (a.p - b.p).to_vec2().length() < 1e-5 && a.q.angle_from(b.q).abs() < 1e-5
    };
    assert!(close(body.interpolated_pose(0.0), before));
    assert!(close(body.interpolated_pose(1.0), body.pose()));
    assert!((middle.q.angle() - 0.025).abs() < 1e-5);
    assert!((middle.apply(body.local_center()).x - 0.55).abs() < 1e-4);
    world.body_mut(stick).unwrap().set_position(Vec2::new(50.0, 0.0));
    let body = world.body(stick).unwrap();
    assert!(close(body.interpolated_pose(0.3), body.pose()));
}

use crate::math::Pose;

/// A mass on a rope that falls until the rope is taut: force at the end of each step, or until it breaks.
fn jerk(slack: f32, break_at: f32, substeps: u32) -> (Vec<f32>, Option<JointBreak>) {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    world.settings.substeps = substeps;
    let anchor = world.add_body(RigidBody::fixed()).unwrap();
    let start = Vec2::new(0.0, slack - 2.0);
    let ball = RigidBody::dynamic().position(start).shape(circle(0.2)).mass(1.0);
    let ball = world.add_body(ball).unwrap();
    let rope = JointDef::rope(2.0).break_at(break_at, f32::MAX);
    let rope = world.add_joint(anchor, ball, rope).unwrap();
    let dt = substeps as f32 / 240.0;
    let mut forces = Vec::new();
    for _ in 0..240 / substeps {
        world.step(dt);
        if let Some(broken) = world.events().joint_breaks().first() {
            assert!(world.joint(rope).is_none() && world.joint_count() == 0);
            return (forces, Some(*broken));
        }
        forces.push(world.joint(rope).unwrap().force().length());
    }
    (forces, None)
}

#[test]
fn a_joint_breaks_by_a_peak_within_a_step() {
    let peak = |forces: &[f32]| forces.iter().copied().fold(0.0, f32::max);
    let mut hidden = 0;
    for i in 0..12 {
        let slack = 0.5 + 0.02 * i as f32;
        let most = peak(&jerk(slack, f32::MAX, 1).0);
        let seen = peak(&jerk(slack, f32::MAX, 4).0);
        hidden += usize::from(seen < 0.9 * most);
        let (_, broken) = jerk(slack, 0.9 * most, 4);
        let force = broken.expect("the rope breaks").force.length();
        assert!((force - most).abs() < 0.05 * most, "{force} N of {most} N");
        assert_eq!(jerk(slack, 1.1 * most, 4).1, None);
    }
    assert!(hidden > 0, "some peaks are over at the end of their step");
}

/// Force and torque that a break tells may be of two substeps.
#[test]
fn a_break_tells_the_greatest_force_and_torque_of_the_step() {
    let mut world = World::new(Vec2::ZERO);
    let anchor = world.add_body(RigidBody::fixed()).unwrap();
    let body = RigidBody::dynamic().angular_velocity(8.0).shape(rect(0.5, 0.5));
    let body = world.add_body(body).unwrap();
    let mut drive = JointDef::drive().break_at(10.0, f32::MAX);
    if let JointKind::Motor { velocity, max_force, angular_spring, max_spring_torque, .. } =
        &mut drive.kind
    {
        (*velocity, *max_force) = (Vec2::X, 1.0e6);
        *angular_spring = Some(Spring { hertz: 1.0, damping_ratio: 0.0 });
        *max_spring_torque = 1.0e6;
    }
    world.add_joint(anchor, body, drive).unwrap();
    world.step(DT);
    let [broken] = world.events().joint_breaks() else { panic!("it did not break once") };
    assert!(broken.force.x > 10.0 && broken.torque.abs() > 0.5, "{broken:?}");
}

#[test]
fn what_flies_through_a_sensor_is_seen_once() {
    for k in 0..200 {
        let mut world = World::new(Vec2::ZERO);
        world.add_body(RigidBody::fixed().shape(rect(0.2, 1.0).sensor())).unwrap();
        let velocity = Vec2::new(10.0 + 0.1 * k as f32, 0.0);
        let ball = RigidBody::dynamic().position(Vec2::new(-2.0 - 0.003 * k as f32, 0.0));
        world.add_body(ball.velocity(velocity).shape(rect(0.1, 0.1))).unwrap();
        let (mut begun, mut ended) = (0, 0);
        for _ in 0..40 {
            world.step(DT);
            begun += world.events().sensor_begin().len();
            ended += world.events().sensor_end().len();
        }
        assert_eq!((begun, ended), (1, 1), "{k}");
    }
}

/// Two that cross each other's way within a step meet where their ways cross, wherever they go next.
#[test]
fn a_fast_sensor_sees_what_crosses_its_way() {
    for turned in 0..8 {
        let q = Rot::from_angle(0.3 + turned as f32);
        let mut world = World::new(Vec2::ZERO);
        let fast = |place: Vec2, velocity: Vec2, shape: ShapeDef| {
            RigidBody::dynamic().position(q.rotate(place)).velocity(q.rotate(velocity)).shape(shape)
        };
        let shot = fast(Vec2::new(-2.5, 0.0), Vec2::new(300.0, 0.0), circle(0.1).sensor());
        world.add_body(shot).unwrap();
        let bird = world.add_body(fast(Vec2::new(0.0, -2.5), Vec2::new(0.0, 300.0), circle(0.1)));
        let bird = bird.unwrap();
        // One that crosses the same way earlier is not seen.
        world.add_body(fast(Vec2::new(0.5, -0.5), Vec2::new(0.0, 300.0), circle(0.1))).unwrap();
        world.step(DT);
        let begun = world.events().sensor_begin();
        assert_eq!(begun.len(), 1, "{turned}");
        assert_eq!(begun[0].visitor, shape_of(&world, bird));
    }
}

/// What is done to a body after a step changes nothing of what the step has done.
#[test]
fn what_moved_is_told_whatever_is_done_to_it_since() {
    let changes: [fn(&mut World, BodyId); 4] = [
        |world, body| world.body_mut(body).unwrap().set_kind(BodyKind::Static),
        |world, body| world.body_mut(body).unwrap().set_kind(BodyKind::Kinematic),
        |world, body| world.body_mut(body).unwrap().set_enabled(false),
        |world, body| world.body_mut(body).unwrap().sleep(),
    ];
    for (i, change) in changes.into_iter().enumerate() {
        let mut world = World::new(Vec2::ZERO);
        let bodies = [0.0, 5.0].map(|x| add(&mut world, x, 0.0, circle(0.5)));
        for body in bodies {
            world.body_mut(body).unwrap().set_velocity(Vec2::X);
        }
        world.step(DT);
        change(&mut world, bodies[0]);
        for world in [&world, &world.clone(), &World::from_bytes(&world.to_bytes()).unwrap()] {
            let mut moved = world.moved_bodies().to_vec();
            moved.sort_unstable();
            assert_eq!(moved, bodies, "{i}");
        }
        world.step(DT);
        let moves_on = if i == 1 { &bodies[..] } else { &bodies[1..] };
        let moved: Vec<BodyId> = world.moved_bodies().to_vec();
        assert!(moved.iter().all(|body| moves_on.contains(body)), "{i}: {moved:?}");
        assert_eq!(moved.len(), moves_on.len(), "{i}");
        let copy = World::from_bytes(&world.to_bytes()).unwrap();
        assert_eq!(copy.moved_bodies(), world.clone().moved_bodies(), "{i}");
        assert_eq!(copy.moved_bodies(), moved, "{i}");
    }
}

/// How it is drawn between two steps is a matter of the step that was made.
#[test]
fn a_spin_set_after_the_step_is_not_drawn_in_it() {
    for spin in [0.0, 3.0, 150.0, 400.0, -1000.0] {
        let mut world = World::new(Vec2::ZERO);
        let body = add(&mut world, 0.0, 0.0, circle(0.5));
        world.body_mut(body).unwrap().set_angular_velocity(spin);
        world.step(DT);
        let drawn = |world: &World| {
            [0.0, 0.25, 0.5, 0.75].map(|alpha| world.body(body).unwrap().interpolated_pose(alpha))
        };
        let before = drawn(&world);
        assert!((before[1].q.angle_from(Rot::from_angle(0.25 * spin * DT))).abs() < 1e-3, "{spin}");
        for set in [-spin, 0.0, 500.0, -2000.0, spin] {
            world.body_mut(body).unwrap().set_angular_velocity(set);
            assert_eq!(drawn(&world), before, "{spin} and then {set}");
            assert_eq!(drawn(&world.clone()), before, "{spin} and then {set}, a copy");
            let saved = World::from_bytes(&world.to_bytes()).unwrap();
            assert_eq!(drawn(&saved), before, "{spin} and then {set}, saved");
            world.settings.substeps = 8;
            assert_eq!(drawn(&world), before, "other substeps");
            world.settings.substeps = 4;
            // What is placed since is drawn there.
            let mut placed = world.clone();
            placed.body_mut(body).unwrap().set_angle(0.5);
            assert!(drawn(&placed).iter().all(|pose| *pose == drawn(&placed)[0]));
        }
        world.step(DT);
        let turn = world.body(body).unwrap().interpolated_pose(0.5).q;
        let turned = turn.angle_from(world.body(body).unwrap().interpolated_pose(0.0).q);
        let expected = Rot::from_angle(0.5 * spin * DT).angle();
        assert!((turned - expected).abs() < 1e-3, "{spin}: {turned} in place of {expected}");
    }
}

/// What contacts tell of the last step does not change with the settings of the next one.
#[test]
fn loads_are_those_of_the_step_that_was_made() {
    let mut world = world();
    add_ground(&mut world);
    let body = add(&mut world, 0.0, 0.5, rect(0.5, 0.5));
    run(&mut world, 20);
    let told = |world: &World| {
        let contact = world.body(body).unwrap().contacts().next().unwrap();
        (contact.total_impulse(), contact.force())
    };
    let before = told(&world);
    assert!((before.1.length() - 10.0).abs() < 0.1, "{before:?}");
    for substeps in [1, 8, 0] {
        world.settings.substeps = substeps;
        assert_eq!(told(&world), before, "{substeps}");
        assert_eq!(told(&world.clone()), before, "{substeps}, a copy");
        assert_eq!(
            told(&World::from_bytes(&world.to_bytes()).unwrap()),
            before,
            "{substeps}, saved"
        );
    }
}
