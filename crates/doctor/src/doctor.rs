//! The doctor: glances at all, examines a few.

use crate::Report;
use crate::checks::{energy, flight, joints, overlap, rest, scale, slow, surface, time};
use crate::look::{Findings, Look, Touch};
use crate::track::Track;
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
    /// Bodies of this round, and how far it has come.
    round: Vec<BodyId>,
    at: usize,
    examined: usize,
    joints: Vec<JointId>,
    joint_at: usize,
    joint_memory: joints::Memory,
    time: time::Memory,
    energy: energy::Memory,
    slow: slow::Memory,
    ground: flight::Ground,
    ill: Vec<BodyId>,
    bodies: usize,
}

/// Bodies glanced at in a step.
const GLANCES: usize = 512;
/// One body in so many is examined in a step, though nothing calls for it.
const EXAMINE_ONE_IN: usize = 64;
/// Bodies examined in a step because something calls for it; the first step has no bound.
const ILL: usize = 12;
/// One joint in so many is examined in a step.
const JOINT_ONE_IN: usize = 24;

impl Doctor {
    /// A doctor who has seen nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Looks at a world that has just been stepped. Does nothing where it has not.
    pub fn watch(&mut self, world: &World) {
        if self.last_step == Some(world.step_count()) || world.step_count() == 0 {
            return;
        }
        let first = self.last_step.is_none();
        let look = Look::new(world);
        self.time.check(&look, &mut self.findings);
        self.note_sleep(&look);
        self.begin_round(&look);
        self.glance_at_some(&look);
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

    /// Starts over with the list of bodies, where the last one is through.
    fn begin_round(&mut self, look: &Look<'_>) {
        let changed = self.bodies != look.world.body_count() && self.round.len() <= GLANCES;
        if self.at < self.round.len() && !changed {
            return;
        }
        self.round.clear();
        self.round.extend(look.world.body_ids());
        self.at = 0;
        self.ground.check(look);
        let tracks = self.round.iter().filter_map(|id| self.tracks.get(id.index())?.as_ref());
        scale::check_all(look, tracks, &mut self.findings);
        self.slow.check(look, &self.round, &self.tracks, &mut self.findings);
    }

    fn note_sleep(&mut self, look: &Look<'_>) {
        for id in look.world.events().woke() {
            if let Some(Some(track)) = self.tracks.get_mut(id.index()) {
                rest::woke(look, track, &mut self.findings);
            }
        }
        for id in look.world.events().fell_asleep() {
            if let Some(Some(track)) = self.tracks.get(id.index()) {
                overlap::slept(look, track, &mut self.findings);
            }
        }
    }

    /// Sees where bodies are, and which of them call for a thorough look.
    fn glance_at_some(&mut self, look: &Look<'_>) {
        let world = look.world;
        let end = (self.at + GLANCES).min(self.round.len());
        let whole = self.at == 0 && end == self.round.len();
        self.energy.begin();
        for &id in &self.round[self.at..end] {
            let Some(body) = world.body(id) else { continue };
            if self.tracks.len() <= id.index() {
                self.tracks.resize(id.index() + 1, None);
            }
            let slot = &mut self.tracks[id.index()];
            let Some(track) = slot.as_mut().filter(|track| track.id == id) else {
                if body.kind() != BodyKind::Static {
                    *slot = Some(Track::new(world, &body, look.step));
                    self.energy.reset();
                    self.ill.push(id);
                }
                continue;
            };
            let before = *track;
            let elapsed = (look.step - track.glance) as f32 * look.dt;
            track.glance(&body, elapsed, look.unit);
            track.glance = look.step;
            self.energy.add(look, &body);
            if !body.is_awake() && body.is_enabled() {
                continue;
            }
            if flight::glance(look, &body, &before, track, &self.ground, &mut self.findings) {
                self.energy.reset();
            }
            if rest::calls(look, &before, track) {
                self.ill.push(id);
            }
        }
        self.at = end;
        self.energy.end(look, whole, self.joint_memory.driven, &mut self.findings);
    }

    /// Examines what calls for it, and a few others in turn.
    fn examine_some(&mut self, look: &Look<'_>, first: bool) {
        let mut ill = core::mem::take(&mut self.ill);
        let most = if first { usize::MAX } else { ILL };
        ill.iter().rev().take(most).for_each(|&id| self.examine(look, id));
        ill.clear();
        self.ill = ill;
        let count = (self.round.len() / EXAMINE_ONE_IN).clamp(1, ILL);
        for _ in 0..count.min(self.round.len()) {
            self.examined = (self.examined + 1) % self.round.len();
            self.examine(look, self.round[self.examined]);
        }
    }

    fn examine(&mut self, look: &Look<'_>, id: BodyId) {
        let Some(body) = look.world.body(id) else { return };
        let Some(Some(track)) = self.tracks.get_mut(id.index()) else { return };
        if body.kind() == BodyKind::Static || track.id != id {
            return;
        }
        track.measure(look.world, &body);
        scale::check_one(look, &body, track, &mut self.findings);
        overlap::check_unmet(look, &body, track, &mut self.findings);
        if !body.is_awake() {
            return;
        }
        let touches: Vec<Touch> = body.contacts().map(|contact| Touch::of(id, &contact)).collect();
        if !touches.is_empty() {
            track.free = 0.0;
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
            self.joint_memory.begin_round();
        }
        let count = (self.joints.len() / JOINT_ONE_IN).clamp(1, 64);
        let end = (self.joint_at + count).min(self.joints.len());
        for &id in &self.joints[self.joint_at..end] {
            if let Some(joint) = look.world.joint(id) {
                joints::check(look, &joint, &mut self.joint_memory, &mut self.findings);
            }
        }
        self.joint_at = end;
    }
}
