//! Ground of tile columns that is taken away on the left and added on the right, as a game does that
//! loads a long level piece by piece.

use crate::check::{Check, count, finite, index, positive, range};
use crate::host::Host;
use crate::random::Lcg;
use crate::shapes;
use core::f32::consts::TAU;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use tiny_physics::{DVec2, RigidBody, ShapeDef, Vec2};

/// A ground of columns of 1 m tiles, `columns_per_body` columns to a static body; the scene's first
/// `bodies` bodies are its pieces from left to right. Each step moves one piece from the left end to the
/// right end and asks `queries` random questions of the part that is there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Terrain {
    /// How many pieces there are at any time.
    pub bodies: u32,
    /// Columns of a piece.
    pub columns_per_body: u32,
    /// Left end of the ground at the start, metres.
    pub left: f64,
    /// Mean height, tiles.
    pub height: f32,
    /// Height of the hills over the mean, tiles.
    pub amplitude: f32,
    /// From one hill to the next, metres.
    pub period: f32,
    /// Rays and boxes a step.
    pub queries: u32,
}

impl Default for Terrain {
    fn default() -> Self {
        Self {
            bodies: 2400,
            columns_per_body: 10,
            left: -12_000.0,
            height: 12.0,
            amplitude: 4.0,
            period: 40.0,
            queries: 500,
        }
    }
}

/// A tile is a box of these half extents, rounded to 1 m.
const TILE_CORE: f32 = 0.4;
const TILE_RADIUS: f32 = 0.1;

/// Length of the rays and half size of the boxes of the queries, metres.
const RAY_LENGTH: f32 = 25.0;
const QUERY_HALF_SIZE: f32 = 5.0;

impl Terrain {
    pub(super) fn check(&self, bodies: usize) -> Check {
        count("bodies", self.bodies)?;
        index("bodies", self.bodies as usize - 1, bodies, "bodies")?;
        count("columns_per_body", self.columns_per_body)?;
        finite("left", self.left as f32)?;
        range("height", self.height, (0.0..=1000.0).contains(&self.height), "0 to 1000")?;
        range("amplitude", self.amplitude, self.amplitude.abs() <= 1000.0, "-1000 to 1000")?;
        positive("period", self.period)
    }

    /// The piece with this number, counted from the left end at the start.
    pub(crate) fn piece(&self, number: u32) -> RigidBody {
        let first = u64::from(number) * u64::from(self.columns_per_body);
        let tile = shapes::rounded_rect(TILE_CORE, TILE_CORE, TILE_RADIUS);
        let mut body = RigidBody::fixed().position(DVec2::new(self.left + first as f64, 0.0));
        for column in 0..self.columns_per_body {
            for row in 0..self.tiles_in_column(first + u64::from(column)) {
                let offset = Vec2::new(column as f32 + 0.5, row as f32 + 0.5);
                body.shapes.push(ShapeDef::new(tile).offset(offset));
            }
        }
        body
    }

    fn tiles_in_column(&self, column: u64) -> u32 {
        let phase = (column as f64 % f64::from(self.period)) as f32 / self.period;
        let hill = self.amplitude * tiny_physics::math::cos(TAU * phase);
        (self.height + hill.round()) as u32
    }

    pub(super) fn start(&self, bodies: &[usize]) -> Streaming {
        let pieces = bodies.iter().take(self.bodies as usize).copied().collect();
        Streaming { terrain: *self, pieces, next: self.bodies }
    }
}

/// Ground on the move.
#[derive(Clone, Debug)]
pub(crate) struct Streaming {
    terrain: Terrain,
    /// The host's numbers of the pieces, from left to right.
    pieces: VecDeque<usize>,
    /// Number of the piece that comes next.
    next: u32,
}

impl Streaming {
    pub(super) fn before_step(&mut self, host: &mut dyn Host, step: u32) {
        if let Some(leftmost) = self.pieces.pop_front() {
            host.remove_body(leftmost);
        }
        self.pieces.push_back(host.add_body(&self.terrain.piece(self.next)));
        self.next = self.next.saturating_add(1);
        self.ask(host, step);
    }

    /// Rays straight down and boxes, at places that depend only on the number of the step.
    fn ask(&self, host: &mut dyn Host, step: u32) {
        let width = f64::from(self.terrain.columns_per_body);
        let right = self.terrain.left + f64::from(self.next) * width;
        let left = right - self.pieces.len() as f64 * width;
        let lower = Vec2::new(left as f32, 0.0);
        let upper = Vec2::new(right as f32, RAY_LENGTH);
        let mut random = Lcg(1234_u32.wrapping_add(step.wrapping_mul(7919)));
        for _ in 0..self.terrain.queries {
            let point = random.point(lower, upper);
            host.ray_cast(point, Vec2::new(0.0, -RAY_LENGTH), u64::MAX);
            let half = Vec2::splat(QUERY_HALF_SIZE);
            host.count_overlaps(point - half, point + half, u64::MAX);
        }
    }
}
