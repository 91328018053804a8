//! Shapes and materials translated to Rapier's.

use peers_worker::centered_box;
use rapier2d::prelude::*;
use tiny_physics::{Mix, Settings, Shape, ShapeDef, Vec2};

pub fn vector(v: Vec2) -> Vector {
    Vector::new(v.x, v.y)
}

/// A collider as described, without filter; `None` for a degenerate polygon.
pub fn collider(def: &ShapeDef, settings: &Settings) -> Option<ColliderBuilder> {
    let builder = geometry(&def.shape)?
        .position(Pose::new(vector(def.offset), def.angle))
        .density(def.material.density)
        .friction(def.material.friction)
        .restitution(def.material.restitution)
        .friction_combine_rule(rule(settings.friction_mix))
        .restitution_combine_rule(rule(settings.restitution_mix))
        .sensor(def.sensor);
    Some(builder)
}

fn geometry(shape: &Shape) -> Option<ColliderBuilder> {
    Some(match shape {
        Shape::Circle { radius } => ColliderBuilder::ball(*radius),
        Shape::Aabb { half_extents } => ColliderBuilder::cuboid(half_extents.x, half_extents.y),
        Shape::Capsule { a, b, radius } => {
            ColliderBuilder::capsule_from_endpoints(vector(*a), vector(*b), *radius)
        }
        Shape::Segment { a, b } => ColliderBuilder::segment(vector(*a), vector(*b)),
        Shape::Polygon(polygon) => match centered_box(polygon.vertices()) {
            // Rapier has faster code for boxes than for convex polygons.
            Some(half) if polygon.radius() == 0.0 => ColliderBuilder::cuboid(half.x, half.y),
            Some(half) => ColliderBuilder::round_cuboid(half.x, half.y, polygon.radius()),
            None => {
                let points = polygon.vertices().iter().map(|&v| vector(v)).collect();
                match polygon.radius() {
                    0.0 => ColliderBuilder::convex_polyline(points)?,
                    radius => ColliderBuilder::round_convex_polyline(points, radius)?,
                }
            }
        },
    })
}

fn rule(mix: Mix) -> CoefficientCombineRule {
    match mix {
        Mix::GeometricMean => CoefficientCombineRule::GeometricMean,
        Mix::Average => CoefficientCombineRule::Average,
        Mix::Min => CoefficientCombineRule::Min,
        Mix::Max => CoefficientCombineRule::Max,
        Mix::Multiply => CoefficientCombineRule::Multiply,
    }
}
