//! Joints translated to Rapier's.
//!
//! Rapier has one motor an axis, which is spring and motor in one, where descriptions have both. A
//! joint with a spring and a motor that only brakes (speed 0) gets the spring alone. What a joint
//! holds rigid keeps Rapier's default stiffness unless the description gives one.

use crate::shapes::vector;
use rapier2d::prelude::*;
use tiny_physics::{JointDef, JointKind, Motor, Spring};

/// Damping of a motor that reaches its speed within a substep.
const RIGID_DAMPING: f32 = 1.0e6;

/// Rapier's joint; `None` for a kind that this glue does not know.
pub fn joint(def: &JointDef) -> Option<GenericJoint> {
    let mut joint = match &def.kind {
        JointKind::Revolute { spring, target_angle, limits, motor } => {
            let mut joint = GenericJoint::new(JointAxesMask::LOCKED_REVOLUTE_AXES);
            set_motor(&mut joint, JointAxis::AngX, *target_angle, spring.as_ref(), motor.as_ref());
            if let Some(limits) = limits {
                joint.set_limits(JointAxis::AngX, [limits.lower, limits.upper]);
            }
            joint
        }
        JointKind::Distance { length, spring, limits, motor } => {
            let mut joint = GenericJoint::new(JointAxesMask::empty());
            joint.coupled_axes = JointAxesMask::LIN_AXES;
            set_motor(&mut joint, JointAxis::LinX, *length, spring.as_ref(), motor.as_ref());
            let rigid = spring.is_none() && motor.is_none() && limits.is_none();
            if let Some(limits) = limits {
                joint.set_limits(JointAxis::LinX, [limits.lower, limits.upper]);
            } else if rigid {
                joint.set_limits(JointAxis::LinX, [*length, *length]);
            }
            joint
        }
        JointKind::Prismatic { spring, target, limits, motor } => {
            let mut joint = GenericJoint::new(JointAxesMask::LOCKED_PRISMATIC_AXES);
            set_motor(&mut joint, JointAxis::LinX, *target, spring.as_ref(), motor.as_ref());
            if let Some(limits) = limits {
                joint.set_limits(JointAxis::LinX, [limits.lower, limits.upper]);
            }
            joint
        }
        JointKind::Wheel { spring, limits, motor } => {
            let mut joint = GenericJoint::new(JointAxesMask::LIN_Y);
            set_motor(&mut joint, JointAxis::LinX, 0.0, spring.as_ref(), None);
            set_motor(&mut joint, JointAxis::AngX, 0.0, None, motor.as_ref());
            if let Some(limits) = limits {
                joint.set_limits(JointAxis::LinX, [limits.lower, limits.upper]);
            }
            joint
        }
        JointKind::Weld { linear: None, angular: None } => {
            GenericJoint::new(JointAxesMask::LOCKED_FIXED_AXES)
        }
        _ => return None,
    };
    joint.set_local_frame1(Pose::new(vector(def.anchor_a), def.angle_a));
    joint.set_local_frame2(Pose::new(vector(def.anchor_b), def.angle_b));
    joint.set_contacts_enabled(def.collide_connected);
    if let Some(softness) = def.softness {
        joint.softness = SpringCoefficients::new(softness.hertz, softness.damping_ratio);
    }
    Some(joint)
}

fn set_motor(
    joint: &mut GenericJoint,
    axis: JointAxis,
    target: f32,
    spring: Option<&Spring>,
    motor: Option<&Motor>,
) {
    if let Some(spring) = spring {
        let omega = core::f32::consts::TAU * spring.hertz;
        joint.set_motor_position(axis, target, omega * omega, 2.0 * spring.damping_ratio * omega);
    } else if let Some(motor) = motor {
        joint.set_motor_velocity(axis, motor.speed, RIGID_DAMPING);
        joint.set_motor_max_force(axis, motor.max);
    }
}
