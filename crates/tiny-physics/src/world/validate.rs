//! A walk over all invariants, for tests.

use super::World;
use crate::describe::BodyKind;
use crate::dynamics::{COLOURS, IDLE, JointPlace, JointRecord, NULL, PLAIN, Place, colour_at};
use crate::stages::{boxes, pairs};
use core::ops::ControlFlow;
use std::collections::HashSet;

impl World {
    /// Checks every invariant of the world's data: links, colours, places, finite numbers. Slow; for
    /// tests and for hunting bugs.
    ///
    /// # Errors
    /// Says which invariant is broken and where.
    pub fn validate(&self) -> Result<(), String> {
        self.broad_phase.validate()?;
        self.validate_bodies()?;
        self.validate_contacts()?;
        self.validate_pairs()?;
        self.validate_joints()?;
        self.validate_colours()
    }

    fn validate_bodies(&self) -> Result<(), String> {
        if self.bodies.rows[0] != [0.0; 8] {
            return Err("row 0 has been written".into());
        }
        let is_refined = |i: &u32| usize::from(self.bodies.infos[*i as usize].pace) != PLAIN;
        let refined = self.bodies.indices().filter(is_refined).count();
        if refined != self.bodies.refined {
            return Err(format!("{refined} bodies are refined, {} counted", self.bodies.refined));
        }
        for index in self.bodies.indices() {
            let info = &self.bodies.infos[index as usize];
            let listed = self.bodies.awake.contains(&index);
            if info.awake != listed {
                return Err(format!(
                    "body {index}: awake is {} but listed is {listed}",
                    info.awake
                ));
            }
            if !self.bodies.poses[index as usize].is_finite()
                || self.bodies.rows[index as usize].iter().any(|v| !v.is_finite())
            {
                return Err(format!("body {index} is not finite"));
            }
            let shapes = self.shapes.of_body(info.first_shape).count();
            if shapes != info.shape_count as usize {
                return Err(format!(
                    "body {index}: {shapes} shapes linked, {} counted",
                    info.shape_count
                ));
            }
        }
        Ok(())
    }

    fn validate_contacts(&self) -> Result<(), String> {
        let mut links = 0;
        for index in 0..self.bodies.infos.len() as u32 {
            let first = self.bodies.infos[index as usize].first_contact;
            for (contact, side) in self.contacts.of_body(first) {
                links += 1;
                let record = &self.contacts.records[contact as usize];
                let body = if side == 0 { record.body_a } else { record.body_b };
                if !record.alive || body != index {
                    return Err(format!(
                        "contact {contact} in the list of body {index} is not its"
                    ));
                }
            }
        }
        let mut alive = 0;
        for (index, contact) in self.contacts.records.iter().enumerate().filter(|(_, c)| c.alive) {
            alive += 1;
            let awake = pairs::is_awake(&self.bodies, contact);
            match contact.place {
                Place::Asleep if awake => {
                    return Err(format!("contact {index} is awake without a lane"));
                }
                Place::Graph { .. } if !awake => {
                    return Err(format!("contact {index} sleeps in a lane"));
                }
                Place::Graph { colour, slot } => {
                    let bucket = &self.graph.buckets[usize::from(colour)][contact.class as usize];
                    if bucket.contacts.get(slot as usize) != Some(&(index as u32)) {
                        return Err(format!("contact {index} is not in its slot"));
                    }
                    let asleep =
                        |i: u32| self.bodies.is_dynamic(i) && !self.bodies.infos[i as usize].awake;
                    if contact.touching && (asleep(contact.body_a) || asleep(contact.body_b)) {
                        return Err(format!("contact {index} pushes a body that sleeps"));
                    }
                    if contact.touching != (usize::from(colour) != IDLE) {
                        return Err(format!("contact {index}: touching does not match its colour"));
                    }
                }
                Place::Asleep => {}
            }
            if self.contacts.pairs.get(contact.shape_a, contact.shape_b) != Some(index as u32) {
                return Err(format!("contact {index} is not in the pair table"));
            }
        }
        if links != 2 * alive || self.contacts.pairs.len() != alive {
            return Err(format!(
                "{alive} contacts, {links} links, {} pairs",
                self.contacts.pairs.len()
            ));
        }
        Ok(())
    }

    /// Boxes are where the shapes are; of the pairs whose fat boxes overlap, none has been forgotten.
    fn validate_pairs(&self) -> Result<(), String> {
        let waiting = &self.waiting;
        let known: HashSet<(u32, u32)> = waiting.pairs.iter().copied().collect();
        let fresh: HashSet<u32> =
            self.broad_phase.moved().iter().filter_map(|&id| self.broad_phase.user(id)).collect();
        let kind =
            |shape: u32| self.bodies.infos[self.shapes.records[shape as usize].body as usize].kind;
        let Self { shapes, bodies, contacts, joints, .. } = self;
        let (custom, reach) = (self.hooks.pair_filter(), self.contact_reach());
        let partners = pairs::Partners { shapes, bodies, contacts, joints, custom, reach };
        for shape in
            self.shapes.indices().filter(|&i| self.shapes.records[i as usize].proxy != NULL)
        {
            let record = &self.shapes.records[shape as usize];
            let (tight, fat) = (self.shapes.tight[shape as usize], self.shapes.fat[shape as usize]);
            let now =
                boxes::shape_box(&self.shapes, shape, self.bodies.poses[record.body as usize]);
            let room = 1.0e-5 * (1.0 + now.center().length() + now.half_extents().length());
            if !tight.grown(room).contains(&now) || !now.grown(room).contains(&tight) {
                return Err(format!("shape {shape} is not where its box is"));
            }
            let mut lost = None;
            self.broad_phase.query(&fat, u64::MAX, |other| {
                let dynamic = [shape, other].iter().any(|&i| kind(i) == BodyKind::Dynamic);
                let asked = fresh.contains(&shape) || fresh.contains(&other) || waiting.stale;
                if shape < other
                    && dynamic
                    && !asked
                    && partners.may_meet(shape, other)
                    && !known.contains(&(shape, other))
                {
                    lost = Some(other);
                }
                ControlFlow::Continue(())
            });
            if let Some(other) = lost {
                return Err(format!("shapes {shape} and {other} will not meet"));
            }
        }
        Ok(())
    }

    /// A joint that pulls is in the graph while one of its bodies is awake, and no body that it moves sleeps then.
    fn validate_joints(&self) -> Result<(), String> {
        let pulls = |joint: &JointRecord| {
            let enabled = |body: u32| self.bodies.infos[body as usize].enabled;
            let together = enabled(joint.body_a) && enabled(joint.body_b);
            joint.alive && joint.class().is_some() && together
        };
        let joints = self.joints.records.iter().enumerate();
        for (index, joint) in joints.filter(|(_, joint)| pulls(joint)) {
            let ends = [joint.body_a, joint.body_b];
            let awake = ends.iter().any(|&body| self.bodies.infos[body as usize].awake);
            let asleep = |&body: &u32| {
                self.bodies.is_dynamic(body) && !self.bodies.infos[body as usize].awake
            };
            if awake != (joint.place != JointPlace::Asleep) {
                return Err(format!("joint {index} is awake without a lane, or sleeps in one"));
            }
            if awake && ends.iter().any(asleep) {
                return Err(format!("joint {index} pulls at a body that sleeps"));
            }
        }
        Ok(())
    }

    /// No two contacts of a colour share a dynamic body, and the bodies know their colours.
    fn validate_colours(&self) -> Result<(), String> {
        let mut used = vec![0_u32; self.bodies.infos.len()];
        for (place, buckets) in self.graph.buckets[..IDLE].iter().enumerate() {
            let colour = colour_at(place);
            for bucket in buckets.iter().filter(|_| colour < COLOURS) {
                for slot in 0..bucket.contacts.len() {
                    let (a, b) = bucket.bodies(slot);
                    for body in [a, b].into_iter().filter(|&body| self.bodies.is_dynamic(body)) {
                        if used[body as usize] >> colour & 1 != 0 {
                            return Err(format!("body {body} occurs twice in colour {colour}"));
                        }
                        used[body as usize] |= 1 << colour;
                    }
                }
            }
        }
        for index in self.bodies.indices().filter(|&i| self.bodies.is_dynamic(i)) {
            let info = &self.bodies.infos[index as usize];
            if info.contact_colours != used[index as usize] {
                return Err(format!("body {index} does not know its colours"));
            }
        }
        Ok(())
    }
}
