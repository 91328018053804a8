//! Energy, bounces, seams; rest that is none; and slowness.

use super::*;
use tiny_physics::math;

pub(super) fn all() -> Vec<Patient> {
    let mut patients = energy();
    patients.extend(surfaces());
    patients.extend(unrest());
    patients.extend(slowness());
    patients
}

fn energy() -> Vec<Patient> {
    vec![
        patient("pinball with bumpers of 1.4", Code::EnergyGain, 400, pinball()),
        patient("hook that makes trampolines of all", Code::EnergyGain, 500, trampolines()),
        patient("drag with the wrong sign", Code::EnergyGain, 400, wrong_drag()),
    ]
}

/// The bumpers give back more than they get, and there is no damping.
fn pinball() -> Case {
    let mut world = World::new(Vec2::new(0.0, -2.0));
    court(&mut world, 6.0, 8.0);
    for i in 0..6 {
        let place = Vec2::new(-3.0 + 3.0 * (i % 3) as f32, -2.0 + 4.0 * (i / 3) as f32);
        let bumper = RigidBody::fixed().position(place).shape(Shape::circle(0.8).unwrap());
        add(&mut world, bumper.restitution(1.4));
    }
    for id in world.body_ids().take(4).collect::<Vec<_>>() {
        let shape = world.body(id).unwrap().shapes().next().unwrap();
        let material = tiny_physics::Material { restitution: 0.9, ..Default::default() };
        world.shape_mut(shape).unwrap().set_material(material).unwrap();
    }
    for i in 0..3 {
        let ball = ball(0.25, -2.0 + 1.7 * i as f32, 6.0).restitution(1.4);
        add(&mut world, ball.velocity(Vec2::new(2.0, -3.0)));
    }
    left_alone(world)
}

fn trampolines() -> Case {
    let mut world = earth();
    ground(&mut world);
    for i in 0..5 {
        add(&mut world, ball(0.4, -8.0 + 4.0 * i as f32, 2.0 + 0.4 * i as f32));
    }
    world.set_pre_solve(|_, _, rules| rules.restitution = 1.2);
    left_alone(world)
}

/// `force = +c v`: toy boats get faster and faster.
fn wrong_drag() -> Case {
    let mut world = from_above();
    court(&mut world, 15.0, 9.0);
    let boats: Vec<_> = (0..4)
        .map(|i| {
            let boat = plank(0.6, 0.25, -6.0 + 4.0 * i as f32, -4.0 + 2.5 * i as f32);
            add(&mut world, boat.velocity(Vec2::new(0.3, 0.1)).restitution(0.2))
        })
        .collect();
    with(world, move |world, _| {
        for &boat in &boats {
            let mut boat = world.body_mut(boat).unwrap();
            let velocity = boat.as_ref().velocity();
            boat.apply_force_to_center(velocity * 0.6);
        }
    })
}

fn surfaces() -> Vec<Patient> {
    vec![
        patient("stone over tiles of uneven height", Code::GhostBump, 300, uneven_tiles()),
        patient("cart over a lift 6 mm too high", Code::GhostBump, 300, parked_lift()),
        patient("rubber ball on a floor of stone", Code::RestitutionLost, 240, rubber_ball()),
        patient("marbles that drop by centimetres", Code::RestitutionLost, 240, marbles()),
    ]
}

/// A level editor rounded heights: every other tile stands out by 5 mm.
fn uneven_tiles() -> Case {
    let mut world = earth();
    for i in 0..30 {
        let top = if i % 2 == 0 { 0.0 } else { 0.005 };
        let shape = Shape::rect(0.5, 0.5).unwrap();
        let tile = RigidBody::fixed().position(Vec2::new(-10.0 + i as f32, top - 0.5)).shape(shape);
        add(&mut world, tile.friction(0.0));
    }
    let stone = plank(0.3, 0.2, -9.8, 0.21).friction(0.0).lock_rotation();
    add(&mut world, stone.velocity(Vec2::new(5.0, 0.0)));
    left_alone(world)
}

fn parked_lift() -> Case {
    let mut world = earth();
    block(&mut world, -8.0, -0.5, 8.0, 0.5);
    block(&mut world, 12.0, -0.5, 8.0, 0.5);
    village(&mut world, 12.0, 0.0);
    let lift = RigidBody::kinematic().position(Vec2::new(2.0, -0.144));
    add(&mut world, lift.shape(Shape::rect(2.0, 0.15).unwrap()).friction(0.0));
    let cart = plank(0.8, 0.3, -8.0, 0.3).friction(0.0).velocity(Vec2::new(4.0, 0.0));
    add(&mut world, cart);
    left_alone(world)
}

fn rubber_ball() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, -10.0, 0.0);
    for i in 0..4 {
        add(&mut world, ball(0.3, 2.0 + 2.0 * i as f32, 3.0 + 0.5 * i as f32).restitution(0.85));
    }
    left_alone(world)
}

/// All bounce by 0.9, but they arrive at less than 1 m/s.
fn marbles() -> Case {
    let mut world = earth();
    let table = Shape::rect(2.0, 0.1).unwrap();
    let table = RigidBody::fixed().position(Vec2::new(0.0, -0.1)).shape(table);
    add(&mut world, table.restitution(0.9));
    for i in 0..6 {
        add(&mut world, ball(0.1, -1.2 + 0.45 * i as f32, 0.14).restitution(0.9));
    }
    left_alone(world)
}

fn unrest() -> Vec<Patient> {
    vec![
        patient("guard trembles at its waypoint", Code::Jitter, 400, waypoint()),
        patient("friction by hand that overshoots", Code::Jitter, 400, friction_by_hand()),
        patient("turret that overshoots its aim", Code::Jitter, 400, turret()),
        patient("gravity by hand keeps a yard awake", Code::NeverSleeps, 400, gravity_by_hand()),
        patient("sleep switched off and forgotten", Code::NeverSleeps, 400, no_sleep()),
        patient("parked cars whose brakes push on", Code::NeverSleeps, 400, brakes()),
        patient("statue on contacts of 0.8 Hz", Code::Sinking, 400, soft_ground()),
        patient("tower with one substep and no push", Code::Sinking, 500, cheap_tower()),
    ]
}

/// Full speed towards the waypoint in every frame, no dead zone.
fn waypoint() -> Case {
    let mut world = earth();
    ground(&mut world);
    village(&mut world, 8.0, 0.0);
    let guard = Shape::capsule(Vec2::new(0.0, -0.5), Vec2::new(0.0, 0.5), 0.3).unwrap();
    let guard = add(&mut world, thing(guard, -5.0, 0.8).lock_rotation());
    with(world, move |world, _| {
        let mut guard = world.body_mut(guard).unwrap();
        let (place, velocity) = (guard.as_ref().position(), guard.as_ref().velocity());
        let way = if place.x < 0.013 { 3.0 } else { -3.0 };
        guard.set_velocity(Vec2::new(way, velocity.y));
    })
}

/// Friction by hand on ice: half a metre a second against the motion in each frame, past zero too.
fn friction_by_hand() -> Case {
    let mut world = earth();
    let ice = Shape::rect(50.0, 0.5).unwrap();
    let ice = RigidBody::fixed().position(Vec2::new(0.0, -0.5)).shape(ice).friction(0.0);
    add(&mut world, ice);
    let mut sledges = Vec::new();
    for i in 0..5 {
        let sledge = plank(0.6, 0.25, -8.0 + 3.0 * i as f32, 0.25);
        sledges.push(add(&mut world, sledge.velocity(Vec2::new(4.2 + 0.13 * i as f32, 0.0))));
    }
    with(world, move |world, _| {
        for &id in &sledges {
            let mut sledge = world.body_mut(id).unwrap();
            let velocity = sledge.as_ref().velocity();
            sledge.set_velocity(velocity - Vec2::new(0.5 * velocity.x.signum(), 0.0));
        }
    })
}

/// Turns at the target with full torque either way.
fn turret() -> Case {
    let mut world = from_above();
    court(&mut world, 12.0, 8.0);
    pucks(&mut world, 14);
    let base = add(&mut world, RigidBody::fixed().position(Vec2::new(0.0, 4.0)));
    let gun = add(&mut world, plank(0.8, 0.15, 0.0, 4.0).damping(0.0, 6.0));
    world.add_joint(base, gun, JointDef::revolute()).unwrap();
    with(world, move |world, _| {
        let mut gun = world.body_mut(gun).unwrap();
        let error = 0.7 - gun.as_ref().angle();
        gun.apply_torque(if error > 0.0 { 3.0 } else { -3.0 });
    })
}

/// The world has no gravity; the game adds it as a force, every frame, to each crate.
fn gravity_by_hand() -> Case {
    let mut world = from_above();
    ground(&mut world);
    let mut crates = Vec::new();
    for column in 0..12 {
        for row in 0..4 {
            crates.push(add(&mut world, crate_at(-12.0 + 2.0 * column as f32, 0.5 + row as f32)));
        }
    }
    with(world, move |world, _| {
        for &id in &crates {
            let mut body = world.body_mut(id).unwrap();
            let mass = body.as_ref().mass();
            body.apply_force_to_center(Vec2::new(0.0, -10.0 * mass));
        }
    })
}

/// Once, to look for a bug.
fn no_sleep() -> Case {
    let mut world = earth_with(Settings { sleep: false, ..Settings::default() });
    ground(&mut world);
    for i in 0..6 {
        village(&mut world, -40.0 + 12.0 * i as f32, 0.0);
    }
    left_alone(world)
}

/// `set_velocity(0, 0)` for everything whose driver is absent.
fn brakes() -> Case {
    let mut world = from_above();
    court(&mut world, 20.0, 10.0);
    let mut cars = Vec::new();
    for i in 0..16 {
        let place = Vec2::new(-14.0 + 4.0 * (i % 8) as f32, -4.0 + 6.0 * (i / 8) as f32);
        cars.push(add(&mut world, plank(1.0, 0.5, place.x, place.y).damping(2.0, 2.0)));
    }
    with(world, move |world, _| {
        for &car in &cars {
            let mut car = world.body_mut(car).unwrap();
            car.apply_force_to_center(Vec2::new(-0.001, 0.0) - car.as_ref().velocity());
        }
    })
}

/// A weathercock that a motor turns: what carries it never sleeps, and rightly so.
fn weathercock(world: &mut World, carrier: BodyId, height: f32) {
    let base = world.body(carrier).unwrap().position();
    let cock = add(world, plank(0.4, 0.05, base.x, base.y + height).mass(1.0));
    let axle = JointDef::revolute().anchors(Vec2::new(0.0, height), Vec2::ZERO).motor(1.5, 20.0);
    world.add_joint(carrier, cock, axle).unwrap();
}

/// "Softer ground": contacts of 0.8 Hz, damped by 10.
fn soft_ground() -> Case {
    let settings =
        Settings { contact_hertz: 0.8, contact_damping_ratio: 10.0, ..Settings::default() };
    let mut world = earth_with(settings);
    ground(&mut world);
    for i in 0..4 {
        add(&mut world, crate_at(4.0 + 2.0 * i as f32, 0.5));
    }
    let statue = add(&mut world, plank(0.8, 2.0, 0.0, 2.0).mass(3000.0));
    weathercock(&mut world, statue, 2.6);
    left_alone(world)
}

/// Cheap settings for a phone: one substep, no refinement, a soft contact, no push out.
fn cheap_tower() -> Case {
    let settings = Settings {
        substeps: 1,
        refine_up_to: 0,
        push_speed: 0.0,
        contact_hertz: 4.0,
        contact_damping_ratio: 15.0,
        ..Settings::default()
    };
    let mut world = earth_with(settings);
    ground(&mut world);
    let mut top = add(&mut world, plank(1.0, 0.4, 0.0, 0.4));
    for i in 1..14 {
        top = add(&mut world, plank(1.0, 0.4, 0.0, 0.4 + 0.8 * i as f32));
    }
    weathercock(&mut world, top, 0.9);
    left_alone(world)
}

fn slowness() -> Vec<Patient> {
    vec![
        patient("substeps 60 and iterations 20", Code::Slow, 200, many_substeps()),
        patient("coins that all see the whole level", Code::Slow, 150, all_seeing()),
    ]
}

/// To cure a wobble that came from elsewhere.
fn many_substeps() -> Case {
    let settings = Settings { substeps: 60, iterations: 20, ..Settings::default() };
    let mut world = earth_with(settings);
    ground(&mut world);
    for i in 0..500 {
        let place = Vec2::new(-10.0 + 1.1 * (i % 18) as f32, 0.5 + 1.4 * (i / 18) as f32);
        add(&mut world, crate_at(place.x, place.y).velocity(Vec2::new(0.0, 2.0)));
    }
    left_alone(world)
}

/// Each coin finds the hero by a sensor of 60 m.
fn all_seeing() -> Case {
    let mut world = earth();
    ground(&mut world);
    for i in 0..160 {
        let eye = ShapeDef::new(Shape::circle(60.0).unwrap()).sensor().density(0.0);
        let place = Vec2::new(-24.0 + 0.8 * (i % 60) as f32, 1.0 + 0.8 * (i / 60) as f32);
        let coin = ball(0.2, place.x, place.y).shape(eye);
        add(&mut world, coin.can_sleep(i % 4 != 0));
    }
    with(world, |world, step| {
        for id in world.body_ids().skip(1).step_by(9).collect::<Vec<_>>() {
            let push = math::sin(step as f32 * 0.3) * 0.02;
            world.body_mut(id).unwrap().apply_impulse_to_center(Vec2::new(push, 0.0));
        }
    })
}
