//! What happened in the last step, to be read after it.

use super::ids::{BodyId, JointId, ShapeId};
use crate::codec::{data, store};
use crate::math::{DVec2, Vec2};

/// The user's numbers of a shape and of its body.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct UserData {
    /// That of the shape.
    pub shape: u64,
    /// That of the body.
    pub body: u64,
}

/// Declares an event of two shapes: what both are, then what else it tells. It says all that as it was when the event
/// came about, whatever has been removed since.
macro_rules! event {
    ($(#[$meta:meta])* $name:ident
        $(#[$first:meta])* $shape_a:ident $body_a:ident $data_a:ident,
        $(#[$second:meta])* $shape_b:ident $body_b:ident $data_b:ident,
        $($(#[$field_meta:meta])* $field:ident: $type:ty,)*
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, PartialEq, Debug)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $name {
            $(#[$first])*
            pub $shape_a: ShapeId,
            $(#[$second])*
            pub $shape_b: ShapeId,
            /// Body of the first.
            pub $body_a: BodyId,
            /// Body of the second.
            pub $body_b: BodyId,
            /// The user's numbers of the first.
            pub $data_a: UserData,
            /// The user's numbers of the second.
            pub $data_b: UserData,
            $($(#[$field_meta])* pub $field: $type,)*
        }

        data!($name { $shape_a, $shape_b, $body_a, $body_b, $data_a, $data_b, $($field),* });
    };
}

event! {
    /// Two shapes began to touch: they are closer than 2 cm times the length unit, or will be within the step and pushed each other.
    ContactBegin
    /// First shape of the contact.
    shape_a body_a user_data_a,
    /// Second shape.
    shape_b body_b user_data_b,
}

event! {
    /// Two shapes no longer touch, or one of them is gone (its handle may be stale).
    ContactEnd
    /// First shape of the contact.
    shape_a body_a user_data_a,
    /// Second shape.
    shape_b body_b user_data_b,
}

event! {
    /// Two shapes hit each other faster than [`Settings::hit_event_threshold`](crate::Settings).
    Hit
    /// First shape of the contact.
    shape_a body_a user_data_a,
    /// Second shape.
    shape_b body_b user_data_b,
    /// Where, world, metres.
    position: DVec2,
    /// Unit, from A to B.
    normal: Vec2,
    /// Approach speed along the normal at the start of the step, metres a second.
    speed: f32,
    /// Newton seconds that the step pushed B along the normal, and A against it: a pea that hits a wall has little, a
    /// boulder much. Loudness and damage go by it.
    impulse: f32,
    /// Mass of body A, kilograms; 0 for bodies that are not dynamic.
    mass_a: f32,
    /// Mass of body B.
    mass_b: f32,
}

event! {
    /// A shape began to overlap a sensor, or went through it within the step.
    SensorBegin
    /// The sensor.
    sensor sensor_body sensor_data,
    /// What it sees.
    visitor visitor_body visitor_data,
}

event! {
    /// A shape no longer overlaps a sensor, or one of them is gone (its handle may be stale).
    SensorEnd
    /// The sensor.
    sensor sensor_body sensor_data,
    /// What it saw.
    visitor visitor_body visitor_data,
}

impl From<ContactEnd> for ContactBegin {
    fn from(end: ContactEnd) -> Self {
        let ContactEnd { shape_a, shape_b, body_a, body_b, user_data_a, user_data_b } = end;
        Self { shape_a, shape_b, body_a, body_b, user_data_a, user_data_b }
    }
}

impl From<SensorEnd> for SensorBegin {
    fn from(end: SensorEnd) -> Self {
        let SensorEnd { sensor, visitor, sensor_body, visitor_body, sensor_data, visitor_data } =
            end;
        Self { sensor, visitor, sensor_body, visitor_body, sensor_data, visitor_data }
    }
}

/// A joint bore more than it can and is gone.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JointBreak {
    /// Its handle, now stale.
    pub joint: JointId,
    /// Its body A.
    pub body_a: BodyId,
    /// Its body B.
    pub body_b: BodyId,
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
        pub(crate) pending_sensor_end: Vec<SensorEnd>,
        pub(crate) pending_woke: Vec<BodyId>,
        pub(crate) pending_asleep: Vec<BodyId>,
    }
}

data!(UserData { shape, body });
data!(JointBreak { joint, body_a, body_b, force, torque, user_data });

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
        let Self { pending_end, pending_sensor_end, pending_woke, pending_asleep, .. } = self;
        let ends = pending_end.len() + pending_sensor_end.len();
        if ends + pending_woke.len() + pending_asleep.len() == 0 {
            return;
        }
        self.contact_end.append(&mut self.pending_end);
        self.sensor_end.append(&mut self.pending_sensor_end);
        self.woke.append(&mut self.pending_woke);
        self.fell_asleep.append(&mut self.pending_asleep);
    }
}
