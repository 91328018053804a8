//! A shape on a body: geometry, place, material, filter.

use super::{Filter, Mix};
use crate::geometry::Shape;
use crate::math::Vec2;

/// The surface and stuff of a shape.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Material {
    /// Kilograms a square metre; 0 adds no mass.
    pub density: f32,
    /// Coulomb friction, 0 or above.
    pub friction: f32,
    /// Bounce: 0 none, 1 all of the approach speed comes back. 0 unless it is said; [`RigidBody::new`](crate::RigidBody::new)
    /// says 0.5.
    pub restitution: f32,
    /// Resistance of round shapes against rolling, as a fraction of their radius, 0 or above.
    pub rolling_resistance: f32,
    /// Speed of the surface along itself, metres a second: a conveyor belt. It runs clockwise round the shape,
    /// so what lies on top goes to the right.
    pub tangent_speed: f32,
    /// How its friction mixes with that of others, instead of [`Settings::friction_mix`](crate::Settings::friction_mix).
    /// Where both of a pair say so, the rule counts that comes later in [`Mix`].
    pub friction_mix: Option<Mix>,
    /// How its restitution mixes with that of others, likewise. A trampoline takes [`Mix::Max`]: everything bounces.
    pub restitution_mix: Option<Mix>,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            density: 1.0,
            friction: 0.6,
            restitution: 0.0,
            rolling_resistance: 0.0,
            tangent_speed: 0.0,
            friction_mix: None,
            restitution_mix: None,
        }
    }
}

/// What a segment of a chain knows of its neighbours, so that nothing catches on the joints.
///
/// A segment with a link is solid from one side only: the right of the way from `a` to `b` is outside.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct ChainLink {
    /// Start of the segment before this one, in the shape's frame. `None`: the chain begins at `a`.
    pub previous: Option<Vec2>,
    /// End of the segment after this one. `None`: the chain ends at `b`.
    pub next: Option<Vec2>,
}

/// One shape of a body, as described by the user.
///
/// ```
/// use tiny_physics::{Shape, ShapeDef, Vec2};
/// let foot = ShapeDef::new(Shape::Circle { radius: 0.2 }).offset(Vec2::new(0.0, -0.5)).friction(0.9);
/// assert_eq!(foot.material.friction, 0.9);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ShapeDef {
    /// The geometry, in its own frame.
    pub shape: Shape,
    /// Origin of the shape's frame in the body's frame, metres.
    #[cfg_attr(feature = "serde", serde(default))]
    pub offset: Vec2,
    /// Angle of the shape's frame in the body's frame, radians.
    #[cfg_attr(feature = "serde", serde(default))]
    pub angle: f32,
    /// Surface and stuff.
    #[cfg_attr(feature = "serde", serde(default))]
    pub material: Material,
    /// What it collides with.
    #[cfg_attr(feature = "serde", serde(default))]
    pub filter: Filter,
    /// A sensor sees what overlaps it and collides with nothing.
    #[cfg_attr(feature = "serde", serde(default))]
    pub sensor: bool,
    /// Does this sensor see other sensors too?
    #[cfg_attr(feature = "serde", serde(default))]
    pub sees_sensors: bool,
    /// For a one-way platform: the direction, in the body's frame, out of its solid side. Others pass
    /// through from behind. `None` is solid from everywhere.
    #[cfg_attr(feature = "serde", serde(default))]
    pub one_way: Option<Vec2>,
    /// For a segment that is part of a chain: its neighbours. [`ChainDef`](super::ChainDef) sets it.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub link: Option<ChainLink>,
    /// Are contact begin and end events sent for this shape?
    #[cfg_attr(feature = "serde", serde(default))]
    pub contact_events: bool,
    /// Are hit events (fast approach) sent for this shape?
    #[cfg_attr(feature = "serde", serde(default))]
    pub hit_events: bool,
    /// Free for the user.
    #[cfg_attr(feature = "serde", serde(default))]
    pub user_data: u64,
}

impl ShapeDef {
    /// A shape at the body's origin with default material.
    pub fn new(shape: impl Into<Shape>) -> Self {
        Self {
            shape: shape.into(),
            offset: Vec2::ZERO,
            angle: 0.0,
            material: Material::default(),
            filter: Filter::default(),
            sensor: false,
            sees_sensors: false,
            one_way: None,
            link: None,
            contact_events: false,
            hit_events: false,
            user_data: 0,
        }
    }

    /// Sets [`ShapeDef::offset`].
    pub fn offset(mut self, offset: impl Into<Vec2>) -> Self {
        self.offset = offset.into();
        self
    }

    /// Sets [`ShapeDef::angle`].
    pub fn angle(mut self, radians: f32) -> Self {
        self.angle = radians;
        self
    }

    /// Sets [`Material::density`].
    pub fn density(mut self, density: f32) -> Self {
        self.material.density = density;
        self
    }

    /// Sets [`Material::friction`].
    pub fn friction(mut self, friction: f32) -> Self {
        self.material.friction = friction;
        self
    }

    /// Sets [`Material::restitution`].
    pub fn restitution(mut self, restitution: f32) -> Self {
        self.material.restitution = restitution;
        self
    }

    /// Sets [`Material::rolling_resistance`].
    pub fn rolling_resistance(mut self, resistance: f32) -> Self {
        self.material.rolling_resistance = resistance;
        self
    }

    /// Sets [`Material::tangent_speed`].
    pub fn tangent_speed(mut self, speed: f32) -> Self {
        self.material.tangent_speed = speed;
        self
    }

    /// Sets [`Material::friction_mix`] and [`Material::restitution_mix`].
    pub fn mix(mut self, friction: Option<Mix>, restitution: Option<Mix>) -> Self {
        (self.material.friction_mix, self.material.restitution_mix) = (friction, restitution);
        self
    }

    /// Sets [`ShapeDef::filter`].
    pub fn filter(mut self, filter: Filter) -> Self {
        self.filter = filter;
        self
    }

    /// Makes it a sensor.
    pub fn sensor(mut self) -> Self {
        self.sensor = true;
        self
    }

    /// Makes it a sensor that sees other sensors too: a blade that meets a zone where one is hurt.
    pub fn sensor_of_sensors(mut self) -> Self {
        (self.sensor, self.sees_sensors) = (true, true);
        self
    }

    /// Sets [`ShapeDef::one_way`].
    pub fn one_way(mut self, direction: impl Into<Vec2>) -> Self {
        self.one_way = Some(direction.into());
        self
    }

    /// Switches contact and hit events on.
    pub fn events(mut self) -> Self {
        self.contact_events = true;
        self.hit_events = true;
        self
    }

    /// Sets [`ShapeDef::user_data`].
    pub fn user_data(mut self, data: u64) -> Self {
        self.user_data = data;
        self
    }
}

impl<S: Into<Shape>> From<S> for ShapeDef {
    fn from(shape: S) -> Self {
        Self::new(shape)
    }
}
