//! Energy that comes from nowhere.

use crate::look::{About, Findings, Look, Sighting, Words, figure};
use crate::{Code, Severity};
use tiny_physics::{Body, BodyId, BodyKind, ContactView, JointId};

/// Steps between two sums.
const EVERY: u64 = 8;
/// Most bodies that are summed up.
const MOST: usize = 512;
/// Most bodies and joints of an island that are named.
const ISLAND: usize = 8;
/// Sums with growing energy before it is a finding.
const GROWING: u32 = 4;
/// Factor by which kinetic energy has to pass what was there before.
const FACTOR: f64 = 1.5;

#[derive(Default, Debug, Clone)]
pub(crate) struct Memory {
    kinetic: f64,
    potential: f64,
    mass: f64,
    moved: bool,
    gravity: [f32; 2],
    /// Least energy since the world was last changed, joules.
    least: Option<f64>,
    last: f64,
    /// Greatest kinetic energy until the energy was least.
    peak: f64,
    growing: u32,
    /// Total mass at the last judgement, kilograms.
    weighed: f64,
    /// Pushes by the user before the energy was least.
    pushes: u64,
}

impl Memory {
    /// The world has been changed: what was before says nothing.
    pub(crate) fn reset(&mut self) {
        (self.least, self.growing, self.peak) = (None, 0, 0.0);
    }

    /// Sums up the energy of all bodies now and then, and judges it.
    pub(crate) fn check(
        &mut self,
        look: &Look<'_>,
        bodies: &[BodyId],
        driven: bool,
        findings: &mut Findings,
    ) {
        if !look.step.is_multiple_of(EVERY) || bodies.len() > MOST {
            return;
        }
        (self.kinetic, self.potential, self.mass, self.moved) = (0.0, 0.0, 0.0, false);
        for body in bodies.iter().filter_map(|&id| look.world.body(id)) {
            self.add(look, &body);
        }
        self.judge(look, driven, findings);
    }

    fn add(&mut self, look: &Look<'_>, body: &Body<'_>) {
        let velocity = body.velocity();
        if body.kind() != BodyKind::Dynamic {
            self.moved |= velocity.length_sq() > 0.0 || body.angular_velocity() != 0.0;
            return;
        }
        let mass = f64::from(body.mass());
        let turning = f64::from(body.angular_velocity());
        self.kinetic += 0.5
            * (mass * f64::from(velocity.length_sq())
                + f64::from(body.inertia()) * turning * turning);
        let (center, gravity) = (body.center(), look.world.gravity * body.gravity_scale());
        self.potential -=
            mass * (center.x * f64::from(gravity.x) + center.y * f64::from(gravity.y));
        self.mass += mass;
    }

    fn judge(&mut self, look: &Look<'_>, driven: bool, findings: &mut Findings) {
        let gravity = look.world.gravity;
        let other = self.gravity != [gravity.x, gravity.y] || self.weighed != self.mass;
        if driven || self.moved || other {
            (self.gravity, self.weighed) = ([gravity.x, gravity.y], self.mass);
            self.reset();
            return;
        }
        let energy = self.kinetic + self.potential;
        let least = self.least.map_or(energy, |least| least.min(energy));
        if self.least.is_none_or(|before| energy <= before) {
            self.peak = self.peak.max(self.kinetic);
            (self.growing, self.pushes) = (0, look.world.stats().pushes);
        }
        self.growing += u32::from(energy > self.last && self.least.is_some());
        (self.least, self.last) = (Some(least), energy);
        let unit = f64::from(look.unit);
        let scale = self.peak + 0.05 * self.mass * unit * (f64::from(gravity.length()) + unit);
        let gain = energy - least;
        if self.growing < GROWING || gain <= FACTOR * scale {
            return;
        }
        let on_belt =
            |contact: ContactView| look.is_belt(contact.shape_a) || look.is_belt(contact.shape_b);
        if look.world.contacts().any(on_belt) {
            self.reset();
        } else {
            self.report(look, gain, FACTOR * scale, findings);
        }
    }

    fn report(&self, look: &Look<'_>, gain: f64, bound: f64, findings: &mut Findings) {
        let figure = figure("energy gained", gain as f32, bound as f32, " J");
        let pushed = look.world.stats().pushes.saturating_sub(self.pushes);
        let severity = if pushed > 0 { Severity::Note } else { Severity::Warning };
        let seen = Sighting::new(Code::EnergyGain, severity, About::World, figure);
        let steps = u64::from(self.growing) * EVERY;
        findings.add(look, seen, || {
            let (bodies, joints) = island(look);
            let source = source(look, &bodies, pushed);
            let fastest = bodies.first().map_or("nothing".to_owned(), BodyId::to_string);
            let others = match bodies.len() {
                0 | 1 => String::new(),
                more => format!(" and {} bodies about it", more - 1),
            };
            Words {
                what: format!("energy has grown by {gain:.1} J in {steps} steps: {source}; most of it is in {fastest}{others}"),
                advice: if pushed > 0 {
                    "bound the forces and velocities that are set in each step, or add damping"
                } else {
                    "look for restitution above 1, for joints made out of place or against each other, and for what a hook sets"
                },
                bodies,
                joints,
                ..Words::default()
            }
        });
    }
}

/// The body with the most energy of motion, and what touches it or is joined to it, near ones first.
fn island(look: &Look<'_>) -> (Vec<BodyId>, Vec<JointId>) {
    let energy = |body: &Body<'_>| body.mass() * body.velocity().length_sq();
    let moving = look.world.bodies().filter(|body| body.kind() == BodyKind::Dynamic);
    let fastest = moving.max_by(|a, b| energy(a).total_cmp(&energy(b)));
    let (mut bodies, mut joints) = (Vec::new(), Vec::new());
    bodies.extend(fastest.map(|body| body.id()));
    let mut at = 0;
    while let Some(body) = bodies.get(at).and_then(|&id| look.world.body(id)) {
        let touched = body.contacts().map(|contact| [contact.body_a, contact.body_b]);
        let mut others: Vec<BodyId> = touched.flatten().collect();
        for joint in body.joints().filter_map(|id| look.world.joint(id)) {
            others.extend([joint.bodies().0, joint.bodies().1]);
            if !joints.contains(&joint.id()) && joints.len() < ISLAND {
                joints.push(joint.id());
            }
        }
        for id in others {
            let moves = look.world.body(id).is_some_and(|body| body.kind() == BodyKind::Dynamic);
            if moves && bodies.len() < ISLAND && !bodies.contains(&id) {
                bodies.push(id);
            }
        }
        at += 1;
    }
    (bodies, joints)
}

/// Where energy comes from, as far as it can be seen.
fn source(look: &Look<'_>, bodies: &[BodyId], pushed: u64) -> String {
    let shapes = bodies.iter().filter_map(|&id| look.world.body(id)).flat_map(|body| body.shapes());
    let mut shapes = shapes.filter_map(|id| look.world.shape(id));
    if pushed > 0 {
        format!("the program pushed {pushed} times meanwhile")
    } else if let Some(shape) = shapes.find(|shape| shape.material().restitution > 1.0) {
        let restitution = shape.material().restitution;
        format!("{} gives back {restitution:.2} times what it gets", shape.id())
    } else {
        "no motor, moved body or push does that work".to_owned()
    }
}
