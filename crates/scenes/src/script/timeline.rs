//! What happens when: a list of deeds with their times.

use super::deed::Deed;
use crate::check::{Check, index};
use crate::host::Host;
use serde::{Deserialize, Serialize};

/// A list of what happens when.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Timeline {
    /// What happens, in this order where several happen before one step.
    pub acts: Vec<Act>,
}

/// What happens, and when.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Act {
    /// When.
    pub when: When,
    /// What.
    pub deed: Deed,
}

/// The steps before which something happens; they are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum When {
    /// Before each.
    Always,
    /// Before one.
    At(u32),
    /// Before each from the first number on, up to but without the second.
    During(u32, u32),
    /// Once, before the step after that in which something came into a sensor of this body of the scene.
    Entered(usize),
}

impl When {
    /// Is it before a step, counted from 0? `None` where that hangs on more than the step.
    pub fn is_before(self, step: u32) -> Option<bool> {
        match self {
            Self::Always => Some(true),
            Self::At(at) => Some(at == step),
            Self::During(from, to) => Some((from..to).contains(&step)),
            Self::Entered(_) => None,
        }
    }
}

impl Timeline {
    pub(super) fn check(&self, bodies: usize) -> Check {
        for (i, act) in self.acts.iter().enumerate() {
            let at = |e: crate::SceneError| e.under(format_args!("acts[{i}]"));
            if let When::Entered(body) = act.when {
                index("entered", body, bodies, "bodies").map_err(|e| at(e.under("when")))?;
            }
            act.deed.check(bodies).map_err(|e| at(e.under("deed")))?;
        }
        Ok(())
    }

    pub(super) fn start(&self, bodies: &[usize], dt: f32) -> Happening {
        let acts = self.acts.iter().filter_map(|act| {
            let when = match act.when {
                When::Entered(body) => When::Entered(*bodies.get(body)?),
                other => other,
            };
            Some(Act { when, deed: act.deed.with_bodies(bodies)? })
        });
        Happening { dt, acts: acts.map(|act| (act, false)).collect() }
    }
}

/// A timeline on the way.
#[derive(Clone, Debug)]
pub(crate) struct Happening {
    dt: f32,
    /// Acts with the host's numbers, and whether one that happens once has happened.
    acts: Vec<(Act, bool)>,
}

impl Happening {
    pub(super) fn before_step(&mut self, host: &mut dyn Host, step: u32) {
        for (act, done) in &mut self.acts {
            let now = match act.when {
                When::Entered(body) => !*done && host.is_entered(body),
                when => when.is_before(step) == Some(true),
            };
            if now {
                *done = true;
                match &act.deed {
                    Deed::Add { new } => drop(host.add_body(new)),
                    Deed::Remove { body } => host.remove_body(*body),
                    deed => host.act(deed, step as f32 * self.dt, self.dt),
                }
            }
        }
    }
}
