//! Slices shared between the members of a stage.

use core::marker::PhantomData;
use core::ops::Range;

#[cfg(tiny_physics_race)]
use super::race;

/// A slice whose elements several chunks of a stage read and write at once, each its own elements.
///
/// The caller keeps the invariant: *while one chunk of a stage writes an element, no other chunk of the
/// stage touches it.* Within a colour of the constraint graph every moving body occurs once, and
/// bodies that cannot move are never written; `World::validate` checks the colouring. Builds with
/// `--cfg tiny_physics_race` watch every access of stages that run on more than one thread, and panic when two chunks break the
/// rule, even where both happened to run on one thread.
///
/// Indices out of range panic.
pub(crate) struct SharedSlice<'a, T> {
    start: *mut T,
    len: usize,
    #[cfg(tiny_physics_race)]
    id: u64,
    marker: PhantomData<&'a mut [T]>,
}

/// Rows of eight floats, the solver's copies of bodies, which lanes gather and scatter.
pub(crate) type SharedRows<'a> = SharedSlice<'a, [f32; 8]>;

// SAFETY: the pointer comes from an exclusive borrow that lives for 'a, so nobody but the holders of
// copies can reach the elements, and those keep the invariant in the type's description. Elements are
// moved between threads (Send) and read by several at once (Sync).
unsafe impl<T: Send + Sync> Send for SharedSlice<'_, T> {}
// SAFETY: as for Send; a shared reference gives no more than a copy does.
unsafe impl<T: Send + Sync> Sync for SharedSlice<'_, T> {}

impl<T> Clone for SharedSlice<'_, T> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for SharedSlice<'_, T> {}

impl<'a, T> SharedSlice<'a, T> {
    /// Shares a slice for as long as it stays borrowed.
    #[inline]
    pub(crate) fn new(slice: &'a mut [T]) -> Self {
        Self {
            start: slice.as_mut_ptr(),
            len: slice.len(),
            #[cfg(tiny_physics_race)]
            id: race::new_slice(),
            marker: PhantomData,
        }
    }

    /// A copy of element `index`.
    #[inline(always)]
    pub(crate) fn read(self, index: u32) -> T
    where
        T: Copy,
    {
        assert!((index as usize) < self.len);
        #[cfg(tiny_physics_race)]
        race::note(self.id, index, race::Access::Read);
        // SAFETY: in bounds by the assertion; no thread writes the element meanwhile, see the type.
        unsafe { self.start.add(index as usize).read() }
    }

    /// Overwrites element `index`.
    #[inline(always)]
    pub(crate) fn write(self, index: u32, value: T)
    where
        T: Copy,
    {
        // SAFETY: exclusive as `place` requires by the invariant in the type's description.
        unsafe { self.place(index).write(value) }
    }

    /// Changes element `index` in place. `change` must not reach the same element another way.
    #[inline(always)]
    pub(crate) fn update<R>(self, index: u32, change: impl FnOnce(&mut T) -> R) -> R {
        // SAFETY: the pointer is valid and aligned, coming from a slice; no other chunk touches the
        // element meanwhile by the invariant in the type's description, nor does `change`.
        change(unsafe { &mut *self.place(index) })
    }

    /// The elements of a range, to change in place; what lies beyond the end is left out. No two chunks
    /// of a stage may take ranges that overlap.
    #[inline]
    #[allow(
        clippy::mut_from_ref,
        reason = "the invariant in the type's description keeps borrows apart"
    )]
    pub(crate) fn range(self, range: Range<usize>) -> &'a mut [T] {
        let end = range.end.min(self.len);
        let start = range.start.min(end);
        #[cfg(tiny_physics_race)]
        for index in start..end {
            race::note(self.id, index as u32, race::Access::Write);
        }
        // SAFETY: in bounds, as start <= end <= len; exclusive by the invariant in the type's description.
        unsafe { core::slice::from_raw_parts_mut(self.start.add(start), end - start) }
    }

    /// The place of an element that the caller is about to write.
    ///
    /// In bounds; whether it is exclusive is the caller's to know.
    #[inline(always)]
    fn place(self, index: u32) -> *mut T {
        assert!((index as usize) < self.len);
        #[cfg(tiny_physics_race)]
        race::note(self.id, index, race::Access::Write);
        // SAFETY: in bounds by the assertion.
        unsafe { self.start.add(index as usize) }
    }
}

impl<'a> SharedRows<'a> {
    /// The rows at the first so many of some indices, to be read.
    #[inline(always)]
    pub(crate) fn at<const N: usize>(self, indices: &[u32]) -> RowsAt<'a, N> {
        #[cfg(tiny_physics_race)]
        indices[..N].iter().for_each(|&index| race::note(self.id, index, race::Access::Read));
        RowsAt { start: self.start, indices: inside(indices, self.len), marker: PhantomData }
    }

    /// Overwrites the first halves (velocities) of the rows at the first so many of some indices: those whose bits are set.
    #[inline(always)]
    pub(crate) fn write_halves<const N: usize>(self, at: &[u32], halves: &[[f32; 4]; N], on: u32) {
        let indices: [u32; N] = inside(at, self.len);
        // Most strides write all: without a branch for each.
        let all = on.trailing_ones() as usize >= N;
        for i in 0..N {
            if all || on >> i & 1 != 0 {
                #[cfg(tiny_physics_race)]
                race::note(self.id, indices[i], race::Access::Write);
                // SAFETY: in bounds, as `inside` has found; a half row is the first 16 of the 32 bytes of the row, with the
                // same alignment; no other chunk touches the row meanwhile by the invariant in the type's description.
                unsafe { self.start.add(indices[i] as usize).cast::<[f32; 4]>().write(halves[i]) };
            }
        }
    }
}

/// Rows at some indices, all of which are there: looked at once, not row by row.
pub(crate) struct RowsAt<'a, const N: usize> {
    start: *const [f32; 8],
    indices: [u32; N],
    marker: PhantomData<&'a [f32; 8]>,
}

impl<'a, const N: usize> RowsAt<'a, N> {
    /// Those at the first so many of some indices.
    #[inline(always)]
    pub(crate) fn of(rows: &'a [[f32; 8]], indices: &[u32]) -> Self {
        Self { start: rows.as_ptr(), indices: inside(indices, rows.len()), marker: PhantomData }
    }

    /// A copy of the row at the `i`th index.
    #[inline(always)]
    pub(crate) fn row(&self, i: usize) -> [f32; 8] {
        // SAFETY: in bounds, as `inside` has found, of a slice that stays borrowed for 'a; no thread writes the row
        // meanwhile, see `SharedSlice`.
        unsafe { self.start.add(self.indices[i] as usize).read() }
    }
}

/// The first of some indices, all of which are below the length.
#[inline(always)]
fn inside<const N: usize>(indices: &[u32], len: usize) -> [u32; N] {
    let len = u32::try_from(len).unwrap_or(u32::MAX);
    let mut first = [0; N];
    first.copy_from_slice(&indices[..N]);
    let mut all = true;
    // No branch for each of them.
    for index in first {
        all &= index < len;
    }
    assert!(all, "an index out of range");
    first
}

/// A slice cut into blocks of equal length, the last perhaps shorter, each for one chunk of a stage.
pub(super) struct SharedBlocks<'a, T> {
    start: *mut T,
    len: usize,
    block_len: usize,
    marker: PhantomData<&'a mut [T]>,
}

// SAFETY: blocks do not overlap and each is given out once (see `take`), so sharing the cutter only
// ever moves elements to other threads.
unsafe impl<T: Send> Sync for SharedBlocks<'_, T> {}

impl<'a, T> SharedBlocks<'a, T> {
    /// Cuts a slice; `block_len` of zero counts as one.
    pub(super) fn new(slice: &'a mut [T], block_len: usize) -> Self {
        Self {
            start: slice.as_mut_ptr(),
            len: slice.len(),
            block_len: block_len.max(1),
            marker: PhantomData,
        }
    }

    /// Number of blocks.
    pub(super) fn count(&self) -> usize {
        self.len.div_ceil(self.block_len)
    }

    /// Block `index`.
    ///
    /// # Safety
    ///
    /// Each index may be taken once, or again when the block taken before is no longer used.
    #[allow(clippy::mut_from_ref, reason = "blocks do not overlap and each is taken once")]
    #[inline]
    pub(super) unsafe fn take(&self, index: usize) -> &mut [T] {
        assert!(index < self.count());
        let first = index * self.block_len;
        let len = self.block_len.min(self.len - first);
        // SAFETY: first < len of the slice by the assertion, and `len` ends the block within it; the
        // slice is borrowed exclusively for 'a, blocks do not overlap, and this one is taken once.
        unsafe { core::slice::from_raw_parts_mut(self.start.add(first), len) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_are_read_written_and_updated() {
        let mut values = [1, 2, 3];
        let shared = SharedSlice::new(&mut values);
        shared.write(0, shared.read(2));
        assert_eq!(shared.update(1, |value| core::mem::replace(value, 9)), 2);
        assert_eq!(values, [3, 9, 3]);
    }

    #[test]
    fn a_half_row_leaves_the_other_half() {
        let mut rows = [[0.0; 8], [1.0; 8]];
        SharedRows::new(&mut rows).write_halves(&[0, 1], &[[3.0; 4], [2.0; 4]], 0b10);
        assert_eq!(rows, [[0.0; 8], [2.0, 2.0, 2.0, 2.0, 1.0, 1.0, 1.0, 1.0]]);
    }

    #[test]
    #[should_panic = "index"]
    fn reading_out_of_range_panics() {
        SharedSlice::new(&mut [1, 2]).read(2);
    }

    #[test]
    #[should_panic = "index"]
    fn writing_out_of_range_panics() {
        SharedRows::new(&mut [[0.0; 8]]).write_halves(&[0, 1], &[[0.0; 4]; 2], 0b01);
    }

    #[test]
    #[should_panic = "index"]
    fn picking_out_of_range_panics() {
        RowsAt::<2>::of(&[[0.0; 8]], &[0, 1]);
    }

    #[test]
    fn blocks_cover_the_slice_once() {
        let mut values: Vec<u32> = vec![0; 10];
        let blocks = SharedBlocks::new(&mut values, 4);
        assert_eq!(blocks.count(), 3);
        for index in 0..3 {
            // SAFETY: each index once.
            unsafe { blocks.take(index) }.fill(index as u32 + 1);
        }
        assert_eq!(values, [1, 1, 1, 1, 2, 2, 2, 2, 3, 3]);
        assert_eq!(SharedBlocks::new(&mut [0u8; 0], 0).count(), 0);
    }
}
