//! Worlds, recordings, characters and handles in files of any format (feature `serde`).
#![cfg(feature = "serde")]

mod common;

use common::*;
use serde::de::value::SeqDeserializer;
use serde::{Deserialize, Serialize};
use tiny_physics::record::{BodyCommand, Command, Recorder, Recording};
use tiny_physics::*;

/// What a game saves: the world, and its own things beside it.
#[derive(Serialize, Deserialize, Debug)]
struct Saved {
    level: u32,
    world: World,
    hero: CharacterMover,
    body: BodyId,
    shapes: Vec<ShapeId>,
    joint: JointId,
    tiles: TileGridId,
    replay: Recording,
}

fn saved() -> Saved {
    let mut world = mixed_pile(30, 2);
    let grid = TileGrid::parse(1.0, &["....", "####"]).unwrap();
    let tiles = world.add_tiles(grid.position(Vec2::new(30.0, 0.0))).unwrap();
    let [body, other] = [1.0, 3.0].map(|x| drop_at(&mut world, circle(0.3), x, 9.0));
    let joint = world.add_joint(body, other, JointDef::distance(2.0)).unwrap();
    let mut hero = CharacterMover::new(Vec2::new(31.0, 2.0), 1.6, 0.3);
    for _ in 0..40 {
        world.step(DT);
        hero.update(&mut world, MoverInput { walk: 0.37, ..MoverInput::default() }, DT);
    }
    assert!(hero.ground().is_some());
    let mut recorder = Recorder::new(world.clone());
    for _ in 0..10 {
        let push = BodyCommand::ApplyImpulseToCenter(Vec2::X);
        recorder.apply(Command::Body(body, push)).unwrap();
        recorder.step(DT);
    }
    let shapes = world.body(body).unwrap().shapes().collect();
    let replay = recorder.finish().1;
    Saved { level: 3, world, hero, body, shapes, joint, tiles, replay }
}

fn assert_alike(a: &Saved, b: &Saved) {
    assert_eq!(a.world.to_bytes(), b.world.to_bytes());
    assert_eq!((a.level, &a.hero, a.body, &a.shapes), (b.level, &b.hero, b.body, &b.shapes));
    assert_eq!((a.joint, a.tiles, &a.replay), (b.joint, b.tiles, &b.replay));
    let (mut a, mut b) = ((a.world.clone(), a.hero.clone()), (b.world.clone(), b.hero.clone()));
    for _ in 0..30 {
        for (world, hero) in [&mut a, &mut b] {
            world.step(DT);
            hero.update(world, MoverInput { walk: -0.4, ..MoverInput::default() }, DT);
        }
        assert_eq!((a.0.state_hash(), &a.1), (b.0.state_hash(), &b.1));
    }
}

#[test]
fn a_game_is_saved_as_text() {
    let saved = saved();
    let text = serde_json::to_string_pretty(&saved).unwrap();
    assert_alike(&saved, &serde_json::from_str(&text).unwrap());
    // A string in base64, not a list of numbers.
    let size = saved.world.to_bytes().len() + saved.replay.to_bytes().len();
    assert!(text.len() < size * 4 / 3 + 3000, "{} for {size}", text.len());
    // By way of a tree of values.
    let tree = serde_json::to_value(&saved).unwrap();
    assert_alike(&saved, &serde_json::from_value(tree).unwrap());
}

#[test]
fn a_game_is_saved_as_bytes() {
    let saved = saved();
    let bytes = bincode::serialize(&saved).unwrap();
    assert_alike(&saved, &bincode::deserialize(&bytes).unwrap());
    let size = saved.world.to_bytes().len() + saved.replay.to_bytes().len();
    assert!(bytes.len() < size + 400, "{} for {size}", bytes.len());
}

/// Some formats give bytes as a list of numbers.
#[test]
fn a_list_of_numbers_is_read_too() {
    let world = saved().world;
    let numbers = world.to_bytes().into_iter();
    let list = SeqDeserializer::<_, serde::de::value::Error>::new(numbers);
    let read = World::deserialize(list).unwrap();
    assert_eq!(read.to_bytes(), world.to_bytes());
}

#[test]
fn what_is_cut_off_or_damaged_is_refused_with_the_reason() {
    let saved = saved();
    let bytes = bincode::serialize(&saved).unwrap();
    for length in (0..bytes.len()).step_by(997).chain([bytes.len() - 1]) {
        assert!(bincode::deserialize::<Saved>(&bytes[..length]).is_err(), "{length}");
    }
    // A world that is cut off inside of a string that is whole.
    let cut = |value: &[u8]| bincode::serialize(&value).unwrap();
    let world = saved.world.to_bytes();
    for length in (0..world.len()).step_by(497) {
        let error = bincode::deserialize::<World>(&cut(&world[..length])).unwrap_err();
        assert!(error.to_string().contains("not a frame that can be read"), "{error}");
    }
    let replay = saved.replay.to_bytes();
    let error = bincode::deserialize::<Recording>(&cut(&replay[..replay.len() - 3])).unwrap_err();
    assert!(error.to_string().contains("it ends too early"), "{error}");
    let error = bincode::deserialize::<Recording>(&cut(&world)).unwrap_err();
    assert!(error.to_string().contains("does not begin like a recording"), "{error}");

    let text = serde_json::to_string(&saved.world).unwrap();
    let refusal = |text: &str| serde_json::from_str::<World>(text).unwrap_err().to_string();
    assert!(refusal(&text[..text.len() / 2]).contains("EOF"), "{}", refusal(&text[..99]));
    let half = format!("{}\"", &text[..text.len() / 8 * 4 + 1]);
    assert!(refusal(&half).contains("too early or too late"), "{}", refusal(&half));
    let wrong = text.replacen('A', "?", 1);
    assert!(refusal(&wrong).contains("a saved world is not base64"), "{}", refusal(&wrong));
    assert!(refusal("7").contains("as text in base64"), "{}", refusal("7"));
    let other = serde_json::to_string(&saved.replay).unwrap();
    assert!(refusal(&other).contains("does not begin like one"), "{}", refusal(&other));
}

#[test]
fn statistics_are_data() {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    world.time_stages(true);
    world.step(1.0 / 60.0);
    let text = serde_json::to_string(world.stats()).unwrap();
    assert_eq!(&serde_json::from_str::<tiny_physics::Stats>(&text).unwrap(), world.stats());
    assert_eq!(
        serde_json::to_string(&tiny_physics::Stage::NarrowPhase).unwrap(),
        "\"narrow_phase\""
    );
}
