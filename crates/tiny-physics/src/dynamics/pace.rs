//! Paces: how finely the solver divides a step for an island.
//!
//! Most islands are solved at the world's own substeps. Those whose contacts would sink visibly at that
//! (tall stacks, heavy on light) get a multiple. All bodies of an island have the same pace, and so have
//! the contacts and joints between them; [`assign`](crate::stages::paces) sees to that.

/// Number of paces.
pub(crate) const PACES: usize = 7;

/// The world's substeps are multiplied by this.
pub(crate) const REFINEMENT: [u32; PACES] = [1, 2, 4, 8, 1, 1, 4];

/// Rounds of joints and contacts in each pass of a substep: islands in which they bear each other need several. A third gains nothing
/// in 400 random worlds and costs a third more; with one alone 49 bodies pass others in place of 38, and bridges swing on.
pub(crate) const ROUNDS: [u32; PACES] = [1, 1, 1, 1, 2, 1, 1];

/// The pace of islands of joined bodies that touch something. For trees of joints alone, gaps of 400 random worlds add up to 2.7 m
/// in place of 1.9, overruns of limits to 3.6 rad and metres in place of 2.0; rain costs 5 % less.
pub(crate) const JOINTED: usize = 4;

/// The pace of islands with joints in loops that touch something: their energy is watched, no more. So it is at
/// [`JOINTED`].
pub(crate) const WATCHED: usize = 5;

/// The pace of islands of joined bodies that were just hit by something fast: four times the substeps, with a round each. In 600 random
/// worlds gaps add up to 1.68 m in place of 2.08, overruns of limits to 1.74 in place of 3.21, and 2 bodies pass in place of 5.
pub(crate) const STRUCK: usize = 6;

/// Are joints and contacts solved together at a pace?
pub(crate) const fn is_jointed(pace: usize) -> bool {
    pace == JOINTED || pace == STRUCK
}

/// The pace of most islands.
pub(crate) const PLAIN: usize = 0;
