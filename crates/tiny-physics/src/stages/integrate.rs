//! Integration: what forces do to velocities, and velocities to positions.
//!
//! Semi-implicit Euler over substeps: velocity first, then position with the new velocity. Positions
//! move as deltas from the start of the step; [`finalize`](super::finalize) adds them up.

use crate::describe::BodyKind;
use crate::dynamics::{Bodies, BodyInfo, Motion, NULL, Slot};
use crate::math::Vec2;
use crate::simd::Row;
use crate::threads::{SharedRows, SharedSlice, Team};

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
                let carry = if info.first_joint == NULL { 1.0 } else { 0.0 };
                starts.write(index, [row[0], row[1], row[2], carry]);
            });
        }
    });
}

fn motion(info: &BodyInfo, row: &Row, gravity: Vec2, h: f32) -> Motion {
    if info.kind != BodyKind::Dynamic {
        return Motion { gain: [0.0; 4], factor: [1.0; 4] };
    }
    let linear = (gravity * info.gravity_scale + info.force * row[Slot::INV_MASS]) * h;
    let mut gain = [linear.x, linear.y, info.torque * row[Slot::INV_INERTIA] * h, 0.0];
    let damping = 1.0 / (1.0 + h * info.linear_damping);
    let mut factor = [damping, damping, 1.0 / (1.0 + h * info.angular_damping), 1.0];
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
pub(crate) fn velocities(team: &Team, listed: &[u32], bodies: &mut Bodies, first: bool) {
    let Bodies { rows, motions, starts, .. } = bodies;
    let rows = SharedRows::new(rows);
    let starts = SharedSlice::new(starts);
    team.for_each_chunk(listed.len(), CHUNK, |range| {
        for &index in &listed[range] {
            let motion = &motions[index as usize];
            rows.update(index, |row| starts.update(index, |start| gain(row, start, motion, first)));
        }
    });
}

/// In fours, inverse mass and mark carried along and put back: the compiler makes one instruction of four.
#[inline]
fn gain(row: &mut Row, start: &mut [f32; 4], motion: &Motion, first: bool) {
    let (now, before) = ([row[0], row[1], row[2], row[3]], *start);
    let carry = if first { 0.0 } else { before[3] };
    let (mut base, mut next) = ([0.0; 4], [0.0; 4]);
    for k in 0..4 {
        base[k] = now[k] * motion.factor[k] + motion.gain[k];
        next[k] = base[k] + (now[k] - before[k]) * carry;
    }
    *start = [base[0], base[1], base[2], before[3]];
    row[..4].copy_from_slice(&[next[0], next[1], next[2], now[3]]);
}

/// Cuts what the last relaxation left too fast.
pub(crate) fn bound(team: &Team, listed: &[u32], bodies: &mut Bodies, max_speed: f32) {
    let rows = SharedRows::new(&mut bodies.rows);
    team.for_each_chunk(listed.len(), CHUNK, |range| {
        for &index in &listed[range] {
            rows.update(index, |row| {
                let speed_sq = row[Slot::VX] * row[Slot::VX] + row[Slot::VY] * row[Slot::VY];
                if speed_sq > max_speed * max_speed {
                    let scale = max_speed / speed_sq.sqrt();
                    row[Slot::VX] *= scale;
                    row[Slot::VY] *= scale;
                }
            });
        }
    });
}

/// Moves the bodies on by a substep; speeds above the limits are cut.
pub(crate) fn positions(team: &Team, listed: &[u32], bodies: &mut Bodies, h: f32, max_speed: f32) {
    let Bodies { rows, motions, .. } = bodies;
    let rows = SharedRows::new(rows);
    let limits = Limits { speed: max_speed, turn_rate: MAX_TURN / h };
    team.for_each_chunk(listed.len(), CHUNK, move |range| {
        for &index in &listed[range] {
            let factor = &motions[index as usize].factor;
            rows.update(index, |row| advance(row, factor, h, limits));
        }
    });
}

/// Greatest speeds, metres and radians a second.
#[derive(Clone, Copy)]
struct Limits {
    speed: f32,
    turn_rate: f32,
}

#[inline]
fn advance(row: &mut Row, factor: &[f32; 4], h: f32, limits: Limits) {
    let mut v = [row[0], row[1], row[2], row[3]];
    for k in 0..4 {
        v[k] = if factor[k] == 0.0 { 0.0 } else { v[k] };
    }
    let speed_sq = v[0] * v[0] + v[1] * v[1];
    if (speed_sq > limits.speed * limits.speed) | (v[2].abs() > limits.turn_rate) {
        limit(&mut v, speed_sq, limits);
    }
    let way = [h * v[0], h * v[1], h * v[2], 0.0];
    row[..4].copy_from_slice(&v);
    for (place, way) in row[4..].iter_mut().zip(way) {
        *place += way;
    }
}

#[cold]
fn limit(v: &mut [f32; 4], speed_sq: f32, limits: Limits) {
    if speed_sq > limits.speed * limits.speed {
        let scale = limits.speed / speed_sq.sqrt();
        v[0] *= scale;
        v[1] *= scale;
    }
    if v[2].abs() > limits.turn_rate {
        v[2] = if v[2] > 0.0 { limits.turn_rate } else { -limits.turn_rate };
    }
}
