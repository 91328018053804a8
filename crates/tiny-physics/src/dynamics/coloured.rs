//! Constraints in colours: what the graphs of contacts and of joints have in common.
//!
//! Within a colour no two constraints share a dynamic body, so neither the order of lanes nor that of threads can
//! change results. A constraint keeps its colour while it is solved; colours are given first-fit in the order in which
//! constraints come, so they depend on the history of the world alone. Between two dynamic bodies it is the lowest free
//! colour, else the highest: what hangs on something fixed is solved last and so holds best. What finds no colour goes
//! to the overflow, solved one by one and before the colours.
//!
//! A *place* is one of these at one pace. Only what has something in it is kept: most worlds use a few places of more
//! than a hundred, and each that is there costs time in every pass, copy, hash and frame.

use super::bodies::{Bodies, BodyInfo};
use super::pace::PACES;
use crate::codec::{Data, Reader, Sink, bad, data_enum};
use crate::error::Error;
use crate::footprint::MemoryUse;
use crate::threads::SharedSlice;
use core::ops::{Index, IndexMut, Range};

/// Number of colours, and the number of the overflow among the places of a pace.
pub(crate) const COLOURS: usize = 24;
/// The place of joints that are solved directly, in trees, among those of a pace.
pub(crate) const TREES: usize = COLOURS + 1;
/// Places of one pace.
const PER_PACE: usize = COLOURS + 2;
/// Place of the contacts that do not touch, after those of all paces.
pub(crate) const IDLE: usize = PER_PACE * PACES;

/// Where the lanes of a contact or joint are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// In its graph: place and slot in the bucket of its class.
    Graph {
        /// The place.
        colour: u8,
        /// Block * lanes + lane.
        slot: u32,
    },
    /// Nowhere: its bodies sleep or are disabled, or it has nothing to solve.
    Asleep,
}

data_enum!(Place { 0 => Asleep, 1 => Graph { colour, slot } });

/// A place by its pace and by its colour, [`COLOURS`] for the overflow or [`TREES`].
pub(crate) fn place_of(pace: usize, colour: usize) -> usize {
    pace * PER_PACE + colour
}

/// The colour at a place, [`COLOURS`] for an overflow, or [`TREES`].
pub(crate) fn colour_at(place: usize) -> usize {
    place % PER_PACE
}

/// The pace of a place below [`IDLE`].
pub(crate) fn pace_at(place: usize) -> usize {
    place / PER_PACE
}

/// Is a place an overflow, whose constraints may have bodies in common?
pub(crate) fn is_overflow(place: usize) -> bool {
    place != IDLE && colour_at(place) == COLOURS
}

/// Finds a colour that neither dynamic body uses and marks it used; the overflow's where there is none. `used` are the
/// colours of a body, as bits.
pub(super) fn take_colour(
    bodies: &mut Bodies,
    ends: [u32; 2],
    used: fn(&mut BodyInfo) -> &mut u32,
) -> usize {
    const ALL: u32 = (1 << COLOURS) - 1;
    let dynamic = ends.map(|i| bodies.is_dynamic(i));
    let movers = || ends.into_iter().zip(dynamic).filter(|(_, dynamic)| *dynamic).map(|(i, _)| i);
    let taken = movers().fold(0, |taken, i| taken | *used(&mut bodies.infos[i as usize]));
    let free = !taken & ALL;
    if free == 0 {
        return COLOURS;
    }
    let colour = match dynamic {
        [true, true] => free.trailing_zeros(),
        _ => u32::BITS - 1 - free.leading_zeros(),
    };
    movers().for_each(|i| *used(&mut bodies.infos[i as usize]) |= 1 << colour);
    colour as usize
}

/// Gives the colour of a place back.
pub(super) fn give_colour_back(
    bodies: &mut Bodies,
    ends: [u32; 2],
    place: usize,
    used: fn(&mut BodyInfo) -> &mut u32,
) {
    let colour = colour_at(place);
    if colour >= COLOURS {
        return;
    }
    for i in ends {
        if bodies.is_dynamic(i) {
            *used(&mut bodies.infos[i as usize]) &= !(1 << colour);
        }
    }
}

/// Constraints of one key.
pub(crate) trait Bucketful: Clone + Default {
    fn is_empty(&self) -> bool;
}

/// Buckets by key, those alone that have something in them. A key begins with a place.
#[derive(Debug)]
pub(crate) struct Coloured<B> {
    /// Ascending.
    keys: Vec<u16>,
    /// By key: its place in that list, plus 1.
    places: Vec<u16>,
    /// The bucket of each key.
    buckets: Vec<B>,
    /// Empty ones, ascending by the key that they had: the next bucket of that key needs as much memory.
    spare: Vec<(u16, B)>,
}

impl<B> Default for Coloured<B> {
    fn default() -> Self {
        Self { keys: Vec::new(), places: Vec::new(), buckets: Vec::new(), spare: Vec::new() }
    }
}

impl<B: PartialEq> PartialEq for Coloured<B> {
    fn eq(&self, other: &Self) -> bool {
        (&self.keys, &self.buckets) == (&other.keys, &other.buckets)
    }
}

impl<B: Bucketful> Clone for Coloured<B> {
    fn clone(&self) -> Self {
        // Going back lays all buckets by for a moment.
        let spare = Vec::with_capacity(2 * self.buckets.len());
        let Self { keys, places, buckets, .. } = self;
        Self { keys: keys.clone(), places: places.clone(), buckets: buckets.clone(), spare }
    }

    fn clone_from(&mut self, source: &Self) {
        let Self { keys, places, buckets, spare } = self;
        keys.iter().for_each(|&key| places[usize::from(key)] = 0);
        keys.drain(..).zip(buckets.drain(..)).for_each(|(key, bucket)| lay_by(spare, key, bucket));
        for (&key, other) in source.keys.iter().zip(&source.buckets) {
            let mut bucket = take_spare(spare, key);
            bucket.clone_from(other);
            buckets.push(bucket);
        }
        keys.clone_from(&source.keys);
        let left_over = spare.iter_mut().filter(|(_, bucket)| !bucket.is_empty());
        left_over.for_each(|(_, bucket)| bucket.clone_from(&B::default()));
        spare.reserve(buckets.len());
        self.note_places(0);
    }
}

/// Keeps a bucket for its memory.
fn lay_by<B>(spare: &mut Vec<(u16, B)>, key: u16, bucket: B) {
    let at = spare.partition_point(|(other, _)| *other < key);
    spare.insert(at, (key, bucket));
}

/// A bucket that was kept for this key, or a new one.
fn take_spare<B: Default>(spare: &mut Vec<(u16, B)>, key: u16) -> B {
    let at = spare.binary_search_by_key(&key, |(other, _)| *other);
    at.map_or_else(|_| B::default(), |at| spare.remove(at).1)
}

impl<B: Bucketful + Data> Data for Coloured<B> {
    const HEAP: bool = true;

    fn save(&self, sink: &mut Sink) {
        let Self { keys, buckets, .. } = self;
        keys.save(sink);
        buckets.iter().for_each(|bucket| bucket.save(sink));
    }

    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let keys = Vec::<u16>::load(reader)?;
        if !keys.is_sorted_by(|a, b| a < b) || keys.last() == Some(&u16::MAX) {
            return Err(bad("places are out of order"));
        }
        let mut buckets = Vec::with_capacity(keys.len());
        for _ in &keys {
            let bucket = B::load(reader)?;
            if bucket.is_empty() {
                return Err(bad("a place has nothing in it"));
            }
            buckets.push(bucket);
        }
        let mut loaded = Self { keys, buckets, ..Self::default() };
        loaded.note_places(0);
        Ok(loaded)
    }

    fn memory(&self) -> MemoryUse {
        let Self { keys, places, buckets, spare } = self;
        [keys.memory(), places.memory(), buckets.memory(), spare.memory()].into_iter().sum()
    }
}

impl<B: Bucketful> Coloured<B> {
    /// Notes where keys are, from one of the list on.
    fn note_places(&mut self, first: usize) {
        let end = self.keys.last().map_or(0, |&key| usize::from(key) + 1);
        self.places.resize(end.max(self.places.len()), 0);
        let placed = self.keys.iter().zip(1..).skip(first);
        placed.for_each(|(&key, place)| self.places[usize::from(key)] = place);
    }

    /// The bucket of a key, if it has something in it.
    pub(crate) fn get(&self, key: usize) -> Option<&B> {
        self.buckets.get(self.position(key))
    }

    /// Where the bucket of a key is in the list; past its end if there is none.
    #[inline]
    pub(crate) fn position(&self, key: usize) -> usize {
        usize::from(self.places.get(key).copied().unwrap_or(0)).wrapping_sub(1)
    }

    /// The bucket of a key, a new one if there is none. Something has to be put into it.
    pub(super) fn open(&mut self, key: usize) -> &mut B {
        let at = match self.keys.binary_search(&(key as u16)) {
            Ok(at) => at,
            Err(at) => {
                self.keys.insert(at, key as u16);
                self.buckets.insert(at, take_spare(&mut self.spare, key as u16));
                self.note_places(at);
                // So that closing needs no memory.
                self.spare.reserve(self.buckets.len());
                at
            }
        };
        &mut self.buckets[at]
    }

    /// Takes the bucket of a key off the list if it is empty.
    pub(super) fn close(&mut self, key: usize) {
        let at = self.position(key);
        if self.buckets.get(at).is_some_and(B::is_empty) {
            let key = self.keys.remove(at);
            self.places[usize::from(key)] = 0;
            self.note_places(at);
            lay_by(&mut self.spare, key, self.buckets.remove(at));
        }
    }

    /// All buckets, ascending by key.
    pub(crate) fn list(&self) -> &[B] {
        &self.buckets
    }

    /// All buckets, to work on; none may become empty.
    pub(crate) fn list_mut(&mut self) -> &mut [B] {
        &mut self.buckets
    }

    /// All buckets, to be shared between members of the team.
    pub(super) fn share(&mut self) -> SharedBuckets<'_, B> {
        SharedBuckets { keys: &self.keys, buckets: SharedSlice::new(&mut self.buckets) }
    }

    /// All buckets with their keys, to work on; none may become empty.
    pub(crate) fn entries_mut(&mut self) -> impl Iterator<Item = (usize, &mut B)> {
        self.keys.iter().map(|&key| key.into()).zip(&mut self.buckets)
    }

    /// The key of each bucket.
    pub(crate) fn keys(&self) -> impl Iterator<Item = usize> + '_ {
        self.keys.iter().map(|&key| key.into())
    }

    /// Where in the list these keys are.
    pub(crate) fn range(&self, keys: Range<usize>) -> Range<usize> {
        let [start, end] = [keys.start, keys.end]
            .map(|end| self.keys.partition_point(|&key| usize::from(key) < end));
        start..end
    }
}

impl<B: Bucketful> Index<usize> for Coloured<B> {
    type Output = B;

    fn index(&self, key: usize) -> &B {
        &self.buckets[self.position(key)]
    }
}

impl<B: Bucketful> IndexMut<usize> for Coloured<B> {
    fn index_mut(&mut self, key: usize) -> &mut B {
        let at = self.position(key);
        &mut self.buckets[at]
    }
}

/// Buckets by key, each for one chunk of a stage. One that becomes empty has to be closed afterwards.
pub(super) struct SharedBuckets<'a, B> {
    keys: &'a [u16],
    buckets: SharedSlice<'a, B>,
}

impl<B> SharedBuckets<'_, B> {
    /// Changes the bucket of a key, if there is one.
    pub(super) fn update(&self, key: usize, change: impl FnOnce(&mut B)) {
        if let Ok(at) = self.keys.binary_search(&(key as u16)) {
            self.buckets.update(at as u32, change);
        }
    }
}
