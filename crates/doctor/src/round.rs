//! Whose turn it is: bodies that can move, some of them in each step.

use crate::look::Look;
use tiny_physics::{BodyId, BodyKind};

/// Bodies up to which all have their turn in every step; of more, a quarter of the rest, and never more than [`MOST`].
const FEW: usize = 128;
/// Bodies that have their turn in a step.
const MOST: usize = 512;
/// Steps after which bodies are listed anew, whatever their number.
const PATIENCE: u64 = 64;

/// The list of bodies that can move, and how far the doctor has come in it.
#[derive(Default, Debug, Clone)]
pub(crate) struct Round {
    pub(crate) bodies: Vec<BodyId>,
    at: usize,
    /// Step of the list, and of the one whose bodies are known to the doctor.
    pub(crate) listed: u64,
    pub(crate) admitted: u64,
    /// Step in which the bodies that are new in the list have come, at the earliest.
    pub(crate) since: u64,
    /// Since when the list is not that of the world.
    changed: Option<u64>,
    count: usize,
    /// Is a body of the list gone?
    stale: bool,
}

impl Round {
    /// Lists bodies anew where some have come or gone: at once in small worlds, later where going through all takes long.
    pub(crate) fn begin(&mut self, look: &Look<'_>) {
        let count = look.world.body_count();
        let changed = count != self.count || self.stale;
        let since = *self.changed.get_or_insert(look.step);
        if !changed {
            self.changed = None;
        }
        let pause = if changed { PATIENCE.min((count / MOST) as u64) } else { PATIENCE };
        if self.listed > 0 && look.step < self.listed + pause {
            return;
        }
        let moves = look.world.bodies().filter(|body| body.kind() != BodyKind::Static);
        self.bodies.clear();
        self.bodies.extend(moves.map(|body| body.id()));
        (self.since, self.changed) = (since, None);
        (self.listed, self.count, self.stale) = (look.step, count, false);
    }

    /// A body of the list is gone; another one may have its place.
    pub(crate) fn lacks_one(&mut self) {
        self.stale = true;
    }

    /// The places in the list of those whose turn it is.
    pub(crate) fn next(&mut self) -> core::ops::Range<usize> {
        let count = self.bodies.len();
        let turns = if count <= FEW { count } else { (FEW + (count - FEW) / 4).min(MOST) };
        let start = if self.at < count { self.at } else { 0 };
        // In parts of one size.
        let part = count.div_ceil(count.div_ceil(turns.max(1)).max(1));
        self.at = (start + part).min(count);
        start..self.at
    }

    /// Bytes.
    pub(crate) fn memory(&self) -> usize {
        self.bodies.capacity() * size_of::<BodyId>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tiny_physics::{RigidBody, Shape, Vec2, World};

    fn world_of(count: usize) -> World {
        let mut world = World::new(Vec2::ZERO);
        for i in 0..count {
            let ball = RigidBody::dynamic().position(Vec2::new(3.0 * i as f32, 0.0));
            world.add_body(ball.shape(Shape::circle(0.5).unwrap())).unwrap();
        }
        world.step(1.0 / 60.0);
        world
    }

    #[test]
    fn everybody_has_a_turn() {
        for count in [0, 1, 100, 128, 129, 1000, 3000] {
            let (world, mut round) = (world_of(count), Round::default());
            let mut turns = vec![0; count + 1];
            for _ in 0..200 {
                round.begin(&Look::new(&world));
                round.next().for_each(|place| turns[round.bodies[place].index()] += 1);
            }
            let few = turns.iter().skip(1).min().copied().unwrap_or(200);
            assert!(few >= 100 * 128 / count.max(128), "{count} bodies, {few} turns");
        }
    }

    #[test]
    fn small_worlds_are_listed_anew_at_once() {
        let (mut world, mut round) = (world_of(10), Round::default());
        for _ in 0..5 {
            let old = world.body_ids().next().unwrap();
            world.remove_body(old).unwrap();
            let ball = RigidBody::dynamic().position(Vec2::new(0.0, 9.0));
            let new = world.add_body(ball.shape(Shape::circle(0.5).unwrap())).unwrap();
            world.step(1.0 / 60.0);
            round.begin(&Look::new(&world));
            if round.bodies.contains(&old) {
                round.lacks_one();
            }
            round.begin(&Look::new(&world));
            assert!(round.bodies.contains(&new) && !round.bodies.contains(&old));
        }
    }
}
