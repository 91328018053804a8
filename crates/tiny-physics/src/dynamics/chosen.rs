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
    /// Of all paces, in the order in which they are solved, each once.
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
        self.blocks.sort_unstable_by_key(|at| (order(at), at.1, at.2));
        self.blocks.dedup();
    }

    /// Chooses blocks by their heads.
    pub(crate) fn list_blocks(&mut self, graph: &Graph, chosen: impl Fn(&BlockHead) -> bool) {
        self.blocks.clear();
        for (place, class, bucket) in graph.all().take_while(|&(place, ..)| place != IDLE) {
            let chosen = (0..).zip(&bucket.heads).filter(|(_, head)| chosen(head));
            self.blocks.extend(chosen.map(|(block, _)| (place as u8, class as u8, block)));
        }
        self.blocks.sort_by_key(order);
    }

    /// Schedules those of a pace in runs of up to `len`; says whether there are any.
    pub(crate) fn take(&mut self, graph: &Graph, pace: usize, len: usize) -> bool {
        let at = |pace| self.blocks.partition_point(|at| pace_at(at.0.into()) < pace);
        let blocks = &self.blocks[at(pace)..at(pace + 1)];
        self.schedule.fill_with(graph, blocks, len);
        !blocks.is_empty()
    }
}

/// In a pace the overflow comes first, as in [`Schedule::fill_pace`].
fn order(&(place, ..): &BlockAddress) -> (usize, bool, u8) {
    (pace_at(place.into()), !is_overflow(place.into()), place)
}
