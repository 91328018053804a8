//! Bodies that walk to and fro and turn where they are held up.

use crate::check::{Check, finite, index};
use crate::host::Host;
use serde::{Deserialize, Serialize};
use tiny_physics::Vec2;

/// Bodies `first` to `first + count - 1` of the scene walk: those with an even place to the right at first,
/// the others to the left. One that was slowed to half its speed turns round.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Walkers {
    /// Index of the first of them.
    pub first: usize,
    /// How many there are.
    pub count: usize,
    /// Metres a second.
    pub speed: f32,
}

impl Walkers {
    pub(super) fn check(&self, bodies: usize) -> Check {
        finite("speed", self.speed)?;
        if self.count == 0 {
            return Ok(());
        }
        index("first", self.first, bodies, "bodies")?;
        index("count", self.first.saturating_add(self.count - 1), bodies, "bodies")
    }

    pub(super) fn start(&self, bodies: &[usize]) -> Walking {
        let walkers = bodies.iter().skip(self.first).take(self.count).enumerate();
        let direction = |place: usize| if place.is_multiple_of(2) { 1.0 } else { -1.0 };
        Walking {
            speed: self.speed,
            bodies: walkers.map(|(i, body)| (*body, direction(i))).collect(),
        }
    }
}

/// The host's number and the direction of each walker.
#[derive(Clone, Debug)]
pub(crate) struct Walking {
    speed: f32,
    bodies: Vec<(usize, f32)>,
}

impl Walking {
    pub(super) fn before_step(&mut self, host: &mut dyn Host, step: u32) {
        for (body, direction) in &mut self.bodies {
            let velocity = host.velocity(*body);
            if step > 0 && velocity.x * *direction < 0.5 * self.speed {
                *direction = -*direction;
            }
            host.set_velocity(*body, Vec2::new(*direction * self.speed, velocity.y));
        }
    }
}
