//! Asking what is where: rays, moved shapes, overlaps, the closest point, many rays at once.
//! `cargo run -p tiny-physics --example queries`

use tiny_physics::{
    Aabb, Error, Pose, QueryFilter, RayCast, RigidBody, Rot, Shape, Vec2, World, math,
};

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let mut world = World::new(Vec2::ZERO);
    // A ring of pillars around a lamp.
    for k in 0..12 {
        let angle = core::f32::consts::TAU * k as f32 / 12.0;
        let place = 8.0 * Vec2::new(math::cos(angle), math::sin(angle));
        world.add_body(RigidBody::fixed().position(place).shape(Shape::circle(1.0)?))?;
    }
    let lamp = world.add_body(RigidBody::fixed().shape(Shape::circle(0.5)?))?;
    let all = QueryFilter::new();

    // One ray, and all that is on its way. A ray that starts inside a shape does not hit that shape.
    let first = world.ray_cast(Vec2::ZERO, Vec2::new(20.0, 0.0), &all).unwrap();
    assert_eq!((first.point.x, first.normal), (7.0, -Vec2::X));
    let through = world.ray_cast_all(Vec2::new(-20.0, 0.0), Vec2::new(40.0, 0.0), &all);
    assert_eq!(through.len(), 3, "pillar, lamp, pillar");
    assert_eq!(through[1].body, lamp);

    // How much of the surroundings does the lamp light? 3600 rays in one call, on all threads of the world.
    world.set_threads(2);
    let rays: Vec<RayCast> = (0..3600)
        .map(|k| {
            let angle = core::f32::consts::TAU * k as f32 / 3600.0;
            RayCast::new(Vec2::ZERO, 20.0 * Vec2::new(math::cos(angle), math::sin(angle)))
        })
        .collect();
    let mut hits = Vec::new();
    world.ray_casts(&rays, &all, &mut hits);
    let dark = hits.iter().flatten().count() as f32 / 3600.0;
    println!("{:.1} % of the horizon lies in shadow", 100.0 * dark);
    assert!((dark - 12.0 * 2.0 * (1.0_f32 / 8.0).asin() / core::f32::consts::TAU).abs() < 0.01);

    // A shape on a way, things in an area, the nearest surface.
    let crate_ = Shape::rect(0.5, 0.5)?;
    let start = Pose::new(Vec2::new(0.0, 2.0).into(), Rot::IDENTITY);
    let stop = world.cast_shape(&crate_, start, Vec2::new(0.0, 10.0), &all).unwrap();
    println!("a crate can be pushed {:.2} m up", 10.0 * stop.fraction);
    assert!((stop.fraction - 0.45).abs() < 1e-4, "from 2.5 to 7");
    let quarter = Aabb { min: Vec2::ZERO, max: Vec2::splat(20.0) };
    assert_eq!(world.overlap_aabb(quarter, &all.exclude(lamp)).len(), 4, "touching counts");
    let nearest = world.closest_point(Vec2::new(6.0, 0.0), f32::INFINITY, &all).unwrap();
    assert!(
        (nearest.distance - 1.0).abs() < 1e-5 && world.overlap_point(Vec2::ZERO, &all).len() == 1
    );
    Ok(())
}
