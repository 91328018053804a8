//! Islands: dynamic bodies that hang together by touching contacts and joints, found with disjoint sets.
//!
//! They are not kept from step to step; what needs them finds them anew.

use crate::dynamics::{Bodies, Contacts, DisjointSets, Graph, JointGraph, Joints};

/// The stores that change when islands fall asleep, wake, or are solved at another pace.
pub(crate) struct Stores<'a> {
    pub(crate) bodies: &'a mut Bodies,
    pub(crate) contacts: &'a mut Contacts,
    pub(crate) graph: &'a mut Graph,
    pub(crate) joints: &'a mut Joints,
    pub(crate) joint_graph: &'a mut JointGraph,
}

/// The islands of the awake bodies. Found anew each time; kept for its memory.
#[derive(Debug, Default)]
pub(crate) struct Islands {
    sets: DisjointSets,
}

crate::footprint::footprint!(Islands { sets });

impl Islands {
    /// Joins all awake dynamic bodies that touch or are joined.
    pub(crate) fn find_all(&mut self, bodies: &Bodies, graph: &Graph, joints: &Joints) {
        self.sets.reset(bodies.infos.len(), bodies.awake.iter().copied());
        for (a, b) in touching(graph).chain(joints.pairs()) {
            if bodies.is_solved(a) && bodies.is_solved(b) {
                self.sets.join(a, b);
            }
        }
    }

    /// The body with the smallest index of the island that an awake body is in.
    pub(crate) fn root(&mut self, body: u32) -> u32 {
        self.sets.root(body)
    }
}

/// The bodies of every touching contact that is awake.
pub(crate) fn touching(graph: &Graph) -> impl Iterator<Item = (u32, u32)> + '_ {
    let buckets = graph.touching_buckets();
    buckets.flat_map(|(_, bucket)| (0..bucket.contacts.len()).map(|slot| bucket.bodies(slot)))
}
