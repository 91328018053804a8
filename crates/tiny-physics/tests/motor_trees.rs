//! Motors on machines of uneven masses: flails, robot arms; drawbridges and lifts with loose loads.

mod common;

use common::{Random, rect};
use tiny_physics::{
    BodyId, Filter, JointDef, JointId, Pose, RigidBody, Rot, ShapeDef, SimdLevel, Vec2, World,
};

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
/// Up to 70 m were between the two. (Of 300 others 4 open by more than a fiftieth of half an arm, at most a tenth.)
#[test]
fn flails_keep_together_and_their_speed() {
    let mut random = Random::new(3);
    let mut opened = 0;
    for member in 0..40 {
        let (mut world, dt) = game(&mut random);
        let (half, mass) = (random.range(0.1, 1.0), random.range(2.0, 30.0));
        let mut widest = 0.0_f32;
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
            assert!(wide < 0.1 * half, "member {member}, step {step}: {wide} of {half} m");
            widest = widest.max(wide);
            let off = world.body(arm).expect("it is there").angular_velocity() / speed - 1.0;
            let starts = step as f32 * dt < 1.0;
            assert!(starts || off.abs() < 0.05, "member {member}, step {step}: {off}");
        }
        opened += u32::from(widest > 0.02 * half);
    }
    assert!(opened <= 1, "{opened}");
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

/// A motor of a wheel joint turns a small hub with three heavy blades welded to it, and one on a rail lifts a cab with a heavy bar
/// that swings from it.
#[test]
fn wheels_and_lifts_have_the_speed_of_their_motors() {
    let mut random = Random::new(5);
    for member in 0..30 {
        let (mut world, dt) = game(&mut random);
        let (half, mass) = (random.range(0.2, 2.0), random.range(5.0, 50.0));
        let speed = random.range(0.5, 5.0);
        let wall = world.add_body(RigidBody::fixed()).expect("a wall");
        let hub = bar(&mut world, 0.2 * half, 1.0, 0.0);
        world.body_mut(hub).expect("it is there").set_gravity_scale(0.0);
        let axle = JointDef::wheel(Vec2::new(0.0, 1.0)).motor(speed, 1.0e6);
        world.add_joint(wall, hub, axle).expect("a motor");
        for k in 0..3_u8 {
            let angle = std::f32::consts::TAU / 3.0 * f32::from(k);
            let blade = bar(&mut world, half, mass, 0.0);
            let mut blade_mut = world.body_mut(blade).expect("it is there");
            let (sin, cos) = angle.sin_cos();
            blade_mut.set_gravity_scale(0.0);
            blade_mut
                .set_pose(Pose::new((Vec2::new(cos, sin) * half).into(), Rot::from_angle(angle)));
            let weld = JointDef::weld().anchor_at(Vec2::new(cos, sin) * (0.1 * half));
            world.add_joint(hub, blade, weld).expect("a weld");
        }
        let cab = bar(&mut world, 0.2 * half, 1.0, 0.0);
        let load = bar(&mut world, half, mass, half);
        let rail = JointDef::prismatic(Vec2::new(0.0, 1.0)).motor(speed, 1.0e5 * mass);
        world.add_joint(wall, cab, rail).expect("a motor");
        let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-half, 0.0));
        world.add_joint(cab, load, hinge).expect("a hinge");
        let mut other = world.clone();
        other.set_simd(SimdLevel::Scalar).expect("every machine has it");
        for step in 0..(3.0 / dt) as usize {
            world.step(dt);
            if step as f32 * dt > 1.0 {
                let [hub, cab] = [hub, cab].map(|body| world.body(body).expect("it is there"));
                let (spin, rise) = (hub.angular_velocity() / speed, cab.velocity().y / speed);
                assert!((spin - 1.0).abs() < 0.01, "member {member}, step {step}: {spin}");
                assert!((rise - 1.0).abs() < 0.01, "member {member}, step {step}: {rise}");
            }
            if member < 3 {
                other.step(dt);
                other = World::from_bytes(&other.to_bytes()).expect("its own frame");
                other.set_simd(SimdLevel::Scalar).expect("every machine has it");
                assert_eq!(world.state_hash(), other.state_hash(), "member {member}, step {step}");
            }
        }
    }
}

/// Bars joined at random by hinges with limits and with motors that push on into them: nothing goes off. With two motors at their stops
/// and a light bar between heavy ones the search for what holds went round in circles, and what it let go last made energy: 16 of 600
/// arms got to over 25 m/s and more than one and a half times their speed in short steps, up to the speed limit of 400.
#[test]
fn arms_whose_motors_push_against_their_stops_do_not_go_off() {
    for member in 0..400 {
        let mut random = Random::new(member);
        let (mut world, dt) = game(&mut random);
        let count = 2 + random.below(6) as usize;
        let mut bars = vec![world.add_body(RigidBody::fixed()).expect("a wall")];
        for at in 0..count {
            let mass = 10.0_f32.powf(random.range(-1.0, 1.0));
            let (on, half) = (random.below(at as u64 + 1) as usize, random.range(0.15, 0.4));
            let x = world.body(bars[on]).expect("it is there").position().x as f32;
            let hinge = JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::new(-half, 0.0));
            let hinge = match random.below(3) {
                0 => hinge.limits(-0.5, 0.5),
                _ => hinge.limits(-1.0, 1.0).motor(3.0, 50.0),
            };
            bars.push(bar(&mut world, half, mass, x + 0.5 + half));
            world.add_joint(bars[on], bars[at + 1], hinge).expect("a hinge");
        }
        for step in 0..(3.0 / dt) as usize {
            world.step(dt);
            for bar in &bars {
                let speed = world.body(*bar).expect("it is there").velocity().length();
                assert!(speed < 50.0, "member {member}, step {step}: {speed} m/s");
            }
        }
    }
}

/// An arm with motors at rest in its hinges, strong enough, stays where it is. Of 100 such 48 sank by over a hundredth of their
/// length in ten seconds: a motor gave way by a speed, not by a place, where a tree's rows give way by the impulse that they carry.
#[test]
fn arms_that_are_held_do_not_sink() {
    let mut random = Random::new(7);
    for member in 0..40 {
        let (mut world, dt) = game(&mut random);
        world.settings.sleep = false;
        let (half, load) = (random.range(0.05, 1.0), 10.0_f32.powf(random.range(-1.0, 1.3)));
        let links = 2 + random.below(5) as usize;
        let mut last = world.add_body(RigidBody::fixed()).expect("a wall");
        let (mut at, mut place) = (Vec2::ZERO, Vec2::ZERO);
        for link in 0..links {
            let mass = if link + 1 == links { 1.0 + load } else { 1.0 };
            let next = bar(&mut world, half, mass, place.x + half);
            let hinge = JointDef::revolute().anchors(at, Vec2::new(-half, 0.0)).motor(0.0, 1e6);
            world.add_joint(last, next, hinge).expect("a motor");
            (last, at) = (next, Vec2::new(half, 0.0));
            place.x += 2.0 * half;
        }
        (0..(10.0 / dt) as usize).for_each(|_| world.step(dt));
        let end = common::position(&world, last) + Vec2::new(half, 0.0);
        let sunk = (end - place).length() / place.x;
        assert!(sunk < 1e-3, "member {member}: {sunk}");
    }
}

/// A board whose top is at 0, and boxes in a row on it, from `first` on, which have that mass together.
fn laden(world: &mut World, half: f32, x: f32, mass: f32, boxes: &[f32], side: f32) -> BodyId {
    let shape = |x, y| ShapeDef::new(rect(x, y)).friction(0.7);
    let board = RigidBody::dynamic().shape(shape(half, 0.05 * half)).mass(1.0);
    let board = world.add_body(board.position(Vec2::new(x, -0.05 * half))).expect("a board");
    for &x in boxes {
        let load = RigidBody::dynamic().shape(shape(side, side)).mass(mass / boxes.len() as f32);
        world.add_body(load.position(Vec2::new(x, side))).expect("a load");
    }
    board
}

/// A motor without speed in the one hinge of a drawbridge holds it with the boxes that lie on it, and all comes to rest: of 60, 35 rose
/// or sank, by up to .66 radians, or shook for ever.
#[test]
fn brakes_hold_drawbridges_with_loose_loads() {
    let (mut random, mut bad) = (Random::new(6), Vec::new());
    for member in 0..60 {
        let (mut world, dt) = game(&mut random);
        let size = 10.0_f32.powf(random.range(-0.7, 0.7));
        let mass = 10.0_f32.powf(random.range(0.5, 1.8));
        let times = 10.0_f32.powf(random.range(0.2, 2.0));
        let boxes = &[0.3, 0.7, 1.1, 1.5].map(|x| x * size)[..1 + random.below(4) as usize];
        let board = laden(&mut world, size, size, mass, boxes, 0.15 * size);
        let mean = boxes.iter().sum::<f32>() / boxes.len() as f32;
        let most = times * GRAVITY * (size + mass * mean);
        let wall = world.add_body(RigidBody::fixed()).expect("a wall");
        let hinge = JointDef::revolute().anchor_at(Vec2::new(0.0, -0.05 * size));
        world.add_joint(wall, board, hinge.motor(0.0, most)).expect("a motor");
        (0..(5.0 / dt) as usize).for_each(|_| world.step(dt));
        let board = world.body(board).expect("it is there");
        let angle = board.angle();
        if angle.abs() > 0.01 || board.is_awake() {
            bad.push((member, angle));
        }
    }
    assert!(bad.is_empty(), "{}: {bad:?}", bad.len());
}

/// A motor on the one slider of a lift moves it evenly under loose boxes: of 60, 15 were off their
/// speed by more than a hundredth of their size a second, at most .75.
#[test]
fn lifts_under_loose_loads_have_the_speed_of_their_motors() {
    let (mut random, mut bad) = (Random::new(7), Vec::new());
    for member in 0..60 {
        let (mut world, dt) = game(&mut random);
        let size = 10.0_f32.powf(random.range(-0.7, 0.7));
        let mass = 10.0_f32.powf(random.range(0.0, 2.0));
        let boxes = &[-0.8, -0.5, -0.2, 0.1, 0.4, 0.7].map(|x| x * size);
        let boxes = &boxes[..1 + random.below(6) as usize];
        let board = laden(&mut world, size, 0.0, mass, boxes, 0.1 * size);
        let most = 10.0_f32.powf(random.range(0.1, 2.0)) * (1.0 + mass) * GRAVITY;
        let speed = random.range(-1.0, 1.0) * size;
        let wall = world.add_body(RigidBody::fixed()).expect("a wall");
        let rail = JointDef::prismatic(Vec2::new(0.0, 1.0)).motor(speed, most);
        world.add_joint(wall, board, rail).expect("a motor");
        let mut other = world.clone();
        let mut most_off = 0.0_f32;
        for step in 0..(4.0 / dt) as usize {
            world.step(dt);
            let rise = world.body(board).expect("it is there").velocity().y;
            if step as f32 * dt > 1.5 {
                most_off = most_off.max((rise - speed).abs() / size);
            }
            if member < 3 {
                other.step(dt);
                other = World::from_bytes(&other.to_bytes()).expect("its own frame");
                other.set_simd(SimdLevel::Scalar).expect("every machine has it");
                assert_eq!(world.state_hash(), other.state_hash(), "member {member}, step {step}");
            }
        }
        if most_off > 0.01 {
            bad.push((member, most_off));
        }
    }
    assert!(bad.is_empty(), "{}: {bad:?}", bad.len());
}
