//! Chains and one-way platforms hold what comes from their solid side, however fast, and let pass what comes from the other.

mod common;

use common::{DT, capsule, circle, rect, upright, world};
use tiny_physics::{
    BodyId, ChainDef, Polygon, Pose, RigidBody, Shape, ShapeDef, Vec2, World, collide,
};

const PHASES: usize = 8;
/// Nothing may go deeper into anything, metres.
const LITTLE: f32 = 0.04;

fn shapes() -> [Shape; 5] {
    let hexagon = Shape::from(Polygon::regular(6, 0.5).expect("a hexagon"));
    [circle(0.4), rect(0.4, 0.4), upright(0.4, 0.2), capsule(0.3, 0.2), hexagon]
}

/// How far into the half plane under a height a body reaches, metres.
fn depth_under(world: &World, (body, shape): (BodyId, &Shape), height: f32) -> f32 {
    let ground = Pose::new(Vec2::new(0.0, height - 50.0).into(), Default::default());
    let pose = world.body(body).expect("it is there").pose();
    let manifold = collide(&rect(500.0, 50.0), shape, pose.relative_to(ground), 0.0);
    manifold.points().iter().fold(0.0, |depth, point| depth.max(-point.separation))
}

/// A body that falls from 2 m, with a speed and a phase of its step.
fn falling(shape: &Shape, speed: f32, phase: f32) -> RigidBody {
    let place = Vec2::new(0.3, 2.0 + speed * DT * phase);
    let body = RigidBody::dynamic().position(place).velocity(Vec2::new(2.0, -speed));
    body.shape(ShapeDef::new(*shape))
}

/// Of 160, 16 went up to 9 cm into the chain.
#[test]
fn what_falls_on_chains_goes_no_deeper_than_on_boxes() {
    let points: Vec<Vec2> = (0..40).map(|k| Vec2::new(20.0 - k as f32, 0.0)).collect();
    let mut deep = Vec::new();
    for shape in shapes() {
        for speed in [5.0, 12.0, 20.0, 40.0] {
            for phase in 0..PHASES {
                let mut world = world();
                let ground = world.add_body(RigidBody::fixed()).expect("ground");
                world.add_chain(ground, &ChainDef::open(&points)).expect("a chain");
                let phase = phase as f32 / PHASES as f32;
                let body = world.add_body(falling(&shape, speed, phase)).expect("a body");
                let depths = (0..60).map(|_| {
                    world.step(DT);
                    depth_under(&world, (body, &shape), 0.0)
                });
                let depth = depths.fold(0.0, f32::max);
                if depth > LITTLE {
                    deep.push((shape, speed, depth));
                }
            }
        }
    }
    assert!(deep.is_empty(), "{} of {}: {deep:.3?}", deep.len(), 20 * PHASES);
}

/// What slides over the corners of a chain is not slowed by them.
#[test]
fn what_flies_along_a_chain_is_not_held_up() {
    let points: Vec<Vec2> = (0..120).map(|k| Vec2::new(100.0 - k as f32, 0.0)).collect();
    for shape in shapes() {
        for speed in [10.0, 40.0, 70.0] {
            let mut world = world();
            let ground = world.add_body(RigidBody::fixed()).expect("ground");
            let chain = ChainDef::open(&points).friction(0.0);
            world.add_chain(ground, &chain).expect("a chain");
            let def = ShapeDef::new(shape).friction(0.0);
            let body = RigidBody::dynamic().position(Vec2::new(-10.0, 0.6)).shape(def);
            let body = world.add_body(body.velocity(Vec2::new(speed, 0.0))).expect("a body");
            for _ in 0..60 {
                world.step(DT);
                let velocity = world.body(body).expect("it is there").velocity();
                assert!((velocity.x - speed).abs() < 0.02 * speed, "{shape:?} {speed} {velocity}");
            }
        }
    }
}

/// A one-way platform and a chain that fly freely, 40 kg, are hit from above and from below: 103 of 480 were passed.
#[test]
fn platforms_that_fly_are_hit_from_their_solid_side_alone() {
    let platform = || {
        let points: Vec<Vec2> = (0..7).map(|k| Vec2::new(3.0 - k as f32, 0.0)).collect();
        let body = RigidBody::dynamic().lock_rotation().mass(40.0);
        (body, points)
    };
    let mut wrong = Vec::new();
    for shape in shapes() {
        for (speed, from_above) in
            [20.0, 40.0, 80.0].into_iter().flat_map(|v| [(v, true), (v, false)])
        {
            for (chained, phase) in (0..PHASES).flat_map(|k| [(false, k), (true, k)]) {
                let mut world = World::new(Vec2::ZERO);
                let (body, points) = platform();
                let way = if from_above { 1.0 } else { -1.0 };
                let id = if chained {
                    let id = world.add_body(body).expect("a platform");
                    world.add_chain(id, &ChainDef::open(&points)).expect("a chain");
                    id
                } else {
                    let def = ShapeDef::new(rect(3.0, 0.05)).one_way(Vec2::Y);
                    world.add_body(body.shape(def)).expect("a platform")
                };
                let place = way * (2.0 + speed * DT * phase as f32 / PHASES as f32);
                let hit =
                    RigidBody::dynamic().lock_rotation().velocity(Vec2::new(0.0, -way * speed));
                let hit = hit.position(Vec2::new(0.3, place)).shape(ShapeDef::new(shape));
                let hit = world.add_body(hit).expect("a body");
                (0..40).for_each(|_| world.step(DT));
                let of = |id| world.body(id).expect("it is there");
                let (above, pushed) =
                    (of(hit).position().y > of(id).position().y, of(id).velocity().y);
                // From below it goes on untouched.
                let is_right =
                    above && (pushed < -0.01) == from_above && (from_above || pushed == 0.0);
                if !is_right {
                    wrong.push((shape, speed, from_above, chained, pushed));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {}: {wrong:?}", wrong.len(), 60 * PHASES);
}

/// What falls on a convex corner of a one-way shape, or of two such shapes, stays on top; from below it goes through.
#[test]
fn corners_of_one_way_shapes_hold() {
    let hull = |points: &[(f32, f32)]| {
        let points: Vec<Vec2> = points.iter().map(|&point| Vec2::from(point)).collect();
        ShapeDef::new(Shape::hull(&points).expect("a hull")).one_way(Vec2::Y)
    };
    let roof = vec![hull(&[(-2.0, 0.0), (2.0, 0.0), (0.0, 1.0)])];
    let halves = vec![
        hull(&[(-2.0, 0.0), (0.0, 0.0), (0.0, 1.0)]),
        hull(&[(2.0, 0.0), (0.0, 0.0), (0.0, 1.0)]),
    ];
    let flat_and_slope = vec![
        hull(&[(-2.0, 0.0), (0.0, 0.0), (0.0, 1.0), (-2.0, 1.0)]),
        hull(&[(1.0, 0.0), (0.0, 0.0), (0.0, 1.0)]),
    ];
    for (k, parts) in [roof, halves, flat_and_slope].into_iter().enumerate() {
        for shape in [circle(0.5), circle(0.1), capsule(0.3, 0.2), upright(0.3, 0.3)] {
            for (off, speed) in [(0.05, 0.0), (0.0, 5.0), (-0.02, 15.0), (0.1, 2.0)] {
                for up in [false, true] {
                    let mut world = world();
                    for part in &parts {
                        world.add_body(RigidBody::fixed().shape(part.clone())).expect("a roof");
                    }
                    let (from, speed) = if up { (-1.0, 10.0 + 0.2 * speed) } else { (2.5, -speed) };
                    let body = RigidBody::dynamic().position(Vec2::new(off, from));
                    let body = body.velocity(Vec2::new(0.0, speed)).shape(shape);
                    let body = world.add_body(body).expect("a body");
                    let (mut highest, mut inside) = (f32::MIN, f32::MIN);
                    for _ in 0..180 {
                        world.step(DT);
                        let body = world.body(body).expect("it is there");
                        let place = body.position();
                        highest = highest.max(place.y);
                        // The top of the ground at this place.
                        let slope = if k == 2 { 1.0 } else { 0.5 };
                        let left = if k == 2 { 1.0 } else { 1.0 + 0.5 * place.x };
                        let top = if place.x < 0.0 { left } else { 1.0 - slope * place.x };
                        if body.velocity().y < 0.0 && place.x.abs() < 0.9 {
                            inside = inside.max(top - place.y);
                        }
                    }
                    let told = format!("{k} {shape:?} {off} {speed}: {inside} {highest}");
                    assert!(inside < 0.0, "{told}");
                    assert!(!up || (highest + 1.0 - speed * speed / 19.6).abs() < 0.2, "{told}");
                }
            }
        }
    }
}

/// The end of a one-way shape is none: what has its middle beside it falls past.
#[test]
fn balls_fall_past_the_ends_of_one_way_shapes() {
    for radius in [0.1, 0.3] {
        for part in [0.5, 0.9] {
            let mut world = world();
            let def = ShapeDef::new(rect(2.0, 0.1)).one_way(Vec2::Y);
            world.add_body(RigidBody::fixed().shape(def)).expect("a platform");
            let at = Vec2::new(2.0 + part * radius, 1.0);
            let ball = world.add_body(RigidBody::dynamic().position(at).shape(circle(radius)));
            let ball = ball.expect("a ball");
            (0..90).for_each(|_| world.step(DT));
            let place = world.body(ball).expect("it is there").position();
            assert!((place.x - at.x).abs() < 1e-3 && place.y < -3.0, "{radius} {part}: {place}");
        }
    }
}
