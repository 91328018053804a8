//! Bodies as the user sees them.

use super::World;
use super::contacts::ContactView;
use super::descriptions::MAX_COORDINATE;
use super::ids::{BodyId, ShapeId};
use super::state::State;
use crate::describe::BodyKind;
use crate::dynamics::{BodyInfo, NULL};
use crate::math::{DVec2, Pose, Rot, Vec2};
use crate::stages::sleep;

/// Velocities, forces, impulses beyond this are refused, in any unit.
const MAX_NUMBER: f32 = 1.0e15;

/// Are they neither too large nor something else than numbers?
pub(super) fn are_acceptable(numbers: &[f32]) -> bool {
    numbers.iter().all(|number| number.abs() <= MAX_NUMBER)
}

/// A body of the world, to read.
#[derive(Clone, Copy)]
pub struct Body<'a> {
    pub(super) world: &'a World,
    pub(super) index: u32,
}

impl<'a> Body<'a> {
    pub(super) fn info(&self) -> &'a BodyInfo {
        &self.world.state.bodies.infos[self.index as usize]
    }

    /// The world that it is in.
    pub fn world(&self) -> &'a World {
        self.world
    }

    /// Velocity of a point of the body, metres a second.
    pub fn velocity_at(&self, point: impl Into<DVec2>) -> Vec2 {
        let arm = point.into().relative_to(self.center());
        self.velocity() + arm.perp() * self.angular_velocity()
    }

    /// Its contacts that touch (or are about to) as of the last step, the newest first. None while it
    /// sleeps; of a floor, none with what sleeps on it.
    pub fn contacts(&self) -> impl Iterator<Item = ContactView> + use<'a> {
        let world = self.world;
        world.state.contacts_of(self.index).filter_map(|(i, _)| world.contact_view(i))
    }

    /// Handles of its shapes, in the order in which it was described; later ones first.
    pub fn shapes(&self) -> impl Iterator<Item = ShapeId> + use<'a> {
        let world = self.world;
        world.state.shapes_of(self.index).map(|i| world.shape_id(i))
    }
}

/// A body of the world, to change. What may move it wakes it and its island; a property that is the same already changes
/// nothing. Numbers that are not finite, or so large that calculating with them would leave 32 bits, are refused by doing
/// nothing.
pub struct BodyMut<'a> {
    pub(super) world: &'a mut World,
    pub(super) index: u32,
}

impl BodyMut<'_> {
    /// The body, to read.
    pub fn as_ref(&self) -> Body<'_> {
        Body { world: self.world, index: self.index }
    }

    pub(super) fn info(&mut self) -> &mut BodyInfo {
        &mut self.world.state.bodies.infos[self.index as usize]
    }

    /// Counts a call that a number was refused in.
    pub(crate) fn refuse(&mut self) {
        self.world.refuse();
    }

    /// Wakes it if all numbers are acceptable, and says whether to go on.
    pub(super) fn accept(&mut self, numbers: &[f32]) -> bool {
        let acceptable = are_acceptable(numbers);
        if acceptable {
            self.world.stats.pushes += u64::from(!numbers.is_empty());
            self.world.wake_index(self.index);
        } else {
            self.world.refuse();
        }
        acceptable
    }

    /// Changes what is known of it, which wakes it, and says whether that has changed: what is the same already changes nothing.
    pub(super) fn change(&mut self, numbers: &[f32], change: impl Fn(&mut BodyInfo)) -> bool {
        let mut new = *self.info();
        change(&mut new);
        let changes = new != *self.info() && self.accept(numbers);
        if changes {
            change(self.info());
        }
        changes
    }

    /// Does the solver move it?
    fn is_dynamic(&self) -> bool {
        self.world.state.bodies.is_dynamic(self.index)
    }

    /// Puts the origin of its frame somewhere else at once. It touches nothing on the way.
    pub fn set_position(&mut self, position: impl Into<DVec2>) {
        let rotation = self.as_ref().rotation();
        self.set_pose(Pose::new(position.into(), rotation));
    }

    /// Turns its frame at once, radians.
    pub fn set_angle(&mut self, radians: f32) {
        if radians.is_finite() {
            let position = self.as_ref().position_f64();
            self.set_pose(Pose::new(position, Rot::from_angle(radians)));
        } else {
            self.world.refuse();
        }
    }

    /// Puts its frame somewhere else at once. Where it is already, nothing wakes.
    pub fn set_pose(&mut self, pose: Pose) {
        let (x, y) = (pose.p.x.abs(), pose.p.y.abs());
        if !pose.is_finite() || x > MAX_COORDINATE || y > MAX_COORDINATE {
            return self.world.refuse();
        }
        let (world, index) = (&mut *self.world, self.index);
        let bodies = &mut world.state.bodies;
        let (old, read) = (bodies.poses[index as usize], bodies.origin_pose(index));
        let q = if pose.q == old.q { pose.q } else { pose.q.normalized() };
        // As it was set, or as it was read.
        if bodies.pose_of_origin(index, pose.p, q) == old || (pose.p, q) == (read.p, old.q) {
            bodies.previous[index as usize] = bodies.poses[index as usize];
            return;
        }
        world.wake_index(index);
        world.wake_carried(index);
        world.note_ground_of(index);
        world.state.bodies.set_origin_pose(index, pose.p, q);
        world.state.bodies.infos[index as usize].calm = 0;
        world.state.bodies.disturb(index);
        world.mark_shapes_changed(index);
        world.update_boxes(index);
        world.note_ground_of(index);
    }

    /// Sets the velocity of the centre of mass, metres a second. Nothing happens to a static body.
    pub fn set_velocity(&mut self, velocity: impl Into<Vec2>) {
        let turning = self.as_ref().angular_velocity();
        self.give_velocity(velocity.into(), turning);
    }

    /// Sets the angular velocity, radians a second. Nothing happens to a static body.
    pub fn set_angular_velocity(&mut self, radians_per_second: f32) {
        let velocity = self.as_ref().velocity();
        self.give_velocity(velocity, radians_per_second);
    }

    /// Gives it velocities. Where they are as they were, nothing wakes; a platform that begins to move wakes what touches it.
    fn give_velocity(&mut self, velocity: Vec2, turning: f32) {
        let (body, index) = (self.as_ref(), self.index);
        let before = (body.velocity(), body.angular_velocity());
        let (kind, changes) = (body.kind(), (velocity, turning) != before);
        let numbers = [velocity.x, velocity.y, turning];
        if kind == BodyKind::Static || !changes || !self.accept(&numbers) {
            return;
        }
        if kind == BodyKind::Kinematic && before == (Vec2::ZERO, 0.0) {
            self.world.wake_neighbours(index);
        }
        if turning != before.1 {
            let turns = self.as_ref().turns_of_last_step();
            self.world.state.bodies.set_angular_velocity(index, turning);
            if self.as_ref().turns_of_last_step() != turns {
                self.world.last.turns.push((index, turns));
            }
        }
        let bodies = &mut self.world.state.bodies;
        bodies.set_velocity(index, velocity);
        bodies.disturb(index);
    }

    /// Applies a force in newtons at a world point, during the next step.
    pub fn apply_force(&mut self, force: impl Into<Vec2>, point: impl Into<DVec2>) {
        let force = force.into();
        let arm = point.into().relative_to(self.as_ref().center());
        let torque = arm.cross(force);
        self.apply_forces(force, torque);
    }

    /// Applies a force in newtons at the centre of mass, during the next step.
    pub fn apply_force_to_center(&mut self, force: impl Into<Vec2>) {
        self.apply_forces(force.into(), 0.0);
    }

    /// Applies a torque in newton metres during the next step.
    pub fn apply_torque(&mut self, torque: f32) {
        self.apply_forces(Vec2::ZERO, torque);
    }

    fn apply_forces(&mut self, force: Vec2, torque: f32) {
        let acts = (force, torque) != (Vec2::ZERO, 0.0) && self.is_dynamic();
        let info = self.info();
        let (force, torque) = (info.force + force, info.torque + torque);
        if acts && self.accept(&[force.x, force.y, torque]) {
            let info = self.info();
            (info.force, info.torque) = (force, torque);
            self.set_rest((0.0, 0));
        }
    }

    /// How long it has rested, seconds, and how often it has swung: what acts on it from outside is no rest.
    pub(crate) fn rest(&mut self) -> (f32, u8) {
        (self.info().sleep_time, self.world.state.bodies.swings[self.index as usize])
    }

    /// The way back.
    pub(crate) fn set_rest(&mut self, (rested, swings): (f32, u8)) {
        self.info().sleep_time = rested;
        self.world.state.bodies.swings[self.index as usize] = swings;
    }

    /// Applies an impulse in newton seconds at a world point, at once.
    pub fn apply_impulse(&mut self, impulse: impl Into<Vec2>, point: impl Into<DVec2>) {
        let impulse = impulse.into();
        let arm = point.into().relative_to(self.as_ref().center());
        self.apply_impulses(impulse, arm.cross(impulse));
    }

    /// Applies an impulse in newton seconds at the centre of mass, at once.
    pub fn apply_impulse_to_center(&mut self, impulse: impl Into<Vec2>) {
        self.apply_impulses(impulse.into(), 0.0);
    }

    /// Applies an angular impulse in newton metre seconds, at once.
    pub fn apply_angular_impulse(&mut self, impulse: f32) {
        self.apply_impulses(Vec2::ZERO, impulse);
    }

    fn apply_impulses(&mut self, linear: Vec2, angular: f32) {
        let (index, bodies) = (self.index, &self.world.state.bodies);
        let [x, y, inv_inertia] = bodies.inverses(index);
        let velocity = bodies.velocity(index) + Vec2::new(linear.x * x, linear.y * y);
        let turning = bodies.angular_velocity(index) + angular * inv_inertia;
        if self.is_dynamic() {
            self.give_velocity(velocity, turning);
        }
    }

    /// Wakes it and its island.
    pub fn wake(&mut self) {
        self.world.wake_index(self.index);
    }

    /// Puts it to sleep with all that it touches or is joined to. What comes to touch them wakes them.
    /// Nothing happens while a kinematic body that is awake is among what they touch.
    pub fn sleep(&mut self) {
        if self.info().awake {
            let State { bodies, contacts, joints, .. } = &self.world.state;
            let island = sleep::island_of(self.index, bodies, contacts, joints);
            island.iter().filter(|&&i| i != NULL).for_each(|&i| self.world.keep_moved(i));
            self.world.put_to_sleep(&island);
            // Sensors have to look once more at what was fast.
            for &body in island.iter().filter(|&&body| body != NULL) {
                self.world.mark_shapes_changed(body);
            }
        }
    }

    /// Sets the factor on the world's gravity.
    pub fn set_gravity_scale(&mut self, scale: f32) {
        self.change(&[scale], |info| info.gravity_scale = scale);
    }

    /// Sets linear and angular damping, 1/s; negative values count as 0.
    pub fn set_damping(&mut self, linear: f32, angular: f32) {
        let limited = |damping: f32| if damping <= 0.0 { 0.0 } else { damping };
        self.change(&[linear, angular], |info| {
            (info.linear_damping, info.angular_damping) = (limited(linear), limited(angular));
        });
    }

    /// Sets a flag that is kept and given back, and changes nothing: see [`RigidBody::bullet`](crate::RigidBody::bullet).
    pub fn set_bullet(&mut self, bullet: bool) {
        self.info().bullet = bullet;
    }

    /// Sets the user's number.
    pub fn set_user_data(&mut self, data: u64) {
        self.info().user_data = data;
    }
}

/// Two bodies of one world, to change in turn.
///
/// ```
/// use tiny_physics::prelude::*;
/// # fn main() -> Result<(), tiny_physics::Error> {
/// let mut world = World::new((0.0, 0.0));
/// let ship = |x: f64| Ok::<_, Error>(RigidBody::dynamic().position((x, 0.0)).shape(Shape::circle(0.5)?).mass(2.0));
/// let (a, b) = (world.add_body(ship(-1.0)?)?, world.add_body(ship(1.0)?)?);
/// let mut pair = world.body_pair_mut(a, b).unwrap();
/// let pull = pair.b().position() - pair.a().position();
/// pair.a().apply_impulse_to_center(pull);
/// pair.b().apply_impulse_to_center(-pull);
/// assert_eq!(pair.a().velocity(), -pair.b().velocity());
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct BodyPair<'a> {
    world: &'a mut World,
    bodies: [u32; 2],
}

impl BodyPair<'_> {
    /// The first.
    pub fn a(&mut self) -> BodyMut<'_> {
        BodyMut { world: self.world, index: self.bodies[0] }
    }

    /// The second.
    pub fn b(&mut self) -> BodyMut<'_> {
        BodyMut { world: self.world, index: self.bodies[1] }
    }
}

impl World {
    /// Two bodies to change; `None` if one of them has been removed.
    pub fn body_pair_mut(&mut self, a: BodyId, b: BodyId) -> Option<BodyPair<'_>> {
        let bodies = [self.body_mut(a)?.index, self.body_mut(b)?.index];
        Some(BodyPair { world: self, bodies })
    }

    /// A body to read; `None` if it has been removed.
    pub fn body(&self, id: BodyId) -> Option<Body<'_>> {
        let index = self.body_index(id).ok()?;
        Some(Body { world: self, index })
    }

    /// A body to change; `None` if it has been removed.
    pub fn body_mut(&mut self, id: BodyId) -> Option<BodyMut<'_>> {
        let index = self.body_index(id).map_err(|_| self.stats.stale_handles += 1).ok()?;
        Some(BodyMut { world: self, index })
    }

    /// Handles of all bodies, in index order.
    pub fn body_ids(&self) -> impl Iterator<Item = BodyId> + '_ {
        self.state.bodies.indices().map(|index| self.body_id(index))
    }

    /// Kinetic energy of all bodies, joules.
    pub fn kinetic_energy(&self) -> f64 {
        let bodies = &self.state.bodies;
        let energy = |i: u32| {
            let (info, w) = (&bodies.infos[i as usize], f64::from(bodies.angular_velocity(i)));
            let linear = f64::from(info.mass) * f64::from(bodies.velocity(i).length_sq());
            0.5 * (linear + f64::from(info.inertia) * w * w)
        };
        bodies.indices().map(energy).sum()
    }

    /// Wakes the islands of bodies that touch this one or are near it: of what was put down asleep no step has seen which.
    pub(super) fn wake_neighbours(&mut self, index: u32) {
        let contacts = self.state.contacts_of(index).filter(|(_, contact)| self.is_close(contact));
        let others: Vec<u32> = contacts.map(|(_, contact)| contact.other(index)).collect();
        others.into_iter().for_each(|other| self.wake_index(other));
    }
}
