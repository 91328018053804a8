//! A steady step allocates nothing, on one thread and on two: an allocator that counts says so.
//!
//! Lists may grow until they have seen the most that a scene needs. So each scene runs for a while, goes back to
//! a saved frame and runs through the same steps again: the second time everything is large enough, and
//! whatever allocates still, allocates in every step for ever.
#![allow(unsafe_code, reason = "an allocator that counts")]

mod common;

use common::*;
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::SeqCst};
use tiny_physics::{BodyId, JointDef, RigidBody, ShapeDef, Vec2, World};

/// Counts what all threads ask for while it is told to: a step's threads are not this one alone.
struct Counting;

static ARMED: AtomicBool = AtomicBool::new(false);
static ALLOCATIONS: AtomicUsize = AtomicUsize::new(0);

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if ARMED.load(SeqCst) {
            ALLOCATIONS.fetch_add(1, SeqCst);
        }
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations while `work` runs.
fn allocations(work: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.load(SeqCst);
    ARMED.store(true, SeqCst);
    work();
    ARMED.store(false, SeqCst);
    ALLOCATIONS.load(SeqCst) - before
}

/// A scene: its name, its world, steps until the frame that is saved, steps from there on.
type Scene = (&'static str, fn() -> World, usize, usize);

const SCENES: [Scene; 10] = [
    ("pyramid that never sleeps", wakeful_pyramid, 60, 60),
    ("pyramid that falls asleep", || pyramid(10), 5, 120),
    ("pile", || mixed_pile(150, 4), 60, 150),
    ("pile without gravity that parts", parting, 2, 120),
    ("net of hinges", net, 30, 60),
    ("sleepers that are woken", woken_sleepers, 100, 200),
    ("rotor in a crowd", rotor, 60, 120),
    ("fast bodies and sensors", bullets_and_sensors, 5, 120),
    ("hooks", hooked, 60, 60),
    ("a hand in a wall", hand_in_a_wall, 60, 60),
];

fn wakeful_pyramid() -> World {
    let mut world = pyramid(12);
    world.settings.sleep = false;
    world
}

/// Overlapping bodies fly apart: contacts end in every step.
fn parting() -> World {
    let mut world = mixed_pile(100, 5);
    world.gravity = Vec2::new(0.0, 9.8);
    world
}

/// Hinges in both directions: more of a colour than one thread takes at a time.
fn net() -> World {
    let mut world = world();
    world.settings.sleep = false;
    let side = 24;
    let mut knots: Vec<BodyId> = Vec::new();
    for i in 0..side * side {
        let (row, column) = (i / side, i % side);
        let fixed = row == 0 && column % 8 == 0;
        let body = if fixed { RigidBody::fixed() } else { RigidBody::dynamic() };
        let place = Vec2::new(column as f32, -(row as f32));
        let knot = world.add_body(body.position(place).shape(circle(0.4))).unwrap();
        if row > 0 {
            let hinge = JointDef::revolute().anchors(Vec2::new(0.0, -0.5), Vec2::new(0.0, 0.5));
            world.add_joint(knots[i - side], knot, hinge).unwrap();
        }
        if column > 0 {
            let hinge = JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0));
            world.add_joint(knots[i - 1], knot, hinge.break_at(1.0e9, 1.0e9)).unwrap();
        }
        knots.push(knot);
    }
    world
}

/// Small stacks and a chain fall asleep; balls that come down later wake some of them.
fn woken_sleepers() -> World {
    let mut world = world_with_floor();
    for stack in 0..20 {
        for level in 0..4 {
            drop_at(&mut world, rect(0.5, 0.5), 3.0 * stack as f32 - 30.0, 0.5 + level as f32);
        }
        if stack % 4 == 0 {
            drop_at(&mut world, circle(0.4), 3.0 * stack as f32 - 30.0, 40.0 + stack as f32);
        }
    }
    let mut last = drop_at(&mut world, capsule(0.4, 0.1), 40.0, 0.1);
    for i in 1..6 {
        let link = drop_at(&mut world, capsule(0.4, 0.1), 40.0 + i as f32, 0.1);
        let hinge = JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0));
        world.add_joint(last, link, hinge).unwrap();
        last = link;
    }
    drop_at(&mut world, circle(0.4), 42.0, 50.0);
    world
}

/// A rotor with a motor stirs bodies between walls.
fn rotor() -> World {
    let mut world = mixed_pile(200, 6);
    let hub = Vec2::new(0.0, 3.0);
    let frame = world.add_body(RigidBody::fixed().position(hub)).unwrap();
    let blade = RigidBody::dynamic().position(hub).shape(rect(0.2, 2.5)).can_sleep(false);
    let blade = world.add_body(blade).unwrap();
    world.add_joint(frame, blade, JointDef::revolute().motor(5.0, 1.0e6)).unwrap();
    world
}

/// Bullets fly through sensors against walls, and hits are told.
fn bullets_and_sensors() -> World {
    let mut world = mixed_pile(30, 7);
    for y in [2.0, 4.0, 6.0] {
        let gate = ShapeDef::new(upright(3.0, 0.4)).sensor();
        world.add_body(RigidBody::fixed().position(Vec2::new(0.0, y)).shape(gate)).unwrap();
    }
    for i in 0..12 {
        let ball = ShapeDef::new(circle(0.1)).restitution(0.9).events();
        let place = Vec2::new(-4.0 + 0.6 * i as f32, 3.0 + 0.3 * i as f32);
        let body = RigidBody::dynamic().position(place).velocity(Vec2::new(90.0, 10.0)).bullet();
        world.add_body(body.shape(ball)).unwrap();
    }
    world
}

fn hooked() -> World {
    let mut world = mixed_pile(80, 8);
    world.set_pair_filter(|pair| pair.body_a != pair.body_b);
    world.set_pre_solve(|_, contact, rules| {
        if contact.normal.y < 0.0 {
            rules.friction = 0.5;
        }
    });
    world
}

/// The joint to a hand is torn in every step.
fn hand_in_a_wall() -> World {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let wall = RigidBody::fixed().position(Vec2::new(2.0, 0.0)).shape(rect(1.0, 5.0));
    world.add_body(wall).expect("a wall");
    let body = world.add_body(RigidBody::dynamic().shape(rect(0.3, 0.3))).expect("a body");
    let hand = RigidBody::kinematic().velocity(Vec2::new(0.5, 0.0));
    let hand = world.add_body(hand).expect("a hand");
    world.add_joint(hand, body, JointDef::revolute()).expect("a hinge");
    steps(&mut world, 120);
    world
}

/// One test alone in this file: another that runs beside it would be counted with it.
#[test]
fn a_step_allocates_nothing() {
    let counted = allocations(|| drop(std::hint::black_box(vec![1_u8; 100])));
    assert_eq!(counted, 1, "it does count");
    let mut failures = Vec::new();
    for (name, scene, warm_up, count) in SCENES {
        for threads in [1, 2] {
            let mut world = scene();
            world.set_threads(threads);
            steps(&mut world, warm_up);
            let frame = world.clone();
            steps(&mut world, count);
            let first_time = world.state_hash();
            // Which thread finds what is another in every run, so lists of threads may need some.
            let again = (0..5).map(|_| {
                world.clone_from(&frame);
                let allocated = allocations(|| steps(&mut world, count));
                assert_eq!(world.state_hash(), first_time, "{name}: not the same steps again");
                allocated
            });
            let allocated = again.min().unwrap_or(0);
            if allocated > 0 {
                failures.push(format!("{name}: {allocated} in {count} steps, {threads} threads"));
            }
        }
    }
    assert!(failures.is_empty(), "allocations:\n{}", failures.join("\n"));
}
