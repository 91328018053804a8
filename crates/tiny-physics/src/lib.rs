//! tiny-physics.
pub mod broad_phase;
mod describe;
#[allow(dead_code, unused_imports)]
mod dynamics {
    mod blocks;
    mod bodies;
    mod joint_blocks;
    mod joint_graph;
    mod joints;
    pub(crate) use blocks::*;
    pub(crate) use bodies::*;
    pub(crate) use joint_blocks::*;
    pub(crate) use joint_graph::*;
    pub(crate) use joints::*;
}
#[allow(dead_code)]
mod stages {
    pub(crate) mod contact_solver;
    pub(crate) mod integrate;
    pub(crate) mod joint_solver;
}
mod error;
pub mod geometry;
pub mod math;
mod simd;
mod threads;

pub use describe::*;
pub use error::Error;
pub use geometry::{Polygon, Shape};
pub use math::{Aabb, DVec2, Pose, Rot, Transform, Vec2};
pub use simd::SimdLevel;
