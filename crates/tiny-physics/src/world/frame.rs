//! Frames: copies of a world to go back to.

use super::{Scratch, Stats, World};
use core::mem::take;
use std::sync::OnceLock;

/// A copy has the same future, bit for bit. It shares the threads of the original; statistics start
/// anew.
///
/// `clone_from` goes back to a saved frame in place, or saves one over an older one, without
/// allocating where the memory at hand is enough. The world keeps its own threads, SIMD level and statistics.
/// Handles that were valid in the frame are valid again. Handles made since, in a time that is now undone,
/// are refused for good: bodies that are added after going back get handles that were never given.
///
/// ```
/// use tiny_physics::{RigidBody, Shape, Vec2, World};
/// # fn main() -> Result<(), tiny_physics::Error> {
/// let mut world = World::new(Vec2::new(0.0, -9.8));
/// let ball = || RigidBody::new(Shape::Circle { radius: 0.5 }, Vec2::ZERO, 1.0);
/// let first = world.add_body(ball())?;
/// let frame = world.clone();
/// world.step(1.0 / 60.0);
/// let undone = world.add_body(ball())?;
/// world.clone_from(&frame);
/// let again = world.add_body(ball())?;
/// assert!(world.body(first).is_some() && world.body(again).is_some());
/// assert!(world.body(undone).is_none());
/// # Ok(())
/// # }
/// ```
impl Clone for World {
    fn clone(&self) -> Self {
        Self {
            gravity: self.gravity,
            settings: self.settings,
            state: self.state.clone(),
            last: self.last.clone(),
            hooks: self.hooks.clone(),
            moved: OnceLock::new(),
            level: self.level,
            pool: self.pool.clone(),
            stats: Stats::default(),
            scratch: Scratch::default(),
        }
    }

    fn clone_from(&mut self, source: &Self) {
        let Self {
            gravity,
            settings,
            state,
            last,
            hooks,
            moved,
            level: _,
            pool: _,
            stats: _,
            scratch: _,
        } = self;
        moved.take();
        *gravity = source.gravity;
        *settings = source.settings;
        state.clone_from(&source.state);
        last.clone_from(&source.last);
        hooks.clone_from(&source.hooks);
    }
}

impl World {
    /// Takes over what belongs to the user's code and the machine, not to the state: hooks, threads, SIMD level.
    pub(crate) fn take_equipment(&mut self, other: &mut Self) {
        self.hooks = take(&mut other.hooks);
        self.pool = take(&mut other.pool);
        self.level = other.level;
    }
}
