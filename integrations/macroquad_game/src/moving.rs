//! Lifts, which are kinematic, and doors, which a motor moves.

use crate::pieces::{DT, MOVING};
use serde::{Deserialize, Serialize};
use tiny_physics::prelude::*;

/// Half width and half height of a lift, metres.
pub const LIFT: (f32, f32) = (0.95, 0.1);
/// Half width and half height of a door, metres.
pub const DOOR: (f32, f32) = (0.3, 1.45);

/// Goes up and down by itself, and lets through who comes from below.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Lift {
    /// Its body.
    pub body: BodyId,
    /// Its lowest place.
    home: DVec2,
}

/// How far a lift goes, metres, and how long it takes for the way and waits at its ends, seconds.
const RISE: f32 = 6.0;
const WAY: f32 = 2.5;
const WAIT: f32 = 1.5;

impl Lift {
    /// One in the top of two cells, of which the right one has this middle.
    ///
    /// # Errors
    /// The place is none.
    pub fn add(world: &mut World, place: DVec2) -> Result<Self, Error> {
        let home = place + DVec2::new(-0.5, 0.4);
        let plate = ShapeDef::new(Shape::rect(LIFT.0, LIFT.1)?).one_way((0.0, 1.0));
        let body = world.add_body(RigidBody::kinematic().position(home).shape(plate))?;
        Ok(Self { body, home })
    }

    /// Sends it to where it is to be at the end of a step.
    pub fn run(&self, world: &mut World, step: u32) {
        let period = 2.0 * (WAY + WAIT);
        let time = (step as f32 * DT) % period;
        let up = ((time - WAIT) / WAY).min((period - time) / WAY).clamp(0.0, 1.0);
        let at = self.home + DVec2::new(0.0, f64::from(RISE * up));
        if let Some(mut body) = world.body_mut(self.body) {
            body.set_target(Transform::from_angle(at.to_vec2(), 0.0), DT);
        }
    }
}

/// A slab that a motor lifts.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Door {
    /// The slab.
    pub body: BodyId,
    joint: JointId,
}

/// Speed and force of the motor, metres a second and newtons.
const MOTOR: (f32, f32) = (1.5, 4000.0);

impl Door {
    /// One whose lowest cell has this middle, three cells high.
    ///
    /// # Errors
    /// The place is none.
    pub fn add(world: &mut World, place: DVec2) -> Result<Self, Error> {
        let middle = place + DVec2::new(0.0, 1.0);
        // It slides into the wall above.
        let slab = ShapeDef::new(Shape::rect(DOOR.0, DOOR.1)?)
            .density(40.0)
            .filter(Filter { mask: MOVING, ..Filter::default() });
        let slab = RigidBody::dynamic().position(middle).shape(slab).can_sleep(false);
        let (frame, body) =
            (world.add_body(RigidBody::fixed().position(middle))?, world.add_body(slab)?);
        let rail = JointDef::prismatic((0.0, 1.0)).limits(0.0, 2.7).motor(0.0, MOTOR.1);
        Ok(Self { body, joint: world.add_joint(frame, body, rail)? })
    }

    /// Opens or shuts it.
    pub fn run(&self, world: &mut World, open: bool) {
        let speed = if open { MOTOR.0 } else { -MOTOR.0 };
        if let Some(mut joint) = world.joint_mut(self.joint) {
            // The speed is a number.
            let _ = joint.set_motor_speed(speed);
        }
    }
}
