//! What goes on from one piece of ground to the next hands on its load.
//!
//! Friction goes by the load of the substep before, and a contact that begins has none: what touches with one point lost a substep
//! of friction at each seam, and on pieces shorter than its way in a step it was never braked. So where a body leaves one piece and
//! comes onto another in the same step, along nearly the same normal, the new contact begins with what the old one bore.

use crate::dynamics::{Bodies, Contact, Contacts, Graph, Place, REFINEMENT, pace_at};
use crate::math::Vec2;
use crate::simd::BLOCK;
use crate::stages::anew::{Course, Scope};

/// Normals differ by no more than this, as a cosine: beyond its edge that of what was left leans over.
const ALIGNED: f32 = 0.5;

/// What a contact that ended bore.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Load {
    /// The body that it bore, and what that stood on.
    body: u32,
    ground: u32,
    /// Towards the body.
    normal: Vec2,
    /// Newton seconds in a substep at the plain pace.
    impulse: f32,
}

/// Lists what contacts bore that end, in a step of `dt` seconds.
pub(crate) fn list(
    ended: &[u32],
    (bodies, contacts, graph): (&Bodies, &Contacts, &Graph),
    (scope, dt): (Scope<'_>, f32),
    loads: &mut Vec<Load>,
) {
    loads.clear();
    for &index in ended {
        let contact = &contacts.records[index as usize];
        let impulse = At::of(graph, contact).map_or(0.0, |at| at.load(graph));
        if impulse > 0.0 {
            // The lanes have no normal any more where neighbours cover what is nearest.
            let both = [contact.body_a, contact.body_b];
            let course = Course::new(bodies, both, 0.0, dt);
            let shapes = [contact.shape_a, contact.shape_b];
            let (frame, found) = course.collide(bodies, scope, shapes);
            let normal = frame.q.rotate(found.normal);
            let loads_of = [(both[0], both[1], -normal), (both[1], both[0], normal)];
            for (body, ground, normal) in loads_of {
                if bodies.is_solved(body) && found.count > 0 {
                    loads.push(Load { body, ground, normal, impulse });
                }
            }
        }
    }
}

/// Gives it to contacts that bear nothing yet.
pub(crate) fn hand_on(loads: &[Load], (bodies, contacts): (&Bodies, &Contacts), graph: &mut Graph) {
    for load in loads {
        let first = bodies.infos[load.body as usize].first_contact;
        let mut best: Option<(f32, u32, At)> = None;
        for (index, side) in contacts.of_body(first) {
            let contact = &contacts.records[index as usize];
            let Some(at) = At::of(graph, contact).filter(|_| contact.touching) else { continue };
            let ground = contact.other(load.body);
            let goes_on = ground == load.ground
                || !bodies.is_solved(ground) && !bodies.is_solved(load.ground);
            let sign = if side == 0 { -1.0 } else { 1.0 };
            let aligned = at.normal(graph).dot(load.normal) * sign;
            let is_better = best
                .is_none_or(|(most, known, _)| aligned > most || aligned == most && index < known);
            if goes_on && aligned > ALIGNED && at.load(graph) == 0.0 && is_better {
                best = Some((aligned, index, at));
            }
        }
        if let Some((_, _, at)) = best {
            at.set_load(graph, load.impulse);
        }
    }
}

/// Where a contact is that the solver visits, and how many of its substeps are one at the plain pace.
#[derive(Clone, Copy)]
struct At {
    bucket: usize,
    block: usize,
    lane: usize,
    finer: f32,
}

impl At {
    fn of(graph: &Graph, contact: &Contact) -> Option<Self> {
        let (bucket, slot) = graph.solved_at(contact)?;
        let Place::Graph { colour, .. } = contact.place else { return None };
        let finer = REFINEMENT[pace_at(colour.into())] as f32;
        Some(Self { bucket, block: slot / BLOCK, lane: slot % BLOCK, finer })
    }

    fn normal(self, graph: &Graph) -> Vec2 {
        let constraint = &graph.buckets.list()[self.bucket].constraints[self.block];
        Vec2::new(constraint.normal_x[self.lane], constraint.normal_y[self.lane])
    }

    /// What all its points bore in the last substep.
    fn load(self, graph: &Graph) -> f32 {
        let [one, other] = &graph.buckets.list()[self.bucket].constraints[self.block].points;
        (one.load[self.lane] + other.load[self.lane]) * self.finer
    }

    /// Has a point that it has bear that.
    fn set_load(self, graph: &mut Graph, impulse: f32) {
        let constraint = &mut graph.buckets.list_mut()[self.bucket].constraints[self.block];
        let point = constraint.points.iter_mut().find(|point| point.normal_mass[self.lane] > 0.0);
        if let Some(point) = point {
            point.normal_impulse[self.lane] = impulse / self.finer;
        }
    }
}
