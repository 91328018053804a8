//! Paces: which islands are refined, and that changing pace disturbs nothing.

use super::anything::Random;
use super::*;
use crate::describe::JointDef;
use crate::dynamics::{Bucket, JOINTED, PACES, PLAIN, Place, STRUCK};
use crate::simd::BLOCK;
use crate::stages::rests::{Compliance, Sink};

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

/// A light crate with one of 49 times its weight on it, with which it keeps its own mass, where all weighs twice as much: its pace
/// after some steps, and how deep they overlap.
fn heavy_on_light(refine_up_to: u32, count: usize) -> (usize, f32) {
    let mut world = floored();
    world.settings.refine_up_to = refine_up_to;
    world.settings.sleep = false;
    world.gravity = Vec2::new(0.0, -20.0);
    let light = world.add_body(crate_at(0.0, 0.5, 1.0)).unwrap();
    world.add_body(crate_at(0.0, 1.5, 49.0)).unwrap();
    steps(&mut world, count);
    (pace(&world, light), world.max_penetration())
}

#[test]
fn a_heavy_load_is_refined_and_hardly_sinks() {
    let (plain, deep) = heavy_on_light(0, 60);
    let (refined, _) = heavy_on_light(1000, 10);
    assert_eq!((plain, refined), (PLAIN, FOURFOLD));
    // It settles as high as four times the substeps hold it, and stays there with fewer.
    let (settled, shallow) = heavy_on_light(1000, 60);
    let (later, shallow_later) = heavy_on_light(1000, 600);
    assert_eq!((settled, later), (TWOFOLD, TWOFOLD));
    // At the plain pace the light one, which is squeezed as it is put in, counts as heavy: it sank by more than 6 mm before.
    assert!(deep < 0.0015 && shallow < 0.0015, "{deep} and {shallow}");
    assert!((shallow_later - shallow).abs() < 1.0e-4, "{shallow_later}");
}

/// Joined bodies are solved together with what they touch from the step on in which they begin to.
#[test]
fn what_is_hit_gets_its_pace_at_once() {
    for late in 0..9 {
        let mut world = floored();
        let pair = [0.0, 1.0].map(|x| world.add_body(crate_at(x, 9.0, 1.0)).unwrap());
        let hinge = JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0));
        world.add_joint(pair[0], pair[1], hinge).unwrap();
        steps(&mut world, late);
        let ball = Shape::circle(0.2).unwrap();
        let ball = RigidBody::dynamic().shape(ball).position(Vec2::new(0.0, 9.7));
        world.add_body(ball.velocity(Vec2::new(0.0, -50.0))).unwrap();
        steps(&mut world, 1);
        assert!(world.contacts().count() > 0);
        assert_eq!(pair.map(|body| pace(&world, body)), [JOINTED; 2], "{late}");
    }
}

/// Thin bodies that are joined and are hit fast are solved more finely for a quarter of a second.
#[test]
fn what_is_struck_is_finer_for_a_while() {
    let fast = |speed: f32| {
        let mut world = World::new(Vec2::ZERO);
        let pair = [-0.5, 0.5].map(|x| {
            let bar = RigidBody::dynamic().shape(Shape::rect(0.5, 0.05).unwrap());
            world.add_body(bar.position(Vec2::new(x, 0.0))).unwrap()
        });
        let hinge = JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0));
        world.add_joint(pair[0], pair[1], hinge).unwrap();
        let ball = RigidBody::dynamic().shape(Shape::circle(0.1).unwrap());
        let ball = ball.position(Vec2::new(0.2, 0.16)).velocity(Vec2::new(0.0, -speed));
        world.add_body(ball).unwrap();
        [1, 13, 12].map(|count| {
            steps(&mut world, count);
            pace(&world, pair[1])
        })
    };
    assert_eq!(fast(20.0)[..2], [STRUCK; 2]);
    assert_ne!(fast(20.0)[2], STRUCK);
    // In a substep it goes by 0.02 m, less than the half thickness of 0.05 m.
    assert_eq!(fast(5.0)[0], JOINTED);
}

/// What wakes is listed after what hit it, and had told its island's pace before that was chosen: the hit was solved at a pace at which
/// one of the two does not move.
#[test]
fn what_is_hit_asleep_gets_the_pace_of_what_hits_it() {
    let mut world = floored();
    let pair = [-0.5, 0.5].map(|x| {
        let bar = RigidBody::dynamic().shape(Shape::rect(0.5, 0.1).unwrap()).asleep();
        world.add_body(bar.position(Vec2::new(x, 0.1))).unwrap()
    });
    let hinge = JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0));
    world.add_joint(pair[0], pair[1], hinge).unwrap();
    for body in pair {
        world.body_mut(body).unwrap().sleep();
    }
    let heavy = crate_at(0.0, 0.9, 20.0).velocity(Vec2::new(0.0, -15.0));
    let heavy = world.add_body(heavy).unwrap();
    steps(&mut world, 1);
    assert_eq!(pace(&world, heavy), pace(&world, pair[0]));
    assert!(world.body(heavy).unwrap().position().y > 0.6, "it went into what slept");
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
    world.gravity = Vec2::new(0.0, -20.0);
    world.settings.sleep = false;
    let light = world.add_body(crate_at(0.0, 0.5, 1.0)).unwrap();
    let heavy = world.add_body(crate_at(0.0, 1.5, 49.0)).unwrap();
    let falling = world.add_body(crate_at(0.2, 4.0, 1.0)).unwrap();
    steps(&mut world, 10);
    assert_eq!((pace(&world, light), pace(&world, falling)), (FOURFOLD, PLAIN));
    steps(&mut world, 90);
    assert_eq!(pace(&world, falling), pace(&world, light), "it lies on the refined ones");
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
    let (mut fastest, mut finer) = (0.0_f32, false);
    for _ in 1..16 {
        let top = world.body(tower[tower.len() - 1]).unwrap().position().y + 1.0;
        tower.push(world.add_body(crate_at(0.0, top.into(), 1.0)).unwrap());
        for _ in 0..60 {
            world.step(DT);
            let speeds = tower.iter().map(|&body| world.body(body).unwrap().velocity().length());
            fastest = speeds.fold(fastest, f32::max);
            finer |= pace(&world, tower[0]) == TWOFOLD;
        }
    }
    assert!(finer, "a tower of 16 becomes finer");
    assert!(fastest < 0.1, "{fastest} m/s");
}

/// Random towers that have settled are as high at the plain pace as finer ones, and do not sink later.
#[test]
fn what_has_settled_stays_at_the_plain_pace() {
    let mut random = Random(5);
    for case in 0..12 {
        let mut world = floored();
        world.settings.sleep = false;
        let mut top = 0.0_f64;
        let mut tower = Vec::new();
        for _ in 0..12 + case {
            let (half, density) = (random.between(0.3, 0.7), random.between(0.5, 2.5));
            let shape = ShapeDef::new(Shape::rect(0.8, half).unwrap()).density(density);
            let x = f64::from(random.between(0.0, 0.2));
            let at = DVec2::new(x, top + f64::from(half));
            tower.push(world.add_body(RigidBody::dynamic().shape(shape).position(at)).unwrap());
            top += 2.0 * f64::from(half);
        }
        steps(&mut world, 12);
        assert_ne!(pace(&world, tower[0]), PLAIN, "case {case}");
        let mut rest = |count| {
            for _ in 0..count {
                world.step(DT);
            }
            let height = world.body(tower[tower.len() - 1]).unwrap().position().y;
            (height, world.max_penetration(), pace(&world, tower[0]))
        };
        let ((early, ..), (late, deepest, last)) = (rest(300), rest(1500));
        assert!(last <= TWOFOLD, "case {case}: {last}");
        assert!((late - early).abs() < 2.0e-3, "case {case}: {early} to {late}");
        assert!(deepest < 2.0e-3, "case {case}: {deepest} m deep");
    }
}

/// Heaps that have tumbled into place sleep at the plain pace, but for a few that lie still in a corner, no deeper in each other than their
/// loads account for there. Those that are kept awake become finer when they have lain still for a while. They were finer in three
/// quarters of the steps in which they were awake.
#[test]
fn what_has_tumbled_into_place_sleeps_before_it_becomes_finer() {
    let heap = |case: u64, sleep: bool| {
        let mut random = Random(20 + case);
        let mut world = floored();
        world.settings.sleep = sleep;
        for (row, column) in (0..14).flat_map(|row| (0..7).map(move |column| (row, column))) {
            let x = f64::from(column) * 1.4 + f64::from(random.between(-0.15, 0.15));
            let at = DVec2::new(x, 0.8 + 1.5 * f64::from(row));
            let half = random.between(0.25, 0.5);
            let shape = ShapeDef::new(Shape::rect(half, 0.4).unwrap());
            world.add_body(RigidBody::dynamic().shape(shape).position(at)).unwrap();
        }
        world
    };
    let (mut refined, mut awake) = (0, 0);
    // A fifth in 600 of them; a few of 48 are finer for much of it.
    for case in 0..48 {
        let mut world = heap(case, true);
        for _ in 0..900 {
            world.step(DT);
            let bodies = &world.state.bodies;
            let finer = |&&body: &&u32| usize::from(bodies.infos[body as usize].pace) != PLAIN;
            refined += bodies.awake.iter().filter(finer).count();
            awake += bodies.awake.len();
        }
        assert!(world.max_penetration() < 0.02, "case {case}: {}", world.max_penetration());
    }
    assert!(4 * refined < awake, "{refined} of {awake}");
    let mut world = heap(0, false);
    (0..1200).for_each(|_| world.step(DT));
    assert!(world.max_penetration() < 2.0e-3, "{}", world.max_penetration());
}

/// Rests go with the loads that they stand for: what has borne up to five crates hops by millimetres, no more, when they
/// are gone (by 6 where contacts have sunk under them).
#[test]
fn unloading_what_rests_throws_nothing_up() {
    let mut random = Random(3);
    for case in 0..8 {
        let mut world = floored();
        world.settings.sleep = false;
        let place = |level: usize| f64::from(level as u32) + 0.5;
        let tower: Vec<_> =
            (0..6).map(|level| world.add_body(crate_at(0.0, place(level), 1.0)).unwrap()).collect();
        let heavy = crate_at(0.0, place(6), random.between(2.0, 5.0));
        let heavy = world.add_body(heavy).unwrap();
        steps(&mut world, 240);
        assert_eq!(pace(&world, tower[0]), PLAIN, "case {case}");
        let height = |world: &World| world.body(tower[5]).unwrap().position().y;
        let before = height(&world);
        world.remove_body(heavy).unwrap();
        for _ in 0..60 {
            world.step(DT);
            assert!(height(&world) < before + 4.0e-3, "case {case}: {}", height(&world) - before);
        }
    }
}

/// Towers that were dropped sway; they come to rest all the same.
#[test]
fn what_sways_falls_asleep() {
    let mut random = Random(8);
    for case in 0..12 {
        let mut world = floored();
        let count = 7 + case % 5;
        let half = random.between(0.35, 0.55);
        for level in 0..count {
            let shape = ShapeDef::new(Shape::rect(half, half).unwrap()).density(1.0);
            let at = DVec2::new(
                f64::from(random.between(0.0, 0.05)),
                f64::from(half) * (2.2 * f64::from(level) + 1.2),
            );
            world.add_body(RigidBody::dynamic().shape(shape).position(at)).unwrap();
        }
        for _ in 0..420 {
            world.step(DT);
        }
        assert_eq!(world.awake_body_count(), 0, "case {case}");
    }
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

/// A lane that the narrow phase has not written yet holds what kernels left there, other numbers at every SIMD level.
#[test]
fn points_that_are_not_written_yet_rest_on_nothing() {
    let mut world = floored();
    world.settings.refine_up_to = 0;
    world.add_body(crate_at(0.0, 0.5, 1.0)).unwrap();
    world.add_body(crate_at(0.0, 1.5, 100.0)).unwrap();
    steps(&mut world, 30);
    let compliance = Compliance { moving: 1.0e-3, fixed: 1.0e-3 };
    let State { bodies, graph, contacts, .. } = &mut world.state;
    let records = contacts.records.iter();
    let pair = records.clone().find(|c| bodies.is_solved(c.body_a) && bodies.is_solved(c.body_b));
    let contact = pair.expect("crates that touch");
    let Place::Graph { colour, slot } = contact.place else { panic!("it is not solved") };
    let bucket = graph.bucket_mut(colour.into(), contact.class);
    let rests = |bucket: &Bucket| {
        let sinks = Sink::of(bucket, slot as usize, PLAIN, compliance, bodies);
        sinks.map(|sink| sink.rest_at(TWOFOLD))
    };
    assert!(rests(bucket).iter().all(|rest| (0.0..0.1).contains(rest)), "{:?}", rests(bucket));
    let (block, lane) = (slot as usize / BLOCK, slot as usize % BLOCK);
    for point in &mut bucket.constraints[block].points {
        (point.normal_mass[lane], point.separation[lane]) = (0.0, f32::MAX);
    }
    assert_eq!(rests(bucket), [0.0; 2]);
}

/// The sides of two bodies push each other in and out at once: that is no load, and stiffer contacts would shoot them off.
#[test]
fn bodies_put_into_each_other_part_slowly() {
    let bowl = |place: Vec2, angle: f32| {
        let body = RigidBody::dynamic().position(place).angle(angle);
        let side = |x: f32| rect(0.06, 0.3).offset(Vec2::new(x, 0.0));
        body.shape(rect(0.3, 0.06).offset(Vec2::new(0.0, -0.24)))
            .shape(side(-0.24))
            .shape(side(0.24))
    };
    for k in 0..40 {
        let mut world = world();
        add_ground(&mut world);
        let turn = 0.15 * k as f32;
        let place = Vec2::new(0.05, 0.9 + 0.02 * (k % 7) as f32);
        let bodies = [bowl(Vec2::new(0.0, 0.8), 0.4 * turn), bowl(place, 3.0 + turn)];
        let bodies = bodies.map(|body| world.add_body(body).unwrap());
        for step in 0..240 {
            world.step(DT);
            for body in bodies {
                let speed = world.body(body).unwrap().velocity().length();
                assert!(speed < 8.0, "pair {k}, step {step}: {speed} m/s");
            }
        }
    }
}

/// A joint that is off or only a filter leaves a stack what it is.
#[test]
fn a_joint_that_does_nothing_leaves_a_stack_fine() {
    let sink = |joint: Option<JointDef>| {
        let mut world = world();
        let ground = add_ground(&mut world);
        let crates: Vec<BodyId> =
            (0..15).map(|i| add(&mut world, 0.0, 0.5 + i as f32, rect(0.5, 0.5))).collect();
        if let Some(joint) = joint {
            let joint = JointDef { collide_connected: true, ..joint };
            world.add_joint(ground, crates[7], joint).unwrap();
        }
        run(&mut world, 60);
        14.5 - y(&world, crates[14])
    };
    let without = sink(None);
    for joint in [JointDef { enabled: false, ..JointDef::revolute() }, JointDef::filter()] {
        assert!((sink(Some(joint)) - without).abs() < 1.0e-4, "{} {without}", sink(Some(joint)));
    }
}

/// A flag on a tower: all of it was solved as joined bodies are, at the plain substeps, and sank by 56 mm in place of 15.
#[test]
fn a_flag_on_a_tower_leaves_it_fine() {
    let sinks = |flag: bool, count: u8| {
        let mut world = floored();
        let mut place = |y: f64| world.add_body(crate_at(0.0, y, 1.0)).unwrap();
        let crates: Vec<BodyId> = (0..count).map(|i| place(0.5 + f64::from(i))).collect();
        if flag {
            let top = *crates.last().unwrap();
            let end = Vec2::new(0.0, f32::from(count));
            let pole = rect(0.05, 0.3).density(0.5);
            let pole = RigidBody::dynamic().shape(pole).position(end + Vec2::Y * 0.3);
            let pole = world.add_body(pole).unwrap();
            world.add_joint(top, pole, JointDef::weld().anchor_at(end)).unwrap();
        }
        let start = y(&world, crates[count as usize - 1]);
        let sinks = (0..120).map(|_| {
            steps(&mut world, 1);
            start - y(&world, crates[count as usize - 1])
        });
        sinks.fold(0.0, f32::max)
    };
    for count in [10, 15, 20] {
        let (without, with) = (sinks(false, count), sinks(true, count));
        assert!(with < 1.2 * without, "{count}: {with} {without}");
    }
}

/// Twenty motors whose speed is set in every frame: the paces of all islands were chosen anew in every step for that.
#[test]
fn motors_that_are_set_are_no_news() {
    let mut world = floored();
    let wheel = ShapeDef::new(Shape::circle(0.3).unwrap());
    let motor = |speed: f32| JointDef::revolute().motor(speed, 5.0);
    let motors: Vec<_> = (0..20)
        .map(|i| {
            let place = DVec2::new(f64::from(i) * 2.0, 3.0);
            let wheel =
                world.add_body(RigidBody::dynamic().shape(wheel.clone()).position(place)).unwrap();
            let post = world.add_body(RigidBody::fixed().position(place)).unwrap();
            world.add_joint(post, wheel, motor(1.0)).unwrap()
        })
        .collect();
    steps(&mut world, 9);
    for i in 0..16 {
        for &id in &motors {
            world.set_joint(id, motor(1.0 + 0.1 * i as f32)).unwrap();
        }
        assert_eq!(world.state.graph.news, 0);
        world.step(DT);
    }
    // One that stops, whose island may be watched now, is.
    world.set_joint(motors[0], motor(0.0)).unwrap();
    assert_eq!(world.state.graph.news, 1);
}
