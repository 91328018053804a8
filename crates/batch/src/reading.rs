//! What the numbers of an observation are.

use serde::{Deserialize, Serialize};
use tiny_physics::{BodyId, Error, JointId, QueryFilter, RayCastHit, Vec2, World};

/// A ray that a body carries along. The body itself does not block it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sight {
    /// Who carries it.
    pub body: BodyId,
    /// Where it starts: body's frame, metres.
    pub offset: Vec2,
    /// From the start to the end: body's frame, metres.
    pub translation: Vec2,
    /// Categories that it sees, as bits.
    pub mask: u64,
}

impl Sight {
    /// The first thing in sight.
    fn look(&self, world: &World) -> Result<Option<RayCastHit>, Error> {
        let body = world.body(self.body).ok_or_else(|| stale(self.body))?;
        let pose = body.pose();
        let filter = QueryFilter::new().mask(self.mask).exclude(self.body);
        Ok(world.ray_cast(pose.apply(self.offset), pose.q.rotate(self.translation), &filter))
    }
}

/// What one number tells of a world. Handles are those of the template; one that is stale in a world is an error. A joint that
/// has broken in a world (or was removed from it) stands still: its angle and speed are 0, and [`Reading::JointHolds`] tells.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Reading {
    /// Place of the body's origin: world x, metres.
    PositionX(BodyId),
    /// The same along y.
    PositionY(BodyId),
    /// Angle, radians, -pi to pi.
    Angle(BodyId),
    /// Velocity of the centre of mass: world x, metres a second.
    VelocityX(BodyId),
    /// The same along y.
    VelocityY(BodyId),
    /// Radians a second.
    AngularVelocity(BodyId),
    /// 1 where the body is awake, else 0.
    Awake(BodyId),
    /// Bodies that it touches, contact by contact.
    Touching(BodyId),
    /// Angle of a joint's body B against A as the joint counts it ([`JointRef::angle`](tiny_physics::JointRef::angle)),
    /// radians, -pi to pi.
    JointAngle(JointId),
    /// Angular velocity of a joint's body B against A, radians a second.
    JointSpeed(JointId),
    /// Part of a ray until it enters a shape, 0 to 1; 1 where it meets nothing.
    Ray(Sight),
    /// 1 where the joint is there, 0 where it has broken.
    JointHolds(JointId),
}

impl Reading {
    /// Reads it from a copy of a template.
    pub(crate) fn read(&self, world: &World, template: &World) -> Result<f32, Error> {
        let body = |id: BodyId| world.body(id).ok_or_else(|| stale(id));
        Ok(match self {
            Self::PositionX(id) => body(*id)?.position().x,
            Self::PositionY(id) => body(*id)?.position().y,
            Self::Angle(id) => body(*id)?.angle(),
            Self::VelocityX(id) => body(*id)?.velocity().x,
            Self::VelocityY(id) => body(*id)?.velocity().y,
            Self::AngularVelocity(id) => body(*id)?.angular_velocity(),
            Self::Awake(id) => f32::from(u8::from(body(*id)?.is_awake())),
            Self::Touching(id) => {
                body(*id)?;
                world.contacts().filter(|c| c.body_a == *id || c.body_b == *id).count() as f32
            }
            Self::JointAngle(id) | Self::JointSpeed(id) | Self::JointHolds(id)
                if is_lost(world, template, *id) =>
            {
                0.0
            }
            Self::JointAngle(id) => joint_motion(world, *id)?.0,
            Self::JointSpeed(id) => joint_motion(world, *id)?.1,
            Self::JointHolds(id) => joint_motion(world, *id).map(|_| 1.0)?,
            Self::Ray(sight) => sight.look(world)?.map_or(1.0, |hit| hit.fraction),
        })
    }
}

fn stale(handle: impl core::fmt::Debug) -> Error {
    Error::StaleHandle { handle: format!("{handle:?}") }
}

/// Has a copy lost a joint that its template has?
pub(crate) fn is_lost(world: &World, template: &World, joint: JointId) -> bool {
    world.joint(joint).is_none() && template.joint(joint).is_some()
}

/// Angle (radians) and angular speed (radians a second) of a joint's body B against A, as the joint counts them.
pub(crate) fn joint_motion(world: &World, joint: JointId) -> Result<(f32, f32), Error> {
    let joint = world.joint(joint).ok_or_else(|| stale(joint))?;
    Ok((joint.angle(), joint.angular_speed()))
}
