//! Bodies of several hundred shapes, and bodies cut out of outlines.

use super::*;
use crate::Polygon;
use crate::math::Aabb;

const SIDE: usize = 20;
/// Half the side of a cell; the gaps between cells are as wide as the cells.
const HALF: f32 = 0.05;

/// 400 small boxes in a square of 4 m, none of which touch.
fn sieve() -> RigidBody {
    let cells = (0..SIDE * SIDE).map(|i| (i % SIDE, i / SIDE));
    cells.enumerate().fold(RigidBody::dynamic(), |body, (i, (x, y))| {
        let offset = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) * (4.0 * HALF);
        let offset = offset - Vec2::splat(2.0 * HALF * SIDE as f32);
        body.shape(rect(HALF, HALF).offset(offset).density(100.0).user_data(i as u64).events())
    })
}

#[test]
fn hundreds_of_shapes_have_the_mass_of_all() {
    let mut world = world();
    let id = world.add_body(sieve()).unwrap();
    let body = world.body(id).unwrap();
    assert_eq!(body.shapes().count(), SIDE * SIDE);
    // Per cell 1 kg, m (w^2 + h^2) / 12 about its own middle, and m d^2.
    let own = (0.1_f32.powi(2) + 0.1_f32.powi(2)) / 12.0;
    let shares = (0..SIDE).map(|i| (0.2 * (i as f32 + 0.5) - 2.0).powi(2));
    let inertia = 400.0 * own + 2.0 * SIDE as f32 * shares.sum::<f32>();
    assert!((body.mass() - 400.0).abs() < 1e-2, "{}", body.mass());
    assert!((body.inertia() / inertia - 1.0).abs() < 1e-4, "{} of {inertia}", body.inertia());
    assert!(body.center().relative_to(DVec2::ZERO).length() < 1e-5);
}

#[test]
fn hundreds_of_shapes_fall_and_lie_on_their_lowest() {
    let mut world = world();
    add_ground(&mut world);
    let id = world.add_body(sieve().position(Vec2::new(0.0, 2.5))).unwrap();
    let (mut most, mut contacts) = (0, 0);
    for _ in 0..180 {
        world.step(DT);
        most = most.max(world.stats().candidate_pairs);
        contacts = contacts.max(world.contact_count());
        assert!(world.contacts().all(|contact| contact.body_a != contact.body_b));
    }
    world.validate().unwrap();
    // Shapes of one body are no pairs: only those near the ground are.
    assert!(most <= 3 * SIDE, "{most} new pairs in a step");
    assert!((SIDE..=2 * SIDE).contains(&contacts), "{contacts} contacts");
    let body = world.body(id).unwrap();
    // The lowest cells reach 1.95 m under the middle.
    assert!((y(&world, id) - 1.95).abs() < 0.005, "{}", y(&world, id));
    assert!(body.angle().abs() < 1e-3 && !body.is_awake());
    world.step(DT);
    assert_eq!((world.stats().moved_shapes, world.stats().candidate_pairs), (0, 0));
}

#[test]
fn questions_find_the_right_one_of_hundreds() {
    let mut world = world();
    let id = world.add_body(sieve().position(Vec2::new(7.0, -3.0)).angle(0.4)).unwrap();
    let body = world.body(id).unwrap();
    let all = QueryFilter::new();
    let number = |shape: ShapeId| world.shape(shape).unwrap().user_data();
    for (i, shape) in body.shapes().map(|id| world.shape(id).unwrap()).enumerate() {
        let middle = shape.pose().p;
        assert_eq!(world.overlap_point(middle, &all), [shape.id()], "shape {i}");
        let toward = body.pose().q.rotate(Vec2::new(0.08, 0.0));
        let hit = world.ray_cast(middle + -toward, toward, &all).unwrap();
        assert_eq!(number(hit.shape), shape.user_data());
        assert!((hit.fraction - 0.03 / 0.08).abs() < 1e-3, "{}", hit.fraction);
        let near = world.closest_point(middle + toward, 1.0, &all).unwrap();
        assert_eq!(near.shape, shape.id());
    }
    let bounds = Aabb::new(Vec2::splat(-20.0), Vec2::splat(20.0));
    assert_eq!(world.overlap_aabb(bounds, &all).len(), SIDE * SIDE);
}

#[test]
fn hundreds_of_shapes_go_one_by_one() {
    let mut world = world();
    add_ground(&mut world);
    let id = world.add_body(sieve().position(Vec2::new(0.0, 1.95)).can_sleep(false)).unwrap();
    let (mut begun, mut ended) = (0, 0);
    let mut left = SIDE * SIDE;
    for round in 0..10 {
        for _ in 0..2 {
            run(&mut world, 1);
            begun += world.events().contact_begin().len();
            ended += world.events().contact_end().len();
        }
        let shapes: Vec<ShapeId> = world.body(id).unwrap().shapes().collect();
        for shape in shapes.into_iter().skip(round % 3).step_by(3) {
            world.remove_shape(shape).unwrap();
            assert!(world.shape(shape).is_none());
            left -= 1;
        }
        let body = world.body(id).unwrap();
        assert_eq!(body.shapes().count(), left);
        assert!((body.mass() - left as f32).abs() < 1e-3 * left as f32 + 1e-3);
    }
    assert!(left < 15 && begun >= SIDE && ended > 0, "{left} {begun} {ended}");
    let more: Vec<ShapeId> =
        sieve().shapes.into_iter().map(|shape| world.add_shape(id, shape).unwrap()).collect();
    run(&mut world, 2);
    assert_eq!(world.body(id).unwrap().shapes().count(), left + more.len());
    world.remove_body(id).unwrap();
    run(&mut world, 2);
    assert_eq!((world.shape_count(), world.contact_count()), (1, 0));
    assert!(more.into_iter().all(|shape| world.shape(shape).is_none()));
}

#[test]
fn a_static_body_of_many_shapes_costs_what_is_near() {
    let mut world = world();
    let mut floor = RigidBody::fixed();
    for i in 0..600 {
        floor = floor.shape(rect(0.5, 0.5).offset(Vec2::new(i as f32, -0.5)));
    }
    world.add_body(floor).unwrap();
    run(&mut world, 1);
    let ball = add(&mut world, 300.0, 1.0, circle(0.4));
    for _ in 0..120 {
        world.step(DT);
        assert!(world.stats().moved_shapes <= 1 && world.stats().candidate_pairs <= 3);
    }
    assert!((y(&world, ball) - 0.4).abs() < 0.005);
    assert!(world.contact_count() <= 3);
}

#[test]
fn a_cup_cut_from_an_outline_holds_a_ball() {
    let cup =
        [(-1.0, 0.0), (1.0, 0.0), (1.2, 1.5), (1.0, 1.5), (0.8, 0.2), (-0.8, 0.2), (-1.0, 1.5)];
    let cup: Vec<Vec2> = cup.into_iter().chain([(-1.2, 1.5)]).map(Vec2::from).collect();
    let mut world = world();
    add_ground(&mut world);
    let like = rect(1.0, 1.0).density(2.0).friction(0.4).user_data(7);
    let body = RigidBody::dynamic().outline(&cup, &like).unwrap();
    let area: f32 =
        Polygon::decompose(&cup).unwrap().into_iter().map(|piece| Shape::from(piece).area()).sum();
    let id = world.add_body(body).unwrap();
    assert!((world.body(id).unwrap().mass() - 2.0 * area).abs() < 1e-4);
    let shapes: Vec<ShapeId> = world.body(id).unwrap().shapes().collect();
    assert!(shapes.iter().all(|shape| world.shape(*shape).unwrap().user_data() == 7));
    let ball = add(&mut world, 0.1, 2.5, circle(0.3));
    run(&mut world, 240);
    assert!((y(&world, ball) - 0.5).abs() < 0.01, "the ball lies in the cup: {}", y(&world, ball));
    let more = world.add_outline(id, &cup, &like).unwrap();
    assert_eq!(more.len(), shapes.len());
    assert!(world.add_outline(id, &cup[..2], &like).is_err());
    assert_eq!(world.body(id).unwrap().shapes().count(), 2 * shapes.len());
}

/// The middle of what is thin lies nearer to the ground than the slop.
#[test]
fn thin_plates_come_to_rest() {
    for (half_length, half_height) in [(0.03, 0.003), (0.016, 0.002), (0.2, 0.0005)] {
        let mut world = world();
        add_ground(&mut world);
        let plate = RigidBody::dynamic().position(Vec2::new(0.0, 0.3)).angle(0.2);
        let plate = world.add_body(plate.shape(rect(half_length, half_height))).unwrap();
        (0..240).for_each(|_| world.step(DT));
        assert!((y(&world, plate) - half_height).abs() < 0.001, "{half_height}");
        assert!(!world.body(plate).unwrap().is_awake(), "{half_height}");
    }
}

/// Reach and rolling of a polygon do not depend on where the origin of its vertices is.
#[test]
fn polygons_may_have_their_vertices_anywhere() {
    let travelled = |at: Vec2| {
        let hexagon = Polygon::regular(6, 0.5).unwrap();
        let there: Vec<Vec2> = hexagon.vertices().iter().map(|&vertex| vertex + at).collect();
        let shape = ShapeDef::new(Polygon::hull(&there).unwrap()).rolling_resistance(0.1);
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let ground = rect(20.0, 0.5).offset(Vec2::new(0.0, -0.5));
        world.add_body(RigidBody::fixed().shape(ground)).unwrap();
        let body = RigidBody::dynamic().shape(shape).position(Vec2::new(0.0, 0.45) - at);
        let id = world.add_body(body.velocity(Vec2::new(3.0, 0.0)).angular_velocity(-6.0)).unwrap();
        let reach = world.state.bodies.infos[id.index as usize].max_extent;
        assert!((reach - 0.5).abs() < 1e-4, "{reach}");
        (0..30).for_each(|_| world.step(1.0 / 60.0));
        world.body(id).unwrap().center().x
    };
    let (here, there) = (travelled(Vec2::ZERO), travelled(Vec2::new(8.0, 0.0)));
    assert!((here - there).abs() < 0.02, "{here} and {there}");
}
