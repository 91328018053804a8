//! A closed road, another for every episode.

use crate::random::Random;
use serde::{Deserialize, Serialize};
use tiny_physics::math::{cos, sin};
use tiny_physics::{Rot, Vec2};

/// Metres from one tile to the next.
const SPACING: f32 = 3.5;
/// Metres; the road lies between a third and one and a half of this from the middle.
const RADIUS: f32 = 150.0;
/// Corners that the road is drawn through.
const CORNERS: usize = 12;
/// Metres from the middle of the road to its edge.
pub(super) const HALF_WIDTH: f32 = 40.0 / 6.0;
/// Tiles before and behind the last known one in which a place is looked for.
const WINDOW: usize = 8;

/// The middle of a road: places about [`SPACING`] apart, the last next to the first, anticlockwise.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Track(Vec<[f32; 2]>);

impl Track {
    /// A road through corners at random distances from the middle, rounded by a closed spline (E. Catmull and
    /// R. Rom, *A class of local interpolating splines*, 1974).
    pub(super) fn new(random: &mut Random) -> Self {
        let corner = |k: usize| {
            let angle =
                core::f32::consts::TAU * (k as f32 + random.uniform(0.0, 0.7)) / CORNERS as f32;
            Vec2::new(cos(angle), sin(angle)) * random.uniform(RADIUS / 2.0, RADIUS)
        };
        let corners: Vec<Vec2> = (0..CORNERS).map(corner).collect();
        let mut tiles = vec![corners[0]];
        for k in 0..CORNERS {
            let near = [k + CORNERS - 1, k, k + 1, k + 2].map(|i| corners[i % CORNERS]);
            for i in 1..=256 {
                let point = spline(near, i as f32 / 256.0);
                if point.distance(tiles[tiles.len() - 1]) >= SPACING {
                    tiles.push(point);
                }
            }
        }
        if tiles[tiles.len() - 1].distance(tiles[0]) < 0.5 * SPACING {
            tiles.pop();
        }
        Self(tiles.into_iter().map(<[f32; 2]>::from).collect())
    }

    /// Tiles of the road.
    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    /// The middle of a tile; indices go round.
    pub(super) fn tile(&self, index: usize) -> Vec2 {
        self.0.get(index % self.len().max(1)).map_or(Vec2::ZERO, |&tile| tile.into())
    }

    /// The way on from a tile, a unit vector.
    pub(super) fn way(&self, index: usize) -> Vec2 {
        (self.tile(index + 1) - self.tile(index)).normalized()
    }

    /// The tile nearest to a place, looked for around the last known one.
    pub(super) fn nearest(&self, place: Vec2, last: usize) -> usize {
        let count = self.len();
        let around = (0..=2 * WINDOW).map(|i| (last + count + i - WINDOW) % count);
        let away = |tile: usize| (self.tile(tile) - place).length_sq();
        around.fold(last, |best, tile| if away(tile) < away(best) { tile } else { best })
    }

    /// How far left of the middle a place is, metres, by its nearest tile.
    pub(super) fn aside(&self, place: Vec2, tile: usize) -> f32 {
        self.way(tile).cross(place - self.tile(tile))
    }
}

/// A point of the spline from the second to the third of four points.
fn spline([a, b, c, d]: [Vec2; 4], t: f32) -> Vec2 {
    let (t2, t3) = (t * t, t * t * t);
    let sum = b * 2.0
        + (c - a) * t
        + (a * 2.0 - b * 5.0 + c * 4.0 - d) * t2
        + (b * 3.0 - a - c * 3.0 + d) * t3;
    sum * 0.5
}

/// The turn from the y axis to a direction.
pub(super) fn facing(way: Vec2) -> Rot {
    Rot { c: way.y, s: -way.x }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tracks_close_and_have_even_tiles() {
        for seed in 0..100 {
            let track = Track::new(&mut Random::new(seed));
            assert!((100..600).contains(&track.len()), "{}", track.len());
            for i in 0..track.len() {
                let gap = (track.tile(i + 1) - track.tile(i)).length();
                assert!(gap > 0.4 * SPACING && gap < 1.8 * SPACING, "{seed} {i}: {gap}");
                assert_eq!(track.nearest(track.tile(i), (i + 5) % track.len()), i);
            }
        }
    }
}
