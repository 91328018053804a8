//! A run that can be gone back in.

use super::recording::Step;
use super::{Command, Made, Recording, delta};
use crate::{Error, World};

/// Fewest steps between two frames that are kept.
const INTERVAL: usize = 8;
/// A step more between them for so many bytes of a frame, so that keeping costs less than stepping.
const BYTES_A_STEP: usize = 100_000;

/// Keeps a run within a budget of memory, so that one can go to any step of it, and go on from there.
///
/// It holds the [`Recording`] of the run, and frames of it: one every few steps, most of them as what differs from
/// another, thinned out with age where memory runs short. Going to a step takes the frame before it and plays on, bit
/// for bit. A clone is a branch: both go on by themselves.
///
/// ```
/// use tiny_physics::record::{Command, History};
/// use tiny_physics::{RigidBody, Shape, Vec2, World};
/// # fn main() -> Result<(), tiny_physics::Error> {
/// let mut history = History::new(World::new(Vec2::new(0.0, -9.8)), 64 << 20);
/// history.apply(Command::AddBody(RigidBody::new(Shape::circle(0.5)?, Vec2::ZERO, 1.0)))?;
/// (0..60).for_each(|_| history.step(1.0 / 60.0));
/// let end = history.world().state_hash();
/// history.go_to(20)?;
/// assert_eq!((history.at(), history.len()), (20, 60));
/// history.go_to(60)?;
/// assert_eq!(history.world().state_hash(), end);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct History {
    world: World,
    recording: Recording,
    frames: Frames,
    /// Steps from the beginning to the world.
    at: usize,
    /// Up to here the run has been seen to repeat itself.
    seen: usize,
    /// What has been done to the world since.
    commands: Vec<Command>,
    /// About the memory that the steps take, bytes.
    recorded: usize,
}

impl History {
    /// Begins with the world as it is. About `budget` bytes are kept, but at least the first frame and the commands; half
    /// of it is left to frames where those need more, so that a long run can still be gone back in.
    pub fn new(world: World, budget: usize) -> Self {
        let recording = Recording { first: world.to_bytes(), steps: Vec::new() };
        Self::of(world, recording, budget)
    }

    fn of(world: World, recording: Recording, budget: usize) -> Self {
        let recorded = recording.steps.iter().map(Step::rough_bytes).sum();
        let frames = Frames::new(budget);
        Self { world, recording, frames, at: 0, seen: 0, commands: Vec::new(), recorded }
    }

    /// Opens a recording at its beginning; going forward in it fills in frames.
    ///
    /// # Errors
    /// The first frame cannot be read.
    pub fn open(recording: Recording, budget: usize) -> Result<Self, Error> {
        World::from_bytes(&recording.first).map(|world| Self::of(world, recording, budget))
    }

    /// The world as of the current step, to read.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Steps from the beginning to here.
    pub fn at(&self) -> usize {
        self.at
    }

    /// Steps that are kept.
    pub fn len(&self) -> usize {
        self.recording.len()
    }

    /// Is there no step?
    pub fn is_empty(&self) -> bool {
        self.recording.is_empty()
    }

    /// All that has been done, to save as a file.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// Bytes of frames and commands that are kept.
    pub fn bytes(&self) -> usize {
        self.frames.bytes + self.frames.whole.len() + self.taken()
    }

    /// Bytes besides frames.
    fn taken(&self) -> usize {
        self.recording.first.len() + self.recorded
    }

    /// Does something to the world. What came after the current step is forgotten.
    ///
    /// # Errors
    /// As [`Command::apply`]; nothing is forgotten then.
    pub fn apply(&mut self, command: Command) -> Result<Made, Error> {
        let made = command.apply(&mut self.world)?;
        self.forget_later();
        self.commands.push(command);
        Ok(made)
    }

    /// Forgets what came after the current step.
    pub fn forget_later(&mut self) {
        let forgotten = self.recording.steps.drain(self.at..);
        self.recorded -= forgotten.map(|step| step.rough_bytes()).sum::<usize>();
        self.frames.forget_after(self.at);
    }

    /// Moves the world on by `dt` seconds. What came after the current step is forgotten; to see it again, go to it.
    pub fn step(&mut self, dt: f32) {
        self.forget_later();
        let made = self.world.step_count();
        self.world.step(dt);
        if self.world.step_count() == made {
            return;
        }
        // No longer than needed, as it stays: a list that grew has room for four of its large commands.
        let commands = self.commands.drain(..).collect();
        let step = Step { commands, dt, hash: self.world.state_hash() };
        self.recorded += step.rough_bytes();
        self.recording.steps.push(step);
        self.arrive();
        self.seen = self.at;
    }

    /// Goes to the state after so many steps, at most to the end. What was done since the last step is undone.
    ///
    /// # Errors
    /// [`Error::Differs`] where the run does not repeat itself: hooks are not as they were, or the recording is of another
    /// version of the engine.
    pub fn go_to(&mut self, step: usize) -> Result<(), Error> {
        let step = step.min(self.len());
        let (from, work) = self.frames.last_before(step);
        if step < self.at || from > self.at || !self.commands.is_empty() {
            let frame = self.frames.get(from)?;
            // A new world, not in place: handles have to come out as they did.
            let mut world = World::from_bytes(frame.as_ref().unwrap_or(&self.recording.first))?;
            world.take_equipment(&mut self.world);
            (self.world, self.at, self.frames.work) = (world, from, work);
            self.commands.clear();
        }
        while self.at < step {
            // On the way to a place, what has been seen once is not looked at again.
            let looked_at = self.at >= self.seen || self.at + 1 == step;
            let same = self.recording.steps[self.at].play(&mut self.world, looked_at)?;
            self.arrive();
            if !same {
                return Err(Error::Differs { step: self.at });
            }
            self.seen = self.seen.max(self.at);
        }
        Ok(())
    }

    /// Counts a step, and keeps a frame where one is due.
    fn arrive(&mut self) {
        self.at += 1;
        let moved = 1 + self.world.awake_body_count() + self.world.contact_count();
        self.frames.work += moved as u64 * u64::from(self.world.settings.substeps);
        if self.at >= self.frames.due {
            self.frames.keep(self.at, self.world.to_bytes_of_next(), self.taken());
        }
    }
}

/// Frames of a run, in order. A whole one is followed by such as are kept as what differs from it.
#[derive(Clone, Debug)]
struct Frames {
    kept: Vec<Kept>,
    /// The last whole one, ready to compare with.
    whole: Vec<u8>,
    /// The step at which the next is kept.
    due: usize,
    /// Counted work of all steps from the beginning to the world.
    work: u64,
    /// Of all that are kept.
    bytes: usize,
    budget: usize,
}

#[derive(Clone, Debug)]
struct Kept {
    step: usize,
    /// Counted work of the steps up to it.
    work: u64,
    whole: bool,
    delta: Vec<u8>,
}

impl Frames {
    fn new(budget: usize) -> Self {
        Self { kept: Vec::new(), whole: Vec::new(), due: INTERVAL, work: 0, bytes: 0, budget }
    }

    /// Keeps a frame beside what takes so many bytes already.
    fn keep(&mut self, step: usize, frame: Vec<u8>, taken: usize) {
        self.due = step + INTERVAL + frame.len() / BYTES_A_STEP;
        let mut delta = delta::encode(&self.whole, &frame);
        // Differences grow with their distance. A new whole frame pays once the next difference costs more than the frames
        // since the last whole one, that included, do on average. Where all differ about as much as the first, it never does.
        let group = &self.kept[self.kept.iter().rposition(|kept| kept.whole).unwrap_or(0)..];
        let sum: usize = group.iter().map(|kept| kept.delta.len()).sum();
        let first = group.get(1).map_or(0, |first| first.delta.len());
        let whole = delta.len() * group.len() >= sum && 2 * delta.len() >= 3 * first;
        if whole {
            delta = delta::encode(&[], &frame);
            self.whole = frame;
        }
        delta.shrink_to_fit();
        self.bytes += delta.len();
        self.kept.push(Kept { step, work: self.work, whole, delta });
        // Commands cannot be dropped; without frames every seek would play the whole run.
        let taken = taken.min(self.budget / 2);
        while self.bytes + self.whole.len() + taken > self.budget && self.thin_out(step) {}
    }

    /// Drops the frame that is missed least. What it costs to play a gap may grow with the fourth root of its age: that
    /// keeps the longest, which are the oldest, a third above their mean. (With the square root they are twice the mean.)
    /// False where none can go.
    fn thin_out(&mut self, now: usize) -> bool {
        let work = |i: usize| self.kept.get(i).map_or(self.work, |kept| kept.work);
        let needed =
            |i: usize| self.kept[i].whole && self.kept.get(i + 1).is_none_or(|next| !next.whole);
        let cost = |i: usize| {
            let gap = u128::from(work(i + 1) - if i > 0 { work(i - 1) } else { 0 });
            let age = ((1 + now - self.kept[i].step) as u128) << 20;
            ((gap * gap) << 30) / age.isqrt()
        };
        let last = self.kept.len().saturating_sub(1);
        let Some(least) = (0..last).filter(|&i| !needed(i)).min_by_key(|&i| cost(i)) else {
            return false;
        };
        self.bytes -= self.kept.remove(least).delta.len();
        true
    }

    /// Forgets those after a step.
    fn forget_after(&mut self, step: usize) {
        if self.kept.last().is_none_or(|last| last.step <= step) {
            return;
        }
        let count = self.kept.partition_point(|kept| kept.step <= step);
        self.bytes -= self.kept.drain(count..).map(|kept| kept.delta.len()).sum::<usize>();
        self.due = self.kept.last().map_or(0, |last| last.step) + INTERVAL;
        let whole = self.kept.iter().rfind(|kept| kept.whole);
        // What was encoded here can be decoded.
        self.whole = whole
            .map_or(Ok(Vec::new()), |whole| delta::decode(&[], &whole.delta))
            .unwrap_or_default();
    }

    /// The last step before one of which there is a frame, that is whole again a step later, and counted work up to it.
    fn last_before(&self, step: usize) -> (usize, u64) {
        let kept = self.kept.iter().rfind(|kept| kept.step < step);
        kept.map_or((0, 0), |kept| (kept.step, kept.work))
    }

    /// The frame of a step; none of the beginning.
    fn get(&self, step: usize) -> Result<Option<Vec<u8>>, Error> {
        let count = self.kept.partition_point(|kept| kept.step <= step);
        let Some(kept) = self.kept[..count].last() else { return Ok(None) };
        let whole = self.kept[..count].iter().rfind(|kept| kept.whole);
        let whole = whole.map_or(Ok(Vec::new()), |whole| delta::decode(&[], &whole.delta))?;
        if kept.whole { Ok(Some(whole)) } else { delta::decode(&whole, &kept.delta).map(Some) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::play::record::BodyCommand;
    use crate::{BodyId, RigidBody, Shape, Vec2};

    /// Balls that rain on a floor; every one that has fallen for long is hit.
    fn run(budget: usize, steps: usize) -> (History, Vec<u64>) {
        let mut history = History::new(World::new(Vec2::new(0.0, -9.8)), budget);
        let mut hashes = vec![history.world().state_hash()];
        let floor = RigidBody::fixed().shape(Shape::rect(20.0, 1.0).unwrap());
        history.apply(Command::AddBody(floor)).unwrap();
        for step in 0..steps {
            act(&mut history, step);
            history.step(1.0 / 60.0);
            hashes.push(history.world().state_hash());
        }
        (history, hashes)
    }

    fn act(history: &mut History, step: usize) {
        if step.is_multiple_of(5) {
            let place = Vec2::new((step % 7) as f32, 6.0);
            let ball = RigidBody::dynamic().position(place).shape(Shape::circle(0.3).unwrap());
            history.apply(Command::AddBody(ball)).unwrap();
        }
        if step % 50 == 49 {
            let body: BodyId = history.world().body_ids().nth(step / 10).unwrap();
            history
                .apply(Command::Body(body, BodyCommand::SetVelocity(Vec2::new(3.0, 5.0))))
                .unwrap();
            let body = history.world().body_ids().nth(3).unwrap();
            history.apply(Command::RemoveBody(body)).unwrap();
        }
    }

    #[test]
    fn any_step_can_be_gone_to_in_any_order() {
        let (mut history, hashes) = run(1 << 20, 300);
        let mut step = 150;
        for _ in 0..60 {
            step = (step * 7 + 31) % 301;
            history.go_to(step).unwrap();
            assert_eq!((history.at(), history.world().state_hash()), (step, hashes[step]));
        }
        history.go_to(9999).unwrap();
        assert_eq!((history.at(), history.world().state_hash()), (300, hashes[300]));
    }

    #[test]
    fn a_small_budget_costs_time_and_no_steps() {
        let (large, hashes) = run(1 << 26, 400);
        let budget = large.bytes() - large.frames.bytes * 3 / 5;
        let (mut small, _) = run(budget, 400);
        assert!(small.bytes() <= budget, "{} of {budget}", small.bytes());
        assert!(small.frames.kept.len() < large.frames.kept.len());
        let kept = &small.frames.kept;
        let half = kept.partition_point(|kept| kept.step < 200);
        assert!(2 * half < kept.len(), "{half} of {} are old", kept.len());
        for step in (0..=400).step_by(23) {
            small.go_to(step).unwrap();
            assert_eq!(small.world().state_hash(), hashes[step]);
        }
        let (none, _) = run(0, 100);
        assert!(none.frames.kept.len() <= 2);
    }

    /// A command a step for so long that they alone are over the budget.
    #[test]
    fn commands_leave_room_for_frames() {
        const BUDGET: usize = 200_000;
        let mut history = History::new(World::new(Vec2::new(0.0, -9.8)), BUDGET);
        let ball = RigidBody::dynamic().shape(Shape::circle(0.3).unwrap());
        history.apply(Command::AddBody(ball)).unwrap();
        let ball = history.world().body_ids().next().unwrap();
        let push = Command::Body(ball, BodyCommand::ApplyForceToCenter(Vec2::new(0.1, 9.0)));
        for _ in 0..1000 {
            history.apply(push.clone()).unwrap();
            history.step(1.0 / 60.0);
        }
        let each = history.taken() / history.len();
        assert!(each < 2 * size_of::<Command>(), "{each} bytes a step");
        assert!(history.taken() > BUDGET);
        let kept = &history.frames.kept;
        let gap = kept.windows(2).map(|two| two[1].step - two[0].step).max();
        assert!(kept.len() > 30 && gap < Some(100), "{} frames, {gap:?} apart", kept.len());
        // What is counted is what is there, also after going on from the past, and in a file.
        history.go_to(600).unwrap();
        history.step(1.0 / 60.0);
        let opened = History::open(history.recording().clone(), BUDGET).unwrap();
        assert_eq!((history.len(), history.taken()), (601, opened.taken()));
    }

    #[test]
    fn what_commands_point_to_is_counted() {
        let mut history = History::new(World::new(Vec2::ZERO), 0);
        let frame = history.world().to_bytes();
        let before = history.taken();
        (0..100).for_each(|_| drop(history.apply(Command::RestoreBytes(frame.clone())).unwrap()));
        history.step(1.0 / 60.0);
        let taken = history.taken() - before;
        let least = 100 * (frame.len() + size_of::<Command>());
        assert!((least..least + least / 10).contains(&taken), "{taken}, not {least}");
    }

    /// What is done in the past makes another run of it, bit for bit that of one who never saw the first.
    #[test]
    fn one_can_go_on_from_the_past_and_a_clone_is_a_branch() {
        let (mut history, hashes) = run(1 << 22, 200);
        history.go_to(90).unwrap();
        let mut branch = history.clone();
        assert_eq!(branch.len(), 200);
        for step in 90..160 {
            act(&mut branch, step + 1);
            branch.step(1.0 / 60.0);
        }
        assert_eq!(branch.len(), 160);
        let end = branch.world().state_hash();
        assert_ne!(end, hashes[160]);
        branch.go_to(13).unwrap();
        assert_eq!(branch.world().state_hash(), hashes[13]);
        branch.go_to(160).unwrap();
        assert_eq!(branch.world().state_hash(), end);
        history.go_to(200).unwrap();
        assert_eq!(history.world().state_hash(), hashes[200]);
    }

    #[test]
    fn what_was_done_since_the_last_step_is_undone() {
        let (mut history, hashes) = run(1 << 22, 20);
        let body = history.world().body_ids().nth(1).unwrap();
        history.apply(Command::RemoveBody(body)).unwrap();
        assert_ne!(history.world().state_hash(), hashes[20]);
        history.go_to(20).unwrap();
        assert_eq!(history.world().state_hash(), hashes[20]);
        history.apply(Command::RemoveBody(body)).unwrap();
        history.apply(Command::RemoveBody(body)).unwrap_err();
        assert_eq!(history.len(), 20);
    }

    #[test]
    fn a_recording_is_opened_and_gone_back_in() {
        let (history, hashes) = run(1 << 22, 120);
        let recording = Recording::from_bytes(&history.recording().to_bytes()).unwrap();
        let mut opened = History::open(recording.clone(), 1 << 22).unwrap();
        for step in [120, 40, 80, 0, 119] {
            opened.go_to(step).unwrap();
            assert_eq!(opened.world().state_hash(), hashes[step]);
        }
        let mut wrong = recording;
        wrong.steps[59].hash ^= 1;
        let mut opened = History::open(wrong, 1 << 22).unwrap();
        assert_eq!(opened.go_to(120), Err(Error::Differs { step: 60 }));
        assert_eq!(opened.at(), 60);
    }

    /// A frame is worth as much as the world whatever comes next: a step of another length, one that is refused.
    #[test]
    fn frames_go_on_whatever_the_next_step_is() {
        for other in [1.0 / 30.0, 1.0 / 120.0, 0.0, f32::NAN] {
            let mut world = World::new(Vec2::new(0.0, -9.8));
            world.settings.sleep = false;
            let mut history = History::new(world, 1 << 22);
            let floor = RigidBody::fixed().shape(Shape::rect(20.0, 1.0).unwrap());
            history.apply(Command::AddBody(floor)).unwrap();
            for i in 0..4 {
                let place = Vec2::new(0.0, 1.5 + i as f32);
                let body =
                    RigidBody::dynamic().position(place).shape(Shape::rect(0.5, 0.5).unwrap());
                history.apply(Command::AddBody(body)).unwrap();
            }
            let mut hashes = vec![0];
            for step in 1..100 {
                history.step(if step % 8 == 1 && step > 60 { other } else { 1.0 / 60.0 });
                // What is refused is no step.
                hashes.truncate(history.at());
                hashes.push(history.world().state_hash());
            }
            for step in (60..history.len()).rev() {
                history.go_to(step).unwrap();
                assert_eq!(history.world().state_hash(), hashes[step], "{other}: {step}");
            }
        }
    }
}
