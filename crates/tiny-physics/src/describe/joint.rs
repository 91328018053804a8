//! A joint as described by the user.

use crate::math::Vec2;

/// A spring and damper by its behaviour: independent of the masses that hang on it.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Spring {
    /// Oscillations a second, hertz, above 0.
    pub hertz: f32,
    /// 0 rings for ever, 1 comes to rest without overshoot.
    pub damping_ratio: f32,
}

/// Drives a joint at a speed with a bounded force.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Motor {
    /// Metres or radians a second.
    pub speed: f32,
    /// Greatest force (newtons) or torque (newton metres), 0 or above.
    pub max: f32,
}

/// A range that a joint's coordinate stays in, metres or radians.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Limits {
    /// Lower end.
    pub lower: f32,
    /// Upper end, not below the lower.
    pub upper: f32,
}

/// Load at which a joint breaks: it is removed and an event says so.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Break {
    /// Newtons; `f32::MAX` never.
    pub force: f32,
    /// Newton metres; `f32::MAX` never.
    pub torque: f32,
}

/// What a joint does. A and B are the joint's two bodies, anchors are points of their frames, angles
/// are B's against A's.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
#[non_exhaustive]
pub enum JointKind {
    /// Keeps the anchors at a distance.
    Distance {
        /// Rest length, metres, above 0.
        length: f32,
        /// Makes it springy between the limits; `None` is rigid.
        #[cfg_attr(feature = "serde", serde(default))]
        spring: Option<Spring>,
        /// Shortest and longest length: a rope has a spring of its own or `lower` 0.
        #[cfg_attr(feature = "serde", serde(default))]
        limits: Option<Limits>,
        /// Drives the length.
        #[cfg_attr(feature = "serde", serde(default))]
        motor: Option<Motor>,
    },
    /// A hinge: the anchors coincide, the bodies turn about them.
    Revolute {
        /// Pulls the angle to `target_angle`.
        #[cfg_attr(feature = "serde", serde(default))]
        spring: Option<Spring>,
        /// Where the spring rests, radians.
        #[cfg_attr(feature = "serde", serde(default))]
        target_angle: f32,
        /// Range of the angle, radians within [-pi, pi].
        #[cfg_attr(feature = "serde", serde(default))]
        limits: Option<Limits>,
        /// Drives the angle.
        #[cfg_attr(feature = "serde", serde(default))]
        motor: Option<Motor>,
    },
}

/// A joint to be added between two bodies of a world.
///
/// ```
/// use tiny_physics::{JointDef, Vec2};
/// let hinge = JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0)).motor(2.0, 100.0);
/// let rod = JointDef::distance(3.0);
/// assert!(hinge != rod);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct JointDef {
    /// What it does.
    pub kind: JointKind,
    /// Anchor in A's frame, metres.
    #[cfg_attr(feature = "serde", serde(default))]
    pub anchor_a: Vec2,
    /// Anchor in B's frame, metres.
    #[cfg_attr(feature = "serde", serde(default))]
    pub anchor_b: Vec2,
    /// Direction of the joint's frame in A's frame, radians: turns the zero of angles.
    #[cfg_attr(feature = "serde", serde(default))]
    pub angle_a: f32,
    /// Direction of the joint's frame in B's frame, radians.
    #[cfg_attr(feature = "serde", serde(default))]
    pub angle_b: f32,
    /// Do the joined bodies still collide with each other?
    #[cfg_attr(feature = "serde", serde(default))]
    pub collide_connected: bool,
    /// Stiffness of what the joint holds rigid; `None` takes 60 hertz, damping ratio 2.
    #[cfg_attr(feature = "serde", serde(default))]
    pub softness: Option<Spring>,
    /// Load at which it breaks.
    #[cfg_attr(feature = "serde", serde(default))]
    pub break_at: Option<Break>,
    /// Free for the user.
    #[cfg_attr(feature = "serde", serde(default))]
    pub user_data: u64,
}

impl JointDef {
    /// A joint of a kind with both anchors at the bodies' origins.
    pub fn new(kind: JointKind) -> Self {
        Self {
            kind,
            anchor_a: Vec2::ZERO,
            anchor_b: Vec2::ZERO,
            angle_a: 0.0,
            angle_b: 0.0,
            collide_connected: false,
            softness: None,
            break_at: None,
            user_data: 0,
        }
    }

    /// A rigid rod of a length in metres.
    pub fn distance(length: f32) -> Self {
        Self::new(JointKind::Distance { length, spring: None, limits: None, motor: None })
    }

    /// A free hinge.
    pub fn revolute() -> Self {
        Self::new(JointKind::Revolute {
            spring: None,
            target_angle: 0.0,
            limits: None,
            motor: None,
        })
    }

    /// Sets both anchors, each in its body's frame.
    pub fn anchors(mut self, anchor_a: Vec2, anchor_b: Vec2) -> Self {
        self.anchor_a = anchor_a;
        self.anchor_b = anchor_b;
        self
    }

    /// Sets a spring where the kind has one.
    pub fn spring(mut self, hertz: f32, damping_ratio: f32) -> Self {
        match &mut self.kind {
            JointKind::Distance { spring, .. } | JointKind::Revolute { spring, .. } => {
                *spring = Some(Spring { hertz, damping_ratio });
            }
        }
        self
    }

    /// Sets limits where the kind has them.
    pub fn limits(mut self, lower: f32, upper: f32) -> Self {
        match &mut self.kind {
            JointKind::Distance { limits, .. } | JointKind::Revolute { limits, .. } => {
                *limits = Some(Limits { lower, upper });
            }
        }
        self
    }

    /// Sets a motor where the kind has one: speed in metres or radians a second, greatest force or
    /// torque.
    pub fn motor(mut self, speed: f32, max: f32) -> Self {
        match &mut self.kind {
            JointKind::Distance { motor, .. } | JointKind::Revolute { motor, .. } => {
                *motor = Some(Motor { speed, max });
            }
        }
        self
    }

    /// Sets [`JointDef::collide_connected`].
    pub fn collide_connected(mut self) -> Self {
        self.collide_connected = true;
        self
    }

    /// Sets [`JointDef::softness`].
    pub fn softness(mut self, hertz: f32, damping_ratio: f32) -> Self {
        self.softness = Some(Spring { hertz, damping_ratio });
        self
    }

    /// Sets [`JointDef::break_at`].
    pub fn break_at(mut self, force: f32, torque: f32) -> Self {
        self.break_at = Some(Break { force, torque });
        self
    }
}
