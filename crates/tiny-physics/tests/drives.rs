//! Motors and springs on what has more hanging on it than their own two bodies, and what joints tell of it.

mod common;

use common::{Random, circle, rect, steps};
use tiny_physics::{
    BodyId, JointDef, JointId, JointKind, Limits, Locks, RigidBody, Shape, SimdLevel, Spring, Vec2,
    World,
};

fn space() -> World {
    let mut world = World::new(Vec2::ZERO);
    world.settings.sleep = false;
    world
}

fn wall(world: &mut World) -> BodyId {
    world.add_body(RigidBody::fixed()).expect("a wall")
}

fn add(world: &mut World, shape: Shape, mass: f32, place: Vec2) -> BodyId {
    let body = RigidBody::dynamic().shape(shape).mass(mass).position(place);
    world.add_body(body).expect("a body")
}

fn spin(world: &World, body: BodyId) -> f32 {
    world.body(body).expect("it is there").angular_velocity()
}

fn motor_load(world: &World, joint: JointId) -> f32 {
    world.joint(joint).expect("it is there").torque()
}

/// A small hub that turns large blades has their speed soon, and keeps it.
#[test]
fn a_motor_turns_what_is_welded_to_its_body() {
    for (blade, mass) in [(0.5, 1.0), (1.0, 20.0), (2.0, 10.0)] {
        let mut world = space();
        let wall = wall(&mut world);
        let hub = add(&mut world, circle(0.1), 1.0, Vec2::ZERO);
        let blades = add(&mut world, rect(blade, 0.1), mass, Vec2::ZERO);
        world.add_joint(wall, hub, JointDef::revolute().motor(1.0, 1e6)).expect("a motor");
        world.add_joint(hub, blades, JointDef::weld()).expect("a weld");
        let mut most = 0.0_f32;
        for step in 0..240 {
            steps(&mut world, 1);
            let spin = spin(&world, blades);
            most = most.max(spin);
            assert!(
                step < 60 || (spin - 1.0).abs() < 0.02,
                "{blade} m, {mass} kg, step {step}: {spin}"
            );
        }
        assert!(most < 1.1, "{blade} m, {mass} kg: {most}");
    }
}

/// A pinion drives a wheel through gears.
#[test]
fn a_motor_drives_through_gears() {
    let mut world = space();
    let wall = wall(&mut world);
    let pinion = add(&mut world, circle(0.1), 1.0, Vec2::new(-1.1, 0.0));
    let wheel = add(&mut world, circle(1.0), 100.0, Vec2::ZERO);
    let at = |x: f32| JointDef::revolute().anchor_at(Vec2::new(x, 0.0));
    world.add_joint(wall, pinion, at(-1.1).motor(1.0, 1e5)).expect("a motor");
    world.add_joint(wall, wheel, at(0.0)).expect("an axle");
    world.add_joint(pinion, wheel, JointDef::gear(10.0)).expect("a gear");
    let mut most = 0.0_f32;
    for step in 0..240 {
        steps(&mut world, 1);
        let spin = spin(&world, pinion);
        most = most.max(spin);
        assert!(step < 60 || (spin - 1.0).abs() < 0.05, "step {step}: {spin}");
    }
    assert!(most < 1.2, "{most}");
}

/// What hangs by a soft weld from a light bar that bears something heavy is still.
#[test]
fn a_tree_that_hangs_softly_is_at_rest() {
    for substeps in [4, 1] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        world.settings.substeps = substeps;
        let ceiling = wall(&mut world);
        let bar = add(&mut world, rect(0.1, 0.5), 1.0, Vec2::new(0.0, -2.5));
        let load = add(&mut world, rect(0.1, 0.5), 10.0, Vec2::new(0.0, -3.5));
        let weld = JointDef::weld().anchor_at(Vec2::new(0.0, -2.0)).softness(20.0, 1.0);
        world.add_joint(ceiling, bar, weld).expect("a weld");
        let hinge = JointDef::revolute().anchor_at(Vec2::new(0.0, -3.0));
        world.add_joint(bar, load, hinge).expect("a hinge");
        steps(&mut world, 600);
        let load = world.body(load).expect("a load");
        assert!(
            load.velocity().length() < 2e-3 && !load.is_awake(),
            "{substeps}: {:?}",
            load.velocity()
        );
    }
}

/// A spring bends a long arm as its formula says.
#[test]
fn springs_on_long_arms_have_their_frequency() {
    for (radius, arm) in [(0.1, 3.0), (0.2, 6.0), (0.5, 1.0)] {
        let mut world = space();
        let wall = wall(&mut world);
        let bob = add(&mut world, circle(radius), 1.0, Vec2::new(arm, 0.0));
        let hinge = JointDef::revolute().anchor_at(Vec2::ZERO).spring(1.0, 0.0);
        let joint = world.add_joint(wall, bob, hinge).expect("a hinge");
        world.joint_mut(joint).expect("a hinge").set_target(0.1).expect("a target");
        let angle = |world: &World| world.joint(joint).expect("a hinge").angle();
        let mut turns = Vec::new();
        let mut before = angle(&world) - 0.1;
        for step in 0..600 {
            steps(&mut world, 1);
            let now = angle(&world) - 0.1;
            if before < 0.0 && now >= 0.0 {
                turns.push(step as f32 / 60.0);
            }
            before = now;
        }
        let period = (turns[turns.len() - 1] - turns[0]) / (turns.len() - 1) as f32;
        assert!((period - 1.0).abs() < 0.05, "{radius} on {arm} m: {period} s");
    }
}

/// A motor whose body cannot turn any more bears nothing.
#[test]
fn a_motor_on_what_cannot_turn_bears_nothing() {
    let mut world = space();
    let wall = wall(&mut world);
    let disk = add(&mut world, circle(0.5), 1.0, Vec2::ZERO);
    let joint =
        world.add_joint(wall, disk, JointDef::revolute().motor(0.0, 100.0)).expect("a brake");
    for _ in 0..30 {
        world.body_mut(disk).expect("a disk").apply_torque(20.0);
        steps(&mut world, 1);
    }
    assert!((motor_load(&world, joint) + 20.0).abs() < 0.5);
    let locks = Locks { rotation: true, ..Locks::default() };
    world.body_mut(disk).expect("a disk").set_locks(locks);
    steps(&mut world, 10);
    assert!(motor_load(&world, joint).abs() < 1e-3, "{}", motor_load(&world, joint));
}

/// So does a carriage that pulls a heavy train, whichever of its bodies comes first, at any rate of steps, in any unit, and a hub with an arm on
/// one side; all alike at every level.
#[test]
fn motors_reach_their_speed_whatever_they_drive() {
    for member in 0..24 {
        let (swapped, unit) = (member % 2 == 1, if member % 4 < 2 { 1.0 } else { 50.0 });
        let dt = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 240.0][member / 4 % 3];
        let play = |level: SimdLevel| {
            let mut world = space();
            world.set_simd(level).expect("a level");
            world.settings.length_unit = unit;
            let wall = wall(&mut world);
            let small = add(&mut world, rect(0.1 * unit, 0.1 * unit), 1.0, Vec2::ZERO);
            let mass = if member < 12 { 80.0 } else { 8.0 };
            let place = Vec2::new(1.5 * unit, 0.0);
            let large = add(&mut world, rect(unit, 0.5 * unit), mass, place);
            let mut join = |a: BodyId, b: BodyId, joint: JointDef| {
                let (a, b) = if swapped { (b, a) } else { (a, b) };
                world.add_joint(a, b, joint).expect("a joint");
            };
            let goal = if swapped { -unit } else { unit };
            if member < 12 {
                join(wall, small, JointDef::prismatic(Vec2::new(1.0, 0.0)).motor(goal, 1e9));
            } else {
                let speed = if swapped { -1.0 } else { 1.0 };
                join(wall, small, JointDef::revolute().motor(speed, 1e9));
            }
            join(small, large, JointDef::weld().anchor_at(Vec2::new(0.3 * unit, 0.0)));
            let reached = |world: &World| match member < 12 {
                true => world.body(large).expect("a train").velocity().x / unit,
                false => spin(world, large),
            };
            let mut most = 0.0_f32;
            for _ in 0..(2.0 / dt) as usize {
                world.step(dt);
                most = most.max(reached(&world));
            }
            (reached(&world), most, world.state_hash())
        };
        let (reached, most, hash) = play(SimdLevel::Scalar);
        assert!((reached - 1.0).abs() < 0.02 && most < 1.15, "{member}: {reached}, {most} at most");
        for level in SimdLevel::available() {
            assert_eq!(play(level).2, hash, "{member}: {level}");
        }
    }
}

/// A spring has its frequency for its two bodies; under a load it sinks by as many times more as that makes what moves heavier.
#[test]
fn springs_sink_in_proportion_to_what_lies_on_them() {
    for load in [0.0, 1.0, 4.0] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let wall = wall(&mut world);
        let plate = add(&mut world, rect(1.0, 0.1), 1.0, Vec2::ZERO);
        let spring = JointDef::prismatic(Vec2::new(0.0, 1.0)).spring(4.0, 0.7);
        world.add_joint(wall, plate, spring).expect("a spring");
        if load > 0.0 {
            add(&mut world, rect(0.3, 0.3), load, Vec2::new(0.0, 0.4));
        }
        steps(&mut world, 600);
        let rate = core::f32::consts::TAU * 4.0;
        let sunk = -world.body(plate).expect("a plate").position().y;
        let formula = (1.0 + load) * 10.0 / (rate * rate);
        assert!((sunk - formula).abs() < 0.02 * formula + 2e-4, "{load} kg: {sunk}, {formula}");
    }
}

/// What pushes a hinge far beyond a limit is taken back no faster than what may stand in its way can be seen to.
#[test]
fn limits_that_move_do_not_jump_over_what_is_between() {
    for (mass, turn) in [(3.0, 0.7), (30.0, 0.4), (3.0, 1.0)] {
        let mut world = space();
        let wall = wall(&mut world);
        let door = RigidBody::dynamic().shape(rect(1.0, 0.05)).mass(mass);
        let along = Vec2::new(1.5_f32.cos(), 1.5_f32.sin());
        let door = world.add_body(door.position(along).angle(1.5)).expect("a door");
        let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-1.0, 0.0)).limits(0.0, 1.6);
        let hinge = world.add_joint(wall, door, hinge).expect("a hinge");
        let ball = add(&mut world, circle(0.2), 1.0, Vec2::new(f32::cos(turn), f32::sin(turn)));
        steps(&mut world, 1);
        world
            .joint_mut(hinge)
            .expect("a hinge")
            .set_limits(Some(Limits { lower: 0.0, upper: 0.1 }))
            .unwrap();
        let mut fastest = 0.0_f32;
        for _ in 0..120 {
            let before = world.body(door).expect("a door").angle();
            steps(&mut world, 1);
            let after = world.body(door).expect("a door").angle();
            fastest = fastest.max((after - before).abs());
        }
        let at = world.body(ball).expect("a ball").position();
        let (angle, ball) = (world.body(door).expect("a door").angle(), (at.y / at.x).atan());
        assert!(fastest < 0.3, "{mass} kg: {fastest} rad a step");
        assert!(angle < 0.11, "{mass} kg: open by {angle}");
        assert!(ball < angle || at.length() > 2.0, "{mass} kg: {ball} of {angle}");
    }
}

/// Stiff springs with little damping that share a body swing and do not swing up.
#[test]
fn many_stiff_springs_on_one_body_hold() {
    for (count, hertz, damping) in [
        (3, 60.0, 0.0),
        (3, 60.0, 0.1),
        (3, 60.0, 0.3),
        (4, 60.0, 0.1),
        (8, 60.0, 0.1),
        (8, 40.0, 0.0),
    ] {
        let mut world = space();
        let wall = wall(&mut world);
        let ball = add(&mut world, circle(0.3), 1.0, Vec2::ZERO);
        for k in 0..count {
            let anchor = Vec2::new(if k % 2 == 0 { -1.0 } else { 1.0 }, 0.0);
            let spring = JointDef::distance(1.0).spring(hertz, damping).anchors(anchor, Vec2::ZERO);
            world.add_joint(wall, ball, spring).expect("a spring");
        }
        world.body_mut(ball).expect("a ball").set_velocity(Vec2::new(0.01, 0.0));
        for step in 0..240 {
            steps(&mut world, 1);
            let speed = world.body(ball).expect("a ball").velocity().length();
            assert!(speed < 0.02, "{count} of {hertz} Hz, {damping}: {speed} in step {step}");
        }
    }
}

/// So do nets of them, with diagonals, and where a step is one substep.
#[test]
fn nets_of_stiff_springs_hold() {
    let across = 2.0_f32.sqrt();
    let springs = [
        (4, 60.0, 0.1),
        (4, 30.0, 0.0),
        (1, 15.0, 0.1),
        (8, 200.0, 0.05),
        (4, 40.0, 0.0),
        (4, 26.0, 0.0),
        (4, 50.0, 0.3),
        (4, 35.0, 0.2),
        (1, 7.0, 0.0),
    ];
    for (net, (substeps, hertz, damping)) in springs.into_iter().flat_map(|s| [(4, s), (8, s)]) {
        let mut world = space();
        world.settings.substeps = substeps;
        let knots: Vec<BodyId> = (0..36)
            .map(|k| add(&mut world, circle(0.1), 0.3, Vec2::new((k % 6) as f32, (k / 6) as f32)))
            .collect();
        for k in 0..36i32 {
            let far = 5.0_f32.sqrt();
            let others = [
                (1, 0, 1.0),
                (0, 1, 1.0),
                (1, 1, across),
                (-1, 1, across),
                (2, 1, far),
                (-2, 1, far),
                (1, 2, far),
                (-1, 2, far),
            ];
            let others = &others[..net];
            for &(dx, dy, length) in others {
                let (x, y) = (k % 6 + dx, k / 6 + dy);
                if (0..6).contains(&x) && y < 6 {
                    let spring = JointDef::distance(length).spring(hertz, damping);
                    let (a, b) = (knots[k as usize], knots[(6 * y + x) as usize]);
                    world.add_joint(a, b, spring).expect("a spring");
                }
            }
        }
        world.body_mut(knots[14]).expect("a knot").set_velocity(Vec2::new(0.3, 0.1));
        for step in 0..300 {
            steps(&mut world, 1);
            let speeds = knots.iter().map(|&knot| world.body(knot).expect("a knot").velocity());
            let most = speeds.map(Vec2::length).fold(0.0, f32::max);
            assert!(most < 0.5, "{net}, {substeps}, {hertz} Hz, {damping}: {most} in step {step}");
        }
    }
}

/// Two free bars whose hinge is made far outside its limits come together slowly, whatever they weigh, and turn nobody through
/// anybody.
#[test]
fn hinges_made_outside_their_limits_come_in_slowly() {
    for (light, bent) in [(1.0, 2.0), (0.1, -1.0), (10.0, 2.8)] {
        let mut world = space();
        let first = add(&mut world, rect(1.0, 0.05), 1.0, Vec2::ZERO);
        let at = Vec2::new(1.0 + f32::cos(bent), f32::sin(bent));
        let other = RigidBody::dynamic().shape(rect(1.0, 0.05)).mass(light).angle(bent);
        let other = world.add_body(other.position(at)).expect("a bar");
        let hinge = JointDef::revolute().anchors(Vec2::new(1.0, 0.0), Vec2::new(-1.0, 0.0));
        world.add_joint(first, other, hinge.limits(-0.1, 0.1)).expect("a hinge");
        let angle = |world: &World| {
            let of = |body| world.body(body).expect("a bar").rotation();
            of(other).angle_from(of(first))
        };
        let mut before = angle(&world);
        for step in 0..240 {
            steps(&mut world, 1);
            let after = angle(&world);
            let turned = (after - before).abs();
            assert!(turned < 0.3, "{light} kg, {bent}: {turned} in step {step}");
            before = after;
        }
        assert!(before.abs() < 0.11, "{light} kg, {bent}: {before}");
    }
}

/// Sliders that are made far beside their lines come in, and turn no faster than what they pull together.
#[test]
fn sliders_made_out_of_place_do_not_spin_up() {
    let mut random = Random::new(77);
    for member in 0..200 {
        let mut world = space();
        let mut body = || {
            let shape = rect(random.range(0.2, 0.5), random.range(0.2, 0.5));
            let body = RigidBody::dynamic().shape(shape).angle(random.range(-3.0, 3.0));
            let body = body.velocity((random.range(-5.0, 5.0), random.range(-5.0, 5.0)));
            let place = Vec2::new(random.range(-5.0, 5.0), random.range(-5.0, 5.0));
            let body = body.angular_velocity(random.range(-5.0, 5.0)).position(place);
            world.add_body(body).expect("a body")
        };
        let (a, b) = (body(), body());
        let slider = JointDef::prismatic(Vec2::X);
        let slider = if member % 2 == 0 { slider.limits(-1.0, 1.0) } else { slider };
        world.add_joint(a, b, slider).expect("a slider");
        for step in 0..300 {
            steps(&mut world, 1);
            for body in [a, b].map(|body| world.body(body).expect("a body")) {
                let (speed, spin) = (body.velocity().length(), body.angular_velocity().abs());
                assert!(speed < 60.0 && spin < 120.0, "{member}, {step}: {speed}, {spin}");
            }
        }
    }
}

/// A crane shortens its rope.
#[test]
fn ropes_take_a_new_length() {
    let mut world = World::new(Vec2::new(0.0, -10.0));
    let wall = wall(&mut world);
    let load = add(&mut world, circle(0.3), 4.0, Vec2::new(0.0, -5.0));
    let rope = world.add_joint(wall, load, JointDef::rope(5.0)).expect("a rope");
    for length in [3.0, 6.0] {
        world.joint_mut(rope).expect("a rope").set_target(length).expect("it has a length");
        steps(&mut world, 400);
        let y = world.body(load).expect("a load").position().y;
        assert!((y + length).abs() < 0.02, "{y} of {length}");
    }
}

/// Softness makes a weld give way a little; it sags by what its stiffness says, and hurls nothing.
#[test]
fn soft_welds_hold_a_beam_by_its_end() {
    let spring = Some(Spring { hertz: 20.0, damping_ratio: 1.0 });
    for (linear, angular) in [(None, None), (spring, None), (None, spring)] {
        let mut world = World::new(Vec2::new(0.0, -10.0));
        let wall = wall(&mut world);
        let beam = add(&mut world, rect(0.5, 0.1), 1.0, Vec2::new(0.5, 0.0));
        let mut weld = JointDef::weld().anchor_at(Vec2::ZERO).softness(20.0, 1.0);
        weld.kind = JointKind::Weld { linear, angular };
        world.add_joint(wall, beam, weld).expect("a weld");
        for step in 0..600 {
            steps(&mut world, 1);
            let beam = world.body(beam).expect("a beam");
            let (spin, low) = (beam.angular_velocity(), -beam.position().y);
            assert!(spin.abs() < 1.0 && low < 0.01, "{linear:?} {angular:?} {step}: {spin}, {low}");
        }
    }
}

/// A spring that pulls with all that it may pulls with that, and says so.
#[test]
fn a_spring_at_its_most_pulls_with_it() {
    for (force, hertz, damping_ratio, far) in [(50.0, 5.0, 0.7, 10.0), (100.0, 10.0, 5.0, 300.0)] {
        for drive in [false, true] {
            let mut world = space();
            world.settings.substeps = if drive { 8 } else { 4 };
            let wall = wall(&mut world);
            let spring = Spring { hertz, damping_ratio };
            let crate_ = add(&mut world, rect(0.2, 0.2), 1.0, Vec2::ZERO);
            let mut def = JointDef::mouse(Vec2::new(far, 0.0), force);
            if drive {
                def = JointDef::drive().anchors((far, 0.0), (0.0, 0.0));
            }
            match &mut def.kind {
                JointKind::Mouse { spring: own, .. } => *own = spring,
                JointKind::Motor { linear_spring, max_spring_force, .. } => {
                    (*linear_spring, *max_spring_force) = (Some(spring), force);
                }
                _ => {}
            }
            let joint = world.add_joint(wall, crate_, def).expect("a joint");
            steps(&mut world, 30);
            let (way, speed) = (0.125 * force, 0.5 * force);
            let body = world.body(crate_).expect("a crate");
            let (x, v) = (body.position().x, body.velocity().x);
            let told = world.joint(joint).expect("a joint").force().length();
            // Some of it is the damper's.
            assert!((x / way - 1.0).abs() < 0.06, "{force} N, {drive}: {x} m, not {way}");
            assert!((v / speed - 1.0).abs() < 0.06, "{force} N, {drive}: {v} m/s, not {speed}");
            assert!((told / force - 1.0).abs() < 0.01, "{force} N, {drive}: {told} N");
        }
    }
}

/// The same of what turns: it has turned by half of the torque over the inertia by the square of the time.
#[test]
fn a_spring_at_its_greatest_torque_turns_with_it() {
    for (torque, hertz, damping_ratio, substeps) in [(0.05, 5.0, 0.7, 4), (0.1, 10.0, 5.0, 2)] {
        let mut world = space();
        world.settings.substeps = substeps;
        let wall = wall(&mut world);
        let body = add(&mut world, rect(0.5, 0.5), 1.0, Vec2::ZERO);
        let mut def = JointDef::drive().angles(3.0, 0.0);
        if let JointKind::Motor { angular_spring, max_spring_torque, .. } = &mut def.kind {
            *angular_spring = Some(Spring { hertz, damping_ratio });
            *max_spring_torque = torque;
        }
        let joint = world.add_joint(wall, body, def).expect("a joint");
        steps(&mut world, 120);
        let found = world.body(body).expect("a body");
        let expected = 2.0 * torque / found.inertia();
        let (turned, told) = (found.angle(), world.joint(joint).expect("a joint").torque());
        assert!((turned / expected - 1.0).abs() < 0.06, "{torque} N m: {turned}, not {expected}");
        assert!((told / torque - 1.0).abs() < 0.01, "{torque} N m: {told} N m");
    }
}

/// Before, a mouse joint braked turning whatever its force was.
#[test]
fn a_mouse_joint_of_no_force_does_nothing() {
    let mut world = space();
    let ground = wall(&mut world);
    let body = RigidBody::dynamic().angular_velocity(10.0).velocity((1.0, 0.0));
    let body = world.add_body(body.shape(rect(0.5, 0.5))).expect("a body");
    world.add_joint(ground, body, JointDef::mouse((0.0, 0.0), 0.0)).expect("a hand");
    steps(&mut world, 60);
    let body = world.body(body).expect("a body");
    assert_eq!((body.velocity(), body.angular_velocity()), (Vec2::new(1.0, 0.0), 10.0));
}
