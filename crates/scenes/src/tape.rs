//! A scene's run that can go back, be changed there, and go on.

use crate::scene::Scene;
use crate::world_host::{Commanded, PausedScript};
use tiny_physics::record::{Command, History, Made, Recording};
use tiny_physics::{Error, World};

/// Steps between two marks of a script.
const MARKS: usize = 60;
/// They may be farther apart by this part of their age: what goes on from long ago may take longer, and a long run has
/// few more marks than a short one.
const FADING: usize = 16;

/// A [`History`] with the script of a scene: where the run goes on from a step in the past, so does the script.
///
/// ```
/// use tiny_physics_scenes::{Options, Tape, find};
/// let scene = find("rain")?.build(Options::default());
/// let mut tape = Tape::of_scene(&scene, 64 << 20)?;
/// (0..100).for_each(|_| tape.step());
/// let end = tape.history().world().state_hash();
/// tape.go_to(40)?;
/// tape.forget_later();
/// (0..60).for_each(|_| tape.step());
/// assert_eq!(tape.history().world().state_hash(), end);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Tape {
    history: History,
    script: Option<PausedScript>,
    /// How far the script has come: steps.
    script_at: usize,
    /// The script before some of the steps.
    marks: Vec<(usize, PausedScript)>,
    /// How many commands of each step are not the script's.
    own: Vec<u32>,
    /// The same of the step that is to come.
    own_now: u32,
    dt: f32,
}

impl Tape {
    /// Begins a scene; about `budget` bytes are kept.
    ///
    /// # Errors
    /// A body or joint that the world refuses.
    pub fn of_scene(scene: &Scene, budget: usize) -> Result<Self, Error> {
        let (script, world) = PausedScript::start(scene)?;
        let script = scene.script.is_some().then_some(script);
        Ok(Self::of_world(world, script, scene.dt, budget))
    }

    /// Begins with a world as it is, and the script that goes on in it with steps of `dt` seconds.
    pub fn of_world(world: World, script: Option<PausedScript>, dt: f32, budget: usize) -> Self {
        Self::new(History::new(world, budget), script, dt)
    }

    /// Opens a recording at its beginning. What acted in it acts no more where it is gone on from.
    ///
    /// # Errors
    /// Its first frame cannot be read.
    pub fn of_recording(recording: Recording, budget: usize) -> Result<Self, Error> {
        let dt = recording.dt(1).unwrap_or(1.0 / 60.0);
        Ok(Self::new(History::open(recording, budget)?, None, dt))
    }

    fn new(history: History, script: Option<PausedScript>, dt: f32) -> Self {
        let marks = script.iter().map(|script| (0, script.clone())).collect();
        Self { history, script, script_at: 0, marks, own: Vec::new(), own_now: 0, dt }
    }

    /// The run so far.
    pub fn history(&self) -> &History {
        &self.history
    }

    /// The world as of the current step.
    pub fn world(&self) -> &World {
        self.history.world()
    }

    /// Length of a step, seconds.
    pub fn dt(&self) -> f32 {
        self.dt
    }

    /// The first thing of the script that the world refused.
    pub fn error(&self) -> Option<&Error> {
        self.script.as_ref()?.error()
    }

    /// Does something to the world. What came after the current step is forgotten.
    ///
    /// # Errors
    /// As [`Command::apply`].
    pub fn apply(&mut self, command: Command) -> Result<Made, Error> {
        self.catch_up();
        let made = self.history.apply(command)?;
        self.own_now += 1;
        Ok(made)
    }

    /// Forgets what came after the current step.
    pub fn forget_later(&mut self) {
        self.history.forget_later();
    }

    /// A new step; what came after the current one is forgotten.
    pub fn step(&mut self) {
        self.catch_up();
        self.history.forget_later();
        let at = self.history.at();
        if let Some(script) = &mut self.script {
            if at.is_multiple_of(MARKS) && self.marks.last().is_some_and(|(step, _)| *step < at) {
                self.marks.push((at, script.clone()));
                thin_out(&mut self.marks);
            }
            script.before_step(&mut self.history);
        }
        self.own.truncate(at);
        self.own.push(core::mem::take(&mut self.own_now));
        self.history.step(self.dt);
        self.script_at = at + 1;
    }

    /// Goes to a step, as [`History::go_to`] does.
    ///
    /// # Errors
    /// As [`History::go_to`].
    pub fn go_to(&mut self, step: usize) -> Result<(), Error> {
        self.own_now = 0;
        self.history.go_to(step)
    }

    /// Brings the script to the current step, from the mark before it, in a world beside.
    fn catch_up(&mut self) {
        let at = self.history.at();
        if self.script.is_none() || self.script_at == at || self.own_now > 0 {
            return;
        }
        self.marks.retain(|(step, _)| *step <= at);
        // The beginning is always marked.
        let Some((from, mut script)) = self.marks.last().cloned() else { return };
        if from < at && self.history.go_to(from).is_ok() {
            let mut world = self.history.world().clone();
            self.repeat(&mut world, &mut script, from..at);
        }
        // It has been there before.
        let _ = self.history.go_to(at);
        (self.script, self.script_at) = (Some(script), at);
    }

    fn repeat(&self, world: &mut World, script: &mut PausedScript, steps: core::ops::Range<usize>) {
        for step in steps {
            let own = self.own.get(step).copied().unwrap_or(0) as usize;
            for command in self.history.recording().commands(step + 1).iter().take(own) {
                // It was accepted when it was recorded.
                let _ = command.apply(world);
            }
            script.before_step(&mut *world);
            world.step(self.history.recording().dt(step + 1).unwrap_or(self.dt));
        }
    }
}

/// Drops marks that are closer to each other than their age asks for; never the first or the last.
fn thin_out<T>(marks: &mut Vec<(usize, T)>) {
    let Some(&(now, _)) = marks.last() else { return };
    let mut i = 1;
    while i + 1 < marks.len() {
        let (before, after) = (marks[i - 1].0, marks[i + 1].0);
        if FADING * (after - before) <= now - after {
            marks.remove(i);
        } else {
            i += 1;
        }
    }
}

impl Commanded for Tape {
    fn world(&self) -> &World {
        self.world()
    }
    fn apply(&mut self, command: Command) -> Result<Made, Error> {
        self.apply(command)
    }
    fn step(&mut self, dt: f32) {
        self.dt = dt;
        self.step();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::{Rain, Script};
    use crate::{Options, Run, find};
    use tiny_physics::record::BodyCommand;
    use tiny_physics::{BodyId, Vec2};

    fn push(tape: &Tape, nth: usize) -> Command {
        let world = tape.world();
        let ids: Vec<BodyId> = world.body_ids().collect();
        Command::Body(ids[nth % ids.len()], BodyCommand::ApplyImpulseToCenter(Vec2::new(2.0, 3.0)))
    }

    /// The hash after every step of a run in which bodies are pushed now and then.
    fn play(tape: &mut Tape, steps: usize) -> Vec<u64> {
        let mut hashes = vec![tape.world().state_hash()];
        for step in 0..steps {
            if step % 17 == 5 {
                tape.apply(push(tape, step)).unwrap();
            }
            tape.step();
            hashes.push(tape.world().state_hash());
        }
        hashes
    }

    /// Scenes with and without scripts of all kinds: anywhere back and forth, then on from the middle.
    #[test]
    fn a_run_goes_on_from_the_past_as_if_it_had_not_gone_on_before() {
        for name in
            ["seed_pile_1000", "ragdoll", "character", "rain", "sensor_door", "tiles", "sleep"]
        {
            let scene = find(name).unwrap().build(Options::default().size(12));
            let mut tape = Tape::of_scene(&scene, 64 << 20).unwrap();
            let hashes = play(&mut tape, 150);
            for step in [149, 3, 77, 150, 0, 64] {
                tape.go_to(step).unwrap();
                assert_eq!(tape.world().state_hash(), hashes[step], "{name} at {step}");
            }
            tape.go_to(91).unwrap();
            tape.forget_later();
            for step in 91..150 {
                if step % 17 == 5 {
                    tape.apply(push(&tape, step)).unwrap();
                }
                tape.step();
                assert_eq!(tape.world().state_hash(), hashes[step + 1], "{name} on to {step}");
            }
        }
    }

    #[test]
    fn a_long_run_has_few_marks_and_none_is_far_away() {
        let mut marks = vec![(0, ())];
        for now in (MARKS..=1_000_000).step_by(MARKS) {
            marks.push((now, ()));
            thin_out(&mut marks);
        }
        assert!(marks.len() < 250, "{}", marks.len());
        assert!(marks.windows(2).all(|two| {
            let gap = two[1].0 - two[0].0;
            gap <= MARKS.max(999_960 / FADING - two[0].0 / FADING)
        }));
    }

    #[test]
    fn a_scripted_run_keeps_few_marks_and_goes_on_from_anywhere() {
        let mut scene = find("rain").unwrap().build(Options::default());
        scene.script =
            Some(Script::Rain(Rain { rows: 1, columns: 2, group: 1, ..Rain::default() }));
        let mut tape = Tape::of_scene(&scene, 8 << 20).unwrap();
        let hashes = play(&mut tape, 3000);
        assert!(tape.marks.len() < 45, "{}", tape.marks.len());
        for from in [2990, 1111] {
            tape.go_to(from).unwrap();
            tape.forget_later();
            for step in from..from + 10 {
                if step % 17 == 5 {
                    tape.apply(push(&tape, step)).unwrap();
                }
                tape.step();
                assert_eq!(tape.world().state_hash(), hashes[step + 1], "on to {step}");
            }
        }
    }

    /// A frame of the history lacks what the next step finds anew: in no scene may that be missed.
    #[test]
    fn every_scene_goes_on_from_each_of_its_frames() {
        for entry in crate::all().iter().filter(|entry| !entry.tags.contains(&crate::tags::SCALE)) {
            let scene = entry.build(Options::default());
            if scene.bodies.len() > 3000 {
                continue;
            }
            let mut tape = Tape::of_scene(&scene, 256 << 20).unwrap();
            let hashes = play(&mut tape, 100);
            for step in (1..=100).rev().step_by(7) {
                tape.go_to(step).unwrap();
                assert_eq!(tape.world().state_hash(), hashes[step], "{} at {step}", entry.name);
            }
        }
    }

    #[test]
    fn a_tape_is_the_run_of_its_scene() {
        let scene = find("platforms").unwrap().build(Options::default());
        let mut run = Run::start(&scene).unwrap();
        let mut tape = Tape::of_scene(&scene, 1 << 20).unwrap();
        for _ in 0..90 {
            run.step();
            tape.step();
        }
        assert_eq!(run.world().state_hash(), tape.world().state_hash());
        let recording = tape.history().recording().clone();
        let mut opened = Tape::of_recording(recording, 1 << 20).unwrap();
        opened.go_to(90).unwrap();
        assert_eq!(run.world().state_hash(), opened.world().state_hash());
    }
}
