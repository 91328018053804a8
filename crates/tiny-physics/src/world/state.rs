//! What a world is, apart from its gravity and settings: all that is saved, copied and hashed.

use super::World;
use super::events::{Events, UserData};
use super::ids::{BodyId, JointId, ShapeId};
use super::tiles::TileGrids;
use crate::broad_phase::BroadPhase;
use crate::codec::store;
use crate::dynamics::{
    Bodies, Contact, Contacts, Graph, JointGraph, JointRecord, Joints, Place, Sensors, Shapes,
    Waiting,
};
use crate::error::Error;
use crate::math::Vec2;
use crate::stages::islands::Stores;

store! {
    /// The stores of a world.
    #[derive(Debug, Default)]
    pub(super) struct State {
        pub(super) bodies: Bodies,
        pub(super) shapes: Shapes,
        pub(super) contacts: Contacts,
        pub(super) waiting: Waiting,
        pub(super) graph: Graph,
        pub(super) joints: Joints,
        pub(super) joint_graph: JointGraph,
        pub(super) broad_phase: BroadPhase,
        pub(super) tiles: TileGrids,
        pub(super) sensors: Sensors,
        pub(super) events: Events,
        pub(super) step_count: u64,
        /// The world's gravity in the last step.
        pub(super) gravity: Option<Vec2>,
        /// Did the world let islands sleep in the last step?
        pub(super) sleeps: bool,
        /// 1 / substep length of the last step, at the plain pace.
        pub(super) inv_h: f32,
        /// That of the first step: what sleeps keeps impulses of such substeps.
        pub(super) inv_h_asleep: f32,
        /// The substep that contacts are as soft as, seconds.
        pub(super) coarse_h: f32,
    }
}

impl State {
    /// The user's numbers of a shape and its body.
    pub(super) fn user_data(&self, shape: u32) -> UserData {
        let record = &self.shapes.records[shape as usize];
        let body = self.bodies.infos[record.body as usize].user_data;
        UserData { shape: record.user_data, body }
    }

    /// Indices of the shapes of a body, the newest first.
    pub(super) fn shapes_of(&self, body: u32) -> impl Iterator<Item = u32> + '_ {
        self.shapes.of_body(self.bodies.infos[body as usize].first_shape)
    }

    /// Contacts of a body with their indices, the newest first.
    pub(super) fn contacts_of(&self, body: u32) -> impl Iterator<Item = (u32, &Contact)> + '_ {
        let first = self.bodies.infos[body as usize].first_contact;
        let all = self.contacts.of_body(first);
        all.map(|(index, _)| (index, &self.contacts.records[index as usize]))
    }

    /// Joints of a body with their indices, the newest first.
    pub(super) fn joints_of(&self, body: u32) -> impl Iterator<Item = (u32, &JointRecord)> + '_ {
        let first = self.bodies.infos[body as usize].first_joint;
        let all = self.joints.of_body(first);
        all.map(|(index, _)| (index, &self.joints.records[index as usize]))
    }

    /// Gives an awake contact lanes.
    pub(super) fn place_contact(&mut self, index: u32) {
        self.graph.insert(&mut self.bodies, &mut self.contacts, index);
    }

    /// Takes a contact's lanes away; its impulses live on.
    pub(super) fn displace_contact(&mut self, index: u32) {
        self.graph.remove(&mut self.bodies, &mut self.contacts, index);
    }

    /// Removes a contact for good, from its lanes too.
    pub(super) fn destroy_contact(&mut self, index: u32) {
        self.displace_contact(index);
        self.contacts.remove(&mut self.bodies, index);
    }

    /// Gives an awake joint lanes, unless it has some.
    pub(super) fn place_joint(&mut self, index: u32) {
        if self.joints.records[index as usize].place == Place::Asleep {
            self.joint_graph.insert(&mut self.bodies, &mut self.joints, index);
            self.graph.news = self.graph.news.saturating_add(1);
        }
    }

    /// Takes a joint's lanes away; its impulses live on.
    pub(super) fn displace_joint(&mut self, index: u32) {
        self.joint_graph.remove(&mut self.bodies, &mut self.joints, index);
    }

    /// What the solver works on.
    pub(super) fn solved(&mut self) -> Stores<'_> {
        self.shapes_and_solved().1
    }

    /// The same beside the shapes.
    pub(super) fn shapes_and_solved(&mut self) -> (&Shapes, Stores<'_>) {
        let Self { bodies, shapes, contacts, graph, joints, joint_graph, .. } = self;
        (shapes, Stores { bodies, contacts, graph, joints, joint_graph })
    }
}

/// Handles of records, and back: a handle is stale once its record has been removed.
macro_rules! resolve {
    ($($id:ident: $handle:ident $index:ident $store:ident $records:ident,)*) => {
        impl World {
            $(pub(super) fn $handle(&self, index: u32) -> $id {
                $id::new(index, self.state.$store.$records[index as usize].generation)
            }
            pub(super) fn $index(&self, id: $id) -> Result<u32, Error> {
                match self.state.$store.$records.get(id.index()) {
                    Some(record) if record.alive && record.generation == id.generation => Ok(id.index),
                    _ => Err(id.into()),
                }
            })*
        }
    };
}

resolve! {
    BodyId: body_id body_index bodies infos,
    ShapeId: shape_id shape_index shapes records,
    JointId: joint_id joint_index joints records,
}
