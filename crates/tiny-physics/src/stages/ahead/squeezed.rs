//! Squeezed: light bodies between heavy ones that come and what nothing moves.
//!
//! A pass of the solver hands on no more of a heavy body's momentum than the light one in between takes up, so that of
//! a hundred times its mass went through it as through nothing. From the step in which something heavy comes, what is
//! squeezed therefore counts as half as heavy, and so does what it leans on, up to what nothing moves. As that stops
//! them all, no momentum is lost; what nothing backs keeps its own mass, and what is faster than the heavy one counts as less.
//!
//! It stays so, with its own weight, while its contacts carry what would throw it away: a press goes on pressing. With its own
//! mass in between 25 of 120 bodies under presses were gone through.
//!
//! So does what is *laden*: what heavy things lie on, on static ground, which [`paces`](crate::stages::paces) lists. Of 100 stacks of
//! four to twelve crates under 550 to 1,000 times the mass of one 68 bounced for ever or were thrown about. Once something near it
//! moves, it has its own mass: who strikes it meets no more than that.

use crate::dynamics::{Bodies, BodyInfo, Contacts, Graph, Slot};
use crate::footprint::footprint;
use crate::math::Vec2;
use crate::stages::contact_solver::SPRINGY;
use crate::stages::effective_mass;
use crate::stages::paces::is_still;

/// What is hit by something so many times its mass may be squeezed.
pub(crate) const HEAVIER: f32 = 4.0;
/// Between something so many times its mass and a wall what bounces goes to and fro, and is hit about as often as there are rounds of
/// hits. Heavier things go through it; lighter ones, if it counted as heavier, would take momentum and energy from gases.
const HEAVIER_THAN_SPRINGY: f32 = 16.0;
/// What is squeezed counts as one part in so many of what squeezes it.
const SHARE: f32 = 2.0;
/// How fast something in the row must come to squeeze, length units a second: what rests has its paces and rests.
pub(super) const COMING: f32 = 0.1;
/// What an impulse of its contacts would move faster than this is pressed on, length units a second. At 0.1 heaps of mixed masses cost
/// more and sleep later.
const PRESSED: f32 = 0.4;
/// What is laden counts as heavier until it or anything near it is faster than this, length units a second.
const STILL: f32 = 0.2;
/// So it does while its contacts are aligned so well with gravity, as a cosine.
const UPRIGHT: f32 = 0.99;
/// Bodies in a row at most.
const LONGEST: usize = 16;
/// Bodies that are looked at in search of rows at most, while none is found for what weighs the same. In 40 heaps of what weighs up to
/// a thousand times as much as other things, the deepest overlaps add up to 6.1 m with 32, 6.5 with 16, 6.0 with 128.
const MOST_SEEN: usize = 32;
/// So many times less heavy is what is pressed on from step to step that nothing heavy reaches by contacts: in a drum of 6,000
/// bodies, else, 1,600 of them went on pressing each other as what had swept through them, for a fifth of the step. With 2 to 8
/// heaps of mixed masses sleep as early as without; let go of at once, they sleep after 8.8 s in place of 6.1.
const FADE: f32 = 8.0;
/// A body backs another if its contact's normal leads on along the push, by this cosine.
const BACKED: f32 = 0.5;

/// Is one of two bodies light enough to be squeezed by the other, as their inverse masses say?
pub(super) fn is_uneven([a, b]: [f32; 2], restitution: f32) -> bool {
    let heavier = if restitution >= SPRINGY { HEAVIER_THAN_SPRINGY } else { HEAVIER };
    a.max(b) > heavier * a.min(b) && a.min(b) > 0.0
}

/// A light body that a heavy one presses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pressed {
    pub(super) body: u32,
    /// Inverse mass of what presses it.
    pub(super) by: f32,
    /// Velocity of that.
    pub(super) velocity: Vec2,
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
    pub(super) weighed: Vec<Weighed>,
    rows: Rows,
    /// Which of the bodies that are pressed on something really heavy reaches.
    reached: Vec<bool>,
    /// Those of them to go on from.
    queue: Vec<usize>,
}

/// A body whose mass is another in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weighed {
    body: u32,
    /// Inverse mass of what presses it.
    by: f32,
    /// Its own, and that by which it weighs as much as before.
    gravity_scale: f32,
    lighter: f32,
    /// Inverse mass and inertia that it counts with, and how it moves before it is solved.
    inverse: [f32; 2],
    velocity: Vec2,
    spin: f32,
}

/// What a search for rows has found.
#[derive(Debug, Default)]
struct Rows {
    /// Bodies that it has come to, in this search and in those before that found nothing.
    seen: Vec<u32>,
    /// Those of them that lead to what nothing moves.
    lead: Vec<u32>,
    /// Velocity of that.
    ground: Vec2,
}

footprint!(Rows { seen, lead } none { ground });
footprint!(Squeezed { pressed, hit, weighed, rows, reached, queue });

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

    /// Gives the bodies of rows that are squeezed the mass that they count as.
    pub(super) fn weigh(
        &mut self,
        bodies: &mut Bodies,
        contacts: &Contacts,
        graph: &mut Graph,
        (length_unit, up): (f32, Vec2),
        predicted: &dyn Fn(u32) -> Option<Vec2>,
    ) {
        let scene = Scene { bodies, contacts, graph, length_unit, predicted };
        bodies.pressed.iter().for_each(|&pressed| scene.press_on(pressed, &mut self.pressed));
        let mut none_for = None;
        for &pressed in &self.pressed {
            if bodies.inverse_masses(pressed.body).0 <= SHARE * pressed.by {
                continue;
            }
            if none_for != Some(pressed.by) {
                self.rows.seen.clear();
            }
            self.rows.lead.clear();
            let scene = Scene { bodies, contacts, graph, length_unit, predicted };
            let leads = scene.leads_to_fixed(pressed, LONGEST, &mut self.rows);
            none_for = leads.is_none().then_some(pressed.by);
            if leads != Some(true) {
                continue;
            }
            let ground = self.rows.ground;
            let push = (pressed.velocity - ground).dot(pressed.direction).max(COMING * length_unit);
            for &body in &self.rows.lead {
                // What is faster than what squeezes it would hand on more than it has, and counts as less.
                let speed = (bodies.velocity(body) - ground).length();
                let faster = (speed / push).max(1.0);
                let by = pressed.by * faster * faster;
                self.weighed.extend(weigh(body, by, bodies, contacts, graph));
            }
        }
        let mut laden = core::mem::take(&mut bodies.laden);
        laden.retain(|&(body, _)| {
            // What is hit may be pressed on after that.
            is_still(bodies, contacts, body, STILL * length_unit)
                && is_upright(bodies, contacts, graph, body, up)
                && self.weighed.iter().all(|weighed| weighed.body != body)
        });
        let mut pressed = core::mem::take(&mut bodies.pressed);
        pressed.extend(&laden);
        bodies.laden = laden;
        for (body, by) in pressed.drain(..) {
            if bodies.is_solved(body)
                && let Some(weighed) = weigh(body, by, bodies, contacts, graph)
            {
                let lighter = bodies.infos[body as usize].mass
                    * bodies.rows[body as usize][Slot::INV_MASS].abs();
                self.weighed.push(Weighed { lighter, ..weighed });
            }
        }
        bodies.pressed = pressed;
    }

    /// Has what is pressed on from step to step weigh no more than before, once hooks have seen what was set.
    pub(crate) fn lighten(&self, bodies: &mut Bodies) {
        for weighed in &self.weighed {
            bodies.infos[weighed.body as usize].gravity_scale *= weighed.lighter;
        }
    }

    /// Gives them their own mass again. What is pressed on will be weighed in the next step, too.
    pub(crate) fn release(
        &mut self,
        bodies: &mut Bodies,
        contacts: &Contacts,
        graph: &Graph,
        length_unit: f32,
    ) {
        // A body may be weighed more than once: the last one knows what it counts with, the first one what it was.
        for weighed in self.weighed.drain(..).rev() {
            let Weighed { body, by, gravity_scale, .. } = weighed;
            if weighed.inverse[0] == bodies.inverse_masses(body).0 {
                weighed.give_back(bodies, contacts, graph);
            }
            bodies.update_inverse_masses(body);
            let info = &mut bodies.infos[body as usize];
            info.gravity_scale = gravity_scale;
            let of_body = contacts.of_body(info.first_contact);
            let most = of_body.map(|(index, _)| graph.impulse(&contacts.records[index as usize]));
            let laden = bodies.laden.binary_search_by_key(&body, |&(laden, _)| laden).is_ok();
            if !laden && most.fold(0.0, f32::max) > PRESSED * length_unit * info.mass {
                bodies.pressed.push((body, by));
            }
        }
        // Each once, as the heaviest that it has counted as.
        bodies.pressed.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        bodies.pressed.dedup_by_key(|&mut (body, _)| body);
        self.find_reached(bodies, contacts, graph);
        for ((_, by), reached) in bodies.pressed.iter_mut().zip(&self.reached) {
            *by *= if *reached { 1.0 } else { FADE };
        }
    }

    /// Finds those of them that something really heavy pushes, itself or through others of them.
    fn find_reached(&mut self, bodies: &Bodies, contacts: &Contacts, graph: &Graph) {
        self.reached.clear();
        self.reached.resize(bodies.pressed.len(), false);
        for at in 0..bodies.pressed.len() {
            let (body, by) = bodies.pressed[at];
            let is_heavy =
                |other| (f32::MIN_POSITIVE..=by).contains(&bodies.inverse_masses(other).0);
            if leans_on(body, bodies, contacts, graph).any(is_heavy) {
                self.reach(at, bodies, contacts, graph);
            }
        }
    }

    /// Notes that what is really heavy presses on one of the bodies that are pressed on, and through it on others.
    fn reach(&mut self, at: usize, bodies: &Bodies, contacts: &Contacts, graph: &Graph) {
        self.queue.push(at);
        while let Some(at) = self.queue.pop() {
            if core::mem::replace(&mut self.reached[at], true) {
                continue;
            }
            for other in leans_on(bodies.pressed[at].0, bodies, contacts, graph) {
                self.queue.extend(bodies.pressed.binary_search_by_key(&other, |&(body, _)| body));
            }
        }
    }
}

impl Weighed {
    /// Gives those that rub on it back what they lost along it to the mass that it has not. What holds it from elsewhere took part of
    /// that, so this is not too much.
    fn give_back(&self, bodies: &mut Bodies, contacts: &Contacts, graph: &Graph) {
        let BodyInfo { first_contact, mass, .. } = bodies.infos[self.body as usize];
        let change = bodies.velocity(self.body) - self.velocity;
        let turn = bodies.angular_velocity(self.body) - self.spin;
        let loads =
            || contacts.of_body(first_contact).filter_map(|at| self.load(at, contacts, graph));
        let lost = |bodies: &Bodies, (heavy, tangent, [arm, their_arm]): (u32, Vec2, [f32; 2])| {
            let change = tangent.dot(change) + turn * arm;
            let slip = tangent.dot(bodies.velocity(heavy) - self.velocity)
                + bodies.angular_velocity(heavy) * their_arm
                - self.spin * arm;
            let (inverse, own) =
                (bodies.inverse_masses(heavy).0, bodies.infos[heavy as usize].mass);
            let is_heavy = inverse > 0.0 && own * self.by >= 0.999;
            // It was taken along, and no further.
            let taken = change * slip > 0.0 && change.abs() < 1.05 * slip.abs();
            let give = self.inverse[0] + self.inverse[1] * arm * arm;
            (is_heavy && taken).then_some((1.0 - self.inverse[0] * mass) * change / give)
        };
        let count = loads().filter(|&load| lost(bodies, load).is_some()).count();
        let mut left = count;
        for load in loads() {
            if left > 0
                && let Some(lost) = lost(bodies, load)
            {
                left -= 1;
                let ((heavy, tangent, [_, their_arm]), impulse) = (load, lost / count as f32);
                let (inv_mass, inv_inertia) = bodies.inverse_masses(heavy);
                bodies.set_velocity(heavy, bodies.velocity(heavy) + tangent * (impulse * inv_mass));
                bodies.rows[heavy as usize][Slot::W] += impulse * their_arm * inv_inertia;
            }
        }
    }

    /// What a contact presses on it: the other body, the tangent, and the arms along that of a point.
    fn load(
        &self,
        (index, side): (u32, u32),
        contacts: &Contacts,
        graph: &Graph,
    ) -> Option<(u32, Vec2, [f32; 2])> {
        let contact = &contacts.records[index as usize];
        let (constraint, lane) = graph.solved(contact).filter(|_| contact.friction > 0.0)?;
        let point = constraint.points.iter().find(|point| point.normal_impulse[lane] > 0.0)?;
        let [a, b] = [point.tangent_arm_a[lane], point.tangent_arm_b[lane]];
        let normal = Vec2::new(constraint.normal_x[lane], constraint.normal_y[lane]);
        Some((contact.other(self.body), -normal.perp(), if side == 0 { [a, b] } else { [b, a] }))
    }
}

/// Bodies with which a body has contacts that push.
fn leans_on(
    body: u32,
    bodies: &Bodies,
    contacts: &Contacts,
    graph: &Graph,
) -> impl Iterator<Item = u32> {
    contacts.of_body(bodies.infos[body as usize].first_contact).filter_map(move |(index, _)| {
        let contact = &contacts.records[index as usize];
        (graph.impulse(contact) > 0.0).then(|| contact.other(body))
    })
}

/// Does all that touches a body do so from above or below? What is pushed aside has its own mass.
fn is_upright(bodies: &Bodies, contacts: &Contacts, graph: &Graph, body: u32, up: Vec2) -> bool {
    contacts.of_body(bodies.infos[body as usize].first_contact).all(|(index, _)| {
        let contact = &contacts.records[index as usize];
        !contact.touching
            || graph.normal(contact).is_none_or(|normal| normal.dot(up).abs() > UPRIGHT)
    })
}

/// Has a body count as what presses it says, if that is more than its own mass, and its constraints follow.
fn weigh(
    body: u32,
    by: f32,
    bodies: &mut Bodies,
    contacts: &Contacts,
    graph: &mut Graph,
) -> Option<Weighed> {
    let row = &mut bodies.rows[body as usize];
    let part = SHARE * by / row[Slot::INV_MASS].abs();
    if part >= 1.0 {
        return None;
    }
    row[Slot::INV_MASS] *= part;
    // What marks a lock stays one.
    if row[Slot::INV_INERTIA] != -f32::MIN_POSITIVE {
        row[Slot::INV_INERTIA] *= part;
    }
    let BodyInfo { first_contact, gravity_scale, .. } = bodies.infos[body as usize];
    for (index, _) in contacts.of_body(first_contact) {
        effective_mass::follow(graph, &contacts.records[index as usize], bodies);
    }
    let (inv_mass, inv_inertia) = bodies.inverse_masses(body);
    let (velocity, spin) = (bodies.velocity(body), bodies.angular_velocity(body));
    let (inverse, lighter) = ([inv_mass, inv_inertia], 1.0);
    Some(Weighed { body, by, gravity_scale, lighter, inverse, velocity, spin })
}

impl Scene<'_> {
    /// Lists the light bodies that one presses that is pressed itself.
    fn press_on(self, (body, by): (u32, f32), pressed: &mut Vec<Pressed>) {
        let first = self.bodies.infos[body as usize].first_contact;
        for (index, side) in self.contacts.of_body(first) {
            let contact = &self.contacts.records[index as usize];
            let (other, sign) =
                if side == 0 { (contact.body_b, 1.0) } else { (contact.body_a, -1.0) };
            let inverse_mass = self.bodies.inverse_masses(other).0;
            if inverse_mass > HEAVIER * by
                && !self.is_kept(other, by)
                && self.graph.impulse(contact) * inverse_mass > PRESSED * self.length_unit
                && let Some(normal) = self.graph.normal(contact)
            {
                let direction = normal * sign;
                let velocity = self.bodies.velocity(body);
                let body = other;
                pressed.push(Pressed { body, by, velocity, direction, coming: true });
            }
        }
    }

    /// Is a body pressed on already by what is as heavy? Then it presses on others itself.
    fn is_kept(self, body: u32, by: f32) -> bool {
        let kept = &self.bodies.pressed;
        let at = kept.binary_search_by_key(&body, |&(body, _)| body);
        at.is_ok_and(|at| kept[at].1 <= by)
    }

    /// Do rows of bodies, no longer than `most`, lead from one that is pressed on to what nothing moves? If so: does
    /// anything in them come nearer? Lists all that is in them: what one row leaves out would be gone through by another.
    /// Rows go through what is heavy, too, such as a crate under a chip. Through light bodies alone, those heaps have 11.9 m.
    fn leads_to_fixed(self, pressed: Pressed, most: usize, found: &mut Rows) -> Option<bool> {
        found.seen.push(pressed.body);
        let first = self.bodies.infos[pressed.body as usize].first_contact;
        let mut leads = None;
        for (index, side) in self.contacts.of_body(first) {
            let contact = &self.contacts.records[index as usize];
            let other = contact.other(pressed.body);
            let known = (self.predicted)(index).or_else(|| self.graph.normal(contact));
            let Some(normal) = known else { continue };
            let direction = if side == 0 { normal } else { -normal };
            if direction.dot(pressed.direction) < BACKED {
                continue;
            }
            let apart = self.bodies.velocity(other) - self.bodies.velocity(pressed.body);
            let coming = pressed.coming || apart.dot(direction) < -COMING * self.length_unit;
            let inverse_mass = self.bodies.inverse_masses(other).0;
            if inverse_mass == 0.0 {
                found.ground = self.bodies.velocity(other);
            }
            if inverse_mass == 0.0 || found.lead.contains(&other) {
                leads = leads.max(Some(coming));
            } else if found.goes_on(other, most) {
                let next = Pressed { body: other, direction, coming, ..pressed };
                leads = leads.max(self.leads_to_fixed(next, most - 1, found));
            }
        }
        if leads.is_some() {
            found.lead.push(pressed.body);
        }
        leads
    }
}

impl Rows {
    /// May the search go on to a body?
    fn goes_on(&self, body: u32, most: usize) -> bool {
        most > 1 && self.seen.len() < MOST_SEEN && !self.seen.contains(&body)
    }
}
