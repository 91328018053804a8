//! What a query sees.

use crate::codec::setters;
use crate::describe::Filter;
use crate::world::{BodyId, ShapeId};
use core::fmt;

/// Decides which shapes a query sees. The default sees everything but sensors and shapes whose own mask is 0.
///
/// ```
/// use tiny_physics::QueryFilter;
/// const WALLS: u64 = 1 << 3;
/// let only_walls = QueryFilter::new().mask(WALLS);
/// let round = |shape: tiny_physics::ShapeId| shape.index() % 2 == 0;
/// let some = QueryFilter::new().sensors().predicate(&round);
/// # let _ = (only_walls, some);
/// ```
#[derive(Clone, Copy)]
pub struct QueryFilter<'a> {
    /// What the query is, what it sees, and its group: it sees the shapes whose filter would let them
    /// collide with a shape of this filter. The default sees all.
    pub filter: Filter,
    /// A body whose shapes are not seen: that of the character who looks.
    pub exclude_body: Option<BodyId>,
    /// Are sensors seen too?
    pub sensors: bool,
    /// Does a ray hit a shape in which it begins? It does so at fraction 0, against its direction. Otherwise it goes on
    /// to what it enters.
    pub solid: bool,
    /// Called for shapes that pass all else, in no fixed order and perhaps not for all: `false` hides the
    /// shape. For batches it is called on several threads. It has to give the same answer for the same shape.
    pub predicate: Option<&'a (dyn Fn(ShapeId) -> bool + Sync)>,
}

impl Default for QueryFilter<'_> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'a> QueryFilter<'a> {
    /// Sees everything but sensors.
    pub const fn new() -> Self {
        let filter = Filter { category: u64::MAX, mask: u64::MAX, group: 0 };
        Self { filter, exclude_body: None, sensors: false, solid: false, predicate: None }
    }

    /// Sets [`QueryFilter::predicate`].
    pub fn predicate(mut self, predicate: &'a (dyn Fn(ShapeId) -> bool + Sync)) -> Self {
        self.predicate = Some(predicate);
        self
    }

    /// Category bits that the broad phase may skip the rest of.
    pub(crate) fn tree_mask(&self) -> u64 {
        self.filter.reach().1
    }
}

setters! {
    QueryFilter<'a> {
        /// Sets what the query is, as bits: shapes whose mask has none of them are not seen.
        category(category: u64): filter.category = category;
        /// Sets what the query sees, as bits of the shapes' categories.
        mask(mask: u64): filter.mask = mask;
        /// Sets the group, as in [`Filter::group`].
        group(group: i32): filter.group = group;
        /// Hides a body.
        exclude(body: BodyId): exclude_body = Some(body);
        /// Shows sensors too.
        sensors(): sensors = true;
        /// Lets rays hit what they begin in: see [`QueryFilter::solid`].
        solid(): solid = true;
    }
}

impl From<Filter> for QueryFilter<'_> {
    fn from(filter: Filter) -> Self {
        Self { filter, ..Self::new() }
    }
}

impl fmt::Debug for QueryFilter<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("QueryFilter")
            .field("filter", &self.filter)
            .field("exclude_body", &self.exclude_body)
            .field("sensors", &self.sensors)
            .field("solid", &self.solid)
            .field("predicate", &self.predicate.is_some())
            .finish()
    }
}
