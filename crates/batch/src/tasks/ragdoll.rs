//! Keeping a figure of twelve bones on its feet.

use super::common::{Part, clamp, view_around};
use crate::actuator::set_motor;
use crate::error::BatchError;
use crate::random::Random;
use crate::reading::joint_motion;
use crate::task::{Outcome, Spec, Task, View};
use serde::{Deserialize, Serialize};
use tiny_physics::{
    BodyId, DVec2, Error, Filter, JointDef, JointId, RigidBody, Shape, ShapeDef, Vec2, World,
};

const DT: f32 = 1.0 / 50.0;
/// Bones do not meet each other.
const BONE: Filter = Filter { category: 2, mask: 1, group: 0 };
/// Radians a second of wish for each radian that a joint is off, and at most.
const STIFFNESS: f32 = 12.0;
const MOST_SPEED: f32 = 8.0;
/// Steps between two shoves, at least and at most, and their greatest impulse, newton seconds.
const SHOVES: (i64, i64) = (60, 140);
const SHOVE: f32 = 8.0;
/// A head below this part of its first height has fallen; kneeling is 0.74.
const FALLEN: f32 = 0.8;

/// A bone: its parent and the joint to it.
struct Bone {
    parent: usize,
    /// Ends of its axis in the standing figure, metres; the joint is at the first.
    from: Vec2,
    to: Vec2,
    radius: f32,
    /// Range of the joint, radians, and its greatest torque, newton metres.
    range: (f32, f32),
    torque: f32,
}

const fn bone(
    parent: usize,
    from: (f32, f32),
    to: (f32, f32),
    radius: f32,
    range: (f32, f32),
    torque: f32,
) -> Bone {
    let (from, to) = (Vec2::new(from.0, from.1), Vec2::new(to.0, to.1));
    Bone { parent, from, to, radius, range, torque }
}

/// The trunk, the head, two arms of two bones, two legs of three; seen from the side, facing right.
const BONES: [Bone; 12] = [
    bone(0, (0.0, 0.98), (0.0, 1.42), 0.10, (0.0, 0.0), 0.0),
    bone(0, (0.0, 1.50), (0.0, 1.64), 0.09, (-0.4, 0.4), 20.0),
    bone(0, (0.0, 1.42), (0.0, 1.14), 0.05, (-1.2, 2.4), 40.0),
    bone(2, (0.0, 1.14), (0.0, 0.88), 0.04, (0.0, 2.2), 25.0),
    bone(0, (0.0, 1.42), (0.0, 1.14), 0.05, (-1.2, 2.4), 40.0),
    bone(4, (0.0, 1.14), (0.0, 0.88), 0.04, (0.0, 2.2), 25.0),
    bone(0, (0.0, 0.94), (0.0, 0.52), 0.07, (-0.6, 1.6), 160.0),
    bone(6, (0.0, 0.52), (0.0, 0.10), 0.06, (-2.0, 0.0), 140.0),
    bone(7, (-0.04, 0.05), (0.18, 0.05), 0.05, (-0.7, 0.7), 90.0),
    bone(0, (0.0, 0.94), (0.0, 0.52), 0.07, (-0.6, 1.6), 160.0),
    bone(9, (0.0, 0.52), (0.0, 0.10), 0.06, (-2.0, 0.0), 140.0),
    bone(10, (-0.04, 0.05), (0.18, 0.05), 0.05, (-0.7, 0.7), 90.0),
];
const HEAD: usize = 1;
const FEET: [usize; 2] = [8, 11];
/// Joints that an agent moves: all but the neck.
const DRIVEN: usize = 10;

/// Keeping a figure of twelve bones on its feet while it is shoved about.
///
/// An observation is the trunk's height, angle, velocity and turning, how far each foot is to the side and
/// whether it touches, the head's height, and angle and speed of ten joints. An action is for each
/// of these joints where in its range to hold it: -1 and 1 are its ends, motors with bounded torque do the rest. The reward
/// of a step is how high the head is, 1 where it stands straight, less 0.05 of the actions' mean square; -10 and
/// the end when it falls.
#[derive(Clone, Debug)]
pub struct Ragdoll {
    template: World,
    bones: Vec<Part>,
    joints: Vec<JointId>,
}

/// An episode of [`Ragdoll`].
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Episode {
    touches: [u32; 2],
    /// Steps until the next shove.
    calm: i64,
}

impl Ragdoll {
    /// The task.
    ///
    /// # Errors
    /// None that is known; the engine's.
    pub fn new() -> Result<Self, BatchError> {
        let mut template = World::new(Vec2::new(0.0, -9.8));
        let floor = ShapeDef::new(Shape::rect(50.0, 0.5)?).friction(1.0);
        template.add_body(RigidBody::fixed().position(Vec2::new(0.0, -0.5)).shape(floor))?;
        let (mut bones, mut joints): (Vec<Part>, Vec<JointId>) = Default::default();
        for bone in &BONES {
            let part = Part::add(&mut template, bone.body()?)?;
            if let Some(parent) = bones.get(bone.parent) {
                joints.push(bone.join(&mut template, parent.body, part.body)?);
            }
            bones.push(part);
        }
        Ok(Self { template, bones, joints })
    }

    fn head_height(&self, world: &World) -> f32 {
        world.body(self.bones[HEAD].body).map_or(0.0, |head| head.position().y)
    }

    /// The joints that an agent moves, and their bones.
    fn driven(&self) -> impl Iterator<Item = (JointId, &'static Bone)> + '_ {
        self.joints.iter().copied().zip(&BONES[1..]).skip(1)
    }

    fn drive(&self, world: &mut World, action: &[f32]) -> Result<(), Error> {
        for ((joint, bone), &action) in self.driven().zip(action) {
            let wish = bone.hold(clamp(action, -1.0, 1.0));
            let todo = wish - joint_motion(world, joint)?.0;
            let speed = clamp(STIFFNESS * todo, -MOST_SPEED, MOST_SPEED);
            set_motor(world, joint, |motor| motor.speed = speed)?;
        }
        Ok(())
    }

    fn shove(&self, world: &mut World, episode: &mut Episode, random: &mut Random) {
        episode.calm -= 1;
        if episode.calm > 0 {
            return;
        }
        episode.calm = random.whole(SHOVES.0, SHOVES.1);
        if let Some(mut trunk) = world.body_mut(self.bones[0].body) {
            trunk.apply_impulse_to_center(Vec2::new(random.uniform(-SHOVE, SHOVE), 0.0));
        }
    }
}

impl Bone {
    fn body(&self) -> Result<RigidBody, Error> {
        let middle = (self.from + self.to) * 0.5;
        let shape = Shape::capsule(self.from - middle, self.to - middle, self.radius)?;
        let shape = ShapeDef::new(shape).density(300.0).friction(1.0).filter(BONE);
        Ok(RigidBody::dynamic().position(middle).can_sleep(false).shape(shape))
    }

    fn join(&self, world: &mut World, a: BodyId, b: BodyId) -> Result<JointId, Error> {
        let anchor = |id| world.body(id).map_or(Vec2::ZERO, |body| self.from - body.position());
        let joint = JointDef::revolute().anchors(anchor(a), anchor(b));
        let joint = joint.limits(self.range.0, self.range.1).motor(0.0, self.torque);
        world.add_joint(a, b, joint)
    }

    /// The angle that an action asks for: 0 is the standing figure's.
    fn hold(&self, action: f32) -> f32 {
        let (lower, upper) = self.range;
        if action > 0.0 { upper * action } else { -lower * action }
    }
}

impl Task for Ragdoll {
    type Episode = Episode;

    fn title(&self) -> String {
        "ragdoll".into()
    }

    fn spec(&self) -> Spec {
        let observation = 11 + 2 * DRIVEN;
        Spec { observation, action: DRIVEN, choices: None, time_limit: 500, dt: DT }
    }

    fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = [
            "height",
            "sine",
            "cosine",
            "vx",
            "vy",
            "turning",
            "left foot x",
            "left foot touches",
            "right foot x",
            "right foot touches",
            "head height",
        ]
        .map(String::from)
        .to_vec();
        let joints = ["shoulder", "elbow", "shoulder", "elbow", "hip", "knee", "ankle"];
        let joints = joints.iter().chain(&joints[4..]);
        for (i, joint) in joints.enumerate() {
            names.extend([format!("{joint} {i} angle"), format!("{joint} {i} speed")]);
        }
        names
    }

    fn template(&self) -> &World {
        &self.template
    }

    fn reset(&self, world: &mut World, random: &mut Random) -> Result<Episode, BatchError> {
        world.clone_from(&self.template);
        let nudge = Vec2::new(random.uniform(-0.2, 0.2), 0.0);
        for part in &self.bones {
            if let Some(mut bone) = world.body_mut(part.body) {
                bone.set_velocity(nudge);
            }
        }
        let calm = random.whole(SHOVES.0, SHOVES.1);
        let mut episode = Episode { calm, ..Episode::default() };
        self.step(world, &mut episode, random, &[0.0; DRIVEN])?;
        Ok(episode)
    }

    fn step(
        &self,
        world: &mut World,
        episode: &mut Episode,
        random: &mut Random,
        action: &[f32],
    ) -> Result<Outcome, BatchError> {
        self.drive(world, action)?;
        self.shove(world, episode, random);
        world.try_step(DT)?;
        for (foot, touches) in FEET.iter().zip(&mut episode.touches) {
            self.bones[*foot].count_touches(world, touches);
        }
        let straight = (BONES[HEAD].from.y + BONES[HEAD].to.y) * 0.5;
        let height = self.head_height(world) / straight;
        if height < FALLEN {
            return Ok(Outcome { reward: -10.0, terminated: true });
        }
        let effort: f32 = action.iter().map(|a| clamp(a * a, 0.0, 1.0)).sum();
        let reward = clamp(height, 0.0, 1.0) - 0.05 * effort / DRIVEN as f32;
        Ok(Outcome { reward, terminated: false })
    }

    fn observe(&self, world: &World, episode: &Episode, out: &mut [f32]) {
        let Some(trunk) = world.body(self.bones[0].body) else { return };
        let (place, turn, velocity) = (trunk.position(), trunk.rotation(), trunk.velocity());
        out[..6].copy_from_slice(&[
            place.y,
            turn.s,
            turn.c,
            velocity.x,
            velocity.y,
            trunk.angular_velocity() / 5.0,
        ]);
        for (i, out) in out[6..10].chunks_mut(2).enumerate() {
            let foot = world.body(self.bones[FEET[i]].body);
            out[0] = foot.map_or(0.0, |foot| foot.position().x - place.x);
            out[1] = f32::from(u8::from(episode.touches[i] > 0));
        }
        out[10] = self.head_height(world);
        for ((joint, _), out) in self.driven().zip(out[11..].chunks_mut(2)) {
            let (angle, speed) = joint_motion(world, joint).unwrap_or_default();
            out.copy_from_slice(&[angle, speed / MOST_SPEED]);
        }
    }

    fn view(&self, world: &World, _: &Episode) -> View {
        let x = world.body(self.bones[0].body).map_or(0.0, |trunk| trunk.position_f64().x);
        view_around(DVec2::new(x, 0.85), 3.6, 2.4)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task_batch::{Autoreset, TaskBatch, Tasks};

    #[test]
    fn it_falls_sooner_or_later_without_an_agent_and_at_once_when_it_kicks() {
        let mean_steps = |action: f32| {
            let task = Ragdoll::new().unwrap();
            let mut batch = TaskBatch::new(task, 8, 1, Autoreset::NextStep).unwrap();
            let (mut steps, mut falls) = (0, 0);
            while falls < 8 && steps < 2000 {
                batch.step(&[action; 8 * DRIVEN]).unwrap();
                steps += 1;
                falls += (0..8).filter(|&i| batch.outcome(i).unwrap().0.terminated).count();
            }
            steps as f32 * 8.0 / falls.max(1) as f32
        };
        let (still, kicking) = (mean_steps(0.0), mean_steps(1.0));
        assert!(kicking < still && kicking < 150.0, "{still} {kicking}");
    }
}
