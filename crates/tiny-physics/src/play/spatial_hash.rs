//! A spatial hash: space cut into square cells, a box entered into every cell that it covers, and
//! only boxes that share a cell compared.
//!
//! The cells that are in use live in one open-addressing table with linear probing, at most half
//! full; the boxes of a cell are a chain through one flat array. A pair that shares several cells
//! is found once, in the cell of the lower left corner of the two boxes' common part, so nothing
//! has to be remembered or removed (the reference point of Dittrich and Seeger, "Data Redundancy
//! and Duplicate Detection in Spatial Join Processing", 2000).

use crate::broad_phase::{DynamicTree, clamped, sort_pairs};
use crate::{Aabb, Error};
use core::ops::ControlFlow;

/// A box over more cells than this is kept in a tree instead of the cells.
const MAX_CELLS: u64 = 64;

/// No link, no entry.
const NONE: u32 = u32::MAX;

/// Column and row of a cell.
type Key = (i32, i32);

#[derive(Clone, Copy, Debug)]
struct Entry {
    aabb: Aabb,
    id: u32,
    /// Cell of the lower left corner.
    low: Key,
    high: Key,
}

#[derive(Clone, Copy, Debug)]
struct Cell {
    key: Key,
    /// First link of the chain, `NONE` for a free place in the table.
    head: u32,
}

const FREE: Cell = Cell { key: (0, 0), head: NONE };

#[derive(Clone, Copy, Debug)]
struct Link {
    entry: u32,
    next: u32,
}

/// A broad phase for boxes that are collected anew every step.
///
/// Fill it with [`insert`](Self::insert), ask for [`pairs`](Self::pairs), [`clear`](Self::clear) it
/// for the next step; memory is reused. The best cell size is 1 to 2 times the largest common box
/// ([`suggested_cell_size`](Self::suggested_cell_size)): much smaller, and every box is in many
/// cells; much larger, and every cell has many boxes.
///
/// A box that covers very many cells does not go into them but into a small tree, so a floor of 10
/// km costs no more than a crate. A box with NaN in it or with `min > max` overlaps nothing;
/// coordinates beyond 1e18 count as that limit.
///
/// ```
/// use tiny_physics::{Aabb, SpatialHash, Vec2};
/// let mut hash = SpatialHash::new(2.0)?;
/// for id in 0..3 {
///     let center = Vec2::new(1.5 * id as f32, 0.0);
///     hash.insert(id, Aabb::from_center(center, Vec2::splat(1.0)));
/// }
/// let mut pairs = Vec::new();
/// hash.pairs(&mut pairs);
/// assert_eq!(pairs, [(0, 1), (1, 2)]);
/// # Ok::<(), tiny_physics::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct SpatialHash {
    cell_size: f32,
    per_metre: f32,
    entries: Vec<Entry>,
    links: Vec<Link>,
    /// Its length is a power of two.
    table: Vec<Cell>,
    used: usize,
    /// Entries that cover too many cells.
    large: DynamicTree,
}

impl SpatialHash {
    /// With cells of `cell_size` metres.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`] or [`Error::OutOfRange`] where the size is not a finite number between
    /// 1e-18 and 1e18.
    pub fn new(cell_size: f32) -> Result<Self, Error> {
        let is_right = (1.0e-18..=1.0e18).contains(&cell_size);
        Error::check("cell_size", cell_size, is_right, "1e-18 to 1e18")?;
        Ok(Self {
            cell_size,
            per_metre: 1.0 / cell_size,
            entries: Vec::new(),
            links: Vec::new(),
            table: Vec::new(),
            used: 0,
            large: DynamicTree::new(),
        })
    }

    /// A good cell size for these boxes: 1.25 times the longest side among those that are no more
    /// than 8 times the median, so that a few huge boxes do not count. 1 where no box has a size.
    pub fn suggested_cell_size(boxes: impl IntoIterator<Item = Aabb>) -> f32 {
        let longest = |aabb: Aabb| {
            let size = aabb.max - aabb.min;
            if size.x > size.y { size.x } else { size.y }
        };
        let mut sides: Vec<f32> = boxes.into_iter().filter(Aabb::is_valid).map(longest).collect();
        sides.retain(|&side| side > 1.0e-12 && side < 1.0e12);
        sides.sort_unstable_by(f32::total_cmp);
        let Some(&median) = sides.get(sides.len() / 2) else { return 1.0 };
        let common = sides.partition_point(|&side| side <= 8.0 * median);
        1.25 * sides[common - 1]
    }

    /// Side of a cell, metres.
    pub fn cell_size(&self) -> f32 {
        self.cell_size
    }

    /// Number of boxes.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Is there no box?
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Removes all boxes; keeps the memory.
    pub fn clear(&mut self) {
        self.entries.clear();
        self.links.clear();
        self.table.fill(FREE);
        self.used = 0;
        self.large.clear();
    }

    /// Adds a box. An id may have several; they make no pair with each other.
    pub fn insert(&mut self, id: u32, aabb: Aabb) {
        let aabb = clamped(aabb);
        let (low, high) = self.cells(&aabb);
        let index = self.entries.len() as u32;
        self.entries.push(Entry { aabb, id, low, high });
        if aabb == Aabb::EMPTY {
            return;
        }
        if cell_count(low, high) > MAX_CELLS {
            self.large.insert(index, aabb, 1);
            return;
        }
        for y in low.1..=high.1 {
            for x in low.0..=high.0 {
                self.enter((x, y), index);
            }
        }
    }

    /// All pairs of ids whose boxes overlap (edges count) into `out` (its old contents are
    /// dropped): each once, the smaller id first, sorted.
    pub fn pairs(&self, out: &mut Vec<(u32, u32)>) {
        out.clear();
        for cell in &self.table {
            self.pairs_of_cell(cell, out);
        }
        if !self.large.is_empty() {
            self.pairs_of_large(out);
        }
        sort_pairs(out);
    }

    /// Calls `visit` with the id of every box that overlaps `aabb` (edges count), until it breaks.
    /// In no particular order.
    pub fn query(&self, aabb: &Aabb, mut visit: impl FnMut(u32) -> ControlFlow<()>) {
        let aabb = clamped(*aabb);
        let (low, high) = self.cells(&aabb);
        if cell_count(low, high) > self.used as u64 {
            self.query_all(&aabb, visit);
            return;
        }
        for y in low.1..=high.1 {
            for x in low.0..=high.0 {
                for entry in self.chain(self.head((x, y))) {
                    if entry.aabb.overlaps(&aabb)
                        && larger(low, entry.low) == (x, y)
                        && visit(entry.id).is_break()
                    {
                        return;
                    }
                }
            }
        }
        self.large.query(&aabb, 1, |index| visit(self.entries[index as usize].id));
    }

    fn query_all(&self, aabb: &Aabb, mut visit: impl FnMut(u32) -> ControlFlow<()>) {
        for entry in &self.entries {
            if entry.aabb.overlaps(aabb) && visit(entry.id).is_break() {
                return;
            }
        }
    }

    #[inline]
    fn cells(&self, aabb: &Aabb) -> (Key, Key) {
        let cell = |v: crate::math::Vec2| (self.cell(v.x), self.cell(v.y));
        (cell(aabb.min), cell(aabb.max))
    }

    /// Index of the cell of a coordinate; far away many cells have the same index, which is slow
    /// there but stays right because the order is kept.
    #[inline]
    fn cell(&self, coordinate: f32) -> i32 {
        let scaled = coordinate * self.per_metre;
        let truncated = scaled as i32;
        if truncated as f32 > scaled { truncated.saturating_sub(1) } else { truncated }
    }

    fn pairs_of_cell(&self, cell: &Cell, out: &mut Vec<(u32, u32)>) {
        let mut link = cell.head;
        while link != NONE {
            let Link { entry, next } = self.links[link as usize];
            let a = &self.entries[entry as usize];
            for b in self.chain(next) {
                if a.aabb.overlaps(&b.aabb) && larger(a.low, b.low) == cell.key {
                    push_pair(a.id, b.id, out);
                }
            }
            link = next;
        }
    }

    fn pairs_of_large(&self, out: &mut Vec<(u32, u32)>) {
        for (index, a) in self.entries.iter().enumerate() {
            let is_large = cell_count(a.low, a.high) > MAX_CELLS;
            self.large.query(&a.aabb, 1, |other| {
                if !is_large || index < other as usize {
                    push_pair(a.id, self.entries[other as usize].id, out);
                }
                ControlFlow::Continue(())
            });
        }
    }

    #[inline]
    fn chain(&self, head: u32) -> impl Iterator<Item = &Entry> {
        let mut link = head;
        core::iter::from_fn(move || {
            let Link { entry, next } = *self.links.get(link as usize)?;
            link = next;
            Some(&self.entries[entry as usize])
        })
    }

    /// First link of a cell, `NONE` where no box covers it.
    #[inline]
    fn head(&self, key: Key) -> u32 {
        if self.table.is_empty() { NONE } else { self.table[self.place(key)].head }
    }

    /// Where a cell is in the table, or where it would go.
    #[inline]
    fn place(&self, key: Key) -> usize {
        let last = self.table.len() - 1;
        let mut place = (hash(key) >> 32) as usize & last;
        while self.table[place].head != NONE && self.table[place].key != key {
            place = (place + 1) & last;
        }
        place
    }

    fn enter(&mut self, key: Key, entry: u32) {
        if 2 * (self.used + 1) > self.table.len() {
            self.enlarge();
        }
        let place = self.place(key);
        let cell = &mut self.table[place];
        self.used += usize::from(cell.head == NONE);
        self.links.push(Link { entry, next: cell.head });
        *cell = Cell { key, head: self.links.len() as u32 - 1 };
    }

    fn enlarge(&mut self) {
        let length = if self.table.is_empty() { 64 } else { 2 * self.table.len() };
        let old = core::mem::replace(&mut self.table, vec![FREE; length]);
        for cell in old {
            if cell.head != NONE {
                let place = self.place(cell.key);
                self.table[place] = cell;
            }
        }
    }
}

#[inline]
fn cell_count(low: Key, high: Key) -> u64 {
    if low.0 > high.0 || low.1 > high.1 {
        return 0;
    }
    let side = |low: i32, high: i32| (i64::from(high) - i64::from(low) + 1) as u64;
    side(low.0, high.0).saturating_mul(side(low.1, high.1))
}

/// Column by column and row by row the larger: the lower left cell of the common part.
#[inline]
fn larger(a: Key, b: Key) -> Key {
    (a.0.max(b.0), a.1.max(b.1))
}

#[inline]
fn push_pair(a: u32, b: u32, out: &mut Vec<(u32, u32)>) {
    if a != b {
        out.push(if a < b { (a, b) } else { (b, a) });
    }
}

/// Multiplicative mixing; the upper half of the product is well spread.
#[inline]
fn hash(key: Key) -> u64 {
    let word = u64::from(key.0 as u32) << 32 | u64::from(key.1 as u32);
    let mixed = (word ^ word >> 29).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    (mixed ^ mixed >> 32).wrapping_mul(0xD6E8_FEB8_6659_FD93)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vec2;
    use crate::broad_phase::tests::any_box;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn finds_what_brute_force_finds(
            boxes in prop::collection::vec((0u32..40, any_box()), 0..60),
            cell_size in prop_oneof![0.05f32..10.0, Just(1.0e-18), Just(1.0e18)],
            probe in any_box(),
        ) {
            let mut hash = SpatialHash::new(cell_size).unwrap();
            let mut found = Vec::new();
            for round in 0..2 {
                hash.clear();
                for &(id, aabb) in &boxes {
                    hash.insert(id, aabb);
                }
                let boxes: Vec<_> = boxes.iter().map(|&(id, aabb)| (id, clamped(aabb))).collect();
                let mut expected = Vec::new();
                for (i, a) in boxes.iter().enumerate() {
                    for b in &boxes[..i] {
                        if a.1.overlaps(&b.1) {
                            push_pair(a.0, b.0, &mut expected);
                        }
                    }
                }
                sort_pairs(&mut expected);
                hash.pairs(&mut found);
                prop_assert_eq!(&found, &expected, "round {}", round);
                let mut ids = Vec::new();
                hash.query(&probe, |id| { ids.push(id); ControlFlow::Continue(()) });
                ids.sort_unstable();
                let mut expected: Vec<u32> = boxes.iter()
                    .filter(|(_, aabb)| aabb.overlaps(&clamped(probe))).map(|&(id, _)| id).collect();
                expected.sort_unstable();
                prop_assert_eq!(ids, expected);
            }
        }
    }

    #[test]
    fn bad_cell_sizes_are_errors() {
        for size in [0.0, -1.0, f32::NAN, f32::INFINITY, 1.0e-30, 1.0e30] {
            assert!(SpatialHash::new(size).is_err(), "{size}");
        }
    }

    #[test]
    fn a_floor_of_ten_kilometres_stays_out_of_the_cells() {
        let mut hash = SpatialHash::new(1.0).unwrap();
        hash.insert(0, Aabb::from_center(Vec2::ZERO, Vec2::new(5000.0, 1.0)));
        hash.insert(1, Aabb::from_center(Vec2::new(300.0, 1.2), Vec2::splat(0.4)));
        hash.insert(2, Aabb::new(Vec2::splat(f32::NEG_INFINITY), Vec2::splat(f32::INFINITY)));
        assert!(hash.used <= 4 && hash.links.len() <= 4);
        let mut pairs = Vec::new();
        hash.pairs(&mut pairs);
        assert_eq!(pairs, [(0, 1), (0, 2), (1, 2)]);
    }

    #[test]
    fn suggestion_ignores_a_few_huge_boxes() {
        let boxes =
            |k: u32| Aabb::from_center(Vec2::ZERO, Vec2::splat(if k == 7 { 1e4 } else { 0.5 }));
        assert_eq!(SpatialHash::suggested_cell_size((0..20).map(boxes)), 1.25);
        assert_eq!(SpatialHash::suggested_cell_size([]), 1.0);
        assert_eq!(SpatialHash::suggested_cell_size([Aabb::EMPTY]), 1.0);
    }
}
