//! The middle of a step: contacts are looked at as they will lie there.
//!
//! The arms of a contact stay for a step, and those of its start are late by half of it. What rolls goes on to other points
//! meanwhile. So what brings a plank on a ball back to its balance comes late, and pumps: at the angular frequency `w` its
//! swing grows by `w^2 dt / 4` of itself a second, until it falls off. Those of the middle are as early as late.
//! That is for what bears already. What is fast, and may hit, is looked at as it is.

use super::narrow_context::Context;
use crate::dynamics::Slot;
use crate::geometry::manifold::LaneManifold;
use crate::simd::Lanes;

/// How the bodies of a stride move up to then: B against A, metres, and what each turns, radians.
pub(super) struct Lead<L: Lanes> {
    pub(super) linear: [L; 2],
    turns: [L; 2],
}

impl<L: Lanes> Lead<L> {
    #[inline(always)]
    pub(super) fn of(
        token: L::Token,
        context: &Context<'_>,
        [a, b]: [&[L; 8]; 2],
        [shape_a, shape_b]: [&[L; 8]; 2],
        load: L,
    ) -> Self {
        let (zero, one) = (L::splat(token, 0.0), L::splat(token, 1.0));
        // At most, from the centre of mass to a point that does not go on as the body turns.
        let extent = |shape: &[L; 8]| shape[0].abs() + shape[1].abs() + shape[4] + shape[5];
        let half = L::splat(token, 0.5 * context.dt);
        let (x, y) = ((b[Slot::VX] - a[Slot::VX]) * half, (b[Slot::VY] - a[Slot::VY]) * half);
        let turns = [a[Slot::W] * half, b[Slot::W] * half];
        let turned = turns[0].abs() * extent(shape_a) + turns[1].abs() * extent(shape_b);
        let limit = L::splat(token, context.speculative_distance);
        let far = (x.abs() + y.abs() + turned) / limit;
        let share = ((one - far) * L::splat(token, 2.0)).clamp(zero, one);
        // What lies on something that turns and that nothing moves goes its arc: see [`arcs`](super::arcs).
        let led =
            |row: &[L; 8]| (row[Slot::INV_MASS].abs() + row[Slot::INV_INERTIA].abs()).eq(zero);
        let spin =
            L::select(led(a), turns[0].abs(), zero) + L::select(led(b), turns[1].abs(), zero);
        // Over a seam goes what bore on one shape and will on the next: both are looked at alike.
        let guarded = shape_a[7].max(shape_b[7]).gt(L::splat(token, 1.5));
        let load = L::select(guarded, one, load);
        let share = L::select(L::or(spin.gt(zero), load.le(zero)), zero, share);
        Self { linear: [x * share, y * share], turns: [turns[0] * share, turns[1] * share] }
    }

    /// The rotation of A (0) or B (1) then.
    #[inline(always)]
    pub(super) fn turned(&self, token: L::Token, [c, s]: [L; 2], body: usize) -> [L; 2] {
        let (one, half) = (L::splat(token, 1.0), L::splat(token, 0.5) * self.turns[body]);
        // With the tangent of half of it: of length 1, however far that is. One that is not stretches what is seen from there.
        let scale = one / (one + half * half);
        let (cos, sin) = ((one - half * half) * scale, (half + half) * scale);
        [cos * c - sin * s, sin * c + cos * s]
    }

    /// Puts the separations of the first points back to the start. The manifold is in the world's axes, from the centre of mass
    /// of A, and that of B lies at `between`.
    #[inline(always)]
    pub(super) fn take_back(&self, m: &mut LaneManifold<L>, between: [L; 2], points: usize) {
        let [nx, ny] = m.normal;
        let along = nx * self.linear[0] + ny * self.linear[1];
        for (separation, [x, y]) in m.separation.iter_mut().zip(m.points).take(points) {
            let arm_a = x * ny - y * nx;
            let arm_b = (x - between[0]) * ny - (y - between[1]) * nx;
            *separation = *separation - (along + self.turns[1] * arm_b - self.turns[0] * arm_a);
        }
    }
}
