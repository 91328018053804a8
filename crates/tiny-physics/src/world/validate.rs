//! A walk over all invariants, for tests.

use super::World;
use super::build::proxy_kind;
use super::state::State;
use crate::dynamics::{Bodies, BodyInfo, COLOURS, IDLE, JointRecord, NULL, Place, colour_at};
use crate::stages::{boxes, pairs};

impl World {
    /// Checks every invariant of the world's data: links, colours, places, finite numbers. Slow; for
    /// tests and for hunting bugs.
    ///
    /// # Errors
    /// Says which invariant is broken and where.
    pub fn validate(&self) -> Result<(), String> {
        self.state.broad_phase.validate()?;
        self.check_links()?;
        self.validate_derived()?;
        self.validate_state()?;
        self.validate_pairs()
    }

    /// What lists and links alone do not show. They must be right.
    pub(super) fn validate_state(&self) -> Result<(), String> {
        self.validate_bodies()?;
        self.validate_contacts()?;
        self.validate_boxes()?;
        self.validate_joints()?;
        self.validate_colours()
    }

    /// What is no part of a frame, because it follows from the rest.
    fn validate_derived(&self) -> Result<(), String> {
        let State { bodies, contacts, .. } = &self.state;
        let places = "a body is elsewhere in the list of those that are awake";
        ensure(bodies.knows_awake_places(), || places.to_owned())?;
        let alive = || contacts.records.iter().zip(0..).filter(|(contact, _)| contact.alive);
        let known = alive().all(|(contact, index)| {
            contacts.pairs.get(contact.shape_a, contact.shape_b) == Some(index)
        });
        let same = known && contacts.pairs.len() == alive().count();
        ensure(same, || "the pair table is not that of the contacts".to_owned())
    }

    fn validate_bodies(&self) -> Result<(), String> {
        let bodies = &self.state.bodies;
        ensure(bodies.rows[0] == [0.0; 8], || "row 0 has been written".to_owned())?;
        for index in bodies.indices() {
            let i = index as usize;
            let finite =
                bodies.poses[i].is_finite() && bodies.rows[i].iter().all(|v| v.is_finite());
            ensure(finite, || format!("body {index} is not finite"))?;
        }
        Ok(())
    }

    /// Contacts are in the graph where one of their bodies is awake, and push none that sleeps.
    fn validate_contacts(&self) -> Result<(), String> {
        let asleep =
            |i: u32| self.state.bodies.is_dynamic(i) && !self.state.bodies.infos[i as usize].awake;
        for (index, contact) in
            self.state.contacts.records.iter().enumerate().filter(|(_, c)| c.alive)
        {
            let awake = pairs::is_awake(&self.state.bodies, contact);
            let placed = awake == (contact.place != Place::Asleep);
            ensure(placed, || {
                format!("contact {index} is awake without a lane, or sleeps in one")
            })?;
            let Place::Graph { colour, .. } = contact.place else { continue };
            let pushes = contact.touching && (asleep(contact.body_a) || asleep(contact.body_b));
            ensure(!pushes, || format!("contact {index} pushes a body that sleeps"))?;
            let solved = usize::from(colour) != IDLE;
            let told = || format!("contact {index}: touching does not match its colour");
            ensure(contact.touching == solved, told)?;
        }
        Ok(())
    }

    /// Of the pairs whose fat boxes overlap, none has been forgotten. Hooks decide of pairs, so a world that is read does not ask.
    fn validate_pairs(&self) -> Result<(), String> {
        let State { shapes, bodies, contacts, joints, waiting, broad_phase, .. } = &self.state;
        let without = self.pairs_without_contact();
        if without.iter().all(|&count| count == 0) {
            return Ok(());
        }
        let mut known = waiting.pairs.clone();
        known.sort_unstable();
        let mut asked = vec![waiting.stale; shapes.records.len()];
        let moved = broad_phase.moved().iter().filter_map(|&id| broad_phase.user(id));
        moved.for_each(|shape| asked[shape as usize] = true);
        let (custom, reach) = (self.hooks.pair_filter(), self.contact_reach());
        let ways = &[];
        let partners = pairs::Partners { shapes, bodies, contacts, joints, custom, reach, ways };
        let mut lost = None;
        broad_phase.each_overlap(|a, b| {
            let looked_for = without[a as usize] == 0 || asked[a as usize] || asked[b as usize];
            if !looked_for && partners.may_meet(a, b) && known.binary_search(&(a, b)).is_err() {
                lost = Some((a, b));
            }
        });
        lost.map_or(Ok(()), |(a, b)| Err(format!("shapes {a} and {b} will not meet")))
    }

    /// For each shape, the pairs with a higher one whose fat boxes overlap, less those that have a contact. No pair has
    /// two contacts, so nothing has to be looked up to see where all have theirs.
    fn pairs_without_contact(&self) -> Vec<u32> {
        let State { shapes, contacts, broad_phase, .. } = &self.state;
        let mut pairs = vec![0_u32; shapes.records.len()];
        broad_phase.each_overlap(|a, _| pairs[a as usize] += 1);
        let overlap = |a: u32, b: u32| {
            let (fat_a, fat_b) = (shapes.fat[a as usize], shapes.fat[b as usize]);
            broad_phase.would_pair((shapes.proxy(a), fat_a), (shapes.proxy(b), fat_b))
        };
        for contact in contacts.records.iter().filter(|contact| contact.alive) {
            let (a, b) = (contact.shape_a, contact.shape_b);
            let pairs = &mut pairs[a.min(b) as usize];
            *pairs = pairs.wrapping_sub(overlap(a, b).into());
        }
        pairs
    }

    /// Boxes are where the shapes are, and the broad phase has the same.
    fn validate_boxes(&self) -> Result<(), String> {
        let State { shapes, bodies, broad_phase, .. } = &self.state;
        for shape in shapes.indices().filter(|&i| shapes.records[i as usize].proxy != NULL) {
            let body = shapes.records[shape as usize].body as usize;
            let tight = shapes.tight[shape as usize];
            let now = boxes::shape_box(shapes, shape, bodies.poses[body]);
            let room = 1.0e-5 * (1.0 + now.center().length() + now.half_extents().length());
            let there = tight.grown(room).contains(&now) && now.grown(room).contains(&tight);
            ensure(there, || format!("shape {shape} is not where its box is"))?;
            let (proxy, fat) = (shapes.proxy(shape), shapes.fat[shape as usize]);
            let same_kind = broad_phase.kind(proxy) == Some(proxy_kind(bodies.infos[body].kind));
            ensure(same_kind, || format!("shape {shape} is in the tree of another kind"))?;
            let same_box = broad_phase.has_box(proxy, fat);
            ensure(same_box, || format!("shape {shape} has another fat box than its proxy"))?;
        }
        Ok(())
    }

    /// A joint that pulls is in the graph while one of its bodies is awake, and no body that it moves sleeps then.
    fn validate_joints(&self) -> Result<(), String> {
        let pulls = |joint: &JointRecord| {
            let enabled = |body: u32| self.state.bodies.infos[body as usize].enabled;
            let together = enabled(joint.body_a) && enabled(joint.body_b);
            joint.alive && joint.class().is_some() && together
        };
        let joints = self.state.joints.records.iter().enumerate();
        for (index, joint) in joints.filter(|(_, joint)| pulls(joint)) {
            let ends = [joint.body_a, joint.body_b];
            let awake = ends.iter().any(|&body| self.state.bodies.infos[body as usize].awake);
            let asleep = |&body: &u32| {
                self.state.bodies.is_dynamic(body) && !self.state.bodies.infos[body as usize].awake
            };
            let placed = awake == (joint.place != Place::Asleep);
            ensure(placed, || format!("joint {index} is awake without a lane, or sleeps in one"))?;
            let pulls = awake && ends.iter().any(asleep);
            ensure(!pulls, || format!("joint {index} pulls at a body that sleeps"))?;
        }
        Ok(())
    }

    /// No two contacts of a colour share a dynamic body, nor do two joints, and the bodies know their colours.
    fn validate_colours(&self) -> Result<(), String> {
        let State { bodies, contacts, joints, .. } = &self.state;
        let contacts = contacts.records.iter().filter(|contact| contact.alive);
        let contacts = contacts.map(|contact| (contact.place, [contact.body_a, contact.body_b]));
        validate_colours_of(contacts, bodies, |info| info.contact_colours)?;
        let joints = joints.records.iter().filter(|joint| joint.alive);
        let joints = joints.map(|joint| (joint.place, [joint.body_a, joint.body_b]));
        validate_colours_of(joints, bodies, |info| info.joint_colours)
    }
}

fn validate_colours_of(
    constraints: impl Iterator<Item = (Place, [u32; 2])>,
    bodies: &Bodies,
    known: fn(&BodyInfo) -> u32,
) -> Result<(), String> {
    let mut used = vec![0_u32; bodies.infos.len()];
    for (place, ends) in constraints {
        let Place::Graph { colour: place, .. } = place else { continue };
        let colour = colour_at(place.into());
        if usize::from(place) == IDLE || colour >= COLOURS {
            continue;
        }
        for body in ends.into_iter().filter(|&body| bodies.is_dynamic(body)) {
            let once = used[body as usize] >> colour & 1 == 0;
            ensure(once, || format!("body {body} occurs twice in colour {colour}"))?;
            used[body as usize] |= 1 << colour;
        }
    }
    for index in bodies.indices().filter(|&index| bodies.is_dynamic(index)) {
        let right = known(&bodies.infos[index as usize]) == used[index as usize];
        ensure(right, || format!("body {index} does not know its colours"))?;
    }
    Ok(())
}

/// What is wrong, unless the condition holds.
fn ensure(condition: bool, wrong: impl FnOnce() -> String) -> Result<(), String> {
    if condition { Ok(()) } else { Err(wrong()) }
}
