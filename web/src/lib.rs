//! The engine for JavaScript: a plain C ABI, without generated glue.
//!
//! JavaScript holds numbers: a *session* (a world with what belongs to it) and handles in it, packed into 53 bits. An
//! argument that is more than a number is written to the input buffer, whose address [`tp_input`] gives. What is more than
//! a number comes back as numbers or text in buffers whose addresses [`tp_numbers`] and [`tp_text`] give, until the next
//! call. Every function that can fail returns 0 (false) where it did, with the engine's words as the text.
//!
//! Everything that changes a world is a [`Command`](tiny_physics::record::Command), so recordings and histories miss
//! nothing.
#![allow(unsafe_code, reason = "an exported name counts as unsafe")]

mod ask;
#[cfg(feature = "playground")]
mod catalogue;
#[cfg(feature = "playground")]
mod doctor;
#[cfg(feature = "playground")]
mod draw;
mod handles;
mod order;
mod outcome;
#[cfg(feature = "playground")]
mod picture;
#[cfg(feature = "playground")]
mod places;
mod read;
mod session;
mod shelf;
mod views;

pub use session::Session;
pub use shelf::Shelf;

use core::cell::RefCell;
use outcome::Outcome;

thread_local! {
    static SHELF: RefCell<Shelf> = RefCell::new(Shelf::default());
}

/// What all functions work on: this module has one thread.
pub(crate) fn with_shelf<T>(work: impl FnOnce(&mut Shelf) -> T) -> T {
    SHELF.with_borrow_mut(work)
}

/// Does something with a session; false with the reason as text where that fails.
pub(crate) fn with(session: u32, work: impl FnOnce(&mut Session, &mut Shelf) -> Outcome) -> bool {
    with_shelf(|shelf| shelf.with(session, work))
}

/// Makes the input buffer so many bytes long and gives its address.
#[unsafe(no_mangle)]
pub extern "C" fn tp_input(length: usize) -> *mut u8 {
    with_shelf(|shelf| {
        shelf.input.resize(length, 0);
        shelf.input.as_mut_ptr()
    })
}

/// Gives memory of large inputs and outputs back.
#[unsafe(no_mangle)]
pub extern "C" fn tp_tidy() {
    with_shelf(|shelf| {
        shelf.input = Vec::new();
        shelf.text = Vec::new();
        shelf.numbers = Vec::new();
    });
}

/// Address of the text of the last call: UTF-8, or bytes of a frame or recording.
#[unsafe(no_mangle)]
pub extern "C" fn tp_text() -> *const u8 {
    with_shelf(|shelf| shelf.text.as_ptr())
}

/// Its bytes.
#[unsafe(no_mangle)]
pub extern "C" fn tp_text_length() -> usize {
    with_shelf(|shelf| shelf.text.len())
}

/// Address of the numbers of the last call.
#[unsafe(no_mangle)]
pub extern "C" fn tp_numbers() -> *const f64 {
    with_shelf(|shelf| shelf.numbers.as_ptr())
}

/// How many there are.
#[unsafe(no_mangle)]
pub extern "C" fn tp_numbers_length() -> usize {
    with_shelf(|shelf| shelf.numbers.len())
}
