//! A shape on a body: geometry, place, material, filter.

use super::{Filter, Mix};
use crate::codec::{described, setters};
use crate::geometry::Shape;
use crate::math::Vec2;

described! {
    /// The surface and stuff of a shape.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct Material {
        /// Kilograms a square metre; 0 adds no mass.
        pub density: f32 = 1.0,
        /// Coulomb friction, 0 or above.
        pub friction: f32 = 0.6,
        /// Bounce: 0 none, 1 all of the approach speed comes back. 0 unless it is said; [`RigidBody::new`](crate::RigidBody::new)
        /// says 0.5.
        pub restitution: f32 = 0.0,
        /// Resistance of round shapes against rolling, as a fraction of their radius, 0 or above.
        pub rolling_resistance: f32 = 0.0,
        /// Speed of the surface along itself, metres a second: a conveyor belt. It runs clockwise round the shape,
        /// so what lies on top goes to the right.
        pub tangent_speed: f32 = 0.0,
        /// How its friction mixes with that of others, instead of [`Settings::friction_mix`](crate::Settings::friction_mix).
        /// Where both of a pair say so, the rule counts that comes later in [`Mix`].
        pub friction_mix: Option<Mix> = None,
        /// How its restitution mixes with that of others, likewise. A trampoline takes [`Mix::Max`]: everything bounces.
        pub restitution_mix: Option<Mix> = None,
    }
}

described! {
    /// What a segment of a chain knows of its neighbours, so that nothing catches on the joints.
    ///
    /// A segment with a link is solid from one side only: the right of the way from `a` to `b` is outside.
    ///
    /// A link is what was said when the segment was added. Where a segment is changed its own stays, and so do those of its neighbours: to move
    /// corners, take the chain away and add it anew.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct ChainLink {
        /// Start of the segment before this one, in the shape's frame. `None`: the chain begins at `a`.
        pub previous: Option<Vec2> = None,
        /// End of the segment after this one. `None`: the chain ends at `b`.
        pub next: Option<Vec2> = None,
    }
}

described! {
    /// One shape of a body, as described by the user.
    ///
    /// ```
    /// use tiny_physics::{Shape, ShapeDef, Vec2};
    /// let foot = ShapeDef::new(Shape::Circle { radius: 0.2 }).offset(Vec2::new(0.0, -0.5)).friction(0.9);
    /// assert_eq!(foot.material.friction, 0.9);
    /// ```
    #[derive(Clone, Debug, PartialEq)]
    pub struct ShapeDef {
        /// The geometry, in its own frame.
        pub shape: Shape,
        /// Origin of the shape's frame in the body's frame, metres.
        pub offset: Vec2 = default,
        /// Angle of the shape's frame in the body's frame, radians.
        pub angle: f32 = default,
        /// Surface and stuff.
        pub material: Material = default,
        /// What it collides with.
        pub filter: Filter = default,
        /// A sensor sees what overlaps it and collides with nothing. It has mass by its density as any shape.
        pub sensor: bool = default,
        /// Does this sensor see other sensors too?
        pub sees_sensors: bool = default,
        /// For a one-way platform: the direction, in the body's frame, out of its solid side. Others pass
        /// through from behind. `None` is solid from everywhere.
        pub one_way: Option<Vec2> = default,
        /// For a segment that is part of a chain: its neighbours. [`ChainDef`](super::ChainDef) sets it.
        #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
        pub link: Option<ChainLink> = default,
        /// Are contact begin and end events sent for this shape?
        pub contact_events: bool = default,
        /// Are hit events (fast approach) sent for this shape?
        pub hit_events: bool = default,
        /// Free for the user.
        pub user_data: u64 = default,
    }
    with fn of_shape(shape: Shape);
}

impl ShapeDef {
    /// A shape at the body's origin with default material.
    pub fn new(shape: impl Into<Shape>) -> Self {
        Self::of_shape(shape.into())
    }
}

setters! {
    ShapeDef {
        /// Sets [`ShapeDef::offset`].
        offset(offset: impl Into<Vec2>): offset = offset.into();
        /// Sets [`ShapeDef::angle`].
        angle(radians: f32): angle = radians;
        /// Sets [`Material::density`].
        density(density: f32): material.density = density;
        /// Sets [`Material::friction`].
        friction(friction: f32): material.friction = friction;
        /// Sets [`Material::restitution`].
        restitution(restitution: f32): material.restitution = restitution;
        /// Sets [`Material::rolling_resistance`].
        rolling_resistance(resistance: f32): material.rolling_resistance = resistance;
        /// Sets [`Material::tangent_speed`].
        tangent_speed(speed: f32): material.tangent_speed = speed;
        /// Sets [`Material::friction_mix`] and [`Material::restitution_mix`].
        mix(friction: Option<Mix>, restitution: Option<Mix>):
            material.friction_mix = friction, material.restitution_mix = restitution;
        /// Sets [`ShapeDef::filter`].
        filter(filter: Filter): filter = filter;
        /// Makes it a sensor.
        sensor(): sensor = true;
        /// Makes it a sensor that sees other sensors too: a blade that meets a zone where one is hurt.
        sensor_of_sensors(): sensor = true, sees_sensors = true;
        /// Sets [`ShapeDef::one_way`].
        one_way(direction: impl Into<Vec2>): one_way = Some(direction.into());
        /// Switches contact and hit events on.
        events(): contact_events = true, hit_events = true;
        /// Sets [`ShapeDef::user_data`].
        user_data(data: u64): user_data = data;
    }
}

impl<S: Into<Shape>> From<S> for ShapeDef {
    fn from(shape: S) -> Self {
        Self::new(shape)
    }
}
