//! Landing a rocket between two flags.

use super::common::{Part, clamp, pixels, tanh, unwind};
use crate::error::BatchError;
use crate::random::Random;
use crate::task::{Outcome, Spec, Task, View};
use serde::{Deserialize, Serialize};
use tiny_physics::math::sin;
use tiny_physics::{
    ChainDef, DVec2, Error, Filter, JointDef, RigidBody, Shape, ShapeDef, Vec2, World,
};

const STEPS_PER_SECOND: f32 = 50.0;
/// Pixels a metre: the task's numbers are in pixels.
const SCALE: f32 = 30.0;
const WIDTH: f32 = 600.0 / SCALE;
const HEIGHT: f32 = 400.0 / SCALE;
/// Corners of the ground, the flags at the middle five.
const CORNERS: usize = 11;
const PAD_HEIGHT: f32 = HEIGHT / 4.0;

const HULL: [(i16, i16); 6] = [(-14, 17), (-17, 0), (-17, -10), (17, -10), (17, 0), (14, 17)];
const LEG_AWAY: f32 = 20.0 / SCALE;
const LEG_DOWN: f32 = 18.0 / SCALE;
const LEG_TORQUE: f32 = 40.0;

const MAIN_POWER: f32 = 13.0;
const SIDE_POWER: f32 = 0.6;
const MAIN_BELOW: f32 = 4.0 / SCALE;
const SIDE_AWAY: f32 = 12.0 / SCALE;
const SIDE_ABOVE: f32 = 14.0 / SCALE;
/// Where the thrust of the side engines acts differs from where they are, as it does in the original.
const SIDE_SLIP: f32 = 17.0 / SCALE;
/// Solver iterations: the motors of the legs, which weigh a seventieth of the hull, have to carry it once they touch.
const FLYING: u32 = 1;
const STANDING: u32 = 8;
/// Newtons, for one step.
const FIRST_PUSH: f32 = 1000.0;

const HULL_FILTER: Filter = Filter { category: 0x10, mask: 1, group: 0 };
const LEG_FILTER: Filter = Filter { category: 0x20, mask: 1, group: 0 };

/// Landing a rocket between two flags: the rules and numbers of Gymnasium's `LunarLander-v3`.
///
/// An observation is x and y from the pad, velocity, angle, angular velocity, and whether each leg touches, in the
/// original's units. A discrete action is 0 nothing, 1 left engine, 2 main engine, 3 right engine; a
/// continuous one is main and side throttle.
#[derive(Clone, Debug)]
pub struct LunarLander {
    continuous: bool,
    /// Greatest force and torque of the wind, newtons and newton metres.
    wind: Option<(f32, f32)>,
    template: World,
    hull: Part,
    legs: [Part; 2],
}

/// An episode of [`LunarLander`].
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Episode {
    touches: [u32; 2],
    hull_touches: u32,
    angle: f32,
    worth: Option<f32>,
    wind: i64,
    turbulence: i64,
}

/// How hard the engines burn.
struct Burn {
    main: f32,
    /// 0.5 to 1, and to which side.
    side: f32,
    direction: f32,
}

impl LunarLander {
    /// The task. `gravity` is -12 to 0 metres a second squared (the original's is -10), `wind` the greatest force
    /// and torque of the wind, newtons and newton metres (the original's are 15 and 1.5).
    ///
    /// # Errors
    /// Gravity or wind out of range.
    pub fn new(
        continuous: bool,
        gravity: f32,
        wind: Option<(f32, f32)>,
    ) -> Result<Self, BatchError> {
        if !(gravity > -12.0 && gravity < 0.0) {
            let (name, value) = ("gravity", gravity.into());
            return Err(Error::OutOfRange { name, value, allowed: "above -12, below 0" }.into());
        }
        if let Some((force, torque)) = wind {
            BatchError::check_finite("wind", &[force, torque])?;
        }
        let mut template = World::new(Vec2::new(0.0, gravity));
        let hull = Part::add(&mut template, hull()?)?;
        let legs = [add_leg(&mut template, hull, -1.0)?, add_leg(&mut template, hull, 1.0)?];
        Ok(Self { continuous, wind, template, hull, legs })
    }

    /// What the engines are told.
    fn burn(&self, action: &[f32]) -> Burn {
        if !self.continuous {
            let choice = action[0];
            let side = if choice == 1.0 || choice == 3.0 { 1.0 } else { 0.0 };
            let main = if choice == 2.0 { 1.0 } else { 0.0 };
            return Burn { main, side, direction: choice - 2.0 };
        }
        let (main, side) = (clamp(action[0], -1.0, 1.0), clamp(action[1], -1.0, 1.0));
        let size = side.abs();
        Burn {
            main: if main > 0.0 { 0.5 * (main + 1.0) } else { 0.0 },
            side: if size > 0.5 { size } else { 0.0 },
            direction: if side < 0.0 { -1.0 } else { 1.0 },
        }
    }

    /// Wind on the hull while it flies.
    fn blow(&self, world: &mut World, episode: &mut Episode) {
        let Some((force, torque)) = self.wind else { return };
        if episode.touches != [0, 0] {
            return;
        }
        let Some(mut hull) = world.body_mut(self.hull.body) else { return };
        hull.apply_force_to_center(Vec2::new(gust(episode.wind) * force, 0.0));
        hull.apply_torque(gust(episode.turbulence) * torque);
        episode.wind += 1;
        episode.turbulence += 1;
    }

    /// The engines push, each at a place that scatters a little.
    fn fire(&self, world: &mut World, random: &mut Random, burn: &Burn) {
        let scatter = [0, 1].map(|_| random.uniform(-1.0, 1.0) / SCALE);
        let Some(mut hull) = world.body_mut(self.hull.body) else { return };
        let (place, turn) = (hull.as_ref().position_f64(), hull.as_ref().rotation());
        let (tip, side) = (Vec2::new(turn.s, turn.c), Vec2::new(-turn.c, turn.s));
        let down = |v: Vec2| Vec2::new(v.x, -v.y);
        if burn.main > 0.0 {
            let arm = down(tip * (MAIN_BELOW + 2.0 * scatter[0]) + side * scatter[1]);
            hull.apply_impulse(-arm * (MAIN_POWER * burn.main), place + arm);
        }
        if burn.side > 0.0 {
            let out = 3.0 * scatter[1] + burn.direction * SIDE_AWAY;
            let arm = down(tip * scatter[0] + side * out);
            let slip = Vec2::new(-tip.x * SIDE_SLIP, tip.y * SIDE_ABOVE);
            hull.apply_impulse(-arm * (SIDE_POWER * burn.side), place + arm + slip);
        }
    }

    fn observation(&self, world: &World, episode: &Episode) -> [f32; 8] {
        let Some(hull) = world.body(self.hull.body) else { return [0.0; 8] };
        let (place, velocity) = (hull.position(), hull.velocity());
        let half = Vec2::new(0.5 * WIDTH, 0.5 * HEIGHT);
        let touches = |i: usize| f32::from(u8::from(episode.touches[i] > 0));
        [
            (place.x - half.x) / half.x,
            (place.y - (PAD_HEIGHT + LEG_DOWN)) / half.y,
            velocity.x * half.x / STEPS_PER_SECOND,
            velocity.y * half.y / STEPS_PER_SECOND,
            episode.angle,
            20.0 * hull.angular_velocity() / STEPS_PER_SECOND,
            touches(0),
            touches(1),
        ]
    }

    fn outcome(&self, world: &World, episode: &mut Episode, burn: &Burn) -> Outcome {
        let state = self.observation(world, episode);
        let length = |x: f32, y: f32| (x * x + y * y).sqrt();
        let away = length(state[0], state[1]) + length(state[2], state[3]) + state[4].abs();
        let worth = -100.0 * away + 10.0 * (state[6] + state[7]);
        let gain = episode.worth.map_or(0.0, |before| worth - before);
        episode.worth = Some(worth);
        let crashed = episode.hull_touches > 0 || state[0].abs() >= 1.0;
        let awake = world.body(self.hull.body).is_some_and(|hull| hull.is_awake());
        match (awake, crashed) {
            (false, _) => Outcome { reward: 100.0, terminated: true },
            (true, true) => Outcome { reward: -100.0, terminated: true },
            _ => {
                let reward = gain - 0.3 * burn.main - 0.03 * burn.side;
                Outcome { reward, terminated: false }
            }
        }
    }
}

impl Task for LunarLander {
    type Episode = Episode;

    fn title(&self) -> String {
        let (gravity, wind) = (self.template.gravity.y, self.wind);
        let engines = if self.continuous { "continuous" } else { "on or off" };
        format!("lunar lander, engines {engines}, gravity {gravity}, wind {wind:?}")
    }

    fn spec(&self) -> Spec {
        let (action, choices) = if self.continuous { (2, None) } else { (1, Some(4)) };
        Spec { observation: 8, action, choices, time_limit: 1000, dt: 1.0 / STEPS_PER_SECOND }
    }

    fn names(&self) -> Vec<String> {
        ["x", "y", "vx", "vy", "angle", "angular velocity", "left leg", "right leg"]
            .map(String::from)
            .to_vec()
    }

    fn template(&self) -> &World {
        &self.template
    }

    fn reset(&self, world: &mut World, random: &mut Random) -> Result<Episode, BatchError> {
        world.clone_from(&self.template);
        world.add_body(RigidBody::fixed().chain(&ground(random))?)?;
        let push = Vec2::new(
            random.uniform(-FIRST_PUSH, FIRST_PUSH),
            random.uniform(-FIRST_PUSH, FIRST_PUSH),
        );
        if let Some(mut hull) = world.body_mut(self.hull.body) {
            hull.apply_force_to_center(push);
        }
        let [wind, turbulence] = [0, 1].map(|_| random.whole(-9999, 9999));
        let mut episode = Episode { wind, turbulence, ..Episode::default() };
        let nothing = [0.0; 2];
        self.step(world, &mut episode, random, &nothing[..self.spec().action])?;
        Ok(episode)
    }

    fn step(
        &self,
        world: &mut World,
        episode: &mut Episode,
        random: &mut Random,
        action: &[f32],
    ) -> Result<Outcome, BatchError> {
        let burn = self.burn(action);
        self.blow(world, episode);
        self.fire(world, random, &burn);
        let flies = episode.touches == [0, 0];
        world.settings.iterations = if flies { FLYING } else { STANDING };
        world.try_step(1.0 / STEPS_PER_SECOND)?;
        let parts = self.legs.iter().zip(&mut episode.touches);
        parts.for_each(|(leg, touches)| leg.count_touches(world, touches));
        self.hull.count_touches(world, &mut episode.hull_touches);
        if let Some(hull) = world.body(self.hull.body) {
            episode.angle = unwind(episode.angle, hull.rotation());
        }
        Ok(self.outcome(world, episode, &burn))
    }

    fn observe(&self, world: &World, episode: &Episode, out: &mut [f32]) {
        out.copy_from_slice(&self.observation(world, episode));
    }

    fn view(&self, _: &World, _: &Episode) -> View {
        View { min: DVec2::ZERO, max: DVec2::new(WIDTH.into(), HEIGHT.into()) }
    }
}

/// The wind at a moment, -1 to 1: it never repeats.
fn gust(k: i64) -> f32 {
    let k = k as f32;
    tanh(sin(0.02 * k) + sin(core::f32::consts::PI * 0.01 * k))
}

fn hull() -> Result<RigidBody, Error> {
    let shape = pixels(&HULL, SCALE)?.density(5.0).friction(0.1).filter(HULL_FILTER);
    Ok(RigidBody::dynamic().position(Vec2::new(0.5 * WIDTH, HEIGHT)).shape(shape))
}

/// A leg on the side of -1 or 1, its motor pressing it outwards.
fn add_leg(world: &mut World, hull: Part, side: f32) -> Result<Part, Error> {
    let shape = ShapeDef::new(Shape::rect(2.0 / SCALE, 8.0 / SCALE)?);
    let shape = shape.friction(0.2).filter(LEG_FILTER);
    let place = Vec2::new(0.5 * WIDTH - side * LEG_AWAY, HEIGHT);
    let body = RigidBody::dynamic().position(place).angle(0.05 * side).shape(shape);
    let leg = Part::add(world, body)?;
    let (lower, upper) = if side < 0.0 { (0.4, 0.9) } else { (-0.9, -0.4) };
    let joint = JointDef::revolute()
        .anchors(Vec2::ZERO, Vec2::new(side * LEG_AWAY, LEG_DOWN))
        .motor(0.3 * side, LEG_TORQUE)
        .limits(lower, upper);
    world.add_joint(hull.body, leg.body, joint)?;
    Ok(leg)
}

/// The ground from right to left, so that above is outside.
fn ground(random: &mut Random) -> ChainDef {
    let mut heights = [0.0; CORNERS + 1];
    heights.iter_mut().for_each(|height| *height = random.uniform(0.0, 0.5 * HEIGHT));
    let middle = CORNERS / 2;
    heights[middle - 2..=middle + 2].fill(PAD_HEIGHT);
    // The neighbour of the first corner on its left is the last height, which has no corner of its own.
    let left = |i: usize| heights[(i + CORNERS) % (CORNERS + 1)];
    let corner = |i: usize| {
        let height = 0.33 * (left(i) + heights[i] + heights[i + 1]);
        Vec2::new(WIDTH / (CORNERS - 1) as f32 * i as f32, height)
    };
    let points: Vec<Vec2> = (0..CORNERS).rev().map(corner).collect();
    ChainDef::open(&points).friction(0.1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task_batch::{Autoreset, TaskBatch, Tasks};

    /// A pilot that hovers towards the pad and comes down.
    fn pilot(s: &[f32]) -> f32 {
        let target = clamp(0.5 * s[0] + s[2], -0.4, 0.4);
        let (mut turn, mut lift) =
            (0.5 * (target - s[4]) - s[5], 0.5 * (0.55 * s[0].abs() - s[1]) - 0.5 * s[3]);
        if s[6] + s[7] > 0.0 {
            (turn, lift) = (0.0, -0.5 * s[3]);
        }
        match (lift > turn.abs() && lift > 0.05, turn < -0.05, turn > 0.05) {
            (true, ..) => 2.0,
            (_, true, _) => 3.0,
            (.., true) => 1.0,
            _ => 0.0,
        }
    }

    #[test]
    fn a_pilot_lands_and_the_lander_falls_asleep() {
        let task = LunarLander::new(false, -10.0, None).unwrap();
        let mut batch = TaskBatch::new(task, 24, 1, Autoreset::NextStep).unwrap();
        let (mut landings, mut crashes) = (0, 0);
        for _ in 0..1000 {
            let actions: Vec<f32> = batch.observations().chunks(8).map(pilot).collect();
            batch.step(&actions).unwrap();
            let ends = (0..24).map(|i| batch.outcome(i).unwrap().0).filter(|o| o.terminated);
            for outcome in ends {
                landings += usize::from(outcome.reward == 100.0);
                crashes += usize::from(outcome.reward == -100.0);
            }
        }
        assert!(landings > 30 && landings > 3 * crashes, "{landings} landings, {crashes} crashes");
    }

    #[test]
    fn free_fall_ends_in_a_crash() {
        let task = LunarLander::new(true, -10.0, Some((15.0, 1.5))).unwrap();
        let mut batch = TaskBatch::new(task, 4, 1, Autoreset::NextStep).unwrap();
        let mut crashes = 0;
        for _ in 0..300 {
            batch.step(&[-1.0, 0.0].repeat(4)).unwrap();
            let ends = (0..4).filter(|&i| batch.outcome(i).unwrap().0.terminated);
            crashes += ends.filter(|&i| batch.outcome(i).unwrap().0.reward == -100.0).count();
        }
        assert!(crashes >= 4, "{crashes}");
    }

    #[test]
    fn bad_arguments_are_refused() {
        assert!(LunarLander::new(false, 3.0, None).is_err());
        assert!(LunarLander::new(false, f32::NAN, None).is_err());
        assert!(LunarLander::new(false, -10.0, Some((f32::INFINITY, 0.0))).is_err());
    }
}
