//! Walking on two legs over uneven ground.

use super::common::{Part, clamp, pixels, unwind, view_around};
use super::terrain::{GRASS, LENGTH, LEVEL, START, STEP, Terrain};
use crate::actuator::set_motor;
use crate::error::BatchError;
use crate::random::Random;
use crate::reading::joint_motion;
use crate::task::{Outcome, Spec, Task, View};
use serde::{Deserialize, Serialize};
use tiny_physics::math::{cos, sin};
use tiny_physics::{
    BodyId, ChainDef, Error, Filter, JointDef, JointId, QueryFilter, RigidBody, Rot, Settings,
    Shape, ShapeDef, Vec2, World,
};

const STEPS_PER_SECOND: f32 = 50.0;
/// Pixels a metre: the task's numbers are in pixels.
const SCALE: f32 = 30.0;
const WIDTH: f32 = 600.0 / SCALE;
const HEIGHT: f32 = 400.0 / SCALE;

const HULL: [(i16, i16); 5] = [(-30, 9), (6, 9), (34, 1), (34, -8), (-30, -8)];
/// Where the hips are below the hull's origin.
const HIP: f32 = 8.0 / SCALE;
const LEG: Vec2 = Vec2::new(8.0 / SCALE, 34.0 / SCALE);
const GROUND_FRICTION: f32 = 2.5;
/// How the walker stands at first, radians: almost straight. The original's joints begin half a metre apart, and so its
/// engine puts them together.
const THIGH: f32 = 0.06;
const SHIN: f32 = -0.1;
/// Solver iterations and substeps, chosen so that Gymnasium's heuristic scores here (131.1 +- 12.6) what it scores on Box2D
/// (120.6 +- 13.4): as hard to walk as there. Steps that long are what makes it hard: 3 substeps give 45, 5 218, 8 271.
const ITERATIONS: u32 = 1;
const SUBSTEPS: u32 = 4;
/// Newton metres.
const TORQUE: f32 = 80.0;
/// Radians a second of hips and knees.
const SPEEDS: [f32; 4] = [4.0, 6.0, 4.0, 6.0];
/// Newtons, for one step.
const FIRST_PUSH: f32 = 5.0;
const RAYS: usize = 10;
const RAY_LENGTH: f32 = 160.0 / SCALE;
/// What the rays see and the robot's parts collide with.
const GROUND: u64 = 1;
const ROBOT: Filter = Filter { category: 0x20, mask: GROUND, group: 0 };

/// Walking on two legs over uneven ground: the rules and numbers of Gymnasium's `BipedalWalker-v3`, with stumps,
/// stairs and pits in the hard version.
///
/// An observation is the hull's angle, angular velocity and velocity; angle and speed of hip and knee and
/// whether the foot touches, for each leg; and ten ranges. An action is a motor torque for each hip and knee.
#[derive(Clone, Debug)]
pub struct BipedalWalker {
    hardcore: bool,
    template: World,
    hull: Part,
    shins: [Part; 2],
    /// Hip and knee of one leg, then of the other.
    joints: [JointId; 4],
}

/// An episode of [`BipedalWalker`].
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Episode {
    touches: [u32; 2],
    hull_touches: u32,
    angle: f32,
    worth: Option<f32>,
}

impl BipedalWalker {
    /// The task, with obstacles or without.
    ///
    /// # Errors
    /// None that is known; the engine's.
    pub fn new(hardcore: bool) -> Result<Self, BatchError> {
        let settings =
            Settings { iterations: ITERATIONS, substeps: SUBSTEPS, ..Settings::default() };
        let mut template = World::with_settings(Vec2::new(0.0, -10.0), settings);
        let reach = LEG.y * (cos(THIGH) + cos(SHIN)) + 0.4 * LEG.x * sin(SHIN).abs();
        let place = Vec2::new(0.5 * STEP * START as f32, LEVEL + HIP + reach);
        let hull = pixels(&HULL, SCALE)?.density(5.0).friction(0.1).filter(ROBOT);
        let hull = Part::add(&mut template, RigidBody::dynamic().position(place).shape(hull))?;
        let left = add_leg(&mut template, hull, place, -1.0)?;
        let right = add_leg(&mut template, hull, place, 1.0)?;
        let joints = [left.hip, left.knee, right.hip, right.knee];
        Ok(Self { hardcore, template, hull, shins: [left.shin, right.shin], joints })
    }

    fn drive(&self, world: &mut World, action: &[f32]) -> Result<(), Error> {
        for ((&joint, &action), speed) in self.joints.iter().zip(action).zip(SPEEDS) {
            let direction = if action == 0.0 { 0.0 } else { action.signum() };
            set_motor(world, joint, |motor| {
                motor.speed = speed * direction;
                motor.max = TORQUE * clamp(action.abs(), 0.0, 1.0);
            })?;
        }
        Ok(())
    }

    fn outcome(&self, world: &World, episode: &mut Episode, action: &[f32]) -> Outcome {
        let Some(hull) = world.body(self.hull.body) else { return Outcome::default() };
        let x = hull.position().x;
        let worth = 130.0 * x / SCALE - 5.0 * episode.angle.abs();
        let gain = episode.worth.map_or(0.0, |before| worth - before);
        episode.worth = Some(worth);
        let effort: f32 = action.iter().map(|a| clamp(a.abs(), 0.0, 1.0)).sum();
        if episode.hull_touches > 0 || x < 0.0 {
            return Outcome { reward: -100.0, terminated: true };
        }
        let goal = (LENGTH - GRASS) as f32 * STEP;
        Outcome { reward: gain - 0.00035 * TORQUE * effort, terminated: x > goal }
    }

    /// How far the ground is, straight down to almost straight ahead.
    fn ranges(&self, world: &World, out: &mut [f32]) {
        let Some(hull) = world.body(self.hull.body) else { return };
        let (filter, from) = (QueryFilter::new().mask(GROUND), hull.position_f64());
        for (i, range) in out.iter_mut().enumerate() {
            let angle = 1.5 * i as f32 / RAYS as f32;
            let way = Vec2::new(sin(angle), -cos(angle)) * RAY_LENGTH;
            *range = world.ray_cast(from, way, &filter).map_or(1.0, |hit| hit.fraction);
        }
    }
}

impl Task for BipedalWalker {
    type Episode = Episode;

    fn title(&self) -> String {
        if self.hardcore { "bipedal walker, hardcore" } else { "bipedal walker" }.into()
    }

    fn spec(&self) -> Spec {
        let time_limit = if self.hardcore { 2000 } else { 1600 };
        let dt = 1.0 / STEPS_PER_SECOND;
        Spec { observation: 14 + RAYS, action: 4, choices: None, time_limit, dt }
    }

    fn names(&self) -> Vec<String> {
        let mut names: Vec<String> =
            ["angle", "angular velocity", "vx", "vy"].map(String::from).to_vec();
        for leg in ["left", "right"] {
            let parts = ["hip angle", "hip speed", "knee angle", "knee speed", "foot"];
            names.extend(parts.iter().map(|part| format!("{leg} {part}")));
        }
        names.extend((0..RAYS).map(|i| format!("range {i}")));
        names
    }

    fn template(&self) -> &World {
        &self.template
    }

    fn reset(&self, world: &mut World, random: &mut Random) -> Result<Episode, BatchError> {
        world.clone_from(&self.template);
        let way = Terrain::new(random, self.hardcore);
        let ground = ChainDef::open(&way.corners()).friction(GROUND_FRICTION);
        let mut body = RigidBody::fixed().chain(&ground)?;
        for block in &way.blocks {
            body = body.shape(ShapeDef::new(Shape::hull(block)?).friction(GROUND_FRICTION));
        }
        world.add_body(body)?;
        let push = Vec2::new(random.uniform(-FIRST_PUSH, FIRST_PUSH), 0.0);
        if let Some(mut hull) = world.body_mut(self.hull.body) {
            hull.apply_force_to_center(push);
        }
        let mut episode = Episode::default();
        self.step(world, &mut episode, random, &[0.0; 4])?;
        Ok(episode)
    }

    fn step(
        &self,
        world: &mut World,
        episode: &mut Episode,
        _: &mut Random,
        action: &[f32],
    ) -> Result<Outcome, BatchError> {
        self.drive(world, action)?;
        world.try_step(1.0 / STEPS_PER_SECOND)?;
        let shins = self.shins.iter().zip(&mut episode.touches);
        shins.for_each(|(shin, touches)| shin.count_touches(world, touches));
        self.hull.count_touches(world, &mut episode.hull_touches);
        if let Some(hull) = world.body(self.hull.body) {
            episode.angle = unwind(episode.angle, hull.rotation());
        }
        Ok(self.outcome(world, episode, action))
    }

    fn observe(&self, world: &World, episode: &Episode, out: &mut [f32]) {
        let Some(hull) = world.body(self.hull.body) else { return };
        let velocity = hull.velocity() * (0.3 / STEPS_PER_SECOND);
        out[0] = episode.angle;
        out[1] = 2.0 * hull.angular_velocity() / STEPS_PER_SECOND;
        out[2] = velocity.x * WIDTH;
        out[3] = velocity.y * HEIGHT;
        for (leg, out) in out[4..14].chunks_mut(5).enumerate() {
            let motion = |i: usize| joint_motion(world, self.joints[2 * leg + i]);
            let (hip, knee) = (motion(0).unwrap_or_default(), motion(1).unwrap_or_default());
            let touches = f32::from(u8::from(episode.touches[leg] > 0));
            let values = [hip.0, hip.1 / SPEEDS[0], knee.0 + 1.0, knee.1 / SPEEDS[1], touches];
            out.copy_from_slice(&values);
        }
        self.ranges(world, &mut out[14..]);
    }

    fn view(&self, world: &World, _: &Episode) -> View {
        let x = world.body(self.hull.body).map_or(0.0, |hull| hull.position_f64().x);
        let center = tiny_physics::DVec2::new(x + 0.3 * f64::from(WIDTH), f64::from(0.5 * HEIGHT));
        view_around(center, WIDTH, HEIGHT)
    }
}

struct Leg {
    shin: Part,
    hip: JointId,
    knee: JointId,
}

/// A leg with its foot on the ground, turned a little to the side of -1 or 1.
fn add_leg(world: &mut World, hull: Part, place: Vec2, side: f32) -> Result<Leg, Error> {
    let part = |width: f32, top: Vec2, angle: f32| -> Result<RigidBody, Error> {
        let shape = ShapeDef::new(Shape::rect(0.5 * width * LEG.x, 0.5 * LEG.y)?);
        let middle = top + Rot::from_angle(angle).y_axis() * (-0.5 * LEG.y);
        let shape = shape.friction(0.2).filter(ROBOT);
        Ok(RigidBody::dynamic().position(middle).angle(angle).shape(shape))
    };
    let (end, angle) = (Vec2::new(0.0, 0.5 * LEG.y), THIGH + 0.002 * side);
    let top = place - Vec2::new(0.0, HIP);
    let thigh = world.add_body(part(1.0, top, angle)?)?;
    let hip = hinge(world, (hull.body, Vec2::new(0.0, -HIP)), (thigh, end), (-0.8, 1.1), side)?;
    let knee = top + Rot::from_angle(angle).y_axis() * -LEG.y;
    let shin = Part::add(world, part(0.8, knee, SHIN)?)?;
    let knee = hinge(world, (thigh, -end), (shin.body, end), (-1.6, -0.1), 1.0)?;
    Ok(Leg { shin, hip, knee })
}

fn hinge(
    world: &mut World,
    (a, anchor_a): (BodyId, Vec2),
    (b, anchor_b): (BodyId, Vec2),
    (lower, upper): (f32, f32),
    speed: f32,
) -> Result<JointId, Error> {
    let joint = JointDef::revolute().anchors(anchor_a, anchor_b).limits(lower, upper);
    world.add_joint(a, b, joint.motor(speed, TORQUE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task_batch::{Autoreset, TaskBatch, Tasks};

    #[test]
    fn a_limp_walker_falls_and_is_fined() {
        for hardcore in [false, true] {
            let task = BipedalWalker::new(hardcore).unwrap();
            let mut batch = TaskBatch::new(task, 6, 1, Autoreset::NextStep).unwrap();
            let mut falls = [0; 6];
            for _ in 0..400 {
                batch.step(&[0.0; 24]).unwrap();
                for (i, falls) in falls.iter_mut().enumerate() {
                    let (outcome, _) = batch.outcome(i).unwrap();
                    *falls += usize::from(outcome.terminated && outcome.reward == -100.0);
                }
                assert!(batch.observations().iter().all(|x| x.is_finite()));
            }
            assert!(falls.iter().all(|&falls| falls > 0), "{falls:?}");
        }
    }

    #[test]
    fn it_stands_at_first_and_sees_the_ground() {
        let batch =
            TaskBatch::new(BipedalWalker::new(false).unwrap(), 1, 1, Autoreset::Disabled).unwrap();
        let seen = batch.observations();
        assert!(seen[0].abs() < 0.1, "{seen:?}");
        let down = (HIP + LEG.y * (cos(THIGH) + cos(SHIN))) / RAY_LENGTH;
        assert!((seen[14] - down).abs() < 0.02, "{seen:?}");
        assert!(seen[2].abs() < 0.05 && seen[3].abs() < 0.05, "{seen:?}");
        assert!(seen[15..].windows(2).all(|pair| pair[0] < pair[1] + 1e-6), "{seen:?}");
    }
}
