//! Joints translated to Box2D's.

use crate::shapes::{rot, vec2};
use boxdd_sys::ffi::*;
use tiny_physics::{JointDef, JointKind};

/// Sets spring, limits and motor of a definition, each where the description has one.
macro_rules! set_drives {
    ($def:ident, $spring:expr, $limits:expr, $motor:expr, $lower:ident, $upper:ident, $max:ident) => {
        if let Some(spring) = $spring {
            ($def.enableSpring, $def.hertz) = (true, spring.hertz);
            $def.dampingRatio = spring.damping_ratio;
        }
        if let Some(limits) = $limits {
            ($def.enableLimit, $def.$lower, $def.$upper) = (true, limits.lower, limits.upper);
        }
        if let Some(motor) = $motor {
            ($def.enableMotor, $def.motorSpeed, $def.$max) = (true, motor.speed, motor.max);
        }
    };
}

/// Makes a joint; `None` for a kind that Box2D does not have.
pub fn add_joint(
    world: b2WorldId,
    a: b2BodyId,
    b: b2BodyId,
    joint: &JointDef,
) -> Option<b2JointId> {
    // SAFETY: every definition begins as its default; world and bodies are live.
    unsafe {
        Some(match &joint.kind {
            JointKind::Revolute { spring, target_angle, limits, motor } => {
                let mut def = b2DefaultRevoluteJointDef();
                set_base(&mut def.base, a, b, joint);
                def.targetAngle = *target_angle;
                set_drives!(def, spring, limits, motor, lowerAngle, upperAngle, maxMotorTorque);
                b2CreateRevoluteJoint(world, &def)
            }
            JointKind::Distance { length, spring, limits, motor } => {
                let mut def = b2DefaultDistanceJointDef();
                set_base(&mut def.base, a, b, joint);
                def.length = *length;
                set_drives!(def, spring, limits, motor, minLength, maxLength, maxMotorForce);
                // Without a spring Box2D's joint is rigid: a spring of no stiffness is free between limits.
                def.enableSpring |= limits.is_some();
                b2CreateDistanceJoint(world, &def)
            }
            JointKind::Prismatic { spring, target, limits, motor } => {
                let mut def = b2DefaultPrismaticJointDef();
                set_base(&mut def.base, a, b, joint);
                def.targetTranslation = *target;
                set_drives!(
                    def,
                    spring,
                    limits,
                    motor,
                    lowerTranslation,
                    upperTranslation,
                    maxMotorForce
                );
                b2CreatePrismaticJoint(world, &def)
            }
            JointKind::Wheel { spring, limits, motor } => {
                let mut def = b2DefaultWheelJointDef();
                set_base(&mut def.base, a, b, joint);
                // The default has a spring.
                def.enableSpring = false;
                set_drives!(
                    def,
                    spring,
                    limits,
                    motor,
                    lowerTranslation,
                    upperTranslation,
                    maxMotorTorque
                );
                b2CreateWheelJoint(world, &def)
            }
            JointKind::Weld { linear, angular } => {
                let mut def = b2DefaultWeldJointDef();
                set_base(&mut def.base, a, b, joint);
                if let Some(spring) = linear {
                    (def.linearHertz, def.linearDampingRatio) =
                        (spring.hertz, spring.damping_ratio);
                }
                if let Some(spring) = angular {
                    (def.angularHertz, def.angularDampingRatio) =
                        (spring.hertz, spring.damping_ratio);
                }
                b2CreateWeldJoint(world, &def)
            }
            JointKind::Motor { .. } => {
                let mut def = b2DefaultMotorJointDef();
                set_base(&mut def.base, a, b, joint);
                set_motor(&mut def, &joint.kind);
                b2CreateMotorJoint(world, &def)
            }
            JointKind::Filter => {
                let mut def = b2DefaultFilterJointDef();
                set_base(&mut def.base, a, b, joint);
                b2CreateFilterJoint(world, &def)
            }
            _ => return None,
        })
    }
}

fn set_motor(def: &mut b2MotorJointDef, kind: &JointKind) {
    let JointKind::Motor {
        velocity,
        max_force,
        angular_velocity,
        max_torque,
        linear_spring,
        max_spring_force,
        angular_spring,
        max_spring_torque,
    } = kind
    else {
        return;
    };
    (def.linearVelocity, def.maxVelocityForce) = (vec2(*velocity), *max_force);
    (def.angularVelocity, def.maxVelocityTorque) = (*angular_velocity, *max_torque);
    if let Some(spring) = linear_spring {
        (def.linearHertz, def.linearDampingRatio) = (spring.hertz, spring.damping_ratio);
        def.maxSpringForce = *max_spring_force;
    }
    if let Some(spring) = angular_spring {
        (def.angularHertz, def.angularDampingRatio) = (spring.hertz, spring.damping_ratio);
        def.maxSpringTorque = *max_spring_torque;
    }
}

fn set_base(base: &mut b2JointDef, a: b2BodyId, b: b2BodyId, joint: &JointDef) {
    (base.bodyIdA, base.bodyIdB) = (a, b);
    base.localFrameA = b2Transform { p: vec2(joint.anchor_a), q: rot(joint.angle_a) };
    base.localFrameB = b2Transform { p: vec2(joint.anchor_b), q: rot(joint.angle_b) };
    base.collideConnected = joint.collide_connected;
    if let Some(softness) = joint.softness {
        base.constraintHertz = softness.hertz;
        base.constraintDampingRatio = softness.damping_ratio;
    }
}
