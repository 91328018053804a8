//! The plain data of a world: bodies, shapes, contacts, joints, and the constraint graph over them.
//!
//! Nothing here decides anything about physics: stores keep records and the links between them
//! consistent, the [`stages`](crate::stages) read and write them.

mod awake;
mod blocks;
mod bodies;
mod body_rows;
mod chosen;
mod coloured;
mod contacts;
mod disjoint_sets;
mod edges;
mod graph;
mod joint_blocks;
mod joint_forest;
mod joint_graph;
mod joints;
mod pace;
mod pair_table;
mod places;
mod schedule;
mod sensors;
mod shapes;
mod tidy;
#[cfg(test)]
mod transfer_tests;
mod transfers;
mod waiting;

pub(crate) use blocks::{
    BlockHead, ConstraintBlock, LaneBlock, ManifoldBlock, PointLanes, SurfaceBlock, flags,
};
pub(crate) use bodies::{Bodies, BodyInfo, Given, GivenPoint, Motion, NULL};
pub(crate) use body_rows::{LOCKED, Slot, give_along, inverse_mass_along, inverses, locked};
pub(crate) use chosen::Chosen;
pub(crate) use coloured::{COLOURS, IDLE, Place, TREES, colour_at, is_overflow, pace_at};
pub(crate) use contacts::{Contact, Contacts, SavedPoint};
pub(crate) use disjoint_sets::DisjointSets;
pub(crate) use edges::next_edge;
pub(crate) use graph::{Blocks, Bucket, Graph, HELD};
pub(crate) use joint_blocks::*;
pub(crate) use joint_forest::{JointTree, TreeAxis, TreeLink, TreeNode, TreeRow, is_rigid};
pub(crate) use joint_graph::{
    JointBlocks, JointBucket, JointColour, JointGraph, JointPlaces, joint_classes, with_bucket,
};
pub(crate) use joints::{JointLoad, JointRecord, Joints};
pub(crate) use pace::{JOINTED, PACES, PLAIN, REFINEMENT, ROUNDS, STRUCK, WATCHED, is_jointed};
#[cfg(test)]
use schedule::Listed;
pub(crate) use schedule::{Run, Schedule, Source};
pub(crate) use sensors::{Overlap, Sensors};
pub(crate) use shapes::{Change, ShapeRecord, Shapes, guard};
pub(crate) use tidy::Tidy;
pub(crate) use transfers::Transfers;
pub(crate) use waiting::Waiting;
