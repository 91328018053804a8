//! What happened in the last step, to be read after it.

use super::ids::{JointId, ShapeId};
use crate::codec::data;
use crate::dynamics::clone_by_field;
use crate::math::Vec2;

/// Two shapes began to touch.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ContactBegin {
    /// First shape of the contact.
    pub shape_a: ShapeId,
    /// Second shape.
    pub shape_b: ShapeId,
}

/// Two shapes no longer touch, or one of them is gone (its handle may be stale).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ContactEnd {
    /// First shape of the contact.
    pub shape_a: ShapeId,
    /// Second shape.
    pub shape_b: ShapeId,
}

/// Two shapes hit each other faster than [`Settings::hit_event_threshold`](crate::Settings).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Hit {
    /// First shape of the contact.
    pub shape_a: ShapeId,
    /// Second shape.
    pub shape_b: ShapeId,
    /// Where, world, metres.
    pub position: Vec2,
    /// Unit, from A to B.
    pub normal: Vec2,
    /// Approach speed, metres a second.
    pub speed: f32,
}

/// A joint bore more than it can and is gone.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct JointBreak {
    /// Its handle, now stale.
    pub joint: JointId,
    /// Force on body B when it broke, newtons.
    pub force: Vec2,
    /// Torque on body B when it broke, newton metres.
    pub torque: f32,
    /// The user's number.
    pub user_data: u64,
}

/// The events of one step, each list in a fixed order that threads do not change. Only shapes that ask for
/// events (see [`ShapeDef`](crate::ShapeDef)) have them.
#[derive(PartialEq, Debug, Default)]
pub struct Events {
    pub(crate) contact_begin: Vec<ContactBegin>,
    pub(crate) contact_end: Vec<ContactEnd>,
    pub(crate) hits: Vec<Hit>,
    pub(crate) joint_breaks: Vec<JointBreak>,
    /// Ends that came about between steps, by removal: part of the next step's events.
    pub(crate) pending_end: Vec<ContactEnd>,
}

data!(ContactBegin { shape_a, shape_b });
data!(ContactEnd { shape_a, shape_b });
data!(Hit { shape_a, shape_b, position, normal, speed });
data!(JointBreak { joint, force, torque, user_data });
data!(Events { contact_begin, contact_end, hits, joint_breaks, pending_end });
clone_by_field!(Events { contact_begin, contact_end, hits, joint_breaks, pending_end });

impl Events {
    /// Contacts that began.
    pub fn contact_begin(&self) -> &[ContactBegin] {
        &self.contact_begin
    }

    /// Contacts that ended.
    pub fn contact_end(&self) -> &[ContactEnd] {
        &self.contact_end
    }

    /// Hits.
    pub fn hits(&self) -> &[Hit] {
        &self.hits
    }

    /// Joints that broke.
    pub fn joint_breaks(&self) -> &[JointBreak] {
        &self.joint_breaks
    }

    /// Makes room for the events of a new step.
    pub(crate) fn clear(&mut self) {
        self.contact_begin.clear();
        self.contact_end.clear();
        self.hits.clear();
        self.joint_breaks.clear();
        self.flush_pending();
    }

    /// Makes the ends that came about by removal part of this step.
    pub(crate) fn flush_pending(&mut self) {
        self.contact_end.append(&mut self.pending_end);
    }
}
