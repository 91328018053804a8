//! A joint as described by the user.

use crate::codec::{described, described_enum, setters};
use crate::error::Error;
use crate::geometry::check_point;
use crate::math::{DVec2, Vec2};

described! {
    /// A spring and damper by its behaviour, whatever the masses of the two bodies; what hangs on these in turn makes it slower.
    /// Frequency and decay are met exactly up to a tenth of the substep rate; stiffer ones of little damping are damped more, so that
    /// many of them on one body and nets of them do not swing up, and what is faster than a seventh of the rate acts as one of that.
    /// Where many act on a body, each in a direction of its own, they give way so that a substep can follow all of them: of n like ones none
    /// is stiffer than a fifth of the rate over the root of n, which for eight at each knot of a net is 16 hertz by default.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct Spring {
        /// Oscillations a second, hertz, above 0.
        pub hertz: f32,
        /// 0 rings for ever, 1 comes to rest without overshoot.
        pub damping_ratio: f32,
    }
}

described! {
    /// Drives a joint at a speed with a bounded force.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct Motor {
        /// Metres or radians a second.
        pub speed: f32,
        /// Greatest force (newtons) or torque (newton metres), 0 or above.
        pub max: f32,
    }
}

described! {
    /// A range that a joint's coordinate stays in, metres or radians.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct Limits {
        /// Lower end.
        pub lower: f32,
        /// Upper end, not below the lower.
        pub upper: f32,
    }
}

described! {
    /// Load at which a joint breaks: one that bears more in any substep is removed after the step, and an
    /// event says so.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct Break {
        /// Newtons; `f32::MAX` never.
        pub force: f32,
        /// Newton metres; `f32::MAX` never.
        pub torque: f32,
    }
}

described_enum! {
    /// What a joint does. A and B are the joint's two bodies, anchors are points of their frames, angles
    /// are B's against A's, directions are given by [`JointDef::angle_a`]. What acts on B acts on A the
    /// other way round.
    #[derive(Clone, Copy, PartialEq, Debug)]
    #[non_exhaustive]
    pub enum JointKind {
        /// Keeps the anchors at a distance. Without spring, limits and motor it is a rigid rod of
        /// `length`; with any of them the distance is free but for what they do.
        Distance {
            /// Length of the rod, and rest length of the spring, metres, above 0.
            length: f32,
            /// Pulls the distance to `length`.
            spring: Option<Spring> = default,
            /// Shortest and longest distance; a rope has limits from 0.
            limits: Option<Limits> = default,
            /// Drives the distance.
            motor: Option<Motor> = default,
        } = 0,
        /// A hinge: the anchors coincide, the bodies turn about them.
        Revolute {
            /// Pulls the angle to `target_angle`.
            spring: Option<Spring> = default,
            /// Where the spring rests, radians.
            target_angle: f32 = default,
            /// Range of the angle, radians, less than a whole turn wide.
            limits: Option<Limits> = default,
            /// Drives the angle.
            motor: Option<Motor> = default,
        } = 1,
        /// A slider: anchor B stays on the line through anchor A along the joint's direction, and the
        /// bodies do not turn against each other. Its coordinate is the distance along the line.
        Prismatic {
            /// Pulls the coordinate to `target`.
            spring: Option<Spring> = default,
            /// Where the spring rests, metres.
            target: f32 = default,
            /// Range of the coordinate, metres.
            limits: Option<Limits> = default,
            /// Drives the coordinate.
            motor: Option<Motor> = default,
        } = 2,
        /// Glues the bodies: anchors and angles coincide.
        Weld {
            /// Makes the place springy; `None` is rigid.
            linear: Option<Spring> = default,
            /// Makes the angle springy; `None` is rigid.
            angular: Option<Spring> = default,
        } = 3,
        /// A wheel B on a suspension of A: anchor B stays on the line through anchor A along the joint's
        /// direction and B turns freely.
        Wheel {
            /// Suspension: pulls the distance along the line to 0.
            spring: Option<Spring> = default,
            /// Range of the distance along the line, metres.
            limits: Option<Limits> = default,
            /// Turns the wheel, radians a second against A.
            motor: Option<Motor> = default,
        } = 4,
        /// Drives B against A by bounded forces: at a velocity, to anchor A, or both. Zero velocity with
        /// a maximum is friction (a body seen from above).
        Motor {
            /// Velocity of anchor B against anchor A, metres a second, world axes.
            velocity: Vec2 = default,
            /// Greatest force that keeps the velocity, newtons.
            max_force: f32 = default,
            /// Angular velocity of B against A, radians a second.
            angular_velocity: f32 = default,
            /// Greatest torque that keeps the angular velocity, newton metres.
            max_torque: f32 = default,
            /// Pulls anchor B to anchor A.
            linear_spring: Option<Spring> = default,
            /// Greatest force of that spring, newtons.
            max_spring_force: f32 = default,
            /// Pulls the angle to 0.
            angular_spring: Option<Spring> = default,
            /// Greatest torque of that spring, newton metres.
            max_spring_torque: f32 = default,
        } = 5,
        /// Pulls anchor B to a point of the world, as when dragged by a mouse, and slows its turning a little
        /// (by 2 1/s). A feels nothing: it may be any static body.
        Mouse {
            /// Where to, metres in the world.
            target: DVec2,
            /// How.
            spring: Spring,
            /// Greatest force, newtons.
            max_force: f32,
        } = 6,
        /// Does nothing but keep the bodies from colliding with each other.
        Filter = 7,
        /// A rope from anchor A over two fixed points of the world to anchor B:
        /// `distance(A, ground_a) + ratio * distance(B, ground_b) <= length`. It pulls, it never pushes.
        Pulley {
            /// Where A's end hangs from, metres in the world.
            ground_a: DVec2,
            /// Where B's end hangs from, metres in the world.
            ground_b: DVec2,
            /// Length of the rope, metres.
            length: f32,
            /// How much faster A's end runs than B's, 1e-9 to 1e9: 2 is a block and tackle on B.
            ratio: f32,
        } = 8,
        /// Couples motions of two bodies against the world (not against a carrier that turns):
        /// `change of A + ratio * change of B = 0`, from the moment on in which the joint is added. A change is that of the angle (radians) or, where a
        /// direction is given, of the anchor's place along it (metres). The bodies keep their own hinges
        /// and sliders.
        Gear {
            /// Turns (or metres) of A per turn (or metre) of B, the other way round, 1e-9 to 1e9 or minus that.
            ratio: f32,
            /// A slides in this direction of the world, as a rack; `None`: A turns.
            slide_a: Option<Vec2> = default,
            /// B slides in this direction of the world; `None`: B turns.
            slide_b: Option<Vec2> = default,
        } = 9,
    }
}

described! {
    /// A joint to be added between two bodies of a world.
    ///
    /// ```
    /// use tiny_physics::{JointDef, Vec2};
    /// let hinge = JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0)).motor(2.0, 100.0);
    /// let rod = JointDef::distance(3.0);
    /// assert!(hinge != rod);
    /// assert!(hinge.validate().is_ok());
    /// assert!(JointDef::distance(-3.0).validate().is_err());
    /// ```
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct JointDef {
        /// What it does.
        pub kind: JointKind,
        /// Anchor in A's frame, metres.
        pub anchor_a: Vec2 = default,
        /// Anchor in B's frame, metres.
        pub anchor_b: Vec2 = default,
        /// Direction of the joint's frame in A's frame, radians: the line of sliders, and a part of the
        /// zero of angles. The joint's angle is B's angle + `angle_b` - A's angle - `angle_a`.
        pub angle_a: f32 = default,
        /// Direction of the joint's frame in B's frame, radians.
        pub angle_b: f32 = default,
        /// Do the joined bodies still collide with each other?
        pub collide_connected: bool = default,
        /// Stiffness of what the joint holds rigid, and of its limits. With `None` that is as stiff as the substeps bear: joints in
        /// trees are solved directly, others take 60 hertz between two dynamic bodies (at most a quarter of the substep rate),
        /// else one and a half times the substep rate, damping ratio 2. A joint with a softness of its own is in no tree, and acts as one
        /// of a quarter of the substep rate where it asks for more hertz, of one and a half times that rate where one of its bodies does
        /// not move: stiffer ones shake.
        pub softness: Option<Spring> = default,
        /// Load at which it breaks.
        pub break_at: Option<Break> = default,
        /// Anchors on A and B in the world, metres, instead of those in the bodies' frames. Angles then are those of the
        /// world, too: the bodies count as not turned yet. Adding or setting the joint turns all that into anchors and
        /// angles of the bodies as they are at that moment, and leaves `None` here.
        pub anchors_at: Option<[DVec2; 2]> = default,
        /// A joint that is not enabled is kept but does nothing: it does not even keep its bodies from colliding.
        #[cfg_attr(feature = "serde", serde(default = "enabled"))]
        pub enabled: bool,
        /// Free for the user.
        pub user_data: u64 = default,
    }
    with fn of_kind(kind: JointKind, enabled: bool);
}

/// Constructors.
impl JointDef {
    /// A joint of a kind with both anchors at the bodies' origins.
    pub fn new(kind: JointKind) -> Self {
        Self::of_kind(kind, true)
    }

    /// A rigid rod of a length in metres.
    pub fn distance(length: f32) -> Self {
        Self::new(JointKind::Distance { length, spring: None, limits: None, motor: None })
    }

    /// A rope: the anchors are at most `length` metres apart.
    pub fn rope(length: f32) -> Self {
        Self::distance(length).limits(0.0, length)
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

    /// A slider along a direction of A's frame, for bodies that now have the same angle.
    pub fn prismatic(direction: impl Into<Vec2>) -> Self {
        let kind = JointKind::Prismatic { spring: None, target: 0.0, limits: None, motor: None };
        Self::new(kind).direction(direction)
    }

    /// Rigid glue.
    pub fn weld() -> Self {
        Self::new(JointKind::Weld { linear: None, angular: None })
    }

    /// A wheel on a suspension along a direction of A's frame, without a spring yet.
    pub fn wheel(direction: impl Into<Vec2>) -> Self {
        Self::new(JointKind::Wheel { spring: None, limits: None, motor: None }).direction(direction)
    }

    /// A drive without any force yet; set the fields of [`JointKind::Motor`], or see
    /// [`JointDef::friction`].
    pub fn drive() -> Self {
        Self::friction(0.0, 0.0)
    }

    /// Friction between two bodies: a bounded force and torque against any motion.
    pub fn friction(max_force: f32, max_torque: f32) -> Self {
        Self::new(JointKind::Motor {
            velocity: Vec2::ZERO,
            max_force,
            angular_velocity: 0.0,
            max_torque,
            linear_spring: None,
            max_spring_force: 0.0,
            angular_spring: None,
            max_spring_torque: 0.0,
        })
    }

    /// Pulls anchor B to a point of the world with a spring of 5 hertz, damping ratio 0.7, and at most
    /// `max_force` newtons. The bodies still collide: A may be the ground that B lies on.
    pub fn mouse(target: impl Into<DVec2>, max_force: f32) -> Self {
        let spring = Spring { hertz: 5.0, damping_ratio: 0.7 };
        let kind = JointKind::Mouse { target: target.into(), spring, max_force };
        Self { collide_connected: true, ..Self::new(kind) }
    }

    /// Only keeps the bodies from colliding.
    pub fn filter() -> Self {
        Self::new(JointKind::Filter)
    }

    /// A rope over two fixed points, ratio 1.
    pub fn pulley(ground_a: impl Into<DVec2>, ground_b: impl Into<DVec2>, length: f32) -> Self {
        let (ground_a, ground_b) = (ground_a.into(), ground_b.into());
        Self::new(JointKind::Pulley { ground_a, ground_b, length, ratio: 1.0 })
    }

    /// Couples the angles of two bodies: A turns `-ratio` times as far as B.
    pub fn gear(ratio: f32) -> Self {
        Self::new(JointKind::Gear { ratio, slide_a: None, slide_b: None })
    }
}

setters! {
    JointDef {
        /// Sets both anchors, each in its body's frame.
        anchors(anchor_a: impl Into<Vec2>, anchor_b: impl Into<Vec2>):
            anchor_a = anchor_a.into(), anchor_b = anchor_b.into();
        /// Puts the anchors at two points of the world, metres: see [`JointDef::anchor_at`].
        anchors_at(anchor_a: impl Into<DVec2>, anchor_b: impl Into<DVec2>):
            anchors_at = Some([anchor_a.into(), anchor_b.into()]);
        /// Sets [`JointDef::angle_a`] and [`JointDef::angle_b`].
        angles(angle_a: f32, angle_b: f32): angle_a = angle_a, angle_b = angle_b;
        /// Sets [`JointDef::collide_connected`].
        collide_connected(): collide_connected = true;
        /// Sets [`JointDef::softness`].
        softness(hertz: f32, damping_ratio: f32): softness = Some(Spring { hertz, damping_ratio });
        /// Sets [`JointDef::break_at`].
        break_at(force: f32, torque: f32): break_at = Some(Break { force, torque });
        /// Sets [`JointDef::user_data`].
        user_data(data: u64): user_data = data;
    }
}

/// Builder methods. One that a kind has no use for changes nothing.
impl JointDef {
    /// Puts both anchors at a point of the world, metres, and takes the bodies' angles at the moment of adding as the
    /// zero of the joint's angle: see [`JointDef::anchors_at`].
    ///
    /// ```
    /// use tiny_physics::prelude::*;
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new((0.0, -10.0));
    /// let wall = world.add_body(RigidBody::fixed())?;
    /// let sign = RigidBody::dynamic().position((3.0, 2.0)).angle(0.4).shape(Shape::rect(0.5, 0.2)?);
    /// let sign = world.add_body(sign)?;
    /// let nail = world.add_joint(wall, sign, JointDef::revolute().anchor_at((3.0, 2.2)))?;
    /// let joint = world.joint(nail).unwrap();
    /// assert!((joint.anchors().1 - DVec2::new(3.0, 2.2)).length() < 1e-6);
    /// assert!(joint.angle().abs() < 1e-6);
    /// # Ok(())
    /// # }
    /// ```
    pub fn anchor_at(self, point: impl Into<DVec2>) -> Self {
        let point = point.into();
        self.anchors_at(point, point)
    }

    /// Sets both angles of the joint's frame to that of a direction.
    pub fn direction(self, direction: impl Into<Vec2>) -> Self {
        let direction = direction.into();
        let angle = crate::math::atan2(direction.y, direction.x);
        self.angles(angle, angle)
    }

    /// Sets the spring where the kind has one (both springs of a weld). Those of [`JointKind::Motor`] are set in its fields, with the
    /// greatest force and torque of each.
    pub fn spring(mut self, hertz: f32, damping_ratio: f32) -> Self {
        self.kind.set_spring(Some(Spring { hertz, damping_ratio }));
        self
    }

    /// Sets limits where the kind has them.
    pub fn limits(mut self, lower: f32, upper: f32) -> Self {
        self.kind.set_limits(Some(Limits { lower, upper }));
        self
    }

    /// Sets a motor where the kind has one: speed in metres or radians a second, greatest force or
    /// torque. A [`JointKind::Motor`] takes it as its angular part.
    pub fn motor(mut self, speed: f32, max: f32) -> Self {
        self.kind.set_motor(Some(Motor { speed, max }));
        self
    }

    /// Sets the ratio of a pulley or gear.
    pub fn ratio(mut self, value: f32) -> Self {
        if let JointKind::Pulley { ratio, .. } | JointKind::Gear { ratio, .. } = &mut self.kind {
            *ratio = value;
        }
        self
    }
}

impl JointDef {
    /// Checks that the joint makes sense.
    ///
    /// # Errors
    /// [`Error::NotFinite`] and [`Error::OutOfRange`] name the first field that does not.
    pub fn validate(&self) -> Result<(), Error> {
        check_point("anchor_a", self.anchor_a)?;
        check_point("anchor_b", self.anchor_b)?;
        Error::check_finite("angle_a", self.angle_a)?;
        Error::check_finite("angle_b", self.angle_b)?;
        for point in self.anchors_at.iter().flatten() {
            Error::check_finite_point("anchors_at", *point)?;
        }
        check_spring("softness", self.softness)?;
        if let Some(limit) = self.break_at {
            Error::check_not_negative("break_at.force", limit.force)?;
            Error::check_not_negative("break_at.torque", limit.torque)?;
        }
        self.kind.validate()
    }
}

/// The parts that several kinds have; those that set one say whether the kind has it.
impl JointKind {
    /// The motor, if it has one that is set: of a [`JointKind::Motor`] the angular part.
    pub fn motor(&self) -> Option<Motor> {
        let mut kind = *self;
        match (kind.axis(), *self) {
            (Some((.., motor)), _) => *motor,
            (_, Self::Motor { angular_velocity: speed, max_torque: max, .. }) => {
                Some(Motor { speed, max })
            }
            _ => None,
        }
    }

    /// What acts along the free coordinate of the kinds that have one.
    fn axis(&mut self) -> Option<(&mut Option<Spring>, &mut Option<Limits>, &mut Option<Motor>)> {
        match self {
            Self::Distance { spring, limits, motor, .. }
            | Self::Revolute { spring, limits, motor, .. }
            | Self::Prismatic { spring, limits, motor, .. }
            | Self::Wheel { spring, limits, motor } => Some((spring, limits, motor)),
            _ => None,
        }
    }

    /// Its springs: along or about its free coordinate, or of place and angle.
    pub(crate) fn springs(mut self) -> [Option<Spring>; 2] {
        match self {
            Self::Weld { linear, angular } => [linear, angular],
            Self::Motor { linear_spring, angular_spring, .. } => [linear_spring, angular_spring],
            Self::Mouse { spring, .. } => [Some(spring), None],
            _ => [self.axis().and_then(|(spring, ..)| *spring), None],
        }
    }

    /// May it set bodies going that are at rest?
    pub(crate) fn drives(&self) -> bool {
        match *self {
            Self::Mouse { max_force, .. } => max_force > 0.0,
            Self::Motor { velocity, .. } if velocity != Vec2::ZERO => true,
            kind => {
                let moves = |motor: Motor| motor.max > 0.0 && motor.speed != 0.0;
                kind.springs() != [None; 2] || kind.motor().is_some_and(moves)
            }
        }
    }

    /// Has it limits?
    pub(crate) fn stops(mut self) -> bool {
        self.axis().is_some_and(|(_, limits, _)| limits.is_some())
    }

    pub(crate) fn set_motor(&mut self, value: Option<Motor>) -> bool {
        if let Self::Motor { angular_velocity, max_torque, .. } = self {
            (*angular_velocity, *max_torque) = value.map_or((0.0, 0.0), |m| (m.speed, m.max));
            return true;
        }
        self.axis().map(|(.., motor)| *motor = value).is_some()
    }

    pub(crate) fn set_limits(&mut self, value: Option<Limits>) -> bool {
        self.axis().map(|(_, limits, _)| *limits = value).is_some()
    }

    pub(crate) fn set_spring(&mut self, value: Option<Spring>) -> bool {
        match self {
            Self::Weld { linear, angular } => (*linear, *angular) = (value, value),
            Self::Mouse { spring, .. } => *spring = value.unwrap_or(*spring),
            _ => return self.axis().map(|(spring, ..)| *spring = value).is_some(),
        }
        true
    }

    pub(crate) fn set_rest(&mut self, value: f32) -> bool {
        match self {
            Self::Distance { length, spring: None, limits: Some(limits), motor: None } => {
                // A rope of that length.
                let is_rope = limits.upper == *length && limits.lower < value.min(*length);
                if is_rope {
                    (limits.upper, *length) = (value, value);
                }
                return is_rope;
            }
            Self::Distance { length: rest, .. }
            | Self::Revolute { target_angle: rest, .. }
            | Self::Prismatic { target: rest, .. }
            | Self::Pulley { length: rest, .. } => *rest = value,
            _ => return false,
        }
        true
    }

    pub(crate) fn set_max_force(&mut self, value: f32) -> bool {
        if let Self::Motor { max_force, .. } | Self::Mouse { max_force, .. } = self {
            *max_force = value;
            return true;
        }
        let motor = self.axis().and_then(|(.., motor)| motor.as_mut());
        motor.map(|motor| motor.max = value).is_some()
    }

    fn validate(&self) -> Result<(), Error> {
        match *self {
            Self::Distance { length, spring, limits, motor } => {
                Error::check_positive("length", length)?;
                check_axis(spring, length, limits, motor)?;
                limits.map_or(Ok(()), |l| Error::check_not_negative("limits.lower", l.lower))
            }
            Self::Revolute { spring, target_angle, limits, motor } => {
                check_axis(spring, target_angle, limits, motor)?;
                check_less_than_a_turn(limits)
            }
            Self::Prismatic { spring, target, limits, motor } => {
                check_axis(spring, target, limits, motor)
            }
            Self::Weld { linear, angular } => {
                check_spring("linear", linear)?;
                check_spring("angular", angular)
            }
            Self::Wheel { spring, limits, motor } => check_axis(spring, 0.0, limits, motor),
            Self::Motor {
                velocity,
                max_force,
                angular_velocity,
                max_torque,
                linear_spring,
                max_spring_force,
                angular_spring,
                max_spring_torque,
            } => {
                Error::check_finite_vec("velocity", velocity)?;
                Error::check_finite("angular_velocity", angular_velocity)?;
                Error::check_not_negative("max_force", max_force)?;
                Error::check_not_negative("max_torque", max_torque)?;
                Error::check_not_negative("max_spring_force", max_spring_force)?;
                Error::check_not_negative("max_spring_torque", max_spring_torque)?;
                check_spring("linear_spring", linear_spring)?;
                check_spring("angular_spring", angular_spring)
            }
            Self::Mouse { target, spring, max_force } => {
                Error::check_finite_point("target", target)?;
                check_spring("spring", Some(spring))?;
                Error::check_not_negative("max_force", max_force)
            }
            Self::Filter => Ok(()),
            Self::Pulley { ground_a, ground_b, length, ratio } => {
                Error::check_finite_point("ground_a", ground_a)?;
                Error::check_finite_point("ground_b", ground_b)?;
                Error::check_positive("length", length)?;
                check_ratio(ratio)
            }
            Self::Gear { ratio, slide_a, slide_b } => {
                check_ratio(ratio.abs())?;
                check_direction("slide_a", slide_a)?;
                check_direction("slide_b", slide_b)
            }
        }
    }
}

/// What a file means that does not say.
#[cfg(feature = "serde")]
fn enabled() -> bool {
    true
}

fn check_axis(
    spring: Option<Spring>,
    target: f32,
    limits: Option<Limits>,
    motor: Option<Motor>,
) -> Result<(), Error> {
    check_spring("spring", spring)?;
    Error::check_finite("target", target)?;
    if let Some(Limits { lower, upper }) = limits {
        Error::check_finite("limits.lower", lower)?;
        Error::check("limits.upper", upper, upper >= lower, "not below lower")?;
    }
    if let Some(Motor { speed, max }) = motor {
        Error::check_finite("motor.speed", speed)?;
        Error::check_not_negative("motor.max", max)?;
    }
    Ok(())
}

fn check_less_than_a_turn(limits: Option<Limits>) -> Result<(), Error> {
    limits.map_or(Ok(()), |Limits { lower, upper }| {
        let is_less = upper - lower < core::f32::consts::TAU;
        Error::check("limits.upper", upper, is_less, "less than a whole turn above lower")
    })
}

fn check_spring(name: &'static str, spring: Option<Spring>) -> Result<(), Error> {
    spring.map_or(Ok(()), |spring| {
        Error::check_positive(name, spring.hertz)?;
        Error::check_not_negative(name, spring.damping_ratio)
    })
}

/// Beyond that inverse masses would be infinite.
fn check_ratio(ratio: f32) -> Result<(), Error> {
    Error::check("ratio", ratio, (1.0e-9..=1.0e9).contains(&ratio), "1e-9 to 1e9")
}

fn check_direction(name: &'static str, direction: Option<Vec2>) -> Result<(), Error> {
    direction.map_or(Ok(()), |direction| {
        Error::check_finite_vec(name, direction)?;
        Error::check_positive(name, direction.length())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all_kinds() -> Vec<JointDef> {
        let x = Vec2::new(1.0, 0.0);
        vec![
            JointDef::distance(1.0).limits(0.5, 2.0).spring(1.0, 0.0).motor(1.0, 2.0),
            JointDef::rope(2.0),
            JointDef::revolute().limits(-1.0, 1.0).spring(2.0, 1.0).motor(1.0, 2.0),
            JointDef::prismatic(x).limits(-1.0, 1.0).spring(2.0, 1.0).motor(1.0, 2.0),
            JointDef::weld().spring(3.0, 0.5),
            JointDef::wheel(x).limits(-1.0, 1.0).spring(2.0, 1.0).motor(1.0, 2.0),
            JointDef::friction(10.0, 5.0),
            JointDef::mouse(DVec2::new(1.0, 2.0), 100.0),
            JointDef::filter(),
            JointDef::pulley(DVec2::ZERO, DVec2::new(1.0, 0.0), 5.0).ratio(2.0),
            JointDef::gear(2.0),
        ]
    }

    #[test]
    fn good_joints_pass() {
        for def in all_kinds() {
            assert_eq!(def.validate(), Ok(()), "{def:?}");
        }
    }

    #[test]
    fn hostile_numbers_are_refused() {
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
        for value in bad {
            for def in all_kinds() {
                assert!(def.anchors(Vec2::new(value, 0.0), Vec2::ZERO).validate().is_err());
                assert!(def.anchors(Vec2::ZERO, Vec2::new(0.0, value)).validate().is_err());
                assert!(def.angles(value, 0.0).validate().is_err());
                assert!(def.softness(value, 1.0).validate().is_err());
                assert!(def.break_at(value, 1.0).validate().is_err());
                let changed = [
                    def.spring(value, 1.0),
                    def.spring(1.0, value),
                    def.limits(value, 1.0),
                    def.limits(0.0, value),
                    def.motor(value, 1.0),
                    def.motor(1.0, value),
                    def.ratio(value),
                ];
                for other in changed.into_iter().filter(|other| other.kind != def.kind) {
                    assert!(other.validate().is_err(), "{other:?}");
                }
            }
            assert!(JointDef::mouse(DVec2::new(value.into(), 0.0), 1.0).validate().is_err());
            assert!(JointDef::friction(value, 1.0).validate().is_err());
        }
        assert!(JointDef::revolute().limits(1.0, -1.0).validate().is_err());
        assert!(JointDef::revolute().limits(-4.0, 4.0).validate().is_err());
        assert!(JointDef::gear(0.0).validate().is_err());
        assert!(JointDef::distance(0.0).validate().is_err());
        assert!(JointDef::distance(1.0).spring(-1.0, 0.0).validate().is_err());
    }
}
