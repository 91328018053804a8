//! The stages of a step, and what they share; `World::run_stages` has their order.
//!
//! Each stage is a function (or a few) over the two to four stores that it touches; none sees the
//! world.

pub(crate) mod ahead;
pub(crate) mod anew;
pub(crate) mod arcs;
pub(crate) mod boxes;
pub(crate) mod contact_solver;
pub(crate) mod continuous;
mod effective_mass;
pub(crate) mod finalize;
mod free;
pub(crate) mod heirs;
pub(crate) mod integrate;
pub(crate) mod islands;
pub(crate) mod joint_solver;
mod middle;
pub(crate) mod narrow_context;
pub(crate) mod narrow_phase;
pub(crate) mod one_way;
pub(crate) mod paces;
pub(crate) mod pairs;
mod passing;
pub(crate) mod passivity;
pub(crate) mod rests;
pub(crate) mod rocking;
pub(crate) mod sensors;
pub(crate) mod sleep;
pub(crate) mod solve;
pub(crate) mod surfaces;
pub(crate) mod sway;
pub(crate) mod touched;
pub(crate) mod touching;
pub(crate) mod tree_contacts;
