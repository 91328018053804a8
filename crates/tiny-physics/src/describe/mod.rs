//! What a user hands to the world: plain data that describes bodies, shapes, joints and settings.
//!
//! Descriptions have public fields and builder methods, can be compared, cloned and (feature `serde`)
//! written to a file. The world copies what it needs; changing a description later changes nothing.

mod body;
mod chain;
mod filter;
mod joint;
mod settings;
mod shape;
mod tiles;

pub use body::{BodyKind, Locks, RigidBody};
pub use chain::ChainDef;
pub use filter::Filter;
pub use joint::{Break, JointDef, JointKind, Limits, Motor, Spring};
pub use settings::{Mix, Settings};
pub use shape::{ChainLink, Material, ShapeDef};
pub(crate) use tiles::{BLOCK_CELLS, Piece};
pub use tiles::{Tile, TileForm, TileGrid};
