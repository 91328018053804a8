//! Contacts of chosen bodies, one line each, with normals that flip marked.

use core::fmt;
use std::collections::BTreeMap;
use tiny_physics::{BodyId, ContactView, ShapeId, Vec2, World};

/// A contact in one step, as a line.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct TracedContact {
    /// The step.
    pub step: u64,
    /// First body and shape.
    pub a: (BodyId, ShapeId),
    /// Second body and shape.
    pub b: (BodyId, ShapeId),
    /// Unit, from A to B.
    pub normal: Vec2,
    /// Metres; negative where there is a gap.
    pub depth: f32,
    /// Newton seconds in the last substep.
    pub impulse: f32,
    /// Degrees by which the normal has turned since the step before, where that is more than 20.
    pub flipped: Option<f32>,
}

impl fmt::Display for TracedContact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { step, a, b, normal, depth, impulse, flipped } = self;
        write!(
            f,
            "step {step:>6}  {} - {}  normal ({:+.3}, {:+.3})",
            a.0, b.0, normal.x, normal.y
        )?;
        write!(f, "  depth {:+.3} mm  impulse {impulse:.4} Ns", 1000.0 * depth)?;
        flipped.map_or(Ok(()), |degrees| write!(f, "  FLIPPED by {degrees:.0} degrees"))
    }
}

/// Follows the contacts of chosen bodies, or of all.
#[derive(Default, Debug, Clone)]
pub struct Trace {
    bodies: Vec<BodyId>,
    normals: BTreeMap<(ShapeId, ShapeId), (u64, Vec2)>,
    flips: u64,
}

/// Cosine of the angle from which on a normal has flipped.
const FLIP: f32 = 0.94;

impl Trace {
    /// Follows these bodies; all where there are none.
    pub fn new(bodies: Vec<BodyId>) -> Self {
        Self { bodies, ..Self::default() }
    }

    /// The contacts of the step that was just made, in the engine's order.
    pub fn lines(&mut self, world: &World) -> Vec<TracedContact> {
        let step = world.step_count();
        let all = self.bodies.is_empty();
        let bodies = core::mem::take(&mut self.bodies);
        let chosen = |contact: &ContactView| {
            all || bodies.contains(&contact.body_a) || bodies.contains(&contact.body_b)
        };
        let lines =
            world.contacts().filter(chosen).map(|contact| self.line(step, &contact)).collect();
        self.bodies = bodies;
        self.normals.retain(|_, (seen, _)| *seen == step);
        lines
    }

    /// Normals that have flipped so far.
    pub fn flips(&self) -> u64 {
        self.flips
    }

    fn line(&mut self, step: u64, contact: &ContactView) -> TracedContact {
        let key = (contact.shape_a, contact.shape_b);
        let before = self.normals.insert(key, (step, contact.normal));
        let cosine = before.map_or(1.0, |(_, normal)| normal.dot(contact.normal));
        let flipped = (cosine < FLIP).then(|| cosine.clamp(-1.0, 1.0).acos().to_degrees());
        self.flips += u64::from(flipped.is_some());
        let points = contact.points();
        let separation = points.iter().map(|point| point.separation).fold(f32::INFINITY, f32::min);
        TracedContact {
            step,
            a: (contact.body_a, contact.shape_a),
            b: (contact.body_b, contact.shape_b),
            normal: contact.normal,
            depth: -separation,
            impulse: points.iter().map(|point| point.normal_impulse).sum(),
            flipped,
        }
    }
}
