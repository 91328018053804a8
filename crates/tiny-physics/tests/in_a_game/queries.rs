//! Rays, casts, distances.

use super::{circle, square};
use tiny_physics::prelude::*;

#[test]
fn solid_rays_hit_what_they_begin_in() {
    let mut world = World::new((0.0, 0.0));
    let room = world.add_body(RigidBody::fixed().shape(square(2.0))).unwrap();
    let post = world.add_body(RigidBody::fixed().position((5.0, 0.0)).shape(circle(0.5))).unwrap();
    let (from, way) = (Vec2::ZERO, Vec2::new(9.0, 0.0));
    let plain = world.ray_cast(from, way, &QueryFilter::new()).unwrap();
    assert_eq!(plain.body, post);
    let solid = QueryFilter::new().solid();
    let hit = world.ray_cast(from, way, &solid).unwrap();
    assert_eq!((hit.body, hit.fraction, hit.normal), (room, 0.0, -Vec2::X));
    assert_eq!(world.ray_cast_all(from, way, &solid).len(), 2);
    let outside = Vec2::new(-5.0, 0.0);
    assert_eq!(
        world.ray_cast(outside, way, &solid),
        world.ray_cast(outside, way, &QueryFilter::new())
    );
}

/// Everything that a moved shape touches is found, and what it touches first is the first of them.
#[test]
fn casts_find_all_and_turn() {
    let mut world = World::new((0.0, 0.0));
    for i in 0..6 {
        let place = (2.0 + 1.5 * f64::from(i), 0.2 * f64::from(i % 3));
        world.add_body(RigidBody::fixed().position(place).shape(circle(0.3))).unwrap();
    }
    let (foot, start, way) = (square(0.25), Transform::IDENTITY, Vec2::new(7.0, 0.0));
    let filter = QueryFilter::new();
    let all = world.cast_shape_all(&foot, start, way, &filter);
    assert_eq!(all.len(), 4, "{all:?}");
    assert!(all.is_sorted_by_key(|hit| hit.fraction));
    assert_eq!(world.cast_shape(&foot, start, way, &filter), Some(all[0]));
    // Without a turn it is the cast; with one that is next to nothing, nearly.
    assert_eq!(world.cast_shape_turning(&foot, start, way, 0.0, &filter), Some(all[0]));
    let nearly = world.cast_shape_turning(&foot, start, way, 1e-6, &filter).unwrap();
    assert!((nearly.fraction - all[0].fraction).abs() < 1e-4 && nearly.shape == all[0].shape);
    assert!((nearly.normal - all[0].normal).length() < 1e-2);
    // A bar that turns comes to the post as late as the angle says: oracle by small steps.
    let bar = Shape::rect(1.9, 0.05).unwrap();
    let turn = -1.5;
    let start = Transform::from_angle(Vec2::new(0.5, 0.0), 1.2);
    let hit = world.cast_shape_turning(&bar, start, (0.4, 0.0), turn, &filter).unwrap();
    let touches = |fraction: f32| {
        let at = Transform::from_angle(Vec2::new(0.5 + 0.4 * fraction, 0.0), 1.2 + turn * fraction);
        !world.overlap_shape(&bar, at, &filter).is_empty()
    };
    let first = (0..=10_000).map(|i| i as f32 * 1e-4).find(|&fraction| touches(fraction)).unwrap();
    assert!((hit.fraction - first).abs() < 1e-3, "{} against {first}", hit.fraction);
    let hostile = [f32::NAN, f32::INFINITY];
    for n in hostile {
        assert_eq!(world.cast_shape_turning(&bar, start, (0.0, 0.0), n, &filter), None);
        assert!(world.cast_shape_all(&bar, start, (n, 0.0), &filter).is_empty());
    }
}

#[test]
fn distances_between_shapes_and_bodies_of_overlaps() {
    use core::ops::ControlFlow;
    let mut world = World::new((0.0, 0.0));
    let a = world.add_body(RigidBody::fixed().position((1e6, 0.0)).shape(circle(1.0))).unwrap();
    let two = RigidBody::dynamic().position((1e6 + 4.0, 0.0)).shape(square(0.5));
    let b = world.add_body(two.shape(ShapeDef::new(square(0.5)).offset((0.5, 0.0)))).unwrap();
    let shape = |world: &World, id| world.body(id).unwrap().shapes().next().unwrap();
    let gap = world.shape_distance(shape(&world, a), shape(&world, b)).unwrap();
    assert!((gap.separation - 2.5).abs() < 1e-5 && (gap.normal - Vec2::X).length() < 1e-6);
    assert!((gap.point_a - DVec2::new(1e6 + 1.0, 0.0)).length() < 1e-5);
    assert!((gap.point_b.x - (1e6 + 3.5)).abs() < 1e-5);
    let back = world.shape_distance(shape(&world, b), shape(&world, a)).unwrap();
    assert!((back.normal + gap.normal).length() < 1e-6);

    let area = square(9.0);
    let at = Pose::new(DVec2::new(1e6, 0.0), Rot::IDENTITY);
    assert_eq!(world.overlap_shape(&area, at, &QueryFilter::new()).len(), 3);
    assert_eq!(world.overlap_bodies(&area, at, &QueryFilter::new()), [a, b]);
    let mut seen = 0;
    world.visit_overlaps(&area, at, &QueryFilter::new(), |shape| {
        seen += 1;
        if shape.body() == b { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!((1..3).contains(&seen), "it breaks off at the first of b");
    let stale = shape(&world, a);
    world.remove_body(a).unwrap();
    assert_eq!(world.shape_distance(stale, shape(&world, b)), None);
}

/// Trees are put on hills by rays straight down, and these hit the joints of a chain as often as not.
#[test]
fn rays_at_the_joints_of_a_chain_do_not_slip_through() {
    let mut world = World::new((0.0, 0.0));
    let heights: Vec<f32> = (0..400).map(|i| (0.3 * i as f32).sin()).collect();
    let ground = world.add_body(RigidBody::fixed()).unwrap();
    world.add_chain(ground, &ChainDef::heights(1.0, &heights)).unwrap();
    for i in 1..399 {
        let slant = 0.37 * (i % 5) as f32;
        for (from, way) in [
            (DVec2::new(f64::from(i), 10.0), Vec2::new(0.0, -20.0)),
            (
                DVec2::new(f64::from(i) - f64::from(slant), 10.0),
                Vec2::new(slant, heights[i as usize] - 10.0) * 2.0,
            ),
        ] {
            assert!(world.ray_cast(from, way, &QueryFilter::new()).is_some(), "{i} {way}");
        }
    }
}

#[test]
fn questions_of_any_size_have_answers() {
    let mut world = World::new((0.0, 0.0));
    world.settings.length_unit = 0.0;
    world.add_body(RigidBody::fixed().shape(square(1.0))).unwrap();
    let all = QueryFilter::new();
    assert!(world.closest_point((5.0, 5.0), 10.0, &all).is_some());
    let everything = Aabb::new(Vec2::splat(f32::MIN), Vec2::splat(f32::MAX));
    assert_eq!(world.overlap_aabb(everything, &all).len(), 1);
    let hit = world.ray_cast((-5.0, 0.0), (f32::MAX, 0.0), &all).unwrap();
    assert!((hit.point.x + 1.0).abs() < 0.01 && hit.normal == -Vec2::X, "{hit:?}");
}

/// What forgives rounding grows with where a ray hits, not with how far it would go on.
#[test]
fn long_rays_miss_what_lies_beside_them() {
    let mut world = World::new((0.0, 0.0));
    let ground = world.add_body(RigidBody::fixed()).unwrap();
    let wall = ChainDef::open(&[(3.0, 1.0).into(), (3.0, -1.0).into()]);
    world.add_chain(ground, &wall).unwrap();
    for length in [10.0, 1.0e6, 1.0e12, f32::MAX] {
        let hits = |y: f64| world.ray_cast((0.0, y), (length, 0.0), &QueryFilter::new()).is_some();
        assert!(hits(0.999) && hits(-0.999) && !hits(1.001) && !hits(-1.001), "{length}");
    }
}

/// However closely a blade goes by, it hits what it touches and nothing else.
#[test]
fn blades_that_turn_closely_by_hit_nothing() {
    let turn = 2.0 * core::f32::consts::PI;
    let blade = Shape::segment(Vec2::new(0.5, 0.0), Vec2::new(2.0, 0.0)).unwrap();
    for (radius, hits) in [(0.49, false), (0.498, false), (0.499, false), (0.501, true)] {
        let mut world = World::new((0.0, 0.0));
        world.add_body(RigidBody::fixed().shape(circle(radius))).unwrap();
        let cast = |turn| {
            let at = Transform::IDENTITY;
            world.cast_shape_turning(&blade, at, (0.0, 0.0), turn, &QueryFilter::new())
        };
        assert_eq!(cast(turn).is_some(), hits, "{radius}: {:?}", cast(turn));
        assert_eq!(cast(-turn).is_some(), hits, "{radius}");
    }
}

/// Turning or not, a cast tells a place on the surface of what it hits, from the beginning on.
#[test]
fn casts_that_begin_in_something_tell_a_place_on_its_surface() {
    let mut world = World::new((0.0, 0.0));
    world.add_body(RigidBody::fixed().position((1e6, 0.0)).shape(square(1.0))).unwrap();
    for (x, radius) in [(1.2, 0.5), (-1.3, 0.7), (5.0, 0.5)] {
        let (ball, at) = (circle(radius), Pose::new(DVec2::new(1e6 + x, 0.1), Rot::IDENTITY));
        let all = QueryFilter::new();
        let straight = world.cast_shape(&ball, at, (-6.0, 0.0), &all).unwrap();
        let turning = world.cast_shape_turning(&ball, at, (-6.0, 0.0), 0.5, &all).unwrap();
        let apart = (straight.point - turning.point).to_vec2();
        assert!(apart.length() < 1e-3, "{straight:?} {turning:?}");
        assert!((turning.point.x - 1e6).abs() - 1.0 < 1e-6, "{turning:?}");
        assert_eq!(
            (straight.normal, straight.fraction == 0.0),
            (turning.normal, turning.fraction == 0.0)
        );
    }
}
