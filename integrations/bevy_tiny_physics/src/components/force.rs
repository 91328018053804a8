//! What pushes bodies.

use bevy_ecs::prelude::*;
use bevy_math::Vec2;

/// A steady push, applied in every step until it is changed.
#[derive(Component, Clone, Copy, PartialEq, Debug, Default)]
pub struct ExternalForce {
    /// At the centre of mass, newtons.
    pub force: Vec2,
    /// Newton metres.
    pub torque: f32,
}

/// A push that is applied in the next step at once, and is then 0 again.
#[derive(Component, Clone, Copy, PartialEq, Debug, Default)]
pub struct ExternalImpulse {
    /// At the centre of mass, newton seconds.
    pub impulse: Vec2,
    /// Newton metre seconds.
    pub angular: f32,
}

/// Where a kinematic body has to be at the end of the next step: it gets the velocity that takes it there, and takes along what
/// stands on it. Give it a new place before each step. One that is not finite becomes the place where the body is.
#[derive(Component, Clone, Copy, PartialEq, Debug, Default)]
pub struct KinematicTarget {
    /// World, metres.
    pub position: Vec2,
    /// Radians.
    pub angle: f32,
}
