//! The doctor: glances at all, examines a few.

use crate::checks::{energy, flight, joints, overlap, rest, scale, slow, surface, time};
use crate::look::{Findings, Look, Touch};
use crate::round::Round;
use crate::track::Track;
use crate::{Finding, Report};
use tiny_physics::{BodyId, BodyKind, JointId, World};

/// Watches a run and says what is wrong with it.
///
/// Call [`Doctor::watch`] after each step; a step in between that it does not see makes it less sharp, not wrong. A body that
/// was changed by the user between two steps is seen as it is after the next step.
#[derive(Default, Debug, Clone)]
pub struct Doctor {
    steps: u64,
    last_step: Option<u64>,
    tracks: Vec<Option<Track>>,
    findings: Findings,
    round: Round,
    examined: usize,
    joints: Vec<JointId>,
    joint_at: usize,
    joint_memory: joints::Memory,
    time: time::Memory,
    energy: energy::Memory,
    slow: slow::Memory,
    ground: flight::Ground,
    ways: flight::Ways,
    ill: Vec<BodyId>,
    new: Vec<BodyId>,
    bodies: usize,
    /// Step of the last look at the world as a whole, and the bodies that it had.
    world_seen: (u64, usize),
}

/// One body in so many is examined in a step, though nothing calls for it.
const EXAMINE_ONE_IN: usize = 64;
/// Bodies examined in a step because something calls for it: so many and one more of each [`EXAMINE_ONE_IN`], but never more
/// than [`MOST_ILL`].
const ILL: usize = 4;
const MOST_ILL: usize = 12;
/// Bodies examined because they are new: in the first step, and in others.
const MOST_AT_FIRST: usize = 1000;
const MOST_NEW: usize = 64;
/// Steps after which a body may be asked again for what it never meets.
const UNMET_EVERY: u64 = 16;
/// Steps between two looks at the world as a whole.
const WORLD_EVERY: u64 = 64;
/// One joint in so many is examined in a step.
const JOINT_ONE_IN: usize = 24;

impl Doctor {
    /// A doctor who has seen nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Looks at a world that has just been stepped. Where it has not been, sees only whether a step was refused. A world that
    /// has gone back (to a saved frame) is looked at anew; what was found stays.
    pub fn watch(&mut self, world: &World) {
        let mut look = Look::new(world);
        if self.last_step.is_some_and(|last| look.step < last) {
            let findings = core::mem::take(&mut self.findings);
            let time = self.time.anew();
            *self = Self { findings, steps: self.steps, time, ..Self::default() };
        }
        self.time.check_refused(&look, &mut self.findings);
        if self.last_step == Some(look.step) || look.step == 0 {
            return;
        }
        let first = self.last_step.is_none();
        look.pushed = self.time.note_pushes(&look);
        self.time.check_length(&look, &mut self.findings);
        self.slow.note_time(&look);
        self.note_sleep(&look);
        self.round.begin(&look);
        self.glance_at_some(&look);
        self.look_at_world(&look);
        self.energy.check(&look, &self.round.bodies, self.joint_memory.driven, &mut self.findings);
        self.examine_some(&look, first);
        self.examine_joints(&look);
        self.last_step = Some(look.step);
        self.steps += 1;
        self.bodies = world.body_count();
    }

    /// All that was found so far.
    pub fn report(&self) -> Report {
        self.findings.report(self.steps, self.bodies)
    }

    /// What was seen last, and in the last `steps` steps; of several the worst. For a line on a screen.
    pub fn latest(&self, steps: u64) -> Option<&Finding> {
        let now = self.last_step?;
        self.findings.latest().filter(|finding| finding.last_step + steps > now)
    }

    /// Bytes that the doctor holds: by the number of bodies and joints that the world has had at once, whatever the number
    /// of steps.
    pub fn memory(&self) -> usize {
        size_of::<Self>()
            + self.tracks.capacity() * size_of::<Option<Track>>()
            + (self.ill.capacity() + self.new.capacity()) * size_of::<BodyId>()
            + self.joints.capacity() * size_of::<JointId>()
            + self.round.memory()
            + self.joint_memory.memory()
            + self.time.memory()
            + self.findings.memory()
    }

    /// What concerns all bodies at once: seldom, and where bodies have come or gone, unless they are very many.
    fn look_at_world(&mut self, look: &Look<'_>) {
        let count = look.world.body_count();
        let (seen, bodies) = self.world_seen;
        let pause = if bodies == count { WORLD_EVERY } else { WORLD_EVERY.min(count as u64 / 8) };
        if seen > 0 && look.step < seen + pause {
            return;
        }
        self.world_seen = (look.step, count);
        self.ground.check(look);
        let tracks = self.round.bodies.iter();
        let tracks = tracks.filter_map(|id| self.tracks.get(id.index())?.as_ref());
        scale::check_all(look, tracks.clone(), &mut self.findings);
        self.slow.check(look, tracks, &mut self.findings);
    }

    fn note_sleep(&mut self, look: &Look<'_>) {
        for id in look.world.events().woke() {
            if let Some(Some(track)) = self.tracks.get_mut(id.index()) {
                rest::woke(look, track, &mut self.findings);
            }
        }
        for id in look.world.events().fell_asleep() {
            let Some(Some(track)) = self.tracks.get(id.index()) else { continue };
            overlap::slept(look, track, &mut self.findings);
            if let Some(body) = look.world.body(*id).filter(|_| track.free > 0.0) {
                overlap::check_swallowed(look, &body, track, &mut self.findings);
            }
        }
    }

    /// Takes all bodies of the list in that are new.
    fn admit(&mut self, look: &Look<'_>) {
        if self.round.admitted == self.round.listed {
            return;
        }
        self.round.admitted = self.round.listed;
        for &id in &self.round.bodies {
            if self.tracks.len() <= id.index() {
                self.tracks.resize(id.index() + 1, None);
            }
            let slot = &mut self.tracks[id.index()];
            if slot.as_ref().is_some_and(|track| track.id == id) {
                continue;
            }
            if let Some(body) = look.world.body(id) {
                *slot = Some(Track::new(look, &body, self.round.since));
                self.energy.reset();
                self.new.push(id);
            }
        }
    }

    /// Sees where bodies are, and which of them call for a thorough look.
    fn glance_at_some(&mut self, look: &Look<'_>) {
        self.admit(look);
        self.ways.begin(look);
        for place in self.round.next() {
            let id = self.round.bodies[place];
            let Some(body) = look.world.body(id) else {
                self.round.lacks_one();
                continue;
            };
            let Some(Some(track)) = self.tracks.get_mut(id.index()) else { continue };
            if track.id != id || track.may_wait(look) {
                continue;
            }
            if !body.is_awake() && body.is_enabled() {
                track.sleeps(look);
                continue;
            }
            if track.measured == 0 {
                track.measure_again(look, &body);
            }
            let before = track.glance(look, &body);
            let ways = &mut self.ways;
            if flight::glance(look, &body, &before, track, (&self.ground, ways), &mut self.findings)
            {
                self.energy.reset();
            }
            if rest::calls(look, &body, track) {
                self.ill.push(id);
            }
        }
    }

    /// Examines what calls for it, and a few others in turn.
    fn examine_some(&mut self, look: &Look<'_>, first: bool) {
        let mut ill = core::mem::take(&mut self.ill);
        let count = self.round.bodies.len();
        let others = (count / EXAMINE_ONE_IN).min(MOST_ILL);
        let most = (ILL + others).min(MOST_ILL);
        ill.iter().rev().take(most).for_each(|&id| self.examine(look, id));
        ill.clear();
        self.ill = ill;
        let mut new = core::mem::take(&mut self.new);
        let most = if first { MOST_AT_FIRST } else { MOST_NEW };
        new.iter().take(most).for_each(|&id| self.examine(look, id));
        new.clear();
        self.new = new;
        // Where they are few, one every other step.
        let others = others.max(usize::from(look.step.is_multiple_of(2))).min(count);
        for _ in 0..others {
            self.examined = (self.examined + 1) % count;
            self.examine(look, self.round.bodies[self.examined]);
        }
    }

    fn examine(&mut self, look: &Look<'_>, id: BodyId) {
        let Some(body) = look.world.body(id) else { return };
        let Some(Some(track)) = self.tracks.get_mut(id.index()) else { return };
        if body.kind() == BodyKind::Static || track.id != id {
            return;
        }
        track.measure_again(look, &body);
        scale::check_one(look, &body, track, &mut self.findings);
        if track.unmet < look.step {
            track.unmet = look.step + UNMET_EVERY;
            overlap::check_unmet(look, &body, track, &mut self.findings);
        }
        if !body.is_awake() {
            return;
        }
        let touches: Vec<Touch> = body.contacts().map(|contact| Touch::of(id, &contact)).collect();
        if !touches.is_empty() {
            (track.flew, track.free) = (track.free, 0.0);
        } else if track.speed < 0.1 * look.unit {
            overlap::check_swallowed(look, &body, track, &mut self.findings);
        }
        overlap::check(look, &body, track, &touches, &mut self.findings);
        rest::check(look, &body, track, &touches, &mut self.findings);
        surface::check(look, &body, track, &touches, &mut self.findings);
        slow::check_hub(look, &body, touches.len(), &mut self.findings);
    }

    fn examine_joints(&mut self, look: &Look<'_>) {
        if self.joint_at >= self.joints.len() {
            self.joints.clear();
            self.joints.extend(look.world.joint_ids());
            self.joint_at = 0;
            self.joint_memory.begin_round(look);
        }
        // Where they are few, one every other step.
        let count = (self.joints.len() / JOINT_ONE_IN).min(64);
        let count = count.max(usize::from(look.step.is_multiple_of(2)));
        let end = (self.joint_at + count).min(self.joints.len());
        for &id in &self.joints[self.joint_at..end] {
            if let Some(joint) = look.world.joint(id) {
                joints::check(look, &joint, &mut self.joint_memory, &mut self.findings);
            }
        }
        self.joint_at = end;
    }
}
