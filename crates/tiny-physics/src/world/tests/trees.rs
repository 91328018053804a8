//! Trees of joints: statics, momentum, loads, limits, and what happens to them while they run.

use super::*;
use crate::describe::{Filter, JointDef};

/// A world in which nothing falls asleep.
fn sleepless() -> World {
    let mut world = world();
    world.settings.sleep = false;
    world
}

/// Joints that are solved directly.
fn in_trees(world: &World) -> usize {
    world.state.joint_graph.count_in_trees()
}

/// A bar of 1 m and 1 kg that collides with nothing, around a point.
fn add_bar(world: &mut World, x: f32, y: f32, angle: f32) -> BodyId {
    let shape = rect(0.5, 0.1).filter(Filter { group: -1, ..Filter::default() });
    let bar = RigidBody::dynamic().position(Vec2::new(x, y)).angle(angle).shape(shape).mass(1.0);
    world.add_body(bar).unwrap()
}

/// A hinge between the end of one bar and the start of the next.
fn hinge() -> JointDef {
    JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0))
}

/// A chain of bars along x, from x = 0 on.
fn add_chain(world: &mut World, y: f32, count: usize) -> (Vec<BodyId>, Vec<JointId>) {
    let bars: Vec<BodyId> = (0..count).map(|i| add_bar(world, i as f32 + 0.5, y, 0.0)).collect();
    let joints = bars.windows(2).map(|pair| world.add_joint(pair[0], pair[1], hinge()).unwrap());
    let joints = joints.collect();
    (bars, joints)
}

/// The same, hung up at its start.
fn add_hung_chain(world: &mut World, y: f32, count: usize) -> (Vec<BodyId>, Vec<JointId>) {
    let hook = world.add_body(RigidBody::fixed().position(Vec2::new(0.0, y))).unwrap();
    let (bars, mut joints) = add_chain(world, y, count);
    let top = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-0.5, 0.0));
    joints.insert(0, world.add_joint(hook, bars[0], top).unwrap());
    (bars, joints)
}

fn gap(world: &World, joint: JointId) -> f64 {
    let (a, b) = world.joint(joint).unwrap().anchors();
    f64::from(a.relative_to(b).length())
}

#[test]
fn every_joint_of_a_chain_bears_what_hangs_below() {
    let mut world = sleepless();
    let hook = world.add_body(RigidBody::fixed()).unwrap();
    let mut last = hook;
    let mut joints = Vec::new();
    for i in 0..12 {
        let down = -core::f32::consts::FRAC_PI_2;
        let bar = add_bar(&mut world, 0.0, -0.5 - i as f32, down);
        let mut def = hinge();
        if last == hook {
            def.anchor_a = Vec2::ZERO;
        }
        joints.push(world.add_joint(last, bar, def).unwrap());
        last = bar;
    }
    (0..60).for_each(|_| world.step(DT));
    assert_eq!(in_trees(&world), 12);
    for (i, &joint) in joints.iter().enumerate() {
        let (force, weight) = (world.joint(joint).unwrap().force(), 10.0 * (12 - i) as f32);
        assert!((force.y / weight - 1.0).abs() < 1e-3, "joint {i}: {force:?}, not {weight}");
        assert!(force.x.abs() < 1e-3 * weight);
    }
}

#[test]
fn heavy_loads_hardly_stretch_chains() {
    for ratio in [100.0, 1000.0] {
        let mut world = world();
        let (bars, joints) = add_hung_chain(&mut world, 0.0, 20);
        let ball = RigidBody::dynamic().position(Vec2::new(20.0, 0.0)).mass(ratio);
        let ball = world.add_body(ball.shape(circle(0.4))).unwrap();
        let def = JointDef::revolute().anchors(Vec2::new(0.5, 0.0), Vec2::ZERO);
        world.add_joint(bars[19], ball, def).unwrap();
        for _ in 0..400 {
            world.step(DT);
            let stretch = joints.iter().map(|&joint| gap(&world, joint)).sum::<f64>() / 20.0;
            assert!(stretch < 1e-3, "{ratio}:1, {stretch}");
        }
    }
}

/// Linear momentum, angular momentum about the origin, kinetic energy.
fn sums(world: &World, bodies: &[BodyId]) -> [f64; 4] {
    bodies.iter().fold([0.0; 4], |[px, py, l, e], &id| {
        let body = world.body(id).unwrap();
        let (m, i) = (f64::from(body.mass()), f64::from(body.inertia()));
        let (x, v, w) = (body.position(), body.velocity(), f64::from(body.angular_velocity()));
        let (x, y) = (f64::from(x.x), f64::from(x.y));
        let (vx, vy) = (f64::from(v.x), f64::from(v.y));
        let energy = 0.5 * (m * (vx * vx + vy * vy) + i * w * w);
        [px + m * vx, py + m * vy, l + m * (x * vy - y * vx) + i * w, e + energy]
    })
}

#[test]
fn momentum_and_energy_are_kept_in_flight() {
    let mut world = World::new(Vec2::ZERO);
    let (bars, _) = add_chain(&mut world, 0.0, 12);
    for (i, &bar) in bars.iter().enumerate() {
        let mut bar = world.body_mut(bar).unwrap();
        bar.set_velocity(Vec2::new(1.0, 2.0 + 6.0 * i as f32));
        bar.set_angular_velocity(6.0);
    }
    world.step(DT);
    let before = sums(&world, &bars);
    (0..300).for_each(|_| world.step(DT));
    assert_eq!(in_trees(&world), 11);
    for (before, after) in before.into_iter().zip(sums(&world, &bars)) {
        assert!((after / before - 1.0).abs() < 3e-4, "{after} instead of {before}");
    }
}

#[test]
fn limits_hold_in_trees() {
    let mut world = sleepless();
    let (bars, joints) = add_hung_chain(&mut world, 0.0, 12);
    let limit = 0.1;
    for &joint in &joints {
        let def = *world.joint(joint).unwrap().def();
        world.set_joint(joint, def.limits(-limit, limit)).unwrap();
    }
    for _ in 0..300 {
        world.step(DT);
        for pair in bars.windows(2) {
            let angle = |id| world.body(id).unwrap().rotation();
            let bend = angle(pair[1]).angle_from(angle(pair[0])).abs();
            assert!(bend < limit + 0.01, "{bend}");
        }
    }
    assert_eq!(in_trees(&world), 12);
    // A stiff arch at its limits: each joint bends as far as it may.
    let tip = world.body(bars[11]).unwrap().rotation().angle();
    assert!((tip + 1.2).abs() < 0.15 || tip < -1.2, "{tip}");
}

#[test]
fn all_rigid_kinds_hold_a_heavy_load_together() {
    let mut world = sleepless();
    let hook = world.add_body(RigidBody::fixed()).unwrap();
    let arm = add_bar(&mut world, 0.5, 0.0, 0.0);
    let slide = add_bar(&mut world, 1.5, 0.0, 0.0);
    let bob = add_bar(&mut world, 2.0, -2.0, 0.0);
    let load = RigidBody::dynamic().position(Vec2::new(2.0, -3.0)).mass(100.0).shape(circle(0.2));
    let load = world.add_body(load).unwrap();
    let weld = JointDef::weld().anchors(Vec2::ZERO, Vec2::new(-0.5, 0.0));
    let weld = world.add_joint(hook, arm, weld).unwrap();
    let slider = JointDef::prismatic(Vec2::new(1.0, 0.0)).limits(0.0, 0.1);
    let slider = slider.anchors(Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0));
    let slider = world.add_joint(arm, slide, slider).unwrap();
    let rod = JointDef::distance(2.0).anchors(Vec2::new(0.5, 0.0), Vec2::ZERO);
    let rod = world.add_joint(slide, bob, rod).unwrap();
    let wheel = JointDef::wheel(Vec2::new(0.0, 1.0)).anchors(Vec2::new(0.0, -1.0), Vec2::ZERO);
    world.add_joint(bob, load, wheel.spring(3.0, 1.0)).unwrap();
    (0..1800).for_each(|_| world.step(DT));
    assert_eq!(in_trees(&world), 4);
    let at = |body| world.body(body).unwrap().position();
    let [end, bob_at] = [at(slide), at(bob)];
    let length = (end + Vec2::new(0.5, 0.0) - bob_at).length();
    assert!((length - 2.0).abs() < 2e-3, "{length}");
    assert!(gap(&world, weld) < 2e-3 && end.y.abs() < 5e-3, "{end:?}");
    // Bob and load hang on the rod, all of it on the wall; the slider lets them swing a little.
    let force = |joint| world.joint(joint).unwrap().force();
    assert!((force(rod).length() / 1010.0 - 1.0).abs() < 0.05, "{:?}", force(rod));
    assert!((force(weld).y / 1030.0 - 1.0).abs() < 0.05, "{:?}", force(weld));
    assert!((force(slider).y / 1020.0 - 1.0).abs() < 0.05, "{:?}", force(slider));
}

#[test]
fn springs_act_in_trees_without_damping_too() {
    let [undamped, damped] = [0.0, 1e-3].map(|damping| {
        let mut world = sleepless();
        let (bars, joints) = add_chain(&mut world, 0.0, 12);
        for joint in joints {
            world.set_joint(joint, hinge().spring(3.0, damping)).unwrap();
        }
        world.body_mut(bars[0]).unwrap().set_angular_velocity(1.0);
        (0..10).for_each(|_| world.step(DT));
        assert_eq!(in_trees(&world), 11);
        world.body(bars[0]).unwrap().angular_velocity()
    });
    assert!((undamped - damped).abs() < 0.01 && undamped < 0.95, "{undamped} {damped}");
}

#[test]
fn loops_are_closed_through_trees_or_left_to_the_lanes() {
    let mut world = world();
    let ring: Vec<BodyId> = (0..24)
        .map(|i| {
            let angle = core::f32::consts::TAU * i as f32 / 24.0;
            let at = crate::math::Rot::from_angle(angle).x_axis() * 3.82;
            add_bar(&mut world, at.x, at.y, angle + core::f32::consts::FRAC_PI_2)
        })
        .collect();
    for i in 0..24 {
        world.add_joint(ring[i], ring[(i + 1) % 24], hinge()).unwrap();
    }
    world.step(DT);
    assert_eq!(in_trees(&world), 24);
    (0..60).for_each(|_| world.step(DT));
    world.validate().unwrap();

    let mut world = self::world();
    let net: Vec<BodyId> =
        (0..100).map(|i| add_bar(&mut world, (i % 10) as f32, (i / 10) as f32, 0.0)).collect();
    for i in 0..100 {
        if i % 10 < 9 {
            world.add_joint(net[i], net[i + 1], hinge()).unwrap();
        }
        if i < 90 {
            let def = JointDef::revolute().anchors(Vec2::new(0.0, 1.0), Vec2::ZERO);
            world.add_joint(net[i], net[i + 10], def).unwrap();
        }
    }
    world.step(DT);
    assert_eq!(in_trees(&world), 0);
    world.validate().unwrap();
}

#[test]
fn short_chains_stay_in_lanes_until_they_bear_something_heavy() {
    let mut world = sleepless();
    let (bars, joints) = add_hung_chain(&mut world, 0.0, 4);
    world.step(DT);
    assert_eq!(in_trees(&world), 4, "what hangs from something fixed is a tree however short");
    world.remove_joint(joints[0]).unwrap();
    world.step(DT);
    assert_eq!(in_trees(&world), 0);
    world.body_mut(bars[3]).unwrap().set_mass(Some(50.0)).unwrap();
    world.step(DT);
    assert_eq!(in_trees(&world), 3);
    world.body_mut(bars[3]).unwrap().set_mass(Some(1.0)).unwrap();
    world.step(DT);
    assert_eq!(in_trees(&world), 0);
    world.validate().unwrap();
}

#[test]
fn joints_come_and_go_while_trees_run() {
    let mut world = sleepless();
    let (bars, joints) = add_hung_chain(&mut world, 0.0, 30);
    (0..30).for_each(|_| world.step(DT));
    assert_eq!(in_trees(&world), 30);
    // Cut: 15 joints stay hung, 14 fly.
    world.remove_joint(joints[15]).unwrap();
    (0..10).for_each(|_| world.step(DT));
    world.validate().unwrap();
    assert_eq!(in_trees(&world), 29);
    assert!(joints.iter().filter(|&&j| j != joints[15]).all(|&j| gap(&world, j) < 1e-3));
    // Torn: what hangs on the fourth joint weighs more than it bears.
    let def = *world.joint(joints[3]).unwrap().def();
    world.set_joint(joints[3], def.break_at(20.0, 1.0e9)).unwrap();
    world.step(DT);
    assert!(world.joint(joints[3]).is_none());
    (0..10).for_each(|_| world.step(DT));
    assert_eq!(in_trees(&world), 3 + 14 + 11);
    // A kind that no tree holds, a body that goes, one that stops.
    let def = *world.joint(joints[20]).unwrap().def();
    world.set_joint(joints[20], def.softness(2.0, 0.5)).unwrap();
    world.remove_body(bars[10]).unwrap();
    world.body_mut(bars[25]).unwrap().set_kind(BodyKind::Static);
    (0..10).for_each(|_| world.step(DT));
    world.validate().unwrap();
    for &bar in bars.iter().filter(|&&bar| bar != bars[10]) {
        assert!(world.body(bar).unwrap().position().is_finite());
    }
}

#[test]
fn ropes_fall_asleep_and_wake() {
    let mut world = world();
    add_ground(&mut world);
    let (bars, _) = add_chain(&mut world, 0.3, 12);
    for _ in 0..600 {
        world.step(DT);
        if world.awake_body_count() == 0 {
            break;
        }
    }
    assert_eq!((world.awake_body_count(), in_trees(&world)), (0, 0));
    world.validate().unwrap();
    world.body_mut(bars[4]).unwrap().set_velocity(Vec2::new(0.0, 2.0));
    world.step(DT);
    assert_eq!((world.awake_body_count(), in_trees(&world)), (12, 11));
    world.validate().unwrap();
}

/// Chains of several lengths on a heap, with a cut to come.
fn heap() -> World {
    let mut world = world();
    add_ground(&mut world);
    for i in 0..10 {
        add(&mut world, i as f32, 0.5, rect(0.4, 0.4));
    }
    for i in 0..12 {
        add_chain(&mut world, 2.0 + 0.5 * i as f32, 6 + i);
    }
    world
}

#[test]
fn threads_make_no_difference() {
    let run = |threads: usize| {
        let mut world = heap();
        world.set_threads(threads);
        (0..90).for_each(|_| world.step(DT));
        world.state_hash()
    };
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(4));
}

#[test]
fn frames_go_on_as_the_world_does() {
    let mut world = heap();
    (0..40).for_each(|_| world.step(DT));
    let cut = world.joint_id(40);
    world.remove_joint(cut).unwrap();
    let mut loaded = World::from_bytes(&world.to_bytes()).unwrap();
    let mut cloned = world.clone();
    for world in [&mut world, &mut loaded, &mut cloned] {
        (0..60).for_each(|_| world.step(DT));
    }
    assert_eq!(world.state_hash(), loaded.state_hash());
    assert_eq!(world.state_hash(), cloned.state_hash());
}

#[test]
fn a_plank_pinned_at_points_too_far_apart_stays_calm() {
    let mut world = sleepless();
    let wall = world.add_body(RigidBody::fixed()).unwrap();
    let plank = add_bar(&mut world, 0.0, 0.0, 0.0);
    for side in [-1.0, 1.0] {
        let anchors = (Vec2::new(0.502 * side, 0.0), Vec2::new(0.5 * side, 0.0));
        world.add_joint(wall, plank, JointDef::revolute().anchors(anchors.0, anchors.1)).unwrap();
    }
    let load = RigidBody::dynamic().position(Vec2::new(0.0, -1.0)).mass(20.0).shape(circle(0.2));
    let load = world.add_body(load).unwrap();
    let def = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(0.0, 1.0));
    world.add_joint(plank, load, def).unwrap();
    (0..300).for_each(|_| world.step(DT));
    assert_eq!(in_trees(&world), 3);
    let body = world.body(plank).unwrap();
    assert!(body.position().length() < 1e-3 && body.velocity().length() < 1e-3);
}

/// A motor that may push no more lets go of what it pushed with.
#[test]
fn a_motor_without_force_does_nothing() {
    let mut world = World::new(Vec2::ZERO);
    let (bars, _) = add_hung_chain(&mut world, 0.0, 4);
    let last = add_bar(&mut world, 4.5, 0.0, 0.0);
    let motor = world.add_joint(bars[3], last, hinge().motor(2.0, 50.0)).unwrap();
    run(&mut world, 5);
    assert!(in_trees(&world) > 0);
    world.joint_mut(motor).unwrap().set_max_force(0.0).unwrap();
    run(&mut world, 2);
    assert_eq!(world.joint(motor).unwrap().motor_load(), 0.0);
}

/// The joint that closes a ring gets limits while the ring turns; a world from its frame goes the same way.
#[test]
fn a_ring_takes_limits_where_it_closes() {
    let mut world = sleepless();
    world.gravity = Vec2::ZERO;
    let count = 10;
    let turn = core::f32::consts::TAU / count as f32;
    let radius = 0.5 / (turn / 2.0).tan();
    let bars: Vec<BodyId> = (0..count)
        .map(|i| {
            let at = Vec2::new((turn * i as f32).cos(), (turn * i as f32).sin()) * radius;
            add_bar(&mut world, at.x, at.y, turn * i as f32 + core::f32::consts::FRAC_PI_2)
        })
        .collect();
    let joints: Vec<JointId> = (0..count)
        .map(|i| world.add_joint(bars[i], bars[(i + 1) % count], hinge()).unwrap())
        .collect();
    run(&mut world, 2);
    for limits in [Some((turn - 0.05, turn + 0.05)), None] {
        let limits = limits.map(|(lower, upper)| crate::Limits { lower, upper });
        for &joint in &joints {
            world.joint_mut(joint).unwrap().set_limits(limits).unwrap();
        }
        world.body_mut(bars[0]).unwrap().apply_impulse_to_center((5.0, 0.0));
        let mut again = World::from_bytes(&world.to_bytes()).unwrap();
        for _ in 0..30 {
            world.step(DT);
            again.step(DT);
            assert_eq!(again.state_hash(), world.state_hash());
        }
    }
}

/// Joints that solve nothing change nothing of how trees are solved, whether they were there before or not.
#[test]
fn idle_joints_change_no_tree() {
    let mut world = sleepless();
    add_ground(&mut world);
    let (bars, _) = add_chain(&mut world, 0.2, 16);
    run(&mut world, 20);
    assert_eq!(in_trees(&world), 15);
    let far = add(&mut world, 30.0, 5.0, circle(0.2));
    world.add_joint(far, bars[3], JointDef::filter()).unwrap();
    let mut again = World::from_bytes(&world.to_bytes()).unwrap();
    for _ in 0..60 {
        world.step(DT);
        again.step(DT);
        assert_eq!(again.state_hash(), world.state_hash());
    }
}

/// What cannot turn needs no row against turning, and holds by its other rows all the same.
#[test]
fn rails_hold_beads_that_cannot_turn() {
    for prismatic in [true, false] {
        let mut world = sleepless();
        let beam = world.add_body(RigidBody::fixed()).unwrap();
        let beads = [-1.0, 1.0].map(|x| {
            let bead = RigidBody::dynamic().position(Vec2::new(x, 0.0)).lock_rotation();
            let bead = world.add_body(bead.shape(circle(0.2))).unwrap();
            let rail = if prismatic { JointDef::prismatic(Vec2::X) } else { JointDef::weld() };
            let rail = rail.anchors(Vec2::new(x, 0.0), Vec2::ZERO);
            world.add_joint(beam, bead, rail).unwrap();
            bead
        });
        world.add_joint(beads[0], beads[1], JointDef::distance(2.0)).unwrap();
        run(&mut world, 120);
        assert_eq!(in_trees(&world), 3, "not the case that this is about");
        for bead in beads {
            assert!(y(&world, bead).abs() < 0.005, "{prismatic}: {}", y(&world, bead));
        }
    }
}

/// Between its limits a servo turns to its target, though the other way round would be shorter.
#[test]
fn a_hinge_spring_goes_to_its_target_inside_the_limits() {
    for chained in [false, true] {
        let mut world = World::new(Vec2::ZERO);
        world.settings.sleep = false;
        let base = world.add_body(RigidBody::fixed()).unwrap();
        let arm = add_bar(&mut world, 0.0, 0.0, 2.5);
        let servo = JointDef::revolute().limits(-3.0, 3.0).spring(4.0, 1.0);
        let servo = world.add_joint(base, arm, servo).unwrap();
        if chained {
            let next = add_bar(&mut world, 1.0, 0.0, 0.0);
            world.add_joint(arm, next, JointDef::weld()).unwrap();
        }
        world.joint_mut(servo).unwrap().set_target(-2.5).unwrap();
        run(&mut world, 240);
        let angle = world.joint(servo).unwrap().angle();
        assert!((angle + 2.5).abs() < 0.02, "{chained}: {angle}");
    }
}

/// What motors hold against gravity stays where it is, and is not said to move.
#[test]
fn motors_in_a_tree_hold_an_arm_still() {
    for (links, substeps, hinged) in [(2, 4, true), (4, 4, true), (2, 1, true), (2, 4, false)] {
        let mut world = sleepless();
        world.settings.substeps = substeps;
        let wall = world.add_body(RigidBody::fixed()).unwrap();
        let mut before = (wall, Vec2::ZERO);
        let mut last = wall;
        for i in 0..links {
            last = add_bar(&mut world, i as f32 + 0.5, 0.0, 0.0);
            let joint =
                if hinged || i > 0 { JointDef::revolute() } else { JointDef::prismatic(Vec2::Y) };
            let joint = joint.anchors(before.1, Vec2::new(-0.5, 0.0)).motor(0.0, 1.0e6);
            world.add_joint(before.0, last, joint).unwrap();
            before = (last, Vec2::new(0.5, 0.0));
        }
        run(&mut world, 60);
        assert_eq!(in_trees(&world), links);
        let start = world.body(last).unwrap().position();
        run(&mut world, 300);
        let body = world.body(last).unwrap();
        let way = (body.position() - start).length();
        assert!(way < 0.02, "{links} {substeps} {hinged}: {way} in 5 s");
        assert!(body.velocity().length() < 0.005, "{links} {substeps}: {:?}", body.velocity());
    }
}

/// What hits a body of a tree bounces off all that hangs on it, up to what it is nailed to.
#[test]
fn what_hits_a_tree_bounces_off_all_of_it() {
    let elastic = || rect(0.5, 0.5).friction(0.0).restitution(1.0);
    let mut world = World::new(Vec2::ZERO);
    world.settings.sleep = false;
    let wall = world.add_body(RigidBody::fixed().position(Vec2::new(4.5, 0.0))).unwrap();
    let [near, far] = [3.0, 4.0].map(|x| {
        let body = RigidBody::dynamic().position(Vec2::new(x, 0.0)).mass(1.0).shape(elastic());
        world.add_body(body).unwrap()
    });
    for (a, b, x) in [(near, far, 3.5), (far, wall, 4.5)] {
        world.add_joint(a, b, JointDef::weld().anchor_at(Vec2::new(x, 0.0))).unwrap();
    }
    let ball = RigidBody::dynamic().velocity(Vec2::new(5.0, 0.0)).mass(1.0).shape(elastic());
    let ball = world.add_body(ball).unwrap();
    run(&mut world, 60);
    assert_eq!(in_trees(&world), 2, "not the case that this is about");
    let back = world.body(ball).unwrap().velocity().x;
    assert!((back + 5.0).abs() < 0.3, "{back} m/s");
}

/// What has settled on a tree stays where it is as steps become longer, as on ground.
#[test]
fn longer_steps_move_nothing_on_a_tree() {
    for (before, after) in [(240.0, 30.0), (120.0, 60.0)] {
        let mut world = sleepless();
        let mut last = world.add_body(RigidBody::fixed()).unwrap();
        for i in 0..4 {
            let bar = add_bar(&mut world, i as f32 + 0.5, 0.0, 0.0);
            let weld = JointDef::weld().anchor_at(Vec2::new(i as f32, 0.0));
            world.add_joint(last, bar, weld).unwrap();
            last = bar;
        }
        let load = [0.0, 0.5, 1.0, 1.5]
            .map(|up| add(&mut world, 1.5, 0.35 + up, rect(0.25, 0.25).density(30.0)))[0];
        (0..(3.0 * before) as usize).for_each(|_| world.step(1.0 / before));
        assert_eq!(in_trees(&world), 4, "not the case that this is about");
        let start = y(&world, load);
        for step in 0..(2.0 * after) as usize {
            world.step(1.0 / after);
            let moved = (y(&world, load) - start).abs();
            assert!(moved < 3.0e-4, "{before} to {after} Hz, step {step}: {moved}");
        }
    }
}

#[test]
fn a_spring_that_comes_later_makes_the_tree_that_one_from_the_start_does() {
    let mut world = sleepless();
    let ground = world.add_body(RigidBody::fixed()).unwrap();
    let ball = world.add_body(RigidBody::dynamic().shape(circle(0.3))).unwrap();
    let plain = JointDef::wheel(Vec2::Y).limits(-0.2, 0.2);
    let wheel = world.add_joint(ground, ball, plain).unwrap();
    world.step(DT);
    for (def, trees) in [(plain.spring(2.0, 0.1), 1), (plain, 0), (plain.spring(2.0, 0.1), 1)] {
        world.set_joint(wheel, def).unwrap();
        world.step(DT);
        assert_eq!(in_trees(&world), trees);
        let mut read = World::from_bytes(&world.to_bytes()).unwrap();
        (0..30).for_each(|_| world.step(DT));
        (0..30).for_each(|_| read.step(DT));
        assert_eq!(world.state_hash(), read.state_hash());
    }
}
