//! Random shapes.

use core::f32::consts::TAU;
use tiny_physics::{Shape, ShapeDef, Vec2};
use tiny_physics_scenes::Random;

/// A box.
pub(super) fn rect(half_width: f32, half_height: f32) -> Shape {
    tiny_physics::Polygon::rect(half_width, half_height)
        .map_or(Shape::Circle { radius: 0.5 }, Shape::from)
}

/// A shape of about a size.
pub(super) fn shape(random: &mut Random, size: f32) -> ShapeDef {
    let (a, b) = (size * random.range(0.4, 1.0), size * random.range(0.4, 1.0));
    let shape = match random.below(5) {
        0 => Shape::Circle { radius: a },
        1 => Shape::Capsule { a: Vec2::new(-a, 0.0), b: Vec2::new(a, 0.0), radius: 0.5 * b },
        2 => corners(random, a),
        _ => rect(a, b),
    };
    let def = ShapeDef::new(shape).friction(random.range(0.0, 1.0));
    let def = if random.below(4) == 0 { def.restitution(random.range(0.0, 0.8)) } else { def };
    def.density(if random.below(4) == 0 { 10.0_f32.powf(random.range(-1.5, 1.5)) } else { 1.0 })
}

/// A convex polygon with three to seven corners.
fn corners(random: &mut Random, size: f32) -> Shape {
    let count = 3 + random.below(5);
    let turn = random.range(0.0, TAU);
    let points: Vec<Vec2> = (0..count)
        .map(|i| {
            let angle = turn + (i as f32 + random.range(-0.3, 0.3)) * TAU / count as f32;
            Vec2::new(tiny_physics::math::cos(angle), tiny_physics::math::sin(angle)) * size
        })
        .collect();
    tiny_physics::Polygon::hull(&points).map_or(Shape::Circle { radius: size }, Shape::from)
}
