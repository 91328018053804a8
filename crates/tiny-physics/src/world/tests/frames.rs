//! Frames that contradict themselves are refused: what they say would have threads write the same, or walks leave lists.

use super::*;
use crate::describe::JointDef;
use crate::dynamics::{NULL, Slot};

/// Two crates that sleep on each other, two that swing from a floor.
fn sleepers() -> (World, [BodyId; 3]) {
    let mut world = world();
    let floor = add_ground(&mut world);
    let (lower, upper) =
        (add(&mut world, 0.0, 0.5, rect(0.5, 0.5)), add(&mut world, 0.0, 1.5, rect(0.5, 0.5)));
    run(&mut world, 120);
    assert!(!world.body(upper).unwrap().is_awake());
    let (left, right) =
        (add(&mut world, 9.0, 4.0, circle(0.2)), add(&mut world, 11.0, 4.0, circle(0.2)));
    world.add_joint(left, right, JointDef::distance(2.0)).unwrap();
    world.add_joint(floor, right, JointDef::distance(5.0)).unwrap();
    world.step(DT);
    (world, [floor, lower, upper])
}

#[track_caller]
fn refused(spoil: impl FnOnce(&mut State, [usize; 3])) {
    let (mut world, ids) = sleepers();
    World::from_bytes(&world.to_bytes()).expect("a frame as it was written");
    let indices = ids.map(|id| world.body_index(id).unwrap() as usize);
    spoil(&mut world.state, indices);
    assert!(World::from_bytes(&world.to_bytes()).is_err());
}

#[test]
fn a_short_list_is_refused() {
    refused(|state, _| state.bodies.swings.truncate(1));
}

#[test]
fn islands_that_run_into_themselves_are_refused() {
    refused(|state, [_, lower, upper]| {
        state.bodies.infos[upper].island_next = upper as u32;
        state.bodies.infos[lower].island_next = upper as u32;
    });
}

/// Two bodies awake twice would be one that two threads write.
#[test]
fn open_islands_are_refused() {
    refused(|state, [_, lower, _]| state.bodies.infos[lower].island_next = NULL);
    refused(|state, [_, _, upper]| state.bodies.infos[upper].island_next = NULL);
}

#[test]
fn ground_that_could_be_moved_is_refused() {
    refused(|state, [floor, ..]| state.bodies.rows[floor][Slot::INV_MASS] = 1.0);
    refused(|state, [_, lower, _]| state.bodies.rows[lower][Slot::INV_INERTIA] = -1.0);
}

#[test]
fn joints_of_one_colour_on_one_body_are_refused() {
    refused(|state, _| {
        let mut alive = state.bodies.infos.iter_mut().filter(|info| info.alive);
        alive.next_back().unwrap().joint_colours ^= 1 << 7;
    });
}

/// What has just come into a lane says nothing of what the lane held before.
#[test]
fn a_world_that_has_just_woken_is_the_same_from_its_frame() {
    for count in 1..24 {
        let mut world = world();
        add_ground(&mut world);
        let crates: Vec<BodyId> =
            (0..count).map(|i| add(&mut world, 1.2 * i as f32, 0.5, rect(0.5, 0.5))).collect();
        let awake = count.min(3);
        for &body in &crates[..awake] {
            world.body_mut(body).unwrap().set_can_sleep(false);
        }
        run(&mut world, 90);
        for &body in crates[awake..].iter().rev() {
            assert!(!world.body(body).unwrap().is_awake());
            world.body_mut(body).unwrap().wake();
        }
        let deepest = world.max_penetration();
        assert!(deepest < 0.02, "{count} crates lie {deepest} m deep");
        let again = World::from_bytes(&world.to_bytes()).unwrap();
        assert_eq!(again.state_hash(), world.state_hash());
        assert!(again.contacts().zip(world.contacts()).all(|(a, b)| a.normal == b.normal));
    }
}
