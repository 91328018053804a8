//! Commands to one body or one shape.

use super::Made;
use super::declare::{Outcome, commands, keep, part};
use crate::codec::{Data, Reader, Sink, bad};
use crate::{
    BodyKind, BodyMut, DVec2, Error, Filter, Locks, Material, Pose, Shape, ShapeMut, Vec2, Wind,
};

commands! {
    for body: BodyMut<'_>;

    /// Something that is done to a body, named after the function of [`BodyMut`] that does it.
    #[derive(Clone, Copy, PartialEq, Debug)]
    #[non_exhaustive]
    pub enum BodyCommand {
        /// [`BodyMut::set_position`].
        SetPosition(position: DVec2) = 0: body.set_position(*position),
        /// [`BodyMut::set_angle`].
        SetAngle(radians: f32) = 1: body.set_angle(*radians),
        /// [`BodyMut::set_pose`].
        SetPose(pose: Pose) = 2: body.set_pose(*pose),
        /// [`BodyMut::set_velocity`].
        SetVelocity(velocity: Vec2) = 3: body.set_velocity(*velocity),
        /// [`BodyMut::set_angular_velocity`].
        SetAngularVelocity(speed: f32) = 4: body.set_angular_velocity(*speed),
        /// [`BodyMut::set_target`]: where to, and within how many seconds.
        SetTarget(target: Pose, dt: f32) = 5: body.set_target(*target, *dt),
        /// [`BodyMut::apply_force`]: newtons, and the point.
        ApplyForce(force: Vec2, point: DVec2) = 6: body.apply_force(*force, *point),
        /// [`BodyMut::apply_force_to_center`].
        ApplyForceToCenter(force: Vec2) = 7: body.apply_force_to_center(*force),
        /// [`BodyMut::apply_torque`].
        ApplyTorque(torque: f32) = 8: body.apply_torque(*torque),
        /// [`BodyMut::apply_impulse`]: newton seconds, and the point.
        ApplyImpulse(impulse: Vec2, point: DVec2) = 9: body.apply_impulse(*impulse, *point),
        /// [`BodyMut::apply_impulse_to_center`].
        ApplyImpulseToCenter(impulse: Vec2) = 10: body.apply_impulse_to_center(*impulse),
        /// [`BodyMut::apply_angular_impulse`].
        ApplyAngularImpulse(impulse: f32) = 11: body.apply_angular_impulse(*impulse),
        /// [`BodyMut::apply_wind`]: the wind, and the length of the next step.
        ApplyWind(wind: Wind, dt: f32) = 12: body.apply_wind(wind, *dt),
        /// [`BodyMut::wake`].
        Wake = 13: body.wake(),
        /// [`BodyMut::sleep`].
        Sleep = 14: body.sleep(),
        /// [`BodyMut::set_kind`].
        SetKind(kind: BodyKind) = 15: body.set_kind(*kind),
        /// [`BodyMut::set_enabled`].
        SetEnabled(enabled: bool) = 16: body.set_enabled(*enabled),
        /// [`BodyMut::set_locks`].
        SetLocks(locks: Locks) = 17: body.set_locks(*locks),
        /// [`BodyMut::set_mass`].
        SetMass(mass: Option<f32>) = 18: body.set_mass(*mass),
        /// [`BodyMut::set_center`].
        SetCenter(center: Option<Vec2>) = 25: body.set_center(*center),
        /// [`BodyMut::set_inertia`].
        SetInertia(inertia: Option<f32>) = 26: body.set_inertia(*inertia),
        /// [`BodyMut::set_gravity_scale`].
        SetGravityScale(scale: f32) = 19: body.set_gravity_scale(*scale),
        /// [`BodyMut::set_damping`]: linear and angular.
        SetDamping(linear: f32, angular: f32) = 20: body.set_damping(*linear, *angular),
        /// [`BodyMut::set_can_sleep`].
        SetCanSleep(can_sleep: bool) = 21: body.set_can_sleep(*can_sleep),
        /// [`BodyMut::set_sleep_speed`].
        SetSleepSpeed(speed: f32) = 22: body.set_sleep_speed(*speed),
        /// [`BodyMut::set_bullet`].
        SetBullet(bullet: bool) = 23: body.set_bullet(*bullet),
        /// [`BodyMut::set_user_data`].
        SetUserData(data: u64) = 24: body.set_user_data(*data),
    }
}

commands! {
    for shape: ShapeMut<'_>;

    /// Something that is done to a shape, named after the function of [`ShapeMut`] that does it.
    #[derive(Clone, Copy, PartialEq, Debug)]
    #[non_exhaustive]
    pub enum ShapeCommand {
        /// [`ShapeMut::set_shape`].
        SetShape(geometry: Shape) = 0: shape.set_shape(*geometry),
        /// [`ShapeMut::set_local`]: offset and angle.
        SetLocal(offset: Vec2, angle: f32) = 1: shape.set_local(*offset, *angle),
        /// [`ShapeMut::set_material`].
        SetMaterial(material: Material) = 2: shape.set_material(*material),
        /// [`ShapeMut::set_filter`].
        SetFilter(filter: Filter) = 3: shape.set_filter(*filter),
        /// [`ShapeMut::set_sensor`].
        SetSensor(sensor: bool) = 4: shape.set_sensor(*sensor),
        /// [`ShapeMut::set_one_way`].
        SetOneWay(direction: Option<Vec2>) = 5: shape.set_one_way(*direction),
        /// [`ShapeMut::set_events`]: contact and hit events.
        SetEvents(contact: bool, hit: bool) = 6: shape.set_events(*contact, *hit),
        /// [`ShapeMut::set_user_data`].
        SetUserData(data: u64) = 7: shape.set_user_data(*data),
    }
}
