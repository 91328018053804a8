//! `World::memory` against an allocator that counts.
#![allow(unsafe_code, reason = "an allocator that counts")]

mod common;

use common::*;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use tiny_physics::{
    BodyId, BodyKind, JointDef, RigidBody, ShapeDef, Tile, TileForm, TileGrid, Vec2, World,
};

/// Counts the bytes that this thread has taken and not given back.
struct Counting;

thread_local! {
    static BYTES: Cell<usize> = const { Cell::new(0) };
}

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = BYTES.try_with(|bytes| bytes.set(bytes.get().wrapping_add(layout.size())));
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        let _ = BYTES.try_with(|bytes| bytes.set(bytes.get().wrapping_sub(layout.size())));
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A name and a world.
type Scene = (&'static str, fn() -> World);

/// A world with a bit of everything: joints in trees and in lanes, sensors, tiles, bouncing, sleepers, events.
fn everything() -> World {
    let mut world = mixed_pile(300, 5);
    let place = |i: usize| Vec2::new(0.5 * i as f32, 60.0);
    let links: Vec<BodyId> = (0..200)
        .map(|i| {
            let shape = ShapeDef::new(circle(0.2)).restitution(0.8).events();
            world.add_body(RigidBody::dynamic().position(place(i)).shape(shape)).unwrap()
        })
        .collect();
    for (i, pair) in links.windows(2).enumerate() {
        let spring = JointDef::distance(0.5).spring(3.0, 0.5);
        let def = if i < 100 { JointDef::revolute() } else { spring };
        world.add_joint(pair[0], pair[1], def).unwrap();
    }
    let sensor = RigidBody::fixed().shape(ShapeDef::new(rect(20.0, 5.0)).sensor());
    world.add_body(sensor.position(Vec2::new(0.0, 5.0))).unwrap();
    let mut grid = TileGrid::new(1.0, 64, 64, vec![Tile::new(TileForm::Full)]);
    grid.position = Vec2::new(-200.0, 0.0).into();
    (0..64).for_each(|x| (0..x).for_each(|y| grid.set(x, y, 1).unwrap()));
    world.add_tiles(grid).unwrap();
    world
}

/// Bytes by which the count may differ from the truth: what iterators and the like hold is no list.
const SLACK: usize = 2048;

#[test]
fn what_is_counted_is_what_is_held() {
    let scenes: [Scene; 3] =
        [("pyramid", || pyramid(20)), ("pile", || mixed_pile(1000, 4)), ("everything", everything)];
    for (name, build) in scenes {
        let before = BYTES.get();
        let mut world = build();
        for steps in [0, 1, 30, 300] {
            (0..steps).for_each(|_| world.step(DT));
            let taken = BYTES.get().wrapping_sub(before);
            let total = world.memory().total();
            let off = taken.abs_diff(total.held);
            assert!(
                off <= taken / 100 + SLACK,
                "{name}, {steps}: {total:?}, but {taken} are taken"
            );
            assert!(total.used <= total.held, "{name}, {steps}: {total:?}");
        }
        drop(world);
        assert!(BYTES.get().wrapping_sub(before) < SLACK, "{name}");
    }
}

/// Memory goes by what is in the world; what was removed leaves its place to what comes.
#[test]
fn memory_follows_bodies_and_contacts_and_is_used_again() {
    let mut world = mixed_pile(600, 4);
    (0..120).for_each(|_| world.step(DT));
    let memory = world.memory();
    let bodies = world.body_count();
    assert!((128..1024).contains(&(memory.bodies.used / bodies)), "{memory:?}");
    assert!(memory.constraints.used > 0 && memory.constraints.used < memory.graph.used);
    assert!(world.clone().memory().total().held < memory.total().held);
    let moves = |&id: &BodyId| world.body(id).unwrap().kind() == BodyKind::Dynamic;
    let ids: Vec<BodyId> = world.body_ids().filter(moves).collect();
    for &id in ids.iter().step_by(2) {
        let place = position(&world, id);
        world.remove_body(id).unwrap();
        drop_at(&mut world, circle(0.3), place.x, place.y);
    }
    let after = world.memory();
    assert_eq!(after.shapes.used, memory.shapes.used);
    // Of what is removed, nobody remembers that it was pressed: a body and a mass.
    let less = memory.bodies.used - after.bodies.used;
    assert!(less.is_multiple_of(8) && less < bodies, "{less} bytes");
}
