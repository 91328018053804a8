//! Worlds as bytes: frames for files and networks.
//!
//! A header (magic, version, length and hash of what follows), then gravity, settings and all stores of the state one
//! after the other, and what is known of the last step. Whatever can be derived at little cost is left out. Reading checks the hash, which finds accidents; then every link
//! of the stores, which finds the rest.

use super::World;
use crate::codec::{Data, Reader, Sink, bad, hash_bytes};
use crate::error::Error;
use crate::math::Vec2;

/// The first bytes of a frame.
const MAGIC: [u8; 4] = *b"tpw1";
/// Goes up whenever the bytes of the same world change.
const VERSION: u32 = 22;
/// Magic, version, length, hash.
const HEADER: usize = 4 + 4 + 8 + 8;

impl World {
    /// The whole world as bytes, for [`World::from_bytes`] in another process or platform. Hooks, threads,
    /// SIMD level and statistics are not part of it.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut sink = Sink::new();
        sink.put([0; HEADER]);
        self.save(&mut sink);
        self.last.save(&mut sink);
        let mut bytes = sink.bytes();
        let (length, hash) = (bytes.len() - HEADER, hash_bytes(&bytes[HEADER..]));
        bytes[..4].copy_from_slice(&MAGIC);
        bytes[4..8].copy_from_slice(&VERSION.to_le_bytes());
        bytes[8..16].copy_from_slice(&(length as u64).to_le_bytes());
        bytes[16..24].copy_from_slice(&hash.to_le_bytes());
        bytes
    }

    /// The bytes of a world that is this one again after the next step, but not before: what that step finds anew whatever
    /// comes first is left out, which saves an eighth of what they take as differences where much touches.
    pub(crate) fn to_bytes_of_next(&self) -> Vec<u8> {
        let mut next = self.clone();
        next.state.graph.forget_geometry();
        next.to_bytes()
    }

    /// The world of [`World::to_bytes`]: it goes on bit for bit as the original does, and handles of the
    /// original are valid in it. One thread, the best SIMD level of this machine.
    ///
    /// # Errors
    /// The bytes are not those of a world, of another version, truncated or damaged.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        let payload = check_header(bytes)?;
        let mut reader = Reader(payload);
        let mut world = Self::load(&mut reader)?;
        reader.finish()?;
        world.check_loaded().map_err(bad)?;
        world.hooks.loaded = true;
        Ok(world)
    }

    /// Goes back to the world of [`World::to_bytes`] in place: what [`Clone::clone_from`] is for frames in
    /// memory. Keeps hooks, threads, SIMD level and statistics.
    ///
    /// # Errors
    /// As [`World::from_bytes`]; this world has not changed then.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let Self { gravity, settings, state, last, .. } = Self::from_bytes(bytes)?;
        // Generations go on from where this world or the frame stands, whichever has counted further.
        self.state.clone_from(&state);
        (self.gravity, self.settings, self.last) = (gravity, settings, last);
        self.hooks.loaded = true;
        self.moved.take();
        Ok(())
    }
}

/// What follows the header, if that is right.
fn check_header(bytes: &[u8]) -> Result<&[u8], Error> {
    let mut reader = Reader(bytes);
    if <[u8; 4]>::load(&mut reader)? != MAGIC {
        return Err(bad("it does not begin like one"));
    }
    if u32::load(&mut reader)? != VERSION {
        return Err(bad("it was written by another version of the engine"));
    }
    let (length, hash) = (u64::load(&mut reader)?, u64::load(&mut reader)?);
    if reader.0.len() as u64 != length && !cfg!(fuzzing) {
        return Err(bad("it ends too early or too late"));
    }
    if hash_bytes(reader.0) != hash && !cfg!(fuzzing) {
        return Err(bad("it is damaged"));
    }
    Ok(reader.0)
}

impl World {
    /// A hash of all that the next step depends on: equal worlds have equal hashes, on every platform, at
    /// any number of threads and any SIMD level. It is that of the frame's bytes, but for what is known of the last step and
    /// the generations of handles, which go on counting when a world goes back to an earlier frame.
    pub fn state_hash(&self) -> u64 {
        let mut sink = Sink::hashing();
        self.save(&mut sink);
        sink.finish()
    }

    fn save(&self, sink: &mut Sink) {
        self.gravity.save(sink);
        self.settings.save(sink);
        self.state.save(sink);
    }

    fn load(reader: &mut Reader<'_>) -> Result<Self, Error> {
        let mut world = Self::with_settings(Vec2::load(reader)?, Data::load(reader)?);
        (world.state, world.last) = (Data::load(reader)?, Data::load(reader)?);
        Ok(world)
    }
}

/// Worlds as a value in files of any format: one string of bytes, [`World::to_bytes`]; in base64 where the format is
/// text.
#[cfg(feature = "serde")]
mod files {
    use super::World;
    use crate::codec::packed;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    impl Serialize for World {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            packed::serialize(&self.to_bytes(), serializer)
        }
    }

    /// Fails where [`World::from_bytes`] fails.
    impl<'de> Deserialize<'de> for World {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            packed::deserialize(deserializer, "a saved world", Self::from_bytes)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::state::State;
    use super::*;
    use crate::{BodyKind, JointDef, RigidBody, Shape, ShapeDef, SimdLevel, Vec2};

    /// Something of everything: piles, joints of several kinds, sensors, sleepers, gaps in all lists.
    fn busy_world() -> World {
        let mut world = World::new(Vec2::new(0.0, -9.8));
        let ground = RigidBody::fixed().shape(Shape::rect(20.0, 1.0).unwrap());
        let ground = world.add_body(ground).unwrap();
        let gate = ShapeDef::new(Shape::rect(3.0, 3.0).unwrap()).sensor();
        world.add_body(RigidBody::fixed().position(Vec2::new(2.0, 2.0)).shape(gate)).unwrap();
        let mut ids = Vec::new();
        for i in 0..24 {
            let shape = match i % 4 {
                0 => Shape::circle(0.4).unwrap(),
                1 => Shape::rect(0.5, 0.3).unwrap(),
                2 => Shape::regular(5, 0.5).unwrap(),
                _ => Shape::capsule(Vec2::new(-0.3, 0.0), Vec2::new(0.3, 0.0), 0.2).unwrap(),
            };
            let mut shape = ShapeDef::new(shape);
            shape.contact_events = i % 3 == 0;
            let place = Vec2::new((i % 6) as f32 - 3.0, 1.5 + (i / 6) as f32);
            let body = RigidBody::dynamic().position(place).shape(shape);
            ids.push(world.add_body(body).unwrap());
        }
        let lift = RigidBody { kind: BodyKind::Kinematic, ..RigidBody::dynamic() };
        world.add_body(lift.position(Vec2::new(8.0, 3.0)).velocity(Vec2::new(0.1, 0.0))).unwrap();
        let kinds =
            [JointDef::revolute(), JointDef::distance(1.0), JointDef::weld(), JointDef::gear(2.0)];
        for (i, def) in kinds.into_iter().enumerate() {
            world.add_joint(ids[i], ids[i + 6], def.break_at(1.0e5, 1.0e5)).unwrap();
        }
        world.add_joint(ground, ids[23], JointDef::wheel(Vec2::Y)).unwrap();
        (0..40).for_each(|_| world.step(1.0 / 60.0));
        world.remove_body(ids[11]).unwrap();
        world.remove_body(ids[17]).unwrap();
        world.body_mut(ids[5]).unwrap().sleep();
        world
    }

    fn set_hash(bytes: &mut [u8]) {
        let hash = hash_bytes(&bytes[HEADER..]);
        bytes[16..24].copy_from_slice(&hash.to_le_bytes());
    }

    #[test]
    fn bytes_bring_the_same_world_back() {
        let mut world = busy_world();
        let bytes = world.to_bytes();
        let mut copy = World::from_bytes(&bytes).unwrap();
        assert_eq!(copy.to_bytes(), bytes);
        for _ in 0..120 {
            assert_eq!(copy.state_hash(), world.state_hash());
            world.step(1.0 / 60.0);
            copy.step(1.0 / 60.0);
            assert_eq!(copy.events(), world.events());
        }
    }

    /// Not even in lanes that no contact or joint is in.
    #[test]
    fn bytes_do_not_depend_on_the_simd_level() {
        let bytes = |level| {
            let mut world = World::from_bytes(&busy_world().to_bytes()).unwrap();
            world.set_simd(level).unwrap();
            (0..20).for_each(|_| world.step(1.0 / 60.0));
            world.to_bytes()
        };
        let expected = bytes(SimdLevel::Scalar);
        for level in SimdLevel::available() {
            let found = bytes(level);
            let first = (HEADER..expected.len()).find(|&i| expected[i] != found[i]);
            assert_eq!(first, None, "{level:?}");
        }
    }

    #[test]
    fn going_back_keeps_what_is_no_state_and_gives_no_handle_twice() {
        let mut world = busy_world();
        world.set_threads(2);
        let (bytes, first) = (world.to_bytes(), world.body_ids().next().unwrap());
        let frame = world.state_hash();
        world.step(1.0 / 60.0);
        let circle = || RigidBody::dynamic().shape(Shape::circle(0.3).unwrap());
        let undone = world.add_body(circle()).unwrap();
        let later = (world.state_hash(), *world.stats());
        world.restore_bytes(&bytes[..bytes.len() - 1]).unwrap_err();
        assert_eq!((world.state_hash(), *world.stats()), later);
        world.restore_bytes(&bytes).unwrap();
        assert_eq!((world.state_hash(), *world.stats()), (frame, later.1));
        assert_eq!(world.threads(), 2);
        assert!(world.body(first).is_some() && world.body(undone).is_none());
        assert_ne!(world.add_body(circle()).unwrap(), undone);
        world.validate().unwrap();
    }

    /// What the broad phase has of a shape must be what the shape says.
    #[test]
    fn refuses_boxes_and_trees_that_are_not_those_of_the_shapes() {
        let mut world = busy_world();
        let shape = world.state.shapes.indices().last().unwrap() as usize;
        let fat = world.state.shapes.fat[shape];
        world.state.shapes.fat[shape] = fat.grown(0.01);
        World::from_bytes(&world.to_bytes()).unwrap_err();
        world.state.shapes.fat[shape] = fat;
        World::from_bytes(&world.to_bytes()).unwrap();
        let pair = world.state.contacts.records.iter_mut().find(|contact| contact.alive).unwrap();
        core::mem::swap(&mut pair.shape_a, &mut pair.shape_b);
        World::from_bytes(&world.to_bytes()).unwrap_err();
    }

    /// What decides when something is done next is state as well.
    #[test]
    fn the_hash_covers_what_the_next_step_depends_on() {
        let mut world = busy_world();
        let hash = world.state_hash();
        let changes: [fn(&mut State); 6] = [
            |state| state.graph.news += 1,
            |state| state.graph.mixed ^= true,
            |state| state.shapes.changed_ground.push(crate::dynamics::Change::Parts { body: 0 }),
            |state| state.waiting.stale ^= true,
            |state| state.bodies.awake_unsorted ^= true,
            |state| state.inv_h += 1.0,
        ];
        for (index, change) in changes.into_iter().enumerate() {
            let state = world.state.clone();
            change(&mut world.state);
            assert_ne!(world.state_hash(), hash, "{index}");
            world.state = state;
            assert_eq!(world.state_hash(), hash, "{index}");
        }
        let shape = world.shape_ids().last().unwrap();
        world.state.broad_phase.buffer(world.state.shapes.proxy(shape.index));
        assert_ne!(world.state_hash(), hash, "asked boxes");
    }

    #[test]
    fn frames_of_small_worlds_are_small() {
        let mut world = World::new(Vec2::new(0.0, -9.8));
        let empty = world.to_bytes().len();
        let ground = RigidBody::fixed().shape(Shape::rect(20.0, 1.0).unwrap());
        world.add_body(ground).unwrap();
        let square = Shape::rect(0.5, 0.5).unwrap();
        world.add_body(RigidBody::dynamic().position(Vec2::new(0.0, 1.6)).shape(square)).unwrap();
        (0..30).for_each(|_| world.step(1.0 / 60.0));
        assert_eq!(world.contact_count(), 1);
        let one = world.to_bytes().len();
        assert!(empty < 700 && one < 2030, "{empty} and {one} bytes");
    }

    #[test]
    fn a_world_that_forgot_a_pair_says_so() {
        let mut world = busy_world();
        world.step(1.0 / 60.0);
        let contacts = world.state.contacts.records.iter().enumerate().filter(|(_, c)| c.alive);
        let mut forgotten = 0;
        for index in contacts.map(|(index, _)| index as u32) {
            let mut copy = world.clone();
            copy.state.graph.remove(&mut copy.state.bodies, &mut copy.state.contacts, index);
            copy.state.contacts.remove(&mut copy.state.bodies, index);
            // Pairs of shapes that left their fat boxes are looked for anyway.
            let is_forgotten = copy.validate().is_err_and(|e| e.contains("will not meet"));
            // It is read, as a hook may have decided so.
            let read = World::from_bytes(&copy.to_bytes()).unwrap();
            assert_eq!(read.validate().is_err(), is_forgotten);
            forgotten += usize::from(is_forgotten);
        }
        assert!(forgotten > 5, "{forgotten}");
    }

    #[test]
    fn refuses_what_is_cut_off_or_damaged() {
        let bytes = busy_world().to_bytes();
        for length in (0..bytes.len()).step_by(7) {
            assert!(World::from_bytes(&bytes[..length]).is_err());
        }
        let mut damaged = bytes.clone();
        damaged[bytes.len() / 2] ^= 4;
        assert!(World::from_bytes(&damaged).is_err());
        let mut other = bytes;
        other[4] += 1;
        let error = World::from_bytes(&other).unwrap_err().to_string();
        assert!(error.contains("another version"), "{error}");
    }

    /// Found by fuzzing: counters that are full already.
    #[test]
    fn full_counters_do_not_overflow() {
        let mut world = busy_world();
        world.state.graph.news = u32::MAX;
        let mut other = World::from_bytes(&world.to_bytes()).expect("a frame");
        for i in 0..4 {
            let ball = ShapeDef::new(Shape::circle(0.61).unwrap());
            let body = RigidBody::dynamic().position(Vec2::new(50.0, 1.2 * i as f32)).shape(ball);
            other.add_body(body).unwrap();
        }
        (0..9).for_each(|_| other.step(1.0 / 60.0));
        world.state.step_count = u64::MAX;
        let error = World::from_bytes(&world.to_bytes()).unwrap_err().to_string();
        assert!(error.contains("steps"), "{error}");
    }

    /// Found by fuzzing: a pair that waits for its contact the wrong way round as well.
    #[test]
    fn a_pair_waits_for_one_contact() {
        let mut world = World::new(Vec2::new(0.0, -9.8));
        let ground = RigidBody::fixed().shape(Shape::rect(20.0, 1.0).unwrap());
        world.add_body(ground).unwrap();
        let ball = RigidBody::dynamic().shape(Shape::circle(0.5).unwrap());
        world.add_body(ball.position(Vec2::new(0.0, 2.0))).unwrap();
        let waits = (0..60).any(|_| {
            world.step(1.0 / 60.0);
            !world.state.waiting.pairs.is_empty()
        });
        assert!(waits, "no pair has waited");
        let (a, b) = world.state.waiting.pairs[0];
        world.state.waiting.pairs.push((a, b));
        let mut copy = World::from_bytes(&world.to_bytes()).unwrap();
        (0..60).for_each(|_| copy.step(1.0 / 60.0));
        assert_eq!((copy.state.contacts.records.len(), copy.validate()), (1, Ok(())));
        world.state.waiting.pairs.push((b, a));
        let error = World::from_bytes(&world.to_bytes()).unwrap_err().to_string();
        assert!(error.contains("wait"), "{error}");
    }

    /// Damage with a right hash is refused, or makes a world that can be used.
    #[test]
    fn survives_malice() {
        let bytes = busy_world().to_bytes();
        let mut state = 1_u64;
        let mut random = |below: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as usize % below
        };
        let (mut refused, rounds) = (0, 3000);
        for _ in 0..rounds {
            let mut bad = bytes.clone();
            for _ in 0..=random(2) {
                let at = HEADER + random(bad.len() - HEADER);
                bad[at] = match random(4) {
                    0 => 0,
                    1 => 255,
                    2 => bad[at] ^ 1 << random(8),
                    _ => random(256) as u8,
                };
            }
            set_hash(&mut bad);
            match World::from_bytes(&bad) {
                Err(_) => refused += 1,
                Ok(mut world) => {
                    (0..3).for_each(|_| world.step(1.0 / 60.0));
                    let bodies: Vec<_> = world.body_ids().collect();
                    bodies.into_iter().step_by(5).for_each(|id| world.remove_body(id).unwrap());
                    world.step(1.0 / 60.0);
                }
            }
        }
        assert!(refused > rounds / 20, "{refused}");
    }
}
