//! A body as described by the user.

use super::{ChainDef, ShapeDef};
use crate::codec::{described, described_enum, setters};
use crate::error::Error;
use crate::geometry::Shape;
use crate::math::{DVec2, Vec2};

described_enum! {
    /// What moves a body.
    #[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Hash)]
    pub enum BodyKind {
        /// Nothing: ground and walls.
        Static = 0,
        /// Its velocity, which only the user changes: lifts, moving platforms.
        Kinematic = 1,
        /// Forces, contacts and joints.
        #[default]
        Dynamic = 2,
    }
}

described! {
    /// Directions in which a dynamic body cannot move.
    #[derive(Clone, Copy, PartialEq, Eq, Debug)]
    pub struct Locks {
        /// No motion along the world's x axis.
        pub x: bool = false,
        /// No motion along the world's y axis.
        pub y: bool = false,
        /// No turning.
        pub rotation: bool = false,
    }
}

described! {
    /// A body to be added to a world.
    ///
    /// ```
    /// use tiny_physics::{RigidBody, Shape, Vec2};
    /// let crate_ = RigidBody::new(Shape::Aabb { half_extents: Vec2::new(0.5, 0.5) }, Vec2::new(0.0, 4.0), 1.0);
    /// let wheel = RigidBody::dynamic()
    ///     .position(Vec2::new(2.0, 4.0))
    ///     .velocity(Vec2::new(-1.0, 0.0))
    ///     .shape(Shape::Circle { radius: 0.3 });
    /// assert_eq!(crate_.shapes.len() + wheel.shapes.len(), 2);
    /// ```
    #[derive(Clone, Debug, PartialEq)]
    pub struct RigidBody {
        /// What moves it.
        pub kind: BodyKind = BodyKind::Dynamic,
        /// Origin of the body's frame, metres in the world.
        pub position: DVec2 = DVec2::ZERO,
        /// Angle of the body's frame, radians.
        pub angle: f32 = 0.0,
        /// Velocity of the centre of mass, metres a second.
        pub velocity: Vec2 = Vec2::ZERO,
        /// Radians a second, anticlockwise.
        pub angular_velocity: f32 = 0.0,
        /// Slowing of motion, 1/s: speed falls by the factor 1/(1 + dt * damping).
        pub linear_damping: f32 = 0.0,
        /// Slowing of turning, 1/s.
        pub angular_damping: f32 = 0.0,
        /// Factor on the world's gravity.
        pub gravity_scale: f32 = 1.0,
        /// Directions in which it cannot move.
        pub locks: Locks = Locks::default(),
        /// Its shapes.
        pub shapes: Vec<ShapeDef> = Vec::new(),
        /// Total mass, kilograms. `None` takes it from the densities of the shapes, or 1 where these give none; `Some` scales
        /// that mass and its moment of inertia to the value.
        pub mass: Option<f32> = None,
        /// Centre of mass in the body's frame, metres. `None` takes it from the shapes.
        pub center: Option<Vec2> = None,
        /// Moment of inertia about the centre of mass, kilogram square metres. `None` takes it from the shapes and the mass.
        pub inertia: Option<f32> = None,
        /// May its island fall asleep?
        pub can_sleep: bool = true,
        /// Does it start awake? A kinematic body with a velocity always does.
        pub awake: bool = true,
        /// Speed below which it counts as at rest, metres a second; multiplied by
        /// [`Settings::length_unit`](crate::Settings::length_unit).
        pub sleep_speed: f32 = 0.05,
        /// Kept and given back, but it changes nothing: whatever is fast is looked out for, moving or not.
        pub bullet: bool = false,
        /// A body that is not enabled is kept but takes no part.
        pub enabled: bool = true,
        /// Free for the user.
        pub user_data: u64 = 0,
    }
}

impl RigidBody {
    /// A body with one shape and a mass in kilograms; mass 0 makes it static: pushed by nothing, it
    /// pushes everything. Its restitution is 0.5.
    pub fn new(shape: impl Into<Shape>, position: impl Into<DVec2>, mass: f32) -> Self {
        let kind = if mass == 0.0 { BodyKind::Static } else { BodyKind::Dynamic };
        Self {
            kind,
            position: position.into(),
            shapes: vec![ShapeDef::new(shape).restitution(0.5)],
            mass: (mass != 0.0).then_some(mass),
            ..Self::default()
        }
    }

    /// A dynamic body without shapes at the origin.
    pub fn dynamic() -> Self {
        Self::default()
    }

    /// A static body without shapes at the origin.
    pub fn fixed() -> Self {
        Self { kind: BodyKind::Static, ..Self::default() }
    }

    /// A kinematic body without shapes at the origin.
    pub fn kinematic() -> Self {
        Self { kind: BodyKind::Kinematic, ..Self::default() }
    }

    /// Adds a shape.
    pub fn shape(mut self, shape: impl Into<ShapeDef>) -> Self {
        self.shapes.push(shape.into());
        self
    }

    /// Adds the segments of a chain.
    ///
    /// # Errors
    /// Those of [`ChainDef::shapes`].
    pub fn chain(mut self, chain: &ChainDef) -> Result<Self, Error> {
        self.shapes.extend(chain.shapes()?);
        Ok(self)
    }

    /// Sets the friction of all shapes so far.
    pub fn friction(mut self, friction: f32) -> Self {
        self.shapes.iter_mut().for_each(|s| s.material.friction = friction);
        self
    }

    /// Sets the restitution of all shapes so far.
    pub fn restitution(mut self, restitution: f32) -> Self {
        self.shapes.iter_mut().for_each(|s| s.material.restitution = restitution);
        self
    }
}

setters! {
    RigidBody {
        /// Sets [`RigidBody::position`]; takes [`Vec2`] or [`DVec2`].
        position(position: impl Into<DVec2>): position = position.into();
        /// Sets [`RigidBody::angle`].
        angle(radians: f32): angle = radians;
        /// Sets [`RigidBody::velocity`].
        velocity(velocity: impl Into<Vec2>): velocity = velocity.into();
        /// Sets [`RigidBody::angular_velocity`].
        angular_velocity(radians_per_second: f32): angular_velocity = radians_per_second;
        /// Sets [`RigidBody::mass`].
        mass(kilograms: f32): mass = Some(kilograms);
        /// Sets [`RigidBody::center`]: a boat or a doll that rights itself has it low.
        center(center: impl Into<Vec2>): center = Some(center.into());
        /// Sets [`RigidBody::inertia`]: what has much is slow to turn.
        inertia(inertia: f32): inertia = Some(inertia);
        /// Sets [`RigidBody::linear_damping`] and [`RigidBody::angular_damping`].
        damping(linear: f32, angular: f32): linear_damping = linear, angular_damping = angular;
        /// Sets [`RigidBody::gravity_scale`].
        gravity_scale(scale: f32): gravity_scale = scale;
        /// Sets [`RigidBody::locks`].
        locks(locks: Locks): locks = locks;
        /// Keeps it from turning.
        lock_rotation(): locks.rotation = true;
        /// Sets a flag that changes nothing: see [`RigidBody::bullet`].
        bullet(): bullet = true;
        /// Starts it asleep.
        asleep(): awake = false;
        /// Sets [`RigidBody::can_sleep`].
        can_sleep(can_sleep: bool): can_sleep = can_sleep;
        /// Sets [`RigidBody::user_data`].
        user_data(data: u64): user_data = data;
    }
}
