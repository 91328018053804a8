//! What happens when: a list of deeds with their times, and a character who walks by a plan.

use super::deed::Deed;
use crate::check::{Check, finite, index, positive};
use crate::host::Host;
use serde::{Deserialize, Serialize};
use tiny_physics::{CharacterMover, MoverInput};

/// A list of what happens when, and perhaps a character.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Timeline {
    /// What happens, in this order where several happen before one step.
    pub acts: Vec<Act>,
    /// Who walks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hero: Option<Hero>,
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

/// A character who walks by a plan. The world does not know it, so a body without solid shapes goes along with it
/// to be seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hero {
    /// Index of the body that shows it; the character starts there.
    pub body: usize,
    /// Height of the capsule, metres.
    pub height: f32,
    /// Radius, metres.
    pub radius: f32,
    /// What it does, by time.
    pub plan: Vec<Walk>,
}

/// What a character does from a step on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Walk {
    /// The first step.
    pub from: u32,
    /// Horizontal speed, metres a second.
    #[serde(default)]
    pub walk: f32,
    /// Speed of a jump in the first step, metres a second; 0 is none.
    #[serde(default)]
    pub jump: f32,
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
        self.hero.as_ref().map_or(Ok(()), |hero| hero.check(bodies).map_err(|e| e.under("hero")))
    }

    pub(super) fn start(&self, bodies: &[usize], dt: f32) -> Happening {
        let acts = self.acts.iter().filter_map(|act| {
            let when = match act.when {
                When::Entered(body) => When::Entered(*bodies.get(body)?),
                other => other,
            };
            Some(Act { when, deed: act.deed.with_bodies(bodies)? })
        });
        let hero = self.hero.as_ref().and_then(|hero| {
            let body = *bodies.get(hero.body)?;
            Some(Walking { hero: Hero { body, ..hero.clone() }, mover: None })
        });
        Happening { dt, acts: acts.map(|act| (act, false)).collect(), hero }
    }
}

impl Hero {
    fn check(&self, bodies: usize) -> Check {
        index("body", self.body, bodies, "bodies")?;
        positive("height", self.height)?;
        positive("radius", self.radius)?;
        for (i, walk) in self.plan.iter().enumerate() {
            finite("walk", walk.walk)
                .and_then(|()| finite("jump", walk.jump))
                .map_err(|e| e.under(format_args!("plan[{i}]")))?;
        }
        Ok(())
    }
}

/// A timeline on the way.
#[derive(Debug)]
pub(crate) struct Happening {
    dt: f32,
    /// Acts with the host's numbers, and whether one that happens once has happened.
    acts: Vec<(Act, bool)>,
    hero: Option<Walking>,
}

impl Happening {
    pub(super) fn before_step(&mut self, host: &mut dyn Host, step: u32) {
        for (act, done) in &mut self.acts {
            let now = match act.when {
                When::Always => true,
                When::At(at) => at == step,
                When::During(from, to) => (from..to).contains(&step),
                When::Entered(body) => !*done && host.is_entered(body),
            };
            if now {
                *done = true;
                host.act(&act.deed, step as f32 * self.dt, self.dt);
            }
        }
        if let Some(hero) = &mut self.hero {
            hero.before_step(host, step, self.dt);
        }
    }
}

/// A character on the way.
#[derive(Debug)]
struct Walking {
    hero: Hero,
    mover: Option<CharacterMover>,
}

impl Walking {
    fn before_step(&mut self, host: &mut dyn Host, step: u32, dt: f32) {
        let hero = &self.hero;
        let mover = self.mover.get_or_insert_with(|| {
            CharacterMover::new(host.position(hero.body), hero.height, hero.radius)
        });
        let now = hero.plan.iter().rev().find(|walk| walk.from <= step);
        let input = now.map_or_else(MoverInput::default, |now| MoverInput {
            walk: now.walk,
            jump: if now.from == step { now.jump } else { 0.0 },
            drop: false,
        });
        host.walk(mover, hero.body, input, dt);
    }
}
