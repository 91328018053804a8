//! What sensors saw in the last step.

use crate::codec::{record, store};

record! {
    /// A sensor and a shape that overlaps it, with the generations of both: a shape that took the place of
    /// another is not the same visitor.
    #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
    pub(crate) struct Overlap {
        pub(crate) sensor: u32,
        pub(crate) sensor_generation: u32 as apart,
        pub(crate) visitor: u32,
        pub(crate) visitor_generation: u32 as apart,
    }
}

store! {
    /// All sensors of a world and what they see.
    #[derive(Debug, Default)]
    pub(crate) struct Sensors {
        /// Shapes that are sensors, ascending.
        pub(crate) shapes: Vec<u32>,
        /// Ascending, as of the last step.
        pub(crate) overlaps: Vec<Overlap>,
        /// Shapes that were placed or changed from outside since the last step, by index.
        pub(crate) changed: Vec<bool>,
        /// Must `changed` be cleared?
        pub(crate) any_changed: bool,
    }
}

impl Sensors {
    /// Notes that a shape has become a sensor.
    pub(crate) fn insert(&mut self, shape: u32) {
        if let Err(at) = self.shapes.binary_search(&shape) {
            self.shapes.insert(at, shape);
        }
    }

    /// Notes that a shape is no longer a sensor, or is gone.
    pub(crate) fn remove(&mut self, shape: u32) {
        if let Ok(at) = self.shapes.binary_search(&shape) {
            self.shapes.remove(at);
        }
    }

    /// Notes that a shape is not where or what it was in the last step, though no step moved it.
    pub(crate) fn mark_changed(&mut self, shape: u32) {
        let index = shape as usize;
        if self.changed.len() <= index {
            self.changed.resize(index + 1, false);
        }
        self.changed[index] = true;
        self.any_changed = true;
    }

    /// Is a shape marked?
    pub(crate) fn has_changed(&self, shape: u32) -> bool {
        self.changed.get(shape as usize).copied().unwrap_or(false)
    }

    /// Forgets all marks.
    pub(crate) fn clear_changed(&mut self) {
        if core::mem::take(&mut self.any_changed) {
            self.changed.clear();
        }
    }

    /// What a sensor sees.
    pub(crate) fn seen_by(&self, sensor: u32) -> &[Overlap] {
        let start = self.overlaps.partition_point(|overlap| overlap.sensor < sensor);
        let count = self.overlaps[start..].partition_point(|overlap| overlap.sensor == sensor);
        &self.overlaps[start..start + count]
    }

    /// Did the sensor see the visitor in the last step?
    pub(crate) fn saw(&self, overlap: &Overlap) -> bool {
        self.overlaps.binary_search(overlap).is_ok()
    }
}
