//! Queries against a walk over all shapes, on random worlds.

use super::*;
use crate::describe::{BodyKind, Filter, RigidBody, ShapeDef};
use crate::geometry::{Polygon, Ray, distance, shape_cast};
use crate::math::{Rot, Transform};
use crate::world::ids::BodyId;

/// Numbers at random from a fixed seed.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    fn below(&mut self, count: u64) -> u64 {
        self.next() % count
    }

    fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * (self.next() as f32 / (1_u64 << 31) as f32)
    }

    fn vec(&mut self, range: f32) -> Vec2 {
        Vec2::new(self.between(-range, range), self.between(-range, range))
    }

    fn shape(&mut self) -> Shape {
        let size = self.between(0.1, 1.0);
        match self.below(6) {
            0 => Shape::Circle { radius: size },
            1 => Shape::Aabb { half_extents: Vec2::new(size, self.between(0.1, 1.0)) },
            2 => Shape::Capsule { a: Vec2::new(-size, 0.1), b: Vec2::new(size, 0.3), radius: 0.2 },
            3 => Shape::Segment { a: Vec2::new(-size, 0.0), b: Vec2::new(size, size) },
            4 => Shape::rect(size, self.between(0.1, 1.0)).unwrap(),
            _ => {
                let polygon = Polygon::regular(3 + self.below(6) as usize, size).unwrap();
                polygon.rounded(if self.below(2) == 0 { 0.0 } else { 0.1 }).unwrap().into()
            }
        }
    }

    fn pose(&mut self, center: DVec2, range: f32) -> Pose {
        Pose::new(center + self.vec(range), Rot::from_angle(self.between(-3.0, 3.0)))
    }
}

/// Sixty bodies of one to three shapes within 10 m of the centre, moved on by a few steps.
fn random_world(random: &mut Random, center: DVec2) -> World {
    let mut world = World::new(Vec2::ZERO);
    for _ in 0..60 {
        let kind =
            [BodyKind::Static, BodyKind::Kinematic, BodyKind::Dynamic][random.below(3) as usize];
        let mut body = RigidBody { kind, ..RigidBody::default() }
            .position(center + random.vec(10.0))
            .angle(random.between(-3.0, 3.0))
            .velocity(random.vec(4.0));
        for _ in 0..=random.below(3) {
            let filter = Filter {
                category: 1 << random.below(4),
                mask: u64::MAX >> random.below(3),
                group: [0, 0, 0, 1, -1][random.below(5) as usize],
            };
            let mut shape = ShapeDef::new(random.shape()).offset(random.vec(0.5)).filter(filter);
            shape.angle = random.between(-3.0, 3.0);
            shape.sensor = random.below(5) == 0;
            body = body.shape(shape);
        }
        world.add_body(body).unwrap();
    }
    for _ in 0..random.below(5) {
        world.step(1.0 / 60.0);
    }
    world
}

/// All seen shapes with their frames: the broad phase has no say.
fn seen<'w>(
    world: &'w World,
    filter: &'w QueryFilter<'w>,
) -> impl Iterator<Item = (ShapeId, BodyId, &'w Shape, Pose)> {
    world.state.shapes.indices().filter_map(move |index| {
        let record = &world.state.shapes.records[index as usize];
        let (shape, body) = (world.shape_id(index), world.body_id(record.body));
        let sees = (filter.sensors || !record.sensor)
            && filter.filter.collides(&record.filter)
            && filter.exclude_body != Some(body)
            && filter.predicate.is_none_or(|predicate| predicate(shape));
        let pose = world.state.bodies.poses[record.body as usize].compose(record.central);
        sees.then_some((shape, body, &record.shape, pose))
    })
}

/// Calls a test with random worlds, near and far from the origin, and with filters of all kinds.
fn for_each_world(test: impl Fn(&mut Random, &World, DVec2, &QueryFilter<'_>)) {
    let even = |shape: ShapeId| shape.index().is_multiple_of(2);
    for seed in 0..40 {
        let mut random = Random(seed);
        let center =
            [DVec2::ZERO, DVec2::new(3.0e5, -7.0e5), DVec2::new(-4.0e7, 1.0e7)][seed as usize % 3];
        let world = random_world(&mut random, center);
        let some_body = world.body_ids().nth(5).unwrap();
        for filter in [
            QueryFilter::new(),
            QueryFilter::new().sensors().mask(0b101),
            QueryFilter::from(Filter { group: 1, category: 1, mask: 2 }),
            QueryFilter::new().group(-1).exclude(some_body),
            QueryFilter::new().predicate(&even),
        ] {
            test(&mut random, &world, center, &filter);
        }
    }
}

#[test]
fn rays_agree_with_all_shapes() {
    for_each_world(|random, world, center, filter| {
        for _ in 0..40 {
            let (origin, translation) = (center + random.vec(12.0), random.vec(15.0));
            let mut expected: Vec<RayCastHit> = seen(world, filter)
                .filter_map(|(shape, body, geometry, pose)| {
                    let ray = Ray::new(pose.unapply(origin), pose.q.unrotate(translation));
                    let hit = geometry.ray_cast(&ray)?;
                    let point = origin + translation * hit.fraction;
                    let (normal, fraction) = (pose.q.rotate(hit.normal), hit.fraction);
                    Some(RayCastHit { shape, body, point, normal, fraction })
                })
                .collect();
            expected.sort_by(|a, b| a.fraction.total_cmp(&b.fraction).then(a.shape.cmp(&b.shape)));
            assert_eq!(world.ray_cast(origin, translation, filter), expected.first().copied());
            assert_eq!(world.ray_cast_any(origin, translation, filter), !expected.is_empty());
            assert_eq!(world.ray_cast_all(origin, translation, filter), expected);
        }
    });
}

#[test]
fn shape_casts_agree_with_all_shapes() {
    for_each_world(|random, world, center, filter| {
        for _ in 0..15 {
            let (shape, start) = (random.shape(), random.pose(center, 12.0));
            let translation = random.vec(15.0);
            let expected = seen(world, filter)
                .filter_map(|(id, _, geometry, pose)| {
                    let (start, way) = (start.relative_to(pose), pose.q.unrotate(translation));
                    Some((shape_cast(geometry, &shape, start, way)?.fraction, id))
                })
                .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let found = world.cast_shape(&shape, start, translation, filter);
            assert_eq!(found.map(|hit| (hit.fraction, hit.shape)), expected);
        }
    });
}

#[test]
fn overlaps_agree_with_all_shapes() {
    for_each_world(|random, world, center, filter| {
        for _ in 0..15 {
            let (shape, place) = (random.shape(), random.pose(center, 12.0));
            let touching = |shape: &Shape, place: Pose| -> Vec<ShapeId> {
                let near = |geometry: &Shape, pose| {
                    distance(geometry, shape, place.relative_to(pose)).separation <= 0.0
                };
                seen(world, filter).filter(|s| near(s.2, s.3)).map(|s| s.0).collect()
            };
            assert_eq!(world.overlap_shape(&shape, place, filter), touching(&shape, place));

            let holding: Vec<ShapeId> = seen(world, filter)
                .filter(|(_, _, geometry, pose)| geometry.contains(pose.unapply(place.p)))
                .map(|s| s.0)
                .collect();
            assert_eq!(world.overlap_point(place.p, filter), holding);

            let half_extents = Vec2::new(random.between(0.0, 3.0), random.between(0.0, 3.0));
            let aabb = Aabb::from_center(place.p.to_vec2(), half_extents);
            let place =
                Pose::new((DVec2::from(aabb.min) + DVec2::from(aabb.max)) * 0.5, Rot::IDENTITY);
            let shape = Shape::Aabb { half_extents: aabb.half_extents() };
            assert_eq!(world.overlap_aabb(aabb, filter), touching(&shape, place));
        }
    });
}

#[test]
fn closest_points_agree_with_all_shapes() {
    for_each_world(|random, world, center, filter| {
        for _ in 0..30 {
            let point = center + random.vec(40.0);
            let limit = [0.0, 1.0, 7.0, f32::INFINITY][random.below(4) as usize];
            let expected = seen(world, filter)
                .map(|(id, _, geometry, pose)| {
                    let local = pose.unapply(point);
                    (geometry.closest_point(local).distance(local), id)
                })
                .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
                .filter(|(distance, _)| *distance <= limit);
            let found = world.closest_point(point, limit, filter);
            assert_eq!(found.map(|closest| (closest.distance, closest.shape)), expected);
        }
    });
}

#[test]
fn many_rays_at_once_are_single_rays() {
    let mut random = Random(99);
    let mut world = random_world(&mut random, DVec2::ZERO);
    let rays: Vec<RayCast> =
        (0..1000).map(|_| RayCast::new(random.vec(12.0), random.vec(15.0))).collect();
    let filter = QueryFilter::new();
    let single: Vec<_> =
        rays.iter().map(|ray| world.ray_cast(ray.origin, ray.translation, &filter)).collect();
    let mut hits = vec![None; 3];
    for threads in [1, 2, 4] {
        world.set_threads(threads);
        world.ray_casts(&rays, &filter, &mut hits);
        assert_eq!(hits, single);
    }
    assert!(single.iter().flatten().count() > 300);
}

#[test]
fn equal_hits_go_to_the_smaller_index() {
    let mut world = World::new(Vec2::ZERO);
    let mut ids = Vec::new();
    for _ in 0..20 {
        let body = RigidBody::fixed().shape(Shape::rect(1.0, 1.0).unwrap());
        let body = world.add_body(body).unwrap();
        ids.extend(world.body(body).unwrap().shapes());
    }
    let first = *ids.iter().min().unwrap();
    let filter = QueryFilter::new();
    let (from, way) = (Vec2::new(-3.0, 0.0), Vec2::new(5.0, 0.0));
    assert_eq!(world.ray_cast(from, way, &filter).unwrap().shape, first);
    assert_eq!(world.closest_point(from, 9.0, &filter).unwrap().shape, first);
    let ball = Shape::Circle { radius: 0.5 };
    let inside = Transform::IDENTITY;
    assert_eq!(world.cast_shape(&ball, inside, way, &filter).unwrap().shape, first);
    ids.sort();
    assert_eq!(world.overlap_point(Vec2::ZERO, &filter), ids);
}

#[test]
fn questions_without_sense_find_nothing() {
    let mut world = World::new(Vec2::ZERO);
    world.add_body(RigidBody::fixed().shape(Shape::rect(1.0, 1.0).unwrap())).unwrap();
    let filter = QueryFilter::new();
    let (nan, infinite) = (Vec2::new(f32::NAN, 0.0), Vec2::new(f32::INFINITY, 0.0));
    let ball = Shape::Circle { radius: -1.0 };
    for bad in [nan, infinite] {
        assert_eq!(world.ray_cast(bad, Vec2::X, &filter), None);
        assert_eq!(world.ray_cast(Vec2::new(-3.0, 0.0), bad, &filter), None);
        assert!(world.overlap_point(bad, &filter).is_empty());
        assert_eq!(world.closest_point(bad, 1.0, &filter), None);
        assert!(world.overlap_aabb(Aabb::new(bad, Vec2::ZERO), &filter).is_empty());
    }
    assert_eq!(world.closest_point(Vec2::ZERO, f32::NAN, &filter), None);
    assert_eq!(world.cast_shape(&ball, Transform::IDENTITY, Vec2::X, &filter), None);
    assert!(world.overlap_shape(&ball, Transform::IDENTITY, &filter).is_empty());
    assert!(!world.ray_cast_any(Vec2::new(-3.0, 0.0), Vec2::ZERO, &filter));
}
