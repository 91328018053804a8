//! Time steps, and numbers that the engine refused.

use crate::look::{About, Findings, Look, Sighting, Words, figure};
use crate::{Code, Severity};

/// Steps whose lengths are remembered.
const REMEMBERED: usize = 64;
/// Seconds.
const TOO_LONG: f32 = 1.0 / 29.0;

#[derive(Default, Debug, Clone)]
pub(crate) struct Memory {
    lengths: Vec<f32>,
    next: usize,
    refused: u64,
}

impl Memory {
    pub(crate) fn check(&mut self, look: &Look<'_>, findings: &mut Findings) {
        self.check_length(look, findings);
        self.check_refused(look, findings);
    }

    fn check_length(&mut self, look: &Look<'_>, findings: &mut Findings) {
        if look.dt > TOO_LONG {
            let figure = figure("step", look.dt, TOO_LONG, " s");
            let seen = Sighting::new(Code::StepTooLong, Severity::Warning, About::World, figure);
            findings.add(look, seen, || Words {
                what: format!("a step is {:.4} s long: contacts and joints get soft, fast bodies skip far", look.dt),
                advice: "step by 1/60 s or less; FixedStep turns the time of a frame into whole steps",
                ..Words::default()
            });
        }
        if self.lengths.len() < REMEMBERED {
            self.lengths.push(look.dt);
            return;
        }
        self.lengths[self.next] = look.dt;
        self.next = (self.next + 1) % REMEMBERED;
        if self.next == 0 {
            self.check_variety(look, findings);
        }
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

    fn check_refused(&mut self, look: &Look<'_>, findings: &mut Findings) {
        let stats = look.world.stats();
        let refused = stats.refused_steps + stats.refused_numbers;
        let new = refused.saturating_sub(self.refused);
        self.refused = refused;
        if new > 0 {
            let figure = figure("calls that did nothing", refused as f32, 0.0, "");
            let seen = Sighting::new(Code::RefusedInput, Severity::Error, About::World, figure);
            findings.add(look, seen, || Words {
                what: format!("{refused} calls did nothing because a number was not finite or out of range"),
                advice: "use the try_ calls or check your numbers: a NaN often comes from dividing by a length of zero",
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
