//! Bodies, and what one may say of them. Where an optional component is missing, its default holds.

use bevy_ecs::prelude::*;
use bevy_math::Vec2;
use bevy_transform::prelude::Transform;

/// Makes an entity a body. Its place is the entity's [`Transform`], its shapes are the [`Collider`](crate::Collider)s on it and below
/// it. Setting the transform teleports the body.
#[derive(Component, Clone, Copy, PartialEq, Eq, Debug, Default)]
#[require(Transform)]
pub enum RigidBody {
    /// Moved by forces, joints and contacts.
    #[default]
    Dynamic,
    /// Never moves.
    Static,
    /// Moves as its [`Velocity`] or [`KinematicTarget`](crate::KinematicTarget) says, whatever is in its way.
    Kinematic,
}

/// Velocity of a body, written back after each step. Without it a body still moves; it is only not told.
#[derive(Component, Clone, Copy, PartialEq, Debug, Default)]
pub struct Velocity {
    /// Of the centre of mass, metres a second.
    pub linear: Vec2,
    /// Radians a second, anticlockwise.
    pub angular: f32,
}

impl Velocity {
    /// A velocity without turning, metres a second.
    pub fn linear(x: f32, y: f32) -> Self {
        Self { linear: Vec2::new(x, y), angular: 0.0 }
    }
}

/// Slowing of a body: its speed falls by the factor 1/(1 + dt * damping) a step.
#[derive(Component, Clone, Copy, PartialEq, Debug, Default)]
pub struct Damping {
    /// Of motion, 1/s.
    pub linear: f32,
    /// Of turning, 1/s.
    pub angular: f32,
}

/// Factor on the world's gravity; 1 without it.
#[derive(Component, Clone, Copy, PartialEq, Debug)]
pub struct GravityScale(pub f32);

/// Directions in which a body cannot move.
#[derive(Component, Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct LockedAxes {
    /// No motion along x.
    pub x: bool,
    /// No motion along y.
    pub y: bool,
    /// No turning.
    pub rotation: bool,
}

impl LockedAxes {
    /// Moves, but does not turn.
    pub const ROTATION: Self = Self { x: false, y: false, rotation: true };
}

/// Mass of the whole body, kilograms. Without it the densities of the shapes decide.
#[derive(Component, Clone, Copy, PartialEq, Debug)]
pub struct Mass(pub f32);

/// Does a body take part? One that does not keeps its place, is not seen and touches nothing.
///
/// Bevy's [`Disabled`](bevy_ecs::entity_disabling::Disabled) on the entity does the same. On a collider below a body it takes its shapes off
/// that; colliders that stand alone, joints, characters and tile maps take no part while it is on theirs.
#[derive(Component, Clone, Copy, PartialEq, Eq, Debug)]
pub struct Enabled(pub bool);

/// May a body fall asleep? It may without this.
#[derive(Component, Clone, Copy, PartialEq, Eq, Debug)]
pub struct CanSleep(pub bool);

/// What bodies that are added in the same step are ordered by first, ascending; 0 without it. Only needed where the order must not
/// follow from their places.
#[derive(Component, Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct BodyOrder(pub u64);
