//! One number for the whole state.

use super::World;
use crate::codec::{Data, Sink};
use crate::dynamics::{Bucket, SavedPoint};
use crate::simd::BLOCK;

/// FNV-1a over 64-bit words, with a mix.
struct Hasher(u64);

impl Sink for Hasher {
    fn u8(&mut self, value: u8) {
        self.u64(value.into());
    }
    fn u32(&mut self, value: u32) {
        self.u64(value.into());
    }
    #[inline]
    fn u64(&mut self, value: u64) {
        self.0 = (self.0 ^ value).wrapping_mul(0x0000_0100_0000_01B3);
        self.0 ^= self.0 >> 29;
    }
    /// Generations say how often the user went back, not what will happen.
    fn apart(&mut self, _: u32) {}
    fn pad(&mut self, _: usize) {}
}

impl World {
    /// A hash of all that the next step depends on: equal worlds have equal hashes, on every platform, at
    /// any number of threads and any SIMD level.
    ///
    /// Not in it: statistics, threads, the SIMD level, and the generations of handles, which go on counting when
    /// a world goes back to an earlier frame.
    pub fn state_hash(&self) -> u64 {
        let mut hasher = Hasher(0xCBF2_9CE4_8422_2325);
        self.step_count.save(&mut hasher);
        self.gravity.save(&mut hasher);
        self.settings.save(&mut hasher);
        self.hash_bodies(&mut hasher);
        self.hash_shapes(&mut hasher);
        self.hash_contacts(&mut hasher);
        self.hash_joints(&mut hasher);
        self.sensors.save(&mut hasher);
        self.events.save(&mut hasher);
        self.tiles.save(&mut hasher);
        hasher.0
    }

    fn hash_bodies(&self, hasher: &mut Hasher) {
        let bodies = &self.bodies;
        for index in bodies.indices() {
            let i = index as usize;
            index.save(hasher);
            bodies.infos[i].save(hasher);
            bodies.poses[i].save(hasher);
            bodies.rows[i].save(hasher);
        }
        bodies.awake.save(hasher);
        bodies.free.save(hasher);
    }

    fn hash_shapes(&self, hasher: &mut Hasher) {
        for index in self.shapes.indices() {
            let record = &self.shapes.records[index as usize];
            index.save(hasher);
            record.save(hasher);
            self.shapes.rows[index as usize].save(hasher);
            // When pairs are found depends on the fat box.
            self.broad_phase.fat_aabb(self.shapes.proxy(index)).save(hasher);
        }
        self.shapes.free.save(hasher);
        self.broad_phase.hash_lists(hasher);
    }

    fn hash_contacts(&self, hasher: &mut Hasher) {
        for bucket in self.graph.buckets.iter().flatten() {
            bucket.contacts.save(hasher);
            for (slot, saved) in bucket.saved_points().enumerate() {
                hash_points(hasher, saved);
                rolling_impulse(bucket, slot).save(hasher);
            }
        }
        for contact in self.contacts.records.iter().filter(|contact| contact.alive) {
            contact.save(hasher);
        }
        self.contacts.free.save(hasher);
        self.waiting.save(hasher);
    }

    fn hash_joints(&self, hasher: &mut Hasher) {
        for index in self.joints.indices() {
            let record = &self.joints.records[index as usize];
            index.save(hasher);
            record.save(hasher);
            self.joint_graph.impulses(record).save(hasher);
        }
        self.joints.free.save(hasher);
    }
}

fn rolling_impulse(bucket: &Bucket, slot: usize) -> f32 {
    bucket.surfaces.get(slot / BLOCK).map_or(0.0, |block| block.rolling_impulse[slot % BLOCK])
}

fn hash_points(hasher: &mut Hasher, points: [SavedPoint; 2]) {
    points.iter().for_each(|point| point.save(hasher));
}
