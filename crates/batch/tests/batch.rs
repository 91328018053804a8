//! Promises of batches: equal on any number of threads, equal after going back, and errors in place of panics.

use tiny_physics::{JointDef, QueryFilter, RayCast, RigidBody, Shape, Vec2, World};
use tiny_physics_batch::tasks::{BipedalWalker, Driving, LunarLander, Ragdoll, Stacking};
use tiny_physics_batch::{
    Actuator, Autoreset, BatchError, Random, Reading, Sight, TaskBatch, Tasks, WorldBatch,
};

/// A pendulum over a floor with a few crates.
fn template(crates: usize) -> (World, [Actuator; 3], Vec<Reading>) {
    let mut world = World::new(Vec2::new(0.0, -9.8));
    let floor = world
        .add_body(RigidBody::new(Shape::rect(10.0, 0.5).unwrap(), Vec2::new(0.0, -0.5), 0.0))
        .unwrap();
    let bob = RigidBody::new(Shape::circle(0.3).unwrap(), Vec2::new(1.0, 4.0), 1.0);
    let bob = world.add_body(bob).unwrap();
    let hinge = JointDef::revolute().anchors(Vec2::new(0.0, 4.5), Vec2::new(-1.0, 0.0));
    let joint = world.add_joint(floor, bob, hinge.motor(0.0, 5.0)).unwrap();
    let mut last = bob;
    for i in 0..crates {
        let at = Vec2::new(-2.0 + 0.1 * i as f32, 0.5 + i as f32);
        last = world.add_body(RigidBody::new(Shape::rect(0.4, 0.4).unwrap(), at, 1.0)).unwrap();
    }
    let actuators = [Actuator::MotorSpeed(joint), Actuator::ForceX(last), Actuator::PositionX(bob)];
    let sight =
        Sight { body: bob, offset: Vec2::ZERO, translation: Vec2::new(0.0, -9.0), mask: u64::MAX };
    let readings = vec![
        Reading::PositionX(bob),
        Reading::JointAngle(joint),
        Reading::JointSpeed(joint),
        Reading::VelocityY(last),
        Reading::Awake(last),
        Reading::Touching(last),
        Reading::Ray(sight),
    ];
    (world, actuators, readings)
}

fn play(batch: &mut WorldBatch, steps: usize, random: &mut Random) -> Vec<f32> {
    let (_, actuators, readings) = template(3);
    let mut seen = vec![0.0; batch.len() * readings.len()];
    for _ in 0..steps {
        let actions: Vec<f32> = (0..batch.len() * 2).map(|_| random.uniform(-3.0, 3.0)).collect();
        batch.apply(&actuators[..2], &actions).unwrap();
        batch.step(1.0 / 60.0).unwrap();
        batch.read(&readings, &mut seen).unwrap();
    }
    seen
}

/// As the joint itself does: from how its bodies were turned when they were joined.
#[test]
fn joints_are_read_as_they_count() {
    let mut world = World::new(Vec2::ZERO);
    let base = world.add_body(RigidBody::fixed().angle(0.3)).unwrap();
    let arm = RigidBody::dynamic().angle(1.1).shape(Shape::rect(1.0, 0.1).unwrap());
    let arm = world.add_body(arm.angular_velocity(-0.5)).unwrap();
    let hinge = world.add_joint(base, arm, JointDef::revolute().anchor_at((0.0, 0.0))).unwrap();
    let mut batch = WorldBatch::new(&[world], 1, 1).unwrap();
    let mut out = [1.0; 2];
    batch.read(&[Reading::JointAngle(hinge), Reading::JointSpeed(hinge)], &mut out).unwrap();
    assert!(out[0].abs() < 1e-6 && out[1] == -0.5, "{out:?}");
}

/// A joint that broke in one world stands still there; what is wrong elsewhere is told with the first such world, and the others have
/// had their actions.
#[test]
fn a_broken_joint_and_an_error_are_matters_of_their_worlds() {
    let (mut world, actuators, readings) = template(2);
    let Actuator::MotorSpeed(joint) = actuators[0] else { unreachable!() };
    let Actuator::ForceX(last) = actuators[1] else { unreachable!() };
    let Reading::PositionX(bob) = readings[0] else { unreachable!() };
    let removed = world.add_joint(last, bob, JointDef::weld()).unwrap();
    world.remove_joint(removed).unwrap();
    for threads in [1, 3] {
        let mut batch = WorldBatch::new(&[world.clone()], 40, threads).unwrap();
        batch.world_mut(17).unwrap().remove_joint(joint).unwrap();
        batch.apply(&[actuators[0], Actuator::MotorMax(joint)], &[2.0; 80]).unwrap();
        let joint_too = [Reading::JointHolds(joint), readings[1], readings[2], readings[0]];
        let mut out = [f32::NAN; 160];
        batch.step(1.0 / 60.0).unwrap();
        batch.read(&joint_too, &mut out).unwrap();
        assert_eq!(out[17 * 4..17 * 4 + 3], [0.0; 3]);
        assert!(out[..4].iter().all(|x| *x != 0.0) && out[0] == 1.0, "{:?}", &out[..4]);
        assert!(out.iter().all(|x| x.is_finite()));

        let speeds: Vec<f32> =
            (0..40).map(|i| if i == 9 || i == 30 { 1e20 } else { 1.0 }).collect();
        let error = batch.apply(&[Actuator::VelocityX(last)], &speeds).unwrap_err();
        assert!(matches!(error, BatchError::InWorld { index: 9, .. }), "{error:?}");
        assert!(error.to_string().starts_with("world 9: action is "), "{error}");
        for (i, world) in batch.worlds().enumerate() {
            let is_moved = world.body(last).unwrap().velocity().x == 1.0;
            assert_eq!(is_moved, i != 9 && i != 30, "world {i}");
        }
        // What no template has is no joint that broke.
        let error = batch.apply(&[Actuator::MotorSpeed(removed)], &[1.0; 40]).unwrap_err();
        assert!(matches!(error, BatchError::InWorld { index: 0, .. }), "{error:?}");
        assert!(batch.read(&[Reading::JointAngle(removed)], &mut out[..40]).is_err());
        assert!(batch.read(&[Reading::JointHolds(removed)], &mut out[..40]).is_err());
        let all: Vec<usize> = (0..40).rev().collect();
        batch.world_mut(5).unwrap().remove_body(last).unwrap();
        let error = batch.scatter(&all, &[Actuator::VelocityY(last)], &[4.0], &[4.0]).unwrap_err();
        assert!(matches!(error, BatchError::InWorld { index: 5, .. }), "{error:?}");
        assert_eq!(batch.world(0).unwrap().body(last).unwrap().velocity().y, 4.0);
    }
}

/// A finite number that the engine refuses is told, and changes nothing.
#[test]
fn actions_that_are_too_large_are_errors() {
    let mut world = World::new(Vec2::ZERO);
    let ball = RigidBody::dynamic().shape(Shape::circle(0.5).unwrap());
    let ball = world.add_body(ball).unwrap();
    let mut batch = WorldBatch::new(&[world], 2, 1).unwrap();
    let before = batch.state_hashes().unwrap();
    let each = [
        Actuator::VelocityX,
        Actuator::ForceY,
        Actuator::ImpulseX,
        Actuator::Thrust,
        Actuator::AngularVelocity,
        Actuator::PositionX,
    ];
    for actuator in each.map(|actuator| actuator(ball)) {
        let told = batch.apply(&[actuator], &[f32::MAX, 0.0]);
        assert!(
            matches!(told, Err(BatchError::InWorld { index: 0, .. })),
            "{actuator:?}: {told:?}"
        );
    }
    assert_eq!(batch.state_hashes().unwrap(), before);
}

#[test]
fn threads_change_nothing() {
    let runs = [1, 2, 5].map(|threads| {
        let mut batch = WorldBatch::new(&[template(3).0, template(4).0], 33, threads).unwrap();
        let seen = play(&mut batch, 60, &mut Random::new(1));
        (seen.iter().map(|x| x.to_bits()).collect::<Vec<_>>(), batch.state_hashes().unwrap())
    });
    assert_eq!(runs[0], runs[1]);
    assert_eq!(runs[0], runs[2]);
    let hashes = &runs[0].1;
    assert!(hashes.iter().all(|hash| hashes.iter().filter(|h| *h == hash).count() == 1));
}

#[test]
fn a_saved_batch_goes_on_as_if_nothing_had_happened() {
    let mut batch = WorldBatch::new(&[template(3).0], 20, 2).unwrap();
    play(&mut batch, 30, &mut Random::new(1));
    let bytes = batch.to_bytes().unwrap();
    let mut other = WorldBatch::from_bytes(&bytes, 1).unwrap();
    let random = Random::new(9);
    let expected = play(&mut batch, 30, &mut random.clone());
    assert_eq!(play(&mut other, 30, &mut random.clone()), expected);
    assert_eq!(batch.state_hashes(), other.state_hashes());

    batch.restore_bytes(&bytes).unwrap();
    assert_eq!(play(&mut batch, 30, &mut random.clone()), expected);
    for cut in [0, 1, bytes.len() / 2, bytes.len() - 1] {
        assert!(WorldBatch::from_bytes(&bytes[..cut], 1).is_err(), "{cut}");
    }
}

#[test]
fn resets_touch_only_their_worlds_and_scatter_follows_the_seed() {
    let mut batch = WorldBatch::new(&[template(3).0, template(4).0], 6, 1).unwrap();
    let fresh = batch.state_hashes().unwrap();
    play(&mut batch, 10, &mut Random::new(1));
    let played = batch.state_hashes().unwrap();
    batch.reset(&[1, 4]).unwrap();
    let now = batch.state_hashes().unwrap();
    for i in 0..6 {
        assert_eq!(now[i], if [1, 4].contains(&i) { fresh[i] } else { played[i] });
    }
    let actuator = [template(3).1[2]];
    let mut scatter = |seed: u64| {
        batch.seed(&[seed; 6]).unwrap();
        batch.reset(&[0, 2]).unwrap();
        batch.scatter(&[0, 2], &actuator, &[-1.0], &[1.0]).unwrap();
        batch.state_hashes().unwrap()
    };
    let (first, again, other) = (scatter(5), scatter(5), scatter(6));
    assert_eq!(first, again);
    assert_eq!(first[0], first[2]);
    assert_ne!(first[0], other[0]);
    assert_eq!(first[1], other[1]);
}

#[test]
fn rays_of_all_worlds_are_those_of_each() {
    let mut batch = WorldBatch::new(&[template(3).0], 7, 3).unwrap();
    play(&mut batch, 20, &mut Random::new(4));
    let rays: Vec<RayCast> = (0..7 * 5)
        .map(|i| RayCast::new(Vec2::new(i as f32 * 0.3 - 5.0, 6.0), Vec2::new(0.5, -8.0)))
        .collect();
    let mut hits = Vec::new();
    batch.ray_casts(&rays, &QueryFilter::new(), &mut hits).unwrap();
    for (i, (hit, ray)) in hits.iter().zip(&rays).enumerate() {
        let world = batch.world(i / 5).unwrap();
        assert_eq!(*hit, world.ray_cast(ray.origin, ray.translation, &QueryFilter::new()));
    }
    assert!(hits.iter().filter(|hit| hit.is_some()).count() > 20);
    assert!(batch.ray_casts(&rays[..6], &QueryFilter::new(), &mut hits).is_err());
}

#[test]
fn bad_input_is_named_and_changes_nothing() {
    let (world, actuators, readings) = template(3);
    assert!(WorldBatch::new(&[], 4, 1).is_err());
    let mut batch = WorldBatch::new(&[world], 4, 1).unwrap();
    let before = batch.state_hashes().unwrap();
    let force = [actuators[1]];
    let error = batch.apply(&force, &[0.0; 3]).unwrap_err();
    assert_eq!(error, BatchError::Length { name: "actions", expected: 4, got: 3 });
    let error = batch.apply(&force, &[0.0, 1.0, f32::NAN, 0.0]).unwrap_err();
    assert!(error.to_string().starts_with("actions[2] is NaN"), "{error}");
    assert!(batch.read(&readings, &mut [0.0; 3]).is_err());
    assert!(batch.reset(&[4]).is_err());
    assert!(batch.seed(&[1]).is_err());
    assert!(batch.step(f32::NAN).is_err());
    assert!(batch.scatter(&[0], &force, &[0.0], &[f32::INFINITY]).is_err());
    assert_eq!(batch.state_hashes().unwrap(), before);
    let Actuator::ForceX(body) = actuators[1] else { unreachable!() };
    batch.world_mut(2).unwrap().remove_body(body).unwrap();
    assert!(matches!(batch.apply(&force, &[0.0; 4]), Err(BatchError::InWorld { index: 2, .. })));
}

/// Random actions for a batch of any task.
fn acts(batch: &dyn Tasks, random: &mut Random) -> Vec<f32> {
    let spec = batch.spec();
    let act = |_| match spec.choices {
        Some(choices) => random.whole(0, choices.into()) as f32,
        None => random.uniform(-1.0, 1.0),
    };
    (0..batch.len() * spec.action).map(act).collect()
}

/// All tasks as batches.
fn batches(count: usize, threads: usize, autoreset: Autoreset) -> Vec<Box<dyn Tasks>> {
    let lander = |continuous| LunarLander::new(continuous, -10.0, Some((15.0, 1.5))).unwrap();
    let walker = |hard| BipedalWalker::new(hard).unwrap();
    vec![
        Box::new(TaskBatch::new(lander(false), count, threads, autoreset).unwrap()),
        Box::new(TaskBatch::new(lander(true), count, threads, autoreset).unwrap()),
        Box::new(TaskBatch::new(walker(false), count, threads, autoreset).unwrap()),
        Box::new(TaskBatch::new(walker(true), count, threads, autoreset).unwrap()),
        Box::new(TaskBatch::new(Driving::new().unwrap(), count, threads, autoreset).unwrap()),
        Box::new(TaskBatch::new(Stacking::new().unwrap(), count, threads, autoreset).unwrap()),
        Box::new(TaskBatch::new(Ragdoll::new().unwrap(), count, threads, autoreset).unwrap()),
    ]
}

#[test]
fn tasks_are_equal_on_any_number_of_threads_and_after_going_back() {
    let twins =
        batches(5, 1, Autoreset::NextStep).into_iter().zip(batches(5, 3, Autoreset::NextStep));
    for (mut one, mut many) in twins {
        assert_eq!(one.names().len(), one.spec().observation);
        let random = Random::new(3);
        let run = |batch: &mut dyn Tasks, steps: usize| {
            let mut actions = random.clone();
            for _ in 0..steps {
                let actions = acts(batch, &mut actions);
                batch.step(&actions).unwrap();
                assert!(batch.observations().iter().all(|x| x.is_finite()));
            }
            (batch.observations().to_vec(), batch.state_hashes())
        };
        let first = run(&mut *one, 120);
        assert_eq!(first, run(&mut *many, 120));
        let bytes = one.to_bytes().unwrap();
        let second = run(&mut *one, 120);
        assert_ne!(first, second);
        many.restore_bytes(&bytes).unwrap();
        assert_eq!(second, run(&mut *many, 120));
        assert!(one.restore_bytes(&bytes[..bytes.len() / 2]).is_err());
    }
}

#[test]
fn a_seed_gives_the_same_episode_in_any_place() {
    for mut batch in batches(3, 1, Autoreset::Disabled) {
        let width = batch.spec().observation;
        batch.seed(&[7, 8, 7]).unwrap();
        batch.reset(None).unwrap();
        let seen = batch.observations();
        assert_eq!(seen[..width], seen[2 * width..]);
        assert_ne!(seen[..width], seen[width..2 * width]);
        let hashes = batch.state_hashes();
        assert_eq!(hashes[0], hashes[2]);
    }
}

#[test]
fn episodes_end_and_begin_as_the_mode_says() {
    let lander = || LunarLander::new(true, -10.0, None).unwrap();
    let fall = [-1.0, 0.0].repeat(2);
    let mut next = TaskBatch::new(lander(), 2, 1, Autoreset::NextStep).unwrap();
    let mut same = TaskBatch::new(lander(), 2, 1, Autoreset::SameStep).unwrap();
    let mut none = TaskBatch::new(lander(), 2, 1, Autoreset::Disabled).unwrap();
    let ended =
        |batch: &TaskBatch<LunarLander>| (0..2).find(|&i| batch.outcome(i).unwrap().0.terminated);
    let end = loop {
        [&mut next, &mut same, &mut none].into_iter().for_each(|batch| batch.step(&fall).unwrap());
        if let Some(end) = ended(&next) {
            break end;
        }
    };
    let row = end * 8..end * 8 + 8;
    assert_eq!((ended(&same), ended(&none)), (Some(end), Some(end)));
    let last = next.observations()[row.clone()].to_vec();
    assert_eq!(same.final_observation(end).unwrap(), last);
    assert_eq!(none.observations()[row.clone()], last);
    assert!(none.step(&fall).is_err());
    next.step(&fall).unwrap();
    assert_eq!(next.outcome(end).unwrap().0, Default::default());
    assert_ne!(next.observations()[row.clone()], last);
    let mask = [0, 1].map(|i| same.outcome(i).unwrap().0.terminated);
    none.reset(Some(&mask)).unwrap();
    assert_eq!(none.observations()[row.clone()], next.observations()[row]);
    none.step(&fall).unwrap();
}

#[test]
fn bad_actions_are_refused() {
    for mut batch in batches(2, 1, Autoreset::NextStep) {
        let count = 2 * batch.spec().action;
        let before = batch.state_hashes();
        assert!(batch.step(&vec![0.0; count + 1]).is_err());
        assert!(batch.step(&vec![f32::NAN; count]).is_err());
        assert!(batch.seed(&[1]).is_err());
        assert!(batch.reset(Some(&[true])).is_err());
        if batch.spec().choices.is_some() {
            assert!(batch.step(&vec![4.0; count]).is_err());
            assert!(batch.step(&vec![0.5; count]).is_err());
        }
        assert_eq!(batch.state_hashes(), before);
    }
}

/// Of the same form or not: another task, or the same with other options, or something behind the end.
#[test]
fn what_another_task_saved_is_refused() {
    let lander = |continuous, gravity, wind| {
        let task = LunarLander::new(continuous, gravity, wind).unwrap();
        Box::new(TaskBatch::new(task, 2, 1, Autoreset::NextStep).unwrap()) as Box<dyn Tasks>
    };
    let mut all = batches(2, 1, Autoreset::NextStep);
    all.push(lander(false, -10.0, None));
    all.push(lander(false, -9.0, None));
    all.push(lander(false, -10.0, Some((15.0, 1.0))));
    let saves: Vec<_> = all.iter_mut().map(|batch| batch.to_bytes().unwrap()).collect();
    for (i, batch) in all.iter_mut().enumerate() {
        for (j, save) in saves.iter().enumerate() {
            let before = batch.state_hashes();
            let told = batch.restore_bytes(save);
            assert_eq!(told.is_ok(), i == j, "{i} of {j}: {told:?}");
            assert_eq!(batch.state_hashes(), before);
        }
        let longer = [&saves[i][..], &[0]].concat();
        assert!(matches!(batch.restore_bytes(&longer), Err(BatchError::BadSave { .. })));
    }
    let told = all[2].restore_bytes(&saves[3]).unwrap_err().to_string();
    assert!(told.contains("hardcore"), "{told}");
    let (world, _, _) = template(1);
    let mut batch = WorldBatch::new(&[world], 2, 1).unwrap();
    let longer = [&batch.to_bytes().unwrap()[..], &[0]].concat();
    assert!(batch.restore_bytes(&longer).is_err());
}
