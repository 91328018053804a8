//! Stand-ins until joints are merged; then this file goes.
use super::{BodyId, JointId, World};
use crate::describe::JointDef;
use crate::error::Error;

/// A joint, to read.
pub struct JointRef;

impl JointRef {
    /// The joined bodies.
    pub fn bodies(&self) -> (BodyId, BodyId) {
        unreachable!()
    }
    /// Its description.
    pub fn def(&self) -> JointDef {
        unreachable!()
    }
}

impl World {
    /// Not yet.
    pub fn joint_ids(&self) -> impl Iterator<Item = JointId> + '_ {
        core::iter::empty()
    }
    /// Not yet.
    pub fn joint(&self, _: JointId) -> Option<JointRef> {
        None
    }
    /// Not yet.
    pub fn joint_count(&self) -> usize {
        0
    }
    /// Not yet.
    pub fn add_joint(&mut self, _: BodyId, _: BodyId, _: JointDef) -> Result<JointId, Error> {
        Err(Error::Unsupported { reason: "joints are not there yet" })
    }
    /// Not yet.
    pub fn remove_joint(&mut self, _: JointId) -> Result<(), Error> {
        Ok(())
    }
}
