//! Blocks of the graph that are solved by themselves, beside the passes over all.

use super::blocks::BlockHead;
use super::coloured::{IDLE, Place, is_overflow, pace_at};
use super::contacts::Contacts;
use super::graph::{BlockAddress, Graph};
use super::schedule::Schedule;
use crate::simd::BLOCK;

/// Blocks of contacts that touch which are worked on by themselves.
#[derive(Debug, Default)]
pub(crate) struct Chosen {
    /// Of all paces, each once, ascending but for what was taken.
    blocks: Vec<BlockAddress>,
    /// Those of the pace at hand.
    pub(crate) schedule: Schedule,
}

crate::footprint::footprint!(Chosen { blocks, schedule });

impl Chosen {
    /// Chooses the blocks of some contacts.
    pub(crate) fn list(
        &mut self,
        graph: &Graph,
        contacts: &Contacts,
        chosen: impl Iterator<Item = u32>,
    ) {
        self.blocks.clear();
        self.blocks.extend(chosen.filter_map(|index| {
            let contact = &contacts.records[index as usize];
            match contact.place {
                Place::Graph { colour, slot } if graph.touches(contact) => {
                    Some((colour, contact.class as u8, slot / BLOCK as u32))
                }
                _ => None,
            }
        }));
        self.blocks.sort_unstable_by_key(number);
        self.blocks.dedup();
    }

    /// Chooses blocks by their heads.
    pub(crate) fn list_blocks(&mut self, graph: &Graph, chosen: impl Fn(&BlockHead) -> bool) {
        self.blocks.clear();
        for (place, class, bucket) in graph.all().take_while(|&(place, ..)| place != IDLE) {
            let chosen = (0..).zip(&bucket.heads).filter(|(_, head)| chosen(head));
            self.blocks.extend(chosen.map(|(block, _)| (place as u8, class as u8, block)));
        }
    }

    /// Schedules those of a pace in runs of up to `len`; says whether there are any.
    pub(crate) fn take(&mut self, graph: &Graph, pace: usize, len: usize) -> bool {
        let at = |pace| self.blocks.partition_point(|at| pace_at(at.0.into()) < pace);
        let (start, end) = (at(pace), at(pace + 1));
        let blocks = &mut self.blocks[start..end];
        // The overflow comes first, as in [`Schedule::fill_pace`].
        let is_last = |at: &BlockAddress| is_overflow(at.0.into());
        if blocks.last().is_some_and(is_last) {
            blocks.rotate_left(blocks.partition_point(|at| !is_last(at)));
        }
        self.schedule.fill_with(graph, blocks, len);
        !blocks.is_empty()
    }
}

/// A block as a number: that is compared in one go.
fn number(&(place, class, block): &BlockAddress) -> u64 {
    u64::from(place) << 40 | u64::from(class) << 32 | u64::from(block)
}
