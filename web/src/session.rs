//! A world with what belongs to it, and the functions that make, step, save and free it.

use crate::handles::Handle;
use crate::outcome::{Outcome, words};
use crate::{with, with_shelf};
use serde::Deserialize;
use tiny_physics::record::{Command, Made, Player, Recorder, Recording};
use tiny_physics::{BodyId, DVec2, Error, Settings, Vec2, World};
use tiny_physics_scenes::{Commanded, Grip, PausedScript, Scene, Tape};

/// A world, plain, recorded or with its history.
#[derive(Clone)]
enum Target {
    Plain(World),
    Recorded(Recorder),
    Kept(Box<Tape>),
}

/// What JavaScript calls a world.
#[derive(Clone)]
pub struct Session {
    target: Target,
    /// Of the scene, unless the history has it.
    script: Option<PausedScript>,
    /// Bodies of the scene, by their index in it.
    scene_bodies: Vec<f64>,
    /// Length of a step, seconds.
    dt: f32,
    pub(crate) grip: Option<Grip>,
    pub(crate) views: crate::views::Views,
    /// What the scene does to places.
    #[cfg(feature = "playground")]
    pub(crate) places: Vec<tiny_physics_scenes::Act>,
    #[cfg(feature = "playground")]
    pub(crate) picture: crate::picture::Picture,
    #[cfg(feature = "playground")]
    pub(crate) doctor: tiny_physics_doctor::Doctor,
}

/// What a new world is described by.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct WorldDef {
    gravity: Vec2,
    settings: Settings,
}

impl Default for WorldDef {
    fn default() -> Self {
        Self { gravity: Vec2::new(0.0, -9.8), settings: Settings::default() }
    }
}

impl Session {
    fn new(target: Target, script: Option<PausedScript>, dt: f32) -> Self {
        Self {
            target,
            script,
            scene_bodies: Vec::new(),
            dt,
            grip: None,
            views: Default::default(),
            #[cfg(feature = "playground")]
            places: Vec::new(),
            #[cfg(feature = "playground")]
            picture: Default::default(),
            #[cfg(feature = "playground")]
            doctor: Default::default(),
        }
    }

    fn of_world(world: World) -> Self {
        Self::new(Target::Plain(world), None, 1.0 / 60.0)
    }

    /// A scene at its beginning.
    pub(crate) fn of_scene(scene: &Scene) -> Outcome<Self> {
        let (script, world) = PausedScript::start(scene).map_err(words)?;
        let ids = (0..scene.bodies.len()).map(|body| script.body_id(body));
        let scene_bodies = ids.map(|id| id.map_or(-1.0, Handle::number)).collect();
        let script = scene.script.is_some().then_some(script);
        Ok(Self {
            scene_bodies,
            #[cfg(feature = "playground")]
            places: crate::places::of_scene(scene),
            ..Self::new(Target::Plain(world), script, scene.dt)
        })
    }

    /// The world, to read.
    pub(crate) fn world(&self) -> &World {
        match &self.target {
            Target::Plain(world) => world,
            Target::Recorded(recorder) => recorder.world(),
            Target::Kept(tape) => tape.world(),
        }
    }

    /// Does something to the world.
    pub(crate) fn apply(&mut self, command: Command) -> Outcome<Made> {
        self.views.stale = true;
        match &mut self.target {
            Target::Plain(world) => command.apply(world),
            Target::Recorded(recorder) => recorder.apply(command),
            Target::Kept(tape) => tape.apply(command),
        }
        .map_err(words)
    }

    /// Does what JavaScript asks for: what the engine passes over in silence is an error there.
    pub(crate) fn order(&mut self, command: Command) -> Outcome<Made> {
        let before = self.world().stats().refused_numbers;
        let made = self.apply(command)?;
        // Fewer where it went back to a frame.
        if self.world().stats().refused_numbers > before {
            return Err("a number is not finite, too large, or makes no sense".to_owned());
        }
        Ok(made)
    }

    fn step(&mut self, dt: f32) -> Outcome {
        let settings = &self.world().settings;
        settings.validate().map_err(words)?;
        if !(dt.is_finite() && dt > 0.0) {
            let value = dt.into();
            return Err(words(Error::OutOfRange { name: "dt", value, allowed: "above 0" }));
        }
        if let Some(pull) = self.grip.and_then(|grip| grip.pull(self.world(), dt)) {
            self.apply(pull)?;
        }
        match (&mut self.target, &mut self.script) {
            (Target::Plain(world), Some(script)) => script.before_step(world),
            (Target::Recorded(recorder), Some(script)) => script.before_step(recorder),
            _ => {}
        }
        match &mut self.target {
            Target::Plain(world) => world.step(dt),
            Target::Recorded(recorder) => recorder.step(dt),
            Target::Kept(tape) => Commanded::step(&mut **tape, dt),
        }
        self.views.stale = true;
        Ok(())
    }

    fn plain(&mut self) -> Outcome<&mut World> {
        match &mut self.target {
            Target::Plain(world) => Ok(world),
            _ => Err("the world is recorded already, or keeps its history".to_owned()),
        }
    }

    /// Its history.
    pub(crate) fn tape(&mut self) -> Outcome<&mut Tape> {
        match &mut self.target {
            Target::Kept(tape) => Ok(tape),
            _ => Err("the world keeps no history: call keepHistory() first".to_owned()),
        }
    }

    fn recording(&self) -> Outcome<&Recording> {
        match &self.target {
            Target::Plain(_) => {
                Err("the world is not recorded: call startRecording() first".to_owned())
            }
            Target::Recorded(recorder) => Ok(recorder.recording()),
            Target::Kept(tape) => Ok(tape.history().recording()),
        }
    }

    /// What is done before the step that comes next in the history; at its end, what was done before the last.
    #[cfg(feature = "playground")]
    pub(crate) fn commands(&self) -> &[Command] {
        let Target::Kept(tape) = &self.target else { return &[] };
        let history = tape.history();
        history.recording().commands(history.len().min(history.at() + 1))
    }
}

/// A world of the description in the input; 0 where that is wrong.
#[unsafe(no_mangle)]
pub extern "C" fn tp_new() -> u32 {
    with_shelf(|shelf| {
        let world = |def: WorldDef| {
            def.settings.validate().map_err(words)?;
            if !def.gravity.is_finite() {
                return Err("gravity is not finite".to_owned());
            }
            Ok(Session::of_world(World::with_settings(def.gravity, def.settings)))
        };
        let session = shelf.read().and_then(world);
        shelf.put(session)
    })
}

/// The scene file in the input, at its beginning; the numbers are the handles of its bodies.
#[unsafe(no_mangle)]
pub extern "C" fn tp_new_scene() -> u32 {
    with_shelf(|shelf| {
        let scene = shelf.input_text().and_then(|text| Scene::from_json(text).map_err(words));
        let session = scene.and_then(|scene| Session::of_scene(&scene));
        if let Ok(session) = &session {
            shelf.count(session.scene_bodies.iter().copied());
        }
        shelf.put(session)
    })
}

/// The saved frame in the input, whose steps take `dt` seconds.
#[unsafe(no_mangle)]
pub extern "C" fn tp_new_frame(dt: f32) -> u32 {
    with_shelf(|shelf| {
        let world = World::from_bytes(&shelf.input).map_err(words);
        shelf.put(world.map(|world| Session { dt, ..Session::of_world(world) }))
    })
}

/// The recording in the input, at its beginning, with its history.
#[unsafe(no_mangle)]
pub extern "C" fn tp_new_recording(budget: f64) -> u32 {
    with_shelf(|shelf| {
        let recording = Recording::from_bytes(&shelf.input);
        let tape = recording.and_then(|recording| Tape::of_recording(recording, budget as usize));
        let session = tape.map_err(words).map(|tape| {
            let dt = tape.dt();
            Session::new(Target::Kept(Box::new(tape)), None, dt)
        });
        shelf.put(session)
    })
}

/// A copy that goes on by itself.
#[unsafe(no_mangle)]
pub extern "C" fn tp_clone(session: u32) -> u32 {
    with_shelf(|shelf| {
        let mut copy = Err("this world has been freed".to_owned());
        shelf.with(session, |session, _| {
            copy = Ok(session.clone());
            Ok(())
        });
        shelf.put(copy)
    })
}

/// Drops a world.
#[unsafe(no_mangle)]
pub extern "C" fn tp_free(session: u32) {
    with_shelf(|shelf| shelf.free(session));
}

/// Steps by `dt` seconds; by the scene's own step where it is 0.
#[unsafe(no_mangle)]
pub extern "C" fn tp_step(session: u32, dt: f32) -> bool {
    with(session, |session, _| session.step(if dt == 0.0 { session.dt } else { dt }))
}

/// Length of a step of the scene, seconds.
#[unsafe(no_mangle)]
pub extern "C" fn tp_dt(session: u32) -> f32 {
    let mut dt = 0.0;
    with(session, |session, _| {
        dt = session.dt;
        Ok(())
    });
    dt
}

/// The state hash.
#[unsafe(no_mangle)]
pub extern "C" fn tp_hash(session: u32) -> u64 {
    let mut hash = 0;
    with(session, |session, _| {
        hash = session.world().state_hash();
        Ok(())
    });
    hash
}

/// The frame as text.
#[unsafe(no_mangle)]
pub extern "C" fn tp_save(session: u32) -> bool {
    with(session, |session, shelf| {
        shelf.say(session.world().to_bytes());
        Ok(())
    })
}

/// What differs from the frame in the input, as text.
#[unsafe(no_mangle)]
pub extern "C" fn tp_delta(session: u32) -> bool {
    with(session, |session, shelf| {
        shelf.say(session.world().delta_from(&shelf.input));
        Ok(())
    })
}

/// Goes to the frame in the input. Where `frame` is not 0 the input is a frame of that many bytes and a difference.
#[unsafe(no_mangle)]
pub extern "C" fn tp_restore(session: u32, frame: usize) -> bool {
    with(session, |session, shelf| {
        session.views.stale = true;
        let input = &shelf.input;
        if frame == 0 {
            session.apply(Command::RestoreBytes(input.clone())).map(drop)
        } else {
            let (frame, delta) = input.split_at_checked(frame).ok_or("the input is too short")?;
            session.plain()?.restore_delta(frame, delta).map_err(words)
        }
    })
}

/// From now on everything that is done is recorded.
#[unsafe(no_mangle)]
pub extern "C" fn tp_record(session: u32) -> bool {
    with(session, |session, _| {
        let world = core::mem::replace(session.plain()?, World::new(Vec2::ZERO));
        session.target = Target::Recorded(Recorder::new(world));
        Ok(())
    })
}

/// The recording so far, as text.
#[unsafe(no_mangle)]
pub extern "C" fn tp_recording(session: u32) -> bool {
    with(session, |session, shelf| {
        shelf.say(session.recording()?.to_bytes());
        Ok(())
    })
}

/// Plays the recording in the input and compares every step; the number is how many there are.
#[unsafe(no_mangle)]
pub extern "C" fn tp_check_recording() -> bool {
    with_shelf(|shelf| {
        let played = Recording::from_bytes(&shelf.input).and_then(|recording| {
            let mut player = Player::new(&recording)?;
            player.seek(recording.len()).map(|()| recording.len())
        });
        shelf.count(played.iter().map(|steps| *steps as f64));
        shelf.say(played.as_ref().err().map(words).unwrap_or_default());
        played.is_ok()
    })
}

/// From now on the run can be gone back in; about so many bytes are kept.
#[unsafe(no_mangle)]
pub extern "C" fn tp_keep(session: u32, budget: f64) -> bool {
    with(session, |session, _| {
        let world = core::mem::replace(session.plain()?, World::new(Vec2::ZERO));
        let tape = Tape::of_world(world, session.script.take(), session.dt, budget as usize);
        session.target = Target::Kept(Box::new(tape));
        Ok(())
    })
}

/// Goes to a step of the history.
#[unsafe(no_mangle)]
pub extern "C" fn tp_go_to(session: u32, step: u32) -> bool {
    with(session, |session, _| {
        session.views.stale = true;
        session.grip = None;
        session.tape()?.go_to(step as usize).map_err(words)
    })
}

/// Forgets what came after the current step.
#[unsafe(no_mangle)]
pub extern "C" fn tp_forget_later(session: u32) -> bool {
    with(session, |session, _| {
        session.tape()?.forget_later();
        Ok(())
    })
}

/// Numbers of the history: steps to here, steps that are kept, bytes.
#[unsafe(no_mangle)]
pub extern "C" fn tp_history(session: u32) -> bool {
    with(session, |session, shelf| {
        let history = session.tape()?.history();
        shelf.count([history.at(), history.len(), history.bytes()].map(|count| count as f64));
        Ok(())
    })
}

/// Takes the dynamic body at a point, to pull it: the number is its handle; none where there is none.
#[unsafe(no_mangle)]
pub extern "C" fn tp_grab(session: u32, x: f64, y: f64) -> bool {
    with(session, |session, shelf| {
        session.grip = Grip::take(session.world(), DVec2::new(x, y));
        shelf.count(session.grip.map(|grip| grip.body.number()));
        Ok(())
    })
}

/// Moves the point to which the held body is pulled; the numbers are where it is held, if it is.
#[unsafe(no_mangle)]
pub extern "C" fn tp_drag(session: u32, x: f64, y: f64) -> bool {
    with(session, |session, shelf| {
        shelf.numbers.clear();
        if let Some(grip) = &mut session.grip {
            grip.target = DVec2::new(x, y);
        }
        let held = session.grip.and_then(|grip| grip.point(session.world()));
        shelf.count(held.into_iter().flat_map(|point| [point.x, point.y]));
        Ok(())
    })
}

/// Lets go.
#[unsafe(no_mangle)]
pub extern "C" fn tp_release(session: u32) -> bool {
    with(session, |session, _| {
        session.grip = None;
        Ok(())
    })
}

/// Is the handle one of this world's bodies?
#[unsafe(no_mangle)]
pub extern "C" fn tp_has_body(session: u32, body: f64) -> bool {
    with(session, |session, _| match session.world().body(BodyId::of(body)) {
        Some(_) => Ok(()),
        None => Err(words(Error::from(BodyId::of(body)))),
    })
}
