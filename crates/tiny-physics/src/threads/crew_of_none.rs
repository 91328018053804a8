//! The crew where there are no threads: nobody can be hired, so every stage runs on its caller.

use core::convert::Infallible;

/// Threads beside the caller: none.
#[derive(Debug)]
pub(super) struct Crew(Infallible);

/// The exclusive use of a crew.
pub(super) struct Section<'a>(&'a Crew);

impl Crew {
    /// No crew.
    pub(super) fn hire(_member_count: usize) -> Option<Self> {
        None
    }

    /// Number of members with the caller.
    pub(super) fn member_count(&self) -> usize {
        match self.0 {}
    }

    /// Never called: there is no crew.
    pub(super) fn open(&self) -> Option<Section<'_>> {
        match self.0 {}
    }
}

impl Section<'_> {
    /// Never called: there is no section.
    pub(super) fn run(&self, _chunk_count: u32, _chunk: &(dyn Fn(usize) + Sync)) {
        match self.0.0 {}
    }
}
