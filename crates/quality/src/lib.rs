//! The quality suites: scenes whose right answer a formula or the best engine measured fixes in advance,
//! and what an engine makes of them at its defaults.
//!
//! [`rows`] lists the 26 of the first suite, [`hard_rows`] those in which engines fail; [`Row::run`] plays one on any engine that is a [`Subject`]. Each row has a second
//! variant of other sizes, masses and speeds, which shows that no row passes by knowing its scene.
//!
//! ```
//! use tiny_physics_quality::{Variant, find, our_engine};
//! let report = find("free spin").unwrap().run(&our_engine, Variant::Usual, false, &mut |_, _| {});
//! assert_eq!(report.id, "18");
//! ```

#![allow(clippy::neg_cmp_op_on_partial_ord, reason = "what is not a number has failed as well")]

pub mod arena;
mod golden;
mod hard;
mod lab;
mod peers;
mod report;
mod row;
mod rows;
mod scenery;
mod still;
mod subject;
mod suites;
pub mod table;
mod target;

pub use golden::{golden, row_hash, row_of};
pub use hard::hard_rows;
pub use lab::{Lab, MakeSubject, Trial, Variant};
pub use peers::{COMMAND as PEERS_COMMAND, Figure, PeerMeasure, PeerRow, Peers};
pub use report::{Measure, Report};
pub use row::{Row, Suite};
pub use rows::rows;
pub use still::still;
pub use subject::{Subject, our_engine};
pub use suites::{all_rows, find, resolve};
pub use target::Target;
