//! Says in words what is wrong with a running world: where, since when, why, and what to change.
//!
//! ```
//! use tiny_physics::{RigidBody, Shape, Vec2, World};
//! use tiny_physics_doctor::{Code, Doctor};
//! # fn main() -> Result<(), tiny_physics::Error> {
//! let mut world = World::new(Vec2::new(0.0, -9.8));
//! world.add_body(RigidBody::fixed().shape(Shape::rect(10.0, 1.0)?))?;
//! let crate_ = RigidBody::dynamic().shape(Shape::rect(0.5, 0.5)?);
//! world.add_body(crate_.position(Vec2::new(0.0, 1.1)))?; // 40 cm inside the ground
//! let mut doctor = Doctor::new();
//! for _ in 0..60 {
//!     world.step(1.0 / 60.0);
//!     doctor.watch(&world);
//! }
//! let report = doctor.report();
//! assert_eq!(report.findings[0].code, Code::OverlapAtStart);
//! println!("{report}");
//! # Ok(())
//! # }
//! ```
//!
//! [`Doctor::watch`] costs a few per cent of a step: it glances at every body (at most 512 a step, in turn), and examines a
//! few thoroughly: those that are new, that were hit, that look ill, and the others one after the other. Its memory is
//! bounded by the number of bodies. It stands on the engine's public interface and changes nothing.

mod checks;
mod code;
mod doctor;
mod finding;
mod look;
mod report;
mod round;
mod trace;
mod track;

pub use code::{Code, Severity};
pub use doctor::Doctor;
pub use finding::{Figure, Finding, Who};
pub use report::Report;
pub use trace::{Trace, TracedContact};
