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
            shape_rows: &shapes.rows,
            infos: jointed.then_some(&bodies.infos),
            speculative_distance,
            ground: Ground::new(bodies, shapes, broad_phase, length_unit),
            dt,
            fast,
            naming,
        }
    }
}

/// Where static shapes are found.
#[derive(Clone, Copy)]
pub(crate) struct Ground<'a> {
    pub(crate) shapes: &'a [ShapeRecord],
    pub(crate) guards: &'a [u32],
    pub(crate) poses: &'a [Pose],
    pub(crate) broad_phase: &'a BroadPhase,
    pub(crate) length_unit: f32,
}

impl<'a> Ground<'a> {
    pub(crate) fn new(
        bodies: &'a Bodies,
        shapes: &'a Shapes,
        broad_phase: &'a BroadPhase,
        length_unit: f32,
    ) -> Self {
        let Shapes { records, guards, .. } = shapes;
        Self { shapes: records, guards, poses: &bodies.poses, broad_phase, length_unit }
    }
}
