//! Paces: which islands are refined, and that changing pace disturbs nothing.

use super::*;
use crate::dynamics::{PACES, PLAIN};

const DT: f32 = 1.0 / 60.0;
/// Paces of twice and of four times the substeps.
const TWOFOLD: usize = 1;
const FOURFOLD: usize = 2;

fn crate_at(x: f64, y: f64, density: f32) -> RigidBody {
    let square = Shape::rect(0.5, 0.5).unwrap();
    RigidBody::dynamic().shape(ShapeDef::new(square).density(density)).position(DVec2::new(x, y))
}

fn floored() -> World {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let floor = Shape::rect(50.0, 1.0).unwrap();
    world.add_body(RigidBody::fixed().shape(floor).position(Vec2::new(0.0, -1.0))).unwrap();
    world
}

fn pace(world: &World, body: BodyId) -> usize {
    let index = world.body_index(body).unwrap();
    world.state.bodies.infos[index as usize].pace.into()
}

fn steps(world: &mut World, count: usize) {
    for _ in 0..count {
        world.step(DT);
        world.validate().unwrap();
    }
}

/// A light crate with one of 100 times its weight on it, and how deep they overlap after a second.
fn heavy_on_light(refine_up_to: u32) -> (usize, f32) {
    let mut world = floored();
    world.settings.refine_up_to = refine_up_to;
    world.settings.sleep = false;
    let light = world.add_body(crate_at(0.0, 0.5, 1.0)).unwrap();
    world.add_body(crate_at(0.0, 1.5, 100.0)).unwrap();
    steps(&mut world, 60);
    (pace(&world, light), world.max_penetration())
}

#[test]
fn a_heavy_load_is_refined_and_sinks_less() {
    let (plain, deep) = heavy_on_light(0);
    let (refined, shallow) = heavy_on_light(1000);
    assert_eq!((plain, refined), (PLAIN, FOURFOLD));
    assert!(deep > 0.008 && shallow < 0.0015, "{deep} and {shallow}");
}

#[test]
fn what_lies_alone_stays_plain_and_so_do_large_islands() {
    let mut world = floored();
    world.settings.refine_up_to = 15;
    let alone = world.add_body(crate_at(-10.0, 0.5, 1.0)).unwrap();
    let low = world.add_body(crate_at(0.0, 0.5, 1.0)).unwrap();
    for level in 1..14 {
        world.add_body(crate_at(0.0, f64::from(level) + 0.5, 1.0)).unwrap();
    }
    steps(&mut world, 20);
    assert_eq!((pace(&world, alone), pace(&world, low)), (PLAIN, TWOFOLD));
    // With two more the tower is too large.
    for level in [14, 15] {
        world.add_body(crate_at(0.0, f64::from(level) + 0.5, 1.0)).unwrap();
    }
    steps(&mut world, 20);
    assert_eq!(pace(&world, low), PLAIN);
}

#[test]
fn islands_that_meet_agree_and_relieved_ones_return() {
    let mut world = floored();
    world.settings.sleep = false;
    let light = world.add_body(crate_at(0.0, 0.5, 1.0)).unwrap();
    let heavy = world.add_body(crate_at(0.0, 1.5, 100.0)).unwrap();
    let falling = world.add_body(crate_at(0.2, 4.0, 1.0)).unwrap();
    steps(&mut world, 10);
    assert_eq!((pace(&world, light), pace(&world, falling)), (FOURFOLD, PLAIN));
    steps(&mut world, 90);
    assert_eq!(pace(&world, falling), FOURFOLD, "it lies on the refined ones");
    assert_eq!(world.state.bodies.refined, 3);
    world.remove_body(heavy).unwrap();
    assert_eq!(world.state.bodies.refined, 2);
    steps(&mut world, 120);
    assert_eq!((pace(&world, light), pace(&world, falling)), (PLAIN, PLAIN));
    assert!(!world.state.bodies.any_refined());
}

/// Crates are put on a tower one by one; when the tower becomes refined, nothing jumps.
#[test]
fn becoming_finer_does_not_pop() {
    let mut world = floored();
    world.settings.sleep = false;
    let mut tower = vec![world.add_body(crate_at(0.0, 0.5, 1.0)).unwrap()];
    let mut fastest = 0.0_f32;
    for level in 1..16 {
        let top = world.body(tower[tower.len() - 1]).unwrap().position().y + 1.0;
        tower.push(world.add_body(crate_at(0.0, top.into(), 1.0)).unwrap());
        for _ in 0..60 {
            world.step(DT);
            let speeds = tower.iter().map(|&body| world.body(body).unwrap().velocity().length());
            fastest = speeds.fold(fastest, f32::max);
        }
        assert!(level < 15 || pace(&world, tower[0]) == TWOFOLD);
    }
    assert!(fastest < 0.1, "{fastest} m/s");
}

/// One moving floor carries islands of two paces.
#[test]
fn a_kinematic_body_serves_all_paces() {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let floor = Shape::rect(20.0, 1.0).unwrap();
    let lift = RigidBody::kinematic().shape(floor).position(Vec2::new(0.0, -1.0));
    let lift = world.add_body(lift.velocity(Vec2::new(1.0, 0.5))).unwrap();
    let light = world.add_body(crate_at(0.0, 0.5, 1.0)).unwrap();
    let heavy = world.add_body(crate_at(0.0, 1.5, 100.0)).unwrap();
    let alone = world.add_body(crate_at(5.0, 0.5, 1.0)).unwrap();
    for body in [light, heavy, alone] {
        world.body_mut(body).unwrap().set_velocity(Vec2::new(1.0, 0.5));
    }
    steps(&mut world, 120);
    assert_eq!((pace(&world, light), pace(&world, alone)), (FOURFOLD, PLAIN));
    let at = |body| world.body(body).unwrap().position();
    assert!((at(lift) - Vec2::new(2.0, 0.0)).length() < 1.0e-4);
    for (body, start) in [(light, 0.0), (heavy, 0.0), (alone, 5.0)] {
        assert!((at(body).x - start - 2.0_f32).abs() < 2.0e-3, "{:?}", at(body));
    }
}

#[test]
fn a_saved_world_with_an_unknown_pace_is_refused() {
    let mut world = floored();
    let body = world.add_body(crate_at(0.0, 0.5, 1.0)).unwrap();
    let index = world.body_index(body).unwrap();
    world.state.bodies.set_pace(index, PACES as u8);
    let error = World::from_bytes(&world.to_bytes()).unwrap_err();
    assert!(error.to_string().contains("has no pace"), "{error}");
}

#[test]
fn a_saved_world_that_miscounts_its_refined_bodies_is_refused() {
    let mut world = floored();
    world.state.bodies.refined = 1;
    let error = World::from_bytes(&world.to_bytes()).unwrap_err();
    assert!(error.to_string().contains("miscounted"), "{error}");
}
