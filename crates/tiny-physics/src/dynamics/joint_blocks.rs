//! Joint data in blocks of lanes: structure of arrays, sixteen joints of one class a block.
//!
//! A block is put together from parts that several classes share: the two anchors, softness, what
//! acts along a free coordinate. Lanes past the end of a bucket point to body 0 and keep nothing
//! from moving, so kernels need no tail code.
//!
//! The lanes of a joint are of three sorts: what follows from its description and the substep length
//! (written when the block is stale), what follows from the poses (written every step), and
//! accumulated impulses (which live on, and move to the record while the joint sleeps).

use super::blocks::{LaneBlock, lane_block};
use crate::codec::{Reader, Sink};
use crate::describe::JointKind;
use crate::error::Error;
use crate::math::Vec2;
use crate::simd::BLOCK;

/// Most impulses that a joint accumulates.
pub(crate) const IMPULSES: usize = 6;

/// A limit that is never reached, metres or radians.
pub(crate) const UNLIMITED: f32 = 1.0e18;

/// Accumulated impulses of a joint without lanes, in the order in which its block declares them.
pub(crate) type Impulses = [f32; IMPULSES];

/// Which kernel solves a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum JointClass {
    Distance,
    #[default]
    Revolute,
    /// Prismatic and wheel joints.
    Slider,
    Weld,
    /// Motor and mouse joints.
    Drive,
    Pulley,
    Gear,
}

impl JointClass {
    /// The class of a kind; `None` for joints without anything to solve.
    pub(crate) fn of(kind: &JointKind) -> Option<Self> {
        Some(match kind {
            JointKind::Distance { .. } => Self::Distance,
            JointKind::Revolute { .. } => Self::Revolute,
            JointKind::Prismatic { .. } | JointKind::Wheel { .. } => Self::Slider,
            JointKind::Weld { .. } => Self::Weld,
            JointKind::Motor { .. } | JointKind::Mouse { .. } => Self::Drive,
            JointKind::Pulley { .. } => Self::Pulley,
            JointKind::Gear { .. } => Self::Gear,
            JointKind::Filter => return None,
        })
    }

    /// Multiplies impulses. What a gear has slipped is none.
    pub(crate) fn scale(self, impulses: &mut Impulses, factor: f32) {
        let count = if self == Self::Gear { 1 } else { impulses.len() };
        impulses[..count].iter_mut().for_each(|impulse| *impulse *= factor);
    }
}

/// Lanes, or parts made of lanes.
pub(crate) trait LaneData: LaneBlock {
    /// Number of accumulated impulses.
    const IMPULSES: usize;
    /// The impulses of a lane, into as many places.
    fn save(&self, lane: usize, impulses: &mut [f32]);
    /// The other way round.
    fn restore(&mut self, lane: usize, impulses: &[f32]);
}

/// Declares a part: one array for each value of a joint; those after `impulses` live on while the joint has no lanes.
macro_rules! joint_lanes {
    ($(#[$meta:meta])* $name:ident {
        $($(#[$field_meta:meta])* $field:ident : $type:ty = $null:expr,)*
        $(; impulses $($(#[$impulse_meta:meta])* $impulse:ident,)*)?
    }) => {
        lane_block! {
            $(#[$meta])*
            pub(crate) struct $name {
                $($(#[$field_meta])* $field: $type = $null,)*
                $($($(#[$impulse_meta])* $impulse: f32 = 0.0,)*)?
            }
        }

        #[allow(unused_variables, reason = "parts without impulses")]
        impl LaneData for $name {
            const IMPULSES: usize = <[&str]>::len(&[$($(stringify!($impulse)),*)?]);

            fn save(&self, lane: usize, impulses: &mut [f32]) {
                impulses.copy_from_slice(&[$($(self.$impulse[lane]),*)?]);
            }
            fn restore(&mut self, lane: usize, impulses: &[f32]) {
                if let [$($($impulse),*)?] = impulses {
                    $($(self.$impulse[lane] = *$impulse;)*)?
                }
            }
        }
    };
}

/// Declares a block: the bodies' indices and parts.
macro_rules! joint_block {
    ($(#[$meta:meta])* $name:ident { $($(#[$part_meta:meta])* $part:ident : $type:ty,)* }) => {
        lane_block! {
            $(#[$meta])*
            pub(crate) struct $name {}
            parts { frame: FrameLanes, $($(#[$part_meta])* $part: $type,)* }
        }

        impl JointLanes for $name {
            const IMPULSES: usize = 0 $(+ <$type>::IMPULSES)*;

            fn frame(&mut self) -> &mut FrameLanes {
                &mut self.frame
            }
            #[allow(unused_variables, reason = "after the last part")]
            fn save(&self, lane: usize, impulses: &mut Impulses) {
                let rest = &mut impulses[..];
                $(let (own, rest) = rest.split_at_mut(<$type>::IMPULSES);
                self.$part.save(lane, own);)*
            }
            #[allow(unused_variables, reason = "after the last part")]
            fn restore(&mut self, lane: usize, impulses: &Impulses) {
                let rest = &impulses[..];
                $(let (own, rest) = rest.split_at(<$type>::IMPULSES);
                self.$part.restore(lane, own);)*
            }
        }

        const _: () = assert!(<$name as JointLanes>::IMPULSES <= IMPULSES);
    };
}

/// A block of one class of joints.
pub(crate) trait JointLanes: LaneBlock {
    /// Number of accumulated impulses.
    const IMPULSES: usize;
    /// The part that all classes have.
    fn frame(&mut self) -> &mut FrameLanes;
    /// The impulses of a lane, into the first places.
    fn save(&self, lane: usize, impulses: &mut Impulses);
    /// The other way round.
    fn restore(&mut self, lane: usize, impulses: &Impulses);
}

joint_lanes! {
    /// Bodies, and anchors relative to their centres of mass, metres.
    FrameLanes {
        body_a: u32 = 0,
        body_b: u32 = 0,
        /// In the axes of the bodies.
        local_a_x: f32 = 0.0,
        local_a_y: f32 = 0.0,
        local_b_x: f32 = 0.0,
        local_b_y: f32 = 0.0,
        /// In the world's axes at the start of the step.
        a_x: f32 = 0.0,
        a_y: f32 = 0.0,
        b_x: f32 = 0.0,
        b_y: f32 = 0.0,
        /// From the centre of mass of A to that of B at the start of the step.
        between_x: f32 = 0.0,
        between_y: f32 = 0.0,
        /// From where the joint would have B to where it is, as far as it may be torn, metres.
        off_x: f32 = 0.0,
        off_y: f32 = 0.0,
        /// The part of its impulses that what is torn lets go of in a solve, see `stages/joint_solver/torn.rs`.
        yields: f32 = 0.0,
    }
}

impl FrameLanes {
    /// From where a joint would have B to where it is.
    pub(crate) fn off(&self, lane: usize) -> Vec2 {
        Vec2::new(self.off_x[lane], self.off_y[lane])
    }
}

joint_lanes! {
    /// A soft constraint: position error times `push`, velocity times `mass_scale`, accumulated
    /// impulse times `impulse_scale` make the impulse.
    SoftLanes {
        push: f32 = 0.0,
        mass_scale: f32 = 0.0,
        impulse_scale: f32 = 0.0,
        /// Part of the velocity that the relax pass takes away: all of it where the constraint is rigid.
        ease: f32 = 0.0,
        /// Above 0 where the constraint is held: 1, or 2 as softly as the user asks; 0 where it is a spring.
        rigid: f32 = 0.0,
    }
}

joint_lanes! {
    /// Impulses along x and y (or across the axis, and angular), newton seconds.
    PointLanes2 {
        ; impulses
        impulse_x,
        impulse_y,
    }
}

joint_lanes! {
    /// An impulse along the joint's one rigid direction.
    RodLanes {
        ; impulses
        impulse,
    }
}

joint_lanes! {
    /// An angle between the bodies, radians.
    AngleLanes {
        /// Cosine and sine of what the description adds to the angle.
        turn_c: f32 = 1.0,
        turn_s: f32 = 0.0,
        /// At the start of the step.
        start: f32 = 0.0,
    }
}

joint_lanes! {
    /// A direction that turns with body A.
    DirectionLanes {
        /// In the axes of A.
        local_x: f32 = 1.0,
        local_y: f32 = 0.0,
        /// In the world's axes at the start of the step.
        x: f32 = 1.0,
        y: f32 = 0.0,
        /// In the world's axes as of the last relax pass.
        now_x: f32 = 1.0,
        now_y: f32 = 0.0,
    }
}

joint_lanes! {
    /// What acts along a joint's free coordinate: spring, motor, limits.
    AxisLanes {
        /// 1 where there is any of them; blocks of zeros skip this part.
        used: f32 = 0.0,
        /// Coefficients of the spring, as in [`SoftLanes`]; zeros for none.
        push: f32 = 0.0,
        mass_scale: f32 = 0.0,
        impulse_scale: f32 = 0.0,
        ease: f32 = 0.0,
        /// Where the spring rests; for angles, seen from the coordinate at the start of the step.
        rest: f32 = 0.0,
        target: f32 = 0.0,
        motor_speed: f32 = 0.0,
        /// Greatest impulse of the motor in a substep.
        motor_max: f32 = 0.0,
        lower: f32 = -UNLIMITED,
        upper: f32 = UNLIMITED,
        ; impulses
        spring,
        motor,
        lower_impulse,
        upper_impulse,
    }
}

/// The same of one joint, or of the joints of a stride.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Axis<L> {
    pub(crate) push: L,
    pub(crate) mass_scale: L,
    pub(crate) impulse_scale: L,
    pub(crate) ease: L,
    pub(crate) rest: L,
    pub(crate) motor_speed: L,
    pub(crate) motor_max: L,
    /// Lower and upper.
    pub(crate) ends: [L; 2],
    /// Accumulated impulses, those of the limits from the lower and from the upper one.
    pub(crate) spring: L,
    pub(crate) motor: L,
    pub(crate) limits: [L; 2],
}

joint_block! {
    DistanceBlock { soft: SoftLanes, rod: RodLanes, axis: AxisLanes, length: LengthLanes, }
}

joint_lanes! {
    /// A distance and its direction.
    LengthLanes {
        length: f32 = 0.0,
        /// From A to B as of the last relax pass.
        now_x: f32 = 1.0,
        now_y: f32 = 0.0,
    }
}

joint_block! {
    RevoluteBlock { soft: SoftLanes, point: PointLanes2, angle: AngleLanes, axis: AxisLanes, }
}

joint_block! {
    SliderBlock {
        soft: SoftLanes,
        /// Impulse across the axis, and angular.
        rigid: PointLanes2,
        angle: AngleLanes,
        direction: DirectionLanes,
        wheel: WheelLanes,
        axis: AxisLanes,
    }
}

joint_lanes! {
    /// What makes a slider a wheel.
    WheelLanes {
        /// 1 where the angle is free, else 0.
        turns: f32 = 0.0,
        /// Of the motor, and its greatest impulse in a substep.
        speed: f32 = 0.0,
        max: f32 = 0.0,
    }
}

joint_block! {
    WeldBlock {
        linear: SoftLanes,
        angular: SoftLanes,
        point: PointLanes2,
        twist: RodLanes,
        angle: AngleLanes,
    }
}

joint_lanes! {
    /// Drives of a motor or mouse joint; maxima are impulses of a substep.
    DriveLanes {
        /// Where anchor B is pulled, for mouse joints: metres in the world.
        target_x: f64 = 0.0,
        target_y: f64 = 0.0,
        /// 1 for mouse joints.
        mouse: f32 = 0.0,
        velocity_x: f32 = 0.0,
        velocity_y: f32 = 0.0,
        velocity_max: f32 = 0.0,
        spring_max: f32 = 0.0,
        angular_velocity: f32 = 0.0,
        angular_max: f32 = 0.0,
        twist_max: f32 = 0.0,
        /// What the springs would push without their maxima, as of the last pass.
        uncut_x: f32 = 0.0,
        uncut_y: f32 = 0.0,
        uncut_twist: f32 = 0.0,
        ; impulses
        velocity_impulse_x,
        velocity_impulse_y,
        angular_impulse,
    }
}

joint_block! {
    DriveBlock {
        linear: SoftLanes,
        angular: SoftLanes,
        point: PointLanes2,
        twist: RodLanes,
        angle: AngleLanes,
        drive: DriveLanes,
    }
}

joint_lanes! {
    /// The fixed points of a pulley.
    RopeLanes {
        /// Metres in the world.
        ground_a_x: f64 = 0.0,
        ground_a_y: f64 = 0.0,
        ground_b_x: f64 = 0.0,
        ground_b_y: f64 = 0.0,
        /// From the fixed point to the centre of mass at the start of the step.
        arm_a_x: f32 = 0.0,
        arm_a_y: f32 = 0.0,
        arm_b_x: f32 = 0.0,
        arm_b_y: f32 = 0.0,
        ratio: f32 = 1.0,
        length: f32 = 0.0,
        /// From the fixed point of B to its anchor as of the last relax pass.
        now_x: f32 = 1.0,
        now_y: f32 = 0.0,
    }
}

joint_block! {
    PulleyBlock { soft: SoftLanes, rod: RodLanes, rope: RopeLanes, }
}

joint_lanes! {
    /// The coupled coordinates of a gear: direction of sliding, or 1 as spin.
    GearLanes {
        slide_a_x: f32 = 0.0,
        slide_a_y: f32 = 0.0,
        spin_a: f32 = 0.0,
        /// B's are multiplied with the ratio.
        slide_b_x: f32 = 0.0,
        slide_b_y: f32 = 0.0,
        spin_b: f32 = 0.0,
        ; impulses
        impulse,
        /// Sum of both changes since the joint was added: no impulse, but it lives on like one.
        error,
    }
}

joint_block! {
    GearBlock { soft: SoftLanes, gear: GearLanes, }
}
