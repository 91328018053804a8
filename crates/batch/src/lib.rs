//! Thousands of small worlds at once: [`WorldBatch`] steps copies of template worlds on all cores, [`TaskBatch`]
//! runs whole tasks for agents, with rewards and episodes.
//!
//! Worlds share nothing and wait for nobody, so results do not depend on the number of threads. Numbers go in and
//! come out as flat arrays, world after world.
//!
//! ```
//! use tiny_physics::{RigidBody, Shape, Vec2, World};
//! use tiny_physics_batch::{Actuator, Reading, WorldBatch};
//! # fn main() -> Result<(), tiny_physics_batch::BatchError> {
//! let mut world = World::new(Vec2::ZERO);
//! let puck = world.add_body(RigidBody::new(Shape::circle(0.5)?, Vec2::ZERO, 2.0))?;
//! let mut batch = WorldBatch::new(&[world], 3, 2)?;
//! batch.apply(&[Actuator::ForceX(puck)], &[0.0, 60.0, 120.0])?;
//! batch.step(1.0 / 60.0)?;
//! let mut speeds = [0.0; 3];
//! batch.read(&[Reading::VelocityX(puck)], &mut speeds)?;
//! assert_eq!(speeds, [0.0, 0.5, 1.0]);
//! # Ok(())
//! # }
//! ```

mod actuator;
mod batch;
mod error;
mod random;
mod reading;
mod task;
mod task_batch;
pub mod tasks;
mod threads;

pub use actuator::Actuator;
pub use batch::WorldBatch;
pub use error::BatchError;
pub use random::Random;
pub use reading::{Reading, Sight};
pub use task::{Outcome, Spec, Task, View};
pub use task_batch::{Autoreset, TaskBatch, Tasks};
