//! Wakes islands that fell asleep, one a step.

use crate::check::{Check, index};
use crate::host::Host;
use serde::{Deserialize, Serialize};

/// Before each step, wakes the first of these bodies that is asleep, and its island with it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WakeSleepers {
    /// Indices of bodies of the scene, one of each island.
    pub bodies: Vec<usize>,
}

impl WakeSleepers {
    pub(super) fn check(&self, count: usize) -> Check {
        let checked =
            |(i, body): (usize, &usize)| index(&format!("bodies[{i}]"), *body, count, "bodies");
        self.bodies.iter().enumerate().try_for_each(checked)
    }

    pub(super) fn start(&self, bodies: &[usize]) -> Waking {
        Waking { bodies: self.bodies.iter().filter_map(|i| bodies.get(*i).copied()).collect() }
    }
}

/// The host's numbers of the bodies to wake.
#[derive(Clone, Debug)]
pub(crate) struct Waking {
    bodies: Vec<usize>,
}

impl Waking {
    pub(super) fn before_step(&mut self, host: &mut dyn Host) {
        if let Some(body) = self.bodies.iter().find(|body| !host.is_awake(**body)) {
            host.wake(*body);
        }
    }
}
