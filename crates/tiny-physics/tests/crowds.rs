//! Many springs on one body: nothing swings up, and soft ones are as soft as asked.

mod common;

use common::*;
use tiny_physics::{BodyId, BodyKind, JointDef, Locks, RigidBody, Vec2, World};

/// A web of springs of one kind between balls that pass through each other, without gravity.
struct Web {
    world: World,
    hertz: f32,
    damping: f32,
    ground: BodyId,
    balls: Vec<BodyId>,
}

impl Web {
    fn ball(&mut self, at: Vec2, mass: f32) -> BodyId {
        let body = RigidBody::dynamic().position(at).mass(mass).inertia(0.01 * mass);
        let ball = self.world.add_body(body).unwrap();
        self.balls.push(ball);
        ball
    }

    fn tie(&mut self, a: BodyId, b: BodyId) {
        let [p, q] = [a, b].map(|body| position(&self.world, body));
        self.tie_at(a, b, p, q);
    }

    fn tie_at(&mut self, a: BodyId, b: BodyId, p: Vec2, q: Vec2) {
        let spring = JointDef::distance(p.distance(q)).spring(self.hertz, self.damping);
        self.world.add_joint(a, b, spring.anchors_at(p, q)).unwrap();
    }
}

fn circle_of(count: u32, i: u32, radius: f32) -> Vec2 {
    let angle = core::f32::consts::TAU * i as f32 / count as f32;
    Vec2::new(angle.cos(), angle.sin()) * radius
}

/// One ball on springs to the ground over a part of a turn, a hub with spokes, a wheel, or a grid with diagonals.
fn web(kind: usize, random: &mut Random) -> Web {
    let mut world = World::new(Vec2::ZERO);
    world.settings.substeps = [1, 2, 4, 8][random.below(4) as usize];
    world.settings.sleep = false;
    let ground = world.add_body(RigidBody::fixed()).unwrap();
    let hertz = 2.0 * 60_f32.powf(random.range(0.0, 1.0));
    let damping = [0.0, 0.0, 0.1, 0.3, 1.0, 1.5][random.below(6) as usize];
    let ratio = [1.0_f32, 3.0, 10.0, 100.0][random.below(4) as usize];
    let mut web = Web { world, hertz, damping, ground, balls: Vec::new() };
    match kind {
        0 => {
            let hub = web.ball(Vec2::ZERO, 1.0);
            let count = 2 + random.below(31) as u32;
            let whole = [1, 2, 4][random.below(3) as usize] * count;
            for i in 0..count {
                web.tie_at(web.ground, hub, circle_of(whole, i, 1.0), Vec2::ZERO);
            }
        }
        1 | 2 => {
            let hub = web.ball(Vec2::ZERO, ratio.powf(random.range(0.0, 1.0)));
            let count = 3 + random.below(30) as u32;
            let mut mass = || ratio.powf(random.range(0.0, 1.0));
            let rim: Vec<_> =
                (0..count).map(|i| web.ball(circle_of(count, i, 1.0), mass())).collect();
            for i in 0..rim.len() {
                web.tie(hub, rim[i]);
                for next in (1..=2).filter(|_| kind == 2 && count > 5) {
                    web.tie(rim[i], rim[(i + next) % rim.len()]);
                }
            }
        }
        _ => {
            let [columns, rows] = [(); 2].map(|()| 3 + random.below(6) as i32);
            for i in 0..columns * rows {
                let (x, y) = (i % columns, i / columns);
                let ball =
                    web.ball(Vec2::new(x as f32, y as f32), ratio.powf(random.range(0.0, 1.0)));
                for (dx, dy) in [(-1, 0), (0, -1), (-1, -1), (1, -1)] {
                    if (0..columns).contains(&(x + dx)) && y + dy >= 0 {
                        web.tie(web.balls[((y + dy) * columns + x + dx) as usize], ball);
                    }
                }
            }
        }
    }
    web
}

/// Eight springs of 40 hertz and a damping ratio of a tenth flung a ball about at 226 m/s; of 160 hubs, wheels and grids with up to 32
/// springs a body 18 had more energy than at the start, up to ten million times.
#[test]
fn no_number_of_springs_on_a_body_makes_energy() {
    let mut random = Random::new(7);
    let mut bad = Vec::new();
    for case in 0..120 {
        let Web { mut world, hertz, damping, balls, .. } = web(case % 4, &mut random);
        for &ball in &balls {
            let speed = Vec2::new(random.range(-0.1, 0.1), random.range(-0.1, 0.1));
            world.body_mut(ball).unwrap().set_velocity(speed);
        }
        let dt = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 120.0, 1.0 / 240.0][random.below(4) as usize];
        let (start, mut most) = (energy(&world), 0.0_f64);
        for _ in 0..(3.0 / dt) as usize {
            world.step(dt);
            most = most.max(energy(&world) / start);
        }
        if most.is_nan() || most >= 1.2 {
            bad.push((case, hertz, damping, balls.len(), dt, world.settings.substeps, most));
        }
    }
    assert!(bad.is_empty(), "{} gain: {bad:.3?}", bad.len());
}

/// By the formula: springs side by side swing by the root of their number faster, and are damped as much more.
#[test]
fn soft_springs_on_a_body_swing_and_decay_as_asked() {
    let mut random = Random::new(8);
    for case in 0..40 {
        let count = 2 + random.below(31) as u32;
        let mut world = World::new(Vec2::ZERO);
        world.settings.sleep = false;
        let ground = world.add_body(RigidBody::fixed()).unwrap();
        let ball = world.add_body(RigidBody::dynamic().mass(2.0).inertia(1.0)).unwrap();
        let together = random.range(0.5, 4.0);
        let damping = random.range(0.0, 0.3);
        let root = (count as f32).sqrt();
        for _ in 0..count {
            let spring = JointDef::distance(10.0).spring(together / root, damping / root);
            let spring = spring.anchors_at(Vec2::new(-10.0, 0.0), Vec2::ZERO);
            world.add_joint(ground, ball, spring).unwrap();
        }
        let rate = core::f32::consts::TAU * together;
        world.body_mut(ball).unwrap().set_velocity(Vec2::X * (0.1 * rate));
        let swing = rate * (1.0 - damping * damping).sqrt();
        for i in 1..=(2.0 / together / DT) as usize {
            world.step(DT);
            let time = i as f32 * DT;
            let want = 0.1 * rate / swing * (-damping * rate * time).exp() * (swing * time).sin();
            let is = position(&world, ball).x;
            assert!(
                (is - want).abs() < 0.005,
                "case {case} of {count} at {time}: {is}, not {want}"
            );
        }
    }
}

/// How many springs act together follows from what a frame holds, whatever has been changed before: locks, masses, kinds, springs.
#[test]
fn what_is_read_goes_on_as_what_was_written() {
    let mut random = Random::new(9);
    for case in 0..60 {
        let mut world = World::new(Vec2::ZERO);
        world.settings.sleep = false;
        let hub = world.add_body(RigidBody::dynamic().mass(1.0).inertia(0.1)).unwrap();
        let mut joints = Vec::new();
        let balls: Vec<BodyId> = (0..8)
            .map(|k| {
                let (y, x) = (0.8 * k as f32 + random.range(0.0, 0.2)).sin_cos();
                let place = Vec2::new(x, y);
                let ball = RigidBody::dynamic().position(place).mass(random.range(0.5, 5.0));
                let ball = world.add_body(ball.inertia(0.1)).unwrap();
                let spring = JointDef::distance(1.0).spring(random.range(10.0, 60.0), 0.1);
                let spring = spring.anchors(Vec2::ZERO, place.perp() * 0.1);
                joints.push((world.add_joint(hub, ball, spring).unwrap(), spring));
                ball
            })
            .collect();
        world.body_mut(balls[0]).unwrap().set_velocity(Vec2::new(1.0, 2.0));
        (0..10).for_each(|_| world.step(DT));
        let ball = balls[random.below(8) as usize];
        let (joint, spring) = joints[random.below(8) as usize];
        match case % 5 {
            0 => world
                .body_mut(ball)
                .unwrap()
                .set_locks(Locks { rotation: true, ..Locks::default() }),
            1 => world.body_mut(ball).unwrap().set_mass(Some(40.0)).unwrap(),
            2 => world.body_mut(ball).unwrap().set_kind(BodyKind::Kinematic),
            3 => world.set_joint(joint, spring.spring(3.0, 0.5)).unwrap(),
            _ => drop(world.remove_joint(joint)),
        }
        if case % 2 == 0 {
            world.step(DT);
        }
        let mut read = World::from_bytes(&world.to_bytes()).unwrap();
        (0..30).for_each(|_| world.step(DT));
        (0..30).for_each(|_| read.step(DT));
        assert_eq!(world.state_hash(), read.state_hash(), "case {case}");
    }
}
