//! Many episodes of one task at once.

use crate::batch::{Frame, VERSION, check_version, decode, decode_start, encode, frames, restore};
use crate::error::BatchError;
use crate::random::Random;
use crate::task::{Outcome, Spec, Task, View};
use crate::threads::Threads;
use serde::{Deserialize, Serialize};
use tiny_physics::World;

/// When a world whose episode is over begins the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Autoreset {
    /// In the step after: it ignores the action and gives the first observation with reward 0.
    #[default]
    NextStep,
    /// At once: the observation is the first of the next episode, [`Tasks::final_observation`] has the last.
    SameStep,
    /// When it is told to.
    Disabled,
}

/// Many episodes of one task, stepped at once: see [`Tasks`].
#[derive(Debug)]
pub struct TaskBatch<T: Task> {
    task: T,
    slots: Vec<Slot<T::Episode>>,
    threads: Threads,
    autoreset: Autoreset,
    observations: Vec<f32>,
}

#[derive(Clone, Debug)]
struct Slot<E> {
    world: World,
    random: Random,
    episode: E,
    steps: u32,
    outcome: Outcome,
    truncated: bool,
    /// The episode is over and the next has not begun.
    over: bool,
    /// The last observation of the episode before.
    last: Vec<f32>,
}

/// What of a slot is saved beside its world.
#[derive(Serialize, Deserialize)]
struct SavedSlot<E> {
    random: Random,
    episode: E,
    steps: u32,
    over: bool,
}

#[derive(Serialize, Deserialize)]
struct Saved<E> {
    version: u32,
    task: String,
    worlds: Vec<Frame>,
    slots: Vec<SavedSlot<E>>,
}

/// A [`TaskBatch`] of any task.
pub trait Tasks: Send + Sync {
    /// Episodes at once.
    fn len(&self) -> usize;
    /// Is there none?
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// The form of the task.
    fn spec(&self) -> Spec;
    /// The name of each number of an observation, in order.
    fn names(&self) -> Vec<String>;
    /// Gives world `i` the random numbers of `seeds[i]`; the next episode draws from them.
    ///
    /// # Errors
    /// Another number of seeds than worlds.
    fn seed(&mut self, seeds: &[u64]) -> Result<(), BatchError>;
    /// Begins new episodes where `mask` says so; `None` is everywhere.
    ///
    /// # Errors
    /// A mask of another length than worlds; the task's.
    fn reset(&mut self, mask: Option<&[bool]>) -> Result<(), BatchError>;
    /// Does the actions, world after world, and moves all worlds on by one step.
    ///
    /// # Errors
    /// Another number of actions than the batch needs, one that is not finite, no choice of the task, or (without
    /// autoreset) an episode that is over. Nothing has changed then. The task's.
    fn step(&mut self, actions: &[f32]) -> Result<(), BatchError>;
    /// Observations after the last step or reset, world after world.
    fn observations(&self) -> &[f32];
    /// The last observation of the last episode that ended in a world. Only with [`Autoreset::SameStep`].
    fn final_observation(&self, index: usize) -> Option<&[f32]>;
    /// What came of the last step in a world, and whether its time was up.
    fn outcome(&self, index: usize) -> Option<(Outcome, bool)>;
    /// A world.
    fn world(&self, index: usize) -> Option<&World>;
    /// What to show of a world.
    fn view(&self, index: usize) -> Option<View>;
    /// Everything that the next steps depend on, as bytes.
    ///
    /// # Errors
    /// None that is known; the encoder's.
    fn to_bytes(&mut self) -> Result<Vec<u8>, BatchError>;
    /// Goes back to what was saved, by a batch of the same task and as many worlds.
    ///
    /// # Errors
    /// Bytes that are no such save; nothing has changed then.
    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), BatchError>;
    /// The state hash of each world.
    fn state_hashes(&self) -> Vec<u64>;
    /// Memory that the worlds hold, bytes.
    fn memory(&self) -> usize;
}

impl<T: Task> TaskBatch<T> {
    /// Episodes of a task in `count` worlds, stepped on so many threads (0 is one a core). World `i` has seed `i`,
    /// and its first episode has begun.
    ///
    /// # Errors
    /// The machine gives no threads; the task's.
    pub fn new(
        task: T,
        count: usize,
        threads: usize,
        autoreset: Autoreset,
    ) -> Result<Self, BatchError> {
        let threads = Threads::new(threads)?;
        let slots = (0..count).map(|i| Slot::new(&task, i as u64)).collect::<Result<_, _>>()?;
        let observations = vec![0.0; count * task.spec().observation];
        let mut batch = Self { task, slots, threads, autoreset, observations };
        batch.observe()?;
        Ok(batch)
    }

    fn observe(&mut self) -> Result<(), BatchError> {
        let Self { task, slots, threads, observations, .. } = self;
        let out = (&mut observations[..], task.spec().observation);
        threads.each_with(slots, out, |_, slot, out| {
            task.observe(&slot.world, &slot.episode, out);
            Ok(())
        })
    }

    fn check_actions(&self, actions: &[f32]) -> Result<(), BatchError> {
        let spec = self.task.spec();
        BatchError::check_length("actions", self.slots.len() * spec.action, actions.len())?;
        BatchError::check_finite("actions", actions)?;
        if let Some(choices) = spec.choices {
            let good = |x: f32| x >= 0.0 && x < choices as f32 && x.floor() == x;
            if let Some(index) = actions.iter().position(|&x| !good(x)) {
                let value = f64::from(actions[index]);
                let allowed = "a choice of the task";
                return Err(BatchError::Value { name: "actions", index, value, allowed });
            }
        }
        let over = self.slots.iter().position(|slot| slot.over);
        match (self.autoreset, over) {
            (Autoreset::Disabled, Some(index)) => {
                let allowed = "an episode that has begun: reset it first";
                Err(BatchError::Value { name: "episodes", index, value: 0.0, allowed })
            }
            _ => Ok(()),
        }
    }
}

impl<E> Slot<E> {
    fn new<T: Task<Episode = E>>(task: &T, seed: u64) -> Result<Self, BatchError> {
        let mut random = Random::new(seed);
        let mut world = task.template().clone();
        let episode = task.reset(&mut world, &mut random)?;
        Ok(Self::of(world, SavedSlot { random, episode, steps: 0, over: false }))
    }

    fn of(world: World, saved: SavedSlot<E>) -> Self {
        let SavedSlot { random, episode, steps, over } = saved;
        let (outcome, truncated, last) = (Outcome::default(), false, Vec::new());
        Self { world, random, episode, steps, outcome, truncated, over, last }
    }

    fn begin<T: Task<Episode = E>>(&mut self, task: &T) -> Result<(), BatchError> {
        self.episode = task.reset(&mut self.world, &mut self.random)?;
        (self.steps, self.over) = (0, false);
        (self.outcome, self.truncated) = (Outcome::default(), false);
        Ok(())
    }

    fn step<T: Task<Episode = E>>(
        &mut self,
        task: &T,
        limit: u32,
        action: &[f32],
    ) -> Result<(), BatchError> {
        if self.over {
            return self.begin(task);
        }
        let Self { world, episode, random, .. } = self;
        self.outcome = task.step(world, episode, random, action)?;
        self.steps += 1;
        self.truncated = self.steps >= limit && !self.outcome.terminated;
        self.over = self.outcome.terminated || self.truncated;
        Ok(())
    }
}

impl<T: Task> Tasks for TaskBatch<T> {
    fn len(&self) -> usize {
        self.slots.len()
    }

    fn spec(&self) -> Spec {
        self.task.spec()
    }

    fn names(&self) -> Vec<String> {
        self.task.names()
    }

    fn seed(&mut self, seeds: &[u64]) -> Result<(), BatchError> {
        BatchError::check_length("seeds", self.slots.len(), seeds.len())?;
        let pairs = self.slots.iter_mut().zip(seeds);
        pairs.for_each(|(slot, &seed)| slot.random = Random::new(seed));
        Ok(())
    }

    fn reset(&mut self, mask: Option<&[bool]>) -> Result<(), BatchError> {
        if let Some(mask) = mask {
            BatchError::check_length("mask", self.slots.len(), mask.len())?;
        }
        let Self { task, slots, threads, .. } = self;
        threads.each(slots, |i, slot| {
            if mask.is_none_or(|mask| mask[i]) { slot.begin(task) } else { Ok(()) }
        })?;
        self.observe()
    }

    fn step(&mut self, actions: &[f32]) -> Result<(), BatchError> {
        self.check_actions(actions)?;
        let Self { task, slots, threads, autoreset, observations } = self;
        let Spec { observation, action, time_limit, .. } = task.spec();
        let same_step = *autoreset == Autoreset::SameStep;
        threads.each_with(slots, (observations, observation), |i, slot, out| {
            slot.step(task, time_limit, &actions[i * action..(i + 1) * action])?;
            task.observe(&slot.world, &slot.episode, out);
            if same_step && slot.over {
                slot.last.clear();
                slot.last.extend_from_slice(out);
                let (outcome, truncated) = (slot.outcome, slot.truncated);
                slot.begin(task)?;
                (slot.outcome, slot.truncated) = (outcome, truncated);
                task.observe(&slot.world, &slot.episode, out);
            }
            Ok(())
        })
    }

    fn observations(&self) -> &[f32] {
        &self.observations
    }

    fn final_observation(&self, index: usize) -> Option<&[f32]> {
        self.slots.get(index).map(|slot| &slot.last[..]).filter(|last| !last.is_empty())
    }

    fn outcome(&self, index: usize) -> Option<(Outcome, bool)> {
        self.slots.get(index).map(|slot| (slot.outcome, slot.truncated))
    }

    fn world(&self, index: usize) -> Option<&World> {
        self.slots.get(index).map(|slot| &slot.world)
    }

    fn view(&self, index: usize) -> Option<View> {
        self.slots.get(index).map(|slot| self.task.view(&slot.world, &slot.episode))
    }

    fn to_bytes(&mut self) -> Result<Vec<u8>, BatchError> {
        let worlds = frames(&self.threads, &mut self.slots, |slot| &slot.world)?;
        let saved = |slot: &Slot<T::Episode>| SavedSlot {
            random: slot.random.clone(),
            episode: slot.episode.clone(),
            steps: slot.steps,
            over: slot.over,
        };
        let (task, slots) = (self.task.title(), self.slots.iter().map(saved).collect());
        encode(&Saved { version: VERSION, task, worlds, slots })
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), BatchError> {
        // Episodes of another task cannot be read.
        let (version, task): (u32, String) = decode_start(bytes)?.0;
        check_version(version)?;
        if task != self.task.title() {
            let reason = format!("it is of \"{task}\", this is \"{}\"", self.task.title());
            return Err(BatchError::BadSave { reason });
        }
        let saved: Saved<T::Episode> = decode(bytes)?;
        BatchError::check_length("worlds", self.slots.len(), saved.worlds.len())?;
        BatchError::check_length("episodes", self.slots.len(), saved.slots.len())?;
        let worlds = restore(&self.threads, &saved.worlds)?;
        for ((slot, world), saved) in self.slots.iter_mut().zip(worlds).zip(saved.slots) {
            *slot = Slot::of(world, saved);
        }
        self.observe()
    }

    fn state_hashes(&self) -> Vec<u64> {
        self.slots.iter().map(|slot| slot.world.state_hash()).collect()
    }

    fn memory(&self) -> usize {
        let each = |slot: &Slot<_>| size_of::<World>() + slot.world.memory().total().held;
        self.slots.iter().map(each).sum()
    }
}
