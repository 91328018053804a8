//! Who works on which blocks of the graph, and when.

use super::graph::{BlockAddress, Graph, is_overflow};
use crate::geometry::manifold::PairClass;
use core::ops::Range;

/// Blocks of one bucket that one member of a team works on at a time.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub(crate) place: usize,
    pub(crate) class: PairClass,
    pub(crate) blocks: Range<usize>,
    /// Where in its bucket the run begins, 0 to 1.
    at: f32,
}

/// The runs of one place, which are worked on at the same time: no two share a moving body, unless the place
/// is an overflow, whose runs are for one member alone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stage<'a> {
    pub(crate) place: usize,
    pub(crate) runs: &'a [Run],
    /// Runs that one member takes at a time.
    pub(crate) chunk: usize,
}

/// The runs of some places of the graph, stage by stage.
#[derive(Clone, Debug, Default)]
pub(crate) struct Schedule {
    runs: Vec<Run>,
    /// Place, its runs, and how many of them are one chunk.
    stages: Vec<(usize, Range<usize>, usize)>,
    blocks: usize,
}

crate::footprint::footprint!(Schedule { runs, stages } none { blocks });

impl Schedule {
    /// Lists the occupied ones of these places in their order, in runs of up to `len` blocks.
    ///
    /// The runs of a colour go by where in their buckets they are, so that a member, which starts from its own part
    /// of the list, comes by the same parts of all buckets. What that saves has not been measured by itself.
    pub(crate) fn fill(
        &mut self,
        graph: &Graph,
        places: impl IntoIterator<Item = usize>,
        len: usize,
    ) {
        self.clear();
        for place in places {
            let first = self.runs.len();
            for (bucket, class) in graph.buckets[place].iter().zip(PairClass::ALL) {
                let count = bucket.manifolds.len();
                self.runs.extend((0..count).step_by(len).map(|start| Run {
                    place,
                    class,
                    blocks: start..count.min(start + len),
                    at: start as f32 / count as f32,
                }));
            }
            if !is_overflow(place) {
                self.runs[first..].sort_unstable_by(|a, b| {
                    a.at.total_cmp(&b.at).then_with(|| a.class.cmp(&b.class))
                });
            }
            self.end_stage(place, first, len);
        }
    }

    /// Lists single blocks, sorted and each once, in runs of up to `len` of neighbours.
    pub(crate) fn fill_with(&mut self, blocks: &[BlockAddress], len: usize) {
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
                    None => self.runs.push(Run { place, class, blocks: block..block + 1, at: 0.0 }),
                }
            }
            self.end_stage(place, first, len);
        }
    }

    fn clear(&mut self) {
        self.runs.clear();
        self.stages.clear();
        self.blocks = 0;
    }

    /// Makes a stage of the runs from `first` on, if there are any. A chunk has about `len` blocks, so that few
    /// blocks are no reason to wake threads, in however many buckets they are.
    fn end_stage(&mut self, place: usize, first: usize, len: usize) {
        let runs = &self.runs[first..];
        if runs.is_empty() {
            return;
        }
        let blocks = runs.iter().map(|run| run.blocks.len()).sum::<usize>();
        let chunk = if is_overflow(place) { usize::MAX } else { chunk(runs.len(), blocks, len) };
        self.stages.push((place, first..self.runs.len(), chunk));
        self.blocks += blocks;
    }

    /// All runs, stage by stage, and how many of them make a chunk of about `len` blocks.
    pub(crate) fn runs(&self, len: usize) -> (&[Run], usize) {
        (&self.runs, chunk(self.runs.len(), self.blocks, len))
    }

    /// The stages.
    pub(crate) fn stages(&self) -> impl Iterator<Item = Stage<'_>> {
        self.stages.iter().map(|(place, runs, chunk)| Stage {
            place: *place,
            runs: &self.runs[runs.clone()],
            chunk: *chunk,
        })
    }
}

/// How many of `runs`, which have so many blocks, make a chunk of about `len` blocks.
fn chunk(runs: usize, blocks: usize, len: usize) -> usize {
    runs.div_ceil(blocks.div_ceil(len).max(1))
}
