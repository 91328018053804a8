//! A small, fast 2D rigid-body physics engine: walls hold, stacks stand, same bits everywhere.
//!
//! ```
//! use tiny_physics::prelude::*;
//! # fn main() -> Result<(), tiny_physics::Error> {
//! let mut world = World::new((0.0, -9.8));
//! world.add_body(RigidBody::fixed().position((0.0, -1.0)).shape(Shape::rect(20.0, 1.0)?))?;
//! let ball = world.add_body(RigidBody::dynamic().position((0.0, 4.0)).shape(Shape::circle(0.5)?))?;
//! for _ in 0..300 {
//!     world.step(1.0 / 60.0);
//! }
//! assert!((world.body(ball).unwrap().position().y - 0.5).abs() < 0.01);
//! # Ok(())
//! # }
//! ```
//!
#![doc = ""]
#![doc = include_str!("../guide/front.svg")]
//!
//! The [guide] has a page for each topic.
//!
//! # Contents
//!
//! | to | use |
//! |---|---|
//! | make a world, add to it, step it | [`World`], [`Settings`] |
//! | describe a body and its shapes | [`RigidBody`], [`ShapeDef`], [`Material`], [`Filter`], [`Shape`], [`Polygon`] |
//! | describe a joint | [`JointDef`], [`JointKind`] |
//! | draw ground | [`ChainDef`], [`TileGrid`], [the page](guide::ground) |
//! | let somebody walk | [`CharacterMover`], [the page](guide::character) |
//! | read a body, change it | [`Body`], [`BodyMut`], by its [`BodyId`] |
//! | read a joint, change it | [`JointRef`], [`JointMut`], by its [`JointId`] |
//! | read shapes and contacts | [`ShapeRef`], [`ContactView`] |
//! | learn what happened in a step | [`Events`], [`Stats`] |
//! | ask what is where | [`World::ray_cast`], [`World::cast_shape`], [`World::overlap_shape`], [`World::closest_point`], [`QueryFilter`] |
//! | change a shape; decide who collides | [`ShapeMut`], [`World::set_pair_filter`], [`World::set_pre_solve`] |
//! | blow up, blow about, float | [`Explosion`], [`Wind`], [`Water`], [`ForceZone`] |
//! | save a world, go back, record and play again | [`World::to_bytes`], [`World::restore_bytes`], [`record`] |
//! | step evenly where frames are uneven | [`FixedStep`] |
//! | draw | [`DebugDraw`] |
//! | collide two shapes without a world | [`collide`], [`contact`], [`geometry`] |
//! | calculate | [`Vec2`], [`Rot`], [`Transform`], [`Aabb`], [`math`] |
//! | find pairs of boxes without a world | [`broad_phase`], [`SpatialHash`] |
//! | choose an instruction set | [`SimdLevel`] |
//!
//! # Units and frames
//!
//! Metres, kilograms, seconds, radians anticlockwise; y points up. Bodies work best between 0.1 and 10 m; see
//! [`Settings::length_unit`] for pixels. Normals are unit vectors from A to B. Positions in the world have 64 bits inside
//! ([`DVec2`], [`Pose`]), everything else 32.
//!
//! # Bad input
//!
//! What describes something gives an [`Error`] that names the value. What changes a body by a number that is not
//! finite does nothing. Handles go stale when their body, shape or joint is removed, and never mean another.
//! Nothing panics.
//!
//! # Features
//!
//! `parallel` (default) lets a world use several threads; results do not depend on it. `serde` writes
//! descriptions, settings, worlds, handles and recordings to files of any format. `glam` and `mint` turn vectors
//! into those of other crates and back: what takes a vector takes theirs.

pub mod broad_phase;
mod codec;
mod describe;
mod dynamics;
mod error;
mod footprint;
pub mod geometry;
pub mod math;
mod play;
pub mod prelude;
mod simd;
mod stages;
mod threads;
mod work;
mod world;

pub use describe::*;
pub use error::Error;
pub use geometry::{Contact, Manifold, ManifoldPoint, collide, contact};
pub use geometry::{Polygon, Shape};
pub use math::{Aabb, DVec2, Pose, Rot, Transform, Vec2};
pub use play::*;
pub use simd::SimdLevel;
pub use world::*;

/// The examples of the README are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// Declares the pages of the guide. Their examples are tests; their links lead from page to page here, too.
#[cfg(any(doc, doctest))]
macro_rules! pages {
    ($($page:ident $file:literal)+) => {$(
        #[doc = include_str!("../guide/links.txt")]
        #[doc = include_str!(concat!("../guide/", $file, ".md"))]
        pub mod $page {}
    )+};
}

#[cfg(any(doc, doctest))]
#[doc = include_str!("../guide/links.txt")]
#[doc = include_str!("../guide/README.md")]
pub mod guide {
    pages! {
        bodies "bodies"
        changes_and_hooks "changes-and-hooks"
        character "character"
        coming_from_box2d "coming-from-box2d"
        coming_from_rapier "coming-from-rapier"
        debug_drawing "debug-drawing"
        events "events"
        faq "faq"
        filters_and_sensors "filters-and-sensors"
        first_steps "first-steps"
        forces "forces"
        ground "ground"
        joints "joints"
        performance "performance"
        queries "queries"
        saving "saving"
        shapes "shapes"
        troubleshooting "troubleshooting"
    }
}
