//! Questions about where shapes are: rays, moved shapes, overlaps, closest points.
//!
//! Queries see the world as the last step left it, and what was changed since. They change nothing, so any
//! number of threads may ask at once. Answers are the same whatever the state of the search trees: of two
//! hits at one distance, the shape with the smaller index comes first. Origins are in 64 bits; distances
//! from them in 32. Questions with numbers that are not finite find nothing.

mod filter;
mod find;
#[cfg(test)]
mod tests;

pub use filter::QueryFilter;

use super::World;
use super::ids::{BodyId, ShapeId};
use super::shapes::ShapeRef;
use crate::geometry::Shape;
use crate::math::{Aabb, DVec2, Pose, Vec2};
use core::ops::ControlFlow;
use find::{Finder, Way};

/// A ray in the world, for [`World::ray_casts`].
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RayCast {
    /// Start: world, metres.
    pub origin: DVec2,
    /// From the start to the end, metres.
    pub translation: Vec2,
}

impl RayCast {
    /// A ray by its start and the vector to its end.
    pub fn new(origin: impl Into<DVec2>, translation: impl Into<Vec2>) -> Self {
        Self { origin: origin.into(), translation: translation.into() }
    }
}

/// Where a ray enters a shape.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RayCastHit {
    /// What it enters.
    pub shape: ShapeId,
    /// The body of the shape.
    pub body: BodyId,
    /// Where: world, metres.
    pub point: DVec2,
    /// Outward unit normal of the surface there, world.
    pub normal: Vec2,
    /// Part of the translation until the hit, 0 to 1.
    pub fraction: f32,
}

/// Where a moved shape first touches another.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ShapeCastHit {
    /// What it touches.
    pub shape: ShapeId,
    /// The body of that shape.
    pub body: BodyId,
    /// Where, on the surface of the shape that stands still: world, metres.
    pub point: DVec2,
    /// Unit normal out of the shape that stands still, world.
    pub normal: Vec2,
    /// Part of the translation until the hit, 0 to 1; 0 where they overlap at the start.
    pub fraction: f32,
}

/// How far two shapes are apart.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ShapeDistance {
    /// Metres between the surfaces; negative is the depth of an overlap.
    pub separation: f32,
    /// Unit, world, from A to B, along the shortest way.
    pub normal: Vec2,
    /// Closest point of A (the deepest inside B where they overlap): world, metres.
    pub point_a: DVec2,
    /// Closest point of B.
    pub point_b: DVec2,
}

/// The point of a shape that is closest to another point.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClosestPoint {
    /// The shape.
    pub shape: ShapeId,
    /// Its body.
    pub body: BodyId,
    /// The closest point of the shape: world, metres. The point asked for itself where that is inside.
    pub point: DVec2,
    /// Metres; 0 where the point asked for is inside.
    pub distance: f32,
}

/// Rays that one member of the team casts at a time.
const CHUNK: usize = 16;

impl World {
    /// The first shape that a ray enters on its way from `origin` along `translation` (metres). Shapes
    /// that hold the origin are not entered, so they are not hit; [`QueryFilter::solid`] hits them there.
    ///
    /// ```
    /// use tiny_physics::{QueryFilter, RigidBody, Shape, Vec2, World};
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new(Vec2::ZERO);
    /// world.add_body(RigidBody::fixed().shape(Shape::rect(1.0, 1.0)?))?;
    /// let (from, way) = (Vec2::new(-5.0, 0.0), Vec2::new(8.0, 0.0));
    /// let hit = world.ray_cast(from, way, &QueryFilter::new()).unwrap();
    /// assert_eq!((hit.fraction, hit.normal), (0.5, -Vec2::X));
    /// # Ok(())
    /// # }
    /// ```
    pub fn ray_cast(
        &self,
        origin: impl Into<DVec2>,
        translation: impl Into<Vec2>,
        filter: &QueryFilter<'_>,
    ) -> Option<RayCastHit> {
        Finder { world: self, filter }.first_on_ray(origin.into(), translation.into())
    }

    /// All shapes that a ray enters, nearest first: see [`World::ray_cast`].
    pub fn ray_cast_all(
        &self,
        origin: impl Into<DVec2>,
        translation: impl Into<Vec2>,
        filter: &QueryFilter<'_>,
    ) -> Vec<RayCastHit> {
        Finder { world: self, filter }.all_on_ray(origin.into(), translation.into())
    }

    /// Calls `visit` with every shape that a ray enters, in no order to rely on, until it breaks off. Unlike
    /// [`World::ray_cast_all`] it makes no list.
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// use tiny_physics::prelude::*;
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new((0.0, 0.0));
    /// for x in 1..9 {
    ///     world.add_body(RigidBody::fixed().position((f64::from(x), 0.0)).shape(Shape::circle(0.1)?))?;
    /// }
    /// let mut seen = 0;
    /// world.visit_ray((0.0, 0.0), (4.5, 0.0), &QueryFilter::new(), |_hit| {
    ///     seen += 1;
    ///     ControlFlow::Continue(())
    /// });
    /// assert_eq!(seen, 4);
    /// # Ok(())
    /// # }
    /// ```
    pub fn visit_ray(
        &self,
        origin: impl Into<DVec2>,
        translation: impl Into<Vec2>,
        filter: &QueryFilter<'_>,
        visit: impl FnMut(RayCastHit) -> ControlFlow<()>,
    ) {
        Finder { world: self, filter }.visit_ray(origin.into(), translation.into(), visit);
    }

    /// Does a ray enter any shape? Cheaper than [`World::ray_cast`]: for lines of sight.
    pub fn ray_cast_any(
        &self,
        origin: impl Into<DVec2>,
        translation: impl Into<Vec2>,
        filter: &QueryFilter<'_>,
    ) -> bool {
        Finder { world: self, filter }.any_on_ray(origin.into(), translation.into())
    }

    /// Many ray casts at once, on all threads of the world. `hits` gets the answers in the order of the
    /// rays (its old contents are dropped), each exactly that of [`World::ray_cast`].
    pub fn ray_casts(
        &self,
        rays: &[RayCast],
        filter: &QueryFilter<'_>,
        hits: &mut Vec<Option<RayCastHit>>,
    ) {
        hits.clear();
        hits.resize(rays.len(), None);
        self.pool.scope(|team| {
            team.for_each_chunk_mut(hits, CHUNK, |chunk, hits| {
                for (hit, ray) in hits.iter_mut().zip(&rays[chunk * CHUNK..]) {
                    *hit = self.ray_cast(ray.origin, ray.translation, filter);
                }
            });
        });
    }

    /// The first shape that a shape touches when it is moved from `pose` along `translation` (metres)
    /// without turning. Shapes that overlap it at the start are hits at fraction 0.
    ///
    /// ```
    /// use tiny_physics::{Pose, QueryFilter, RigidBody, Shape, Transform, Vec2, World};
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new(Vec2::ZERO);
    /// world.add_body(RigidBody::fixed().shape(Shape::rect(10.0, 1.0)?))?;
    /// let foot = Shape::circle(0.5)?;
    /// let start = Transform::from_angle(Vec2::new(0.0, 3.0), 0.0);
    /// let hit = world.cast_shape(&foot, start, Vec2::new(0.0, -3.0), &QueryFilter::new()).unwrap();
    /// assert!((hit.fraction - 0.5).abs() < 1e-4 && hit.normal == Vec2::Y);
    /// # Ok(())
    /// # }
    /// ```
    pub fn cast_shape(
        &self,
        shape: &Shape,
        pose: impl Into<Pose>,
        translation: impl Into<Vec2>,
        filter: &QueryFilter<'_>,
    ) -> Option<ShapeCastHit> {
        self.cast_shape_turning(shape, pose, translation, 0.0, filter)
    }

    /// All shapes that a moved shape touches, nearest first: see [`World::cast_shape`].
    pub fn cast_shape_all(
        &self,
        shape: &Shape,
        pose: impl Into<Pose>,
        translation: impl Into<Vec2>,
        filter: &QueryFilter<'_>,
    ) -> Vec<ShapeCastHit> {
        let way = Way { shape, pose: pose.into(), translation: translation.into(), turn: 0.0 };
        Finder { world: self, filter }.all_on_way(way)
    }

    /// The first shape that a shape touches when it is moved along `translation` (metres) and turned evenly by `turn`
    /// (radians, about the origin of its frame) on the way: a sword, a door, a car that swerves.
    ///
    /// ```
    /// use tiny_physics::prelude::*;
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new((0.0, 0.0));
    /// world.add_body(RigidBody::fixed().position((0.0, 1.0)).shape(Shape::circle(0.1)?))?;
    /// let sword = Shape::segment(Vec2::ZERO, Vec2::new(2.0, 0.0))?;
    /// let quarter = std::f32::consts::FRAC_PI_2;
    /// let hit = world.cast_shape_turning(&sword, Transform::IDENTITY, (0.0, 0.0), quarter, &QueryFilter::new());
    /// let hit = hit.unwrap();
    /// assert!((hit.fraction * quarter - 1.47).abs() < 0.01, "the edge of the post, at 84 degrees");
    /// # Ok(())
    /// # }
    /// ```
    pub fn cast_shape_turning(
        &self,
        shape: &Shape,
        pose: impl Into<Pose>,
        translation: impl Into<Vec2>,
        turn: f32,
        filter: &QueryFilter<'_>,
    ) -> Option<ShapeCastHit> {
        let way = Way { shape, pose: pose.into(), translation: translation.into(), turn };
        Finder { world: self, filter }.first_on_way(way)
    }

    /// How far two shapes are apart, and where. `None` where one of them has been removed.
    pub fn shape_distance(&self, a: ShapeId, b: ShapeId) -> Option<ShapeDistance> {
        let (a, b) = (self.shape_index(a).ok()?, self.shape_index(b).ok()?);
        Some(Finder { world: self, filter: &QueryFilter::new() }.between(a, b))
    }

    /// The shapes that overlap a shape, in index order. Touching counts.
    ///
    /// ```
    /// use tiny_physics::{QueryFilter, RigidBody, Shape, Transform, Vec2, World};
    /// # fn main() -> Result<(), tiny_physics::Error> {
    /// let mut world = World::new(Vec2::ZERO);
    /// let body = world.add_body(RigidBody::fixed().shape(Shape::rect(1.0, 1.0)?))?;
    /// let area = Shape::circle(0.5)?;
    /// let at = |x| Transform::from_angle(Vec2::new(x, 0.0), 0.0);
    /// let found = world.overlap_shape(&area, at(1.4), &QueryFilter::new());
    /// assert_eq!(world.shape(found[0]).unwrap().body(), body);
    /// assert!(world.overlap_shape(&area, at(1.6), &QueryFilter::new()).is_empty());
    /// # Ok(())
    /// # }
    /// ```
    pub fn overlap_shape(
        &self,
        shape: &Shape,
        pose: impl Into<Pose>,
        filter: &QueryFilter<'_>,
    ) -> Vec<ShapeId> {
        Finder { world: self, filter }.overlapping(shape, pose.into())
    }

    /// Calls `visit` with every shape that overlaps a shape, in no order to rely on, until it breaks off. Unlike
    /// [`World::overlap_shape`] it makes no list.
    pub fn visit_overlaps(
        &self,
        shape: &Shape,
        pose: impl Into<Pose>,
        filter: &QueryFilter<'_>,
        mut visit: impl FnMut(ShapeRef<'_>) -> ControlFlow<()>,
    ) {
        let finder = Finder { world: self, filter };
        finder.visit_overlapping(shape, pose.into(), |index| visit(ShapeRef::new(self, index)));
    }

    /// The bodies that overlap a shape with any of theirs, each once, in index order.
    pub fn overlap_bodies(
        &self,
        shape: &Shape,
        pose: impl Into<Pose>,
        filter: &QueryFilter<'_>,
    ) -> Vec<BodyId> {
        let mut bodies = Vec::new();
        self.visit_overlaps(shape, pose, filter, |shape| {
            bodies.push(shape.body());
            ControlFlow::Continue(())
        });
        bodies.sort_unstable();
        bodies.dedup();
        bodies
    }

    /// The shapes that overlap a box (world, metres), in index order. The shapes themselves count, not
    /// their boxes.
    pub fn overlap_aabb(&self, aabb: Aabb, filter: &QueryFilter<'_>) -> Vec<ShapeId> {
        Finder { world: self, filter }.overlapping_box(aabb)
    }

    /// The shapes whose boxes in the broad phase ([`ShapeRef::fat_aabb`](crate::ShapeRef::fat_aabb)) overlap a box (world,
    /// metres), in index order: all that can be there, found at less cost than what is.
    pub fn shapes_near(&self, aabb: Aabb, filter: &QueryFilter<'_>) -> Vec<ShapeId> {
        Finder { world: self, filter }.near(aabb)
    }

    /// All shapes that a filter shows, in index order.
    pub fn shapes_seen<'a>(
        &'a self,
        filter: &'a QueryFilter<'a>,
    ) -> impl Iterator<Item = ShapeId> + 'a {
        let finder = Finder { world: self, filter };
        let there = |shape: &ShapeId| {
            self.state.shapes.records[shape.index as usize].proxy != crate::dynamics::NULL
        };
        self.shape_ids().filter(move |shape| there(shape) && finder.sees(shape.index))
    }

    /// The shapes that hold a point, in index order.
    pub fn overlap_point(&self, point: impl Into<DVec2>, filter: &QueryFilter<'_>) -> Vec<ShapeId> {
        Finder { world: self, filter }.holding(point.into())
    }

    /// The point of any shape that is closest to `point`, if there is one within `max_distance` metres
    /// (which may be infinite).
    pub fn closest_point(
        &self,
        point: impl Into<DVec2>,
        max_distance: f32,
        filter: &QueryFilter<'_>,
    ) -> Option<ClosestPoint> {
        Finder { world: self, filter }.closest(point.into(), max_distance)
    }
}
