//! tiny-physics: a frame is a copy of the world, or bytes.

use crate::{STEPS, Saver, places};
use std::hint::black_box;
use tiny_physics::{RigidBody, Shape, ShapeDef, Vec2, World};

pub struct Ours {
    world: World,
    frame: World,
    bytes: Vec<u8>,
}

impl Ours {
    pub fn new() -> Self {
        let mut world = World::new(Vec2::new(0.0, -9.8));
        let ground = RigidBody::fixed().shape(Shape::rect(200.0, 1.0).expect("a box"));
        world.add_body(ground.position(Vec2::new(0.0, -1.0))).expect("ground");
        for (x, y) in places() {
            let shape = ShapeDef::new(Shape::rect(0.5, 0.5).expect("a box"));
            let body = RigidBody::dynamic().position(Vec2::new(x, y)).shape(shape);
            world.add_body(body).expect("a box");
        }
        (0..STEPS).for_each(|_| world.step(1.0 / 60.0));
        let (frame, bytes) = (world.clone(), world.to_bytes());
        Self { world, frame, bytes }
    }

    pub fn contacts(&self) -> usize {
        self.world.contact_count()
    }
}

impl Saver for Ours {
    fn frame_bytes(&self) -> usize {
        self.bytes.len()
    }

    fn ways(&self) -> Vec<&'static str> {
        vec!["clone_from there and back", "to_bytes", "restore_bytes", "state_hash"]
    }

    fn run(&mut self, way: usize) {
        match way {
            0 => {
                self.frame.clone_from(black_box(&self.world));
                self.world.clone_from(black_box(&self.frame));
            }
            1 => drop(black_box(self.world.to_bytes())),
            2 => self.world.restore_bytes(black_box(&self.bytes)).expect("own bytes"),
            _ => _ = black_box(self.world.state_hash()),
        }
    }
}
