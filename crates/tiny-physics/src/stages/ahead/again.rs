//! What hits took off its way is looked at again: what may it meet on its new one?

use super::courses::Courses;
use super::hits::goes_in;
use crate::broad_phase::{BroadPhase, ProxyKind};
use crate::dynamics::{Contact, Contacts, Graph};
use crate::footprint::footprint;
use crate::math::{Aabb, Vec2};
use crate::stages::ahead::{HARMLESS, SLIGHT};
use crate::stages::boxes::Moved;
use crate::stages::pairs::Partners;
use crate::threads::Team;

/// Bodies that one member of the team looks at at a time.
const CHUNK: usize = 32;
/// What touches already is looked at again if its body goes into it, so much of its way along the normal: however little that is,
/// another corner may come down.
const HEAD_ON: f32 = 0.7;
/// Pairs without a contact that one member of the team looks through at a time.
const PAIRS_CHUNK: usize = 1024;
/// The trees are asked for the partners of a body in the time in which so many pairs are looked through.
const PAIRS_OF_ONE: usize = 128;

/// A body that was taken off its way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Struck {
    pub(crate) body: u32,
    /// How far, in half thicknesses of its own.
    pub(super) astray: f32,
}

/// What a shape has to do with a round, as bits.
mod mark {
    pub(super) const NONE: u8 = 0;
    /// Its body was taken off its way.
    pub(super) const STRUCK: u8 = 1;
    /// And out of its fat box.
    pub(super) const OUT: u8 = 3;
}

/// Looks for what bodies may meet on their new ways.
#[derive(Debug, Default)]
pub(super) struct Again {
    /// By shape.
    marks: Vec<u8>,
    /// Pairs without a contact whose fat boxes have come to overlap in this step.
    late: Vec<(u32, u32)>,
    found: Vec<Found>,
}

#[derive(Debug, Default)]
struct Found {
    candidates: Vec<u32>,
    pairs: Vec<(u32, u32)>,
}

footprint!(Found { candidates, pairs });
footprint!(Again { marks, late } each { found });

/// What bodies are looked for in.
#[derive(Clone, Copy)]
pub(crate) struct Around<'a> {
    pub(crate) broad_phase: &'a BroadPhase,
    pub(crate) graph: &'a Graph,
    /// Pairs whose fat boxes overlap, but that have no contact.
    pub(crate) waiting: &'a [(u32, u32)],
    pub(crate) partners: Partners<'a>,
    pub(crate) dt: f32,
}

impl Again {
    /// Forgets the step before.
    pub(super) fn clear(&mut self) {
        self.late.clear();
    }

    /// Lists the contacts of struck bodies (of those that touch only where ways lead into them) and the pairs that need a
    /// contact now, sorted. `out` are the shapes that left their fat boxes.
    pub(super) fn run(
        &mut self,
        team: &Team,
        around: Around<'_>,
        (struck, out, courses): (&[Struck], &Moved, &Courses),
        candidates: &mut Vec<u32>,
        pairs: &mut Vec<(u32, u32)>,
    ) {
        let Partners { bodies, shapes, .. } = around.partners;
        let shapes_of = |of: &Struck| shapes.of_body(bodies.infos[of.body as usize].first_shape);
        self.marks.resize(shapes.records.len(), mark::NONE);
        let struck_shapes = || struck.iter().flat_map(shapes_of);
        struck_shapes().for_each(|shape| self.marks[shape as usize] = mark::STRUCK);
        out.iter().for_each(|&(shape, _)| self.marks[shape as usize] = mark::OUT);
        let few_wait = around.waiting.len() < PAIRS_OF_ONE * struck.len();

        let look = Look { around, marks: &self.marks, courses, few_wait };
        let chunks = team.map_chunks(struck.len(), CHUNK, &mut self.found, |range, found| {
            found.candidates.clear();
            found.pairs.clear();
            struck[range].iter().for_each(|of| look.add(of.body, found));
        });
        for found in chunks {
            candidates.extend_from_slice(&found.candidates);
            self.late.extend_from_slice(&found.pairs);
        }
        pairs.clear();
        for list in [if few_wait { around.waiting } else { &[] }, &self.late] {
            let chunks =
                team.map_chunks(list.len(), PAIRS_CHUNK, &mut self.found, |range, found| {
                    found.pairs.clear();
                    let is_struck = |&(a, b): &(u32, u32)| {
                        look.marks[a as usize] | look.marks[b as usize] != mark::NONE
                    };
                    let struck = list[range].iter().filter(|pair| is_struck(pair));
                    found.pairs.extend(struck.filter(|&&(a, b)| look.meet(a, b)));
                });
            chunks.iter().for_each(|found| pairs.extend_from_slice(&found.pairs));
        }
        pairs.sort_unstable();
        pairs.dedup();
        struck_shapes().for_each(|shape| self.marks[shape as usize] = mark::NONE);
    }
}

struct Look<'a> {
    around: Around<'a>,
    marks: &'a [u8],
    courses: &'a Courses,
    /// Are the waiting pairs looked through? If not, the trees are asked for all that was struck.
    few_wait: bool,
}

impl Look<'_> {
    /// Adds the contacts that a body may meet on its new way, and pairs without one whose fat boxes overlap.
    fn add(&self, body: u32, found: &mut Found) {
        let Around { broad_phase, partners, .. } = self.around;
        let Partners { bodies, shapes, contacts, .. } = partners;
        let info = &bodies.infos[body as usize];
        self.add_contacts(contacts, info.first_contact, &mut found.candidates);
        for shape in shapes.of_body(info.first_shape) {
            let aabb = match self.marks[shape as usize] {
                mark::OUT => shapes.fat[shape as usize],
                _ if self.few_wait => continue,
                _ => self.path(shape),
            };
            let mask = shapes.records[shape as usize].filter.reach().1;
            for kind in [ProxyKind::Dynamic, ProxyKind::Static, ProxyKind::Kinematic] {
                broad_phase.each_of(kind, &aabb, mask, |other| {
                    if partners.may_meet(shape, other) {
                        found.pairs.push((shape.min(other), shape.max(other)));
                    }
                });
            }
        }
    }

    fn add_contacts(&self, contacts: &Contacts, first: u32, candidates: &mut Vec<u32>) {
        for (index, side) in contacts.of_body(first) {
            let contact = &contacts.records[index as usize];
            // One of two struck bodies is enough.
            let is_other = side == 1 && self.marks[contact.shape_a as usize] != mark::NONE;
            if !is_other && self.may_hit(contact) {
                candidates.push(index);
            }
        }
    }

    fn may_hit(&self, contact: &Contact) -> bool {
        let Around { graph, partners, dt, .. } = self.around;
        let lane = graph.lane_of(contact);
        let Some((bucket, block, lane)) = lane.filter(|&(b, block, lane)| b.touches(block, lane))
        else {
            return partners.come_near(contact.shape_a, contact.shape_b);
        };
        // What touched a step ago may be apart by now: do ways lead into each other, as the points of the step's start say?
        let Partners { bodies, reach, .. } = partners;
        let both = [contact.body_a, contact.body_b];
        let [a, b] = both.map(|body| self.courses.of(bodies, dt, body));
        let half = bodies.thinner_half(both);
        let least = (HARMLESS * half).max((SLIGHT * reach).min(half));
        bucket.constraints.get(block).is_none_or(|constraint| {
            let normal = Vec2::new(constraint.normal_x[lane], constraint.normal_y[lane]);
            let motion = a.motion - b.motion;
            let goes_in = goes_in(constraint, lane, [&a, &b]) > least;
            goes_in || normal.dot(motion) > HEAD_ON * motion.length()
        })
    }

    /// Does one of two shapes that is struck come near the other, which it has no contact with?
    fn meet(&self, a: u32, b: u32) -> bool {
        let partners = self.around.partners;
        let reaches = |shape: u32, other: u32| {
            let other = &partners.shapes.fat[other as usize];
            self.marks[shape as usize] != mark::NONE && self.path(shape).overlaps(other)
        };
        partners.come_near(a, b) && (reaches(a, b) || reaches(b, a)) && partners.may_meet(a, b)
    }

    /// A box around all that a struck shape goes through.
    fn path(&self, shape: u32) -> Aabb {
        let Partners { shapes, ways, .. } = self.around.partners;
        shapes.tight[shape as usize].swept(ways[shape as usize])
    }
}
