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

/// The runs of some places of the graph. Those of one place are one stage: a colour's run at the same time,
/// an overflow's one after the other. A bucket of an overflow is one run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Schedule {
    runs: Vec<Run>,
    /// Places and their runs.
    stages: Vec<(usize, Range<usize>)>,
}

impl Schedule {
    /// Lists the occupied ones of these places in their order, in runs of up to `len` blocks.
    ///
    /// The runs of a colour go by where in their buckets they are: members of a team start from their own
    /// parts of the list, so each comes by the same parts of all buckets, with contacts of about the same age,
    /// and finds most of their bodies in its cache.
    pub(crate) fn fill(
        &mut self,
        graph: &Graph,
        places: impl IntoIterator<Item = usize>,
        len: usize,
    ) {
        self.runs.clear();
        self.stages.clear();
        for place in places {
            let first = self.runs.len();
            let len = if is_overflow(place) { usize::MAX } else { len };
            for (bucket, class) in graph.buckets[place].iter().zip(PairClass::ALL) {
                let count = bucket.manifolds.len();
                self.runs.extend((0..count).step_by(len).map(|start| Run {
                    place,
                    class,
                    blocks: start..count.min(start.saturating_add(len)),
                    at: start as f32 / count as f32,
                }));
            }
            self.runs[first..]
                .sort_unstable_by(|a, b| a.at.total_cmp(&b.at).then_with(|| a.class.cmp(&b.class)));
            self.end_stage(place, first);
        }
    }

    /// Lists single blocks, sorted and each once, in runs of up to `len` of neighbours.
    pub(crate) fn fill_with(&mut self, blocks: &[BlockAddress], len: usize) {
        self.runs.clear();
        self.stages.clear();
        for blocks in blocks.chunk_by(|a, b| a.0 == b.0) {
            let first = self.runs.len();
            for &(place, class, block) in blocks {
                let (place, block) = (usize::from(place), block as usize);
                let class = PairClass::ALL[usize::from(class)];
                match self.runs[first..].last_mut() {
                    Some(run)
                        if run.class == class
                            && run.blocks.end == block
                            && run.blocks.len() < len =>
                    {
                        run.blocks.end += 1;
                    }
                    _ => self.runs.push(Run { place, class, blocks: block..block + 1, at: 0.0 }),
                }
            }
            self.end_stage(usize::from(blocks[0].0), first);
        }
    }

    /// Makes a stage of the runs from `first` on, if there are any.
    fn end_stage(&mut self, place: usize, first: usize) {
        if self.runs.len() > first {
            self.stages.push((place, first..self.runs.len()));
        }
    }

    /// All runs, stage by stage.
    pub(crate) fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// The stages: a place and its runs.
    pub(crate) fn stages(&self) -> impl Iterator<Item = (usize, &[Run])> {
        self.stages.iter().map(|(place, runs)| (*place, &self.runs[runs.clone()]))
    }
}
