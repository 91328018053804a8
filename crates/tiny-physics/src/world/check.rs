//! Checks of a world that was read from bytes: every link leads where it should, so that whatever the bytes
//! say, no later walk leaves a list or runs in a circle. Numbers that are merely strange are left to the
//! step, which stops bodies that are no longer finite.

use super::World;
use crate::broad_phase::ProxyId;
use crate::describe::{BodyKind, JointKind};
use crate::dynamics::{
    BodyInfo, Bucket, COLOURS, Contact, FrameLanes, IDLE, JointBucket, JointClass, JointLanes,
    JointRecord, NULL, PACES, PLAIN, Place, Slot, colour_at, guard, joint_classes,
};
use crate::geometry::manifold::{PairClass, ShapeClass};
use crate::simd::BLOCK;

/// The bodies of a contact or joint and its neighbours in their lists.
type Ends = ([u32; 2], [(u32, u32); 2]);

type Check = Result<(), &'static str>;

/// The reason as an error unless the condition holds.
fn ensure(condition: bool, reason: &'static str) -> Check {
    if condition { Ok(()) } else { Err(reason) }
}

/// Are the numbers distinct, and just those for which `member` holds?
fn is_set(list: &[u32], count: usize, member: impl Fn(usize) -> bool) -> bool {
    let mut seen = vec![false; count];
    for &index in list {
        match seen.get_mut(index as usize) {
            Some(seen) if !*seen => *seen = true,
            _ => return false,
        }
    }
    seen.iter().enumerate().all(|(index, &seen)| seen == member(index))
}

/// Blocks that so many slots need.
fn blocks(slots: usize) -> usize {
    slots.div_ceil(BLOCK)
}

impl World {
    /// Says what is wrong with a world that was read.
    pub(super) fn check_loaded(&self) -> Check {
        self.check_links()?;
        self.validate_state().map_err(|_| "its parts contradict each other")
    }

    /// Every link leads where it should, and what is counted is counted right.
    pub(super) fn check_links(&self) -> Check {
        ensure(self.state.step_count <= u64::MAX / 2, "it has made more steps than any world can")?;
        self.check_bodies()?;
        self.check_shapes()?;
        self.check_contacts()?;
        self.check_graph()?;
        self.check_joints()?;
        self.check_joint_graph()?;
        self.check_sensors()
    }

    fn is_body(&self, index: u32) -> bool {
        self.state.bodies.infos.get(index as usize).is_some_and(|info| info.alive)
    }

    /// Body 0, which nothing moves, may be an end of a joint.
    fn check_bodies(&self) -> Check {
        let bodies = &self.state.bodies;
        let count = bodies.infos.len();
        let poses = [bodies.poses.len(), bodies.previous.len()];
        let lengths = [bodies.rows.len(), bodies.swings.len()];
        ensure(count > 0 && [poses, lengths] == [[count; 2]; 2], "bodies are missing")?;
        let null = &bodies.infos[0];
        ensure(!null.alive && null.kind == BodyKind::Static, "body 0 is alive")?;
        ensure(
            bodies.infos.iter().filter(|info| info.alive).count() == bodies.count,
            "bodies are miscounted",
        )?;
        let is_free = |i: usize| i > 0 && !bodies.infos[i].alive;
        ensure(is_set(&bodies.free, count, is_free), "the free bodies are not")?;
        let is_awake = |i: usize| bodies.infos[i].awake;
        ensure(is_set(&bodies.awake, count, is_awake), "the awake bodies are not")?;
        ensure(
            bodies.awake_unsorted || bodies.awake.is_sorted(),
            "the awake bodies are in disorder",
        )?;
        let is_refined = |info: &&BodyInfo| usize::from(info.pace) != PLAIN;
        ensure(
            bodies.infos.iter().filter(is_refined).count() == bodies.refined,
            "bodies of finer paces are miscounted",
        )?;
        let is_light = |&(body, by): &(u32, f32)| (body as usize) < count && by > 0.0;
        for list in [&bodies.pressed, &bodies.laden] {
            let in_order = list.is_sorted_by(|a, b| a.0 < b.0);
            ensure(in_order && list.iter().all(is_light), "what is pressed or laden is nothing")?;
        }
        let mut follows = vec![false; count];
        for (index, (info, pose)) in bodies.infos.iter().zip(&bodies.poses).enumerate() {
            let moves = info.alive && info.enabled && info.kind != BodyKind::Static;
            ensure(!info.awake || moves, "a body that cannot move is awake")?;
            ensure(pose.is_finite(), "a body is nowhere")?;
            ensure(usize::from(info.pace) < PACES, "a body has no pace")?;
            let row = &bodies.rows[index];
            let [mass, turn] = [Slot::INV_MASS, Slot::INV_INERTIA].map(|slot| row[slot]);
            let right = info.kind == BodyKind::Dynamic || mass == 0.0 && turn == 0.0;
            let locks = info.locks;
            let fits = (mass < 0.0) == (mass != 0.0 && locks.x != locks.y)
                && (turn < 0.0) == (mass < 0.0 && locks.y);
            ensure(right && fits, "a body moves that cannot")?;
            let next = info.island_next;
            let sleeps = |i: u32| {
                bodies.infos.get(i as usize).is_some_and(|info| {
                    info.alive && !info.awake && info.enabled && info.kind != BodyKind::Static
                })
            };
            // What sleeps is in a ring, if alone: no other body leads where one does, so none is open.
            let rings = info.alive && next != NULL;
            ensure((moves && !info.awake) == rings, "an island is open")?;
            ensure(!rings || sleeps(next), "an island is broken")?;
            if rings {
                let once = !core::mem::replace(&mut follows[next as usize], true);
                ensure(once, "two bodies of islands lead to one")?;
            }
        }
        Ok(())
    }

    fn check_shapes(&self) -> Check {
        let shapes = &self.state.shapes;
        let count = shapes.records.len();
        let lengths =
            [shapes.rows.len(), shapes.fat.len(), shapes.guards.len(), shapes.tight.len()];
        ensure(lengths == [count; 4], "shapes are missing")?;
        ensure(
            shapes.records.iter().filter(|r| r.alive).count() == shapes.count,
            "shapes are miscounted",
        )?;
        ensure(
            is_set(&shapes.free, count, |i| !shapes.records[i].alive),
            "the free shapes are not",
        )?;
        let mut gone = shapes.records.iter().filter(|record| !record.alive);
        ensure(gone.all(|record| record.proxy == NULL), "a shape that is gone has a box")?;
        let mut proxies = 0;
        for (index, record) in shapes.records.iter().enumerate().filter(|(_, record)| record.alive)
        {
            ensure(self.is_body(record.body), "a shape hangs on nothing")?;
            ensure(record.class == ShapeClass::of(&record.shape), "a shape is of another class")?;
            let own = shapes.guards[index] & (guard::CHAIN | guard::ONE_WAY);
            ensure(own == guard::of(record), "a shape is guarded wrongly")?;
            if record.proxy != NULL {
                let user = self.state.broad_phase.user(ProxyId(record.proxy));
                ensure(user == Some(index as u32), "a shape is not in the broad phase")?;
                proxies += 1;
            }
        }
        ensure(proxies == self.state.broad_phase.len(), "the broad phase knows other shapes")?;
        self.check_shape_lists()
    }

    fn check_shape_lists(&self) -> Check {
        let mut seen = vec![false; self.state.shapes.records.len()];
        for (index, info) in self.state.bodies.infos.iter().enumerate() {
            let mut shape = info.first_shape;
            for _ in 0..info.shape_count {
                let record =
                    self.state.shapes.records.get(shape as usize).filter(|record| record.alive);
                let record = record.ok_or("a list of shapes leads nowhere")?;
                let once = !core::mem::replace(&mut seen[shape as usize], true);
                ensure(once && record.body as usize == index, "a list of shapes holds another's")?;
                shape = record.next;
            }
            ensure(shape == NULL, "a list of shapes is too long")?;
        }
        let listed = |(record, &seen): (&crate::dynamics::ShapeRecord, &bool)| record.alive == seen;
        ensure(self.state.shapes.records.iter().zip(&seen).all(listed), "a shape is in no list")
    }

    fn check_contacts(&self) -> Check {
        let contacts = &self.state.contacts;
        let records = &contacts.records;
        ensure(records.len() < (NULL / 2) as usize, "there are too many contacts")?;
        ensure(
            is_set(&contacts.free, records.len(), |i| !records[i].alive),
            "the free contacts are not",
        )?;
        let shape = |index: u32| self.state.shapes.records.get(index as usize).filter(|r| r.alive);
        for contact in records.iter().filter(|contact| contact.alive) {
            let (Some(a), Some(b)) = (shape(contact.shape_a), shape(contact.shape_b)) else {
                return Err("a contact is of no shapes");
            };
            let bodies = (a.body, b.body) == (contact.body_a, contact.body_b) && a.body != b.body;
            let class = a.class >= b.class && contact.class == PairClass::of(a.class, b.class);
            ensure(bodies && class, "a contact is of other shapes")?;
        }
        let known = |index: u32| (index as usize) < self.state.shapes.records.len();
        let in_shapes = |&(a, b): &(u32, u32)| a < b && known(b);
        ensure(self.state.waiting.pairs.iter().all(in_shapes), "pairs wait that are none")?;
        let ends = |contact: &Contact| [contact.body_a, contact.body_b];
        let links = records.iter().map(|c| c.alive.then(|| (ends(c), c.links)));
        self.check_edges(&links.collect::<Vec<_>>(), |body| {
            self.state.bodies.infos[body].first_contact
        })
    }

    /// Checks doubly linked lists of edges (record * 2 + side) by body: each edge once, in the right one.
    fn check_edges(&self, records: &[Option<Ends>], first: impl Fn(usize) -> u32) -> Check {
        let mut left = 2 * records.iter().flatten().count();
        for body in 0..self.state.bodies.infos.len() {
            let (mut previous, mut edge) = (NULL, first(body));
            while edge != NULL {
                let (index, side) = (edge as usize / 2, edge as usize % 2);
                let record = records.get(index).copied().flatten();
                let (ends, links) = record.ok_or("a list of contacts or joints leads nowhere")?;
                let right = ends[side] as usize == body && links[side].0 == previous && left > 0;
                ensure(right, "a list of contacts or joints is broken")?;
                left -= 1;
                (previous, edge) = (edge, links[side].1);
            }
        }
        ensure(left == 0, "a contact or joint is in no list")
    }

    fn check_graph(&self) -> Check {
        let mut placed = 0;
        for (place, class, bucket) in self.state.graph.all() {
            let known = place == IDLE || place < IDLE && colour_at(place) <= COLOURS;
            ensure(known, "a place is unknown")?;
            self.check_bucket(place, class, bucket)?;
            placed += bucket.contacts.len();
        }
        let alive = self.state.contacts.records.iter().filter(|contact| contact.alive);
        let waiting = alive.filter(|contact| contact.place != Place::Asleep).count();
        ensure(placed == waiting, "contacts are lost")
    }

    fn check_bucket(&self, colour: usize, class: PairClass, bucket: &Bucket) -> Check {
        let count = blocks(bucket.contacts.len());
        let constrained = if colour == IDLE { 0 } else { count };
        let lengths = bucket.manifolds.len() == count && bucket.heads.len() == count;
        let solved = [bucket.constraints.len(), bucket.surfaces.len()];
        ensure(lengths && solved == [constrained; 2], "blocks are missing")?;
        for slot in 0..count * BLOCK {
            let (block, lane) = (slot / BLOCK, slot % BLOCK);
            let expected = match bucket.contacts.get(slot) {
                None => [0; 4],
                Some(&index) => {
                    let record = self.state.contacts.records.get(index as usize);
                    let contact =
                        record.filter(|contact| contact.alive).ok_or("a lane has no contact")?;
                    let place = Place::Graph { colour: colour as u8, slot: slot as u32 };
                    ensure(
                        contact.place == place && contact.class == class,
                        "a contact is elsewhere",
                    )?;
                    [contact.body_a, contact.body_b, contact.shape_a, contact.shape_b]
                }
            };
            let lanes = &bucket.manifolds[block];
            let found = [&lanes.body_a, &lanes.body_b, &lanes.shape_a, &lanes.shape_b];
            ensure(found.map(|lanes| lanes[lane]) == expected, "a lane is of other bodies")?;
            if let Some(lanes) = bucket.constraints.get(block) {
                let found = [lanes.body_a[lane], lanes.body_b[lane]];
                ensure(found == expected[..2], "a constraint is of other bodies")?;
            }
        }
        Ok(())
    }

    fn check_joints(&self) -> Check {
        let joints = &self.state.joints;
        let records = &joints.records;
        ensure(records.len() < (NULL / 2) as usize, "there are too many joints")?;
        ensure(
            records.iter().filter(|r| r.alive).count() == joints.count,
            "joints are miscounted",
        )?;
        ensure(
            is_set(&joints.free, records.len(), |i| !records[i].alive),
            "the free joints are not",
        )?;
        for record in records.iter().filter(|record| record.alive) {
            let (a, b) = (record.body_a, record.body_b);
            ensure(self.is_body(a) && self.is_body(b) && a != b, "a joint joins nothing")?;
            record.def.validate().map_err(|_| "a joint is out of range")?;
        }
        let breakable = |i: usize| records[i].def.break_at.is_some();
        let is_breakable = is_set(&joints.breakable, records.len(), breakable);
        ensure(is_breakable && joints.breakable.is_sorted(), "the breakable joints are not")?;
        let ends = |record: &JointRecord| [record.body_a, record.body_b];
        let links = records.iter().map(|r| r.alive.then(|| (ends(r), r.links)));
        self.check_edges(&links.collect::<Vec<_>>(), |body| {
            self.state.bodies.infos[body].first_joint
        })
    }

    fn check_joint_graph(&self) -> Check {
        let graph = &self.state.joint_graph;
        for (colour, buckets) in graph.colours.keys().zip(graph.colours.list()) {
            ensure(colour < IDLE, "a place is unknown")?;
            macro_rules! check {
                (() $($bucket:ident $class:ident $block:ident),*) => {
                    $(self.check_joint_bucket(colour, JointClass::$class, &buckets.$bucket)?;)*
                };
            }
            joint_classes!(check!());
        }
        let in_trees = graph.count_in_trees();
        ensure(graph.forest.is_stale() || graph.forest.count() == in_trees, "trees lack joints")?;
        let placed: usize = graph.colours.list().iter().map(|colour| colour.count()).sum();
        let records = self.state.joints.records.iter().filter(|record| record.alive);
        let waiting = records.filter(|record| record.place != Place::Asleep).count();
        ensure(placed == graph.count && placed == waiting, "joints are lost")
    }

    fn check_joint_bucket<B: JointLanes>(
        &self,
        colour: usize,
        class: JointClass,
        bucket: &JointBucket<B>,
    ) -> Check {
        let count = blocks(bucket.joints.len());
        ensure(bucket.blocks.len() == count && bucket.stale.len() == count, "blocks are missing")?;
        for slot in 0..count * BLOCK {
            let mut mouse = false;
            let expected = match bucket.joints.get(slot) {
                None => [0; 2],
                Some(&index) => {
                    let record = self.state.joints.records.get(index as usize);
                    let record =
                        record.filter(|record| record.alive).ok_or("a lane has no joint")?;
                    let place = Place::Graph { colour: colour as u8, slot: slot as u32 };
                    ensure(
                        record.place == place && record.class() == Some(class),
                        "a joint is elsewhere",
                    )?;
                    mouse = matches!(record.def.kind, JointKind::Mouse { .. });
                    [record.body_a, record.body_b]
                }
            };
            let mut block = bucket.blocks[slot / BLOCK];
            let FrameLanes { body_a, body_b, .. } = block.frame();
            let found = [body_a[slot % BLOCK], body_b[slot % BLOCK]];
            // A mouse joint, once described, holds on to a point of the world.
            let right = found == expected || mouse && found == [0, expected[1]];
            ensure(right, "a joint's lane is of other bodies")?;
        }
        Ok(())
    }

    fn check_sensors(&self) -> Check {
        let sensors = &self.state.sensors;
        let count = self.state.shapes.records.len();
        let is_sensor =
            |i: usize| self.state.shapes.records[i].alive && self.state.shapes.records[i].sensor;
        let right = is_set(&sensors.shapes, count, is_sensor) && sensors.shapes.is_sorted();
        ensure(right, "the sensors are not")?;
        let there = |shape: u32, generation: u32| {
            let record = self.state.shapes.records.get(shape as usize);
            record.is_some_and(|record| record.alive && record.generation == generation)
        };
        let known = sensors.overlaps.iter().all(|o| {
            there(o.sensor, o.sensor_generation) && there(o.visitor, o.visitor_generation)
        });
        ensure(known && sensors.overlaps.is_sorted(), "sensors see what is not there")
    }
}
