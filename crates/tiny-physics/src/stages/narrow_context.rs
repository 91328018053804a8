//! What the narrow phase reads.

use super::pairs::PairRule;
use crate::broad_phase::BroadPhase;
use crate::dynamics::{Bodies, BodyInfo, Joints, Shapes};
use crate::simd::{Row, SimdLevel};

/// What the narrow phase reads.
#[derive(Clone, Copy)]
pub(crate) struct Context<'a> {
    pub(crate) level: SimdLevel,
    pub(crate) body_rows: &'a [Row],
    pub(crate) shape_rows: &'a [Row],
    /// Bodies, for whether they have joints; nothing where no joint is awake.
    pub(crate) infos: Option<&'a [BodyInfo]>,
    /// Points up to this far apart are contacts already, metres.
    pub(crate) speculative_distance: f32,
    /// For contacts with guarded shapes.
    pub(crate) ground: Ground<'a>,
    /// Length of the step, seconds.
    pub(crate) dt: f32,
    /// Is anything fast?
    pub(crate) fast: bool,
    /// Are contacts that close in fast to be named?
    pub(crate) naming: bool,
}

impl<'a> Context<'a> {
    pub(crate) fn new(
        ground: Ground<'a>,
        (level, speculative_distance): (SimdLevel, f32),
        (dt, fast, naming): (f32, bool, bool),
    ) -> Self {
        Self {
            level,
            body_rows: &ground.bodies.rows,
            shape_rows: &ground.shapes.rows,
            infos: (ground.joints.count > 0).then_some(&ground.bodies.infos),
            speculative_distance,
            ground,
            dt,
            fast,
            naming,
        }
    }
}

/// Where static shapes are found, and who meets whom.
#[derive(Clone, Copy)]
pub(crate) struct Ground<'a> {
    pub(crate) bodies: &'a Bodies,
    pub(crate) shapes: &'a Shapes,
    pub(crate) broad_phase: &'a BroadPhase,
    pub(crate) joints: &'a Joints,
    /// The user's word on a pair of shapes, if there is any.
    pub(crate) custom: Option<&'a dyn PairRule>,
    pub(crate) length_unit: f32,
}
