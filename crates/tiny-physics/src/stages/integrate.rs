//! Integration: what forces do to velocities, and velocities to positions.
//!
//! Semi-implicit Euler over substeps: velocity first, then position with the new velocity. Positions
//! move as deltas from the start of the step; [`finalize`](super::finalize) adds them up.

use crate::describe::BodyKind;
use crate::dynamics::{Bodies, BodyInfo, Motion, NULL, Slot};
use crate::math::Vec2;
use crate::simd::{FourKernel, Row, SimdLevel, dispatch_fours};
use crate::threads::{SharedRows, SharedSlice, Team};
use fearless_simd::{Select, Simd, SimdBase, SimdFrom, SimdMask, f32x4};

/// A body turns at most this much in a substep, radians: eight turns. It keeps numbers finite, no more.
const MAX_TURN: f32 = 8.0 * core::f32::consts::TAU;

/// Bodies that one member of the team integrates at a time.
const CHUNK: usize = 256;

/// Works out what each substep adds to the velocity of each body listed. Bodies that are not dynamic are
/// integrated once at every pace: they begin anew.
pub(crate) fn prepare(team: &Team, listed: &[u32], bodies: &mut Bodies, gravity: Vec2, h: f32) {
    let Bodies { rows, motions, starts, infos, .. } = bodies;
    let rows = SharedRows::new(rows);
    let (motions, starts) = (SharedSlice::new(motions), SharedSlice::new(starts));
    team.for_each_chunk(listed.len(), CHUNK, |range| {
        for &index in &listed[range] {
            let info = &infos[index as usize];
            rows.update(index, |row| {
                if info.kind != BodyKind::Dynamic {
                    row[Slot::DX..=Slot::DA].fill(0.0);
                }
                motions.write(index, motion(info, row, gravity, h));
                starts.write(index, [row[0], row[1], row[2], 0.0]);
            });
        }
    });
}

fn motion(info: &BodyInfo, row: &Row, gravity: Vec2, h: f32) -> Motion {
    let carry = if info.first_joint == NULL { 1.0 } else { 0.0 };
    if info.kind != BodyKind::Dynamic {
        return Motion { gain: [0.0, 0.0, 0.0, carry], factor: [1.0; 4] };
    }
    let linear = (gravity * info.gravity_scale + info.force * row[Slot::INV_MASS].abs()) * h;
    let turning = info.torque * row[Slot::INV_INERTIA].abs() * h;
    let damping = 1.0 / (1.0 + h * info.linear_damping);
    let mut factor = [damping, damping, 1.0 / (1.0 + h * info.angular_damping), 1.0];
    // What is gained is damped, too: what falls comes to force over damping, however long a substep is.
    let mut gain = [linear.x * factor[0], linear.y * factor[1], turning * factor[2], carry];
    let locks = info.locks;
    for (k, locked) in
        [locks.x, locks.y, locks.rotation || info.never_turns].into_iter().enumerate()
    {
        if locked {
            (gain[k], factor[k]) = (0.0, 0.0);
        }
    }
    Motion { gain, factor }
}

/// Adds a substep's gain to the velocities and, after the first substep, the impulses of the substep
/// before: they are what warm starting all contacts of the body would add, because contacts keep
/// their lever arms during a step. Joints turn theirs, so bodies with joints go without
/// ([`prepare`] marks them) and have their contacts warm started one by one.
pub(crate) fn velocities(
    team: &Team,
    level: SimdLevel,
    listed: &[u32],
    bodies: &mut Bodies,
    first: bool,
) {
    let columns = Columns::new(bodies);
    team.for_each_chunk(listed.len(), CHUNK, |range| {
        dispatch_fours(level, Velocities { listed: &listed[range], columns, first });
    });
}

/// What a substep reads and writes, of all bodies.
#[derive(Clone, Copy)]
struct Columns<'a> {
    rows: SharedRows<'a>,
    starts: SharedSlice<'a, [f32; 4]>,
    motions: &'a [Motion],
    /// Are lists of bodies ascending?
    ascending: bool,
}

impl<'a> Columns<'a> {
    fn new(bodies: &'a mut Bodies) -> Self {
        let Bodies { rows, motions, starts, awake_unsorted, .. } = bodies;
        let (rows, starts) = (SharedRows::new(rows), SharedSlice::new(starts));
        Self { rows, starts, motions, ascending: !*awake_unsorted }
    }

    /// Changes each body of a chunk. Most chunks have no gaps and need no look at the numbers of their bodies; with few it would cost more.
    #[inline(always)]
    fn for_each(self, listed: &[u32], mut change: impl FnMut(&mut Row, &mut [f32; 4], &Motion)) {
        let Self { rows, starts, motions, ascending } = self;
        let (Some(&first), Some(&last)) = (listed.first(), listed.last()) else { return };
        let range = first as usize..last as usize + 1;
        if ascending && listed.len() > 3 && range.len() == listed.len() {
            let both = rows.range(range.clone()).iter_mut().zip(starts.range(range.clone()));
            for ((row, start), motion) in both.zip(&motions[range]) {
                change(row, start, motion);
            }
            return;
        }
        for &index in listed {
            rows.update(
                index,
                #[inline(always)]
                |row| {
                    starts.update(
                        index,
                        #[inline(always)]
                        |start| change(row, start, &motions[index as usize]),
                    );
                },
            );
        }
    }
}

struct Velocities<'a> {
    listed: &'a [u32],
    columns: Columns<'a>,
    first: bool,
}

impl FourKernel for Velocities<'_> {
    /// The inverse mass goes along and comes out as it was.
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { listed, columns, first } = self;
        let planar = f32x4::simd_from(simd, [1.0, 1.0, 1.0, 0.0]);
        let carried = if first { f32x4::splat(simd, 0.0) } else { planar };
        columns.for_each(
            listed,
            #[inline(always)]
            |row, start, Motion { gain, factor }| {
                let carry = f32x4::splat(simd, gain[3]) * carried;
                let gain = f32x4::simd_from(simd, *gain);
                let factor = f32x4::simd_from(simd, *factor);
                let now = f32x4::from_slice(simd, &row[..4]);
                let base = now * factor + gain * planar;
                let before = f32x4::simd_from(simd, core::mem::replace(start, base.into()));
                (base + (now - before) * carry).store_slice(&mut row[..4]);
            },
        );
    }
}

/// Cuts what the last relaxation of substeps of length `h` left too fast.
pub(crate) fn bound(team: &Team, listed: &[u32], bodies: &mut Bodies, h: f32, max_speed: f32) {
    let rows = SharedRows::new(&mut bodies.rows);
    let limits = Limits::new(h, max_speed);
    team.for_each_chunk(listed.len(), CHUNK, |range| {
        for &index in &listed[range] {
            rows.update(index, |row| {
                let [x, y, turn, _] = limits.cut([row[Slot::VX], row[Slot::VY], row[Slot::W], 0.0]);
                (row[Slot::VX], row[Slot::VY], row[Slot::W]) = (x, y, turn);
            });
        }
    });
}

/// Moves the bodies on by a substep; speeds above the limits are cut, which is no impulse to be carried on.
pub(crate) fn positions(
    team: &Team,
    level: SimdLevel,
    listed: &[u32],
    bodies: &mut Bodies,
    h: f32,
    max_speed: f32,
) {
    let columns = Columns::new(bodies);
    let limits = Limits::new(h, max_speed);
    team.for_each_chunk(listed.len(), CHUNK, |range| {
        dispatch_fours(level, Positions { listed: &listed[range], columns, h, limits });
    });
}

/// Greatest speeds, metres and radians a second.
#[derive(Clone, Copy)]
struct Limits {
    speed: f32,
    turn_rate: f32,
}

struct Positions<'a> {
    listed: &'a [u32],
    columns: Columns<'a>,
    h: f32,
    limits: Limits,
}

impl FourKernel for Positions<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { listed, columns, h, limits } = self;
        let zero = f32x4::splat(simd, 0.0);
        let way = f32x4::simd_from(simd, [h, h, h, 0.0]);
        // What is slower along each axis needs no closer look.
        let Limits { speed, turn_rate } = limits;
        let most = f32x4::simd_from(simd, [0.7 * speed, 0.7 * speed, turn_rate, f32::INFINITY]);
        columns.for_each(
            listed,
            #[inline(always)]
            |row, start, motion| {
                let factor = f32x4::simd_from(simd, motion.factor);
                let now = f32x4::from_slice(simd, &row[..4]);
                let mut v = factor.simd_eq(zero).select(zero, now);
                if v.abs().simd_gt(most).any_true() {
                    let cut = f32x4::simd_from(simd, limits.cut(v.into()));
                    *start = (cut - (v - f32x4::simd_from(simd, *start))).into();
                    v = cut;
                }
                v.store_slice(&mut row[..4]);
                let moved = f32x4::from_slice(simd, &row[4..]);
                (moved + way * v).store_slice(&mut row[4..]);
            },
        );
    }
}

impl Limits {
    /// Those of substeps of length `h`.
    fn new(h: f32, max_speed: f32) -> Self {
        Self { speed: max_speed, turn_rate: MAX_TURN / h }
    }

    /// A velocity within them.
    fn cut(self, mut v: [f32; 4]) -> [f32; 4] {
        let speed_sq = v[0] * v[0] + v[1] * v[1];
        if speed_sq > self.speed * self.speed {
            let scale = self.speed / speed_sq.sqrt();
            v[0] *= scale;
            v[1] *= scale;
        }
        if v[2].abs() > self.turn_rate {
            v[2] = if v[2] > 0.0 { self.turn_rate } else { -self.turn_rate };
        }
        v
    }
}
