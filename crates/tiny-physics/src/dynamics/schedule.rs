//! Who works on which blocks of the graph, and when.

use super::blocks::{BlockHead, flags};
use super::coloured::{COLOURS, is_overflow, place_of};
use super::graph::{BlockAddress, Blocks, Bucket, Graph, Shared, key};
use crate::geometry::manifold::PairClass;
use crate::threads::Team;
use core::ops::Range;

/// Blocks of one bucket that one member of a team works on at a time.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub(crate) place: usize,
    /// Where in the graph's list the bucket is.
    pub(crate) bucket: usize,
    pub(crate) class: PairClass,
    pub(crate) blocks: Range<usize>,
    /// Where in its bucket the run begins, 0 to 1.
    at: f32,
}

impl Run {
    /// Is it of an overflow, in which one comes after the other?
    pub(crate) fn is_in_order(&self) -> bool {
        is_overflow(self.place)
    }
}

/// The runs of one place, which are worked on at the same time: no two share a moving body, unless the place
/// is an overflow, whose runs are for one member alone.
#[derive(Clone, Debug)]
pub(super) struct Listed {
    /// Where in the graph's list the buckets of the place are.
    pub(super) buckets: Range<usize>,
    pub(super) runs: Range<usize>,
    /// Runs that one member takes at a time.
    pub(super) chunk: usize,
}

impl Listed {
    /// Are there more than one member takes at a time?
    fn is_shared(&self) -> bool {
        self.runs.len() > self.chunk
    }
}

/// The runs of some places of the graph, stage by stage. It holds until buckets come to the graph or leave it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Schedule {
    pub(super) runs: Vec<Run>,
    pub(super) stages: Vec<Listed>,
    blocks: usize,
}

crate::footprint::footprint!(Schedule { runs, stages } none { blocks });

impl Schedule {
    /// Lists all places in runs of up to `len` blocks.
    pub(crate) fn fill(&mut self, graph: &Graph, len: usize) {
        self.clear();
        self.add(graph, 0..graph.buckets.list().len(), len);
    }

    /// Lists the places of a pace in the order in which they are solved: its overflow, then its colours.
    pub(crate) fn fill_pace(&mut self, graph: &Graph, pace: usize, len: usize) {
        let start = |colour: usize| place_of(pace, colour) * PairClass::COUNT;
        self.clear();
        for places in [COLOURS..COLOURS + 1, 0..COLOURS] {
            let buckets = graph.buckets.range(start(places.start)..start(places.end));
            self.add(graph, buckets, len);
        }
    }

    /// Lists places by their buckets; not what is solved elsewhere for now.
    ///
    /// The runs of a colour go by where in their buckets they are, so that a member, which starts from its own part
    /// of the list, comes by the same parts of all buckets. What that saves has not been measured by itself.
    fn add(&mut self, graph: &Graph, buckets: Range<usize>, len: usize) {
        let (mut first, mut start) = (self.runs.len(), buckets.start);
        let mut all = graph.all().enumerate().skip(start).take(buckets.len()).peekable();
        while let Some((index, (place, class, bucket))) = all.next() {
            let (count, mut from) = (bucket.manifolds.len(), 0);
            let is_open = |head: &BlockHead| head.flags & flags::TAKEN == 0;
            while from < count {
                let (blocks, at) = (from..count.min(from + len), from as f32 / count as f32);
                from = blocks.end;
                if bucket.heads[blocks.clone()].iter().any(is_open) {
                    self.runs.push(Run { place, bucket: index, class, blocks, at });
                }
            }
            if all.peek().is_none_or(|&(_, (next, ..))| next != place) {
                if !is_overflow(place) && self.runs.len() > first + 1 {
                    self.runs[first..].sort_unstable_by(|a, b| {
                        a.at.total_cmp(&b.at).then_with(|| a.class.cmp(&b.class))
                    });
                }
                self.end_stage(place, start..index + 1, first, len);
                (first, start) = (self.runs.len(), index + 1);
            }
        }
    }

    /// Lists single blocks, sorted and each once, in runs of up to `len` of neighbours.
    pub(crate) fn fill_with(&mut self, graph: &Graph, blocks: &[BlockAddress], len: usize) {
        self.clear();
        for blocks in blocks.chunk_by(|a, b| a.0 == b.0) {
            let (place, first) = (usize::from(blocks[0].0), self.runs.len());
            for &(_, class, block) in blocks {
                let (class, block) = (PairClass::ALL[usize::from(class)], block as usize);
                let run = self.runs[first..].last_mut().filter(|run| {
                    run.class == class && run.blocks.end == block && run.blocks.len() < len
                });
                match run {
                    Some(run) => run.blocks.end += 1,
                    None => {
                        let bucket = graph.buckets.position(key(place, class));
                        let blocks = block..block + 1;
                        self.runs.push(Run { place, bucket, class, blocks, at: 0.0 });
                    }
                }
            }
            let (start, end) = (self.runs[first].bucket, self.runs[self.runs.len() - 1].bucket);
            self.end_stage(place, start..end + 1, first, len);
        }
    }

    fn clear(&mut self) {
        self.runs.clear();
        self.stages.clear();
        self.blocks = 0;
    }

    /// Makes a stage of the runs from `first` on. A chunk has about `len` blocks, so that few blocks are no reason to
    /// wake threads, in however many buckets they are.
    fn end_stage(&mut self, place: usize, buckets: Range<usize>, first: usize, len: usize) {
        let runs = &self.runs[first..];
        let blocks = runs.iter().map(|run| run.blocks.len()).sum::<usize>();
        let chunk = if is_overflow(place) { usize::MAX } else { chunk(runs.len(), blocks, len) };
        self.stages.push(Listed { buckets, runs: first..self.runs.len(), chunk });
        self.blocks += blocks;
    }

    /// All runs, stage by stage, and how many of them make a chunk of about `len` blocks.
    pub(crate) fn runs(&self, len: usize) -> (&[Run], usize) {
        (&self.runs, chunk(self.runs.len(), self.blocks, len))
    }
}

/// How many of `runs`, which have so many blocks, make a chunk of about `len` blocks.
fn chunk(runs: usize, blocks: usize, len: usize) -> usize {
    runs.div_ceil(blocks.div_ceil(len).max(1))
}

/// Where runs take their blocks from.
pub(crate) enum Source<'a> {
    /// The graph's list of buckets.
    Graph(&'a mut [Bucket]),
    /// Those of one place, shared, and where in the list the first is.
    Shared(usize, &'a [Option<Shared<'a>>; PairClass::COUNT]),
    /// One block that is in no bucket.
    Alone(Blocks<'a>),
}

impl Source<'_> {
    /// The blocks of a run that is in it.
    #[inline(always)]
    pub(crate) fn blocks(&mut self, run: &Run) -> Option<Blocks<'_>> {
        let blocks = run.blocks.clone();
        match self {
            Self::Graph(buckets) => Some(buckets[run.bucket].blocks(blocks)),
            Self::Shared(first, buckets) => Some(buckets[run.bucket - *first]?.blocks(blocks)),
            Self::Alone(Blocks { contacts, manifolds, heads, constraints, surfaces }) => {
                Some(Blocks { contacts, manifolds, heads, constraints, surfaces })
            }
        }
    }
}

impl Graph {
    /// Works on the runs of a schedule stage by stage, shared out to the team; on those of an overflow one after the other.
    /// Hands out all of them at once where nothing is to be shared.
    #[inline]
    pub(crate) fn for_each_chunk(
        &mut self,
        team: &Team,
        schedule: &Schedule,
        work: impl Fn(&[Run], Source<'_>) + Sync,
    ) {
        let list = self.buckets.list_mut();
        if team.member_count() == 1 || !schedule.stages.iter().any(Listed::is_shared) {
            return work(&schedule.runs, Source::Graph(list));
        }
        for stage in &schedule.stages {
            let runs = &schedule.runs[stage.runs.clone()];
            if !stage.is_shared() {
                work(runs, Source::Graph(list));
                continue;
            }
            let mut buckets = list[stage.buckets.clone()].iter_mut().map(Shared::new);
            let buckets: [_; PairClass::COUNT] = core::array::from_fn(|_| buckets.next());
            team.for_each_chunk(runs.len(), stage.chunk, |range| {
                work(&runs[range], Source::Shared(stage.buckets.start, &buckets));
            });
        }
    }
}
