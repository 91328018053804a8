//! Motors on machines of uneven masses: flails, robot arms.

mod common;

use common::{Random, rect};
use tiny_physics::{BodyId, Filter, JointDef, JointId, RigidBody, ShapeDef, Vec2, World};

const GRAVITY: f32 = 9.8;

/// A bar that meets nothing.
fn bar(world: &mut World, half: f32, mass: f32, x: f32) -> BodyId {
    let shape = ShapeDef::new(rect(half, 0.1 * half)).filter(Filter::NONE);
    let body = RigidBody::dynamic().shape(shape).mass(mass).position(Vec2::new(x, 0.0));
    world.add_body(body).expect("a body")
}

/// How far the anchors of a joint are apart, metres.
fn gap(world: &World, joint: JointId) -> f32 {
    let (a, b) = world.joint(joint).expect("it is there").anchors();
    b.relative_to(a).length()
}

/// The step of a random game, seconds; and its world.
fn game(random: &mut Random) -> (World, f32) {
    let mut world = World::new(Vec2::new(0.0, -GRAVITY));
    world.settings.substeps = [2, 4, 4, 8][random.below(4) as usize];
    (world, 1.0 / [60.0, 60.0, 120.0, 240.0][random.below(4) as usize])
}

/// A motor turns an arm with a heavy bar hinged to its end, through the greatest heights: it keeps its speed, and nothing opens.
/// Up to 70 m were between the two.
#[test]
fn flails_keep_together_and_their_speed() {
    let mut random = Random::new(3);
    for member in 0..40 {
        let (mut world, dt) = game(&mut random);
        let (half, mass) = (random.range(0.1, 1.0), random.range(2.0, 30.0));
        let speed = random.range(0.5, 1.5) * (GRAVITY / half).sqrt();
        let most = 10.0_f32.powf(random.range(2.0, 5.0)) * mass * half * GRAVITY;
        let wall = world.add_body(RigidBody::fixed()).expect("a wall");
        let arm = bar(&mut world, half, 1.0, half);
        let end = bar(&mut world, half, mass, 3.0 * half);
        let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-half, 0.0));
        let motor = world.add_joint(wall, arm, hinge.motor(speed, most)).expect("a motor");
        let hinge = hinge.anchors(Vec2::new(half, 0.0), Vec2::new(-half, 0.0));
        let hinge = world.add_joint(arm, end, hinge).expect("a hinge");
        for step in 0..(6.0 / dt) as usize {
            world.step(dt);
            let wide = gap(&world, motor).max(gap(&world, hinge));
            assert!(wide < 0.02 * half, "member {member}, step {step}: {wide} of {half} m");
            let off = world.body(arm).expect("it is there").angular_velocity() / speed - 1.0;
            let starts = step as f32 * dt < 1.0;
            assert!(starts || off.abs() < 0.05, "member {member}, step {step}: {off}");
        }
    }
}

/// An arm of a robot, with a motor in every hinge that is told at each step how fast to go to its angle, comes to rest there.
#[test]
fn arms_with_a_motor_in_every_hinge_settle() {
    let mut random = Random::new(4);
    for member in 0..30 {
        let (mut world, dt) = game(&mut random);
        let (half, load) = (random.range(0.1, 1.0), 10.0_f32.powf(random.range(-0.7, 1.3)));
        let links = 2 + random.below(4) as usize;
        let total = links as f32 + load;
        let most =
            10.0_f32.powf(random.range(0.3, 3.0)) * total * GRAVITY * 2.0 * half * links as f32;
        let mut last = world.add_body(RigidBody::fixed()).expect("a wall");
        let mut hinges = Vec::new();
        for link in 0..links {
            let next = bar(&mut world, half, 1.0, half * (2 * link + 1) as f32);
            let at = if link == 0 { Vec2::ZERO } else { Vec2::new(half, 0.0) };
            let hinge = JointDef::revolute().anchors(at, Vec2::new(-half, 0.0)).motor(0.0, most);
            let hinge = world.add_joint(last, next, hinge).expect("a motor");
            hinges.push((hinge, random.range(-0.8, 0.8)));
            last = next;
        }
        let hand = bar(&mut world, 0.4 * half, load, 2.0 * half * links as f32);
        let weld = JointDef::weld().anchors(Vec2::new(half, 0.0), Vec2::ZERO);
        world.add_joint(last, hand, weld).expect("a weld");
        for step in 0..(6.0 / dt) as usize {
            for &(hinge, angle) in &hinges {
                let mut hinge = world.joint_mut(hinge).expect("it is there");
                let missing = angle - hinge.as_ref().angle();
                hinge.set_motor_speed((5.0 * missing).clamp(-2.0, 2.0)).expect("a speed");
            }
            world.step(dt);
            for &(hinge, angle) in hinges.iter().filter(|_| step as f32 * dt > 4.0) {
                let off = world.joint(hinge).expect("it is there").angle() - angle;
                assert!(off.abs() < 0.02, "member {member}, step {step}: {off}");
                let gap = gap(&world, hinge);
                assert!(gap < 0.005 * half, "member {member}, step {step}: {gap} of {half} m");
            }
        }
    }
}
