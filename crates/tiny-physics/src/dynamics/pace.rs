//! Paces: how finely the solver divides a step for an island.
//!
//! Most islands are solved at the world's own substeps. Those whose contacts would sink visibly at that
//! (tall stacks, heavy on light) get a multiple. All bodies of an island have the same pace, and so have
//! the contacts and joints between them; [`assign`](crate::stages::paces) sees to that.

/// Number of paces.
pub(crate) const PACES: usize = 4;

/// The world's substeps are multiplied by this.
pub(crate) const REFINEMENT: [u32; PACES] = [1, 2, 4, 8];

/// The pace of most islands.
pub(crate) const PLAIN: usize = 0;
