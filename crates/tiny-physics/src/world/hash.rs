//! One number for the whole state.

use super::World;
use crate::dynamics::SavedPoint;

/// FNV-1a over 64-bit words, with a final mix.
struct Hasher(u64);

impl Hasher {
    fn word(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01B3);
        self.0 ^= self.0 >> 29;
    }

    fn float(&mut self, value: f32) {
        self.word(u64::from(value.to_bits()));
    }
}

impl World {
    /// A hash of all that the next step depends on: equal worlds have equal hashes, on every platform, at
    /// any number of threads and any SIMD level.
    pub fn state_hash(&self) -> u64 {
        let mut hasher = Hasher(0xCBF2_9CE4_8422_2325);
        hasher.word(self.step_count);
        hasher.float(self.gravity.x);
        hasher.float(self.gravity.y);
        self.hash_bodies(&mut hasher);
        self.hash_contacts(&mut hasher);
        self.hash_joints(&mut hasher);
        hasher.0
    }

    fn hash_bodies(&self, hasher: &mut Hasher) {
        for index in self.bodies.indices() {
            let i = index as usize;
            let (pose, info) = (&self.bodies.poses[i], &self.bodies.infos[i]);
            hasher.word(index.into());
            hasher.word(pose.p.x.to_bits());
            hasher.word(pose.p.y.to_bits());
            hasher.float(pose.q.c);
            hasher.float(pose.q.s);
            self.bodies.rows[i].iter().for_each(|&value| hasher.float(value));
            hasher.float(info.sleep_time);
            hasher.float(info.force.x);
            hasher.float(info.force.y);
            hasher.float(info.torque);
            hasher.word(u64::from(info.contact_colours) << 32 | u64::from(info.island_next));
            hasher.word(u64::from(info.awake) | u64::from(info.joint_colours) << 32);
        }
    }

    fn hash_joints(&self, hasher: &mut Hasher) {
        for index in self.joints.indices() {
            let record = &self.joints.records[index as usize];
            hasher.word(u64::from(record.body_a) << 32 | u64::from(record.body_b));
            for value in self.joint_graph.impulses(record) {
                hasher.float(value);
            }
        }
    }

    fn hash_contacts(&self, hasher: &mut Hasher) {
        for bucket in self.graph.buckets.iter().flatten() {
            bucket.contacts.iter().for_each(|&contact| hasher.word(contact.into()));
            for saved in bucket.saved_points() {
                hash_points(hasher, saved);
            }
        }
        for contact in self.contacts.records.iter().filter(|contact| contact.alive) {
            hasher.word(u64::from(contact.shape_a) << 32 | u64::from(contact.shape_b));
            hash_points(hasher, contact.saved);
        }
    }
}

fn hash_points(hasher: &mut Hasher, points: [SavedPoint; 2]) {
    for point in points {
        hasher.float(point.id);
        hasher.float(point.normal_impulse);
        hasher.float(point.tangent_impulse);
    }
}
