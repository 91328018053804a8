//! Hands that drag what hangs on them through floors and walls: it stays before them, is not hurled about, and comes along when the
//! hand comes back.

mod common;

use common::{Random, rect, steps};
use tiny_physics::{JointDef, RigidBody, ShapeDef, Vec2, World};

/// What a hand does to a body in the corner of a floor and a wall.
struct Dragged {
    /// Fastest while the joint is torn, unit lengths a second.
    speed: f32,
    /// Deepest in the floor and the wall, unit lengths.
    depth: f32,
    /// The greatest force of the joint by the weight of the body.
    force: f32,
    /// Gap to where the joint holds it after the hand is back, unit lengths.
    gap: f32,
}

fn drag(random: &mut Random, kind: usize) -> Dragged {
    let unit = [1.0, 0.2, 30.0][random.below(3) as usize];
    let (half, speed) = (random.range(0.2, 0.6) * unit, random.range(1.0, 4.0));
    let mut world = World::new(Vec2::new(0.0, -10.0 * unit));
    world.settings.length_unit = unit;
    let side = |x: f32, y: f32, at: Vec2| {
        ShapeDef::new(rect(x * unit, y * unit)).offset(at * unit).friction(0.5)
    };
    let corner = RigidBody::fixed().shape(side(20.0, 3.0, Vec2::new(0.0, -3.0))).shape(side(
        3.0,
        20.0,
        Vec2::new(11.0, 0.0),
    ));
    world.add_body(corner).expect("a corner");
    let place = Vec2::new(8.0 * unit - 1.2 * half, 1.2 * half);
    let body = RigidBody::dynamic().shape(rect(half, half)).position(place);
    let body = world.add_body(body).expect("a body");
    let hand = world.add_body(RigidBody::kinematic().position(place)).expect("a hand");
    let def = match kind {
        0 => JointDef::revolute(),
        1 => JointDef::weld(),
        2 => JointDef::distance(0.5 * unit),
        _ => JointDef::rope(0.5 * unit),
    };
    let joint = world.add_joint(hand, body, def).expect("a joint");
    let out = Vec2::new(random.range(0.2, 1.0), random.range(-1.0, -0.2)) * (speed * unit);
    let weight = world.body(body).expect("it is there").mass() * 10.0 * unit;
    let mut dragged = Dragged { speed: 0.0, depth: 0.0, force: 0.0, gap: 0.0 };
    for step in 0..480 {
        let way = if step < 120 {
            out
        } else if step < 240 {
            -out
        } else {
            Vec2::ZERO
        };
        world.body_mut(hand).expect("it is there").set_velocity(way);
        steps(&mut world, 1);
        let moving = world.body(body).expect("it is there");
        let (at, speed) = (moving.position(), moving.velocity().length() / unit);
        let edge = 8.0 * unit - at.x;
        dragged.speed = dragged.speed.max(speed);
        dragged.depth = dragged.depth.max((half - at.y.min(edge)) / unit);
        let force = world.joint(joint).expect("it is there").force().length() / weight;
        dragged.force = dragged.force.max(force);
        dragged.gap = (at - place).length() / unit;
    }
    dragged
}

/// With impulses that add up they were pulled up to 2.9 into the wall by 20 million times their weight, and came out at up to 400 a second.
#[test]
fn what_a_hand_drags_through_a_wall_stays_before_it_and_comes_back() {
    let mut random = Random::new(11);
    for kind in 0..4 {
        for member in 0..25 {
            let Dragged { speed, depth, force, gap } = drag(&mut random, kind);
            let of = format!("kind {kind}, member {member}");
            assert!(speed < 30.0, "{of}: {speed} a second");
            assert!(depth < 0.7, "{of}: {depth} deep");
            assert!(force < 3.0e4, "{of}: {force} times its weight");
            assert!(gap < 0.51, "{of}: {gap} off");
        }
    }
}

/// What was put far out of place on rough ground is drawn back against friction within a second.
#[test]
fn what_is_torn_comes_back_over_rough_ground() {
    for def in [JointDef::revolute(), JointDef::distance(0.5), JointDef::rope(0.5)] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        common::add_floor(&mut world);
        let hand = RigidBody::kinematic().position(Vec2::new(0.0, 0.3));
        let hand = world.add_body(hand).expect("a hand");
        let body = common::drop_at(&mut world, rect(0.3, 0.3), 0.0, 0.3);
        world.add_joint(hand, body, def).expect("a joint");
        let far = Vec2::new(-2.5, 0.3);
        world.body_mut(body).expect("it is there").set_position(far);
        steps(&mut world, 60);
        let gap = common::position(&world, body).distance(Vec2::new(0.0, 0.3));
        assert!(gap < 0.52, "{def:?}: {gap}");
    }
}
