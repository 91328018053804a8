//! What the narrow phase reads.

use crate::broad_phase::BroadPhase;
use crate::dynamics::{BodyInfo, ShapeRecord};
use crate::math::Pose;
use crate::simd::{Row, SimdLevel};

/// What the narrow phase reads.
#[derive(Clone, Copy)]
pub(crate) struct Context<'a> {
    pub(crate) level: SimdLevel,
    pub(crate) body_rows: &'a [Row],
    pub(crate) poses: &'a [Pose],
    pub(crate) shape_rows: &'a [Row],
    pub(crate) shapes: &'a [ShapeRecord],
    /// Bodies, for whether they have joints; nothing where no joint is awake.
    pub(crate) infos: Option<&'a [BodyInfo]>,
    /// Points up to this far apart are contacts already, metres.
    pub(crate) speculative_distance: f32,
    /// For contacts with guarded shapes.
    pub(crate) surroundings: Surroundings<'a>,
}

/// What looking at surfaces needs beyond the narrow phase's own.
#[derive(Clone, Copy)]
pub(crate) struct Surroundings<'a> {
    pub(crate) guards: &'a [u32],
    pub(crate) broad_phase: &'a BroadPhase,
    pub(crate) length_unit: f32,
}
