//! How bodies move in a step in which they are hit.

use crate::dynamics::{Bodies, Contact, Slot, inverse_mass_along};
use crate::footprint::footprint;
use crate::math::Vec2;
use crate::stages::ahead::HARMLESS;
use crate::stages::boxes::Way;

/// What hits took off its way is looked for so many times as far off: one hit alone, in time, is handed on, where the
/// solver lets all of a step hit at once. At 1, twice as many of 3,000 heaps had overlaps of more than 3 cm.
const AMISS: f32 = 1.5;

/// How a body moves in the step, as far as hits are known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    pub(super) body: u32,
    /// Motion and turn over the whole step, metres and radians.
    pub(super) motion: Vec2,
    pub(super) turn: f32,
    /// Velocities after its hits.
    pub(super) velocity: Vec2,
    pub(super) spin: f32,
    /// How far hits have taken it off its way since it was last looked at, metres.
    pub(super) astray: f32,
    /// Of the heaviest that presses it on, else its own.
    pub(super) inverse_mass: f32,
    /// Did it hit what does not bounce?
    pub(super) stopped: bool,
    /// When it was hit last, as a part of the step.
    pub(super) since: f32,
    /// Did only what no hit moves hit it, and nothing else drives it? Then it is known where it goes.
    pub(super) sure: bool,
    /// The last moment in which it was hit, as a part of the step, and its velocities before all hits of that.
    moment: f32,
    before: (Vec2, f32),
}

/// The last leg of a body's way, since it was hit: the line on which it goes, as if from the start of the step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    /// From where the step starts to where the line would.
    pub(super) offset: Vec2,
    pub(super) offset_turn: f32,
    pub(super) motion: Vec2,
    pub(super) turn: f32,
    pub(super) since: f32,
}

/// The courses of what is hit, as far as hits are known.
#[derive(Debug, Default)]
pub(super) struct Courses {
    pub(super) list: Vec<Course>,
    /// By body: place in `list`, plus 1.
    places: Vec<u32>,
}

footprint!(Courses { list, places });

impl Courses {
    /// Forgets those of the step before.
    pub(super) fn clear(&mut self) {
        self.list.drain(..).for_each(|course| self.places[course.body as usize] = 0);
    }

    /// Makes room for so many bodies.
    pub(super) fn resize(&mut self, count: usize) {
        self.places.resize(count, 0);
    }

    #[inline]
    fn known(&self, body: u32) -> Option<&Course> {
        self.list.get(self.places.get(body as usize)?.wrapping_sub(1) as usize)
    }

    /// How a body moves in this step of `dt` seconds.
    #[inline]
    pub(super) fn of(&self, bodies: &Bodies, dt: f32, body: u32) -> Course {
        self.known(body).copied().unwrap_or_else(|| Course::of(bodies, dt, body))
    }

    /// The same, as far off its way as it is looked for.
    #[inline]
    pub(super) fn far(&self, bodies: &Bodies, dt: f32, body: u32) -> Course {
        let known = self.known(body).map(|course| course.amiss(bodies, dt));
        known.unwrap_or_else(|| Course::of(bodies, dt, body))
    }

    /// Is a body known to be hit in this step?
    pub(super) fn is_struck(&self, body: u32) -> bool {
        self.known(body).is_some()
    }

    /// Or one of a contact's two?
    pub(super) fn have_struck(&self, contact: &Contact) -> bool {
        self.is_struck(contact.body_a) || self.is_struck(contact.body_b)
    }

    pub(super) fn keep(&mut self, course: &Course) {
        let place = &mut self.places[course.body as usize];
        if *place == 0 {
            self.list.push(*course);
            *place = self.list.len() as u32;
        } else {
            self.list[*place as usize - 1] = *course;
        }
    }
}

impl Course {
    /// That of a body that nothing hits.
    pub(super) fn of(bodies: &Bodies, dt: f32, body: u32) -> Self {
        let row = &bodies.rows[body as usize];
        let (velocity, spin) = (Vec2::new(row[Slot::VX], row[Slot::VY]), row[Slot::W]);
        let (motion, turn) = (velocity * dt, spin * dt);
        let inverse_mass = row[Slot::INV_MASS].abs();
        Self {
            body,
            motion,
            turn,
            velocity,
            spin,
            astray: 0.0,
            inverse_mass,
            stopped: false,
            since: 0.0,
            sure: true,
            moment: 0.0,
            before: (velocity, spin),
        }
    }

    /// As before what hit it in its last moment.
    pub(super) fn before(self) -> Self {
        let (velocity, spin) = self.before;
        Self { velocity, spin, ..self }
    }

    /// About to be hit: in its last moment, or, if that is `near` parts of the step off, in a new one.
    pub(super) fn at(self, moment: f32, near: f32) -> Self {
        let before = (self.velocity, self.spin);
        let is_same = (moment - self.moment).abs() < near;
        if is_same { self } else { Self { before, moment, ..self } }
    }

    /// How its velocities change by the second, as forces and impulses have done in the last substep. `inv_h` is 1 / its length.
    pub(super) fn gained(bodies: &Bodies, inv_h: f32, body: u32) -> Self {
        let at = body as usize;
        let (row, base, gain) = (&bodies.rows[at], &bodies.starts[at], &bodies.motions[at].gain);
        let inv_h = if bodies.is_solved(body) { inv_h } else { 0.0 };
        let [x, y, spin] = [0, 1, 2].map(|k| (row[k] - base[k] + gain[k]) * inv_h);
        Self { velocity: Vec2::new(x, y), spin, ..Self::of(bodies, 0.0, body) }
    }

    /// As far off the way as it is looked for, see [`AMISS`].
    fn amiss(&self, bodies: &Bodies, dt: f32) -> Self {
        if self.sure {
            return *self;
        }
        let first = Self::of(bodies, dt, self.body);
        let motion = first.motion + (self.motion - first.motion) * AMISS;
        let turn = first.turn + (self.turn - first.turn) * AMISS;
        Self { motion, turn, ..*self }
    }

    /// Was it taken so far off its way, by `least` metres and more, that this is looked at again?
    pub(super) fn is_far(&self, bodies: &Bodies, least: f32) -> bool {
        let half = bodies.infos[self.body as usize].min_extent;
        let thin = 0.0 < half && half < least;
        self.astray > HARMLESS * half && self.astray > if thin { half } else { least }
    }

    /// Where it goes since it was hit; straight from its start to its end where that is not sure.
    pub(super) fn leg(&self, dt: f32) -> Leg {
        let Self { motion, turn, velocity, spin, since, sure, .. } = *self;
        if !sure || since == 0.0 {
            return Leg { offset: Vec2::ZERO, offset_turn: 0.0, motion, turn, since: 0.0 };
        }
        let (along, turned) = (velocity * dt, spin * dt);
        let (offset, offset_turn) = (motion - along, turn - turned);
        Leg { offset, offset_turn, motion: along, turn: turned, since }
    }

    pub(super) fn way(&self, bodies: &Bodies) -> Way {
        let Self { body, motion, turn, .. } = *self;
        Way { start: bodies.poses[body as usize], motion, turn }
    }

    /// Speed of a point along a normal.
    pub(super) fn speed_at(&self, arm: f32, normal: Vec2) -> f32 {
        normal.dot(self.velocity) + self.spin * arm
    }
}

/// Two bodies that hit each other, and how many seconds they go on afterwards.
pub(super) struct Impact {
    pub(super) courses: [Course; 2],
    /// Inverse masses along x and y and inverse inertia.
    inverses: [[f32; 3]; 2],
    /// How far they reach from their centres of mass.
    reach: [f32; 2],
    /// When, as a part of the step.
    fraction: f32,
    rest: f32,
}

impl Impact {
    #[inline]
    pub(super) fn new(bodies: &Bodies, courses: [Course; 2], (fraction, dt): (f32, f32)) -> Self {
        let inverses = courses.map(|course| bodies.inverses(course.body));
        let reach = courses.map(|course| bodies.infos[course.body as usize].max_extent);
        Self { courses, inverses, reach, fraction, rest: (1.0 - fraction) * dt }
    }

    /// How fast B leaves A along an axis, and the mass that an impulse along it moves: nothing where neither can move.
    pub(super) fn approach(&self, axis: Vec2, arms: [f32; 2]) -> (f32, f32) {
        let [a, b] = [0, 1].map(|k| self.courses[k].speed_at(arms[k], axis));
        let [give_a, give_b] = [0, 1].map(|k| {
            let [x, y, turn] = self.inverses[k];
            inverse_mass_along((), [axis.x, axis.y], [x, y]) + turn * arms[k] * arms[k]
        });
        let give = give_a + give_b;
        (b - a, if give > 0.0 { 1.0 / give } else { 0.0 })
    }

    /// Gives B an impulse along an axis, and A the opposite one.
    pub(super) fn push(&mut self, impulse: f32, axis: Vec2, arms: [f32; 2]) {
        for (k, impulse) in [-impulse, impulse].into_iter().enumerate() {
            let [x, y, turn] = self.inverses[k];
            self.courses[k].velocity += Vec2::new(axis.x * (impulse * x), axis.y * (impulse * y));
            self.courses[k].spin += impulse * arms[k] * turn;
            self.courses[k].since = self.fraction.max(self.courses[k].since);
            self.courses[k].sure &= self.inverses[1 - k] == [0.0; 3];
        }
        self.shift(impulse, axis, arms, self.rest);
    }

    /// Moves the bodies on by what an impulse does in a time.
    pub(super) fn shift(&mut self, impulse: f32, axis: Vec2, arms: [f32; 2], time: f32) {
        for (k, impulse) in [-impulse, impulse].into_iter().enumerate() {
            let ([x, y, turn], course) = (self.inverses[k], &mut self.courses[k]);
            let velocity = Vec2::new(axis.x * (impulse * x), axis.y * (impulse * y));
            let spin = impulse * arms[k] * turn;
            course.motion += velocity * time;
            course.turn += spin * time;
            course.astray += (velocity.length() + spin.abs() * self.reach[k]) * time;
        }
    }
}
