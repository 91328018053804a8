//! What a scene is played on: any engine that can do this little.

use crate::script::Deed;
use tiny_physics::{CharacterMover, DVec2, JointDef, MoverInput, RigidBody, Vec2};

/// An engine's world, seen by a scene and its script.
///
/// Bodies and joints go by a number of the host's choice, which stays the same until the body or joint
/// is removed. A removed body takes its joints with it. Queries have default answers ("nothing there"), deeds
/// are left undone, and characters stay where they are: a host that lacks them plays every scene all the same.
pub trait Host {
    /// Adds a body; its number.
    fn add_body(&mut self, body: &RigidBody) -> usize;
    /// Removes a body, its shapes and its joints.
    fn remove_body(&mut self, body: usize);
    /// Adds a joint between two bodies; its number.
    fn add_joint(&mut self, a: usize, b: usize, def: &JointDef) -> usize;
    /// Removes a joint.
    fn remove_joint(&mut self, joint: usize);
    /// Position of a body's frame, metres in the world.
    fn position(&self, body: usize) -> DVec2;
    /// Velocity of a body's centre of mass, metres a second.
    fn velocity(&self, body: usize) -> Vec2;
    /// Sets that velocity and wakes the body.
    fn set_velocity(&mut self, body: usize, velocity: Vec2);
    /// Sets its angular velocity, radians a second.
    fn set_angular_velocity(&mut self, _body: usize, _radians_per_second: f32) {}
    /// Pushes its centre of mass during the next step, newtons, and wakes it.
    fn apply_force(&mut self, _body: usize, _newtons: Vec2) {}
    /// Is the body awake?
    fn is_awake(&self, body: usize) -> bool;
    /// Wakes a body and its island.
    fn wake(&mut self, body: usize);
    /// Steps the world by `dt` seconds.
    fn step(&mut self, dt: f32);

    /// Moves a character on by `dt` seconds, after a step.
    fn move_character(&mut self, _mover: &mut CharacterMover, _input: MoverInput, _dt: f32) {}

    /// Fraction of `translation`, 0 to 1, at which a ray first meets a shape with a category in `mask`.
    fn ray_cast(&mut self, _origin: Vec2, _translation: Vec2, _mask: u64) -> Option<f32> {
        None
    }

    /// The same for a moving circle.
    fn circle_cast(
        &mut self,
        _center: Vec2,
        _radius: f32,
        _translation: Vec2,
        _mask: u64,
    ) -> Option<f32> {
        None
    }

    /// How many shapes with a category in `mask` have a box that overlaps this one.
    fn count_overlaps(&mut self, _lower: Vec2, _upper: Vec2, _mask: u64) -> usize {
        0
    }

    /// Does what a timeline asks for before the next step, which begins at `time` and is `dt` long, seconds. As it is
    /// given here, it sets velocities and leaves every other deed undone.
    fn act(&mut self, deed: &Deed, _time: f32, _dt: f32) {
        if let Deed::SetVelocity { body, velocity, angular_velocity } = *deed {
            self.set_velocity(body, velocity);
            self.set_angular_velocity(body, angular_velocity);
        }
    }

    /// Does a sensor of this body see anything?
    fn is_entered(&mut self, _body: usize) -> bool {
        false
    }
}
