//! What hits a body sooner goes before what hits it later in the substep.

use super::search::{Hit, Search};
use crate::dynamics::{Bodies, Graph};
use crate::footprint::footprint;
use crate::stages::islands::Stores;

/// What hits within this part of a substep does so at once.
const AT_ONCE: f32 = 0.02;

/// The hits of a substep in time.
#[derive(Debug, Default)]
pub(super) struct Order {
    /// What waits for something that hits sooner.
    late: Vec<Hit>,
    /// When bodies were hit last, by their numbers once it is asked for.
    since: Vec<(u32, f32)>,
    sorted: bool,
    /// When they are hit first in a round.
    dues: Vec<(u32, f32)>,
}

footprint!(Order { late, since, dues } none { sorted });

fn time(times: &[(u32, f32)], body: u32) -> Option<f32> {
    times.binary_search_by_key(&body, |&(body, _)| body).ok().map(|at| times[at].1)
}

/// When hits take place, for each of their bodies that moves.
fn times(bodies: &Bodies, graph: &Graph, hits: &[Hit]) -> impl Iterator<Item = (u32, f32)> {
    hits.iter()
        .flat_map(|hit| hit.bodies(graph).map(|body| (body, hit.due)))
        .filter(|&(body, _)| bodies.is_dynamic(body))
}

impl Order {
    pub(super) fn begin(&mut self) {
        self.late.clear();
        self.since.clear();
    }

    /// When one of two bodies was hit in this substep.
    pub(super) fn since(&mut self, [a, b]: [u32; 2]) -> Option<f32> {
        if !core::mem::replace(&mut self.sorted, true) {
            self.since.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
            self.since.dedup_by_key(|&mut (body, _)| body);
        }
        let [a, b] = [a, b].map(|body| time(&self.since, body));
        if a > b { a } else { b }
    }

    /// Adds to what hits in a round what has waited and still comes.
    pub(super) fn take_up(&mut self, search: Search<'_>, hits: &mut Vec<Hit>) {
        if self.late.is_empty() {
            return;
        }
        let again = self
            .late
            .drain(..)
            .filter_map(|Hit { at, first, .. }| Search { first, ..search }.aim(at));
        hits.extend(again.filter(|hit| hit.targets != [0.0; 2]));
        hits.sort_unstable_by_key(|hit| (hit.at.key(), !hit.first));
        hits.dedup_by_key(|hit| hit.at.key());
    }

    /// Puts off what hits a body later than something else, in a substep of `h` seconds.
    pub(super) fn put_off(&mut self, stores: &Stores<'_>, hits: &mut Vec<Hit>, h: f32) {
        if hits.iter().all(|hit| hit.due == 0.0) {
            return;
        }
        let Self { late, dues, .. } = self;
        let Stores { bodies, graph, .. } = stores;
        dues.clear();
        dues.extend(times(bodies, graph, hits));
        dues.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        dues.dedup_by_key(|&mut (body, _)| body);
        hits.retain(|hit| {
            let is_late =
                |body: u32| time(dues, body).is_some_and(|due| due + AT_ONCE * h < hit.due);
            let waits = hit.bodies(graph).into_iter().any(is_late);
            late.extend(waits.then_some(*hit));
            !waits
        });
    }

    /// Notes when the bodies of hits were hit.
    pub(super) fn note(&mut self, bodies: &Bodies, graph: &Graph, hits: &[Hit]) {
        self.since.extend(times(bodies, graph, hits));
        self.sorted = false;
    }
}
