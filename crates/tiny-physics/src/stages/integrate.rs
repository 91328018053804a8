//! Integration: what forces do to velocities, and velocities to positions.
//!
//! Semi-implicit Euler over substeps: velocity first, then position with the new velocity. Positions
//! move as deltas from the start of the step; [`finalize`](super::finalize) adds them up.

use crate::describe::BodyKind;
use crate::dynamics::{Bodies, BodyInfo, Motion, NULL, Slot};
use crate::math::Vec2;
use crate::simd::Row;
use crate::threads::{SharedRows, SharedSlice, Team};

/// A body turns at most this much in a substep, radians: an eighth of a turn.
const MAX_TURN: f32 = core::f32::consts::FRAC_PI_4;

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
        return Motion { gain: [0.0; 3], linear: 1.0, angular: 1.0, free: [1.0; 3] };
    }
    let free = |locked: bool| if locked { 0.0 } else { 1.0 };
    let linear = (gravity * info.gravity_scale + info.force * row[Slot::INV_MASS]) * h;
    Motion {
        gain: [linear.x, linear.y, info.torque * row[Slot::INV_INERTIA] * h],
        linear: 1.0 / (1.0 + h * info.linear_damping),
        angular: 1.0 / (1.0 + h * info.angular_damping),
        free: [
            free(info.locks.x),
            free(info.locks.y),
            free(info.locks.rotation || info.never_turns),
        ],
    }
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

#[inline]
fn gain(row: &mut Row, start: &mut [f32; 4], motion: &Motion, first: bool) {
    let damping = [motion.linear, motion.linear, motion.angular];
    let carry = if first { 0.0 } else { start[3] };
    for k in 0..3 {
        let pushed = (row[k] - start[k]) * carry;
        start[k] = (row[k] * damping[k] + motion.gain[k]) * motion.free[k];
        row[k] = start[k] + pushed;
    }
}

/// Moves the bodies on by a substep; speeds above the limits are cut.
pub(crate) fn positions(team: &Team, listed: &[u32], bodies: &mut Bodies, h: f32, max_speed: f32) {
    let Bodies { rows, motions, .. } = bodies;
    let rows = SharedRows::new(rows);
    team.for_each_chunk(listed.len(), CHUNK, |range| {
        for &index in &listed[range] {
            let free = &motions[index as usize].free;
            rows.update(index, |row| advance(row, free, h, max_speed));
        }
    });
}

#[inline]
fn advance(row: &mut Row, free: &[f32; 3], h: f32, max_speed: f32) {
    for k in 0..3 {
        row[k] *= free[k];
    }
    let speed_sq = row[Slot::VX] * row[Slot::VX] + row[Slot::VY] * row[Slot::VY];
    if speed_sq > max_speed * max_speed {
        let scale = max_speed / speed_sq.sqrt();
        row[Slot::VX] *= scale;
        row[Slot::VY] *= scale;
    }
    let max_turn_rate = MAX_TURN / h;
    if row[Slot::W].abs() > max_turn_rate {
        row[Slot::W] = if row[Slot::W] > 0.0 { max_turn_rate } else { -max_turn_rate };
    }
    row[Slot::DX] += h * row[Slot::VX];
    row[Slot::DY] += h * row[Slot::VY];
    row[Slot::DA] += h * row[Slot::W];
}
