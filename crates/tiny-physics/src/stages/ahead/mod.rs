//! Looking ahead: contacts between things in motion are made in time, before they have gone into each other.
//!
//! Before pairs are looked for, [`reach`] lets the boxes of what is fast hold all that the step will take it through;
//! two shapes are near if they will be as one sees the other move. The narrow phase names the pairs that close in so
//! fast that they might meet in the step. [`Predictions::round`] looks for the time of impact of those alone and, where
//! there is one, makes the contact of that moment: its normal and points, and separations as far apart as the motion
//! up to then. The solver sees a contact with a gap, as any other. What passes by gets none, and what has come within the reach of
//! contacts, pushes nothing yet and passes loses its own, so nothing is deflected that would not have been hit.
//!
//! What a hit stops or throws may meet others that it would not have met by its old motion: a crowd behind its first
//! rank, a pile into which something is shot. So each hit hands on its impulse, as one hit alone would, and the
//! contacts of bodies that this makes go elsewhere are looked at again, in rounds; a hit that others make come sooner
//! pushes for longer. Hits of one moment do not slow each other: they bounce together. The contacts of hard hits are solved more often in
//! the substeps. Where a dull hit on something fixed alone turned a body, its way is looked for leg by leg, and what it would have met
//! without that waits for the next round.
//!
//! What forces, motors and springs are about to set going counts as taken off its way, too (`driven`).

mod again;
mod courses;
mod driven;
mod hits;
mod meeting;
mod predictions;
mod squeezed;

pub(crate) use again::Around;
pub(crate) use driven::{Held, moves};
pub(crate) use meeting::go_by;
pub(crate) use predictions::{Predictions, Scene};
pub(crate) use squeezed::HEAVIER;

use super::boxes::{self, Moved};
use crate::broad_phase::BroadPhase;
use crate::dynamics::{Bodies, Shapes};
use crate::footprint::footprint;
use crate::math::Vec2;
use crate::threads::Team;
use courses::Course;
use driven::Change;

/// Bodies that one member of the team looks at at a time.
const CHUNK: usize = 256;
/// What goes no further into another than this part of the smaller half thickness is left to the next step.
pub(crate) const HARMLESS: f32 = 0.03;
/// Nor does what goes no further in than this part of the reach of contacts, unless it is thin: then than half of both half
/// thicknesses. Two such may add up where one body is stopped by a third: at 1, 31 of 600 falling heaps had overlaps of more than 3 cm, at 0.7 14.
pub(crate) const SLIGHT: f32 = 0.7;

/// How far shapes will go in the step.
#[derive(Debug, Default)]
pub(crate) struct Ways {
    /// By shape, metres; zero for what is slow. Nothing at all where nothing is fast.
    pub(crate) of_shapes: Vec<Vec2>,
    /// Bodies that forces take far, ascending by place in the list of what is awake.
    pub(crate) forced: Vec<u32>,
    found: Vec<Found>,
}

#[derive(Debug, Default)]
struct Found {
    moved: Moved,
    fast: Vec<(u32, Vec2)>,
    forced: Vec<u32>,
}

impl Found {
    fn clear(&mut self) {
        self.forced.clear();
        self.moved.clear();
        self.fast.clear();
    }
}

footprint!(Found { moved, fast, forced });
footprint!(Ways { of_shapes, forced } each { found });

/// Lets the fat boxes of what moves further in a step of `dt` seconds than `limit` metres, or than half its thickness, hold all
/// that it goes through, and the tight ones all that it turns through; these are put right when the step ends. However thick it is: what it meets may be small.
pub(crate) fn reach(
    team: &Team,
    bodies: &Bodies,
    shapes: &mut Shapes,
    broad_phase: &mut BroadPhase,
    (dt, limit): (f32, f32),
    ways: &mut Ways,
) {
    let chunks = boxes::share(shapes, broad_phase, |boxes| {
        team.map_chunks(bodies.awake.len(), CHUNK, &mut ways.found, |range, found| {
            found.clear();
            for &body in &bodies.awake[range] {
                let info = &bodies.infos[body as usize];
                let way = Course::of(bodies, dt, body).way(bodies);
                let length = way.motion.length() + way.turn.abs() * info.max_extent;
                let thin = 0.0 < info.min_extent && info.min_extent < limit;
                // Also false for what is not finite.
                if length > if thin { info.min_extent } else { limit } && length < f32::MAX {
                    boxes.reach((info.first_shape, false), &way, &mut found.moved, &mut found.fast);
                }
                let is_forced = info.force != Vec2::ZERO || info.torque != 0.0;
                if is_forced && Change::by_force(bodies, body, dt).is_far(bodies, dt) {
                    found.forced.push(body);
                }
            }
        })
    });
    ways.of_shapes.clear();
    ways.forced.clear();
    let chunks = chunks.len();
    let found = core::mem::take(&mut ways.found);
    found[..chunks].iter().for_each(|found| ways.take_over(found, shapes, broad_phase));
    ways.found = found;
}

impl Ways {
    fn take_over(&mut self, found: &Found, shapes: &mut Shapes, broad_phase: &mut BroadPhase) {
        boxes::take_over(shapes, broad_phase, &found.moved);
        self.forced.extend_from_slice(&found.forced);
        if !found.fast.is_empty() {
            self.of_shapes.resize(shapes.records.len(), Vec2::ZERO);
        }
        for &(shape, way) in &found.fast {
            self.of_shapes[shape as usize] = way;
        }
    }
}
