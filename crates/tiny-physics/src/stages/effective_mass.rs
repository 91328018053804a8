//! Effective masses of contacts: what an impulse at a point moves.

use crate::dynamics::{
    Bodies, ConstraintBlock, Contact, Graph, LOCKED, Slot, inverse_mass_along, inverses, locked,
};
use crate::geometry::manifold::Manifold;
use crate::math::Vec2;
use crate::simd::{Lanes, Row};

/// 1 / (sum of inverse masses + arms squared times inverse inertias), zero where nothing can move.
#[inline(always)]
pub(super) fn effective_mass<L: Lanes>(token: L::Token, arm: [L; 2], [mass, a, b]: [L; 3]) -> L {
    let k = mass + a * arm[0] * arm[0] + b * arm[1] * arm[1];
    let zero = L::splat(token, 0.0);
    L::select(k.gt(zero), L::splat(token, 1.0) / k, zero)
}

/// Where a contact acts, from the middle between the surfaces on towards A, as a part of the way between them: on the surface of what
/// moves where the other does not. So a ball has its radius for an arm, however far it has sunk in or has still to go; between
/// two that move the middle makes no torque of nothing.
#[inline(always)]
pub(super) fn nearness<L: Lanes>(token: L::Token, rows: [&[L; 8]; 2]) -> L {
    let (half, zero) = (L::splat(token, 0.5), L::splat(token, 0.0));
    let [a, b] = rows;
    let to_b = L::select(a[Slot::INV_MASS].eq(zero), -half, zero);
    L::select(b[Slot::INV_MASS].eq(zero), half, to_b)
}

/// Takes the points of a manifold there, those that are as deep as contacts reach no further.
pub(super) fn draw_near(manifold: &mut Manifold, bodies: &Bodies, both: [u32; 2], reach: f32) {
    let rows = both.map(|body| &bodies.rows[body as usize]);
    let (share, normal) = (nearness::<f32>((), rows), manifold.normal);
    for point in &mut manifold.points {
        point.point -= normal * (share * point.separation.max(-reach));
    }
}

/// A direction along which only what is locked could give way and so does not: x or y itself.
#[inline(always)]
pub(super) fn straight<L: Lanes>(token: L::Token, [x, y]: [L; 2], linear: L) -> [L; 2] {
    let (zero, one, least) = (L::splat(token, 0.0), L::splat(token, 1.0), L::splat(token, LOCKED));
    let fixed = linear.eq(zero);
    let (flat, steep) = (L::and(fixed, (y * y).lt(least)), L::and(fixed, (x * x).lt(least)));
    let signs = [L::select(x.lt(zero), -one, one), L::select(y.lt(zero), -one, one)];
    [
        L::select(flat, signs[0], L::select(steep, zero, x)),
        L::select(steep, signs[1], L::select(flat, zero, y)),
    ]
}

/// The arm of what turns alone, given that across it: none where it is as good as none.
#[inline(always)]
pub(super) fn lever<L: Lanes>(token: L::Token, arm: L, across: L, linear: L) -> L {
    let (zero, square) = (L::splat(token, 0.0), arm * arm);
    let slight = square.lt((square + across * across) * L::splat(token, LOCKED));
    L::select(L::and(slight, linear.eq(zero)), zero, arm)
}

/// Inverse masses of both bodies together along normal and tangent, and those of each in turning.
pub(super) struct Inverses<L> {
    pub(super) along: L,
    across: L,
    turns: [L; 2],
    /// Do some turn alone?
    pub(super) pinned: bool,
}

impl<L: Lanes> Inverses<L> {
    #[inline(always)]
    pub(super) fn new(token: L::Token, [x, y]: [L; 2], [mut a, mut b]: [[L; 8]; 2]) -> Self {
        let mut along = a[Slot::INV_MASS] + b[Slot::INV_MASS];
        let mut across = along;
        if let Some([free_a, free_b]) = locked(token, [&mut a, &mut b]) {
            along = inverse_mass_along(token, [x, y], free_a)
                + inverse_mass_along(token, [x, y], free_b);
            across = inverse_mass_along(token, [y, x], free_a)
                + inverse_mass_along(token, [y, x], free_b);
        }
        let (turns, zero) = ([a[Slot::INV_INERTIA], b[Slot::INV_INERTIA]], L::splat(token, 0.0));
        let alone = L::and(along.min(across).eq(zero), zero.lt(turns[0] + turns[1]));
        Self { along, across, turns, pinned: L::bits(alone) != 0 }
    }

    /// Effective masses along normal and tangent, by the arms of these.
    #[inline(always)]
    pub(super) fn masses(&self, token: L::Token, [normal, tangent]: [&mut [L; 2]; 2]) -> (L, L) {
        let Self { along, across, turns: [a, b], pinned } = *self;
        if pinned {
            for k in 0..2 {
                let (n, t) = (normal[k], tangent[k]);
                (normal[k], tangent[k]) = (lever(token, n, t, along), lever(token, t, n, across));
            }
        }
        let normal = effective_mass(token, *normal, [along, a, b]);
        (normal, effective_mass(token, *tangent, [across, a, b]))
    }
}

/// Inverse masses of a body along a direction and in turning.
#[inline(always)]
pub(super) fn inverses_along(row: &Row, direction: Vec2) -> [f32; 2] {
    let [x, y, turn] = inverses::<f32>((), row);
    [inverse_mass_along((), [direction.x, direction.y], [x, y]), turn]
}

/// Has the constraint of a contact follow the masses of its bodies, which are others than when it was written.
pub(super) fn follow(graph: &mut Graph, contact: &Contact, bodies: &Bodies) {
    let Some((constraint, lane)) = graph.solved_mut(contact) else { return };
    let normal = Vec2::new(constraint.normal_x[lane], constraint.normal_y[lane]);
    let inverses = |axis: Vec2| {
        let [a, b] = [contact.body_a, contact.body_b]
            .map(|body| inverses_along(&bodies.rows[body as usize], axis));
        [a[0] + b[0], a[1], b[1]]
    };
    let (along, across) = (inverses(normal), inverses(normal.perp()));
    let anew = |mass: &mut f32, arms: [f32; 2], inverses: [f32; 3]| {
        if *mass > 0.0 {
            *mass = effective_mass::<f32>((), arms, inverses);
        }
    };
    for point in &mut constraint.points {
        let arms = [point.normal_arm_a[lane], point.normal_arm_b[lane]];
        anew(&mut point.normal_mass[lane], arms, along);
        let arms = [point.tangent_arm_a[lane], point.tangent_arm_b[lane]];
        anew(&mut point.tangent_mass[lane], arms, across);
    }
}

/// What the impulses of a contact do to the velocities of its bodies.
pub(super) fn changes(rows: &[Row; 2], constraint: &ConstraintBlock, lane: usize) -> [[f32; 3]; 2] {
    let normal = Vec2::new(constraint.normal_x[lane], constraint.normal_y[lane]);
    let (mut linear, mut turning) = (Vec2::ZERO, [0.0; 2]);
    for point in &constraint.points {
        let (push, rub) = (point.normal_impulse[lane], point.tangent_impulse[lane]);
        linear += normal * push - normal.perp() * rub;
        turning[0] -= point.normal_arm_a[lane] * push + point.tangent_arm_a[lane] * rub;
        turning[1] += point.normal_arm_b[lane] * push + point.tangent_arm_b[lane] * rub;
    }
    [(0, -linear), (1, linear)].map(|(k, linear)| {
        let [x, y, turn] = inverses::<f32>((), &rows[k]);
        [linear.x * x, linear.y * y, turning[k] * turn]
    })
}
