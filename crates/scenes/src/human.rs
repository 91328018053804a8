//! A ragdoll of eleven bones, as the rain scene of Box2D's benchmark defines it.

use crate::shapes;
use core::f32::consts::PI;
use tiny_physics::{Filter, JointDef, RigidBody, Shape, ShapeDef, Vec2};

/// Bodies of one human.
pub(crate) const BONE_COUNT: usize = 11;

/// Where a human stands and which others it never touches.
#[derive(Clone, Copy, Debug)]
pub struct Human {
    /// Point on the ground between its feet, metres.
    pub position: Vec2,
    /// Humans of the same negative group do not collide, nor do a human's own bones.
    pub group: i32,
}

/// One bone; heights are above [`Human::position`], metres.
struct Bone {
    parent: usize,
    y: f32,
    /// Ends of the capsule in the bone's frame, and its radius.
    capsule: (f32, f32, f32),
    linear_damping: f32,
    friction: f32,
    pivot: f32,
    /// Range of the joint, in units of pi.
    limits: (f32, f32),
    /// Turns the joint's zero, in units of pi.
    turned: f32,
    foot: bool,
}

impl Bone {
    const fn new(parent: usize, y: f32, capsule: (f32, f32, f32)) -> Self {
        let limits = (0.0, 0.0);
        Self {
            parent,
            y,
            capsule,
            linear_damping: 0.0,
            friction: 0.0,
            pivot: 0.0,
            limits,
            turned: 0.0,
            foot: false,
        }
    }

    const fn hinge(mut self, pivot: f32, lower: f32, upper: f32, friction: f32) -> Self {
        self.pivot = pivot;
        self.limits = (lower, upper);
        self.friction = friction;
        self
    }

    const fn damped(mut self) -> Self {
        self.linear_damping = 0.1;
        self
    }

    const fn turned(mut self) -> Self {
        self.turned = 0.25;
        self
    }

    const fn with_foot(mut self) -> Self {
        self.foot = true;
        self
    }
}

const UPPER_LEG: Bone = Bone::new(0, 0.775, (-0.125, 0.125, 0.06)).hinge(0.9, -0.05, 0.4, 1.0);
const UPPER_ARM: Bone = Bone::new(1, 1.225, (-0.125, 0.125, 0.035)).hinge(1.35, -0.1, 0.8, 0.5);

const fn lower_leg(parent: usize) -> Bone {
    Bone::new(parent, 0.475, (-0.155, 0.125, 0.045)).hinge(0.625, -0.5, -0.02, 0.5).with_foot()
}

const fn lower_arm(parent: usize) -> Bone {
    Bone::new(parent, 0.975, (-0.125, 0.125, 0.03)).hinge(1.1, -0.2, 0.3, 0.1).damped().turned()
}

/// Hip, torso, head, left leg, right leg, left arm, right arm; upper parts before lower ones.
const BONES: [Bone; BONE_COUNT] = [
    Bone::new(0, 0.95, (-0.02, 0.02, 0.095)),
    Bone::new(0, 1.2, (-0.135, 0.135, 0.09)).hinge(1.0, -0.25, 0.0, 0.5),
    Bone::new(1, 1.475, (-0.038, 0.039, 0.075)).hinge(1.4, -0.3, 0.1, 0.25).damped(),
    UPPER_LEG,
    lower_leg(3),
    UPPER_LEG,
    lower_leg(5),
    UPPER_ARM,
    lower_arm(7),
    UPPER_ARM,
    lower_arm(9),
];

/// Category of ground and of bones.
const GROUND: u64 = 1;
const BONE: u64 = 2;

/// Greatest torque with which a joint resists turning, newton metres, times the bone's friction.
const JOINT_FRICTION: f32 = 0.05;

impl Human {
    /// Adds one to a scene; the place of its hip there, ten more bones follow.
    pub fn add_to(&self, scene: &mut crate::Scene) -> usize {
        let (bones, joints) = self.build();
        let first = scene.bodies.len();
        scene.bodies.extend(bones);
        for (a, b, def) in joints {
            scene.joint(first + a, first + b, def);
        }
        first
    }

    /// The bodies, and joints between them by their place in the list of bodies.
    pub(crate) fn build(&self) -> (Vec<RigidBody>, Vec<(usize, usize, JointDef)>) {
        let bodies = BONES.iter().map(|bone| self.body(bone)).collect();
        let joints =
            BONES.iter().enumerate().skip(1).map(|(i, bone)| (bone.parent, i, joint(bone)));
        (bodies, joints.collect())
    }

    fn body(&self, bone: &Bone) -> RigidBody {
        let (lower, upper, radius) = bone.capsule;
        let capsule = Shape::Capsule { a: Vec2::new(0.0, lower), b: Vec2::new(0.0, upper), radius };
        let filter = Filter { category: BONE, mask: GROUND | BONE, group: self.group };
        let mut body = RigidBody::dynamic()
            .position(self.position + Vec2::new(0.0, bone.y))
            .damping(bone.linear_damping, 0.0)
            .shape(ShapeDef::new(capsule).friction(0.2).filter(filter));
        if bone.foot {
            let filter = Filter { mask: GROUND, ..filter };
            body = body.shape(ShapeDef::new(foot()).friction(0.05).filter(filter));
        }
        body.sleep_speed = 0.1;
        body
    }
}

fn foot() -> Shape {
    let corners = [(-0.03, -0.185), (0.11, -0.185), (0.11, -0.16), (-0.03, -0.14)];
    shapes::hull(&corners.map(|(x, y)| Vec2::new(x, y)), 0.015)
}

fn joint(bone: &Bone) -> JointDef {
    let anchor = |y: f32| Vec2::new(0.0, bone.pivot - y);
    let mut joint = JointDef::revolute()
        .anchors(anchor(BONES[bone.parent].y), anchor(bone.y))
        .limits(bone.limits.0 * PI, bone.limits.1 * PI)
        .motor(0.0, JOINT_FRICTION * bone.friction)
        .spring(5.0, 0.5);
    joint.angle_a = bone.turned * PI;
    joint
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn has_eleven_bones_ten_joints_and_two_feet() {
        let (bodies, joints) = Human { position: Vec2::new(3.0, 4.0), group: -1 }.build();
        assert_eq!((bodies.len(), joints.len()), (11, 10));
        assert_eq!(bodies.iter().map(|b| b.shapes.len()).sum::<usize>(), 13);
        for (a, b, def) in joints {
            let pivot = |body: usize, anchor: Vec2| bodies[body].position.to_vec2() + anchor;
            let gap = pivot(a, def.anchor_a) - pivot(b, def.anchor_b);
            assert!(gap.length() < 1e-6, "the anchors of {a} and {b} coincide");
        }
    }
}
