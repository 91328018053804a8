//! Continuous collision (stand-in).
use super::finalize::{FastBody, update_boxes};
use crate::broad_phase::BroadPhase;
use crate::dynamics::{Bodies, Shapes};

pub(crate) fn run(
    fast: &[FastBody],
    bodies: &mut Bodies,
    shapes: &Shapes,
    broad_phase: &mut BroadPhase,
    _speculative: f32,
) {
    for f in fast {
        let motion = bodies.poses[f.body as usize].p.relative_to(f.start.p);
        update_boxes(bodies, shapes, broad_phase, f.body, motion);
    }
}
