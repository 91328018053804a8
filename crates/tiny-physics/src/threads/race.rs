//! Only where it is built with `--cfg tiny_physics_race`, as the build server does for its tests: finds chunks of one stage that touch what another chunk of it writes.
//!
//! Ownership is by chunk, not by thread, so that an overlap shows in every run and not only when
//! two threads happen to meet. Notes live in a table of fixed size where a newer element may push out an
//! older one: a rare miss, never a false alarm, because a note counts only for its own slice, index and
//! stage.

use std::cell::Cell;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

/// What a chunk does to an element.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Access {
    Read,
    Write,
}

/// A chunk of a stage; stage 0 stands for "outside of any".
#[derive(Clone, Copy, PartialEq, Eq)]
struct Chunk {
    stage: u64,
    index: usize,
}

const OUTSIDE: Chunk = Chunk { stage: 0, index: 0 };
/// In `Note::reader`: chunks of the stage, more than one.
const SEVERAL: usize = usize::MAX;

#[derive(Clone, Copy)]
struct Note {
    slice: u64,
    element: u32,
    writer: Chunk,
    reader: Chunk,
}

const NO_NOTE: Note = Note { slice: 0, element: 0, writer: OUTSIDE, reader: OUTSIDE };
const NOTE_BITS: u32 = 14;
static NOTES: [Mutex<Note>; 1 << NOTE_BITS] = [const { Mutex::new(NO_NOTE) }; 1 << NOTE_BITS];
static LAST_ID: AtomicU64 = AtomicU64::new(0);

thread_local! {
    static CURRENT: Cell<Chunk> = const { Cell::new(OUTSIDE) };
}

/// A number for a slice that is about to be shared.
pub(super) fn new_slice() -> u64 {
    LAST_ID.fetch_add(1, Ordering::Relaxed) + 1
}

/// A number for a stage that is about to start.
#[allow(dead_code, reason = "not called where there are no threads")]
pub(super) fn new_stage() -> u64 {
    new_slice()
}

/// Marks this thread as being in a chunk until dropped.
pub(super) struct InChunk {
    outer: Chunk,
}

impl InChunk {
    #[allow(dead_code, reason = "not called where there are no threads")]
    pub(super) fn enter(stage: u64, index: usize) -> Self {
        Self { outer: CURRENT.replace(Chunk { stage, index }) }
    }
}

impl Drop for InChunk {
    fn drop(&mut self) {
        CURRENT.set(self.outer);
    }
}

/// Notes an access to an element of a shared slice.
///
/// # Panics
///
/// When another chunk of the stage wrote the element, or read what this one is to write.
pub(super) fn note(slice: u64, element: u32, access: Access) {
    let chunk = CURRENT.get();
    if chunk.stage == 0 {
        return;
    }
    let mixed = (slice << 32 ^ u64::from(element)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let place = &NOTES[(mixed >> (64 - NOTE_BITS)) as usize];
    let clash = {
        let mut note = place.lock().unwrap_or_else(PoisonError::into_inner);
        if note.slice != slice || note.element != element {
            *note = Note { slice, element, ..NO_NOTE };
        }
        note.add(chunk, access)
    };
    if let Some(other) = clash {
        panic!(
            "two chunks of one stage touch element {element} of a shared slice: \
             chunk {} and chunk {other}",
            chunk.index
        );
    }
}

impl Note {
    /// Adds an access; gives the chunk that it clashes with.
    fn add(&mut self, chunk: Chunk, access: Access) -> Option<usize> {
        let clash = |other: Chunk| {
            (other.stage == chunk.stage && other.index != chunk.index).then_some(other.index)
        };
        match access {
            Access::Read => {
                let other = clash(self.writer);
                let others_read = clash(self.reader).is_some();
                self.reader = if others_read { Chunk { index: SEVERAL, ..chunk } } else { chunk };
                other
            }
            Access::Write => {
                let other = clash(self.writer).or_else(|| clash(self.reader));
                self.writer = chunk;
                other
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clashes(accesses: &[(u64, usize, Access)]) -> bool {
        let slice = new_slice();
        std::panic::catch_unwind(|| {
            for &(stage, index, access) in accesses {
                let _inside = InChunk::enter(stage, index);
                note(slice, 7, access);
            }
        })
        .is_err()
    }

    #[test]
    fn only_chunks_of_one_stage_clash() {
        use Access::{Read, Write};
        assert!(!clashes(&[(1, 0, Write), (1, 0, Read), (1, 0, Write)]));
        assert!(!clashes(&[(1, 0, Write), (2, 1, Write), (3, 2, Read)]));
        assert!(!clashes(&[(1, 0, Read), (1, 1, Read), (1, 2, Read), (2, 0, Write)]));
        assert!(clashes(&[(1, 0, Write), (1, 1, Write)]));
        assert!(clashes(&[(1, 0, Write), (1, 1, Read)]));
        assert!(clashes(&[(1, 0, Read), (1, 1, Write)]));
        assert!(clashes(&[(1, 0, Read), (1, 1, Read), (1, 1, Write)]));
    }

    #[test]
    fn nothing_is_noted_outside_of_stages() {
        let slice = new_slice();
        note(slice, 0, Access::Write);
        let _inside = InChunk::enter(new_stage(), 0);
        note(slice, 0, Access::Write);
    }
}
