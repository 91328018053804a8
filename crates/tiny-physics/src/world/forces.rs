//! Forces that come with a place: blasts, wind, water, zones.
//!
//! Nothing here is kept in the world: call the functions before every step in which the force is to act. Each
//! works on bodies in index order, so results do not depend on anything but the world.

use super::World;
use super::bodies::BodyMut;
use super::queries::QueryFilter;
use crate::geometry::Shape;
use crate::math::{Aabb, DVec2, Pose, Vec2};

/// A blast: impulses away from a point.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Explosion {
    /// Where: world, metres.
    pub center: DVec2,
    /// Up to here it is at full strength, metres.
    pub radius: f32,
    /// Over this distance beyond the radius it falls to nothing, metres.
    pub falloff: f32,
    /// Newton seconds for every metre of a shape's width that faces the centre; negative pulls.
    pub impulse_per_metre: f32,
}

/// Moving air (or water all around).
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Wind {
    /// Metres a second.
    pub velocity: Vec2,
    /// Density of the medium, kilograms a square metre.
    pub density: f32,
    /// Drag coefficient: about 1 for blunt shapes.
    pub drag: f32,
}

/// A body of water: everything below its surface, or what of that lies in an area.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Water {
    /// A point of the surface: world, metres.
    pub surface: DVec2,
    /// Direction out of the water, of any length.
    pub normal: Vec2,
    /// Kilograms a square metre: what is lighter floats.
    pub density: f32,
    /// Velocity of the water, metres a second.
    pub flow: Vec2,
    /// How fast a body that is all water takes on the flow, 1/s.
    pub linear_drag: f32,
    /// How fast a body that is all water stops turning, 1/s.
    pub angular_drag: f32,
    /// Only shapes that overlap this box (world, metres) are in the water.
    pub area: Option<Aabb>,
}

/// What a zone does to the bodies in it.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum ZoneForce {
    /// Accelerates them, metres a second squared: gravity of its own.
    Acceleration(Vec2),
    /// Accelerates them towards a point (away from it where negative), metres a second squared.
    Attraction {
        /// World, metres.
        center: DVec2,
        /// Metres a second squared.
        acceleration: f32,
    },
    /// Wind blows on them.
    Wind(Wind),
    /// Slows them, 1/s.
    Damping {
        /// Of motion.
        linear: f32,
        /// Of turning.
        angular: f32,
    },
}

/// An area in which a force acts on every body that overlaps it.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ForceZone {
    /// Form of the area.
    pub shape: Shape,
    /// Where it is in the world.
    pub pose: Pose,
    /// What it does.
    pub force: ZoneForce,
    /// Does it wake sleeping bodies? Otherwise it leaves them alone.
    pub wakes: bool,
}

impl World {
    /// Sets off an explosion: every dynamic shape in reach that the filter shows gets an impulse away from the
    /// centre, at its closest point, in proportion to its width as seen from there. Shapes do not shade each
    /// other. Nothing happens where a number is not finite.
    ///
    /// ```
    /// use tiny_physics::{Explosion, QueryFilter, RigidBody, Shape, Vec2, World};
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new(Vec2::ZERO);
    /// let ball = RigidBody::dynamic().position(Vec2::new(2.0, 0.0)).shape(Shape::circle(0.5)?).mass(2.0);
    /// let ball = world.add_body(ball)?;
    /// let blast = Explosion { center: Vec2::ZERO.into(), radius: 5.0, falloff: 1.0, impulse_per_metre: 10.0 };
    /// world.explode(&blast, &QueryFilter::new());
    /// assert_eq!(world.body(ball).unwrap().velocity(), Vec2::new(5.0, 0.0));
    /// # Ok(())
    /// # }
    /// ```
    pub fn explode(&mut self, explosion: &Explosion, filter: &QueryFilter<'_>) {
        let Explosion { center, radius, falloff, impulse_per_metre } = *explosion;
        let falloff = if falloff > 0.0 { falloff } else { 0.0 };
        let reach = radius + falloff;
        if !(center.is_finite() && reach.is_finite() && radius >= 0.0) {
            self.stats.refused_numbers += 1;
            return;
        }
        let side = DVec2::new(f64::from(reach), f64::from(reach));
        let bounds = Aabb::rounded_out(center - side, center + side);
        for shape in self.overlap_aabb(bounds, filter) {
            let Ok(index) = self.shape_index(shape) else { continue };
            let record = &self.state.shapes.records[index as usize];
            let (body, geometry) = (record.body, record.shape);
            if !self.state.bodies.is_dynamic(body) {
                continue;
            }
            let frame = self.state.bodies.poses[body as usize].compose(record.central);
            let local = frame.unapply(center);
            let closest = geometry.closest_point(local);
            let distance = closest.distance(local);
            if distance > reach {
                continue;
            }
            let scale = if distance > radius { (reach - distance) / falloff } else { 1.0 };
            // From inside, everything goes away from the centre of mass.
            let inside = distance == 0.0;
            let point = if inside {
                self.state.bodies.poses[body as usize].p
            } else {
                frame.apply(closest)
            };
            let away = point.relative_to(center).normalized();
            let width = geometry.width_across(frame.q.unrotate(away));
            let impulse = away * (impulse_per_metre * width * scale);
            BodyMut { world: self, index: body }.apply_impulse(impulse, point);
        }
    }

    /// Lets water act on all awake dynamic bodies whose shapes the filter shows, during the next step, which is
    /// `dt` seconds long: buoyancy (against the world's gravity) at the centre of the part under water, and
    /// drag. Bodies that sleep are left alone, so what floats at rest may sleep.
    ///
    /// ```
    /// use tiny_physics::{QueryFilter, RigidBody, Shape, ShapeDef, Vec2, Water, World};
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new(Vec2::new(0.0, -10.0));
    /// let wood = ShapeDef::new(Shape::rect(0.5, 0.5)?).density(500.0);
    /// let wood = world.add_body(RigidBody::dynamic().position(Vec2::new(0.0, 1.0)).shape(wood))?;
    /// for _ in 0..600 {
    ///     world.apply_water(&Water::default(), &QueryFilter::new(), 1.0 / 60.0);
    ///     world.step(1.0 / 60.0);
    /// }
    /// // Half of it is under water.
    /// assert!(world.body(wood).unwrap().position().y.abs() < 0.01);
    /// # Ok(())
    /// # }
    /// ```
    pub fn apply_water(&mut self, water: &Water, filter: &QueryFilter<'_>, dt: f32) {
        let normal = water.normal.normalized();
        let numbers =
            [water.density, water.linear_drag, water.angular_drag, dt, normal.x, normal.y];
        let finite = numbers.iter().all(|n| n.is_finite()) && water.surface.is_finite();
        if !finite || !water.flow.is_finite() || normal == Vec2::ZERO {
            self.stats.refused_numbers += 1;
            return;
        }
        let shapes: Vec<u32> = match water.area {
            Some(area) => self.overlap_aabb(area, filter).iter().map(|shape| shape.index).collect(),
            None => self
                .state
                .shapes
                .indices()
                .filter(|&shape| self.query_sees(shape, filter))
                .collect(),
        };
        for shape in shapes {
            let body = self.state.shapes.records[shape as usize].body;
            if self.state.bodies.is_dynamic(body) && self.state.bodies.infos[body as usize].awake {
                self.float(shape, body, water, normal, dt);
            }
        }
    }

    /// Buoyancy and drag of one shape.
    fn float(&mut self, shape: u32, body: u32, water: &Water, normal: Vec2, dt: f32) {
        let record = &self.state.shapes.records[shape as usize];
        let frame = self.state.bodies.poses[body as usize].compose(record.central);
        let height = water.surface.relative_to(frame.p).dot(normal);
        let part = record.shape.part_below(frame.q.unrotate(normal), height);
        if part.area <= 0.0 {
            return;
        }
        let whole = record.shape.mass_properties(1.0);
        let center = frame.apply(part.center);
        let displaced = water.density * part.area;
        let gravity = self.gravity;
        let body = BodyMut { world: self, index: body };
        let (mass, inertia) = (body.as_ref().mass(), body.as_ref().inertia());
        // Implicit in the velocity, so that no drag is too strong for a step.
        let rate = displaced * water.linear_drag;
        let slip = water.flow - body.as_ref().velocity_at(center);
        let drag = slip * (rate / (1.0 + dt * rate / mass));
        let spread = water.density * whole.inertia * (part.area / whole.mass);
        let rate = spread * water.angular_drag;
        let torque = if inertia > 0.0 {
            -body.as_ref().angular_velocity() * rate / (1.0 + dt * rate / inertia)
        } else {
            0.0
        };
        let mut body = body;
        body.apply_force(drag - gravity * displaced, center);
        body.apply_torque(torque);
    }

    /// Lets the force of a zone act on all dynamic bodies that overlap it with a shape that the filter shows,
    /// each once, during the next step, which is `dt` seconds long.
    pub fn apply_zone(&mut self, zone: &ForceZone, filter: &QueryFilter<'_>, dt: f32) {
        let shapes = self.overlap_shape(&zone.shape, zone.pose, filter);
        let mut bodies: Vec<u32> =
            shapes.iter().map(|shape| self.state.shapes.records[shape.index()].body).collect();
        bodies.sort_unstable();
        bodies.dedup();
        for index in bodies {
            if self.state.bodies.is_dynamic(index)
                && (zone.wakes || self.state.bodies.infos[index as usize].awake)
            {
                BodyMut { world: self, index }.apply_zone_force(&zone.force, dt);
            }
        }
    }

    fn query_sees(&self, shape: u32, filter: &QueryFilter<'_>) -> bool {
        super::queries::sees(self, filter, shape)
    }
}

impl BodyMut<'_> {
    /// Lets wind act on it during the next step, which is `dt` seconds long: on every shape that is no sensor
    /// acts 1/2 * density * drag * width * u^2 along the velocity u of the air past it, and that is limited so
    /// that no wind is too strong for a step.
    pub fn apply_wind(&mut self, wind: &Wind, dt: f32) {
        let mass = self.as_ref().mass();
        let finite = wind.velocity.is_finite() && wind.density.is_finite() && wind.drag.is_finite();
        if !finite || !dt.is_finite() {
            self.world.stats.refused_numbers += 1;
            return;
        }
        if mass <= 0.0 {
            return;
        }
        let mut forces: Vec<(Vec2, DVec2)> = Vec::new();
        let mut rate = 0.0;
        for shape in self.world.shapes_of(self.index) {
            let record = &self.world.state.shapes.records[shape as usize];
            if record.sensor {
                continue;
            }
            let frame = self.world.state.bodies.poses[self.index as usize].compose(record.central);
            let point = frame.apply(record.shape.mass_properties(1.0).center);
            let past = wind.velocity - self.as_ref().velocity_at(point);
            let (way, speed) = past.direction_and_length();
            let width = record.shape.width_across(frame.q.unrotate(way));
            let strength = 0.5 * wind.density * wind.drag * width * speed;
            rate += strength;
            forces.push((past * strength, point));
        }
        let scale = 1.0 / (1.0 + dt * rate / mass);
        for (force, point) in forces {
            self.apply_force(force * scale, point);
        }
    }

    fn apply_zone_force(&mut self, force: &ZoneForce, dt: f32) {
        let body = self.as_ref();
        let (mass, inertia) = (body.mass(), body.inertia());
        match *force {
            ZoneForce::Acceleration(acceleration) => {
                self.apply_force_to_center(acceleration * mass)
            }
            ZoneForce::Attraction { center, acceleration } => {
                let way = center.relative_to(body.center()).normalized();
                self.apply_force_to_center(way * (acceleration * mass));
            }
            ZoneForce::Wind(wind) => self.apply_wind(&wind, dt),
            ZoneForce::Damping { linear, angular } => {
                let slow = |rate: f32| rate / (1.0 + dt * rate);
                let (velocity, spin) = (body.velocity(), body.angular_velocity());
                self.apply_force_to_center(-velocity * (mass * slow(linear)));
                self.apply_torque(-spin * (inertia * slow(angular)));
            }
        }
    }
}

impl Default for Water {
    /// Water below y = 0, as heavy as water a metre deep, and at rest.
    fn default() -> Self {
        Self {
            surface: DVec2::ZERO,
            normal: Vec2::Y,
            density: 1000.0,
            flow: Vec2::ZERO,
            linear_drag: 2.0,
            angular_drag: 2.0,
            area: None,
        }
    }
}

impl Default for Wind {
    /// Still air, a metre deep.
    fn default() -> Self {
        Self { velocity: Vec2::ZERO, density: 1.2, drag: 1.0 }
    }
}
