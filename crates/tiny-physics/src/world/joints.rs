//! Joints of the world: adding, removing, changing, reading.

use super::World;
use super::events::JointBreak;
use super::ids::{BodyId, JointId};
use crate::describe::JointDef;
use crate::dynamics::{JointRecord, NULL};
use crate::error::Error;
use crate::math::{DVec2, Vec2};
use crate::stages::joint_solver;

/// A joint of the world, to read.
#[derive(Clone, Copy)]
pub struct JointRef<'a> {
    world: &'a World,
    record: &'a JointRecord,
    index: u32,
}

impl<'a> JointRef<'a> {
    /// Its handle.
    pub fn id(&self) -> JointId {
        self.world.joint_id(self.index)
    }

    /// Its bodies A and B.
    pub fn bodies(&self) -> (BodyId, BodyId) {
        (self.world.body_id(self.record.body_a), self.world.body_id(self.record.body_b))
    }

    /// What it does.
    pub fn def(&self) -> &'a JointDef {
        &self.record.def
    }

    /// Its anchors on A and B: world, metres.
    pub fn anchors(&self) -> (DVec2, DVec2) {
        let bodies = &self.world.state.bodies;
        let (a, b) = (self.record.body_a, self.record.body_b);
        let def = &self.record.def;
        (bodies.origin_pose(a).apply(def.anchor_a), bodies.origin_pose(b).apply(def.anchor_b))
    }

    /// Force on body B in the last step, newtons; the opposite acts on A. Zero while it sleeps.
    pub fn force(&self) -> Vec2 {
        self.load().force
    }

    /// Torque on body B in the last step, newton metres; the opposite acts on A. Zero while it sleeps.
    pub fn torque(&self) -> f32 {
        self.load().torque
    }

    fn load(&self) -> crate::dynamics::JointLoad {
        let (graph, joints) = (&self.world.state.joint_graph, &self.world.state.joints);
        joint_solver::load(graph, joints, self.index, self.world.state.inv_h)
    }

    /// The user's number.
    pub fn user_data(&self) -> u64 {
        self.record.def.user_data
    }
}

impl World {
    /// Joins two bodies. Contacts between them end unless [`JointDef::collide_connected`] is set.
    ///
    /// # Errors
    /// A handle is stale, the bodies are the same one, or a number in the description is out of range.
    pub fn add_joint(&mut self, a: BodyId, b: BodyId, def: JointDef) -> Result<JointId, Error> {
        let (a, b) = (self.body_index(a)?, self.body_index(b)?);
        if a == b {
            return Err(Error::Unsupported { reason: "a joint needs two different bodies" });
        }
        def.validate()?;
        let awake = |world: &Self, i: u32| world.state.bodies.infos[i as usize].awake;
        if awake(self, a) || awake(self, b) {
            self.wake_index(a);
            self.wake_index(b);
        }
        let record = JointRecord::new(a, b, def);
        let index = self.state.joints.insert(&mut self.state.bodies, record);
        if awake(self, a) || awake(self, b) {
            self.state.joint_graph.insert(&mut self.state.bodies, &mut self.state.joints, index);
        }
        if !def.collide_connected {
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
    /// wake; impulses live on unless the kind is another.
    ///
    /// # Errors
    /// The handle is stale, or a number in the description is out of range.
    pub fn set_joint(&mut self, id: JointId, def: JointDef) -> Result<(), Error> {
        let index = self.joint_index(id)?;
        def.validate()?;
        let record = &self.state.joints.records[index as usize];
        let (a, b) = (record.body_a, record.body_b);
        self.wake_index(a);
        self.wake_index(b);
        self.state.joint_graph.update(&mut self.state.bodies, &mut self.state.joints, index, &def);
        if self.state.bodies.infos[a as usize].awake || self.state.bodies.infos[b as usize].awake {
            self.state.joint_graph.insert(&mut self.state.bodies, &mut self.state.joints, index);
        }
        if def.collide_connected {
            self.buffer_shapes(self.smaller(a, b));
        } else {
            self.part_bodies(a, b);
        }
        Ok(())
    }

    /// A joint to read; `None` if it has been removed.
    pub fn joint(&self, id: JointId) -> Option<JointRef<'_>> {
        let index = self.joint_index(id).ok()?;
        Some(JointRef { world: self, record: &self.state.joints.records[index as usize], index })
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
        self.state.joint_graph.remove(&mut self.state.bodies, &mut self.state.joints, index);
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
        let broken = core::mem::take(&mut self.scratch.solver.broken);
        for &(index, load) in &broken {
            let joint = self.joint_id(index);
            let user_data = self.state.joints.records[index as usize].def.user_data;
            let (force, torque) = (load.force, load.torque);
            self.state.events.joint_breaks.push(JointBreak { joint, force, torque, user_data });
            self.destroy_joint(index);
        }
        self.scratch.solver.broken = broken;
    }

    /// The one of two bodies that has fewer shapes: what concerns a pair is found from either.
    fn smaller(&self, a: u32, b: u32) -> u32 {
        let count = |body: u32| self.state.bodies.infos[body as usize].shape_count;
        if count(b) < count(a) { b } else { a }
    }

    /// Destroys the contacts between two bodies.
    fn part_bodies(&mut self, a: u32, b: u32) {
        let pair = |contact: &crate::dynamics::Contact| {
            (contact.body_a, contact.body_b) == (a, b) || (contact.body_a, contact.body_b) == (b, a)
        };
        let first = self.state.bodies.infos[self.smaller(a, b) as usize].first_contact;
        let mut indices: Vec<u32> = self
            .state
            .contacts
            .of_body(first)
            .map(|(index, _)| index)
            .filter(|&index| pair(&self.state.contacts.records[index as usize]))
            .collect();
        indices.sort_unstable();
        indices.into_iter().for_each(|index| self.destroy_contact(index));
    }

    /// Makes the next step look for all partners of a body's shapes.
    pub(super) fn buffer_shapes(&mut self, body: u32) {
        for shape in self.state.shapes.of_body(self.state.bodies.infos[body as usize].first_shape) {
            self.state.broad_phase.buffer(self.state.shapes.proxy(shape));
        }
    }

    /// The handle of a joint that is alive.
    pub(super) fn joint_id(&self, index: u32) -> JointId {
        JointId::new(index, self.state.joints.records[index as usize].generation)
    }

    /// The index behind a handle.
    pub(super) fn joint_index(&self, id: JointId) -> Result<u32, Error> {
        match self.state.joints.records.get(id.index()) {
            Some(record) if record.alive && record.generation == id.generation => Ok(id.index),
            _ => Err(id.into()),
        }
    }
}
