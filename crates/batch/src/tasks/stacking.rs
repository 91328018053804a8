//! Stacking boxes with a crane.

use super::common::{clamp, view_around};
use crate::error::BatchError;
use crate::random::Random;
use crate::task::{Outcome, Spec, Task, View};
use serde::{Deserialize, Serialize};
use tiny_physics::{BodyId, BodyKind, DVec2, QueryFilter, RigidBody, Shape, ShapeDef, Vec2, World};

const DT: f32 = 1.0 / 30.0;
const BOXES: usize = 8;
/// Half of the platform, metres; its top is at height 0.
const PLATFORM: Vec2 = Vec2::new(1.0, 0.25);
/// Metres a second and radians a second of the crane.
const SPEED: f32 = 2.0;
const TURN: f32 = 2.0;
/// Metres each way that the crane can go.
const REACH: f32 = 3.0;
/// Metres between the top of the tower and the middle of the box that hangs.
const HANG: f32 = 1.2;
/// Below this a box has fallen off, metres.
const LOST: f32 = -1.0;
/// Steps that a box has to come to rest.
const PATIENCE: u32 = 60;
/// Metres a second and radians a second.
const RESTING: f32 = 0.05;
/// Rays down from around the crane, and metres between them.
const RAYS: usize = 9;
const RAY_GAP: f32 = 0.25;
const RAY_LENGTH: f32 = 10.0;

/// Stacking eight boxes of random sizes with a crane, as high as they hold.
///
/// An observation is where the crane is and its box's angle and size, how many boxes are left, whether one is
/// on its way, where the last box is from the crane and how it moves, and nine ranges downwards. An action is
/// the crane's speed, the box's turning, and above 0: let go. The reward is how much higher the tower is once
/// a box has come to rest, in metres; -1 and the end where a box falls off.
#[derive(Clone, Debug)]
pub struct Stacking {
    template: World,
}

/// An episode of [`Stacking`].
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Episode {
    boxes: Vec<BodyId>,
    /// Half extents of the last box.
    half: [f32; 2],
    crane: [f32; 2],
    /// Steps since the last box was let go; `None`: it hangs.
    falling: Option<u32>,
    height: f32,
}

impl Stacking {
    /// The task.
    ///
    /// # Errors
    /// None that is known; the engine's.
    pub fn new() -> Result<Self, BatchError> {
        let mut template = World::new(Vec2::new(0.0, -9.8));
        let platform = ShapeDef::new(Shape::rect(PLATFORM.x, PLATFORM.y)?);
        let place = Vec2::new(0.0, -PLATFORM.y);
        template.add_body(RigidBody::fixed().position(place).shape(platform))?;
        Ok(Self { template })
    }

    /// Hangs the next box on the crane.
    fn hang(
        &self,
        world: &mut World,
        episode: &mut Episode,
        random: &mut Random,
    ) -> Result<(), BatchError> {
        let half = Vec2::new(random.uniform(0.2, 0.5), random.uniform(0.15, 0.35));
        episode.crane = [random.uniform(-REACH, REACH), episode.height + HANG];
        let body = RigidBody::kinematic()
            .position(Vec2::from(episode.crane))
            .angle(random.uniform(-1.0, 1.0))
            .can_sleep(false)
            .shape(ShapeDef::new(Shape::rect(half.x, half.y)?).friction(0.6));
        episode.boxes.push(world.add_body(body)?);
        episode.half = half.into();
        episode.falling = None;
        Ok(())
    }

    /// Moves the crane, and lets its box go.
    fn move_crane(&self, world: &mut World, episode: &mut Episode, action: &[f32]) {
        let Some(&last) = episode.boxes.last() else { return };
        let Some(mut held) = world.body_mut(last) else { return };
        if episode.falling.is_some() {
            return;
        }
        let x = held.as_ref().position().x;
        let wish = SPEED * clamp(action[0], -1.0, 1.0);
        let speed = clamp(wish, (-REACH - x) / DT, (REACH - x) / DT);
        held.set_velocity(Vec2::new(speed, 0.0));
        held.set_angular_velocity(TURN * clamp(action[1], -1.0, 1.0));
        episode.crane[0] = x + speed * DT;
        if action[2] > 0.0 {
            held.set_kind(BodyKind::Dynamic);
            held.set_velocity(Vec2::ZERO);
            held.set_angular_velocity(0.0);
            episode.falling = Some(0);
        }
    }

    /// The top of the tower, metres.
    fn height(&self, world: &World, boxes: &[BodyId]) -> f32 {
        let top = |id: &BodyId| {
            let body = world.body(*id)?;
            let shape = world.shape(body.shapes().next()?)?;
            let Shape::Polygon(polygon) = shape.shape() else { return None };
            let heights = polygon.vertices().iter().map(|&corner| body.rotation().rotate(corner).y);
            let above = heights.fold(0.0, |highest, y| if y > highest { y } else { highest });
            Some(body.position().y + above)
        };
        boxes.iter().filter_map(top).fold(0.0, |highest, y| if y > highest { y } else { highest })
    }
}

impl Task for Stacking {
    type Episode = Episode;

    fn title(&self) -> String {
        "stacking".into()
    }

    fn spec(&self) -> Spec {
        Spec { observation: 12 + RAYS, action: 3, choices: None, time_limit: 900, dt: DT }
    }

    fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = [
            "crane x",
            "sine",
            "cosine",
            "half width",
            "half height",
            "boxes left",
            "on its way",
            "box x",
            "box y",
            "box vx",
            "box vy",
            "box turning",
        ]
        .map(String::from)
        .to_vec();
        names.extend((0..RAYS).map(|i| format!("range {i}")));
        names
    }

    fn template(&self) -> &World {
        &self.template
    }

    fn reset(&self, world: &mut World, random: &mut Random) -> Result<Episode, BatchError> {
        world.clone_from(&self.template);
        let mut episode = Episode::default();
        self.hang(world, &mut episode, random)?;
        Ok(episode)
    }

    fn step(
        &self,
        world: &mut World,
        episode: &mut Episode,
        random: &mut Random,
        action: &[f32],
    ) -> Result<Outcome, BatchError> {
        self.move_crane(world, episode, action);
        world.try_step(DT)?;
        let place = |id: &BodyId| world.body(*id).map_or(0.0, |body| body.position().y);
        if episode.boxes.iter().any(|id| place(id) < LOST) {
            return Ok(Outcome { reward: -1.0, terminated: true });
        }
        let Some(steps) = &mut episode.falling else { return Ok(Outcome::default()) };
        *steps += 1;
        let rests = |id: &BodyId| {
            world.body(*id).is_some_and(|body| {
                body.velocity().length() < RESTING && body.angular_velocity().abs() < RESTING
            })
        };
        if *steps < 10 || (*steps < PATIENCE && !episode.boxes.iter().all(rests)) {
            return Ok(Outcome::default());
        }
        let height = self.height(world, &episode.boxes);
        let reward = height - episode.height;
        episode.height = height;
        let terminated = episode.boxes.len() == BOXES;
        if !terminated {
            self.hang(world, episode, random)?;
        }
        Ok(Outcome { reward, terminated })
    }

    fn observe(&self, world: &World, episode: &Episode, out: &mut [f32]) {
        let last = episode.boxes.last().and_then(|&id| world.body(id));
        let Some(last) = last else { return };
        let crane = Vec2::from(episode.crane);
        let (away, velocity, turn) = (last.position() - crane, last.velocity(), last.rotation());
        let left = (BOXES - episode.boxes.len()) as f32 / BOXES as f32;
        let falling = f32::from(u8::from(episode.falling.is_some()));
        let [half_width, half_height] = episode.half;
        out[..7].copy_from_slice(&[
            crane.x,
            turn.s,
            turn.c,
            half_width,
            half_height,
            left,
            falling,
        ]);
        let spin = last.angular_velocity();
        out[7..12].copy_from_slice(&[away.x, away.y, velocity.x, velocity.y, spin]);
        let filter = QueryFilter::new().exclude(last.id());
        for (i, range) in out[12..].iter_mut().enumerate() {
            let aside = (i as f32 - (RAYS / 2) as f32) * RAY_GAP;
            let from = crane + Vec2::new(aside, 0.0);
            let hit = world.ray_cast(from, Vec2::new(0.0, -RAY_LENGTH), &filter);
            *range = hit.map_or(1.0, |hit| hit.fraction);
        }
    }

    fn view(&self, _: &World, episode: &Episode) -> View {
        let middle = 0.5 * (episode.height + HANG);
        view_around(DVec2::new(0.0, middle.into()), 7.5, episode.height + HANG + 3.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task_batch::{Autoreset, TaskBatch, Tasks};

    #[test]
    fn a_careful_crane_builds_a_tower_and_a_careless_one_loses_its_boxes() {
        let task = Stacking::new().unwrap();
        let mut batch = TaskBatch::new(task, 6, 1, Autoreset::SameStep).unwrap();
        let width = batch.spec().observation;
        let (mut best, mut score) = (0.0f32, [0.0f32; 6]);
        for _ in 0..1200 {
            let careful = |seen: &[f32]| {
                let (x, sine) = (seen[0], seen[1]);
                let ready = x.abs() < 0.02 && sine.abs() < 0.02;
                [-8.0 * x, -8.0 * sine * seen[2].signum(), if ready { 1.0 } else { -1.0 }]
            };
            let actions: Vec<f32> = batch.observations().chunks(width).flat_map(careful).collect();
            batch.step(&actions).unwrap();
            for (i, score) in score.iter_mut().enumerate() {
                let (outcome, truncated) = batch.outcome(i).unwrap();
                *score += outcome.reward;
                best = best.max(*score);
                *score = if outcome.terminated || truncated { 0.0 } else { *score };
            }
        }
        assert!(best > 1.8, "{best}");

        let mut losses = 0;
        for _ in 0..300 {
            batch.step(&[1.0, 0.0, 1.0].repeat(6)).unwrap();
            losses += (0..6).filter(|&i| batch.outcome(i).unwrap().0.reward == -1.0).count();
        }
        assert!(losses > 6, "{losses}");
    }
}
