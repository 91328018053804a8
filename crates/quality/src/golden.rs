//! Golden hashes of the quality suite: the first steps of each row's worlds.

use crate::row::Row;
use crate::subject::Subject;
use crate::{Variant, rows};
use std::cell::Cell;
use std::rc::Rc;
use tiny_physics::{DVec2, JointDef, RigidBody, SimdLevel, Vec2};
use tiny_physics_scenes::{Golden, Host, Scene, WorldHost};

/// Steps of each world of a row that count.
const STEPS: u32 = 80;

/// The golden hashes of the rows.
pub fn golden() -> Vec<Golden> {
    Golden::read(include_str!("../tests/golden.txt"))
}

/// The row that a line of the table is of.
pub fn row_of(line: &Golden) -> Option<&'static Row> {
    rows().iter().find(|row| name_of(row) == line.name)
}

/// A row's name in the table: without spaces, and other than that of any scene.
fn name_of(row: &Row) -> String {
    format!("quality/{}", row.name.replace(' ', "_"))
}

/// Plays a row, and hashes the state of its worlds after each of their first steps.
///
/// The rows' scenes are built, and bodies pushed, before the steps that count, so measures, which use the standard
/// library's sine, have no part in it. A level that this machine lacks counts as the best that it has.
pub fn row_hash(row: &Row, level: SimdLevel, threads: usize) -> Golden {
    let hash = Rc::new(Cell::new(0));
    let make = |scene: &Scene| -> Box<dyn Subject> {
        let mut host = WorldHost::new(scene.gravity, scene.settings);
        let world = host.world_mut();
        // What cannot be set stays at the best level.
        let _ = world.set_simd(level);
        world.set_threads(threads);
        Box::new(Hashed { host, left: STEPS, hash: hash.clone() })
    };
    row.run(&make, Variant::Usual, false, &mut |_, _| {});
    Golden { name: name_of(row), steps: STEPS, hash: hash.get() }
}

/// A world that hashes its first steps and then stands still.
struct Hashed {
    host: WorldHost,
    left: u32,
    hash: Rc<Cell<u64>>,
}

impl Subject for Hashed {
    fn angle(&self, body: usize) -> f64 {
        self.host.angle(body)
    }

    fn angular_velocity(&self, body: usize) -> f32 {
        self.host.angular_velocity(body)
    }
}

impl Host for Hashed {
    fn add_body(&mut self, body: &RigidBody) -> usize {
        self.host.add_body(body)
    }

    fn remove_body(&mut self, body: usize) {
        self.host.remove_body(body);
    }

    fn add_joint(&mut self, a: usize, b: usize, def: &JointDef) -> usize {
        self.host.add_joint(a, b, def)
    }

    fn remove_joint(&mut self, joint: usize) {
        self.host.remove_joint(joint);
    }

    fn position(&self, body: usize) -> DVec2 {
        self.host.position(body)
    }

    fn velocity(&self, body: usize) -> Vec2 {
        self.host.velocity(body)
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        self.host.set_velocity(body, velocity);
    }

    fn set_angular_velocity(&mut self, body: usize, radians_per_second: f32) {
        self.host.set_angular_velocity(body, radians_per_second);
    }

    fn apply_force(&mut self, body: usize, newtons: Vec2) {
        self.host.apply_force(body, newtons);
    }

    fn is_awake(&self, body: usize) -> bool {
        self.host.is_awake(body)
    }

    fn wake(&mut self, body: usize) {
        self.host.wake(body);
    }

    fn step(&mut self, dt: f32) {
        if self.left > 0 {
            self.left -= 1;
            self.host.step(dt);
            self.hash.set(self.hash.get().rotate_left(5) ^ self.host.world().state_hash());
        }
    }
}
