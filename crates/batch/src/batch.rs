//! Many copies of template worlds, stepped at once.

use crate::actuator::Actuator;
use crate::error::BatchError;
use crate::random::Random;
use crate::reading::Reading;
use crate::threads::Threads;
use serde::{Deserialize, Serialize};
use tiny_physics::{QueryFilter, RayCast, RayCastHit, World};

/// Many worlds, each a copy of a template, stepped at once.
///
/// World `i` is a copy of template `i % templates`. Handles of a template are those of its copies. Results are the
/// same on any number of threads.
#[derive(Clone, Debug)]
pub struct WorldBatch {
    templates: Vec<World>,
    slots: Vec<Slot>,
    threads: Threads,
}

#[derive(Clone, Debug)]
struct Slot {
    world: World,
    random: Random,
}

/// What a saved batch holds.
#[derive(Serialize, Deserialize)]
struct Saved {
    version: u32,
    templates: Vec<Frame>,
    worlds: Vec<Frame>,
    randoms: Vec<Random>,
}

/// A saved world as a string of bytes: one copy, not a number at a time.
pub(crate) struct Frame(pub(crate) Vec<u8>);

impl Serialize for Frame {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(&self.0)
    }
}

impl<'de> Deserialize<'de> for Frame {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        <&[u8]>::deserialize(deserializer).map(|bytes| Self(bytes.to_vec()))
    }
}

pub(crate) const VERSION: u32 = 2;

impl WorldBatch {
    /// `count` copies of the templates, stepped on so many threads; 0 is one a core. World `i` has seed `i`.
    ///
    /// # Errors
    /// No template, or the machine gives no threads.
    pub fn new(templates: &[World], count: usize, threads: usize) -> Result<Self, BatchError> {
        if templates.is_empty() {
            return Err(BatchError::Length { name: "templates", expected: 1, got: 0 });
        }
        let templates: Vec<World> = templates.iter().map(one_threaded).collect();
        let slot = |i: usize| Slot {
            world: templates[i % templates.len()].clone(),
            random: Random::new(i as u64),
        };
        let slots = (0..count).map(slot).collect();
        Ok(Self { slots, templates, threads: Threads::new(threads)? })
    }

    /// Worlds in the batch.
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// Is there no world?
    pub fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// Threads that it steps on.
    pub fn threads(&self) -> usize {
        self.threads.count()
    }

    /// Steps on so many threads from now on; 0 is one a core.
    ///
    /// # Errors
    /// The machine gives no threads.
    pub fn set_threads(&mut self, threads: usize) -> Result<(), BatchError> {
        self.threads = Threads::new(threads)?;
        Ok(())
    }

    /// A world of the batch.
    pub fn world(&self, index: usize) -> Option<&World> {
        self.slots.get(index).map(|slot| &slot.world)
    }

    /// A world of the batch, to change.
    pub fn world_mut(&mut self, index: usize) -> Option<&mut World> {
        self.slots.get_mut(index).map(|slot| &mut slot.world)
    }

    /// The worlds, in order.
    pub fn worlds(&self) -> impl ExactSizeIterator<Item = &World> {
        self.slots.iter().map(|slot| &slot.world)
    }

    /// Moves all worlds on by `dt` seconds. No world waits for another.
    ///
    /// # Errors
    /// Those of [`World::try_step`].
    pub fn step(&mut self, dt: f32) -> Result<(), BatchError> {
        self.threads.each(&mut self.slots, |_, slot| Ok(slot.world.try_step(dt)?))
    }

    /// Does what the actions say: for each world in order one number for each actuator, in order.
    ///
    /// # Errors
    /// Another number of actions than worlds times actuators, one that is not finite (nothing has changed then), or
    /// an actuator that a world cannot do. The other worlds have had their actions then.
    pub fn apply(&mut self, actuators: &[Actuator], actions: &[f32]) -> Result<(), BatchError> {
        let each = actuators.len();
        BatchError::check_length("actions", self.len() * each, actions.len())?;
        BatchError::check_finite("actions", actions)?;
        let templates = &self.templates;
        self.threads.each(&mut self.slots, |i, Slot { world, .. }| {
            let mut pairs = actuators.iter().zip(&actions[i * each..(i + 1) * each]);
            let template = &templates[i % templates.len()];
            pairs.try_for_each(|(actuator, &value)| Ok(actuator.apply(world, template, value)?))
        })
    }

    /// Does to each world of `indices` what random numbers say that are drawn evenly from `low` to `high`, one for
    /// each actuator, from the world's own generator: starts that differ from world to world.
    ///
    /// # Errors
    /// Arrays that differ in length, numbers that are not finite, a world that is not there, or an actuator that a
    /// world cannot do.
    pub fn scatter(
        &mut self,
        indices: &[usize],
        actuators: &[Actuator],
        low: &[f32],
        high: &[f32],
    ) -> Result<(), BatchError> {
        for (name, ends) in [("low", low), ("high", high)] {
            BatchError::check_length(name, actuators.len(), ends.len())?;
            BatchError::check_finite(name, ends)?;
        }
        self.check_indices(indices)?;
        let mut result = Ok(());
        for &index in indices {
            let Slot { world, random } = &mut self.slots[index];
            let template = &self.templates[index % self.templates.len()];
            let mut ranges = actuators.iter().zip(low.iter().zip(high));
            let done = ranges.try_for_each(|(actuator, (&low, &high))| {
                actuator.apply(world, template, random.uniform(low, high))
            });
            result = result.and(done.map_err(|error| BatchError::InWorld { index, error }));
        }
        result
    }

    /// Reads all worlds into `out`: for each world in order one number for each reading, in order.
    ///
    /// # Errors
    /// `out` has another length than worlds times readings, or a reading's handle is stale in a world. The other worlds have
    /// been read then.
    pub fn read(&mut self, readings: &[Reading], out: &mut [f32]) -> Result<(), BatchError> {
        BatchError::check_length("out", self.len() * readings.len(), out.len())?;
        let templates = &self.templates;
        self.threads.each_with(&mut self.slots, (out, readings.len()), |i, slot, out| {
            readings.iter().zip(out).try_for_each(|(reading, out)| {
                *out = reading.read(&slot.world, &templates[i % templates.len()])?;
                Ok(())
            })
        })
    }

    /// Casts rays in all worlds at once: the same number in each, world after world. `hits` gets the answers in the
    /// order of the rays.
    ///
    /// # Errors
    /// The rays cannot be shared out evenly.
    pub fn ray_casts(
        &mut self,
        rays: &[RayCast],
        filter: &QueryFilter<'_>,
        hits: &mut Vec<Option<RayCastHit>>,
    ) -> Result<(), BatchError> {
        let each = rays.len() / self.len().max(1);
        BatchError::check_length("rays", each * self.len(), rays.len())?;
        hits.clear();
        hits.resize(rays.len(), None);
        self.threads.each_with(&mut self.slots, (hits, each), |i, slot, hits| {
            for (hit, ray) in hits.iter_mut().zip(&rays[i * each..]) {
                *hit = slot.world.ray_cast(ray.origin, ray.translation, filter);
            }
            Ok(())
        })
    }

    /// Makes worlds copies of their templates again. Their generators go on.
    ///
    /// # Errors
    /// A world is not there; none has changed then.
    pub fn reset(&mut self, indices: &[usize]) -> Result<(), BatchError> {
        self.check_indices(indices)?;
        for &index in indices {
            let template = &self.templates[index % self.templates.len()];
            self.slots[index].world.clone_from(template);
        }
        Ok(())
    }

    /// Gives world `i` the random numbers of `seeds[i]`.
    ///
    /// # Errors
    /// Another number of seeds than worlds.
    pub fn seed(&mut self, seeds: &[u64]) -> Result<(), BatchError> {
        BatchError::check_length("seeds", self.len(), seeds.len())?;
        let pairs = self.slots.iter_mut().zip(seeds);
        pairs.for_each(|(slot, &seed)| slot.random = Random::new(seed));
        Ok(())
    }

    /// The state hash of each world.
    pub fn state_hashes(&mut self) -> Result<Vec<u64>, BatchError> {
        let mut hashes = vec![0; self.len()];
        self.threads.each_with(&mut self.slots, (&mut hashes, 1), |_, slot, hash| {
            hash[0] = slot.world.state_hash();
            Ok(())
        })?;
        Ok(hashes)
    }

    /// The whole batch as bytes: worlds, templates, generators.
    ///
    /// # Errors
    /// None that is known; the encoder's.
    pub fn to_bytes(&mut self) -> Result<Vec<u8>, BatchError> {
        let randoms = self.slots.iter().map(|slot| slot.random.clone()).collect();
        let templates = self.templates.iter().map(|world| Frame(world.to_bytes())).collect();
        let worlds = frames(&self.threads, &mut self.slots, |slot| &slot.world)?;
        encode(&Saved { version: VERSION, templates, worlds, randoms })
    }

    /// A batch from its bytes, to be stepped on so many threads.
    ///
    /// # Errors
    /// Bytes that are no saved batch, or a damaged one.
    pub fn from_bytes(bytes: &[u8], threads: usize) -> Result<Self, BatchError> {
        let threads = Threads::new(threads)?;
        let Saved { version, templates, worlds, randoms } = decode(bytes)?;
        check_version(version)?;
        if templates.is_empty() || worlds.len() != randoms.len() {
            return Err(BatchError::BadSave { reason: "its lists do not fit together".into() });
        }
        let templates = restore(&threads, &templates)?;
        let worlds = restore(&threads, &worlds)?;
        let slots = worlds.into_iter().zip(randoms);
        let slots = slots.map(|(world, random)| Slot { world, random }).collect();
        Ok(Self { templates, slots, threads })
    }

    /// Goes back to what was saved, on the threads that it has. Hooks are no part of what is saved: no world has any then.
    ///
    /// # Errors
    /// Bytes that are no saved batch, or a damaged one; nothing has changed then.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), BatchError> {
        let threads = self.threads.clone();
        *self = Self { threads, ..Self::from_bytes(bytes, 1)? };
        Ok(())
    }

    /// Memory that the worlds hold, bytes; templates and the batch's own lists left out.
    pub fn memory(&self) -> usize {
        self.worlds().map(|world| size_of::<World>() + world.memory().total().held).sum()
    }

    fn check_indices(&self, indices: &[usize]) -> Result<(), BatchError> {
        let count = self.len();
        match indices.iter().find(|&&index| index >= count) {
            Some(&index) => Err(BatchError::World { index, count }),
            None => Ok(()),
        }
    }
}

/// A copy that steps on the thread that calls.
fn one_threaded(world: &World) -> World {
    let mut world = world.clone();
    world.set_threads(1);
    world
}

/// The worlds of slots as bytes.
pub(crate) fn frames<S: Send + Sync>(
    threads: &Threads,
    slots: &mut [S],
    world: impl Fn(&S) -> &World + Send + Sync,
) -> Result<Vec<Frame>, BatchError> {
    let mut frames: Vec<Frame> = slots.iter().map(|_| Frame(Vec::new())).collect();
    threads.each_with(slots, (&mut frames, 1), |_, slot, frame| {
        frame[0].0 = world(slot).to_bytes();
        Ok(())
    })?;
    Ok(frames)
}

/// Worlds from their bytes.
pub(crate) fn restore(threads: &Threads, frames: &[Frame]) -> Result<Vec<World>, BatchError> {
    let mut worlds: Vec<World> = Vec::new();
    worlds.resize_with(frames.len(), || World::new(tiny_physics::Vec2::ZERO));
    threads.each(&mut worlds, |i, world| {
        *world = World::from_bytes(&frames[i].0)?;
        Ok(())
    })?;
    Ok(worlds)
}

pub(crate) fn encode(value: &impl Serialize) -> Result<Vec<u8>, BatchError> {
    postcard::to_stdvec(value).map_err(|error| BatchError::BadSave { reason: error.to_string() })
}

/// All of the bytes.
pub(crate) fn decode<'a, T: Deserialize<'a>>(bytes: &'a [u8]) -> Result<T, BatchError> {
    let (value, rest) = decode_start(bytes)?;
    if rest.is_empty() {
        return Ok(value);
    }
    Err(BatchError::BadSave { reason: format!("{} bytes too many", rest.len()) })
}

/// What the bytes begin with, and the rest.
pub(crate) fn decode_start<'a, T: Deserialize<'a>>(
    bytes: &'a [u8],
) -> Result<(T, &'a [u8]), BatchError> {
    let bad = |error: postcard::Error| BatchError::BadSave { reason: error.to_string() };
    postcard::take_from_bytes(bytes).map_err(bad)
}

pub(crate) fn check_version(version: u32) -> Result<(), BatchError> {
    if version == VERSION {
        return Ok(());
    }
    Err(BatchError::BadSave { reason: format!("version {version}, this one reads {VERSION}") })
}
