//! Joints of the world: adding, removing, changing, reading.

use super::World;
use super::events::JointBreak;
use super::ids::{BodyId, JointId};
use super::state::State;
use crate::describe::{BodyKind, JointDef, JointKind};
use crate::dynamics::{JointRecord, NULL, REFINEMENT};
use crate::error::Error;
use crate::math::{DVec2, Rot, Vec2};
use crate::stages::ahead::Held;
use crate::stages::joint_solver;
use crate::stages::passivity::may_drive;
use crate::stages::solve::Lengths;

impl World {
    /// Finds what forces and joints are about to set going; says whether there is any.
    pub(super) fn foresee(&mut self, lengths: Lengths) -> bool {
        let none = self.scratch.ways.forced.is_empty() && self.state.joints.driven.is_empty();
        if none || !self.settings.continuous {
            return false;
        }
        let mut predictions = core::mem::take(&mut self.scratch.predictions);
        let acting = (&self.state.bodies, &self.state.joints, &self.scratch.ways);
        let step = (lengths.dt, self.contact_reach());
        let any = predictions
            .foresee(acting, step, |index, turns| JointRef::new(self, index).held(turns));
        self.scratch.predictions = predictions;
        any
    }
}

/// A joint of the world, to read.
#[derive(Clone, Copy)]
pub struct JointRef<'a> {
    pub(super) world: &'a World,
    pub(super) record: &'a JointRecord,
    pub(super) index: u32,
}

impl<'a> JointRef<'a> {
    pub(super) fn new(world: &'a World, index: u32) -> Self {
        Self { world, record: &world.state.joints.records[index as usize], index }
    }

    /// What it does.
    pub fn def(&self) -> &'a JointDef {
        &self.record.def
    }

    /// Its anchors on A and B: world, metres.
    pub fn anchors(&self) -> (DVec2, DVec2) {
        self.record.anchors(&self.world.state.bodies)
    }

    /// B's angle against A's as the joint counts it, radians in [-pi, pi]: see [`JointDef::angle_a`].
    pub fn angle(&self) -> f32 {
        let JointDef { angle_a, angle_b, .. } = self.record.def;
        let turned = |body: u32, by: f32| {
            self.world.state.bodies.poses[body as usize].q.compose(Rot::from_angle(by))
        };
        turned(self.record.body_b, angle_b).angle_from(turned(self.record.body_a, angle_a))
    }

    /// How fast its angle grows, radians a second.
    pub fn angular_speed(&self) -> f32 {
        let speed = |body: u32| self.world.state.bodies.angular_velocity(body);
        speed(self.record.body_b) - speed(self.record.body_a)
    }

    /// Of a slider or a wheel, how far anchor B is from anchor A along the joint's direction, metres. Of other joints,
    /// the distance of the anchors; of a mouse joint, that to its target.
    pub fn translation(&self) -> f32 {
        let (direction, gap) = self.record.line(&self.world.state.bodies);
        direction.dot(gap)
    }

    /// How fast [`JointRef::translation`] grows, metres a second.
    pub fn speed(&self) -> f32 {
        let ((direction, gap), (at_a, at_b)) =
            (self.record.line(&self.world.state.bodies), self.anchors());
        let (a, b) = self.bodies();
        let velocity = |body, at| self.world.body(body).map_or(Vec2::ZERO, |b| b.velocity_at(at));
        match self.record.def.kind {
            JointKind::Mouse { .. } => -velocity(b, at_b).dot(direction),
            // The line turns with A; that of two anchors turns as they go, which does not lengthen it.
            _ => {
                let spin = self.world.state.bodies.angular_velocity(self.record.body_a);
                let apart = velocity(b, at_b) - velocity(a, at_a);
                apart.dot(direction) + spin * direction.perp().dot(gap)
            }
        }
    }

    /// Force (newtons) or torque (newton metres) that the motor exerted on B in the last step, positive the way that
    /// positive speeds go; of a [`JointKind::Motor`] the torque. 0 without a motor and while it sleeps.
    pub fn motor_load(&self) -> f32 {
        self.impulse_a_second(match self.record.def.kind {
            JointKind::Wheel { .. } => 1,
            JointKind::Distance { .. } => 2,
            JointKind::Revolute { .. } | JointKind::Prismatic { .. } => 3,
            JointKind::Motor { .. } => 5,
            _ => return 0.0,
        })
    }

    fn impulse_a_second(&self, place: usize) -> f32 {
        let graph = &self.world.state.joint_graph;
        let per_second = self.world.state.inv_h * REFINEMENT[graph.pace_of(self.record)] as f32;
        graph.impulses(self.record)[place] * per_second
    }

    /// What it did in the last step, in turning or not, if one of its bodies presses on something: then that goes no faster soon.
    fn held(&self, turns: bool) -> Option<Held> {
        let State { bodies, contacts, graph, .. } = &self.world.state;
        let pushes = |body: u32| {
            let mut of_body = contacts.of_body(bodies.infos[body as usize].first_contact);
            bodies.is_dynamic(body)
                && of_body.any(|(index, _)| graph.impulse(&contacts.records[index as usize]) > 0.0)
        };
        let (spring, motor) = match self.record.def.kind {
            JointKind::Motor { .. } | JointKind::Mouse { .. } | JointKind::Weld { .. }
                if !turns =>
            {
                let force = self.force().length();
                (-force, force)
            }
            JointKind::Distance { .. } => (self.impulse_a_second(1), self.motor_load()),
            _ => (self.impulse_a_second(2), self.motor_load()),
        };
        let held = Held { spring, motor };
        (pushes(self.record.body_a) || pushes(self.record.body_b)).then_some(held)
    }

    /// Force on body B in the last step, newtons. The opposite acts on A, but for pulleys, whose rope pulls A its own way, and
    /// mouse joints, which pull B alone. Zero while it sleeps.
    pub fn force(&self) -> Vec2 {
        self.load().force
    }

    /// Torque on body B in the last step, newton metres. The opposite acts on A, but for gears: there it is this over the
    /// ratio. Zero while it sleeps.
    pub fn torque(&self) -> f32 {
        self.load().torque
    }

    fn load(&self) -> crate::dynamics::JointLoad {
        let (graph, joints) = (&self.world.state.joint_graph, &self.world.state.joints);
        joint_solver::load(graph, joints, self.index, self.world.state.inv_h)
    }
}

impl World {
    /// Joins two bodies. Contacts between them end unless [`JointDef::collide_connected`] is set. Where one of them is awake,
    /// both are then; two that sleep sleep on, so that a level can be built asleep: [`BodyMut::wake`](super::BodyMut::wake) what is to move.
    /// What a motor, a spring or a mouse joint moves against something that is not dynamic wakes.
    ///
    /// # Errors
    /// A handle is stale, the bodies are the same one, or a number in the description is out of range.
    pub fn add_joint(&mut self, a: BodyId, b: BodyId, def: JointDef) -> Result<JointId, Error> {
        let (a, b) = (self.body_index(a)?, self.body_index(b)?);
        if a == b {
            return Err(Error::Unsupported { reason: "a joint needs two different bodies" });
        }
        let def = self.place_joint(a, b, def)?;
        let awake = |world: &Self, i: u32| world.state.bodies.infos[i as usize].awake;
        let one_stands = [a, b].iter().any(|&i| !self.state.bodies.is_dynamic(i));
        let drives = def.enabled && def.kind.drives() && one_stands;
        if awake(self, a) || awake(self, b) || drives {
            self.wake_index(a);
            self.wake_index(b);
        }
        let record = JointRecord::new(a, b, def);
        let index = self.state.joints.insert(&mut self.state.bodies, record);
        if awake(self, a) || awake(self, b) {
            self.state.place_joint(index);
        }
        if !def.collide_connected && def.enabled {
            self.part_bodies(a, b);
        }
        Ok(self.joint_id(index))
    }

    /// Removes a joint. Its bodies wake.
    ///
    /// # Errors
    /// The handle is stale.
    pub fn remove_joint(&mut self, id: JointId) -> Result<(), Error> {
        let index = self.joint_index(id)?;
        self.destroy_joint(index);
        Ok(())
    }

    /// Gives a joint another description: motor speeds, limits, springs, even another kind. Its bodies
    /// wake; impulses live on unless the kind is another. What is the same already changes nothing.
    ///
    /// # Errors
    /// The handle is stale, or a number in the description is out of range.
    pub fn set_joint(&mut self, id: JointId, def: JointDef) -> Result<(), Error> {
        let index = self.joint_index(id)?;
        let record = &self.state.joints.records[index as usize];
        let (a, b, before) = (record.body_a, record.body_b, record.def);
        let def = self.place_joint(a, b, def)?;
        if def == before {
            return Ok(());
        }
        self.stats.pushes += 1;
        self.wake_index(a);
        self.wake_index(b);
        self.state.joint_graph.update(&mut self.state.bodies, &mut self.state.joints, index, &def);
        if may_drive(&before) != may_drive(&def) {
            self.state.graph.news = self.state.graph.news.saturating_add(1);
        }
        if self.state.bodies.infos[a as usize].awake || self.state.bodies.infos[b as usize].awake {
            self.state.place_joint(index);
        }
        let parts = |def: &JointDef| def.enabled && !def.collide_connected;
        match (parts(&before), parts(&def)) {
            (true, false) => self.buffer_shapes(self.smaller(a, b)),
            (false, true) => self.part_bodies(a, b),
            _ => {}
        }
        Ok(())
    }

    /// Checks a description and takes anchors in the world into the frames of the bodies.
    fn place_joint(&self, a: u32, b: u32, mut def: JointDef) -> Result<JointDef, Error> {
        def.validate()?;
        if let Some([at_a, at_b]) = def.anchors_at.take() {
            let [a, b] = [a, b].map(|body| self.state.bodies.origin_pose(body));
            def = def.anchors(a.unapply(at_a), b.unapply(at_b));
            def = def.angles(def.angle_a - a.q.angle(), def.angle_b - b.q.angle());
            def.validate()?;
        }
        Ok(def)
    }

    /// A joint to read; `None` if it has been removed.
    pub fn joint(&self, id: JointId) -> Option<JointRef<'_>> {
        let index = self.joint_index(id).ok()?;
        Some(JointRef::new(self, index))
    }

    /// Handles of all joints, in index order.
    pub fn joint_ids(&self) -> impl Iterator<Item = JointId> + '_ {
        self.state.joints.indices().map(|index| self.joint_id(index))
    }

    /// Joints in the world.
    pub fn joint_count(&self) -> usize {
        self.state.joints.count()
    }

    /// Takes a joint out of the world. Its bodies wake and may collide again.
    pub(super) fn destroy_joint(&mut self, index: u32) {
        let record = &self.state.joints.records[index as usize];
        let (a, b) = (record.body_a, record.body_b);
        self.wake_index(a);
        self.wake_index(b);
        self.state.displace_joint(index);
        self.state.joints.remove(&mut self.state.bodies, index);
        self.buffer_shapes(self.smaller(a, b));
    }

    /// Removes all joints of a body.
    pub(super) fn destroy_joints_of(&mut self, body: u32) {
        while self.state.bodies.infos[body as usize].first_joint != NULL {
            self.destroy_joint(self.state.bodies.infos[body as usize].first_joint / 2);
        }
    }

    /// Removes the joints that bore more than they can, and says so.
    pub(super) fn break_joints(&mut self) {
        let broken = core::mem::take(&mut self.scratch.solver.broken.found);
        for &(index, load) in &broken {
            let joint = self.joint_id(index);
            let record = &self.state.joints.records[index as usize];
            self.state.events.joint_breaks.push(JointBreak {
                joint,
                body_a: self.body_id(record.body_a),
                body_b: self.body_id(record.body_b),
                force: load.force,
                torque: load.torque,
                user_data: record.def.user_data,
            });
            self.destroy_joint(index);
        }
        self.scratch.solver.broken.found = broken;
    }

    /// The one of two bodies that has less around it, a dynamic one rather than ground: what concerns a pair is found from either.
    fn smaller(&self, a: u32, b: u32) -> u32 {
        let weigh = |body: u32| {
            let info = &self.state.bodies.infos[body as usize];
            (info.kind != BodyKind::Dynamic, info.shape_count)
        };
        if weigh(b) < weigh(a) { b } else { a }
    }

    /// Destroys the contacts between two bodies.
    fn part_bodies(&mut self, a: u32, b: u32) {
        let one = self.smaller(a, b);
        let other = if one == a { b } else { a };
        self.destroy_contacts_of(one, |_, contact| contact.other(one) == other);
    }

    /// Makes the next step look for all partners of a body's shapes.
    pub(super) fn buffer_shapes(&mut self, body: u32) {
        for shape in self.shapes_of(body) {
            self.state.broad_phase.buffer(self.state.shapes.proxy(shape));
        }
    }
}
