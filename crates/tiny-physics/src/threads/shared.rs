//! Body rows shared between the threads of a stage.

use crate::simd::Row;
use core::marker::PhantomData;

/// A slice of rows that several threads read and write at once, each its own rows.
///
/// The stages that use it hand out work so that no two threads touch a row that one of them writes:
/// within a colour of the constraint graph every moving body occurs once, and rows of bodies that
/// cannot move are never written. `World::validate` checks the colouring.
#[derive(Clone, Copy)]
pub(crate) struct SharedRows<'a> {
    start: *mut Row,
    len: usize,
    marker: PhantomData<&'a mut [Row]>,
}

// SAFETY: see the type's description; the pointer itself comes from an exclusive borrow that lives
// for 'a, so nobody but the stage's own threads can reach the rows.
unsafe impl Send for SharedRows<'_> {}
unsafe impl Sync for SharedRows<'_> {}

impl<'a> SharedRows<'a> {
    /// Shares a slice for as long as it stays borrowed.
    #[inline]
    pub(crate) fn new(rows: &'a mut [Row]) -> Self {
        Self { start: rows.as_mut_ptr(), len: rows.len(), marker: PhantomData }
    }

    /// A copy of row `index`.
    #[inline(always)]
    pub(crate) fn read(self, index: u32) -> Row {
        assert!((index as usize) < self.len);
        // SAFETY: in bounds by the assertion; no thread writes the row meanwhile, see the type.
        unsafe { self.start.add(index as usize).read() }
    }

    /// Overwrites the first half (velocity) of row `index`.
    #[inline(always)]
    pub(crate) fn write_half(self, index: u32, half: [f32; 4]) {
        assert!((index as usize) < self.len);
        // SAFETY: in bounds by the assertion; no other thread touches the row meanwhile, see the
        // type; a half row is the first 16 of its 32 bytes.
        unsafe { self.start.add(index as usize).cast::<[f32; 4]>().write(half) }
    }

    /// Overwrites row `index`.
    #[inline(always)]
    pub(crate) fn write(self, index: u32, row: Row) {
        assert!((index as usize) < self.len);
        // SAFETY: in bounds by the assertion; no other thread touches the row meanwhile, see the type.
        unsafe { self.start.add(index as usize).write(row) }
    }
}
