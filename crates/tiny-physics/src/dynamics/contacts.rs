//! Contact records: pairs of shapes that came near, until their fat boxes part.

use super::bodies::Bodies;
use super::coloured::Place;
use super::edges::{self, edges};
use super::pair_table::PairTable;
use super::places::{claim, put};
use crate::codec::{bad, record, store};
use crate::error::Error;
use crate::geometry::manifold::PairClass;

record! {
    /// Impulses of a contact point that is not in the graph at the moment.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub(crate) struct SavedPoint {
        /// Feature id; -1 is no point.
        pub(crate) id: f32,
        pub(crate) normal_impulse: f32,
        pub(crate) tangent_impulse: f32,
        /// How much less than its load accounts for the point may sink, metres.
        pub(crate) rest: f32,
    }
}

impl SavedPoint {
    pub(crate) const NONE: Self =
        Self { id: -1.0, normal_impulse: 0.0, tangent_impulse: 0.0, rest: 0.0 };
}

record! {
    /// The lasting record of a pair.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub(crate) struct Contact {
        pub(crate) alive: bool,
        /// Do the shapes touch (or nearly), as of the last narrow phase?
        pub(crate) touching: bool,
        /// Are begin and end events sent?
        pub(crate) events: bool,
        /// Are hit events sent?
        pub(crate) hit_events: bool,
        pub(crate) class: PairClass,
        pub(crate) place: Place,
        pub(crate) shape_a: u32,
        pub(crate) shape_b: u32,
        pub(crate) body_a: u32,
        pub(crate) body_b: u32,
        pub(crate) friction: f32,
        pub(crate) restitution: f32,
        pub(crate) rolling_resistance: f32,
        pub(crate) tangent_speed: f32,
        /// Impulses kept while the contact has no lane.
        pub(crate) saved: [SavedPoint; 2],
        /// Neighbours in the contact lists of A and B: (previous, next) edges.
        pub(crate) links: [(u32, u32); 2],
    }
}

edges!(Contact, first_contact);

impl Contact {
    /// Multiplies the impulses that are kept.
    pub(crate) fn scale_saved(&mut self, factor: f32) {
        for point in &mut self.saved {
            point.normal_impulse *= factor;
            point.tangent_impulse *= factor;
        }
    }
}

store! {
    /// All contacts of a world.
    #[derive(Debug, PartialEq, Default)]
    pub(crate) struct Contacts {
        pub(crate) records: Vec<Contact>,
        pub(crate) pairs: PairTable as derived,
        pub(crate) free: Vec<u32>,
    }
    load with Contacts::note_pairs
}

impl Contacts {
    /// Fills the pair table, for records that were read.
    fn note_pairs(&mut self) -> Result<(), Error> {
        self.pairs = PairTable::with_room_for(self.records.len());
        let alive = self.records.iter().enumerate().filter(|(_, contact)| contact.alive);
        for (index, &Contact { shape_a, shape_b, .. }) in alive {
            if shape_a == shape_b || !self.pairs.insert(shape_a, shape_b, index as u32) {
                return Err(bad("two contacts are of the same shapes"));
            }
        }
        Ok(())
    }

    /// Puts a record in: into the pair table and both bodies' lists.
    pub(crate) fn insert(&mut self, bodies: &mut Bodies, contact: Contact) -> u32 {
        let (shape_a, shape_b) = (contact.shape_a, contact.shape_b);
        let index = claim(&mut self.free, self.records.len());
        put(&mut self.records, index, contact);
        let is_new = self.pairs.insert(shape_a, shape_b, index);
        debug_assert!(is_new, "the pair has a contact already");
        edges::link(&mut self.records, bodies, index);
        index
    }

    /// Takes a record out. The caller has taken its lanes out of the graph.
    pub(crate) fn remove(&mut self, bodies: &mut Bodies, index: u32) {
        edges::unlink(&mut self.records, bodies, index);
        let contact = &mut self.records[index as usize];
        contact.alive = false;
        let (a, b) = (contact.shape_a, contact.shape_b);
        self.pairs.remove(a, b);
        self.free.push(index);
    }

    /// Contacts of a body as (contact, side) from the head of its list.
    pub(crate) fn of_body(&self, first_edge: u32) -> impl Iterator<Item = (u32, u32)> + '_ {
        edges::walk(&self.records, first_edge)
    }
}
