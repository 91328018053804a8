//! Descriptions translated to Box2D's.

use boxdd_sys::ffi::*;
use peers_worker::centered_box;
use tiny_physics::{Shape, ShapeDef, Transform, Vec2};

/// Box2D's geometry of a shape, in the body's frame.
pub enum Geometry {
    /// A disk.
    Circle(b2Circle),
    /// A rounded segment.
    Capsule(b2Capsule),
    /// A two-sided line segment.
    Segment(b2Segment),
    /// A convex polygon, maybe rounded.
    Polygon(b2Polygon),
}

pub fn vec2(v: Vec2) -> b2Vec2 {
    b2Vec2 { x: v.x, y: v.y }
}

pub fn rot(angle: f32) -> b2Rot {
    b2Rot { c: angle.cos(), s: angle.sin() }
}

/// The shape of a description, moved to its place in the body's frame.
///
/// `None` for a polygon of which Box2D's hull, which has a tolerance, leaves nothing.
pub fn geometry(def: &ShapeDef) -> Option<Geometry> {
    let frame = Transform::from_angle(def.offset, def.angle);
    let at = |v: Vec2| vec2(frame.apply(v));
    Some(match &def.shape {
        Shape::Circle { radius } => {
            Geometry::Circle(b2Circle { center: at(Vec2::ZERO), radius: *radius })
        }
        Shape::Aabb { half_extents } => {
            let (center, rotation) = (vec2(def.offset), rot(def.angle));
            // SAFETY: plain values in, a plain value out.
            Geometry::Polygon(unsafe {
                b2MakeOffsetBox(half_extents.x, half_extents.y, center, rotation)
            })
        }
        Shape::Capsule { a, b, radius } => {
            Geometry::Capsule(b2Capsule { center1: at(*a), center2: at(*b), radius: *radius })
        }
        Shape::Segment { a, b } => Geometry::Segment(b2Segment { point1: at(*a), point2: at(*b) }),
        Shape::Polygon(polygon) => Geometry::Polygon(match centered_box(polygon.vertices()) {
            // A hull takes corners that are nearer than its tolerance for one: cards would have no hull.
            Some(half) => {
                let (center, rotation) = (vec2(def.offset), rot(def.angle));
                // SAFETY: plain values in, a plain value out.
                unsafe {
                    b2MakeOffsetRoundedBox(half.x, half.y, center, rotation, polygon.radius())
                }
            }
            None => {
                let points: Vec<b2Vec2> = polygon.vertices().iter().map(|&v| at(v)).collect();
                // SAFETY: the pointer and the count describe `points`, which outlives the call.
                let hull = unsafe { b2ComputeHull(points.as_ptr(), points.len() as i32) };
                if hull.count == 0 {
                    return None;
                }
                // SAFETY: the hull has corners and outlives the call.
                unsafe { b2MakePolygon(&hull, polygon.radius()) }
            }
        }),
    })
}

/// Material, filter and flags of a description.
pub fn shape_def(def: &ShapeDef) -> b2ShapeDef {
    // SAFETY: returns a plain value.
    let mut out = unsafe { b2DefaultShapeDef() };
    out.density = def.material.density;
    out.material.friction = def.material.friction;
    out.material.restitution = def.material.restitution;
    out.material.rollingResistance = def.material.rolling_resistance;
    out.material.tangentSpeed = def.material.tangent_speed;
    out.filter.categoryBits = def.filter.category;
    out.filter.maskBits = def.filter.mask;
    out.filter.groupIndex = def.filter.group;
    out.isSensor = def.sensor;
    out.enableContactEvents = false;
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use tiny_physics::Polygon;

    #[test]
    fn thin_cards_are_boxes() {
        let card = ShapeDef::new(Polygon::rect(0.001, 0.2).expect("positive sizes"));
        let card = card.offset(Vec2::new(3.0, 0.0));
        let Some(Geometry::Polygon(polygon)) = geometry(&card) else { panic!("no polygon") };
        assert_eq!(polygon.count, 4);
        let xs = polygon.vertices[..4].iter().map(|v| v.x);
        assert!(xs.clone().fold(0.0, f32::max) < 3.0011 && xs.fold(9.0, f32::min) > 2.9989);
    }

    #[test]
    fn what_box2d_cannot_make_is_told() {
        let corners = [Vec2::ZERO, Vec2::new(0.001, 0.0), Vec2::new(0.0, 0.001)];
        let tiny = Polygon::hull(&corners).expect("a triangle");
        assert!(geometry(&ShapeDef::new(tiny)).is_none());
    }
}
