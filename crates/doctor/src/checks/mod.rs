//! What is looked for, one file a subject.

pub(crate) mod energy;
pub(crate) mod flight;
pub(crate) mod joints;
pub(crate) mod overlap;
pub(crate) mod rest;
pub(crate) mod scale;
pub(crate) mod slow;
pub(crate) mod surface;
pub(crate) mod time;
