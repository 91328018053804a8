//! The way of the walker: uneven ground, and in the hard version stumps, stairs and pits.

use crate::random::Random;
use tiny_physics::Vec2;

/// Metres between two corners of the ground.
pub(super) const STEP: f32 = 14.0 / 30.0;
/// Corners of the ground.
pub(super) const LENGTH: usize = 200;
/// Metres; where the ground starts and what it comes back to.
pub(super) const LEVEL: f32 = 400.0 / 30.0 / 4.0;
/// Corners that are flat at the start.
pub(super) const START: usize = 20;
/// Corners of grass between two obstacles, and before the goal.
pub(super) const GRASS: usize = 10;

/// Ground as heights of its corners, [`STEP`] apart, and convex blocks that stand on it or in it.
#[derive(Debug, Default)]
pub(super) struct Terrain {
    pub(super) heights: Vec<f32>,
    pub(super) blocks: Vec<[Vec2; 4]>,
    slope: f32,
}

impl Terrain {
    /// A way of [`LENGTH`] corners.
    pub(super) fn new(random: &mut Random, obstacles: bool) -> Self {
        let mut way = Self::default();
        way.grass(random, START);
        while way.heights.len() < LENGTH {
            if obstacles {
                match random.whole(0, 3) {
                    0 => way.stump(random.whole(1, 3) as usize),
                    1 => way.stairs(random),
                    _ => way.pit(random.whole(3, 5) as usize),
                }
            }
            way.hold(1, way.height());
            let length = random.whole(GRASS as i64 / 2, GRASS as i64) as usize - 1;
            way.grass(random, length);
        }
        way.heights.truncate(LENGTH);
        way.blocks.retain(|block| block[1].x <= (LENGTH - 1) as f32 * STEP);
        way
    }

    /// The corners from right to left, so that above is outside of their chain.
    pub(super) fn corners(&self) -> Vec<Vec2> {
        let corner = |(i, &y): (usize, &f32)| Vec2::new(i as f32 * STEP, y);
        self.heights.iter().enumerate().map(corner).rev().collect()
    }

    fn height(&self) -> f32 {
        self.heights.last().copied().unwrap_or(LEVEL)
    }

    /// Where the next corner is.
    fn x(&self) -> f32 {
        self.heights.len() as f32 * STEP
    }

    /// Corners whose slope wanders and is drawn back to the level.
    fn grass(&mut self, random: &mut Random, corners: usize) {
        for _ in 0..corners {
            let away = LEVEL - self.height();
            let pull = if away == 0.0 { 0.0 } else { away.signum() };
            self.slope = 0.8 * self.slope + 0.01 * pull;
            if self.heights.len() > START {
                self.slope += random.uniform(-1.0, 1.0) / 30.0;
            }
            self.heights.push(self.height() + self.slope);
        }
    }

    fn hold(&mut self, corners: usize, height: f32) {
        self.heights.extend(core::iter::repeat_n(height, corners));
    }

    /// A block by its lower left corner and size, in steps.
    fn block(&mut self, corner: Vec2, width: f32, height: f32) {
        let (right, top) = (Vec2::new(width * STEP, 0.0), Vec2::new(0.0, height * STEP));
        self.blocks.push([corner, corner + right, corner + right + top, corner + top]);
    }

    /// A square block to step over, one or two steps wide.
    fn stump(&mut self, size: usize) {
        let corner = Vec2::new(self.x(), self.height());
        self.block(corner, size as f32, size as f32);
        self.hold(size, corner.y);
    }

    /// A hole four steps deep between two walls.
    fn pit(&mut self, width: usize) {
        let (x, y) = (self.x(), self.height());
        for wall in [0.0, width as f32] {
            self.block(Vec2::new(x + wall * STEP, y - 4.0 * STEP), 1.0, 4.0);
        }
        self.hold(1, y);
        self.hold(width, y - 4.0 * STEP);
        self.hold(1, y);
    }

    /// Three or four stairs up or down, each four steps wide and one high; the ground runs inside of them.
    fn stairs(&mut self, random: &mut Random) {
        const WIDTH: usize = 4;
        let rise = if random.whole(0, 2) == 0 { 1.0 } else { -1.0 };
        let count = random.whole(3, 5) as usize;
        let corner = Vec2::new(self.x(), self.height());
        for stair in 0..count {
            let place = Vec2::new((stair * WIDTH) as f32, stair as f32 * rise - 1.0) * STEP;
            self.block(corner + place, WIDTH as f32, 1.0);
        }
        self.hold(1, corner.y);
        for k in 1..count * WIDTH {
            let stairs = (k as f32 - rise) / WIDTH as f32;
            self.hold(1, corner.y + stairs * rise * STEP);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_have_their_length_and_no_cliffs() {
        for seed in 0..50 {
            let way = Terrain::new(&mut Random::new(seed), false);
            assert_eq!(way.heights.len(), LENGTH);
            assert!(way.blocks.is_empty());
            assert!(way.heights.windows(2).all(|w| (w[1] - w[0]).abs() < 0.3));
            assert!(way.heights[..START].iter().all(|&y| y == LEVEL));
        }
    }

    #[test]
    fn hard_ways_have_obstacles_that_stand_on_the_ground() {
        for seed in 0..50 {
            let way = Terrain::new(&mut Random::new(seed), true);
            assert!(way.blocks.len() > 8, "{}", way.blocks.len());
            for block in &way.blocks {
                let column = ((block[0].x / STEP + 0.5) as usize).min(LENGTH - 1);
                let (bottom, top) = (block[0].y, block[2].y);
                let ground = way.heights[column];
                assert!(
                    bottom <= ground + 1e-3 && top >= ground - STEP - 1e-3,
                    "{block:?} {ground}"
                );
            }
        }
    }
}
