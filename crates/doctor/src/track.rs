//! What the doctor remembers of a body.

use crate::look::Look;
use tiny_physics::{Body, BodyId, BodyKind, DVec2, ShapeId, Vec2, World};

/// A body as it was seen last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Track {
    pub(crate) id: BodyId,
    /// Step in which it was first seen.
    pub(crate) since: u64,
    /// Step of the last glance.
    pub(crate) glance: u64,
    pub(crate) center: DVec2,
    pub(crate) velocity: Vec2,
    /// Velocity at the glance before.
    pub(crate) before: Vec2,
    /// Radius of the largest disk in its thinnest shape, metres.
    pub(crate) thin: f32,
    /// Radius about its centre that holds it, metres.
    pub(crate) size: f32,
    /// Kilograms a square metre; 0 where it has no mass or no area.
    pub(crate) density: f32,
    /// Where it was when it last went further than a tenth of its size.
    pub(crate) place: DVec2,
    /// Seconds for which it has been there, awake.
    pub(crate) still: f32,
    /// Seconds since it last touched anything.
    pub(crate) free: f32,
    /// Seconds for which it had touched nothing when it last touched something.
    pub(crate) flew: f32,
    /// Angular velocity at the last glance, as the speed of its rim, metres a second.
    pub(crate) spin: f32,
    /// Speed, its rim's included, smoothed over a third of a second, metres a second.
    pub(crate) speed: f32,
    /// Part of the steps in which its velocity turned round, smoothed.
    pub(crate) flips: f32,
    /// Deepest overlap in the last thorough look, metres.
    pub(crate) overlap: f32,
    /// Overlap when it had come to rest, metres.
    pub(crate) resting_overlap: Option<f32>,
    /// Step since which its overlap has been deep.
    pub(crate) deep_since: Option<u64>,
    /// Step in which it was last seen to be deep.
    pub(crate) deep_seen: u64,
    /// What has pushed it in since then and cannot be stopped.
    pub(crate) crushed: Option<BodyId>,
    /// Its deepest contact at the last thorough look: the other shape, and the normal out of it.
    pub(crate) normal: Option<(ShapeId, Vec2)>,
    /// How often that normal has flipped since it is in its place.
    pub(crate) normal_flips: u32,
    /// Looks in a row in which it had sunk.
    pub(crate) sunk: u32,
    /// Deepest overlap since then, metres.
    pub(crate) deepest: f32,
    /// Seconds for which it has shaken in its place.
    pub(crate) shaking: f32,
    /// Step in which it was last put somewhere else by the user.
    pub(crate) placed: Option<u64>,
    /// Wakings within its time of rest.
    pub(crate) wakings: u32,
    /// Step until which it is not asked for what it never meets.
    pub(crate) unmet: u64,
    /// Step until which its size is taken to stay as it is.
    pub(crate) measured: u64,
}

/// A body as it was at the glance before.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Before {
    pub(crate) center: DVec2,
    pub(crate) velocity: Vec2,
    /// Step of that glance.
    pub(crate) glance: u64,
    /// Was it at rest?
    pub(crate) rested: bool,
}

/// Parts of its size that a body may move and still be in its place.
const PLACE: f32 = 0.1;
/// Seconds in its place after which a body is at rest.
const RESTING: f32 = 1.0;
/// Metres a second, by the length unit, at which what is at rest shakes visibly.
pub(crate) const SHAKING: f32 = 0.02;
/// Metres, by the length unit, of shaking that one sees.
pub(crate) const VISIBLE: f32 = 0.001;
/// Part of the steps in which a velocity turns round.
const TURNS: f32 = 0.2;
/// Steps after which a body is measured anew.
const MEASURE_EVERY: u64 = 50;
/// Seconds over which speed and flips are smoothed.
const SMOOTHING: f32 = 0.3;

impl Track {
    /// Of a body that is there since a step, at least.
    pub(crate) fn new(look: &Look<'_>, body: &Body<'_>, since: u64) -> Self {
        Self {
            id: body.id(),
            since,
            glance: look.step,
            center: body.center(),
            velocity: body.velocity(),
            before: body.velocity(),
            thin: 0.0,
            size: 0.0,
            density: 0.0,
            place: body.center(),
            still: 0.0,
            free: 0.0,
            flew: 0.0,
            spin: 0.0,
            speed: body.velocity().length(),
            flips: 0.0,
            overlap: 0.0,
            resting_overlap: None,
            deep_since: None,
            deep_seen: 0,
            sunk: 0,
            crushed: None,
            normal: None,
            normal_flips: 0,
            deepest: 0.0,
            shaking: 0.0,
            placed: None,
            wakings: 0,
            unmet: 0,
            measured: 0,
        }
    }

    /// Its size, where that has not been asked for some time.
    pub(crate) fn measure_again(&mut self, look: &Look<'_>, body: &Body<'_>) {
        if self.measured <= look.step {
            self.measured = look.step + MEASURE_EVERY;
            self.measure(look.world, body);
        }
    }

    /// Its size and what it is made of, from its shapes.
    fn measure(&mut self, world: &World, body: &Body<'_>) {
        let center = body.local_center();
        let solid =
            body.shapes().filter_map(|id| world.shape(id)).filter(|shape| !shape.is_sensor());
        let (mut thin, mut size, mut area) = (f32::INFINITY, 0.0_f32, 0.0);
        for shape in solid {
            area += shape.shape().area();
            thin = thin.min(shape.shape().inner_radius());
            let bounds = shape.shape().aabb(shape.local());
            let far = (bounds.min - center).abs().max((bounds.max - center).abs());
            size = size.max(far.length());
        }
        self.thin = if thin.is_finite() { thin } else { 0.0 };
        self.size = size;
        self.density = if area > 0.0 { body.mass() / area } else { 0.0 };
    }

    /// Does its velocity turn round in its place, again and again, so that one sees it?
    fn shakes(&self, look: &Look<'_>) -> bool {
        let shakes = self.flips > TURNS && self.speed > SHAKING * look.unit;
        self.still > RESTING && shakes && self.stroke(look) > VISIBLE * look.unit
    }

    /// How far it shakes to and fro, metres.
    pub(crate) fn stroke(&self, look: &Look<'_>) -> f32 {
        self.speed * look.dt / self.flips.max(TURNS)
    }

    /// Is it enough to look at it in two steps of four? It is at rest then; two in a row, so that what shakes at the
    /// rate of steps is seen to.
    pub(crate) fn may_wait(&self, look: &Look<'_>) -> bool {
        self.still > RESTING && (look.step + self.id.index() as u64) & 2 != 0
    }

    /// Takes in where it is now, and gives where it was.
    pub(crate) fn glance(&mut self, look: &Look<'_>, body: &Body<'_>) -> Before {
        let rested = self.still > RESTING;
        let (center, velocity) = (self.center, self.velocity);
        let before = Before { center, velocity, glance: self.glance, rested };
        let dt = self.turn(look);
        let (center, velocity) = (body.center(), body.velocity());
        let reach = PLACE * self.size;
        if body.kind() != BodyKind::Dynamic {
            (self.still, self.free) = (0.0, 0.0);
        } else if center.relative_to(self.place).length_sq() > reach * reach {
            self.place = center;
            (self.still, self.resting_overlap, self.wakings) = (0.0, None, 0);
        } else {
            self.still += dt;
        }
        self.free += dt;
        let blend = (dt / SMOOTHING).min(1.0);
        // Velocities along and about, as those of its rim.
        let spin = body.angular_velocity() * self.size;
        let turned = velocity.dot(self.velocity) + spin * self.spin < 0.0;
        self.flips += (f32::from(u8::from(turned)) - self.flips) * blend;
        let pace = (velocity.length_sq() + spin * spin).sqrt();
        self.speed += (pace - self.speed) * blend;
        self.spin = spin;
        self.shaking = if self.shakes(look) { self.shaking + dt } else { 0.0 };
        (self.center, self.before, self.velocity) = (center, self.velocity, velocity);
        before
    }

    /// Takes in that it sleeps.
    pub(crate) fn sleeps(&mut self, look: &Look<'_>) {
        self.still = (self.still - self.turn(look)).max(0.0);
        (self.free, self.speed, self.shaking) = (0.0, 0.0, 0.0);
        (self.before, self.velocity) = (Vec2::ZERO, Vec2::ZERO);
    }

    /// Seconds since its last turn.
    fn turn(&mut self, look: &Look<'_>) -> f32 {
        let steps = look.step - core::mem::replace(&mut self.glance, look.step);
        steps as f32 * look.dt
    }
}
