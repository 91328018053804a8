//! Input and output of the lane kernels.

use crate::simd::{BLOCK, Lanes};

/// Separation of a point that is not there.
pub(crate) const ABSENT: f32 = f32::MAX;

/// Pairs of rounded boxes, one a lane.
#[derive(Clone, Copy)]
pub(crate) struct LanePair<L> {
    /// Centre of B's box in the frame of A's box, metres.
    pub p: [L; 2],
    /// Rotation of B's box in the frame of A's box, cosine and sine.
    pub q: [L; 2],
    /// Half extents and radius of A, metres.
    pub a: [L; 3],
    /// Half extents and radius of B, metres.
    pub b: [L; 3],
}

/// Manifolds, one a lane, in the frame of A's box.
#[derive(Clone, Copy)]
pub(crate) struct LaneManifold<L> {
    /// Unit, from A to B. Never NaN, also where no point is there.
    pub normal: [L; 2],
    /// Midway between both surfaces. Zero for an absent point.
    pub points: [[L; 2]; 2],
    /// Metres, negative is overlap; [`ABSENT`] for a point that is not there. Either of the two can
    /// be the missing one: a point keeps its place as long as its features face each other.
    pub separation: [L; 2],
    /// Feature ids, 0 to 127; that of the second point is that of the first plus one.
    pub id: [L; 2],
}

impl<L: Lanes> LaneManifold<L> {
    /// Into ten rows: normal, points, separations, ids.
    #[inline(always)]
    pub fn store(&self, rows: &mut [[f32; BLOCK]]) {
        for k in 0..2 {
            self.normal[k].store(&mut rows[k]);
            self.points[0][k].store(&mut rows[2 + k]);
            self.points[1][k].store(&mut rows[4 + k]);
            self.separation[k].store(&mut rows[6 + k]);
            self.id[k].store(&mut rows[8 + k]);
        }
    }

    /// From ten rows.
    #[inline(always)]
    pub fn load(token: L::Token, rows: &[[f32; BLOCK]]) -> Self {
        let load = |k: usize| [L::load(token, &rows[k]), L::load(token, &rows[k + 1])];
        Self { normal: load(0), points: [load(2), load(4)], separation: load(6), id: load(8) }
    }

    /// A manifold of one point in the first place, if it is near enough.
    #[inline(always)]
    pub fn single(
        token: L::Token,
        normal: [L; 2],
        point: [L; 2],
        separation: L,
        max_separation: L,
    ) -> Self {
        let (zero, absent) = (L::splat(token, 0.0), L::splat(token, ABSENT));
        let near = separation.le(max_separation);
        Self {
            normal,
            points: [
                [L::select(near, point[0], zero), L::select(near, point[1], zero)],
                [zero, zero],
            ],
            separation: [L::select(near, separation, absent), absent],
            id: [zero, L::splat(token, 1.0)],
        }
    }
}

/// `-1` where `value` is below 0, else `1`.
#[inline(always)]
pub(super) fn sign<L: Lanes>(token: L::Token, value: L) -> L {
    L::select(value.lt(L::splat(token, 0.0)), L::splat(token, -1.0), L::splat(token, 1.0))
}
