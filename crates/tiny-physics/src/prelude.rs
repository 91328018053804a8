//! What most programs need: `use tiny_physics::prelude::*;`.

pub use crate::{
    Aabb, Body, BodyId, BodyKind, BodyMut, Chain, ChainDef, CharacterMover, DVec2, Error, Filter,
    FixedStep, JointDef, JointId, JointKind, Limits, Material, Motor, MoverInput, Polygon, Pose,
    QueryFilter, RigidBody, Rot, Settings, Shape, ShapeDef, ShapeId, Spring, TileGrid, Transform,
    Vec2, World,
};
