//! Patients written by those who know the doctor's rules.

use super::{Case, Patient, add, crate_at, earth, earth_with, ground, left_alone, thing, with};
use tiny_physics::{Filter, JointDef, Locks, RigidBody, Settings, Shape, ShapeDef, Vec2, World};
use tiny_physics_doctor::Code;

pub(crate) fn all() -> Vec<Patient> {
    let patient = |name, code, steps, case| Patient { name, code, steps, case };
    vec![
        patient("velocity of NaN", Code::RefusedInput, 60, nan_velocity()),
        patient("pixels", Code::Size, 60, pixels()),
        patient("sand", Code::Size, 60, sand()),
        patient("a feather of lead", Code::Density, 60, lead()),
        patient("ten steps a second", Code::StepTooLong, 60, long_steps()),
        patient("the time of each frame", Code::VariableStep, 200, frame_times()),
        patient("created in the ground", Code::OverlapAtStart, 60, in_the_ground()),
        patient("a pile created too tightly", Code::OverlapAtStart, 60, tight_pile()),
        patient("portal through a wall", Code::Teleport, 60, portal()),
        patient("platform moved by positions", Code::Teleport, 120, placed_platform()),
        patient("mask without the ground", Code::Filter, 90, masks()),
        patient("player is a sensor", Code::Filter, 90, sensor_player()),
        patient("not enabled", Code::Filter, 90, disabled()),
        patient("continuous off", Code::Tunnelling, 60, not_continuous()),
        patient("just stopped", Code::NearMiss, 60, just_stopped()),
        patient("rocket", Code::SpeedLimit, 300, rocket()),
        patient("no floor there", Code::FellOut, 900, no_floor()),
        patient("wedged by locks", Code::Stuck, 300, wedged()),
        patient("press", Code::DeepOverlap, 400, press()),
        patient("anvil on a crate", Code::MassRatio, 200, anvil()),
        patient("rod between two nails", Code::JointFight, 300, two_nails()),
        patient("anchors far apart", Code::JointStretch, 300, far_anchors()),
        patient("door blocked beyond its limits", Code::LimitOverrun, 300, blocked_door()),
        patient("motor never off", Code::MotorAtLimit, 300, closed_door()),
        patient("swing pushed for ever", Code::EnergyGain, 900, pushed_swing()),
        patient("a slab stands out", Code::GhostBump, 200, ledge()),
        patient("hard floor", Code::RestitutionLost, 200, hard_floor()),
        patient("force to and fro", Code::Jitter, 400, shaken()),
        patient("soft contacts", Code::Sinking, 900, sinking()),
        patient("woken each step", Code::NeverSleeps, 600, woken()),
        patient("a level of single bodies", Code::Slow, 30, singles()),
    ]
}

fn nan_velocity() -> Case {
    let mut world = earth();
    ground(&mut world);
    let body = add(&mut world, crate_at(0.0, 0.5));
    with(world, move |world, step| {
        if step % 10 == 5 {
            world.body_mut(body).unwrap().set_velocity(Vec2::new(f32::NAN, 0.0));
        }
    })
}

fn pixels() -> Case {
    let mut world = World::new(Vec2::new(0.0, -9.8));
    let floor = Shape::rect(400.0, 16.0).unwrap();
    add(&mut world, RigidBody::fixed().position(Vec2::new(0.0, -16.0)).shape(floor));
    for i in 0..8 {
        add(&mut world, thing(Shape::rect(16.0, 16.0).unwrap(), 40.0 * i as f32 - 140.0, 40.0));
    }
    left_alone(world)
}

fn sand() -> Case {
    let mut world = earth();
    ground(&mut world);
    for i in 0..10 {
        add(&mut world, thing(Shape::circle(0.002).unwrap(), 0.01 * i as f32, 0.01));
    }
    left_alone(world)
}

fn lead() -> Case {
    let mut world = earth();
    ground(&mut world);
    for i in 0..5 {
        add(&mut world, crate_at(2.0 * i as f32, 0.5));
    }
    add(&mut world, crate_at(-3.0, 0.5).mass(50_000.0));
    left_alone(world)
}

fn long_steps() -> Case {
    let mut world = earth();
    ground(&mut world);
    add(&mut world, crate_at(0.0, 0.5));
    Case { world, act: Box::new(|_, _| 0.1) }
}

fn frame_times() -> Case {
    let mut world = earth();
    ground(&mut world);
    add(&mut world, crate_at(0.0, 0.5));
    Case { world, act: Box::new(|_, step| 0.008 + 0.001 * (step * 7 % 13) as f32) }
}

fn in_the_ground() -> Case {
    let mut world = earth();
    ground(&mut world);
    add(&mut world, crate_at(0.0, 0.2));
    left_alone(world)
}

fn tight_pile() -> Case {
    let mut world = earth();
    ground(&mut world);
    for i in 0..30 {
        let (row, column) = (i / 6, i % 6);
        add(&mut world, crate_at(0.8 * column as f32, 0.5 + 0.8 * row as f32));
    }
    left_alone(world)
}

fn wall_at(world: &mut World, x: f32) {
    let wall = Shape::rect(0.1, 5.0).unwrap();
    add(world, RigidBody::fixed().position(Vec2::new(x, 5.0)).shape(wall));
}

fn portal() -> Case {
    let mut world = earth();
    ground(&mut world);
    wall_at(&mut world, 2.0);
    let body = add(&mut world, crate_at(0.0, 0.5));
    with(world, move |world, step| {
        if step == 30 {
            world.body_mut(body).unwrap().set_position(Vec2::new(4.0, 0.5));
        }
    })
}

fn placed_platform() -> Case {
    let mut world = earth();
    ground(&mut world);
    let plate = Shape::rect(1.0, 0.1).unwrap();
    let plate = RigidBody::kinematic().position(Vec2::new(0.0, 4.0)).shape(plate);
    let plate = add(&mut world, plate);
    add(&mut world, crate_at(0.0, 0.5));
    with(world, move |world, step| {
        let y = if step < 60 { 4.0 } else { 4.0 - 0.2 * (step - 60) as f32 };
        world.body_mut(plate).unwrap().set_position(Vec2::new(0.0, y.max(0.6)));
    })
}

fn masks() -> Case {
    let mut world = earth();
    ground(&mut world);
    let filter = Filter { category: 2, mask: 2, group: 0 };
    let shape = ShapeDef::new(Shape::rect(0.5, 0.5).unwrap()).filter(filter);
    add(&mut world, RigidBody::dynamic().position(Vec2::new(0.0, 2.0)).shape(shape));
    left_alone(world)
}

fn sensor_player() -> Case {
    let mut world = earth();
    ground(&mut world);
    let shape = ShapeDef::new(Shape::circle(0.5).unwrap()).sensor();
    add(&mut world, RigidBody::dynamic().mass(1.0).position(Vec2::new(0.0, 2.0)).shape(shape));
    left_alone(world)
}

fn disabled() -> Case {
    let mut world = earth();
    ground(&mut world);
    let mut body = crate_at(0.0, 0.3);
    body.enabled = false;
    add(&mut world, body);
    left_alone(world)
}

fn not_continuous() -> Case {
    let settings = Settings { continuous: false, ..Settings::default() };
    let mut world = World::with_settings(Vec2::ZERO, settings);
    wall_at(&mut world, 0.0);
    let pea = thing(Shape::circle(0.1).unwrap(), -8.3, 5.0);
    add(&mut world, pea.velocity(Vec2::new(200.0, 0.0)));
    left_alone(world)
}

fn just_stopped() -> Case {
    let mut world = World::new(Vec2::ZERO);
    wall_at(&mut world, 0.0);
    let pea = thing(Shape::circle(0.1).unwrap(), -8.3, 5.0);
    add(&mut world, pea.velocity(Vec2::new(200.0, 0.0)));
    left_alone(world)
}

fn rocket() -> Case {
    let mut world = World::new(Vec2::ZERO);
    let body = add(&mut world, crate_at(0.0, 0.0));
    with(world, move |world, _| {
        world.body_mut(body).unwrap().apply_force_to_center(Vec2::new(500.0, 0.0));
    })
}

fn no_floor() -> Case {
    let mut world = earth();
    ground(&mut world);
    add(&mut world, crate_at(60.0, 2.0));
    left_alone(world)
}

fn wedged() -> Case {
    let mut world = earth();
    ground(&mut world);
    wall_at(&mut world, 0.3);
    wall_at(&mut world, -0.3);
    let body = crate_at(0.0, 0.5).locks(Locks { x: true, y: true, rotation: true });
    add(&mut world, body);
    left_alone(world)
}

fn press() -> Case {
    let mut world = earth();
    ground(&mut world);
    add(&mut world, crate_at(0.0, 0.5));
    let plate = Shape::rect(2.0, 0.2).unwrap();
    let plate = RigidBody::kinematic().position(Vec2::new(0.0, 2.0)).shape(plate);
    add(&mut world, plate.velocity(Vec2::new(0.0, -0.2)));
    left_alone(world)
}

fn anvil() -> Case {
    let mut world = earth();
    ground(&mut world);
    add(&mut world, crate_at(0.0, 0.5));
    add(&mut world, crate_at(0.0, 1.5).mass(400.0));
    left_alone(world)
}

fn two_nails() -> Case {
    let mut world = earth();
    let nail = add(&mut world, RigidBody::fixed());
    let rod = thing(Shape::rect(1.0, 0.1).unwrap(), 0.0, 0.0);
    let rod = add(&mut world, rod);
    for x in [-1.3, 1.3] {
        let hinge = JointDef::revolute().anchors(Vec2::new(x, 0.0), Vec2::new(x.signum(), 0.0));
        world.add_joint(nail, rod, hinge).unwrap();
    }
    left_alone(world)
}

fn far_anchors() -> Case {
    let mut world = World::new(Vec2::ZERO);
    let a = add(&mut world, crate_at(0.0, 0.0));
    let b = add(&mut world, crate_at(4.0, 0.0));
    world.add_joint(a, b, JointDef::revolute()).unwrap();
    left_alone(world)
}

fn blocked_door() -> Case {
    let mut world = World::new(Vec2::ZERO);
    let nail = add(&mut world, RigidBody::fixed());
    let (sin, cos) = (1.2_f32).sin_cos();
    let door = thing(Shape::rect(1.0, 0.05).unwrap(), cos, sin).angle(1.2);
    let door = add(&mut world, door);
    // A peg keeps it from going back.
    let peg = Vec2::new(1.5 * cos + 0.15 * sin, 1.5 * sin - 0.15 * cos);
    add(&mut world, RigidBody::fixed().position(peg).shape(Shape::circle(0.1).unwrap()));
    let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-1.0, 0.0)).limits(-0.5, 0.5);
    world.add_joint(nail, door, hinge).unwrap();
    left_alone(world)
}

fn closed_door() -> Case {
    let mut world = World::new(Vec2::ZERO);
    let nail = add(&mut world, RigidBody::fixed());
    let door = add(&mut world, thing(Shape::rect(1.0, 0.05).unwrap(), 1.0, 0.0));
    let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-1.0, 0.0)).limits(-0.5, 0.5);
    world.add_joint(nail, door, hinge.motor(1.0, 10.0)).unwrap();
    left_alone(world)
}

fn pushed_swing() -> Case {
    let mut world = earth();
    let nail = add(&mut world, RigidBody::fixed());
    let seat = add(&mut world, thing(Shape::circle(0.2).unwrap(), 0.3, -3.0));
    let hinge = JointDef::revolute().anchors(Vec2::ZERO, Vec2::new(-0.3, 3.0));
    world.add_joint(nail, seat, hinge).unwrap();
    with(world, move |world, _| {
        let mut seat = world.body_mut(seat).unwrap();
        let velocity = seat.as_ref().velocity();
        seat.apply_force_to_center(velocity.normalized() * 0.4);
    })
}

fn ledge() -> Case {
    let mut world = earth();
    for i in 0..10 {
        let slab = Shape::rect(1.0, 0.5).unwrap();
        let y = if i % 2 == 0 { -0.5 } else { -0.47 };
        add(&mut world, RigidBody::fixed().position(Vec2::new(2.0 * i as f32, y)).shape(slab));
    }
    let shape = ShapeDef::new(Shape::circle(0.3).unwrap()).friction(0.0);
    let slider = RigidBody::dynamic().position(Vec2::new(0.0, 0.3)).shape(shape).lock_rotation();
    add(&mut world, slider.velocity(Vec2::new(5.0, 0.0)));
    left_alone(world)
}

fn hard_floor() -> Case {
    let mut world = earth();
    ground(&mut world);
    let ball = thing(Shape::circle(0.3).unwrap(), 0.0, 4.0).restitution(0.8);
    add(&mut world, ball);
    left_alone(world)
}

fn shaken() -> Case {
    let mut world = earth();
    ground(&mut world);
    let body = add(&mut world, crate_at(0.0, 0.5));
    with(world, move |world, step| {
        let force = if step % 4 < 2 { 20.0 } else { -20.0 };
        world.body_mut(body).unwrap().apply_force_to_center(Vec2::new(force, 0.0));
    })
}

fn sinking() -> Case {
    let settings =
        Settings { contact_hertz: 1.0, refine_up_to: 0, push_speed: 0.0, ..Settings::default() };
    let mut world = earth_with(settings);
    ground(&mut world);
    let body = add(&mut world, crate_at(0.0, 0.5));
    with(world, move |world, step| {
        let load = -0.05 * step as f32;
        world.body_mut(body).unwrap().apply_force_to_center(Vec2::new(0.0, load));
    })
}

fn woken() -> Case {
    let mut world = earth();
    ground(&mut world);
    let body = add(&mut world, crate_at(0.0, 0.5));
    with(world, move |world, _| world.body_mut(body).unwrap().wake())
}

fn singles() -> Case {
    let mut world = earth();
    for i in 0..2500 {
        let tile = RigidBody::fixed().position(Vec2::new(i as f32, -0.5));
        add(&mut world, tile.shape(Shape::rect(0.5, 0.5).unwrap()));
    }
    add(&mut world, crate_at(5.0, 0.5));
    left_alone(world)
}
