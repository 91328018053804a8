//! Joints (stand-in until the joint stores are merged).
use super::Bodies;
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct Joints;
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct JointGraph;
impl Joints {
    pub(crate) fn may_collide(&self, _: &Bodies, _: u32, _: u32) -> bool {
        true
    }
    pub(crate) fn awake_pairs(&self, _: &Bodies) -> impl Iterator<Item = (u32, u32)> + '_ {
        core::iter::empty()
    }
    pub(crate) fn put_to_sleep(&mut self, _: &Bodies, _: &mut JointGraph, _: u32) {}
    pub(crate) fn wake(&mut self, _: &Bodies, _: &mut JointGraph, _: u32) {}
}
