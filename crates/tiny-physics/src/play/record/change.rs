//! Commands to one body or one shape.

use crate::{
    BodyKind, BodyMut, DVec2, Error, Filter, Locks, Material, Pose, Shape, ShapeMut, Vec2, Wind,
};

/// Something that is done to a body, named after the function of [`BodyMut`] that does it.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
#[non_exhaustive]
pub enum BodyCommand {
    /// [`BodyMut::set_position`].
    SetPosition(DVec2),
    /// [`BodyMut::set_angle`].
    SetAngle(f32),
    /// [`BodyMut::set_pose`].
    SetPose(Pose),
    /// [`BodyMut::set_velocity`].
    SetVelocity(Vec2),
    /// [`BodyMut::set_angular_velocity`].
    SetAngularVelocity(f32),
    /// [`BodyMut::set_target`]: where to, and within how many seconds.
    SetTarget(Pose, f32),
    /// [`BodyMut::apply_force`]: newtons, and the point.
    ApplyForce(Vec2, DVec2),
    /// [`BodyMut::apply_force_to_center`].
    ApplyForceToCenter(Vec2),
    /// [`BodyMut::apply_torque`].
    ApplyTorque(f32),
    /// [`BodyMut::apply_impulse`]: newton seconds, and the point.
    ApplyImpulse(Vec2, DVec2),
    /// [`BodyMut::apply_impulse_to_center`].
    ApplyImpulseToCenter(Vec2),
    /// [`BodyMut::apply_angular_impulse`].
    ApplyAngularImpulse(f32),
    /// [`BodyMut::apply_wind`]: the wind, and the length of the next step.
    ApplyWind(Wind, f32),
    /// [`BodyMut::wake`].
    Wake,
    /// [`BodyMut::sleep`].
    Sleep,
    /// [`BodyMut::set_kind`].
    SetKind(BodyKind),
    /// [`BodyMut::set_enabled`].
    SetEnabled(bool),
    /// [`BodyMut::set_locks`].
    SetLocks(Locks),
    /// [`BodyMut::set_mass`].
    SetMass(Option<f32>),
    /// [`BodyMut::set_center`].
    SetCenter(Option<Vec2>),
    /// [`BodyMut::set_inertia`].
    SetInertia(Option<f32>),
    /// [`BodyMut::set_gravity_scale`].
    SetGravityScale(f32),
    /// [`BodyMut::set_damping`]: linear and angular.
    SetDamping(f32, f32),
    /// [`BodyMut::set_can_sleep`].
    SetCanSleep(bool),
    /// [`BodyMut::set_sleep_speed`].
    SetSleepSpeed(f32),
    /// [`BodyMut::set_bullet`].
    SetBullet(bool),
    /// [`BodyMut::set_user_data`].
    SetUserData(u64),
}

impl BodyCommand {
    /// Does it to a body.
    pub(super) fn apply(&self, body: &mut BodyMut<'_>) -> Result<(), Error> {
        match *self {
            Self::SetPosition(position) => body.set_position(position),
            Self::SetAngle(radians) => body.set_angle(radians),
            Self::SetPose(pose) => body.set_pose(pose),
            Self::SetVelocity(velocity) => body.set_velocity(velocity),
            Self::SetAngularVelocity(speed) => body.set_angular_velocity(speed),
            Self::SetTarget(target, dt) => body.set_target(target, dt),
            Self::ApplyForce(force, point) => body.apply_force(force, point),
            Self::ApplyForceToCenter(force) => body.apply_force_to_center(force),
            Self::ApplyTorque(torque) => body.apply_torque(torque),
            Self::ApplyImpulse(impulse, point) => body.apply_impulse(impulse, point),
            Self::ApplyImpulseToCenter(impulse) => body.apply_impulse_to_center(impulse),
            Self::ApplyAngularImpulse(impulse) => body.apply_angular_impulse(impulse),
            Self::ApplyWind(wind, dt) => body.apply_wind(&wind, dt),
            Self::Wake => body.wake(),
            Self::Sleep => body.sleep(),
            Self::SetKind(kind) => body.set_kind(kind),
            Self::SetEnabled(enabled) => body.set_enabled(enabled),
            Self::SetLocks(locks) => body.set_locks(locks),
            Self::SetMass(mass) => return body.set_mass(mass),
            Self::SetCenter(center) => return body.set_center(center),
            Self::SetInertia(inertia) => return body.set_inertia(inertia),
            Self::SetGravityScale(scale) => body.set_gravity_scale(scale),
            Self::SetDamping(linear, angular) => body.set_damping(linear, angular),
            Self::SetCanSleep(can_sleep) => body.set_can_sleep(can_sleep),
            Self::SetSleepSpeed(speed) => body.set_sleep_speed(speed),
            Self::SetBullet(bullet) => body.set_bullet(bullet),
            Self::SetUserData(data) => body.set_user_data(data),
        }
        Ok(())
    }
}

/// Something that is done to a shape, named after the function of [`ShapeMut`] that does it.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
#[non_exhaustive]
pub enum ShapeCommand {
    /// [`ShapeMut::set_shape`].
    SetShape(Shape),
    /// [`ShapeMut::set_local`]: offset and angle.
    SetLocal(Vec2, f32),
    /// [`ShapeMut::set_material`].
    SetMaterial(Material),
    /// [`ShapeMut::set_filter`].
    SetFilter(Filter),
    /// [`ShapeMut::set_sensor`].
    SetSensor(bool),
    /// [`ShapeMut::set_one_way`].
    SetOneWay(Option<Vec2>),
    /// [`ShapeMut::set_events`]: contact and hit events.
    SetEvents(bool, bool),
    /// [`ShapeMut::set_user_data`].
    SetUserData(u64),
}

impl ShapeCommand {
    /// Does it to a shape.
    pub(super) fn apply(&self, shape: &mut ShapeMut<'_>) -> Result<(), Error> {
        match *self {
            Self::SetShape(geometry) => return shape.set_shape(geometry),
            Self::SetLocal(offset, angle) => return shape.set_local(offset, angle),
            Self::SetMaterial(material) => return shape.set_material(material),
            Self::SetFilter(filter) => shape.set_filter(filter),
            Self::SetSensor(sensor) => shape.set_sensor(sensor),
            Self::SetOneWay(direction) => return shape.set_one_way(direction),
            Self::SetEvents(contact, hit) => shape.set_events(contact, hit),
            Self::SetUserData(data) => shape.set_user_data(data),
        }
        Ok(())
    }
}
