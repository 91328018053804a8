//! What happened in the last step, to be read after it.

use super::ids::{BodyId, JointId, ShapeId};
use crate::codec::{data, store};
use crate::math::{DVec2, Vec2};

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
    pub position: DVec2,
    /// Unit, from A to B.
    pub normal: Vec2,
    /// Approach speed along the normal at the start of the step, metres a second.
    pub speed: f32,
}

/// A shape began to overlap a sensor, or went through it within the step.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SensorBegin {
    /// The sensor.
    pub sensor: ShapeId,
    /// What it sees.
    pub visitor: ShapeId,
}

/// A shape no longer overlaps a sensor, or one of them is gone (its handle may be stale).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SensorEnd {
    /// The sensor.
    pub sensor: ShapeId,
    /// What it saw.
    pub visitor: ShapeId,
}

/// A joint bore more than it can and is gone.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct JointBreak {
    /// Its handle, now stale.
    pub joint: JointId,
    /// Greatest force on body B in a substep of the step in which it broke, newtons.
    pub force: Vec2,
    /// Greatest torque on body B, newton metres.
    pub torque: f32,
    /// The user's number.
    pub user_data: u64,
}

store! {
    /// The events of one step, each list in a fixed order that threads do not change. Contacts have begin, end and
    /// hit events only where a shape asks for them (see [`ShapeDef`](crate::ShapeDef)).
    ///
    /// The lists stay as they are until the next step, whatever is changed or removed in between: what comes about
    /// by such changes (a contact ends because a body was removed, a body wakes because it was pushed) is part of
    /// the next step's events.
    ///
    /// ```
    /// use tiny_physics::{RigidBody, Shape, ShapeDef, Vec2, World};
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new(Vec2::new(0.0, -10.0));
    /// let gate = world.add_body(RigidBody::fixed().shape(ShapeDef::new(Shape::rect(2.0, 0.5)?).sensor()))?;
    /// let ball = world.add_body(RigidBody::dynamic().position(Vec2::new(0.0, 3.0)).shape(Shape::circle(0.2)?))?;
    /// let (mut entered, mut left) = (0, 0);
    /// for _ in 0..120 {
    ///     world.step(1.0 / 60.0);
    ///     entered += world.events().sensor_begin().len();
    ///     left += world.events().sensor_end().len();
    /// }
    /// assert_eq!((entered, left), (1, 1));
    /// # let _ = (gate, ball);
    /// # Ok(())
    /// # }
    /// ```
    #[derive(PartialEq, Debug, Default)]
    pub struct Events {
        pub(crate) contact_begin: Vec<ContactBegin>,
        pub(crate) contact_end: Vec<ContactEnd>,
        pub(crate) hits: Vec<Hit>,
        pub(crate) sensor_begin: Vec<SensorBegin>,
        pub(crate) sensor_end: Vec<SensorEnd>,
        pub(crate) joint_breaks: Vec<JointBreak>,
        pub(crate) woke: Vec<BodyId>,
        pub(crate) fell_asleep: Vec<BodyId>,
        /// What came about since the last step: part of the next step's events.
        pub(crate) pending_end: Vec<ContactEnd>,
        pub(crate) pending_woke: Vec<BodyId>,
        pub(crate) pending_asleep: Vec<BodyId>,
    }
}

data!(ContactBegin { shape_a, shape_b });
data!(ContactEnd { shape_a, shape_b });
data!(SensorBegin { sensor, visitor });
data!(SensorEnd { sensor, visitor });
data!(Hit { shape_a, shape_b, position, normal, speed });
data!(JointBreak { joint, force, torque, user_data });

impl Events {
    /// Contacts that began.
    pub fn contact_begin(&self) -> &[ContactBegin] {
        &self.contact_begin
    }

    /// Contacts that ended.
    pub fn contact_end(&self) -> &[ContactEnd] {
        &self.contact_end
    }

    /// Hits, by shape A, then B.
    pub fn hits(&self) -> &[Hit] {
        &self.hits
    }

    /// Overlaps with sensors that began, by sensor, then visitor.
    pub fn sensor_begin(&self) -> &[SensorBegin] {
        &self.sensor_begin
    }

    /// Overlaps with sensors that ended, by sensor, then visitor.
    pub fn sensor_end(&self) -> &[SensorEnd] {
        &self.sensor_end
    }

    /// Joints that broke.
    pub fn joint_breaks(&self) -> &[JointBreak] {
        &self.joint_breaks
    }

    /// Bodies that woke in the step or before it, in the order in which they did. Those that were added awake
    /// are not among them; those that have been removed since may be.
    pub fn woke(&self) -> &[BodyId] {
        &self.woke
    }

    /// Bodies that fell asleep in the step, island by island, or were put to sleep before it.
    pub fn fell_asleep(&self) -> &[BodyId] {
        &self.fell_asleep
    }

    /// Makes room for the events of a new step.
    pub(crate) fn clear(&mut self) {
        self.contact_begin.clear();
        self.contact_end.clear();
        self.hits.clear();
        self.sensor_begin.clear();
        self.sensor_end.clear();
        self.joint_breaks.clear();
        self.woke.clear();
        self.fell_asleep.clear();
        self.flush_pending();
    }

    /// Makes what came about by changes part of this step.
    pub(crate) fn flush_pending(&mut self) {
        self.contact_end.append(&mut self.pending_end);
        self.woke.append(&mut self.pending_woke);
        self.fell_asleep.append(&mut self.pending_asleep);
    }
}
