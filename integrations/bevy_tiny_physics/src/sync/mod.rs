//! What a step does between components and world: one file a subject, in the order of a step in `plugin.rs`.

pub(crate) mod bodies;
pub(crate) mod characters;
pub(crate) mod colliders;
pub(crate) mod copies;
pub(crate) mod forces;
pub(crate) mod joints;
pub(crate) mod problems;
pub(crate) mod removal;
pub(crate) mod scene;
pub(crate) mod step;
pub(crate) mod tiles;
pub(crate) mod write;
