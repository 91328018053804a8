//! Changing a joint while the world runs, one thing at a time.

use super::World;
use super::ids::JointId;
use super::joints::JointRef;
use crate::describe::{JointDef, JointKind, Limits, Motor, Spring};
use crate::error::Error;
use crate::math::DVec2;

/// A joint of the world, to change. A change wakes its bodies; what is the same already changes nothing, so a game may
/// set a motor in every frame. In a recording every change is a [`Command::SetJoint`](crate::record::Command::SetJoint).
pub struct JointMut<'a> {
    world: &'a mut World,
    id: JointId,
    index: u32,
}

impl World {
    /// A joint to change; `None` if it has been removed.
    ///
    /// ```
    /// use tiny_physics::prelude::*;
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new((0.0, 0.0));
    /// let wall = world.add_body(RigidBody::fixed())?;
    /// let door = world.add_body(RigidBody::dynamic().position((1.0, 0.0)).shape(Shape::rect(1.0, 0.1)?))?;
    /// let hinge = JointDef::revolute().anchor_at((0.0, 0.0)).motor(1.0, 50.0).limits(0.0, 1.5);
    /// let hinge = world.add_joint(wall, door, hinge)?;
    /// (0..120).for_each(|_| world.step(1.0 / 60.0));
    /// assert!((world.joint(hinge).unwrap().angle() - 1.5).abs() < 0.01);
    ///
    /// world.joint_mut(hinge).unwrap().set_motor_speed(-1.0)?; // and shut it again
    /// (0..120).for_each(|_| world.step(1.0 / 60.0));
    /// assert!(world.joint(hinge).unwrap().angle().abs() < 0.01);
    /// # Ok(())
    /// # }
    /// ```
    pub fn joint_mut(&mut self, id: JointId) -> Option<JointMut<'_>> {
        let index = self.joint_index(id).map_err(|_| self.stats.stale_handles += 1).ok()?;
        Some(JointMut { world: self, id, index })
    }
}

impl JointMut<'_> {
    /// The joint, to read.
    pub fn as_ref(&self) -> JointRef<'_> {
        JointRef::new(self.world, self.index)
    }

    /// Gives it another description: see [`World::set_joint`].
    ///
    /// # Errors
    /// A number in the description is out of range.
    pub fn set_def(&mut self, def: JointDef) -> Result<(), Error> {
        self.world.set_joint(self.id, def)
    }

    /// Sets the motor, or takes it away. Of a [`JointKind::Motor`] it is the angular part.
    ///
    /// # Errors
    /// The kind has no motor, or a number is out of range.
    pub fn set_motor(&mut self, motor: Option<Motor>) -> Result<(), Error> {
        self.set_part("this joint has no motor", |kind| kind.set_motor(motor))
    }

    /// Sets the speed of the motor, metres or radians a second; its greatest force stays.
    ///
    /// # Errors
    /// It has no motor, or the speed is not finite.
    pub fn set_motor_speed(&mut self, speed: f32) -> Result<(), Error> {
        self.set_part("this joint has no motor", |kind| {
            kind.motor().is_some_and(|motor| kind.set_motor(Some(Motor { speed, ..motor })))
        })
    }

    /// Sets the greatest force of the motor (newtons; newton metres where it turns), of a mouse joint, or of the linear
    /// part of a [`JointKind::Motor`].
    ///
    /// # Errors
    /// It has none, or the number is not finite or below 0.
    pub fn set_max_force(&mut self, max: f32) -> Result<(), Error> {
        self.set_part("this joint has no motor", |kind| kind.set_max_force(max))
    }

    /// Sets the limits, metres or radians, or takes them away.
    ///
    /// # Errors
    /// The kind has no limits, or a number is out of range.
    pub fn set_limits(&mut self, limits: Option<Limits>) -> Result<(), Error> {
        self.set_part("this kind of joint has no limits", |kind| kind.set_limits(limits))
    }

    /// Sets the spring (both of a weld), or takes it away; a mouse joint keeps the one that it has.
    ///
    /// # Errors
    /// The kind has no spring, or a number is out of range.
    pub fn set_spring(&mut self, spring: Option<Spring>) -> Result<(), Error> {
        self.set_part("this kind of joint has no spring", |kind| kind.set_spring(spring))
    }

    /// Sets where the spring rests: radians of a hinge, metres of a slider; the length of a rod, of a rope, of its spring or of a
    /// pulley's rope.
    ///
    /// # Errors
    /// The kind has no such number (limits alone have none, unless their upper one is the length: a rope), or it is out of range.
    pub fn set_target(&mut self, target: f32) -> Result<(), Error> {
        self.set_part("this kind of joint has no target", |kind| kind.set_rest(target))
    }

    /// Sets where a mouse joint pulls to: world, metres.
    ///
    /// # Errors
    /// It is no mouse joint, or the point is not finite.
    pub fn set_target_point(&mut self, point: impl Into<DVec2>) -> Result<(), Error> {
        let point = point.into();
        self.set_part("only mouse joints are pulled to a point", |kind| match kind {
            JointKind::Mouse { target, .. } => {
                *target = point;
                true
            }
            _ => false,
        })
    }

    /// Lets it do what it does, or nothing: see [`JointDef::enabled`].
    pub fn set_enabled(&mut self, enabled: bool) {
        // The rest of the description was right.
        let _ = self.set_def(JointDef { enabled, ..*self.as_ref().def() });
    }

    /// Sets the user's number.
    pub fn set_user_data(&mut self, user_data: u64) {
        let _ = self.set_def(JointDef { user_data, ..*self.as_ref().def() });
    }

    fn set_part(
        &mut self,
        lacks: &'static str,
        set: impl FnOnce(&mut JointKind) -> bool,
    ) -> Result<(), Error> {
        let mut def = *self.as_ref().def();
        if !set(&mut def.kind) {
            return Err(Error::Unsupported { reason: lacks });
        }
        self.set_def(def)
    }
}
