//! `record`, `replay` and `diff`: runs as files.

use crate::args::{DiffArgs, RecordArgs, ReplayArgs};
use crate::failure::{Failure, Outcome};
use crate::source;
use std::fs;
use std::io::{Write, stdout};
use std::path::Path;
use tiny_physics::record::{Command, Made, Player, Recorder, Recording};
use tiny_physics::{
    Body, BodyId, CharacterMover, DVec2, Error, JointDef, JointId, MoverInput, RigidBody, Vec2,
    World,
};
use tiny_physics_scenes::{Deed, Host, Player as ScenePlayer};

/// Runs a scene and writes what was done.
///
/// # Errors
/// There is no such scene, something in it is refused, or the file cannot be written.
pub fn record(args: &RecordArgs) -> Outcome {
    let scene = source::open(&args.scene, args.seed)?;
    let world = World::with_settings(scene.gravity, scene.settings);
    let mut player = ScenePlayer::new(&scene, RecordingHost::new(world));
    let steps = args.steps.unwrap_or(scene.steps);
    while player.steps_done() < steps && player.host().error.is_none() {
        player.step();
    }
    let host = player.into_host();
    if let Some(error) = host.error {
        return Err(error.into());
    }
    let bytes = host.recorder.recording().to_bytes();
    fs::write(&args.output, &bytes)?;
    let hash = host.recorder.world().state_hash();
    writeln!(stdout(), "{steps} steps, {} bytes, state hash {hash:016x}", bytes.len())?;
    Ok(())
}

/// Plays a recording and compares every step.
///
/// # Errors
/// The file is no recording, or a step has other bits.
pub fn replay(args: &ReplayArgs) -> Outcome {
    let recording = load(&args.file)?;
    let mut player = Player::new(&recording)?;
    let played = player.seek(args.to.unwrap_or(recording.len()));
    played.map_err(|error| match error {
        Error::Differs { .. } => error.into(),
        _ => Failure::new(format!("{error} (at step {})", player.at() + 1)),
    })?;
    let hash = player.world().state_hash();
    writeln!(stdout(), "{} steps with the same bits, state hash {hash:016x}", player.at())?;
    Ok(())
}

/// Compares two recordings.
///
/// # Errors
/// A file is no recording, or they differ.
pub fn diff(args: &DiffArgs) -> Outcome {
    let (a, b) = (load(&args.a)?, load(&args.b)?);
    match a.first_difference(&b) {
        None => writeln!(stdout(), "alike in all {} steps", a.len())?,
        Some(0) => return Err(Failure::new("the first frames differ")),
        Some(step) if step > a.len() || step > b.len() => {
            return Err(Failure::new(format!("alike until one ends, before step {step}")));
        }
        Some(step) => {
            let hash = |recording: &Recording| recording.hash(step).unwrap_or_default();
            let (a, b) = (hash(&a), hash(&b));
            return Err(Failure::new(format!(
                "they differ from step {step}: {a:016x} and {b:016x}"
            )));
        }
    }
    Ok(())
}

fn load(path: &Path) -> Outcome<Recording> {
    let in_file =
        |error: &dyn std::fmt::Display| Failure::new(format!("{}: {error}", path.display()));
    let bytes = fs::read(path).map_err(|error| in_file(&error))?;
    Recording::from_bytes(&bytes).map_err(|error| in_file(&error))
}

/// Plays a scene on a recorder.
struct RecordingHost {
    recorder: Recorder,
    bodies: Vec<Option<BodyId>>,
    joints: Vec<Option<JointId>>,
    error: Option<Error>,
}

impl RecordingHost {
    fn new(world: World) -> Self {
        Self { recorder: Recorder::new(world), bodies: Vec::new(), joints: Vec::new(), error: None }
    }

    fn id(&self, body: usize) -> Option<BodyId> {
        self.bodies.get(body).copied().flatten()
    }

    fn body(&self, body: usize) -> Option<Body<'_>> {
        self.id(body).and_then(|id| self.recorder.world().body(id))
    }

    /// Does it, and keeps the first error.
    fn apply(&mut self, command: Command) -> Made {
        self.recorder.apply(command).unwrap_or_else(|error| {
            self.error.get_or_insert(error);
            Made::Nothing
        })
    }
}

impl Host for RecordingHost {
    fn add_body(&mut self, body: &RigidBody) -> usize {
        let made = self.apply(Command::AddBody(body.clone()));
        self.bodies.push(if let Made::Body(id) = made { Some(id) } else { None });
        self.bodies.len() - 1
    }

    fn remove_body(&mut self, body: usize) {
        if let Some(id) = self.id(body) {
            self.apply(Command::RemoveBody(id));
            self.bodies[body] = None;
        }
    }

    fn add_joint(&mut self, a: usize, b: usize, def: &JointDef) -> usize {
        let made = match (self.id(a), self.id(b)) {
            (Some(a), Some(b)) => self.apply(Command::AddJoint(a, b, *def)),
            _ => Made::Nothing,
        };
        self.joints.push(if let Made::Joint(id) = made { Some(id) } else { None });
        self.joints.len() - 1
    }

    fn remove_joint(&mut self, joint: usize) {
        if let Some(id) = self.joints.get_mut(joint).and_then(Option::take) {
            self.apply(Command::RemoveJoint(id));
        }
    }

    fn position(&self, body: usize) -> DVec2 {
        self.body(body).map_or(DVec2::ZERO, |body| body.position_f64())
    }

    fn velocity(&self, body: usize) -> Vec2 {
        self.body(body).map_or(Vec2::ZERO, |body| body.velocity())
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        let Some(id) = self.id(body) else { return };
        let spin = self.recorder.world().body(id).map_or(0.0, |body| body.angular_velocity());
        self.apply(Command::SetVelocity(id, velocity, spin));
    }

    fn set_angular_velocity(&mut self, body: usize, radians_per_second: f32) {
        let Some(id) = self.id(body) else { return };
        let Some(body) = self.recorder.world().body(id) else { return };
        if body.angular_velocity() != radians_per_second {
            let velocity = body.velocity();
            self.apply(Command::SetVelocity(id, velocity, radians_per_second));
        }
    }

    fn is_awake(&self, body: usize) -> bool {
        self.body(body).is_some_and(|body| body.is_awake())
    }

    fn wake(&mut self, body: usize) {
        if let Some(id) = self.id(body) {
            self.apply(Command::Wake(id));
        }
    }

    fn step(&mut self, dt: f32) {
        self.recorder.step(dt);
    }

    fn act(&mut self, _: &Deed, _: f32, _: f32) {
        let reason = "a recording holds no deeds of a timeline";
        self.error.get_or_insert(Error::Unsupported { reason });
    }

    fn move_character(&mut self, _: &mut CharacterMover, _: MoverInput, _: f32) {
        let reason = "a recording holds no character";
        self.error.get_or_insert(Error::Unsupported { reason });
    }
}
