//! What the narrow phase reads.

use crate::broad_phase::BroadPhase;
use crate::dynamics::{Bodies, BodyInfo, ShapeRecord, Shapes};
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
    /// Length of the step, seconds.
    pub(crate) dt: f32,
    /// Is anything fast?
    pub(crate) fast: bool,
    /// Are contacts that close in fast to be named?
    pub(crate) naming: bool,
}

impl<'a> Context<'a> {
    /// `settings` are the SIMD level, the speculative distance and the length unit.
    pub(crate) fn new(
        bodies: &'a Bodies,
        shapes: &'a Shapes,
        broad_phase: &'a BroadPhase,
        (level, speculative_distance, length_unit): (SimdLevel, f32, f32),
        jointed: bool,
        (dt, fast, naming): (f32, bool, bool),
    ) -> Self {
        Self {
            level,
            body_rows: &bodies.rows,
            poses: &bodies.poses,
            shape_rows: &shapes.rows,
            shapes: &shapes.records,
            infos: jointed.then_some(&bodies.infos),
            speculative_distance,
            surroundings: Surroundings { guards: &shapes.guards, broad_phase, length_unit },
            dt,
            fast,
            naming,
        }
    }
}

/// What looking at surfaces needs beyond the narrow phase's own.
#[derive(Clone, Copy)]
pub(crate) struct Surroundings<'a> {
    pub(crate) guards: &'a [u32],
    pub(crate) broad_phase: &'a BroadPhase,
    pub(crate) length_unit: f32,
}
