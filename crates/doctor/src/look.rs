//! What a check sees, and where it says what it found.

use crate::finding::{Figure, Finding, Who};
use crate::{Code, Report, Severity};
use std::collections::{BTreeMap, BTreeSet};
use tiny_physics::{BodyId, ContactView, JointId, ShapeId, Vec2, World};

/// One step of a world, as all checks see it.
#[derive(Clone, Copy)]
pub(crate) struct Look<'a> {
    pub(crate) world: &'a World,
    pub(crate) step: u64,
    pub(crate) dt: f32,
    /// Length unit: what metre-scaled bounds are multiplied by.
    pub(crate) unit: f32,
    /// Length of gravity, metres a second squared.
    pub(crate) pull: f32,
    /// Does the program push bodies in every step?
    pub(crate) pushed: bool,
}

impl<'a> Look<'a> {
    pub(crate) fn new(world: &'a World) -> Self {
        let dt = world.stats().dt;
        let (unit, pull) = (world.settings.length_unit, world.gravity.length());
        Self { world, step: world.step_count(), dt, unit, pull, pushed: false }
    }

    /// Down, unit; zero without gravity.
    pub(crate) fn down(&self) -> Vec2 {
        self.world.gravity.normalized()
    }

    /// Does the surface of a shape run?
    pub(crate) fn is_belt(&self, id: ShapeId) -> bool {
        self.world.shape(id).is_some_and(|shape| shape.material().tangent_speed != 0.0)
    }

    fn body(&self, id: BodyId) -> Who<BodyId> {
        Who { id, user_data: self.world.body(id).map_or(0, |body| body.user_data()) }
    }

    fn shape(&self, id: ShapeId) -> Who<ShapeId> {
        Who { id, user_data: self.world.shape(id).map_or(0, |shape| shape.user_data()) }
    }

    fn joint(&self, id: JointId) -> Who<JointId> {
        Who { id, user_data: self.world.joint(id).map_or(0, |joint| joint.user_data()) }
    }
}

/// A contact seen from one of its bodies.
#[derive(Clone, Copy)]
pub(crate) struct Touch {
    pub(crate) own: ShapeId,
    pub(crate) shape: ShapeId,
    pub(crate) body: BodyId,
    /// Out of the other body.
    pub(crate) normal: Vec2,
    /// Metres, 0 or above.
    pub(crate) overlap: f32,
}

impl Touch {
    pub(crate) fn of(body: BodyId, contact: &ContactView) -> Self {
        let first = contact.body_a == body;
        let deepest = contact.points().iter().map(|p| p.separation).fold(0.0, f32::min);
        let (own, shape, other) = if first {
            (contact.shape_a, contact.shape_b, contact.body_b)
        } else {
            (contact.shape_b, contact.shape_a, contact.body_a)
        };
        Self {
            own,
            shape,
            body: other,
            normal: if first { -contact.normal } else { contact.normal },
            overlap: -deepest,
        }
    }
}

/// What a finding is about: one for each is kept.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum About {
    World,
    Body(BodyId),
    Joint(JointId),
}

impl About {
    /// Where it is in its list: bodies that follow each other in one place are counted as one, so that memory is bounded.
    fn place(self) -> (u32, bool) {
        match self {
            Self::World => (u32::MAX, false),
            Self::Body(id) => (id.index() as u32, false),
            Self::Joint(id) => (id.index() as u32, true),
        }
    }
}

/// Something seen: a finding in the making.
pub(crate) struct Sighting {
    pub(crate) code: Code,
    pub(crate) severity: Severity,
    pub(crate) about: About,
    pub(crate) figure: Figure,
}

impl Sighting {
    pub(crate) fn new(code: Code, severity: Severity, about: About, figure: Figure) -> Self {
        Self { code, severity, about, figure }
    }
}

/// A figure with its bound.
pub(crate) fn figure(name: &'static str, value: f32, threshold: f32, unit: &'static str) -> Figure {
    Figure { name, value: f64::from(value), threshold: f64::from(threshold), unit }
}

/// The words of a finding, made only where they are needed.
#[derive(Default)]
pub(crate) struct Words {
    pub(crate) what: String,
    pub(crate) advice: &'static str,
    pub(crate) bodies: Vec<BodyId>,
    pub(crate) shapes: Vec<ShapeId>,
    pub(crate) joints: Vec<JointId>,
    pub(crate) figures: Vec<Figure>,
}

/// Findings kept of one kind; of more is remembered what they are about.
const KEPT: usize = 16;
/// What more findings of one kind may be about; beyond it is not counted.
const COUNTED: usize = 1000;

/// Steps by which a cause may be told later than what it brings about: some are seen sooner than others.
const SOON: u64 = 120;

/// All that was found.
#[derive(Default, Debug, Clone)]
pub(crate) struct Findings {
    found: BTreeMap<Kind, BTreeMap<About, Finding>>,
    more: BTreeMap<Kind, BTreeSet<(u32, bool)>>,
}

/// A code and the name of what was measured: numbers of bodies and of sensors are not to be compared.
type Kind = (Code, &'static str);

impl Findings {
    /// Books a sighting; asks for words where it is new or worse than before.
    pub(crate) fn add(&mut self, look: &Look<'_>, seen: Sighting, words: impl FnOnce() -> Words) {
        let kind = (seen.code, seen.figure.name);
        let kept = self.found.entry(kind).or_default();
        if let Some(known) = kept.get_mut(&seen.about) {
            known.count += 1;
            known.last_step = look.step;
            let worse = seen.severity > known.severity
                || seen.severity == known.severity
                    && seen.figure.value > known.figures[0].value * 1.1;
            if worse {
                let (first_step, count) = (known.first_step, known.count);
                *known = Finding { first_step, count, ..describe(look, &seen, words()) };
            }
        } else if kept.len() < KEPT {
            kept.insert(seen.about, describe(look, &seen, words()));
        } else {
            let more = self.more.entry(kind).or_default();
            if more.len() < COUNTED {
                more.insert(seen.about.place());
            }
        }
    }

    /// All findings of a code, by what was measured.
    fn of(&self, code: Code) -> impl Iterator<Item = &BTreeMap<About, Finding>> + Clone {
        let from = self.found.range((code, "")..);
        from.take_while(move |(kind, _)| kind.0 == code).map(|(_, kept)| kept)
    }

    /// Is anything of this code known about a body?
    pub(crate) fn has(&self, code: Code, about: About) -> bool {
        self.of(code).any(|kept| kept.contains_key(&about))
    }

    /// Bytes of all that is kept.
    pub(crate) fn memory(&self) -> usize {
        let kept = self.found.values().flat_map(BTreeMap::values);
        kept.map(Finding::memory).sum::<usize>()
            + self.more.values().map(BTreeSet::len).sum::<usize>() * size_of::<(u32, bool)>()
            + (self.found.len() + self.more.len()) * size_of::<(Kind, BTreeMap<About, Finding>)>()
    }

    /// What was seen last; of several the worst, causes before their effects.
    pub(crate) fn latest(&self) -> Option<&Finding> {
        let kept = self.found.values().flat_map(BTreeMap::values);
        kept.max_by(|a, b| {
            let later = a.last_step.cmp(&b.last_step);
            later.then(a.severity.cmp(&b.severity)).then(b.code.cmp(&a.code))
        })
    }

    /// One finding for each code, measured figure and severity: the one that weighs most; the others are counted.
    pub(crate) fn report(&self, steps: u64, bodies: usize) -> Report {
        let mut findings: Vec<Finding> = Vec::new();
        for (kind, kept) in &self.found {
            let mut worst: BTreeMap<Severity, Finding> = BTreeMap::new();
            for finding in kept.values() {
                let Some(known) = worst.get_mut(&finding.severity) else {
                    worst.insert(finding.severity, finding.clone());
                    continue;
                };
                let others = known.others + 1;
                if finding.weight() > known.weight() {
                    *known = finding.clone();
                }
                known.others = others;
            }
            if let Some(mut most) = worst.last_entry() {
                most.get_mut().others += self.more.get(kind).map_or(0, |more| more.len() as u64);
            }
            findings.extend(worst.into_values());
        }
        let mut report = Report { steps, bodies, findings }.sorted();
        report.put_causes_first(|cause, effect| self.brings_about(cause, effect));
        report
    }

    /// Is a kind of finding the cause of another one here: about the same body or joint, or about the world, and not later?
    fn brings_about(&self, cause: Code, effect: Code) -> bool {
        let effects = self.of(effect).flat_map(BTreeMap::values);
        cause.brings_about().contains(&effect)
            && self.of(cause).flatten().any(|(about, cause)| {
                let same = |effect: &Finding| *about == About::World || cause.shares_with(effect);
                let late = match cause.code {
                    Code::EnergyGain => 0,
                    // Takes time to be seen.
                    Code::Sinking => u64::MAX / 2,
                    _ => SOON,
                };
                let soon = |effect: &Finding| cause.first_step <= effect.first_step + late;
                effects.clone().any(|effect| same(effect) && soon(effect))
            })
    }
}

fn describe(look: &Look<'_>, seen: &Sighting, words: Words) -> Finding {
    let mut figures = vec![seen.figure];
    figures.extend(words.figures);
    Finding {
        code: seen.code,
        severity: seen.severity,
        first_step: look.step,
        last_step: look.step,
        count: 1,
        others: 0,
        bodies: words.bodies.into_iter().map(|id| look.body(id)).collect(),
        shapes: words.shapes.into_iter().map(|id| look.shape(id)).collect(),
        joints: words.joints.into_iter().map(|id| look.joint(id)).collect(),
        figures,
        what: words.what,
        advice: words.advice.to_owned(),
        page: seen.code.page(),
    }
}
