//! Contacts of the world: their life, and how the user sees them.

use super::World;
use super::events::{ContactBegin, ContactEnd, Hit};
use super::ids::{BodyId, ShapeId};
use super::state::State;
use crate::describe::BodyKind;
use crate::dynamics::{Bucket, Contact, NULL, PLAIN, Place, REFINEMENT, flags, pace_at};
use crate::math::{DVec2, Vec2};
use crate::simd::BLOCK;
use crate::stages::islands::Stores;
use crate::stages::solve::Lengths;
use crate::stages::touching::Changes;
use crate::stages::{one_way, paces, pairs, rests, sleep};
use crate::threads::Team;

/// Part of its length by which a step is another than the one before.
const LEAP: f32 = 0.1;

/// One point of a contact.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactPoint {
    /// World, metres.
    pub position: DVec2,
    /// Metres; negative is overlap.
    pub separation: f32,
    /// Newton seconds in the last substep.
    pub normal_impulse: f32,
    /// Newton seconds in the last substep, positive along the normal turned clockwise.
    pub tangent_impulse: f32,
    /// Newton seconds along the normal in the whole step, with what bounces took. It is summed up only where a shape
    /// asks for hit events; elsewhere it is what the last substep's makes in a step, which is right for what rests.
    pub total_impulse: f32,
}

/// A contact as of the last step.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactView {
    /// First shape.
    pub shape_a: ShapeId,
    /// Second shape.
    pub shape_b: ShapeId,
    /// Body of the first shape.
    pub body_a: BodyId,
    /// Body of the second shape.
    pub body_b: BodyId,
    /// Unit, world, from A to B.
    pub normal: Vec2,
    points: [ContactPoint; 2],
    count: u8,
    /// Substeps a second.
    rate: f32,
    /// Length of the step, seconds.
    dt: f32,
}

impl ContactView {
    /// Newton seconds that B was pushed along the normal in the last step: see [`ContactPoint::total_impulse`].
    pub fn total_impulse(&self) -> f32 {
        self.points().iter().map(|point| point.total_impulse).sum()
    }

    /// Mean force on B in the last step, newtons, world: normal impulses by the step's length, and friction as of the
    /// last substep. The opposite acts on A.
    ///
    /// ```
    /// use tiny_physics::prelude::*;
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new((0.0, -10.0));
    /// let scales = world.add_body(RigidBody::fixed().shape(Shape::rect(2.0, 0.5)?))?;
    /// let weight = RigidBody::dynamic().position((0.0, 0.9)).shape(Shape::rect(0.4, 0.4)?).mass(3.0);
    /// world.add_body(weight)?;
    /// (0..20).for_each(|_| world.step(1.0 / 60.0));
    /// let shown: f32 = world.body(scales).unwrap().contacts().map(|contact| contact.force().length()).sum();
    /// assert!((shown - 30.0).abs() < 0.5);
    /// # Ok(())
    /// # }
    /// ```
    pub fn force(&self) -> Vec2 {
        let tangent = Vec2::new(self.normal.y, 0.0 - self.normal.x);
        let friction: f32 = self.points().iter().map(|point| point.tangent_impulse).sum();
        self.normal * (self.total_impulse() / self.dt) + tangent * (friction * self.rate)
    }

    /// One or two points.
    pub fn points(&self) -> &[ContactPoint] {
        &self.points[..usize::from(self.count)]
    }
}

impl World {
    /// Contacts that touch (or are about to) and are awake.
    pub fn contact_count(&self) -> usize {
        self.state.graph.touching_count()
    }

    /// The contacts that touch (or are about to) and are awake, as of the last step, in a fixed order
    /// that threads do not change. Those of a body that has woken since are not known before the next step.
    pub fn contacts(&self) -> impl Iterator<Item = ContactView> + '_ {
        self.state.graph.touching_buckets().flat_map(move |(_, bucket)| {
            (0..bucket.contacts.len()).filter_map(move |slot| self.known_view(bucket, slot))
        })
    }

    /// A contact as the user sees it, where it touches and is awake.
    pub(super) fn contact_view(&self, index: u32) -> Option<ContactView> {
        let contact = &self.state.contacts.records[index as usize];
        let Place::Graph { colour, slot } = contact.place else { return None };
        let bucket = self.state.graph.find(usize::from(colour), contact.class)?;
        contact.touching.then(|| self.known_view(bucket, slot as usize)).flatten()
    }

    /// A contact as the last step left it; one that has just woken is not known before the next.
    fn known_view(&self, bucket: &Bucket, slot: usize) -> Option<ContactView> {
        let view = self.view(bucket, slot);
        (view.normal != Vec2::ZERO).then_some(view)
    }

    pub(super) fn view(&self, bucket: &Bucket, slot: usize) -> ContactView {
        let (block, lane) = (slot / BLOCK, slot % BLOCK);
        let contact = &self.state.contacts.records[bucket.contacts[slot] as usize];
        let (manifold, constraint) = (&bucket.manifolds[block], &bucket.constraints[block]);
        let pace = match contact.place {
            Place::Graph { colour, .. } => pace_at(colour.into()),
            Place::Asleep => PLAIN,
        };
        let refinement = REFINEMENT[pace] as f32;
        let substeps = refinement * self.last.substeps as f32;
        let surface = &bucket.surfaces[block];
        let totals = contact.hit_events.then_some([surface.total_1[lane], surface.total_2[lane]]);
        let normal = Vec2::new(constraint.normal_x[lane], constraint.normal_y[lane]);
        // Where one of them stands still, by that one: the other may have gone on from where they met.
        let [a, b] = [contact.body_a, contact.body_b];
        let from_b = self.state.bodies.infos[b as usize].kind == BodyKind::Static;
        let center = self.state.bodies.poses[if from_b { b } else { a } as usize].p;
        let mut points = [ContactPoint {
            position: DVec2::ZERO,
            separation: 0.0,
            normal_impulse: 0.0,
            tangent_impulse: 0.0,
            total_impulse: 0.0,
        }; 2];
        let mut count = 0;
        let ids = [manifold.id_1[lane], manifold.id_2[lane]];
        for (k, point) in constraint.points.iter().enumerate() {
            if ids[k] < 0.0 {
                continue;
            }
            // r x n and r x t = -(r . n) give the anchor back.
            let (across, along) = if from_b {
                (point.normal_arm_b[lane], -point.tangent_arm_b[lane])
            } else {
                (point.normal_arm_a[lane], -point.tangent_arm_a[lane])
            };
            let anchor = normal * along + Vec2::new(normal.y, -normal.x) * across;
            points[count] = ContactPoint {
                position: center + anchor,
                separation: point.separation[lane],
                normal_impulse: point.load[lane],
                tangent_impulse: point.tangent_impulse[lane],
                total_impulse: totals.map_or(point.load[lane] * substeps, |t| t[k]),
            };
            count += 1;
        }
        ContactView {
            shape_a: self.shape_id(contact.shape_a),
            shape_b: self.shape_id(contact.shape_b),
            body_a: self.body_id(contact.body_a),
            body_b: self.body_id(contact.body_b),
            normal,
            points,
            count: count as u8,
            rate: self.state.inv_h * refinement,
            dt: self.last_dt(),
        }
    }

    /// The same within the step, while the bodies of contacts that were foreseen still have a way to go.
    pub(super) fn view_ahead(&self, bucket: &Bucket, slot: usize) -> ContactView {
        let (mut view, index) = (self.view(bucket, slot), bucket.contacts[slot]);
        let moves = self.state.bodies.infos[view.body_b.index()].kind != BodyKind::Static;
        if let Some(foreseen) = self.scratch.predictions.of(index).filter(|_| moves) {
            view.points.iter_mut().for_each(|point| point.position += foreseen.way);
        }
        view
    }

    /// Deepest overlap of any awake contact as of the last step, metres; 0 where nothing overlaps.
    pub fn max_penetration(&self) -> f32 {
        let deepest = self
            .contacts()
            .flat_map(|contact| contact.points().iter().map(|p| p.separation).fold(None, least))
            .fold(0.0, |a: f32, b| if b < a { b } else { a });
        -deepest
    }

    /// Notes which contacts were hit in the substeps faster than the threshold.
    pub(super) fn collect_hits(&mut self) {
        let threshold = self.settings.hit_event_threshold * self.settings.length_unit;
        let mut hits = core::mem::take(&mut self.state.events.hits);
        for (_, bucket) in self.state.graph.touching_buckets() {
            for (block, head) in bucket.heads.iter().enumerate() {
                if head.flags & flags::HIT == 0 {
                    continue;
                }
                let end = (block * BLOCK + BLOCK).min(bucket.contacts.len());
                hits.extend(
                    (block * BLOCK..end).filter_map(|slot| self.hit(bucket, slot, threshold)),
                );
            }
        }
        hits.sort_unstable_by_key(|hit| (hit.shape_a, hit.shape_b));
        self.state.events.hits = hits;
    }

    /// The hit of a contact, if it wants one and its fastest point was fast enough.
    fn hit(&self, bucket: &Bucket, slot: usize, threshold: f32) -> Option<Hit> {
        let (block, lane) = (slot / BLOCK, slot % BLOCK);
        if !self.state.contacts.records[bucket.contacts[slot] as usize].hit_events {
            return None;
        }
        let (surface, manifold) = (&bucket.surfaces[block], &bucket.manifolds[block]);
        let mut fastest: Option<(usize, f32)> = None;
        let ids = [manifold.id_1[lane], manifold.id_2[lane]];
        let foreseen = self.scratch.predictions.of(bucket.contacts[slot]);
        let approach = foreseen
            .map_or([surface.approach_1[lane], surface.approach_2[lane]], |known| known.parting);
        let total = [surface.total_1[lane], surface.total_2[lane]];
        for (point, k) in (0..2).filter(|&k| ids[k] >= 0.0).enumerate() {
            let speed = -approach[k];
            if total[k] > 0.0 && speed > threshold && fastest.is_none_or(|(_, most)| speed > most) {
                fastest = Some((point, speed));
            }
        }
        let (point, speed) = fastest?;
        let view = self.view_ahead(bucket, slot);
        let contact = &self.state.contacts.records[bucket.contacts[slot] as usize];
        let [mass_a, mass_b] = [contact.body_a, contact.body_b]
            .map(|body| self.state.bodies.infos[body as usize].mass);
        Some(Hit {
            shape_a: view.shape_a,
            shape_b: view.shape_b,
            body_a: view.body_a,
            body_b: view.body_b,
            user_data_a: self.state.user_data(contact.shape_a),
            user_data_b: self.state.user_data(contact.shape_b),
            position: view.points()[point].position,
            normal: view.normal,
            speed,
            impulse: view.total_impulse(),
            mass_a,
            mass_b,
        })
    }

    /// Moves contacts that began or ended to where they belong in the graph, and wakes what was touched.
    pub(super) fn transfer(&mut self, team: &Team, changes: &Changes) {
        let Changes { began, ended, .. } = changes;
        if began.is_empty() && ended.is_empty() {
            return;
        }
        let mut transfers = core::mem::take(&mut self.scratch.transfers);
        let both = || ended.iter().chain(began).copied();
        let State { graph, bodies, contacts, .. } = &mut self.state;
        transfers.remove(team, graph, bodies, contacts, both());
        ended.iter().for_each(|&index| self.end_contact(index));
        began.iter().for_each(|&index| self.begin_contact(index));
        // What wakes takes its contacts into the graph, by what has begun and ended.
        for &index in began {
            let contact = &self.state.contacts.records[index as usize];
            self.wake_dynamic([contact.body_a, contact.body_b]);
        }
        let State { graph, bodies, contacts, .. } = &mut self.state;
        transfers.insert(team, graph, bodies, contacts, both());
        self.scratch.transfers = transfers;
    }

    /// A contact no longer touches.
    fn end_contact(&mut self, index: u32) {
        let contact = &mut self.state.contacts.records[index as usize];
        contact.touching = false;
        contact.saved = [crate::dynamics::SavedPoint::NONE; 2];
        if contact.events {
            let end = self.end_event(index);
            self.state.events.contact_end.push(end);
        }
        // Changes of the shapes' events take effect between an end and the next begin.
        let contact = &mut self.state.contacts.records[index as usize];
        pairs::mix_materials(contact, &self.settings, &self.state.shapes);
    }

    /// May a contact that touches now begin? One-way platforms turn some down.
    pub(super) fn may_begin(&self, index: u32) -> bool {
        let contact = &self.state.contacts.records[index as usize];
        let lengths = (self.contact_reach(), self.settings.length_unit);
        one_way::may_begin(contact, &self.state.bodies, &self.state.shapes, lengths)
    }

    /// A contact has begun to touch.
    fn begin_contact(&mut self, index: u32) {
        let h = Lengths::new(self.stats.dt, &self.settings).h;
        let State { contacts, bodies, graph, .. } = &mut self.state;
        let contact = &mut contacts.records[index as usize];
        contact.touching = true;
        let pair = [contact.body_a, contact.body_b];
        graph.mixed |= paces::stir(bodies, pair, self.settings.length_unit, h);
        if self.scratch.predictions.of(index).is_none() {
            self.report_begin(index);
        }
    }

    /// Sends the begin event of a contact, if it has any.
    pub(super) fn report_begin(&mut self, index: u32) {
        let contact = &self.state.contacts.records[index as usize];
        if contact.events {
            let end = self.end_event(index);
            self.state.events.contact_begin.push(ContactBegin::from(end));
        }
    }

    /// Removes contacts for good.
    pub(super) fn destroy_contacts(&mut self, team: &Team, indices: &[u32]) {
        let State { graph, bodies, contacts, .. } = &mut self.state;
        self.scratch.transfers.remove(team, graph, bodies, contacts, indices.iter().copied());
        for &index in indices {
            if self.state.contacts.records[index as usize].touching {
                self.destroy_contact(index);
            } else {
                self.state.destroy_contact(index);
            }
        }
    }

    /// Removes a contact for good. What may have rested on it wakes: of what was put down asleep no step has seen whether it touches.
    pub(super) fn destroy_contact(&mut self, index: u32) {
        let contact = &self.state.contacts.records[index as usize];
        let bodies = [contact.body_a, contact.body_b];
        if contact.touching && contact.events {
            let end = self.end_event(index);
            self.state.events.pending_end.push(end);
        }
        if self.is_close(contact) {
            self.wake_dynamic(bodies);
        }
        self.state.destroy_contact(index);
    }

    /// May one of the bodies of a contact lean on the other? Fat boxes of what was fast reach far.
    pub(super) fn is_close(&self, contact: &Contact) -> bool {
        let Contact { touching, shape_a, shape_b, .. } = *contact;
        touching || self.state.shapes.are_near(shape_a, shape_b, self.contact_reach())
    }

    fn end_event(&self, index: u32) -> ContactEnd {
        let contact = &self.state.contacts.records[index as usize];
        ContactEnd {
            shape_a: self.shape_id(contact.shape_a),
            shape_b: self.shape_id(contact.shape_b),
            body_a: self.body_id(contact.body_a),
            body_b: self.body_id(contact.body_b),
            user_data_a: self.state.user_data(contact.shape_a),
            user_data_b: self.state.user_data(contact.shape_b),
        }
    }

    /// Wakes those of the bodies that are dynamic. A kinematic body that sleeps stands still, and may go on.
    fn wake_dynamic(&mut self, bodies: [u32; 2]) {
        for index in bodies {
            if self.state.bodies.is_dynamic(index) {
                self.wake_index(index);
            }
        }
    }

    /// Wakes the island of a body; with a kinematic body, also what rests on it or hangs on it.
    pub(super) fn wake_index(&mut self, index: u32) {
        if self.wake_island(index) {
            self.wake_carried(index);
        }
    }

    /// Wakes what rests on a body and what hangs on it. Kinematic bodies may do so in a long chain: so a list.
    pub(super) fn wake_carried(&mut self, index: u32) {
        let mut carried = self.carried_by(index);
        while let Some(body) = carried.pop() {
            if self.wake_island(body) {
                carried.extend(self.carried_by(body));
            }
        }
    }

    /// What rests on a body and what hangs on it, the first one last.
    fn carried_by(&self, index: u32) -> Vec<u32> {
        let contacts = self.state.contacts_of(index).filter(|(_, contact)| self.is_close(contact));
        let contacts = contacts.map(|(_, contact)| contact.other(index));
        let joints = self.state.joints_of(index).filter(|(_, joint)| joint.class().is_some());
        let joints = joints.map(|(_, joint)| joint.other(index));
        let mut others: Vec<u32> = contacts.chain(joints).collect();
        others.reverse();
        others
    }

    /// Wakes the island of a body. Is that a kinematic one that slept, so that what it carries is to wake, too?
    fn wake_island(&mut self, index: u32) -> bool {
        let (mut woken, scale) = (core::mem::take(&mut self.scratch.woken), self.kept_scale());
        let (stores, hinges) = self.sleep_stores();
        sleep::wake(index, stores, 1.0 / scale, &mut woken, hinges);
        // Not where it was awake already or is not enabled.
        let info = &self.state.bodies.infos[index as usize];
        let starts_to_carry = info.kind == BodyKind::Kinematic && !woken.is_empty();
        for &body in &woken {
            let body = self.body_id(body);
            self.state.events.pending_woke.push(body);
        }
        self.scratch.woken = woken;
        starts_to_carry
    }

    /// Puts islands (each ended by NULL) to sleep.
    pub(super) fn put_to_sleep(&mut self, islands: &[u32]) {
        if islands.is_empty() {
            return;
        }
        debug_assert_eq!(islands.last(), Some(&NULL));
        for &body in islands.iter().filter(|&&body| body != NULL) {
            let body = self.body_id(body);
            self.state.events.pending_asleep.push(body);
        }
        self.state.waiting.stale = true;
        let scale = self.kept_scale();
        let (stores, hinges) = self.sleep_stores();
        sleep::put_to_sleep(islands, stores, scale, hinges);
    }

    /// By how much the impulses that sleepers keep are those of another substep than the last one.
    fn kept_scale(&self) -> f32 {
        let State { inv_h, inv_h_asleep, .. } = self.state;
        if inv_h > 0.0 { inv_h / inv_h_asleep } else { 1.0 }
    }

    /// Makes impulses those of the substeps of the step that begins, and contacts as soft as in those before.
    pub(super) fn follow_lengths(&mut self, lengths: Lengths) -> Lengths {
        let State { graph, joint_graph, inv_h, inv_h_asleep, coarse_h, .. } = &mut self.state;
        let new = 1.0 / lengths.h;
        let leaps = *inv_h != 0.0 && (*inv_h / new - 1.0).abs() > LEAP;
        if *inv_h_asleep == 0.0 {
            *inv_h_asleep = new;
        } else if *inv_h != new {
            graph.scale(*inv_h / new);
            joint_graph.scale(*inv_h / new);
        }
        *inv_h = new;
        Lengths { leaps, ..lengths.after(*coarse_h).0 }
    }

    /// Lets what rests stay where it is as contacts become softer or firmer. Once all have the masses that they are solved with:
    /// by its own, what is laden sinks too far, is held against that, and sways for ever.
    pub(super) fn stay_at_rest(&mut self, lengths: Lengths) {
        let (lengths, coarse) = lengths.after(self.state.coarse_h);
        if core::mem::replace(&mut self.state.coarse_h, coarse) != coarse {
            let compliance = self.solver_rules(lengths).compliance();
            let State { graph, bodies, .. } = &mut self.state;
            rests::stay(graph, bodies, compliance);
        }
    }

    /// What changes when bodies fall asleep and wake, and memory for it.
    fn sleep_stores(&mut self) -> (Stores<'_>, &mut Vec<u32>) {
        (self.state.solved(), &mut self.scratch.hinges)
    }
}

fn least(a: Option<f32>, b: f32) -> Option<f32> {
    Some(a.map_or(b, |a| if b < a { b } else { a }))
}
