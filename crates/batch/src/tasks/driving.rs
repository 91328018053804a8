//! Driving a car round a road, seen from above.

use super::common::{clamp, pixels, view_around};
use super::track::{HALF_WIDTH, Track, facing};
use crate::error::BatchError;
use crate::random::Random;
use crate::reading::joint_motion;
use crate::task::{Outcome, Spec, Task, View};
use serde::{Deserialize, Serialize};
use tiny_physics::{
    BodyId, Error, Filter, JointDef, JointId, Pose, RigidBody, ShapeDef, Vec2, World,
};

const DT: f32 = 1.0 / 50.0;
/// Metres a unit of the car's drawing; masses and forces go with its square.
const SIZE: f32 = 0.02;
const AREA: f32 = SIZE * SIZE;
const ENGINE_POWER: f32 = 1.0e8 * AREA;
const WHEEL_INERTIA: f32 = 4000.0 * AREA;
/// Newtons a wheel can pass on to the road; 0.6 of it on grass.
const GRIP: f32 = 1.0e6 * AREA;
const GRASS_GRIP: f32 = 0.6;
/// Newtons for each metre a second that a wheel slips.
const SLIP_FORCE: f32 = 205_000.0 * AREA;
const STEERING_TORQUE: f32 = 180.0 * 900.0 * AREA;
/// Radians a second that a full brake takes off a wheel in a step.
const BRAKE: f32 = 15.0;
const WHEEL_RADIUS: f32 = 27.0 * SIZE;
const WHEELS: [(f32, f32); 4] = [(-55.0, 80.0), (55.0, 80.0), (-55.0, -82.0), (55.0, -82.0)];
const HULLS: [&[(i16, i16)]; 4] = [
    &[(-60, 130), (60, 130), (60, 110), (-60, 110)],
    &[(-15, 120), (15, 120), (20, 20), (-20, 20)],
    &[(25, 20), (50, -10), (50, -40), (20, -90), (-20, -90), (-50, -40), (-50, -10), (-25, 20)],
    &[(-50, -120), (50, -120), (50, -90), (-50, -90)],
];
const TYRE: [(i16, i16); 4] = [(-14, 27), (14, 27), (14, -27), (-14, -27)];
/// Nothing of a car meets anything.
const ALONE: Filter = Filter { category: 2, mask: 0, group: 0 };
/// Metres from the middle, each way, that the field ends at.
const FIELD: f32 = 2000.0 / 6.0;
/// Part of the tiles that make a lap.
const LAP: f32 = 0.95;
/// Tiles ahead that are seen, and how many lie between two of them.
const AHEAD: usize = 12;
const STRIDE: usize = 2;

/// Driving a car round a road, seen from above: the car and the reward of Gymnasium's `CarRacing-v3`, on roads of
/// our own, and with numbers in place of pictures.
///
/// An observation is speed forwards and to the side, turning, steering angle, spin of the four wheels, whether
/// each is on the road, how far off the middle and how far askew the car is, and 12 places of the road ahead
/// in the car's frame. An action is steering (-1 left to 1 right), gas and brake (below 0 is 0).
#[derive(Clone, Debug)]
pub struct Driving {
    template: World,
    hull: BodyId,
    wheels: [(BodyId, JointId); 4],
}

/// An episode of [`Driving`].
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Episode {
    track: Track,
    visited: Vec<bool>,
    count: u32,
    /// The tile nearest to each wheel.
    nearest: [usize; 4],
    gas: f32,
    spins: [f32; 4],
    on_road: [bool; 4],
}

impl Driving {
    /// The task.
    ///
    /// # Errors
    /// None that is known; the engine's.
    pub fn new() -> Result<Self, BatchError> {
        let mut template = World::new(Vec2::ZERO);
        let mut hull = RigidBody::dynamic();
        for points in HULLS {
            hull = hull.shape(pixels(points, 1.0 / SIZE)?.filter(ALONE));
        }
        let hull = template.add_body(hull.can_sleep(false))?;
        let mut wheels = Vec::new();
        for (x, y) in WHEELS {
            wheels.push(add_wheel(&mut template, hull, Vec2::new(x, y) * SIZE)?);
        }
        let wheels = wheels.try_into().map_err(|_| Error::Unsupported { reason: "four wheels" })?;
        Ok(Self { template, hull, wheels })
    }

    /// Turns the front wheels towards an angle at up to 3 radians a second.
    fn steer(&self, world: &mut World, angle: f32) -> Result<(), Error> {
        for &(_, joint) in &self.wheels[..2] {
            let todo = angle - joint_motion(world, joint)?.0;
            crate::actuator::set_motor(world, joint, |motor| {
                motor.speed = clamp(50.0 * todo, -3.0, 3.0);
            })?;
        }
        Ok(())
    }

    /// Engine, brake and grip of one wheel.
    fn roll(&self, world: &mut World, episode: &mut Episode, i: usize, brake: f32) {
        let Some(mut wheel) = world.body_mut(self.wheels[i].0) else { return };
        let (turn, velocity) = (wheel.as_ref().rotation(), wheel.as_ref().velocity());
        let (ahead, right) = (turn.y_axis(), turn.x_axis());
        let spin = &mut episode.spins[i];
        if i >= 2 {
            *spin += DT * ENGINE_POWER * episode.gas / WHEEL_INERTIA / (spin.abs() + 5.0);
        }
        *spin = braked(*spin, brake);
        let slip = Vec2::new(-right.dot(velocity), *spin * WHEEL_RADIUS - ahead.dot(velocity));
        let grip = if episode.on_road[i] { GRIP } else { GRIP * GRASS_GRIP };
        let (way, size) = (slip * SLIP_FORCE).direction_and_length();
        let force = way * clamp(size, 0.0, grip);
        *spin -= DT * force.y * WHEEL_RADIUS / WHEEL_INERTIA;
        wheel.apply_force_to_center(right * force.x + ahead * force.y);
    }

    /// Notes where the wheels are; gives the number of tiles that are new.
    fn visit(&self, world: &World, episode: &mut Episode) -> u32 {
        let mut fresh = 0;
        for (i, (wheel, _)) in self.wheels.iter().enumerate() {
            let place = world.body(*wheel).map_or(Vec2::ZERO, |wheel| wheel.position());
            let tile = episode.track.nearest(place, episode.nearest[i]);
            episode.nearest[i] = tile;
            let away = (place - episode.track.tile(tile)).length();
            episode.on_road[i] = away <= HALF_WIDTH;
            if episode.on_road[i] && !episode.visited[tile] {
                episode.visited[tile] = true;
                fresh += 1;
            }
        }
        episode.count += fresh;
        fresh
    }

    fn outcome(&self, world: &World, episode: &Episode, fresh: u32) -> Outcome {
        let place = world.body(self.hull).map_or(Vec2::ZERO, |hull| hull.position()).abs();
        if place.x > FIELD || place.y > FIELD {
            return Outcome { reward: -100.0, terminated: true };
        }
        let tiles = episode.track.len() as f32;
        let round = episode.count as f32 > LAP * tiles && episode.nearest.contains(&0);
        let all = episode.count as usize == episode.track.len();
        Outcome { reward: 1000.0 / tiles * fresh as f32 - 0.1, terminated: round || all }
    }
}

impl Task for Driving {
    type Episode = Episode;

    fn title(&self) -> String {
        "driving".into()
    }

    fn spec(&self) -> Spec {
        let observation = 14 + 2 * AHEAD;
        Spec { observation, action: 3, choices: None, time_limit: 1000, dt: DT }
    }

    fn names(&self) -> Vec<String> {
        let mut names: Vec<String> =
            ["forwards", "sidewards", "turning", "steering"].map(String::from).to_vec();
        names.extend((0..4).map(|i| format!("spin {i}")));
        names.extend((0..4).map(|i| format!("on road {i}")));
        names.extend(["off the middle", "askew"].map(String::from));
        names.extend((0..AHEAD).flat_map(|i| [format!("ahead x {i}"), format!("ahead y {i}")]));
        names
    }

    fn template(&self) -> &World {
        &self.template
    }

    fn reset(&self, world: &mut World, random: &mut Random) -> Result<Episode, BatchError> {
        world.clone_from(&self.template);
        let track = Track::new(random);
        let start = Pose::new(track.tile(0).into(), facing(track.way(0)));
        for body in [self.hull].into_iter().chain(self.wheels.map(|(wheel, _)| wheel)) {
            if let Some(mut body) = world.body_mut(body) {
                let now = body.as_ref().pose();
                let pose = Pose::new(start.apply(now.p.to_vec2()), start.q.compose(now.q));
                body.set_pose(pose);
            }
        }
        let visited = vec![false; track.len()];
        let mut episode = Episode { track, visited, ..Episode::default() };
        self.visit(world, &mut episode);
        self.step(world, &mut episode, random, &[0.0; 3])?;
        Ok(episode)
    }

    fn step(
        &self,
        world: &mut World,
        episode: &mut Episode,
        _: &mut Random,
        action: &[f32],
    ) -> Result<Outcome, BatchError> {
        self.steer(world, -clamp(action[0], -1.0, 1.0))?;
        let wish = clamp(action[1], 0.0, 1.0) - episode.gas;
        episode.gas += if wish > 0.1 { 0.1 } else { wish };
        let brake = clamp(action[2], 0.0, 1.0);
        (0..4).for_each(|i| self.roll(world, episode, i, brake));
        world.try_step(DT)?;
        let fresh = self.visit(world, episode);
        Ok(self.outcome(world, episode, fresh))
    }

    fn observe(&self, world: &World, episode: &Episode, out: &mut [f32]) {
        let Some(hull) = world.body(self.hull) else { return };
        let (pose, velocity) = (hull.pose(), hull.rotation().unrotate(hull.velocity()));
        let tile = episode.track.nearest(pose.p.to_vec2(), episode.nearest[0]);
        let steering = joint_motion(world, self.wheels[0].1).map_or(0.0, |motion| motion.0);
        out[0] = velocity.y / 50.0;
        out[1] = velocity.x / 50.0;
        out[2] = hull.angular_velocity() / 5.0;
        out[3] = steering / 0.4;
        for i in 0..4 {
            out[4 + i] = episode.spins[i] / 100.0;
            out[8 + i] = f32::from(u8::from(episode.on_road[i]));
        }
        out[12] = episode.track.aside(pose.p.to_vec2(), tile) / HALF_WIDTH;
        out[13] = facing(episode.track.way(tile)).angle_from(pose.q);
        for (i, out) in out[14..].chunks_mut(2).enumerate() {
            let place = pose.unapply(episode.track.tile(tile + (i + 1) * STRIDE).into());
            out.copy_from_slice(&[place.x / 50.0, place.y / 50.0]);
        }
    }

    fn view(&self, world: &World, _: &Episode) -> View {
        let place = world.body(self.hull).map_or(Vec2::ZERO, |hull| hull.position());
        view_around(place.into(), 60.0, 40.0)
    }
}

/// A wheel's spin after a step of braking.
fn braked(spin: f32, brake: f32) -> f32 {
    let less = clamp(BRAKE * brake, 0.0, spin.abs());
    if brake >= 0.9 || spin == 0.0 { 0.0 } else { spin - less * spin.signum() }
}

fn add_wheel(world: &mut World, hull: BodyId, place: Vec2) -> Result<(BodyId, JointId), Error> {
    let tyre: ShapeDef = pixels(&TYRE, 1.0 / SIZE)?.density(0.1).filter(ALONE);
    let wheel = RigidBody::dynamic().position(place).shape(tyre).can_sleep(false);
    let wheel = world.add_body(wheel)?;
    let joint = JointDef::revolute().anchors(place, Vec2::ZERO);
    let joint = joint.motor(0.0, STEERING_TORQUE).limits(-0.4, 0.4);
    let joint = world.add_joint(hull, wheel, joint)?;
    Ok((wheel, joint))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task_batch::{Autoreset, TaskBatch, Tasks};

    /// Steers at the road a few tiles ahead, slower where it bends.
    fn driver(seen: &[f32]) -> [f32; 3] {
        let (x, y) = (seen[14 + 6], seen[14 + 7]);
        let bend = x / (x * x + y * y).sqrt();
        let far = seen[14 + 14] / (seen[14 + 14].abs() + seen[14 + 15].abs() + 1e-3);
        let wish = 0.9 - 1.2 * far.abs().min(0.5);
        let gas = if seen[0] < wish { 0.4 } else { 0.0 };
        [clamp(3.0 * bend, -1.0, 1.0), gas, if seen[0] > wish + 0.1 { 0.3 } else { 0.0 }]
    }

    #[test]
    fn a_driver_gets_round() {
        let mut batch = TaskBatch::new(Driving::new().unwrap(), 8, 1, Autoreset::SameStep).unwrap();
        let width = batch.spec().observation;
        let (mut score, mut laps) = ([0.0; 8], 0);
        for _ in 0..1000 {
            let actions: Vec<f32> = batch.observations().chunks(width).flat_map(driver).collect();
            batch.step(&actions).unwrap();
            for (i, score) in score.iter_mut().enumerate() {
                let (outcome, _) = batch.outcome(i).unwrap();
                *score += outcome.reward;
                laps += usize::from(outcome.terminated && outcome.reward > -100.0);
            }
        }
        assert!(score.iter().sum::<f32>() / 8.0 > 600.0, "{score:?}, {laps} laps");
    }

    #[test]
    fn who_leaves_the_field_is_fined() {
        let mut batch = TaskBatch::new(Driving::new().unwrap(), 1, 1, Autoreset::SameStep).unwrap();
        for _ in 0..1000 {
            batch.step(&[0.0, 0.05, 0.0]).unwrap();
            if batch.outcome(0).unwrap().0.terminated {
                assert_eq!(batch.outcome(0).unwrap().0.reward, -100.0);
                return;
            }
        }
        panic!("straight on for 20 s and still there");
    }
}
