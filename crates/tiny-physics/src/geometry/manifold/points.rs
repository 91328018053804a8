//! A manifold: where two shapes touch.

use super::lane::{ABSENT, LaneManifold};
use crate::math::{Transform, Vec2};

/// Where two shapes touch: a normal and up to two points, all in the frame of shape A.
///
/// [`Manifold::points()`] is the slice of those that are there; what lies beyond is zero.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Manifold {
    /// Unit, from A to B; zero where there are no points.
    pub normal: Vec2,
    /// How many of `points` are there: 0, 1 or 2.
    pub count: u8,
    /// The points, in no order of depth.
    pub points: [ManifoldPoint; 2],
}

/// One point of a [`Manifold`].
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct ManifoldPoint {
    /// Midway between the two surfaces, metres in the frame of shape A.
    pub point: Vec2,
    /// Distance of the surfaces along the normal, metres; negative is overlap.
    pub separation: f32,
    /// Names the features that face each other: the same from step to step while they do.
    pub id: u16,
}

impl Manifold {
    /// The shapes are further apart than was asked for.
    pub const EMPTY: Self = Self {
        normal: Vec2::ZERO,
        points: [ManifoldPoint { point: Vec2::ZERO, separation: 0.0, id: 0 }; 2],
        count: 0,
    };

    /// The points that are there.
    #[inline]
    pub fn points(&self) -> &[ManifoldPoint] {
        &self.points[..usize::from(self.count).min(2)]
    }

    /// The point with the least separation; the first of two equal ones.
    pub fn deepest(&self) -> Option<&ManifoldPoint> {
        match self.points() {
            [] => None,
            [first, second] if second.separation < first.separation => Some(second),
            [first, ..] => Some(first),
        }
    }

    /// Adds a point; a third one is dropped.
    pub(super) fn push(&mut self, point: ManifoldPoint) {
        if let Some(slot) = self.points.get_mut(usize::from(self.count)) {
            *slot = point;
            self.count += 1;
        }
    }

    /// The manifold of the pair the other way round: from B's frame into A's, and the normal turned.
    pub(super) fn swapped(mut self, b_in_a: Transform) -> Self {
        self.normal = -b_in_a.q.rotate(self.normal);
        for point in &mut self.points[..usize::from(self.count)] {
            point.point = b_in_a.apply(point.point);
        }
        self
    }

    /// From the frame of a rounded box into that of its shape.
    pub(super) fn moved(mut self, frame: Transform) -> Self {
        self.normal = frame.q.rotate(self.normal);
        for point in &mut self.points[..usize::from(self.count)] {
            point.point = frame.apply(point.point);
        }
        self
    }
}

impl From<LaneManifold<f32>> for Manifold {
    fn from(lane: LaneManifold<f32>) -> Self {
        let mut manifold = Self::EMPTY;
        for i in 0..2 {
            if lane.separation[i] < ABSENT {
                manifold.normal = Vec2::from(lane.normal);
                manifold.push(ManifoldPoint {
                    point: Vec2::from(lane.points[i]),
                    separation: lane.separation[i],
                    id: lane.id[i] as u16,
                });
            }
        }
        manifold
    }
}
