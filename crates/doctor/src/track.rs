//! What the doctor remembers of a body.

use tiny_physics::{Body, BodyId, BodyKind, DVec2, Vec2, World};

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
    /// Where it was when it last went further than a tenth of its size.
    pub(crate) place: DVec2,
    /// Seconds for which it has been there, awake.
    pub(crate) still: f32,
    /// Seconds since it last touched anything.
    pub(crate) free: f32,
    /// Speed, smoothed over a third of a second, metres a second.
    pub(crate) speed: f32,
    /// Part of the steps in which its velocity turned round, smoothed.
    pub(crate) flips: f32,
    /// Deepest overlap in the last thorough look, metres.
    pub(crate) overlap: f32,
    /// Overlap when it had come to rest, metres.
    pub(crate) resting_overlap: Option<f32>,
    /// Step since which its overlap has been deep.
    pub(crate) deep_since: Option<u64>,
    /// Seconds for which it has shaken in its place.
    pub(crate) shaking: f32,
    /// Step in which it was last put somewhere else by the user.
    pub(crate) placed: Option<u64>,
    /// Wakings within its time of rest.
    pub(crate) wakings: u32,
}

/// Parts of its size that a body may move and still be in its place.
const PLACE: f32 = 0.1;
/// Metres a second, by the length unit, at which what is at rest shakes visibly.
pub(crate) const SHAKING: f32 = 0.02;
/// Part of the steps in which a velocity turns round.
const TURNS: f32 = 0.125;
/// Seconds over which speed and flips are smoothed.
const SMOOTHING: f32 = 0.3;

impl Track {
    pub(crate) fn new(world: &World, body: &Body<'_>, step: u64) -> Self {
        let mut track = Self {
            id: body.id(),
            since: step,
            glance: step,
            center: body.center(),
            velocity: body.velocity(),
            before: body.velocity(),
            thin: 0.0,
            size: 0.0,
            place: body.center(),
            still: 0.0,
            free: 0.0,
            speed: body.velocity().length(),
            flips: 0.0,
            overlap: 0.0,
            resting_overlap: None,
            deep_since: None,
            shaking: 0.0,
            placed: None,
            wakings: 0,
        };
        track.measure(world, body);
        track
    }

    /// Its size, from its shapes.
    pub(crate) fn measure(&mut self, world: &World, body: &Body<'_>) {
        let center = body.local_center();
        let solid =
            body.shapes().filter_map(|id| world.shape(id)).filter(|shape| !shape.is_sensor());
        let (mut thin, mut size) = (f32::INFINITY, 0.0_f32);
        for shape in solid {
            thin = thin.min(shape.shape().inner_radius());
            let bounds = shape.shape().aabb(shape.local());
            let far = (bounds.min - center).abs().max((bounds.max - center).abs());
            size = size.max(far.length());
        }
        self.thin = if thin.is_finite() { thin } else { 0.0 };
        self.size = size;
    }

    /// Does its velocity turn round in its place, again and again?
    fn shakes(&self, unit: f32) -> bool {
        self.still > 1.0 && self.flips > TURNS && self.speed > SHAKING * unit
    }

    /// Takes in where it is now, `dt` seconds after the last glance.
    pub(crate) fn glance(&mut self, body: &Body<'_>, dt: f32, unit: f32) {
        let (center, velocity) = (body.center(), body.velocity());
        let away = center.relative_to(self.place).length();
        if !body.is_awake() || body.kind() != BodyKind::Dynamic {
            (self.still, self.free) = ((self.still - dt).max(0.0), 0.0);
        } else if away > PLACE * self.size {
            self.place = center;
            (self.still, self.resting_overlap, self.wakings) = (0.0, None, 0);
        } else {
            self.still += dt;
        }
        self.free += dt;
        let blend = (dt / SMOOTHING).min(1.0);
        let turned = velocity.dot(self.velocity) < 0.0;
        self.flips += (f32::from(u8::from(turned)) - self.flips) * blend;
        self.speed += (velocity.length() - self.speed) * blend;
        self.shaking = if self.shakes(unit) { self.shaking + dt } else { 0.0 };
        (self.center, self.before, self.velocity) = (center, self.velocity, velocity);
    }
}
