//! A character: a capsule that walks through the world by rules, not by forces.
//!
//! Each update it rides on what it stands on, is pushed out of what has moved into it, then walks or
//! falls. On the ground its horizontal speed is what was asked for, uphill and downhill; heights follow the
//! ground. It keeps a *skin* of a centimetre to everything, so seams between shapes do not exist for it.
//! In the air it follows the exact parabola, so that where it lands does not depend on the step length.
//!
//! The method is cast and slide (Fauerby, *Improved Collision Detection and Response*, 2003), with
//! steps climbed by casts up, forward and down.

use crate::codec::described;
use crate::geometry::{MIN_EXTENT, distance, shape_cast};
use crate::math::sin_cos;
use crate::{
    Aabb, Body, BodyId, BodyKind, DVec2, Filter, Pose, QueryFilter, Rot, Shape, ShapeId, ShapeRef,
    Vec2, World,
};

mod own;
mod push;
mod swept;

use push::Push;

/// Overlaps that walls keep it from getting out of are to fall by this part of themselves, 1/s.
const PUSH_RATE: f32 = 10.0;
/// Most casts of one movement.
const MAX_CASTS: u32 = 6;
/// Motion along a surface counts as parting from it down to this sine of an angle.
const PARALLEL: f32 = 1.0e-4;
/// What it would touch only with the outer part of its skin does not stop it; this part is left.
const THIN_SKIN: f32 = 0.125;
/// An edge whose normal is at least this much upward may have floor behind it.
const LEAST_EDGE: f32 = 0.05;
/// A chain that it is in by up to this part of its radius holds it.
const HELD: f32 = 0.25;
/// What it stands on leaves it behind where it sinks faster by its snap distance in this time, seconds.
const SNAP_TIME: f32 = 1.0 / 60.0;
/// So many hits of movements without an update are kept.
const MOST_HITS: usize = 64;
/// No slope is steeper, radians: what is upright is a wall.
const STEEPEST: f32 = 1.5;

described! {
    /// What a character is asked to do in an update.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct MoverInput {
        /// Horizontal speed, metres a second; positive to the right of up.
        pub walk: f32 = 0.0,
        /// Speed of a jump off the ground, metres a second; 0 is none. Nothing happens in the air.
        pub jump: f32 = 0.0,
        /// Falls through the one-way platforms that it stands on; one update is enough.
        pub drop: bool = false,
    }
}

described! {
    /// What a character stands on.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct MoverGround {
        /// The body.
        pub body: BodyId,
        /// The shape.
        pub shape: ShapeId,
        /// Unit normal, world.
        pub normal: Vec2,
        /// The place under the foot: world, metres.
        pub point: DVec2,
        /// Where it holds on: there, or at the centre of a ball.
        hold: DVec2,
        /// The same place in the body's frame.
        local: Vec2,
        /// Velocity of the body there (of a ball its centre's), metres a second.
        pub velocity: Vec2,
    }
}

described! {
    /// What stopped a character on its way.
    #[derive(Clone, Copy, PartialEq, Debug)]
    pub struct MoverHit {
        /// The body.
        pub body: BodyId,
        /// The shape.
        pub shape: ShapeId,
        /// Where, on its surface: world, metres.
        pub point: DVec2,
        /// Unit normal out of it, world.
        pub normal: Vec2,
    }
}

described! {
    /// A capsule that walks, climbs slopes and steps, jumps, rides on platforms and pushes things.
    ///
    /// A plain value beside the world: clone it with the world, or throw it away. It is not a body, so others
    /// do not collide with it; it gets out of their way. Call [`CharacterMover::update`] after each step. What is to
    /// notice it, such as pickups and doors, meets its [`CharacterMover::body`].
    ///
    /// ```
    /// use tiny_physics::{CharacterMover, MoverInput, RigidBody, Shape, Vec2, World};
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new(Vec2::new(0.0, -10.0));
    /// world.add_body(RigidBody::fixed().shape(Shape::rect(20.0, 1.0)?))?;
    /// let mut hero = CharacterMover::new(Vec2::new(0.0, 2.0), 1.8, 0.3);
    /// for _ in 0..120 {
    ///     world.step(1.0 / 60.0);
    ///     hero.update(&mut world, MoverInput { walk: 3.0, ..MoverInput::default() }, 1.0 / 60.0);
    /// }
    /// assert!(hero.ground().is_some() && (hero.position.x - 6.0).abs() < 0.01);
    /// # Ok(())
    /// # }
    /// ```
    #[derive(Clone, Debug, PartialEq)]
    pub struct CharacterMover {
        /// The middle of the capsule: world, metres. Set it to teleport.
        pub position: DVec2,
        /// Velocity in the air, metres a second; on the ground how fast it went in the last update: not at all before a wall.
        pub velocity: Vec2,
        /// Height of the whole capsule, metres.
        pub height: f32,
        /// Radius, metres.
        pub radius: f32,
        /// Steepest slope that it walks on, radians from level; at most 1.5.
        pub max_slope: f32,
        /// Highest step that it climbs, metres.
        pub step_height: f32,
        /// Greatest drop over which it stays on the ground at a standstill, metres.
        pub snap_distance: f32,
        /// Greatest force with which it pushes dynamic bodies, newtons.
        pub push_force: f32,
        /// Mass with which it weighs on what it stands on, kilograms.
        pub mass: f32,
        /// Factor on the world's gravity.
        pub gravity_scale: f32,
        /// Gap that it keeps to everything, metres.
        pub skin: f32,
        /// What it collides with.
        pub filter: Filter,
        /// A body of its own, which it does not collide with and takes along: see [`CharacterMover::describe_body`].
        pub body: Option<BodyId> = default,
        ground: Option<MoverGround>,
        /// Where it was before the last update.
        previous: DVec2 = default,
        /// And after it, or after it moved by itself since: elsewhere it was teleported.
        arrived: DVec2 = default,
        /// What stopped it in the last update.
        hits: Vec<MoverHit> = default,
        /// The velocity with which the next update leaves the ground.
        launched: Option<Vec2> = default,
        /// Horizontal speed taken along from a platform, until it lands.
        drift: f32,
        /// Ignores the one-way platform that it stands on, until it has come through.
        dropping: bool,
        /// The velocity that the last update left; where `velocity` is another, the user has set that since.
        told: Vec2 = default,
        /// What it pushed in the last update.
        pushed: Option<Push>,
    }
}

/// The first obstacle on a way.
#[derive(Clone, Copy, Debug)]
struct Obstacle {
    fraction: f32,
    /// Out of the obstacle.
    normal: Vec2,
    point: DVec2,
    shape: ShapeId,
    body: BodyId,
}

/// Numbers of one update.
#[derive(Clone, Copy)]
struct Frame {
    up: Vec2,
    right: Vec2,
    gravity: Vec2,
    dt: f32,
    /// The push of the update before.
    pushed: Option<Push>,
}

impl Frame {
    /// Of a movement that takes no time.
    fn of(world: &World) -> Self {
        let (down, strength) = world.gravity.direction_and_length();
        let up = if strength > 0.0 { -down } else { Vec2::Y };
        let right = Vec2::new(up.y, 0.0 - up.x);
        Self { up, right, gravity: Vec2::ZERO, dt: 0.0, pushed: None }
    }
}

impl CharacterMover {
    /// A character of a height and radius (metres) with its middle at a place.
    pub fn new(position: impl Into<DVec2>, height: f32, radius: f32) -> Self {
        let position = position.into();
        Self {
            position,
            velocity: Vec2::ZERO,
            height,
            radius,
            max_slope: 0.9,
            step_height: 0.35,
            snap_distance: 0.1,
            push_force: 500.0,
            mass: 70.0,
            gravity_scale: 1.0,
            skin: 0.01,
            filter: Filter::default(),
            body: None,
            ground: None,
            previous: position,
            arrived: position,
            hits: Vec::new(),
            launched: None,
            drift: 0.0,
            dropping: false,
            told: Vec2::ZERO,
            pushed: None,
        }
    }

    /// What it stands on; `None` in the air.
    pub fn ground(&self) -> Option<&MoverGround> {
        self.ground.as_ref()
    }

    /// Moves it on by `dt` seconds; call it after [`World::step`] with the same `dt`. Nothing happens where a
    /// number is not finite or `dt` not above 0.
    pub fn update(&mut self, world: &mut World, input: MoverInput, dt: f32) {
        let gravity = world.gravity * self.gravity_scale;
        let finite = [dt, input.walk, input.jump].iter().all(|number| number.is_finite());
        if !finite || dt <= 0.0 || !gravity.is_finite() || !self.is_sound() {
            return;
        }
        let frame = Frame { gravity, dt, pushed: self.pushed.take(), ..Frame::of(world) };
        let Frame { up, right, .. } = frame;
        self.previous = self.position;
        self.hits.clear();
        let before = self.ground;
        self.dropping = input.drop || self.dropping && self.is_at_one_way(world, frame);

        self.ride(world, frame);
        self.give_way(world, frame);
        self.push_out(world, frame);
        let mut carried = Vec2::ZERO;
        if let Some(velocity) = self.launched.take().filter(|velocity| velocity.is_finite()) {
            (self.velocity, self.drift) = (velocity, velocity.dot(right));
            (self.ground, self.told) = (None, velocity);
        }
        if self.ground.is_none() && self.velocity != self.told {
            // Set since: by so much more, or to a halt.
            let sideways = self.velocity.dot(right);
            self.drift += sideways - self.told.dot(right);
            self.drift = if sideways == 0.0 { 0.0 } else { self.drift };
        }
        let jump = if input.jump > 0.0 { input.jump } else { 0.0 };
        if self.ground.is_some() && (jump > 0.0 || input.drop) {
            // It has gone along with the platform in this step already.
            carried = self.ground_velocity(world);
            self.drift = carried.dot(right);
            self.velocity = up * (jump + carried.dot(up));
            self.ground = None;
        }
        if self.ground.is_some() {
            self.walk(world, frame, input.walk, dt);
            self.push_ahead(world, frame, input.walk);
        } else {
            self.fall(world, frame, input.walk, carried * -dt);
        }
        (self.arrived, self.told) = (self.position, self.velocity);
        self.weigh(world, frame, before);
        self.lead_body(world);
    }

    /// Are its own numbers such that it can move?
    fn is_sound(&self) -> bool {
        let size = [self.height, self.radius, self.skin];
        let limits = [self.max_slope, self.step_height, self.snap_distance, self.mass];
        size.iter().chain(&limits).all(|number| number.is_finite())
            && self.position.is_finite()
            && self.velocity.is_finite()
            && !self.push_force.is_nan()
            && self.radius >= MIN_EXTENT
    }

    /// Goes along with what it stands on.
    fn ride(&mut self, world: &mut World, frame: Frame) {
        let Some(ground) = self.ground else { return };
        let is_here = self.position.relative_to(ground.point).length() <= self.height;
        // As a lift that begins anew below is: further than it goes by itself.
        let moved = |body: &Body<'_>| body.pose().apply(ground.local).relative_to(ground.hold);
        let speed = |body: &Body<'_>| body.velocity_at(hold(world, ground.shape, ground.point));
        let leaps = |body: &Body<'_>| (moved(body) - speed(body) * frame.dt).length() > self.height;
        let Some(body) = world.body(ground.body).filter(|body| is_here && !leaps(body)) else {
            // That is gone, or one of them has been taken elsewhere.
            (self.velocity, self.drift) = (Vec2::ZERO, 0.0);
            (self.ground, self.told) = (None, Vec2::ZERO);
            return;
        };
        let moves = body.kind() != BodyKind::Static;
        let mut carry = self.belt(world) * frame.dt;
        if moves {
            carry += moved(&body);
            let sinks = (ground.velocity - speed(&body)).dot(frame.up);
            if sinks > self.snap_distance / SNAP_TIME + frame.gravity.length() * frame.dt {
                // Faster than it can fall.
                self.leave(frame, ground.velocity);
                return;
            }
        }
        self.slide(world, frame, carry, moves.then_some(ground.body));
    }

    /// Goes on in the air with the velocity of what it stood on.
    fn leave(&mut self, frame: Frame, velocity: Vec2) {
        (self.velocity, self.drift) = (velocity, velocity.dot(frame.right));
        (self.ground, self.told) = (None, velocity);
    }

    /// How fast the surface that it stands on runs, seen from its body.
    fn belt(&self, world: &World) -> Vec2 {
        let runs = |ground: MoverGround| {
            let speed = world.shape(ground.shape)?.material().tangent_speed;
            Some(Vec2::new(ground.normal.y, 0.0 - ground.normal.x) * speed)
        };
        self.ground.and_then(runs).unwrap_or(Vec2::ZERO)
    }

    /// Velocity of the ground under the foot.
    fn ground_velocity(&self, world: &World) -> Vec2 {
        let velocity = |ground: MoverGround| {
            let body = world.body(ground.body)?;
            let hold = || hold(world, ground.shape, ground.point);
            (body.kind() != BodyKind::Static).then(|| body.velocity_at(hold()))
        };
        self.ground.and_then(velocity).unwrap_or(Vec2::ZERO) + self.belt(world)
    }

    /// Moves by `motion`, along obstacles where there are any. What it stands on may be left out.
    fn slide(&mut self, world: &World, frame: Frame, motion: Vec2, without: Option<BodyId>) {
        let mut rest = motion;
        let mut planes = [Vec2::ZERO; MAX_CASTS as usize];
        for cast in 0..MAX_CASTS as usize {
            let Some(hit) = self.cast(world, frame, rest, without) else {
                self.position += rest;
                return;
            };
            self.position += rest * hit.fraction;
            self.note(&hit);
            rest *= 1.0 - hit.fraction;
            planes[cast] = hit.normal;
            rest -= hit.normal * hit.normal.dot(rest);
            if planes[..cast].iter().any(|plane| plane.dot(rest) < -PARALLEL * rest.length()) {
                return;
            }
        }
    }

    /// Walks for a time on the ground, then looks for the ground again.
    fn walk(&mut self, world: &mut World, frame: Frame, speed: f32, time: f32) {
        let Frame { up, right, .. } = frame;
        let (mut way, mut lost) = (speed * time, 0.0);
        let drop = way.abs() * self.steepest();
        for _ in 0..MAX_CASTS {
            let Some(ground) = self.ground else { break };
            if way == 0.0 {
                break;
            }
            let normal = self.floor(ground.normal, up);
            let motion = along(normal, right, way);
            let Some(hit) = self.cast(world, frame, motion, None) else {
                self.position += motion;
                break;
            };
            self.position += motion * hit.fraction;
            way *= 1.0 - hit.fraction;
            if self.is_walkable(hit.normal, up) {
                self.stand(world, &hit);
            } else {
                if !self.step_up(world, frame, way) {
                    self.note(&hit);
                    lost = way / time;
                }
                break;
            }
        }
        self.velocity = right * (speed - lost);
        self.find_ground(world, frame, drop);
    }

    /// Climbs what stops it, if that is a step. A way shorter than its skin may not get it onto the edge; on a longer one
    /// the next step may be in the way.
    fn step_up(&mut self, world: &World, frame: Frame, way: f32) -> bool {
        let mut length = way.abs();
        for _ in 0..MAX_CASTS {
            let Err(free) = self.step_on(world, frame, length.copysign(way)) else { return true };
            if length == self.skin || free < self.skin && length > self.skin {
                return false;
            }
            length = if free > 2.0 * self.skin { 0.5 * free } else { self.skin };
        }
        false
    }

    /// Up, forward by `way`, down again; or how far its way was free.
    fn step_on(&mut self, world: &World, frame: Frame, way: f32) -> Result<(), f32> {
        let start = self.position;
        let foot = start - frame.up * (0.5 * self.height);
        let rise = frame.up * self.step_height;
        let free = self.cast(world, frame, rise, None).map_or(1.0, |hit| hit.fraction);
        self.position += rise * free;
        let forward = frame.right * way;
        let ahead = self.cast(world, frame, forward, None).map(|hit| hit.fraction);
        if ahead.is_none() {
            self.position += forward;
            let down = rise * -free;
            if let Some(hit) = self.cast(world, frame, down, None)
                && hit.fraction < 1.0
                && hit.point.relative_to(foot).dot(frame.up) <= self.step_height + self.skin
                && self.holds(world, frame, &hit)
            {
                self.position += down * hit.fraction;
                return Ok(());
            }
        }
        self.position = start;
        Err(way.abs() * ahead.unwrap_or(1.0))
    }

    /// Finds the ground under it and goes down to it, or loses it.
    fn find_ground(&mut self, world: &World, frame: Frame, drop: f32) {
        let down = frame.up * -(self.snap_distance + self.skin + drop);
        match self.cast(world, frame, down, None) {
            Some(hit) if self.holds(world, frame, &hit) => {
                self.position += down * hit.fraction;
                self.stand(world, &hit);
            }
            _ => {
                let (platform, walked) = (self.ground_velocity(world), self.velocity);
                self.leave(frame, platform);
                self.velocity += walked;
            }
        }
    }

    /// Falls along the parabola, with a motion on top; walks on for the rest of the time where it lands.
    fn fall(&mut self, world: &mut World, frame: Frame, speed: f32, extra: Vec2) {
        let Frame { up, right, gravity, dt: time, .. } = frame;
        let vertical = up * self.velocity.dot(up) + right * (speed + self.drift);
        let mut velocity = vertical + gravity * time;
        let mut rest = vertical * time + gravity * (0.5 * time * time) + extra;
        let (mut left, mut walk) = (time, speed);
        for _ in 0..MAX_CASTS {
            let Some(hit) = self.cast(world, frame, rest, None) else {
                self.position += rest;
                break;
            };
            self.position += rest * hit.fraction;
            self.note(&hit);
            left *= 1.0 - hit.fraction;
            rest *= 1.0 - hit.fraction;
            if velocity.dot(hit.normal) < 0.0
                && rest.dot(up) <= 0.0
                && self.holds(world, frame, &hit)
            {
                self.land(world, frame, &hit, speed, left);
                return;
            }
            // A slope is a wall to who walks against it, and carries nobody up.
            let steep = hit.normal.dot(up) > 0.0;
            if steep && walk * right.dot(hit.normal) < 0.0 {
                rest -= right * (walk * left);
                velocity -= right * walk;
                walk = 0.0;
            }
            rest -= hit.normal * hit.normal.dot(rest);
            let into = hit.normal.dot(velocity);
            if into < 0.0 {
                velocity -= hit.normal * into;
            }
            let asked = (right * speed).dot(-hit.normal);
            let closing = if -into > asked { -into } else { asked };
            if steep {
                // It slides on, faster and faster.
                self.drift = velocity.dot(right) - walk;
            } else if self.drift * right.dot(hit.normal) < -PARALLEL {
                self.drift = 0.0;
            }
            self.push(world, frame, &hit, closing, 1.0);
        }
        self.velocity = velocity;
    }

    /// Stands on what it has hit, goes along with it and walks on for the time that is left.
    fn land(&mut self, world: &mut World, frame: Frame, hit: &Obstacle, speed: f32, left: f32) {
        self.stand(world, hit);
        self.drift = 0.0;
        // It has met it where the step has taken it: only sideways it goes along.
        let carry = self.ground_velocity(world) * left;
        let carry = carry - hit.normal * hit.normal.dot(carry);
        let moves = world.body(hit.body).is_some_and(|body| body.kind() != BodyKind::Static);
        self.slide(world, frame, carry, moves.then_some(hit.body));
        self.walk(world, frame, speed, left);
    }

    fn stand(&mut self, world: &World, hit: &Obstacle) {
        let Obstacle { normal, point, shape, body, .. } = *hit;
        self.stand_on(world, &MoverHit { body, shape, point, normal });
    }

    fn stand_on(&mut self, world: &World, hit: &MoverHit) {
        let MoverHit { body, shape, point, normal } = *hit;
        let hold = hold(world, shape, point);
        let (local, velocity) = world.body(body).map_or((Vec2::ZERO, Vec2::ZERO), |body| {
            (body.pose().unapply(hold), body.velocity_at(hold))
        });
        self.ground = Some(MoverGround { body, shape, normal, point, hold, local, velocity });
    }

    /// Can it stand on this: a slope that is not too steep, or an edge with such a floor beside it?
    fn holds(&self, world: &World, frame: Frame, hit: &Obstacle) -> bool {
        let Frame { up, right, .. } = frame;
        if self.is_walkable(hit.normal, up) {
            return true;
        }
        if hit.normal.dot(up) < LEAST_EDGE {
            return false;
        }
        // Wedged: what it would slide down into leans the other way.
        let lean = hit.normal.dot(right);
        let downhill = along(hit.normal, right, self.skin.copysign(lean));
        let other = self.cast(world, frame, downhill, None);
        if other.is_some_and(|other| other.normal.dot(right) * lean < 0.0) {
            return true;
        }
        // A ball has no edges.
        if world.shape(hit.shape).is_some_and(|shape| rolls(world, &shape)) {
            return false;
        }
        let (beside, above, below) = (0.1 * self.radius, 0.3 * self.radius, 0.1 * self.radius);
        let filter = self.query();
        [beside, -beside].into_iter().any(|side| {
            let origin = hit.point + (right * side + up * above);
            let floor = world.ray_cast(origin, up * -(above + below), &filter);
            floor.is_some_and(|floor| self.is_walkable(floor.normal, up))
        })
    }

    /// The steepest slope, which is no wall.
    fn slope(&self) -> f32 {
        self.max_slope.clamp(0.0, STEEPEST)
    }

    fn is_walkable(&self, normal: Vec2, up: Vec2) -> bool {
        normal.dot(up) >= sin_cos(self.slope()).1 - 1.0e-3
    }

    /// Tangent of the steepest slope.
    fn steepest(&self) -> f32 {
        let (sine, cosine) = sin_cos(self.slope());
        if cosine > 0.1 { sine / cosine } else { 10.0 }
    }

    /// The normal along which it walks: up where it stands on an edge.
    fn floor(&self, normal: Vec2, up: Vec2) -> Vec2 {
        if self.is_walkable(normal, up) { normal } else { up }
    }

    /// Gets out of what overlaps it or comes closer than its skin; where it cannot, what is loose has to go.
    fn push_out(&mut self, world: &mut World, frame: Frame) {
        let capsule = self.capsule(frame.up, 0.0);
        let mut last = Vec2::ZERO;
        for _ in 0..MAX_CASTS {
            let pose = Pose::new(self.position, Rot::IDENTITY);
            let bounds = capsule.world_aabb(pose).grown(self.skin);
            let mut deepest: Option<(f32, Obstacle)> = None;
            for obstacle in self.obstacles(world, bounds) {
                let place = obstacle.pose();
                let gap = distance(obstacle.shape(), &capsule, pose.relative_to(place));
                let normal = place.q.rotate(gap.normal);
                let near = gap.separation < 0.9 * self.skin;
                let solid = self.is_solid(frame, &obstacle, place, -normal);
                if near && solid && deepest.is_none_or(|(least, _)| gap.separation < least) {
                    let (point, shape) = (place.apply(gap.point_a), obstacle.id());
                    let body = obstacle.body();
                    let found = Obstacle { fraction: 0.0, normal, point, shape, body };
                    deepest = Some((gap.separation, found));
                }
            }
            let Some((separation, obstacle)) = deepest else { return };
            let Obstacle { normal, body, .. } = obstacle;
            // Where there is no room for its skin on both sides it goes to the middle.
            let is_tight = separation > 0.0 && normal.dot(last) < -0.9;
            let out = normal * ((self.skin - separation) * if is_tight { 0.5 } else { 1.0 });
            // What moves does not push it into walls.
            if world.body(body).is_some_and(|body| body.kind() != BodyKind::Static) {
                let before = self.position;
                self.slide(world, frame, out, Some(body));
                let left = -separation - self.position.relative_to(before).dot(normal);
                if left > 0.0 {
                    return self.push(world, frame, &obstacle, left * PUSH_RATE, 1.0);
                }
            } else {
                self.position += out;
            }
            if is_tight {
                return;
            }
            last = normal;
        }
    }

    /// Would it stand on a one-way platform, or pass through its surface?
    fn is_at_one_way(&self, world: &World, frame: Frame) -> bool {
        let capsule = self.capsule(frame.up, 0.0);
        let pose = Pose::new(self.position, Rot::IDENTITY);
        let bounds = capsule.world_aabb(pose).grown(self.skin);
        self.obstacles(world, bounds).into_iter().any(|obstacle| {
            obstacle.one_way().is_some_and(|way| {
                let place = obstacle.pose();
                let gap = distance(obstacle.shape(), &capsule, pose.relative_to(place));
                let way = obstacle.local().q.unrotate(way).normalized();
                let body = world.body(obstacle.body());
                let rises = body.map_or(0.0, |body| body.velocity_at(self.position).dot(frame.up));
                let moved = rises.abs() * frame.dt;
                let (least, most) = (-0.5 * self.skin - moved, 1.1 * self.skin + moved);
                (least..=most).contains(&gap.separation) && gap.normal.dot(way) > 0.3
            })
        })
    }

    /// The first obstacle on a way; what it is leaving or goes along with is none, nor what it would only graze with
    /// its skin.
    fn cast(
        &self,
        world: &World,
        frame: Frame,
        motion: Vec2,
        without: Option<BodyId>,
    ) -> Option<Obstacle> {
        let hit = self.cast_with(world, frame, motion, without, self.skin)?;
        if self.is_walkable(hit.normal, frame.up) {
            return Some(hit);
        }
        // With a thin skin it comes closer by what the skin is less, or past it.
        let length = motion.length();
        let thin = THIN_SKIN * self.skin;
        let nearer = (self.skin - thin) / -hit.normal.dot(motion) * length;
        let way = motion * ((length + nearer + self.radius) / length);
        let scale = way.length() / length;
        let past = match self.cast_with(world, frame, way, without, thin) {
            Some(later) => (later.fraction * scale - hit.fraction) * length > 2.0 * nearer,
            None => true,
        };
        if !past {
            return Some(hit);
        }
        self.cast_with(world, frame, motion, without, thin)
    }

    /// The first obstacle on a way for the capsule with a skin.
    fn cast_with(
        &self,
        world: &World,
        frame: Frame,
        motion: Vec2,
        without: Option<BodyId>,
        skin: f32,
    ) -> Option<Obstacle> {
        let length = motion.length();
        if length == 0.0 {
            return None;
        }
        let capsule = self.capsule(frame.up, skin);
        let pose = Pose::new(self.position, Rot::IDENTITY);
        let end = Pose::new(self.position + motion, Rot::IDENTITY);
        let bounds = capsule.world_aabb(pose).union(&capsule.world_aabb(end));
        let mut first: Option<Obstacle> = None;
        for obstacle in self.obstacles(world, bounds) {
            let (place, body) = (obstacle.pose(), obstacle.body());
            if without == Some(body) || !self.is_solid(frame, &obstacle, place, motion) {
                continue;
            }
            let way = place.q.unrotate(motion);
            let start = pose.relative_to(place);
            let Some(hit) = shape_cast(obstacle.shape(), &capsule, start, way) else { continue };
            let normal = place.q.rotate(hit.normal);
            if normal.dot(motion) >= -PARALLEL * length {
                continue;
            }
            if first.is_none_or(|first| hit.fraction < first.fraction) {
                let (point, shape) = (place.apply(hit.point), obstacle.id());
                first = Some(Obstacle { fraction: hit.fraction, normal, point, shape, body });
            }
        }
        first
    }

    /// The capsule around its middle, wider by a margin.
    fn capsule(&self, up: Vec2, margin: f32) -> Shape {
        let half = 0.5 * self.height - self.radius;
        let radius = self.radius + margin;
        if half > MIN_EXTENT {
            Shape::Capsule { a: up * -half, b: up * half, radius }
        } else {
            Shape::Circle { radius }
        }
    }

    /// Shapes whose fat boxes overlap a box and that its filter lets it collide with, in index order.
    fn obstacles<'a>(&self, world: &'a World, bounds: Aabb) -> Vec<ShapeRef<'a>> {
        let near = world.shapes_near(bounds, &self.query());
        near.into_iter().filter_map(|shape| world.shape(shape)).collect()
    }

    /// What it meets.
    fn query(&self) -> QueryFilter<'static> {
        QueryFilter { exclude_body: self.body, ..QueryFilter::from(self.filter) }
    }

    /// Keeps what stopped it, for those who ask.
    fn note(&mut self, hit: &Obstacle) {
        let Obstacle { normal, point, shape, body, .. } = *hit;
        self.hits.push(MoverHit { body, shape, point, normal });
    }

    /// Is a shape solid for something that moves this way? One-way platforms are from above, chains from
    /// outside: who comes through from behind is let out, who is a little in them is held. `place` is where the shape
    /// is, or was.
    fn is_solid(&self, frame: Frame, obstacle: &ShapeRef<'_>, place: Pose, motion: Vec2) -> bool {
        let gap = || {
            let pose = Pose::new(self.position, Rot::IDENTITY).relative_to(place);
            distance(obstacle.shape(), &self.capsule(frame.up, 0.0), pose)
        };
        if let (Some(_), Shape::Segment { a, b }) = (obstacle.link(), *obstacle.shape()) {
            let way = Vec2::new((b - a).y, 0.0 - (b - a).x);
            let comes_out = self.ground.is_none() && place.q.rotate(way).dot(self.velocity) > 0.0;
            let depth = if comes_out { 0.5 * self.skin } else { HELD * self.radius };
            return way.dot(place.unapply(self.position) - a) >= 0.0
                && (motion == Vec2::ZERO || gap().separation >= -depth);
        }
        let Some(way) = obstacle.one_way() else { return true };
        let way = place.q.rotate(obstacle.local().q.unrotate(way));
        if self.dropping || way.dot(motion) >= 0.0 {
            return false;
        }
        let gap = gap();
        gap.separation >= -0.5 * self.skin && place.q.rotate(gap.normal).dot(way.normalized()) > 0.3
    }
}

/// Is it a ball that may roll?
fn rolls(world: &World, shape: &ShapeRef<'_>) -> bool {
    let body = world.body(shape.body());
    matches!(shape.shape(), Shape::Circle { .. })
        && body.is_some_and(|body| body.kind() == BodyKind::Dynamic)
}

/// Where a character that stands at a point holds on to a body: a ball turns under its foot, and takes it along by its centre.
fn hold(world: &World, shape: ShapeId, point: DVec2) -> DVec2 {
    let ball = world.shape(shape).filter(|shape| rolls(world, shape));
    ball.map_or(point, |ball| ball.pose().p)
}

/// The way along a floor that goes so far to the right.
fn along(normal: Vec2, right: Vec2, way: f32) -> Vec2 {
    let along = Vec2::new(normal.y, 0.0 - normal.x);
    along * (way / along.dot(right))
}
