//! Joint records: what the user asked for, and where the solver's copy of it is.

use super::bodies::{Bodies, NULL};
use super::coloured::Place;
use super::edges::{self, edges};
use super::joint_blocks::{Impulses, JointClass};
use super::places::{claim, put};
use crate::codec::{Generations, record, store};
use crate::describe::{JointDef, JointKind};
use crate::error::Error;
use crate::math::{DVec2, Rot, Vec2};

record! {
    /// The lasting record of a joint.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub(crate) struct JointRecord {
        pub(crate) alive: bool,
        pub(crate) generation: u32 as apart,
        pub(crate) body_a: u32,
        pub(crate) body_b: u32,
        pub(crate) def: JointDef,
        pub(crate) place: Place,
        /// Impulses kept while the joint has no lane.
        pub(crate) saved: Impulses,
        /// Neighbours in the joint lists of A and B: (previous, next) edges.
        pub(crate) links: [(u32, u32); 2],
    }
}

impl JointRecord {
    /// A joint that has not been linked to its bodies yet.
    pub(crate) fn new(body_a: u32, body_b: u32, def: JointDef) -> Self {
        Self {
            alive: true,
            generation: 0,
            body_a,
            body_b,
            def,
            place: Place::Asleep,
            saved: Impulses::default(),
            links: [(NULL, NULL); 2],
        }
    }

    /// Multiplies the impulses that are kept.
    pub(crate) fn scale_saved(&mut self, factor: f32) {
        if let Some(class) = self.class() {
            class.scale(&mut self.saved, factor);
        }
    }

    /// Its anchors on A and B: world, metres.
    pub(crate) fn anchors(&self, bodies: &Bodies) -> (DVec2, DVec2) {
        let Self { body_a, body_b, def, .. } = self;
        let at = |body: u32, anchor| bodies.origin_pose(body).apply(anchor);
        (at(*body_a, def.anchor_a), at(*body_b, def.anchor_b))
    }

    /// Its direction, and the way from anchor A to anchor B (of a mouse joint, from anchor B to its target).
    pub(crate) fn line(&self, bodies: &Bodies) -> (Vec2, Vec2) {
        let (a, b) = self.anchors(bodies);
        match self.def.kind {
            JointKind::Prismatic { .. } | JointKind::Wheel { .. } => {
                let frame = bodies.poses[self.body_a as usize].q;
                let direction = Rot::from_angle(self.def.angle_a).x_axis();
                (frame.rotate(direction), b.relative_to(a))
            }
            kind => {
                let (to, from) =
                    if let JointKind::Mouse { target, .. } = kind { (target, b) } else { (b, a) };
                let gap = to.relative_to(from);
                (gap.direction_and_length().0, gap)
            }
        }
    }

    /// How far it is from where it would have its bodies, metres: not counting angles, nor what is springy.
    pub(crate) fn off(&self, bodies: &Bodies) -> f32 {
        use JointKind::{Distance, Prismatic, Revolute, Weld, Wheel};
        let [least, most] = match self.def.kind {
            _ if !self.def.enabled || self.def.softness.is_some() => return 0.0,
            Revolute { .. } | Weld { linear: None, .. } => [0.0; 2],
            Distance { length, limits: None, spring: None, motor: None } => [length; 2],
            Distance { limits: Some(limits), .. }
            | Prismatic { limits: Some(limits), .. }
            | Wheel { limits: Some(limits), .. } => [limits.lower, limits.upper],
            _ => [f32::NEG_INFINITY, f32::INFINITY],
        };
        let (direction, gap) = self.line(bodies);
        let (along, across) = (direction.dot(gap), direction.perp().dot(gap).abs());
        across.max(least - along).max(along - most)
    }

    /// Where it has lanes: place, class, slot.
    pub(crate) fn lanes(&self) -> Option<(usize, JointClass, u32)> {
        let Place::Graph { colour, slot } = self.place else { return None };
        self.class().map(|class| (colour.into(), class, slot))
    }

    /// Which kernel solves it; `None` where there is nothing to solve.
    pub(crate) fn class(&self) -> Option<JointClass> {
        self.def.enabled.then(|| JointClass::of(&self.def.kind)).flatten()
    }
}

edges!(JointRecord, first_joint);

/// What a joint does to body B, as of the last substep: the opposite acts on body A.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct JointLoad {
    /// Newtons, world axes, at anchor B.
    pub(crate) force: Vec2,
    /// Newton metres.
    pub(crate) torque: f32,
}

store! {
    /// All joints of a world, by stable index.
    #[derive(Debug, PartialEq, Default)]
    pub(crate) struct Joints {
        pub(crate) records: Vec<JointRecord>,
        /// Joints that can break, ascending.
        pub(crate) breakable: Vec<u32>,
        /// Joints that may set something going, or stop it, ascending.
        pub(crate) driven: Vec<u32> as derived,
        pub(crate) free: Vec<u32>,
        pub(crate) count: usize,
        generations: Generations,
    }
    load with Joints::note_all
}

impl Joints {
    /// Fills the lists of some kinds, for records that were read.
    fn note_all(&mut self) -> Result<(), Error> {
        (0..self.records.len() as u32).for_each(|index| self.note_kind(index));
        Ok(())
    }

    /// Joints alive.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Indices of the joints alive, ascending.
    pub(crate) fn indices(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.records.len() as u32).filter(|&i| self.records[i as usize].alive)
    }

    /// Puts a record in, under a new generation: into both bodies' lists too.
    pub(crate) fn insert(&mut self, bodies: &mut Bodies, mut record: JointRecord) -> u32 {
        self.count += 1;
        record.alive = true;
        record.generation = self.generations.next();
        let index = claim(&mut self.free, self.records.len());
        put(&mut self.records, index, record);
        edges::link(&mut self.records, bodies, index);
        self.note_kind(index);
        index
    }

    /// Takes a record out. The caller has taken its lanes out of the graph.
    pub(crate) fn remove(&mut self, bodies: &mut Bodies, index: u32) {
        debug_assert_eq!(self.records[index as usize].place, Place::Asleep);
        self.count -= 1;
        edges::unlink(&mut self.records, bodies, index);
        let record = &mut self.records[index as usize];
        record.alive = false;
        record.def.break_at = None;
        self.note_kind(index);
        self.free.push(index);
    }

    /// Does any joint of an awake body, whose first edge that is, do something?
    pub(crate) fn act_on(&self, first_edge: u32) -> bool {
        let mut all = self.of_body(first_edge).map(|(index, _)| &self.records[index as usize]);
        all.any(|record| record.place != Place::Asleep)
    }

    /// Joints of a body as (joint, side) from the head of its list: the newest first.
    pub(crate) fn of_body(&self, first_edge: u32) -> impl Iterator<Item = (u32, u32)> + '_ {
        edges::walk(&self.records, first_edge)
    }

    /// Does no joint between the two bodies forbid them to collide?
    pub(crate) fn may_collide(&self, bodies: &Bodies, a: u32, b: u32) -> bool {
        let parts = |body: u32, other: u32| {
            self.of_body(bodies.infos[body as usize].first_joint).map(move |(index, _)| {
                let record = &self.records[index as usize];
                record.other(body) == other && !record.def.collide_connected && record.def.enabled
            })
        };
        // Both lists at once, up to the end of the shorter one: the other may be a hub's.
        parts(a, b).zip(parts(b, a)).all(|(a, b)| !(a || b))
    }

    /// The joints that tie islands together: those in the graph or of class none.
    pub(crate) fn tying(&self) -> impl Iterator<Item = &JointRecord> {
        let all = self.records.iter();
        all.filter(|record| record.alive && record.place != Place::Asleep)
    }

    /// Their bodies.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.tying().map(|record| (record.body_a, record.body_b))
    }

    /// Keeps the lists of some kinds of joints in line with a joint's description.
    pub(crate) fn note_kind(&mut self, index: u32) {
        let JointRecord { alive, def, .. } = self.records[index as usize];
        note(&mut self.breakable, index, alive && def.break_at.is_some());
        note(&mut self.driven, index, alive && (def.kind.stops() || def.kind.drives()));
    }
}

/// Puts an index into an ascending list, or takes it out.
fn note(list: &mut Vec<u32>, index: u32, is_in: bool) {
    match (list.binary_search(&index), is_in) {
        (Err(at), true) => list.insert(at, index),
        (Ok(at), false) => {
            list.remove(at);
        }
        (Ok(_), true) | (Err(_), false) => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::BodyInfo;
    use crate::math::Pose;

    /// Random insertions and removals; the lists of the bodies always agree with the records.
    #[test]
    fn lists_follow_insertions_and_removals() {
        let mut bodies = Bodies::default();
        let mut joints = Joints::default();
        for _ in 0..8 {
            bodies.insert(BodyInfo::default(), Pose::default());
        }
        let mut state = 7_u32;
        let mut random = |below: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 16) % below
        };
        for _ in 0..2000 {
            let alive: Vec<u32> = joints.indices().collect();
            if alive.len() > 20 || (random(3) == 0 && !alive.is_empty()) {
                joints.remove(&mut bodies, alive[random(alive.len() as u32) as usize]);
            } else {
                let a = random(9);
                let b = (a + 1 + random(8)) % 9;
                let def = JointDef::revolute();
                let def = if random(2) == 0 { def.break_at(1.0, 1.0) } else { def };
                joints.insert(&mut bodies, JointRecord::new(a, b, def));
            }
            check(&bodies, &joints);
        }
    }

    fn check(bodies: &Bodies, joints: &Joints) {
        let mut found = 0;
        for body in 0..bodies.infos.len() as u32 {
            for (index, side) in joints.of_body(bodies.infos[body as usize].first_joint) {
                let record = &joints.records[index as usize];
                assert!(record.alive);
                assert_eq!([record.body_a, record.body_b][side as usize], body);
                found += 1;
            }
        }
        assert_eq!(found, joints.count() * 2);
        let breakable: Vec<u32> = joints
            .indices()
            .filter(|&i| joints.records[i as usize].def.break_at.is_some())
            .collect();
        assert_eq!(joints.breakable, breakable);
    }
}
