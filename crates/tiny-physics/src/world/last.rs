//! What is known of the last step, and no step depends on: for those who ask.

use super::World;
use super::ids::BodyId;
use crate::codec::store;

store! {
    /// Saved with the world, but no part of the state hash.
    #[derive(Debug, Default)]
    pub(super) struct LastStep {
        /// Substeps that it had, at the plain pace.
        pub(super) substeps: u32,
        /// So many of those that fell asleep were put to sleep before it.
        pub(super) put_asleep: u32,
        /// Bodies that it moved and that were taken out or put to sleep since.
        pub(super) moved: Vec<BodyId>,
        /// Whole turns that bodies made in it whose angular velocity, set since, tells others.
        pub(super) turns: Vec<(u32, i32)>,
    }
}

impl World {
    /// Forgets the step before, as one begins: what has been put to sleep until now is an event of that already.
    pub(super) fn begin_last(&mut self, substeps: u32) {
        self.moved.take();
        self.last.moved.clear();
        self.last.turns.clear();
        let put_asleep = self.state.events.fell_asleep.len() as u32;
        (self.last.substeps, self.last.put_asleep) = (substeps, put_asleep);
    }

    /// Length of the last step, seconds.
    pub(super) fn last_dt(&self) -> f32 {
        self.last.substeps as f32 / self.state.inv_h
    }

    /// Remembers that the last step has moved a body, if it has, before that is where it was all along.
    pub(super) fn keep_moved(&mut self, index: u32) {
        let bodies = &self.state.bodies;
        if bodies.poses[index as usize] != bodies.previous[index as usize] {
            self.last.moved.push(self.body_id(index));
        }
    }
}
