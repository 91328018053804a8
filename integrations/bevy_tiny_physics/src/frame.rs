//! Places of entities in the plane, through their parents.

use bevy_ecs::prelude::*;
use bevy_math::{Quat, Vec2};
use bevy_transform::prelude::Transform;
use tiny_physics::math::sin_cos;
use tiny_physics::{Error, Polygon, Pose, Rot, Shape};

/// Place, turn and scale in the plane.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Frame {
    pub p: tiny_physics::Vec2,
    pub q: Rot,
    pub scale: Vec2,
}

/// Which parts of a pose something is about.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Parts {
    pub place: bool,
    pub turn: bool,
}

impl Parts {
    pub const ALL: Self = Self { place: true, turn: true };
    pub const NONE: Self = Self { place: false, turn: false };

    /// These of one pose, the others of another.
    pub fn of(self, one: Pose, other: Pose) -> Pose {
        let p = if self.place { one.p } else { other.p };
        Pose::new(p, if self.turn { one.q } else { other.q })
    }
}

impl Frame {
    pub const IDENTITY: Self =
        Self { p: tiny_physics::Vec2::ZERO, q: Rot::IDENTITY, scale: Vec2::ONE };

    pub fn of(transform: &Transform) -> Self {
        let p = tiny_physics::Vec2::new(transform.translation.x, transform.translation.y);
        Self { p, q: turn_about_z(transform.rotation), scale: transform.scale.truncate() }
    }

    /// The place in the frame around this one, of what is at `inner` in this one.
    pub fn compose(&self, inner: &Self) -> Self {
        let scaled = tiny_physics::Vec2::new(self.scale.x * inner.p.x, self.scale.y * inner.p.y);
        Self {
            p: self.p + self.q.rotate(scaled),
            q: self.q.compose(self.turned(inner.q)),
            scale: self.scale * inner.scale,
        }
    }

    /// The place in this frame, of what is at `outer` around it. Scales of 0 count as 1.
    pub fn relative(&self, outer: &Self) -> Self {
        let p = self.q.unrotate(outer.p - self.p);
        let part = |a: f32, scale: f32| if scale == 0.0 { a } else { a / scale };
        let p = tiny_physics::Vec2::new(part(p.x, self.scale.x), part(p.y, self.scale.y));
        let scale = Vec2::new(part(outer.scale.x, self.scale.x), part(outer.scale.y, self.scale.y));
        Self { p, q: self.turned(outer.q.relative_to(self.q)), scale }
    }

    /// Do things in here turn the other way?
    pub fn is_mirrored(&self) -> bool {
        self.scale.x * self.scale.y < 0.0
    }

    fn turned(&self, q: Rot) -> Rot {
        if self.is_mirrored() { q.inverse() } else { q }
    }

    pub fn pose(&self) -> Pose {
        tiny_physics::Transform { p: self.p, q: self.q }.into()
    }

    pub fn of_pose(pose: Pose) -> Self {
        let transform = pose.to_transform();
        Self { p: transform.p, q: transform.q, scale: Vec2::ONE }
    }

    pub fn is_finite(&self) -> bool {
        self.p.is_finite() && self.q.is_finite() && self.scale.is_finite()
    }

    /// Puts a transform here, in so many parts; its depth and scale stay.
    pub fn write(&self, transform: &mut Transform, parts: Parts) {
        if parts.place {
            (transform.translation.x, transform.translation.y) = (self.p.x, self.p.y);
        }
        if parts.turn {
            transform.rotation = self.rotation();
        }
    }

    /// The engine's own sine: the same bits on every platform.
    fn rotation(&self) -> Quat {
        let (s, c) = sin_cos(0.5 * self.q.angle());
        Quat::from_xyzw(0.0, 0.0, s, c)
    }
}

fn turn_about_z(rotation: Quat) -> Rot {
    let (z, w) = (rotation.z, rotation.w);
    Rot { c: w * w - z * z, s: 2.0 * z * w }.normalized()
}

/// Where an entity is: through those above it, from the nearest on. `None` where it has no transform.
pub(crate) fn frame_through<'a>(
    entity: Entity,
    above: impl Iterator<Item = Entity>,
    transform: impl Fn(Entity) -> Option<&'a Transform>,
) -> Option<Frame> {
    let mut frame = Frame::of(transform(entity)?);
    for ancestor in above {
        if let Some(outer) = transform(ancestor) {
            frame = Frame::of(outer).compose(&frame);
        }
    }
    Some(frame)
}

/// A shape in a frame that is scaled.
pub(crate) fn scaled(shape: &Shape, scale: Vec2) -> Result<Shape, Error> {
    if scale == Vec2::ONE {
        return Ok(*shape);
    }
    let by = |v: tiny_physics::Vec2| tiny_physics::Vec2::new(v.x * scale.x, v.y * scale.y);
    let evenly = || match scale.x.abs() == scale.y.abs() {
        true => Ok(scale.x.abs()),
        false => {
            Err(Error::Unsupported { reason: "what is round is scaled differently in x and y" })
        }
    };
    Ok(match shape {
        Shape::Circle { radius } => Shape::circle(radius * evenly()?)?,
        Shape::Capsule { a, b, radius } => Shape::capsule(by(*a), by(*b), radius * evenly()?)?,
        Shape::Segment { a, b } => Shape::segment(by(*a), by(*b))?,
        Shape::Aabb { half_extents } => Shape::aabb_box(by(*half_extents).abs())?,
        Shape::Polygon(polygon) => {
            let corners: Vec<_> = polygon.vertices().iter().copied().map(by).collect();
            let hull = Polygon::hull(&corners)?;
            if polygon.radius() > 0.0 {
                hull.rounded(polygon.radius() * evenly()?)?.into()
            } else {
                hull.into()
            }
        }
    })
}
