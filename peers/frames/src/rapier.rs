//! Rapier: a frame is what serde and bincode make of its world. Its world cannot be cloned.

use crate::{STEPS, Saver, places};
use rapier2d::prelude::*;
use std::hint::black_box;

pub struct Rapier {
    world: PhysicsWorld,
    bytes: Vec<u8>,
}

impl Rapier {
    pub fn new() -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, -9.8);
        let ground = RigidBodyBuilder::fixed().translation(Vector::new(0.0, -1.0));
        world.insert(ground, ColliderBuilder::cuboid(200.0, 1.0));
        for (x, y) in places() {
            let body = RigidBodyBuilder::dynamic().translation(Vector::new(x, y));
            world.insert(body, ColliderBuilder::cuboid(0.5, 0.5));
        }
        (0..STEPS).for_each(|_| world.step());
        let bytes = bincode::serialize(&world).expect("a world as bytes");
        Self { world, bytes }
    }

    pub fn contacts(&self) -> usize {
        let pairs = self.world.narrow_phase.contact_pairs();
        pairs.filter(|pair| pair.has_any_active_contact()).count()
    }
}

impl Saver for Rapier {
    fn frame_bytes(&self) -> usize {
        self.bytes.len()
    }

    fn ways(&self) -> Vec<&'static str> {
        vec!["serialize (bincode)", "deserialize (bincode)"]
    }

    fn run(&mut self, way: usize) {
        match way {
            0 => drop(black_box(bincode::serialize(&self.world))),
            _ => self.world = bincode::deserialize(black_box(&self.bytes)).expect("own bytes"),
        }
    }
}
