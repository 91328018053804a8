//! Rows of numbers about all bodies.

use crate::handles::Handle;
use tiny_physics::{Body, BodyKind, World};

/// Rows of all bodies in index order, made when they are asked for after a change.
#[derive(Clone, Default)]
pub(crate) struct Views {
    pub(crate) stale: bool,
    pub(crate) alpha: f32,
    pub(crate) count: usize,
    pub(crate) ids: Vec<f64>,
    /// x, y, angle.
    pub(crate) poses: Vec<f32>,
    /// x, y, angular.
    pub(crate) velocities: Vec<f32>,
    /// Bit 0 and 1: the kind; 2 awake, 3 enabled, 4 bullet.
    pub(crate) states: Vec<u8>,
}

impl Views {
    pub(crate) fn refresh(&mut self, world: &World, alpha: f32) {
        if !self.stale && self.alpha == alpha && self.count == world.body_count() {
            return;
        }
        (self.stale, self.alpha, self.count) = (false, alpha, world.body_count());
        self.ids.clear();
        self.poses.clear();
        self.velocities.clear();
        self.states.clear();
        for body in world.body_ids().filter_map(|id| world.body(id)) {
            let pose = body.interpolated_pose(alpha);
            let (velocity, p) = (body.velocity(), pose.p);
            self.ids.push(body.id().number());
            self.poses.extend([p.x as f32, p.y as f32, pose.q.angle()]);
            self.velocities.extend([velocity.x, velocity.y, body.angular_velocity()]);
            self.states.push(state(&body));
        }
    }
}

pub(crate) fn state(body: &Body<'_>) -> u8 {
    let flags = [body.is_awake(), body.is_enabled(), body.is_bullet()];
    let bits = flags.iter().enumerate().map(|(i, flag)| u8::from(*flag) << (2 + i));
    bits.fold(kind_number(body.kind()), |all, bit| all | bit)
}

pub(crate) fn kind_number(kind: BodyKind) -> u8 {
    match kind {
        BodyKind::Static => 0,
        BodyKind::Kinematic => 1,
        BodyKind::Dynamic => 2,
    }
}
