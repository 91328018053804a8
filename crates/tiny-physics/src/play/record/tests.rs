//! Recordings from inside: versions, damage, hooks.

use super::*;
use crate::{BodyId, Error, JointDef, RigidBody, Shape, SimdLevel, Vec2, World};

fn session(push: f32) -> Recorder {
    let mut recorder = Recorder::new(World::new(Vec2::new(0.0, -9.8)));
    let ground = RigidBody::fixed().shape(Shape::rect(20.0, 1.0).unwrap());
    recorder.apply(Command::AddBody(ground)).unwrap();
    let mut bodies: Vec<BodyId> = Vec::new();
    for step in 0..120 {
        if step % 10 == 0 {
            let place = Vec2::new((step % 7) as f32, 5.0);
            let body = RigidBody::dynamic().position(place).shape(Shape::rect(0.4, 0.3).unwrap());
            match recorder.apply(Command::AddBody(body)) {
                Ok(Made::Body(id)) => bodies.push(id),
                made => panic!("{made:?}"),
            }
        }
        if step == 40 {
            let joint = JointDef::distance(2.0);
            recorder.apply(Command::AddJoint(bodies[0], bodies[2], joint)).unwrap();
            recorder.apply(Command::RemoveBody(bodies.swap_remove(1))).unwrap();
        }
        if step == 90 {
            let command = BodyCommand::SetVelocity(Vec2::new(push, 3.0));
            recorder.apply(Command::Body(bodies[0], command)).unwrap();
        }
        recorder.step(1.0 / 60.0);
    }
    recorder
}

#[test]
fn playback_repeats_the_run() {
    let recorder = session(1.0);
    let recording = Recording::from_bytes(&recorder.recording().to_bytes()).unwrap();
    assert_eq!(&recording, recorder.recording());
    let mut player = Player::new(&recording).unwrap();
    player.seek(1000).unwrap();
    assert_eq!((player.at(), recording.len()), (120, 120));
    assert_eq!(player.world().state_hash(), recorder.world().state_hash());
    player.seek(45).unwrap();
    assert_eq!(Some(player.world().state_hash()), recording.hash(45));
}

#[test]
fn differences_are_found_where_they_begin() {
    let (a, b) = (session(1.0), session(1.001));
    assert_eq!(a.recording().first_difference(b.recording()), Some(91));
    assert_eq!(a.recording().first_difference(a.recording()), None);
    let mut wrong = a.recording().clone();
    wrong.steps[59].hash ^= 1;
    let mut player = Player::new(&wrong).unwrap();
    assert_eq!(player.seek(120), Err(Error::Differs { step: 60 }));
    assert_eq!(player.at(), 60);
}

#[test]
fn damaged_recordings_are_refused() {
    let bytes = session(1.0).recording().to_bytes();
    for length in (0..bytes.len()).step_by(101) {
        assert!(Recording::from_bytes(&bytes[..length]).is_err());
    }
}

/// A recording of an older or newer engine says so; nobody plays it wrongly.
#[test]
fn recordings_of_another_version_are_refused_with_the_reason() {
    let bytes = session(1.0).recording().to_bytes();
    let refusal = |at: usize| {
        let mut other = bytes.clone();
        other[at] += 1;
        Recording::from_bytes(&other).unwrap_err().to_string()
    };
    assert!(refusal(0).contains("does not begin like a recording"), "{}", refusal(0));
    assert!(refusal(3).contains("recording was written by another version"), "{}", refusal(3));
    // After the recording's own magic and the length of the first frame: the frame's magic and version.
    let frame = bytes.windows(4).position(|word| word == b"tpw1").expect("a first frame");
    assert!(refusal(frame + 4).contains("another version"), "{}", refusal(frame + 4));
}

/// Hooks are code: the one who plays brings them, and they stay when he goes back.
#[test]
fn a_world_with_hooks_is_played_in_one_with_hooks() {
    let equipped = || {
        let mut world = World::new(Vec2::new(0.0, -9.8));
        world.set_pair_filter(|pair| pair.user_data_a != 7 && pair.user_data_b != 7);
        world.set_pre_solve(|_, _, rules| rules.friction = 0.0);
        world
    };
    let mut world = equipped();
    let ground = Shape::rect(20.0, 1.0).unwrap();
    world.add_body(RigidBody::fixed().angle(0.1).shape(ground)).unwrap();
    let crates = |user_data| {
        let shape = crate::ShapeDef::new(Shape::rect(0.4, 0.3).unwrap()).user_data(user_data);
        RigidBody::dynamic().position(Vec2::new(0.0, 3.0)).shape(shape)
    };
    for data in [0, 7] {
        world.add_body(crates(data)).unwrap();
    }
    (0..90).for_each(|_| world.step(1.0 / 60.0));
    let mut recorder = Recorder::new(world);
    (0..60).for_each(|_| recorder.step(1.0 / 60.0));
    let (world, recording) = recorder.finish();

    let mut other = equipped();
    other.set_simd(SimdLevel::Scalar).unwrap();
    let mut player = Player::in_world(&recording, other).unwrap();
    for step in [60, 20, 60] {
        player.seek(step).unwrap();
        assert_eq!(Some(player.world().state_hash()), recording.hash(step));
        assert_eq!(player.world().simd(), SimdLevel::Scalar);
    }
    assert_eq!(player.world().to_bytes(), world.to_bytes());
    assert_eq!(Player::new(&recording).unwrap().seek(60), Err(Error::Differs { step: 1 }));
}

/// What no file could hold is not accepted, so that every recording can be read again.
#[test]
fn a_predicate_or_a_shape_that_is_none_is_refused() {
    use crate::{ForceZone, Pose, QueryFilter, ShapeDef, ZoneForce};
    let mut recorder = session(1.0);
    let bad = Shape::Circle { radius: f32::NAN };
    let force = ZoneForce::Acceleration(Vec2::X);
    let zone = ForceZone { shape: bad, pose: Pose::default(), force, wakes: true };
    let all = FilterData::default();
    recorder.apply(Command::ApplyZone(zone, all, 1.0 / 60.0)).unwrap_err();
    let body = recorder.world().body_ids().next().unwrap();
    let outline = [Vec2::ZERO, Vec2::X, Vec2::Y].to_vec();
    recorder.apply(Command::AddOutline(body, outline, ShapeDef::new(bad))).unwrap_err();
    recorder.step(1.0 / 60.0);
    Recording::from_bytes(&recorder.recording().to_bytes()).unwrap();
    let predicate = |_| true;
    assert!(FilterData::try_from(&QueryFilter::new().predicate(&predicate)).is_err());
    assert_eq!(FilterData::try_from(&QueryFilter::new()), Ok(all));
}
