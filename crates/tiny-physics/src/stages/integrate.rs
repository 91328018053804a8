//! Integration: what forces do to velocities, and velocities to positions.
//!
//! Semi-implicit Euler over substeps: velocity first, then position with the new velocity. Positions
//! move as deltas from the start of the step; [`finalize`](super::finalize) adds them up.

use crate::describe::BodyKind;
use crate::dynamics::{Bodies, BodyInfo, Motion, Slot};
use crate::math::Vec2;
use crate::simd::Row;
use crate::threads::{SharedRows, SharedSlice, Team};

/// A body turns at most this much in a substep, radians: an eighth of a turn.
const MAX_TURN: f32 = core::f32::consts::FRAC_PI_4;

/// Bodies that one member of the team integrates at a time.
const CHUNK: usize = 256;

/// Works out what each substep adds to the velocity of each awake body.
pub(crate) fn prepare(team: &Team, bodies: &mut Bodies, gravity: Vec2, h: f32) {
    let Bodies { awake, rows, motions, infos, .. } = bodies;
    let motions = SharedSlice::new(motions);
    team.for_each_chunk(awake.len(), CHUNK, |range| {
        for &index in &awake[range] {
            let i = index as usize;
            motions.write(index, motion(&infos[i], &rows[i], gravity, h));
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

/// Adds a substep's gain to the velocities.
pub(crate) fn velocities(team: &Team, bodies: &mut Bodies) {
    let Bodies { awake, rows, motions, .. } = bodies;
    let rows = SharedRows::new(rows);
    team.for_each_chunk(awake.len(), CHUNK, |range| {
        for &index in &awake[range] {
            let motion = &motions[index as usize];
            rows.update(index, |row| {
                row[Slot::VX] = (row[Slot::VX] * motion.linear + motion.gain[0]) * motion.free[0];
                row[Slot::VY] = (row[Slot::VY] * motion.linear + motion.gain[1]) * motion.free[1];
                row[Slot::W] = (row[Slot::W] * motion.angular + motion.gain[2]) * motion.free[2];
            });
        }
    });
}

/// Moves the bodies on by a substep; speeds above the limits are cut.
pub(crate) fn positions(team: &Team, bodies: &mut Bodies, h: f32, max_speed: f32) {
    let Bodies { awake, rows, motions, .. } = bodies;
    let rows = SharedRows::new(rows);
    team.for_each_chunk(awake.len(), CHUNK, |range| {
        for &index in &awake[range] {
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
