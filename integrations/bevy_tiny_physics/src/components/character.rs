//! Characters: who walks.

use bevy_ecs::prelude::*;
use bevy_math::Vec2;
use bevy_transform::prelude::Transform;
use tiny_physics::{CharacterMover, Filter};

/// Somebody who walks: climbs slopes and steps, rides on lifts, pushes crates. It moves after each step, as its [`CharacterInput`] says, and
/// carries a sensor of its form, so that pickups and doors may be plain [`Sensor`](crate::Sensor)s.
#[derive(Component, Clone, Copy, PartialEq, Debug)]
#[require(Transform, CharacterInput, CharacterState)]
pub struct Character {
    /// Height of its whole capsule, metres.
    pub height: f32,
    /// Radius of its capsule, metres.
    pub radius: f32,
    /// Steepest slope that it walks on, radians from level.
    pub max_slope: f32,
    /// Highest step that it climbs, metres.
    pub step_height: f32,
    /// Greatest drop over which it stays on the ground, metres.
    pub snap_distance: f32,
    /// Greatest force with which it pushes, newtons.
    pub push_force: f32,
    /// Mass with which it weighs on what it stands on, kilograms.
    pub mass: f32,
    /// Factor on the world's gravity.
    pub gravity_scale: f32,
    /// What it collides with.
    pub filter: Filter,
}

impl Character {
    /// One of a height and radius in metres.
    pub fn new(height: f32, radius: f32) -> Self {
        let mover = CharacterMover::new((0.0, 0.0), height, radius);
        Self {
            height,
            radius,
            max_slope: mover.max_slope,
            step_height: mover.step_height,
            snap_distance: mover.snap_distance,
            push_force: mover.push_force,
            mass: mover.mass,
            gravity_scale: mover.gravity_scale,
            filter: mover.filter,
        }
    }

    /// Makes a mover do what this says; its form is left as it is.
    pub(crate) fn apply(&self, mover: &mut CharacterMover) {
        mover.max_slope = self.max_slope;
        mover.step_height = self.step_height;
        mover.snap_distance = self.snap_distance;
        mover.push_force = self.push_force;
        mover.mass = self.mass;
        mover.gravity_scale = self.gravity_scale;
        mover.filter = self.filter;
    }
}

/// What a character is asked to do. `walk` holds until it is changed; `jump` and `drop` are used up by the next step.
#[derive(Component, Clone, Copy, PartialEq, Debug, Default)]
pub struct CharacterInput {
    /// Speed to the right, metres a second.
    pub walk: f32,
    /// Speed of a jump off the ground, metres a second; 0 is none.
    pub jump: f32,
    /// Falls through the one-way platforms that it stands on.
    pub drop: bool,
}

/// What became of a character in the last step.
#[derive(Component, Clone, Copy, PartialEq, Debug, Default)]
pub struct CharacterState {
    /// Does it stand on something?
    pub grounded: bool,
    /// The entity that it stands on; `None` in the air, and on what no entity made.
    pub ground: Option<Entity>,
    /// Normal of the ground; zero in the air.
    pub normal: Vec2,
    /// Metres a second.
    pub velocity: Vec2,
}
