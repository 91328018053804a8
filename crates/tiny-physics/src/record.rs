//! Recordings: the first frame of a run and every command since, so that the run can be played again, bit for
//! bit, on any platform.
//!
//! Send what changes the world through a [`Recorder`] as [`Command`]s. A [`Recording`] also keeps the state hash
//! of every step, so that a playback that differs, by another version of the engine or by a change that went past
//! the recorder, is found at the first step and not believed.
//!
//! ```
//! use tiny_physics::record::{Command, Player, Recorder, Recording};
//! use tiny_physics::{RigidBody, Shape, Vec2, World};
//! # fn main() -> Result<(), tiny_physics::Error> {
//! let mut recorder = Recorder::new(World::new(Vec2::new(0.0, -9.8)));
//! let ball = RigidBody::new(Shape::circle(0.5)?, Vec2::ZERO, 1.0);
//! recorder.apply(Command::AddBody(ball))?;
//! (0..60).for_each(|_| recorder.step(1.0 / 60.0));
//! let bytes = recorder.recording().to_bytes();
//!
//! let recording = Recording::from_bytes(&bytes)?;
//! let mut player = Player::new(&recording)?;
//! player.seek(60)?;
//! assert_eq!(player.world().state_hash(), recorder.world().state_hash());
//! # Ok(())
//! # }
//! ```

use crate::codec::{Data, Reader, Sink, Writer, bad, data};
use crate::describe::{JointDef, RigidBody, Settings, ShapeDef};
use crate::error::Error;
use crate::math::{DVec2, Vec2};
use crate::world::{BodyId, JointId, ShapeId, World};

/// The first bytes of a recording.
const MAGIC: [u8; 4] = *b"tpr1";

/// Something that is done to a world between two steps.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum Command {
    /// [`World::add_body`].
    AddBody(RigidBody),
    /// [`World::remove_body`].
    RemoveBody(BodyId),
    /// [`World::add_shape`].
    AddShape(BodyId, ShapeDef),
    /// [`World::remove_shape`].
    RemoveShape(ShapeId),
    /// [`World::add_joint`].
    AddJoint(BodyId, BodyId, JointDef),
    /// [`World::set_joint`].
    SetJoint(JointId, JointDef),
    /// [`World::remove_joint`].
    RemoveJoint(JointId),
    /// Position (metres, world) and angle (radians): a teleport.
    SetPlace(BodyId, DVec2, f32),
    /// Velocity, metres a second, and angular velocity, radians a second.
    SetVelocity(BodyId, Vec2, f32),
    /// Force at the centre of mass, newtons, and torque, newton metres, for the next step.
    ApplyForce(BodyId, Vec2, f32),
    /// Impulse, newton seconds, at a world point.
    ApplyImpulse(BodyId, Vec2, DVec2),
    /// Wakes a body and its island.
    Wake(BodyId),
    /// Puts a body to sleep.
    Sleep(BodyId),
    /// Gravity of the world, metres a second squared.
    SetGravity(Vec2),
    /// Settings of the world.
    SetSettings(Settings),
}

/// What a command made.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Made {
    /// Nothing new.
    Nothing,
    /// A body.
    Body(BodyId),
    /// A shape.
    Shape(ShapeId),
    /// A joint.
    Joint(JointId),
}

impl Command {
    /// Does it to a world.
    ///
    /// # Errors
    /// Those of the function that the command stands for; a stale handle where that would do nothing.
    pub fn apply(&self, world: &mut World) -> Result<Made, Error> {
        match self {
            Self::AddBody(body) => return world.add_body(body.clone()).map(Made::Body),
            Self::RemoveBody(body) => world.remove_body(*body)?,
            Self::AddShape(body, shape) => {
                return world.add_shape(*body, shape.clone()).map(Made::Shape);
            }
            Self::RemoveShape(shape) => world.remove_shape(*shape)?,
            Self::AddJoint(a, b, def) => return world.add_joint(*a, *b, *def).map(Made::Joint),
            Self::SetJoint(joint, def) => world.set_joint(*joint, *def)?,
            Self::RemoveJoint(joint) => world.remove_joint(*joint)?,
            Self::SetGravity(gravity) => world.gravity = *gravity,
            Self::SetSettings(settings) => world.settings = *settings,
            Self::SetPlace(body, ..)
            | Self::SetVelocity(body, ..)
            | Self::ApplyForce(body, ..)
            | Self::ApplyImpulse(body, ..)
            | Self::Wake(body)
            | Self::Sleep(body) => self.apply_to_body(world, *body)?,
        }
        Ok(Made::Nothing)
    }

    fn apply_to_body(&self, world: &mut World, id: BodyId) -> Result<(), Error> {
        let mut body = world.body_mut(id).ok_or_else(|| Error::from(id))?;
        match self {
            Self::SetPlace(_, position, angle) => {
                body.set_position(*position);
                body.set_angle(*angle);
            }
            Self::SetVelocity(_, velocity, angular) => {
                body.set_velocity(*velocity);
                body.set_angular_velocity(*angular);
            }
            Self::ApplyForce(_, force, torque) => {
                body.apply_force_to_center(*force);
                body.apply_torque(*torque);
            }
            Self::ApplyImpulse(_, impulse, point) => body.apply_impulse(*impulse, *point),
            Self::Wake(_) => body.wake(),
            Self::Sleep(_) => body.sleep(),
            _ => {}
        }
        Ok(())
    }
}

/// A number, which never changes, and the parts of the command.
macro_rules! command_data {
    ($($tag:literal => $name:ident($($part:ident),*),)*) => {
        impl Data for Command {
            fn save(&self, sink: &mut impl Sink) {
                match self {
                    $(Self::$name($($part),*) => {
                        sink.u8($tag);
                        $(Data::save($part, sink);)*
                    })*
                }
            }
            fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
                Ok(match u8::load(reader)? {
                    $($tag => {
                        $(let $part = Data::load(reader)?;)*
                        Self::$name($($part),*)
                    })*
                    _ => return Err(bad("a command is unknown")),
                })
            }
        }
    };
}

command_data! {
    0 => AddBody(body),
    1 => RemoveBody(body),
    2 => AddShape(body, shape),
    3 => RemoveShape(shape),
    4 => AddJoint(a, b, def),
    5 => SetJoint(joint, def),
    6 => RemoveJoint(joint),
    7 => SetPlace(body, position, angle),
    8 => SetVelocity(body, velocity, angular),
    9 => ApplyForce(body, force, torque),
    10 => ApplyImpulse(body, impulse, point),
    11 => Wake(body),
    12 => Sleep(body),
    13 => SetGravity(gravity),
    14 => SetSettings(settings),
}

/// One step of a recording.
#[derive(Clone, PartialEq, Debug)]
struct Step {
    /// What was done before it.
    commands: Vec<Command>,
    dt: f32,
    /// State hash after it.
    hash: u64,
}

data!(Step { commands, dt, hash });

/// A run: its first frame and what was done in each step.
#[derive(Clone, PartialEq, Debug)]
pub struct Recording {
    first: Vec<u8>,
    steps: Vec<Step>,
}

impl Recording {
    /// Steps in it.
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Is there no step?
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// The state hash after a step, counted from 1.
    pub fn hash(&self, step: usize) -> Option<u64> {
        self.steps.get(step.checked_sub(1)?).map(|step| step.hash)
    }

    /// As bytes for a file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut writer = Writer(MAGIC.to_vec());
        self.first.save(&mut writer);
        self.steps.save(&mut writer);
        writer.0
    }

    /// The recording of [`Recording::to_bytes`].
    ///
    /// # Errors
    /// The bytes are no recording, or a damaged one, or its first frame is of another version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        let mut reader = Reader(bytes);
        if <[u8; 4]>::load(&mut reader)? != MAGIC {
            return Err(bad("it does not begin like a recording"));
        }
        let recording = Self { first: Data::load(&mut reader)?, steps: Data::load(&mut reader)? };
        reader.finish()?;
        World::from_bytes(&recording.first).map(|_| recording)
    }

    /// The first step, counted from 1, after which two recordings differ in state; the first that only one has;
    /// `None` where they are alike. 0 is the first frame.
    pub fn first_difference(&self, other: &Self) -> Option<usize> {
        if self.first != other.first {
            return Some(0);
        }
        let steps = self.steps.iter().zip(&other.steps);
        let unlike = steps.map(|(a, b)| a.hash != b.hash).position(|unlike| unlike);
        let shorter = self.len().min(other.len());
        unlike.or((self.len() != other.len()).then_some(shorter)).map(|index| index + 1)
    }
}

/// Records what is done to a world.
#[derive(Clone, Debug)]
pub struct Recorder {
    world: World,
    recording: Recording,
    commands: Vec<Command>,
}

impl Recorder {
    /// Starts a recording with the world as it is.
    pub fn new(world: World) -> Self {
        let recording = Recording { first: world.to_bytes(), steps: Vec::new() };
        Self { world, recording, commands: Vec::new() }
    }

    /// The world, to read.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Does something to the world and notes it. What is refused is not noted.
    ///
    /// # Errors
    /// As [`Command::apply`].
    pub fn apply(&mut self, command: Command) -> Result<Made, Error> {
        let made = command.apply(&mut self.world)?;
        self.commands.push(command);
        Ok(made)
    }

    /// Moves the world on and notes it.
    pub fn step(&mut self, dt: f32) {
        self.world.step(dt);
        let commands = core::mem::take(&mut self.commands);
        self.recording.steps.push(Step { commands, dt, hash: self.world.state_hash() });
    }

    /// What has been recorded so far. Commands since the last step are not in it yet.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }
}

/// Plays a recording.
#[derive(Clone, Debug)]
pub struct Player<'a> {
    recording: &'a Recording,
    world: World,
    at: usize,
}

impl<'a> Player<'a> {
    /// Begins at the first frame.
    ///
    /// # Errors
    /// The first frame cannot be read.
    pub fn new(recording: &'a Recording) -> Result<Self, Error> {
        Ok(Self { recording, world: World::from_bytes(&recording.first)?, at: 0 })
    }

    /// The world as of the current step.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Steps played.
    pub fn at(&self) -> usize {
        self.at
    }

    /// Plays one step; false at the end.
    ///
    /// # Errors
    /// [`Error::Differs`] when the state is not the one that was recorded; or a command is refused that was not.
    pub fn step(&mut self) -> Result<bool, Error> {
        let Some(step) = self.recording.steps.get(self.at) else { return Ok(false) };
        for command in &step.commands {
            command.apply(&mut self.world)?;
        }
        self.world.step(step.dt);
        self.at += 1;
        if self.world.state_hash() == step.hash {
            Ok(true)
        } else {
            Err(Error::Differs { step: self.at })
        }
    }

    /// Goes to the state after that many steps, at most to the end. Going back starts from the first frame.
    ///
    /// # Errors
    /// As [`Player::step`].
    pub fn seek(&mut self, step: usize) -> Result<(), Error> {
        if step < self.at {
            // Anew, not in place: handles have to come out as they did.
            *self = Self::new(self.recording)?;
        }
        while self.at < step && self.step()? {}
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Shape;

    fn session(push: f32) -> Recorder {
        let mut recorder = Recorder::new(World::new(Vec2::new(0.0, -9.8)));
        let ground = RigidBody::fixed().shape(Shape::rect(20.0, 1.0).unwrap());
        recorder.apply(Command::AddBody(ground)).unwrap();
        let mut bodies = Vec::new();
        for step in 0..120 {
            if step % 10 == 0 {
                let place = Vec2::new((step % 7) as f32, 5.0);
                let body =
                    RigidBody::dynamic().position(place).shape(Shape::rect(0.4, 0.3).unwrap());
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
                let command = Command::SetVelocity(bodies[0], Vec2::new(push, 3.0), 1.0);
                recorder.apply(command).unwrap();
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
        assert!(refusal(3).contains("does not begin like a recording"), "{}", refusal(3));
        // After the recording's own magic and the length of the first frame: the frame's magic and version.
        let frame = bytes.windows(4).position(|word| word == b"tpw1").expect("a first frame");
        assert!(refusal(frame + 4).contains("another version"), "{}", refusal(frame + 4));
    }
}
