//! What a timeline can do to a world: plain data, done by a [`Host`](crate::Host).

use crate::check::{
    Check, check_body, check_material, check_shape, finite, finite_vec, index, not_negative,
    positive, range,
};
use serde::{Deserialize, Serialize};
use tiny_physics::record::{Command, FilterData};
use tiny_physics::{
    Aabb, BodyKind, DVec2, Explosion, ForceZone, Material, Pose, RigidBody, Rot, Shape, Vec2,
    Water, ZoneForce,
};

/// Water between two ends is so deep, metres.
const DEPTH: f32 = 1000.0;

/// Something done to a world from outside. Bodies go by index in a scene's file, and by the host's number in
/// [`Host::act`](crate::Host::act).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum Deed {
    /// Gives a body velocities, metres and radians a second.
    SetVelocity {
        /// The body.
        body: usize,
        /// Metres a second.
        velocity: Vec2,
        /// Radians a second.
        #[serde(default)]
        angular_velocity: f32,
    },
    /// Adds a body, which has no index: nothing more can be done to it.
    Add {
        /// The body.
        new: Box<RigidBody>,
    },
    /// Removes a body with its shapes and joints.
    Remove {
        /// The body.
        body: usize,
    },
    /// Makes a body static, kinematic or dynamic.
    SetKind {
        /// The body.
        body: usize,
        /// What moves it from now on.
        kind: BodyKind,
    },
    /// Changes the geometry of the first shape of a body.
    SetShape {
        /// The body.
        body: usize,
        /// The new geometry.
        shape: Shape,
    },
    /// Changes the material of all shapes of a body.
    SetMaterial {
        /// The body.
        body: usize,
        /// The new surface and stuff.
        material: Material,
    },
    /// Leads a kinematic body from one place to another and back, slow at the ends.
    Lead {
        /// The body.
        body: usize,
        /// Where it starts: world, metres.
        from: Vec2,
        /// Where it turns back: world, metres.
        to: Vec2,
        /// Angle that it turns by on the way, radians.
        #[serde(default)]
        turn: f32,
        /// Time there and back, seconds.
        period: f32,
    },
    /// Sets off an explosion.
    Explode {
        /// Where: world, metres.
        center: Vec2,
        /// Up to here it is at full strength, metres.
        radius: f32,
        /// Over this distance beyond the radius it falls to nothing, metres.
        falloff: f32,
        /// Newton seconds for every metre of width.
        impulse_per_metre: f32,
    },
    /// Lets water act below a surface.
    Water {
        /// Height of the surface, metres.
        surface: f32,
        /// Left and right end, metres.
        #[serde(default)]
        between: Option<(f32, f32)>,
        /// Kilograms a square metre.
        density: f32,
        /// Metres a second.
        #[serde(default)]
        flow: Vec2,
    },
    /// Lets wind act on a body.
    Wind {
        /// The body.
        body: usize,
        /// Velocity of the air, metres a second.
        velocity: Vec2,
    },
    /// Lets a force act on what overlaps an area.
    Zone {
        /// Form of the area.
        shape: Shape,
        /// Its place: world, metres.
        position: Vec2,
        /// The force.
        force: Pull,
    },
}

/// The force of a zone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Pull {
    /// Acceleration, metres a second squared.
    Along(Vec2),
    /// Acceleration towards the middle of the area, metres a second squared.
    Inwards(f32),
    /// Damping of motion and of turning, 1/s.
    Slow(f32, f32),
}

/// How far a led body is on its way, 0 to 1, at a time.
pub fn lead_progress(time: f32, period: f32) -> f32 {
    let turns = time / period;
    let phase = core::f32::consts::TAU * (turns - turns.floor());
    0.5 - 0.5 * tiny_physics::math::cos(phase)
}

impl Deed {
    /// What is done to a place in a step of `dt` seconds; `None` for what is done to a body.
    pub fn on_place(&self, dt: f32) -> Option<Command> {
        let all = FilterData::default();
        Some(match *self {
            Self::Explode { center, radius, falloff, impulse_per_metre } => {
                let center = center.into();
                let blast = Explosion { center, radius, falloff, impulse_per_metre };
                Command::Explode(blast, all)
            }
            Self::Water { surface, between, density, flow } => {
                // Boxes as large as numbers go have no half of their size.
                let area = between.map(|(left, right)| Aabb {
                    min: Vec2::new(left, surface - DEPTH),
                    max: Vec2::new(right, surface),
                });
                let surface = DVec2::new(0.0, surface.into());
                let water = Water { surface, density, flow, area, ..Water::default() };
                Command::ApplyWater(water, all, dt)
            }
            Self::Zone { shape, position, force } => {
                let pose = Pose::new(position.into(), Rot::IDENTITY);
                let force = match force {
                    Pull::Along(acceleration) => ZoneForce::Acceleration(acceleration),
                    Pull::Inwards(acceleration) => {
                        ZoneForce::Attraction { center: position.into(), acceleration }
                    }
                    Pull::Slow(linear, angular) => ZoneForce::Damping { linear, angular },
                };
                Command::ApplyZone(ForceZone { shape, pose, force, wakes: true }, all, dt)
            }
            _ => return None,
        })
    }

    pub(super) fn check(&self, bodies: usize) -> Check {
        if let Some(body) = self.body() {
            index("body", body, bodies, "bodies").map_err(|e| e.under(self.name()))?;
        }
        self.check_numbers().map_err(|e| e.under(self.name()))
    }

    fn check_numbers(&self) -> Check {
        match self {
            Self::SetVelocity { velocity, angular_velocity, .. } => {
                finite_vec("velocity", *velocity)?;
                finite("angular_velocity", *angular_velocity)
            }
            Self::Add { new } => check_body(new).map_err(|e| e.under("new")),
            Self::Remove { .. } | Self::SetKind { .. } => Ok(()),
            Self::SetShape { shape, .. } => check_shape(shape).map_err(|e| e.under("shape")),
            Self::SetMaterial { material, .. } => {
                check_material(material).map_err(|e| e.under("material"))
            }
            Self::Lead { from, to, turn, period, .. } => {
                finite_vec("from", *from)?;
                finite_vec("to", *to)?;
                finite("turn", *turn)?;
                positive("period", *period)
            }
            Self::Explode { center, radius, falloff, impulse_per_metre } => {
                finite_vec("center", *center)?;
                not_negative("radius", *radius)?;
                not_negative("falloff", *falloff)?;
                finite("impulse_per_metre", *impulse_per_metre)
            }
            Self::Water { surface, between, density, flow } => {
                finite("surface", *surface)?;
                let (left, right) = between.unwrap_or_default();
                finite("between", left).and_then(|()| finite("between", right))?;
                range("between", right, left <= right, "the left end or more")?;
                not_negative("density", *density)?;
                finite_vec("flow", *flow)
            }
            Self::Wind { velocity, .. } => finite_vec("velocity", *velocity),
            Self::Zone { shape, position, force } => {
                check_shape(shape).map_err(|e| e.under("shape"))?;
                finite_vec("position", *position)?;
                match force {
                    Pull::Along(acceleration) => finite_vec("force", *acceleration),
                    Pull::Inwards(acceleration) => finite("force", *acceleration),
                    Pull::Slow(linear, angular) => not_negative("force", *linear)
                        .and_then(|()| not_negative("force", *angular)),
                }
            }
        }
    }

    /// As it is written in a file.
    fn name(&self) -> &'static str {
        match self {
            Self::SetVelocity { .. } => "set_velocity",
            Self::Add { .. } => "add",
            Self::Remove { .. } => "remove",
            Self::SetKind { .. } => "set_kind",
            Self::SetShape { .. } => "set_shape",
            Self::SetMaterial { .. } => "set_material",
            Self::Lead { .. } => "lead",
            Self::Explode { .. } => "explode",
            Self::Water { .. } => "water",
            Self::Wind { .. } => "wind",
            Self::Zone { .. } => "zone",
        }
    }

    /// The body that it is done to.
    fn body(&self) -> Option<usize> {
        self.clone().body_mut().copied()
    }

    fn body_mut(&mut self) -> Option<&mut usize> {
        match self {
            Self::SetVelocity { body, .. }
            | Self::Remove { body }
            | Self::SetKind { body, .. }
            | Self::SetShape { body, .. }
            | Self::SetMaterial { body, .. }
            | Self::Lead { body, .. }
            | Self::Wind { body, .. } => Some(body),
            Self::Add { .. } | Self::Explode { .. } | Self::Water { .. } | Self::Zone { .. } => {
                None
            }
        }
    }

    /// The same with the host's number for the body; `None` where there is no such body.
    pub(super) fn with_bodies(&self, bodies: &[usize]) -> Option<Self> {
        let mut deed = self.clone();
        if let Some(body) = deed.body_mut() {
            *body = *bodies.get(*body)?;
        }
        Some(deed)
    }
}
