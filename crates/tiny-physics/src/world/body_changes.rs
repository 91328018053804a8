//! Changing what a body is while the world runs: kind, mass, locks, sleep; and targets for platforms.

use super::World;
use super::bodies::{Body, BodyMut, are_acceptable};
use super::descriptions::{check_center, check_given};
use super::ids::{BodyId, JointId};
use crate::describe::{BodyKind, Locks};
use crate::dynamics::{Given, GivenPoint, NULL, PLAIN};
use crate::error::Error;
use crate::math::{Pose, Vec2};
use crate::work;
use core::f32::consts::TAU;

impl<'a> Body<'a> {
    /// Handles of its joints, the newest first.
    pub fn joints(&self) -> impl Iterator<Item = JointId> + use<'a> {
        let world = self.world;
        world.state.joints_of(self.index).map(|(i, _)| world.joint_id(i))
    }

    /// Its frame between the start (`alpha` 0) and the end (1) of the last step, for drawing at a rate of its
    /// own: see [`FixedStep::alpha`](crate::FixedStep::alpha). The end where it did not move in the step or
    /// was placed by the user since.
    pub fn interpolated_pose(&self, alpha: f32) -> Pose {
        let i = self.index as usize;
        let (start, end) = (self.world.state.bodies.previous[i], self.world.state.bodies.poses[i]);
        let alpha = if alpha.is_finite() { alpha.clamp(0.0, 1.0) } else { 1.0 };
        if alpha == 1.0 {
            return self.pose();
        }
        let center = start.p + (end.p - start.p) * f64::from(alpha);
        let part = end.q.angle_from(start.q);
        let turn = part + self.turns_of_last_step() as f32 * TAU;
        let rotation = start.q.integrate(turn * alpha);
        Pose::new(center - rotation.rotate(self.local_center()), rotation)
    }
}

impl Body<'_> {
    /// Whole turns that it made in the last step besides the part of one that its poses tell: as many as its angular
    /// velocity made before anybody set another.
    pub(super) fn turns_of_last_step(&self) -> i32 {
        let (World { state, last, .. }, i) = (self.world, self.index as usize);
        let part = state.bodies.poses[i].q.angle_from(state.bodies.previous[i].q);
        if part == 0.0 {
            return 0;
        }
        let known = last.turns.iter().find(|(body, _)| *body == self.index);
        let turns = || (self.angular_velocity() * self.world.last_dt() - part) / TAU;
        known.map_or_else(|| turns().round() as i32, |known| known.1)
    }
}

impl BodyMut<'_> {
    /// Changes what moves it. Its contacts begin anew; a body that becomes static stops.
    pub fn set_kind(&mut self, kind: BodyKind) {
        if self.info().kind == kind {
            return;
        }
        let (world, index) = (&mut *self.world, self.index);
        world.take_out(index);
        world.state.bodies.infos[index as usize].kind = kind;
        world.state.bodies.set_pace(index, PLAIN as u8);
        if kind == BodyKind::Static {
            world.state.bodies.set_velocity(index, Vec2::ZERO);
            world.state.bodies.set_angular_velocity(index, 0.0);
        }
        world.update_mass(index);
        world.put_in(index);
    }

    /// Takes it out of the simulation, with its shapes and joints, or puts it back. A body that is not enabled
    /// keeps its place and velocity; nothing touches or sees it.
    pub fn set_enabled(&mut self, enabled: bool) {
        if self.info().enabled == enabled {
            return;
        }
        let (world, index) = (&mut *self.world, self.index);
        world.take_out(index);
        world.state.bodies.infos[index as usize].enabled = enabled;
        world.put_in(index);
    }

    /// Sets the directions in which it cannot move. Wakes it.
    pub fn set_locks(&mut self, locks: Locks) {
        if self.change(&[], |info| info.locks = locks) {
            self.world.state.bodies.update_inverse_masses(self.index);
            self.world.refresh_joints(self.index);
        }
    }

    /// Sets whether its island may fall asleep. Wakes it where not.
    pub fn set_can_sleep(&mut self, can_sleep: bool) {
        let changes = core::mem::replace(&mut self.info().can_sleep, can_sleep) != can_sleep;
        if changes && !can_sleep {
            self.accept(&[]);
        }
    }

    /// Sets the speed below which it counts as at rest, metres a second; negative counts as 0.
    pub fn set_sleep_speed(&mut self, speed: f32) {
        let limited = if speed <= 0.0 { 0.0 } else { speed };
        self.change(&[speed], |info| info.sleep_speed = limited);
    }

    /// Sets the mass in kilograms; the moment of inertia follows in proportion. `None` takes both from the
    /// densities of the shapes. Wakes it.
    ///
    /// # Errors
    /// The mass is not finite, or outside of 1e-9 to 1e12.
    pub fn set_mass(&mut self, mass: Option<f32>) -> Result<(), Error> {
        check_given("mass", mass)?;
        if self.change(&[], |info| info.fixed_mass = Given::new(mass)) {
            self.world.update_mass(self.index);
        }
        Ok(())
    }

    /// Sets the centre of mass in the body's frame, metres; the body stays where it is. `None` takes it from the
    /// shapes. Wakes it.
    ///
    /// # Errors
    /// The point is not finite or beyond 1e6.
    pub fn set_center(&mut self, center: Option<Vec2>) -> Result<(), Error> {
        check_center(center)?;
        if self.change(&[], |info| info.fixed_center = GivenPoint::new(center)) {
            self.world.update_mass(self.index);
        }
        Ok(())
    }

    /// Sets the moment of inertia about the centre of mass, kilogram square metres. `None` takes it from the shapes and
    /// the mass. Wakes it.
    ///
    /// # Errors
    /// It is not finite, or outside of 1e-9 to 1e12.
    pub fn set_inertia(&mut self, inertia: Option<f32>) -> Result<(), Error> {
        check_given("inertia", inertia)?;
        if self.change(&[], |info| info.fixed_inertia = Given::new(inertia)) {
            self.world.update_mass(self.index);
        }
        Ok(())
    }

    /// Gives it the velocity that takes its frame to `target` within `dt` seconds: for moving platforms. It
    /// goes on at that velocity afterwards, so call this before every step. A platform that is at its target
    /// and stands still may fall asleep. Nothing happens to a static body, or where a number makes no sense.
    /// No step takes it faster than [`Settings::max_speed`](crate::Settings): what is further than that allows
    /// stays behind, without an error. Go there in several steps, raise that speed, or set the pose where nothing is to be
    /// pushed on the way.
    ///
    /// ```
    /// use tiny_physics::{RigidBody, Shape, Transform, Vec2, World};
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new(Vec2::new(0.0, -10.0));
    /// let lift = world.add_body(RigidBody::kinematic().shape(Shape::rect(2.0, 0.2)?))?;
    /// let target = Transform::from_angle(Vec2::new(0.5, 0.25), 0.1);
    /// world.body_mut(lift).unwrap().set_target(target, 1.0 / 60.0);
    /// world.step(1.0 / 60.0);
    /// let pose = world.body(lift).unwrap().pose();
    /// assert!((pose.to_transform().p - target.p).length() < 1e-5);
    /// # Ok(())
    /// # }
    /// ```
    pub fn set_target(&mut self, target: impl Into<Pose>, dt: f32) {
        let target: Pose = target.into();
        if !target.is_finite() || !dt.is_finite() || dt <= 0.0 {
            return self.world.refuse();
        }
        let body = self.as_ref();
        let rotation = target.q.normalized();
        let end = target.p + rotation.rotate(body.local_center());
        let velocity = end.relative_to(body.center()) * (1.0 / dt);
        let turn = rotation.angle_from(body.rotation());
        // What rounding leaves may turn it by so little that it is left again.
        let spin = if turn.abs() <= 4.0 * f32::EPSILON { 0.0 } else { turn * (1.0 / dt) };
        let rests = velocity == Vec2::ZERO && spin == 0.0;
        let rested = body.velocity() == Vec2::ZERO && body.angular_velocity() == 0.0;
        if !are_acceptable(&[velocity.x, velocity.y, spin]) {
            return self.world.refuse();
        }
        if !(rests && rested) {
            self.set_velocity(velocity);
            self.set_angular_velocity(spin);
        }
    }
}

impl World {
    /// Takes a body out of the simulation: contacts, lanes of joints, leaves, the awake list. What touched it
    /// or was joined to it wakes. [`World::put_in`] is the way back.
    fn take_out(&mut self, index: u32) {
        self.keep_moved(index);
        self.wake_index(index);
        self.destroy_contacts_of(index, |_, _| true);
        for (joint, partner) in self.joints_and_partners(index) {
            self.wake_index(partner);
            self.state.displace_joint(joint);
        }
        self.note_ground_of(index);
        self.mark_shapes_changed(index);
        for shape in self.shapes_of(index) {
            self.state.shapes.set_touched(shape, 0);
            self.state.broad_phase.destroy_proxy(self.state.shapes.proxy(shape));
            self.state.shapes.records[shape as usize].proxy = NULL;
        }
        self.state.waiting.stale = true;
        let bodies = &mut self.state.bodies;
        bodies.infos[index as usize].awake = false;
        bodies.previous[index as usize] = bodies.poses[index as usize];
        bodies.remove_awake(index);
    }

    /// Puts a body back that was taken out, awake if it can be; does nothing to one that is not enabled.
    fn put_in(&mut self, index: u32) {
        let info = &mut self.state.bodies.infos[index as usize];
        if !info.enabled {
            return;
        }
        info.sleep_time = 0.0;
        info.island_next = NULL;
        (info.force, info.torque) = (Vec2::ZERO, 0.0);
        if info.kind != BodyKind::Static {
            info.awake = true;
            self.state.bodies.push_awake(index);
        }
        self.create_proxies(index);
        self.mark_shapes_changed(index);
        for (joint, partner) in self.joints_and_partners(index) {
            let awake = |body: u32| self.state.bodies.infos[body as usize].awake;
            if awake(index) || awake(partner) {
                self.wake_index(partner);
                self.state.place_joint(joint);
            }
        }
    }

    /// The joints of a body that do anything, with the body at the other end, ascending.
    pub(super) fn joints_and_partners(&self, body: u32) -> Vec<(u32, u32)> {
        let joints = self.state.joints_of(body).filter(|(_, joint)| joint.class().is_some());
        let mut joints: Vec<(u32, u32)> = joints.map(|(i, joint)| (i, joint.other(body))).collect();
        joints.sort_unstable();
        joints
    }

    /// Indices of the shapes of a body.
    pub(super) fn shapes_of(&self, body: u32) -> Vec<u32> {
        self.state.shapes_of(body).collect()
    }

    /// Handles of the bodies whose pose the last step changed, those that fell asleep in it included. What the
    /// user placed, and what stood still, is not among them. In index order but for bodies that woke in the
    /// step, which come last, and those that have been put to sleep, taken out or made another kind since.
    ///
    /// The list is made when it is first asked for after a step, and stays until the next one: a step costs
    /// nothing more where nobody asks. What was removed before is not in it; handles of what is removed
    /// later are stale.
    pub fn moved_bodies(&self) -> &[BodyId] {
        &self.moved_lists()[0]
    }

    /// Those, and the kinematic ones of them in index order.
    pub(super) fn moved_lists(&self) -> &[Vec<BodyId>; 2] {
        self.moved.get_or_init(|| {
            let before = self.last.put_asleep as usize;
            let asleep = self.state.events.fell_asleep.iter().skip(before).copied();
            let asleep = asleep.filter(|&id| self.body(id).is_some_and(|body| !body.is_awake()));
            let taken = self.last.moved.iter().copied().filter(|&id| self.body(id).is_some());
            let bodies = &self.state.bodies;
            let moved = |&&i: &&u32| bodies.poses[i as usize] != bodies.previous[i as usize];
            let awake = bodies.awake.iter().inspect(|_| work::note());
            let awake = awake.filter(moved).map(|&i| self.body_id(i));
            let all: Vec<BodyId> = awake.chain(asleep).chain(taken).collect();
            let is_machine = |id: &BodyId| bodies.infos[id.index()].kind == BodyKind::Kinematic;
            let mut machines: Vec<BodyId> = all.iter().copied().filter(is_machine).collect();
            machines.sort_unstable();
            [all, machines]
        })
    }
}
