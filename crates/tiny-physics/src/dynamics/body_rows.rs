//! The rows of bodies that the solver works on, and what impulses do by them: along each axis, and in turning.

use crate::simd::Lanes;

/// Positions of the parts of a body's [`Row`](crate::simd::Row).
pub(crate) struct Slot;

impl Slot {
    pub(crate) const VX: usize = 0;
    pub(crate) const VY: usize = 1;
    pub(crate) const W: usize = 2;
    pub(crate) const INV_MASS: usize = 3;
    pub(crate) const DX: usize = 4;
    pub(crate) const DY: usize = 5;
    pub(crate) const DA: usize = 6;
    pub(crate) const INV_INERTIA: usize = 7;
    /// All but the masses.
    pub(crate) const MOTION: [usize; 6] =
        [Self::VX, Self::VY, Self::W, Self::DX, Self::DY, Self::DA];
}

/// Inverse masses along x and y and inverse inertia, by the rows of bodies. What is locked along one axis has a negative inverse mass
/// there: along y if its inverse inertia is negative, too, else along x. Where nothing is locked they are those of the row to the bit.
#[inline(always)]
pub(crate) fn inverses<L: Lanes>(token: L::Token, row: &[L; 8]) -> [L; 3] {
    let zero = L::splat(token, 0.0);
    let (mass, turn) = (row[Slot::INV_MASS], row[Slot::INV_INERTIA]);
    let (locked, along_y) = (mass.lt(zero), turn.lt(zero));
    let turned = (turn.abs() - L::splat(token, f32::MIN_POSITIVE)).max(zero);
    let x = L::select(L::and(locked, L::not(along_y)), zero, mass.abs());
    let y = L::select(L::and(locked, along_y), zero, mass.abs());
    [x, y, L::select(along_y, turned, turn)]
}

/// Inverse masses of two bodies along x and y, where a lane has one that is locked along an axis; their rows then have the inverse
/// inertias as they are.
#[inline(always)]
pub(crate) fn locked<L: Lanes>(token: L::Token, [a, b]: [&mut [L; 8]; 2]) -> Option<[[L; 2]; 2]> {
    let lock = a[Slot::INV_MASS].min(b[Slot::INV_MASS]).lt(L::splat(token, 0.0));
    if L::bits(lock) == 0 {
        return None;
    }
    let [[x_a, y_a, turn_a], [x_b, y_b, turn_b]] = [inverses(token, a), inverses(token, b)];
    (a[Slot::INV_INERTIA], b[Slot::INV_INERTIA]) = (turn_a, turn_b);
    Some([[x_a, y_a], [x_b, y_b]])
}

/// A direction within .011 rad of a locked axis counts as that: nothing moves along it. The square of that. On others what is locked goes
/// up to 90 times as far along its free axis as it is pushed; the 9e-8 by which a wall turned by pi is off made lifts beside it fly.
pub(crate) const LOCKED: f32 = 1.0 / 8192.0;

/// Inverse mass along a unit direction, of those along x and y. Where these are the same it is that to the bit, as in strides without
/// anything locked.
#[inline(always)]
pub(crate) fn inverse_mass_along<L: Lanes>(
    token: L::Token,
    direction: [L; 2],
    masses: [L; 2],
) -> L {
    let squares = [direction[0] * direction[0], direction[1] * direction[1]];
    let [x, y] = masses;
    L::select(x.eq(y), x, give(token, squares, masses, x + y))
}

/// Velocity along a direction of any length per impulse along it, of inverse masses along x and y; likewise.
#[inline(always)]
pub(crate) fn give_along<L: Lanes>(token: L::Token, direction: [L; 2], masses: [L; 2]) -> L {
    let squares = [direction[0] * direction[0], direction[1] * direction[1]];
    let ([x, y], square) = (masses, squares[0] + squares[1]);
    L::select(x.eq(y), x * square, give(token, squares, masses, (x + y) * square))
}

#[inline(always)]
fn give<L: Lanes>(token: L::Token, squares: [L; 2], [x, y]: [L; 2], both: L) -> L {
    let along = squares[0] * x + squares[1] * y;
    let free = along.gt(both * L::splat(token, LOCKED));
    L::select(free, along, L::splat(token, 0.0))
}
