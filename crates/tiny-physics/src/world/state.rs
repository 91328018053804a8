//! What a world is, apart from its gravity and settings: all that is saved, copied and hashed.

use super::events::{Events, UserData};
use super::tiles::TileGrids;
use crate::broad_phase::BroadPhase;
use crate::codec::store;
use crate::dynamics::{Bodies, Contacts, Graph, JointGraph, Joints, Sensors, Shapes, Waiting};
use crate::math::Vec2;
use crate::stages::islands::Stores;

store! {
    /// The stores of a world.
    #[derive(Debug)]
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
        /// 1 / substep length of the last step, at the plain pace.
        pub(super) inv_h: f32,
    }
}

impl State {
    /// Of an empty world.
    pub(super) fn new() -> Self {
        Self {
            bodies: Bodies::new(),
            shapes: Shapes::default(),
            contacts: Contacts::default(),
            waiting: Waiting::default(),
            graph: Graph::default(),
            joints: Joints::default(),
            joint_graph: JointGraph::default(),
            broad_phase: BroadPhase::new(),
            tiles: TileGrids::default(),
            sensors: Sensors::default(),
            events: Events::default(),
            step_count: 0,
            gravity: None,
            inv_h: 0.0,
        }
    }

    /// The user's numbers of a shape and its body.
    pub(super) fn user_data(&self, shape: u32) -> UserData {
        let record = &self.shapes.records[shape as usize];
        let body = self.bodies.infos[record.body as usize].user_data;
        UserData { shape: record.user_data, body }
    }

    /// What the solver works on.
    pub(super) fn solved(&mut self) -> Stores<'_> {
        let Self { bodies, contacts, graph, joints, joint_graph, .. } = self;
        Stores { bodies, contacts, graph, joints, joint_graph }
    }
}
