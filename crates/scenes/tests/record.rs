//! Every scene can be recorded and is played again bit for bit.

use tiny_physics::record::{Player as Replay, Recording};
use tiny_physics_scenes::{CommandHost, Entry, Options, Player, Run, Scene, all, tags};

/// Bodies times steps that a scene may take, so that the test stays short.
const WORK: usize = 60_000;

/// As many steps as the bodies of a scene allow.
fn steps(scene: &Scene) -> u32 {
    ((WORK / scene.bodies.len().max(100)) as u32).clamp(3, 300).min(scene.steps)
}

fn record(entry: &Entry, scene: &Scene, steps: u32) -> Recording {
    let host = CommandHost::recording(scene.gravity, scene.settings);
    let mut player = Player::new(scene, host);
    (0..steps).for_each(|_| player.step());
    assert_eq!(player.host().error(), None, "{}", entry.name);
    let bytes = player.host().recorder().recording().to_bytes();
    Recording::from_bytes(&bytes).expect(entry.name)
}

#[test]
fn every_scene_is_recorded_and_played_again() {
    for entry in all().iter().filter(|entry| !entry.has_tag(tags::HUGE)) {
        let scene = entry.build(Options::default());
        let steps = steps(&scene);
        let recording = record(entry, &scene, steps);
        let mut replay = Replay::new(&recording).expect(entry.name);
        assert_eq!(replay.seek(usize::MAX), Ok(()), "{}", entry.name);
        // As it goes where nobody records.
        let mut run = Run::start(&scene).expect(entry.name);
        (0..steps).for_each(|_| run.step());
        let hash = run.world().state_hash();
        assert_eq!(
            (replay.at(), replay.world().state_hash()),
            (steps as usize, hash),
            "{}",
            entry.name
        );
    }
}

/// What happens in a scene is in its recording as commands.
#[test]
fn deeds_and_characters_are_commands() {
    let kinds = |name: &str| {
        let entry = tiny_physics_scenes::find(name).expect(name);
        let scene = entry.build(Options::default());
        let recording = record(entry, &scene, 300);
        let commands = (1..=300).flat_map(|step| recording.commands(step));
        commands.map(|command| format!("{command:?}")).collect::<Vec<_>>().join("\n")
    };
    for (scene, expected) in [
        ("character", "MoveCharacter"),
        ("harbour", "ApplyWater"),
        ("blast", "Explode"),
        ("orbits", "ApplyZone"),
        ("changing", "SetMaterial"),
        ("platforms", "SetTarget"),
    ] {
        assert!(kinds(scene).contains(expected), "{scene} has no {expected}");
    }
}
