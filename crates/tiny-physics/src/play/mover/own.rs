//! What a game adds to a character: a body that others notice, moves by rules of its own.

use super::{CharacterMover, Frame, MOST_HITS, MoverHit};
use crate::geometry::distance;
use crate::{DVec2, Pose, RigidBody, Rot, Shape, ShapeDef, ShapeRef, Transform, Vec2, World};

/// What is as high as this many radii is a circle, whatever rounding says.
const ROUND: f32 = 1.999;

impl CharacterMover {
    /// A body for it to take along: kinematic, with a sensor of the character's form that sees everything, other
    /// sensors too. So pickups, doors and zones may be plain sensors: a [`SensorBegin`](crate::SensorBegin) whose
    /// `sensor_body` is this body tells that the character has met its visitor.
    ///
    /// ```
    /// use tiny_physics::prelude::*;
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new((0.0, -10.0));
    /// world.add_body(RigidBody::fixed().shape(Shape::rect(20.0, 1.0)?))?;
    /// let coin = ShapeDef::new(Shape::circle(0.2)?).sensor();
    /// let coin = world.add_body(RigidBody::fixed().position((3.0, 1.5)).shape(coin))?;
    /// let mut hero = CharacterMover::new((0.0, 2.0), 1.8, 0.3);
    /// hero.body = Some(world.add_body(hero.describe_body())?);
    /// let mut found = None;
    /// for _ in 0..90 {
    ///     world.step(1.0 / 60.0);
    ///     hero.update(&mut world, MoverInput { walk: 3.0, ..MoverInput::default() }, 1.0 / 60.0);
    ///     let met = world.events().sensor_begin().iter().filter(|event| Some(event.sensor_body) == hero.body);
    ///     found = found.or(met.map(|event| event.visitor_body).find(|body| *body == coin));
    /// }
    /// assert_eq!(found, Some(coin));
    /// # Ok(())
    /// # }
    /// ```
    pub fn describe_body(&self) -> RigidBody {
        let form = ShapeDef::new(self.capsule(Vec2::Y, 0.0)).filter(self.filter);
        RigidBody::kinematic().position(self.position).shape(form.sensor_of_sensors())
    }

    /// Puts its body where it is, upright. Its [sensor of sensors](crate::ShapeDef::sensor_of_sensors) gets its form; if there are
    /// several, a capsule, and the one nearest in size (width and height together).
    /// [`CharacterMover::update`] does so at its end; call it after [`CharacterMover::move_by`] where there is no update.
    pub fn lead_body(&self, world: &mut World) {
        let (Frame { up, .. }, capsule) = (Frame::of(world), self.capsule(Vec2::Y, 0.0));
        let Some(mut body) = self.body.and_then(|body| world.body_mut(body)) else { return };
        let pose = Pose::new(self.position, Rot { c: up.y, s: 0.0 - up.x });
        body.set_pose(pose);
        let body = body.as_ref();
        let size = |form: &ShapeRef<'_>| form.shape().aabb(Transform::IDENTITY).perimeter();
        let wrong =
            |form: &ShapeRef<'_>| (size(form) - 2.0 * (self.height + 2.0 * self.radius)).abs();
        let forms = body.shapes().filter_map(|form| body.world().shape(form));
        let forms = forms.filter(|form| form.is_sensor() && form.describe().sees_sensors);
        let is_other = |form: &ShapeRef<'_>| !matches!(form.shape(), Shape::Capsule { .. });
        let key = |form: &ShapeRef<'_>| (is_other(form), wrong(form));
        let order = |(a, x): (bool, f32), (b, y): (bool, f32)| a.cmp(&b).then(x.total_cmp(&y));
        let own = forms.min_by(|a, b| order(key(a), key(b))).map(|own| own.id());
        let own = own.and_then(|own| world.shape_mut(own));
        if let Some(mut own) = own.filter(|own| *own.shape() != capsule) {
            // A form that no shape can have is none to be seen in.
            let _ = own.set_shape(capsule);
        }
    }

    /// What stopped it in the last update, or in a [`CharacterMover::move_by`] since: walls, ceilings, the ground that
    /// it fell on, in the order in which it met them. Of very many the latest are kept.
    pub fn hits(&self) -> &[MoverHit] {
        &self.hits
    }

    /// Where it is to be drawn between its places before (`alpha` 0) and after (1) the last update: see
    /// [`FixedStep::alpha`](crate::FixedStep::alpha). Where it was teleported since, it is there. World, metres.
    pub fn interpolated_position(&self, alpha: f32) -> DVec2 {
        if self.position != self.arrived {
            return self.position;
        }
        let alpha = if alpha.is_finite() { alpha.clamp(0.0, 1.0) } else { 1.0 };
        self.previous.lerp(self.position, alpha.into())
    }

    /// Makes the next update leave the ground with this velocity, metres a second: knockback, a wall jump, a spring
    /// board. Upward it goes as a jump (without that it lands at once); sideways the speed stays, besides what is asked for, until it lands or meets a
    /// wall.
    pub fn launch(&mut self, velocity: impl Into<Vec2>) {
        self.launched = Some(velocity.into());
    }

    /// Moves it by `motion` (metres) along what is in its way, without gravity, steps or pushing, and gives the motion
    /// that came of it: for rules of your own, such as ladders and dashes. What it came to stand on is its ground then,
    /// else it is in the air. It is at rest afterwards: nothing is left of a fall before, nor of a platform's speed. Set
    /// [`CharacterMover::velocity`] to go on falling with it. Nothing happens where a number is not finite.
    pub fn move_by(&mut self, world: &World, motion: impl Into<Vec2>) -> Vec2 {
        let (motion, start) = (motion.into(), self.position);
        if !motion.is_finite() || !self.is_sound() {
            return Vec2::ZERO;
        }
        self.hits.drain(..self.hits.len().saturating_sub(MOST_HITS));
        let (frame, noted) = (Frame::of(world), self.hits.len());
        (self.previous, self.ground, self.drift) = (start, None, 0.0);
        (self.velocity, self.told) = (Vec2::ZERO, Vec2::ZERO);
        self.slide(world, frame, motion, None);
        for hit in self.hits.split_off(noted) {
            if self.is_walkable(hit.normal, frame.up) {
                self.stand_on(world, &hit);
            }
            self.hits.push(hit);
        }
        self.arrived = self.position;
        self.position.relative_to(start)
    }

    /// Is it free of everything that it collides with? One-way platforms do not count, nor chains seen from behind.
    pub fn fits(&self, world: &World) -> bool {
        self.has_room(world, self)
    }

    /// The same, with chains as `seen` sees them: the middle of who gets up may be beyond a low one.
    fn has_room(&self, world: &World, seen: &Self) -> bool {
        let (frame, pose) = (Frame::of(world), Pose::new(self.position, Rot::IDENTITY));
        let capsule = self.capsule(frame.up, 0.0);
        self.obstacles(world, capsule.world_aabb(pose)).into_iter().all(|obstacle| {
            let start = pose.relative_to(obstacle.pose());
            let apart = || distance(obstacle.shape(), &capsule, start).separation >= 0.0;
            !seen.is_solid(frame, &obstacle, obstacle.pose(), Vec2::ZERO) || apart()
        })
    }

    /// Takes another height and radius (metres), with its foot where it is: to duck, and to get up again. Nothing
    /// happens, and it says so by `false`, where there is no room, or a number makes no sense.
    pub fn resize(&mut self, world: &World, height: f32, radius: f32) -> bool {
        let rise = Frame::of(world).up * (0.5 * (height - self.height));
        let mut grown = Self { height, radius, ..self.clone() };
        for place in [&mut grown.position, &mut grown.previous, &mut grown.arrived] {
            *place += rise;
        }
        let is_capsule = height.is_finite() && radius > 0.0 && height >= ROUND * radius;
        let sound = is_capsule && grown.capsule(Vec2::Y, 0.0).validate().is_ok();
        if sound && grown.has_room(world, self) {
            *self = grown;
            return true;
        }
        false
    }
}
