//! Joints and contacts that meet: they add no energy, so that what should rest does, and what should be borne is.

mod common;

use common::energy;
use tiny_physics::{
    BodyId, JointDef, Polygon, RigidBody, Rot, Settings, Shape, ShapeDef, Vec2, World,
};

const DT: f32 = 1.0 / 60.0;

/// Numbers from a seed, in a range.
struct Random(u64);

impl Random {
    fn range(&mut self, low: f32, high: f32) -> f32 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 40) as f32 / (1_u64 << 24) as f32)
    }
}

fn rect(x: f32, y: f32) -> Shape {
    Polygon::rect(x, y).expect("positive").into()
}

fn disk(radius: f32) -> Shape {
    Shape::circle(radius).expect("positive")
}

/// A straight chain of links with round ends from a point on, in a direction; its links.
fn chain(world: &mut World, from: Vec2, along: Vec2, links: usize, length: f32) -> Vec<BodyId> {
    let half = 0.5 * length;
    let (a, b) = (Vec2::new(-half, 0.0), Vec2::new(half, 0.0));
    let mut ids: Vec<BodyId> = Vec::new();
    for i in 0..links {
        let middle = from + along * (length * (i as f32 + 0.5));
        let link = RigidBody::dynamic().position(middle).angle(along.y.atan2(along.x));
        let link = link.can_sleep(false).shape(Shape::Capsule { a, b, radius: 0.05 });
        let link = world.add_body(link).unwrap();
        if let Some(&before) = ids.last() {
            world.add_joint(before, link, JointDef::revolute().anchors(b, a)).unwrap();
        }
        ids.push(link);
    }
    ids
}

#[test]
fn nets_of_ropes_come_to_rest() {
    let mut random = Random(1);
    for _ in 0..3 {
        let (size, pitch) = (random.range(12.0, 24.0) as usize, random.range(0.25, 0.5));
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let frame = world.add_body(RigidBody::fixed()).unwrap();
        let mut balls: Vec<BodyId> = Vec::new();
        for i in 0..size * size {
            let place = Vec2::new((i % size) as f32, -((i / size) as f32)) * pitch;
            let ball = RigidBody::dynamic().position(place).can_sleep(false);
            balls.push(world.add_body(ball.shape(disk(0.2 * pitch))).unwrap());
            for before in [(i % size > 0).then_some(1), (i >= size).then_some(size)] {
                let Some(before) = before else { continue };
                world.add_joint(balls[i - before], balls[i], JointDef::rope(pitch)).unwrap();
            }
        }
        for corner in [0, size - 1] {
            let hook =
                JointDef::revolute().anchors(Vec2::new(corner as f32 * pitch, 0.0), Vec2::ZERO);
            world.add_joint(frame, balls[corner], hook).unwrap();
        }
        let mut fastest = 0.0_f32;
        for step in 0..1800 {
            world.step(DT);
            if step >= 1740 {
                let speeds = world.bodies().map(|body| body.velocity().length());
                fastest = speeds.fold(fastest, f32::max);
            }
        }
        assert!(fastest < 0.01, "a net of {size} x {size}, {pitch} m: {fastest} m/s");
    }
}

/// Light planks under crates fifteen to fifty times as heavy that fall on them all at once.
#[test]
fn crates_that_fall_on_bridges_stay_there() {
    let mut random = Random(5);
    let (mut fallen, mut count) = (0, 0);
    for _ in 0..10 {
        let (planks, half) = (random.range(24.0, 46.0) as usize, random.range(0.2, 0.35));
        let (size, mass) = (random.range(0.15, 0.35), random.range(1.0, 4.0));
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let posts = world.add_body(RigidBody::fixed()).unwrap();
        let end = half * planks as f32;
        let (mut before, mut anchor) = (posts, Vec2::new(-end, 0.0));
        let mut ids = Vec::new();
        for i in 0..planks {
            let place = Vec2::new(half * (2 * i + 1) as f32 - end, 0.0);
            let plank = RigidBody::dynamic().position(place).shape(rect(half, 0.07));
            let plank = world.add_body(plank).unwrap();
            let hinge = JointDef::revolute().anchors(anchor, Vec2::new(-half, 0.0));
            world.add_joint(before, plank, hinge).unwrap();
            (before, anchor) = (plank, Vec2::new(half, 0.0));
            ids.push(plank);
        }
        let hinge = JointDef::revolute().anchors(anchor, Vec2::new(end, 0.0));
        world.add_joint(before, posts, hinge).unwrap();
        let crates: Vec<BodyId> = (0..20)
            .map(|i| {
                let (column, row) = ((i % 10) as f32 - 4.5, (i / 10) as f32);
                let place = Vec2::new(3.0 * size * column, 0.3 + size * (1.0 + 3.0 * row));
                let body = RigidBody::dynamic().position(place).shape(rect(size, size)).mass(mass);
                world.add_body(body).unwrap()
            })
            .collect();
        for _ in 0..300 {
            world.step(DT);
        }
        let at = |&id: &BodyId| world.body(id).unwrap().position();
        let deepest = ids.iter().map(|id| at(id).y).fold(0.0, f32::min);
        fallen += crates.iter().filter(|id| at(id).y < deepest - 0.5).count();
        count += crates.len();
    }
    assert!(fallen * 50 <= count, "{fallen} of {count} crates fell through");
}

/// Half of a chain lies on a table, a weight hangs from the other half: what it swings with becomes less.
#[test]
fn a_chain_over_an_edge_comes_to_rest() {
    let mut random = Random(9);
    let mut withheld = 0.0;
    for member in 0..6 {
        let (half, length, mass) = match member {
            0 => (12, 0.25, 1.0),
            _ => {
                (random.range(7.0, 13.0) as usize, random.range(0.2, 0.35), random.range(0.5, 5.0))
            }
        };
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let table = RigidBody::fixed().position(Vec2::new(-5.0, -1.0)).shape(rect(5.0, 1.0));
        let table = world.add_body(table).unwrap();
        let start = Vec2::new(-(half as f32) * length, 0.05);
        let lying = chain(&mut world, start, Vec2::X, half, length);
        let hanging = chain(&mut world, Vec2::new(0.06, 0.0), -Vec2::Y, half, length);
        let (a, b) = (Vec2::new(-0.5 * length, 0.0), Vec2::new(0.5 * length, 0.0));
        let ends =
            [(table, lying[0], start + Vec2::new(5.0, 1.0)), (lying[half - 1], hanging[0], b)];
        for (body, link, anchor) in ends {
            world.add_joint(body, link, JointDef::revolute().anchors(anchor, a)).unwrap();
        }
        let place = Vec2::new(0.06, -length * half as f32 - 0.2);
        let weight = RigidBody::dynamic().position(place).can_sleep(false).shape(rect(0.2, 0.2));
        let weight = world.add_body(weight.mass(mass)).unwrap();
        let hook = JointDef::revolute().anchors(b, Vec2::new(0.0, 0.2));
        world.add_joint(hanging[half - 1], weight, hook).unwrap();
        let (mut sum, mut count) = (0.0, 0.0);
        for step in 0..1200 {
            world.step(DT);
            withheld += world.stats().withheld_energy;
            if step >= 600 {
                let speeds = hanging.iter().map(|&id| world.body(id).unwrap().velocity());
                sum += speeds.map(|v| v.length_sq()).sum::<f32>();
                count += hanging.len() as f32;
            }
        }
        let speed = (sum / count).sqrt();
        assert!(speed < 0.07, "{half} links of {length} m, {mass} kg: {speed} m/s");
    }
    assert!(withheld > 0.0, "nothing was withheld");
}

/// A chain among balls where nothing pulls: what is withheld takes no momentum but for rounding.
#[test]
fn what_floats_keeps_its_momenta() {
    for seed in 0..40 {
        let mut random = Random(seed);
        let mut world = World::new(Vec2::ZERO);
        chain(&mut world, Vec2::new(-2.5, 0.0), Vec2::X, 20, 0.25);
        for i in 0..12 {
            let place = Vec2::new(0.5 * i as f32 - 2.75, 0.4);
            let velocity = Vec2::new(random.range(-1.0, 1.0), random.range(-3.0, -1.0));
            let ball = RigidBody::dynamic().position(place).velocity(velocity).can_sleep(false);
            world.add_body(ball.shape(disk(0.2)).mass(random.range(0.5, 3.0))).unwrap();
        }
        let momenta = |world: &World| {
            let mut sums = [0.0_f64; 3];
            for body in world.bodies() {
                let (p, v, mass) = (body.position_f64(), body.velocity(), f64::from(body.mass()));
                let (x, y) = (f64::from(v.x), f64::from(v.y));
                let spin = f64::from(body.inertia()) * f64::from(body.angular_velocity());
                let own = [mass * x, mass * y, mass * (p.x * y - p.y * x) + spin];
                sums.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
            }
            sums
        };
        let (start, first) = (momenta(&world), energy(&world));
        let mut highest = first;
        for _ in 0..300 {
            world.step(DT);
            highest = highest.max(energy(&world));
        }
        let off: Vec<f64> = start.iter().zip(momenta(&world)).map(|(a, b)| (a - b).abs()).collect();
        // Rounding goes with what there is of it: 45 kg m/s along y.
        let rounding = 6.0e-6 * start[1].abs();
        assert!(
            off[0] < 1e-4 && off[1] < rounding && off[2] < 0.05,
            "seed {seed}: {start:?}, off {off:?}"
        );
        assert!(highest < 1.01 * first, "seed {seed}: {highest} of {first} J");
    }
}

/// A pulley hangs from the ground: its pulls on the two ends have a sum and a moment.
#[test]
fn a_pulley_turns_nothing_and_brakes_nothing() {
    let mut random = Random(3);
    for _ in 0..10 {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let (left, right) = (random.range(1.0, 4.0), random.range(1.0, 4.0));
        let weight = random.range(2.5, 6.0);
        let box_of = |x: f32, y: f32, mass: f32| {
            RigidBody::dynamic().position(Vec2::new(x, y)).shape(rect(0.5, 0.25)).mass(mass)
        };
        let cage = world.add_body(box_of(-left, 5.0, 1.0)).unwrap();
        let load = world.add_body(box_of(-left, 5.5, 1.0)).unwrap();
        let counter = world.add_body(box_of(right, 5.0, weight)).unwrap();
        let (a, b) = (Vec2::new(-left, 20.0), Vec2::new(right, 20.0));
        world.add_joint(cage, counter, JointDef::pulley(a, b, 30.0)).unwrap();
        for _ in 0..40 {
            world.step(DT);
        }
        let time = 40.0 * DT;
        let expected = 10.0 * (weight - 2.0) / (weight + 2.0) * time;
        let speed = -world.body(counter).unwrap().velocity().y;
        assert!((speed - expected).abs() < 0.02 * expected, "{weight}: {speed} for {expected}");
        for id in [cage, load, counter] {
            let spin = world.body(id).unwrap().angular_velocity();
            assert!(spin.abs() < 1.0e-3, "{left} {right} {weight}: {spin}");
        }
    }
}

/// What gives way is what can move: a body that is locked against turning has no spin to give.
#[test]
fn the_guard_moves_nothing_that_is_locked() {
    let mut random = Random(5);
    for _ in 0..20 {
        let mut world = World::new(Vec2::ZERO);
        let mut locked = Vec::new();
        for i in 0..6 {
            let place = Vec2::new(0.9 * i as f32, random.range(-0.3, 0.3));
            let body = RigidBody::dynamic().position(place).shape(rect(0.5, 0.5));
            let body = body.velocity(Vec2::new(random.range(-6.0, 6.0), random.range(-6.0, 6.0)));
            let body = if i % 2 == 0 { body.lock_rotation() } else { body.angular_velocity(5.0) };
            let id = world.add_body(body).unwrap();
            if i % 2 == 0 {
                locked.push(id);
            }
        }
        let ids: Vec<BodyId> = world.body_ids().collect();
        for pair in ids.windows(2).step_by(2) {
            let joint = JointDef::revolute().anchor_at(Vec2::new(random.range(0.0, 5.0), 0.5));
            world
                .add_joint(pair[0], pair[1], JointDef { collide_connected: true, ..joint })
                .unwrap();
        }
        for _ in 0..120 {
            world.step(DT);
            for &id in &locked {
                assert_eq!(world.body(id).unwrap().angular_velocity(), 0.0);
            }
        }
    }
}

/// Seconds until a plank that is hinged to the ground at its middle has tipped, beside the same with its two crates welded on: 1 is right.
/// The crates are 3 to 100 times as heavy as the plank, which is out of balance by 10 to 30 %.
fn tips_in_time(random: &mut Random, limit: Option<f32>) -> f32 {
    let rate = [60.0, 60.0, 120.0, 240.0][random.range(0.0, 4.0) as usize];
    let substeps = random.range(2.0, 8.9) as u32;
    let (unit, pull) = (0.1 * 100.0_f32.powf(random.range(0.0, 1.0)), random.range(1.6, 25.0));
    let down = Vec2::new(0.0, -pull);
    let arms = [-random.range(0.5, 1.7), random.range(0.5, 1.7)].map(|arm| arm * unit);
    let heavier = -arms[0] / arms[1] * random.range(1.1, 1.3);
    let ratio = 3.0 * 33.0_f32.powf(random.range(0.0, 1.0));
    let most = 25.0 * (unit / pull).sqrt();
    let [loose, welded] = [false, true].map(|weld| {
        let settings = Settings { substeps, length_unit: unit, ..Settings::default() };
        let mut world = World::with_settings(down, settings);
        let ground = world.add_body(RigidBody::fixed()).unwrap();
        let plank = RigidBody::dynamic().mass(0.5 * (1.0 + heavier) / ratio);
        let plank = world.add_body(plank.shape(rect(2.0 * unit, 0.05 * unit))).unwrap();
        let mut hinge = JointDef::revolute();
        if let Some(limit) = limit {
            hinge = hinge.limits(-limit, limit);
        }
        world.add_joint(ground, plank, hinge).unwrap();
        for (x, mass) in [(arms[0], 1.0), (arms[1], heavier)] {
            let place = Vec2::new(x, 0.25 * unit);
            let load = RigidBody::dynamic().position(place).mass(mass);
            let load = world.add_body(load.shape(rect(0.2 * unit, 0.2 * unit))).unwrap();
            if weld {
                world.add_joint(plank, load, JointDef::weld().anchors(place, Vec2::ZERO)).unwrap();
            }
        }
        let mut time = 0.0;
        while time < most && world.body(plank).unwrap().angle() > -0.25 {
            world.step(1.0 / rate);
            time += 1.0 / rate;
        }
        time
    });
    loose / welded
}

#[test]
fn seesaws_tip_under_loose_loads_as_under_welded_ones() {
    let mut random = Random(4);
    let times: Vec<f32> = (0..80)
        .map(|i| {
            let limit = random.range(0.27, 1.0);
            tips_in_time(&mut random, (i % 2 == 1).then_some(limit))
        })
        .collect();
    let off: Vec<&f32> = times.iter().filter(|&time| !(0.9..1.15).contains(time)).collect();
    assert!(off.len() <= 4, "{} of 80: {off:?}", off.len());
}

#[test]
fn buckets_swing_on_with_loose_crates() {
    let mut random = Random(5);
    for _ in 0..12 {
        let (length, count) = (random.range(1.0, 3.0), random.range(1.0, 3.9) as usize);
        let (swing, ratio) = (random.range(0.2, 0.5), random.range(10.0, 60.0));
        let mut world = World::new(Vec2::new(0.0, -9.8));
        let ground = world.add_body(RigidBody::fixed()).unwrap();
        let bucket = RigidBody::dynamic().position(Vec2::new(0.0, -length)).mass(1.0);
        let wall =
            |x: f32| Polygon::turned_rect(0.05, 0.25, Vec2::new(x, 0.25), Rot::IDENTITY).unwrap();
        let bucket = bucket.shape(rect(0.5, 0.05)).shape(Shape::from(wall(-0.5)));
        let bucket = world.add_body(bucket.shape(Shape::from(wall(0.5)))).unwrap();
        let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(0.0, length));
        world.add_joint(ground, bucket, hinge).unwrap();
        let half = if count > 1 { 0.12 } else { 0.2 };
        let mut ids = vec![bucket];
        for i in 0..count {
            let x = 0.28 * (i as f32 - 0.5 * (count - 1) as f32);
            let place = Vec2::new(x, 0.05 + half - length);
            let load = RigidBody::dynamic().position(place).mass(ratio / count as f32);
            ids.push(world.add_body(load.shape(rect(half, half))).unwrap());
        }
        let turn = swing * (9.8 / length).sqrt();
        for id in ids {
            let mut body = world.body_mut(id).unwrap();
            let at = body.position();
            body.set_velocity(Vec2::new(-at.y, at.x) * turn);
            body.set_angular_velocity(turn);
        }
        let (mut first, mut last) = (0.0_f32, 0.0_f32);
        for step in 0..600 {
            world.step(DT);
            let x = world.body(bucket).unwrap().position().x.abs();
            if step < 150 {
                first = first.max(x);
            } else if step >= 420 {
                last = last.max(x);
            }
        }
        assert!(last > 0.9 * first, "{count} crates of {ratio} on {length} m: {first} and {last}");
    }
}

/// Doors that begin beyond their limits behind a peg come no further than to it, and stay on their hinges.
#[test]
fn doors_that_are_blocked_beyond_their_limits_stay_on_their_hinges() {
    let mut random = Random(6);
    for _ in 0..60 {
        let unit = 0.1 * 100.0_f32.powf(random.range(0.0, 1.0));
        let substeps = random.range(2.0, 8.9) as u32;
        let settings = Settings { substeps, length_unit: unit, ..Settings::default() };
        let mut world = World::with_settings(Vec2::ZERO, settings);
        let nail = world.add_body(RigidBody::fixed()).unwrap();
        let (upper, beyond) = (random.range(-0.8, 0.8), random.range(0.05, 1.0));
        let turned = Rot::from_angle(upper + beyond);
        let door = RigidBody::dynamic().shape(rect(unit, 0.05 * unit)).angle(upper + beyond);
        let door = world.add_body(door.position(turned.rotate(Vec2::new(unit, 0.0)))).unwrap();
        let (at, radius) = (random.range(0.3, 1.9), random.range(0.1, 0.3));
        let peg = turned.rotate(Vec2::new(at * unit, -(0.05 + radius) * unit));
        let peg = RigidBody::fixed().position(peg).shape(disk(radius * unit));
        world.add_body(peg).unwrap();
        let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-unit, 0.0));
        world.add_joint(nail, door, hinge.limits(-1.0, upper)).unwrap();
        let rate = [30.0, 60.0, 120.0][random.range(0.0, 3.0) as usize];
        for _ in 0..180 {
            world.step(1.0 / rate);
            let door = world.body(door).unwrap();
            let gap = door.position() - door.rotation().rotate(Vec2::new(unit, 0.0));
            let deep = (upper + beyond - door.angle()) * at;
            let members = format!("{upper} + {beyond}, {at}, {rate} hertz, {substeps} substeps");
            assert!(gap.length() < 0.01 * unit, "open by {} of {unit}: {members}", gap.length());
            assert!(deep < 0.01, "{deep} of {radius} deep: {members}");
        }
    }
}

fn rough(x: f32, y: f32) -> ShapeDef {
    ShapeDef::new(rect(x, y)).friction(0.9)
}

/// Seesaws that have tipped under loads of 3 to 100 times their mass rest on their stops.
#[test]
fn laden_seesaws_rest_on_their_stops() {
    let mut random = Random(7);
    for _ in 0..40 {
        let (substeps, ratio) = (random.range(1.0, 8.9) as u32, random.range(3.0, 100.0));
        let settings = Settings { substeps, ..Settings::default() };
        let mut world = World::with_settings(Vec2::new(0.0, -9.8), settings);
        let ground = world.add_body(RigidBody::fixed()).unwrap();
        let (half, limit) = (random.range(1.0, 3.0), random.range(0.15, 0.6));
        let plank = RigidBody::dynamic().mass(1.0).shape(rough(half, 0.05));
        let plank = world.add_body(plank).unwrap();
        world.add_joint(ground, plank, JointDef::revolute().limits(-limit, limit)).unwrap();
        let arms = [-random.range(0.3, 0.8), random.range(0.3, 0.8)].map(|arm| arm * half);
        let heavier = -arms[0] / arms[1] * random.range(1.15, 1.6);
        let mut all = vec![plank];
        for (x, part) in [(arms[0], 0.5), (arms[1], 0.5 * heavier)] {
            let load = RigidBody::dynamic().position(Vec2::new(x, 0.25)).mass(part * ratio);
            all.push(world.add_body(load.shape(rough(0.2, 0.2))).unwrap());
        }
        for step in 0..600 {
            world.step(DT);
            let beyond = world.body(plank).unwrap().angle().abs() - limit;
            assert!(beyond < 0.01, "{ratio} times, {substeps} substeps: {beyond} beyond");
            for &id in all.iter().filter(|_| step >= 540) {
                let body = world.body(id).unwrap();
                let falls = body.position().y < -half;
                let speed = body.velocity().length();
                assert!(falls || speed < 0.01, "{ratio} times, {substeps} substeps: {speed} m/s");
            }
        }
    }
}

/// A limit that is moved takes what lies on the body with it, as long as nothing that stands still is in the way.
#[test]
fn limits_that_are_moved_lift_what_lies_there() {
    for (turn, load) in [(0.15, 100.0), (0.3, 30.0), (0.5, 100.0), (1.0, 10.0), (1.0, 100.0)] {
        let mut world = World::new(Vec2::new(0.0, -9.8));
        let wall = world.add_body(RigidBody::fixed()).unwrap();
        let arm = RigidBody::dynamic().mass(1.0).position(Vec2::new(1.0, 0.0));
        let arm = world.add_body(arm.shape(rough(1.0, 0.05))).unwrap();
        let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-1.0, 0.0));
        world.add_joint(wall, arm, hinge.limits(turn, turn + 1.0)).unwrap();
        let load = RigidBody::dynamic().mass(load).position(Vec2::new(1.2, 0.26));
        world.add_body(load.shape(rough(0.2, 0.2))).unwrap();
        for _ in 0..240 {
            world.step(DT);
        }
        let angle = world.body(arm).unwrap().angle();
        assert!((angle - turn).abs() < 0.01, "{angle} of {turn}");
    }
}
