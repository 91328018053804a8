//! Contact manifolds: where two shapes touch, or are about to.
//!
//! The narrow phase. For a pair of shapes it gives a unit normal from A to B and up to two points,
//! each with its separation (negative is overlap) and an id that stays the same while the same
//! features face each other, so that impulses can be carried from step to step.
//!
//! Every shape but the general polygon is a *rounded box* ([`RoundedBox`]): a core box of half
//! extents `(hx, hy)` and a radius around it. A circle is `(0, 0)`, a capsule `(h, 0)`. The kernels
//! ([`box_box`] and its relatives) are written once over lanes and branch-free; the public
//! [`collide`] is their one-lane instance. Pairs with a general polygon have a kernel of their own
//! ([`general`]), which is the method of the boxes' over lists of corners.
//!
//! # Method
//!
//! 1. The axis of greatest separation of the cores, over the face normals of both (separating axis
//!    theorem; Gottschalk, Lin, Manocha, *OBBTree*, 1996, section 5, in the plane).
//! 2. Where the cores are apart and the nearest features are two corners, the normal is the line
//!    between them. It is enough to look at the face of step 1 and the edge that faces it: as a
//!    function of direction the gap between convex sets is quasi-concave where it is positive, so the best
//!    face normal is next to the true direction, and both corners lie on these two edges.
//! 3. Both edges are seen along the normal; where their shadows overlap, the ends of the overlap are
//!    the two points. This treats A and B alike, so the ids do not depend on which one the axis of step 1
//!    belongs to.
//!
//! # Invariants
//!
//! The normal has unit length and is never NaN, whatever the input: coincident centres, zero
//! extents and ties all have a fixed answer. Results have the same bits at every lane width.

mod box_box;
mod circle;
mod class;
mod collide;
mod contact;
mod face;
mod general;
mod lane;
mod points;
#[cfg(test)]
mod tests;

pub(crate) use box_box::box_box;
pub(crate) use circle::{box_circle, capsule_circle, circle_circle};
pub(crate) use class::{PairClass, RoundedBox, ShapeClass};
pub use collide::collide;
pub use contact::{Contact, contact};
pub(crate) use face::{collide_face, face_of, nearest_vertex, point_gap, support_height};
pub(crate) use general::{Outline, general};
pub(crate) use lane::{LaneManifold, LanePair};
pub use points::{Manifold, ManifoldPoint};
