//! A run seen beforehand: where things go in it, and what it looks like.

use crate::args::WorldArgs;
use crate::failure::Outcome;
use crate::progress::Progress;
use crate::simulation::{Framing, Simulation, largest_side};
use core::ops::RangeInclusive;
use tiny_physics::{Aabb, BodyKind, DVec2, Vec2, World};
use tiny_physics_scenes::Scene;

/// What is known of a run before it is drawn.
pub struct Preview {
    /// The part of the world in which it takes place.
    pub framing: Framing,
    /// Some moments of it.
    pub moments: Vec<Moment>,
    /// Its end.
    pub end: Simulation,
}

/// A world at a moment, and where the middle of what moves is.
pub type Moment = (World, Option<DVec2>);

/// Steps between two looks at where things are.
const LOOK: u32 = 5;
/// A picture is wider than so many bodies side by side.
const BODIES_WIDE: f32 = 5.0;
/// Moments that are kept, and bodies in all of them together.
const MOMENTS: u32 = 6;
const BODIES: usize = 100_000;
/// Part of all that is seen which may fly away on each side, and how far a picture goes after it: a part of what the others
/// take up.
const AWAY: f32 = 0.02;
const AFTER: f32 = 0.25;
/// What is larger than this part of all that moves at the start is always in the picture: a drum, a rotor.
const LARGE: f32 = 0.25;
/// Room around what moves, as a part of it.
const ROOM: f32 = 0.06;
/// A run this many times wider than its start is followed instead of shown whole.
const FAR: f32 = 4.0;

impl Preview {
    /// Runs a scene and looks at it in these steps.
    ///
    /// # Errors
    /// The scene holds something that the engine refuses.
    pub fn of(scene: Scene, how: &WorldArgs, steps: RangeInclusive<u32>) -> Outcome<Self> {
        let (first, last) = (*steps.start(), *steps.end());
        let mut simulation = Simulation::new(scene, how)?;
        let (origin, start) = (simulation.some_position(), simulation.framing());
        let (mut seen, mut moments) = (Seen::default(), Vec::new());
        seen.large = LARGE * largest_side(&simulation.extents(origin).0);
        let count = MOMENTS.min((BODIES / simulation.world().body_count().max(1)) as u32);
        let between = (last.saturating_sub(first) / count.max(1)).max(1);
        let progress = Progress::new(last);
        for step in 0..=last {
            if step > 0 {
                simulation.step();
            }
            progress.at(step);
            if step >= first && (step - first).is_multiple_of(LOOK) {
                simulation.each_shape(origin, |kind, _, bounds| {
                    if kind != BodyKind::Static {
                        seen.add(&bounds);
                    }
                });
            }
            if step >= first && (step - first).is_multiple_of(between) {
                moments.push((simulation.world().clone(), simulation.middle_of_motion()));
            }
        }
        progress.finish();
        let whole = seen.most();
        let at_first = start.max.relative_to(start.min);
        let far = largest_side(&whole) > FAR * at_first.x.max(at_first.y);
        let start = if simulation.character().is_some() && first == last {
            simulation.framing()
        } else {
            start
        };
        let framing = match simulation.scene().view {
            None if far => {
                let room = at_first.x.max(at_first.y);
                let (below, above) = (Vec2::new(room, 0.2 * room), Vec2::new(room, 0.6 * room));
                Framing { min: start.min - below, max: start.max + above, goes_on: true }
            }
            None if whole.is_valid() && simulation.character().is_none() => {
                let side = largest_side(&whole);
                let room = (ROOM * side).max(0.5 * (BODIES_WIDE * seen.size() - side));
                let bounds = whole.grown(room);
                Framing { min: origin + bounds.min, max: origin + bounds.max, goes_on: false }
            }
            _ => start,
        };
        Ok(Self { framing, moments, end: simulation })
    }
}

/// Sides of all boxes that were seen.
#[derive(Default)]
struct Seen {
    lower: [Vec<f32>; 2],
    upper: [Vec<f32>; 2],
    sizes: f64,
    /// Size from which on something is never missed, and the box of all that is so large.
    large: f32,
    all_large: Option<Aabb>,
}

impl Seen {
    fn add(&mut self, bounds: &Aabb) {
        let size = largest_side(bounds);
        self.sizes += f64::from(size);
        if size > self.large && self.large > 0.0 {
            self.all_large = Some(self.all_large.map_or(*bounds, |all| all.union(bounds)));
        }
        for axis in 0..2 {
            self.lower[axis].push(bounds.min[axis]);
            self.upper[axis].push(bounds.max[axis]);
        }
    }

    /// Size of a shape in the mean.
    fn size(&self) -> f32 {
        (self.sizes / self.lower[0].len().max(1) as f64) as f32
    }

    /// The box of all but what is small and flies away.
    fn most(&mut self) -> Aabb {
        let [x, y] = [0, 1].map(|axis| side(&mut self.lower[axis], &mut self.upper[axis]));
        let corners = x.zip(y).map(|(x, y)| (Vec2::new(x.0, y.0), Vec2::new(x.1, y.1)));
        let most = corners.map_or(Aabb::EMPTY, |(min, max)| Aabb::new(min, max));
        self.all_large.map_or(most, |all| all.union(&most))
    }
}

/// Least and greatest of two lists, neither far from where almost all are.
fn side(lower: &mut [f32], upper: &mut [f32]) -> Option<(f32, f32)> {
    lower.sort_by(f32::total_cmp);
    upper.sort_by(f32::total_cmp);
    let few = (AWAY * lower.len() as f32) as usize;
    let (low, high) = (*lower.get(few)?, *upper.get(upper.len() - 1 - few)?);
    let after = AFTER * (high - low);
    Some((lower[0].max(low - after), upper[upper.len() - 1].min(high + after)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Follower;

    #[test]
    fn what_flies_away_does_not_make_the_picture_small() {
        let mut seen = Seen::default();
        for i in 0..1000 {
            let x = if i % 300 == 7 { 1.0e6 } else { (i % 10) as f32 };
            seen.add(&Aabb::from_center(Vec2::new(x, 0.0), Vec2::splat(0.5)));
        }
        assert_eq!(seen.most(), Aabb::new(Vec2::splat(-0.5), Vec2::new(12.0, 0.5)));
        assert!(!Seen::default().most().is_valid());
        // But for what is large.
        seen.large = 5.0;
        seen.add(&Aabb::from_center(Vec2::new(0.0, 40.0), Vec2::splat(3.0)));
        assert_eq!(seen.most().max.y, 43.0);
    }

    #[test]
    fn a_run_is_shown_whole_or_followed() {
        let how = WorldArgs { seed: 1, threads: 1, simd: None };
        let preview = |name: &str| {
            let scene = tiny_physics_scenes::find(name).unwrap().build(Default::default());
            Preview::of(scene, &how, 0..=300).unwrap()
        };
        // The ball swings through to the other side, which the start does not know.
        assert!(preview("wrecking_ball").framing.max.x > 9.0);
        let car = preview("car").framing;
        assert!(car.goes_on && car.max.relative_to(car.min).x < 60.0);
    }

    /// Where notes take more room than a picture has, the scene is in it all the same.
    #[test]
    fn small_pictures_show_the_scene() {
        let how = WorldArgs { seed: 1, threads: 1, simd: None };
        let scene = tiny_physics_scenes::find("seed_demo").unwrap().build(Default::default());
        let simulation = Simulation::new(scene, &how).unwrap();
        let framing = simulation.framing();
        for height in [64, 128, 139, 140, 720] {
            let camera = Follower::on(&simulation, &framing, (128, height), [61, 78]).camera;
            let half = 0.5 * f64::from(height as f32 / camera.scale);
            let (low, high) = (camera.center.y - half, camera.center.y + half);
            assert!(low < framing.max.y && high > framing.min.y, "{height}: {low} to {high}");
        }
    }
}
