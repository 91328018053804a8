//! Colliders: the shapes of a body, and their surfaces.

use bevy_ecs::prelude::*;
use bevy_math::Vec2;
use bevy_transform::prelude::Transform;
use tiny_physics::{ChainDef, Error, Filter, Polygon, Shape, ShapeDef, TileGrid};

/// Shapes of a body, in the frame of its entity. They belong to the nearest [`RigidBody`](crate::RigidBody) at or above the entity; where
/// there is none, to a static body of their own.
///
/// What is wrong with a shape is told by a [`PhysicsProblem`](crate::PhysicsProblem) that names the entity, once it has been spawned.
///
/// ```
/// use bevy_tiny_physics::prelude::*;
/// let crate_ = Collider::rect(0.5, 0.5);
/// let dumbbell = Collider::circle(0.3).and(Collider::circle(0.3).at(1.0, 0.0));
/// assert_eq!((crate_.shapes().len(), dumbbell.shapes().len()), (1, 2));
/// ```
#[derive(Component, Clone, PartialEq, Debug)]
#[require(Transform)]
pub struct Collider {
    shapes: Vec<ShapeDef>,
    error: Option<Error>,
}

impl Collider {
    fn one(shape: Result<impl Into<ShapeDef>, Error>) -> Self {
        match shape {
            Ok(shape) => Self { shapes: vec![shape.into()], error: None },
            Err(error) => Self { shapes: Vec::new(), error: Some(error) },
        }
    }

    /// Any shapes as the engine describes them: surface, filter, events and all.
    pub fn new(shapes: impl IntoIterator<Item = ShapeDef>) -> Self {
        Self { shapes: shapes.into_iter().collect(), error: None }
    }

    /// A disk; radius in metres.
    pub fn circle(radius: f32) -> Self {
        Self::one(Shape::circle(radius))
    }

    /// A box, by half its width and height in metres.
    pub fn rect(half_width: f32, half_height: f32) -> Self {
        Self::one(Shape::rect(half_width, half_height))
    }

    /// All points within `radius` of a segment, metres.
    pub fn capsule(a: Vec2, b: Vec2, radius: f32) -> Self {
        Self::one(Shape::capsule(engine(a), engine(b), radius))
    }

    /// A line without thickness, for static bodies.
    pub fn segment(a: Vec2, b: Vec2) -> Self {
        Self::one(Shape::segment(engine(a), engine(b)))
    }

    /// The convex hull of up to eight points, metres.
    pub fn hull(points: &[Vec2]) -> Self {
        let points: Vec<_> = points.iter().copied().map(engine).collect();
        Self::one(Shape::hull(&points))
    }

    /// A regular polygon of 3 to 8 corners.
    pub fn regular(corners: usize, radius: f32) -> Self {
        Self::one(Shape::regular(corners, radius))
    }

    /// A box with round corners; `radius` comes on top of the half extents, metres.
    pub fn rounded_rect(half_width: f32, half_height: f32, radius: f32) -> Self {
        Self::one(
            Polygon::rect(half_width, half_height)
                .and_then(|rect| rect.rounded(radius))
                .map(Shape::Polygon),
        )
    }

    /// Ground that is drawn by points, without bumps where its segments meet.
    pub fn chain(chain: &ChainDef) -> Self {
        match chain.shapes() {
            Ok(shapes) => Self { shapes, error: None },
            Err(error) => Self { shapes: Vec::new(), error: Some(error) },
        }
    }

    /// The shapes of another collider, too.
    pub fn and(mut self, other: Self) -> Self {
        self.shapes.extend(other.shapes);
        self.error = self.error.or(other.error);
        self
    }

    /// Moves the shapes in the frame of the entity, metres.
    pub fn at(mut self, x: f32, y: f32) -> Self {
        self.shapes.iter_mut().for_each(|shape| shape.offset += tiny_physics::Vec2::new(x, y));
        self
    }

    /// The shapes as described.
    pub fn shapes(&self) -> &[ShapeDef] {
        &self.shapes
    }

    /// What was wrong with the first bad shape.
    pub fn error(&self) -> Option<&Error> {
        self.error.as_ref()
    }
}

impl From<ShapeDef> for Collider {
    fn from(shape: ShapeDef) -> Self {
        Self::new([shape])
    }
}

impl From<Shape> for Collider {
    fn from(shape: Shape) -> Self {
        Self::new([shape.into()])
    }
}

/// Friction of an entity's shapes, 0 or above.
#[derive(Component, Clone, Copy, PartialEq, Debug)]
pub struct Friction(pub f32);

/// Restitution of an entity's shapes: 0 does not bounce, 1 bounces for ever. Of two that meet the smaller counts.
#[derive(Component, Clone, Copy, PartialEq, Debug)]
pub struct Restitution(pub f32);

/// Density of an entity's shapes, kilograms a square metre.
#[derive(Component, Clone, Copy, PartialEq, Debug)]
pub struct Density(pub f32);

/// Speed of an entity's surface along it, metres a second: a conveyor belt.
#[derive(Component, Clone, Copy, PartialEq, Debug)]
pub struct SurfaceSpeed(pub f32);

/// What an entity's shapes are and what they collide with.
#[derive(Component, Clone, Copy, PartialEq, Debug, Default)]
pub struct CollisionFilter(pub Filter);

/// Makes an entity's shapes sensors: they see what overlaps them, and collide with nothing. See
/// [`SensorEntered`](crate::SensorEntered).
#[derive(Component, Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Sensor;

/// Makes an entity's shapes one-way platforms: solid on the side that this points out of (in the entity's frame), open from the other.
#[derive(Component, Clone, Copy, PartialEq, Debug)]
pub struct OneWay(pub Vec2);

/// Asks for [`CollisionStarted`](crate::CollisionStarted) and [`CollisionEnded`](crate::CollisionEnded) about an entity's shapes.
#[derive(Component, Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct CollisionEvents;

/// Asks for [`Hit`](crate::Hit)s about an entity's shapes: with impulse, for sounds and damage.
#[derive(Component, Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct HitEvents;

/// Ground of tiles, without seams. Its place is that of the grid; the entity's transform plays no part. Setting single cells is cheap. Those that are
/// set through the world stay so until the component says something else of them.
#[derive(Component, Clone, PartialEq, Debug)]
pub struct TileMap(pub TileGrid);

pub(crate) fn engine(v: Vec2) -> tiny_physics::Vec2 {
    tiny_physics::Vec2::new(v.x, v.y)
}
