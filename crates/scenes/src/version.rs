//! The version of the scene format, which both the scene and what is said of a wrong one need.

/// The version of the scene format that this crate writes and reads.
pub const VERSION: u32 = 1;
