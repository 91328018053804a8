//! The constraint graph of joints: [colours](super::coloured) as in that of contacts, buckets by class.
//!
//! A joint keeps its colour while its bodies are awake. Joints of the [forest](super::joint_forest) have lanes of their
//! own, which keep their numbers between steps.

use super::blocks::{load_lanes, move_lane, save_lanes};
use super::bodies::Bodies;
use super::coloured::{
    Bucketful, COLOURS, Coloured, Place, TREES, colour_at, give_colour_back, pace_at, place_of,
    take_colour,
};
use super::joint_blocks::{
    DistanceBlock, DriveBlock, GearBlock, Impulses, JointClass, JointLanes, PulleyBlock,
    RevoluteBlock, SliderBlock, WeldBlock,
};
use super::joint_forest::{JointForest, JointTree, asks, is_rigid, is_rope};
use super::joints::{JointRecord, Joints};
use super::pace::PLAIN;
use crate::codec::{Data, Reader, Sink, clone_by_field, store};
use crate::describe::JointDef;
use crate::error::Error;
use crate::footprint::{Footprint, MemoryUse, footprint};
use crate::simd::BLOCK;
use crate::threads::Team;
use core::ops::Range;

/// Joints of one colour and class.
#[derive(Debug, PartialEq)]
pub(crate) struct JointBucket<B> {
    /// Joint index of each slot.
    pub(crate) joints: Vec<u32>,
    pub(crate) blocks: Vec<B>,
    /// Blocks whose lanes have to be written from the joints' descriptions again.
    pub(crate) stale: Vec<bool>,
}

clone_by_field!(JointBucket<B: Copy> { joints, blocks, stale });
footprint!(JointBucket<B> { joints, blocks, stale });

impl<B: JointLanes> Data for JointBucket<B> {
    const HEAP: bool = true;

    fn save(&self, sink: &mut Sink) {
        let Self { joints, blocks, stale } = self;
        joints.save(sink);
        if !joints.is_empty() {
            save_lanes(blocks, joints.len(), sink);
            stale.save(sink);
        }
    }

    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let joints: Vec<u32> = Data::load(reader)?;
        if joints.is_empty() {
            return Ok(Self::default());
        }
        Ok(Self { joints, blocks: load_lanes(reader)?, stale: Data::load(reader)? })
    }

    fn memory(&self) -> MemoryUse {
        self.footprint()
    }
}

impl<B> Default for JointBucket<B> {
    fn default() -> Self {
        Self { joints: Vec::new(), blocks: Vec::new(), stale: Vec::new() }
    }
}

impl<B: JointLanes> JointBucket<B> {
    /// Appends a joint and gives its slot.
    fn push(&mut self, index: u32, bodies: [u32; 2], impulses: &Impulses) -> u32 {
        let slot = self.joints.len();
        let (block, lane) = (slot / BLOCK, slot % BLOCK);
        self.joints.push(index);
        if lane == 0 {
            self.blocks.push(B::NULL);
            self.stale.push(true);
        }
        self.stale[block] = true;
        let lanes = &mut self.blocks[block];
        lanes.frame().body_a[lane] = bodies[0];
        lanes.frame().body_b[lane] = bodies[1];
        lanes.restore(lane, impulses);
        slot as u32
    }

    /// Takes a slot out; the last one moves into it. Gives the joint that moved, if one did.
    fn swap_remove(&mut self, slot: u32) -> Option<u32> {
        let last = self.joints.len() - 1;
        let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
        let (last_block, last_lane) = (last / BLOCK, last % BLOCK);
        self.joints.swap_remove(slot as usize);
        move_lane(&mut self.blocks, (block, lane), (last_block, last_lane));
        self.stale[block] |= self.stale[last_block];
        if last_lane == 0 {
            self.blocks.pop();
            self.stale.pop();
        }
        self.joints.get(slot as usize).copied()
    }

    /// The impulses of a slot.
    pub(crate) fn saved(&self, slot: u32) -> Impulses {
        let mut impulses = Impulses::default();
        self.blocks[slot as usize / BLOCK].save(slot as usize % BLOCK, &mut impulses);
        impulses
    }

    fn mark_stale(&mut self, slot: u32) {
        self.stale[slot as usize / BLOCK] = true;
    }

    /// Multiplies the impulses of all slots.
    fn scale(&mut self, class: JointClass, factor: f32) {
        for slot in 0..self.joints.len() {
            let mut impulses = self.saved(slot as u32);
            class.scale(&mut impulses, factor);
            self.blocks[slot / BLOCK].restore(slot % BLOCK, &impulses);
        }
    }
}

/// Calls a macro with the list of all classes: the bucket, the class, its block. What is given goes before the list.
macro_rules! joint_classes {
    ($then:ident ! ($($given:tt)*)) => {
        $then! {
            ($($given)*)
            distance Distance DistanceBlock,
            revolute Revolute RevoluteBlock,
            slider Slider SliderBlock,
            weld Weld WeldBlock,
            drive Drive DriveBlock,
            pulley Pulley PulleyBlock,
            gear Gear GearBlock
        }
    };
}
pub(crate) use joint_classes;

macro_rules! declare {
    (() $($bucket:ident $class:ident $block:ident),*) => {
        store! {
            /// All joints of one colour.
            #[derive(Debug, PartialEq, Default)]
            pub(crate) struct JointColour {
                $(pub(crate) $bucket: JointBucket<$block>,)*
            }
        }

        /// A run of blocks of one colour and class.
        pub(crate) enum JointBlocks<'a> {
            $($class(&'a mut [$block]),)*
        }

        impl JointColour {
            /// Multiplies all impulses.
            fn scale(&mut self, factor: f32) {
                $(self.$bucket.scale(JointClass::$class, factor);)*
            }

            /// The joints of each class.
            fn lists(&self) -> impl Iterator<Item = &Vec<u32>> {
                [$(&self.$bucket.joints),*].into_iter()
            }
        }
    };
}
joint_classes!(declare!());

/// Does something with the bucket of a class in a borrowed colour.
macro_rules! with_bucket {
    ((all, $colour:expr, $of:expr, $name:ident => $body:expr)
        $($bucket:ident $class:ident $block:ident),*) => {
        match $of {
            $($crate::dynamics::JointClass::$class => {
                let $crate::dynamics::JointColour { $bucket: $name, .. } = $colour;
                $body
            })*
        }
    };
    ($colour:expr, $class:expr, $bucket:ident => $body:expr) => {
        $crate::dynamics::joint_classes!(with_bucket!(all, $colour, $class, $bucket => $body))
    };
}
pub(crate) use with_bucket;

impl Bucketful for JointColour {
    fn is_empty(&self) -> bool {
        self.count() == 0
    }
}

impl JointColour {
    /// Number of joints.
    pub(crate) fn count(&self) -> usize {
        self.lists().map(Vec::len).sum()
    }

    /// All joints.
    pub(crate) fn joints(&self) -> impl Iterator<Item = u32> + '_ {
        self.lists().flatten().copied()
    }

    /// Works on all blocks class by class, in runs that the team shares out; of each, how many joints it has. A team
    /// of one, such as the overflow wants, goes through them in order.
    pub(crate) fn for_each_run(
        &mut self,
        team: &Team,
        work: impl Fn(JointBlocks<'_>, usize) + Sync,
    ) {
        /// Blocks that one member of the team works on at a time.
        const RUN: usize = 4;
        let alone = team.member_count() == 1 || self.count() <= RUN * BLOCK;
        macro_rules! share_out {
            (() $($bucket:ident $class:ident $block:ident),*) => {
                $(let JointBucket { joints, blocks, .. } = &mut self.$bucket;
                if blocks.is_empty() {
                } else if alone {
                    work(JointBlocks::$class(blocks), joints.len());
                } else {
                    team.for_each_chunk_mut(blocks, RUN, |chunk, blocks| {
                        let left = joints.len() - chunk * RUN * BLOCK;
                        let count = left.min(blocks.len() * BLOCK);
                        work(JointBlocks::$class(blocks), count);
                    });
                })*
            };
        }
        joint_classes!(share_out!());
    }
}

/// Where in the graph's list the joints of a pace are.
#[derive(Clone, Debug)]
pub(crate) struct JointPlaces {
    colours: Range<usize>,
    overflow: Range<usize>,
    trees: Range<usize>,
}

impl JointPlaces {
    /// All of them.
    pub(crate) fn all(&self) -> Range<usize> {
        self.colours.start..self.trees.end
    }

    /// Is a place that of trees?
    pub(crate) fn of_trees(&self, place: usize) -> bool {
        self.trees.contains(&place)
    }

    /// There is no joint.
    pub(crate) fn is_empty(&self) -> bool {
        self.all().is_empty()
    }
}

store! {
    /// All colours, the overflow and the trees.
    #[derive(Debug, PartialEq, Default)]
    pub(crate) struct JointGraph {
        /// By place.
        pub(crate) colours: Coloured<JointColour>,
        /// Plain substep length that the lanes were described for, seconds.
        pub(crate) described_h: f32,
        /// Some block is stale.
        pub(crate) any_stale: bool,
        pub(crate) count: usize,
        /// A joint has come in that joins bodies of different paces.
        pub(crate) mixed: bool,
        pub(crate) forest: JointForest as derived,
    }
    load with JointGraph::forget_forest
}

impl JointGraph {
    fn forget_forest(&mut self) -> Result<(), Error> {
        self.forest.note_all();
        Ok(())
    }

    /// Where the joints of a pace are, until one comes or goes.
    pub(crate) fn places_of(&self, pace: usize) -> JointPlaces {
        let start_of = |place| self.colours.range(0..place).end;
        let [start, overflow, trees] =
            [0, COLOURS, TREES].map(|colour| start_of(place_of(pace, colour)));
        let end = start_of(place_of(pace + 1, 0));
        JointPlaces { colours: start..overflow, overflow: overflow..trees, trees: trees..end }
    }

    /// The joints that are solved in lanes, in that order: the overflow, which may not be worked on at once, and the
    /// colours.
    pub(crate) fn in_lanes(
        &mut self,
        places: &JointPlaces,
    ) -> (&mut [JointColour], &mut [JointColour]) {
        let JointPlaces { colours, overflow, .. } = places;
        let list = &mut self.colours.list_mut()[colours.start..overflow.end];
        let (colours, overflow) = list.split_at_mut(colours.len());
        (overflow, colours)
    }

    /// All joints of a pace.
    pub(crate) fn of_pace(&self, pace: usize) -> &[JointColour] {
        let places = place_of(pace, 0)..place_of(pace + 1, 0);
        &self.colours.list()[self.colours.range(places)]
    }

    /// The lanes of the trees, if there are any, and the trees of all paces.
    pub(crate) fn in_trees(
        &mut self,
        places: &JointPlaces,
    ) -> Option<(&mut JointColour, &mut [JointTree])> {
        let lanes = self.colours.list_mut()[places.trees.clone()].first_mut()?;
        Some((lanes, &mut self.forest.trees))
    }

    /// Joints of all trees.
    pub(crate) fn count_in_trees(&self) -> usize {
        let all = self.colours.keys().zip(self.colours.list());
        all.filter(|&(place, _)| colour_at(place) == TREES).map(|(_, joints)| joints.count()).sum()
    }

    /// The pace at which a joint is solved.
    pub(crate) fn pace_of(&self, record: &JointRecord) -> usize {
        record.lanes().map_or(PLAIN, |(place, ..)| pace_at(place))
    }

    /// Multiplies all impulses.
    pub(crate) fn scale(&mut self, factor: f32) {
        self.colours.list_mut().iter_mut().for_each(|colour| colour.scale(factor));
    }

    /// Puts a joint into the graph with the impulses of its record. Does nothing where it is there
    /// already, has nothing to solve, or one of its bodies is not enabled.
    pub(crate) fn insert(&mut self, bodies: &mut Bodies, joints: &mut Joints, index: u32) {
        self.insert_scaled(bodies, joints, index, 1.0);
    }

    /// The same with a multiple of the impulses.
    pub(crate) fn insert_scaled(
        &mut self,
        bodies: &mut Bodies,
        joints: &mut Joints,
        index: u32,
        factor: f32,
    ) {
        let record = &mut joints.records[index as usize];
        let enabled = |body: u32| bodies.infos[body as usize].enabled;
        if record.class().is_none()
            || record.place != Place::Asleep
            || !(enabled(record.body_a) && enabled(record.body_b))
        {
            return;
        }
        record.scale_saved(factor);
        let (a, b) = (record.body_a, record.body_b);
        self.mixed |= bodies.are_mixed(a, b);
        self.forest.note(a, b);
        self.put_in_lanes(bodies, joints, index);
    }

    fn put_in_lanes(&mut self, bodies: &mut Bodies, joints: &mut Joints, index: u32) {
        let JointRecord { body_a: a, body_b: b, .. } = joints.records[index as usize];
        let colour = take_colour(bodies, [a, b], |info| &mut info.joint_colours);
        self.put(joints, index, place_of(bodies.common_pace(a, b), colour));
    }

    /// Gives a joint lanes.
    fn put(&mut self, joints: &mut Joints, index: u32, place: usize) {
        let record = &mut joints.records[index as usize];
        let Some(class) = record.class() else { return };
        let ends = [record.body_a, record.body_b];
        let lanes = self.colours.open(place);
        let slot = with_bucket!(&mut *lanes, class, bucket => {
            bucket.push(index, ends, &record.saved)
        });
        record.place = Place::Graph { colour: place as u8, slot };
        self.any_stale = true;
        self.count += 1;
    }

    /// Takes a joint out of the graph, if it is there, and saves its impulses in the record. Call it
    /// before the description of the joint changes its kind, or a body its type.
    pub(crate) fn remove(&mut self, bodies: &mut Bodies, joints: &mut Joints, index: u32) {
        let record = &joints.records[index as usize];
        if record.place != Place::Asleep {
            self.forest.note(record.body_a, record.body_b);
            self.forest.dissolve(index);
            self.take(bodies, joints, index);
        }
    }

    /// Takes a joint out of the graph until [`Self::put_back`]: its tree stays.
    pub(crate) fn lift(&mut self, bodies: &mut Bodies, joints: &mut Joints, index: u32) {
        match self.forest.tree_mut(index) {
            Some(_) => self.take(bodies, joints, index),
            None => self.remove(bodies, joints, index),
        }
    }

    /// Puts a joint that has been lifted where its bodies' pace wants it.
    pub(crate) fn put_back(&mut self, bodies: &mut Bodies, joints: &mut Joints, index: u32) {
        let JointRecord { body_a: a, body_b: b, .. } = joints.records[index as usize];
        match self.forest.tree_mut(index) {
            Some(tree) => {
                tree.pace = bodies.common_pace(a, b);
                let place = place_of(tree.pace, TREES);
                self.put(joints, index, place);
            }
            None => self.insert(bodies, joints, index),
        }
    }

    /// Takes a joint's lanes away.
    fn take(&mut self, bodies: &mut Bodies, joints: &mut Joints, index: u32) {
        let record = &mut joints.records[index as usize];
        let Some((place, class, slot)) = record.lanes() else { return };
        let at = core::mem::replace(&mut record.place, Place::Asleep);
        let ends = [record.body_a, record.body_b];
        let moved = with_bucket!(&mut self.colours[place], class, bucket => {
            record.saved = bucket.saved(slot);
            bucket.swap_remove(slot)
        });
        if let Some(moved) = moved {
            joints.records[moved as usize].place = at;
        }
        self.colours.close(place);
        give_colour_back(bodies, ends, place, |info| &mut info.joint_colours);
        self.count -= 1;
    }

    /// What a joint has accumulated in the last substep, in the order of its block; nothing while it sleeps.
    pub(crate) fn impulses(&self, record: &JointRecord) -> Impulses {
        let Some((place, class, slot)) = record.lanes() else { return Impulses::default() };
        with_bucket!(&self.colours[place], class, bucket => bucket.saved(slot))
    }

    /// Brings the forest up to date, and moves joints between lanes and trees.
    pub(crate) fn grow_forest(&mut self, bodies: &mut Bodies, joints: &mut Joints) {
        if !self.forest.is_stale() {
            return;
        }
        // How firmly a joint holds goes with what else its body hangs on, and so do springs.
        let changed = core::mem::take(&mut self.forest.dirty);
        for &body in changed.iter().filter(|&&body| bodies.is_dynamic(body)) {
            let all = joints.of_body(bodies.infos[body as usize].first_joint);
            all.for_each(|(joint, _)| self.mark_stale(joints, joint));
        }
        if self.forest.all_dirty {
            self.described_h = f32::NAN;
        }
        self.forest.dirty = changed;
        for (index, place) in self.forest.grow(bodies, joints) {
            self.take(bodies, joints, index);
            match place {
                Some(place) => self.put(joints, index, place),
                None => self.put_in_lanes(bodies, joints, index),
            }
        }
    }

    /// Gives a joint another description, also while it is in the graph. Impulses live on unless the
    /// kind is another or it is enabled or disabled. The description has been validated. A joint that had nothing to solve before is
    /// not in the graph yet afterwards: [`Self::insert`] it where its bodies are awake.
    pub(crate) fn update(
        &mut self,
        bodies: &mut Bodies,
        joints: &mut Joints,
        index: u32,
        def: &JointDef,
    ) {
        let record = &joints.records[index as usize];
        let same = core::mem::discriminant(&record.def.kind) == core::mem::discriminant(&def.kind)
            && record.def.enabled == def.enabled;
        let kept = is_rigid(&record.def) == is_rigid(def) && is_rope(&record.def) == is_rope(def);
        if same && kept {
            let asks = |def: &JointDef| (asks(def), def.kind.springs());
            if asks(&record.def) != asks(def) {
                // It may need a tree now, joints contradict each other, or no longer, or more springs act on its bodies together.
                self.forest.note(record.body_a, record.body_b);
            }
            joints.records[index as usize].def = *def;
            self.mark_stale(joints, index);
        } else {
            let placed = record.place != Place::Asleep;
            self.remove(bodies, joints, index);
            let record = &mut joints.records[index as usize];
            record.def = *def;
            if !same {
                record.saved = Impulses::default();
            }
            if placed {
                self.insert(bodies, joints, index);
            }
        }
        joints.note_kind(index);
    }

    /// Notes that mass or centre of mass of a joint's body has changed.
    pub(crate) fn refresh(&mut self, joints: &Joints, index: u32) {
        let record = &joints.records[index as usize];
        self.forest.note(record.body_a, record.body_b);
        self.mark_stale(joints, index);
    }

    /// Notes that the lanes of a joint no longer follow from its description: that has changed, or the
    /// centre of mass of a body has.
    fn mark_stale(&mut self, joints: &Joints, index: u32) {
        let Some((place, class, slot)) = joints.records[index as usize].lanes() else { return };
        with_bucket!(&mut self.colours[place], class, bucket => bucket.mark_stale(slot));
        self.any_stale = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::describe::{BodyKind, JointDef};
    use crate::dynamics::{BodyInfo, JointRecord};
    use crate::math::{DVec2, Pose, Vec2};

    fn kinds() -> [JointDef; 9] {
        let x = Vec2::new(1.0, 0.0);
        [
            JointDef::distance(1.0),
            JointDef::revolute(),
            JointDef::prismatic(x),
            JointDef::weld(),
            JointDef::wheel(x),
            JointDef::friction(1.0, 1.0),
            JointDef::filter(),
            JointDef::pulley(DVec2::ZERO, DVec2::ZERO, 1.0),
            JointDef::gear(1.0),
        ]
    }

    /// Random insertions, removals and changes of kind; colours and places stay consistent.
    #[test]
    fn graph_stays_consistent() {
        let mut bodies = Bodies::default();
        for i in 0..12 {
            let kind = if i < 3 { BodyKind::Static } else { BodyKind::Dynamic };
            bodies.insert(BodyInfo { kind, ..BodyInfo::default() }, Pose::default());
        }
        let mut joints = Joints::default();
        let mut graph = JointGraph::default();
        let mut state = 3_u32;
        let mut random = |below: usize| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 16) as usize % below
        };
        for _ in 0..100 {
            let a = random(13) as u32;
            let b = (a + 1 + random(12) as u32) % 13;
            let mut record = JointRecord::new(a, b, kinds()[random(9)]);
            record.saved = [a as f32; 6];
            joints.insert(&mut bodies, record);
        }
        for _ in 0..3000 {
            let index = random(100) as u32;
            match random(5) {
                0 => graph.remove(&mut bodies, &mut joints, index),
                1 => graph.update(&mut bodies, &mut joints, index, &kinds()[random(9)]),
                _ => graph.insert(&mut bodies, &mut joints, index),
            }
        }
        check(&bodies, &joints, &mut graph);
        for index in 0..100 {
            graph.remove(&mut bodies, &mut joints, index);
        }
        assert_eq!(graph.count, 0);
        assert!(bodies.infos.iter().all(|info| info.joint_colours == 0));
        assert!(graph.colours.list().is_empty());
    }

    fn check(bodies: &Bodies, joints: &Joints, graph: &mut JointGraph) {
        let mut used = vec![0_u32; bodies.infos.len()];
        let mut placed = 0;
        for index in joints.indices() {
            let record = &joints.records[index as usize];
            let Place::Graph { colour, slot } = record.place else { continue };
            placed += 1;
            let ends = [record.body_a, record.body_b];
            let class = record.class().expect("a joint in the graph has a class");
            with_bucket!(&mut graph.colours[usize::from(colour)], class, bucket => {
                assert_eq!(bucket.joints[slot as usize], index);
                let frame = bucket.blocks[slot as usize / BLOCK].frame();
                assert_eq!(frame.body_a[slot as usize % BLOCK], ends[0]);
                assert_eq!(frame.body_b[slot as usize % BLOCK], ends[1]);
            });
            if colour_at(colour.into()) >= COLOURS {
                continue;
            }
            for end in ends.into_iter().filter(|&end| bodies.is_dynamic(end)) {
                assert_eq!(used[end as usize] >> colour & 1, 0, "a colour twice on body {end}");
                used[end as usize] |= 1 << colour;
            }
        }
        assert_eq!(placed, graph.count);
        for (used, info) in used.iter().zip(&bodies.infos) {
            assert_eq!(*used, info.joint_colours);
        }
    }
}
