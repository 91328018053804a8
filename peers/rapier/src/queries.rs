//! Questions to Rapier's world.

use crate::shapes::vector;
use rapier2d::parry::query::ShapeCastOptions;
use rapier2d::prelude::*;
use tiny_physics::Vec2;

fn filter(groups: InteractionGroups) -> QueryFilter<'static> {
    QueryFilter { groups: Some(groups), ..QueryFilter::default() }
}

/// Fraction of `translation` at which a ray meets the first shape.
pub fn ray_cast(
    world: &PhysicsWorld,
    origin: Vec2,
    translation: Vec2,
    groups: InteractionGroups,
) -> Option<f32> {
    let ray = Ray::new(vector(origin), vector(translation));
    let hit = world.query_pipeline_with_filter(filter(groups)).cast_ray(&ray, 1.0, true);
    hit.map(|(_, fraction)| fraction)
}

/// The same for a moving circle.
pub fn circle_cast(
    world: &PhysicsWorld,
    center: Vec2,
    radius: f32,
    translation: Vec2,
    groups: InteractionGroups,
) -> Option<f32> {
    let options = ShapeCastOptions { max_time_of_impact: 1.0, ..ShapeCastOptions::default() };
    let pose = Pose::new(vector(center), 0.0);
    let pipeline = world.query_pipeline_with_filter(filter(groups));
    let hit = pipeline.cast_shape(&pose, vector(translation), &Ball::new(radius), options);
    hit.map(|(_, hit)| hit.time_of_impact)
}

/// How many shapes have a box that overlaps this one.
pub fn count_overlaps(
    world: &PhysicsWorld,
    lower: Vec2,
    upper: Vec2,
    groups: InteractionGroups,
) -> usize {
    let aabb = Aabb::new(vector(lower), vector(upper));
    world.query_pipeline_with_filter(filter(groups)).intersect_aabb_conservative(aabb).count()
}
