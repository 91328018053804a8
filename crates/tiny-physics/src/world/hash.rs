//! One number for the whole state.

use super::World;
use crate::codec::{Data, Hasher};
use crate::dynamics::Bucket;
use crate::simd::BLOCK;

impl World {
    /// A hash of all that the next step depends on: equal worlds have equal hashes, on every platform, at
    /// any number of threads and any SIMD level.
    ///
    /// Not in it: statistics, threads, the SIMD level, and the generations of handles, which go on counting when
    /// a world goes back to an earlier frame.
    pub fn state_hash(&self) -> u64 {
        let mut hasher = Hasher::new();
        self.state.step_count.save(&mut hasher);
        self.gravity.save(&mut hasher);
        // Told apart only where it matters: sleepers wake when it changes.
        if let Some(felt) = self.state.gravity.filter(|&felt| felt != self.gravity) {
            felt.save(&mut hasher);
        }
        self.settings.save(&mut hasher);
        self.hash_bodies(&mut hasher);
        self.hash_shapes(&mut hasher);
        self.hash_contacts(&mut hasher);
        self.hash_joints(&mut hasher);
        self.state.sensors.save(&mut hasher);
        self.state.events.save(&mut hasher);
        self.state.tiles.save(&mut hasher);
        hasher.finish()
    }

    fn hash_bodies(&self, hasher: &mut Hasher) {
        let bodies = &self.state.bodies;
        for index in bodies.indices() {
            let i = index as usize;
            hasher.record(&index);
            hasher.record(&bodies.infos[i]);
            hasher.record(&bodies.poses[i]);
            hasher.record(&bodies.rows[i]);
        }
        bodies.awake.save(hasher);
        bodies.free.save(hasher);
    }

    fn hash_shapes(&self, hasher: &mut Hasher) {
        for index in self.state.shapes.indices() {
            let record = &self.state.shapes.records[index as usize];
            hasher.record(&index);
            hasher.record(record);
            hasher.record(&self.state.shapes.rows[index as usize]);
            // When pairs are found depends on the fat box.
            hasher.record(&self.state.broad_phase.fat_aabb(self.state.shapes.proxy(index)));
        }
        self.state.shapes.free.save(hasher);
        self.state.broad_phase.hash_lists(hasher);
    }

    fn hash_contacts(&self, hasher: &mut Hasher) {
        for (place, class, bucket) in self.state.graph.all() {
            hasher.record(&(place as u32, class as u32));
            bucket.contacts.save(hasher);
            for (slot, saved) in bucket.saved_points().enumerate() {
                hasher.record(&saved);
                hasher.record(&rolling_impulse(bucket, slot));
            }
        }
        for contact in self.state.contacts.records.iter().filter(|contact| contact.alive) {
            hasher.record(contact);
        }
        self.state.contacts.free.save(hasher);
        self.state.waiting.save(hasher);
    }

    fn hash_joints(&self, hasher: &mut Hasher) {
        for index in self.state.joints.indices() {
            let record = &self.state.joints.records[index as usize];
            hasher.record(&index);
            hasher.record(record);
            hasher.record(&self.state.joint_graph.impulses(record));
        }
        self.state.joints.free.save(hasher);
    }
}

fn rolling_impulse(bucket: &Bucket, slot: usize) -> f32 {
    bucket.surfaces.get(slot / BLOCK).map_or(0.0, |block| block.rolling_impulse[slot % BLOCK])
}
