//! Forces that come with a place: blasts, wind, water, zones.
//!
//! Nothing here is kept in the world: call the functions before every step in which the force is to act. Each
//! works on bodies in index order, so results do not depend on anything but the world.

use crate::codec::{described, described_enum};
use crate::{
    Aabb, Body, BodyId, BodyKind, BodyMut, ContactView, DVec2, JointKind, JointRef, Pose,
    QueryFilter, Shape, ShapeId, Vec2, World,
};

described! {
    /// A blast: impulses away from a point.
    #[derive(Clone, Copy, PartialEq, Debug)]
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
}

described! {
    /// Moving air (or water all around).
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct Wind {
        /// Metres a second.
        pub velocity: Vec2 = Vec2::ZERO,
        /// Density of the medium, kilograms a square metre.
        pub density: f32 = 1.2,
        /// Drag coefficient: about 1 for blunt shapes.
        pub drag: f32 = 1.0,
    }
}

described! {
    /// A body of water: everything below its surface, or what of that lies in an area.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct Water {
        /// A point of the surface: world, metres.
        pub surface: DVec2 = DVec2::ZERO,
        /// Direction out of the water, of any length.
        pub normal: Vec2 = Vec2::Y,
        /// Kilograms a square metre: what is lighter floats.
        pub density: f32 = 1000.0,
        /// Velocity of the water, metres a second.
        pub flow: Vec2 = Vec2::ZERO,
        /// How fast a body that is all water takes on the flow, 1/s.
        pub linear_drag: f32 = 2.0,
        /// How fast a body that is all water stops turning, 1/s.
        pub angular_drag: f32 = 2.0,
        /// Only shapes that overlap this box (world, metres) are in the water.
        pub area: Option<Aabb> = None,
    }
}

described_enum! {
    /// What a zone does to the bodies in it.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub enum ZoneForce {
        /// Accelerates them, metres a second squared: gravity of its own.
        Acceleration(acceleration: Vec2) = 0,
        /// Accelerates them towards a point (away from it where negative), metres a second squared.
        Attraction {
            /// World, metres.
            center: DVec2,
            /// Metres a second squared.
            acceleration: f32,
        } = 1,
        /// Wind blows on them.
        Wind(wind: Wind) = 2,
        /// Slows them, 1/s.
        Damping {
            /// Of motion.
            linear: f32,
            /// Of turning.
            angular: f32,
        } = 3,
    }
}

described! {
    /// An area in which a force acts on every body that overlaps it.
    #[derive(Clone, Copy, PartialEq, Debug)]
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
}

/// What of a shape is under water.
struct WetPart {
    body: BodyId,
    center: DVec2,
    /// Mass of the water in its place, kilograms.
    displaced: f32,
    /// That by its square of arms, as a moment of inertia.
    spread: f32,
    /// How wide it is at the surface, as it would be where it is as wide all the way down; metres.
    width: f32,
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
        let finite = falloff.is_finite() && impulse_per_metre.is_finite() && center.is_finite();
        let falloff = if falloff > 0.0 { falloff } else { 0.0 };
        let reach = radius + falloff;
        if !(finite && reach.is_finite() && radius >= 0.0) {
            self.refuse();
            return;
        }
        let side = DVec2::new(f64::from(reach), f64::from(reach));
        let bounds = Aabb::rounded_out(center - side, center + side);
        for shape in self.of_movers(filter, true, |filter| self.overlap_aabb(bounds, filter)) {
            let Some(shape) = self.shape(shape) else { continue };
            let (id, geometry, frame) = (shape.body(), *shape.shape(), shape.pose());
            let Some(body) = self.body(id) else { continue };
            let local = frame.unapply(center);
            let closest = geometry.closest_point(local);
            let distance = closest.distance(local);
            if distance > reach {
                continue;
            }
            let scale = if distance > radius { (reach - distance) / falloff } else { 1.0 };
            // From inside, everything goes away from the centre of mass.
            let inside = distance == 0.0;
            let point = if inside { body.center() } else { frame.apply(closest) };
            let away = point.relative_to(center).normalized();
            let width = geometry.width_across(frame.q.unrotate(away));
            let impulse = away * (impulse_per_metre * width * scale);
            if let Some(mut body) = self.body_mut(id) {
                body.apply_impulse(impulse, point);
            }
        }
    }

    /// Lets water act on all awake dynamic bodies whose shapes the filter shows, during the next step, which is
    /// `dt` seconds long: buoyancy (against the world's gravity) at the centre of the part under water, and
    /// drag. Bodies that sleep are left alone, so what floats at rest may sleep: wake it where the water goes.
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
            self.refuse();
            return;
        }
        let shapes: Vec<ShapeId> = self.of_movers(filter, false, |filter| match water.area {
            Some(area) => self.overlap_aabb(area, filter),
            None => self.shapes_seen(filter).collect(),
        });
        let wet = |shape| self.wet_part(shape, water, normal, dt);
        let mut parts: Vec<WetPart> = shapes.into_iter().filter_map(wet).collect();
        parts.sort_by_key(|part| part.body);
        for parts in parts.chunk_by(|a, b| a.body == b.body) {
            self.float(parts, water, normal, dt);
        }
    }

    /// What a question finds of dynamic bodies alone, of those that sleep where `asleep` says so: others are not measured.
    fn of_movers<T>(
        &self,
        filter: &QueryFilter<'_>,
        asleep: bool,
        ask: impl FnOnce(&QueryFilter<'_>) -> T,
    ) -> T {
        let moves = |id: ShapeId| {
            let body = self.shape(id).and_then(|shape| self.body(shape.body()));
            body.is_some_and(|body| body.kind() == BodyKind::Dynamic && (asleep || body.is_awake()))
                && filter.predicate.is_none_or(|shows| shows(id))
        };
        ask(&QueryFilter { predicate: Some(&moves), ..*filter })
    }

    /// What of a shape is under water.
    fn wet_part(&self, shape: ShapeId, water: &Water, normal: Vec2, dt: f32) -> Option<WetPart> {
        let shape = self.shape(shape)?;
        let (id, place) = (shape.body(), shape.pose());
        let body = self.body(id)?;
        // As it lies in the middle of the step: what bobs on forces of its start swings further and further.
        let half = 0.5 * dt;
        let turned = place.q.integrate(body.angular_velocity() * half);
        let middle = place.p + body.velocity_at(place.p) * half;
        let height = water.surface.relative_to(middle).dot(normal);
        let up = turned.unrotate(normal);
        let part = shape.shape().part_below(up, height);
        let whole = shape.shape().mass_properties(1.0);
        let (deep, most) = (2.0 * (height - up.dot(part.center)), shape.shape().width_across(up));
        (part.area > 0.0).then(|| WetPart {
            body: id,
            center: place.apply(part.center),
            displaced: water.density * part.area,
            spread: water.density * whole.inertia * (part.area / whole.mass),
            width: if deep * most > part.area { part.area / deep } else { most },
        })
    }

    /// Buoyancy and drag of all that is under water of a body. Implicit in the velocities and, where nothing much heavier
    /// holds it, in the height: no drag is too strong for a step, nor is what is light thrown out.
    fn float(&mut self, parts: &[WetPart], water: &Water, normal: Vec2, dt: f32) {
        let gravity = self.gravity;
        let Some(mut body) = parts.first().and_then(|part| self.body_mut(part.body)) else {
            return;
        };
        let rested = body.rest();
        let view = body.as_ref();
        let (mass, inertia, spin) = (view.mass(), view.inertia(), view.angular_velocity());
        let (weight, middle) = (gravity * (mass * view.gravity_scale()), view.center());
        let displaced: f32 = parts.iter().map(|part| part.displaced).sum();
        let is_free = !view.is_held(weight - gravity * displaced, gravity);
        let turns = if inertia > 0.0 { 1.0 } else { 0.0 };
        let stiff =
            if is_free { (-gravity.dot(normal)).max(0.0) * water.density * dt } else { 0.0 };
        let mut sum = Implicit::new(mass, if inertia > 0.0 { inertia } else { 1.0 });
        let (mut lift, mut tilt) = (Vec2::ZERO, 0.0);
        for part in parts {
            let arm = part.center.relative_to(middle) * turns;
            let (rate, width) = (part.displaced * water.linear_drag, part.width);
            let drag = (water.flow - view.velocity_at(part.center)) * rate;
            let twist = part.spread * water.angular_drag * turns;
            sum.push(drag, arm.cross(drag) - spin * twist);
            sum.resist(dt * rate, Vec2::X, 0.0 - arm.y);
            sum.resist(dt * rate, Vec2::Y, arm.x);
            sum.resist(dt * stiff * width, normal, arm.cross(normal));
            let turning = stiff * width * width * width * (turns / 12.0);
            sum.resist(dt * (twist + turning), Vec2::ZERO, 1.0);
            lift -= gravity * part.displaced;
            tilt -= arm.cross(gravity) * part.displaced;
        }
        if is_free {
            sum.push(lift + weight, tilt);
            // The step adds the weight by itself.
            (lift, tilt) = (-weight, 0.0);
        }
        let (linear, angular) = sum.accelerations();
        body.apply_force_to_center(linear * mass + lift);
        body.apply_torque(angular * inertia + tilt);
        body.set_rest(rested);
    }

    /// Lets the force of a zone act on all dynamic bodies that overlap it with a shape that the filter shows,
    /// each once, during the next step, which is `dt` seconds long.
    pub fn apply_zone(&mut self, zone: &ForceZone, filter: &QueryFilter<'_>, dt: f32) {
        let bodies = self.of_movers(filter, zone.wakes, |filter| {
            self.overlap_bodies(&zone.shape, zone.pose, filter)
        });
        for body in bodies {
            if let Some(mut body) = self.body_mut(body) {
                let rested = body.rest();
                body.apply_zone_force(&zone.force, dt);
                if !zone.wakes {
                    body.set_rest(rested);
                }
            }
        }
    }
}

/// Forces on a body that resist its acceleration, as those that its speed or place at the end of a step would call up.
struct Implicit {
    /// By acceleration, newtons: of x by x, of x by y, of y by y.
    linear: [f32; 3],
    /// Of x and of y by turning, of turning by itself.
    mixed: [f32; 3],
    force: Vec2,
    torque: f32,
    mass: f32,
    inertia: f32,
}

impl Implicit {
    fn new(mass: f32, inertia: f32) -> Self {
        let (linear, mixed) = ([mass, 0.0, mass], [0.0, 0.0, inertia]);
        Self { linear, mixed, force: Vec2::ZERO, torque: 0.0, mass, inertia }
    }

    fn push(&mut self, force: Vec2, torque: f32) {
        (self.force, self.torque) = (self.force + force, self.torque + torque);
    }

    /// Resists motion along a way, and the turning that goes with it.
    fn resist(&mut self, by: f32, way: Vec2, turn: f32) {
        let [xx, xy, yy] = &mut self.linear;
        (*xx, *xy, *yy) =
            (*xx + by * way.x * way.x, *xy + by * way.x * way.y, *yy + by * way.y * way.y);
        let [xw, yw, ww] = &mut self.mixed;
        (*xw, *yw, *ww) =
            (*xw + by * way.x * turn, *yw + by * way.y * turn, *ww + by * turn * turn);
    }

    /// By elimination; what is left of each is never less than without resistance.
    fn accelerations(&self) -> (Vec2, f32) {
        let ([xx, xy, yy], [xw, yw, ww]) = (self.linear, self.mixed);
        let (by_x, turned_by_x) = (xy / xx, xw / xx);
        let (y, y_turn) = ((yy - by_x * xy).max(self.mass), yw - by_x * xw);
        let turned_by_y = y_turn / y;
        let w = (ww - turned_by_x * xw - turned_by_y * y_turn).max(self.inertia);
        let force_y = self.force.y - by_x * self.force.x;
        let torque = self.torque - turned_by_x * self.force.x - turned_by_y * force_y;
        let turn = torque / w;
        let up = force_y / y - turned_by_y * turn;
        (Vec2::new(self.force.x / xx - by_x * up - turned_by_x * turn, up), turn)
    }
}

/// What is so many times as heavy as a thing, or does not move, holds that where it is joined to it or lies on it.
const HOLDS: f32 = 4.0;

impl Body<'_> {
    /// Does something that is much heavier keep it from going where a force would take it: a joint, or what lies on it? What is as
    /// light goes along.
    fn is_held(&self, force: Vec2, gravity: Vec2) -> bool {
        let (world, id) = (self.world(), self.id());
        let holds = |(a, b): (BodyId, BodyId)| {
            let other = world.body(if a == id { b } else { a });
            other.is_some_and(|other| {
                other.kind() != BodyKind::Dynamic || other.mass() > HOLDS * self.mass()
            })
        };
        let is_joined = |joint: JointRef<'_>| {
            let def = joint.def();
            def.enabled && !matches!(def.kind, JointKind::Filter) && holds(joint.bodies())
        };
        let presses = |contact: ContactView| {
            let push = contact.force() * if contact.body_b == id { 1.0 } else { -1.0 };
            push.dot(gravity) > 0.0
                && push.dot(force) < 0.0
                && holds((contact.body_a, contact.body_b))
        };
        self.joints().filter_map(|joint| world.joint(joint)).any(is_joined)
            || self.contacts().any(presses)
    }
}

impl BodyMut<'_> {
    /// Lets wind act on it during the next step, which is `dt` seconds long: on every shape that is no sensor
    /// acts 1/2 * density * drag * width * u^2 along the velocity u of the air past it, and that is limited so
    /// that no wind is too strong for a step.
    pub fn apply_wind(&mut self, wind: &Wind, dt: f32) {
        let (mass, inertia) = (self.as_ref().mass(), self.as_ref().inertia());
        let finite = wind.velocity.is_finite() && wind.density.is_finite() && wind.drag.is_finite();
        if !finite || !dt.is_finite() {
            self.refuse();
            return;
        }
        if mass <= 0.0 {
            return;
        }
        let mut forces: Vec<(Vec2, DVec2)> = Vec::new();
        let mut rate = 0.0;
        let body = self.as_ref();
        for shape in body.shapes().filter_map(|shape| body.world().shape(shape)) {
            if shape.is_sensor() {
                continue;
            }
            let (shape, frame) = (shape.shape(), shape.pose());
            let point = frame.apply(shape.mass_properties(1.0).center);
            let past = wind.velocity - body.velocity_at(point);
            let (way, speed) = past.direction_and_length();
            let width = shape.width_across(frame.q.unrotate(way));
            let strength = 0.5 * wind.density * wind.drag * width * speed;
            let arm = point.relative_to(body.center()).length_sq();
            rate += strength / mass + if inertia > 0.0 { strength * arm / inertia } else { 0.0 };
            forces.push((past * strength, point));
        }
        let scale = 1.0 / (1.0 + dt * rate);
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
                // The force stays for all substeps: with that of the start alone orbits grow.
                let substeps = body.world().settings.substeps.clamp(1, 1000) as f32;
                let late = 0.5 * dt * (1.0 - 1.0 / substeps);
                let way = center.relative_to(body.center()) - body.velocity() * late;
                let way = way.normalized();
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
