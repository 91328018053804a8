//! A body as described by the user.

use super::{ChainDef, ShapeDef};
use crate::codec::{described, described_enum};
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
        /// Total mass, kilograms. `None` takes it from the densities of the shapes; `Some` scales that mass
        /// and its moment of inertia to the value.
        pub mass: Option<f32> = None,
        /// Centre of mass in the body's frame, metres. `None` takes it from the shapes.
        pub center: Option<Vec2> = None,
        /// Moment of inertia about the centre of mass, kilogram square metres. `None` takes it from the shapes and the mass.
        pub inertia: Option<f32> = None,
        /// May its island fall asleep?
        pub can_sleep: bool = true,
        /// Does it start awake?
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

    /// Sets [`RigidBody::position`]; takes [`Vec2`] or [`DVec2`].
    pub fn position(mut self, position: impl Into<DVec2>) -> Self {
        self.position = position.into();
        self
    }

    /// Sets [`RigidBody::angle`].
    pub fn angle(mut self, radians: f32) -> Self {
        self.angle = radians;
        self
    }

    /// Sets [`RigidBody::velocity`].
    pub fn velocity(mut self, velocity: impl Into<Vec2>) -> Self {
        let velocity = velocity.into();
        self.velocity = velocity;
        self
    }

    /// Sets [`RigidBody::angular_velocity`].
    pub fn angular_velocity(mut self, radians_per_second: f32) -> Self {
        self.angular_velocity = radians_per_second;
        self
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

    /// Sets [`RigidBody::mass`].
    pub fn mass(mut self, kilograms: f32) -> Self {
        self.mass = Some(kilograms);
        self
    }

    /// Sets [`RigidBody::center`]: a boat or a doll that rights itself has it low.
    pub fn center(mut self, center: impl Into<Vec2>) -> Self {
        self.center = Some(center.into());
        self
    }

    /// Sets [`RigidBody::inertia`]: what has much is slow to turn.
    pub fn inertia(mut self, inertia: f32) -> Self {
        self.inertia = Some(inertia);
        self
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

    /// Sets [`RigidBody::linear_damping`] and [`RigidBody::angular_damping`].
    pub fn damping(mut self, linear: f32, angular: f32) -> Self {
        self.linear_damping = linear;
        self.angular_damping = angular;
        self
    }

    /// Sets [`RigidBody::gravity_scale`].
    pub fn gravity_scale(mut self, scale: f32) -> Self {
        self.gravity_scale = scale;
        self
    }

    /// Sets [`RigidBody::locks`].
    pub fn locks(mut self, locks: Locks) -> Self {
        self.locks = locks;
        self
    }

    /// Keeps it from turning.
    pub fn lock_rotation(mut self) -> Self {
        self.locks.rotation = true;
        self
    }

    /// Makes it a bullet: see [`RigidBody::bullet`].
    pub fn bullet(mut self) -> Self {
        self.bullet = true;
        self
    }

    /// Starts it asleep.
    pub fn asleep(mut self) -> Self {
        self.awake = false;
        self
    }

    /// Sets [`RigidBody::can_sleep`].
    pub fn can_sleep(mut self, can_sleep: bool) -> Self {
        self.can_sleep = can_sleep;
        self
    }

    /// Sets [`RigidBody::user_data`].
    pub fn user_data(mut self, data: u64) -> Self {
        self.user_data = data;
        self
    }
}
