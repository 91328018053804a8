//! Where surfaces end or go on as something else: one-way ground beside solid ground, ends of platforms, holes in chains, and
//! neighbours that somebody passes.

mod common;

use common::{DT, Random, circle, rect, steps, world};
use tiny_physics::{
    BodyId, ChainDef, DVec2, JointDef, Locks, Polygon, RigidBody, Rot, Settings, ShapeDef,
    TileGrid, Vec2, World,
};

fn dynamic(world: &mut World, shape: ShapeDef, place: Vec2) -> BodyId {
    world.add_body(RigidBody::dynamic().position(place).shape(shape)).expect("a body")
}

fn fixed(world: &mut World, shape: ShapeDef, place: Vec2) -> BodyId {
    world.add_body(RigidBody::fixed().position(place).shape(shape)).expect("ground")
}

fn y(world: &World, body: BodyId) -> f32 {
    world.body(body).expect("it is there").position().y
}

/// Boxes, balls and capsules slide from one-way tiles onto solid ones and back, at all speeds.
#[test]
fn one_way_tiles_and_solid_ones_make_one_floor() {
    let mut random = Random::new(5);
    for row in ["------######", "######------", "--##--##--##"] {
        for member in 0..24 {
            let mut world = world();
            world
                .add_tiles(TileGrid::parse(1.0, &[row]).expect("tiles").friction(0.0))
                .expect("a level");
            let top = 1.0;
            let half = random.range(0.15, 0.45);
            let shape = [rect(half, half), rect(1.5 * half, half), circle(half)][member % 3];
            let body = RigidBody::dynamic().position(Vec2::new(1.0, top + half));
            let body = body.shape(ShapeDef::new(shape).friction(0.0));
            let body = body.locks(Locks { rotation: member % 2 == 0, ..Locks::default() });
            let body = world.add_body(body).expect("a body");
            steps(&mut world, 30);
            let speed = random.range(0.5, 12.0);
            world.body_mut(body).expect("a body").set_velocity(Vec2::new(speed, 0.0));
            while world.body(body).expect("a body").position().x < 10.5 {
                world.step(DT);
                let body = world.body(body).expect("a body");
                let (place, velocity) = (body.position(), body.velocity());
                let off = (place.y - top - half).abs();
                assert!(
                    velocity.x > 0.99 * speed && off < 0.01,
                    "{row} {member}: {velocity:?} of {speed}, {off}"
                );
            }
        }
    }
}

/// So do they where the world lies on its side, in another unit, and where both are parts of a raft that floats.
#[test]
fn one_way_parts_make_one_floor_anywhere() {
    let mut random = Random::new(8);
    for member in 0..60 {
        let (unit, turn) = ([1.0, 50.0][member % 2], random.range(-3.0, 3.0));
        let rot = Rot::from_angle(turn);
        let mut world = World::new(rot.rotate(Vec2::new(0.0, -10.0 * unit)));
        world.settings.length_unit = unit;
        let mut floor = if member % 3 == 0 {
            RigidBody::dynamic().gravity_scale(0.0)
        } else if member % 3 == 1 {
            RigidBody::kinematic()
        } else {
            RigidBody::fixed()
        };
        for k in 0..6 {
            let place = Vec2::new(2.0 * unit * k as f32, 0.0);
            let part =
                Polygon::turned_rect(unit, 0.5 * unit, place, Rot::IDENTITY).expect("a part");
            let part = ShapeDef::new(part).friction(0.0).density(1000.0);
            floor = floor.shape(if k % 2 == member % 2 { part.one_way(Vec2::Y) } else { part });
        }
        world.add_body(floor.angle(turn)).expect("a floor");
        let half = unit * random.range(0.15, 0.45);
        let body = RigidBody::dynamic().position(rot.rotate(Vec2::new(0.0, 0.5 * unit + half)));
        let body = body.angle(turn).shape(ShapeDef::new(rect(half, half)).friction(0.0));
        let body = world.add_body(body).expect("a body");
        steps(&mut world, 30);
        let speed = unit * random.range(1.0, 12.0);
        world.body_mut(body).expect("a body").set_velocity(rot.rotate(Vec2::new(speed, 0.0)));
        for _ in 0..(60.0 * 10.0 * unit / speed) as usize {
            world.step(DT);
            let velocity = rot.unrotate(world.body(body).expect("a body").velocity());
            assert!(velocity.x > 0.97 * speed, "{member}: {velocity:?} of {speed}, {turn} rad");
        }
    }
}

/// And a wall that one-way ground runs into is a wall for what is inside that ground or comes under it.
#[test]
fn a_wall_beside_one_way_ground_stays_a_wall() {
    let mut world = world();
    world.gravity = Vec2::ZERO;
    fixed(&mut world, ShapeDef::new(rect(2.0, 0.5)).one_way(Vec2::Y), Vec2::new(-2.0, 0.0));
    fixed(&mut world, rect(2.0, 0.5).into(), Vec2::new(2.0, 0.0));
    for height in [0.3, 0.0, -0.3] {
        let body = dynamic(&mut world, rect(0.3, 0.3).into(), Vec2::new(-3.0, height));
        world.body_mut(body).expect("a body").set_velocity(Vec2::new(3.0, 0.0));
        steps(&mut world, 120);
        let x = world.body(body).expect("a body").position().x;
        assert!(x < -0.28, "{height}: {x}");
        world.remove_body(body).expect("it was there");
    }
}

/// What comes aslant into the end of a one-way platform passes, however fast.
#[test]
fn the_end_of_a_one_way_platform_stops_nobody() {
    let mut random = Random::new(6);
    for member in 0..60 {
        let mut world = world();
        world.gravity = Vec2::ZERO;
        let platform = ShapeDef::new(rect(2.0, 1.0)).one_way(Vec2::Y);
        fixed(&mut world, platform, Vec2::ZERO);
        let size = random.range(0.05, 0.4);
        let shape = if member % 2 == 0 { circle(size) } else { rect(size, size) };
        let (speed, slope) = (random.range(5.0, 60.0), random.range(0.2, 1.7));
        let velocity = Vec2::new(1.0, -slope).normalized() * speed;
        // At the end, so deep that what meets it was beside the platform a step ago: the underside, or the middle of a ball.
        let round = if member % 2 == 0 { size } else { 0.0 };
        let depth = random.range(0.02, 0.6) + round - velocity.y * DT;
        let meets = Vec2::new(-2.0 - size, 1.0 + size - depth);
        let place = meets - velocity * (DT * random.range(0.2, 3.0));
        let body = dynamic(&mut world, shape.into(), place);
        world.body_mut(body).expect("a body").set_velocity(velocity);
        steps(&mut world, 20);
        let now = world.body(body).expect("a body").velocity();
        assert!((now - velocity).length() < 0.01 * speed, "{member}: {now:?} of {velocity:?}");
    }
}

/// Planks lean on the edge of a platform, and tip over it, as they do on a solid one; on the end of a chain, too.
#[test]
fn planks_lean_on_the_edges_of_one_way_platforms() {
    for tilt in [0.3_f32, 0.5, 0.7] {
        let heights = [0, 1, 2].map(|kind| {
            let mut world = world();
            fixed(&mut world, rect(20.0, 0.5).into(), Vec2::new(0.0, -1.6));
            let platform = ShapeDef::new(rect(2.0, 0.1)).friction(0.8);
            let platform = if kind == 1 { platform.one_way(Vec2::Y) } else { platform };
            if kind == 2 {
                let ground = world.add_body(RigidBody::fixed()).expect("ground");
                let points = [2.0, 0.7, -0.8, -2.0].map(|x| Vec2::new(x, 0.1));
                let chain = ChainDef::open(&points).friction(0.8);
                world.add_chain(ground, &chain).expect("a chain");
            } else {
                fixed(&mut world, platform, Vec2::ZERO);
            }
            let along = Vec2::new(tilt.cos(), -tilt.sin());
            let length = (1.2 / tilt.sin() + 0.5) * 0.5;
            let middle = Vec2::new(2.0, 0.1) + along * (length - 0.5) + along.perp() * 0.055;
            let plank = RigidBody::dynamic().position(middle).angle(-tilt);
            let plank = plank.shape(ShapeDef::new(rect(length, 0.05)).friction(0.9));
            let plank = world.add_body(plank).expect("a plank");
            steps(&mut world, 240);
            let plank = world.body(plank).expect("a plank");
            (plank.position().y, plank.angle())
        });
        let [solid, others @ ..] = heights;
        for other in others {
            assert!((solid.0 - other.0).abs() < 0.05, "{tilt}: {solid:?}, {heights:?}");
        }
    }
}

/// A hole in a chain has ends: what is larger than the hole stays out, at all sizes.
#[test]
fn holes_in_chains_have_corners() {
    for (radius, gone) in [(0.8_f32, 1), (0.6, 1), (1.5, 2), (1.1, 2)] {
        let mut world = world();
        let ground = world.add_body(RigidBody::fixed()).expect("ground");
        let points: Vec<Vec2> = (0..9).map(|k| Vec2::new(4.0 - k as f32, 0.0)).collect();
        let chain = world.add_chain(ground, &ChainDef::open(&points)).expect("a chain");
        for k in 0..gone {
            world.remove_shape(chain[3 + k]).expect("a segment");
        }
        let (left, right) = (points[3 + gone].x, points[3].x);
        let ball = dynamic(
            &mut world,
            circle(radius).into(),
            Vec2::new(0.5 * (left + right), radius + 0.3),
        );
        steps(&mut world, 240);
        let half = 0.5 * (right - left);
        let rests = (radius * radius - half * half).sqrt();
        let height = y(&world, ball);
        assert!((height - rests).abs() < 0.02, "{radius} over {gone}: {height}, not {rests}");
    }
}

/// Ground under a block that somebody passes, as a hook or a joint has it, holds him all the same.
#[test]
fn ground_under_what_somebody_passes_holds() {
    for hooked in [true, false] {
        for (shape, half) in [(circle(0.5), 0.5), (rect(0.4, 0.4), 0.4), (rect(0.2, 0.6), 0.6)] {
            let mut world = world();
            fixed(&mut world, rect(2.0, 0.5).into(), Vec2::new(0.0, -0.5));
            let block = ShapeDef::new(rect(1.0, 0.15)).user_data(7);
            let block = fixed(&mut world, block, Vec2::new(0.0, 0.15));
            let slides = ShapeDef::new(shape).friction(0.0);
            let body = dynamic(&mut world, slides, Vec2::new(-1.6, half));
            if hooked {
                world.set_pair_filter(|pair| pair.user_data_a != 7 && pair.user_data_b != 7);
            } else {
                world.add_joint(block, body, JointDef::filter()).expect("a joint");
            }
            for _ in 0..120 {
                let mut moved = world.body_mut(body).expect("a body");
                moved.set_velocity(Vec2::new(1.2, moved.as_ref().velocity().y));
                world.step(DT);
                let height = y(&world, body);
                assert!(
                    (height - half).abs() < 0.02,
                    "{hooked} {shape:?}: {height} at {}",
                    world.body(body).unwrap().position().x
                );
            }
        }
    }
}

/// A fast sensor, or one that something fast passes, sees what it meets and nothing beside it.
#[test]
fn sensors_tell_of_what_passes_close_by_and_what_grazes() {
    for round in [false, true] {
        for (gap, seen) in [(0.004, false), (0.001, false), (-0.001, true), (-0.003, true)] {
            let mut world = world();
            world.gravity = Vec2::ZERO;
            let zone = ShapeDef::new(rect(1.0, 0.5)).sensor();
            fixed(&mut world, zone, Vec2::new(0.0, -0.5));
            let shape = if round { circle(0.1) } else { rect(0.1, 0.1) };
            let body = dynamic(&mut world, shape.into(), Vec2::new(-3.0, 0.1 + gap));
            world.body_mut(body).expect("a body").set_velocity(Vec2::new(150.0, 0.0));
            let mut begins = 0;
            for _ in 0..10 {
                world.step(DT);
                begins += world.events().sensor_begin().len();
            }
            assert_eq!(begins > 0, seen, "round {round}, gap {gap}");
        }
    }
}

/// What turns about its own middle does not let pass what it hits with its solid side.
#[test]
fn one_way_paddles_hit_what_they_turn_into() {
    for (spin, kinematic) in [(30.0, true), (12.0, true), (30.0, false)] {
        let mut world = World::new(Vec2::ZERO);
        let paddle =
            if kinematic { RigidBody::kinematic() } else { RigidBody::dynamic().mass(100.0) };
        let paddle = paddle.angle(-0.25).angular_velocity(spin);
        let shape = ShapeDef::new(rect(1.0, 0.05)).one_way(Vec2::Y);
        world.add_body(paddle.shape(shape)).expect("a paddle");
        let ball = dynamic(&mut world, ShapeDef::new(circle(0.1)), Vec2::new(0.8, 0.0));
        steps(&mut world, 4);
        let ball = world.body(ball).expect("a ball");
        assert!(ball.velocity().y > 0.3 * spin, "{spin} {kinematic}: {:?}", ball.velocity());
    }
}

/// Nor does a hinged plank go through a one-way plate that it turns onto, or a polygon one through a ball.
#[test]
fn one_way_plates_hold_what_turns_onto_them() {
    for spin in [20.0, 40.0] {
        let mut world = World::new(Vec2::ZERO);
        let wall = world.add_body(RigidBody::fixed()).expect("a wall");
        let plank = RigidBody::dynamic().position((0.0, 1.0)).angular_velocity(-spin);
        let plank = world.add_body(plank.shape(rect(1.0, 0.05))).expect("a plank");
        let hinge = JointDef::revolute().anchor_at((0.0, 1.0));
        world.add_joint(wall, plank, hinge).expect("a hinge");
        let plate = ShapeDef::new(rect(0.3, 0.05)).one_way(Vec2::Y);
        fixed(&mut world, plate, Vec2::new(0.85, 0.65));
        let mut lowest = 0.0_f32;
        for _ in 0..30 {
            steps(&mut world, 1);
            lowest = lowest.min(world.body(plank).expect("a plank").angle());
        }
        assert!(lowest > -0.5, "{spin}: {lowest}");

        let mut world = World::new(Vec2::ZERO);
        let blade = [(-1.0, -0.05), (1.0, -0.05), (1.0, 0.02), (0.0, 0.06), (-1.0, 0.02)];
        let blade = Polygon::convex(&blade.map(Vec2::from)).expect("a blade");
        let paddle = RigidBody::kinematic().angle(-0.25).angular_velocity(spin);
        world.add_body(paddle.shape(ShapeDef::new(blade).one_way(Vec2::Y))).expect("a paddle");
        let ball = dynamic(&mut world, ShapeDef::new(circle(0.1)), Vec2::new(0.8, 0.0));
        steps(&mut world, 4);
        let up = world.body(ball).expect("a ball").velocity().y;
        assert!(up > 0.3 * spin, "{spin}: {up}");
    }
}

/// Ground may be as large as it likes: small boxes lie on it with both ends, and what falls fast lands on it.
#[test]
fn endless_ground_is_as_good_as_any() {
    for half in [1e3, 1e4, 1e5, 1e6] {
        let segment = tiny_physics::Shape::segment((-half, 0.0), (half, 0.0)).expect("a floor");
        let slab = rect(half, 1.0);
        for (ground, y) in [(slab, -1.0), (segment, 0.0)] {
            for angle in [0.0, 0.1, -0.1] {
                let mut world = world();
                fixed(&mut world, ShapeDef::new(ground), Vec2::new(0.0, y));
                let body = RigidBody::dynamic().shape(rect(0.3, 0.2)).angle(angle);
                let body = world.add_body(body.position((0.0, 0.3))).expect("a box");
                steps(&mut world, 120);
                let body = world.body(body).expect("a box");
                let off = (body.angle().abs(), (body.position().y - 0.2).abs());
                assert!(off.0 < 0.01 && off.1 < 0.01, "{half} {angle}: {off:?}");
            }
            for (radius, from, speed) in [(0.5, 3.3, 30.0), (0.1, 1.0, 10.0), (0.1, 1.03, 20.0)] {
                let mut world = world();
                let floor = ShapeDef::new(ground).restitution(0.7);
                fixed(&mut world, floor, Vec2::new(0.0, y));
                let shape = ShapeDef::new(circle(radius)).restitution(0.7);
                let ball = dynamic(&mut world, shape, Vec2::new(0.0, from));
                world.body_mut(ball).expect("a ball").set_velocity(Vec2::new(0.0, -speed));
                steps(&mut world, 12);
                let up = world.body(ball).expect("a ball").velocity().y;
                assert!(up > 0.45 * speed - 2.0, "{half} {radius}: {up} of {speed}");
            }
        }
    }
}

/// What slides on a half-space far from its point, at whatever slope and in whatever unit, keeps its speed and its height.
#[test]
fn half_spaces_are_endless_in_every_unit() {
    for unit in [0.01_f32, 1.0, 100.0] {
        for (normal, angle) in [(Vec2::Y, 0.0_f32), (Vec2::new(0.6, 0.8), -0.643_501_1)] {
            for far in [0.0, 15.0, 997.0, 4e3].map(|far| far * unit) {
                let settings = Settings { length_unit: unit, ..Settings::default() };
                let mut world = World::with_settings(normal * (-10.0 * unit), settings);
                let floor = ChainDef::half_space((0.0, 0.0), normal).friction(0.0);
                world.add_body(RigidBody::fixed().chain(&floor).expect("a floor")).expect("it");
                let (way, shape) = (normal.perp(), rect(0.3 * unit, 0.2 * unit));
                let place = DVec2::from(way) * f64::from(far) + normal * (0.21 * unit);
                let body = RigidBody::dynamic().position(place).angle(angle).can_sleep(false);
                let body = body.velocity(way * (3.0 * unit));
                let body = world.add_body(body.shape(ShapeDef::new(shape).friction(0.0)));
                let body = body.expect("a box");
                steps(&mut world, 120);
                let body = world.body(body).expect("a box");
                let place = body.pose().p;
                let off = (place.dot(normal.into()) as f32 - 0.2 * unit).abs();
                let speed = body.velocity().dot(way) / (3.0 * unit);
                let told = format!("{unit} {normal} {far}: {off} {speed}");
                assert!(off < 0.01 * unit + 1e-7 * far && (speed - 1.0).abs() < 0.01, "{told}");
            }
        }
    }
}
