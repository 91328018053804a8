//! Scenes play on a host that only keeps books.

use std::collections::BTreeMap;
use tiny_physics::{DVec2, JointDef, RigidBody, Vec2};
use tiny_physics_scenes::{Host, Options, Player, find};

/// A host without physics: bodies move with their velocity.
#[derive(Default)]
struct Books {
    bodies: BTreeMap<usize, RigidBody>,
    joints: BTreeMap<usize, (usize, usize)>,
    next: usize,
    woken: Vec<usize>,
    queries: usize,
    blocked: bool,
}

impl Books {
    fn number(&mut self) -> usize {
        self.next += 1;
        self.next
    }
}

impl Host for Books {
    fn add_body(&mut self, body: &RigidBody) -> usize {
        let number = self.number();
        self.bodies.insert(number, body.clone());
        number
    }

    fn remove_body(&mut self, body: usize) {
        self.bodies.remove(&body).expect("a removed body was there");
        self.joints.retain(|_, (a, b)| *a != body && *b != body);
    }

    fn add_joint(&mut self, a: usize, b: usize, _: &JointDef) -> usize {
        assert!(self.bodies.contains_key(&a) && self.bodies.contains_key(&b));
        let number = self.number();
        self.joints.insert(number, (a, b));
        number
    }

    fn remove_joint(&mut self, joint: usize) {
        self.joints.remove(&joint).expect("a removed joint was there");
    }

    fn position(&self, body: usize) -> DVec2 {
        self.bodies[&body].position
    }

    fn velocity(&self, body: usize) -> Vec2 {
        self.bodies[&body].velocity
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        self.bodies.get_mut(&body).unwrap().velocity = velocity;
    }

    fn is_awake(&self, body: usize) -> bool {
        self.bodies[&body].awake
    }

    fn wake(&mut self, body: usize) {
        self.bodies.get_mut(&body).unwrap().awake = true;
        self.woken.push(body);
    }

    fn step(&mut self, dt: f32) {
        for body in self.bodies.values_mut() {
            if self.blocked {
                body.velocity = Vec2::ZERO;
            }
            body.position.x += f64::from(body.velocity.x * dt);
        }
    }

    fn ray_cast(&mut self, _: Vec2, _: Vec2, _: u64) -> Option<f32> {
        self.queries += 1;
        None
    }
}

fn player(name: &str, options: Options) -> Player<Books> {
    Player::new(&find(name).unwrap().build(options), Books::default())
}

#[test]
fn rain_fills_its_columns_and_recycles_them() {
    let mut player = player("rain", Options::default());
    for _ in 0..320 {
        player.step();
    }
    let full = |player: &Player<Books>| (player.host().bodies.len(), player.host().joints.len());
    assert_eq!(full(&player), (11_001, 10_000), "40 columns of 25 humans");
    let shapes: usize = player.host().bodies.values().map(|b| b.shapes.len()).sum();
    assert_eq!(shapes, 15_505);
    let numbers = player.host().next;
    player.step();
    assert_eq!(full(&player), (11_001, 10_000));
    assert_eq!(player.host().next, numbers + 25 * 21, "one column was replaced");
}

#[test]
fn rain_groups_share_a_filter_group_by_place() {
    let mut player = player("rain", Options::default().size(1));
    player.step();
    let groups: Vec<i32> =
        player.host().bodies.values().skip(1).map(|b| b.shapes[0].filter.group).collect();
    assert_eq!(groups.len(), 5 * 5 * 11);
    let by_human: Vec<i32> = groups.chunks(11).map(|bones| bones[0]).collect();
    assert_eq!(by_human[..10], [-1, -2, -3, -4, -5, -1, -2, -3, -4, -5]);
}

#[test]
fn sleepers_are_woken_one_a_step() {
    let mut player = player("sleep", Options::default().size(3));
    let sleepers: Vec<usize> = [1, 7].map(|i| player.bodies()[i]).to_vec();
    for body in &sleepers {
        player.host_mut().bodies.get_mut(body).unwrap().awake = false;
    }
    player.step();
    assert_eq!(player.host().woken, sleepers[..1]);
    player.step();
    player.step();
    assert_eq!(player.host().woken, sleepers);
}

#[test]
fn walkers_turn_where_they_are_held_up() {
    let mut player = player("tiles", Options::default().size(10));
    let walker = *player.bodies().last().unwrap();
    player.step();
    player.step();
    let speed = player.host().velocity(walker).x;
    assert_eq!(speed, -6.0, "an odd place begins to the left and goes on");
    player.host_mut().blocked = true;
    player.step();
    player.host_mut().blocked = false;
    player.step();
    assert_eq!(player.host().velocity(walker).x, 6.0);
}

#[test]
fn terrain_moves_on_and_asks() {
    let mut player = player("tile_world", Options::default().size(20));
    let leftmost = player.bodies()[0];
    for _ in 0..3 {
        player.step();
    }
    assert_eq!(player.host().bodies.len(), 20);
    assert!(!player.host().bodies.contains_key(&leftmost));
    let ends = player.host().bodies.values().map(|b| b.position.x);
    assert_eq!(ends.fold(f64::MIN, f64::max), -12_000.0 + 22.0 * 10.0);
    assert_eq!(player.host().queries, 1500);
}

#[test]
fn the_paddle_turns() {
    let mut player = player("queries", Options::default().size(1));
    let paddle = *player.bodies().last().unwrap();
    let mut turns = 0;
    let mut speed = 5.0;
    for _ in 0..900 {
        player.step();
        let now = player.host().velocity(paddle).x;
        turns += usize::from(now != speed);
        speed = now;
    }
    assert_eq!(turns, 2, "35 m at 5 m/s are 420 steps");
    assert_eq!(player.host().queries, 900 * 2000);
}

#[test]
fn a_player_ends_after_its_steps() {
    let mut player = player("newton_cradle", Options::default());
    while !player.is_done() {
        player.step();
    }
    assert_eq!(player.steps_done(), 600);
    assert_eq!((player.bodies().len(), player.joints().len()), (6, 5));
}
