//! The order in which things that are new are handed to the world: by what they are, not by who spawned them when.

use core::cmp::Ordering;
use core::fmt::Debug;
use tiny_physics::RigidBody;

/// Of two bodies: first as the user says, then kind, height and place, then all the rest. Bodies that compare equal are equal, so that it does
/// not matter which of them comes first.
pub(crate) fn of_bodies(a: &(u64, RigidBody), b: &(u64, RigidBody)) -> Ordering {
    let (x, y) = (&a.1, &b.1);
    a.0.cmp(&b.0)
        .then_with(|| (x.kind as u8).cmp(&(y.kind as u8)))
        .then_with(|| x.position.y.total_cmp(&y.position.y))
        .then_with(|| x.position.x.total_cmp(&y.position.x))
        .then_with(|| x.angle.total_cmp(&y.angle))
        .then_with(|| text(x).cmp(&text(y)))
}

/// Of what has no better order: as it prints.
pub(crate) fn text(of: &impl Debug) -> String {
    format!("{of:?}")
}
