//! A paddle that moves to and fro and many questions asked of the world in every step.

use crate::check::{Check, finite, index};
use crate::host::Host;
use crate::random::Lcg;
use serde::{Deserialize, Serialize};
use tiny_physics::Vec2;

/// Moves a kinematic body between two places and asks the same `count` random rays, circle casts and box
/// overlaps in every step, for all categories and again for category 1 alone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Queries {
    /// Index of the paddle in the scene.
    pub paddle: usize,
    /// Where the paddle turns to the right, metres.
    pub left: f32,
    /// Where the paddle turns to the left, metres.
    pub right: f32,
    /// Speed of the paddle, metres a second.
    pub speed: f32,
    /// Queries of each sort and filter, in a step.
    pub count: u32,
    /// Seed of the places that they start from and go to.
    pub seed: u32,
    /// The places lie between 0 and this, in x and in y, metres.
    pub size: f32,
}

/// Radius of the circles and half size of the boxes of the queries, metres.
const CAST_RADIUS: f32 = 0.1;
const OVERLAP_HALF_SIZE: f32 = 5.0;

impl Queries {
    pub(super) fn check(&self, bodies: usize) -> Check {
        index("paddle", self.paddle, bodies, "bodies")?;
        finite("left", self.left)?;
        finite("right", self.right)?;
        finite("speed", self.speed)?;
        finite("size", self.size)
    }

    pub(super) fn start(&self, bodies: &[usize]) -> Asking {
        let mut random = Lcg(self.seed);
        let corner = Vec2::splat(self.size);
        let mut point = || random.point(Vec2::ZERO, corner);
        let rays = (0..self.count).map(|_| (point(), point())).collect();
        Asking { queries: *self, paddle: bodies.get(self.paddle).copied(), rays }
    }
}

/// The questions, drawn once.
#[derive(Clone, Debug)]
pub(crate) struct Asking {
    queries: Queries,
    paddle: Option<usize>,
    /// Origin and target.
    rays: Vec<(Vec2, Vec2)>,
}

impl Asking {
    pub(super) fn before_step(&mut self, host: &mut dyn Host) {
        self.turn_paddle(host);
        for mask in [u64::MAX, 1] {
            for (origin, target) in &self.rays {
                let translation = *target - *origin;
                host.ray_cast(*origin, translation, mask);
                host.circle_cast(*origin, CAST_RADIUS, translation, mask);
                let half = Vec2::splat(OVERLAP_HALF_SIZE);
                host.count_overlaps(*origin - half, *origin + half, mask);
            }
        }
    }

    fn turn_paddle(&self, host: &mut dyn Host) {
        let Some(paddle) = self.paddle else { return };
        let x = host.position(paddle).x as f32;
        let speed = host.velocity(paddle).x;
        let turned = if x >= self.queries.right && speed > 0.0 {
            -self.queries.speed
        } else if x <= self.queries.left && speed <= 0.0 {
            self.queries.speed
        } else {
            return;
        };
        host.set_velocity(paddle, Vec2::new(turned, 0.0));
    }
}
