//! One number for the whole state.

use super::World;
use crate::describe::Settings;
use crate::dynamics::SavedPoint;
use crate::geometry::Shape;
use crate::math::Vec2;

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

    fn vector(&mut self, value: Vec2) {
        self.float(value.x);
        self.float(value.y);
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
        hash_settings(&mut hasher, &self.settings);
        self.hash_bodies(&mut hasher);
        self.hash_shapes(&mut hasher);
        self.hash_contacts(&mut hasher);
        self.hash_joints(&mut hasher);
        self.hash_sensors(&mut hasher);
        for cells in self.tile_values() {
            cells.iter().for_each(|&value| hasher.word(value.into()));
        }
        hasher.0
    }

    fn hash_bodies(&self, hasher: &mut Hasher) {
        for index in self.bodies.indices() {
            let i = index as usize;
            let (pose, info) = (&self.bodies.poses[i], &self.bodies.infos[i]);
            hasher.word(u64::from(index) << 32 | u64::from(info.generation));
            hasher.word(pose.p.x.to_bits());
            hasher.word(pose.p.y.to_bits());
            hasher.float(pose.q.c);
            hasher.float(pose.q.s);
            self.bodies.rows[i].iter().for_each(|&value| hasher.float(value));
            hasher.float(info.gravity_scale);
            hasher.float(info.linear_damping);
            hasher.float(info.angular_damping);
            hasher.float(info.sleep_speed);
            hasher.word(switches([
                info.enabled,
                info.bullet,
                info.can_sleep,
                info.locks.x,
                info.locks.y,
                info.locks.rotation,
            ]));
            hasher.float(info.sleep_time);
            hasher.float(info.force.x);
            hasher.float(info.force.y);
            hasher.float(info.torque);
            hasher.word(u64::from(info.contact_colours) << 32 | u64::from(info.island_next));
            hasher.word(u64::from(info.awake) | u64::from(info.joint_colours) << 32);
        }
    }

    fn hash_shapes(&self, hasher: &mut Hasher) {
        for index in self.shapes.indices() {
            let record = &self.shapes.records[index as usize];
            hasher.word(u64::from(index) << 32 | u64::from(record.generation));
            hasher.word(u64::from(record.body) << 32 | u64::from(record.next));
            self.shapes.rows[index as usize].iter().for_each(|&value| hasher.float(value));
            if let Shape::Polygon(polygon) = &record.shape {
                polygon.vertices().iter().for_each(|&vertex| hasher.vector(vertex));
                hasher.float(polygon.radius());
            }
            let material = &record.material;
            hasher.float(material.friction);
            hasher.float(material.restitution);
            hasher.float(material.rolling_resistance);
            hasher.float(material.tangent_speed);
            hasher.word(record.filter.category);
            hasher.word(record.filter.mask);
            hasher.word(u64::from(record.filter.group.cast_unsigned()) << 1);
            hasher.word(switches([record.sensor, record.one_way.is_some()]));
            hasher.vector(record.one_way.unwrap_or_default());
            // When pairs are found depends on the fat box.
            if let Some(fat) = self.broad_phase.fat_aabb(self.shapes.proxy(index)) {
                hasher.vector(fat.min);
                hasher.vector(fat.max);
            }
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

    fn hash_sensors(&self, hasher: &mut Hasher) {
        for overlap in &self.sensors.overlaps {
            hasher.word(u64::from(overlap.sensor) << 32 | u64::from(overlap.sensor_generation));
            hasher.word(u64::from(overlap.visitor) << 32 | u64::from(overlap.visitor_generation));
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

/// Names every setting, so that a new one cannot be forgotten here.
fn hash_settings(hasher: &mut Hasher, settings: &Settings) {
    let Settings {
        substeps,
        iterations,
        length_unit,
        contact_hertz,
        contact_damping_ratio,
        push_speed,
        restitution_threshold,
        hit_event_threshold,
        max_speed,
        sleep,
        time_to_sleep,
        continuous,
        friction_mix,
        restitution_mix,
    } = *settings;
    hasher.word(u64::from(substeps) << 32 | u64::from(iterations));
    for value in [
        length_unit,
        contact_hertz,
        contact_damping_ratio,
        push_speed,
        restitution_threshold,
        hit_event_threshold,
        max_speed,
        time_to_sleep,
    ] {
        hasher.float(value);
    }
    hasher.word(switches([sleep, continuous]));
    hasher.word((friction_mix as u64) << 32 | restitution_mix as u64);
}

/// Truth values as the bits of a word.
fn switches<const N: usize>(values: [bool; N]) -> u64 {
    values.iter().fold(1, |word, &value| word << 1 | u64::from(value))
}

fn hash_points(hasher: &mut Hasher, points: [SavedPoint; 2]) {
    for point in points {
        hasher.float(point.id);
        hasher.float(point.normal_impulse);
        hasher.float(point.tangent_impulse);
    }
}
