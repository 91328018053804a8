//! Handles: those of another world, and those of a world that has lived very long.

use super::*;
use crate::describe::JointDef;
use crate::error::Error;

/// A world with some bodies and joints, the first bodies gone again.
fn used_world(bodies: usize, gone: usize) -> (World, Vec<BodyId>, Vec<JointId>) {
    let mut world = world();
    let add = |i| add(&mut world, i as f32, 1.0, circle(0.4));
    let ids: Vec<_> = (0..bodies).map(add).collect();
    let join = |pair: &[BodyId]| world.add_joint(pair[0], pair[1], JointDef::distance(1.0));
    let joints: Vec<_> = ids.windows(2).map(join).map(Result::unwrap).collect();
    ids[..gone].iter().for_each(|&id| world.remove_body(id).unwrap());
    (world, ids, joints)
}

/// Every function that takes a handle, with those of another world: refused by name, or they mean what has
/// the same place and generation here. The world stays sound and goes on.
#[test]
fn handles_of_another_world_are_refused_or_mean_what_is_in_their_place() {
    let (_, strangers, strange_joints) = used_world(40, 20);
    let (mut world, own, _) = used_world(10, 4);
    let mut refused = 0;
    for &id in &strangers {
        let known = own.contains(&id) && world.body(id).is_some();
        assert_eq!(world.body(id).is_some(), known, "{id}");
        assert_eq!(world.body_mut(id).is_some(), known, "{id}");
        let joined = world.add_joint(id, own[9], JointDef::revolute());
        let shaped = world.add_shape(id, circle(0.1));
        if !known {
            refused += 1;
            let name = id.to_string();
            assert_eq!(joined, Err(Error::StaleHandle { handle: name.clone() }));
            assert_eq!(shaped, Err(Error::StaleHandle { handle: name.clone() }));
            assert_eq!(world.remove_body(id), Err(Error::StaleHandle { handle: name }));
        }
        world.validate().unwrap();
    }
    assert_eq!(refused, 40 - 6, "six bodies of this world have the places of strangers");
    for id in strange_joints {
        let _ = world.set_joint(id, JointDef::distance(2.0));
        let _ = world.remove_joint(id);
        world.validate().unwrap();
    }
    (0..10).for_each(|_| world.step(DT));
    world.validate().unwrap();
}

/// Found by fuzzing: `validate` took the last generation for a mistake. It is one like any other.
#[test]
fn the_last_generation_is_one_like_any_other() {
    let (mut world, ids, _) = used_world(3, 0);
    let index = ids[0].index;
    world.state.bodies.infos[index as usize].generation = u32::MAX;
    let id = BodyId::new(index, u32::MAX);
    world.validate().unwrap();
    assert!(world.body(id).is_some() && world.body(ids[0]).is_none());
    let copy = World::from_bytes(&world.to_bytes()).unwrap();
    assert!(copy.body(id).is_some());
    world.remove_body(id).unwrap();
    world.validate().unwrap();
}
