//! What the numbers of an action do.

use crate::reading::is_lost;
use serde::{Deserialize, Serialize};
use tiny_physics::{BodyId, DVec2, Error, JointDef, JointId, JointKind, Motor, Vec2, World};

/// What one number does to a world. Handles are those of the template. A handle that is stale in a world is an
/// error; a number that makes no sense for the thing is one, too. A joint that has broken in a world (or was removed from it) heeds none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Actuator {
    /// Force on the centre of mass for the next step: world x, newtons.
    ForceX(BodyId),
    /// The same along y.
    ForceY(BodyId),
    /// Torque for the next step, newton metres.
    Torque(BodyId),
    /// Impulse on the centre of mass: world x, newton seconds.
    ImpulseX(BodyId),
    /// The same along y.
    ImpulseY(BodyId),
    /// Force along the body's own y axis for the next step, newtons: a rocket's engine.
    Thrust(BodyId),
    /// Velocity: world x, metres a second.
    VelocityX(BodyId),
    /// The same along y.
    VelocityY(BodyId),
    /// Radians a second.
    AngularVelocity(BodyId),
    /// Place of the body's origin: world x, metres.
    PositionX(BodyId),
    /// The same along y.
    PositionY(BodyId),
    /// Angle, radians.
    Angle(BodyId),
    /// Speed of a joint's motor, metres or radians a second; a joint without one gets one that is not bounded.
    MotorSpeed(JointId),
    /// Greatest force or torque of a joint's motor, newtons or newton metres.
    MotorMax(JointId),
    /// World gravity: y, metres a second squared.
    GravityY,
}

impl Actuator {
    /// Does it to a copy of a template.
    pub(crate) fn apply(
        self,
        world: &mut World,
        template: &World,
        value: f32,
    ) -> Result<(), Error> {
        match self {
            Self::MotorSpeed(joint) | Self::MotorMax(joint) if is_lost(world, template, joint) => {
                Ok(())
            }
            Self::MotorSpeed(joint) => set_motor(world, joint, |motor| motor.speed = value),
            Self::MotorMax(joint) => set_motor(world, joint, |motor| motor.max = value),
            Self::GravityY => {
                world.gravity.y = value;
                Ok(())
            }
            Self::ForceX(body)
            | Self::ForceY(body)
            | Self::Torque(body)
            | Self::ImpulseX(body)
            | Self::ImpulseY(body)
            | Self::Thrust(body)
            | Self::VelocityX(body)
            | Self::VelocityY(body)
            | Self::AngularVelocity(body)
            | Self::PositionX(body)
            | Self::PositionY(body)
            | Self::Angle(body) => {
                let before = world.stats().refused_numbers;
                self.apply_to_body(world, body, value)?;
                if world.stats().refused_numbers == before {
                    return Ok(());
                }
                let allowed = "what a body takes; this is too large";
                Err(Error::OutOfRange { name: "action", value: value.into(), allowed })
            }
        }
    }

    fn apply_to_body(self, world: &mut World, body: BodyId, value: f32) -> Result<(), Error> {
        let stale = || Error::StaleHandle { handle: format!("{body:?}") };
        let mut body = world.body_mut(body).ok_or_else(stale)?;
        let now = body.as_ref();
        let (velocity, place) = (now.velocity(), now.position_f64());
        match self {
            Self::ForceX(_) => body.apply_force_to_center(Vec2::new(value, 0.0)),
            Self::ForceY(_) => body.apply_force_to_center(Vec2::new(0.0, value)),
            Self::Torque(_) => body.apply_torque(value),
            Self::ImpulseX(_) => body.apply_impulse_to_center(Vec2::new(value, 0.0)),
            Self::ImpulseY(_) => body.apply_impulse_to_center(Vec2::new(0.0, value)),
            Self::Thrust(_) => {
                let up = now.rotation().y_axis();
                body.apply_force_to_center(up * value);
            }
            Self::VelocityX(_) => body.set_velocity(Vec2::new(value, velocity.y)),
            Self::VelocityY(_) => body.set_velocity(Vec2::new(velocity.x, value)),
            Self::AngularVelocity(_) => body.set_angular_velocity(value),
            Self::PositionX(_) => body.set_position(DVec2::new(value.into(), place.y)),
            Self::PositionY(_) => body.set_position(DVec2::new(place.x, value.into())),
            Self::Angle(_) => body.set_angle(value),
            Self::MotorSpeed(_) | Self::MotorMax(_) | Self::GravityY => {}
        }
        Ok(())
    }
}

/// Changes the motor of a joint.
pub(crate) fn set_motor(
    world: &mut World,
    joint: JointId,
    change: impl Fn(&mut Motor),
) -> Result<(), Error> {
    let stale = || Error::StaleHandle { handle: format!("{joint:?}") };
    let mut def: JointDef = *world.joint(joint).ok_or_else(stale)?.def();
    match &mut def.kind {
        JointKind::Distance { motor, .. }
        | JointKind::Revolute { motor, .. }
        | JointKind::Prismatic { motor, .. }
        | JointKind::Wheel { motor, .. } => {
            change(motor.get_or_insert(Motor { speed: 0.0, max: f32::MAX }));
        }
        _ => return Err(Error::Unsupported { reason: "this kind of joint has no motor" }),
    }
    world.set_joint(joint, def)
}
