//! Time steps, and numbers that the engine refused.

use crate::look::{About, Findings, Look, Sighting, Words, figure};
use crate::{Code, Severity};

/// Steps whose lengths are remembered.
const REMEMBERED: usize = 64;
/// Of fewer steps than these it is not said how many are long: the first one of a program often is.
const FEW: usize = 16;
/// Seconds.
const TOO_LONG: f32 = 1.0 / 29.0;
/// Steps in a row with pushes that are every step.
const PUSHING: u32 = 30;
/// Seconds: milliseconds given for seconds, or a clock that stood still.
const ABSURD: f32 = 0.5;

#[derive(Default, Debug, Clone)]
pub(crate) struct Memory {
    lengths: Vec<f32>,
    next: usize,
    refused: u64,
    pushes: u64,
    /// Steps in a row before which the program pushed.
    pushing: u32,
    stale: u64,
}

impl Memory {
    /// One that has seen no step, but knows what the world counts on: a world that goes back keeps its counts.
    pub(crate) fn anew(&self) -> Self {
        let Self { refused, pushes, stale, .. } = *self;
        Self { refused, pushes, stale, ..Self::default() }
    }

    /// Bytes.
    pub(crate) fn memory(&self) -> usize {
        self.lengths.capacity() * size_of::<f32>()
    }

    /// Takes in whether the program has pushed bodies since the last step; says whether it does so in every step.
    pub(crate) fn note_pushes(&mut self, look: &Look<'_>) -> bool {
        let pushes = look.world.stats().pushes;
        self.pushing = if pushes > self.pushes { self.pushing.saturating_add(1) } else { 0 };
        self.pushes = pushes;
        self.pushing > PUSHING
    }

    pub(crate) fn check_length(&mut self, look: &Look<'_>, findings: &mut Findings) {
        if self.lengths.len() < REMEMBERED {
            self.lengths.push(look.dt);
        } else {
            self.lengths[self.next] = look.dt;
        }
        self.next = (self.next + 1) % REMEMBERED;
        if self.next == 0 {
            self.check_variety(look, findings);
        }
        if look.dt > TOO_LONG {
            self.report_long(look, findings);
        }
    }

    fn report_long(&self, look: &Look<'_>, findings: &mut Findings) {
        let long = self.lengths.iter().filter(|dt| **dt > TOO_LONG).count();
        // Few among many are hitches; from somewhere on nothing holds together.
        let severity = match () {
            () if 2 * long < self.lengths.len().max(FEW) => Severity::Note,
            () if look.dt > ABSURD => Severity::Error,
            () => Severity::Warning,
        };
        let figure = figure("step", look.dt, TOO_LONG, " s");
        let seen = Sighting::new(Code::StepTooLong, severity, About::World, figure);
        findings.add(look, seen, || Words {
            what: format!(
                "a step is {:.4} s long: contacts and joints get soft, fast bodies skip far",
                look.dt
            ),
            advice: "step by 1/60 s or less; FixedStep turns the time of a frame into whole steps",
            ..Words::default()
        });
    }

    fn check_variety(&self, look: &Look<'_>, findings: &mut Findings) {
        let mut sorted = self.lengths.clone();
        sorted.sort_by(f32::total_cmp);
        let usual = sorted[REMEMBERED / 2];
        let odd = sorted.iter().filter(|dt| (*dt - usual).abs() > 0.02 * usual).count();
        let part = odd as f32 / REMEMBERED as f32;
        if part > 0.1 {
            let figure = figure("steps of another length", 100.0 * part, 10.0, " %");
            let seen = Sighting::new(Code::VariableStep, Severity::Warning, About::World, figure);
            findings.add(look, seen, || Words {
                what: format!(
                    "steps are between {:.4} and {:.4} s long",
                    sorted[0],
                    sorted[REMEMBERED - 1]
                ),
                advice: "step by one length and interpolate what you draw: FixedStep does both",
                ..Words::default()
            });
        }
    }

    pub(crate) fn check_refused(&mut self, look: &Look<'_>, findings: &mut Findings) {
        let stats = look.world.stats();
        let refused = stats.refused_steps + stats.refused_numbers;
        let new = refused.saturating_sub(self.refused);
        self.refused = refused;
        if new > 0 {
            let figure = figure("calls that did nothing", refused as f32, 0.0, "");
            let seen = Sighting::new(Code::RefusedInput, Severity::Error, About::World, figure);
            findings.add(look, seen, || Words {
                what: match (stats.refused_steps, stats.refused_numbers) {
                    (steps, 0) => format!("{steps} steps were not made: their length was not above 0, or gravity or a setting was no sensible number"),
                    (0, calls) => format!("{calls} calls did nothing because a number was not finite or out of range"),
                    (steps, calls) => format!("{steps} steps were not made and {calls} calls did nothing because a number was not finite or out of range"),
                },
                advice: "use the try_ calls (try_step says why) or check your numbers: a NaN often comes from dividing by a length of zero",
                ..Words::default()
            });
        }
        let stale = stats.stale_handles.saturating_sub(self.stale);
        self.stale = stats.stale_handles;
        if stale > 0 {
            let figure = figure("stale handles", stats.stale_handles as f32, 0.0, "");
            let seen = Sighting::new(Code::RefusedInput, Severity::Note, About::World, figure);
            findings.add(look, seen, || Words {
                what: format!(
                    "bodies or shapes that are gone were to be changed, {} times",
                    stats.stale_handles
                ),
                advice: "drop handles of what you remove; Events tell what went",
                ..Words::default()
            });
        }
        if stats.frozen_bodies > 0 {
            let figure = figure("bodies frozen", stats.frozen_bodies as f32, 0.0, "");
            let seen = Sighting::new(Code::RefusedInput, Severity::Error, About::World, figure);
            findings.add(look, seen, || Words {
                what: format!(
                    "{} bodies were stopped because their numbers were no longer finite",
                    stats.frozen_bodies
                ),
                advice: "look for forces or impulses far beyond the masses",
                ..Words::default()
            });
        }
    }
}
