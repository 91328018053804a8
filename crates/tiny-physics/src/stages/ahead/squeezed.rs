//! Squeezed: light bodies between heavy ones that come and what nothing moves.
//!
//! A pass of the solver hands on no more of a heavy body's momentum than the light one in between takes up, so that of
//! a hundred times its mass went through it as through nothing. For the step in which something heavy comes, what is
//! squeezed therefore counts as half as heavy, and so does what it leans on, up to what nothing moves. As that stops
//! them all, no momentum is lost; what nothing backs keeps its own mass.

use crate::dynamics::{Bodies, Contacts, Graph, Slot};
use crate::footprint::footprint;
use crate::math::Vec2;

/// What is hit by something so many times its mass may be squeezed.
pub(crate) const HEAVIER: f32 = 4.0;
/// What is squeezed counts as one part in so many of what squeezes it.
const SHARE: f32 = 2.0;
/// How fast something in the row must come to squeeze, length units a second: what rests has its paces and rests.
pub(super) const COMING: f32 = 0.1;
/// Bodies in a row at most.
const LONGEST: usize = 16;
/// Bodies that are looked at in search of one row at most.
const MOST_SEEN: usize = 64;
/// A body backs another if its contact's normal leads on along the push, by this cosine.
const BACKED: f32 = 0.5;

/// Is one of two bodies light enough to be squeezed by the other, as their inverse masses say?
pub(super) fn is_uneven(a: f32, b: f32) -> bool {
    a.max(b) > HEAVIER * a.min(b) && a.min(b) > 0.0
}

/// A light body that a heavy one presses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pressed {
    pub(super) body: u32,
    /// Inverse mass of what presses it.
    pub(super) by: f32,
    /// Where to.
    pub(super) direction: Vec2,
    /// Does anything in the row so far come nearer?
    pub(super) coming: bool,
}

/// The light bodies of a step that heavy ones press.
#[derive(Debug, Default)]
pub(crate) struct Squeezed {
    pub(crate) pressed: Vec<Pressed>,
    /// Those that heavy ones hit hard.
    pub(crate) hit: Vec<u32>,
    /// Those whose mass is another in this step.
    pub(super) weighed: Vec<u32>,
    row: Vec<u32>,
    /// Bodies that the search for a row has come to.
    seen: Vec<u32>,
}

footprint!(Squeezed { pressed, hit, weighed, row, seen });

/// What rows are found in.
#[derive(Clone, Copy)]
struct Scene<'a> {
    bodies: &'a Bodies,
    contacts: &'a Contacts,
    graph: &'a Graph,
    length_unit: f32,
    /// Normals of contacts that will be made in the step.
    predicted: &'a dyn Fn(u32) -> Option<Vec2>,
}

impl Squeezed {
    pub(super) fn clear(&mut self) {
        self.pressed.clear();
        self.hit.clear();
    }

    /// Gives the bodies of rows that are squeezed the mass that they count as, and has their constraints written anew.
    pub(super) fn weigh(
        &mut self,
        bodies: &mut Bodies,
        contacts: &Contacts,
        graph: &mut Graph,
        length_unit: f32,
        predicted: &dyn Fn(u32) -> Option<Vec2>,
    ) {
        for &pressed in &self.pressed {
            self.row.clear();
            self.seen.clear();
            let scene = Scene { bodies, contacts, graph, length_unit, predicted };
            if scene.leads_to_fixed(pressed, &mut self.row, &mut self.seen) != Some(true) {
                continue;
            }
            for &body in &self.row {
                let row = &mut bodies.rows[body as usize];
                let part = SHARE * pressed.by / row[Slot::INV_MASS];
                if part < 1.0 {
                    row[Slot::INV_MASS] *= part;
                    row[Slot::INV_INERTIA] *= part;
                    self.weighed.push(body);
                    let first = bodies.infos[body as usize].first_contact;
                    let records =
                        contacts.of_body(first).map(|(index, _)| &contacts.records[index as usize]);
                    records.for_each(|contact| graph.refresh(contact));
                }
            }
        }
    }

    /// Gives them their own mass again. What their contacts carried was for another.
    pub(crate) fn release(&mut self, bodies: &mut Bodies, contacts: &Contacts, graph: &mut Graph) {
        for body in self.weighed.drain(..) {
            bodies.update_inverse_masses(body);
            let first = bodies.infos[body as usize].first_contact;
            for (index, _) in contacts.of_body(first) {
                graph.forget_impulses(&contacts.records[index as usize]);
            }
        }
    }
}

impl Scene<'_> {
    /// Does a row of light bodies lead from one that is pressed on to what nothing moves? If so: does anything in it come
    /// nearer? Lists the row.
    fn leads_to_fixed(
        self,
        pressed: Pressed,
        row: &mut Vec<u32>,
        seen: &mut Vec<u32>,
    ) -> Option<bool> {
        row.push(pressed.body);
        seen.push(pressed.body);
        let length = row.len();
        let first = self.bodies.infos[pressed.body as usize].first_contact;
        self.contacts.of_body(first).find_map(|(index, side)| {
            row.truncate(length);
            let contact = &self.contacts.records[index as usize];
            let other = if side == 0 { contact.body_b } else { contact.body_a };
            let normal = (self.predicted)(index).or_else(|| self.graph.normal(contact))?;
            let direction = if side == 0 { normal } else { -normal };
            if direction.dot(pressed.direction) < BACKED {
                return None;
            }
            let apart = self.bodies.velocity(other) - self.bodies.velocity(pressed.body);
            let coming = pressed.coming || apart.dot(direction) < -COMING * self.length_unit;
            let inverse_mass = self.bodies.inverse_masses(other).0;
            if inverse_mass == 0.0 {
                return Some(coming);
            }
            let light = inverse_mass > pressed.by && is_uneven(inverse_mass, pressed.by);
            let goes_on = light && length < LONGEST && seen.len() < MOST_SEEN;
            let next = Pressed { body: other, direction, coming, ..pressed };
            (goes_on && !seen.contains(&other)).then(|| self.leads_to_fixed(next, row, seen))?
        })
    }
}
